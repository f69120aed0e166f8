//! Functions of the user's own, written in Rust: [`Function`].

use crate::scalar::Real;

/// A function of `N` scalars that a model calls: `extern grip(slip, load) = crate::Grip;`.
///
/// What has no formula in the language is written in Rust, such as a measured curve of a tyre, a lookup in a file's data, or a fit. Its
/// type needs no value. Calls stand in forces, springs, dampers, states and outputs.
///
/// ```
/// use multibody::{Function, Real, multibody};
///
/// /// Coulomb friction with a smooth change of sign: the speed, then the normal force.
/// pub struct Friction;
///
/// impl<T: Real> Function<T, 2> for Friction {
///     fn value([speed, load]: [T; 2]) -> T {
///         T::lit(-0.3) * load * Real::tanh(speed / T::lit(0.01))
///     }
///     fn slopes([speed, load]: [T; 2]) -> [T; 2] {
///         let share = Real::tanh(speed / T::lit(0.01));
///         [T::lit(-0.3 / 0.01) * load * (T::lit(1.0) - share * share), T::lit(-0.3) * share]
///     }
/// }
///
/// multibody! {
///     /// A block on a slope.
///     pub mod sledge {
///         /// [N]
///         extern friction(speed, load) = crate::Friction;
///         world { gravity: [1.7, 0.0, -9.66] }
///         body block { mass: 2.0 }
///         joint slide: Prismatic { parent: ground, child: block, axis: X }
///         force drag: Effort { joint: slide, value: friction(slide.rate, 2.0 * 9.66) }
///         emit forward_dynamics, derivatives;
///     }
/// }
///
/// # fn main() {
/// let model = sledge::Model::default();
/// let mut state = sledge::State::default();
/// state.v.slide = 0.02;
/// let acceleration = model.forward_dynamics(0.0, &state, &()).slide;
/// assert!((acceleration - (1.7 - 0.3 * 9.66 * 2.0_f64.tanh())).abs() < 1e-12);
/// # }
/// ```
///
/// # What the implementation answers for
///
/// The compiler of models never calls such a function, so these are for who writes it:
///
/// - It is *pure*: equal arguments give equal results. Calls with equal arguments are made once, those with nothing but parameters in
///   `Model::new`.
/// - It is *continuously differentiable*, and [`slopes`](Function::slopes) are its slopes: derivatives of models, implicit integrators and `diff` take them as
///   they come. [`slope_deviation`] compares them with differences, for a test.
/// - It does *not panic*, and takes the same time for all arguments where that matters. Here alone generated code
///   runs what is not generated: that it neither panics nor allocates holds as far as the function does neither.
///
/// Models are generic over their scalar, so an implementation is for all `T: Real`, and branches by
/// [`Real::select`]. Second slopes are never asked for: what needs them, such as
/// `diff` of a `diff`, is refused.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a `multibody::Function<_, {N}>`",
    label = "this has to be a `multibody::Function<T, {N}>` for every scalar `T`",
    note = "a model is generic over its scalar: `impl<T: multibody::Real> multibody::Function<T, {N}> for {Self} {{ .. }}`"
)]
pub trait Function<T: Real, const N: usize> {
    /// Its value.
    fn value(x: [T; N]) -> T;

    /// Its partial derivatives, one by each argument.
    fn slopes(x: [T; N]) -> [T; N];

    /// Both, for functions that share work between them. Where a model needs both this is what it calls, so it gives the same as
    /// the other two.
    #[inline]
    fn value_and_slopes(x: [T; N]) -> (T, [T; N]) {
        (Self::value(x), Self::slopes(x))
    }
}

/// How far the slopes of a function are from differences of its values at `x`: the greatest deviation, relative to one more than the slope. A
/// right implementation of moderate curvature comes out near 1e-9.
///
/// ```
/// use multibody::{Function, Real, slope_deviation};
///
/// struct Square;
/// impl<T: Real> Function<T, 1> for Square {
///     fn value([x]: [T; 1]) -> T {
///         x * x
///     }
///     fn slopes([x]: [T; 1]) -> [T; 1] {
///         [x + x]
///     }
/// }
/// assert!(slope_deviation::<Square, 1>([3.0]) < 1e-8);
/// ```
pub fn slope_deviation<F: Function<f64, N>, const N: usize>(x: [f64; N]) -> f64 {
    let slopes = F::slopes(x);
    let deviation = |k: usize| {
        // The cube root of the rounding: differences lose as many digits to it as to the curvature.
        let step = 6e-6 * (1.0 + Real::abs(x[k]));
        let at = |place: f64| {
            let mut x = x;
            x[k] = place;
            (place, F::value(x))
        };
        let ((after, high), (before, low)) = (at(x[k] + step), at(x[k] - step));
        Real::abs((high - low) / (after - before) - slopes[k]) / (1.0 + Real::abs(slopes[k]))
    };
    // What is no number is no small deviation.
    (0..N).map(deviation).fold(0.0, |most, x| if most.is_nan() || x <= most { most } else { x })
}
