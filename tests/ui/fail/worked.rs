//! Units, equations that are taken apart, and formulas of other models.

use multibody::multibody;

multibody! {
    mod units {
        /// [m]
        param l = 0.4;
        /// [s]
        param delay = 0.1;
        body b { mass: 1.0, com: l * X }
        joint hinge: Revolute { parent: ground, child: b, axis: Z }
        output wrong = l + delay;
    }
}

multibody! {
    mod apart {
        input torque;
        body b { mass: 1.0, com: X }
        joint hinge: Revolute { parent: ground, child: b, axis: Z }
        output wrong = diff(torque * hinge, t);
        force also: Effort { joint: hinge, value: bias[hinge] }
    }
}

multibody! {
    mod asked {
        body b { mass: 1.0, com: X }
        joint hinge: Revolute { parent: ground, child: b, axis: Z }
    }
    mod asks {
        body b { mass: 1.0, com: X }
        joint hinge: Revolute { parent: ground, child: b, axis: Z }
        output follows = asked(hinge.accel, hinge = hinge);
    }
}

fn main() {}
