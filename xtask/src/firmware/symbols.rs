//! What a binary takes, whether it allocates, and whether it computes in f64 without a unit for it: read from `nm` and
//! `size`.

use std::collections::HashSet;

/// A symbol of `nm -S`: where it is, how many bytes it has, of what kind it is.
struct Symbol<'a> {
    address: &'a str,
    bytes: u64,
    kind: char,
    line: &'a str,
}

impl Symbol<'_> {
    fn parse(line: &str) -> Option<Symbol<'_>> {
        let mut fields = line.split_whitespace();
        let (address, size, kind) = (fields.next()?, fields.next()?, fields.next()?);
        let mut letters = kind.chars();
        let (Some(kind), None) = (letters.next(), letters.next()) else { return None };
        Some(Symbol { address, bytes: u64::from_str_radix(size, 16).ok()?, kind, line })
    }

    /// The library, its models, and what calls them.
    fn is_of_models(&self) -> bool {
        let ours = ["multibody::", "libm::", "firmware::models::"];
        let starts = |name: &&str| self.line.contains(&format!(" {name}")) || self.line.contains(&format!(" <{name}"));
        let called = self.line.contains("as firmware::scenes::Scene>::call");
        "tTrR".contains(self.kind) && (ours.iter().any(starts) || called) && !self.line.contains("firmware::report")
    }

    /// What the compiler adds: arithmetic that the processor does not have, and moving of memory.
    fn is_of_helpers(&self) -> bool {
        let line = self.line;
        let in_angles = line.split_once(" <").is_some_and(|(_, rest)| rest.contains("compiler_builtins"));
        let named = in_angles || line.contains(" compiler_builtins::") || line.contains(" __aeabi_");
        let last = line.rsplit(' ').next().unwrap_or_default();
        "tTwW".contains(self.kind) && (named || is_helper(last))
    }
}

/// `memcpy` and the like, or an operation with its types: `__muldf3`, `__floatunsisf`.
fn is_helper(name: &str) -> bool {
    if ["memcpy", "memmove", "memset"].contains(&name) {
        return true;
    }
    let Some(name) = name.strip_prefix("__") else { return false };
    let Some(name) = name.strip_suffix(['2', '3']).unwrap_or(name).strip_suffix(['f', 'i']) else { return false };
    let Some(name) = name.strip_suffix(['d', 's', 't']) else { return false };
    !name.is_empty() && name.bytes().all(|letter| letter.is_ascii_lowercase())
}

/// `[byte]` of model and method, and of the compiler's helpers; what lies in one place counts once. From `nm -CS`.
pub(crate) fn flash(symbols: &str) -> (u64, u64) {
    let (mut ours, mut helpers) = (0, 0);
    let mut seen = HashSet::new();
    for symbol in symbols.lines().filter_map(Symbol::parse) {
        if symbol.is_of_models() && seen.insert(symbol.address) {
            ours += symbol.bytes;
        }
        if symbol.is_of_helpers() && seen.insert(symbol.address) {
            helpers += symbol.bytes;
        }
    }
    (ours, helpers)
}

/// Functions that take or give back memory; a path may stand before the name. From `nm -C`.
pub(crate) fn allocators(symbols: &str) -> usize {
    let allocates = |line: &&str| {
        let name = line.rsplit([' ', ':']).next().unwrap_or_default();
        let rest = |prefix: &str| name.strip_prefix(prefix);
        let of = |prefix: &str| {
            rest(prefix)
                .is_some_and(|rest| !rest.is_empty() && rest.bytes().all(|b| b == b'_' || b.is_ascii_lowercase()))
        };
        let alone = ["malloc", "calloc", "realloc", "free"].contains(&name) && name.len() < line.len();
        let rusts = ["alloc", "alloc_zeroed", "realloc", "dealloc"];
        alone || rest("__rust_").is_some_and(|rest| rusts.contains(&rest)) || of("__rg_") || of("__rdl_")
    };
    symbols.lines().filter(allocates).count()
}

/// Operations of double precision in software. From `nm`.
pub(crate) fn software_doubles(symbols: &str) -> usize {
    let by_abi = |line: &str| {
        line.split(" __aeabi_").skip(1).any(|rest| {
            let letters = rest.len() - rest.trim_start_matches(|c: char| c.is_ascii_lowercase()).len();
            let converts = letters > 0 && rest[letters..].starts_with("2d");
            rest.starts_with('d') || rest.starts_with("cd") || converts
        })
    };
    let operations = ["__add", "__sub", "__mul", "__div", "__extendsf", "__truncdf"];
    let by_name =
        |line: &str| operations.iter().any(|o| line.contains(&format!("{o}df")) || line.contains(&format!("{o}sf")));
    symbols.lines().filter(|line| by_abi(line) || by_name(line)).count()
}

/// `[byte]` of code and constants. From `size`.
pub(crate) fn flash_bytes(sizes: &str) -> Option<u64> {
    let mut fields = sizes.lines().nth(1)?.split_whitespace();
    Some(fields.next()?.parse::<u64>().ok()? + fields.next()?.parse::<u64>().ok()?)
}

/// `[byte]` of variables. From `size -A`.
pub(crate) fn ram_bytes(sections: &str) -> u64 {
    let variables = sections.lines().filter_map(|line| {
        let mut fields = line.split_whitespace();
        let name = fields.next()?;
        if name == ".data" || name == ".bss" { fields.next()?.parse::<u64>().ok() } else { None }
    });
    variables.sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_of_models_and_helpers() {
        let symbols = "\
00000400 00000010 T multibody::integrators::step
00000400 00000010 t libm::math::sinf
00000500 00000100 t <multibody::Rk4 as multibody::Method>::step
00000600 00000020 t <firmware::scenes::Panda as firmware::scenes::Scene>::call
00000700 00000040 T firmware::report::<multibody::Rk4>
00000800 0000000a T __muldf3
00000800 0000000a T __aeabi_dmul
00000900 00000004 t memcpy
00000a00 00000002 t <T as compiler_builtins::Int>::shift
00000b00 00000800 B firmware::STACK
00000c00 00000800 T main
         U memcpy
";
        assert_eq!(flash(symbols), (0x10 + 0x100 + 0x20, 10 + 4 + 2));
    }

    #[test]
    fn helpers_by_name() {
        for name in ["__mulsf3", "__floatsidf", "__fixdfsi", "__lshrdi3", "__extendsfdf2", "memset"] {
            assert!(is_helper(name), "{name}");
        }
        for name in ["main", "__start", "__df", "__DFdf", "memcmp", "multibody::memcpy"] {
            assert!(!is_helper(name), "{name}");
        }
    }

    #[test]
    fn allocators_are_found() {
        let symbols = "0400 T __rust_alloc\n0500 T malloc\n0600 t alloc::alloc::__rust_dealloc\n0700 t my::free\n\
                       0800 T __rg_oom\n0900 T __rdl_alloc\n         U calloc\n";
        assert_eq!(allocators(symbols), 7);
        assert_eq!(allocators("0400 T __rust_alloc_error\n0500 t freely\n0600 T mallocs\n0700 T my_free\n"), 0);
    }

    #[test]
    fn doubles_in_software_are_found() {
        let symbols = "0400 T __aeabi_dadd\n0404 T __aeabi_cdcmple\n0408 T __aeabi_f2d\n040c T __aeabi_ui2d\n0410 T __adddf3\n\
                       0414 T __truncdfsf2\n0418 T __extendsfdf2\n";
        assert_eq!(software_doubles(symbols), 7);
        assert_eq!(software_doubles("0400 T __aeabi_fadd\n0404 T __aeabi_memcpy\n0408 T __aeabi_f2iz\n"), 0);
    }

    #[test]
    fn sizes_of_sections() {
        assert_eq!(flash_bytes("   text\t   data\t    bss\n  11000\t    756\t      8\tfile\n"), Some(11756));
        assert_eq!(flash_bytes("   text\n"), None);
        assert_eq!(ram_bytes("section size addr\n.text 100 0\n.data 12 5\n.bss 30 6\n.debug_data 8 9\n"), 42);
    }
}
