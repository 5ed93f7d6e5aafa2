//! A picture to tint the fluid with: laid over the initial state, it travels with the particles.

use crate::colour::Rgb;
use crate::home::Home;
use crate::raster::Raster;

/// A picture that particles take their colours from.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    raster: Raster,
}

impl Picture {
    /// The picture of these pixels.
    #[must_use]
    pub fn new(raster: Raster) -> Self {
        Self { raster }
    }

    /// Its pixels.
    #[must_use]
    pub fn raster(&self) -> &Raster {
        &self.raster
    }

    /// The colour of every particle, in the order of the ids: the mean of the pixels over its
    /// square when the picture is stretched over the box around the initial fluid (in 3D, over
    /// the side of the box that looks along z).
    #[must_use]
    pub fn tint(&self, home: &Home) -> Vec<Rgb> {
        let (low, size) = (home.fluid.low, home.fluid.size());
        let (width, height) = (self.raster.width(), self.raster.height());
        let half = 0.5 * home.spacing;
        // Pixels from `from` to `to`, at least one, of an axis with `pixels` pixels.
        let range = |from: f64, to: f64, pixels: usize| {
            let n = pixels as f64;
            let start = (from * n).round().clamp(0.0, n - 1.0) as usize;
            let end = (to * n).round().clamp(0.0, n) as usize;
            start..end.max(start + 1)
        };
        let part = |x: f64, k: usize| {
            if size[k] > 0.0 {
                (x - low[k]) / size[k]
            } else {
                0.5
            }
        };
        let colour = |x: &[f64; 3]| {
            if width == 0 || height == 0 {
                return Rgb(0);
            }
            let columns = range(part(x[0] - half, 0), part(x[0] + half, 0), width);
            let rows = range(
                1.0 - part(x[1] + half, 1),
                1.0 - part(x[1] - half, 1),
                height,
            );
            let mut sum = [0u64; 3];
            let mut count = 0;
            for row in rows {
                for column in columns.clone() {
                    let channels = self.raster.at(column, row).channels();
                    for (s, c) in sum.iter_mut().zip(channels) {
                        *s += u64::from(c);
                    }
                    count += 1;
                }
            }
            Rgb::of(sum.map(|s| ((s + count / 2) / count) as u8))
        };
        home.position.iter().map(colour).collect()
    }
}
