//! A movie as a GIF.
//!
//! One palette serves all pictures: the colours that cover much of them (grounds, walls, text) as
//! they are, and the rest by a self-organising network (A. Dekker, *Kohonen neural networks for
//! optimal colour quantization*, Network: Computation in Neural Systems 5 (1994) 351-367) over
//! samples of all pictures. A picture stores only what has changed since the one before. A GIF
//! counts time in hundredths of a second: delays are rounded so that their sum stays right. The
//! last picture stays for a while.

use super::directory::{Movie, read_picture, replace};
use super::error::MovieError;
use super::target;
use crate::colour::Rgb;
use crate::raster::Raster;
use color_quant::NeuQuant;
use gif::{DisposalMethod, Encoder, Frame, Repeat};
use std::collections::HashMap;
use std::path::Path;

/// Colours that are taken as they are, at most.
const EXACT: usize = 48;

/// One in so many pixels that a colour must cover for that.
const RARE: usize = 2000;

/// Pictures that the palette is made of.
const SAMPLES: usize = 24;

/// Number of the palette that stands for "as before".
const AS_BEFORE: u8 = 255;

/// How long the last picture stays, in hundredths of a second.
const REST: u16 = 150;

/// Writes the pictures of a finished movie as a GIF that repeats for ever.
///
/// # Errors
/// A picture cannot be read, or the file not be written; it exists and `force` is not given.
pub fn write(movie: &Movie, to: &Path, force: bool) -> Result<(), MovieError> {
    target::check(to, force)?;
    let pictures: Vec<_> = movie.pictures().collect();
    let step = pictures.len().div_ceil(SAMPLES).max(1);
    let samples: Vec<Raster> = pictures
        .iter()
        .step_by(step)
        .map(|path| read_picture(path))
        .collect::<Result<_, _>>()?;
    let mut palette = Palette::new(&samples);
    drop(samples);
    let (width, height) = movie.style.size;
    let small = |n: usize| u16::try_from(n).unwrap_or(u16::MAX);
    replace(to, |file| {
        let other = std::io::Error::other;
        let mut encoder =
            Encoder::new(file, small(width), small(height), &palette.bytes()).map_err(other)?;
        encoder.set_repeat(Repeat::Infinite).map_err(other)?;
        let mut before: Option<Vec<u8>> = None;
        for (n, path) in pictures.iter().enumerate() {
            let raster = read_picture(path).map_err(std::io::Error::other)?;
            let indices: Vec<u8> = raster
                .pixels()
                .iter()
                .map(|&pixel| palette.index(Rgb(pixel)))
                .collect();
            let mut frame = changes(before.as_deref(), &indices, width);
            frame.delay = delay(n, movie.style.fps);
            if n + 1 == pictures.len() {
                frame.delay += REST;
            }
            encoder.write_frame(&frame).map_err(other)?;
            before = Some(indices);
        }
        Ok(())
    })
}

/// How long a picture stays, in hundredths of a second.
fn delay(n: usize, fps: u32) -> u16 {
    let at = |n: usize| (100.0 * n as f64 / f64::from(fps)).round();
    (at(n + 1) - at(n)) as u16
}

/// The smallest rectangle with all changes, and in it `AS_BEFORE` where nothing has changed.
fn changes(before: Option<&[u8]>, now: &[u8], width: usize) -> Frame<'static> {
    let small = |n: usize| u16::try_from(n).unwrap_or(u16::MAX);
    let height = now.len() / width.max(1);
    let Some(before) = before else {
        return Frame {
            width: small(width),
            height: small(height),
            buffer: now.to_vec().into(),
            dispose: DisposalMethod::Keep,
            ..Frame::default()
        };
    };
    let changed = |x: usize, y: usize| before[y * width + x] != now[y * width + x];
    let rows = || (0..height).filter(|&y| (0..width).any(|x| changed(x, y)));
    let columns = || (0..width).filter(|&x| (0..height).any(|y| changed(x, y)));
    // Without a change, one pixel that is as before.
    let (top, bottom) = (rows().next().unwrap_or(0), rows().next_back().unwrap_or(0));
    let (left, right) = (
        columns().next().unwrap_or(0),
        columns().next_back().unwrap_or(0),
    );
    let buffer: Vec<u8> = (top..=bottom)
        .flat_map(|y| (left..=right).map(move |x| (x, y)))
        .map(|(x, y)| {
            if changed(x, y) {
                now[y * width + x]
            } else {
                AS_BEFORE
            }
        })
        .collect();
    Frame {
        left: small(left),
        top: small(top),
        width: small(right + 1 - left),
        height: small(bottom + 1 - top),
        transparent: Some(AS_BEFORE),
        dispose: DisposalMethod::Keep,
        buffer: buffer.into(),
        ..Frame::default()
    }
}

/// 255 colours, and the nearest of them to every colour asked for so far.
struct Palette {
    colours: Vec<Rgb>,
    nearest: HashMap<u32, u8>,
}

impl Palette {
    fn new(samples: &[Raster]) -> Self {
        let mut counts: HashMap<u32, usize> = HashMap::new();
        let mut pixels = 0;
        for raster in samples {
            for &pixel in raster.pixels() {
                *counts.entry(pixel).or_default() += 1;
                pixels += 1;
            }
        }
        let mut counts: Vec<(u32, usize)> = counts.into_iter().collect();
        // By count, and equal counts by colour, so that the palette is the same every time.
        counts.sort_unstable_by_key(|&(colour, count)| (std::cmp::Reverse(count), colour));
        let common = counts
            .iter()
            .take(EXACT)
            .take_while(|(_, count)| count * RARE >= pixels)
            .count();
        let mut colours: Vec<Rgb> = counts[..common].iter().map(|c| Rgb(c.0)).collect();
        let room = usize::from(AS_BEFORE) - colours.len();
        let rest = &mut counts[common..];
        if rest.len() <= room {
            colours.extend(rest.iter().map(|c| Rgb(c.0)));
        } else {
            rest.sort_unstable();
            // The root of the count keeps small details in the palette.
            let bytes: Vec<u8> = rest
                .iter()
                .flat_map(|&(colour, count)| {
                    let times = (count as f64).sqrt().ceil() as usize;
                    let [r, g, b] = Rgb(colour).channels();
                    std::iter::repeat_n([r, g, b, 255], times).flatten()
                })
                .collect();
            let network = NeuQuant::new(3, room, &bytes);
            let rgb = network.color_map_rgb();
            let (triples, _) = rgb.as_chunks::<3>();
            colours.extend(triples.iter().take(room).map(|&c| Rgb::of(c)));
        }
        Self {
            colours,
            nearest: HashMap::new(),
        }
    }

    /// The table of the file: 256 colours, the last one never seen.
    fn bytes(&self) -> Vec<u8> {
        let mut bytes: Vec<u8> = self.colours.iter().flat_map(|c| c.channels()).collect();
        bytes.resize(3 * 256, 0);
        bytes
    }

    fn index(&mut self, colour: Rgb) -> u8 {
        let colours = &self.colours;
        *self.nearest.entry(colour.0).or_insert_with(|| {
            let distance = |other: &Rgb| -> i32 {
                let (a, b) = (colour.channels(), other.channels());
                // Eyes are keenest in green and dullest in blue.
                let weights = [3, 6, 2];
                (0..3)
                    .map(|c| {
                        let d = i32::from(a[c]) - i32::from(b[c]);
                        weights[c] * d * d
                    })
                    .sum()
            };
            let nearest = (0..colours.len()).min_by_key(|&n| distance(&colours[n]));
            nearest.unwrap_or(0) as u8
        })
    }
}
