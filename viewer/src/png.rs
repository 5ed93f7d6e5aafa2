//! Rasters as PNG files, 8 bits per channel, without transparency.

use crate::colour::Rgb;
use crate::raster::Raster;
use png::{BitDepth, ColorType, Compression, Decoder, Encoder, Filter, Transformations};
use std::io::{BufRead, Seek, Write};
use thiserror::Error;

/// Why a picture could not be read.
#[derive(Debug, Error)]
pub enum ReadError {
    /// The file cannot be opened.
    #[error(transparent)]
    Io(#[from] std::io::Error),
    /// Not a PNG file, or a damaged one.
    #[error(transparent)]
    Decoding(#[from] png::DecodingError),
    /// More pixels than fit into memory.
    #[error("the picture is too large")]
    TooLarge,
}

/// Writes a picture.
///
/// # Errors
/// What `to` reports.
pub fn write(raster: &Raster, to: impl Write) -> Result<(), png::EncodingError> {
    let size = |n: usize| u32::try_from(n).unwrap_or(u32::MAX);
    let mut encoder = Encoder::new(to, size(raster.width()), size(raster.height()));
    encoder.set_color(ColorType::Rgb);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_compression(Compression::Fast);
    encoder.set_filter(Filter::Adaptive);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&raster.rgb())?;
    writer.finish()
}

/// Reads a picture of any kind; transparent parts are laid over `background`.
///
/// # Errors
/// [`ReadError`].
pub fn read(from: impl BufRead + Seek, background: Rgb) -> Result<Raster, ReadError> {
    let mut decoder = Decoder::new(from);
    decoder.set_transformations(Transformations::normalize_to_color8());
    let mut reader = decoder.read_info()?;
    let size = reader.output_buffer_size().ok_or(ReadError::TooLarge)?;
    let mut bytes = vec![0; size];
    let info = reader.next_frame(&mut bytes)?;
    let samples = info.color_type.samples();
    let (width, height) = (info.width as usize, info.height as usize);
    let pixel = |s: &[u8]| match *s {
        [grey] => Rgb::of([grey; 3]),
        [grey, alpha] => background.mix(Rgb::of([grey; 3]), alpha),
        [r, g, b] => Rgb::of([r, g, b]),
        [r, g, b, alpha] => background.mix(Rgb::of([r, g, b]), alpha),
        _ => background,
    };
    let mut raster = Raster::new(width, height, background);
    let rows = bytes.chunks(info.line_size.max(1));
    for (row, line) in rows.zip(raster.pixels_mut().chunks_mut(width.max(1))) {
        for (s, p) in row.chunks_exact(samples).zip(line) {
            *p = pixel(s).0;
        }
    }
    Ok(raster)
}
