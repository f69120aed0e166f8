//! Stage `model`: the words that the runtime documents for editors, in its module `words`.
//!
//! In: nothing. Out: which rooms of that module have which words, with which fields. A word that stands here has a struct of
//! its name there; `tests/model/words.rs` holds one against the other.

use crate::model::joint_kinds::JointKind;

/// Words of one room with their fields.
type Room = &'static [(&'static str, &'static [&'static str])];

const ITEM: Room = &[
    ("World", &["gravity"]),
    ("Formulation", &["coordinates", "constraints", "independent", "rounds", "packs", "speeds", "rate", "position"]),
    ("Body", &["mass", "com", "inertia", "coordinates"]),
];

const FORCE: Room = &[
    ("Effort", &["joint", "value"]),
    ("Spring", &["joint", "between", "stiffness", "rest", "length"]),
    ("Damper", &["joint", "between", "damping"]),
    ("SpringDamper", &["joint", "between", "stiffness", "damping", "rest", "length"]),
    ("Force", &["at", "value", "axes"]),
    ("Torque", &["at", "value", "axes"]),
    (
        "Contact",
        &[
            "at",
            "radius",
            "axis",
            "on",
            "ball",
            "ball_radius",
            "stiffness",
            "damping",
            "exponent",
            "friction",
            "slip_speed",
        ],
    ),
];

const CONSTRAINT: Room = &[
    ("Rod", &["between", "length"]),
    ("Rolling", &["wheel", "axis", "radius", "on"]),
    ("Skate", &["blade", "along", "on"]),
];

const EMIT: Room = &[
    ("forward_dynamics", &[]),
    ("inverse_dynamics", &["solve_for"]),
    ("mass_matrix", &[]),
    ("mass_matrix_lower", &[]),
    ("bias", &[]),
    ("energy", &[]),
    ("constraints", &[]),
    ("residual", &[]),
    ("kinematics", &["given", "find"]),
    ("assembly_modes", &["given", "find"]),
    ("derivatives", &[]),
    ("linearize", &[]),
    ("impulse", &[]),
    ("momentum", &[]),
    ("centroidal_momentum_matrix", &[]),
    ("poses", &[]),
    ("outputs", &[]),
    ("at", &["functions"]),
    ("report", &[]),
    ("equations", &[]),
];

const TYPE: Room = &[
    ("Scalar", &[]),
    ("Vec3", &[]),
    ("Pose", &[]),
    ("Rotation", &[]),
    ("Twist", &[]),
    ("Wrench", &[]),
    ("Jacobian", &[]),
    ("Frame", &[]),
    ("Joint", &[]),
];

const COORDINATES: Room = &[("Joint", &[]), ("Absolute", &[]), ("Quaternion", &[]), ("RollPitchYaw", &[])];

const HANDLING: Room = &[("Multipliers", &[]), ("Reduced", &[]), ("Stabilised", &[]), ("Auto", &[])];

const PACKS: Room = &[("Off", &[]), ("Four", &[])];

const SPEEDS: Room = &[("Rates", &[]), ("Auto", &[])];

/// What a declared name is.
const NAME: Room = &[
    ("Const", &[]),
    ("Param", &[]),
    ("Input", &[]),
    ("Let", &[]),
    ("Speed", &[]),
    ("Output", &[]),
    ("State", &[]),
    ("Port", &[]),
    ("Body", &[]),
    ("Joint", &[]),
    ("Force", &[]),
    ("Constraint", &[]),
    ("Part", &[]),
    ("Unknown", &[]),
    ("Index", &[]),
    ("Function", &[]),
    ("Argument", &[]),
    ("Extern", &[]),
];

/// The rooms whose words stand here.
const ROOMS: [(&str, Room); 10] = [
    ("item", ITEM),
    ("force", FORCE),
    ("constraint", CONSTRAINT),
    ("emit", EMIT),
    ("ty", TYPE),
    ("coordinates", COORDINATES),
    ("handling", HANDLING),
    ("packs", PACKS),
    ("speeds", SPEEDS),
    ("name", NAME),
];

/// The room of joint kinds, whose words and fields are those of their table.
pub const JOINT: &str = "joint";

/// All words: room, word, fields.
pub fn all() -> Vec<(&'static str, &'static str, Vec<&'static str>)> {
    let written = ROOMS.iter().flat_map(|(room, words)| words.iter().map(|word| (*room, word.0, word.1.to_vec())));
    written.chain(JointKind::names().map(|name| (JOINT, name, joint(name)))).collect()
}

/// The fields of a word; nothing where there is no such word.
pub fn fields(room: &str, word: &str) -> Option<Vec<&'static str>> {
    if room == JOINT {
        return JointKind::named(word).map(|_| joint(word));
    }
    let (_, words) = ROOMS.iter().find(|known| known.0 == room)?;
    words.iter().find(|known| known.0 == word).map(|known| known.1.to_vec())
}

/// The name of a joint kind as it stands in the table.
pub(super) fn joint_kind(name: &str) -> Option<&'static str> {
    JointKind::named(name).map(|kind| kind.name)
}

fn joint(name: &str) -> Vec<&'static str> {
    let mut fields = vec!["parent", "child"];
    if let Some(kind) = JointKind::named(name) {
        fields.extend(kind.written.fields());
        fields.extend(kind.written.instead());
        fields.extend(kind.has_pitch.then_some("pitch"));
        if kind.turns_freely() {
            fields.push("coordinates");
        } else if kind.freedoms() == 1 {
            fields.push("armature");
        }
    }
    fields
}
