//! Small linear systems against matrices with known solutions, against nalgebra, and at their edges.

use multibody::linear::{least_norm, least_norm_in_groups, solve, solve_symmetric, solve_symmetric_in_groups};
use multibody::nalgebra::{SMatrix, SVector};
use multibody::simba::simd::{SimdValue, WideF32x8, WideF64x4};
use multibody::{Real, Tangent};

/// Numbers between minus one and one, the same in every run.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
    fn matrix<const M: usize, const N: usize>(&mut self) -> SMatrix<f64, M, N> {
        SMatrix::from_fn(|_, _| self.next())
    }
}

fn rows<const M: usize, const N: usize>(a: &SMatrix<f64, M, N>) -> [[f64; N]; M] {
    core::array::from_fn(|i| core::array::from_fn(|j| a[(i, j)]))
}

/// `U V^T` of random factors.
fn of_rank<const N: usize>(random: &mut Random, rank: usize) -> SMatrix<f64, N, N> {
    (0..rank).fold(SMatrix::zeros(), |sum, _| sum + random.matrix::<N, 1>() * random.matrix::<1, N>())
}

fn solutions<const N: usize>(random: &mut Random) {
    for rank in 0..=N {
        let a = of_rank::<N>(random, rank);
        let x = random.matrix::<N, 1>();
        let (found, count) = solve(rows(&a), (a * x).into());
        assert_eq!(count, rank as f64, "{a}");
        let condition = if rank == N { a.norm() * a.try_inverse().unwrap().norm() } else { 1e4 };
        assert!((a * SVector::from(found) - a * x).norm() < 1e-13 * (1.0 + x.norm() * a.norm()), "{rank} of {N}");
        if rank == N {
            assert!((SVector::from(found) - x).norm() < 1e-15 * condition * 10.0, "{N}");
        }

        let s = a * a.transpose();
        let (found, count) = solve_symmetric(rows(&s), (s * x).into());
        assert_eq!(count, rank as f64, "{s}");
        assert!((s * SVector::from(found) - s * x).norm() < 1e-13 * (1.0 + x.norm() * s.norm()), "{rank} of {N}");
    }
}

#[test]
fn systems_of_every_rank() {
    let random = &mut Random(1);
    for _ in 0..50 {
        solutions::<1>(random);
        solutions::<2>(random);
        solutions::<3>(random);
        solutions::<6>(random);
        solutions::<9>(random);
    }
    assert_eq!(solve::<f64, 0>([], []), ([], 0.0));
    assert_eq!(solve_symmetric::<f64, 0>([], []), ([], 0.0));
}

#[test]
fn pivots_come_from_anywhere() {
    // A permutation has no pivot on its diagonal, and every one of them has to be found.
    let mut a = [[0.0; 5]; 5];
    for (row, column) in [3, 0, 4, 1, 2].into_iter().enumerate() {
        a[row][column] = 2.0 + row as f64;
    }
    let (x, rank) = solve(a, [2.0, 6.0, 12.0, 20.0, 30.0]);
    for (x, expected) in x.into_iter().zip([2.0, 4.0, 5.0, 1.0, 3.0]) {
        assert!((x - expected).abs() < 1e-14, "{x} {expected}");
    }
    assert_eq!(rank, 5.0);
}

/// The Hilbert matrix of order six has a condition of 1.5e7, and its inverse is known in integers.
#[test]
fn hilbert() {
    let a: [[f64; 6]; 6] = core::array::from_fn(|i| core::array::from_fn(|j| 1.0 / (i + j + 1) as f64));
    let column = [36.0, -630.0, 3360.0, -7560.0, 7560.0, -2772.0];
    let first = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    for (x, rank) in [solve(a, first), solve_symmetric(a, first)] {
        assert_eq!(rank, 6.0);
        for (x, expected) in x.into_iter().zip(column) {
            assert!((x / expected - 1.0).abs() < 1e-9, "{x} {expected}");
        }
    }
}

/// Units must not matter: neither to digits nor to the rank.
#[test]
fn scales_far_apart() {
    let random = &mut Random(7);
    for _ in 0..100 {
        let g = random.matrix::<5, 5>();
        let scale: [f64; 5] = core::array::from_fn(|_| 10f64.powi((random.next() * 15.0) as i32));
        let x: [f64; 5] = core::array::from_fn(|_| random.next());
        let condition = g.norm() * g.try_inverse().unwrap().norm();

        let s = g * g.transpose();
        let scaled = SMatrix::<f64, 5, 5>::from_fn(|i, j| scale[i] * s[(i, j)] * scale[j]);
        let b = s * SVector::from(x);
        let (found, rank) = solve_symmetric(rows(&scaled), core::array::from_fn(|i| scale[i] * b[i]));
        assert_eq!(rank, 5.0);
        for i in 0..5 {
            assert!((found[i] * scale[i] - x[i]).abs() < 1e-15 * condition * condition * 10.0);
        }

        let other: [f64; 5] = core::array::from_fn(|_| 10f64.powi((random.next() * 15.0) as i32));
        let scaled = SMatrix::<f64, 5, 5>::from_fn(|i, j| scale[i] * g[(i, j)] * other[j]);
        let b = g * SVector::from(x);
        let (found, rank) = solve(rows(&scaled), core::array::from_fn(|i| scale[i] * b[i]));
        assert_eq!(rank, 5.0);
        for i in 0..5 {
            assert!((found[i] * other[i] - x[i]).abs() < 1e-15 * condition * 20.0);
        }
    }
}

#[test]
fn nothing_is_lost_behind_the_rank() {
    let random = &mut Random(3);
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for rank in 0..=4 {
            let a = of_rank::<4>(random, rank);
            let s = a * a.transpose();
            for i in 0..4 {
                for j in 0..4 {
                    let mut matrix = rows(&a);
                    matrix[i][j] = bad;
                    let (x, count) = solve(matrix, [1.0, 2.0, 3.0, 4.0]);
                    assert!(count.is_nan() && x.iter().all(|x| x.is_nan()), "{matrix:?}: {x:?}, {count}");

                    let mut matrix = rows(&s);
                    matrix[i][j] = bad;
                    matrix[j][i] = bad;
                    let (x, count) = solve_symmetric(matrix, [1.0, 2.0, 3.0, 4.0]);
                    assert!(count.is_nan() && x.iter().all(|x| x.is_nan()), "{matrix:?}: {x:?}, {count}");

                    let mut g = a.fixed_view::<4, 3>(0, 0).into_owned();
                    if j < 3 {
                        g[(i, j)] = bad;
                        let (d, count) = least_norm(&g, &SVector::zero(), &SVector::from([1.0, 0.0, 1.0]));
                        assert!(count.is_nan() && d.iter().all(|d| d.is_nan()), "{g}: {d}, {count}");
                    }
                }
                let mut b = [1.0; 4];
                b[i] = bad;
                for (x, count) in [solve(rows(&a), b), solve_symmetric(rows(&s), b)] {
                    assert!(count == rank as f64 && x.iter().any(|x| !x.is_finite()), "{a} {b:?}: {x:?}");
                }
                let (d, count) = least_norm(&a, &b.into(), &SVector::from([1.0; 4]));
                assert!(count == rank as f64 && d.iter().all(|d| d.is_nan()), "{a} {b:?}: {d}");
            }
        }
    }
}

#[test]
fn what_is_dropped_is_zero() {
    let (x, rank) = solve([[0.0; 3]; 3], [1.0_f64, 2.0, 3.0]);
    assert_eq!((x, rank), ([0.0; 3], 0.0));
    let (x, rank) = solve_symmetric([[0.0; 3]; 3], [1.0_f64, 2.0, 3.0]);
    assert_eq!((x, rank), ([0.0; 3], 0.0));
    let (d, rank) = least_norm(&SMatrix::<f64, 2, 3>::zeros(), &SVector::from([1.0, 2.0]), &SVector::from([1.0; 3]));
    assert_eq!((d, rank), (SVector::zero(), 0.0));
    let (d, rank) = least_norm(&SMatrix::<f64, 0, 3>::zeros(), &SVector::zero(), &SVector::from([1.0; 3]));
    assert_eq!((d, rank), (SVector::zero(), 0.0));
}

/// Against the pseudo-inverse by singular values.
fn displacements<const M: usize, const N: usize>(random: &mut Random, rank: usize, held: usize) {
    let mut g = SMatrix::<f64, M, N>::zeros();
    for _ in 0..rank {
        g += random.matrix::<M, 1>() * random.matrix::<1, N>();
    }
    let weights: [f64; N] = core::array::from_fn(|j| if j < held { 0.0 } else { random.next().abs() + 0.1 });
    let roots = SMatrix::<f64, N, N>::from_diagonal(&SVector::from(weights.map(f64::sqrt)));
    let r = g * roots * random.matrix::<N, 1>();

    let (d, count) = least_norm(&g, &r, &weights.into());
    assert_eq!(count, rank.min(N - held) as f64, "{M}x{N} of rank {rank}, {held} held");
    assert!(d.iter().take(held).all(|&d| d == 0.0));
    assert!((g * d - r).norm() < 1e-13 * (1.0 + r.norm()), "{}", (g * d - r).norm());

    let scaled = multibody::nalgebra::DMatrix::from_fn(M, N, |i, j| (g * roots)[(i, j)]);
    let right = multibody::nalgebra::DVector::from_fn(M, |i, _| r[i]);
    let expected = scaled.svd(true, true).solve(&right, 1e-10).unwrap();
    for j in 0..N {
        assert!((d[j] - roots[(j, j)] * expected[j]).abs() < 1e-10 * (1.0 + expected.norm()));
    }
}

#[test]
fn least_displacements() {
    let random = &mut Random(11);
    for _ in 0..50 {
        displacements::<1, 1>(random, 1, 0);
        displacements::<2, 5>(random, 2, 0);
        displacements::<2, 5>(random, 2, 3);
        displacements::<4, 6>(random, 2, 1);
        displacements::<5, 3>(random, 3, 0); // more equations than coordinates
        displacements::<5, 3>(random, 1, 1);
        displacements::<8, 9>(random, 8, 0);
        displacements::<10, 9>(random, 8, 0);
    }
}

/// Rows count as independent down to the threshold itself, not to its root.
#[test]
fn rows_that_are_nearly_one() {
    for (gap, expected) in [(1e-6, 2.0), (1e-11, 2.0), (1e-15, 1.0)] {
        let g = SMatrix::<f64, 2, 3>::from_row_slice(&[1.0, 1.0, 0.0, 1.0, 1.0 + gap, 0.0]);
        let (d, rank) = least_norm(&g, &SVector::from([1.0, 1.0]), &SVector::from([1.0; 3]));
        assert_eq!(rank, expected, "{gap}");
        assert!((g * d - SVector::from([1.0, 1.0])).norm() < 1e-14, "{gap}: {d}");
    }
}

/// An equation in millimetres or in light years says what it says in metres.
#[test]
fn units_do_not_matter() {
    let random = &mut Random(3);
    for rank in 1..=5 {
        let g = {
            let mut g = SMatrix::<f64, 5, 7>::zeros();
            for _ in 0..rank {
                g += random.matrix::<5, 1>() * random.matrix::<1, 7>();
            }
            g
        };
        let r = g * random.matrix::<7, 1>();
        let ones = SVector::from([1.0; 7]);
        let (d, seen) = least_norm(&g, &r, &ones);
        let (x, _) = solve_symmetric(rows(&(g * g.transpose())), r.into());
        assert_eq!(seen, f64::from(rank));
        for row in 0..5 {
            for unit in [1e-9, 1e9] {
                let mut units = SVector::<f64, 5>::from([1.0; 5]);
                units[row] = unit;
                let units = SMatrix::<f64, 5, 5>::from_diagonal(&units);
                // Each for itself; and the row of another unit in a group of its own.
                let groups = core::array::from_fn(|k| usize::from(k == row));
                for (other, seen) in [
                    least_norm(&(units * g), &(units * r), &ones),
                    least_norm_in_groups(&(units * g), &(units * r), &ones, &groups),
                ] {
                    assert_eq!(seen, f64::from(rank), "row {row} in units of {unit:e}");
                    assert!((other - d).amax() < 1e-11 * (1.0 + d.amax()), "row {row} in units of {unit:e}");
                }
                let square = rows(&(units * g * g.transpose() * units));
                let right = (units * r).into();
                for (other, seen) in [solve_symmetric(square, right), solve_symmetric_in_groups(square, right, &groups)]
                {
                    assert_eq!(seen, f64::from(rank), "row {row} in units of {unit:e}");
                    let (pulled, expected) =
                        (g.transpose() * units * SVector::from(other), g.transpose() * SVector::from(x));
                    assert!((pulled - expected).amax() < 1e-9 * (1.0 + expected.amax()));
                }
            }
        }
    }
}

/// What rounding leaves of an equation that vanishes is told from an equation in another unit by those beside it.
#[test]
fn rounding_in_a_group_is_no_equation() {
    let random = &mut Random(8);
    for unit in [1.0, 1e-9, 1e9] {
        let mut g = random.matrix::<4, 6>();
        for j in 0..6 {
            g[(1, j)] *= 1e-16; // beside row 0
            g[(2, j)] *= unit;
            g[(3, j)] *= 1e-16 * unit; // beside row 2
        }
        let groups = [0, 0, 1, 1];
        let ones = SVector::from([1.0; 6]);
        let r = SVector::from([1.0, 1.0, unit, unit]);
        let (d, rank) = least_norm_in_groups(&g, &r, &ones, &groups);
        assert_eq!(rank, 2.0, "{unit:e}");
        assert!(d.amax() < 1e2, "{unit:e}: {d}");
        let (x, rank) = solve_symmetric_in_groups(rows(&(g * g.transpose())), r.into(), &groups);
        assert_eq!((rank, x[1], x[3]), (2.0, 0.0, 0.0), "{unit:e}");
        // Each for itself, all are equations, down to the root of the least number of single precision.
        assert_eq!(least_norm(&g, &r, &ones).1, if unit < 1.0 { 3.0 } else { 4.0 });
    }
}

macro_rules! lanes_agree {
    ($test:ident, $lanes:ty, $element:ident) => {
        #[test]
        fn $test() {
            const LANES: usize = <$lanes as SimdValue>::LANES;
            let random = &mut Random(5);
            // Different pivots and ranks beside each other, and one lane that is no number.
            let systems: Vec<SMatrix<f64, 4, 4>> = (0..LANES).map(|lane| of_rank::<4>(random, 1 + lane % 4)).collect();
            let mut a = [[<$lanes>::lit(0.0); 4]; 4];
            let b: [f64; 4] = [1.0, -2.0, 3.0, 0.5];
            for i in 0..4 {
                for j in 0..4 {
                    for lane in 0..LANES {
                        a[i][j].replace(lane, systems[lane][(i, j)] as $element);
                    }
                }
            }
            a[2][1].replace(1, $element::NAN);
            let (x, rank) = solve(a, b.map(<$lanes>::lit));
            for lane in 0..LANES {
                let single = core::array::from_fn(|i| core::array::from_fn(|j| a[i][j].extract(lane)));
                let (expected, expected_rank) = solve::<$element, 4>(single, b.map(|b| b as $element));
                let same = |a: $element, b: $element| a == b || (a.is_nan() && b.is_nan());
                assert!(same(rank.extract(lane), expected_rank), "{lane}");
                assert_eq!(rank.extract(lane).is_nan(), lane == 1);
                for i in 0..4 {
                    assert!(same(x[i].extract(lane), expected[i]), "{lane}");
                }
            }
        }
    };
}

lanes_agree!(four_of_f64, WideF64x4, f64);
lanes_agree!(eight_of_f32, WideF32x8, f32);

#[test]
fn roundings_of_every_scalar() {
    assert_eq!(<f64 as Real>::epsilon(), f64::EPSILON);
    assert_eq!(<f32 as Real>::epsilon(), f32::EPSILON);
    assert_eq!(<WideF64x4 as Real>::epsilon().greatest(), f64::EPSILON);
    assert_eq!(<WideF32x8 as Real>::epsilon().greatest(), f64::from(f32::EPSILON));
}

/// A row that is nothing but rounding beside the others of its group has no say; above that it has.
#[test]
fn rows_of_rounding_are_no_equations() {
    let weights = SVector::<f64, 3>::repeat(1.0);
    for (size, rank) in [(1e-17, 1.0), (1e-15, 1.0), (1e-12, 2.0), (1e-6, 2.0)] {
        let g = SMatrix::<f64, 2, 3>::new(1.0, 2.0, 3.0, size, -size, 0.0);
        let (d, seen) = least_norm_in_groups(&g, &SVector::<f64, 2>::new(14.0, 0.0), &weights, &[7, 7]);
        assert_eq!(seen, rank, "{size:e}");
        assert!(
            ((g.row(0) * d)[0] - 14.0).abs() < 1e-12
                && (rank == 2.0 || (d - SVector::<f64, 3>::new(1.0, 2.0, 3.0)).amax() < 1e-14)
        );
    }
}
