//! [`Real`] for the dual numbers of num-dual: derivatives of generated functions without a line of new code.
//!
//! Comparisons look at real parts. Where num-dual's own function divides by what may vanish (`atan2` on the axes,
//! `powf` at zero) or panics (`floor`), the derivative is formed here.

use super::Real;
use nalgebra::Const;
use num_dual::{Dual, Dual2, Dual2Vec, Dual3, DualNum, DualVec, HyperDual, HyperDualVec, HyperHyperDual};

/// `f(x)` from the derivatives `[f, f', f'', f''']` at the real part: the infinitesimal part of `x` is nilpotent, so
/// Taylor's series ends by itself. Terms above the order of `D` are left out, since they may be infinite.
fn taylor<D: DualNum + Copy>(x: D, real: D, f: [D; 4]) -> D {
    let d = x - real;
    let two = D::one() + D::one();
    let mut sum = f[0];
    if D::NDERIV >= 1 {
        sum += f[1] * d;
    }
    if D::NDERIV >= 2 {
        sum += f[2] * d * d / two;
    }
    if D::NDERIV >= 3 {
        sum += f[3] * d * d * d / (two + two + two);
    }
    sum
}

macro_rules! forward {
    ($($name:ident)+) => {
        $(
            #[inline]
            fn $name(self) -> Self {
                DualNum::$name(&self)
            }
        )+
    };
}

macro_rules! dual {
    ($float:ident: $([$($size:ident)*] $dual:ty;)+) => {
        $(
            impl<$(const $size: usize),*> Real for $dual {
                type Mask = bool;
                type Two = super::Two<Self>;
                type Four = super::Four<Self>;

                #[inline]
                fn lit(value: f64) -> Self {
                    Self::from_re(value as $float)
                }
                #[inline]
                fn sin_cos(self) -> (Self, Self) {
                    DualNum::sin_cos(&self)
                }
                forward! { tan asin acos atan sinh cosh tanh exp ln sqrt }
                #[inline]
                fn atan2(self, x: Self) -> Self {
                    // The quotient that does not exceed one: both have the derivatives of the angle.
                    let mut angle = if x.re.abs() >= self.re.abs() {
                        DualNum::atan(&(self / x))
                    } else {
                        -DualNum::atan(&(x / self))
                    };
                    angle.re = self.re.atan2(x.re);
                    angle
                }
                #[inline]
                fn powf(self, exponent: Self) -> Self {
                    let (x, n) = (self.re, exponent.re);
                    let one = 1.0 as $float;
                    let f = [
                        x.powf(n),
                        n * x.powf(n - one),
                        n * (n - one) * x.powf(n - one - one),
                        n * (n - one) * (n - one - one) * x.powf(n - one - one - one),
                    ];
                    let power = taylor(self, Self::from_re(x), f.map(Self::from_re));
                    // By the exponent there is a derivative for positive bases only.
                    if x > 0.0 { power * DualNum::exp(&((exponent - Self::from_re(n)) * DualNum::ln(&self))) } else { power }
                }
                #[inline]
                fn hypot(self, other: Self) -> Self {
                    DualNum::sqrt(&(self * self + other * other))
                }
                #[inline]
                fn abs(self) -> Self {
                    if self.re.is_sign_negative() { -self } else { self }
                }
                #[inline]
                fn signum(self) -> Self {
                    Self::from_re(Real::signum(self.re))
                }
                #[inline]
                fn floor(self) -> Self {
                    Self::from_re(self.re.floor())
                }
                #[inline]
                fn lt(self, other: Self) -> bool {
                    self.re < other.re
                }
                #[inline]
                fn le(self, other: Self) -> bool {
                    self.re <= other.re
                }
                #[inline]
                fn eq(self, other: Self) -> bool {
                    self.re == other.re
                }
                #[inline]
                fn select(mask: bool, a: Self, b: Self) -> Self {
                    if mask { a } else { b }
                }
                #[inline]
                fn greatest(self) -> f64 {
                    f64::from(self.re)
                }
            }
        )+
    };
}

macro_rules! duals {
    ($float:ident) => {
        dual! { $float:
            [] Dual<$float>;
            [] Dual2<$float>;
            [] Dual3<$float>;
            [] HyperDual<$float>;
            [] HyperHyperDual<$float>;
            [N] DualVec<$float, Const<N>>;
            [N] Dual2Vec<$float, Const<N>>;
            [M N] HyperDualVec<$float, Const<M>, Const<N>>;
        }
    };
}

duals!(f32);
duals!(f64);
