//! What integrators ask of velocities, accelerations and displacements: [`Tangent`].
//!
//! All three live in the same vector space, one component for each degree of freedom. The operations are those of a
//! vector space and of a weighted norm; they work component by component, so that no type has to be an array.

use crate::Real;
use nalgebra::SVector;

/// A vector of components of the scalar `T`: velocities, accelerations, or rates of a model's own states.
///
/// Generated structs implement the three required functions field by field; every field type implements the trait
/// too. `()` is the vector without components. Scalars, `SVector`, arrays and pairs of tangents are tangents.
///
/// ```
/// use multibody::{Real, Tangent};
///
/// #[derive(Clone, Copy)]
/// struct Velocity<T> { cart: T, poles: [T; 2] }
///
/// impl<T: Real> Tangent<T> for Velocity<T> {
///     fn zero() -> Self {
///         Self { cart: Tangent::zero(), poles: Tangent::zero() }
///     }
///     fn zip<F: FnMut(T, T) -> T>(&self, other: &Self, f: &mut F) -> Self {
///         Self { cart: Tangent::zip(&self.cart, &other.cart, f), poles: Tangent::zip(&self.poles, &other.poles, f) }
///     }
///     fn fold<A, F: FnMut(A, T) -> A>(&self, start: A, f: &mut F) -> A {
///         let start = Tangent::fold(&self.cart, start, f);
///         Tangent::fold(&self.poles, start, f)
///     }
/// }
/// let v = Velocity { cart: 1.0, poles: [2.0, 3.0] };
/// assert_eq!(v.add_scaled(2.0, &v).poles, [6.0, 9.0]);
/// ```
pub trait Tangent<T: Real>: Copy {
    /// All components zero.
    fn zero() -> Self;

    /// A function of the components of two vectors, one by one.
    fn zip<F: FnMut(T, T) -> T>(&self, other: &Self, f: &mut F) -> Self;

    /// A value accumulated over the components, in the order of declaration.
    fn fold<A, F: FnMut(A, T) -> A>(&self, start: A, f: &mut F) -> A;

    /// A function of every component.
    #[inline]
    fn map<F: FnMut(T) -> T>(&self, f: &mut F) -> Self {
        self.zip(self, &mut |a, _| f(a))
    }

    /// `factor * self`.
    #[inline]
    fn scale(&self, factor: T) -> Self {
        self.map(&mut |a| factor * a)
    }

    /// `self + other`.
    #[inline]
    fn add(&self, other: &Self) -> Self {
        self.zip(other, &mut |a, b| a + b)
    }

    /// `self + factor * other`.
    #[inline]
    fn add_scaled(&self, factor: T, other: &Self) -> Self {
        self.zip(other, &mut |a, b| a + factor * b)
    }

    /// The number of components.
    #[inline]
    fn len(&self) -> usize {
        self.fold(0, &mut |count, _| count + 1)
    }

    /// Whether there are no components.
    #[inline]
    fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

impl<T: Real> Tangent<T> for () {
    #[inline]
    fn zero() -> Self {}
    #[inline]
    fn zip<F: FnMut(T, T) -> T>(&self, _: &Self, _: &mut F) -> Self {}
    #[inline]
    fn fold<A, F: FnMut(A, T) -> A>(&self, start: A, _: &mut F) -> A {
        start
    }
}

impl<T: Real> Tangent<T> for T {
    #[inline]
    fn zero() -> Self {
        T::lit(0.0)
    }
    #[inline]
    fn zip<F: FnMut(T, T) -> T>(&self, other: &Self, f: &mut F) -> Self {
        f(*self, *other)
    }
    #[inline]
    fn fold<A, F: FnMut(A, T) -> A>(&self, start: A, f: &mut F) -> A {
        f(start, *self)
    }
}

impl<T: Real, const N: usize> Tangent<T> for SVector<T, N> {
    #[inline]
    fn zero() -> Self {
        Self::from([T::lit(0.0); N])
    }
    #[inline]
    fn zip<F: FnMut(T, T) -> T>(&self, other: &Self, f: &mut F) -> Self {
        let mut result = *self;
        for (a, b) in result.as_mut_slice().iter_mut().zip(other.as_slice()) {
            *a = f(*a, *b);
        }
        result
    }
    #[inline]
    fn fold<A, F: FnMut(A, T) -> A>(&self, start: A, f: &mut F) -> A {
        self.as_slice().iter().fold(start, |sum, a| f(sum, *a))
    }
}

impl<T: Real, V: Tangent<T>, const N: usize> Tangent<T> for [V; N] {
    #[inline]
    fn zero() -> Self {
        [V::zero(); N]
    }
    #[inline]
    fn zip<F: FnMut(T, T) -> T>(&self, other: &Self, f: &mut F) -> Self {
        let mut result = *self;
        for (a, b) in result.iter_mut().zip(other) {
            *a = a.zip(b, f);
        }
        result
    }
    #[inline]
    fn fold<A, F: FnMut(A, T) -> A>(&self, start: A, f: &mut F) -> A {
        self.iter().fold(start, |sum, a| a.fold(sum, f))
    }
}

impl<T: Real, V: Tangent<T>, W: Tangent<T>> Tangent<T> for (V, W) {
    #[inline]
    fn zero() -> Self {
        (V::zero(), W::zero())
    }
    #[inline]
    fn zip<F: FnMut(T, T) -> T>(&self, other: &Self, f: &mut F) -> Self {
        (self.0.zip(&other.0, f), self.1.zip(&other.1, f))
    }
    #[inline]
    fn fold<A, F: FnMut(A, T) -> A>(&self, start: A, f: &mut F) -> A {
        let start = self.0.fold(start, f);
        self.1.fold(start, f)
    }
}

/// The greatest size of a component in each lane; NaN if one is.
pub(crate) fn greatest<T: Real, V: Tangent<T>>(v: &V) -> T {
    v.fold(T::lit(0.0), &mut |greatest, x| Real::max(greatest, Real::abs(x)))
}

/// One in the component `k`, zero in the others.
#[inline]
pub(crate) fn unit<T: Real, V: Tangent<T>>(k: usize) -> V {
    let mut places = 0..;
    V::zero().map(&mut |zero| if places.next() == Some(k) { T::lit(1.0) } else { zero })
}

/// The components of a vector in their order, written into a list; what the list has more stays as it is.
#[inline]
pub(crate) fn pack<T: Real, V: Tangent<T>>(vector: &V, list: &mut [T]) {
    let mut places = list.iter_mut();
    vector.fold((), &mut |(), component| {
        if let Some(place) = places.next() {
            *place = component;
        }
    });
}

/// The vector with the components of a list in their order, zero where the list ends.
#[inline]
pub(crate) fn unpack<T: Real, V: Tangent<T>>(list: &[T]) -> V {
    let mut components = list.iter().copied();
    V::zero().map(&mut |zero| components.next().unwrap_or(zero))
}
