//! The report: one page in Markdown, one in HTML that needs no other file.

use crate::lab::{Lab, LabError};
use crate::section::{Section, Table, Verdict};
use std::fmt::Write;
use std::fs;

/// Title of both pages.
const TITLE: &str = "Globally time-reversible fluid simulations, run again";

const INTRODUCTION: &str = "Every figure and table of O. Kincl & M. Pavelka, Comput. Phys. Commun. 284 (2023) 108593, run again by `loschmidt reproduce`: our number beside the paper's and what was asked of it.";

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

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
}

const STYLE: &str = "body{font:16px/1.5 Georgia,serif;max-width:62rem;margin:2rem auto;padding:0 1rem;color:#222}\
h1,h2{font-family:Helvetica,Arial,sans-serif;line-height:1.2}h2{margin-top:3rem;border-top:1px solid #ccc;padding-top:1rem}\
table{border-collapse:collapse;margin:1rem 0;font:14px/1.35 Helvetica,Arial,sans-serif}\
th{text-align:left;border-bottom:2px solid #444}td,th{padding:.25rem .8rem .25rem 0;vertical-align:top}td{border-bottom:1px solid #ddd}\
.holds{color:#00734f;font-weight:bold}.fails{color:#b03000;font-weight:bold}.measured{color:#666}\
figure{display:inline-block;margin:1rem 1rem 1rem 0;vertical-align:top;max-width:100%}\
figure svg{max-width:100%;height:auto}figcaption{font-size:14px;color:#444;max-width:36rem}caption{text-align:left;font-weight:bold;padding-bottom:.4rem}";

fn html_table(out: &mut String, table: &Table, class: impl Fn(usize, usize) -> &'static str) {
    *out += "<table>";
    if !table.caption.is_empty() {
        let _ = write!(out, "<caption>{}</caption>", escaped(&table.caption));
    }
    *out += "<tr>";
    for head in &table.head {
        let _ = write!(out, "<th>{}</th>", escaped(head));
    }
    *out += "</tr>\n";
    for (r, row) in table.rows.iter().enumerate() {
        *out += "<tr>";
        for (c, cell) in row.iter().enumerate() {
            let _ = write!(out, "<td class=\"{}\">{}</td>", class(r, c), escaped(cell));
        }
        *out += "</tr>\n";
    }
    *out += "</table>\n";
}

fn html(lab: &Lab<'_>, sections: &[Section], figure: impl Fn(&str) -> String) -> String {
    let mut out = format!(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{TITLE}</title><style>{STYLE}</style></head><body>\n<h1>{TITLE}</h1>\n<p>{}</p>\n<p>{}</p>\n",
        escaped(INTRODUCTION)
            .replacen('`', "<code>", 1)
            .replacen('`', "</code>", 1),
        size(lab)
    );
    for section in sections {
        let _ = write!(
            out,
            "<h2>{}</h2>\n<p>{}</p>\n",
            escaped(&section.title),
            escaped(&section.setting)
        );
        if !section.findings.is_empty() {
            html_table(&mut out, &findings_table(section), |row, column| {
                match (column, section.findings[row].verdict) {
                    (4, Verdict::Holds) => "holds",
                    (4, Verdict::Fails) => "fails",
                    (4, Verdict::Measured) => "measured",
                    _ => "",
                }
            });
        }
        for table in &section.tables {
            html_table(&mut out, table, |_, _| "");
        }
        for note in &section.notes {
            let _ = writeln!(out, "<p>{}</p>", escaped(note));
        }
        for shown in &section.figures {
            let _ = writeln!(
                out,
                "<figure>{}<figcaption>{}</figcaption></figure>",
                figure(&shown.file),
                escaped(&shown.caption)
            );
        }
    }
    out += "</body></html>\n";
    out
}
