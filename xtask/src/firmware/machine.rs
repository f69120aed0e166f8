//! Building the firmware and running it. A target that is installed (`rustup target add thumbv7em-none-eabihf`) is used;
//! otherwise `.ci/embedded-toolchain` makes one in `$EMBEDDED` (target/embedded) from Debian's packages.

use super::symbols;
use super::variants::{Runner, SCENES, Variant};
use crate::{Stop, command, output, root};
use std::env;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::Command;

/// `[s]` that a program may run.
const PATIENCE: &str = "300";

/// Where everything is.
pub(crate) struct Workplace {
    here: PathBuf,
    embedded: PathBuf,
    build: PathBuf,
    installed: Vec<String>,
}

impl Workplace {
    pub(crate) fn find() -> Workplace {
        let here = root().join("examples/firmware");
        let from = |name: &str| env::var_os(name).filter(|value| !value.is_empty()).map(PathBuf::from);
        let mut rustup = command("rustup");
        let installed = rustup.args(["target", "list", "--installed"]).output();
        let installed = installed.map(|output| String::from_utf8_lossy(&output.stdout).into_owned());
        Workplace {
            embedded: from("EMBEDDED").unwrap_or_else(|| root().join("target/embedded")),
            build: from("CARGO_TARGET_DIR").unwrap_or_else(|| here.join("target")),
            // Without rustup no target is known to be there.
            installed: installed.unwrap_or_default().lines().map(str::to_owned).collect(),
            here,
        }
    }

    pub(crate) fn is_installed(&self, target: &str) -> bool {
        self.installed.iter().any(|installed| installed == target)
    }

    pub(crate) fn expected_folder(&self) -> PathBuf {
        self.here.join("expected")
    }

    pub(crate) fn expected(&self, variant: &str) -> PathBuf {
        self.expected_folder().join(format!("{variant}.txt"))
    }

    /// cargo for a target, by its own toolchain or the one from Debian.
    fn cargo(&self, target: Option<&str>) -> Result<Command, Stop> {
        if target.is_none_or(|target| self.is_installed(target)) {
            return Ok(command("cargo"));
        }
        if !self.embedded.join(".packages").metadata().is_ok_and(|file| file.len() > 0) {
            output(command(root().join(".ci/embedded-toolchain")).arg(&self.embedded))?;
        }
        let mut cargo = command(self.embedded.join("bin/embedded"));
        cargo.arg("cargo");
        Ok(cargo)
    }

    /// The arguments of `cargo build` and `cargo rustc` for the firmware.
    fn arguments(&self, cargo: &mut Command, target: Option<&str>, profile: &str, features: &str) {
        cargo.arg("--locked").arg("--manifest-path").arg(self.here.join("Cargo.toml"));
        cargo.arg("--target-dir").arg(&self.build).args(["--profile", profile]);
        if let Some(target) = target {
            cargo.args(["--target", target]);
        }
        if !features.is_empty() {
            cargo.args(["--features", features]);
        }
    }

    /// Everything about one variant.
    pub(crate) fn report(&self, variant: &Variant) -> Result<String, Stop> {
        let mut cargo = self.cargo(variant.target)?;
        cargo.arg(if variant.runner == Runner::Node { "rustc" } else { "build" }).arg("--quiet");
        self.arguments(&mut cargo, variant.target, variant.profile, variant.features);
        match variant.runner {
            Runner::Node => cargo.args(["--lib", "--crate-type", "cdylib"]),
            Runner::Host | Runner::Qemu { .. } => cargo.arg("--bins"),
        };
        cargo.env("RUSTFLAGS", variant.processor.map(|name| format!("-Ctarget-cpu={name}")).unwrap_or_default());
        output(&mut cargo)?;

        let folder = self.build.join(variant.target.unwrap_or_default()).join(variant.profile);
        let mut report = String::new();
        for scene in SCENES {
            writeln!(report, "[{scene}]")?;
            let binary = folder.join(scene);
            match variant.runner {
                Runner::Host => report += &output(&mut command(binary))?,
                Runner::Node => {
                    let mut node = command("node");
                    report +=
                        &output(node.arg(self.here.join("hash.mjs")).arg(folder.join("firmware.wasm")).arg(scene))?;
                }
                runner @ Runner::Qemu { .. } => report += &(emulated(runner, &binary)? + &sizes(&binary)?),
            }
        }
        if matches!(variant.runner, Runner::Qemu { .. }) {
            let bounded = folder.join("bounded");
            write!(report, "[bounded]\n{}{}", emulated(variant.runner, &bounded)?, allocators(&bounded)?)?;
        }
        Ok(report)
    }

    /// A panic that can be reached is an undefined symbol, and the linker says so.
    pub(crate) fn panics(&self) -> Result<Vec<String>, Stop> {
        let target = Some("thumbv7em-none-eabihf");
        let mut cargo = self.cargo(target)?;
        cargo.arg("build");
        self.arguments(&mut cargo, target, "release", "panics");
        let built = cargo.args(["--bin", "panics"]).output()?;
        let said = String::from_utf8_lossy(&built.stderr);
        let mut faults = Vec::new();
        if built.status.success() {
            faults.push("a program with a reachable panic links".to_owned());
        }
        let reason = |line: &str| {
            let symbol = line.split_once("undefined symbol");
            symbol.is_some_and(|(_, symbol)| symbol.contains("a_panic_can_be_reached"))
        };
        if !said.lines().any(reason) {
            faults.push("it fails for another reason".to_owned());
        }
        Ok(faults)
    }
}

/// What a program prints in QEMU.
fn emulated(runner: Runner, binary: &Path) -> Result<String, Stop> {
    let Runner::Qemu { system, board, more, shift } = runner else { return Err("no machine of QEMU".into()) };
    let mut qemu = command("timeout");
    qemu.arg(PATIENCE).arg(format!("qemu-system-{system}")).args(["-machine", board]).args(more);
    qemu.arg("-icount").arg(format!("shift={shift},align=off,sleep=off"));
    qemu.args(["-display", "none", "-serial", "none", "-monitor", "none"]);
    qemu.args(["-semihosting-config", "enable=on,target=native", "-kernel"]).arg(binary);
    output(&mut qemu)
}

/// What a program of binutils says of a binary; nothing is an error.
fn asked(program: &str, arguments: &[&str], binary: &Path) -> Result<String, Stop> {
    let said = output(command(program).args(arguments).arg(binary))?;
    if said.trim().is_empty() {
        Err(format!("{program} says nothing of {}", binary.display()).into())
    } else {
        Ok(said)
    }
}

fn allocators(binary: &Path) -> Result<String, Stop> {
    Ok(format!("allocators: {}\n", symbols::allocators(&asked("nm", &["-C"], binary)?)))
}

fn sizes(binary: &Path) -> Result<String, Stop> {
    let mut lines = allocators(binary)?;
    let doubles = symbols::software_doubles(&asked("nm", &[], binary)?);
    writeln!(lines, "software operations of f64: {doubles}")?;
    let flash = symbols::flash_bytes(&asked("size", &[], binary)?).ok_or("`size` prints no sizes")?;
    writeln!(lines, "flash bytes: {flash}")?;
    writeln!(lines, "ram bytes: {}", symbols::ram_bytes(&asked("size", &["-A"], binary)?))?;
    let (ours, helpers) = symbols::flash(&asked("nm", &["-CS"], binary)?);
    writeln!(lines, "flash of model and method: {ours}\nflash of the compiler's helpers: {helpers}")?;
    Ok(lines)
}
