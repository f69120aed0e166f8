//! Vectors where scalars belong, and the other way round.
use multibody::multibody;

multibody! {
    mod slider {
        body block { mass: [1.0, 2.0, 3.0] }
        joint rail: Prismatic { parent: ground, child: block, axis: 1.0 }
        force push: Effort { joint: rail, value: block.velocity }
        output far: Vec3 = rail.travel;
    }
}

fn main() {}
