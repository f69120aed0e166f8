//! Four arms as URDF and MJCF, against the same typed in.

use std::fs;
use std::path::Path;

use multibody_engine::model::types::Model;
use proc_macro2::TokenTree;

use crate::support::{assert_same, checked, model_of};

fn read(file: &str) -> String {
    fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests").join(file)).unwrap()
}

/// A module of `models/arms.rs`.
fn typed_in(name: &str) -> Model {
    let tokens: proc_macro2::TokenStream = read("models/arms.rs").parse().unwrap();
    for token in tokens {
        let TokenTree::Group(group) = token else { continue };
        let (models, said) = checked(group.stream(), "");
        if let Some(model) = models.into_iter().find(|model| model.name == name) {
            assert!(said.is_empty(), "{said:#?}");
            return model;
        }
    }
    panic!("no {name}")
}

const EMITTED: &str = "output pose = arm.tool.pose; output rotation = arm.tool.rotation; output jacobian = arm.tool.jacobian; \
    output twist = arm.tool.twist; emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy;";

fn call(more: &str) -> String {
    format!(
        "pub mod robot {{ world {{ gravity: -9.81 * Z }} \
         part arm: Urdf {{ file: \"arm.urdf\", base: ground, angles: Snapped, allow: unphysical_inertia{more} }}; {EMITTED} }}"
    )
}

#[test]
fn arms_are_what_was_typed_in() {
    for name in ["double_pendulum", "cart5", "puma560", "panda"] {
        let robot = model_of(&call(""), &read(&format!("data/robots/{name}.urdf")));
        assert_same(&typed_in(name), &robot, true);
    }
}

/// The same from MJCF, where orientations are quaternions and bodies stand within one another.
#[test]
fn arms_of_mjcf_are_what_was_typed_in() {
    for name in ["double_pendulum", "cart5", "puma560", "panda"] {
        let call = call("").replace("Urdf", "Mjcf");
        let robot = model_of(&call, &read(&format!("data/robots/{name}.xml")));
        assert_same(&typed_in(name), &robot, true);
    }
}

/// Without being asked nothing becomes a quarter turn: eleven digits are as far off as they are.
#[test]
fn angles_are_as_written() {
    let file = read("data/robots/panda.urdf");
    let written = model_of(&call("").replace("angles: Snapped, ", ""), &file);
    let operations =
        |model: &Model| format!("{:?}", crate::support::functions(model).into_values().map(|(_, n)| n).max());
    let snapped = model_of(&call(""), &file);
    assert_ne!(operations(&written), operations(&snapped));
}

/// Numbers become fields of `Params`, and mean the same.
#[test]
fn parameters_have_the_numbers_of_the_file() {
    let file = read("data/robots/double_pendulum.urdf");
    let with = model_of(&call(", param: [link2.mass, link1.com, link2.inertia]"), &file);
    let widths: Vec<usize> = with.params.iter().map(|param| param.default.len()).collect();
    assert_eq!(widths.iter().sum::<usize>(), 10);
    assert_same(&typed_in("double_pendulum"), &with, false);
}
