//! Stage `mechanics`: equations as one-forms of positions and time.
//!
//! In: a [`Problem`], a point. Out: each equation's [`Form`], over the columns and time behind them, and the exterior derivatives of
//! equations of velocities. Columns of a quaternion are turns about the axes of the body, whose forms w are not closed: dw = -w x w.

use super::super::tape::Values;
use super::{Mover, Point, Problem, Rate};

/// By column, and by time.
pub(in super::super) type Form = Vec<f64>;

/// One-forms at one point.
pub(in super::super) struct Forms {
    /// Of equations of positions and of drives: what moves on their manifold makes these vanish.
    pub held: Vec<Form>,
    /// Of equations of velocities.
    pub rates: Vec<Form>,
    /// Their exterior derivatives: rows by the first vector, columns by the second; none where they are not asked for.
    pub slopes: Vec<Vec<Form>>,
}

impl Forms {
    /// Multiplies equations of velocities.
    pub(in super::super) fn scale(&mut self, factors: &[f64]) {
        for (form, factor) in self.rates.iter_mut().zip(factors) {
            form.iter_mut().for_each(|x| *x *= factor);
        }
        for (slopes, factor) in self.slopes.iter_mut().zip(factors) {
            slopes.iter_mut().flatten().for_each(|x| *x *= factor);
        }
    }
}

impl Problem {
    /// The columns, and time.
    pub(in super::super) fn dimension(&self) -> usize {
        self.columns.len() + 1
    }

    /// Moves along scaled columns and time.
    pub(in super::super) fn displace_in_time(&self, point: &mut Point, step: &[f64]) {
        let Some((late, step)) = step.split_last() else { return };
        self.displace(point, step);
        if let Some(time) = self.time_at(point) {
            self.put_time(point, time + late);
        }
    }

    /// Makes velocities rates of displacements from a point: turns about axes of the body are those of the rotation vector, whose
    /// rate is that by Bortz (1971).
    pub(in super::super) fn displacement_rate(&self, step: &[f64], velocity: &mut [f64]) {
        for quaternion in &self.quaternions {
            let own = quaternion.column..quaternion.column + 3;
            let (&[x, y, z], Some(w)) = (&step[own.clone()], velocity.get_mut(own)) else { continue };
            let square = x * x + y * y + z * z;
            let angle = square.sqrt();
            // (1 - (angle / 2) cot(angle / 2)) / angle^2
            let share = match angle < 1e-3 {
                true => 1.0 / 12.0 + square / 720.0,
                false => (1.0 - 0.5 * angle / (0.5 * angle).tan()) / square,
            };
            let across = cross([x, y, z], [w[0], w[1], w[2]]);
            let twice = cross([x, y, z], across);
            for ((rate, once), twice) in w.iter_mut().zip(across).zip(twice) {
                *rate += 0.5 * once + share * twice;
            }
        }
    }

    /// Columns that drives give.
    pub(in super::super) fn driven_columns(&self) -> Vec<bool> {
        let mut driven = vec![false; self.columns.len()];
        for &(symbol, _) in &self.driven {
            match self.movers[symbol] {
                Mover::Straight(column) => driven[column] = true,
                Mover::Turns(number, _) => {
                    let first = self.quaternions[number].column;
                    driven[first..first + 3].fill(true);
                }
                Mover::Rests => {}
            }
        }
        driven
    }

    /// Puts what is driven to where it is at the point's time.
    pub(in super::super) fn drive(&self, point: &mut Point, values: &mut Values) {
        self.tape.run_for(values, &point.0, self.driven.iter().map(|one| one.1));
        for &(symbol, root) in &self.driven {
            point.0[symbol] = self.tape.value(values, root);
        }
    }

    /// Whether drives are the same functions at all times.
    pub(in super::super) fn are_drives_analytic(&self) -> bool {
        self.driven.iter().all(|&(_, root)| self.tape.is_analytic(root))
    }

    /// Whether a parameter has a say in equations of velocities or of positions, or in drives.
    pub(in super::super) fn is_adjustable(&self) -> bool {
        let roots = self.rates.iter().flat_map(Rate::roots).chain(self.driven.iter().map(|one| one.1));
        let parameter = |symbol: usize| matches!(self.parameters.get(symbol), Some(Some(_)));
        self.equations.iter().any(|one| one.adjustable)
            || roots.into_iter().any(|root| self.tape.symbols(root).into_iter().any(parameter))
    }

    /// Forms at a point, with some equations of positions and some of velocities.
    pub(in super::super) fn forms(
        &self,
        point: &Point,
        equations: &[usize],
        rates: &[usize],
        values: &mut Values,
    ) -> Forms {
        let positions = equations.iter().map(|&k| self.equations[k].root);
        let roots = rates.iter().flat_map(|&k| self.rates[k].roots());
        let roots = positions.chain(roots).chain(self.driven.iter().map(|one| one.1));
        self.tape.run_for(values, &point.0, roots);
        let mut held: Vec<Form> = equations.iter().map(|&k| self.position_form(point, k, values)).collect();
        held.extend(self.drive_forms(point, values));
        let rates_of = |&k: &usize| {
            let mut form = vec![0.0; self.dimension()];
            for (place, root, unit) in self.entries(k) {
                form[place] = self.tape.value(values, root) * unit;
            }
            form
        };
        Forms { held, rates: rates.iter().map(rates_of).collect(), slopes: Vec::new() }
    }

    /// The same with exterior derivatives.
    pub(in super::super) fn forms_with_slopes(
        &self,
        point: &Point,
        equations: &[usize],
        rates: &[usize],
        values: &mut Values,
    ) -> Forms {
        let mut forms = self.forms(point, equations, rates, values);
        forms.slopes = rates.iter().zip(&forms.rates).map(|(&k, form)| self.exterior(point, k, form, values)).collect();
        forms
    }

    /// Places in the form of an equation of velocities: their roots, and what counts as one there.
    fn entries(&self, rate: usize) -> impl Iterator<Item = (usize, usize, f64)> {
        let Rate { slopes, rest, .. } = &self.rates[rate];
        let entry = |&(column, root): &(usize, usize)| (column, root, self.columns[column].unit);
        slopes.iter().map(entry).chain([(self.columns.len(), *rest, 1.0)])
    }

    fn position_form(&self, point: &Point, equation: usize, values: &mut Values) -> Form {
        let equation = &self.equations[equation];
        self.dense(self.gradient_and_rate(point, equation.root, 1.0 / equation.scale, values))
    }

    fn dense(&self, (row, rate): (Vec<(usize, f64)>, f64)) -> Form {
        let mut form = vec![0.0; self.dimension()];
        for (column, entry) in row {
            form[column] += entry;
        }
        form[self.columns.len()] = rate;
        form
    }

    /// What moves less what the drive makes of it. A quaternion that follows time is a function in pieces, of which nothing is said:
    /// one that gets here rests.
    fn drive_forms(&self, point: &Point, values: &mut Values) -> Vec<Form> {
        let form = |&(symbol, root): &(usize, usize)| match self.movers[symbol] {
            Mover::Straight(column) => {
                let rate = self.gradient_and_rate(point, root, 1.0, values).1;
                Some(self.driven_form(column, self.columns[column].unit, rate))
            }
            Mover::Turns(number, component) => {
                let axis = component.checked_sub(1)?;
                Some(self.driven_form(self.quaternions[number].column + axis, 1.0, 0.0))
            }
            Mover::Rests => None,
        };
        self.driven.iter().filter_map(form).collect()
    }

    fn driven_form(&self, column: usize, unit: f64, rate: f64) -> Form {
        let mut form = vec![0.0; self.dimension()];
        form[column] = unit;
        form[self.columns.len()] = -rate;
        form
    }

    /// dw(U, V) = U(w V) - V(w U) - w [U, V] for the vectors of columns.
    fn exterior(&self, point: &Point, rate: usize, form: &[f64], values: &mut Values) -> Vec<Form> {
        let mut slopes = vec![vec![0.0; self.dimension()]; self.dimension()];
        for (place, root, unit) in self.entries(rate) {
            let of_entry = self.dense(self.gradient_and_rate(point, root, unit, values));
            for (along, slope) in of_entry.into_iter().enumerate() {
                slopes[along][place] += slope;
                slopes[place][along] -= slope;
            }
        }
        for quaternion in &self.quaternions {
            for axis in 0..3 {
                // Turns about two axes of the body don't commute: what is left is one about the third.
                let [x, y, z] = [axis, axis + 1, axis + 2].map(|k| quaternion.column + k % 3);
                slopes[x][y] -= form[z];
                slopes[y][x] += form[z];
            }
        }
        slopes
    }
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
