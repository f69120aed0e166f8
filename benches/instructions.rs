//! Instruction counts of the functions in `speed.rs`, and what must hold: the generated double pendulum needs no more
//! instructions than the one written by hand in `hand.rs`.
//!
//! `cargo xtask instructions` runs it, with valgrind, and compares counts with `instructions.txt`.
//! Sines and cosines count with the rest: the crate's own in generated functions, the platform's in others. Valgrind does not know every instruction of every
//! processor: leave `target-cpu` alone.

mod hand;
mod models;
mod recursive;

use std::hint::black_box;

use gungraun::{library_benchmark, library_benchmark_group, main};
use multibody::nalgebra::{SMatrix, SVector};

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

main!(library_benchmark_groups = against_hand, double_pendulum, cart5, puma560, panda);
