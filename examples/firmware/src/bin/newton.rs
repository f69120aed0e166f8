//! The firmware of [`firmware::scenes::Newton`].

#![cfg_attr(target_os = "none", no_std, no_main)]

firmware::firmware!(firmware::scenes::Newton);
