//! Expressions in place of symbols, against expressions that were made with them from the start.

use std::collections::HashMap;

use crate::rng::Rng;
use multibody_engine::contracts::call::Call;
use multibody_engine::symbolic::evaluate::{Evaluator, Real};
use multibody_engine::symbolic::graph::{BlockKind, Graph, Rotation, Scalar, SymbolId, Vector};
use multibody_engine::symbolic::identity::{Verdict, close, identical};
use multibody_engine::symbolic::substitute::Substitution;

const SYMBOLS: usize = 4;

/// Vectors, rotations and scalars over four scalars and a unit quaternion, the same for the same seed.
fn build(g: &mut Graph, rng: &mut Rng, x: &[Scalar; SYMBOLS], q: [Scalar; 4]) -> (Vec<Scalar>, Vector, Rotation) {
    let mut scalars = x.to_vec();
    let mut vectors = vec![g.vector([x[0], x[1], Scalar::ONE])];
    let mut rotations = vec![g.quaternion_rotation(q), g.axis_rotation(0, x[2])];
    for _ in 0..30 {
        let (a, b) = (scalars[rng.below(scalars.len())], scalars[rng.below(scalars.len())]);
        let (v, w) = (vectors[rng.below(vectors.len())], vectors[rng.below(vectors.len())]);
        let r = rotations[rng.below(rotations.len())];
        match rng.below(12) {
            0 => scalars.push(g.sub(a, b)),
            1 => scalars.push(g.mul(a, b)),
            2 => scalars.push(g.sin(x[rng.below(SYMBOLS)])),
            3 => {
                let sum = g.sub(x[0], x[3]);
                scalars.push(g.cos(sum));
            }
            4 => scalars.push(g.dot(v, w)),
            5 => vectors.push(g.cross(v, -w)),
            6 => vectors.push(g.rotate(r, v)),
            7 => vectors.push(g.rotate(r.transpose(), w)),
            8 => {
                let turn = g.axis_rotation(rng.below(3), x[rng.below(SYMBOLS)]);
                rotations.push(g.compose(r, turn));
            }
            9 => vectors.push(g.scale(a, v)),
            10 => vectors.push(g.sub_vectors(v, w)),
            _ => {
                let least = g.call(Call::Atan2, &[a, b]);
                scalars.push(least);
            }
        }
    }
    let last = |list: &[Scalar]| list[list.len().saturating_sub(6)..].to_vec();
    (last(&scalars), vectors[vectors.len() - 1], rotations[rotations.len() - 1])
}

/// What takes the places of two of the symbols and of the quaternion.
fn replacements(g: &mut Graph, x: &[Scalar; SYMBOLS], half: Scalar) -> ([Scalar; SYMBOLS], [Scalar; 4]) {
    let sum = g.add(x[1], x[3]);
    // It holds the symbol that it replaces.
    let product = g.mul(x[2], x[3]);
    let angle = g.sub(product, x[2]);
    let (c, s) = (g.cos(half), g.sin(half));
    ([x[0], sum, -angle, x[3]], [c, Scalar::ZERO, s, Scalar::ZERO])
}

#[test]
fn substituting_is_making_with() {
    for seed in 0..60 {
        let mut g = Graph::new();
        let x: [Scalar; SYMBOLS] = std::array::from_fn(|_| g.symbol());
        let half = g.symbol();
        let q = g.unit_quaternion();
        let (by, by_q) = replacements(&mut g, &x, half);
        let (scalars, vector, rotation) = build(&mut g, &mut Rng::new(seed), &x, q);
        let map: HashMap<SymbolId, Scalar> = [(x[1], by[1]), (x[2], by[2])]
            .into_iter()
            .chain(q.into_iter().zip(by_q))
            .map(|(s, by)| (g.symbol_id(s).unwrap(), by))
            .collect();
        let made = g.substitute(&scalars, &map);
        let mut substitution = Substitution::new(&g, &map);
        let vector = substitution.vectors(&mut g, &[vector, -vector]);
        let rotation = substitution.rotations(&mut g, &[rotation, rotation.transpose()]);
        let (mut expected, v, r) = build(&mut g, &mut Rng::new(seed), &by, by_q);
        // Equal values are one node.
        assert_eq!(made, expected, "seed {seed}");
        assert_eq!(vector, [v, -v], "seed {seed}");
        assert_eq!(rotation, [r, r.transpose()], "seed {seed}");
        // And by values that share nothing with the prints.
        let mut h = Graph::new();
        let x: [Scalar; SYMBOLS] = std::array::from_fn(|_| h.symbol());
        let half = h.symbol();
        h.unit_quaternion();
        let (by, by_q) = replacements(&mut h, &x, half);
        expected.clone_from(&build(&mut h, &mut Rng::new(seed), &by, by_q).0);
        assert_eq!(identical(&g, &made, &h, &expected, seed), Verdict::Identical, "seed {seed}");
        assert_ne!(close(&g, &made, &h, &expected, seed, 1e-9), Verdict::Different(0), "seed {seed}");
    }
}

#[test]
fn names_go_along_and_the_rest_stays() {
    let mut g = Graph::new();
    let (a, b, c) = (g.symbol(), g.symbol(), g.symbol());
    let kept = g.add(a, b);
    let product = g.mul(kept, c);
    g.name(product, || "moment".into());
    let map = HashMap::from([(g.symbol_id(c).unwrap(), b)]);
    let made = g.substitute(&[kept, -product], &map);
    assert_eq!(made[0], kept);
    assert_eq!(g.name_of(made[1]).map(|name| name.text.as_str()), Some("moment"));
    assert_eq!(made[1], -g.mul(kept, b));
}

#[test]
fn rotations_stay_rotations() {
    let mut g = Graph::new();
    let (x, c, s) = (g.symbol(), g.symbol(), g.symbol());
    let r = g.axis_rotation(2, x);
    let angle = g.angle(c, s);
    let map = HashMap::from([(g.symbol_id(x).unwrap(), angle)]);
    let made = Substitution::new(&g, &map).rotations(&mut g, &[r])[0];
    assert_eq!(made, g.axis_rotation(2, angle));
    assert_eq!(g.rotation_rows(made)[1], [s, c, Scalar::ZERO]);
}

/// Ten thousand nodes in a row, and a block in between.
#[test]
fn depth_and_blocks_are_no_matter() {
    let mut g = Graph::new();
    let (x, y) = (g.symbol(), g.symbol());
    let mut value = x;
    for _ in 0..5000 {
        let sum = g.add(value, y);
        value = g.mul(sum, x);
    }
    let solved = g.block_outputs(BlockKind::Solve { size: 1, symmetric: true, groups: [].into() }, &[y, value]);
    let map = HashMap::from([(g.symbol_id(x).unwrap(), Scalar::ONE)]);
    let made = g.substitute(&[solved[0]], &map);
    let symbols = |id: SymbolId| if id == SymbolId(1) { 0.5 } else { f64::NAN };
    // (5000 y + 1) / y
    assert_eq!(Evaluator::new(&g, Real { symbols: &symbols }).run(&made), [5002.0]);
}
