//! Models of other formats, written in the language.
//!
//! `urdf` reads a file into a `robot`, whose links and joints stand as the file has them; `tree` finds what hangs on
//! what; `write` says the same in the language, and `compiler` has the result checked before anybody sees it. What is
//! wrong is told with its place in the file that was read.

mod compiler;
mod inertia;
mod names;
mod number;
mod robot;
mod tree;
mod urdf;
mod write;
mod xml;

use std::ops::Range;

use crate::source::File;

/// What the user decides.
#[derive(Default)]
pub(crate) struct Choice {
    /// The root moves freely; otherwise it stands on the ground.
    pub(crate) floating: bool,
    /// Joints of one coordinate get an input each, the effort that acts on it, but for those that follow others.
    pub(crate) efforts: bool,
    /// Dry friction is left out.
    pub(crate) frictionless: bool,
    /// Links of the file whose inertia is taken although no body can have it.
    pub(crate) unphysical: Vec<String>,
}

/// A mistake of the file.
#[derive(Debug)]
pub(crate) struct Wrong {
    /// Bytes of the file.
    pub(crate) at: Range<usize>,
    pub(crate) message: String,
    pub(crate) help: Option<String>,
}

impl Wrong {
    fn new(at: &Range<usize>, message: impl Into<String>) -> Wrong {
        Wrong { at: at.clone(), message: message.into(), help: None }
    }

    fn help(at: &Range<usize>, message: impl Into<String>, help: impl Into<String>) -> Wrong {
        Wrong { help: Some(help.into()), ..Wrong::new(at, message) }
    }
}

/// A model, and what its reader should know of how it came about.
pub(crate) struct Imported {
    pub(crate) text: String,
    pub(crate) notes: Vec<String>,
}

/// The model of a URDF file. Of several mistakes the reader tells the first one, the compiler all of them.
pub(crate) fn urdf(file: &File, choice: &Choice) -> Result<Imported, Vec<Wrong>> {
    let document = xml::parse(&file.text).map_err(|wrong| vec![wrong])?;
    let (robot, mut notes) = urdf::read(&document, choice).map_err(|wrong| vec![wrong])?;
    let tree = tree::grow(&robot).map_err(|wrong| vec![wrong])?;
    let written = write::write(&robot, &tree, choice, &file.name).map_err(|wrong| vec![wrong])?;
    compiler::check(&written)?;
    notes.extend(written.notes);
    Ok(Imported { text: written.lines.iter().map(|line| format!("{}\n", line.text)).collect(), notes })
}
