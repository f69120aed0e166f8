//! Two or four numbers that are worked with together: [`Two`], [`Four`], [`Packed`].
//!
//! Generated code puts what several limbs compute alike into one pack. Of `f64` and `f32` a pack is a vector of the processor, with
//! the feature `wide`; of any other scalar it is an array, member by member, so dual numbers, lanes and small machines take the
//! same code. Every operation is that of the scalar on each member, rounded as it is there: no value depends on what a pack is.

use core::ops::{Add, Div, Mul, Neg, Sub};

use super::Real;
#[cfg(feature = "wide")]
use super::float::FUSED;

/// `N` of a scalar, whose operations are those of the scalar on each of them.
pub trait Packed<T, const N: usize>:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self>
{
    /// From its members.
    fn of(members: [T; N]) -> Self;
    /// Its members.
    fn members(self) -> [T; N];
    /// The square root of each.
    #[must_use]
    fn roots(self) -> Self;
    /// [`Real::mul_add`] of each.
    #[must_use]
    #[inline(always)]
    fn mul_add(self, factor: Self, addend: Self) -> Self {
        self * factor + addend
    }
}

/// A pack of two or four of any scalar ([`Two`], [`Four`]): an array, worked with member by member.
///
/// ```
/// use multibody::{Four, Packed, Two};
///
/// let sum = Four::of([1.0, 2.0, 3.0, 4.0]) + Four::of([0.5; 4]);
/// assert_eq!(sum.members(), [1.5, 2.5, 3.5, 4.5]);
/// assert_eq!((-Two::of([1.0, 2.0])).members(), [-1.0, -2.0]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pack<T, const N: usize>([T; N]);

/// Two of any scalar.
pub type Two<T> = Pack<T, 2>;
/// Four of any scalar.
pub type Four<T> = Pack<T, 4>;

// Written out: a loop over arrays stays one in code that is optimised for size.
macro_rules! operator {
    ($count:literal $trait:ident $name:ident $operator:tt $($a:ident $x:ident),+) => {
        impl<T: Real> $trait for Pack<T, $count> {
            type Output = Self;
            #[inline(always)]
            fn $name(self, other: Self) -> Self {
                let ([$($a),+], [$($x),+]) = (self.0, other.0);
                Pack([$($a $operator $x),+])
            }
        }
    };
}

macro_rules! arrays {
    ($($count:literal: $($a:ident $x:ident $p:ident),+;)+) => { $(
        operator! { $count Add add + $($a $x),+ }
        operator! { $count Sub sub - $($a $x),+ }
        operator! { $count Mul mul * $($a $x),+ }
        operator! { $count Div div / $($a $x),+ }

        impl<T: Real> Neg for Pack<T, $count> {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                let [$($a),+] = self.0;
                Pack([$(-$a),+])
            }
        }

        impl<T: Real> Packed<T, $count> for Pack<T, $count> {
            #[inline(always)]
            fn of(members: [T; $count]) -> Self {
                Pack(members)
            }
            #[inline(always)]
            fn members(self) -> [T; $count] {
                self.0
            }
            #[inline(always)]
            fn roots(self) -> Self {
                let [$($a),+] = self.0;
                Pack([$(Real::sqrt($a)),+])
            }
            #[inline(always)]
            fn mul_add(self, factor: Self, addend: Self) -> Self {
                let ([$($a),+], [$($x),+], [$($p),+]) = (self.0, factor.0, addend.0);
                Pack([$(Real::mul_add($a, $x, $p)),+])
            }
        }
    )+ };
}

arrays! {
    2: a x p, b y q;
    4: a x p, b y q, c z r, d w s;
}

/// A pack in a vector of the processor, which may hold more numbers than the pack has.
#[cfg(feature = "wide")]
#[derive(Clone, Copy, Debug)]
pub struct Vector<V>(V);

#[cfg(feature = "wide")]
macro_rules! vector_operators {
    ($($trait:ident $name:ident)+) => { $(
        impl<V: $trait<Output = V>> $trait for Vector<V> {
            type Output = Self;
            #[inline(always)]
            fn $name(self, other: Self) -> Self {
                Vector($trait::$name(self.0, other.0))
            }
        }
    )+ };
}

#[cfg(feature = "wide")]
vector_operators! { Add add  Sub sub  Mul mul  Div div }

#[cfg(feature = "wide")]
impl<V: Neg<Output = V>> Neg for Vector<V> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Vector(-self.0)
    }
}

#[cfg(feature = "wide")]
macro_rules! vectors {
    ($($float:ident $count:literal $pack:path, $vector:ident: [$($member:ident)+] $($rest:literal)*;)+) => { $(
        impl Packed<$float, $count> for $pack {
            #[inline(always)]
            fn of([$($member),+]: [$float; $count]) -> Self {
                Self(wide::$vector::new([$($member,)+ $($rest),*]))
            }
            #[inline(always)]
            fn members(self) -> [$float; $count] {
                let [$($member,)+ ..] = self.0.to_array();
                [$($member),+]
            }
            #[inline(always)]
            fn roots(self) -> Self {
                Self(self.0.sqrt())
            }
            #[inline(always)]
            fn mul_add(self, factor: Self, addend: Self) -> Self {
                if FUSED { Self(self.0.mul_add(factor.0, addend.0)) } else { self * factor + addend }
            }
        }
    )+ };
}

#[cfg(feature = "wide")]
vectors! {
    f64 2 Vector<wide::f64x2>, f64x2: [a b];
    f64 4 simba::simd::WideF64x4, f64x4: [a b c d];
    f32 2 Vector<wide::f32x4>, f32x4: [a b] 0.0 0.0;
    f32 4 simba::simd::WideF32x4, f32x4: [a b c d];
}
