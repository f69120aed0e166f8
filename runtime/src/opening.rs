//! How far the loops of a state are open: [`Opening`].

use crate::{Real, any};

/// A share of a radian, or of the mechanism's size, that a motion may start open by; of its speed for velocities.
const CLOSED: f64 = 1e-4;

/// The same of what Newton's method leaves.
const CONVERGED: f64 = 1e-8;

/// `[1/s]` rates below this are those of a mechanism at rest.
const REST: f64 = 1e-8;

/// How far the loops of a state are open: what [`System::opening`](crate::System::opening) tells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Opening<T> {
    /// The greatest residual, as a movement: in rad, or in lengths of the mechanism's size at the declared parameters.
    /// Of velocities it is that by second.
    pub residual: T,
    /// The greatest residual that a motion may start with.
    pub tolerance: T,
    /// What is open.
    pub what: Open,
    /// What closes the loops, for the message of [`IntegrationError`](crate::IntegrationError).
    pub remedy: &'static str,
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
        any(Real::gt(self.residual, self.tolerance) | Real::ne(self.residual, self.residual))
    }

    /// This where something is open, else the next.
    #[inline]
    pub fn or(self, next: impl FnOnce() -> Self) -> Self {
        if self.is_open() { self } else { next() }
    }

    /// Of equations with multipliers, from their residuals and what amounts to one in each.
    pub fn of_positions(residuals: &[T], scales: &[T]) -> Self {
        Self {
            residual: greatest(residuals, scales),
            tolerance: Real::max(T::lit(CLOSED), T::lit(1e3) * T::epsilon()),
            what: Open::Positions,
            remedy: "close them with `multibody::assemble` or `Projection::project`",
        }
    }

    /// The same of their rates, beside those at rest and the velocities, with what amounts to one in each coordinate.
    pub fn of_velocities(rates: &[T], at_rest: &[T], scales: &[T], velocities: &[T], units: &[T]) -> Self {
        let speed = greatest(velocities, units) + greatest(at_rest, scales);
        let share = Real::max(T::lit(CLOSED), T::lit(1e3) * T::epsilon());
        Self {
            residual: greatest(rates, scales),
            tolerance: share * speed + Real::max(T::lit(REST), T::lit(16.0) * T::epsilon()),
            what: Open::Velocities,
            remedy: "give velocities that keep them closed, from `multibody::assemble` or `Projection::project`",
        }
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
        let each = residuals.iter().zip(names).map(|(residual, &name)| Self {
            residual: Real::abs(*residual),
            what: Open::Equation(name),
            remedy: "choose the parameters so that it holds, or hold the loops by multipliers",
            ..Self::of_positions(&[], &[])
        });
        each.fold(Self::none(), |first, next| first.or(|| next))
    }
}

/// The greatest size over its unit; no number where one is none.
fn greatest<T: Real>(values: &[T], units: &[T]) -> T {
    values.iter().zip(units).fold(T::lit(0.0), |worst, (&value, &unit)| {
        let size = Real::abs(value) / unit;
        Real::select(Real::gt(size, worst) | Real::ne(size, size), size, worst)
    })
}
