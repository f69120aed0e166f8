//! Rows of a matrix while it is eliminated: their entries, what these are made of, and their scale.

use crate::contracts::call::Call;
use crate::symbolic::graph::{Graph, Scalar};

/// What the scale of a row is at least: rows of zeros win against none.
const LEAST: f64 = 1e-30;

pub(super) struct Row {
    pub(super) entries: Vec<Scalar>,
    /// By column the sizes of all that was added there; nothing where that is the size of the entry.
    noise: Vec<Option<Scalar>>,
    /// As they were before anything was eliminated.
    given: Vec<Scalar>,
    /// The greatest of these, once somebody asks.
    scale: Option<Scalar>,
}

impl Row {
    pub(super) fn with_scale(mut self, scale: Scalar) -> Row {
        self.scale = Some(scale);
        self
    }

    pub(super) fn new(entries: Vec<Scalar>) -> Row {
        Row { noise: vec![None; entries.len()], given: entries.clone(), entries, scale: None }
    }

    /// What an entry is made of.
    pub(super) fn noise(&self, g: &mut Graph, column: usize) -> Scalar {
        self.noise[column].unwrap_or_else(|| g.call(Call::Abs, &[self.entries[column]]))
    }

    /// The greatest entry as it was given.
    pub(super) fn scale(&mut self, g: &mut Graph) -> Scalar {
        if let Some(scale) = self.scale {
            return scale;
        }
        let sizes = self.given.iter().filter_map(|&entry| g.literal(entry)).map(|n| n.abs());
        let literal = sizes.max_by(|a, b| a.value().total_cmp(&b.value())).filter(|n| n.value() > LEAST);
        let mut scale = match literal {
            Some(number) => g.number(number),
            None => g.decimal(LEAST),
        };
        for &entry in &self.given {
            if g.literal(entry).is_none() {
                let size = g.call(Call::Abs, &[entry]);
                scale = g.call(Call::Max, &[scale, size]);
            }
        }
        self.scale = Some(scale);
        scale
    }
}

/// A sum of multiples of rows, in these columns. Its scale is that of its entries.
pub(super) fn combined(g: &mut Graph, rows: &mut [Row], terms: &[(usize, Scalar)], columns: &[usize]) -> Row {
    let size = rows.first().map_or(0, |row| row.entries.len());
    let mut combined = Row::new(vec![Scalar::ZERO; size]);
    for &column in columns {
        let parts: Vec<(usize, Scalar)> =
            terms.iter().filter(|&&(row, _)| rows[row].entries[column] != Scalar::ZERO).copied().collect();
        let products: Vec<Scalar> =
            parts.iter().map(|&(row, factor)| g.mul(factor, rows[row].entries[column])).collect();
        combined.entries[column] = g.sum(&products);
        let noisy = parts.iter().any(|&(row, _)| rows[row].noise[column].is_some());
        if parts.len() > 1 || noisy {
            let sizes: Vec<Scalar> = parts
                .iter()
                .map(|&(row, factor)| {
                    let (factor, noise) = (g.call(Call::Abs, &[factor]), rows[row].noise(g, column));
                    g.mul(factor, noise)
                })
                .collect();
            combined.noise[column] = Some(g.sum(&sizes));
        }
    }
    combined.given = combined.entries.clone();
    combined
}

/// The scale of a sum of multiples of rows: that of its terms, whatever cancels.
pub(super) fn combined_scale(g: &mut Graph, rows: &mut [Row], terms: &[(usize, Scalar)]) -> Scalar {
    let mut scale = |&(row, factor): &(usize, Scalar)| {
        let (factor, scale) = (g.call(Call::Abs, &[factor]), rows[row].scale(g));
        g.mul(factor, scale)
    };
    let scales: Vec<Scalar> = terms.iter().map(&mut scale).collect();
    g.sum(&scales)
}

/// The row with the largest entry of a column, beside its scale, where that is known while compiling. Literals without digits are
/// the least.
pub(super) fn largest(g: &mut Graph, rows: &mut [Row], column: usize, candidates: &[usize]) -> Option<usize> {
    if let &[row] = candidates {
        return Some(row);
    }
    let entries: Option<Vec<f64>> = candidates
        .iter()
        .map(|&row| g.literal(rows[row].entries[column]))
        .map(|n| n.map(|n| if n.is_sharp() { n.value().abs() } else { 0.0 }))
        .collect();
    let entries = entries?;
    let scales: Vec<Scalar> = candidates.iter().map(|&row| rows[row].scale(g)).collect();
    let same = scales.iter().all(|&scale| scale == scales[0]);
    let scales: Option<Vec<f64>> =
        scales.iter().map(|&scale| if same { Some(1.0) } else { g.literal(scale).map(|n| n.value()) }).collect();
    let shares: Vec<f64> = entries.iter().zip(scales?).map(|(entry, scale)| entry / scale).collect();
    let best = (0..shares.len()).max_by(|&a, &b| shares[a].total_cmp(&shares[b]).then(b.cmp(&a)));
    best.map(|best| candidates[best])
}

/// Takes a multiple of the first row from the second, in these columns.
pub(super) fn subtract(g: &mut Graph, rows: &mut [Row], factor: Scalar, [top, below]: [usize; 2], columns: &[usize]) {
    for &column in columns {
        let (above, entry) = (rows[top].entries[column], rows[below].entries[column]);
        if above == Scalar::ZERO {
            continue;
        }
        let update = g.mul(factor, above);
        let part = rows[top].noise[column].map(|noise| {
            let size = g.call(Call::Abs, &[factor]);
            g.mul(size, noise)
        });
        rows[below].noise[column] = if entry == Scalar::ZERO {
            part
        } else {
            let before = rows[below].noise(g, column);
            let part = part.unwrap_or_else(|| g.call(Call::Abs, &[update]));
            Some(g.add(before, part))
        };
        rows[below].entries[column] = g.sub(entry, update);
    }
}

/// Rows change places in these columns where the mask says so.
pub(super) fn change_places(g: &mut Graph, rows: &mut [Row], mask: Scalar, pair: [usize; 2], columns: &[usize]) {
    let [above, below] = pair;
    for &column in columns {
        if pair.iter().any(|&row| rows[row].noise[column].is_some()) {
            let noise = pair.map(|row| rows[row].noise(g, column));
            let [a, b] = exchanged(g, mask, noise);
            (rows[above].noise[column], rows[below].noise[column]) = (Some(a), Some(b));
        }
        let entries = pair.map(|row| rows[row].entries[column]);
        [rows[above].entries[column], rows[below].entries[column]] = exchanged(g, mask, entries);
    }
    let scales = pair.map(|row| rows[row].scale(g));
    let [a, b] = exchanged(g, mask, scales);
    (rows[above].scale, rows[below].scale) = (Some(a), Some(b));
}

/// Two entries of a column change places where the mask says so.
pub(super) fn exchange(g: &mut Graph, mask: Scalar, column: &mut [Scalar], [above, below]: [usize; 2]) {
    [column[above], column[below]] = exchanged(g, mask, [column[above], column[below]]);
}

fn exchanged(g: &mut Graph, mask: Scalar, [a, b]: [Scalar; 2]) -> [Scalar; 2] {
    [g.call(Call::Select, &[mask, b, a]), g.call(Call::Select, &[mask, a, b])]
}
