//! Stage `mechanics`: what becomes of every coordinate and every constraint equation, before anything is derived.
//!
//! In: the checked model. Out: its [`Structure`], or complaints. Equations fall into groups that share coordinates. For
//! each group closed configurations are found, the equations that follow from the others at all of them are dropped, and
//! what cannot close, cannot move, or is driven twice is refused. With `Reduced` the dependent coordinates are found in
//! steps: linear couplings first, then `solve` items and the smallest possible systems for Newton's method, in an order
//! in which each needs earlier ones only. (A linear step gives its unknown from coordinates that later steps may find.)

mod absorption;
mod checks;
mod choice;
mod closable;
mod closed;
mod closures;
mod configurations;
mod dense;
mod divisors;
mod integrability;
mod leaving;
mod linear;
mod measure;
mod orthonormal;
mod pinned;
mod problem;
mod rank;
mod ranked;
mod rates;
mod reduction;
mod relations;
mod scales;
mod shared;
pub mod singular;
mod speeds;
mod springs;
mod statics;
mod steadiness;
mod stress;
mod tape;
mod teeth;
mod written;

use std::collections::{BTreeMap, HashMap, HashSet};

use crate::model::site::{Site, Sited};
use crate::model::types::{Coordinate, DriveTarget, Handling, JointId, LoopClosure, Model};

use super::loops::constraints::{self, closings, coordinate_name, rate_rows, row_count, row_name, turns};
use super::loops::groups;
use super::loops::structure::{Means, Role, Row, Step, Structure};
use super::translate::{division, formulas};
use choice::Choice;
use closed::Sampled;
use configurations::{Configuration, Effort, Found, follow};
use linear::Elimination;
use problem::{Problem, Source};
use ranked::Ranked;

pub use absorption::Hope;
pub(super) use absorption::{Absorption, Poses};
pub use closable::{Closable, Pose, closable};
pub use relations::{Relation, relations};
pub use speeds::clear_speeds;
pub(super) use written::Writings;

/// How far parameters are moved to see what holds at their defaults alone; relative to one and their size.
const OFF: f64 = 1e-2;

/// A mistake that only the equations show.
#[derive(Clone, Debug)]
pub struct Complaint {
    pub at: Site,
    pub message: String,
    pub help: Option<String>,
}

/// Splits a model's coordinates and equations.
pub fn analyse(model: &Model) -> Result<Structure, Vec<Complaint>> {
    let mut structure = choice::structure(model)?;
    structure.closures = closures::closures(model, &structure)?;
    structure.assembly = closures::assembly(model, &structure)?;
    Ok(structure)
}

fn split(model: &Model, choice: Choice<'_>) -> Result<Structure, Vec<Complaint>> {
    formulas::complaints(model)?;
    let divided = division::complaints(model);
    if !divided.is_empty() {
        return Err(divided);
    }
    let staying = leaving::complaints(model);
    if !staying.is_empty() {
        return Err(staying);
    }
    let mut structure = Structure { writing: choice.writing, ..Structure::open(model) };
    structure.groups = groups::find(model);
    if model.cuts.is_empty() && model.constraints.is_empty() && model.drives.is_empty() && model.speeds.is_empty() {
        return Ok(structure);
    }
    let quadratic = constraints::rates::complaints(model);
    if !quadratic.is_empty() {
        return Err(quadratic);
    }
    let uncounted = turns::complaints(model);
    if !uncounted.is_empty() {
        return Err(uncounted);
    }
    let mut analysis = Analysis {
        model,
        choice,
        complaints: Vec::new(),
        driven: HashMap::new(),
        steps: Vec::new(),
        samples: Vec::new(),
    };
    analysis.drive();
    let looped = !model.cuts.is_empty() || !model.constraints.is_empty() || !model.speeds.is_empty();
    let problem = looped.then(|| Problem::written(model, choice.writing));
    if let Some(problem) = &problem {
        analysis.run(problem, &mut structure);
        analysis.check_held_drives(&structure);
    }
    if !analysis.complaints.is_empty() {
        return Err(analysis.complaints);
    }
    analysis.assign(&mut structure);
    if let Some(problem) = &problem {
        structure.closed = closed::closed(problem, &analysis.samples, &structure);
        structure.measure(problem, &analysis.samples);
        analysis.complaints.extend(rates::keep(model, problem, &mut structure));
        if analysis.complaints.is_empty() {
            analysis.complaints.extend(speeds::choose(model, problem, &mut structure));
        }
        if analysis.complaints.is_empty() {
            let notes = integrability::notes(model, problem, &structure);
            structure.notes.extend(notes);
        }
        structure.shared = shared::shared(model, problem, &structure);
        analysis.complaints.extend(divisors::complaints(model, problem, &structure));
        match springs::meeting(model, problem, &structure) {
            Ok(held) => structure.meeting = held,
            Err(complaints) => analysis.complaints.extend(complaints),
        }
    }
    analysis.check_quaternions(&structure);
    if !analysis.complaints.is_empty() {
        return Err(analysis.complaints);
    }
    Ok(structure)
}

struct Analysis<'m> {
    model: &'m Model,
    choice: Choice<'m>,
    complaints: Vec<Complaint>,
    /// Coordinates that follow a drive, with its number.
    driven: HashMap<Coordinate, usize>,
    steps: Vec<Step>,
    /// What was found about each group.
    samples: Vec<Sampled>,
}

/// A group with what was found about it.
struct Looked {
    group: CoupledRows,
    /// Places of equations that are not formulas.
    rows: Vec<usize>,
    found: Found,
    ranked: Ranked,
}

/// Equations that share coordinates.
struct CoupledRows {
    /// Numbers in the problem, couplings that are eliminated first, then formulas, then all others.
    equations: Vec<usize>,
    columns: Vec<usize>,
}

impl<'m> Analysis<'m> {
    fn complain(&mut self, at: Site, message: impl Into<String>, help: Option<&str>) {
        self.complaints.push(Complaint { at, message: message.into(), help: help.map(str::to_owned) });
    }

    fn drive(&mut self) {
        let model = self.model;
        for (number, drive) in model.drives.iter().enumerate() {
            for coordinate in driven_by(model, drive.target) {
                if self.driven.insert(coordinate, number).is_some() {
                    let name = coordinate_name(model, coordinate);
                    self.complain(drive.site(), format!("the coordinate `{name}` is driven twice"), None);
                }
            }
        }
    }

    fn run(&mut self, problem: &Problem, structure: &mut Structure) {
        let model = self.model;
        let reduced = matches!(model.handling, Handling::Reduced);
        let mut taken: HashSet<Coordinate> = self.driven.keys().copied().collect();
        if reduced {
            taken.extend(model.independent.iter().copied());
        }
        let eliminations = linear::eliminations(&linear::couplings(model), &taken);
        self.constants(problem, structure);
        let mut freedoms = problem.columns.len() - self.driven.len();
        let mut linear_steps = Vec::new();
        let mut looked = Vec::new();
        for group in groups(problem, &eliminations) {
            let Some(mut found) = self.close(problem, &group, structure) else { continue };
            let all: Vec<usize> = (0..group.equations.len()).collect();
            let is_formula = |&k: &usize| matches!(problem.equations[group.equations[k]].source, Source::Formula(..));
            let (formulas, rows): (Vec<usize>, Vec<usize>) = all.iter().partition(|k| is_formula(k));
            // With multipliers an equation more costs work and does no harm.
            let follows =
                |independent: &[usize]| reduced && follow(problem, &group.equations, independent, &group.columns);
            // Beside formulas the declared order counts.
            let is_first = |k: usize| {
                formulas.is_empty()
                    && row_of(problem, group.equations[k]).is_some_and(|row| self.choice.first.contains(&row))
            };
            let (first, later): (Vec<usize>, Vec<usize>) = rows.iter().partition(|&&k| is_first(k));
            let order = [first, later].concat();
            let mut ranked = ranked::ranked(&mut found, &order, &formulas, follows);
            let is_whole = |&k: &usize| row_of(problem, k).is_some_and(|row| self.choice.whole.contains(&row));
            if group.equations.iter().any(is_whole) {
                ranked.keep_all(&found, &rows);
            }
            looked.push(Looked { group, rows, found, ranked });
        }
        if reduced {
            let groups: Vec<&CoupledRows> = looked.iter().map(|one| &one.group).collect();
            self.complaints.extend(reduction::apart(model, problem, &groups));
        }
        let locked = checks::locked(problem, &looked, reduced);
        for (number, one) in looked.into_iter().enumerate() {
            let Looked { group, rows, found, ranked } = one;
            let staying = self.with_other_parameters(problem, &group, &rows, &found.configurations, &ranked, structure);
            self.drop_redundant(problem, &group, &rows, &staying, &ranked, structure);
            let Ranked { rank, ref independent, ref kept, .. } = ranked;
            structure.redundant |= staying.len() > ranked.least;
            // Without formulas: what follows from the rows before it. With them: what needs no step of its own.
            if kept.len() > rank {
                self.complain_formulas(problem, &group);
                continue;
            }
            let closed = found.configurations.iter().any(|configuration| configuration.closed);
            if reduced && closed && ranked.elusive {
                self.complain_elusive(problem, &group, &ranked.evidence);
                continue;
            }
            let stuck = rank >= group.columns.len();
            if (stuck && reduced && !closed) || (closed && locked.contains(&number)) {
                self.complain_locked(problem, &group, closed);
                continue;
            }
            let jacobians: Vec<&[Vec<f64>]> = found.configurations.iter().map(|c| c.jacobian.as_slice()).collect();
            if !self.check_drives(problem, &group, &jacobians, independent) {
                continue;
            }
            freedoms = freedoms.saturating_sub(rank);
            structure.independent.extend(independent.iter().filter_map(|&k| row_of(problem, group.equations[k])));
            let of_group: Vec<&Elimination> =
                eliminations.iter().filter(|one| has_row(problem, &group, independent, one)).collect();
            linear_steps.extend(
                of_group.iter().map(|one| Step { unknowns: vec![one.unknown], means: Means::Linear(one.constraint) }),
            );
            if reduced {
                let home = configurations::home(problem, &group.equations, &group.columns, &found);
                let reduction = reduction::ReductionSearch {
                    model,
                    problem,
                    group: &group,
                    configurations: &found.configurations,
                    home: home.as_ref(),
                    kept,
                    eliminations: &of_group,
                    driven: &self.driven,
                };
                match reduction.steps() {
                    Ok(steps) => self.steps.extend(steps),
                    Err(complaints) => self.complaints.extend(complaints),
                }
            } else {
                let eliminated =
                    |row: &Row| of_group.iter().any(|one| row.closing == LoopClosure::Constraint(one.constraint));
                let rows = staying.iter().filter_map(|&k| row_of(problem, group.equations[k]));
                structure.rows.extend(rows.filter(|row| !eliminated(row)));
            }
            self.samples.push(Sampled { group, configurations: found.configurations, rank });
        }
        // Couplings stand in an order of their own, whatever the groups.
        let place = |step: &Step| eliminations.iter().position(|one| step.unknowns.contains(&one.unknown));
        linear_steps.sort_by_key(place);
        let mut guess = 0;
        for step in &mut self.steps {
            if let Means::Newton { guess: first, .. } = &mut step.means {
                *first = guess;
                guess += step.unknowns.len();
            }
        }
        linear_steps.append(&mut self.steps);
        self.steps = linear_steps;
        structure.rows.sort_unstable();
        structure.independent.sort_unstable();
        if reduced && self.complaints.is_empty() && model.independent.len() > freedoms {
            let (named, found) = (model.independent.len(), freedoms);
            let message = format!("`independent` names {named} coordinates, but {found} are independent");
            self.complain(model.site(), message, Some("dependent coordinates follow from the loops"));
        }
    }

    /// Rows that are redundant at the parameters' defaults may not be so elsewhere: a tilt whose default is zero. They are
    /// looked at once more with parameters a little off. Where the loop doesn't close any more its rows stay, so that
    /// assembly and the pivoted solve see them; without multipliers the report says what is granted, and it is
    /// looked at where a motion starts.
    fn with_other_parameters(
        &self,
        problem: &Problem,
        group: &CoupledRows,
        rows: &[usize],
        from: &[Configuration],
        ranked: &Ranked,
        structure: &mut Structure,
    ) -> Vec<usize> {
        let staying = ranked.staying.clone();
        let reduced = matches!(self.model.handling, Handling::Reduced);
        let independent = if reduced { ranked.independent.clone() } else { staying };
        let adjustable = group.equations.iter().any(|&k| problem.equations[k].adjustable);
        let dropped: Vec<usize> = rows.iter().copied().filter(|k| !independent.contains(k)).collect();
        if dropped.is_empty() || !adjustable {
            return independent;
        }
        let moved = problem.moved(self.model, OFF);
        let effort = Effort::of(group.equations.len());
        let found = configurations::configurations(&moved, &group.equations, &group.columns, effort);
        let closed: Vec<&[Vec<f64>]> =
            found.configurations.iter().filter(|c| c.closed).map(|c| c.jacobian.as_slice()).collect();
        let needed: Vec<usize> = match closed.is_empty() {
            true => dropped,
            false => {
                let elsewhere = rank::kept(&closed, rows);
                dropped.into_iter().filter(|k| elsewhere.contains(k)).collect()
            }
        };
        if needed.is_empty() {
            return independent;
        }
        if reduced {
            let names: Vec<String> = needed
                .iter()
                .filter_map(|&k| row_of(problem, group.equations[k]))
                .map(|row| format!("`{}`", row_name(self.model, row.closing, row.index)))
                .collect();
            let names = names.join(", ");
            structure.granted.extend(needed.iter().filter_map(|&k| row_of(problem, group.equations[k])));
            structure.pinned.extend(pinned::pinned(problem, group, rows, from));
            structure.notes.push(format!(
                "hold only for parameters like the declared ones, and are looked at where a motion starts: {names}"
            ));
            return independent;
        }
        structure.wavering.extend(needed.iter().filter_map(|&k| row_of(problem, group.equations[k])));
        let mut kept: Vec<usize> = independent.into_iter().chain(needed).collect();
        kept.sort_unstable();
        kept
    }

    fn drop_redundant(
        &mut self,
        problem: &Problem,
        group: &CoupledRows,
        rows: &[usize],
        kept: &[usize],
        ranked: &Ranked,
        structure: &mut Structure,
    ) {
        let mut names = Vec::new();
        for &k in rows {
            if kept.contains(&k) {
                continue;
            }
            let Some(row) = row_of(problem, group.equations[k]) else { continue };
            if let (false, LoopClosure::Constraint(id)) = (problem.is_analytic(group.equations[k]), row.closing) {
                // Poses prove nothing of a function in pieces.
                let name = row_name(self.model, row.closing, row.index);
                let message = format!(
                    "the constraint `{name}` follows from others wherever it was looked at, and is made of pieces"
                );
                let help = "whether it does so in all pieces is not known: leave it out, or write it without `min`, `max`, `select` and the like";
                self.complain(self.model.constraints[id].site(), message, Some(help));
                continue;
            }
            names.push(format!("`{}`", row_name(self.model, row.closing, row.index)));
            structure.dropped.push(row);
        }
        if !names.is_empty() {
            let (names, evidence) = (names.join(", "), &ranked.evidence);
            structure.notes.push(format!("redundant equations, left out: {names}; {evidence}"));
        } else if !ranked.agreed {
            let names: Vec<String> = rows
                .iter()
                .filter_map(|&k| row_of(problem, group.equations[k]))
                .map(|row| format!("`{}`", row_name(self.model, row.closing, row.index)))
                .collect();
            let (names, evidence) = (names.join(", "), &ranked.evidence);
            structure.notes.push(format!("no equation is left out of {names}: {evidence}"));
        }
    }

    /// Roles, once all steps are known.
    fn assign(&self, structure: &mut Structure) {
        let mut set = |coordinate: Coordinate, role: Role| {
            let joint = structure.roles.get_mut(coordinate.joint.0);
            if let Some(slot) = joint.and_then(|roles| roles.get_mut(coordinate.index)) {
                *slot = role;
            }
        };
        for (&coordinate, &number) in &self.driven {
            set(coordinate, Role::Driven(number));
        }
        for (number, step) in self.steps.iter().enumerate() {
            for &unknown in &step.unknowns {
                set(unknown, Role::Dependent(number));
            }
        }
        structure.steps.clone_from(&self.steps);
        let Structure { roles, state, .. } = structure;
        state.retain(|c| roles.get(c.joint.0).and_then(|roles| roles.get(c.index)) == Some(&Role::State));
        self.report(structure);
    }

    fn report(&self, structure: &mut Structure) {
        let names = |list: &[Coordinate]| -> String {
            let names: Vec<String> = list.iter().map(|&c| format!("`{}`", coordinate_name(self.model, c))).collect();
            names.join(", ")
        };
        for step in &structure.steps {
            let unknowns = names(&step.unknowns);
            structure.notes.push(match &step.means {
                Means::Linear(_) => format!("found by a linear coupling: {unknowns}"),
                Means::Solve(_) | Means::Explicit(_) => format!("found in closed form: {unknowns}"),
                Means::Newton { .. } => format!("found by Newton's method: {unknowns}"),
            });
        }
        let chosen = structure.steps.iter().any(|step| matches!(step.means, Means::Newton { .. } | Means::Explicit(_)));
        if chosen && self.model.independent.is_empty() {
            structure.notes.push(format!("independent coordinates: {}", names(&structure.state)));
        }
    }
}

/// Coordinates that a drive prescribes.
pub fn driven_by(model: &Model, target: DriveTarget) -> Vec<Coordinate> {
    let several =
        |joint: JointId, range: std::ops::Range<usize>| range.map(|index| Coordinate { joint, index }).collect();
    match target {
        DriveTarget::Coordinate(coordinate) => vec![coordinate],
        DriveTarget::Position(joint) => several(joint, 0..3),
        DriveTarget::Pose(joint) => several(joint, 0..6),
        DriveTarget::Orientation(joint) => several(joint, model.joints[joint].kind.turning()),
    }
}

fn row_of(problem: &Problem, equation: usize) -> Option<Row> {
    match problem.equations.get(equation)?.source {
        Source::Row(row) => Some(row),
        Source::Formula(..) => None,
    }
}

fn formula_of(problem: &Problem, equation: usize) -> Option<usize> {
    match problem.equations.get(equation)?.source {
        Source::Formula(number, _) => Some(number),
        Source::Row(_) => None,
    }
}

fn has_row(problem: &Problem, group: &CoupledRows, kept: &[usize], one: &Elimination) -> bool {
    kept.iter().any(|&k| {
        row_of(problem, group.equations[k]).is_some_and(|row| row.closing == LoopClosure::Constraint(one.constraint))
    })
}

fn columns_of(problem: &Problem, equations: &[usize]) -> Vec<usize> {
    let mut columns: Vec<usize> =
        equations.iter().flat_map(|&k| problem.equations[k].columns.iter().copied()).collect();
    columns.sort_unstable();
    columns.dedup();
    columns
}

/// Connected components of equations and columns, in the order of their first equation.
fn groups(problem: &Problem, eliminations: &[Elimination]) -> Vec<CoupledRows> {
    // The group that each column belongs to, by its least equation.
    let mut root: Vec<usize> = (0..problem.equations.len()).collect();
    let mut owner: Vec<Option<usize>> = vec![None; problem.columns.len()];
    for (k, equation) in problem.equations.iter().enumerate() {
        for &column in &equation.columns {
            match owner[column] {
                None => owner[column] = Some(k),
                Some(other) => {
                    let (a, b) = (find(&mut root, other), find(&mut root, k));
                    root[a.max(b)] = a.min(b);
                }
            }
        }
    }
    // What tells a joint from its opposite may speak of columns that no equation has in common.
    for bond in problem.bonds() {
        let mut owners = bond.iter().filter_map(|&column| owner[column]);
        if let Some(first) = owners.next() {
            for other in owners {
                let (a, b) = (find(&mut root, first), find(&mut root, other));
                root[a.max(b)] = a.min(b);
            }
        }
    }
    let mut groups: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for (k, equation) in problem.equations.iter().enumerate() {
        if !equation.columns.is_empty() {
            groups.entry(find(&mut root, k)).or_default().push(k);
        }
    }
    let eliminated = |k: usize| {
        let closing = row_of(problem, k).map(|row| row.closing);
        eliminations.iter().any(|one| closing == Some(LoopClosure::Constraint(one.constraint)))
    };
    let rank = |k: usize| match problem.equations[k].source {
        Source::Row(_) if eliminated(k) => 0,
        Source::Formula(..) => 1,
        Source::Row(_) => 2,
    };
    let group = |mut equations: Vec<usize>| {
        equations.sort_by_key(|&k| (rank(k), k));
        CoupledRows { columns: columns_of(problem, &equations), equations }
    };
    groups.into_values().map(group).collect()
}

fn find(root: &mut [usize], mut k: usize) -> usize {
    while root[k] != k {
        root[k] = root[root[k]];
        k = root[k];
    }
    k
}

/// All equations of a model with their names, in the order of closings.
pub fn equation_names(model: &Model) -> Vec<(Row, String)> {
    let rows = closings(model)
        .into_iter()
        .flat_map(|closing| (0..row_count(model, closing)).map(move |index| Row { closing, index }));
    rows.chain(rate_rows(model)).map(|row| (row, row_name(model, row.closing, row.index))).collect()
}
