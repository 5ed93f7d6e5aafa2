//! What can be told from the ground: contrast, and the part of a colour map that has enough of it.
//!
//! The contrast of two colours is (L₁ + 0.05)/(L₂ + 0.05), L₁ the larger of their relative
//! luminances (Web Content Accessibility Guidelines 2.2, relative luminance and criterion 1.4.11):
//! what is to be seen needs 3.

use super::{Colormap, Rgb};

/// Contrast that everything drawn with a map has with the ground.
pub const ENOUGH: f64 = 3.0;

/// Parts of a map that are looked at.
const PARTS: u32 = 256;

impl Rgb {
    /// Relative luminance, 0 for black and 1 for white.
    #[must_use]
    pub fn luminance(self) -> f64 {
        let linear = |channel: u8| {
            let c = f64::from(channel) / 255.0;
            if c <= 0.040_45 {
                c / 12.92
            } else {
                libm::pow((c + 0.055) / 1.055, 2.4)
            }
        };
        let [r, g, b] = self.channels().map(linear);
        0.2126 * r + 0.7152 * g + 0.0722 * b
    }

    /// Contrast with another colour, from 1 to 21.
    #[must_use]
    pub fn contrast(self, other: Self) -> f64 {
        let (a, b) = (self.luminance(), other.luminance());
        (a.max(b) + 0.05) / (a.min(b) + 0.05)
    }
}

/// The part of a colour map that can be told from a ground, spread over the numbers 0 to 1: fluid at
/// rest, at an end of the map or in its middle, is seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Palette {
    map: Colormap,
    /// Weight of black, of 255.
    shade: u8,
    /// Where it begins and ends in the map.
    ends: [f64; 2],
}

impl Colormap {
    /// The part of the map that can be told from this ground.
    #[must_use]
    pub fn over(self, ground: Rgb) -> Palette {
        let seen = |x: f64, shade: u8| {
            let colour = self.at(x).mix(Rgb(0), shade);
            colour.contrast(ground) >= ENOUGH
        };
        // On a light ground the middle of a map with a light middle has to be darker.
        let shade = (0..200).step_by(4).find(|&shade| seen(0.5, shade));
        let shade = shade.unwrap_or(0);
        let parts = |from: u32| f64::from(from) / f64::from(PARTS);
        let half = PARTS / 2;
        let below = (0..half).rev().find(|&n| !seen(parts(n), shade));
        let above = (half..=PARTS).find(|&n| !seen(parts(n), shade));
        let low = below.map_or(0.0, |n| parts(n + 1));
        let high = above.map_or(1.0, |n| parts(n - 1));
        let ends = match self {
            // Its middle stays the middle.
            Self::CoolWarm => {
                let reach = (0.5 - low).min(high - 0.5);
                [0.5 - reach, 0.5 + reach]
            }
            _ => [low, high],
        };
        Palette {
            map: self,
            shade,
            ends,
        }
    }
}

impl Palette {
    /// The colour of a number from 0 to 1; beyond, that of the nearer end, and of NaN that of 0.
    #[must_use]
    pub fn at(self, x: f64) -> Rgb {
        let [low, high] = self.ends;
        let part = if x > 0.0 { x.min(1.0) } else { 0.0 };
        self.map
            .at(low + (high - low) * part)
            .mix(Rgb(0), self.shade)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::colour::Theme;

    #[test]
    fn every_colour_of_every_map_is_seen_on_either_ground() {
        for ground in [Theme::DARK.background, Theme::LIGHT.background] {
            for map in Colormap::ALL {
                let palette = map.over(ground);
                for n in 0..=1000 {
                    let colour = palette.at(f64::from(n) / 1000.0);
                    let contrast = colour.contrast(ground);
                    assert!(contrast > 0.98 * ENOUGH, "{map:?} {n}: {contrast}");
                }
                // What is left of it is still a map.
                let ends = palette.at(0.0).contrast(palette.at(1.0));
                let [low, high] = palette.ends;
                assert!(high - low > 0.5, "{map:?} {palette:?} {ends}");
            }
        }
    }

    #[test]
    fn contrast_is_that_of_the_guidelines() {
        let (black, white) = (Rgb(0), Rgb(0xff_ff_ff));
        assert!((black.contrast(white) - 21.0).abs() < 1e-9);
        assert!((Rgb(0x76_76_76).contrast(white) - 4.54).abs() < 0.01);
    }
}
