//! A four-bar linkage: its crank driven at constant speed, the torque that this takes, and the linkage let go.
//!
//! `cargo run --release --example four_bar`
//!
//! The loop is solved in closed form, so the crank's angle is all the state there is. A four-bar can be closed in two ways,
//! elbow up and elbow down; the condition of `solve` says which. One line makes the crank driven: then nothing is left in
//! the state, and the motor's torque is what inverse dynamics finds.

use multibody::{IntegrationError, Rk4};

#[path = "models/four_bar.rs"]
mod model;

use model::{driven, free};

/// [rad/s]
const SPEED: f64 = std::f64::consts::TAU;

fn main() -> Result<(), IntegrationError> {
    torque();
    let_go()?;
    println!("\nThe closed form of the loop, as the compiler has found it:\n");
    for equation in free::FORMULAS.iter().filter(|equation| equation.section == "Coordinates that follow") {
        println!("  {}", equation.text);
        if !equation.says.is_empty() {
            println!("      {}", equation.says);
        }
    }
    println!("\nOperations of the generated functions:\n");
    for cost in free::COSTS.iter().chain(driven::COSTS).filter(|cost| cost.function != "new") {
        println!("  {cost}");
    }
    Ok(())
}

/// The state of the free linkage that turns like the driven one.
fn turning(t: f64) -> free::State {
    free::State { q: free::Position { drive_shaft: SPEED * t }, v: free::Velocity { drive_shaft: SPEED } }
}

fn torque() {
    println!("Torque that turns the crank at {SPEED:.3} rad/s, over one turn [N m]:\n");
    let linkage = free::Model::<f64>::default();
    let with_drive = |t: f64| {
        let model = driven::Model::<f64>::default();
        model.inverse_dynamics(t, &driven::State::default(), &driven::Input::default(), &driven::Velocity::default())
    };
    let energy = |t: f64| linkage.outputs(t, &turning(t), &free::Input::default()).energy;
    let curve: Vec<f64> = (0..=72).map(|k| with_drive(f64::from(k) / 72.0).input.torque).collect();
    plot(&curve);
    // The motor's power is what the energy changes by, here by a quotient of differences.
    let mut balance = 0.0_f64;
    let mut difference = 0.0_f64;
    for k in 0..72 {
        let t = f64::from(k) / 72.0;
        let torque = with_drive(t).input.torque;
        let by_energy = (energy(t + 1e-5) - energy(t - 1e-5)) / 2e-5;
        balance = balance.max((torque * SPEED - by_energy).abs());
        let at_constant_speed = free::Velocity::default();
        let other = linkage.inverse_dynamics(t, &turning(t), &free::Input::default(), &at_constant_speed);
        difference = difference.max((other.input.torque - torque).abs());
    }
    println!("\n  power less change of energy: {balance:.0e} W; with the crank in the state: {difference:.0e} N m off");
}

/// Values over a turn as characters.
fn plot(curve: &[f64]) {
    const ROWS: usize = 17;
    let (low, high) = (curve.iter().copied().fold(0.0, f64::min), curve.iter().copied().fold(0.0, f64::max));
    let row = |value: f64| ((high - value) / (high - low) * (ROWS - 1) as f64).round() as usize;
    for line in 0..ROWS {
        let label = if line == 0 {
            format!("{high:.0}")
        } else if line == ROWS - 1 {
            format!("{low:.0}")
        } else if line == row(0.0) {
            "0".to_owned()
        } else {
            String::new()
        };
        let points: String = curve
            .iter()
            .map(|value| match line {
                _ if row(*value) == line => 'o',
                _ if row(0.0) == line => '-',
                _ => ' ',
            })
            .collect();
        println!("  {label:>5} |{points}");
    }
    println!("  {:>5}  0{:>35}{:>36}  angle of the crank [degrees]", "", "180", "360");
}

fn let_go() -> Result<(), IntegrationError> {
    println!("\nLet go, with the crank at 45 degrees, at rest; Runge-Kutta at 1 ms:\n");
    println!("  t [s]    crank    rocker [rad]     energy [J]");
    let linkage = free::Model::<f64>::default();
    let input = free::Input::default();
    let mut state = free::State::default();
    state.q.drive_shaft = std::f64::consts::FRAC_PI_4;
    for k in 0..=5 {
        let out = linkage.outputs(0.0, &state, &input);
        println!("  {:>4}{:>10.4}{:>12.4}{:>19.9}", k, state.q.drive_shaft, out.rocker_angle, out.energy);
        state = Rk4::integrate(&linkage, f64::from(k), &state, &input, 1e-3, 1000, |_, _| ())?;
    }
    Ok(())
}
