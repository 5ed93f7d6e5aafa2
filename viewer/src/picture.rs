//! A picture to tint the fluid with: laid over the initial state, it travels with the particles.

use crate::colour::Rgb;
use crate::home::Home;
use crate::raster::Raster;
use image::{DynamicImage, ImageDecoder, ImageReader};
use std::io::{BufRead, Seek};
use thiserror::Error;

/// Most pixels that a picture may have.
pub const MOST_PIXELS: u64 = 64_000_000;

/// Why a picture could not be read.
#[derive(Debug, Error)]
pub enum ReadError {
    /// The file cannot be opened.
    #[error(transparent)]
    Io(#[from] std::io::Error),
    /// Its header says that it is larger than [`MOST_PIXELS`].
    #[error(
        "it has {width} x {height} pixels, more than the {} million that are read",
        MOST_PIXELS / 1_000_000
    )]
    TooLarge {
        /// Pixels.
        width: u32,
        /// Pixels.
        height: u32,
    },
    /// Not a picture of a known format, or a damaged one.
    #[error(transparent)]
    Decoding(#[from] image::ImageError),
}

/// Reads a picture in any of the formats of `image` that this package asks for, the right way up;
/// transparent parts are laid over `background`.
///
/// # Errors
/// [`ReadError`].
pub fn read(from: impl BufRead + Seek, background: Rgb) -> Result<Raster, ReadError> {
    let mut decoder = ImageReader::new(from)
        .with_guessed_format()?
        .into_decoder()?;
    // Before memory for them is asked for.
    let (width, height) = decoder.dimensions();
    if u64::from(width) * u64::from(height) > MOST_PIXELS {
        return Err(ReadError::TooLarge { width, height });
    }
    // A camera held upright leaves the turning to whoever reads.
    let orientation = decoder.orientation()?;
    let mut picture = DynamicImage::from_decoder(decoder)?;
    picture.apply_orientation(orientation);
    let picture = picture.into_rgba8();
    let (width, height) = (picture.width() as usize, picture.height() as usize);
    let mut raster = Raster::new(width, height, background);
    for (pixel, from) in raster.pixels_mut().iter_mut().zip(picture.pixels()) {
        let [r, g, b, alpha] = from.0;
        *pixel = background.mix(Rgb::of([r, g, b]), alpha).0;
    }
    Ok(raster)
}

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

#[cfg(test)]
mod tests {
    use super::*;
    use image::ImageFormat;
    use std::io::Cursor;

    /// Four quarters, large enough that a JPEG keeps the colour in the middle of each.
    fn quarters() -> image::RgbImage {
        image::RgbImage::from_fn(64, 32, |x, y| {
            image::Rgb([255 * u8::from(x < 32), 255 * u8::from(y < 16), 64])
        })
    }

    #[test]
    fn a_picture_of_any_common_format_is_read() {
        use ImageFormat::{Bmp, Gif, Jpeg, Png, Pnm, WebP};
        for format in [Bmp, Gif, Jpeg, Png, Pnm, WebP] {
            let mut file = Cursor::new(Vec::new());
            let saved = DynamicImage::from(quarters()).write_to(&mut file, format);
            saved.expect("a file");
            file.set_position(0);
            let raster = read(file, Rgb(0)).expect("a picture");
            assert_eq!((raster.width(), raster.height()), (64, 32), "{format:?}");
            for (x, y) in [(16, 8), (48, 8), (16, 24), (48, 24)] {
                let expected = quarters().get_pixel(x, y).0;
                let found = raster.at(x as usize, y as usize).channels();
                for (a, b) in found.into_iter().zip(expected) {
                    assert!(a.abs_diff(b) <= 3, "{format:?} {found:?} {expected:?}");
                }
            }
        }
    }

    #[test]
    fn what_is_transparent_shows_the_background() {
        let mut file = Cursor::new(Vec::new());
        let clear = image::RgbaImage::from_pixel(2, 1, image::Rgba([9, 9, 9, 0]));
        let saved = DynamicImage::from(clear).write_to(&mut file, ImageFormat::Png);
        saved.expect("a file");
        file.set_position(0);
        let raster = read(file, Rgb(0x12_34_56)).expect("a picture");
        assert_eq!(raster.pixels(), [0x12_34_56; 2]);
    }

    #[test]
    fn what_a_header_claims_is_not_asked_of_the_memory() {
        let pnm = b"P6 60000 60000 255\n".to_vec();
        // A BMP of 24 bits without compression.
        let mut bmp = b"BM".to_vec();
        for word in [
            54,
            0,
            54,
            40,
            60_000,
            60_000,
            24 << 16 | 1,
            0,
            0,
            0,
            0,
            0,
            0_u32,
        ] {
            bmp.extend(word.to_le_bytes());
        }
        for file in [pnm, bmp] {
            let error = read(Cursor::new(file), Rgb(0)).expect_err("an error");
            let text = "it has 60000 x 60000 pixels, more than the 64 million that are read";
            assert_eq!(error.to_string(), text);
        }
    }

    #[test]
    fn what_is_no_picture_is_told() {
        let error = read(Cursor::new(b"no picture"), Rgb(0)).expect_err("an error");
        assert!(matches!(error, ReadError::Decoding(_)), "{error}");
    }
}
