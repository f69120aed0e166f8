//! Structs through JSON and back, bit for bit, under the names of the declarations; what does not fit is an error.

use core::fmt::Debug;

use multibody::Columns;
use multibody::nalgebra::{SVector, UnitQuaternion};
use multibody::serde::Serialize;
use multibody::serde::de::DeserializeOwned;
use serde_json::{Value, json};

use super::{flat, held, loop_of_four, walker};

/// Numbers with all their digits, of many sizes.
fn odd<const N: usize>() -> SVector<f64, N> {
    SVector::from_fn(|row, _| (1.0 + row as f64).sqrt().sin() * 10.0_f64.powi(row as i32 % 37 - 18))
}

fn bits(row: &impl Columns<f64>) -> Vec<u64> {
    let mut list = Vec::new();
    row.each(&mut |_, value| list.push(value.to_bits()));
    list
}

fn check<S: Serialize + DeserializeOwned + Columns<f64>>(what: S) {
    let text = serde_json::to_string(&what).unwrap();
    let back: S = serde_json::from_str(&text).unwrap();
    assert_eq!(bits(&back), bits(&what), "{text}");
    // The order of fields is of no account.
    let value: Value = serde_json::from_str(&text).unwrap();
    let sorted: S = serde_json::from_value(value).unwrap();
    assert_eq!(bits(&sorted), bits(&what));
}

fn state() -> walker::State {
    let mut state = walker::State {
        q: walker::Position::default(),
        v: walker::Velocity::from(odd::<21>()),
        x: walker::States::from(odd::<4>()),
    };
    state.q.float.orientation = UnitQuaternion::from_euler_angles(0.3, -0.8, 1.9);
    (state.q.slide.angle, state.q.legs[2].toes[1].bend) = (0.1, 1e-300);
    state
}

#[test]
fn every_bit_comes_back() {
    check(walker::Params::from(odd::<24>()));
    check(walker::Input::from(odd::<44>()));
    check(walker::States::from(odd::<4>()));
    check(state());
    check(walker::Velocity::from(odd::<21>()));
    check(flat::State::from(odd::<24>()));
    let mut closing = loop_of_four::State::<f64>::default();
    closing.guess.two = 0.1 + 0.2;
    let text = serde_json::to_string(&closing).unwrap();
    assert_eq!(serde_json::from_str::<loop_of_four::State>(&text).unwrap(), closing);
    let model = walker::Model::<f64>::default();
    let input = walker::Input::from(odd::<44>());
    check(model.outputs(0.0, &state(), &input));
    check(model.outputs_some(0.0, &state(), &input));
}

#[test]
fn what_functions_give_comes_back() {
    fn same<S: Serialize + DeserializeOwned + PartialEq + Debug>(what: &S) {
        let text = serde_json::to_string(what).unwrap();
        assert_eq!(serde_json::from_str::<S>(&text).unwrap(), *what);
    }
    let model = held::Model::<f64>::default();
    same(&model.forward_dynamics(0.0, &held::State::default(), &()));
    let closing = loop_of_four::Model::<f64>::default();
    same(&closing.close(0.0, &loop_of_four::State::default()));
}

#[test]
fn single_precision_comes_back() {
    let mut params = walker::Params::<f32>::default();
    params.offset.y = 0.1;
    let text = serde_json::to_string(&params).unwrap();
    assert_eq!(serde_json::from_str::<walker::Params<f32>>(&text).unwrap(), params);
}

#[test]
fn names_are_those_of_the_declarations() {
    let input = serde_json::to_value(walker::Input::<f64>::default()).unwrap();
    assert_eq!(input["type"], json!(0.0));
    assert_eq!(input["gains"].as_array().map(Vec::len), Some(40));
    let params = serde_json::to_value(walker::Params::<f64>::default()).unwrap();
    assert_eq!(params["legs"][2]["toes"][1], json!({ "heavy": 0.35 }));
    assert_eq!(params["offset"], json!([0.3, -0.7, 1.1]));
    assert_eq!(params["table"], json!([[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]));
    let q = serde_json::to_value(walker::Position::<f64>::default()).unwrap();
    let orientation = json!({ "w": 1.0, "i": 0.0, "j": 0.0, "k": 0.0 });
    assert_eq!(q["float"], json!({ "position": [0.0, 0.0, 0.0], "orientation": orientation }));
    assert_eq!(q["slide"], json!({ "x": 0.0, "y": 0.0, "angle": 0.0 }));
}

/// The error where one value is put in the place of another.
fn refused<S: Serialize + DeserializeOwned>(what: S, change: impl FnOnce(&mut Value)) -> String {
    let mut value = serde_json::to_value(what).unwrap();
    change(&mut value);
    serde_json::from_value::<S>(value).err().unwrap().to_string()
}

#[test]
fn what_does_not_fit_is_an_error() {
    let params = walker::Params::<f64>::default;
    let object = |value: &mut Value, at: &str, name: &str, new: Option<Value>| {
        let fields = value.pointer_mut(at).unwrap().as_object_mut().unwrap();
        match new {
            Some(new) => fields.insert(name.to_owned(), new),
            None => fields.remove(name),
        };
    };
    let missing = refused(params(), |value| object(value, "/legs/1", "ratios", None));
    assert_eq!(missing, "missing field `ratios`");
    let unknown = refused(params(), |value| object(value, "/legs/1/toes/0", "heavvy", Some(json!(1.0))));
    assert_eq!(unknown, "unknown field `heavvy`, expected `heavy`");
    let short = refused(params(), |value| object(value, "", "offset", Some(json!([1.0, 2.0]))));
    assert_eq!(short, "invalid length 2, expected an array of length 3");
    let long = refused(params(), |value| object(value, "", "offset", Some(json!([1.0, 2.0, 3.0, 4.0]))));
    assert!(long.contains("invalid length 4"), "{long}");
    let gains =
        refused(walker::Input::<f64>::default(), |value| object(value, "", "gains", Some(json!(vec![1.0; 39]))));
    assert_eq!(gains, "invalid length 39, expected an array of length 40");
    let text = refused(params(), |value| object(value, "", "offset", Some(json!("far"))));
    assert!(text.starts_with("invalid type: string \"far\""), "{text}");
    let turned = refused(state(), |value| object(value, "/q/float/orientation", "w", Some(json!(3.0))));
    assert_eq!(turned, "the quaternion is not of unit length");
    let twice = r#"{ "x": 1.0, "y": 2.0, "x": 3.0, "angle": 4.0 }"#;
    let twice = serde_json::from_str::<multibody::Planar>(twice).err().unwrap().to_string();
    assert!(twice.starts_with("duplicate field `x`"), "{twice}");
}
