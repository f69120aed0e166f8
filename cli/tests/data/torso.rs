multibody! {
    /// A spine of two hinges with two arms that are computed together.
    pub mod torso {
        formulation { packs: Four }
        const SIDES: [Scalar; 2] = [1.0, -1.0];
        body lumbar { mass: 2.1, com: [0.01, 0.0, 0.03], inertia: diag(0.006, 0.005, 0.004) }
        body chest { mass: 16.1, com: [-0.04, 0.0, 0.17], inertia: diag(0.3, 0.24, 0.18) }
        joint yaw: Revolute { parent: ground, child: lumbar, axis: Z }
        joint pitch: Revolute { parent: lumbar.at(0.07 * Z), child: chest, axis: Y }
        part arms: [arm; 2] = |i| arm { shoulder: chest.at([0.0, 0.16 * SIDES[i], 0.24]), side: SIDES[i] };
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias;
    }
    mod arm {
        port shoulder: Frame;
        param side = 1.0;
        body clavicle { mass: 1.4, com: [-0.01, 0.09 * side, 0.02], inertia: diag(0.012, 0.005, 0.01) }
        body humerus { mass: 1.7, com: [0.02, 0.01 * side, -0.11], inertia: diag(0.023, 0.022, 0.003) }
        body ulna { mass: 1.1, com: [0.01, -0.01 * side, -0.09], inertia: diag(0.008, 0.009, 0.002) }
        joint pitch: Revolute { parent: shoulder, child: clavicle, axis: Y }
        joint roll: Revolute { parent: clavicle.at([0.0, 0.16 * side, 0.0]), child: humerus, axis: X }
        joint elbow: Revolute { parent: humerus.at([0.02, 0.0, -0.27]), child: ulna, axis: Y }
    }
}
