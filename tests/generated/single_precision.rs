//! Code in single precision holds no instruction of double precision, but for what decides about steps and iterations:
//! the optimised assembly of `tests/single`.

use crate::{apart, cargo, host};

/// Arithmetic, comparison and conversion of doubles on x86-64, scalar or packed, with or without the `v` of AVX and FMA.
/// Moves, shuffles and logic do not count: compilers move pairs of floats as one double.
fn is_double(mnemonic: &str) -> bool {
    let name = mnemonic.strip_prefix('v').unwrap_or(mnemonic);
    if name.starts_with("cvt") {
        return name.contains("sd") || name.contains("pd");
    }
    let double = name.ends_with("sd") || name.ends_with("pd");
    let computes =
        ["add", "sub", "mul", "div", "sqrt", "min", "max", "cmp", "comi", "ucomi", "round", "h", "dp", "fm", "fnm"];
    double && computes.iter().any(|start| name.starts_with(start))
}

/// Functions by their label, with the mnemonics in them that are of double precision.
fn doubles(assembly: &str) -> (usize, Vec<(String, String)>) {
    let (mut function, mut instructions, mut found) = (String::new(), 0, Vec::new());
    for line in assembly.lines() {
        if let Some(label) = line.strip_suffix(':').filter(|label| !label.starts_with([' ', '\t', '.'])) {
            function = label.to_owned();
        } else if let Some(text) = line.strip_prefix('\t').filter(|text| !text.starts_with(['.', '#'])) {
            instructions += 1;
            let mnemonic = text.split_whitespace().next().unwrap_or_default();
            if is_double(mnemonic) {
                found.push((function.clone(), text.to_owned()));
            }
        }
    }
    (instructions, found)
}

/// Whether a function decides how long steps are and when an iteration ends: the loop over steps, which keeps time in
/// double precision for every scalar, the choice of steps, and what ends the iterations of implicit methods.
fn decides(function: &str) -> bool {
    // As both manglings of names have them.
    let controls = [
        "controlled_",
        "integrators7control",
        "integrators6course",
        "integrators7outlook",
        "integrators3run",
        "5radau6newton",
        "5radau5Radau",
        "radau..Radau",
        // What tells of a failure.
        "worst_equation",
    ];
    controls.iter().any(|name| function.contains(name))
}

/// Whether a function of the projection or the assembly converts its tolerance, or the residual of a failure: not arithmetic.
fn converts((function, text): &(String, String)) -> bool {
    let closes = ["closed_linkage", "projection"].iter().any(|name| function.contains(name));
    closes && ["cvtsd2ss", "cvtss2sd"].iter().any(|mnemonic| text.trim_start_matches('v').starts_with(mnemonic))
}

#[test]
fn doubles_are_found_where_there_are_some() {
    let assembly = "one:\n\tmovsd\t(%rdi), %xmm0\n\taddss\t%xmm0, %xmm1\ntwo:\n\tcvtss2sd\t%xmm0, %xmm0\n\tvfmadd231sd\t%xmm1, \
                    %xmm2, %xmm0\n\tunpcklpd\t%xmm0, %xmm0\n\tucomisd\t%xmm0, %xmm1\n";
    let (instructions, found) = doubles(assembly);
    assert_eq!(instructions, 6);
    let names: Vec<_> = found.iter().map(|(function, text)| format!("{function} {}", &text[..8])).collect();
    assert_eq!(names, ["two cvtss2sd", "two vfmadd23", "two ucomisd\t"]);
}

#[test]
fn steps_in_single_precision_hold_no_double() {
    if !cfg!(all(target_arch = "x86_64", unix)) {
        println!("skipped: the assembly of another machine than x86-64");
        return;
    }
    let output = cargo("rustc", concat!(env!("CARGO_MANIFEST_DIR"), "/single"))
        .args(["--locked", "--lib", "--", "--emit", "asm"])
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));

    // The newest one: older builds leave theirs.
    let files = std::fs::read_dir(apart().join(host()).join("debug/deps")).unwrap().map(|entry| entry.unwrap());
    let ours = files.filter(|file| {
        let name = file.file_name().into_string().unwrap();
        name.starts_with("multibody_single-") && name.ends_with(".s")
    });
    let newest = ours.max_by_key(|file| file.metadata().unwrap().modified().unwrap()).unwrap();
    let assembly = std::fs::read_to_string(newest.path()).unwrap();

    let steps = assembly.lines().filter(|line| line.ends_with(':') && line.contains("single_")).count();
    let (instructions, found) = doubles(&assembly);
    // What decides about steps and iterations does so in double precision, by some operations for each of them.
    let (deciding, found): (Vec<_>, Vec<_>) = found.into_iter().partition(|(function, _)| decides(function));
    let found: Vec<_> = found.into_iter().filter(|found| !converts(found)).collect();
    println!(
        "{steps} functions, {instructions} instructions, {} of double precision, and {} that decide",
        found.len(),
        deciding.len()
    );
    assert!(steps >= 20 && instructions > 10_000, "the assembly is not what it should be");
    assert!(deciding.len() < 450, "{} decide: is something computed with the state among them?", deciding.len());
    for (function, text) in found.iter().take(20) {
        println!("{function}: {text}");
    }
    assert!(found.is_empty(), "{} instructions of double precision", found.len());
}
