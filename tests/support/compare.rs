//! How far two vectors are apart.

/// Largest difference over the largest reference value. A NaN counts as infinite, and so does any difference from zeros.
pub fn relative(got: &[f64], want: &[f64]) -> f64 {
    over(got, want, largest(want))
}

/// Largest difference over one plus the largest reference value.
pub fn mixed(got: &[f64], want: &[f64]) -> f64 {
    over(got, want, 1.0 + largest(want))
}

/// Largest magnitude.
pub fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most, x| f64::max(most, x.abs()))
}

fn over(got: &[f64], want: &[f64], scale: f64) -> f64 {
    assert_eq!(got.len(), want.len(), "vectors of different lengths");
    let errors = got.iter().zip(want).map(|(a, b)| if a == b { 0.0 } else { (a - b).abs() / scale });
    errors.fold(0.0, worse)
}

/// The greater of two errors; a NaN is the worst of all.
pub fn worse(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::INFINITY } else { a.max(b) }
}
