//! Half of a mass matrix against the whole, of compiled models on oblique axes: every entry to the bit.

use multibody::multibody;
use multibody::{LowerTriangle, Real};
use nalgebra::{SMatrix, SVector};

multibody! {
    /// An arm of four joints on a rail that rises, with an armature.
    mod arm {
        param m = 1.3;
        param reach = 0.7;
        world { gravity: -9.81 * Z }
        body sled { mass: 2.1, com: [0.1, -0.2, 0.05], inertia: inertia(0.3, 0.4, 0.5, 0.01, -0.02, 0.03) }
        body upper { mass: m, com: [0.2 * reach, 0.1, -0.3], inertia: inertia(0.2, 0.25, 0.3, -0.02, 0.01, 0.04) }
        body lower { mass: 0.8, com: [-0.1, 0.3, 0.2], inertia: diag(0.05, 0.06, 0.07) }
        body hand { mass: 0.4, com: [0.05, 0.02, 0.1], inertia: inertia(0.02, 0.03, 0.025, 0.004, 0.002, -0.003) }
        joint rail: Prismatic { parent: ground, child: sled, axis: [0.6, 0.0, 0.8] }
        joint shoulder: Revolute { parent: sled.at([0.1, 0.2, 0.3]), child: upper, axis: [1.0, 2.0, 2.0], armature: 0.07 }
        joint elbow: Universal { parent: upper.at([reach, 0.1, 0.0]).rotated([1.0, -1.0, 0.5], 0.6), child: lower, axes: [X, Y] }
        joint wrist: Revolute { parent: lower.at([0.3, -0.1, 0.4]), child: hand, axis: [2.0, -1.0, 2.0] }
        emit mass_matrix, mass_matrix_lower, energy;
    }
}

multibody! {
    /// A body that flies with two limbs: branches that don't know of each other.
    mod flying {
        body hull { mass: 3.0, com: [0.1, 0.0, -0.05], inertia: inertia(0.4, 0.5, 0.6, 0.03, -0.04, 0.02) }
        body left { mass: 1.0, com: [0.3, 0.1, 0.2], inertia: diag(0.03, 0.1, 0.1) }
        body right { mass: 0.7, com: [-0.2, 0.1, 0.3], inertia: diag(0.02, 0.05, 0.06) }
        joint free: Free { parent: ground, child: hull }
        joint hip: Revolute { parent: hull.at([0.3, 0.2, 0.1]), child: left, axis: [1.0, 2.0, -2.0] }
        joint tail: Ball { parent: hull.at([-0.4, 0.1, 0.0]), child: right }
        emit mass_matrix, mass_matrix_lower;
    }
}

multibody! {
    /// A loop in closed form.
    mod four_bar {
        formulation { constraints: Reduced }
        body arm { mass: 1.0, com: [0.5, 0.1, 0.0], inertia: rod(1.0, 1.0, X) }
        body link { mass: 3.5, com: [1.75, -0.2, 0.0], inertia: rod(3.5, 3.5, X) }
        body lever { mass: 3.0, com: 1.5 * X, inertia: rod(3.0, 3.0, X) }
        body bob { mass: 0.6, com: -0.7 * Y }
        joint crank: Revolute { parent: ground, child: arm, axis: Z }
        joint coupler: Revolute { parent: arm.at(X), child: link, axis: Z }
        joint rocker: Revolute { parent: ground.at(4.0 * X), child: lever, axis: Z }
        #[cut]
        joint pin: Revolute { parent: link.at(3.5 * X), child: lever.at(3.0 * X), axis: Z }
        solve (coupler, rocker) from pin { sin(rocker.angle - crank.angle - coupler.angle) > 0.0 }
        joint hang: Revolute { parent: lever.at(3.0 * X), child: bob, axis: Z }
        emit mass_matrix, mass_matrix_lower;
    }
}

multibody! {
    /// Nobody asks for the whole.
    mod alone {
        body upper { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        body lower { mass: 1.5, com: -0.4 * Y, inertia: rod(1.5, 0.8, Y) }
        joint shoulder: Revolute { parent: ground, child: upper, axis: Z }
        joint elbow: Revolute { parent: upper.at(-Y), child: lower, axis: Z }
        emit mass_matrix_lower;
    }
}

fn compare<const N: usize, const P: usize>(lower: &LowerTriangle<f64, N, P>, whole: &SMatrix<f64, N, N>) {
    let mut packed = lower.packed().iter();
    for i in 0..N {
        for j in 0..=i {
            let x = packed.next().unwrap();
            assert!(x.is_finite() && x.to_bits() == whole[(i, j)].to_bits(), "{i} {j}: {x} {}", whole[(i, j)]);
            assert_eq!(whole[(i, j)].to_bits(), whole[(j, i)].to_bits());
            assert_eq!((lower.get(i, j), lower.get(j, i)), (Some(*x), Some(*x)));
        }
    }
    assert!(packed.next().is_none());
    assert_eq!(lower.full(), *whole);
    let v = SVector::<f64, N>::from_fn(|i, _| 0.7 - 0.31 * i as f64);
    let (got, wanted) = (lower.times(&v), whole * v);
    assert!((got - wanted).amax() <= 1e-14 * (whole.abs() * v.abs()).amax(), "{got} {wanted}");
    for (row, column) in [(N, 0), (0, N), (usize::MAX, 1), (usize::MAX, usize::MAX)] {
        assert_eq!(lower.get(row, column), None);
    }
}

/// Poses that are near the default, far from it, and several turns away.
fn angles() -> impl Iterator<Item = f64> {
    [0.0, 0.3, -2.9, 17.4, 1.1, -40.2].into_iter()
}

#[test]
fn of_an_arm() {
    for (k, a) in angles().enumerate() {
        let params = arm::Params { m: 0.4 + 0.9 * k as f64, reach: 1.9 - 0.2 * a };
        let model = arm::Model::new(&params);
        let q = SVector::from([0.3 - a, a, 2.0 * a + 0.4, -0.7 * a, 1.0 - a]).into();
        compare(&model.mass_matrix_lower(&q), &model.mass_matrix(&q));
        // The energy knows nothing of either.
        let v = SVector::from([0.2, -1.1, 0.8, 0.5, -0.4]);
        let energy = model.kinetic_energy(&arm::State { q, v: v.into() });
        let by_mass = 0.5 * v.dot(&model.mass_matrix_lower(&q).times(&v));
        assert!((energy - by_mass).abs() < 1e-12 * energy, "{energy} {by_mass}");
    }
}

#[test]
fn of_branches_with_quaternions() {
    let model = flying::Model::<f64>::default();
    for a in angles() {
        let mut q = flying::State::<f64>::default().q;
        q.hip = a;
        q.free.orientation = nalgebra::UnitQuaternion::from_euler_angles(a, 0.4 - a, 2.0 * a);
        q.tail = nalgebra::UnitQuaternion::from_euler_angles(1.0 - a, a, 0.3);
        compare(&model.mass_matrix_lower(&q), &model.mass_matrix(&q));
    }
}

#[test]
fn of_a_closed_loop() {
    let model = four_bar::Model::<f64>::default();
    for a in angles() {
        let q = SVector::from([a, 0.5 - 2.0 * a]).into();
        compare(&model.mass_matrix_lower(&q), &model.mass_matrix(&q));
    }
}

/// Two rods by hand: the elbow's inertia is that of a rod about its end.
#[test]
fn that_is_asked_for_alone() {
    fn elbow<T: Real>() -> T {
        alone::Model::<T>::default().mass_matrix_lower(&Default::default()).packed()[2]
    }
    let wanted = 1.5 * 0.8 * 0.8 / 3.0;
    assert!((elbow::<f64>() - wanted).abs() < 1e-15);
    assert!((f64::from(elbow::<f32>()) - wanted).abs() < 1e-7);
}
