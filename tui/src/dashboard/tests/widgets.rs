//! Claims about single views.

use super::{Bench, screen, text};
use crate::dashboard::message::DashboardMessage;
use crate::dashboard::state::{DashboardState, Depth};
use crate::dashboard::view::Areas;
use loschmidt_runner::deck::Report;
use loschmidt_viewer::session::{Button, Mouse};
use loschmidt_viewer::{Key, Projection, Track, field, keys};
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Color;

fn dam() -> Bench {
    let mut bench = Bench::open("dam-break", &["particle_spacing=0.1"], (120, 40));
    bench.seek(600);
    bench
}

#[test]
fn a_cell_of_the_field_is_two_pixels_of_the_rasteriser() {
    let bench = dam();
    let (state, buffer) = (&bench.state, bench.screen());
    let stage = state.session.stage.as_ref().expect("a scene");
    let area = Areas::of(state.size).field;
    let (columns, rows) = (usize::from(area.width), usize::from(area.height));
    let raster = field(
        &stage.points,
        &stage.home,
        &state.session.look,
        columns,
        2 * rows,
    );
    let rgb = |colour: Color| match colour {
        Color::Rgb(r, g, b) => [r, g, b],
        other => panic!("{other:?}"),
    };
    for y in 0..rows {
        for x in 0..columns {
            let cell = &buffer[(area.x + x as u16, area.y + y as u16)];
            let upper = if cell.symbol() == "▀" {
                cell.fg
            } else {
                cell.bg
            };
            assert_eq!(rgb(upper), raster.at(x, 2 * y).channels());
            assert_eq!(rgb(cell.bg), raster.at(x, 2 * y + 1).channels());
        }
    }
}

#[test]
fn without_colours_the_fluid_is_dots_and_nothing_is_coloured() {
    let mut bench = dam();
    bench.state.depth = Depth::None;
    let buffer = bench.screen();
    let plain = |c: &ratatui::buffer::Cell| c.fg == Color::Reset && c.bg == Color::Reset;
    assert!(buffer.content.iter().all(plain));
    let area = Areas::of(bench.state.size).field;
    let dots = inside(&buffer, area, |s| ('\u{2801}'..='\u{28ff}').contains(&s));
    let stage = bench.state.session.stage.as_ref().expect("a scene");
    // 200 particles cover 2 m² of the box of 4 m by 3 m, a cell in eight or so.
    assert!(
        dots > usize::from(area.width * area.height) / 12,
        "{dots} of {area}, {:?}",
        stage.home.shown
    );
}

fn inside(buffer: &Buffer, area: Rect, wanted: impl Fn(char) -> bool) -> usize {
    area.positions()
        .filter(|at| buffer[*at].symbol().chars().all(&wanted))
        .count()
}

#[test]
fn sixteen_colours_are_never_exceeded() {
    let mut bench = dam();
    bench.state.depth = Depth::Basic;
    let buffer = bench.screen();
    let few = |c: Color| !matches!(c, Color::Rgb(..) | Color::Indexed(_));
    assert!(
        buffer
            .content
            .iter()
            .all(|cell| few(cell.fg) && few(cell.bg))
    );
    bench.state.depth = Depth::Indexed;
    let buffer = bench.screen();
    let indexed = |c: Color| !matches!(c, Color::Rgb(..));
    assert!(
        buffer
            .content
            .iter()
            .all(|cell| indexed(cell.fg) && indexed(cell.bg))
    );
}

#[test]
fn the_environment_says_how_many_colours_there_are() {
    let of = |variables: &[(&str, &str)]| {
        Depth::of_environment(|name| {
            let found = variables.iter().find(|(n, _)| *n == name);
            found.map(|(_, value)| (*value).to_owned())
        })
    };
    assert_eq!(
        of(&[("TERM", "xterm"), ("COLORTERM", "truecolor")]),
        Depth::True
    );
    assert_eq!(of(&[("TERM", "xterm-256color")]), Depth::Indexed);
    assert_eq!(of(&[("TERM", "linux")]), Depth::Basic);
    assert_eq!(
        of(&[("NO_COLOR", "1"), ("COLORTERM", "truecolor")]),
        Depth::None
    );
    assert_eq!(of(&[("NO_COLOR", ""), ("COLORTERM", "24bit")]), Depth::True);
}

/// The characters of the plots.
fn plots(state: &DashboardState) -> Vec<String> {
    let areas = Areas::of(state.size);
    let buffer = screen(state);
    let cells = |area: Rect| {
        // Without the title and the numbers, which are those of the present.
        let curves = Rect::new(area.x + 7, area.y + 4, area.width - 7, area.height - 5);
        curves
            .positions()
            .map(|at| buffer[at].symbol().to_owned())
            .collect::<String>()
    };
    [areas.energies, areas.entropy]
        .into_iter()
        .map(cells)
        .collect()
}

#[test]
fn the_way_back_is_drawn_dot_by_dot_on_the_way_out() {
    let mut bench = dam();
    bench.seek(1800);
    bench.key(Key::Home);
    bench.shot_at(0);
    let both = plots(&bench.state);
    let stage = bench.state.session.stage.as_mut().expect("a scene");
    assert!(stage.track.back().len() > 5);
    let mut out = Track::default();
    for row in stage.track.out() {
        out.push(row.clone(), loschmidt_runner::Arrow::Forward);
    }
    stage.track = out;
    let curves = |text: &String| {
        text.chars()
            .filter(|c| ('\u{2801}'..='\u{28ff}').contains(c))
            .count()
    };
    assert!(both.iter().all(|plot| curves(plot) > 12));
    assert_eq!(both, plots(&bench.state));
}

#[test]
fn the_fitted_curve_bites_no_holes_into_the_bars() {
    let mut bench = dam();
    bench.state.size = (200, 60);
    bench.seek(1000);
    let area = Areas::of(bench.state.size).speeds;
    let with = bench.screen();
    let stage = bench.state.session.stage.as_mut().expect("a scene");
    let moment = stage.moment.as_mut().expect("measured");
    moment.row.fitted_temperature_m2_per_s2 = None;
    let bars = bench.screen();
    let mut crossed = 0;
    for at in area
        .positions()
        .filter(|at| at.y > area.y && at.y + 1 < area.bottom())
    {
        let (bar, cell) = (&bars[at], &with[at]);
        if bar.symbol() == " " || *cell == *bar {
            continue;
        }
        crossed += 1;
        // A whole bar is the ground of the curve; the end of a bar is still there.
        let kept = cell.symbol() == bar.symbol() || (bar.symbol() == "█" && cell.bg == bar.fg);
        assert!(kept, "{at}: {cell:?} over {bar:?}");
    }
    assert!(crossed > 5, "{crossed}");
}

#[test]
fn axes_rest_while_the_dam_breaks() {
    let mut bench = dam();
    let range = |bench: &Bench| {
        let areas = Areas::of(bench.state.size);
        let shown = text(&bench.screen());
        let lines = shown.lines().skip(usize::from(areas.energies.y + 1));
        let lines = lines.take(usize::from(areas.energies.height));
        let numbers = lines.filter_map(|line| {
            let right: String = line.chars().skip(usize::from(areas.energies.x)).collect();
            let (number, _) = right.split_once('│')?;
            number.trim().parse::<f64>().ok()
        });
        numbers.collect::<Vec<f64>>()
    };
    bench.seek(100);
    let first = range(&bench);
    assert_eq!(first.len(), 2, "{first:?}");
    let mut fastest = 0.0;
    for step in [400, 800, 1600] {
        bench.seek(step);
        assert_eq!(range(&bench), first);
        // The axis of speeds goes one way, and no more than a part of it at once.
        let stage = bench.state.session.stage.as_ref().expect("a scene");
        assert!(stage.fastest >= fastest);
        fastest = stage.fastest;
    }
}

#[test]
fn a_bar_tells_the_length_scale() {
    let mut bench = dam();
    for size in [(200, 60), (120, 40)] {
        bench.state.size = size;
        let shown = text(&bench.screen());
        let line = shown
            .lines()
            .find(|line| line.contains('├'))
            .expect("a bar");
        let bar: String = line.chars().skip_while(|c| *c != '├').collect();
        let (bar, rest) = bar.split_once(' ').expect("a length");
        let metres: f64 = rest
            .split(' ')
            .next()
            .and_then(|n| n.parse().ok())
            .expect("a number");
        assert!(rest.contains(" m"), "{rest}");
        // As many cells as a rectangle of that length covers.
        let stage = bench.state.session.stage.as_ref().expect("a scene");
        let field = Areas::of(size).field;
        let (width, height) = (usize::from(field.width), 2 * usize::from(field.height));
        let view = &bench.state.session.look.view;
        let scale = Projection::new(&stage.home, view, width, height).scale();
        let cells = bar.chars().count() as f64;
        assert!(
            (cells - metres * scale).abs() <= 0.5,
            "{cells} cells for {metres} m"
        );
    }
}

#[test]
fn the_help_names_every_key_of_the_table() {
    let mut bench = dam();
    for size in [(200, 60), (100, 30), (60, 20)] {
        bench.state.size = size;
        bench.key(Key::Escape);
        bench.key(Key::Char('?'));
        let mut shown = text(&bench.screen());
        // Where there is no room for all, the arrow keys show the others.
        for _ in keys::TABLE {
            bench.key(Key::Down);
        }
        shown += &text(&bench.screen());
        for binding in keys::TABLE {
            let whole = format!("{} ", binding.names());
            assert!(shown.contains(&whole), "{whole}\n{shown}");
            assert!(
                shown.contains(binding.meaning),
                "{}\n{shown}",
                binding.meaning
            );
        }
    }
}

#[test]
fn the_readme_shows_the_table_of_keys() {
    let readme = include_str!("../../../../README.md");
    assert!(readme.contains(&keys::markdown()), "{}", keys::markdown());
}

#[test]
fn the_banner_shows_both_digests_until_a_key() {
    let mut bench = dam();
    bench.key(Key::Char('r'));
    bench.key(Key::Home);
    bench.shot_at(0);
    let digest = bench
        .state
        .session
        .stage
        .as_ref()
        .expect("a scene")
        .opened
        .digest;
    for size in [(200, 60), (60, 20)] {
        bench.state.size = size;
        let shown = text(&bench.screen());
        assert!(shown.contains("bit-identical"), "{shown}");
        assert_eq!(shown.matches(&digest.to_string()).count(), 2, "{shown}");
    }
    bench.key(Key::Escape);
    assert!(!text(&bench.screen()).contains("bit-identical"));
}

#[test]
fn a_flipped_bit_is_counted_and_told_of() {
    let mut bench = dam();
    bench.key(Key::Char('r'));
    bench.key(Key::Char('b'));
    bench.until(|report| matches!(report, Report::Meddled(_)));
    bench.seek(0);
    let shown = text(&bench.screen());
    assert!(shown.contains("TIME DID NOT COME BACK"), "{shown}");
    assert!(
        shown.contains("one bit of particle 100 was flipped"),
        "{shown}"
    );
    assert!(shown.contains("not on their way home"), "{shown}");
}

#[test]
fn a_click_on_the_bar_goes_there_by_integrating() {
    let mut bench = dam();
    let areas = Areas::of(bench.state.size);
    let span = bench.state.session.stage.as_ref().expect("a scene").span();
    for column in [
        areas.bar.x,
        areas.bar.x + areas.bar.width / 10,
        areas.bar.right() - 1,
    ] {
        let step = areas.steps_at(column, span);
        bench.tell(DashboardMessage::Mouse(
            Mouse::Press(Button::Left),
            column,
            areas.bar.y,
        ));
        bench.tell(DashboardMessage::Mouse(Mouse::Release, column, areas.bar.y));
        bench.shot_at(step);
    }
    assert_eq!(areas.steps_at(areas.bar.x, span), 0);
    assert_eq!(areas.steps_at(areas.bar.right() - 1, span), span);
}

#[test]
fn too_small_a_terminal_says_what_it_needs() {
    let mut bench = dam();
    for size in [(59, 20), (60, 19), (12, 3), (1, 1), (0, 0)] {
        bench.state.size = size;
        let shown = text(&bench.screen());
        assert!(size.0 < 14 || shown.contains("at least 60 x 20"), "{shown}");
    }
}
