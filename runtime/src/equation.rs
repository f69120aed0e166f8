//! Equations as text: [`Equation`].

use core::fmt;

/// One of the equations of a model that says `emit equations`, for printing, notebooks and papers.
///
/// `S[x, q]` is the slope of a coordinate that follows by one of the state, `gamma[x]` what is left of its acceleration where
/// those of the state are zero; `M` is the mass matrix, `c`, `g` and `Q` are the terms of velocities, of gravity and of forces:
/// `M a + c + g = Q`, less `G' lambda` where constraints keep multipliers. A rate has a dot, in text behind its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Equation {
    /// Heading under which it stands: `Equations of motion`, `Outputs`, ..
    pub section: &'static str,
    /// A line of plain text: factors side by side, powers as superscripts.
    pub text: &'static str,
    /// What stands in an `equation` of LaTeX with amsmath.
    pub latex: &'static str,
    /// Where it holds: for which of several identical parts, on which branch, where it is real. Empty if it holds as it is.
    pub says: &'static str,
}

/// The plain text, and in brackets where it holds.
impl fmt::Display for Equation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.text)?;
        if self.says.is_empty() { Ok(()) } else { write!(f, "    ({})", self.says) }
    }
}
