//! Functions of the user's own Rust: models that call them do what the same models do with these functions written in the
//! language, in every function, formulation and scalar; and calls are made no more often than need be.

mod calls;
mod same;
mod scalars;

use multibody::nalgebra::SMatrix;
use multibody::{Columns, Function, Real};

/// Of a tyre, after Pacejka: slip, then load.
pub(crate) struct Grip;

const STIFFNESS: f64 = 1.7;
const SHAPE: f64 = 1.3;
const PEAK: f64 = 0.9;

impl<T: Real> Function<T, 2> for Grip {
    fn value([slip, load]: [T; 2]) -> T {
        let angle = T::lit(SHAPE) * Real::atan(T::lit(STIFFNESS) * slip);
        T::lit(PEAK) * load * Real::sin_cos(angle).0
    }

    fn slopes(x: [T; 2]) -> [T; 2] {
        Self::value_and_slopes(x).1
    }

    fn value_and_slopes([slip, load]: [T; 2]) -> (T, [T; 2]) {
        let steep = T::lit(STIFFNESS) * slip;
        let (sin, cos) = Real::sin_cos(T::lit(SHAPE) * Real::atan(steep));
        let rise = T::lit(SHAPE * STIFFNESS) / (T::lit(1.0) + steep * steep);
        (T::lit(PEAK) * load * sin, [T::lit(PEAK) * load * cos * rise, T::lit(PEAK) * sin])
    }
}

/// Of three arguments, none like another.
pub(crate) struct Blend;

impl<T: Real> Function<T, 3> for Blend {
    fn value([x, y, z]: [T; 3]) -> T {
        Real::exp(T::lit(-0.3) * x * x) + y * z + T::lit(0.2) * z * z * z
    }

    fn slopes([x, y, z]: [T; 3]) -> [T; 3] {
        let bell = Real::exp(T::lit(-0.3) * x * x);
        [T::lit(-0.6) * x * bell, z, y + T::lit(0.6) * z * z]
    }
}

/// A model twice: `rust` calls Rust, `words` has the same functions in the language, and so has its part if there is one.
macro_rules! twice {
    (@ $part:ident { $($inside:tt)* } $($items:tt)*) => {
        multibody::multibody! {
            mod $part {
                extern grip(slip, load) = crate::Grip;
                extern blend(x, y, z) = crate::Blend;
                $($inside)*
            }
            pub(crate) mod rust {
                $($items)*
            }
        }
        multibody::multibody! {
            mod $part {
                let grip(slip, load) = 0.9 * load * sin(1.3 * atan(1.7 * slip));
                let blend(first, second, third) = exp(-0.3 * first * first) + second * third + 0.2 * powi(third, 3);
                $($inside)*
            }
            pub(crate) mod words {
                $($items)*
            }
        }
    };
    ($($items:tt)*) => {
        multibody::multibody! {
            pub(crate) mod rust {
                extern grip(slip, load) = crate::Grip;
                extern blend(x, y, z) = crate::Blend;
                $($items)*
            }
        }
        multibody::multibody! {
            pub(crate) mod words {
                let grip(slip, load) = 0.9 * load * sin(1.3 * atan(1.7 * slip));
                let blend(first, second, third) = exp(-0.3 * first * first) + second * third + 0.2 * powi(third, 3);
                $($items)*
            }
        }
    };
}

pub(crate) use twice;

/// Numbers between -1 and 1 that are seldom simple.
pub(crate) struct Drawn(u64);

impl Drawn {
    pub(crate) fn new(seed: u64) -> Drawn {
        Drawn(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ 0x5DEE_CE66)
    }

    pub(crate) fn number(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// The scalars of a generated struct.
pub(crate) fn scalars<T>(of: &impl Columns<T>) -> Vec<T> {
    let mut list = Vec::new();
    of.each(&mut |_, value| list.push(value));
    list
}

pub(crate) fn entries<const R: usize, const C: usize>(matrix: &SMatrix<f64, R, C>) -> Vec<f64> {
    matrix.iter().copied().collect()
}

/// Two lists that are equal up to so many roundings of the greatest number.
pub(crate) fn assert_same(what: &str, a: &[f64], b: &[f64], roundings: f64) {
    assert_eq!(a.len(), b.len(), "{what}");
    let size = a.iter().chain(b).fold(1e-3_f64, |most, x| most.max(x.abs()));
    for (place, (x, y)) in a.iter().zip(b).enumerate() {
        assert!((x - y).abs() <= roundings * f64::EPSILON * size, "{what}, {place}: {x} and {y}");
    }
}
