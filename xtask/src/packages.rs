//! What would be published: the packages say what they are, hold their README and both licences, and hold nothing that
//! only tests need; and each compiles from nothing but its package.

use crate::{Stop, command, output, root};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::{env, fs};

/// In the order in which they would be published.
const PACKAGES: [&str; 5] = ["multibody-engine", "multibody-macros", "multibody", "multibody-parts", "multibody-cli"];

const FILES: [&str; 4] = ["Cargo.toml", "README.md", "LICENSE-MIT", "LICENSE-APACHE"];

/// Folders of a package that its users don't need.
const FOREIGN: [&str; 4] = ["tests/", "benches/", "examples/", "tools/"];

const FIELDS: [&str; 9] = [
    "description",
    "license",
    "repository",
    "readme",
    "rust_version",
    "keywords",
    "categories",
    "documentation",
    "metadata",
];

pub(crate) fn run() -> Result<bool, Stop> {
    let metadata = output(cargo("metadata").args(["--no-deps", "--format-version", "1"]))?;
    let metadata: Value = serde_json::from_str(&metadata)?;
    let mut faults = Vec::new();
    for name in PACKAGES {
        let listed = metadata["packages"].as_array().into_iter().flatten().find(|package| package["name"] == name);
        let Some(package) = listed else { return Err(format!("no package {name}").into()) };
        faults.extend(undeclared(package).map(|field| format!("{name} does not say its {field}")));
        let files = output(cargo("package").args(["--list", "--allow-dirty", "--package", name]))?;
        println!("{name}: {} files", files.lines().count());
        faults.extend(missing(&files).map(|file| format!("{name} has no {file}")));
        faults.extend(foreign(&files).map(|file| format!("{name} holds {file}")));
    }
    for fault in &faults {
        println!("  {fault}");
    }
    if !faults.is_empty() {
        return Ok(false);
    }
    let sources = cargo_home().join("registry/src");
    for copy in unpacked(&sources) {
        fs::remove_dir_all(copy)?;
    }
    let mut publish = cargo("package");
    // That they compile is all that is asked.
    publish.args(["--allow-dirty", "--quiet"]).env("CARGO_PROFILE_DEV_DEBUG", "0");
    for name in PACKAGES {
        publish.args(["--package", name]);
    }
    Ok(publish.status()?.success())
}

fn cargo(name: &str) -> std::process::Command {
    let mut cargo = command("cargo");
    cargo.arg(name).arg("--locked").current_dir(root());
    cargo
}

fn cargo_home() -> PathBuf {
    let home = || Path::new(&env::var_os("HOME").unwrap_or_default()).join(".cargo");
    env::var_os("CARGO_HOME").map_or_else(home, PathBuf::from)
}

/// Our packages as `cargo package` unpacked them before. It puts them into a registry of its own and unpacks what they
/// need of each other below a name made from that registry's path alone, where a copy of the same version stays in
/// force: a checkout in the same place would be held against sources of another day.
fn unpacked(sources: &Path) -> Vec<PathBuf> {
    let entries = |folder: &Path| fs::read_dir(folder).into_iter().flatten().flatten().collect::<Vec<_>>();
    // Registries in folders have no host in front of the dash.
    let local = entries(sources).into_iter().filter(|registry| registry.file_name().to_string_lossy().starts_with('-'));
    local
        .flat_map(|registry| entries(&registry.path()))
        .filter(|copy| PACKAGES.iter().any(|name| copy.file_name().to_string_lossy().starts_with(&format!("{name}-"))))
        .map(|copy| copy.path())
        .collect()
}

/// Fields of a manifest that are empty.
fn undeclared(package: &Value) -> impl Iterator<Item = &'static str> {
    let empty = |value: &Value| value.is_null() || value.as_array().is_some_and(Vec::is_empty);
    let docs = package["metadata"]["docs"]["rs"].is_null();
    FIELDS.into_iter().filter(move |field| if *field == "metadata" { docs } else { empty(&package[*field]) })
}

fn missing(files: &str) -> impl Iterator<Item = &'static str> {
    let has = |wanted: &str| files.lines().any(|file| file == wanted);
    let root = (!has("src/lib.rs") && !has("src/main.rs")).then_some("src/lib.rs or src/main.rs");
    FILES.into_iter().filter(move |wanted| !has(wanted)).chain(root)
}

fn foreign(files: &str) -> impl Iterator<Item = &str> {
    files.lines().filter(|file| FOREIGN.iter().any(|folder| file.starts_with(folder)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn files_that_are_missing_or_foreign() {
        let files = "Cargo.toml\nLICENSE-APACHE\nLICENSE-MIT\nREADME.md\nsrc/lib.rs\n";
        assert_eq!((missing(files).count(), foreign(files).count()), (0, 0));
        assert_eq!(
            missing("Cargo.toml\nLICENSE-APACHE\nLICENSE-MIT\nREADME.md\n").collect::<Vec<_>>(),
            ["src/lib.rs or src/main.rs"]
        );
        let files = "Cargo.toml\nREADME.md\nsrc/lib.rs\nsrc/LICENSE-MIT\ntests/data/arm.json\nsrc/tests/mod.rs\n";
        assert_eq!(missing(files).collect::<Vec<_>>(), ["LICENSE-MIT", "LICENSE-APACHE"]);
        assert_eq!(foreign(files).collect::<Vec<_>>(), ["tests/data/arm.json"]);
    }

    #[test]
    fn copies_of_another_day() {
        let sources = env::temp_dir().join(format!("multibody-packages-{}", std::process::id()));
        let ours = sources.join("-22c3805da5a543b4/multibody-engine-0.1.0");
        for folder in [&ours, &sources.join("-22c3805da5a543b4/syn-2.0.0"), &sources.join("host-1/multibody-0.1.0")] {
            fs::create_dir_all(folder).unwrap();
        }
        assert_eq!(unpacked(&sources), [ours]);
        fs::remove_dir_all(&sources).unwrap();
    }

    #[test]
    fn fields_that_are_empty() {
        let mut package = json!({
            "description": "d", "license": "MIT", "repository": "r", "readme": "README.md", "rust_version": "1.89",
            "keywords": ["k"], "categories": ["c"], "documentation": "d", "metadata": { "docs": { "rs": {} } },
        });
        assert_eq!(undeclared(&package).count(), 0);
        package["keywords"] = json!([]);
        package["readme"] = Value::Null;
        package["metadata"] = Value::Null;
        assert_eq!(undeclared(&package).collect::<Vec<_>>(), ["readme", "keywords", "metadata"]);
    }
}
