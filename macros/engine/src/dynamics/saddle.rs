//! Stage `dynamics`: linear systems of the equations of motion.
//!
//! In: the mass matrix M, the Jacobian G of the equations that keep multipliers, an [`Order`]. Out: solutions of
//! M x + G^T l = f, G x = c, by factors L D L^T of the whole system, with the zeros that it has. Rows that no pivot was found
//! for are solved with pivots at run time, as the Schur complement that is left of them; its rank comes with the result.
//!
//! An order that is fixed can lose digits where one with a search does not: where an absorbed row has a small pivot, others are
//! left with what is small beside what was added and taken. So of every diagonal entry that rows have changed its *noise* is kept:
//! how much it was made of, in which each part counts as often as its pivot has lost (`noise / pivot`, one where nothing cancels).
//! Entries beside the diagonal have less. What is left to cores is measured by that. The losses add up to near nothing as a rule,
//! and to as much as a limb is heavier than what it carries; where they take more than half of all digits, absorbed rows count for
//! no rank. That is so where an assumption which let them be absorbed does not hold.

use crate::contracts::call::Call;
use crate::invariant::fault::OrFault;
use crate::invariant::injection::{Break, broken};
use crate::symbolic::graph::{BlockKind, Graph, Scalar};
use crate::symbolic::linear_algebra::Factors;

use super::elimination::{Order, Pattern, Pivot};

/// A loss whose square is more than this many times one over the rounding unit is too great: 1e9 in double precision, 5e4 in
/// single.
const LOST: i64 = 256;

/// What is to be solved.
pub(crate) struct Posed {
    matrix: Vec<Vec<Scalar>>,
    jacobian: Vec<Vec<Scalar>>,
    /// Rows of one unit, see [`BlockKind::Solve`].
    groups: Box<[usize]>,
    /// Rows that stand in the matrix too, with their weights.
    added: Vec<(usize, Scalar)>,
}

/// A system that is factorised once for several right-hand sides. Unknowns are counted through: coordinates, then rows.
pub(crate) struct Saddle {
    jacobian: Vec<Vec<Scalar>>,
    added: Vec<(usize, Scalar)>,
    pivots: Vec<Eliminated>,
    cores: Vec<Core>,
    /// How much rank rows that are pivots have: their number, or zero where the loss is too great.
    absorbed: Scalar,
}

/// One pivot.
struct Eliminated {
    place: usize,
    inverse: Scalar,
    /// How much of it others lose that are eliminated later.
    factors: Vec<(usize, Scalar)>,
}

/// Rows that are solved with pivots.
struct Core {
    /// Their places.
    places: Vec<usize>,
    groups: Box<[usize]>,
    /// G M^-1 G^T with what went before taken out, row by row.
    complement: Vec<Scalar>,
    /// What its pivots are measured by; empty where that is the diagonal.
    measures: Vec<Scalar>,
    /// Columns of its inverse.
    inverse: Option<Vec<Vec<Scalar>>>,
}

/// What solves one system.
pub(crate) struct Solution {
    pub unknowns: Vec<Scalar>,
    pub multipliers: Vec<Scalar>,
    pub rank: Option<Scalar>,
}

impl Posed {
    /// Rows of G with equal numbers in `groups` have one unit. Where the mass matrix is singular by structure, as that of a
    /// free rod that has no inertia about its own line, equations that hold an idle motion are added to it: with
    /// G x = c the systems M x + G^T l = f and (M + w g g^T) x + G^T l = f + w g c have the same solution, multipliers included.
    /// All that hold one are: each may let go of it in some pose, as those of a hinge do in turn while it turns, or hold two
    /// bodies in such a way that only others tell them apart. Then the sum is definite wherever the motion is determined. A weight w is the least inertia of what the equation moves, in whatever units: a light rod keeps its digits.
    pub(crate) fn new(
        g: &mut Graph,
        mut matrix: Vec<Vec<Scalar>>,
        (jacobian, groups): (Vec<Vec<Scalar>>, Box<[usize]>),
        coordinates: &[usize],
    ) -> Posed {
        let idle = idle(g, &matrix, coordinates);
        let added: Vec<usize> = (0..jacobian.len())
            .filter(|&row| idle.iter().any(|motion| dot(g, &jacobian[row], motion) != Scalar::ZERO))
            .collect();
        let inertias: Vec<Scalar> = (0..matrix.len()).map(|k| matrix[k][k]).collect();
        let weigh = |row: usize| (row, least_inertia(g, &inertias, &jacobian[row]));
        let added: Vec<(usize, Scalar)> = added.into_iter().map(weigh).collect();
        for &(row, weight) in &added {
            add_square(g, &mut matrix, &jacobian[row], weight);
        }
        Posed { matrix, jacobian, groups, added }
    }

    /// Where entries are.
    pub(crate) fn pattern(&self) -> Pattern {
        let filled = |rows: &[Vec<Scalar>]| -> Vec<Vec<bool>> {
            rows.iter().map(|row| row.iter().map(|&entry| entry != Scalar::ZERO).collect()).collect()
        };
        Pattern { masses: filled(&self.matrix), rows: filled(&self.jacobian) }
    }
}

impl Saddle {
    /// In an order, or in a plain one where a pivot of that is zero whatever the pose: then some coordinates have no inertia that
    /// the order takes to have some.
    pub(crate) fn new(g: &mut Graph, posed: &Posed, order: &Order, coordinates: &[usize]) -> Saddle {
        Saddle::factorised(g, posed, order)
            .or_else(|| Saddle::factorised(g, posed, &Order::plain(&posed.pattern(), coordinates)))
            .or_fault("a plain order eliminates no row")
    }

    /// Nothing where rows are eliminated and a pivot is zero.
    fn factorised(g: &mut Graph, posed: &Posed, order: &Order) -> Option<Saddle> {
        let Posed { matrix, jacobian, groups, added } = posed;
        let mut work = Work::new(matrix, jacobian, groups);
        let heading = "Factorisation of masses and loops.";
        let pivots: Vec<Eliminated> =
            g.under(heading, |g| order.pivots.iter().map(|&pivot| work.eliminate(g, pivot)).collect());
        if work.rows_gone > 0 && pivots.iter().any(|pivot| pivot.inverse == Scalar::ZERO) {
            return None;
        }
        let cores = order.cores.iter().map(|rows| work.core(g, rows, groups)).collect();
        let absorbed = work.absorbed(g);
        Some(Saddle { jacobian: jacobian.clone(), added: added.clone(), pivots, cores, absorbed })
    }

    /// Rows that are pivots, and those of each core.
    pub(crate) fn rows(&self) -> (Vec<usize>, Vec<Vec<usize>>) {
        let coordinates = self.jacobian.first().map_or(0, Vec::len);
        let row = |place: usize| place.checked_sub(coordinates);
        let mut absorbed: Vec<usize> = match self.jacobian.is_empty() {
            true => Vec::new(),
            false => self.pivots.iter().filter_map(|pivot| row(pivot.place)).collect(),
        };
        absorbed.sort_unstable();
        let cores = self.cores.iter().map(|core| core.places.iter().filter_map(|&place| row(place)).collect());
        (absorbed, cores.collect())
    }

    /// Inverts the cores: for more right-hand sides than these have rows.
    pub(crate) fn invert(&mut self, g: &mut Graph) {
        for core in &mut self.cores {
            let size = core.places.len();
            let unit = |at: usize| (0..size).map(move |k| if k == at { Scalar::ONE } else { Scalar::ZERO });
            let columns = (0..size).map(|at| core.solve(g, unit(at).collect()).0);
            core.inverse = Some(columns.collect());
        }
    }

    /// For f and c.
    pub(crate) fn solve(&self, g: &mut Graph, rhs: &[Scalar], held: &[Scalar]) -> Solution {
        let mut side = rhs.to_vec();
        for &(row, weight) in &self.added {
            let held = g.mul(weight, held[row]);
            for (entry, &slope) in side.iter_mut().zip(&self.jacobian[row]) {
                let moved = g.mul(slope, held);
                *entry = g.add(*entry, moved);
            }
        }
        side.extend(held.iter().map(|&held| if broken(Break::HeldSign) { -held } else { held }));
        for pivot in &self.pivots {
            g.label(side[pivot.place], || format!("side_{}", name(pivot.place, rhs.len())));
            for &(place, factor) in &pivot.factors {
                let taken = g.mul(factor, side[pivot.place]);
                side[place] = g.sub(side[place], taken);
            }
        }
        let mut rank = Some(self.absorbed);
        let mut solved = side.clone();
        for core in &self.cores {
            let driven: Vec<Scalar> = core.places.iter().map(|&place| -side[place]).collect();
            let (multipliers, own) = core.solve(g, driven);
            rank = rank.zip(own).map(|(rank, own)| g.add(rank, own));
            core.places.iter().zip(multipliers).for_each(|(&place, multiplier)| solved[place] = multiplier);
        }
        for pivot in self.pivots.iter().rev() {
            let mut terms = vec![g.mul(side[pivot.place], pivot.inverse)];
            terms.extend(pivot.factors.iter().map(|&(place, factor)| -g.mul(factor, solved[place])));
            solved[pivot.place] = g.sum(&terms);
        }
        let multipliers = solved.split_off(rhs.len());
        Solution { unknowns: solved, multipliers, rank: rank.filter(|_| !held.is_empty()) }
    }
}

impl Core {
    /// Unknowns of one right side, and the rank, which nobody asks for once the inverse is there.
    fn solve(&self, g: &mut Graph, driven: Vec<Scalar>) -> (Vec<Scalar>, Option<Scalar>) {
        let size = self.places.len();
        if let Some(inverse) = &self.inverse {
            let row = |k: usize| inverse.iter().map(|column| column[k]).collect::<Vec<_>>();
            return ((0..size).map(|k| dot(g, &row(k), &driven)).collect(), None);
        }
        let operands = self.complement.iter().copied().chain(driven).chain(self.measures.iter().copied());
        let operands: Vec<Scalar> = operands.collect();
        let kind = BlockKind::Solve { size, symmetric: true, groups: self.groups.clone() };
        let mut unknowns = g.block_outputs(kind, &operands);
        let rank = unknowns.pop();
        (unknowns, rank)
    }
}

/// A system while it is eliminated.
struct Work {
    coordinates: usize,
    entries: Vec<Vec<Scalar>>,
    gone: Vec<bool>,
    /// By place the noise of its diagonal entry; of a coordinate once a row has changed it.
    noise: Vec<Option<Scalar>>,
    /// Of pivots that have lost something how much, each at least one; and how many rows are pivots.
    losses: Vec<Scalar>,
    rows_gone: usize,
    /// By row those of its unit.
    groups: Vec<Vec<usize>>,
}

impl Work {
    fn new(matrix: &[Vec<Scalar>], jacobian: &[Vec<Scalar>], groups: &[usize]) -> Work {
        let n = matrix.len();
        let size = n + jacobian.len();
        let mut entries = vec![vec![Scalar::ZERO; size]; size];
        for (i, row) in matrix.iter().enumerate() {
            entries[i][..n].copy_from_slice(row);
        }
        for (k, row) in jacobian.iter().enumerate() {
            for (j, &entry) in row.iter().enumerate() {
                entries[n + k][j] = entry;
                entries[j][n + k] = entry;
            }
        }
        let group = |row: usize| groups.get(row).copied().unwrap_or(row);
        let alike = |row: usize| (0..jacobian.len()).filter(move |&other| group(other) == group(row)).collect();
        let groups = (0..jacobian.len()).map(alike).collect();
        let noise = (0..size).map(|place| (place >= n).then_some(Scalar::ZERO)).collect();
        Work { coordinates: n, entries, gone: vec![false; size], noise, losses: Vec::new(), rows_gone: 0, groups }
    }

    fn eliminate(&mut self, g: &mut Graph, pivot: Pivot) -> Eliminated {
        let n = self.coordinates;
        let place = match pivot {
            Pivot::Coordinate(k) => k,
            Pivot::Row(k) => n + k,
        };
        self.gone[place] = true;
        let line = self.entries[place].clone();
        let own = name(place, n);
        // Of a coordinate without any inertia, which no equation holds either, nothing is known.
        let idle = line[place] == Scalar::ZERO;
        let inverse = if idle { Scalar::ZERO } else { g.reciprocal(line[place]) };
        let loss = self.loss_of(g, place, line[place], inverse);
        g.name(line[place], || format!("pivot_{own}"));
        g.name(inverse, || format!("inverse_{own}"));
        let near: Vec<usize> = (0..line.len()).filter(|&k| !self.gone[k] && line[k] != Scalar::ZERO).collect();
        let mut factors = Vec::with_capacity(near.len());
        for &i in &near {
            g.label(line[i], || format!("entry_{own}_{}", name(i, n)));
            let factor = g.mul(line[i], inverse);
            g.name(factor, || format!("l_{own}_{}", name(i, n)));
            factors.push((i, factor));
        }
        for (at, &(i, factor)) in factors.iter().enumerate() {
            for &j in &near[at..] {
                let update = g.mul(factor, line[j]);
                if i == j {
                    self.disturb(g, i, update, (place < n, loss));
                }
                self.entries[i][j] = g.sub(self.entries[i][j], update);
                self.entries[j][i] = self.entries[i][j];
            }
        }
        Eliminated { place, inverse, factors }
    }

    /// How much a pivot has lost, if it has.
    fn loss_of(&mut self, g: &mut Graph, place: usize, pivot: Scalar, inverse: Scalar) -> Option<Scalar> {
        let is_row = place >= self.coordinates;
        self.rows_gone += usize::from(is_row);
        let [pivot, inverse] = [pivot, inverse].map(|s| if is_row { -s } else { s });
        let noise = self.noise[place].filter(|&noise| noise != pivot)?;
        let loss = g.mul(noise, inverse);
        self.losses.push(loss);
        Some(loss)
    }

    /// An update of a diagonal entry, by a pivot of a coordinate or a row: coordinates give to rows, and rows to coordinates. What
    /// is taken was there, and adds noise only where the pivot had lost some.
    fn disturb(&mut self, g: &mut Graph, place: usize, update: Scalar, (by_coordinate, loss): (bool, Option<Scalar>)) {
        let gives = by_coordinate != (place < self.coordinates);
        if self.noise[place].is_none() && by_coordinate || !gives && loss.is_none() {
            return;
        }
        let size = if by_coordinate { update } else { -update };
        let part = loss.map_or(size, |loss| g.mul(size, loss));
        let before = self.noise[place].unwrap_or(self.entries[place][place]);
        self.noise[place] = Some(g.add(before, part));
    }

    /// One where nothing is lost. A sum, so that what is no number stays none.
    fn loss(&self, g: &mut Graph) -> Option<Scalar> {
        let surplus = g.integer(self.losses.len() as i64 - 1);
        let sum = g.sum(&self.losses);
        let loss = g.sub(sum, surplus);
        g.name(loss, || "loss".to_owned());
        (!self.losses.is_empty()).then_some(loss)
    }

    /// The rank of rows that are pivots.
    fn absorbed(&self, g: &mut Graph) -> Scalar {
        let count = g.integer(self.rows_gone as i64);
        let Some(loss) = self.loss(g) else { return count };
        let (most, unit) = (g.integer(LOST), g.call(Call::Epsilon, &[]));
        let square = g.product(&[unit, loss, loss]);
        // What is no number is too great.
        let sound = g.call(Call::LessEqual, &[square, most]);
        g.call(Call::Select, &[sound, count, Scalar::ZERO])
    }

    /// What is left of some rows.
    fn core(&self, g: &mut Graph, rows: &[usize], groups: &[usize]) -> Core {
        let places: Vec<usize> = rows.iter().map(|&row| self.coordinates + row).collect();
        let entries = places.iter().flat_map(|&i| places.iter().map(move |&j| -self.entries[i][j]));
        let complement: Vec<Scalar> = entries.collect();
        let mut measures: Vec<Scalar> = rows.iter().map(|&row| self.measure(g, row, rows)).collect();
        if measures.iter().zip(&places).all(|(&measure, &place)| measure == -self.entries[place][place]) {
            measures.clear();
        }
        let own: Vec<usize> = rows.iter().map(|&row| groups.get(row).copied().unwrap_or(row)).collect();
        let first: Box<[usize]> = own.iter().filter_map(|group| own.iter().position(|other| other == group)).collect();
        let alone = first.iter().enumerate().all(|(k, &group)| k == group);
        Core { places, groups: if alone { Box::default() } else { first }, complement, measures, inverse: None }
    }

    /// What a row's pivot is measured by. Of rows of one unit the solution compares those of one core; what is small beside one
    /// of another core, or beside one that is gone, by the square of the threshold is none either.
    fn measure(&self, g: &mut Graph, row: usize, core: &[usize]) -> Scalar {
        let noise = |row: usize| self.noise[self.coordinates + row].or_fault("a row has a noise from the start");
        let others = self.groups[row].iter().filter(|other| !core.contains(other));
        let Some(most) = others.map(|&other| noise(other)).reduce(|a, b| g.call(Call::Max, &[a, b])) else {
            return noise(row);
        };
        // The threshold of a solution of this size, see the runtime's `linear`.
        let (units, unit) = (g.integer(16 * core.len() as i64), g.call(Call::Epsilon, &[]));
        let least = g.product(&[units, unit, most]);
        g.call(Call::Max, &[noise(row), least])
    }
}

/// Motions without any inertia, whatever the pose: each of one coordinate, and of others in such a way that M takes no effort.
fn idle(g: &mut Graph, matrix: &[Vec<Scalar>], coordinates: &[usize]) -> Vec<Vec<Scalar>> {
    let (mut moving, mut idle) = (coordinates.to_vec(), Vec::new());
    let factors = loop {
        let factors = Factors::new(g, matrix, &moving);
        let Some(next) = factors.singular() else { break factors };
        moving.retain(|&k| k != next);
        idle.push(next);
    };
    let motion = |k: usize| {
        let column: Vec<Scalar> = matrix.iter().map(|row| -row[k]).collect();
        let mut motion = factors.solve(g, &column);
        idle.iter().for_each(|&other| motion[other] = Scalar::ZERO);
        motion[k] = Scalar::ONE;
        motion
    };
    idle.iter().copied().map(motion).collect()
}

/// The least inertia of the coordinates that an equation reads; of all, if it reads only such as have none.
fn least_inertia(g: &mut Graph, inertias: &[Scalar], row: &[Scalar]) -> Scalar {
    let moving = |&(&inertia, _): &(&Scalar, &Scalar)| inertia != Scalar::ZERO;
    let all: Vec<(&Scalar, &Scalar)> = inertias.iter().zip(row).filter(moving).collect();
    let mut own: Vec<Scalar> = all.iter().filter(|(_, entry)| **entry != Scalar::ZERO).map(|(m, _)| **m).collect();
    if own.is_empty() {
        own = all.iter().map(|(m, _)| **m).collect();
    }
    own.sort_unstable_by_key(|m| m.index());
    own.dedup();
    own.into_iter().reduce(|a, b| g.call(Call::Min, &[a, b])).unwrap_or(Scalar::ONE)
}

/// M + w g g^T.
fn add_square(g: &mut Graph, matrix: &mut [Vec<Scalar>], row: &[Scalar], weight: Scalar) {
    let weighted: Vec<Scalar> = row.iter().map(|&entry| g.mul(weight, entry)).collect();
    for i in 0..row.len() {
        for j in 0..row.len() {
            let both = g.mul(weighted[i], row[j]);
            matrix[i][j] = g.add(matrix[i][j], both);
        }
    }
}

/// A word for an unknown.
fn name(place: usize, coordinates: usize) -> String {
    match place.checked_sub(coordinates) {
        Some(row) => format!("row_{}", row + 1),
        None => format!("{}", place + 1),
    }
}

fn dot(g: &mut Graph, a: &[Scalar], b: &[Scalar]) -> Scalar {
    let terms: Vec<Scalar> = a.iter().zip(b).map(|(&x, &y)| g.mul(x, y)).collect();
    g.sum(&terms)
}
