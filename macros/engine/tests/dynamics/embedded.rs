//! Random trees, some of whose coordinates move with others: articulated bodies with these embedded, against the projected equations of a plain
//! implementation.

use crate::on_graph::{derive, point};
use crate::plain;
use crate::random::{Mechanism, State};
use crate::rng::Rng;
use multibody_engine::dynamics::embedded::{self, Causes, Embedding};
use multibody_engine::dynamics::floating_bases::floating_bases;
use multibody_engine::dynamics::kinematics::motions;
use multibody_engine::dynamics::newton_euler::{Wrench, efforts, transmitted};
use multibody_engine::dynamics::regroup::regroup_but;
use multibody_engine::dynamics::shared_axes::{SharedAxes, share_axes};
use multibody_engine::symbolic::evaluate::{Evaluator, Real};
use multibody_engine::symbolic::graph::{Graph, Scalar, SymbolId, Vector};

/// How coordinates accelerate: with coordinates of the state, and beside them.
struct Motions {
    slopes: Vec<Vec<(usize, f64)>>,
    still: Vec<f64>,
}

impl Motions {
    /// A third of all follow up to three others, some nothing at all.
    fn random(rng: &mut Rng, freedoms: usize) -> Motions {
        let follows: Vec<bool> = (0..freedoms).map(|k| k > 0 && rng.chance(35)).collect();
        let state: Vec<usize> = (0..freedoms).filter(|&k| !follows[k]).collect();
        let (mut slopes, mut still) = (Vec::new(), Vec::new());
        for (k, &follows) in follows.iter().enumerate() {
            if !follows {
                slopes.push(vec![(k, 1.0)]);
                still.push(0.0);
                continue;
            }
            // A loop's coordinates stand near each other.
            let near: Vec<usize> =
                state.iter().copied().filter(|other| k.abs_diff(*other) < 4 || rng.chance(5)).collect();
            let mut own: Vec<(usize, f64)> = Vec::new();
            for _ in 0..rng.below(4) {
                let Some(&other) = near.get(rng.below(near.len().max(1))) else { continue };
                if own.iter().all(|one| one.0 != other) {
                    own.push((other, rng.real(-2.0, 2.0)));
                }
            }
            slopes.push(own);
            still.push(rng.real(-3.0, 3.0));
        }
        Motions { slopes, still }
    }

    fn slope(&self, of: usize, by: usize) -> f64 {
        self.slopes[of].iter().find(|one| one.0 == by).map_or(0.0, |one| one.1)
    }

    /// Accelerations of all coordinates by S^T M S u' = S^T (tau - bias - M still), where tau are efforts that take the place of loads too.
    fn plainly(&self, mechanism: &Mechanism, state: &State, efforts: &[f64]) -> Vec<f64> {
        let n = self.still.len();
        let own: Vec<usize> = (0..n).filter(|&k| self.slopes[k] == [(k, 1.0)]).collect();
        let mass = plain::mass_matrix(mechanism, &state.q);
        let needed = plain::inverse_dynamics(mechanism, &state.q, &state.v, &self.still, mechanism.gravity);
        let sum = |f: &dyn Fn(usize) -> f64| (0..n).map(f).sum::<f64>();
        let reduced: Vec<Vec<f64>> = own
            .iter()
            .map(|&i| {
                let entry = |&j: &usize| sum(&|a| sum(&|b| self.slope(a, i) * mass[a][b] * self.slope(b, j)));
                own.iter().map(entry).collect()
            })
            .collect();
        let right = own.iter().map(|&i| sum(&|a| self.slope(a, i) * (efforts[a] - needed[a]))).collect();
        let found = plain::solve(reduced, right);
        (0..n)
            .map(|k| self.still[k] + own.iter().zip(&found).map(|(&j, x)| self.slope(k, j) * x).sum::<f64>())
            .collect()
    }

    fn embedded(
        &self,
        mechanism: &Mechanism,
        state: &State,
        loads: &[[f64; 6]],
        way: &Way,
    ) -> Option<(Vec<f64>, bool)> {
        let mut m = derive(mechanism);
        let bases = floating_bases(&m.tree);
        let applied = wrenches(&mut m.graph, loads);
        if *way != Way::Plain {
            let keep: Vec<usize> = bases.iter().map(|floating_base| floating_base.link).collect();
            m.tree = regroup_but(&mut m.graph, &m.tree, false, &keep);
        }
        let applied = match *way {
            Way::InAxes(axes) => {
                let shared = share_axes(&mut m.graph, &m.tree, axes)?;
                m.tree = shared.tree.clone();
                shared.turn(&mut m.graph, &applied)
            }
            Way::Plain | Way::Regrouped => applied,
        };
        let g = &mut m.graph;
        let base = m.tree.gravity.map_or(Vector::ZERO, |gravity| g.vector(gravity.map(|component| -component)));
        let causes = Causes { velocity: &m.tree.velocity, base, applied: &applied, efforts: &m.efforts };
        let slopes = self.slopes.iter().map(|list| {
            list.iter().map(|&(k, slope)| (k, if slope == 1.0 { Scalar::ONE } else { g.decimal(slope) })).collect()
        });
        let slopes = slopes.collect();
        let still =
            self.still.iter().map(|&still| if still == 0.0 { Scalar::ZERO } else { g.decimal(still) }).collect();
        let embedding = Embedding { still, slopes };
        let roots = embedded::forward_dynamics(g, &m.tree, &bases, &causes, &embedding);
        let values = point(state);
        let symbols = |id: SymbolId| values[id.0];
        Some((Evaluator::new(&m.graph, Real { symbols: &symbols }).run(&roots), embedding.is_local(&m.tree)))
    }
}

/// How the tree is written.
#[derive(PartialEq)]
enum Way {
    Plain,
    Regrouped,
    InAxes(SharedAxes),
}

fn wrenches(g: &mut Graph, loads: &[[f64; 6]]) -> Vec<Wrench> {
    let of = |load: &[f64; 6]| {
        let [a, b, c, x, y, z] = load.map(|x| if x == 0.0 { Scalar::ZERO } else { g.decimal(x) });
        Wrench { moment: g.vector([a, b, c]), force: g.vector([x, y, z]) }
    };
    loads.iter().map(of).collect()
}

/// Efforts that do what loads on the links do: what holds them where nothing moves, with its sign turned.
fn efforts_of(mechanism: &Mechanism, state: &State, loads: &[[f64; 6]]) -> Vec<f64> {
    let mut m = derive(mechanism);
    let applied = wrenches(&mut m.graph, loads);
    let zero = vec![Scalar::ZERO; m.tree.freedoms()];
    let g = &mut m.graph;
    let still = motions(g, &m.tree, &zero, &zero, Vector::ZERO);
    let transmitted = transmitted(g, &m.tree, &still, &applied);
    let roots = efforts(g, &m.tree, &transmitted, &zero);
    let values = point(state);
    let symbols = |id: SymbolId| values[id.0];
    let held = Evaluator::new(&m.graph, Real { symbols: &symbols }).run(&roots);
    state.effort.iter().zip(held).map(|(effort, held)| effort - held).collect()
}

#[test]
fn followers_agree_with_projected_equations() {
    let (mut local, mut in_axes) = (0, 0);
    for seed in 0..160 {
        let mut rng = Rng::new(0xE4B + seed);
        let bodies = 2 + rng.below(9);
        let mut mechanism = Mechanism::tree(&mut rng, bodies);
        if rng.chance(30) {
            mechanism.float(&mut rng);
        }
        let state = mechanism.state(&mut rng);
        let motions = Motions::random(&mut rng, mechanism.freedoms());
        // Carriers of what floats among them.
        let loads: Vec<[f64; 6]> = (0..derive(&mechanism).tree.links.len())
            .map(|_| if rng.chance(40) { [(); 6].map(|()| rng.real(-2.0, 2.0)) } else { [0.0; 6] })
            .collect();
        let want = motions.plainly(&mechanism, &state, &efforts_of(&mechanism, &state, &loads));
        let largest = want.iter().fold(1e-3_f64, |most, x| most.max(x.abs()));
        for way in [Way::Plain, Way::Regrouped, Way::InAxes(SharedAxes::Base), Way::InAxes(SharedAxes::Tip)] {
            let Some((got, is_local)) = motions.embedded(&mechanism, &state, &loads, &way) else { continue };
            local += usize::from(is_local);
            in_axes += usize::from(is_local && matches!(way, Way::InAxes(_)));
            assert_eq!(got.len(), want.len());
            for (k, (a, b)) in got.iter().zip(&want).enumerate() {
                assert!((a - b).abs() <= 1e-9 * largest, "{seed}, {k}: {a} for {b}");
            }
        }
    }
    assert!(local > 100 && in_axes > 20, "{local} {in_axes}");
}
