//! Stage `mechanics`: which equations of velocities keep multipliers.
//!
//! In: the equations as numbers, closed configurations. Out: all of them behind those of positions, but for what depends on
//! equations before it, of positions or of velocities, in all these configurations and asks for the same: rows of analytic
//! functions that depend on each other at random poses, and with other parameters where loops are closed for these, do so everywhere.
//! Where the functions are in pieces, follow time, drives or states of the user's own, or are what they are for the declared parameters
//! alone, poses prove nothing, unless the row follows from others of velocities that are plain, drives or none, at open poses too: as that of the
//! second wheel of an axle does, whoever steers. Such a row is refused: rounding would decide which of the rows is kept, and positions are
//! moved by rows of positions alone.

use crate::invariant::fault::raise;
use crate::mechanics::loops::constraints::row_name;
use crate::mechanics::loops::structure::{Role, Row, Structure};
use crate::model::site::Sited;
use crate::model::types::{LoopClosure, Model};

use super::Complaint;

use super::configurations::Search;
use super::problem::{Point, Problem, Random, Source};
use super::speeds;
use super::tape::Values;

/// Poses that are looked at where no loop says which there are.
const POSES: usize = 9;
/// What is left of a row that depends on others, as a share of it.
const DEPENDENT: f64 = 1e-9;
/// Of the poses with other parameters, the least that tell of anything that holds everywhere.
const LEAST: usize = 2;
/// Parameters are off their defaults by about this much.
pub(super) const OFF: f64 = 0.1;
/// The latest time that is looked at. [s]
pub(super) const LATE: f64 = 7.0;

/// A row of the whole mechanism: slopes, and what is left at rest.
type Gradient = (Vec<f64>, f64);

/// What a row is beside those before it, at one pose.
#[derive(Clone, Copy, PartialEq)]
enum Beside {
    Independent,
    Follows,
    Contradicts,
}

pub(super) fn keep(model: &Model, problem: &Problem, structure: &mut Structure) -> Vec<Complaint> {
    if problem.rates.is_empty() {
        return Vec::new();
    }
    let (mut kept, mut names, mut complaints) = (Vec::new(), Vec::new(), Vec::new());
    let points = points(problem, structure);
    let before = structure.clone();
    let judge = Judge { model, problem, structure: &before, points: &points, is_open: false };
    let proof = judge.is_proof();
    for (number, rate) in problem.rates.iter().enumerate() {
        let name = row_name(model, rate.row.closing, rate.row.index);
        // What is zero whatever moves, such as the slip aside of a wheel in a plane.
        if rate.is_nothing {
            names.push(format!("`{name}`"));
            structure.dropped.push(rate.row);
            continue;
        }
        let found = judge.at_all(problem, number, &kept);
        if found.contains(&Beside::Independent) {
            structure.scales.insert(rate.row, judge.scale(number));
            kept.push(number);
            continue;
        }
        let partners = judge.partners(number, &kept);
        let anywhere = if proof { None } else { judge.anywhere(problem, number, &kept) };
        let robust = || {
            let moved = problem.moved(model, OFF);
            match anywhere {
                Some(_) => judge.anywhere(&moved, number, &kept) == anywhere,
                None => judge.with_other_parameters(&moved, number, &kept),
            }
        };
        let follows = match proof {
            true => found.iter().all(|&one| one == Beside::Follows),
            false => anywhere == Some(Beside::Follows),
        };
        if follows && robust() {
            let from = partners.map_or(String::new(), |partners| format!(" (from {partners})"));
            names.push(format!("`{name}`{from}"));
            structure.dropped.push(rate.row);
            continue;
        }
        let others = || partners.unwrap_or_else(|| "others".to_owned());
        let LoopClosure::Constraint(id) = rate.row.closing else { raise("equations of velocities are constraints") };
        let (message, help) = match () {
            () if !judge.moves(number) => {
                (format!("the constraint `{name}` is of velocities, but none that is free has a say in it"), None)
            }
            () if (proof && found.contains(&Beside::Contradicts)) || anywhere == Some(Beside::Contradicts) => {
                (format!("the constraint `{name}` contradicts {}: their velocities leave none for it", others()), None)
            }
            () => (
                format!(
                    "the constraint `{name}` follows from {}, or contradicts that, wherever it was looked at",
                    others()
                ),
                Some(
                    "whether it does so with any parameters, at any time and in all pieces of its functions is not known: leave it out, or an \
                      equation that it depends on",
                ),
            ),
        };
        let help = help.map(str::to_owned);
        complaints.push(Complaint { at: model.constraints[id].site(), message, help });
    }
    if !names.is_empty() {
        let names = names.join(", ");
        let evidence = format!("they follow from others at {} poses", points.len());
        structure.notes.push(format!("redundant equations of velocities, left out: {names}; {evidence}"));
    }
    let kept = kept.into_iter().map(|number| problem.rates[number].row);
    let list = if speeds::eliminates(model) { &mut structure.rates.rows } else { &mut structure.rows };
    list.extend(kept);
    complaints
}

/// Closed configurations, or random ones, at times of their own. Those where equations have no slopes, as those of a disc that lies flat,
/// say nothing, and are left out.
pub(super) fn points(problem: &Problem, structure: &Structure) -> Vec<Point> {
    let mut random = Random(0x8011E5);
    let mut points: Vec<Point> = structure.closed.iter().map(|closed| problem.at(&closed.positions)).collect();
    if problem.equations.is_empty() || points.is_empty() {
        points = (0..POSES).map(|_| problem.start(&mut random, 1.0)).collect();
    }
    for point in &mut points {
        problem.put_time(point, LATE * random.next().abs());
        problem.put_states(point, &mut random);
    }
    let mut values = Values::default();
    let clear: Vec<bool> = points.iter().map(|point| problem.has_slopes(point, &mut values)).collect();
    // Nowhere any slopes: then all that is said of them fails.
    if clear.contains(&true) {
        let mut clear = clear.into_iter();
        points.retain(|_| clear.next() == Some(true));
    }
    points
}

struct Judge<'a> {
    model: &'a Model,
    problem: &'a Problem,
    structure: &'a Structure,
    points: &'a [Point],
    /// Equations of positions hold nothing, and drives neither.
    is_open: bool,
}

impl Judge<'_> {
    /// Whether what holds at random poses holds everywhere.
    fn is_proof(&self) -> bool {
        let problem = self.problem;
        let positions = 0..problem.equations.len();
        let driven = |k: usize| matches!(self.structure.role(problem.columns[k].coordinate), Role::Driven(_));
        let plain = |k: usize| problem.is_analytic(k) && !problem.equations[k].timed;
        positions.into_iter().all(plain) && problem.are_rates_plain() && !(0..problem.columns.len()).any(driven)
    }

    /// What an equation is beside those of positions and those that are kept, pose by pose.
    fn at_all(&self, problem: &Problem, number: usize, kept: &[usize]) -> Vec<Beside> {
        self.points.iter().map(|point| self.beside(problem, point, number, kept)).collect()
    }

    /// What a plain equation is beside plain ones at random poses, loops open, if it depends on them at all of these.
    fn anywhere(&self, problem: &Problem, number: usize, kept: &[usize]) -> Option<Beside> {
        if !problem.is_rate_plain(number) {
            return None;
        }
        let plain: Vec<usize> = kept.iter().copied().filter(|&k| problem.is_rate_plain(k)).collect();
        let (mut random, mut values) = (Random(0x0FE4), Values::default());
        let mut points: Vec<Point> = (0..POSES).map(|_| problem.start(&mut random, 1.0)).collect();
        points.retain(|point| problem.has_slopes(point, &mut values));
        let found = Judge { points: &points, is_open: true, ..*self }.at_all(problem, number, &plain);
        match () {
            () if found.len() < LEAST || found.contains(&Beside::Independent) => None,
            () if found.contains(&Beside::Contradicts) => Some(Beside::Contradicts),
            () => Some(Beside::Follows),
        }
    }

    /// Whether it follows with other parameters too: where loops are closed for these, since the equations may read no parameter that moves
    /// what closes. Loops that don't close with them are looked at where they stand.
    fn with_other_parameters(&self, moved: &Problem, number: usize, kept: &[usize]) -> bool {
        let closed = self.closed_again(moved);
        let points = if closed.len() >= LEAST { &closed } else { self.points };
        let judge = Judge { points, ..*self };
        judge.at_all(moved, number, kept).iter().all(|&one| one == Beside::Follows)
    }

    /// Its poses, moved to where the equations of positions are closed for the parameters of another problem.
    fn closed_again(&self, moved: &Problem) -> Vec<Point> {
        let equations = self.of_positions(moved);
        let columns: Vec<usize> = (0..moved.columns.len()).collect();
        let search = Search::new(moved, &equations, &columns);
        let mut values = Values::default();
        let points = self.points.iter().map(|point| placed(moved, point));
        points.filter_map(|mut point| search.close(&mut point, &mut values).then_some(point)).collect()
    }

    /// Equations of positions that are independent.
    fn of_positions(&self, problem: &Problem) -> Vec<usize> {
        let own = |row: Row| self.structure.independent.contains(&row);
        (0..problem.equations.len())
            .filter(|&k| matches!(problem.equations[k].source, Source::Row(row) if own(row)))
            .collect()
    }

    /// Whether any velocity that no drive gives has a say in it.
    fn moves(&self, number: usize) -> bool {
        let mut values = Values::default();
        self.points.iter().any(|point| {
            let row = &self.problem.rates_at(point, &mut values).rows[number];
            let driven =
                |column: usize| matches!(self.structure.role(self.problem.columns[column].coordinate), Role::Driven(_));
            row.iter().any(|&(column, entry)| !driven(column) && entry != 0.0)
        })
    }

    /// The names of equations of velocities without any one of which this would be independent; nothing where there are none, as where
    /// it depends on positions alone.
    fn partners(&self, number: usize, kept: &[usize]) -> Option<String> {
        let needed = |without: &&usize| {
            let rest: Vec<usize> = kept.iter().copied().filter(|k| k != *without).collect();
            self.at_all(self.problem, number, &rest).contains(&Beside::Independent)
        };
        let name = |&k: &usize| {
            let row = self.problem.rates[k].row;
            format!("`{}`", row_name(self.model, row.closing, row.index))
        };
        let names: Vec<String> = kept.iter().filter(needed).map(name).collect();
        (!names.is_empty()).then(|| names.join(", "))
    }

    /// The greatest length of its row.
    fn scale(&self, number: usize) -> f64 {
        let mut values = Values::default();
        let length = |point: &Point| {
            self.problem.rates_at(point, &mut values).rows[number].iter().map(|x| x.1 * x.1).sum::<f64>().sqrt()
        };
        self.points.iter().map(length).fold(0.0, f64::max)
    }

    fn beside(&self, problem: &Problem, point: &Point, number: usize, kept: &[usize]) -> Beside {
        let point = placed(problem, point);
        let mut values = Values::default();
        let dense = |row: &[(usize, f64)]| {
            let mut dense = vec![0.0; problem.columns.len()];
            for &(column, entry) in row {
                let driven = matches!(self.structure.role(problem.columns[column].coordinate), Role::Driven(_));
                dense[column] += if driven && !self.is_open { 0.0 } else { entry };
            }
            dense
        };
        let of_positions = if self.is_open { Vec::new() } else { self.of_positions(problem) };
        let positions = problem.linearise(&point, &of_positions, &mut values);
        let rates = problem.rates_at(&point, &mut values);
        let mut basis: Vec<Gradient> = Vec::new();
        let before = positions.rows.iter().map(|row| (dense(row), 0.0));
        let before = before.chain(kept.iter().map(|&k| (dense(&rates.rows[k]), rates.residuals[k])));
        for gradient in before {
            let size = length(&gradient.0);
            let mut left = without(gradient, &basis);
            let rest = length(&left.0);
            if rest > DEPENDENT * size {
                left.0.iter_mut().for_each(|x| *x /= rest);
                left.1 /= rest;
                basis.push(left);
            }
        }
        let gradient = (dense(&rates.rows[number]), rates.residuals[number]);
        let size = length(&gradient.0);
        let left = without(gradient, &basis);
        if length(&left.0) > DEPENDENT * size {
            return Beside::Independent;
        }
        match left.1.abs() <= DEPENDENT * (size + rates.residuals[number].abs()) {
            true => Beside::Follows,
            false => Beside::Contradicts,
        }
    }
}

/// Parameters are part of a point: those of the problem are put in.
fn placed(problem: &Problem, point: &Point) -> Point {
    let mut own = problem.at(&problem.positions(point));
    problem.time_at(point).into_iter().for_each(|time| problem.put_time(&mut own, time));
    problem.take_states(&mut own, point);
    own
}

fn length(row: &[f64]) -> f64 {
    row.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// Less what lies along unit rows; twice, for the digits that the first time has lost.
fn without(gradient: Gradient, basis: &[Gradient]) -> Gradient {
    let (mut row, mut rest) = gradient;
    for (unit, of_unit) in basis.iter().chain(basis) {
        let along: f64 = row.iter().zip(unit).map(|(a, b)| a * b).sum();
        row.iter_mut().zip(unit).for_each(|(x, u)| *x -= along * u);
        rest -= along * of_unit;
    }
    (row, rest)
}
