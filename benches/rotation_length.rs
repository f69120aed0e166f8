//! Length of a quaternion over ten million steps of a tumbling body, by the classical Runge-Kutta method, plain and
//! compensated: `cargo bench --bench rotation_length`. Fails where a length is off by more than 4e-16.

#[path = "../tests/support/length.rs"]
mod length;

use length::length_gap;
use multibody::nalgebra::Vector3;
use multibody::{Integrator, Rk4};

multibody::multibody! {
    mod body {
        body nut { mass: 1.0, inertia: diag(1.0, 2.0, 3.0) }
        joint free: Free { parent: ground, child: nut }
    }
}

fn main() {
    let mut start = body::State::default();
    start.v.free.angular = Vector3::new(1.0, 5.0, -3.0);
    let model = body::Model::default();
    for (name, fixed) in
        [("plain", Integrator::fixed(Rk4, 1e-3)), ("compensated", Integrator::fixed(Rk4, 1e-3).compensated())]
    {
        let mut most = 0.0;
        let look = |_: f64, x: &body::State| most = f64::max(most, length_gap(&x.q.free.orientation));
        match fixed.integrate(&model, 0.0, 1e4, &start, &(), look) {
            Ok((_, statistics)) => println!("{name}: {} steps, length within {most:.2e} of one", statistics.accepted),
            Err(error) => println!("{name}: {error}"),
        }
        assert!(most <= 4e-16);
    }
}
