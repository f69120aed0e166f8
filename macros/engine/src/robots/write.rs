//! Stage `robots`: a robot as a module of the language.
//!
//! In: a robot and what the user says of it. Out: the text of a part with one port, an item to a line, each with the place in
//! the file in its documentation. Numbers keep the digits that the file has.

mod ties;

use std::fmt::Write;

use proc_macro2::Ident;

use super::angles;
use super::mistake::{Mistake, Place};
use super::names::{Names, printable};
use super::options::{Base, Options, Quantity};
use super::robot::{Inertial, Joint, Kind, Link, Motor, Number, Origin, Robot, Spring, Tree};

/// A part's text, and what the module that uses it has to say.
pub(super) struct Written {
    pub(super) text: String,
    pub(super) port: String,
}

/// Why there is none: the file is at fault, or a name of the user's.
pub(super) enum Fault {
    Of(Mistake),
    At(Ident, String, Vec<String>),
}

impl From<Mistake> for Fault {
    fn from(mistake: Mistake) -> Fault {
        Fault::Of(mistake)
    }
}

struct Writer<'a> {
    robot: &'a Robot,
    tree: Tree,
    names: Names,
    options: &'a Options,
    file: &'a str,
    /// The input for the effort of each joint, where there is one.
    efforts: Vec<Option<String>>,
    /// Whether a link is there.
    kept: Vec<bool>,
    locked: Vec<bool>,
    items: String,
    params: String,
    /// Angles that were taken as quarter turns.
    snapped: Vec<String>,
    used: Vec<bool>,
}

/// The part `module` of a robot.
pub(super) fn part(robot: &Robot, module: &str, file: &str, options: &Options) -> Result<Written, Fault> {
    let tree = robot.tree()?;
    let names = Names::of(robot)?;
    let mut writer = Writer {
        kept: vec![true; robot.links.len()],
        locked: vec![false; robot.joints.len()],
        used: vec![false; options.params.len()],
        efforts: vec![None; robot.joints.len()],
        robot,
        tree,
        names,
        options,
        file,
        items: String::new(),
        params: String::new(),
        snapped: Vec::new(),
    };
    writer.choose()?;
    let port = writer.names.free("mounting");
    writer.base(&port)?;
    writer.inputs();
    for (k, link) in robot.links.iter().enumerate() {
        if writer.kept[k] && k != writer.tree.root {
            writer.link(k, link)?;
        }
    }
    writer.closures()?;
    writer.couplings()?;
    writer.motors()?;
    if let Some(unused) = writer.used.iter().position(|used| !used) {
        let Quantity { item, of } = &options.params[unused];
        let known = "`mass`, `com` and `inertia` of links with an inertia, and `damping` of joints that have it";
        return Err(Fault::At(
            of.clone(),
            format!("`{item}` has no `{of}` that can be a parameter: there are {known}"),
            Vec::new(),
        ));
    }
    Ok(Written { text: writer.whole(module, &port), port })
}

impl Writer<'_> {
    /// Which links are there, and which joints move.
    fn choose(&mut self) -> Result<(), Fault> {
        let unknown = |name: &Ident, what: &str, all: &[String]| {
            Fault::At(name.clone(), format!("`{}` has no {what} `{name}`", self.file), all.to_vec())
        };
        for name in &self.options.lock {
            let found = self.names.joints.iter().position(|joint| name == joint);
            let found = found.ok_or_else(|| unknown(name, "joint", &self.names.joints))?;
            self.locked[found] = true;
        }
        for name in &self.options.drop {
            let found = self.names.links.iter().position(|link| name == link);
            let found = found.ok_or_else(|| unknown(name, "link", &self.names.links))?;
            if found == self.tree.root {
                let message = format!("`{name}` is the root: all links hang on it");
                return Err(Fault::At(name.clone(), message, Vec::new()));
            }
            self.kept[found] = false;
        }
        for Quantity { item, .. } in &self.options.params {
            if !self.names.links.iter().chain(&self.names.joints).any(|name| item == name) {
                let all: Vec<String> = self.names.links.iter().chain(&self.names.joints).cloned().collect();
                return Err(unknown(item, "link or joint", &all));
            }
        }
        // With all that hangs on it.
        for &link in &self.tree.order {
            if let Some(joint) = self.tree.above[link] {
                self.kept[link] &= self.kept[self.tree.parents[joint]];
            }
        }
        Ok(())
    }

    fn base(&mut self, port: &str) -> Result<(), Fault> {
        let root = &self.robot.links[self.tree.root];
        let name = self.names.links[self.tree.root].clone();
        let free = matches!(self.options.base, Base::Free(_));
        if !free && root.inertial.is_none() {
            self.document(root.at);
            let _ = writeln!(self.items, "let {name} = {port};");
            return Ok(());
        }
        self.body(self.tree.root, root)?;
        let (joint, kind) = if free { ("floating", "Free") } else { ("mount", "Fixed") };
        let joint = self.names.free(joint);
        let _ = writeln!(self.items, "joint {joint}: {kind} {{ parent: {port}, child: {name} }}");
        Ok(())
    }

    /// A link with the joint that it hangs on.
    fn link(&mut self, k: usize, link: &Link) -> Result<(), Fault> {
        let Some(above) = self.tree.above[k] else { return Ok(()) };
        let joint = &self.robot.joints[above];
        let kind = if self.locked[above] { Kind::Fixed } else { joint.kind };
        let parent = self.names.links[self.tree.parents[above]].clone();
        let frame = self.frame(parent, &joint.origin, &joint.name);
        let (child, name) = (self.names.links[k].clone(), self.names.joints[above].clone());
        if kind == Kind::Fixed && link.inertial.is_none() {
            self.document(link.at);
            let _ = writeln!(self.items, "let {child} = {frame};");
        } else {
            self.body(k, link)?;
            self.document(joint.at);
            let has_axis = matches!(kind, Kind::Revolute | Kind::Prismatic | Kind::Planar);
            let (word, axis) = (word(kind), along(Some(&joint.axis).filter(|_| has_axis)));
            let armature = joint.armature.as_ref().filter(|_| kind != Kind::Fixed);
            let armature =
                armature.map_or_else(String::new, |armature| format!(", armature: {}", angles::signed(armature)));
            // What is held at zero lies where it lay, wherever its anchor is.
            let anchor = joint.anchor.as_ref().filter(|_| kind != Kind::Fixed);
            let anchor = anchor.map_or_else(String::new, |anchor| format!(".at({})", list(anchor)));
            let _ = writeln!(
                self.items,
                "joint {name}: {word} {{ parent: {frame}{anchor}, child: {child}{anchor}{axis}{armature} }}"
            );
        }
        if kind != Kind::Fixed {
            self.damper(joint, &name)?;
            self.spring(joint, &name);
            self.effort(above, joint, &name);
        }
        self.mimic(joint, &name, kind)
    }

    fn damper(&mut self, joint: &Joint, name: &str) -> Result<(), Fault> {
        let Some(damping) = &joint.damping else { return Ok(()) };
        let value = match self.param(name, "damping", angles::signed(damping), joint.at)? {
            Some(param) => param,
            None => angles::signed(damping),
        };
        let force = self.names.free(&format!("{name}_damper"));
        self.document(joint.at);
        let _ = writeln!(self.items, "force {force}: Damper {{ joint: {name}, damping: {value} }}");
        Ok(())
    }

    fn spring(&mut self, joint: &Joint, name: &str) {
        let Some(Spring { stiffness, rest }) = &joint.spring else { return };
        let force = self.names.free(&format!("{name}_spring"));
        self.document(joint.at);
        let (stiffness, rest) = (angles::signed(stiffness), angles::signed(rest));
        let _ = writeln!(self.items, "force {force}: Spring {{ joint: {name}, stiffness: {stiffness}, rest: {rest} }}");
    }

    /// The motors of the file, where the user asks for no others.
    fn motors(&mut self) -> Result<(), Fault> {
        if self.options.is_driven {
            return Ok(());
        }
        for Motor { name, at, joint, gear } in &self.robot.motors {
            let Some(number) = self.robot.joints.iter().position(|other| other.name == *joint) else {
                let message = format!("`{name}` drives the joint `{joint}`, which isn't there");
                return Err(Mistake::at(*at, message).into());
            };
            let driven = &self.robot.joints[number];
            let unit = match driven.kind {
                Kind::Revolute => "N m",
                Kind::Prismatic => "N",
                _ => {
                    let message = format!("`{name}` drives `{joint}`, which has not one coordinate");
                    return Err(Mistake::at(*at, message).into());
                }
            };
            if !self.moves(number) {
                continue;
            }
            let input = self.names.own(name, *at)?;
            let force = self.names.free(&format!("{input}_effort"));
            let (place, joint) = (self.place(*at), &self.names.joints[number]);
            let unit =
                if gear.value == 1.0 { format!("[{unit}] ") } else { format!("Times {:?} {unit}, ", gear.value) };
            let factor = if gear.value == 1.0 { String::new() } else { format!("{} * ", angles::signed(gear)) };
            let _ = writeln!(self.params, "/// {unit}{place}\ninput {input}: Scalar;");
            let _ =
                writeln!(self.items, "/// {place}\nforce {force}: Effort {{ joint: {joint}, value: {factor}{input} }}");
        }
        Ok(())
    }

    /// Whether a joint is there and not locked.
    fn moves(&self, joint: usize) -> bool {
        let child = self.robot.links.iter().position(|link| link.name == self.robot.joints[joint].child);
        !self.locked[joint] && child.is_some_and(|link| self.kept[link])
    }

    /// One array of inputs for the joints that an effort can drive, in the order of the file.
    fn inputs(&mut self) {
        if !self.options.is_driven {
            return;
        }
        let is_driven = |&number: &usize| {
            let joint = &self.robot.joints[number];
            self.moves(number) && joint.mimic.is_none() && matches!(joint.kind, Kind::Revolute | Kind::Prismatic)
        };
        let driven: Vec<usize> = (0..self.robot.joints.len()).filter(is_driven).collect();
        if driven.is_empty() {
            return;
        }
        let input = self.names.free("effort");
        let all = |kind| driven.iter().all(|&joint| self.robot.joints[joint].kind == kind);
        let unit = match (all(Kind::Revolute), all(Kind::Prismatic)) {
            (true, _) => "[N m] ",
            (_, true) => "[N] ",
            _ => "N m or N ",
        };
        let joints: Vec<&str> = driven.iter().map(|&joint| self.names.joints[joint].as_str()).collect();
        let (joints, count) = (joints.join("`, `"), driven.len());
        let _ = writeln!(self.params, "/// {unit}of `{joints}`\ninput {input}: [Scalar; {count}];");
        for (at, &joint) in driven.iter().enumerate() {
            self.efforts[joint] = Some(format!("{input}[{at}]"));
        }
    }

    /// What its input exerts on a joint.
    fn effort(&mut self, number: usize, joint: &Joint, name: &str) {
        let Some(effort) = self.efforts[number].take() else { return };
        let force = self.names.free(&format!("{name}_motor"));
        self.document(joint.at);
        let _ = writeln!(self.items, "force {force}: Effort {{ joint: {name}, value: {effort} }}");
    }

    fn body(&mut self, k: usize, link: &Link) -> Result<(), Fault> {
        let name = self.names.links[k].clone();
        self.document(link.at);
        let Some(Inertial { origin, mass, tensor }) = &link.inertial else {
            let _ = writeln!(self.items, "body {name} {{ mass: 0.0 }}");
            return Ok(());
        };
        if self.options.is_inertia_waived {
            self.items.push_str("#[allow(unphysical_inertia)]\n");
        }
        let entries = match origin.rpy.iter().all(|angle| angle.value == 0.0) {
            true => tensor.iter().map(angles::signed).collect::<Vec<_>>(),
            false => {
                self.note(&origin.rpy, &format!("the inertia of `{}`", link.name));
                let turned = angles::turned(tensor, &origin.rpy, self.options.are_angles_snapped);
                turned.iter().map(|entry| format!("{entry:?}")).collect()
            }
        };
        let com = list(&origin.xyz);
        let mass = self.param(&name, "mass", angles::signed(mass), link.at)?.unwrap_or_else(|| angles::signed(mass));
        let com = self.param(&name, "com", com.clone(), link.at)?.unwrap_or(com);
        let six = entries.join(", ");
        let six = match self.param(&name, "inertia", format!("[{six}]"), link.at)? {
            Some(param) => [0, 1, 2, 3, 4, 5].map(|k| format!("{param}[{k}]")).join(", "),
            None => six,
        };
        let _ = writeln!(self.items, "body {name} {{ mass: {mass}, com: {com}, inertia: inertia({six}) }}");
        Ok(())
    }

    /// The name of the parameter, if the user wants this to be one.
    fn param(&mut self, item: &str, of: &str, value: String, at: Place) -> Result<Option<String>, Mistake> {
        let wanted = |quantity: &Quantity| quantity.item == item && quantity.of == of;
        let mut is_wanted = false;
        for (quantity, used) in self.options.params.iter().zip(&mut self.used) {
            if wanted(quantity) {
                *used = true;
                is_wanted = true;
            }
        }
        if !is_wanted {
            return Ok(None);
        }
        let name = format!("{item}_{of}");
        self.names.take(&name, format!("the parameter `{item}.{of}`"), Some(at))?;
        let unit = match of {
            "mass" => "[kg] ",
            "com" => "[m] ",
            "inertia" => "[kg m^2] xx, yy, zz, xy, xz, yz, ",
            _ => "",
        };
        let place = self.place(at);
        let _ = writeln!(self.params, "/// {unit}{place}\nparam {name} = {value};");
        Ok(Some(name))
    }

    fn frame(&mut self, parent: String, origin: &Origin, joint: &str) -> String {
        let mut frame = parent;
        if origin.xyz.iter().any(|number| number.value != 0.0) {
            let _ = write!(frame, ".at({})", list(&origin.xyz));
        }
        self.note(&origin.rpy, &format!("joint `{joint}`"));
        let [roll, pitch, yaw] = &origin.rpy;
        for (axis, angle) in [("Z", yaw), ("Y", pitch), ("X", roll)] {
            if let Some(angle) = angles::text(angle, self.options.are_angles_snapped) {
                let _ = write!(frame, ".rotated({axis}, {angle})");
            }
        }
        frame
    }

    fn note(&mut self, rpy: &[Number; 3], what: &str) {
        if !self.options.are_angles_snapped {
            return;
        }
        for (angle, name) in rpy.iter().zip(["roll", "pitch", "yaw"]) {
            if angle.value != 0.0 && angles::quarters(angle).is_some() {
                self.snapped.push(format!("{name} {} of {}", angles::signed(angle), printable(what)));
            }
        }
    }

    fn place(&self, Place { line, column }: Place) -> String {
        format!("`{}:{line}:{column}`", printable(self.file))
    }

    fn document(&mut self, at: Place) {
        let place = self.place(at);
        let _ = writeln!(self.items, "/// {place}");
    }

    fn whole(self, module: &str, port: &str) -> String {
        let mut text = format!("/// The robot `{}` of `{}`.\n", printable(&self.robot.name), printable(self.file));
        if !self.robot.read_over.is_empty() {
            let list: Vec<String> = self.robot.read_over.iter().map(|(name, n)| format!("`{name}` ({n})")).collect();
            let _ = writeln!(text, "///\n/// Read over, as it has no mechanics: {}.", list.join(", "));
        }
        if !self.snapped.is_empty() {
            let _ = writeln!(text, "///\n/// Taken as quarter turns: {}.", self.snapped.join(", "));
        }
        let _ = writeln!(text, "mod {module} {{\nport {port}: Frame;\n{}{}}}", self.params, self.items);
        text
    }
}

fn list(numbers: &[Number; 3]) -> String {
    format!("[{}]", numbers.iter().map(angles::signed).collect::<Vec<_>>().join(", "))
}

/// The kind of a joint in the language.
fn word(kind: Kind) -> &'static str {
    match kind {
        Kind::Fixed => "Fixed",
        Kind::Ball => "Ball",
        Kind::Floating => "Free",
        Kind::Revolute => "Revolute",
        Kind::Prismatic => "Prismatic",
        Kind::Planar => "Planar",
    }
}

/// The field of a joint that has an axis.
fn along(axis: Option<&[Number; 3]>) -> String {
    axis.map_or_else(String::new, |axis| format!(", axis: {}", direction(axis)))
}

/// Unit vectors have names.
fn direction(axis: &[Number; 3]) -> String {
    let values = [axis[0].value, axis[1].value, axis[2].value];
    for (k, name) in ["X", "Y", "Z"].into_iter().enumerate() {
        let is_along = |sign: f64| (0..3).all(|i| values[i] == if i == k { sign } else { 0.0 });
        if is_along(1.0) {
            return name.to_owned();
        }
        if is_along(-1.0) {
            return format!("-{name}");
        }
    }
    list(axis)
}
