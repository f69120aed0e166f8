//! Mistakes as the compiler tells them: what, what to do, where, and the line itself.

use multibody_engine::diagnostics::Diagnostic;
use proc_macro2::LineColumn;

use crate::source::File;

/// One mistake. Lines are counted from one, columns from zero, as spans have them.
pub(crate) struct Mistake {
    pub(crate) start: LineColumn,
    /// Behind the last letter.
    pub(crate) end: LineColumn,
    pub(crate) message: String,
    pub(crate) help: Option<String>,
}

impl Mistake {
    /// Of the engine; what belongs to no token belongs to the call.
    pub(crate) fn of(diagnostic: &Diagnostic, call: LineColumn) -> Mistake {
        let (mut start, mut end) = (diagnostic.span.start(), diagnostic.span.end());
        if (start.line, start.column) < (call.line, call.column) {
            (start, end) = (call, call);
        }
        Mistake { start, end, message: diagnostic.message.clone(), help: diagnostic.help.clone() }
    }

    /// ```text
    /// error: unknown field `axs`
    ///   help: did you mean `axis`?
    ///  --> src/arm.rs:7:30
    ///   |
    /// 7 |     joint hinge: Revolute { parent: ground, child: rod, axs: Z }
    ///   |                                                         ^^^
    /// ```
    pub(crate) fn text(&self, file: &File) -> String {
        let LineColumn { line, column } = self.start;
        let help = self.help.as_ref().map_or_else(String::new, |help| format!("  help: {help}\n"));
        let number = line.to_string();
        let margin = " ".repeat(number.len());
        let head = format!("error: {}\n{help}{margin}--> {}:{line}:{}\n", self.message, file.name, column + 1);
        let Some(text) = line.checked_sub(1).and_then(|index| file.text.lines().nth(index)) else { return head };
        let length = text.chars().count();
        let end = if self.end.line == line { self.end.column } else { length };
        let before: String = text.chars().take(column).map(|c| if c == '\t' { '\t' } else { ' ' }).collect();
        let marks = "^".repeat(end.min(length).saturating_sub(column).max(1));
        format!("{head}{margin} |\n{number} | {text}\n{margin} | {before}{marks}\n")
    }
}
