//! Where a point of the scene is on the screen.
//!
//! In the plane, x_screen = w/2 + s (x - x₀), y_screen = h/2 - s (y - y₀), with the scale s in
//! pixels per m. In space a pinhole camera looks from a distance d at the centre c of the scene:
//! with the coordinates (a, b, e) of x - c along its right, its up and towards it, x_screen = w/2 +
//! f a/(d - e), y_screen = h/2 - f b/(d - e). With a [`View`] of zoom 1 and no pan the box
//! [`Home::shown`] fits into the rectangle.

use crate::home::Home;
use glam::{DMat3, DVec3};

/// From where a scene is looked at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Magnification; 1 shows the whole scene.
    pub zoom: f64,
    /// How far the middle of the picture is from the middle of the scene, m to the right and up.
    pub pan: [f64; 2],
    /// In 3D: the angle around the vertical, rad; 0 looks along the last axis.
    pub yaw: f64,
    /// In 3D: the angle above the horizontal, rad.
    pub pitch: f64,
}

impl Default for View {
    fn default() -> Self {
        Self {
            zoom: 1.0,
            pan: [0.0, 0.0],
            yaw: -0.55,
            pitch: 0.35,
        }
    }
}

impl View {
    /// The steepest pitch, rad: just short of looking along the vertical.
    pub const STEEPEST: f64 = 1.55;

    /// Whether it shows the whole scene, from whatever side.
    #[must_use]
    pub fn is_of_the_whole(&self) -> bool {
        self.zoom == 1.0 && self.pan == [0.0, 0.0]
    }

    /// Turns the camera around the scene, rad.
    #[must_use]
    pub fn orbited(self, yaw: f64, pitch: f64) -> Self {
        Self {
            yaw: self.yaw + yaw,
            pitch: (self.pitch + pitch).clamp(-Self::STEEPEST, Self::STEEPEST),
            ..self
        }
    }

    /// Magnifies by a factor; what is in the middle stays there.
    #[must_use]
    pub fn zoomed(self, factor: f64) -> Self {
        Self {
            zoom: (self.zoom * factor).clamp(1e-3, 1e4),
            ..self
        }
    }

    /// Moves the picture by so many pixels to the right and down.
    #[must_use]
    pub fn dragged(self, pixels: [f64; 2], projection: &Projection) -> Self {
        let metres = 1.0 / projection.scale();
        Self {
            pan: [
                self.pan[0] - pixels[0] * metres,
                self.pan[1] + pixels[1] * metres,
            ],
            ..self
        }
    }
}

/// A point on the screen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Projected {
    /// Pixels from the left.
    pub x: f64,
    /// Pixels from the top.
    pub y: f64,
    /// Pixels per m there.
    pub scale: f64,
    /// Distance from the camera along its axis, m; 0 in the plane.
    pub depth: f64,
}

/// The way from the scene to a rectangle of pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Projection {
    middle: [f64; 2],
    centre: DVec3,
    /// Rows: right, up, towards the camera.
    axes: DMat3,
    lens: Lens,
    /// Nearest and farthest depth of the scene, m.
    depths: [f64; 2],
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Lens {
    /// Pixels per m.
    Flat(f64),
    /// A pinhole.
    Pinhole {
        /// Pixels.
        focal: f64,
        /// Of the camera from the centre, m.
        distance: f64,
        /// Of the middle of the picture, m in the plane through the centre.
        offset: [f64; 2],
    },
}

/// Part of the rectangle that the scene fills.
pub(crate) const FILL: f64 = 0.95;

/// Distance of the camera in radii of the scene.
const DISTANCE: f64 = 3.2;

impl Projection {
    /// The projection on a rectangle of `width` times `height` pixels.
    #[must_use]
    pub fn new(home: &Home, view: &View, width: usize, height: usize) -> Self {
        let (w, h) = (width as f64, height as f64);
        let middle = [0.5 * w, 0.5 * h];
        let size = home.shown.size();
        let centre = DVec3::from_array(home.shown.centre());
        if home.dimension == 2 {
            let fit = (w / size[0].max(1e-12)).min(h / size[1].max(1e-12));
            return Self {
                middle,
                centre: centre + DVec3::new(view.pan[0], view.pan[1], 0.0),
                axes: DMat3::IDENTITY,
                lens: Lens::Flat(FILL * fit * view.zoom),
                depths: [0.0, 0.0],
            };
        }
        let axes = camera_axes(home.up, view);
        let radius = 0.5 * DVec3::from_array(size).length();
        let distance = DISTANCE * radius.max(1e-12);
        let mut low = [f64::INFINITY; 2];
        let mut high = [f64::NEG_INFINITY; 2];
        let mut depths = [f64::INFINITY, 0.0_f64];
        for corner in 0..8 {
            let x: [f64; 3] = std::array::from_fn(|k| {
                let end = [home.shown.low[k], home.shown.high[k]];
                end[corner >> k & 1]
            });
            let p = axes * (DVec3::from_array(x) - centre);
            let depth = distance - p.z;
            depths = [depths[0].min(depth), depths[1].max(depth)];
            for (k, q) in [p.x / depth, p.y / depth].into_iter().enumerate() {
                low[k] = low[k].min(q);
                high[k] = high[k].max(q);
            }
        }
        let fit = (w / (high[0] - low[0]).max(1e-12)).min(h / (high[1] - low[1]).max(1e-12));
        let offset = std::array::from_fn(|k| 0.5 * (low[k] + high[k]) * distance + view.pan[k]);
        Self {
            middle,
            centre,
            axes,
            lens: Lens::Pinhole {
                focal: FILL * fit * view.zoom,
                distance,
                offset,
            },
            depths,
        }
    }

    /// Pixels per m; in 3D at the centre of the scene.
    #[must_use]
    pub fn scale(&self) -> f64 {
        match self.lens {
            Lens::Flat(scale) => scale,
            Lens::Pinhole {
                focal, distance, ..
            } => focal / distance,
        }
    }

    /// A point (m) on the screen; `None` behind the camera.
    #[must_use]
    #[inline]
    pub fn project(&self, x: [f64; 3]) -> Option<Projected> {
        let p = DVec3::from_array(x) - self.centre;
        match self.lens {
            Lens::Flat(scale) => Some(Projected {
                x: self.middle[0] + scale * p.x,
                y: self.middle[1] - scale * p.y,
                scale,
                depth: 0.0,
            }),
            Lens::Pinhole {
                focal,
                distance,
                offset,
            } => {
                let p = self.axes * p;
                let depth = distance - p.z;
                // The offset belongs to the plane of the picture, not to the scene behind it.
                let scale = focal / depth;
                (depth > 0.02 * distance).then(|| Projected {
                    x: self.middle[0] + scale * p.x - focal / distance * offset[0],
                    y: self.middle[1] - scale * p.y + focal / distance * offset[1],
                    scale,
                    depth,
                })
            }
        }
    }

    /// In the plane: for either axis of the screen, the factor and the summand that take metres to
    /// pixels.
    pub(crate) fn along_axes(&self) -> [[f64; 2]; 2] {
        let [w, h] = self.middle;
        let scale = self.scale();
        [
            [scale, w - scale * self.centre.x],
            [-scale, h + scale * self.centre.y],
        ]
    }

    /// In the plane: the point (m) at a place on the screen.
    #[must_use]
    pub fn unproject(&self, x: f64, y: f64) -> [f64; 2] {
        let scale = self.scale();
        [
            self.centre.x + (x - self.middle[0]) / scale,
            self.centre.y - (y - self.middle[1]) / scale,
        ]
    }

    /// How deep in the scene a depth is: 0 at its nearest corner, 1 at its farthest.
    #[must_use]
    pub fn part_of_depth(&self, depth: f64) -> f64 {
        let [near, far] = self.depths;
        if far > near {
            ((depth - near) / (far - near)).clamp(0.0, 1.0)
        } else {
            0.0
        }
    }
}

/// Right, up and towards the camera, as the rows of a matrix.
fn camera_axes(up: usize, view: &View) -> DMat3 {
    let (right, up) = match up {
        0 => (-DVec3::Y, DVec3::X),
        1 => (DVec3::X, DVec3::Y),
        _ => (DVec3::X, DVec3::Z),
    };
    let towards = right.cross(up);
    let (sin_yaw, cos_yaw) = libm::sincos(view.yaw);
    let (sin_pitch, cos_pitch) = libm::sincos(view.pitch);
    let flat = towards * cos_yaw + right * sin_yaw;
    let eye = flat * cos_pitch + up * sin_pitch;
    let right = right * cos_yaw - towards * sin_yaw;
    DMat3::from_cols(right, eye.cross(right), eye).transpose()
}
