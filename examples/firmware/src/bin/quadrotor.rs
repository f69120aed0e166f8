//! The firmware of [`firmware::scenes::Quadrotor`].

#![cfg_attr(target_os = "none", no_std, no_main)]

firmware::firmware!(firmware::scenes::Quadrotor);
