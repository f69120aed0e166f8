/// The platform is kept level.
///
/// ## Parameters
///
/// | field | unit | default |  |
/// |---|---|---|---|
/// | `legs[_].k` | `N/m` | `0.0` | of a spring along the leg |
/// | `legs[_].c` | `N s/m` | `0.0` | of a damper along the leg |
/// | `legs[_].s0` | `m` | `0.0` | stroke at which the spring is at rest |
///
/// ## Coordinates
///
/// | joint | kind | parent | child | freedoms |  |
/// |---|---|---|---|---|---|
/// | `platform` | free | ground | `platform` | 3 of 6 |  |
/// | `legs[_].gimbal` | universal | ground | `legs[_].cylinder` | 0 of 2 |  |
/// | `legs[_].stroke` | prismatic | `legs[_].cylinder` | `legs[_].piston` | 0 of 1 |  |
///
/// ## Inputs
///
/// | field | unit | type |  |
/// |---|---|---|---|
/// | `legs[_].thrust` | `N` | scalar | pushes the tip away from the base |
///
/// ## Bodies
///
/// | body | inertia |  |
/// |---|---|---|
/// | `platform` | rigid body |  |
/// | `legs[_].cylinder` | rigid body |  |
/// | `legs[_].piston` | rigid body |  |
///
/// ## Loops
///
/// | closed by | kind | between | and | equations |  |
/// |---|---|---|---|---|---|
/// | `legs[_].ball` | ball | `legs[_].piston` | `platform` | solved |  |
///
/// 3 velocity coordinates + 0 constraint equations = 3 equations.
///
/// - `legs[_].gimbal.first`, `legs[_].gimbal.second`, `legs[_].stroke`: in closed form from `legs[_].ball`, where `legs[_].stroke > -1.0`, `cos(legs[_].gimbal.second) > 0.0`
/// - `platform.orientation` is driven: `identity()`
/// - found in closed form: `legs[_].gimbal.first`, `legs[_].gimbal.second`, `legs[_].stroke`
/// - `legs[_].stroke`: distance of two points: quadratic in the travel
/// - `legs[_].gimbal.first`: distance of a point from a plane: A cos x + B sin x = 0
/// - `legs[_].gimbal.second`: a point on both sides: (r cos x, r sin x) = (u, v)
///
/// ## Repeated parts
///
/// - six identical loops: `legs[0].ball` to `legs[5].ball`
///
/// ## Functions
///
/// | function | method | operations | as derived |
/// |---|---|---|---|
/// | `new` |  | 6 add |  |
/// | `forward_dynamics` | struts, condensed | 145 add, 160 mul, 9 div, 6 sqrt | 173 add, 225 mul, 9 div, 6 sqrt |
/// | `inverse_dynamics` | struts, moments about a point of the pins' plane | 154 add, 164 mul, 7 div, 6 sqrt, 3 other | 187 add, 183 mul, 7 div, 6 sqrt, 3 other |
/// | `dead_centres` | closed forms | 31 add, 25 mul, 12 sqrt | 42 add, 25 mul, 12 sqrt |
/// | `margins` | closed forms, determinants | 52 add, 60 mul, 12 sqrt | 66 add, 60 mul, 12 sqrt |
///
/// ## Defaults in force
///
/// - centre of mass at the body's origin: `platform`
pub mod level {
    use ::core::prelude::v1::*;
    use ::multibody::Real;
    /// Number of degrees of freedom: components of a velocity.
    pub const DOF: usize = 3;
    /// Parameters of `level`. The default is what the model declares.
    #[repr(C)]
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Params<T = f64> {
        /// part `leg`
        pub legs: [leg::Params<T>; 6],
    }
    /// Positions of the joints of `level`. The default is zero, or the identity.
    ///
    /// Components in order of declaration: 3.
    #[repr(C)]
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Position<T = f64> {
        /// `[m]` position of the free joint
        pub platform: ::multibody::nalgebra::Vector3<T>,
    }
    /// Velocities of `level`; accelerations and efforts have the same components.
    ///
    /// Components in order of declaration: 3.
    #[repr(C)]
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Velocity<T = f64> {
        /// `[m/s]` rate of the position of the free joint
        pub platform: ::multibody::nalgebra::Vector3<T>,
    }
    /// Inputs of `level`, held over a step. The default is zero.
    #[repr(C)]
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Input<T = f64> {
        /// part `leg`
        pub legs: [leg::Input<T>; 6],
    }
    impl<T: Real> Default for Params<T> {
        fn default() -> Self {
            Self {
                legs: [leg::Params::default(); 6],
            }
        }
    }
    impl<T: Real> Default for Position<T> {
        fn default() -> Self {
            Self {
                platform: ::multibody::nalgebra::Vector3::zeros(),
            }
        }
    }
    impl<T: Real> Default for Velocity<T> {
        fn default() -> Self {
            Self {
                platform: ::multibody::nalgebra::Vector3::zeros(),
            }
        }
    }
    impl<T: Real> Default for Input<T> {
        fn default() -> Self {
            Self {
                legs: [leg::Input::default(); 6],
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
            if !::multibody::all(Real::is_finite(params.legs[0].k)) {
                return Err(::multibody::ParamError {
                    what: "`legs[0].k` is not finite",
                });
            }
            if !::multibody::all(Real::is_finite(params.legs[0].c)) {
                return Err(::multibody::ParamError {
                    what: "`legs[0].c` is not finite",
                });
            }
            if !::multibody::all(Real::is_finite(params.legs[0].s0)) {
                return Err(::multibody::ParamError {
                    what: "`legs[0].s0` is not finite",
                });
            }
            if !::multibody::all(Real::is_finite(params.legs[1].k)) {
                return Err(::multibody::ParamError {
                    what: "`legs[1].k` is not finite",
                });
            }
            if !::multibody::all(Real::is_finite(params.legs[1].c)) {
                return Err(::multibody::ParamError {
                    what: "`legs[1].c` is not finite",
                });
            }
            if !::multibody::all(Real::is_finite(params.legs[1].s0)) {
                return Err(::multibody::ParamError {
                    what: "`legs[1].s0` is not finite",
                });
            }
            if !::multibody::all(Real::is_finite(params.legs[2].k)) {
                return Err(::multibody::ParamError {
                    what: "`legs[2].k` is not finite",
                });
            }
            if !::multibody::all(Real::is_finite(params.legs[2].c)) {
                return Err(::multibody::ParamError {
                    what: "`legs[2].c` is not finite",
                });
            }
            if !::multibody::all(Real::is_finite(params.legs[2].s0)) {
                return Err(::multibody::ParamError {
                    what: "`legs[2].s0` is not finite",
                });
            }
            if !::multibody::all(Real::is_finite(params.legs[3].k)) {
                return Err(::multibody::ParamError {
                    what: "`legs[3].k` is not finite",
                });
            }
            if !::multibody::all(Real::is_finite(params.legs[3].c)) {
                return Err(::multibody::ParamError {
                    what: "`legs[3].c` is not finite",
                });
            }
            if !::multibody::all(Real::is_finite(params.legs[3].s0)) {
                return Err(::multibody::ParamError {
                    what: "`legs[3].s0` is not finite",
                });
            }
            if !::multibody::all(Real::is_finite(params.legs[4].k)) {
                return Err(::multibody::ParamError {
                    what: "`legs[4].k` is not finite",
                });
            }
            if !::multibody::all(Real::is_finite(params.legs[4].c)) {
                return Err(::multibody::ParamError {
                    what: "`legs[4].c` is not finite",
                });
            }
            if !::multibody::all(Real::is_finite(params.legs[4].s0)) {
                return Err(::multibody::ParamError {
                    what: "`legs[4].s0` is not finite",
                });
            }
            if !::multibody::all(Real::is_finite(params.legs[5].k)) {
                return Err(::multibody::ParamError {
                    what: "`legs[5].k` is not finite",
                });
            }
            if !::multibody::all(Real::is_finite(params.legs[5].c)) {
                return Err(::multibody::ParamError {
                    what: "`legs[5].c` is not finite",
                });
            }
            if !::multibody::all(Real::is_finite(params.legs[5].s0)) {
                return Err(::multibody::ParamError {
                    what: "`legs[5].s0` is not finite",
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
    /// What inverse dynamics gives: the inputs that produce the motion.
    #[repr(C)]
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Solved<T = f64> {
        /// the given inputs, with those that were looked for in their places
        pub input: Input<T>,
        /// rank of their equations
        pub rank: T,
    }
    impl<T: Real> Default for Solved<T> {
        fn default() -> Self {
            Self {
                input: Input::default(),
                rank: T::lit(0.0),
            }
        }
    }
    impl<T: Real> ::multibody::Tangent<T> for Velocity<T> {
        fn zero() -> Self {
            Self {
                platform: ::multibody::Tangent::zero(),
            }
        }
        fn zip<F: FnMut(T, T) -> T>(&self, other: &Self, f: &mut F) -> Self {
            Self {
                platform: ::multibody::Tangent::zip(&self.platform, &other.platform, f),
            }
        }
        fn fold<A, F: FnMut(A, T) -> A>(&self, start: A, f: &mut F) -> A {
            ::multibody::Tangent::fold(&self.platform, start, f)
        }
    }
    impl<T: Real> ::multibody::Configuration<T> for Position<T> {
        type Velocity = Velocity<T>;
        fn displace(&self, d: &Velocity<T>) -> Self {
            Self {
                platform: ::multibody::Configuration::displace(
                    &self.platform,
                    &d.platform,
                ),
            }
        }
        fn advance(&self, d: &Velocity<T>, rest: &Velocity<T>) -> (Self, Velocity<T>) {
            let (mut end, mut left) = (*self, *rest);
            (end.platform, left.platform) = ::multibody::Configuration::advance(
                &self.platform,
                &d.platform,
                &rest.platform,
            );
            (end, left)
        }
        fn dexp_inv(_d: &Velocity<T>, v: &Velocity<T>) -> Velocity<T> {
            *v
        }
        fn magnitude(&self) -> Velocity<T> {
            Velocity {
                platform: ::multibody::Configuration::magnitude(&self.platform),
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
            ::multibody::Columns::columns(&self.legs, &place.field("legs", ""), f);
        }
    }
    impl<T: Real> ::multibody::Columns<T> for Position<T> {
        fn columns(
            &self,
            place: &::multibody::Column<'_>,
            f: &mut dyn FnMut(&::multibody::Column<'_>, T),
        ) {
            ::multibody::Columns::columns(
                &self.platform,
                &place.field("platform", "m"),
                f,
            );
        }
    }
    impl<T: Real> ::multibody::Columns<T> for Velocity<T> {
        fn columns(
            &self,
            place: &::multibody::Column<'_>,
            f: &mut dyn FnMut(&::multibody::Column<'_>, T),
        ) {
            ::multibody::Columns::columns(
                &self.platform,
                &place.field("platform", "m/s"),
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
            ::multibody::Columns::columns(&self.legs, &place.field("legs", ""), f);
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
    impl<T: Real> From<Params<T>> for ::multibody::nalgebra::SVector<T, 18> {
        fn from(params: Params<T>) -> Self {
            Self::from([
                params.legs[0].k,
                params.legs[0].c,
                params.legs[0].s0,
                params.legs[1].k,
                params.legs[1].c,
                params.legs[1].s0,
                params.legs[2].k,
                params.legs[2].c,
                params.legs[2].s0,
                params.legs[3].k,
                params.legs[3].c,
                params.legs[3].s0,
                params.legs[4].k,
                params.legs[4].c,
                params.legs[4].s0,
                params.legs[5].k,
                params.legs[5].c,
                params.legs[5].s0,
            ])
        }
    }
    impl<T: Real> From<::multibody::nalgebra::SVector<T, 18>> for Params<T> {
        fn from(vector: ::multibody::nalgebra::SVector<T, 18>) -> Self {
            let [[legs_0_k, legs_0_c, legs_0_s0, legs_1_k, legs_1_c, legs_1_s0, legs_2_k,
            legs_2_c, legs_2_s0, legs_3_k, legs_3_c, legs_3_s0, legs_4_k, legs_4_c,
            legs_4_s0, legs_5_k, legs_5_c, legs_5_s0]] = vector.data.0;
            Params {
                legs: [
                    leg::Params {
                        k: legs_0_k,
                        c: legs_0_c,
                        s0: legs_0_s0,
                    },
                    leg::Params {
                        k: legs_1_k,
                        c: legs_1_c,
                        s0: legs_1_s0,
                    },
                    leg::Params {
                        k: legs_2_k,
                        c: legs_2_c,
                        s0: legs_2_s0,
                    },
                    leg::Params {
                        k: legs_3_k,
                        c: legs_3_c,
                        s0: legs_3_s0,
                    },
                    leg::Params {
                        k: legs_4_k,
                        c: legs_4_c,
                        s0: legs_4_s0,
                    },
                    leg::Params {
                        k: legs_5_k,
                        c: legs_5_c,
                        s0: legs_5_s0,
                    },
                ],
            }
        }
    }
    impl<T: Real> From<Velocity<T>> for ::multibody::nalgebra::SVector<T, 3> {
        fn from(velocity: Velocity<T>) -> Self {
            Self::from([velocity.platform.x, velocity.platform.y, velocity.platform.z])
        }
    }
    impl<T: Real> From<::multibody::nalgebra::SVector<T, 3>> for Velocity<T> {
        fn from(vector: ::multibody::nalgebra::SVector<T, 3>) -> Self {
            let [[platform_x, platform_y, platform_z]] = vector.data.0;
            Velocity {
                platform: ::multibody::nalgebra::Vector3::from([
                    platform_x,
                    platform_y,
                    platform_z,
                ]),
            }
        }
    }
    impl<T: Real> From<Position<T>> for ::multibody::nalgebra::SVector<T, 3> {
        fn from(position: Position<T>) -> Self {
            Self::from([position.platform.x, position.platform.y, position.platform.z])
        }
    }
    impl<T: Real> From<::multibody::nalgebra::SVector<T, 3>> for Position<T> {
        fn from(vector: ::multibody::nalgebra::SVector<T, 3>) -> Self {
            let [[platform_x, platform_y, platform_z]] = vector.data.0;
            Position {
                platform: ::multibody::nalgebra::Vector3::from([
                    platform_x,
                    platform_y,
                    platform_z,
                ]),
            }
        }
    }
    impl<T: Real> From<Input<T>> for ::multibody::nalgebra::SVector<T, 6> {
        fn from(input: Input<T>) -> Self {
            Self::from([
                input.legs[0].thrust,
                input.legs[1].thrust,
                input.legs[2].thrust,
                input.legs[3].thrust,
                input.legs[4].thrust,
                input.legs[5].thrust,
            ])
        }
    }
    impl<T: Real> From<::multibody::nalgebra::SVector<T, 6>> for Input<T> {
        fn from(vector: ::multibody::nalgebra::SVector<T, 6>) -> Self {
            let [[legs_0_thrust, legs_1_thrust, legs_2_thrust, legs_3_thrust,
            legs_4_thrust, legs_5_thrust]] = vector.data.0;
            Input {
                legs: [
                    leg::Input {
                        thrust: legs_0_thrust,
                    },
                    leg::Input {
                        thrust: legs_1_thrust,
                    },
                    leg::Input {
                        thrust: legs_2_thrust,
                    },
                    leg::Input {
                        thrust: legs_3_thrust,
                    },
                    leg::Input {
                        thrust: legs_4_thrust,
                    },
                    leg::Input {
                        thrust: legs_5_thrust,
                    },
                ],
            }
        }
    }
    impl<T: Real> From<State<T>> for ::multibody::nalgebra::SVector<T, 6> {
        fn from(state: State<T>) -> Self {
            Self::from([
                state.q.platform.x,
                state.q.platform.y,
                state.q.platform.z,
                state.v.platform.x,
                state.v.platform.y,
                state.v.platform.z,
            ])
        }
    }
    impl<T: Real> From<::multibody::nalgebra::SVector<T, 6>> for State<T> {
        fn from(vector: ::multibody::nalgebra::SVector<T, 6>) -> Self {
            let [[q_platform_x, q_platform_y, q_platform_z, v_platform_x, v_platform_y,
            v_platform_z]] = vector.data.0;
            State {
                q: Position {
                    platform: ::multibody::nalgebra::Vector3::from([
                        q_platform_x,
                        q_platform_y,
                        q_platform_z,
                    ]),
                },
                v: Velocity {
                    platform: ::multibody::nalgebra::Vector3::from([
                        v_platform_x,
                        v_platform_y,
                        v_platform_z,
                    ]),
                },
            }
        }
    }
    /// The equations of motion of `level`. It holds the 18 values that depend on parameters alone.
    #[repr(C)]
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Model<T = f64> {
        /// `1 + legs[0].s0`
        legs_0_force_factor: T,
        /// `legs[0].k`
        legs_0_k: T,
        /// `legs[0].c`
        legs_0_c: T,
        /// `1 + legs[3].s0`
        legs_3_force_factor: T,
        /// `legs[3].k`
        legs_3_k: T,
        /// `legs[3].c`
        legs_3_c: T,
        /// `1 + legs[1].s0`
        legs_1_force_factor: T,
        /// `legs[1].k`
        legs_1_k: T,
        /// `legs[1].c`
        legs_1_c: T,
        /// `1 + legs[2].s0`
        legs_2_force_factor: T,
        /// `legs[2].k`
        legs_2_k: T,
        /// `legs[2].c`
        legs_2_c: T,
        /// `1 + legs[4].s0`
        legs_4_force_factor: T,
        /// `legs[4].k`
        legs_4_k: T,
        /// `legs[4].c`
        legs_4_c: T,
        /// `1 + legs[5].s0`
        legs_5_force_factor: T,
        /// `legs[5].k`
        legs_5_k: T,
        /// `legs[5].c`
        legs_5_c: T,
    }
    impl<T: Real> Model<T> {
        /// Does the work that depends on parameters alone.
        ///
        /// Operations: 6 add.
        #[must_use]
        pub fn new(params: &Params<T>) -> Self {
            Self {
                legs_0_force_factor: T::lit(1.0) + params.legs[0].s0,
                legs_0_k: params.legs[0].k,
                legs_0_c: params.legs[0].c,
                legs_3_force_factor: T::lit(1.0) + params.legs[3].s0,
                legs_3_k: params.legs[3].k,
                legs_3_c: params.legs[3].c,
                legs_1_force_factor: T::lit(1.0) + params.legs[1].s0,
                legs_1_k: params.legs[1].k,
                legs_1_c: params.legs[1].c,
                legs_2_force_factor: T::lit(1.0) + params.legs[2].s0,
                legs_2_k: params.legs[2].k,
                legs_2_c: params.legs[2].c,
                legs_4_force_factor: T::lit(1.0) + params.legs[4].s0,
                legs_4_k: params.legs[4].k,
                legs_4_c: params.legs[4].c,
                legs_5_force_factor: T::lit(1.0) + params.legs[5].s0,
                legs_5_k: params.legs[5].k,
                legs_5_c: params.legs[5].c,
            }
        }
        /// Accelerations.
        ///
        /// Method: struts, condensed.
        ///
        /// Operations: 145 add, 160 mul, 9 div, 6 sqrt; as derived, before optimisation: 173 add, 225 mul, 9 div, 6 sqrt.
        #[must_use]
        pub fn forward_dynamics(
            &self,
            _t: T,
            state: &State<T>,
            input: &Input<T>,
        ) -> Velocity<T> {
            let q = &state.q;
            let v = &state.v;
            // Strut legs_0.
            let legs_0_line_y = q.platform.y - T::lit(0.779);
            let legs_0_line_x = T::lit(2.29) + q.platform.x;
            let legs_0_line_z = q.platform.z - T::lit(0.4);
            let legs_0_line_z_squared = legs_0_line_z * legs_0_line_z;
            let legs_0_line_x_squared_plus_z_squared = legs_0_line_x * legs_0_line_x
                + legs_0_line_z_squared;
            let legs_0_length = Real::sqrt(
                legs_0_line_y * legs_0_line_y + legs_0_line_x_squared_plus_z_squared,
            );
            let legs_0_length_inv = T::lit(1.0) / legs_0_length;
            let platform_z_rate_times_legs_0_line_z = v.platform.z * legs_0_line_z;
            let legs_line_by_rate_with_platform_x_rate = v.platform.x * legs_0_line_x
                + platform_z_rate_times_legs_0_line_z;
            let legs_0_length_rate = legs_0_length_inv
                * (v.platform.y * legs_0_line_y
                    + legs_line_by_rate_with_platform_x_rate);
            let legs_0_length_inv_times_0_0625 = T::lit(0.0625) * legs_0_length_inv;
            let legs_0_swell = legs_0_length_inv_times_0_0625 - T::lit(0.1);
            let legs_0_length_inv_squared = legs_0_length_inv * legs_0_length_inv;
            let minus_legs_0_beta = legs_0_length_rate
                * (legs_0_length_inv_times_0_0625 + legs_0_swell)
                * legs_0_length_inv_squared;
            // Strut legs_1.
            let legs_1_line_y = q.platform.y - T::lit(1.074);
            let legs_1_line_x = T::lit(1.78) + q.platform.x;
            let legs_length_squared_with_legs_0_line_z = legs_0_line_z_squared
                + legs_1_line_x * legs_1_line_x;
            let legs_1_length = Real::sqrt(
                legs_1_line_y * legs_1_line_y + legs_length_squared_with_legs_0_line_z,
            );
            let legs_1_length_inv = T::lit(1.0) / legs_1_length;
            let legs_line_by_rate_with_legs_1_line_x = platform_z_rate_times_legs_0_line_z
                + v.platform.x * legs_1_line_x;
            let legs_1_length_rate = legs_1_length_inv
                * (v.platform.y * legs_1_line_y + legs_line_by_rate_with_legs_1_line_x);
            let legs_1_length_inv_times_0_0625 = T::lit(0.0625) * legs_1_length_inv;
            let legs_1_swell = legs_1_length_inv_times_0_0625 - T::lit(0.1);
            let legs_1_length_inv_squared = legs_1_length_inv * legs_1_length_inv;
            let minus_legs_1_beta = legs_1_length_rate
                * (legs_1_length_inv_times_0_0625 + legs_1_swell)
                * legs_1_length_inv_squared;
            // Strut legs_2.
            let legs_2_line_y = T::lit(1.074) + q.platform.y;
            let legs_2_length = Real::sqrt(
                legs_2_line_y * legs_2_line_y + legs_length_squared_with_legs_0_line_z,
            );
            let legs_2_length_inv = T::lit(1.0) / legs_2_length;
            let legs_2_length_rate = legs_2_length_inv
                * (v.platform.y * legs_2_line_y + legs_line_by_rate_with_legs_1_line_x);
            let legs_2_length_inv_times_0_0625 = T::lit(0.0625) * legs_2_length_inv;
            let legs_2_swell = legs_2_length_inv_times_0_0625 - T::lit(0.1);
            let legs_2_length_inv_squared = legs_2_length_inv * legs_2_length_inv;
            let minus_legs_2_beta = legs_2_length_rate
                * (legs_2_length_inv_times_0_0625 + legs_2_swell)
                * legs_2_length_inv_squared;
            // Strut legs_3.
            let legs_3_line_y = T::lit(0.779) + q.platform.y;
            let legs_3_length = Real::sqrt(
                legs_3_line_y * legs_3_line_y + legs_0_line_x_squared_plus_z_squared,
            );
            let legs_3_length_inv = T::lit(1.0) / legs_3_length;
            let legs_3_length_rate = legs_3_length_inv
                * (v.platform.y * legs_3_line_y
                    + legs_line_by_rate_with_platform_x_rate);
            let legs_3_length_inv_times_0_0625 = T::lit(0.0625) * legs_3_length_inv;
            let legs_3_swell = legs_3_length_inv_times_0_0625 - T::lit(0.1);
            let legs_3_length_inv_squared = legs_3_length_inv * legs_3_length_inv;
            let minus_legs_3_beta = legs_3_length_rate
                * (legs_3_length_inv_times_0_0625 + legs_3_swell)
                * legs_3_length_inv_squared;
            // Strut legs_4.
            let legs_4_line_y = q.platform.y - T::lit(0.295);
            let legs_4_line_x = T::lit(43.0 / 100.0) + q.platform.x;
            let legs_length_squared_with_legs_4_line_x = legs_0_line_z_squared
                + legs_4_line_x * legs_4_line_x;
            let legs_4_length = Real::sqrt(
                legs_4_line_y * legs_4_line_y + legs_length_squared_with_legs_4_line_x,
            );
            let legs_4_length_inv = T::lit(1.0) / legs_4_length;
            let legs_line_by_rate_with_legs_4_line_x = platform_z_rate_times_legs_0_line_z
                + v.platform.x * legs_4_line_x;
            let legs_4_length_rate = legs_4_length_inv
                * (v.platform.y * legs_4_line_y + legs_line_by_rate_with_legs_4_line_x);
            let legs_4_length_inv_times_0_0625 = T::lit(0.0625) * legs_4_length_inv;
            let legs_4_swell = legs_4_length_inv_times_0_0625 - T::lit(0.1);
            let legs_4_length_inv_squared = legs_4_length_inv * legs_4_length_inv;
            let minus_legs_4_beta = legs_4_length_rate
                * (legs_4_length_inv_times_0_0625 + legs_4_swell)
                * legs_4_length_inv_squared;
            // Strut legs_5.
            let legs_5_line_y = T::lit(0.295) + q.platform.y;
            let legs_5_length = Real::sqrt(
                legs_5_line_y * legs_5_line_y + legs_length_squared_with_legs_4_line_x,
            );
            let legs_5_length_inv = T::lit(1.0) / legs_5_length;
            let legs_5_length_rate = legs_5_length_inv
                * (v.platform.y * legs_5_line_y + legs_line_by_rate_with_legs_4_line_x);
            let legs_5_length_inv_times_0_0625 = T::lit(0.0625) * legs_5_length_inv;
            let legs_5_swell = legs_5_length_inv_times_0_0625 - T::lit(0.1);
            let legs_5_length_inv_squared = legs_5_length_inv * legs_5_length_inv;
            let minus_legs_5_beta = legs_5_length_rate
                * (legs_5_length_inv_times_0_0625 + legs_5_swell)
                * legs_5_length_inv_squared;
            let side_with_legs_0_beta = minus_legs_0_beta + minus_legs_1_beta
                + minus_legs_2_beta + minus_legs_3_beta + minus_legs_4_beta
                + minus_legs_5_beta;
            // Strut legs_0.
            let legs_swing_with_platform_x_rate = v.platform.x * v.platform.x
                + v.platform.y * v.platform.y + v.platform.z * v.platform.z;
            let minus_legs_0_force = T::lit(0.05)
                * (legs_swing_with_platform_x_rate
                    - legs_0_length_rate * legs_0_length_rate)
                * legs_0_length_inv_squared - input.legs[0].thrust
                - self.legs_0_k * (self.legs_0_force_factor - legs_0_length)
                + legs_0_length_rate * (self.legs_0_c + minus_legs_0_beta);
            let minus_legs_0_force_by_length = legs_0_length_inv * minus_legs_0_force;
            let minus_legs_3_force = T::lit(0.05)
                * (legs_swing_with_platform_x_rate
                    - legs_3_length_rate * legs_3_length_rate)
                * legs_3_length_inv_squared - input.legs[3].thrust
                - self.legs_3_k * (self.legs_3_force_factor - legs_3_length)
                + legs_3_length_rate * (self.legs_3_c + minus_legs_3_beta);
            let minus_legs_3_force_by_length = legs_3_length_inv * minus_legs_3_force;
            let side_3_with_legs_0_force_by_length = minus_legs_0_force_by_length
                + minus_legs_3_force_by_length;
            let minus_legs_1_force = T::lit(0.05)
                * (legs_swing_with_platform_x_rate
                    - legs_1_length_rate * legs_1_length_rate)
                * legs_1_length_inv_squared - input.legs[1].thrust
                - self.legs_1_k * (self.legs_1_force_factor - legs_1_length)
                + legs_1_length_rate * (self.legs_1_c + minus_legs_1_beta);
            let minus_legs_1_force_by_length = legs_1_length_inv * minus_legs_1_force;
            let minus_legs_2_force = T::lit(0.05)
                * (legs_swing_with_platform_x_rate
                    - legs_2_length_rate * legs_2_length_rate)
                * legs_2_length_inv_squared - input.legs[2].thrust
                - self.legs_2_k * (self.legs_2_force_factor - legs_2_length)
                + legs_2_length_rate * (self.legs_2_c + minus_legs_2_beta);
            let minus_legs_2_force_by_length = legs_2_length_inv * minus_legs_2_force;
            let side_3_with_legs_1_force_by_length = minus_legs_1_force_by_length
                + minus_legs_2_force_by_length;
            let minus_legs_4_force = T::lit(0.05)
                * (legs_swing_with_platform_x_rate
                    - legs_4_length_rate * legs_4_length_rate)
                * legs_4_length_inv_squared - input.legs[4].thrust
                - self.legs_4_k * (self.legs_4_force_factor - legs_4_length)
                + legs_4_length_rate * (self.legs_4_c + minus_legs_4_beta);
            let minus_legs_4_force_by_length = legs_4_length_inv * minus_legs_4_force;
            let minus_legs_5_force = T::lit(0.05)
                * (legs_swing_with_platform_x_rate
                    - legs_5_length_rate * legs_5_length_rate)
                * legs_5_length_inv_squared - input.legs[5].thrust
                - self.legs_5_k * (self.legs_5_force_factor - legs_5_length)
                + legs_5_length_rate * (self.legs_5_c + minus_legs_5_beta);
            let minus_legs_5_force_by_length = legs_5_length_inv * minus_legs_5_force;
            let side_3_with_legs_4_force_by_length = minus_legs_4_force_by_length
                + minus_legs_5_force_by_length;
            let minus_body_force_x = legs_0_line_x * side_3_with_legs_0_force_by_length
                - v.platform.x * side_with_legs_0_beta
                + legs_1_line_x * side_3_with_legs_1_force_by_length
                + legs_4_line_x * side_3_with_legs_4_force_by_length;
            let legs_0_mu = legs_0_length_inv * legs_0_swell;
            let legs_1_mu = legs_1_length_inv * legs_1_swell;
            let legs_2_mu = legs_2_length_inv * legs_2_swell;
            let legs_3_mu = legs_3_length_inv * legs_3_swell;
            let legs_4_mu = legs_4_length_inv * legs_4_swell;
            let legs_5_mu = legs_5_length_inv * legs_5_swell;
            let body_and_struts_mass = T::lit(2.1) + legs_0_mu + legs_1_mu + legs_2_mu
                + legs_3_mu + legs_4_mu + legs_5_mu;
            let legs_0_nu = legs_0_mu * legs_0_length_inv_squared;
            let legs_0_nu_line_x = legs_0_line_x * legs_0_nu;
            let legs_3_nu = legs_3_mu * legs_3_length_inv_squared;
            let legs_3_nu_line_x = legs_0_line_x * legs_3_nu;
            let legs_0_nu_line_x_plus_legs_3_nu_line_x = legs_0_nu_line_x
                + legs_3_nu_line_x;
            let legs_1_nu = legs_1_mu * legs_1_length_inv_squared;
            let legs_1_nu_line_x = legs_1_line_x * legs_1_nu;
            let legs_2_nu = legs_2_mu * legs_2_length_inv_squared;
            let legs_2_nu_line_x = legs_1_line_x * legs_2_nu;
            let legs_1_nu_line_x_plus_legs_2_nu_line_x = legs_1_nu_line_x
                + legs_2_nu_line_x;
            let legs_4_nu = legs_4_mu * legs_4_length_inv_squared;
            let legs_4_nu_line_x = legs_4_line_x * legs_4_nu;
            let legs_5_nu = legs_5_mu * legs_5_length_inv_squared;
            let legs_5_nu_line_x = legs_4_line_x * legs_5_nu;
            // Factorisation L^T D L.
            let legs_4_nu_line_x_plus_legs_5_nu_line_x = legs_4_nu_line_x
                + legs_5_nu_line_x;
            let minus_pivot_1 = legs_0_line_x * legs_0_nu_line_x_plus_legs_3_nu_line_x
                - body_and_struts_mass
                + legs_1_line_x * legs_1_nu_line_x_plus_legs_2_nu_line_x
                + legs_4_line_x * legs_4_nu_line_x_plus_legs_5_nu_line_x;
            let minus_inverse_1 = T::lit(1.0) / minus_pivot_1;
            let minus_inertia_x_y = legs_0_line_y * legs_0_nu_line_x
                + legs_1_line_y * legs_1_nu_line_x + legs_2_line_y * legs_2_nu_line_x
                + legs_3_line_y * legs_3_nu_line_x + legs_4_line_y * legs_4_nu_line_x
                + legs_5_line_y * legs_5_nu_line_x;
            let l_1_2 = minus_inertia_x_y * minus_inverse_1;
            let minus_side_2 = legs_0_line_y * minus_legs_0_force_by_length
                + legs_1_line_y * minus_legs_1_force_by_length
                + legs_2_line_y * minus_legs_2_force_by_length
                + legs_3_line_y * minus_legs_3_force_by_length
                + legs_4_line_y * minus_legs_4_force_by_length
                + legs_5_line_y * minus_legs_5_force_by_length
                - minus_body_force_x * l_1_2 - v.platform.y * side_with_legs_0_beta;
            let legs_0_nu_line_y = legs_0_line_y * legs_0_nu;
            let legs_1_nu_line_y = legs_1_line_y * legs_1_nu;
            let legs_2_nu_line_y = legs_2_line_y * legs_2_nu;
            let legs_3_nu_line_y = legs_3_line_y * legs_3_nu;
            let legs_4_nu_line_y = legs_4_line_y * legs_4_nu;
            let legs_5_nu_line_y = legs_5_line_y * legs_5_nu;
            let minus_pivot_2 = legs_0_line_y * legs_0_nu_line_y
                + legs_1_line_y * legs_1_nu_line_y + legs_2_line_y * legs_2_nu_line_y
                + legs_3_line_y * legs_3_nu_line_y + legs_4_line_y * legs_4_nu_line_y
                - body_and_struts_mass + legs_5_line_y * legs_5_nu_line_y
                - minus_inertia_x_y * l_1_2;
            let minus_inverse_2 = T::lit(1.0) / minus_pivot_2;
            let pivot_3_with_legs_0_nu_line_x = legs_0_nu_line_x_plus_legs_3_nu_line_x
                + legs_1_nu_line_x_plus_legs_2_nu_line_x
                + legs_4_nu_line_x_plus_legs_5_nu_line_x;
            let pivot_3_with_legs_0_nu_line_y = legs_0_nu_line_y + legs_1_nu_line_y
                + legs_2_nu_line_y + legs_3_nu_line_y + legs_4_nu_line_y
                + legs_5_nu_line_y - l_1_2 * pivot_3_with_legs_0_nu_line_x;
            let l_2_3 = legs_0_line_z * minus_inverse_2 * pivot_3_with_legs_0_nu_line_y;
            let l_1_3 = legs_0_line_z * minus_inverse_1 * pivot_3_with_legs_0_nu_line_x;
            let minus_side_3 = T::lit(20.593965) - minus_body_force_x * l_1_3
                - minus_side_2 * l_2_3 - v.platform.z * side_with_legs_0_beta
                + legs_0_line_z
                    * (side_3_with_legs_0_force_by_length
                        + side_3_with_legs_1_force_by_length
                        + side_3_with_legs_4_force_by_length);
            let pivot_3_with_legs_0_line_z = legs_0_line_z
                * (legs_0_nu + legs_1_nu + legs_2_nu + legs_3_nu + legs_4_nu + legs_5_nu)
                - l_1_3 * pivot_3_with_legs_0_nu_line_x
                - l_2_3 * pivot_3_with_legs_0_nu_line_y;
            let minus_pivot_3 = legs_0_line_z * pivot_3_with_legs_0_line_z
                - body_and_struts_mass;
            // Results.
            let platform_z_accel = minus_side_3 / minus_pivot_3;
            let platform_y_accel = minus_side_2 * minus_inverse_2
                - l_2_3 * platform_z_accel;
            Velocity {
                platform: ::multibody::nalgebra::Vector3::from([
                    (minus_body_force_x * minus_inverse_1 - l_1_2 * platform_y_accel
                        - l_1_3 * platform_z_accel),
                    platform_y_accel,
                    platform_z_accel,
                ]),
            }
        }
        /// The inputs that produce the accelerations `accel`, in the place of what `input` says of them.
        ///
        /// Method: struts, moments about a point of the pins' plane.
        ///
        /// Operations: 154 add, 164 mul, 7 div, 6 sqrt, 3 other; as derived, before optimisation: 187 add, 183 mul, 7 div, 6 sqrt, 3 other.
        #[must_use]
        pub fn inverse_dynamics(
            &self,
            _t: T,
            state: &State<T>,
            input: &Input<T>,
            accel: &Velocity<T>,
        ) -> Solved<T> {
            let q = &state.q;
            let v = &state.v;
            // Strut legs_0.
            let legs_0_line_y = q.platform.y - T::lit(0.779);
            let legs_0_line_x = T::lit(2.29) + q.platform.x;
            let legs_0_line_z = q.platform.z - T::lit(0.4);
            let legs_0_line_z_squared = legs_0_line_z * legs_0_line_z;
            let legs_0_line_x_squared_plus_z_squared = legs_0_line_x * legs_0_line_x
                + legs_0_line_z_squared;
            let legs_0_length = Real::sqrt(
                legs_0_line_y * legs_0_line_y + legs_0_line_x_squared_plus_z_squared,
            );
            let legs_0_length_inv = T::lit(1.0) / legs_0_length;
            let legs_0_length_inv_times_0_0625 = T::lit(0.0625) * legs_0_length_inv;
            let legs_0_swell = legs_0_length_inv_times_0_0625 - T::lit(0.1);
            // Results.
            let platform_z_accel_times_legs_0_line_z = accel.platform.z * legs_0_line_z;
            let legs_thrust_with_platform_x_accel = accel.platform.x * legs_0_line_x
                + platform_z_accel_times_legs_0_line_z;
            let legs_thrust_with_platform_x_rate = T::lit(0.05)
                * (v.platform.x * v.platform.x + v.platform.y * v.platform.y
                    + v.platform.z * v.platform.z);
            // Strut legs_0.
            let platform_z_rate_times_legs_0_line_z = v.platform.z * legs_0_line_z;
            let legs_line_by_rate_with_platform_x_rate = v.platform.x * legs_0_line_x
                + platform_z_rate_times_legs_0_line_z;
            let legs_0_length_rate = legs_0_length_inv
                * (v.platform.y * legs_0_line_y
                    + legs_line_by_rate_with_platform_x_rate);
            let legs_0_bend = legs_0_length_inv_times_0_0625 + legs_0_swell;
            let legs_0_length_inv_squared = legs_0_length_inv * legs_0_length_inv;
            let legs_0_mu = legs_0_length_inv * legs_0_swell;
            // Strut legs_3.
            let legs_3_line_y = T::lit(0.779) + q.platform.y;
            let legs_3_length = Real::sqrt(
                legs_3_line_y * legs_3_line_y + legs_0_line_x_squared_plus_z_squared,
            );
            let legs_3_length_inv = T::lit(1.0) / legs_3_length;
            let legs_3_length_inv_times_0_0625 = T::lit(0.0625) * legs_3_length_inv;
            let legs_3_swell = legs_3_length_inv_times_0_0625 - T::lit(0.1);
            let legs_3_mu = legs_3_length_inv * legs_3_swell;
            let legs_0_mu_plus_legs_3_mu = legs_0_mu + legs_3_mu;
            // Strut legs_1.
            let legs_1_line_y = q.platform.y - T::lit(1.074);
            let legs_1_line_x = T::lit(1.78) + q.platform.x;
            let legs_length_squared_with_legs_0_line_z = legs_0_line_z_squared
                + legs_1_line_x * legs_1_line_x;
            let legs_1_length = Real::sqrt(
                legs_1_line_y * legs_1_line_y + legs_length_squared_with_legs_0_line_z,
            );
            let legs_1_length_inv = T::lit(1.0) / legs_1_length;
            let legs_1_length_inv_times_0_0625 = T::lit(0.0625) * legs_1_length_inv;
            let legs_1_swell = legs_1_length_inv_times_0_0625 - T::lit(0.1);
            let legs_1_mu = legs_1_length_inv * legs_1_swell;
            // Strut legs_2.
            let legs_2_line_y = T::lit(1.074) + q.platform.y;
            let legs_2_length = Real::sqrt(
                legs_2_line_y * legs_2_line_y + legs_length_squared_with_legs_0_line_z,
            );
            let legs_2_length_inv = T::lit(1.0) / legs_2_length;
            let legs_2_length_inv_times_0_0625 = T::lit(0.0625) * legs_2_length_inv;
            let legs_2_swell = legs_2_length_inv_times_0_0625 - T::lit(0.1);
            let legs_2_mu = legs_2_length_inv * legs_2_swell;
            let legs_1_mu_plus_legs_2_mu = legs_1_mu + legs_2_mu;
            // Strut legs_4.
            let legs_4_line_y = q.platform.y - T::lit(0.295);
            let legs_4_line_x = T::lit(43.0 / 100.0) + q.platform.x;
            let legs_length_squared_with_legs_4_line_x = legs_0_line_z_squared
                + legs_4_line_x * legs_4_line_x;
            let legs_4_length = Real::sqrt(
                legs_4_line_y * legs_4_line_y + legs_length_squared_with_legs_4_line_x,
            );
            let legs_4_length_inv = T::lit(1.0) / legs_4_length;
            let legs_4_length_inv_times_0_0625 = T::lit(0.0625) * legs_4_length_inv;
            let legs_4_swell = legs_4_length_inv_times_0_0625 - T::lit(0.1);
            let legs_4_mu = legs_4_length_inv * legs_4_swell;
            // Strut legs_5.
            let legs_5_line_y = T::lit(0.295) + q.platform.y;
            let legs_5_length = Real::sqrt(
                legs_5_line_y * legs_5_line_y + legs_length_squared_with_legs_4_line_x,
            );
            let legs_5_length_inv = T::lit(1.0) / legs_5_length;
            let legs_5_length_inv_times_0_0625 = T::lit(0.0625) * legs_5_length_inv;
            let legs_5_swell = legs_5_length_inv_times_0_0625 - T::lit(0.1);
            let legs_5_mu = legs_5_length_inv * legs_5_swell;
            let legs_4_mu_plus_legs_5_mu = legs_4_mu + legs_5_mu;
            let legs_tension_with_legs_0_mu = T::lit(2.1) + legs_0_mu_plus_legs_3_mu
                + legs_1_mu_plus_legs_2_mu + legs_4_mu_plus_legs_5_mu;
            let minus_legs_0_beta = legs_0_length_rate * legs_0_bend
                * legs_0_length_inv_squared;
            // Strut legs_3.
            let legs_3_length_rate = legs_3_length_inv
                * (v.platform.y * legs_3_line_y
                    + legs_line_by_rate_with_platform_x_rate);
            let legs_3_bend = legs_3_length_inv_times_0_0625 + legs_3_swell;
            let legs_3_length_inv_squared = legs_3_length_inv * legs_3_length_inv;
            let minus_legs_3_beta = legs_3_length_rate * legs_3_bend
                * legs_3_length_inv_squared;
            let minus_legs_0_beta_plus_minus_legs_3_beta = minus_legs_0_beta
                + minus_legs_3_beta;
            // Strut legs_1.
            let legs_line_by_rate_with_legs_1_line_x = platform_z_rate_times_legs_0_line_z
                + v.platform.x * legs_1_line_x;
            let legs_1_length_rate = legs_1_length_inv
                * (v.platform.y * legs_1_line_y + legs_line_by_rate_with_legs_1_line_x);
            let legs_1_bend = legs_1_length_inv_times_0_0625 + legs_1_swell;
            let legs_1_length_inv_squared = legs_1_length_inv * legs_1_length_inv;
            let minus_legs_1_beta = legs_1_length_rate * legs_1_bend
                * legs_1_length_inv_squared;
            // Strut legs_2.
            let legs_2_length_rate = legs_2_length_inv
                * (v.platform.y * legs_2_line_y + legs_line_by_rate_with_legs_1_line_x);
            let legs_2_bend = legs_2_length_inv_times_0_0625 + legs_2_swell;
            let legs_2_length_inv_squared = legs_2_length_inv * legs_2_length_inv;
            let minus_legs_2_beta = legs_2_length_rate * legs_2_bend
                * legs_2_length_inv_squared;
            let minus_legs_1_beta_plus_minus_legs_2_beta = minus_legs_1_beta
                + minus_legs_2_beta;
            // Strut legs_4.
            let legs_line_by_rate_with_legs_4_line_x = platform_z_rate_times_legs_0_line_z
                + v.platform.x * legs_4_line_x;
            let legs_4_length_rate = legs_4_length_inv
                * (v.platform.y * legs_4_line_y + legs_line_by_rate_with_legs_4_line_x);
            let legs_4_bend = legs_4_length_inv_times_0_0625 + legs_4_swell;
            let legs_4_length_inv_squared = legs_4_length_inv * legs_4_length_inv;
            let minus_legs_4_beta = legs_4_length_rate * legs_4_bend
                * legs_4_length_inv_squared;
            // Strut legs_5.
            let legs_5_length_rate = legs_5_length_inv
                * (v.platform.y * legs_5_line_y + legs_line_by_rate_with_legs_4_line_x);
            let legs_5_bend = legs_5_length_inv_times_0_0625 + legs_5_swell;
            let legs_5_length_inv_squared = legs_5_length_inv * legs_5_length_inv;
            let minus_legs_5_beta = legs_5_length_rate * legs_5_bend
                * legs_5_length_inv_squared;
            // Balance of the body on its struts.
            let minus_legs_4_beta_plus_minus_legs_5_beta = minus_legs_4_beta
                + minus_legs_5_beta;
            let minus_mass_struts_beta = minus_legs_0_beta_plus_minus_legs_3_beta
                + minus_legs_1_beta_plus_minus_legs_2_beta
                + minus_legs_4_beta_plus_minus_legs_5_beta;
            let abs_legs_0_line_z = Real::abs(legs_0_line_z);
            let rank_0_part = T::lit(450.0) * <T as Real>::epsilon();
            let legs_tension_with_legs_0_line_z = Real::select(
                Real::le(abs_legs_0_line_z, rank_0_part),
                T::lit(0.0),
                T::lit(1.0) / legs_0_line_z,
            );
            let legs_tension_with_platform_z_accel = (T::lit(20.593965)
                + accel.platform.z * legs_tension_with_legs_0_mu
                - v.platform.z * minus_mass_struts_beta)
                * legs_tension_with_legs_0_line_z;
            let legs_tension_with_platform_x_accel = accel.platform.x
                * legs_tension_with_legs_0_mu - v.platform.x * minus_mass_struts_beta
                - q.platform.x * legs_tension_with_platform_z_accel;
            let first_struts_mu_x = T::lit(0.17) * legs_0_mu_plus_legs_3_mu
                - T::lit(0.6) * legs_1_mu_plus_legs_2_mu
                + T::lit(43.0 / 100.0) * legs_4_mu_plus_legs_5_mu;
            let minus_first_struts_beta_x = T::lit(0.17)
                * minus_legs_0_beta_plus_minus_legs_3_beta
                - T::lit(0.6) * minus_legs_1_beta_plus_minus_legs_2_beta
                + T::lit(43.0 / 100.0) * minus_legs_4_beta_plus_minus_legs_5_beta;
            let legs_tension_with_first_struts_mu_x = (accel.platform.z
                * first_struts_mu_x - T::lit(0.6) * accel.platform.x
                - v.platform.z * minus_first_struts_beta_x)
                * legs_tension_with_legs_0_line_z;
            let legs_tension_with_platform_x_rate = T::lit(0.32911554192229037)
                * legs_tension_with_platform_x_accel
                - T::lit(0.3270066462167689) * legs_tension_with_platform_z_accel
                + T::lit(0.4313650306748466) * legs_tension_with_first_struts_mu_x;
            let legs_tension_with_platform_y_accel = accel.platform.y
                * legs_tension_with_legs_0_mu - v.platform.y * minus_mass_struts_beta
                - q.platform.y * legs_tension_with_platform_z_accel;
            let first_struts_mu_y = T::lit(0.595) * (legs_0_mu - legs_3_mu)
                + T::lit(0.15) * (legs_1_mu - legs_2_mu)
                - T::lit(0.445) * (legs_4_mu - legs_5_mu);
            let minus_first_struts_beta_y = T::lit(0.595)
                * (minus_legs_0_beta - minus_legs_3_beta)
                + T::lit(0.15) * (minus_legs_1_beta - minus_legs_2_beta)
                - T::lit(0.445) * (minus_legs_4_beta - minus_legs_5_beta);
            let legs_tension_with_first_struts_mu_y = (accel.platform.z
                * first_struts_mu_y - T::lit(0.6) * accel.platform.y
                - v.platform.z * minus_first_struts_beta_y)
                * legs_tension_with_legs_0_line_z;
            let legs_tension_with_platform_y_rate = accel.platform.y * first_struts_mu_x
                - v.platform.y * minus_first_struts_beta_x
                - accel.platform.x * first_struts_mu_y
                + v.platform.x * minus_first_struts_beta_y
                + q.platform.x * legs_tension_with_first_struts_mu_y
                - q.platform.y * legs_tension_with_first_struts_mu_x;
            let legs_tension_with_first_struts_beta_x = T::lit(0.27656702878509637)
                * legs_tension_with_platform_y_rate;
            let legs_tension_with_mass_struts_beta = T::lit(0.09407346608210052)
                * legs_tension_with_platform_y_accel
                - T::lit(0.022276627275462778) * legs_tension_with_first_struts_mu_y
                + legs_tension_with_first_struts_beta_x;
            let minus_legs_0_thrust = (legs_0_swell
                * (accel.platform.y * legs_0_line_y + legs_thrust_with_platform_x_accel)
                - legs_thrust_with_platform_x_rate
                - legs_0_length_rate * legs_0_length_rate * (legs_0_bend - T::lit(0.05)))
                * legs_0_length_inv_squared
                + legs_0_length
                    * (legs_tension_with_mass_struts_beta
                        - legs_tension_with_platform_x_rate)
                - self.legs_0_c * legs_0_length_rate
                + self.legs_0_k * (self.legs_0_force_factor - legs_0_length);
            let legs_thrust_with_legs_1_line_x = platform_z_accel_times_legs_0_line_z
                + accel.platform.x * legs_1_line_x;
            let legs_tension_with_platform_z_rate = T::lit(0.2601930192065932)
                * legs_tension_with_first_struts_mu_y
                - T::lit(0.33202481420439073) * legs_tension_with_platform_y_accel
                + legs_tension_with_first_struts_beta_x;
            let legs_tension_with_platform_x = T::lit(0.08307770961145194)
                * legs_tension_with_platform_x_accel
                - T::lit(0.2912832310838446) * legs_tension_with_platform_z_accel
                + T::lit(0.5943251533742331) * legs_tension_with_first_struts_mu_x;
            // Results.
            let legs_1_thrust = (legs_thrust_with_platform_x_rate
                - legs_1_swell
                    * (accel.platform.y * legs_1_line_y + legs_thrust_with_legs_1_line_x)
                + legs_1_length_rate * legs_1_length_rate * (legs_1_bend - T::lit(0.05)))
                * legs_1_length_inv_squared
                + legs_1_length
                    * (legs_tension_with_platform_z_rate - legs_tension_with_platform_x)
                + self.legs_1_c * legs_1_length_rate
                - self.legs_1_k * (self.legs_1_force_factor - legs_1_length);
            let legs_2_thrust = (legs_thrust_with_platform_x_rate
                - legs_2_swell
                    * (accel.platform.y * legs_2_line_y + legs_thrust_with_legs_1_line_x)
                + legs_2_length_rate * legs_2_length_rate * (legs_2_bend - T::lit(0.05)))
                * legs_2_length_inv_squared
                - legs_2_length
                    * (legs_tension_with_platform_z_rate + legs_tension_with_platform_x)
                + self.legs_2_c * legs_2_length_rate
                - self.legs_2_k * (self.legs_2_force_factor - legs_2_length);
            let legs_3_thrust = (legs_thrust_with_platform_x_rate
                - legs_3_swell
                    * (accel.platform.y * legs_3_line_y
                        + legs_thrust_with_platform_x_accel)
                + legs_3_length_rate * legs_3_length_rate * (legs_3_bend - T::lit(0.05)))
                * legs_3_length_inv_squared
                + legs_3_length
                    * (legs_tension_with_platform_x_rate
                        + legs_tension_with_mass_struts_beta)
                + self.legs_3_c * legs_3_length_rate
                - self.legs_3_k * (self.legs_3_force_factor - legs_3_length);
            let legs_thrust_with_legs_4_line_x = platform_z_accel_times_legs_0_line_z
                + accel.platform.x * legs_4_line_x;
            let legs_tension_with_platform_y = T::lit(0.23770209988653576)
                * legs_tension_with_platform_y_accel
                + T::lit(1.0061043907642937) * legs_tension_with_first_struts_mu_y
                + legs_tension_with_first_struts_beta_x;
            let legs_tension_with_legs_3_mu = T::lit(0.5357234151329243)
                * legs_tension_with_platform_z_accel
                - T::lit(0.24603783231083845) * legs_tension_with_platform_x_accel
                + T::lit(0.1629601226993865) * legs_tension_with_first_struts_mu_x;
            let legs_4_thrust = (legs_thrust_with_platform_x_rate
                - legs_4_swell
                    * (accel.platform.y * legs_4_line_y + legs_thrust_with_legs_4_line_x)
                + legs_4_length_rate * legs_4_length_rate * (legs_4_bend - T::lit(0.05)))
                * legs_4_length_inv_squared
                - legs_4_length
                    * (legs_tension_with_platform_y - legs_tension_with_legs_3_mu)
                + self.legs_4_c * legs_4_length_rate
                - self.legs_4_k * (self.legs_4_force_factor - legs_4_length);
            let legs_5_thrust = (legs_thrust_with_platform_x_rate
                - legs_5_swell
                    * (accel.platform.y * legs_5_line_y + legs_thrust_with_legs_4_line_x)
                + legs_5_length_rate * legs_5_length_rate * (legs_5_bend - T::lit(0.05)))
                * legs_5_length_inv_squared
                + legs_5_length
                    * (legs_tension_with_platform_y + legs_tension_with_legs_3_mu)
                + self.legs_5_c * legs_5_length_rate
                - self.legs_5_k * (self.legs_5_force_factor - legs_5_length);
            let mut solved = *input;
            solved.legs[0].thrust = -minus_legs_0_thrust;
            solved.legs[1].thrust = legs_1_thrust;
            solved.legs[2].thrust = legs_2_thrust;
            solved.legs[3].thrust = legs_3_thrust;
            solved.legs[4].thrust = legs_4_thrust;
            solved.legs[5].thrust = legs_5_thrust;
            Solved {
                input: solved,
                rank: T::lit(3.0)
                    + T::lit(3.0)
                        * Real::select(
                            Real::lt(rank_0_part, abs_legs_0_line_z),
                            T::lit(1.0),
                            T::lit(0.0),
                        ),
            }
        }
        /// Distances from dead centres, in the order of `DEAD_CENTRES`. Of a loop's solution: its square root, a product of lengths, zero where two solutions meet and NaN where the loop cannot be closed. Of roll, pitch and yaw: the cosine of the pitch, zero where roll and yaw turn about one axis. Rates grow without bound there.
        ///
        /// Method: closed forms.
        ///
        /// Operations: 31 add, 25 mul, 12 sqrt; as derived, before optimisation: 42 add, 25 mul, 12 sqrt.
        #[must_use]
        pub fn dead_centres(
            &self,
            _t: T,
            q: &Position<T>,
        ) -> ::multibody::nalgebra::SVector<T, 12> {
            // Closed form of legs_0_gimbal_first.
            let platform_y_minus_0_779 = q.platform.y - T::lit(0.779);
            let platform_x_plus_2_29 = T::lit(2.29) + q.platform.x;
            let minus_legs_0_gimbal_first_b = q.platform.z - T::lit(0.4);
            let legs_0_gimbal_first_b_squared = minus_legs_0_gimbal_first_b
                * minus_legs_0_gimbal_first_b;
            let legs_stroke_discriminant_with_legs_0_gimbal_first_b = platform_x_plus_2_29
                * platform_x_plus_2_29 + legs_0_gimbal_first_b_squared;
            let legs_gimbal_first_a_with_platform_x = T::lit(0.6816387600233341)
                * platform_x_plus_2_29;
            let minus_legs_0_gimbal_first_a = T::lit(0.7316888688738209)
                * platform_y_minus_0_779 + legs_gimbal_first_a_with_platform_x;
            // Closed form of legs_1_stroke.
            let platform_y_minus_1_074 = q.platform.y - T::lit(1.074);
            let platform_x_plus_1_78 = T::lit(1.78) + q.platform.x;
            let legs_stroke_discriminant_with_platform_x = legs_0_gimbal_first_b_squared
                + platform_x_plus_1_78 * platform_x_plus_1_78;
            let legs_gimbal_first_a_part = T::lit(0.5226872289306592)
                * platform_x_plus_1_78;
            let minus_legs_1_gimbal_first_a = T::lit(0.8525245220595058)
                * platform_y_minus_1_074 + legs_gimbal_first_a_part;
            let platform_y_plus_1_074 = T::lit(1.074) + q.platform.y;
            let legs_2_gimbal_first_a = legs_gimbal_first_a_part
                - T::lit(0.8525245220595058) * platform_y_plus_1_074;
            let platform_y_plus_0_779 = T::lit(0.779) + q.platform.y;
            let legs_3_gimbal_first_a = legs_gimbal_first_a_with_platform_x
                - T::lit(0.7316888688738209) * platform_y_plus_0_779;
            // Closed form of legs_4_stroke.
            let platform_y_minus_0_295 = q.platform.y - T::lit(0.295);
            let platform_x_plus_0_43 = T::lit(43.0 / 100.0) + q.platform.x;
            let legs_stroke_discriminant_part = legs_0_gimbal_first_b_squared
                + platform_x_plus_0_43 * platform_x_plus_0_43;
            let legs_gimbal_first_a_part_v2 = T::lit(0.2874780123425445)
                * platform_x_plus_0_43;
            let minus_legs_4_gimbal_first_a = legs_gimbal_first_a_part_v2
                - T::lit(0.9577872375530903) * platform_y_minus_0_295;
            let platform_y_plus_0_295 = T::lit(0.295) + q.platform.y;
            // Closed form of legs_5_gimbal_first.
            let legs_5_gimbal_first_a = legs_gimbal_first_a_part_v2
                + T::lit(0.9577872375530903) * platform_y_plus_0_295;
            ::multibody::nalgebra::SVector::from([
                Real::sqrt(
                    platform_y_minus_0_779 * platform_y_minus_0_779
                        + legs_stroke_discriminant_with_legs_0_gimbal_first_b,
                ),
                Real::sqrt(
                    legs_0_gimbal_first_b_squared
                        + minus_legs_0_gimbal_first_a * minus_legs_0_gimbal_first_a,
                ),
                Real::sqrt(
                    platform_y_minus_1_074 * platform_y_minus_1_074
                        + legs_stroke_discriminant_with_platform_x,
                ),
                Real::sqrt(
                    legs_0_gimbal_first_b_squared
                        + minus_legs_1_gimbal_first_a * minus_legs_1_gimbal_first_a,
                ),
                Real::sqrt(
                    platform_y_plus_1_074 * platform_y_plus_1_074
                        + legs_stroke_discriminant_with_platform_x,
                ),
                Real::sqrt(
                    legs_0_gimbal_first_b_squared
                        + legs_2_gimbal_first_a * legs_2_gimbal_first_a,
                ),
                Real::sqrt(
                    platform_y_plus_0_779 * platform_y_plus_0_779
                        + legs_stroke_discriminant_with_legs_0_gimbal_first_b,
                ),
                Real::sqrt(
                    legs_0_gimbal_first_b_squared
                        + legs_3_gimbal_first_a * legs_3_gimbal_first_a,
                ),
                Real::sqrt(
                    platform_y_minus_0_295 * platform_y_minus_0_295
                        + legs_stroke_discriminant_part,
                ),
                Real::sqrt(
                    legs_0_gimbal_first_b_squared
                        + minus_legs_4_gimbal_first_a * minus_legs_4_gimbal_first_a,
                ),
                Real::sqrt(
                    platform_y_plus_0_295 * platform_y_plus_0_295
                        + legs_stroke_discriminant_part,
                ),
                Real::sqrt(
                    legs_0_gimbal_first_b_squared
                        + legs_5_gimbal_first_a * legs_5_gimbal_first_a,
                ),
            ])
        }
        /// For integrators, at a state whose guess is the solution: how far loops are from dead centres (the root of a closed form, the determinant of what Newton's method solves), each followed by the rate of its square; then the greatest residual of Newton's method, if it closes loops.
        ///
        /// Method: closed forms, determinants.
        ///
        /// Operations: 52 add, 60 mul, 12 sqrt; as derived, before optimisation: 66 add, 60 mul, 12 sqrt.
        #[must_use]
        pub fn margins(
            &self,
            _t: T,
            state: &State<T>,
        ) -> ::multibody::nalgebra::SVector<T, 24> {
            let q = &state.q;
            let v = &state.v;
            // Closed form of legs_0_gimbal_first.
            let platform_y_minus_0_779 = q.platform.y - T::lit(0.779);
            let platform_x_plus_2_29 = T::lit(2.29) + q.platform.x;
            let minus_legs_0_gimbal_first_b = q.platform.z - T::lit(0.4);
            let legs_0_gimbal_first_b_squared = minus_legs_0_gimbal_first_b
                * minus_legs_0_gimbal_first_b;
            let legs_stroke_discriminant_with_legs_0_gimbal_first_b = platform_x_plus_2_29
                * platform_x_plus_2_29 + legs_0_gimbal_first_b_squared;
            let legs_stroke_gap_rate_with_platform_z_rate = v.platform.z
                * minus_legs_0_gimbal_first_b;
            let legs_stroke_gap_rate_with_platform_x_rate = v.platform.x
                * platform_x_plus_2_29 + legs_stroke_gap_rate_with_platform_z_rate;
            let legs_gimbal_first_a_with_platform_x = T::lit(0.6816387600233341)
                * platform_x_plus_2_29;
            let minus_legs_0_gimbal_first_a = T::lit(0.7316888688738209)
                * platform_y_minus_0_779 + legs_gimbal_first_a_with_platform_x;
            // Results.
            let margin_with_platform_z_rate = T::lit(2.0)
                * legs_stroke_gap_rate_with_platform_z_rate;
            let platform_x_rate_times_0_682 = T::lit(0.6816387600233341) * v.platform.x;
            let platform_y_rate_times_0_732 = T::lit(0.7316888688738209) * v.platform.y;
            // Closed form of legs_1_stroke.
            let platform_y_minus_1_074 = q.platform.y - T::lit(1.074);
            let platform_x_plus_1_78 = T::lit(1.78) + q.platform.x;
            let legs_stroke_discriminant_with_platform_x = legs_0_gimbal_first_b_squared
                + platform_x_plus_1_78 * platform_x_plus_1_78;
            let legs_stroke_gap_rate_with_legs_0_gimbal_first_b = legs_stroke_gap_rate_with_platform_z_rate
                + v.platform.x * platform_x_plus_1_78;
            let legs_gimbal_first_a_part = T::lit(0.5226872289306592)
                * platform_x_plus_1_78;
            let minus_legs_1_gimbal_first_a = T::lit(0.8525245220595058)
                * platform_y_minus_1_074 + legs_gimbal_first_a_part;
            let platform_x_rate_times_0_523 = T::lit(0.5226872289306592) * v.platform.x;
            let platform_y_rate_times_0_853 = T::lit(0.8525245220595058) * v.platform.y;
            let platform_y_plus_1_074 = T::lit(1.074) + q.platform.y;
            let legs_2_gimbal_first_a = legs_gimbal_first_a_part
                - T::lit(0.8525245220595058) * platform_y_plus_1_074;
            let platform_y_plus_0_779 = T::lit(0.779) + q.platform.y;
            let legs_3_gimbal_first_a = legs_gimbal_first_a_with_platform_x
                - T::lit(0.7316888688738209) * platform_y_plus_0_779;
            // Closed form of legs_4_stroke.
            let platform_y_minus_0_295 = q.platform.y - T::lit(0.295);
            let platform_x_plus_0_43 = T::lit(43.0 / 100.0) + q.platform.x;
            let legs_stroke_discriminant_part = legs_0_gimbal_first_b_squared
                + platform_x_plus_0_43 * platform_x_plus_0_43;
            let legs_stroke_gap_rate_with_platform_x = legs_stroke_gap_rate_with_platform_z_rate
                + v.platform.x * platform_x_plus_0_43;
            let legs_gimbal_first_a_part_v2 = T::lit(0.2874780123425445)
                * platform_x_plus_0_43;
            let minus_legs_4_gimbal_first_a = legs_gimbal_first_a_part_v2
                - T::lit(0.9577872375530903) * platform_y_minus_0_295;
            let platform_x_rate_times_0_287 = T::lit(0.2874780123425445) * v.platform.x;
            let platform_y_rate_times_0_958 = T::lit(0.9577872375530903) * v.platform.y;
            let platform_y_plus_0_295 = T::lit(0.295) + q.platform.y;
            // Closed form of legs_5_gimbal_first.
            let legs_5_gimbal_first_a = legs_gimbal_first_a_part_v2
                + T::lit(0.9577872375530903) * platform_y_plus_0_295;
            ::multibody::nalgebra::SVector::from([
                Real::sqrt(
                    platform_y_minus_0_779 * platform_y_minus_0_779
                        + legs_stroke_discriminant_with_legs_0_gimbal_first_b,
                ),
                (T::lit(2.0)
                    * (v.platform.y * platform_y_minus_0_779
                        + legs_stroke_gap_rate_with_platform_x_rate)),
                Real::sqrt(
                    legs_0_gimbal_first_b_squared
                        + minus_legs_0_gimbal_first_a * minus_legs_0_gimbal_first_a,
                ),
                (margin_with_platform_z_rate
                    + T::lit(2.0) * minus_legs_0_gimbal_first_a
                        * (platform_x_rate_times_0_682 + platform_y_rate_times_0_732)),
                Real::sqrt(
                    platform_y_minus_1_074 * platform_y_minus_1_074
                        + legs_stroke_discriminant_with_platform_x,
                ),
                (T::lit(2.0)
                    * (v.platform.y * platform_y_minus_1_074
                        + legs_stroke_gap_rate_with_legs_0_gimbal_first_b)),
                Real::sqrt(
                    legs_0_gimbal_first_b_squared
                        + minus_legs_1_gimbal_first_a * minus_legs_1_gimbal_first_a,
                ),
                (margin_with_platform_z_rate
                    + T::lit(2.0) * minus_legs_1_gimbal_first_a
                        * (platform_x_rate_times_0_523 + platform_y_rate_times_0_853)),
                Real::sqrt(
                    platform_y_plus_1_074 * platform_y_plus_1_074
                        + legs_stroke_discriminant_with_platform_x,
                ),
                (T::lit(2.0)
                    * (v.platform.y * platform_y_plus_1_074
                        + legs_stroke_gap_rate_with_legs_0_gimbal_first_b)),
                Real::sqrt(
                    legs_0_gimbal_first_b_squared
                        + legs_2_gimbal_first_a * legs_2_gimbal_first_a,
                ),
                (margin_with_platform_z_rate
                    + T::lit(2.0) * legs_2_gimbal_first_a
                        * (platform_x_rate_times_0_523 - platform_y_rate_times_0_853)),
                Real::sqrt(
                    platform_y_plus_0_779 * platform_y_plus_0_779
                        + legs_stroke_discriminant_with_legs_0_gimbal_first_b,
                ),
                (T::lit(2.0)
                    * (v.platform.y * platform_y_plus_0_779
                        + legs_stroke_gap_rate_with_platform_x_rate)),
                Real::sqrt(
                    legs_0_gimbal_first_b_squared
                        + legs_3_gimbal_first_a * legs_3_gimbal_first_a,
                ),
                (margin_with_platform_z_rate
                    + T::lit(2.0) * legs_3_gimbal_first_a
                        * (platform_x_rate_times_0_682 - platform_y_rate_times_0_732)),
                Real::sqrt(
                    platform_y_minus_0_295 * platform_y_minus_0_295
                        + legs_stroke_discriminant_part,
                ),
                (T::lit(2.0)
                    * (v.platform.y * platform_y_minus_0_295
                        + legs_stroke_gap_rate_with_platform_x)),
                Real::sqrt(
                    legs_0_gimbal_first_b_squared
                        + minus_legs_4_gimbal_first_a * minus_legs_4_gimbal_first_a,
                ),
                (margin_with_platform_z_rate
                    + T::lit(2.0) * minus_legs_4_gimbal_first_a
                        * (platform_x_rate_times_0_287 - platform_y_rate_times_0_958)),
                Real::sqrt(
                    platform_y_plus_0_295 * platform_y_plus_0_295
                        + legs_stroke_discriminant_part,
                ),
                (T::lit(2.0)
                    * (v.platform.y * platform_y_plus_0_295
                        + legs_stroke_gap_rate_with_platform_x)),
                Real::sqrt(
                    legs_0_gimbal_first_b_squared
                        + legs_5_gimbal_first_a * legs_5_gimbal_first_a,
                ),
                (margin_with_platform_z_rate
                    + T::lit(2.0) * legs_5_gimbal_first_a
                        * (platform_x_rate_times_0_287 + platform_y_rate_times_0_958)),
            ])
        }
    }
    impl<T: Real> Default for Model<T> {
        fn default() -> Self {
            Self::new(&Params::default())
        }
    }
    impl<T: Real> Model<T> {
        /// Not derived: `emit mass_matrix` in the model asks for it.
        #[doc(hidden)]
        #[must_use]
        pub fn mass_matrix<A: ::multibody::emitted::MassMatrix>(
            &self,
            _q: &A,
        ) -> A::Result {
            A::never()
        }
        /// Not derived: `emit bias` in the model asks for it.
        #[doc(hidden)]
        #[must_use]
        pub fn bias<A: ::multibody::emitted::Bias>(
            &self,
            _t: T,
            _state: &A,
            _input: &Input<T>,
        ) -> A::Result {
            A::never()
        }
        /// Not derived: `emit energy` in the model asks for it.
        #[doc(hidden)]
        #[must_use]
        pub fn kinetic_energy<A: ::multibody::emitted::Energy>(
            &self,
            _state: &A,
        ) -> A::Result {
            A::never()
        }
        /// Not derived: `emit energy` in the model asks for it.
        #[doc(hidden)]
        #[must_use]
        pub fn potential_energy<A: ::multibody::emitted::Energy>(
            &self,
            _q: &A,
        ) -> A::Result {
            A::never()
        }
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
        /// The model has no `output`.
        #[doc(hidden)]
        #[must_use]
        pub fn outputs<A: ::multibody::emitted::Outputs>(
            &self,
            _t: T,
            _state: &A,
            _input: &Input<T>,
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
        fn margins(
            &self,
            t: T,
            state: &State<T>,
            _input: &Input<T>,
            visit: &mut dyn FnMut(::multibody::Margin<T>),
        ) -> T {
            let margins = self.margins(t, state);
            visit(::multibody::Margin {
                coordinate: "legs[0].stroke",
                root: margins[0],
                rate: margins[1],
            });
            visit(::multibody::Margin {
                coordinate: "legs[0].gimbal.first",
                root: margins[2],
                rate: margins[3],
            });
            visit(::multibody::Margin {
                coordinate: "legs[1].stroke",
                root: margins[4],
                rate: margins[5],
            });
            visit(::multibody::Margin {
                coordinate: "legs[1].gimbal.first",
                root: margins[6],
                rate: margins[7],
            });
            visit(::multibody::Margin {
                coordinate: "legs[2].stroke",
                root: margins[8],
                rate: margins[9],
            });
            visit(::multibody::Margin {
                coordinate: "legs[2].gimbal.first",
                root: margins[10],
                rate: margins[11],
            });
            visit(::multibody::Margin {
                coordinate: "legs[3].stroke",
                root: margins[12],
                rate: margins[13],
            });
            visit(::multibody::Margin {
                coordinate: "legs[3].gimbal.first",
                root: margins[14],
                rate: margins[15],
            });
            visit(::multibody::Margin {
                coordinate: "legs[4].stroke",
                root: margins[16],
                rate: margins[17],
            });
            visit(::multibody::Margin {
                coordinate: "legs[4].gimbal.first",
                root: margins[18],
                rate: margins[19],
            });
            visit(::multibody::Margin {
                coordinate: "legs[5].stroke",
                root: margins[20],
                rate: margins[21],
            });
            visit(::multibody::Margin {
                coordinate: "legs[5].gimbal.first",
                root: margins[22],
                rate: margins[23],
            });
            T::lit(0.0)
        }
        fn without_inertia(
            &self,
            _t: T,
            state: &State<T>,
            _input: &Input<T>,
        ) -> Option<&'static str> {
            let q = &state.q;
            // Closed form of legs_0_gimbal_first.
            let minus_legs_0_gimbal_first_b = q.platform.z - T::lit(0.4);
            let legs_0_gimbal_first_b_squared = minus_legs_0_gimbal_first_b
                * minus_legs_0_gimbal_first_b;
            let platform_y_plus_0_595_minus_1_374 = T::lit(0.595) + q.platform.y
                - T::lit(1.374);
            let platform_x_plus_0_17_plus_2_12 = T::lit(2.12)
                + (T::lit(0.17) + q.platform.x);
            let legs_gimbal_first_a_with_platform_x = T::lit(0.6816387600233341)
                * platform_x_plus_0_17_plus_2_12;
            let minus_legs_0_gimbal_first_a = T::lit(0.7316888688738209)
                * platform_y_plus_0_595_minus_1_374
                + legs_gimbal_first_a_with_platform_x;
            let root_legs_0_gimbal_first = Real::sqrt(
                legs_0_gimbal_first_b_squared
                    + minus_legs_0_gimbal_first_a * minus_legs_0_gimbal_first_a,
            );
            let minus_slope_legs_0_gimbal_first_inv = T::lit(1.0)
                / root_legs_0_gimbal_first;
            let cos_legs_0_gimbal_first = minus_legs_0_gimbal_first_b
                * minus_slope_legs_0_gimbal_first_inv;
            let mass_matrix_with_root_legs_0_gimbal_first = minus_slope_legs_0_gimbal_first_inv
                * cos_legs_0_gimbal_first;
            // Closed form of legs_0_stroke.
            let legs_stroke_discriminant_with_platform_x = platform_x_plus_0_17_plus_2_12
                * platform_x_plus_0_17_plus_2_12;
            let legs_0_stroke_discriminant = legs_stroke_discriminant_with_platform_x
                + platform_y_plus_0_595_minus_1_374 * platform_y_plus_0_595_minus_1_374
                + legs_0_gimbal_first_b_squared;
            let root_legs_0_stroke = Real::sqrt(legs_0_stroke_discriminant);
            let slope_legs_0_stroke_inv = T::lit(1.0) / root_legs_0_stroke;
            let cos_legs_0_gimbal_second = root_legs_0_gimbal_first
                * slope_legs_0_stroke_inv;
            let m_8_8 = T::lit(0.0625)
                + (T::lit(0.1) * legs_0_stroke_discriminant
                    - T::lit(0.1) * root_legs_0_stroke);
            let m_7_7 = cos_legs_0_gimbal_second * cos_legs_0_gimbal_second * m_8_8;
            let mass_matrix_with_m_7_7 = mass_matrix_with_root_legs_0_gimbal_first
                * m_7_7 * mass_matrix_with_root_legs_0_gimbal_first;
            let minus_sin_legs_0_gimbal_first = minus_legs_0_gimbal_first_a
                * minus_slope_legs_0_gimbal_first_inv;
            let legs_gimbal_second_v_with_platform_x = T::lit(0.7316888688738209)
                * platform_x_plus_0_17_plus_2_12;
            let sin_legs_0_gimbal_second = (legs_gimbal_second_v_with_platform_x
                - T::lit(0.6816387600233341) * platform_y_plus_0_595_minus_1_374)
                * slope_legs_0_stroke_inv;
            // Results.
            let mass_matrix_with_sin_legs_0_gimbal_first = minus_sin_legs_0_gimbal_first
                * sin_legs_0_gimbal_second;
            let mass_matrix_with_root_legs_0_stroke = slope_legs_0_stroke_inv
                * (T::lit(0.6816387600233341) * mass_matrix_with_sin_legs_0_gimbal_first
                    - T::lit(0.7316888688738209) * cos_legs_0_gimbal_second);
            let mass_matrix_with_platform_x = platform_x_plus_0_17_plus_2_12
                * slope_legs_0_stroke_inv;
            // Closed form of legs_1_gimbal_first.
            let platform_y_plus_0_15_minus_1_224 = T::lit(0.15) + q.platform.y
                - T::lit(1.224);
            let platform_x_minus_0_6_plus_2_38 = T::lit(2.38)
                + (q.platform.x - T::lit(0.6));
            let legs_gimbal_first_a_part = T::lit(0.5226872289306592)
                * platform_x_minus_0_6_plus_2_38;
            let minus_legs_1_gimbal_first_a = T::lit(0.8525245220595058)
                * platform_y_plus_0_15_minus_1_224 + legs_gimbal_first_a_part;
            let root_legs_1_gimbal_first = Real::sqrt(
                legs_0_gimbal_first_b_squared
                    + minus_legs_1_gimbal_first_a * minus_legs_1_gimbal_first_a,
            );
            let minus_slope_legs_1_gimbal_first_inv = T::lit(1.0)
                / root_legs_1_gimbal_first;
            let cos_legs_1_gimbal_first = minus_legs_0_gimbal_first_b
                * minus_slope_legs_1_gimbal_first_inv;
            let mass_matrix_with_root_legs_1_gimbal_first = minus_slope_legs_1_gimbal_first_inv
                * cos_legs_1_gimbal_first;
            // Closed form of legs_1_stroke.
            let legs_stroke_discriminant_part = platform_x_minus_0_6_plus_2_38
                * platform_x_minus_0_6_plus_2_38;
            let legs_1_stroke_discriminant = legs_0_gimbal_first_b_squared
                + legs_stroke_discriminant_part
                + platform_y_plus_0_15_minus_1_224 * platform_y_plus_0_15_minus_1_224;
            let root_legs_1_stroke = Real::sqrt(legs_1_stroke_discriminant);
            let slope_legs_1_stroke_inv = T::lit(1.0) / root_legs_1_stroke;
            let cos_legs_1_gimbal_second = root_legs_1_gimbal_first
                * slope_legs_1_stroke_inv;
            let m_11_11 = T::lit(0.0625)
                + (T::lit(0.1) * legs_1_stroke_discriminant
                    - T::lit(0.1) * root_legs_1_stroke);
            let m_10_10 = cos_legs_1_gimbal_second * cos_legs_1_gimbal_second * m_11_11;
            let mass_matrix_with_m_10_10 = mass_matrix_with_root_legs_1_gimbal_first
                * m_10_10 * mass_matrix_with_root_legs_1_gimbal_first;
            let minus_sin_legs_1_gimbal_first = minus_legs_1_gimbal_first_a
                * minus_slope_legs_1_gimbal_first_inv;
            let legs_gimbal_second_v_part = T::lit(0.8525245220595058)
                * platform_x_minus_0_6_plus_2_38;
            let sin_legs_1_gimbal_second = (legs_gimbal_second_v_part
                - T::lit(0.5226872289306592) * platform_y_plus_0_15_minus_1_224)
                * slope_legs_1_stroke_inv;
            // Results.
            let mass_matrix_with_sin_legs_1_gimbal_first = minus_sin_legs_1_gimbal_first
                * sin_legs_1_gimbal_second;
            let mass_matrix_with_root_legs_1_stroke = slope_legs_1_stroke_inv
                * (T::lit(0.5226872289306592) * mass_matrix_with_sin_legs_1_gimbal_first
                    - T::lit(0.8525245220595058) * cos_legs_1_gimbal_second);
            let mass_matrix_with_root_legs_1_stroke_and_platform_x = platform_x_minus_0_6_plus_2_38
                * slope_legs_1_stroke_inv;
            // Closed form of legs_2_gimbal_first.
            let platform_y_minus_0_15_plus_1_224 = T::lit(1.224)
                + (q.platform.y - T::lit(0.15));
            let legs_2_gimbal_first_a = legs_gimbal_first_a_part
                - T::lit(0.8525245220595058) * platform_y_minus_0_15_plus_1_224;
            let root_legs_2_gimbal_first = Real::sqrt(
                legs_0_gimbal_first_b_squared
                    + legs_2_gimbal_first_a * legs_2_gimbal_first_a,
            );
            let minus_slope_legs_2_gimbal_first_inv = T::lit(1.0)
                / root_legs_2_gimbal_first;
            let cos_legs_2_gimbal_first = minus_legs_0_gimbal_first_b
                * minus_slope_legs_2_gimbal_first_inv;
            let mass_matrix_with_root_legs_2_gimbal_first = minus_slope_legs_2_gimbal_first_inv
                * cos_legs_2_gimbal_first;
            let legs_2_stroke_discriminant = legs_0_gimbal_first_b_squared
                + legs_stroke_discriminant_part
                + platform_y_minus_0_15_plus_1_224 * platform_y_minus_0_15_plus_1_224;
            let root_legs_2_stroke = Real::sqrt(legs_2_stroke_discriminant);
            let slope_legs_2_stroke_inv = T::lit(1.0) / root_legs_2_stroke;
            let cos_legs_2_gimbal_second = root_legs_2_gimbal_first
                * slope_legs_2_stroke_inv;
            let m_14_14 = T::lit(0.0625)
                + (T::lit(0.1) * legs_2_stroke_discriminant
                    - T::lit(0.1) * root_legs_2_stroke);
            let m_13_13 = cos_legs_2_gimbal_second * cos_legs_2_gimbal_second * m_14_14;
            let mass_matrix_with_m_13_13 = mass_matrix_with_root_legs_2_gimbal_first
                * m_13_13 * mass_matrix_with_root_legs_2_gimbal_first;
            let sin_legs_2_gimbal_first = legs_2_gimbal_first_a
                * minus_slope_legs_2_gimbal_first_inv;
            let sin_legs_2_gimbal_second = (legs_gimbal_second_v_part
                + T::lit(0.5226872289306592) * platform_y_minus_0_15_plus_1_224)
                * slope_legs_2_stroke_inv;
            // Results.
            let mass_matrix_with_sin_legs_2_gimbal_first = sin_legs_2_gimbal_first
                * sin_legs_2_gimbal_second;
            let mass_matrix_with_root_legs_2_stroke = slope_legs_2_stroke_inv
                * (T::lit(0.5226872289306592) * mass_matrix_with_sin_legs_2_gimbal_first
                    - T::lit(0.8525245220595058) * cos_legs_2_gimbal_second);
            let mass_matrix_with_root_legs_2_stroke_and_platform_x = platform_x_minus_0_6_plus_2_38
                * slope_legs_2_stroke_inv;
            // Closed form of legs_3_gimbal_first.
            let platform_y_minus_0_595_plus_1_374 = T::lit(1.374)
                + (q.platform.y - T::lit(0.595));
            let legs_3_gimbal_first_a = legs_gimbal_first_a_with_platform_x
                - T::lit(0.7316888688738209) * platform_y_minus_0_595_plus_1_374;
            let root_legs_3_gimbal_first = Real::sqrt(
                legs_0_gimbal_first_b_squared
                    + legs_3_gimbal_first_a * legs_3_gimbal_first_a,
            );
            let minus_slope_legs_3_gimbal_first_inv = T::lit(1.0)
                / root_legs_3_gimbal_first;
            let cos_legs_3_gimbal_first = minus_legs_0_gimbal_first_b
                * minus_slope_legs_3_gimbal_first_inv;
            let mass_matrix_with_root_legs_3_gimbal_first = minus_slope_legs_3_gimbal_first_inv
                * cos_legs_3_gimbal_first;
            let legs_3_stroke_discriminant = legs_stroke_discriminant_with_platform_x
                + legs_0_gimbal_first_b_squared
                + platform_y_minus_0_595_plus_1_374 * platform_y_minus_0_595_plus_1_374;
            let root_legs_3_stroke = Real::sqrt(legs_3_stroke_discriminant);
            let slope_legs_3_stroke_inv = T::lit(1.0) / root_legs_3_stroke;
            let cos_legs_3_gimbal_second = root_legs_3_gimbal_first
                * slope_legs_3_stroke_inv;
            let m_17_17 = T::lit(0.0625)
                + (T::lit(0.1) * legs_3_stroke_discriminant
                    - T::lit(0.1) * root_legs_3_stroke);
            let m_16_16 = cos_legs_3_gimbal_second * cos_legs_3_gimbal_second * m_17_17;
            let mass_matrix_with_m_16_16 = mass_matrix_with_root_legs_3_gimbal_first
                * m_16_16 * mass_matrix_with_root_legs_3_gimbal_first;
            let sin_legs_3_gimbal_first = legs_3_gimbal_first_a
                * minus_slope_legs_3_gimbal_first_inv;
            let sin_legs_3_gimbal_second = (legs_gimbal_second_v_with_platform_x
                + T::lit(0.6816387600233341) * platform_y_minus_0_595_plus_1_374)
                * slope_legs_3_stroke_inv;
            // Results.
            let mass_matrix_with_sin_legs_3_gimbal_first = sin_legs_3_gimbal_first
                * sin_legs_3_gimbal_second;
            let mass_matrix_with_root_legs_3_stroke = slope_legs_3_stroke_inv
                * (T::lit(0.6816387600233341) * mass_matrix_with_sin_legs_3_gimbal_first
                    - T::lit(0.7316888688738209) * cos_legs_3_gimbal_second);
            let mass_matrix_with_root_legs_3_stroke_and_platform_x = platform_x_plus_0_17_plus_2_12
                * slope_legs_3_stroke_inv;
            // Closed form of legs_4_gimbal_first.
            let platform_y_minus_0_445_plus_0_15 = T::lit(0.15)
                + (q.platform.y - T::lit(0.445));
            let platform_x_plus_0_43 = T::lit(43.0 / 100.0) + q.platform.x;
            let legs_gimbal_first_a_part_v2 = T::lit(0.2874780123425445)
                * platform_x_plus_0_43;
            let minus_legs_4_gimbal_first_a = legs_gimbal_first_a_part_v2
                - T::lit(0.9577872375530903) * platform_y_minus_0_445_plus_0_15;
            let root_legs_4_gimbal_first = Real::sqrt(
                legs_0_gimbal_first_b_squared
                    + minus_legs_4_gimbal_first_a * minus_legs_4_gimbal_first_a,
            );
            let minus_slope_legs_4_gimbal_first_inv = T::lit(1.0)
                / root_legs_4_gimbal_first;
            let cos_legs_4_gimbal_first = minus_legs_0_gimbal_first_b
                * minus_slope_legs_4_gimbal_first_inv;
            let mass_matrix_with_root_legs_4_gimbal_first = minus_slope_legs_4_gimbal_first_inv
                * cos_legs_4_gimbal_first;
            // Closed form of legs_4_stroke.
            let legs_stroke_discriminant_part_v2 = platform_x_plus_0_43
                * platform_x_plus_0_43;
            let legs_4_stroke_discriminant = legs_0_gimbal_first_b_squared
                + legs_stroke_discriminant_part_v2
                + platform_y_minus_0_445_plus_0_15 * platform_y_minus_0_445_plus_0_15;
            let root_legs_4_stroke = Real::sqrt(legs_4_stroke_discriminant);
            let slope_legs_4_stroke_inv = T::lit(1.0) / root_legs_4_stroke;
            let cos_legs_4_gimbal_second = root_legs_4_gimbal_first
                * slope_legs_4_stroke_inv;
            let m_20_20 = T::lit(0.0625)
                + (T::lit(0.1) * legs_4_stroke_discriminant
                    - T::lit(0.1) * root_legs_4_stroke);
            let m_19_19 = cos_legs_4_gimbal_second * cos_legs_4_gimbal_second * m_20_20;
            let mass_matrix_with_m_19_19 = mass_matrix_with_root_legs_4_gimbal_first
                * m_19_19 * mass_matrix_with_root_legs_4_gimbal_first;
            let minus_sin_legs_4_gimbal_first = minus_legs_4_gimbal_first_a
                * minus_slope_legs_4_gimbal_first_inv;
            let legs_gimbal_second_v_part_v2 = T::lit(0.9577872375530903)
                * platform_x_plus_0_43;
            let minus_sin_legs_4_gimbal_second = (T::lit(0.2874780123425445)
                * platform_y_minus_0_445_plus_0_15 + legs_gimbal_second_v_part_v2)
                * slope_legs_4_stroke_inv;
            // Results.
            let mass_matrix_with_sin_legs_4_gimbal_first = minus_sin_legs_4_gimbal_first
                * minus_sin_legs_4_gimbal_second;
            let mass_matrix_with_root_legs_4_stroke = slope_legs_4_stroke_inv
                * (T::lit(0.2874780123425445) * mass_matrix_with_sin_legs_4_gimbal_first
                    - T::lit(0.9577872375530903) * cos_legs_4_gimbal_second);
            let mass_matrix_with_root_legs_4_stroke_and_platform_x = platform_x_plus_0_43
                * slope_legs_4_stroke_inv;
            // Closed form of legs_5_gimbal_first.
            let platform_y_plus_0_445_minus_0_15 = T::lit(0.445) + q.platform.y
                - T::lit(0.15);
            let legs_5_gimbal_first_a = legs_gimbal_first_a_part_v2
                + T::lit(0.9577872375530903) * platform_y_plus_0_445_minus_0_15;
            let root_legs_5_gimbal_first = Real::sqrt(
                legs_0_gimbal_first_b_squared
                    + legs_5_gimbal_first_a * legs_5_gimbal_first_a,
            );
            let minus_slope_legs_5_gimbal_first_inv = T::lit(1.0)
                / root_legs_5_gimbal_first;
            let cos_legs_5_gimbal_first = minus_legs_0_gimbal_first_b
                * minus_slope_legs_5_gimbal_first_inv;
            let mass_matrix_with_root_legs_5_gimbal_first = minus_slope_legs_5_gimbal_first_inv
                * cos_legs_5_gimbal_first;
            let legs_5_stroke_discriminant = legs_0_gimbal_first_b_squared
                + legs_stroke_discriminant_part_v2
                + platform_y_plus_0_445_minus_0_15 * platform_y_plus_0_445_minus_0_15;
            let root_legs_5_stroke = Real::sqrt(legs_5_stroke_discriminant);
            let slope_legs_5_stroke_inv = T::lit(1.0) / root_legs_5_stroke;
            let cos_legs_5_gimbal_second = root_legs_5_gimbal_first
                * slope_legs_5_stroke_inv;
            let m_23_23 = T::lit(0.0625)
                + (T::lit(0.1) * legs_5_stroke_discriminant
                    - T::lit(0.1) * root_legs_5_stroke);
            let m_22_22 = cos_legs_5_gimbal_second * cos_legs_5_gimbal_second * m_23_23;
            let mass_matrix_with_m_22_22 = mass_matrix_with_root_legs_5_gimbal_first
                * m_22_22 * mass_matrix_with_root_legs_5_gimbal_first;
            let sin_legs_5_gimbal_first = legs_5_gimbal_first_a
                * minus_slope_legs_5_gimbal_first_inv;
            let minus_sin_legs_5_gimbal_second = (legs_gimbal_second_v_part_v2
                - T::lit(0.2874780123425445) * platform_y_plus_0_445_minus_0_15)
                * slope_legs_5_stroke_inv;
            // Results.
            let mass_matrix_with_sin_legs_5_gimbal_first = sin_legs_5_gimbal_first
                * minus_sin_legs_5_gimbal_second;
            let mass_matrix_with_root_legs_5_stroke = slope_legs_5_stroke_inv
                * (T::lit(0.2874780123425445) * mass_matrix_with_sin_legs_5_gimbal_first
                    - T::lit(0.9577872375530903) * cos_legs_5_gimbal_second);
            let mass_matrix_with_root_legs_5_stroke_and_platform_x = platform_x_plus_0_43
                * slope_legs_5_stroke_inv;
            let mass_matrix_0 = T::lit(1.5)
                + T::lit(0.46463139916614854) * mass_matrix_with_m_7_7
                + mass_matrix_with_root_legs_0_stroke * m_8_8
                    * mass_matrix_with_root_legs_0_stroke
                + T::lit(0.1) * mass_matrix_with_platform_x * mass_matrix_with_platform_x
                + T::lit(0.2732019392872113) * mass_matrix_with_m_10_10
                + mass_matrix_with_root_legs_1_stroke * m_11_11
                    * mass_matrix_with_root_legs_1_stroke
                + T::lit(0.1) * mass_matrix_with_root_legs_1_stroke_and_platform_x
                    * mass_matrix_with_root_legs_1_stroke_and_platform_x
                + T::lit(0.2732019392872113) * mass_matrix_with_m_13_13
                + mass_matrix_with_root_legs_2_stroke * m_14_14
                    * mass_matrix_with_root_legs_2_stroke
                + T::lit(0.1) * mass_matrix_with_root_legs_2_stroke_and_platform_x
                    * mass_matrix_with_root_legs_2_stroke_and_platform_x
                + T::lit(0.46463139916614854) * mass_matrix_with_m_16_16
                + mass_matrix_with_root_legs_3_stroke * m_17_17
                    * mass_matrix_with_root_legs_3_stroke
                + T::lit(0.1) * mass_matrix_with_root_legs_3_stroke_and_platform_x
                    * mass_matrix_with_root_legs_3_stroke_and_platform_x
                + T::lit(0.08264360758042016) * mass_matrix_with_m_19_19
                + mass_matrix_with_root_legs_4_stroke * m_20_20
                    * mass_matrix_with_root_legs_4_stroke
                + T::lit(0.1) * mass_matrix_with_root_legs_4_stroke_and_platform_x
                    * mass_matrix_with_root_legs_4_stroke_and_platform_x
                + T::lit(0.08264360758042016) * mass_matrix_with_m_22_22
                + mass_matrix_with_root_legs_5_stroke * m_23_23
                    * mass_matrix_with_root_legs_5_stroke
                + T::lit(0.1) * mass_matrix_with_root_legs_5_stroke_and_platform_x
                    * mass_matrix_with_root_legs_5_stroke_and_platform_x;
            let mass_matrix_with_cos_legs_0_gimbal_second = slope_legs_0_stroke_inv
                * (T::lit(0.6816387600233341) * cos_legs_0_gimbal_second
                    + T::lit(0.7316888688738209)
                        * mass_matrix_with_sin_legs_0_gimbal_first);
            let mass_matrix_with_m_8_8 = m_8_8
                * mass_matrix_with_cos_legs_0_gimbal_second;
            let mass_matrix_with_platform_y = platform_y_plus_0_595_minus_1_374
                * slope_legs_0_stroke_inv;
            let mass_matrix_with_cos_legs_1_gimbal_second = slope_legs_1_stroke_inv
                * (T::lit(0.5226872289306592) * cos_legs_1_gimbal_second
                    + T::lit(0.8525245220595058)
                        * mass_matrix_with_sin_legs_1_gimbal_first);
            let mass_matrix_with_m_11_11 = m_11_11
                * mass_matrix_with_cos_legs_1_gimbal_second;
            let mass_matrix_with_root_legs_1_stroke_and_platform_y = platform_y_plus_0_15_minus_1_224
                * slope_legs_1_stroke_inv;
            let mass_matrix_with_cos_legs_2_gimbal_second = slope_legs_2_stroke_inv
                * (T::lit(0.5226872289306592) * cos_legs_2_gimbal_second
                    + T::lit(0.8525245220595058)
                        * mass_matrix_with_sin_legs_2_gimbal_first);
            let mass_matrix_with_m_14_14 = m_14_14
                * mass_matrix_with_cos_legs_2_gimbal_second;
            let mass_matrix_with_root_legs_2_stroke_and_platform_y = platform_y_minus_0_15_plus_1_224
                * slope_legs_2_stroke_inv;
            let mass_matrix_with_cos_legs_3_gimbal_second = slope_legs_3_stroke_inv
                * (T::lit(0.6816387600233341) * cos_legs_3_gimbal_second
                    + T::lit(0.7316888688738209)
                        * mass_matrix_with_sin_legs_3_gimbal_first);
            let mass_matrix_with_m_17_17 = m_17_17
                * mass_matrix_with_cos_legs_3_gimbal_second;
            let mass_matrix_with_root_legs_3_stroke_and_platform_y = platform_y_minus_0_595_plus_1_374
                * slope_legs_3_stroke_inv;
            let mass_matrix_with_cos_legs_4_gimbal_second = slope_legs_4_stroke_inv
                * (T::lit(0.2874780123425445) * cos_legs_4_gimbal_second
                    + T::lit(0.9577872375530903)
                        * mass_matrix_with_sin_legs_4_gimbal_first);
            let mass_matrix_with_m_20_20 = m_20_20
                * mass_matrix_with_cos_legs_4_gimbal_second;
            let mass_matrix_with_root_legs_4_stroke_and_platform_y = platform_y_minus_0_445_plus_0_15
                * slope_legs_4_stroke_inv;
            let mass_matrix_with_cos_legs_5_gimbal_second = slope_legs_5_stroke_inv
                * (T::lit(0.2874780123425445) * cos_legs_5_gimbal_second
                    + T::lit(0.9577872375530903)
                        * mass_matrix_with_sin_legs_5_gimbal_first);
            let mass_matrix_with_m_23_23 = m_23_23
                * mass_matrix_with_cos_legs_5_gimbal_second;
            let mass_matrix_with_root_legs_5_stroke_and_platform_y = platform_y_plus_0_445_minus_0_15
                * slope_legs_5_stroke_inv;
            let mass_matrix_1 = T::lit(0.4987474933020272) * mass_matrix_with_m_7_7
                + T::lit(0.44560368003071765) * mass_matrix_with_m_10_10
                - T::lit(0.44560368003071765) * mass_matrix_with_m_13_13
                - T::lit(0.4987474933020272) * mass_matrix_with_m_16_16
                - T::lit(0.2753427712988189) * mass_matrix_with_m_19_19
                + T::lit(0.2753427712988189) * mass_matrix_with_m_22_22
                + mass_matrix_with_root_legs_0_stroke * mass_matrix_with_m_8_8
                + T::lit(0.1) * mass_matrix_with_platform_x * mass_matrix_with_platform_y
                + mass_matrix_with_root_legs_1_stroke * mass_matrix_with_m_11_11
                + T::lit(0.1) * mass_matrix_with_root_legs_1_stroke_and_platform_x
                    * mass_matrix_with_root_legs_1_stroke_and_platform_y
                - mass_matrix_with_root_legs_2_stroke * mass_matrix_with_m_14_14
                + T::lit(0.1) * mass_matrix_with_root_legs_2_stroke_and_platform_x
                    * mass_matrix_with_root_legs_2_stroke_and_platform_y
                - mass_matrix_with_root_legs_3_stroke * mass_matrix_with_m_17_17
                + T::lit(0.1) * mass_matrix_with_root_legs_3_stroke_and_platform_x
                    * mass_matrix_with_root_legs_3_stroke_and_platform_y
                - mass_matrix_with_root_legs_4_stroke * mass_matrix_with_m_20_20
                + T::lit(0.1) * mass_matrix_with_root_legs_4_stroke_and_platform_x
                    * mass_matrix_with_root_legs_4_stroke_and_platform_y
                + mass_matrix_with_root_legs_5_stroke * mass_matrix_with_m_23_23
                + T::lit(0.1) * mass_matrix_with_root_legs_5_stroke_and_platform_x
                    * mass_matrix_with_root_legs_5_stroke_and_platform_y;
            let mass_matrix_part = minus_slope_legs_0_gimbal_first_inv
                * minus_sin_legs_0_gimbal_first;
            let m_7_7_times_mass_matrix_part = m_7_7 * mass_matrix_part;
            let mass_matrix_with_cos_legs_0_gimbal_first = mass_matrix_with_root_legs_0_gimbal_first
                * m_7_7_times_mass_matrix_part;
            let mass_matrix_with_sin_legs_0_gimbal_second = slope_legs_0_stroke_inv
                * cos_legs_0_gimbal_first * sin_legs_0_gimbal_second;
            let mass_matrix_with_m_8_8_and_root_legs_0_stroke = m_8_8
                * mass_matrix_with_sin_legs_0_gimbal_second;
            let mass_matrix_with_legs_0_gimbal_first_b = minus_legs_0_gimbal_first_b
                * slope_legs_0_stroke_inv;
            let mass_matrix_part_v2 = minus_slope_legs_1_gimbal_first_inv
                * minus_sin_legs_1_gimbal_first;
            let mass_matrix_with_m_10_10_and_root_legs_1_gimbal_first = m_10_10
                * mass_matrix_part_v2;
            let mass_matrix_with_cos_legs_1_gimbal_first = mass_matrix_with_root_legs_1_gimbal_first
                * mass_matrix_with_m_10_10_and_root_legs_1_gimbal_first;
            let mass_matrix_with_sin_legs_1_gimbal_second = slope_legs_1_stroke_inv
                * cos_legs_1_gimbal_first * sin_legs_1_gimbal_second;
            let mass_matrix_with_m_11_11_and_root_legs_1_stroke = m_11_11
                * mass_matrix_with_sin_legs_1_gimbal_second;
            let mass_matrix_with_legs_0_gimbal_first_b_and_root_legs_1_stroke = minus_legs_0_gimbal_first_b
                * slope_legs_1_stroke_inv;
            let mass_matrix_part_v3 = minus_slope_legs_2_gimbal_first_inv
                * sin_legs_2_gimbal_first;
            let mass_matrix_with_m_13_13_and_root_legs_2_gimbal_first = m_13_13
                * mass_matrix_part_v3;
            let mass_matrix_with_cos_legs_2_gimbal_first = mass_matrix_with_root_legs_2_gimbal_first
                * mass_matrix_with_m_13_13_and_root_legs_2_gimbal_first;
            let mass_matrix_with_sin_legs_2_gimbal_second = slope_legs_2_stroke_inv
                * cos_legs_2_gimbal_first * sin_legs_2_gimbal_second;
            let mass_matrix_with_m_14_14_and_root_legs_2_stroke = m_14_14
                * mass_matrix_with_sin_legs_2_gimbal_second;
            let mass_matrix_with_legs_0_gimbal_first_b_and_root_legs_2_stroke = minus_legs_0_gimbal_first_b
                * slope_legs_2_stroke_inv;
            let mass_matrix_part_v4 = minus_slope_legs_3_gimbal_first_inv
                * sin_legs_3_gimbal_first;
            let mass_matrix_with_m_16_16_and_root_legs_3_gimbal_first = m_16_16
                * mass_matrix_part_v4;
            let mass_matrix_with_cos_legs_3_gimbal_first = mass_matrix_with_root_legs_3_gimbal_first
                * mass_matrix_with_m_16_16_and_root_legs_3_gimbal_first;
            let mass_matrix_with_sin_legs_3_gimbal_second = slope_legs_3_stroke_inv
                * cos_legs_3_gimbal_first * sin_legs_3_gimbal_second;
            let mass_matrix_with_m_17_17_and_root_legs_3_stroke = m_17_17
                * mass_matrix_with_sin_legs_3_gimbal_second;
            let mass_matrix_with_legs_0_gimbal_first_b_and_root_legs_3_stroke = minus_legs_0_gimbal_first_b
                * slope_legs_3_stroke_inv;
            let mass_matrix_part_v5 = minus_slope_legs_4_gimbal_first_inv
                * minus_sin_legs_4_gimbal_first;
            let mass_matrix_with_m_19_19_and_root_legs_4_gimbal_first = m_19_19
                * mass_matrix_part_v5;
            let mass_matrix_with_cos_legs_4_gimbal_first = mass_matrix_with_root_legs_4_gimbal_first
                * mass_matrix_with_m_19_19_and_root_legs_4_gimbal_first;
            let mass_matrix_with_sin_legs_4_gimbal_second = slope_legs_4_stroke_inv
                * cos_legs_4_gimbal_first * minus_sin_legs_4_gimbal_second;
            let mass_matrix_with_m_20_20_and_root_legs_4_stroke = m_20_20
                * mass_matrix_with_sin_legs_4_gimbal_second;
            let mass_matrix_with_legs_0_gimbal_first_b_and_root_legs_4_stroke = minus_legs_0_gimbal_first_b
                * slope_legs_4_stroke_inv;
            let mass_matrix_part_v6 = minus_slope_legs_5_gimbal_first_inv
                * sin_legs_5_gimbal_first;
            let mass_matrix_with_m_22_22_and_root_legs_5_gimbal_first = m_22_22
                * mass_matrix_part_v6;
            let mass_matrix_with_cos_legs_5_gimbal_first = mass_matrix_with_root_legs_5_gimbal_first
                * mass_matrix_with_m_22_22_and_root_legs_5_gimbal_first;
            let mass_matrix_with_sin_legs_5_gimbal_second = slope_legs_5_stroke_inv
                * cos_legs_5_gimbal_first * minus_sin_legs_5_gimbal_second;
            let mass_matrix_with_m_23_23_and_root_legs_5_stroke = m_23_23
                * mass_matrix_with_sin_legs_5_gimbal_second;
            let mass_matrix_with_legs_0_gimbal_first_b_and_root_legs_5_stroke = minus_legs_0_gimbal_first_b
                * slope_legs_5_stroke_inv;
            let minus_mass_matrix_2 = T::lit(0.6816387600233341)
                * mass_matrix_with_cos_legs_0_gimbal_first
                - mass_matrix_with_root_legs_0_stroke
                    * mass_matrix_with_m_8_8_and_root_legs_0_stroke
                - T::lit(0.1) * mass_matrix_with_platform_x
                    * mass_matrix_with_legs_0_gimbal_first_b
                + T::lit(0.5226872289306592) * mass_matrix_with_cos_legs_1_gimbal_first
                - mass_matrix_with_root_legs_1_stroke
                    * mass_matrix_with_m_11_11_and_root_legs_1_stroke
                - T::lit(0.1) * mass_matrix_with_root_legs_1_stroke_and_platform_x
                    * mass_matrix_with_legs_0_gimbal_first_b_and_root_legs_1_stroke
                + T::lit(0.5226872289306592) * mass_matrix_with_cos_legs_2_gimbal_first
                - mass_matrix_with_root_legs_2_stroke
                    * mass_matrix_with_m_14_14_and_root_legs_2_stroke
                - T::lit(0.1) * mass_matrix_with_root_legs_2_stroke_and_platform_x
                    * mass_matrix_with_legs_0_gimbal_first_b_and_root_legs_2_stroke
                + T::lit(0.6816387600233341) * mass_matrix_with_cos_legs_3_gimbal_first
                - mass_matrix_with_root_legs_3_stroke
                    * mass_matrix_with_m_17_17_and_root_legs_3_stroke
                - T::lit(0.1) * mass_matrix_with_root_legs_3_stroke_and_platform_x
                    * mass_matrix_with_legs_0_gimbal_first_b_and_root_legs_3_stroke
                + T::lit(0.2874780123425445) * mass_matrix_with_cos_legs_4_gimbal_first
                - mass_matrix_with_root_legs_4_stroke
                    * mass_matrix_with_m_20_20_and_root_legs_4_stroke
                - T::lit(0.1) * mass_matrix_with_root_legs_4_stroke_and_platform_x
                    * mass_matrix_with_legs_0_gimbal_first_b_and_root_legs_4_stroke
                + T::lit(0.2874780123425445) * mass_matrix_with_cos_legs_5_gimbal_first
                - mass_matrix_with_root_legs_5_stroke
                    * mass_matrix_with_m_23_23_and_root_legs_5_stroke
                - T::lit(0.1) * mass_matrix_with_root_legs_5_stroke_and_platform_x
                    * mass_matrix_with_legs_0_gimbal_first_b_and_root_legs_5_stroke;
            let mass_matrix_4 = T::lit(1.5)
                + T::lit(0.5353686008338514) * mass_matrix_with_m_7_7
                + T::lit(0.7267980607127887) * mass_matrix_with_m_10_10
                + T::lit(0.7267980607127887) * mass_matrix_with_m_13_13
                + T::lit(0.5353686008338514) * mass_matrix_with_m_16_16
                + T::lit(0.9173563924195799) * mass_matrix_with_m_19_19
                + T::lit(0.9173563924195799) * mass_matrix_with_m_22_22
                + mass_matrix_with_cos_legs_0_gimbal_second * mass_matrix_with_m_8_8
                + T::lit(0.1) * mass_matrix_with_platform_y * mass_matrix_with_platform_y
                + mass_matrix_with_cos_legs_1_gimbal_second * mass_matrix_with_m_11_11
                + T::lit(0.1) * mass_matrix_with_root_legs_1_stroke_and_platform_y
                    * mass_matrix_with_root_legs_1_stroke_and_platform_y
                + mass_matrix_with_cos_legs_2_gimbal_second * mass_matrix_with_m_14_14
                + T::lit(0.1) * mass_matrix_with_root_legs_2_stroke_and_platform_y
                    * mass_matrix_with_root_legs_2_stroke_and_platform_y
                + mass_matrix_with_cos_legs_3_gimbal_second * mass_matrix_with_m_17_17
                + T::lit(0.1) * mass_matrix_with_root_legs_3_stroke_and_platform_y
                    * mass_matrix_with_root_legs_3_stroke_and_platform_y
                + mass_matrix_with_cos_legs_4_gimbal_second * mass_matrix_with_m_20_20
                + T::lit(0.1) * mass_matrix_with_root_legs_4_stroke_and_platform_y
                    * mass_matrix_with_root_legs_4_stroke_and_platform_y
                + mass_matrix_with_cos_legs_5_gimbal_second * mass_matrix_with_m_23_23
                + T::lit(0.1) * mass_matrix_with_root_legs_5_stroke_and_platform_y
                    * mass_matrix_with_root_legs_5_stroke_and_platform_y;
            let minus_mass_matrix_5 = T::lit(0.7316888688738209)
                * mass_matrix_with_cos_legs_0_gimbal_first
                + T::lit(0.8525245220595058) * mass_matrix_with_cos_legs_1_gimbal_first
                - T::lit(0.8525245220595058) * mass_matrix_with_cos_legs_2_gimbal_first
                - T::lit(0.7316888688738209) * mass_matrix_with_cos_legs_3_gimbal_first
                - T::lit(0.9577872375530903) * mass_matrix_with_cos_legs_4_gimbal_first
                + T::lit(0.9577872375530903) * mass_matrix_with_cos_legs_5_gimbal_first
                - mass_matrix_with_cos_legs_0_gimbal_second
                    * mass_matrix_with_m_8_8_and_root_legs_0_stroke
                - T::lit(0.1) * mass_matrix_with_platform_y
                    * mass_matrix_with_legs_0_gimbal_first_b
                - mass_matrix_with_cos_legs_1_gimbal_second
                    * mass_matrix_with_m_11_11_and_root_legs_1_stroke
                - T::lit(0.1) * mass_matrix_with_root_legs_1_stroke_and_platform_y
                    * mass_matrix_with_legs_0_gimbal_first_b_and_root_legs_1_stroke
                + mass_matrix_with_cos_legs_2_gimbal_second
                    * mass_matrix_with_m_14_14_and_root_legs_2_stroke
                - T::lit(0.1) * mass_matrix_with_root_legs_2_stroke_and_platform_y
                    * mass_matrix_with_legs_0_gimbal_first_b_and_root_legs_2_stroke
                + mass_matrix_with_cos_legs_3_gimbal_second
                    * mass_matrix_with_m_17_17_and_root_legs_3_stroke
                - T::lit(0.1) * mass_matrix_with_root_legs_3_stroke_and_platform_y
                    * mass_matrix_with_legs_0_gimbal_first_b_and_root_legs_3_stroke
                + mass_matrix_with_cos_legs_4_gimbal_second
                    * mass_matrix_with_m_20_20_and_root_legs_4_stroke
                - T::lit(0.1) * mass_matrix_with_root_legs_4_stroke_and_platform_y
                    * mass_matrix_with_legs_0_gimbal_first_b_and_root_legs_4_stroke
                - mass_matrix_with_cos_legs_5_gimbal_second
                    * mass_matrix_with_m_23_23_and_root_legs_5_stroke
                - T::lit(0.1) * mass_matrix_with_root_legs_5_stroke_and_platform_y
                    * mass_matrix_with_legs_0_gimbal_first_b_and_root_legs_5_stroke;
            let mass_matrix_8 = T::lit(1.5)
                + mass_matrix_part * m_7_7_times_mass_matrix_part
                + mass_matrix_with_sin_legs_0_gimbal_second
                    * mass_matrix_with_m_8_8_and_root_legs_0_stroke
                + T::lit(0.1) * mass_matrix_with_legs_0_gimbal_first_b
                    * mass_matrix_with_legs_0_gimbal_first_b
                + mass_matrix_part_v2
                    * mass_matrix_with_m_10_10_and_root_legs_1_gimbal_first
                + mass_matrix_with_sin_legs_1_gimbal_second
                    * mass_matrix_with_m_11_11_and_root_legs_1_stroke
                + T::lit(0.1)
                    * mass_matrix_with_legs_0_gimbal_first_b_and_root_legs_1_stroke
                    * mass_matrix_with_legs_0_gimbal_first_b_and_root_legs_1_stroke
                + mass_matrix_part_v3
                    * mass_matrix_with_m_13_13_and_root_legs_2_gimbal_first
                + mass_matrix_with_sin_legs_2_gimbal_second
                    * mass_matrix_with_m_14_14_and_root_legs_2_stroke
                + T::lit(0.1)
                    * mass_matrix_with_legs_0_gimbal_first_b_and_root_legs_2_stroke
                    * mass_matrix_with_legs_0_gimbal_first_b_and_root_legs_2_stroke
                + mass_matrix_part_v4
                    * mass_matrix_with_m_16_16_and_root_legs_3_gimbal_first
                + mass_matrix_with_sin_legs_3_gimbal_second
                    * mass_matrix_with_m_17_17_and_root_legs_3_stroke
                + T::lit(0.1)
                    * mass_matrix_with_legs_0_gimbal_first_b_and_root_legs_3_stroke
                    * mass_matrix_with_legs_0_gimbal_first_b_and_root_legs_3_stroke
                + mass_matrix_part_v5
                    * mass_matrix_with_m_19_19_and_root_legs_4_gimbal_first
                + mass_matrix_with_sin_legs_4_gimbal_second
                    * mass_matrix_with_m_20_20_and_root_legs_4_stroke
                + T::lit(0.1)
                    * mass_matrix_with_legs_0_gimbal_first_b_and_root_legs_4_stroke
                    * mass_matrix_with_legs_0_gimbal_first_b_and_root_legs_4_stroke
                + mass_matrix_part_v6
                    * mass_matrix_with_m_22_22_and_root_legs_5_gimbal_first
                + mass_matrix_with_sin_legs_5_gimbal_second
                    * mass_matrix_with_m_23_23_and_root_legs_5_stroke
                + T::lit(0.1)
                    * mass_matrix_with_legs_0_gimbal_first_b_and_root_legs_5_stroke
                    * mass_matrix_with_legs_0_gimbal_first_b_and_root_legs_5_stroke;
            let matrix: ::multibody::nalgebra::SMatrix<T, 3, 3> = ::multibody::nalgebra::SMatrix::from([
                [mass_matrix_0, mass_matrix_1, -minus_mass_matrix_2],
                [mass_matrix_1, mass_matrix_4, -minus_mass_matrix_5],
                [-minus_mass_matrix_2, -minus_mass_matrix_5, mass_matrix_8],
            ]);
            ::multibody::pivots::without_inertia(
                &matrix,
                &["platform.position.x", "platform.position.y", "platform.position.z"],
            )
        }
    }
    /// A leg; its spring is part of the actuator.
    pub mod leg {
        use ::core::prelude::v1::*;
        use ::multibody::Real;
        /// Parameters of one part `leg`. The default is what the model declares.
        #[repr(C)]
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct Params<T = f64> {
            /// `[N/m]` of a spring along the leg
            ///
            /// Default: `0.0`
            pub k: T,
            /// `[N s/m]` of a damper along the leg
            ///
            /// Default: `0.0`
            pub c: T,
            /// `[m]` stroke at which the spring is at rest
            ///
            /// Default: `0.0`
            pub s0: T,
        }
        impl<T: Real> Default for Params<T> {
            fn default() -> Self {
                Self {
                    k: T::lit(0.0),
                    c: T::lit(0.0),
                    s0: T::lit(0.0),
                }
            }
        }
        impl<T: Real> ::multibody::Columns<T> for Params<T> {
            fn columns(
                &self,
                place: &::multibody::Column<'_>,
                f: &mut dyn FnMut(&::multibody::Column<'_>, T),
            ) {
                ::multibody::Columns::columns(&self.k, &place.field("k", "N/m"), f);
                ::multibody::Columns::columns(&self.c, &place.field("c", "N s/m"), f);
                ::multibody::Columns::columns(&self.s0, &place.field("s0", "m"), f);
            }
        }
        /// Inputs of one part `leg`, held over a step. The default is zero.
        #[repr(C)]
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct Input<T = f64> {
            /// `[N]` pushes the tip away from the base
            pub thrust: T,
        }
        impl<T: Real> Default for Input<T> {
            fn default() -> Self {
                Self { thrust: T::lit(0.0) }
            }
        }
        impl<T: Real> ::multibody::Columns<T> for Input<T> {
            fn columns(
                &self,
                place: &::multibody::Column<'_>,
                f: &mut dyn FnMut(&::multibody::Column<'_>, T),
            ) {
                ::multibody::Columns::columns(
                    &self.thrust,
                    &place.field("thrust", "N"),
                    f,
                );
            }
        }
    }
    /// Names of the components of a velocity, in order.
    pub const COORDINATES: &[&str] = &["platform.x", "platform.y", "platform.z"];
    /// The coordinates whose dead centres `dead_centres` tells of, in order.
    pub const DEAD_CENTRES: &[&str] = &[
        "legs[0].stroke",
        "legs[0].gimbal.first",
        "legs[1].stroke",
        "legs[1].gimbal.first",
        "legs[2].stroke",
        "legs[2].gimbal.first",
        "legs[3].stroke",
        "legs[3].gimbal.first",
        "legs[4].stroke",
        "legs[4].gimbal.first",
        "legs[5].stroke",
        "legs[5].gimbal.first",
    ];
    /// Operation counts of every function, and of `Model::new`.
    pub const COSTS: &[::multibody::Cost] = &[
        ::multibody::Cost {
            function: "new",
            add: 6,
            mul: 0,
            div: 0,
            sqrt: 0,
            sincos: 0,
            other: 0,
        },
        ::multibody::Cost {
            function: "forward_dynamics",
            add: 145,
            mul: 160,
            div: 9,
            sqrt: 6,
            sincos: 0,
            other: 0,
        },
        ::multibody::Cost {
            function: "inverse_dynamics",
            add: 154,
            mul: 164,
            div: 7,
            sqrt: 6,
            sincos: 0,
            other: 3,
        },
        ::multibody::Cost {
            function: "dead_centres",
            add: 31,
            mul: 25,
            div: 0,
            sqrt: 12,
            sincos: 0,
            other: 0,
        },
        ::multibody::Cost {
            function: "margins",
            add: 52,
            mul: 60,
            div: 0,
            sqrt: 12,
            sincos: 0,
            other: 0,
        },
    ];
    /// The same of every function as it was derived, before optimisation, with the work on parameters in it.
    pub const DERIVED: &[::multibody::Cost] = &[
        ::multibody::Cost {
            function: "forward_dynamics",
            add: 173,
            mul: 225,
            div: 9,
            sqrt: 6,
            sincos: 0,
            other: 0,
        },
        ::multibody::Cost {
            function: "inverse_dynamics",
            add: 187,
            mul: 183,
            div: 7,
            sqrt: 6,
            sincos: 0,
            other: 3,
        },
        ::multibody::Cost {
            function: "dead_centres",
            add: 42,
            mul: 25,
            div: 0,
            sqrt: 12,
            sincos: 0,
            other: 0,
        },
        ::multibody::Cost {
            function: "margins",
            add: 66,
            mul: 60,
            div: 0,
            sqrt: 12,
            sincos: 0,
            other: 0,
        },
    ];
}
