//! What keys do, as effects and in the state.

use super::Bench;
use crate::dashboard::message::DashboardMessage;
use crate::dashboard::view::Areas;
use loschmidt_runner::deck::{Command, Report};
use loschmidt_runner::{ArithmeticKind, Arrow};
use loschmidt_viewer::session::{Choice, Effect, Message, Mouse, Overlay, Panel, Tone};
use loschmidt_viewer::{Colouring, Key, Projection};

fn drop() -> Bench {
    Bench::open("rotating-drop", &["particle_spacing=0.1"], (120, 40))
}

#[test]
fn every_colouring_comes_round() {
    let mut bench = drop();
    let mut seen = Vec::new();
    for _ in Colouring::MEASURED {
        seen.push(bench.state.session.look.colouring.clone());
        bench.key(Key::Char('c'));
    }
    assert_eq!(seen, Colouring::MEASURED);
    assert_eq!(bench.state.session.look.colouring, seen[0]);
}

#[test]
fn an_arrow_key_is_one_step_in_either_direction() {
    let mut bench = drop();
    bench.seek(10);
    bench.key(Key::Left);
    bench.shot_at(9);
    bench.key(Key::Right);
    bench.shot_at(10);
    bench.key(Key::Char('r'));
    bench.key(Key::Right);
    bench.shot_at(11);
    let status = &bench.state.session.stage.as_ref().expect("a scene").status;
    assert_eq!(status.arrow, Arrow::Backward);
    assert!(!status.playing);
}

#[test]
fn a_key_that_is_held_adds_up() {
    let mut bench = drop();
    let pace = |bench: &Bench| {
        bench
            .state
            .session
            .stage
            .as_ref()
            .expect("a scene")
            .status
            .pace
    };
    let before = pace(&bench);
    // Six paces to a decade, and nothing heard of in between.
    for _ in 0..12 {
        bench.key(Key::Char(']'));
    }
    assert!((pace(&bench) / before / 100.0 - 1.0).abs() < 1e-9);
}

#[test]
fn what_lies_over_the_rest_does_not_stop_time() {
    let mut bench = Bench::open("rotating-drop", &["particle_spacing=0.1"], (120, 40));
    bench.tell(Message::Key(Key::Escape));
    for key in ['?', 'e'] {
        let effects = bench.key(Key::Char(key));
        assert!(
            !effects.iter().any(|it| matches!(it, Effect::Deck(_))),
            "{effects:?}"
        );
        assert_ne!(bench.state.session.overlay, Overlay::None);
        let status = &bench.state.session.stage.as_ref().expect("a scene").status;
        assert!(status.playing);
        bench.key(Key::Escape);
        assert_eq!(bench.state.session.overlay, Overlay::None);
    }
}

#[test]
fn before_the_start_there_is_nothing() {
    let mut bench = drop();
    bench.seek(0);
    bench.key(Key::Left);
    bench.until(|report| matches!(report, Report::Refused(_)));
    let notice = bench.state.session.notice.as_ref().expect("a notice");
    assert_eq!(notice.tone, Tone::Refused);
    assert!(notice.text.contains("start"), "{}", notice.text);
}

#[test]
fn floating_point_turns_but_does_not_seek() {
    let mut bench = drop();
    bench.seek(20);
    bench.key(Key::Char('f'));
    bench.until(|report| matches!(report, Report::Meddled(_)));
    bench.key(Key::Left);
    bench.until(|report| matches!(report, Report::Refused(_)));
    let notice = bench.state.session.notice.as_ref().expect("a notice");
    assert!(notice.text.contains("floating-point"), "{}", notice.text);
    bench.key(Key::Char('r'));
    bench.until(|report| matches!(report, Report::Turned(Arrow::Backward)));
    let status = &bench.state.session.stage.as_ref().expect("a scene").status;
    assert_eq!(status.arithmetic, ArithmeticKind::Float);
}

#[test]
fn the_standard_scheme_refuses_to_turn_and_says_why() {
    let mut bench = Bench::open(
        "rotating-drop",
        &["particle_spacing=0.1", "model=standard"],
        (120, 40),
    );
    bench.seek(20);
    for key in [Key::Char('r'), Key::Left, Key::Home] {
        bench.key(key);
        bench.until(|report| matches!(report, Report::Refused(_)));
        let notice = bench.state.session.notice.take().expect("a notice");
        assert!(
            notice.text.contains("not symmetric in time"),
            "{}",
            notice.text
        );
    }
    let stage = bench.state.session.stage.as_ref().expect("a scene");
    assert_eq!((stage.arrow(), stage.status.position), (Arrow::Forward, 20));
}

#[test]
fn a_turn_is_shown_before_the_simulation_has_heard_of_it() {
    let mut bench = drop();
    bench.key(Key::Char('r'));
    let stage = bench.state.session.stage.as_ref().expect("a scene");
    assert_eq!(stage.status.arrow, Arrow::Forward);
    assert_eq!(stage.arrow(), Arrow::Backward);
}

#[test]
fn the_wheel_zooms_around_the_mouse() {
    let mut bench = drop();
    let area = Areas::of(bench.state.size).field;
    let (column, row) = (area.x + area.width / 4, area.y + area.height / 3);
    let under = |bench: &Bench| {
        let stage = bench.state.session.stage.as_ref().expect("a scene");
        let (w, h) = (usize::from(area.width), 2 * usize::from(area.height));
        let projection = Projection::new(&stage.home, &bench.state.session.look.view, w, h);
        let x = f64::from(column - area.x) + 0.5;
        let y = 2.0 * f64::from(row - area.y) + 1.0;
        projection.unproject(x, y)
    };
    let before = under(&bench);
    for _ in 0..5 {
        bench.tell(DashboardMessage::Mouse(Mouse::Wheel(1.0), column, row));
    }
    let after = under(&bench);
    assert!(bench.state.session.look.view.zoom > 1.9);
    assert!((before[0] - after[0]).abs() < 1e-9 && (before[1] - after[1]).abs() < 1e-9);
}

#[test]
fn the_panel_starts_the_scene_anew_with_its_values() {
    let mut bench = drop();
    bench.key(Key::Char('e'));
    for c in "0.08".chars() {
        bench.key(Key::Char(c));
    }
    bench.key(Key::Down);
    bench.key(Key::Down);
    bench.key(Key::Right);
    bench.key(Key::Down);
    bench.key(Key::Char('0'));
    // No threads at all is refused, and the panel stays.
    assert_eq!(bench.key(Key::Enter), []);
    let Overlay::Parameters(panel) = &bench.state.session.overlay else {
        panic!("{:?}", bench.state.session.overlay);
    };
    let Panel { problem, .. } = &**panel;
    assert!(problem.as_ref().is_some_and(|p| p.contains("1 to 1024")));
    bench.key(Key::Backspace);
    bench.key(Key::Char('2'));
    let effects = bench.key(Key::Enter);
    let [Effect::Open(request)] = &effects[..] else {
        panic!("{effects:?}");
    };
    assert_eq!(request.name, "rotating-drop");
    assert_eq!(request.set, ["particle_spacing=0.08", "integrator=pefrl"]);
    assert_eq!(request.threads, Some(2));
}

#[test]
fn a_scene_is_chosen_from_the_list() {
    let mut bench = drop();
    assert_eq!(bench.key(Key::Char('o')), [Effect::List]);
    let choice = |name: &str| Choice {
        name: name.to_owned(),
        title: String::new(),
    };
    bench.tell(Message::Choices(vec![
        choice("a"),
        choice("rotating-drop"),
        choice("c"),
    ]));
    bench.key(Key::Down);
    let effects = bench.key(Key::Enter);
    assert!(matches!(&effects[..], [Effect::Open(request)] if request.name == "c"));
}

#[test]
fn the_scene_begins_anew_with_nothing_done_to_it() {
    let mut bench = drop();
    bench.key(Key::Char('b'));
    let effects = bench.key(Key::Char('n'));
    assert_eq!(effects, [Effect::Open(bench.state.session.request.clone())]);
}

#[test]
fn at_the_start_the_turned_time_stands_until_it_is_turned_again() {
    let mut bench = drop();
    bench.seek(5);
    bench.key(Key::Char('r'));
    bench.key(Key::Space);
    // At this pace nothing happens; faster, the start is reached, and time stands there.
    bench.deck.send(Command::Pace(1e3));
    bench.until(|report| matches!(report, Report::Arrived(_)));
    bench.shot_at(0);
    bench.state.session.banner = None;
    assert_eq!(bench.key(Key::Space), []);
    let notice = bench.state.session.notice.as_ref().expect("a notice");
    assert!(notice.text.contains("r reverses it"), "{}", notice.text);
    bench.key(Key::Char('r'));
    bench.until(|report| matches!(report, Report::Shot(shot) if shot.status.position > 0));
}
