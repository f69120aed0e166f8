//! Loads that loops share in a way that rigid bodies don't determine: what depends on them is refused, and all else is the same in every
//! formulation, whatever the axes.

use multibody_engine::contracts::function::FunctionKind;
use multibody_engine::contracts::symbol::Symbol;
use multibody_engine::model::types::JointId;

use super::support::*;

/// Normal of a plane and two directions in it.
type Plane = [[f64; 3]; 3];

const ALONG_WORLD: Plane = [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
const ALONG_Y: Plane = [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]];
const ABOUT_X: Plane = [[0.0, 0.6, 0.8], [1.0, 0.0, 0.0], [0.0, 0.8, -0.6]];
const ASKEW: Plane = [[0.48, 0.6, 0.64], [0.8, 0.0, -0.6], [-0.36, 0.8, -0.48]];

/// What 16 digits make of a turn about no axis in particular.
fn typed() -> Plane {
    transpose(&turn([0.3, -0.7, 0.5], 1.1))
}

const FORMULATIONS: [&str; 3] = [
    "constraints: Reduced, independent: [crank]",
    "constraints: Multipliers",
    "coordinates: Absolute(Quaternion), constraints: Multipliers",
];

/// A four-bar in a plane, with loads that stand off it by `off`.
fn bars(plane: &Plane, formulation: &str, off: f64, items: &str) -> String {
    let v = |x: f64, y: f64, n: f64| -> [f64; 3] {
        std::array::from_fn(|k| x * plane[1][k] + y * plane[2][k] + n * plane[0][k])
    };
    let normal = plane[0];
    let cut = if formulation.contains("Absolute") { "" } else { "#[cut]" };
    format!(
        "world {{ gravity: {:?} }}
        formulation {{ {formulation} }}
        body arm {{ mass: 1.0, com: {:?}, inertia: diag(0.3, 0.3, 0.3) }}
        body link {{ mass: 3.5, com: {:?}, inertia: diag(3.0, 3.0, 3.0) }}
        body lever {{ mass: 3.0, com: {:?}, inertia: diag(3.0, 3.0, 3.0) }}
        joint crank: Revolute {{ parent: ground, child: arm, axis: {normal:?} }}
        joint coupler: Revolute {{ parent: arm.at({:?}), child: link, axis: {normal:?} }}
        joint rocker: Revolute {{ parent: ground.at({:?}), child: lever, axis: {normal:?} }}
        {cut}
        joint pin: Revolute {{ parent: link.at({:?}), child: lever.at({:?}), axis: {normal:?} }}
        {items}
        output places = [arm.position, link.position, lever.position];
        output arm_turn = arm.rotation; output link_turn = link.rotation; output lever_turn = lever.rotation;
        output gap = link.at({:?}).position - lever.at({:?}).position;
        output velocities = [arm.velocity, link.velocity, lever.velocity];
        output spins = [arm.express(arm.angular_velocity), link.express(link.angular_velocity), lever.express(lever.angular_velocity)];
        emit forward_dynamics;",
        v(3.0, -9.0, 40.0 * off),
        v(0.5, 0.1, off),
        v(1.7, 0.2, -0.5 * off),
        v(1.5, -0.1, 0.0),
        v(1.0, 0.0, 0.0),
        v(4.0, 0.0, 0.0),
        v(3.5, 0.0, 0.0),
        v(3.0, 0.0, 0.0),
        v(3.5, 0.0, 0.0),
        v(3.0, 0.0, 0.0),
    )
}

const ALL: &str =
    "output loads = [pin.reaction.force, coupler.reaction.force, crank.reaction.force, rocker.reaction.force];
    output moments = [pin.reaction.moment, coupler.reaction.moment, crank.reaction.moment];";

fn in_plane(plane: &Plane) -> String {
    let [n, x, y] = plane;
    let parts = |joint: &str| {
        let [force, moment] = ["force", "moment"].map(|part| format!("{joint}.reaction.{part}"));
        format!("dot({force}, {x:?}), dot({force}, {y:?}), dot({moment}, {n:?})")
    };
    format!("output parts = [{}];", ["pin", "coupler", "crank", "rocker"].map(parts).join(", "))
}

/// A closed pose of the reduced four-bar with a velocity.
fn posed(case: &Case, crank: f64, rate: f64) -> Point {
    let mut point = case.rest();
    let joint = case.joint("crank");
    point.set(Symbol::Position { joint, component: 0 }, crank);
    point.set(Symbol::Velocity { joint, component: 0 }, rate);
    let mut guess = vec![0.4, 1.9];
    for _ in 0..40 {
        for (index, &value) in guess.iter().enumerate() {
            point.set(Symbol::Guess { index }, value);
        }
        guess = case.eval(FunctionKind::Guess, &point);
        guess.pop();
    }
    close("closed", &case.output("gap", &point), &[0.0; 3], 1e-12);
    point
}

/// The same pose in another formulation.
fn taken(case: &Case, of: &Case, point: &Point) -> Point {
    let mut other = case.rest();
    let get = |name: &str| of.output(name, point);
    let (places, velocities, spins) = (get("places"), get("velocities"), get("spins"));
    let bodies = ["arm", "link", "lever"];
    for (k, joint) in case.model.joints.iter().enumerate() {
        let joint_id = JointId(k);
        if case.model.cuts.contains(&joint_id) {
            continue;
        }
        if joint.kind.freedoms() == 6 {
            let body = bodies.iter().position(|name| joint.place.field.to_string().contains(name)).unwrap_or(k);
            let turns = get(&format!("{}_turn", bodies[body]));
            let r: Matrix = std::array::from_fn(|i| std::array::from_fn(|j| turns[3 * i + j]));
            let q = quaternion(&r);
            for c in 0..3 {
                let at = |list: &[f64]| list[3 * body + c];
                other.set(Symbol::Position { joint: joint_id, component: c }, at(&places));
                other.set(Symbol::Velocity { joint: joint_id, component: c }, at(&velocities));
                other.set(Symbol::Velocity { joint: joint_id, component: 3 + c }, at(&spins));
            }
            for (c, &x) in q.iter().enumerate() {
                other.set(Symbol::Position { joint: joint_id, component: 3 + c }, x);
            }
        } else {
            let name = joint.place.field.to_string();
            let value = get(&format!("{name}_state"));
            other.set(Symbol::Position { joint: joint_id, component: 0 }, value[0]);
            other.set(Symbol::Velocity { joint: joint_id, component: 0 }, value[1]);
        }
    }
    other
}

/// Of a rotation that is not near a half turn.
fn quaternion(r: &Matrix) -> [f64; 4] {
    let w = 0.5 * (1.0 + r[0][0] + r[1][1] + r[2][2]).sqrt();
    [w, (r[2][1] - r[1][2]) / (4.0 * w), (r[0][2] - r[2][0]) / (4.0 * w), (r[1][0] - r[0][1]) / (4.0 * w)]
}

const STATES: &str =
    "output crank_state = [crank.angle, crank.rate]; output coupler_state = [coupler.angle, coupler.rate];
    output rocker_state = [rocker.angle, rocker.rate];";

/// Vectors of world axes in those of the plane: along the normal last.
fn seen(plane: &Plane, list: &[f64]) -> Vec<f64> {
    let of = |v: &[f64]| [1, 2, 0].map(|axis| (0..3).map(|k| plane[axis][k] * v[k]).sum::<f64>());
    list.chunks(3).flat_map(of).collect()
}

#[test]
fn hinges_of_a_plane_in_any_axes() {
    let poses = [(0.3, 0.7), (-1.1, 2.0), (0.9, -1.5)];
    let mut want: Option<Vec<[Vec<f64>; 2]>> = None;
    for plane in [ALONG_WORLD, ALONG_Y, ABOUT_X, ASKEW, typed()] {
        let reduced = case(&bars(&plane, FORMULATIONS[0], 0.0, &format!("{ALL}{STATES}")));
        let points: Vec<Point> = poses.iter().map(|&(angle, rate)| posed(&reduced, angle, rate)).collect();
        for formulation in FORMULATIONS {
            let other = case(&bars(&plane, formulation, 0.0, ALL));
            let mut found = Vec::new();
            for point in &points {
                let at = taken(&other, &reduced, point);
                let at = if formulation == FORMULATIONS[0] { point } else { &at };

                found.push(["loads", "moments"].map(|name| seen(&plane, &other.output(name, at))));
            }
            let want = want.get_or_insert_with(|| found.clone());
            for (found, want) in found.iter().zip(&*want) {
                close(&format!("loads: {formulation}, {plane:?}"), &found[0], &want[0], 1e-9);
                close(&format!("moments: {formulation}, {plane:?}"), &found[1], &want[1], 1e-9);
                // Nothing leaves the plane.
                let off = found[0].chunks(3).map(|v| v[2]).chain(found[1].chunks(3).flat_map(|v| [v[0], v[1]]));
                assert!(off.into_iter().all(|x| x.abs() < 1e-9), "{found:?}");
            }
        }
    }
}

#[test]
fn loads_across_a_plane_leave_what_is_in_it() {
    let mut want: Option<Vec<f64>> = None;
    for plane in [ALONG_WORLD, ALONG_Y, ABOUT_X, ASKEW, typed()] {
        let reduced = case(&bars(&plane, FORMULATIONS[0], 0.1, &format!("{}{STATES}", in_plane(&plane))));
        let point = posed(&reduced, 0.3, 0.7);
        for formulation in FORMULATIONS {
            let other = case(&bars(&plane, formulation, 0.1, &in_plane(&plane)));
            let at = taken(&other, &reduced, &point);
            let at = if formulation == FORMULATIONS[0] { &point } else { &at };
            let found = other.output("parts", at);
            let want = want.get_or_insert_with(|| found.clone());
            close(&format!("{formulation}, {plane:?}"), &found, want, 1e-9);
        }
    }
}

/// Whatever reads what nobody knows.
#[test]
fn what_is_not_determined_is_refused() {
    let [n, ..] = ASKEW;
    let across = format!("dot(coupler.reaction.force, {n:?})");
    let reads = [
        "pin.reaction".to_owned(),
        "coupler.reaction.force".to_owned(),
        "norm(crank.reaction.moment)".to_owned(),
        across.clone(),
        format!("max({across}, 0.0)"),
        "rocker.reaction.express(arm).force".to_owned(),
        "crank.reaction.force + rocker.reaction.moment".to_owned(),
    ];
    for plane in [ALONG_WORLD, ASKEW, typed()] {
        for formulation in FORMULATIONS {
            for read in &reads {
                let text = bars(&plane, formulation, 0.1, &format!("output read = {read};"));
                let refused = try_case(&text).err().unwrap_or_else(|| panic!("{formulation}: {read} in {plane:?}"));
                assert!(refused.contains("how loops share their load"), "{refused}");
            }
        }
    }
}

const BODIES: &str = "param off = 0.0; param gravity: Vec3 = [0.0, -9.81, 0.0]; input push: Vec3;
    body a { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
    body b { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
    body c { mass: 1.0, com: [0.5, 0.1, OFF], inertia: rod(1.0, 1.0, X) }";

/// Numbers that are zero by default are not zero for ever.
#[test]
fn loads_that_may_come() {
    let text = |gravity: &str, off: &str, push: &str| {
        format!(
            "{} world {{ gravity: {gravity} }}
            joint one: Revolute {{ parent: ground, child: a, axis: Z }}
            joint two: Revolute {{ parent: a.at(X), child: b, axis: Z }}
            joint three: Revolute {{ parent: ground.at(1.6 * X), child: c, axis: Z }}
            #[cut] joint four: Revolute {{ parent: b.at(X), child: c.at(X), axis: Z }}
            force pushed: Force {{ at: b, value: {push}, axes: ground }}
            output load = two.reaction; emit forward_dynamics;",
            BODIES.replace("OFF", off)
        )
    };
    assert!(try_case(&text("-9.81 * Y", "0.0", "push.x * X")).is_ok());
    for (gravity, off, push) in
        [("gravity", "0.0", "push.x * X"), ("-9.81 * Y", "off", "push.x * X"), ("-9.81 * Y", "0.0", "push")]
    {
        let refused = try_case(&text(gravity, off, push)).err().expect("refused");
        assert!(refused.contains("how loops share their load"), "{refused}");
    }
}

/// Four bars in a plane with what acts on them, `b` with a product of inertia `xz`, and what is read.
fn pushed(gravity: &str, xz: &str, items: &str) -> String {
    format!(
        "world {{ gravity: {gravity} }}
        body a {{ mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }}
        body b {{ mass: 1.0, com: [0.5, 0.1, 0.0], inertia: inertia(0.2, 0.3, 0.4, 0.0, {xz}, 0.0) }}
        body c {{ mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }}
        joint one: Revolute {{ parent: ground, child: a, axis: Z }}
        joint two: Revolute {{ parent: a.at(X), child: b, axis: Z }}
        joint three: Revolute {{ parent: ground.at(1.6 * X), child: c, axis: Z }}
        #[cut] joint four: Revolute {{ parent: b.at(X), child: c.at(X), axis: Z }}
        {items} emit forward_dynamics;"
    )
}

/// Loads that begin at a time, beyond a stop or by a drive count too, wherever the mechanism stands when it is looked at.
#[test]
fn loads_that_begin() {
    let push = |amount: &str| format!("force push: Force {{ at: b, value: {amount}, axes: ground }}");
    let read = "output load = two.reaction;";
    for (declared, amount) in [
        ("", "sin(t) * Z"),
        ("", "max(t - 20.0, 0.0) * Z"),
        ("", "select(t > 20.0, 1.0, 0.0) * Z"),
        ("input u;", "max(u - 5.0, 0.0) * Z"),
        ("param u = 0.0;", "max(u - 5.0, 0.0) * Z"),
        ("state s: rate = 1.0 - s, start: 0.0;", "max(s - 10.0, 0.0) * Z"),
        ("", "max(one.angle - 30.0, 0.0) * Z"),
        ("", "min(30.0 - one.rate, 0.0) * Z"),
        ("", "(abs(one.rate - 30.0) + one.rate - 30.0) * Z"),
    ] {
        let text = pushed("-9.81 * Y", "0.0", &format!("{declared} {} {read}", push(amount)));
        let refused = try_case(&text).err().unwrap_or_else(|| panic!("{amount}"));
        assert!(refused.contains("how loops share their load"), "{refused}");
        let text = pushed("-9.81 * Y", "0.0", &format!("{declared} {} {read}", push(&amount.replace('Z', "Y"))));
        assert!(try_case(&text).is_ok(), "{amount}");
    }
    for course in ["0.3 + t", "0.3 + t * t * t"] {
        let items = format!("drive one.angle = {course}; {read}");
        let refused = try_case(&pushed("-9.81 * Y", "0.05", &items)).err().unwrap_or_else(|| panic!("{course}"));
        assert!(refused.contains("how loops share their load"), "{refused}");
        assert!(try_case(&pushed("-9.81 * Y", "0.0", &items)).is_ok(), "{course}");
    }
}

/// Steps that are smooth are as good as zero on one side of them.
#[test]
fn loads_that_begin_smoothly() {
    let push = |amount: &str| format!("force push: Force {{ at: b, value: {amount}, axes: ground }}");
    let read = "output load = two.reaction;";
    for (declared, amount) in [
        ("", "(1.0 + tanh((t - 15.0) / 0.1)) * Z"),
        ("input u;", "1.0 / (1.0 + exp(-40.0 * (u - 1.0))) * Z"),
        ("", "exp(t - 40.0) * Z"),
        ("", "exp(one.rate - 90.0) * Z"),
    ] {
        let text = pushed("-9.81 * Y", "0.0", &format!("{declared} {} {read}", push(amount)));
        let refused = try_case(&text).err().unwrap_or_else(|| panic!("{amount}"));
        assert!(refused.contains("how loops share their load"), "{refused}");
        let text = pushed("-9.81 * Y", "0.0", &format!("{declared} {} {read}", push(&amount.replace('Z', "Y"))));
        assert!(try_case(&text).is_ok(), "{amount}");
    }
    for (course, axis) in [("0.05 * (1.0 + tanh((t - 15.0) / 0.3))", "Z"), ("0.1 * exp(t - 40.0)", "Z")] {
        let lifted = |axis: &str, course: &str| {
            let items = format!(
                "body base {{ mass: 2.0, inertia: diag(0.5, 0.6, 0.7) }}
                joint lift: Prismatic {{ parent: ground, child: base, axis: {axis} }} drive lift = {course}; {read}"
            );
            pushed("-9.81 * Y", "0.0", &items)
                .replace("parent: ground, child: a", "parent: base, child: a")
                .replace("parent: ground.at(1.6 * X)", "parent: base.at(1.6 * X)")
        };
        assert!(try_case(&lifted(axis, course)).is_err(), "{course}");
        assert!(try_case(&lifted("Y", course)).is_ok(), "{course}");
        assert!(try_case(&lifted(axis, "0.3 * t")).is_ok());
        let held = lifted(axis, course).replace("#[cut]", "");
        let held = format!("formulation {{ coordinates: Absolute(Quaternion), constraints: Multipliers }} {held}");
        assert!(try_case(&held).is_err(), "{course}");
    }
}

/// What is small beside gravity where inputs and parameters are about one may be all that counts elsewhere; and what is small is
/// small beside what it is made of, in its own unit.
#[test]
fn loads_of_any_size() {
    let push = |amount: &str| format!("input u; force push: Force {{ at: b, value: {amount}, axes: ground }}");
    let read = "output load = two.reaction;";
    for amount in ["u * 1e-6", "u * 1e-9", "powi(u, 20)", "1e-6 * b.position.y"] {
        for (direction, is_fine) in [("Z", false), ("Y", true)] {
            let text = pushed("-981.0 * Y", "0.0", &format!("{} {read}", push(&format!("{amount} * {direction}"))));
            assert_eq!(try_case(&text).is_ok(), is_fine, "{amount} * {direction}");
        }
    }
    // In an oblique plane too, where rounding is as large as some loads.
    let [n, x, _] = typed();
    for (direction, is_fine) in [(n, false), (x, true)] {
        let items = format!("{} {}", push(&format!("u * 1e-7 * {direction:?}")).replace("at: b", "at: link"), ALL);
        let text = bars(&typed(), FORMULATIONS[1], 0.0, &items);
        assert_eq!(try_case(&text).is_ok(), is_fine, "{direction:?}");
    }
    // What grows with velocities faster than all else.
    for (direction, is_fine) in [(n, false), (x, true)] {
        let push = format!(
            "force push: Force {{ at: link, value: 1e-14 * powi(crank.rate, 6) * {direction:?}, axes: ground }}"
        );
        let text = bars(&typed(), FORMULATIONS[1], 0.0, &format!("{push} {ALL}"));
        assert_eq!(try_case(&text).is_ok(), is_fine, "{direction:?}");
    }
    // What grows so fast that it has no numbers where an input is made large, and is nothing with the other sign; and what is next to nothing on one side
    // alone.
    for amount in ["exp(u / 0.026) - 1.0", "exp(-u / 0.026)", "exp(u)", "exp(-u / 26.0)", "sinh(u)"] {
        for (direction, is_fine) in [(n, false), (x, true)] {
            let items =
                format!("{} {ALL}", push(&format!("1e-14 * ({amount}) * {direction:?}")).replace("at: b", "at: link"));
            let text = bars(&typed(), FORMULATIONS[1], 0.0, &items);
            assert_eq!(try_case(&text).is_ok(), is_fine, "{amount} {direction:?}");
        }
    }
    for amount in ["sqrt(u * u + 1.0) - u", "sqrt(u * u + 1.0) + u"] {
        for (direction, is_fine) in [("Z", false), ("Y", true)] {
            let text =
                pushed("-9.81 * Y", "0.0", &format!("{} {read}", push(&format!("1e-11 * ({amount}) * {direction}"))));
            assert_eq!(try_case(&text).is_ok(), is_fine, "{amount} {direction}");
        }
    }
    let rotor = |axis: &str| {
        let items = format!(
            "body rotor {{ mass: 0.0, inertia: diag(1e-7, 1e-7, 1e-7) }}
            joint spin: Revolute {{ parent: b, child: rotor, axis: {axis} }} {read}"
        );
        try_case(&pushed("-9.81 * Y", "0.0", &items)).is_ok()
    };
    assert!(!rotor("X"));
    assert!(rotor("Z"));
    let cargo = |at: &str| {
        let items = format!(
            "param cargo = 0.0; body crate_of {{ mass: cargo }} joint held: Fixed {{ parent: b.at({at}), child: crate_of }} {read}"
        );
        try_case(&pushed("-9.81 * Y", "0.0", &items).replace("mass: 1.0", "mass: 1.0e6")).is_ok()
    };
    assert!(!cargo("0.5 * Z"));
    assert!(cargo("0.5 * Y"));
    // Links of ten micrometres, with a centre of mass 50 nm off the plane.
    let micro = |off: &str| {
        let text = format!(
            "world {{ gravity: -9.81 * Y }}
            body a {{ mass: 1e-9, com: 5e-6 * X, inertia: rod(1e-9, 1e-5, X) }}
            body b {{ mass: 1e-9, com: [5e-6, 1e-6, {off}], inertia: diag(2e-20, 3e-20, 4e-20) }}
            body c {{ mass: 1e-9, com: 5e-6 * X, inertia: rod(1e-9, 1e-5, X) }}
            joint one: Revolute {{ parent: ground, child: a, axis: Z }}
            joint two: Revolute {{ parent: a.at(1e-5 * X), child: b, axis: Z }}
            joint three: Revolute {{ parent: ground.at(1.6e-5 * X), child: c, axis: Z }}
            #[cut] joint four: Revolute {{ parent: b.at(1e-5 * X), child: c.at(1e-5 * X), axis: Z }}
            {read} emit forward_dynamics;"
        );
        try_case(&text).is_ok()
    };
    assert!(!micro("5e-8"));
    assert!(micro("0.0"));
}

/// What a load is beside others is not what it is beside terms that cancel, as those of a stiff spring do.
#[test]
fn stiff_springs_hide_no_load() {
    let read = "output load = two.reaction;";
    let spring = "force s: SpringDamper { between: [a.at(0.99 * X), b.at(0.01 * Y)], stiffness: 1e4, damping: 10.0, length: 0.01 }";
    let text = |across: &str| pushed(across, "0.0", &format!("{spring} {read}"));
    assert!(try_case(&text("[0.0, -9.81, 3.0]")).is_err());
    assert!(try_case(&text("-9.81 * Y")).is_ok());
    let [n, x, y] = typed();
    let spring = format!(
        "force s: SpringDamper {{ between: [link.at({:?}), ground.at({:?})], stiffness: 2e8, damping: 0.0, length: 0.2 }}",
        [0, 1, 2].map(|k| 0.3 * x[k] + 0.4 * y[k]),
        [0, 1, 2].map(|k| x[k] + 2.0 * y[k])
    );
    for (direction, is_fine) in [(n, false), (x, true)] {
        let push = format!(
            "force push: Force {{ at: link, value: {direction:?}, axes: ground }} output load = coupler.reaction;"
        );
        let text = bars(&typed(), FORMULATIONS[1], 0.0, &format!("{spring} {push}"));
        assert_eq!(try_case(&text).is_ok(), is_fine, "{direction:?}");
    }
}

/// Of functions of what is zero in the plane, those that are not zero themselves load it; and roots, which have no value everywhere, hide nothing.
#[test]
fn values_at_zero_and_roots() {
    let push = |amount: &str| {
        format!("input u; force push: Force {{ at: b, value: {amount}, axes: ground }} output load = two.reaction;")
    };
    let absolute = |amount: &str| {
        let text = pushed("-9.81 * Y", "0.0", &push(amount)).replace("#[cut]", "");
        try_case(&format!("formulation {{ coordinates: Absolute(Quaternion), constraints: Multipliers }} {text}"))
            .is_ok()
    };
    assert!(!absolute("exp(-powi(b.position.z, 2)) * Z"));
    assert!(absolute("(exp(b.position.z) - 1.0) * Z"));
    assert!(absolute("powf(max(b.position.z, 0.0), 1.5) * Z"));
    let joints = |amount: &str| try_case(&pushed("-9.81 * Y", "0.0", &push(amount))).is_ok();
    for amount in [
        "sqrt(1.0 - powi(tanh(one.rate / 1e-3), 2)) * Y + max(one.angle - 30.0, 0.0)",
        "sqrt(max(0.1 * (t - 200.0), 0.0)) * Y + max(t - 20.0, 0.0) * max(30.0 - t, 0.0)",
        "sqrt(u) * Y + u * 1e-9",
    ] {
        assert!(!joints(&format!("{amount} * Z")), "{amount}");
        assert!(joints(&format!("{amount} * X")), "{amount}");
    }
}

/// A parallelogram that is declared flat, where its motions cross, hangs together by none while it rests.
#[test]
fn the_declared_pose_is_looked_at_in_motion() {
    let text = |read: &str| {
        format!(
            "world {{ gravity: -9.81 * Y }}
            body a {{ mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }}
            body b {{ mass: 1.0, com: X, inertia: rod(1.0, 2.0, X) }}
            body c {{ mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }}
            joint one: Revolute {{ parent: ground, child: a, axis: Z }}
            joint two: Revolute {{ parent: a.at(X), child: b, axis: Z }}
            joint three: Revolute {{ parent: ground.at(2.0 * X), child: c, axis: Z }}
            #[cut] joint four: Revolute {{ parent: b.at(2.0 * X), child: c.at(X), axis: Z }}
            formulation {{ constraints: Multipliers }}
            output read = {read}; emit forward_dynamics;"
        )
    };
    let refused = try_case(&text("two.reaction.force")).err().expect("refused");
    assert!(refused.contains("where coordinates are declared to stand"), "{refused}");
    assert!(try_case(&text("one.reaction.force + three.reaction.force")).is_ok());
}

/// A plate that swings on parallel rods: three hold it, whichever, as long as it is level, and any four where it is not.
#[test]
fn the_declared_pose_is_looked_at() {
    let text = |read: &str, ends: [[f64; 2]; 4]| {
        let rods: String = [[0.5, 0.5], [-0.5, 0.5], [-0.5, -0.5], [0.5, -0.5]]
            .iter()
            .zip(ends)
            .enumerate()
            .map(|(k, ([x, y], [u, v]))| {
                let length = ((x - u) * (x - u) + (y - v) * (y - v) + 1.0).sqrt();
                format!(
                    "constraint r{k}: Rod {{ between: [ground.at([{u:?}, {v:?}, 0.0]), plate.at([{x:?}, {y:?}, 0.0])], length: {length:?} }}\n"
                )
            })
            .collect();
        format!(
            "world {{ gravity: -9.81 * Z }} formulation {{ constraints: Multipliers }}
            body plate {{ mass: 2.0, com: [0.1, 0.05, 0.02], inertia: diag(0.2, 0.3, 0.4) }}
            joint float: Free {{ parent: ground.at(-Z), child: plate, coordinates: RollPitchYaw }}
            {rods} output read = {read}; emit forward_dynamics;"
        )
    };
    let parallel = [[0.5, 0.5], [-0.5, 0.5], [-0.5, -0.5], [0.5, -0.5]];
    for read in ["r0.multiplier", "r0.multiplier - r1.multiplier"] {
        let refused = try_case(&text(read, parallel)).err().expect("refused");
        assert!(refused.contains("where coordinates are declared to stand"), "{refused}");
    }
    let friction =
        "force air: Force { at: plate, value: -0.2 * plate.velocity / norm(plate.velocity), axes: ground } output read";
    let text_with_friction = text("r0.multiplier", parallel).replace("output read", friction);
    assert!(try_case(&text_with_friction).is_err());
    // What all four bear together is known.
    let sum = "r0.multiplier + r1.multiplier + r2.multiplier + r3.multiplier";
    assert!(try_case(&text(sum, parallel)).is_ok());
    let spread = [[0.9, 0.7], [-0.8, 0.6], [-0.7, -0.9], [0.6, -0.75]];
    assert!(try_case(&text("r0.multiplier", spread)).is_ok());
}

/// Of two drives that say the same nobody knows which one works.
#[test]
fn drives_that_say_the_same() {
    let text = |drives: &str| {
        on_parallel_bars(drives, "ja.effort")
            .replace("#[cut]", "")
            .replace("world", "formulation { coordinates: Absolute(Quaternion), constraints: Multipliers } world")
    };
    let refused = try_case(&text("drive ja.angle = 0.3 + t; drive jb.angle = 0.3 + t;")).err().expect("refused");
    assert!(refused.contains("prescribes what follows from the loops and other drives: `jb`"), "{refused}");
    assert!(try_case(&text("drive ja.angle = 0.3 + t;")).is_ok());
}

/// What an output makes of loads hides none, and nor does what is heavy beside the loop.
#[test]
fn whatever_is_made_of_loads() {
    let across = "[0.0, -9.0, 1.0]";
    for read in [
        "four.reaction.force.z * four.reaction.moment.x",
        "max(norm(two.reaction.force) - 1e5, 0.0)",
        "two.reaction.force.z / 1e13",
        "select(two.reaction.force.z > 1e6, 1.0, 0.0)",
        "1e13 + two.reaction.force.z",
        "tanh(1e6 * two.reaction.force.z)",
    ] {
        let text = pushed(across, "0.0", &format!("output read = {read};"));
        assert!(try_case(&text).err().is_some_and(|said| said.contains("share their load")), "{read}");
    }
    let big = "body big { mass: 1.0e9, com: X, inertia: rod(1.0e9, 2.0, X) }
        joint p: Revolute { parent: ground, child: big, axis: Z } output read = two.reaction;";
    assert!(try_case(&pushed(across, "0.0", big)).is_err());
    assert!(try_case(&pushed("-9.0 * Y", "0.0", big)).is_ok());
}

/// A parameter that has a say in the loop as well as in a load.
#[test]
fn parameters_of_loops_that_load_them() {
    let text = pushed("-9.81 * Y", "0.0", "param reach = 1.6; output load = two.reaction;")
        .replace("ground.at(1.6 * X)", "ground.at(reach * X)");
    assert!(try_case(&text).is_ok());
    let loaded = text.replace("com: [0.5, 0.1, 0.0]", "com: 0.5 * X + (reach - 1.6) * Z");
    assert!(try_case(&loaded).is_err());
}

/// Two wheels on an axle share what is aside of them, whichever way they head: along a world axis at the start.
#[test]
fn wheels_on_an_axle() {
    let text = |read: &str| {
        let wheel = |k: usize, y: &str| {
            format!(
                "body w{k} {{ mass: 0.5, inertia: diag(0.01, 0.02, 0.01) }}
                joint j{k}: Revolute {{ parent: base.at([0.5, {y}, 0.0]), child: w{k}, axis: Y }}
                constraint r{k}: Rolling {{ wheel: w{k}, axis: Y, radius: 0.3 }}"
            )
        };
        format!(
            "world {{ gravity: -9.81 * Z }}
            body base {{ mass: 5.0, inertia: diag(1.0, 1.0, 1.0) }}
            joint float: Planar {{ parent: ground.at(0.3 * Z), child: base, axes: [X, Y] }}
            {} {} output read = {read}; emit forward_dynamics;",
            wheel(0, "0.4"),
            wheel(1, "-0.4")
        )
    };
    for read in ["j0.reaction.force.x", "j0.reaction.express(base).force.y"] {
        assert!(try_case(&text(read)).is_err(), "{read}");
    }
    assert!(try_case(&text("j0.reaction.express(base).force.x")).is_ok());
}

/// A coupler on two parallel bars of one length, and what else holds it.
fn on_parallel_bars(items: &str, read: &str) -> String {
    format!(
        "world {{ gravity: -9.81 * Y }}
        body a {{ mass: 1.0, com: 0.5 * Y, inertia: rod(1.0, 1.0, Y) }}
        body b {{ mass: 1.0, com: 0.5 * Y, inertia: rod(1.0, 1.0, Y) }}
        body top {{ mass: 2.0, com: 0.7 * X, inertia: rod(2.0, 2.0, X) }}
        joint ja: Revolute {{ parent: ground, child: a, axis: Z }}
        joint jb: Revolute {{ parent: ground.at(X), child: b, axis: Z }}
        joint ta: Revolute {{ parent: a.at(Y), child: top, axis: Z }}
        #[cut] joint tb: Revolute {{ parent: top.at(X), child: b.at(Y), axis: Z }}
        {items} output read = {read}; emit forward_dynamics;"
    )
}

/// With a third bar, or a rod, the coupler moves, and hangs on one more than it needs; its other branch has nothing redundant.
#[test]
fn a_bar_too_many() {
    let bar = "body c { mass: 1.0, com: 0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint jc: Revolute { parent: ground.at(2.0 * X), child: c, axis: Z }
        #[cut] joint tc: Revolute { parent: top.at(2.0 * X), child: c.at(Y), axis: Z }";
    let rod = "constraint rod: Rod { between: [ground.at(2.0 * X), top.at(2.0 * X)], length: 1.0 }";
    for (third, read) in [
        (bar, "tb.reaction.force"),
        (bar, "ja.reaction.force"),
        (bar, "jc.reaction.force.y"),
        (rod, "rod.multiplier"),
        (rod, "ja.reaction.force"),
    ] {
        let refused = try_case(&on_parallel_bars(third, read)).err().unwrap_or_else(|| panic!("{read}"));
        assert!(refused.contains("how loops share their load"), "{refused}");
    }
    let all = "ja.reaction.force + jb.reaction.force + jc.reaction.force";
    for (third, read) in [(bar, all), (bar, "ja.accel"), (rod, "ja.rate")] {
        assert!(try_case(&on_parallel_bars(third, read)).is_ok(), "{read}");
    }
}

/// A ball and a cylindrical joint among four hinges' places hold no more than they have to.
#[test]
fn a_loop_that_holds_no_more_than_it_has_to() {
    let text = format!(
        "{} world {{ gravity: gravity }}
        joint one: Revolute {{ parent: ground, child: a, axis: Z }}
        joint two: Ball {{ parent: a.at(X), child: b }}
        joint three: Revolute {{ parent: ground.at(1.6 * X), child: c, axis: Z }}
        #[cut] joint four: Cylindrical {{ parent: b.at(X), child: c.at(X), axis: Z }}
        force pushed: Force {{ at: b, value: push, axes: ground }}
        output loads = [one.reaction.force, two.reaction.force, three.reaction.moment, four.reaction.moment];
        emit forward_dynamics;",
        BODIES.replace("OFF", "off")
    );
    assert!(try_case(&text).is_ok());
}

/// Four hinges through one point, under gravity: forces that meet there move nothing.
#[test]
fn hinges_through_one_point() {
    let text = |read: &str| {
        format!(
            "world {{ gravity: [1.0, 2.0, -9.0] }}
            body a {{ mass: 1.0, com: [0.5, 0.1, 0.3], inertia: diag(0.2, 0.3, 0.4) }}
            body b {{ mass: 1.0, com: [0.1, 0.4, 0.3], inertia: diag(0.2, 0.3, 0.4) }}
            body c {{ mass: 1.0, com: [0.2, -0.3, 0.5], inertia: diag(0.2, 0.3, 0.4) }}
            joint one: Revolute {{ parent: ground, child: a, axis: Z }}
            joint two: Revolute {{ parent: a, child: b, axis: [0.0, 0.6, 0.8] }}
            joint three: Revolute {{ parent: ground, child: c, axis: [0.6, 0.0, 0.8] }}
            #[cut] joint four: Revolute {{ parent: b, child: c, axis: [0.48, 0.6, 0.64] }}
            output read = {read}; emit forward_dynamics;"
        )
    };
    let refused = try_case(&text("two.reaction.force")).err().expect("refused");
    assert!(refused.contains("how loops share their load"), "{refused}");
    assert!(try_case(&text("one.reaction.force + three.reaction.force")).is_ok());
    assert!(try_case(&text("one.accel")).is_ok());
}
