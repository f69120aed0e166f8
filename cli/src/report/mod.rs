//! Reports of models: one page each, as HTML or Markdown.
//!
//! In: a model with all that the engine says of it. Out: text. [`contents`] says what stands on the page, [`html`] and
//! [`markdown`] how it is written, the others draw: [`graph`] on [`layers`], [`drawing`] of a [`scene`] in a [`view`] with
//! [`labels`], [`matrix`].

mod contents;
mod document;
mod drawing;
mod graph;
mod html;
mod labels;
mod layers;
mod markdown;
mod matrix;
mod scene;
mod space;
mod svg;
mod view;

use multibody_engine::Trouble;
use multibody_engine::emit::{self, Facts, Unused};
use multibody_engine::invariant::fault::guard;
use multibody_engine::mechanics::loops::structure::Structure;
use multibody_engine::mechanics::written::Page;
use multibody_engine::mechanics::{self, Patterns};
use multibody_engine::model::types::Model;
use multibody_engine::optimize::program::Compiled;

use crate::build::{Built, advised};

/// What a report is written from.
struct Material<'a> {
    model: &'a Model,
    structure: &'a Structure,
    compiled: &'a Compiled,
    /// As it is named on the command line.
    file: &'a str,
    facts: Facts,
    unused: Unused,
    page: Page,
    patterns: Patterns,
}

impl Material<'_> {
    fn name(&self) -> String {
        let name = self.model.name.to_string();
        name.strip_prefix("r#").map_or(name.clone(), str::to_owned)
    }
}

/// One report in each language.
pub(crate) struct Report {
    pub(crate) html: String,
    pub(crate) markdown: String,
}

/// The report of a model.
pub(crate) fn report(model: &Model, file: &str) -> Result<Report, Trouble> {
    let Built { model, structure, compiled } = &advised(model)?;
    let derived =
        guard("mechanics", || Ok((mechanics::page(model, structure)?, mechanics::patterns(model, structure)?)));
    let (page, patterns) = derived.map_err(Trouble::Fault)?.map_err(Trouble::Complaints)?;
    let facts = guard("emit", || (emit::facts(model, structure, compiled), emit::unused(model, structure, compiled)));
    let (facts, unused) = facts.map_err(Trouble::Fault)?;
    let material = Material { model, structure, compiled, file, facts, unused, page, patterns };
    let document = guard("report", || contents::document(&material)).map_err(Trouble::Fault)?;
    Ok(Report { html: html::page(&document), markdown: markdown::page(&document) })
}
