//! Rows of text: [`Recorder`].

use super::{Column, Columns};
use std::fmt;
use std::io::{self, Write};
use std::marker::PhantomData;

/// Writes rows of comma-separated values, one for each time, below a row of names with units: `t [s],tip.x [m],..`.
///
/// The first row written settles the type of the others, so all of them have the same columns. Numbers have the shortest
/// text that reads back the same, in the scalar that they are of.
///
/// ```
/// use multibody::{Dop853, Integrator, Recorder, multibody};
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
/// let model = pendulum::Model::<f64>::default();
/// let start = pendulum::State::default();
/// let times = (0..=10).map(|k| 0.1 * f64::from(k));
///
/// let mut recorder = Recorder::new(Vec::new()); // or `std::io::BufWriter` of a file
/// let integrator = Integrator::adaptive(Dop853, 1e-9, 1e-9);
/// integrator.sampled(&model, 0.0, 1.0, &start, &(), times, |t, x| recorder.observe(t, &(*x, model.outputs(t, x, &()))))?;
/// let text = String::from_utf8(recorder.finish()?)?;
/// assert!(text.starts_with("t [s],q.hinge [rad],v.hinge [rad/s],tip.x [m],tip.y [m],tip.z [m]\n0.0,0.0,"));
/// assert_eq!(text.lines().count(), 12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Recorder<W, C> {
    writer: W,
    has_header: bool,
    /// The first one that [`observe`](Self::observe) met.
    error: Option<io::Error>,
    row: PhantomData<fn(&C)>,
}

impl<W: Write, C> Recorder<W, C> {
    /// Writes nothing yet. A file is best wrapped in [`BufWriter`](io::BufWriter): numbers are written one by one.
    pub fn new(writer: W) -> Self {
        Self { writer, has_header: false, error: None, row: PhantomData }
    }

    /// Writes a row, and the row of names before the first one.
    ///
    /// # Errors
    /// Those of the writer. What of the row was written before stays written.
    pub fn sample<T: Decimal>(&mut self, t: f64, row: &C) -> io::Result<()>
    where
        C: Columns<T>,
    {
        if !self.has_header {
            self.write(|writer| write!(writer, "t [s]"), row, |writer, column, _| write!(writer, ",{}", Cell(column)))?;
            self.has_header = true;
        }
        self.write(|writer| write!(writer, "{t:?}"), row, |writer, _, value| write!(writer, ",{value:?}"))
    }

    /// The same for a closure that gives nothing, as integrators call it: after an error nothing more is written, and
    /// [`finish`](Self::finish) hands the error on.
    pub fn observe<T: Decimal>(&mut self, t: f64, row: &C)
    where
        C: Columns<T>,
    {
        if self.error.is_none() {
            self.error = self.sample(t, row).err();
        }
    }

    /// Flushes the writer and gives it back.
    ///
    /// # Errors
    /// The first that [`observe`](Self::observe) met, else that of flushing.
    pub fn finish(mut self) -> io::Result<W> {
        match self.error {
            Some(error) => Err(error),
            None => self.writer.flush().map(|()| self.writer),
        }
    }

    /// One line, up to the first error.
    fn write<T: Decimal>(
        &mut self,
        first: impl FnOnce(&mut W) -> io::Result<()>,
        row: &C,
        mut each: impl FnMut(&mut W, &Column<'_>, T) -> io::Result<()>,
    ) -> io::Result<()>
    where
        C: Columns<T>,
    {
        let writer = &mut self.writer;
        let mut written = first(writer);
        row.each(&mut |column, value| {
            if written.is_ok() {
                written = each(writer, column, value);
            }
        });
        written?;
        writeln!(writer)
    }
}

/// `tip.x [m]`, or the name alone where it has no unit. Names are identifiers with points and indices and need no quotes, but
/// any text between brackets is a unit: with a comma or a quote in it, the cell is quoted.
struct Cell<'a>(&'a Column<'a>);

impl fmt::Display for Cell<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (name, unit) = (self.0, self.0.unit());
        match unit {
            "" => write!(f, "{name}"),
            _ if unit.contains([',', '"', '\n', '\r']) => write!(f, "\"{name} [{}]\"", unit.replace('"', "\"\"")),
            _ => write!(f, "{name} [{unit}]"),
        }
    }
}

/// Scalars with one number in them, whose `Debug` is the shortest decimal text that reads back the same.
pub trait Decimal: fmt::Debug + sealed::Decimal {}

impl Decimal for f32 {}
impl Decimal for f64 {}

mod sealed {
    /// Lanes and dual numbers hold several numbers, and have no column for them.
    pub trait Decimal {}
    impl Decimal for f32 {}
    impl Decimal for f64 {}
}
