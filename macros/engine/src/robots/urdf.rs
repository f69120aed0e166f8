//! Stage `robots`: URDF.
//!
//! In: the text of a file. Out: its robot, or the first mistake. What has no mechanics is counted and read over; all else that
//! is not known is a mistake, since a model without it would be another robot.

mod loops;

use super::mistake::Mistake;
use super::robot::{Inertial, Joint, Kind, Link, Mimic, Number, Origin, Robot};
use super::xml::{self, Element, Lines};

/// Elements without mechanics, wherever they stand.
const READ_OVER: [&str; 10] = [
    "visual",
    "collision",
    "material",
    "transmission",
    "gazebo",
    "limit",
    "safety_controller",
    "calibration",
    "sensor",
    "ros2_control",
];

pub(super) fn read(text: &str, is_friction_ignored: bool) -> Result<Robot, Mistake> {
    let document = xml::parse(text)?;
    let lines = Lines::new(text);
    let root = Element { node: document.root_element(), lines: &lines };
    let is_xacro = |node: roxmltree::Node| node.tag_name().namespace().is_some_and(|space| space.contains("xacro"));
    if let Some(node) = document.descendants().find(|node| is_xacro(*node)) {
        let mistake = Mistake::at(lines.of(node), "macros of xacro are not read");
        return Err(mistake.help(xml::XACRO));
    }
    if root.name() != "robot" {
        return Err(root.mistake(format!("expected `<robot>`, found `<{}>`", root.name())));
    }
    let mut robot = Robot { name: root.attribute("name").unwrap_or_default().to_owned(), ..Robot::default() };
    for element in root.children() {
        match element.name() {
            "link" => {
                let link = link(element, &mut robot)?;
                robot.links.push(link);
            }
            "joint" => {
                let joint = joint(element, is_friction_ignored, &mut robot)?;
                robot.joints.push(joint);
            }
            "loop" => {
                let closure = loops::closure(element, &mut robot)?;
                robot.closures.push(closure);
            }
            "coupling" => {
                let coupling = loops::coupling(element)?;
                robot.couplings.push(coupling);
            }
            _ => over(element, root, &mut robot)?,
        }
    }
    loops::distinct(&robot)?;
    Ok(robot)
}

/// Counts what carries no mechanics.
fn over(element: Element, inside: Element, robot: &mut Robot) -> Result<(), Mistake> {
    if READ_OVER.contains(&element.name()) {
        *robot.read_over.entry(element.name().to_owned()).or_default() += 1;
        return Ok(());
    }
    Err(element.mistake(format!("`<{}>` in `<{}>` is not supported", element.name(), inside.name())))
}

fn link(element: Element, robot: &mut Robot) -> Result<Link, Mistake> {
    let name = element.only(&["name", "type"])?.wanted("name")?.to_owned();
    for child in element.children().filter(|child| child.name() != "inertial") {
        over(child, element, robot)?;
    }
    let inertial = element.child("inertial")?.map(inertial).transpose()?;
    Ok(Link { name, at: element.place(), inertial })
}

fn inertial(element: Element) -> Result<Inertial, Mistake> {
    known(element, &["origin", "mass", "inertia"])?;
    let mass = element.wanted_child("mass")?;
    let value = mass.only(&["value"])?.wanted_number("value")?;
    if value.value < 0.0 {
        return Err(mass.mistake("a mass is not negative"));
    }
    let tensor = element.wanted_child("inertia")?;
    const NAMES: [&str; 6] = ["ixx", "iyy", "izz", "ixy", "ixz", "iyz"];
    tensor.only(&NAMES)?;
    let mut entries = Vec::new();
    for name in NAMES {
        entries.push(tensor.wanted_number(name)?);
    }
    let entries: [Number; 6] = entries.try_into().map_err(|_| tensor.mistake("an inertia has six entries"))?;
    Ok(Inertial { origin: origin(element)?, mass: value, tensor: entries })
}

fn joint(element: Element, is_friction_ignored: bool, robot: &mut Robot) -> Result<Joint, Mistake> {
    let name = element.only(&["name", "type", "independent"])?.wanted("name")?.to_owned();
    loops::independent(element, robot)?;
    let kind = match element.wanted("type")? {
        "revolute" | "continuous" => Kind::Revolute,
        "prismatic" => Kind::Prismatic,
        "fixed" => Kind::Fixed,
        "planar" => Kind::Planar,
        "floating" => Kind::Floating,
        other => {
            let kinds = "revolute, continuous, prismatic, fixed, planar and floating are known";
            return Err(element.mistake(format!("`{other}` is no type of joint")).help(kinds));
        }
    };
    for child in element.children() {
        if !["origin", "parent", "child", "axis", "dynamics", "mimic"].contains(&child.name()) {
            over(child, element, robot)?;
        }
    }
    let parent = element.wanted_child("parent")?.only(&["link"])?.wanted("link")?.to_owned();
    let child = element.wanted_child("child")?.only(&["link"])?.wanted("link")?.to_owned();
    let axis = axis(element, kind)?;
    let damping = match element.child("dynamics")? {
        Some(dynamics) => damping(dynamics, kind, is_friction_ignored)?,
        None => None,
    };
    let mimic = match element.child("mimic")? {
        Some(mimic) => Some(Mimic {
            joint: mimic.only(&["joint", "multiplier", "offset"])?.wanted("joint")?.to_owned(),
            at: mimic.place(),
            multiplier: mimic.number("multiplier")?.unwrap_or_else(|| Number::whole(1)),
            offset: mimic.number("offset")?.unwrap_or_else(|| Number::whole(0)),
        }),
        None => None,
    };
    Ok(Joint {
        name,
        at: element.place(),
        kind,
        parent,
        child,
        origin: origin(element)?,
        axis,
        anchor: None,
        damping,
        armature: None,
        spring: None,
        mimic,
    })
}

/// Of `<axis>`, along X if there is none.
fn axis(element: Element, kind: Kind) -> Result<[Number; 3], Mistake> {
    let Some(axis) = element.child("axis")? else { return Ok([1, 0, 0].map(Number::whole)) };
    let numbers = axis.only(&["xyz"])?.numbers::<3>("xyz")?.ok_or_else(|| axis.mistake("`<axis>` has no `xyz`"))?;
    let has_axis = !matches!(kind, Kind::Fixed | Kind::Floating);
    if has_axis && numbers.iter().all(|number| number.value == 0.0) {
        return Err(axis.mistake("the axis is zero"));
    }
    Ok(numbers)
}

/// Of `<dynamics>`, if it is not zero.
fn damping(dynamics: Element, kind: Kind, is_friction_ignored: bool) -> Result<Option<Number>, Mistake> {
    let friction = dynamics.only(&["damping", "friction"])?.number("friction")?;
    if !is_friction_ignored && friction.is_some_and(|friction| friction.value != 0.0) {
        let mistake = dynamics.mistake("dry friction is not supported: its force jumps where the motion turns");
        return Err(mistake.help("`friction: Ignored` leaves it out; an `Effort` of your own can stand for it"));
    }
    let damping = dynamics.number("damping")?.filter(|damping| damping.value != 0.0);
    if damping.is_some() && !matches!(kind, Kind::Revolute | Kind::Prismatic | Kind::Fixed) {
        return Err(dynamics.mistake("damping of a joint with several coordinates is not supported"));
    }
    Ok(damping.filter(|_| kind != Kind::Fixed))
}

/// Of `<origin>`, of which all is zero that isn't said.
fn origin(element: Element) -> Result<Origin, Mistake> {
    let Some(origin) = element.child("origin")? else { return Ok(Origin::none()) };
    origin.only(&["xyz", "rpy"])?;
    let none = Origin::none();
    Ok(Origin { xyz: origin.numbers("xyz")?.unwrap_or(none.xyz), rpy: origin.numbers("rpy")?.unwrap_or(none.rpy) })
}

fn known(element: Element, names: &[&str]) -> Result<(), Mistake> {
    match element.children().find(|child| !names.contains(&child.name())) {
        Some(child) => Err(child.mistake(format!("`<{}>` in `<{}>` is not supported", child.name(), element.name()))),
        None => Ok(()),
    }
}
