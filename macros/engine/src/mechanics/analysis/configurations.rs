//! Stage `mechanics`: configurations in which loops are closed.
//!
//! In: a [`Problem`] and some of its equations. Out: points at which they vanish, found from random starts by Levenberg's
//! and Marquardt's method with a damping that falls with the square of the residual: then it converges quadratically
//! also where rows are redundant and where solutions are not isolated (Yamashita and Fukushima 2001). How far axes are
//! from their meant directions is minimised along with the equations; where these vanish it vanishes to second order.
//! The equation of a thread that doesn't count its turns rises and falls along the travel, and stops most starts at one of
//! its crests: so every third start closes the others first, which leaves it open by half a turn at most.
//! Everything is deterministic: the starts are numbered.

use super::measure::Gap;
use super::problem::{Linearised, Point, Problem, Random, Source};
use super::rank;
use super::singular::{add, clear_rank, dot, singular_values};
use super::tape::Values;

/// A residual below this counts as zero, in units of the equation's gradient.
const CLOSED: f64 = 1e-11;

/// What an equation may leave that follows from others which are closed.
const FOLLOWS: f64 = 1e-9;

/// Starts from which that is looked at, and those that have to come to an end.
const FOLLOWING_STARTS: usize = 120;
const LEAST_FOLLOWING: usize = 40;

/// A declared pose is closed if no coordinate moves by more than this to close it: numbers are typed with few digits.
const TYPED: f64 = 1e-4;

/// Iterations of one start.
const ITERATIONS: usize = 80;

/// Steps are cut to this length in any column.
const LONGEST: f64 = 0.7;

/// A closed configuration, or the best that was found.
pub(super) struct Configuration {
    pub point: Point,
    /// Jacobian rows of unit length or zero, over the group's columns.
    pub jacobian: Vec<Vec<f64>>,
    pub closed: bool,
    /// Of all equations, where there is a clear gap in the singular values.
    pub rank: Option<usize>,
    /// Least singular value before that gap and greatest one behind it.
    pub gap: (f64, f64),
}

/// What was found about a group of equations that share coordinates.
#[derive(Default)]
pub(super) struct Found {
    pub configurations: Vec<Configuration>,
    /// Jacobians at random points that close nothing: what depends there depends everywhere. Only where some equations
    /// depend on others at all closed configurations.
    pub anywhere: Vec<Vec<Vec<f64>>>,
    /// Jacobians where the equations are off by a little, each by something else: where that can be, they are independent
    /// somewhere near.
    pub beside: Vec<Vec<Vec<f64>>>,
    /// Of the start that came nearest.
    pub gap: Gap,
}

/// How hard to look.
#[derive(Clone, Copy)]
pub(super) struct Effort {
    /// Closed configurations, where their rank leaves no doubt.
    wanted: usize,
    /// Starts for these.
    starts: usize,
    /// Closed configurations where equations depend on each other there, but not everywhere.
    wide: usize,
}

impl Effort {
    /// Enough to be sure of what a few loops can do; bounded where a start costs much.
    pub(super) fn of(equations: usize) -> Effort {
        let (wanted, wide) = match equations {
            0..=16 => (5, 40),
            17..=30 => (5, 20),
            31..=60 => (3, 10),
            61..=120 => (3, 5),
            _ => (2, 2),
        };
        let cube = equations.max(1).saturating_pow(3);
        Effort { wanted, starts: (8_000_000 / cube).clamp(4, 48), wide }
    }

    /// Before equations are said to be such as cannot be closed: many more starts, of which one that
    /// closes is enough.
    pub(super) fn patient(equations: usize) -> Effort {
        let cube = equations.max(1).saturating_pow(3);
        Effort { wanted: 1, starts: (32_000_000 / cube).clamp(48, 400), wide: 1 }
    }

    /// To see whether equations can be closed at all.
    pub(super) const ONE: Effort = Effort { wanted: 1, starts: 24, wide: 1 };
}

/// Looks for closed configurations. `columns` are those of the group, in order.
///
/// A branch of few dimensions attracts few starts: a scissor collapses far more often than it opens. So where equations
/// depend on each other at all configurations found, but not at points that are not closed, the search goes on, with every
/// other start from a point where all equations are off by a little: where collapsed loops can't be, and open ones can.
pub(super) fn configurations(problem: &Problem, equations: &[usize], columns: &[usize], effort: Effort) -> Found {
    let search = Search::new(problem, equations, columns);
    let plain: Vec<usize> = equations.iter().copied().filter(|&k| !problem.equations[k].recurs).collect();
    let without_threads = (plain.len() < equations.len()).then(|| {
        let mut search = Search::new(problem, &plain, columns);
        problem.without_threads(&mut search.alignments);
        search
    });
    let is_row = |&k: &usize| matches!(problem.equations[equations[k]].source, Source::Row(_));
    let rows: Vec<usize> = (0..equations.len()).filter(is_row).collect();
    let mut found = Found::default();
    let (mut unclear, mut unmeant, mut best) = (Vec::new(), Vec::new(), None);
    let mut values = Values::default();
    let (mut most, mut general) = (0, None);
    let mut start = 0;
    loop {
        let enough = found.configurations.len() >= effort.wanted || unmeant.len() >= 2 * effort.wanted;
        if !enough && start >= effort.starts {
            break;
        }
        if enough {
            if most == rows.len() || found.configurations.len() >= effort.wide || start >= effort.starts + effort.wide {
                break;
            }
            if most >= *general.get_or_insert_with(|| search.anywhere(&rows, &mut found.anywhere, &mut values)) {
                break;
            }
        }
        let mut random = Random(0x5EED + 977 * start as u64);
        let amplitude = [0.3, 0.6, 0.15, 1.0][start % 4];
        let mut point = problem.start(&mut random, amplitude);
        if enough && start % 2 == 1 && rows.len() == equations.len() && rows.len() <= columns.len() {
            let off = [0.02, 0.2][start / 2 % 2];
            if search.off_by(off, &mut random).close(&mut point, &mut values) && off < 0.1 {
                let at = search.linearise(&point, &mut values);
                found.beside.push(search.jacobian(&at));
            }
        }
        if let Some(first) = without_threads.as_ref().filter(|_| start % 3 == 2) {
            first.close(&mut point, &mut values);
        }
        start += 1;
        let closed = search.close(&mut point, &mut values);
        let at = problem.linearise(&point, equations, &mut values);
        let residual = dot(&at.residuals, &at.residuals);
        let gap = problem.gap_at(&point, equations, &mut values);
        let configuration = search.configuration(point, &at, closed);
        if !closed {
            if best.as_ref().is_none_or(|(least, _)| residual < *least) {
                best = Some((residual, configuration));
                found.gap = gap;
            }
        } else if !problem.is_meant(&configuration.point, columns, &mut values) {
            unmeant.push(configuration);
        } else if configuration.rank.is_some() {
            most = most.max(rank::of(&configuration.jacobian, &rows));
            found.configurations.push(configuration);
        } else {
            unclear.push(configuration);
        }
    }
    if most < rows.len() && general.is_none() {
        search.anywhere(&rows, &mut found.anywhere, &mut values);
    }
    for others in [unclear, unmeant, best.into_iter().map(|(_, configuration)| configuration).collect()] {
        if found.configurations.is_empty() {
            found.configurations = others;
        }
    }
    found
}

/// The declared pose, if these equations are closed there up to what typed numbers leave.
pub(super) fn declared(problem: &Problem, search: &Search<'_>) -> Option<Point> {
    let declared = problem.origin();
    let mut point = declared.clone();
    let moved = |point: &Point| point.0.iter().zip(&declared.0).fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()));
    (search.close(&mut point, &mut Values::default()) && moved(&point) <= TYPED).then_some(point)
}

/// The declared pose, where it closes all loops, and equations have slopes, which those of a disc that lies flat have not.
pub(super) fn start(problem: &Problem) -> Option<Point> {
    let equations: Vec<usize> = (0..problem.equations.len()).collect();
    let columns: Vec<usize> = (0..problem.columns.len()).collect();
    let driven = problem.driven_columns();
    let point = declared(problem, &Search::new(problem, &equations, &columns).holding(&driven))?;
    problem.has_slopes(&point, &mut Values::default()).then_some(point)
}

/// The declared pose, if it is closed and of the rank that the samples have.
pub(super) fn home(problem: &Problem, equations: &[usize], columns: &[usize], found: &Found) -> Option<Configuration> {
    let search = Search::new(problem, equations, columns);
    let point = declared(problem, &search)?;
    let at = problem.linearise(&point, equations, &mut Values::default());
    let home = search.configuration(point, &at, true);
    let rank = found.configurations.iter().filter_map(|configuration| configuration.rank).max();
    (home.rank.is_some() && home.rank >= rank).then_some(home)
}

/// Whether some equations vanish wherever `independent` ones among them do: at configurations found for these alone, from
/// starts all over. On a branch on which another one counts they would leave it open, since without it that branch has a
/// dimension more. Nothing is found out where too few starts come to an end.
pub(super) fn follow(problem: &Problem, equations: &[usize], independent: &[usize], columns: &[usize]) -> bool {
    let alone: Vec<usize> = independent.iter().map(|&k| equations[k]).collect();
    let search = Search::new(problem, &alone, columns);
    let mut values = Values::default();
    let mut closed = 0;
    for start in 0..FOLLOWING_STARTS {
        let mut random = Random(0xF0_110 + 977 * start as u64);
        let mut point = problem.start(&mut random, [0.3, 0.6, 1.0, 1.5][start % 4]);
        if !search.close(&mut point, &mut values) {
            continue;
        }
        if problem.residuals(&point, equations, &mut values).iter().any(|residual| residual.abs() > FOLLOWS) {
            return false;
        }
        closed += 1;
    }
    closed >= LEAST_FOLLOWING
}

/// What makes points closed.
pub(super) struct Search<'p> {
    problem: &'p Problem,
    equations: &'p [usize],
    columns: &'p [usize],
    alignments: Vec<usize>,
    /// By column, where it stays as it is; none if empty.
    held: &'p [bool],
    /// By equation, what its residual is wanted to be; zero if empty.
    target: Vec<f64>,
}

impl<'p> Search<'p> {
    /// `columns` are those of the equations, in order.
    pub(super) fn new(problem: &'p Problem, equations: &'p [usize], columns: &'p [usize]) -> Self {
        let alignments = problem.alignments_of(columns);
        Search { problem, equations, columns, alignments, held: &[], target: Vec::new() }
    }

    /// The same where joints that other equations hold may stand any way.
    pub(super) fn alone(mut self) -> Self {
        self.problem.alignments_at(&mut self.alignments, self.equations);
        self
    }

    /// The same where some columns stay as they are.
    pub(super) fn holding(mut self, held: &'p [bool]) -> Self {
        self.held = held;
        self
    }
}

impl Search<'_> {
    /// The same where each equation is off by something of its own.
    fn off_by(&self, off: f64, random: &mut Random) -> Search<'_> {
        let target = self.equations.iter().map(|_| off * random.next()).collect();
        let Search { problem, equations, columns, held, .. } = *self;
        Search { problem, equations, columns, alignments: Vec::new(), held, target }
    }

    /// Adds Jacobians at points that close nothing, and gives the greatest rank of some rows there.
    fn anywhere(&self, rows: &[usize], jacobians: &mut Vec<Vec<Vec<f64>>>, values: &mut Values) -> usize {
        let mut random = Random(0xFA2);
        let count = if self.equations.len() > 60 { 1 } else { 2 };
        for _ in 0..count {
            let point = self.problem.start(&mut random, 0.7);
            let at = self.problem.linearise(&point, self.equations, values);
            jacobians.push(self.jacobian(&at));
        }
        jacobians.iter().map(|jacobian| rank::of(jacobian, rows)).max().unwrap_or(0)
    }

    /// Whether all equations vanish and all axes point as they should, which the point is moved to reach.
    pub(super) fn close(&self, point: &mut Point, values: &mut Values) -> bool {
        let mut at = self.linearise(point, values);
        let mut square = dot(&at.residuals, &at.residuals);
        let mut damping = 0.1;
        let mut stagnant = 0;
        for _ in 0..ITERATIONS {
            if self.is_closed(&at.residuals) {
                return self.is_aligned(&at.residuals);
            }
            if !square.is_finite() || stagnant > 6 {
                return false;
            }
            let normal = self.normal(&at.rows);
            let before = square;
            for _ in 0..8 {
                let step = self.step(&normal, &at, damping * before.min(1.0));
                let mut next = point.clone();
                self.problem.displace(&mut next, &step);
                let residuals = self.all_residuals(&next, values);
                let after = dot(&residuals, &residuals);
                if after < before || (before < 1e-20 && after < 4.0 * before) {
                    *point = next;
                    square = after;
                    damping = (damping * 0.2).max(1e-6);
                    break;
                }
                damping = (damping * 8.0).max(1e-4);
            }
            stagnant = if square > 0.98 * before { stagnant + 1 } else { 0 };
            at = self.linearise(point, values);
        }
        self.is_closed(&at.residuals) && self.is_aligned(&at.residuals)
    }

    fn is_closed(&self, residuals: &[f64]) -> bool {
        residuals.iter().take(self.equations.len()).all(|r| r.abs() < CLOSED)
    }

    fn is_aligned(&self, residuals: &[f64]) -> bool {
        residuals.iter().skip(self.equations.len()).all(|r| r.abs() < 1e-6)
    }

    fn all_residuals(&self, point: &Point, values: &mut Values) -> Vec<f64> {
        let mut residuals = self.problem.residuals(point, self.equations, values);
        self.aim(&mut residuals);
        residuals.extend(self.problem.misalignments(point, &self.alignments, values));
        residuals
    }

    fn aim(&self, residuals: &mut [f64]) {
        residuals.iter_mut().zip(&self.target).for_each(|(residual, target)| *residual -= target);
    }

    fn linearise(&self, point: &Point, values: &mut Values) -> Linearised {
        let mut at = self.problem.linearise(point, self.equations, values);
        self.aim(&mut at.residuals);
        at.residuals.extend(self.problem.misalignments(point, &self.alignments, values));
        at.rows.extend(self.problem.alignment_rows(point, &self.alignments, values));
        if !self.held.is_empty() {
            at.rows.iter_mut().for_each(|row| row.retain(|entry| !self.held[entry.0]));
        }
        at
    }

    /// The rank of the equations in the columns that are not held, if it is clear.
    pub(super) fn rank_at(&self, point: &Point, values: &mut Values) -> Option<usize> {
        let mut at = self.linearise(point, values);
        at.rows.truncate(self.equations.len());
        self.configuration(point.clone(), &at, true).rank
    }

    /// Rows of unit length or zero at a point, over the group's columns.
    pub(super) fn jacobian_at(&self, point: &Point, values: &mut Values) -> Vec<Vec<f64>> {
        let at = self.problem.linearise(point, self.equations, values);
        self.jacobian(&at)
    }

    /// J J^T
    fn normal(&self, rows: &[Vec<(usize, f64)>]) -> Vec<Vec<f64>> {
        let mut dense = vec![0.0; self.problem.columns.len()];
        let mut normal = Vec::with_capacity(rows.len());
        for (i, row) in rows.iter().enumerate() {
            for &(column, entry) in row {
                dense[column] = entry;
            }
            let mut list = Vec::with_capacity(rows.len());
            for other in &rows[..=i] {
                let mut sum = 0.0;
                for &(column, entry) in other {
                    sum += entry * dense[column];
                }
                list.push(sum);
            }
            normal.push(list);
            for &(column, _) in row {
                dense[column] = 0.0;
            }
        }
        normal
    }

    /// -J^T (J J^T + damping)^-1 r, cut to a bounded length.
    fn step(&self, normal: &[Vec<f64>], at: &Linearised, damping: f64) -> Vec<f64> {
        let multipliers = solve(normal, &at.residuals, damping);
        let mut step = vec![0.0; self.problem.columns.len()];
        for (row, multiplier) in at.rows.iter().zip(multipliers) {
            for &(column, entry) in row {
                step[column] -= entry * multiplier;
            }
        }
        let longest = step.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        if longest > LONGEST {
            step.iter_mut().for_each(|x| *x *= LONGEST / longest);
        }
        step
    }

    fn configuration(&self, point: Point, at: &Linearised, closed: bool) -> Configuration {
        let jacobian = self.jacobian(at);
        let values = if closed { singular_values(&jacobian) } else { Vec::new() };
        let rank = if closed { clear_rank(&values) } else { None };
        let value = |k: Option<usize>| k.and_then(|k| values.get(k)).copied().unwrap_or(0.0);
        let gap = (value(rank.and_then(|rank| rank.checked_sub(1))), value(rank));
        Configuration { point, jacobian, closed, rank, gap }
    }

    /// Rows of unit length or zero, over the group's columns.
    fn jacobian(&self, at: &Linearised) -> Vec<Vec<f64>> {
        let mut place = vec![usize::MAX; self.problem.columns.len()];
        for (k, &column) in self.columns.iter().enumerate() {
            place[column] = k;
        }
        let rows = at.rows.iter().take(self.equations.len()).map(|row| {
            let mut dense = vec![0.0; self.columns.len()];
            for &(column, entry) in row {
                if let Some(slot) = dense.get_mut(place[column]) {
                    *slot += entry;
                }
            }
            // Gradients that vanish there, as a cosine's does at one, stay zero and don't become noise.
            let norm = dot(&dense, &dense).sqrt();
            let factor = if norm > 1e-7 { 1.0 / norm } else { 0.0 };
            dense.iter_mut().for_each(|x| *x *= factor);
            dense
        });
        rows.collect()
    }
}

/// (A + damping) x = b by Cholesky; A is symmetric, given by its lower triangle, and semidefinite.
fn solve(a: &[Vec<f64>], b: &[f64], damping: f64) -> Vec<f64> {
    let trace = a.iter().enumerate().map(|(k, row)| row[k]).fold(0.0, f64::max);
    let floor = 1e-13 * trace + f64::MIN_POSITIVE;
    let mut lower: Vec<Vec<f64>> = Vec::with_capacity(a.len());
    for (i, row) in a.iter().enumerate() {
        let mut list: Vec<f64> = Vec::with_capacity(i + 1);
        for (j, above) in lower.iter().enumerate() {
            let sum = row[j] - dot(&list, &above[..j]);
            list.push(sum / above[j]);
        }
        let rest = row[i] + damping + floor - dot(&list, &list);
        list.push(rest.max(floor).sqrt());
        lower.push(list);
    }
    let mut x: Vec<f64> = Vec::with_capacity(b.len());
    for (i, row) in lower.iter().enumerate() {
        let rest = b[i] - dot(&row[..i], &x);
        x.push(rest / row[i]);
    }
    for i in (0..x.len()).rev() {
        x[i] /= lower[i][i];
        let value = x[i];
        add(&mut x[..i], -value, &lower[i]);
    }
    x
}
