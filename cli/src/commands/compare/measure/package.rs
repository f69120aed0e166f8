//! The crate that is measured: which library it depends on, where it stands, how it is built and run.

use std::env;
use std::ffi::OsString;
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;

const LIBRARY: &str = "multibody";
const VERSION: &str = env!("CARGO_PKG_VERSION");
/// Below the target directory.
const FOLDER: &str = "multibody/measure";

pub(in crate::commands::compare) struct Package {
    root: PathBuf,
    /// The triple of this computer, for which is compiled whatever the user's crate is for.
    host: String,
    /// Where the user's file stands: configuration of cargo and the toolchain are those of this folder.
    folder: PathBuf,
    /// The one dependency.
    dependency: String,
    /// The user's, so that dependencies are the same.
    lock: Option<PathBuf>,
    /// Held while files are written and run.
    held: Option<File>,
}

impl Package {
    /// With the library of the package that the file belongs to, or the published one of this version.
    pub(in crate::commands::compare) fn beside(file: &Path) -> Result<Package, String> {
        let folder = file.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let folder = fs::canonicalize(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
        let rustc = env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
        let host = run(Command::new(rustc).args(["--print", "host-tuple"]).current_dir(&folder), "rustc")?;
        let published = Package {
            host: String::from_utf8_lossy(&host.stdout).trim().to_owned(),
            root: env::var_os("CARGO_TARGET_DIR").map_or("target".into(), PathBuf::from).join(FOLDER),
            folder: folder.clone(),
            dependency: format!("{LIBRARY} = \"={VERSION}\""),
            lock: None,
            held: None,
        };
        let package = match folder.ancestors().any(|folder| folder.join("Cargo.toml").is_file()) {
            true => Package::of_user(published)?,
            false => published,
        };
        let root =
            std::path::absolute(&package.root).map_err(|error| format!("{}: {error}", package.root.display()))?;
        Ok(Package { root, ..package })
    }

    fn of_user(published: Package) -> Result<Package, String> {
        let folder = &published.folder;
        let output =
            run(Command::new(cargo()).args(["metadata", "--format-version", "1"]).current_dir(folder), "cargo")?;
        if !output.status.success() {
            return Err(format!("`cargo metadata` fails in {}: {}", folder.display(), complaint(&output)));
        }
        let data: Value = serde_json::from_slice(&output.stdout)
            .map_err(|error| format!("what `cargo metadata` prints cannot be read: {error}"))?;
        let text = |value: &Value, key: &str| value[key].as_str().unwrap_or_default().to_owned();
        let root = Path::new(&text(&data, "target_directory")).join(FOLDER);
        let libraries: Vec<&Value> =
            data["packages"].as_array().into_iter().flatten().filter(|package| package["name"] == LIBRARY).collect();
        let Some(first) = libraries.first() else { return Ok(Package { root, ..published }) };
        let Some(library) = libraries.iter().find(|library| library["version"] == VERSION) else {
            return Err(format!(
                "the package in {} depends on multibody {}, and this is cargo-multibody {VERSION}: \
                 install `multibody-cli` of the library's version",
                folder.display(),
                text(first, "version")
            ));
        };
        let nodes = data["resolve"]["nodes"].as_array().into_iter().flatten();
        let features = nodes.filter(|node| node["id"] == library["id"]).flat_map(|node| node["features"].as_array());
        let features: Vec<&str> = features.flatten().filter_map(Value::as_str).collect();
        let manifest = PathBuf::from(text(library, "manifest_path"));
        let dependency = format!(
            "{LIBRARY} = {{ path = {:?}, default-features = false, features = {features:?} }}",
            manifest.parent().unwrap_or(Path::new("/"))
        );
        let lock = Path::new(&text(&data, "workspace_root")).join("Cargo.lock");
        let lock = Some(lock).filter(|lock| lock.is_file());
        Ok(Package { root, dependency, lock, ..published })
    }

    /// Writes it anew. Another run that measures is waited for.
    pub(super) fn write(&mut self, sources: &[(String, &str)]) -> Result<(), String> {
        let refused = |error: io::Error| format!("{}: {error}", self.root.display());
        let source = self.root.join("src");
        fs::create_dir_all(&self.root).map_err(refused)?;
        // A run waits for its own lock too.
        self.held = None;
        let held = File::create(self.root.join("lock")).and_then(|file| file.lock().map(|()| file)).map_err(refused)?;
        if source.is_dir() {
            fs::remove_dir_all(&source).map_err(refused)?;
        }
        fs::create_dir_all(&source).map_err(refused)?;
        let manifest = format!(
            "[package]\nname = \"measure\"\nversion = \"0.0.0\"\nedition = \"2024\"\npublish = false\n\n[workspace]\n\n\
             [dependencies]\n{}\n",
            self.dependency
        );
        fs::write(self.root.join("Cargo.toml"), manifest).map_err(refused)?;
        if let Some(lock) = &self.lock {
            fs::copy(lock, self.root.join("Cargo.lock")).map_err(refused)?;
        }
        for (name, text) in sources {
            fs::write(source.join(name), text).map_err(refused)?;
        }
        self.held = Some(held);
        Ok(())
    }

    /// Compiles it. Returns the program.
    pub(super) fn build(&self) -> Result<PathBuf, String> {
        let target = self.root.join("target");
        let mut command = Command::new(cargo());
        command.args(["build", "--release", "--color", "never", "--target", &self.host]).current_dir(&self.folder);
        command.arg("--manifest-path").arg(self.root.join("Cargo.toml")).arg("--target-dir").arg(&target);
        // All that the user's lock file names is here already.
        if self.lock.is_some() {
            command.arg("--offline");
        }
        let output = run(&mut command, "cargo")?;
        if !output.status.success() {
            return Err(format!("{} cannot be compiled: {}", self.root.display(), complaint(&output)));
        }
        Ok(target.join(&self.host).join("release").join(format!("measure{}", env::consts::EXE_SUFFIX)))
    }
}

/// What the program prints.
pub(super) fn printed(program: &Path) -> Result<String, String> {
    let output = run(&mut Command::new(program), &program.display().to_string())?;
    match output.status.success() {
        true => Ok(String::from_utf8_lossy(&output.stdout).into_owned()),
        false => Err(format!("{} has failed: {}", program.display(), String::from_utf8_lossy(&output.stderr).trim())),
    }
}

/// As cargo tells the commands that it runs.
fn cargo() -> OsString {
    env::var_os("CARGO").unwrap_or_else(|| "cargo".into())
}

fn run(command: &mut Command, name: &str) -> Result<Output, String> {
    command.output().map_err(|error| format!("`{name}` cannot be run, which `--measure` needs: {error}"))
}

/// The first error that cargo tells, with the lines that belong to it.
fn complaint(output: &Output) -> String {
    let messages = String::from_utf8_lossy(&output.stderr);
    let error = messages.lines().skip_while(|line| !line.starts_with("error")).take_while(|line| !line.is_empty());
    let error: Vec<&str> = error.take(8).collect();
    if error.is_empty() { messages.trim().to_owned() } else { error.join("\n") }
}
