//! Stage `symbolic`: the smallest systems of equations that can be solved one after the other.
//!
//! In: which unknowns each equation depends on. Out: equations matched with unknowns, in groups that need each other and in
//! an order in which each group needs earlier ones only (block triangular form: Dulmage and Mendelsohn 1958, Tarjan 1972).

/// Matches equations with unknowns: by equation the unknown, or nothing where there is none left (augmenting paths).
/// `weights` are (unknown, size of the entry): greater entries are tried first.
pub fn matching(weights: &[Vec<(usize, f64)>], unknowns: usize) -> Vec<Option<usize>> {
    let mut sorted = weights.to_vec();
    for row in &mut sorted {
        row.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
    }
    let mut by_unknown: Vec<Option<usize>> = vec![None; unknowns];
    for row in 0..sorted.len() {
        let mut seen = vec![false; unknowns];
        augment(&sorted, row, &mut by_unknown, &mut seen);
    }
    let mut by_row = vec![None; weights.len()];
    for (unknown, row) in by_unknown.iter().enumerate() {
        if let Some(row) = row {
            by_row[*row] = Some(unknown);
        }
    }
    by_row
}

/// Finds a place for an equation, moving others; depth is bounded by the number of equations in one loop system.
fn augment(rows: &[Vec<(usize, f64)>], row: usize, by_unknown: &mut [Option<usize>], seen: &mut [bool]) -> bool {
    for &(unknown, _) in &rows[row] {
        if std::mem::replace(&mut seen[unknown], true) {
            continue;
        }
        let free = match by_unknown[unknown] {
            None => true,
            Some(other) => augment(rows, other, by_unknown, seen),
        };
        if free {
            by_unknown[unknown] = Some(row);
            return true;
        }
    }
    false
}

/// Strongly connected components of a graph, what is needed first. `needs` lists, by node, the nodes that it needs.
pub fn components(needs: &[Vec<usize>]) -> Vec<Vec<usize>> {
    let count = needs.len();
    let (mut index, mut low) = (vec![usize::MAX; count], vec![0; count]);
    let (mut open, mut is_open) = (Vec::new(), vec![false; count]);
    let (mut next, mut found) = (0, Vec::new());
    for root in 0..count {
        if index[root] != usize::MAX {
            continue;
        }
        // (node, number of its needs that were followed)
        let mut stack = vec![(root, 0)];
        while let Some(&mut (node, ref mut followed)) = stack.last_mut() {
            if *followed == 0 {
                (index[node], low[node]) = (next, next);
                next += 1;
                open.push(node);
                is_open[node] = true;
            }
            if let Some(&other) = needs[node].get(*followed) {
                *followed += 1;
                if index[other] == usize::MAX {
                    stack.push((other, 0));
                } else if is_open[other] {
                    low[node] = low[node].min(index[other]);
                }
                continue;
            }
            stack.pop();
            if let Some(&(parent, _)) = stack.last() {
                low[parent] = low[parent].min(low[node]);
            }
            if low[node] == index[node] {
                let mut group = Vec::new();
                while let Some(member) = open.pop() {
                    is_open[member] = false;
                    group.push(member);
                    if member == node {
                        break;
                    }
                }
                group.sort_unstable();
                found.push(group);
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::{components, matching};

    #[test]
    fn groups_come_in_order() {
        // 0 needs 1, 1 and 2 need each other, 3 stands alone and 2 needs it; 4 needs itself.
        let needs = vec![vec![1], vec![2], vec![1, 3], vec![], vec![4]];
        assert_eq!(components(&needs), vec![vec![3], vec![1, 2], vec![0], vec![4]]);
    }

    #[test]
    fn every_equation_gets_an_unknown() {
        let rows = vec![vec![(0, 1.0), (1, 2.0)], vec![(1, 3.0)], vec![(0, 1.0), (2, 0.1)]];
        assert_eq!(matching(&rows, 3), vec![Some(0), Some(1), Some(2)]);
        let rows = vec![vec![(0, 1.0)], vec![(0, 2.0)]];
        assert_eq!(matching(&rows, 1).iter().flatten().count(), 1);
    }
}
