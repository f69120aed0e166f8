//! Stage `robots`, MJCF: what `<compiler>` and `<option>` say of all the others, and orientations.

use super::super::mistake::Mistake;
use super::super::robot::{Number, Origin};
use super::super::xml::Element;
use super::defaults::{Said, known};
use super::turns::{self, Pose, Quaternion};

#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum FromGeoms {
    Auto,
    Always,
    Never,
}

pub(super) struct Compiler {
    pub(super) is_degree: bool,
    /// Axes of the three turns of `euler`; capitals are those of the parent.
    sequence: [char; 3],
    pub(super) from_geoms: FromGeoms,
}

const OVER: [&str; 12] = [
    "autolimits",
    "discardvisual",
    "usethread",
    "fusestatic",
    "saveinertial",
    "strippath",
    "meshdir",
    "texturedir",
    "assetdir",
    "convexhull",
    "exactmeshinertia",
    "conflict",
];
const READ: [&str; 10] = [
    "angle",
    "eulerseq",
    "inertiafromgeom",
    "coordinate",
    "boundmass",
    "boundinertia",
    "settotalmass",
    "inertiagrouprange",
    "balanceinertia",
    "alignfree",
];
/// Forces that `<option>` and its flags would bring or take away.
const FLUID: [&str; 3] = ["density", "viscosity", "wind"];
const FLAGS: [&str; 7] = ["constraint", "equality", "passive", "spring", "damper", "actuation", "frictionloss"];

impl Compiler {
    pub(super) fn plain() -> Compiler {
        Compiler { is_degree: true, sequence: ['x', 'y', 'z'], from_geoms: FromGeoms::Auto }
    }

    pub(super) fn enter(&mut self, element: Element) -> Result<(), Mistake> {
        known(element, &READ, &OVER)?;
        let wrong = |name: &str, text: &str, words: &str| {
            Err(element.mistake(format!("`{text}` in `{name}` of `<compiler>`: expected {words}")))
        };
        match element.attribute("angle") {
            None => {}
            Some("degree") => self.is_degree = true,
            Some("radian") => self.is_degree = false,
            Some(text) => return wrong("angle", text, "degree or radian"),
        }
        if let Some(text) = element.attribute("eulerseq") {
            let letters: Vec<char> = text.chars().filter(|letter| "xyzXYZ".contains(*letter)).collect();
            match <[char; 3]>::try_from(letters) {
                Ok(sequence) if text.len() == 3 => self.sequence = sequence,
                _ => return wrong("eulerseq", text, "three of the letters x, y, z, X, Y, Z"),
            }
        }
        match element.attribute("inertiafromgeom") {
            None => {}
            Some("auto") => self.from_geoms = FromGeoms::Auto,
            Some("true") => self.from_geoms = FromGeoms::Always,
            Some("false") => self.from_geoms = FromGeoms::Never,
            Some(text) => return wrong("inertiafromgeom", text, "auto, true or false"),
        }
        // What would change masses or frames behind the file's back.
        let words = [("coordinate", "local"), ("balanceinertia", "false"), ("alignfree", "false")];
        let changed = words.iter().find(|(name, plain)| element.attribute(name).is_some_and(|text| text != *plain));
        if let Some((name, _)) = changed {
            let message = format!("`{name}=\"{}\"` is not supported", element.attribute(name).unwrap_or_default());
            return Err(element.mistake(message).help("`mj_saveLastXML` writes the model out as it is meant"));
        }
        for name in ["boundmass", "boundinertia", "settotalmass"] {
            if element.number(name)?.is_some_and(|number| number.value > 0.0) {
                return Err(element.mistake(format!("`{name}` of `<compiler>` is not supported")));
            }
        }
        match element.numbers::<2>("inertiagrouprange")? {
            Some([low, high]) if low.value > 0.0 || high.value < 5.0 => {
                Err(element.mistake("`inertiagrouprange` of `<compiler>` is not supported: all geoms give mass"))
            }
            _ => Ok(()),
        }
    }

    pub(super) fn angle(&self, value: f64) -> f64 {
        if self.is_degree { value.to_radians() } else { value }
    }

    /// As written if it is in radians.
    pub(super) fn number(&self, angle: Number) -> Number {
        if self.is_degree { Number::of(angle.value.to_radians()) } else { angle }
    }

    /// The one orientation that an element gives, in its own words or its defaults'.
    pub(super) fn turn(&self, said: &Said) -> Result<Option<Quaternion>, Mistake> {
        const WAYS: [&str; 5] = ["quat", "euler", "axisangle", "xyaxes", "zaxis"];
        let mut given = WAYS.iter().filter(|way| said.holder(way).is_some());
        let Some(way) = given.next() else { return Ok(None) };
        let mistake = |message: String| said.holder(way).unwrap_or(said.element).mistake(message);
        if let Some(second) = given.next() {
            return Err(mistake(format!("an orientation is given twice, by `{way}` and `{second}`")));
        }
        let values = |numbers: &[Number]| numbers.iter().map(|number| number.value).collect::<Vec<f64>>();
        let turn = match *way {
            "quat" => said.numbers::<4>(way)?.and_then(|q| turns::normal(q.map(|number| number.value))),
            "axisangle" => said.numbers::<4>(way)?.and_then(|numbers| {
                let v = values(&numbers);
                turns::about([v[0], v[1], v[2]], self.angle(v[3]))
            }),
            "xyaxes" => said.numbers::<6>(way)?.and_then(|numbers| {
                let v = values(&numbers);
                let x = turns::unit([v[0], v[1], v[2]])?;
                let y = [v[3], v[4], v[5]];
                let along = turns::dot(x, y);
                let y = turns::unit([0, 1, 2].map(|k| y[k] - along * x[k]))?;
                Some(turns::of_axes([x, y, turns::cross(x, y)]))
            }),
            "zaxis" => {
                said.numbers::<3>(way)?.and_then(|z| turns::unit(z.map(|number| number.value))).map(turns::from_z)
            }
            _ => said.numbers::<3>(way)?.and_then(|angles| {
                let mut whole = turns::NONE;
                for (angle, letter) in angles.iter().zip(self.sequence) {
                    let axis = ['x', 'y', 'z'].map(|name| f64::from(u8::from(letter.eq_ignore_ascii_case(&name))));
                    let turn = turns::about(axis, self.angle(angle.value))?;
                    // Small letters turn about axes that the turns before have carried along.
                    whole = match letter.is_ascii_lowercase() {
                        true => turns::product(whole, turn),
                        false => turns::product(turn, whole),
                    };
                }
                Some(whole)
            }),
        };
        turn.map(Some).ok_or_else(|| mistake(format!("`{way}` gives no orientation: it has a direction that is zero")))
    }

    pub(super) fn pose(&self, said: &Said) -> Result<Pose, Mistake> {
        let position = said.numbers::<3>("pos")?.map_or([0.0; 3], |pos| pos.map(|number| number.value));
        Ok(Pose { position, turn: self.turn(said)?.unwrap_or(turns::NONE) })
    }

    /// The same with the digits of the position.
    pub(super) fn origin(&self, said: &Said) -> Result<Origin, Mistake> {
        let origin = self.pose(said)?.origin();
        Ok(Origin { xyz: said.numbers::<3>("pos")?.unwrap_or(origin.xyz), ..origin })
    }
}

/// Refuses forces that no model would have; gravity is that of the model's `world`.
pub(super) fn option(element: Element) -> Result<(), Mistake> {
    for name in FLUID {
        if element.list(name)?.iter().any(|number| number.value != 0.0) {
            return Err(
                element.mistake(format!("`{name}` of `<option>` is not supported: there are no forces of a fluid"))
            );
        }
    }
    for flag in element.children().filter(|child| child.name() == "flag") {
        let is_off = |name: &&&str| flag.attribute(name) == Some("disable");
        if let Some(name) = FLAGS.iter().find(is_off) {
            return Err(flag.mistake(format!("`{name}=\"disable\"` is not supported")).help("remove what is disabled"));
        }
    }
    Ok(())
}
