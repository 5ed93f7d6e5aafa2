//! The pixels are a function of the points and the look alone.

use crate::home::after;
use loschmidt_runner::Points;
use loschmidt_runner::points::PointColumn;
use loschmidt_viewer::{
    Colormap, Colouring, History, Home, Look, Pane, Picture, Raster, Rect, Rgb, Theme, View, draw,
    draw_on, field, picture, png,
};
use std::fs::File;
use std::io::BufReader;
use std::path::PathBuf;

fn golden(name: &str) -> PathBuf {
    let directory = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/golden");
    directory.join(format!("{name}.png"))
}

/// Compares with the committed picture; with `LOSCHMIDT_BLESS` set, writes it.
fn assert_golden(name: &str, raster: &Raster) {
    let path = golden(name);
    if std::env::var_os("LOSCHMIDT_BLESS").is_some() {
        std::fs::create_dir_all(path.parent().expect("a parent")).expect("a directory");
        png::write(raster, File::create(&path).expect("a file")).expect("written");
    }
    let file = File::open(&path).expect("the committed picture");
    let expected = picture::read(BufReader::new(file), Rgb(0)).expect("a PNG");
    if *raster != expected {
        let found = std::env::temp_dir().join(format!("{name}.png"));
        png::write(raster, File::create(&found).expect("a file")).expect("written");
        panic!(
            "{name}: {} differs from {}",
            found.display(),
            path.display()
        );
    }
}

/// Draws with so many threads.
fn with_threads<T: Send>(threads: usize, task: impl FnOnce() -> T + Send) -> T {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    pool.expect("threads").install(task)
}

/// The same picture with 1, 2 and 8 threads, and the committed one.
fn assert_same(name: &str, picture: impl Fn() -> Raster + Sync) {
    let one = with_threads(1, &picture);
    for threads in [2, 8] {
        assert!(with_threads(threads, &picture) == one, "{threads} threads");
    }
    assert_golden(name, &one);
}

fn dam() -> (Points, Home, History) {
    after("dam-break", &["particle_spacing=0.05"], 1500)
}

#[test]
fn the_pixels_of_a_plane_scene_are_the_committed_ones_for_any_number_of_threads() {
    let (points, home, history) = dam();
    let look = Look::default();
    assert_same("dam-break", || {
        draw(&[Pane::new(&points, &history)], &home, &look, 320, 240)
    });
}

#[test]
fn the_pixels_of_two_panes_are_the_committed_ones_for_any_number_of_threads() {
    let (points, home, history) = dam();
    let look = Look {
        colouring: Colouring::Displacement,
        caption: "a caption".to_owned(),
        theme: Theme::LIGHT,
        turn: Some(0.3),
        ..Look::default()
    };
    let one = Pane {
        label: "one",
        ..Pane::new(&points, &history)
    };
    let other = Pane {
        label: "another",
        colouring: Some(&Colouring::PRESSURE),
        ..one
    };
    assert_same("two-panes", || draw(&[one, other], &home, &look, 480, 270));
}

#[test]
fn the_pixels_of_a_scene_in_space_are_the_committed_ones_for_any_number_of_threads() {
    let (points, home, history) = after("dam-break-3d", &["particle_spacing=0.1"], 200);
    let look = Look {
        colouring: Colouring::InitialHeight,
        colormap: Some(Colormap::Cividis),
        ..Look::default()
    };
    assert_same("dam-break-3d", || {
        draw(&[Pane::new(&points, &history)], &home, &look, 320, 240)
    });
}

/// Fluid at rest, where the colours begin, from a picture of a movie down to that of a terminal.
#[test]
fn fluid_in_space_is_seen_on_either_ground_and_before_the_walls() {
    let (points, home, _) = after("dam-break-3d", &["particle_spacing=0.1"], 0);
    for theme in [Theme::DARK, Theme::LIGHT] {
        for (width, height) in [(640, 480), (90, 60)] {
            let look = Look {
                theme,
                ..Look::default()
            };
            let walls = Points {
                id: Vec::new(),
                position: Default::default(),
                speed: Vec::new(),
                columns: Vec::new(),
                ..points.clone()
            };
            let [with, without] =
                [&points, &walls].map(|it| field(it, &home, &look, width, height));
            let pixels = || with.pixels().iter().zip(without.pixels());
            let ground = theme.background;
            let mut seen: Vec<f64> = pixels()
                .filter(|(a, b)| a != b)
                .map(|(&a, _)| Rgb(a).contrast(ground))
                .collect();
            assert!(seen.len() > width * height / 40, "{}", seen.len());
            seen.sort_by(f64::total_cmp);
            let [low, middle] = [seen[seen.len() / 10], seen[seen.len() / 2]];
            assert!(
                low > 1.6 && middle > 2.2,
                "{width} {theme:?} {low} {middle}"
            );
            // Walls are a veil, and no fog.
            let mut fog: Vec<f64> = pixels().map(|(_, &b)| Rgb(b).contrast(ground)).collect();
            fog.sort_by(f64::total_cmp);
            let thick = fog[fog.len() * 19 / 20];
            assert!(thick < 2.0, "{width} {theme:?} {thick}");
            // The front edges of their box are not drawn over the fluid.
            let alone = field(
                &Points {
                    wall_position: Vec::new(),
                    ..points.clone()
                },
                &Home {
                    walls: None,
                    ..home.clone()
                },
                &look,
                width,
                height,
            );
            let same = pixels().zip(alone.pixels());
            let inside = same.filter(|((a, b), _)| a != b);
            let (equal, all) = inside.fold((0, 0), |(equal, all), ((a, _), c)| {
                (equal + usize::from(a == c), all + 1)
            });
            assert!(equal * 10 > all * 7, "{width} {equal} of {all}");
        }
    }
}

#[test]
fn a_terminal_gets_the_particles_of_the_picture() {
    let (points, home, history) = dam();
    let look = Look {
        panel: false,
        ..Look::default()
    };
    let whole = draw(&[Pane::new(&points, &history)], &home, &look, 90, 60);
    assert!(whole == field(&points, &home, &look, 90, 60));
}

#[test]
fn at_home_a_tint_is_the_picture() {
    // 20 x 40 particles, 1 x 2 m, and a picture of the same proportions.
    let (_, home, _) = after("dam-break", &["particle_spacing=0.05"], 0);
    let mut picture = Raster::new(20, 40, Rgb(0));
    for (n, pixel) in picture.pixels_mut().iter_mut().enumerate() {
        *pixel = (n as u32).wrapping_mul(2_654_435_761) & 0xff_ffff;
    }
    let tint = Picture::new(picture.clone()).tint(&home);
    for (x, colour) in home.position.iter().zip(&tint) {
        let (column, row) = ((x[0] / 0.05) as usize, ((2.0 - x[1]) / 0.05) as usize);
        assert_eq!(*colour, picture.at(column, row), "at {x:?}");
    }
}

/// The particles in another order: from the middle backwards.
fn shuffled(points: &Points) -> Points {
    let n = points.len();
    let order: Vec<usize> = (0..n).map(|k| (n + n / 2 - k) % n).collect();
    let of = |list: &Vec<f32>| match list.is_empty() {
        true => Vec::new(),
        false => order.iter().map(|&i| list[i]).collect(),
    };
    let columns = points.columns.iter().map(|column| PointColumn {
        measure: column.measure,
        values: of(&column.values),
    });
    let columns = columns.collect();
    Points {
        id: order.iter().map(|&i| points.id[i]).collect(),
        position: points.position.each_ref().map(of),
        speed: of(&points.speed),
        columns,
        ..points.clone()
    }
}

#[test]
fn a_picture_depends_on_no_order_of_the_particles() {
    let space = || after("dam-break-3d", &["particle_spacing=0.1"], 200);
    for (points, home, _) in [dam(), space()] {
        let other = shuffled(&points);
        assert_ne!(points.id, other.id);
        for colouring in Colouring::MEASURED {
            let look = Look {
                colouring,
                ..Look::default()
            };
            let [one, two] = [&points, &other].map(|points| field(points, &home, &look, 200, 150));
            assert!(one == two, "{}", look.colouring.name());
        }
    }
}

#[test]
fn a_scene_may_be_panned_turned_and_zoomed_to_anywhere() {
    let space = after("dam-break-3d", &["particle_spacing=0.1"], 0);
    for (points, home, _) in [dam(), space] {
        for zoom in [0.05, 0.7, 1.0, 3.0, 40.0, 1e4] {
            for (yaw, pitch) in [(0.0, 0.0), (0.6, 0.4), (2.5, -1.5)] {
                for n in 0..25 {
                    let pan = [n % 5, n / 5].map(|k| 0.35 * (f64::from(k) - 2.0));
                    let view = View {
                        zoom,
                        pan,
                        yaw,
                        pitch,
                    };
                    let look = Look {
                        view,
                        ..Look::default()
                    };
                    let picture = field(&points, &home, &look, 90, 70);
                    assert_eq!(picture.pixels().len(), 90 * 70);
                }
            }
        }
    }
}

#[test]
fn a_picture_drawn_over_another_one_is_the_same() {
    let (points, home, history) = dam();
    let (start, _, _) = after("dam-break", &["particle_spacing=0.05"], 0);
    let empty = History::new(home.span);
    let look = Look::default();
    let light = Look {
        theme: Theme::LIGHT,
        caption: "a caption".to_owned(),
        ..Look::default()
    };
    // Every one of them changes what may be left over from the one before: particles, curves,
    // words, the way of time, the legend, the colours.
    let back = Points {
        way_back: true,
        ..points.clone()
    };
    let pressure = Look {
        colouring: Colouring::PRESSURE,
        ..Look::default()
    };
    let pictures = [
        (&points, &history, &look),
        (&start, &history, &look),
        (&start, &empty, &look),
        (&points, &history, &light),
        (&back, &history, &light),
        (&points, &history, &pressure),
        (&points, &history, &look),
    ];
    let mut raster = Raster::new(320, 250, Rgb(0xff_00ff));
    for (n, (points, history, look)) in pictures.into_iter().enumerate() {
        let panes = [Pane::new(points, history)];
        draw_on(&mut raster.draw(), &panes, &home, look, 240);
        // A thread that has drawn nothing yet has nothing left over.
        let fresh = std::thread::scope(|scope| {
            let drawn = scope.spawn(|| draw(&panes, &home, look, 320, 240));
            drawn.join().expect("a picture")
        });
        assert!(raster.part(fresh.rect()) == fresh, "picture {n}");
    }
    let below = Rect::new(0, 240, 320, 10);
    assert!(raster.part(below).pixels().iter().all(|&p| p == 0xff_00ff));
}

/// A picture of one place with so many particles of each of these colours.
fn crowd(colours: [Rgb; 2], each: usize) -> Raster {
    let (mut points, home, _) = after("dam-break", &["particle_spacing=0.1"], 0);
    let n = 2 * each;
    points.id = (0..n as u64).collect();
    points.position = [vec![0.5; n], vec![0.5; n], Vec::new()];
    points.speed = vec![0.0; n];
    for (column, value) in points.columns.iter_mut().zip([1000.0, 0.0]) {
        column.values = vec![value; n];
    }
    let tint = (0..n).map(|id| colours[id / each]);
    let look = Look {
        colouring: Colouring::Picture(tint.collect()),
        ..Look::default()
    };
    field(&points, &home, &look, 100, 100)
}

#[test]
fn where_discs_crowd_the_mean_is_still_that_of_all() {
    // Far beyond what single precision adds exactly, and beyond 32 bits.
    let colours = [Rgb(0x01_0203), Rgb(0xff_fdfb)];
    for each in [1, 1000, 200_000] {
        let drawn = crowd(colours, each);
        assert!(drawn.pixels().contains(&0x80_807f), "{each}");
    }
}
