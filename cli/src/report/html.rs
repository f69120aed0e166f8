//! A report as one file of HTML: no script, nothing from elsewhere.

use std::fmt::Write;

use super::document::{Block, Document, Figure, Line, Table};

const STYLE: &str = include_str!("style.css");

pub(crate) fn page(document: &Document) -> String {
    let title = escaped(&document.title);
    let mut out = String::new();
    let _ = write!(
        out,
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n\
         <meta name=\"color-scheme\" content=\"light dark\"/>\n<title>{title}</title>\n<style>\n{STYLE}</style>\n</head>\n\
         <body>\n<main>\n<header>\n<h1>{title}</h1>\n"
    );
    document.lead.iter().for_each(|words| paragraph(&mut out, words));
    out.push_str("</header>\n<nav>\n<ul>\n");
    for section in &document.sections {
        let _ = writeln!(out, "<li><a href=\"#{}\">{}</a></li>", anchor(section.title), escaped(section.title));
    }
    out.push_str("</ul>\n</nav>\n");
    for section in &document.sections {
        let _ = write!(out, "<section id=\"{}\">\n<h2>{}</h2>\n", anchor(section.title), escaped(section.title));
        section.blocks.iter().for_each(|one| block(&mut out, one));
        out.push_str("</section>\n");
    }
    let _ = write!(out, "<footer><p>{}</p></footer>\n</main>\n</body>\n</html>\n", words(&document.colophon));
    out
}

fn anchor(title: &str) -> String {
    title.to_lowercase().replace(' ', "-")
}

fn paragraph(out: &mut String, text: &str) {
    let _ = writeln!(out, "<p>{}</p>", words(text));
}

fn block(out: &mut String, one: &Block) {
    match one {
        Block::Words(text) => paragraph(out, text),
        Block::List(items) => {
            out.push_str("<ul>\n");
            for item in items {
                let _ = writeln!(out, "<li>{}</li>", words(item));
            }
            out.push_str("</ul>\n");
        }
        Block::Table(rows) => table(out, rows),
        Block::Figure(drawn) => figure(out, drawn),
        Block::Heading(title) => {
            let _ = writeln!(out, "<h3>{}</h3>", words(title));
        }
        Block::Equations(lines) => lines.iter().for_each(|line| equation(out, line)),
        Block::Letters(lines) => {
            out.push_str("<ul class=\"plain\">\n");
            for line in lines {
                let _ = writeln!(out, "<li><code>{}</code></li>", escaped(line));
            }
            out.push_str("</ul>\n");
        }
        Block::Folded(summary, blocks) => {
            let _ = writeln!(out, "<details>\n<summary>{}</summary>", words(summary));
            blocks.iter().for_each(|one| block(out, one));
            out.push_str("</details>\n");
        }
    }
}

fn table(out: &mut String, table: &Table) {
    out.push_str("<div class=\"wide\"><table>\n<thead>\n");
    if !table.titles.is_empty() {
        out.push_str("<tr>");
        for (columns, title) in &table.titles {
            let class = if title.is_empty() { "" } else { " class=\"over\"" };
            let _ = write!(out, "<th colspan=\"{columns}\"{class}>{}</th>", escaped(title));
        }
        out.push_str("</tr>\n");
    }
    let class = |column: usize| if column < table.words { "" } else { " class=\"number\"" };
    let row = |out: &mut String, cells: &[String], tag: &str| {
        out.push_str("<tr>");
        for (column, cell) in cells.iter().enumerate() {
            let _ = write!(out, "<{tag}{}>{}</{tag}>", class(column), words(cell));
        }
        out.push_str("</tr>\n");
    };
    row(out, &table.heads, "th");
    out.push_str("</thead>\n<tbody>\n");
    table.rows.iter().for_each(|cells| row(out, cells, "td"));
    out.push_str("</tbody>\n</table></div>\n");
}

fn figure(out: &mut String, figure: &Figure) {
    let _ = write!(out, "<figure>\n<div class=\"wide\">{}</div>\n<figcaption>", figure.svg);
    if !figure.legend.is_empty() {
        out.push_str("<span class=\"legend\">");
        for (class, meaning) in &figure.legend {
            let _ = write!(out, "<span><i class=\"{class}\"></i>{}</span> ", escaped(meaning));
        }
        out.push_str("</span>");
    }
    let _ = writeln!(out, "{}</figcaption>\n</figure>", words(&figure.caption));
}

/// Longer ones are wider than paper, and are printed in letters.
const MOST_PRINTED: usize = 110;

fn equation(out: &mut String, line: &Line) {
    let long = line.text.chars().count() > MOST_PRINTED;
    let class = if long { "wide equation long" } else { "wide equation" };
    let _ = writeln!(out, "<div class=\"{class}\">{}</div>", line.mathml);
    if long {
        let _ = writeln!(out, "<p class=\"letters\"><code>{}</code></p>", escaped(&line.text));
    }
    if let Some(says) = &line.says {
        let _ = writeln!(out, "<p class=\"says\">{}</p>", words(says));
    }
}

/// Markdown of one line: what stands between backticks is code, all else is letters.
fn words(markdown: &str) -> String {
    let pieces: Vec<&str> = markdown.split('`').collect();
    let mut out = String::new();
    for (number, piece) in pieces.iter().enumerate() {
        let piece = escaped(piece);
        match (number % 2, number + 1 < pieces.len()) {
            (1, true) => {
                let _ = write!(out, "<code>{piece}</code>");
            }
            // A backtick without a second one is a letter.
            (1, false) => {
                let _ = write!(out, "`{piece}");
            }
            _ => out.push_str(&piece),
        }
    }
    out
}

/// Letters that are neither tags nor entities. Control characters have no place in XML.
pub(super) fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\t' | '\n' => out.push(' '),
            letter if letter.is_control() => out.push('\u{fffd}'),
            letter => out.push(letter),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::words;

    #[test]
    fn words_of_users_are_no_tags() {
        assert_eq!(words("`a<b>` & \"c\" <script>"), "<code>a&lt;b&gt;</code> &amp; &quot;c&quot; &lt;script&gt;");
        assert_eq!(words("`a` and ` left open <i>"), "<code>a</code> and ` left open &lt;i&gt;");
        assert_eq!(words("\u{1b}[31m"), "\u{fffd}[31m");
    }
}
