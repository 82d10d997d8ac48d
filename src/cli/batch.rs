//! `tinta batch`: draws each model of a folder, or runs a list of jobs, or a slice of it, on all cores.
//!
//! Workers do the jobs: processes of this program that take one job after another and keep their context, programs and models. A
//! job that crashes the driver ends one worker and no other job. A finished job is not done again: a picture has its models and
//! options in its recipe, and the journal records every other result at once.

mod folder;
pub(super) mod job_options;
#[cfg(test)]
mod tests;
mod names;
mod worker;
mod worker_process;

use super::bare::is_model;
use super::options::{GivenOptions, OfRequest};
use super::progress::Progress;
use super::signals::Stop;
use super::standard_input;
use super::{Command, given};
use super::{Program, Verdict, plain, print, say};
use folder::Drawing;
pub use job_options::JobOptions;
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use tinta::batch::{Entry, Failure, Job, Journal, List, Outcome, Slice, are_there, entries, read_list};
use tinta::choice::Choice;
use tinta::limits::REMARKS;
use tinta::{Error, Result};
use worker_process::{CRASH, WorkerProcess};

/// The command.
pub(super) const COMMAND: Command = Command {
    examples: &[
        "tinta batch *.stl -o pics --look technical      draw each into its own file",
        "tinta batch jobs.jsonl -o pics                  run many jobs from a list",
    ],
    ..Command::new("batch", arguments, |matches, call| run(&given::<Arguments>(matches)?, call.program))
};

/// The options. The short help lists those of a batch and the most usual ones of drawings.
fn arguments(command: clap::Command) -> clap::Command {
    let is_rare = |name: &str| GivenOptions::<OfRequest>::has(name) && !["style", "size", "view"].contains(&name);
    <Arguments as clap::Args>::augment_args(command).mut_args(|arg| match is_rare(arg.get_id().as_str()) {
        true => arg.hide_short_help(true),
        false => arg,
    })
}

/// Draw each model into its own file, or run a list of jobs, on all cores; given again, do the unfinished ones
#[derive(clap::Args)]
#[command(after_help = "\
A job of a list: {\"model\": \"cow.obj\", \"output\": \"cow.png\", \"view\": \"90,15\"}
Its model is a text, or several in brackets. Its command is render, compare or measure [default: render]. Every other key is the \
long name of an option of that command. See docs/guide/batches.md.

Exit codes:
  0    all jobs done
  1    a job failed
  2    not done; one sentence on standard error says why
  75   another run is working on the same slice
  130  stopped by Ctrl-C with jobs left
  143  stopped by SIGTERM with jobs left")]
pub(super) struct Arguments {
    /// Models, folders of models, or one list of jobs, a line of JSON each; - for a list on standard input
    #[arg(value_name = "MODEL|LIST", required_unless_present = "worker")]
    models: Vec<String>,

    /// Folder to write into; models also take the names of their files: 'pics/{name}.svg' [default for models: DIR/{name}.png]
    #[arg(short, long, value_name = "DIR")]
    output: String,

    /// Run only every N-th job, starting with the K-th, to share a list among N machines [default: 1/1]
    #[arg(long, value_name = "K/N", default_value = "1/1", hide_default_value = true)]
    slice: Slice,

    /// Jobs to run at once, each in its own process [default: one per processor]
    #[arg(long, value_name = "J", value_parser = clap::value_parser!(u32).range(1..=1024))]
    jobs: Option<u32>,

    /// Run nothing: count the jobs of all slices that are done, failed and missing [default: off]
    #[arg(long)]
    summary: bool,

    /// A batch always resumes.
    #[arg(long, hide = true)]
    resume: bool,

    /// Read jobs from standard input; tinta batch starts such workers
    #[arg(long, hide = true, conflicts_with = "models")]
    worker: bool,

    #[command(flatten)]
    drawing: Drawing,
}

/// Runs the jobs that are not done, or counts them; exit code 1 if a job failed or is missing, 128 plus the signal's number if a
/// signal ended it early.
pub(super) fn run(arguments: &Arguments, program: &Program) -> Result<Verdict> {
    if arguments.worker {
        return worker::serve(Path::new(&arguments.output), program).map(|()| Verdict::Good);
    }
    let (list, folder) = list(arguments, program)?;
    if arguments.summary {
        return sum_up(&list, &folder, program);
    }
    super::make_folder(&folder)?;
    let journal = Journal::open(&folder, arguments.slice)?;
    let (mut jobs, known) = (0, entries(&folder, arguments.slice)?);
    let left = list.jobs(arguments.slice).inspect(|_| jobs += 1).filter(|job| !is_done(job, &folder, &known, program));
    let left: Vec<Job> = left.collect();
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let workers = arguments.jobs.map_or(cores, |jobs| jobs as usize).min(left.len());
    let stop = Stop::on_signals();
    let Running { done, failed, remarked, .. } = carry_out(&left, &folder, journal, workers, cores, (&stop, program))?;
    let before = jobs - left.len();
    let before = if before > 0 { format!(", {before} were done before") } else { String::new() };
    say(&format!("tinta: {done} of {jobs} jobs done{before}, {failed} failed"));
    if remarked > 0 {
        let journal = folder.join(arguments.slice.file_name());
        say(&format!("tinta: {}: remarks on {remarked} jobs", journal.display()));
    }
    let to_do = left.len() - done - failed;
    if to_do > 0 {
        let folder = folder.display();
        say(&format!(
            "tinta: {folder}: stopped by a signal with {to_do} of {jobs} jobs left; the same command does them"
        ));
        return Ok(Verdict::Stopped { signal: stop.signal() });
    }
    Ok(if failed == 0 { Verdict::Good } else { Verdict::Different })
}

/// The jobs, and the folder that they write into.
fn list(arguments: &Arguments, program: &Program) -> Result<(List, PathBuf)> {
    let Arguments { models, output, drawing, .. } = arguments;
    let is_one = |model: &String| is_model(model.as_ref()) || Path::new(model).is_dir();
    let list = match (&models[..], models.iter().find(|model| !is_one(model))) {
        (_, None) => return drawing.list(models, output, program),
        ([list], _) => list,
        (_, Some(other)) => {
            let problem = "this is no model; name models and folders of models, or one list of jobs";
            return Err(Error::model(other, problem));
        }
    };
    drawing.refuse_for_lists(output)?;
    let (bytes, name) = match list.as_str() {
        standard_input::DASH => (standard_input::list()?, standard_input::NAME),
        path => (read_list(Path::new(path))?, path),
    };
    let list = List::of_bytes(bytes, name)?;
    names::check(&list, name, program)?;
    Ok((list, output.into()))
}

/// Whether a job is done: as its picture tells, or its entry.
fn is_done(job: &Job, folder: &Path, known: &HashMap<String, Entry>, program: &Program) -> bool {
    let is_recorded =
        || known.get(&job.json).is_some_and(|entry| entry.outcome.error.is_none()) && are_there(job, folder);
    told(job, folder, program).unwrap_or_else(is_recorded)
}

/// Whether a job's picture tells that it is done; `None` if it does not tell.
fn told(job: &Job, folder: &Path, program: &Program) -> Option<bool> {
    let options = JobOptions::of(job, folder).ok()?;
    (program.named(job.command.choice_name())?.told)(&options)
}

/// A run: what its threads share, and what came of it.
struct Running {
    journal: Journal,
    done: usize,
    failed: usize,
    /// Jobs with remarks.
    remarked: usize,
    /// Why it ends before its end.
    stop: Option<Error>,
    /// The jobs whose worker died, which are tried again alone.
    crashed: Vec<Job>,
}

impl Running {
    /// Counts a job, records it unless its picture tells all, and reports the reason for the first few failures. A full disk is the
    /// run's error, not the job's: every later job would fail too. The job is not recorded; the next run does it.
    fn note(&mut self, job: &Job, folder: &Path, outcome: Outcome, is_told: bool) -> Result<()> {
        match &outcome.error {
            None => self.done += 1,
            Some(Failure { kind, problem }) if kind == DISK_FULL => {
                let problem = problem.trim_end_matches(" and continue with --resume");
                let problem = format!("{problem}; then give the same command again");
                let of_job = Error::output(format!("{}: {}", folder.display(), job.id), problem);
                return Err(of_job.because(&std::io::ErrorKind::StorageFull.into()));
            }
            Some(_) => self.failed += 1,
        }
        if let Some(Failure { problem, .. }) = outcome.error.as_ref().filter(|_| self.failed <= REMARKS) {
            say(&format!("tinta: {}: {problem}", job.id));
        }
        self.remarked += usize::from(!outcome.remarks.is_empty());
        if is_told { Ok(()) } else { self.journal.append(&Entry::new(job, outcome)) }
    }
}

/// Does the jobs, so many at once; an error is one of the run itself, not of a job.
fn carry_out(
    jobs: &[Job],
    folder: &Path,
    journal: Journal,
    workers: usize,
    cores: usize,
    (stop, program): (&Stop, &Program),
) -> Result<Running> {
    let progress = Progress::new("working", jobs.len() as u64);
    let run = Mutex::new(Running { journal, done: 0, failed: 0, remarked: 0, stop: None, crashed: Vec::new() });
    let next = AtomicUsize::new(0);
    let lock = || run.lock().unwrap_or_else(PoisonError::into_inner);
    let work = || {
        let mut worker: Option<WorkerProcess> = None;
        while !stop.is_asked() && lock().stop.is_none() {
            let Some(job) = jobs.get(next.fetch_add(1, Ordering::Relaxed)) else { break };
            let ready = worker.take().map_or_else(|| WorkerProcess::start(folder, workers, cores), Ok);
            let ended = ready.map(|ready| {
                let outcome;
                (worker, outcome) = ready.carry_out(job);
                let is_told = tells_all(job, folder, &outcome, program);
                (outcome, is_told)
            });
            let mut run = lock();
            let noted = ended.and_then(|(outcome, is_told)| match outcome.error.as_ref() {
                // Perhaps it was another program's fault, as where memory ran out.
                Some(error) if error.kind == CRASH => {
                    run.crashed.push(job.clone());
                    Ok(())
                }
                _ => run.note(job, folder, outcome, is_told),
            });
            progress.step();
            if let Err(error) = noted {
                run.stop.get_or_insert(error);
            }
        }
    };
    on_threads(workers, work);
    drop(progress);
    let mut run = run.into_inner().unwrap_or_else(PoisonError::into_inner);
    for job in std::mem::take(&mut run.crashed) {
        if stop.is_asked() || run.stop.is_some() {
            break;
        }
        let (_, mut outcome) = WorkerProcess::start(folder, 1, cores)?.carry_out(&job);
        outcome.tries += 1;
        let is_told = tells_all(&job, folder, &outcome, program);
        run.note(&job, folder, outcome, is_told)?;
    }
    run.stop.take().map_or(Ok(run), Err)
}

/// Does the same work on so many threads, this one among them.
fn on_threads(count: usize, work: impl Fn() + Copy + Send) {
    std::thread::scope(|scope| {
        let others: Vec<_> =
            (1..count).map_while(|_| std::thread::Builder::new().spawn_scoped(scope, work).ok()).collect();
        work();
        for other in others {
            other.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic));
        }
    });
}

/// Whether a job's picture tells all that came of it.
fn tells_all(job: &Job, folder: &Path, outcome: &Outcome, program: &Program) -> bool {
    let is_silent = outcome.error.is_none() && outcome.remarks.is_empty() && outcome.printed.is_none();
    is_silent && told(job, folder, program) == Some(true)
}

/// [`Error::kind`] of [`Error::File`].
const DISK_FULL: &str = "disk-full";

/// Counts the jobs of all slices.
fn sum_up(list: &List, folder: &Path, program: &Program) -> Result<Verdict> {
    let known = entries(folder, Slice::WHOLE)?;
    let mut named: [(&str, Vec<String>); 2] = [("failed", Vec::new()), ("missing", Vec::new())];
    for job in list.jobs(Slice::WHOLE).filter(|job| !is_done(job, folder, &known, program)) {
        match known.get(&job.json).and_then(|entry| entry.outcome.error.as_ref()) {
            Some(Failure { problem, .. }) => named[0].1.push(format!("{}: {problem}", job.id)),
            None => named[1].1.push(job.id),
        }
    }
    let [failed, missing] = [0, 1].map(|place| named[place].1.len());
    let (count, done) = (list.count, list.count - failed - missing);
    let mut text = format!("{count} jobs: {done} done, {failed} failed, {missing} missing\n");
    for (what, jobs) in named {
        jobs.iter().take(REMARKS).for_each(|job| text += &(plain(&format!("{what}: {job}")) + "\n"));
        if jobs.len() > REMARKS {
            text += &format!("{what}: {} more\n", jobs.len() - REMARKS);
        }
    }
    print(&text)?;
    Ok(if done == count { Verdict::Good } else { Verdict::Different })
}
