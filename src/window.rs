//! The window: models turn under the mouse, two styles side by side, every setting a control, every buffer visible.
//!
//! Models and a first state come in; pictures on a screen and files go out. The pictures are those of the headless
//! [`crate::Renderer`], drawn on separate threads and shown as textures: the same bytes as `tinta render` writes.
//! [`ViewerState`], a plain value that events change, decides what the window shows; only this module uses winit and egui.
//!
//! | in | what |
//! |---|---|
//! | `values/` | what is shown, what happens, how it changes |
//! | `threads/` | the threads and what they report; `viewer.rs` joins them with the state |
//! | `widgets/` | widgets: they read the state and make events |
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
mod player;
mod replay;
mod threads;
mod values;
mod widgets;

pub use crate::orbit::Orbit;
pub use app::{WindowOptions, open};
pub use player::PlayedRecord;
pub use replay::Replay;
pub use threads::cost::{Costs, Point, SideCost};
pub use threads::draw::Drawer;
pub use threads::exact::ExactLines;
pub use threads::job::{Drawing, Job, Lines};
pub use threads::line_measure::{Darkness, LineMeasure, LineScore};
pub use threads::report::Stage;
pub use threads::viewer::{Viewer, ViewerOptions};
pub use values::buffer::{Buffer, buffers};
#[cfg(feature = "cli")]
pub(crate) use values::controls::SCENE_SETTINGS;
pub use values::event::{Effect, Layout, Save, Side, ViewerEvent};
pub use values::state::{Content, Pane, ViewerState};
