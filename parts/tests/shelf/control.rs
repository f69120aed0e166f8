//! Controllers and filters.

use multibody::multibody;

use super::{after, close};

multibody! {
    use multibody_parts::{low_pass, pid, second_order, servo, state_feedback};

    /// A mass that a controller moves, a signal that filters follow.
    pub mod loops {
        input wanted;
        body cart { mass: 1.7 }
        joint x: Prismatic { parent: ground, child: cart, axis: [1, 2, 2] }
        part controller: pid {
            wanted: wanted, measured: x.travel, proportional: 40, integral: 15, derivative: 11, filter: 0.02
        };
        force push: Effort { joint: x, value: controller.command }
        part slow: low_pass { signal: wanted, time: 0.3 };
        part second: second_order { signal: wanted, frequency: 9, damping: 0.25 };
        body other { mass: 2 }
        joint y: Prismatic { parent: ground, child: other, axis: Y }
        part servo: servo { joint: y, wanted: sin(3 * t), wanted_rate: 3 * cos(3 * t), stiffness: 50, damping: 8 };
        force pull: Effort { joint: y, value: servo.command }
    }

    /// Two carts with a spring between them, of which the first is pushed.
    pub mod carts {
        body one { mass: 2 }
        body two { mass: 0.5 }
        joint x: Prismatic { parent: ground, child: one, axis: [2, -1, 2] }
        joint y: Prismatic { parent: ground.at(X), child: two, axis: [2, -1, 2] }
        let stretch = y.travel - x.travel;
        force pull: Effort { joint: x, value: 8 * stretch }
        force back: Effort { joint: y, value: -8 * stretch }
        part feedback: state_feedback {
            first: x, second: y, wanted_first: 0.3, wanted_second: 0.3, feed: 0.0, gains: [30, -7.5], rate_gains: [12, 1.5]
        };
        force push: Effort { joint: x, value: feedback.command }
        output command = feedback.command;
    }
}

/// `x' = (A - B K) x`, by the series of the exponential.
#[test]
fn state_feedback_is_a_row_of_gains() {
    let model = carts::Model::<f64>::default();
    let mut x = carts::State::<f64>::default();
    (x.q.x, x.q.y, x.v.x, x.v.y) = (0.1, -0.2, 0.4, 0.7);
    let command = -30.0 * (0.1 - 0.3) + 7.5 * (-0.2 - 0.3) - 12.0 * 0.4 - 1.5 * 0.7;
    close("command", model.outputs(0.0, &x, &()).command, command, 1e-14);
    let closed = |[x, y, u, v]: [f64; 4]| {
        let command = -30.0 * x + 7.5 * y - 12.0 * u - 1.5 * v;
        [u, v, (8.0 * (y - x) + command) / 2.0, -16.0 * (y - x)]
    };
    let t = 0.8;
    let (mut term, mut sum) = ([0.1 - 0.3, -0.2 - 0.3, 0.4, 0.7], [0.1 - 0.3, -0.2 - 0.3, 0.4, 0.7]);
    for k in 1..80 {
        term = closed(term).map(|rate| rate * t / f64::from(k));
        sum = [0, 1, 2, 3].map(|i| sum[i] + term[i]);
    }
    let end = after(&model, &x, &(), t, 8000);
    let found = [end.q.x - 0.3, end.q.y - 0.3, end.v.x, end.v.y];
    for (found, wanted) in found.into_iter().zip(sum) {
        close("state", found, wanted, 1e-10);
    }
}

/// Equations of the loop written out, by a Runge-Kutta method of small steps.
#[test]
fn a_controller_is_its_equations() {
    let model = loops::Model::<f64>::default();
    let end = after(&model, &loops::State::default(), &loops::Input { wanted: 0.8 }, 1.3, 26_000);
    let rate = |[x, v, sum, filtered]: [f64; 4]| {
        let error = 0.8 - x;
        let command = 40.0 * error + 15.0 * sum + 11.0 * (error - filtered) / 0.02;
        [v, command / 1.7, error, (error - filtered) / 0.02]
    };
    let (mut y, h) = ([0.0; 4], 1.3 / 52_000.0);
    for _ in 0..52_000 {
        let moved = |k: [f64; 4], by: f64| [0, 1, 2, 3].map(|i| y[i] + by * h * k[i]);
        let a = rate(y);
        let b = rate(moved(a, 0.5));
        let c = rate(moved(b, 0.5));
        let d = rate(moved(c, 1.0));
        y = [0, 1, 2, 3].map(|i| y[i] + h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]));
    }
    close("position", end.q.x, y[0], 1e-10);
    close("sum", end.x.controller.sum, y[2], 1e-10);
    close("filtered", end.x.controller.filtered, y[3], 1e-9);
}

#[test]
fn filters_answer_a_step() {
    let model = loops::Model::<f64>::default();
    let t = 0.7_f64;
    let end = after(&model, &loops::State::default(), &loops::Input { wanted: 0.8 }, t, 7000);
    close("first order", end.x.slow.value, 0.8 * (1.0 - (-t / 0.3).exp()), 1e-11);
    let (w, z) = (9.0_f64, 0.25_f64);
    let damped = w * (1.0 - z * z).sqrt();
    let step = 1.0 - (-z * w * t).exp() * ((damped * t).cos() + z * w / damped * (damped * t).sin());
    close("second order", end.x.second.value, 0.8 * step, 1e-10);
}

/// 2 y'' + 8 y' + 50 y = 50 sin 3t + 24 cos 3t, after the transient.
#[test]
fn a_servo_follows_with_its_lag() {
    let model = loops::Model::<f64>::default();
    let t = 20.0_f64;
    let end = after(&model, &loops::State::default(), &loops::Input { wanted: 0.0 }, t, 40_000);
    let (re, im) = (50.0 - 18.0, 24.0);
    let size = re * re + im * im;
    // (50 s + 24 c) over (re + i im), as a sin 3t + b cos 3t.
    let (a, b) = ((50.0 * re + 24.0 * im) / size, (24.0 * re - 50.0 * im) / size);
    close("servo", end.q.y, a * (3.0 * t).sin() + b * (3.0 * t).cos(), 1e-9);
}
