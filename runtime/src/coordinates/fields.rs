//! Implementations that go field by field, written once.

/// `Default`, `Tangent` and, where displacement is a sum in every field, `Configuration`.
macro_rules! field_by_field {
    (tangent $name:ident { $($field:ident),+ }) => {
        impl<T: $crate::Real> Default for $name<T> {
            #[inline]
            fn default() -> Self {
                $crate::Tangent::zero()
            }
        }

        impl<T: $crate::Real> $crate::Tangent<T> for $name<T> {
            #[inline]
            fn zero() -> Self {
                Self { $($field: $crate::Tangent::zero()),+ }
            }
            #[inline]
            fn zip<F: FnMut(T, T) -> T>(&self, other: &Self, f: &mut F) -> Self {
                Self { $($field: $crate::Tangent::zip(&self.$field, &other.$field, f)),+ }
            }
            #[inline]
            fn fold<A, F: FnMut(A, T) -> A>(&self, start: A, f: &mut F) -> A {
                $(let start = $crate::Tangent::fold(&self.$field, start, f);)+
                start
            }
        }
    };
    (coordinates $name:ident { $($field:ident),+ }) => {
        $crate::coordinates::fields::field_by_field! { tangent $name { $($field),+ } }

        impl<T: $crate::Real> $crate::Configuration<T> for $name<T> {
            type Velocity = Self;

            #[inline]
            fn displace(&self, d: &Self) -> Self {
                $crate::Tangent::add(self, d)
            }
            #[inline]
            fn advance(&self, d: &Self, rest: &Self) -> (Self, Self) {
                $crate::configuration::advanced(self, d, rest)
            }
            #[inline]
            fn dexp_inv(_: &Self, v: &Self) -> Self {
                *v
            }
            #[inline]
            fn magnitude(&self) -> Self {
                *self
            }
        }
    };
}

pub(crate) use field_by_field;
