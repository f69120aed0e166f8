//! How often functions are called: once for equal arguments, with the value where slopes are read too, and in `Model::new` where
//! parameters alone are read.

use std::cell::RefCell;

use multibody::{Function, Real, multibody, slope_deviation};

thread_local! {
    static CALLS: RefCell<Vec<&'static str>> = const { RefCell::new(Vec::new()) };
}

fn note(what: &'static str) {
    CALLS.with_borrow_mut(|calls| calls.push(what));
}

/// What has been called since the last time.
fn noted() -> Vec<&'static str> {
    CALLS.with_borrow_mut(std::mem::take)
}

/// Tells of its calls, which no function of a user's may.
pub(crate) struct Noted;

impl<T: Real> Function<T, 1> for Noted {
    fn value([x]: [T; 1]) -> T {
        note("value");
        x * x
    }

    fn slopes([x]: [T; 1]) -> [T; 1] {
        note("slopes");
        [x + x]
    }

    fn value_and_slopes([x]: [T; 1]) -> (T, [T; 1]) {
        note("both");
        (x * x, [x + x])
    }
}

multibody! {
    pub(crate) mod slider {
        extern square(x) = crate::calls::Noted;
        param stiffness = 3.0;
        body block { mass: 2.0 }
        joint slide: Prismatic { parent: ground, child: block, axis: X }
        force spring: Effort { joint: slide, value: -square(slide) - square(2.0) }
        force again: Effort { joint: slide, value: -square(stiffness) * slide - square(slide + 0.0) * slide.rate }
        output twice = square(slide) + 3.0 * square(slide);
        output slope = square(slide) + diff(square(slide), slide);
        emit forward_dynamics, derivatives, outputs { one: [twice], two: [slope] };
    }
}

use slider::{Model, Params, State};

#[test]
fn calls_are_made_once() {
    noted();
    let model = Model::new(&Params { stiffness: 5.0 });
    assert_eq!(noted(), ["value"; 2], "of the parameter, and of a literal");
    let mut state = State::default();
    (state.q.slide, state.v.slide) = (0.3, 0.5);
    let acceleration = model.forward_dynamics(0.0, &state, &()).slide;
    assert_eq!(noted(), ["value"]);
    let square = 0.09;
    assert!((acceleration - (-square - 4.0 - 25.0 * 0.3 - square * 0.5) / 2.0).abs() < 1e-15);
    let slopes = model.forward_derivatives(0.0, &state, &());
    assert_eq!(noted(), ["both"]);
    assert!((slopes.position[0] - (-0.6 - 25.0 - 0.6 * 0.5) / 2.0).abs() < 1e-14);
    assert!((slopes.velocity[0] + square / 2.0).abs() < 1e-15);
    assert!((model.outputs_one(0.0, &state, &()).twice - 4.0 * square).abs() < 1e-15);
    assert_eq!(noted(), ["value"]);
    assert!((model.outputs_two(0.0, &state, &()).slope - square - 0.6).abs() < 1e-15);
    assert_eq!(noted(), ["both"]);
}

/// Its second slope is wrong.
struct Mistaken;

impl<T: Real> Function<T, 2> for Mistaken {
    fn value([x, y]: [T; 2]) -> T {
        x * y
    }

    fn slopes([x, y]: [T; 2]) -> [T; 2] {
        [y, x + T::lit(1e-3)]
    }
}

#[test]
fn slopes_are_compared_with_differences() {
    assert!(slope_deviation::<crate::Grip, 2>([0.4, 300.0]) < 1e-8);
    assert!(slope_deviation::<crate::Blend, 3>([0.4, -2.0, 1.7]) < 1e-8);
    let deviation = slope_deviation::<Mistaken, 2>([0.4, 3.0]);
    assert!((deviation - 1e-3 / 1.401).abs() < 1e-8, "{deviation}");
    assert!(slope_deviation::<Mistaken, 2>([f64::NAN, 3.0]).is_nan());
}
