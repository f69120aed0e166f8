//! The library and what it generates compile with the oldest Rust that `Cargo.toml` admits. Where that toolchain cannot be
//! had this says so and fails nothing.

use crate::{Stop, command, root};
use std::fs;

/// The packages that are published, and one that uses them.
const PACKAGES: [&str; 5] =
    ["multibody-engine", "multibody-macros", "multibody", "multibody-cli", "multibody-examples"];

pub(crate) fn run() -> Result<bool, Stop> {
    let manifest = fs::read_to_string(root().join("Cargo.toml"))?;
    let version = rust_version(&manifest).ok_or("no rust-version in Cargo.toml")?;
    let mut rustup = command("rustup");
    rustup.args(["toolchain", "install", version, "--profile", "minimal", "--no-self-update"]);
    if !rustup.status().is_ok_and(|status| status.success()) {
        println!("not checked: Rust {version} cannot be had here");
        return Ok(true);
    }
    println!("Rust {version}");
    let mut cargo = command("rustup");
    cargo.args(["run", version, "cargo", "check", "--locked", "--quiet"]).current_dir(root());
    // This program was started by another toolchain's cargo, whose choices are not to be inherited.
    cargo.env_remove("RUSTC").env_remove("RUSTDOC").env("CARGO_TARGET_DIR", root().join("target/minimum"));
    // The engine inside the macro runs on one small example.
    cargo.env("CARGO_PROFILE_DEV_BUILD_OVERRIDE_OPT_LEVEL", "0").env("CARGO_PROFILE_DEV_BUILD_OVERRIDE_DEBUG", "0");
    for package in PACKAGES {
        cargo.args(["--package", package]);
    }
    Ok(cargo.args(["--lib", "--bins", "--example", "double_pendulum"]).status()?.success())
}

fn rust_version(manifest: &str) -> Option<&str> {
    let line = manifest.lines().find_map(|line| line.strip_prefix("rust-version = \""))?;
    line.strip_suffix('"')
}

#[cfg(test)]
mod tests {
    use super::rust_version;

    #[test]
    fn the_version_stands_in_the_manifest() {
        assert_eq!(rust_version("[workspace.package]\nedition = \"2024\"\nrust-version = \"1.89\"\n"), Some("1.89"));
        assert_eq!(rust_version("edition = \"2024\"\n"), None);
    }
}
