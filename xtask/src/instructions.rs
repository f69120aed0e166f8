//! Instructions of the functions in `benches/instructions.rs`, as callgrind counts them, against `benches/instructions.txt`.
//!
//! A count changes with the compiler, and where a single sine is the platform's with the C library and its choice for the processor. So
//! the file names these, and elsewhere counts are shown and judged by nobody. With the same ones a count that is off by more than [`TOLERANCE`] fails, less or more: `--accept` writes the file
//! anew, to be read in review.

use crate::{Stop, command, output, root};
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs;
use std::path::PathBuf;

/// The share by which a count may change.
const TOLERANCE: f64 = 0.02;

/// Instructions of a call, by function.
type Counts = BTreeMap<String, u64>;

pub(crate) fn run(accept: bool) -> Result<bool, Stop> {
    let runner = runner()?;
    let mut bench = command("cargo");
    bench.args(["bench", "--quiet", "--package", "multibody-benches", "--bench", "instructions", "--"]);
    bench.arg("--output-format=json").env("GUNGRAUN_RUNNER", runner).env_remove("RUSTFLAGS").current_dir(root());
    let counts = parse(&output(&mut bench)?)?;
    let (makers, path) = (makers()?, root().join("benches/instructions.txt"));
    if accept {
        fs::write(path, text(&makers, &counts))?;
        return Ok(true);
    }
    let (made_by, expected) = read(&fs::read_to_string(path)?)?;
    let comparable = made_by == makers;
    if !comparable {
        println!("counts are those of {made_by}, this is {makers}: none is judged");
    }
    let mut passed = counts.keys().eq(expected.keys());
    if !passed {
        println!("the functions are not those of benches/instructions.txt");
    }
    for (name, &count) in &counts {
        let Some(&before) = expected.get(name) else { continue };
        let change = count as f64 / before as f64 - 1.0;
        if change.abs() > TOLERANCE {
            println!("{name}: {count} instructions, {before} before, {:+.1} %", 100.0 * change);
            passed &= !comparable;
        }
    }
    println!("{} functions", counts.len());
    Ok(passed)
}

/// What counts depend on.
fn makers() -> Result<String, Stop> {
    let compiler = output(command("rustc").arg("--version"))?;
    let library = output(command("ldd").arg("--version")).unwrap_or_default();
    let processor = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let fused = if processor.split_whitespace().any(|flag| flag == "fma") { "fma" } else { "no fma" };
    Ok(format!("{}; {}; {fused}", compiler.trim(), library.lines().next().unwrap_or("another C library").trim()))
}

/// The program that runs such benches, in the version of its library; installed into `target/tools`.
fn runner() -> Result<PathBuf, Stop> {
    let lock = fs::read_to_string(root().join("Cargo.lock"))?;
    let version = lock
        .split("[[package]]")
        .find_map(|package| package.trim().strip_prefix("name = \"gungraun-runner\"\nversion = \"")?.split('"').next())
        .ok_or("Cargo.lock has no gungraun-runner")?;
    let tools = root().canonicalize()?.join("target/tools");
    let mut install = command("cargo");
    install.args(["install", "--quiet", "--debug", "--locked", "gungraun-runner", "--version", version, "--root"]);
    output(install.arg(&tools).current_dir(root()))?; // nothing is done where it is there
    Ok(tools.join("bin/gungraun-runner"))
}

/// What the runner prints: a line of JSON for each function.
fn parse(printed: &str) -> Result<Counts, Stop> {
    let mut counts = Counts::new();
    for line in printed.lines().filter(|line| line.starts_with('{')) {
        let bench: Value = serde_json::from_str(line)?;
        let name = bench["module_path"].as_str().ok_or("a bench without a name")?;
        let tool = &bench["profiles"][0]["data"]["total"]["metrics"];
        let count = find(tool, "Ir").and_then(|ir| find(ir, "new")).and_then(Value::as_u64);
        let name = name.trim_start_matches("instructions::").to_owned();
        counts.insert(name, count.ok_or("a bench without a count of instructions")?);
    }
    if counts.is_empty() { Err("no counts were printed".into()) } else { Ok(counts) }
}

/// The value with this key, wherever it stands.
fn find<'a>(value: &'a Value, key: &str) -> Option<&'a Value> {
    match value {
        Value::Object(map) => map.get(key).or_else(|| map.values().find_map(|inner| find(inner, key))),
        Value::Array(list) => list.iter().find_map(|inner| find(inner, key)),
        _ => None,
    }
}

fn text(makers: &str, counts: &Counts) -> String {
    let lines = counts.iter().map(|(name, count)| format!("{name} {count}\n"));
    std::iter::once(format!("{makers}\n")).chain(lines).collect()
}

fn read(text: &str) -> Result<(String, Counts), Stop> {
    let (makers, lines) = text.split_once('\n').ok_or("benches/instructions.txt is empty")?;
    let mut counts = Counts::new();
    for line in lines.lines() {
        let (name, count) = line.split_once(' ').ok_or("a line of benches/instructions.txt has no count")?;
        counts.insert(name.to_owned(), count.parse()?);
    }
    Ok((makers.to_owned(), counts))
}

#[cfg(test)]
mod tests {
    use super::{Counts, parse, read, text};

    const LINE: &str = r#"{"module_path":"instructions::panda::mass_matrix","profiles":[{"data":{"total":{"metrics":
        {"Callgrind":{"Ir":{"metrics":{"values":{"new":1090}}},"Dr":{"metrics":{"values":{"new":5}}}}}}}}]}"#;

    #[test]
    fn counts_are_read() {
        let counts = parse(&format!("Running\n{}\n", LINE.replace('\n', ""))).unwrap();
        assert_eq!(counts, Counts::from([("panda::mass_matrix".to_owned(), 1090)]));
        assert!(parse("Running\n").is_err());
        assert_eq!(read(&text("rustc 1.95.0", &counts)).unwrap(), ("rustc 1.95.0".to_owned(), counts));
    }
}
