//! `cfg` on a whole model, private models, visibility, documentation.
#![forbid(unsafe_code)]
#![deny(warnings, missing_docs)]

use multibody::multibody;

multibody! {
    /// Never there.
    #[cfg(any())]
    pub mod absent {
        body block { mass: 2.0 }
        joint rail: Prismatic { parent: ground, child: block, axis: X }
    }
    /// Always there, for this crate.
    #[cfg(all())]
    pub(crate) mod present {
        /// [kg] of the block
        param mass = 2.0;
        /// [N] pushes
        input push;
        /// a block
        body block { mass: mass }
        /// rail along x
        joint rail: Prismatic { parent: ground, child: block, axis: X }
        /// motor
        force motor: Effort { joint: rail, value: push }
        /// [m]
        output place = block.position;
    }
    mod private {
        body block { mass: 2.0 }
        joint rail: Prismatic { parent: ground, child: block, axis: X }
    }
}

/// The name is free.
pub mod absent {
    /// Something else.
    pub const THERE: bool = false;
}

fn main() {
    let params = present::Params::<f32> { mass: 4.0 };
    assert!(params.check().is_ok() && !absent::THERE);
    let model = present::Model::new(&params);
    let accel = model.forward_dynamics(0.0, &present::State::default(), &present::Input { push: 2.0 });
    assert_eq!(accel.rail, 0.5);
    assert_eq!(private::DOF, 1);
}
