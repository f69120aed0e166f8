/// The crank turns about z, the piston slides along x.
///
/// ## Parameters
///
/// | field | unit | default |  |
/// |---|---|---|---|
/// | `load` | `N m s/rad` | `0.05` | of the dynamometer on the shaft |
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
/// | `forward_dynamics` | composite rigid body, LDL^T | 32 add, 61 mul, 2 div, 1 sqrt, 1 sincos | 43 add, 95 mul, 2 div, 1 sqrt, 1 sincos |
/// | `inverse_dynamics` | recursive Newton-Euler | 30 add, 56 mul, 1 div, 1 sqrt, 1 sincos | 37 add, 84 mul, 1 div, 1 sqrt, 1 sincos |
/// | `kinematics` | closed form | 5 add, 16 mul, 1 div, 1 sqrt, 1 sincos | 6 add, 19 mul, 1 div, 1 sqrt, 1 sincos |
/// | `outputs` | world axes | 71 add, 111 mul, 5 div, 1 sqrt, 1 sincos | 90 add, 166 mul, 5 div, 1 sqrt, 1 sincos |
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
        /// `[N m s/rad]` of the dynamometer on the shaft
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
    impl<T: Real> ::multibody::Columns<T> for Params<T> {
        fn columns(
            &self,
            place: &::multibody::Column<'_>,
            f: &mut dyn FnMut(&::multibody::Column<'_>, T),
        ) {
            ::multibody::Columns::columns(
                &self.load,
                &place.field("load", "N m s/rad"),
                f,
            );
        }
    }
    impl<T: Real> ::multibody::Columns<T> for Position<T> {
        fn columns(
            &self,
            place: &::multibody::Column<'_>,
            f: &mut dyn FnMut(&::multibody::Column<'_>, T),
        ) {
            ::multibody::Columns::columns(&self.shaft, &place.field("shaft", "rad"), f);
        }
    }
    impl<T: Real> ::multibody::Columns<T> for Velocity<T> {
        fn columns(
            &self,
            place: &::multibody::Column<'_>,
            f: &mut dyn FnMut(&::multibody::Column<'_>, T),
        ) {
            ::multibody::Columns::columns(
                &self.shaft,
                &place.field("shaft", "rad/s"),
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
            ::multibody::Columns::columns(&self.gas, &place.field("gas", "N"), f);
        }
    }
    impl<T: Real> ::multibody::Columns<T> for Output<T> {
        fn columns(
            &self,
            place: &::multibody::Column<'_>,
            f: &mut dyn FnMut(&::multibody::Column<'_>, T),
        ) {
            ::multibody::Columns::columns(
                &self.bearing,
                &place.field("bearing", "N"),
                f,
            );
            ::multibody::Columns::columns(&self.energy, &place.field("energy", ""), f);
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
    impl<T: Real> From<Params<T>> for ::multibody::nalgebra::SVector<T, 1> {
        fn from(params: Params<T>) -> Self {
            Self::from([params.load])
        }
    }
    impl<T: Real> From<::multibody::nalgebra::SVector<T, 1>> for Params<T> {
        fn from(vector: ::multibody::nalgebra::SVector<T, 1>) -> Self {
            let [[load]] = vector.data.0;
            Params { load }
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
    impl<T: Real> From<Input<T>> for ::multibody::nalgebra::SVector<T, 1> {
        fn from(input: Input<T>) -> Self {
            Self::from([input.gas])
        }
    }
    impl<T: Real> From<::multibody::nalgebra::SVector<T, 1>> for Input<T> {
        fn from(vector: ::multibody::nalgebra::SVector<T, 1>) -> Self {
            let [[gas]] = vector.data.0;
            Input { gas }
        }
    }
    impl<T: Real> From<State<T>> for ::multibody::nalgebra::SVector<T, 2> {
        fn from(state: State<T>) -> Self {
            Self::from([state.q.shaft, state.v.shaft])
        }
    }
    impl<T: Real> From<::multibody::nalgebra::SVector<T, 2>> for State<T> {
        fn from(vector: ::multibody::nalgebra::SVector<T, 2>) -> Self {
            let [[q_shaft, v_shaft]] = vector.data.0;
            State {
                q: Position { shaft: q_shaft },
                v: Velocity { shaft: v_shaft },
            }
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
        /// Method: composite rigid body, LDL^T.
        ///
        /// Operations: 32 add, 61 mul, 2 div, 1 sqrt, 1 sincos; as derived, before optimisation: 43 add, 95 mul, 2 div, 1 sqrt, 1 sincos.
        #[must_use]
        pub fn forward_dynamics(
            &self,
            _t: T,
            state: &State<T>,
            input: &Input<T>,
        ) -> Velocity<T> {
            let q = &state.q;
            let v = &state.v;
            // Closed form of cylinder.
            let (sin_shaft, cos_shaft) = Real::sin_cos(q.shaft);
            let root_cylinder = Real::sqrt(
                T::lit(0.018) + T::lit(0.0016) * cos_shaft * cos_shaft,
            );
            let cos_shaft_times_0_04 = T::lit(0.04) * cos_shaft;
            let cylinder = root_cylinder + cos_shaft_times_0_04;
            let minus_big_end_v = sin_shaft * cylinder;
            // Accelerations of what follows.
            let shaft_rate_times_sin_shaft = v.shaft * sin_shaft;
            let slope_cylinder_inv = T::lit(1.0) / root_cylinder;
            let cylinder_times_shaft_rate_times_sin_shaft = cylinder
                * shaft_rate_times_sin_shaft;
            let gap_accel_with_root_cylinder = slope_cylinder_inv
                * cylinder_times_shaft_rate_times_sin_shaft;
            let gap_accel_with_shaft_rate = shaft_rate_times_sin_shaft
                * gap_accel_with_root_cylinder;
            // Force and moment through big_end.
            let cos_shaft_times_cylinder = cos_shaft * cylinder;
            let sin_shaft_times_0_04 = T::lit(0.04) * sin_shaft;
            let side_1_with_shaft_rate = v.shaft * cos_shaft_times_cylinder
                - gap_accel_with_root_cylinder * sin_shaft_times_0_04;
            let w2_shaft_z = v.shaft * v.shaft;
            let minus_cylinder_accel = slope_cylinder_inv
                * (T::lit(0.0016) * gap_accel_with_root_cylinder
                    * gap_accel_with_root_cylinder
                    - T::lit(0.0032) * gap_accel_with_shaft_rate
                    + T::lit(0.04) * cos_shaft_times_cylinder * w2_shaft_z);
            let big_end_u = cos_shaft_times_cylinder - T::lit(0.04);
            let big_end_gap_accel_with_root_cylinder = gap_accel_with_root_cylinder
                * cos_shaft_times_0_04;
            let side_1_with_cylinder = cylinder_times_shaft_rate_times_sin_shaft
                + big_end_gap_accel_with_root_cylinder;
            let big_end_gap_accel_with_big_end_v = minus_big_end_v
                * (v.shaft * side_1_with_shaft_rate
                    - T::lit(0.04) * gap_accel_with_shaft_rate
                    + cos_shaft * minus_cylinder_accel)
                - big_end_u
                    * (sin_shaft * minus_cylinder_accel
                        + v.shaft
                            * (side_1_with_cylinder
                                + big_end_gap_accel_with_root_cylinder));
            let minus_n_big_end_z = T::lit(0.06326530612244897)
                * big_end_gap_accel_with_big_end_v
                + T::lit(0.004285714285714286) * minus_big_end_v * w2_shaft_z;
            // Results.
            let side_1_with_big_end_u = v.shaft
                - T::lit(51.02040816326531)
                    * (big_end_u * side_1_with_shaft_rate
                        + minus_big_end_v * side_1_with_cylinder);
            let slope_cylinder_inv_times_minus_big_end_v = slope_cylinder_inv
                * minus_big_end_v;
            let minus_big_end_v_times_minus_n_big_end_z = minus_big_end_v
                * minus_n_big_end_z;
            let big_end_u_times_minus_n_big_end_z = big_end_u * minus_n_big_end_z;
            let side_1_with_big_end_v = T::lit(0.10714285714285714) * minus_big_end_v
                * side_1_with_big_end_u * side_1_with_big_end_u
                - T::lit(5.466472303206997) * big_end_u
                    * big_end_gap_accel_with_big_end_v
                - slope_cylinder_inv_times_minus_big_end_v
                    * (input.gas - T::lit(0.4) * minus_cylinder_accel
                        - T::lit(51.02040816326531)
                            * (cos_shaft * minus_big_end_v_times_minus_n_big_end_z
                                - sin_shaft * big_end_u_times_minus_n_big_end_z));
            let pivot_1_with_big_end_v = minus_big_end_v
                * (minus_big_end_v
                    + slope_cylinder_inv_times_minus_big_end_v * cos_shaft_times_0_04)
                + big_end_u
                    * (cos_shaft_times_cylinder
                        - slope_cylinder_inv_times_minus_big_end_v
                            * sin_shaft_times_0_04);
            let pivot_1 = T::lit(0.01172) + T::lit(0.008571428571428572) * big_end_u
                + T::lit(0.00064) * slope_cylinder_inv_times_minus_big_end_v
                    * slope_cylinder_inv_times_minus_big_end_v
                + T::lit(0.43731778425655976) * pivot_1_with_big_end_v
                    * (T::lit(7.380952380952381) * pivot_1_with_big_end_v
                        - T::lit(0.28933333333333333) - big_end_u);
            let minus_shaft_accel = (self.load * v.shaft - minus_n_big_end_z
                + T::lit(0.04) * side_1_with_big_end_v
                + T::lit(51.02040816326531)
                    * (cos_shaft_times_cylinder * big_end_u_times_minus_n_big_end_z
                        + minus_big_end_v * minus_big_end_v_times_minus_n_big_end_z))
                / pivot_1;
            Velocity {
                shaft: -minus_shaft_accel,
            }
        }
        /// Efforts that the accelerations `accel` need beside all declared forces.
        ///
        /// Method: recursive Newton-Euler.
        ///
        /// Operations: 30 add, 56 mul, 1 div, 1 sqrt, 1 sincos; as derived, before optimisation: 37 add, 84 mul, 1 div, 1 sqrt, 1 sincos.
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
            // Closed form of cylinder.
            let (sin_shaft, cos_shaft) = Real::sin_cos(q.shaft);
            let root_cylinder = Real::sqrt(
                T::lit(0.018) + T::lit(0.0016) * cos_shaft * cos_shaft,
            );
            let cos_shaft_times_0_04 = T::lit(0.04) * cos_shaft;
            let cylinder = root_cylinder + cos_shaft_times_0_04;
            let minus_big_end_v = sin_shaft * cylinder;
            let w2_shaft_z = v.shaft * v.shaft;
            let cos_shaft_times_cylinder = cos_shaft * cylinder;
            let big_end_u = cos_shaft_times_cylinder - T::lit(0.04);
            // Accelerations of what follows.
            let shaft_rate_times_sin_shaft = v.shaft * sin_shaft;
            let slope_cylinder_inv = T::lit(1.0) / root_cylinder;
            let cylinder_times_shaft_rate_times_sin_shaft = cylinder
                * shaft_rate_times_sin_shaft;
            let u_big_end_yx_with_root_cylinder = slope_cylinder_inv
                * cylinder_times_shaft_rate_times_sin_shaft;
            let u_big_end_yx_with_shaft_rate = shaft_rate_times_sin_shaft
                * u_big_end_yx_with_root_cylinder;
            let cylinder_gap_accel = T::lit(0.0016) * u_big_end_yx_with_root_cylinder
                * u_big_end_yx_with_root_cylinder
                - T::lit(0.0032) * u_big_end_yx_with_shaft_rate
                + T::lit(0.04) * cylinder
                    * (accel.shaft * sin_shaft + cos_shaft * w2_shaft_z);
            let minus_cylinder_accel = slope_cylinder_inv * cylinder_gap_accel;
            // Force and moment through big_end.
            let shaft_effort_with_rate = v.shaft * cos_shaft_times_cylinder
                - T::lit(0.04) * sin_shaft * u_big_end_yx_with_root_cylinder;
            let u_big_end_yx_with_cylinder = u_big_end_yx_with_root_cylinder
                * cos_shaft_times_0_04;
            let shaft_effort_with_cylinder = cylinder_times_shaft_rate_times_sin_shaft
                + u_big_end_yx_with_cylinder;
            let u_big_end_yx_with_big_end_v = minus_big_end_v
                * (T::lit(0.04) * u_big_end_yx_with_shaft_rate
                    - cos_shaft * minus_cylinder_accel - accel.shaft * minus_big_end_v
                    - v.shaft * shaft_effort_with_rate)
                + big_end_u
                    * (sin_shaft * minus_cylinder_accel
                        - accel.shaft * cos_shaft_times_cylinder
                        + v.shaft
                            * (shaft_effort_with_cylinder + u_big_end_yx_with_cylinder));
            let u_big_end_yx = accel.shaft
                + T::lit(51.02040816326531) * u_big_end_yx_with_big_end_v;
            let minus_n_big_end_z = T::lit(0.004285714285714286)
                * (minus_big_end_v * w2_shaft_z - accel.shaft * big_end_u)
                - T::lit(0.00124) * u_big_end_yx;
            // Results.
            let shaft_effort_with_big_end_u = v.shaft
                - T::lit(51.02040816326531)
                    * (big_end_u * shaft_effort_with_rate
                        + minus_big_end_v * shaft_effort_with_cylinder);
            let minus_big_end_v_times_minus_n_big_end_z = minus_big_end_v
                * minus_n_big_end_z;
            let big_end_u_times_minus_n_big_end_z = big_end_u * minus_n_big_end_z;
            let shaft_effort_with_root_cylinder = shaft_effort_with_big_end_u
                * shaft_effort_with_big_end_u
                - T::lit(9.333333333333334) * slope_cylinder_inv
                    * (input.gas - T::lit(0.4) * minus_cylinder_accel
                        - T::lit(51.02040816326531)
                            * (cos_shaft * minus_big_end_v_times_minus_n_big_end_z
                                - sin_shaft * big_end_u_times_minus_n_big_end_z));
            Velocity {
                shaft: T::lit(0.01048) * accel.shaft + self.load * v.shaft
                    - minus_n_big_end_z
                    + T::lit(0.004285714285714286)
                        * (big_end_u * u_big_end_yx
                            + minus_big_end_v * shaft_effort_with_root_cylinder)
                    + T::lit(51.02040816326531)
                        * (cos_shaft_times_cylinder * big_end_u_times_minus_n_big_end_z
                            + minus_big_end_v * minus_big_end_v_times_minus_n_big_end_z),
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
            // Closed form of cylinder.
            let (sin_shaft, cos_shaft) = Real::sin_cos(q.shaft);
            let root_cylinder = Real::sqrt(
                T::lit(0.018) + T::lit(0.0016) * cos_shaft * cos_shaft,
            );
            let cylinder = T::lit(0.04) * cos_shaft + root_cylinder;
            // Accelerations of what follows.
            let slope_cylinder_inv = T::lit(1.0) / root_cylinder;
            let shaft_rate_times_sin_shaft = v.shaft * sin_shaft;
            let cylinder_rate_with_cylinder = cylinder * slope_cylinder_inv
                * shaft_rate_times_sin_shaft;
            let cylinder_gap_accel = T::lit(0.04) * cylinder
                * (accel.shaft * sin_shaft + v.shaft * v.shaft * cos_shaft)
                + cylinder_rate_with_cylinder
                    * (T::lit(0.0016) * cylinder_rate_with_cylinder
                        - T::lit(0.0032) * shaft_rate_times_sin_shaft);
            ::multibody::Kinematics {
                position: ::multibody::nalgebra::SVector::from([cylinder]),
                velocity: ::multibody::nalgebra::SVector::from([
                    (T::lit(-0.04) * cylinder_rate_with_cylinder),
                ]),
                acceleration: ::multibody::nalgebra::SVector::from([
                    (-slope_cylinder_inv * cylinder_gap_accel),
                ]),
                residual: T::lit(0.0),
            }
        }
        /// Outputs.
        ///
        /// Method: world axes.
        ///
        /// Operations: 71 add, 111 mul, 5 div, 1 sqrt, 1 sincos; as derived, before optimisation: 90 add, 166 mul, 5 div, 1 sqrt, 1 sincos.
        #[must_use]
        pub fn outputs(&self, _t: T, state: &State<T>, input: &Input<T>) -> Output<T> {
            let q = &state.q;
            let v = &state.v;
            // Closed form of cylinder.
            let (sin_shaft, cos_shaft) = Real::sin_cos(q.shaft);
            let root_cylinder = Real::sqrt(
                T::lit(0.018) + T::lit(0.0016) * cos_shaft * cos_shaft,
            );
            let cos_shaft_times_0_04 = T::lit(0.04) * cos_shaft;
            let cylinder = root_cylinder + cos_shaft_times_0_04;
            let minus_big_end_v = sin_shaft * cylinder;
            let w2_shaft_z = v.shaft * v.shaft;
            let minus_big_end_v_times_w2_shaft_z = minus_big_end_v * w2_shaft_z;
            let cos_shaft_times_cylinder = cos_shaft * cylinder;
            let big_end_u = cos_shaft_times_cylinder - T::lit(0.04);
            // Accelerations of what follows.
            let slope_cylinder_inv = T::lit(1.0) / root_cylinder;
            let shaft_rate_times_sin_shaft = v.shaft * sin_shaft;
            let cylinder_times_shaft_rate_times_sin_shaft = cylinder
                * shaft_rate_times_sin_shaft;
            let u_big_end_yx_with_root_cylinder = slope_cylinder_inv
                * cylinder_times_shaft_rate_times_sin_shaft;
            let cylinder_gap_accel_with_root_cylinder = u_big_end_yx_with_root_cylinder
                * u_big_end_yx_with_root_cylinder;
            let u_big_end_yx_with_shaft_rate = shaft_rate_times_sin_shaft
                * u_big_end_yx_with_root_cylinder;
            let cylinder_gap_accel_with_cylinder = T::lit(0.0016)
                * cylinder_gap_accel_with_root_cylinder
                - T::lit(0.0032) * u_big_end_yx_with_shaft_rate;
            let cos_shaft_times_w2_shaft_z = cos_shaft * w2_shaft_z;
            let cylinder_times_0_04 = T::lit(0.04) * cylinder;
            let minus_cylinder_accel = slope_cylinder_inv
                * (cylinder_gap_accel_with_cylinder
                    + cos_shaft_times_w2_shaft_z * cylinder_times_0_04);
            // Force and moment through big_end.
            let sin_shaft_times_0_04 = T::lit(0.04) * sin_shaft;
            let w_big_end_z_with_shaft_rate = v.shaft * cos_shaft_times_cylinder
                - u_big_end_yx_with_root_cylinder * sin_shaft_times_0_04;
            let u_big_end_yx_with_sin_shaft = T::lit(0.04) * u_big_end_yx_with_shaft_rate
                - v.shaft * w_big_end_z_with_shaft_rate;
            let u_big_end_yx_with_cylinder = u_big_end_yx_with_root_cylinder
                * cos_shaft_times_0_04;
            let w_big_end_z_with_cylinder = cylinder_times_shaft_rate_times_sin_shaft
                + u_big_end_yx_with_cylinder;
            let u_big_end_yx_with_cos_shaft = v.shaft
                * (w_big_end_z_with_cylinder + u_big_end_yx_with_cylinder);
            let big_end_gap_accel_with_big_end_v = minus_big_end_v
                * (cos_shaft * minus_cylinder_accel - u_big_end_yx_with_sin_shaft)
                - big_end_u
                    * (sin_shaft * minus_cylinder_accel + u_big_end_yx_with_cos_shaft);
            let minus_n_big_end_z = T::lit(0.06326530612244897)
                * big_end_gap_accel_with_big_end_v
                + T::lit(0.004285714285714286) * minus_big_end_v_times_w2_shaft_z;
            let w_big_end_z = v.shaft
                - T::lit(51.02040816326531)
                    * (big_end_u * w_big_end_z_with_shaft_rate
                        + minus_big_end_v * w_big_end_z_with_cylinder);
            // Motion of shaft.
            let w2_big_end_z = w_big_end_z * w_big_end_z;
            let slope_cylinder_inv_times_minus_big_end_v = slope_cylinder_inv
                * minus_big_end_v;
            let minus_big_end_v_times_minus_n_big_end_z = minus_big_end_v
                * minus_n_big_end_z;
            let big_end_u_times_minus_n_big_end_z = big_end_u * minus_n_big_end_z;
            let side_1_with_big_end_v = T::lit(0.10714285714285714) * minus_big_end_v
                * w2_big_end_z
                - T::lit(5.466472303206997) * big_end_u
                    * big_end_gap_accel_with_big_end_v
                - slope_cylinder_inv_times_minus_big_end_v
                    * (input.gas - T::lit(0.4) * minus_cylinder_accel
                        - T::lit(51.02040816326531)
                            * (cos_shaft * minus_big_end_v_times_minus_n_big_end_z
                                - sin_shaft * big_end_u_times_minus_n_big_end_z));
            let pivot_1_with_big_end_v = minus_big_end_v
                * (minus_big_end_v
                    + slope_cylinder_inv_times_minus_big_end_v * cos_shaft_times_0_04)
                + big_end_u
                    * (cos_shaft_times_cylinder
                        - slope_cylinder_inv_times_minus_big_end_v
                            * sin_shaft_times_0_04);
            let pivot_1 = T::lit(0.01172) + T::lit(0.008571428571428572) * big_end_u
                + T::lit(0.00064) * slope_cylinder_inv_times_minus_big_end_v
                    * slope_cylinder_inv_times_minus_big_end_v
                + T::lit(0.43731778425655976) * pivot_1_with_big_end_v
                    * (T::lit(7.380952380952381) * pivot_1_with_big_end_v
                        - T::lit(0.28933333333333333) - big_end_u);
            let minus_dw_shaft_z = (self.load * v.shaft - minus_n_big_end_z
                + T::lit(0.04) * side_1_with_big_end_v
                + T::lit(51.02040816326531)
                    * (cos_shaft_times_cylinder * big_end_u_times_minus_n_big_end_z
                        + minus_big_end_v * minus_big_end_v_times_minus_n_big_end_z))
                / pivot_1;
            let a_big_end_y_with_big_end_u = minus_big_end_v_times_w2_shaft_z
                + big_end_u * minus_dw_shaft_z;
            let minus_cylinder_accel_with_root_cylinder = slope_cylinder_inv
                * (cylinder_gap_accel_with_cylinder
                    + (cos_shaft_times_w2_shaft_z - sin_shaft * minus_dw_shaft_z)
                        * cylinder_times_0_04);
            // Force and moment through big_end.
            let minus_big_end_v_times_minus_dw_shaft_z = minus_big_end_v
                * minus_dw_shaft_z;
            let u_big_end_yx_with_big_end_v = minus_big_end_v
                * (minus_big_end_v_times_minus_dw_shaft_z
                    - cos_shaft * minus_cylinder_accel_with_root_cylinder
                    + u_big_end_yx_with_sin_shaft)
                + big_end_u
                    * (sin_shaft * minus_cylinder_accel_with_root_cylinder
                        + cos_shaft_times_cylinder * minus_dw_shaft_z
                        + u_big_end_yx_with_cos_shaft);
            let minus_u_big_end_yx = minus_dw_shaft_z
                - T::lit(51.02040816326531) * u_big_end_yx_with_big_end_v;
            let minus_multiplier_1 = input.gas
                - T::lit(0.4) * minus_cylinder_accel_with_root_cylinder;
            let minus_big_end_v_times_7_14 = T::lit(7.142857142857143) * minus_big_end_v;
            let big_end_u_times_7_14 = T::lit(7.142857142857143) * big_end_u;
            let f_big_end_with_sin_shaft = sin_shaft * big_end_u_times_7_14
                - cos_shaft * minus_big_end_v_times_7_14;
            let ([multiplier_2], _) = ::multibody::linear::solve(
                [[-root_cylinder]],
                [
                    (T::lit(0.004285714285714286) * a_big_end_y_with_big_end_u
                        + T::lit(0.00124) * minus_u_big_end_yx
                        - minus_multiplier_1 * sin_shaft_times_0_04),
                ],
            );
            let f_big_end_with_cos_shaft = sin_shaft * minus_big_end_v_times_7_14
                + cos_shaft * big_end_u_times_7_14;
            let minus_f_big_end_y = T::lit(0.08571428571428572)
                * a_big_end_y_with_big_end_u + T::lit(0.015) * minus_u_big_end_yx
                + minus_multiplier_1 * f_big_end_with_sin_shaft
                + multiplier_2 * f_big_end_with_cos_shaft;
            let f_big_end_x = minus_multiplier_1 * f_big_end_with_cos_shaft
                - T::lit(0.015) * w2_big_end_z - multiplier_2 * f_big_end_with_sin_shaft
                - T::lit(0.08571428571428572)
                    * (big_end_u * w2_shaft_z - minus_big_end_v_times_minus_dw_shaft_z);
            // Results.
            let f_big_end_passed_x = f_big_end_x * big_end_u_times_7_14
                - minus_f_big_end_y * minus_big_end_v_times_7_14;
            let minus_f_big_end_passed_y = f_big_end_x * minus_big_end_v_times_7_14
                + minus_f_big_end_y * big_end_u_times_7_14;
            Output {
                bearing: ::multibody::nalgebra::Vector3::from([
                    (cos_shaft * f_big_end_passed_x
                        + sin_shaft * minus_f_big_end_passed_y),
                    (sin_shaft * f_big_end_passed_x
                        - cos_shaft * minus_f_big_end_passed_y),
                    T::lit(0.0),
                ]),
                energy: T::lit(0.00032) * cylinder_gap_accel_with_root_cylinder
                    + T::lit(0.00524) * w2_shaft_z + T::lit(0.00062) * w2_big_end_z
                    + T::lit(0.004285714285714286) * v.shaft * big_end_u * w_big_end_z,
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
            // Closed form of cylinder.
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
            // Closed form of cylinder.
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
            // Closed form of cylinder.
            let (sin_shaft, cos_shaft) = Real::sin_cos(q.shaft);
            let root_cylinder = Real::sqrt(
                T::lit(0.018) + T::lit(0.0016) * cos_shaft * cos_shaft,
            );
            let cylinder = T::lit(0.04) * cos_shaft + root_cylinder;
            let cos_shaft_times_cylinder = cos_shaft * cylinder;
            let big_end_u = cos_shaft_times_cylinder - T::lit(0.04);
            let big_end_u_squared_times_0_0633 = T::lit(0.06326530612244897) * big_end_u
                * big_end_u;
            let m_1_1 = T::lit(0.00548)
                + (T::lit(0.008571428571428572) * big_end_u
                    + big_end_u_squared_times_0_0633)
                - (big_end_u_squared_times_0_0633 - T::lit(0.00124) - T::lit(0.005));
            let m_1_2 = T::lit(0.00124) + T::lit(0.004285714285714286) * big_end_u;
            let minus_big_end_v = sin_shaft * cylinder;
            // Results.
            let minus_big_end_v_over_root_cylinder = minus_big_end_v / root_cylinder;
            let mass_matrix_0_with_big_end_v = T::lit(7.142857142857143)
                * minus_big_end_v
                * (minus_big_end_v
                    + T::lit(0.04) * cos_shaft * minus_big_end_v_over_root_cylinder)
                + T::lit(7.142857142857143) * big_end_u
                    * (cos_shaft_times_cylinder
                        - T::lit(0.04) * sin_shaft * minus_big_end_v_over_root_cylinder);
            let matrix: ::multibody::nalgebra::SMatrix<T, 1, 1> = ::multibody::nalgebra::SMatrix::from([
                [
                    (m_1_1
                        - T::lit(7.142857142857143) * m_1_2
                            * mass_matrix_0_with_big_end_v
                        - T::lit(7.142857142857143) * mass_matrix_0_with_big_end_v
                            * (m_1_2
                                - T::lit(0.008857142857142857)
                                    * mass_matrix_0_with_big_end_v)
                        + T::lit(0.00064) * minus_big_end_v_over_root_cylinder
                            * minus_big_end_v_over_root_cylinder),
                ],
            ]);
            ::multibody::pivots::without_inertia(&matrix, &["shaft"])
        }
    }
    /// Names of the components of a velocity, in order.
    pub const COORDINATES: &[&str] = &["shaft"];
    /// The coordinates whose dead centres `dead_centres` tells of, in order.
    pub const DEAD_CENTRES: &[&str] = &["cylinder"];
    /// The equations of the model, those of identical parts once. Each stands after those that it reads, but for equations of
    /// motion in the names of their parts, which stand before these.
    pub const FORMULAS: &[::multibody::Equation] = &[
        ::multibody::Equation {
            section: "Coordinates that follow",
            text: "u_1 = sqrt(0.018 + 0.0016 cos(shaft)²)",
            latex: "u_{\\mathrm{1}} = \\sqrt{0.018 + 0.0016\\,\\left(\\cos\\left(\\mathrm{shaft}\\right)\\right)^{2}}",
            says: "",
        },
        ::multibody::Equation {
            section: "Coordinates that follow",
            text: "cylinder = u_1 + 0.04 cos(shaft)",
            latex: "\\mathrm{cylinder} = u_{\\mathrm{1}} + 0.04\\,\\cos\\left(\\mathrm{shaft}\\right)",
            says: "the branch with cylinder > 0; real everywhere",
        },
        ::multibody::Equation {
            section: "Coordinates that follow",
            text: "cos(big_end) = 2 (25 cylinder cos(shaft) - 1) / 7",
            latex: "\\cos\\left(\\mathrm{big\\_end}\\right) = \\frac{2\\,\\left(25\\,\\mathrm{cylinder}\\,\\cos\\left(\\mathrm{shaft}\\right) - 1\\right)}{7}",
            says: "",
        },
        ::multibody::Equation {
            section: "Coordinates that follow",
            text: "sin(big_end) = -50 cylinder sin(shaft) / 7",
            latex: "\\sin\\left(\\mathrm{big\\_end}\\right) = -\\frac{50\\,\\mathrm{cylinder}\\,\\sin\\left(\\mathrm{shaft}\\right)}{7}",
            says: "",
        },
        ::multibody::Equation {
            section: "Coordinates that follow",
            text: "S[cylinder, shaft] = -0.04 cylinder sin(shaft) / u_1",
            latex: "S_{\\mathrm{cylinder, shaft}} = -\\frac{0.04\\,\\mathrm{cylinder}\\,\\sin\\left(\\mathrm{shaft}\\right)}{u_{\\mathrm{1}}}",
            says: "",
        },
        ::multibody::Equation {
            section: "Coordinates that follow",
            text: "S[big_end, shaft] = -50 (S[cylinder, shaft] sin(shaft + big_end) + cylinder cos(shaft + big_end)) / 7",
            latex: "S_{\\mathrm{big\\_end, shaft}} = -\\frac{50\\,\\left(S_{\\mathrm{cylinder, shaft}}\\,\\sin\\left(\\mathrm{shaft} + \\mathrm{big\\_end}\\right) + \\mathrm{cylinder}\\,\\cos\\left(\\mathrm{shaft} + \\mathrm{big\\_end}\\right)\\right)}{7}",
            says: "",
        },
        ::multibody::Equation {
            section: "Coordinates that follow",
            text: "cylinder˙ = S[cylinder, shaft] shaft˙",
            latex: "\\dot{\\mathrm{cylinder}} = S_{\\mathrm{cylinder, shaft}}\\,\\dot{\\mathrm{shaft}}",
            says: "",
        },
        ::multibody::Equation {
            section: "Coordinates that follow",
            text: "big_end˙ = S[big_end, shaft] shaft˙",
            latex: "\\dot{\\mathrm{big\\_end}} = S_{\\mathrm{big\\_end, shaft}}\\,\\dot{\\mathrm{shaft}}",
            says: "",
        },
        ::multibody::Equation {
            section: "Coordinates that follow",
            text: "gamma[cylinder] = -(0.04 cylinder cos(shaft) (shaft˙)² + 0.08 sin(shaft) shaft˙ cylinder˙ + (cylinder˙)²) / u_1",
            latex: "\\gamma_{\\mathrm{cylinder}} = -\\frac{0.04\\,\\mathrm{cylinder}\\,\\cos\\left(\\mathrm{shaft}\\right)\\,\\dot{\\mathrm{shaft}}^{2} + 0.08\\,\\sin\\left(\\mathrm{shaft}\\right)\\,\\dot{\\mathrm{shaft}}\\,\\dot{\\mathrm{cylinder}} + \\dot{\\mathrm{cylinder}}^{2}}{u_{\\mathrm{1}}}",
            says: "",
        },
        ::multibody::Equation {
            section: "Coordinates that follow",
            text: "gamma[big_end] = -2 (50 cos(shaft + big_end) cylinder˙ (shaft˙ + big_end˙) + 25 gamma[cylinder] sin(shaft + big_end) + sin(big_end) (big_end˙)² - 25 cylinder sin(shaft + big_end) (shaft˙ + big_end˙)²) / 7",
            latex: "\\gamma_{\\mathrm{big\\_end}} = -\\frac{2\\,\\left(50\\,\\cos\\left(\\mathrm{shaft} + \\mathrm{big\\_end}\\right)\\,\\dot{\\mathrm{cylinder}}\\,\\left(\\dot{\\mathrm{shaft}} + \\dot{\\mathrm{big\\_end}}\\right) + 25\\,\\gamma_{\\mathrm{cylinder}}\\,\\sin\\left(\\mathrm{shaft} + \\mathrm{big\\_end}\\right) + \\sin\\left(\\mathrm{big\\_end}\\right)\\,\\dot{\\mathrm{big\\_end}}^{2} - 25\\,\\mathrm{cylinder}\\,\\sin\\left(\\mathrm{shaft} + \\mathrm{big\\_end}\\right)\\,\\left(\\dot{\\mathrm{shaft}} + \\dot{\\mathrm{big\\_end}}\\right)^{2}\\right)}{7}",
            says: "",
        },
        ::multibody::Equation {
            section: "Equations of motion",
            text: "shaft¨ (S[big_end, shaft] (0.00248 + 0.00124 S[big_end, shaft] + 0.0012 cos(big_end)) + 0.01172 + 0.4 S[cylinder, shaft]² + 0.0012 cos(big_end)) + gamma[big_end] (0.00124 + 0.00124 S[big_end, shaft] + 0.0006 cos(big_end)) + 0.4 S[cylinder, shaft] gamma[cylinder] - 0.0006 sin(big_end) (2 shaft˙ big_end˙ + (big_end˙)² - S[big_end, shaft] (shaft˙)²) = -load shaft˙ - gas S[cylinder, shaft]",
            latex: "\\ddot{\\mathrm{shaft}}\\,\\left(S_{\\mathrm{big\\_end, shaft}}\\,\\left(0.00248 + 0.00124\\,S_{\\mathrm{big\\_end, shaft}} + 0.0012\\,\\cos\\left(\\mathrm{big\\_end}\\right)\\right) + 0.01172 + 0.4\\,S_{\\mathrm{cylinder, shaft}}^{2} + 0.0012\\,\\cos\\left(\\mathrm{big\\_end}\\right)\\right) + \\gamma_{\\mathrm{big\\_end}}\\,\\left(0.00124 + 0.00124\\,S_{\\mathrm{big\\_end, shaft}} + 0.0006\\,\\cos\\left(\\mathrm{big\\_end}\\right)\\right) + 0.4\\,S_{\\mathrm{cylinder, shaft}}\\,\\gamma_{\\mathrm{cylinder}} - 0.0006\\,\\sin\\left(\\mathrm{big\\_end}\\right)\\,\\left(2\\,\\dot{\\mathrm{shaft}}\\,\\dot{\\mathrm{big\\_end}} + \\dot{\\mathrm{big\\_end}}^{2} - S_{\\mathrm{big\\_end, shaft}}\\,\\dot{\\mathrm{shaft}}^{2}\\right) = -\\mathrm{load}\\,\\dot{\\mathrm{shaft}} - \\mathrm{gas}\\,S_{\\mathrm{cylinder, shaft}}",
            says: "",
        },
        ::multibody::Equation {
            section: "Mass matrix and forces",
            text: "M[shaft, shaft] = S[big_end, shaft] (0.00248 + 0.00124 S[big_end, shaft] + 0.0012 cos(big_end)) + 0.01172 + 0.4 S[cylinder, shaft]² + 0.0012 cos(big_end)",
            latex: "M_{\\mathrm{shaft, shaft}} = S_{\\mathrm{big\\_end, shaft}}\\,\\left(0.00248 + 0.00124\\,S_{\\mathrm{big\\_end, shaft}} + 0.0012\\,\\cos\\left(\\mathrm{big\\_end}\\right)\\right) + 0.01172 + 0.4\\,S_{\\mathrm{cylinder, shaft}}^{2} + 0.0012\\,\\cos\\left(\\mathrm{big\\_end}\\right)",
            says: "",
        },
        ::multibody::Equation {
            section: "Mass matrix and forces",
            text: "c[shaft] = gamma[big_end] (0.00124 + 0.00124 S[big_end, shaft] + 0.0006 cos(big_end)) + 0.4 S[cylinder, shaft] gamma[cylinder] - 0.0006 sin(big_end) (2 shaft˙ big_end˙ + (big_end˙)² - S[big_end, shaft] (shaft˙)²)",
            latex: "c_{\\mathrm{shaft}} = \\gamma_{\\mathrm{big\\_end}}\\,\\left(0.00124 + 0.00124\\,S_{\\mathrm{big\\_end, shaft}} + 0.0006\\,\\cos\\left(\\mathrm{big\\_end}\\right)\\right) + 0.4\\,S_{\\mathrm{cylinder, shaft}}\\,\\gamma_{\\mathrm{cylinder}} - 0.0006\\,\\sin\\left(\\mathrm{big\\_end}\\right)\\,\\left(2\\,\\dot{\\mathrm{shaft}}\\,\\dot{\\mathrm{big\\_end}} + \\dot{\\mathrm{big\\_end}}^{2} - S_{\\mathrm{big\\_end, shaft}}\\,\\dot{\\mathrm{shaft}}^{2}\\right)",
            says: "",
        },
        ::multibody::Equation {
            section: "Mass matrix and forces",
            text: "g[shaft] = 0",
            latex: "g_{\\mathrm{shaft}} = 0",
            says: "",
        },
        ::multibody::Equation {
            section: "Mass matrix and forces",
            text: "Q[shaft] = -load shaft˙ - gas S[cylinder, shaft]",
            latex: "Q_{\\mathrm{shaft}} = -\\mathrm{load}\\,\\dot{\\mathrm{shaft}} - \\mathrm{gas}\\,S_{\\mathrm{cylinder, shaft}}",
            says: "",
        },
        ::multibody::Equation {
            section: "Outputs",
            text: "bearing[z] = 0",
            latex: "\\mathrm{bearing}_{\\mathrm{z}} = 0",
            says: "",
        },
        ::multibody::Equation {
            section: "Outputs",
            text: "energy = shaft˙ (0.0006 cos(big_end) (shaft˙ + big_end˙) + 0.00586 shaft˙ + 0.00124 big_end˙) + 0.00062 (big_end˙)² + 0.2 (cylinder˙)²",
            latex: "\\mathrm{energy} = \\dot{\\mathrm{shaft}}\\,\\left(0.0006\\,\\cos\\left(\\mathrm{big\\_end}\\right)\\,\\left(\\dot{\\mathrm{shaft}} + \\dot{\\mathrm{big\\_end}}\\right) + 0.00586\\,\\dot{\\mathrm{shaft}} + 0.00124\\,\\dot{\\mathrm{big\\_end}}\\right) + 0.00062\\,\\dot{\\mathrm{big\\_end}}^{2} + 0.2\\,\\dot{\\mathrm{cylinder}}^{2}",
            says: "",
        },
    ];
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
            add: 32,
            mul: 61,
            div: 2,
            sqrt: 1,
            sincos: 1,
            other: 0,
        },
        ::multibody::Cost {
            function: "inverse_dynamics",
            add: 30,
            mul: 56,
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
            add: 71,
            mul: 111,
            div: 5,
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
            add: 43,
            mul: 95,
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
            add: 90,
            mul: 166,
            div: 5,
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
