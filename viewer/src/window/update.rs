//! How the state changes, and what is asked for: without a clock, a file or a window.

use super::message::{Button, Effect, Message, Mouse};
use super::places::Places;
use super::state::{Drag, Overlay, Stage, State};
use crate::camera::{Projection, View};
use crate::colour::Theme;
use crate::colouring::Colouring;
use crate::face::{
    Answer, Kept, List, Notice, Panel, Request, Tone, meddled, next_colormap, next_colouring,
    turned,
};
use crate::keys::{self, Action, Key};
use loschmidt_core::Reversibility;
use loschmidt_runner::deck::{Beside, Command, Report, faster, slower};
use loschmidt_runner::{ArithmeticKind, Points};

/// Magnification of a notch of the wheel.
const NOTCH: f64 = 1.15;

/// Changes the state; returns what is to be done.
pub fn update(state: &mut State, message: Message) -> Vec<Effect> {
    match message {
        Message::Key(key) => return on_key(state, key),
        Message::Mouse(mouse, at) => return on_mouse(state, mouse, at),
        Message::Resized(width, height, scale) => {
            state.size = (width, height);
            state.scale = scale;
        }
        Message::Report(deck, report) if deck == state.deck => {
            return reuse(on_report(state, *report));
        }
        Message::Report(..) => {}
        Message::Tick(now) => {
            state.now = now;
            state.notice.take_if(|notice| notice.until < now);
        }
        Message::Pictured(Ok(path)) => {
            tell(state, Tone::Done, format!("picture: {}", path.display()));
        }
        Message::Pictured(Err(why)) | Message::Tint(Err(why)) => tell(state, Tone::Refused, why),
        Message::Tint(Ok(picture)) => {
            if let Some(stage) = &mut state.stage {
                let colours = picture.tint(&stage.home).into();
                state.look.colouring = Colouring::Picture(std::sync::Arc::clone(&colours));
                stage.tint = Some(colours);
            }
            state.picture = Some(picture);
        }
        Message::Choices(choices) => {
            state.overlay = Overlay::Scenes(List::new(choices, &state.request));
        }
        Message::NotOpened(why) if state.stage.is_none() => state.overlay = Overlay::Error(why),
        Message::NotOpened(why) => {
            if let Overlay::Parameters(panel) = &mut state.overlay {
                panel.problem = Some(why);
                return Vec::new();
            }
            state.overlay = Overlay::None;
            let line = why.lines().next().unwrap_or_default().to_owned();
            tell(state, Tone::Refused, line);
        }
        Message::Opening(deck, request) => {
            state.deck = deck;
            state.request = request;
            state.stage = None;
            state.banner = None;
            state.overlay = Overlay::None;
            state.notice = None;
            state.kept = None;
            state.drag = None;
            state.look.view = View::default();
        }
    }
    Vec::new()
}

/// The next picture is made in the memory of the one before.
fn reuse(points: Option<Points>) -> Vec<Effect> {
    let effect = |points| Effect::Deck(Command::Reuse(Box::new(points)));
    points.map(effect).into_iter().collect()
}

fn tell(state: &mut State, tone: Tone, text: impl Into<String>) {
    state.notice = Some(Notice::new(tone, text, state.now));
}

/// Takes a report into the state; the picture that a new one has replaced.
fn on_report(state: &mut State, report: Report) -> Option<Points> {
    match report {
        Report::Opened(opened) => {
            let stage = Stage::new(opened, state.request.beside, state.picture.as_ref());
            // The colours of a picture belong to the particles of one scene.
            match (&stage.tint, &state.look.colouring) {
                (Some(tint), _) => state.look.colouring = Colouring::Picture(tint.clone()),
                (None, Colouring::Picture(_)) => state.look.colouring = Colouring::default(),
                _ => {}
            }
            state.stage = Some(stage);
            return None;
        }
        Report::Failed(why) => {
            state.stage = None;
            state.overlay = Overlay::Error(why);
            return None;
        }
        _ => {}
    }
    let Some(stage) = &mut state.stage else {
        return None;
    };
    match report {
        Report::Opened(_) | Report::Failed(_) => {}
        Report::Shot(shot) => {
            stage.status = shot.status;
            return Some(std::mem::replace(&mut stage.points, shot.points));
        }
        Report::Status(status) => {
            // A drag goes on wanting; a key's wish is under way now.
            if state.drag.is_none() {
                stage.wanted = None;
            }
            stage.status = status;
        }
        Report::Moment(moment) => {
            if moment.regular {
                let span = stage.home.span;
                stage.ways.push(moment.row.clone(), moment.travel, span);
            }
            stage.moment = Some(moment);
        }
        Report::Beside(beside) => {
            let ended = match &beside {
                Beside::Ended(fault) => Some(fault.to_string()),
                _ => None,
            };
            stage.hear(beside);
            if let Some(fault) = ended {
                let text = format!("the other arithmetic's numbers ended: {fault}");
                tell(state, Tone::Warning, text);
            }
        }
        Report::Turned(arrow) => {
            stage.turning = false;
            stage.status.arrow = arrow;
            let (tone, text) = turned(arrow, stage.status.arithmetic);
            tell(state, tone, text);
        }
        Report::Meddled(meddling) => {
            let text = meddled(&meddling, stage.opened.length_quantum);
            tell(state, Tone::Warning, text);
        }
        Report::Arrived(arrival) => state.banner = Some(arrival),
        Report::SeekEnded(true) => {}
        Report::SeekEnded(false) => tell(state, Tone::Done, "stopped on the way"),
        Report::Refused(why) => {
            stage.turning = false;
            stage.wanted = None;
            tell(state, Tone::Refused, why.to_string());
        }
        Report::Fault(fault) => {
            let text = format!("the numbers ended: {fault}; this is the last good state");
            tell(state, Tone::Refused, text);
        }
        Report::Kept(path) => {
            let text = format!("saved; open it with  loschmidt view {}", path.display());
            state.kept = Some(Kept::new(path, &stage.status));
            tell(state, Tone::Done, text);
        }
        Report::NotKept(why) => tell(state, Tone::Refused, why),
    }
    None
}

fn on_key(state: &mut State, key: Key) -> Vec<Effect> {
    if key == Key::Ctrl('c') {
        return vec![Effect::Quit];
    }
    let action = keys::window_action(key);
    match &mut state.overlay {
        Overlay::None => {}
        Overlay::Help => {
            state.overlay = Overlay::None;
            return match action {
                Some(Action::Quit) => vec![Effect::Quit],
                _ => Vec::new(),
            };
        }
        Overlay::Scenes(list) => {
            let answer = list.key(key, &state.request);
            return answered(state, answer);
        }
        Overlay::Parameters(panel) => {
            let answer = panel.key(key, &state.request);
            return answered(state, answer);
        }
        Overlay::Error(_) => {
            return match action {
                Some(Action::Quit) => vec![Effect::Quit],
                Some(Action::Scenes) => vec![Effect::List],
                _ => Vec::new(),
            };
        }
    }
    if state.banner.take().is_some() && matches!(action, Some(Action::Play | Action::Cancel)) {
        // These were for the banner; others close it and do what they always do.
        return Vec::new();
    }
    action.map_or_else(Vec::new, |action| on_action(state, action))
}

/// Does what a key in a list or a panel leads to.
fn answered(state: &mut State, answer: Answer) -> Vec<Effect> {
    match answer {
        Answer::Stay => {}
        // Without a scene behind it something must stay that tells how to go on.
        Answer::Close if state.stage.is_none() => {
            state.overlay = Overlay::Error("nothing is open".to_owned());
        }
        Answer::Close => state.overlay = Overlay::None,
        Answer::Open(request) => return vec![Effect::Open(request)],
        Answer::Quit => return vec![Effect::Quit],
    }
    Vec::new()
}

fn on_action(state: &mut State, action: Action) -> Vec<Effect> {
    match action {
        Action::Quit => return vec![Effect::Quit],
        Action::Scenes => return vec![Effect::List],
        Action::Help => {
            state.overlay = Overlay::Help;
            return Vec::new();
        }
        _ => {}
    }
    if on_view(state, action) {
        return Vec::new();
    }
    let Some(stage) = &mut state.stage else {
        return Vec::new();
    };
    let status = &stage.status;
    let deck = |command| vec![Effect::Deck(command)];
    match action {
        Action::Play if status.at_start && status.position <= 0 => {
            let text = "this is the start, and time points back: r reverses it";
            tell(state, Tone::Refused, text);
            Vec::new()
        }
        Action::Play => deck(Command::Play(!status.playing || status.seek.is_some())),
        Action::Turn => turn(stage),
        Action::StepBack => deck(Command::StepBy(-1)),
        Action::StepOn => deck(Command::StepBy(1)),
        Action::Slower => deck(Command::Pace(slower(status.pace))),
        Action::Faster => deck(Command::Pace(faster(status.pace))),
        Action::ToStart => deck(Command::Seek(0)),
        Action::ToFarthest => deck(Command::Seek(status.farthest)),
        Action::ScrubBack | Action::ScrubOn => {
            // A key that is held adds up, before the simulation has heard of the first.
            let under_way = stage.wanted.or(status.seek.map(|seek| seek.target));
            let from = under_way.unwrap_or(status.position);
            let by = (stage.span() / 20).max(1);
            let sign = if action == Action::ScrubBack { -1 } else { 1 };
            let target = (from + sign * by).max(0);
            stage.wanted = Some(target);
            deck(Command::Seek(target))
        }
        Action::Cancel if status.seek.is_some() => deck(Command::Cancel),
        Action::Cancel => {
            state.notice = None;
            Vec::new()
        }
        // The one in the middle of the lattice order.
        Action::Flip => deck(Command::Flip(stage.points.len() as u64 / 2)),
        Action::Switch => deck(Command::Switch(match status.arithmetic {
            ArithmeticKind::Fixed => ArithmeticKind::Float,
            ArithmeticKind::Float => ArithmeticKind::Fixed,
        })),
        // From the start, with the other arithmetic beside it, or without it.
        Action::Beside => vec![Effect::Open(Request {
            beside: !state.request.beside,
            ..state.request.anew()
        })],
        Action::Anew => vec![Effect::Open(state.request.anew())],
        Action::Parameters => {
            let opened = &stage.opened;
            let panel = Panel::new(&opened.scene, &opened.options);
            state.overlay = Overlay::Parameters(panel);
            Vec::new()
        }
        Action::Keep => vec![Effect::Keep],
        Action::Picture => vec![Effect::Picture],
        _ => Vec::new(),
    }
}

fn turn(stage: &mut Stage) -> Vec<Effect> {
    stage.turning = matches!(
        stage.opened.reversibility,
        Reversibility::BitExact | Reversibility::UpToRounding
    );
    let mut effects = vec![Effect::Deck(Command::Turn)];
    if !stage.status.playing && stage.status.at_start {
        // At the start there is one thing that one can want: to see it again.
        effects.push(Effect::Deck(Command::Play(true)));
    }
    effects
}

/// What only changes how the scene is looked at; whether it was that.
fn on_view(state: &mut State, action: Action) -> bool {
    const ANGLE: f64 = 0.12;
    let look = &mut state.look;
    match action {
        Action::Colour => {
            let tint = state.stage.as_ref().and_then(|stage| stage.tint.clone());
            look.colouring = next_colouring(&look.colouring, tint.map(Colouring::Picture));
        }
        Action::Colormap => look.colormap = next_colormap(look.colormap),
        Action::Theme => {
            look.theme = if look.theme == Theme::DARK {
                Theme::LIGHT
            } else {
                Theme::DARK
            }
        }
        Action::ZoomIn => look.view = look.view.zoomed(1.25),
        Action::ZoomOut => look.view = look.view.zoomed(0.8),
        Action::ResetView => look.view = View::default(),
        Action::PanLeft => part(state, [-1.0, 0.0]),
        Action::PanRight => part(state, [1.0, 0.0]),
        Action::PanDown => part(state, [0.0, -1.0]),
        Action::PanUp => part(state, [0.0, 1.0]),
        Action::OrbitLeft => look.view = look.view.orbited(-ANGLE, 0.0),
        Action::OrbitRight => look.view = look.view.orbited(ANGLE, 0.0),
        Action::OrbitDown => look.view = look.view.orbited(0.0, -ANGLE),
        Action::OrbitUp => look.view = look.view.orbited(0.0, ANGLE),
        _ => return false,
    }
    true
}

/// Moves the view by a tenth of the field to the right and up.
fn part(state: &mut State, [right, up]: [f64; 2]) {
    let Some(places) = Places::of(state) else {
        return;
    };
    let (width, height) = (places.field.width as f64, places.field.height as f64);
    let by = [-right * 0.1 * width, up * 0.1 * height];
    drag_view(state, by);
}

fn on_mouse(state: &mut State, mouse: Mouse, at: [f64; 2]) -> Vec<Effect> {
    if state.overlay != Overlay::None {
        if matches!(mouse, Mouse::Press(_)) && state.overlay == Overlay::Help {
            state.overlay = Overlay::None;
        }
        return Vec::new();
    }
    let Some(places) = Places::of(state) else {
        return Vec::new();
    };
    let Some(stage) = &mut state.stage else {
        return Vec::new();
    };
    match (mouse, state.drag) {
        (Mouse::Press(Button::Left), _) if places.on_bar(at) => {
            state.banner = None;
            let step = places.step_at(at, stage.span());
            return scrub(state, step);
        }
        (Mouse::Press(button), _) => {
            state.drag = places.field_at(at).map(|_| {
                let space = stage.home.dimension == 3 && button == Button::Left;
                if space {
                    Drag::Orbit(at)
                } else {
                    Drag::Pan(at)
                }
            });
        }
        (Mouse::Move, Some(Drag::Bar(last))) => {
            let step = places.step_at(at, stage.span());
            if step != last {
                return scrub(state, step);
            }
        }
        (Mouse::Move, Some(Drag::Pan(last))) => {
            state.drag = Some(Drag::Pan(at));
            drag_view(state, [at[0] - last[0], at[1] - last[1]]);
        }
        (Mouse::Move, Some(Drag::Orbit(last))) => {
            state.drag = Some(Drag::Orbit(at));
            // Half a turn is a drag over the height of the field.
            let angle = std::f64::consts::PI / places.field.height.max(1) as f64;
            let [yaw, pitch] = [-(at[0] - last[0]) * angle, (at[1] - last[1]) * angle];
            state.look.view = state.look.view.orbited(yaw, pitch);
        }
        (Mouse::Release, _) => {
            state.drag = None;
            stage.wanted = None;
        }
        (Mouse::Wheel(notches), _) => zoom_at(state, &places, notches, at),
        (Mouse::Move, None) => {}
    }
    Vec::new()
}

/// To this step, by integrating, as fast as it goes; a later one takes its place.
fn scrub(state: &mut State, step: i64) -> Vec<Effect> {
    state.drag = Some(Drag::Bar(step));
    if let Some(stage) = &mut state.stage {
        stage.wanted = Some(step);
    }
    vec![Effect::Deck(Command::Seek(step))]
}

fn projection(state: &State) -> Option<Projection> {
    let places = Places::of(state)?;
    let stage = state.stage.as_ref()?;
    let (width, height) = (places.field.width, places.field.height);
    Some(Projection::new(
        &stage.home,
        &state.look.view,
        width,
        height,
    ))
}

/// Moves the picture by so many pixels to the right and down.
fn drag_view(state: &mut State, pixels: [f64; 2]) {
    if let Some(projection) = projection(state) {
        state.look.view = state.look.view.dragged(pixels, &projection);
    }
}

/// Zooms; what is under the mouse stays there.
fn zoom_at(state: &mut State, places: &Places, notches: f64, at: [f64; 2]) {
    let (Some(field), Some(projection)) = (places.field_at(at), projection(state)) else {
        return;
    };
    let factor = libm::pow(NOTCH, notches.clamp(-10.0, 10.0));
    let x = at[0] - field.x as f64 - 0.5 * field.width as f64;
    let y = at[1] - field.y as f64 - 0.5 * field.height as f64;
    let away = [x, y].map(|d| d * (1.0 - factor) / factor);
    // Dragging is in pixels of the projection before the zoom.
    state.look.view = state.look.view.dragged(away, &projection).zoomed(factor);
}
