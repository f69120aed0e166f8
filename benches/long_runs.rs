//! Energies of motions that are too long for tests: every figure that the documentation quotes.
//!
//! `cargo bench --bench long_runs`; some minutes. Bounds are asserted, so a run that ends has kept them.

// Files of the tests' package, under the paths that they have there.
#[path = "../tests/models"]
mod models {
    pub mod energy;
}
#[path = "../tests/support"]
mod support {
    pub mod energy;
    pub mod long_runs;
}

use multibody::{
    Composition4, Composition6, GaussLegendre4, GaussLegendre6, ImplicitMidpoint, Integrator, SymplecticGauss4,
    SymplecticGauss6, SymplecticMidpoint, Verlet,
};
use std::time::Instant;
use support::energy::Drift;
use support::long_runs::{DOUBLE_STARTS, double_pendulum, pendulum};

/// Prints a run with its time for a step, and demands its bounds.
fn show(name: &str, steps: u32, bound: f64, rise: f64, run: impl FnOnce() -> Drift) {
    let start = Instant::now();
    let drift = run();
    let each = start.elapsed().as_secs_f64() / f64::from(steps) * 1e9;
    println!("{name}, {steps} steps: {drift}, {each:.0} ns a step");
    assert!(drift.worst <= bound && drift.rise.abs() <= rise, "{name}: more than {bound:e} and {rise:e}");
}

fn main() {
    println!("pendulum, g = 9.81 m/s^2, l = 1 m, from 1 rad; energy above rest, relative to the start");
    let (long, many, free) = (100_000_000, 10_000_000, f64::INFINITY);
    show("Verlet, 1e-2", long, 2.5e-4, 1e-9, || pendulum::<f64, _>(Integrator::fixed(Verlet, 1e-2), 1e-2, long));
    show("Composition4, 1e-2", many, 2e-11, free, || {
        pendulum::<f64, _>(Integrator::fixed(Composition4, 1e-2).compensated(), 1e-2, many)
    });
    show("Composition6, 5e-3, compensated", many, 2e-13, free, || {
        pendulum::<f64, _>(Integrator::fixed(Composition6, 5e-3).compensated(), 5e-3, many)
    });
    show("Composition6, 5e-3, plain", many, free, free, || {
        pendulum::<f64, _>(Integrator::fixed(Composition6, 5e-3), 5e-3, many)
    });
    let million = 1_000_000;
    show("Verlet, 1e-2, f32, plain", million, free, free, || {
        pendulum::<f32, _>(Integrator::fixed(Verlet, 1e-2), 1e-2, million)
    });
    show("Verlet, 1e-2, f32, compensated", million, 5e-4, free, || {
        pendulum::<f32, _>(Integrator::fixed(Verlet, 1e-2).compensated(), 1e-2, million)
    });

    println!("double pendulum, two masses of 1 kg on rods of 1 m, from rest, steps of 1e-2");
    let steps = 2_000_000;
    for (name, start) in DOUBLE_STARTS {
        show(&format!("{name}: midpoint in momenta"), steps, 5e-3, 2e-5, || {
            double_pendulum(SymplecticMidpoint, start, steps)
        });
        show(&format!("{name}: midpoint in velocities"), steps, free, free, || {
            double_pendulum(ImplicitMidpoint, start, steps)
        });
        show(&format!("{name}: Gauss 4 in momenta"), steps, 5e-6, free, || {
            double_pendulum(SymplecticGauss4, start, steps)
        });
        show(&format!("{name}: Gauss 4 in velocities"), steps, free, free, || {
            double_pendulum(GaussLegendre4, start, steps)
        });
        show(&format!("{name}: Gauss 6 in momenta"), steps, free, free, || {
            double_pendulum(SymplecticGauss6, start, steps)
        });
        show(&format!("{name}: Gauss 6 in velocities"), steps, free, free, || {
            double_pendulum(GaussLegendre6, start, steps)
        });
    }
}
