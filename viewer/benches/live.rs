//! What watching costs: steps a second of a scene that is played as fast as it goes, side by side
//! headless, without pictures, with points handed over 60 times a second, and with pictures of
//! 1280 x 720 pixels drawn of them.
//!
//!     cargo bench -p loschmidt-viewer --bench live [SPACING] [SECONDS]
//!
//! Four players of the same scene take turns of half a second, so that a busy machine is fair to
//! all; the throughputs are those of all turns together, SECONDS (20) for each. The pictures are
//! those of the window; what an X server does with them is not in it.

use loschmidt_runner::deck::{Command, Opening, Report, Wishes};
use loschmidt_runner::run::{Plan, Row};
use loschmidt_runner::scene::{Scene, load, resolve};
use loschmidt_runner::{Deck, Options, Player, Points};
use loschmidt_viewer::{History, Home, Look, Pane, Raster, Rgb, draw_on};
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};

const SIZE: (usize, usize) = (1280, 720);
const FRAMES: u32 = 60;
const TURN: Duration = Duration::from_millis(500);

fn main() {
    let arguments: Vec<String> = std::env::args()
        .skip(1)
        .filter(|a| !a.starts_with('-'))
        .collect();
    let spacing = arguments.first().map_or("0.005", String::as_str);
    let seconds = arguments.get(1).and_then(|s| s.parse().ok());
    let rounds = (seconds.unwrap_or(20.0) / TURN.as_secs_f64()).max(1.0) as usize;
    let scene = resolve("dam-break").expect("a scene of the catalogue");
    let scene = load(&scene, &[format!("particle_spacing={spacing}")]).expect("a scene");
    let initial = scene.initial_state().expect("particles");
    let mut headless = Player::new(scene.clone(), initial, Options::default()).expect("a player");
    let mut decks = [Watch::No, Watch::Points, Watch::Pictures]
        .map(|watch| (Played::open(&scene), watch, Turn::default()));
    let mut alone = Turn::default();
    let mut ratios = Vec::new();
    for round in 0..rounds {
        let before = alone;
        alone += turn_of(&mut headless);
        // Each round begins with another deck, so that none always follows the same one.
        let first = round % decks.len();
        for n in 0..decks.len() {
            let (deck, watch, sum) = &mut decks[(first + n) % 3];
            let turn = deck.turn(*watch);
            if *watch == Watch::Pictures {
                ratios.push(turn.speed() / (alone - before).speed());
            }
            *sum += turn;
        }
    }
    let particles = headless.home().id.len();
    println!("dam-break, {particles} particles, {rounds} turns of {TURN:?} each");
    println!("{:>12} {:>8.1} steps/s", "headless", alone.speed());
    for (_, watch, sum) in &decks {
        println!(
            "{:>12} {:>8.1} steps/s {:>6.1} % {:>6.1} pictures/s",
            watch.name(),
            sum.speed(),
            100.0 * sum.speed() / alone.speed(),
            f64::from(sum.pictures) / sum.time.as_secs_f64(),
        );
    }
    ratios.sort_by(f64::total_cmp);
    let at = |part: usize| 100.0 * ratios[(ratios.len() - 1) * part / 4];
    println!(
        "single turns: quartiles {:.1}, {:.1}, {:.1} %",
        at(1),
        at(2),
        at(3)
    );
}

/// What is done with the points.
#[derive(Clone, Copy, PartialEq)]
enum Watch {
    No,
    Points,
    Pictures,
}

impl Watch {
    fn name(self) -> &'static str {
        match self {
            Self::No => "unwatched",
            Self::Points => "handed over",
            Self::Pictures => "watched",
        }
    }
}

/// Steps and pictures in a time.
#[derive(Clone, Copy, Default)]
struct Turn {
    steps: u64,
    pictures: u32,
    time: Duration,
}

impl Turn {
    /// Steps per second.
    fn speed(&self) -> f64 {
        self.steps as f64 / self.time.as_secs_f64()
    }
}

impl std::ops::AddAssign for Turn {
    fn add_assign(&mut self, other: Self) {
        self.steps += other.steps;
        self.pictures += other.pictures;
        self.time += other.time;
    }
}

impl std::ops::Sub for Turn {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self {
            steps: self.steps - other.steps,
            pictures: self.pictures - other.pictures,
            time: self.time - other.time,
        }
    }
}

/// A turn without a deck, measured at every row as a run does.
fn turn_of(player: &mut Player) -> Turn {
    let every = Plan::of(player.scene()).row_every;
    // Ten pieces of a row: the turn ends soon after its time.
    let piece = (every / 10).max(1);
    let (began, first) = (Instant::now(), player.steps_taken());
    while began.elapsed() < TURN {
        player.advance(piece).expect("numbers in range");
        if player.steps_taken() % every < piece {
            Row::measure(player, 1).expect("numbers in range");
        }
    }
    Turn {
        steps: player.steps_taken() - first,
        pictures: 0,
        time: began.elapsed(),
    }
}

/// A deck and what is drawn of it.
struct Played {
    deck: Deck,
    inbox: Receiver<Report>,
    home: Home,
    history: History,
    points: Points,
    raster: Raster,
}

impl Played {
    /// A deck that stands still.
    fn open(scene: &Scene) -> Self {
        let (sender, inbox) = channel();
        let opening = Opening {
            scene: scene.clone(),
            options: Options::default(),
            recorded: None,
            pace: Some(1e6),
        };
        let wishes = Wishes {
            frames: FRAMES,
            beside: false,
        };
        let deck = Deck::open_with(opening, wishes, move |report| {
            // The last ones come when nobody listens any more.
            let _ = sender.send(report);
        })
        .expect("a thread");
        let home = loop {
            match inbox.recv().expect("a report") {
                Report::Opened(opened) => break opened,
                Report::Failed(why) => panic!("{why}"),
                _ => {}
            }
        };
        let points = Points::from(&home.home);
        let home = Home::new(&home.scene, &home.home);
        let mut played = Self {
            history: History::new(home.span),
            raster: Raster::new(SIZE.0, SIZE.1, Rgb(0)),
            deck,
            inbox,
            home,
            points,
        };
        played.stop();
        played
    }

    /// Pauses, and hears what was still to be said.
    fn stop(&mut self) {
        self.deck.send(Command::Play(false));
        loop {
            match self.inbox.recv().expect("a report") {
                Report::Status(status) if !status.playing => break,
                report => self.hear(report),
            }
        }
    }

    fn hear(&mut self, report: Report) {
        if let Report::Moment(moment) = report {
            self.history.push((&moment.row).into());
        }
    }

    /// Plays from one picture to another.
    fn turn(&mut self, watch: Watch) -> Turn {
        let look = Look::default();
        let mut began = None;
        let mut pictures = 0;
        self.deck.send(Command::Play(true));
        self.deck.ready();
        let turn = loop {
            let shot = match self.inbox.recv().expect("a report") {
                Report::Shot(shot) if shot.status.playing => shot,
                Report::Shot(_) => {
                    self.deck.ready();
                    continue;
                }
                report => {
                    self.hear(report);
                    continue;
                }
            };
            let now = Instant::now();
            let position = shot.status.position;
            let (first, since) = *began.get_or_insert((position, now));
            if now - since >= TURN {
                break Turn {
                    steps: (position - first).unsigned_abs(),
                    pictures,
                    time: now - since,
                };
            }
            let old = std::mem::replace(&mut self.points, shot.points);
            self.deck.send(Command::Reuse(Box::new(old)));
            match watch {
                // Two pictures are enough to count the steps between them.
                Watch::No => std::thread::sleep(TURN),
                Watch::Points => {}
                Watch::Pictures => {
                    let panes = [Pane::new(&self.points, &self.history)];
                    let raster = &mut self.raster;
                    self.deck
                        .install(|| draw_on(&mut raster.draw(), &panes, &self.home, &look, SIZE.1));
                }
            }
            pictures += 1;
            self.deck.ready();
        };
        self.stop();
        turn
    }
}
