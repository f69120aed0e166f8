//! A mechanism with loops on a body that moves: what stands on the ground otherwise, so that its loops are closed away from it.

use super::expression::Expr;
use super::{Force, Frame, Held, Kind, Mechanism};
use crate::random::Random;

impl Mechanism {
    /// Puts a body on a joint of its own between the ground and all joints and rods. Forces are held by the ground as before. Nothing that is
    /// drawn comes later, so that a mechanism without one is what it would be otherwise.
    pub(super) fn carry(&mut self, random: &mut Random) {
        let (a, b) = super::numbers::perpendicular(random);
        let kind = match random.below(7) {
            0 | 1 => Kind::Free(false),
            2 => Kind::Free(true),
            3 => Kind::Planar(random.below(3), random.chance(50)),
            4 => Kind::Universal(a, b),
            5 => Kind::Prismatic(a),
            _ => Kind::Revolute(a),
        };
        let mut below = Mechanism { params: self.params.clone(), ..Mechanism::default() };
        below.hang(random, kind);
        self.shift();
        self.bodies.splice(0..0, below.bodies);
        self.joints.splice(0..0, below.joints);
        if !self.closed.is_empty() {
            let kind = &self.joints[0].kind;
            let mut rest = vec![0.0; kind.coordinates()];
            if let Some(quaternion) = kind.quaternion() {
                rest[quaternion] = 1.0;
            }
            self.closed.insert(0, rest);
        }
        self.carried = true;
    }

    /// Every number of a body or joint is one more, and what joints and rods stand on is the first body.
    fn shift(&mut self) {
        let carries = |frame: &mut Frame| frame.body = Some(frame.body.map_or(0, |body| body + 1));
        let moves = |frame: &mut Frame| frame.body = frame.body.map(|body| body + 1);
        for joint in &mut self.joints {
            carries(&mut joint.parent);
            carries(&mut joint.child);
        }
        self.rods.iter_mut().flat_map(|rod| &mut rod.between).for_each(carries);
        for held in &mut self.held {
            held.frames_mut().into_iter().flatten().for_each(carries);
            if let Held::Rates { terms, .. } = held {
                for term in terms {
                    term.rate.0 += 1;
                    term.of.0 += 1;
                }
            }
        }
        for force in &mut self.forces {
            match force {
                Force::Effort { joint, .. } | Force::JointSpring { joint, .. } => *joint += 1,
                Force::LineSpring { between, .. } => between.iter_mut().for_each(moves),
                Force::Wrench { at, axes, .. } => [at, axes].into_iter().for_each(moves),
            }
        }
        for coupling in &mut self.couplings {
            coupling.terms.iter_mut().for_each(|term| term.0.0 += 1);
            coupling.product.iter_mut().for_each(|(a, b, _)| (a.0, b.0) = (a.0 + 1, b.0 + 1));
        }
        self.drives.iter_mut().for_each(|drive| drive.of.0 += 1);
        self.expressions(&mut |e| {
            if let Expr::Position(joint, ..) | Expr::Rate(joint, ..) = e {
                *joint += 1;
            }
        });
        self.tail = with_later_joints(&self.tail);
    }
}

/// Items with `j1` for `j0`, and so on.
fn with_later_joints(items: &str) -> String {
    let mut shifted = String::with_capacity(items.len());
    let mut before = ' ';
    let mut rest = items.chars().peekable();
    while let Some(character) = rest.next() {
        shifted.push(character);
        if character == 'j' && !before.is_alphanumeric() {
            let mut number = String::new();
            while let Some(digit) = rest.next_if(char::is_ascii_digit) {
                number.push(digit);
            }
            shifted += &number.parse().map_or(number, |number: usize| (number + 1).to_string());
        }
        before = character;
    }
    shifted
}
