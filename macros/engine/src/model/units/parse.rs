//! Stage `model`: units as they are written.
//!
//! In: the text between the brackets of a doc comment. Out: its unit; nothing where the text is none, such as a link,
//! where a symbol is not in the table, and where it can be read in two ways, as `J/kg K` can. Factors stand side by
//! side, or with `*` or a dot, high or low, between them; behind a slash stands one factor, or parentheses: `kg m^2`,
//! `N m/rad`, `m/s/s`, `1/(kg K)`, `s^-1`, `m^(3/2)`, `N·m`, `m²`.

use super::dimension::Unit;
use super::table;

/// Longer texts are none.
const LONGEST: usize = 60;

/// Nesting of parentheses.
const DEEPEST: usize = 4;

/// Largest exponent.
const MOST: f64 = 100.0;

pub(super) fn parse(text: &str) -> Option<Unit> {
    let text = text.trim();
    if text.len() > LONGEST {
        return None;
    }
    if let Some(unit) = table::unit(text, true) {
        return Some(unit);
    }
    // A symbol that stands alone is there or it is not; the rest of a compound says how it is meant.
    if table::unit(text, false).is_some() {
        return None;
    }
    let mut reader = Reader { rest: text };
    let unit = reader.product(0)?;
    reader.rest.is_empty().then_some(unit)
}

struct Reader<'t> {
    rest: &'t str,
}

impl<'t> Reader<'t> {
    fn peek(&self) -> Option<char> {
        self.rest.chars().next()
    }

    fn take(&mut self, wanted: char) -> bool {
        let rest = self.rest.strip_prefix(wanted);
        self.rest = rest.unwrap_or(self.rest);
        rest.is_some()
    }

    /// The characters that fit, and passes them.
    fn run(&mut self, fits: impl Fn(char) -> bool) -> &'t str {
        let end = self.rest.find(|c| !fits(c)).unwrap_or(self.rest.len());
        let (run, rest) = self.rest.split_at(end);
        self.rest = rest;
        run
    }

    fn spaces(&mut self) -> bool {
        !self.run(char::is_whitespace).is_empty()
    }

    fn product(&mut self, depth: usize) -> Option<Unit> {
        let mut unit = self.factor(depth)?;
        let mut divided = false;
        loop {
            let spaces = self.spaces();
            let (division, times) = match self.peek() {
                None | Some(')') => return Some(unit),
                Some('/') => (true, true),
                Some('*' | '·' | '⋅' | '×' | '.') => (false, true),
                Some(_) if spaces => (false, false),
                Some(_) => return None,
            };
            if times {
                let sign = self.peek()?;
                self.take(sign);
                self.spaces();
            }
            // `J/kg K`: some divide by the last factor, some multiply.
            if divided && !division {
                return None;
            }
            divided |= division;
            let factor = self.factor(depth)?;
            unit = if division { unit.over(factor)? } else { unit.times(factor)? };
        }
    }

    /// One symbol, a one, or parentheses, with its exponent.
    fn factor(&mut self, depth: usize) -> Option<Unit> {
        let base = if self.take('(') {
            if depth == DEEPEST {
                return None;
            }
            self.spaces();
            let inner = self.product(depth + 1)?;
            self.take(')').then_some(inner)?
        } else if self.take('1') {
            Unit::ONE
        } else {
            let symbol = self.run(|c| c.is_alphabetic() || matches!(c, '%' | '°' | '\u{2126}'));
            table::unit(symbol, false)?
        };
        match self.exponent()? {
            Some(exponent) => base.power(exponent),
            None => Some(base),
        }
    }

    /// `^2`, `^-1`, `^1.5`, `^(3/2)`, `²`, `⁻¹`; nothing is one.
    fn exponent(&mut self) -> Option<Option<f64>> {
        let raised = self.run(|c| superscript(c).is_some());
        if !raised.is_empty() {
            let plain: String = raised.chars().filter_map(superscript).collect();
            return bounded(plain.parse().ok()?).map(Some);
        }
        if !self.take('^') {
            return Some(None);
        }
        if !self.take('(') {
            return self.number().and_then(bounded).map(Some);
        }
        let above = self.number()?;
        let below = if self.take('/') { self.number()? } else { 1.0 };
        self.take(')').then_some(())?;
        bounded(above / below).map(Some)
    }

    fn number(&mut self) -> Option<f64> {
        let negative = self.take('-') || self.take('−');
        let size: f64 = self.run(|c| c.is_ascii_digit() || c == '.').parse().ok()?;
        Some(if negative { -size } else { size })
    }
}

fn bounded(exponent: f64) -> Option<f64> {
    (exponent.abs() <= MOST).then_some(exponent)
}

fn superscript(c: char) -> Option<char> {
    Some(match c {
        '⁻' => '-',
        '⁰' => '0',
        '¹' => '1',
        '²' => '2',
        '³' => '3',
        '⁴' => '4',
        '⁵' => '5',
        '⁶' => '6',
        '⁷' => '7',
        '⁸' => '8',
        '⁹' => '9',
        _ => return None,
    })
}
