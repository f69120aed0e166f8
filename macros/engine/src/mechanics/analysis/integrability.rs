//! Stage `mechanics`: which equations of velocities are the rates of equations of positions.
//!
//! In: the equations as numbers, closed configurations. Out: sentences for the report; nothing is integrated. An equation A v + b = 0 is a
//! one-form w = A dq + b dt of positions and time, on the manifold that equations of positions and drives leave. A combination of such forms with
//! coefficients of position integrates where it is some dF. Some forms are all such combinations if dw of each vanishes for
//! all that the forms allow (Frobenius 1877): that is looked at point by point, for each equation alone, pairs, triples and all
//! together. How many combinations there are beyond whole sets takes higher brackets: those that are dF stay so along curves
//! ([`transport`]).
//!
//! "Integrates" is said where it holds at several closed configurations at random, at a time of their own, and with parameters
//! moved too, or it is said that it does so at the declared ones: of analytic functions that is right but for a chance of
//! zero. "None" is proven by one configuration. Of functions in pieces, which hold where they were looked at alone, nothing is said, and
//! nothing where numbers leave a doubt, or where equations read states, which are no positions.

mod frame;
mod transport;

use crate::mechanics::loops::constraints::row_name;
use crate::mechanics::loops::structure::Structure;
use crate::model::types::Model;

use super::configurations::Search;
use super::problem::forms::Forms;
use super::problem::{Point, Problem, Random, Source};
use super::singular::dot;
use super::tape::Values;
use frame::{Frame, Limits, vanishing};

/// Places that are looked at.
const PLACES: usize = 3;
/// Of these, the least that tell of anything that holds everywhere.
const LEAST: usize = 2;
/// The most equations of a set that is looked for.
const SET: usize = 3;
/// Parameters are off their defaults by about this much.
const OFF: f64 = 0.1;
/// How far places are from configurations that may be special.
const SHAKEN: f64 = 0.3;
/// The latest time that is looked at. [s]
const LATE: f64 = 2.0;
/// Values of exterior derivatives, beside the greatest entry.
const LIMITS: Limits = Limits { seen: 1e-8, nothing: 1e-10 };
/// A share in a combination.
const SHARE: f64 = 1e-6;

/// Equations of velocities of which so many combinations integrate.
struct Statement {
    rates: Vec<usize>,
    count: usize,
    /// Whether that is known for the declared parameters alone.
    declared: bool,
}

pub(super) fn notes(model: &Model, problem: &Problem, structure: &Structure) -> Vec<String> {
    let kept: Vec<usize> = (0..problem.rates.len())
        .filter(|&k| structure.rows.iter().chain(&structure.rates.rows).any(|row| *row == problem.rates[k].row))
        .collect();
    let analytic = (0..problem.equations.len()).all(|k| problem.is_analytic(k));
    let stateless = !problem.do_rates_read_states();
    if kept.is_empty() || !stateless || !analytic || !problem.are_rates_analytic() || !problem.are_drives_analytic() {
        return Vec::new();
    }
    let survey = Survey::new(problem, structure);
    let Some(mut found) = survey.statements(&kept) else { return Vec::new() };
    if found.is_empty() {
        return vec!["no combination of the equations of velocities integrates to positions".to_owned()];
    }
    if problem.is_adjustable() {
        let moved = problem.moved(model, OFF);
        let moved = Survey::new(&moved, structure);
        for one in &mut found {
            one.declared = moved.count(&one.rates).is_none_or(|count| count < one.count);
        }
    }
    sentences(model, problem, &found)
}

/// Places at which equations are looked at.
struct Survey<'p> {
    places: Vec<Place<'p>>,
}

/// A closed configuration, at a time.
struct Place<'p> {
    problem: &'p Problem,
    /// Of positions, those that are independent.
    equations: Vec<usize>,
    point: Point,
    /// By equation of velocities what makes its form one of unit length there.
    factors: Vec<f64>,
    forms: Forms,
}

impl<'p> Survey<'p> {
    fn new(problem: &'p Problem, structure: &Structure) -> Survey<'p> {
        let is_own = |&k: &usize| matches!(problem.equations[k].source, Source::Row(row) if structure.independent.contains(&row));
        let equations: Vec<usize> = (0..problem.equations.len()).filter(is_own).collect();
        let mut random = Random(0xF0_B5);
        let mut values = Values::default();
        let mut places = Vec::new();
        for k in 0..2 * PLACES {
            if let Some(point) = point(problem, structure, &equations, k, &mut random, &mut values) {
                places.extend(Place::new(problem, &equations, point, &mut values));
            }
            if places.len() == PLACES {
                break;
            }
        }
        Survey { places }
    }

    /// How many combinations of some equations integrate; nothing where places leave a doubt.
    fn count(&self, rates: &[usize]) -> Option<usize> {
        Some(self.combinations(rates)?.len())
    }

    /// At the place with the fewest.
    fn combinations(&self, rates: &[usize]) -> Option<Vec<Vec<f64>>> {
        let (mut least, mut looked): (Option<Vec<Vec<f64>>>, usize) = (None, 0);
        for place in &self.places {
            let Some(found) = place.combinations(rates) else { continue };
            looked += 1;
            if least.as_ref().is_none_or(|least| found.len() < least.len()) {
                least = Some(found);
            }
            if least.as_ref().is_some_and(Vec::is_empty) {
                return least;
            }
        }
        least.filter(|_| looked >= LEAST)
    }

    /// Whether all of some equations integrate together.
    fn is_whole(&self, rates: &[usize]) -> bool {
        let whole = |place: &Place<'_>| Some(place.derived(rates)?.len() == rates.len());
        let found: Vec<bool> = self.places.iter().filter_map(whole).collect();
        found.len() >= LEAST && found.into_iter().all(|whole| whole)
    }

    fn statements(&self, kept: &[usize]) -> Option<Vec<Statement>> {
        let combinations = self.combinations(kept)?;
        let has_share = |k: usize| combinations.iter().any(|one| one[k].abs() > SHARE);
        let concerned: Vec<usize> = (0..kept.len()).filter(|&k| has_share(k)).map(|k| kept[k]).collect();
        let mut found: Vec<Statement> = Vec::new();
        let mut told: Vec<usize> = Vec::new();
        for size in (1..=SET.min(concerned.len())).chain([concerned.len()]) {
            for rates in sets(&concerned, size) {
                if told.len() < combinations.len() && rates.iter().any(|k| !told.contains(k)) && self.is_whole(&rates) {
                    told.extend(&rates);
                    told.sort_unstable();
                    told.dedup();
                    join(&mut found, rates);
                }
            }
        }
        if told.len() < combinations.len() {
            found.extend(self.partial(kept, &told, &combinations)?);
        }
        Some(found)
    }

    /// Combinations beyond equations that integrate by themselves.
    fn partial(&self, kept: &[usize], told: &[usize], combinations: &[Vec<f64>]) -> Option<Vec<Statement>> {
        let others: Vec<usize> = (0..kept.len()).filter(|&k| !told.contains(&kept[k])).collect();
        let rows: Vec<Vec<f64>> = combinations.iter().map(|one| others.iter().map(|&k| one[k]).collect()).collect();
        let mut found = Vec::new();
        let mut left = combinations.len() - told.len();
        for (columns, count) in apart(rows) {
            let rates: Vec<usize> = columns.into_iter().map(|column| kept[others[column]]).collect();
            if self.count(&rates)? < count {
                break;
            }
            left -= count.min(left);
            found.push(Statement { rates, count, declared: false });
        }
        // Some need the others to be integrals.
        if left > 0 {
            found = vec![Statement { rates: kept.to_vec(), count: combinations.len(), declared: false }];
        }
        Some(found)
    }
}

/// Adds equations that integrate together. With others of which that is known and that they share some with they are one set; what
/// integrates alone is told alone too.
fn join(found: &mut Vec<Statement>, mut rates: Vec<usize>) {
    found.retain(|other| {
        let is_apart = other.rates.len() == 1 || !other.rates.iter().any(|rate| rates.contains(rate));
        if !is_apart {
            rates.extend(&other.rates);
        }
        is_apart
    });
    rates.sort_unstable();
    rates.dedup();
    found.push(Statement { count: rates.len(), rates, declared: false });
}

/// A configuration in general position.
fn point(
    problem: &Problem,
    structure: &Structure,
    equations: &[usize],
    number: usize,
    random: &mut Random,
    values: &mut Values,
) -> Option<Point> {
    let mut point = match structure.closed.as_slice() {
        _ if problem.equations.is_empty() => problem.start(random, 1.0),
        [] => return None,
        closed => problem.shaken(&problem.at(&closed[number % closed.len()].positions), random, SHAKEN, &[]),
    };
    problem.put_time(&mut point, LATE * random.next().abs());
    problem.drive(&mut point, values);
    let driven = problem.driven_columns();
    let columns: Vec<usize> = (0..problem.columns.len()).collect();
    let closed =
        equations.is_empty() || Search::new(problem, equations, &columns).holding(&driven).close(&mut point, values);
    (closed && problem.is_meant(&point, &columns, values)).then_some(point)
}

impl<'p> Place<'p> {
    fn new(problem: &'p Problem, equations: &[usize], point: Point, values: &mut Values) -> Option<Place<'p>> {
        let all: Vec<usize> = (0..problem.rates.len()).collect();
        let forms = problem.forms_with_slopes(&point, equations, &all, values);
        let lengths = forms.rates.iter().map(|form| dot(form, form).sqrt());
        let factors: Vec<f64> = lengths.map(|length| if length > 0.0 { 1.0 / length } else { 1.0 }).collect();
        if !factors.iter().all(|x| x.is_finite()) {
            return None;
        }
        let mut place = Place { problem, equations: equations.to_vec(), point, factors, forms };
        let factors = place.factors.clone();
        place.forms.scale(&factors);
        Some(place)
    }

    /// Forms at another point, in the units of this one.
    fn forms(&self, point: &Point, rates: &[usize], values: &mut Values) -> Forms {
        let mut forms = self.problem.forms_with_slopes(point, &self.equations, rates, values);
        forms.scale(&rates.iter().map(|&k| self.factors[k]).collect::<Vec<_>>());
        forms
    }

    /// Combinations of which the exterior derivative vanishes for all that the equations allow.
    fn derived(&self, rates: &[usize]) -> Option<Vec<Vec<f64>>> {
        let Forms { held, rates: forms, slopes } = &self.forms;
        let frame = Frame::new(held, &rates.iter().map(|&k| &forms[k]).collect::<Vec<_>>())?;
        let directions = frame.directions(self.problem.dimension());
        let greatest =
            rates.iter().flat_map(|&k| slopes[k].iter().flatten()).fold(1.0_f64, |most, x| most.max(x.abs()));
        let mut rows = Vec::new();
        for (number, first) in directions.iter().enumerate() {
            let along: Vec<Vec<f64>> = rates.iter().map(|&k| contracted(&slopes[k], first)).collect();
            for second in &directions[number + 1..] {
                rows.push(along.iter().map(|form| dot(form, second) / greatest).collect());
            }
        }
        vanishing(rows, rates.len(), LIMITS)
    }

    /// Combinations that integrate.
    fn combinations(&self, rates: &[usize]) -> Option<Vec<Vec<f64>>> {
        let derived = self.derived(rates)?;
        if derived.is_empty() || derived.len() == rates.len() {
            return Some(derived);
        }
        let mut random = Random(0xC0_11EC);
        transport::staying(self, rates, derived, &mut random)
    }
}

/// The form that an exterior derivative leaves of a vector.
fn contracted(slopes: &[Vec<f64>], vector: &[f64]) -> Vec<f64> {
    let mut form = vec![0.0; vector.len()];
    for (row, share) in slopes.iter().zip(vector) {
        form.iter_mut().zip(row).for_each(|(sum, slope)| *sum += share * slope);
    }
    form
}

/// All sets of some numbers with so many members, in order.
fn sets(of: &[usize], size: usize) -> Vec<Vec<usize>> {
    if size == 0 {
        return vec![Vec::new()];
    }
    let mut found = Vec::new();
    for (k, &first) in of.iter().enumerate() {
        found.extend(sets(&of[k + 1..], size - 1).into_iter().map(|rest| [vec![first], rest].concat()));
    }
    found
}

/// Sets of columns that no combination of rows connects with others, with the number of rows of each.
fn apart(mut rows: Vec<Vec<f64>>) -> Vec<(Vec<usize>, usize)> {
    let mut reduced: Vec<Vec<f64>> = Vec::new();
    let columns = rows.first().map_or(0, Vec::len);
    for column in 0..columns {
        let Some(at) = (0..rows.len()).max_by(|&a, &b| rows[a][column].abs().total_cmp(&rows[b][column].abs())) else {
            break;
        };
        if rows[at][column].abs() <= SHARE {
            continue;
        }
        let mut pivot = rows.swap_remove(at);
        let entry = pivot[column];
        pivot.iter_mut().for_each(|x| *x /= entry);
        for row in rows.iter_mut().chain(&mut reduced) {
            let share = row[column];
            row.iter_mut().zip(&pivot).for_each(|(x, p)| *x -= share * p);
        }
        reduced.push(pivot);
    }
    let mut found: Vec<(Vec<usize>, usize)> = Vec::new();
    for row in reduced {
        let mut own: Vec<usize> = (0..columns).filter(|&k| row[k].abs() > SHARE).collect();
        let mut count = 1;
        found.retain(|(other, number)| {
            let is_apart = !other.iter().any(|column| own.contains(column));
            if !is_apart {
                own.extend(other);
                count += number;
            }
            is_apart
        });
        own.sort_unstable();
        own.dedup();
        found.push((own, count));
    }
    found.sort();
    found
}

fn sentences(model: &Model, problem: &Problem, found: &[Statement]) -> Vec<String> {
    let names = |rates: &[usize]| {
        let row = |&k: &usize| problem.rates[k].row;
        let names: Vec<String> =
            rates.iter().map(row).map(|row| format!("`{}`", row_name(model, row.closing, row.index))).collect();
        names.join(", ")
    };
    let mut sentences = Vec::new();
    for declared in [false, true] {
        let with = if declared { ", with the declared parameters" } else { "" };
        let own = || found.iter().filter(move |one| one.declared == declared);
        let alone: Vec<usize> = own().filter(|one| one.rates.len() == 1).map(|one| one.rates[0]).collect();
        if !alone.is_empty() {
            sentences.push(format!("equations of velocities that integrate to positions{with}: {}", names(&alone)));
        }
        for Statement { rates, count, .. } in own().filter(|one| one.rates.len() > 1) {
            let names = names(rates);
            sentences.push(match (*count, rates.len()) {
                (count, all) if count == all => {
                    format!("equations of velocities that integrate to positions together{with}: {names}")
                }
                (1, all) => format!(
                    "of the {all} equations of velocities {names} one combination integrates to positions{with}"
                ),
                (count, all) => {
                    format!(
                        "of the {all} equations of velocities {names} {count} combinations integrate to positions{with}"
                    )
                }
            });
        }
    }
    if let Some(last) = sentences.last_mut() {
        last.push_str(
            "; written as equations of positions they take as many coordinates out of the motion, which is left to you",
        );
    }
    sentences
}
