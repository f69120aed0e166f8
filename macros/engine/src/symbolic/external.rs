//! Stage `symbolic`: what stands for functions of the user's own Rust where numbers are needed.
//!
//! In: a function and its arguments. Out: a value, slopes and slopes of these, to 31 digits.
//!
//! The function itself is known when the model runs. Whether a program has the values of its equations, and whether a derivative is
//! one, does not depend on which function it is, so any will do that is smooth, has a value everywhere and is no other one's:
//!
//! ```text
//! f(x) = c . x + sum of a sin(w . x + p)
//! ```
//!
//! with numbers of its own that follow from the function's place. They are about one, and none is a simple fraction, so neither a slope nor
//! an argument that is lost or in a wrong place goes unnoticed.

use crate::contracts::call::{Call, ExternalId};

use super::doubled::Doubled;
use super::fingerprint::mix;

/// As many waves, so that one does not stand still where another one does.
const WAVES: u64 = 2;

/// A number between a half and one and a half, with either sign.
fn drawn(function: ExternalId, what: u64) -> Doubled {
    let word = mix(mix(0xE7_0000 + function.0 as u64) ^ mix(what));
    let size = 0.5 + (word >> 12) as f64 / (1_u64 << 52) as f64;
    Doubled::new(if word & 1 == 0 { size } else { -size })
}

/// Its amplitude, its weight of each argument, and its sine and cosine.
struct Wave {
    size: Doubled,
    weights: Vec<Doubled>,
    sin: Doubled,
    cos: Doubled,
}

fn waves(function: ExternalId, x: &[Doubled]) -> impl Iterator<Item = Wave> {
    (0..WAVES).map(move |wave| {
        let number = |k: u64| drawn(function, 1000 * (wave + 1) + k);
        let weights: Vec<Doubled> = (0..x.len()).map(|k| number(2 + k as u64)).collect();
        let angle = weights.iter().zip(x).fold(number(0), |sum, (&weight, &x)| sum + weight * x);
        let (sin, cos) = angle.sin_cos();
        Wave { size: number(1), weights, sin, cos }
    })
}

fn slope(function: ExternalId, argument: usize, x: &[Doubled]) -> Doubled {
    let straight = drawn(function, argument as u64);
    waves(function, x).fold(straight, |sum, wave| sum + wave.size * wave.weights[argument] * wave.cos)
}

/// Of a call of such a function, or of a slope; nothing of others.
pub fn value(call: Call, x: &[Doubled]) -> Option<Doubled> {
    match call {
        Call::External(function) => {
            let straight = (0..).zip(x).fold(Doubled::ZERO, |sum, (k, &x)| sum + drawn(function, k) * x);
            Some(waves(function, x).fold(straight, |sum, wave| sum + wave.size * wave.sin))
        }
        Call::ExternalSlope(function, argument) => Some(slope(function, argument, x)),
        _ => None,
    }
}

/// How such a value changes with each argument.
pub fn slopes(call: Call, x: &[Doubled]) -> Option<Vec<Doubled>> {
    match call {
        Call::External(function) => Some((0..x.len()).map(|argument| slope(function, argument, x)).collect()),
        Call::ExternalSlope(function, argument) => {
            let mut all = vec![Doubled::ZERO; x.len()];
            for wave in waves(function, x) {
                let change = wave.size * wave.weights[argument] * wave.sin;
                all.iter_mut().zip(&wave.weights).for_each(|(sum, &weight)| *sum = *sum - change * weight);
            }
            Some(all)
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::{slopes, value};
    use crate::contracts::call::{Call, ExternalId};
    use crate::symbolic::doubled::Doubled;

    const PLACES: [[f64; 3]; 3] = [[0.3, -1.2, 2.5], [4.0, 0.0, -0.7], [-31.0, 7.5, 0.01]];

    fn difference(call: Call, x: &[f64; 3], argument: usize) -> f64 {
        let at = |step: f64| {
            let mut x = x.map(Doubled::new);
            x[argument] = x[argument] + Doubled::new(step);
            value(call, &x).expect("it has a value")
        };
        let step = 1e-9;
        (at(step) - at(-step)).value() / (2.0 * step)
    }

    #[test]
    fn slopes_are_those_of_values_and_of_slopes() {
        for function in 0..4 {
            let function = ExternalId(function);
            let calls =
                std::iter::once(Call::External(function)).chain((0..3).map(|k| Call::ExternalSlope(function, k)));
            for call in calls {
                for x in &PLACES {
                    let slopes = slopes(call, &x.map(Doubled::new)).expect("it has slopes");
                    for (argument, slope) in slopes.iter().enumerate() {
                        let expected = difference(call, x, argument);
                        assert!(
                            (slope.value() - expected).abs() < 1e-14,
                            "{call:?} by {argument}: {slope:?}, {expected}"
                        );
                    }
                }
            }
        }
    }

    #[test]
    fn functions_arguments_and_slopes_are_told_apart() {
        let x = [0.4, 0.4, 0.4].map(Doubled::new);
        let mut values: Vec<f64> = Vec::new();
        for function in (0..8).map(ExternalId) {
            values.extend(value(Call::External(function), &x).map(Doubled::value));
            values.extend((0..3).filter_map(|k| value(Call::ExternalSlope(function, k), &x)).map(Doubled::value));
        }
        values.sort_by(f64::total_cmp);
        assert!(values.windows(2).all(|pair| pair[1] - pair[0] > 1e-6), "{values:?}");
    }
}
