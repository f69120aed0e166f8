//! Contacts in three guises: a stop that is struck, dry friction, and a bushing; each beside its closed form.
//!
//! `cargo run --release --example impacts`
//!
//! A stop is an event with an impact: the integration is cut where the pendulum meets it, velocities jump by Newton's law,
//! and it goes on. Friction and the bushing are forces of the user's own expressions.

use multibody::impact::impact;
use multibody::integrators::{Action, Direction, Event, Events};
use multibody::{DormandPrince, Integrator};

#[path = "models/impacts.rs"]
mod model;

use model::{block, mount, pendulum};

/// [-] coefficient of restitution
const RESTITUTION: f64 = 0.7;

/// The stop that the rod meets where it hangs.
struct Stop {
    model: pendulum::Model,
    /// [s], [rad/s], [N m s] of every impact
    hits: Vec<[f64; 3]>,
}

impl Events<pendulum::Model, 1> for Stop {
    fn values(&self, _t: f64, x: &pendulum::State) -> [f64; 1] {
        [x.q.hinge]
    }

    fn direction(&self, _index: usize) -> Direction {
        Direction::Falling
    }

    fn happened(&mut self, event: &Event, x: &pendulum::State) -> Action<pendulum::State> {
        // The stop pushes towards greater angles.
        let Ok(hit) = impact(&self.model, event.time, x, &pendulum::Velocity { hinge: 1.0 }, RESTITUTION) else {
            return Action::Stop;
        };
        self.hits.push([event.time, hit.after, hit.impulse]);
        if self.hits.len() == 6 { Action::Stop } else { Action::Jump(hit.state) }
    }
}

/// Displacement of an oscillator that is let go from one: `m x'' + c x' + k x = 0`.
fn damped([m, c, k]: [f64; 3], t: f64) -> f64 {
    let (decay, square) = (0.5 * c / m, k / m);
    let frequency = (square - decay * decay).sqrt();
    (-decay * t).exp() * ((frequency * t).cos() + decay / frequency * (frequency * t).sin())
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let precise = Integrator::adaptive(DormandPrince, 1e-11, 1e-11);

    println!("A rod falls against a stop from 1 rad, restitution {RESTITUTION}:");
    let model = pendulum::Model::default();
    let mut start = pendulum::State::default();
    start.q.hinge = 1.0;
    let mut stop = Stop { model, hits: Vec::new() };
    precise.with_events(&model, 0.0, 20.0, &start, &(), &mut stop, |_| ())?;
    // All of the height is speed at the stop, and each impact leaves its share of the speed.
    let inertia = 2.0 / 3.0;
    let first = (2.0 * 2.0 * 9.81 * 0.5 * (1.0 - 1.0_f64.cos()) / inertia).sqrt();
    for (k, [time, rate, impulse]) in (1..).zip(&stop.hits) {
        let want = first * RESTITUTION.powi(k);
        println!("  t = {time:.6} s: {rate:.9} rad/s, exactly {want:.9}; impulse {impulse:.4} N m s");
        assert!((rate - want).abs() < 1e-8 && (impulse - inertia * (1.0 + 1.0 / RESTITUTION) * want).abs() < 1e-7);
    }
    assert_eq!(stop.hits.len(), 6);

    println!("A block slides to rest from 2 m/s, friction 0.3 with tanh(v / 0.01 m/s):");
    let model = block::Model::default();
    let mut state = block::State::default();
    state.v.slide = 2.0;
    let (deceleration, slow) = (0.3 * 9.81, 0.01);
    for t in [0.2, 0.6, 0.68, 0.7] {
        let (x, _) = precise.integrate(&model, 0.0, t, &state, &(), |_, _| ())?;
        // sinh(v/s) falls like exp(-a t / s); with v >> s before it sinh is half an exponential.
        let exponent = 2.0 / slow - deceleration * t / slow;
        let want = if exponent > 30.0 { slow * exponent } else { slow * (0.5 * exponent.exp()).asinh() };
        println!(
            "  t = {t} s: {:.9} m/s, exactly {want:.9}; with Coulomb's jump {:.9}",
            x.v.slide,
            (2.0 - deceleration * t).max(0.0)
        );
        assert!((x.v.slide - want).abs() < 1e-8);
    }

    println!("An engine on a bushing, let go from 1 mm and 2 mrad:");
    let model = mount::Model::default();
    let mut state = mount::State::default();
    state.q.free.position.z = 1e-3;
    state.q.free.orientation.yaw = 2e-3;
    for t in [0.05, 0.2, 0.5] {
        let (x, _) = precise.integrate(&model, 0.0, t, &state, &(), |_, _| ())?;
        let (rise, yaw) = (x.q.free.position.z, x.q.free.orientation.yaw);
        let want = [1e-3 * damped([40.0, 450.0, 9e4], t), 2e-3 * damped([0.8, 0.6, 120.0], t)];
        println!("  t = {t} s: {rise:.9} m, exactly {:.9}; {yaw:.9} rad, exactly {:.9}", want[0], want[1]);
        assert!((rise - want[0]).abs() < 1e-11 && (yaw - want[1]).abs() < 1e-11);
    }
    Ok(())
}
