//! Mistakes in the use of another crate's parts: one error each, at the tokens of this file.
use multibody::multibody;

multibody! {
    use multibody_test_parts::legs::leg;
    pub mod robot {
        body hull { mass: 10.0, inertia: sphere(10.0, 0.2) }
        joint float: Free { parent: ground, child: hull }
        /// [s]
        param reach = 0.5;
        part left: leg { hipp: hull };
        part right: lge { hip: hull };
        part third: foot { ankle: hull };
        part fourth: leg { hip: hull, length: reach };
        output pad = left.end.pod.position;
    }
}

multibody! {
    use multibody_test_parts::legs::copied;
    pub mod asking {
        part one: copied { base: ground };
    }
}

multibody! {
    use multibody_test_parts::legs::*;
    pub use multibody_test_parts::legs::foot;
    pub mod listing {
        use multibody_test_parts::legs::foot;
        body hull { mass: 10.0 }
        joint rail: Prismatic { parent: ground, child: hull, axis: X }
    }
}

multibody! {
    use multibody_test_parts::legs::fot;
    mod nothing {}
}

fn main() {
    let _ = robot::Model::<f64>::default();
    let _ = asking::Model::<f64>::default();
    let _ = listing::Model::<f64>::default();
}
