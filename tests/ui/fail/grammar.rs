//! What parses as Rust and means nothing here.
use multibody::multibody;

multibody! {
    mod model {
        param a = 2.0
        param b = 3.0f32;
        body block { mass: b^2 }
        joint rail: Prismatic { parent: ground, child: block, axis: X }
        force f: Effort { joint: rail, value: if a > 1.0 { 1.0 } else { 0.0 } }
        output half = rail.travel as f64;
    }
}

fn main() {
    let _ = model::Params { a: 1.0, b: 2.0 };
}
