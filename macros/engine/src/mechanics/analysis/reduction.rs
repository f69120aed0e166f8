//! Stage `mechanics`: the steps that find dependent coordinates.
//!
//! In: one group of equations with Jacobians at closed configurations. Out: `solve` items and systems for Newton's method
//! in an order in which each step needs earlier ones only. What couplings, formulas and closed forms give is eliminated
//! from the Jacobians first; what is left of the other rows chooses the dependent coordinates among the rest, those that stand alone
//! in an equation first, then those farthest from the ground, as far as they are well determined.

use std::collections::HashMap;

use crate::mechanics::loops::constraints::{coordinate_name, is_uncounted, row_count};
use crate::mechanics::loops::structure::{Means, Row, Step};
use crate::model::site::Sited;
use crate::model::types::{BodyRef, Closing, ConstraintId, Coordinate, JointId, LoopClosure, Model, Solve, SolveHow};
use crate::symbolic::triangular_form::{components, matching};

use super::checks::thing;
use super::configurations::Configuration;
use super::linear::{self, Elimination};
use super::problem::{Problem, Source};
use super::rank::Basis;
use super::singular::{add, dot};
use super::{Complaint, CoupledRows, row_of};

/// A pivot below this is none.
pub(super) const PIVOT: f64 = 1e-7;

/// A column counts as well determined if this much of it stands across those chosen before.
const WELL: [f64; 3] = [2e-2, 1e-3, 1e-6];

pub(super) struct ReductionSearch<'a> {
    pub model: &'a Model,
    pub problem: &'a Problem,
    pub group: &'a CoupledRows,
    pub configurations: &'a [Configuration],
    /// The declared pose, if it is closed and nothing is lost there.
    pub home: Option<&'a Configuration>,
    /// Places in the group of equations that are not implied by those before them, formulas included.
    pub kept: &'a [usize],
    pub eliminations: &'a [&'a Elimination],
    pub driven: &'a HashMap<Coordinate, usize>,
}

/// A `solve` item in this group.
struct Item {
    number: usize,
    /// Places in the group.
    rows: Vec<usize>,
    /// Places among the group's columns.
    unknowns: Vec<usize>,
}

/// `solve` items of closings without a coordinate in common: one complaint for each item, whichever groups its closings are in.
pub(super) fn apart(model: &Model, problem: &Problem, groups: &[&CoupledRows]) -> Vec<Complaint> {
    let holds = |group: &&&CoupledRows, closing: &Closing| {
        let of = |&k: &usize| row_of(problem, k).is_some_and(|row| row.closing == closing.what);
        group.equations.iter().any(of)
    };
    let complaint = |solve: &Solve| {
        let SolveHow::From { closings, .. } = &solve.how else { return None };
        // A closing may have equations in several groups: none of them may do without the others of the item.
        let lacks = |group: &&CoupledRows| {
            let has_one = closings.iter().any(|closing| holds(&group, closing));
            closings.iter().find(|closing| has_one && !holds(&group, closing))
        };
        let other = groups.iter().find_map(lacks)?;
        let (_, what) = thing(model, other.what);
        Some(Complaint {
            at: other.site(),
            message: format!("{what} has no coordinate in common with the others"),
            help: Some("write a `solve` of its own for it".to_owned()),
        })
    };
    model.solves.iter().filter_map(complaint).collect()
}

pub(super) type Matrix = Vec<Vec<f64>>;

impl ReductionSearch<'_> {
    pub(super) fn steps(&self) -> Result<Vec<Step>, Vec<Complaint>> {
        let places = self.configurations.iter().chain(self.home);
        let mut matrices: Vec<Matrix> = places.map(|c| c.jacobian.clone()).collect();
        // Rows that are left for Newton's method, and columns that may be found by it.
        let mut rows: Vec<usize> = self.kept.to_vec();
        let mut columns: Vec<usize> = (0..self.group.columns.len()).collect();
        columns.retain(|&k| !self.driven.contains_key(&self.coordinate(k)));
        for one in self.eliminations {
            let row = self.row_of_constraint(one.constraint);
            let (Some(row), Some(column)) = (row, self.column(one.unknown)) else { continue };
            matrices.iter_mut().for_each(|matrix| eliminate(matrix, row, column));
            rows.retain(|&k| k != row);
            columns.retain(|&k| k != column);
        }
        let items = self.items()?;
        for item in &items {
            if !self.solvable(item, &mut matrices) {
                return Err(vec![self.undetermined(item)]);
            }
            rows.retain(|k| !item.rows.contains(k));
            columns.retain(|k| !item.unknowns.contains(k));
        }
        // Loops that share coordinates can each be on a branch where something else moves, so one sample need not show
        // all of them at their best: first each coordinate needs one vote, and every system one regular sample. Where the
        // declared pose is closed motions begin there as a rule: what doesn't follow there is taken only if nothing else will do.
        let (matrices, home) = matrices.split_at(self.configurations.len());
        let vetoes: &[&[Matrix]] = if home.is_empty() { &[&[]] } else { &[home, &[]] };
        for &veto in vetoes {
            let Ok(unknowns) = self.choose(matrices, veto, &rows, &columns, 1) else { continue };
            match self.order(&items, matrices, &rows, &unknowns) {
                Ok(steps) if self.regular(&steps, matrices) => return Ok(steps),
                Err(complaints) if veto.is_empty() => return Err(complaints),
                _ => {}
            }
        }
        let unknowns = self.choose(matrices, &[], &rows, &columns, matrices.len() / 2 + 1)?;
        self.order(&items, matrices, &rows, &unknowns)
    }

    /// Whether each system is well determined at some sample.
    fn regular(&self, steps: &[Step], matrices: &[Matrix]) -> bool {
        steps.iter().all(|step| {
            let Means::Newton { rows, .. } = &step.means else { return true };
            let own = |&k: &usize| self.row(k).is_some_and(|row| rows.contains(&row));
            let rows: Vec<usize> = self.kept.iter().copied().filter(own).collect();
            let columns: Vec<usize> = step.unknowns.iter().filter_map(|&unknown| self.column(unknown)).collect();
            matrices.iter().any(|matrix| {
                let mut basis = Basis::default();
                let part = |&row: &usize| -> Vec<f64> { columns.iter().map(|&column| matrix[row][column]).collect() };
                rows.iter().map(part).all(|row| basis.grow(&row, WELL[1] * norm(&row).max(1e-3)))
            })
        })
    }

    pub(super) fn coordinate(&self, column: usize) -> Coordinate {
        self.problem.columns[self.group.columns[column]].coordinate
    }

    pub(super) fn column(&self, coordinate: Coordinate) -> Option<usize> {
        (0..self.group.columns.len()).find(|&k| self.coordinate(k) == coordinate)
    }

    pub(super) fn row_of_constraint(&self, id: ConstraintId) -> Option<usize> {
        let own = |&k: &usize| self.row(k).is_some_and(|row| row.closing == LoopClosure::Constraint(id));
        self.kept.iter().copied().find(own)
    }

    pub(super) fn row(&self, place: usize) -> Option<Row> {
        row_of(self.problem, self.group.equations[place])
    }

    fn names(&self, columns: &[usize]) -> String {
        let names: Vec<String> =
            columns.iter().map(|&k| format!("`{}`", coordinate_name(self.model, self.coordinate(k)))).collect();
        names.join(", ")
    }

    /// The `solve` items that speak of this group, checked against its equations.
    fn items(&self) -> Result<Vec<Item>, Vec<Complaint>> {
        let mut complaints = Vec::new();
        let mut items: Vec<Item> = Vec::new();
        for (number, solve) in self.model.solves.iter().enumerate() {
            let rows: Vec<usize> = match &solve.how {
                SolveHow::Formulas(_) => {
                    let own = |&k: &usize| {
                        let source = self.problem.equations[self.group.equations[k]].source;
                        matches!(source, Source::Formula(item, _) if item == number)
                    };
                    self.kept.iter().copied().filter(own).collect()
                }
                SolveHow::From { closings, .. } => {
                    let of = |k: usize, closing: &Closing| self.row(k).is_some_and(|row| row.closing == closing.what);
                    let is_here = |closing: &&Closing| (0..self.group.equations.len()).any(|k| of(k, closing));
                    if !closings.iter().any(|closing| is_here(&closing)) {
                        continue;
                    }
                    // What is apart was told of once for all groups, see `apart`.
                    if !closings.iter().all(|closing| is_here(&closing)) {
                        return Err(complaints);
                    }
                    let own = |&k: &usize| closings.iter().any(|closing| of(k, closing));
                    self.kept.iter().copied().filter(own).collect()
                }
            };
            let formulas = matches!(solve.how, SolveHow::Formulas(_));
            if formulas && rows.is_empty() {
                continue;
            }
            let mut complain = |message: String, help: &str| {
                complaints.push(Complaint { at: solve.site(), message, help: Some(help.to_owned()) });
            };
            let mut unknowns = Vec::new();
            for &unknown in &solve.unknowns {
                let name = coordinate_name(self.model, unknown);
                let Some(column) = self.column(unknown) else {
                    complain(format!("`{name}` has no part in this loop"), "name coordinates of the loop");
                    continue;
                };
                let taken = self.eliminations.iter().any(|one| one.unknown == unknown)
                    || items.iter().any(|item| item.unknowns.contains(&column));
                if self.driven.contains_key(&unknown) {
                    complain(format!("`{name}` is driven: it can't be solved for"), "remove the drive or the unknown");
                } else if taken {
                    complain(format!("`{name}` is found already"), "name each unknown once");
                } else {
                    unknowns.push(column);
                }
            }
            if unknowns.len() < solve.unknowns.len() {
                continue;
            }
            if rows.len() != unknowns.len() {
                let (have, want) = (rows.len(), unknowns.len());
                let help = if have > want {
                    "name all coordinates that follow from the loop"
                } else {
                    "name as many coordinates as the loop gives equations"
                };
                let loops = if solve.closings().count() > 1 { "loops give" } else { "loop gives" };
                complain(format!("`solve` names {want} unknowns, but the {loops} {have} equations for them"), help);
                continue;
            }
            items.push(Item { number, rows, unknowns });
        }
        if complaints.is_empty() { Ok(items) } else { Err(complaints) }
    }

    /// Eliminates an item's unknowns; whether that is possible at some configuration.
    fn solvable(&self, item: &Item, matrices: &mut [Matrix]) -> bool {
        let mut some = false;
        for matrix in matrices {
            let (mut rows, mut columns) = (item.rows.clone(), item.unknowns.clone());
            let mut sound = true;
            while !rows.is_empty() {
                let pivots = rows.iter().flat_map(|&i| columns.iter().map(move |&j| (i, j)));
                let size = |&(i, j): &(usize, usize)| matrix[i][j].abs();
                let best = pivots.max_by(|a, b| size(a).total_cmp(&size(b)).then(b.cmp(a)));
                let Some((i, j)) = best else { break };
                sound &= matrix[i][j].abs() > PIVOT;
                eliminate(matrix, i, j);
                rows.retain(|&k| k != i);
                columns.retain(|&k| k != j);
            }
            some |= sound;
        }
        some
    }

    fn undetermined(&self, item: &Item) -> Complaint {
        let solve = &self.model.solves[item.number];
        let loops = if solve.closings().count() > 1 { "loops do" } else { "loop does" };
        Complaint {
            at: solve.site(),
            message: format!("the {loops} not determine {}", self.names(&item.unknowns)),
            help: Some("name coordinates that follow from the loop when the others are known".to_owned()),
        }
    }

    /// Dependent coordinates for the rows that are left, each well determined at `quorum` samples and wherever there is a veto.
    fn choose(
        &self,
        samples: &[Matrix],
        veto: &[Matrix],
        rows: &[usize],
        columns: &[usize],
        quorum: usize,
    ) -> Result<Vec<usize>, Vec<Complaint>> {
        let wished = |column: usize| self.model.independent.contains(&self.coordinate(column));
        let turns = |column: usize| self.problem.columns[self.group.columns[column]].turns;
        let mut candidates: Vec<usize> = columns.to_vec();
        candidates.retain(|&k| !wished(k));
        // What stands alone in an equation is found without a guess, and well wherever the mechanism stands.
        let mut explicit: Vec<usize> = Vec::new();
        for row in rows.iter().filter_map(|&row| self.row(row)) {
            let stands_alone = |&&column: &&usize| {
                !explicit.contains(&column) && self.explicit(&[row], &[self.coordinate(column)]).is_some()
            };
            // One for each equation: another one would have to follow from another equation.
            let deepest =
                candidates.iter().filter(stands_alone).max_by_key(|&&k| (self.depth(self.coordinate(k).joint), k));
            explicit.extend(deepest);
        }
        candidates
            .sort_by_key(|&k| std::cmp::Reverse((explicit.contains(&k), self.depth(self.coordinate(k).joint), k)));
        let parts: Vec<HashMap<usize, Vec<f64>>> = samples
            .iter()
            .chain(veto)
            .map(|matrix| {
                let column = |&k: &usize| (k, rows.iter().map(|&row| matrix[row][k]).collect());
                candidates.iter().map(column).collect()
            })
            .collect();
        let mut chosen: Vec<usize> = Vec::new();
        let mut bases = vec![Basis::default(); parts.len()];
        for least in WELL {
            for &column in &candidates {
                if chosen.len() == rows.len() {
                    break;
                }
                if chosen.contains(&column) {
                    continue;
                }
                let votes = bases.iter().zip(&parts).map(|(basis, part)| {
                    part.get(&column).is_some_and(|vector| {
                        let rest = basis.rest(vector);
                        norm(&rest) > least * norm(vector).max(1e-3)
                    })
                });
                let votes: Vec<bool> = votes.collect();
                let (votes, others) = votes.split_at(samples.len());
                if votes.iter().filter(|&&vote| vote).count() >= quorum && !others.contains(&false) {
                    for (basis, part) in bases.iter_mut().zip(&parts) {
                        if let Some(vector) = part.get(&column) {
                            basis.grow(vector, WELL[2] * norm(vector).max(1e-3));
                        }
                    }
                    chosen.push(column);
                }
            }
        }
        if chosen.len() == rows.len() && !chosen.iter().any(|&k| turns(k)) {
            return Ok(chosen);
        }
        let closing = rows.iter().filter_map(|&k| self.row(k)).map(|row| row.closing).min();
        let (at, what) = closing.map_or((self.model.site(), String::new()), |c| thing(self.model, c));
        let complaint = |message: String, help: &str| vec![Complaint { at, message, help: Some(help.to_owned()) }];
        Err(if chosen.iter().any(|&k| turns(k)) {
            // Not even if other coordinates would do: what they are worth on the branch that is meant is not known.
            let message = format!("{what} makes an orientation depend on other coordinates, and it is a quaternion");
            complaint(message, "write `coordinates: RollPitchYaw` at the joint or the body, or name it `independent`")
        } else if columns.iter().any(|&k| wished(k)) {
            let named: Vec<usize> = columns.iter().copied().filter(|&k| wished(k)).collect();
            let message = format!("{what} does not leave all these independent: {}", self.names(&named));
            complaint(message, "take coordinates out of `independent`")
        } else {
            complaint(format!("{what} does not determine its coordinates"), "give a joint of the loop less freedom")
        })
    }

    /// Number of joints between the ground and what this one carries.
    fn depth(&self, joint: JointId) -> usize {
        let carrier =
            |joint: JointId| match self.model.joints[joint].parent.body {
                BodyRef::Ground => None,
                BodyRef::Body(body) => self.model.tree.iter().copied().find(|id| {
                    self.model.joints.get(id.0).is_some_and(|joint| joint.child.body == BodyRef::Body(body))
                }),
            };
        std::iter::successors(Some(joint), |&joint| carrier(joint)).take(self.model.joints.len()).count()
    }

    /// Steps in an order in which each needs earlier ones only.
    fn order(
        &self,
        items: &[Item],
        matrices: &[Matrix],
        rows: &[usize],
        unknowns: &[usize],
    ) -> Result<Vec<Step>, Vec<Complaint>> {
        // Nodes: items, then rows with the unknown that each is matched with.
        let entry = |row: usize, column: usize| matrices.iter().map(|m| m[row][column].abs()).fold(0.0, f64::max);
        let direct: Vec<Vec<usize>> = rows.iter().map(|&row| self.depends(row)).collect();
        let weights: Vec<Vec<(usize, f64)>> = rows
            .iter()
            .map(|&row| {
                let weights = unknowns.iter().enumerate().map(|(k, &column)| (k, entry(row, column)));
                weights.filter(|weight| weight.1 > 1e-9).collect()
            })
            .collect();
        let matched = matching(&weights, unknowns.len());
        let mut node_of: HashMap<usize, usize> = HashMap::new();
        for (node, item) in items.iter().enumerate() {
            node_of.extend(item.unknowns.iter().map(|&column| (column, node)));
        }
        for (k, unknown) in matched.iter().enumerate() {
            if let Some(&column) = unknown.and_then(|unknown| unknowns.get(unknown)) {
                node_of.insert(column, items.len() + k);
            }
        }
        let needs_of = |columns: &mut dyn Iterator<Item = usize>| {
            let mut needs: Vec<usize> = columns.filter_map(|column| node_of.get(&column).copied()).collect();
            needs.sort_unstable();
            needs.dedup();
            needs
        };
        let mut needs: Vec<Vec<usize>> = Vec::new();
        for item in items {
            let own = |column: &usize| !item.unknowns.contains(column);
            let mut columns = item.rows.iter().flat_map(|&row| self.depends(row)).filter(own);
            needs.push(needs_of(&mut columns));
        }
        for columns in &direct {
            needs.push(needs_of(&mut columns.iter().copied()));
        }
        let mut steps = Vec::new();
        for group in components(&needs) {
            let item = group.iter().find(|&&node| node < items.len()).and_then(|&node| items.get(node));
            match item {
                Some(item) if group.len() > 1 => {
                    let at = self.model.solves[item.number].site();
                    let names = self.names(&item.unknowns);
                    let message =
                        format!("{names} can't be solved for here: the loop needs coordinates that follow from them");
                    let help =
                        Some("let the coordinates that the loop needs be independent, or leave this out".to_owned());
                    return Err(vec![Complaint { at, message, help }]);
                }
                Some(item) => {
                    let unknowns = item.unknowns.iter().map(|&column| self.coordinate(column)).collect();
                    steps.push(Step { unknowns, means: Means::Solve(item.number) });
                }
                None => {
                    let places: Vec<usize> = group.iter().map(|node| node - items.len()).collect();
                    let mut found: Vec<usize> = places
                        .iter()
                        .filter_map(|&k| matched[k].and_then(|unknown| unknowns.get(unknown)).copied())
                        .collect();
                    found.sort_unstable();
                    let unknowns: Vec<Coordinate> = found.into_iter().map(|column| self.coordinate(column)).collect();
                    let rows: Vec<Row> = places.iter().filter_map(|&k| self.row(rows[k])).collect();
                    self.check_turns(&rows)?;
                    let means = self.explicit(&rows, &unknowns).unwrap_or(Means::Newton { rows, guess: 0 });
                    steps.push(Step { unknowns, means });
                }
            }
        }
        self.check_teeth(&steps)?;
        Ok(steps)
    }

    /// One equation that is solved for its unknown, if no coupling gives what it reads from that.
    fn explicit(&self, rows: &[Row], unknowns: &[Coordinate]) -> Option<Means> {
        let (&[Row { closing: LoopClosure::Constraint(id), .. }], &[unknown]) = (rows, unknowns) else { return None };
        let place = self.row_of_constraint(id)?;
        let columns = &self.problem.equations[self.group.equations[place]].columns;
        let read = columns.iter().map(|&column| self.problem.columns[column].coordinate);
        let others = read.filter(|&coordinate| coordinate != unknown).collect();
        let leads_back = self.seen_through(others).contains(&unknown) || self.coupling_of(unknown).is_some();
        (!leads_back && linear::stands_alone(self.model, id, unknown)).then_some(Means::Explicit(id))
    }

    /// From a guess a thread that doesn't count its turns could be found on another one.
    fn check_turns(&self, rows: &[Row]) -> Result<(), Vec<Complaint>> {
        // The equation of the travel is a screw's last.
        let last = |row: &&Row| row.index + 1 == row_count(self.model, row.closing);
        for row in rows.iter().filter(last) {
            let LoopClosure::Cut(joint) = row.closing else { continue };
            if is_uncounted(self.model, joint) {
                let (at, what) = thing(self.model, row.closing);
                let message = format!(
                    "{what} can't be reduced: an orientation tells the screw's angle up to whole turns only, and its travel \
                     with it"
                );
                let help = "let all that turns in this loop turn about the screw's axis by joints of one coordinate, whose \
                            turns are counted, or write `constraints: Multipliers`";
                return Err(vec![Complaint { at, message, help: Some(help.to_owned()) }]);
            }
        }
        Ok(())
    }

    /// Columns that an equation depends on, couplings seen through.
    fn depends(&self, place: usize) -> Vec<usize> {
        let columns = &self.problem.equations[self.group.equations[place]].columns;
        let read = columns.iter().map(|&column| self.problem.columns[column].coordinate).collect();
        let mut found: Vec<usize> =
            self.seen_through(read).into_iter().filter_map(|coordinate| self.column(coordinate)).collect();
        found.sort_unstable();
        found.dedup();
        found
    }

    /// Coordinates with what couplings give them from in their places.
    fn seen_through(&self, mut open: Vec<Coordinate>) -> Vec<Coordinate> {
        let mut found = Vec::new();
        while let Some(coordinate) = open.pop() {
            match self.coupling_of(coordinate) {
                Some(one) => open.extend(one.others.iter().copied()),
                None => found.push(coordinate),
            }
        }
        found
    }

    fn coupling_of(&self, coordinate: Coordinate) -> Option<&Elimination> {
        self.eliminations.iter().copied().find(|one| one.unknown == coordinate)
    }
}

fn norm(v: &[f64]) -> f64 {
    dot(v, v).sqrt()
}

/// Takes a column out of all other rows.
pub(super) fn eliminate(matrix: &mut Matrix, row: usize, column: usize) {
    let pivot = matrix[row].clone();
    if pivot[column].abs() <= PIVOT {
        return;
    }
    for (k, other) in matrix.iter_mut().enumerate() {
        let factor = other[column] / pivot[column];
        if k != row && factor != 0.0 {
            add(other, -factor, &pivot);
            other[column] = 0.0;
        }
    }
}
