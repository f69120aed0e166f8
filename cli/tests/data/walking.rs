//! A model with a part of another file.

multibody! {
    use crate::shelf::leg;
    pub mod walking {
        world { gravity: -9.81 * Z }
        body hull { mass: 10.0, inertia: sphere(10.0, 0.2) }
        joint float: Free { parent: ground, child: hull }
        part legs: [leg; 2] = |i| leg { hip: hull.at((i - 0.5) * Y) };
    }
}
