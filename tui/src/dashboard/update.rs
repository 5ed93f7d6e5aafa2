//! How the state changes, and what is asked for: without a clock, a file or a terminal.

use super::message::{Effect, Message, Mouse};
use super::state::{Drag, Overlay, Stage, State};
use super::view::Areas;
use loschmidt_core::Reversibility;
use loschmidt_runner::deck::{Command, Report, faster, slower};
use loschmidt_runner::{ArithmeticKind, Points};
use loschmidt_viewer::face::{
    Answer, Kept, List, Notice, Panel, Tone, meddled, next_colormap, next_colouring, turned,
};
use loschmidt_viewer::{Action, Key, Projection, Theme, View, keys};

/// Changes the state; returns what is to be done.
pub fn update(state: &mut State, message: Message) -> Vec<Effect> {
    match message {
        Message::Key(key) => on_key(state, key),
        Message::Mouse(mouse, column, row) => on_mouse(state, mouse, column, row),
        Message::Resized(columns, rows) => {
            state.size = (columns, rows);
            Vec::new()
        }
        Message::Report(deck, report) => {
            if deck == state.deck {
                return reuse(on_report(state, *report));
            }
            Vec::new()
        }
        Message::Tick(now) => {
            state.now = now;
            state.notice.take_if(|notice| notice.until < now);
            Vec::new()
        }
        Message::Choices(choices) => {
            state.overlay = Overlay::Scenes(List::new(choices, &state.request));
            Vec::new()
        }
        Message::Pictured(Ok(path)) => {
            tell(state, Tone::Done, format!("picture: {}", path.display()));
            Vec::new()
        }
        Message::Pictured(Err(why)) => {
            tell(state, Tone::Refused, why);
            Vec::new()
        }
        Message::NotOpened(why) => {
            match &mut state.overlay {
                Overlay::Parameters(panel) => panel.problem = Some(why),
                overlay if state.stage.is_none() => *overlay = Overlay::Error(why),
                overlay => {
                    *overlay = Overlay::None;
                    tell(state, Tone::Refused, first_line(&why));
                }
            }
            Vec::new()
        }
        Message::Opening(deck, request) => {
            state.deck = deck;
            state.request = request;
            state.stage = None;
            state.banner = None;
            state.overlay = Overlay::None;
            state.notice = None;
            state.kept = None;
            state.look.view = View::default();
            Vec::new()
        }
    }
}

/// The next picture is made in the memory of the one before.
fn reuse(points: Option<Points>) -> Vec<Effect> {
    let effect = |points| Effect::Deck(Command::Reuse(Box::new(points)));
    points.map(effect).into_iter().collect()
}

fn tell(state: &mut State, tone: Tone, text: impl Into<String>) {
    state.notice = Some(Notice::new(tone, text, state.now));
}

fn first_line(text: &str) -> String {
    text.lines().next().unwrap_or_default().to_owned()
}

/// Takes a report into the state; the picture that a new one has replaced.
fn on_report(state: &mut State, report: Report) -> Option<Points> {
    match report {
        Report::Opened(opened) => {
            state.stage = Some(Stage::new(opened));
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
        Report::Opened(_) | Report::Failed(_) | Report::Beside(_) => {}
        Report::Shot(shot) => {
            stage.status = shot.status;
            return Some(std::mem::replace(&mut stage.points, shot.points));
        }
        Report::Status(status) => {
            stage.wanted = None;
            stage.status = status;
        }
        Report::Moment(moment) => {
            if moment.regular {
                stage.track.push(moment.row.clone(), moment.travel);
            }
            stage.moment = Some(moment);
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
        Report::Fault(fault) => tell(
            state,
            Tone::Refused,
            format!("the numbers ended: {fault}; this is the last good state"),
        ),
        Report::Kept(path) => {
            let text = format!(
                "saved; open it again with  loschmidt tui {}",
                path.display()
            );
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
    match &mut state.overlay {
        Overlay::None => {}
        Overlay::Help(first) => {
            match key {
                Key::Down | Key::PageDown => *first = (*first + 1).min(keys::TABLE.len() - 1),
                Key::Up | Key::PageUp => *first = first.saturating_sub(1),
                _ => state.overlay = Overlay::None,
            }
            return match keys::action(key) {
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
            return match keys::action(key) {
                Some(Action::Quit) => vec![Effect::Quit],
                Some(Action::Scenes) => vec![Effect::List],
                _ => Vec::new(),
            };
        }
    }
    let action = keys::action(key);
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
        Answer::Close => close(state),
        Answer::Open(request) => return vec![Effect::Open(request)],
        Answer::Quit => return vec![Effect::Quit],
    }
    Vec::new()
}

/// Closes what is open; without a scene behind it, the error that explains why stays.
fn close(state: &mut State) {
    state.overlay = if state.stage.is_none() {
        Overlay::Error("nothing is open".to_owned())
    } else {
        Overlay::None
    };
}

fn on_action(state: &mut State, action: Action) -> Vec<Effect> {
    match action {
        Action::Quit => return vec![Effect::Quit],
        Action::Help => {
            state.overlay = Overlay::Help(0);
            return Vec::new();
        }
        Action::Scenes => return vec![Effect::List],
        _ => {}
    }
    if let Some(effects) = on_view(state, action) {
        return effects;
    }
    let Some(stage) = &mut state.stage else {
        return Vec::new();
    };
    let status = &stage.status;
    let seek = |target: i64| vec![Effect::Deck(Command::Seek(target))];
    match action {
        Action::Play if status.at_start && status.position <= 0 => {
            tell(
                state,
                Tone::Refused,
                "this is the start, and time points back: r reverses it",
            );
            Vec::new()
        }
        Action::Play => {
            let play = !status.playing || status.seek.is_some();
            vec![Effect::Deck(Command::Play(play))]
        }
        Action::Turn => {
            stage.turning = matches!(
                stage.opened.reversibility,
                Reversibility::BitExact | Reversibility::UpToRounding
            );
            let mut effects = vec![Effect::Deck(Command::Turn)];
            if !status.playing && status.at_start {
                // At the start there is one thing that one can want: to see it again.
                effects.push(Effect::Deck(Command::Play(true)));
            }
            effects
        }
        Action::StepBack => vec![Effect::Deck(Command::StepBy(-1))],
        Action::StepOn => vec![Effect::Deck(Command::StepBy(1))],
        Action::Slower | Action::Faster => {
            let change = if action == Action::Slower {
                slower
            } else {
                faster
            };
            // Shown at once, so that a key that is held adds up.
            stage.status.pace = change(stage.status.pace);
            vec![Effect::Deck(Command::Pace(stage.status.pace))]
        }
        Action::ToStart => seek(0),
        Action::ToFarthest => seek(status.farthest),
        Action::ScrubBack | Action::ScrubOn => {
            // A key that is held adds up, before the simulation has heard of the first.
            let under_way = stage.wanted.or(status.seek.map(|seek| seek.target));
            let from = under_way.unwrap_or(status.position);
            let by = (stage.span() / 20).max(1);
            let sign = if action == Action::ScrubBack { -1 } else { 1 };
            let target = (from + sign * by).max(0);
            stage.wanted = Some(target);
            seek(target)
        }
        Action::Cancel if status.seek.is_some() => vec![Effect::Deck(Command::Cancel)],
        Action::Cancel => {
            state.notice = None;
            Vec::new()
        }
        // The one in the middle of the lattice order.
        Action::Flip => {
            let particles = stage.points.len() as u64;
            vec![Effect::Deck(Command::Flip(particles / 2))]
        }
        Action::Switch => {
            let other = match status.arithmetic {
                ArithmeticKind::Fixed => ArithmeticKind::Float,
                ArithmeticKind::Float => ArithmeticKind::Fixed,
            };
            vec![Effect::Deck(Command::Switch(other))]
        }
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

/// What only changes how the scene is looked at.
fn on_view(state: &mut State, action: Action) -> Option<Vec<Effect>> {
    const ANGLE: f64 = 0.12;
    let look = &mut state.look;
    let part = |state: &mut State, right: f64, up: f64| {
        let Some((projection, width, height)) = projection(state) else {
            return;
        };
        let by = [-right * 0.1 * width, up * 0.1 * height];
        state.look.view = state.look.view.dragged(by, &projection);
    };
    match action {
        Action::Colour => look.colouring = next_colouring(&look.colouring, None),
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
        Action::PanLeft => part(state, -1.0, 0.0),
        Action::PanRight => part(state, 1.0, 0.0),
        Action::PanDown => part(state, 0.0, -1.0),
        Action::PanUp => part(state, 0.0, 1.0),
        Action::OrbitLeft => look.view = look.view.orbited(-ANGLE, 0.0),
        Action::OrbitRight => look.view = look.view.orbited(ANGLE, 0.0),
        Action::OrbitDown => look.view = look.view.orbited(0.0, -ANGLE),
        Action::OrbitUp => look.view = look.view.orbited(0.0, ANGLE),
        _ => return None,
    }
    Some(Vec::new())
}

/// The projection of the field, and its size in pixels.
fn projection(state: &State) -> Option<(Projection, f64, f64)> {
    let stage = state.stage.as_ref()?;
    let field = Areas::of(state.size).field;
    let (width, height) = (usize::from(field.width), 2 * usize::from(field.height));
    let projection = Projection::new(&stage.home, &state.look.view, width, height);
    Some((projection, width as f64, height as f64))
}

fn on_mouse(state: &mut State, mouse: Mouse, column: u16, row: u16) -> Vec<Effect> {
    if state.overlay != Overlay::None {
        return Vec::new();
    }
    let areas = Areas::of(state.size);
    let Some(stage) = &mut state.stage else {
        return Vec::new();
    };
    let at = ratatui::layout::Position::new(column, row);
    let place = areas.steps_at(column, stage.span());
    match (mouse, state.drag) {
        (Mouse::Press, _) if areas.bar.contains(at) => {
            state.banner = None;
            stage.wanted = Some(place);
            state.drag = Some(Drag::Bar);
        }
        (Mouse::Press | Mouse::PressRight, _) if areas.field.contains(at) => {
            state.drag = Some(Drag::Field(column, row));
        }
        (Mouse::Drag, Some(Drag::Bar)) => stage.wanted = Some(place),
        (Mouse::Release, Some(Drag::Bar)) => {
            state.drag = None;
            stage.wanted = Some(place);
            return vec![Effect::Deck(Command::Seek(place))];
        }
        (Mouse::Drag | Mouse::DragRight, Some(Drag::Field(x, y))) => {
            let cells = [
                f64::from(column) - f64::from(x),
                f64::from(row) - f64::from(y),
            ];
            state.drag = Some(Drag::Field(column, row));
            if mouse == Mouse::DragRight {
                let [yaw, pitch] = [-0.03 * cells[0], 0.06 * cells[1]];
                state.look.view = state.look.view.orbited(yaw, pitch);
            } else if let Some((projection, ..)) = projection(state) {
                let pixels = [cells[0], 2.0 * cells[1]];
                state.look.view = state.look.view.dragged(pixels, &projection);
            }
        }
        (Mouse::Release, _) => state.drag = None,
        (Mouse::WheelUp, _) if areas.field.contains(at) => zoom_at(state, 1.15, column, row),
        (Mouse::WheelDown, _) if areas.field.contains(at) => {
            zoom_at(state, 1.0 / 1.15, column, row)
        }
        _ => {}
    }
    Vec::new()
}

/// Zooms; what is under the mouse stays there.
fn zoom_at(state: &mut State, factor: f64, column: u16, row: u16) {
    let Some((projection, width, height)) = projection(state) else {
        return;
    };
    let field = Areas::of(state.size).field;
    let x = f64::from(column) - f64::from(field.x) + 0.5 - 0.5 * width;
    let y = 2.0 * (f64::from(row) - f64::from(field.y)) + 1.0 - 0.5 * height;
    let away = [x, y].map(|d| d * (1.0 - factor) / factor);
    // Dragging is in pixels of the projection before the zoom.
    state.look.view = state.look.view.dragged(away, &projection).zoomed(factor);
}
