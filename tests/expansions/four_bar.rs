/// A four-bar in gravity, with a spring; its loop is solved.
///
/// ## Coordinates
///
/// | joint | kind | parent | child | freedoms |  |
/// |---|---|---|---|---|---|
/// | `crank` | revolute | ground | `arm` | 1 |  |
/// | `coupler` | revolute | `arm` | `link` | 0 of 1 |  |
/// | `rocker` | revolute | ground | `lever` | 0 of 1 |  |
///
/// ## Inputs
///
/// | field | unit | type |  |
/// |---|---|---|---|
/// | `torque` |  | scalar |  |
///
/// ## Outputs
///
/// | field | unit | type |  |
/// |---|---|---|---|
/// | `angles` |  | 3 of scalar |  |
/// | `rates` |  | 3 of scalar |  |
/// | `accels` |  | 3 of scalar |  |
/// | `reactions` |  | 2 of vector | of the arm's tip against the ground, and of the pin |
/// | `energy` |  | scalar |  |
///
/// ## Bodies
///
/// | body | inertia |  |
/// |---|---|---|
/// | `arm` | rigid body |  |
/// | `link` | rigid body |  |
/// | `lever` | rigid body |  |
///
/// ## Loops
///
/// | closed by | kind | between | and | equations |  |
/// |---|---|---|---|---|---|
/// | `pin` | revolute | `link` | `lever` | solved |  |
///
/// 1 velocity coordinates + 0 constraint equations = 1 equations.
///
/// - `coupler`, `rocker`: in closed form from `pin`, where `sin(rocker - crank - coupler) > 0.0`
/// - left out, since they follow from the other equations: `pin.z`, `pin.turn_y`, `pin.turn_x`
/// - found in closed form: `coupler`, `rocker`
/// - `rocker`: distance of two points: A cos x + B sin x = C
/// - `coupler`: a point on both sides: (r cos x, r sin x) = (u, v)
///
/// ## Functions
///
/// | function | method | operations | as derived |
/// |---|---|---|---|
/// | `new` |  | none |  |
/// | `forward_dynamics` | composite rigid body, LDL^T, parallel hinges in the axes of their base | 78 add, 132 mul, 4 div, 2 sqrt, 1 sincos | 93 add, 192 mul, 4 div, 2 sqrt, 1 sincos |
/// | `inverse_dynamics` | recursive Newton-Euler, parallel hinges in the axes of their base | 73 add, 117 mul, 3 div, 2 sqrt, 1 sincos | 82 add, 163 mul, 3 div, 2 sqrt, 1 sincos |
/// | `mass_matrix` | composite rigid body, parallel hinges in the axes of their tip | 24 add, 36 mul, 2 div, 1 sqrt, 1 sincos | 28 add, 50 mul, 2 div, 1 sqrt, 1 sincos |
/// | `bias` | recursive Newton-Euler, parallel hinges in the axes of their base | 65 add, 111 mul, 3 div, 2 sqrt, 1 sincos | 76 add, 158 mul, 3 div, 2 sqrt, 1 sincos |
/// | `outputs` | world axes | 179 add, 213 mul, 10 div, 2 sqrt, 1 sincos, 2 other | 210 add, 291 mul, 10 div, 2 sqrt, 1 sincos, 2 other |
/// | `dead_centres` | closed forms | 4 add, 4 mul, 1 sqrt, 1 sincos | 4 add, 4 mul, 1 sqrt, 1 sincos |
/// | `margins` | closed forms, determinants | 6 add, 8 mul, 1 sqrt, 1 sincos | 6 add, 12 mul, 1 sqrt, 1 sincos |
pub mod four_bar {
    use ::core::prelude::v1::*;
    use ::multibody::Real;
    /// Number of degrees of freedom: components of a velocity.
    pub const DOF: usize = 1;
    /// Parameters of `four_bar`. The default is what the model declares.
    #[repr(C)]
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Params<T = f64> {
        scalar: ::core::marker::PhantomData<T>,
    }
    /// Positions of the joints of `four_bar`. The default is zero, or the identity.
    ///
    /// Components in order of declaration: 1.
    #[repr(C)]
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Position<T = f64> {
        /// `[rad]` position of the revolute joint
        pub crank: T,
    }
    /// Velocities of `four_bar`; accelerations and efforts have the same components.
    ///
    /// Components in order of declaration: 1.
    #[repr(C)]
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Velocity<T = f64> {
        /// `[rad/s]` velocity of the revolute joint
        pub crank: T,
    }
    /// Inputs of `four_bar`, held over a step. The default is zero.
    #[repr(C)]
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Input<T = f64> {
        /// input
        pub torque: T,
    }
    /// Outputs of `four_bar`.
    #[repr(C)]
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Output<T = f64> {
        /// output
        pub angles: [T; 3],
        /// output
        pub rates: [T; 3],
        /// output
        pub accels: [T; 3],
        /// of the arm's tip against the ground, and of the pin
        pub reactions: [::multibody::nalgebra::Vector3<T>; 2],
        /// output
        pub energy: T,
    }
    impl<T: Real> Default for Params<T> {
        fn default() -> Self {
            Self {
                scalar: ::core::marker::PhantomData,
            }
        }
    }
    impl<T: Real> Default for Position<T> {
        fn default() -> Self {
            Self { crank: T::lit(0.0) }
        }
    }
    impl<T: Real> Default for Velocity<T> {
        fn default() -> Self {
            Self { crank: T::lit(0.0) }
        }
    }
    impl<T: Real> Default for Input<T> {
        fn default() -> Self {
            Self { torque: T::lit(0.0) }
        }
    }
    impl<T: Real> Default for Output<T> {
        fn default() -> Self {
            Self {
                angles: [T::lit(0.0); 3],
                rates: [T::lit(0.0); 3],
                accels: [T::lit(0.0); 3],
                reactions: [::multibody::nalgebra::Vector3::zeros(); 2],
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
                crank: ::multibody::Tangent::zero(),
            }
        }
        fn zip<F: FnMut(T, T) -> T>(&self, other: &Self, f: &mut F) -> Self {
            Self {
                crank: ::multibody::Tangent::zip(&self.crank, &other.crank, f),
            }
        }
        fn fold<A, F: FnMut(A, T) -> A>(&self, start: A, f: &mut F) -> A {
            ::multibody::Tangent::fold(&self.crank, start, f)
        }
    }
    impl<T: Real> ::multibody::Configuration<T> for Position<T> {
        type Velocity = Velocity<T>;
        fn displace(&self, d: &Velocity<T>) -> Self {
            Self {
                crank: ::multibody::Configuration::displace(&self.crank, &d.crank),
            }
        }
        fn advance(&self, d: &Velocity<T>, rest: &Velocity<T>) -> (Self, Velocity<T>) {
            let (mut end, mut left) = (*self, *rest);
            (end.crank, left.crank) = ::multibody::Configuration::advance(
                &self.crank,
                &d.crank,
                &rest.crank,
            );
            (end, left)
        }
        fn dexp_inv(_d: &Velocity<T>, v: &Velocity<T>) -> Velocity<T> {
            *v
        }
        fn magnitude(&self) -> Velocity<T> {
            Velocity {
                crank: ::multibody::Configuration::magnitude(&self.crank),
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
            _: &::multibody::Column<'_>,
            _: &mut dyn FnMut(&::multibody::Column<'_>, T),
        ) {}
    }
    impl<T: Real> ::multibody::Columns<T> for Position<T> {
        fn columns(
            &self,
            place: &::multibody::Column<'_>,
            f: &mut dyn FnMut(&::multibody::Column<'_>, T),
        ) {
            ::multibody::Columns::columns(&self.crank, &place.field("crank", "rad"), f);
        }
    }
    impl<T: Real> ::multibody::Columns<T> for Velocity<T> {
        fn columns(
            &self,
            place: &::multibody::Column<'_>,
            f: &mut dyn FnMut(&::multibody::Column<'_>, T),
        ) {
            ::multibody::Columns::columns(
                &self.crank,
                &place.field("crank", "rad/s"),
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
            ::multibody::Columns::columns(&self.torque, &place.field("torque", ""), f);
        }
    }
    impl<T: Real> ::multibody::Columns<T> for Output<T> {
        fn columns(
            &self,
            place: &::multibody::Column<'_>,
            f: &mut dyn FnMut(&::multibody::Column<'_>, T),
        ) {
            ::multibody::Columns::columns(&self.angles, &place.field("angles", ""), f);
            ::multibody::Columns::columns(&self.rates, &place.field("rates", ""), f);
            ::multibody::Columns::columns(&self.accels, &place.field("accels", ""), f);
            ::multibody::Columns::columns(
                &self.reactions,
                &place.field("reactions", ""),
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
    impl<T: Real> From<Velocity<T>> for ::multibody::nalgebra::SVector<T, 1> {
        fn from(velocity: Velocity<T>) -> Self {
            Self::from([velocity.crank])
        }
    }
    impl<T: Real> From<::multibody::nalgebra::SVector<T, 1>> for Velocity<T> {
        fn from(vector: ::multibody::nalgebra::SVector<T, 1>) -> Self {
            let [[crank]] = vector.data.0;
            Velocity { crank }
        }
    }
    impl<T: Real> From<Position<T>> for ::multibody::nalgebra::SVector<T, 1> {
        fn from(position: Position<T>) -> Self {
            Self::from([position.crank])
        }
    }
    impl<T: Real> From<::multibody::nalgebra::SVector<T, 1>> for Position<T> {
        fn from(vector: ::multibody::nalgebra::SVector<T, 1>) -> Self {
            let [[crank]] = vector.data.0;
            Position { crank }
        }
    }
    impl<T: Real> From<Input<T>> for ::multibody::nalgebra::SVector<T, 1> {
        fn from(input: Input<T>) -> Self {
            Self::from([input.torque])
        }
    }
    impl<T: Real> From<::multibody::nalgebra::SVector<T, 1>> for Input<T> {
        fn from(vector: ::multibody::nalgebra::SVector<T, 1>) -> Self {
            let [[torque]] = vector.data.0;
            Input { torque }
        }
    }
    impl<T: Real> From<State<T>> for ::multibody::nalgebra::SVector<T, 2> {
        fn from(state: State<T>) -> Self {
            Self::from([state.q.crank, state.v.crank])
        }
    }
    impl<T: Real> From<::multibody::nalgebra::SVector<T, 2>> for State<T> {
        fn from(vector: ::multibody::nalgebra::SVector<T, 2>) -> Self {
            let [[q_crank, v_crank]] = vector.data.0;
            State {
                q: Position { crank: q_crank },
                v: Velocity { crank: v_crank },
            }
        }
    }
    /// The equations of motion of `four_bar`. It takes no space: nothing depends on parameters.
    #[repr(C)]
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Model<T = f64> {
        scalar: ::core::marker::PhantomData<T>,
    }
    impl<T: Real> Model<T> {
        /// Does the work that depends on parameters alone.
        ///
        /// Operations: none.
        #[must_use]
        pub fn new(_params: &Params<T>) -> Self {
            Self {
                scalar: ::core::marker::PhantomData,
            }
        }
        /// Accelerations.
        ///
        /// Method: composite rigid body, LDL^T, parallel hinges in the axes of their base.
        ///
        /// Operations: 78 add, 132 mul, 4 div, 2 sqrt, 1 sincos; as derived, before optimisation: 93 add, 192 mul, 4 div, 2 sqrt, 1 sincos.
        #[must_use]
        pub fn forward_dynamics(
            &self,
            _t: T,
            state: &State<T>,
            input: &Input<T>,
        ) -> Velocity<T> {
            let q = &state.q;
            let v = &state.v;
            // Closed form of rocker.
            let (sin_crank, cos_crank) = Real::sin_cos(q.crank);
            let minus_rocker_a = cos_crank - T::lit(4.0);
            let rocker_d = minus_rocker_a * minus_rocker_a + sin_crank * sin_crank;
            let rocker_d_inv = T::lit(1.0) / rocker_d;
            let minus_rocker_c = T::lit(0.16666666666666666) * rocker_d
                - T::lit(0.5416666666666666);
            let root_rocker = Real::sqrt(rocker_d - minus_rocker_c * minus_rocker_c);
            let cos_rocker = rocker_d_inv
                * (minus_rocker_a * minus_rocker_c + sin_crank * root_rocker);
            let cos_rocker_times_3 = T::lit(3.0) * cos_rocker;
            let cos_rocker_times_3_plus_4 = T::lit(4.0) + cos_rocker_times_3;
            let sin_rocker = rocker_d_inv
                * (sin_crank * minus_rocker_c - minus_rocker_a * root_rocker);
            // Closed form of coupler.
            let sin_crank_times_3 = T::lit(3.0) * sin_crank;
            let pivot_1_with_cos_crank = cos_crank * cos_rocker_times_3_plus_4
                + sin_rocker * sin_crank_times_3;
            let coupler_u = pivot_1_with_cos_crank - T::lit(1.0);
            let cos_crank_times_sin_rocker = cos_crank * sin_rocker;
            let minus_coupler_v = sin_crank * cos_rocker_times_3_plus_4
                - T::lit(3.0) * cos_crank_times_sin_rocker;
            // Force and moment through coupler.
            let f_coupler_passed_with_cos_crank = cos_crank * coupler_u
                + sin_crank * minus_coupler_v;
            let f_coupler_passed_with_sin_crank = sin_crank * coupler_u
                - cos_crank * minus_coupler_v;
            let side_1_with_cos_crank = cos_crank
                - T::lit(0.5714285714285714) * f_coupler_passed_with_sin_crank;
            let side_1_with_sin_crank = sin_crank
                + T::lit(0.5714285714285714) * f_coupler_passed_with_cos_crank;
            let side_1_with_coupler_u = Real::sqrt(
                side_1_with_cos_crank * side_1_with_cos_crank
                    + side_1_with_sin_crank * side_1_with_sin_crank,
            );
            let side_1_with_coupler_v = (side_1_with_coupler_u - T::lit(0.5))
                / side_1_with_coupler_u;
            let side_1_with_cos_crank_and_sin_crank = side_1_with_cos_crank
                * side_1_with_coupler_v;
            let side_1_with_sin_crank_and_cos_crank = side_1_with_sin_crank
                * side_1_with_coupler_v;
            // Velocities of what follows.
            let minus_slope_rocker_inv = T::lit(1.0) / root_rocker;
            let crank_rate_times_cos_crank = v.crank * cos_crank;
            let sin_crank_times_0_333_minus_sin_rocker = T::lit(0.3333333333333333)
                * sin_crank - sin_rocker;
            let crank_rate_times_sin_crank = v.crank * sin_crank;
            let pivot_1_with_cos_rocker = cos_rocker
                - T::lit(0.3333333333333333) * minus_rocker_a;
            let rocker_rate = minus_slope_rocker_inv
                * (crank_rate_times_cos_crank * sin_crank_times_0_333_minus_sin_rocker
                    + crank_rate_times_sin_crank * pivot_1_with_cos_rocker);
            // Accelerations of what follows.
            let cos_rocker_times_rocker_rate = cos_rocker * rocker_rate;
            let gap_accel_with_rocker_rate = rocker_rate * cos_rocker_times_rocker_rate;
            let sin_rocker_times_rocker_rate = sin_rocker * rocker_rate;
            let gap_accel_with_sin_rocker = rocker_rate * sin_rocker_times_rocker_rate;
            let minus_a_coupler_x = v.crank * crank_rate_times_cos_crank;
            let a_coupler_y_with_crank_rate = v.crank * crank_rate_times_sin_crank;
            let rocker_gap_accel = sin_crank * gap_accel_with_sin_rocker
                - T::lit(2.0) * crank_rate_times_sin_crank * sin_rocker_times_rocker_rate
                + cos_rocker * minus_a_coupler_x
                + sin_rocker * a_coupler_y_with_crank_rate
                + minus_rocker_a
                    * (gap_accel_with_rocker_rate
                        - T::lit(0.3333333333333333) * minus_a_coupler_x)
                + crank_rate_times_cos_crank
                    * (T::lit(0.3333333333333333) * crank_rate_times_cos_crank
                        - T::lit(2.0) * cos_rocker_times_rocker_rate);
            let rocker_accel = minus_slope_rocker_inv * rocker_gap_accel;
            // Force and moment through coupler.
            let coupler_gap_accel_with_sin_rocker = T::lit(3.0)
                * gap_accel_with_rocker_rate + T::lit(3.0) * sin_rocker * rocker_accel;
            let coupler_gap_accel_with_rocker_accel = T::lit(3.0)
                * gap_accel_with_sin_rocker - rocker_accel * cos_rocker_times_3;
            let cos_crank_times_3 = T::lit(3.0) * cos_crank;
            let coupler_gap_accel_with_rocker_rate = sin_rocker_times_rocker_rate
                * sin_crank_times_3 + cos_rocker_times_rocker_rate * cos_crank_times_3;
            let w2_coupler_z_with_crank_rate = v.crank * pivot_1_with_cos_crank
                - coupler_gap_accel_with_rocker_rate;
            let coupler_gap_accel_with_cos_crank = sin_rocker_times_rocker_rate
                * cos_crank_times_3 - cos_rocker_times_rocker_rate * sin_crank_times_3;
            let w2_coupler_z_with_coupler_v = v.crank * minus_coupler_v
                + coupler_gap_accel_with_cos_crank;
            let coupler_gap_accel_with_coupler_v = minus_coupler_v
                * (cos_crank * coupler_gap_accel_with_sin_rocker
                    + sin_crank * coupler_gap_accel_with_rocker_accel
                    + v.crank
                        * (w2_coupler_z_with_crank_rate
                            - coupler_gap_accel_with_rocker_rate))
                - coupler_u
                    * (sin_crank * coupler_gap_accel_with_sin_rocker
                        - cos_crank * coupler_gap_accel_with_rocker_accel
                        + v.crank
                            * (coupler_gap_accel_with_cos_crank
                                + w2_coupler_z_with_coupler_v));
            let f_coupler_passed_y = T::lit(1.7) * f_coupler_passed_with_cos_crank
                - T::lit(0.2) * f_coupler_passed_with_sin_crank;
            let minus_a_coupler_y = a_coupler_y_with_crank_rate - T::lit(9.81);
            let minus_f_coupler_passed_x = T::lit(0.2) * f_coupler_passed_with_cos_crank
                + T::lit(1.7) * f_coupler_passed_with_sin_crank;
            let minus_n_coupler_z = T::lit(4.571428571428571)
                * (f_coupler_passed_with_cos_crank * side_1_with_cos_crank_and_sin_crank
                    + f_coupler_passed_with_sin_crank
                        * side_1_with_sin_crank_and_cos_crank)
                + T::lit(1.090204081632653) * coupler_gap_accel_with_coupler_v
                + f_coupler_passed_y * minus_a_coupler_y
                - minus_a_coupler_x * minus_f_coupler_passed_x;
            // Results.
            let w2_coupler_z_with_coupler_u = v.crank
                - T::lit(0.08163265306122448)
                    * (coupler_u * w2_coupler_z_with_crank_rate
                        + minus_coupler_v * w2_coupler_z_with_coupler_v);
            let w2_coupler_z = w2_coupler_z_with_coupler_u * w2_coupler_z_with_coupler_u;
            let minus_coupler_v_times_minus_n_coupler_z = minus_coupler_v
                * minus_n_coupler_z;
            let coupler_u_times_minus_n_coupler_z = coupler_u * minus_n_coupler_z;
            let side_1_with_rocker_accel = T::lit(9.0) * rocker_accel
                + T::lit(0.24489795918367346) * sin_rocker
                    * (cos_crank * minus_coupler_v_times_minus_n_coupler_z
                        - sin_crank * coupler_u_times_minus_n_coupler_z)
                + cos_rocker
                    * (T::lit(44.145)
                        - T::lit(0.24489795918367346)
                            * (sin_crank * minus_coupler_v_times_minus_n_coupler_z
                                + cos_crank * coupler_u_times_minus_n_coupler_z));
            let side_1_with_root_rocker = minus_slope_rocker_inv
                * side_1_with_rocker_accel;
            let side_1_with_crank_rate = T::lit(0.08163265306122448)
                * coupler_gap_accel_with_coupler_v;
            let side_1 = input.torque + minus_n_coupler_z
                + cos_crank
                    * (minus_f_coupler_passed_x * w2_coupler_z - T::lit(39.24)
                        - T::lit(8.0) * side_1_with_sin_crank_and_cos_crank
                        - side_1_with_root_rocker
                            * sin_crank_times_0_333_minus_sin_rocker
                        + f_coupler_passed_y * side_1_with_crank_rate)
                + sin_crank
                    * (T::lit(8.0) * side_1_with_cos_crank_and_sin_crank
                        - f_coupler_passed_y * w2_coupler_z
                        - side_1_with_root_rocker * pivot_1_with_cos_rocker
                        + minus_f_coupler_passed_x * side_1_with_crank_rate)
                - T::lit(0.08163265306122448)
                    * (pivot_1_with_cos_crank * coupler_u_times_minus_n_coupler_z
                        + minus_coupler_v * minus_coupler_v_times_minus_n_coupler_z);
            // Factorisation L^T D L.
            let pivot_1_with_f_coupler_passed_y = cos_crank * f_coupler_passed_y
                + sin_crank * minus_f_coupler_passed_x;
            let pivot_1_with_root_rocker = minus_slope_rocker_inv
                * (cos_crank_times_sin_rocker
                    - sin_crank
                        * (T::lit(0.3333333333333333) * cos_crank
                            + pivot_1_with_cos_rocker));
            let sin_rocker_times_pivot_1_with_root_rocker = sin_rocker
                * pivot_1_with_root_rocker;
            let cos_rocker_times_pivot_1_with_root_rocker = cos_rocker
                * pivot_1_with_root_rocker;
            let pivot_1_with_coupler_v = minus_coupler_v
                * (minus_coupler_v
                    - T::lit(3.0)
                        * (cos_crank * sin_rocker_times_pivot_1_with_root_rocker
                            - sin_crank * cos_rocker_times_pivot_1_with_root_rocker))
                + coupler_u
                    * (pivot_1_with_cos_crank
                        + T::lit(3.0)
                            * (sin_crank * sin_rocker_times_pivot_1_with_root_rocker
                                + cos_crank * cos_rocker_times_pivot_1_with_root_rocker));
            let pivot_1 = T::lit(17.188333333333333)
                + T::lit(2.0) * pivot_1_with_f_coupler_passed_y
                + T::lit(9.0) * pivot_1_with_root_rocker * pivot_1_with_root_rocker
                + T::lit(0.16326530612244897) * pivot_1_with_coupler_v
                    * (T::lit(0.5451020408163265) * pivot_1_with_coupler_v
                        - T::lit(13.355) - pivot_1_with_f_coupler_passed_y);
            Velocity {
                crank: side_1 / pivot_1,
            }
        }
        /// Efforts that the accelerations `accel` need beside all declared forces.
        ///
        /// Method: recursive Newton-Euler, parallel hinges in the axes of their base.
        ///
        /// Operations: 73 add, 117 mul, 3 div, 2 sqrt, 1 sincos; as derived, before optimisation: 82 add, 163 mul, 3 div, 2 sqrt, 1 sincos.
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
            // Closed form of rocker.
            let (sin_crank, cos_crank) = Real::sin_cos(q.crank);
            let minus_rocker_a = cos_crank - T::lit(4.0);
            let rocker_d = minus_rocker_a * minus_rocker_a + sin_crank * sin_crank;
            let rocker_d_inv = T::lit(1.0) / rocker_d;
            let minus_rocker_c = T::lit(0.16666666666666666) * rocker_d
                - T::lit(0.5416666666666666);
            let root_rocker = Real::sqrt(rocker_d - minus_rocker_c * minus_rocker_c);
            let cos_rocker = rocker_d_inv
                * (minus_rocker_a * minus_rocker_c + sin_crank * root_rocker);
            let cos_rocker_times_3 = T::lit(3.0) * cos_rocker;
            let cos_rocker_times_3_plus_4 = T::lit(4.0) + cos_rocker_times_3;
            let sin_rocker = rocker_d_inv
                * (sin_crank * minus_rocker_c - minus_rocker_a * root_rocker);
            // Closed form of coupler.
            let sin_crank_times_3 = T::lit(3.0) * sin_crank;
            let crank_effort_with_cos_crank = cos_crank * cos_rocker_times_3_plus_4
                + sin_rocker * sin_crank_times_3;
            let coupler_u = crank_effort_with_cos_crank - T::lit(1.0);
            let cos_crank_times_3 = T::lit(3.0) * cos_crank;
            let minus_coupler_v = sin_crank * cos_rocker_times_3_plus_4
                - sin_rocker * cos_crank_times_3;
            // Force and moment through coupler.
            let crank_effort_with_coupler_u = cos_crank * coupler_u
                + sin_crank * minus_coupler_v;
            let crank_effort_with_sin_crank = sin_crank * coupler_u
                - cos_crank * minus_coupler_v;
            let crank_effort_with_coupler_v = cos_crank
                - T::lit(0.5714285714285714) * crank_effort_with_sin_crank;
            let crank_effort_with_sin_crank_and_cos_crank = sin_crank
                + T::lit(0.5714285714285714) * crank_effort_with_coupler_u;
            let crank_effort_with_cos_crank_and_sin_crank = Real::sqrt(
                crank_effort_with_coupler_v * crank_effort_with_coupler_v
                    + crank_effort_with_sin_crank_and_cos_crank
                        * crank_effort_with_sin_crank_and_cos_crank,
            );
            let crank_effort_with_cos_crank_and_coupler_u = (crank_effort_with_cos_crank_and_sin_crank
                - T::lit(0.5)) / crank_effort_with_cos_crank_and_sin_crank;
            let crank_effort_with_cos_crank_and_coupler_v = crank_effort_with_coupler_v
                * crank_effort_with_cos_crank_and_coupler_u;
            let crank_effort_with_sin_crank_and_coupler_u = crank_effort_with_sin_crank_and_cos_crank
                * crank_effort_with_cos_crank_and_coupler_u;
            // Velocities of what follows.
            let minus_slope_rocker_inv = T::lit(1.0) / root_rocker;
            let crank_rate_times_cos_crank = v.crank * cos_crank;
            let sin_crank_times_0_333_minus_sin_rocker = T::lit(0.3333333333333333)
                * sin_crank - sin_rocker;
            let crank_rate_times_sin_crank = v.crank * sin_crank;
            let crank_effort_with_cos_rocker = cos_rocker
                - T::lit(0.3333333333333333) * minus_rocker_a;
            let rocker_rate = minus_slope_rocker_inv
                * (crank_rate_times_cos_crank * sin_crank_times_0_333_minus_sin_rocker
                    + crank_rate_times_sin_crank * crank_effort_with_cos_rocker);
            let cos_rocker_times_rocker_rate = cos_rocker * rocker_rate;
            let u_coupler_xy_with_rocker_rate = rocker_rate
                * cos_rocker_times_rocker_rate;
            let minus_a_coupler_x = accel.crank * sin_crank
                + v.crank * crank_rate_times_cos_crank;
            // Accelerations of what follows.
            let a_coupler_y_with_crank_accel = accel.crank * cos_crank
                - v.crank * crank_rate_times_sin_crank;
            let sin_rocker_times_rocker_rate = sin_rocker * rocker_rate;
            let u_coupler_xy_with_sin_rocker = rocker_rate
                * sin_rocker_times_rocker_rate;
            let rocker_gap_accel = T::lit(0.3333333333333333)
                * (crank_rate_times_sin_crank * crank_rate_times_sin_crank
                    - minus_rocker_a * minus_a_coupler_x
                    + crank_rate_times_cos_crank * crank_rate_times_cos_crank
                    + sin_crank * a_coupler_y_with_crank_accel)
                + cos_rocker * minus_a_coupler_x
                - sin_rocker * a_coupler_y_with_crank_accel
                + minus_rocker_a * u_coupler_xy_with_rocker_rate
                + sin_crank * u_coupler_xy_with_sin_rocker
                - T::lit(2.0)
                    * (crank_rate_times_sin_crank * sin_rocker_times_rocker_rate
                        + crank_rate_times_cos_crank * cos_rocker_times_rocker_rate);
            let rocker_accel = minus_slope_rocker_inv * rocker_gap_accel;
            // Force and moment through coupler.
            let u_coupler_xy_with_rocker_accel = T::lit(3.0)
                * u_coupler_xy_with_rocker_rate
                + T::lit(3.0) * sin_rocker * rocker_accel;
            let u_coupler_xy_with_cos_rocker = rocker_accel * cos_rocker_times_3
                - T::lit(3.0) * u_coupler_xy_with_sin_rocker;
            let u_coupler_xy_with_sin_crank = sin_rocker_times_rocker_rate
                * sin_crank_times_3 + cos_rocker_times_rocker_rate * cos_crank_times_3;
            let w2_coupler_z_with_crank_rate = v.crank * crank_effort_with_cos_crank
                - u_coupler_xy_with_sin_crank;
            let u_coupler_xy_with_cos_crank = sin_rocker_times_rocker_rate
                * cos_crank_times_3 - cos_rocker_times_rocker_rate * sin_crank_times_3;
            let w2_coupler_z_with_coupler_v = v.crank * minus_coupler_v
                + u_coupler_xy_with_cos_crank;
            let u_coupler_xy_with_coupler_v = minus_coupler_v
                * (sin_crank * u_coupler_xy_with_cos_rocker
                    - cos_crank * u_coupler_xy_with_rocker_accel
                    - accel.crank * minus_coupler_v
                    + v.crank
                        * (u_coupler_xy_with_sin_crank - w2_coupler_z_with_crank_rate))
                + coupler_u
                    * (sin_crank * u_coupler_xy_with_rocker_accel
                        + cos_crank * u_coupler_xy_with_cos_rocker
                        - accel.crank * crank_effort_with_cos_crank
                        + v.crank
                            * (u_coupler_xy_with_cos_crank
                                + w2_coupler_z_with_coupler_v));
            let minus_u_coupler_xy = accel.crank
                + T::lit(0.08163265306122448) * u_coupler_xy_with_coupler_v;
            let a_coupler_y = T::lit(9.81) + a_coupler_y_with_crank_accel;
            let crank_effort_with_coupler_u_and_sin_crank = T::lit(1.7)
                * crank_effort_with_coupler_u
                - T::lit(0.2) * crank_effort_with_sin_crank;
            let crank_effort_with_coupler_u_and_coupler_v = T::lit(0.2)
                * crank_effort_with_coupler_u
                + T::lit(1.7) * crank_effort_with_sin_crank;
            let minus_n_coupler_z = T::lit(4.571428571428571)
                * (crank_effort_with_coupler_u
                    * crank_effort_with_cos_crank_and_coupler_v
                    + crank_effort_with_sin_crank
                        * crank_effort_with_sin_crank_and_coupler_u)
                - T::lit(13.355) * minus_u_coupler_xy
                - a_coupler_y * crank_effort_with_coupler_u_and_sin_crank
                - minus_a_coupler_x * crank_effort_with_coupler_u_and_coupler_v;
            // Results.
            let w2_coupler_z_with_coupler_u = v.crank
                - T::lit(0.08163265306122448)
                    * (coupler_u * w2_coupler_z_with_crank_rate
                        + minus_coupler_v * w2_coupler_z_with_coupler_v);
            let w2_coupler_z = w2_coupler_z_with_coupler_u * w2_coupler_z_with_coupler_u;
            let minus_coupler_v_times_minus_n_coupler_z = minus_coupler_v
                * minus_n_coupler_z;
            let coupler_u_times_minus_n_coupler_z = coupler_u * minus_n_coupler_z;
            let crank_effort_with_rocker_accel = T::lit(9.0) * rocker_accel
                + T::lit(0.24489795918367346) * sin_rocker
                    * (cos_crank * minus_coupler_v_times_minus_n_coupler_z
                        - sin_crank * coupler_u_times_minus_n_coupler_z)
                + cos_rocker
                    * (T::lit(44.145)
                        - T::lit(0.24489795918367346)
                            * (sin_crank * minus_coupler_v_times_minus_n_coupler_z
                                + cos_crank * coupler_u_times_minus_n_coupler_z));
            let crank_effort_with_root_rocker = minus_slope_rocker_inv
                * crank_effort_with_rocker_accel;
            let minus_crank_effort = input.torque
                - T::lit(3.8333333333333335) * accel.crank + minus_n_coupler_z
                + cos_crank
                    * (crank_effort_with_coupler_u_and_coupler_v * w2_coupler_z
                        - T::lit(39.24)
                        - T::lit(8.0) * crank_effort_with_sin_crank_and_coupler_u
                        - crank_effort_with_coupler_u_and_sin_crank * minus_u_coupler_xy
                        - crank_effort_with_root_rocker
                            * sin_crank_times_0_333_minus_sin_rocker)
                + sin_crank
                    * (T::lit(8.0) * crank_effort_with_cos_crank_and_coupler_v
                        - crank_effort_with_coupler_u_and_sin_crank * w2_coupler_z
                        - crank_effort_with_coupler_u_and_coupler_v * minus_u_coupler_xy
                        - crank_effort_with_root_rocker * crank_effort_with_cos_rocker)
                - T::lit(0.08163265306122448)
                    * (crank_effort_with_cos_crank * coupler_u_times_minus_n_coupler_z
                        + minus_coupler_v * minus_coupler_v_times_minus_n_coupler_z);
            Velocity {
                crank: -minus_crank_effort,
            }
        }
        /// Mass matrix `M` of `M * accel + bias = effort`.
        ///
        /// Method: composite rigid body, parallel hinges in the axes of their tip.
        ///
        /// Operations: 24 add, 36 mul, 2 div, 1 sqrt, 1 sincos; as derived, before optimisation: 28 add, 50 mul, 2 div, 1 sqrt, 1 sincos.
        #[must_use]
        pub fn mass_matrix(
            &self,
            q: &Position<T>,
        ) -> ::multibody::nalgebra::SMatrix<T, 1, 1> {
            // Closed form of rocker.
            let (sin_crank, cos_crank) = Real::sin_cos(q.crank);
            let minus_rocker_a = cos_crank - T::lit(4.0);
            let rocker_d = minus_rocker_a * minus_rocker_a + sin_crank * sin_crank;
            let minus_rocker_c = T::lit(0.16666666666666666) * rocker_d
                - T::lit(0.5416666666666666);
            let root_rocker = Real::sqrt(rocker_d - minus_rocker_c * minus_rocker_c);
            let rocker_d_inv = T::lit(1.0) / rocker_d;
            let sin_rocker = rocker_d_inv
                * (sin_crank * minus_rocker_c - minus_rocker_a * root_rocker);
            let cos_crank_times_sin_rocker = cos_crank * sin_rocker;
            let cos_rocker = rocker_d_inv
                * (minus_rocker_a * minus_rocker_c + sin_crank * root_rocker);
            let mass_matrix_0_with_sin_crank = (cos_crank_times_sin_rocker
                - sin_crank
                    * (cos_rocker
                        + T::lit(0.3333333333333333) * (cos_crank - minus_rocker_a)))
                / root_rocker;
            let cos_rocker_times_3_plus_4 = T::lit(4.0) + T::lit(3.0) * cos_rocker;
            let minus_coupler_v = sin_crank * cos_rocker_times_3_plus_4
                - T::lit(3.0) * cos_crank_times_sin_rocker;
            let mass_matrix_0_with_sin_rocker = sin_rocker
                * mass_matrix_0_with_sin_crank;
            let mass_matrix_0_with_cos_rocker = cos_rocker
                * mass_matrix_0_with_sin_crank;
            let mass_matrix_0_with_cos_crank = cos_crank * cos_rocker_times_3_plus_4
                + T::lit(3.0) * sin_crank * sin_rocker;
            let coupler_u = mass_matrix_0_with_cos_crank - T::lit(1.0);
            // Results.
            let mass_matrix_0_with_coupler_v = minus_coupler_v
                * (minus_coupler_v
                    - T::lit(3.0)
                        * (cos_crank * mass_matrix_0_with_sin_rocker
                            - sin_crank * mass_matrix_0_with_cos_rocker))
                + coupler_u
                    * (mass_matrix_0_with_cos_crank
                        + T::lit(3.0)
                            * (sin_crank * mass_matrix_0_with_sin_rocker
                                + cos_crank * mass_matrix_0_with_cos_rocker));
            let minus_coupler_v_plus_coupler_u_times_8_5 = minus_coupler_v
                + T::lit(8.5) * coupler_u;
            ::multibody::nalgebra::SMatrix::from([
                [
                    (T::lit(17.188333333333333)
                        + T::lit(9.0) * mass_matrix_0_with_sin_crank
                            * mass_matrix_0_with_sin_crank
                        + T::lit(0.08899625156184923) * mass_matrix_0_with_coupler_v
                            * (mass_matrix_0_with_coupler_v - T::lit(24.5)
                                - T::lit(0.36690378135529766)
                                    * minus_coupler_v_plus_coupler_u_times_8_5)
                        + T::lit(0.4) * minus_coupler_v_plus_coupler_u_times_8_5),
                ],
            ])
        }
        /// The efforts at zero acceleration, `bias` of `M * accel + bias = effort`; declared forces and gravity are in it.
        ///
        /// Method: recursive Newton-Euler, parallel hinges in the axes of their base.
        ///
        /// Operations: 65 add, 111 mul, 3 div, 2 sqrt, 1 sincos; as derived, before optimisation: 76 add, 158 mul, 3 div, 2 sqrt, 1 sincos.
        #[must_use]
        pub fn bias(
            &self,
            _t: T,
            state: &State<T>,
            input: &Input<T>,
        ) -> ::multibody::nalgebra::SVector<T, 1> {
            let q = &state.q;
            let v = &state.v;
            // Closed form of rocker.
            let (sin_crank, cos_crank) = Real::sin_cos(q.crank);
            let minus_rocker_a = cos_crank - T::lit(4.0);
            let rocker_d = minus_rocker_a * minus_rocker_a + sin_crank * sin_crank;
            let rocker_d_inv = T::lit(1.0) / rocker_d;
            let minus_rocker_c = T::lit(0.16666666666666666) * rocker_d
                - T::lit(0.5416666666666666);
            let root_rocker = Real::sqrt(rocker_d - minus_rocker_c * minus_rocker_c);
            let cos_rocker = rocker_d_inv
                * (minus_rocker_a * minus_rocker_c + sin_crank * root_rocker);
            // Closed form of coupler.
            let cos_rocker_times_3 = T::lit(3.0) * cos_rocker;
            let cos_rocker_times_3_plus_4 = T::lit(4.0) + cos_rocker_times_3;
            let sin_crank_times_3 = T::lit(3.0) * sin_crank;
            let sin_rocker_with_rocker_d = rocker_d_inv
                * (minus_rocker_c * sin_crank_times_3
                    - T::lit(3.0) * minus_rocker_a * root_rocker);
            let crank_effort_with_cos_crank = cos_crank * cos_rocker_times_3_plus_4
                + sin_crank * sin_rocker_with_rocker_d;
            let coupler_u = crank_effort_with_cos_crank - T::lit(1.0);
            let minus_coupler_v = sin_crank * cos_rocker_times_3_plus_4
                - cos_crank * sin_rocker_with_rocker_d;
            // Force and moment through coupler.
            let crank_effort_with_coupler_u = cos_crank * coupler_u
                + sin_crank * minus_coupler_v;
            let crank_effort_with_sin_crank = sin_crank * coupler_u
                - cos_crank * minus_coupler_v;
            let crank_effort_with_coupler_v = cos_crank
                - T::lit(0.5714285714285714) * crank_effort_with_sin_crank;
            let crank_effort_with_sin_crank_and_cos_crank = sin_crank
                + T::lit(0.5714285714285714) * crank_effort_with_coupler_u;
            let crank_effort_with_cos_crank_and_sin_crank = Real::sqrt(
                crank_effort_with_coupler_v * crank_effort_with_coupler_v
                    + crank_effort_with_sin_crank_and_cos_crank
                        * crank_effort_with_sin_crank_and_cos_crank,
            );
            let crank_effort_with_cos_crank_and_coupler_u = (crank_effort_with_cos_crank_and_sin_crank
                - T::lit(0.5)) / crank_effort_with_cos_crank_and_sin_crank;
            let crank_effort_with_cos_crank_and_coupler_v = crank_effort_with_coupler_v
                * crank_effort_with_cos_crank_and_coupler_u;
            let crank_effort_with_sin_crank_and_coupler_u = crank_effort_with_sin_crank_and_cos_crank
                * crank_effort_with_cos_crank_and_coupler_u;
            // Velocities of what follows.
            let minus_slope_rocker_inv = T::lit(1.0) / root_rocker;
            let crank_rate_times_cos_crank = v.crank * cos_crank;
            let crank_effort_with_rocker_d = T::lit(0.3333333333333333) * sin_crank
                - T::lit(0.3333333333333333) * sin_rocker_with_rocker_d;
            let crank_rate_times_sin_crank = v.crank * sin_crank;
            let crank_effort_with_cos_rocker = cos_rocker
                - T::lit(0.3333333333333333) * minus_rocker_a;
            let rocker_rate = minus_slope_rocker_inv
                * (crank_rate_times_cos_crank * crank_effort_with_rocker_d
                    + crank_rate_times_sin_crank * crank_effort_with_cos_rocker);
            // Accelerations of what follows.
            let cos_rocker_times_rocker_rate = cos_rocker * rocker_rate;
            let gap_accel_with_rocker_rate = rocker_rate * cos_rocker_times_rocker_rate;
            let sin_rocker_with_rocker_d_times_rocker_rate = sin_rocker_with_rocker_d
                * rocker_rate;
            let minus_a_coupler_x = v.crank * crank_rate_times_cos_crank;
            let gap_accel_with_rocker_d = rocker_rate
                * sin_rocker_with_rocker_d_times_rocker_rate;
            let a_coupler_y_with_crank_rate = v.crank * crank_rate_times_sin_crank;
            let rocker_gap_accel = cos_rocker * minus_a_coupler_x
                - T::lit(0.6666666666666666) * crank_rate_times_sin_crank
                    * sin_rocker_with_rocker_d_times_rocker_rate
                + minus_rocker_a
                    * (gap_accel_with_rocker_rate
                        - T::lit(0.3333333333333333) * minus_a_coupler_x)
                + crank_rate_times_cos_crank
                    * (T::lit(0.3333333333333333) * crank_rate_times_cos_crank
                        - T::lit(2.0) * cos_rocker_times_rocker_rate)
                + T::lit(0.3333333333333333)
                    * (sin_crank * gap_accel_with_rocker_d
                        + sin_rocker_with_rocker_d * a_coupler_y_with_crank_rate);
            let rocker_accel = minus_slope_rocker_inv * rocker_gap_accel;
            // Force and moment through coupler.
            let coupler_gap_accel_with_rocker_accel = T::lit(3.0)
                * gap_accel_with_rocker_rate + sin_rocker_with_rocker_d * rocker_accel;
            let coupler_gap_accel_with_rocker_rate = gap_accel_with_rocker_d
                - rocker_accel * cos_rocker_times_3;
            let coupler_gap_accel_with_sin_crank = sin_crank
                * sin_rocker_with_rocker_d_times_rocker_rate
                + T::lit(3.0) * cos_crank * cos_rocker_times_rocker_rate;
            let w2_coupler_z_with_crank_rate = v.crank * crank_effort_with_cos_crank
                - coupler_gap_accel_with_sin_crank;
            let coupler_gap_accel_with_cos_crank = cos_crank
                * sin_rocker_with_rocker_d_times_rocker_rate
                - cos_rocker_times_rocker_rate * sin_crank_times_3;
            let w2_coupler_z_with_coupler_v = v.crank * minus_coupler_v
                + coupler_gap_accel_with_cos_crank;
            let coupler_gap_accel_with_coupler_v = minus_coupler_v
                * (cos_crank * coupler_gap_accel_with_rocker_accel
                    + sin_crank * coupler_gap_accel_with_rocker_rate
                    + v.crank
                        * (w2_coupler_z_with_crank_rate
                            - coupler_gap_accel_with_sin_crank))
                - coupler_u
                    * (sin_crank * coupler_gap_accel_with_rocker_accel
                        - cos_crank * coupler_gap_accel_with_rocker_rate
                        + v.crank
                            * (coupler_gap_accel_with_cos_crank
                                + w2_coupler_z_with_coupler_v));
            let crank_effort_with_coupler_u_and_sin_crank = T::lit(1.7)
                * crank_effort_with_coupler_u
                - T::lit(0.2) * crank_effort_with_sin_crank;
            let minus_a_coupler_y = a_coupler_y_with_crank_rate - T::lit(9.81);
            let crank_effort_with_coupler_u_and_coupler_v = T::lit(0.2)
                * crank_effort_with_coupler_u
                + T::lit(1.7) * crank_effort_with_sin_crank;
            let minus_n_coupler_z = T::lit(4.571428571428571)
                * (crank_effort_with_coupler_u
                    * crank_effort_with_cos_crank_and_coupler_v
                    + crank_effort_with_sin_crank
                        * crank_effort_with_sin_crank_and_coupler_u)
                + T::lit(1.090204081632653) * coupler_gap_accel_with_coupler_v
                + crank_effort_with_coupler_u_and_sin_crank * minus_a_coupler_y
                - minus_a_coupler_x * crank_effort_with_coupler_u_and_coupler_v;
            // Results.
            let w2_coupler_z_with_coupler_u = v.crank
                - T::lit(0.08163265306122448)
                    * (coupler_u * w2_coupler_z_with_crank_rate
                        + minus_coupler_v * w2_coupler_z_with_coupler_v);
            let w2_coupler_z = w2_coupler_z_with_coupler_u * w2_coupler_z_with_coupler_u;
            let minus_coupler_v_times_minus_n_coupler_z = minus_coupler_v
                * minus_n_coupler_z;
            let coupler_u_times_minus_n_coupler_z = coupler_u * minus_n_coupler_z;
            let crank_effort_with_rocker_accel = T::lit(9.0) * rocker_accel
                + T::lit(0.08163265306122448) * sin_rocker_with_rocker_d
                    * (cos_crank * minus_coupler_v_times_minus_n_coupler_z
                        - sin_crank * coupler_u_times_minus_n_coupler_z)
                + cos_rocker
                    * (T::lit(44.145)
                        - T::lit(0.24489795918367346)
                            * (sin_crank * minus_coupler_v_times_minus_n_coupler_z
                                + cos_crank * coupler_u_times_minus_n_coupler_z));
            let crank_effort_with_root_rocker = minus_slope_rocker_inv
                * crank_effort_with_rocker_accel;
            let crank_effort_with_rate = T::lit(0.08163265306122448)
                * coupler_gap_accel_with_coupler_v;
            let minus_crank_effort = input.torque + minus_n_coupler_z
                + cos_crank
                    * (crank_effort_with_coupler_u_and_coupler_v * w2_coupler_z
                        - T::lit(39.24)
                        - T::lit(8.0) * crank_effort_with_sin_crank_and_coupler_u
                        - crank_effort_with_root_rocker * crank_effort_with_rocker_d
                        + crank_effort_with_coupler_u_and_sin_crank
                            * crank_effort_with_rate)
                + sin_crank
                    * (T::lit(8.0) * crank_effort_with_cos_crank_and_coupler_v
                        - crank_effort_with_coupler_u_and_sin_crank * w2_coupler_z
                        - crank_effort_with_root_rocker * crank_effort_with_cos_rocker
                        + crank_effort_with_coupler_u_and_coupler_v
                            * crank_effort_with_rate)
                - T::lit(0.08163265306122448)
                    * (crank_effort_with_cos_crank * coupler_u_times_minus_n_coupler_z
                        + minus_coupler_v * minus_coupler_v_times_minus_n_coupler_z);
            ::multibody::nalgebra::SVector::from([-minus_crank_effort])
        }
        /// Outputs.
        ///
        /// Method: world axes.
        ///
        /// Operations: 179 add, 213 mul, 10 div, 2 sqrt, 1 sincos, 2 other; as derived, before optimisation: 210 add, 291 mul, 10 div, 2 sqrt, 1 sincos, 2 other.
        #[must_use]
        pub fn outputs(&self, _t: T, state: &State<T>, input: &Input<T>) -> Output<T> {
            let q = &state.q;
            let v = &state.v;
            // Closed form of rocker.
            let (sin_crank, cos_crank) = Real::sin_cos(q.crank);
            let minus_rocker_a = cos_crank - T::lit(4.0);
            let rocker_d = minus_rocker_a * minus_rocker_a + sin_crank * sin_crank;
            let rocker_d_inv = T::lit(1.0) / rocker_d;
            let minus_rocker_c = T::lit(0.16666666666666666) * rocker_d
                - T::lit(0.5416666666666666);
            let root_rocker = Real::sqrt(rocker_d - minus_rocker_c * minus_rocker_c);
            let cos_rocker = rocker_d_inv
                * (minus_rocker_a * minus_rocker_c + sin_crank * root_rocker);
            let cos_rocker_times_3 = T::lit(3.0) * cos_rocker;
            let cos_rocker_times_3_plus_4 = T::lit(4.0) + cos_rocker_times_3;
            let sin_rocker = rocker_d_inv
                * (sin_crank * minus_rocker_c - minus_rocker_a * root_rocker);
            let cos_crank_times_sin_rocker = cos_crank * sin_rocker;
            let minus_coupler_v = sin_crank * cos_rocker_times_3_plus_4
                - T::lit(3.0) * cos_crank_times_sin_rocker;
            let minus_coupler_v_times_0_286 = T::lit(0.2857142857142857)
                * minus_coupler_v;
            // Closed form of coupler.
            let sin_rocker_times_3 = T::lit(3.0) * sin_rocker;
            let coupler_with_cos_crank = cos_crank * cos_rocker_times_3_plus_4
                + sin_crank * sin_rocker_times_3;
            let coupler_u = coupler_with_cos_crank - T::lit(1.0);
            let coupler_u_times_0_286 = T::lit(0.2857142857142857) * coupler_u;
            let crank_rate_times_minus_coupler_v = v.crank * minus_coupler_v;
            let minus_slope_rocker_inv = T::lit(1.0) / root_rocker;
            // Velocities of what follows.
            let crank_rate_times_sin_crank = v.crank * sin_crank;
            let pivot_1_with_cos_rocker = cos_rocker
                - T::lit(0.3333333333333333) * minus_rocker_a;
            let crank_rate_times_cos_crank = v.crank * cos_crank;
            let sin_crank_times_0_333_minus_sin_rocker = T::lit(0.3333333333333333)
                * sin_crank - sin_rocker;
            let w_rocker_z = minus_slope_rocker_inv
                * (crank_rate_times_sin_crank * pivot_1_with_cos_rocker
                    + crank_rate_times_cos_crank
                        * sin_crank_times_0_333_minus_sin_rocker);
            let cos_rocker_times_w_rocker_z = cos_rocker * w_rocker_z;
            let sin_crank_times_3 = T::lit(3.0) * sin_crank;
            let sin_rocker_times_w_rocker_z = sin_rocker * w_rocker_z;
            let cos_crank_times_3 = T::lit(3.0) * cos_crank;
            let coupler_with_sin_rocker = sin_rocker_times_w_rocker_z * cos_crank_times_3
                - cos_rocker_times_w_rocker_z * sin_crank_times_3;
            let coupler_with_crank_rate = crank_rate_times_minus_coupler_v
                + coupler_with_sin_rocker;
            let minus_coupler_v_times_0_0816 = T::lit(0.08163265306122448)
                * minus_coupler_v;
            let coupler_with_w_rocker_z = sin_rocker_times_w_rocker_z * sin_crank_times_3
                + cos_rocker_times_w_rocker_z * cos_crank_times_3;
            let coupler_with_sin_crank = v.crank * coupler_with_cos_crank
                - coupler_with_w_rocker_z;
            let coupler_u_times_0_0816 = T::lit(0.08163265306122448) * coupler_u;
            let minus_coupler_rate = coupler_with_crank_rate
                * minus_coupler_v_times_0_0816
                + coupler_with_sin_crank * coupler_u_times_0_0816;
            // Force and moment through coupler.
            let cos_crank_times_coupler_u = cos_crank * coupler_u;
            let energy_with_sin_crank = T::lit(0.2857142857142857)
                * cos_crank_times_coupler_u + sin_crank * minus_coupler_v_times_0_286;
            let cos_crank_times_minus_coupler_v = cos_crank * minus_coupler_v;
            let energy_with_coupler_u = sin_crank * coupler_u_times_0_286
                - T::lit(0.2857142857142857) * cos_crank_times_minus_coupler_v;
            let f_coupler_with_cos_crank = cos_crank
                - T::lit(2.0) * energy_with_coupler_u;
            let sin_crank_plus_twice_energy_with_sin_crank = sin_crank
                + T::lit(2.0) * energy_with_sin_crank;
            let energy_with_cos_crank = Real::sqrt(
                f_coupler_with_cos_crank * f_coupler_with_cos_crank
                    + sin_crank_plus_twice_energy_with_sin_crank
                        * sin_crank_plus_twice_energy_with_sin_crank,
            );
            let energy_with_cos_crank_minus_0_5 = energy_with_cos_crank - T::lit(0.5);
            let f_coupler_with_sin_crank = energy_with_cos_crank_minus_0_5
                / energy_with_cos_crank;
            let f_coupler_with_coupler_u = f_coupler_with_cos_crank
                * f_coupler_with_sin_crank;
            let f_coupler_with_coupler_v = sin_crank_plus_twice_energy_with_sin_crank
                * f_coupler_with_sin_crank;
            let f_coupler_x_with_sin_crank = energy_with_sin_crank
                * f_coupler_with_coupler_u
                + energy_with_coupler_u * f_coupler_with_coupler_v;
            let f_coupler_x_with_sin_crank_times_16 = T::lit(16.0)
                * f_coupler_x_with_sin_crank;
            let accel_with_w_rocker_z = w_rocker_z * cos_rocker_times_w_rocker_z;
            let accel_with_w_rocker_z_times_3 = T::lit(3.0) * accel_with_w_rocker_z;
            // Accelerations of what follows.
            let rocker_gap_accel_with_crank_rate = crank_rate_times_cos_crank
                * crank_rate_times_cos_crank;
            let rocker_gap_accel_with_cos_crank = v.crank * crank_rate_times_cos_crank;
            let rocker_gap_accel_with_sin_crank = v.crank * crank_rate_times_sin_crank;
            let accel_with_sin_rocker = w_rocker_z * sin_rocker_times_w_rocker_z;
            let rocker_gap_accel_with_rocker_a = T::lit(2.0)
                * (crank_rate_times_sin_crank * sin_rocker_times_w_rocker_z
                    + crank_rate_times_cos_crank * cos_rocker_times_w_rocker_z)
                - minus_rocker_a * accel_with_w_rocker_z
                - sin_crank * accel_with_sin_rocker;
            let rocker_accel = minus_slope_rocker_inv
                * (T::lit(0.3333333333333333)
                    * (rocker_gap_accel_with_crank_rate
                        - minus_rocker_a * rocker_gap_accel_with_cos_crank)
                    + cos_rocker * rocker_gap_accel_with_cos_crank
                    + sin_rocker * rocker_gap_accel_with_sin_crank
                    - rocker_gap_accel_with_rocker_a);
            // Force and moment through coupler.
            let coupler_gap_accel_with_rocker_accel = accel_with_w_rocker_z_times_3
                + rocker_accel * sin_rocker_times_3;
            let accel_with_sin_rocker_times_3 = T::lit(3.0) * accel_with_sin_rocker;
            let coupler_gap_accel_with_w_rocker_z = accel_with_sin_rocker_times_3
                - cos_rocker_times_3 * rocker_accel;
            let coupler_accel_with_crank_rate = v.crank
                * (coupler_with_w_rocker_z - coupler_with_sin_crank);
            let coupler_accel_with_sin_rocker = v.crank
                * (coupler_with_sin_rocker + coupler_with_crank_rate);
            let coupler_gap_accel_with_coupler_v = minus_coupler_v
                * (cos_crank * coupler_gap_accel_with_rocker_accel
                    + sin_crank * coupler_gap_accel_with_w_rocker_z
                    - coupler_accel_with_crank_rate)
                - coupler_u
                    * (sin_crank * coupler_gap_accel_with_rocker_accel
                        - cos_crank * coupler_gap_accel_with_w_rocker_z
                        + coupler_accel_with_sin_rocker);
            let w2_crank_z = v.crank * v.crank;
            let sin_crank_times_9_81_minus_w2_crank_z = T::lit(9.81) * sin_crank
                - w2_crank_z;
            let a_coupler_x_with_coupler_u = coupler_u
                * sin_crank_times_9_81_minus_w2_crank_z;
            let a_coupler_y_with_coupler_v = minus_coupler_v
                * sin_crank_times_9_81_minus_w2_crank_z;
            let minus_n_coupler_z = f_coupler_x_with_sin_crank_times_16
                + T::lit(1.090204081632653) * coupler_gap_accel_with_coupler_v
                + T::lit(1.962)
                    * (T::lit(0.1019367991845056) * a_coupler_x_with_coupler_u
                        - cos_crank_times_minus_coupler_v)
                - T::lit(16.677)
                    * (cos_crank_times_coupler_u
                        + T::lit(0.1019367991845056) * a_coupler_y_with_coupler_v);
            // Motion of crank.
            let coupler_u_times_minus_n_coupler_z = coupler_u * minus_n_coupler_z;
            let cos_rocker_times_44_145 = T::lit(44.145) * cos_rocker;
            let minus_coupler_v_times_minus_n_coupler_z = minus_coupler_v
                * minus_n_coupler_z;
            let side_1_with_rocker_accel = cos_rocker_times_44_145
                + T::lit(9.0) * rocker_accel
                - T::lit(0.24489795918367346)
                    * (cos_rocker
                        * (sin_crank * minus_coupler_v_times_minus_n_coupler_z
                            + cos_crank * coupler_u_times_minus_n_coupler_z)
                        - sin_rocker
                            * (cos_crank * minus_coupler_v_times_minus_n_coupler_z
                                - sin_crank * coupler_u_times_minus_n_coupler_z));
            let side_1_with_root_rocker = minus_slope_rocker_inv
                * side_1_with_rocker_accel;
            let w_coupler_z = v.crank - minus_coupler_rate;
            // Force and moment through coupler.
            let w2_coupler_z = w_coupler_z * w_coupler_z;
            let f_coupler_x_with_w2_coupler_z = T::lit(8.0) * f_coupler_x_with_sin_crank
                - T::lit(5.95) * w2_coupler_z;
            let f_coupler_x = T::lit(0.05714285714285714)
                * coupler_gap_accel_with_coupler_v + f_coupler_x_with_w2_coupler_z;
            let f_coupler_y_with_w2_coupler_z = T::lit(8.0)
                * (energy_with_coupler_u * f_coupler_with_coupler_u
                    - energy_with_sin_crank * f_coupler_with_coupler_v)
                + T::lit(0.7) * w2_coupler_z;
            let minus_f_coupler_y = T::lit(0.4857142857142857)
                * coupler_gap_accel_with_coupler_v + f_coupler_y_with_w2_coupler_z;
            let side_1 = input.torque + minus_n_coupler_z
                - T::lit(0.08163265306122448) * coupler_with_cos_crank
                    * coupler_u_times_minus_n_coupler_z
                - sin_crank * side_1_with_root_rocker * pivot_1_with_cos_rocker
                - cos_crank
                    * (T::lit(39.24)
                        + side_1_with_root_rocker
                            * sin_crank_times_0_333_minus_sin_rocker)
                + minus_coupler_v
                    * (T::lit(0.2857142857142857) * f_coupler_x
                        - T::lit(0.08163265306122448)
                            * minus_coupler_v_times_minus_n_coupler_z)
                + coupler_u_times_0_286 * minus_f_coupler_y;
            // Factorisation L^T D L.
            let f_coupler_passed_y = T::lit(0.2) * minus_coupler_v
                + T::lit(1.7) * coupler_u;
            let pivot_1_with_root_rocker = minus_slope_rocker_inv
                * (cos_crank_times_sin_rocker
                    - sin_crank
                        * (T::lit(0.3333333333333333) * cos_crank
                            + pivot_1_with_cos_rocker));
            let sin_rocker_times_pivot_1_with_root_rocker = sin_rocker
                * pivot_1_with_root_rocker;
            let cos_rocker_times_pivot_1_with_root_rocker = cos_rocker
                * pivot_1_with_root_rocker;
            let pivot_1_with_coupler_v = minus_coupler_v
                * (minus_coupler_v
                    - T::lit(3.0)
                        * (cos_crank * sin_rocker_times_pivot_1_with_root_rocker
                            - sin_crank * cos_rocker_times_pivot_1_with_root_rocker))
                + coupler_u
                    * (coupler_with_cos_crank
                        + T::lit(3.0)
                            * (sin_crank * sin_rocker_times_pivot_1_with_root_rocker
                                + cos_crank * cos_rocker_times_pivot_1_with_root_rocker));
            let minus_pivot_1 = T::lit(0.16326530612244897) * pivot_1_with_coupler_v
                * (T::lit(13.355) + f_coupler_passed_y
                    - T::lit(0.5451020408163265) * pivot_1_with_coupler_v)
                - T::lit(17.188333333333333) - T::lit(2.0) * f_coupler_passed_y
                - T::lit(9.0) * pivot_1_with_root_rocker * pivot_1_with_root_rocker;
            let minus_dw_crank_z = side_1 / minus_pivot_1;
            // Accelerations of what follows.
            let rocker_gap_accel_with_dw_crank_z = rocker_gap_accel_with_cos_crank
                - sin_crank * minus_dw_crank_z;
            let rocker_gap_accel_with_cos_crank_and_dw_crank_z = rocker_gap_accel_with_sin_crank
                + cos_crank * minus_dw_crank_z;
            let rocker_gap_accel = T::lit(0.3333333333333333)
                * (crank_rate_times_sin_crank * crank_rate_times_sin_crank
                    + rocker_gap_accel_with_crank_rate
                    - minus_rocker_a * rocker_gap_accel_with_dw_crank_z
                    - sin_crank * rocker_gap_accel_with_cos_crank_and_dw_crank_z)
                + cos_rocker * rocker_gap_accel_with_dw_crank_z
                + sin_rocker * rocker_gap_accel_with_cos_crank_and_dw_crank_z
                - rocker_gap_accel_with_rocker_a;
            let rocker_accel_with_root_rocker = minus_slope_rocker_inv
                * rocker_gap_accel;
            let coupler_accel_with_w_rocker_z = accel_with_w_rocker_z_times_3
                + rocker_accel_with_root_rocker * sin_rocker_times_3;
            let coupler_accel_with_cos_rocker = accel_with_sin_rocker_times_3
                - cos_rocker_times_3 * rocker_accel_with_root_rocker;
            let coupler_accel = (minus_coupler_v * minus_dw_crank_z
                - cos_crank * coupler_accel_with_w_rocker_z
                - sin_crank * coupler_accel_with_cos_rocker
                + coupler_accel_with_crank_rate) * minus_coupler_v_times_0_0816
                + (sin_crank * coupler_accel_with_w_rocker_z
                    - cos_crank * coupler_accel_with_cos_rocker
                    + coupler_with_cos_crank * minus_dw_crank_z
                    + coupler_accel_with_sin_rocker) * coupler_u_times_0_0816;
            // Force and moment through coupler.
            let a_coupler_with_cos_crank = T::lit(9.81) * cos_crank - minus_dw_crank_z;
            let a_coupler_x_with_coupler_v = a_coupler_x_with_coupler_u
                - minus_coupler_v * a_coupler_with_cos_crank;
            let u_coupler_xy = minus_dw_crank_z - coupler_accel;
            let a_coupler_y_with_coupler_u = a_coupler_y_with_coupler_v
                + coupler_u * a_coupler_with_cos_crank;
            let minus_n_coupler_z_with_u_coupler_xy = f_coupler_x_with_sin_crank_times_16
                + T::lit(0.2) * a_coupler_x_with_coupler_v
                - T::lit(1.7) * a_coupler_y_with_coupler_u
                + T::lit(13.355) * u_coupler_xy;
            let ([multiplier_2, multiplier_1], _) = ::multibody::linear::solve(
                [
                    [
                        (T::lit(-3.5) * energy_with_sin_crank),
                        (T::lit(3.5) * energy_with_coupler_u),
                    ],
                    [cos_rocker_times_3, -sin_rocker_times_3],
                ],
                [
                    minus_n_coupler_z_with_u_coupler_xy,
                    -(cos_rocker_times_44_145
                        + T::lit(9.0) * rocker_accel_with_root_rocker),
                ],
            );
            let f_coupler_x_with_u_coupler_xy = a_coupler_x_with_coupler_v
                + T::lit(0.7) * u_coupler_xy - energy_with_sin_crank * multiplier_1
                - energy_with_coupler_u * multiplier_2 + f_coupler_x_with_w2_coupler_z;
            let minus_f_coupler_y_with_u_coupler_xy = T::lit(5.95) * u_coupler_xy
                - a_coupler_y_with_coupler_u - energy_with_coupler_u * multiplier_1
                + energy_with_sin_crank * multiplier_2 + f_coupler_y_with_w2_coupler_z;
            // Results.
            let energy_with_w2_crank_z = w2_crank_z
                + T::lit(3.483913043478261) * w2_coupler_z
                + T::lit(2.347826086956522) * w_rocker_z * w_rocker_z
                + w_coupler_z
                    * (T::lit(0.10434782608695652) * crank_rate_times_minus_coupler_v
                        + T::lit(0.8869565217391304) * v.crank * coupler_u);
            let energy = T::lit(39.24) * sin_crank + T::lit(44.145) * sin_rocker
                + T::lit(6.867)
                    * (energy_with_sin_crank + T::lit(8.5) * energy_with_coupler_u)
                + T::lit(4.0) * energy_with_cos_crank_minus_0_5
                    * energy_with_cos_crank_minus_0_5
                + T::lit(1.9166666666666667) * energy_with_w2_crank_z;
            Output {
                angles: [
                    q.crank,
                    -Real::atan2(minus_coupler_v_times_0_286, coupler_u_times_0_286),
                    Real::atan2(sin_rocker, cos_rocker),
                ],
                rates: [v.crank, -minus_coupler_rate, w_rocker_z],
                accels: [
                    -minus_dw_crank_z,
                    coupler_accel,
                    rocker_accel_with_root_rocker,
                ],
                reactions: [
                    ::multibody::nalgebra::Vector3::from([
                        (energy_with_sin_crank * f_coupler_x_with_u_coupler_xy
                            + energy_with_coupler_u
                                * minus_f_coupler_y_with_u_coupler_xy),
                        (energy_with_coupler_u * f_coupler_x_with_u_coupler_xy
                            - energy_with_sin_crank
                                * minus_f_coupler_y_with_u_coupler_xy),
                        T::lit(0.0),
                    ]),
                    ::multibody::nalgebra::Vector3::from([
                        -multiplier_1,
                        -multiplier_2,
                        T::lit(0.0),
                    ]),
                ],
                energy,
            }
        }
        /// Distances from dead centres, in the order of `DEAD_CENTRES`. Of a loop's solution: its square root, a product of lengths, zero where two solutions meet and NaN where the loop cannot be closed. Of roll, pitch and yaw: the cosine of the pitch, zero where roll and yaw turn about one axis. Rates grow without bound there.
        ///
        /// Method: closed forms.
        ///
        /// Operations: 4 add, 4 mul, 1 sqrt, 1 sincos; as derived, before optimisation: 4 add, 4 mul, 1 sqrt, 1 sincos.
        #[must_use]
        pub fn dead_centres(
            &self,
            _t: T,
            q: &Position<T>,
        ) -> ::multibody::nalgebra::SVector<T, 1> {
            // Closed form of rocker.
            let (sin_crank, cos_crank) = Real::sin_cos(q.crank);
            let minus_rocker_a = cos_crank - T::lit(4.0);
            let rocker_d = minus_rocker_a * minus_rocker_a + sin_crank * sin_crank;
            let minus_rocker_c = T::lit(0.16666666666666666) * rocker_d
                - T::lit(0.5416666666666666);
            ::multibody::nalgebra::SVector::from([
                Real::sqrt(rocker_d - minus_rocker_c * minus_rocker_c),
            ])
        }
        /// For integrators, at a state whose guess is the solution: how far loops are from dead centres (the root of a closed form, the determinant of what Newton's method solves), each followed by the rate of its square; then the greatest residual of Newton's method, if it closes loops.
        ///
        /// Method: closed forms, determinants.
        ///
        /// Operations: 6 add, 8 mul, 1 sqrt, 1 sincos; as derived, before optimisation: 6 add, 12 mul, 1 sqrt, 1 sincos.
        #[must_use]
        pub fn margins(
            &self,
            _t: T,
            state: &State<T>,
        ) -> ::multibody::nalgebra::SVector<T, 2> {
            let q = &state.q;
            let v = &state.v;
            // Closed form of rocker.
            let (sin_crank, cos_crank) = Real::sin_cos(q.crank);
            let minus_rocker_a = cos_crank - T::lit(4.0);
            let rocker_d = minus_rocker_a * minus_rocker_a + sin_crank * sin_crank;
            let minus_rocker_c = T::lit(0.16666666666666666) * rocker_d
                - T::lit(0.5416666666666666);
            ::multibody::nalgebra::SVector::from([
                Real::sqrt(rocker_d - minus_rocker_c * minus_rocker_c),
                (v.crank * sin_crank * (cos_crank - minus_rocker_a)
                    * (T::lit(2.0) - T::lit(0.6666666666666666) * minus_rocker_c)),
            ])
        }
    }
    impl<T: Real> Default for Model<T> {
        fn default() -> Self {
            Self::new(&Params::default())
        }
    }
    impl<T: Real> Model<T> {
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
                coordinate: "rocker",
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
            let matrix = self.mass_matrix(&state.q);
            ::multibody::pivots::without_inertia(&matrix, &["crank"])
        }
    }
    /// Names of the components of a velocity, in order.
    pub const COORDINATES: &[&str] = &["crank"];
    /// The coordinates whose dead centres `dead_centres` tells of, in order.
    pub const DEAD_CENTRES: &[&str] = &["rocker"];
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
            add: 78,
            mul: 132,
            div: 4,
            sqrt: 2,
            sincos: 1,
            other: 0,
        },
        ::multibody::Cost {
            function: "inverse_dynamics",
            add: 73,
            mul: 117,
            div: 3,
            sqrt: 2,
            sincos: 1,
            other: 0,
        },
        ::multibody::Cost {
            function: "mass_matrix",
            add: 24,
            mul: 36,
            div: 2,
            sqrt: 1,
            sincos: 1,
            other: 0,
        },
        ::multibody::Cost {
            function: "bias",
            add: 65,
            mul: 111,
            div: 3,
            sqrt: 2,
            sincos: 1,
            other: 0,
        },
        ::multibody::Cost {
            function: "outputs",
            add: 179,
            mul: 213,
            div: 10,
            sqrt: 2,
            sincos: 1,
            other: 2,
        },
        ::multibody::Cost {
            function: "dead_centres",
            add: 4,
            mul: 4,
            div: 0,
            sqrt: 1,
            sincos: 1,
            other: 0,
        },
        ::multibody::Cost {
            function: "margins",
            add: 6,
            mul: 8,
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
            add: 93,
            mul: 192,
            div: 4,
            sqrt: 2,
            sincos: 1,
            other: 0,
        },
        ::multibody::Cost {
            function: "inverse_dynamics",
            add: 82,
            mul: 163,
            div: 3,
            sqrt: 2,
            sincos: 1,
            other: 0,
        },
        ::multibody::Cost {
            function: "mass_matrix",
            add: 28,
            mul: 50,
            div: 2,
            sqrt: 1,
            sincos: 1,
            other: 0,
        },
        ::multibody::Cost {
            function: "bias",
            add: 76,
            mul: 158,
            div: 3,
            sqrt: 2,
            sincos: 1,
            other: 0,
        },
        ::multibody::Cost {
            function: "outputs",
            add: 210,
            mul: 291,
            div: 10,
            sqrt: 2,
            sincos: 1,
            other: 2,
        },
        ::multibody::Cost {
            function: "dead_centres",
            add: 4,
            mul: 4,
            div: 0,
            sqrt: 1,
            sincos: 1,
            other: 0,
        },
        ::multibody::Cost {
            function: "margins",
            add: 6,
            mul: 12,
            div: 0,
            sqrt: 1,
            sincos: 1,
            other: 0,
        },
    ];
}
