//! Threads that stay awake between the parts of a step.
//!
//! A step hands work to the threads half a dozen times, with fractions of a millisecond in between.
//! A thread of rayon that finds nothing to do goes to sleep after some microseconds, and waking it
//! takes some 50 µs on a virtual machine. Measured at 80,000 particles: two threads that may sleep
//! are 1.57 times as fast as one, two that look for work until the steps are done 1.88 times. They
//! offer the processor to others whenever they find none, and pause when there is none for a while.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::Duration;

/// Does `work` on this thread of a pool, the others looking for parts of it until it is done.
pub(super) fn together<T>(work: impl FnOnce() -> T + Send) -> T
where
    T: Send,
{
    let Some(me) = rayon::current_thread_index() else {
        return work();
    };
    if rayon::current_num_threads() == 1 {
        return work();
    }
    let working = AtomicBool::new(true);
    rayon::scope(|scope| {
        scope.spawn_broadcast(|_, thread| {
            // This thread gets to its copy while it waits for others.
            let mut search = Search::default();
            while thread.index() != me && working.load(Ordering::Acquire) {
                search.go_on();
            }
        });
        // Also after a panic, which would otherwise be waited for.
        let _done = Finally(|| working.store(false, Ordering::Release));
        work()
    })
}

/// Calls `work` with every item, each on a thread of its own if there are enough.
pub(super) fn each<I: Send, O: Send>(
    items: impl ExactSizeIterator<Item = I>,
    work: impl Fn(I) -> O + Sync,
) -> Vec<O> {
    let mut items = items;
    let mut results: Vec<Option<O>> = Vec::new();
    results.resize_with(items.len(), || None);
    let Some((mine, others)) = results.split_first_mut() else {
        return Vec::new();
    };
    let first = items.next();
    let left = AtomicUsize::new(others.len());
    rayon::in_place_scope(|scope| {
        for (item, result) in items.zip(others) {
            let (work, left) = (&work, &left);
            scope.spawn(move |_| {
                let _done = Finally(|| left.fetch_sub(1, Ordering::Release));
                *result = Some(work(item));
            });
        }
        *mine = first.map(&work);
        // Waiting at the end of the scope would put this thread to sleep.
        let mut search = Search::default();
        while left.load(Ordering::Acquire) > 0 {
            search.go_on();
        }
    });
    results.into_iter().flatten().collect()
}

/// A search for work, with pauses that become longer when there is none: where more threads than
/// processors are at work, those that search must not keep the others from it.
#[derive(Default)]
struct Search {
    in_vain: u32,
}

impl Search {
    /// About as many as fit into the gaps of a step: each takes half a microsecond, and offers the
    /// processor to whoever waits for it.
    const QUICK: u32 = 1000;
    const PAUSE: Duration = Duration::from_micros(20);

    fn go_on(&mut self) {
        if rayon::yield_now() == Some(rayon::Yield::Executed) {
            self.in_vain = 0;
        } else if self.in_vain < Self::QUICK {
            self.in_vain += 1;
            std::thread::yield_now();
        } else {
            std::thread::sleep(Self::PAUSE);
        }
    }
}

/// Calls a function when it is dropped.
struct Finally<R, F: Fn() -> R>(F);

impl<R, F: Fn() -> R> Drop for Finally<R, F> {
    fn drop(&mut self) {
        self.0();
    }
}
