//! Mistakes about a closed loop.
use multibody::multibody;

multibody! {
    mod four_bar {
        body crank { mass: 1.0, inertia: rod(1.0, 1.0, X) }
        body rocker { mass: 1.0, inertia: rod(1.0, 1.0, X) }
        joint a: Revolute { parent: ground, child: crank, axis: Z }
        joint b: Revolute { parent: crank.at(X), child: rocker, axis: Z }
        joint closing: Revolute { parent: ground.at(X), child: rocker.at(X), axis: Z }
        drive b = 2.0 * t;
        solve (b) from closing { b > 0.0 }
        output angle = closing.angle;
    }
    mod left_to_the_compiler {
        body slider { mass: 1.0 }
        joint rail: Prismatic { parent: ground, child: slider, axis: X }
        constraint stop = slider.position.x - 1.0;
        formulation { constraints: Auto, rate: 40.0 }
    }
    mod chosen {
        body slider { mass: 1.0 }
        joint rail: Prismatic { parent: ground, child: slider, axis: X }
        formulation { constraints: Auto }
    }
    mod asking {
        body cart { mass: 1.0 }
        joint rail: Prismatic { parent: ground, child: cart, axis: X }
        output ahead = chosen(rail, rail = 2.0);
    }
    mod held_by_nothing {
        body link { mass: 1.0, inertia: rod(1.0, 1.0, X) }
        #[cut]
        joint a: Revolute { parent: ground, child: link, axis: Z }
    }
    mod closed_twice {
        body crank { mass: 1.0, inertia: rod(1.0, 1.0, X) }
        body rocker { mass: 1.0, inertia: rod(1.0, 1.0, X) }
        joint a: Revolute { parent: ground, child: crank, axis: Z }
        joint b: Revolute { parent: crank.at(X), child: rocker, axis: Z }
        joint closing: PinSlot { parent: ground.at(X), child: rocker.at(X), axis: Z, slide: X }
        solve (b) from (closing, closing, a) { b > 0.0 }
    }
    mod shared {
        world { gravity: [1.0, -9.0, 3.0] }
        body crank { mass: 1.0, inertia: rod(1.0, 1.0, X) }
        body coupler { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body rocker { mass: 1.0, inertia: rod(1.0, 1.0, X) }
        joint a: Revolute { parent: ground, child: crank, axis: Z }
        joint b: Revolute { parent: crank.at(X), child: coupler, axis: Z }
        joint c: Revolute { parent: ground.at(1.5 * X), child: rocker, axis: Z }
        #[cut]
        joint d: Revolute { parent: coupler.at(X), child: rocker.at(X), axis: Z }
        output in_plane = a.reaction.force.x;
        output whole = norm(b.reaction.force);
    }
}

fn main() {
    four_bar::Model::<f64>::new(&four_bar::Params::default());
}
