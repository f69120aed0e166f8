//! Stage `mechanics`: the equations of a mechanism as numbers.
//!
//! In: the model. Out: a [`Problem`]: residuals of all closings and of formulas that a user wrote, with what each of them
//! depends on, evaluated in double precision with parameters at their defaults and inputs at zero. Columns are velocity
//! coordinates of the tree; travels count in units of the mechanism's size, so that they compare with angles. Where time has
//! a say each start has a time of its own: what holds at time zero alone does not hold.

use crate::contracts::symbol::Symbol;
use crate::dynamics::tree::Motion;
use crate::mechanics::loops::constraints::{Writing, closings, is_length};
use crate::mechanics::loops::reduction::Reduction;
use crate::mechanics::loops::structure::Row;
use crate::mechanics::translate::symbols::{Symbols, has_quaternion};
use crate::model::types::{Closing, ConstraintKind, Coordinate, Handling, JointId, Model, SolveHow};
use crate::symbolic::graph::{Graph, Scalar};
use crate::symbolic::lower::Lowering;

use super::super::equations::{Equations, Method, Style, Way};
use super::measure::{Gap, Measure};
use super::tape::{Tape, Values};

/// Where an equation comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Source {
    Row(Row),
    /// Unknown minus formula: number of the `solve` item and of its unknown.
    Formula(usize, usize),
}

/// One scalar equation.
pub(super) struct Equation {
    pub source: Source,
    /// Columns that it depends on, in order.
    pub columns: Vec<usize>,
    /// Whether a parameter has a say.
    pub adjustable: bool,
    /// Whether time has.
    pub timed: bool,
    /// Whether what slopes it has are rounding: it has no columns then.
    pub constant: bool,
    pub(super) root: usize,
    pub(super) measure: Measure,
    /// A typical length of its gradient, or what that would be if it had one above rounding.
    pub(super) scale: f64,
}

/// A column.
pub(super) struct Column {
    pub coordinate: Coordinate,
    /// Part of a quaternion: no scalar of its own.
    pub turns: bool,
    /// A length, no angle.
    pub travels: bool,
    /// What counts as one.
    pub(super) unit: f64,
}

/// How a symbol moves with the columns.
#[derive(Clone, Copy)]
enum Mover {
    Rests,
    Straight(usize),
    /// Component of the quaternion with this number.
    Turns(usize, usize),
}

struct Quaternion {
    /// First symbol of four.
    symbol: usize,
    /// First column of three.
    column: usize,
}

/// Cosine that is one where a joint is closed as it was meant.
struct Alignment {
    closing: Closing,
    root: usize,
    columns: Vec<usize>,
}

/// A condition of a `solve` item: not zero where it holds.
struct Condition {
    root: usize,
    columns: Vec<usize>,
}

pub(super) struct Problem {
    pub(super) tape: Tape,
    pub equations: Vec<Equation>,
    pub columns: Vec<Column>,
    alignments: Vec<Alignment>,
    conditions: Vec<Condition>,
    movers: Vec<Mover>,
    quaternions: Vec<Quaternion>,
    /// By joint the symbols of its position.
    positions: Vec<Vec<usize>>,
    /// Its symbol.
    time: Option<usize>,
    /// By symbol the parameter that it is, and the element.
    parameters: Vec<Option<(usize, usize)>>,
    pub(super) defaults: Vec<f64>,
    /// Positions that drives give at time zero, with the tape's roots for them.
    driven: Vec<(usize, usize)>,
    /// m
    pub size: f64,
}

/// Values of all symbols.
#[derive(Clone)]
pub(super) struct Point(pub(super) Vec<f64>);

/// Rows of numbers at one point.
#[derive(Clone, Default)]
pub(super) struct Linearised {
    pub residuals: Vec<f64>,
    /// (column, entry)
    pub rows: Vec<Vec<(usize, f64)>>,
}

pub(super) const WAY: Way =
    Way { style: Style::Nested, method: Method::Composite, axes: None, writing: Writing::PLAIN };

impl Problem {
    pub(super) fn new(model: &Model) -> Problem {
        Problem::with(model, 0.0)
    }

    /// With parameters that are off their defaults by about this much.
    pub(super) fn with(model: &Model, off: f64) -> Problem {
        Problem::made(model, off, Writing::PLAIN)
    }

    /// With equations of loops in other axes.
    pub(super) fn written(model: &Model, writing: Writing) -> Problem {
        Problem::made(model, 0.0, writing)
    }

    fn made(model: &Model, off: f64, writing: Writing) -> Problem {
        let mut graph = Graph::new();
        let symbols = Symbols::new(&mut graph, model);
        let mut e = Equations::new(model, graph, symbols, WAY, &[]);
        let mut roots: Vec<Scalar> = Vec::new();
        let mut sources = Vec::new();
        let mut cosines = Vec::new();
        let mut rods: Vec<Scalar> = Vec::new();
        let mut measures: Vec<Measure> = Vec::new();
        for closing in closings(model) {
            let rod = e.rod_length(closing);
            rods.extend(rod);
            let residuals = e.residuals(closing, writing);
            for (index, residual) in residuals.into_iter().enumerate() {
                measures.push(match closing {
                    Closing::Constraint(_) if rod.is_some() => Measure::Rod(rods.len() - 1),
                    Closing::Constraint(_) => Measure::Value,
                    Closing::Cut(_) if is_length(model, closing, index) => Measure::Length,
                    Closing::Cut(_) => Measure::Cosine,
                });
                sources.push((Source::Row(Row { closing, index }), residual));
            }
            cosines.extend(e.alignments(closing).into_iter().map(|cosine| (closing, cosine)));
        }
        for (number, solve) in model.solves.iter().enumerate() {
            let (SolveHow::Formulas(list), Handling::Reduced) = (&solve.how, &model.handling) else { continue };
            for (k, (formula, unknown)) in list.iter().zip(&solve.unknowns).enumerate() {
                let value = e.scalar(formula);
                let x = Symbols::of(&e.symbols.positions, unknown.joint).get(unknown.index).copied();
                let residual = e.g.sub(x.unwrap_or(Scalar::ZERO), value);
                sources.push((Source::Formula(number, k), residual));
                measures.push(Measure::Value);
            }
        }
        roots.extend(sources.iter().map(|source| source.1));
        roots.extend(cosines.iter().map(|cosine| cosine.1));
        let lengths = roots.len();
        for measure in &mut measures {
            if let Measure::Rod(number) = measure {
                *number += lengths;
            }
        }
        roots.extend(rods);
        roots.extend(e.lengths());
        let scaled = lengths..roots.len();
        roots.extend(e.spans());
        let spans = scaled.end..roots.len();
        let first_condition = roots.len();
        roots.extend(e.conditions());
        let conditions = first_condition..roots.len();
        let driven = e.driven();
        let driven: Vec<(usize, usize)> = driven
            .into_iter()
            .map(|(symbol, value)| {
                roots.push(value);
                (symbol, roots.len() - 1)
            })
            .collect();
        let (movers, quaternions, columns) = columns(model, &e);
        let positions = e.symbols.positions.iter();
        let positions =
            positions.map(|list| list.iter().filter_map(|&s| Some(e.g.symbol_id(s)?.0)).collect()).collect();
        let mut lowering = Lowering::new(&e.g);
        let roots = lowering.run(&roots);
        let tape = Tape::new(&lowering.to, &roots);
        let defaults = defaults(model, &e.symbols, off);
        let parameters: Vec<Option<(usize, usize)>> = (e.symbols.table.iter())
            .map(|symbol| match *symbol {
                Symbol::Param { param, element } => Some((param.0, element)),
                _ => None,
            })
            .collect();
        let parameter = |&id: &usize| matches!(parameters.get(id), Some(Some(_)));
        let time = e.symbols.table.iter().position(|symbol| matches!(symbol, Symbol::Time));
        let columns_of = |root: usize| {
            let mut list: Vec<usize> = Vec::new();
            for id in tape.symbols(root) {
                match movers.get(id) {
                    Some(&Mover::Straight(column)) => list.push(column),
                    Some(&Mover::Turns(number, _)) => {
                        let first = quaternions.get(number).map_or(0, |q: &Quaternion| q.column);
                        list.extend(first..first + 3);
                    }
                    _ => {}
                }
            }
            list.sort_unstable();
            list.dedup();
            list
        };
        let equations = sources.iter().zip(measures).enumerate().map(|(root, (&(source, _), measure))| {
            let symbols = tape.symbols(root);
            let adjustable = symbols.iter().any(parameter);
            let timed = symbols.iter().any(|&id| Some(id) == time);
            let columns = columns_of(root);
            Equation { source, columns, adjustable, timed, constant: false, root, measure, scale: 1.0 }
        });
        let equations: Vec<Equation> = equations.collect();
        let first = equations.len();
        let alignments = cosines.iter().enumerate();
        let alignments = alignments
            .map(|(k, &(closing, _))| Alignment { closing, root: first + k, columns: columns_of(first + k) })
            .collect();
        let conditions = conditions.map(|root| Condition { root, columns: columns_of(root) }).collect();
        let mut problem = Problem {
            tape,
            equations,
            columns,
            alignments,
            conditions,
            movers,
            quaternions,
            positions,
            time,
            parameters,
            defaults,
            driven,
            size: 1.0,
        };
        problem.measure(scaled, spans);
        problem
    }

    /// Equations that depend on no coordinate. Those of time are looked at twice: it should make no difference to them.
    pub(super) fn constants(&self) -> Vec<(usize, Gap)> {
        let mut values = Values::default();
        let mut point = Point(self.defaults.clone());
        let constant = |k: &usize| self.equations[*k].columns.is_empty();
        let constant: Vec<usize> = (0..self.equations.len()).filter(constant).collect();
        self.tape.run(&mut values, &point.0);
        let mut list: Vec<(usize, Gap)> = constant.into_iter().map(|k| (k, self.gap(&values, &[k]))).collect();
        if list.iter().any(|one| self.equations[one.0].timed) {
            self.put_time(&mut point, 0.377);
            self.tape.run(&mut values, &point.0);
            list.iter_mut().for_each(|(k, gap)| gap.widen(&self.gap(&values, &[*k])));
        }
        list
    }

    /// Parameters that have a say in some equations: their symbols, with number and element.
    pub(super) fn parameters_of(&self, equations: &[usize]) -> Vec<(usize, (usize, usize))> {
        let mut symbols: Vec<usize> =
            equations.iter().flat_map(|&k| self.tape.symbols(self.equations[k].root)).collect();
        symbols.sort_unstable();
        symbols.dedup();
        symbols.into_iter().filter_map(|id| Some((id, (*self.parameters.get(id)?)?))).collect()
    }

    /// The place of a closing's row.
    pub(super) fn equation_of(&self, row: Row) -> Option<usize> {
        self.equations.iter().position(|one| one.source == Source::Row(row))
    }

    /// Of unit length over all columns. Gradients that vanish, as a cosine's does at one, stay zero and don't become noise.
    pub(super) fn unit_row(&self, row: &[(usize, f64)]) -> Vec<f64> {
        let mut dense = vec![0.0; self.columns.len()];
        for &(column, entry) in row {
            if let Some(slot) = dense.get_mut(column) {
                *slot += entry;
            }
        }
        let norm = dense.iter().map(|x| x * x).sum::<f64>().sqrt();
        let factor = if norm > 1e-7 { 1.0 / norm } else { 0.0 };
        dense.iter_mut().for_each(|x| *x *= factor);
        dense
    }

    /// Closings that move nothing, and are closed with axes that point the wrong way.
    pub(super) fn reversed(&self) -> Vec<Closing> {
        let mut values = Values::default();
        self.tape.run(&mut values, &self.defaults);
        let of = |equation: &Equation, closing: Closing| matches!(equation.source, Source::Row(row) if row.closing == closing);
        let still = |closing: Closing| self.equations.iter().all(|one| !of(one, closing) || one.columns.is_empty());
        let wrong = self.alignments.iter().filter(|one| self.tape.value(&values, one.root) < 0.5 && still(one.closing));
        wrong.map(|one| one.closing).collect()
    }

    /// Random coordinates; `amplitude` one fills the circle and twice the mechanism's size. The time is at random too, more
    /// often soon than late, since some drives leave a loop's reach after a while.
    pub(super) fn start(&self, random: &mut Random, amplitude: f64) -> Point {
        let way = 0.5 * (Random(!random.0).next() + 1.0);
        let mut point = self.shaken(&Point(self.defaults.clone()), random, amplitude, &[]);
        self.put_time(&mut point, 1e-4 + way.powi(4));
        point
    }

    pub(super) fn put_time(&self, point: &mut Point, time: f64) {
        if let Some(slot) = self.time.and_then(|symbol| point.0.get_mut(symbol)) {
            *slot = time;
        }
    }

    /// A point at random around another; columns that are held stay.
    pub(super) fn shaken(&self, from: &Point, random: &mut Random, amplitude: f64, held: &[bool]) -> Point {
        let mut point = from.clone();
        let columns = self.columns.iter().enumerate();
        let step = columns.map(|(k, column)| {
            let way = amplitude * random.next() * if column.unit == 1.0 { 3.0 } else { 1.0 };
            if held.get(k) == Some(&true) { 0.0 } else { way }
        });
        let step: Vec<f64> = step.collect();
        self.displace(&mut point, &step);
        point
    }

    /// Where coordinates stand by default: zero, orientations that turn nothing, drives at time zero.
    pub(super) fn origin(&self) -> Point {
        let mut point = Point(self.defaults.clone());
        if !self.driven.is_empty() {
            let mut values = Values::default();
            self.tape.run(&mut values, &self.defaults);
            for &(symbol, root) in &self.driven {
                let value = self.tape.value(&values, root);
                if let (Some(slot), true) = (point.0.get_mut(symbol), value.is_finite()) {
                    *slot = value;
                }
            }
        }
        point
    }

    /// Takes over what some columns move.
    pub(super) fn take(&self, point: &mut Point, from: &Point, columns: &[usize]) {
        for (k, mover) in self.movers.iter().enumerate() {
            let column = match *mover {
                Mover::Rests => continue,
                Mover::Straight(column) => column,
                Mover::Turns(number, _) => self.quaternions.get(number).map_or(usize::MAX, |q| q.column),
            };
            if let (true, Some(slot), Some(&value)) = (columns.contains(&column), point.0.get_mut(k), from.0.get(k)) {
                *slot = value;
            }
        }
    }

    /// Where joints have these positions.
    pub(super) fn at(&self, positions: &[Vec<f64>]) -> Point {
        let mut point = Point(self.defaults.clone());
        for (&symbol, &value) in self.positions.iter().flatten().zip(positions.iter().flatten()) {
            if let Some(slot) = point.0.get_mut(symbol) {
                *slot = value;
            }
        }
        point
    }

    /// By joint the components of its position.
    pub(super) fn positions(&self, point: &Point) -> Vec<Vec<f64>> {
        let value = |&symbol: &usize| point.0.get(symbol).copied().unwrap_or(0.0);
        self.positions.iter().map(|symbols| symbols.iter().map(value).collect()).collect()
    }

    /// What counts as one in the column that a symbol moves with; zero where there is none.
    pub(super) fn unit_of(&self, symbol: usize) -> f64 {
        match self.movers.get(symbol) {
            Some(&Mover::Straight(column)) => self.columns[column].unit,
            Some(Mover::Turns(..)) => 1.0,
            _ => 0.0,
        }
    }

    /// Moves along scaled columns.
    pub(super) fn displace(&self, point: &mut Point, step: &[f64]) {
        for (value, mover) in point.0.iter_mut().zip(&self.movers) {
            if let Mover::Straight(column) = *mover {
                *value += self.columns[column].unit * step[column];
            }
        }
        for quaternion in &self.quaternions {
            let Some(q) = point.0.get_mut(quaternion.symbol..quaternion.symbol + 4) else { continue };
            let w = &step[quaternion.column..quaternion.column + 3];
            let angle = (w[0] * w[0] + w[1] * w[1] + w[2] * w[2]).sqrt();
            let sinc = if angle < 1e-9 { 0.5 } else { (0.5 * angle).sin() / angle };
            let turn = [(0.5 * angle).cos(), w[0] * sinc, w[1] * sinc, w[2] * sinc];
            let turned = multiply([q[0], q[1], q[2], q[3]], turn);
            let norm = turned.iter().map(|x| x * x).sum::<f64>().sqrt();
            for (slot, x) in q.iter_mut().zip(turned) {
                *slot = x / norm;
            }
        }
    }

    /// Scaled residuals of some equations.
    pub(super) fn residuals(&self, point: &Point, equations: &[usize], values: &mut Values) -> Vec<f64> {
        self.tape.run(values, &point.0);
        let residual = |&k: &usize| {
            let equation = &self.equations[k];
            self.tape.value(values, equation.root) / equation.scale
        };
        equations.iter().map(residual).collect()
    }

    /// Scaled residuals and Jacobian by scaled columns.
    pub(super) fn linearise(&self, point: &Point, equations: &[usize], values: &mut Values) -> Linearised {
        let residuals = self.residuals(point, equations, values);
        let rows = equations.iter().map(|&k| {
            let equation = &self.equations[k];
            self.gradient(point, equation.root, 1.0 / equation.scale, values)
        });
        Linearised { rows: rows.collect(), residuals }
    }

    /// Numbers of the alignments that some columns have a say in.
    pub(super) fn alignments_of(&self, columns: &[usize]) -> Vec<usize> {
        let own = |&k: &usize| self.alignments[k].columns.iter().any(|column| columns.contains(column));
        (0..self.alignments.len()).filter(own).collect()
    }

    /// Columns that belong together though no equation says so: those that tell a joint from its opposite.
    pub(super) fn bonds(&self) -> impl Iterator<Item = &[usize]> {
        self.alignments.iter().map(|one| one.columns.as_slice())
    }

    /// Whether the conditions of `solve` items hold that speak of some columns alone.
    pub(super) fn is_meant(&self, point: &Point, columns: &[usize], values: &mut Values) -> bool {
        let own = |one: &&Condition| one.columns.iter().all(|column| columns.contains(column));
        let mut own = self.conditions.iter().filter(own).peekable();
        if own.peek().is_none() {
            return true;
        }
        self.tape.run(values, &point.0);
        own.all(|one| self.tape.value(values, one.root) != 0.0)
    }

    /// How far cosines are from one, after an evaluation.
    pub(super) fn misalignments(&self, list: &[usize], values: &Values) -> Vec<f64> {
        list.iter().map(|&k| self.tape.value(values, self.alignments[k].root) - 1.0).collect()
    }

    pub(super) fn alignment_rows(&self, point: &Point, list: &[usize], values: &mut Values) -> Vec<Vec<(usize, f64)>> {
        list.iter().map(|&k| self.gradient(point, self.alignments[k].root, 1.0, values)).collect()
    }

    pub(super) fn gradient(&self, point: &Point, root: usize, factor: f64, values: &mut Values) -> Vec<(usize, f64)> {
        let mut row: Vec<(usize, f64)> = Vec::new();
        let mut turns: Vec<(usize, [f64; 4])> = Vec::new();
        self.tape.gradient(values, root, |symbol, slope| match self.movers.get(symbol) {
            Some(&Mover::Straight(column)) => row.push((column, slope * factor * self.columns[column].unit)),
            Some(&Mover::Turns(number, component)) => match turns.iter_mut().find(|turn| turn.0 == number) {
                Some(turn) => turn.1[component] += slope * factor,
                None => {
                    let mut slopes = [0.0; 4];
                    slopes[component] = slope * factor;
                    turns.push((number, slopes));
                }
            },
            _ => {}
        });
        for (number, slopes) in turns {
            let quaternion = &self.quaternions[number];
            let Some(&[w, i, j, k]) = point.0.get(quaternion.symbol..quaternion.symbol + 4) else { continue };
            for axis in 0..3 {
                let mut unit = [0.0; 4];
                unit[axis + 1] = 0.5;
                let rate = multiply([w, i, j, k], unit);
                let entry: f64 = slopes.iter().zip(rate).map(|(a, b)| a * b).sum();
                row.push((quaternion.column + axis, entry));
            }
        }
        row
    }
}

impl Equations<'_> {
    fn rod_length(&mut self, closing: Closing) -> Option<Scalar> {
        let Closing::Constraint(id) = closing else { return None };
        match &self.model.constraints.get(id.0)?.kind {
            ConstraintKind::Rod { length, .. } => Some(self.scalar(length)),
            ConstraintKind::Value(_) => None,
        }
    }

    /// Symbols of positions that drives give, with the values.
    fn driven(&mut self) -> Vec<(usize, Scalar)> {
        if self.model.drives.is_empty() {
            return Vec::new();
        }
        let mut reduction = Reduction::default();
        self.drive(&mut reduction);
        let positions: Vec<Scalar> = self.symbols.positions.concat();
        let ids = positions.iter().filter_map(|&s| self.g.symbol_id(s));
        ids.filter_map(|id| reduction.map.get(&id).map(|&value| (id.0, value))).collect()
    }

    /// Conditions of `solve` items.
    fn conditions(&mut self) -> Vec<Scalar> {
        let model = self.model;
        let mut list = Vec::new();
        for solve in &model.solves {
            if let SolveHow::From { branches, .. } = &solve.how {
                list.extend(branches.iter().map(|condition| self.scalar(condition)));
            }
        }
        list
    }

    /// Masses and traces of second moments: how far bodies reach.
    fn spans(&mut self) -> Vec<Scalar> {
        let mechanism = std::rc::Rc::clone(&self.mechanism);
        let mut spans = Vec::new();
        for link in &mechanism.tree.links {
            let [xx, yy, zz, ..] = link.inertia.second;
            spans.extend([link.inertia.mass, self.g.sum(&[xx, yy, zz])]);
        }
        spans
    }

    /// Constant lengths of the mechanism, component by component.
    fn lengths(&mut self) -> Vec<Scalar> {
        let mechanism = std::rc::Rc::clone(&self.mechanism);
        let model = self.model;
        let mut offsets: Vec<_> = mechanism.tree.links.iter().map(|link| link.offset).collect();
        let mut lengths = Vec::new();
        let mut frames = Vec::new();
        for joint in model.cuts.iter().filter_map(|id| model.joints.get(id.0)) {
            frames.extend([&joint.parent, &joint.child]);
        }
        for constraint in &model.constraints {
            if let ConstraintKind::Rod { between, length } = &constraint.kind {
                frames.extend(between.iter());
                lengths.push(self.scalar(length));
            }
        }
        offsets.extend(frames.into_iter().map(|frame| self.place(frame).offset));
        for offset in offsets {
            lengths.extend(self.g.components(offset));
        }
        lengths
    }
}

fn columns(model: &Model, e: &Equations<'_>) -> (Vec<Mover>, Vec<Quaternion>, Vec<Column>) {
    let mut movers = vec![Mover::Rests; e.symbols.table.len()];
    let mut quaternions: Vec<Quaternion> = Vec::new();
    let mut columns: Vec<Column> = Vec::new();
    for (joint, velocities) in e.symbols.velocities.iter().enumerate() {
        let id = JointId(joint);
        let first = columns.len();
        let turns = model.joints.get(joint).is_some_and(has_quaternion) && velocities.len() >= 3;
        let straight = velocities.len() - if turns { 3 } else { 0 };
        for index in 0..velocities.len() {
            columns.push(Column {
                coordinate: Coordinate { joint: id, index },
                turns: index >= straight,
                travels: false,
                unit: 1.0,
            });
        }
        if turns {
            quaternions.push(Quaternion { symbol: usize::MAX, column: first + straight });
        }
        for (id, symbol) in e.symbols.table.iter().enumerate() {
            let Symbol::Position { joint: at, component } = *symbol else { continue };
            if at.0 != joint {
                continue;
            }
            if component < straight {
                movers[id] = Mover::Straight(first + component);
            } else if let Some(last) = quaternions.last_mut() {
                last.symbol = last.symbol.min(id);
                movers[id] = Mover::Turns(quaternions.len() - 1, component - straight);
            }
        }
    }
    for link in &e.mechanism.tree.links {
        if let (Motion::Prismatic(_), Some(column)) = (link.motion, columns.get_mut(link.freedom)) {
            // Negative: in units of the size, which is not known yet.
            (column.travels, column.unit) = (true, -1.0);
        }
    }
    (movers, quaternions, columns)
}

/// Parameters near their defaults, orientations that turn nothing, all else zero.
fn defaults(model: &Model, symbols: &Symbols, off: f64) -> Vec<f64> {
    let mut random = Random(11);
    let value = |symbol: &Symbol| match *symbol {
        Symbol::Param { param, element } => {
            let default = model.params.get(param.0).and_then(|param| param.default.get(element)).copied();
            let default = default.unwrap_or(0.0);
            default + off * (1.0 + default.abs()) * random.next()
        }
        Symbol::Position { joint, component } => {
            let joint = model.joints.get(joint.0);
            let turns = joint.is_some_and(|joint| has_quaternion(joint) && component == joint.kind.freedoms() - 3);
            f64::from(u8::from(turns))
        }
        _ => 0.0,
    };
    symbols.table.iter().map(value).collect()
}

fn multiply(p: [f64; 4], q: [f64; 4]) -> [f64; 4] {
    [
        p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3],
        p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2],
        p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1],
        p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0],
    ]
}

/// Numbers between -1 and 1 (SplitMix64), the same in every build.
pub(super) struct Random(pub u64);

impl Random {
    pub(super) fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let x = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let x = (x ^ (x >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((x ^ (x >> 31)) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}
