//! Methods for velocities that are rates of coordinates, and for momenta, on models whose velocities are speeds.
use multibody::{Composition4, GeneralisedAlpha, Integrator, SymplecticMidpoint, Verlet, multibody};

multibody! {
    pub mod chosen {
        body sled { mass: 2.0, inertia: sphere(2.0, 0.3) }
        joint plane: Planar { parent: ground, child: sled, axis: Z }
        speed ahead = sled.express(sled.velocity).x;
        speed aside = sled.express(sled.velocity).y;
    }
    pub mod rolling {
        body ball { mass: 1.0, inertia: sphere(1.0, 0.1) }
        joint float: Free { parent: ground, child: ball, coordinates: RollPitchYaw }
        constraint roll: Rolling { wheel: ball, radius: 0.1 }
        formulation { constraints: Reduced }
        emit forward_dynamics, derivatives;
    }
}

fn main() {
    let model = chosen::Model::<f64>::default();
    let state = chosen::State::default();
    let _ = Verlet::step(&model, 0.0, &state, &(), 0.1);
    let _ = SymplecticMidpoint::step(&model, 0.0, &state, &(), 0.1);
    let model = rolling::Model::<f64>::default();
    let state = rolling::State::default();
    let _ = Composition4::integrate(&model, 0.0, &state, &(), 0.1, 10, |_, _| ());
    let method = Integrator::fixed(GeneralisedAlpha::new(0.8), 0.1);
    let _ = method.integrate(&model, 0.0, 1.0, &state, &(), |_, _| ());
}
