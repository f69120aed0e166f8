//! All ways in which a parallel robot can be assembled with what is given: [`modes_by_points`] and [`modes_by_sides`], for generated code.
//!
//! The pose of a platform on six legs of given lengths is one of several, as many as a polynomial in one unknown has real roots
//! (Merlet 2006, Parallel Robots, chapter 4). Generated code knows the robot up to that unknown, a point of the circle: a *condition*
//! that vanishes there, a sum of sines and cosines of its first multiples, and the *pose* that belongs to each point. What a square
//! root leaves open is a side, plus or minus one, and all sides are gone through. The roots are those of [`roots`].

pub mod roots;

use nalgebra::SVector;

use crate::Real;

/// What tells one assembly mode from the others.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Alternative<T> {
    /// Cosine and sine of the unknown angle, of no meaning where there is none.
    pub point: [T; 2],
    /// One or minus one, for each square root.
    pub sides: [T; 3],
}

/// One way in which a mechanism can be assembled, given by `assembly_modes` of a generated model.
///
/// ```
/// use multibody::{AssemblyMode, nalgebra::SVector};
///
/// let mode = AssemblyMode { position: SVector::from([0.1, 0.2]), residual: 1e-16 };
/// assert_eq!(mode.position[1], 0.2);
/// ```
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AssemblyMode<T, const N: usize> {
    /// `[m]` or `[rad]`: the coordinates that were asked for, in their order. NaN where this mode is not real.
    pub position: SVector<T, N>,
    /// `[1]`: the greatest error of the distances that hold the mechanism, each relative to the squares that it is made of; and, where
    /// joints of legs are asked for, of what these make of what is given. NaN where this mode is not real.
    pub residual: T,
}

/// All assembly modes, from up to `ROOTS` points of the circle, which is `SAMPLES - 1`, for each of `MODES / ROOTS` choices of the sides
/// that the condition reads. To each point belong `CHOICES` more sides.
///
/// The modes of one choice stand in a row, real ones first, each once. What has a residual above half of all digits is none, and what
/// agrees with another one to so many digits is the same. Every input costs the same.
#[must_use]
pub fn modes_by_points<
    T: Real,
    const SAMPLES: usize,
    const ROOTS: usize,
    const CHOICES: usize,
    const MODES: usize,
    const ANGLES: u64,
    const N: usize,
>(
    condition: impl Fn(&Alternative<T>) -> T,
    mode: impl Fn(&Alternative<T>) -> AssemblyMode<T, N>,
) -> [AssemblyMode<T, N>; MODES] {
    let mut modes = [unknown(); MODES];
    for (choice, row) in modes.chunks_mut(ROOTS).enumerate() {
        let own = sides(choice);
        let points = roots::on_circle::<T, SAMPLES, ROOTS>(|point| condition(&Alternative { point, sides: own }));
        let mut count = T::lit(0.0);
        for point in points {
            for further in 0..CHOICES {
                let sides = sides(choice + further * (MODES / ROOTS));
                insert::<T, ANGLES, N>(row, &mut count, &mode(&Alternative { point, sides }));
            }
        }
    }
    modes
}

/// Takes a mode to the next free place, if it is one and is not there. Coordinates whose bit in `ANGLES` is set are angles.
fn insert<T: Real, const ANGLES: u64, const N: usize>(
    row: &mut [AssemblyMode<T, N>],
    count: &mut T,
    mode: &AssemblyMode<T, N>,
) {
    let half = Real::sqrt(T::epsilon());
    let tolerance = T::lit(64.0) * half;
    let is_angle = |k: usize| k < 64 && ANGLES >> k & 1 == 1;
    // Lengths are compared beside the greatest one.
    let lengths = mode.position.iter().enumerate().filter(|(k, _)| !is_angle(*k));
    let size = lengths.fold(T::lit(0.0), |size, (_, &x)| Real::max(size, Real::abs(x)));
    let mut is_new = Real::le(mode.residual, half);
    for other in row.iter() {
        let mut is_other = Real::lt(T::lit(1.0), T::lit(0.0));
        for (k, (&x, &y)) in mode.position.iter().zip(&other.position).enumerate() {
            let apart = Real::abs(x - y);
            // Nothing is near to what is no number. An angle may come out on either side of half a turn.
            let same = match is_angle(k) {
                true => Real::le(Real::min(apart, Real::abs(apart - T::lit(core::f64::consts::TAU))), tolerance),
                false => Real::le(apart, tolerance * size),
            };
            is_other = is_other | !same;
        }
        is_new = is_new & is_other;
    }
    for (place, slot) in row.iter_mut().enumerate() {
        let here = is_new & Real::eq(*count, T::lit(place as f64));
        slot.residual = Real::select(here, mode.residual, slot.residual);
        for (slot, &x) in slot.position.iter_mut().zip(&mode.position) {
            *slot = Real::select(here, x, *slot);
        }
    }
    *count += Real::select(is_new, T::lit(1.0), T::lit(0.0));
}

/// All assembly modes where no angle is unknown, from `MODES` choices of sides: real ones first, each once.
#[must_use]
pub fn modes_by_sides<T: Real, const MODES: usize, const ANGLES: u64, const N: usize>(
    mode: impl Fn(&Alternative<T>) -> AssemblyMode<T, N>,
) -> [AssemblyMode<T, N>; MODES] {
    let point = [T::lit(1.0), T::lit(0.0)];
    let (mut modes, mut count) = ([unknown(); MODES], T::lit(0.0));
    for choice in 0..MODES {
        insert::<T, ANGLES, N>(&mut modes, &mut count, &mode(&Alternative { point, sides: sides(choice) }));
    }
    modes
}

fn unknown<T: Real, const N: usize>() -> AssemblyMode<T, N> {
    let nan = T::lit(f64::NAN);
    AssemblyMode { position: SVector::repeat(nan), residual: nan }
}

/// The sides that a number says, by its binary digits.
fn sides<T: Real>(choice: usize) -> [T; 3] {
    [0, 1, 2].map(|k| T::lit(if choice >> k & 1 == 1 { -1.0 } else { 1.0 }))
}
