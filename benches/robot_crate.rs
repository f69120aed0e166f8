//! What a robot's file costs the crates about it: a workspace of three crates, of which one reads the file of a humanoid with thirty
//! joints, one calls it, and one has nothing to do with it.
//!
//! `cargo bench --profile unoptimised --bench robot_crate` derives as a debug build does inside the macro, then builds in dev and
//! release: the crate that reads the file, the caller after a change of its own, and all after a change of the file. That such a
//! change builds the reader and its caller again, and no other crate, is asserted.

use std::collections::BTreeSet;
use std::io;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

use multibody_engine::diagnostics::Diagnostics;
use multibody_engine::{emit, mechanics, model, optimize, parse_reading};

const FILE: &str = include_str!("../tests/data/robots/humanoid.urdf");

const MODEL: &str = "pub mod humanoid {
    world { gravity: -9.81 * Z }
    part robot: Urdf { file: \"humanoid.urdf\", base: Free };
    emit mass_matrix, bias, inverse_dynamics, forward_dynamics;
}";

/// Behind the call: a function of `f64` alone is compiled here, a generic one where it is called.
const CALLED: &str = "
use std::hint::black_box;
pub fn evaluate(state: &humanoid::State<f64>) {
    let model = black_box(humanoid::Model::<f64>::default());
    black_box(model.mass_matrix(&state.q));
    black_box(model.bias(0.0, state, &()));
    black_box(model.inverse_dynamics(0.0, state, &(), &state.v));
    black_box(model.forward_dynamics(0.0, state, &()));
}
";

const CALLER: &str = "fn main() { robot::evaluate(&std::hint::black_box(robot::humanoid::State::default())); }";

fn main() -> io::Result<()> {
    if !std::env::args().any(|argument| argument == "--bench") {
        return Ok(()); // `cargo test --all-targets` runs benches, too
    }
    let derivation = derive();
    println!("derivation {derivation:.1} s");
    println!("profile   reads the file   of that rustc   caller changed   file changed [s]");
    for profile in ["dev", "release"] {
        let workspace = Workspace::new(Path::new(env!("CARGO_TARGET_TMPDIR")), profile)?;
        workspace.build()?; // dependencies
        workspace.write("robot/src/lib.rs", &format!("multibody::multibody! {{ {MODEL} }}{CALLED}"))?;
        workspace.write("caller/src/main.rs", CALLER)?;
        let (read, _) = workspace.build()?;
        workspace.write("caller/src/main.rs", &format!("{CALLER}\n// changed"))?;
        let (called, built) = workspace.build()?;
        assert_eq!(built, BTreeSet::from(["caller".to_owned()]));
        workspace
            .write("robot/src/humanoid.urdf", &FILE.replace("<mass value=\"8.337\"/>", "<mass value=\"8.5\"/>"))?;
        let (changed, built) = workspace.build()?;
        assert_eq!(built, BTreeSet::from(["robot".to_owned(), "caller".to_owned()]));
        println!("{profile:<9}{read:>15.1}{:>16.1}{called:>17.1}{changed:>15.1}", read - derivation);
    }
    Ok(())
}

/// From the call to code, in seconds.
fn derive() -> f64 {
    let start = Instant::now();
    let mut diagnostics = Diagnostics::default();
    let source = parse_reading(MODEL.parse().expect("tokens"), &|_| Ok(FILE.to_owned()), &mut diagnostics);
    let models = model::check(&source, &mut diagnostics);
    assert!(diagnostics.is_empty(), "{}", diagnostics.to_tokens());
    let (structure, derivation) = mechanics::of(&models[0]).unwrap_or_else(|_| panic!("mechanics"));
    let compiled = optimize::compile(&derivation).unwrap_or_else(|_| panic!("too large"));
    std::hint::black_box(emit::emit(&models[0], &structure, &compiled));
    start.elapsed().as_secs_f64()
}

/// Three crates.
struct Workspace {
    root: PathBuf,
    profile: &'static str,
}

impl Workspace {
    /// With all dependencies, and without the robot.
    fn new(within: &Path, profile: &'static str) -> io::Result<Self> {
        let workspace = Workspace { root: within.join("robot_crate"), profile };
        let project = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
        let runtime = project.join("runtime");
        workspace
            .write("Cargo.toml", "[workspace]\nresolver = \"3\"\nmembers = [\"robot\", \"caller\", \"other\"]\n")?;
        std::fs::copy(project.join("Cargo.lock"), workspace.root.join("Cargo.lock"))?;
        let multibody = format!("multibody = {{ path = {runtime:?} }}\n");
        for (name, file, dependencies) in [
            ("robot", "lib.rs", multibody.as_str()),
            ("caller", "main.rs", "robot = { path = \"../robot\" }\n"),
            ("other", "lib.rs", multibody.as_str()),
        ] {
            let head = format!("[package]\nname = \"{name}\"\nedition = \"2024\"\n[dependencies]\n");
            workspace.write(&format!("{name}/Cargo.toml"), &(head + dependencies))?;
            workspace.write(&format!("{name}/src/{file}"), if file == "main.rs" { "fn main() {}" } else { "" })?;
        }
        workspace.write("robot/src/humanoid.urdf", FILE)?;
        Ok(workspace)
    }

    fn write(&self, file: &str, text: &str) -> io::Result<()> {
        let path = self.root.join(file);
        if let Some(directory) = path.parent() {
            std::fs::create_dir_all(directory)?;
        }
        std::fs::write(path, text)
    }

    /// Seconds, and which of the three crates were compiled.
    fn build(&self) -> io::Result<(f64, BTreeSet<String>)> {
        let start = Instant::now();
        let output = Command::new(env!("CARGO"))
            .args(["build", "--workspace", "--offline", "--profile", self.profile, "--message-format", "json"])
            .args(["--target-dir", "target"])
            .current_dir(&self.root)
            .output()?;
        let seconds = start.elapsed().as_secs_f64();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let text = String::from_utf8_lossy(&output.stdout);
        let messages = text.lines().filter_map(|line| serde_json::from_str::<serde_json::Value>(line).ok());
        let built = messages.filter(|message| message["fresh"] == false);
        let names = built.filter_map(|message| message["target"]["name"].as_str().map(str::to_owned));
        let own = names.filter(|name| ["robot", "caller", "other"].contains(&name.as_str()));
        Ok((seconds, own.collect()))
    }
}
