//! A part that calls a function of its own crate.

multibody::multibody! {
    pub mod brake {
        extern friction(rate) = crate::brakes::Pad;
        port hinge: Joint;
        force drag: Effort { joint: hinge, value: friction(hinge.rate) }
    }
}
