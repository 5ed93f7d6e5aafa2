//! Draws the picture that the movie in the README is tinted with: an hourglass before the rays of a
//! sun.
//!
//!     cargo run --release -p loschmidt-examples --example hourglass -- examples/pictures/hourglass.png
//!
//! A picture for a column twice as high as wide: u runs from 0 to 1, v from 0 at the top to 2.

use loschmidt_viewer::{Raster, Rgb, png};
use std::error::Error;
use std::fs::File;

/// Width in pixels; the height is twice as much.
const WIDTH: usize = 400;

/// Points per pixel and axis that are averaged.
const POINTS: usize = 4;

const RAYS: [Rgb; 2] = [Rgb(0x0b_6e_7a), Rgb(0x14_96_9b)];
const FRAME: Rgb = Rgb(0xff_f1_d0);
const OUTLINE: Rgb = Rgb(0x0a_22_40);
const GLASS: Rgb = Rgb(0xbf_ea_ec);
const SAND: [Rgb; 2] = [Rgb(0xff_b7_2b), Rgb(0xf2_8c_1e)];
const SUN: Rgb = Rgb(0xe8_4a_3c);

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args()
        .nth(1)
        .unwrap_or_else(|| "hourglass.png".to_owned());
    let mut raster = Raster::new(WIDTH, 2 * WIDTH, OUTLINE);
    for (n, pixel) in raster.pixels_mut().iter_mut().enumerate() {
        let mut sum = [0u32; 3];
        for k in 0..POINTS * POINTS {
            let at = |pixel: usize, point: usize| {
                (pixel as f64 + (point as f64 + 0.5) / POINTS as f64) / WIDTH as f64
            };
            let (u, v) = (at(n % WIDTH, k % POINTS), at(n / WIDTH, k / POINTS));
            for (s, c) in sum.iter_mut().zip(colour(u, v).channels()) {
                *s += u32::from(c);
            }
        }
        *pixel = Rgb::of(sum.map(|s| (s / (POINTS * POINTS) as u32) as u8)).0;
    }
    png::write(&raster, File::create(&path)?)?;
    println!("{path}");
    Ok(())
}

fn colour(u: f64, v: f64) -> Rgb {
    let (x, y) = (u - 0.5, v - 1.0);
    const EDGE: f64 = 0.035;
    if block(x, y, 0.0) {
        return FRAME;
    }
    if block(x, y, EDGE) {
        return OUTLINE;
    }
    let side = x.abs();
    let half = width(y.abs());
    if y.abs() < 0.70 && side < half {
        return inside(side, y, half);
    }
    if y.abs() < 0.70 && side < half + EDGE {
        return OUTLINE;
    }
    background(x, y)
}

/// The wooden plates at the top and the bottom.
fn block(x: f64, y: f64, grown: f64) -> bool {
    x.abs() < 0.42 + grown && (y.abs() - 0.77).abs() < 0.07 + grown
}

/// Half the width of the glass at a distance from its neck.
fn width(distance: f64) -> f64 {
    let t = (distance / 0.52).min(1.0);
    0.035 + 0.315 * t * t * (3.0 - 2.0 * t)
}

/// Sand and glass.
fn inside(side: f64, y: f64, half: f64) -> Rgb {
    let above = y < 0.0 && y > -0.42 + 0.25 * side;
    let heap = y > 0.30 + 0.75 * side;
    let stream = y >= 0.0 && side < 0.022;
    if above || heap || stream {
        // Layers, as sand of two colours leaves them.
        let layer = if y > 0.0 {
            y - 0.75 * side
        } else {
            y - 0.25 * side
        };
        let light = (layer * 9.0).floor().rem_euclid(2.0) == 0.0;
        return SAND[usize::from(!light)];
    }
    let shine = side > 0.62 * half && side < 0.78 * half;
    if shine { Rgb(0xff_ff_ff) } else { GLASS }
}

/// Rays, and the sun they come from.
fn background(x: f64, y: f64) -> Rgb {
    let squared = x * x + y * y;
    if squared < 0.40 * 0.40 {
        return SUN;
    }
    let turn = y.atan2(x) / std::f64::consts::TAU;
    RAYS[((turn * 24.0 + 0.5).floor().rem_euclid(2.0)) as usize]
}
