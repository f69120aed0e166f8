//! Stage `robots`: MJCF, the files of MuJoCo.
//!
//! In: the text of a file. Out: its robot, or the first mistake. Bodies are links, so are sites and the frames between several
//! joints of one body; shapes give mass where no `<inertial>` does. What has no mechanics is counted and read over.

mod compiler;
mod defaults;
mod geoms;
mod ties;
mod turns;

use std::collections::HashMap;

use super::mistake::{Mistake, Place};
use super::robot::{Inertial, Joint, Kind, Link, Number, Origin, Robot, Spring};
use super::xml::{self, Element, Lines};
use compiler::{Compiler, FromGeoms};
use defaults::{Classes, Said, known};
use turns::Pose;

/// Without mechanics, or with such as the model says itself: gravity is that of its `world`, contacts are none.
const READ_OVER: [&str; 10] =
    ["option", "size", "visual", "statistic", "asset", "contact", "sensor", "keyframe", "custom", "light"];

const EXPAND: &str = "write the model out first: `mj_saveLastXML`, or `Save xml` of `simulate`";

/// Where a body says how it is turned.
const FRAME: [&str; 6] = ["pos", "quat", "euler", "axisangle", "xyaxes", "zaxis"];

pub(super) struct Reader<'a, 'input> {
    compiler: Compiler,
    classes: Classes<'a, 'input>,
    is_friction_ignored: bool,
    robot: Robot,
    /// The link that is the world.
    world: String,
    /// Of bodies in the world, while all coordinates are zero.
    homes: HashMap<String, Pose>,
}

pub(super) fn read(text: &str, is_friction_ignored: bool) -> Result<Robot, Mistake> {
    let document = xml::parse(text)?;
    let lines = Lines::new(text);
    let root = Element { node: document.root_element(), lines: &lines };
    if root.name() != "mujoco" {
        return Err(root.mistake(format!("expected `<mujoco>`, found `<{}>`", root.name())));
    }
    root.only(&["model"])?;
    let mut all =
        document.descendants().filter(roxmltree::Node::is_element).map(|node| Element { node, lines: &lines });
    let expanded = ["include", "replicate", "attach", "composite", "flexcomp", "frame"];
    if let Some(element) = all.find(|element| expanded.contains(&element.name())) {
        return Err(element.mistake(format!("`<{}>` is not read", element.name())).help(EXPAND));
    }
    let mut reader = Reader {
        compiler: Compiler::plain(),
        classes: Classes::none(),
        is_friction_ignored,
        robot: Robot { name: root.attribute("model").unwrap_or_default().to_owned(), ..Robot::default() },
        world: "world".to_owned(),
        homes: HashMap::new(),
    };
    // A file's sections come in any order, and all are of the whole.
    let sections = |name: &'static str| root.children().filter(move |child| child.name() == name);
    sections("compiler").try_for_each(|element| reader.compiler.enter(element))?;
    sections("option").try_for_each(compiler::option)?;
    for element in sections("default") {
        reader.classes.enter(element, None)?;
    }
    let Some(first) = sections("worldbody").next() else { return Err(root.mistake("`<mujoco>` has no `<worldbody>`")) };
    reader.robot.links.push(Link { name: reader.world.clone(), at: first.place(), inertial: None });
    reader.homes.insert(reader.world.clone(), Pose::NONE);
    for element in sections("worldbody") {
        reader.world(element)?;
    }
    for section in sections("equality") {
        section.children().try_for_each(|element| reader.equality(element))?;
    }
    for section in sections("actuator") {
        section.children().try_for_each(|element| reader.motor(element))?;
    }
    for element in root.children() {
        if !["compiler", "default", "worldbody", "equality", "actuator"].contains(&element.name()) {
            reader.over(element, root)?;
        }
    }
    Ok(reader.robot)
}

impl<'a, 'input> Reader<'a, 'input> {
    /// Counts what carries no mechanics.
    fn over(&mut self, element: Element, inside: Element) -> Result<(), Mistake> {
        if READ_OVER.contains(&element.name()) || ["camera", "geom"].contains(&element.name()) {
            *self.robot.read_over.entry(element.name().to_owned()).or_default() += 1;
            return Ok(());
        }
        let names =
            READ_OVER.iter().copied().chain(["body", "joint", "geom", "site", "inertial", "camera", "worldbody"]);
        let mistake = element.mistake(format!("`<{}>` in `<{}>` is not supported", element.name(), inside.name()));
        Err(match crate::diagnostics::nearest(element.name(), names) {
            Some(near) => mistake.help(format!("did you mean `{near}`?")),
            None => mistake,
        })
    }

    fn world(&mut self, world: Element<'a, 'input>) -> Result<(), Mistake> {
        known(world, &["childclass"], &[])?;
        let (class, name) = (world.attribute("childclass"), self.world.clone());
        for element in world.children() {
            match element.name() {
                "body" => self.body(element, &name, class)?,
                "site" => self.site(element, &name, class)?,
                // What stands still moves no mass.
                _ => self.over(element, world)?,
            }
        }
        Ok(())
    }

    fn body(&mut self, body: Element<'a, 'input>, parent: &str, class: Option<&'a str>) -> Result<(), Mistake> {
        let read: Vec<&str> = FRAME.into_iter().chain(["name", "childclass", "mocap", "gravcomp"]).collect();
        known(body, &read, &["user", "sleep"])?;
        if body.attribute("mocap").is_some_and(|text| text != "false") {
            return Err(body.mistake("a body that is moved by `mocap` is not supported"));
        }
        if body.number("gravcomp")?.is_some_and(|number| number.value != 0.0) {
            return Err(body.mistake("`gravcomp` of `<body>` is not supported"));
        }
        let class = body.attribute("childclass").or(class);
        if let Some(name) = body.attribute("childclass") {
            self.classes.find(body, name)?;
        }
        let number = self.homes.len();
        let name = body.attribute("name").map_or_else(|| format!("body_{number}"), str::to_owned);
        let said = self.classes.of(body, None)?;
        let home = self.homes[parent].then(self.compiler.pose(&said)?);
        if self.homes.insert(name.clone(), home).is_some() {
            return Err(body.mistake(format!("two bodies are called `{name}`")));
        }
        self.joints(body, &name, parent, class)?;
        let inertial = self.inertial(body, class)?;
        self.robot.links.push(Link { name: name.clone(), at: body.place(), inertial });
        for element in body.children() {
            match element.name() {
                "body" => self.body(element, &name, class)?,
                "site" => self.site(element, &name, class)?,
                "joint" | "freejoint" | "inertial" | "geom" => {}
                _ => self.over(element, body)?,
            }
        }
        Ok(())
    }

    /// All joints of a body, each but the last with a frame without mass behind it.
    fn joints(
        &mut self,
        body: Element<'a, 'input>,
        name: &str,
        parent: &str,
        class: Option<&'a str>,
    ) -> Result<(), Mistake> {
        let is_joint = |element: &Element| ["joint", "freejoint"].contains(&element.name());
        let joints: Vec<Element> = body.children().filter(is_joint).collect();
        let said = self.classes.of(body, None)?;
        let mut origin = self.compiler.origin(&said)?;
        let mut above = parent.to_owned();
        for (k, element) in joints.iter().enumerate() {
            let suffix = if k == 0 { String::new() } else { format!("_{}", k + 1) };
            let own = element.attribute("name").map_or_else(|| format!("{name}_joint{suffix}"), str::to_owned);
            let child = if k + 1 == joints.len() { name.to_owned() } else { format!("{name}_{own}") };
            let mut joint = self.joint(*element, own, [&above, &child], class)?;
            if joint.kind == Kind::Floating {
                if parent != self.world || joints.len() > 1 {
                    let message = "a free joint is the only one of a body in the world";
                    return Err(element.mistake(message));
                }
                // Coordinates of a free body are those of the world, the body's place is where it begins.
            } else {
                joint.origin = std::mem::replace(&mut origin, Origin::none());
            }
            self.robot.joints.push(joint);
            if child != name {
                self.robot.links.push(Link { name: child.clone(), at: element.place(), inertial: None });
            }
            above = child;
        }
        if joints.is_empty() {
            self.weld(format!("{name}_weld"), body.place(), [parent, name], origin);
        }
        Ok(())
    }

    fn joint(
        &self,
        element: Element<'a, 'input>,
        name: String,
        [parent, child]: [&str; 2],
        class: Option<&'a str>,
    ) -> Result<Joint, Mistake> {
        let mut joint = fixed(name, element.place(), [parent, child], Origin::none());
        if element.name() == "freejoint" {
            known(element, &["name", "align"], &["group"])?;
            if element.attribute("align") == Some("true") {
                return Err(element.mistake("`align=\"true\"` is not supported").help(EXPAND));
            }
            return Ok(Joint { kind: Kind::Floating, ..joint });
        }
        let said = self.classes.of(element, class)?;
        self.only_joint(&said)?;
        joint.kind = match said.text("type").unwrap_or("hinge") {
            "hinge" => Kind::Revolute,
            "slide" => Kind::Prismatic,
            "ball" => Kind::Ball,
            "free" => Kind::Floating,
            other => {
                let mistake = element.mistake(format!("`{other}` is no type of joint"));
                return Err(mistake.help("hinge, slide, ball and free are known"));
            }
        };
        // A slide is the same wherever it is held, a free joint holds nothing.
        joint.anchor = said.numbers::<3>("pos")?.filter(|pos| {
            !matches!(joint.kind, Kind::Prismatic | Kind::Floating) && pos.iter().any(|number| number.value != 0.0)
        });
        joint.axis = said.numbers::<3>("axis")?.unwrap_or_else(|| [0, 0, 1].map(Number::whole));
        if matches!(joint.kind, Kind::Ball | Kind::Floating) {
            for name in ["damping", "armature", "stiffness"] {
                said.zero(name, "the joint has several coordinates")?;
            }
            return Ok(joint);
        }
        if joint.axis.iter().all(|number| number.value == 0.0) {
            return Err(element.mistake("the axis is zero"));
        }
        let some = |name: &str| Ok::<_, Mistake>(said.number(name)?.filter(|number| number.value != 0.0));
        joint.damping = some("damping")?;
        joint.armature = some("armature")?;
        let rest = said.number("springref")?.unwrap_or_else(|| Number::whole(0));
        let rest = if joint.kind == Kind::Revolute { self.compiler.number(rest) } else { rest };
        joint.spring = some("stiffness")?.map(|stiffness| Spring { stiffness, rest });
        Ok(joint)
    }

    fn only_joint(&self, said: &Said) -> Result<(), Mistake> {
        const READ: [&str; 12] = [
            "name",
            "class",
            "type",
            "pos",
            "axis",
            "damping",
            "armature",
            "stiffness",
            "springref",
            "ref",
            "frictionloss",
            "springdamper",
        ];
        const OVER: [&str; 12] = [
            "group",
            "limited",
            "range",
            "margin",
            "solreflimit",
            "solimplimit",
            "solreffriction",
            "solimpfriction",
            "actuatorfrcrange",
            "actuatorfrclimited",
            "actuatorgravcomp",
            "user",
        ];
        said.only(&READ, &OVER)?;
        said.zero("ref", "coordinates are zero where the file has the bodies")?;
        said.zero("springdamper", "give `stiffness` and `damping`")?;
        match said.holder("frictionloss") {
            Some(holder) if !self.is_friction_ignored && said.list("frictionloss")?.iter().any(|loss| *loss != 0.0) => {
                let mistake = holder.mistake("dry friction is not supported: its force jumps where the motion turns");
                Err(mistake.help("`friction: Ignored` leaves it out; an `Effort` of your own can stand for it"))
            }
            _ => Ok(()),
        }
    }

    fn inertial(&mut self, body: Element<'a, 'input>, class: Option<&'a str>) -> Result<Option<Inertial>, Mistake> {
        let given = body.child("inertial")?;
        let from_geoms = match self.compiler.from_geoms {
            FromGeoms::Auto => given.is_none(),
            FromGeoms::Always => true,
            FromGeoms::Never => false,
        };
        let mut solids = Vec::new();
        for geom in body.children().filter(|child| child.name() == "geom") {
            let solid = match from_geoms {
                true => geoms::solid(&self.classes.of(geom, class)?, &self.compiler)?,
                false => None,
            };
            match solid {
                Some(solid) => solids.push(solid),
                None => self.over(geom, body)?,
            }
        }
        match given.filter(|_| !from_geoms) {
            Some(element) => self.given(element).map(Some),
            None => Ok(geoms::together(&solids)),
        }
    }

    fn given(&self, element: Element<'a, 'input>) -> Result<Inertial, Mistake> {
        let read: Vec<&str> = FRAME.into_iter().chain(["mass", "diaginertia", "fullinertia"]).collect();
        known(element, &read, &[])?;
        let mass = element.wanted_number("mass")?;
        if mass.value < 0.0 {
            return Err(element.mistake("a mass is not negative"));
        }
        element.wanted("pos")?;
        let said = self.classes.of(element, None)?;
        let origin = self.compiler.origin(&said)?;
        let zero = || Number::whole(0);
        let tensor = match (element.numbers::<3>("diaginertia")?, element.numbers::<6>("fullinertia")?) {
            (Some([xx, yy, zz]), None) => [xx, yy, zz, zero(), zero(), zero()],
            (None, Some(_)) if self.compiler.turn(&said)?.is_some() => {
                return Err(element.mistake("`fullinertia` is in the body's axes: there is no orientation beside it"));
            }
            (None, Some(tensor)) => tensor,
            (Some(_), Some(_)) => return Err(element.mistake("`diaginertia` and `fullinertia` are both given")),
            (None, None) if mass.value == 0.0 => [0; 6].map(Number::whole),
            (None, None) => return Err(element.mistake("`<inertial>` has neither `diaginertia` nor `fullinertia`")),
        };
        Ok(Inertial { origin, mass, tensor })
    }

    /// A frame of its own.
    fn site(&mut self, element: Element<'a, 'input>, parent: &str, class: Option<&'a str>) -> Result<(), Mistake> {
        let said = self.classes.of(element, class)?;
        let read: Vec<&str> = FRAME.into_iter().chain(["name", "class"]).collect();
        said.only(&read, &["type", "group", "material", "rgba", "size", "fromto", "user"])?;
        // Without a name nobody can ask for it.
        let Some(name) = element.attribute("name") else { return Ok(()) };
        if said.holder("fromto").is_some() {
            return Err(element.mistake("`fromto` of `<site>` is not supported").help("give `pos` and an orientation"));
        }
        let is_taken = self.robot.links.iter().any(|link| link.name == name);
        let name = if is_taken { format!("{name}_site") } else { name.to_owned() };
        self.robot.links.push(Link { name: name.clone(), at: element.place(), inertial: None });
        self.weld(format!("{name}_weld"), element.place(), [parent, &name], self.compiler.origin(&said)?);
        Ok(())
    }

    fn weld(&mut self, name: String, at: Place, ends: [&str; 2], origin: Origin) {
        self.robot.joints.push(fixed(name, at, ends, origin));
    }
}

fn fixed(name: String, at: Place, [parent, child]: [&str; 2], origin: Origin) -> Joint {
    Joint {
        name,
        at,
        kind: Kind::Fixed,
        parent: parent.to_owned(),
        child: child.to_owned(),
        origin,
        axis: [0, 0, 1].map(Number::whole),
        anchor: None,
        damping: None,
        armature: None,
        spring: None,
        mimic: None,
    }
}
