//! Closed loops in the generated module: which coordinates stand in its structs, what its functions are called, take and
//! give, its constants, and its report.

use crate::looped::looped;
use crate::parsed;
use crate::samples::*;
use multibody_engine::emit::report;
use multibody_engine::mechanics::loops::structure::Structure;
use multibody_engine::model::joint_kinds;
use multibody_engine::model::types::{Coordinate, InstanceId, JointId};
use syn::{Item, ItemMod};

fn module() -> ItemMod {
    let (model, structure, compiled) = looped();
    syn::parse2(multibody_engine::emit::emit(&model, &structure, &compiled)).expect("emitted code is a module")
}

fn items(module: &ItemMod) -> &[Item] {
    &module.content.as_ref().expect("a body").1
}

/// Fields of a struct with their types, without spaces.
fn fields(module: &ItemMod, name: &str) -> Vec<String> {
    let found = items(module).iter().find_map(|item| match item {
        Item::Struct(item) if item.ident == name => Some(item),
        _ => None,
    });
    let fields = found.unwrap_or_else(|| panic!("no {name}")).fields.iter();
    fields.map(|field| format!("{}:{}", field.ident.as_ref().unwrap(), parsed::text(&field.ty))).collect()
}

fn constant(module: &ItemMod, name: &str) -> String {
    let found = items(module).iter().find_map(|item| match item {
        Item::Const(item) if item.ident == name => Some(parsed::text(&item.expr)),
        _ => None,
    });
    found.unwrap_or_else(|| panic!("no {name}"))
}

const VECTOR: &str = "::multibody::nalgebra::Vector3<T>";

/// A joint that is whole has its own type, a free one its position or its orientation, others what is left of them.
#[test]
fn only_the_state_has_fields() {
    let module = module();
    let position = fields(&module, "Position");
    let vector = format!("platform:{VECTOR}");
    let expected = ["a:T", "b:T", "table_y_2:T", "table_angle:T", &vector, "head:::multibody::RollPitchYaw<T>"];
    assert_eq!(position, expected);
    assert_eq!(fields(&module, "Velocity"), expected);
    // The legs' joints are all found from others; a toe has nothing at all.
    let parts: Vec<&Item> = items(&module).iter().filter(|item| matches!(item, Item::Mod(_))).collect();
    let [Item::Mod(leg)] = parts[..] else { panic!("one part") };
    assert_eq!(leg.ident, "leg");
    let structs = items(leg).iter().filter(|item| matches!(item, Item::Struct(_))).count();
    assert_eq!((structs, fields(leg, "Input")), (2, vec!["thrust:T".to_string()]));
    assert_eq!(fields(leg, "Guess"), ["gimbal:::multibody::Universal<T>"]);
}

#[test]
fn a_part_has_one_type_for_all_its_instances() {
    let (mut model, mut compiled) = zoo();
    compiled.functions.clear();
    for leg in [1, 3] {
        add_joint(&mut model, place(leg, "body"), &joint_kinds::FREE);
    }
    let body = model.joints.len() - 1;
    let mut structure = Structure::open(&model);
    let is_turn = |c: &Coordinate| c.joint == JointId(body) && c.index > 2;
    structure.state.retain(|coordinate| !is_turn(coordinate));
    let tokens = multibody_engine::emit::emit(&model, &structure, &compiled);
    let module: ItemMod = syn::parse2(tokens).unwrap();
    let leg = items(&module).iter().find_map(|item| match item {
        Item::Mod(part) if part.ident == "leg" => Some(part),
        _ => None,
    });
    let fields = fields(leg.unwrap(), "Position");
    assert!(fields.contains(&"body:::multibody::Pose<T>".to_string()), "{fields:?}");
    assert!(fields.contains(&format!("body_position:{VECTOR}")), "{fields:?}");
    assert_eq!(model.joints[JointId(body)].place.instance, InstanceId(3));
}

#[test]
fn functions_take_what_they_need() {
    let module = module();
    let signature = |name: &str| {
        let signature = parsed::method(&module, name).sig;
        (parsed::text(&signature.inputs), parsed::text(&signature.output).replace("::multibody::nalgebra::", ""))
    };
    let of = |inputs: &str, output: &str| (inputs.to_string(), output.to_string());
    let state = "state:&State<T>";
    for (name, inputs, output) in [
        ("constraints", "&self,_t:T,q:&Position<T>".to_string(), "->SVector<T,1>"),
        ("constraint_jacobian", "&self,_t:T,q:&Position<T>".into(), "->SMatrix<T,1,10>"),
        ("constraint_rate", format!("&self,_t:T,{state}"), "->SVector<T,1>"),
        ("constraint_bias", format!("&self,_t:T,{state}"), "->SVector<T,1>"),
        ("kinematics", format!("&self,t:T,{state},_accel:&Velocity<T>"), "->::multibody::Kinematics<T,2>"),
        ("kinematics_2", "&self,_t:T,_state:&State<T>,_accel:&Velocity<T>".into(), "->::multibody::Kinematics<T,1>"),
        ("dead_centres", "&self,t:T,q:&Position<T>".into(), "->SVector<T,2>"),
        ("close", format!("&self,_t:T,{state}"), "->Closed<T>"),
        ("forward_dynamics", format!("&self,_t:T,{state},_input:&Input<T>"), "->Derivative<T>"),
        ("inverse_dynamics", "&self,_t:T,_state:&State<T>,input:&Input<T>,_accel:&Velocity<T>".into(), "->Solved<T>"),
        (
            "residual",
            format!("&self,_t:T,{state},_input:&Input<T>,_accel:&Velocity<T>,multipliers:&SVector<T,1>"),
            "->SVector<T,11>",
        ),
    ] {
        let (found, gives) = signature(name);
        assert_eq!((found.replace("::multibody::nalgebra::", ""), gives), of(&inputs, output), "{name}");
    }
}

#[test]
fn structs_say_what_is_given() {
    let module = module();
    let vector = |size: usize| format!("::multibody::nalgebra::SVector<T,{size}>");
    assert_eq!(
        fields(&module, "Derivative"),
        ["v:Velocity<T>", "x:States<T>", &format!("multipliers:{}", vector(1)), "rank:T", "residual:T"]
    );
    assert_eq!(fields(&module, "State")[3], "guess:Guess<T>");
    assert_eq!(fields(&module, "Guess"), ["legs:[leg::Guess<T>;2]"]);
    assert_eq!(fields(&module, "Closed"), ["state:State<T>", "residual:T"]);
    assert_eq!(fields(&module, "Solved"), ["input:Input<T>", "rank:T"]);
}

#[test]
fn constants_name_coordinates_and_equations() {
    let module = module();
    assert_eq!(constant(&module, "DOF"), "10");
    assert_eq!(constant(&module, "CONSTRAINTS"), "1");
    let names = "&[\"a\",\"b\",\"table_y_2\",\"table_angle\",\"platform.x\",\"platform.y\",\"platform.z\",\
                 \"head.roll\",\"head.pitch\",\"head.yaw\"]";
    assert_eq!(constant(&module, "COORDINATES"), names);
    assert_eq!(constant(&module, "EQUATIONS"), "&[\"ring\"]");
    assert_eq!(constant(&module, "JACOBIAN"), "&[\"xx........\"]");
    assert_eq!(constant(&module, "DEAD_CENTRES"), "&[\"legs[0].gimbal.first\",\"legs[0].toe.hinge\"]");
}

#[test]
fn the_report_says_how_loops_are_closed() {
    let (model, structure, compiled) = looped();
    let text = report(&model, &structure, &compiled);
    for line in [
        "| `table` | planar | `body_of_b` | `body_of_table` | 2 of 3 |  |",
        "| `legs[0].gimbal` | universal | `body_of_head` | `legs[0].body_of_gimbal` | 0 of 2 |  |",
        "| `ring` | expression |  |  | 1, and 2 solved | the bead's |",
        "10 velocity coordinates + 1 constraint equations = 11 equations.",
        "- `legs[_].gimbal.first`, `legs[_].gimbal.second`: by Newton's method on `legs[_].ball.x`, `legs[_].ball.y`",
        "- `legs[_].toe.hinge`: linear in the others, by `ring`",
        "- `table.x` is driven: `0.5 * sin(t)`",
        "- `platform.orientation` is driven: `0.0`",
        "- `head.position` is driven: `[0.0, 0.0, 0.0]`",
        "- left out, since they follow from the other equations: `legs[1].ball.z`",
        "- assumed: `legs[0].gimbal.first > 0.0`",
        "- `legs[_].ball` closes the loop: the cheapest joint",
        "- `#[cut]` on `legs[0].ball` says nothing new",
        "xx........  ring",
        "| `kinematics_2` | articulated body | 1 mul, 1 sincos | 7 add, 9 mul, 1 div, 1 sincos |",
    ] {
        assert!(text.lines().any(|found| found == line), "{line}\nis not in\n{text}");
    }
    // Nothing of all this where there is no loop.
    let (model, compiled) = zoo();
    assert!(!report(&model, &Structure::open(&model), &compiled).contains("Loops"));
}
