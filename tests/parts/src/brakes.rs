//! A part that calls a function of this crate's own Rust.

use multibody::{Function, Real, multibody};

/// Friction of a pad: the speed, then the force on it.
#[derive(Clone, Copy, Debug)]
pub struct Pad;

impl<T: Real> Function<T, 2> for Pad {
    fn value([speed, force]: [T; 2]) -> T {
        T::lit(-0.4) * force * Real::tanh(T::lit(20.0) * speed)
    }

    fn slopes([speed, force]: [T; 2]) -> [T; 2] {
        let share = Real::tanh(T::lit(20.0) * speed);
        [T::lit(-8.0) * force * (T::lit(1.0) - share * share), T::lit(-0.4) * share]
    }
}

multibody! {
    /// A brake on a hinge.
    pub mod brake {
        /// [N m]
        extern friction(speed, force) = crate::brakes::Pad;
        port hinge: Joint;
        /// [N]
        param force = 2.0;
        force drag: Effort { joint: hinge, value: friction(hinge.rate, force) }
    }

    /// Two brakes, on two hinges.
    pub mod brakes_of_two {
        port first: Joint;
        port second: Joint;
        part one: brake { hinge: first };
        part other: brake { hinge: second };
    }
}
