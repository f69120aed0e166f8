/// The crank turns about z, the piston slides along x.
///
/// ## Parameters
///
/// | field | unit | default |  |
/// |---|---|---|---|
/// | `load` | `N m` | `0.05` | that the shaft gives away per rad/s |
///
/// ## Coordinates
///
/// | joint | kind | parent | child | freedoms |  |
/// |---|---|---|---|---|---|
/// | `shaft` | revolute | ground | `crank` | 1 |  |
/// | `big_end` | revolute | `crank` | `rod` | 0 of 1 |  |
/// | `cylinder` | prismatic | ground | `piston` | 0 of 1 |  |
///
/// ## Inputs
///
/// | field | unit | type |  |
/// |---|---|---|---|
/// | `gas` | `N` | scalar | on the piston, towards the crank |
///
/// ## Outputs
///
/// | field | unit | type |  |
/// |---|---|---|---|
/// | `bearing` | `N` | vector | on the crank |
/// | `energy` |  | scalar |  |
///
/// ## Bodies
///
/// | body | inertia |  |
/// |---|---|---|
/// | `crank` | rigid body |  |
/// | `rod` | rigid body |  |
/// | `piston` | point mass |  |
///
/// ## Loops
///
/// | closed by | kind | between | and | equations |  |
/// |---|---|---|---|---|---|
/// | `small_end` | revolute | `rod` | `piston` | solved |  |
///
/// 1 velocity coordinates + 0 constraint equations = 1 equations.
///
/// - `big_end`, `cylinder`: in closed form from `small_end`, where `cylinder > 0.0`
/// - left out, since they follow from the other equations: `small_end.z`, `small_end.turn_y`, `small_end.turn_x`
/// - found in closed form: `big_end`, `cylinder`
/// - `cylinder`: distance of two points: quadratic in the travel
/// - `big_end`: a point on both sides: (r cos x, r sin x) = (u, v)
///
/// ## Functions
///
/// | function | method | operations | as derived |
/// |---|---|---|---|
/// | `new` |  | none |  |
/// | `forward_dynamics` | composite rigid body, LDL^T, parallel hinges in the axes of their tip | 33 add, 65 mul, 2 div, 1 sqrt, 1 sincos | 40 add, 92 mul, 2 div, 1 sqrt, 1 sincos |
/// | `inverse_dynamics` | recursive Newton-Euler | 30 add, 58 mul, 1 div, 1 sqrt, 1 sincos | 37 add, 84 mul, 1 div, 1 sqrt, 1 sincos |
/// | `kinematics` | closed form | 5 add, 16 mul, 1 div, 1 sqrt, 1 sincos | 6 add, 19 mul, 1 div, 1 sqrt, 1 sincos |
/// | `outputs` | world axes | 83 add, 118 mul, 8 div, 1 sqrt, 1 sincos | 101 add, 171 mul, 8 div, 1 sqrt, 1 sincos |
/// | `dead_centres` | closed forms | 1 add, 2 mul, 1 sqrt, 1 sincos | 1 add, 2 mul, 1 sqrt, 1 sincos |
/// | `margins` | closed forms, determinants | 1 add, 5 mul, 1 sqrt, 1 sincos | 1 add, 5 mul, 1 sqrt, 1 sincos |
///
/// ## Defaults in force
///
/// - no gravity
/// - centre of mass at the body's origin: `crank`, `piston`
pub(crate) mod engine {
    use ::core::prelude::v1::*;
    use ::multibody::Real;
    /// Number of degrees of freedom: components of a velocity.
    pub const DOF: usize = 1;
    /// Parameters of `engine`. The default is what the model declares.
    #[repr(C)]
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Params<T = f64> {
        /// `[N m]` that the shaft gives away per rad/s
        ///
        /// Default: `0.05`
        pub load: T,
    }
    /// Positions of the joints of `engine`. The default is zero, or the identity.
    ///
    /// Components in order of declaration: 1.
    #[repr(C)]
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Position<T = f64> {
        /// `[rad]` position of the revolute joint
        pub shaft: T,
    }
    /// Velocities of `engine`; accelerations and efforts have the same components.
    ///
    /// Components in order of declaration: 1.
    #[repr(C)]
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Velocity<T = f64> {
        /// `[rad/s]` velocity of the revolute joint
        pub shaft: T,
    }
    /// Inputs of `engine`, held over a step. The default is zero.
    #[repr(C)]
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Input<T = f64> {
        /// `[N]` on the piston, towards the crank
        pub gas: T,
    }
    /// Outputs of `engine`.
    #[repr(C)]
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Output<T = f64> {
        /// `[N]` on the crank
        pub bearing: ::multibody::nalgebra::Vector3<T>,
        /// output
        pub energy: T,
    }
    impl<T: Real> Default for Params<T> {
        fn default() -> Self {
            Self { load: T::lit(0.05) }
        }
    }
    impl<T: Real> Default for Position<T> {
        fn default() -> Self {
            Self { shaft: T::lit(0.0) }
        }
    }
    impl<T: Real> Default for Velocity<T> {
        fn default() -> Self {
            Self { shaft: T::lit(0.0) }
        }
    }
    impl<T: Real> Default for Input<T> {
        fn default() -> Self {
            Self { gas: T::lit(0.0) }
        }
    }
    impl<T: Real> Default for Output<T> {
        fn default() -> Self {
            Self {
                bearing: ::multibody::nalgebra::Vector3::zeros(),
                energy: T::lit(0.0),
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
            if !::multibody::all(Real::is_finite(params.load)) {
                return Err(::multibody::ParamError {
                    what: "`load` is not finite",
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
                shaft: ::multibody::Tangent::zero(),
            }
        }
        fn zip<F: FnMut(T, T) -> T>(&self, other: &Self, f: &mut F) -> Self {
            Self {
                shaft: ::multibody::Tangent::zip(&self.shaft, &other.shaft, f),
            }
        }
        fn fold<A, F: FnMut(A, T) -> A>(&self, start: A, f: &mut F) -> A {
            ::multibody::Tangent::fold(&self.shaft, start, f)
        }
    }
    impl<T: Real> ::multibody::Configuration<T> for Position<T> {
        type Velocity = Velocity<T>;
        fn displace(&self, d: &Velocity<T>) -> Self {
            Self {
                shaft: ::multibody::Configuration::displace(&self.shaft, &d.shaft),
            }
        }
        fn advance(&self, d: &Velocity<T>, rest: &Velocity<T>) -> (Self, Velocity<T>) {
            let (mut end, mut left) = (*self, *rest);
            (end.shaft, left.shaft) = ::multibody::Configuration::advance(
                &self.shaft,
                &d.shaft,
                &rest.shaft,
            );
            (end, left)
        }
        fn dexp_inv(_d: &Velocity<T>, v: &Velocity<T>) -> Velocity<T> {
            *v
        }
        fn magnitude(&self) -> Velocity<T> {
            Velocity {
                shaft: ::multibody::Configuration::magnitude(&self.shaft),
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
    impl<T: Real> From<Velocity<T>> for ::multibody::nalgebra::SVector<T, 1> {
        fn from(velocity: Velocity<T>) -> Self {
            Self::from([velocity.shaft])
        }
    }
    impl<T: Real> From<::multibody::nalgebra::SVector<T, 1>> for Velocity<T> {
        fn from(vector: ::multibody::nalgebra::SVector<T, 1>) -> Self {
            let [[shaft]] = vector.data.0;
            Velocity { shaft }
        }
    }
    impl<T: Real> From<Position<T>> for ::multibody::nalgebra::SVector<T, 1> {
        fn from(position: Position<T>) -> Self {
            Self::from([position.shaft])
        }
    }
    impl<T: Real> From<::multibody::nalgebra::SVector<T, 1>> for Position<T> {
        fn from(vector: ::multibody::nalgebra::SVector<T, 1>) -> Self {
            let [[shaft]] = vector.data.0;
            Position { shaft }
        }
    }
    /// The equations of motion of `engine`. It holds the one value that depends on parameters alone.
    #[repr(C)]
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Model<T = f64> {
        /// `load`
        load: T,
    }
    impl<T: Real> Model<T> {
        /// Does the work that depends on parameters alone.
        ///
        /// Operations: none.
        #[must_use]
        pub fn new(params: &Params<T>) -> Self {
            Self { load: params.load }
        }
        /// Accelerations.
        ///
        /// Method: composite rigid body, LDL^T, parallel hinges in the axes of their tip.
        ///
        /// Operations: 33 add, 65 mul, 2 div, 1 sqrt, 1 sincos; as derived, before optimisation: 40 add, 92 mul, 2 div, 1 sqrt, 1 sincos.
        #[must_use]
        pub fn forward_dynamics(
            &self,
            _t: T,
            state: &State<T>,
            input: &Input<T>,
        ) -> Velocity<T> {
            let q = &state.q;
            let v = &state.v;
            let (sin_shaft, cos_shaft) = Real::sin_cos(q.shaft);
            let root_cylinder = Real::sqrt(
                T::lit(0.018) + T::lit(0.0016) * cos_shaft * cos_shaft,
            );
            let shaft_accel_part = T::lit(0.04) * cos_shaft;
            let cylinder = root_cylinder + shaft_accel_part;
            let pivot_1_part = sin_shaft * cylinder;
            let accel_part = v.shaft * sin_shaft;
            let slope_cylinder_inv = T::lit(1.0) / root_cylinder;
            let accel_part_v2 = cylinder * accel_part;
            let accel_part_v3 = slope_cylinder_inv * accel_part_v2;
            let accel_part_v4 = accel_part * accel_part_v3;
            let pivot_1_part_v2 = cos_shaft * cylinder;
            let shaft_accel_part_v2 = v.shaft * pivot_1_part_v2
                - T::lit(0.04) * sin_shaft * accel_part_v3;
            let w2_shaft_z = v.shaft * v.shaft;
            let minus_cylinder_accel = slope_cylinder_inv
                * (T::lit(0.0016) * accel_part_v3 * accel_part_v3
                    - T::lit(0.0032) * accel_part_v4
                    + T::lit(0.04) * pivot_1_part_v2 * w2_shaft_z);
            let pivot_1_part_v3 = pivot_1_part_v2 - T::lit(0.04);
            let shaft_accel_part_v3 = accel_part_v3 * shaft_accel_part;
            let shaft_accel_part_v4 = accel_part_v2 + shaft_accel_part_v3;
            let shaft_accel_part_v5 = pivot_1_part
                * (v.shaft * shaft_accel_part_v2 - T::lit(0.04) * accel_part_v4
                    + cos_shaft * minus_cylinder_accel)
                - pivot_1_part_v3
                    * (v.shaft * shaft_accel_part_v4 + sin_shaft * minus_cylinder_accel
                        + v.shaft * shaft_accel_part_v3);
            let shaft_accel_part_v6 = T::lit(0.004285714285714286) * pivot_1_part;
            let minus_n_big_end_z = T::lit(0.06326530612244897) * shaft_accel_part_v5
                + w2_shaft_z * shaft_accel_part_v6;
            let shaft_accel_part_v7 = pivot_1_part_v3 * minus_n_big_end_z;
            let shaft_accel_part_v8 = pivot_1_part * minus_n_big_end_z;
            let pivot_1_part_v4 = slope_cylinder_inv * pivot_1_part;
            let pivot_1_part_v5 = T::lit(0.04) * pivot_1_part_v4;
            let shaft_accel_part_v9 = v.shaft
                - T::lit(51.02040816326531)
                    * (pivot_1_part_v3 * shaft_accel_part_v2
                        + pivot_1_part * shaft_accel_part_v4);
            let shaft_accel_part_v10 = self.load * v.shaft - minus_n_big_end_z
                - T::lit(0.21865889212827988) * pivot_1_part_v3 * shaft_accel_part_v5
                + T::lit(51.02040816326531)
                    * (pivot_1_part_v2 * shaft_accel_part_v7
                        + pivot_1_part * shaft_accel_part_v8)
                - (input.gas - T::lit(0.4) * minus_cylinder_accel
                    - T::lit(51.02040816326531)
                        * (cos_shaft * shaft_accel_part_v8
                            - sin_shaft * shaft_accel_part_v7)) * pivot_1_part_v5
                + shaft_accel_part_v9 * shaft_accel_part_v9 * shaft_accel_part_v6;
            let m_1_2 = T::lit(0.00124) + T::lit(0.004285714285714286) * pivot_1_part_v3;
            let pivot_1_part_v6 = T::lit(7.142857142857143) * pivot_1_part
                * (pivot_1_part + cos_shaft * pivot_1_part_v5)
                + T::lit(7.142857142857143) * pivot_1_part_v3
                    * (pivot_1_part_v2 - sin_shaft * pivot_1_part_v5);
            let pivot_1 = T::lit(0.01172)
                + T::lit(0.008571428571428572) * pivot_1_part_v3
                + T::lit(0.00064) * pivot_1_part_v4 * pivot_1_part_v4
                - T::lit(7.142857142857143)
                    * (m_1_2 * pivot_1_part_v6
                        + pivot_1_part_v6
                            * (m_1_2 - T::lit(0.008857142857142857) * pivot_1_part_v6));
            Velocity {
                shaft: -shaft_accel_part_v10 / pivot_1,
            }
        }
        /// Efforts that the accelerations `accel` need beside all declared forces.
        ///
        /// Method: recursive Newton-Euler.
        ///
        /// Operations: 30 add, 58 mul, 1 div, 1 sqrt, 1 sincos; as derived, before optimisation: 37 add, 84 mul, 1 div, 1 sqrt, 1 sincos.
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
            let (sin_shaft, cos_shaft) = Real::sin_cos(q.shaft);
            let root_cylinder = Real::sqrt(
                T::lit(0.018) + T::lit(0.0016) * cos_shaft * cos_shaft,
            );
            let u_big_end_yx_part = T::lit(0.04) * cos_shaft;
            let cylinder = root_cylinder + u_big_end_yx_part;
            let shaft_effort_part = sin_shaft * cylinder;
            let w2_shaft_z = v.shaft * v.shaft;
            let shaft_effort_part_v2 = cos_shaft * cylinder;
            let shaft_effort_part_v3 = shaft_effort_part_v2 - T::lit(0.04);
            let u_big_end_yx_part_v2 = v.shaft * sin_shaft;
            let slope_cylinder_inv = T::lit(1.0) / root_cylinder;
            let shaft_effort_part_v4 = cylinder * u_big_end_yx_part_v2;
            let u_big_end_yx_part_v3 = slope_cylinder_inv * shaft_effort_part_v4;
            let u_big_end_yx_part_v4 = u_big_end_yx_part_v2 * u_big_end_yx_part_v3;
            let cylinder_accel_part = T::lit(0.0016) * u_big_end_yx_part_v3
                * u_big_end_yx_part_v3 - T::lit(0.0032) * u_big_end_yx_part_v4
                + T::lit(0.04) * cylinder
                    * (accel.shaft * sin_shaft + cos_shaft * w2_shaft_z);
            let minus_cylinder_accel = slope_cylinder_inv * cylinder_accel_part;
            let shaft_effort_part_v5 = v.shaft * shaft_effort_part_v2
                - T::lit(0.04) * sin_shaft * u_big_end_yx_part_v3;
            let u_big_end_yx_part_v5 = u_big_end_yx_part_v3 * u_big_end_yx_part;
            let shaft_effort_part_v6 = shaft_effort_part_v4 + u_big_end_yx_part_v5;
            let u_big_end_yx_part_v6 = shaft_effort_part
                * (T::lit(0.04) * u_big_end_yx_part_v4 - cos_shaft * minus_cylinder_accel
                    - accel.shaft * shaft_effort_part - v.shaft * shaft_effort_part_v5)
                + shaft_effort_part_v3
                    * (sin_shaft * minus_cylinder_accel
                        - accel.shaft * shaft_effort_part_v2
                        + v.shaft * shaft_effort_part_v6
                        + v.shaft * u_big_end_yx_part_v5);
            let u_big_end_yx = accel.shaft
                + T::lit(51.02040816326531) * u_big_end_yx_part_v6;
            let minus_n_big_end_z = T::lit(0.004285714285714286)
                * (shaft_effort_part * w2_shaft_z - accel.shaft * shaft_effort_part_v3)
                - T::lit(0.00124) * u_big_end_yx;
            let shaft_effort_part_v7 = v.shaft
                - T::lit(51.02040816326531)
                    * (shaft_effort_part_v3 * shaft_effort_part_v5
                        + shaft_effort_part * shaft_effort_part_v6);
            let shaft_effort_part_v8 = shaft_effort_part * minus_n_big_end_z;
            let shaft_effort_part_v9 = shaft_effort_part_v3 * minus_n_big_end_z;
            let shaft_effort_part_v10 = shaft_effort_part * shaft_effort_part_v7
                * shaft_effort_part_v7 + shaft_effort_part_v3 * u_big_end_yx
                - T::lit(9.333333333333334) * slope_cylinder_inv * shaft_effort_part
                    * (input.gas - T::lit(0.4) * minus_cylinder_accel
                        - T::lit(51.02040816326531)
                            * (cos_shaft * shaft_effort_part_v8
                                - sin_shaft * shaft_effort_part_v9));
            Velocity {
                shaft: T::lit(0.01048) * accel.shaft + self.load * v.shaft
                    - minus_n_big_end_z
                    + T::lit(0.004285714285714286) * shaft_effort_part_v10
                    + T::lit(51.02040816326531)
                        * (shaft_effort_part_v2 * shaft_effort_part_v9
                            + shaft_effort_part * shaft_effort_part_v8),
            }
        }
        /// Positions, rates and accelerations, in this order: `cylinder`.
        ///
        /// Method: closed form.
        ///
        /// Operations: 5 add, 16 mul, 1 div, 1 sqrt, 1 sincos; as derived, before optimisation: 6 add, 19 mul, 1 div, 1 sqrt, 1 sincos.
        #[must_use]
        pub fn kinematics(
            &self,
            _t: T,
            state: &State<T>,
            accel: &Velocity<T>,
        ) -> ::multibody::Kinematics<T, 1> {
            let q = &state.q;
            let v = &state.v;
            let (sin_shaft, cos_shaft) = Real::sin_cos(q.shaft);
            let root_cylinder = Real::sqrt(
                T::lit(0.018) + T::lit(0.0016) * cos_shaft * cos_shaft,
            );
            let cylinder = T::lit(0.04) * cos_shaft + root_cylinder;
            let slope_cylinder_inv = T::lit(1.0) / root_cylinder;
            let cylinder_part = v.shaft * sin_shaft;
            let cylinder_rate_part = cylinder * slope_cylinder_inv * cylinder_part;
            let cylinder_accel_part = T::lit(0.04) * cylinder
                * (accel.shaft * sin_shaft + v.shaft * v.shaft * cos_shaft)
                + cylinder_rate_part
                    * (T::lit(0.0016) * cylinder_rate_part
                        - T::lit(0.0032) * cylinder_part);
            ::multibody::Kinematics {
                position: ::multibody::nalgebra::SVector::from([cylinder]),
                velocity: ::multibody::nalgebra::SVector::from([
                    (T::lit(-0.04) * cylinder_rate_part),
                ]),
                acceleration: ::multibody::nalgebra::SVector::from([
                    (-slope_cylinder_inv * cylinder_accel_part),
                ]),
            }
        }
        /// Outputs.
        ///
        /// Method: world axes.
        ///
        /// Operations: 83 add, 118 mul, 8 div, 1 sqrt, 1 sincos; as derived, before optimisation: 101 add, 171 mul, 8 div, 1 sqrt, 1 sincos.
        #[must_use]
        pub fn outputs(&self, _t: T, state: &State<T>, input: &Input<T>) -> Output<T> {
            let q = &state.q;
            let v = &state.v;
            let (sin_shaft, cos_shaft) = Real::sin_cos(q.shaft);
            let root_cylinder = Real::sqrt(
                T::lit(0.018) + T::lit(0.0016) * cos_shaft * cos_shaft,
            );
            let pivot_1_part = T::lit(0.04) * cos_shaft;
            let cylinder = root_cylinder + pivot_1_part;
            let u_big_end_yx_part = sin_shaft * cylinder;
            let w2_shaft_z = v.shaft * v.shaft;
            let a_big_end_y_part = u_big_end_yx_part * w2_shaft_z;
            let u_big_end_yx_part_v2 = cos_shaft * cylinder;
            let big_end_part = u_big_end_yx_part_v2 - T::lit(0.04);
            let slope_cylinder_inv = T::lit(1.0) / root_cylinder;
            let u_big_end_yx_part_v3 = v.shaft * sin_shaft;
            let w_big_end_z_part = cylinder * u_big_end_yx_part_v3;
            let w_big_end_z_part_v2 = slope_cylinder_inv * w_big_end_z_part;
            let cylinder_accel_part = w_big_end_z_part_v2 * w_big_end_z_part_v2;
            let u_big_end_yx_part_v4 = u_big_end_yx_part_v3 * w_big_end_z_part_v2;
            let cylinder_accel_part_v2 = T::lit(0.0016) * cylinder_accel_part
                - T::lit(0.0032) * u_big_end_yx_part_v4;
            let cylinder_accel_part_v3 = cos_shaft * w2_shaft_z;
            let cylinder_accel_part_v4 = T::lit(0.04) * cylinder;
            let minus_cylinder_accel = slope_cylinder_inv
                * (cylinder_accel_part_v2
                    + cylinder_accel_part_v3 * cylinder_accel_part_v4);
            let multiplier_2_part = T::lit(0.04) * sin_shaft;
            let w_big_end_z_part_v3 = v.shaft * u_big_end_yx_part_v2
                - w_big_end_z_part_v2 * multiplier_2_part;
            let u_big_end_yx_part_v5 = T::lit(0.04) * u_big_end_yx_part_v4
                - v.shaft * w_big_end_z_part_v3;
            let w_big_end_z_part_v4 = w_big_end_z_part_v2 * pivot_1_part;
            let w_big_end_z_part_v5 = w_big_end_z_part + w_big_end_z_part_v4;
            let u_big_end_yx_part_v6 = v.shaft * w_big_end_z_part_v4
                + v.shaft * w_big_end_z_part_v5;
            let dw_shaft_z_part = u_big_end_yx_part
                * (cos_shaft * minus_cylinder_accel - u_big_end_yx_part_v5)
                - big_end_part
                    * (sin_shaft * minus_cylinder_accel + u_big_end_yx_part_v6);
            let minus_n_big_end_z = T::lit(0.06326530612244897) * dw_shaft_z_part
                + T::lit(0.004285714285714286) * a_big_end_y_part;
            let w_big_end_z = v.shaft
                - T::lit(51.02040816326531)
                    * (big_end_part * w_big_end_z_part_v3
                        + u_big_end_yx_part * w_big_end_z_part_v5);
            let w2_big_end_z = w_big_end_z * w_big_end_z;
            let pivot_1_part_v2 = slope_cylinder_inv * u_big_end_yx_part;
            let dw_shaft_z_part_v2 = u_big_end_yx_part * minus_n_big_end_z;
            let dw_shaft_z_part_v3 = big_end_part * minus_n_big_end_z;
            let dw_shaft_z_part_v4 = T::lit(0.10714285714285714) * u_big_end_yx_part
                * w2_big_end_z
                - T::lit(5.466472303206997) * big_end_part * dw_shaft_z_part
                - pivot_1_part_v2
                    * (input.gas - T::lit(0.4) * minus_cylinder_accel
                        - T::lit(51.02040816326531)
                            * (cos_shaft * dw_shaft_z_part_v2
                                - sin_shaft * dw_shaft_z_part_v3));
            let m_1_2_part = T::lit(0.004285714285714286) * big_end_part;
            let m_1_2 = T::lit(0.00124) + m_1_2_part;
            let f_big_end_part = T::lit(7.142857142857143) * u_big_end_yx_part;
            let f_big_end_part_v2 = T::lit(7.142857142857143) * big_end_part;
            let pivot_1_part_v3 = (u_big_end_yx_part + pivot_1_part_v2 * pivot_1_part)
                * f_big_end_part
                + (u_big_end_yx_part_v2 - pivot_1_part_v2 * multiplier_2_part)
                    * f_big_end_part_v2;
            let pivot_1 = T::lit(0.01172) + T::lit(0.008571428571428572) * big_end_part
                + T::lit(0.00064) * pivot_1_part_v2 * pivot_1_part_v2
                - T::lit(7.142857142857143)
                    * (m_1_2 * pivot_1_part_v3
                        + pivot_1_part_v3
                            * (m_1_2 - T::lit(0.008857142857142857) * pivot_1_part_v3));
            let minus_dw_shaft_z = (self.load * v.shaft - minus_n_big_end_z
                + T::lit(0.04) * dw_shaft_z_part_v4
                + T::lit(51.02040816326531)
                    * (u_big_end_yx_part_v2 * dw_shaft_z_part_v3
                        + u_big_end_yx_part * dw_shaft_z_part_v2)) / pivot_1;
            let a_big_end_y_part_v2 = a_big_end_y_part + big_end_part * minus_dw_shaft_z;
            let minus_cylinder_accel_v2 = slope_cylinder_inv
                * (cylinder_accel_part_v2
                    + (cylinder_accel_part_v3 - sin_shaft * minus_dw_shaft_z)
                        * cylinder_accel_part_v4);
            let f_big_end_x_part = u_big_end_yx_part * minus_dw_shaft_z;
            let u_big_end_yx_part_v7 = u_big_end_yx_part
                * (f_big_end_x_part - cos_shaft * minus_cylinder_accel_v2
                    + u_big_end_yx_part_v5)
                + big_end_part
                    * (sin_shaft * minus_cylinder_accel_v2
                        + u_big_end_yx_part_v2 * minus_dw_shaft_z
                        + u_big_end_yx_part_v6);
            let minus_u_big_end_yx = minus_dw_shaft_z
                - T::lit(51.02040816326531) * u_big_end_yx_part_v7;
            let ([multiplier_1], _) = ::multibody::linear::solve(
                [[T::lit(1.0)]],
                [(T::lit(0.4) * minus_cylinder_accel_v2 - input.gas)],
            );
            let f_big_end_part_v3 = sin_shaft * f_big_end_part_v2
                - cos_shaft * f_big_end_part;
            let ([multiplier_2], _) = ::multibody::linear::solve(
                [[-root_cylinder]],
                [
                    (T::lit(0.004285714285714286) * a_big_end_y_part_v2
                        + T::lit(0.00124) * minus_u_big_end_yx
                        + multiplier_1 * multiplier_2_part),
                ],
            );
            let f_big_end_part_v4 = sin_shaft * f_big_end_part
                + cos_shaft * f_big_end_part_v2;
            let f_big_end_y = multiplier_1 * f_big_end_part_v3
                - T::lit(0.08571428571428572) * a_big_end_y_part_v2
                - T::lit(0.015) * minus_u_big_end_yx - multiplier_2 * f_big_end_part_v4;
            let minus_f_big_end_x = T::lit(0.015) * w2_big_end_z
                + multiplier_1 * f_big_end_part_v4 + multiplier_2 * f_big_end_part_v3
                + T::lit(0.08571428571428572)
                    * (big_end_part * w2_shaft_z - f_big_end_x_part);
            let minus_f_big_end_passed_x = minus_f_big_end_x * f_big_end_part_v2
                - f_big_end_y * f_big_end_part;
            let f_big_end_passed_y = minus_f_big_end_x * f_big_end_part
                + f_big_end_y * f_big_end_part_v2;
            Output {
                bearing: ::multibody::nalgebra::Vector3::from([
                    -(cos_shaft * minus_f_big_end_passed_x
                        + sin_shaft * f_big_end_passed_y),
                    -(sin_shaft * minus_f_big_end_passed_x
                        - cos_shaft * f_big_end_passed_y),
                    T::lit(0.0),
                ]),
                energy: T::lit(0.00032) * cylinder_accel_part
                    + T::lit(0.00524) * w2_shaft_z + T::lit(0.00062) * w2_big_end_z
                    + v.shaft * w_big_end_z * m_1_2_part,
            }
        }
        /// Distances from dead centres, in the order of `DEAD_CENTRES`. Of a loop's solution: its square root, a product of lengths, zero where two solutions meet and NaN where the loop cannot be closed. Of roll, pitch and yaw: the cosine of the pitch, zero where roll and yaw turn about one axis. Rates grow without bound there.
        ///
        /// Method: closed forms.
        ///
        /// Operations: 1 add, 2 mul, 1 sqrt, 1 sincos; as derived, before optimisation: 1 add, 2 mul, 1 sqrt, 1 sincos.
        #[must_use]
        pub fn dead_centres(
            &self,
            _t: T,
            q: &Position<T>,
        ) -> ::multibody::nalgebra::SVector<T, 1> {
            let (_, cos_shaft) = Real::sin_cos(q.shaft);
            ::multibody::nalgebra::SVector::from([
                Real::sqrt(T::lit(0.018) + T::lit(0.0016) * cos_shaft * cos_shaft),
            ])
        }
        /// For integrators, at a state whose guess is the solution: how far loops are from dead centres (the root of a closed form, the determinant of what Newton's method solves), each followed by the rate of its square; then the greatest residual of Newton's method, if it closes loops.
        ///
        /// Method: closed forms, determinants.
        ///
        /// Operations: 1 add, 5 mul, 1 sqrt, 1 sincos; as derived, before optimisation: 1 add, 5 mul, 1 sqrt, 1 sincos.
        #[must_use]
        pub fn margins(
            &self,
            _t: T,
            state: &State<T>,
        ) -> ::multibody::nalgebra::SVector<T, 2> {
            let q = &state.q;
            let v = &state.v;
            let (sin_shaft, cos_shaft) = Real::sin_cos(q.shaft);
            ::multibody::nalgebra::SVector::from([
                Real::sqrt(T::lit(0.018) + T::lit(0.0016) * cos_shaft * cos_shaft),
                (T::lit(-0.0032) * v.shaft * cos_shaft * sin_shaft),
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
        fn margins(
            &self,
            t: T,
            state: &State<T>,
            _input: &Input<T>,
            visit: &mut dyn FnMut(::multibody::Margin<T>),
        ) -> T {
            let margins = self.margins(t, state);
            visit(::multibody::Margin {
                coordinate: "cylinder",
                root: margins[0],
                rate: margins[1],
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
            let (sin_shaft, cos_shaft) = Real::sin_cos(q.shaft);
            let root_cylinder = Real::sqrt(
                T::lit(0.018) + T::lit(0.0016) * cos_shaft * cos_shaft,
            );
            let cylinder = T::lit(0.04) * cos_shaft + root_cylinder;
            let mass_matrix_0_part = cos_shaft * cylinder;
            let mass_matrix_0_part_v2 = mass_matrix_0_part - T::lit(0.04);
            let m_1_1_part = T::lit(0.06326530612244897) * mass_matrix_0_part_v2
                * mass_matrix_0_part_v2;
            let m_1_1 = T::lit(0.00548)
                + (T::lit(0.008571428571428572) * mass_matrix_0_part_v2 + m_1_1_part)
                - (m_1_1_part - T::lit(0.00124) - T::lit(0.005));
            let m_1_2 = T::lit(0.00124)
                + T::lit(0.004285714285714286) * mass_matrix_0_part_v2;
            let mass_matrix_0_part_v3 = sin_shaft * cylinder;
            let mass_matrix_0_part_v4 = mass_matrix_0_part_v3 / root_cylinder;
            let mass_matrix_0_part_v5 = T::lit(7.142857142857143) * mass_matrix_0_part_v3
                * (mass_matrix_0_part_v3
                    + T::lit(0.04) * cos_shaft * mass_matrix_0_part_v4)
                + T::lit(7.142857142857143) * mass_matrix_0_part_v2
                    * (mass_matrix_0_part
                        - T::lit(0.04) * sin_shaft * mass_matrix_0_part_v4);
            let matrix: ::multibody::nalgebra::SMatrix<T, 1, 1> = ::multibody::nalgebra::SMatrix::from([
                [
                    (m_1_1 - T::lit(7.142857142857143) * m_1_2 * mass_matrix_0_part_v5
                        - T::lit(7.142857142857143) * mass_matrix_0_part_v5
                            * (m_1_2
                                - T::lit(0.008857142857142857) * mass_matrix_0_part_v5)
                        + T::lit(0.00064) * mass_matrix_0_part_v4
                            * mass_matrix_0_part_v4),
                ],
            ]);
            ::multibody::pivots::without_inertia(&matrix, &["shaft"])
        }
    }
    /// Names of the components of a velocity, in order.
    pub const COORDINATES: &[&str] = &["shaft"];
    /// The coordinates whose dead centres `dead_centres` tells of, in order.
    pub const DEAD_CENTRES: &[&str] = &["cylinder"];
    /// Operation counts of every function, and of `Model::new`.
    pub const COSTS: &[::multibody::Cost] = &[
        ::multibody::Cost {
            function: "new",
            add: 0,
            mul: 0,
            div: 0,
            sqrt: 0,
            sincos: 0,
            other: 0,
        },
        ::multibody::Cost {
            function: "forward_dynamics",
            add: 33,
            mul: 65,
            div: 2,
            sqrt: 1,
            sincos: 1,
            other: 0,
        },
        ::multibody::Cost {
            function: "inverse_dynamics",
            add: 30,
            mul: 58,
            div: 1,
            sqrt: 1,
            sincos: 1,
            other: 0,
        },
        ::multibody::Cost {
            function: "kinematics",
            add: 5,
            mul: 16,
            div: 1,
            sqrt: 1,
            sincos: 1,
            other: 0,
        },
        ::multibody::Cost {
            function: "outputs",
            add: 83,
            mul: 118,
            div: 8,
            sqrt: 1,
            sincos: 1,
            other: 0,
        },
        ::multibody::Cost {
            function: "dead_centres",
            add: 1,
            mul: 2,
            div: 0,
            sqrt: 1,
            sincos: 1,
            other: 0,
        },
        ::multibody::Cost {
            function: "margins",
            add: 1,
            mul: 5,
            div: 0,
            sqrt: 1,
            sincos: 1,
            other: 0,
        },
    ];
    /// The same of every function as it was derived, before optimisation, with the work on parameters in it.
    pub const DERIVED: &[::multibody::Cost] = &[
        ::multibody::Cost {
            function: "forward_dynamics",
            add: 40,
            mul: 92,
            div: 2,
            sqrt: 1,
            sincos: 1,
            other: 0,
        },
        ::multibody::Cost {
            function: "inverse_dynamics",
            add: 37,
            mul: 84,
            div: 1,
            sqrt: 1,
            sincos: 1,
            other: 0,
        },
        ::multibody::Cost {
            function: "kinematics",
            add: 6,
            mul: 19,
            div: 1,
            sqrt: 1,
            sincos: 1,
            other: 0,
        },
        ::multibody::Cost {
            function: "outputs",
            add: 101,
            mul: 171,
            div: 8,
            sqrt: 1,
            sincos: 1,
            other: 0,
        },
        ::multibody::Cost {
            function: "dead_centres",
            add: 1,
            mul: 2,
            div: 0,
            sqrt: 1,
            sincos: 1,
            other: 0,
        },
        ::multibody::Cost {
            function: "margins",
            add: 1,
            mul: 5,
            div: 0,
            sqrt: 1,
            sincos: 1,
            other: 0,
        },
    ];
}
