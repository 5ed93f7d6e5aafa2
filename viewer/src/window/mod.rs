//! The desktop window: a run in both directions of time, drawn by the rasteriser.
//!
//! ```text
//! keys, mouse, deck --WindowMessage--> update --> WindowState --compose--> Raster -> window | PNG
//!                                         \--Effect--> deck, files
//! ```
//!
//! The window is a face of a [`Session`](crate::session): [`update`] adds what the mouse does.
//! [`compose`] makes all pixels, those of the window and those of its PNG: they are the same. The
//! simulation has a thread of its own, the runner's [`Deck`](loschmidt_runner::Deck); this one
//! draws, at most 60 pictures a second, and never waits for a step. No GPU is used, and no library
//! of the system is needed to build it: those of X11 and Wayland are looked for when it runs.

mod app;
mod compose;
mod error;
mod input;
mod log;
mod message;
mod places;
mod sheets;
mod state;
mod strip;
mod update;

pub use compose::compose;
pub use error::WindowError;
pub use message::WindowMessage;
pub use places::Places;
pub use state::WindowState;
pub use update::update;

use crate::colouring::Colouring;
use crate::look::Look;
use crate::picture::Picture;
use crate::session::{MOST_THREADS, Request, guarded};
use app::{App, Wake};
use clap::Args;
use loschmidt_runner::Options;
use loschmidt_runner::plain::{quote, visible};
use std::io::Write;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use winit::event_loop::EventLoop;

/// Exit code after a signal.
const INTERRUPTED: u8 = 130;

/// What to show, and how.
#[derive(Args, Clone, Debug)]
pub struct WindowArguments {
    /// A scene file, a scene of the catalogue, or the directory of a run
    /// [default: dam-break with 5,000 particles]
    #[arg(value_name = "SCENE|RUN")]
    pub scene: Option<String>,
    /// Override a key of the scene, for example particle_spacing=0.01; an empty value removes the
    /// key; may be repeated
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub set: Vec<String>,
    /// Show fixed and floating point side by side
    #[arg(long)]
    pub beside: bool,
    /// Tint the fluid with this PNG, laid over its initial state
    #[arg(long, value_name = "PNG")]
    pub tint: Option<PathBuf>,
    /// What the colours say: speed, density, pressure, initial-height, displacement; of solids
    /// also von-mises-stress, strain-energy, distortion-xx and so on
    #[arg(long, value_name = "NAME", value_parser = colour)]
    pub color: Option<Colouring>,
    /// Colours of the window
    #[arg(long, default_value = "dark")]
    pub theme: crate::theme_name::ThemeName,
    /// Width and height of the window, in pixels of a plain display
    #[arg(long, value_name = "WxH", default_value = "1280x720", value_parser = size)]
    pub size: (usize, usize),
    /// Threads of the executor [default: as many as there are processors]
    #[arg(
        long,
        value_name = "N",
        value_parser = clap::value_parser!(u64).range(1..=MOST_THREADS as u64)
    )]
    pub threads: Option<u64>,
    /// Tell on standard error what happens, for scripts
    #[arg(long)]
    pub log: bool,
}

fn colour(text: &str) -> Result<Colouring, String> {
    Colouring::by_name(text).ok_or_else(|| {
        let known = Colouring::known();
        let names: Vec<String> = known.iter().map(Colouring::name).collect();
        format!("one of {}", names.join(", "))
    })
}

fn size(text: &str) -> Result<(usize, usize), String> {
    let side = |s: &str| s.parse().ok().filter(|n| (320..=8192).contains(n));
    text.split_once('x')
        .and_then(|(w, h)| Some((side(w)?, side(h)?)))
        .ok_or_else(|| "two numbers from 320 to 8192, as in 1280x720".to_owned())
}

impl WindowArguments {
    fn request(&self) -> Request {
        let (name, mut set) = match &self.scene {
            Some(name) => (name.clone(), Vec::new()),
            None => (
                "dam-break".to_owned(),
                vec!["particle_spacing=0.02".to_owned()],
            ),
        };
        set.extend(self.set.iter().cloned());
        Request {
            name,
            set,
            threads: self.threads.map(|n| n as usize),
            beside: self.beside,
        }
    }

    fn look(&self) -> Look {
        Look {
            colouring: self.color.clone().unwrap_or_default(),
            theme: self.theme.into(),
            ..Look::default()
        }
    }
}

/// Shows a window until its user leaves or `stop` is set, which is looked at once `ready` is
/// called. The directory to go on from, where there is something to go on with.
///
/// # Errors
/// [`WindowError`].
pub fn run(
    arguments: &WindowArguments,
    options: Options,
    stop: Arc<AtomicBool>,
    ready: impl FnOnce(),
) -> Result<Option<PathBuf>, WindowError> {
    // What cannot be read is said before there is a window.
    let request = arguments.request();
    let picture = arguments.tint.as_deref().map(Picture::open).transpose()?;
    let opening = request.opening(options)?;
    if request.beside && opening.recorded.is_some() {
        return Err(WindowError::Beside(request.name));
    }
    ready();
    let event_loop = event_loop()?;
    let handles = (event_loop.create_proxy(), event_loop.owned_display_handle());
    let state = WindowState::new(arguments.size, 1.0, arguments.look(), picture);
    let mut app = App::new(state, options, handles, stop, arguments.log);
    app.open(request, opening);
    let ended = guarded(|| event_loop.run_app(&mut app));
    let kept = app.keep_at_the_end(!matches!(ended, Ok(Ok(()))))?;
    match ended {
        Ok(Ok(())) => Ok(kept),
        Ok(Err(why)) => Err(WindowError::of_display(&format!("{why:?}"), true)),
        Err(defect) => Err(WindowError::Defect(defect, kept)),
    }
}

/// The connection to the desktop. Where a library is missing, some of those who look for it report
/// it, and some panic: both become errors here.
fn event_loop() -> Result<EventLoop<Wake>, WindowError> {
    let names = ["WAYLAND_DISPLAY", "WAYLAND_SOCKET", "DISPLAY"];
    let elsewhere = !cfg!(all(unix, not(target_vendor = "apple")));
    let set = elsewhere
        || names
            .iter()
            .any(|name| std::env::var_os(name).is_some_and(|value| !value.is_empty()));
    let before = std::panic::take_hook();
    std::panic::set_hook(Box::new(|_| {}));
    let built = catch_unwind(AssertUnwindSafe(|| {
        EventLoop::<Wake>::with_user_event().build()
    }));
    std::panic::set_hook(before);
    match built {
        Ok(Ok(event_loop)) => Ok(event_loop),
        Ok(Err(why)) => Err(WindowError::of_display(&format!("{why:?}"), set)),
        Err(panic) => {
            let text = panic.downcast_ref::<String>().cloned();
            let text = text.or_else(|| panic.downcast_ref::<&str>().map(|&s| s.to_owned()));
            Err(WindowError::of_display(&text.unwrap_or_default(), set))
        }
    }
}

/// The whole of a program that shows a window: [`run`], and what is said at the end. `name`: what
/// is typed to go on, before the directory; `ready` is called when the scene has been read: before,
/// there is nothing that a signal could cost.
pub fn program(
    arguments: &WindowArguments,
    options: Options,
    stop: &Arc<AtomicBool>,
    name: &str,
    ready: impl FnOnce(),
) -> ExitCode {
    // A terminal that has gone away ends nothing.
    let say = |text: String| {
        let _ = writeln!(std::io::stderr(), "{}", visible(&text));
    };
    let go_on = |kept: Option<&PathBuf>| {
        if let Some(path) = kept {
            let path = quote(path);
            say(format!(
                "go on from where you left it with\n    {name} {path}"
            ));
        }
    };
    match run(arguments, options, Arc::clone(stop), ready) {
        Ok(kept) => {
            go_on(kept.as_ref());
            if stop.load(Ordering::Relaxed) {
                ExitCode::from(INTERRUPTED)
            } else {
                ExitCode::SUCCESS
            }
        }
        Err(why) => {
            let text = why.to_string();
            // The messages about scenes are complete, with their own "error:".
            let head = if text.starts_with("error:") {
                ""
            } else {
                "error: "
            };
            say(format!("{head}{}", text.trim_end()));
            if let WindowError::Defect(_, kept) = &why {
                go_on(kept.as_ref());
            }
            ExitCode::from(why.code())
        }
    }
}
