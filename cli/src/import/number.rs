//! Numbers of the file, kept digit for digit.

use std::f64::consts::FRAC_PI_2;

/// A finite decimal number.
#[derive(Clone, Debug)]
pub(super) struct Number {
    /// As a literal of the language, with its sign.
    pub(super) text: String,
    pub(super) value: f64,
}

/// Angles that differ by less than that from a multiple of a right angle are one: 1.57079633 differs by 3.2e-9, 3.14159265 by
/// 3.6e-9.
const RIGHT: f64 = 5e-9;
/// Those that differ by less than that were probably meant to be one.
const ALMOST_RIGHT: f64 = 1e-4;

/// What an angle is beside a multiple of a right angle.
pub(super) enum Angle {
    /// A whole number of right angles.
    Right(i64),
    /// Almost so: taken as it stands.
    Almost,
    Other,
}

impl Number {
    /// Nothing where the text is no decimal number, or one that no `f64` holds.
    pub(super) fn read(text: &str) -> Option<Number> {
        let (sign, digits) = match text.strip_prefix('-') {
            Some(rest) => ("-", rest),
            None => ("", text.strip_prefix('+').unwrap_or(text)),
        };
        let (mantissa, exponent) = match digits.split_once(['e', 'E']) {
            Some((mantissa, exponent)) => (mantissa, Some(exponent)),
            None => (digits, None),
        };
        let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
        let are_digits = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit());
        if whole.len() + fraction.len() == 0 || !are_digits(whole) || !are_digits(fraction) {
            return None;
        }
        let power = match exponent {
            Some(power) => {
                let unsigned = power.strip_prefix(['+', '-']).unwrap_or(power);
                if unsigned.is_empty() || !are_digits(unsigned) {
                    return None;
                }
                format!("e{}", power.strip_prefix('+').unwrap_or(power))
            }
            None => String::new(),
        };
        let whole = if whole.is_empty() { "0" } else { whole };
        let fraction = if fraction.is_empty() { "0" } else { fraction };
        let text = format!("{sign}{whole}.{fraction}{power}");
        let value: f64 = text.parse().ok()?;
        value.is_finite().then_some(Number { text, value })
    }

    /// The shortest literal of a value that was computed.
    pub(super) fn of(value: f64) -> Number {
        // Minus zero is zero.
        let value = value + 0.0;
        Number { text: format!("{value:?}"), value }
    }

    pub(super) fn is_zero(&self) -> bool {
        self.value == 0.0
    }

    pub(super) fn angle(&self) -> Angle {
        let turns = (self.value / FRAC_PI_2).round();
        match (self.value - turns * FRAC_PI_2).abs() {
            // Whole numbers of this size are exact.
            off if off < RIGHT && turns.abs() <= 8.0 => Angle::Right(turns as i64),
            off if off < ALMOST_RIGHT && turns != 0.0 => Angle::Almost,
            _ => Angle::Other,
        }
    }
}

/// Sine and cosine, exact at right angles.
pub(super) fn sin_cos(angle: &Number) -> (f64, f64) {
    match angle.angle() {
        Angle::Right(turns) => match turns.rem_euclid(4) {
            0 => (0.0, 1.0),
            1 => (1.0, 0.0),
            2 => (0.0, -1.0),
            _ => (-1.0, 0.0),
        },
        Angle::Almost | Angle::Other => angle.value.sin_cos(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_stay() {
        let read = |text: &str| Number::read(text).map(|number| number.text);
        for (text, expected) in [
            ("0.10000000000000000555", "0.10000000000000000555"),
            ("-1", "-1.0"),
            ("+.5", "0.5"),
            ("7.", "7.0"),
            ("1E+05", "1.0e05"),
            ("-2.50e-03", "-2.50e-03"),
        ] {
            assert_eq!(read(text).as_deref(), Some(expected));
            assert_eq!(expected.parse::<f64>().unwrap(), text.parse::<f64>().unwrap());
        }
        for text in ["", ".", "-", "1e", "1e+", "--1", "nan", "inf", "0x10", "1,5", "1_0", "1e999", "1.2.3"] {
            assert_eq!(read(text), None, "{text}");
        }
    }

    #[test]
    fn right_angles_are_found() {
        let turns = |text: &str| match Number::read(text).unwrap().angle() {
            Angle::Right(turns) => Some(turns),
            Angle::Almost => Some(100),
            Angle::Other => None,
        };
        assert_eq!(turns("1.57079632679"), Some(1));
        assert_eq!(turns("-1.5707963267948966"), Some(-1));
        assert_eq!(turns("3.1415926535897931"), Some(2));
        assert_eq!(turns("-1.57079633"), Some(-1));
        assert_eq!(turns("3.1415926"), Some(100));
        assert_eq!(turns("0"), Some(0));
        assert_eq!(turns("1.5708"), Some(100));
        assert_eq!(turns("1e-5"), None);
        assert_eq!(turns("0.7853981633974483"), None);
    }
}
