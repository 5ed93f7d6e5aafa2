//! Numbers for people, in one way wherever they are read: tables, progress, pictures, the dashboard,
//! the window, the report.
//!
//! | what | how | such as |
//! |---|---|---|
//! | a number with a unit ([`quantity`]) | significant digits, and an SI prefix instead of zeros | `43.7 nJ`, `0.25 m`, `437 ZJ` |
//! | numbers side by side ([`Scale`]) | one prefix for all, that of the largest, and as many decimals | `1.6000 s` above `0.0300 s` |
//! | a number alone ([`number`]) | significant digits, and a power of ten instead of zeros | `0.03`, `1.25e-6` |
//!
//! A unit with a power (m²/s²) and the kilogram take no prefix: they have powers of ten. Zeros at
//! the end say nothing and are left out, except side by side.

/// Prefixes of the powers of a thousand, from 10⁻³⁰.
const PREFIXES: [&str; 21] = [
    "q", "r", "y", "z", "a", "f", "p", "n", "µ", "m", "", "k", "M", "G", "T", "P", "E", "Z", "Y",
    "R", "Q",
];

/// The place of no prefix among them.
const NONE: i32 = 10;

/// The prefix of a power of a thousand, where there is one.
fn prefix(thousands: i32) -> Option<&'static str> {
    let place = usize::try_from(thousands + NONE).ok()?;
    PREFIXES.get(place).copied()
}

/// Whether a unit can have a prefix.
fn takes_prefix(unit: &str) -> bool {
    let first = unit.split(['/', ' ', '·']).next().unwrap_or_default();
    first.chars().all(char::is_alphabetic) && !matches!(first, "" | "kg")
}

/// The minus of typographers, as long as a plus; none before nothing.
fn signed(x: f64, size: &str) -> String {
    let is_nothing = size.bytes().all(|b| matches!(b, b'0' | b'.'));
    match x < 0.0 && !is_nothing {
        true => format!("−{size}"),
        false => size.to_owned(),
    }
}

/// The significant digits of |x|, and the power of ten of the first one.
fn rounded(x: f64, digits: usize) -> (String, i32) {
    let text = format!("{:.*e}", digits.max(1) - 1, x.abs());
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let digits = mantissa.replace('.', "");
    (digits, exponent.parse().unwrap_or(0))
}

/// The digits with a point after the first `whole` of them, without zeros at the end.
fn pointed(digits: &str, whole: i32) -> String {
    let text = if whole <= 0 {
        format!("0.{}{digits}", "0".repeat(whole.unsigned_abs() as usize))
    } else {
        let whole = whole as usize;
        let padded = format!("{digits:0<whole$}");
        let (whole, rest) = padded.split_at(whole);
        format!("{whole}.{rest}")
    };
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// A number that is short as it is, and that has at least so many significant digits.
fn plain(x: f64, digits: usize) -> String {
    let whole = rounded(x, digits).1 + 1;
    let (digits, exponent) = rounded(x, digits.max(whole.max(1) as usize));
    pointed(&digits, exponent + 1)
}

/// A number alone, with so many significant digits: 0.03, 12, 1.25e-6.
#[must_use]
pub fn number(x: f64, digits: usize) -> String {
    if x == 0.0 || !x.is_finite() {
        return if x == 0.0 {
            "0".to_owned()
        } else {
            x.to_string()
        };
    }
    let (significant, exponent) = rounded(x, digits);
    let size = match exponent {
        -3..=3 => plain(x, digits),
        _ => format!("{}e{exponent}", pointed(&significant, 1)),
    };
    signed(x, &size)
}

/// A number and its unit, with so many significant digits: 43.7 nJ, 0.25 m, 1.25e-6 m²/s².
#[must_use]
pub fn quantity(x: f64, unit: &str, digits: usize) -> String {
    let (significant, exponent) = rounded(x, digits);
    let short = x == 0.0 || !x.is_finite() || (-2..=3).contains(&exponent);
    let prefixed = prefix(exponent.div_euclid(3)).filter(|_| takes_prefix(unit) && !short);
    match prefixed {
        Some(prefix) => {
            let size = pointed(&significant, exponent.rem_euclid(3) + 1);
            format!("{} {prefix}{unit}", signed(x, &size))
        }
        None => format!("{} {unit}", number(x, digits))
            .trim_end()
            .to_owned(),
    }
}

/// A unit, with the prefix that suits numbers that stand side by side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale {
    /// Without the prefix.
    unit: &'static str,
    /// The power of a thousand that the prefix stands for.
    thousands: i32,
    /// The power of ten of the largest number, in the unit with its prefix.
    exponent: i32,
}

impl Scale {
    /// The scale of numbers of which none is larger than this: the unit as it is up to 10⁴, then
    /// with the prefix of which the largest number is at least ten, and below 0.05 with that of
    /// which it is at least a twentieth.
    #[must_use]
    pub fn of(largest: f64, unit: &'static str) -> Self {
        let largest = largest.abs();
        let (_, exponent) = rounded(largest, 6);
        let thousands = match exponent {
            _ if largest == 0.0 || !largest.is_finite() => 0,
            4.. => (exponent - 1).div_euclid(3),
            // A twentieth: 0.05 and 50 are the same digits.
            _ if largest < 0.05 => {
                let tenths = rounded(20.0 * largest, 6).1;
                tenths.div_euclid(3)
            }
            _ => 0,
        };
        let last = PREFIXES.len() as i32 - 1 - NONE;
        let thousands = thousands.clamp(-NONE, last);
        let exponent = match largest == 0.0 || !largest.is_finite() {
            true => 0,
            false => exponent - 3 * thousands,
        };
        Self {
            unit,
            thousands,
            exponent,
        }
    }

    /// The unit with its prefix or its power of ten; nothing for plain numbers.
    #[must_use]
    pub fn name(self) -> String {
        let prefix = prefix(self.thousands).filter(|_| takes_prefix(self.unit));
        match (prefix, self.thousands) {
            (_, 0) => self.unit.to_owned(),
            (Some(prefix), _) => format!("{prefix}{}", self.unit),
            (None, n) => format!("1e{} {}", 3 * n, self.unit).trim_end().to_owned(),
        }
    }

    /// A number in this unit.
    #[must_use]
    pub fn count(self, x: f64) -> f64 {
        match self.thousands {
            0 => x,
            n if n < 0 => x * 1e3_f64.powi(-n),
            n => x / 1e3_f64.powi(n),
        }
    }

    /// A number in this unit, with as many decimals as give the largest so many significant digits.
    #[must_use]
    pub fn fixed(self, x: f64, digits: usize) -> String {
        let decimals = (digits as i32 - 1 - self.exponent).max(0) as usize;
        let count = self.count(x);
        signed(count, &format!("{:.decimals$}", count.abs()))
    }

    /// The same with the unit.
    #[must_use]
    pub fn amount(self, x: f64, digits: usize) -> String {
        let fixed = self.fixed(x, digits);
        let text = match self.thousands {
            n if n != 0 && !takes_prefix(self.unit) => format!("{fixed}e{} {}", 3 * n, self.unit),
            _ => format!("{fixed} {}", self.name()),
        };
        text.trim_end().to_owned()
    }
}

/// The ends of a range and its middle, with as many digits as tell them apart, and their unit.
#[must_use]
pub fn ticks([low, high]: [f64; 2], unit: &'static str) -> ([String; 3], Scale) {
    let scale = Scale::of(low.abs().max(high.abs()), unit);
    let values = [low, 0.5 * (low + high), high].map(|x| scale.count(x));
    let short = values.map(|x| number(x, 3));
    let half = 0.5 * (values[2] - values[0]).abs();
    if half == 0.0 || (short[0] != short[1] && short[1] != short[2]) {
        return (short, scale);
    }
    let decimals = (1.0 - half.log10().floor()).clamp(0.0, 12.0) as usize;
    let texts = values.map(|x| signed(x, &format!("{:.decimals$}", x.abs())));
    (texts, scale)
}

/// A whole number with commas: 5,000 and 1,234,567.
#[must_use]
pub fn count(n: u64) -> String {
    let digits = n.to_string();
    let mut text = String::new();
    for (place, digit) in digits.chars().enumerate() {
        if place > 0 && (digits.len() - place).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Reads a number with its unit back.
    fn read(text: &str, unit: &str) -> f64 {
        let text = text.replace('−', "-");
        let (size, named) = text.split_once(' ').unwrap_or((&text, ""));
        let prefix = named.strip_suffix(unit).expect("the unit");
        let place = PREFIXES
            .iter()
            .position(|p| *p == prefix)
            .expect("a prefix");
        let power = 3 * (place as i32 - NONE);
        let text = match size.contains('e') {
            true => size.to_owned(),
            false => format!("{size}e{power}"),
        };
        text.parse().expect("a number")
    }

    fn any_number() -> impl Strategy<Value = f64> {
        (-30.0..30.0, prop::bool::ANY, 1.0..10.0).prop_map(
            |(power, below, mantissa): (f64, _, f64)| {
                let size = mantissa * 10_f64.powf(power);
                if below { -size } else { size }
            },
        )
    }

    proptest! {
        #[test]
        fn a_quantity_is_read_back_within_its_digits_and_stays_short(
            x in any_number(),
            digits in 2_usize..8,
        ) {
            for unit in ["J", "m/s"] {
                let text = quantity(x, unit, digits);
                let back = read(&text, unit);
                let within = 0.500_001 * 10_f64.powi(1 - digits as i32) * x.abs();
                prop_assert!((back - x).abs() <= within, "{} for {}", text, x);
                // A sign, a point, a blank, a prefix and at most two zeros before the digits.
                let width = text.chars().count() - unit.len();
                prop_assert!(width <= digits.max(4) + 6, "{}", text);
            }
        }

        #[test]
        fn a_number_is_read_back_within_its_digits_and_stays_short(
            x in any_number(),
            digits in 2_usize..8,
        ) {
            let text = number(x, digits);
            let back: f64 = text.replace('−', "-").parse().expect("a number");
            let within = 0.500_001 * 10_f64.powi(1 - digits as i32) * x.abs();
            prop_assert!((back - x).abs() <= within, "{} for {}", text, x);
            prop_assert!(text.chars().count() <= digits.max(4) + 6, "{}", text);
        }

        #[test]
        fn side_by_side_all_have_the_decimals_of_the_largest(
            largest in any_number(),
            part in -1.0..1.0,
            digits in 3_usize..8,
        ) {
            let scale = Scale::of(largest, "s");
            let x = part * largest;
            let text = scale.amount(x, digits);
            let within = 0.500_001 * 10_f64.powi(1 - digits as i32) * largest.abs();
            prop_assert!((read(&text, "s") - x).abs() <= within.max(1e-30), "{} for {}", text, x);
            prop_assert!(text.chars().count() <= digits.max(4) + 7, "{}", text);
            let shown = scale.count(largest).abs();
            prop_assert!((0.0499..10_001.0).contains(&shown), "{} for {}", text, largest);
        }

        #[test]
        fn the_numbers_of_a_range_differ(low in any_number(), wide in 1e-6..10.0) {
            let high = low + wide * low.abs();
            let ([a, b, c], _) = ticks([low, high], "Pa");
            prop_assert!(a != b && b != c, "{} {} {}", a, b, c);
        }
    }

    #[test]
    fn numbers_are_as_people_write_them() {
        let of = |x| quantity(x, "J", 3);
        let texts = [0.0, 4.368_65e23, 4.37e-8, 0.25, -1234.0, 9999.9, 0.004].map(of);
        let expected = [
            "0 J",
            "437 ZJ",
            "43.7 nJ",
            "0.25 J",
            "−1234 J",
            "10 kJ",
            "4 mJ",
        ];
        assert_eq!(texts, expected);
        let texts = [0.0, 0.03, 300.0, 12.5, -0.5, 1e-7, 123_456.0].map(|x| number(x, 3));
        assert_eq!(
            texts,
            ["0", "0.03", "300", "12.5", "−0.5", "1e-7", "1.23e5"]
        );
        assert_eq!(quantity(1.25e-6, "m²/s²", 3), "1.25e-6 m²/s²");
        assert_eq!(quantity(2.5e7, "kg/m³", 3), "2.5e7 kg/m³");
        assert_eq!(quantity(1e40, "J", 3), "1e40 J");
        assert_eq!(quantity(f64::NAN, "J", 3), "NaN J");
        assert_eq!(count(1_234_567), "1,234,567");
    }

    #[test]
    fn times_are_shown_in_the_unit_of_the_longest() {
        for (longest, expected) in [
            (1.6, "1.6000 s"),
            (0.05, "0.050000 s"),
            (0.04, "40.000 ms"),
            (3e-6, "3.0000 µs"),
            (12.0, "12.000 s"),
            (3.2e7, "32.000 Ms"),
            (0.0, "0.0000 s"),
        ] {
            assert_eq!(Scale::of(longest, "s").amount(longest, 5), expected);
        }
        assert_eq!(Scale::of(1.6, "s").amount(-1e-9, 4), "0.000 s");
        assert_eq!(Scale::of(5e12, "m²/s²").amount(2e12, 4), "2000e9 m²/s²");
    }

    #[test]
    fn the_numbers_of_a_range_can_be_told_apart() {
        let of = |range| ticks(range, "m").0;
        assert_eq!(of([0.0, 0.4]), ["0", "0.2", "0.4"]);
        assert_eq!(of([990.0, 1010.0]), ["990", "1000", "1010"]);
        assert_eq!(of([1.648, 1.652]), ["1.6480", "1.6500", "1.6520"]);
        assert_eq!(of([1.0, 1.0]), ["1", "1", "1"]);
        let ([low, _, high], scale) = ticks([-3e6, 3e6], "Pa");
        assert_eq!(
            (low.as_str(), high.as_str(), scale.name().as_str()),
            ("−3000", "3000", "kPa")
        );
    }
}
