//! A mass matrix that is singular where a motion stands ends it in an error that names the coordinate.

use multibody::{DormandPrince, IntegrationError, Integrator, Radau, Rk4, System, multibody};

multibody! {
    /// Two blocks on one line, pulled apart.
    pub mod blocks {
        /// [kg]
        param light = 1.0;
        input pull;
        body first { mass: 2.0 }
        body second { mass: light }
        joint rail: Prismatic { parent: ground, child: first, axis: X }
        joint slider: Prismatic { parent: first, child: second, axis: X }
        force pulled: Effort { joint: slider, value: pull }
        emit forward_dynamics, derivatives;
    }

    /// The same, with a mass matrix of its own.
    pub mod shown {
        /// [kg]
        param light = 1.0;
        input pull;
        body first { mass: light }
        body second { mass: 3.0 }
        joint rail: Prismatic { parent: ground, child: first, axis: X }
        joint slider: Prismatic { parent: first, child: second, axis: X }
        force pulled: Effort { joint: slider, value: pull }
        emit forward_dynamics, mass_matrix, derivatives;
    }

    /// A point on a string: straight down no azimuth has inertia.
    pub mod spherical {
        input turned;
        world { gravity: -9.81 * Z }
        body arm { mass: 0.0 }
        body bob { mass: 1.5, com: -0.5 * Z }
        joint azimuth: Revolute { parent: ground, child: arm, axis: Z }
        joint elevation: Revolute { parent: arm, child: bob, axis: X }
        force turning: Effort { joint: azimuth, value: turned }
        emit forward_dynamics, derivatives;
    }

    /// The same string, led by time: straight down after one second.
    pub mod led {
        input turned;
        body arm { mass: 0.0 }
        body bob { mass: 1.5, com: -0.5 * Z }
        joint azimuth: Revolute { parent: ground, child: arm, axis: Z }
        joint elevation: Revolute { parent: arm, child: bob, axis: X }
        drive elevation = 1.0 - t;
        force turning: Effort { joint: azimuth, value: turned }
        emit forward_dynamics;
    }

    /// A weight on a rail, tied to a crank by an equation with a multiplier.
    pub mod hung {
        /// [kg]
        param load = 1.0;
        world { gravity: -9.81 * Y }
        body crank { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body weight { mass: load }
        joint pin: Revolute { parent: ground, child: crank, axis: Z }
        joint across: Prismatic { parent: ground, child: weight, axis: X }
        constraint string: Rod { between: [crank.at(X), weight], length: 1.25 }
        formulation { constraints: Multipliers }
        emit forward_dynamics;
    }

    /// Every body resists every motion.
    pub mod solid {
        input pull;
        body first { mass: 2.0, inertia: sphere(2.0, 0.1) }
        body second { mass: 1.0, inertia: sphere(1.0, 0.1) }
        joint rail: Prismatic { parent: ground, child: first, axis: X }
        joint slider: Prismatic { parent: first, child: second, axis: X }
        force pulled: Effort { joint: slider, value: pull }
        emit forward_dynamics;
    }
}

/// How motions end that start there, with steps of one length and with steps chosen by error; Radau needs derivatives.
macro_rules! ends {
    ($model:expr, $start:expr, $input:expr, $t:expr, [$($method:expr),*]) => {{
        let (model, start, input, t): (_, _, _, f64) = ($model, $start, $input, $t);
        let mut list = Vec::new();
        $(
            let fixed = Integrator::fixed($method, 0.25);
            list.push((concat!(stringify!($method), " by length"), fixed.integrate(model, t, t + 1.0, start, input, |_, _| ()).err()));
        )*
        let chosen = Integrator::adaptive(DormandPrince, 1e-6, 1e-6);
        list.push(("DormandPrince by error", chosen.integrate(model, t, t + 1.0, start, input, |_, _| ()).err()));
        list
    }};
}

fn expect(ends: Vec<(&str, Option<IntegrationError>)>, error: &IntegrationError) {
    for (method, end) in ends {
        assert_eq!(end.as_ref(), Some(error), "{method}");
    }
}

#[test]
fn a_mass_of_zero_names_its_coordinate() {
    let params = blocks::Params { light: 0.0 };
    assert!(params.check().is_err());
    let (model, start) = (blocks::Model::new(&params), blocks::State::default());
    for pull in [0.0, 2.0] {
        let input = blocks::Input { pull };
        let error = IntegrationError::NoInertia { time: 3.0, coordinate: "slider" };
        expect(ends!(&model, &start, &input, 3.0, [Rk4, DormandPrince, Radau]), &error);
        let radau = Integrator::adaptive(Radau, 1e-6, 1e-6);
        assert_eq!(radau.integrate(&model, 3.0, 4.0, &start, &input, |_, _| ()).unwrap_err(), error);
    }
}

/// The one that is free where the one beyond it stands still.
#[test]
fn the_function_of_the_mass_matrix_serves_as_well() {
    let (model, start) = (shown::Model::new(&shown::Params { light: 0.0 }), shown::State::default());
    let error = IntegrationError::NoInertia { time: 0.0, coordinate: "rail" };
    expect(ends!(&model, &start, &shown::Input { pull: 1.0 }, 0.0, [Rk4, DormandPrince, Radau]), &error);
}

#[test]
fn a_pose_without_inertia_names_its_coordinate() {
    let (model, start) = (spherical::Model::default(), spherical::State::default());
    for turned in [0.0, -1.0] {
        let input = spherical::Input { turned };
        let error = IntegrationError::NoInertia { time: -1.0, coordinate: "azimuth" };
        expect(ends!(&model, &start, &input, -1.0, [Rk4, DormandPrince, Radau]), &error);
    }
    let mut beside = spherical::State::default();
    beside.q.elevation = 0.1;
    assert_eq!(model.without_inertia(0.0, &beside, &spherical::Input::default()), None);
}

#[test]
fn a_pose_that_time_leads_to_names_its_coordinate() {
    let (model, start) = (led::Model::default(), led::State::default());
    let error = IntegrationError::NoInertia { time: 1.0, coordinate: "azimuth" };
    expect(ends!(&model, &start, &led::Input { turned: 1.0 }, 1.0, [Rk4, DormandPrince]), &error);
    // The last stage of the step stands there.
    let end = Rk4::integrate(&model, 0.0, &start, &led::Input { turned: 1.0 }, 0.25, 8, |_, _| ());
    assert_eq!(end.unwrap_err(), IntegrationError::NoInertia { time: 0.75, coordinate: "azimuth" });
}

#[test]
fn with_multipliers() {
    let model = hung::Model::new(&hung::Params { load: 0.0 });
    let mut start = hung::State::default();
    (start.q.pin, start.q.across) = (std::f64::consts::FRAC_PI_2, 0.75);
    let error = IntegrationError::NoInertia { time: 0.0, coordinate: "across" };
    expect(ends!(&model, &start, &(), 0.0, [Rk4, DormandPrince]), &error);
}

#[test]
fn what_overflows_is_no_lack_of_inertia() {
    let error = IntegrationError::NonFinite { time: 0.0 };
    let pull = f64::MAX;
    let (model, start) = (blocks::Model::default(), blocks::State::default());
    expect(ends!(&model, &start, &blocks::Input { pull: 4.0 * pull }, 0.0, [Rk4, DormandPrince]), &error);
    expect(ends!(&model, &start, &blocks::Input { pull }, 0.0, [Rk4, DormandPrince]), &error);
    expect(ends!(&model, &start, &blocks::Input { pull: f64::NAN }, 0.0, [Rk4, DormandPrince]), &error);
    let (model, start) = (shown::Model::default(), shown::State::default());
    expect(ends!(&model, &start, &shown::Input { pull }, 0.0, [Rk4, DormandPrince]), &error);
    let (model, start) = (solid::Model::default(), solid::State::default());
    expect(ends!(&model, &start, &solid::Input { pull }, 0.0, [Rk4, DormandPrince]), &error);
    // Parameters that are no numbers say nothing of inertia.
    let model = blocks::Model::new(&blocks::Params { light: f64::NAN });
    expect(ends!(&model, &blocks::State::default(), &blocks::Input { pull: 1.0 }, 0.0, [Rk4, DormandPrince]), &error);
}
