//! A slider-crank, the mechanism of a piston engine: where the piston is, how fast, what torque keeps it going, what the
//! crank's bearing carries, and how it runs up.
//!
//! `cargo run --release --example slider_crank`
//!
//! `emit kinematics` gives the piston's travel with rate and acceleration from the crank's, the closed form of the loop as a
//! function of its own; beside it the formula from a textbook.

use multibody::{IntegrationError, Rk4};

#[path = "models/slider_crank.rs"]
mod model;

use model::engine::{self, Input, Model, Position, State, Velocity};

/// [m]
const CRANK: f64 = 0.04;
const ROD: f64 = 0.14;

fn main() -> Result<(), IntegrationError> {
    let model = Model::<f64>::default();
    motion(&model);
    run_up(&model)?;
    println!("\nThe equations as the compiler has derived them:");
    let mut section = "";
    for equation in engine::FORMULAS {
        if equation.section != section {
            section = equation.section;
            println!("\n  {section}\n");
        }
        println!("    {}", equation.text);
        if !equation.says.is_empty() {
            println!("        {}", equation.says);
        }
    }
    println!("\nOperations of the generated functions:\n");
    for cost in engine::COSTS {
        println!("  {cost}");
    }
    Ok(())
}

fn motion(model: &Model) {
    println!("At 3000 turns a minute, the torque for a constant speed and the bearing's force without it:\n");
    println!("  crank [deg]   travel [m]   rate [m/s]   acceleration [m/s^2]   torque [N m]   bearing [N]");
    let speed = 3000.0 * std::f64::consts::TAU / 60.0;
    let mut error = 0.0_f64;
    for k in 0..=8 {
        let angle = f64::from(k) * std::f64::consts::PI / 8.0;
        let state = State { q: Position { shaft: angle }, v: Velocity { shaft: speed } };
        let piston = model.kinematics(0.0, &state, &Velocity { shaft: 0.0 });
        let bearing = model.outputs(0.0, &state, &Input { gas: 0.0 }).bearing.norm();
        let torque = model.inverse_dynamics(0.0, &state, &Input { gas: 0.0 }, &Velocity { shaft: 0.0 }).shaft;
        println!(
            "  {:>11.1}{:>13.5}{:>13.4}{:>23.2}{torque:>15.3}{bearing:>14.1}",
            angle.to_degrees(),
            piston.position[0],
            rounded(piston.velocity[0]),
            piston.acceleration[0]
        );
        // x = r cos(a) + sqrt(l^2 - r^2 sin(a)^2) and its derivatives at constant speed
        let (sin, cos) = angle.sin_cos();
        let root = (ROD * ROD - (CRANK * sin).powi(2)).sqrt();
        let slope = -CRANK * sin - CRANK * CRANK * sin * cos / root;
        let curvature = -CRANK * cos
            - CRANK * CRANK * ((cos * cos - sin * sin) / root + (CRANK * sin * cos).powi(2) / root.powi(3));
        let textbook = [CRANK * cos + root, slope * speed, curvature * speed * speed];
        let found = [piston.position[0], piston.velocity[0], piston.acceleration[0]];
        error = found.iter().zip(textbook).fold(error, |error, (a, b)| error.max((a - b).abs() / (1.0 + b.abs())));
    }
    println!("\n  from the textbook's formula: {error:.0e}");
}

/// Without the sign of what prints as zero.
fn rounded(value: f64) -> f64 {
    (value * 1e4).round() / 1e4 + 0.0
}

/// Gas pushes while the piston comes down.
fn run_up(model: &Model) -> Result<(), IntegrationError> {
    println!("\nRun up from rest by 2 kN of gas on every way down, in steps of 0.1 ms:\n");
    println!("  t [s]    turns   turns a minute   energy [J]");
    let mut state = State { q: Position { shaft: 0.1 }, v: Velocity { shaft: 0.0 } };
    for k in 0..=5000 {
        let t = f64::from(k) * 1e-4;
        if k % 1000 == 0 {
            let energy = model.outputs(t, &state, &Input { gas: 0.0 }).energy;
            let (turns, speed) = (state.q.shaft / std::f64::consts::TAU, state.v.shaft * 60.0 / std::f64::consts::TAU);
            println!("  {t:>5.1}{turns:>9.2}{speed:>17.1}{energy:>13.3}");
        }
        let gas = if state.q.shaft.sin() > 0.0 { 2000.0 } else { 0.0 };
        state = Rk4::integrate(model, t, &state, &Input { gas }, 1e-4, 1, |_, _| ())?;
    }
    Ok(())
}
