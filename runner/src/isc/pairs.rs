//! Neighbours of every particle, their densities and the vectors g_ab = m W'(r_ab) e_ab.

use super::settings::CorrectionSettings;
use loschmidt_core::kernel::WendlandC2;
use loschmidt_core::neighbours::{Cells, CellsView, Grid};
use rayon::prelude::*;

/// Particles in each part of the work that one thread takes at a time.
pub(super) const GRAIN: usize = 512;

/// Units in a support radius: the cells of the core count in whole units.
const UNITS: f64 = (1_u64 << 30) as f64;

/// Pairs of fluid particles, by particle.
pub(super) struct Pairs<const D: usize> {
    /// Where the neighbours of each particle begin; one more at the end.
    start: Vec<usize>,
    /// The neighbours.
    other: Vec<u32>,
    /// g_ab of each.
    gradient: Vec<[f64; D]>,
    /// G_a: the sum of g_ab.
    total: Vec<[f64; D]>,
    /// The diagonal of D Dᵀ: |G_a|² + Σ_b |g_ab|².
    pub diagonal: Vec<f64>,
    /// Σ_b m W, the particle itself included.
    pub density: Vec<f64>,
}

/// What one particle finds around it.
struct Encounters<const D: usize> {
    other: Vec<u32>,
    gradient: Vec<[f64; D]>,
    total: [f64; D],
    diagonal: f64,
    density: f64,
}

/// Kernel, mass and reach.
struct Law<'a> {
    kernel: WendlandC2,
    settings: &'a CorrectionSettings,
}

impl Law<'_> {
    /// m W and g_ab of two places, if they are within reach of each other.
    #[inline]
    fn pair<const D: usize>(&self, a: &[f64; D], b: &[f64; D]) -> Option<(f64, [f64; D])> {
        let x: [f64; D] = std::array::from_fn(|d| a[d] - b[d]);
        let r2 = square(&x);
        let h = self.settings.support_radius;
        (r2 < h * h).then(|| {
            let r = r2.sqrt();
            let factor = self.settings.mass * self.kernel.derivative_over_r(r);
            let density = self.settings.mass * self.kernel.value(r);
            (density, x.map(|x| factor * x))
        })
    }
}

impl<const D: usize> Pairs<D> {
    /// Finds the pairs.
    pub fn new(fluid: &[[f64; D]], settings: &CorrectionSettings) -> Self {
        let unit = settings.support_radius / UNITS;
        let units: Vec<[f64; D]> = fluid.iter().map(|x| x.map(|x| x / unit)).collect();
        let most_buckets = 2 * fluid.len();
        let grid = Grid::new(UNITS as i64, extent(&units), most_buckets);
        let (mut start, mut order) = (vec![0; grid.buckets() + 1], vec![0; fluid.len()]);
        let cells = sorted(&grid, &units, &mut start, &mut order);
        let law = Law {
            kernel: WendlandC2::new(D, settings.support_radius, 1.0),
            settings,
        };
        let own = settings.mass * law.kernel.value(0.0);
        let found: Vec<Encounters<D>> = (0..fluid.len())
            .into_par_iter()
            .with_min_len(GRAIN)
            .map(|i| {
                let mut found = Encounters {
                    other: Vec::new(),
                    gradient: Vec::new(),
                    total: [0.0; D],
                    diagonal: 0.0,
                    density: own,
                };
                let x = &fluid[i];
                cells.around(&grid, &units[i], |run| {
                    for &j in run {
                        if j as usize != i
                            && let Some((density, g)) = law.pair(x, &fluid[j as usize])
                        {
                            found.add(density, &g);
                            found.diagonal += square(&g);
                            found.other.push(j);
                            found.gradient.push(g);
                        }
                    }
                });
                found.diagonal += square(&found.total);
                found
            })
            .collect();
        Self::joined(found)
    }

    fn joined(found: Vec<Encounters<D>>) -> Self {
        let count = found.iter().map(|found| found.other.len()).sum();
        let mut pairs = Self {
            start: Vec::with_capacity(found.len() + 1),
            other: Vec::with_capacity(count),
            gradient: Vec::with_capacity(count),
            total: Vec::with_capacity(found.len()),
            diagonal: Vec::with_capacity(found.len()),
            density: Vec::with_capacity(found.len()),
        };
        pairs.start.push(0);
        for found in found {
            pairs.other.extend(found.other);
            pairs.gradient.extend(found.gradient);
            pairs.total.push(found.total);
            pairs.diagonal.push(found.diagonal);
            pairs.density.push(found.density);
            pairs.start.push(pairs.other.len());
        }
        pairs
    }

    fn row(&self, a: usize) -> impl Iterator<Item = (usize, &[f64; D])> {
        let row = self.start[a]..self.start[a + 1];
        let other = self.other[row.clone()].iter().map(|&b| b as usize);
        other.zip(&self.gradient[row])
    }

    /// (Dᵀψ)_a = G_a ψ_a + Σ_b g_ab ψ_b.
    pub fn gradient(&self, psi: &[f64], out: &mut [[f64; D]]) {
        out.par_iter_mut()
            .with_min_len(GRAIN)
            .enumerate()
            .for_each(|(a, out)| {
                let mut sum = self.total[a].map(|g| g * psi[a]);
                for (b, g) in self.row(a) {
                    for (sum, g) in sum.iter_mut().zip(g) {
                        *sum += g * psi[b];
                    }
                }
                *out = sum;
            });
    }

    /// (D δx)_a = G_a · δx_a - Σ_b g_ab · δx_b.
    pub fn divergence(&self, shift: &[[f64; D]], out: &mut [f64]) {
        out.par_iter_mut()
            .with_min_len(GRAIN)
            .enumerate()
            .for_each(|(a, out)| {
                let mut sum = inner(&self.total[a], &shift[a]);
                for (b, g) in self.row(a) {
                    sum -= inner(g, &shift[b]);
                }
                *out = sum;
            });
    }
}

impl<const D: usize> Encounters<D> {
    fn add(&mut self, density: f64, g: &[f64; D]) {
        self.density += density;
        for (total, g) in self.total.iter_mut().zip(g) {
            *total += g;
        }
    }
}

fn inner<const D: usize>(a: &[f64; D], b: &[f64; D]) -> f64 {
    let mut sum = a[0] * b[0];
    for d in 1..D {
        sum += a[d] * b[d];
    }
    sum
}

fn square<const D: usize>(x: &[f64; D]) -> f64 {
    inner(x, x)
}

fn sorted<'a, const D: usize>(
    grid: &Grid<D>,
    units: &[[f64; D]],
    start: &'a mut [u32],
    order: &'a mut [u32],
) -> CellsView<'a> {
    let mut cells = Cells { start, order };
    cells.sort(grid, units);
    cells.into_view()
}

/// Size of the box that holds the particles, in units.
fn extent<const D: usize>(units: &[[f64; D]]) -> [i64; D] {
    std::array::from_fn(|d| {
        let (low, high) = units
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
                (low.min(x[d]), high.max(x[d]))
            });
        (high - low).max(0.0) as i64
    })
}
