//! The window without a display.

use loschmidt_runner::Deck;
use loschmidt_runner::Options;
use loschmidt_runner::deck::{Command, Opening, Report};
use loschmidt_viewer::session::{Button, Choice, Drag, Effect, Message, Mouse, Overlay, Request};
use loschmidt_viewer::window::{Places, WindowMessage, WindowState, compose, update};
use loschmidt_viewer::{Key, Look, Pane, Rgb, Theme, draw, picture, png};
use std::io::Cursor;
use std::sync::mpsc::channel;

const SIZE: (usize, usize) = (800, 500);

/// A dam break that stands at step 40.
fn at_forty() -> WindowState {
    let request = Request {
        name: "dam-break".to_owned(),
        set: vec!["particle_spacing=0.05".to_owned()],
        ..Request::default()
    };
    let mut state = WindowState::new(SIZE, 1.0, Look::default(), None);
    let opening = Opening::of(&request.name, &request.set, Options::default()).expect("a scene");
    let (sender, inbox) = channel();
    let deck = Deck::open(opening, move |report| drop(sender.send(report))).expect("a deck");
    update(&mut state, Message::Opening(1, request));
    deck.send(Command::Play(false));
    deck.send(Command::Seek(40));
    for report in inbox {
        let shot = matches!(report, Report::Shot(_));
        update(&mut state, Message::Report(1, Box::new(report)));
        if shot {
            deck.ready();
            let stage = state.session.stage.as_ref().expect("a scene");
            if stage.points.step == 40 && stage.status.seek.is_none() {
                break;
            }
        }
    }
    state
}

#[test]
fn the_window_is_its_png_and_the_rasterisers_frame_above_the_bar_of_time() {
    let state = at_forty();
    let pixels = compose(&state, SIZE);
    let mut file = Vec::new();
    png::write(&pixels, &mut file).expect("a PNG");
    assert_eq!(
        picture::read(Cursor::new(file), Rgb(0)).expect("a PNG"),
        pixels
    );
    let stage = state.session.stage.as_ref().expect("a scene");
    let places = Places::of(&state).expect("places");
    let look = Look {
        caption: format!("{} particles", stage.points.len()),
        ..Look::default()
    };
    let panes = [Pane::new(&stage.points, stage.track.history())];
    let (width, height) = (places.picture.width, places.picture.height);
    let frame = draw(&panes, &stage.home, &look, width, height);
    assert!(pixels.part(places.picture) == frame);
}

#[test]
fn dragging_the_bar_integrates_to_the_step_under_the_mouse() {
    let mut state = at_forty();
    let places = Places::of(&state).expect("places");
    let y = places.bar.y as f64 + 1.0;
    let span = state.session.stage.as_ref().expect("a scene").span();
    let mut at = |mouse, step: i64| {
        let x = places.bar_at(step, span);
        update(&mut state, WindowMessage::Mouse(mouse, [x, y]))
    };
    let target = |effects: Vec<Effect>| match effects[..] {
        [Effect::Deck(Command::Seek(step))] => step,
        _ => panic!("{effects:?}"),
    };
    let pixel = span / places.bar.width as i64 + 1;
    assert!((target(at(Mouse::Press(Button::Left), span / 2)) - span / 2).abs() <= pixel);
    assert!((target(at(Mouse::Move, span / 4)) - span / 4).abs() <= pixel);
    assert!(at(Mouse::Release, span / 4).is_empty());
    assert!(at(Mouse::Move, span / 3).is_empty());
}

#[test]
fn what_is_under_the_mouse_stays_there_when_the_wheel_turns() {
    let mut state = at_forty();
    let mouse = [130.0, 210.0];
    let point = |state: &WindowState| {
        let field = Places::of(state).expect("places").field;
        let home = &state.session.stage.as_ref().expect("a scene").home;
        let view = &state.session.look.view;
        loschmidt_viewer::Projection::new(home, view, field.width, field.height)
            .unproject(mouse[0] - field.x as f64, mouse[1] - field.y as f64)
    };
    let before = point(&state);
    update(&mut state, WindowMessage::Mouse(Mouse::Wheel(3.0), mouse));
    let after = point(&state);
    assert!(state.session.look.view.zoom > 1.4);
    assert!(
        (0..2).all(|k| (before[k] - after[k]).abs() < 1e-9),
        "{before:?} {after:?}"
    );
    update(
        &mut state,
        WindowMessage::Mouse(Mouse::Press(Button::Left), mouse),
    );
    assert_eq!(state.session.drag, Some(Drag::Pan(mouse)));
}

#[test]
fn what_a_drag_wants_outlasts_a_status_and_what_a_key_wants_does_not() {
    let mut state = at_forty();
    let wanted = |state: &WindowState| state.session.stage.as_ref().expect("a scene").wanted;
    let status = |state: &WindowState| {
        let stage = state.session.stage.as_ref().expect("a scene");
        Message::Report(1, Box::new(Report::Status(stage.status.clone())))
    };
    update(&mut state, Message::Key(Key::PageDown));
    assert!(wanted(&state).is_some());
    let heard = status(&state);
    update(&mut state, heard);
    assert_eq!(wanted(&state), None);
    let bar = Places::of(&state).expect("places").bar;
    let at = [(bar.x + bar.width / 2) as f64, bar.y as f64];
    let press = Mouse::Press(Button::Left);
    update(&mut state, WindowMessage::Mouse(press, at));
    let heard = status(&state);
    update(&mut state, heard);
    assert!(wanted(&state).is_some());
    update(&mut state, WindowMessage::Mouse(Mouse::Release, at));
    assert_eq!(wanted(&state), None);
}

#[test]
fn a_pace_key_that_is_held_adds_up() {
    let mut state = at_forty();
    let pace = |state: &WindowState| state.session.stage.as_ref().expect("a scene").status.pace;
    let before = pace(&state);
    // Six paces to a decade, and nothing heard of in between.
    for _ in 0..6 {
        update(&mut state, Message::Key(Key::Char(']')));
    }
    assert!((pace(&state) / before / 10.0 - 1.0).abs() < 1e-9);
}

#[test]
fn help_theme_and_every_size_can_be_drawn() {
    let mut state = at_forty();
    update(&mut state, Message::Key(Key::Char('t')));
    assert_eq!(state.session.look.theme, Theme::LIGHT);
    let plain = compose(&state, SIZE);
    update(&mut state, Message::Key(Key::Char('?')));
    assert!(compose(&state, SIZE) != plain);
    update(&mut state, Message::Key(Key::Escape));
    assert!(compose(&state, SIZE) == plain);
    for size in [
        (0, 0),
        (1, 1),
        (1, 300),
        (300, 1),
        (159, 119),
        (320, 240),
        (333, 777),
    ] {
        for scale in [1.0, 2.5] {
            update(&mut state, WindowMessage::Resized(size.0, size.1, scale));
            assert_eq!(compose(&state, size).pixels().len(), size.0 * size.1);
        }
    }
}

#[test]
fn another_scene_is_chosen_from_a_list_and_the_present_one_begins_anew() {
    let mut state = at_forty();
    let press = |state: &mut WindowState, key| update(state, Message::Key(key));
    assert_eq!(press(&mut state, Key::Char('o')), [Effect::List]);
    let choice = |name: &str| Choice {
        name: name.to_owned(),
        title: "a scene".to_owned(),
    };
    let plain = compose(&state, SIZE);
    let choices = ["a", "dam-break", "c"].map(choice);
    update(&mut state, Message::Choices(choices.to_vec()));
    assert!(compose(&state, SIZE) != plain);
    press(&mut state, Key::Down);
    let effects = press(&mut state, Key::Enter);
    assert!(matches!(&effects[..], [Effect::Open(request)] if request.name == "c"));
    press(&mut state, Key::Escape);
    assert!(compose(&state, SIZE) == plain);
    let effects = press(&mut state, Key::Char('n'));
    assert_eq!(effects, [Effect::Open(state.session.request.clone())]);
    // A run goes on where it was left, its scene at the start.
    let run = tempfile::tempdir().expect("a directory");
    state.session.request.name = run.path().display().to_string();
    let effects = press(&mut state, Key::Char('n'));
    let scene = run.path().join("scene.toml").display().to_string();
    assert!(matches!(&effects[..], [Effect::Open(request)] if request.name == scene));
}

#[test]
fn the_panel_starts_the_scene_anew_with_its_values() {
    let mut state = at_forty();
    let press = |state: &mut WindowState, key| update(state, Message::Key(key));
    press(&mut state, Key::Char('e'));
    for c in "-1".chars() {
        press(&mut state, Key::Char(c));
    }
    let effects = press(&mut state, Key::Enter);
    let [Effect::Open(request)] = &effects[..] else {
        panic!("{effects:?}");
    };
    assert_eq!(request.set, ["particle_spacing=-1"]);
    let opening = request.opening(Options::default());
    let why = opening.map(|_| "opened").expect_err("refused");
    let shown = compose(&state, SIZE);
    update(&mut state, Message::NotOpened(why.to_string()));
    let Overlay::Parameters(panel) = &state.session.overlay else {
        panic!("{:?}", state.session.overlay);
    };
    assert!(
        panel
            .problem
            .as_ref()
            .is_some_and(|p| p.contains("particle_spacing"))
    );
    assert!(compose(&state, SIZE) != shown);
    press(&mut state, Key::Escape);
    assert_eq!(state.session.overlay, Overlay::None);
}
