//! Staging of a measurement's folder, which fills row by row: it has a temporary name until it is complete, and is resumed after a
//! kill.

use std::path::{Path, PathBuf};
use tinta::batch::{Job, JobCommand, place_in};
use tinta::record::ROWS_FILE;
use tinta::settings::OptionValue;
use tinta::{Error, Result};

/// A folder that does not have its final name yet.
pub(super) struct StagedFolder {
    staged: PathBuf,
    place: PathBuf,
}

impl StagedFolder {
    /// For a measurement; `None` for other jobs. Refuses a folder that is not a measurement's.
    pub(super) fn of(job: &Job, folder: &Path) -> Result<Option<Self>> {
        let output = job.options.iter().find(|(key, _)| key == "output");
        let (JobCommand::Measure, Some((_, OptionValue::Text(output)))) = (job.command, output) else {
            return Ok(None);
        };
        let Ok(place) = place_in(folder, output.trim_end_matches('/')) else { return Ok(None) };
        let name = place.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let is_empty = || std::fs::read_dir(&place).is_ok_and(|mut files| files.next().is_none());
        if place.symlink_metadata().is_ok() && !place.join(ROWS_FILE).is_file() && !is_empty() {
            return Err(Error::output(
                place,
                "this folder holds something other than a measurement; name another folder",
            ));
        }
        let staged = place.with_file_name(format!("{}{name}", prefix(job)));
        // Rows of several files are put together quickly, and from the beginning.
        let is_merge = job.options.iter().any(|(key, _)| key == "merge");
        if is_merge && staged.is_dir() {
            std::fs::remove_dir_all(&staged).map_err(|error| cannot(&staged, &error))?;
        }
        Ok(Some(Self { staged, place }))
    }

    /// The temporary folder of the unfinished output.
    pub(super) fn path(&self) -> &Path {
        &self.staged
    }

    /// Gives the folder, whole, its name; an older measurement there is gone then.
    pub(super) fn put_in_place(&self) -> Result<()> {
        let old = self.staged.with_extension("old");
        let _ = std::fs::remove_dir_all(&old);
        if self.place.join(ROWS_FILE).is_file() {
            std::fs::rename(&self.place, &old).map_err(|error| cannot(&self.place, &error))?;
        }
        std::fs::rename(&self.staged, &self.place).map_err(|error| cannot(&self.place, &error))?;
        let _ = std::fs::remove_dir_all(&old);
        Ok(())
    }
}

/// How the name of a job's folder begins while it is staged: another one where the job has been changed.
pub(super) fn prefix(job: &Job) -> String {
    format!(".tinta-{}-", job.sha256.get(..16).unwrap_or_default())
}

fn cannot(path: &Path, error: &std::io::Error) -> Error {
    let problem = format!("the folder cannot be replaced ({error}); choose another");
    Error::output(path, problem).because(error)
}
