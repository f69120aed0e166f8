//! Derivation time, stage by stage, and what comes of it: lines of code and the seconds that rustc takes for them.
//!
//! `cargo bench --profile unoptimised --bench derivation` runs the engine as a debug build runs it inside the macro.
//! Bars: panda with four functions under 1 s, a tree of 30 bodies under 5 s, the platform on six legs with dynamics in both
//! directions under 2 s, its 150 equations in absolute coordinates under 10 s, forward dynamics of Whipple's bicycle with all its numbers
//! parameters under 2 s.

use std::fmt::Write;
use std::io;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::{Duration, Instant};

use multibody_engine::diagnostics::Diagnostics;
use multibody_engine::{emit, mechanics, model, optimize, parse};
use proc_macro2::TokenStream;

const ARMS: &str = include_str!("../tests/models/arms.rs");
const PLATFORM: &str = include_str!("../tests/models/stewart.rs");
const BICYCLE: &str = include_str!("../tests/models/rolling.rs");

fn main() -> io::Result<()> {
    if !std::env::args().any(|argument| argument == "--bench") {
        return Ok(()); // `cargo test --all-targets` runs benches, too
    }
    let build = if cfg!(debug_assertions) { "as in a user's debug build" } else { "optimised: not what users meet" };
    println!("Derivation, engine {build} [ms]:\n");
    println!("  model              parse   check  derive optimise    emit   total      bar    lines");
    let models = [
        ("double_pendulum", arm("double_pendulum"), 1.0),
        ("panda", arm("panda"), 1.0),
        ("tree30", tree(30), 5.0),
        ("reduced", platform("reduced"), 2.0),
        ("absolute", platform("absolute"), 10.0),
        ("whipple", bicycle("whipple"), 2.0),
    ];
    let mut emitted = Vec::new();
    let only: Vec<String> = std::env::args().skip(1).filter(|word| !word.starts_with("--")).collect();
    for (name, text, bar) in &models {
        if !only.is_empty() && !only.contains(&(*name).to_owned()) {
            continue;
        }
        let (times, code) = derive(text, name);
        let total: Duration = times.iter().sum();
        print!("  {name:<16}");
        times.iter().chain([&total]).for_each(|time| print!("{:>8.1}", time.as_secs_f64() * 1e3));
        let verdict = if total.as_secs_f64() < *bar { "met" } else { "MISSED" };
        println!("{:>9}{:>9}", verdict, code.lines().count());
        if !text.contains("port base") {
            emitted.push((*name, code));
        }
    }
    if !only.is_empty() {
        return Ok(());
    }
    println!("\nSeconds of rustc, with the code less without (a crate for it is built first):\n");
    println!("  {:<16}{:>10}{:>10}", "model", "debug", "release");
    let krate = Crate::new(Path::new(env!("CARGO_TARGET_TMPDIR")))?;
    for (name, code) in &emitted {
        let mut seconds = [0.0; 2];
        for (seconds, profile) in seconds.iter_mut().zip(["dev", "release"]) {
            krate.build("fn main() {}", profile)?; // dependencies
            let without = krate.build("fn main() { println!(); }", profile)?;
            *seconds = krate.build(&program(name, code), profile)? - without;
        }
        println!("  {name:<16}{:>10.2}{:>10.2}", seconds[0], seconds[1]);
    }
    Ok(())
}

/// The five stages and the code, formatted.
fn derive(text: &str, name: &str) -> ([Duration; 5], String) {
    let tokens: TokenStream = text.parse().expect("tokens");
    let mut clock = Instant::now();
    let mut lap = || std::mem::replace(&mut clock, Instant::now()).elapsed();
    let mut diagnostics = Diagnostics::default();
    let source = parse(tokens, &mut diagnostics);
    let parsed = lap();
    let models = model::check(&source, &mut diagnostics);
    let check = lap();
    assert!(diagnostics.is_empty(), "{}", diagnostics.to_tokens());
    let model = models.iter().find(|model| model.name == name).expect("the model");
    let (structure, derivation) = mechanics::of(model).unwrap_or_else(|_| panic!("mechanics"));
    let derive = lap();
    let compiled = optimize::compile(&derivation).unwrap_or_else(|_| panic!("too large"));
    let optimise = lap();
    let code = emit::emit(model, &structure, &compiled);
    let emit = lap();
    let file = syn::parse2(code).expect("items");
    ([parsed, check, derive, optimise, emit], prettyplease::unparse(&file))
}

/// The arm of the tests with four functions and no outputs.
fn arm(name: &str) -> String {
    let from = ARMS.find(&format!("pub mod {name} {{")).expect("an arm of the tests");
    let length = ARMS[from..].find("emit ").expect("functions");
    let items = ARMS[from..from + length].lines().filter(|line| !line.trim_start().starts_with("output"));
    // Documentation of an output would belong to no item.
    let items: Vec<&str> = items.filter(|line| !line.trim_start().starts_with("///")).collect();
    format!("{}\nemit forward_dynamics, inverse_dynamics, mass_matrix, bias; }}", items.join("\n"))
}

/// The call that holds this form of the platform, with its part.
fn platform(name: &str) -> String {
    let at = PLATFORM.find(&format!("pub mod {name} {{")).expect("a form of the platform");
    let from = PLATFORM[..at].rfind("multibody! {").expect("its call") + "multibody! {".len();
    let to = PLATFORM[at..].find("\n}\n").expect("its end") + at;
    PLATFORM[from..to].to_owned()
}

/// Whipple's bicycle of the ledger, in three speeds, by this name.
fn bicycle(name: &str) -> String {
    let from = BICYCLE.find("multibody! {").expect("its call") + "multibody! {".len();
    let to = BICYCLE[from..].find("/// Nine rates").expect("the other form") + from;
    let functions = BICYCLE[from..to].find("emit ").expect("functions");
    let items = BICYCLE[from..from + functions].replace("pub mod reduced", &format!("pub mod {name}"));
    format!("{items} emit forward_dynamics; }}")
}

/// A floating body with limbs of six revolute joints, every frame, mass and inertia different.
fn tree(bodies: usize) -> String {
    let mut seed = 1_u32;
    let mut number = |from: f64, to: f64| {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        from + (to - from) * f64::from(seed >> 8) / f64::from(1 << 24)
    };
    let mut text = format!("pub mod tree{bodies} {{ world {{ gravity: -9.81 * Z }}\n");
    for i in 0..bodies {
        let [x, y, z] = [0; 3].map(|_| number(-0.2, 0.2));
        let [a, b, c] = [0; 3].map(|_| number(0.02, 0.03));
        let [d, e, f] = [0; 3].map(|_| number(-0.002, 0.002));
        let mass = number(0.5, 5.0);
        let _ = writeln!(
            text,
            "body b{i} {{ mass: {mass}, com: [{x}, {y}, {z}], inertia: inertia({a}, {b}, {c}, {d}, {e}, {f}) }}"
        );
        let [x, y, z] = [0; 3].map(|_| number(-0.3, 0.3));
        let axis = ["X", "Y", "Z"][i % 3];
        let parent = if i % 6 == 1 { 0 } else { i.max(1) - 1 };
        let _ = match i {
            0 => writeln!(text, "joint base: Free {{ parent: ground, child: b0 }}"),
            _ => writeln!(
                text,
                "joint j{i}: Revolute {{ parent: b{parent}.at([{x}, {y}, {z}]), child: b{i}, axis: {axis} }}"
            ),
        };
    }
    text + "emit forward_dynamics, inverse_dynamics, mass_matrix, bias; }"
}

/// A program that calls the four functions.
fn program(name: &str, code: &str) -> String {
    format!(
        "use std::hint::black_box;
        {code}
        fn main() {{
            let model = black_box({name}::Model::<f64>::default());
            let state = black_box({name}::State::default());
            black_box(model.forward_dynamics(0.0, &state, &()));
            black_box(model.inverse_dynamics(0.0, &state, &(), &state.v));
            black_box(model.mass_matrix(&state.q));
            black_box(model.bias(0.0, &state, &()));
        }}"
    )
}

/// A crate of its own that depends on the runtime.
struct Crate(PathBuf);

impl Crate {
    fn new(within: &Path) -> io::Result<Self> {
        let root = within.join("emitted");
        std::fs::create_dir_all(root.join("src"))?;
        let workspace = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
        std::fs::copy(workspace.join("Cargo.lock"), root.join("Cargo.lock"))?;
        let manifest = format!(
            "[package]\nname = \"emitted\"\nedition = \"2024\"\n[workspace]\n[dependencies]\nmultibody = {{ path = {:?} }}\n",
            workspace.join("runtime")
        );
        std::fs::write(root.join("Cargo.toml"), manifest)?;
        Ok(Self(root))
    }

    /// [s]
    fn build(&self, main: &str, profile: &str) -> io::Result<f64> {
        std::fs::write(self.0.join("src/main.rs"), main)?;
        let start = Instant::now();
        let status = Command::new(env!("CARGO"))
            .args(["build", "--quiet", "--offline", "--profile", profile, "--target-dir", "target"])
            .current_dir(&self.0)
            .status()?;
        assert!(status.success(), "the emitted code does not compile");
        Ok(start.elapsed().as_secs_f64())
    }
}
