//! Arms of the reference data, written as URDF by `tests/scripts/urdf.py`: as they are, and in oblique frames.

use multibody_engine::contracts::function::FunctionKind;
use serde_json::Value;

use super::{At, Functions, difference, imported, run, written};

/// With links whose published inertia no body has.
const ARMS: [(&str, &[&str]); 4] =
    [("double_pendulum", &[]), ("cart5", &[]), ("puma560", &["link1", "link3"]), ("panda", &[])];

fn arm(name: &str, file: &str) -> String {
    let unphysical = ARMS.iter().find(|(arm, _)| *arm == name).unwrap().1;
    let words = unphysical.iter().flat_map(|link| ["--allow-unphysical", link]);
    imported(&[file].into_iter().chain(words).collect::<Vec<_>>()).0
}

fn flat(value: &Value) -> Vec<f64> {
    match value {
        Value::Array(list) => list.iter().flat_map(flat).collect(),
        number => vec![number.as_f64().unwrap()],
    }
}

/// Operations of each function, derived and emitted, without the table's blanks.
fn counts(words: &[&str]) -> Vec<String> {
    let (table, messages, code) = run(words);
    assert_eq!(code, 0, "{messages}");
    let rows = table.lines().map(|line| line.split_whitespace().collect::<Vec<_>>().join(" "));
    let functions = ["forward_dynamics ", "inverse_dynamics ", "mass_matrix ", "bias "];
    rows.filter(|row| functions.iter().any(|function| row.starts_with(function))).collect()
}

#[test]
fn imported_arms_take_what_typed_ones_take() {
    for (name, _) in ARMS {
        let file = written(&format!("{name}.rs"), &arm(name, &format!("{name}.urdf")));
        let typed = counts(&["counts", "../../../../tests/models/arms.rs", "--model", name]);
        assert_eq!(typed.len(), 4);
        assert_eq!(counts(&["counts", &file]), typed, "{name}");
    }
}

#[test]
fn imported_arms_move_as_the_data_say() {
    for (name, _) in ARMS {
        let root = env!("CARGO_MANIFEST_DIR");
        let data = std::fs::read_to_string(format!("{root}/../tests/data/robots/{name}.samples.json")).unwrap();
        let data: Value = serde_json::from_str(&data).unwrap();
        let samples = data["samples"].as_array().unwrap();
        assert_eq!(samples.len(), 20);
        // Angles of oblique frames come of arcus tangents.
        for (file, tolerance) in [(format!("{name}.urdf"), 1e-12), (format!("{name}_oblique.urdf"), 1e-11)] {
            let functions = Functions::of(&arm(name, &file));
            let mut worst = 0.0_f64;
            for sample in samples {
                let names: Vec<String> = (1..=flat(&sample["q"]).len()).map(|k| format!("joint{k}")).collect();
                let list = |key: &str| {
                    let values = flat(&sample[key]);
                    names.iter().zip(values).map(|(joint, x)| (joint.as_str(), 0, x)).collect()
                };
                let at = At { q: list("q"), v: list("v"), a: list("a"), inputs: Vec::new() };
                for (kind, key) in [
                    (FunctionKind::InverseDynamics, "rnea"),
                    (FunctionKind::Bias, "nle"),
                    (FunctionKind::MassMatrix, "M"),
                ] {
                    let off = difference(&functions.run(kind, &at), &flat(&sample[key]));
                    worst = if off <= worst { worst } else { off };
                    assert!(off < tolerance, "{file}, {key}: {off:e}");
                }
            }
            println!("{file}: {worst:.1e}");
        }
    }
}
