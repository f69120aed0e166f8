//! Tables for terminals: names to the left, numbers to the right.

/// Rows of cells under heads.
pub(crate) struct Table {
    heads: Vec<String>,
    rows: Vec<Vec<String>>,
    /// So many columns are words.
    words: usize,
    /// Titles over columns, each with the column that it begins at.
    titles: Vec<(usize, &'static str)>,
}

impl Table {
    pub(crate) fn new<S: Into<String>>(words: usize, heads: impl IntoIterator<Item = S>) -> Table {
        let heads = heads.into_iter().map(Into::into).collect();
        Table { heads, rows: Vec::new(), words, titles: Vec::new() }
    }

    pub(crate) fn titled(mut self, titles: impl IntoIterator<Item = (usize, &'static str)>) -> Table {
        self.titles = titles.into_iter().collect();
        self
    }

    /// A row may have fewer cells than there are columns; its last cell may be of any length then.
    pub(crate) fn row(&mut self, cells: impl IntoIterator<Item = String>) {
        self.rows.push(cells.into_iter().collect());
    }

    pub(crate) fn text(&self) -> String {
        let columns = self.heads.len();
        let full = self.rows.iter().filter(|row| row.len() == columns);
        let mut widths: Vec<usize> = self.heads.iter().map(|head| length(head)).collect();
        full.for_each(|row| widen(&mut widths, row));
        for row in self.rows.iter().filter(|row| row.len() < columns) {
            widen(&mut widths, &row[..row.len().saturating_sub(1)]);
        }
        // A title that is longer than its columns moves the next one.
        for pair in self.titles.windows(2) {
            let [(from, title), (to, _)] = [pair[0], pair[1]];
            let wide: usize = widths[from..to].iter().map(|width| width + 2).sum();
            if let Some(last) = widths[from..to].last_mut() {
                *last += (length(title) + 2).saturating_sub(wide);
            }
        }
        let mut text = String::new();
        if !self.titles.is_empty() {
            let mut line = String::new();
            for &(column, title) in &self.titles {
                // Over the right column's first letter, which stands behind two blanks.
                let offset = 2 + widths[..column].iter().map(|width| width + 2).sum::<usize>();
                line.extend(std::iter::repeat_n(' ', offset.saturating_sub(length(&line))));
                line.push_str(title);
            }
            text.push_str(line.trim_end());
            text.push('\n');
        }
        for row in std::iter::once(&self.heads).chain(&self.rows) {
            let mut line = String::new();
            for (column, (cell, &width)) in row.iter().zip(&widths).enumerate() {
                let free = " ".repeat(width.saturating_sub(length(cell)));
                let is_last = column + 1 == row.len() && row.len() < columns;
                let cell =
                    if column < self.words || is_last { format!("{cell}{free}") } else { format!("{free}{cell}") };
                line.push_str("  ");
                line.push_str(&cell);
            }
            text.push_str(line.trim_end());
            text.push('\n');
        }
        text
    }
}

fn widen(widths: &mut [usize], row: &[String]) {
    for (width, cell) in widths.iter_mut().zip(row) {
        *width = (*width).max(length(cell));
    }
}

fn length(cell: &str) -> usize {
    cell.chars().count()
}

#[cfg(test)]
mod tests {
    use super::Table;

    #[test]
    fn titles_stand_apart() {
        let mut table = Table::new(0, ["a", "b", "c"]).titled([(0, "a long title"), (1, "next")]);
        table.row(["1", "2", "3"].map(String::from));
        assert_eq!(table.text(), "  a long title  next\n             a  b  c\n             1  2  3\n");
    }

    #[test]
    fn columns_are_aligned() {
        let mut table = Table::new(1, ["function", "add", "mul"]).titled([(1, "emitted")]);
        table.row(["bias", "7", "1234"].map(String::from));
        table.row(["forward_dynamics", "refused: why"].map(String::from));
        assert_eq!(
            table.text(),
            "                    emitted\n\
             \x20 function          add   mul\n\
             \x20 bias                7  1234\n\
             \x20 forward_dynamics  refused: why\n"
        );
    }
}
