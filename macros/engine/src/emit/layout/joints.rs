//! Stage `emit`: the leaves that joints have in `Position` and `Velocity`: only coordinates of the state stand there.
//!
//! In: a joint and which of its coordinates are in the state. Out: its [`Piece`]s. A joint that is whole has one leaf of
//! its own type. A body that moves freely may have only its position or only its orientation there; of other joints that
//! drives or loops take a part of, every coordinate left is a field.

use proc_macro2::Ident;

use crate::emit::{document, names};
use crate::model::joint_kinds::{self, JointKind};
use crate::model::types::{Coordinate, Joint, JointId, Model, Place};

use super::leaf::Leaf;

/// A leaf made of neighbouring coordinates of a joint.
pub(super) struct Piece {
    /// What the field's name has behind the joint's; nothing where the joint's own name says it.
    suffix: Option<&'static str>,
    pub(in crate::emit) position: Leaf,
    pub(in crate::emit) velocity: Leaf,
    /// Number of the first component in the joint's position, and in its velocity.
    first: [usize; 2],
}

impl Piece {
    /// Of a speed of the user's choice.
    pub(super) fn of_speed() -> Piece {
        Piece { suffix: None, position: Leaf::Scalar, velocity: Leaf::Scalar, first: [0, 0] }
    }

    /// Number of this component of the joint within the leaf.
    pub(in crate::emit) fn component(&self, is_velocity: bool, component: usize) -> Option<usize> {
        let [position, velocity] = self.first;
        let (first, leaf) = if is_velocity { (velocity, &self.velocity) } else { (position, &self.position) };
        component.checked_sub(first).filter(|within| *within < leaf.size())
    }

    /// Whether it is less than the joint.
    pub(super) fn is_partial(&self, kind: &JointKind) -> bool {
        self.velocity.size() < kind.freedoms()
    }

    /// Documentation of the leaf in `Position` and in `Velocity`.
    pub(in crate::emit) fn docs(&self, joint: &Joint) -> [Vec<String>; 2] {
        if !self.is_partial(joint.kind) {
            return [document::position(joint), document::velocity(joint)];
        }
        let is_straight = joint.kind.is_slide(self.first[1]);
        let what = match (self.suffix, &self.velocity) {
            (Some(suffix), _) => suffix,
            (None, _) if is_straight => "position",
            (None, _) => "orientation",
        };
        document::piece(joint, what, if is_straight { "m" } else { "rad" })
    }

    /// Unit of all scalars of the leaf in `Position` and in `Velocity`; structs of the runtime have units of their own, and
    /// quaternions none.
    pub(in crate::emit) fn units(&self, joint: &Joint) -> [Option<String>; 2] {
        let natural = if joint.kind.is_slide(self.first[1]) { "m" } else { "rad" };
        let declared = joint.docs.unit.as_deref().filter(|_| !self.is_partial(joint.kind));
        let unit = declared.unwrap_or(natural);
        let uniform = |leaf: &Leaf| matches!(leaf, Leaf::Scalar | Leaf::Vec3);
        let position = uniform(&self.position).then(|| unit.to_owned());
        let rate = if self.position == Leaf::Quaternion { natural } else { unit };
        [position, uniform(&self.velocity).then(|| format!("{rate}/s"))]
    }
}

/// The leaves of a joint's velocity with these coordinates among the velocities: as those of a joint of which these are in the state,
/// but that of a rotation single angular velocities may be there.
pub(super) fn velocity_pieces(kind: &'static JointKind, held: &[bool]) -> Vec<Piece> {
    let turning = held.get(kind.turning()).unwrap_or(&[]);
    if !kind.has_quaternion() || turning.iter().all(|held| *held == turning[0]) {
        return pieces(kind, held);
    }
    let straight = kind.freedoms.iter().map(|freedom| freedom.name);
    let names = straight.chain(["angular_x", "angular_y", "angular_z"]).enumerate();
    let scalars = names.filter(|(index, _)| held.get(*index) == Some(&true)).map(|(index, name)| Piece {
        suffix: Some(name),
        position: Leaf::Scalar,
        velocity: Leaf::Scalar,
        first: [index, index],
    });
    scalars.collect()
}

/// Names of a joint's velocity coordinates; a rotation by quaternions has none for single ones.
fn coordinates(kind: &JointKind) -> Vec<&'static str> {
    let orientation = kind.has_quaternion().then_some("orientation");
    kind.freedoms.iter().map(|freedom| freedom.name).chain(orientation).collect()
}

/// The leaves of a joint with these coordinates in the state. A quaternion stays whole.
pub(super) fn pieces(kind: &'static JointKind, held: &[bool]) -> Vec<Piece> {
    let whole = Leaf::position(kind).zip(Leaf::velocity(kind));
    let Some((position, velocity)) = whole.filter(|_| held.contains(&true)) else {
        return Vec::new();
    };
    if !held.contains(&false) {
        return vec![Piece { suffix: None, position, velocity, first: [0, 0] }];
    }
    if kind.is_free()
        && let Some(orientation) = kind.orientation
        && let Some(ball) = joint_kinds::BALL.oriented(orientation)
        && let Some((straight, turning)) = held.split_at_checked(3)
    {
        match (straight, turning) {
            ([true, true, true], [false, false, false]) => {
                return vec![Piece { suffix: None, position: Leaf::Vec3, velocity: Leaf::Vec3, first: [0, 0] }];
            }
            ([false, false, false], [true, true, true]) => {
                let leaves = Leaf::position(ball).zip(Leaf::velocity(ball));
                let piece = |(position, velocity)| Piece { suffix: None, position, velocity, first: [3, 3] };
                return leaves.map(piece).into_iter().collect();
            }
            _ => {}
        }
    }
    let names = coordinates(kind).into_iter().enumerate();
    let pieces = names.filter(|(index, _)| held.get(*index) == Some(&true)).map(|(index, name)| {
        let (position, velocity) = match name {
            "orientation" => (Leaf::Quaternion, Leaf::Vec3),
            _ => (Leaf::Scalar, Leaf::Scalar),
        };
        Piece { suffix: Some(name), position, velocity, first: [index, index] }
    });
    pieces.collect()
}

/// Which coordinates of a joint are among these.
pub(in crate::emit) fn held(model: &Model, coordinates: &[Coordinate], joint: JointId) -> Vec<bool> {
    let freedoms = model.joints[joint].kind.freedoms();
    let mut held = vec![false; freedoms];
    for coordinate in coordinates.iter().filter(|coordinate| coordinate.joint == joint) {
        if let Some(place) = held.get_mut(coordinate.index) {
            *place = true;
        }
    }
    held
}

/// The field of a joint's piece. Fields of one name in one part have one type, in whatever instance they stand: where
/// another instance has more of the joint than this one, the name says what is left.
pub(super) fn field(model: &Model, coordinates: &[Coordinate], id: JointId, joint: &Joint, piece: &Piece) -> Ident {
    let part = |joint: &Joint| model.instances.get(joint.place.instance.0).and_then(|instance| instance.part_type);
    let is_beside = |other: &&Joint| part(other) == part(joint);
    let suffix = piece.suffix.or_else(|| {
        let own = held(model, coordinates, id);
        let mut others =
            model.joints.iter().enumerate().filter(|(_, other)| {
                part(joint).is_some() && is_beside(other) && other.place.field == joint.place.field
            });
        let differs = others.any(|(number, _)| {
            let other = held(model, coordinates, JointId(number));
            other.contains(&true) && other != own
        });
        let what = if piece.first[1] == 0 { "position" } else { "orientation" };
        (differs && piece.is_partial(joint.kind)).then_some(what)
    });
    let Some(suffix) = suffix else {
        return names::field(&joint.place.field);
    };
    let base = format!("{}_{suffix}", names::plain(&joint.place.field));
    let mut name = base.clone();
    let mut number = 1;
    let part_of = |place: &Place| model.instances.get(place.instance.0).and_then(|instance| instance.part_type);
    let speeds = model.speeds.iter().filter(|speed| part_of(&speed.place) == part(joint));
    let taken = |name: &str| {
        model.joints.iter().filter(is_beside).any(|other| other.place.field == name)
            || speeds.clone().any(|speed| speed.place.field == name)
    };
    while taken(&name) {
        number += 1;
        name = format!("{base}_{number}");
    }
    names::derived(&joint.place.field, &name)
}
