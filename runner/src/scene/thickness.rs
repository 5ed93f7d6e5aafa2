//! How thick the bodies of a scene are, in particles.

use super::region::Region;
use super::shape::Shape;
use super::types::Scene;

impl Scene {
    /// How many spacings the thinnest region that moves is thick; none without a region of known
    /// bounds.
    #[must_use]
    pub fn spacings_through(&self) -> Option<f64> {
        let free = self.regions.iter().filter(|region| !region.held);
        let thickness = |region: &Region| match &region.shape {
            Shape::Shell { inner, outer, .. } => Some(outer - inner),
            shape => {
                let (low, high) = shape.bounds(self.particle_spacing)?;
                let axes = 0..self.dimension.axes();
                Some(axes.fold(f64::INFINITY, |least, d| least.min(high[d] - low[d])))
            }
        };
        let least = free.filter_map(thickness).reduce(f64::min);
        least.map(|least| least / self.particle_spacing)
    }
}
