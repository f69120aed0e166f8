//! Directions of joints that must be perpendicular, and are not.
use multibody::multibody;

multibody! {
    mod tilted {
        body block { mass: 1.0, inertia: sphere(1.0, 0.1) }
        joint pin: PinSlot { parent: ground, child: block, axis: Z, slide: [1, 0, 0.01] }
    }
    mod along {
        body block { mass: 1.0, inertia: sphere(1.0, 0.1) }
        joint pin: PinSlot { parent: ground, child: block, axis: Z, slide: -Z }
    }
    mod skew {
        body block { mass: 1.0, inertia: sphere(1.0, 0.1) }
        joint table: Planar { parent: ground, child: block, axes: [X, X + Z] }
    }
    mod both {
        body block { mass: 1.0, inertia: sphere(1.0, 0.1) }
        joint table: Planar { parent: ground, child: block, axis: Y, axes: [X, Z] }
    }
}

fn main() {}
