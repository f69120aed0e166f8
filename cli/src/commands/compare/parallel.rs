//! Tasks on all processors.

use std::num::NonZero;
use std::sync::Mutex;
use std::thread;

/// As much as the main thread has.
const STACK: usize = 8 << 20;

/// Results in the order of the tasks. Each thread takes the next one that is left.
pub(super) fn map<Task: Sync, Answer: Send>(tasks: &[Task], work: impl Fn(&Task) -> Answer + Sync) -> Vec<Answer> {
    let threads = thread::available_parallelism().map_or(1, NonZero::get).min(tasks.len());
    let left = Mutex::new(tasks.iter().enumerate());
    let next = || left.lock().ok()?.next();
    let mut done: Vec<(usize, Answer)> = thread::scope(|scope| {
        let run = || std::iter::from_fn(next).map(|(number, task)| (number, work(task))).collect::<Vec<_>>();
        let threads: Vec<_> = (0..threads)
            .filter_map(|_| thread::Builder::new().stack_size(STACK).spawn_scoped(scope, run).ok())
            .collect();
        let here = if threads.is_empty() { run() } else { Vec::new() };
        threads.into_iter().flat_map(|thread| thread.join().expect("work catches its panics")).chain(here).collect()
    });
    done.sort_by_key(|(number, _)| *number);
    done.into_iter().map(|(_, answer)| answer).collect()
}

#[cfg(test)]
mod tests {
    use super::map;

    #[test]
    fn answers_stand_in_the_order_of_tasks() {
        let tasks: Vec<u32> = (0..100).collect();
        assert_eq!(map(&tasks, |n| n * n), tasks.iter().map(|n| n * n).collect::<Vec<_>>());
        assert!(map(&Vec::<u32>::new(), |n| *n).is_empty());
    }
}
