//! Stage `emit`: what a page shows of a section's equations, by their size.
//!
//! In: a section of a model's equations. Out: which lines are set as mathematics, which stand as plain text, which are counted only.
//! Set, an equation takes five times the letters, and browsers break no lines in it. A section is set as a whole where it is of a
//! size that people read. Of a larger one lines that fit the page are set, the others are text where they stand, and behind as much
//! as a page can hold all is text, still to be searched.

use crate::mechanics::written::{Line, Page, Section, Subject};
use crate::symbolic::write::{mathml, text};

/// Characters of MathML, for each section.
const MOST_SET: usize = 36_000;
/// Characters of plain text.
const MOST_PLAIN: usize = 80_000;
/// Characters of a line as plain text that is set in a section of more.
const MOST_CHARACTERS: usize = 200;
/// A section of more equations is folded, and what is zero is left out there.
const MOST_UNFOLDED: usize = 24;

/// A line on a page.
pub enum Form {
    /// As mathematics: MathML.
    Set(String, Line),
    /// As plain text, with what is said of it.
    Plain(String),
}

/// Equations of a section as a page shows them.
#[derive(Default)]
pub struct Shown {
    pub lines: Vec<Form>,
    /// What follows as plain text.
    pub rest: Vec<String>,
    /// What follows is left out.
    pub more: usize,
    /// Whether entries that are zero are left out.
    pub is_sparse: bool,
}

impl Shown {
    pub fn new(page: &Page, section: &Section) -> Shown {
        let mut lines: Vec<Line> = page.folded(section).into_iter().map(|folded| folded.line).collect();
        let mut shown = Shown::default();
        if lines.len() > MOST_UNFOLDED {
            let all = lines.len();
            lines.retain(|line| !is_zero_entry(line));
            shown.is_sparse = lines.len() < all;
        }
        let set: Vec<String> = lines.iter().map(|line| mathml::equation(&line.equation)).collect();
        let is_large = set.iter().map(String::len).sum::<usize>() > MOST_SET;
        let [mut as_set, mut as_text] = [0; 2];
        for (math, line) in set.into_iter().zip(lines) {
            let text = text::equation(&line.equation);
            let is_long = is_large && text.chars().count() > MOST_CHARACTERS;
            if !is_long && shown.rest.is_empty() && as_set + math.len() <= MOST_SET {
                as_set += math.len();
                shown.lines.push(Form::Set(math, line));
                continue;
            }
            let text = match &line.says {
                Some(says) => format!("{text}    ({})", says.replace('`', "")),
                None => text,
            };
            as_text += text.len();
            match (as_text <= MOST_PLAIN, is_long && shown.rest.is_empty()) {
                (true, true) => shown.lines.push(Form::Plain(text)),
                (true, false) => shown.rest.push(text),
                (false, _) => shown.more += 1,
            }
        }
        shown
    }

    /// Lines that are shown.
    pub fn count(&self) -> usize {
        self.lines.len() + self.rest.len()
    }

    pub fn is_folded(&self) -> bool {
        self.count() > MOST_UNFOLDED
    }

    /// What a reader must know of what is left out.
    pub fn says(&self) -> Option<&'static str> {
        match (self.is_sparse, self.more) {
            (false, _) => None,
            (true, 0) => Some("Entries that do not stand here are zero."),
            // Others are missing too.
            (true, _) => Some("Entries that are zero are left out."),
        }
    }

    /// What stands over the rest.
    pub fn over_rest(&self) -> String {
        let count = self.rest.len();
        format!("{count} more {}, as plain text", if count == 1 { "equation" } else { "equations" })
    }

    /// What stands at the end.
    pub fn at_end(&self) -> Option<String> {
        (self.more > 0).then(|| format!("and {} more, which `cargo multibody equations` prints", self.more))
    }
}

/// An entry of a matrix or a list that says by its absence what it says.
fn is_zero_entry(line: &Line) -> bool {
    let is_entry =
        matches!(line.subject, Subject::Mass(..) | Subject::Inertial(_) | Subject::Gravity(_) | Subject::Force(_));
    is_entry && line.equation.right.is_zero()
}
