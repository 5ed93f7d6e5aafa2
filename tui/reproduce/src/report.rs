//! The report: one page in Markdown, one in HTML that needs no other file.

use crate::lab::{Lab, LabError};
use crate::section::{Section, Table, Verdict};
use crate::svg::is_chart;
use crate::svg::text::{escaped, with_subscripts};
use std::fmt::Write;
use std::fs;

/// Title of both pages.
const TITLE: &str = "Globally time-reversible fluid simulations, run again";

const INTRODUCTION: &str = "Every figure and table of O. Kincl & M. Pavelka, Comput. Phys. Commun. 284 (2023) 108593, and the elastic bodies and viscous fluids of Kincl, Peshkov, Pavelka & Klika, Appl. Math. Comput. 439 (2023) 127579, and the superfluid helium of Kincl, Schmoranzer & Pavelka, Phys. Fluids 35 (2023) 047124, run again by `loschmidt reproduce`: our number beside the paper's and what was asked of it.";

fn size(lab: &Lab<'_>) -> &'static str {
    lab.size(
        "Quick report: coarser spacings than the paper's. What is quoted comes from a report of full size.",
        "Full size.",
    )
}

/// Writes `report.md` and `report.html` from these sections.
///
/// # Errors
/// The file system's.
pub fn write(lab: &Lab<'_>, sections: &[Section]) -> Result<(), LabError> {
    lab.write("report.md", &markdown(lab, sections))?;
    let figure = |file: &str| fs::read_to_string(lab.dir().join(file)).unwrap_or_default();
    lab.write("report.html", &html(lab, sections, figure))
}

fn findings_table(section: &Section) -> Table {
    let rows = section.findings.iter().map(|f| {
        vec![
            f.quantity.clone(),
            f.ours.clone(),
            f.published.clone(),
            f.asked.clone(),
            f.verdict.word().to_owned(),
        ]
    });
    Table {
        caption: String::new(),
        head: ["", "ours", "paper or reference", "asked", "verdict"]
            .map(str::to_owned)
            .to_vec(),
        rows: rows.collect(),
    }
}

fn markdown_table(out: &mut String, table: &Table) {
    let cell = |text: &String| text.replace('|', "\\|");
    let line = |cells: &[String]| {
        let cells: Vec<String> = cells.iter().map(cell).collect();
        format!("| {} |\n", cells.join(" | "))
    };
    if !table.caption.is_empty() {
        let _ = write!(out, "{}\n\n", table.caption);
    }
    *out += &line(&table.head);
    let _ = writeln!(out, "|{}", "---|".repeat(table.head.len()));
    for row in &table.rows {
        *out += &line(row);
    }
    out.push('\n');
}

fn markdown(lab: &Lab<'_>, sections: &[Section]) -> String {
    let mut out = format!("# {TITLE}\n\n{INTRODUCTION}\n\n{}\n\n", size(lab));
    markdown_table(&mut out, &summary(sections));
    for section in sections {
        let _ = write!(out, "## {}\n\n{}\n\n", section.title, section.setting);
        if !section.findings.is_empty() {
            markdown_table(&mut out, &findings_table(section));
        }
        for table in &section.tables {
            markdown_table(&mut out, table);
        }
        for note in &section.notes {
            let _ = write!(out, "{note}\n\n");
        }
        for figure in &section.figures {
            let _ = write!(out, "![{}]({})\n\n", figure.caption, figure.file);
        }
        let _ = write!(out, "({:.0} s)\n\n", section.seconds);
    }
    out
}

/// Text for HTML: with subscripts, and what stands between backticks as code.
fn marked(text: &str) -> String {
    let mut parts = text.split('`').enumerate();
    parts.by_ref().fold(String::new(), |out, (k, part)| {
        if k % 2 == 1 {
            out + "<code>" + &escaped(part) + "</code>"
        } else {
            out + &with_subscripts(part, "<sub>", "</sub>")
        }
    })
}

/// Light and dark; figures stay on white, as they would be printed.
const STYLE: &str = ":root{color-scheme:light dark;--ink:#222;--soft:#555;--rule:#ccc;--paper:#fff;--good:#00734f;--bad:#b03000}\
@media(prefers-color-scheme:dark){:root{--ink:#e4e4e4;--soft:#aaa;--rule:#444;--paper:#161616;--good:#4cc79b;--bad:#ff8a5c}}\
body{font:16px/1.5 Georgia,serif;max-width:64rem;margin:2rem auto;padding:0 1rem;color:var(--ink);background:var(--paper)}\
h1,h2{font-family:Helvetica,Arial,sans-serif;line-height:1.2}h2{margin-top:3rem;border-top:1px solid var(--rule);padding-top:1rem}\
sub{font-size:.75em;line-height:0}.scroll{overflow-x:auto}\
table{border-collapse:collapse;margin:1rem 0;font:14px/1.35 Helvetica,Arial,sans-serif}\
th{text-align:left;border-bottom:2px solid var(--soft)}td,th{padding:.25rem 1rem .25rem 0;vertical-align:top}td{border-bottom:1px solid var(--rule)}\
.holds{color:var(--good);font-weight:bold}.fails{color:var(--bad);font-weight:bold}.measured{color:var(--soft)}\
.figures{display:flex;flex-wrap:wrap;gap:1.5rem 1rem;margin:1.5rem 0}figure{margin:0;width:100%}figure.half{width:calc(50% - .5rem)}\
figure svg{display:block;width:100%;height:auto}figure.wide svg{max-width:1000px}figcaption{font-size:14px;color:var(--soft);padding:.3rem .3rem 0}\
caption{text-align:left;font-weight:bold;padding-bottom:.4rem;white-space:nowrap}@media(max-width:44rem){figure.half{width:100%}caption{white-space:normal}}\
@media print{body{max-width:none}figure,tr{break-inside:avoid}}";

fn html_table(out: &mut String, table: &Table, class: impl Fn(usize, usize) -> &'static str) {
    *out += "<div class=\"scroll\"><table>";
    if !table.caption.is_empty() {
        let _ = write!(out, "<caption>{}</caption>", marked(&table.caption));
    }
    *out += "<tr>";
    for head in &table.head {
        let _ = write!(out, "<th>{}</th>", marked(head));
    }
    *out += "</tr>\n";
    for (r, row) in table.rows.iter().enumerate() {
        *out += "<tr>";
        for (c, cell) in row.iter().enumerate() {
            let _ = write!(out, "<td class=\"{}\">{}</td>", class(r, c), marked(cell));
        }
        *out += "</tr>\n";
    }
    *out += "</table></div>\n";
}

/// How many of the findings of each section hold.
fn summary(sections: &[Section]) -> Table {
    let count = |section: &Section, verdict| {
        let of = section.findings.iter().filter(|f| f.verdict == verdict);
        of.count().to_string()
    };
    let rows = sections.iter().map(|section| {
        vec![
            section.title.clone(),
            count(section, Verdict::Holds),
            count(section, Verdict::Fails),
            count(section, Verdict::Measured),
        ]
    });
    Table {
        caption: String::new(),
        head: ["", "holds", "fails", "measured"]
            .map(str::to_owned)
            .to_vec(),
        rows: rows.collect(),
    }
}

fn html(lab: &Lab<'_>, sections: &[Section], figure: impl Fn(&str) -> String) -> String {
    let mut out = format!(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" content=\"width=device-width\"><title>{TITLE}</title><style>{STYLE}</style></head><body>\n<h1>{TITLE}</h1>\n<p>{}</p>\n<p>{}</p>\n",
        marked(INTRODUCTION),
        size(lab)
    );
    html_table(&mut out, &summary(sections), |row, column| {
        let any = |verdict| sections[row].findings.iter().any(|f| f.verdict == verdict);
        match column {
            0 => "",
            1 if any(Verdict::Holds) => "holds",
            2 if any(Verdict::Fails) => "fails",
            _ => "measured",
        }
    });
    for section in sections {
        html_section(&mut out, section, &figure);
    }
    out += "</body></html>\n";
    out
}

fn html_section(out: &mut String, section: &Section, figure: impl Fn(&str) -> String) {
    let _ = write!(
        out,
        "<h2>{}</h2>\n<p>{}</p>\n",
        marked(&section.title),
        marked(&section.setting)
    );
    if !section.findings.is_empty() {
        html_table(out, &findings_table(section), |row, column| {
            match (column, section.findings[row].verdict) {
                (4, Verdict::Holds) => "holds",
                (4, Verdict::Fails) => "fails",
                (4, Verdict::Measured) => "measured",
                _ => "",
            }
        });
    }
    for table in &section.tables {
        html_table(out, table, |_, _| "");
    }
    for note in &section.notes {
        let _ = writeln!(out, "<p>{}</p>", marked(note));
    }
    if section.figures.is_empty() {
        return;
    }
    *out += "<div class=\"figures\">\n";
    for shown in &section.figures {
        let svg = figure(&shown.file);
        let class = if is_chart(&svg) { "half" } else { "wide" };
        let _ = writeln!(
            out,
            "<figure class=\"{class}\">{svg}<figcaption>{}</figcaption></figure>",
            marked(&shown.caption)
        );
    }
    *out += "</div>\n";
}
