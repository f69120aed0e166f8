//! Stage `mechanics`: the equations of a mechanism in symbols, as a tape evaluates them.
//!
//! In: the model. Out: a [`Problem`]: every equation with its source, its measure and its columns, and beside the equations
//! what says how large they are, which way joints close and which branch was meant.

use std::ops::Range;

use crate::contracts::symbol::Symbol;
use crate::dynamics::tree::Motion;
use crate::invariant::fault::OrFault;
use crate::mechanics::equations::Equations;
use crate::mechanics::loops::constraints::{Writing, closings, is_length, rates};
use crate::mechanics::loops::reduction::Reduction;
use crate::mechanics::loops::structure::Row;
use crate::mechanics::translate::symbols::{Symbols, has_quaternion};
use crate::model::types::{ConstraintKind, Coordinate, Handling, Joint, JointId, LoopClosure, Model, SolveHow};
use crate::symbolic::graph::Scalar;
use crate::symbolic::lower::Lowering;

use super::super::measure::Measure;
use super::super::tape::Tape;
use super::{Alignment, Column, Condition, Equation, Gimbal, Mover, Problem, Quaternion, Random, Rate, Source, Speed};

/// An equation in symbols.
struct Draft {
    source: Source,
    residual: Scalar,
    measure: Measure<Scalar>,
    recurs: bool,
}

/// A cosine that is one where a joint is closed as it was meant.
struct Cosine {
    closing: LoopClosure,
    value: Scalar,
    recurs: bool,
}

/// What the tape computes, in the order in which it was asked for.
#[derive(Default)]
struct Roots(Vec<Scalar>);

impl Roots {
    /// Its number.
    fn push(&mut self, value: Scalar) -> usize {
        self.0.push(value);
        self.0.len() - 1
    }

    fn extend(&mut self, values: impl IntoIterator<Item = Scalar>) -> Range<usize> {
        let first = self.0.len();
        self.0.extend(values);
        first..self.0.len()
    }
}

pub(super) fn formulate(model: &Model, off: f64, writing: Writing) -> Problem {
    let mut e = Equations::plain(model);
    let (mut drafts, cosines) = e.closing_drafts(writing);
    drafts.extend(e.formula_drafts());
    let mut roots = Roots::default();
    let residuals = roots.extend(drafts.iter().map(|draft| draft.residual));
    let directions = roots.extend(cosines.iter().map(|cosine| cosine.value));
    let first = roots.0.len();
    let measures: Vec<Measure> = drafts.iter().map(|draft| draft.measure.map(|rod| roots.push(rod))).collect();
    roots.extend(e.lengths());
    let lengths = first..roots.0.len();
    let spans = roots.extend(e.spans());
    let conditions = roots.extend(e.conditions());
    let assumptions = roots.extend(model.assumptions.iter().map(|condition| e.scalar(condition)).collect::<Vec<_>>());
    let driven: Vec<(usize, usize)> =
        e.driven().into_iter().map(|(symbol, value)| (symbol, roots.push(value))).collect();
    let (movers, quaternions, columns) = columns(model, &e);
    let rates = e.rate_drafts(&columns, &mut roots);
    let speeds = e.speed_drafts(&columns, &mut roots);
    let gimbals = gimbals(model, &columns, &movers);
    let positions = e.scene.symbols.positions.iter();
    let positions = positions.map(|list| list.iter().filter_map(|&s| Some(e.g.symbol_id(s)?.0)).collect()).collect();
    let mut lowering = Lowering::new(&e.g);
    let roots = lowering.run(&roots.0);
    let tape = Tape::new(&lowering.to, &roots);
    let parameters = parameters(&e.scene.symbols);
    let time = e.scene.symbols.table.iter().position(|symbol| matches!(symbol, Symbol::Time));
    let states = (0..e.scene.symbols.table.len())
        .filter(|&k| matches!(e.scene.symbols.table[k], Symbol::State { .. }))
        .collect();
    let columns_of = |root: usize| columns_of(&tape.symbols(root), &movers, &quaternions);
    let equations = drafts.iter().zip(measures).zip(residuals).map(|((draft, measure), root)| {
        let symbols = tape.symbols(root);
        Equation {
            source: draft.source,
            columns: columns_of(root),
            adjustable: symbols.iter().any(|&id| matches!(parameters.get(id), Some(Some(_)))),
            timed: symbols.iter().any(|&id| Some(id) == time),
            recurs: draft.recurs,
            constant: false,
            root,
            measure,
            scale: 1.0,
        }
    });
    let equations = equations.collect();
    let alignments = cosines.iter().zip(directions).map(|(cosine, root)| {
        let Cosine { closing, recurs, .. } = *cosine;
        Alignment { closing, recurs, root, columns: columns_of(root) }
    });
    let alignments = alignments.collect();
    let condition = |root: usize| Condition { root, columns: columns_of(root) };
    let (conditions, assumptions) = (conditions.map(condition).collect(), assumptions.map(condition).collect());
    let defaults = defaults(model, &e.scene.symbols, off);
    let mut problem = Problem {
        writing,
        tape,
        equations,
        columns,
        alignments,
        conditions,
        assumptions,
        rates,
        speeds,
        movers,
        quaternions,
        gimbals,
        positions,
        time,
        states,
        parameters,
        defaults,
        driven,
        size: 1.0,
    };
    problem.measure(lengths, spans);
    problem
}

/// Slopes by column, with the roots of their values.
fn in_columns(slopes: Vec<(Coordinate, Scalar)>, columns: &[Column], roots: &mut Roots) -> Vec<(usize, usize)> {
    let placed = slopes.into_iter().filter_map(|(coordinate, slope)| {
        let column = columns.iter().position(|column| column.coordinate == coordinate)?;
        Some((column, roots.push(slope)))
    });
    placed.collect()
}

impl Equations<'_> {
    /// Equations of all closings, and the cosines that are one where joints are closed as they were meant.
    fn closing_drafts(&mut self, writing: Writing) -> (Vec<Draft>, Vec<Cosine>) {
        let model = self.scene.model;
        let (mut drafts, mut cosines) = (Vec::new(), Vec::new());
        for closing in closings(model) {
            let rod = self.rod_length(closing);
            // Equation and cosine of a thread come last.
            let thread = matches!(closing, LoopClosure::Cut(joint) if self.turns_unknown(joint));
            let residuals = self.residuals(closing, writing);
            let count = residuals.len();
            for (index, residual) in residuals.into_iter().enumerate() {
                let measure = match (closing, rod) {
                    (LoopClosure::Constraint(_), Some(length)) => Measure::Rod(length),
                    (LoopClosure::Constraint(_), None) => Measure::Value,
                    (LoopClosure::Cut(_), _) if is_length(model, closing, index) => Measure::Length,
                    (LoopClosure::Cut(_), _) => Measure::Cosine,
                };
                let recurs = thread && index + 1 == count;
                drafts.push(Draft { source: Source::Row(Row { closing, index }), residual, measure, recurs });
            }
            let values = self.alignments(closing);
            let count = values.len();
            let cosine = |(k, value)| Cosine { closing, value, recurs: thread && k + 1 == count };
            cosines.extend(values.into_iter().enumerate().map(cosine));
        }
        (drafts, cosines)
    }

    /// Equations of velocities: the roots of their slopes by column, and of what is left at rest.
    fn rate_drafts(&mut self, columns: &[Column], roots: &mut Roots) -> Vec<Rate> {
        let rows = rates::rate_rows(self.scene.model).into_iter();
        let drafts = rows.map(|row| {
            let slopes = in_columns(self.rate_slopes(row), columns, roots);
            let rate = self.rate_expression(row).or_fault("an equation of velocities has an expression");
            let still = self.scene.symbols.velocities.concat().into_iter().map(|v| (v, Scalar::ZERO));
            let still = self.map(&still.collect::<Vec<_>>());
            let rest = self.g.substitute(&[rate], &still)[0];
            let is_nothing = rate == Scalar::ZERO;
            Rate { row, slopes, rest: roots.push(rest), is_nothing }
        });
        drafts.collect()
    }

    /// Speeds of the user's choice: the roots of their slopes by column.
    fn speed_drafts(&mut self, columns: &[Column], roots: &mut Roots) -> Vec<Speed> {
        let model = self.scene.model;
        let drafts = model.speeds.iter().map(|speed| {
            let value = self.scalar(&speed.value);
            Speed { slopes: in_columns(self.slopes_by_velocity(value), columns, roots) }
        });
        drafts.collect()
    }

    /// Unknowns minus the formulas of `solve` items.
    fn formula_drafts(&mut self) -> Vec<Draft> {
        let model = self.scene.model;
        let mut drafts = Vec::new();
        for (number, solve) in model.solves.iter().enumerate() {
            let (SolveHow::Formulas(list), Handling::Reduced) = (&solve.how, &model.handling) else { continue };
            for (k, (formula, unknown)) in list.iter().zip(&solve.unknowns).enumerate() {
                let value = self.scalar(formula);
                let x = Symbols::of(&self.scene.symbols.positions, unknown.joint)[unknown.index];
                let residual = self.g.sub(x, value);
                drafts.push(Draft {
                    source: Source::Formula(number, k),
                    residual,
                    measure: Measure::Value,
                    recurs: false,
                });
            }
        }
        drafts
    }

    fn rod_length(&mut self, closing: LoopClosure) -> Option<Scalar> {
        let LoopClosure::Constraint(id) = closing else { return None };
        match &self.scene.model.constraints[id].kind {
            ConstraintKind::Rod { length, .. } => Some(self.scalar(length)),
            ConstraintKind::Value(_) | ConstraintKind::Rate(_) => None,
        }
    }

    /// Symbols of positions that drives give, with the values.
    fn driven(&mut self) -> Vec<(usize, Scalar)> {
        if self.scene.model.drives.is_empty() {
            return Vec::new();
        }
        let mut reduction = Reduction::default();
        self.drive(&mut reduction);
        let positions: Vec<Scalar> = self.scene.symbols.positions.concat();
        let ids = positions.iter().filter_map(|&s| self.g.symbol_id(s));
        ids.filter_map(|id| reduction.map.get(&id).map(|&value| (id.0, value))).collect()
    }

    /// Conditions of `solve` items.
    fn conditions(&mut self) -> Vec<Scalar> {
        let model = self.scene.model;
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
        let mechanism = std::rc::Rc::clone(&self.scene.mechanism);
        let mut spans = Vec::new();
        for link in &mechanism.tree.links {
            let [xx, yy, zz, ..] = link.inertia.second;
            spans.extend([link.inertia.mass, self.g.sum(&[xx, yy, zz])]);
        }
        spans
    }

    /// Constant lengths of the mechanism, component by component.
    fn lengths(&mut self) -> Vec<Scalar> {
        let mechanism = std::rc::Rc::clone(&self.scene.mechanism);
        let model = self.scene.model;
        let mut offsets: Vec<_> = mechanism.tree.links.iter().map(|link| link.offset).collect();
        let mut lengths = Vec::new();
        let mut frames = Vec::new();
        for joint in model.cuts.iter().map(|&id| &model.joints[id]) {
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
    let mut movers = vec![Mover::Rests; e.scene.symbols.table.len()];
    let mut quaternions: Vec<Quaternion> = Vec::new();
    let mut columns: Vec<Column> = Vec::new();
    for (joint, velocities) in e.scene.symbols.velocities.iter().enumerate() {
        let id = JointId(joint);
        let first = columns.len();
        let turns = has_quaternion(&model.joints[id]) && velocities.len() >= 3;
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
        for (id, symbol) in e.scene.symbols.table.iter().enumerate() {
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
    for link in &e.scene.mechanism.tree.links {
        if let (Motion::Prismatic(_), Some(column)) = (link.motion, columns.get_mut(link.freedom)) {
            // Negative: in units of the size, which is not known yet.
            (column.travels, column.unit) = (true, -1.0);
        }
    }
    (movers, quaternions, columns)
}

/// Joints that turn by roll, pitch and yaw, their last three coordinates.
fn gimbals(model: &Model, columns: &[Column], movers: &[Mover]) -> Vec<Gimbal> {
    let triple = |(number, joint): (usize, &Joint)| {
        let freedoms = joint.kind.freedoms();
        let of =
            |index| columns.iter().position(|column| column.coordinate == Coordinate { joint: JointId(number), index });
        let first = of(freedoms.checked_sub(3)?).filter(|_| joint.kind.has_angles())?;
        let is_pitch = |mover: &Mover| matches!(mover, Mover::Straight(column) if *column == first + 1);
        Some(Gimbal { columns: [first, first + 1, first + 2], pitch: movers.iter().position(is_pitch)? })
    };
    model.joints.iter().enumerate().filter_map(triple).collect()
}

/// Columns that a number moves with, from its symbols.
fn columns_of(symbols: &[usize], movers: &[Mover], quaternions: &[Quaternion]) -> Vec<usize> {
    let mut list: Vec<usize> = Vec::new();
    for &id in symbols {
        match movers.get(id) {
            Some(&Mover::Straight(column)) => list.push(column),
            Some(&Mover::Turns(number, _)) => {
                let first = quaternions[number].column;
                list.extend(first..first + 3);
            }
            _ => {}
        }
    }
    list.sort_unstable();
    list.dedup();
    list
}

/// By symbol the parameter that it is, and the element.
fn parameters(symbols: &Symbols) -> Vec<Option<(usize, usize)>> {
    let parameter = |symbol: &Symbol| match *symbol {
        Symbol::Param { param, element } => Some((param.0, element)),
        _ => None,
    };
    symbols.table.iter().map(parameter).collect()
}

/// Parameters near their defaults, states where they start, orientations that turn nothing, all else zero.
fn defaults(model: &Model, symbols: &Symbols, off: f64) -> Vec<f64> {
    let mut random = Random(11);
    let value = |symbol: &Symbol| match *symbol {
        Symbol::Param { param, element } => {
            let default = model.params[param].default[element];
            default + off * (1.0 + default.abs()) * random.next()
        }
        Symbol::State { state } => model.states[state].start,
        Symbol::Position { joint, component } => {
            let joint = &model.joints[joint];
            let turns = has_quaternion(joint) && component == joint.kind.freedoms() - 3;
            f64::from(u8::from(turns))
        }
        _ => 0.0,
    };
    symbols.table.iter().map(value).collect()
}
