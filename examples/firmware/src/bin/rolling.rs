//! The firmware of [`firmware::scenes::Rolling`].

#![cfg_attr(target_os = "none", no_std, no_main)]

firmware::firmware!(firmware::scenes::Rolling);
