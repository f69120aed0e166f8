//! Efforts over groups of links against the recursion link by link, with forces from outside in the axes of links and of the
//! world.

use multibody_engine::dynamics::kinematics;
use multibody_engine::dynamics::lumped;
use multibody_engine::dynamics::newton_euler::{Wrench, efforts, transmitted};
use multibody_engine::dynamics::shared_axes::{Shared, SharedAxes, share_axes};
use multibody_engine::symbolic::evaluate::{Evaluator, Real};
use multibody_engine::symbolic::graph::{Graph, Rotation, Scalar, SymbolId, Vector};

use crate::on_graph::{derive, point};
use crate::random::{Kind, Mechanism, State};
use crate::rng::Rng;

/// A tree with slides that stand in their parents' axes, wheels that are round about their hinges, and hinges that meet.
fn mechanism(rng: &mut Rng) -> Mechanism {
    let bodies = 2 + rng.below(5);
    let mut mechanism = Mechanism::tree(rng, bodies);
    for body in &mut mechanism.bodies {
        if rng.chance(60) {
            body.placement = [1, 0, 0, 0];
        }
        if rng.chance(40) {
            body.offset = [0.0; 3];
        }
        if let Kind::Revolute(axis) = body.kind
            && rng.chance(60)
        {
            let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
            (body.com[j], body.com[k]) = (0.0, 0.0);
            body.tensor[k] = body.tensor[j];
            body.tensor[3..].fill(0.0);
        }
    }
    mechanism
}

fn wrench(g: &mut Graph, [a, b, c, x, y, z]: [f64; 6]) -> Wrench {
    let [moment, force] = [[a, b, c], [x, y, z]].map(|list| {
        let list = list.map(|component| g.decimal(component));
        g.vector(list)
    });
    Wrench { moment, force }
}

/// The forces on a link in its own axes, and on the same or another one in those of the world.
struct Forces {
    own: (usize, [f64; 6]),
    world: (usize, [f64; 6]),
}

fn evaluate(mechanism: &Mechanism, state: &State, forces: &Forces, over_groups: bool) -> Vec<f64> {
    let mut m = derive(mechanism);
    let (g, tree) = (&mut m.graph, &m.tree);
    let base = tree.gravity.map_or(Vector::ZERO, |gravity| g.vector(gravity.map(|component| -component)));
    let mut applied = vec![Wrench::ZERO; tree.links.len()];
    applied[forces.own.0] = wrench(g, forces.own.1);
    let (link, outside) = (forces.world.0, wrench(g, forces.world.1));
    let roots: Vec<Scalar> = if over_groups {
        lumped::efforts(g, tree, &tree.acceleration, base, &applied, &[(link, outside)])
    } else {
        let Wrench { mut moment, mut force } = outside;
        for index in tree.path(None, Some(link)) {
            [moment, force] = [moment, force].map(|v| tree.to_link(g, &tree.links[index], v));
        }
        applied[link] = applied[link].add(g, &Wrench { moment, force });
        let motions = kinematics::motions(g, tree, &tree.velocity, &tree.acceleration, base);
        let wrenches = transmitted(g, tree, &motions, &applied);
        efforts(g, tree, &wrenches, &tree.acceleration)
    };
    let values = point(state);
    Evaluator::new(&m.graph, Real { symbols: &|id: SymbolId| values[id.0] }).run(&roots)
}

#[test]
fn groups_need_what_links_need() {
    let mut other = 0;
    for seed in 0..150 {
        let mut rng = Rng::new(seed);
        let mechanism = mechanism(&mut rng);
        let state = mechanism.state(&mut rng);
        let mut any = || (rng.below(mechanism.bodies.len()), [(); 6].map(|()| rng.decimal(-3.0, 3.0)));
        let forces = Forces { own: any(), world: any() };
        let [one, two] = [true, false].map(|over_groups| evaluate(&mechanism, &state, &forces, over_groups));
        let largest = two.iter().fold(1.0_f64, |most, x| most.max(x.abs()));
        for (a, b) in one.iter().zip(&two) {
            assert!((a - b).abs() < 1e-10 * largest, "{seed}: {one:?} for {two:?} of {mechanism:?}");
        }
        other += usize::from(lumped::differs(&derive(&mechanism).tree));
    }
    assert!(other > 75, "{other} have groups");
}

/// Efforts against a force on a link in its axes, the tree in axes of its own or in others, and how many of its links don't turn there.
fn efforts_in(
    mechanism: &Mechanism,
    state: &State,
    (link, force): (usize, [f64; 6]),
    axes: Option<Option<SharedAxes>>,
) -> Option<(Vec<f64>, usize)> {
    let mut m = derive(mechanism);
    let g = &mut m.graph;
    let mut applied = vec![Wrench::ZERO; m.tree.links.len()];
    applied[link] = wrench(g, force);
    let mut still = 0;
    if let Some(axes) = axes {
        let shared = match axes {
            Some(axes) => share_axes(g, &m.tree, axes)?,
            None => Shared::own(g, &m.tree),
        };
        applied = shared.turn(g, &applied);
        still = shared.turns.iter().filter(|&&turn| turn != Rotation::IDENTITY).count();
        m.tree = shared.tree;
    }
    let tree = &m.tree;
    let base = tree.gravity.map_or(Vector::ZERO, |gravity| g.vector(gravity.map(|component| -component)));
    let motions = kinematics::motions(g, tree, &tree.velocity, &tree.acceleration, base);
    let wrenches = transmitted(g, tree, &motions, &applied);
    let roots = efforts(g, tree, &wrenches, &tree.acceleration);
    let values = point(state);
    Some((Evaluator::new(&m.graph, Real { symbols: &|id: SymbolId| values[id.0] }).run(&roots), still))
}

#[test]
fn wheels_are_written_in_axes_that_do_not_spin() {
    let (mut still, mut joined) = (0, 0);
    for seed in 0..150 {
        let mut rng = Rng::new(seed);
        let mechanism = mechanism(&mut rng);
        let state = mechanism.state(&mut rng);
        let force = (rng.below(mechanism.bodies.len()), [(); 6].map(|()| rng.decimal(-3.0, 3.0)));
        let (want, _) = efforts_in(&mechanism, &state, force, None).expect("is there");
        let largest = want.iter().fold(1.0_f64, |most, x| most.max(x.abs()));
        for axes in [None, Some(SharedAxes::Base), Some(SharedAxes::Tip)] {
            let Some((got, count)) = efforts_in(&mechanism, &state, force, Some(axes)) else { continue };
            for (a, b) in got.iter().zip(&want) {
                assert!((a - b).abs() < 1e-10 * largest, "{seed}: {got:?} for {want:?} of {mechanism:?}");
            }
            still += usize::from(axes.is_none() && count > 0);
            joined += usize::from(axes.is_some());
        }
    }
    assert!(still > 50 && joined > 20, "{still} have wheels, {joined} are in common axes");
}
