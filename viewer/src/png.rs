//! Rasters as PNG files, 8 bits per channel, without transparency.

use crate::raster::Raster;
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder, ImageError};
use std::io::Write;

/// Writes a picture.
///
/// # Errors
/// What `to` reports.
pub fn write(raster: &Raster, to: impl Write) -> Result<(), ImageError> {
    let size = |n: usize| u32::try_from(n).unwrap_or(u32::MAX);
    let (width, height) = (size(raster.width()), size(raster.height()));
    PngEncoder::new_with_quality(to, CompressionType::Fast, FilterType::Adaptive).write_image(
        &raster.rgb(),
        width,
        height,
        ExtendedColorType::Rgb8,
    )
}
