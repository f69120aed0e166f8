//! Sine and cosine to 30 digits, by Taylor's series in sums of two `f64`: no minimax polynomial, and another reduction than
//! that of the library. Held against the references of 2,000 bits in `reference`.

use std::f64::consts::FRAC_2_PI;

/// pi/2 in four parts of 53 bits (mpmath).
const HALF_PI: [f64; 4] =
    [std::f64::consts::FRAC_PI_2, 6.123_233_995_736_766e-17, -1.497_384_904_859_169_8e-33, 5.562_271_104_316_826e-50];

/// A sum of two numbers, of which the second is rounding of the first.
#[derive(Clone, Copy)]
pub(crate) struct Double(pub(crate) f64, pub(crate) f64);

impl Double {
    /// The sum of two numbers, exactly (Knuth).
    fn sum(a: f64, b: f64) -> Self {
        let s = a + b;
        let t = s - a;
        Self(s, (a - (s - t)) + (b - t))
    }

    /// The product of two numbers, exactly.
    fn product(a: f64, b: f64) -> Self {
        let p = a * b;
        Self(p, a.mul_add(b, -p))
    }

    fn plus(self, other: Self) -> Self {
        let (s, t) = (Self::sum(self.0, other.0), Self::sum(self.1, other.1));
        let s = Self::sum(s.0, s.1 + t.0);
        Self::sum(s.0, s.1 + t.1)
    }

    fn times(self, other: Self) -> Self {
        let p = Self::product(self.0, other.0);
        Self::sum(p.0, p.1 + (self.0 * other.1 + self.1 * other.0))
    }

    fn over(self, whole: f64) -> Self {
        let q = self.0 / whole;
        let p = Self::product(q, whole);
        Self::sum(q, ((self.0 - p.0) - p.1 + self.1) / whole)
    }

    fn negated(self) -> Self {
        Self(-self.0, -self.1)
    }

    /// How far a number is from this one, in units of the last place that it has in a float of `digits` bits.
    pub(crate) fn error(self, found: f64, digits: i32) -> f64 {
        // The unit on the side of zero, where the first part is a power of two that the value doesn't reach.
        let size = self.0.abs().to_bits() - u64::from(self.0 * self.1 < 0.0);
        let exponent = (size >> 52) as i32 - 1023;
        ((found - self.0) - self.1).abs() / 2f64.powi(exponent + 1 - digits)
    }
}

/// Of an angle up to a few million radians.
pub(crate) fn sin_cos(x: f64) -> (Double, Double) {
    let n = (x * FRAC_2_PI).round();
    // The parts come in order of size; the first difference is exact.
    let parts = HALF_PI.map(|part| Double::product(-n, part));
    let first = Double::sum(x, parts[0].0);
    let mut r = first.plus(Double(parts[0].1, 0.0));
    for part in &parts[1..] {
        r = r.plus(*part);
    }
    let squared = r.times(r).negated();
    let (mut sin, mut cos) = (r, Double(1.0, 0.0));
    let (mut odd, mut even) = (sin, cos);
    for k in 1..15 {
        let k = f64::from(2 * k);
        even = even.times(squared).over(k * (k - 1.0));
        odd = odd.times(squared).over(k * (k + 1.0));
        (cos, sin) = (cos.plus(even), sin.plus(odd));
    }
    match n.rem_euclid(4.0) as u8 {
        0 => (sin, cos),
        1 => (cos, sin.negated()),
        2 => (sin.negated(), cos.negated()),
        _ => (cos.negated(), sin),
    }
}

#[test]
fn reference() {
    let mut count = 0;
    for line in include_str!("../data/trigonometry.txt").lines() {
        let mut fields = line.split(' ');
        let name = fields.next().unwrap();
        let [x, sin, cos] = [0; 3].map(|_| f64::from_bits(u64::from_str_radix(fields.next().unwrap(), 16).unwrap()));
        // Near zero the square is no number any more.
        if name == "f64" && x < 2e6 && x > 1e-100 {
            let truth = sin_cos(x);
            assert_eq!((truth.0.0, truth.1.0), (sin, cos), "{x:e}");
            count += 1;
        }
    }
    assert_eq!(count, 69);
}
