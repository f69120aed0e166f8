//! Pictures: elements of SVG as text. Colours are classes of the page's style, so that they follow its light and dark.

use std::fmt::Write;

use super::html::escaped;

/// Width of a letter of the pictures' font, in parts of its size.
const LETTER: f64 = 0.602;

/// A picture of this size.
pub(super) struct Picture {
    body: String,
    width: f64,
    height: f64,
    class: &'static str,
    title: String,
}

impl Picture {
    pub(super) fn new(class: &'static str, title: String, width: f64, height: f64) -> Picture {
        Picture { body: String::new(), width, height, class, title }
    }

    pub(super) fn add(&mut self, element: &str) {
        self.body.push_str(element);
        self.body.push('\n');
    }

    pub(super) fn line(&mut self, class: &str, [x, y]: [f64; 2], [u, v]: [f64; 2]) {
        let [x, y, u, v] = [x, y, u, v].map(number);
        let _ = writeln!(self.body, "<line class=\"{class}\" x1=\"{x}\" y1=\"{y}\" x2=\"{u}\" y2=\"{v}\"/>");
    }

    /// Letters that begin at a point, end there (`end`), or stand about it (`middle`).
    pub(super) fn text(&mut self, class: &str, anchor: &str, [x, y]: [f64; 2], text: &str) {
        let [x, y] = [x, y].map(number);
        let text = escaped(text);
        let _ =
            writeln!(self.body, "<text class=\"{class}\" text-anchor=\"{anchor}\" x=\"{x}\" y=\"{y}\">{text}</text>");
    }

    pub(super) fn finish(self) -> String {
        let Picture { body, width, height, class, title } = self;
        let [width, height] = [width, height].map(|x| number(x.ceil()));
        let title = escaped(&title);
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"{class}\" role=\"img\" viewBox=\"0 0 {width} {height}\" \
             width=\"{width}\" height=\"{height}\">\n<title>{title}</title>\n{body}</svg>"
        )
    }
}

/// A tenth of a pixel is as much as anyone sees.
pub(super) fn number(x: f64) -> String {
    let x = (x * 10.0).round() / 10.0;
    // Minus zero is zero.
    let x = if x == 0.0 { 0.0 } else { x };
    format!("{x}")
}

/// Width of letters of this size.
pub(super) fn width(text: &str, size: f64) -> f64 {
    text.chars().count() as f64 * LETTER * size
}
