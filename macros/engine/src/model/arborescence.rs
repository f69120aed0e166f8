//! Stage `model`: the cheapest directed spanning tree.
//!
//! In: directed edges with weights. Out: per node the edge that leads to it (Chu and Liu 1965, Edmonds 1967): every node
//! takes its cheapest edge, and a cycle of such edges becomes one node, entered where that costs least.

use crate::invariant::fault::OrFault;

/// From one node to another.
#[derive(Clone, Copy)]
pub(super) struct Edge {
    pub(super) from: usize,
    pub(super) to: usize,
    pub(super) weight: i128,
}

const NONE: usize = usize::MAX;

/// Cycles within cycles, up to here: no mechanism has so many, and stack and time stay bounded.
const DEEPEST: usize = 200;

/// Per node the position of its edge in `edges`, nothing for the root; `None` if a node can't be reached, or that would
/// take too long.
pub(super) fn cheapest(nodes: usize, root: usize, edges: &[Edge]) -> Option<Vec<Option<usize>>> {
    contracted(nodes, root, edges, DEEPEST)
}

fn contracted(nodes: usize, root: usize, edges: &[Edge], depth: usize) -> Option<Vec<Option<usize>>> {
    let mut best: Vec<Option<usize>> = vec![None; nodes];
    let weight = |index: usize| edges[index].weight;
    for (index, edge) in edges.iter().enumerate() {
        if edge.to == root || edge.from == edge.to {
            continue;
        }
        let slot = &mut best[edge.to];
        if slot.is_none_or(|old| edge.weight < weight(old)) {
            *slot = Some(index);
        }
    }
    if best.iter().enumerate().any(|(node, edge)| node != root && edge.is_none()) {
        return None;
    }
    let (groups, in_cycle) = cycles(&best, edges);
    let count = groups.iter().copied().max().map_or(0, |last| last + 1);
    if count == nodes {
        return Some(best);
    }
    let mut origins = Vec::new();
    let mut inner = Vec::new();
    for (index, edge) in edges.iter().enumerate() {
        let (from, to) = (groups[edge.from], groups[edge.to]);
        if from == to {
            continue;
        }
        // Entering a cycle here saves the edge that led here within it.
        let saved = best[edge.to].filter(|_| in_cycle[edge.to]).map_or(0, weight);
        origins.push(index);
        inner.push(Edge { from, to, weight: edge.weight - saved });
    }
    let chosen = contracted(count, groups[root], &inner, depth.checked_sub(1)?)?;
    for position in chosen.into_iter().flatten() {
        let index: usize = origins[position];
        best[edges[index].to] = Some(index);
    }
    Some(best)
}

/// Numbers the nodes so that those of a cycle have one number, and says which lie in a cycle.
fn cycles(best: &[Option<usize>], edges: &[Edge]) -> (Vec<usize>, Vec<bool>) {
    let before = |node: usize| best[node].map(|index| edges[index].from);
    let mut groups = vec![NONE; best.len()];
    let mut in_cycle = vec![false; best.len()];
    let mut walks = vec![NONE; best.len()];
    for start in 0..best.len() {
        let mut at = Some(start);
        while let Some(node) = at {
            if walks[node] != NONE {
                break;
            }
            walks[node] = start;
            at = before(node);
        }
        // Met again on the same walk, it closes a cycle.
        let Some(first) = at.filter(|node| walks[*node] == start && !in_cycle[*node]) else { continue };
        let mut node = first;
        while !in_cycle[node] {
            in_cycle[node] = true;
            groups[node] = first;
            node = before(node).or_fault("each node of a cycle has one before it");
        }
    }
    // First the cycles are named by one of their nodes; now all are numbered.
    let mut numbers = vec![NONE; best.len()];
    let mut count = 0;
    for (node, group) in groups.iter_mut().enumerate() {
        // What lies in no cycle is a group of its own.
        let name = if *group == NONE { node } else { *group };
        if numbers[name] == NONE {
            numbers[name] = count;
            count += 1;
        }
        *group = numbers[name];
    }
    (groups, in_cycle)
}

#[cfg(test)]
mod tests {
    use super::{Edge, cheapest};

    fn total(nodes: usize, list: &[(usize, usize, i128)]) -> Option<i128> {
        let edges: Vec<Edge> = list.iter().map(|&(from, to, weight)| Edge { from, to, weight }).collect();
        let chosen = cheapest(nodes, 0, &edges)?;
        Some(chosen.iter().flatten().map(|k| edges[*k].weight).sum())
    }

    /// All choices of one edge per node, those that reach all nodes.
    fn by_trial(nodes: usize, list: &[(usize, usize, i128)]) -> Option<i128> {
        let into: Vec<Vec<usize>> =
            (1..nodes).map(|node| (0..list.len()).filter(|k| list[*k].1 == node).collect()).collect();
        let choices: usize = into.iter().map(Vec::len).product();
        let mut least = None;
        for choice in 0..choices {
            let mut rest = choice;
            let mut parents = vec![0; nodes];
            let mut sum = 0;
            for (node, list_of) in into.iter().enumerate() {
                let k = list_of[rest % list_of.len()];
                rest /= list_of.len();
                parents[node + 1] = list[k].0;
                sum += list[k].2;
            }
            let reaches = |node: usize| (0..nodes).fold(node, |at, _| if at == 0 { 0 } else { parents[at] }) == 0;
            if (0..nodes).all(reaches) && least.is_none_or(|old| sum < old) {
                least = Some(sum);
            }
        }
        least
    }

    #[test]
    fn the_cheapest_of_all_trees() {
        let mut random = 0x9e37_79b9_u64;
        let mut next = move |bound: u64| {
            random ^= random << 13;
            random ^= random >> 7;
            random ^= random << 17;
            (random >> 11) % bound
        };
        let mut reached = 0;
        for _ in 0..400 {
            let nodes = 2 + next(4) as usize;
            let edges: Vec<(usize, usize, i128)> = (0..2 * nodes)
                .map(|_| (next(nodes as u64) as usize, next(nodes as u64) as usize, i128::from(next(9))))
                .filter(|(from, to, _)| from != to && *to != 0)
                .collect();
            let found = total(nodes, &edges);
            assert_eq!(found, by_trial(nodes, &edges), "{edges:?}");
            reached += usize::from(found.is_some());
        }
        assert!(reached > 100, "{reached}");
    }
}
