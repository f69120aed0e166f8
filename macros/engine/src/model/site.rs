//! Places in the user's text, for stages that know no tokens.
//!
//! In: things of the checked model. Out: a [`Site`] of each, which only whoever reports to the user opens.

use proc_macro2::Span;

use super::types::{
    AtFunction, Closing, Constraint, Drive, Expr, Force, Formula, Given, Joint, Kinematics, Model, Request, Solve,
    SolveFor, Speed,
};

/// Where something of the model is written.
#[derive(Clone, Copy, Debug)]
pub struct Site(Span);

impl Site {
    pub fn span(self) -> Span {
        self.0
    }
}

/// What is written somewhere.
pub trait Sited {
    fn site(&self) -> Site;
}

macro_rules! sited {
    ($($thing:ty),*) => {
        $(impl Sited for $thing {
            fn site(&self) -> Site {
                Site(self.span)
            }
        })*
    };
}

impl Sited for Formula {
    fn site(&self) -> Site {
        self.of.site()
    }
}

sited!(AtFunction, Closing, Constraint, Drive, Expr, Force, Given, Joint, Kinematics, Solve, SolveFor, Speed);

/// Its name.
impl Sited for Model {
    fn site(&self) -> Site {
        Site(self.name.span())
    }
}

impl Model {
    /// Where a function is asked for.
    pub fn asked_at(&self, request: Request) -> Option<Site> {
        self.asked.iter().find(|asked| asked.0 == request).map(|asked| Site(asked.1))
    }
}
