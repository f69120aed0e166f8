//! Stage `mechanics`: the equations of a mechanism as numbers.
//!
//! In: the model, written in symbols ([`formulation`]). Out: a [`Problem`]: residuals of all closings and of formulas that a user wrote, with what each of them
//! depends on, evaluated in double precision with parameters at their defaults and inputs at zero. Columns are velocity
//! coordinates of the tree; travels count in units of the mechanism's size, so that they compare with angles. Where time has
//! a say each start has a time of its own: what holds at time zero alone does not hold.

pub(super) mod forms;
mod formulation;

use crate::mechanics::loops::constraints::Writing;
use crate::mechanics::loops::structure::Row;
use crate::model::types::{Coordinate, LoopClosure, Model};

use super::measure::{Gap, Measure};
use super::tape::{Tape, Values};
use formulation::formulate;

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
    /// Whether it holds again with every turn of a thread: along the travel it rises and falls.
    pub recurs: bool,
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

/// Roll, pitch and yaw of one joint.
struct Gimbal {
    columns: [usize; 3],
    /// Symbol of the pitch.
    pitch: usize,
}

/// Cosine that is one where a joint is closed as it was meant.
struct Alignment {
    closing: LoopClosure,
    /// Again with every turn of a thread.
    recurs: bool,
    root: usize,
    columns: Vec<usize>,
}

/// An equation of velocities.
pub(super) struct Rate {
    pub row: Row,
    /// (column, root)
    slopes: Vec<(usize, usize)>,
    /// What is left of it at rest.
    rest: usize,
    /// It is zero whatever moves.
    pub is_nothing: bool,
}

impl Rate {
    fn roots(&self) -> impl Iterator<Item = usize> {
        self.slopes.iter().map(|slope| slope.1).chain([self.rest])
    }
}

/// What a speed of the user's choice stands for, without what is left at rest.
struct Speed {
    /// (column, root)
    slopes: Vec<(usize, usize)>,
}

/// A condition of a `solve` item, or what is assumed: not zero where it holds.
struct Condition {
    root: usize,
    columns: Vec<usize>,
}

pub(super) struct Problem {
    writing: Writing,
    pub(super) tape: Tape,
    pub equations: Vec<Equation>,
    pub columns: Vec<Column>,
    alignments: Vec<Alignment>,
    conditions: Vec<Condition>,
    assumptions: Vec<Condition>,
    pub(super) rates: Vec<Rate>,
    speeds: Vec<Speed>,
    movers: Vec<Mover>,
    quaternions: Vec<Quaternion>,
    gimbals: Vec<Gimbal>,
    /// By joint the symbols of its position.
    positions: Vec<Vec<usize>>,
    /// Its symbol.
    time: Option<usize>,
    /// Symbols of the user's own states.
    states: Vec<usize>,
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

impl Problem {
    /// With equations of loops in other axes.
    pub(super) fn written(model: &Model, writing: Writing) -> Problem {
        formulate(model, 0.0, writing)
    }

    /// The same with parameters that are off their defaults by about this much.
    pub(super) fn moved(&self, model: &Model, off: f64) -> Problem {
        formulate(model, off, self.writing)
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

    /// Over all columns.
    pub(super) fn dense_row(&self, row: &[(usize, f64)]) -> Vec<f64> {
        let mut dense = vec![0.0; self.columns.len()];
        for &(column, entry) in row {
            if let Some(slot) = dense.get_mut(column) {
                *slot += entry;
            }
        }
        dense
    }

    /// Of unit length over all columns. Gradients that vanish, as a cosine's does at one, stay zero and don't become noise.
    pub(super) fn unit_row(&self, row: &[(usize, f64)]) -> Vec<f64> {
        let mut dense = self.dense_row(row);
        let norm = dense.iter().map(|x| x * x).sum::<f64>().sqrt();
        let factor = if norm > 1e-7 { 1.0 / norm } else { 0.0 };
        dense.iter_mut().for_each(|x| *x *= factor);
        dense
    }

    /// Closings that move nothing, and are closed with axes that point the wrong way.
    pub(super) fn reversed(&self) -> Vec<LoopClosure> {
        let mut values = Values::default();
        self.tape.run(&mut values, &self.defaults);
        let of = |equation: &Equation, closing: LoopClosure| matches!(equation.source, Source::Row(row) if row.closing == closing);
        let still = |closing: LoopClosure| self.equations.iter().all(|one| !of(one, closing) || one.columns.is_empty());
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

    /// Own states are what they are: equations of velocities may read them.
    pub(super) fn put_states(&self, point: &mut Point, random: &mut Random) {
        self.states.iter().for_each(|&symbol| point.0[symbol] += random.next());
    }

    /// Values of the states at a point put into another.
    pub(super) fn take_states(&self, point: &mut Point, from: &Point) {
        self.states.iter().for_each(|&symbol| point.0[symbol] = from.0[symbol]);
    }

    /// Time at a point, if it has a say.
    pub(super) fn time_at(&self, point: &Point) -> Option<f64> {
        self.time.map(|symbol| point.0[symbol])
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
                Mover::Turns(number, _) => self.quaternions[number].column,
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
        let value = |&symbol: &usize| point.0[symbol];
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
        self.tape.run_for(values, &point.0, equations.iter().map(|&k| self.equations[k].root));
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

    /// Equations of velocities by scaled columns, and what is left of each at rest.
    pub(super) fn rates_at(&self, point: &Point, values: &mut Values) -> Linearised {
        self.tape.run_for(values, &point.0, self.rates.iter().flat_map(Rate::roots));
        let scaled =
            |&(column, root): &(usize, usize)| (column, self.tape.value(values, root) * self.columns[column].unit);
        let rows = self.rates.iter().map(|rate| rate.slopes.iter().map(scaled).collect()).collect();
        let residuals = self.rates.iter().map(|rate| self.tape.value(values, rate.rest)).collect();
        Linearised { residuals, rows }
    }

    /// Speeds of the user's choice by scaled columns.
    pub(super) fn speeds_at(&self, point: &Point, values: &mut Values) -> Vec<Vec<(usize, f64)>> {
        let roots = self.speeds.iter().flat_map(|speed| speed.slopes.iter().map(|slope| slope.1));
        self.tape.run_for(values, &point.0, roots);
        let scaled =
            |&(column, root): &(usize, usize)| (column, self.tape.value(values, root) * self.columns[column].unit);
        self.speeds.iter().map(|speed| speed.slopes.iter().map(scaled).collect()).collect()
    }

    /// Whether all equations, of positions and of velocities, and all speeds have slopes at a point that are numbers.
    pub(super) fn has_slopes(&self, point: &Point, values: &mut Values) -> bool {
        let all: Vec<usize> = (0..self.equations.len()).collect();
        let [positions, rates] = [self.linearise(point, &all, values), self.rates_at(point, values)];
        let rows = [positions, rates].into_iter().flat_map(|found| found.rows).chain(self.speeds_at(point, values));
        rows.flatten().all(|(_, slope)| slope.is_finite())
    }

    /// Columns that a speed reads.
    pub(super) fn columns_of_speed(&self, number: usize) -> impl Iterator<Item = usize> {
        self.speeds[number].slopes.iter().map(|slope| slope.0)
    }

    /// Whether equations of velocities are the same functions everywhere, and at all times.
    pub(super) fn are_rates_plain(&self) -> bool {
        (0..self.rates.len()).all(|number| self.is_rate_plain(number))
    }

    /// Whether one of them is the same function everywhere, and at all times.
    pub(super) fn is_rate_plain(&self, number: usize) -> bool {
        let varies = |symbol: &usize| Some(*symbol) == self.time || self.states.contains(symbol);
        let plain = |root: usize| self.tape.is_analytic(root) && !self.tape.symbols(root).iter().any(varies);
        self.rates[number].roots().all(plain)
    }

    /// Whether one of them reads states of the user's own.
    pub(super) fn do_rates_read_states(&self) -> bool {
        let is_state = |root: usize| self.tape.symbols(root).iter().any(|symbol| self.states.contains(symbol));
        self.rates.iter().flat_map(Rate::roots).any(is_state)
    }

    /// Whether equations of velocities are the same functions everywhere.
    pub(super) fn are_rates_analytic(&self) -> bool {
        self.rates.iter().flat_map(Rate::roots).all(|root| self.tape.is_analytic(root))
    }

    /// Entries of a row by angular velocities where there were rates of roll, pitch and yaw, if all three are among some columns.
    /// Axes may be turned about that of the pitch, which changes no lengths: so the roll's entry stays.
    pub(super) fn turn_rates(&self, point: &Point, columns: &[usize], row: &mut [f64]) {
        for Gimbal { columns: own, pitch } in &self.gimbals {
            if own.iter().all(|column| columns.contains(column)) {
                let (sin, cos) = point.0[*pitch].sin_cos();
                row[own[2]] = (row[own[2]] + sin * row[own[0]]) / cos;
            }
        }
    }

    /// Whether roll and yaw among some columns turn about nearly the same axis: such coordinates say nothing there.
    pub(super) fn locks(&self, point: &Point, columns: &[usize]) -> bool {
        let own = self.gimbals.iter().filter(|gimbal| columns.contains(&gimbal.columns[1]));
        own.into_iter().any(|gimbal| point.0[gimbal.pitch].cos().abs() < 0.05)
    }

    /// Numbers of the alignments that some columns have a say in.
    pub(super) fn alignments_of(&self, columns: &[usize]) -> Vec<usize> {
        let own = |&k: &usize| self.alignments[k].columns.iter().any(|column| columns.contains(column));
        (0..self.alignments.len()).filter(own).collect()
    }

    /// Of these the ones that belong to closings of some equations.
    pub(super) fn alignments_at(&self, alignments: &mut Vec<usize>, equations: &[usize]) {
        let of = |k: usize, closing| matches!(self.equations[k].source, Source::Row(row) if row.closing == closing);
        alignments.retain(|&one| equations.iter().any(|&k| of(k, self.alignments[one].closing)));
    }

    /// Of these the ones that have one place to be.
    pub(super) fn without_threads(&self, alignments: &mut Vec<usize>) {
        alignments.retain(|&k| !self.alignments[k].recurs);
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

    /// Columns of which alone the user assumes something.
    pub(super) fn assumed(&self) -> Vec<usize> {
        let mut columns: Vec<usize> =
            self.assumptions.iter().filter(|one| one.columns.len() == 1).map(|one| one.columns[0]).collect();
        columns.sort_unstable();
        columns.dedup();
        columns
    }

    /// Whether what the user assumes of one column alone is so.
    pub(super) fn is_assumed(&self, point: &Point, column: usize, values: &mut Values) -> bool {
        let own = |one: &&Condition| one.columns == [column];
        let roots: Vec<usize> = self.assumptions.iter().filter(own).map(|one| one.root).collect();
        self.tape.run_for(values, &point.0, roots.iter().copied());
        roots.iter().all(|&root| self.tape.value(values, root) != 0.0)
    }

    /// Of a column that is a number by itself.
    pub(super) fn value_of(&self, point: &Point, column: usize) -> Option<f64> {
        let own = |mover: &Mover| matches!(mover, Mover::Straight(number) if *number == column);
        self.movers.iter().position(own).map(|symbol| point.0[symbol])
    }

    /// Whether an equation is no function in pieces.
    pub(super) fn is_analytic(&self, equation: usize) -> bool {
        self.tape.is_analytic(self.equations[equation].root)
    }

    /// How far cosines are from one, after an evaluation of equations at the same point.
    pub(super) fn misalignments(&self, point: &Point, list: &[usize], values: &mut Values) -> Vec<f64> {
        self.tape.run_also(values, &point.0, list.iter().map(|&k| self.alignments[k].root));
        list.iter().map(|&k| self.tape.value(values, self.alignments[k].root) - 1.0).collect()
    }

    /// Their slopes, after that.
    pub(super) fn alignment_rows(&self, point: &Point, list: &[usize], values: &mut Values) -> Vec<Vec<(usize, f64)>> {
        list.iter().map(|&k| self.gradient(point, self.alignments[k].root, 1.0, values)).collect()
    }

    pub(super) fn gradient(&self, point: &Point, root: usize, factor: f64, values: &mut Values) -> Vec<(usize, f64)> {
        self.gradient_and_rate(point, root, factor, values).0
    }

    /// The same, and the derivative by time.
    fn gradient_and_rate(
        &self,
        point: &Point,
        root: usize,
        factor: f64,
        values: &mut Values,
    ) -> (Vec<(usize, f64)>, f64) {
        let mut rate = 0.0;
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
            _ if self.time == Some(symbol) => rate = slope * factor,
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
        (row, rate)
    }
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
