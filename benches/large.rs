//! Large models: what they cost the macro, and what their code costs rustc.
//!
//! `cargo bench --profile unoptimised --bench large -- SUBJECT:SIZE ..` derives each subject as a debug build does inside the
//! macro, stage by stage. With `--release` the code is compiled too, as rustc compiles it in release, with `--debug` as in a debug
//! build: seconds less those of an empty program, and the greatest memory of a process, told by GNU's `/usr/bin/time`. Subjects:
//!
//! - `forward`: forward dynamics of a chain of SIZE hinges,
//! - `mass`: its mass matrix,
//! - `derivatives`: derivatives of its forward and inverse dynamics,
//! - `humanoid`: the same of a floating body with 32 joints, two legs of six, a trunk of two, two arms of eight, a head of two;
//!   no size.
//!
//! All axes are oblique, all places, masses and inertias different.

use std::fmt::Write;
use std::io;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::{Duration, Instant};

use multibody_engine::diagnostics::Diagnostics;
use multibody_engine::{emit, mechanics, model, syntax, verify};
use proc_macro2::TokenStream;

fn main() -> io::Result<()> {
    if !std::env::args().any(|argument| argument == "--bench") {
        return Ok(()); // `cargo test --all-targets` runs benches, too
    }
    let subjects: Vec<String> = std::env::args().skip(1).filter(|word| !word.starts_with("--")).collect();
    let asked = |word: &str| std::env::args().any(|argument| argument == word);
    println!("subject             check  derive optimise and verify    emit   total [s]  operations before, after");
    let mut emitted = Vec::new();
    for subject in &subjects {
        let (kind, size) = subject.split_once(':').unwrap_or((subject, "0"));
        let (text, function) = text(kind, size.parse().expect("a size"));
        let (times, costs, code) = derive(&text);
        let total: Duration = times.iter().sum();
        print!("{subject:<16}");
        times.iter().chain([&total]).for_each(|time| print!("{:>8.2}", time.as_secs_f64()));
        println!("{costs}");
        emitted.push((subject, function, code));
    }
    let profiles = [("--debug", "dev"), ("--release", "release")];
    for (_, profile) in profiles.into_iter().filter(|(word, _)| asked(word)) {
        let krate = Crate::new(Path::new(env!("CARGO_TARGET_TMPDIR")))?;
        krate.build("fn main() {}", profile)?; // dependencies
        let (without, _) = krate.build("fn main() { println!(); }", profile)?;
        for (subject, function, code) in &emitted {
            let code = prettyplease::unparse(&syn::parse2(code.clone()).expect("items"));
            let (seconds, memory) = krate.build(&program(function, &code), profile)?;
            println!("{subject:<16} {profile:<8} {:>8.1} s {memory:>8} MB", seconds - without);
        }
    }
    Ok(())
}

/// The stages, what is to be said of the functions, and the code.
fn derive(text: &str) -> ([Duration; 4], String, TokenStream) {
    let tokens: TokenStream = text.parse().expect("tokens");
    let mut diagnostics = Diagnostics::default();
    let source = syntax::parse(tokens, &mut diagnostics);
    let mut clock = Instant::now();
    let mut lap = || std::mem::replace(&mut clock, Instant::now()).elapsed();
    let models = model::check(&source, &mut diagnostics);
    let check = lap();
    assert!(diagnostics.is_empty(), "{}", diagnostics.to_tokens());
    let model = models.last().expect("the model");
    let (structure, derivation) = mechanics::of(model).unwrap_or_else(|_| panic!("mechanics"));
    let derive = lap();
    let compiled = match verify::compile(model, &structure, &derivation) {
        Ok(compiled) => compiled,
        Err(refusal) => panic!("{refusal:?}"),
    };
    let optimise = lap();
    let code = emit::emit(model, &structure, &compiled);
    let emit = lap();
    let mut costs = String::new();
    for function in &compiled.functions {
        let (before, after) = (function.before.weight(), function.after.weight());
        let _ = write!(costs, "  {:?}: {before}, {after}, {}", function.kind, function.method);
    }
    let _ = write!(
        costs,
        "  unchecked: {}, sound: {}, expressions: {}",
        compiled.unchecked.len(),
        compiled.sound,
        derivation.graph.size()
    );
    ([check, derive, optimise, emit], costs, code)
}

/// A call for a subject, and the function that it is about.
fn text(kind: &str, size: usize) -> (String, &'static str) {
    match kind {
        "forward" => (chain(size, "forward_dynamics"), "forward_dynamics"),
        "mass" => (chain(size, "mass_matrix"), "mass_matrix"),
        "derivatives" => (chain(size, "derivatives"), "forward_derivatives"),
        "humanoid" => (tree("derivatives"), "forward_derivatives"),
        _ => panic!("no subject has this name"),
    }
}

/// Numbers without a pattern.
struct Numbers(u32);

impl Numbers {
    fn between(&mut self, from: f64, to: f64) -> f64 {
        self.0 = self.0.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        from + (to - from) * f64::from(self.0 >> 8) / f64::from(1 << 24)
    }

    fn body(&mut self, text: &mut String, name: &str) {
        let [x, y, z] = [0; 3].map(|_| self.between(-0.2, 0.2));
        let [a, b, c] = [0; 3].map(|_| self.between(0.02, 0.03));
        let [d, e, f] = [0; 3].map(|_| self.between(-0.002, 0.002));
        let mass = self.between(0.5, 5.0);
        let _ = writeln!(
            text,
            "body {name} {{ mass: {mass}, com: [{x}, {y}, {z}], inertia: inertia({a}, {b}, {c}, {d}, {e}, {f}) }}"
        );
    }

    fn hinge(&mut self, text: &mut String, parent: &str, child: &str) {
        let [x, y, z] = [0; 3].map(|_| self.between(-0.3, 0.3));
        let [a, b, c] = [0; 3].map(|_| self.between(0.2, 1.0));
        let place = if parent == "ground" { parent.to_owned() } else { format!("{parent}.at([{x}, {y}, {z}])") };
        let _ = writeln!(
            text,
            "joint hinge_{child}: Revolute {{ parent: {place}, child: {child}, axis: [{a}, {b}, -{c}] }}"
        );
    }
}

/// Hinges in a row.
fn chain(size: usize, emit: &str) -> String {
    let mut numbers = Numbers(1);
    let mut text = "pub mod subject { world { gravity: -9.81 * Z }\n".to_owned();
    for i in 0..size {
        let (name, parent) = (format!("b{i}"), if i == 0 { "ground".to_owned() } else { format!("b{}", i - 1) });
        numbers.body(&mut text, &name);
        numbers.hinge(&mut text, &parent, &name);
    }
    text + &format!("emit {emit}; }}")
}

/// A floating body on two legs, with two arms.
fn tree(emit: &str) -> String {
    let mut numbers = Numbers(1);
    let mut text = "pub mod subject { world { gravity: -9.81 * Z }\n".to_owned();
    numbers.body(&mut text, "pelvis");
    text += "joint base: Free { parent: ground, child: pelvis }\n";
    let limbs = [("left_leg", "pelvis", 6), ("right_leg", "pelvis", 6), ("trunk", "pelvis", 2)];
    let upper = [("left_arm", "trunk1", 8), ("right_arm", "trunk1", 8), ("head", "trunk1", 2)];
    for (limb, root, count) in limbs.into_iter().chain(upper) {
        for i in 0..count {
            let (name, parent) =
                (format!("{limb}{i}"), if i == 0 { root.to_owned() } else { format!("{limb}{}", i - 1) });
            numbers.body(&mut text, &name);
            numbers.hinge(&mut text, &parent, &name);
        }
    }
    text + &format!("emit {emit}; }}")
}

/// A program that calls the function.
fn program(function: &str, code: &str) -> String {
    let call = match function {
        "mass_matrix" => "black_box(model.mass_matrix(&state.q));",
        "forward_dynamics" => "black_box(model.forward_dynamics(0.0, &state, &()));",
        _ => "black_box(model.forward_derivatives(0.0, &state, &()));",
    };
    format!(
        "use std::hint::black_box;
        {code}
        fn main() {{
            let model = black_box(subject::Model::<f64>::default());
            let state = black_box(subject::State::default());
            {call}
        }}"
    )
}

/// A crate of its own that depends on the runtime.
struct Crate(PathBuf);

impl Crate {
    fn new(within: &Path) -> io::Result<Self> {
        let root = within.join("large");
        std::fs::create_dir_all(root.join("src"))?;
        let workspace = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
        std::fs::copy(workspace.join("Cargo.lock"), root.join("Cargo.lock"))?;
        let manifest = format!(
            "[package]\nname = \"large\"\nedition = \"2024\"\n[workspace]\n[dependencies]\nmultibody = {{ path = {:?} }}\n",
            workspace.join("runtime")
        );
        std::fs::write(root.join("Cargo.toml"), manifest)?;
        Ok(Self(root))
    }

    /// Seconds, and megabytes of the largest process.
    fn build(&self, main: &str, profile: &str) -> io::Result<(f64, u64)> {
        std::fs::write(self.0.join("src/main.rs"), main)?;
        let start = Instant::now();
        let output = Command::new("/usr/bin/time")
            .args(["-f", "peak %M", env!("CARGO")])
            .args(["build", "--quiet", "--offline", "--profile", profile, "--target-dir", "target"])
            .current_dir(&self.0)
            .output()?;
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "the emitted code does not compile: {said}");
        let peak =
            said.lines().find_map(|line| line.strip_prefix("peak ")).and_then(|kilobytes| kilobytes.parse().ok());
        Ok((start.elapsed().as_secs_f64(), peak.unwrap_or(0_u64) / 1024))
    }
}
