//! Simpler mechanisms: one thing less, or one thing made plain.

use super::{Expr, Force, Frame, Held, Inertia, Kind, Load, Mechanism, Vector};

fn plain(e: &Expr, to: f64) -> Option<Expr> {
    let text = format!("{to}");
    (e.text() != text).then_some(Expr::Number(text, to))
}

fn unit() -> Vector {
    Vector::Whole("Z".into(), [0.0, 0.0, 1.0])
}

impl Mechanism {
    /// All mechanisms that are a little simpler, the boldest first.
    pub fn simpler(&self) -> Vec<Mechanism> {
        let mut list = Vec::new();
        let mut offer = |change: &dyn Fn(&mut Mechanism) -> bool| {
            let mut other = self.clone();
            if change(&mut other) {
                list.push(other);
            }
        };
        for body in (0..self.bodies.len()).rev() {
            offer(&|m| m.remove(body));
        }
        for k in (self.bodies.len()..self.joints.len()).rev() {
            offer(&|m| {
                m.joints.remove(k);
                true
            });
        }
        for k in (0..self.rods.len()).rev() {
            offer(&|m| {
                m.rods.remove(k);
                m.unload(
                    |load| match load {
                        Load::Rod(at) => Some((*at, at)),
                        _ => None,
                    },
                    k,
                );
                true
            });
        }
        for k in (0..self.held.len()).rev() {
            offer(&|m| {
                m.held.remove(k);
                m.unload(
                    |load| match load {
                        Load::Force(at) | Load::Row(at, _) => Some((*at, at)),
                        _ => None,
                    },
                    k,
                );
                m.speeds.is_empty()
            });
        }
        for k in (0..self.couplings.len()).rev() {
            offer(&|m| {
                m.couplings.remove(k);
                m.unload(
                    |load| match load {
                        Load::Coupling(at) => Some((*at, at)),
                        _ => None,
                    },
                    k,
                );
                m.speeds.is_empty()
            });
        }
        for k in (0..self.drives.len()).rev() {
            offer(&|m| {
                m.drives.remove(k);
                m.unload(
                    |load| match load {
                        Load::Drive(at) => Some((*at, at)),
                        _ => None,
                    },
                    k,
                );
                m.speeds.is_empty()
            });
        }
        for k in (0..self.loads.len()).rev() {
            offer(&|m| {
                m.loads.remove(k);
                true
            });
        }
        offer(&|m| std::mem::take(&mut m.contacts));
        offer(&|m| !std::mem::take(&mut m.speeds).is_empty());
        for k in (0..self.forces.len()).rev() {
            offer(&|m| {
                m.forces.remove(k);
                true
            });
        }
        for k in 0..self.at.len() {
            offer(&|m| {
                m.at.remove(k);
                true
            });
        }
        offer(&|m| std::mem::take(&mut m.packs));
        for k in 0..self.emit.len() {
            offer(&|m| {
                m.emit.remove(k);
                !m.emit.is_empty()
            });
        }
        offer(&|m| std::mem::take(&mut m.outputs));
        offer(&|m| m.gravity.take().is_some());
        offer(&|m| {
            let mut read = 0;
            m.expressions(&mut |e| {
                if let Expr::Input(k) = e {
                    read = read.max(*k + 1);
                }
            });
            std::mem::replace(&mut m.inputs, read) != read
        });
        for k in 0..self.params.len() {
            offer(&|m| m.bind(k));
        }
        for k in 0..self.states.len() {
            offer(&|m| m.keep(k));
        }
        for k in 0..self.bodies.len() {
            offer(&|m| {
                let fresh = Inertia::Diagonal([0.1, 0.1, 0.1].map(Expr::literal));
                let same = matches!(&m.bodies[k].inertia, Inertia::Diagonal(d) if d.iter().all(|e| e.text() == "0.1"));
                m.bodies[k].inertia = fresh;
                !same
            });
            offer(&|m| replace(&mut m.bodies[k].com, &Vector::Whole("0 * X".into(), [0.0; 3])));
            offer(&|m| {
                replace(&mut m.bodies[k].com, &Vector::Whole("X".into(), [1.0, 0.0, 0.0]))
                    && !self.bodies[k].com.text().starts_with('0')
            });
            offer(&|m| plain(&m.bodies[k].mass, 1.0).map(|e| m.bodies[k].mass = e).is_some());
        }
        for k in 0..self.joints.len() {
            offer(&|m| m.joints[k].armature.take().is_some());
            if self.joints[k].kind.freedoms() > 1 && !self.used(k) && k < self.bodies.len() {
                offer(&|m| {
                    m.joints[k].kind = Kind::Revolute(unit());
                    !self.looped()
                });
            }
            offer(&|m| match &mut m.joints[k].kind {
                Kind::Revolute(axis) | Kind::Prismatic(axis) | Kind::Screw(axis, _) | Kind::Cylindrical(axis) => {
                    replace(axis, &unit())
                }
                _ => false,
            });
        }
        let frames = self.clone().frames().len();
        for k in 0..frames {
            let steps = self.clone().frames()[k].steps.len();
            for step in (0..steps).rev() {
                offer(&|m| {
                    m.frames()[k].steps.remove(step);
                    true
                });
            }
        }
        list
    }

    /// Every frame of it.
    fn frames(&mut self) -> Vec<&mut Frame> {
        let mut list = Vec::new();
        for joint in &mut self.joints {
            list.extend([&mut joint.parent, &mut joint.child]);
        }
        for rod in &mut self.rods {
            list.extend(&mut rod.between);
        }
        list.extend(self.held.iter_mut().filter_map(Held::frames_mut).flatten());
        for force in &mut self.forces {
            match force {
                Force::LineSpring { between, .. } => list.extend(between),
                Force::Wrench { at, axes, .. } => list.extend([at, axes]),
                _ => {}
            }
        }
        list
    }

    /// Every expression that stands for itself.
    pub(super) fn expressions(&mut self, f: &mut dyn FnMut(&mut Expr)) {
        for body in &mut self.bodies {
            body.mass.visit(f);
            body.com.visit(f);
            match &mut body.inertia {
                Inertia::Point => {}
                Inertia::Diagonal(list) => list.iter_mut().for_each(|e| e.visit(f)),
                Inertia::Full(list) => list.iter_mut().for_each(|e| e.visit(f)),
                Inertia::Rod(a, v) => {
                    a.visit(f);
                    v.visit(f);
                }
                Inertia::Cuboid(v) => v.visit(f),
                Inertia::Cylinder(a, b, v) => {
                    a.visit(f);
                    b.visit(f);
                    v.visit(f);
                }
                Inertia::Sphere(a) => a.visit(f),
            }
        }
        for joint in &mut self.joints {
            joint.armature.iter_mut().for_each(|e| e.visit(f));
            match &mut joint.kind {
                Kind::Revolute(v) | Kind::Prismatic(v) | Kind::Cylindrical(v) => v.visit(f),
                Kind::Screw(v, e) => {
                    v.visit(f);
                    e.visit(f);
                }
                _ => {}
            }
        }
        for rod in &mut self.rods {
            rod.length.visit(f);
        }
        for held in &mut self.held {
            match held {
                Held::Ball { radius, .. } => radius.visit(f),
                Held::Disc { axis, radius, .. } => {
                    axis.visit(f);
                    radius.visit(f);
                }
                Held::Blade { along, .. } => along.visit(f),
                Held::Rates { .. } => {}
            }
        }
        for force in &mut self.forces {
            match force {
                Force::Effort { values, .. } => values.iter_mut().for_each(|e| e.visit(f)),
                Force::JointSpring { stiffness, damping, rest, .. } => {
                    [stiffness, damping, rest].into_iter().flatten().for_each(|e| e.visit(f));
                }
                Force::LineSpring { stiffness, damping, length, .. } => {
                    [stiffness, damping, length].into_iter().flatten().for_each(|e| e.visit(f));
                }
                Force::Wrench { value, .. } => value.visit(f),
            }
        }
        for frame in self.frames() {
            for step in &mut frame.steps {
                match step {
                    super::Step::At(v) => v.visit(f),
                    super::Step::Rotated(v, e) => {
                        v.visit(f);
                        e.visit(f);
                    }
                    super::Step::Oriented(rows) => rows.iter_mut().flatten().for_each(|e| e.visit(f)),
                }
            }
        }
    }

    /// Takes out the outputs that read what has had a number, and moves the numbers behind it.
    fn unload(&mut self, number: impl Fn(&mut Load) -> Option<(usize, &mut usize)>, gone: usize) {
        self.loads.retain_mut(|load| match number(load) {
            Some((at, _)) if at == gone => false,
            Some((at, place)) => {
                *place = at - usize::from(at > gone);
                true
            }
            None => true,
        });
    }

    /// A parameter becomes its default everywhere.
    fn bind(&mut self, k: usize) -> bool {
        let default = self.params.remove(k);
        self.expressions(&mut |e| match e {
            Expr::Param(i) if *i == k => *e = default.clone(),
            Expr::Param(i) if *i > k => *i -= 1,
            _ => {}
        });
        true
    }

    /// A state becomes the number at which it starts.
    fn keep(&mut self, k: usize) -> bool {
        let start = self.states.remove(k);
        self.expressions(&mut |e| match e {
            Expr::State(i) if *i == k => *e = start.clone(),
            Expr::State(i) if *i > k => *i -= 1,
            _ => {}
        });
        true
    }

    /// Whether a force or an expression names a joint.
    fn used(&self, joint: usize) -> bool {
        let mut found = false;
        self.clone().expressions(&mut |e| {
            found |= matches!(e, Expr::Position(j, ..) | Expr::Rate(j, ..) if *j == joint);
        });
        found
            || !self.speeds.is_empty()
            || self.couplings.iter().any(|coupling| coupling.coordinates().any(|at| at.0 == joint))
            || self.drives.iter().any(|drive| drive.of.0 == joint)
            || self.held.iter().any(|held| match held {
                Held::Rates { terms, .. } => terms.iter().any(|term| term.rate.0 == joint || term.of.0 == joint),
                _ => false,
            })
            || self.forces.iter().any(|force| {
                matches!(force, Force::Effort { joint: j, .. } | Force::JointSpring { joint: j, .. } if *j == joint)
            })
    }

    /// Takes a body out on which none hangs, and everything that stands on it.
    fn remove(&mut self, body: usize) -> bool {
        let hangs = |frame: &Frame| frame.body == Some(body);
        // Equations of coordinates and velocities and speeds name joints by number.
        let is_named = self.held.iter().any(|held| match held {
            Held::Rates { terms, .. } => terms.iter().any(|term| term.rate.0.max(term.of.0) >= body),
            _ => held.frames().is_some_and(|frames| frames.into_iter().any(hangs)),
        });
        let is_named = is_named
            || self.couplings.iter().any(|coupling| coupling.coordinates().any(|at| at.0 >= body))
            || self.drives.iter().any(|drive| drive.of.0 >= body);
        if is_named || !self.speeds.is_empty() {
            return false;
        }
        if self.bodies.len() < 2 || self.joints.iter().any(|joint| hangs(&joint.parent)) {
            return false;
        }
        let cut = self.joints[self.bodies.len()..].iter().any(|joint| hangs(&joint.child));
        if cut || self.rods.iter().any(|rod| rod.between.iter().any(hangs)) {
            return false;
        }
        self.forces.retain(|force| match force {
            Force::Effort { joint, .. } | Force::JointSpring { joint, .. } => *joint != body,
            Force::LineSpring { between, .. } => !between.iter().any(hangs),
            Force::Wrench { at, axes, .. } => !hangs(at) && !hangs(axes),
        });
        let mut hit = false;
        self.expressions(&mut |e| hit |= matches!(e, Expr::Position(j, ..) | Expr::Rate(j, ..) if *j == body));
        if hit && (self.joints[body].kind.freedoms() > 0 || self.used(body)) {
            return false;
        }
        self.bodies.remove(body);
        self.joints.remove(body);
        if body < self.closed.len() {
            self.closed.remove(body);
        }
        for frame in self.frames() {
            if let Some(b) = &mut frame.body {
                *b -= usize::from(*b > body);
            }
        }
        for force in &mut self.forces {
            if let Force::Effort { joint, .. } | Force::JointSpring { joint, .. } = force {
                *joint -= usize::from(*joint > body);
            }
        }
        self.expressions(&mut |e| {
            if let Expr::Position(j, ..) | Expr::Rate(j, ..) = e {
                *j -= usize::from(*j > body);
            }
        });
        true
    }
}

fn replace(vector: &mut Vector, by: &Vector) -> bool {
    let other = vector.text() != by.text();
    *vector = by.clone();
    other
}

/// The simplest mechanism that still fails, by greedy steps of which at most so many are tried.
pub fn minimise(start: Mechanism, tries: usize, fails: &dyn Fn(&Mechanism) -> bool) -> Mechanism {
    let (mut best, mut left) = (start, tries);
    'search: loop {
        for other in best.simpler() {
            if left == 0 {
                break 'search;
            }
            left -= 1;
            if fails(&other) {
                best = other;
                continue 'search;
            }
        }
        break;
    }
    best
}
