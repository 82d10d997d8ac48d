//! The folder that results go to.

use std::path::Path;
use tinta::{Error, Result};

/// Makes it, if it is not there.
pub(in crate::commands) fn make_folder(folder: &Path) -> Result<()> {
    std::fs::create_dir_all(folder).map_err(|error| {
        let problem = match folder.is_file() {
            true => "this is a file; name a folder".to_owned(),
            false => format!("the folder cannot be created ({error}); choose another"),
        };
        Error::output(folder, problem).because(&error)
    })
}
