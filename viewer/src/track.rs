//! The ways out and back while a user goes to and fro.
//!
//! A run that is watched turns whenever its user likes. The way out has one moment at every place
//! in time, the latest that was lived through going on; the way back is that of the last journey
//! towards the start. So a plot shows the one drawn over the other, and no more, however long one
//! plays.

use crate::history::History;
use loschmidt_runner::Arrow;
use loschmidt_runner::run::Row;
use std::sync::OnceLock;

/// The rows of the way out and of the last way back.
#[derive(Clone, Debug, Default)]
pub struct Track {
    /// Physical time that the plots have room for, s.
    span: f64,
    /// Rising positions.
    out: Vec<Row>,
    /// Falling positions.
    back: Vec<Row>,
    /// The same rows as a history, once it was asked for.
    history: OnceLock<History>,
}

impl Track {
    /// Without a row yet. `span`: physical time that the plots have room for, s.
    #[must_use]
    pub fn new(span: f64) -> Self {
        Self {
            span,
            ..Self::default()
        }
    }

    /// Adds a row that was reached in this direction.
    pub fn push(&mut self, row: Row, travel: Arrow) {
        self.history.take();
        match travel {
            Arrow::Forward => {
                self.back.clear();
                let place = self.out.partition_point(|r| r.position < row.position);
                match self.out.get_mut(place) {
                    Some(there) if there.position == row.position => *there = row,
                    _ => self.out.insert(place, row),
                }
            }
            Arrow::Backward => {
                let goes_on = self.back.last().is_none_or(|r| r.position > row.position);
                if !goes_on {
                    self.back.clear();
                }
                self.back.push(row);
            }
        }
    }

    /// The track of a series. `span`: physical time that the plots have room for, s.
    #[must_use]
    pub fn of_rows(rows: &[Row], span: f64) -> Self {
        let mut track = Self::new(span);
        for row in rows {
            let travel = if row.leg == 2 {
                Arrow::Backward
            } else {
                Arrow::Forward
            };
            track.push(row.clone(), travel);
        }
        track
    }

    /// The way out, in the order of physical time.
    #[must_use]
    pub fn out(&self) -> &[Row] {
        &self.out
    }

    /// The way back, in the order of its steps; empty on the way out.
    #[must_use]
    pub fn back(&self) -> &[Row] {
        &self.back
    }

    /// The way out up to the turn and the way back, numbered anew: the series of a run that went
    /// straight out and back.
    #[must_use]
    pub fn rows(&self) -> Vec<Row> {
        let turn = self.back.first().map(|row| row.position);
        let out = self
            .out
            .iter()
            .filter(|row| turn.is_none_or(|turn| row.position <= turn));
        let mut rows: Vec<Row> = out.chain(&self.back).cloned().collect();
        let farthest = turn.unwrap_or(0);
        let turned = self.back.first().map_or(0.0, |row| row.time_s);
        for row in &mut rows {
            row.elapsed_s = if row.leg == 2 {
                2.0 * turned - row.time_s
            } else {
                row.time_s
            };
            row.step = if row.leg == 2 {
                (2 * farthest - row.position).unsigned_abs()
            } else {
                row.position.unsigned_abs()
            };
        }
        rows
    }

    /// The same as a history, for pictures.
    #[must_use]
    pub fn history(&self) -> &History {
        self.history
            .get_or_init(|| History::of_rows(&self.rows(), self.span))
    }
}
