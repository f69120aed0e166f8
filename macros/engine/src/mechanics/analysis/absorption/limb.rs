//! Stage `mechanics`: the volume that equations span in some columns, over the poses of their loops.
//!
//! In: equations, columns, a closed configuration. Out: closed poses at random and along one column, with parameters and time
//! moved; the volume there. Columns of roll, pitch and yaw count as the angular velocity that they make.

use std::cell::OnceCell;

use crate::mechanics::analysis::configurations::Search;
use crate::mechanics::analysis::problem::{Point, Problem, Random};
use crate::mechanics::analysis::rank::Basis;
use crate::mechanics::analysis::singular::dot;
use crate::mechanics::analysis::tape::Values;
use crate::model::types::LoopClosure;

/// A row is absorbed if this much of it is: squares of it are what pivots lose.
const LEAST: f64 = 0.03;

/// Volumes are the same that differ by less, loops being closed to ten digits.
const SAME: f64 = 1e-7;

/// Random poses, how many have to close, and how many of these with parameters and time moved.
const POSES: usize = 12;
const LEAST_POSES: usize = 6;
const LEAST_MOVED: usize = 3;

/// How far travels go in them from where they are by default, in units of the mechanism's size: most are near, some far.
const TRAVELS: [f64; 4] = [0.2, 0.5, 1.0, 3.0];

/// By how much of themselves parameters are off their defaults in every other one; those that are zero by as much of one.
const PARAMETERS: [f64; 4] = [0.5, 0.1, 0.3, 0.03];

/// Steps along one column, either way: half a turn and the other half, since what is assumed may rule out one way alone; or two
/// sizes of the mechanism, and some that grow beyond these.
const STEPS: usize = 20;
const TURN: f64 = std::f64::consts::PI;
const FAR: f64 = 2.0;
const FARTHER: usize = 8;
const GROWTH: f64 = 1.25;

/// What is left of a step in front of what is ruled out.
const LAST: f64 = 0.05;

/// Of longer limbs there are too many pairs to look at.
const MOST_PAIRED: usize = 4;

/// How often a step is halved where the volume falls fast.
const HALVES: usize = 4;

/// Closings with the columns that keep them closed.
#[derive(Clone, PartialEq, Eq, Hash)]
pub(super) struct Loop {
    pub(super) closings: Vec<LoopClosure>,
    pub(super) moving: Vec<usize>,
}

/// A pose, and how far along it is.
struct Stop {
    at: f64,
    pose: Point,
}

/// Poses along one column, from a pose that it is measured by.
struct Way {
    column: usize,
    from: Point,
    stops: Vec<Stop>,
    /// Whether the user lets it go on.
    goes_on: bool,
}

/// Closed poses at random, as many as were asked for.
pub(super) struct Drawn {
    random: Random,
    tried: usize,
    points: Vec<Point>,
}

/// Poses for one column, or for two, as far as they were asked for.
pub(super) struct Along {
    columns: Vec<usize>,
    random: Random,
    tried: usize,
    /// Two in which these are the same, and parameters and time are.
    pairs: Vec<[Point; 2]>,
    /// Of two columns: two poses, and the same with the first column's values exchanged.
    exchanged: OnceCell<Vec<[Point; 4]>>,
    /// Ways along them, in steps, as far as the user lets them go; nothing where one does not come as far.
    ways: OnceCell<Option<Vec<Way>>>,
}

impl Drawn {
    /// The first is where things stand by default.
    pub(super) fn new(first: &Point) -> Drawn {
        Drawn { random: Random(0x00AB_504B), tried: 0, points: vec![first.clone()] }
    }
}

impl Along {
    pub(super) fn new(columns: Vec<usize>) -> Along {
        let (random, exchanged, ways) = (Random(0x51DE), OnceCell::new(), OnceCell::new());
        Along { columns, random, tried: 0, pairs: Vec::new(), exchanged, ways }
    }
}

/// What rows span in some columns.
pub(super) struct Volume {
    size: f64,
    /// The least part of a row, of all it is, that is new in these columns.
    share: f64,
}

impl Volume {
    pub(super) fn is_like(&self, other: &Volume) -> bool {
        (self.size - other.size).abs() <= SAME * other.size
    }

    pub(super) fn is_great(&self) -> bool {
        self.share > LEAST
    }

    pub(super) fn size(&self) -> f64 {
        self.size
    }

    /// Whether there is more of it, and rows are well in it.
    pub(super) fn is_beyond(&self, size: f64) -> bool {
        self.size > size && self.share > 2.0 * LEAST
    }
}

/// Equations in some columns.
pub(super) struct Limb<'a> {
    problem: &'a Problem,
    /// What stays closed, and all that moves to keep it so.
    loops: &'a [usize],
    pub(super) moving: Vec<usize>,
    equations: &'a [usize],
    columns: &'a [usize],
    /// Symbols of parameters that may have other values.
    parameters: Vec<usize>,
}

impl<'a> Limb<'a> {
    pub(super) fn new(
        problem: &'a Problem,
        pinned: &[(usize, usize)],
        loops: &'a [usize],
        equations: &'a [usize],
        columns: &'a [usize],
    ) -> Limb<'a> {
        let free = problem.parameters_of(loops).into_iter().filter(|(_, parameter)| !pinned.contains(parameter));
        let parameters = free.map(|(symbol, _)| symbol).collect();
        Limb { problem, loops, moving: columns_of(problem, loops), equations, columns, parameters }
    }

    /// Number k of the closed poses at random, if there are as many. In every other one parameters and time are moved.
    fn pose<'d>(&self, drawn: &'d mut Drawn, k: usize, values: &mut Values) -> Option<&'d Point> {
        while drawn.points.len() <= k && drawn.tried < POSES {
            let number = drawn.tried;
            drawn.tried += 1;
            let mut point = drawn.points[0].clone();
            if number % 2 == 1 {
                let far = PARAMETERS[number / 2 % PARAMETERS.len()];
                for &symbol in &self.parameters {
                    let size = if point.0[symbol] == 0.0 { 1.0 } else { point.0[symbol] };
                    point.0[symbol] += far * size * drawn.random.next();
                }
                self.problem.put_time(&mut point, 0.5 + 0.5 * drawn.random.next());
            }
            let far = TRAVELS[number / 2 % TRAVELS.len()];
            if self.shake(&mut point, far, &[], &mut drawn.random, values) {
                drawn.points.push(point);
            }
        }
        drawn.points.get(k)
    }

    /// Whether the volume is the same in all of them, and great enough; nothing where it is not the same.
    pub(super) fn is_constant(&self, drawn: &mut Drawn, values: &mut Values) -> Option<bool> {
        let first = self.volume(&drawn.points[0], values);
        let mut great = first.is_great();
        let mut k = 1;
        while let Some(pose) = self.pose(drawn, k, values) {
            let volume = self.volume(pose, values);
            if !volume.is_like(&first) {
                return None;
            }
            great &= volume.is_great();
            k += 1;
        }
        let moved = self.moved(&drawn.points).count();
        Some(great && k >= LEAST_POSES && (!self.moves() || moved >= LEAST_MOVED))
    }

    /// Whether parameters or time have a say.
    fn moves(&self) -> bool {
        !self.parameters.is_empty() || self.loops.iter().any(|&k| self.problem.equations[k].timed)
    }

    /// Those in which they are not as in the first.
    fn moved<'p>(&self, points: &'p [Point]) -> impl Iterator<Item = &'p Point> {
        let first = &points[0];
        let time = |point: &Point| self.problem.time_at(point);
        let other = move |point: &&Point| {
            time(point) != time(first) || self.parameters.iter().any(|&symbol| point.0[symbol] != first.0[symbol])
        };
        points.iter().filter(other)
    }

    /// Moves everything at random but for what is held, and closes the loops again.
    fn shake(&self, point: &mut Point, far: f64, held: &[bool], random: &mut Random, values: &mut Values) -> bool {
        let mut step = vec![0.0; self.problem.columns.len()];
        for &column in self.moving.iter().filter(|&&column| held.get(column) != Some(&true)) {
            step[column] = random.next() * if self.problem.columns[column].travels { far } else { TURN };
        }
        self.problem.displace(point, &step);
        self.close(point, held, values)
    }

    fn close(&self, point: &mut Point, held: &[bool], values: &mut Values) -> bool {
        let search = Search::new(self.problem, self.loops, &self.moving).holding(held).alone();
        search.close(point, values) && !self.problem.locks(point, &self.moving)
    }

    pub(super) fn volume(&self, point: &Point, values: &mut Values) -> Volume {
        let mut volume = Volume { size: 1.0, share: 1.0 };
        let mut basis = Basis::default();
        for row in self.problem.linearise(point, self.equations, values).rows {
            let mut dense = vec![0.0; self.problem.columns.len()];
            row.into_iter().for_each(|(column, entry)| dense[column] += entry);
            self.problem.turn_rates(point, self.columns, &mut dense);
            let all = dot(&dense, &dense).sqrt();
            let part: Vec<f64> = self.columns.iter().map(|&column| dense[column]).collect();
            let rest = basis.rest(&part);
            let new = dot(&rest, &rest).sqrt();
            volume.size *= new;
            volume.share = volume.share.min(new / all);
            if !basis.grow(&part, 0.0) {
                return Volume { size: 0.0, share: 0.0 };
            }
        }
        if volume.share.is_finite() { volume } else { Volume { size: f64::NAN, share: 0.0 } }
    }

    /// Number k of the pairs of poses for columns, if there are as many.
    fn pair<'p>(
        &self,
        along: &'p mut Along,
        drawn: &mut Drawn,
        k: usize,
        values: &mut Values,
    ) -> Option<&'p [Point; 2]> {
        let held = self.holding(&along.columns);
        while along.pairs.len() <= k {
            let point = self.pose(drawn, along.tried, values)?;
            let mut other = point.clone();
            let far = TRAVELS[along.tried % TRAVELS.len()];
            along.tried += 1;
            if self.shake(&mut other, far, &held, &mut along.random, values) {
                along.pairs.push([point.clone(), other]);
            }
        }
        along.pairs.get(k)
    }

    fn holding(&self, columns: &[usize]) -> Vec<bool> {
        (0..self.problem.columns.len()).map(|column| columns.contains(&column)).collect()
    }

    /// Pairs of poses with the first of two columns exchanged: f(a, b) f(c, d) is f(c, b) f(a, d) where f is a product.
    fn exchanged(&self, along: &Along, drawn: &mut Drawn, values: &mut Values) -> Vec<[Point; 4]> {
        let &[first, _] = along.columns.as_slice() else { return Vec::new() };
        let (held, mut random) = (self.holding(&along.columns), Random(0xE8C4));
        let (mut all, mut k) = (Vec::new(), 0);
        while let Some(one) = self.pose(drawn, k, values).cloned() {
            let far = TRAVELS[k % TRAVELS.len()];
            k += 1;
            let mut other = one.clone();
            if !self.shake(&mut other, far, &[], &mut random, values) {
                continue;
            }
            let mut put = |to: &Point, from: &Point| {
                let way = self.value(from, first)? - self.value(to, first)?;
                let mut pose = to.clone();
                let mut step = vec![0.0; self.problem.columns.len()];
                step[first] = way / self.problem.columns[first].unit;
                self.problem.displace(&mut pose, &step);
                self.shake(&mut pose, far, &held, &mut random, values).then_some(pose)
            };
            if let Some((here, there)) = put(&one, &other).zip(put(&other, &one)) {
                all.push([one, other, here, there]);
            }
        }
        all
    }

    /// Ways along columns from where things stand by default, and with parameters and time moved. Along two, each goes from
    /// there, and the second from both ends of the first too.
    fn ways(&self, columns: &[usize], drawn: &mut Drawn, values: &mut Values) -> Option<Vec<Way>> {
        while self.pose(drawn, drawn.points.len(), values).is_some() {}
        let all = std::iter::once(&drawn.points[0]).chain(self.moved(&drawn.points).take(LEAST_MOVED));
        let mut may = |point: &&Point| columns.iter().all(|&column| self.problem.is_assumed(point, column, values));
        let starts: Vec<&Point> = all.filter(&mut may).collect();
        if starts.len() <= usize::from(self.moves()) {
            return None;
        }
        let mut ways = Vec::new();
        for from in starts {
            let mut corners = vec![from.clone()];
            for &column in columns {
                for corner in std::mem::take(&mut corners) {
                    for direction in [1.0, -1.0] {
                        let (stops, goes_on) = self.way(columns, column, direction, &corner, values)?;
                        corners.extend(stops.last().map(|stop| stop.pose.clone()));
                        ways.push(Way { column, from: from.clone(), stops, goes_on });
                    }
                }
                corners.push(from.clone());
            }
        }
        Some(ways)
    }

    /// From a pose along one column, others held, to where the user lets it go no further, or far away, which is told; nothing where
    /// loops don't close before that, or where a travel may be beyond what is ruled out too. What is assumed of columns that are
    /// not held makes no difference, as these make none to the volume.
    fn way(
        &self,
        held: &[usize],
        column: usize,
        direction: f64,
        first: &Point,
        values: &mut Values,
    ) -> Option<(Vec<Stop>, bool)> {
        let held = self.holding(held);
        let mut random = Random(0x57E9);
        let travels = self.problem.columns[column].travels;
        let mut length = direction * if travels { FAR } else { TURN } / STEPS as f64;
        let steps = STEPS + if travels { FARTHER } else { STEPS };
        let mut step = vec![0.0; self.problem.columns.len()];
        let mut stops = vec![Stop { at: 0.0, pose: first.clone() }];
        let mut part = 1.0;
        while stops.len() <= steps && part > LAST {
            let Stop { at, pose } = &stops[stops.len() - 1];
            let (at, mut pose) = (at + part * length, pose.clone());
            step[column] = part * length;
            self.problem.displace(&mut pose, &step);
            if !self.problem.is_assumed(&pose, column, values) {
                part *= 0.5;
                continue;
            }
            let mut tries = TRAVELS.iter();
            let start = pose.clone();
            let mut closes = self.close(&mut pose, &held, values);
            while !closes {
                pose.clone_from(&start);
                closes = self.shake(&mut pose, *tries.next()?, &held, &mut random, values);
            }
            stops.push(Stop { at, pose });
            if travels && stops.len() > STEPS {
                length *= GROWTH;
            }
        }
        let goes_on = part == 1.0;
        let mut beyond = stops.last().map_or_else(|| first.clone(), |stop| stop.pose.clone());
        step[column] = length;
        for _ in 0..if goes_on || !travels { 0 } else { steps } {
            self.problem.displace(&mut beyond, &step);
            if self.problem.is_assumed(&beyond, column, values) {
                return None;
            }
        }
        Some((stops, goes_on))
    }

    /// Whether something is hoped of two columns together: of those of a short limb.
    pub(super) fn may_hope_of(&self, columns: &[usize]) -> bool {
        columns.len() == 1
            || self.columns.len() <= MOST_PAIRED && columns.iter().all(|column| self.columns.contains(column))
    }

    /// What a column is at a pose, if it is a number by itself.
    pub(super) fn value(&self, point: &Point, column: usize) -> Option<f64> {
        self.problem.value_of(point, column)
    }

    pub(super) fn travels(&self, column: usize) -> bool {
        self.problem.columns[column].travels
    }

    /// Half a turn, or so many sizes of the mechanism.
    pub(super) fn reach(&self, column: usize, far: f64) -> f64 {
        if self.problem.columns[column].travels { far } else { TURN }
    }

    /// Along one column, others held, with the loops closed again.
    pub(super) fn moved_along(
        &self,
        held: &[usize],
        column: usize,
        way: f64,
        from: &Point,
        values: &mut Values,
    ) -> Option<Point> {
        let mut step = vec![0.0; self.problem.columns.len()];
        step[column] = way;
        let mut pose = from.clone();
        self.problem.displace(&mut pose, &step);
        self.close(&mut pose, &self.holding(held), values).then_some(pose)
    }

    /// Whether the volume depends on these columns alone, as a product of a function of each.
    pub(super) fn depends(&self, along: &mut Along, drawn: &mut Drawn, values: &mut Values) -> bool {
        for k in 0..LEAST_POSES {
            let Some([one, other]) = self.pair(along, drawn, k, values) else { return false };
            let volume = self.volume(one, values);
            if !self.volume(other, values).is_like(&volume) {
                return false;
            }
        }
        along.columns.len() == 1 || {
            let exchanged = along.exchanged.get_or_init(|| self.exchanged(along, drawn, values));
            let mut is_product = |poses: &[Point; 4]| {
                let [one, other, here, there] = poses.each_ref().map(|pose| self.volume(pose, values).size);
                (one * other - here * there).abs() <= SAME * one * other
            };
            exchanged.len() >= LEAST_POSES && exchanged.iter().all(&mut is_product)
        }
    }

    /// Whether the volume depends on these columns alone, and vanishes nowhere along them.
    pub(super) fn stays(&self, along: &mut Along, drawn: &mut Drawn, values: &mut Values) -> bool {
        if !self.depends(along, drawn, values) {
            return false;
        }
        let Some(ways) = along.ways.get_or_init(|| self.ways(&along.columns, drawn, values)) else { return false };
        // What is left of it along each column from where it starts: together their product.
        let mut least = vec![1.0_f64; along.columns.len()];
        let all = ways.iter().all(|way| {
            let first = self.volume(&way.from, values).size;
            let volumes: Vec<Volume> = way.stops.iter().map(|stop| self.volume(&stop.pose, values)).collect();
            let parts = volumes.iter().map(|volume| self.part(volume, first)).fold(1.0, f64::min);
            let own = along.columns.iter().position(|&column| column == way.column);
            if let Some(k) = own {
                least[k] = least[k].min(parts);
            }
            // Where nothing ends the way, all comes again after a whole turn, or what is left of the volume grows.
            let ends_well = |last: &Volume| {
                let before = &volumes[volumes.len().saturating_sub(2)];
                last.is_like(&volumes[0]) || last.size >= before.size
            };
            let ends = !way.goes_on || volumes.last().is_none_or(ends_well);
            let stops: Vec<(&Stop, Volume)> = way.stops.iter().zip(volumes).collect();
            ends && stops[0].1.is_great()
                && stops.windows(2).all(|two| {
                    let between = Between { held: &along.columns, column: way.column, first };
                    self.stays_between(between, [&two[0], &two[1]], HALVES, values)
                })
        });
        all && least.iter().product::<f64>() > LEAST
    }

    /// By how much each row is shorter than in another pose, on the average.
    fn part(&self, volume: &Volume, first: f64) -> f64 {
        (volume.size / first).powf(1.0 / self.equations.len() as f64)
    }

    /// Whether it vanishes nowhere between two poses, in parts of what it is in a third one: it may fall there as much again as it
    /// changes, and so may the part that each row has in it.
    fn stays_between(
        &self,
        between: Between<'_>,
        [one, other]: [&(&Stop, Volume); 2],
        halves: usize,
        values: &mut Values,
    ) -> bool {
        let stays = |one: f64, other: f64| one.min(other) - (one - other).abs() > LEAST;
        let part = |volume: &Volume| self.part(volume, between.first);
        if stays(one.1.share, other.1.share) && stays(part(&one.1), part(&other.1)) {
            return true;
        }
        if halves == 0 || !one.1.is_great() || !other.1.is_great() {
            return false;
        }
        let half = 0.5 * (other.0.at - one.0.at);
        let Some(pose) = self.moved_along(between.held, between.column, half, &one.0.pose, values) else {
            return false;
        };
        let volume = self.volume(&pose, values);
        let middle = (&Stop { at: one.0.at + half, pose }, volume);
        self.stays_between(between, [one, &middle], halves - 1, values)
            && self.stays_between(between, [&middle, other], halves - 1, values)
    }
}

/// The way that two poses stand on, and the volume that theirs are measured by.
#[derive(Clone, Copy)]
struct Between<'w> {
    held: &'w [usize],
    column: usize,
    first: f64,
}

fn columns_of(problem: &Problem, equations: &[usize]) -> Vec<usize> {
    let mut columns: Vec<usize> =
        equations.iter().flat_map(|&k| problem.equations[k].columns.iter().copied()).collect();
    columns.sort_unstable();
    columns.dedup();
    columns
}
