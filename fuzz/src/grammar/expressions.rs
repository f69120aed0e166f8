//! Random expressions of the language, of every type that a place takes.

use super::manipulated;
use super::names::{Names, Shape};
use crate::random::Random;

/// What a place may depend on; each includes those before it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Level {
    /// Literals and constants.
    Constant,
    /// Parameters.
    Parameter,
    /// Time: drives.
    Time,
    /// Positions: constraints.
    Position,
    /// Velocities, inputs, states, energies: forces.
    Force,
    /// Accelerations, reactions, powers: outputs.
    Output,
}

/// A number.
pub fn literal(random: &mut Random) -> String {
    match random.below(8) {
        0 => format!("{}", 1 + random.below(5)),
        1 => format!("{}.0", random.below(4)),
        2 => "1e-3".into(),
        3 => "2.5e2".into(),
        4 => format!("{:.1}", random.between(0.1, 3.0)),
        5 => "PI / 6".into(),
        6 => format!("deg({})", random.pick(&[30, 45, 60, 90, 7])),
        _ => format!("{:.3}", random.between(0.05, 2.0)),
    }
}

/// Something that is positive at the defaults, of parameters and constants.
pub fn positive(random: &mut Random, names: &Names, level: Level) -> String {
    match random.below(4) {
        0 if level >= Level::Parameter => names.scalar(random, Shape::Param).unwrap_or_else(|| "1.5".into()),
        1 => names.scalar(random, Shape::Const).unwrap_or_else(|| "0.7".into()),
        2 if level >= Level::Parameter => {
            let p = names.scalar(random, Shape::Param).unwrap_or_else(|| "2".into());
            format!("0.5 * {p} + 0.25")
        }
        _ => format!("{:.2}", random.between(0.2, 3.0)),
    }
}

/// An axis that is not zero.
pub fn axis(random: &mut Random, names: &Names) -> String {
    let p = names.scalar(random, Shape::Param);
    match (random.below(9), p) {
        (0, _) => "X".into(),
        (1, _) => "Y".into(),
        (2, _) => "-Z".into(),
        (3, _) => "[1, 0, 1]".into(),
        (4, _) => "[1, 2, 3]".into(),
        (5, Some(p)) => format!("[{p}, 1, 0.5]"),
        (6, _) => "X + 2 * Y".into(),
        _ => "Z".into(),
    }
}

/// A scalar.
pub fn scalar(random: &mut Random, names: &Names, level: Level, depth: usize) -> String {
    if depth == 0 || random.chance(25) {
        return atom(random, names, level);
    }
    if let Some(other) = newer(random, names, level, depth - 1) {
        return other;
    }
    let a = scalar(random, names, level, depth - 1);
    match random.below(20) {
        0 | 1 => format!("({a} + {})", scalar(random, names, level, depth - 1)),
        2 => format!("({a} - {})", scalar(random, names, level, depth - 1)),
        3 | 4 => format!("{a} * {}", scalar(random, names, level, depth - 1)),
        5 => format!("{a} / (1.5 + powi({}, 2))", scalar(random, names, level, depth - 1)),
        6 => format!("-({a})"),
        7 => format!("{}({a})", random.pick(&["sin", "cos", "atan", "tanh", "abs", "exp", "signum", "sinh"])),
        8 => format!("sqrt(1 + powi({a}, 2))"),
        9 => format!("powi({a}, {})", random.pick(&["2", "3", "-1", "0", "1"])),
        10 => format!("{}({a}, {})", random.pick(&["min", "max", "hypot"]), atom(random, names, level)),
        11 => format!("atan2({a}, 2.0)"),
        12 if level > Level::Constant => {
            let operator = random.pick(&["<", "<=", ">", ">="]);
            let b = atom(random, names, level);
            let junction = match random.below(4) {
                0 => format!("&& {b} < 3.0"),
                1 => format!("|| !({b} > 1)"),
                _ => String::new(),
            };
            format!("select({a} {operator} {b} {junction}, {a}, {})", scalar(random, names, level, depth - 1))
        }
        13 | 14 => {
            let v = vector(random, names, level, depth - 1);
            format!("dot({v}, {})", vector(random, names, level, depth - 1))
        }
        15 => format!("norm({} + 3.0 * X)", vector(random, names, level, depth - 1)),
        16 => format!("({}).{}", vector(random, names, level, depth - 1), random.pick(&["x", "y", "z"])),
        17 => format!("ln(1 + powi({a}, 2))"),
        18 => format!("powf(1.1 + powi({a}, 2), 0.5)"),
        _ => a,
    }
}

/// What is made of finished equations, or of another model.
fn newer(random: &mut Random, names: &Names, level: Level, depth: usize) -> Option<String> {
    match (random.below(100), &names.aid) {
        (0..8, _) if level >= Level::Force => manipulated::finished(random, names, level, depth),
        (8..14, Some(aid)) if level >= Level::Time => Some(manipulated::asked(random, names, aid, level)),
        _ => None,
    }
}

/// A name, or a literal.
fn atom(random: &mut Random, names: &Names, level: Level) -> String {
    let mut choices: Vec<String> = vec![literal(random)];
    choices.extend(names.scalar(random, Shape::Const));
    if level >= Level::Parameter {
        choices.extend(names.scalar(random, Shape::Param));
        choices.extend(names.scalar(random, Shape::Param));
    }
    if level >= Level::Time {
        choices.push("t".into());
    }
    if level >= Level::Position {
        choices.extend(names.coordinate(random));
        choices.extend(names.frame(random).map(|f| format!("{f}.position.{}", random.pick(&["x", "y", "z"]))));
        choices.extend(names.scalar(random, Shape::LetPosition));
    }
    if level >= Level::Force {
        choices.extend(names.scalar(random, Shape::Input));
        choices.extend(names.scalar(random, Shape::State));
        choices.extend(names.coordinate(random).map(|c| format!("{c}.rate")));
        choices.extend(names.scalar(random, Shape::LetForce));
        if random.chance(10) {
            choices.push("kinetic()".into());
        }
    }
    if level >= Level::Output {
        choices.extend(names.coordinate(random).map(|c| format!("{c}.accel")));
        choices.extend(names.coordinate(random).map(|c| format!("{c}.effort")));
        choices.extend(names.force(random).map(|f| format!("{f}.power")));
        choices.push("potential()".into());
        choices.extend(names.joint(random).map(|j| format!("{j}.reaction.force.z")));
    }
    random.pick(&choices).clone()
}

/// A vector.
pub fn vector(random: &mut Random, names: &Names, level: Level, depth: usize) -> String {
    let mut choices: Vec<String> = vec![random.pick(&["X", "Y", "Z"]).to_string()];
    choices.extend(names.vector(random, Shape::Const));
    if level >= Level::Parameter {
        choices.extend(names.vector(random, Shape::Param));
    }
    if level >= Level::Position {
        choices.extend(names.frame(random).map(|f| format!("{f}.position")));
    }
    if level >= Level::Force {
        choices.extend(names.vector(random, Shape::Input));
        let quantity = *random.pick(&["velocity", "angular_velocity", "twist.linear"]);
        choices.extend(names.frame(random).map(|f| format!("{f}.{quantity}")));
    }
    if level >= Level::Output {
        let quantity = *random.pick(&["acceleration", "angular_acceleration"]);
        choices.extend(names.frame(random).map(|f| format!("{f}.{quantity}")));
        choices.extend(names.joint(random).map(|j| format!("{j}.reaction.moment")));
    }
    if depth > 0 && level >= Level::Time && random.chance(12) {
        let other = match &names.aid {
            Some(aid) if random.chance(50) => Some(manipulated::asked_vector(random, names, aid, level)),
            _ if level >= Level::Force => manipulated::finished_vector(random, names, level, depth - 1),
            _ => None,
        };
        if let Some(other) = other {
            return other;
        }
    }
    if depth > 0 {
        let s = scalar(random, names, level, depth - 1);
        let v = random.pick(&choices).clone();
        choices.push(format!("[{s}, 0, {}]", literal(random)));
        choices.push(format!("{s} * {v}"));
        choices.push(format!("({v} - {})", random.pick(&choices)));
        choices.push(format!("cross({v}, {})", random.pick(&choices)));
        if level >= Level::Position {
            choices.extend(names.frame(random).map(|f| format!("{f}.express({v})")));
        }
        choices.push(format!("-({v}) / 2.0"));
    }
    random.pick(&choices).clone()
}

/// A rotation.
pub fn rotation(random: &mut Random, names: &Names, level: Level) -> String {
    match random.below(4) {
        0 => "identity()".into(),
        1 => format!("rotation({}, {})", axis(random, names), scalar(random, names, level, 1)),
        2 => format!("roll_pitch_yaw({}, 0.2, {})", scalar(random, names, level, 1), literal(random)),
        _ => {
            let a = format!("rotation(Z, {})", scalar(random, names, level, 1));
            format!("{a} * rotation({}, {})", axis(random, names), literal(random))
        }
    }
}

/// What an output may be.
pub fn output(random: &mut Random, names: &Names) -> String {
    let frame = names.frame(random).unwrap_or_else(|| "ground".into());
    let level = Level::Output;
    match random.below(14) {
        0..=3 => scalar(random, names, level, 3),
        4 | 5 => vector(random, names, level, 2),
        6 => format!("{frame}.{}", random.pick(&["pose", "rotation", "twist"])),
        7 => format!("{frame}.jacobian"),
        8 => format!("{frame}.jacobian.express({})", names.frame(random).unwrap_or_else(|| "ground".into())),
        9 => match names.joint(random) {
            Some(j) => format!("{j}.reaction"),
            None => "kinetic()".into(),
        },
        10 => match names.joint(random) {
            Some(j) => format!("{j}.reaction.express({frame})"),
            None => "potential()".into(),
        },
        11 => format!("[{}, {}]", scalar(random, names, level, 2), scalar(random, names, level, 1)),
        12 => format!("[{}, {}]", vector(random, names, level, 1), vector(random, names, level, 1)),
        _ => format!("pose({}, {})", vector(random, names, level, 1), rotation(random, names, level)),
    }
}
