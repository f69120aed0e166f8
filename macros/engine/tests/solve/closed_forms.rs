//! Closed forms of loops: the six reference loops with all digits, all planar triples, the spatial ones, loops drawn at
//! random; every branch closes the cycle, none is found twice, rates and accelerations follow.

use crate::cycle::{Cycle, Outcome};
use crate::reference;
use crate::rng::Rng;
use multibody_engine::contracts::cost::Cost;
use multibody_engine::dynamics::tree::{Motion, Orientation};
use multibody_engine::solve::{Failure, KinematicLoop, Segment, Value, solve};
use multibody_engine::symbolic::graph::{Rotation, Scalar};

const Z: usize = 2;

/// Planar loops with three unknown joints: R about z, P along x or y, the last one closes and is not wanted.
fn planar(rng: &mut Rng, kinds: &str, all: bool) -> Cycle {
    let mut c = Cycle::new();
    let crank = rng.real(-1.5, 1.5);
    let q = c.known(crank);
    let zero = Scalar::ZERO;
    c.fixed(&[(Z, q)], [zero; 3]);
    for (at, kind) in kinds.chars().enumerate() {
        let angle = c.literal(rng.decimal(-1.5, 1.5));
        let offset = [rng.decimal(0.5, 2.0), rng.decimal(-1.0, 1.0)].map(|x| c.literal(x));
        c.fixed(&[(Z, angle)], [offset[0], offset[1], zero]);
        let wanted = all || at < 2;
        match kind {
            'R' => c.revolute(Z, wanted, rng.real(-3.0, 3.0)),
            _ => c.prismatic(usize::from(rng.chance(50)), wanted, rng.real(0.3, 1.5)),
        };
    }
    c.close_planar();
    c
}

fn run(name: &str, mut draw: impl FnMut(&mut Rng) -> Cycle) {
    let mut rng = Rng::new(name.bytes().fold(7, |h: u64, b| h.wrapping_mul(31) + u64::from(b)));
    let (mut solved, mut most, mut error) = (0, 0, 0.0_f64);
    for _ in 0..40 {
        let mut c = draw(&mut rng);
        match c.check() {
            Ok(Outcome::Solved { branches, error: e, .. }) => {
                solved += 1;
                most = most.max(branches);
                error = error.max(e);
            }
            Ok(Outcome::Poor) => {}
            Err(failure) => panic!("{name}: {failure}"),
        }
        if solved == 12 {
            break;
        }
    }
    println!("{name}: {solved} solved, up to {most} branches, error {error:e}");
    assert!(solved >= 6, "{name}: {solved} good draws");
    assert!(error < 1e-13, "{name}: {error:e}");
}

#[test]
fn planar_triples() {
    for kinds in ["RRR", "RRP", "RPR", "PRR", "PRP", "RPP", "PPR"] {
        run(kinds, |rng| planar(rng, kinds, false));
        run(&format!("{kinds}, all three"), |rng| planar(rng, kinds, true));
    }
}

/// Spatial loops from letters: R, P, H (screw), C (cylindrical), U (universal), S (ball), with constant links between.
/// Capital letters are wanted, small ones not. After a dot the link has no offset, after a bar the axis is parallel to
/// the one before, after a dash the next joint stands on that axis, in the same axes.
fn chain(rng: &mut Rng, kinds: &str) -> Cycle {
    let mut c = Cycle::new();
    let (mut central, mut straight, mut along, mut last) = (false, false, false, 0);
    for kind in kinds.chars() {
        match kind {
            '.' => {
                central = true;
                continue;
            }
            '|' => {
                straight = true;
                continue;
            }
            '-' => {
                (straight, along) = (true, true);
                continue;
            }
            _ => {}
        }
        let offset = [0; 3].map(|_| rng.decimal(-1.0, 1.0));
        let beside = |k: usize| central || (along && k != last);
        let offset = [0, 1, 2].map(|k| c.literal(if beside(k) { 0.0 } else { offset[k] }));
        let axis = if straight { last } else { rng.below(3) };
        let turns: Vec<_> = (0..3).map(|axis| (axis, c.literal(rng.decimal(-1.5, 1.5)))).collect();
        c.fixed(if straight { &[] } else { &turns }, offset);
        (central, straight, along, last) = (false, false, false, axis);
        let wanted = kind.is_ascii_uppercase();
        let angle = |rng: &mut Rng| rng.real(-3.0, 3.0);
        match kind.to_ascii_uppercase() {
            'R' => drop(c.revolute(axis, wanted, angle(rng))),
            'P' => drop(c.prismatic(axis, wanted, rng.real(0.3, 1.5))),
            'H' => drop(c.screw(axis, 0.2, wanted, rng.real(-1.0, 1.0))),
            'C' => {
                c.prismatic(axis, wanted, rng.real(0.3, 1.5));
                c.revolute(axis, wanted, angle(rng));
            }
            'U' => {
                c.revolute(axis, wanted, angle(rng));
                last = (axis + 1 + rng.below(2)) % 3;
                c.revolute(last, wanted, angle(rng));
            }
            _ => c.ball([0; 3].map(|_| rng.real(-1.2, 1.2))),
        }
    }
    c
}

fn spatial(rng: &mut Rng, kinds: &str) -> Cycle {
    let mut c = chain(rng, kinds);
    c.close();
    c
}

#[test]
fn spatial_triples() {
    for kinds in ["UPs", "UsR", "UsP", "sPs", "ssR", "ssP", "RsU", "PsU"] {
        run(kinds, |rng| spatial(rng, kinds));
    }
}

/// Distance on the circle or on the line.
fn apart(x: f64, y: f64) -> f64 {
    let d = (x - y).abs();
    d.min((d - std::f64::consts::TAU).abs())
}

#[test]
fn reference_loops() {
    for mut reference in reference::all() {
        let signs = reference.cycle.solve(&[]).unwrap_or_else(|f| panic!("{}: {f}", reference.name)).signs;
        let mut met = vec![false; reference.branches.len()];
        for branch in 0..1_usize << signs {
            let c = &mut reference.cycle;
            let choice: Vec<bool> = (0..signs).map(|k| branch >> k & 1 == 0).collect();
            let solution = c.solve(&choice).unwrap();
            c.put(&solution).unwrap();
            let motion = c.motion(&solution, &reference.knowns);
            let found: Vec<[f64; 3]> = reference
                .quantities
                .iter()
                .map(|&(symbol, sign, base)| {
                    let at = solution.solved.iter().position(|s| s.symbol == symbol).unwrap();
                    let known = reference.knowns.iter().find(|k| Some(k.0) == base);
                    let (rate, acceleration) = known.map_or((0.0, 0.0), |k| (k.1, k.2));
                    let value = base.map_or(0.0, |b| c.number(b)) + sign * c.number(symbol);
                    [value, rate + sign * motion[at].0, acceleration + sign * motion[at].1]
                })
                .collect();
            for (met, branch) in met.iter_mut().zip(&reference.branches) {
                let near = |tolerance: f64, k: usize| {
                    let compare = |(x, y): (&[f64; 3], &[Option<f64>; 3])| {
                        y[k].is_none_or(|y| apart(x[k], y) <= tolerance * (1.0 + y.abs()))
                    };
                    found.iter().zip(branch).all(compare)
                };
                if near(1e-13, 0) {
                    *met = true;
                    assert!(near(1e-13, 1) && near(1e-13, 2), "{}: {found:?} {branch:?}", reference.name);
                }
            }
            // The rest of the loop closes at this solution.
            assert!(c.complete(&solution) < 1e-13, "{}", reference.name);
        }
        assert!(met.iter().all(|m| *m), "{}: {met:?}", reference.name);
    }
}

/// A leg between a universal joint and a ball at d costs the length and the distance from the first axis: two roots.
#[test]
fn a_leg_is_cheap() {
    let mut c = Cycle::new();
    c.revolute(0, true, 0.0);
    c.revolute(1, true, 0.0);
    c.shift([0.0, 0.0, 1.0]);
    c.prismatic(Z, true, 0.0);
    c.ball([0.0; 3]);
    let d = [0.4, 0.5, 1.1].map(|x| -c.known(-x));
    c.fixed(&[], d.map(|x| -x));
    let solution = c.solve(&[true, false]).unwrap();
    // Slopes are at hand, too. The two squares of which one root is made are a part of the other's, which a later pass
    // shares.
    let least = Cost { add: 4, mul: 7, div: 2, sqrt: 2, ..Cost::default() };
    assert_eq!(c.cost(&solution), least);
}

/// A revolute joint or a slider against a point, a plane, a direction; arms with an elbow; two axes that meet (Paden-
/// Kahan 2) and a distance (3); cylinders.
#[test]
fn further_loops() {
    for kinds in ["Rspp", "Pspp", "R.R|Rs", "R.RPs", "CCc", "R|RPs", "P|R|Rs", "CsP"] {
        run(kinds, |rng| spatial(rng, kinds));
    }
    for kinds in [".R.R.r", ".R.R.R"] {
        run(kinds, |rng| {
            let mut c = chain(rng, kinds);
            c.close_spherical();
            c
        });
    }
}

/// A rod that turns about the line to the centre of its ball.
#[test]
fn a_ball_on_an_axis_is_a_point() {
    run("UPr-s", |rng| spatial(rng, "UPr-s"));
}

/// A nut that turns on a fixed screw; a slide that a turning screw drives.
#[test]
fn screws_are_linear() {
    run("turning nut", |rng| {
        let mut c = Cycle::new();
        c.screw(Z, 0.2, true, rng.real(-3.0, 3.0));
        c.shift([0.0, 0.0, 0.7]);
        c.revolute(Z, false, 0.4);
        c.close_axial();
        c
    });
    run("driven slide", |rng| {
        let mut c = Cycle::new();
        let angle = c.known(rng.real(-8.0, 8.0));
        let pitch = c.literal(0.2);
        let travel = c.g.mul(pitch, angle);
        c.fixed(&[(Z, angle)], [Scalar::ZERO, Scalar::ZERO, travel]);
        c.revolute(Z, false, rng.real(-3.0, 3.0));
        c.prismatic(Z, true, rng.real(-2.0, 2.0));
        c.close_axial();
        c
    });
}

/// Loops of six freedoms drawn from joint kinds. Not all of them have a closed form by pairs; most do that hold two
/// joints with a centre or an axis in common.
#[test]
fn random_loops() {
    let mut rng = Rng::new(2026);
    let (mut solved, mut failed, mut poor) = (Vec::new(), Vec::new(), Vec::new());
    for _ in 0..120 {
        let mut kinds = String::new();
        let mut left = 6_usize;
        while left > 0 {
            let (kind, freedoms) = [('R', 1), ('P', 1), ('H', 1), ('C', 2), ('U', 2), ('s', 3), ('s', 3)][rng.below(7)];
            if freedoms <= left {
                kinds.push(kind);
                left -= freedoms;
            }
        }
        // The last joint closes the loop.
        let last = kinds.pop().unwrap().to_ascii_lowercase();
        kinds.push(last);
        if solved.contains(&kinds) || failed.contains(&kinds) || !kinds.contains(|k: char| k.is_ascii_uppercase()) {
            continue;
        }
        let mut outcome = None;
        for _ in 0..20 {
            match spatial(&mut rng, &kinds).check() {
                Ok(Outcome::Poor) => {}
                Ok(Outcome::Solved { error, branches, drawn }) => {
                    // An unwanted universal joint doesn't reach every point at its distance: other branches may be open.
                    let error = if kinds.contains('u') { drawn } else { error };
                    assert!(error < 1e-13, "{kinds}: {error:e}");
                    outcome = Some(Ok(branches));
                    break;
                }
                Err(failure) => {
                    outcome = Some(Err(failure));
                    break;
                }
            }
        }
        match outcome {
            Some(Ok(_)) => solved.push(kinds),
            Some(Err(_)) => failed.push(kinds),
            None => poor.push(kinds),
        }
    }
    println!("closed forms: {solved:?}\nnone: {failed:?}\nno good draw: {poor:?}");
    assert!(solved.len() >= 12);
}

/// The point at given distances from three others, both solutions: the forward kinematics of a Delta robot.
#[test]
fn three_spheres_meet() {
    let mut rng = Rng::new(4);
    for _ in 0..100 {
        let mut c = Cycle::new();
        let point = [0; 3].map(|_| rng.real(-1.0, 1.0));
        let slides = point.map(|x| c.known(x));
        let mut centres = Vec::new();
        let cycles = [0; 3].map(|_| {
            let centre = [0; 3].map(|_| rng.real(-2.0, 2.0));
            let square: f64 = centre.iter().zip(point).map(|(a, b)| (a - b) * (a - b)).sum();
            centres.push((centre, square));
            let unknown = |motion, symbol, wanted| Segment::Unknown { motion, symbol, wanted };
            let mut segments: Vec<Segment> = (0..3).map(|k| unknown(Motion::Prismatic(k), slides[k], true)).collect();
            let ball = |c: &mut Cycle| {
                let quaternion = c.g.unit_quaternion();
                c.values.extend([0.0; 4]);
                unknown(Motion::Ball(Orientation::Quaternion(quaternion)), quaternion[0], false)
            };
            let length = c.known(square.sqrt());
            let back = centre.map(|x| -c.known(x));
            let offsets = [c.g.along(0, length), c.g.vector(back)];
            for offset in offsets {
                segments.push(ball(&mut c));
                segments.push(Segment::Fixed { rotation: Rotation::IDENTITY, offset });
            }
            KinematicLoop { segments, winding: None }
        });
        let both = [true, false].map(|sign| {
            let solution = solve(&mut c.g, &cycles, &[sign]).expect("a closed form");
            assert_eq!((solution.signs, solution.solved.len()), (1, 3));
            let roots: Vec<f64> =
                solution.solved.iter().flat_map(|one| &one.roots).map(|root| c.number(root.value)).collect();
            let at = slides.map(|slide| {
                let one = solution.solved.iter().find(|one| one.symbol == slide).expect("each slide");
                let Value::Length(x) = one.value else { panic!("a travel") };
                c.number(x)
            });
            (at, roots)
        });
        if both[0].1[0].abs() < 0.3 {
            continue;
        }
        for (at, _) in &both {
            for (centre, square) in &centres {
                let own: f64 = centre.iter().zip(at).map(|(a, b)| (a - b) * (a - b)).sum();
                assert!((own - square).abs() < 1e-11, "{own} {square}");
            }
        }
        let distance = |x: &[f64]| x.iter().zip(point).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        let least = both.iter().map(|x| distance(&x.0)).fold(f64::INFINITY, f64::min);
        assert!(least < 1e-12, "{least:e}");
        assert!(distance(&both[0].0).max(distance(&both[1].0)) > 1e-3);
    }
}

/// What can't be found is reported.
#[test]
fn no_closed_form_is_an_error() {
    let mut rng = Rng::new(1);
    let failure = spatial(&mut rng, "RRRRRr").solve(&[]).unwrap_err();
    assert!(
        matches!(&failure, Failure::NotFound { remaining, solved: 0, cycles: 1 } if remaining.len() == 5),
        "{failure}"
    );
    assert!(failure.to_string().contains("5 remain"), "{failure}");
}
