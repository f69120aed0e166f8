//! Stage `model`: the table of known units.
//!
//! In: one symbol, such as `mm`. Out: its unit. Symbols of the SI and a few beside them, with the prefixes that people
//! put before them. What stands for something else as well is left out: `g` alone is also the acceleration of gravity,
//! `C` alone also a temperature in Celsius, which is no multiple of kelvins.

use super::dimension::Unit;

/// Symbol, unit, whether prefixes stand before it.
const UNITS: [(&str, Unit, bool); 47] = [
    ("m", LENGTH, true),
    ("kg", MASS, false),
    ("s", TIME, true),
    ("A", Unit::si([0, 0, 0, 1, 0, 0, 0]), true),
    ("K", Unit::si([0, 0, 0, 0, 1, 0, 0]), true),
    ("mol", Unit::si([0, 0, 0, 0, 0, 1, 0]), true),
    ("cd", Unit::si([0, 0, 0, 0, 0, 0, 1]), true),
    ("rad", Unit::ONE, true),
    ("sr", Unit::ONE, false),
    ("-", Unit::ONE, false),
    ("%", Unit::ONE.scaled(0.01), false),
    ("deg", DEGREE, false),
    ("°", DEGREE, false),
    ("rev", TURN, false),
    ("rpm", RATE.scaled(std::f64::consts::TAU / 60.0), false),
    ("Hz", RATE, true),
    ("N", FORCE, true),
    ("lbf", FORCE.scaled(4.448_221_615_260_5), false),
    ("Nm", ENERGY, true),
    ("Nms", Unit::si([2, 1, -1, 0, 0, 0, 0]), false),
    ("Ns", Unit::si([1, 1, -1, 0, 0, 0, 0]), false),
    ("Pa", PRESSURE, true),
    ("bar", PRESSURE.scaled(1e5), true),
    ("J", ENERGY, true),
    ("Wh", ENERGY.scaled(3600.0), true),
    ("W", POWER, true),
    ("Ws", ENERGY, true),
    ("C", CHARGE, true),
    ("As", CHARGE, true),
    ("Ah", CHARGE.scaled(3600.0), true),
    ("V", VOLTAGE, true),
    ("VA", POWER, true),
    ("ohm", RESISTANCE, true),
    ("Ohm", RESISTANCE, true),
    // The capital letter, and the sign that looks like it.
    ("\u{3a9}", RESISTANCE, true),
    ("\u{2126}", RESISTANCE, true),
    ("S", Unit::si([-2, -1, 3, 2, 0, 0, 0]), true),
    ("F", Unit::si([-2, -1, 4, 2, 0, 0, 0]), true),
    ("H", INDUCTANCE, true),
    ("T", Unit::si([0, 1, -2, -1, 0, 0, 0]), true),
    ("Wb", Unit::si([2, 1, -2, -1, 0, 0, 0]), true),
    ("g", MASS.scaled(1e-3), true),
    ("min", TIME.scaled(60.0), false),
    ("h", TIME.scaled(3600.0), false),
    ("ft", LENGTH.scaled(0.3048), false),
    ("inch", LENGTH.scaled(0.0254), false),
    ("lb", MASS.scaled(0.453_592_37), false),
];

/// Those that mean a unit only beside others, or behind a prefix.
const AMBIGUOUS: [&str; 3] = ["g", "C", "min"];

const PREFIXES: [(&str, f64); 12] = [
    ("k", 1e3),
    ("M", 1e6),
    ("G", 1e9),
    ("T", 1e12),
    ("d", 1e-1),
    ("c", 1e-2),
    ("m", 1e-3),
    ("u", 1e-6),
    // The sign, and the letter that looks like it.
    ("\u{b5}", 1e-6),
    ("\u{3bc}", 1e-6),
    ("n", 1e-9),
    ("p", 1e-12),
];

/// How dimensions are called that have no text of the user's.
pub(super) const COMMON: [(&str, Unit); 12] = [
    ("N", FORCE),
    ("N m", ENERGY),
    ("W", POWER),
    ("Pa", PRESSURE),
    ("N/m", Unit::si([0, 1, -2, 0, 0, 0, 0])),
    ("N s/m", Unit::si([0, 1, -1, 0, 0, 0, 0])),
    ("N m s", Unit::si([2, 1, -1, 0, 0, 0, 0])),
    ("N s", Unit::si([1, 1, -1, 0, 0, 0, 0])),
    ("C", CHARGE),
    ("V", VOLTAGE),
    ("ohm", RESISTANCE),
    ("H", INDUCTANCE),
];

const LENGTH: Unit = Unit::si([1, 0, 0, 0, 0, 0, 0]);
const MASS: Unit = Unit::si([0, 1, 0, 0, 0, 0, 0]);
const TIME: Unit = Unit::si([0, 0, 1, 0, 0, 0, 0]);
const RATE: Unit = Unit::si([0, 0, -1, 0, 0, 0, 0]);
const FORCE: Unit = Unit::si([1, 1, -2, 0, 0, 0, 0]);
const ENERGY: Unit = Unit::si([2, 1, -2, 0, 0, 0, 0]);
const POWER: Unit = Unit::si([2, 1, -3, 0, 0, 0, 0]);
const PRESSURE: Unit = Unit::si([-1, 1, -2, 0, 0, 0, 0]);
const CHARGE: Unit = Unit::si([0, 0, 1, 1, 0, 0, 0]);
const VOLTAGE: Unit = Unit::si([2, 1, -3, -1, 0, 0, 0]);
const RESISTANCE: Unit = Unit::si([2, 1, -3, -2, 0, 0, 0]);
const INDUCTANCE: Unit = Unit::si([2, 1, -2, -2, 0, 0, 0]);
const TURN: Unit = Unit::ONE.scaled(std::f64::consts::TAU);
pub(super) const DEGREE: Unit = Unit::ONE.scaled(std::f64::consts::PI / 180.0);

/// The unit of one symbol; `alone`: nothing else stands in the brackets.
pub(super) fn unit(symbol: &str, alone: bool) -> Option<Unit> {
    let of = |name: &str| UNITS.iter().find(|(known, ..)| *known == name);
    if let Some((_, unit, _)) = of(symbol) {
        return (!(alone && AMBIGUOUS.contains(&symbol))).then_some(*unit);
    }
    PREFIXES.iter().find_map(|(prefix, scale)| {
        let (name, unit, _) = of(symbol.strip_prefix(prefix)?).filter(|(.., prefixed)| *prefixed)?;
        is_usual(prefix, name).then(|| unit.scaled(*scale))
    })
}

/// `dT` and `Ts` are names that people give, and no units that they measure in.
fn is_usual(prefix: &str, symbol: &str) -> bool {
    match prefix {
        "d" | "c" => symbol == "m",
        "M" | "G" | "T" => !["m", "s", "A", "K", "mol", "cd", "rad", "g", "T", "C", "As", "Ah"].contains(&symbol),
        _ => true,
    }
}
