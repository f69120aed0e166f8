//! A report as Markdown: pictures as letters, equations for readers that know `math` blocks.

use std::fmt::Write;

use super::document::{Block, Document, Table};

pub(crate) fn page(document: &Document) -> String {
    let mut out = format!("# {}\n", document.title);
    for words in &document.lead {
        let _ = write!(out, "\n{}\n", prose(words));
    }
    for section in &document.sections {
        let _ = write!(out, "\n## {}\n", section.title);
        section.blocks.iter().for_each(|one| block(&mut out, one));
    }
    let _ = write!(out, "\n---\n\n{}\n", document.colophon);
    out
}

fn block(out: &mut String, one: &Block) {
    match one {
        Block::Words(words) => {
            let _ = write!(out, "\n{}\n", prose(words));
        }
        Block::List(items) => {
            out.push('\n');
            for item in items {
                let _ = writeln!(out, "- {}", prose(item));
            }
        }
        Block::Table(rows) => table(out, rows),
        Block::Figure(figure) => {
            let _ = write!(out, "\n{}\n", figure.caption);
            if !figure.text.is_empty() {
                let _ = write!(out, "\n```text\n{}\n```\n", figure.text.trim_end());
            }
        }
        Block::Heading(title) => {
            let _ = write!(out, "\n### {title}\n");
        }
        Block::Equations(lines) => {
            for line in lines {
                let _ = write!(out, "\n```math\n{}\n```\n", line.latex);
                if let Some(says) = &line.says {
                    let _ = write!(out, "\n{says}\n");
                }
            }
        }
        Block::Letters(lines) => {
            let _ = write!(out, "\n```text\n{}\n```\n", lines.join("\n"));
        }
        Block::Folded(summary, blocks) => {
            let _ = write!(out, "\n{summary}:\n");
            blocks.iter().for_each(|one| block(out, one));
        }
    }
}

fn table(out: &mut String, table: &Table) {
    let row = |cells: &[String]| {
        let cells: Vec<String> = cells.iter().map(|cell| prose(cell).replace('|', "\\|")).collect();
        format!("| {} |\n", cells.join(" | "))
    };
    let columns = 0..table.heads.len();
    let rule: Vec<&str> = columns.map(|column| if column < table.words { "---" } else { "---:" }).collect();
    // A table has one line of heads here.
    let mut heads = table.heads.clone();
    let mut first = 0;
    for (columns, title) in &table.titles {
        for head in heads.iter_mut().skip(first).take(*columns).filter(|_| !title.is_empty()) {
            *head = format!("{title}: {head}");
        }
        first += columns;
    }
    let _ = write!(out, "\n{}|{}|\n", row(&heads), rule.join("|"));
    table.rows.iter().for_each(|cells| out.push_str(&row(cells)));
}

/// What would be a tag between backticks or not is no tag; all else is the user's own Markdown.
fn prose(words: &str) -> String {
    let piece = |(number, piece): (usize, &str)| {
        if number % 2 == 1 { piece.to_owned() } else { piece.replace('&', "&amp;").replace('<', "&lt;") }
    };
    words.split('`').enumerate().map(piece).collect::<Vec<String>>().join("`")
}
