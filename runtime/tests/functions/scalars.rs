//! Single precision, lanes and dual numbers go through functions of the user's own as through all else.

use multibody::Real;

mod arm {
    crate::twice! {
        input push;
        param mu = 0.3;
        world { gravity: [0.3, -9.7, 1.2] }
        body upper { mass: 2.0, com: [0.1, -0.4, 0.05], inertia: diag(0.1, 0.2, 0.25) }
        body lower { mass: 1.0, com: [0.2, -0.3, 0.1], inertia: diag(0.1, 0.2, 0.25) }
        joint shoulder: Revolute { parent: ground, child: upper, axis: [0.1, 0.2, 1.0] }
        joint elbow: Revolute { parent: upper.at([0.2, -0.8, 0.1]), child: lower, axis: [1.0, -0.3, 0.2] }
        force drag: Effort { joint: shoulder, value: grip(shoulder.rate, mu) + blend(elbow, shoulder, push) }
        force more: Effort { joint: elbow, value: grip(elbow.rate, 1.0 + push) }
        emit forward_dynamics, derivatives;
    }
}

use arm::rust::{Input, Model, Params, State};

/// Position, velocity, input.
const PLACE: [f64; 5] = [0.4, -1.3, 0.7, -0.2, 0.6];

fn accelerations<T: Real>([a, b, da, db, push]: [T; 5]) -> [T; 2] {
    let model = Model::new(&Params { mu: T::lit(0.3) });
    let mut state = State::<T>::default();
    (state.q.shoulder, state.q.elbow, state.v.shoulder, state.v.elbow) = (a, b, da, db);
    let v = model.forward_dynamics(T::lit(0.0), &state, &Input { push });
    [v.shoulder, v.elbow]
}

#[test]
fn single_precision() {
    let double = accelerations(PLACE);
    let single = accelerations(PLACE.map(|x| x as f32));
    for (x, y) in double.iter().zip(single) {
        assert!((x - f64::from(y)).abs() < 1e-5 * (1.0 + x.abs()), "{x} {y}");
    }
}

#[cfg(feature = "wide")]
#[test]
fn lanes() {
    use multibody::simba::simd::{SimdValue, WideF64x4};

    let place = |lane: usize| PLACE.map(|x| x * (1.0 + 0.3 * lane as f64));
    let mut all = PLACE.map(WideF64x4::splat);
    for lane in 0..4 {
        for (into, x) in all.iter_mut().zip(place(lane)) {
            into.replace(lane, x);
        }
    }
    let together = accelerations(all);
    for lane in 0..4 {
        for (x, y) in accelerations(place(lane)).iter().zip(together) {
            assert!((x - y.extract(lane)).abs() < 1e-13 * (1.0 + x.abs()), "{lane}: {x} {y:?}");
        }
    }
}

/// Dual numbers differentiate values; slopes come of `slopes`.
#[cfg(feature = "num-dual")]
#[test]
fn dual_numbers() {
    use num_dual::Dual64;

    let mut state = State::default();
    (state.q.shoulder, state.q.elbow, state.v.shoulder, state.v.elbow) = (PLACE[0], PLACE[1], PLACE[2], PLACE[3]);
    let slopes = Model::new(&Params { mu: 0.3 }).forward_derivatives(0.0, &state, &Input { push: PLACE[4] });
    for along in 0..5 {
        let seeded = std::array::from_fn(|k| Dual64::new(PLACE[k], f64::from(u8::from(k == along))));
        let column = match along {
            0 | 1 => slopes.position.column(along),
            2 | 3 => slopes.velocity.column(along - 2),
            _ => slopes.input.column(0),
        };
        for (x, slope) in accelerations(seeded).iter().zip(column.iter()) {
            assert!((x.eps - slope).abs() < 1e-12 * (1.0 + slope.abs()), "{along}: {x} {slope}");
        }
    }
}
