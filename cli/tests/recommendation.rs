//! The choice that `compare` recommends by counts alone, held to times of compiled code, and what `--measure` says where it
//! cannot measure.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// Times that differ by less are equal.
const EQUAL: f64 = 1.05;

fn data(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data").join(name)
}

fn compare(words: &[&str], environment: &[(&str, &str)]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_cargo-multibody"));
    command.arg("compare").args(words).envs(environment.iter().copied()).current_dir(data(""));
    command.output().unwrap()
}

/// What was measured: model, choice, nanoseconds. Lines with `#` say when and where.
fn measured() -> BTreeMap<String, Vec<(String, f64)>> {
    let text = fs::read_to_string(data("scenes.times")).unwrap();
    let mut models: BTreeMap<String, Vec<(String, f64)>> = BTreeMap::new();
    for line in text.lines().filter(|line| !line.starts_with('#') && !line.is_empty()) {
        let cells: Vec<&str> = line.split_whitespace().collect();
        let (name, time) = (cells[0].to_owned(), cells[cells.len() - 1].parse().unwrap());
        models.entry(name).or_default().push((cells[1..cells.len() - 1].join(" "), time));
    }
    models
}

/// `mild` and `chaotic` are motions of one mechanism.
const SCENES: [(&str, &str); 9] = [
    ("pendulum", "pendulum"),
    ("mild", "double_pendulum"),
    ("chaotic", "double_pendulum"),
    ("free_body", "free_body"),
    ("panda", "panda"),
    ("four_bar", "four_bar"),
    ("andrews", "andrews"),
    ("stewart", "stewart"),
    ("governor", "governor"),
];

#[test]
fn recommended_choices_are_the_fastest() {
    let output = compare(&["scenes.rs"], &[]);
    let text = String::from_utf8(output.stdout).unwrap();
    let mut recommended: BTreeMap<&str, &str> = BTreeMap::new();
    let mut model = "";
    for line in text.lines() {
        match line.trim_start().strip_prefix("recommended: ") {
            Some(choice) => drop(recommended.insert(model, choice.trim_end_matches(", as it is written"))),
            None if !line.starts_with(' ') && !line.is_empty() => model = line,
            None => {}
        }
    }
    let measured = measured();
    let mut slower = Vec::new();
    for (scene, model) in SCENES {
        let times = &measured[model];
        let least = times.iter().map(|(_, time)| *time).fold(f64::INFINITY, f64::min);
        let (choice, time) = times.iter().find(|(choice, _)| choice == recommended[model]).unwrap();
        if *time > EQUAL * least {
            slower.push(format!("{scene}: {choice} takes {time} ns, another choice {least}"));
        }
    }
    assert!(slower.len() <= 1, "{slower:#?}\n{text}");
}

/// What is compared is what the study runs: items of either file stand in the other.
#[test]
fn scenes_are_those_of_the_study() {
    let study =
        fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples/tradeoff/models.rs")).unwrap();
    let scenes = fs::read_to_string(data("scenes.rs")).unwrap();
    let of = |text: &str, words: &[&str]| -> Vec<String> {
        let lines = text.lines().map(str::trim).filter(|line| words.iter().any(|word| line.starts_with(word)));
        lines.map(str::to_owned).collect()
    };
    let items =
        ["body ", "joint ", "force ", "world ", "const ", "part ", "port ", "between", "mass", "com", "inertia", "["];
    for line in of(&study, &items) {
        assert!(scenes.contains(&line), "{line}");
    }
    for line in of(&scenes, &[&items[..], &["solve ", "formulation "]].concat()) {
        assert!(study.contains(&line), "{line}");
    }
}

/// The message and the exit code of a measurement that cannot be made.
fn refused(words: &[&str], environment: &[(&str, &str)]) -> String {
    let output = compare(words, environment);
    assert_eq!((output.stdout.len(), output.status.code()), (0, Some(2)));
    let messages = String::from_utf8(output.stderr).unwrap();
    let progress = ["deriving `", "compiling `", "timing `"];
    let complaints: Vec<&str> =
        messages.lines().filter(|line| !progress.iter().any(|start| line.starts_with(start))).collect();
    complaints.join("\n")
}

#[test]
fn what_cannot_be_measured_is_one_message() {
    let words = ["pendulum.rs", "--model", "pendulum", "--measure"];
    let message = refused(&words, &[("CARGO", "/nowhere/cargo")]);
    assert!(message.starts_with("error: `cargo` cannot be run, which `--measure` needs: "), "{message}");
    assert_eq!(message.lines().count(), 1, "{message}");

    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("other_version");
    let file = |name: &str, text: &str| {
        fs::create_dir_all(folder.join(name).parent().unwrap()).unwrap();
        fs::write(folder.join(name), text).unwrap();
    };
    let package = |name: &str, version: &str, rest: &str| {
        format!("[package]\nname = \"{name}\"\nversion = \"{version}\"\nedition = \"2024\"\n{rest}")
    };
    file("Cargo.toml", &package("user", "0.1.0", "[workspace]\n[dependencies]\nmultibody = { path = \"library\" }\n"));
    file("library/Cargo.toml", &package("multibody", "99.0.0", ""));
    file("library/src/lib.rs", "");
    file("src/lib.rs", &fs::read_to_string(data("pendulum.rs")).unwrap());
    let source = folder.join("src/lib.rs");
    let message = refused(&[source.to_str().unwrap(), "--model", "pendulum", "--measure"], &[]);
    assert!(message.contains(" depends on multibody 99.0.0, and this is cargo-multibody "), "{message}");
    assert_eq!(message.lines().count(), 1, "{message}");
}

/// Compiles the library, its macro included, where no other measurement has done so.
#[test]
#[ignore = "takes a minute of compilation"]
fn choices_are_measured() {
    let output = compare(&["pendulum.rs", "--measure", "--all"], &[]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8(output.stdout).unwrap();
    let times: Vec<f64> = text
        .lines()
        .filter(|line| line.contains(" ns"))
        .flat_map(|line| line.split("  ").filter_map(|cell| cell.trim().strip_suffix(" ns")?.parse().ok()))
        .collect();
    // Forward dynamics in nine choices, the mass matrix of the pendulum in four of them, and what is said of both models.
    assert!(times.len() >= 13 && times.iter().all(|time| *time > 0.1 && *time < 1e5), "{text}");
    assert_eq!(text.matches("forward_dynamics takes least time, ").count(), 2, "{text}");
    assert_eq!(text.matches("recommended: coordinates Joint").count(), 2, "{text}");
}
