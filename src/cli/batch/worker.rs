//! Child side of a worker process: jobs from standard input, one after another, in one session.

use super::super::signals;
use super::super::{Program, Task, Verdict, make_folder, messages, models};
use super::JobOptions;
use std::io::{BufRead, Write};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::Receiver;
use tinta::batch::{Job, JobCommand, Outcome, place_in};
use tinta::choice::Choice;
use tinta::request::Session;
use tinta::{Error, Renderer, Result};

/// Does jobs until standard input ends.
pub(super) fn serve(folder: &Path, program: &Program) -> Result<()> {
    signals::leave_to_the_run();
    let gone =
        |error: std::io::Error| Error::output("-", format!("the parent process has ended ({error})")).because(&error);
    let is_busy = Arc::new(AtomicBool::new(false));
    let lines = lines(&is_busy).map_err(gone)?;
    let mut session = models::session_for_many(Renderer::new);
    for line in lines {
        let outcome = match Job::parse(&line) {
            Ok(job) => carry_out(&job, folder, program, &mut session),
            Err(problem) => Outcome::failed("command-line", problem),
        };
        let mut out = std::io::stdout().lock();
        let text = serde_json::to_string(&outcome).map_err(|error| gone(error.into()))?;
        is_busy.store(false, Ordering::SeqCst);
        out.write_all(format!("{text}\n").as_bytes()).and_then(|()| out.flush()).map_err(gone)?;
    }
    Ok(())
}

/// The lines of standard input, read on a separate thread: a run that ends during a job takes its worker with it.
fn lines(is_busy: &Arc<AtomicBool>) -> std::io::Result<Receiver<Vec<u8>>> {
    let (sender, receiver) = std::sync::mpsc::channel();
    let is_busy = is_busy.clone();
    let read = move || {
        for line in std::io::stdin().lock().split(b'\n') {
            let Ok(line) = line else { break };
            is_busy.store(true, Ordering::SeqCst);
            if sender.send(line).is_err() {
                return;
            }
        }
        if is_busy.load(Ordering::SeqCst) {
            signals::end_at_once();
        }
    };
    std::thread::Builder::new().spawn(read).map(|_| receiver)
}

/// Does a job; a second time in new contexts where the first one's was lost.
pub(super) fn carry_out(job: &Job, folder: &Path, program: &Program, session: &mut Session) -> Outcome {
    let mut tries = 0;
    let (result, captured) = loop {
        tries += 1;
        messages::capture();
        let result = once(job, folder, program, session);
        let captured = messages::captured();
        match result {
            Err(Error::ContextLost { .. }) if tries == 1 => session.close(),
            result => break (result, captured),
        }
    };
    // Named from the batch's folder, which is another one on another machine.
    let prefix = format!("{}{}", folder.display().to_string().trim_end_matches('/'), std::path::MAIN_SEPARATOR);
    let short = |sentence: String| without(&prefix, &messages::plain(&sentence));
    let mut outcome = match &result {
        Ok(Verdict::Good) => Outcome::default(),
        Ok(Verdict::Different | Verdict::Stopped { .. }) => {
            Outcome::failed("check", "a check found a difference; its remarks say which")
        }
        Err(error) => Outcome::failed(error.kind(), short(error.to_string())),
    };
    if matches!(result, Err(Error::ContextLost { .. })) {
        session.close();
    }
    outcome.remarks = captured.said.into_iter().map(short).collect();
    outcome.printed = Some(captured.printed).filter(|printed| !printed.is_empty());
    outcome.tries = tries;
    outcome
}

/// A sentence with its paths below a folder named from there.
pub(super) fn without(prefix: &str, sentence: &str) -> String {
    // Within a path such as `../a.obj` the folder `./` is none.
    let sentence = format!(" {sentence}").replace(&format!(" {prefix}"), " ");
    sentence[1..].to_owned()
}

/// Does a job by its command.
fn once(job: &Job, folder: &Path, program: &Program, session: &mut Session) -> Result<Verdict> {
    let options = JobOptions::of(job, folder)?;
    let task = task(job.command, &options, program)?;
    make_folders(job, folder)?;
    task(session)
}

/// The job as a task of its command.
fn task(command: JobCommand, options: &JobOptions, program: &Program) -> Result<Task> {
    match program.named(command.choice_name()).and_then(|command| command.job) {
        Some(job) => job(options),
        None => Err(Error::value("command", command.choice_name(), "this program was built without it; leave it out")),
    }
}

/// Makes the folders that outputs lie in.
fn make_folders(job: &Job, folder: &Path) -> Result<()> {
    for (_, output) in job.outputs() {
        if let Ok(place) = place_in(folder, output) {
            make_folder(place.parent().unwrap_or(folder))?;
        }
    }
    Ok(())
}
