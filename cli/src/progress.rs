//! A word on stderr about what takes longer than a second.

use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::{Duration, Instant};

const PATIENCE: Duration = Duration::from_secs(1);

/// Does the work, and says what it is if it takes long.
pub(crate) fn during<T>(what: &str, work: impl FnOnce() -> T) -> T {
    let (done, waits) = channel::<()>();
    let begin = Instant::now();
    thread::scope(|scope| {
        let watch = scope.spawn(move || {
            let late = waits.recv_timeout(PATIENCE) == Err(RecvTimeoutError::Timeout);
            if late {
                eprintln!("{what} ..");
            }
            late
        });
        let result = work();
        drop(done);
        if watch.join().is_ok_and(|late| late) {
            eprintln!("{what}: {:.1} s", begin.elapsed().as_secs_f64());
        }
        result
    })
}
