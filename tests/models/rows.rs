//! N four-bars in a row, all bars of one length: a benchmark whose loops lose rank whenever the bars lie flat (reference data
//! in `data/motion/a2_nfourbar.json`).

/// Declares a row of four-bars: `name: Reduced` with the solution that the user knows, `name: Multipliers` with its
/// equations. Each cell is a place on the ground, the upright before, and the names of its own parts.
#[macro_export]
macro_rules! four_bars {
    (
        $(#[$docs:meta])* $name:ident: Reduced
        $([$place:literal $before:ident $upright:ident $bar:ident $coupler:ident $follower:ident $pin:ident])*
    ) => {
        $crate::four_bars! {
            $(#[$docs])* $name {
                formulation { constraints: Reduced }
                $(solve ($coupler, $follower) = (-crank.angle, crank.angle);)*
            }
            $([$place $before $upright $bar $coupler $follower $pin])*
        }
    };
    ($(#[$docs:meta])* $name:ident: Multipliers $($cells:tt)*) => {
        $crate::four_bars! { $(#[$docs])* $name { formulation { constraints: Multipliers } } $($cells)* }
    };
    (
        $(#[$docs:meta])* $name:ident { $($items:tt)* }
        $([$place:literal $before:ident $upright:ident $bar:ident $coupler:ident $follower:ident $pin:ident])*
    ) => {
        multibody::multibody! {
            $(#[$docs])*
            pub mod $name {
                world { gravity: -9.81 * Y }
                body upright0 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
                joint crank: Revolute { parent: ground, child: upright0, axis: Z }
                $(
                    body $upright { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
                    body $bar { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
                    joint $coupler: Revolute { parent: $before.at(X), child: $bar, axis: Z }
                    joint $follower: Revolute { parent: ground.at($place * X), child: $upright, axis: Z }
                    #[cut]
                    joint $pin: Revolute { parent: $bar.at(X), child: $upright.at(X), axis: Z }
                )*
                $($items)*
                output tip = upright0.at(X).position;
                output energy = kinetic() + potential();
                emit forward_dynamics;
            }
        }
    };
}

four_bars! {
    /// 1 parallelogram in a row, with the solution that the user knows.
    four_bars_1: Reduced
    [1.0 upright0 upright1 bar1 coupler1 follower1 pin1]
}

four_bars! {
    /// 2 parallelograms in a row, with the solution that the user knows.
    four_bars_2: Reduced
    [1.0 upright0 upright1 bar1 coupler1 follower1 pin1]
    [2.0 upright1 upright2 bar2 coupler2 follower2 pin2]
}

four_bars! {
    /// 10 parallelograms in a row, with the solution that the user knows.
    four_bars_10: Reduced
    [1.0 upright0 upright1 bar1 coupler1 follower1 pin1]
    [2.0 upright1 upright2 bar2 coupler2 follower2 pin2]
    [3.0 upright2 upright3 bar3 coupler3 follower3 pin3]
    [4.0 upright3 upright4 bar4 coupler4 follower4 pin4]
    [5.0 upright4 upright5 bar5 coupler5 follower5 pin5]
    [6.0 upright5 upright6 bar6 coupler6 follower6 pin6]
    [7.0 upright6 upright7 bar7 coupler7 follower7 pin7]
    [8.0 upright7 upright8 bar8 coupler8 follower8 pin8]
    [9.0 upright8 upright9 bar9 coupler9 follower9 pin9]
    [10.0 upright9 upright10 bar10 coupler10 follower10 pin10]
}

four_bars! {
    /// 1 four-bar in a row, each pin in space: 3 equations too many.
    redundant_1: Multipliers
    [1.0 upright0 upright1 bar1 coupler1 follower1 pin1]
}

four_bars! {
    /// 2 four-bars in a row, each pin in space: 6 equations too many.
    redundant_2: Multipliers
    [1.0 upright0 upright1 bar1 coupler1 follower1 pin1]
    [2.0 upright1 upright2 bar2 coupler2 follower2 pin2]
}

four_bars! {
    /// 10 four-bars in a row, each pin in space: 30 equations too many.
    redundant_10: Multipliers
    [1.0 upright0 upright1 bar1 coupler1 follower1 pin1]
    [2.0 upright1 upright2 bar2 coupler2 follower2 pin2]
    [3.0 upright2 upright3 bar3 coupler3 follower3 pin3]
    [4.0 upright3 upright4 bar4 coupler4 follower4 pin4]
    [5.0 upright4 upright5 bar5 coupler5 follower5 pin5]
    [6.0 upright5 upright6 bar6 coupler6 follower6 pin6]
    [7.0 upright6 upright7 bar7 coupler7 follower7 pin7]
    [8.0 upright7 upright8 bar8 coupler8 follower8 pin8]
    [9.0 upright8 upright9 bar9 coupler9 follower9 pin9]
    [10.0 upright9 upright10 bar10 coupler10 follower10 pin10]
}
