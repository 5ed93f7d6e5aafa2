//! The picture of the window in the README: fixed beside floating point on the way back, without a
//! display.
//!
//!     cargo run --release -p loschmidt-viewer --example window -- examples/pictures/window.png

use loschmidt_runner::deck::{Command, Opening, Report, Wishes};
use loschmidt_runner::{Deck, Options};
use loschmidt_viewer::session::{Message, Request};
use loschmidt_viewer::window::{WindowState, compose, update};
use loschmidt_viewer::{Look, Picture, png};
use std::error::Error;
use std::fs::File;
use std::io::BufWriter;
use std::path::Path;
use std::sync::mpsc::channel;

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args().nth(1).ok_or("a PNG to write")?;
    let request = Request {
        name: "dam-break".to_owned(),
        set: vec!["particle_spacing=0.02".to_owned()],
        beside: true,
        ..Request::default()
    };
    let tint = Picture::open(Path::new("examples/pictures/hourglass.png"))?;
    let mut state = WindowState::new((1280, 720), 1.0, Look::default(), Some(tint));
    let opening = Opening::of(&request.name, &request.set, Options::default())?;
    let (sender, inbox) = channel();
    let wishes = Wishes {
        beside: true,
        ..Wishes::default()
    };
    let deck = Deck::open_with(opening, wishes, move |report| drop(sender.send(report)))?;
    update(&mut state, Message::Opening(1, request));
    deck.send(Command::Pace(0.03));
    // Out to the turnaround, and most of the way back.
    deck.send(Command::Seek(10_000));
    let mut turned = false;
    for report in inbox {
        let ended = matches!(report, Report::SeekEnded(_));
        let shot = matches!(report, Report::Shot(_));
        update(&mut state, Message::Report(1, Box::new(report)));
        if shot {
            deck.ready();
        }
        let position = state
            .session
            .stage
            .as_ref()
            .map_or(0, |stage| stage.points.step);
        if ended && !turned {
            turned = true;
            deck.send(Command::Turn);
            deck.send(Command::Seek(150));
        } else if shot && turned && position == 150 {
            break;
        }
    }
    state.session.notice = None;
    let raster = compose(&state, state.size);
    png::write(&raster, BufWriter::new(File::create(path)?))?;
    Ok(())
}
