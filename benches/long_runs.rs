//! Energies of motions that are too long for tests: every figure that the documentation quotes; and the time that Andrews'
//! squeezer takes at an energy error of 1e-8 J.
//!
//! `cargo bench -p multibody-benches --bench long_runs`; some minutes. Bounds are asserted, that of the time too, so a run
//! that ends has kept them; so is that a line fitted to an energy that has no slope rises by no more than four of its own
//! errors. `docs/long_runs.md` holds what one run printed.

// Files of the tests' package, under the paths that they have there.
#[path = "../tests/models"]
mod models {
    pub mod energy;
    pub mod linkages;
}
#[path = "../tests/support"]
mod support {
    pub mod energy;
    pub mod long_runs;
}

use models::linkages::squeezer_reduced;
use multibody::{
    Composition4, Composition6, Dop853, GaussLegendre4, GaussLegendre6, ImplicitMidpoint, Integrator, SymplecticGauss4,
    SymplecticGauss6, SymplecticMidpoint, Verlet,
};
use std::hint::black_box;
use std::time::Instant;
use support::energy::Drift;
use support::long_runs::{DOUBLE_STARTS, double_pendulum, pendulum};

/// Prints a run with its time for a step; it misses what it should do if it leaves its bound, or if the fitted line rises by
/// more than `rise` and four of its errors.
fn show(misses: &mut Vec<String>, name: &str, steps: u32, bound: f64, rise: f64, run: impl FnOnce() -> Drift) {
    let start = Instant::now();
    let drift = run();
    let each = start.elapsed().as_secs_f64() / f64::from(steps) * 1e9;
    println!("{name}, {steps} steps: {drift}, {each:.0} ns a step");
    if drift.worst > bound {
        misses.push(format!("{name}: more than {bound:e}"));
    }
    if !drift.is_flat() && drift.rise.abs() > rise {
        misses.push(format!("{name}: a slope of {:e} with an error of {:e}", drift.rise, drift.error));
    }
}

/// Time of the motion to 0.05 s at the loosest tolerance that keeps the energy within 1e-8 J.
fn squeezer() {
    let model = squeezer_reduced::Model::<f64>::default();
    let mut start = squeezer_reduced::State::default();
    start.q.beta = -0.06171389001427645;
    let energy = |x: &squeezer_reduced::State| model.outputs(0.0, x, &()).energy;
    let first = energy(&start);
    for tolerance in [1e-6, 1e-7, 1e-8, 1e-9] {
        let integrator = Integrator::adaptive(Dop853, tolerance, tolerance);
        let mut drift = 0.0_f64;
        let look = |_: f64, x: &squeezer_reduced::State| drift = drift.max((energy(x) - first).abs());
        let (_, statistics) = integrator.integrate(&model, 0.0, 0.05, &start, &(), look).unwrap();
        let mut best = f64::INFINITY;
        for _ in 0..200 {
            let clock = Instant::now();
            let end = integrator.integrate(black_box(&model), 0.0, 0.05, &start, &(), |_, _| ());
            best = best.min(clock.elapsed().as_secs_f64());
            assert!(black_box(end).is_ok());
        }
        let evaluations = statistics.evaluations;
        println!("tolerance {tolerance:e}: {drift:.1e} J, {:.3} ms, {evaluations} evaluations", 1e3 * best);
        if drift <= 1e-8 {
            println!("at 1e-8 J: {:.3} ms of at most 3 ms", 1e3 * best);
            assert!(best <= 3e-3, "more than 3 ms");
            return;
        }
    }
    panic!("no tolerance keeps the energy of the squeezer within 1e-8 J");
}

fn main() {
    println!("Andrews' squeezer to 0.05 s by the method of order eight");
    squeezer();
    println!("pendulum, g = 9.81 m/s^2, l = 1 m, from 1 rad; energy above rest, relative to the start");
    let (long, many, free, none) = (100_000_000, 10_000_000, f64::INFINITY, 0.0);
    let misses = &mut Vec::new();
    // No slope but that of rounding, which is not quite even: 1e8 steps leave some 1e-12 of it, compensation a quarter.
    show(misses, "Verlet, 1e-2, plain", long, 2.5e-4, 4e-12, || {
        pendulum::<f64, _>(Integrator::fixed(Verlet, 1e-2), 1e-2, long)
    });
    show(misses, "Verlet, 1e-2, compensated", long, 2.5e-4, 1e-12, || {
        pendulum::<f64, _>(Integrator::fixed(Verlet, 1e-2).compensated(), 1e-2, long)
    });
    show(misses, "Composition4, 1e-2", many, 2e-11, free, || {
        pendulum::<f64, _>(Integrator::fixed(Composition4, 1e-2).compensated(), 1e-2, many)
    });
    show(misses, "Composition6, 5e-3, compensated", many, 2e-13, free, || {
        pendulum::<f64, _>(Integrator::fixed(Composition6, 5e-3).compensated(), 5e-3, many)
    });
    show(misses, "Composition6, 5e-3, plain", many, free, free, || {
        pendulum::<f64, _>(Integrator::fixed(Composition6, 5e-3), 5e-3, many)
    });
    let million = 1_000_000;
    show(misses, "Verlet, 1e-2, f32, plain", million, 5e-4, free, || {
        pendulum::<f32, _>(Integrator::fixed(Verlet, 1e-2), 1e-2, million)
    });
    show(misses, "Verlet, 1e-2, f32, compensated", million, 5e-4, free, || {
        pendulum::<f32, _>(Integrator::fixed(Verlet, 1e-2).compensated(), 1e-2, million)
    });

    println!("double pendulum, two masses of 1 kg on rods of 1 m, from rest, steps of 1e-2");
    let steps = 2_000_000;
    for (name, start) in DOUBLE_STARTS {
        show(misses, &format!("{name}: midpoint in momenta"), steps, 5e-3, none, || {
            double_pendulum(SymplecticMidpoint, start, steps)
        });
        show(misses, &format!("{name}: midpoint in velocities"), steps, free, free, || {
            double_pendulum(ImplicitMidpoint, start, steps)
        });
        show(misses, &format!("{name}: Gauss 4 in momenta"), steps, 5e-6, free, || {
            double_pendulum(SymplecticGauss4, start, steps)
        });
        show(misses, &format!("{name}: Gauss 4 in velocities"), steps, free, free, || {
            double_pendulum(GaussLegendre4, start, steps)
        });
        show(misses, &format!("{name}: Gauss 6 in momenta"), steps, free, free, || {
            double_pendulum(SymplecticGauss6, start, steps)
        });
        show(misses, &format!("{name}: Gauss 6 in velocities"), steps, free, free, || {
            double_pendulum(GaussLegendre6, start, steps)
        });
    }
    assert!(misses.is_empty(), "{misses:#?}");
}
