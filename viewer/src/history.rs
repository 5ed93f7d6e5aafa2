//! Energy and entropy along both legs: what the plots show.

use loschmidt_runner::run::Row;
use std::sync::atomic::{AtomicU64, Ordering};

/// A moment of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HistoryPoint {
    /// Steps taken over both legs.
    pub step: u64,
    /// Physical time, s: falls on the way back.
    pub time: f64,
    /// Whether time had been turned.
    pub way_back: bool,
    /// Kinetic energy, J (per m of depth in 2D, as the others).
    pub kinetic: f64,
    /// Gravitational energy of a fluid, J; of other models, all energies but the kinetic one.
    pub potential: f64,
    /// The sum of the energies, J.
    pub total: f64,
    /// Reduced Boltzmann entropy.
    pub entropy: f64,
    /// Its equilibrium value for the kinetic energy; `None` at rest.
    pub equilibrium: Option<f64>,
}

impl From<&Row> for HistoryPoint {
    fn from(row: &Row) -> Self {
        let kinetic = row.energy("kinetic");
        Self {
            step: row.step,
            time: row.time_s,
            way_back: row.leg == 2,
            kinetic,
            potential: if row.has_energy("internal") {
                row.energy("gravitational")
            } else {
                row.total - kinetic
            },
            total: row.total,
            entropy: row.entropy,
            equilibrium: row.equilibrium_entropy_of_energy,
        }
    }
}

/// The moments of a run so far, in the order they were lived through.
#[derive(Clone, Debug)]
pub struct History {
    points: Vec<HistoryPoint>,
    span: f64,
    /// Histories with the same number are equal.
    version: u64,
}

/// A number that no history has yet.
fn new_version() -> u64 {
    static NEXT: AtomicU64 = AtomicU64::new(0);
    NEXT.fetch_add(1, Ordering::Relaxed)
}

impl PartialEq for History {
    fn eq(&self, other: &Self) -> bool {
        self.points == other.points && self.span == other.span
    }
}

impl Default for History {
    fn default() -> Self {
        Self::new(0.0)
    }
}

impl History {
    /// Without a moment yet. `span`: the largest physical time the plots have room for, s; it
    /// grows when a later moment comes.
    #[must_use]
    pub fn new(span: f64) -> Self {
        Self {
            points: Vec::new(),
            span,
            version: new_version(),
        }
    }

    /// The history of a series.
    #[must_use]
    pub fn of_rows(rows: &[Row], span: f64) -> Self {
        let mut history = Self::new(span);
        rows.iter().for_each(|row| history.push(row.into()));
        history
    }

    /// Adds a moment.
    pub fn push(&mut self, point: HistoryPoint) {
        self.span = self.span.max(point.time);
        self.points.push(point);
        self.version = new_version();
    }

    /// A number that changes with every moment: histories with the same one are equal.
    pub(crate) fn version(&self) -> u64 {
        self.version
    }

    /// The moments.
    #[must_use]
    pub fn points(&self) -> &[HistoryPoint] {
        &self.points
    }

    /// The largest physical time of the plots, s.
    #[must_use]
    pub fn span(&self) -> f64 {
        self.span
    }

    /// The history as it was after `step` steps.
    #[must_use]
    pub fn until(&self, step: u64) -> Self {
        let end = self.points.partition_point(|point| point.step <= step);
        Self {
            points: self.points[..end].to_vec(),
            span: self.span,
            version: new_version(),
        }
    }
}
