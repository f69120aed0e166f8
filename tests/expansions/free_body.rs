/// A free rigid body, no gravity.
///
/// ## Parameters
///
/// | field | unit | default |  |
/// |---|---|---|---|
/// | `m` | `kg` | `1.0` | mass |
/// | `i` | `kg m^2` | `[1.0, 2.0, 3.0]` | principal moments |
///
/// ## Coordinates
///
/// | joint | kind | parent | child | freedoms |  |
/// |---|---|---|---|---|---|
/// | `free` | free | ground | `nut` | 6 |  |
///
/// ## Bodies
///
/// | body | inertia |  |
/// |---|---|---|
/// | `nut` | rigid body |  |
///
/// ## Functions
///
/// | function | method | operations | as derived |
/// |---|---|---|---|
/// | `new` |  | 8 add, 6 mul, 3 div |  |
/// | `forward_dynamics` | composite rigid body, LDL^T | 6 mul | 8 add, 13 mul, 3 div |
/// | `inverse_dynamics` | recursive Newton-Euler | 9 add, 12 mul | 14 add, 13 mul |
/// | `mass_matrix` | composite rigid body | none | none |
/// | `bias` | recursive Newton-Euler | 6 mul | 8 add, 10 mul |
/// | `kinetic_energy` | sum over links | 5 add, 13 mul | 5 add, 13 mul |
/// | `potential_energy` | first moment of mass, springs | none | none |
///
/// ## Defaults in force
///
/// - no gravity
/// - orientation by quaternions: `free`
/// - centre of mass at the body's origin: `nut`
pub mod free_body {
    use ::core::prelude::v1::*;
    use ::multibody::Real;
    /// Number of degrees of freedom: components of a velocity.
    pub const DOF: usize = 6;
    /// Parameters of `free_body`. The default is what the model declares.
    #[repr(C)]
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Params<T = f64> {
        /// `[kg]` mass
        ///
        /// Default: `1.0`
        pub m: T,
        /// `[kg m^2]` principal moments
        ///
        /// Default: `[1.0, 2.0, 3.0]`
        pub i: [T; 3],
    }
    /// Positions of the joints of `free_body`. The default is zero, or the identity.
    ///
    /// Components in order of declaration: 7.
    #[repr(C)]
    #[derive(Clone, Copy, Debug)]
    pub struct Position<T = f64> {
        /// position of the free joint
        pub free: ::multibody::Pose<T>,
    }
    /// Velocities of `free_body`; accelerations and efforts have the same components.
    ///
    /// Components in order of declaration: 6.
    #[repr(C)]
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Velocity<T = f64> {
        /// velocity of the free joint
        pub free: ::multibody::Twist<T>,
    }
    /// The model has no inputs.
    pub type Input = ();
    impl<T: Real> Default for Params<T> {
        fn default() -> Self {
            Self {
                m: T::lit(1.0),
                i: [T::lit(1.0), T::lit(2.0), T::lit(3.0)],
            }
        }
    }
    impl<T: Real> Default for Position<T> {
        fn default() -> Self {
            Self {
                free: ::multibody::Pose::default(),
            }
        }
    }
    impl<T: Real> PartialEq for Position<T> {
        fn eq(&self, other: &Self) -> bool {
            self.free == other.free
        }
    }
    impl<T: Real> Default for Velocity<T> {
        fn default() -> Self {
            Self {
                free: ::multibody::Twist::default(),
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
            if !::multibody::all(Real::is_finite(params.m)) {
                return Err(::multibody::ParamError {
                    what: "`m` is not finite",
                });
            }
            if !::multibody::all(
                Real::is_finite(params.i[0]) & Real::is_finite(params.i[1])
                    & Real::is_finite(params.i[2]),
            ) {
                return Err(::multibody::ParamError {
                    what: "`i` is not finite",
                });
            }
            {
                let mass = params.m;
                if !::multibody::all(
                    Real::ge(mass, T::lit(0.0)) & Real::is_finite(mass),
                ) {
                    return Err(::multibody::ParamError {
                        what: "the mass of `nut` is negative or not finite",
                    });
                }
            }
            if ::multibody::any(
                ::multibody::inertia_violation(
                    params.i[0],
                    params.i[1],
                    params.i[2],
                    T::lit(0.0),
                    T::lit(0.0),
                    T::lit(0.0),
                ),
            ) {
                return Err(::multibody::ParamError {
                    what: "no rigid body can have the inertia of `nut`",
                });
            }
            if !::multibody::all(
                Real::gt(params.i[2], T::lit(64.0) * T::epsilon() * (params.i[2])),
            ) {
                return Err(::multibody::ParamError {
                    what: "the mass matrix is singular at the default position: nothing resists `free.turn_z`",
                });
            }
            if !::multibody::all(
                Real::gt(params.i[1], T::lit(64.0) * T::epsilon() * (params.i[1])),
            ) {
                return Err(::multibody::ParamError {
                    what: "the mass matrix is singular at the default position: nothing resists `free.turn_y`",
                });
            }
            if !::multibody::all(
                Real::gt(params.i[0], T::lit(64.0) * T::epsilon() * (params.i[0])),
            ) {
                return Err(::multibody::ParamError {
                    what: "the mass matrix is singular at the default position: nothing resists `free.turn_x`",
                });
            }
            if !::multibody::all(
                Real::gt(params.m, T::lit(64.0) * T::epsilon() * (params.m)),
            ) {
                return Err(::multibody::ParamError {
                    what: "the mass matrix is singular at the default position: nothing resists `free.z`",
                });
            }
            if !::multibody::all(
                Real::gt(params.m, T::lit(64.0) * T::epsilon() * (params.m)),
            ) {
                return Err(::multibody::ParamError {
                    what: "the mass matrix is singular at the default position: nothing resists `free.y`",
                });
            }
            if !::multibody::all(
                Real::gt(params.m, T::lit(64.0) * T::epsilon() * (params.m)),
            ) {
                return Err(::multibody::ParamError {
                    what: "the mass matrix is singular at the default position: nothing resists `free.x`",
                });
            }
            Ok(())
        }
    }
    /// All that changes in time. Its default is every joint at zero, at rest.
    #[repr(C)]
    #[derive(Clone, Copy, Debug)]
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
    impl<T: Real> PartialEq for State<T> {
        fn eq(&self, other: &Self) -> bool {
            self.q == other.q && self.v == other.v
        }
    }
    impl<T: Real> ::multibody::Tangent<T> for Velocity<T> {
        fn zero() -> Self {
            Self {
                free: ::multibody::Tangent::zero(),
            }
        }
        fn zip<F: FnMut(T, T) -> T>(&self, other: &Self, f: &mut F) -> Self {
            Self {
                free: ::multibody::Tangent::zip(&self.free, &other.free, f),
            }
        }
        fn fold<A, F: FnMut(A, T) -> A>(&self, start: A, f: &mut F) -> A {
            ::multibody::Tangent::fold(&self.free, start, f)
        }
    }
    impl<T: Real> ::multibody::Configuration<T> for Position<T> {
        type Velocity = Velocity<T>;
        fn displace(&self, d: &Velocity<T>) -> Self {
            Self {
                free: ::multibody::Configuration::displace(&self.free, &d.free),
            }
        }
        fn advance(&self, d: &Velocity<T>, rest: &Velocity<T>) -> (Self, Velocity<T>) {
            let (mut end, mut left) = (*self, *rest);
            (end.free, left.free) = ::multibody::Configuration::advance(
                &self.free,
                &d.free,
                &rest.free,
            );
            (end, left)
        }
        fn dexp_inv(d: &Velocity<T>, v: &Velocity<T>) -> Velocity<T> {
            Velocity {
                free: <::multibody::Pose<
                    T,
                > as ::multibody::Configuration<T>>::dexp_inv(&d.free, &v.free),
            }
        }
        fn compose(first: &Velocity<T>, second: &Velocity<T>) -> Velocity<T> {
            Velocity {
                free: <::multibody::Pose<
                    T,
                > as ::multibody::Configuration<T>>::compose(&first.free, &second.free),
            }
        }
        fn magnitude(&self) -> Velocity<T> {
            Velocity {
                free: ::multibody::Configuration::magnitude(&self.free),
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
            ::multibody::Columns::columns(&self.m, &place.field("m", "kg"), f);
            ::multibody::Columns::columns(&self.i, &place.field("i", "kg m^2"), f);
        }
    }
    impl<T: Real> ::multibody::Columns<T> for Position<T> {
        fn columns(
            &self,
            place: &::multibody::Column<'_>,
            f: &mut dyn FnMut(&::multibody::Column<'_>, T),
        ) {
            ::multibody::Columns::columns(&self.free, &place.field("free", ""), f);
        }
    }
    impl<T: Real> ::multibody::Columns<T> for Velocity<T> {
        fn columns(
            &self,
            place: &::multibody::Column<'_>,
            f: &mut dyn FnMut(&::multibody::Column<'_>, T),
        ) {
            ::multibody::Columns::columns(&self.free, &place.field("free", ""), f);
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
            Self::from([params.m, params.i[0], params.i[1], params.i[2]])
        }
    }
    impl<T: Real> From<::multibody::nalgebra::SVector<T, 4>> for Params<T> {
        fn from(vector: ::multibody::nalgebra::SVector<T, 4>) -> Self {
            let [[m, i_0, i_1, i_2]] = vector.data.0;
            Params { m, i: [i_0, i_1, i_2] }
        }
    }
    impl<T: Real> From<Velocity<T>> for ::multibody::nalgebra::SVector<T, 6> {
        fn from(velocity: Velocity<T>) -> Self {
            Self::from([
                velocity.free.linear.x,
                velocity.free.linear.y,
                velocity.free.linear.z,
                velocity.free.angular.x,
                velocity.free.angular.y,
                velocity.free.angular.z,
            ])
        }
    }
    impl<T: Real> From<::multibody::nalgebra::SVector<T, 6>> for Velocity<T> {
        fn from(vector: ::multibody::nalgebra::SVector<T, 6>) -> Self {
            let [[free_linear_x, free_linear_y, free_linear_z, free_angular_x,
            free_angular_y, free_angular_z]] = vector.data.0;
            Velocity {
                free: ::multibody::Twist {
                    linear: ::multibody::nalgebra::Vector3::from([
                        free_linear_x,
                        free_linear_y,
                        free_linear_z,
                    ]),
                    angular: ::multibody::nalgebra::Vector3::from([
                        free_angular_x,
                        free_angular_y,
                        free_angular_z,
                    ]),
                },
            }
        }
    }
    impl<T: Real> From<Position<T>> for ::multibody::nalgebra::SVector<T, 7> {
        fn from(position: Position<T>) -> Self {
            Self::from([
                position.free.position.x,
                position.free.position.y,
                position.free.position.z,
                position.free.orientation.w,
                position.free.orientation.i,
                position.free.orientation.j,
                position.free.orientation.k,
            ])
        }
    }
    impl<T: Real> Position<T> {
        /// From a vector of all coordinates in order, quaternions as w, x, y, z; they are normalised.
        #[must_use]
        pub fn normalized(vector: ::multibody::nalgebra::SVector<T, 7>) -> Self {
            let [[free_position_x, free_position_y, free_position_z, free_orientation_w,
            free_orientation_i, free_orientation_j, free_orientation_k]] = vector.data.0;
            Position {
                free: ::multibody::Pose {
                    position: ::multibody::nalgebra::Vector3::from([
                        free_position_x,
                        free_position_y,
                        free_position_z,
                    ]),
                    orientation: ::multibody::rotation::normalized(
                        free_orientation_w,
                        free_orientation_i,
                        free_orientation_j,
                        free_orientation_k,
                    ),
                },
            }
        }
    }
    impl<T: Real> From<State<T>> for ::multibody::nalgebra::SVector<T, 13> {
        fn from(state: State<T>) -> Self {
            Self::from([
                state.q.free.position.x,
                state.q.free.position.y,
                state.q.free.position.z,
                state.q.free.orientation.w,
                state.q.free.orientation.i,
                state.q.free.orientation.j,
                state.q.free.orientation.k,
                state.v.free.linear.x,
                state.v.free.linear.y,
                state.v.free.linear.z,
                state.v.free.angular.x,
                state.v.free.angular.y,
                state.v.free.angular.z,
            ])
        }
    }
    impl<T: Real> State<T> {
        /// From a vector of all coordinates in order, quaternions as w, x, y, z; they are normalised.
        #[must_use]
        pub fn normalized(vector: ::multibody::nalgebra::SVector<T, 13>) -> Self {
            let [[q_free_position_x, q_free_position_y, q_free_position_z,
            q_free_orientation_w, q_free_orientation_i, q_free_orientation_j,
            q_free_orientation_k, v_free_linear_x, v_free_linear_y, v_free_linear_z,
            v_free_angular_x, v_free_angular_y, v_free_angular_z]] = vector.data.0;
            State {
                q: Position {
                    free: ::multibody::Pose {
                        position: ::multibody::nalgebra::Vector3::from([
                            q_free_position_x,
                            q_free_position_y,
                            q_free_position_z,
                        ]),
                        orientation: ::multibody::rotation::normalized(
                            q_free_orientation_w,
                            q_free_orientation_i,
                            q_free_orientation_j,
                            q_free_orientation_k,
                        ),
                    },
                },
                v: Velocity {
                    free: ::multibody::Twist {
                        linear: ::multibody::nalgebra::Vector3::from([
                            v_free_linear_x,
                            v_free_linear_y,
                            v_free_linear_z,
                        ]),
                        angular: ::multibody::nalgebra::Vector3::from([
                            v_free_angular_x,
                            v_free_angular_y,
                            v_free_angular_z,
                        ]),
                    },
                },
            }
        }
    }
    /// The equations of motion of `free_body`. It holds the 13 values that depend on parameters alone.
    #[repr(C)]
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Model<T = f64> {
        /// `((i[1] - 0.5 * (i[0] + i[1] + i[2])) - (i[2] - 0.5 * (i[0] + i[1] + i[2]))) / i[0]`
        free_angular_accel_x_factor: T,
        /// `((i[2] - 0.5 * (i[0] + i[1] + i[2])) - (i[0] - 0.5 * (i[0] + i[1] + i[2]))) / i[1]`
        free_angular_accel_y_factor: T,
        /// `((i[0] - 0.5 * (i[0] + i[1] + i[2])) - (i[1] - 0.5 * (i[0] + i[1] + i[2]))) / i[2]`
        free_angular_accel_z_factor: T,
        /// `m`
        m: T,
        /// `i[1] - 0.5 * (i[0] + i[1] + i[2])`
        minus_second_free_yy: T,
        /// `i[2] - 0.5 * (i[0] + i[1] + i[2])`
        minus_second_free_zz: T,
        /// `i[0] - 0.5 * (i[0] + i[1] + i[2])`
        minus_second_free_xx: T,
        /// `i[0]`
        i_0: T,
        /// `i[1]`
        i_1: T,
        /// `i[2]`
        i_2: T,
        /// `(i[1] - 0.5 * (i[0] + i[1] + i[2])) - (i[2] - 0.5 * (i[0] + i[1] + i[2]))`
        free_angular_effort_x_factor: T,
        /// `(i[2] - 0.5 * (i[0] + i[1] + i[2])) - (i[0] - 0.5 * (i[0] + i[1] + i[2]))`
        free_angular_effort_y_factor: T,
        /// `(i[0] - 0.5 * (i[0] + i[1] + i[2])) - (i[1] - 0.5 * (i[0] + i[1] + i[2]))`
        free_angular_effort_z_factor: T,
    }
    impl<T: Real> Model<T> {
        /// Does the work that depends on parameters alone.
        ///
        /// Operations: 8 add, 6 mul, 3 div.
        #[must_use]
        pub fn new(params: &Params<T>) -> Self {
            // Factorisation L^T D L.
            let inverse_4 = T::lit(1.0) / params.i[0];
            let i_0_plus_i_1_plus_i_2 = params.i[0] + params.i[1] + params.i[2];
            let minus_second_free_yy = params.i[1] - T::lit(0.5) * i_0_plus_i_1_plus_i_2;
            let minus_second_free_zz = params.i[2] - T::lit(0.5) * i_0_plus_i_1_plus_i_2;
            let free_angular_effort_x_factor = minus_second_free_yy
                - minus_second_free_zz;
            let inverse_5 = T::lit(1.0) / params.i[1];
            let minus_second_free_xx = params.i[0] - T::lit(0.5) * i_0_plus_i_1_plus_i_2;
            let free_angular_effort_y_factor = minus_second_free_zz
                - minus_second_free_xx;
            let inverse_6 = T::lit(1.0) / params.i[2];
            let free_angular_effort_z_factor = minus_second_free_xx
                - minus_second_free_yy;
            Self {
                free_angular_accel_x_factor: inverse_4 * free_angular_effort_x_factor,
                free_angular_accel_y_factor: inverse_5 * free_angular_effort_y_factor,
                free_angular_accel_z_factor: inverse_6 * free_angular_effort_z_factor,
                m: params.m,
                minus_second_free_yy,
                minus_second_free_zz,
                minus_second_free_xx,
                i_0: params.i[0],
                i_1: params.i[1],
                i_2: params.i[2],
                free_angular_effort_x_factor,
                free_angular_effort_y_factor,
                free_angular_effort_z_factor,
            }
        }
        /// Accelerations.
        ///
        /// Method: composite rigid body, LDL^T.
        ///
        /// Operations: 6 mul; as derived, before optimisation: 8 add, 13 mul, 3 div.
        #[must_use]
        pub fn forward_dynamics(
            &self,
            _t: T,
            state: &State<T>,
            _input: &(),
        ) -> Velocity<T> {
            let v = &state.v;
            Velocity {
                free: ::multibody::Twist {
                    linear: ::multibody::nalgebra::Vector3::from([
                        T::lit(0.0),
                        T::lit(0.0),
                        T::lit(0.0),
                    ]),
                    angular: ::multibody::nalgebra::Vector3::from([
                        (v.free.angular.y * v.free.angular.z
                            * self.free_angular_accel_x_factor),
                        (v.free.angular.x * v.free.angular.z
                            * self.free_angular_accel_y_factor),
                        (v.free.angular.x * v.free.angular.y
                            * self.free_angular_accel_z_factor),
                    ]),
                },
            }
        }
        /// Efforts that the accelerations `accel` need beside all declared forces.
        ///
        /// Method: recursive Newton-Euler.
        ///
        /// Operations: 9 add, 12 mul; as derived, before optimisation: 14 add, 13 mul.
        #[must_use]
        pub fn inverse_dynamics(
            &self,
            _t: T,
            state: &State<T>,
            _input: &(),
            accel: &Velocity<T>,
        ) -> Velocity<T> {
            let v = &state.v;
            // Results.
            let free_angular_rate_y_times_z = v.free.angular.y * v.free.angular.z;
            let u_free_zy = accel.free.angular.x + free_angular_rate_y_times_z;
            let minus_u_free_yz = accel.free.angular.x - free_angular_rate_y_times_z;
            let free_angular_rate_x_times_z = v.free.angular.x * v.free.angular.z;
            let u_free_xz = accel.free.angular.y + free_angular_rate_x_times_z;
            let minus_u_free_zx = accel.free.angular.y - free_angular_rate_x_times_z;
            let free_angular_rate_x_times_y = v.free.angular.x * v.free.angular.y;
            let u_free_yx = accel.free.angular.z + free_angular_rate_x_times_y;
            let minus_u_free_xy = accel.free.angular.z - free_angular_rate_x_times_y;
            Velocity {
                free: ::multibody::Twist {
                    linear: ::multibody::nalgebra::Vector3::from([
                        (self.m * accel.free.linear.x),
                        (self.m * accel.free.linear.y),
                        (self.m * accel.free.linear.z),
                    ]),
                    angular: ::multibody::nalgebra::Vector3::from([
                        -(self.minus_second_free_yy * u_free_zy
                            + self.minus_second_free_zz * minus_u_free_yz),
                        -(self.minus_second_free_zz * u_free_xz
                            + self.minus_second_free_xx * minus_u_free_zx),
                        -(self.minus_second_free_xx * u_free_yx
                            + self.minus_second_free_yy * minus_u_free_xy),
                    ]),
                },
            }
        }
        /// Mass matrix `M` of `M * accel + bias = effort`.
        ///
        /// Method: composite rigid body.
        ///
        /// Operations: none; as derived, before optimisation: none.
        #[must_use]
        pub fn mass_matrix(
            &self,
            _q: &Position<T>,
        ) -> ::multibody::nalgebra::SMatrix<T, 6, 6> {
            ::multibody::nalgebra::SMatrix::from([
                [
                    self.m,
                    T::lit(0.0),
                    T::lit(0.0),
                    T::lit(0.0),
                    T::lit(0.0),
                    T::lit(0.0),
                ],
                [
                    T::lit(0.0),
                    self.m,
                    T::lit(0.0),
                    T::lit(0.0),
                    T::lit(0.0),
                    T::lit(0.0),
                ],
                [
                    T::lit(0.0),
                    T::lit(0.0),
                    self.m,
                    T::lit(0.0),
                    T::lit(0.0),
                    T::lit(0.0),
                ],
                [
                    T::lit(0.0),
                    T::lit(0.0),
                    T::lit(0.0),
                    self.i_0,
                    T::lit(0.0),
                    T::lit(0.0),
                ],
                [
                    T::lit(0.0),
                    T::lit(0.0),
                    T::lit(0.0),
                    T::lit(0.0),
                    self.i_1,
                    T::lit(0.0),
                ],
                [
                    T::lit(0.0),
                    T::lit(0.0),
                    T::lit(0.0),
                    T::lit(0.0),
                    T::lit(0.0),
                    self.i_2,
                ],
            ])
        }
        /// The efforts at zero acceleration, `bias` of `M * accel + bias = effort`; declared forces and gravity are in it.
        ///
        /// Method: recursive Newton-Euler.
        ///
        /// Operations: 6 mul; as derived, before optimisation: 8 add, 10 mul.
        #[must_use]
        pub fn bias(
            &self,
            _t: T,
            state: &State<T>,
            _input: &(),
        ) -> ::multibody::nalgebra::SVector<T, 6> {
            let v = &state.v;
            ::multibody::nalgebra::SVector::from([
                T::lit(0.0),
                T::lit(0.0),
                T::lit(0.0),
                (-v.free.angular.y * v.free.angular.z
                    * self.free_angular_effort_x_factor),
                (-v.free.angular.x * v.free.angular.z
                    * self.free_angular_effort_y_factor),
                (-v.free.angular.x * v.free.angular.y
                    * self.free_angular_effort_z_factor),
            ])
        }
        /// `[J]` Kinetic energy of all bodies.
        ///
        /// Method: sum over links.
        ///
        /// Operations: 5 add, 13 mul; as derived, before optimisation: 5 add, 13 mul.
        #[must_use]
        pub fn kinetic_energy(&self, state: &State<T>) -> T {
            let v = &state.v;
            let kinetic_energy_with_free_x_rate = self.m * v.free.linear.x
                * v.free.linear.x + self.m * v.free.linear.y * v.free.linear.y
                + self.m * v.free.linear.z * v.free.linear.z
                + self.i_0 * v.free.angular.x * v.free.angular.x
                + self.i_1 * v.free.angular.y * v.free.angular.y
                + self.i_2 * v.free.angular.z * v.free.angular.z;
            T::lit(0.5) * kinetic_energy_with_free_x_rate
        }
        /// `[J]` Potential energy: gravity's, zero at the world's origin, plus the springs'.
        ///
        /// Method: first moment of mass, springs.
        ///
        /// Operations: none; as derived, before optimisation: none.
        #[must_use]
        pub fn potential_energy(&self, _q: &Position<T>) -> T {
            T::lit(0.0)
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
            ::multibody::pivots::without_inertia(
                &matrix,
                &[
                    "free.linear.x",
                    "free.linear.y",
                    "free.linear.z",
                    "free.angular.x",
                    "free.angular.y",
                    "free.angular.z",
                ],
            )
        }
    }
    impl<T: Real> ::multibody::Verifiable<6> for Model<T> {
        fn free_motion(
            &self,
            t: T,
            state: &State<T>,
            input: &(),
        ) -> (
            ::multibody::nalgebra::SVector<T, 6>,
            ::multibody::nalgebra::SVector<T, 6>,
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
            accelerations: &::multibody::nalgebra::SVector<T, 6>,
        ) -> ::multibody::nalgebra::SVector<T, 6> {
            self.inverse_dynamics(t, state, input, &(*accelerations).into()).into()
        }
        fn inertia(
            &self,
            _t: T,
            state: &State<T>,
            _input: &(),
        ) -> ::multibody::nalgebra::SMatrix<T, 6, 6> {
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
    pub const COORDINATES: &[&str] = &[
        "free.linear.x",
        "free.linear.y",
        "free.linear.z",
        "free.angular.x",
        "free.angular.y",
        "free.angular.z",
    ];
    /// Operation counts of every function, and of `Model::new`.
    pub const COSTS: &[::multibody::Cost] = &[
        ::multibody::Cost {
            function: "new",
            add: 8,
            mul: 6,
            div: 3,
            sqrt: 0,
            sincos: 0,
            other: 0,
        },
        ::multibody::Cost {
            function: "forward_dynamics",
            add: 0,
            mul: 6,
            div: 0,
            sqrt: 0,
            sincos: 0,
            other: 0,
        },
        ::multibody::Cost {
            function: "inverse_dynamics",
            add: 9,
            mul: 12,
            div: 0,
            sqrt: 0,
            sincos: 0,
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
            mul: 6,
            div: 0,
            sqrt: 0,
            sincos: 0,
            other: 0,
        },
        ::multibody::Cost {
            function: "kinetic_energy",
            add: 5,
            mul: 13,
            div: 0,
            sqrt: 0,
            sincos: 0,
            other: 0,
        },
        ::multibody::Cost {
            function: "potential_energy",
            add: 0,
            mul: 0,
            div: 0,
            sqrt: 0,
            sincos: 0,
            other: 0,
        },
    ];
    /// The same of every function as it was derived, before optimisation, with the work on parameters in it.
    pub const DERIVED: &[::multibody::Cost] = &[
        ::multibody::Cost {
            function: "forward_dynamics",
            add: 8,
            mul: 13,
            div: 3,
            sqrt: 0,
            sincos: 0,
            other: 0,
        },
        ::multibody::Cost {
            function: "inverse_dynamics",
            add: 14,
            mul: 13,
            div: 0,
            sqrt: 0,
            sincos: 0,
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
            add: 8,
            mul: 10,
            div: 0,
            sqrt: 0,
            sincos: 0,
            other: 0,
        },
        ::multibody::Cost {
            function: "kinetic_energy",
            add: 5,
            mul: 13,
            div: 0,
            sqrt: 0,
            sincos: 0,
            other: 0,
        },
        ::multibody::Cost {
            function: "potential_energy",
            add: 0,
            mul: 0,
            div: 0,
            sqrt: 0,
            sincos: 0,
            other: 0,
        },
    ];
}
