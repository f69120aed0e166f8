//! Rows of four-bars with more members than `linkages` has.

use multibody::multibody;

multibody! {
    /// 40 parallelograms in a row, with the solution that the user knows.
    pub mod four_bars_40 {
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
        body upright11 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body upright12 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body upright13 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body upright14 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body upright15 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body upright16 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body upright17 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body upright18 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body upright19 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body upright20 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body upright21 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body upright22 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body upright23 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body upright24 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body upright25 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body upright26 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body upright27 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body upright28 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body upright29 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body upright30 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body upright31 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body upright32 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body upright33 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body upright34 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body upright35 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body upright36 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body upright37 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body upright38 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body upright39 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body upright40 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
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
        body bar11 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body bar12 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body bar13 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body bar14 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body bar15 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body bar16 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body bar17 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body bar18 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body bar19 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body bar20 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body bar21 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body bar22 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body bar23 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body bar24 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body bar25 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body bar26 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body bar27 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body bar28 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body bar29 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body bar30 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body bar31 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body bar32 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body bar33 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body bar34 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body bar35 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body bar36 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body bar37 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body bar38 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body bar39 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body bar40 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
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
        joint coupler11: Revolute { parent: upright10.at(X), child: bar11, axis: Z }
        joint follower11: Revolute { parent: ground.at(11.0 * X), child: upright11, axis: Z }
        #[cut]
        joint pin11: Revolute { parent: bar11.at(X), child: upright11.at(X), axis: Z }
        joint coupler12: Revolute { parent: upright11.at(X), child: bar12, axis: Z }
        joint follower12: Revolute { parent: ground.at(12.0 * X), child: upright12, axis: Z }
        #[cut]
        joint pin12: Revolute { parent: bar12.at(X), child: upright12.at(X), axis: Z }
        joint coupler13: Revolute { parent: upright12.at(X), child: bar13, axis: Z }
        joint follower13: Revolute { parent: ground.at(13.0 * X), child: upright13, axis: Z }
        #[cut]
        joint pin13: Revolute { parent: bar13.at(X), child: upright13.at(X), axis: Z }
        joint coupler14: Revolute { parent: upright13.at(X), child: bar14, axis: Z }
        joint follower14: Revolute { parent: ground.at(14.0 * X), child: upright14, axis: Z }
        #[cut]
        joint pin14: Revolute { parent: bar14.at(X), child: upright14.at(X), axis: Z }
        joint coupler15: Revolute { parent: upright14.at(X), child: bar15, axis: Z }
        joint follower15: Revolute { parent: ground.at(15.0 * X), child: upright15, axis: Z }
        #[cut]
        joint pin15: Revolute { parent: bar15.at(X), child: upright15.at(X), axis: Z }
        joint coupler16: Revolute { parent: upright15.at(X), child: bar16, axis: Z }
        joint follower16: Revolute { parent: ground.at(16.0 * X), child: upright16, axis: Z }
        #[cut]
        joint pin16: Revolute { parent: bar16.at(X), child: upright16.at(X), axis: Z }
        joint coupler17: Revolute { parent: upright16.at(X), child: bar17, axis: Z }
        joint follower17: Revolute { parent: ground.at(17.0 * X), child: upright17, axis: Z }
        #[cut]
        joint pin17: Revolute { parent: bar17.at(X), child: upright17.at(X), axis: Z }
        joint coupler18: Revolute { parent: upright17.at(X), child: bar18, axis: Z }
        joint follower18: Revolute { parent: ground.at(18.0 * X), child: upright18, axis: Z }
        #[cut]
        joint pin18: Revolute { parent: bar18.at(X), child: upright18.at(X), axis: Z }
        joint coupler19: Revolute { parent: upright18.at(X), child: bar19, axis: Z }
        joint follower19: Revolute { parent: ground.at(19.0 * X), child: upright19, axis: Z }
        #[cut]
        joint pin19: Revolute { parent: bar19.at(X), child: upright19.at(X), axis: Z }
        joint coupler20: Revolute { parent: upright19.at(X), child: bar20, axis: Z }
        joint follower20: Revolute { parent: ground.at(20.0 * X), child: upright20, axis: Z }
        #[cut]
        joint pin20: Revolute { parent: bar20.at(X), child: upright20.at(X), axis: Z }
        joint coupler21: Revolute { parent: upright20.at(X), child: bar21, axis: Z }
        joint follower21: Revolute { parent: ground.at(21.0 * X), child: upright21, axis: Z }
        #[cut]
        joint pin21: Revolute { parent: bar21.at(X), child: upright21.at(X), axis: Z }
        joint coupler22: Revolute { parent: upright21.at(X), child: bar22, axis: Z }
        joint follower22: Revolute { parent: ground.at(22.0 * X), child: upright22, axis: Z }
        #[cut]
        joint pin22: Revolute { parent: bar22.at(X), child: upright22.at(X), axis: Z }
        joint coupler23: Revolute { parent: upright22.at(X), child: bar23, axis: Z }
        joint follower23: Revolute { parent: ground.at(23.0 * X), child: upright23, axis: Z }
        #[cut]
        joint pin23: Revolute { parent: bar23.at(X), child: upright23.at(X), axis: Z }
        joint coupler24: Revolute { parent: upright23.at(X), child: bar24, axis: Z }
        joint follower24: Revolute { parent: ground.at(24.0 * X), child: upright24, axis: Z }
        #[cut]
        joint pin24: Revolute { parent: bar24.at(X), child: upright24.at(X), axis: Z }
        joint coupler25: Revolute { parent: upright24.at(X), child: bar25, axis: Z }
        joint follower25: Revolute { parent: ground.at(25.0 * X), child: upright25, axis: Z }
        #[cut]
        joint pin25: Revolute { parent: bar25.at(X), child: upright25.at(X), axis: Z }
        joint coupler26: Revolute { parent: upright25.at(X), child: bar26, axis: Z }
        joint follower26: Revolute { parent: ground.at(26.0 * X), child: upright26, axis: Z }
        #[cut]
        joint pin26: Revolute { parent: bar26.at(X), child: upright26.at(X), axis: Z }
        joint coupler27: Revolute { parent: upright26.at(X), child: bar27, axis: Z }
        joint follower27: Revolute { parent: ground.at(27.0 * X), child: upright27, axis: Z }
        #[cut]
        joint pin27: Revolute { parent: bar27.at(X), child: upright27.at(X), axis: Z }
        joint coupler28: Revolute { parent: upright27.at(X), child: bar28, axis: Z }
        joint follower28: Revolute { parent: ground.at(28.0 * X), child: upright28, axis: Z }
        #[cut]
        joint pin28: Revolute { parent: bar28.at(X), child: upright28.at(X), axis: Z }
        joint coupler29: Revolute { parent: upright28.at(X), child: bar29, axis: Z }
        joint follower29: Revolute { parent: ground.at(29.0 * X), child: upright29, axis: Z }
        #[cut]
        joint pin29: Revolute { parent: bar29.at(X), child: upright29.at(X), axis: Z }
        joint coupler30: Revolute { parent: upright29.at(X), child: bar30, axis: Z }
        joint follower30: Revolute { parent: ground.at(30.0 * X), child: upright30, axis: Z }
        #[cut]
        joint pin30: Revolute { parent: bar30.at(X), child: upright30.at(X), axis: Z }
        joint coupler31: Revolute { parent: upright30.at(X), child: bar31, axis: Z }
        joint follower31: Revolute { parent: ground.at(31.0 * X), child: upright31, axis: Z }
        #[cut]
        joint pin31: Revolute { parent: bar31.at(X), child: upright31.at(X), axis: Z }
        joint coupler32: Revolute { parent: upright31.at(X), child: bar32, axis: Z }
        joint follower32: Revolute { parent: ground.at(32.0 * X), child: upright32, axis: Z }
        #[cut]
        joint pin32: Revolute { parent: bar32.at(X), child: upright32.at(X), axis: Z }
        joint coupler33: Revolute { parent: upright32.at(X), child: bar33, axis: Z }
        joint follower33: Revolute { parent: ground.at(33.0 * X), child: upright33, axis: Z }
        #[cut]
        joint pin33: Revolute { parent: bar33.at(X), child: upright33.at(X), axis: Z }
        joint coupler34: Revolute { parent: upright33.at(X), child: bar34, axis: Z }
        joint follower34: Revolute { parent: ground.at(34.0 * X), child: upright34, axis: Z }
        #[cut]
        joint pin34: Revolute { parent: bar34.at(X), child: upright34.at(X), axis: Z }
        joint coupler35: Revolute { parent: upright34.at(X), child: bar35, axis: Z }
        joint follower35: Revolute { parent: ground.at(35.0 * X), child: upright35, axis: Z }
        #[cut]
        joint pin35: Revolute { parent: bar35.at(X), child: upright35.at(X), axis: Z }
        joint coupler36: Revolute { parent: upright35.at(X), child: bar36, axis: Z }
        joint follower36: Revolute { parent: ground.at(36.0 * X), child: upright36, axis: Z }
        #[cut]
        joint pin36: Revolute { parent: bar36.at(X), child: upright36.at(X), axis: Z }
        joint coupler37: Revolute { parent: upright36.at(X), child: bar37, axis: Z }
        joint follower37: Revolute { parent: ground.at(37.0 * X), child: upright37, axis: Z }
        #[cut]
        joint pin37: Revolute { parent: bar37.at(X), child: upright37.at(X), axis: Z }
        joint coupler38: Revolute { parent: upright37.at(X), child: bar38, axis: Z }
        joint follower38: Revolute { parent: ground.at(38.0 * X), child: upright38, axis: Z }
        #[cut]
        joint pin38: Revolute { parent: bar38.at(X), child: upright38.at(X), axis: Z }
        joint coupler39: Revolute { parent: upright38.at(X), child: bar39, axis: Z }
        joint follower39: Revolute { parent: ground.at(39.0 * X), child: upright39, axis: Z }
        #[cut]
        joint pin39: Revolute { parent: bar39.at(X), child: upright39.at(X), axis: Z }
        joint coupler40: Revolute { parent: upright39.at(X), child: bar40, axis: Z }
        joint follower40: Revolute { parent: ground.at(40.0 * X), child: upright40, axis: Z }
        #[cut]
        joint pin40: Revolute { parent: bar40.at(X), child: upright40.at(X), axis: Z }
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
        solve (coupler11, follower11) = (-crank.angle, crank.angle);
        solve (coupler12, follower12) = (-crank.angle, crank.angle);
        solve (coupler13, follower13) = (-crank.angle, crank.angle);
        solve (coupler14, follower14) = (-crank.angle, crank.angle);
        solve (coupler15, follower15) = (-crank.angle, crank.angle);
        solve (coupler16, follower16) = (-crank.angle, crank.angle);
        solve (coupler17, follower17) = (-crank.angle, crank.angle);
        solve (coupler18, follower18) = (-crank.angle, crank.angle);
        solve (coupler19, follower19) = (-crank.angle, crank.angle);
        solve (coupler20, follower20) = (-crank.angle, crank.angle);
        solve (coupler21, follower21) = (-crank.angle, crank.angle);
        solve (coupler22, follower22) = (-crank.angle, crank.angle);
        solve (coupler23, follower23) = (-crank.angle, crank.angle);
        solve (coupler24, follower24) = (-crank.angle, crank.angle);
        solve (coupler25, follower25) = (-crank.angle, crank.angle);
        solve (coupler26, follower26) = (-crank.angle, crank.angle);
        solve (coupler27, follower27) = (-crank.angle, crank.angle);
        solve (coupler28, follower28) = (-crank.angle, crank.angle);
        solve (coupler29, follower29) = (-crank.angle, crank.angle);
        solve (coupler30, follower30) = (-crank.angle, crank.angle);
        solve (coupler31, follower31) = (-crank.angle, crank.angle);
        solve (coupler32, follower32) = (-crank.angle, crank.angle);
        solve (coupler33, follower33) = (-crank.angle, crank.angle);
        solve (coupler34, follower34) = (-crank.angle, crank.angle);
        solve (coupler35, follower35) = (-crank.angle, crank.angle);
        solve (coupler36, follower36) = (-crank.angle, crank.angle);
        solve (coupler37, follower37) = (-crank.angle, crank.angle);
        solve (coupler38, follower38) = (-crank.angle, crank.angle);
        solve (coupler39, follower39) = (-crank.angle, crank.angle);
        solve (coupler40, follower40) = (-crank.angle, crank.angle);
        output tip = upright0.at(X).position;
        output energy = kinetic() + potential();
        emit forward_dynamics;
    }
}

multibody! {
    /// 10 four-bars in a row, each pin in space: 30 equations too many.
    pub mod redundant_10 {
        world { gravity: -9.81 * Y }
        formulation { constraints: Multipliers }
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
        output tip = upright0.at(X).position;
        output energy = kinetic() + potential();
        emit forward_dynamics;
    }
}
