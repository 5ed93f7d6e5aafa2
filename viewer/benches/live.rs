//! What watching costs: steps a second of a scene that is played as fast as it goes, side by side
//! headless, without pictures, with frames handed over 60 times a second, and with pictures of
//! 1280 x 720 pixels drawn of them.
//!
//!     cargo bench -p loschmidt-viewer --bench live [SPACING] [SECONDS]
//!
//! The pictures are those of the window; what an X server does with them is not in it.

use loschmidt_runner::deck::{Command, Opening, Report, Wishes};
use loschmidt_runner::run::{Plan, Row};
use loschmidt_runner::scene::{load, resolve};
use loschmidt_runner::{Deck, Frame, Options, Player};
use loschmidt_viewer::{History, Home, Look, Pane, Raster, Rgb, draw_on};
use std::sync::mpsc::channel;
use std::time::{Duration, Instant};

/// Rounds of one after the other, so that a busy machine is fair to all.
const ROUNDS: usize = 5;
const SIZE: (usize, usize) = (1280, 720);
const FRAMES: u32 = 60;

fn main() {
    let arguments: Vec<String> = std::env::args()
        .skip(1)
        .filter(|a| !a.starts_with('-'))
        .collect();
    let spacing = arguments.first().map_or("0.005", String::as_str);
    let seconds = arguments.get(1).and_then(|s| s.parse().ok());
    let time = Duration::from_secs_f64(seconds.unwrap_or(5.0));
    let scene = resolve("dam-break").expect("a scene of the catalogue");
    let scene = load(&scene, &[format!("particle_spacing={spacing}")]).expect("a scene");
    println!(
        "{:>14} {:>14} {:>14} {:>14} {:>7} {:>10}",
        "headless", "unwatched", "handed over", "watched", "ratio", "frames/s"
    );
    let mut ratios = Vec::new();
    for _ in 0..ROUNDS {
        let initial = scene.initial_state().expect("particles");
        let mut player = Player::new(scene.clone(), initial, Options::default()).expect("a player");
        let headless = headless(&mut player, time);
        drop(player);
        let opening = || Opening {
            scene: scene.clone(),
            options: Options::default(),
            recorded: None,
            pace: Some(1e6),
        };
        let (unwatched, _) = played(opening(), time, Watch::No);
        let (handed, _) = played(opening(), time, Watch::Frames);
        let (watched, frames) = played(opening(), time, Watch::Pictures);
        let ratio = watched / headless;
        println!(
            "{headless:>9.1} st/s {unwatched:>9.1} st/s {handed:>9.1} st/s {watched:>9.1} st/s \
             {:>5.1} % {frames:>10.1}",
            100.0 * ratio
        );
        ratios.push(ratio);
    }
    ratios.sort_by(f64::total_cmp);
    let median = 100.0 * ratios[ROUNDS / 2];
    println!("median {median:.1} % of the headless throughput");
}

/// What is done with the frames.
#[derive(PartialEq)]
enum Watch {
    No,
    Frames,
    Pictures,
}

/// Steps a second, measured at every row as a run does.
fn headless(player: &mut Player, time: Duration) -> f64 {
    let every = Plan::of(player.scene()).row_every;
    let began = Instant::now();
    while began.elapsed() < time {
        player.advance(every).expect("numbers in range");
        Row::measure(player, 1).expect("numbers in range");
    }
    player.steps_taken() as f64 / began.elapsed().as_secs_f64()
}

/// Steps and pictures a second.
fn played(opening: Opening, time: Duration, watch: Watch) -> (f64, f64) {
    let (sender, inbox) = channel();
    let wishes = Wishes {
        frames: FRAMES,
        beside: false,
    };
    let deck = Deck::open_with(opening, wishes, move |report| {
        // The last ones come when nobody listens any more.
        let _ = sender.send(report);
    })
    .expect("a thread");
    let mut shown: Option<(Home, History, Frame)> = None;
    let mut raster = Raster::new(SIZE.0, SIZE.1, Rgb(0));
    let look = Look::default();
    let (mut began, mut first, mut pictures) = (None, 0, 0);
    let steps = loop {
        match inbox.recv().expect("a report") {
            Report::Opened(opened) => {
                let home = Home::new(&opened.scene, &opened.home);
                let history = History::new(home.span);
                shown = Some((home, history, opened.home));
                deck.ready();
            }
            Report::Shot(shot) => {
                let began = *began.get_or_insert_with(|| {
                    first = shot.status.position;
                    Instant::now()
                });
                if began.elapsed() > time {
                    break shot.status.position - first;
                }
                let Some((home, history, frame)) = &mut shown else {
                    continue;
                };
                let old = std::mem::replace(frame, shot.frame);
                deck.send(Command::Reuse(Box::new(old)));
                if watch == Watch::Pictures {
                    let panes = [Pane::new(frame, history)];
                    deck.install(|| draw_on(&mut raster.draw(), &panes, home, &look, SIZE.1));
                    pictures += 1;
                } else if watch == Watch::No {
                    // Two pictures are enough to count the steps between them.
                    std::thread::sleep(time);
                }
                deck.ready();
            }
            Report::Moment(moment) => {
                if let Some((_, history, _)) = &mut shown {
                    history.push((&moment.row).into());
                }
            }
            Report::Failed(why) => panic!("{why}"),
            _ => {}
        }
    };
    deck.send(Command::Play(false));
    let taken = began.map_or(time, |began| began.elapsed()).as_secs_f64();
    (steps as f64 / taken, f64::from(pictures) / taken)
}
