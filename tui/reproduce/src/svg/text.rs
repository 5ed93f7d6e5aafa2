//! Words and numbers: escaped, with subscripts, powers of ten and a true minus.

use loschmidt_runner::figures;

/// Text that may stand in XML.
#[must_use]
pub fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
}

/// Text that may stand in XML, its subscripts (`C_a`, `S_eq`: one letter, an underscore, letters or
/// digits) within `open` and `close`.
#[must_use]
pub fn with_subscripts(text: &str, open: &str, close: &str) -> String {
    let letters: Vec<char> = text.chars().collect();
    let is_word = |c: Option<&char>| c.is_some_and(|c| c.is_alphanumeric() || *c == '_');
    let (mut out, mut plain, mut i) = (String::new(), String::new(), 0);
    while i < letters.len() {
        let alone = i == 0 || !is_word(letters.get(i - 1));
        let is_base = alone && letters[i].is_alphabetic() && letters.get(i + 1) == Some(&'_');
        let low: String = letters
            .get(i + 2..)
            .unwrap_or_default()
            .iter()
            .take_while(|c| c.is_alphanumeric())
            .collect();
        plain.push(letters[i]);
        i += 1;
        if is_base && !low.is_empty() {
            i += 1 + low.chars().count();
            out += &escaped(&std::mem::take(&mut plain));
            out += open;
            out += &escaped(&low);
            out += close;
        }
    }
    out + &escaped(&plain)
}

/// The content of a text element, subscripts set lower and smaller.
pub(super) fn content(text: &str) -> String {
    // What follows a subscript has to climb again, and a shift needs something to stand on: a space
    // of no width.
    with_subscripts(
        text,
        "<tspan dy=\"3\" font-size=\"10\">",
        "</tspan><tspan dy=\"-3\">\u{200b}</tspan>",
    )
}

/// Width of a text, pixels, generously.
pub(super) fn width(text: &str) -> f64 {
    6.9 * text.chars().count() as f64
}

/// A power of ten: 1, 10, 10⁻³.
#[must_use]
pub fn power(exponent: i32) -> String {
    match exponent {
        0 => "1".to_owned(),
        1 => "10".to_owned(),
        _ => {
            let high = |c| match c {
                '-' => '⁻',
                '1' => '¹',
                '2' => '²',
                '3' => '³',
                // The others stand in a row: ⁰, then ⁴ to ⁹.
                c => char::from_u32(0x2070 + c as u32 - '0' as u32).unwrap_or(c),
            };
            let high: String = exponent.to_string().chars().map(high).collect();
            format!("10{high}")
        }
    }
}

/// A number with a true minus, at most five digits and no trailing zeros.
#[must_use]
pub fn number(x: f64) -> String {
    figures::number(x, 5)
}

/// A positive number on a logarithmic axis: plain where that is short.
pub(super) fn logarithmic(digit: f64, exponent: i32) -> String {
    if (-2..=3).contains(&exponent) {
        number(digit * libm::pow(10.0, f64::from(exponent)))
    } else if digit == 1.0 {
        power(exponent)
    } else {
        format!("{digit}·{}", power(exponent))
    }
}

#[cfg(test)]
mod tests {
    use super::{number, power, with_subscripts};

    #[test]
    fn one_letter_and_an_underscore_make_a_subscript_and_keys_do_not() {
        let marked = |text| with_subscripts(text, "[", "]");
        assert_eq!(marked("C_a and S_eq(E), <"), "C[a] and S[eq](E), &lt;");
        assert_eq!(marked("particle_spacing=0.1"), "particle_spacing=0.1");
        assert_eq!(marked("E_ and _a, x_"), "E_ and _a, x_");
    }

    #[test]
    fn powers_and_negative_numbers_are_set_as_in_print() {
        assert_eq!([power(0), power(1), power(-13)], ["1", "10", "10⁻¹³"]);
        assert_eq!(power(20456), "10²⁰⁴⁵⁶");
        assert_eq!(
            [number(-0.5), number(-0.0), number(30.0)],
            ["−0.5", "0", "30"]
        );
    }
}
