//! A planar double pendulum: declared in thirty lines, integrated in two ways, checked by its energy.
//!
//! `cargo run --release --example double_pendulum`

use multibody::{DormandPrince, IntegrationError, Integrator, Rk4};

#[path = "models/double_pendulum.rs"]
mod model;

use model::double_pendulum::{COSTS, Model, Params, State};

fn main() -> Result<(), IntegrationError> {
    let model = Model::new(&Params { l2: 0.8, ..Params::default() });
    let mut start = State::default();
    start.q.shoulder = 1.2; // rad
    start.q.elbow = 0.8;
    let seconds = 10.0;

    // Steps of a given length ..
    let mut path = Canvas::default();
    let draw = |t, x: &State| path.mark(model.outputs(t, x, &()).tip.xy().into());
    let fixed = Rk4::integrate(&model, 0.0, &start, &(), 1e-3, 10_000, draw)?;
    // .. and steps chosen by their error.
    let tolerance = Integrator::adaptive(DormandPrince, 1e-10, 1e-10);
    let (adaptive, statistics) = tolerance.integrate(&model, 0.0, seconds, &start, &(), |_, _| ())?;

    println!("Path of the tip in {seconds} s, darker where it is slow:\n\n{path}");
    println!("{:<26}{:>12}{:>16}{:>12}{:>12}", "after 10 s", "evaluations", "energy [J]", "heat [J]", "balance [J]");
    let initial = model.outputs(0.0, &start, &()).energy;
    let row = |method: &str, evaluations: u32, x: &State| {
        let energy = model.outputs(seconds, x, &()).energy;
        let balance = energy + x.x.heat - initial;
        println!("{method:<26}{evaluations:>12}{energy:>16.9}{:>12.9}{balance:>12.1e}", x.x.heat);
    };
    row("start", 0, &start);
    row("Runge-Kutta, 1 ms", 40_000, &fixed);
    row("Dormand-Prince, 1e-10", statistics.evaluations, &adaptive);
    let apart = (model.outputs(seconds, &fixed, &()).tip - model.outputs(seconds, &adaptive, &()).tip).norm();
    println!("The two put the tip {apart:.1e} m apart.\n");

    println!("Operations of the generated functions (parameters only: `new`, run once):");
    for cost in COSTS {
        println!("  {cost}");
    }
    Ok(())
}

/// A view of 3.7 m by 2.9 m around the shoulder, drawn in letters.
struct Canvas([[u16; Self::COLUMNS]; Self::ROWS]);

impl Canvas {
    const COLUMNS: usize = 65;
    const ROWS: usize = 26;

    fn mark(&mut self, [x, y]: [f64; 2]) {
        let column = ((x + 1.85) / 3.7 * Self::COLUMNS as f64) as usize;
        let row = ((1.0 - y) / 2.9 * Self::ROWS as f64) as usize;
        if let Some(cell) = self.0.get_mut(row).and_then(|row| row.get_mut(column)) {
            *cell += 1;
        }
    }
}

impl Default for Canvas {
    fn default() -> Self {
        Self([[0; Self::COLUMNS]; Self::ROWS])
    }
}

impl std::fmt::Display for Canvas {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let shade = |&cell: &u16| match cell {
            0 => ' ',
            1..10 => '.',
            10..20 => ':',
            20..40 => 'o',
            _ => '#',
        };
        let rows = self.0.iter().map(|row| row.iter().map(shade).collect::<String>());
        rows.map(|row| row.trim_end().to_owned())
            .filter(|row| !row.is_empty())
            .try_for_each(|row| writeln!(f, "  {row}"))
    }
}
