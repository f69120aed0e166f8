//! A hundred uniform rods in a row: what a long chain costs. Written by hand it would be a part used a hundred times, but
//! each of them hangs on the one before.

use multibody::multibody;

multibody! {
    /// Rods of one kilogram and one metre. Hinges turn about +z, gravity pulls along -y.
    pub mod hundred_rods {
        world { gravity: -9.81 * Y }
        body rod1 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge1: Revolute { parent: ground, child: rod1, axis: Z }
        body rod2 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge2: Revolute { parent: rod1.at(-Y), child: rod2, axis: Z }
        body rod3 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge3: Revolute { parent: rod2.at(-Y), child: rod3, axis: Z }
        body rod4 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge4: Revolute { parent: rod3.at(-Y), child: rod4, axis: Z }
        body rod5 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge5: Revolute { parent: rod4.at(-Y), child: rod5, axis: Z }
        body rod6 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge6: Revolute { parent: rod5.at(-Y), child: rod6, axis: Z }
        body rod7 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge7: Revolute { parent: rod6.at(-Y), child: rod7, axis: Z }
        body rod8 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge8: Revolute { parent: rod7.at(-Y), child: rod8, axis: Z }
        body rod9 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge9: Revolute { parent: rod8.at(-Y), child: rod9, axis: Z }
        body rod10 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge10: Revolute { parent: rod9.at(-Y), child: rod10, axis: Z }
        body rod11 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge11: Revolute { parent: rod10.at(-Y), child: rod11, axis: Z }
        body rod12 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge12: Revolute { parent: rod11.at(-Y), child: rod12, axis: Z }
        body rod13 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge13: Revolute { parent: rod12.at(-Y), child: rod13, axis: Z }
        body rod14 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge14: Revolute { parent: rod13.at(-Y), child: rod14, axis: Z }
        body rod15 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge15: Revolute { parent: rod14.at(-Y), child: rod15, axis: Z }
        body rod16 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge16: Revolute { parent: rod15.at(-Y), child: rod16, axis: Z }
        body rod17 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge17: Revolute { parent: rod16.at(-Y), child: rod17, axis: Z }
        body rod18 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge18: Revolute { parent: rod17.at(-Y), child: rod18, axis: Z }
        body rod19 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge19: Revolute { parent: rod18.at(-Y), child: rod19, axis: Z }
        body rod20 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge20: Revolute { parent: rod19.at(-Y), child: rod20, axis: Z }
        body rod21 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge21: Revolute { parent: rod20.at(-Y), child: rod21, axis: Z }
        body rod22 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge22: Revolute { parent: rod21.at(-Y), child: rod22, axis: Z }
        body rod23 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge23: Revolute { parent: rod22.at(-Y), child: rod23, axis: Z }
        body rod24 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge24: Revolute { parent: rod23.at(-Y), child: rod24, axis: Z }
        body rod25 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge25: Revolute { parent: rod24.at(-Y), child: rod25, axis: Z }
        body rod26 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge26: Revolute { parent: rod25.at(-Y), child: rod26, axis: Z }
        body rod27 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge27: Revolute { parent: rod26.at(-Y), child: rod27, axis: Z }
        body rod28 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge28: Revolute { parent: rod27.at(-Y), child: rod28, axis: Z }
        body rod29 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge29: Revolute { parent: rod28.at(-Y), child: rod29, axis: Z }
        body rod30 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge30: Revolute { parent: rod29.at(-Y), child: rod30, axis: Z }
        body rod31 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge31: Revolute { parent: rod30.at(-Y), child: rod31, axis: Z }
        body rod32 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge32: Revolute { parent: rod31.at(-Y), child: rod32, axis: Z }
        body rod33 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge33: Revolute { parent: rod32.at(-Y), child: rod33, axis: Z }
        body rod34 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge34: Revolute { parent: rod33.at(-Y), child: rod34, axis: Z }
        body rod35 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge35: Revolute { parent: rod34.at(-Y), child: rod35, axis: Z }
        body rod36 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge36: Revolute { parent: rod35.at(-Y), child: rod36, axis: Z }
        body rod37 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge37: Revolute { parent: rod36.at(-Y), child: rod37, axis: Z }
        body rod38 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge38: Revolute { parent: rod37.at(-Y), child: rod38, axis: Z }
        body rod39 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge39: Revolute { parent: rod38.at(-Y), child: rod39, axis: Z }
        body rod40 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge40: Revolute { parent: rod39.at(-Y), child: rod40, axis: Z }
        body rod41 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge41: Revolute { parent: rod40.at(-Y), child: rod41, axis: Z }
        body rod42 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge42: Revolute { parent: rod41.at(-Y), child: rod42, axis: Z }
        body rod43 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge43: Revolute { parent: rod42.at(-Y), child: rod43, axis: Z }
        body rod44 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge44: Revolute { parent: rod43.at(-Y), child: rod44, axis: Z }
        body rod45 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge45: Revolute { parent: rod44.at(-Y), child: rod45, axis: Z }
        body rod46 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge46: Revolute { parent: rod45.at(-Y), child: rod46, axis: Z }
        body rod47 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge47: Revolute { parent: rod46.at(-Y), child: rod47, axis: Z }
        body rod48 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge48: Revolute { parent: rod47.at(-Y), child: rod48, axis: Z }
        body rod49 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge49: Revolute { parent: rod48.at(-Y), child: rod49, axis: Z }
        body rod50 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge50: Revolute { parent: rod49.at(-Y), child: rod50, axis: Z }
        body rod51 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge51: Revolute { parent: rod50.at(-Y), child: rod51, axis: Z }
        body rod52 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge52: Revolute { parent: rod51.at(-Y), child: rod52, axis: Z }
        body rod53 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge53: Revolute { parent: rod52.at(-Y), child: rod53, axis: Z }
        body rod54 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge54: Revolute { parent: rod53.at(-Y), child: rod54, axis: Z }
        body rod55 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge55: Revolute { parent: rod54.at(-Y), child: rod55, axis: Z }
        body rod56 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge56: Revolute { parent: rod55.at(-Y), child: rod56, axis: Z }
        body rod57 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge57: Revolute { parent: rod56.at(-Y), child: rod57, axis: Z }
        body rod58 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge58: Revolute { parent: rod57.at(-Y), child: rod58, axis: Z }
        body rod59 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge59: Revolute { parent: rod58.at(-Y), child: rod59, axis: Z }
        body rod60 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge60: Revolute { parent: rod59.at(-Y), child: rod60, axis: Z }
        body rod61 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge61: Revolute { parent: rod60.at(-Y), child: rod61, axis: Z }
        body rod62 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge62: Revolute { parent: rod61.at(-Y), child: rod62, axis: Z }
        body rod63 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge63: Revolute { parent: rod62.at(-Y), child: rod63, axis: Z }
        body rod64 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge64: Revolute { parent: rod63.at(-Y), child: rod64, axis: Z }
        body rod65 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge65: Revolute { parent: rod64.at(-Y), child: rod65, axis: Z }
        body rod66 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge66: Revolute { parent: rod65.at(-Y), child: rod66, axis: Z }
        body rod67 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge67: Revolute { parent: rod66.at(-Y), child: rod67, axis: Z }
        body rod68 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge68: Revolute { parent: rod67.at(-Y), child: rod68, axis: Z }
        body rod69 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge69: Revolute { parent: rod68.at(-Y), child: rod69, axis: Z }
        body rod70 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge70: Revolute { parent: rod69.at(-Y), child: rod70, axis: Z }
        body rod71 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge71: Revolute { parent: rod70.at(-Y), child: rod71, axis: Z }
        body rod72 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge72: Revolute { parent: rod71.at(-Y), child: rod72, axis: Z }
        body rod73 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge73: Revolute { parent: rod72.at(-Y), child: rod73, axis: Z }
        body rod74 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge74: Revolute { parent: rod73.at(-Y), child: rod74, axis: Z }
        body rod75 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge75: Revolute { parent: rod74.at(-Y), child: rod75, axis: Z }
        body rod76 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge76: Revolute { parent: rod75.at(-Y), child: rod76, axis: Z }
        body rod77 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge77: Revolute { parent: rod76.at(-Y), child: rod77, axis: Z }
        body rod78 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge78: Revolute { parent: rod77.at(-Y), child: rod78, axis: Z }
        body rod79 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge79: Revolute { parent: rod78.at(-Y), child: rod79, axis: Z }
        body rod80 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge80: Revolute { parent: rod79.at(-Y), child: rod80, axis: Z }
        body rod81 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge81: Revolute { parent: rod80.at(-Y), child: rod81, axis: Z }
        body rod82 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge82: Revolute { parent: rod81.at(-Y), child: rod82, axis: Z }
        body rod83 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge83: Revolute { parent: rod82.at(-Y), child: rod83, axis: Z }
        body rod84 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge84: Revolute { parent: rod83.at(-Y), child: rod84, axis: Z }
        body rod85 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge85: Revolute { parent: rod84.at(-Y), child: rod85, axis: Z }
        body rod86 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge86: Revolute { parent: rod85.at(-Y), child: rod86, axis: Z }
        body rod87 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge87: Revolute { parent: rod86.at(-Y), child: rod87, axis: Z }
        body rod88 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge88: Revolute { parent: rod87.at(-Y), child: rod88, axis: Z }
        body rod89 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge89: Revolute { parent: rod88.at(-Y), child: rod89, axis: Z }
        body rod90 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge90: Revolute { parent: rod89.at(-Y), child: rod90, axis: Z }
        body rod91 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge91: Revolute { parent: rod90.at(-Y), child: rod91, axis: Z }
        body rod92 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge92: Revolute { parent: rod91.at(-Y), child: rod92, axis: Z }
        body rod93 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge93: Revolute { parent: rod92.at(-Y), child: rod93, axis: Z }
        body rod94 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge94: Revolute { parent: rod93.at(-Y), child: rod94, axis: Z }
        body rod95 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge95: Revolute { parent: rod94.at(-Y), child: rod95, axis: Z }
        body rod96 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge96: Revolute { parent: rod95.at(-Y), child: rod96, axis: Z }
        body rod97 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge97: Revolute { parent: rod96.at(-Y), child: rod97, axis: Z }
        body rod98 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge98: Revolute { parent: rod97.at(-Y), child: rod98, axis: Z }
        body rod99 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge99: Revolute { parent: rod98.at(-Y), child: rod99, axis: Z }
        body rod100 { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint hinge100: Revolute { parent: rod99.at(-Y), child: rod100, axis: Z }
        emit forward_dynamics, energy;
    }
}
