//! Stage `robots`, URDF: what URDF+ adds, after Chignoli, Slotine, Wensing and Kim, "URDF+: An Enhanced URDF for Robots with
//! Kinematic Loops", 2024: `<loop>`, `<coupling>` and the attribute `independent` of `<joint>`.

use std::collections::HashSet;

use super::super::mistake::Mistake;
use super::super::robot::{Closure, Coupling, Kind, Origin, Robot};
use super::super::xml::Element;

/// `<loop>`: a joint between a frame of the predecessor and one of the successor.
pub(super) fn closure(element: Element, robot: &mut Robot) -> Result<Closure, Mistake> {
    let name = element.only(&["name", "type"])?.wanted("name")?.to_owned();
    let kind = match element.wanted("type")? {
        "revolute" | "continuous" => Kind::Revolute,
        "prismatic" => Kind::Prismatic,
        "fixed" => Kind::Fixed,
        "planar" => Kind::Planar,
        other => {
            let kinds = "revolute, continuous, prismatic, fixed and planar are known";
            return Err(element.mistake(format!("`{other}` is no type of loop")).help(kinds));
        }
    };
    for child in element.children() {
        if !["predecessor", "successor", "axis"].contains(&child.name()) {
            super::over(child, element, robot)?;
        }
    }
    let [(parent, in_parent), (child, in_child)] = [end(element, "predecessor")?, end(element, "successor")?];
    if parent == child {
        return Err(element.mistake(format!("`{name}` holds `{child}` to itself")));
    }
    let axis = Some(super::axis(element, kind)?).filter(|_| kind != Kind::Fixed);
    Ok(Closure { name, at: element.place(), kind, axis, parent, child, in_parent, in_child })
}

/// A link, and where the joint's frame lies in it.
fn end(element: Element, name: &str) -> Result<(String, Origin), Mistake> {
    let end = element.wanted_child(name)?.only(&["link"])?;
    super::known(end, &["origin"])?;
    Ok((end.wanted("link")?.to_owned(), super::origin(end)?))
}

/// `<coupling>`: a ratio between the coordinates on the ways to two links.
pub(super) fn coupling(element: Element) -> Result<Coupling, Mistake> {
    let name = element.only(&["name"])?.wanted("name")?.to_owned();
    super::known(element, &["predecessor", "successor", "ratio"])?;
    let link = |end: &str| {
        let end = element.wanted_child(end)?.only(&["link"])?;
        super::known(end, &[])?;
        end.wanted("link").map(str::to_owned)
    };
    let (predecessor, successor) = (link("predecessor")?, link("successor")?);
    if predecessor == successor {
        return Err(element.mistake(format!("`{name}` couples `{successor}` to itself")));
    }
    let given = element.wanted_child("ratio")?;
    let ratio = given.only(&["value"])?.wanted_number("value")?;
    if ratio.value == 0.0 {
        return Err(given.mistake("the ratio is zero"));
    }
    Ok(Coupling { name, at: element.place(), ratio, predecessor, successor })
}

/// Which coordinates a state has is for the model to say: the attribute has no mechanics.
pub(super) fn independent(joint: Element, robot: &mut Robot) -> Result<(), Mistake> {
    match joint.attribute("independent") {
        None => Ok(()),
        Some("true" | "True" | "false" | "False") => {
            *robot.read_over.entry("independent".to_owned()).or_default() += 1;
            Ok(())
        }
        Some(other) => Err(joint.mistake(format!("`{other}` in `independent` of `<joint>`: expected true or false"))),
    }
}

/// Loops and couplings are items of one name each.
pub(super) fn distinct(robot: &Robot) -> Result<(), Mistake> {
    let loops = robot.closures.iter().map(|closure| (&closure.name, closure.at));
    let couplings = robot.couplings.iter().map(|coupling| (&coupling.name, coupling.at));
    let mut all: Vec<_> = loops.chain(couplings).collect();
    all.sort_by_key(|(_, at)| (at.line, at.column));
    let mut names = HashSet::new();
    for (name, at) in all {
        if !names.insert(name) {
            return Err(Mistake::at(at, format!("two loops or couplings are called `{name}`")));
        }
    }
    Ok(())
}
