//! Chains of rods, from five to a hundred: they derive, compile and conserve energy, and the cost of a rod stays what it is.

use multibody::{Dop853, Integrator};
use multibody_tests::models::hundred_rods::hundred_rods::{COSTS, DOF, Model, State};
use multibody_tests::support::compare::worse;
use multibody_tests::support::engine::model_of;
use multibody_tests::support::ledger::{count, flops};
use std::fmt::Write as _;
use std::time::Instant;

/// The same chain with another number of rods.
fn chain(rods: usize) -> String {
    let mut text = String::from("mod chain { world { gravity: -9.81 * Y }");
    for k in 1..=rods {
        let parent = if k == 1 { "ground".to_owned() } else { format!("rod{}.at(-Y)", k - 1) };
        write!(text, "body rod{k} {{ mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }}").unwrap();
        write!(text, "joint hinge{k}: Revolute {{ parent: {parent}, child: rod{k}, axis: Z }}").unwrap();
    }
    text + "}"
}

#[test]
fn the_cost_of_a_rod_stays() {
    let mut last: Option<(usize, f64)> = None;
    for rods in [5, 10, 20, 50] {
        let start = Instant::now();
        let rows = count(&model_of(&chain(rods)), false);
        let row = &rows[0];
        let each = f64::from(flops(&row.after)) / rods as f64;
        println!(
            "{rods:4} rods: {:6} operations, {each:5.1} each, {}, {:.1?}",
            flops(&row.after),
            row.method,
            start.elapsed()
        );
        assert!(row.after.sincos <= rods as u32);
        if let Some((fewer, before)) = last {
            assert!(each <= 1.25 * before || rods <= 10, "{each} with {rods} rods, {before} with {fewer}");
        }
        last = Some((rods, each));
    }
    let hundred = COSTS.iter().find(|cost| cost.function == "forward_dynamics").unwrap();
    let each = f64::from(hundred.flops()) / 100.0;
    println!(" 100 rods: {:6} operations, {each:5.1} each", hundred.flops());
    assert!(last.is_some_and(|(_, before)| each <= 1.1 * before));
}

#[test]
fn a_hundred_rods_conserve_energy() {
    assert_eq!(DOF, 100);
    let model = Model::default();
    let mut start = State::default();
    start.q.hinge1 = 1.0;
    let energy = |x: &State| model.kinetic_energy(x) + model.potential_energy(&x.q);
    let first = energy(&start);
    // Above the chain that hangs.
    let scale = first - energy(&State::default());
    let mut most = 0.0;
    let (end, statistics) = Integrator::adaptive(Dop853, 1e-11, 1e-11)
        .integrate(&model, 0.0, 1.0, &start, &(), |_, x| most = worse(most, ((energy(x) - first) / scale).abs()))
        .unwrap();
    println!("100 rods: energy {most:.1e} over 1 s, {} evaluations", statistics.evaluations);
    assert!(most <= 1e-9);
    assert!((end.q.hinge1 - 1.0).abs() > 0.1 && end.v.hinge100.is_finite());
}
