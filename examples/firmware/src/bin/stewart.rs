//! The firmware of [`firmware::scenes::Stewart`].

#![cfg_attr(target_os = "none", no_std, no_main)]

firmware::firmware!(firmware::scenes::Stewart);
