//! Work on several threads. Results never depend on the number of threads; if no other thread starts, the caller's does all the
//! work.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, OnceLock, PoisonError};

/// Number of faces below which a second thread costs more than it gains.
const FACES_WORTH_A_THREAD: usize = 100_000;

/// Returns the number of threads the machine runs at once.
pub fn cores() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

/// Returns the number of threads worth starting for this many faces.
pub(crate) fn threads_for(faces: usize) -> usize {
    cores().min(faces / FACES_WORTH_A_THREAD).max(1)
}

/// Returns the number of threads worth starting for this many simple items, such as points.
pub(crate) fn threads_for_items(count: usize) -> usize {
    const ITEMS_WORTH_A_THREAD: usize = 20_000;
    cores().min(count / ITEMS_WORTH_A_THREAD).max(1)
}

/// Cuts `0..count` into at most `pieces` ranges of about equal length.
pub(crate) fn ranges(count: usize, pieces: usize) -> Vec<std::ops::Range<usize>> {
    let length = count.div_ceil(pieces.max(1)).max(1);
    (0..count).step_by(length).map(|start| start..(start + length).min(count)).collect()
}

/// Fills a list with `value` of each index; each thread writes its own piece in place.
///
/// `blank` is the value of zeroed memory: the system then provides the list's pages at the first write.
pub(crate) fn filled<T: Copy + Send>(
    count: usize,
    threads: usize,
    blank: T,
    value: impl Fn(usize) -> T + Sync,
) -> Vec<T> {
    let mut list = vec![blank; count];
    each_piece(&mut list, threads, threads, |start, places| {
        places.iter_mut().enumerate().for_each(|(index, place)| *place = value(start + index));
    });
    list
}

/// Sorts a list of distinct elements, one piece per thread.
pub(crate) fn sort_by<T: Send>(list: &mut [T], threads: usize, order: impl Fn(&T, &T) -> std::cmp::Ordering + Sync) {
    each_piece(list, threads, threads, |_, piece| piece.sort_unstable_by(&order));
    if threads > 1 {
        // The stable sort finds ordered runs and merges them.
        list.sort_by(order);
    }
}

/// Does `work` for so many pieces of a list; `work` also gets each piece's place in the list.
pub(crate) fn each_piece<T: Send>(
    list: &mut [T],
    threads: usize,
    pieces: usize,
    work: impl Fn(usize, &mut [T]) + Sync,
) {
    let length = list.len().div_ceil(pieces.max(1)).max(1);
    let pieces = Mutex::new(list.chunks_mut(length).enumerate());
    // Every thread takes pieces until none is left, this one too: if no other starts, it does them all.
    let take = || {
        let next = || pieces.lock().unwrap_or_else(PoisonError::into_inner).next();
        while let Some((piece, places)) = next() {
            work(piece * length, places);
        }
    };
    on_threads(threads, take);
}

/// Does the same work on so many threads, this one included.
fn on_threads(threads: usize, work: impl Fn() + Copy + Send) {
    std::thread::scope(|scope| {
        let others: Vec<_> =
            (1..threads).map_while(|_| std::thread::Builder::new().spawn_scoped(scope, work).ok()).collect();
        work();
        for other in others {
            other.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic));
        }
    });
}

/// Does `work` for each piece of `0..count`, one thread per piece, and returns the results in order.
pub(crate) fn in_parallel<T: Send>(
    count: usize,
    threads: usize,
    work: impl Fn(std::ops::Range<usize>) -> T + Sync,
) -> Vec<T> {
    let mut pieces = ranges(count, threads);
    let Some(last) = pieces.pop() else { return Vec::new() };
    let work = &work;
    std::thread::scope(|scope| {
        let others: Vec<_> = pieces
            .into_iter()
            .map(|piece| {
                let started = std::thread::Builder::new().spawn_scoped(scope, {
                    let piece = piece.clone();
                    move || work(piece)
                });
                // If no thread starts, this one does it all.
                started.map_err(|_| piece)
            })
            .collect();
        let last = work(last);
        let join = |started: Result<std::thread::ScopedJoinHandle<'_, T>, _>| match started {
            Ok(thread) => thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)),
            Err(piece) => work(piece),
        };
        others.into_iter().map(join).chain([last]).collect()
    })
}

/// Concatenates the results of `work` for each piece of `0..count`, `each` items per index; `None` if any piece returns `None`.
///
/// Each thread writes a separate list, so the system provides their pages in parallel; the first has room for all.
pub(crate) fn listed<T: Send>(
    count: usize,
    each: usize,
    threads: usize,
    work: impl Fn(std::ops::Range<usize>, &mut Vec<T>) -> Option<()> + Sync,
) -> Option<Vec<T>> {
    let lists = in_parallel(count, threads, |range| {
        let room = if range.start == 0 { count } else { range.len() };
        let mut list = Vec::new();
        list.reserve_exact(room * each);
        work(range, &mut list).map(|()| list)
    });
    let mut lists = lists.into_iter();
    let mut all = lists.next().unwrap_or_else(|| Some(Vec::new()))?;
    for list in lists {
        all.append(&mut list?);
    }
    Some(all)
}

/// Does `work` for pieces of `length` of `0..count` and returns the results in order. Each thread takes the next piece when it
/// finishes one, which suits pieces of very different cost.
pub(crate) fn in_chunks<T: Send + Sync>(
    count: usize,
    length: usize,
    threads: usize,
    work: impl Fn(std::ops::Range<usize>) -> T + Sync,
) -> Vec<T> {
    in_strides(count, length, threads, |_| 1, work)
}

/// Like [`in_chunks`], but takes pieces from all over the range, so the finished part always represents the rest.
pub(crate) fn spread_chunks<T: Send + Sync>(
    count: usize,
    length: usize,
    threads: usize,
    work: impl Fn(std::ops::Range<usize>) -> T + Sync,
) -> Vec<T> {
    in_strides(count, length, threads, stride, work)
}

/// Returns a step that visits every place once, near their golden section, so neighbours are visited far apart.
fn stride(count: usize) -> usize {
    let divisor = |mut a: usize, mut b: usize| {
        while b > 0 {
            (a, b) = (b, a % b);
        }
        a
    };
    let first = (count as f64 * 0.618) as usize;
    (first.max(1)..).find(|step| divisor(*step, count) <= 1).unwrap_or(1)
}

fn in_strides<T: Send + Sync>(
    count: usize,
    length: usize,
    threads: usize,
    stride: impl Fn(usize) -> usize,
    work: impl Fn(std::ops::Range<usize>) -> T + Sync,
) -> Vec<T> {
    let pieces = ranges(count, count.div_ceil(length.max(1)));
    let stride = stride(pieces.len());
    let next = AtomicUsize::new(0);
    let results: Vec<OnceLock<T>> = pieces.iter().map(|_| OnceLock::new()).collect();
    let take = || {
        loop {
            let turn = next.fetch_add(1, Ordering::Relaxed);
            if turn >= pieces.len() {
                return;
            }
            let index = (turn as u128 * stride as u128 % pieces.len() as u128) as usize;
            let piece = &pieces[index];
            // Each index is taken once, so the place was empty.
            let _ = results[index].set(work(piece.clone()));
        }
    };
    on_threads(threads.min(pieces.len()), take);
    results.into_iter().filter_map(OnceLock::into_inner).collect()
}

/// Runs two functions at once, the second on another thread.
pub fn both<A, B: Send>(first: impl FnOnce() -> A, second: impl Fn() -> B + Sync) -> (A, B) {
    std::thread::scope(|scope| match std::thread::Builder::new().spawn_scoped(scope, &second) {
        Ok(thread) => {
            let first = first();
            (first, thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)))
        }
        Err(_) => (first(), second()),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_list_is_the_same_however_many_threads_make_it_and_none_where_one_of_them_gives_up() {
        for threads in [1, 2, 3, 7] {
            let twice = listed(10, 2, threads, |range, list| {
                list.extend(range.flat_map(|number| [number, number]));
                Some(())
            });
            assert_eq!(twice.unwrap(), [0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5, 6, 6, 7, 7, 8, 8, 9, 9]);
            let given_up = listed(10, 1, threads, |range, list| {
                list.push(1);
                (!range.contains(&9)).then_some(())
            });
            assert_eq!(given_up, None);
        }
        assert_eq!(listed(0, 1, 2, |_, _: &mut Vec<u8>| None), Some(Vec::new()));
    }

    #[test]
    fn spread_chunks_are_all_taken_once_and_returned_in_order() {
        for count in [0, 1, 2, 7, 64, 100, 1000] {
            let taken = AtomicUsize::new(0);
            let chunks = spread_chunks(count, 3, 2, |range| {
                taken.fetch_add(range.len(), Ordering::Relaxed);
                range
            });
            assert_eq!(taken.into_inner(), count);
            assert_eq!(chunks.into_iter().flatten().collect::<Vec<usize>>(), (0..count).collect::<Vec<usize>>());
        }
    }

    #[test]
    fn what_is_taken_first_is_from_all_over_the_whole() {
        let order = Mutex::new(Vec::new());
        spread_chunks(1000, 1, 1, |range| order.lock().unwrap().push(range.start));
        let order = order.into_inner().unwrap();
        // The first tenth of the turns reaches every tenth of the range.
        for tenth in 0..10 {
            let count = order[..100].iter().filter(|place| **place / 100 == tenth).count();
            assert!((5..=20).contains(&count), "{count} in tenth {tenth}");
        }
    }
}
