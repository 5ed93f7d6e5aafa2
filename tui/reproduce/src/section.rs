//! What a target found: numbers beside the paper's, tables, figures.

use serde::{Deserialize, Serialize};

/// Whether a number is what was asked of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Verdict {
    /// It is.
    Holds,
    /// It is not.
    Fails,
    /// Nothing was asked: a measurement.
    Measured,
}

impl Verdict {
    /// From a comparison.
    #[must_use]
    pub fn of(holds: bool) -> Self {
        if holds { Self::Holds } else { Self::Fails }
    }

    /// For people.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Holds => "holds",
            Self::Fails => "FAILS",
            Self::Measured => "measured",
        }
    }
}

/// A number beside the paper's.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Finding {
    /// What it is.
    pub quantity: String,
    /// Ours.
    pub ours: String,
    /// The paper's, or that of the reference; empty where there is none.
    pub published: String,
    /// What was asked; empty where nothing was.
    pub asked: String,
    /// Whether it is so.
    pub verdict: Verdict,
}

/// A table.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Table {
    /// Above it.
    pub caption: String,
    /// Names of the columns.
    pub head: Vec<String>,
    /// Rows.
    pub rows: Vec<Vec<String>>,
}

/// A figure in a file beside the report.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Figure {
    /// Its file, without a directory.
    pub file: String,
    /// Below it.
    pub caption: String,
}

/// What a target found.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Section {
    /// Name of the target.
    pub target: String,
    /// Heading.
    pub title: String,
    /// What was run, in a sentence or two.
    pub setting: String,
    /// Numbers and verdicts.
    pub findings: Vec<Finding>,
    /// Tables.
    pub tables: Vec<Table>,
    /// Figures.
    pub figures: Vec<Figure>,
    /// What a reader should know.
    pub notes: Vec<String>,
    /// Wall time, s, of the part that was run in this call.
    pub seconds: f64,
}

impl Section {
    /// An empty section.
    #[must_use]
    pub fn new(title: &str, setting: impl Into<String>) -> Self {
        Self {
            title: title.to_owned(),
            setting: setting.into(),
            ..Self::default()
        }
    }

    /// A number of which something was asked.
    pub fn check(
        &mut self,
        quantity: &str,
        ours: impl Into<String>,
        published: &str,
        asked: &str,
        holds: bool,
    ) {
        self.findings.push(Finding {
            quantity: quantity.to_owned(),
            ours: ours.into(),
            published: published.to_owned(),
            asked: asked.to_owned(),
            verdict: Verdict::of(holds),
        });
    }

    /// A number of which something is asked at full size alone: coarser spacings are only measured.
    pub fn check_at_full_size(
        &mut self,
        quick: bool,
        quantity: &str,
        ours: impl Into<String>,
        published: &str,
        asked: &str,
        holds: bool,
    ) {
        if quick {
            self.measure(quantity, ours, published);
        } else {
            self.check(quantity, ours, published, asked, holds);
        }
    }

    /// A number of which nothing was asked.
    pub fn measure(&mut self, quantity: &str, ours: impl Into<String>, published: &str) {
        self.findings.push(Finding {
            quantity: quantity.to_owned(),
            ours: ours.into(),
            published: published.to_owned(),
            asked: String::new(),
            verdict: Verdict::Measured,
        });
    }

    /// A remark.
    pub fn note(&mut self, text: impl Into<String>) {
        self.notes.push(text.into());
    }

    /// A table.
    pub fn table(&mut self, caption: &str, head: &[&str], rows: Vec<Vec<String>>) {
        self.tables.push(Table {
            caption: caption.to_owned(),
            head: head.iter().map(|&h| h.to_owned()).collect(),
            rows,
        });
    }

    /// True where nothing failed.
    #[must_use]
    pub fn holds(&self) -> bool {
        self.findings.iter().all(|f| f.verdict != Verdict::Fails)
    }
}
