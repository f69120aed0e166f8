//! Functions of Rust: in this crate, in a part of another crate, and in one of this crate that has the same text.
use multibody::{Function, Real, multibody};

mod brakes {
    use multibody::{Function, Real, multibody};

    pub struct Pad;

    impl<T: Real> Function<T, 2> for Pad {
        fn value([speed, force]: [T; 2]) -> T {
            speed * force
        }
        fn slopes([speed, force]: [T; 2]) -> [T; 2] {
            [force, speed]
        }
    }

    multibody! {
        /// A brake on a hinge.
        pub(crate) mod brake {
            /// [N m]
            extern friction(speed, force) = crate::brakes::Pad;
            port hinge: Joint;
            /// [N]
            param force = 2.0;
            force drag: Effort { joint: hinge, value: friction(hinge.rate, force) }
        }
    }
}

/// Of any number of scalars.
pub struct Sum<const SIGN: i8>;

impl<T: Real, const N: usize, const SIGN: i8> Function<T, N> for Sum<SIGN> {
    fn value(x: [T; N]) -> T {
        x.into_iter().fold(T::lit(0.0), |sum, x| sum + T::lit(f64::from(SIGN)) * x)
    }
    fn slopes(_: [T; N]) -> [T; N] {
        [T::lit(f64::from(SIGN)); N]
    }
}

/// Where a macro of this crate writes the call.
macro_rules! summed {
    ($name:ident, $($arguments:ident),+) => {
        multibody! {
            mod $name {
                extern sum($($arguments),+) = $crate::Sum<-1>;
                body plate { mass: 1.0, inertia: diag(1.0, 1.0, 2.0) }
                joint turn: Revolute { parent: ground, child: plate, axis: Z }
                state a: rate = 0.0, start: 0.5;
                state b: rate = 0.0, start: 0.25;
                state c: rate = 0.0, start: 2.0;
                force effort: Effort { joint: turn, value: sum($($arguments),+) }
            }
        }
    };
}
summed!(of_one, a);
summed!(of_three, a, b, c);

multibody! {
    use multibody_test_parts::brakes::{brake as theirs, brakes_of_two};
    use brakes::brake as ours;
    mod wheels {
        body left { mass: 1.0, inertia: diag(1.0, 1.0, 2.0) }
        body right { mass: 1.0, inertia: diag(1.0, 1.0, 2.0) }
        joint turn: Revolute { parent: ground, child: left, axis: Z }
        joint spin: Revolute { parent: ground, child: right, axis: Z }
        part first: theirs { hinge: turn };
        part second: ours { hinge: spin };
    }
    mod doubled {
        body left { mass: 1.0, inertia: diag(1.0, 1.0, 2.0) }
        body right { mass: 1.0, inertia: diag(1.0, 1.0, 2.0) }
        joint turn: Revolute { parent: ground, child: left, axis: Z }
        joint spin: Revolute { parent: ground, child: right, axis: Z }
        part both: brakes_of_two { first: turn, second: spin };
        part more: ours { hinge: spin };
    }
}

fn main() {
    let mut x = wheels::State::<f64>::default();
    (x.v.turn, x.v.spin) = (0.05, 0.3);
    let v = wheels::Model::default().forward_dynamics(0.0, &x, &());
    let theirs = |speed: f64| -0.4 * 2.0 * (20.0 * speed).tanh();
    let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-15, "{a} {b}");
    near(v.turn, theirs(0.05) / 2.0);
    near(v.spin, 0.3);

    let mut x = doubled::State::<f64>::default();
    (x.v.turn, x.v.spin) = (0.05, 0.3);
    let v = doubled::Model::default().forward_dynamics(0.0, &x, &());
    near(v.turn, theirs(0.05) / 2.0);
    near(v.spin, (theirs(0.3) + 2.0 * 0.3) / 2.0);

    near(of_one::Model::default().forward_dynamics(0.0, &of_one::State::default(), &()).v.turn, -0.25);
    near(of_three::Model::default().forward_dynamics(0.0, &of_three::State::default(), &()).v.turn, -1.375);
}
