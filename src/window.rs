//! The window: models turn under the mouse, two styles side by side, every setting a control, every buffer visible.
//!
//! Models and a first state come in; pictures on a screen and files go out. The pictures are those of the headless
//! [`crate::Renderer`], drawn on separate threads and shown as textures: the same bytes as `tinta render` writes.
//! [`ViewerState`], a plain value that events change, decides what the window shows; only this module uses winit and egui.
//!
//! | file | what |
//! |---|---|
//! | `state.rs`, `event.rs`, `line_style.rs`, `controls.rs`, `buffer.rs`, `paint.rs`, `compose.rs` | values: what is shown, what happens, how it changes |
//! | `viewer.rs` | the state with the threads that work for it |
//! | `draw.rs`, `coarse.rs`, `render_threads.rs`, `exact.rs`, `load.rs`, `watch.rs`, `cost.rs`, `line_measure.rs`, `save.rs`, `dialogue.rs`, `report.rs` | the threads and what they tell |
//! | `ui.rs`, `panel.rs`, `widget.rs`, `plot.rs`, `label.rs`, `keys.rs` | widgets: they read the state and make events |
//! | `app.rs`, `replay.rs`, `player.rs` | the window itself, and recordings played in it |
//!
//! ```
//! use tinta::window::{Orbit, Side, ViewerEvent, ViewerState};
//!
//! let mut state = ViewerState::new(vec!["builtin:gear".to_owned()], Orbit::default());
//! let before = state.orbit.view;
//! state.update(ViewerEvent::Turn([0.25, 0.0]));
//! assert_ne!(state.orbit.view, before);
//! assert_eq!(state.style(Side::Left).name(), "three-pass");
//! ```

mod app;
mod buffer;
mod coarse;
mod compose;
mod controls;
mod cost;
#[cfg(feature = "file-dialogue")]
mod dialogue;
mod draw;
mod event;
mod exact;
mod job;
mod keys;
mod label;
mod line_measure;
mod line_job;
mod line_style;
mod load;
mod paint;
mod panel;
mod player;
mod plot;
mod render_threads;
mod replay;
mod report;
mod save;
mod shown;
mod state;
mod ui;
mod viewer;
mod watch;
mod widget;

pub use crate::orbit::Orbit;
pub use app::{WindowOptions, open};
pub use buffer::{Buffer, buffers};
pub use compose::composed;
pub use controls::SCENE_SETTINGS;
pub use cost::{Costs, Point, SideCost};
pub use draw::Drawer;
pub use event::{Effect, Layout, Save, Side, ViewerEvent};
pub use exact::ExactLines;
pub use job::{Drawing, Job};
pub use line_job::{Found, LineJob};
pub use line_measure::{Darkness, DrawInk, LineMeasure, LineScore, ScoreInk};
pub use line_style::{LINE_SETTINGS, LinesShown};
pub use paint::{over, painted};
pub use player::PlayedRecord;
pub use replay::Replay;
pub use report::Stage;
pub use state::{Content, Pane, ViewerState};
pub use viewer::{Viewer, ViewerOptions};
