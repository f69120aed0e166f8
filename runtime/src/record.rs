//! Names, units and values of the scalars of generated structs, in order: [`Columns`]. With the feature `std`, [`Recorder`]
//! writes them as text.
//!
//! Nothing here is on the heap: a name is the way from the outermost struct to the scalar, each step on the stack of the
//! function that took it, and is written out only where somebody asks for it.

mod leaves;
#[cfg(feature = "std")]
mod recorder;

#[cfg(feature = "std")]
pub use recorder::{Decimal, Recorder};

use core::fmt;

/// What can be written as a row: its scalars in order, each with its name and unit.
///
/// Generated structs of fields implement it, from `Params` to `Output`, and so do `State`, what the fields are made of,
/// arrays, and pairs for two of them side by side.
///
/// ```
/// use multibody::{Columns, multibody};
///
/// multibody! {
///     pub mod pendulum {
///         world { gravity: -9.81 * Y }
///         body bob { mass: 1.0, com: -Y }
///         joint hinge: Revolute { parent: ground, child: bob, axis: Z }
///         /// [m]
///         output tip = bob.at(-Y).position;
///     }
/// }
/// let output = pendulum::Model::<f64>::default().outputs(0.0, &pendulum::State::default(), &());
/// let mut columns = Vec::new();
/// output.each(&mut |column, value| columns.push((column.to_string(), column.unit(), value)));
/// assert_eq!(columns[1], ("tip.y".to_owned(), "m", -1.0));
/// ```
pub trait Columns<T> {
    /// Calls `f` with each scalar. `place` is where `self` stands, its fields are behind that.
    fn columns(&self, place: &Column<'_>, f: &mut dyn FnMut(&Column<'_>, T));

    /// The same for what stands nowhere else.
    fn each(&self, f: &mut dyn FnMut(&Column<'_>, T)) {
        self.columns(&Column::ROOT, f);
    }
}

/// Where a scalar stands: as text `legs[2].tip.x`, with its [`unit`](Self::unit).
#[derive(Clone, Copy, Debug)]
pub struct Column<'a> {
    outer: Option<&'a Column<'a>>,
    step: Step,
    unit: &'static str,
    is_rate: bool,
}

#[derive(Clone, Copy, Debug)]
enum Step {
    Root,
    Field(&'static str),
    Index(usize),
}

impl Column<'_> {
    const ROOT: Column<'static> = Column { outer: None, step: Step::Root, unit: "", is_rate: false };

    /// As the model declares it or as the joint's coordinate has it; empty where neither does.
    #[must_use]
    pub fn unit(&self) -> &'static str {
        self.unit
    }

    /// A field, with its own unit.
    #[must_use]
    pub fn field(&self, name: &'static str, unit: &'static str) -> Column<'_> {
        Column { outer: Some(self), step: Step::Field(name), unit, is_rate: self.is_rate }
    }

    /// A field that holds the velocity of a joint of several coordinates: the same struct holds its position.
    #[must_use]
    pub fn rates(&self, name: &'static str) -> Column<'_> {
        Column { outer: Some(self), step: Step::Field(name), unit: "", is_rate: true }
    }

    /// A coordinate of such a joint, with its unit and that of its rate.
    fn coordinate(&self, name: &'static str, [position, rate]: [&'static str; 2]) -> Column<'_> {
        self.field(name, if self.is_rate { rate } else { position })
    }

    /// A component, of the same unit.
    fn component(&self, name: &'static str) -> Column<'_> {
        self.field(name, self.unit)
    }

    /// An element, of the same unit.
    fn index(&self, index: usize) -> Column<'_> {
        Column { outer: Some(self), step: Step::Index(index), unit: self.unit, is_rate: self.is_rate }
    }
}

impl fmt::Display for Column<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(outer) = self.outer {
            outer.fmt(f)?;
        }
        match (self.step, self.outer.map(|outer| outer.step)) {
            (Step::Root, _) => Ok(()),
            (Step::Field(name), None | Some(Step::Root)) => f.write_str(name),
            (Step::Field(name), _) => write!(f, ".{name}"),
            (Step::Index(index), _) => write!(f, "[{index}]"),
        }
    }
}
