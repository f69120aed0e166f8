//! A pole on a cart: swung up from rest and balanced by a force on the cart.
//!
//! The feedback law in a closed loop acts at every stage of a step, as a continuous law does. A computer's law is held from
//! one sample to the next: the same law sampled, at 1 kHz and at 25 Hz.
//!
//! `cargo run --release --example cart_pole`

use std::f64::consts::{PI, TAU};

use multibody::{IntegrationError, Rk4, closed_loop, sampled};

#[path = "models/cart_pole.rs"]
mod model;

use model::cart_pole::{Input, Model, Params, State};

/// The controller, which knows the model: energy shaping until the pole is nearly up, then state feedback.
struct Controller {
    plant: Model,
    /// [1/s^2] gravity over the pole's equivalent length, 2/3 of a rod's
    stiffness: f64,
    /// [m/s^2]
    g: f64,
}

impl Controller {
    /// Where the law stops pumping and balances.
    fn near(x: &State) -> bool {
        x.q.hinge.cos() > 0.93 && x.v.hinge.abs() < 2.5
    }

    /// [N] the force on the cart for a state.
    fn push(&self, t: f64, x: &State) -> f64 {
        let acceleration = if Self::near(x) { self.balance(x) } else { self.pump(x) };
        // M a + bias = (push, 0): the second row gives what the hinge does, the first the push.
        let mass = self.plant.mass_matrix(&x.q);
        let bias = self.plant.bias(t, x, &Input::default());
        let hinge = -(bias.y + mass.m21 * acceleration) / mass.m22;
        mass.m11 * acceleration + mass.m12 * hinge + bias.x
    }

    /// [m/s^2] drives the pole's energy towards that of rest upright, and the cart gently towards the middle.
    fn pump(&self, x: &State) -> f64 {
        let (cos, rate) = (x.q.hinge.cos(), x.v.hinge);
        let energy = 0.5 * rate * rate + self.stiffness * (cos - 1.0); // per moment of inertia
        let pumped = -0.8 * energy * (rate * cos).signum();
        pumped.clamp(-4.0, 4.0) - 1.0 * x.q.track - 1.0 * x.v.track
    }

    /// [m/s^2] state feedback for track'' = a, hinge'' = stiffness * (hinge + a / g): all four poles at -4/s.
    fn balance(&self, x: &State) -> f64 {
        let (p, k) = (4.0_f64, self.stiffness / self.g);
        let on_track = p.powi(4) / self.stiffness;
        let on_speed = 4.0 * p.powi(3) / self.stiffness;
        let on_angle = -(6.0 * p * p + self.stiffness + on_track) / k;
        let on_rate = -(4.0 * p + on_speed) / k;
        on_track * x.q.track + on_speed * x.v.track + on_angle * upright(x) + on_rate * x.v.hinge
    }
}

fn main() -> Result<(), IntegrationError> {
    let params = Params::default();
    let stiffness = 1.5 * params.g / params.length;
    let controller = Controller { plant: Model::new(&params), stiffness, g: params.g };
    let law = |t: f64, x: &State| Input { push: controller.push(t, x) };
    let controlled = closed_loop(&controller.plant, law);
    let mut start = State::default();
    start.q.hinge = PI - 0.05; // rad, almost straight down
    let steps = 10_000;

    println!(" t [s]  phase    angle [rad]  push [N]  energy [J]    track from -1.5 m to 1.5 m");
    let (mut caught, mut next) = (None, 0.0);
    let end = Rk4::integrate(&controlled, 0.0, &start, &(), 1e-3, steps, |t, x| {
        let catch = caught.is_none() && Controller::near(x);
        if catch {
            caught = Some(t);
        }
        if catch || t >= next {
            show(&controller, t, x);
            next = t + if t < 5.0 { 0.25 } else { 1.0 };
        }
    })?;
    println!("\nUp after {:.3} s. Distance from rest upright in the middle after 10 s:", caught.unwrap_or(f64::NAN));

    report("law at every stage", &end);
    for (rate, period) in [("1 kHz", 1e-3), ("25 Hz", 0.04)] {
        let held = sampled(&controller.plant, period, |t, x: &State, (): &mut ()| law(t, x));
        let end = Rk4::integrate(&held, 0.0, &held.start(0.0, &start, ()), &(), 1e-3, steps, |_, _| ())?;
        report(&format!("held, {rate}"), &end.state);
    }
    Ok(())
}

/// [rad] the pole's angle from upright, between -pi and pi.
fn upright(x: &State) -> f64 {
    (x.q.hinge + PI).rem_euclid(TAU) - PI
}

/// One line: numbers, and an arrow on the track, where the cart is and along the pole.
fn show(controller: &Controller, t: f64, x: &State) {
    let phase = if Controller::near(x) { "balance" } else { "pump" };
    let push = controller.push(t, x);
    let energy = controller.plant.outputs(t, x, &Input { push }).energy;
    let turn = (upright(x) / TAU * 8.0).round().rem_euclid(8.0) as usize;
    let arrow = ['↑', '↖', '←', '↙', '↓', '↘', '→', '↗'][turn];
    let left = ((x.q.track + 1.5) * 10.0).clamp(0.0, 30.0) as usize;
    let track = format!("{:left$}{arrow}{:right$}", "", "", right = 30 - left);
    println!("{t:>6.2}  {phase:<7} {:>12.3} {push:>9.3} {energy:>11.3}    |{track}|", upright(x));
}

fn report(law: &str, x: &State) {
    println!("  {law:<20} angle {:>8.1e} rad, cart {:>8.1e} m", upright(x).abs(), x.q.track.abs());
}
