//! Compliant contacts in oblique frames, apart, at the touch and deep in: forces against the law in plain arithmetic, derivatives against
//! dual numbers of forward dynamics; and all of it is finite where contact begins, and where balls are as good as concentric.

use multibody::nalgebra::{Quaternion, UnitQuaternion, Vector3};
use multibody::{Real, multibody};

multibody! {
    /// A ball on a plate, both free.
    pub mod marble {
        param radius = 0.2;
        param damping = 0.4;
        param exponent = 1.5;
        param friction = 0.6;
        param slip_speed = 0.05;
        body one { mass: 1.3, com: [0.01, 0.02, -0.01], inertia: inertia(0.02, 0.025, 0.03, 0.001, -0.002, 0.001) }
        body two { mass: 2.1, com: [0.1, -0.05, 0.02], inertia: inertia(0.13, 0.14, 0.15, 0.01, 0.02, -0.03) }
        joint free_one: Free { parent: ground, child: one }
        joint free_two: Free { parent: ground, child: two }
        let at = one.at([0.01, -0.02, 0.03]);
        let on = two.at([0.1, 0.2, 0.05]).rotated([1.0, 2.0, 3.0], 0.4);
        force touch: Contact {
            at: at, radius: radius, on: on,
            stiffness: 2e3, damping: damping, exponent: exponent, friction: friction, slip_speed: slip_speed
        }
        output force = touch.force;
        output gap = touch.gap;
        output slip = touch.slip;
        emit forward_dynamics, derivatives;
    }
    /// A thin disc on a plate, both free.
    pub mod coin {
        param radius = 0.25;
        param damping = 0.4;
        param exponent = 1.5;
        param friction = 0.6;
        param slip_speed = 0.05;
        body one { mass: 1.3, com: [0.01, 0.02, -0.01], inertia: inertia(0.02, 0.025, 0.03, 0.001, -0.002, 0.001) }
        body two { mass: 2.1, com: [0.1, -0.05, 0.02], inertia: inertia(0.13, 0.14, 0.15, 0.01, 0.02, -0.03) }
        joint free_one: Free { parent: ground, child: one }
        joint free_two: Free { parent: ground, child: two }
        let at = one.rotated(X, 0.3).at([0.01, -0.02, 0.03]);
        let on = two.at([0.1, 0.2, 0.05]).rotated([1.0, 2.0, 3.0], 0.4);
        force touch: Contact {
            at: at, axis: [0.3, 2.0, -0.4], radius: radius, on: on,
            stiffness: 2e3, damping: damping, exponent: exponent, friction: friction, slip_speed: slip_speed
        }
        output force = touch.force;
        output gap = touch.gap;
        output slip = touch.slip;
        emit forward_dynamics, derivatives;
    }
    /// Two balls, both free.
    pub mod balls {
        param radius = 0.2;
        param ball_radius = 0.15;
        param damping = 0.4;
        param exponent = 1.5;
        param friction = 0.6;
        param slip_speed = 0.05;
        body one { mass: 1.3, com: [0.01, 0.02, -0.01], inertia: inertia(0.02, 0.025, 0.03, 0.001, -0.002, 0.001) }
        body two { mass: 2.1, com: [0.1, -0.05, 0.02], inertia: inertia(0.13, 0.14, 0.15, 0.01, 0.02, -0.03) }
        joint free_one: Free { parent: ground, child: one }
        joint free_two: Free { parent: ground, child: two }
        force touch: Contact {
            at: one.at([0.01, -0.02, 0.03]), radius: radius, ball: two.at([0.1, 0.2, 0.05]), ball_radius: ball_radius,
            stiffness: 2e3, damping: damping, exponent: exponent, friction: friction, slip_speed: slip_speed
        }
        output force = touch.force;
        output gap = touch.gap;
        output slip = touch.slip;
        emit forward_dynamics, derivatives;
    }
    /// Two balls whose centres are the origins of their bodies, and a disc on the ground.
    pub mod still {
        param exponent = 1.5;
        body one { mass: 1.0, inertia: sphere(1.0, 0.5) }
        body two { mass: 1.0, inertia: sphere(1.0, 0.25) }
        body coin { mass: 1.0, inertia: cylinder(1.0, 0.5, 0.0, Y) }
        joint free_one: Free { parent: ground, child: one }
        joint free_two: Free { parent: ground, child: two }
        joint free_coin: Free { parent: ground, child: coin }
        force clash: Contact {
            at: one, radius: 0.5, ball: two, ball_radius: 0.25, stiffness: 1e3, damping: 0.3, friction: 0.5, exponent: exponent
        }
        force rim: Contact { at: coin, axis: Y, radius: 0.5, stiffness: 1e3, damping: 0.3, friction: 0.5, exponent: exponent }
        output gaps = [clash.gap, rim.gap];
        emit forward_dynamics, derivatives;
    }
}

/// Numbers between -1 and 1 (SplitMix64).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let x = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let x = (x ^ (x >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((x ^ (x >> 31)) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
    fn vector(&mut self) -> Vector3<f64> {
        Vector3::from_fn(|_, _| self.next())
    }
    fn turn(&mut self) -> UnitQuaternion<f64> {
        UnitQuaternion::new_normalize(Quaternion::new(self.next(), self.next(), self.next(), self.next()))
    }
}

/// A free body: origin, attitude, velocity of the origin, turn about its own axes.
#[derive(Clone, Copy, Debug)]
struct Loose {
    position: Vector3<f64>,
    orientation: UnitQuaternion<f64>,
    linear: Vector3<f64>,
    angular: Vector3<f64>,
}

impl Loose {
    fn place(&self, point: Vector3<f64>) -> Vector3<f64> {
        self.position + self.orientation * point
    }
    /// Of the material at a place.
    fn velocity(&self, place: Vector3<f64>) -> Vector3<f64> {
        self.linear + (self.orientation * self.angular).cross(&(place - self.position))
    }
}

/// What a contact is made of, in world axes.
struct Geometry {
    normal: Vector3<f64>,
    contact: Vector3<f64>,
    gap: f64,
}

const AT: [f64; 3] = [0.01, -0.02, 0.03];
const ON: [f64; 3] = [0.1, 0.2, 0.05];

/// The normal and a point of the plate's plane.
fn plane(plate: &Loose) -> (Vector3<f64>, Vector3<f64>) {
    let axis = Vector3::new(1.0, 2.0, 3.0).normalize();
    let frame = UnitQuaternion::from_scaled_axis(axis * 0.4);
    (plate.orientation * (frame * Vector3::z()), plate.place(ON.into()))
}

fn marble_geometry(one: &Loose, two: &Loose) -> Geometry {
    let (normal, on) = plane(two);
    let contact = one.place(AT.into()) - normal * 0.2;
    Geometry { normal, contact, gap: (contact - on).dot(&normal) }
}

fn coin_geometry(one: &Loose, two: &Loose) -> Geometry {
    let (normal, on) = plane(two);
    let turn = UnitQuaternion::from_scaled_axis(Vector3::x() * 0.3);
    let axle = (one.orientation * (turn * Vector3::new(0.3, 2.0, -0.4))).normalize();
    // In the plane of the disc, straight down.
    let down = axle.cross(&axle.cross(&normal)).normalize();
    let contact = one.place(turn * Vector3::from(AT)) + down * 0.25;
    Geometry { normal, contact, gap: (contact - on).dot(&normal) }
}

fn balls_geometry(one: &Loose, two: &Loose) -> Geometry {
    let (centre, other) = (one.place(AT.into()), two.place(ON.into()));
    let way = centre - other;
    let normal = way.normalize();
    Geometry { normal, contact: centre - normal * 0.2, gap: way.norm() - 0.35 }
}

/// The numbers of the law.
#[derive(Clone, Copy, Debug)]
struct Law {
    damping: f64,
    exponent: f64,
    friction: f64,
    slip_speed: f64,
}

const LAWS: [Law; 5] = [
    Law { damping: 0.4, exponent: 1.5, friction: 0.6, slip_speed: 0.05 },
    Law { damping: 0.0, exponent: 1.0, friction: 0.3, slip_speed: 1e-3 },
    Law { damping: 1.1, exponent: 1.0, friction: 0.9, slip_speed: 0.2 },
    Law { damping: 0.2, exponent: 2.0, friction: 0.0, slip_speed: 0.01 },
    Law { damping: 0.7, exponent: 1.2, friction: 0.5, slip_speed: 0.01 },
];

impl Law {
    /// On the first body.
    fn force(&self, geometry: &Geometry, one: &Loose, two: &Loose) -> Vector3<f64> {
        let Geometry { normal, contact, gap } = *geometry;
        if gap >= 0.0 {
            return Vector3::zeros();
        }
        let motion = one.velocity(contact) - two.velocity(contact);
        let load = 2e3 * (-gap).powf(self.exponent) * (1.0 - self.damping * motion.dot(&normal)).max(0.0);
        let slip = motion - normal * motion.dot(&normal);
        normal * load - slip * (self.friction * load / slip.norm().hypot(self.slip_speed))
    }
}

/// How fast bodies move against each other, beside the motion that they share: sticking, slipping, and so fast apart that the law
/// lets go. Nothing at all too.
const RATES: [f64; 4] = [0.0, 1e-4, 0.3, 6.0];
/// Apart, just touching, and up to a third of a radius deep.
const DEPTHS: [f64; 6] = [-0.1, -1e-9, 1e-9, 1e-4, 0.01, 0.06];

/// Two bodies at any place with that depth, in that motion.
fn pair(random: &mut Random, geometry: fn(&Loose, &Loose) -> Geometry, depth: f64, rate: f64) -> [Loose; 2] {
    let mut bodies = [0.0, 0.35].map(|z| Loose {
        position: random.vector() * 0.1 + Vector3::new(0.0, 0.0, -z),
        orientation: random.turn(),
        linear: Vector3::zeros(),
        angular: Vector3::zeros(),
    });
    // Along the normal the gap grows by what it is moved.
    let found = geometry(&bodies[0], &bodies[1]);
    bodies[0].position -= found.normal * (found.gap + depth);
    let (shared, turning) = (random.vector(), random.vector());
    for body in &mut bodies {
        body.linear = shared + turning.cross(&body.position) + random.vector() * rate;
        body.angular = body.orientation.inverse() * turning + random.vector() * rate;
    }
    bodies
}

fn lifted<T: Real>(vector: &Vector3<f64>) -> Vector3<T> {
    Vector3::from_fn(|i, _| T::lit(vector[i]))
}

macro_rules! lift {
    ($module:ident, $scalar:ty, $bodies:expr) => {{
        let mut state = $module::State::<$scalar>::default();
        let [one, two] = $bodies;
        for (q, v, body) in
            [(&mut state.q.free_one, &mut state.v.free_one, one), (&mut state.q.free_two, &mut state.v.free_two, two)]
        {
            q.position = lifted(&body.position);
            let c = body.orientation.coords;
            q.orientation = UnitQuaternion::new_unchecked(Quaternion::new(
                <$scalar>::lit(c.w),
                <$scalar>::lit(c.x),
                <$scalar>::lit(c.y),
                <$scalar>::lit(c.z),
            ));
            v.linear = lifted(&body.linear);
            v.angular = lifted(&body.angular);
        }
        state
    }};
}

macro_rules! with_law {
    ($module:ident, $scalar:ty, $law:expr) => {{
        let Law { damping, exponent, friction, slip_speed } = $law;
        let [damping, exponent, friction, slip_speed] = [damping, exponent, friction, slip_speed].map(<$scalar>::lit);
        $module::Model::<$scalar>::new(&$module::Params {
            damping,
            exponent,
            friction,
            slip_speed,
            ..Default::default()
        })
    }};
}

/// Calls a check with each kind of contact.
macro_rules! each_contact {
    ($check:ident) => {
        $check!(marble, marble_geometry);
        $check!(coin, coin_geometry);
        $check!(balls, balls_geometry);
    };
}

/// In the plain law nothing is the engine's: no frame, no velocity, no formula.
#[test]
fn forces_of_the_law() {
    macro_rules! check {
        ($module:ident, $geometry:ident) => {{
            let mut random = Random(1);
            // Pressed and slipping, pressed and sticking, let go, apart.
            let mut met = [0; 4];
            for law in LAWS {
                let model = with_law!($module, f64, law);
                for (depth, rate) in DEPTHS.into_iter().flat_map(|depth| RATES.map(|rate| (depth, rate))) {
                    let bodies = pair(&mut random, $geometry, depth, rate);
                    let [one, two] = &bodies;
                    let geometry = $geometry(one, two);
                    let wanted = law.force(&geometry, one, two);
                    let out = model.outputs(0.0, &lift!($module, f64, &bodies), &());
                    assert!((out.gap - geometry.gap).abs() < 2e-15, "{} {}", out.gap, geometry.gap);
                    // Depths are small differences of lengths of one.
                    let close = 1e-12 + 3e-15 * law.exponent / geometry.gap.abs();
                    assert!((out.force - wanted).amax() <= close * wanted.amax(), "{law:?} {depth} {rate}: {wanted}");
                    let slipping = out.slip.norm() > law.slip_speed;
                    let case = match (depth > 0.0, wanted == Vector3::zeros()) {
                        (true, false) => usize::from(!slipping),
                        (true, true) => 2,
                        (false, _) => 3,
                    };
                    met[case] += 1;
                }
            }
            println!("{}: slipping, sticking, let go, apart {met:?}", stringify!($module));
            assert!(met.iter().all(|&count| count > 4), "{met:?}");
        }};
    }
    each_contact!(check);
}

/// Of displacements and of velocities, to the last digits.
#[cfg(feature = "num-dual")]
#[test]
fn derivatives_by_dual_numbers() {
    use multibody::{Configuration, StateSpace, System, Tangent};
    use num_dual::Dual64;

    /// With a derivative of one along a component.
    fn seeded<V: Tangent<Dual64>>(v: &V, at: Option<usize>) -> V {
        let mut place = 0;
        v.map(&mut |x| {
            let eps = if at == Some(place) { 1.0 } else { 0.0 };
            place += 1;
            Dual64::new(x.re, x.eps + eps)
        })
    }

    macro_rules! check {
        ($module:ident, $geometry:ident) => {{
            let mut random = Random(2);
            let (mut worst, mut pressed) = (0.0_f64, 0);
            for law in LAWS {
                let (model, dual) = (with_law!($module, f64, law), with_law!($module, Dual64, law));
                for (depth, rate) in DEPTHS.into_iter().flat_map(|depth| RATES.map(|rate| (depth, rate))) {
                    let bodies = pair(&mut random, $geometry, depth, rate);
                    let slopes = model.forward_derivatives(0.0, &lift!($module, f64, &bodies), &());
                    let twin = lift!($module, Dual64, &bodies);
                    let (q, v, x) = twin.split();
                    let column = |state| {
                        let (accel, ()) = dual.derivative(Dual64::from(0.0), &state, &());
                        accel.fold(Vec::new(), &mut |mut list, x: Dual64| {
                            list.push(x.eps);
                            list
                        })
                    };
                    for (kind, found) in [slopes.position, slopes.velocity].iter().enumerate() {
                        let wanted: Vec<Vec<f64>> = (0..12)
                            .map(|at| {
                                let along = |of: usize| (kind == of).then_some(at);
                                let moved = q.displace(&seeded(&Tangent::zero(), along(0)));
                                column(twin.join(moved, seeded(&v, along(1)), x))
                            })
                            .collect();
                        let greatest = wanted.iter().flatten().fold(0.0_f64, |most, x| most.max(x.abs()));
                        let error = (0..144).map(|k| (found[(k % 12, k / 12)] - wanted[k / 12][k % 12]).abs());
                        let error = error.fold(0.0, |most: f64, x| if x <= most { most } else { x });
                        // What the depth is rounded by is its share in the force's slope.
                        let close = 1e-12 + 3e-15 / depth.abs();
                        assert!(
                            error <= close * greatest.max(1.0),
                            "{} {law:?} {depth} {rate}, {kind}: {error:e} of {greatest:e}",
                            stringify!($module)
                        );
                        if depth.abs() > 1e-6 {
                            worst = worst.max(error / greatest.max(1.0));
                        }
                        pressed += usize::from(greatest > 100.0);
                    }
                }
            }
            println!("{}: {worst:.1e}, of {pressed} matrices with large entries", stringify!($module));
            assert!(pressed > 30);
        }};
    }
    each_contact!(check);
}

fn touching(exponent: f64) -> (still::Model, still::State) {
    let model = still::Model::new(&still::Params { exponent });
    let mut state = still::State::default();
    // All of these are exact, and so are distances and gaps.
    state.q.free_two.position = Vector3::new(0.0, 0.75, 0.0);
    state.q.free_coin.position = Vector3::new(3.0, 0.0, 0.5);
    assert_eq!(model.outputs(0.0, &state, &()).gaps, [0.0, 0.0]);
    (model, state)
}

/// At rest at the very touch nothing acts, and slopes are zero but for a force that has a corner there.
#[test]
fn exactly_at_the_touch() {
    for exponent in [1.0, 1.2, 1.5, 2.0, 3.0] {
        let (model, mut state) = touching(exponent);
        for speed in [0.0, 1.0, -1.0] {
            (state.v.free_one.linear.y, state.v.free_coin.linear.z) = (speed, -speed);
            let accel = model.forward_dynamics(0.0, &state, &());
            let accels =
                [accel.free_one.linear, accel.free_two.linear, accel.free_coin.linear, accel.free_coin.angular];
            assert!(accels.iter().all(|accel| *accel == Vector3::zeros()), "{exponent} {speed}: {accels:?}");
            let slopes = model.forward_derivatives(0.0, &state, &());
            assert!(slopes.velocity.iter().all(|x| *x == 0.0), "{exponent} {speed}: {}", slopes.velocity);
            assert!(slopes.position.iter().all(|x| x.is_finite()));
            if exponent > 1.0 {
                assert!(slopes.position.iter().all(|x| *x == 0.0), "{exponent} {speed}: {}", slopes.position);
            }
        }
    }
}

/// Neither forces nor their slopes jump where contact begins: they grow with the depth to its power.
#[test]
fn from_the_touch_on() {
    for exponent in [1.2, 1.5, 2.0] {
        let (model, start) = touching(exponent);
        for depth in [1e-3, 1e-6, 1e-9, 1e-12] {
            for sign in [1.0, -1.0] {
                let mut state = start;
                state.q.free_two.position.y -= sign * depth;
                state.q.free_coin.position.z -= sign * depth;
                let gaps = model.outputs(0.0, &state, &()).gaps;
                let accel = model.forward_dynamics(0.0, &state, &());
                let slopes = model.forward_derivatives(0.0, &state, &());
                let found = [accel.free_two.linear.y, accel.free_coin.linear.z];
                // By the second ball's y, and the coin's z.
                let stiffness = [-slopes.position[(7, 7)], -slopes.position[(14, 14)]];
                for k in 0..2 {
                    let pressed = (-gaps[k]).max(0.0);
                    let (force, slope) = (1e3 * pressed.powf(exponent), 1e3 * exponent * pressed.powf(exponent - 1.0));
                    assert!((found[k] - force).abs() <= 1e-12 * force, "{exponent} {depth} {k}: {} {force}", found[k]);
                    assert!(
                        (stiffness[k] - slope).abs() <= 1e-12 * slope,
                        "{exponent} {depth} {k}: {} {slope}",
                        stiffness[k]
                    );
                }
            }
        }
    }
}

/// Balls whose centres are as good as one: the direction is that of what is left between them.
#[test]
fn nearly_concentric_balls() {
    for exponent in [1.0, 1.5, 2.0] {
        let (model, start) = touching(exponent);
        for distance in [1e-3, 1e-8, 1e-15, 1e-100, 1e-150] {
            let mut state = start;
            state.q.free_two.position = Vector3::new(0.0, 0.6 * distance, 0.8 * distance);
            state.v.free_two.linear = Vector3::new(0.1, 0.2, -0.3);
            let accel = model.forward_dynamics(0.0, &state, &()).free_two.linear;
            // How the normal turns is one over the distance, which all of the slopes have.
            let slopes = model.forward_derivatives(0.0, &state, &());
            assert!(accel.iter().all(|x| x.is_finite()), "{exponent} {distance:e}: {accel}");
            assert!(
                slopes.position.iter().chain(slopes.velocity.iter()).all(|x| x.is_finite()),
                "{exponent} {distance:e}"
            );
            let normal = Vector3::new(0.0, 0.6, 0.8);
            let load = 1e3 * (0.75 - distance).powf(exponent) * (1.0 - 0.3 * -0.12_f64);
            assert!((accel.dot(&normal) / load - 1.0).abs() < 1e-12, "{exponent} {distance:e}: {accel} {load}");
            let turning = slopes.position[(6, 6)] * distance / load;
            assert!(turning > 0.1 && turning < 10.0, "{exponent} {distance:e}: {turning}");
        }
    }
}
