//! Stage `robots`: the angles of frames, and inertias that are turned by them.
//!
//! A file has `1.5708` for a quarter turn, whose cosine is not zero: frames that were at right angles are not, and their
//! equations have terms that say nothing. Where the user asks for it, such angles are what they are meant to be.

use std::f64::consts::FRAC_PI_2;

use super::robot::Number;

/// So many digits behind the point, at least, tell a quarter turn.
const FEWEST_DECIMALS: i32 = 4;

/// Quarter turns, if it is a whole number of them as far as its digits go: to one in the last of these.
pub(super) fn quarters(angle: &Number) -> Option<i64> {
    if angle.value == 0.0 {
        return Some(0);
    }
    let decimals = match angle.digits.contains('e') {
        true => return None,
        false => i32::try_from(angle.digits.split_once('.').map_or(0, |(_, fraction)| fraction.len())).ok()?,
    };
    let turns = (angle.value / FRAC_PI_2).round();
    let last = 10.0_f64.powi(-decimals.min(12));
    let is_near = (angle.value - turns * FRAC_PI_2).abs() < 1.000_001 * last;
    // Not more than a few turns: a `f64` has no digits left for others.
    (decimals >= FEWEST_DECIMALS && turns != 0.0 && turns.abs() <= 8.0 && is_near).then_some(turns as i64)
}

/// The angle as the language has it; nothing if it is zero.
pub(super) fn text(angle: &Number, is_snapped: bool) -> Option<String> {
    if angle.value == 0.0 {
        return None;
    }
    Some(match quarters(angle).filter(|_| is_snapped) {
        Some(turns) => match turns {
            2 => "PI".to_owned(),
            -2 => "-PI".to_owned(),
            turns => format!("{:?} * PI", turns as f64 / 2.0),
        },
        None => signed(angle),
    })
}

/// With its digits as written.
pub(super) fn signed(number: &Number) -> String {
    format!("{}{}", if number.is_negative { "-" } else { "" }, number.digits)
}

fn sine_and_cosine(angle: &Number, is_snapped: bool) -> (f64, f64) {
    match quarters(angle).filter(|turns| is_snapped || *turns == 0) {
        Some(turns) => [(0.0, 1.0), (1.0, 0.0), (0.0, -1.0), (-1.0, 0.0)][turns.rem_euclid(4) as usize],
        None => angle.value.sin_cos(),
    }
}

/// The tensor xx, yy, zz, xy, xz, yz in the axes that `rpy` is told in: `R * I * R'`.
pub(super) fn turned(tensor: &[Number; 6], rpy: &[Number; 3], is_snapped: bool) -> [f64; 6] {
    let [(sr, cr), (sp, cp), (sy, cy)] = [0, 1, 2].map(|k| sine_and_cosine(&rpy[k], is_snapped));
    let turn = [
        [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
        [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
        [-sp, cp * sr, cp * cr],
    ];
    let [xx, yy, zz, xy, xz, yz] = [0, 1, 2, 3, 4, 5].map(|k| tensor[k].value);
    let own = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
    let entry = |i: usize, j: usize| {
        let mut sum = 0.0;
        for (k, row) in own.iter().enumerate() {
            for (l, value) in row.iter().enumerate() {
                sum += turn[i][k] * value * turn[j][l];
            }
        }
        sum
    };
    [entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(0, 2), entry(1, 2)]
}
