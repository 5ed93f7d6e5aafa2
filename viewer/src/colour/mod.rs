//! Colours, colour maps and themes. Colours are mixed in integers; which part of a map can be told
//! from a ground is a matter of `contrast`.

mod contrast;
mod tables;

pub use contrast::{ENOUGH, Palette};

use tables::{CIVIDIS, COOLWARM, MAGMA, VIRIDIS};

/// A colour, `0x00RRGGBB`, in sRGB.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Rgb(pub u32);

impl Rgb {
    /// Red, green and blue, 0 to 255.
    #[must_use]
    pub fn channels(self) -> [u8; 3] {
        let [_, r, g, b] = self.0.to_be_bytes();
        [r, g, b]
    }

    /// The colour of these channels.
    #[must_use]
    pub fn of([r, g, b]: [u8; 3]) -> Self {
        Self(u32::from_be_bytes([0, r, g, b]))
    }

    /// This colour, and the other one with a weight of `alpha` / 255, rounded to the nearest.
    #[must_use]
    pub fn mix(self, other: Self, alpha: u8) -> Self {
        let (new, old) = (u32::from(alpha), 255 - u32::from(alpha));
        // Red and blue share a word. With s = x + 128, (s + s/256)/256 is x/255 to the nearest
        // for every x up to 255², and stays within its 16 bits.
        const TWO: u32 = 0xff_00ff;
        let s = (self.0 & TWO) * old + (other.0 & TWO) * new + 0x80_0080;
        let red_blue = ((s + (s >> 8 & TWO)) >> 8) & TWO;
        let s = (self.0 >> 8 & 255) * old + (other.0 >> 8 & 255) * new + 128;
        let green = (s + (s >> 8)) >> 8;
        Self(red_blue | green << 8)
    }
}

/// A map from the numbers 0 to 1 to colours.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Colormap {
    /// Blue, green, yellow.
    #[default]
    Viridis,
    /// Purple, orange, yellow: the map without its black and white ends, which would be lost on a
    /// dark or light ground.
    Magma,
    /// Blue, grey, yellow: the same to eyes that do not tell red from green.
    Cividis,
    /// Blue, grey, red: for numbers with a middle.
    CoolWarm,
}

impl Colormap {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Viridis, Self::Magma, Self::Cividis, Self::CoolWarm];

    /// The name used on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Viridis => "viridis",
            Self::Magma => "magma",
            Self::Cividis => "cividis",
            Self::CoolWarm => "coolwarm",
        }
    }

    /// The map of this name.
    #[must_use]
    pub fn by_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|map| map.name() == name)
    }

    /// The colour of a number from 0 to 1; beyond, that of the nearer end, and of NaN that of 0.
    #[must_use]
    pub fn at(self, x: f64) -> Rgb {
        let table = match self {
            Self::Viridis => &VIRIDIS,
            Self::Magma => &MAGMA,
            Self::Cividis => &CIVIDIS,
            Self::CoolWarm => &COOLWARM,
        };
        let steps = table.len() - 1;
        let x = match self {
            Self::Magma => 0.15 + 0.8 * x.clamp(0.0, 1.0),
            _ => x.clamp(0.0, 1.0),
        };
        // The conversion takes NaN to 0.
        let x = (x * (steps * 256) as f64) as usize;
        let (n, rest) = (x / 256, x % 256);
        let next = table[(n + 1).min(steps)];
        Rgb(table[n]).mix(Rgb(next), rest as u8)
    }
}

/// Colours of everything that is not fluid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Theme {
    /// Behind the fluid.
    pub background: Rgb,
    /// Behind plots and text.
    pub panel: Rgb,
    /// Lines between the parts of the picture.
    pub rule: Rgb,
    /// Text.
    pub text: Rgb,
    /// Text of less weight.
    pub faint: Rgb,
    /// Walls.
    pub wall: Rgb,
    /// Time on the way out, and the first curve of a plot.
    pub forward: Rgb,
    /// Time on the way back.
    pub backward: Rgb,
    /// Second curve of a plot.
    pub second: Rgb,
    /// Third curve of a plot.
    pub third: Rgb,
}

impl Theme {
    /// Light on dark.
    pub const DARK: Self = Self {
        background: Rgb(0x0b_0f_17),
        panel: Rgb(0x11_17_22),
        rule: Rgb(0x2a_33_42),
        text: Rgb(0xe8_ee_f5),
        faint: Rgb(0x8a_97_a8),
        wall: Rgb(0x3a_45_57),
        forward: Rgb(0x56_b4_e9),
        backward: Rgb(0xf0_a8_30),
        second: Rgb(0x2f_c5_a0),
        third: Rgb(0xd9_8c_c0),
    };

    /// Dark on light.
    pub const LIGHT: Self = Self {
        background: Rgb(0xff_ff_ff),
        panel: Rgb(0xf3_f5_f8),
        rule: Rgb(0xd2_d8_e0),
        text: Rgb(0x17_1e_29),
        faint: Rgb(0x5d_6b_7c),
        wall: Rgb(0xa9_b3_c0),
        forward: Rgb(0x00_72_b2),
        backward: Rgb(0xc2_5a_00),
        second: Rgb(0x00_8a_67),
        third: Rgb(0xa8_4f_8b),
    };
}

impl Default for Theme {
    fn default() -> Self {
        Self::DARK
    }
}

#[cfg(test)]
mod tests {
    use super::Rgb;

    #[test]
    fn mixing_rounds_every_channel_to_the_nearest() {
        for old in (0..=255u32).step_by(5) {
            for new in 0..=255u32 {
                for alpha in 0..=255u32 {
                    let expected = (old * (255 - alpha) + new * alpha + 127) / 255;
                    let channels = |c: u32, d: u32| Rgb(c << 16 | d << 8 | c);
                    let mixed = channels(old, new).mix(channels(new, old), alpha as u8);
                    let reverse = (new * (255 - alpha) + old * alpha + 127) / 255;
                    assert_eq!(mixed, channels(expected, reverse), "{old} {new} {alpha}");
                }
            }
        }
    }
}
