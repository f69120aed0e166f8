//! Stage `symbolic`: numbers of twice the precision.
//!
//! In: a pair of f64, the second below the rounding of the first. Out: sums, products, quotients, roots and elementary
//! functions to about 31 digits (Dekker 1971; error bounds of Joldes, Muller and Popescu 2017). Literals have their
//! values in them, and so has what checks a compiled program. Sine and cosine are accurate up to 2^30 rad, and those of
//! larger angles to double precision only.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// The unevaluated sum of `high` and `low`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Doubled {
    pub high: f64,
    pub low: f64,
}

/// Relative error of one operation, with a margin.
pub const ROUNDING: f64 = 1e-31;

/// Half of pi in four parts.
const HALF_PI: [f64; 4] =
    [std::f64::consts::FRAC_PI_2, 6.123233995736766e-17, -1.4973849048591698e-33, 5.562271104316826e-50];

const LN_2: [f64; 3] = [std::f64::consts::LN_2, 2.3190468138462996e-17, 5.707708438416212e-34];

/// 1 / n!
#[rustfmt::skip]
const INVERSE_FACTORIALS: [(f64, f64); 32] = [
    (1.0, 0.0),
    (1.0, 0.0),
    (0.5, 0.0),
    (0.16666666666666666, 9.25185853854297e-18),
    (0.041666666666666664, 2.3129646346357427e-18),
    (0.008333333333333333, 1.1564823173178714e-19),
    (0.001388888888888889, -5.300543954373577e-20),
    (0.0001984126984126984, 1.7209558293420705e-22),
    (2.48015873015873e-05, 2.1511947866775882e-23),
    (2.7557319223985893e-06, -1.858393274046472e-22),
    (2.755731922398589e-07, 2.3767714622250297e-23),
    (2.505210838544172e-08, -1.448814070935912e-24),
    (2.08767569878681e-09, -1.20734505911326e-25),
    (1.6059043836821613e-10, 1.2585294588752098e-26),
    (1.1470745597729725e-11, 2.0655512752830745e-28),
    (7.647163731819816e-13, 7.03872877733453e-30),
    (4.779477332387385e-14, 4.399205485834081e-31),
    (2.8114572543455206e-15, 1.6508842730861433e-31),
    (1.5619206968586225e-16, 1.1910679660273754e-32),
    (8.22063524662433e-18, 2.2141894119604265e-34),
    (4.110317623312165e-19, 1.4412973378659527e-36),
    (1.9572941063391263e-20, -1.3643503830087908e-36),
    (8.896791392450574e-22, -7.911402614872376e-38),
    (3.868170170630684e-23, -8.843177655482344e-40),
    (1.6117375710961184e-24, -3.6846573564509766e-41),
    (6.446950284384474e-26, -1.9330404233703465e-42),
    (2.4795962632247976e-27, -1.2953730964765229e-43),
    (9.183689863795546e-29, 1.4303150396787322e-45),
    (3.279889237069838e-30, 1.5117542744029879e-46),
    (1.1309962886447716e-31, 1.0498015412959506e-47),
    (3.7699876288159054e-33, 2.5870347832750324e-49),
    (1.216125041553518e-34, 5.586290567888806e-51),
];

impl Doubled {
    pub const ZERO: Doubled = Doubled { high: 0.0, low: 0.0 };
    pub const ONE: Doubled = Doubled { high: 1.0, low: 0.0 };
    pub const PI: Doubled = Doubled { high: std::f64::consts::PI, low: 1.2246467991473532e-16 };

    pub const fn new(x: f64) -> Doubled {
        Doubled { high: x, low: 0.0 }
    }

    /// Exact up to 2^106.
    pub fn integer(n: i128) -> Doubled {
        let high = n as f64;
        let low = n.saturating_sub(high as i128) as f64;
        quick_two_sum(high, low)
    }

    /// Rounded to double precision.
    pub fn value(self) -> f64 {
        self.high
    }

    pub fn is_finite(self) -> bool {
        self.high.is_finite() && self.low.is_finite()
    }

    pub fn abs(self) -> Doubled {
        if self.high < 0.0 { -self } else { self }
    }

    /// Times a power of two.
    fn scale(self, factor: f64) -> Doubled {
        Doubled { high: self.high * factor, low: self.low * factor }
    }

    /// The square root; NaN of what is negative.
    pub fn sqrt(self) -> Doubled {
        let root = self.high.sqrt();
        if root == 0.0 || !root.is_finite() {
            return Doubled::new(root);
        }
        // Newton's step for the root of the rest, twice: the second takes what the first has rounded away.
        let mut root = Doubled::new(root);
        for _ in 0..2 {
            let rest = self - root * root;
            root = root + Doubled::new(rest.high / (2.0 * root.high));
        }
        root
    }

    /// Sine and cosine.
    pub fn sin_cos(self) -> (Doubled, Doubled) {
        let quarters = (self.high / std::f64::consts::FRAC_PI_2).round();
        if quarters.is_nan() || quarters.abs() > f64::from(1 << 30) {
            let (sin, cos) = self.high.sin_cos();
            return (Doubled::new(sin), Doubled::new(cos));
        }
        let rest = HALF_PI.iter().fold(self, |rest, &part| rest - two_product(quarters, part));
        let square = rest * rest;
        // Taylor's series, its sums of even and odd terms by Horner's rule from the smallest.
        let series = |first: usize| {
            let start = INVERSE_FACTORIALS.len() - 2 + first;
            (first..=start).rev().step_by(2).fold(Doubled::ZERO, |sum, n| {
                let (high, low) = INVERSE_FACTORIALS[n];
                Doubled { high, low } - square * sum
            })
        };
        let (sin, cos) = (series(1) * rest, series(0));
        match (quarters as i64).rem_euclid(4) {
            0 => (sin, cos),
            1 => (cos, -sin),
            2 => (-sin, -cos),
            _ => (-cos, sin),
        }
    }

    pub fn tan(self) -> Doubled {
        let (sin, cos) = self.sin_cos();
        sin / cos
    }

    /// The angle of the point (x, self).
    pub fn atan2(self, x: Doubled) -> Doubled {
        let angle = Doubled::new(self.high.atan2(x.high));
        // How far the point lies beside the angle that double precision gives.
        let (sin, cos) = angle.sin_cos();
        let (beside, along) = (self * cos - x * sin, x * cos + self * sin);
        let rest = beside / along;
        if rest.is_finite() && along.high != 0.0 { angle + rest } else { angle }
    }

    pub fn atan(self) -> Doubled {
        self.atan2(Doubled::ONE)
    }

    pub fn asin(self) -> Doubled {
        self.atan2(((Doubled::ONE - self) * (Doubled::ONE + self)).sqrt())
    }

    pub fn acos(self) -> Doubled {
        ((Doubled::ONE - self) * (Doubled::ONE + self)).sqrt().atan2(self)
    }

    pub fn exp(self) -> Doubled {
        let plain = self.high.exp();
        if plain == 0.0 || !plain.is_finite() {
            return Doubled::new(plain);
        }
        let twos = (self.high / std::f64::consts::LN_2).round();
        let rest = LN_2.iter().fold(self, |rest, &part| rest - two_product(twos, part));
        let sum =
            INVERSE_FACTORIALS.iter().rev().fold(Doubled::ZERO, |sum, &(high, low)| Doubled { high, low } + rest * sum);
        // In two halves: the power alone may lie beyond the range.
        let half = (twos / 2.0).trunc();
        sum.scale(half.exp2()).scale((twos - half).exp2())
    }

    pub fn ln(self) -> Doubled {
        let plain = self.high.ln();
        if !plain.is_finite() {
            return Doubled::new(plain);
        }
        // Newton's step, with the second order.
        let guess = Doubled::new(plain);
        let rest = self * (-guess).exp() - Doubled::ONE;
        guess + (rest - (rest * rest).scale(0.5))
    }

    pub fn powf(self, power: Doubled) -> Doubled {
        if self.high <= 0.0 {
            return Doubled::new(self.high.powf(power.high));
        }
        (power * self.ln()).exp()
    }

    pub fn sinh(self) -> Doubled {
        if self.high.abs() < 0.5 {
            let square = self * self;
            let odd = (1..INVERSE_FACTORIALS.len()).rev().step_by(2);
            let sum = odd.fold(Doubled::ZERO, |sum, n| {
                let (high, low) = INVERSE_FACTORIALS[n];
                Doubled { high, low } + square * sum
            });
            return sum * self;
        }
        let e = self.exp();
        (e - Doubled::ONE / e).scale(0.5)
    }

    pub fn cosh(self) -> Doubled {
        let e = self.exp();
        (e + Doubled::ONE / e).scale(0.5)
    }

    pub fn tanh(self) -> Doubled {
        // Beyond, the rest to one is below the last digit.
        if self.high.abs() > 40.0 {
            return Doubled::new(self.high.signum());
        }
        self.sinh() / self.cosh()
    }
}

impl From<f64> for Doubled {
    fn from(x: f64) -> Doubled {
        Doubled::new(x)
    }
}

impl PartialOrd for Doubled {
    fn partial_cmp(&self, other: &Doubled) -> Option<std::cmp::Ordering> {
        let order = self.high.partial_cmp(&other.high)?;
        Some(if order.is_eq() { self.low.partial_cmp(&other.low)? } else { order })
    }
}

impl Neg for Doubled {
    type Output = Doubled;
    fn neg(self) -> Doubled {
        Doubled { high: -self.high, low: -self.low }
    }
}

impl Add for Doubled {
    type Output = Doubled;
    fn add(self, other: Doubled) -> Doubled {
        let s = two_sum(self.high, other.high);
        if !s.high.is_finite() {
            return Doubled::new(s.high);
        }
        let t = two_sum(self.low, other.low);
        let v = quick_two_sum(s.high, s.low + t.high);
        quick_two_sum(v.high, t.low + v.low)
    }
}

impl Sub for Doubled {
    type Output = Doubled;
    fn sub(self, other: Doubled) -> Doubled {
        self + -other
    }
}

impl Mul for Doubled {
    type Output = Doubled;
    fn mul(self, other: Doubled) -> Doubled {
        let p = two_product(self.high, other.high);
        let cross = self.high.mul_add(other.low, self.low * other.high);
        quick_two_sum(p.high, p.low + cross)
    }
}

impl Div for Doubled {
    type Output = Doubled;
    fn div(self, other: Doubled) -> Doubled {
        let first = self.high / other.high;
        if first == 0.0 || !first.is_finite() || !other.high.is_finite() {
            return Doubled::new(first);
        }
        let rest = self - other * Doubled::new(first);
        let second = rest.high / other.high;
        let rest = rest - other * Doubled::new(second);
        quick_two_sum(first, second) + Doubled::new(rest.high / other.high)
    }
}

/// The sum and what its rounding leaves.
fn two_sum(a: f64, b: f64) -> Doubled {
    let s = a + b;
    let t = s - a;
    Doubled { high: s, low: (a - (s - t)) + (b - t) }
}

/// The same where `a` is the larger.
fn quick_two_sum(a: f64, b: f64) -> Doubled {
    let s = a + b;
    // Beyond the range there are no further digits, and infinity minus itself is no number.
    if s.is_finite() { Doubled { high: s, low: b - (s - a) } } else { Doubled::new(if a.is_finite() { s } else { a }) }
}

/// The product and what its rounding leaves.
fn two_product(a: f64, b: f64) -> Doubled {
    let p = a * b;
    if p.is_finite() { Doubled { high: p, low: a.mul_add(b, -p) } } else { Doubled::new(p) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Parts of values that mpmath gives to 60 digits.
    fn near(x: Doubled, high: f64, low: f64) {
        let rest = (x - Doubled { high, low }).high.abs();
        assert!(rest <= 4.0 * ROUNDING * high.abs(), "{x:?} is not {high:e} + {low:e}: {rest:e}");
    }

    #[test]
    fn functions_to_thirty_one_digits() {
        let d = Doubled::new;
        for (x, [sh, sl, ch, cl]) in [
            (0.3, [0.29552020666133955, 1.8315357276792536e-17, 0.955336489125606, 4.1935600297907467e-17]),
            (1.0, [0.8414709848078965, 1.776845092935536e-18, 0.5403023058681398, -4.760954612604417e-17]),
            (-2.5, [-0.5984721441039565, 5.521403334082375e-17, -0.8011436155469337, -1.8674742705085553e-17]),
            (10.7, [-0.9566350162701879, 1.0101262244931229e-17, -0.2912892817213455, -2.28466139171364e-17]),
            (12345.678, [-0.7040813137533816, -1.9646969196301474e-17, 0.7101193587160628, -2.4815747415365305e-17]),
        ] {
            let (sin, cos) = d(x).sin_cos();
            near(sin, sh, sl);
            near(cos, ch, cl);
        }
        near(d(2.0).sqrt(), std::f64::consts::SQRT_2, -9.667293313452913e-17);
        near(d(0.3).sqrt(), 0.5477225575051661, 2.890126723719787e-17);
        near(d(1.0).atan2(d(2.0)), 0.4636476090008061, 2.2698777452961687e-17);
        near(d(-3.0).atan2(d(-1.0)), -1.892546881191539, 9.738372121068368e-17);
        near(d(1.0).exp(), std::f64::consts::E, 1.4456468917292502e-16);
        near(d(-12.5).exp(), 3.726653172078671e-06, 5.469656173191849e-23);
        near(d(3.0).ln(), 1.0986122886681098, -9.07129723500153e-17);
        near(d(0.3).ln(), -1.2039728043259361, 8.935521583403776e-17);
        near(d(0.1).sinh(), 0.10016675001984403, 3.3613961287681504e-18);
        near(d(2.0).tanh(), 0.9640275800758169, -1.9413550547557176e-17);
        near(d(0.5).asin() + d(0.5).acos(), HALF_PI[0], HALF_PI[1]);
        near(d(2.0).powf(d(0.5)), std::f64::consts::SQRT_2, -9.667293313452913e-17);
    }

    #[test]
    fn identities_hold_to_the_last_digits() {
        for k in -200..200 {
            let x = Doubled::new(0.377 * f64::from(k)) + Doubled::new(1e-20 * f64::from(k));
            let (sin, cos) = x.sin_cos();
            assert!((sin * sin + cos * cos - Doubled::ONE).high.abs() < 4.0 * ROUNDING);
            let back = (sin.atan2(cos) - x) / Doubled { high: 2.0 * Doubled::PI.high, low: 2.0 * Doubled::PI.low };
            let turns = back.high.round();
            // Two pi is known to 32 digits only, times the turns.
            assert!((back - Doubled::new(turns)).high.abs() < 20.0 * ROUNDING * (1.0 + turns.abs()), "{k}");
            let third = Doubled::new(f64::from(k) + 0.5) / Doubled::new(3.0);
            assert!((third * Doubled::new(3.0) - Doubled::new(f64::from(k) + 0.5)).high.abs() < 200.0 * ROUNDING);
            let root = third.abs().sqrt();
            assert!((root * root - third.abs()).high.abs() < 4.0 * ROUNDING * third.high.abs());
        }
    }

    #[test]
    fn ends_of_the_range() {
        assert_eq!((Doubled::new(1e200) * Doubled::new(1e200)).high, f64::INFINITY);
        assert_eq!((Doubled::new(f64::MAX) + Doubled::new(f64::MAX)).high, f64::INFINITY);
        assert!((Doubled::ONE / Doubled::ZERO).high.is_infinite());
        assert!(Doubled::new(-1.0).sqrt().high.is_nan());
        assert_eq!(Doubled::new(1000.0).exp().high, f64::INFINITY);
        assert_eq!(Doubled::ZERO.sqrt(), Doubled::ZERO);
        assert_eq!(Doubled::ZERO.atan2(Doubled::ONE), Doubled::ZERO);
        assert_eq!(Doubled::new(f64::INFINITY).atan2(Doubled::ONE).high, std::f64::consts::FRAC_PI_2);
        // Beyond the digits that pi has here an angle is that of double precision.
        let (sin, cos) = Doubled::new(1e300).sin_cos();
        assert_eq!((sin.high, cos.high), 1e300_f64.sin_cos());
    }
}
