//! Stage `dynamics`: in which order a system of coordinates and multipliers is eliminated.
//!
//! In: where M and G of K = (M, G^T; G, 0) have entries, and which rows of G some coordinates can absorb. Out: an [`Order`]
//! of pivots, each a single number, and what is left of the rows.
//!
//! M is positive definite, so a coordinate may be eliminated at any time. A row may be once it can't depend on the rows
//! before it in the coordinates before it alone: then everything that has been eliminated is a regular system by itself, the
//! pivots of coordinates are positive, those of rows negative, and none needs to be looked for at run time (a matrix of this
//! kind is strongly factorisable, Vanderbei 1995). Whoever knows the mechanism says of which rows this is so in every pose;
//! a limb takes the rows at its end along before the body that it carries is touched. What no coordinates absorb for certain
//! waits until all coordinates are gone. Rows that no entry couples any more then are systems of their own, and are solved
//! with pivots and a rank.
//!
//! The next pivot is always one of those with the fewest neighbours (minimum degree, Tinney and Walker 1967), counted with
//! what earlier ones have filled in.

use std::collections::HashMap;

/// What can be eliminated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Pivot {
    Coordinate(usize),
    Row(usize),
}

/// Pivots in order, and what is left.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Order {
    pub pivots: Vec<Pivot>,
    /// Rows that are coupled once all pivots are eliminated.
    pub cores: Vec<Vec<usize>>,
}

/// Where a system has entries.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Pattern {
    /// Of M, symmetric.
    pub masses: Vec<Vec<bool>>,
    /// Of G, row by row.
    pub rows: Vec<Vec<bool>>,
}

/// Says whether a row is independent of others in some coordinates alone, in every pose: the row, the others, the coordinates.
pub type Absorbs<'a> = dyn FnMut(usize, &[usize], &[usize]) -> bool + 'a;

impl Order {
    /// All coordinates as they are given, then all rows that hang together.
    pub fn plain(pattern: &Pattern, coordinates: &[usize]) -> Order {
        let mut filled = Filled::new(pattern);
        let pivots: Vec<Pivot> = coordinates.iter().map(|&k| Pivot::Coordinate(k)).collect();
        pivots.iter().for_each(|&pivot| filled.eliminate(filled.place(pivot)));
        Order { pivots, cores: filled.cores() }
    }

    /// By the fewest neighbours, with rows as soon as they may go. Of equals the coordinates come as they are given.
    pub fn sparse(pattern: &Pattern, coordinates: &[usize], absorbs: &mut Absorbs<'_>) -> Order {
        let mut filled = Filled::new(pattern);
        let n = pattern.masses.len();
        let mut turn = vec![0; n + pattern.rows.len()];
        coordinates.iter().enumerate().for_each(|(at, &k)| turn[k] = at);
        let (mut pivots, mut gone, mut absorbed): (Vec<Pivot>, Vec<usize>, Vec<usize>) = Default::default();
        // How many coordinates and rows were gone when a row was refused.
        let mut refused: HashMap<usize, (usize, usize)> = HashMap::new();
        while gone.len() < n {
            let mut places: Vec<usize> = (0..filled.gone.len()).filter(|&k| !filled.gone[k]).collect();
            places.sort_by_cached_key(|&k| (filled.degree(k), k < n, turn[k]));
            let next = places.into_iter().find(|&place| {
                let Some(row) = place.checked_sub(n) else { return true };
                let now = (gone.len(), absorbed.len());
                // Without a neighbour that is gone nothing of it can be absorbed.
                if !filled.touched[place] || refused.get(&row) == Some(&now) {
                    return false;
                }
                let may = absorbs(row, &absorbed, &gone);
                if !may {
                    refused.insert(row, now);
                }
                may
            });
            let Some(place) = next else { break };
            let pivot = if place < n { Pivot::Coordinate(place) } else { Pivot::Row(place - n) };
            match pivot {
                Pivot::Coordinate(k) => gone.push(k),
                Pivot::Row(k) => absorbed.push(k),
            }
            filled.eliminate(place);
            pivots.push(pivot);
        }
        Order { pivots, cores: filled.cores() }
    }

    /// Sums and products that the factors and one solution cost, roughly; a pivot of the cores' costs as much as some of them.
    pub fn cost(&self, pattern: &Pattern) -> usize {
        let mut filled = Filled::new(pattern);
        let mut cost = 0;
        for &pivot in &self.pivots {
            let place = filled.place(pivot);
            let degree = filled.degree(place);
            cost += degree * (degree + 1) + 5 * degree + 8;
            filled.eliminate(place);
        }
        // Comparisons and exchanges cost several times what elimination alone does.
        cost + self.cores.iter().map(|core| 2 * core.len() * core.len() * (core.len() + 4)).sum::<usize>()
    }
}

/// Neighbours, with fill-in.
struct Filled {
    coordinates: usize,
    near: Vec<Vec<bool>>,
    gone: Vec<bool>,
    /// Whether a neighbour is gone.
    touched: Vec<bool>,
}

impl Filled {
    fn new(pattern: &Pattern) -> Filled {
        let n = pattern.masses.len();
        let size = n + pattern.rows.len();
        let mut near = vec![vec![false; size]; size];
        for (i, row) in pattern.masses.iter().enumerate() {
            near[i][..n].copy_from_slice(row);
            near[i][i] = false;
        }
        for (k, row) in pattern.rows.iter().enumerate() {
            for (j, &entry) in row.iter().enumerate() {
                near[n + k][j] = entry;
                near[j][n + k] = entry;
            }
        }
        Filled { coordinates: n, near, gone: vec![false; size], touched: vec![false; size] }
    }

    fn place(&self, pivot: Pivot) -> usize {
        match pivot {
            Pivot::Coordinate(k) => k,
            Pivot::Row(k) => self.coordinates + k,
        }
    }

    fn neighbours(&self, place: usize) -> Vec<usize> {
        (0..self.near.len()).filter(|&k| self.near[place][k] && !self.gone[k]).collect()
    }

    fn degree(&self, place: usize) -> usize {
        self.near[place].iter().zip(&self.gone).filter(|(near, gone)| **near && !**gone).count()
    }

    fn eliminate(&mut self, place: usize) {
        self.gone[place] = true;
        let neighbours = self.neighbours(place);
        for &i in &neighbours {
            self.touched[i] = true;
            for &j in &neighbours {
                self.near[i][j] |= i != j;
            }
        }
    }

    /// Rows that are left, by what hangs together.
    fn cores(&self) -> Vec<Vec<usize>> {
        let mut open: Vec<usize> = (self.coordinates..self.gone.len()).filter(|&k| !self.gone[k]).collect();
        let mut cores = Vec::new();
        while !open.is_empty() {
            let mut core = vec![open.remove(0)];
            let mut next = 0;
            while let Some(&place) = core.get(next) {
                next += 1;
                let (near, far): (Vec<usize>, Vec<usize>) = open.iter().partition(|&&k| self.near[place][k]);
                core.extend(near);
                open = far;
            }
            core.sort_unstable();
            cores.push(core.into_iter().map(|place| place - self.coordinates).collect());
        }
        cores
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Coordinates of a platform, last, and of limbs; rows of each limb and the platform.
    fn platform(limbs: usize, own: usize, rows: usize, free: usize) -> Pattern {
        let n = limbs * own + free;
        let group = |k: usize| if k < limbs * own { k / own } else { limbs };
        let masses = (0..n).map(|i| (0..n).map(|j| group(i) == group(j)).collect()).collect();
        let row = |k: usize| (0..n).map(|j| group(j) == k / rows || group(j) == limbs).collect();
        Pattern { masses, rows: (0..limbs * rows).map(row).collect() }
    }

    #[test]
    fn limbs_take_their_rows_along() {
        let pattern = platform(6, 3, 3, 6);
        let order: Vec<usize> = (0..24).collect();
        let plain = Order::plain(&pattern, &order);
        assert_eq!(plain.cores, [(0..18).collect::<Vec<usize>>()]);
        let all = Order::sparse(&pattern, &order, &mut |_, _, _| true);
        assert!(all.cores.is_empty());
        // The platform is last, and no front is larger than what is left of it.
        let late: Vec<usize> = (18..24).collect();
        assert!(all.pivots[36..].iter().all(|pivot| matches!(pivot, Pivot::Coordinate(k) if late.contains(k))));
        // One row of each limb may not be absorbed: it waits, and those are coupled by the platform.
        let most = Order::sparse(&pattern, &order, &mut |row, before, gone| {
            let limb = row / 3;
            assert!(before.iter().all(|other| *other != row));
            row % 3 < 2 && (3 * limb..3 * limb + 3).all(|k| gone.contains(&k))
        });
        assert_eq!(most.cores, [vec![2, 5, 8, 11, 14, 17]]);
        let [plain, most, all] = [plain, most, all].map(|order| order.cost(&pattern));
        assert!(all < most && most < plain, "{all} {most} {plain}");
    }

    #[test]
    fn what_nothing_couples_is_solved_apart() {
        let pattern = platform(5, 3, 2, 0);
        let order: Vec<usize> = (0..15).collect();
        let cores: Vec<Vec<usize>> = (0..5).map(|k| vec![2 * k, 2 * k + 1]).collect();
        assert_eq!(Order::plain(&pattern, &order).cores, cores);
        assert_eq!(Order::sparse(&pattern, &order, &mut |_, _, _| false).cores, cores);
    }
}
