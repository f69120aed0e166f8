//! Functions that are generated.

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum FunctionKind {
    /// Accelerations in the order of velocity coordinates, then the rates of the user's states; with constraints the
    /// multipliers and the rank of their system; with iterations the greatest residual of the loops.
    ForwardDynamics,
    /// Efforts in the order of velocity coordinates; with `solve_for` the inputs found, then the rank of their system.
    InverseDynamics,
    /// DOF x DOF, row by row.
    MassMatrix,
    /// DOF
    Bias,
    KineticEnergy,
    PotentialEnergy,
    /// Residuals of the constraint equations.
    Constraints,
    /// Equations x DOF, row by row.
    ConstraintJacobian,
    /// Time derivatives of the residuals.
    ConstraintRate,
    /// What is left of the second time derivatives of the residuals where accelerations are zero.
    ConstraintBias,
    /// DOF dynamic rows M a + bias + G^T lambda, then the residuals of the constraint equations.
    Residual,
    /// Of the model's kinematics number k: values, then rates, then accelerations.
    Kinematics(usize),
    /// The unknowns of all iterations, then the greatest residual.
    Guess,
    /// Roots in closed forms of loops that vanish where two solutions meet.
    DeadCentres,
    /// Of each of `Structure::margins` what vanishes in its dead centre, and the rate of its square; then, with iterations,
    /// the greatest residual at the guess.
    Margins,
    /// Of each of `Structure::granted` the residual over its scale, at the guess.
    Granted,
    /// Partial derivatives of the accelerations and of the rates of own states, R of them: R x DOF by displacements of the
    /// position, R x DOF by velocities, R x own states, R x scalars of inputs, each row by row.
    ForwardDerivatives,
    /// The same of the efforts, DOF of them.
    InverseDerivatives,
    /// The jump of the velocities; with constraints the multipliers and the rank of their system.
    Impulse,
    /// Momenta, by velocity coordinate.
    Momentum,
    /// Their rates.
    MomentumRate,
    /// Velocities that belong to momenta.
    MomentumVelocity,
    /// Output after output, flattened: `Vec3` 3, `Rotation` 9 row by row, `Pose` x, y, z, w, i, j, k, `Twist` and
    /// `Wrench` 6, `Jacobian` 6 x DOF row by row, arrays element by element.
    Outputs,
}
