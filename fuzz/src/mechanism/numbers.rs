//! Numbers, axes, angles and turns as people write them, seldom along a coordinate axis.

use std::f64::consts::PI;

use super::{Expr, Step, Vector};
use crate::algebra::{Matrix, V3, about, cross, identity, norm, product, scaled};
use crate::random::Random;

fn number(text: impl Into<String>, value: f64) -> Expr {
    Expr::Number(text.into(), value)
}

/// A decimal with so many places, as people type them.
pub fn decimal(random: &mut Random, low: f64, high: f64) -> Expr {
    let places = *random.pick(&[1_usize, 2, 3, 3, 6]);
    let text = format!("{:.places$}", random.between(low, high));
    let value: f64 = text.parse().expect("a decimal");
    if value == 0.0 { number("0.1", 0.1) } else { number(text, value) }
}

/// A positive quantity such as a mass.
pub fn positive(random: &mut Random) -> Expr {
    match random.below(8) {
        0 => number("1", 1.0),
        1 => number("2.0", 2.0),
        2 => number("1 / 3", 1.0 / 3.0),
        3 => number("sqrt(2)", 2.0_f64.sqrt()),
        _ => decimal(random, 0.3, 3.0),
    }
}

/// Of a length that may have either sign, and is zero at times.
pub fn length(random: &mut Random) -> Expr {
    match random.below(10) {
        0..=2 => number("0", 0.0),
        3 => number("1", 1.0),
        4 => number("-0.5", -0.5),
        5 => number("sqrt(2) / 2", 2.0_f64.sqrt() / 2.0),
        6 => number("sqrt(3)", 3.0_f64.sqrt()),
        7 => number("2 / 3", 2.0 / 3.0),
        _ => decimal(random, -1.0, 1.0),
    }
}

/// An angle.
pub fn angle(random: &mut Random) -> Expr {
    match random.below(12) {
        0..=3 => {
            let degrees = *random.pick(&[30.0, 45.0, 60.0, 90.0, 120.0, -30.0, 150.0, 180.0, -90.0]);
            number(format!("deg({degrees})"), f64::to_radians(degrees))
        }
        4 => {
            let degrees = *random.pick(&[15.0, 20.0, 7.0, 0.25, 22.5, 36.0, -72.0, 10.0, 1.0, 53.13]);
            number(format!("deg({degrees})"), f64::to_radians(degrees))
        }
        5 => {
            let k = *random.pick(&[2, 3, 4, 5, 6, 7, 8, 9, 12]);
            number(format!("PI / {k}"), PI / f64::from(k))
        }
        6 => number("2 * PI / 7", 2.0 * PI / 7.0),
        7 => number("atan2(1, 2)", 1.0_f64.atan2(2.0)),
        8 => number("acos(1 / 3)", (1.0_f64 / 3.0).acos()),
        9 => number("deg(30) + PI / 4", f64::to_radians(30.0) + PI / 4.0),
        _ => decimal(random, -3.0, 3.0),
    }
}

/// An axis of any length but zero.
pub fn axis(random: &mut Random) -> Vector {
    let whole = |text: &str, value: V3| Vector::Whole(text.to_owned(), value);
    let root = 3.0_f64.sqrt();
    match random.below(16) {
        0 => whole("X", [1.0, 0.0, 0.0]),
        1 => whole("Y", [0.0, 1.0, 0.0]),
        2 => whole("Z", [0.0, 0.0, 1.0]),
        3 => whole("-X", [-1.0, 0.0, 0.0]),
        4 => whole("X + Y", [1.0, 1.0, 0.0]),
        5 => whole("[sqrt(3), 1, 0]", [root, 1.0, 0.0]),
        6 => whole("[0, cos(deg(60)), sin(deg(60))]", [0.0, 0.5, root / 2.0]),
        7 => {
            let n = 14.0_f64.sqrt();
            whole("[1, 2, 3] / norm([1, 2, 3])", [1.0 / n, 2.0 / n, 3.0 / n])
        }
        8..=12 => {
            let list =
                [[1, 0, 1], [1, 2, 3], [1, 1, 1], [0, 1, 1], [1, -1, 0], [2, 1, 2], [-2, 3, 6], [1, 1, -1], [0, 3, 4]];
            let k = *random.pick(&list);
            whole(&format!("{k:?}"), k.map(f64::from))
        }
        13 => whole("[1, 0.5, 0.2]", [1.0, 0.5, 0.2]),
        _ => Vector::Parts([(); 3].map(|()| decimal(random, -1.0, 1.0))),
    }
}

/// Two axes at a right angle.
pub fn perpendicular(random: &mut Random) -> (Vector, Vector) {
    let list: [([i32; 3], [i32; 3]); 7] = [
        ([1, 0, 0], [0, 1, 0]),
        ([0, 0, 1], [1, 0, 0]),
        ([1, 0, 1], [0, 1, 0]),
        ([1, 1, 1], [1, -1, 0]),
        ([1, 2, 2], [2, 1, -2]),
        ([1, 2, 3], [3, 0, -1]),
        ([1, 0, 1], [1, 0, -1]),
    ];
    let (a, b) = *random.pick(&list);
    let vector = |k: [i32; 3]| Vector::Whole(format!("{k:?}"), k.map(f64::from));
    (vector(a), vector(b))
}

/// A matrix typed to sixteen digits.
pub fn typed(matrix: &Matrix) -> [[Expr; 3]; 3] {
    matrix.map(|row| {
        row.map(|x| {
            let text = format!("{x:.16}");
            let value: f64 = text.parse().expect("a decimal");
            let trimmed = if value == 0.0 { "0".to_owned() } else { text };
            number(trimmed, value)
        })
    })
}

/// A turn.
pub fn turn(random: &mut Random) -> Step {
    match random.below(10) {
        0 => {
            let quarters = [
                [[0, -1, 0], [1, 0, 0], [0, 0, 1]],
                [[1, 0, 0], [0, 0, -1], [0, 1, 0]],
                [[0, 0, 1], [1, 0, 0], [0, 1, 0]],
            ];
            Step::Oriented(random.pick(&quarters).map(|row| row.map(|k: i32| number(format!("{k}"), f64::from(k)))))
        }
        1 => Step::Oriented(
            [["0.6", "-0.8", "0"], ["0.8", "0.6", "0"], ["0", "0", "1"]]
                .map(|row| row.map(|text| number(text, text.parse().expect("a decimal")))),
        ),
        2 | 3 => {
            // What a drawing program or another script prints.
            let mut matrix = identity();
            for _ in 0..1 + random.below(2) {
                let (axis, angle) = (axis(random), angle(random));
                let at = super::expression::Point::default();
                matrix = product(&matrix, &about(axis.value(&at), angle.value(&at)));
            }
            Step::Oriented(typed(&matrix))
        }
        _ => Step::Rotated(axis(random), angle(random)),
    }
}

/// Some vector that is not parallel to another one, and perpendicular to it.
pub fn any_normal(random: &mut Random, to: V3) -> V3 {
    loop {
        let other = [random.unit(), random.unit(), random.unit()];
        let normal = cross(to, other);
        if norm(normal) > 0.2 * norm(to) {
            return scaled(1.0 / norm(normal), normal);
        }
    }
}
