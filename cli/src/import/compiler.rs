//! What the compiler says of a model that was written, at the places of the file that it comes from.

use multibody_engine::diagnostics::Diagnostics;
use multibody_engine::syntax;

use crate::build;
use crate::source::File;

use super::Wrong;
use super::write::Written;

pub(super) fn check(written: &Written) -> Result<(), Vec<Wrong>> {
    let text: String = written.lines.iter().map(|line| format!("{}\n", line.text)).collect();
    let found = File { name: "imported".to_owned(), text }.calls();
    let mut all = Vec::new();
    for call in &found.calls {
        let mut diagnostics = Diagnostics::default();
        let source = syntax::parse(call.tokens.clone(), &mut diagnostics);
        build::checked(&source, &mut diagnostics);
        for error in diagnostics.errors() {
            let line = written.lines.get(error.span.start().line.saturating_sub(1));
            let at = line.map_or(0..0, |line| line.origin.clone());
            let link = line.and_then(|line| line.link.as_ref());
            let help = error.help.as_ref().map(|help| match link {
                // What waives a check stands in the model, which is not there yet.
                Some(link) if help.contains("unphysical_inertia") => {
                    format!("published data that break this are taken by `--allow-unphysical {link:?}`")
                }
                _ => help.clone(),
            });
            all.push(Wrong { at, message: error.message.clone(), help });
        }
    }
    if found.calls.is_empty() {
        all.push(Wrong::new(&(0..0), "no model comes of this file"));
    }
    if all.is_empty() { Ok(()) } else { Err(all) }
}
