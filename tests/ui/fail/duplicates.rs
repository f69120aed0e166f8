//! Names that stand twice or are taken.
use multibody::multibody;

multibody! {
    mod model {
        param m = 1.0;
        input m;
        param sin = 2.0;
        body block { mass: m }
        body block { mass: 2.0 }
        joint rail: Prismatic { parent: ground, child: block, axis: X, axis: Y }
    }
}

fn main() {}
