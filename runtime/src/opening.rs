//! How far the loops of a state are open: [`Opening`].

use crate::{Real, any};

/// A share of a radian, or of the mechanism's size, that a motion may start open by; of its speed for velocities.
const CLOSED: f64 = 1e-4;

/// The same of what Newton's method leaves.
const CONVERGED: f64 = 1e-8;

/// So many roundings of what equations read open them.
const ROUNDINGS: f64 = 16.0;

/// The least scale of an equation beside its declared one.
const SMALLEST: f64 = 1e-3;

/// `[1/s]` rates below this are those of a mechanism at rest.
const REST: f64 = 1e-8;

/// How far the loops of a state are open: what [`System::opening`](crate::System::opening) tells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Opening<T> {
    /// The residual that is the greatest beside its tolerance, as a movement: in rad, or in lengths of the mechanism's size.
    /// Of velocities it is that by second.
    pub residual: T,
    /// How great it may be where a motion starts.
    pub tolerance: T,
    /// What is open.
    pub what: Open,
    /// What closes the loops, for the message of [`IntegrationError`](crate::IntegrationError).
    pub remedy: &'static str,
}

/// By what residuals of equations with multipliers are judged at a start.
#[derive(Clone, Copy, Debug)]
pub struct Gauge<'a, T> {
    /// The derivatives of the equations by the velocities there, column by column.
    pub jacobian: &'a [T],
    /// By equation the residual that amounts to one, a radian or the mechanism's size, at the declared parameters.
    pub scales: &'a [T],
    /// By equation the first of those that are judged together, such as the three that hold two points together.
    pub kinds: &'a [usize],
    /// By coordinate what amounts to one.
    pub units: &'a [T],
}

impl<T: Real> Gauge<'_, T> {
    fn declared(&self, row: usize) -> T {
        self.scales.get(row).copied().unwrap_or(T::lit(1.0))
    }

    /// The residual that amounts to one where the start is, with its parameters; at least a share of that at the declared
    /// ones, since derivatives vanish in some poses.
    fn scale(&self, row: usize) -> T {
        let declared = self.declared(row);
        if self.units.is_empty() {
            return declared;
        }
        let here = self.of_kind(row, &|row| {
            self.entries(row)
                .zip(self.units)
                .fold(T::lit(0.0), |most, (entry, &unit)| Real::max(most, Real::abs(entry) * unit))
        });
        Real::max(here, T::lit(SMALLEST) * declared)
    }

    /// The derivatives of an equation.
    fn entries(&self, row: usize) -> impl Iterator<Item = T> {
        self.jacobian.iter().skip(row).step_by(self.scales.len().max(1)).copied()
    }

    /// How much an equation reads of values of these sizes.
    fn reads(&self, row: usize, values: &[T]) -> T {
        self.entries(row).zip(values).fold(T::lit(0.0), |sum, (entry, &value)| sum + Real::abs(entry * value))
    }

    /// The greatest over the equations that are judged together with this one.
    fn of_kind(&self, row: usize, value: &dyn Fn(usize) -> T) -> T {
        let kind = self.kinds.get(row);
        let own = (0..self.scales.len()).filter(|&other| self.kinds.get(other) == kind);
        own.fold(T::lit(0.0), |most, other| Real::max(most, value(other)))
    }
}

/// What of a state is open.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Open {
    /// The positions leave loops open.
    Positions,
    /// The velocities open loops, which are closed.
    Velocities,
    /// This equation, which holds for parameters like the declared ones only.
    Equation(&'static str),
}

impl<T: Real> Opening<T> {
    /// Of a system whose loops can't be open.
    #[inline]
    pub fn none() -> Self {
        Self { residual: T::lit(0.0), tolerance: T::lit(0.0), what: Open::Positions, remedy: "" }
    }

    /// Whether it is more than a motion may start with, or no number, in any lane.
    #[inline]
    pub fn is_open(&self) -> bool {
        any(self.open_lanes())
    }

    /// The same lane by lane.
    #[inline]
    pub fn open_lanes(&self) -> T::Mask {
        Real::gt(self.residual, self.tolerance) | Real::ne(self.residual, self.residual)
    }

    /// This where something is open, else the next.
    #[inline]
    pub fn or(self, next: impl FnOnce() -> Self) -> Self {
        if self.is_open() { self } else { next() }
    }

    /// Of equations with multipliers, from their residuals and the sizes of the coordinates, whose rounding opens them.
    pub fn of_positions(residuals: &[T], gauge: &Gauge<'_, T>, sizes: &[T]) -> Self {
        let roundings = T::lit(ROUNDINGS) * T::epsilon();
        let rows = residuals.iter().enumerate().map(|(row, &residual)| {
            let scale = gauge.scale(row);
            let rounding = roundings * (scale + gauge.declared(row) + gauge.reads(row, sizes));
            (Real::abs(residual) / scale, share::<T>() + rounding / scale)
        });
        let (residual, tolerance) = worst(rows);
        Self {
            residual,
            tolerance,
            what: Open::Positions,
            remedy: "close them with `multibody::assemble` or `Projection::project`",
        }
    }

    /// The same of their rates, beside those at rest and the velocities. What counts as fast is what the equation reads, and
    /// those that belong with it: something else that is fast adds no more than its rounding.
    pub fn of_velocities(rates: &[T], at_rest: &[T], gauge: &Gauge<'_, T>, velocities: &[T]) -> Self {
        let roundings = T::lit(ROUNDINGS) * T::epsilon();
        let speed = greatest(velocities, gauge.units);
        let least = Real::max(T::lit(REST), roundings * (T::lit(1.0) + speed));
        let rest = |row: usize| Real::abs(at_rest.get(row).copied().unwrap_or(T::lit(0.0)));
        let rows = rates.iter().enumerate().map(|(row, &rate)| {
            let scale = gauge.scale(row);
            let fast = gauge.of_kind(row, &|other| gauge.reads(other, velocities) + rest(other));
            (Real::abs(rate) / scale, share::<T>() * fast / scale + least)
        });
        let (residual, tolerance) = worst(rows);
        let remedy = "give velocities that keep them closed, from `multibody::assemble` or `Projection::project`";
        Self { residual, tolerance, what: Open::Velocities, remedy }
    }

    /// Of what Newton's method leaves of equations, with the least and the greatest that amounts to one in them.
    pub fn of_iterations(residual: T, [least, greatest]: [T; 2]) -> Self {
        Self {
            residual: residual / least,
            tolerance: Real::max(T::lit(CONVERGED), T::lit(256.0) * T::epsilon() * greatest / least),
            what: Open::Positions,
            remedy: "Newton's method finds no solution from the guess of the state: set `guess` nearer to one, such as the \
                     default, or one that `close` has found",
        }
    }

    /// Of equations that hold for parameters like the declared ones only, in units of a movement, with their names: the
    /// first that does not hold.
    pub fn of_equations(residuals: &[T], names: &[&'static str]) -> Self {
        let each = residuals.iter().zip(names).map(|(&residual, &name)| Self::of_equation(residual, name));
        each.fold(Self::none(), |first, next| first.or(|| next))
    }

    /// Of one of them.
    pub fn of_equation(residual: T, name: &'static str) -> Self {
        Self {
            residual: Real::abs(residual),
            tolerance: share(),
            what: Open::Equation(name),
            remedy: "choose the parameters so that it holds, or hold the loops by multipliers",
        }
    }
}

/// A share that a motion may start open by.
fn share<T: Real>() -> T {
    Real::max(T::lit(CLOSED), T::lit(1e3) * T::epsilon())
}

/// Of residuals with their tolerances the one that is the greatest beside its own, or no number, lane by lane.
fn worst<T: Real>(rows: impl Iterator<Item = (T, T)>) -> (T, T) {
    rows.fold((T::lit(0.0), share()), |(worst, its), (residual, tolerance)| {
        let worse = Real::gt(residual * its, worst * tolerance) | Real::ne(residual, residual);
        (Real::select(worse, residual, worst), Real::select(worse, tolerance, its))
    })
}

/// The greatest size over its unit; no number where one is none.
fn greatest<T: Real>(values: &[T], units: &[T]) -> T {
    values.iter().zip(units).fold(T::lit(0.0), |worst, (&value, &unit)| {
        let size = Real::abs(value) / unit;
        Real::select(Real::gt(size, worst) | Real::ne(size, size), size, worst)
    })
}
