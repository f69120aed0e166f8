//! Systems whose velocities are the rates of their coordinates: [`SecondOrder`].

use crate::{Configuration, DisplacementOf, StateSpace, System, VelocityOf};
use same::SameAs;

mod same {
    /// The same type. Nothing but a type itself implements it.
    #[diagnostic::on_unimplemented(
        message = "this needs velocities that are the rates of coordinates, q' = v",
        label = "velocities of this system are speeds of their own",
        note = "a model of `multibody!` with `speed` items, or with speeds that are eliminated, has no such velocities",
        note = "take a method for q' = N(q) u instead: `Rk4`, `DormandPrince`, `Dop853`, `Radau`, or in place of a symplectic one `ImplicitMidpoint`, `GaussLegendre4`, `GaussLegendre6`"
    )]
    pub trait SameAs<V> {
        /// The same value.
        fn same(self) -> V;
        /// The same value.
        fn of(same: V) -> Self;
    }

    impl<V> SameAs<V> for V {
        #[inline]
        fn same(self) -> V {
            self
        }
        #[inline]
        fn of(same: V) -> V {
            same
        }
    }
}

/// A system whose velocities are the rates of its coordinates, `q' = v`: one displaces positions as the other does.
///
/// Every [`System`] for which [`VelocityOf`] and [`DisplacementOf`] are one type is one. Its
/// [`position_rates`](System::position_rates) have to be its velocities.
///
/// A system with speeds of its own is none:
///
/// ```
/// # mod skate {
/// # use multibody::{StateSpace, System, nalgebra::{Vector2, Vector3}};
/// # #[derive(Clone, Copy)]
/// # pub struct State { pub q: Vector3<f64>, pub u: Vector2<f64> }
/// # impl StateSpace for State {
/// #     type Scalar = f64;
/// #     type Position = Vector3<f64>;
/// #     type Velocity = Vector2<f64>;
/// #     type Extra = ();
/// #     fn split(&self) -> (Vector3<f64>, Vector2<f64>, ()) { (self.q, self.u, ()) }
/// #     fn join(&self, q: Vector3<f64>, u: Vector2<f64>, (): ()) -> Self { Self { q, u } }
/// # }
/// /// A skate: its place and its heading, with two speeds, ahead and turning.
/// pub struct Skate;
///
/// impl System for Skate {
///     type Scalar = f64;
///     type State = State;
///     type Input = ();
///     fn derivative(&self, _t: f64, _x: &State, (): &()) -> (Vector2<f64>, ()) { (Vector2::zeros(), ()) }
///     fn position_rates(&self, _t: f64, x: &State) -> Vector3<f64> {
///         let (sin, cos) = x.q.z.sin_cos();
///         Vector3::new(cos * x.u.x, sin * x.u.x, x.u.y)
///     }
/// }
/// # }
/// use multibody::{Rk4, nalgebra::{Vector2, Vector3}};
/// use skate::{Skate, State};
///
/// let start = State { q: Vector3::zeros(), u: Vector2::new(1.5, 0.5) }; // round a circle of 3 m
/// let end = Rk4::integrate(&Skate, 0.0, &start, &(), 0.01, 200, |_, _| ()).unwrap();
/// assert!((end.q.x - 3.0 * 1.0_f64.sin()).abs() < 1e-9);
/// ```
///
/// Accelerations that depend on positions alone don't make Verlet's method fit:
///
/// ```compile_fail,E0277
/// # use multibody::{*, nalgebra::{Vector2, Vector3}};
/// # #[derive(Clone, Copy)]
/// # struct State { q: Vector3<f64>, u: Vector2<f64> }
/// # impl StateSpace for State {
/// #     type Scalar = f64;
/// #     type Position = Vector3<f64>;
/// #     type Velocity = Vector2<f64>;
/// #     type Extra = ();
/// #     fn split(&self) -> (Vector3<f64>, Vector2<f64>, ()) { (self.q, self.u, ()) }
/// #     fn join(&self, q: Vector3<f64>, u: Vector2<f64>, (): ()) -> Self { Self { q, u } }
/// # }
/// # struct Skate;
/// # impl System for Skate {
/// #     type Scalar = f64;
/// #     type State = State;
/// #     type Input = ();
/// #     fn derivative(&self, _t: f64, _x: &State, (): &()) -> (Vector2<f64>, ()) { (Vector2::zeros(), ()) }
/// #     fn position_rates(&self, _t: f64, x: &State) -> Vector3<f64> { Vector3::new(x.u.x, 0.0, x.u.y) }
/// # }
/// impl Separable for Skate {}
/// ```
///
/// Nor are speeds what belongs to momenta `M(q) q'`:
///
/// ```compile_fail,E0277
/// # use multibody::{*, nalgebra::{Vector2, Vector3}};
/// # #[derive(Clone, Copy)]
/// # struct State { q: Vector3<f64>, u: Vector2<f64> }
/// # impl StateSpace for State {
/// #     type Scalar = f64;
/// #     type Position = Vector3<f64>;
/// #     type Velocity = Vector2<f64>;
/// #     type Extra = ();
/// #     fn split(&self) -> (Vector3<f64>, Vector2<f64>, ()) { (self.q, self.u, ()) }
/// #     fn join(&self, q: Vector3<f64>, u: Vector2<f64>, (): ()) -> Self { Self { q, u } }
/// # }
/// # struct Skate;
/// # impl System for Skate {
/// #     type Scalar = f64;
/// #     type State = State;
/// #     type Input = ();
/// #     fn derivative(&self, _t: f64, _x: &State, (): &()) -> (Vector2<f64>, ()) { (Vector2::zeros(), ()) }
/// #     fn position_rates(&self, _t: f64, x: &State) -> Vector3<f64> { Vector3::new(x.u.x, 0.0, x.u.y) }
/// # }
/// impl Canonical for Skate {
///     fn momentum(&self, state: &State) -> Vector2<f64> { state.u }
///     fn velocity(&self, _q: &Vector3<f64>, momentum: &Vector2<f64>) -> Vector2<f64> { *momentum }
///     fn momentum_rate(&self, _t: f64, _state: &State, (): &()) -> Vector2<f64> { Vector2::zeros() }
/// }
/// ```
///
/// Generalised alpha is a method for second-order equations:
///
/// ```compile_fail,E0277
/// # use multibody::{*, nalgebra::{Vector2, Vector3}};
/// # #[derive(Clone, Copy)]
/// # struct State { q: Vector3<f64>, u: Vector2<f64> }
/// # impl StateSpace for State {
/// #     type Scalar = f64;
/// #     type Position = Vector3<f64>;
/// #     type Velocity = Vector2<f64>;
/// #     type Extra = ();
/// #     fn split(&self) -> (Vector3<f64>, Vector2<f64>, ()) { (self.q, self.u, ()) }
/// #     fn join(&self, q: Vector3<f64>, u: Vector2<f64>, (): ()) -> Self { Self { q, u } }
/// # }
/// # struct Skate;
/// # impl System for Skate {
/// #     type Scalar = f64;
/// #     type State = State;
/// #     type Input = ();
/// #     fn derivative(&self, _t: f64, _x: &State, (): &()) -> (Vector2<f64>, ()) { (Vector2::zeros(), ()) }
/// #     fn position_rates(&self, _t: f64, x: &State) -> Vector3<f64> { Vector3::new(x.u.x, 0.0, x.u.y) }
/// # }
/// let start = State { q: Vector3::zeros(), u: Vector2::zeros() };
/// let method = Integrator::fixed(GeneralisedAlpha::new(0.8).functional(), 0.1);
/// let _ = method.integrate(&Skate, 0.0, 1.0, &start, &(), |_, _| ());
/// ```
#[diagnostic::on_unimplemented(
    message = "the velocities of `{Self}` are not the rates of its coordinates",
    label = "this needs q' = v",
    note = "a model of `multibody!` with `speed` items, or with speeds that are eliminated, has no such velocities",
    note = "take a method for q' = N(q) u instead: `Rk4`, `DormandPrince`, `Dop853`, `Radau`, or in place of a symplectic one `ImplicitMidpoint`, `GaussLegendre4`, `GaussLegendre6`"
)]
pub trait SecondOrder:
    System<
    State: StateSpace<
        Position: Configuration<
            <Self as System>::Scalar,
            Velocity: SameAs<<<Self as System>::State as StateSpace>::Velocity>,
        >,
    >,
>
{
    /// A velocity as the displacement in a unit of time.
    fn as_displacement(v: VelocityOf<Self>) -> DisplacementOf<Self>;

    /// A displacement as the velocity that makes it in a unit of time.
    fn as_velocity(d: DisplacementOf<Self>) -> VelocityOf<Self>;
}

impl<S: System + ?Sized> SecondOrder for S
where
    DisplacementOf<S>: SameAs<VelocityOf<S>>,
{
    #[inline]
    fn as_displacement(v: VelocityOf<S>) -> DisplacementOf<S> {
        SameAs::of(v)
    }
    #[inline]
    fn as_velocity(d: DisplacementOf<S>) -> VelocityOf<S> {
        d.same()
    }
}
