//! A graph in layers: where its vertices stand, and how its edges run.
//!
//! In: vertices with their sizes and layers, edges from a layer to a later one. Out: places (Sugiyama, Tagawa and Toda
//! 1981): an edge that passes layers gets a bend in each of them, vertices of a layer are ordered by the mean of their
//! neighbours' places, and each is moved to that mean as far as the order admits (least squares, pool adjacent violators).

/// A vertex, in a layer: its size along it and across.
#[derive(Clone, Copy)]
pub(super) struct Vertex {
    pub(super) along: f64,
    pub(super) across: f64,
    pub(super) layer: usize,
}

/// Centres of vertices and bends of edges: along the layers, then across them.
pub(super) struct Placed {
    pub(super) vertices: Vec<[f64; 2]>,
    pub(super) bends: Vec<Vec<[f64; 2]>>,
    pub(super) size: [f64; 2],
}

/// Between neighbours of a layer, and between layers.
#[derive(Clone, Copy)]
pub(super) struct Gaps {
    pub(super) along: f64,
    pub(super) across: f64,
}

/// Rounds of ordering, of moving, and of moving what holds nothing.
const ROUNDS: usize = 12;
const SETTLING: usize = 8;

/// An edge that pulls as much is to run straight, as those between two bends of one edge do.
pub(super) const STRAIGHT: f64 = 8.0;

/// What has settled pushes others aside.
const SETTLED: f64 = 1e6;

/// How wide an edge is where it passes a layer.
const BEND: f64 = 10.0;

/// How much an edge pulls its ends together.
#[derive(Clone, Copy)]
pub(super) struct Edge {
    pub(super) from: usize,
    pub(super) to: usize,
    pub(super) pull: f64,
}

/// By vertex: neighbours in the layer before and in the layer behind, with the pull of the edge.
type Neighbours = Vec<[Vec<(usize, f64)>; 2]>;

/// Where a vertex wants to be, given where all are, and how much it weighs.
type Wish<'a> = &'a dyn Fn(&[f64], usize) -> (f64, f64);

pub(super) fn place(vertices: &[Vertex], edges: &[Edge], gaps: Gaps) -> Placed {
    let mut all = vertices.to_vec();
    let mut neighbours: Neighbours = vec![Default::default(); all.len()];
    let mut bends: Vec<Vec<usize>> = Vec::new();
    for &Edge { from, to, pull } in edges {
        let (mut last, mut own): (usize, Vec<usize>) = (from, Vec::new());
        for layer in vertices[from].layer + 1..vertices[to].layer {
            all.push(Vertex { along: BEND, across: 0.0, layer });
            neighbours.push(Default::default());
            let bend = all.len() - 1;
            connect(&mut neighbours, last, bend, if own.is_empty() { pull } else { STRAIGHT });
            own.push(bend);
            last = bend;
        }
        connect(&mut neighbours, last, to, pull);
        bends.push(own);
    }
    let layers = ordered(&all, &neighbours);
    let along = moved(&all, vertices.len(), &neighbours, &layers, gaps.along);
    let thickness: Vec<f64> =
        layers.iter().map(|layer| layer.iter().fold(0.0, |most: f64, &v| most.max(all[v].across))).collect();
    let mut across = Vec::new();
    let mut at = 0.0;
    for thickness in &thickness {
        across.push(at + thickness / 2.0);
        at += thickness + gaps.across;
    }
    let point = |v: usize| [along[v], across[all[v].layer]];
    // An edge runs straight through a layer, beside what stands there.
    let through = |bend: usize| {
        let layer = all[bend].layer;
        [-0.5, 0.5].map(|side| [along[bend], across[layer] + side * thickness[layer]])
    };
    let length = (0..all.len()).map(|v| along[v] + all[v].along / 2.0).fold(0.0, f64::max);
    Placed {
        vertices: (0..vertices.len()).map(point).collect(),
        bends: bends.iter().map(|own| own.iter().flat_map(|&bend| through(bend)).collect()).collect(),
        size: [length, (at - gaps.across).max(0.0)],
    }
}

fn connect(neighbours: &mut Neighbours, before: usize, after: usize, pull: f64) {
    neighbours[before][1].push((after, pull));
    neighbours[after][0].push((before, pull));
}

/// Vertices of each layer in order.
fn ordered(all: &[Vertex], neighbours: &Neighbours) -> Vec<Vec<usize>> {
    let count = all.iter().map(|vertex| vertex.layer + 1).max().unwrap_or(0);
    let mut layers: Vec<Vec<usize>> = vec![Vec::new(); count];
    // As a walk from the roots meets them: a tree has no crossings then.
    let mut seen = vec![false; all.len()];
    for root in 0..all.len() {
        let mut stack = vec![root];
        while let Some(v) = stack.pop() {
            if std::mem::replace(&mut seen[v], true) {
                continue;
            }
            layers[all[v].layer].push(v);
            stack.extend(neighbours[v][1].iter().rev().map(|near| near.0));
        }
    }
    let mut best = (crossings(&layers, neighbours), layers.clone());
    for round in 0..ROUNDS {
        let side = round % 2;
        let order: Vec<usize> =
            if side == 0 { (1..count).collect() } else { (0..count.saturating_sub(1)).rev().collect() };
        for layer in order {
            let rank = ranks(&layers, all.len());
            let mean = |v: usize| {
                let near = &neighbours[v][side];
                let sum: f64 = near.iter().map(|&(n, _)| rank[n]).sum();
                if near.is_empty() { rank[v] } else { sum / near.len() as f64 }
            };
            let mut keyed: Vec<(f64, usize)> = layers[layer].iter().map(|&v| (mean(v), v)).collect();
            keyed.sort_by(|a, b| a.0.total_cmp(&b.0));
            layers[layer] = keyed.into_iter().map(|(_, v)| v).collect();
        }
        let found = crossings(&layers, neighbours);
        if found < best.0 {
            best = (found, layers.clone());
        }
    }
    best.1
}

/// Places within layers, from zero to one.
fn ranks(layers: &[Vec<usize>], count: usize) -> Vec<f64> {
    let mut rank = vec![0.0; count];
    for layer in layers {
        for (k, &v) in layer.iter().enumerate() {
            rank[v] = (k as f64 + 0.5) / layer.len() as f64;
        }
    }
    rank
}

fn crossings(layers: &[Vec<usize>], neighbours: &Neighbours) -> usize {
    let mut place = vec![0; neighbours.len()];
    layers.iter().for_each(|layer| layer.iter().enumerate().for_each(|(k, &v)| place[v] = k));
    let mut count = 0;
    for layer in layers {
        let edges: Vec<(usize, usize)> =
            layer.iter().flat_map(|&v| neighbours[v][1].iter().map(move |&(to, _)| (v, to))).collect();
        for (number, &(a, b)) in edges.iter().enumerate() {
            for &(c, d) in &edges[number + 1..] {
                count += usize::from(
                    place[a] != place[c] && place[b] != place[d] && (place[a] < place[c]) != (place[b] < place[d]),
                );
            }
        }
    }
    count
}

/// Centres along the layers; the first so many vertices are no bends.
fn moved(all: &[Vertex], real: usize, neighbours: &Neighbours, layers: &[Vec<usize>], gap: f64) -> Vec<f64> {
    let mut at = vec![0.0; all.len()];
    for layer in layers {
        let mut end = 0.0;
        for &v in layer {
            at[v] = end + all[v].along / 2.0;
            end += all[v].along + gap;
        }
    }
    let mean = |at: &[f64], near: &mut dyn Iterator<Item = &(usize, f64)>| {
        let (sum, pull) = near.fold((0.0, 0.0), |(sum, all), &(n, pull)| (sum + pull * at[n], all + pull));
        (pull > 0.0).then(|| sum / pull)
    };
    let mut move_layer = |layer: &[usize], wish: Wish<'_>| {
        let wanted: Vec<(f64, f64)> = layer.iter().map(|&v| wish(&at, v)).collect();
        let sizes: Vec<f64> = layer.iter().map(|&v| all[v].along).collect();
        layer.iter().zip(apart(&wanted, &sizes, gap)).for_each(|(&v, x)| at[v] = x);
    };
    for _ in 0..ROUNDS {
        let towards =
            |side: usize| move |at: &[f64], v: usize| (mean(at, &mut neighbours[v][side].iter()).unwrap_or(at[v]), 1.0);
        layers.iter().for_each(|layer| move_layer(layer, &towards(0)));
        layers.iter().rev().for_each(|layer| move_layer(layer, &towards(1)));
    }
    // What carries others stands in their middle; what hangs between others, and bends, find their places about it.
    let is_firm = |v: usize| v < real && neighbours[v].iter().flatten().any(|&(n, pull)| pull >= STRAIGHT && n < real);
    layers
        .iter()
        .for_each(|layer| move_layer(layer, &|at, v| (mean(at, &mut neighbours[v][0].iter()).unwrap_or(at[v]), 1.0)));
    let carried = |at: &[f64], v: usize| {
        let mut firm = neighbours[v][1].iter().filter(|&&(n, pull)| pull >= STRAIGHT && n < real);
        (mean(at, &mut firm).unwrap_or(at[v]), 1.0)
    };
    layers.iter().rev().for_each(|layer| move_layer(layer, &carried));
    let loose = |at: &[f64], v: usize| match is_firm(v) {
        true => (at[v], SETTLED),
        false => (mean(at, &mut neighbours[v].iter().flatten()).unwrap_or(at[v]), 1.0),
    };
    for _ in 0..SETTLING {
        layers.iter().for_each(|layer| move_layer(layer, &loose));
    }
    let least = (0..all.len()).map(|v| at[v] - all[v].along / 2.0).fold(f64::INFINITY, f64::min);
    at.iter().map(|x| x - least).collect()
}

/// The places nearest to those that are wanted, each with its weight, in this order and without overlaps.
fn apart(wanted: &[(f64, f64)], sizes: &[f64], gap: f64) -> Vec<f64> {
    let mut offset = 0.0;
    let mut offsets = Vec::new();
    for (k, size) in sizes.iter().enumerate() {
        if k > 0 {
            offset += (sizes[k - 1] + size) / 2.0 + gap;
        }
        offsets.push(offset);
    }
    // Pools of neighbours that would overlap: their mean, their weight and how many they are.
    let mut pools: Vec<(f64, f64, usize)> = Vec::new();
    for (&(x, weight), offset) in wanted.iter().zip(&offsets) {
        pools.push((x - offset, weight, 1));
        while let [.., (a, u, m), (b, v, n)] = pools[..]
            && a > b
        {
            pools.truncate(pools.len() - 2);
            pools.push(((a * u + b * v) / (u + v), u + v, m + n));
        }
    }
    let means = pools.iter().flat_map(|&(mean, _, count)| std::iter::repeat_n(mean, count));
    means.zip(&offsets).map(|(mean, offset)| mean + offset).collect()
}

#[cfg(test)]
mod tests {
    use super::{Edge, Gaps, Neighbours, Vertex, apart, connect, crossings, ordered, place};

    const GAPS: Gaps = Gaps { along: 4.0, across: 20.0 };

    fn vertices(layers: &[usize]) -> Vec<Vertex> {
        layers.iter().map(|&layer| Vertex { along: 30.0, across: 10.0, layer }).collect()
    }

    fn edges(list: &[(usize, usize)]) -> Vec<Edge> {
        list.iter().map(|&(from, to)| Edge { from, to, pull: 1.0 }).collect()
    }

    #[test]
    fn neighbours_do_not_overlap_and_stand_near() {
        assert_eq!(apart(&[(0.0, 1.0), (0.0, 1.0), (100.0, 1.0)], &[10.0, 10.0, 10.0], 2.0), [-6.0, 6.0, 100.0]);
        // One that weighs three times as much moves a third.
        assert_eq!(apart(&[(0.0, 3.0), (0.0, 1.0)], &[10.0, 10.0], 2.0), [-3.0, 9.0]);
        // Two children stand about their parent.
        let placed = place(&vertices(&[0, 1, 1]), &edges(&[(0, 1), (0, 2)]), GAPS);
        let [parent, a, b] = placed.vertices[..] else { panic!() };
        assert!((parent[0] - (a[0] + b[0]) / 2.0).abs() < 1e-9 && (b[0] - a[0] - 34.0).abs() < 1e-9);
        assert_eq!((parent[1], a[1]), (5.0, 35.0));
        assert_eq!(placed.size, [64.0, 40.0]);
    }

    #[test]
    fn crossings_are_taken_apart() {
        // 0 and 1 over 2 and 3, crosswise.
        let all = vertices(&[0, 0, 1, 1]);
        let mut neighbours: Neighbours = vec![Default::default(); 4];
        connect(&mut neighbours, 0, 3, 1.0);
        connect(&mut neighbours, 1, 2, 1.0);
        let layers = ordered(&all, &neighbours);
        assert_eq!(crossings(&layers, &neighbours), 0);
        assert_eq!(crossings(&[vec![0, 1], vec![2, 3]], &neighbours), 1);
    }

    #[test]
    fn long_edges_bend_in_each_layer() {
        let placed = place(&vertices(&[0, 1, 2, 3]), &edges(&[(0, 1), (1, 2), (2, 3), (0, 3)]), GAPS);
        assert_eq!(placed.bends.iter().map(Vec::len).collect::<Vec<usize>>(), [0, 0, 0, 4]);
        // A bend passes beside the vertex of its layer.
        assert!((placed.bends[3][0][0] - placed.vertices[1][0]).abs() >= 15.0);
    }
}
