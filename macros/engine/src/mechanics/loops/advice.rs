//! Stage `mechanics`: what there is to say of the ways to close loops.
//!
//! In: nothing. Out: the types that `formulation` fills and `emit` tells of.

use crate::contracts::cost::Cost;

use super::structure::{Row, Structure};

/// What a choice costs, for the user to choose.
#[derive(Clone, Debug, Default)]
pub struct Advice {
    /// `constraints: Auto` has chosen.
    pub is_chosen: bool,
    /// What was counted: forward dynamics, or all that the model asks for where that is not among it.
    pub is_forward: bool,
    pub own: Option<Figures>,
    /// Of the other choice, or why it is refused.
    pub other: Option<Result<Figures, String>>,
    /// What the user could assume for more equations to be absorbed, with what the model takes then.
    pub assumable: Option<(Vec<Assumable>, Figures)>,
    /// What the user could write formulas for or have closed, with what the model takes then; where multipliers were chosen for want of
    /// such items, with what eliminating takes then.
    pub solvable: Option<(Vec<Solvable>, Figures)>,
}

/// An `assume` of one coordinate.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Assumable {
    /// The part in which it stands; nothing for the model itself.
    pub part: Option<String>,
    /// `stroke > -0.7`
    pub condition: String,
}

/// A `solve` item.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Solvable {
    /// The part in which it stands; nothing for the model itself.
    pub part: Option<String>,
    /// `solve (plate.roll, plate.pitch) = (0.0, 0.0);`
    pub text: String,
}

impl Advice {
    /// The other choice is taken, since something else is said against this one.
    pub fn turned(self, reason: String) -> Advice {
        Advice { own: self.other.and_then(Result::ok), other: Some(Err(reason)), ..self }
    }
}

/// What a model takes with its loops closed in one way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Figures {
    pub closing: Closing,
    /// All rounds of iterations counted.
    pub operations: Cost,
    /// The same, weighed as processors need time.
    pub work: u32,
}

/// How loops are closed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Closing {
    /// All dependent coordinates have formulas.
    ClosedForm,
    /// Some are found by Newton's method.
    Newton,
    Multipliers,
}

impl Closing {
    pub fn of(structure: &Structure) -> Closing {
        match (structure.rows.is_empty(), structure.guesses()) {
            (false, _) => Closing::Multipliers,
            (true, 0) => Closing::ClosedForm,
            (true, _) => Closing::Newton,
        }
    }
}

/// What becomes of equations with multipliers when masses and loops are eliminated together.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Pivoted {
    /// Those that are pivots behind coordinates of their limbs.
    pub absorbed: Vec<Row>,
    /// Those that are left, by the systems that are solved with pivots at run time.
    pub cores: Vec<Vec<Row>>,
}

/// Work that differs by less says nothing of times.
const SIMILAR: f64 = 1.1;

impl Figures {
    /// Whether dependent coordinates are to be eliminated rather than equations kept. Multipliers have a price of their own, since
    /// loops drift, so a closed form is taken where it costs about as much. Newton's method is taken where it costs less.
    pub fn reduces(&self, multipliers: &Figures) -> bool {
        match self.closing {
            Closing::Newton => self.work < multipliers.work,
            Closing::ClosedForm | Closing::Multipliers => f64::from(self.work) <= SIMILAR * f64::from(multipliers.work),
        }
    }
}
