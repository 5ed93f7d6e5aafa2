//! The length scale of a picture: a bar with its length.

use crate::camera::Projection;
use crate::colour::Theme;
use crate::raster::{Pixels, Rect};
use crate::text::{self, TextStyle, Weight};
use loschmidt_runner::figures::quantity;

/// A bar of a length that is easily read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ruler {
    /// Its length, m: 1, 2 or 5 times a power of ten.
    pub metres: f64,
    /// Its length on the screen, pixels.
    pub pixels: f64,
}

impl Ruler {
    /// The longest bar of at most so many pixels; in space, in the plane through the middle of the
    /// scene. None where the scale is no number.
    #[must_use]
    pub fn new(projection: &Projection, most: f64) -> Option<Self> {
        let room = most / projection.scale();
        if !(room > 0.0 && room.is_finite()) {
            return None;
        }
        let power = libm::pow(10.0, libm::floor(libm::log10(room)));
        let metres = [5.0, 2.0, 1.0].map(|m| m * power);
        let metres = metres.into_iter().find(|m| *m <= room * 1.000_001)?;
        Some(Self {
            metres,
            pixels: metres * projection.scale(),
        })
    }

    /// Its length for people.
    #[must_use]
    pub fn text(&self) -> String {
        quantity(self.metres, "m", 3)
    }
}

/// Draws the bar in the upper left corner of a field, where fluid is least.
pub(crate) fn paint(
    raster: &mut Pixels<'_>,
    field: Rect,
    projection: &Projection,
    theme: &Theme,
    em: usize,
) {
    let most = (field.width as f64 / 5.0).min(9.0 * em as f64);
    let Some(ruler) = Ruler::new(projection, most) else {
        return;
    };
    let style = TextStyle {
        size: (em * 6 / 7).max(9),
        weight: Weight::Medium,
        colour: theme.text,
    };
    let text = ruler.text();
    let wide = ruler.pixels.round().max(1.0) as usize;
    let plate = Rect::new(
        field.x + em / 2,
        field.y + em / 2,
        wide.max(text::width(&style, &text) as usize) + em,
        5 * em / 2,
    );
    if field.width < plate.width + em || field.height < 4 * plate.height {
        return;
    }
    raster.fill(plate, theme.background, 150);
    let (x, y) = (plate.x + em / 2, plate.y + 2 * em);
    let thick = (em / 10).max(1);
    let tick = em / 3;
    raster.fill(Rect::new(x, y, wide, thick), theme.text, 255);
    for end in [x, x + wide - thick.min(wide)] {
        let end = Rect::new(end, y - tick, thick, 2 * tick + thick);
        raster.fill(end, theme.text, 255);
    }
    let baseline = (plate.y + 5 * em / 4) as i64;
    text::write(raster, &style, x as f64, baseline, &text);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::home::Box3;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn a_ruler_is_as_long_as_it_says_and_readable(
            power in -12.0..12.0,
            zoom in 0.01..100.0,
        ) {
            let size = libm::pow(10.0, power);
            let mut home = crate::framing::tests::home();
            home.shown = Box3 { low: [0.0; 3], high: [size, size, 0.0] };
            let view = crate::View { zoom, ..crate::View::default() };
            let projection = Projection::new(&home, &view, 400, 300);
            let ruler = Ruler::new(&projection, 100.0).expect("a ruler");
            prop_assert!((40.0..=100.1).contains(&ruler.pixels), "{:?}", ruler);
            prop_assert!((ruler.pixels / ruler.metres / projection.scale() - 1.0).abs() < 1e-9);
            let digits: String = ruler.text().chars().filter(char::is_ascii_digit).collect();
            let digits = digits.trim_matches('0');
            prop_assert!(matches!(digits, "1" | "2" | "5"), "{}", ruler.text());
        }
    }
}
