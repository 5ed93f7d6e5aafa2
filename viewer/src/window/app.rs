//! The window itself: events in, pixels out.

use super::compose::{compose, compose_on};
use super::error::WindowError;
use super::input;
use super::log::Log;
use super::message::WindowMessage;
use super::state::WindowState;
use super::update::update;
use crate::picture::Picture;
use crate::png;
use crate::raster::Pixels;
use crate::session::{Button, Effect, Host, Message, Mouse, Request, new_picture};
use loschmidt_runner::deck::{Opening, Report};
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

/// How often the signals are looked at.
const LOOK_UP: Duration = Duration::from_millis(50);

/// Pictures a second that are asked for.
const FRAMES: u32 = 60;

/// Pixels of a touchpad that make a notch of a wheel.
const NOTCH: f64 = 40.0;

/// A report came: there is something in the inbox.
#[derive(Debug)]
pub struct Wake;

/// What the window draws on.
struct OpenWindow {
    window: Rc<Window>,
    surface: Surface<OwnedDisplayHandle, Rc<Window>>,
    title: String,
}

/// The window and what it has at hand.
pub struct App {
    state: WindowState,
    host: Host,
    sender: Sender<(u64, Report)>,
    inbox: Receiver<(u64, Report)>,
    proxy: EventLoopProxy<Wake>,
    display: OwnedDisplayHandle,
    canvas: Option<OpenWindow>,
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
        state: WindowState,
        options: Options,
        (proxy, display): (EventLoopProxy<Wake>, OwnedDisplayHandle),
        stop: Arc<AtomicBool>,
        log: bool,
    ) -> Self {
        let (sender, inbox) = channel();
        Self {
            state,
            host: Host::new(options, FRAMES),
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
        let report = self.reporter();
        self.host
            .open(&mut self.state.session, request, opening, report);
    }

    /// What passes the reports of a deck on, with its number.
    fn reporter(&self) -> impl Fn(u64, Report) + Send + use<> {
        let (sender, proxy) = (self.sender.clone(), self.proxy.clone());
        move |number, report| {
            // Once the window has ended nobody reads reports.
            let _ = sender.send((number, report));
            let _ = proxy.send_event(Wake);
        }
    }

    /// Takes a message, does what is asked for then, and has the window drawn.
    fn take(&mut self, message: impl Into<WindowMessage>) {
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
        if effect == Effect::Picture {
            let result = self.picture();
            match &result {
                Ok(path) => self.log.say(&format!("picture {}", path.display())),
                Err(why) => self.log.say(&format!("no picture: {why}")),
            }
            self.take(Message::Pictured(result));
        } else {
            let report = self.reporter();
            self.host.carry_out(&mut self.state.session, effect, report);
        }
    }

    /// Writes the pixels of the window.
    fn picture(&self) -> Result<PathBuf, String> {
        let raster = compose(&self.state, self.state.size);
        let name = match &self.state.session.stage {
            Some(stage) => format!("{}-step-{:06}", stage.home.name, stage.points.step),
            None => "loschmidt".to_owned(),
        };
        let (file, path) = new_picture(&name).map_err(|e| format!("no picture: {e}"))?;
        png::write(&raster, BufWriter::new(file))
            .map_err(|e| format!("cannot write {}: {e}", path.display()))?;
        Ok(path)
    }

    /// Hears what the deck said.
    fn listen(&mut self) {
        while let Ok((number, report)) = self.inbox.try_recv() {
            if number != self.state.session.deck {
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
        let shown = show(canvas, &self.state, self.host.deck());
        if let Err(why) = shown {
            self.error = Some(WindowError::Display(why));
            self.state.session.leaving = true;
        }
        self.log.drawn(&self.state, began.elapsed());
        if let (true, Some(deck)) = (std::mem::take(&mut self.pictured), self.host.deck()) {
            deck.ready();
        }
    }

    /// Reads a picture to tint the fluid with.
    fn tint(&mut self, path: &Path) {
        let picture = Picture::open(path).map_err(|why| why.to_string());
        self.take(Message::Tint(picture));
    }

    fn create(&mut self, event_loop: &ActiveEventLoop) -> Result<OpenWindow, WindowError> {
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
        Ok(OpenWindow {
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
        self.take(WindowMessage::Resized(width, height, scale));
    }

    /// Keeps what would be lost; the directory to go on from, where there is something to go on
    /// with. `failed`: the window has not ended well.
    pub fn keep_at_the_end(&mut self, failed: bool) -> Result<Option<PathBuf>, WindowError> {
        if let Some(error) = self.error.take() {
            return Err(error);
        }
        self.canvas = None;
        let (inbox, present) = (&self.inbox, self.state.session.deck);
        let next = |end: Instant| loop {
            let wait = end.saturating_duration_since(Instant::now());
            let (number, report) = inbox.recv_timeout(wait).ok()?;
            if number == present {
                return Some(report);
            }
        };
        let cut_short = failed || self.stop.load(Ordering::Relaxed);
        let session = &mut self.state.session;
        Ok(self.host.keep_at_the_end(session, cut_short, next)?)
    }
}

/// The pixels of the state on the surface.
fn show(canvas: &mut OpenWindow, state: &WindowState, deck: Option<&Deck>) -> Result<(), String> {
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
        let had_notice = self.state.session.notice.is_some();
        update(&mut self.state, Message::Tick(self.began.elapsed()));
        if had_notice && self.state.session.notice.is_none() {
            self.refresh();
        }
        if self.stop.load(Ordering::Relaxed) {
            self.state.session.leaving = true;
        }
        if self.state.session.leaving {
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
            WindowEvent::CloseRequested | WindowEvent::Destroyed => {
                self.state.session.leaving = true
            }
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
                if self.state.session.drag.is_some() {
                    self.take(WindowMessage::Mouse(Mouse::Move, self.pointer));
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
                self.take(WindowMessage::Mouse(mouse, self.pointer));
            }
            WindowEvent::MouseWheel { delta, .. } => {
                let notches = match delta {
                    MouseScrollDelta::LineDelta(_, lines) => f64::from(lines),
                    MouseScrollDelta::PixelDelta(pixels) => pixels.y / NOTCH,
                };
                self.take(WindowMessage::Mouse(Mouse::Wheel(notches), self.pointer));
            }
            WindowEvent::DroppedFile(path) => self.tint(&path),
            _ => {}
        }
        if self.state.session.leaving {
            event_loop.exit();
        }
    }

    fn about_to_wait(&mut self, event_loop: &ActiveEventLoop) {
        event_loop.set_control_flow(ControlFlow::WaitUntil(Instant::now() + LOOK_UP));
    }
}
