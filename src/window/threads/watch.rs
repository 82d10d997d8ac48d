//! Polls files for changes: the models and a folder of shaders.
//!
//! The thread reads each file's time and length twice a second, which costs some microseconds and works on every kind of disk; a
//! notification by the system would need a crate and miss network disks. A file counts as changed once it stays the same for one
//! check, to avoid reading half of it.

use crate::glsl::{SOURCES, in_folder};
use crate::window::threads::report::{Report, Reporter};
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::time::{Duration, SystemTime};

/// Time between looks.
const INTERVAL: Duration = Duration::from_millis(500);

/// A file's time and length, read without opening it; `None` for a missing file.
type Look = Option<(SystemTime, u64)>;

/// Files and their last state.
#[derive(Debug, Default)]
pub(in crate::window) struct WatchedFiles {
    files: Vec<(PathBuf, Look, Look)>,
}

impl WatchedFiles {
    /// Begins to watch files in their current state.
    pub(in crate::window) fn new(files: impl IntoIterator<Item = PathBuf>) -> Self {
        let seen = |file: PathBuf| {
            let now = look(&file);
            (file, now, now)
        };
        Self { files: files.into_iter().map(seen).collect() }
    }

    /// Checks the files; returns whether one has changed since the last report and stayed the same since the last check.
    pub(in crate::window) fn has_changed(&mut self) -> bool {
        let mut has_changed = false;
        for (file, said, last) in &mut self.files {
            let now = look(file);
            if now == *last && now != *said && now.is_some() {
                *said = now;
                has_changed = true;
            }
            *last = now;
        }
        has_changed
    }
}

fn look(file: &Path) -> Look {
    let metadata = std::fs::metadata(file).ok()?;
    Some((metadata.modified().ok()?, metadata.len()))
}

/// Starts the thread; each message is the new list of models to watch. It ends with its sender.
pub(in crate::window) fn start(shaders: Option<PathBuf>, reporter: Reporter) -> std::io::Result<Sender<Vec<PathBuf>>> {
    let (sender, lists) = channel();
    let work = move || work(shaders.as_deref(), &lists, &reporter);
    std::thread::Builder::new().name("watching".to_owned()).spawn(work)?;
    Ok(sender)
}

fn work(shaders: Option<&Path>, lists: &Receiver<Vec<PathBuf>>, reporter: &Reporter) {
    let shader_files = shaders.map(|folder| SOURCES.iter().map(|(path, _)| folder.join(path)).collect::<Vec<_>>());
    let mut watched_shaders = WatchedFiles::new(shader_files.unwrap_or_default());
    let mut models = WatchedFiles::default();
    loop {
        match lists.recv_timeout(INTERVAL) {
            Ok(list) => models = WatchedFiles::new(list),
            Err(RecvTimeoutError::Disconnected) => return,
            Err(RecvTimeoutError::Timeout) => {}
        }
        if models.has_changed() {
            reporter.say(Report::ModelChanged);
        }
        if let Some(folder) = shaders
            && watched_shaders.has_changed()
        {
            reporter.say(Report::ShadersChanged(in_folder(folder)));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_change_is_told_once_and_only_after_the_file_stood_still() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("a.obj");
        std::fs::write(&file, "v").unwrap();
        let mut watched = WatchedFiles::new([file.clone()]);
        assert!(!watched.has_changed());
        std::fs::write(&file, "v 0").unwrap();
        assert!(!watched.has_changed(), "it may still be being written");
        std::fs::write(&file, "v 0 0").unwrap();
        assert!(!watched.has_changed());
        assert!(watched.has_changed());
        assert!(!watched.has_changed());
    }

    #[test]
    fn a_file_that_goes_away_and_comes_back_has_changed_when_it_is_back() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("a.obj");
        std::fs::write(&file, "v").unwrap();
        let mut watched = WatchedFiles::new([file.clone()]);
        std::fs::remove_file(&file).unwrap();
        assert!(!watched.has_changed() && !watched.has_changed());
        std::fs::write(&file, "v 0 0 0").unwrap();
        assert!(!watched.has_changed() && watched.has_changed());
    }
}
