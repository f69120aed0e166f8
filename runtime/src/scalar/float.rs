//! Elementary functions of `f32` and `f64`, from std where it is there and from libm elsewhere.
//!
//! In: one float. Out: the platform's best value. This is the only place that asks which of the two is at hand.

#[cfg(not(any(feature = "std", feature = "libm")))]
compile_error!("multibody needs elementary functions: turn on the feature `std` or, without std, `libm`");

macro_rules! elementary {
    ($module:ident, $float:ident, $sincos:ident: $($name:ident($($arg:ident),+) = $libm:ident;)+) => {
        #[allow(dead_code)] // the two modules hold the same set
        pub(crate) mod $module {
            $(
                #[inline]
                pub(crate) fn $name($($arg: $float),+) -> $float {
                    #[cfg(feature = "std")]
                    return $float::$name($($arg),+);
                    #[cfg(all(not(feature = "std"), feature = "libm"))]
                    return libm::$libm($($arg),+);
                    #[cfg(not(any(feature = "std", feature = "libm")))]
                    return [$($arg),+][0];
                }
            )+

            #[inline]
            pub(crate) fn sin_cos(x: $float) -> ($float, $float) {
                #[cfg(feature = "std")]
                return x.sin_cos();
                #[cfg(all(not(feature = "std"), feature = "libm"))]
                return libm::$sincos(x);
            }
        }
    };
}

elementary! { double, f64, sincos:
    sin(x) = sin; cos(x) = cos; tan(x) = tan; asin(x) = asin; acos(x) = acos; atan(x) = atan; atan2(y, x) = atan2;
    sinh(x) = sinh; cosh(x) = cosh; tanh(x) = tanh; exp(x) = exp; ln(x) = log; powf(x, y) = pow; sqrt(x) = sqrt;
    hypot(x, y) = hypot; floor(x) = floor;
}
elementary! { single, f32, sincosf:
    sin(x) = sinf; cos(x) = cosf; tan(x) = tanf; asin(x) = asinf; acos(x) = acosf; atan(x) = atanf;
    atan2(y, x) = atan2f; sinh(x) = sinhf; cosh(x) = coshf; tanh(x) = tanhf; exp(x) = expf; ln(x) = logf;
    powf(x, y) = powf; sqrt(x) = sqrtf; hypot(x, y) = hypotf; floor(x) = floorf;
}
