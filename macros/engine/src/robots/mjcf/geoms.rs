//! Stage `robots`, MJCF: masses and inertias of shapes.

use std::f64::consts::PI;

use super::super::mistake::Mistake;
use super::super::robot::{Inertial, Number, Origin};
use super::compiler::Compiler;
use super::defaults::Said;
use super::turns::{self, Matrix, Pose, Vector};

const READ: [&str; 17] = [
    "name",
    "class",
    "type",
    "size",
    "pos",
    "quat",
    "euler",
    "axisangle",
    "xyaxes",
    "zaxis",
    "fromto",
    "mass",
    "density",
    "shellinertia",
    "mesh",
    "hfield",
    "group",
];
const OVER: [&str; 17] = [
    "contype",
    "conaffinity",
    "condim",
    "priority",
    "friction",
    "solmix",
    "solref",
    "solimp",
    "margin",
    "gap",
    "material",
    "rgba",
    "fitscale",
    "fluidshape",
    "fluidcoef",
    "user",
    "surfacevel",
];

/// A solid with its centre of mass.
pub(super) struct Solid {
    mass: f64,
    com: Vector,
    /// About the centre of mass, in the body's axes.
    inertia: Matrix,
}

/// Nothing if it has no mass.
pub(super) fn solid(geom: &Said, compiler: &Compiler) -> Result<Option<Solid>, Mistake> {
    geom.only(&READ, &OVER)?;
    let mistake = |message: &str| geom.element.mistake(message);
    let kind = geom.text("type").unwrap_or(if geom.holder("mesh").is_some() { "mesh" } else { "sphere" });
    let mass = geom.number("mass")?.map(|mass| mass.value);
    let density = geom.number("density")?.map_or(1000.0, |density| density.value);
    if mass.is_some_and(|mass| mass < 0.0) || density < 0.0 {
        return Err(mistake("a mass is not negative"));
    }
    if ["plane", "hfield"].contains(&kind) || mass.unwrap_or(density) == 0.0 {
        return Ok(None);
    }
    if geom.text("shellinertia").is_some_and(|text| text != "false") {
        return Err(mistake("`shellinertia` of `<geom>` is not supported"));
    }
    if ["mesh", "sdf"].contains(&kind) || geom.holder("mesh").is_some() {
        let mistake = mistake("a mesh would give mass, and meshes are not read");
        return Err(mistake.help("give the body an `<inertial>`, or the geom `mass=\"0\"`"));
    }
    if kind == "sphere" && geom.holder("fromto").is_some() {
        return Err(mistake("a sphere has no `fromto`"));
    }
    let size = geom.list("size")?;
    let (length, pose) = match geom.numbers::<6>("fromto")? {
        Some(ends) => {
            let [a, b] = [0, 3].map(|at| [0, 1, 2].map(|k| ends[at + k].value));
            let along = [0, 1, 2].map(|k| b[k] - a[k]);
            let unit = turns::unit(along).ok_or_else(|| mistake("the two ends of `fromto` are one point"))?;
            let middle = [0, 1, 2].map(|k| (a[k] + b[k]) / 2.0);
            (Some(turns::dot(along, along).sqrt() / 2.0), Pose { position: middle, turn: turns::from_z(unit) })
        }
        None => (None, compiler.pose(geom)?),
    };
    // With `fromto` the first size is that across, the length is told by the ends.
    let wanted = match (kind, length) {
        ("sphere", _) | (_, Some(_)) => 1,
        ("capsule" | "cylinder", None) => 2,
        _ => 3,
    };
    if size.len() < wanted || size.iter().take(wanted).any(|size| *size <= 0.0) {
        let message = format!("`size` of a {kind} has {wanted} positive number{}", if wanted == 1 { "" } else { "s" });
        return Err(mistake(&message));
    }
    let half = length.unwrap_or_else(|| size.get(1).copied().unwrap_or_default());
    let axes = match length {
        Some(half) => [size[0], size[0], half],
        None => [0, 1, 2].map(|k| size.get(k).copied().unwrap_or_default()),
    };
    let r = size[0];
    let product = axes[0] * axes[1] * axes[2];
    let volume = match kind {
        "sphere" => 4.0 / 3.0 * PI * r.powi(3),
        "capsule" => PI * r * r * (2.0 * half + 4.0 / 3.0 * r),
        "cylinder" => 2.0 * PI * r * r * half,
        "box" => 8.0 * product,
        "ellipsoid" => 4.0 / 3.0 * PI * product,
        other => {
            let kinds = "sphere, capsule, cylinder, ellipsoid, box, plane, hfield and mesh are known";
            return Err(mistake(&format!("`{other}` is no type of geom")).help(kinds));
        }
    };
    let mass = mass.unwrap_or(density * volume);
    let of_axes = |part: f64| {
        let [a, b, c] = axes.map(|x| x * x);
        [b + c, a + c, a + b].map(|sum| mass * part * sum)
    };
    let of_cylinder = |mass: f64| {
        let across = mass * (3.0 * r * r + 4.0 * half * half) / 12.0;
        [across, across, mass * r * r / 2.0]
    };
    let diagonal = match kind {
        "sphere" => [0.4 * mass * r * r; 3],
        "cylinder" => of_cylinder(mass),
        "box" => of_axes(1.0 / 3.0),
        "ellipsoid" => of_axes(0.2),
        // A cylinder between two halves of a sphere, whose centres of mass are 3/8 of the radius off their flat sides.
        _ => {
            let caps = mass * 2.0 * r / (2.0 * r + 3.0 * half);
            let [across, _, along] = of_cylinder(mass - caps);
            let ball = 0.4 * caps * r * r;
            let across = across + ball + caps * half * (half + 0.75 * r);
            [across, across, along + ball]
        }
    };
    let turn = turns::matrix(pose.turn);
    let inertia = [0, 1, 2].map(|i| [0, 1, 2].map(|j| (0..3).map(|k| turn[i][k] * diagonal[k] * turn[j][k]).sum()));
    Ok(Some(Solid { mass, com: pose.position, inertia }))
}

/// All shapes of a body as one, by Steiner's theorem.
pub(super) fn together(solids: &[Solid]) -> Option<Inertial> {
    let mass: f64 = solids.iter().map(|solid| solid.mass).sum();
    if mass == 0.0 {
        return None;
    }
    let com = [0, 1, 2].map(|k| solids.iter().map(|solid| solid.mass * solid.com[k]).sum::<f64>() / mass);
    let entry = |i: usize, j: usize| {
        let of = |solid: &Solid| {
            let d = [0, 1, 2].map(|k| solid.com[k] - com[k]);
            let square = if i == j { turns::dot(d, d) } else { 0.0 };
            solid.inertia[i][j] + solid.mass * (square - d[i] * d[j])
        };
        Number::of(solids.iter().map(of).sum())
    };
    let tensor = [entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(0, 2), entry(1, 2)];
    Some(Inertial { origin: Origin { xyz: com.map(Number::of), ..Origin::none() }, mass: Number::of(mass), tensor })
}
