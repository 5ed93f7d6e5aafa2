//! The terminal: taken when the dashboard opens, and given back however it ends.

use super::keys;
use super::message::DashboardMessage;
use super::state::DashboardState;
use crossterm::event::{self, DisableMouseCapture, EnableMouseCapture};
use crossterm::terminal::{
    BeginSynchronizedUpdate, Clear, ClearType, EndSynchronizedUpdate, EnterAlternateScreen,
    LeaveAlternateScreen, SetTitle, disable_raw_mode, enable_raw_mode,
};
use crossterm::{cursor, execute, queue};
use loschmidt_runner::Deck;
use ratatui::backend::CrosstermBackend;
use std::io::{BufWriter, IsTerminal, Stdout, Write, stdout};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::Sender;
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// How often the thread that waits for keys looks whether it is still needed.
const LOOK_UP: Duration = Duration::from_millis(50);

/// A frame is handed to the terminal in one piece where it fits.
const BUFFER: usize = 1 << 18;

type Screen = ratatui::Terminal<CrosstermBackend<BufWriter<Stdout>>>;

/// Whether there is a terminal to draw on and to read keys from.
pub fn is_terminal() -> bool {
    let dumb = std::env::var("TERM").is_ok_and(|term| term == "dumb");
    std::io::stdin().is_terminal() && stdout().is_terminal() && !dumb
}

/// The terminal while the dashboard has it.
pub struct Terminal {
    /// `None` once the terminal is given back.
    screen: Option<Screen>,
    gone: Arc<AtomicBool>,
    listener: Option<JoinHandle<()>>,
}

impl Terminal {
    /// Takes the terminal; a panic of this thread gives it back before it is reported.
    pub fn enter() -> std::io::Result<Self> {
        let before = std::panic::take_hook();
        let ours = std::thread::current().id();
        std::panic::set_hook(Box::new(move |info| {
            // The threads of the simulation report by themselves; a message of theirs would be
            // written over the screen.
            if std::thread::current().id() == ours {
                restore();
                before(info);
            }
        }));
        let entered = take();
        let writer = BufWriter::with_capacity(BUFFER, stdout());
        let screen = entered.and_then(|()| Screen::new(CrosstermBackend::new(writer)));
        match screen {
            Ok(screen) => Ok(Self {
                screen: Some(screen),
                gone: Arc::new(AtomicBool::new(false)),
                listener: None,
            }),
            Err(error) => {
                restore();
                Err(error)
            }
        }
    }

    /// Columns and rows.
    pub fn size(&self) -> std::io::Result<(u16, u16)> {
        crossterm::terminal::size()
    }

    /// Takes the terminal again, which others had meanwhile.
    pub fn retake(&mut self) -> std::io::Result<()> {
        // What was raw is not made so again without this.
        disable_raw_mode()?;
        take()?;
        if let Some(screen) = &mut self.screen {
            // Nothing of what was drawn is there any more. (`Terminal::clear` would ask the
            // terminal where its cursor is, and the thread that waits for keys would hear the
            // answer.)
            execute!(screen.backend_mut(), Clear(ClearType::All))?;
            screen.swap_buffers();
        }
        Ok(())
    }

    /// Sends what the keyboard, the mouse and the window's frame say, from a thread of its own.
    pub fn listen(&mut self, sender: Sender<DashboardMessage>) {
        let gone = Arc::clone(&self.gone);
        let listen = move || {
            while !gone.load(Ordering::Relaxed) {
                match event::poll(LOOK_UP) {
                    Ok(false) => {}
                    Ok(true) => {
                        let Ok(event) = event::read() else { return };
                        let Some(message) = keys::message(event) else {
                            continue;
                        };
                        if sender.send(message).is_err() {
                            return;
                        }
                    }
                    Err(_) => return,
                }
            }
        };
        self.listener = Some(std::thread::spawn(listen));
    }

    /// Draws the state, in one piece where the terminal can.
    pub fn draw(&mut self, state: &DashboardState, deck: Option<&Deck>) -> std::io::Result<()> {
        let Some(screen) = &mut self.screen else {
            return Ok(());
        };
        queue!(screen.backend_mut(), BeginSynchronizedUpdate)?;
        screen.draw(|frame| match deck {
            Some(deck) => deck.install(|| frame.render_widget(state, frame.area())),
            None => frame.render_widget(state, frame.area()),
        })?;
        queue!(screen.backend_mut(), EndSynchronizedUpdate)?;
        Write::flush(screen.backend_mut())
    }
}

impl Drop for Terminal {
    fn drop(&mut self) {
        self.gone.store(true, Ordering::Relaxed);
        // Where the terminal has gone, reading from it may never end: the thread is then left
        // alone, and ends with the program.
        let end = Instant::now() + 6 * LOOK_UP;
        if let Some(listener) = self.listener.take() {
            while !listener.is_finished() && Instant::now() < end {
                std::thread::sleep(Duration::from_millis(2));
            }
        }
        if let Some(mut screen) = self.screen.take()
            && screen.show_cursor().is_err()
        {
            // Dropping it would write an error to a terminal that has gone, and panic.
            std::mem::forget(screen);
        }
        restore();
    }
}

/// Takes the terminal.
fn take() -> std::io::Result<()> {
    enable_raw_mode()?;
    execute!(
        stdout(),
        EnterAlternateScreen,
        EnableMouseCapture,
        cursor::Hide,
        SetTitle("loschmidt")
    )
}

/// Gives the terminal back. Errors mean that it has gone, and are left out.
pub fn restore() {
    let _ = disable_raw_mode();
    let _ = execute!(
        stdout(),
        EndSynchronizedUpdate,
        DisableMouseCapture,
        LeaveAlternateScreen,
        cursor::Show
    );
}
