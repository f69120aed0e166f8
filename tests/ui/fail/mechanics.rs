//! Mechanisms that cannot be: an idle spin, an inertia that no body has, a massless end, a body in the air.
use multibody::multibody;

multibody! {
    mod spinning {
        body stick { mass: 1.0, com: 0.5 * Z, inertia: rod(1.0, 1.0, Z) }
        joint ball: Ball { parent: ground, child: stick }
    }
    mod impossible {
        body block { mass: 1.0, inertia: diag(1.0, 1.0, 3.0) }
        joint hinge: Revolute { parent: ground, child: block, axis: Z }
    }
    mod massless {
        body end { mass: 0.0 }
        joint rail: Prismatic { parent: ground, child: end, axis: X }
    }
    mod floating {
        body block { mass: 1.0 }
        body other { mass: 1.0 }
        joint rail: Prismatic { parent: ground, child: block, axis: X }
    }
}

fn main() {}
