//! Functions that take numbers and no system: linear systems, rotations, scalars, checks.

use super::drawn::{Drawn, Numbers, all};
use multibody::linear::{
    ComplexFactors, Factors, Solve, Square, least_norm, least_norm_in_groups, solve, solve_symmetric,
    solve_symmetric_in_groups, solve_symmetric_measured,
};
use multibody::nalgebra::{Quaternion, SMatrix, SVector, UnitQuaternion, Vector3};
use multibody::simba::simd::{WideF32x8, WideF64x4};
use multibody::{Configuration, LowerTriangle, Packed, Pose, Real, Tangent, inertia_violation, rotation};
use std::hint::black_box;

/// A group for each equation, in no order and with gaps: any number is one.
fn groups<const N: usize>(n: &Numbers) -> [usize; N] {
    // Of NaN and negative numbers it is zero, of the greatest the greatest.
    [(); N].map(|()| n.draw() as usize)
}

fn linear<T: Drawn>(n: &Numbers) {
    fn square<T: Drawn, const N: usize>(n: &Numbers) {
        let row = || [(); N].map(|()| n.scalar::<T>());
        let (matrix, other, right) = ([(); N].map(|()| row()), [(); N].map(|()| row()), row());
        black_box(solve(matrix, right));
        black_box(solve_symmetric(matrix, right));
        black_box(solve_symmetric_in_groups(matrix, right, &groups(n)));
        black_box(solve_symmetric_measured(matrix, right, row(), &groups(n)));
        black_box(Factors::new(&matrix).solve(&right));
        black_box(ComplexFactors::new(&matrix, &other).solve(&(right, row())));
        let made: [[T; N]; N] = Square::from_fn(|i, j| matrix.get(j, i));
        black_box(made.solution(&right));
        black_box(made.times(&<[[T; N]; N]>::vector(|i| right[i])));
        black_box(<[[T; N]; N]>::packed(&n.vector::<T, SVector<T, 3>>()));
        black_box(<[[T; N]; N]>::array(|i| i));
        black_box(made.factors().solve(&right));
        black_box(made.complex_factors(&other).solve(&(right, right)));
    }
    fn wide<T: Drawn, const M: usize, const N: usize>(n: &Numbers) {
        let g = SMatrix::<T, M, N>::from_fn(|_, _| n.scalar());
        let (right, weights) = (n.vector::<T, SVector<T, M>>(), n.vector::<T, SVector<T, N>>());
        black_box(least_norm(&g, &right, &weights));
        black_box(least_norm_in_groups(&g, &right, &weights, &groups(n)));
    }
    square::<T, 1>(n);
    square::<T, 3>(n);
    square::<T, 6>(n);
    wide::<T, 2, 4>(n);
    wide::<T, 4, 4>(n);
    wide::<T, 5, 3>(n);
}

fn triangles<T: Drawn>(n: &Numbers) {
    let lower = LowerTriangle::<T, 3, 6>::from_packed([(); 6].map(|()| n.scalar()));
    black_box((lower.packed(), lower.full(), lower.times(&SVector::from_fn(|_, _| n.scalar()))));
    black_box(lower.get(n.draw() as usize, n.draw() as usize));
}

fn rotations<T: Drawn>(n: &Numbers) {
    let vector = || Vector3::<T>::from_fn(|_, _| n.scalar());
    let (d, v) = (vector(), vector());
    let unit = rotation::normalized(n.scalar(), n.scalar(), n.scalar(), n.scalar());
    let any = UnitQuaternion::new_unchecked(Quaternion::new(n.scalar(), n.scalar(), n.scalar(), n.scalar()));
    for q in [unit, any] {
        black_box(rotation::displace(&q, &d));
        black_box(rotation::advance(&q, &d, &v));
        let pose = Pose { position: vector(), orientation: q };
        let twist: <Pose<T> as Configuration<T>>::Velocity = n.vector();
        black_box(pose.displace(&twist).advance(&twist, &n.vector()));
        black_box(pose.magnitude().len());
    }
    black_box(rotation::dexp_inv(&d, &v));
    black_box(rotation::compose(&d, &v));
    black_box(rotation::from_scaled_axis(&v));
    black_box(<Pose<T> as Configuration<T>>::dexp_inv(&n.vector(), &n.vector()).len());
    black_box(<Pose<T> as Configuration<T>>::compose(&n.vector(), &n.vector()).len());
}

fn scalars<T: Drawn>(n: &Numbers) {
    let (x, y): (T, T) = (n.scalar(), n.scalar());
    black_box([Real::sin(x), Real::cos(x), Real::tan(x), Real::asin(x), Real::acos(x), Real::atan(x)]);
    black_box([Real::sinh(x), Real::cosh(x), Real::tanh(x), Real::exp(x), Real::ln(x), Real::sqrt(x)]);
    black_box([Real::abs(x), Real::signum(x), Real::floor(x), Real::sin_cos(x).0, T::lit(n.draw())]);
    black_box(Real::sin_cos_all([x, T::lit(n.draw()), T::lit(n.draw())]));
    let pack = T::four([x, y, T::lit(n.draw()), x]) + T::four_of(y);
    black_box(Real::mul_add(x, y, T::lit(n.draw())));
    black_box(T::members(T::mul_adds(pack, pack, T::four_of(x))));
    black_box(T::members(T::sines(T::roots(pack)).0));
    let pair = T::two([y, T::lit(n.draw())]) / T::two_of(x);
    black_box(T::members(T::mul_adds(pair, -pair, T::roots(pair))));
    black_box(<T::Four as Packed<T, 4>>::roots(Packed::of(T::members(-pack / pack * pack - pack))).members());
    black_box([Real::atan2(x, y), Real::powf(x, y), Real::hypot(x, y), Real::min(x, y), Real::max(x, y)]);
    for power in [0, 1, -1, 7, i32::MAX, i32::MIN, n.draw() as i32] {
        black_box(Real::powi(x, power));
    }
    let less = Real::lt(x, y) | Real::le(x, y) | Real::gt(x, y) | Real::ge(x, y) | Real::eq(x, y) | Real::ne(x, y);
    let known = Real::select(less & Real::is_finite(x), x, y);
    black_box(known.greatest());
    black_box((multibody::any(less), multibody::all(less)));
    let [xx, yy, zz, xy, xz, yz] = std::array::from_fn(|_| n.scalar::<T>());
    black_box(multibody::any(inertia_violation(xx, yy, zz, xy, xz, yz)));
    let (a, b): (SVector<T, 3>, SVector<T, 3>) = (n.vector(), n.vector());
    black_box(a.add(&b).add_scaled(x, &b).scale(y).map(&mut |z| z * x).fold(x, &mut |sum, z| sum + z));
    black_box(Tangent::<T>::zip(&a, &b, &mut |a, b| a - b).len());
    black_box(Tangent::<T>::is_empty(&a));
}

#[test]
fn functions_of_the_runtime() {
    fn every<T: Drawn>(cases: u32) {
        all(cases, |n| {
            linear::<T>(n);
            triangles::<T>(n);
            rotations::<T>(n);
            scalars::<T>(n);
        });
    }
    every::<f64>(512);
    every::<f32>(512);
    every::<WideF64x4>(128);
    every::<WideF32x8>(128);
}
