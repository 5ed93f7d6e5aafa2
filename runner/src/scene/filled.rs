//! How much of its shape a region fills: the particles of a lattice stand for whole squares or
//! cubes, which do not fit into every shape.

use super::filling::visit;
use super::lattice::Lattice;
use super::shape::Shape;
use super::types::Scene;
use super::words::{Dimension, LatticeKind};

/// A region, and what its particles stand for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Filled {
    /// Number of the region in file order, from 0.
    pub region: usize,
    /// Area or volume of the particles, m² or m³.
    pub particles: f64,
    /// Area or volume of the shape, m² or m³, to about a thousandth.
    pub shape: f64,
}

impl Filled {
    /// By which part of the shape the particles stand for more than it.
    #[must_use]
    pub fn excess(&self) -> f64 {
        self.particles / self.shape - 1.0
    }
}

/// Nodes of the fine lattice on which shapes are measured.
const SAMPLES: f64 = (1_u64 << 20) as f64;

impl Scene {
    /// What each region fills of its shape; walls and layers, which are as thick as their rows, are
    /// left out.
    #[must_use]
    pub fn filled(&self) -> Vec<Filled> {
        let regions = self.regions.iter().enumerate();
        let of_model = regions.filter(|(_, region)| region.kind.is_of_the_model());
        of_model
            .filter(|(_, region)| region.shape.thinnest_layer().is_none())
            .filter_map(|(number, region)| {
                Some(Filled {
                    region: number,
                    particles: measure(&self.lattice_of(number)?, &region.shape),
                    shape: self.size_of(&region.shape)?,
                })
            })
            .collect()
    }

    /// The area or volume of a shape, counted on a fine lattice that begins at its corner.
    fn size_of(&self, shape: &Shape) -> Option<f64> {
        let bounds = shape.bounds(self.particle_spacing)?;
        let axes = self.dimension.axes();
        let size = (0..axes).map(|k| bounds.1[k] - bounds.0[k]);
        let lattice = Lattice {
            kind: match self.dimension {
                Dimension::Two => LatticeKind::Square,
                Dimension::Three => LatticeKind::Cubic,
            },
            origin: bounds.0,
            spacing: (size.product::<f64>() / SAMPLES).powf(1.0 / axes as f64),
        };
        let found = measure(&lattice, shape);
        (found > 0.0).then_some(found)
    }
}

/// What the nodes of a lattice in a shape stand for, m² or m³.
fn measure(lattice: &Lattice, shape: &Shape) -> f64 {
    let mut count = 0_u64;
    visit(lattice, shape, |_| count += 1);
    count as f64 * lattice.spacing.powi(lattice.dimension().axes() as i32)
}
