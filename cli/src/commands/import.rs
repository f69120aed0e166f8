//! `import`: a model of another format in the language.

use std::ops::Range;
use std::path::Path;

use proc_macro2::LineColumn;

use crate::Stop;
use crate::build;
use crate::import::{self, Choice, Wrong};
use crate::said::Mistake;
use crate::source::File;

pub(crate) fn run(path: &Path, choice: &Choice) -> Result<String, Stop> {
    let file = File::read(path).map_err(Stop::Usage)?;
    match import::urdf(&file, choice) {
        Ok(imported) => {
            imported.notes.iter().for_each(|note| eprintln!("note: {note}"));
            Ok(imported.text)
        }
        Err(wrong) => {
            let mistakes: Vec<Mistake> = wrong.into_iter().map(|wrong| mistake(&file.text, wrong)).collect();
            build::tell(&file, &mistakes)?;
            Ok(String::new())
        }
    }
}

fn mistake(text: &str, Wrong { at: Range { start, end }, message, help }: Wrong) -> Mistake {
    Mistake { start: place(text, start), end: place(text, end), message, help }
}

/// Lines are counted from one, columns from zero. A byte within a letter stands for that letter.
fn place(text: &str, byte: usize) -> LineColumn {
    let start = (0..=byte).rev().find(|&byte| text.is_char_boundary(byte)).unwrap_or_default();
    let before = &text[..start];
    let line = before.rfind('\n').map_or(0, |newline| newline + 1);
    LineColumn { line: before.matches('\n').count() + 1, column: before[line..].chars().count() }
}
