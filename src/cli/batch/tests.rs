//! A worker's jobs in this process, with contexts that fail on purpose.

use super::super::Program;
use super::super::models::session_for_many;
use super::worker::{carry_out, without};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use tinta::batch::{Job, Outcome};
use tinta::gl::Fault;
use tinta::{Backend, Renderer, Result};

/// Messages are captured for the whole process: one test at a time.
static ALONE: Mutex<()> = Mutex::new(());

fn job(id: usize) -> Job {
    let line = format!(
        r#"{{"id":{id},"command":"render","model":"builtin:open-box","output":"{id}.png","size":32,"style":"{}"}}"#,
        ["three-pass", "ink", "inking"][id % 3]
    );
    Job::parse(line.as_bytes()).unwrap()
}

/// Does jobs in a session; their outcomes, their pictures, and how many GL objects there are.
fn outcomes(open: fn(Backend) -> Result<Renderer>, jobs: usize) -> (Vec<Outcome>, Vec<Vec<u8>>, usize) {
    let _alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
    let folder = tempfile::tempdir().unwrap();
    let mut session = session_for_many(open);
    let outcomes: Vec<Outcome> =
        (0..jobs).map(|id| carry_out(&job(id), folder.path(), &Program::default(), &mut session)).collect();
    let picture = |id: usize| std::fs::read(folder.path().join(format!("{id}.png"))).ok();
    let pictures = (0..jobs).filter_map(picture).collect();
    (outcomes, pictures, session.live_objects())
}

#[test]
fn paths_below_the_folder_are_named_from_there_and_no_others() {
    assert_eq!(without("/x y/out/", "/x y/out/a.png: not /x y/outer/b"), "a.png: not /x y/outer/b");
    assert_eq!(without("./", "./a.png: ../models/a.obj is missing"), "a.png: ../models/a.obj is missing");
}

#[test]
fn a_lost_context_is_made_anew_and_its_job_done_again() {
    static OPENED: AtomicUsize = AtomicUsize::new(0);
    fn open(backend: Backend) -> Result<Renderer> {
        match OPENED.fetch_add(1, Ordering::Relaxed) {
            0 => Renderer::with_fault(backend, Fault::ContextLost { after: 60 }),
            1 => Renderer::with_fault(backend, Fault::ContextReset { after: 60 }),
            _ => Renderer::new(backend),
        }
    }
    let (_, sound, _) = outcomes(Renderer::new, 24);
    let (faulty, pictures, _) = outcomes(open, 24);
    assert!(faulty.iter().all(|outcome| outcome.error.is_none()), "{faulty:?}");
    let again: Vec<usize> = (0..24).filter(|job| faulty[*job].tries == 2).collect();
    assert!(again.len() == 2 && again[0] > 0, "the contexts were lost in jobs {again:?}");
    assert_eq!(OPENED.load(Ordering::Relaxed), 3);
    assert!(sound.len() == 24 && pictures == sound);
}

#[test]
fn a_context_that_is_lost_every_time_fails_the_job_with_the_reason() {
    let (outcomes, ..) = outcomes(|backend| Renderer::with_fault(backend, Fault::ContextLost { after: 0 }), 2);
    for outcome in outcomes {
        assert_eq!(outcome.tries, 2);
        let error = outcome.error.unwrap();
        assert!(error.kind == "context-lost" && error.problem.contains("was lost"), "{error:?}");
    }
}

#[test]
fn hundreds_of_jobs_share_the_objects_of_one_context() {
    static OPENED: AtomicUsize = AtomicUsize::new(0);
    fn open(backend: Backend) -> Result<Renderer> {
        OPENED.fetch_add(1, Ordering::Relaxed);
        Renderer::new(backend)
    }
    let (_, few, after_few) = outcomes(open, 6);
    let (_, many, after_many) = outcomes(open, 300);
    assert_eq!(OPENED.load(Ordering::Relaxed), 2, "one context for each session");
    assert!(after_few > 0 && after_few == after_many, "{after_few} and {after_many} GL objects");
    assert_eq!((few.len(), many.len()), (6, 300));
    assert!(few.iter().zip(&many).all(|(one, other)| one == other));
}
