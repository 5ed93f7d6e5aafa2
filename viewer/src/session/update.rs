//! How the session changes, and what is asked for: without a clock, a file or a screen.

use super::kept::Kept;
use super::list::List;
use super::message::{Effect, Message};
use super::notice::{Tone, meddled, turned};
use super::panel::Panel;
use super::pointer::Drag;
use super::request::{Answer, Request};
use super::stage::StagedScene;
use super::state::{Overlay, Session};
use crate::camera::View;
use crate::colouring::Colouring;
use crate::keys::{Action, Key};
use crate::picture::Picture;
use loschmidt_core::Reversibility;
use loschmidt_runner::deck::{Beside, Command, Opened, Report, faster, slower};
use loschmidt_runner::plain::visible;
use loschmidt_runner::{ArithmeticKind, Points};
use std::sync::Arc;

/// Changes the session; returns what is to be done.
pub fn update(session: &mut Session, message: Message) -> Vec<Effect> {
    match message {
        Message::Key(key) => return on_key(session, key),
        Message::Report(deck, report) if deck == session.deck => {
            return reuse(on_report(session, *report));
        }
        // An earlier deck says nothing that matters any more.
        Message::Report(..) => {}
        Message::Tick(now) => {
            session.now = now;
            session.notice.take_if(|notice| notice.until < now);
        }
        Message::Choices(choices) => {
            session.overlay = Overlay::Scenes(List::new(choices, &session.request));
        }
        Message::Pictured(Ok(path)) => {
            session.tell(Tone::Done, format!("picture: {}", path.display()));
        }
        Message::Pictured(Err(why)) | Message::Tint(Err(why)) => session.tell(Tone::Refused, why),
        Message::Tint(Ok(picture)) => tint(session, picture),
        Message::NotOpened(why) => not_opened(session, why),
        Message::Opening(deck, request) => {
            session.deck = deck;
            session.request = request;
            session.stage = None;
            session.banner = None;
            session.overlay = Overlay::None;
            session.notice = None;
            session.kept = None;
            session.acted = false;
            session.drag = None;
            session.look.view = View::default();
        }
    }
    Vec::new()
}

/// The next picture is made in the memory of the one before.
fn reuse(points: Option<Points>) -> Vec<Effect> {
    let effect = |points| Effect::Deck(Command::Reuse(Box::new(points)));
    points.map(effect).into_iter().collect()
}

/// Tints the fluid with a picture, and that of scenes that are opened later.
fn tint(session: &mut Session, picture: Picture) {
    if let Some(stage) = &mut session.stage {
        let colours = picture.tint(&stage.home).into();
        session.look.colouring = Colouring::Picture(Arc::clone(&colours));
        stage.tint = Some(colours);
    }
    session.picture = Some(picture);
}

/// Says why something could not be opened, where the user looks.
fn not_opened(session: &mut Session, why: String) {
    let why = visible(&why).into_owned();
    match &mut session.overlay {
        Overlay::Parameters(panel) => panel.problem = Some(why),
        overlay if session.stage.is_none() => *overlay = Overlay::Error(why),
        overlay => {
            *overlay = Overlay::None;
            session.tell(Tone::Refused, why.lines().next().unwrap_or_default());
        }
    }
}

/// Shows a scene that was set up.
fn opened(session: &mut Session, opened: Box<Opened>) {
    let stage = StagedScene::new(opened, session.request.beside, session.picture.as_ref());
    // The colours of a picture belong to the particles of one scene.
    match (&stage.tint, &session.look.colouring) {
        (Some(tint), _) => session.look.colouring = Colouring::Picture(Arc::clone(tint)),
        (None, Colouring::Picture(_)) => session.look.colouring = Colouring::default(),
        _ => {}
    }
    session.stage = Some(stage);
}

/// Takes a report into the session; the picture that a new one has replaced.
fn on_report(session: &mut Session, report: Report) -> Option<Points> {
    match report {
        Report::Opened(scene) => {
            opened(session, scene);
            return None;
        }
        Report::Failed(why) => {
            session.stage = None;
            session.overlay = Overlay::Error(visible(&why).into_owned());
            return None;
        }
        _ => {}
    }
    let Some(stage) = &mut session.stage else {
        return None;
    };
    match report {
        Report::Opened(_) | Report::Failed(_) => {}
        Report::Shot(shot) => {
            stage.status = shot.status;
            let before = std::mem::replace(&mut stage.points, shot.points);
            // Who has chosen a part of the scene keeps it.
            if session.look.view.is_of_the_whole() {
                stage.follow();
            }
            return Some(before);
        }
        Report::Status(status) => {
            // A drag goes on wanting; the wish of a key or a click is under way now.
            if !matches!(session.drag, Some(Drag::Bar(_))) {
                stage.wanted = None;
            }
            stage.status = status;
        }
        Report::Moment(moment) => stage.note(moment),
        Report::Beside(beside) => {
            let ended = match &beside {
                Beside::Ended(fault) => Some(fault.to_string()),
                _ => None,
            };
            stage.hear(beside);
            if let Some(fault) = ended {
                let text = format!("the other arithmetic's numbers ended: {fault}");
                session.tell(Tone::Warning, text);
            }
        }
        Report::Turned(arrow) => {
            stage.turning = false;
            stage.status.arrow = arrow;
            let (tone, text) = turned(arrow, stage.status.arithmetic);
            session.tell(tone, text);
        }
        Report::Meddled(meddling) => {
            let text = meddled(&meddling, stage.opened.length_quantum, session.face);
            session.tell(Tone::Warning, text);
        }
        Report::Arrived(arrival) => session.banner = Some(arrival),
        Report::SeekEnded(true) => {}
        Report::SeekEnded(false) => session.tell(Tone::Done, "stopped on the way"),
        Report::Refused(why) => {
            stage.turning = false;
            stage.wanted = None;
            session.tell(Tone::Refused, why.to_string());
        }
        Report::Fault(fault) => {
            let text = format!("the numbers ended: {fault}; this is the last good state");
            session.tell(Tone::Refused, text);
        }
        Report::Kept(path) => {
            let text = session.face.kept(&path);
            session.kept = Some(Kept::new(path, &stage.status));
            session.tell(Tone::Done, text);
        }
        Report::NotKept(why) => session.tell(Tone::Refused, why),
    }
    None
}

fn on_key(session: &mut Session, key: Key) -> Vec<Effect> {
    if key == Key::Ctrl('c') {
        return vec![Effect::Quit];
    }
    let action = session.face.action(key);
    match &mut session.overlay {
        Overlay::None => {}
        Overlay::Help => {
            session.overlay = Overlay::None;
            return match action {
                Some(Action::Quit) => vec![Effect::Quit],
                _ => Vec::new(),
            };
        }
        Overlay::Scenes(list) => {
            let answer = list.key(key, &session.request);
            return answered(session, answer);
        }
        Overlay::Parameters(panel) => {
            let answer = panel.key(key, &session.request);
            return answered(session, answer);
        }
        Overlay::Error(_) => {
            return match action {
                Some(Action::Quit) => vec![Effect::Quit],
                Some(Action::Scenes) => vec![Effect::List],
                _ => Vec::new(),
            };
        }
    }
    if session.banner.take().is_some() && matches!(action, Some(Action::Play | Action::Cancel)) {
        // These were for the banner; others close it and do what they always do.
        return Vec::new();
    }
    action.map_or_else(Vec::new, |action| on_action(session, action))
}

/// Does what a key in a list or a panel leads to.
fn answered(session: &mut Session, answer: Answer) -> Vec<Effect> {
    match answer {
        Answer::Stay => {}
        // Without a scene behind it something must stay that tells how to go on.
        Answer::Close if session.stage.is_none() => {
            session.overlay = Overlay::Error("nothing is open".to_owned());
        }
        Answer::Close => session.overlay = Overlay::None,
        Answer::Open(request) => return vec![Effect::Open(request)],
        Answer::Quit => return vec![Effect::Quit],
    }
    Vec::new()
}

fn on_action(session: &mut Session, action: Action) -> Vec<Effect> {
    match action {
        Action::Quit => return vec![Effect::Quit],
        Action::Scenes => return vec![Effect::List],
        Action::Help => {
            session.overlay = Overlay::Help;
            return Vec::new();
        }
        _ => {}
    }
    if session.look_otherwise(action) {
        return Vec::new();
    }
    let Some(stage) = &mut session.stage else {
        return Vec::new();
    };
    let status = &stage.status;
    match action {
        Action::Play if status.at_start && status.position <= 0 => {
            let text = "this is the start, and time points back: r reverses it";
            session.tell(Tone::Refused, text);
            Vec::new()
        }
        Action::Cancel if status.seek.is_none() => {
            session.notice = None;
            Vec::new()
        }
        // From the start, with the other arithmetic beside it, or without it.
        Action::Beside => vec![Effect::Open(Request {
            beside: !session.request.beside,
            ..session.request.anew()
        })],
        Action::Anew => vec![Effect::Open(session.request.anew())],
        Action::Parameters => {
            let opened = &stage.opened;
            let panel = Box::new(Panel::new(&opened.scene, &opened.options));
            session.overlay = Overlay::Parameters(panel);
            Vec::new()
        }
        Action::Keep => vec![Effect::Keep],
        Action::Picture => vec![Effect::Picture],
        _ => commands(stage, action)
            .into_iter()
            .map(Effect::Deck)
            .collect(),
    }
}

/// What the deck is told of an action.
fn commands(stage: &mut StagedScene, action: Action) -> Vec<Command> {
    let status = &stage.status;
    let command = match action {
        Action::Play => Command::Play(!status.playing || status.seek.is_some()),
        Action::Turn => return turn(stage),
        Action::StepBack => Command::StepBy(-1),
        Action::StepOn => Command::StepBy(1),
        Action::Slower => pace(stage, slower),
        Action::Faster => pace(stage, faster),
        Action::ToStart => Command::Seek(0),
        Action::ToFarthest => Command::Seek(status.farthest),
        Action::ScrubBack => scrub(stage, -1),
        Action::ScrubOn => scrub(stage, 1),
        Action::Cancel => Command::Cancel,
        // The particle in the middle of the list, which is inside the fluid.
        Action::Flip => Command::Flip(stage.points.len() as u64 / 2),
        Action::Switch => Command::Switch(match status.arithmetic {
            ArithmeticKind::Fixed => ArithmeticKind::Float,
            ArithmeticKind::Float => ArithmeticKind::Fixed,
        }),
        _ => return Vec::new(),
    };
    vec![command]
}

fn turn(stage: &mut StagedScene) -> Vec<Command> {
    stage.turning = matches!(
        stage.opened.reversibility,
        Reversibility::BitExact | Reversibility::UpToRounding
    );
    let mut commands = vec![Command::Turn];
    if !stage.status.playing && stage.status.at_start {
        // At the start there is one thing that one can want: to see it again.
        commands.push(Command::Play(true));
    }
    commands
}

/// Another pace; it is shown at once, so that a key that is held adds up.
fn pace(stage: &mut StagedScene, change: fn(f64) -> f64) -> Command {
    stage.status.pace = change(stage.status.pace);
    Command::Pace(stage.status.pace)
}

/// A twentieth of the bar on or back. A key that is held adds up, before the simulation has heard
/// of the first.
fn scrub(stage: &mut StagedScene, sign: i64) -> Command {
    let under_way = stage.status.seek.map(|seek| seek.target);
    let from = stage.wanted.or(under_way).unwrap_or(stage.status.position);
    let target = (from + sign * (stage.span() / 20).max(1)).max(0);
    stage.wanted = Some(target);
    Command::Seek(target)
}
