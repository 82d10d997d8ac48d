//! `tinta batch`: runs a list of jobs, or a slice of it, on all cores, and summarises the results.
//!
//! Workers do the jobs: processes of this program that take one job after another and keep their context, programs and models. A
//! job that crashes the driver ends one worker and no other job. Each result is recorded at once.

pub(super) mod job_options;
#[cfg(test)]
mod tests;
mod names;
mod worker;
mod worker_process;

use super::progress::Progress;
use super::signals::Stop;
use super::standard_input;
use super::{Command, given};
use super::{Program, Verdict, plain, print, print_json, say};
pub use job_options::JobOptions;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use tinta::batch::{Entry, Failure, Job, Journal, List, Outcome, Slice, Status, Summary, begun, done, read_list};
use tinta::limits::REMARKS;
use tinta::{Error, Result};
use worker_process::{CRASH, WorkerProcess};

/// The command.
pub(super) const COMMAND: Command = Command {
    examples: &["tinta batch jobs.jsonl -o pictures              run many jobs from a list"],
    ..Command::new("batch", <Arguments as clap::Args>::augment_args, |matches, call| {
        run(&given::<Arguments>(matches)?, call.program)
    })
};

/// Run a list of jobs, one line of JSON each, on all cores
#[derive(clap::Args)]
#[command(after_help = "\
A job: {\"id\": \"cow-1\", \"command\": \"render\", \"model\": \"cow.obj\", \"output\": \"cow-1.png\", \"view\": \"90,15\"}
Its command is render, compare or measure. Its model is a text, or several in brackets. Every other key is the long name of an \
option of that command. Outputs are written into DIR; files to read are named as on the command line. See docs/guide/batches.md.

Exit codes:
  0    all jobs done
  1    a job failed
  2    not done; one sentence on standard error says why
  75   another run is working on the same slice
  130  stopped by Ctrl-C with jobs left
  143  stopped by SIGTERM with jobs left")]
pub(super) struct Arguments {
    /// List of jobs, one line of JSON each; - for standard input
    #[arg(value_name = "LIST", required_unless_present_any = ["summary", "worker"])]
    list: Option<PathBuf>,

    /// Folder for the files that the jobs write, and for the record of their results
    #[arg(short, long, value_name = "DIR", required_unless_present = "summary")]
    output: Option<PathBuf>,

    /// Run only every N-th job, starting with the K-th, to share a list among N machines [default: 1/1]
    #[arg(long, value_name = "K/N", default_value = "1/1", hide_default_value = true)]
    slice: Slice,

    /// Continue in the same folder: skip finished jobs whose files exist, retry failed ones [default: off]
    #[arg(long)]
    resume: bool,

    /// Jobs to run at once, each in its own process [default: one per processor]
    #[arg(long, value_name = "J", value_parser = clap::value_parser!(u32).range(1..=1024))]
    jobs: Option<u32>,

    /// Summarise what all slices did in DIR: print it, and write batch-summary.jsonl and batch-times.jsonl there
    #[arg(long, value_name = "DIR", conflicts_with_all = ["list", "output", "slice", "resume", "jobs"])]
    summary: Option<PathBuf>,

    /// With --summary: print one JSON record [default: off]
    #[arg(long, requires = "summary")]
    json: bool,

    /// Read jobs from standard input; tinta batch starts such workers
    #[arg(long, hide = true, conflicts_with_all = ["list", "summary"])]
    worker: bool,
}

/// Runs the list, or summarises its results; exit code 1 if a job failed or is missing, 128 plus the signal's number if a signal
/// ended it early.
pub(super) fn run(arguments: &Arguments, program: &Program) -> Result<Verdict> {
    if let Some(folder) = &arguments.summary {
        return sum_up(folder, arguments.json);
    }
    let none = || Error::CommandLine { problem: "LIST and --output DIR are needed".to_owned() };
    let folder = arguments.output.as_deref().ok_or_else(none)?;
    if arguments.worker {
        return worker::serve(folder, program).map(|()| Verdict::Good);
    }
    let (bytes, name) = match arguments.list.as_deref().ok_or_else(none)? {
        path if path == Path::new(standard_input::DASH) => (standard_input::list()?, standard_input::NAME.to_owned()),
        path => (read_list(path)?, path.display().to_string()),
    };
    let (list, is_kept) = List::for_folder(bytes, &name, folder)?;
    names::check(&list, &name, program)?;
    super::make_folder(folder)?;
    let (journal, jobs, left) = begin(arguments, folder, list, is_kept)?;
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let workers = arguments.jobs.map_or(cores, |jobs| jobs as usize).min(left.len());
    let stop = Stop::on_signals();
    let Running { done, failed, .. } = carry_out(&left, folder, journal, workers, cores, &stop)?;
    let before = jobs - left.len();
    let before = if before > 0 { format!(", {before} were done before") } else { String::new() };
    say(&format!("tinta: {done} of {jobs} jobs done{before}, {failed} failed"));
    let to_do = left.len() - done - failed;
    if to_do > 0 {
        say(&format!(
            "tinta: {}: stopped by a signal with {to_do} of {jobs} jobs left; continue with --resume",
            folder.display()
        ));
        return Ok(Verdict::Stopped { signal: stop.signal() });
    }
    Ok(if failed == 0 { Verdict::Good } else { Verdict::Different })
}

/// Opens the slice's file, after checking that the list belongs to this folder. Returns also how many jobs the slice has, and the
/// unfinished ones, which alone stay in memory.
fn begin(
    arguments: &Arguments,
    folder: &Path,
    list: List,
    is_kept: Option<bool>,
) -> Result<(Journal, usize, Vec<Job>)> {
    let refuse = |problem: String| Err(Error::output(folder, problem));
    let slice = arguments.slice;
    let has_begun = begun(folder).iter().any(|other| *other == slice || other.count != slice.count);
    if has_begun && !arguments.resume {
        return refuse("this folder holds a batch; continue it with --resume, or name another folder".to_owned());
    }
    match is_kept {
        Some(true) => {}
        Some(false) if !(arguments.resume && slice == Slice::WHOLE) => {
            return refuse(
                "this folder holds a batch of another list; name another folder, or give the changed list with \
                 --resume and without --slice"
                    .to_owned(),
            );
        }
        _ => list.keep(folder)?,
    }
    let journal = Journal::open(folder, slice)?;
    let jobs: Vec<Job> = list.jobs(slice).collect();
    drop(list);
    // Now that this run alone writes to the slice's file.
    let done = done(folder, slice, &jobs)?;
    let count = jobs.len();
    let left = jobs.into_iter().zip(done).filter(|(_, done)| !done).map(|(job, _)| job).collect();
    Ok((journal, count, left))
}

/// A run: what its threads share, and what came of it.
struct Running {
    journal: Journal,
    done: usize,
    failed: usize,
    /// Why it ends before its end.
    stop: Option<Error>,
    /// The jobs whose worker died, which are tried again alone.
    crashed: Vec<Job>,
}

impl Running {
    /// Counts and records a job, and reports the reason for the first few failures.
    fn note(&mut self, job: &Job, outcome: Outcome) -> Result<()> {
        match outcome.status {
            Status::Done => self.done += 1,
            Status::Failed => self.failed += 1,
        }
        if let Some(Failure { problem, .. }) = outcome.error.as_ref().filter(|_| self.failed <= REMARKS) {
            say(&format!("tinta: line {}, {}: {problem}", job.line, job.id));
        }
        self.journal.append(&Entry::new(job, outcome))
    }
}

/// Does the jobs, so many at once; an error is one of the run itself, not of a job.
fn carry_out(
    jobs: &[Job],
    folder: &Path,
    journal: Journal,
    workers: usize,
    cores: usize,
    stop: &Stop,
) -> Result<Running> {
    let progress = Progress::new("working", jobs.len() as u64);
    let run = Mutex::new(Running { journal, done: 0, failed: 0, stop: None, crashed: Vec::new() });
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
                outcome
            });
            let mut run = lock();
            let noted = ended.and_then(|outcome| stop_on_full_disk(job, folder, outcome));
            let noted =
                noted.and_then(|outcome| match outcome.error.as_ref().is_some_and(|error| error.kind == CRASH) {
                    // Perhaps it was another program's fault, as where memory ran out.
                    true => {
                        run.crashed.push(job.clone());
                        Ok(())
                    }
                    false => run.note(job, outcome),
                });
            progress.step();
            if let Err(error) = noted {
                run.stop.get_or_insert(error);
            }
        }
    };
    std::thread::scope(|scope| {
        let others: Vec<_> =
            (1..workers).map_while(|_| std::thread::Builder::new().spawn_scoped(scope, work).ok()).collect();
        work();
        for other in others {
            other.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic));
        }
    });
    drop(progress);
    let mut run = run.into_inner().unwrap_or_else(PoisonError::into_inner);
    for job in std::mem::take(&mut run.crashed) {
        if stop.is_asked() || run.stop.is_some() {
            break;
        }
        let (_, mut outcome) = WorkerProcess::start(folder, 1, cores)?.carry_out(&job);
        outcome.run.tries += 1;
        run.note(&job, outcome)?;
    }
    run.stop.take().map_or(Ok(run), Err)
}

/// A full disk is the run's error, not the job's: every later job would fail too. The job is not recorded; the next run does it.
fn stop_on_full_disk(job: &Job, folder: &Path, outcome: Outcome) -> Result<Outcome> {
    match outcome.error {
        Some(Failure { ref kind, ref problem }) if *kind == DISK_FULL => Err(Error::output(
            format!("{}: line {}, {}", folder.display(), job.line, job.id),
            format!("{}; continue with --resume", problem.trim_end_matches(" and continue with --resume")),
        )
        .because(&std::io::ErrorKind::StorageFull.into())),
        _ => Ok(outcome),
    }
}

/// [`Error::kind`] of [`Error::File`].
const DISK_FULL: &str = "disk-full";

/// Combines the journals of all slices.
fn sum_up(folder: &Path, json: bool) -> Result<Verdict> {
    let summary = Summary::put_together(folder)?;
    if json {
        print_json(&summary)?
    } else {
        print(&table(&summary))?
    }
    Ok(if summary.is_all_done() { Verdict::Good } else { Verdict::Different })
}

fn table(summary: &Summary) -> String {
    let Summary { jobs, done, failed, missing, outdated, damaged, .. } = summary;
    let mut text = format!("{jobs} jobs: {done} done, {failed} failed, {missing} missing\n");
    text += &format!(
        "{:<10}{:>8}{:>8}{:>8}{:>12}{:>12}{:>12}\n",
        "", "done", "failed", "missing", "seconds", "median ms", "longest ms"
    );
    for command in &summary.commands {
        let [sum, median, longest] = command.milliseconds;
        text += &format!(
            "{:<10}{:>8}{:>8}{:>8}{:>12.1}{median:>12.1}{longest:>12.1}\n",
            command.command.name(),
            command.done,
            command.failed,
            command.missing,
            sum * 1e-3
        );
    }
    for (what, named) in [("failed", &summary.failures), ("missing", &summary.missing_jobs)] {
        for job in named.iter().take(REMARKS) {
            let colon = if job.problem.is_empty() { "" } else { ": " };
            text += &plain(&format!("{what}: line {}, {}{colon}{}", job.line, job.id, job.problem));
            text.push('\n');
        }
        if named.len() > REMARKS {
            text += &format!("{what}: {} more, in batch-summary.jsonl\n", named.len() - REMARKS);
        }
    }
    for (count, what) in [(outdated, "of jobs that are no longer in the list"), (damaged, "that cannot be understood")]
    {
        if *count > 0 {
            text += &format!("{count} entries {what}\n");
        }
    }
    text
}
