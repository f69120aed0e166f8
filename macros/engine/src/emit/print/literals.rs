//! Stage `emit`: numbers as literals.
//!
//! In: finite numbers. Out: tokens that give back the same bits. Clippy's `approx_constant` fires on macros too and
//! denies `3.14` or `0.7071067811865476` in any crate, so that what is a constant of `core` is written by its name,
//! and what only looks like one as a quotient that rounds to the same number.

use std::f64::consts;
use std::str::FromStr;

use quote::{format_ident, quote};

use proc_macro2::{Literal, TokenStream};

const CONSTANTS: &[(f64, &str)] = &[
    (consts::E, "E"),
    (consts::FRAC_1_PI, "FRAC_1_PI"),
    (consts::FRAC_1_SQRT_2, "FRAC_1_SQRT_2"),
    (consts::FRAC_2_PI, "FRAC_2_PI"),
    (consts::FRAC_2_SQRT_PI, "FRAC_2_SQRT_PI"),
    (consts::FRAC_PI_2, "FRAC_PI_2"),
    (consts::FRAC_PI_3, "FRAC_PI_3"),
    (consts::FRAC_PI_4, "FRAC_PI_4"),
    (consts::FRAC_PI_6, "FRAC_PI_6"),
    (consts::FRAC_PI_8, "FRAC_PI_8"),
    (consts::LN_2, "LN_2"),
    (consts::LN_10, "LN_10"),
    (consts::LOG10_2, "LOG10_2"),
    (consts::LOG2_10, "LOG2_10"),
    (consts::LOG10_E, "LOG10_E"),
    (consts::LOG2_E, "LOG2_E"),
    (consts::PI, "PI"),
    (consts::SQRT_2, "SQRT_2"),
    (consts::TAU, "TAU"),
];

/// The golden ratio and Euler's constant: lints know them, stable `core` does not yet.
const UNNAMED: &[f64] = &[1.618_033_988_749_895, 0.577_215_664_901_532_9];

/// Expands to `T::lit(0.5)`.
pub(in crate::emit) fn scalar(value: f64) -> TokenStream {
    let number = number(value);
    quote!(T::lit(#number))
}

/// Expands to `0.5`, an `f64` expression.
pub(in crate::emit) fn number(value: f64) -> TokenStream {
    let magnitude = value.abs();
    for &(constant, name) in CONSTANTS {
        if magnitude.to_bits() == constant.to_bits() {
            let name = format_ident!("{name}");
            let constant = quote!(::core::f64::consts::#name);
            return if value < 0.0 { quote!(-#constant) } else { constant };
        }
    }
    let text = text(value);
    if looks_like_a_constant(magnitude) {
        return quotient(value).unwrap_or_else(|| bits(value));
    }
    // `Literal` takes no sign from text, and prints 1e300 with all its zeros by itself.
    let digits = text.strip_prefix('-').unwrap_or(&text);
    match Literal::from_str(digits) {
        Ok(literal) if text.len() > digits.len() => quote!(-#literal),
        Ok(literal) => quote!(#literal),
        Err(_) => bits(value),
    }
}

/// The shortest decimal that reads back as `value`, with a point or an exponent.
pub(in crate::emit) fn text(value: f64) -> String {
    let magnitude = value.abs();
    if magnitude != 0.0 && !(1e-5..1e16).contains(&magnitude) { format!("{value:e}") } else { format!("{value:?}") }
}

/// As clippy sees it: the digits are those of a constant, cut off or rounded.
fn looks_like_a_constant(magnitude: f64) -> bool {
    let text = format!("{magnitude}");
    let decimals = text.split_once('.').map_or(0, |(_, digits)| digits.len());
    decimals >= 2
        && CONSTANTS
            .iter()
            .map(|&(constant, _)| constant)
            .chain(UNNAMED.iter().copied())
            .any(|constant| constant.to_string().starts_with(&text) || format!("{constant:.decimals$}") == text)
}

/// `314.0 / 100.0`: both exact, so that the quotient is rounded once, as the decimal is.
fn quotient(value: f64) -> Option<TokenStream> {
    let text = format!("{value}");
    let (whole, digits) = text.split_once('.')?;
    let above: f64 = format!("{whole}{digits}").parse().ok()?;
    let below = 10_f64.powi(i32::try_from(digits.len()).ok()?);
    if (above / below).to_bits() != value.to_bits() || above.abs() >= 9e15 || below > 1e22 {
        return None;
    }
    let sign = (above < 0.0).then(|| quote!(-));
    let above = Literal::f64_unsuffixed(above.abs());
    let below = Literal::f64_unsuffixed(below);
    Some(quote!(#sign #above / #below))
}

fn bits(value: f64) -> TokenStream {
    let bits = Literal::u64_unsuffixed(value.to_bits());
    quote!(f64::from_bits(#bits))
}

#[cfg(test)]
mod tests {
    use super::number;

    fn printed(value: f64) -> String {
        number(value).to_string().replace(' ', "")
    }

    #[test]
    fn numbers_keep_their_bits() {
        assert_eq!(printed(0.5), "0.5");
        assert_eq!(printed(-2.0), "-2.0");
        assert_eq!(printed(0.0), "0.0");
        assert_eq!(printed(1e300), "1e300");
        assert_eq!(printed(-1.25e-300), "-1.25e-300");
        assert_eq!(printed(9.80665), "9.80665");
        assert_eq!(printed(0.1 + 0.2), "0.30000000000000004");
    }

    #[test]
    fn what_looks_like_a_constant_is_written_otherwise() {
        assert_eq!(printed(std::f64::consts::PI), "::core::f64::consts::PI");
        assert_eq!(printed(-std::f64::consts::FRAC_1_SQRT_2), "-::core::f64::consts::FRAC_1_SQRT_2");
        let cut = 314.0 / 100.0;
        assert_eq!(printed(cut), "314.0/100.0");
        assert_eq!(printed(-cut), "-314.0/100.0");
        assert_eq!(printed(3.0), "3.0");
        assert_eq!(printed(2.7), "2.7");
    }
}
