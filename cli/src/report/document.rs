//! What a report says, before it is written as HTML or as Markdown.

/// A page about one model.
pub(crate) struct Document {
    pub(crate) title: String,
    /// Below the title: Markdown.
    pub(crate) lead: Vec<String>,
    pub(crate) sections: Vec<Section>,
    /// At the end.
    pub(crate) colophon: String,
}

pub(crate) struct Section {
    pub(crate) title: &'static str,
    pub(crate) blocks: Vec<Block>,
}

/// Words are Markdown of one line: names stand between backticks.
pub(crate) enum Block {
    Words(String),
    List(Vec<String>),
    Table(Table),
    Figure(Figure),
    Heading(String),
    Equations(Vec<Line>),
    /// Equations as plain text, each on a line.
    Letters(Vec<String>),
    /// What is long stands behind its summary.
    Folded(String, Vec<Block>),
}

pub(crate) struct Table {
    pub(crate) heads: Vec<String>,
    /// Over so many columns each; nothing where there is one line of heads.
    pub(crate) titles: Vec<(usize, &'static str)>,
    pub(crate) rows: Vec<Vec<String>>,
    /// Columns from this one on are numbers.
    pub(crate) words: usize,
}

pub(crate) struct Figure {
    pub(crate) svg: String,
    /// The same in letters, where there are no pictures.
    pub(crate) text: String,
    pub(crate) caption: String,
    /// Colours of the picture, each with the name of its class and what it stands for.
    pub(crate) legend: Vec<(&'static str, &'static str)>,
}

/// An equation in all languages, and what is said of it.
pub(crate) struct Line {
    pub(crate) mathml: String,
    pub(crate) latex: String,
    /// In letters, which lines break.
    pub(crate) text: String,
    pub(crate) says: Option<String>,
}

impl Table {
    pub(crate) fn new<S: Into<String>>(heads: impl IntoIterator<Item = S>, words: usize) -> Table {
        Table { heads: heads.into_iter().map(Into::into).collect(), titles: Vec::new(), rows: Vec::new(), words }
    }

    /// Columns that are empty all the way down say nothing.
    pub(crate) fn without_empty_columns(mut self) -> Table {
        for column in (1..self.heads.len()).rev() {
            if self.rows.iter().all(|row| row[column].is_empty()) {
                self.heads.remove(column);
                self.rows.iter_mut().for_each(|row| drop(row.remove(column)));
                self.words -= usize::from(column < self.words);
            }
        }
        self
    }
}
