//! URDF: a document to a robot.
//!
//! Elements and attributes that say nothing about the motion are read over and listed. All else has to be known: a word that
//! is left out because it is misspelt would make another robot.

use std::collections::{BTreeMap, HashSet};

use roxmltree::Document;

use super::number::Number;
use super::robot::{Inertial, Joint, Kind, Link, Mimic, Origin, Placed, Robot};
use super::xml::{self, Element};
use super::{Choice, Wrong};

/// Elements beside the equations of motion, by the element that they stand in.
const READ_OVER: [(&str, &[&str]); 3] = [
    ("robot", &["material", "transmission", "gazebo", "sensor", "ros2_control", "mujoco"]),
    (
        "link",
        &["visual", "collision", "self_collision_checking", "collision_checking", "self_filter", "contact", "material"],
    ),
    ("joint", &["limit", "safety_controller", "calibration"]),
];

/// Attributes that simulators have added, which no reader of URDF takes for a force.
const FOREIGN: [(&str, &[&str]); 2] =
    [("joint", &["dont_collapse"]), ("dynamics", &["D", "K", "mu_coulomb", "mu_viscous"])];

/// The robot, and notes about what was read over.
pub(super) fn read(document: &Document<'_>, choice: &Choice) -> Result<(Robot, Vec<String>), Wrong> {
    let root = Element::new(document.root_element());
    refuse_macros(document)?;
    if root.name() != "robot" {
        let message = format!("expected the element `robot`, found `{}`", root.name());
        return Err(Wrong::help(&root.at(), message, "a URDF file is `<robot name=\"..\"> .. </robot>`"));
    }
    let name = root.required("name")?;
    root.text("version");
    root.no_others()?;
    let mut over = BTreeMap::new();
    known(&root, &["link", "joint"], &mut over)?;
    let of = |name: &'static str| root.children().filter(move |child| child.name() == name && !child.is_foreign());
    let links = of("link").map(|element| link(&element, &mut over)).collect::<Result<Vec<_>, _>>()?;
    let joints = of("joint").map(|element| joint(&element, choice, &mut over)).collect::<Result<Vec<_>, _>>()?;
    twice(links.iter().map(|link| &link.name), "links")?;
    twice(joints.iter().map(|joint| &joint.name), "joints")?;
    if links.is_empty() {
        return Err(Wrong::new(&root.at(), "the robot has no link"));
    }
    Ok((Robot { name, links, joints }, notes(&over)))
}

fn refuse_macros(document: &Document<'_>) -> Result<(), Wrong> {
    for element in document.descendants().filter(roxmltree::Node::is_element).map(Element::new) {
        if element.is_of_xacro() {
            return Err(xml::xacro(&element.at()));
        }
        if let Some(at) = element.expression() {
            return Err(xml::xacro(&at));
        }
    }
    Ok(())
}

/// Elements of each name that were read over.
type Over = BTreeMap<String, usize>;

fn notes(over: &Over) -> Vec<String> {
    let counts: Vec<String> = over.iter().map(|(name, count)| format!("{name} ({count})")).collect();
    if counts.is_empty() { Vec::new() } else { vec![format!("read over: {}", counts.join(", "))] }
}

/// Every child is one of `wanted`, or may be read over.
fn known(element: &Element<'_, '_>, wanted: &[&str], over: &mut Over) -> Result<(), Wrong> {
    let skipped = READ_OVER.iter().find(|(name, _)| *name == element.name()).map_or(&[][..], |(_, names)| names);
    for child in element.children() {
        let name = child.name();
        if child.is_foreign() || skipped.contains(&name) {
            *over.entry(name.to_owned()).or_default() += 1;
        } else if !wanted.contains(&name) {
            let message = format!("unknown element `{name}` in `{}`", element.name());
            let names = wanted.iter().chain(skipped).map(|name| format!("`{name}`")).collect::<Vec<_>>();
            let help =
                if names.is_empty() { "it has none".to_owned() } else { format!("known are {}", names.join(", ")) };
            return Err(Wrong::help(&child.at(), message, help));
        }
    }
    Ok(())
}

/// An element without elements, all of whose attributes have been read.
fn end(element: &Element<'_, '_>) -> Result<(), Wrong> {
    known(element, &[], &mut Over::new())?;
    element.no_others()
}

/// Asks for attributes that are read over, so that they count as known.
fn foreign(element: &Element<'_, '_>, over: &mut Over) {
    let names = FOREIGN.iter().find(|(name, _)| *name == element.name()).map_or(&[][..], |(_, names)| names);
    for name in names.iter().filter(|name| element.text(name).is_some()) {
        *over.entry((*name).to_owned()).or_default() += 1;
    }
}

fn twice<'a>(names: impl Iterator<Item = &'a Placed<String>>, what: &str) -> Result<(), Wrong> {
    let mut seen = HashSet::new();
    for name in names {
        if !seen.insert(&name.value) {
            return Err(Wrong::new(&name.at, format!("two {what} have the name `{}`", name.value)));
        }
    }
    Ok(())
}

fn link(element: &Element<'_, '_>, over: &mut Over) -> Result<Link, Wrong> {
    let name = element.required("name")?;
    element.text("type");
    element.no_others()?;
    known(element, &["inertial", "origin"], over)?;
    // Some writers put an empty one here, where URDF has none.
    let placed = origin(element)?;
    if !placed.xyz.iter().chain(&placed.rpy).all(Number::is_zero) {
        return Err(Wrong::help(
            &element.at(),
            "a link has no origin of its own",
            "its joint has one, and its inertial",
        ));
    }
    let inertial = element.child("inertial")?.map(|inertial| self::inertial(&inertial)).transpose()?;
    let is_empty = |inertial: &Inertial| inertial.mass.is_zero() && inertial.inertia.iter().all(Number::is_zero);
    Ok(Link { name, inertial: inertial.filter(|inertial| !is_empty(inertial)) })
}

fn inertial(element: &Element<'_, '_>) -> Result<Inertial, Wrong> {
    element.no_others()?;
    known(element, &["origin", "mass", "inertia"], &mut Over::new())?;
    let mass = element.required_child("mass")?;
    let value = mass.required_number("value")?;
    end(&mass)?;
    if value.value.value < 0.0 {
        return Err(Wrong::new(&value.at, "a mass below zero"));
    }
    let inertia = element.required_child("inertia")?;
    let [xx, yy, zz, xy, xz, yz] =
        ["ixx", "iyy", "izz", "ixy", "ixz", "iyz"].map(|name| inertia.required_number(name).map(|entry| entry.value));
    let entries = [xx?, yy?, zz?, xy?, xz?, yz?];
    end(&inertia)?;
    Ok(Inertial { origin: origin(element)?, mass: value.value, inertia: entries, at: element.at() })
}

fn origin(element: &Element<'_, '_>) -> Result<Origin, Wrong> {
    let zero = || [(); 3].map(|()| Number::of(0.0));
    let Some(origin) = element.child("origin")? else { return Ok(Origin { xyz: zero(), rpy: zero() }) };
    let (xyz, rpy) = (origin.vector("xyz")?, origin.vector("rpy")?);
    end(&origin)?;
    Ok(Origin { xyz: xyz.unwrap_or_else(zero), rpy: rpy.unwrap_or_else(zero) })
}

fn joint(element: &Element<'_, '_>, choice: &Choice, over: &mut Over) -> Result<Joint, Wrong> {
    let name = element.required("name")?;
    let kind = element.required("type")?;
    foreign(element, over);
    element.no_others()?;
    known(element, &["origin", "parent", "child", "axis", "dynamics", "mimic"], over)?;
    let kind = match kind.value.as_str() {
        "revolute" | "continuous" => Kind::Revolute,
        "prismatic" => Kind::Prismatic,
        "fixed" => Kind::Fixed,
        "floating" => Kind::Floating,
        "planar" => Kind::Planar,
        other => {
            let help = "there are revolute, continuous, prismatic, fixed, floating and planar";
            return Err(Wrong::help(&kind.at, format!("unknown type of joint `{other}`"), help));
        }
    };
    let end_of = |side: &str| {
        let end_of = element.required_child(side)?;
        let link = end_of.required("link")?;
        end(&end_of)?;
        Ok(link)
    };
    Ok(Joint {
        name,
        kind,
        origin: origin(element)?,
        parent: end_of("parent")?,
        child: end_of("child")?,
        axis: axis(element, kind)?,
        damping: damping(element, kind, choice, over)?,
        mimic: mimic(element, kind, over)?,
        at: element.at(),
    })
}

fn axis(element: &Element<'_, '_>, kind: Kind) -> Result<[Number; 3], Wrong> {
    let along_x = || [1.0, 0.0, 0.0].map(Number::of);
    let Some(axis) = element.child("axis")? else { return Ok(along_x()) };
    let xyz = axis.vector("xyz")?.unwrap_or_else(along_x);
    end(&axis)?;
    let has_axis = matches!(kind, Kind::Revolute | Kind::Prismatic | Kind::Planar);
    if has_axis && xyz.iter().all(Number::is_zero) {
        return Err(Wrong::new(&axis.at(), "an axis of length zero has no direction"));
    }
    Ok(xyz)
}

fn damping(
    element: &Element<'_, '_>,
    kind: Kind,
    choice: &Choice,
    over: &mut Over,
) -> Result<Option<Placed<Number>>, Wrong> {
    let Some(dynamics) = element.child("dynamics")? else { return Ok(None) };
    let damping = dynamics.number("damping")?;
    let friction = dynamics.number("friction")?;
    foreign(&dynamics, over);
    end(&dynamics)?;
    if kind == Kind::Fixed {
        return Ok(None);
    }
    match friction.filter(|friction| !friction.value.is_zero()) {
        Some(_) if choice.frictionless => *over.entry("friction".to_owned()).or_default() += 1,
        Some(friction) => {
            let help = "dry friction has no equation that holds at rest: leave it out by `--without-friction`, and add a law of \
                        your own to the model, such as `force friction: Effort { joint: NAME, value: -f * tanh(NAME.rate / v) }`";
            return Err(Wrong::help(&friction.at, "friction is not imported", help));
        }
        None => {}
    }
    let Some(damping) = damping.filter(|damping| !damping.value.is_zero()) else { return Ok(None) };
    if damping.value.value < 0.0 {
        return Err(Wrong::new(&damping.at, "a damping below zero drives the joint"));
    }
    if !matches!(kind, Kind::Revolute | Kind::Prismatic) {
        let message = "damping of a joint with several coordinates is not imported";
        return Err(Wrong::help(&damping.at, message, "their units differ: add a `Damper` to each in the model"));
    }
    Ok(Some(damping))
}

fn mimic(element: &Element<'_, '_>, kind: Kind, over: &mut Over) -> Result<Option<Mimic>, Wrong> {
    let Some(mimic) = element.child("mimic")? else { return Ok(None) };
    let joint = mimic.required("joint")?;
    let (multiplier, offset) = (mimic.number("multiplier")?, mimic.number("offset")?);
    end(&mimic)?;
    if kind == Kind::Fixed {
        *over.entry("mimic of a fixed joint".to_owned()).or_default() += 1;
        return Ok(None);
    }
    if !matches!(kind, Kind::Revolute | Kind::Prismatic) {
        return Err(Wrong::new(&mimic.at(), "only a joint with one coordinate can follow another one"));
    }
    Ok(Some(Mimic {
        joint,
        multiplier: multiplier.map_or_else(|| Number::of(1.0), |number| number.value),
        offset: offset.map_or_else(|| Number::of(0.0), |number| number.value),
        at: mimic.at(),
    }))
}
