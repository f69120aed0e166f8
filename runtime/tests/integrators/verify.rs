//! `verify` says how well the functions of a model agree, and tells where one of them lies.

use multibody::nalgebra::{SMatrix, SVector};
use multibody::{ExtraOf, System, VelocityOf, Verifiable, multibody, verify, verify_at};

multibody! {
    /// A four-bar whose last pin keeps its multipliers; the crank's base is shaken.
    pub mod pinned {
        world { gravity: -9.81 * Y }
        formulation { constraints: Multipliers }
        input torque;
        body base { mass: 0.3 }
        body crank { mass: 0.4, com: 0.2 * X, inertia: diag(0.01, 0.02, 0.025) }
        body coupler { mass: 0.6, com: 0.4 * X, inertia: diag(0.02, 0.03, 0.04) }
        body follower { mass: 0.5, com: 0.3 * X, inertia: diag(0.01, 0.02, 0.025) }
        joint shaker: Prismatic { parent: ground, child: base, axis: Y }
        joint a: Revolute { parent: base, child: crank, axis: Z }
        joint b: Revolute { parent: crank.at(0.4 * X), child: coupler, axis: Z }
        joint c: Revolute { parent: ground.at(0.9 * X), child: follower, axis: Z }
        #[cut]
        joint d: Revolute { parent: coupler.at(0.8 * X), child: follower.at(0.6 * X), axis: Z }
        drive shaker.travel = 0.01 * sin(7.0 * t);
        force motor: Effort { joint: a, value: torque }
        emit forward_dynamics, inverse_dynamics, mass_matrix, energy;
    }
}

multibody! {
    /// A floating body with quaternions, an oblique arm, and a filter of its own.
    pub mod craft {
        param arm_mass = 0.7;
        input thrust;
        world { gravity: -9.81 * Z }
        body hull { mass: 2.0, com: [0.01, 0.02, -0.03], inertia: diag(0.02, 0.03, 0.04) }
        body arm { mass: arm_mass, com: [0.2, 0.1, 0.0], inertia: diag(0.01, 0.02, 0.02) }
        joint float: Free { parent: ground, child: hull }
        joint hinge: Revolute { parent: hull.at([0.1, 0.2, 0.3]).rotated([1, 1, 1], deg(60)), child: arm, axis: [1, 0, 1] }
        state lag: rate = 3.0 * (thrust - lag), start: 0.0;
        force motor: Effort { joint: hinge, value: lag }
        emit forward_dynamics, inverse_dynamics, mass_matrix, energy;
    }
}

multibody! {
    /// A four-bar on an oblique axis, of whose angles Newton's method finds two.
    pub mod iterated {
        formulation { constraints: Reduced, independent: [a] }
        world { gravity: [1.0, -9.0, 2.0] }
        let seat = ground.rotated([1, 2, 0.5], 0.7);
        body one { mass: 1.0, com: X, inertia: rod(1.0, 2.0, X) }
        body two { mass: 1.0, com: [0.6, 0.1, 0.0], inertia: rod(1.0, 1.2, X) }
        body three { mass: 1.0, com: 0.75 * X, inertia: rod(1.0, 1.5, X) }
        joint a: Revolute { parent: seat, child: one, axis: Z }
        joint b: Revolute { parent: one.at(2.0 * X), child: two, axis: Z }
        joint c: Revolute { parent: seat.at(3.5 * X), child: three, axis: Z }
        #[cut]
        joint d: Revolute { parent: two.at(1.2 * X), child: three.at(1.5 * X), axis: Z }
        emit forward_dynamics, inverse_dynamics, mass_matrix, energy;
    }
}

#[test]
fn functions_agree() {
    let model = pinned::Model::<f64>::default();
    let mut state = pinned::State::default();
    (state.q.a, state.q.b, state.q.c) = (1.1, -0.7, 1.9);
    (state.v.a, state.v.b, state.v.c) = (3.0, -2.0, 1.5);
    let input = pinned::Input { torque: 2.0 };
    let agreement = verify_at(&model, 0.3, &state, &input);
    assert!(agreement.worst() < 1e-13, "{agreement:?}");
    let (_, held) = model.free_motion(0.3, &state, &input);
    assert!(held.amax() > 1.0, "the last pin holds: {held}");

    let model = craft::Model::<f64>::default();
    let mut state = craft::State::default();
    (state.q.hinge, state.v.hinge, state.x.lag) = (-2.3, 1.7, 0.4);
    state.v.float.angular = [0.3, -1.1, 0.8].into();
    state.v.float.linear = [1.0, 2.0, -0.5].into();
    let agreement = verify(&model, &state);
    assert!(agreement.worst() < 1e-13, "{agreement:?}");

    // In single precision, to its own roundings.
    let single = craft::Model::<f32>::default();
    let mut coarse = craft::State::<f32>::default();
    (coarse.q.hinge, coarse.v.hinge) = (-2.3, 1.7);
    coarse.v.float.angular = [0.3, -1.1, 0.8].into();
    let agreement = verify(&single, &coarse);
    assert!(agreement.worst() < 1e-5, "{agreement:?}");

    let newton = iterated::Model::<f64>::default();
    let mut start = iterated::State::default();
    (start.q.a, start.v.a, start.guess) = (0.7, 4.0, iterated::Guess { b: -0.7, c: 2.1 });
    let closed = newton.close(0.0, &start);
    assert!(closed.residual < 1e-12);
    let closed = closed.state;
    let agreement = verify(&newton, &closed);
    assert!(agreement.worst() < 1e-13, "{agreement:?}");

    state.v.hinge = f64::NAN;
    assert!(verify(&model, &state).worst().is_nan());
}

/// A model that has one function wrong.
struct Liar {
    model: craft::Model<f64>,
    mass: f64,
    bias: f64,
    energy: f64,
    skew: f64,
}

impl System for Liar {
    type Scalar = f64;
    type State = craft::State<f64>;
    type Input = craft::Input<f64>;
    fn derivative(&self, t: f64, state: &Self::State, input: &Self::Input) -> (VelocityOf<Self>, ExtraOf<Self>) {
        self.model.derivative(t, state, input)
    }
    fn position_rates(&self, _t: f64, state: &Self::State) -> VelocityOf<Self> {
        state.v
    }
}

impl Verifiable<7> for Liar {
    fn free_motion(&self, t: f64, x: &Self::State, u: &Self::Input) -> (SVector<f64, 7>, SVector<f64, 7>) {
        self.model.free_motion(t, x, u)
    }
    fn efforts(&self, t: f64, x: &Self::State, u: &Self::Input, a: &SVector<f64, 7>) -> SVector<f64, 7> {
        self.model.efforts(t, x, u, a).add_scalar(self.bias)
    }
    fn inertia(&self, t: f64, x: &Self::State, u: &Self::Input) -> SMatrix<f64, 7, 7> {
        let mut mass = self.model.inertia(t, x, u) * self.mass;
        mass[(0, 6)] += self.skew;
        mass
    }
    fn kinetic(&self, t: f64, x: &Self::State, u: &Self::Input) -> f64 {
        self.energy * self.model.kinetic(t, x, u)
    }
}

#[test]
fn a_lie_is_told() {
    let mut state = craft::State::default();
    (state.q.hinge, state.v.hinge) = (-2.3, 1.7);
    let off = 1.0 + 1e-9;
    let liar = |[mass, bias, energy, skew]: [f64; 4]| {
        let model = craft::Model::default();
        verify(&Liar { model, mass, bias, energy, skew }, &state)
    };
    let honest = liar([1.0, 0.0, 1.0, 0.0]);
    assert!(honest.worst() < 1e-13, "{honest:?}");
    let of_mass = liar([off, 0.0, 1.0, 0.0]);
    assert!(of_mass.inertia > 1e-10 && of_mass.kinetic_energy > 1e-11 && of_mass.free_motion < 1e-13, "{of_mass:?}");
    assert!(liar([1.0, 1e-9, 1.0, 0.0]).free_motion > 1e-11);
    assert!(liar([1.0, 0.0, off, 0.0]).kinetic_energy > 1e-11);
    assert!(liar([1.0, 0.0, 1.0, 1e-9]).symmetry > 1e-11);
}
