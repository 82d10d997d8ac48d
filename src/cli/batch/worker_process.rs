//! Parent side of a worker process: sends jobs and receives results, one line of JSON each.

use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, ChildStdout, Command, ExitStatus, Stdio};
use tinta::batch::{Job, Outcome};
use tinta::{Error, Result};

/// A worker process, which ends with this.
pub(super) struct WorkerProcess {
    child: Child,
    /// Closed, it ends once its job has ended.
    jobs: Option<ChildStdin>,
    outcomes: BufReader<ChildStdout>,
}

/// The kind of failure of a job whose worker died.
pub(super) const CRASH: &str = "crash";

/// The variable for the number of Mesa's extra threads, which Mesa reads once when it starts.
const RASTER_THREADS: &str = "LP_NUM_THREADS";

/// The variable for the Python whose package carries out the command line.
const PYTHON: &str = "TINTA_PYTHON";

impl WorkerProcess {
    /// Starts one of so many.
    pub(super) fn start(folder: &Path, workers: usize, cores: usize) -> Result<Self> {
        let cannot = |error: std::io::Error| Error::CommandLine {
            problem: format!(
                "no worker could be started ({error}); check the limits on processes, or give fewer --jobs"
            ),
        };
        let mut command = program().map_err(cannot)?;
        command.args(["batch", "--worker", "--output"]).arg(folder);
        // More drawing threads only while processors are free.
        if std::env::var_os(RASTER_THREADS).is_none() {
            let threads = if cores >= workers * 2 { cores / workers } else { 0 };
            command.env(RASTER_THREADS, threads.to_string());
        }
        let mut child = command.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().map_err(cannot)?;
        let (jobs, outcomes) = (child.stdin.take(), child.stdout.take());
        match outcomes {
            Some(outcomes) => Ok(Self { child, jobs, outcomes: BufReader::new(outcomes) }),
            None => Err(cannot(std::io::Error::other("it has no standard output"))),
        }
    }

    /// Has a job done. A worker that ends over it does not come back; the run tries the job once more.
    pub(super) fn carry_out(mut self, job: &Job) -> (Option<Self>, Outcome) {
        let told = self.jobs.as_mut().is_some_and(|jobs| jobs.write_all(format!("{}\n", job.json).as_bytes()).is_ok());
        let mut line = Vec::new();
        if told {
            // Unreadable output counts as missing.
            let _ = self.outcomes.read_until(b'\n', &mut line);
        }
        if let Ok(outcome) = serde_json::from_slice(&line) {
            return (Some(self), outcome);
        }
        let _ = self.child.kill();
        let ended = self.child.wait().map_or_else(|error| error.to_string(), in_words);
        let problem = format!(
            "its worker process ended ({ended}), perhaps because the driver crashed or memory ran out; run this job alone"
        );
        (None, Outcome::failed(CRASH, problem))
    }
}

impl Drop for WorkerProcess {
    fn drop(&mut self) {
        self.jobs = None;
        let _ = self.child.wait();
    }
}

/// A command that starts this program, also where its file was replaced since, or where a Python carries it out.
fn program() -> std::io::Result<Command> {
    if let Some(python) = std::env::var_os(PYTHON) {
        let mut command = Command::new(python);
        command.args(["-m", "tinta_npr"]);
        return Ok(command);
    }
    let same = Path::new("/proc/self/exe");
    let is_kept = cfg!(target_os = "linux") && same.exists();
    Ok(Command::new(if is_kept { same.to_owned() } else { std::env::current_exe()? }))
}

fn in_words(status: ExitStatus) -> String {
    #[cfg(unix)]
    if let Some(signal) = std::os::unix::process::ExitStatusExt::signal(&status) {
        return format!("signal {signal}");
    }
    status.code().map_or_else(|| "no exit code".to_owned(), |code| format!("exit code {code}"))
}
