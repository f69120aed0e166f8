//! Energies of long motions, periods, and a hundred seconds of a pendulum. `benches/long_runs.rs` goes on for longer.

use multibody::{
    Composition6, GaussLegendre4, GaussLegendre6, ImplicitMidpoint, Integrator, SymplecticGauss4, SymplecticGauss6,
    SymplecticMidpoint, Verlet,
};
use multibody_tests::models::energy::swing;
use multibody_tests::support::compare::{mixed, worse};
use multibody_tests::support::data::{list, number, read};
use multibody_tests::support::energy::Drift;
use multibody_tests::support::long_runs::{DOUBLE_STARTS, double_pendulum, pendulum};

/// Within `bound`, and a line fitted to it rises by less than `rise`, which is its own error or near it.
fn bounded(name: &str, drift: Drift, bound: f64, rise: f64) {
    println!("{name}: {drift}, flat {}", drift.is_flat());
    assert!(drift.worst <= bound, "{name}: {} > {bound}", drift.worst);
    assert!(drift.rise.abs() <= rise, "{name}: rises by {}", drift.rise);
}

#[test]
fn pendulum_by_verlet() {
    let run = pendulum::<f64, _>(Integrator::fixed(Verlet, 1e-2), 1e-2, 2_000_000);
    bounded("pendulum, Verlet, 2e6 steps of 1e-2", run, 2.5e-4, 1e-8);
    assert!(run.is_flat());
}

#[test]
fn pendulum_by_compensated_composition() {
    let run = pendulum::<f64, _>(Integrator::fixed(Composition6, 5e-3).compensated(), 5e-3, 400_000);
    bounded("pendulum, Composition6 compensated, 4e5 steps of 5e-3", run, 2e-13, 2e-14);
    let plain = pendulum::<f64, _>(Integrator::fixed(Composition6, 5e-3), 5e-3, 400_000);
    println!("the same without compensation: {plain}");
}

#[test]
fn pendulum_in_single_precision() {
    let plain = pendulum::<f32, _>(Integrator::fixed(Verlet, 1e-2), 1e-2, 1_000_000);
    bounded("pendulum, Verlet in f32, 1e6 steps of 1e-2", plain, 5e-4, 5e-5);
    let run = pendulum::<f32, _>(Integrator::fixed(Verlet, 1e-2).compensated(), 1e-2, 1_000_000);
    bounded("the same compensated", run, 5e-4, 2e-5);
    assert!(plain.worst > run.worst, "compensation does something");
}

#[test]
fn double_pendulum_by_midpoint() {
    for (name, start) in DOUBLE_STARTS {
        let steps = 50_000;
        let run = double_pendulum(SymplecticMidpoint, start, steps);
        bounded(&format!("{name}, midpoint in momenta"), run, 4e-3, 5e-5);
        assert!(run.is_flat());
        println!("{name}, midpoint in velocities: {}", double_pendulum(ImplicitMidpoint, start, steps));
    }
}

#[test]
fn double_pendulum_by_gauss_methods() {
    let (name, start) = DOUBLE_STARTS[1];
    let steps = 20_000;
    bounded(&format!("{name}, Gauss 4 in momenta"), double_pendulum(SymplecticGauss4, start, steps), 4e-8, 1e-10);
    bounded(&format!("{name}, Gauss 6 in momenta"), double_pendulum(SymplecticGauss6, start, steps), 4e-11, 1e-12);
    bounded(&format!("{name}, Gauss 4 in velocities"), double_pendulum(GaussLegendre4, start, steps), 4e-8, 1e-10);
    bounded(&format!("{name}, Gauss 6 in velocities"), double_pendulum(GaussLegendre6, start, steps), 4e-11, 1e-12);
}

#[test]
fn a_hundred_seconds() {
    let file = read("motion/a1_pendulum");
    let model = swing::Model::new(&swing::Params::default());
    let points = list(&file["points"]);
    let mut start = swing::State::default();
    start.q.hinge = number(&points[0]["theta_from_down"]);
    for (name, dt, bound) in [("5e-3", 5e-3, 1e-12), ("2e-2", 2e-2, 1e-8)] {
        let integrator = Integrator::fixed(Composition6, dt).compensated();
        let (mut most, mut next) = (0.0, 1);
        let run = integrator.intervals(&model, 0.0, 100.0, &start, &(), |interval| {
            while let Some(point) = points.get(next).filter(|point| number(&point["t"]) <= interval.end()) {
                let x = interval.at(number(&point["t"]));
                let truth = [number(&point["theta_from_down"]), number(&point["omega"])];
                most = worse(most, mixed(&[x.q.hinge, x.v.hinge], &truth));
                next += 1;
            }
        });
        let evaluations = run.unwrap().1.evaluations;
        println!("pendulum from the horizontal, 100 s by steps of {name}: {most:.1e}, {evaluations} evaluations");
        assert_eq!(next, points.len());
        assert!(most <= bound, "{most:e}");
    }
}

/// A quarter of the period ends where the pendulum first hangs straight down.
#[test]
fn periods() {
    let file = read("motion/a1_pendulum");
    let model = swing::Model::new(&swing::Params::default());
    for row in list(&file["period_table"]) {
        let right_angle = row["theta0"] == "pi/2";
        let amplitude = if right_angle { std::f64::consts::FRAC_PI_2 } else { number(&row["theta0"]) };
        let period = number(&row["T_L1_g981"]);
        let mut start = swing::State::default();
        start.q.hinge = amplitude;
        let mut quarter = f64::NAN;
        let integrator = Integrator::fixed(Composition6, 2e-3).compensated();
        let run = integrator.intervals(&model, 0.0, 0.3 * period, &start, &(), |interval| {
            if interval.first().q.hinge > 0.0 && interval.last().q.hinge <= 0.0 {
                let (mut low, mut high) = (interval.start(), interval.end());
                for _ in 0..60 {
                    let middle = 0.5 * (low + high);
                    if interval.at(middle).q.hinge > 0.0 { low = middle } else { high = middle }
                }
                quarter = 0.5 * (low + high);
            }
        });
        run.unwrap();
        let error = 4.0 * quarter / period - 1.0;
        println!("amplitude {amplitude}: period {:.15} s, relative error {error:.1e}", 4.0 * quarter);
        // Beyond that the pendulum nearly stands still on its head, and the period feels the amplitude's own rounding.
        let bound = if amplitude <= 3.1 { 1e-12 } else { 1e-9 };
        assert!(error.abs() <= bound, "{amplitude}: {error:e}");
    }
}
