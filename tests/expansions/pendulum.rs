/// A rod on a hinge.
///
/// ## Parameters
///
/// | field | unit | default |  |
/// |---|---|---|---|
/// | `g` | `m/s^2` | `9.81` | gravity |
/// | `m` | `kg` | `2.0` | mass |
/// | `l` | `m` | `1.5` | length |
///
/// ## Coordinates
///
/// | joint | kind | parent | child | freedoms |  |
/// |---|---|---|---|---|---|
/// | `hinge` | revolute | ground | `bob` | 1 |  |
///
/// ## Bodies
///
/// | body | inertia |  |
/// |---|---|---|
/// | `bob` | rigid body |  |
///
/// ## Functions
///
/// | function | method | operations | as derived |
/// |---|---|---|---|
/// | `new` |  | 6 mul, 1 div |  |
/// | `forward_dynamics` | composite rigid body, LDL^T | 2 mul, 1 sincos | 1 add, 10 mul, 1 div, 1 sincos |
/// | `inverse_dynamics` | recursive Newton-Euler | 1 add, 2 mul, 1 sincos | 2 add, 10 mul, 1 sincos |
/// | `mass_matrix` | composite rigid body | none | 1 add, 6 mul |
/// | `bias` | recursive Newton-Euler | 2 mul, 1 sincos | 4 mul, 1 sincos |
/// | `kinetic_energy` | sum over links | 3 mul | 1 add, 9 mul |
/// | `potential_energy` | first moment of mass, springs | 2 mul, 1 sincos | 4 mul, 1 sincos |
///
/// Accelerations do not depend on velocities: the model is `Separable`.
pub mod pendulum {
    use ::core::prelude::v1::*;
    use ::multibody::Real;
    /// Number of degrees of freedom: components of a velocity.
    pub const DOF: usize = 1;
    /// Parameters of `pendulum`. The default is what the model declares.
    #[repr(C)]
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Params<T = f64> {
        /// `[m/s^2]` gravity
        ///
        /// Default: `9.81`
        pub g: T,
        /// `[kg]` mass
        ///
        /// Default: `2.0`
        pub m: T,
        /// `[m]` length
        ///
        /// Default: `1.5`
        pub l: T,
    }
    /// Positions of the joints of `pendulum`. The default is zero, or the identity.
    ///
    /// Components in order of declaration: 1.
    #[repr(C)]
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Position<T = f64> {
        /// `[rad]` position of the revolute joint
        pub hinge: T,
    }
    /// Velocities of `pendulum`; accelerations and efforts have the same components.
    ///
    /// Components in order of declaration: 1.
    #[repr(C)]
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Velocity<T = f64> {
        /// `[rad/s]` velocity of the revolute joint
        pub hinge: T,
    }
    /// The model has no inputs.
    pub type Input = ();
    impl<T: Real> Default for Params<T> {
        fn default() -> Self {
            Self {
                g: T::lit(9.81),
                m: T::lit(2.0),
                l: T::lit(1.5),
            }
        }
    }
    impl<T: Real> Default for Position<T> {
        fn default() -> Self {
            Self { hinge: T::lit(0.0) }
        }
    }
    impl<T: Real> Default for Velocity<T> {
        fn default() -> Self {
            Self { hinge: T::lit(0.0) }
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
            if !::multibody::all(Real::is_finite(params.m)) {
                return Err(::multibody::ParamError {
                    what: "`m` is not finite",
                });
            }
            if !::multibody::all(Real::is_finite(params.l)) {
                return Err(::multibody::ParamError {
                    what: "`l` is not finite",
                });
            }
            {
                let mass = params.m;
                if !::multibody::all(
                    Real::ge(mass, T::lit(0.0)) & Real::is_finite(mass),
                ) {
                    return Err(::multibody::ParamError {
                        what: "the mass of `bob` is negative or not finite",
                    });
                }
            }
            if ::multibody::any(
                ::multibody::inertia_violation(
                    params.m * (params.l * params.l) / T::lit(12.0),
                    T::lit(0.0),
                    params.m * (params.l * params.l) / T::lit(12.0),
                    T::lit(0.0),
                    T::lit(0.0),
                    T::lit(0.0),
                ),
            ) {
                return Err(::multibody::ParamError {
                    what: "no rigid body can have the inertia of `bob`",
                });
            }
            let second_hinge_yy = T::lit(0.3333333333333333) * params.m * params.l
                * params.l;
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
                hinge: ::multibody::Tangent::zero(),
            }
        }
        fn zip<F: FnMut(T, T) -> T>(&self, other: &Self, f: &mut F) -> Self {
            Self {
                hinge: ::multibody::Tangent::zip(&self.hinge, &other.hinge, f),
            }
        }
        fn fold<A, F: FnMut(A, T) -> A>(&self, start: A, f: &mut F) -> A {
            ::multibody::Tangent::fold(&self.hinge, start, f)
        }
    }
    impl<T: Real> ::multibody::Configuration<T> for Position<T> {
        type Velocity = Velocity<T>;
        fn displace(&self, d: &Velocity<T>) -> Self {
            Self {
                hinge: ::multibody::Configuration::displace(&self.hinge, &d.hinge),
            }
        }
        fn advance(&self, d: &Velocity<T>, rest: &Velocity<T>) -> (Self, Velocity<T>) {
            let (mut end, mut left) = (*self, *rest);
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
            ::multibody::Columns::columns(&self.m, &place.field("m", "kg"), f);
            ::multibody::Columns::columns(&self.l, &place.field("l", "m"), f);
        }
    }
    impl<T: Real> ::multibody::Columns<T> for Position<T> {
        fn columns(
            &self,
            place: &::multibody::Column<'_>,
            f: &mut dyn FnMut(&::multibody::Column<'_>, T),
        ) {
            ::multibody::Columns::columns(&self.hinge, &place.field("hinge", "rad"), f);
        }
    }
    impl<T: Real> ::multibody::Columns<T> for Velocity<T> {
        fn columns(
            &self,
            place: &::multibody::Column<'_>,
            f: &mut dyn FnMut(&::multibody::Column<'_>, T),
        ) {
            ::multibody::Columns::columns(
                &self.hinge,
                &place.field("hinge", "rad/s"),
                f,
            );
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
    impl<T: Real> From<Params<T>> for ::multibody::nalgebra::SVector<T, 3> {
        fn from(params: Params<T>) -> Self {
            Self::from([params.g, params.m, params.l])
        }
    }
    impl<T: Real> From<::multibody::nalgebra::SVector<T, 3>> for Params<T> {
        fn from(vector: ::multibody::nalgebra::SVector<T, 3>) -> Self {
            let [[g, m, l]] = vector.data.0;
            Params { g, m, l }
        }
    }
    impl<T: Real> From<Velocity<T>> for ::multibody::nalgebra::SVector<T, 1> {
        fn from(velocity: Velocity<T>) -> Self {
            Self::from([velocity.hinge])
        }
    }
    impl<T: Real> From<::multibody::nalgebra::SVector<T, 1>> for Velocity<T> {
        fn from(vector: ::multibody::nalgebra::SVector<T, 1>) -> Self {
            let [[hinge]] = vector.data.0;
            Velocity { hinge }
        }
    }
    impl<T: Real> From<Position<T>> for ::multibody::nalgebra::SVector<T, 1> {
        fn from(position: Position<T>) -> Self {
            Self::from([position.hinge])
        }
    }
    impl<T: Real> From<::multibody::nalgebra::SVector<T, 1>> for Position<T> {
        fn from(vector: ::multibody::nalgebra::SVector<T, 1>) -> Self {
            let [[hinge]] = vector.data.0;
            Position { hinge }
        }
    }
    impl<T: Real> From<State<T>> for ::multibody::nalgebra::SVector<T, 2> {
        fn from(state: State<T>) -> Self {
            Self::from([state.q.hinge, state.v.hinge])
        }
    }
    impl<T: Real> From<::multibody::nalgebra::SVector<T, 2>> for State<T> {
        fn from(vector: ::multibody::nalgebra::SVector<T, 2>) -> Self {
            let [[q_hinge, v_hinge]] = vector.data.0;
            State {
                q: Position { hinge: q_hinge },
                v: Velocity { hinge: v_hinge },
            }
        }
    }
    /// The equations of motion of `pendulum`. It holds the 5 values that depend on parameters alone.
    #[repr(C)]
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Model<T = f64> {
        /// `g / l`
        hinge_accel_factor: T,
        /// `0.5 * g * m * l`
        n_hinge_z_factor: T,
        /// `1 / 3 * l^2 * m`
        n_hinge_z_factor_v2: T,
        /// `l^2 * m`
        second_hinge_yy_factor: T,
        /// `g * m * l`
        g_times_m_times_l: T,
    }
    impl<T: Real> Model<T> {
        /// Does the work that depends on parameters alone.
        ///
        /// Operations: 6 mul, 1 div.
        #[must_use]
        pub fn new(params: &Params<T>) -> Self {
            let m_times_l = params.m * params.l;
            let second_hinge_yy_factor = params.l * m_times_l;
            let g_times_m_times_l = params.g * m_times_l;
            Self {
                hinge_accel_factor: T::lit(1.0) / second_hinge_yy_factor
                    * g_times_m_times_l,
                n_hinge_z_factor: T::lit(0.5) * g_times_m_times_l,
                n_hinge_z_factor_v2: T::lit(0.3333333333333333) * second_hinge_yy_factor,
                second_hinge_yy_factor,
                g_times_m_times_l,
            }
        }
        /// Accelerations.
        ///
        /// Method: composite rigid body, LDL^T.
        ///
        /// Operations: 2 mul, 1 sincos; as derived, before optimisation: 1 add, 10 mul, 1 div, 1 sincos.
        #[must_use]
        pub fn forward_dynamics(
            &self,
            _t: T,
            state: &State<T>,
            _input: &(),
        ) -> Velocity<T> {
            let q = &state.q;
            let (sin_hinge, _) = Real::sin_cos(q.hinge);
            Velocity {
                hinge: T::lit(-1.5) * sin_hinge * self.hinge_accel_factor,
            }
        }
        /// Efforts that the accelerations `accel` need beside all declared forces.
        ///
        /// Method: recursive Newton-Euler.
        ///
        /// Operations: 1 add, 2 mul, 1 sincos; as derived, before optimisation: 2 add, 10 mul, 1 sincos.
        #[must_use]
        pub fn inverse_dynamics(
            &self,
            _t: T,
            state: &State<T>,
            _input: &(),
            accel: &Velocity<T>,
        ) -> Velocity<T> {
            let q = &state.q;
            // Force and moment through hinge.
            let (sin_hinge, _) = Real::sin_cos(q.hinge);
            Velocity {
                hinge: sin_hinge * self.n_hinge_z_factor
                    + accel.hinge * self.n_hinge_z_factor_v2,
            }
        }
        /// Mass matrix `M` of `M * accel + bias = effort`.
        ///
        /// Method: composite rigid body.
        ///
        /// Operations: none; as derived, before optimisation: 1 add, 6 mul.
        #[must_use]
        pub fn mass_matrix(
            &self,
            _q: &Position<T>,
        ) -> ::multibody::nalgebra::SMatrix<T, 1, 1> {
            ::multibody::nalgebra::SMatrix::from([
                [(T::lit(0.3333333333333333) * self.second_hinge_yy_factor)],
            ])
        }
        /// The efforts at zero acceleration, `bias` of `M * accel + bias = effort`; declared forces and gravity are in it.
        ///
        /// Method: recursive Newton-Euler.
        ///
        /// Operations: 2 mul, 1 sincos; as derived, before optimisation: 4 mul, 1 sincos.
        #[must_use]
        pub fn bias(
            &self,
            _t: T,
            state: &State<T>,
            _input: &(),
        ) -> ::multibody::nalgebra::SVector<T, 1> {
            let q = &state.q;
            let (sin_hinge, _) = Real::sin_cos(q.hinge);
            ::multibody::nalgebra::SVector::from([
                (T::lit(0.5) * sin_hinge * self.g_times_m_times_l),
            ])
        }
        /// `[J]` Kinetic energy of all bodies.
        ///
        /// Method: sum over links.
        ///
        /// Operations: 3 mul; as derived, before optimisation: 1 add, 9 mul.
        #[must_use]
        pub fn kinetic_energy(&self, state: &State<T>) -> T {
            let v = &state.v;
            T::lit(0.16666666666666666) * v.hinge * v.hinge * self.second_hinge_yy_factor
        }
        /// `[J]` Potential energy: gravity's, zero at the world's origin, plus the springs'.
        ///
        /// Method: first moment of mass, springs.
        ///
        /// Operations: 2 mul, 1 sincos; as derived, before optimisation: 4 mul, 1 sincos.
        #[must_use]
        pub fn potential_energy(&self, q: &Position<T>) -> T {
            let (_, cos_hinge) = Real::sin_cos(q.hinge);
            T::lit(-0.5) * cos_hinge * self.g_times_m_times_l
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
            _input: &(),
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
            _input: &(),
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
            _input: &(),
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
            _input: &(),
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
            _input: &(),
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
        /// The model has no `output`.
        #[doc(hidden)]
        #[must_use]
        pub fn outputs<A: ::multibody::emitted::Outputs>(
            &self,
            _t: T,
            _state: &A,
            _input: &(),
        ) -> A::Result {
            A::never()
        }
    }
    impl<T: Real> ::multibody::System for Model<T> {
        type Scalar = T;
        type State = State<T>;
        type Input = ();
        fn derivative(&self, t: T, state: &State<T>, input: &()) -> (Velocity<T>, ()) {
            (self.forward_dynamics(t, state, input), ())
        }
        fn position_rates(&self, _t: T, state: &State<T>) -> Velocity<T> {
            state.v
        }
        fn without_inertia(
            &self,
            _t: T,
            state: &State<T>,
            _input: &(),
        ) -> Option<&'static str> {
            let matrix = self.mass_matrix(&state.q);
            ::multibody::pivots::without_inertia(&matrix, &["hinge"])
        }
    }
    impl<T: Real> ::multibody::Separable for Model<T> {}
    impl<T: Real> ::multibody::Verifiable<1> for Model<T> {
        fn free_motion(
            &self,
            t: T,
            state: &State<T>,
            input: &(),
        ) -> (
            ::multibody::nalgebra::SVector<T, 1>,
            ::multibody::nalgebra::SVector<T, 1>,
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
            input: &(),
            accelerations: &::multibody::nalgebra::SVector<T, 1>,
        ) -> ::multibody::nalgebra::SVector<T, 1> {
            self.inverse_dynamics(t, state, input, &(*accelerations).into()).into()
        }
        fn inertia(
            &self,
            _t: T,
            state: &State<T>,
            _input: &(),
        ) -> ::multibody::nalgebra::SMatrix<T, 1, 1> {
            {
                let state = &state.q;
                self.mass_matrix(state)
            }
        }
        fn kinetic(&self, _t: T, state: &State<T>, _input: &()) -> T {
            self.kinetic_energy(state)
        }
    }
    /// Names of the components of a velocity, in order.
    pub const COORDINATES: &[&str] = &["hinge"];
    /// Operation counts of every function, and of `Model::new`.
    pub const COSTS: &[::multibody::Cost] = &[
        ::multibody::Cost {
            function: "new",
            add: 0,
            mul: 6,
            div: 1,
            sqrt: 0,
            sincos: 0,
            other: 0,
        },
        ::multibody::Cost {
            function: "forward_dynamics",
            add: 0,
            mul: 2,
            div: 0,
            sqrt: 0,
            sincos: 1,
            other: 0,
        },
        ::multibody::Cost {
            function: "inverse_dynamics",
            add: 1,
            mul: 2,
            div: 0,
            sqrt: 0,
            sincos: 1,
            other: 0,
        },
        ::multibody::Cost {
            function: "mass_matrix",
            add: 0,
            mul: 0,
            div: 0,
            sqrt: 0,
            sincos: 0,
            other: 0,
        },
        ::multibody::Cost {
            function: "bias",
            add: 0,
            mul: 2,
            div: 0,
            sqrt: 0,
            sincos: 1,
            other: 0,
        },
        ::multibody::Cost {
            function: "kinetic_energy",
            add: 0,
            mul: 3,
            div: 0,
            sqrt: 0,
            sincos: 0,
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
    ];
    /// The same of every function as it was derived, before optimisation, with the work on parameters in it.
    pub const DERIVED: &[::multibody::Cost] = &[
        ::multibody::Cost {
            function: "forward_dynamics",
            add: 1,
            mul: 10,
            div: 1,
            sqrt: 0,
            sincos: 1,
            other: 0,
        },
        ::multibody::Cost {
            function: "inverse_dynamics",
            add: 2,
            mul: 10,
            div: 0,
            sqrt: 0,
            sincos: 1,
            other: 0,
        },
        ::multibody::Cost {
            function: "mass_matrix",
            add: 1,
            mul: 6,
            div: 0,
            sqrt: 0,
            sincos: 0,
            other: 0,
        },
        ::multibody::Cost {
            function: "bias",
            add: 0,
            mul: 4,
            div: 0,
            sqrt: 0,
            sincos: 1,
            other: 0,
        },
        ::multibody::Cost {
            function: "kinetic_energy",
            add: 1,
            mul: 9,
            div: 0,
            sqrt: 0,
            sincos: 0,
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
    ];
}
