//! Checksums of a series: that a number of it was changed is seen, and where.
//!
//! Each column has two sums over its rows, of a hash h of every number and of the hash times the
//! number n of its row, both modulo 2^64. Where one number was changed they are off by Δ = h' - h
//! and by n Δ, which tells n. They are no protection against one who means to deceive: he would
//! change the manifest, where they stand, too.

use super::series::numbers;
use crate::run::Row;
use serde::{Deserialize, Serialize};
use std::fmt;

/// The checksums of a series.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Checksums {
    /// Rows counted.
    pub rows: usize,
    /// Column by column: its name, the sum of the hashes, that of the hashes times the rows.
    pub columns: Vec<(String, String, String)>,
}

/// A number that is not the one that was counted.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ChangedNumber {
    /// Its column.
    pub column: String,
    /// Its row, from 0; `None` where several numbers of the column were changed.
    pub row: Option<usize>,
}

impl fmt::Display for ChangedNumber {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let column = &self.column;
        match self.row {
            // The header is the first line.
            Some(row) => write!(
                f,
                "the `{column}` of row {row}, in line {}, is another",
                row + 2
            ),
            None => write!(f, "numbers of the column `{column}` are others"),
        }
    }
}

impl Checksums {
    /// Those of these rows.
    #[must_use]
    pub fn of(rows: &[Row]) -> Self {
        let sums = sums(rows).into_iter();
        let hexadecimal = |(name, [plain, weighted]): (String, [u64; 2])| {
            let text = |sum: u64| format!("{sum:016x}");
            (name, text(plain), text(weighted))
        };
        Self {
            rows: rows.len(),
            columns: sums.map(hexadecimal).collect(),
        }
    }

    /// The first column, in their order, whose numbers are not those that were counted. Columns
    /// that one of both does not know are left out.
    #[must_use]
    pub fn changed(&self, rows: &[Row]) -> Option<ChangedNumber> {
        let rows = &rows[..rows.len().min(self.rows)];
        let found = sums(rows);
        self.columns.iter().find_map(|(name, plain, weighted)| {
            let (_, [now, weighted_now]) = found.iter().find(|(known, _)| known == name)?;
            let sum = |text: &str| u64::from_str_radix(text, 16).ok();
            let (Some(plain), Some(weighted)) = (sum(plain), sum(weighted)) else {
                return Some(ChangedNumber {
                    column: name.clone(),
                    row: None,
                });
            };
            let off = now.wrapping_sub(plain);
            let weighted_off = weighted_now.wrapping_sub(weighted);
            if off == 0 && weighted_off == 0 {
                return None;
            }
            let fits = |row: &usize| weight(*row).wrapping_mul(off) == weighted_off;
            Some(ChangedNumber {
                column: name.clone(),
                row: (0..rows.len()).find(fits),
            })
        })
    }
}

/// The number of a row that the sums are weighted by.
fn weight(row: usize) -> u64 {
    row as u64 + 1
}

/// Both sums of every column, by its name.
fn sums(rows: &[Row]) -> Vec<(String, [u64; 2])> {
    let mut sums: Vec<(String, [u64; 2])> = Vec::new();
    for (row, numbers) in rows.iter().map(numbers).enumerate() {
        for (n, (name, bits)) in numbers.into_iter().enumerate() {
            if row == 0 {
                sums.push((name, [0; 2]));
            }
            if let Some((_, [plain, weighted])) = sums.get_mut(n) {
                let hash = mixed(bits as u64 ^ mixed((bits >> 64) as u64));
                *plain = plain.wrapping_add(hash);
                *weighted = weighted.wrapping_add(hash.wrapping_mul(weight(row)));
            }
        }
    }
    sums
}

/// Spreads every bit over all of them: the finaliser of SplitMix64 (Steele, Lea & Flood, 2014).
fn mixed(bits: u64) -> u64 {
    let bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    bits ^ (bits >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is done to a row.
    type Change = fn(&mut Row);

    fn rows() -> Vec<Row> {
        let row = |n: u64| Row {
            step: n,
            energies: vec![("kinetic".into(), 0.5 * n as f64)],
            momentum_x_quanta: -(n as i128) << 70,
            entropy: 1.0 / (1.0 + n as f64),
            ..Row::default()
        };
        (0..1000).map(row).collect()
    }

    #[test]
    fn a_changed_number_is_found_in_every_row_and_column() {
        let sums = Checksums::of(&rows());
        assert_eq!(sums.changed(&rows()), None);
        assert_eq!(sums.columns[0].0, "step");
        for place in [0, 1, 2, 500, 999] {
            let changes: [(&str, Change); 4] = [
                ("step", |row| row.step ^= 1 << 63),
                ("kinetic_J", |row| row.energies[0].1 += 1e-9),
                ("momentum_x_quanta", |row| row.momentum_x_quanta += 1),
                ("equilibrium_entropy_of_fit", |row| {
                    row.equilibrium_entropy_of_fit = Some(0.0);
                }),
            ];
            for (column, change) in changes {
                let mut changed = rows();
                change(&mut changed[place]);
                let found = sums.changed(&changed);
                let found = found.expect("a change");
                assert_eq!((found.column.as_str(), found.row), (column, Some(place)));
            }
        }
        // Rows that came later do not count; two changes in a column have no row.
        let mut more = rows();
        more.push(Row::default());
        assert_eq!(sums.changed(&more), None);
        (more[3].entropy, more[7].entropy) = (2.0, 3.0);
        let found = sums.changed(&more).expect("a change");
        assert_eq!((found.column.as_str(), found.row), ("entropy", None));
    }
}
