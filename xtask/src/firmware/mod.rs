//! Builds `examples/firmware` for its targets, runs it in QEMU and node, and compares with `examples/firmware/expected`:
//! results and hashes to the last bit, instructions, stack, flash and RAM with a tolerance. The expected files are made with
//! Debian's packages, which compile core and the compiler's helpers with the firmware. An installed target brings both
//! ready-made and less tightly linked: what they add to flash is printed then, and no reason to fail. `--accept` writes the
//! files anew. Stated bounds hold with no tolerance, as does what is constant.
//!
//! Needs qemu-system-arm and qemu-system-misc, nm and size, and node for the variants wasm32.

mod judge;
mod machine;
mod report;
mod symbols;
mod variants;

use crate::Stop;
use machine::Workplace;
use report::Report;
use std::fs;
use variants::{VARIANTS, Variant};

/// Runs the variants that are named, or all; whether everything is as it should be.
pub(crate) fn run(arguments: &[String]) -> Result<bool, Stop> {
    let accept = arguments.first().is_some_and(|first| first == "--accept");
    let names = &arguments[usize::from(accept)..];
    for name in names {
        if !VARIANTS.iter().any(|variant| variant.name == name) {
            return Err(format!("no variant {name}").into());
        }
    }
    let chosen = |name: &str| names.is_empty() || names.iter().any(|chosen| chosen == name);
    let place = Workplace::find();
    let mut passed = true;
    for variant in VARIANTS.iter().filter(|variant| chosen(variant.name)) {
        println!("{}", variant.name);
        passed &= judged(&place, variant, accept)?;
    }
    if chosen("m4f") {
        println!("panics");
        passed &= told(&place.panics()?);
    }
    passed &= told(&judge::disagreements(&expected(&place)?));
    Ok(passed)
}

/// One variant: built, run, and compared or accepted.
fn judged(place: &Workplace, variant: &Variant, accept: bool) -> Result<bool, Stop> {
    let text = match place.report(variant) {
        Ok(text) => text,
        Err(stop) => return Ok(told(&[format!("does not build or run: {stop}")])),
    };
    let found = Report::parse(&text);
    let mut faults = judge::over_limits(variant.name, &found);
    faults.extend(judge::inconstant(variant, &found));
    let file = place.expected(variant.name);
    if accept {
        fs::create_dir_all(place.expected_folder())?;
        fs::write(file, text)?;
    } else {
        let held = fs::read_to_string(&file).map_err(|error| format!("{}: {error}", file.display()))?;
        let ready_made = variant.target.is_some_and(|target| place.is_installed(target));
        let differences = judge::compare(&Report::parse(&held), &found, ready_made);
        for change in differences.tolerated {
            println!("  {change}");
        }
        faults.extend(differences.faults);
    }
    Ok(told(&faults))
}

/// Prints faults; whether there is none.
fn told(faults: &[String]) -> bool {
    for fault in faults {
        println!("  {fault}");
    }
    faults.is_empty()
}

/// All expected files, by the name of their variant.
fn expected(place: &Workplace) -> Result<Vec<(String, Report)>, Stop> {
    let mut files: Vec<_> = fs::read_dir(place.expected_folder())?.collect::<Result<_, _>>()?;
    files.sort_by_key(fs::DirEntry::path);
    let mut reports = Vec::new();
    for file in files {
        if let Some(name) = file.file_name().to_string_lossy().strip_suffix(".txt") {
            reports.push((name.to_owned(), Report::parse(&fs::read_to_string(file.path())?)));
        }
    }
    Ok(reports)
}
