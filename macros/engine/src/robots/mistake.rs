//! Stage `robots`: what is wrong with a file, and where.

/// Line and column, from one.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Place {
    pub(super) line: usize,
    pub(super) column: usize,
}

/// The first mistake of a file.
#[derive(Clone, Debug)]
pub(super) struct Mistake {
    /// Nothing if it is the file as a whole.
    pub(super) at: Option<Place>,
    pub(super) message: String,
    pub(super) help: Option<String>,
}

impl Mistake {
    pub(super) fn at(place: Place, message: impl Into<String>) -> Mistake {
        Mistake { at: Some(place), message: message.into(), help: None }
    }

    pub(super) fn file(message: impl Into<String>) -> Mistake {
        Mistake { at: None, message: message.into(), help: None }
    }

    pub(super) fn help(self, help: impl Into<String>) -> Mistake {
        Mistake { help: Some(help.into()), ..self }
    }

    /// With the place in the file before it.
    pub(super) fn text(&self, file: &str) -> String {
        match self.at {
            Some(Place { line, column }) => format!("{file}:{line}:{column}: {}", self.message),
            None => format!("{file}: {}", self.message),
        }
    }
}
