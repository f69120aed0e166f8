//! Random calls of the macro that keep to the grammar and to the types: everything that the language has, in any order.
//!
//! A call is one item per line, so a failure is made small by leaving lines out. What comes of a call is code or
//! messages of the compiler's own; the code must pass `rustc` and clippy without a word (`rustc`).

pub mod expressions;
pub mod manipulated;
pub mod mutate;
pub mod names;
pub mod oracle;
pub mod rustc;

use std::fmt::Write;
use std::rc::Rc;

use expressions::{Level, axis, literal, output, positive, rotation, scalar, vector};
use names::{Aid, Names, Shape};

use crate::random::Random;

/// A call as lines: one item or one bracket each.
pub fn call(random: &mut Random) -> Vec<String> {
    let mut out = Lines::default();
    let part = random.chance(35).then(|| out.part(random));
    let aid = random.chance(40).then(|| Rc::new(out.aid(random)));
    out.model(random, part.as_ref(), aid);
    out.lines
}

/// A call of a model `m` whose outputs take others apart, and one that it asks, for [`crate::manipulated`]: of `m` an expression
/// `of`, its derivatives, `put`, which has `value` in the place of a variable, `asked`, a question, and what is given there. The
/// other model has what is asked for as its output.
pub fn apart(random: &mut Random) -> Option<Vec<String>> {
    let mut out = Lines::default();
    let aid = out.aid(random);
    let question = scalar(random, &aid.names, Level::Force, 2);
    // Behind the last item.
    let end = out.lines.pop()?;
    out.push(format!("output asked = {question};"));
    out.push(end);
    let aid = Rc::new(aid);
    let mut names = Names { aid: Some(Rc::clone(&aid)), ..Names::default() };
    out.push("pub mod m {".into());
    out.values(random, &mut names, false);
    out.link(random, &mut names, "ground", 14);
    let parent = names.bodies[0].clone();
    out.link(random, &mut names, &parent, 12);
    out.states(random, &mut names);
    out.lets(random, &mut names);
    let mut variables: Vec<String> = (0..6).filter_map(|_| manipulated::variable(random, &names)).collect();
    variables.sort();
    variables.dedup();
    let of = scalar(random, &names, Level::Force, 3);
    out.push(format!("output of = {of};"));
    for (k, variable) in variables.iter().enumerate() {
        out.push(format!("output d{k} = diff({of}, {variable});"));
    }
    let first = variables.first()?;
    let value = scalar(random, &names, Level::Force, 1);
    out.push(format!("output put = substitute({of}, {first} = {value});"));
    out.push(format!("output value = {value};"));
    let mut given = String::new();
    for (k, name) in aid.given.iter().enumerate() {
        let value = scalar(random, &names, Level::Force, 1);
        out.push(format!("output g{k} = {value};"));
        write!(given, ", {name} = {value}").ok()?;
    }
    out.push(format!("output asked = {}({question}{given});", aid.name));
    out.push("}".into());
    Some(out.lines)
}

#[derive(Default)]
struct Lines {
    lines: Vec<String>,
    /// For names that are never used twice.
    count: usize,
}

struct Part {
    names: Names,
    params: Vec<String>,
}

/// Brackets that hold no known unit: expressions here are drawn without regard to units, which the compiler would tell.
const UNITS: [&str; 4] = ["/// [pieces] of something", "/// [items m]", "/// words", "/// [steps/s^2]"];

impl Lines {
    fn push(&mut self, line: String) {
        self.lines.push(line);
    }

    fn name(&mut self, random: &mut Random, stem: &str) -> String {
        self.count += 1;
        // Words of Rust and of generated code among them.
        let odd = [
            "state", "time", "model", "self_", "r#type", "r#arm", "v", "q", "params", "input_", "r#match", "values",
            "c1",
        ];
        if random.chance(6) {
            let word = *random.pick(&odd);
            if !["state", "time"].contains(&word) {
                return format!(
                    "{word}{}",
                    if word.starts_with("r#") { String::new() } else { self.count.to_string() }
                );
            }
        }
        format!("{stem}{}", self.count)
    }

    /// Constants, parameters, inputs.
    fn values(&mut self, random: &mut Random, names: &mut Names, part: bool) -> Vec<String> {
        let mut params = Vec::new();
        for _ in 0..random.below(3) {
            let name = format!("K{}", {
                self.count += 1;
                self.count
            });
            match random.below(4) {
                0 => {
                    self.push(format!("const {name}: Vec3 = [{}, 0.5, 1];", literal(random)));
                    names.vectors.push((Shape::Const, name));
                }
                1 => {
                    self.push(format!("const {name}: [Scalar; 2] = [{}, 2];", literal(random)));
                    names.scalars.push((Shape::Const, format!("{name}[1]")));
                }
                _ => {
                    self.push(format!("const {name} = {};", positive(random, names, Level::Constant)));
                    names.scalars.push((Shape::Const, name));
                }
            }
        }
        for _ in 0..random.below(4) {
            let name = self.name(random, "p");
            if random.chance(40) {
                self.push((*random.pick(&UNITS)).to_owned());
            }
            match random.below(5) {
                0 => {
                    self.push(format!("param {name}: Vec3 = [0.3, {}, 1];", literal(random)));
                    names.vectors.push((Shape::Param, name));
                }
                1 => {
                    self.push(format!(
                        "param {name}: [Scalar; 3] = [1, 0.4, {}];",
                        positive(random, names, Level::Constant)
                    ));
                    names.scalars.push((Shape::Param, format!("{name}[2]")));
                    names.scalars.push((Shape::Param, format!("{name}[0]")));
                }
                2 => {
                    self.push(format!("param {name}: [Vec3; 2] = [[1, 0, 0], [0, 0.1, 0.2]];"));
                    names.vectors.push((Shape::Param, format!("{name}[1]")));
                }
                _ => {
                    self.push(format!("param {name} = {};", positive(random, names, Level::Parameter)));
                    names.scalars.push((Shape::Param, name.clone()));
                    params.push(name);
                }
            }
        }
        for _ in 0..random.below(if part { 2 } else { 3 }) {
            let name = self.name(random, "u");
            match random.below(4) {
                0 => {
                    self.push(format!("input {name}: Vec3;"));
                    names.vectors.push((Shape::Input, name));
                }
                1 => {
                    self.push(format!("input {name}: [Scalar; 2];"));
                    names.scalars.push((Shape::Input, format!("{name}[0]")));
                }
                _ => {
                    self.push(format!("input {name};"));
                    names.scalars.push((Shape::Input, name));
                }
            }
        }
        params
    }

    fn inertia(&self, random: &mut Random, names: &Names, mass: &str) -> String {
        let p = |random: &mut Random| positive(random, names, Level::Parameter);
        match random.below(7) {
            0 => format!("cuboid({mass}, [{}, 0.4, {}])", p(random), p(random)),
            1 => format!("cylinder({mass}, {}, {}, {})", p(random), p(random), axis(random, names)),
            2 => format!("sphere({mass}, {})", p(random)),
            3 => "inertia(0.2, 0.23, 0.21, 0.02, -0.01, 0.03)".into(),
            4 => {
                let x = p(random);
                format!("diag({x}, {x}, {x})")
            }
            _ => "diag(0.1, 0.2, 0.25)".into(),
        }
    }

    fn place(&self, random: &mut Random, names: &Names, frame: &str) -> String {
        let mut text = frame.to_owned();
        for _ in 0..random.below(3) {
            text += &match random.below(4) {
                0 => format!(".rotated({}, {})", axis(random, names), scalar(random, names, Level::Parameter, 1)),
                1 => ".oriented([[0, -1, 0], [1, 0, 0], [0, 0, 1]])".into(),
                _ => format!(".at({})", vector(random, names, Level::Parameter, 1)),
            };
        }
        text
    }

    /// A body on a joint.
    fn link(&mut self, random: &mut Random, names: &mut Names, parent: &str, kinds: usize) {
        let (body, joint) = (self.name(random, "b"), self.name(random, "j"));
        let mut mass = positive(random, names, Level::Parameter);
        if random.chance(10) {
            let state = self.name(random, "s");
            let rate = scalar(random, names, Level::Force, 1);
            self.push(format!("state {state}: rate = {rate}, start: {};", positive(random, names, Level::Constant)));
            mass = format!("({mass} + {state})");
        }
        let inertia = self.inertia(random, names, &mass);
        let com = if random.chance(60) {
            format!(", com: {}", vector(random, names, Level::Parameter, 1))
        } else {
            String::new()
        };
        if random.chance(20) {
            self.push("/// A body with words.".into());
        }
        self.push(format!("body {body} {{ mass: {mass}{com}, inertia: {inertia} }}"));
        let parent = self.place(random, names, parent);
        let child = if random.chance(70) { body.clone() } else { self.place(random, names, &body) };
        let a = axis(random, names);
        let armature = if random.chance(20) { ", armature: 0.05" } else { "" };
        let (kind, fields, coordinates): (&str, String, &[&str]) = match random.below(kinds) {
            0..=4 => ("Revolute", format!(", axis: {a}{armature}"), &["angle"]),
            5 | 6 => ("Prismatic", format!(", axis: {a}{armature}"), &["travel"]),
            7 => ("Screw", format!(", axis: {a}, pitch: 0.1{armature}"), &["angle"]),
            8 => ("Cylindrical", format!(", axis: {a}"), &["travel", "angle"]),
            9 if random.chance(50) => ("PinSlot", ", axis: [0, 3, -4], slide: -X".into(), &["travel", "angle"]),
            9 => ("Universal", ", axes: [X, Z]".into(), &["first", "second"]),
            10 if random.chance(50) => ("Planar", ", axes: [X, [0, 3, -4]]".into(), &["x", "y", "angle"]),
            10 => ("Planar", ", axis: Y".into(), &["x", "y", "angle"]),
            11 => ("Ball", ", coordinates: RollPitchYaw".into(), &["roll", "pitch", "yaw"]),
            12 => ("Free", ", coordinates: RollPitchYaw".into(), &["x", "y", "z", "roll", "pitch", "yaw"]),
            13 => ("Fixed", String::new(), &[]),
            14 => ("Ball", String::new(), &[]),
            _ => ("Free", String::new(), &["x", "y", "z"]),
        };
        self.push(format!("joint {joint}: {kind} {{ parent: {parent}, child: {child}{fields} }}"));
        names.frames.push(body.clone());
        names.bodies.push(body);
        names.coordinates.extend(coordinates.iter().map(|c| format!("{joint}.{c}")));
        names.variables.extend(coordinates.iter().map(|c| format!("{joint}.{c}")));
        if random.chance(80) {
            names.joints.push(joint);
        }
    }

    fn force(&mut self, random: &mut Random, names: &mut Names) {
        let name = self.name(random, "f");
        let level = Level::Force;
        let frame = |random: &mut Random| names.frame(random).unwrap_or_else(|| "ground".into());
        let number = |random: &mut Random| scalar(random, names, level, 2);
        let text = match (random.below(7), names.coordinate(random)) {
            (0 | 1, Some(c)) => format!("Effort {{ joint: {c}, value: {} }}", number(random)),
            (2, Some(c)) => {
                format!("SpringDamper {{ joint: {c}, stiffness: {}, damping: 0.2, rest: 0.1 }}", number(random))
            }
            (3, Some(c)) => format!("Damper {{ joint: {c}, damping: {} }}", positive(random, names, Level::Parameter)),
            (4, _) => format!(
                "Spring {{ between: [{}, ground.at([3, 2, 1])], stiffness: {}, length: 0.5 }}",
                frame(random),
                number(random)
            ),
            (5, _) => format!(
                "Torque {{ at: {}, value: {}, axes: {} }}",
                frame(random),
                vector(random, names, level, 2),
                frame(random)
            ),
            _ => format!("Force {{ at: {}, value: {}, axes: ground }}", frame(random), vector(random, names, level, 2)),
        };
        self.push(format!("force {name}: {text}"));
        names.forces.push(name);
    }

    fn lets(&mut self, random: &mut Random, names: &mut Names) {
        for _ in 0..random.below(3) {
            let name = self.name(random, "l");
            match random.below(4) {
                0 => {
                    let frame = names.frame(random).unwrap_or_else(|| "ground".into());
                    self.push(format!("let {name} = {frame}.at(0.2 * Y);"));
                    names.frames.push(name);
                }
                1 => {
                    self.push(format!("let {name} = {};", scalar(random, names, Level::Position, 2)));
                    names.scalars.push((Shape::LetPosition, name));
                }
                _ => {
                    self.push(format!("let {name} = {};", scalar(random, names, Level::Force, 2)));
                    names.scalars.push((Shape::LetForce, name));
                }
            }
        }
    }

    fn states(&mut self, random: &mut Random, names: &mut Names) {
        if random.chance(30) {
            let name = self.name(random, "s");
            if random.chance(30) {
                // One that may be settled: its rate is linear in it.
                let factor = positive(random, names, Level::Parameter);
                let rest = scalar(random, names, Level::Force, 2);
                self.push(format!("state {name}: rate = {rest} - ({factor}) * {name}, start: {};", literal(random)));
                let is_settled = random.chance(60);
                if is_settled {
                    self.push(format!("simplify {name}.rate == 0;"));
                }
                names.scalars.push((if is_settled { Shape::LetForce } else { Shape::State }, name));
                return;
            }
            names.scalars.push((Shape::State, name.clone()));
            let rate = scalar(random, names, Level::Force, 2);
            self.push(format!("state {name}: rate = {rate}, start: {};", literal(random)));
        }
    }

    /// Unknowns of one's own.
    fn unknowns(&mut self, random: &mut Random, names: &mut Names) {
        if !random.chance(20) {
            return;
        }
        let (x, y) = (self.name(random, "x"), self.name(random, "y"));
        let of = |random: &mut Random, depth| scalar(random, names, Level::Force, depth);
        let factor = positive(random, names, Level::Parameter);
        let many = match random.below(5) {
            0 => {
                let lines = [of(random, 1), of(random, 2), of(random, 1)];
                let [a, b, c] = lines;
                self.push(format!(
                    "solve ({x}, {y}) from [{factor} * {x} - ({a}) * {y} == {b}, {x} + 2 * {y} == {c}];"
                ));
                true
            }
            1 => {
                let c = of(random, 1);
                self.push(format!("solve ({x}) from {factor} * {x} * {x} + {x} == powi({c}, 2) {{ {x} >= 0 }}"));
                false
            }
            2 => {
                let c = of(random, 1);
                self.push(format!("solve ({x}) from powi({x}, 2) == 1 + powi({c}, 2) {{ {x} > 0.0 }}"));
                false
            }
            _ => {
                let (b, c) = (of(random, 2), of(random, 1));
                self.push(format!("solve ({x}) from {factor} * {x} + {b} == {c};"));
                false
            }
        };
        names.scalars.push((Shape::LetForce, x));
        if many {
            names.scalars.push((Shape::LetForce, y));
        }
    }

    /// What is left out.
    fn simplified(&mut self, random: &mut Random, names: &mut Names) {
        let Some(one) = names.variable(random) else { return };
        match random.below(12) {
            0 => {
                self.push(format!("simplify {one} == {};", literal(random)));
                names.variables.retain(|name| *name != one);
            }
            1 => {
                let other = names.variable(random).filter(|other| *other != one);
                let other = other.map_or_else(String::new, |other| format!(", {other}"));
                self.push(format!("simplify small({one}{other});"));
            }
            _ => {}
        }
    }

    /// A crank that pushes a rod, solved by a formula or held by multipliers.
    fn slider(&mut self, random: &mut Random, names: &mut Names, parent: &str) {
        let [crank, link, rod] = ["b", "b", "b"].map(|stem| self.name(random, stem));
        let [turn, elbow, push, pin] = ["j", "j", "j", "j"].map(|stem| self.name(random, stem));
        let long = format!("{:.2}", random.between(0.3, 0.6));
        self.push(format!("body {crank} {{ mass: 0.2, inertia: diag(1e-3, 1e-3, 1e-3) }}"));
        self.push(format!("body {link} {{ mass: 0.1, com: 0.15 * X, inertia: rod(0.1, {long}, X) }}"));
        self.push(format!("body {rod} {{ mass: {} }}", positive(random, names, Level::Parameter)));
        self.push(format!("joint {turn}: Revolute {{ parent: {parent}, child: {crank}, axis: Z }}"));
        self.push(format!("joint {elbow}: Revolute {{ parent: {crank}.at(0.1 * X), child: {link}, axis: Z }}"));
        self.push(format!("joint {push}: Prismatic {{ parent: {parent}, child: {rod}, axis: X }}"));
        self.push("#[cut]".into());
        self.push(format!("joint {pin}: Revolute {{ parent: {link}.at({long} * X), child: {rod}, axis: Z }}"));
        let turning = [&turn, &elbow].map(|joint| format!("{joint}.angle"));
        names.coordinates.extend(turning);
        names.coordinates.push(format!("{push}.travel"));
        names.frames.extend([crank.clone(), link.clone(), rod.clone()]);
        names.bodies.push(rod);
        if random.chance(70) {
            self.push("formulation { constraints: Reduced }".into());
            self.push(format!("solve ({elbow}, {push}) from {pin} {{ {push} > 0.0 }}"));
            names.variables.push(format!("{turn}.angle"));
            names.closed.extend([format!("{elbow}.angle"), push]);
        } else {
            names.variables.extend([turn, elbow, push]);
            names.rows.extend(["x", "y"].map(|row| format!("{pin}.{row}")));
        }
    }

    /// A model that others ask.
    fn aid(&mut self, random: &mut Random) -> Aid {
        let mut names = Names::default();
        let name = self.name(random, "aid");
        self.push("/// A model that others ask.".into());
        self.push(format!("pub mod {name} {{"));
        self.values(random, &mut names, false);
        if random.chance(50) {
            self.slider(random, &mut names, "ground");
        } else {
            self.link(random, &mut names, "ground", 14);
            if random.chance(50) {
                let parent = names.bodies[0].clone();
                self.link(random, &mut names, &parent, 12);
            }
        }
        self.states(random, &mut names);
        self.lets(random, &mut names);
        self.push("}".into());
        let mut given: Vec<String> = names.variables.clone();
        given.extend(names.variables.iter().map(|variable| format!("{variable}.rate")));
        let local = names.scalars.iter().filter(|(shape, _)| matches!(shape, Shape::State));
        given.extend(local.map(|(_, name)| name.clone()));
        let settled = names.scalars.iter().filter(|(shape, _)| *shape == Shape::Input);
        given.extend(settled.map(|(_, name)| name.clone()));
        given.push("t".into());
        // A name without a value is none of an expression's.
        names.vectors.retain(|(shape, _)| *shape != Shape::Input);
        Aid { name, names, given }
    }

    /// A module with a port.
    fn part(&mut self, random: &mut Random) -> Part {
        let mut names = Names::default();
        self.push("/// A part.".into());
        self.push("mod leg {".into());
        self.push("port base: Frame;".into());
        let params = self.values(random, &mut names, true);
        self.link(random, &mut names, "base", 8);
        if random.chance(50) {
            let parent = names.bodies[0].clone();
            self.link(random, &mut names, &parent, 8);
        }
        self.states(random, &mut names);
        if random.chance(50) {
            self.force(random, &mut names);
        }
        if random.chance(50) {
            let name = self.name(random, "o");
            self.push(format!("output {name} = {};", output(random, &names)));
        }
        self.push("}".into());
        Part { names, params }
    }

    fn model(&mut self, random: &mut Random, part: Option<&Part>, aid: Option<Rc<Aid>>) {
        let mut names = Names { aid, ..Names::default() };
        self.push("/// A model.".into());
        self.push("pub mod m {".into());
        self.values(random, &mut names, false);
        if random.chance(80) {
            self.push(format!(
                "world {{ gravity: {} }}",
                random.pick(&["-9.81 * Z", "[0, -9.8, 1]", "-9.81 * [1, 2, 2] / 3"])
            ));
        }
        let bodies = 1 + random.below(3);
        for k in 0..bodies {
            let parent =
                if k == 0 || random.chance(20) { "ground".to_owned() } else { random.pick(&names.bodies).clone() };
            self.link(random, &mut names, &parent, 16);
        }
        let simple = names.coordinates.clone();
        if let Some(part) = part {
            self.use_part(random, &mut names, part);
        }
        let driven = self.held(random, &mut names, &simple);
        self.states(random, &mut names);
        self.unknowns(random, &mut names);
        self.lets(random, &mut names);
        self.simplified(random, &mut names);
        for _ in 0..random.below(3) {
            self.force(random, &mut names);
        }
        for _ in 0..random.below(4) {
            let name = self.name(random, "o");
            if random.chance(30) {
                self.push((*random.pick(&UNITS)).to_owned());
            }
            self.push(format!("output {name} = {};", output(random, &names)));
        }
        if random.chance(15) {
            let at = names.frame(random).unwrap_or_else(|| "ground".into());
            self.push(format!("assume {at}.position.z > -100;"));
        }
        let absolute = self.lines.iter().any(|line| line.starts_with("formulation { coordinates: Absolute"));
        self.emit(random, &names, driven, absolute);
        self.of_rust(random, &names);
        self.touching(random, &names);
        self.speeds(random, &names);
        self.push("}".into());
    }

    /// Wheels, blades, contacts and constraints of velocities. They come last, so that a call without one is what it would be otherwise.
    fn touching(&mut self, random: &mut Random, names: &Names) {
        if !random.chance(25) {
            return;
        }
        let name = self.name(random, "k");
        let frame = |random: &mut Random| names.frame(random).unwrap_or_else(|| "ground".into());
        let size = |random: &mut Random| positive(random, names, Level::Parameter);
        let on = match random.below(3) {
            0 => String::new(),
            1 => ", on: ground.rotated(X, 0.3)".into(),
            _ => format!(", on: {}", frame(random)),
        };
        let axis = *random.pick(&["Y", "[0.3, -2.0, 0.7]", "[1, 2, 2]"]);
        let (kind, members): (&str, &[&str]) = match random.below(6) {
            0 => ("Rolling", &["contact", "slip", "force"]),
            1 => ("Skate", &["slip", "force"]),
            2 => ("rate", &[]),
            _ => ("Contact", &["contact", "slip", "force", "power", "gap", "stored"]),
        };
        let item = match kind {
            "Rolling" => {
                let axle = if random.chance(60) { format!(", axis: {axis}") } else { String::new() };
                format!("constraint {name}: Rolling {{ wheel: {}{axle}, radius: {}{on} }}", frame(random), size(random))
            }
            "Skate" => format!("constraint {name}: Skate {{ blade: {}, along: {axis}{on} }}", frame(random)),
            "rate" => {
                let (frame, other) = (frame(random), scalar(random, names, Level::Parameter, 1));
                format!("constraint {name} = dot({frame}.velocity, {frame}.rotation * {axis}) + {other};")
            }
            _ => {
                let shape = match random.below(3) {
                    0 => on,
                    1 => format!(", axis: {axis}, radius: {}{on}", size(random)),
                    _ => format!(", radius: 0.2, ball: {}, ball_radius: {}", frame(random), size(random)),
                };
                let friction = if random.chance(50) { ", friction: 0.4" } else { "" };
                let at = frame(random);
                format!("force {name}: Contact {{ at: {at}{shape}, stiffness: 1e3, damping: 0.3{friction} }}")
            }
        };
        self.push(item);
        for member in members {
            if random.chance(30) {
                let output = self.name(random, "o");
                self.push(format!("output {output} = {name}.{member};"));
            }
        }
    }

    /// Velocities of the user's choice, as many as rates that they read or fewer. They come last, so that a call without one is what it
    /// would be otherwise.
    fn speeds(&mut self, random: &mut Random, names: &Names) {
        if !random.chance(15) {
            return;
        }
        let (Some(a), Some(b)) = (names.coordinate(random), names.coordinate(random)) else { return };
        let factor = scalar(random, names, Level::Parameter, 1);
        let first = self.name(random, "u");
        if a == b || random.chance(30) {
            self.push(format!("speed {first} = (2 + sin({a})) * {a}.rate + {factor};"));
            return;
        }
        self.push(format!("speed {first} = {a}.rate + {factor} * {b}.rate;"));
        if random.chance(80) {
            let second = self.name(random, "u");
            self.push(format!("speed {second} = (2 - cos({b})) * {b}.rate - 0.1 * {a}.rate;"));
        }
        if random.chance(50) {
            let output = self.name(random, "o");
            self.push(format!("output {output} = 2 * {first};"));
        }
    }

    /// A function of Rust in outputs and forces. It comes last, so that a call without one is what it would be otherwise.
    fn of_rust(&mut self, random: &mut Random, names: &Names) {
        if !random.chance(25) {
            return;
        }
        let name = self.name(random, "e");
        let count = 1 + random.below(3);
        self.push(format!("extern {name}({}) = crate::Curve;", ["x", "y", "z"][..count].join(", ")));
        let call = |random: &mut Random| {
            let arguments: Vec<String> = (0..count).map(|_| scalar(random, names, Level::Force, 1)).collect();
            format!("{name}({})", arguments.join(", "))
        };
        for _ in 0..=random.below(3) {
            let value = call(random);
            let item = match (random.below(4), names.coordinate(random), manipulated::variable(random, names)) {
                (0, Some(coordinate), _) => {
                    format!("force {}: Effort {{ joint: {coordinate}, value: {value} }}", self.name(random, "f"))
                }
                (1, _, Some(variable)) => format!("output {} = diff({value}, {variable});", self.name(random, "o")),
                (2, ..) => format!("output {} = {value} + {};", self.name(random, "o"), call(random)),
                _ => format!("output {} = {value};", self.name(random, "o")),
            };
            self.push(item);
        }
    }

    fn use_part(&mut self, random: &mut Random, names: &mut Names, part: &Part) {
        let name = self.name(random, "leg_");
        let parent = if names.bodies.is_empty() { "ground".into() } else { random.pick(&names.bodies).clone() };
        let set = match part.params.first() {
            Some(p) if random.chance(40) => format!(", {p}: {}", positive(random, names, Level::Parameter)),
            _ => String::new(),
        };
        if random.chance(50) {
            self.push(format!("part {name}: leg {{ base: {parent}.at(X){set} }};"));
            names.join(part.names.within(&name));
        } else {
            let count = 1 + random.below(3);
            let base = format!("{parent}.rotated(Z, {} * i)", literal(random));
            self.push(format!("part {name}: [leg; {count}] = |i| leg {{ base: {base}{set} }};"));
            for k in 0..count {
                names.join(part.names.within(&format!("{name}[{k}]")));
            }
        }
    }

    /// A drive, a constraint, or neither; whether there is one.
    fn held(&mut self, random: &mut Random, names: &mut Names, coordinates: &[String]) -> bool {
        match random.below(10) {
            0 | 1 if !coordinates.is_empty() => {
                let target = random.pick(coordinates).clone();
                self.push(format!("drive {target} = {};", scalar(random, names, Level::Time, 2)));
                names.variables.retain(|name| *name != target);
                names.closed.push(target);
                true
            }
            2 | 3 if coordinates.len() > 1 => {
                let (a, b) = (&coordinates[0], &coordinates[coordinates.len() - 1]);
                let extra = match random.below(3) {
                    0 => " + 0.1 * sin(t)",
                    1 => " - 0.2",
                    _ => "",
                };
                let factor = positive(random, names, Level::Parameter);
                self.push(format!("constraint gear: {a} - {factor} * {b}{extra};").replacen(':', " =", 1));
                if random.chance(35) {
                    self.push("formulation { constraints: Multipliers }".into());
                    names.rows.push("gear".into());
                } else {
                    if random.chance(50) {
                        self.push("formulation { constraints: Reduced }".into());
                    }
                    names.variables.retain(|name| name != a && name != b);
                    names.closed.extend([a.clone(), b.clone()]);
                }
                true
            }
            4 if coordinates.len() > 2 && names.bodies.len() > 1 => {
                let (first, last) = (&names.bodies[0], &names.bodies[names.bodies.len() - 1]);
                let between = format!("[ground.at([0.5, 0.4, 0.3]), {last}.at(0.3 * X)]");
                self.push(format!("constraint link: Rod {{ between: {between}, length: 1.2 }}"));
                if random.chance(30) {
                    self.push(format!("output reach = norm({first}.position);"));
                }
                names.rows.push("link".into());
                true
            }
            5 => {
                let said = *random.pick(&[
                    "coordinates: Absolute(RollPitchYaw)",
                    "coordinates: Absolute(Quaternion)",
                    "constraints: Reduced",
                    "constraints: Stabilised, rate: 10, position: 25",
                ]);
                self.push(format!("formulation {{ {said} }}"));
                if said.ends_with("(RollPitchYaw)") {
                    let of = |body: &String| ["x", "z", "pitch"].map(|name| format!("{body}.{name}"));
                    names.variables = names.bodies.iter().flat_map(of).collect();
                } else if said.contains("Absolute") {
                    names.variables.clear();
                }
                true
            }
            6 if random.chance(30) => {
                // A rotation that a joint follows.
                let body = self.name(random, "b");
                self.push(format!("body {body} {{ mass: 1, inertia: diag(0.1, 0.2, 0.25) }}"));
                let joint = self.name(random, "j");
                self.push(format!("joint {joint}: Ball {{ parent: ground, child: {body} }}"));
                self.push(format!("drive {joint}.orientation = {};", rotation(random, names, Level::Time)));
                true
            }
            7 => {
                let parent = names.frame(random).unwrap_or_else(|| "ground".into());
                self.slider(random, names, &parent);
                true
            }
            _ => false,
        }
    }

    fn emit(&mut self, random: &mut Random, names: &Names, held: bool, absolute: bool) {
        let all = [
            "forward_dynamics",
            "inverse_dynamics",
            "mass_matrix",
            "bias",
            "energy",
            "constraints",
            "derivatives",
            "residual",
            "impulse",
            "momentum",
            "linearize",
            "report",
            "equations",
        ];
        let chance = *random.pick(&[10, 30, 60]);
        let mut words: Vec<String> = Vec::new();
        for word in all {
            // Momenta have conditions of their own, which refusals would fill with.
            let void = word == "constraints" && !absolute && names.rows.is_empty();
            if random.chance(chance) && !void && !(word == "momentum" && (held || random.chance(60))) {
                words.push(word.into());
            }
        }
        if random.chance(8)
            && let Some(input) = names.scalar(random, Shape::Input)
        {
            words.retain(|word| word != "inverse_dynamics");
            words.push(format!("inverse_dynamics {{ solve_for: {input} }}"));
        }
        if words.is_empty() {
            return;
        }
        let mut line = String::new();
        write!(line, "emit {};", words.join(", ")).expect("text is always written");
        self.push(line);
    }
}
