//! Times of what the compiler makes of each choice, in a crate of its own below the target directory.

mod code;
mod package;

use std::fmt::Write;

pub(super) use self::code::Code;
pub(super) use self::package::Package;
use self::package::printed;
use crate::progress;

/// The rest of the crate.
const HARNESS: &str = include_str!("measure/harness.rs");

/// Functions with nanoseconds by call.
pub(super) type Times = Vec<(String, f64)>;

/// What the codes take, in their order; nothing of one that has no finite accelerations near its start.
pub(super) fn measure(package: &mut Package, name: &str, codes: &[&Code]) -> Result<Vec<Times>, String> {
    let modules: Vec<(String, &str)> =
        codes.iter().enumerate().map(|(number, code)| (format!("choice_{number}.rs"), code.text())).collect();
    let main = main(codes.len());
    package.write(&[&modules[..], &[("harness.rs".to_owned(), HARNESS), ("main.rs".to_owned(), &main)]].concat())?;
    let program = progress::during(&format!("compiling `{name}` in {} choices", codes.len()), || package.build())?;
    let lines = progress::during(&format!("timing `{name}`"), || printed(&program))?;
    let mut times = vec![Times::new(); codes.len()];
    for line in lines.lines() {
        let cells: Vec<&str> = line.split('\t').collect();
        let read = || {
            let &[number, function, time] = cells.as_slice() else { return None };
            Some((number.parse::<usize>().ok()?, function.to_owned(), time.parse().ok()?))
        };
        let (number, function, time) = read().ok_or_else(|| format!("{} prints `{line}`", program.display()))?;
        if let Some(times) = times.get_mut(number) {
            times.push((function, time));
        }
    }
    Ok(times)
}

fn main(choices: usize) -> String {
    let mut text = String::from("#![allow(warnings)]\nmod harness;\n");
    for number in 0..choices {
        let _ = writeln!(text, "mod choice_{number};");
    }
    text.push_str("fn main() {\n    let mut subjects = Vec::new();\n");
    for number in 0..choices {
        let _ = writeln!(text, "    subjects.extend(choice_{number}::subjects({number}));");
    }
    text.push_str("    harness::measure(&subjects);\n}\n");
    text
}
