//! Contacts in three guises: a stop that is struck, dry friction, and a bushing; each beside its closed form.
//!
//! `cargo run --release --example impacts`
//!
//! A stop is an event with an impact: the integration is cut where the pendulum meets it, velocities jump by Newton's law,
//! and it goes on. Friction and the bushing are forces of the user's own expressions.

use multibody::impact::impact;
use multibody::integrators::{Action, Direction, Event, Events};
use multibody::{DormandPrince, Integrator, multibody};

multibody! {
    /// A rod that falls against a wall under its pivot.
    pub mod pendulum {
        world { gravity: -9.81 * Y }
        body rod { mass: 2.0, com: -0.5 * Y, inertia: rod(2.0, 1.0, Y) }
        joint hinge: Revolute { parent: ground, child: rod, axis: Z }
        output energy = kinetic() + potential();
        emit forward_dynamics, impulse;
    }
    /// A block on a table; below `SLOW` its friction fades.
    pub mod block {
        /// friction
        const MU = 0.3;
        /// [m/s]
        const SLOW = 0.01;
        /// [kg]
        const MASS = 1.5;
        body block { mass: MASS }
        joint slide: Prismatic { parent: ground, child: block, axis: X }
        force friction: Effort { joint: slide, value: -MU * MASS * 9.81 * tanh(slide.rate / SLOW) }
        emit forward_dynamics;
    }
    /// An engine on its mount: six springs with their dampers, each of its own.
    pub mod mount {
        /// [N/m]
        const K = [4e4, 4e4, 9e4];
        /// [N s/m]
        const C = [200.0, 200.0, 450.0];
        /// [N m/rad]
        const KT = [300.0, 250.0, 120.0];
        /// [N m s/rad]
        const CT = [1.5, 1.0, 0.6];
        body engine { mass: 40.0, inertia: diag(1.2, 1.0, 0.8) }
        joint free: Free { parent: ground, child: engine, coordinates: RollPitchYaw }
        force shift: Force {
            at: engine, axes: ground,
            value: [
                -K[0] * free.x - C[0] * free.x.rate, -K[1] * free.y - C[1] * free.y.rate, -K[2] * free.z - C[2] * free.z.rate,
            ],
        }
        force turn: Torque {
            at: engine, axes: ground,
            value: [
                -KT[0] * free.roll - CT[0] * free.roll.rate, -KT[1] * free.pitch - CT[1] * free.pitch.rate,
                -KT[2] * free.yaw - CT[2] * free.yaw.rate,
            ],
        }
        emit forward_dynamics;
    }
}

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
        let hit = impact(&self.model, event.time, x, &pendulum::Velocity { hinge: 1.0 }, RESTITUTION);
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
