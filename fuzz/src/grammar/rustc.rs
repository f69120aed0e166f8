//! Many models in one scratch crate, through `rustc` and clippy: no error and no warning may come of generated code.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::Command;

/// What models call, with as many arguments as they like.
const CURVE: &str = "
/// A function of Rust.
#[derive(Debug)]
pub struct Curve;

impl<T: multibody::Real, const N: usize> multibody::Function<T, N> for Curve {
    fn value(x: [T; N]) -> T {
        x.into_iter().fold(T::lit(1.0), |sum, x| sum + multibody::Real::tanh(x))
    }

    fn slopes(x: [T; N]) -> [T; N] {
        x.map(|x| {
            let share = multibody::Real::tanh(x);
            T::lit(1.0) - share * share
        })
    }
}
";

const HEAD: &str = "//! Random models.\n#![deny(warnings, missing_docs, missing_debug_implementations, unreachable_pub)]\n\
                    #![deny(unused, rust_2018_idioms, unused_qualifications, clippy::all)]\n#![forbid(unsafe_code)]\n";

/// What the tools said: nothing, if all is well.
pub struct Said {
    /// Of `cargo check`: generated code is generic, so what `rustc` has to say it says there.
    pub build: String,
    /// Of `cargo clippy -- -D clippy::pedantic`.
    pub clippy: String,
}

/// A directory for the crate inside of the project's `target`.
pub fn scratch(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../target/fuzz").join(name)
}

/// Writes the models, one file each, and builds them.
pub fn build(directory: &Path, models: &[Vec<String>]) -> std::io::Result<Said> {
    let runtime = Path::new(env!("CARGO_MANIFEST_DIR")).join("../runtime");
    let source = directory.join("src");
    std::fs::create_dir_all(&source)?;
    let manifest = format!(
        "[package]\nname = \"scratch\"\nversion = \"0.0.0\"\nedition = \"2024\"\npublish = false\n\n[workspace]\n\n\
         [dependencies]\nmultibody = {{ path = {:?} }}\n\n[profile.dev]\ndebug = false\nincremental = false\n\n\
         [profile.dev.build-override]\nopt-level = 1\n",
        runtime.canonicalize()?
    );
    std::fs::write(directory.join("Cargo.toml"), manifest)?;
    let lock = Path::new(env!("CARGO_MANIFEST_DIR")).join("../Cargo.lock");
    if !directory.join("Cargo.lock").exists() && lock.exists() {
        std::fs::copy(lock, directory.join("Cargo.lock"))?;
    }
    let mut library = format!("{HEAD}{CURVE}");
    for (k, lines) in models.iter().enumerate() {
        writeln!(library, "pub mod model{k};").expect("text is always written");
        let text = format!("//! Model {k}.\nmultibody::multibody! {{\n{}\n}}\n", lines.join("\n"));
        std::fs::write(source.join(format!("model{k}.rs")), text)?;
    }
    std::fs::write(source.join("lib.rs"), library)?;
    let run = |arguments: &[&str]| -> std::io::Result<String> {
        let output = Command::new(std::env::var("CARGO").unwrap_or_else(|_| "cargo".into()))
            .args(arguments)
            .current_dir(directory)
            .env("CARGO_TARGET_DIR", directory.join("../target"))
            .env("CARGO_TERM_COLOR", "never")
            .env_remove("RUSTFLAGS")
            .output()?;
        let text = String::from_utf8_lossy(&output.stderr).into_owned();
        let heard = text.lines().any(|line| line.starts_with("error") || line.starts_with("warning"));
        Ok(if output.status.success() && !heard { String::new() } else { text })
    };
    let build = run(&["check", "--quiet"])?;
    let clippy = run(&["clippy", "--quiet", "--", "-D", "clippy::pedantic"])?;
    Ok(Said { build, clippy })
}
