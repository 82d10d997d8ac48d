//! Contexts take turns.

use super::context_lock::{ContextLock, OF_EGL, OF_OSMESA};
use super::{Backend, Context};
use std::sync::mpsc::channel;
use std::sync::{Mutex, PoisonError};

/// These tests ask whether any context is at work, so they are not at work at once themselves.
static ALONE: Mutex<()> = Mutex::new(());

fn open(backend: Backend) -> Context {
    Context::open(backend, None).unwrap_or_else(|error| panic!("{backend:?}: {error}"))
}

/// While one context is current, another of the same screen waits on its thread; when the first has ended, it goes on.
fn take_turns(backend: Backend, lock: &'static ContextLock) {
    let _alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
    let first = open(backend);
    if !first.info().is_software() {
        eprintln!("SKIPPED: {} is hardware, whose contexts need not take turns", first.info().renderer);
        return;
    }
    let (opened, is_opened) = channel();
    let (entered, is_entered) = channel();
    let (ask, asked) = channel();
    std::thread::scope(|scope| {
        scope.spawn(move || {
            let second = open(backend);
            opened.send(()).unwrap();
            asked.recv().unwrap();
            let current = second.enter().unwrap();
            entered.send(()).unwrap();
            drop(current);
        });
        is_opened.recv().unwrap();
        let current = first.enter().unwrap();
        ask.send(()).unwrap();
        assert!(lock.is_locked());
        // It may not have come as far as asking yet; if it could enter it would, sooner or later, before this has ended.
        for _ in 0..1000 {
            std::thread::yield_now();
            assert!(is_entered.try_recv().is_err(), "two contexts are at work at once");
        }
        drop(current);
        is_entered.recv().unwrap();
    });
}

#[test]
fn software_contexts_of_egl_take_turns() {
    take_turns(Backend::Egl, &OF_EGL);
}

#[test]
fn contexts_of_osmesa_take_turns() {
    take_turns(Backend::OsMesa, &OF_OSMESA);
}

#[test]
fn a_context_of_egl_and_one_of_osmesa_are_at_work_together() {
    let _alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
    let egl = open(Backend::Egl);
    let current = egl.enter().unwrap();
    // Ends only if it need not wait for the other.
    std::thread::scope(|scope| scope.spawn(|| drop(open(Backend::OsMesa).enter().unwrap())).join().unwrap());
    drop(current);
}
