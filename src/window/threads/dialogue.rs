//! The system's dialogue to choose a file in, on a separate thread: the window keeps responding while it is open.

use crate::window::threads::report::{Report, Reporter};
use std::path::Path;

/// Opens the dialogue in the folder of the first of these models, and reports the chosen file. Does nothing where the system has
/// no dialogue.
pub(in crate::window) fn choose(models: &[String], reporter: Reporter) {
    let folder = models.first().and_then(|model| Path::new(model).canonicalize().ok()?.parent().map(Path::to_owned));
    let to = reporter.clone();
    let ask = move || {
        let mut dialogue = rfd::FileDialog::new().set_title("Open a model");
        if let Some(folder) = folder {
            dialogue = dialogue.set_directory(folder);
        }
        let chosen = dialogue.pick_files().unwrap_or_default();
        to.say(Report::Chosen(chosen.iter().map(|path| path.to_string_lossy().into_owned()).collect()));
    };
    if std::thread::Builder::new().name("dialogue".to_owned()).spawn(ask).is_err() {
        reporter.say(Report::Chosen(Vec::new()));
    }
}
