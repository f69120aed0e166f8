//! What a machine that consists of equal loops costs, by how many there are.

use multibody_engine::contracts::function::FunctionKind;
use multibody_engine::mechanics;
use multibody_engine::optimize::{self, effort::Effort};

use super::support::model_of;

/// Crank-rockers side by side on the ground.
fn four_bars(count: usize) -> String {
    let one = |k: usize| {
        let (from, to) = (5 * k, 5 * k + 4);
        format!(
            "body crank_{k} {{ mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }}
             body coupler_{k} {{ mass: 3.5, com: 1.75 * X, inertia: rod(3.5, 3.5, X) }}
             body rocker_{k} {{ mass: 3.0, com: 1.5 * X, inertia: rod(3.0, 3.0, X) }}
             joint shaft_{k}: Revolute {{ parent: ground.at({from} * X), child: crank_{k}, axis: Z }}
             joint knee_{k}: Revolute {{ parent: crank_{k}.at(X), child: coupler_{k}, axis: Z }}
             joint pivot_{k}: Revolute {{ parent: ground.at({to} * X), child: rocker_{k}, axis: Z }}
             #[cut] joint pin_{k}: Revolute {{ parent: coupler_{k}.at(3.5 * X), child: rocker_{k}.at(3 * X), axis: Z }} "
        )
    };
    let all: String = (0..count).map(one).collect();
    format!("world {{ gravity: -9.81 * Y }} formulation {{ constraints: Multipliers }} {all} emit forward_dynamics;")
}

/// Operations of forward dynamics as they are compiled, and its work.
fn count(text: &str) -> [f64; 2] {
    let model = model_of(text);
    let (structure, derivation) = mechanics::of(&model).unwrap_or_else(|c| panic!("{}", c[0].message));
    assert_eq!(structure.rows.len() * 3, structure.freedoms() * 2, "two equations for three angles");
    let compiled = optimize::compile(&derivation).expect("it is small enough");
    let forward = compiled.functions.iter().find(|function| function.kind == FunctionKind::ForwardDynamics).unwrap();
    let cost = forward.after;
    [
        f64::from(cost.add + cost.mul + cost.div + cost.sqrt + cost.sincos + cost.other),
        f64::from(Effort::of(forward).work()),
    ]
}

/// Loops that nothing couples are systems of their own, however many: beyond 32 coordinates too, where there are fewer ways.
#[test]
fn loops_side_by_side_grow_with_their_number() {
    let sizes = [5, 10, 20, 40];
    let counts = sizes.map(|size| count(&four_bars(size)));
    for (sizes, counts) in sizes.windows(2).zip(counts.windows(2)) {
        for kind in 0..2 {
            let growth = (counts[1][kind] / counts[0][kind]).ln() / (sizes[1] as f64 / sizes[0] as f64).ln();
            println!("{sizes:?}: {:?} to {:?}, power {growth:.3}", counts[0], counts[1]);
            assert!(growth <= 1.05, "{sizes:?} {counts:?}: power {growth:.3}");
        }
    }
}
