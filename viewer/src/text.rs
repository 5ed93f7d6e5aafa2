//! Text in the embedded font, Inter (SIL Open Font License, `assets/OFL.txt`), with smooth edges.
//!
//! Sizes are those of the em in whole pixels. Digits are all as wide as a zero, so that numbers
//! that change do not tremble.

use crate::colour::Rgb;
use crate::raster::Pixels;
use ab_glyph::{Font, FontRef, Glyph, GlyphId, point};
use std::cell::RefCell;
use std::collections::HashMap;
use std::rc::Rc;
use std::sync::LazyLock;

/// Thickness of the strokes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Weight {
    /// For most.
    #[default]
    Medium,
    /// For titles.
    SemiBold,
}

/// How text is set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TextStyle {
    /// The em, pixels.
    pub size: usize,
    /// Thickness.
    pub weight: Weight,
    /// Colour.
    pub colour: Rgb,
}

static MEDIUM: LazyLock<Option<FontRef<'static>>> =
    LazyLock::new(|| FontRef::try_from_slice(include_bytes!("../assets/Inter-Medium.otf")).ok());
static SEMI_BOLD: LazyLock<Option<FontRef<'static>>> =
    LazyLock::new(|| FontRef::try_from_slice(include_bytes!("../assets/Inter-SemiBold.otf")).ok());

/// The pixels of a glyph that has been drawn once.
struct Drawn {
    left: i64,
    top: i64,
    width: usize,
    coverage: Vec<u8>,
}

/// Glyphs kept at most; the sizes of a window that is being resized are many.
const KEPT: usize = 4096;

/// Places within a pixel that are told apart.
const PLACES: f64 = 4.0;

type GlyphKey = (Weight, u16, usize, u8);

thread_local! {
    static GLYPHS: RefCell<HashMap<GlyphKey, Rc<Drawn>>> = RefCell::default();
}

fn font(weight: Weight) -> Option<&'static FontRef<'static>> {
    match weight {
        Weight::Medium => MEDIUM.as_ref(),
        Weight::SemiBold => SEMI_BOLD.as_ref(),
    }
}

/// Pixels per unit of the font.
fn unit(font: &FontRef<'_>, size: usize) -> f64 {
    size as f64 / f64::from(font.units_per_em().unwrap_or(1000.0))
}

fn advance(font: &FontRef<'_>, glyph: GlyphId, size: usize) -> f64 {
    f64::from(font.h_advance_unscaled(glyph)) * unit(font, size)
}

/// Glyphs, and where they begin, pixels from the start of the line; and where the line ends.
fn line(font: &FontRef<'_>, size: usize, text: &str) -> (Vec<(GlyphId, f64)>, f64) {
    let mut x = 0.0;
    let mut glyphs = Vec::new();
    let digit = advance(font, font.glyph_id('0'), size);
    for c in text.chars() {
        let glyph = font.glyph_id(c);
        let width = advance(font, glyph, size);
        if c.is_ascii_digit() {
            glyphs.push((glyph, x + 0.5 * (digit - width)));
            x += digit;
        } else {
            glyphs.push((glyph, x));
            x += width;
        }
    }
    (glyphs, x)
}

/// Width of a text, pixels.
#[must_use]
pub fn width(style: &TextStyle, text: &str) -> f64 {
    font(style.weight).map_or(0.0, |font| line(font, style.size, text).1)
}

/// Writes a text that begins at `x` on the baseline `y`, pixels from the top left; returns where it
/// ends.
pub fn write(raster: &mut Pixels<'_>, style: &TextStyle, x: f64, y: i64, text: &str) -> f64 {
    let Some(font) = font(style.weight) else {
        return x;
    };
    let (glyphs, end) = line(font, style.size, text);
    for (glyph, offset) in glyphs {
        let at = ((x + offset) * PLACES).round();
        let place = at.rem_euclid(PLACES);
        let column = ((at - place) / PLACES) as i64;
        let drawn = drawn((style.weight, glyph.0, style.size, place as u8), font);
        for (row, line) in drawn.coverage.chunks(drawn.width.max(1)).enumerate() {
            for (k, &coverage) in line.iter().enumerate() {
                if coverage > 0 {
                    let x = column + drawn.left + k as i64;
                    raster.blend(x, y + drawn.top + row as i64, style.colour, coverage);
                }
            }
        }
    }
    x + end
}

/// Writes a text that ends at `x`.
pub fn write_left_of(raster: &mut Pixels<'_>, style: &TextStyle, x: f64, y: i64, text: &str) {
    write(raster, style, x - width(style, text), y, text);
}

/// Writes a text with its middle at `x`.
pub fn write_around(raster: &mut Pixels<'_>, style: &TextStyle, x: f64, y: i64, text: &str) {
    write(raster, style, x - 0.5 * width(style, text), y, text);
}

/// The text, or as much of its beginning as fits into `room` pixels, with an ellipsis.
#[must_use]
pub fn fitted(style: &TextStyle, text: &str, room: f64) -> String {
    if width(style, text) <= room {
        return text.to_owned();
    }
    let mut short: Vec<char> = text.chars().collect();
    while short.pop().is_some() {
        let candidate = short.iter().collect::<String>().trim_end().to_owned() + "…";
        if width(style, &candidate) <= room {
            return candidate;
        }
    }
    String::new()
}

fn drawn(key: GlyphKey, font: &FontRef<'_>) -> Rc<Drawn> {
    GLYPHS.with_borrow_mut(|glyphs| {
        if glyphs.len() > KEPT {
            glyphs.clear();
        }
        Rc::clone(
            glyphs
                .entry(key)
                .or_insert_with(|| Rc::new(rasterise(key, font))),
        )
    })
}

fn rasterise((_, glyph, size, place): GlyphKey, font: &FontRef<'_>) -> Drawn {
    // The crate measures sizes from the deepest to the highest stroke of the font.
    let scale = (f64::from(font.height_unscaled()) * unit(font, size)) as f32;
    let position = point(f32::from(place) / PLACES as f32, 0.0);
    let glyph: Glyph = GlyphId(glyph).with_scale_and_position(scale, position);
    let Some(outline) = font.outline_glyph(glyph) else {
        return Drawn {
            left: 0,
            top: 0,
            width: 0,
            coverage: Vec::new(),
        };
    };
    let bounds = outline.px_bounds();
    let (width, height) = (bounds.width() as usize, bounds.height() as usize);
    let mut coverage = vec![0; width * height];
    outline.draw(|x, y, c| {
        if let Some(pixel) = coverage.get_mut(y as usize * width + x as usize) {
            *pixel = (c.clamp(0.0, 1.0) * 255.0 + 0.5) as u8;
        }
    });
    Drawn {
        left: bounds.min.x as i64,
        top: bounds.min.y as i64,
        width,
        coverage,
    }
}
