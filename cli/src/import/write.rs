//! A robot in the language.

use std::f64::consts::{FRAC_PI_2, PI};
use std::ops::Range;
use std::path::Path;

use super::inertia::turned;
use super::names::{self, Names};
use super::number::{Angle, Number};
use super::robot::{Inertial, Joint, Kind, Link, Mimic, Origin, Robot};
use super::tree::{Hung, Tree};
use super::{Choice, Wrong};

/// A model, line by line.
pub(super) struct Written {
    pub(super) lines: Vec<Line>,
    pub(super) notes: Vec<String>,
}

pub(super) struct Line {
    pub(super) text: String,
    /// What it comes from.
    pub(super) origin: Range<usize>,
    /// Of a body: its link in the file.
    pub(super) link: Option<String>,
}

pub(super) fn write(robot: &Robot, tree: &Tree, choice: &Choice, file: &str) -> Result<Written, Wrong> {
    for name in &choice.unphysical {
        if !robot.links.iter().any(|link| link.name.value == *name && link.inertial.is_some()) {
            let message = format!("there is no link `{name}` with an inertia, which `--allow-unphysical` names");
            return Err(Wrong::new(&robot.name.at, message));
        }
    }
    if !choice.floating && tree.joints.iter().all(|hung| !is_joint(robot, hung)) {
        let message = "nothing of this robot moves on the ground";
        return Err(Wrong::help(&robot.name.at, message, "a vehicle moves freely by `--base floating`"));
    }
    let mut names = Names::default();
    // Links first: what is placed in the model is placed in them.
    let root = names.of(&robot.links[tree.root].name.value, "link");
    let mut links = vec![String::new(); robot.links.len()];
    links[tree.root] = root;
    for hung in &tree.joints {
        links[hung.child] = names.of(&robot.links[hung.child].name.value, "link");
    }
    let mut joints = vec![String::new(); robot.joints.len()];
    for hung in tree.joints.iter().filter(|hung| is_joint(robot, hung)) {
        joints[hung.joint] = names.of(&robot.joints[hung.joint].name.value, "joint");
    }
    let (turned, rounded, almost) = (Vec::new(), Vec::new(), Vec::new());
    let mut writer =
        Writer { robot, choice, links, joints, names, turned, rounded, almost, lines: Vec::new(), notes: Vec::new() };
    writer.model(tree, file);
    for (list, what) in [
        (&writer.turned, "inertias turned into the axes of their links, in double precision"),
        (&writer.rounded, "right angles that the file has rounded, taken as exact"),
        (&writer.almost, "almost right angles, taken as they stand (exact ones take fewer operations)"),
    ] {
        if !list.is_empty() {
            writer.notes.push(format!("{what}: {}", list.join(", ")));
        }
    }
    writer.notes.extend(writer.names.note());
    Ok(Written { lines: writer.lines, notes: writer.notes })
}

/// A link without mass that is held fast is a frame, without a joint.
fn is_joint(robot: &Robot, hung: &Hung) -> bool {
    robot.joints[hung.joint].kind != Kind::Fixed || robot.links[hung.child].inertial.is_some()
}

struct Writer<'a> {
    robot: &'a Robot,
    choice: &'a Choice,
    /// Names of the language, by number in the robot.
    links: Vec<String>,
    joints: Vec<String>,
    names: Names,
    /// Links with an inertia in axes of its own.
    turned: Vec<String>,
    /// Right angles that the file has rounded.
    rounded: Vec<String>,
    /// Angles that are almost right ones.
    almost: Vec<String>,
    lines: Vec<Line>,
    notes: Vec<String>,
}

impl Writer<'_> {
    fn line(&mut self, origin: &Range<usize>, indent: usize, text: &str) {
        let text = if text.is_empty() { String::new() } else { format!("{}{text}", "    ".repeat(indent)) };
        self.lines.push(Line { text, origin: origin.clone(), link: None });
    }

    fn item(&mut self, origin: &Range<usize>, text: &str) {
        self.line(origin, 2, text);
    }

    fn model(&mut self, tree: &Tree, file: &str) {
        let robot = self.robot;
        let at = &robot.name.at;
        let file = Path::new(file).file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
        self.line(at, 0, "use multibody::multibody;");
        self.line(at, 0, "");
        self.line(at, 0, "multibody! {");
        let heading = format!("/// The robot `{}` of {}.", robot.name.value.escape_debug(), file.escape_debug());
        self.line(at, 1, &heading);
        self.line(at, 1, &format!("pub mod {} {{", names::module(&robot.name.value)));
        self.item(at, "world { gravity: -9.81 * Z }");
        self.root(tree.root);
        for hung in &tree.joints {
            self.hung(hung);
        }
        let joints = || tree.joints.iter().map(|hung| hung.joint);
        joints().for_each(|joint| self.forces(joint));
        for joint in joints() {
            if let Some(mimic) = &robot.joints[joint].mimic {
                self.mimic(joint, mimic);
            }
        }
        self.item(at, "emit forward_dynamics, inverse_dynamics, mass_matrix, bias;");
        self.line(at, 1, "}");
        self.line(at, 0, "}");
    }

    fn root(&mut self, root: usize) {
        let link = &self.robot.links[root];
        let (at, name) = (&link.name.at, self.links[root].clone());
        if link.inertial.is_none() && !self.choice.floating {
            self.item(at, &format!("let {name} = ground;"));
            return;
        }
        self.body(link, &name);
        let (wanted, kind) = if self.choice.floating { ("float", "Free") } else { ("base", "Fixed") };
        let joint = self.names.give(wanted, "joint");
        self.item(at, &format!("joint {joint}: {kind} {{ parent: ground, child: {name} }}"));
    }

    fn hung(&mut self, hung: &Hung) {
        let (joint, link) = (&self.robot.joints[hung.joint], &self.robot.links[hung.child]);
        let frame = self.frame(&self.links[hung.parent].clone(), joint);
        let child = self.links[hung.child].clone();
        if !is_joint(self.robot, hung) {
            self.item(&joint.at, &format!("let {child} = {frame};"));
            return;
        }
        self.body(link, &child);
        let (kind, axis) = match joint.kind {
            Kind::Revolute => ("Revolute", Some(self.axis(joint))),
            Kind::Prismatic => ("Prismatic", Some(self.axis(joint))),
            Kind::Planar => {
                let note = "URDF does not say which way the coordinates of a planar joint go: in the model they are those of `Planar`";
                self.notes.push(format!("`{}`: {note}", joint.name.value.escape_debug()));
                ("Planar", Some(self.axis(joint)))
            }
            Kind::Fixed => ("Fixed", None),
            Kind::Floating => ("Free", None),
        };
        let axis = axis.map_or_else(String::new, |axis| format!(", axis: {axis}"));
        let name = &self.joints[hung.joint];
        let text = format!("joint {name}: {kind} {{ parent: {frame}, child: {child}{axis} }}");
        self.item(&joint.at, &text);
    }

    fn body(&mut self, link: &Link, name: &str) {
        let Some(inertial) = &link.inertial else {
            self.item(&link.name.at, &format!("body {name} {{ mass: 0.0 }}"));
            return;
        };
        if self.choice.unphysical.contains(&link.name.value) {
            self.item(&inertial.at, "#[allow(unphysical_inertia)]");
        }
        let mut text = format!("body {name} {{ mass: {}", inertial.mass.text);
        if !inertial.origin.xyz.iter().all(Number::is_zero) {
            text += &format!(", com: {}", vector(&inertial.origin.xyz));
        }
        text += &self.inertia(link, inertial);
        self.item(&inertial.at, &format!("{text} }}"));
        if let Some(line) = self.lines.last_mut() {
            line.link = Some(link.name.value.clone());
        }
    }

    /// The field `inertia`, if there is any: of a point mass there is none.
    fn inertia(&mut self, link: &Link, inertial: &Inertial) -> String {
        let is_turned = !inertial.origin.rpy.iter().all(|angle| matches!(angle.angle(), Angle::Right(0)));
        let turned = is_turned.then(|| turned(&inertial.inertia, &inertial.origin.rpy));
        if is_turned {
            self.turned.push(format!("`{}`", link.name.value.escape_debug()));
        }
        let entries = turned.as_ref().unwrap_or(&inertial.inertia);
        let list = |entries: &[Number]| entries.iter().map(|entry| entry.text.as_str()).collect::<Vec<_>>().join(", ");
        match entries.split_at(3) {
            _ if entries.iter().all(Number::is_zero) => String::new(),
            (moments, products) if products.iter().all(Number::is_zero) => {
                format!(", inertia: diag({})", list(moments))
            }
            _ => format!(", inertia: inertia({})", list(entries)),
        }
    }

    /// The frame of a joint at its parent: moved, then turned by yaw, pitch and roll, each about an axis that the one before
    /// has turned.
    fn frame(&mut self, parent: &str, joint: &Joint) -> String {
        let Origin { xyz, rpy: [roll, pitch, yaw] } = &joint.origin;
        let mut text = parent.to_owned();
        if !xyz.iter().all(Number::is_zero) {
            text += &format!(".at({})", vector(xyz));
        }
        for (axis, angle) in [("Z", yaw), ("Y", pitch), ("X", roll)] {
            if let Some(angle) = self.angle(joint, angle) {
                text += &format!(".rotated({axis}, {angle})");
            }
        }
        text
    }

    /// Nothing where it is zero. A right angle that the file has rounded is written as one, so that its cosine is zero.
    fn angle(&mut self, joint: &Joint, angle: &Number) -> Option<String> {
        let right = angle.angle();
        if let Angle::Right(turns) = right
            && angle.value != turns as f64 * FRAC_PI_2
        {
            self.rounded.push(format!("{} of `{}`", angle.text, joint.name.value.escape_debug()));
        }
        match right {
            Angle::Right(0) => return None,
            Angle::Right(turns) => {
                return Some(match turns {
                    1 => "PI / 2".to_owned(),
                    -1 => "-PI / 2".to_owned(),
                    2 => "PI".to_owned(),
                    -2 => "-PI".to_owned(),
                    turns => format!("{turns} * PI / 2"),
                });
            }
            Angle::Almost => self.almost.push(format!("{} of `{}`", angle.text, joint.name.value.escape_debug())),
            Angle::Other if angle.value.abs() > 2.0 * PI => {
                let name = joint.name.value.escape_debug();
                self.notes.push(format!("`{name}`: the angle {} is more than a turn; degrees?", angle.text));
            }
            Angle::Other => {}
        }
        Some(angle.text.clone())
    }

    fn axis(&mut self, joint: &Joint) -> String {
        let axis = &joint.axis;
        let length = axis.iter().map(|entry| entry.value * entry.value).sum::<f64>().sqrt();
        if (length - 1.0).abs() > 1e-6 {
            let name = joint.name.value.escape_debug();
            self.notes.push(format!("`{name}`: the axis has the length {length}, and is taken for its direction"));
        }
        for (k, letter) in ["X", "Y", "Z"].into_iter().enumerate() {
            if (0..3).all(|other| other == k || axis[other].is_zero()) && length == 1.0 {
                return format!("{}{letter}", if axis[k].value < 0.0 { "-" } else { "" });
            }
        }
        vector(axis)
    }

    fn forces(&mut self, joint: usize) {
        let from = &self.robot.joints[joint];
        let name = self.joints[joint].clone();
        if let Some(damping) = &from.damping {
            let force = self.names.give(&format!("{name}_damping"), "force");
            let text = format!("force {force}: Damper {{ joint: {name}, damping: {} }}", damping.value.text);
            self.item(&damping.at, &text);
        }
        let unit = match from.kind {
            Kind::Revolute => "N m",
            Kind::Prismatic => "N",
            Kind::Fixed | Kind::Floating | Kind::Planar => return,
        };
        if self.choice.efforts && from.mimic.is_none() {
            let input = self.names.give(&format!("{name}_effort"), "input");
            let force = self.names.give(&format!("{name}_motor"), "force");
            self.item(&from.at, &format!("/// [{unit}]"));
            self.item(&from.at, &format!("input {input};"));
            self.item(&from.at, &format!("force {force}: Effort {{ joint: {name}, value: {input} }}"));
        }
    }

    fn mimic(&mut self, joint: usize, mimic: &Mimic) {
        let robot = self.robot;
        let coordinate = |joint: usize| {
            let member = if robot.joints[joint].kind == Kind::Prismatic { "travel" } else { "angle" };
            format!("{}.{member}", self.joints[joint])
        };
        let Some(followed) = robot.joints.iter().position(|other| other.name.value == mimic.joint.value) else {
            return;
        };
        let (this, other) = (coordinate(joint), coordinate(followed));
        let offset = if mimic.offset.is_zero() { String::new() } else { format!(" + {}", mimic.offset.text) };
        let name = self.names.give(&format!("{}_mimic", self.joints[joint]), "constraint");
        let text = format!("constraint {name} = {this} - ({} * {other}{offset});", mimic.multiplier.text);
        self.item(&mimic.at, &text);
    }
}

fn vector(numbers: &[Number; 3]) -> String {
    let [x, y, z] = [0, 1, 2].map(|k| numbers[k].text.as_str());
    format!("[{x}, {y}, {z}]")
}
