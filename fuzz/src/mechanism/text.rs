//! A mechanism in the language.

use std::fmt::Write;

use super::{Coupling, Drive, FLOW, Force, Frame, Held, Inertia, Kind, Load, Mechanism, Step, Term};

impl Frame {
    /// In the language.
    pub fn text(&self) -> String {
        let mut text = self.body.map_or_else(|| "ground".to_owned(), |body| format!("b{body}"));
        for step in &self.steps {
            text += &match step {
                Step::At(v) => format!(".at({})", v.text()),
                Step::Rotated(axis, angle) => format!(".rotated({}, {})", axis.text(), angle.text()),
                Step::Oriented(rows) => {
                    let rows = rows.each_ref().map(|row| format!("[{}]", row.each_ref().map(|e| e.text()).join(", ")));
                    format!(".oriented([{}])", rows.join(", "))
                }
            };
        }
        text
    }
}

impl Mechanism {
    /// A call of the macro with this model alone, `m`.
    pub fn text(&self) -> String {
        let mut out = "pub mod m {\n".to_owned();
        self.write(&mut out).expect("text is always written");
        out + "}\n"
    }

    fn write(&self, out: &mut String) -> std::fmt::Result {
        for (k, default) in self.params.iter().enumerate() {
            writeln!(out, "    param p{k} = {};", default.text())?;
        }
        for k in 0..self.inputs {
            writeln!(out, "    input u{k};")?;
        }
        for (k, start) in self.states.iter().enumerate() {
            writeln!(out, "    state s{k}: rate = {FLOW:?} * s{k}, start: {};", start.text())?;
        }
        if let Some(gravity) = &self.gravity {
            writeln!(out, "    world {{ gravity: {} }}", gravity.text())?;
        }
        for (k, body) in self.bodies.iter().enumerate() {
            let mass = body.mass.text();
            let inertia = match &body.inertia {
                Inertia::Point => String::new(),
                Inertia::Diagonal(list) => format!(", inertia: diag({})", list.each_ref().map(|e| e.text()).join(", ")),
                Inertia::Full(list) => format!(", inertia: inertia({})", list.each_ref().map(|e| e.text()).join(", ")),
                Inertia::Rod(length, axis) => format!(", inertia: rod({mass}, {}, {})", length.text(), axis.text()),
                Inertia::Cuboid(size) => format!(", inertia: cuboid({mass}, {})", size.text()),
                Inertia::Cylinder(radius, length, axis) => {
                    format!(", inertia: cylinder({mass}, {}, {}, {})", radius.text(), length.text(), axis.text())
                }
                Inertia::Sphere(radius) => format!(", inertia: sphere({mass}, {})", radius.text()),
            };
            writeln!(out, "    body b{k} {{ mass: {mass}, com: {}{inertia} }}", body.com.text())?;
        }
        for (k, joint) in self.joints.iter().enumerate() {
            if k >= self.bodies.len() {
                writeln!(out, "    #[cut]")?;
            }
            let (name, fields) = joint.kind.text();
            let armature = joint.armature.as_ref().map_or_else(String::new, |e| format!(", armature: {}", e.text()));
            let (parent, child) = (joint.parent.text(), joint.child.text());
            writeln!(out, "    joint j{k}: {name} {{ parent: {parent}, child: {child}{fields}{armature} }}")?;
        }
        for (k, rod) in self.rods.iter().enumerate() {
            let [a, b] = rod.between.each_ref().map(Frame::text);
            writeln!(out, "    constraint r{k}: Rod {{ between: [{a}, {b}], length: {} }}", rod.length.text())?;
        }
        for (k, held) in self.held.iter().enumerate() {
            writeln!(out, "    constraint h{k}{}", self.held(held))?;
        }
        for (k, coupling) in self.couplings.iter().enumerate() {
            writeln!(out, "    constraint c{k} = {};", self.coupling(coupling))?;
        }
        for Drive { of, centre, speed, size, pace } in &self.drives {
            let name = self.coordinate(*of);
            writeln!(out, "    drive {name} = {centre:?} + {speed:?} * t + {size:?} * sin({pace:?} * t);")?;
        }
        for (k, factors) in self.speeds.iter().enumerate() {
            let rates = self.rates();
            let terms = factors.iter().zip(rates).map(|(factor, rate)| format!("({factor:?} * {rate})"));
            writeln!(out, "    speed w{k} = {};", terms.collect::<Vec<_>>().join(" + "))?;
        }
        for (k, force) in self.forces.iter().enumerate() {
            writeln!(out, "    force f{k}: {}", self.force(force))?;
        }
        if self.outputs {
            for k in 0..self.bodies.len() {
                writeln!(out, "    output place{k} = b{k}.position;")?;
                writeln!(out, "    output turn{k} = b{k}.rotation;")?;
                writeln!(out, "    output twist{k} = b{k}.twist;")?;
                writeln!(out, "    output accel{k} = b{k}.acceleration;")?;
                writeln!(out, "    output alpha{k} = b{k}.angular_acceleration;")?;
                writeln!(out, "    output jacobian{k} = b{k}.jacobian;")?;
            }
            for k in self.read_joints() {
                writeln!(out, "    output reaction{k} = j{k}.reaction;")?;
            }
        }
        if self.contacts {
            for (k, held) in self.held.iter().enumerate() {
                match held {
                    Held::Ball { .. } | Held::Disc { .. } => {
                        writeln!(out, "    output contact{k} = h{k}.contact;\n    output slip{k} = h{k}.slip;")?;
                    }
                    Held::Blade { .. } => writeln!(out, "    output slip{k} = h{k}.slip;")?,
                    Held::Rates { .. } => {}
                }
            }
        }
        for (k, load) in self.loads.iter().enumerate() {
            let read = match load {
                Load::Force(held) => format!("h{held}.force"),
                Load::Row(held, row) => format!("h{held}{}.multiplier", self.held[*held].rows()[*row]),
                Load::Rod(rod) => format!("r{rod}.multiplier"),
                Load::Coupling(coupling) => format!("c{coupling}.multiplier"),
                Load::Drive(drive) => format!("{}.effort", self.coordinate(self.drives[*drive].of)),
            };
            writeln!(out, "    output load{k} = {read};")?;
        }
        out.push_str(&self.tail);
        if self.packs {
            writeln!(out, "    formulation {{ packs: Four }}")?;
        }
        if !self.emit.is_empty() {
            writeln!(out, "    emit {};", self.emit.join(", "))?;
        }
        if !self.at.is_empty() {
            writeln!(out, "    emit at {{ functions: [{}] }};", self.at.join(", "))?;
        }
        Ok(())
    }

    /// A coordinate that is a number.
    fn coordinate(&self, (joint, component): (usize, usize)) -> String {
        format!("j{joint}.{}", self.joints[joint].kind.names()[component])
    }

    /// Rates of all coordinates, where all are numbers.
    fn rates(&self) -> Vec<String> {
        let of = |joint: usize| (0..self.joints[joint].kind.freedoms()).map(move |component| (joint, component));
        (0..self.bodies.len()).flat_map(of).map(|at| format!("{}.rate", self.coordinate(at))).collect()
    }

    fn held(&self, held: &Held) -> String {
        match held {
            Held::Ball { wheel, radius, on } => {
                format!(": Rolling {{ wheel: {}, radius: {}, on: {} }}", wheel.text(), radius.text(), on.text())
            }
            Held::Disc { wheel, axis, radius, on } => {
                let (wheel, axis, radius, on) = (wheel.text(), axis.text(), radius.text(), on.text());
                format!(": Rolling {{ wheel: {wheel}, axis: {axis}, radius: {radius}, on: {on} }}")
            }
            Held::Blade { blade, along, on } => {
                format!(": Skate {{ blade: {}, along: {}, on: {} }}", blade.text(), along.text(), on.text())
            }
            Held::Rates { terms, drift } => {
                let term = |Term { rate, factor, wave, of }: &Term| {
                    let (rate, of) = (self.coordinate(*rate), self.coordinate(*of));
                    format!("({factor:?} + {wave:?} * sin({of})) * {rate}.rate + ")
                };
                format!(" = {}{drift:?} * sin(t);", terms.iter().map(term).collect::<String>())
            }
        }
    }

    fn coupling(&self, of: &Coupling) -> String {
        let mut sum = Vec::new();
        for &(at, factor, wave) in &of.terms {
            let name = self.coordinate(at);
            sum.push(format!("{factor:?} * {name}"));
            if wave != 0.0 {
                sum.push(format!("{wave:?} * sin({name})"));
            }
        }
        if let Some((one, other, factor)) = of.product {
            sum.push(format!("{factor:?} * {} * {}", self.coordinate(one), self.coordinate(other)));
        }
        if of.drift != 0.0 {
            sum.push(format!("{:?} * sin(t)", of.drift));
        }
        format!("{} + {:?}", sum.join(" + "), of.offset)
    }

    fn force(&self, force: &Force) -> String {
        let target = |joint: usize, component: Option<usize>| {
            let names = self.joints[joint].kind.names();
            match component {
                Some(k) if self.joints[joint].kind.freedoms() > 1 => format!("j{joint}.{}", names[k]),
                _ => format!("j{joint}"),
            }
        };
        let field = |name: &str, value: &Option<super::Expr>| {
            value.as_ref().map_or_else(String::new, |e| format!(", {name}: {}", e.text()))
        };
        let kind = |stiff: bool, damped: bool| match (stiff, damped) {
            (true, true) => "SpringDamper",
            (false, _) => "Damper",
            _ => "Spring",
        };
        match force {
            Force::Effort { joint, component, values } => {
                let values: Vec<String> = values.iter().map(super::Expr::text).collect();
                let value = if values.len() == 1 { values[0].clone() } else { format!("[{}]", values.join(", ")) };
                format!("Effort {{ joint: {}, value: {value} }}", target(*joint, *component))
            }
            Force::JointSpring { joint, component, stiffness, damping, rest } => format!(
                "{} {{ joint: {}{}{}{} }}",
                kind(stiffness.is_some(), damping.is_some()),
                target(*joint, Some(*component)),
                field("stiffness", stiffness),
                field("damping", damping),
                field("rest", rest)
            ),
            Force::LineSpring { between: [a, b], stiffness, damping, length } => format!(
                "{} {{ between: [{}, {}]{}{}{} }}",
                kind(stiffness.is_some(), damping.is_some()),
                a.text(),
                b.text(),
                field("stiffness", stiffness),
                field("damping", damping),
                field("length", length)
            ),
            Force::Wrench { torque, at, value, axes } => format!(
                "{} {{ at: {}, value: {}, axes: {} }}",
                if *torque { "Torque" } else { "Force" },
                at.text(),
                value.text(),
                axes.text()
            ),
        }
    }
}

impl Kind {
    /// Its name, and its fields with a comma in front.
    pub fn text(&self) -> (&'static str, String) {
        let angles = |yes: bool| if yes { ", coordinates: RollPitchYaw".to_owned() } else { String::new() };
        let axis = |v: &super::Vector| format!(", axis: {}", v.text());
        match self {
            Kind::Fixed => ("Fixed", String::new()),
            Kind::Revolute(v) => ("Revolute", axis(v)),
            Kind::Prismatic(v) => ("Prismatic", axis(v)),
            Kind::Screw(v, pitch) => ("Screw", format!("{}, pitch: {}", axis(v), pitch.text())),
            Kind::Cylindrical(v) => ("Cylindrical", axis(v)),
            Kind::Universal(a, b) => ("Universal", format!(", axes: [{}, {}]", a.text(), b.text())),
            Kind::Planar(k, minus) => {
                ("Planar", format!(", axis: {}{}", if *minus { "-" } else { "" }, ["X", "Y", "Z"][*k]))
            }
            Kind::PinSlot(a, b) => ("PinSlot", format!(", axis: {}, slide: {}", a.text(), b.text())),
            Kind::PlanarAlong(a, b) => ("Planar", format!(", axes: [{}, {}]", a.text(), b.text())),
            Kind::Ball(yes) => ("Ball", angles(*yes)),
            Kind::Free(yes) => ("Free", angles(*yes)),
        }
    }
}
