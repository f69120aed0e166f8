//! Linkages of the reference problems in `data/motion`: N four-bars in a row, and Andrews' squeezer.

use multibody::multibody;

multibody! {
    /// 1 parallelogram in a row, with the solution that the user knows.
    pub mod four_bars_1 {
        world { gravity: -9.81 * Y }
        formulation { constraints: Reduced }
        body upright0 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body upright1 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body bar1 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        joint crank: Revolute { parent: ground, child: upright0, axis: Z }
        joint coupler1: Revolute { parent: upright0.at(X), child: bar1, axis: Z }
        joint follower1: Revolute { parent: ground.at(1.0 * X), child: upright1, axis: Z }
        #[cut]
        joint pin1: Revolute { parent: bar1.at(X), child: upright1.at(X), axis: Z }
        solve (coupler1, follower1) = (-crank.angle, crank.angle);
        output tip = upright0.at(X).position;
        output energy = kinetic() + potential();
        emit forward_dynamics;
    }
    /// 2 parallelograms in a row, with the solution that the user knows.
    pub mod four_bars_2 {
        world { gravity: -9.81 * Y }
        formulation { constraints: Reduced }
        body upright0 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body upright1 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body upright2 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body bar1 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body bar2 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        joint crank: Revolute { parent: ground, child: upright0, axis: Z }
        joint coupler1: Revolute { parent: upright0.at(X), child: bar1, axis: Z }
        joint follower1: Revolute { parent: ground.at(1.0 * X), child: upright1, axis: Z }
        #[cut]
        joint pin1: Revolute { parent: bar1.at(X), child: upright1.at(X), axis: Z }
        joint coupler2: Revolute { parent: upright1.at(X), child: bar2, axis: Z }
        joint follower2: Revolute { parent: ground.at(2.0 * X), child: upright2, axis: Z }
        #[cut]
        joint pin2: Revolute { parent: bar2.at(X), child: upright2.at(X), axis: Z }
        solve (coupler1, follower1) = (-crank.angle, crank.angle);
        solve (coupler2, follower2) = (-crank.angle, crank.angle);
        output tip = upright0.at(X).position;
        output energy = kinetic() + potential();
        emit forward_dynamics;
    }
    /// 10 parallelograms in a row, with the solution that the user knows.
    pub mod four_bars_10 {
        world { gravity: -9.81 * Y }
        formulation { constraints: Reduced }
        body upright0 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body upright1 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body upright2 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body upright3 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body upright4 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body upright5 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body upright6 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body upright7 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body upright8 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body upright9 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body upright10 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body bar1 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body bar2 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body bar3 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body bar4 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body bar5 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body bar6 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body bar7 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body bar8 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body bar9 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body bar10 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        joint crank: Revolute { parent: ground, child: upright0, axis: Z }
        joint coupler1: Revolute { parent: upright0.at(X), child: bar1, axis: Z }
        joint follower1: Revolute { parent: ground.at(1.0 * X), child: upright1, axis: Z }
        #[cut]
        joint pin1: Revolute { parent: bar1.at(X), child: upright1.at(X), axis: Z }
        joint coupler2: Revolute { parent: upright1.at(X), child: bar2, axis: Z }
        joint follower2: Revolute { parent: ground.at(2.0 * X), child: upright2, axis: Z }
        #[cut]
        joint pin2: Revolute { parent: bar2.at(X), child: upright2.at(X), axis: Z }
        joint coupler3: Revolute { parent: upright2.at(X), child: bar3, axis: Z }
        joint follower3: Revolute { parent: ground.at(3.0 * X), child: upright3, axis: Z }
        #[cut]
        joint pin3: Revolute { parent: bar3.at(X), child: upright3.at(X), axis: Z }
        joint coupler4: Revolute { parent: upright3.at(X), child: bar4, axis: Z }
        joint follower4: Revolute { parent: ground.at(4.0 * X), child: upright4, axis: Z }
        #[cut]
        joint pin4: Revolute { parent: bar4.at(X), child: upright4.at(X), axis: Z }
        joint coupler5: Revolute { parent: upright4.at(X), child: bar5, axis: Z }
        joint follower5: Revolute { parent: ground.at(5.0 * X), child: upright5, axis: Z }
        #[cut]
        joint pin5: Revolute { parent: bar5.at(X), child: upright5.at(X), axis: Z }
        joint coupler6: Revolute { parent: upright5.at(X), child: bar6, axis: Z }
        joint follower6: Revolute { parent: ground.at(6.0 * X), child: upright6, axis: Z }
        #[cut]
        joint pin6: Revolute { parent: bar6.at(X), child: upright6.at(X), axis: Z }
        joint coupler7: Revolute { parent: upright6.at(X), child: bar7, axis: Z }
        joint follower7: Revolute { parent: ground.at(7.0 * X), child: upright7, axis: Z }
        #[cut]
        joint pin7: Revolute { parent: bar7.at(X), child: upright7.at(X), axis: Z }
        joint coupler8: Revolute { parent: upright7.at(X), child: bar8, axis: Z }
        joint follower8: Revolute { parent: ground.at(8.0 * X), child: upright8, axis: Z }
        #[cut]
        joint pin8: Revolute { parent: bar8.at(X), child: upright8.at(X), axis: Z }
        joint coupler9: Revolute { parent: upright8.at(X), child: bar9, axis: Z }
        joint follower9: Revolute { parent: ground.at(9.0 * X), child: upright9, axis: Z }
        #[cut]
        joint pin9: Revolute { parent: bar9.at(X), child: upright9.at(X), axis: Z }
        joint coupler10: Revolute { parent: upright9.at(X), child: bar10, axis: Z }
        joint follower10: Revolute { parent: ground.at(10.0 * X), child: upright10, axis: Z }
        #[cut]
        joint pin10: Revolute { parent: bar10.at(X), child: upright10.at(X), axis: Z }
        solve (coupler1, follower1) = (-crank.angle, crank.angle);
        solve (coupler2, follower2) = (-crank.angle, crank.angle);
        solve (coupler3, follower3) = (-crank.angle, crank.angle);
        solve (coupler4, follower4) = (-crank.angle, crank.angle);
        solve (coupler5, follower5) = (-crank.angle, crank.angle);
        solve (coupler6, follower6) = (-crank.angle, crank.angle);
        solve (coupler7, follower7) = (-crank.angle, crank.angle);
        solve (coupler8, follower8) = (-crank.angle, crank.angle);
        solve (coupler9, follower9) = (-crank.angle, crank.angle);
        solve (coupler10, follower10) = (-crank.angle, crank.angle);
        output tip = upright0.at(X).position;
        output energy = kinetic() + potential();
        emit forward_dynamics;
    }
}

multibody! {
    /// 1 four-bar in a row, each pin in space: three equations too many.
    pub mod redundant_1 {
        world { gravity: -9.81 * Y }
        formulation { constraints: Multipliers }
        body upright0 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body upright1 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body bar1 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        joint crank: Revolute { parent: ground, child: upright0, axis: Z }
        joint coupler1: Revolute { parent: upright0.at(X), child: bar1, axis: Z }
        joint follower1: Revolute { parent: ground.at(1.0 * X), child: upright1, axis: Z }
        #[cut]
        joint pin1: Revolute { parent: bar1.at(X), child: upright1.at(X), axis: Z }
        output tip = upright0.at(X).position;
        output energy = kinetic() + potential();
        emit forward_dynamics;
    }
    /// 2 four-bars in a row, each pin in space: three equations too many.
    pub mod redundant_2 {
        world { gravity: -9.81 * Y }
        formulation { constraints: Multipliers }
        body upright0 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body upright1 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body upright2 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body bar1 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body bar2 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        joint crank: Revolute { parent: ground, child: upright0, axis: Z }
        joint coupler1: Revolute { parent: upright0.at(X), child: bar1, axis: Z }
        joint follower1: Revolute { parent: ground.at(1.0 * X), child: upright1, axis: Z }
        #[cut]
        joint pin1: Revolute { parent: bar1.at(X), child: upright1.at(X), axis: Z }
        joint coupler2: Revolute { parent: upright1.at(X), child: bar2, axis: Z }
        joint follower2: Revolute { parent: ground.at(2.0 * X), child: upright2, axis: Z }
        #[cut]
        joint pin2: Revolute { parent: bar2.at(X), child: upright2.at(X), axis: Z }
        output tip = upright0.at(X).position;
        output energy = kinetic() + potential();
        emit forward_dynamics;
    }
}

multibody! {
    /// Andrews' squeezer, seven bodies in three loops.
    pub mod squeezer {
        /// [N m] on the first body
        const MOM = 0.033;
        const C0 = 4530.0;
        const L0 = 0.07785;
        const XA = -0.06934;
        const YA = -0.00227;
        const XB = -0.03635;
        const YB = 0.03273;
        const XC = 0.014;
        const YC = 0.072;
        const D = 0.028;
        const DA = 0.0115;
        const E = 0.02;
        const EA = 0.01421;
        const RR = 0.007;
        const RA = 0.00092;
        const SS = 0.035;
        const SA = 0.01874;
        const SB = 0.01043;
        const SC = 0.018;
        const SD = 0.02;
        const TA = 0.02308;
        const TB = 0.00916;
        const U = 0.04;
        const UA = 0.01228;
        const UB = 0.00449;
        const ZF = 0.02;
        const ZT = 0.04;
        const FA = 0.01421;

        formulation { constraints: Multipliers }
        body one { mass: 0.04325, com: RA * X, inertia: diag(0.0, 2.194e-6, 2.194e-6) }
        body two { mass: 0.00365, com: -DA * X, inertia: diag(0.0, 4.410e-7, 4.410e-7) }
        body three { mass: 0.02373, com: SB * X - SA * Y, inertia: diag(0.0, 5.255e-6, 5.255e-6) }
        body four { mass: 0.00706, com: (EA - E) * Y, inertia: diag(5.667e-7, 0.0, 5.667e-7) }
        body five { mass: 0.07050, com: TA * X + TB * Y, inertia: diag(0.0, 1.169e-5, 1.169e-5) }
        body six { mass: 0.00706, com: (ZF - FA) * X, inertia: diag(0.0, 5.667e-7, 5.667e-7) }
        body seven { mass: 0.05498, com: -UB * X - UA * Y, inertia: diag(0.0, 1.912e-5, 1.912e-5) }
        joint beta: Revolute { parent: ground, child: one, axis: Z }
        joint theta: Revolute { parent: one.at(RR * X), child: two, axis: Z }
        joint gamma: Revolute { parent: ground.at([XB, YB, 0.0]), child: three, axis: Z }
        joint delta: Revolute { parent: ground.at([XA, YA, 0.0]), child: five, axis: Z }
        joint phi: Revolute { parent: five.at(ZT * X), child: four, axis: Z }
        joint epsilon: Revolute { parent: ground.at([XA, YA, 0.0]), child: seven, axis: Z }
        joint omega: Revolute { parent: seven.at(-U * Y), child: six, axis: Z }
        #[cut]
        joint first: Revolute { parent: two.at(-D * X), child: three.at(-SS * Y), axis: Z }
        #[cut]
        joint second: Revolute { parent: two.at(-D * X), child: four.at(-E * Y), axis: Z }
        #[cut]
        joint third: Revolute { parent: two.at(-D * X), child: six.at(ZF * X), axis: Z }
        force motor: Effort { joint: beta, value: MOM }
        force spring: Spring {
            between: [three.at(SD * X - SC * Y), ground.at([XC, YC, 0.0])], stiffness: C0, length: L0,
        }
        emit forward_dynamics;
    }
}

multibody! {
    /// The same with its loops solved.
    pub mod squeezer_reduced {
        /// [N m] on the first body
        const MOM = 0.033;
        const C0 = 4530.0;
        const L0 = 0.07785;
        const XA = -0.06934;
        const YA = -0.00227;
        const XB = -0.03635;
        const YB = 0.03273;
        const XC = 0.014;
        const YC = 0.072;
        const D = 0.028;
        const DA = 0.0115;
        const E = 0.02;
        const EA = 0.01421;
        const RR = 0.007;
        const RA = 0.00092;
        const SS = 0.035;
        const SA = 0.01874;
        const SB = 0.01043;
        const SC = 0.018;
        const SD = 0.02;
        const TA = 0.02308;
        const TB = 0.00916;
        const U = 0.04;
        const UA = 0.01228;
        const UB = 0.00449;
        const ZF = 0.02;
        const ZT = 0.04;
        const FA = 0.01421;

        formulation { constraints: Reduced }
        body one { mass: 0.04325, com: RA * X, inertia: diag(0.0, 2.194e-6, 2.194e-6) }
        body two { mass: 0.00365, com: -DA * X, inertia: diag(0.0, 4.410e-7, 4.410e-7) }
        body three { mass: 0.02373, com: SB * X - SA * Y, inertia: diag(0.0, 5.255e-6, 5.255e-6) }
        body four { mass: 0.00706, com: (EA - E) * Y, inertia: diag(5.667e-7, 0.0, 5.667e-7) }
        body five { mass: 0.07050, com: TA * X + TB * Y, inertia: diag(0.0, 1.169e-5, 1.169e-5) }
        body six { mass: 0.00706, com: (ZF - FA) * X, inertia: diag(0.0, 5.667e-7, 5.667e-7) }
        body seven { mass: 0.05498, com: -UB * X - UA * Y, inertia: diag(0.0, 1.912e-5, 1.912e-5) }
        joint beta: Revolute { parent: ground, child: one, axis: Z }
        joint theta: Revolute { parent: one.at(RR * X), child: two, axis: Z }
        joint gamma: Revolute { parent: ground.at([XB, YB, 0.0]), child: three, axis: Z }
        joint delta: Revolute { parent: ground.at([XA, YA, 0.0]), child: five, axis: Z }
        joint phi: Revolute { parent: five.at(ZT * X), child: four, axis: Z }
        joint epsilon: Revolute { parent: ground.at([XA, YA, 0.0]), child: seven, axis: Z }
        joint omega: Revolute { parent: seven.at(-U * Y), child: six, axis: Z }
        #[cut]
        joint first: Revolute { parent: two.at(-D * X), child: three.at(-SS * Y), axis: Z }
        #[cut]
        joint second: Revolute { parent: two.at(-D * X), child: four.at(-E * Y), axis: Z }
        #[cut]
        joint third: Revolute { parent: two.at(-D * X), child: six.at(ZF * X), axis: Z }
        force motor: Effort { joint: beta, value: MOM }
        force spring: Spring {
            between: [three.at(SD * X - SC * Y), ground.at([XC, YC, 0.0])], stiffness: C0, length: L0,
        }
        solve (theta, gamma) from first { cos(beta.angle + theta.angle - gamma.angle) > 0.0 }
        solve (phi, delta) from second { cos(phi.angle) > 0.0 }
        solve (omega, epsilon) from third { cos(omega.angle) > 0.0 }
        emit forward_dynamics, kinematics { given: beta, find: [theta, gamma, phi, delta, omega, epsilon] };
    }
}
