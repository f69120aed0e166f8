//! Andrews' squeezing mechanism, a test for solvers of constrained equations: seven bodies in three loops that spin up to
//! two hundred turns a second within a twentieth of a second.
//!
//! `cargo run --release --example andrews`
//!
//! The loops are closed by ordinary revolute joints. In space each gives five equations; three of them hold by themselves
//! because all is planar, and are dropped. What stays keeps multipliers, and a projection after each step keeps the loops
//! closed. Data and end values: the test set for initial value problem solvers, end values computed anew to 25 digits.

use multibody::nalgebra::SVector;
use multibody::{Constrained, DormandPrince, Projection};

#[path = "models/andrews.rs"]
mod model;

use model::andrews::{CONSTRAINTS, COORDINATES, COSTS, DOF, EQUATIONS, JACOBIAN, Model, Position, State, Velocity};

/// [rad] at the start, at rest: beta, theta, gamma, delta, phi, epsilon, omega
const START: [f64; 7] = [
    -0.06171389001427645,
    0.0,
    0.45527981916307038,
    0.4873649795438425,
    0.22266839016588588,
    1.2305474445498212,
    -0.22266839016588588,
];
/// [rad] and [rad/s] after 0.05 s, to 25 digits and rounded
const END: [[f64; 7]; 2] = [
    [
        33.82586776695452,
        -33.583431517463868,
        0.11339507381259901,
        0.5260604449169958,
        -0.4078528656018045,
        1.056902429434963,
        0.4078528656018045,
    ],
    [
        1144.5355026538475,
        -1336.0337226511925,
        -190.9370686042946,
        0.8758650829630151,
        -334.3170608708646,
        -39.617288978352995,
        334.3170608708646,
    ],
];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    println!("{DOF} coordinates, {CONSTRAINTS} constraint equations; their Jacobian:\n");
    println!("  {:<12}{}", "", COORDINATES.join(" "));
    for (equation, row) in EQUATIONS.iter().zip(JACOBIAN) {
        let entries: String =
            row.chars().zip(COORDINATES).map(|(entry, name)| format!("{entry:^width$} ", width = name.len())).collect();
        println!("  {equation:<12}{}", entries.trim_end());
    }

    let model = Model::<f64>::default();
    let start = State { q: Position::from(SVector::from(START)), v: Velocity::default() };
    let first = model.forward_dynamics(0.0, &start, &());
    println!(
        "\nAt the start the motor's crank has {:.4} rad/s^2, the rank of the loops is {}.",
        first.v.beta, first.rank
    );

    println!("\n0.05 s by Dormand and Prince's method, errors against 25 digits:\n");
    println!("  steps   projected     angles [rad]   rates [rad/s]   loops open [m]   energy [J]");
    let energy = |state: &State| model.outputs(0.0, state, &()).energy;
    for (steps, projected) in [(1000_u32, false), (1000, true), (4000, false), (4000, true)] {
        let h = 0.05 / f64::from(steps);
        let projection = Projection { tolerance: 1e-15, ..Projection::default() };
        let mut state = start;
        for k in 0..steps {
            let t = h * f64::from(k);
            state = DormandPrince::step(&model, t, &state, &(), h);
            if projected {
                state = projection.project(&model, t + h, &state)?.state;
            }
        }
        let [q, v] = END.map(SVector::from);
        println!(
            "  {steps:>5}   {:<9}{:>17.0e}{:>16.0e}{:>17.0e}{:>13.0e}",
            if projected { "yes" } else { "no" },
            (SVector::from(state.q) - q).amax(),
            (SVector::from(state.v) - v).amax(),
            Constrained::constraints(&model, 0.05, &state.q).amax(),
            energy(&state) - energy(&start),
        );
    }
    println!("\nOperations of the generated functions:\n");
    for cost in COSTS.iter().filter(|cost| cost.function != "new") {
        println!("  {cost}");
    }
    Ok(())
}
