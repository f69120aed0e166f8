//! Wall clock: generated functions against the textbook recursions and a double pendulum written by hand.
//!
//! `RUSTFLAGS=-Ctarget-cpu=native cargo bench --bench speed`. Items are evaluations: a call with four lanes makes four.
//! Arguments live on the heap: on the stack, lanes sometimes lie 4 KiB from a function's own values and cost it twice.

mod hand;
mod models;
mod recursive;

use divan::counter::ItemsCount;
use divan::{Bencher, black_box};
use models::{Lanes, sample};
use multibody::nalgebra::SVector;
use multibody::simba::simd::{WideF32x8, WideF64x4};
use recursive::Tree;

fn main() {
    agree();
    divan::main();
}

macro_rules! arm {
    ($name:ident) => {
        mod $name {
            use super::*;
            use crate::models::$name as arm;
            use arm::{DATA, DOF, point};

            #[divan::bench(sample_size = 1000, types = [f64, f32, WideF64x4, WideF32x8])]
            fn inverse_dynamics<T: Lanes>(bencher: Bencher<'_, '_>) {
                let p = Box::new(point::<T>());
                bencher.counter(ItemsCount::new(T::LANES)).bench_local(|| arm::inverse_dynamics(black_box(&p)));
            }

            #[divan::bench(sample_size = 1000, types = [f64, f32, WideF64x4, WideF32x8])]
            fn mass_matrix<T: Lanes>(bencher: Bencher<'_, '_>) {
                let p = Box::new(point::<T>());
                bencher.counter(ItemsCount::new(T::LANES)).bench_local(|| arm::mass_matrix(black_box(&p)));
            }

            #[divan::bench(sample_size = 1000, types = [f64, f32, WideF64x4, WideF32x8])]
            fn forward_dynamics<T: Lanes>(bencher: Bencher<'_, '_>) {
                let p = Box::new(point::<T>());
                bencher.counter(ItemsCount::new(T::LANES)).bench_local(|| arm::forward_dynamics(black_box(&p)));
            }

            #[divan::bench(sample_size = 1000)]
            fn inverse_dynamics_recursive(bencher: Bencher<'_, '_>) {
                let (tree, [q, v, a, _]) = textbook();
                bencher
                    .counter(ItemsCount::new(1_usize))
                    .bench_local(|| black_box(&tree).inverse_dynamics(black_box(&q), black_box(&v), black_box(&a)));
            }

            #[divan::bench(sample_size = 1000)]
            fn mass_matrix_recursive(bencher: Bencher<'_, '_>) {
                let (tree, [q, ..]) = textbook();
                bencher.counter(ItemsCount::new(1_usize)).bench_local(|| black_box(&tree).mass_matrix(black_box(&q)));
            }

            #[divan::bench(sample_size = 1000)]
            fn forward_dynamics_recursive(bencher: Bencher<'_, '_>) {
                let (tree, [q, v, _, effort]) = textbook();
                bencher.counter(ItemsCount::new(1_usize)).bench_local(|| {
                    black_box(&tree).forward_dynamics(black_box(&q), black_box(&v), black_box(&effort))
                });
            }

            fn textbook() -> (Tree<DOF>, [SVector<f64, DOF>; 4]) {
                (Tree::read(DATA), [0, 1, 2, 3].map(sample))
            }

            /// The baseline computes the same.
            pub fn agree() {
                let (p, (tree, [q, v, a, effort])) = (point::<f64>(), textbook());
                let near = |name: &str, ours: &[f64], theirs: &[f64]| {
                    let size = theirs.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
                    let error = ours.iter().zip(theirs).fold(0.0_f64, |m, (x, y)| m.max((x - y).abs()));
                    assert!(error <= 1e-10 * size, "{} {name}: {error:e}", stringify!($name));
                };
                let torque = SVector::from(arm::inverse_dynamics(&p));
                near("inverse dynamics", torque.as_slice(), tree.inverse_dynamics(&q, &v, &a).as_slice());
                near("mass matrix", arm::mass_matrix(&p).as_slice(), tree.mass_matrix(&q).as_slice());
                let accel = SVector::from(arm::forward_dynamics(&p));
                near("forward dynamics", accel.as_slice(), tree.forward_dynamics(&q, &v, &effort).as_slice());
            }
        }
    };
}

arm!(double_pendulum);
arm!(cart5);
arm!(puma560);
arm!(panda);

/// [`hand::forward_dynamics`] on the double pendulum.
#[divan::bench(sample_size = 1000)]
fn double_pendulum_forward_dynamics_by_hand(bencher: Bencher<'_, '_>) {
    let [q, v, effort] = [0, 1, 3].map(|kind| sample::<f64, 2>(kind).into());
    bencher
        .counter(ItemsCount::new(1_usize))
        .bench_local(|| hand::forward_dynamics(black_box(&q), black_box(&v), black_box(&effort)));
}

/// All baselines compute what the generated functions do.
fn agree() {
    double_pendulum::agree();
    cart5::agree();
    puma560::agree();
    panda::agree();
    let [q, v, effort] = [0, 1, 3].map(|kind| sample::<f64, 2>(kind).into());
    let hand = SVector::from(hand::forward_dynamics(&q, &v, &effort));
    let generated = SVector::from(models::double_pendulum::forward_dynamics(&models::double_pendulum::point()));
    assert!((hand - generated).amax() <= 1e-12 * generated.amax(), "by hand: {hand}, generated: {generated}");
}
