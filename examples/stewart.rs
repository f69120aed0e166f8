//! The Stewart-Gough platform, the classic demonstration of symbolic multibody work: coordinates by choice, the structure of
//! its equations, closed forms, leg forces, times, and a free motion.
//!
//! `cargo run --release --example stewart`
//!
//! What is printed comes from the generated code and the constants beside it. Pictures go to `target`. Published numbers are
//! those of a symbolic commercial tool for the same manipulator.

#[path = "stewart/free.rs"]
mod free;
#[path = "stewart/models.rs"]
mod models;
#[path = "stewart/motion.rs"]
mod motion;
#[path = "stewart/svg.rs"]
mod svg;
#[path = "stewart/times.rs"]
mod times;

use std::path::{Path, PathBuf};
use std::time::Instant;

use multibody::nalgebra::{SVector, Vector3};
use multibody::{Cost, Equation};

use models::{absolute, hybrid, joints, level, one_leg, reduced};
use svg::Structure;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let start = Instant::now();
    coordinates();
    structure()?;
    leg_equations();
    closed_form();
    whole_model();
    forces()?;
    times::kinematics();
    times::functions();
    println!();
    free::run()?;
    println!("\n{:.1} s in all", start.elapsed().as_secs_f64());
    Ok(())
}

fn coordinates() {
    println!("Coordinates are chosen by one line of one declaration:\n");
    println!("  {:<52}{:>12}{:>13}{:>11}{:>11}", "", "coordinates", "constraints", "equations", "published");
    let line = |name: &str, dof: usize, constraints: usize, published: &str| {
        println!("  {name:<52}{dof:>12}{constraints:>13}{:>11}{published:>11}", dof + constraints);
    };
    line("Absolute: six for each body", absolute::DOF, absolute::CONSTRAINTS, "150");
    line("hybrid: the plate absolute, legs relative", hybrid::DOF, hybrid::CONSTRAINTS, "42");
    line("Joint: relative, the plate hangs on a leg", joints::DOF, joints::CONSTRAINTS, "36");
    line("hybrid, Reduced: loops solved in closed form", reduced::DOF, 0, "");
    line("the same, the plate driven level", level::DOF, 0, "");
}

fn structure() -> Result<(), std::io::Error> {
    println!("\nConstraint Jacobian in hybrid coordinates: a leg's equations know that leg and the plate.\n");
    picture(hybrid::COORDINATES, hybrid::EQUATIONS, hybrid::JACOBIAN);
    println!("\nIn joint coordinates, where the plate hangs on one leg, all equations know that leg:\n");
    picture(joints::COORDINATES, joints::EQUATIONS, joints::JACOBIAN);
    let list = [
        Structure {
            title: "Absolute",
            coordinates: absolute::COORDINATES,
            equations: absolute::EQUATIONS,
            rows: absolute::JACOBIAN,
        },
        Structure {
            title: "hybrid",
            coordinates: hybrid::COORDINATES,
            equations: hybrid::EQUATIONS,
            rows: hybrid::JACOBIAN,
        },
        Structure {
            title: "Joint",
            coordinates: joints::COORDINATES,
            equations: joints::EQUATIONS,
            rows: joints::JACOBIAN,
        },
    ];
    let path = write("stewart_jacobian.svg", &svg::jacobians(&list))?;
    println!("\nAll three, 72 by 78 too: {}", path.display());
    Ok(())
}

/// A structure as text: coordinates of one joint or body stand together.
fn picture(coordinates: &[&str], equations: &[&str], rows: &[&str]) {
    let owner = |name: &str| name.split('.').next().unwrap_or_default().to_owned();
    let spaced = |entries: &str| {
        let mut line = String::new();
        for (k, entry) in entries.chars().enumerate() {
            if k > 0 && owner(coordinates[k]) != owner(coordinates[k - 1]) {
                line.push(' ');
            }
            line.push(entry);
        }
        line
    };
    let mut heading = String::new();
    for (k, coordinate) in coordinates.iter().enumerate() {
        if k > 0 && owner(coordinate) == owner(coordinates[k - 1]) {
            continue;
        }
        let size = coordinates.iter().filter(|other| owner(other) == owner(coordinate)).count();
        let number: String = owner(coordinate).chars().filter(char::is_ascii_digit).collect();
        let label = if number.is_empty() { "plate".to_owned() } else { format!("l{number}") };
        heading.push_str(&format!("{label:<size$} "));
    }
    println!("  {:<18}{heading}", "");
    for (equation, entries) in equations.iter().zip(rows) {
        println!("  {equation:<18}{}", spaced(entries));
    }
}

fn leg_equations() {
    println!(
        "\nThe three equations of a leg, every dimension a parameter (sine and cosine counted as two functions):\n"
    );
    heading();
    let before = find(one_leg::DERIVED, "constraints");
    let after = find(one_leg::COSTS, "constraints");
    counts("published, before", &[35, 87, 82]);
    counts("published, after common subexpressions", &[14, 12, 6]);
    counts("as derived, on a graph that shares what is equal", &[before.add, before.mul, 2 * before.sincos]);
    counts("in the code", &[after.add, after.mul, 2 * after.sincos]);
    println!(
        "\n  87 published products hold five explicit factors of one. `Model::new` does the heading's sine and cosine.\n"
    );
    print_equations("  They are:", one_leg::FORMULAS, |equation| {
        equation.section == "Constraints" && !equation.text.starts_with("G[")
    });
}

/// Equations as the compiler writes them, each with what it says of where it holds.
fn print_equations(heading: &str, all: &[Equation], wanted: impl Fn(&Equation) -> bool) {
    println!("{heading}\n");
    for equation in all.iter().filter(|equation| wanted(equation)) {
        println!("    {}", equation.text);
        if !equation.says.is_empty() {
            println!("        {}", equation.says);
        }
    }
}

fn heading() {
    println!("  {:<52}{:>8}{:>8}{:>11}", "", "add", "mul", "functions");
}

fn counts(name: &str, [add, mul, functions]: &[u32; 3]) {
    println!("  {name:<52}{add:>8}{mul:>8}{functions:>11}");
}

fn find<'a>(costs: &'a [Cost], function: &str) -> &'a Cost {
    const NONE: Cost = Cost { function: "", add: 0, mul: 0, div: 0, sqrt: 0, sincos: 0, other: 0 };
    costs.iter().find(|cost| cost.function == function).unwrap_or(&NONE)
}

fn closed_form() {
    println!();
    // What the legs have alike stands once, behind what is told of each: where its pin is from its foot, in its axes.
    let follows = |equation: &&Equation| equation.section == "Coordinates that follow";
    let positions: Vec<Equation> = reduced::FORMULAS
        .iter()
        .filter(follows)
        .take_while(|equation| !equation.text.starts_with("S["))
        .copied()
        .collect();
    print_equations("  `solve (gimbal, stroke) from ball { .. }`, in the first leg with", &positions, |equation| {
        equation.text.split(" = ").next().is_some_and(|name| name.contains("legs[0]."))
    });
    print_equations("\n  is", &positions, |equation| equation.says.starts_with("for i"));
    let model = reduced::Model::<f64>::default();
    let q = SVector::from([-1.45, 0.05, 1.05, 0.1, -0.05, 0.15]).into();
    let state = reduced::State { q, v: reduced::Velocity::default() };
    let found = model.kinematics_2(0.0, &state, &reduced::Velocity::default()).position;
    let turn = multibody::nalgebra::Rotation3::from_euler_angles(0.1, -0.05, 0.15);
    let mut error = 0.0_f64;
    for leg in 0..6 {
        let back = multibody::nalgebra::Rotation3::from_axis_angle(&Vector3::z_axis(), -models::HEADING[leg]);
        let pin = Vector3::new(-1.45, 0.05, 1.05) + turn * Vector3::from(models::PINS[leg]);
        let d = back * (pin - Vector3::from(models::FEET[leg]));
        let by_hand = [(-d.y).atan2(d.z), (d.x / d.norm()).asin(), d.norm() - 1.0];
        let emitted = [found[2 * leg], found[2 * leg + 1], found[12 + leg]];
        error = by_hand.iter().zip(emitted).fold(error, |error, (a, b)| error.max((a - b).abs()));
    }
    println!("\n  written by hand it differs from the generated code by {error:.0e}");
}

fn whole_model() {
    println!("\nThe whole manipulator, its dimensions literals:\n");
    println!("  {:<52}{:>8}{:>8}{:>6}{:>6}{:>8}", "", "add", "mul", "div", "sqrt", "sincos");
    println!("  {:<52}{:>8}{:>8}", "42 equations, published, before", 14_096, 35_163);
    println!("  {:<52}{:>8}{:>8}", "42 equations, published, after", 2_369, 2_766);
    let line = |name: &str, cost: &Cost| {
        let Cost { add, mul, div, sqrt, sincos, .. } = cost;
        println!("  {name:<52}{add:>8}{mul:>8}{div:>6}{sqrt:>6}{sincos:>8}");
    };
    line("42 equations: `residual`", find(hybrid::COSTS, "residual"));
    line("inverse dynamics, plate driven level", find(level::COSTS, "inverse_dynamics"));
    line("inverse dynamics: leg forces", find(reduced::COSTS, "inverse_dynamics"));
    line("forward dynamics: accelerations of the plate", find(reduced::COSTS, "forward_dynamics"));
    line("six strokes, rates, accelerations: `kinematics`", find(reduced::COSTS, "kinematics"));
}

fn forces() -> Result<(), std::io::Error> {
    println!("\nLeg forces over one period of the diagonal heave [N]:\n");
    println!("  t [s]     leg 0    leg 1    leg 2    leg 3    leg 4    leg 5");
    for k in 0..=8 {
        let t = motion::PERIOD * f64::from(k) / 8.0;
        print!("  {t:>5.3} ");
        motion::level_forces(t).iter().for_each(|force| print!(" {force:>8.4}"));
        println!();
    }
    let reference = motion::reference();
    let difference = |of: fn(f64) -> [f64; 6]| {
        let errors = reference.iter().map(|(t, forces)| (SVector::from(of(*t)) - SVector::from(*forces)).amax());
        errors.fold(0.0, f64::max)
    };
    println!(
        "\n  from the reference, {} times of 40-digit equations: {:.0e} N, with the plate free to turn {:.0e} N",
        reference.len(),
        difference(motion::level_forces),
        difference(motion::free_forces)
    );
    let lines: Vec<_> = (0..=300)
        .map(|k| {
            let t = motion::PERIOD * f64::from(k) / 300.0;
            (t, motion::level_forces(t))
        })
        .collect();
    let poses = [0.75, 0.0, 0.25].map(|part| motion::heave(motion::PERIOD * part)[0]);
    let points: Vec<_> = reference.into_iter().step_by(5).collect();
    let path = write("stewart_forces.svg", &svg::forces(&poses, &lines, &points))?;
    println!("  drawn: {}\n", path.display());
    Ok(())
}

/// Pictures stand beside what is built.
fn write(name: &str, text: &str) -> Result<PathBuf, std::io::Error> {
    let directory = Path::new(env!("CARGO_MANIFEST_DIR")).join("../target");
    std::fs::create_dir_all(&directory)?;
    std::fs::write(directory.join(name), text)?;
    Ok(Path::new("target").join(name))
}
