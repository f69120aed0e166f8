//! Elementary functions of `f32` and `f64`: the platform's, or plain ones that are the same everywhere.
//!
//! With std they are the platform's. Without it, or with the feature `reproducible`, sine, cosine, tangent and their inverses are those
//! of [`super::software`] and the others libm's. A root and `floor` are exact, so std and hardware give them wherever they
//! can. This is the only place that asks which is at hand.

#[cfg(not(any(feature = "std", feature = "libm")))]
compile_error!("multibody needs elementary functions: turn on the feature `std` or, without std, `libm`");

/// Whether a product and a sum are one instruction that rounds once, and the user has asked for it. Targets without std have
/// no function for it in `core`, and where bits are the same everywhere there is none.
#[cfg(any(feature = "std", feature = "wide"))]
pub(crate) const FUSED: bool = cfg!(all(
    feature = "fma",
    feature = "std",
    not(feature = "reproducible"),
    any(all(any(target_arch = "x86", target_arch = "x86_64"), target_feature = "fma"), target_arch = "aarch64")
));

macro_rules! elementary {
    ($float:ident: $($name:ident($($arg:ident),+) = $libm:ident;)+) => {
        $(
            #[inline]
            pub(crate) fn $name($($arg: $float),+) -> $float {
                #[cfg(all(feature = "std", not(feature = "reproducible")))]
                return $float::$name($($arg),+);
                #[cfg(all(feature = "libm", any(not(feature = "std"), feature = "reproducible")))]
                return libm::$libm($($arg),+);
                #[cfg(not(any(feature = "std", feature = "libm")))]
                return [$($arg),+][0];
            }
        )+

        #[inline]
        pub(crate) fn sin_cos(x: $float) -> ($float, $float) {
            #[cfg(all(feature = "std", not(feature = "reproducible")))]
            return x.sin_cos();
            #[cfg(any(not(feature = "std"), feature = "reproducible"))]
            return super::super::software::sine::$float::sin_cos(x);
        }

        #[inline]
        pub(crate) fn tan(x: $float) -> $float {
            #[cfg(all(feature = "std", not(feature = "reproducible")))]
            return x.tan();
            #[cfg(any(not(feature = "std"), feature = "reproducible"))]
            {
                let (sin, cos) = sin_cos(x);
                sin / cos
            }
        }

        #[inline]
        pub(crate) fn atan2(y: $float, x: $float) -> $float {
            #[cfg(all(feature = "std", not(feature = "reproducible")))]
            return y.atan2(x);
            #[cfg(any(not(feature = "std"), feature = "reproducible"))]
            return super::super::software::arctangent::$float::atan2(y, x);
        }

        #[inline]
        pub(crate) fn atan(x: $float) -> $float {
            #[cfg(all(feature = "std", not(feature = "reproducible")))]
            return x.atan();
            #[cfg(any(not(feature = "std"), feature = "reproducible"))]
            return atan2(x, 1.0);
        }

        #[inline]
        pub(crate) fn asin(x: $float) -> $float {
            #[cfg(all(feature = "std", not(feature = "reproducible")))]
            return x.asin();
            #[cfg(any(not(feature = "std"), feature = "reproducible"))]
            return atan2(x, sqrt((1.0 - x) * (1.0 + x)));
        }

        #[inline]
        pub(crate) fn acos(x: $float) -> $float {
            #[cfg(all(feature = "std", not(feature = "reproducible")))]
            return x.acos();
            #[cfg(any(not(feature = "std"), feature = "reproducible"))]
            return atan2(sqrt((1.0 - x) * (1.0 + x)), x);
        }
    };
}

macro_rules! exact {
    ($float:ident, $floor:ident) => {
        #[inline]
        pub(crate) fn sqrt(x: $float) -> $float {
            super::super::root::$float(x)
        }

        #[inline(always)]
        pub(crate) fn mul_add(x: $float, factor: $float, addend: $float) -> $float {
            #[cfg(feature = "std")]
            if super::FUSED {
                return x.mul_add(factor, addend);
            }
            x * factor + addend
        }

        #[inline]
        pub(crate) fn floor(x: $float) -> $float {
            #[cfg(feature = "std")]
            return x.floor();
            #[cfg(not(feature = "std"))]
            return libm::$floor(x);
        }
    };
}

pub(crate) mod double {
    elementary! { f64:
        sinh(x) = sinh; cosh(x) = cosh; tanh(x) = tanh; exp(x) = exp; ln(x) = log; powf(x, y) = pow; hypot(x, y) = hypot;
    }
    exact! { f64, floor }
}

pub(crate) mod single {
    elementary! { f32:
        sinh(x) = sinhf; cosh(x) = coshf; tanh(x) = tanhf; exp(x) = expf; ln(x) = logf; powf(x, y) = powf; hypot(x, y) = hypotf;
    }
    exact! { f32, floorf }
}
