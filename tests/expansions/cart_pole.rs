/// A rod hinged to a cart that a force pushes.
///
/// ## Parameters
///
/// | field | unit | default |  |
/// |---|---|---|---|
/// | `g` | `m/s^2` | `9.81` | gravity |
/// | `mc` | `kg` | `1.0` | cart |
/// | `mp` | `kg` | `0.2` | pole |
/// | `l` | `m` | `0.8` | pole |
///
/// ## Coordinates
///
/// | joint | kind | parent | child | freedoms |  |
/// |---|---|---|---|---|---|
/// | `track` | prismatic | ground | `cart` | 1 |  |
/// | `hinge` | revolute | `cart` | `pole` | 1 |  |
///
/// ## Inputs
///
/// | field | unit | type |  |
/// |---|---|---|---|
/// | `push` | `N` | scalar | along +x |
///
/// ## Outputs
///
/// | field | unit | type |  |
/// |---|---|---|---|
/// | `tip` | `m` | vector | tip of the pole |
///
/// ## Bodies
///
/// | body | inertia |  |
/// |---|---|---|
/// | `cart` | point mass |  |
/// | `pole` | rigid body |  |
///
/// ## Functions
///
/// | function | method | operations | as derived |
/// |---|---|---|---|
/// | `new` |  | 1 add, 10 mul, 1 div |  |
/// | `forward_dynamics` | articulated body | 4 add, 11 mul, 1 div, 1 sincos | 6 add, 26 mul, 2 div, 1 sincos |
/// | `inverse_dynamics` | recursive Newton-Euler | 5 add, 10 mul, 1 sincos | 7 add, 19 mul, 1 sincos |
/// | `mass_matrix` | composite rigid body | 2 mul, 1 sincos | 2 add, 8 mul, 1 sincos |
/// | `bias` | recursive Newton-Euler | 1 add, 5 mul, 1 sincos | 1 add, 8 mul, 1 sincos |
/// | `kinetic_energy` | sum over links | 2 add, 7 mul, 1 sincos | 4 add, 14 mul, 1 sincos |
/// | `potential_energy` | first moment of mass, springs | 2 mul, 1 sincos | 4 mul, 1 sincos |
/// | `outputs` | world axes | 1 add, 2 mul, 1 sincos | 1 add, 2 mul, 1 sincos |
///
/// ## Defaults in force
///
/// - centre of mass at the body's origin: `cart`
pub mod cart_pole {
    use ::core::prelude::v1::*;
    use ::multibody::Real;
    /// Number of degrees of freedom: components of a velocity.
    pub const DOF: usize = 2;
    /// Parameters of `cart_pole`. The default is what the model declares.
    #[repr(C)]
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Params<T = f64> {
        /// `[m/s^2]` gravity
        ///
        /// Default: `9.81`
        pub g: T,
        /// `[kg]` cart
        ///
        /// Default: `1.0`
        pub mc: T,
        /// `[kg]` pole
        ///
        /// Default: `0.2`
        pub mp: T,
        /// `[m]` pole
        ///
        /// Default: `0.8`
        pub l: T,
    }
    /// Positions of the joints of `cart_pole`. The default is zero, or the identity.
    ///
    /// Components in order of declaration: 2.
    #[repr(C)]
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Position<T = f64> {
        /// `[m]` position of the prismatic joint
        pub track: T,
        /// `[rad]` position of the revolute joint
        pub hinge: T,
    }
    /// Velocities of `cart_pole`; accelerations and efforts have the same components.
    ///
    /// Components in order of declaration: 2.
    #[repr(C)]
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Velocity<T = f64> {
        /// `[m/s]` velocity of the prismatic joint
        pub track: T,
        /// `[rad/s]` velocity of the revolute joint
        pub hinge: T,
    }
    /// Inputs of `cart_pole`, held over a step. The default is zero.
    #[repr(C)]
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Input<T = f64> {
        /// `[N]` along +x
        pub push: T,
    }
    /// Outputs of `cart_pole`.
    #[repr(C)]
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Output<T = f64> {
        /// `[m]` tip of the pole
        pub tip: ::multibody::nalgebra::Vector3<T>,
    }
    impl<T: Real> Default for Params<T> {
        fn default() -> Self {
            Self {
                g: T::lit(9.81),
                mc: T::lit(1.0),
                mp: T::lit(0.2),
                l: T::lit(0.8),
            }
        }
    }
    impl<T: Real> Default for Position<T> {
        fn default() -> Self {
            Self {
                track: T::lit(0.0),
                hinge: T::lit(0.0),
            }
        }
    }
    impl<T: Real> Default for Velocity<T> {
        fn default() -> Self {
            Self {
                track: T::lit(0.0),
                hinge: T::lit(0.0),
            }
        }
    }
    impl<T: Real> Default for Input<T> {
        fn default() -> Self {
            Self { push: T::lit(0.0) }
        }
    }
    impl<T: Real> Default for Output<T> {
        fn default() -> Self {
            Self {
                tip: ::multibody::nalgebra::Vector3::zeros(),
            }
        }
    }
    impl<T: Real> Params<T> {
        /// Whether a mechanism can have these parameters: they are finite, masses, inertias and lengths are such as
        /// there are, the mass matrix is regular at the default position and loops with conditions have a solution
        /// there, and the scalar holds the numbers of the model.
        ///
        /// # Errors
        ///
        /// Names the first parameter, body, coordinate or number for which that is not so.
        pub fn check(&self) -> Result<(), ::multibody::ParamError> {
            let params = self;
            if !::multibody::all(Real::is_finite(params.g)) {
                return Err(::multibody::ParamError {
                    what: "`g` is not finite",
                });
            }
            if !::multibody::all(Real::is_finite(params.mc)) {
                return Err(::multibody::ParamError {
                    what: "`mc` is not finite",
                });
            }
            if !::multibody::all(Real::is_finite(params.mp)) {
                return Err(::multibody::ParamError {
                    what: "`mp` is not finite",
                });
            }
            if !::multibody::all(Real::is_finite(params.l)) {
                return Err(::multibody::ParamError {
                    what: "`l` is not finite",
                });
            }
            {
                let mass = params.mc;
                if !::multibody::all(
                    Real::ge(mass, T::lit(0.0)) & Real::is_finite(mass),
                ) {
                    return Err(::multibody::ParamError {
                        what: "the mass of `cart` is negative or not finite",
                    });
                }
            }
            {
                let mass = params.mp;
                if !::multibody::all(
                    Real::ge(mass, T::lit(0.0)) & Real::is_finite(mass),
                ) {
                    return Err(::multibody::ParamError {
                        what: "the mass of `pole` is negative or not finite",
                    });
                }
            }
            if ::multibody::any(
                ::multibody::inertia_violation(
                    params.mp * (params.l * params.l) / T::lit(12.0),
                    T::lit(0.0),
                    params.mp * (params.l * params.l) / T::lit(12.0),
                    T::lit(0.0),
                    T::lit(0.0),
                    T::lit(0.0),
                ),
            ) {
                return Err(::multibody::ParamError {
                    what: "no rigid body can have the inertia of `pole`",
                });
            }
            // Factorisation L^T D L.
            let mp_times_l = params.mp * params.l;
            let second_hinge_yy = T::lit(0.3333333333333333) * params.l * mp_times_l;
            let mass_track = params.mc + params.mp;
            let inverse_2 = T::lit(1.0) / second_hinge_yy;
            let pivot_1 = mass_track
                - T::lit(0.25) * mp_times_l * mp_times_l * inverse_2;
            if !::multibody::all(
                Real::gt(
                    second_hinge_yy,
                    T::lit(64.0) * T::epsilon() * (second_hinge_yy),
                ),
            ) {
                return Err(::multibody::ParamError {
                    what: "the mass matrix is singular at the default position: nothing resists `hinge`",
                });
            }
            if !::multibody::all(
                Real::gt(pivot_1, T::lit(64.0) * T::epsilon() * (mass_track)),
            ) {
                return Err(::multibody::ParamError {
                    what: "the mass matrix is singular at the default position: nothing resists `track`",
                });
            }
            Ok(())
        }
    }
    /// All that changes in time. Its default is every joint at zero, at rest.
    #[repr(C)]
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct State<T = f64> {
        /// positions
        pub q: Position<T>,
        /// velocities
        pub v: Velocity<T>,
    }
    impl<T: Real> Default for State<T> {
        fn default() -> Self {
            Self {
                q: Position::default(),
                v: Velocity::default(),
            }
        }
    }
    impl<T: Real> ::multibody::Tangent<T> for Velocity<T> {
        fn zero() -> Self {
            Self {
                track: ::multibody::Tangent::zero(),
                hinge: ::multibody::Tangent::zero(),
            }
        }
        fn zip<F: FnMut(T, T) -> T>(&self, other: &Self, f: &mut F) -> Self {
            Self {
                track: ::multibody::Tangent::zip(&self.track, &other.track, f),
                hinge: ::multibody::Tangent::zip(&self.hinge, &other.hinge, f),
            }
        }
        fn fold<A, F: FnMut(A, T) -> A>(&self, start: A, f: &mut F) -> A {
            let start = ::multibody::Tangent::fold(&self.track, start, f);
            ::multibody::Tangent::fold(&self.hinge, start, f)
        }
    }
    impl<T: Real> ::multibody::Configuration<T> for Position<T> {
        type Velocity = Velocity<T>;
        fn displace(&self, d: &Velocity<T>) -> Self {
            Self {
                track: ::multibody::Configuration::displace(&self.track, &d.track),
                hinge: ::multibody::Configuration::displace(&self.hinge, &d.hinge),
            }
        }
        fn advance(&self, d: &Velocity<T>, rest: &Velocity<T>) -> (Self, Velocity<T>) {
            let (mut end, mut left) = (*self, *rest);
            (end.track, left.track) = ::multibody::Configuration::advance(
                &self.track,
                &d.track,
                &rest.track,
            );
            (end.hinge, left.hinge) = ::multibody::Configuration::advance(
                &self.hinge,
                &d.hinge,
                &rest.hinge,
            );
            (end, left)
        }
        fn dexp_inv(_d: &Velocity<T>, v: &Velocity<T>) -> Velocity<T> {
            *v
        }
        fn magnitude(&self) -> Velocity<T> {
            Velocity {
                track: ::multibody::Configuration::magnitude(&self.track),
                hinge: ::multibody::Configuration::magnitude(&self.hinge),
            }
        }
    }
    impl<T: Real> ::multibody::StateSpace for State<T> {
        type Scalar = T;
        type Position = Position<T>;
        type Velocity = Velocity<T>;
        type Extra = ();
        fn split(&self) -> (Position<T>, Velocity<T>, ()) {
            (self.q, self.v, ())
        }
        fn join(&self, q: Position<T>, v: Velocity<T>, (): ()) -> Self {
            Self { q, v }
        }
    }
    impl<T: Real> ::multibody::Columns<T> for Params<T> {
        fn columns(
            &self,
            place: &::multibody::Column<'_>,
            f: &mut dyn FnMut(&::multibody::Column<'_>, T),
        ) {
            ::multibody::Columns::columns(&self.g, &place.field("g", "m/s^2"), f);
            ::multibody::Columns::columns(&self.mc, &place.field("mc", "kg"), f);
            ::multibody::Columns::columns(&self.mp, &place.field("mp", "kg"), f);
            ::multibody::Columns::columns(&self.l, &place.field("l", "m"), f);
        }
    }
    impl<T: Real> ::multibody::Columns<T> for Position<T> {
        fn columns(
            &self,
            place: &::multibody::Column<'_>,
            f: &mut dyn FnMut(&::multibody::Column<'_>, T),
        ) {
            ::multibody::Columns::columns(&self.track, &place.field("track", "m"), f);
            ::multibody::Columns::columns(&self.hinge, &place.field("hinge", "rad"), f);
        }
    }
    impl<T: Real> ::multibody::Columns<T> for Velocity<T> {
        fn columns(
            &self,
            place: &::multibody::Column<'_>,
            f: &mut dyn FnMut(&::multibody::Column<'_>, T),
        ) {
            ::multibody::Columns::columns(&self.track, &place.field("track", "m/s"), f);
            ::multibody::Columns::columns(
                &self.hinge,
                &place.field("hinge", "rad/s"),
                f,
            );
        }
    }
    impl<T: Real> ::multibody::Columns<T> for Input<T> {
        fn columns(
            &self,
            place: &::multibody::Column<'_>,
            f: &mut dyn FnMut(&::multibody::Column<'_>, T),
        ) {
            ::multibody::Columns::columns(&self.push, &place.field("push", "N"), f);
        }
    }
    impl<T: Real> ::multibody::Columns<T> for Output<T> {
        fn columns(
            &self,
            place: &::multibody::Column<'_>,
            f: &mut dyn FnMut(&::multibody::Column<'_>, T),
        ) {
            ::multibody::Columns::columns(&self.tip, &place.field("tip", "m"), f);
        }
    }
    impl<T: Real> ::multibody::Columns<T> for State<T> {
        fn columns(
            &self,
            place: &::multibody::Column<'_>,
            f: &mut dyn FnMut(&::multibody::Column<'_>, T),
        ) {
            ::multibody::Columns::columns(&self.q, &place.field("q", ""), f);
            ::multibody::Columns::columns(&self.v, &place.field("v", ""), f);
        }
    }
    impl<T: Real> From<Params<T>> for ::multibody::nalgebra::SVector<T, 4> {
        fn from(params: Params<T>) -> Self {
            Self::from([params.g, params.mc, params.mp, params.l])
        }
    }
    impl<T: Real> From<::multibody::nalgebra::SVector<T, 4>> for Params<T> {
        fn from(vector: ::multibody::nalgebra::SVector<T, 4>) -> Self {
            let [[g, mc, mp, l]] = vector.data.0;
            Params { g, mc, mp, l }
        }
    }
    impl<T: Real> From<Velocity<T>> for ::multibody::nalgebra::SVector<T, 2> {
        fn from(velocity: Velocity<T>) -> Self {
            Self::from([velocity.track, velocity.hinge])
        }
    }
    impl<T: Real> From<::multibody::nalgebra::SVector<T, 2>> for Velocity<T> {
        fn from(vector: ::multibody::nalgebra::SVector<T, 2>) -> Self {
            let [[track, hinge]] = vector.data.0;
            Velocity { track, hinge }
        }
    }
    impl<T: Real> From<Position<T>> for ::multibody::nalgebra::SVector<T, 2> {
        fn from(position: Position<T>) -> Self {
            Self::from([position.track, position.hinge])
        }
    }
    impl<T: Real> From<::multibody::nalgebra::SVector<T, 2>> for Position<T> {
        fn from(vector: ::multibody::nalgebra::SVector<T, 2>) -> Self {
            let [[track, hinge]] = vector.data.0;
            Position { track, hinge }
        }
    }
    impl<T: Real> From<Input<T>> for ::multibody::nalgebra::SVector<T, 1> {
        fn from(input: Input<T>) -> Self {
            Self::from([input.push])
        }
    }
    impl<T: Real> From<::multibody::nalgebra::SVector<T, 1>> for Input<T> {
        fn from(vector: ::multibody::nalgebra::SVector<T, 1>) -> Self {
            let [[push]] = vector.data.0;
            Input { push }
        }
    }
    impl<T: Real> From<State<T>> for ::multibody::nalgebra::SVector<T, 4> {
        fn from(state: State<T>) -> Self {
            Self::from([state.q.track, state.q.hinge, state.v.track, state.v.hinge])
        }
    }
    impl<T: Real> From<::multibody::nalgebra::SVector<T, 4>> for State<T> {
        fn from(vector: ::multibody::nalgebra::SVector<T, 4>) -> Self {
            let [[q_track, q_hinge, v_track, v_hinge]] = vector.data.0;
            State {
                q: Position {
                    track: q_track,
                    hinge: q_hinge,
                },
                v: Velocity {
                    track: v_track,
                    hinge: v_hinge,
                },
            }
        }
    }
    /// The equations of motion of `cart_pole`. It holds the 12 values that depend on parameters alone.
    #[repr(C)]
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Model<T = f64> {
        /// `0.75 * mp`
        pivot_1_factor: T,
        /// `mp + mc`
        mass_track: T,
        /// `mp * l * g`
        acceleration_2_factor: T,
        /// `0.75 / l`
        rest_1_factor: T,
        /// `0.5 * mp * l`
        half_mp_times_l: T,
        /// `1.5 / (l^2 * mp)`
        acceleration_2_factor_v2: T,
        /// `1.5 / l`
        acceleration_2_factor_v3: T,
        /// `g`
        g: T,
        /// `1 / 3 * l^2 * mp`
        n_hinge_z_factor: T,
        /// `mp * l`
        second_hinge_yy_factor: T,
        /// `l^2 * mp`
        l_times_mp_times_l: T,
        /// `l`
        l: T,
    }
    impl<T: Real> Model<T> {
        /// Does the work that depends on parameters alone.
        ///
        /// Operations: 1 add, 10 mul, 1 div.
        #[must_use]
        pub fn new(params: &Params<T>) -> Self {
            let mass_track = params.mp + params.mc;
            let second_hinge_yy_factor = params.mp * params.l;
            let l_times_mp_times_l = params.l * second_hinge_yy_factor;
            let inverse_2_with_l = T::lit(1.0) / l_times_mp_times_l;
            let rest_1_factor_with_second_hinge_yy_factor = second_hinge_yy_factor
                * inverse_2_with_l;
            Self {
                pivot_1_factor: T::lit(0.75) * params.mp,
                mass_track,
                acceleration_2_factor: second_hinge_yy_factor * params.g,
                rest_1_factor: T::lit(0.75) * rest_1_factor_with_second_hinge_yy_factor,
                half_mp_times_l: T::lit(0.5) * second_hinge_yy_factor,
                acceleration_2_factor_v2: T::lit(1.5) * inverse_2_with_l,
                acceleration_2_factor_v3: T::lit(1.5)
                    * rest_1_factor_with_second_hinge_yy_factor,
                g: params.g,
                n_hinge_z_factor: T::lit(0.3333333333333333) * l_times_mp_times_l,
                second_hinge_yy_factor,
                l_times_mp_times_l,
                l: params.l,
            }
        }
        /// Accelerations.
        ///
        /// Method: articulated body.
        ///
        /// Operations: 4 add, 11 mul, 1 div, 1 sincos; as derived, before optimisation: 6 add, 26 mul, 2 div, 1 sincos.
        #[must_use]
        pub fn forward_dynamics(
            &self,
            _t: T,
            state: &State<T>,
            input: &Input<T>,
        ) -> Velocity<T> {
            let q = &state.q;
            let v = &state.v;
            // Articulated inertia of track.
            let (sin_hinge, cos_hinge) = Real::sin_cos(q.hinge);
            let pivot_1 = self.mass_track - cos_hinge * cos_hinge * self.pivot_1_factor;
            let sin_hinge_times_acceleration_2_factor = sin_hinge
                * self.acceleration_2_factor;
            let acceleration_1 = (input.push
                + cos_hinge * sin_hinge_times_acceleration_2_factor * self.rest_1_factor
                - v.hinge * v.hinge * sin_hinge * self.half_mp_times_l) / pivot_1;
            // Acceleration of hinge.
            let acceleration_2 = sin_hinge_times_acceleration_2_factor
                * self.acceleration_2_factor_v2
                + cos_hinge * acceleration_1 * self.acceleration_2_factor_v3;
            Velocity {
                track: acceleration_1,
                hinge: acceleration_2,
            }
        }
        /// Efforts that the accelerations `accel` need beside all declared forces.
        ///
        /// Method: recursive Newton-Euler.
        ///
        /// Operations: 5 add, 10 mul, 1 sincos; as derived, before optimisation: 7 add, 19 mul, 1 sincos.
        #[must_use]
        pub fn inverse_dynamics(
            &self,
            _t: T,
            state: &State<T>,
            input: &Input<T>,
            accel: &Velocity<T>,
        ) -> Velocity<T> {
            let q = &state.q;
            let v = &state.v;
            // Force and moment through hinge.
            let (sin_hinge, cos_hinge) = Real::sin_cos(q.hinge);
            let a_hinge_x = accel.track * cos_hinge + self.g * sin_hinge;
            let minus_n_hinge_z = a_hinge_x * self.half_mp_times_l
                - accel.hinge * self.n_hinge_z_factor;
            Velocity {
                track: -(input.push - accel.track * self.mass_track
                    + accel.hinge * cos_hinge * self.half_mp_times_l
                    - v.hinge * v.hinge * sin_hinge * self.half_mp_times_l),
                hinge: -minus_n_hinge_z,
            }
        }
        /// Mass matrix `M` of `M * accel + bias = effort`.
        ///
        /// Method: composite rigid body.
        ///
        /// Operations: 2 mul, 1 sincos; as derived, before optimisation: 2 add, 8 mul, 1 sincos.
        #[must_use]
        pub fn mass_matrix(
            &self,
            q: &Position<T>,
        ) -> ::multibody::nalgebra::SMatrix<T, 2, 2> {
            // Mass matrix.
            let (_, cos_hinge) = Real::sin_cos(q.hinge);
            let minus_m_1_2 = T::lit(0.5) * self.second_hinge_yy_factor * cos_hinge;
            ::multibody::nalgebra::SMatrix::from([
                [self.mass_track, -minus_m_1_2],
                [-minus_m_1_2, (T::lit(0.3333333333333333) * self.l_times_mp_times_l)],
            ])
        }
        /// The efforts at zero acceleration, `bias` of `M * accel + bias = effort`; declared forces and gravity are in it.
        ///
        /// Method: recursive Newton-Euler.
        ///
        /// Operations: 1 add, 5 mul, 1 sincos; as derived, before optimisation: 1 add, 8 mul, 1 sincos.
        #[must_use]
        pub fn bias(
            &self,
            _t: T,
            state: &State<T>,
            input: &Input<T>,
        ) -> ::multibody::nalgebra::SVector<T, 2> {
            let q = &state.q;
            let v = &state.v;
            // Results.
            let (sin_hinge, _) = Real::sin_cos(q.hinge);
            ::multibody::nalgebra::SVector::from([
                -(input.push - v.hinge * v.hinge * sin_hinge * self.half_mp_times_l),
                (T::lit(-0.5) * sin_hinge * self.acceleration_2_factor),
            ])
        }
        /// `[J]` Kinetic energy of all bodies.
        ///
        /// Method: sum over links.
        ///
        /// Operations: 2 add, 7 mul, 1 sincos; as derived, before optimisation: 4 add, 14 mul, 1 sincos.
        #[must_use]
        pub fn kinetic_energy(&self, state: &State<T>) -> T {
            let q = &state.q;
            let v = &state.v;
            let (_, cos_hinge) = Real::sin_cos(q.hinge);
            T::lit(0.5)
                * (v.hinge * v.hinge * self.n_hinge_z_factor
                    + v.track
                        * (v.track * self.mass_track
                            - v.hinge * self.second_hinge_yy_factor * cos_hinge))
        }
        /// `[J]` Potential energy: gravity's, zero at the world's origin, plus the springs'.
        ///
        /// Method: first moment of mass, springs.
        ///
        /// Operations: 2 mul, 1 sincos; as derived, before optimisation: 4 mul, 1 sincos.
        #[must_use]
        pub fn potential_energy(&self, q: &Position<T>) -> T {
            let (_, cos_hinge) = Real::sin_cos(q.hinge);
            T::lit(0.5) * cos_hinge * self.acceleration_2_factor
        }
        /// Outputs.
        ///
        /// Method: world axes.
        ///
        /// Operations: 1 add, 2 mul, 1 sincos; as derived, before optimisation: 1 add, 2 mul, 1 sincos.
        #[must_use]
        pub fn outputs(&self, _t: T, state: &State<T>, _input: &Input<T>) -> Output<T> {
            let q = &state.q;
            // Results.
            let (sin_hinge, cos_hinge) = Real::sin_cos(q.hinge);
            Output {
                tip: ::multibody::nalgebra::Vector3::from([
                    (q.track - self.l * sin_hinge),
                    (self.l * cos_hinge),
                    T::lit(0.0),
                ]),
            }
        }
    }
    impl<T: Real> Default for Model<T> {
        fn default() -> Self {
            Self::new(&Params::default())
        }
    }
    impl<T: Real> Model<T> {
        /// Not derived: `emit residual` in the model asks for it.
        #[doc(hidden)]
        #[must_use]
        pub fn residual<A: ::multibody::emitted::Residual>(
            &self,
            _t: T,
            _state: &A,
            _input: &Input<T>,
            _accel: &Velocity<T>,
            _multipliers: &::multibody::nalgebra::SVector<T, 0>,
        ) -> A::Result {
            A::never()
        }
        /// Not derived: `emit kinematics { given: .., find: .. }` in the model asks for it.
        #[doc(hidden)]
        #[must_use]
        pub fn kinematics<A: ::multibody::emitted::Kinematics>(
            &self,
            _t: T,
            _state: &A,
            _accel: &Velocity<T>,
        ) -> A::Result {
            A::never()
        }
        /// Not derived: `emit assembly_modes { given: .., find: .. }` in the model asks for it.
        #[doc(hidden)]
        #[must_use]
        pub fn assembly_modes<A: ::multibody::emitted::AssemblyModes>(
            &self,
            _t: T,
            _q: &A,
        ) -> A::Result {
            A::never()
        }
        /// Not derived: `emit derivatives` in the model asks for it.
        #[doc(hidden)]
        #[must_use]
        pub fn forward_derivatives<A: ::multibody::emitted::Derivatives>(
            &self,
            _t: T,
            _state: &A,
            _input: &Input<T>,
        ) -> A::Result {
            A::never()
        }
        /// Not derived: `emit derivatives` in the model asks for it.
        #[doc(hidden)]
        #[must_use]
        pub fn inverse_derivatives<A: ::multibody::emitted::Derivatives>(
            &self,
            _t: T,
            _state: &A,
            _input: &Input<T>,
            _accel: &Velocity<T>,
        ) -> A::Result {
            A::never()
        }
        /// Not derived: `emit linearize` in the model asks for it.
        #[doc(hidden)]
        #[must_use]
        pub fn linearize<A: ::multibody::emitted::Linearize>(
            &self,
            _t: T,
            _state: &A,
            _input: &Input<T>,
        ) -> A::Result {
            A::never()
        }
        /// Not derived: `emit impulse` in the model asks for it.
        #[doc(hidden)]
        #[must_use]
        pub fn impulse<A: ::multibody::emitted::Impulse>(
            &self,
            _q: &A,
            _impulse: &Velocity<T>,
        ) -> A::Result {
            A::never()
        }
        /// Not derived: `emit momentum` in the model asks for it.
        #[doc(hidden)]
        #[must_use]
        pub fn momentum<A: ::multibody::emitted::Momentum>(
            &self,
            _state: &A,
        ) -> A::Result {
            A::never()
        }
        /// Not derived: `emit momentum` in the model asks for it.
        #[doc(hidden)]
        #[must_use]
        pub fn momentum_rate<A: ::multibody::emitted::Momentum>(
            &self,
            _t: T,
            _state: &A,
            _input: &Input<T>,
        ) -> A::Result {
            A::never()
        }
        /// Not derived: `emit momentum` in the model asks for it.
        #[doc(hidden)]
        #[must_use]
        pub fn velocity<A: ::multibody::emitted::Momentum>(
            &self,
            _q: &A,
            _momentum: &Velocity<T>,
        ) -> A::Result {
            A::never()
        }
    }
    impl<T: Real> ::multibody::System for Model<T> {
        type Scalar = T;
        type State = State<T>;
        type Input = Input<T>;
        fn derivative(
            &self,
            t: T,
            state: &State<T>,
            input: &Input<T>,
        ) -> (Velocity<T>, ()) {
            (self.forward_dynamics(t, state, input), ())
        }
        fn position_rates(&self, _t: T, state: &State<T>) -> Velocity<T> {
            state.v
        }
        fn without_inertia(
            &self,
            _t: T,
            state: &State<T>,
            _input: &Input<T>,
        ) -> Option<&'static str> {
            let matrix = self.mass_matrix(&state.q);
            ::multibody::pivots::without_inertia(&matrix, &["track", "hinge"])
        }
    }
    impl<T: Real> ::multibody::Verifiable<2> for Model<T> {
        fn free_motion(
            &self,
            t: T,
            state: &State<T>,
            input: &Input<T>,
        ) -> (
            ::multibody::nalgebra::SVector<T, 2>,
            ::multibody::nalgebra::SVector<T, 2>,
        ) {
            (
                self.forward_dynamics(t, state, input).into(),
                ::multibody::nalgebra::SVector::zeros(),
            )
        }
        fn efforts(
            &self,
            t: T,
            state: &State<T>,
            input: &Input<T>,
            accelerations: &::multibody::nalgebra::SVector<T, 2>,
        ) -> ::multibody::nalgebra::SVector<T, 2> {
            self.inverse_dynamics(t, state, input, &(*accelerations).into()).into()
        }
        fn inertia(
            &self,
            _t: T,
            state: &State<T>,
            _input: &Input<T>,
        ) -> ::multibody::nalgebra::SMatrix<T, 2, 2> {
            {
                let state = &state.q;
                self.mass_matrix(state)
            }
        }
        fn kinetic(&self, _t: T, state: &State<T>, _input: &Input<T>) -> T {
            self.kinetic_energy(state)
        }
    }
    /// Names of the components of a velocity, in order.
    pub const COORDINATES: &[&str] = &["track", "hinge"];
    /// Operation counts of every function, and of `Model::new`.
    pub const COSTS: &[::multibody::Cost] = &[
        ::multibody::Cost {
            function: "new",
            add: 1,
            mul: 10,
            div: 1,
            sqrt: 0,
            sincos: 0,
            other: 0,
        },
        ::multibody::Cost {
            function: "forward_dynamics",
            add: 4,
            mul: 11,
            div: 1,
            sqrt: 0,
            sincos: 1,
            other: 0,
        },
        ::multibody::Cost {
            function: "inverse_dynamics",
            add: 5,
            mul: 10,
            div: 0,
            sqrt: 0,
            sincos: 1,
            other: 0,
        },
        ::multibody::Cost {
            function: "mass_matrix",
            add: 0,
            mul: 2,
            div: 0,
            sqrt: 0,
            sincos: 1,
            other: 0,
        },
        ::multibody::Cost {
            function: "bias",
            add: 1,
            mul: 5,
            div: 0,
            sqrt: 0,
            sincos: 1,
            other: 0,
        },
        ::multibody::Cost {
            function: "kinetic_energy",
            add: 2,
            mul: 7,
            div: 0,
            sqrt: 0,
            sincos: 1,
            other: 0,
        },
        ::multibody::Cost {
            function: "potential_energy",
            add: 0,
            mul: 2,
            div: 0,
            sqrt: 0,
            sincos: 1,
            other: 0,
        },
        ::multibody::Cost {
            function: "outputs",
            add: 1,
            mul: 2,
            div: 0,
            sqrt: 0,
            sincos: 1,
            other: 0,
        },
    ];
    /// The same of every function as it was derived, before optimisation, with the work on parameters in it.
    pub const DERIVED: &[::multibody::Cost] = &[
        ::multibody::Cost {
            function: "forward_dynamics",
            add: 6,
            mul: 26,
            div: 2,
            sqrt: 0,
            sincos: 1,
            other: 0,
        },
        ::multibody::Cost {
            function: "inverse_dynamics",
            add: 7,
            mul: 19,
            div: 0,
            sqrt: 0,
            sincos: 1,
            other: 0,
        },
        ::multibody::Cost {
            function: "mass_matrix",
            add: 2,
            mul: 8,
            div: 0,
            sqrt: 0,
            sincos: 1,
            other: 0,
        },
        ::multibody::Cost {
            function: "bias",
            add: 1,
            mul: 8,
            div: 0,
            sqrt: 0,
            sincos: 1,
            other: 0,
        },
        ::multibody::Cost {
            function: "kinetic_energy",
            add: 4,
            mul: 14,
            div: 0,
            sqrt: 0,
            sincos: 1,
            other: 0,
        },
        ::multibody::Cost {
            function: "potential_energy",
            add: 0,
            mul: 4,
            div: 0,
            sqrt: 0,
            sincos: 1,
            other: 0,
        },
        ::multibody::Cost {
            function: "outputs",
            add: 1,
            mul: 2,
            div: 0,
            sqrt: 0,
            sincos: 1,
            other: 0,
        },
    ];
}
