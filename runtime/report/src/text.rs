//! Formatting of numbers.

/// An integer in superscripts: ⁻¹².
pub(super) fn superscript(exponent: i32) -> String {
    let raise = |c| match c {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        digit => char::from_u32('⁰' as u32 + (digit as u32 - '0' as u32)).unwrap_or(digit),
    };
    exponent.to_string().chars().map(raise).collect()
}

/// A power of ten: 10⁻³, and 1 for 10⁰.
pub(super) fn power_of_ten(exponent: i32) -> String {
    match exponent {
        0 => "1".into(),
        1 => "10".into(),
        _ => format!("10{}", superscript(exponent)),
    }
}

/// Two significant digits: 1.2·10⁻⁹, 0.25, 0.
pub(super) fn scientific(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return value.to_string();
    }
    let text = format!("{value:.1e}");
    let (digits, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    match exponent {
        -2..=1 => {
            let decimals = (1 - exponent).max(0) as usize;
            format!("{value:.decimals$}")
        }
        _ => format!("{digits}·10{}", superscript(exponent)),
    }
}

/// A time with three significant digits and its unit.
pub(super) fn seconds(seconds: f64) -> String {
    let (value, unit) = match seconds {
        s if s >= 0.9995 => (s, "s"),
        s if s >= 0.9995e-3 => (1e3 * s, "ms"),
        s if s >= 0.9995e-6 => (1e6 * s, "µs"),
        s => (1e9 * s, "ns"),
    };
    let decimals = match value {
        v if v < 9.995 => 2,
        v if v < 99.95 => 1,
        _ => 0,
    };
    format!("{value:.decimals$} {unit}")
}

/// Grouped digits: 12 345, with narrow no-break spaces.
pub(super) fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) {
            text.push('\u{202f}');
        }
        text.push(digit);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_of_ten_are_written_with_superscripts() {
        assert_eq!(
            [0, 1, -3, 12].map(power_of_ten),
            ["1", "10", "10⁻³", "10¹²"]
        );
        assert_eq!(superscript(-1234567890), "⁻¹²³⁴⁵⁶⁷⁸⁹⁰");
    }

    #[test]
    fn numbers_are_written_with_two_digits() {
        let found = [0.0, 1.0, 0.25, 0.031, 12.3, 1.26e-9, 123.0].map(scientific);
        assert_eq!(
            found,
            ["0", "1.0", "0.25", "0.031", "12", "1.3·10⁻⁹", "1.2·10²"]
        );
    }

    #[test]
    fn times_are_written_with_three_digits_and_a_unit() {
        let found = [2.5, 0.034, 0.000_5, 1.2345e-7, 0.9999e-3, 123e-6].map(seconds);
        assert_eq!(
            found,
            ["2.50 s", "34.0 ms", "500 µs", "123 ns", "1.00 ms", "123 µs"]
        );
    }

    #[test]
    fn thousands_are_grouped_by_thin_spaces() {
        assert_eq!(grouped(1_234_567), "1\u{202f}234\u{202f}567");
        assert_eq!(grouped(12), "12");
    }
}
