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

/// Whether these are the bytes of a whole picture of this size: every piece of the file has the
/// checksum that stands behind it, and the last one is the end.
#[must_use]
pub fn is_whole(bytes: &[u8], size: (usize, usize)) -> bool {
    let Some(mut rest) = bytes.strip_prefix(b"\x89PNG\r\n\x1a\n") else {
        return false;
    };
    let word = |bytes: &[u8]| bytes.first_chunk::<4>().map(|b| u32::from_be_bytes(*b));
    let mut is_first = true;
    // Length, kind, content, checksum of kind and content.
    while let Some(length) = word(rest) {
        let Some((piece, after)) = rest[4..].split_at_checked(4 + length as usize) else {
            return false;
        };
        if word(after) != Some(checksum(piece)) {
            return false;
        }
        rest = &after[4..];
        let (kind, content) = piece.split_at(4);
        if std::mem::take(&mut is_first) {
            let side = |at: usize| content.get(at..).and_then(word).map(|n| n as usize);
            if kind != b"IHDR" || (side(0), side(4)) != (Some(size.0), Some(size.1)) {
                return false;
            }
        }
        if kind == b"IEND" {
            return rest.is_empty();
        }
    }
    false
}

/// The cyclic redundancy check of PNG, with the polynomial edb88320.
fn checksum(bytes: &[u8]) -> u32 {
    const TABLE: [u32; 256] = {
        let mut table = [0; 256];
        let mut n = 0;
        while n < 256 {
            let mut c = n as u32;
            let mut bit = 0;
            while bit < 8 {
                c = if c & 1 == 1 {
                    0xedb8_8320 ^ (c >> 1)
                } else {
                    c >> 1
                };
                bit += 1;
            }
            table[n] = c;
            n += 1;
        }
        table
    };
    !bytes.iter().fold(!0, |sum: u32, byte| {
        TABLE[usize::from(sum as u8 ^ byte)] ^ (sum >> 8)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::colour::Rgb;

    #[test]
    fn a_picture_with_any_byte_changed_or_cut_off_is_not_whole() {
        let mut raster = Raster::new(7, 5, Rgb(0x12_34_56));
        raster.draw().blend(3, 2, Rgb(0xff_00_80), 255);
        let mut bytes = Vec::new();
        write(&raster, &mut bytes).expect("a picture");
        assert!(is_whole(&bytes, (7, 5)));
        assert!(!is_whole(&bytes, (5, 7)));
        for n in 0..bytes.len() {
            assert!(!is_whole(&bytes[..n], (7, 5)), "{n}");
            let mut other = bytes.clone();
            other[n] ^= 1;
            assert!(!is_whole(&other, (7, 5)), "{n}");
        }
        bytes.push(0);
        assert!(!is_whole(&bytes, (7, 5)));
    }
}
