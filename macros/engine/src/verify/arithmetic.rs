//! Stage `verify`: the two kinds of numbers in which equations are evaluated.
//!
//! In: operations. Out: their values in double precision, or to 31 digits ([`Doubled`]).

use crate::contracts::call::Call;
use crate::symbolic::doubled::Doubled;
use crate::symbolic::evaluate::call_f64;
use crate::symbolic::external;
use crate::symbolic::number::Number;

/// What evaluation asks of a number.
pub(super) trait Arithmetic: Copy {
    const ZERO: Self;
    const ONE: Self;
    fn number(n: Number) -> Self;
    fn doubled(x: Doubled) -> Self;
    /// Rounded to double precision.
    fn high(self) -> f64;
    /// What rounding leaves out.
    fn low(self) -> f64;
    fn add(self, other: Self) -> Self;
    fn mul(self, other: Self) -> Self;
    fn neg(self) -> Self;
    fn reciprocal(self) -> Self;
    fn sqrt(self) -> Self;
    /// Cosine and sine.
    fn point(self) -> (Self, Self);
    fn call(call: Call, arguments: &[Self]) -> Self;

    fn of(x: f64) -> Self {
        Self::doubled(Doubled::new(x))
    }

    fn digits(self) -> Doubled {
        Doubled { high: self.high(), low: self.low() }
    }

    fn sub(self, other: Self) -> Self {
        self.add(other.neg())
    }
}

impl Arithmetic for f64 {
    const ZERO: f64 = 0.0;
    const ONE: f64 = 1.0;
    fn number(n: Number) -> f64 {
        n.value()
    }
    fn doubled(x: Doubled) -> f64 {
        x.high
    }
    fn high(self) -> f64 {
        self
    }
    fn low(self) -> f64 {
        0.0
    }
    fn add(self, other: f64) -> f64 {
        self + other
    }
    fn mul(self, other: f64) -> f64 {
        self * other
    }
    fn neg(self) -> f64 {
        -self
    }
    fn reciprocal(self) -> f64 {
        1.0 / self
    }
    fn sqrt(self) -> f64 {
        f64::sqrt(self)
    }
    fn point(self) -> (f64, f64) {
        (self.cos(), self.sin())
    }
    fn call(call: Call, arguments: &[f64]) -> f64 {
        call_f64(call, arguments)
    }
}

impl Arithmetic for Doubled {
    const ZERO: Doubled = Doubled::ZERO;
    const ONE: Doubled = Doubled::ONE;

    fn number(n: Number) -> Doubled {
        n.doubled()
    }
    fn doubled(x: Doubled) -> Doubled {
        x
    }
    fn high(self) -> f64 {
        self.high
    }
    fn low(self) -> f64 {
        self.low
    }
    fn add(self, other: Doubled) -> Doubled {
        self + other
    }
    fn mul(self, other: Doubled) -> Doubled {
        self * other
    }
    fn neg(self) -> Doubled {
        -self
    }
    fn reciprocal(self) -> Doubled {
        Doubled::ONE / self
    }
    fn sqrt(self) -> Doubled {
        Doubled::sqrt(self)
    }
    fn point(self) -> (Doubled, Doubled) {
        let (s, c) = self.sin_cos();
        (c, s)
    }

    fn call(call: Call, x: &[Doubled]) -> Doubled {
        let mask = |b: bool| if b { Doubled::ONE } else { Doubled::ZERO };
        let is = |x: &Doubled| x.high != 0.0;
        match (call, x) {
            (Call::Sqrt, [a]) => Doubled::sqrt(*a),
            (Call::Tan, [a]) => a.tan(),
            (Call::Asin, [a]) => a.asin(),
            (Call::Acos, [a]) => a.acos(),
            (Call::Atan, [a]) => a.atan(),
            (Call::Atan2, [a, b]) => a.atan2(*b),
            (Call::Sinh, [a]) => a.sinh(),
            (Call::Cosh, [a]) => a.cosh(),
            (Call::Tanh, [a]) => a.tanh(),
            (Call::Exp, [a]) => a.exp(),
            (Call::Ln, [a]) => a.ln(),
            (Call::Powf, [a, b]) => a.powf(*b),
            (Call::Abs, [a]) => Doubled::abs(*a),
            (Call::Min, [a, b]) => *if a.high.is_nan() || a < b { a } else { b },
            (Call::Max, [a, b]) => *if a.high.is_nan() || a > b { a } else { b },
            (Call::Less, [a, b]) => mask(a < b),
            (Call::LessEqual, [a, b]) => mask(a <= b),
            (Call::Equal, [a, b]) => mask(a == b),
            (Call::And, [a, b]) => mask(is(a) && is(b)),
            (Call::Or, [a, b]) => mask(is(a) || is(b)),
            (Call::Not, [a]) => mask(!is(a)),
            (Call::Select, [m, a, b]) => *if is(m) { a } else { b },
            _ => external::value(call, x).unwrap_or_else(|| {
                let highs: Vec<f64> = x.iter().map(|x| x.high).collect();
                Doubled::new(call_f64(call, &highs))
            }),
        }
    }
}

/// Partial derivatives of a function of one or two numbers; those of masks are zero.
pub(super) fn slopes(call: Call, x: &[f64]) -> [f64; 2] {
    let one = |slope: f64| [slope, 0.0];
    match (call, x) {
        (Call::Tan, [a]) => one(1.0 + a.tan() * a.tan()),
        (Call::Asin, [a]) => one(1.0 / (1.0 - a * a).sqrt()),
        (Call::Acos, [a]) => one(-1.0 / (1.0 - a * a).sqrt()),
        (Call::Atan, [a]) => one(1.0 / (1.0 + a * a)),
        (Call::Atan2, [y, x]) => {
            let square = x * x + y * y;
            [x / square, -y / square]
        }
        (Call::Sinh, [a]) => one(a.cosh()),
        (Call::Cosh, [a]) => one(a.sinh()),
        (Call::Tanh, [a]) => one(1.0 - a.tanh() * a.tanh()),
        (Call::Exp, [a]) => one(a.exp()),
        (Call::Ln, [a]) => one(1.0 / a),
        (Call::Powf, [a, b]) => [b * a.powf(b - 1.0), if *a > 0.0 { a.powf(*b) * a.ln() } else { 0.0 }],
        (Call::Abs, [a]) => one(if *a < 0.0 { -1.0 } else { 1.0 }),
        (Call::Min, [a, b]) => {
            if a < b {
                [1.0, 0.0]
            } else {
                [0.0, 1.0]
            }
        }
        (Call::Max, [a, b]) => {
            if a > b {
                [1.0, 0.0]
            } else {
                [0.0, 1.0]
            }
        }
        _ => [0.0, 0.0],
    }
}
