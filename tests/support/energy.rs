//! The energy of a long motion: how far it strays, and whether it drifts.

use multibody::{Integrator, Method, System};
use std::fmt;

/// What became of an energy, relative to what it was at the start.
#[derive(Clone, Copy, Debug, Default)]
pub struct Drift {
    /// Greatest distance from the start.
    pub worst: f64,
    /// Mean distance over each tenth of the motion.
    pub tenths: [f64; 10],
    /// Slope of the line fitted to all of it, times its length.
    pub rise: f64,
    /// Evaluations of the system for each step.
    pub evaluations: f64,
}

impl fmt::Display for Drift {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [first, .., last] = self.tenths;
        write!(
            f,
            "worst {:.2e}, fitted line rises by {:.1e}, first tenth {first:.2e}, last {last:.2e}, {:.2} evaluations a step",
            self.worst, self.rise, self.evaluations
        )
    }
}

/// Follows a motion over `steps` steps of `dt` `[s]`; `energy` is relative to the start's. Reads it after every step.
pub fn drift<S, M>(
    integrator: &Integrator<M>,
    system: &S,
    start: &S::State,
    (dt, steps): (f64, u32),
    energy: impl Fn(&S::State) -> f64,
) -> Drift
where
    S: System<Input = ()>,
    M: Method<S>,
{
    let n = f64::from(steps);
    let mut drift = Drift::default();
    // Times are counted from the middle of the motion in halves of it, so that the line's two sums do not mix.
    let (mut count, mut moment) = (0.0, 0.0);
    let run = integrator.integrate(system, 0.0, dt * n, start, &(), |_, state| {
        let e = energy(state);
        drift.worst = drift.worst.max(e.abs());
        drift.tenths[((count / n * 10.0) as usize).min(9)] += e * 10.0 / n;
        count += 1.0;
        moment += e * (2.0 * count - n - 1.0) / n;
    });
    let (_, statistics) = run.unwrap();
    assert_eq!(count, n);
    // sum(x e) / sum(x^2) with x from -1 to 1, times two
    drift.rise = 2.0 * moment / (n / 3.0);
    drift.evaluations = f64::from(statistics.evaluations) / n;
    drift
}
