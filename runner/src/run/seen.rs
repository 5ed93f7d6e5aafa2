//! What a run looks out for: signs that a scene is not what it is meant to be, though no number ended.

use crate::enclosure::Enclosure;
use crate::frame::Frame;
use serde::{Deserialize, Serialize};

/// What was seen at the turnaround, at the end, and when frames were written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Seen {
    /// Largest density over the reference density, less 1; `null` where a model has no density.
    pub largest_compression: Option<f64>,
    /// The most particles that were beyond the walls at once; `null` without walls.
    pub beyond_walls: Option<u64>,
}

impl Seen {
    /// Looks at a frame of a scene of this density (kg/m³) and these walls.
    pub fn look(&mut self, frame: &Frame, density: f64, walls: Option<&Enclosure>) {
        if let Some(densities) = frame.column("density") {
            let largest = densities.iter().copied().fold(0.0, f64::max) / density - 1.0;
            let most = self.largest_compression.map_or(largest, |x| x.max(largest));
            self.largest_compression = Some(most);
        }
        if let Some(walls) = walls {
            let beyond = walls.count_beyond(&frame.position);
            self.beyond_walls = Some(self.beyond_walls.unwrap_or(0).max(beyond));
        }
    }
}
