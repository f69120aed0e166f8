//! Stage `mechanics`: forms at a point, split along those of the equations and across.
//!
//! In: forms. Out: an orthonormal [`Frame`] of them, in which any form has coefficients and a rest; the space that rows leave.

use super::super::orthonormal::{complement, greatest, unit};
use super::super::problem::forms::Form;
use super::super::singular::{add, dot};

/// What is left of a form that depends on others, as a share of it: they are no frame then.
const DEPENDENT: f64 = 1e-6;

/// What counts.
#[derive(Clone, Copy)]
pub(super) struct Limits {
    /// What is more is there.
    pub seen: f64,
    /// What is less is rounding. Nothing is known of what lies between.
    pub nothing: f64,
}

/// Equations at one point.
pub(super) struct Frame {
    held: Vec<Form>,
    /// Across those that are held.
    rates: Vec<Form>,
    /// By equation of velocities its coefficients by these.
    lower: Vec<Vec<f64>>,
}

impl Frame {
    /// Nothing where equations of velocities depend on others, or are no numbers.
    pub(super) fn new(held: &[Form], rates: &[&Form]) -> Option<Frame> {
        let mut frame = Frame { held: Vec::new(), rates: Vec::new(), lower: Vec::new() };
        for form in held {
            let (_, mut rest) = frame.split(form);
            if unit(&mut rest)? > DEPENDENT * dot(form, form).sqrt() {
                frame.held.push(rest);
            }
        }
        for form in rates {
            let (mut along, mut rest) = frame.split(form);
            let length = unit(&mut rest)?;
            if length <= DEPENDENT * dot(form, form).sqrt() {
                return None;
            }
            along.push(length);
            frame.lower.push(along);
            frame.rates.push(rest);
        }
        Some(frame)
    }

    /// Coefficients by the directions of equations of velocities, and what lies across all equations: twice, for the digits that the
    /// first time has lost.
    fn split(&self, form: &[f64]) -> (Vec<f64>, Form) {
        let (mut along, mut rest) = (vec![0.0; self.rates.len()], form.to_vec());
        for _ in 0..2 {
            for direction in &self.held {
                let share = dot(direction, &rest);
                add(&mut rest, -share, direction);
            }
            for (sum, direction) in along.iter_mut().zip(&self.rates) {
                let share = dot(direction, &rest);
                *sum += share;
                add(&mut rest, -share, direction);
            }
        }
        (along, rest)
    }

    /// A form as a combination of equations of velocities, but for what is held, and a rest.
    pub(super) fn combination(&self, form: &[f64]) -> (Vec<f64>, Form) {
        let (mut along, rest) = self.split(form);
        for k in (0..along.len()).rev() {
            let share = along[k] / self.lower[k][k];
            for (sum, entry) in along.iter_mut().zip(&self.lower[k][..k]) {
                *sum -= share * entry;
            }
            along[k] = share;
        }
        (along, rest)
    }

    /// What of a vector is allowed.
    pub(super) fn allowed(&self, vector: &[f64]) -> Form {
        self.split(vector).1
    }

    /// Directions that are allowed, orthonormal.
    pub(super) fn directions(&self, dimension: usize) -> Vec<Form> {
        let taken: Vec<&Form> = self.held.iter().chain(&self.rates).collect();
        complement(&taken, dimension)
    }
}

/// Combinations that vanish in all rows, orthonormal; nothing where it isn't clear which do.
pub(super) fn vanishing(mut rows: Vec<Vec<f64>>, dimension: usize, limits: Limits) -> Option<Vec<Vec<f64>>> {
    let mut seen: Vec<Vec<f64>> = Vec::new();
    while let Some(mut greatest) = greatest(&rows).cloned() {
        let length = unit(&mut greatest)?;
        if length <= limits.seen {
            if length > limits.nothing {
                return None;
            }
            break;
        }
        for row in &mut rows {
            let share = dot(&greatest, row);
            add(row, -share, &greatest);
        }
        seen.push(greatest);
    }
    Some(complement(&seen.iter().collect::<Vec<_>>(), dimension))
}
