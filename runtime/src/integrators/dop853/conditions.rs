//! The conditions of order (Hairer, Norsett and Wanner, section II.2), tree by tree: for a method of order p every rooted
//! tree with up to p nodes has the elementary weight 1/gamma, and c^r/gamma at the share c of dense output.

use super::tableau as tab;

/// A rooted tree: its number of nodes, its density gamma, and its subtrees by their numbers in the list.
struct Tree {
    nodes: usize,
    density: f64,
    branches: Vec<usize>,
}

/// All rooted trees with up to `nodes` nodes, small ones first.
fn trees(nodes: usize) -> Vec<Tree> {
    /// All ways to spend `left` nodes on trees whose numbers do not rise.
    fn forests(list: &[Tree], left: usize, highest: usize, chosen: &mut Vec<usize>, found: &mut Vec<Vec<usize>>) {
        if left == 0 {
            found.push(chosen.clone());
        }
        for number in (0..highest.min(list.len())).rev() {
            if list[number].nodes <= left {
                chosen.push(number);
                forests(list, left - list[number].nodes, number + 1, chosen, found);
                chosen.pop();
            }
        }
    }
    let mut list: Vec<Tree> = Vec::new();
    for size in 1..=nodes {
        let mut found = Vec::new();
        forests(&list, size - 1, usize::MAX, &mut Vec::new(), &mut found);
        for branches in found {
            let density = branches.iter().fold(size as f64, |product, &branch| product * list[branch].density);
            list.push(Tree { nodes: size, density, branches });
        }
    }
    list
}

/// The full matrix of the sixteen stages, from rows and the numbers of the stages they weigh.
fn matrix() -> [[f64; 16]; 16] {
    let rows: [(&[f64], &[usize]); 15] = [
        (&tab::A2, &[1]),
        (&tab::A3, &[1, 2]),
        (&tab::A4, &[1, 3]),
        (&tab::A5, &[1, 3, 4]),
        (&tab::A6, &[1, 4, 5]),
        (&tab::A7, &[1, 4, 5, 6]),
        (&tab::A8, &[1, 4, 5, 6, 7]),
        (&tab::A9, &[1, 4, 5, 6, 7, 8]),
        (&tab::A10, &[1, 4, 5, 6, 7, 8, 9]),
        (&tab::A11, &[1, 4, 5, 6, 7, 8, 9, 10]),
        (&tab::A12, &[1, 4, 5, 6, 7, 8, 9, 10, 11]),
        (&tab::B, &WEIGHED),
        (&tab::A14, &[1, 7, 8, 9, 10, 11, 12, 13]),
        (&tab::A15, &[1, 6, 7, 8, 11, 12, 13, 14]),
        (&tab::A16, &[1, 6, 7, 8, 9, 13, 14, 15]),
    ];
    let mut full = [[0.0; 16]; 16];
    for (i, (weights, stages)) in rows.into_iter().enumerate() {
        full[i + 1] = spread(weights, stages);
    }
    full
}

const WEIGHED: [usize; 8] = [1, 6, 7, 8, 9, 10, 11, 12];

/// Weights in the places of their stages.
fn spread(weights: &[f64], stages: &[usize]) -> [f64; 16] {
    assert_eq!(weights.len(), stages.len());
    let mut full = [0.0; 16];
    for (weight, stage) in weights.iter().zip(stages) {
        full[stage - 1] = *weight;
    }
    full
}

/// For every tree the product over its branches, at each stage.
fn products(list: &[Tree]) -> Vec<[f64; 16]> {
    let a = matrix();
    let mut all: Vec<[f64; 16]> = Vec::new();
    for tree in list {
        let mut product = [1.0; 16];
        for &branch in &tree.branches {
            for (entry, row) in product.iter_mut().zip(&a) {
                *entry *= dot(row, &all[branch]);
            }
        }
        all.push(product);
    }
    all
}

fn dot(a: &[f64; 16], b: &[f64; 16]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// The greatest gap in the conditions of trees with `nodes` nodes, at the share `c`.
fn gap(weights: &[f64; 16], nodes: usize, c: f64) -> f64 {
    let list = trees(nodes);
    let products = products(&list);
    let pairs = list.iter().zip(&products).filter(|(tree, _)| tree.nodes == nodes);
    pairs.map(|(tree, p)| (dot(weights, p) - c.powi(nodes as i32) / tree.density).abs()).fold(0.0, f64::max)
}

#[test]
fn nodes_are_sums_of_rows() {
    let nodes = [&tab::C[..], &[1.0], &tab::C_DENSE].concat();
    for (row, node) in matrix()[1..].iter().zip(nodes) {
        assert!((row.iter().sum::<f64>() - node).abs() < 2e-14, "{node}");
    }
}

#[test]
fn the_step_is_of_order_eight() {
    let counts: Vec<usize> = (1..=9).map(|n| trees(9).iter().filter(|tree| tree.nodes == n).count()).collect();
    assert_eq!(counts, [1, 1, 2, 4, 9, 20, 48, 115, 286]);
    let weights = spread(&tab::B, &WEIGHED);
    for nodes in 1..=8 {
        assert!(gap(&weights, nodes, 1.0) < 1e-14, "{nodes}: {:e}", gap(&weights, nodes, 1.0));
    }
    println!("gap at nine nodes: {:e}", gap(&weights, 9, 1.0));
    assert!(gap(&weights, 9, 1.0) > 1e-7);
}

#[test]
fn the_estimates_are_of_orders_five_and_three() {
    let weights = spread(&tab::B, &WEIGHED);
    let fifth: [f64; 16] = core::array::from_fn(|i| weights[i] - spread(&tab::E5, &WEIGHED)[i]);
    let third = spread(&tab::E3, &[1, 9, 12]);
    for (weights, order) in [(fifth, 5), (third, 3)] {
        for nodes in 1..=order {
            assert!(gap(&weights, nodes, 1.0) < 1e-14, "{nodes}: {:e}", gap(&weights, nodes, 1.0));
        }
        let next = gap(&weights, order + 1, 1.0);
        assert!(next > 1e-5, "{order}: {next:e}");
    }
}

/// The weights of the stages at a share, of the polynomial that `dense` hands to `Dense`.
fn weights_within(c: f64) -> [f64; 16] {
    let at = |stage: usize| spread(&[1.0], &[stage]);
    let weights = spread(&tab::B, &WEIGHED);
    let last = [&[1][..], &[6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16]].concat();
    let rise: [f64; 16] = core::array::from_fn(|i| at(1)[i] - weights[i]);
    let fall: [f64; 16] = core::array::from_fn(|i| weights[i] - at(13)[i] - rise[i]);
    let [d4, d5, d6, d7] = [tab::D4, tab::D5, tab::D6, tab::D7].map(|weights| spread(&weights, &last));
    let mut sum = [0.0; 16];
    for (k, term) in [weights, rise, fall, d4, d5, d6, d7].iter().enumerate().rev() {
        for (sum, term) in sum.iter_mut().zip(term) {
            *sum = (*sum + term) * if k % 2 == 0 { c } else { 1.0 - c };
        }
    }
    sum
}

#[test]
fn dense_output_is_of_order_seven() {
    for c in [0.1, 0.3, 0.5, 0.77, 1.0] {
        let weights = weights_within(c);
        for nodes in 1..=7 {
            // Weights of up to 500 cancel.
            assert!(gap(&weights, nodes, c) < 1e-13, "{nodes} at {c}: {:e}", gap(&weights, nodes, c));
        }
    }
    assert!(gap(&weights_within(0.5), 8, 0.5) > 1e-7);
}
