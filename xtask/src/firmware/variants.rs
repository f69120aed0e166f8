//! What is built and run, and what it may cost.

/// The programs of the firmware that are run everywhere.
pub(crate) const SCENES: [&str; 8] =
    ["double_pendulum", "cart_pole", "panda", "stewart", "quadrotor", "newton", "projection", "rolling"];

/// Scenes with pivots, and with an iteration that ends where it is close enough: what they take depends on the numbers.
pub(crate) const ITERATING: [&str; 2] = ["newton", "projection"];

/// Variant and scene where NaN may take a few instructions less: the comparisons of the law's two limits are jumps there.
pub(crate) const JUMPING: [(&str, &str); 1] = [("riscv32", "cart_pole")];

/// Where counts depend on the numbers a little: that the pivots of the disc's speeds are not zero is asked by jumps there.
pub(crate) const BRANCHING: [(&str, &str); 1] = [("riscv32", "rolling")];

/// What runs a program.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Runner {
    /// This computer.
    Host,
    /// `qemu-system-SYSTEM -machine BOARD`, with these additional arguments and this many nanoseconds, as a power of two, for
    /// an instruction.
    Qemu { system: &'static str, board: &'static str, more: &'static [&'static str], shift: u8 },
    /// The module of WebAssembly in node.
    Node,
}

const MPS2: Runner = Runner::Qemu { system: "arm", board: "mps2-an386", more: &[], shift: 10 };
const MPS2_M7: Runner = Runner::Qemu { system: "arm", board: "mps2-an500", more: &[], shift: 10 };
const VIRT: Runner = Runner::Qemu { system: "riscv32", board: "virt", more: &["-bios", "none"], shift: 0 };

const CORTEX: Option<&str> = Some("thumbv7em-none-eabihf");
const RISCV: Option<&str> = Some("riscv32imafc-unknown-none-elf");
const WASM: Option<&str> = Some("wasm32-unknown-unknown");

/// One way to build the firmware.
pub(crate) struct Variant {
    pub(crate) name: &'static str,
    /// None is this computer's.
    pub(crate) target: Option<&'static str>,
    pub(crate) runner: Runner,
    pub(crate) processor: Option<&'static str>,
    pub(crate) profile: &'static str,
    pub(crate) features: &'static str,
}

const fn variant(
    name: &'static str,
    target: Option<&'static str>,
    runner: Runner,
    processor: Option<&'static str>,
    profile: &'static str,
    features: &'static str,
) -> Variant {
    Variant { name, target, runner, processor, profile, features }
}

#[rustfmt::skip]
pub(crate) const VARIANTS: [Variant; 13] = [
    variant("host",          None,   Runner::Host, None,              "release", ""),
    variant("host-f64",      None,   Runner::Host, None,              "release", "double"),
    variant("host-std",      None,   Runner::Host, None,              "release", "std"),
    variant("host-std-f64",  None,   Runner::Host, None,              "release", "std,double"),
    variant("m4f",           CORTEX, MPS2,         None,              "release", "hardware-root"),
    variant("m4f-libm-root", CORTEX, MPS2,         None,              "release", ""),
    variant("m4f-small",     CORTEX, MPS2,         None,              "small",   "hardware-root"),
    variant("m4f-f64",       CORTEX, MPS2,         None,              "release", "double"),
    variant("m7",            CORTEX, MPS2_M7,      Some("cortex-m7"), "release", "hardware-root"),
    variant("m7-f64",        CORTEX, MPS2_M7,      Some("cortex-m7"), "release", "double,hardware-root-double"),
    variant("riscv32",       RISCV,  VIRT,         None,              "release", "hardware-root"),
    variant("wasm32",        WASM,   Runner::Node, None,              "release", ""),
    variant("wasm32-f64",    WASM,   Runner::Node, None,              "release", "double"),
];

/// Variant, scene, what, and how much of it at most.
pub(crate) const LIMITS: [(&str, &str, &str, u64); 24] = [
    ("m4f", "double_pendulum", "instructions, most", 900),
    ("m4f", "double_pendulum", "stack bytes", 512),
    ("m4f", "double_pendulum", "flash of model and method", 4096),
    ("m4f", "cart_pole", "instructions, most", 700),
    ("m4f", "cart_pole", "stack bytes", 512),
    ("m4f", "panda", "instructions, most", 1600),
    ("m4f", "panda", "stack bytes", 2048),
    ("m4f", "stewart", "instructions, most", 1000),
    ("m4f", "stewart", "stack bytes", 512),
    ("m4f", "double_pendulum", "software operations of f64", 0),
    ("m4f", "cart_pole", "software operations of f64", 0),
    ("m4f", "panda", "software operations of f64", 0),
    ("m4f", "stewart", "software operations of f64", 0),
    ("m4f", "quadrotor", "instructions, most", 2600),
    ("m4f", "quadrotor", "software operations of f64", 0),
    ("m4f", "newton", "software operations of f64", 0),
    ("m4f", "newton", "instructions, most", 46_000),
    ("m4f", "projection", "instructions, most", 46_000),
    ("m4f", "projection", "software operations of f64", 0),
    ("m4f", "rolling", "instructions, most", 1400),
    ("m4f", "rolling", "stack bytes", 512),
    ("m4f", "rolling", "software operations of f64", 0),
    ("m4f-small", "quadrotor", "software operations of f64", 0),
    ("m7-f64", "panda", "instructions, most", 1800),
];
