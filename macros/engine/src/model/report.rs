//! Stage `model`: errors of this stage, each once.
//!
//! In: mistakes, found anew in every instance of a part. Out: one diagnostic per mistake.

use std::collections::HashSet;

use proc_macro2::Span;

use crate::diagnostics::{Diagnostics, nearest};

/// Mistakes that get a suggestion.
const MAX_SUGGESTIONS: usize = 100;

/// Passes errors on, and drops those that another instance of the same part has given already.
pub(super) struct Report<'d> {
    diagnostics: &'d mut Diagnostics,
    seen: HashSet<(String, String)>,
    /// Set by any error, also by one that had been reported before.
    failed: bool,
    /// All has been said.
    muted: bool,
}

impl<'d> Report<'d> {
    pub(super) fn new(diagnostics: &'d mut Diagnostics) -> Self {
        Report { diagnostics, seen: HashSet::new(), failed: false, muted: false }
    }

    /// Whether anything went wrong since the last call.
    pub(super) fn take_failed(&mut self) -> bool {
        std::mem::take(&mut self.failed)
    }

    /// Whether anything went wrong so far.
    pub(super) fn failed(&self) -> bool {
        self.failed
    }

    /// Whether suggestions are still made.
    pub(super) fn suggests(&self) -> bool {
        !self.muted && self.seen.len() < MAX_SUGGESTIONS
    }

    /// Whether so much is wrong that nobody's meaning is guessed at any more.
    pub(super) fn is_hopeless(&self) -> bool {
        self.seen.len() >= MAX_SUGGESTIONS
    }

    /// From here on, or until this is called again, mistakes are not reported: what they leave is looked at once more.
    pub(super) fn mute(&mut self, muted: bool) {
        self.muted = muted;
    }

    /// The parser has reported this one: the model is lost, nothing is said.
    pub(super) fn silent(&mut self) {
        self.failed = true;
    }

    pub(super) fn error(&mut self, span: Span, message: impl Into<String>) {
        let message = message.into();
        if self.is_new(span, &message) {
            self.diagnostics.error(span, message);
        }
    }

    pub(super) fn help(&mut self, span: Span, message: impl Into<String>, help: impl Into<String>) {
        let message = message.into();
        if self.is_new(span, &message) {
            self.diagnostics.error_help(span, message, help);
        }
    }

    /// An error about a name that isn't there, with the nearest one that is.
    pub(super) fn unknown<'a>(
        &mut self,
        span: Span,
        message: impl Into<String>,
        name: &str,
        candidates: impl IntoIterator<Item = &'a str>,
        otherwise: Option<String>,
    ) {
        // After so many mistakes a suggestion helps nobody, and takes time.
        let near =
            self.suggests().then(|| nearest(name, candidates)).flatten().map(|near| format!("did you mean `{near}`?"));
        match near.or(otherwise) {
            Some(help) => self.help(span, message, help),
            None => self.error(span, message),
        }
    }

    /// Numbers don't count: `FEET[i]` out of range for 3, 4 and 5 is one mistake. Where spans carry no place (outside
    /// the compiler, without `span-locations`), equal messages are one as well.
    fn is_new(&mut self, span: Span, message: &str) -> bool {
        self.failed = true;
        if self.muted {
            return false;
        }
        let mut text = String::with_capacity(message.len());
        let mut in_number = false;
        for c in message.chars() {
            let in_name = text.ends_with(|last: char| last.is_alphanumeric() || last == '_');
            in_number = c.is_ascii_digit() && (in_number || !in_name);
            if !in_number {
                text.push(c);
            }
        }
        self.seen.insert((format!("{span:?}"), text))
    }
}
