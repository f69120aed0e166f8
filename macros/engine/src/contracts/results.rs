//! What generated functions give: numbers in typed slots.
//!
//! Whoever derives a function fills its slots, and whoever builds the function's value reads them; the table of functions
//! says which there are ([`super::function::Shape`]). Passes in between see one list.

use std::ops::Range;

/// What numbers are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Slot {
    /// All that a function gives.
    Value,
    /// By velocity coordinate of the state: accelerations, efforts, jumps, momenta, as the function says.
    Velocity,
    /// Rates of own states.
    States,
    Multipliers,
    /// Of the system that gives multipliers or inputs.
    Rank,
    /// The greatest of all iterations.
    Residual,
    /// Those that are solved for.
    Inputs,
    /// What constraint equations leave.
    Gaps,
    /// Unknowns of all iterations.
    Unknowns,
    /// Of coordinates that kinematics finds.
    Positions,
    /// Of these, and of positions where velocities are not their rates.
    Rates,
    Accelerations,
    /// Partial derivatives, a column for each displacement, velocity, own state, input.
    ByPosition,
    ByVelocity,
    ByState,
    ByInput,
    /// A, B, C and D of linearised equations.
    StateMatrix,
    InputMatrix,
    OutputMatrix,
    Feedthrough,
}

/// How numbers of a slot stand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    Scalar,
    Vector(usize),
    /// Rows and columns; row by row.
    Matrix(usize, usize),
}

impl Form {
    pub fn count(self) -> usize {
        match self {
            Form::Scalar => 1,
            Form::Vector(size) => size,
            Form::Matrix(rows, columns) => rows * columns,
        }
    }
}

/// One slot, filled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Part {
    pub slot: Slot,
    pub form: Form,
}

/// The slots of a function in their order.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Parts(Vec<Part>);

impl Parts {
    pub fn with(mut self, slot: Slot, form: Form) -> Self {
        self.0.push(Part { slot, form });
        self
    }

    pub fn count(&self) -> usize {
        self.0.iter().map(|part| part.form.count()).sum()
    }

    /// Where a slot stands among all numbers; an empty place where there is none.
    pub fn range(&self, slot: Slot) -> Range<usize> {
        let mut first = 0;
        for part in &self.0 {
            let next = first + part.form.count();
            if part.slot == slot {
                return first..next;
            }
            first = next;
        }
        0..0
    }
}

/// Numbers by slot.
#[derive(Clone, Debug)]
pub struct Results<S> {
    pub parts: Parts,
    /// All of them, slot after slot.
    pub list: Vec<S>,
    /// The same with numbers of limbs as symbols, where they are to be optimised so; else empty.
    pub apart: Vec<S>,
}

impl<S> Default for Results<S> {
    fn default() -> Self {
        Results { parts: Parts::default(), list: Vec::new(), apart: Vec::new() }
    }
}

impl<S> Results<S> {
    /// One number.
    pub fn scalar(value: S) -> Self {
        Results::default().with_scalar(Slot::Value, value)
    }

    pub fn vector(list: Vec<S>) -> Self {
        Results::default().with(Slot::Value, list)
    }

    /// Row by row.
    pub fn matrix(rows: usize, columns: usize, list: Vec<S>) -> Self {
        Results::default().with_matrix(Slot::Value, (rows, columns), list)
    }

    /// By velocity coordinate of the state.
    pub fn velocity(list: Vec<S>) -> Self {
        Results::default().with(Slot::Velocity, list)
    }

    pub fn with_scalar(self, slot: Slot, value: S) -> Self {
        self.push(slot, Form::Scalar, vec![value])
    }

    pub fn with(self, slot: Slot, list: Vec<S>) -> Self {
        self.push(slot, Form::Vector(list.len()), list)
    }

    pub fn with_matrix(self, slot: Slot, (rows, columns): (usize, usize), list: Vec<S>) -> Self {
        self.push(slot, Form::Matrix(rows, columns), list)
    }

    /// Where a slot belongs to the function only for some models.
    pub fn with_any(self, slot: Slot, list: Vec<S>) -> Self {
        if list.is_empty() { self } else { self.with(slot, list) }
    }

    fn push(mut self, slot: Slot, form: Form, list: Vec<S>) -> Self {
        self.parts = self.parts.with(slot, form);
        self.list.extend(list);
        self
    }

    /// What stands in a slot.
    pub fn of(&self, slot: Slot) -> &[S] {
        self.list.get(self.parts.range(slot)).unwrap_or_default()
    }
}
