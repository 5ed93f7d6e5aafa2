//! The window itself: events in, pixels out.

use super::compose::{compose, compose_on};
use super::error::WindowError;
use super::input;
use super::log::Log;
use super::message::{Button, Effect, Message, Mouse};
use super::state::State;
use super::update::update;
use crate::face::{Kept, Request, choices, new_picture};
use crate::picture::Picture;
use crate::png;
use crate::raster::Pixels;
use loschmidt_runner::deck::{Command, Opening, Report, Wishes};
use loschmidt_runner::output::free_directory;
use loschmidt_runner::{Deck, Options};
use softbuffer::{Context, Surface};
use std::io::BufWriter;
use std::num::NonZeroU32;
use std::path::{Path, PathBuf};
use std::rc::Rc;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::time::{Duration, Instant};
use winit::application::ApplicationHandler;
use winit::dpi::LogicalSize;
use winit::event::{ElementState, MouseButton, MouseScrollDelta, StartCause, WindowEvent};
use winit::event_loop::{ActiveEventLoop, ControlFlow, EventLoopProxy, OwnedDisplayHandle};
use winit::keyboard::ModifiersState;
use winit::window::{Window, WindowId};

/// Between two looks at the signals.
const LOOK_UP: Duration = Duration::from_millis(50);

/// A step is waited for so long when the state is kept at the end.
const PATIENCE: Duration = Duration::from_secs(60);

/// Pictures a second that are asked for.
const FRAMES: u32 = 60;

/// Pixels of a touchpad that make a notch of a wheel.
const NOTCH: f64 = 40.0;

/// A report came: there is something in the inbox.
#[derive(Debug)]
pub struct Wake;

/// What the window draws on.
struct Canvas {
    window: Rc<Window>,
    surface: Surface<OwnedDisplayHandle, Rc<Window>>,
    title: String,
}

/// The window and what it has at hand.
pub struct App {
    state: State,
    options: Options,
    deck: Option<Deck>,
    /// Decks opened so far: the number of the last one.
    decks: u64,
    sender: Sender<(u64, Report)>,
    inbox: Receiver<(u64, Report)>,
    proxy: EventLoopProxy<Wake>,
    display: OwnedDisplayHandle,
    canvas: Option<Canvas>,
    /// A picture came that has not been drawn.
    pictured: bool,
    modifiers: ModifiersState,
    pointer: [f64; 2],
    began: Instant,
    stop: Arc<AtomicBool>,
    log: Log,
    /// Why it ends.
    error: Option<WindowError>,
}

impl App {
    pub fn new(
        state: State,
        options: Options,
        (proxy, display): (EventLoopProxy<Wake>, OwnedDisplayHandle),
        stop: Arc<AtomicBool>,
        log: bool,
    ) -> Self {
        let (sender, inbox) = channel();
        Self {
            state,
            options,
            deck: None,
            decks: 0,
            sender,
            inbox,
            proxy,
            display,
            canvas: None,
            pictured: false,
            modifiers: ModifiersState::empty(),
            pointer: [0.0; 2],
            began: Instant::now(),
            stop,
            log: Log::new(log),
            error: None,
        }
    }

    /// Opens what was asked for, in the place of what is open.
    pub fn open(&mut self, request: Request, opening: Opening) {
        // The old one ends first: two of them may not fit into memory.
        self.deck = None;
        self.pictured = false;
        self.decks += 1;
        let number = self.decks;
        let run = opening
            .recorded
            .as_ref()
            .map(|recorded| Kept::recorded(PathBuf::from(&request.name), recorded));
        let wishes = Wishes {
            frames: FRAMES,
            beside: request.beside,
        };
        self.take(Message::Opening(number, request));
        self.state.kept = run;
        let (sender, proxy) = (self.sender.clone(), self.proxy.clone());
        let report = move |report| {
            // A window that has gone needs nothing.
            let _ = sender.send((number, report));
            let _ = proxy.send_event(Wake);
        };
        match Deck::open_with(opening, wishes, report) {
            Ok(deck) => self.deck = Some(deck),
            Err(why) => self.take(Message::NotOpened(format!("cannot start a thread: {why}"))),
        }
    }

    /// Takes a message, does what is asked for then, and has the window drawn.
    fn take(&mut self, message: Message) {
        for effect in update(&mut self.state, message) {
            self.carry_out(effect);
        }
        self.refresh();
    }

    fn refresh(&mut self) {
        let Some(canvas) = &mut self.canvas else {
            return;
        };
        let title = self.state.title();
        if title != canvas.title {
            canvas.window.set_title(&title);
            canvas.title = title;
        }
        canvas.window.request_redraw();
    }

    fn carry_out(&mut self, effect: Effect) {
        match effect {
            Effect::Deck(command) => {
                if let Some(deck) = &self.deck {
                    deck.send(command);
                }
            }
            Effect::Open(request) => match request.opening(self.options) {
                Ok(opening) => self.open(request, opening),
                Err(why) => {
                    let why = why.to_string();
                    let why = why.strip_prefix("error: ").unwrap_or(&why).to_owned();
                    self.take(Message::NotOpened(why));
                }
            },
            Effect::List => self.take(Message::Choices(choices())),
            Effect::Picture => {
                let result = self.picture();
                match &result {
                    Ok(path) => self.log.say(&format!("picture {}", path.display())),
                    Err(why) => self.log.say(&format!("no picture: {why}")),
                }
                self.take(Message::Pictured(result));
            }
            Effect::Keep => self.keep(),
            Effect::Quit => self.state.leaving = true,
        }
    }

    /// Writes the pixels of the window.
    fn picture(&self) -> Result<PathBuf, String> {
        let raster = compose(&self.state, self.state.size);
        let name = match &self.state.stage {
            Some(stage) => format!("{}-step-{:06}", stage.home.name, stage.points.step),
            None => "loschmidt".to_owned(),
        };
        let (file, path) = new_picture(&name).map_err(|e| format!("no picture: {e}"))?;
        png::write(&raster, BufWriter::new(file))
            .map_err(|e| format!("cannot write {}: {e}", path.display()))?;
        Ok(path)
    }

    /// Has the state kept in a new directory: what was kept before stays as it was.
    fn keep(&mut self) {
        let (Some(stage), Some(deck)) = (&self.state.stage, &self.deck) else {
            return;
        };
        deck.send(Command::Keep {
            path: free_directory(&stage.home.name),
            rows: stage.ways.track.rows(),
        });
    }

    /// Hears what the deck said.
    fn listen(&mut self) {
        while let Ok((number, report)) = self.inbox.try_recv() {
            if number != self.state.deck {
                continue;
            }
            self.log.report(&report);
            self.pictured |= matches!(report, Report::Shot(_));
            self.take(Message::Report(number, Box::new(report)));
        }
    }

    /// Draws, and lets the next picture come.
    fn draw(&mut self) {
        let Some(canvas) = &mut self.canvas else {
            return;
        };
        let began = Instant::now();
        let shown = show(canvas, &self.state, self.deck.as_ref());
        if let Err(why) = shown {
            self.error = Some(WindowError::Display(why));
            self.state.leaving = true;
        }
        self.log.drawn(&self.state, began.elapsed());
        if let (true, Some(deck)) = (std::mem::take(&mut self.pictured), &self.deck) {
            deck.ready();
        }
    }

    /// Reads a picture to tint the fluid with.
    fn tint(&mut self, path: &Path) {
        let picture = Picture::open(path).map_err(|why| why.to_string());
        self.take(Message::Tint(picture));
    }

    fn create(&mut self, event_loop: &ActiveEventLoop) -> Result<Canvas, WindowError> {
        let (width, height) = self.state.size;
        let attributes = Window::default_attributes()
            .with_title(self.state.title())
            .with_inner_size(LogicalSize::new(width as f64, height as f64))
            .with_min_inner_size(LogicalSize::new(320.0, 240.0));
        let of_display =
            |why: &dyn std::fmt::Debug| WindowError::of_display(&format!("{why:?}"), true);
        let window = event_loop
            .create_window(attributes)
            .map_err(|why| of_display(&why))?;
        let window = Rc::new(window);
        let context = Context::new(self.display.clone()).map_err(|why| of_display(&why))?;
        let surface = Surface::new(&context, Rc::clone(&window)).map_err(|why| of_display(&why))?;
        Ok(Canvas {
            window,
            surface,
            title: self.state.title(),
        })
    }

    fn resized(&mut self) {
        let Some(canvas) = &self.canvas else { return };
        let size = canvas.window.inner_size();
        let scale = canvas.window.scale_factor();
        let (width, height) = (size.width as usize, size.height as usize);
        if (width, height, scale) != (self.state.size.0, self.state.size.1, self.state.scale) {
            self.log
                .say(&format!("size {width}x{height} scale {scale}"));
        }
        self.take(Message::Resized(width, height, scale));
    }

    /// Keeps what would be lost; the directory to go on from, where there is something to go on with.
    pub fn keep_at_the_end(&mut self) -> Result<Option<PathBuf>, WindowError> {
        if let Some(error) = self.error.take() {
            return Err(error);
        }
        self.canvas = None;
        if let Some(deck) = &self.deck {
            deck.send(Command::Play(false));
        }
        self.settle();
        if self.state.unsaved() {
            self.keep();
            let end = Instant::now() + PATIENCE;
            loop {
                match self.next(end) {
                    Some(Report::Kept(path)) => return Ok(Some(path)),
                    Some(Report::NotKept(why)) => return Err(WindowError::Lost(why)),
                    Some(_) => {}
                    None => {
                        let why = "the simulation does not answer";
                        return Err(WindowError::Lost(why.to_owned()));
                    }
                }
            }
        }
        let stage = self.state.stage.as_ref();
        let on_the_way = stage.is_some_and(|stage| stage.status.position != 0);
        let kept = self.state.kept.as_ref().filter(|_| on_the_way);
        Ok(kept.map(|kept| kept.path.clone()))
    }

    /// Hears the last reports, so that the state is the one that the simulation stands at.
    fn settle(&mut self) {
        let end = Instant::now() + PATIENCE;
        let moves = |state: &State| {
            let stage = state.stage.as_ref();
            stage.is_some_and(|s| s.status.playing || s.status.seek.is_some())
        };
        while moves(&self.state) {
            let Some(report) = self.next(end) else { return };
            let number = self.state.deck;
            update(&mut self.state, Message::Report(number, Box::new(report)));
        }
    }

    /// The next report of the present deck.
    fn next(&self, end: Instant) -> Option<Report> {
        loop {
            let wait = end.saturating_duration_since(Instant::now());
            let (number, report) = self.inbox.recv_timeout(wait).ok()?;
            if number == self.state.deck {
                return Some(report);
            }
        }
    }
}

/// The pixels of the state on the surface.
fn show(canvas: &mut Canvas, state: &State, deck: Option<&Deck>) -> Result<(), String> {
    let (width, height) = state.size;
    let size = |n: usize| u32::try_from(n).ok().and_then(NonZeroU32::new);
    // A window that is rolled up has no pixels.
    let (Some(w), Some(h)) = (size(width), size(height)) else {
        return Ok(());
    };
    let surface = &mut canvas.surface;
    surface.resize(w, h).map_err(|why| why.to_string())?;
    let mut buffer = surface.buffer_mut().map_err(|why| why.to_string())?;
    let Some(mut pixels) = Pixels::new(width, height, &mut buffer) else {
        return Err("the surface has another size".to_owned());
    };
    match deck {
        Some(deck) => deck.install(|| compose_on(&mut pixels, state)),
        None => compose_on(&mut pixels, state),
    }
    buffer.present().map_err(|why| why.to_string())
}

impl ApplicationHandler<Wake> for App {
    fn new_events(&mut self, event_loop: &ActiveEventLoop, _: StartCause) {
        let had_notice = self.state.notice.is_some();
        update(&mut self.state, Message::Tick(self.began.elapsed()));
        if had_notice && self.state.notice.is_none() {
            self.refresh();
        }
        if self.stop.load(Ordering::Relaxed) {
            self.state.leaving = true;
        }
        if self.state.leaving {
            event_loop.exit();
        }
    }

    fn resumed(&mut self, event_loop: &ActiveEventLoop) {
        if self.canvas.is_some() {
            return;
        }
        match self.create(event_loop) {
            Ok(canvas) => {
                self.canvas = Some(canvas);
                self.log.say("window opened");
                self.resized();
            }
            Err(why) => {
                self.error = Some(why);
                event_loop.exit();
            }
        }
    }

    fn user_event(&mut self, _: &ActiveEventLoop, _: Wake) {
        self.listen();
    }

    fn window_event(&mut self, event_loop: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        match event {
            WindowEvent::CloseRequested | WindowEvent::Destroyed => self.state.leaving = true,
            WindowEvent::RedrawRequested => self.draw(),
            WindowEvent::Resized(_) | WindowEvent::ScaleFactorChanged { .. } => self.resized(),
            WindowEvent::ModifiersChanged(modifiers) => self.modifiers = modifiers.state(),
            WindowEvent::KeyboardInput { event, .. } if event.state == ElementState::Pressed => {
                let (control, shift) = (self.modifiers.control_key(), self.modifiers.shift_key());
                if let Some(key) = input::key(&event.logical_key, control, shift) {
                    self.take(Message::Key(key));
                }
            }
            WindowEvent::CursorMoved { position, .. } => {
                self.pointer = [position.x, position.y];
                if self.state.drag.is_some() {
                    self.take(Message::Mouse(Mouse::Move, self.pointer));
                }
            }
            WindowEvent::MouseInput { state, button, .. } => {
                let button = match button {
                    MouseButton::Left => Button::Left,
                    MouseButton::Right | MouseButton::Middle => Button::Right,
                    _ => return,
                };
                let mouse = match state {
                    ElementState::Pressed => Mouse::Press(button),
                    ElementState::Released => Mouse::Release,
                };
                self.take(Message::Mouse(mouse, self.pointer));
            }
            WindowEvent::MouseWheel { delta, .. } => {
                let notches = match delta {
                    MouseScrollDelta::LineDelta(_, lines) => f64::from(lines),
                    MouseScrollDelta::PixelDelta(pixels) => pixels.y / NOTCH,
                };
                self.take(Message::Mouse(Mouse::Wheel(notches), self.pointer));
            }
            WindowEvent::DroppedFile(path) => self.tint(&path),
            _ => {}
        }
        if self.state.leaving {
            event_loop.exit();
        }
    }

    fn about_to_wait(&mut self, event_loop: &ActiveEventLoop) {
        event_loop.set_control_flow(ControlFlow::WaitUntil(Instant::now() + LOOK_UP));
    }
}
