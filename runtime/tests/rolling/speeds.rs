//! Velocities that are no rates of coordinates: with equations of velocities eliminated, and with speeds of the user's choice, against the
//! same mechanisms with multipliers, and in rates.

use multibody::nalgebra::{DMatrix, DVector, UnitQuaternion, Vector3};
use multibody::{
    Configuration, Constrained, Differentiable, DisplacementOf, Dop853, FullJacobian, GaussLegendre6, Impulsive,
    Integrator, JacobianOf, Projection, Radau, StateSpace, System, Tangent, VelocityOf, WithProjection, multibody,
};

/// One mechanism with multipliers, reduced, and reduced in speeds of its own; with multipliers in these and as many more as these leave
/// rates open. With `paths` there is nothing but what runs take.
macro_rules! four_ways {
    ($names:tt, $independent:tt, $items:tt, $speeds:tt, $more:tt) => {
        four_ways!(@emit
            [forward_dynamics, constraints, impulse],
            [forward_dynamics, inverse_dynamics, mass_matrix, bias, energy, derivatives, linearize, impulse],
            [forward_dynamics, inverse_dynamics, mass_matrix, bias, energy, derivatives, linearize],
            $names, $independent, $items, $speeds, $more);
    };
    (paths $names:tt, $independent:tt, $items:tt, $speeds:tt, $more:tt) => {
        four_ways!(@emit
            [forward_dynamics], [forward_dynamics], [forward_dynamics],
            $names, $independent, $items, $speeds, $more);
    };
    (
        @emit [$($of_held:tt)*], [$($of_beside:tt)*], [$($of_reduced:tt)*],
        [$held:ident, $reduced:ident, $chosen:ident, $beside:ident], $independent:tt,
        { $($items:tt)* }, { $($speeds:tt)* }, { $($more:tt)* }
    ) => {
        multibody! {
            pub(crate) mod $held {
                $($items)*
                formulation { constraints: Multipliers }
                emit $($of_held)*;
            }
            pub(crate) mod $beside {
                $($items)*
                $($speeds)*
                $($more)*
                formulation { constraints: Multipliers }
                emit $($of_beside)*;
            }
            pub(crate) mod $reduced {
                $($items)*
                formulation { constraints: Reduced, independent: $independent }
                emit $($of_reduced)*;
            }
            pub(crate) mod $chosen {
                $($items)*
                $($speeds)*
                formulation { constraints: Reduced, independent: $independent }
                emit $($of_reduced)*;
            }
        }
    };
}

/// Calls a macro with each of four modules, and whether its equations are held.
macro_rules! each_way {
    ($check:ident: $held:ident, $reduced:ident, $chosen:ident, $beside:ident) => {
        $check!($held, true);
        $check!($reduced, false);
        $check!($chosen, false);
        $check!($beside, true);
    };
}

/// By an explicit method; with a projection where equations are held.
macro_rules! run {
    ($model:expr, true, $from:expr, $until:expr, $start:expr, $input:expr, $look:expr) => {
        Integrator::adaptive(Dop853, 1e-14, 1e-14).integrate(
            &WithProjection::new($model, Projection::default()),
            $from,
            $until,
            $start,
            $input,
            $look,
        )
    };
    ($model:expr, false, $from:expr, $until:expr, $start:expr, $input:expr, $look:expr) => {
        Integrator::adaptive(Dop853, 1e-14, 1e-14).integrate(&$model, $from, $until, $start, $input, $look)
    };
}

four_ways!([board_held, board, board_chosen, board_beside], [plane, swing, fore], {
    const L = 0.4;
    param swing_inertia = 0.25;
    world { gravity: [0.3, -0.2, -9.7] }
    body board { mass: 3.0, com: [0.05, 0.02, 0.1], inertia: diag(0.1, 0.1, 0.1) }
    body rotor { mass: 0.5, com: [0.03, 0.0, 0.0], inertia: diag(0.13, 0.13, swing_inertia) }
    body front { mass: 0.2, inertia: diag(0.01, 0.01, 0.01) }
    body back { mass: 0.2, inertia: diag(0.01, 0.01, 0.01) }
    joint plane: Planar { parent: ground.rotated(X, 0.2), child: board, axis: Z }
    joint swing: Revolute { parent: board, child: rotor, axis: Z }
    joint fore: Revolute { parent: board.at(L * X), child: front, axis: Z }
    joint aft: Revolute { parent: board.at(-L * X), child: back, axis: Z }
    constraint alike = fore + aft;
    constraint front_blade: Skate { blade: front, along: 2.0 * X }
    constraint back_blade: Skate { blade: back, along: X }
    input twist;
    input steer;
    force by_rotor: Effort { joint: swing, value: twist }
    force by_foot: Effort { joint: fore, value: steer }
    output moved = [board.acceleration, rotor.angular_acceleration, front.angular_acceleration];
    output forces = [front_blade.force, back_blade.force];
    output energy = kinetic() + potential();
    output rider = board.jacobian;
    output at = board.velocity;
}, {
    /// [m/s]
    speed ahead = board.express(board.velocity).x;
    /// [rad/s]
    speed turned = swing.rate + plane.angle.rate;
    /// [rad/s]
    speed foot = 2.0 * fore.rate - 0.3 * swing.rate;
}, {
    /// [m/s]
    speed aside = board.express(board.velocity).y;
    /// [rad/s]
    speed nod = fore.rate + 0.1 * swing.rate + 0.2 * sin(swing) * plane.angle.rate;
});

four_ways!([ball_held, ball, ball_chosen, ball_beside], [x, y, turn], {
    const R = 0.2;
    /// [rad/s]
    param turning = 1.7;
    world { gravity: [0.5, 0.3, -9.81] }
    body ball { mass: 1.3, com: [0.02, -0.01, 0.03], inertia: inertia(0.02, 0.025, 0.03, 0.001, -0.002, 0.001) }
    body ahead { mass: 0 }
    body aside { mass: 0 }
    joint x: Prismatic { parent: ground.at(R * Z), child: ahead, axis: X }
    joint y: Prismatic { parent: ahead, child: aside, axis: Y }
    joint turn: Ball { parent: aside, child: ball }
    let slip = ball.velocity + cross(ball.angular_velocity, -R * Z) - cross(turning * Z, ball.position);
    constraint along = slip.x;
    constraint across = slip.y;
    output moved = [ball.acceleration, ball.angular_acceleration];
    output forces = [along.multiplier, across.multiplier];
    output energy = kinetic() + potential();
    output at = ball.velocity;
    output rider = ball.jacobian;
    output twist = ball.twist;
}, {
    /// [rad/s]
    speed about_x = ball.angular_velocity.x;
    /// [rad/s]
    speed about_y = ball.angular_velocity.y;
    /// [rad/s]
    speed about_z = ball.angular_velocity.z;
}, {
    /// [m/s]
    speed sliding_along = slip.x;
    /// [m/s]
    speed sliding_across = slip.y + 0.1 * slip.x;
});

four_ways!([wheel_held, wheel, wheel_chosen, wheel_beside], [x, y, turn], {
    param radius = 0.25;
    world { gravity: [0.0, 9.81 * sin(0.5), -9.81 * cos(0.5)] }
    body disc { mass: 0.7, inertia: diag(0.011, 0.0219, 0.011) }
    body ahead { mass: 0 }
    body aside { mass: 0 }
    body above { mass: 0 }
    joint x: Prismatic { parent: ground, child: ahead, axis: [1.0, 0.2, 0.1] }
    joint y: Prismatic { parent: ahead, child: aside, axis: Y }
    joint z: Prismatic { parent: aside, child: above, axis: Z }
    joint turn: Ball { parent: above, child: disc }
    let road = ground.rotated(X, 0.5).rotated(Z, 2.0);
    let hub = disc.rotated(Z, 0.8);
    constraint roll: Rolling { wheel: hub, axis: [3.0 * sin(0.8), 3.0 * cos(0.8), 0.0], radius: radius, on: road }
    output moved = [disc.acceleration, disc.angular_acceleration];
    output forces = [roll.force];
    output energy = kinetic() + potential();
    output at = disc.velocity;
    output rider = disc.jacobian;
    output height = z;
    output rising = z.rate;
    output twist = disc.twist;
}, {
    /// [rad/s]
    speed one = disc.express(disc.angular_velocity).x;
    /// [rad/s]
    speed two = disc.express(disc.angular_velocity).y + 0.2 * disc.express(disc.angular_velocity).x;
    /// [rad/s]
    speed three = disc.express(disc.angular_velocity).z;
}, {
    /// [m/s]
    speed by_x = disc.express(disc.velocity).x;
    /// [m/s]
    speed by_y = disc.express(disc.velocity).y;
    /// [m/s]
    speed by_z = disc.express(disc.velocity).z;
});

four_ways!([trailer_held, trailer, trailer_chosen, trailer_beside], [plane, hinge], {
    param tilt = 0.3;
    world { gravity: [0.1, -0.3, -9.7] }
    body chassis { mass: 3.0, com: [0.2, 0.1, 0.05], inertia: inertia(0.3, 0.4, 0.5, 0.01, 0.02, -0.03) }
    joint plane: Planar { parent: ground, child: chassis, axis: [0.2, 0.1, 1.0] }
    body arm { mass: 0.7, com: [0.1, 0.02, 0.0], inertia: inertia(0.03, 0.02, 0.03, 0.001, 0.002, -0.003) }
    joint hinge: Revolute { parent: chassis.at([0.5, 0.0, 0.1]).rotated(X, tilt), child: arm, axis: Z }
    constraint blade = chassis.express(chassis.velocity).y - 0.3 * hinge.rate;
    constraint nose = arm.express(arm.at([0.3, 0.1, 0.0]).velocity).y + 0.1 * cos(t);
    output moved = [arm.at([0.1, 0.02, 0.0]).acceleration, arm.angular_acceleration];
    output forces = [hinge.reaction.force, hinge.reaction.moment];
    output energy = kinetic() + potential();
    output at = arm.velocity;
    output rider = arm.jacobian;
}, {
    /// [m/s]
    speed ahead = chassis.express(chassis.velocity).x + 0.1 * sin(2.0 * t);
    /// [rad/s]
    speed swing = hinge.rate + (0.3 + 0.1 * sin(hinge)) * plane.angle.rate;
}, {
    /// [m/s]
    speed aside = arm.express(arm.at([0.3, 0.1, 0.0]).velocity).y + 0.2 * cos(3.0 * t);
    /// [rad/s]
    speed yaw = plane.angle.rate - 0.3 * t;
});

multibody! {
    /// A blade whose speed along the world's y axis says nothing where it heads along x.
    pub mod sled {
        body sled { mass: 2.0, com: 0.3 * X, inertia: diag(0.3, 0.3, 0.5) }
        joint plane: Planar { parent: ground, child: sled, axis: Z }
        constraint blade = sled.express(sled.velocity).y;
        formulation { constraints: Reduced, independent: [plane.y, plane.angle] }
        emit forward_dynamics;
    }
    /// The same in its speed along the blade.
    pub mod along {
        body sled { mass: 2.0, com: 0.3 * X, inertia: diag(0.3, 0.3, 0.5) }
        joint plane: Planar { parent: ground, child: sled, axis: Z }
        constraint blade = sled.express(sled.velocity).y;
        /// [m/s]
        speed ahead = sled.express(sled.velocity).x;
        // At fixed rates of coordinates, whatever the velocities are.
        output slope = diff(0.5 * plane.angle * plane.angle + plane.x.rate * plane.y.rate, plane.angle);
        output crossed = diff(plane.x.rate * plane.y.rate, plane.x.rate);
        formulation { constraints: Reduced }
        emit forward_dynamics, energy;
    }
    /// A slide that stands still in its velocity, and moves.
    pub mod belt {
        body load { mass: 1.3 }
        joint slide: Prismatic { parent: ground, child: load, axis: X }
        force spring: Spring { joint: slide, stiffness: 20.0 }
        /// [m/s]
        speed beside = slide.rate - 1.0;
        emit forward_dynamics, derivatives;
    }
    /// One that shakes for a while.
    pub mod shaken {
        body load { mass: 1.3 }
        joint slide: Prismatic { parent: ground, child: load, axis: X }
        force spring: Spring { joint: slide, stiffness: 20.0 }
        /// [m/s]
        speed beside = slide.rate - sin(2.0 * t) * exp(-40.0 * t);
        emit forward_dynamics, derivatives;
    }
}

/// Random numbers between -1 and 1, the same in every run.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        f64::from(u32::try_from(self.0 >> 33).unwrap()) / f64::from(1_u32 << 30) - 1.0
    }

    pub(crate) fn vector<V: Tangent<f64>>(&mut self) -> V {
        V::zero().map(&mut |_| self.next())
    }

    pub(crate) fn turn(&mut self) -> UnitQuaternion<f64> {
        UnitQuaternion::from_scaled_axis(self.vector::<Vector3<f64>>() * 4.0)
    }
}

pub(crate) fn flat<V: Tangent<f64>>(vector: &V) -> Vec<f64> {
    vector.fold(Vec::new(), &mut |mut list, x| {
        list.push(x);
        list
    })
}

fn filled<V: Tangent<f64>>(list: &[f64]) -> V {
    let mut next = list.iter().copied();
    V::zero().map(&mut |_| next.next().unwrap())
}

/// The state with these rates of positions, which the velocities have to be able to give.
pub(crate) fn with_rates<S: System<Scalar = f64>>(system: &S, t: f64, state: &S::State, rates: &[f64]) -> S::State {
    let (q, v, x) = state.split();
    let of = |v: VelocityOf<S>| DVector::from_vec(flat(&system.position_rates(t, &state.join(q, v, x))));
    let still = of(Tangent::zero());
    let count = flat(&v).len();
    let unit = |k: usize| filled(&(0..count).map(|j| f64::from(u8::from(j == k))).collect::<Vec<_>>());
    let columns: Vec<DVector<f64>> = (0..count).map(|k| of(unit(k)) - &still).collect();
    let map = DMatrix::from_columns(&columns);
    let wanted = DVector::from_column_slice(rates) - still;
    let by_columns = map.clone().qr();
    let found = by_columns.r().solve_upper_triangular(&(by_columns.q().transpose() * &wanted)).unwrap();
    let size = 1.0 + wanted.amax();
    assert!((&map * &found - wanted).amax() < 1e-11 * size, "no velocities have these rates: {rates:?}");
    state.join(q, filled(found.as_slice()), x)
}

/// The derivatives of all rates, against differences; and what the slope is made of.
pub(crate) fn derivatives_are_slopes<S, const W: usize>(system: &S, t: f64, state: &S::State, input: &S::Input)
where
    S: Differentiable<Scalar = f64, Matrix = FullJacobian<[[f64; W]; W]>>,
    <S::State as StateSpace>::Velocity: Tangent<f64>,
{
    let jacobian: JacobianOf<S> = system.jacobian(t, state, input);
    let (q, v, x) = state.split();
    let moved = |column: usize, by: f64| {
        let mut place = 0..;
        let mut at = |_: f64| if place.next() == Some(column) { by } else { 0.0 };
        let d: DisplacementOf<S> = Tangent::zero();
        let (d, dv, dx) = (d.map(&mut at), v.map(&mut at), x.map(&mut at));
        let slope = system.slope(t, &state.join(q.displace(&d), v.add(&dv), x.add(&dx)), input);
        [flat(&slope.q), flat(&slope.v), flat(&slope.x)].concat()
    };
    for column in 0..W {
        // Near a singular pose forces are large, and their rounding wants wide steps; where slopes change fast, short ones are right.
        let found = [1e-6, 1e-5, 1e-4].map(|step| {
            let [up, down, far_up, far_down] = [step, -step, 2.0 * step, -2.0 * step].map(|by| moved(column, by));
            let row = |row: usize| (8.0 * (up[row] - down[row]) - (far_up[row] - far_down[row])) / (12.0 * step);
            (0..W).map(row).collect::<Vec<f64>>()
        });
        let greatest = jacobian.0.iter().fold(1.0_f64, |most, row| most.max(row[column].abs()));
        let apart =
            |found: &Vec<f64>| (0..W).fold(0.0_f64, |most, row| most.max((found[row] - jacobian.0[row][column]).abs()));
        let best = found.iter().map(apart).fold(f64::INFINITY, f64::min);
        assert!(best < 1e-6 * greatest, "{column}: {best} of {greatest}");
    }
}

/// Off their equations, both come back to the same motion: by mass a projection does not depend on what velocities are; and what it does
/// to positions is what equations say of displacements. They are `alike` where they are written in the same axes.
pub(crate) fn projections_agree<H, B>(
    random: &mut Random,
    t: f64,
    (held, all): (&H, &H::State),
    (beside, more): (&B, &B::State),
    alike: bool,
) where
    H: Constrained<Scalar = f64> + Impulsive<Rates = <H as Constrained>::Residual>,
    B: Constrained<Scalar = f64> + Impulsive<Rates = <B as Constrained>::Residual>,
{
    // In other axes the gaps of an open loop have other slopes, so Newton's steps are the same to first order alone.
    let reach = if alike { 1e-3 } else { 1e-6 };
    let d: DisplacementOf<H> = random.vector::<DisplacementOf<H>>().scale(reach);
    let dv: VelocityOf<H> = random.vector::<VelocityOf<H>>().scale(1e-2);
    let (q, v, x) = all.split();
    let off = all.join(q.displace(&d), v.add(&dv), x);
    let rates = flat(&held.position_rates(t, &off));
    let (q, v, x) = more.split();
    let along: DisplacementOf<B> = filled(&flat(&d));
    let same = with_rates(beside, t, &more.join(q.displace(&along), v, x), &rates);
    let close = |what: &str, a: &[f64], b: &[f64], tolerance: f64| {
        let size = b.iter().fold(1.0_f64, |most, x| most.max(x.abs()));
        let all = a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (a - b).abs() < tolerance * size);
        assert!(all, "{what}: {a:?} {b:?}");
    };
    if alike {
        let gaps = [flat(&held.constraints(t, &off.split().0)), flat(&beside.constraints(t, &same.split().0))];
        close("gaps", &gaps[1], &gaps[0], 1e-13);
        let rates = [flat(&held.constraint_rate(t, &off)), flat(&beside.constraint_rate(t, &same))];
        close("rates of gaps", &rates[1], &rates[0], 1e-11);
        let moved = [flat(&held.constraints_along(t, &off, &d)), flat(&beside.constraints_along(t, &same, &along))];
        close("gaps along a displacement", &moved[1], &moved[0], 1e-11);
    } else {
        let (q, along) = (same.split().0, along.scale(1e-3 / reach));
        let [up, down] = [1e-2, -1e-2].map(|by| flat(&beside.constraints(t, &q.displace(&along.scale(by)))));
        let found: Vec<f64> = up.iter().zip(&down).map(|(up, down)| (up - down) / 2e-2).collect();
        close("gaps along a displacement", &flat(&beside.constraints_along(t, &same, &along)), &found, 1e-9);
    }
    // Positions first: what stays of velocities while positions are corrected is not the same.
    let positions = Projection { velocity: false, ..Projection::default() };
    let ends = (
        positions.project_by_mass(held, t, &off).unwrap().state,
        positions.project_by_mass(beside, t, &same).unwrap().state,
    );
    assert!(flat(&beside.constraints(t, &ends.1.split().0)).iter().all(|gap| gap.abs() < 1e-12));
    close("positions", &flat(&ends.1.split().0.magnitude()), &flat(&ends.0.split().0.magnitude()), 1e-12);
    let same_again = with_rates(beside, t, &ends.1, &flat(&held.position_rates(t, &ends.0)));
    let ends = (
        Projection::default().project_by_mass(held, t, &ends.0).unwrap().state,
        Projection::default().project_by_mass(beside, t, &same_again).unwrap().state,
    );
    close("rates", &flat(&beside.position_rates(t, &ends.1)), &flat(&held.position_rates(t, &ends.0)), 1e-10);
    // By weights of one it is another motion, on the same equations.
    let plain = Projection::default().project(beside, t, &same).unwrap().state;
    assert!(flat(&beside.constraints(t, &plain.split().0)).iter().all(|gap| gap.abs() < 1e-12));
    assert!(flat(&beside.constraint_rate(t, &plain)).iter().all(|gap| gap.abs() < 1e-11));
}

/// Runs that end alike.
pub(crate) fn same_ends(ends: &[Vec<f64>]) {
    for other in &ends[1..] {
        let apart = other.iter().zip(&ends[0]).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(apart < 1e-10, "{other:?} {:?}", ends[0]);
    }
}

pub(crate) fn agree(found: &[Vector3<f64>], wanted: &[Vector3<f64>]) {
    let size = wanted.iter().fold(1.0_f64, |most, x| most.max(x.amax()));
    for (one, other) in found.iter().zip(wanted) {
        assert!((one - other).amax() < 1e-10 * size, "{one} {other}");
    }
}

#[test]
fn a_board() {
    let (held, reduced, chosen) =
        (board_held::Model::<f64>::default(), board::Model::<f64>::default(), board_chosen::Model::<f64>::default());
    // Five coordinates are left by the coupling, three velocities by the blades.
    assert_eq!((board_held::DOF, board::DOF, board_chosen::DOF), (5, 3, 3));
    let mut random = Random(1);
    for _ in 0..20 {
        let t = random.next();
        let mut state = board::State::<f64>::default();
        state.q = state.q.displace(&random.vector::<board::Rates>().scale(3.0));
        state.v = random.vector();
        let input = board::Input { twist: random.next(), steer: random.next() };
        let rates = reduced.position_rates(t, &state);
        let mut all = board_held::State::<f64>::default();
        (all.q.plane, all.q.swing, all.q.fore) = (state.q.plane, state.q.swing, state.q.fore);
        (all.v.plane, all.v.swing, all.v.fore) = (rates.plane, rates.swing, rates.fore);
        assert!(held.constraint_rate(t, &all).amax() < 1e-12);
        let same_input = board_held::Input { twist: input.twist, steer: input.steer };
        let (out, same) = (reduced.outputs(t, &state, &input), held.outputs(t, &all, &same_input));
        agree(&[&out.moved[..], &out.forces[..]].concat(), &[&same.moved[..], &same.forces[..]].concat());
        assert!((out.energy - same.energy).abs() < 1e-12 * (1.0 + out.energy.abs()));
        let mut other = board_chosen::State::<f64>::default();
        (other.q.plane, other.q.swing, other.q.fore) = (state.q.plane, state.q.swing, state.q.fore);
        let other = with_rates(&chosen, t, &other, &flat(&rates));
        let other_input = board_chosen::Input { twist: input.twist, steer: input.steer };
        let again = chosen.outputs(t, &other, &other_input);
        agree(&[&out.moved[..], &out.forces[..]].concat(), &[&again.moved[..], &again.forces[..]].concat());
        // What the names say.
        let heading = rates.plane;
        assert!((other.v.turned - rates.swing - heading.angle).abs() < 1e-12);
        assert!((other.v.foot - 2.0 * rates.fore + 0.3 * rates.swing).abs() < 1e-12);
        // Jacobians belong to the speeds.
        let v: multibody::nalgebra::Vector3<f64> = other.v.into();
        assert!((again.rider * v).fixed_rows::<3>(0).relative_eq(&again.at, 1e-12, 1e-12));
        derivatives_are_slopes(&reduced, t, &state, &input);
        derivatives_are_slopes(&chosen, t, &other, &other_input);
        let beside = board_beside::Model::<f64>::default();
        let mut more = board_beside::State::<f64>::default();
        (more.q.plane, more.q.swing, more.q.fore) = (state.q.plane, state.q.swing, state.q.fore);
        let more = with_rates(&beside, t, &more, &flat(&rates));
        let more_input = board_beside::Input { twist: input.twist, steer: input.steer };
        let again = beside.outputs(t, &more, &more_input);
        agree(&[&again.moved[..], &again.forces[..]].concat(), &[&same.moved[..], &same.forces[..]].concat());
        derivatives_are_slopes(&beside, t, &more, &more_input);
        projections_agree(&mut random, t, (&held, &all), (&beside, &more), true);
    }
}

#[test]
fn a_ball_on_a_turning_plate() {
    let (held, reduced, chosen) =
        (ball_held::Model::<f64>::default(), ball::Model::<f64>::default(), ball_chosen::Model::<f64>::default());
    assert_eq!((ball_held::DOF, ball::DOF, ball_chosen::DOF), (5, 3, 3));
    let mut random = Random(2);
    for _ in 0..20 {
        let mut state = ball::State::<f64>::default();
        (state.q.x, state.q.y, state.q.turn) = (random.next(), random.next(), random.turn());
        state.v = random.vector();
        let rates = reduced.position_rates(0.0, &state);
        let mut all = ball_held::State::<f64>::default();
        (all.q.x, all.q.y, all.q.turn) = (state.q.x, state.q.y, state.q.turn);
        (all.v.x, all.v.y, all.v.turn) = (rates.x, rates.y, rates.turn);
        assert!(held.constraint_rate(0.0, &all).amax() < 1e-13);
        let (out, same) = (reduced.outputs(0.0, &state, &()), held.outputs(0.0, &all, &()));
        agree(&out.moved, &same.moved);
        assert!(out.forces.iter().zip(&same.forces).all(|(a, b)| (a - b).abs() < 1e-11 * (1.0 + b.abs())));
        let mut other = ball_chosen::State::<f64>::default();
        (other.q.x, other.q.y, other.q.turn) = (state.q.x, state.q.y, state.q.turn);
        let other = with_rates(&chosen, 0.0, &other, &flat(&rates));
        agree(&out.moved, &chosen.outputs(0.0, &other, &()).moved);
        let turning: Vector3<f64> = other.v.into();
        assert!((turning - out.twist.angular).amax() < 1e-12);
        derivatives_are_slopes(&reduced, 0.0, &state, &());
        derivatives_are_slopes(&chosen, 0.0, &other, &());
        let beside = ball_beside::Model::<f64>::default();
        let mut more = ball_beside::State::<f64>::default();
        (more.q.x, more.q.y, more.q.turn) = (state.q.x, state.q.y, state.q.turn);
        let more = with_rates(&beside, 0.0, &more, &flat(&rates));
        assert!(more.v.sliding_along.abs() < 1e-12 && more.v.sliding_across.abs() < 1e-12);
        let again = beside.outputs(0.0, &more, &());
        agree(&again.moved, &same.moved);
        assert!(again.forces.iter().zip(&same.forces).all(|(a, b)| (a - b).abs() < 1e-11 * (1.0 + b.abs())));
        derivatives_are_slopes(&beside, 0.0, &more, &());
        projections_agree(&mut random, 0.0, (&held, &all), (&beside, &more), true);
    }
}

#[test]
fn a_wheel_on_a_slope() {
    let (held, reduced, chosen) =
        (wheel_held::Model::<f64>::default(), wheel::Model::<f64>::default(), wheel_chosen::Model::<f64>::default());
    assert_eq!((wheel_held::DOF, wheel::DOF, wheel_chosen::DOF), (6, 3, 3));
    let mut random = Random(3);
    for _ in 0..20 {
        let mut state = wheel::State::<f64>::default();
        (state.q.x, state.q.y, state.q.turn) = (random.next(), random.next(), random.turn());
        state.v = random.vector();
        let state = reduced.accepted(0.0, &state, &());
        let rates = reduced.position_rates(0.0, &state);
        let mut all = wheel_held::State::<f64>::default();
        (all.q.x, all.q.y, all.q.z, all.q.turn) =
            (state.q.x, state.q.y, reduced.outputs(0.0, &state, &()).height, state.q.turn);
        (all.v.x, all.v.y, all.v.turn) = (rates.x, rates.y, rates.turn);
        all.v.z = reduced.outputs(0.0, &state, &()).rising;
        assert!(held.constraints(0.0, &all.q).amax() < 1e-13 && held.constraint_rate(0.0, &all).amax() < 1e-12);
        let (out, same) = (reduced.outputs(0.0, &state, &()), held.outputs(0.0, &all, &()));
        agree(&[&out.moved[..], &out.forces[..]].concat(), &[&same.moved[..], &same.forces[..]].concat());
        let mut other = wheel_chosen::State::<f64>::default();
        (other.q.x, other.q.y, other.q.turn) = (state.q.x, state.q.y, state.q.turn);
        let other = with_rates(&chosen, 0.0, &chosen.accepted(0.0, &other, &()), &flat(&rates));
        agree(&out.moved, &chosen.outputs(0.0, &other, &()).moved);
        derivatives_are_slopes(&reduced, 0.0, &state, &());
        derivatives_are_slopes(&chosen, 0.0, &other, &());
        let beside = wheel_beside::Model::<f64>::default();
        let mut more = wheel_beside::State::<f64>::default();
        (more.q.x, more.q.y, more.q.z, more.q.turn) = (all.q.x, all.q.y, all.q.z, all.q.turn);
        let more = with_rates(&beside, 0.0, &more, &flat(&all.v));
        let again = beside.outputs(0.0, &more, &());
        agree(&[&again.moved[..], &again.forces[..]].concat(), &[&same.moved[..], &same.forces[..]].concat());
        derivatives_are_slopes(&beside, 0.0, &more, &());
        projections_agree(&mut random, 0.0, (&held, &all), (&beside, &more), true);
    }
}

#[test]
fn a_trailer_that_is_moved_to_and_fro() {
    let (held, reduced, chosen) = (
        trailer_held::Model::<f64>::default(),
        trailer::Model::<f64>::default(),
        trailer_chosen::Model::<f64>::default(),
    );
    assert_eq!((trailer_held::DOF, trailer::DOF, trailer_chosen::DOF), (4, 2, 2));
    let mut random = Random(4);
    for _ in 0..20 {
        let t = 3.0 * random.next();
        let mut state = trailer::State::<f64>::default();
        state.q = state.q.displace(&random.vector::<trailer::Rates>().scale(3.0));
        state.v = random.vector();
        let rates = reduced.position_rates(t, &state);
        let mut all = trailer_held::State::<f64>::default();
        (all.q.plane, all.q.hinge, all.v.plane, all.v.hinge) = (state.q.plane, state.q.hinge, rates.plane, rates.hinge);
        assert!(held.constraint_rate(t, &all).amax() < 1e-12);
        let (out, same) = (reduced.outputs(t, &state, &()), held.outputs(t, &all, &()));
        agree(&[&out.moved[..], &out.forces[..]].concat(), &[&same.moved[..], &same.forces[..]].concat());
        let mut other = trailer_chosen::State::<f64>::default();
        (other.q.plane, other.q.hinge) = (state.q.plane, state.q.hinge);
        let other = with_rates(&chosen, t, &other, &flat(&rates));
        let again = chosen.outputs(t, &other, &());
        agree(&[&out.moved[..], &out.forces[..]].concat(), &[&again.moved[..], &again.forces[..]].concat());
        derivatives_are_slopes(&reduced, t, &state, &());
        derivatives_are_slopes(&chosen, t, &other, &());
        let beside = trailer_beside::Model::<f64>::default();
        let mut more = trailer_beside::State::<f64>::default();
        (more.q.plane, more.q.hinge) = (state.q.plane, state.q.hinge);
        let more = with_rates(&beside, t, &more, &flat(&rates));
        assert!((more.v.yaw - rates.plane.angle + 0.3 * t).abs() < 1e-12);
        let again = beside.outputs(t, &more, &());
        agree(&[&again.moved[..], &again.forces[..]].concat(), &[&same.moved[..], &same.forces[..]].concat());
        derivatives_are_slopes(&beside, t, &more, &());
        projections_agree(&mut random, t, (&held, &all), (&beside, &more), true);
    }
}

/// What a path of one model comes to: where a point is, and the energy.
struct Run<'a, S: System<Scalar = f64>> {
    system: &'a S,
    start: S::State,
    input: S::Input,
}

impl<S: Differentiable<Scalar = f64>> Run<'_, S> {
    /// By an explicit method, an implicit one for stiff systems, and one by collocation.
    fn ends(&self, until: f64) -> [S::State; 3] {
        let Self { system, start, input } = self;
        let end = |found: Result<(S::State, _), _>| found.unwrap().0;
        [
            end(Integrator::adaptive(Dop853, 1e-13, 1e-13).integrate(*system, 0.0, until, start, input, |_, _| ())),
            end(Integrator::adaptive(Radau, 1e-12, 1e-12).integrate(*system, 0.0, until, start, input, |_, _| ())),
            end(Integrator::fixed(GaussLegendre6, 2e-3).integrate(*system, 0.0, until, start, input, |_, _| ())),
        ]
    }
}

/// With multipliers and a projection, reduced, and in speeds, by three methods: the same path.
#[test]
fn paths() {
    let (held, reduced, chosen) =
        (board_held::Model::<f64>::default(), board::Model::<f64>::default(), board_chosen::Model::<f64>::default());
    let mut state = board::State::<f64>::default();
    (state.q.plane.angle, state.q.fore, state.q.swing) = (0.7, 0.4, 0.2);
    state.v = filled(&[0.5, -0.4, 0.3]);
    let rates = reduced.position_rates(0.0, &state);
    let mut all = board_held::State::<f64>::default();
    (all.q.plane, all.q.swing, all.q.fore) = (state.q.plane, state.q.swing, state.q.fore);
    (all.v.plane, all.v.swing, all.v.fore) = (rates.plane, rates.swing, rates.fore);
    let mut other = board_chosen::State::<f64>::default();
    (other.q.plane, other.q.swing, other.q.fore) = (state.q.plane, state.q.swing, state.q.fore);
    let other = with_rates(&chosen, 0.0, &other, &flat(&rates));
    let projected = WithProjection::new(held, Projection::default());
    let input = board_held::Input { twist: 0.3, steer: -0.05 };
    let wanted =
        Integrator::adaptive(Dop853, 1e-13, 1e-13).integrate(&projected, 0.0, 0.8, &all, &input, |_, _| ()).unwrap().0;
    let place = |x: f64, y: f64, angle: f64, swing: f64, fore: f64| [x, y, angle, swing, fore];
    let wanted = place(wanted.q.plane.x, wanted.q.plane.y, wanted.q.plane.angle, wanted.q.swing, wanted.q.fore);
    let close = |found: [f64; 5]| {
        let apart = found.iter().zip(&wanted).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(apart < 1e-10, "{found:?} {wanted:?}");
    };
    let input = board::Input { twist: 0.3, steer: -0.05 };
    for end in (Run { system: &reduced, start: state, input }).ends(0.8) {
        close(place(end.q.plane.x, end.q.plane.y, end.q.plane.angle, end.q.swing, end.q.fore));
    }
    let beside = board_beside::Model::<f64>::default();
    let mut more = board_beside::State::<f64>::default();
    (more.q.plane, more.q.swing, more.q.fore) = (state.q.plane, state.q.swing, state.q.fore);
    let more = with_rates(&beside, 0.0, &more, &flat(&rates));
    let input = board_beside::Input { twist: 0.3, steer: -0.05 };
    for projected in
        [WithProjection::new(beside, Projection::default()), WithProjection::fixed(beside, Projection::default())]
    {
        let end = Integrator::adaptive(Dop853, 1e-13, 1e-13)
            .integrate(&projected, 0.0, 0.8, &more, &input, |_, _| ())
            .unwrap()
            .0;
        close(place(end.q.plane.x, end.q.plane.y, end.q.plane.angle, end.q.swing, end.q.fore));
    }
    for end in (Run { system: &WithProjection::by_mass(beside, Projection::default()), start: more, input }).ends(0.8) {
        close(place(end.q.plane.x, end.q.plane.y, end.q.plane.angle, end.q.swing, end.q.fore));
    }
    let input = board_chosen::Input { twist: 0.3, steer: -0.05 };
    for end in (Run { system: &chosen, start: other, input }).ends(0.8) {
        close(place(end.q.plane.x, end.q.plane.y, end.q.plane.angle, end.q.swing, end.q.fore));
    }
}

/// A ball on a plate that turns, in its three angular velocities: four at once, and with the digits of single precision.
#[test]
fn the_ball_in_lanes_and_in_single_precision() {
    use multibody::Rk4;
    use multibody::simba::simd::{SimdValue, WideF64x4};
    let model = ball_chosen::Model::<f64>::default();
    let mut start = ball_chosen::State::<f64>::default();
    (start.q.x, start.q.y) = (0.4, -0.2);
    start.v = filled(&[0.3, -0.7, 1.1]);
    let end = Rk4::integrate(&model, 0.0, &start, &(), 1e-3, 300, |_, _| ()).unwrap();
    let wide = ball_chosen::Model::<WideF64x4>::default();
    let mut lanes = ball_chosen::State::<WideF64x4>::default();
    (lanes.q.x, lanes.q.y) = (WideF64x4::splat(0.4), WideF64x4::splat(-0.2));
    (lanes.v.about_x, lanes.v.about_y, lanes.v.about_z) =
        (WideF64x4::splat(0.3), WideF64x4::splat(-0.7), WideF64x4::splat(1.1));
    let found =
        Rk4::integrate(&wide, WideF64x4::splat(0.0), &lanes, &(), WideF64x4::splat(1e-3), 300, |_, _| ()).unwrap();
    for lane in 0..4 {
        assert!((found.q.x.extract(lane) - end.q.x).abs() < 1e-12, "{lane} {}", end.q.x);
    }
    let single = ball_chosen::Model::<f32>::default();
    let mut start = ball_chosen::State::<f32>::default();
    (start.q.x, start.q.y) = (0.4, -0.2);
    (start.v.about_x, start.v.about_y, start.v.about_z) = (0.3, -0.7, 1.1);
    let found = Rk4::integrate(&single, 0.0, &start, &(), 1e-3, 300, |_, _| ()).unwrap();
    assert!((f64::from(found.q.x) - end.q.x).abs() < 1e-4, "{} {}", found.q.x, end.q.x);
}

/// Where the rates that are left out do not follow, they are no numbers, and a motion that comes there ends.
#[test]
fn where_rates_do_not_follow() {
    use multibody::{IntegrationError, Rk4};
    let model = sled::Model::<f64>::default();
    let mut state = sled::State::<f64>::default();
    (state.v.plane_y, state.v.plane_angle) = (0.0, 1.0);
    assert!(model.position_rates(0.0, &state).plane.x.is_nan());
    assert!(model.forward_dynamics(0.0, &state, &()).v.plane_y.is_nan());
    state.q.plane.angle = -0.2;
    (state.v.plane_y, state.v.plane_angle) = (-0.16, 1.0);
    let ends = [
        Rk4::integrate(&model, 0.0, &state, &(), 0.01, 400, |_, _| ()).map(|_| ()),
        Integrator::adaptive(Dop853, 1e-9, 1e-9).integrate(&model, 0.0, 4.0, &state, &(), |_, _| ()).map(|_| ()),
    ];
    for end in ends {
        assert!(matches!(end, Err(IntegrationError::DeadCentre { .. })), "{end:?}");
    }
    // In the speed along the blade there is no such pose.
    let model = along::Model::<f64>::default();
    let mut state = along::State::<f64>::default();
    state.q.plane.angle = std::f64::consts::FRAC_PI_2;
    (state.v.ahead, state.v.plane_angle) = (0.8, 1.0);
    assert!((model.position_rates(0.0, &state).plane.y - 0.8).abs() < 1e-15);
    let end = Integrator::adaptive(Dop853, 1e-12, 1e-12).integrate(&model, 0.0, 4.0, &state, &(), |_, _| ()).unwrap().0;
    let [before, after] = [&state, &end].map(|state| model.kinetic_energy(state));
    assert!((after / before - 1.0).abs() < 1e-11);
    let (out, rates) = (model.outputs(0.0, &end, &()), model.position_rates(0.0, &end));
    assert!((out.slope - end.q.plane.angle).abs() < 1e-13 && (out.crossed - rates.plane.y).abs() < 1e-13);
}

/// Without velocities is at rest only what stands then.
#[test]
fn what_moves_without_velocities() {
    use multibody::{EquilibriumError, equilibrium};
    let model = belt::Model::<f64>::default();
    let free = belt::Rates { slide: 1.0 };
    let found = equilibrium(&model, 0.0, &belt::State::default(), &(), &free).map(|_| ());
    assert_eq!(found, Err(EquilibriumError::Moving { rate: 1.0 }));
    // It stands for an instant, moves, and stands.
    let model = shaken::Model::<f64>::default();
    let rest =
        |t: f64| equilibrium(&model, t, &shaken::State::default(), &(), &shaken::Rates { slide: 1.0 }).map(|_| ());
    assert!(
        matches!(rest(0.0), Err(EquilibriumError::Leaving { acceleration }) if (acceleration - 2.0).abs() < 1e-3),
        "{:?}",
        rest(0.0)
    );
    assert!(matches!(rest(0.02), Err(EquilibriumError::Moving { .. })), "{:?}", rest(0.02));
    assert_eq!(rest(3.0), Ok(()));
}
