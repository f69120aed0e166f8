//! Stage `mechanics`: which velocities a model has, where they are not the rates of all coordinates of its state.
//!
//! In: equations and speeds of the user's choice as numbers, closed configurations. Out: velocity coordinates, and the rates that follow
//! from them. At any configuration the equations of positions J and those of velocities A that are eliminated, without those that keep
//! multipliers, and the speeds U leave the rest of all motions free. Rates of as many coordinates as that has dimensions are velocities too: those for which the
//! volume that the rest spans in them is greatest where it is least, over all configurations (of an orthonormal basis of the rest, the
//! determinant of their rows), so that the equations for the other rates are as far from singular as any choice leaves them. Choices that
//! are singular where coordinates are declared to stand are taken only if all are.
//!
//! A speed takes the place of rates that it reads. Where speeds leave more rates open than there are coordinates that none of them reads,
//! which rate is to stay a velocity is the user's to say.

use crate::mechanics::loops::constraints::coordinate_name;
use crate::mechanics::loops::structure::{Role, Row, Structure};
use crate::model::site::Sited;
use crate::model::types::{Coordinate, Handling, Model, Request};

use super::Complaint;
use super::configurations;
use super::orthonormal::{complement, unit, without};
use super::problem::{Point, Problem, Source};
use super::rates::points;
use super::singular::dot;
use super::tape::Values;

/// What is left of a row that depends on others, as a share of it.
const DEPENDENT: f64 = 1e-9;
/// Below this volume, at one of a few random poses, a pose where it vanishes is near.
const POOR: f64 = 0.05;
/// Of a speed that is offered as much has to be left by those before it, as a share of it, at a few random poses: less is as good as
/// nothing, and what vanishes on surfaces alone, as hinges that fold do, is seldom that near.
const CLEAR: f64 = 1e-3;
/// As many choices are looked at; beyond that coordinates are taken one by one.
const MOST_CHOICES: usize = 20_000;

/// Chooses velocities, once it is known which equations of velocities are kept.
pub(super) fn choose(model: &Model, problem: &Problem, structure: &mut Structure) -> Vec<Complaint> {
    if structure.rates.rows.is_empty() && model.speeds.is_empty() {
        return Vec::new();
    }
    let refused = refused(model);
    if !refused.is_empty() {
        return refused;
    }
    let points = points(problem, structure);
    let before = structure.clone();
    let start = configurations::start(problem);
    let choice = Choice { model, problem, structure: &before, points: &points, start: start.as_ref() };
    let rows = choice.motions(false);
    let free: Vec<Coordinate> = before.state.clone();
    let Some((held, mut size)) = rows.and_then(|rests| choice.others(&rests, &free, false)) else {
        return vec![choice.dependent_rows()];
    };
    structure.rates.held.clone_from(&held);
    structure.rates.unknowns = held;
    if !model.speeds.is_empty() {
        let Some(rests) = choice.motions(true) else { return vec![choice.dependent_speeds()] };
        if let Some(point) = choice.without_speeds() {
            return vec![Choice { points: &[point], ..choice }.speeds_in_pieces()];
        }
        let read = choice.read();
        let open: Vec<Coordinate> = free.iter().copied().filter(|coordinate| !read.contains(coordinate)).collect();
        let Some((others, left)) = choice.others(&rests, &open, true) else { return vec![choice.too_few()] };
        (structure.rates.unknowns, size) = (others, left);
    }
    let unknowns = &structure.rates.unknowns;
    let mut speeds: Vec<Coordinate> = free.into_iter().filter(|coordinate| !unknowns.contains(coordinate)).collect();
    speeds.extend((0..model.speeds.len()).map(|number| model.coordinate_of(number)));
    let names = |list: &[Coordinate]| -> String {
        let names: Vec<String> = list.iter().map(|&c| format!("`{}`", coordinate_name(model, c))).collect();
        names.join(", ")
    };
    structure.notes.push(format!("rates that follow from velocities: {}", names(&structure.rates.unknowns)));
    if size < POOR {
        let note = "in some poses these rates do not follow, and accelerations are no numbers there: `speed` items in axes that move with \
                    the mechanism may do better";
        structure.notes.push(note.to_owned());
    }
    structure.rates.speeds = speeds;
    Vec::new()
}

/// A speed at a configuration.
struct Offered {
    /// By the motions that are left there.
    along: Vec<f64>,
    /// Of its row by all coordinates.
    length: f64,
}

impl Offered {
    /// What is left of it behind others, as a share of it.
    fn share(&self, basis: &[Vec<f64>]) -> f64 {
        let left = without(self.along.clone(), basis);
        if self.length > 0.0 { dot(&left, &left).sqrt() / self.length } else { 0.0 }
    }
}

/// Of a model's speeds those to take, the clearest first: independent of the ones before them wherever loops and equations of velocities
/// leave the mechanism. Nothing where the model is refused without any.
pub fn clear_speeds(model: &Model) -> Option<Vec<usize>> {
    let structure = super::analyse(&Model { speeds: Vec::new(), ..model.clone() }).ok()?;
    let problem = Problem::written(model, structure.writing);
    let points = points(&problem, &structure);
    let choice = Choice { model, problem: &problem, structure: &structure, points: &points, start: None };
    let mut values = Values::default();
    let mut seen: Vec<Vec<Offered>> = Vec::new();
    for point in &points {
        let Some(rest) = choice.motions_at(point, false) else { continue };
        let offered = |row: Vec<(usize, f64)>| {
            let row = choice.dense(row);
            Offered { along: rest.iter().map(|unit| dot(unit, &row)).collect(), length: dot(&row, &row).sqrt() }
        };
        seen.push(problem.speeds_at(point, &mut values).into_iter().map(offered).collect());
    }
    let mut taken: Vec<usize> = Vec::new();
    let mut bases: Vec<Vec<Vec<f64>>> = vec![Vec::new(); seen.len()];
    loop {
        let share = |k: usize| {
            let shares = seen.iter().zip(&bases).map(|(offered, basis)| offered[k].share(basis));
            shares.fold(f64::INFINITY, f64::min)
        };
        let left = (0..model.speeds.len()).filter(|k| !taken.contains(k)).map(|k| (share(k), k));
        // The first of equal ones.
        let best = left.reduce(|best, one| if one.0 > best.0 * (1.0 + DEPENDENT) { one } else { best });
        let Some((_, k)) = best.filter(|best| best.0 > CLEAR && best.0.is_finite()) else { break };
        for (offered, basis) in seen.iter().zip(&mut bases) {
            let mut left = without(offered[k].along.clone(), basis);
            unit(&mut left);
            basis.push(left);
        }
        taken.push(k);
    }
    taken.sort_unstable();
    Some(taken)
}

/// What is asked for that is known in rates of coordinates alone.
fn refused(model: &Model) -> Vec<Complaint> {
    let why = match model.speeds.is_empty() {
        true => {
            "the velocities of this model are not the rates of its coordinates, since constraints of velocities are eliminated"
        }
        false => "the velocities of this model are not the rates of its coordinates",
    };
    let known = [
        (Request::Momentum, "momenta"),
        (Request::Kinematics, "kinematics"),
        (Request::AssemblyModes, "assembly modes"),
    ];
    let asked = known.into_iter().filter_map(|(request, what)| Some((model.asked_at(request)?, what)));
    let told = asked.map(|(at, what)| {
        let help = match model.speeds.is_empty() {
            true => "write `formulation { constraints: Multipliers }`, or leave it out",
            false => "leave it out, or the speeds",
        };
        Complaint { at, message: format!("{why}: {what} are known in those alone"), help: Some(help.to_owned()) }
    });
    told.collect()
}

/// An orthonormal basis of motions, by column.
type Rest = Vec<Vec<f64>>;

struct Choice<'a> {
    model: &'a Model,
    problem: &'a Problem,
    structure: &'a Structure,
    points: &'a [Point],
    /// Where coordinates are declared to stand, if loops are closed there.
    start: Option<&'a Point>,
}

impl Choice<'_> {
    /// At each configuration the motions that equations leave, and speeds if they count; nothing where rows depend on each other at all
    /// configurations. Those at which they do beside that are left out.
    fn motions(&self, with_speeds: bool) -> Option<Vec<Rest>> {
        let found: Vec<Rest> = self.points.iter().filter_map(|point| self.motions_at(point, with_speeds)).collect();
        (!found.is_empty()).then_some(found)
    }

    fn motions_at(&self, point: &Point, with_speeds: bool) -> Option<Rest> {
        let mut basis: Vec<Vec<f64>> = Vec::new();
        for row in self.rows_at(point, with_speeds) {
            let size = dot(&row, &row).sqrt();
            let left = without(row, &basis);
            let rest = dot(&left, &left).sqrt();
            // What is no number depends on everything.
            if rest.is_nan() || rest <= DEPENDENT * size {
                return None;
            }
            basis.push(left.into_iter().map(|x| x / rest).collect());
        }
        let width = self.problem.columns.len();
        // What is driven doesn't move by itself.
        for column in (0..width).filter(|&column| self.is_driven(column)) {
            let unit = (0..width).map(|k| if k == column { 1.0 } else { 0.0 }).collect();
            basis.push(unit);
        }
        Some(complement(&basis.iter().collect::<Vec<_>>(), width))
    }

    /// Equations of positions and of velocities that are eliminated, and speeds if they count, without what drives give.
    fn rows_at(&self, point: &Point, with_speeds: bool) -> Vec<Vec<f64>> {
        let problem = self.problem;
        let own = |row: Row| self.structure.independent.contains(&row) && !self.structure.rows.contains(&row);
        let of_positions: Vec<usize> = (0..problem.equations.len())
            .filter(|&k| matches!(problem.equations[k].source, Source::Row(row) if own(row)))
            .collect();
        let mut values = Values::default();
        let positions = problem.linearise(point, &of_positions, &mut values).rows;
        let rates = problem.rates_at(point, &mut values).rows;
        let eliminated = |k: &usize| self.structure.rates.rows.contains(&problem.rates[*k].row);
        let rates = (0..rates.len()).filter(eliminated).map(|k| rates[k].clone());
        let mut all: Vec<Vec<(usize, f64)>> = positions.into_iter().chain(rates).collect();
        if with_speeds {
            all.extend(problem.speeds_at(point, &mut values));
        }
        all.into_iter().map(|row| self.dense(row)).collect()
    }

    /// By all columns, without what drives give.
    fn dense(&self, row: Vec<(usize, f64)>) -> Vec<f64> {
        let mut dense = vec![0.0; self.problem.columns.len()];
        row.into_iter().filter(|x| !self.is_driven(x.0)).for_each(|(column, x)| dense[column] += x);
        dense
    }

    fn is_driven(&self, column: usize) -> bool {
        matches!(self.structure.role(self.problem.columns[column].coordinate), Role::Driven(_))
    }

    /// Of the state the coordinates whose rates follow, if as many others as motions are left among `open` and determine them.
    fn others(&self, rests: &[Rest], open: &[Coordinate], with_speeds: bool) -> Option<(Vec<Coordinate>, f64)> {
        let count = rests.first()?.len();
        let column =
            |coordinate: &Coordinate| self.problem.columns.iter().position(|column| column.coordinate == *coordinate);
        // What the user has called independent comes first; of positions that are so not all rates have to be.
        let wished: Vec<Coordinate> =
            open.iter().copied().filter(|coordinate| self.model.independent.contains(coordinate)).collect();
        let (open, wished) = if wished.len() > count { (&wished[..], &[][..]) } else { (open, &wished[..]) };
        let columns: Vec<usize> = open.iter().map(column).collect::<Option<_>>()?;
        let wished: Vec<usize> = (0..open.len()).filter(|&k| wished.contains(&open[k])).collect();
        let at = |rest: &Rest, chosen: &[usize]| {
            determinant(chosen.iter().map(|&k| rest.iter().map(|unit| unit[columns[k]]).collect()).collect())
        };
        let volume = |chosen: &[usize]| rests.iter().map(|rest| at(rest, chosen)).fold(f64::INFINITY, f64::min);
        let start = self.start.and_then(|point| self.motions_at(point, with_speeds));
        let starts = |chosen: &[usize]| start.as_ref().is_none_or(|rest| at(rest, chosen) > CLEAR);
        let from_start = best(open.len(), count, &wished, |chosen| if starts(chosen) { volume(chosen) } else { 0.0 });
        let (chosen, size) = from_start.or_else(|| best(open.len(), count, &wished, volume))?;
        let is_chosen = |coordinate: &Coordinate| chosen.iter().any(|&k| open[k] == *coordinate);
        Some((self.structure.state.iter().copied().filter(|coordinate| !is_chosen(coordinate)).collect(), size))
    }

    /// Coordinates of the state whose rates speeds read.
    fn read(&self) -> Vec<Coordinate> {
        let columns = (0..self.model.speeds.len()).flat_map(|number| self.problem.columns_of_speed(number));
        columns.map(|column| self.problem.columns[column].coordinate).collect()
    }

    fn dependent_rows(&self) -> Complaint {
        if !self.model.independent.is_empty() {
            let message = "the rates of the coordinates that `independent` names leave others open, which the constraints of velocities don't give";
            let help = "leave out one of those names";
            return Complaint { at: self.model.site(), message: message.to_owned(), help: Some(help.to_owned()) };
        }
        let message = "equations of velocities depend on each other in a way that leaves no velocities to choose";
        let help = "write `formulation { constraints: Multipliers }`, or name other coordinates `independent`";
        Complaint { at: self.model.site(), message: message.to_owned(), help: Some(help.to_owned()) }
    }

    /// A pose at which speeds depend on each other, if it isn't a single one: one of those drawn at random may be met by accident, the
    /// first one by choice. So it is with a speed that is nothing on one side of a limit.
    fn without_speeds(&self) -> Option<Point> {
        let depend = |point: &&Point| self.motions_at(point, false).is_some() && self.motions_at(point, true).is_none();
        self.points.iter().skip(1).filter(depend).nth(1).cloned()
    }

    fn speeds_in_pieces(&self) -> Complaint {
        let (first, _) = self.first_dependent();
        let name = coordinate_name(self.model, self.model.coordinate_of(first));
        Complaint {
            at: self.model.speeds[first].site(),
            message: format!(
                "in many poses the speed `{name}` tells nothing that is not known without it, so rates are left open there"
            ),
            help: Some("speeds have to determine the rates that they read in all poses but single ones".to_owned()),
        }
    }

    fn dependent_speeds(&self) -> Complaint {
        let model = self.model;
        let (first, is_empty) = self.first_dependent();
        let name = coordinate_name(model, model.coordinate_of(first));
        let (message, help) = match is_empty {
            true => {
                (format!("the speed `{name}` is of velocities that are given: none that is free has a say in it"), None)
            }
            false => {
                // Equations that keep multipliers hold nothing here.
                let held = self.points.iter().any(|point| !self.rows_at(point, false).is_empty());
                let and = if held { " and from the constraints" } else { "" };
                let message = format!("the speed `{name}` follows from other speeds{and}");
                (message, Some("speeds have to be independent of each other".to_owned()))
            }
        };
        Complaint { at: model.speeds[first].site(), message, help }
    }

    /// The first speed that depends on what stands before it, and whether it is nothing.
    fn first_dependent(&self) -> (usize, bool) {
        let count = self.model.speeds.len();
        // What is left of a speed behind the rows before it, and its length.
        let left = |point: &Point, number: usize| {
            let mut rows = self.rows_at(point, true);
            rows.truncate(rows.len() - count + number + 1);
            let Some(last) = rows.pop() else { return (0.0, 0.0) };
            let mut basis: Vec<Vec<f64>> = Vec::new();
            for row in rows {
                let mut left = without(row, &basis);
                if unit(&mut left).is_some_and(|length| length > 0.0) {
                    basis.push(left);
                }
            }
            let size = dot(&last, &last).sqrt();
            let left = without(last, &basis);
            (dot(&left, &left).sqrt(), size)
        };
        let everywhere =
            |number: usize, is: fn((f64, f64)) -> bool| self.points.iter().all(|point| is(left(point, number)));
        let first = (0..count).find(|&number| everywhere(number, |(left, size)| left <= DEPENDENT * size)).unwrap_or(0);
        (first, everywhere(first, |(_, size)| size == 0.0))
    }

    fn too_few(&self) -> Complaint {
        let mut read = self.read();
        read.retain(|coordinate| self.structure.state.contains(coordinate));
        read.sort_unstable();
        read.dedup();
        let names: Vec<String> = read.iter().map(|&c| format!("`{}.rate`", coordinate_name(self.model, c))).collect();
        let names = names.join(", ");
        let message = match self.model.speeds.len() {
            1 => format!("1 speed doesn't determine the rates that it reads: {names}"),
            speeds => format!("{speeds} speeds don't determine the rates that they read: {names}"),
        };
        let help = match self.structure.rows.is_empty() {
            true => {
                "as many speeds are needed as the constraints leave independent among these; the rate of a joint may be one"
            }
            false => {
                "as many speeds are needed as there are rates, since equations that keep multipliers leave these independent; the \
                 rate of a joint may be one; `constraints: Reduced` takes fewer"
            }
        };
        let at = self.model.speeds.last().map_or(self.model.site(), Sited::site);
        Complaint { at, message, help: Some(help.to_owned()) }
    }
}

/// So many of `among`, those that are wished for first, with the greatest volume, and that; the first of equal ones. Nothing where it
/// vanishes.
fn best(among: usize, count: usize, wished: &[usize], volume: impl Fn(&[usize]) -> f64) -> Option<(Vec<usize>, f64)> {
    if count > among {
        return None;
    }
    let others: Vec<usize> = (0..among).filter(|k| !wished.contains(k)).collect();
    let rest = count - wished.len().min(count);
    let choices =
        (0..rest).try_fold(1_usize, |product, k| Some(product.checked_mul(others.len().checked_sub(k)?)? / (k + 1)));
    let mut found: (f64, Vec<usize>) = (DEPENDENT, Vec::new());
    let mut is_found = false;
    if choices.is_some_and(|choices| choices <= MOST_CHOICES) {
        let mut places: Vec<usize> = (0..rest).collect();
        loop {
            let mut chosen: Vec<usize> = wished.iter().copied().chain(places.iter().map(|&k| others[k])).collect();
            chosen.sort_unstable();
            let size = volume(&chosen);
            // Rounding is to decide nothing between equal ones.
            if size > found.0 * (1.0 + DEPENDENT) {
                found = (size, chosen);
                is_found = true;
            }
            if !next(&mut places, others.len()) {
                break;
            }
        }
        return is_found.then_some((found.1, found.0));
    }
    // From all coordinates, which are too many, to fewer is no volume: one by one by what each adds.
    let mut chosen = wished.to_vec();
    while chosen.len() < count {
        let with = |&k: &usize| {
            let mut more = chosen.clone();
            more.push(k);
            (volume(&more), k)
        };
        let candidates = others.iter().filter(|k| !chosen.contains(k));
        let (_, k) = candidates.map(with).max_by(|a, b| a.0.total_cmp(&b.0))?;
        chosen.push(k);
    }
    chosen.sort_unstable();
    let size = volume(&chosen);
    (size > DEPENDENT).then_some((chosen, size))
}

/// The next combination of places among so many, in their order.
fn next(places: &mut [usize], among: usize) -> bool {
    let count = places.len();
    let Some(at) = (0..count).rev().find(|&k| places[k] + count - k < among) else { return false };
    places[at] += 1;
    for k in at + 1..count {
        places[k] = places[k - 1] + 1;
    }
    true
}

/// The volume that rows span: their absolute determinant where there are as many as columns.
fn determinant(rows: Vec<Vec<f64>>) -> f64 {
    let mut basis: Vec<Vec<f64>> = Vec::new();
    let mut volume = 1.0;
    for row in rows {
        let left = without(row, &basis);
        let size = dot(&left, &left).sqrt();
        volume *= size;
        if size == 0.0 {
            return 0.0;
        }
        basis.push(left.into_iter().map(|x| x / size).collect());
    }
    volume
}

/// Whether equations of velocities are eliminated.
pub(super) fn eliminates(model: &Model) -> bool {
    matches!(model.handling, Handling::Reduced)
}
