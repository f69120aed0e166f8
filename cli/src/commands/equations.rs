//! `equations`: the equations of each model for readers, as text, LaTeX or MathML.

use std::fmt::Write;

use multibody_engine::mechanics::written::{Line, Page, Section};
use multibody_engine::symbolic::write::{latex, mathml, text};

use crate::Stop;
use crate::arguments::{Form, Subject};
use crate::build;

pub(crate) fn run(subject: &Subject, form: Form) -> Result<String, Stop> {
    let pages = build::pages(subject)?;
    let print = match form {
        Form::Text => as_text,
        Form::Latex => as_latex,
        Form::Mathml => as_mathml,
    };
    let pages: Vec<String> = pages.iter().map(|(name, page)| print(name, page)).collect();
    Ok(pages.join("\n"))
}

/// Sections with their lines, what is alike in identical parts once.
fn sections(page: &Page, mut print: impl FnMut(&Section, &[Line])) {
    for section in &page.sections {
        let lines: Vec<Line> = page.folded(section).into_iter().map(|folded| folded.line).collect();
        print(section, &lines);
    }
}

fn as_text(name: &str, page: &Page) -> String {
    let mut out = format!("{name}\n");
    sections(page, |section, lines| {
        let _ = writeln!(out, "\n  {}\n", section.title);
        for sentence in &section.says {
            let _ = writeln!(out, "  {sentence}\n");
        }
        for line in lines {
            let says = line.says.as_ref().map_or_else(String::new, |says| format!("    ({says})"));
            let _ = writeln!(out, "    {}{says}", text::equation(&line.equation));
        }
    });
    out
}

/// Sections for a document with amsmath.
fn as_latex(name: &str, page: &Page) -> String {
    let mut out = format!("\\section*{{{}}}\n", latex_prose(name));
    sections(page, |section, lines| {
        let _ = writeln!(out, "\n\\subsection*{{{}}}", latex_prose(section.title));
        for sentence in &section.says {
            let _ = writeln!(out, "{}\n", latex_prose(sentence));
        }
        if lines.is_empty() {
            return;
        }
        let rows: Vec<String> = lines
            .iter()
            .map(|line| {
                let says = line.says.as_ref();
                let says = says.map_or_else(String::new, |says| format!(" \\quad\\text{{{}}}", latex_prose(says)));
                format!("{}{says}", latex::equation(&line.equation))
            })
            .collect();
        let _ = writeln!(out, "\\begin{{gather*}}\n{}\n\\end{{gather*}}", rows.join(" \\\\\n"));
    });
    out
}

/// Words in Markdown as LaTeX.
fn latex_prose(markdown: &str) -> String {
    let mut out = String::new();
    let mut is_code = false;
    for letter in markdown.chars() {
        match letter {
            '`' => {
                is_code = !is_code;
                out.push_str(if is_code { "\\texttt{" } else { "}" });
            }
            '_' | '%' | '&' | '#' | '$' | '{' | '}' => out.extend(['\\', letter]),
            '\\' => out.push_str("\\textbackslash{}"),
            '^' => out.push_str("\\textasciicircum{}"),
            '~' => out.push_str("\\textasciitilde{}"),
            _ => out.push(letter),
        }
    }
    out
}

/// A piece of a page in HTML.
fn as_mathml(name: &str, page: &Page) -> String {
    let mut out = format!("<h2>{}</h2>\n", html_prose(name));
    sections(page, |section, lines| {
        let _ = writeln!(out, "<h3>{}</h3>", html_prose(section.title));
        for sentence in &section.says {
            let _ = writeln!(out, "<p>{}</p>", html_prose(sentence));
        }
        for line in lines {
            let _ = writeln!(out, "<div>{}</div>", mathml::equation(&line.equation));
            if let Some(says) = &line.says {
                let _ = writeln!(out, "<p>{}</p>", html_prose(says));
            }
        }
    });
    out
}

/// Words in Markdown as HTML.
fn html_prose(markdown: &str) -> String {
    let mut out = String::new();
    let mut is_code = false;
    for letter in markdown.chars() {
        match letter {
            '`' => {
                is_code = !is_code;
                out.push_str(if is_code { "<code>" } else { "</code>" });
            }
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '&' => out.push_str("&amp;"),
            _ => out.push(letter),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::{html_prose, latex_prose};

    #[test]
    fn words_are_set_in_each_language() {
        assert_eq!(latex_prose("`a_b` is 5 % of c"), "\\texttt{a\\_b} is 5 \\% of c");
        assert_eq!(html_prose("`a<b>` & c"), "<code>a&lt;b&gt;</code> &amp; c");
    }
}
