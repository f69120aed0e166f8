//! Whether a report is what it should be.

use super::report::Report;
use super::variants::{BRANCHING, ITERATING, JUMPING, LIMITS, SCENES, Variant};
use std::collections::BTreeSet;

/// [%] by which counts may change.
const TOLERANCE: f64 = 5.0;

/// What differs from the expected file.
#[derive(Debug, Default)]
pub(crate) struct Differences {
    pub(crate) tolerated: Vec<String>,
    pub(crate) faults: Vec<String>,
}

/// Text must be the same; counts may change within the tolerance, and what was compiled beforehand (`ready_made`) may take
/// whatever flash it takes.
pub(crate) fn compare(expected: &Report, found: &Report, ready_made: bool) -> Differences {
    let mut differences = Differences::default();
    for line in &found.lines {
        let (scene, key, value) = (&line.scene, &line.key, &line.value);
        let before = expected.get(scene, key);
        if before.is_some_and(|before| before.value == *value) {
            continue;
        }
        let was = before.map_or("", |before| before.value.as_str());
        let counted = ["instructions", "bytes", "flash"].iter().any(|word| key.contains(word));
        let count = before.map_or(0, super::report::Line::count);
        if !counted || count == 0 {
            differences.faults.push(format!("[{scene}] {key}: {value}, was {was}"));
            continue;
        }
        let change = 100.0 * (line.count() as f64 - count as f64) / count as f64;
        let text = format!("[{scene}] {key}: {value}, was {was} ({change:+.1} %)");
        let may_be_larger = ready_made && (key == "flash bytes" || key.contains("helpers"));
        let list = if change.abs() > TOLERANCE && !may_be_larger {
            &mut differences.faults
        } else {
            &mut differences.tolerated
        };
        list.push(text);
    }
    let missing = expected.lines.iter().filter(|line| found.get(&line.scene, &line.key).is_none());
    differences.faults.extend(missing.map(|line| format!("missing: [{}]{}", line.scene, line.key)));
    differences
}

/// Stated bounds that are exceeded, or whose count is not there.
pub(crate) fn over_limits(variant: &str, found: &Report) -> Vec<String> {
    let limits = LIMITS.iter().filter(|limit| limit.0 == variant);
    let over = limits.filter_map(|&(_, scene, key, most)| match found.get(scene, key) {
        None => Some(format!("not measured: [{scene}]{key}")),
        Some(line) if line.count() > most => Some(format!("[{scene}] {key}: {}, at most {most}", line.value)),
        Some(_) => None,
    });
    over.collect()
}

/// Memory that is allocated, and counts that depend on the numbers where they should not. With roots by instruction one
/// count holds for every input up to the limit of subtraction, and in f32 on a Cortex-M one for all beyond.
pub(crate) fn inconstant(variant: &Variant, found: &Report) -> Vec<String> {
    let mut faults = Vec::new();
    for scene in &found.scenes {
        let value = |key: &str| found.get(scene, key).map_or("", |line| line.value.as_str());
        let mut equal = |a: &str, b: &str| {
            if value(a) != value(b) {
                faults.push(format!("[{scene}] {a}: {}, but {b}: {}", value(a), value(b)));
            }
        };
        let measured = found.get(scene, "instructions, most").is_some();
        let varies = ITERATING.contains(&scene.as_str()) || BRANCHING.contains(&(variant.name, scene));
        if measured && variant.features.contains("hardware-root") && !varies {
            equal("instructions, least", "instructions, most");
            equal("instructions, least, NaN", "instructions, most, NaN");
            // Elsewhere wide integers are shifted with jumps.
            if !variant.features.contains("double") && !variant.name.starts_with("riscv") {
                equal("instructions, least, angles beyond the limit", "instructions, most, angles beyond the limit");
            }
            if !JUMPING.contains(&(variant.name, scene)) {
                equal("instructions, most", "instructions, most, NaN");
            }
        }
    }
    let allocating = found.lines.iter().filter(|line| line.key == "allocators" && line.value != "0");
    faults.extend(allocating.map(|line| format!("[{}] allocators: {}", line.scene, line.value)));
    faults
}

/// One hash for each scene and scalar, whatever the machine.
pub(crate) fn disagreements(expected: &[(String, Report)]) -> Vec<String> {
    let mut faults = Vec::new();
    for scalar in ["", "-f64"] {
        for scene in SCENES {
            let its = expected.iter().filter(|(name, _)| name.ends_with("-f64") != scalar.is_empty());
            let lines = its.flat_map(|(_, report)| &report.lines);
            let hashes = lines.filter(|line| line.scene == scene && line.key.starts_with("hash"));
            let hashes: BTreeSet<_> = hashes.map(|line| &line.value).collect();
            if hashes.len() != 1 {
                faults.push(format!("{scene}{scalar}: machines disagree: {hashes:?}"));
            }
        }
    }
    faults
}

#[cfg(test)]
mod tests {
    use super::super::variants::VARIANTS;
    use super::*;

    const HELD: &str = "[panda]\nscene: panda, f32\ninstructions, most: 1000\nstack bytes: 0\nflash bytes: 100\n";

    fn faults(found: &str, ready_made: bool) -> (usize, usize) {
        let differences = compare(&Report::parse(HELD), &Report::parse(found), ready_made);
        (differences.tolerated.len(), differences.faults.len())
    }

    #[test]
    fn the_same_is_no_difference() {
        assert_eq!(faults(HELD, false), (0, 0));
    }

    #[test]
    fn counts_have_a_tolerance_and_text_has_none() {
        assert_eq!(faults(&HELD.replace("1000", "1050"), false), (1, 0));
        assert_eq!(faults(&HELD.replace("1000", "1051"), false), (0, 1));
        assert_eq!(faults(&HELD.replace("1000", "949"), false), (0, 1));
        assert_eq!(faults(&HELD.replace("f32", "f64"), false), (0, 1));
        // Nothing can be taken relative to nothing.
        assert_eq!(faults(&HELD.replace("stack bytes: 0", "stack bytes: 1"), false), (0, 1));
    }

    #[test]
    fn what_is_ready_made_may_take_flash() {
        let larger = HELD.replace("flash bytes: 100", "flash bytes: 200");
        assert_eq!(faults(&larger, false), (0, 1));
        assert_eq!(faults(&larger, true), (1, 0));
        assert_eq!(faults(&HELD.replace("1000", "1100"), true), (0, 1));
    }

    #[test]
    fn what_is_missing_or_new_is_a_fault() {
        assert_eq!(faults(&HELD.replace("stack bytes: 0\n", ""), false), (0, 1));
        assert_eq!(faults(&format!("{HELD}ram bytes: 1\n"), false), (0, 1));
    }

    #[test]
    fn limits_hold_without_tolerance() {
        let report = |most: u32| Report::parse(&format!("[panda]\ninstructions, most: {most}\n"));
        assert!(over_limits("m7-f64", &report(1800)).is_empty());
        assert_eq!(over_limits("m7-f64", &report(1801)), ["[panda] instructions, most: 1801, at most 1800"]);
        assert_eq!(over_limits("m7-f64", &Report::parse("[panda]\n")), ["not measured: [panda]instructions, most"]);
        assert!(over_limits("host", &report(1801)).is_empty());
    }

    fn count(variant: &str, scene: &str, counts: [u32; 6]) -> usize {
        let [least, most, far_least, far_most, nan_least, nan_most] = counts;
        let text = format!(
            "[{scene}]\ninstructions, least: {least}\ninstructions, most: {most}\ninstructions, least, angles beyond the \
             limit: {far_least}\ninstructions, most, angles beyond the limit: {far_most}\ninstructions, least, NaN: \
             {nan_least}\ninstructions, most, NaN: {nan_most}\nallocators: 0\n"
        );
        let variant = VARIANTS.iter().find(|known| known.name == variant).unwrap();
        inconstant(variant, &Report::parse(&text)).len()
    }

    #[test]
    fn constant_counts() {
        assert_eq!(count("m4f", "panda", [5, 5, 7, 7, 5, 5]), 0);
        assert_eq!(count("m4f", "panda", [4, 5, 7, 7, 5, 5]), 1);
        assert_eq!(count("m4f", "panda", [5, 5, 6, 7, 5, 5]), 1);
        assert_eq!(count("m4f", "panda", [5, 5, 7, 7, 4, 5]), 1);
        assert_eq!(count("m4f", "panda", [5, 5, 7, 7, 4, 4]), 1);
        // Where wide integers are shifted with jumps.
        assert_eq!(count("m7-f64", "panda", [5, 5, 6, 7, 5, 5]), 0);
        assert_eq!(count("riscv32", "panda", [5, 5, 6, 7, 5, 5]), 0);
        assert_eq!(count("riscv32", "panda", [5, 5, 6, 7, 4, 4]), 1);
        assert_eq!(count("riscv32", "cart_pole", [5, 5, 6, 7, 4, 4]), 0);
        // Where pivots are looked at by jumps.
        assert_eq!(count("riscv32", "rolling", [4, 5, 6, 7, 4, 4]), 0);
        assert_eq!(count("m4f", "rolling", [4, 5, 7, 7, 5, 5]), 1);
        // Where iterations end when they are close enough, and without an instruction for roots.
        assert_eq!(count("m4f", "newton", [4, 5, 6, 7, 1, 2]), 0);
        assert_eq!(count("m4f-f64", "panda", [4, 5, 6, 7, 1, 2]), 0);
    }

    #[test]
    fn allocations_are_found() {
        let report = Report::parse("[panda]\nallocators: 2\n");
        assert_eq!(inconstant(&VARIANTS[0], &report), ["[panda] allocators: 2"]);
    }

    #[test]
    fn machines_agree_by_scalar() {
        let report = |hash: &str| {
            let text: Vec<_> = SCENES.iter().map(|scene| format!("[{scene}]\nhash of 9 results: {hash}\n")).collect();
            Report::parse(&text.concat())
        };
        let named = |name: &str, hash: &str| (name.to_owned(), report(hash));
        let agreeing = [named("host", "a"), named("m4f", "a"), named("host-f64", "b"), named("m4f-f64", "b")];
        assert!(disagreements(&agreeing).is_empty());
        let one_off = [named("host", "a"), named("m4f", "c"), named("host-f64", "b")];
        assert_eq!(disagreements(&one_off).len(), SCENES.len());
        assert_eq!(disagreements(&one_off[..1]).len(), SCENES.len(), "no f64 at all");
    }
}
