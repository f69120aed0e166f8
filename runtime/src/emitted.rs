//! What is said where a function of a generated model is called that was not derived.
//!
//! A generated `Model` has a method of each function's name. Of those that `emit` doesn't ask for the argument has to
//! implement one of the traits here. Nothing implements them, nothing can, and what they say stands at the call.

mod sealed {
    /// Nothing implements it.
    pub trait Never {}
}

macro_rules! words {
    ($($name:ident $message:literal $note:literal)*) => {$(
        /// Nothing implements it: the function was not derived.
        #[diagnostic::on_unimplemented(message = $message, label = "not derived for this model", note = $note)]
        pub trait $name: sealed::Never {
            /// What the function would give.
            type Result;

            /// Is never called.
            fn never() -> Self::Result;
        }
    )*};
}

words! {
    ForwardDynamics "this model's `emit` does not ask for `forward_dynamics`"
        "write `emit forward_dynamics;` in the model, or add it to the list of its `emit`"
    InverseDynamics "this model's `emit` does not ask for `inverse_dynamics`"
        "add it to the model: `emit forward_dynamics, inverse_dynamics;`"
    MassMatrix "this model's `emit` does not ask for `mass_matrix`"
        "add it to the model: `emit forward_dynamics, mass_matrix;`"
    Bias "this model's `emit` does not ask for `bias`"
        "add it to the model: `emit forward_dynamics, bias;`"
    Energy "this model's `emit` does not ask for `energy`, which gives `kinetic_energy` and `potential_energy`"
        "add it to the model: `emit forward_dynamics, energy;`, or write `output energy = kinetic() + potential();`"
    Residual "this model's `emit` does not ask for `residual`"
        "add it to the model: `emit forward_dynamics, residual;`"
    Kinematics "this model's `emit` does not ask for `kinematics`"
        "add it to the model: `emit forward_dynamics, kinematics {{ given: platform.pose, find: legs.stroke }};`"
    AssemblyModes "this model's `emit` does not ask for `assembly_modes`"
        "add it to the model: `emit forward_dynamics, assembly_modes {{ given: legs.stroke, find: platform.pose }};`"
    Derivatives "this model's `emit` does not ask for `derivatives`, which gives `forward_derivatives` and `inverse_derivatives`"
        "add it to the model: `emit forward_dynamics, derivatives;`"
    Linearize "this model's `emit` does not ask for `linearize`"
        "add it to the model: `emit forward_dynamics, linearize;`"
    Impulse "this model's `emit` does not ask for `impulse`"
        "add it to the model: `emit forward_dynamics, impulse;`"
    Momentum "this model's `emit` does not ask for `momentum`, which gives `momentum`, `momentum_rate` and `velocity`"
        "add it to the model: `emit forward_dynamics, momentum;`"
    Outputs "this model has no `output`, so it has no `outputs`"
        "write `output name = value;` in the model: outputs are always emitted"
}
