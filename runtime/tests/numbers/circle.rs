//! Roots of sums of sines and cosines against sums that are made of their roots.

use multibody::assembly::roots::on_circle;
use multibody::simba::simd::{SimdValue, WideF64x4};

/// Numbers between minus one and one, the same in every run.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

/// The product of sin((t - r) / 2) over real roots, and of cosh(h) - cos(t - r) over pairs that are not.
fn value(real: &[f64], pairs: &[[f64; 2]], [c, s]: [f64; 2]) -> f64 {
    let t = s.atan2(c);
    let real: f64 = real.iter().map(|r| ((t - r) / 2.0).sin()).product();
    let pairs: f64 = pairs.iter().map(|[r, h]| h.cosh() - (t - r).cos()).product();
    // Roots come in pairs, so the sign of the product does not depend on the turn.
    real * pairs
}

/// How far the roots that are found are from those that there are, and how many are found.
fn compare(found: &[[f64; 2]], real: &[f64]) -> f64 {
    let angles: Vec<f64> = found.iter().filter(|p| !p[0].is_nan()).map(|[c, s]| s.atan2(*c)).collect();
    assert_eq!(angles.len(), real.len(), "{angles:?} for {real:?}");
    let real_first = found.iter().position(|p| p[0].is_nan()).unwrap_or(found.len());
    assert!(found[real_first..].iter().flatten().all(|x| x.is_nan()), "real ones stand first");
    let apart = |a: f64, b: f64| ((a - b) / 2.0).sin().abs() * 2.0;
    let nearest = |list: &[f64], a: f64| list.iter().map(|&b| apart(a, b)).fold(f64::MAX, f64::min);
    let there = real.iter().map(|&r| nearest(&angles, r));
    let back = angles.iter().map(|&a| nearest(real, a));
    there.chain(back).fold(0.0, f64::max)
}

/// `count` angles that are at least so far apart.
fn apart(random: &mut Random, count: usize, gap: f64) -> Vec<f64> {
    let mut list: Vec<f64> = Vec::new();
    while list.len() < count {
        let next = random.next() * core::f64::consts::PI;
        if list.iter().all(|&r| ((r - next) / 2.0).sin().abs() * 2.0 > gap) {
            list.push(next);
        }
    }
    list
}

/// How far a relative rounding of the greatest value moves a root, at most.
fn condition(real: &[f64], pairs: &[[f64; 2]]) -> f64 {
    let at = |t: f64| value(real, pairs, [t.cos(), t.sin()]).abs();
    let greatest = (0..360).map(|k| at(k as f64 * core::f64::consts::PI / 180.0)).fold(0.0, f64::max);
    let slope = |r: f64| at(r + 1e-5).max(at(r - 1e-5)) / 1e-5;
    real.iter().map(|&r| greatest / slope(r)).fold(1.0, f64::max)
}

/// Checks sums of one degree; gives how many were too badly conditioned.
fn degree<const SAMPLES: usize, const ROOTS: usize>() -> usize {
    let (mut random, mut skipped) = (Random(ROOTS as u64 + 1), 0);
    for number in 0..400 {
        let count = 2 * (number % (ROOTS / 2 + 1));
        let real = apart(&mut random, count, 0.01);
        let pairs: Vec<[f64; 2]> =
            (0..(ROOTS - count) / 2).map(|_| [random.next() * 3.0, 0.02 + random.next().abs()]).collect();
        let condition = condition(&real, &pairs);
        if condition > 1e9 {
            skipped += 1;
            continue;
        }
        let found = on_circle::<f64, SAMPLES, ROOTS>(|point| 3e-7 * value(&real, &pairs, point));
        let error = compare(&found, &real);
        assert!(error < 1e-14 * condition, "{error:e}, {condition:e}: {real:?} {pairs:?}");
    }
    skipped
}

#[test]
fn all_real_roots_are_found() {
    let skipped = [degree::<3, 2>(), degree::<5, 4>(), degree::<7, 6>(), degree::<9, 8>(), degree::<17, 16>()];
    assert!(skipped.iter().all(|&skipped| skipped < 40), "{skipped:?}");
}

/// Also at the points where samples are taken, and opposite to them, where a tangent of the half angle is infinite.
#[test]
fn roots_may_lie_anywhere() {
    for k in 0..720 {
        let turn = k as f64 * core::f64::consts::PI / 360.0;
        let real: Vec<f64> = [0.0, 0.9, 2.0, 3.1, 4.0, 5.0].map(|r: f64| r + turn).to_vec();
        let found = on_circle::<f64, 7, 6>(|point| value(&real, &[], point));
        assert!(compare(&found, &real) < 1e-13, "{turn}");
        let real: Vec<f64> = real.iter().map(|r| r + 0.377 - turn).collect();
        let found = on_circle::<f64, 7, 6>(|point| value(&real, &[], point));
        assert!(compare(&found, &real) < 1e-13, "{turn}");
    }
}

#[test]
fn lanes_are_apart_and_single_precision_serves() {
    let roots: [[f64; 4]; 4] = core::array::from_fn(|lane| [0.1, 1.3, 2.9, 4.4].map(|r| r + 0.37 * lane as f64));
    // Lane 2 has none.
    let shift = [0.0, 0.0, 100.0, 0.0];
    let found = on_circle::<WideF64x4, 5, 4>(|point| {
        let lanes: [f64; 4] = core::array::from_fn(|k| value(&roots[k], &[], point.map(|x| x.extract(k))) + shift[k]);
        WideF64x4::from(lanes)
    });
    for (lane, roots) in roots.iter().enumerate() {
        let own: Vec<[f64; 2]> = found.iter().map(|p| p.map(|x| x.extract(lane))).collect();
        let there: &[f64] = if lane == 2 { &[] } else { roots };
        assert!(compare(&own, there) < 1e-14);
    }
    let found = on_circle::<f32, 17, 16>(|[c, s]| {
        let real: Vec<f64> = (0..16).map(|k| 0.39 * k as f64).collect();
        value(&real, &[], [c, s].map(f64::from)) as f32
    });
    let real: Vec<f64> = (0..16).map(|k| 0.39 * k as f64).collect();
    let found: Vec<[f64; 2]> = found.iter().map(|p| p.map(f64::from)).collect();
    assert!(compare(&found, &real) < 1e-4);
}

/// A sum that touches zero has a root there, on whichever side of it rounding leaves the value.
#[test]
fn double_roots_are_one_or_two() {
    let mut random = Random(9);
    for number in 0..200 {
        let other = apart(&mut random, 3, 0.4);
        let pairs = [[random.next() * 3.0, 0.5]];
        let double = other[0];
        let real = [double, double, other[1], other[2]];
        let off = [0.0, 1e-16, -1e-16, 3e-16][number % 4];
        let found = on_circle::<f64, 7, 6>(|point| off + value(&real, &pairs, point));
        let angles: Vec<f64> = found.iter().filter(|p| !p[0].is_nan()).map(|[c, s]| s.atan2(*c)).collect();
        assert!((3..=4).contains(&angles.len()), "{angles:?} {real:?}");
        for r in real {
            let nearest = angles.iter().map(|a| ((a - r) / 2.0).sin().abs()).fold(f64::MAX, f64::min);
            assert!(nearest < 1e-5, "{nearest:e} {angles:?} {real:?}");
        }
    }
}

#[test]
fn what_is_not_finite_has_no_roots() {
    for bad in [f64::NAN, f64::INFINITY] {
        let found = on_circle::<f64, 5, 4>(|[c, s]| if c > 0.5 { bad } else { s });
        assert!(found.iter().flatten().all(|x| x.is_nan()));
    }
}
