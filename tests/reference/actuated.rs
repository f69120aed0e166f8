//! Motors that are solved for, against another library's efforts (`data/robots`): direct ones, and gears, a belt and a
//! differential whose ratios are parameters, some of them zero.

use multibody::Real;
use multibody::nalgebra::SVector;
use multibody_tests::models::actuated::{puma560_direct as direct, puma560_geared as geared};
use multibody_tests::support::compare::relative;
use multibody_tests::support::data::{flat, list, read};

/// Of max |x - ref| over max |ref| per vector.
const TOLERANCE: f64 = 1e-12;

fn samples() -> Vec<[SVector<f64, 6>; 4]> {
    let file = read("robots/puma560.samples");
    let get = |sample, key: &str| SVector::from_row_slice(&flat(&serde_json::Value::clone(sample)[key]));
    list(&file["samples"]).iter().map(|sample| ["q", "v", "a", "rnea"].map(|key| get(sample, key))).collect()
}

#[test]
fn direct_motors() {
    let model = direct::Model::<f64>::new(&direct::Params::default());
    for [q, v, a, want] in samples() {
        let state = direct::State { q: q.into(), v: v.into() };
        let direct::Solved { input, rank } = model.inverse_dynamics(0.0, &state, &Default::default(), &a.into());
        assert!(relative(&input.tau, want.as_slice()) <= TOLERANCE, "{:?} {want}", input.tau);
        assert_eq!(rank, 6.0);
    }
}

/// What the motors do to the joints.
fn efforts<T: Real>(params: &geared::Params<T>, tau: [T; 6]) -> [T; 6] {
    let geared::Params { gears, belt, wrist } = params;
    [
        gears[0] * tau[0],
        gears[1] * tau[1] + belt[1] * tau[2],
        belt[0] * tau[2],
        -tau[3],
        wrist[0] * (tau[4] + tau[5]),
        wrist[1] * (tau[4] - tau[5]),
    ]
}

#[test]
fn motors_behind_gears() {
    let params = geared::Params::<f64>::default();
    let model = geared::Model::new(&params);
    for [q, v, a, want] in samples() {
        let state = geared::State { q: q.into(), v: v.into() };
        let geared::Solved { input, rank } = model.inverse_dynamics(0.0, &state, &Default::default(), &a.into());
        let got = efforts(&params, input.tau);
        assert!(relative(&got, want.as_slice()) <= TOLERANCE, "{got:?} {want}");
        assert_eq!(rank, 6.0);
        let again: SVector<f64, 6> = model.forward_dynamics(0.0, &state, &input).into();
        // Of a mass matrix with a condition number of 7e4.
        assert!(relative(again.as_slice(), a.as_slice()) <= 1e-10, "{again} {a}");
    }
}

/// Ratios of zero: the rank says so, and what the other motors can do they do.
#[test]
fn motors_without_gears() {
    let default = geared::Params::<f64>::default();
    // Parameters, the rank, joints that have lost their motor.
    let cases: [(geared::Params<f64>, f64, &[usize]); 5] = [
        (geared::Params { gears: [0.0, 107.8], ..default }, 5.0, &[0]),
        (geared::Params { belt: [0.0, 0.0], ..default }, 5.0, &[2]),
        (geared::Params { gears: [62.5, 0.0], belt: [53.7, 0.0], ..default }, 5.0, &[1]),
        (geared::Params { wrist: [71.9, 0.0], ..default }, 5.0, &[5]),
        (geared::Params { gears: [0.0, 0.0], belt: [0.0, 0.0], wrist: [0.0, 0.0] }, 1.0, &[0, 1, 2, 4, 5]),
    ];
    for (params, expected, lost) in cases {
        let model = geared::Model::new(&params);
        let single = geared::Params::<f32> {
            gears: params.gears.map(|x| x as f32),
            belt: params.belt.map(|x| x as f32),
            wrist: params.wrist.map(|x| x as f32),
        };
        let single = geared::Model::new(&single);
        for [q, v, a, want] in samples() {
            let state = geared::State { q: q.into(), v: v.into() };
            let geared::Solved { input, rank } = model.inverse_dynamics(0.0, &state, &Default::default(), &a.into());
            assert_eq!(rank, expected, "{params:?}");
            let mut want = want;
            lost.iter().for_each(|&joint| want[joint] = 0.0);
            let got = efforts(&params, input.tau);
            assert!(relative(&got, want.as_slice()) <= TOLERANCE, "{got:?} {want}");
            let [q, v, a] = [q, v, a].map(|x| x.map(|x| x as f32));
            let state = geared::State { q: q.into(), v: v.into() };
            let solved = single.inverse_dynamics(0.0, &state, &Default::default(), &a.into());
            assert_eq!(solved.rank, expected as f32, "{params:?}");
        }
    }
    // Both rows of the belt lost but for what couples them: one motor is left for two joints.
    let params = geared::Params { gears: [62.5, 0.0], belt: [0.0, -12.5], ..default };
    let model = geared::Model::new(&params);
    for [q, v, a, want] in samples() {
        let state = geared::State { q: q.into(), v: v.into() };
        let geared::Solved { input, rank } = model.inverse_dynamics(0.0, &state, &Default::default(), &a.into());
        assert_eq!(rank, 5.0);
        let mut want = want;
        want[2] = 0.0;
        let got = efforts(&params, input.tau);
        assert!(relative(&got, want.as_slice()) <= TOLERANCE, "{got:?} {want}");
    }
}
