//! Parts of another crate, of another file's call under another name, and in a function body.
use multibody::multibody;

mod inner {
    use multibody_test_parts::legs::foot as hoof;

    multibody::multibody! {
        use self::hoof;
        pub mod stamp {
            world { gravity: -9.81 * Z }
            part one: hoof { ankle: ground };
        }
    }

    multibody::multibody! {
        /// A disc on a spring.
        pub(crate) mod disc {
            port on: Frame;
            body plate { mass: 1.0, inertia: diag(1.0, 1.0, 2.0) }
            joint turn: Revolute { parent: on, child: plate, axis: Z }
            force spring: Spring { joint: turn, stiffness: 8.0 }
        }
    }
}

multibody! {
    use multibody_test_parts::machines::pair;
    pub mod walker {
        world { gravity: -9.81 * Z }
        body hull { mass: 10.0, inertia: sphere(10.0, 0.2) }
        joint float: Free { parent: ground, child: hull }
        part rear: pair { axle: hull };
        part foot: foot { on: hull };
        output height = rear.legs[1].height;
    }
    // Parts of parts have names of their own.
    mod foot {
        port on: Frame;
        body pad { mass: 1.0 }
        joint slide: Prismatic { parent: on, child: pad, axis: X }
    }
}

fn main() {
    let model = walker::Model::<f64>::default();
    let mut x = walker::State::default();
    x.q.rear.legs[1].knee = 0.3;
    let input = walker::Input::default();
    assert!(model.forward_dynamics(0.0, &x, &input).rear.legs[0].knee.is_finite());

    multibody! {
        use inner::disc;
        mod local {
            part a: disc { on: ground };
        }
    }
    let model = local::Model::<f64>::default();
    let mut x = local::State::default();
    x.q.a.turn = 1.0;
    assert_eq!(model.forward_dynamics(0.0, &x, &()).a.turn, -4.0);
}
