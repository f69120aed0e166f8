//! The mechanisms as subjects: models with their starts.

use multibody::nalgebra::{Quaternion, SVector, UnitQuaternion, Vector3};
use multibody::{Constrained, Real};

use crate::models;
use crate::reference::Motion;
use crate::subject::{Laws, Subject, doubled, lit};

fn motion(q: &[f64], v: &[f64]) -> Motion {
    Motion { q: q.to_vec(), v: v.to_vec() }
}

/// The state of a model whose coordinates form a vector, in double precision.
macro_rules! double {
    ($module:ident, $state:expr) => {
        models::$module::State {
            q: doubled(SVector::from($state.q)).into(),
            v: doubled(SVector::from($state.v)).into(),
        }
    };
}

/// Energy, and gaps in double precision where a model has equations left.
macro_rules! laws {
    ($module:ident, $state:expr) => {{
        let (model, x) = (models::$module::Model::<f64>::default(), double!($module, $state));
        let energy = model.kinetic_energy(&x) + model.potential_energy(&x.q);
        (model, x, energy)
    }};
}

pub(crate) fn pendulum<T: Real>() -> Subject<models::pendulum::Model<T>> {
    use models::pendulum::{Model, Position, State, Velocity};
    Subject {
        system: Model::default(),
        start: State { q: Position { hinge: T::lit(-std::f64::consts::FRAC_PI_2) }, v: Velocity::default() },
        motion: |x| motion(&[x.q.hinge.greatest()], &[x.v.hinge.greatest()]),
        laws: |x| Laws { energy: laws!(pendulum, x).2, gap: 0.0 },
    }
}

/// From rest at angles from straight down.
pub(crate) fn double_pendulum<T: Real>(angles: [f64; 2]) -> Subject<models::double_pendulum::Model<T>> {
    use models::double_pendulum::{Model, State, Velocity};
    Subject {
        system: Model::default(),
        start: State { q: lit([angles[0], angles[1] - angles[0]]).into(), v: Velocity::default() },
        motion: |x| {
            let x = double!(double_pendulum, x);
            motion(&[x.q.shoulder, x.q.shoulder + x.q.elbow], &[x.v.shoulder, x.v.shoulder + x.v.elbow])
        },
        laws: |x| Laws { energy: laws!(double_pendulum, x).2, gap: 0.0 },
    }
}

pub(crate) fn free_body<T: Real>() -> Subject<models::free_body::Model<T>> {
    use models::free_body::{Model, State};
    fn double<T: Real>(x: &State<T>) -> State {
        let p = x.q.free.orientation.into_inner().coords.map(Real::greatest);
        let mut state = State::default();
        state.q.free.orientation = UnitQuaternion::new_unchecked(Quaternion::new(p.w, p.x, p.y, p.z));
        state.v.free.angular = doubled(x.v.free.angular);
        state
    }
    let mut start = State::default();
    start.v.free.angular = Vector3::from([1e-3, 5.0, 1e-3].map(T::lit));
    Subject {
        system: Model::default(),
        start,
        motion: |x| {
            let x = double(x);
            let p = x.q.free.orientation.into_inner();
            motion(&[p.w, p.i, p.j, p.k], x.v.free.angular.as_slice())
        },
        laws: |x| Laws { energy: Model::<f64>::default().kinetic_energy(&double(x)), gap: 0.0 },
    }
}

pub(crate) fn panda<T: Real>() -> Subject<models::panda::Model<T>> {
    use models::panda::{Model, State};
    Subject {
        system: Model::default(),
        start: State {
            q: lit([0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785]).into(),
            v: lit([0.5, -0.3, 0.2, 0.4, -0.6, 0.3, 0.1]).into(),
        },
        motion: |x| {
            let x = double!(panda, x);
            motion(SVector::from(x.q).as_slice(), SVector::from(x.v).as_slice())
        },
        laws: |x| Laws { energy: laws!(panda, x).2, gap: 0.0 },
    }
}

pub(crate) fn governor<T: Real>() -> Subject<models::governor::Model<T>> {
    use models::governor::{Model, State, Velocity};
    let mut start = State { q: lit([0.0, 0.3, 0.301, -0.382]).into(), v: Velocity::default() };
    start.v.shaft = T::lit(6.0);
    Subject {
        system: Model::default(),
        start,
        motion: |x| {
            let x = double!(governor, x);
            motion(SVector::from(x.q).as_slice(), SVector::from(x.v).as_slice())
        },
        laws: |x| Laws { energy: laws!(governor, x).2, gap: 0.0 },
    }
}

pub(crate) fn four_bar<T: Real>() -> Subject<models::four_bar::Model<T>> {
    use models::four_bar::{Model, Position, State, Velocity};
    Subject {
        system: Model::default(),
        start: State { q: Position::default(), v: Velocity { shaft: T::lit(6.0) } },
        motion: |x| {
            let output = Model::<f64>::default().outputs(0.0, &double!(four_bar, x), &());
            motion(output.angles.as_slice(), output.rates.as_slice())
        },
        laws: |x| Laws { energy: laws!(four_bar, x).2, gap: 0.0 },
    }
}

pub(crate) fn four_bar_loop<T: Real>() -> Subject<models::four_bar_loop::Model<T>> {
    use models::four_bar_loop::{Model, State};
    let start = four_bar::<f64>();
    let output = start.system.outputs(0.0, &start.start, &());
    let relative = |[first, second, third]: [f64; 3]| lit([first, second - first, third]);
    Subject {
        system: Model::default(),
        start: State { q: relative(output.angles).into(), v: relative(output.rates).into() },
        motion: |x| {
            let State { q, v } = double!(four_bar_loop, x);
            motion(&[q.shaft, q.shaft + q.knee, q.pivot], &[v.shaft, v.shaft + v.knee, v.pivot])
        },
        laws: |x| {
            let (model, x, energy) = laws!(four_bar_loop, x);
            Laws { energy, gap: Constrained::constraints(&model, 0.0, &x.q).amax() }
        },
    }
}

/// `[rad]` of the squeezer's crank at the start
const CRANK: f64 = -0.061_713_890_014_276_45;

pub(crate) fn andrews<T: Real>() -> Subject<models::andrews::Model<T>> {
    use models::andrews::{Model, Position, State, Velocity};
    Subject {
        system: Model::default(),
        start: State { q: Position { beta: T::lit(CRANK) }, v: Velocity::default() },
        motion: |x| {
            let x = double!(andrews, x);
            let output = Model::<f64>::default().outputs(0.0, &x, &());
            let all = |crank: f64, rest: [Vector3<f64>; 2]| {
                let rest = rest.into_iter().flat_map(<[f64; 3]>::from);
                std::iter::once(crank).chain(rest).collect()
            };
            Motion { q: all(x.q.beta, output.angles), v: all(x.v.beta, output.rates) }
        },
        laws: |x| {
            let (_, x, energy) = laws!(andrews, x);
            Laws { energy: energy - 0.033 * x.q.beta, gap: 0.0 }
        },
    }
}

pub(crate) fn andrews_loops<T: Real>() -> Subject<models::andrews_loops::Model<T>> {
    use models::andrews_loops::{Model, State, Velocity};
    let reduced = andrews::<f64>();
    let [beta, theta, gamma, phi, delta, omega, epsilon] =
        (reduced.motion)(&reduced.start).q.try_into().unwrap_or_default();
    Subject {
        system: Model::default(),
        start: State { q: lit([beta, theta, gamma, delta, phi, epsilon, omega]).into(), v: Velocity::default() },
        motion: |x| {
            let State { q, v } = double!(andrews_loops, x);
            motion(
                &[q.beta, q.theta, q.gamma, q.phi, q.delta, q.omega, q.epsilon],
                &[v.beta, v.theta, v.gamma, v.phi, v.delta, v.omega, v.epsilon],
            )
        },
        laws: |x| {
            let (model, x, energy) = laws!(andrews_loops, x);
            Laws { energy: energy - 0.033 * x.q.beta, gap: Constrained::constraints(&model, 0.0, &x.q).amax() }
        },
    }
}

pub(crate) fn stewart<T: Real>() -> Subject<models::stewart::Model<T>> {
    use models::stewart::{Model, State};
    Subject {
        system: Model::default(),
        start: State {
            q: lit([-1.45, 0.05, 1.05, 0.1, -0.05, 0.15]).into(),
            v: lit([0.3, -0.2, 0.4, 0.5, -0.4, 0.3]).into(),
        },
        motion: |x| {
            let x = double!(stewart, x);
            motion(SVector::from(x.q).as_slice(), SVector::from(x.v).as_slice())
        },
        laws: |x| Laws { energy: laws!(stewart, x).2, gap: 0.0 },
    }
}

pub(crate) fn stewart_loops<T: Real>() -> Subject<models::stewart_loops::Model<T>> {
    use models::stewart_loops::{Model, State};
    let plate = stewart::<f64>();
    let legs = plate.system.kinematics(0.0, &plate.start, &models::stewart::Velocity::default());
    let (pose, rates) = (SVector::<f64, 6>::from(plate.start.q), SVector::<f64, 6>::from(plate.start.v));
    let all = |plate: SVector<f64, 6>, legs: SVector<f64, 18>| -> SVector<T, 24> {
        SVector::from_fn(|k, _| T::lit(if k < 6 { plate[k] } else { legs[k - 6] }))
    };
    // Found leg by leg, or joint by joint: the order of `find`.
    let by_leg = |found: SVector<f64, 18>| -> SVector<f64, 18> {
        SVector::from_fn(|k, _| if k % 3 < 2 { found[2 * (k / 3) + k % 3] } else { found[12 + k / 3] })
    };
    Subject {
        system: Model::default(),
        start: State { q: all(pose, by_leg(legs.position)).into(), v: all(rates, by_leg(legs.velocity)).into() },
        motion: |x| {
            let State { q, v } = double!(stewart_loops, x);
            let (q, v): (SVector<f64, 24>, SVector<f64, 24>) = (q.into(), v.into());
            motion(&q.as_slice()[..6], &v.as_slice()[..6])
        },
        laws: |x| {
            let (model, x, energy) = laws!(stewart_loops, x);
            Laws { energy, gap: Constrained::constraints(&model, 0.0, &x.q).amax() }
        },
    }
}
