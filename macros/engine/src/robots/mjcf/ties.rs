//! Stage `robots`, MJCF: `<equality>` and `<actuator>`.

use super::super::mistake::Mistake;
use super::super::robot::{Closure, Kind, Mimic, Motor, Number, Origin};
use super::super::xml::Element;
use super::Reader;
use super::defaults::Said;
use super::turns::{self, Pose};

/// How stiffly a simulator holds what holds here.
const SOFT: [&str; 6] = ["name", "class", "active", "solref", "solimp", "torquescale"];
const MOTOR: [&str; 9] =
    ["group", "ctrllimited", "forcelimited", "ctrlrange", "forcerange", "lengthrange", "user", "nsample", "interp"];

impl<'a, 'input> Reader<'a, 'input> {
    pub(super) fn equality(&mut self, element: Element<'a, 'input>) -> Result<(), Mistake> {
        let said = self.classes.of(element, None)?;
        let is_active = said.text("active") != Some("false");
        match element.name() {
            "connect" => said.only(&["body1", "body2", "anchor"], &SOFT)?,
            "weld" => said.only(&["body1", "body2", "relpose", "anchor"], &SOFT)?,
            "joint" => {
                // Defaults of `<joint>` are those of joints: ties have none.
                super::defaults::known(element, &["joint1", "joint2", "polycoef"], &SOFT)?;
                return if is_active { self.coupling(element) } else { Ok(()) };
            }
            other => {
                let mistake = element.mistake(format!("`<{other}>` in `<equality>` is not supported"));
                return Err(mistake.help("connect, weld and joint are read"));
            }
        }
        if is_active { self.closure(&said) } else { Ok(()) }
    }

    fn closure(&mut self, said: &Said) -> Result<(), Mistake> {
        let element = said.element;
        let first = element.wanted("body1")?.to_owned();
        let second = element.attribute("body2").map_or_else(|| self.world.clone(), str::to_owned);
        let home = |name: &String| {
            let message = || format!("`<{}>` names the body `{name}`, which isn't there", element.name());
            self.homes.get(name).copied().ok_or_else(|| element.mistake(message()))
        };
        let relative = home(&second)?.inverse().then(home(&first)?);
        if first == second {
            return Err(element.mistake(format!("`<{}>` holds `{first}` to itself", element.name())));
        }
        let (kind, in_parent, in_child) = if element.name() == "connect" {
            let anchor = said.numbers::<3>("anchor")?.ok_or_else(|| element.mistake("`<connect>` has no `anchor`"))?;
            let point = relative.point([0, 1, 2].map(|k| anchor[k].value));
            let at = |xyz| Origin { xyz, ..Origin::none() };
            (Kind::Ball, at(anchor), at(point.map(Number::of)))
        } else {
            let pose = match said.numbers::<7>("relpose")?.map(|pose| pose.map(|number| number.value)) {
                // A quaternion of zeros stands for the pose that the file has.
                Some([x, y, z, q0, q1, q2, q3]) if [q0, q1, q2, q3] != [0.0; 4] => {
                    Pose { position: [x, y, z], turn: turns::normal([q0, q1, q2, q3]).unwrap_or(turns::NONE) }
                }
                _ => relative.inverse(),
            };
            (Kind::Fixed, pose.origin(), Origin::none())
        };
        let number = self.robot.closures.len() + 1;
        let name = element.attribute("name").map_or_else(|| format!("{}_{number}", element.name()), str::to_owned);
        let at = element.place();
        let axis = None;
        self.robot.closures.push(Closure { name, at, kind, axis, parent: first, child: second, in_parent, in_child });
        Ok(())
    }

    /// `joint1 = c0 + c1 * joint2`
    fn coupling(&mut self, element: Element<'a, 'input>) -> Result<(), Mistake> {
        let first = element.wanted("joint1")?;
        let Some(second) = element.attribute("joint2") else {
            let mistake =
                element.mistake("`<joint>` in `<equality>` has no `joint2`: a joint that is held is not read");
            return Err(mistake.help("`lock: [joint]` of the part holds it at zero"));
        };
        let coefficients = element.list("polycoef")?;
        if coefficients.iter().skip(2).any(|number| number.value != 0.0) {
            return Err(element.mistake("`polycoef` of `<joint>` is not supported beyond the linear term"));
        }
        let mut coefficients = coefficients.into_iter();
        let offset = coefficients.next().unwrap_or_else(|| Number::whole(0));
        let multiplier = coefficients.next().unwrap_or_else(|| Number::whole(1));
        let Some(joint) = self.robot.joints.iter_mut().find(|joint| joint.name == first) else {
            return Err(element.mistake(format!("`<joint>` names the joint `{first}`, which isn't there")));
        };
        if joint.mimic.is_some() {
            return Err(element.mistake(format!("the joint `{first}` is tied twice")));
        }
        joint.mimic = Some(Mimic { joint: second.to_owned(), at: element.place(), multiplier, offset });
        Ok(())
    }

    pub(super) fn motor(&mut self, element: Element<'a, 'input>) -> Result<(), Mistake> {
        if element.name() != "motor" {
            let mistake = element.mistake(format!("the actuator `<{}>` is not supported", element.name()));
            return Err(mistake.help("`<motor>` is read; an `Effort` of your own can stand for others"));
        }
        let said = self.classes.of(element, None)?;
        said.only(&["name", "class", "joint", "jointinparent", "gear"], &MOTOR)?;
        let Some(joint) = element.attribute("joint").or_else(|| element.attribute("jointinparent")) else {
            return Err(element.mistake("`<motor>` has no `joint`"));
        };
        let gear = said.holder("gear").map_or_else(|| Ok(Vec::new()), |holder| holder.list("gear"))?;
        let gear = gear.into_iter().next().unwrap_or_else(|| Number::whole(1));
        let name = element.attribute("name").map_or_else(|| format!("{joint}_motor"), str::to_owned);
        self.robot.motors.push(Motor { name, at: element.place(), joint: joint.to_owned(), gear });
        Ok(())
    }
}
