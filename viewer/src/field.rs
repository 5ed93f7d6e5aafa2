//! The particles: anti-aliased discs that are as large as they are.
//!
//! In the plane the colour of a pixel is the mean of the colours of the discs on it, weighted by
//! their coverages, and its opacity is the sum of these, at most 1; sums of integers, in which
//! discs that share an edge leave no seam. In space the particles are balls with light and shade,
//! drawn from the farthest to the nearest and paler in the distance.
//!
//! No pixel depends on the order of the particles, nor on the number of threads.

use crate::bands::{self, DiscBatch};
use crate::camera::{Projected, Projection};
use crate::colour::Rgb;
use crate::colouring::Painter;
use crate::deep::{self, Disc};
use crate::flat::{self, Brush, Dot};
use crate::home::Home;
use crate::look::Look;
use crate::raster::{Mask, Pixels, Raster, Rect};
use crate::stamp::{PARTS, SMALLEST, Stamp};
use crate::wide::wide;
use loschmidt_runner::Points;
use rayon::prelude::*;
use std::cell::Cell;

/// Particles whose discs one thread makes.
const PIECE: usize = 8192;

/// Weight of a wall particle in space, of 255, at most.
const FAINT: f64 = 70.0;

/// How much of what is behind them all wall particles together cover.
const VEIL: f64 = 0.3;

/// Weight of the background on the farthest ball, of 255.
const HAZE: f64 = 60.0;

thread_local! {
    /// Memory of earlier pictures.
    static FLAT: Cell<Vec<DiscBatch<Dot>>> = const { Cell::new(Vec::new()) };
    static DEEP: Cell<Vec<DiscBatch<Disc>>> = const { Cell::new(Vec::new()) };
}

/// The particles alone, without text: what a terminal shows, or a test compares. `width` and
/// `height` in pixels.
#[must_use]
pub fn field(points: &Points, home: &Home, look: &Look, width: usize, height: usize) -> Raster {
    let mut raster = Raster::new(width, height, Rgb(0));
    let rect = raster.rect();
    paint(&mut raster.draw(), rect, points, home, look);
    raster
}

/// Draws the particles and the background into a rectangle.
pub(crate) fn paint(
    raster: &mut Pixels<'_>,
    rect: Rect,
    points: &Points,
    home: &Home,
    look: &Look,
) {
    let rect = rect.clipped(raster.width(), raster.height());
    if rect.width == 0 || rect.height == 0 {
        return;
    }
    let scene = FieldPainting {
        points,
        home,
        look,
        rect,
        projection: Projection::new(home, &look.view, rect.width, rect.height),
    };
    let background = look.theme.background;
    if home.dimension == 2 {
        let mut pieces = FLAT.take();
        let brush = scene.flat(&mut pieces);
        bands::draw_bands(raster, rect, |canvas| {
            flat::draw(canvas, &pieces, &brush, background);
        });
        FLAT.set(pieces);
    } else {
        let mut pieces = DEEP.take();
        raster.fill(rect, background, 255);
        scene.edges(raster);
        let stamps = scene.deep(&mut pieces);
        bands::draw_bands(raster, rect, |canvas| deep::draw(canvas, &pieces, &stamps));
        DEEP.set(pieces);
    }
}

struct FieldPainting<'a> {
    points: &'a Points,
    home: &'a Home,
    look: &'a Look,
    rect: Rect,
    projection: Projection,
}

impl FieldPainting<'_> {
    fn painter(&self) -> Painter<'_> {
        let look = self.look;
        Painter::new(
            &look.colouring,
            look.palette(),
            look.range
                .unwrap_or_else(|| look.colouring.range(self.home)),
        )
    }

    /// Radius of a particle, m: that of a disc or ball of its volume, times the look's factor.
    fn radius(&self) -> f64 {
        let pi = std::f64::consts::PI;
        let of_volume = match self.home.dimension {
            2 => 1.0 / pi.sqrt(),
            _ => libm::cbrt(0.75 / pi),
        };
        of_volume * self.home.spacing * self.look.disc
    }

    /// Width and height of the rectangle.
    fn size(&self) -> [f64; 2] {
        [self.rect.width as f64, self.rect.height as f64]
    }

    /// The discs of a plane scene, the walls in the first piece; and what all of them are drawn
    /// with.
    fn flat(&self, pieces: &mut Vec<DiscBatch<Dot>>) -> Brush {
        /// Particles whose places on the screen are worked out together.
        const RUN: usize = 64;
        let scale = self.projection.scale();
        let radius = (self.radius() * scale).max(SMALLEST);
        let spacing = self.home.spacing * scale;
        let area = std::f64::consts::PI * radius * radius;
        let brush = Brush::new(radius, area / (spacing * spacing));
        let painter = self.painter();
        let axes = self
            .projection
            .along_axes()
            .map(|axis| axis.map(|a| a * f64::from(PARTS)));
        let width = self.rect.width;
        let bands = bands::count(self.rect.height);
        let points = self.points;
        let count = points.len().div_ceil(PIECE);
        pieces.resize_with(1 + count, DiscBatch::default);
        pieces.par_iter_mut().enumerate().for_each(|(n, piece)| {
            piece.clear(bands);
            if n == 0 {
                for [x, y, _] in &points.wall_position {
                    let (x, y) = (parts(*x, axes[0]), parts(*y, axes[1]));
                    brush.lay(piece, width, x, y, self.look.theme.wall);
                }
                return;
            }
            let end = (n * PIECE).min(points.len());
            let mut colours = [Rgb(0); RUN];
            let mut places = [[0; RUN]; 2];
            wide(
                #[inline(always)]
                || {
                    for first in ((n - 1) * PIECE..end).step_by(RUN) {
                        let run = RUN.min(end - first);
                        for (axis, places) in places.iter_mut().enumerate() {
                            let list = &points.position[axis][first..first + run];
                            for (place, &x) in places.iter_mut().zip(list) {
                                *place = parts(x, axes[axis]);
                            }
                        }
                        painter.colours(points, self.home, first, &mut colours[..run]);
                        let [x, y] = &places;
                        for ((&x, &y), &colour) in x.iter().zip(y).zip(&colours[..run]) {
                            brush.lay(piece, width, x, y, colour);
                        }
                    }
                },
            );
        });
        brush
    }

    /// The discs of a scene in space from the farthest to the nearest, and their stamps.
    fn deep(&self, pieces: &mut Vec<DiscBatch<Disc>>) -> Vec<Stamp> {
        let painter = self.painter();
        let radius = self.radius();
        let background = self.look.theme.background;
        let mut levels: Vec<u32> = vec![level(SMALLEST)];
        let mut discs: Vec<Disc> = Vec::new();
        let faint = self.wall_weight();
        for x in &self.points.wall_position {
            let Some(p) = self.projection.project(x.map(f64::from)) else {
                continue;
            };
            if let Some(disc) = disc(p.x, p.y, SMALLEST, self.size()) {
                discs.push(Disc {
                    colour: self.look.theme.faint,
                    weight: faint,
                    ..disc
                });
            }
        }
        let points = self.points;
        let mut balls: Vec<(f64, u64, u32, Disc)> = (0..points.len())
            .into_par_iter()
            .with_min_len(PIECE / 4)
            .filter_map(|n| {
                let p = self.projection.project(points.at(n))?;
                let size = (radius * p.scale).max(SMALLEST);
                let disc = disc(p.x, p.y, size, self.size())?;
                let haze = HAZE * self.projection.part_of_depth(p.depth);
                let colour = painter
                    .colour(points, self.home, n)
                    .mix(background, haze as u8);
                let id = points.id.get(n).map_or(n as u64, |&id| id);
                Some((p.depth, id, level(size), Disc { colour, ..disc }))
            })
            .collect();
        // Equal depths in the order of the ids.
        balls.par_sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        levels.extend(balls.iter().map(|ball| ball.2));
        levels.sort_unstable();
        levels.dedup();
        let stamp = |level: u32| levels.binary_search(&level).unwrap_or(0) as u16;
        let smallest = stamp(level(SMALLEST));
        discs.iter_mut().for_each(|disc| disc.stamp = smallest);
        discs.extend(balls.into_iter().map(|(_, _, level, disc)| Disc {
            stamp: stamp(level),
            ..disc
        }));
        let stamps: Vec<Stamp> = levels
            .par_iter()
            .map(|&level| Stamp::new(radius_of(level), true))
            .collect();
        let (width, bands) = (self.rect.width, bands::count(self.rect.height));
        pieces.resize_with(discs.len().div_ceil(PIECE), DiscBatch::default);
        pieces
            .par_iter_mut()
            .zip(discs.par_chunks(PIECE))
            .for_each(|(piece, discs)| {
                piece.clear(bands);
                for disc in discs {
                    disc.lay(piece, width, &stamps[usize::from(disc.stamp)]);
                }
            });
        stamps
    }

    /// Corners of the box around the walls, on the screen.
    fn corners(&self) -> Vec<Option<Projected>> {
        let Some(walls) = self.home.walls else {
            return Vec::new();
        };
        let corner = |n: usize| -> [f64; 3] {
            std::array::from_fn(|k| [walls.low[k], walls.high[k]][n >> k & 1])
        };
        (0..8).map(|n| self.projection.project(corner(n))).collect()
    }

    /// Weight of a wall particle: in a small picture many of them fall on a pixel, and together
    /// they are to be no fog.
    fn wall_weight(&self) -> u8 {
        let corners: Vec<Projected> = self.corners().into_iter().flatten().collect();
        let side = |place: fn(&Projected) -> f64| {
            let ends = corners.iter().map(place);
            let low = ends.clone().fold(f64::INFINITY, f64::min);
            (ends.fold(f64::NEG_INFINITY, f64::max) - low).max(1.0)
        };
        let area = side(|p| p.x) * side(|p| p.y);
        let disc = std::f64::consts::PI * SMALLEST * SMALLEST;
        let on_a_pixel = (self.points.wall_position.len() as f64 * disc / area).max(1e-3);
        let veil = 1.0 - libm::pow(1.0 - VEIL, 1.0 / on_a_pixel);
        (255.0 * veil).clamp(1.0, FAINT) as u8
    }

    /// The edges of the box around the walls, all of them behind the fluid: those on the near side
    /// are fainter.
    fn edges(&self, raster: &mut Pixels<'_>) {
        let projected = self.corners();
        // The three edges at the corner nearest to the camera are on the near side.
        let shown = (0..projected.len()).filter(|&n| projected[n].is_some());
        let nearest = shown.min_by(|&a, &b| {
            let depth = |n: usize| projected[n].map_or(f64::INFINITY, |p| p.depth);
            depth(a).total_cmp(&depth(b))
        });
        let width = (self.rect.height as f64 / 360.0).clamp(1.0, 6.0);
        for (near, weight) in [(false, 130), (true, 70)] {
            let mut mask = Mask::new(self.rect);
            for a in 0..projected.len() {
                for b in [a | 1, a | 2, a | 4] {
                    let is_near = Some(a) == nearest || Some(b) == nearest;
                    if b == a || is_near != near {
                        continue;
                    }
                    if let (Some(p), Some(q)) = (projected[a], projected[b]) {
                        let (x, y) = (self.rect.x as f64, self.rect.y as f64);
                        mask.line([p.x + x, p.y + y], [q.x + x, q.y + y], width);
                    }
                }
            }
            mask.paint(raster, self.look.theme.faint, weight);
        }
    }
}

/// A disc, unless it lies outside of a rectangle of this width and height.
#[inline]
fn disc(x: f64, y: f64, radius: f64, [width, height]: [f64; 2]) -> Option<Disc> {
    let reach = radius + 2.0;
    let inside = x > -reach && y > -reach && x < width + reach && y < height + reach;
    let parts = f64::from(PARTS);
    inside.then(|| Disc {
        x: floor(x * parts),
        y: floor(y * parts),
        colour: Rgb(0),
        stamp: 0,
        weight: 255,
    })
}

/// A coordinate (m) in [`PARTS`] of a pixel, by the factor and summand of its axis, rounded down.
/// What lies too far outside of the picture to be counted is moved nearer, but stays outside.
#[inline(always)]
fn parts(x: f32, [factor, summand]: [f64; 2]) -> i32 {
    const FAR: f64 = 16_777_216.0;
    // Added to 1.5 times 2^52 a number is rounded to a whole one, which stands in its last bits.
    const WHOLE: f64 = 6_755_399_441_055_744.0;
    let part = (f64::from(x) * factor + (summand - 0.5)).clamp(-FAR, FAR);
    (part + WHOLE).to_bits() as i32
}

/// The number rounded down; unlike the function of the library it is no call for each particle.
#[inline]
fn floor(x: f64) -> i32 {
    let whole = x as i32;
    whole - i32::from(f64::from(whole) > x)
}

/// Radii of balls in steps: quarters of a pixel, then whole ones.
fn level(radius: f64) -> u32 {
    if radius <= 16.0 {
        (4.0 * radius).round() as u32
    } else {
        48 + radius.min(crate::stamp::LARGEST).round() as u32
    }
}

fn radius_of(level: u32) -> f64 {
    if level <= 64 {
        0.25 * f64::from(level)
    } else {
        f64::from(level - 48)
    }
}
