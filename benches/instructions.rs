//! Instruction counts of the functions in `speed.rs`, of a Stewart platform and of loops in `loops.rs`, and what must hold: the
//! generated double pendulum needs no more instructions than the one written by hand in `hand.rs`.
//!
//! `cargo xtask instructions` runs it, with valgrind, and compares counts with `instructions.txt`.
//! Sines and cosines count with the rest: the crate's own in generated functions, the platform's in others. Valgrind does not know every instruction of every
//! processor: leave `target-cpu` alone.

mod hand;
#[path = "../tests/models/iterated.rs"]
mod iterated;
mod models;
mod recursive;
#[path = "../tests/models/stewart.rs"]
mod stewart;

use std::hint::black_box;

use gungraun::{library_benchmark, library_benchmark_group, main};
use multibody::nalgebra::{SMatrix, SVector};
use multibody::simba::simd::WideF64x4;

use models::sample;
use recursive::Tree;

/// What lives as long as the program is neither moved nor freed while instructions are counted.
fn leak<T>(value: T) -> &'static T {
    Box::leak(Box::new(value))
}

/// Six counts for each arm: three functions as generated, and by the textbook's recursions.
macro_rules! arm {
    ($name:ident) => {
        pub mod $name {
            use super::*;
            use crate::models::$name as arm;
            use arm::{DATA, DOF, Point};

            type Vector = SVector<f64, DOF>;
            type Textbook = (Tree<DOF>, [Vector; 4]);

            fn point() -> &'static Point<f64> {
                leak(arm::point())
            }

            fn textbook() -> &'static Textbook {
                leak((Tree::read(DATA), [0, 1, 2, 3].map(sample)))
            }

            #[library_benchmark]
            #[bench::generated(point())]
            fn inverse_dynamics(p: &Point<f64>) -> Vector {
                black_box(arm::inverse_dynamics(black_box(p))).into()
            }

            #[library_benchmark]
            #[bench::generated(point())]
            fn mass_matrix(p: &Point<f64>) -> SMatrix<f64, DOF, DOF> {
                black_box(arm::mass_matrix(black_box(p)))
            }

            #[library_benchmark]
            #[bench::generated(point())]
            fn forward_dynamics(p: &Point<f64>) -> Vector {
                black_box(arm::forward_dynamics(black_box(p))).into()
            }

            #[library_benchmark]
            #[bench::recursive(textbook())]
            fn textbook_inverse_dynamics((tree, [q, v, a, _]): &Textbook) -> Vector {
                black_box(black_box(tree).inverse_dynamics(q, v, a))
            }

            #[library_benchmark]
            #[bench::recursive(textbook())]
            fn textbook_mass_matrix((tree, [q, ..]): &Textbook) -> SMatrix<f64, DOF, DOF> {
                black_box(black_box(tree).mass_matrix(q))
            }

            #[library_benchmark]
            #[bench::recursive(textbook())]
            fn textbook_forward_dynamics((tree, [q, v, _, effort]): &Textbook) -> Vector {
                black_box(black_box(tree).forward_dynamics(q, v, effort))
            }

            library_benchmark_group!(
                name = $name;
                benchmarks = inverse_dynamics, mass_matrix, forward_dynamics,
                    textbook_inverse_dynamics, textbook_mass_matrix, textbook_forward_dynamics
            );
        }
    };
}

mod arms {
    use super::*;

    arm!(double_pendulum);
    arm!(cart5);
    arm!(puma560);
    arm!(panda);
}
use arms::{cart5::cart5, double_pendulum::double_pendulum, panda::panda, puma560::puma560};

/// The two double pendulums, one under the other.
mod by_hand {
    use super::*;
    use models::double_pendulum::{self, Point};

    /// Angles, rates, efforts.
    fn plain() -> &'static [[f64; 2]; 3] {
        leak([0, 1, 3].map(|kind| sample::<f64, 2>(kind).into()))
    }

    fn point() -> &'static Point<f64> {
        leak(double_pendulum::point())
    }

    #[library_benchmark]
    #[bench::forward_dynamics(plain())]
    fn written_by_hand([q, v, effort]: &[[f64; 2]; 3]) -> [f64; 2] {
        black_box(hand::forward_dynamics(black_box(q), black_box(v), black_box(effort)))
    }

    #[library_benchmark]
    #[bench::forward_dynamics(point())]
    fn generated(p: &Point<f64>) -> SVector<f64, 2> {
        black_box(double_pendulum::forward_dynamics(black_box(p))).into()
    }

    library_benchmark_group!(name = against_hand; compare_by_id = true; benchmarks = written_by_hand, generated);
}
use by_hand::against_hand;

/// The panda once more: four in a lane, and derivatives.
mod pandas {
    use super::*;
    use models::panda::{self, Point};

    fn point() -> &'static Point<f64> {
        leak(panda::point())
    }

    fn lane() -> &'static Point<WideF64x4> {
        leak(panda::point())
    }

    #[library_benchmark]
    #[bench::generated(lane())]
    fn inverse_dynamics_in_a_lane(p: &Point<WideF64x4>) {
        black_box(panda::inverse_dynamics(black_box(p)));
    }

    #[library_benchmark]
    #[bench::generated(lane())]
    fn mass_matrix_in_a_lane(p: &Point<WideF64x4>) {
        black_box(panda::mass_matrix(black_box(p)));
    }

    #[library_benchmark]
    #[bench::generated(lane())]
    fn forward_dynamics_in_a_lane(p: &Point<WideF64x4>) {
        black_box(panda::forward_dynamics(black_box(p)));
    }

    #[library_benchmark]
    #[bench::generated(point())]
    fn forward_derivatives(p: &Point<f64>) {
        let p = black_box(p);
        black_box(p.driven.forward_derivatives(0.0, &p.driven_state, &p.input));
    }

    library_benchmark_group!(
        name = panda_beside;
        benchmarks = inverse_dynamics_in_a_lane, mass_matrix_in_a_lane, forward_dynamics_in_a_lane, forward_derivatives
    );
}
use pandas::panda_beside;

/// The Stewart platform: forward dynamics, forces in the legs, strokes with their rates and accelerations.
mod platform {
    use super::*;
    use stewart::reduced::{Input, Model, State, Velocity};

    type Subject = (Model<f64>, State<f64>, Input<f64>, Velocity<f64>);

    /// At the start, moving.
    fn subject() -> &'static Subject {
        let mut state = State::default();
        let [v, accel] = [1, 2].map(|kind| Velocity::from(sample::<f64, 6>(kind)));
        state.v = v;
        leak((Model::default(), state, Input::default(), accel))
    }

    #[library_benchmark]
    #[bench::generated(subject())]
    fn forward_dynamics(subject: &Subject) {
        let (model, state, input, _) = black_box(subject);
        black_box(model.forward_dynamics(0.0, state, input));
    }

    #[library_benchmark]
    #[bench::generated(subject())]
    fn leg_forces(subject: &Subject) {
        let (model, state, input, accel) = black_box(subject);
        black_box(model.inverse_dynamics(0.0, state, input, accel));
    }

    #[library_benchmark]
    #[bench::generated(subject())]
    fn strokes(subject: &Subject) {
        let (model, state, _, accel) = black_box(subject);
        black_box(model.kinematics(0.0, state, accel));
    }

    library_benchmark_group!(name = stewart_platform; benchmarks = forward_dynamics, leg_forces, strokes);
}
use platform::stewart_platform;

/// Forward dynamics of loops in the choices of coordinates that `loops.rs` times.
macro_rules! closed {
    ($($name:ident: $file:ident::$model:ident,)*) => {
        mod closed {
            use super::*;

            $(
                #[library_benchmark]
                #[bench::generated(leak(Default::default()))]
                fn $name(subject: &($file::$model::Model<f64>, $file::$model::State<f64>, $file::$model::Input<f64>)) {
                    let (model, state, input) = black_box(subject);
                    black_box(model.forward_dynamics(0.0, state, input));
                }
            )*

            library_benchmark_group!(name = loops; benchmarks = $($name),*);
        }
    };
}

closed! {
    stewart_hybrid: stewart::hybrid,
    stewart_absolute: stewart::absolute,
    delta_closed: iterated::delta_closed,
    delta_newton: iterated::delta_newton,
    delta_multipliers: iterated::delta_multipliers,
    stephenson_newton: iterated::stephenson_newton,
    stephenson_multipliers: iterated::stephenson_multipliers,
}
use closed::loops;

main!(
    library_benchmark_groups = against_hand,
    double_pendulum,
    cart5,
    puma560,
    panda,
    panda_beside,
    stewart_platform,
    loops
);
