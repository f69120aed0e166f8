//! A snakeboard in an oblique plane, in four ways, along its closed solution and under both torques.

use multibody::nalgebra::Vector3;
use multibody::{Dop853, Integrator, Projection, WithProjection, multibody};

use crate::speeds::{same_ends, with_rates};

four_ways!(paths [board_held, board, board_chosen, board_beside], [plane.x, swing, fore], {
    const HALF = 0.4;
    let road = ground.rotated([0.3, 1.0, -0.4], 0.9);
    body board { mass: 3.0, inertia: inertia(0.2, 0.3, 0.15, 0.01, 0.02, -0.03) }
    body rotor { mass: 2.0, inertia: diag(0.13, 0.1, 0.2) }
    body front { mass: 0.3, inertia: diag(0.01, 0.01, 0.01) }
    body back { mass: 0.3, inertia: diag(0.01, 0.01, 0.01) }
    joint plane: Planar { parent: road, child: board, axis: Z }
    joint swing: Revolute { parent: board, child: rotor, axis: Z }
    joint fore: Revolute { parent: board.at(HALF * X), child: front, axis: Z }
    joint aft: Revolute { parent: board.at(-HALF * X), child: back, axis: Z }
    constraint alike = fore + aft;
    constraint front_blade: Skate { blade: front, along: X, on: road }
    constraint back_blade: Skate { blade: back, along: X, on: road }
    input twist;
    input steer;
    force by_rotor: Effort { joint: swing, value: twist }
    force by_foot: Effort { joint: fore, value: steer }
    output energy = kinetic();
    output angles = [plane.angle, swing, fore];
    output rates = [plane.angle.rate, swing.rate, fore.rate];
    output velocity = board.express(board.velocity);
    // Of all bodies, along the board and about its middle.
    output push = board.express(linear_momentum());
    output turn = board.express(angular_momentum() + cross(centre_of_mass() - board.position, linear_momentum()));
}, {
    /// [m/s]
    speed ahead = board.express(board.velocity).x;
    /// [rad/s]
    speed turned = swing.rate + plane.angle.rate;
    /// [rad/s]
    speed foot = 2.0 * fore.rate - 0.3 * swing.rate;
}, {
    /// [m/s]
    speed aside = board.express(board.velocity).y;
    /// [rad/s]
    speed nod = fore.rate + 0.1 * swing.rate + 0.2 * sin(swing) * plane.angle.rate;
});

const HALF: f64 = 0.4;
const MASS: f64 = 5.6;
const ROTOR: f64 = 0.2;
/// Of all but the rotor about the middle.
const TURNED: f64 = 0.15 + 2.0 * 0.01 + 2.0 * 0.3 * HALF * HALF;
/// Of both trucks against the board.
const TRUCKS: f64 = 0.02;

/// What the start is: the angles of the plane, the rotor and the front truck, and along what the blades leave.
struct Start {
    angles: [f64; 3],
    sigma: f64,
    swing: f64,
    fore: f64,
}

impl Start {
    /// Twice the energy of u = l cos(steer) and w = sin(steer).
    fn weight(steer: f64) -> f64 {
        MASS * (HALF * steer.cos()).powi(2) + TURNED * steer.sin().powi(2)
    }

    /// Of positions: with those of the trucks alike.
    fn rates(&self) -> Vec<f64> {
        let [heading, _, steer] = self.angles;
        let (ahead, turn) = (HALF * steer.cos() * self.sigma, steer.sin() * self.sigma);
        vec![ahead * heading.cos(), ahead * heading.sin(), turn, self.swing, self.fore]
    }
}

/// Starts one of the four models, runs it, and looks at all of its steps; its place and angles at the end.
macro_rules! ride {
    ($name:ident, $held:tt, $start:expr, [$twist:expr, $steer:expr], $until:expr, $look:expr) => {{
        let model = $name::Model::<f64>::default();
        let input = $name::Input { twist: $twist, steer: $steer };
        let mut state = $name::State::<f64>::default();
        state.q.plane = multibody::Planar { x: 0.2, y: -0.3, angle: $start.angles[0] };
        [state.q.swing, state.q.fore] = [$start.angles[1], $start.angles[2]];
        let state = with_rates(&model, 0.0, &state, &$start.rates());
        let mut look = $look;
        let mut looked = 0;
        let mut see = |t: f64, state: &$name::State<f64>| {
            let out = model.outputs(t, state, &input);
            looked += 1;
            look(
                t,
                Seen {
                    energy: out.energy,
                    angles: out.angles,
                    rates: out.rates,
                    velocity: out.velocity,
                    push: out.push,
                    turn: out.turn,
                },
            );
        };
        see(0.0, &state);
        let (end, _) = run!(model, $held, 0.0, $until, &state, &input, see).unwrap();
        assert!(looked > 5);
        vec![end.q.plane.x, end.q.plane.y, end.q.plane.angle, end.q.swing, end.q.fore]
    }};
}

struct Seen {
    energy: f64,
    angles: [f64; 3],
    rates: [f64; 3],
    velocity: Vector3<f64>,
    push: Vector3<f64>,
    turn: Vector3<f64>,
}

/// The momentum about the centre about which all turns, l cot f aside of the middle for the angle f of the front truck, changes by turns
/// of that centre alone (Lewis, Ostrowski, Burdick and Murray 1994; Bloch, Krishnaprasad, Marsden and Murray 1996). With
/// u = l cos(f) s / sqrt(M), w = sin(f) s / sqrt(M), M(f) = m l^2 cos(f)^2 + J sin(f)^2 and the rotor's momentum P = I (w + swing') its
/// equation is s' = -sin(f) P' / sqrt(M): s is constant where no torque turns the rotor. Where the trucks turn evenly and a constant
/// torque T turns the rotor, P = P0 + T t, s = s0 - T (F(f) - F(f0)) / f', and the heading is (s0 D - T D^2 / 2 f') / f' further on with
/// D = F(f) - F(f0), F' = sin(f) / sqrt(M): F = -asinh(k cos(f) / sqrt(J)) / k, k^2 = m l^2 - J.
#[test]
fn a_snakeboard_whose_trucks_turn_evenly() {
    for twist in [0.0, 0.13] {
        let start = Start { angles: [0.4, -0.6, -0.9], sigma: 0.9, swing: 0.5, fore: 0.45 };
        let k = (MASS * HALF * HALF - TURNED).sqrt();
        let integral = |steer: f64| -(k * steer.cos() / TURNED.sqrt()).asinh() / k;
        let first = Start::weight(start.angles[2]).sqrt() * start.sigma;
        let spin = ROTOR * (start.angles[2].sin() * start.sigma + start.swing);
        let mut ends = Vec::new();
        let mut energy = None;
        macro_rules! check {
            ($name:ident, $held:tt) => {
                ends.push(ride!($name, $held, start, [twist, 0.0], 4.0, |t: f64, seen: Seen| {
                    let steer = start.angles[2] + start.fore * t;
                    let gone = integral(steer) - integral(start.angles[2]);
                    let size = Start::weight(steer).sqrt();
                    let sigma = (first - twist * gone / start.fore) / size;
                    let turned = (first * gone - twist * gone * gone / (2.0 * start.fore)) / start.fore;
                    let spin = spin + twist * t;
                    let swung = (spin * t - 0.5 * twist * t * t) / ROTOR - turned;
                    let before = *energy.get_or_insert(seen.energy);
                    let work = twist * (seen.angles[1] - start.angles[1]);
                    let momentum = HALF * steer.cos() * seen.push.x + steer.sin() * seen.turn.z;
                    let apart = [
                        seen.velocity.x - HALF * steer.cos() * sigma,
                        seen.velocity.y,
                        seen.rates[0] - steer.sin() * sigma,
                        seen.rates[1] - spin / ROTOR + seen.rates[0],
                        seen.angles[0] - start.angles[0] - turned,
                        seen.angles[1] - start.angles[1] - swung,
                        seen.angles[2] - steer,
                        momentum - size * size * sigma - steer.sin() * spin,
                    ];
                    assert!(apart.iter().all(|x| x.abs() < 1e-10), "{} at {t}: {apart:?}", stringify!($name));
                    let kept = [
                        seen.rates[2] / start.fore - 1.0,
                        ROTOR * (seen.rates[0] + seen.rates[1]) / spin - 1.0,
                        (seen.energy - work) / before - 1.0,
                        (momentum - steer.sin() * spin) / size / (first - twist * gone / start.fore) - 1.0,
                    ];
                    assert!(kept.iter().all(|x| x.abs() < 1e-12), "{} at {t}: {kept:?}", stringify!($name));
                }));
            };
        }
        each_way!(check: board_held, board, board_chosen, board_beside);
        same_ends(&ends);
    }
}

/// Under torques on the rotor and on the trucks: work is energy, and trucks and rotor turn as they would without wheels.
#[test]
fn a_snakeboard_under_torques() {
    let start = Start { angles: [-0.3, 0.8, 0.7], sigma: 1.1, swing: -0.7, fore: -0.6 };
    let (twist, steer) = (-0.21, 0.003);
    let spin = ROTOR * (start.angles[2].sin() * start.sigma + start.swing);
    let mut ends = Vec::new();
    let mut energy = None;
    macro_rules! check {
        ($name:ident, $held:tt) => {
            ends.push(ride!($name, $held, start, [twist, steer], 4.0, |t: f64, seen: Seen| {
                let before = *energy.get_or_insert(seen.energy);
                let work = twist * (seen.angles[1] - start.angles[1]) + steer * (seen.angles[2] - start.angles[2]);
                let kept = [
                    (seen.energy - work) / before - 1.0,
                    seen.rates[2] - start.fore - steer * t / TRUCKS,
                    seen.angles[2] - start.angles[2] - start.fore * t - 0.5 * steer * t * t / TRUCKS,
                    ROTOR * (seen.rates[0] + seen.rates[1]) - spin - twist * t,
                ];
                assert!(kept.iter().all(|x| x.abs() < 1e-12), "{} at {t}: {kept:?}", stringify!($name));
            }));
        };
    }
    each_way!(check: board_held, board, board_chosen, board_beside);
    same_ends(&ends);
}
