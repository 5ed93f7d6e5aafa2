//! The program on a terminal of its own: what it writes is shown, and what a user types is sent.

use portable_pty::{Child, CommandBuilder, MasterPty, PtySize, native_pty_system};
use std::io::{Read, Write};
use std::num::NonZeroU16;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

/// A terminal with the program on it.
pub struct PseudoTerminal {
    master: Box<dyn MasterPty + Send>,
    keys: Box<dyn Write + Send>,
    child: Box<dyn Child + Send + Sync>,
    parser: Arc<Mutex<vt100::Parser>>,
    before: String,
    /// Nobody looks at the screen any more.
    closed: Arc<AtomicBool>,
}

/// The program with these arguments, on a terminal of so many columns and rows.
pub fn start(
    directory: &Path,
    arguments: &[&str],
    environment: &[(&str, &str)],
    (cols, rows): (u16, u16),
) -> PseudoTerminal {
    let size = PtySize {
        rows,
        cols,
        pixel_width: 0,
        pixel_height: 0,
    };
    let pair = native_pty_system().openpty(size).expect("a terminal");
    let mut command = CommandBuilder::new(env!("CARGO_BIN_EXE_loschmidt"));
    command.args(arguments);
    command.cwd(directory);
    for name in ["NO_COLOR", "COLORTERM"] {
        command.env_remove(name);
    }
    command.env("TERM", "xterm-256color");
    for (name, value) in environment {
        command.env(name, value);
    }
    let before = modes(&*pair.master);
    let child = pair.slave.spawn_command(command).expect("the program");
    drop(pair.slave);
    let parser = Arc::new(Mutex::new(vt100::Parser::new(cells(rows), cells(cols), 0)));
    let mut output = pair.master.try_clone_reader().expect("its output");
    let shown = Arc::clone(&parser);
    let closed = Arc::new(AtomicBool::new(false));
    let gone = Arc::clone(&closed);
    std::thread::spawn(move || {
        let mut bytes = [0; 1 << 16];
        while let Ok(n @ 1..) = output.read(&mut bytes) {
            shown.lock().expect("a parser").process(&bytes[..n]);
            if gone.load(Ordering::Relaxed) {
                return;
            }
        }
    });
    PseudoTerminal {
        keys: pair.master.take_writer().expect("its input"),
        master: pair.master,
        child,
        parser,
        before,
        closed,
    }
}

fn cells(n: u16) -> NonZeroU16 {
    NonZeroU16::new(n).expect("a cell at least")
}

/// The modes of the line: whether it is cooked or raw.
fn modes(master: &dyn MasterPty) -> String {
    format!("{:?}", master.get_termios().expect("modes"))
}

impl PseudoTerminal {
    /// What is on the screen.
    pub fn text(&self) -> String {
        self.parser.lock().expect("a parser").screen().contents()
    }

    /// Waits for words on the screen, a minute at most.
    pub fn wait_for(&self, words: &str) {
        let began = Instant::now();
        while !self.text().contains(words) {
            let late = began.elapsed() > Duration::from_secs(60);
            assert!(!late, "no {words:?} on\n{}", self.text());
            std::thread::sleep(Duration::from_millis(5));
        }
    }

    pub fn type_keys(&mut self, keys: &str) {
        self.keys.write_all(keys.as_bytes()).expect("a key");
        self.keys.flush().expect("a key");
    }

    pub fn resize(&mut self, cols: u16, rows: u16) {
        let size = PtySize {
            rows,
            cols,
            pixel_width: 0,
            pixel_height: 0,
        };
        let mut parser = self.parser.lock().expect("a parser");
        parser.screen_mut().set_size(cells(rows), cells(cols));
        drop(parser);
        self.master.resize(size).expect("a size");
    }

    /// Whether any cell has a colour.
    pub fn is_coloured(&self) -> bool {
        let parser = self.parser.lock().expect("a parser");
        let screen = parser.screen();
        let (rows, cols) = screen.size();
        let plain = vt100::Color::Default;
        (0..rows.get()).any(|row| {
            (0..cols.get()).any(|col| {
                let cell = screen.cell(row, col);
                cell.is_some_and(|c| c.fgcolor() != plain || c.bgcolor() != plain)
            })
        })
    }

    /// Takes the terminal away, as a window that is closed does; the exit code, in a minute at
    /// most.
    pub fn close(self) -> u32 {
        let mut child = self.child;
        self.closed.store(true, Ordering::Relaxed);
        drop(self.keys);
        drop(self.master);
        let began = Instant::now();
        loop {
            if let Some(status) = child.try_wait().expect("a status") {
                return status.exit_code();
            }
            if began.elapsed() > Duration::from_secs(60) {
                child.kill().expect("an end");
                panic!("the program outlives its terminal");
            }
            std::thread::sleep(Duration::from_millis(5));
        }
    }

    pub fn signal(&self, name: &str) {
        let id = self.child.process_id().expect("a process").to_string();
        let sent = std::process::Command::new("kill")
            .args([format!("-{name}"), id])
            .status();
        assert!(sent.expect("kill").success());
    }

    /// Waits until the program, which goes on, has left the terminal as it was.
    pub fn wait_until_given_back(&self) {
        let began = Instant::now();
        let is_back = || {
            let parser = self.parser.lock().expect("a parser");
            !parser.screen().alternate_screen() && modes(&*self.master) == self.before
        };
        while !is_back() {
            let late = began.elapsed() > Duration::from_secs(60);
            assert!(!late, "the terminal is not given back");
            std::thread::sleep(Duration::from_millis(5));
        }
    }

    /// Waits for the end of the program: its exit code, and that the terminal is as it was.
    pub fn ended_and_restored(&mut self) -> u32 {
        let code = self.child.wait().expect("an end").exit_code();
        // Its last words may still be on their way.
        let began = Instant::now();
        while self
            .parser
            .lock()
            .expect("a parser")
            .screen()
            .alternate_screen()
        {
            let late = began.elapsed() > Duration::from_secs(10);
            assert!(!late, "the alternate screen was not left");
            std::thread::sleep(Duration::from_millis(5));
        }
        std::thread::sleep(Duration::from_millis(100));
        let parser = self.parser.lock().expect("a parser");
        let screen = parser.screen();
        assert!(!screen.hide_cursor(), "the cursor is hidden");
        let mouse = screen.mouse_protocol_mode();
        assert_eq!(mouse, vt100::MouseProtocolMode::None);
        drop(parser);
        assert_eq!(modes(&*self.master), self.before);
        code
    }
}
