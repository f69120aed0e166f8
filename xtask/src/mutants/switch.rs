//! Appended to a mutated crate as its module `mutant`: which mutant runs, and which sites a test reaches.

use std::cell::RefCell;
use std::io::Write as _;
use std::sync::OnceLock;

/// `None`: the program as it was written.
struct Choice {
    active: Option<u32>,
    /// Where the sites that tests reach are written.
    reached: Option<String>,
}

static CHOICE: OnceLock<Choice> = OnceLock::new();

thread_local! {
    static REACHED: RefCell<Reached> = const { RefCell::new(Reached(Vec::new())) };
}

/// Sites that this thread has reached; a test has a thread of its own, with its name.
struct Reached(Vec<bool>);

impl Drop for Reached {
    fn drop(&mut self) {
        let Some(path) = CHOICE.get().and_then(|choice| choice.reached.as_ref()) else { return };
        let thread = std::thread::current();
        let name = thread.name().unwrap_or("?");
        let sites = (0..self.0.len()).filter(|&site| self.0[site]);
        let lines: String = sites.map(|site| format!("{name} {site}\n")).collect();
        let file = std::fs::OpenOptions::new().create(true).append(true).open(path);
        file.and_then(|mut file| file.write_all(lines.as_bytes())).expect("reached sites can be written");
    }
}

pub(crate) fn is(site: u32) -> bool {
    let choice = CHOICE.get_or_init(|| Choice {
        active: std::env::var("MUTANT").ok().and_then(|text| text.parse().ok()),
        reached: std::env::var("MUTANTS_REACHED").ok(),
    });
    if choice.reached.is_some() {
        // After the end of the thread's own values nothing is recorded.
        let _ = REACHED.try_with(|reached| {
            let sites = &mut reached.borrow_mut().0;
            let site = site as usize;
            sites.resize(sites.len().max(site + 1), false);
            sites[site] = true;
        });
    }
    choice.active == Some(site)
}
