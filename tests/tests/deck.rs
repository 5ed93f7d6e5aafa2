//! The deck: what is watched is the run, bit for bit, however one goes to and fro in it.

use loschmidt_core::Digest;
use loschmidt_runner::deck::{Arrival, Command, Opening, Report, Status};
use loschmidt_runner::output::{RunDirectory, Snapshot};
use loschmidt_runner::player::PlayerError;
use loschmidt_runner::{ArithmeticKind, Arrow, Deck, Options};
use loschmidt_tests::program;
use std::path::Path;
use std::sync::mpsc::{Receiver, channel};
use std::time::Duration;

const SET: [&str; 1] = ["particle_spacing=0.1"];

/// A deck, and what it says; a picture is taken as soon as it is there.
struct Watched {
    deck: Deck,
    inbox: Receiver<Report>,
}

impl Watched {
    fn open(name: &str, set: &[&str], pace: f64) -> Self {
        let set: Vec<String> = set.iter().map(|s| (*s).to_owned()).collect();
        let opening = Opening::of(name, &set, Options::default()).unwrap_or_else(|e| panic!("{e}"));
        Self::of(opening, pace)
    }

    fn of(mut opening: Opening, pace: f64) -> Self {
        opening.pace = Some(pace);
        let (sender, inbox) = channel();
        let deck = Deck::open(opening, move |report| drop(sender.send(report))).expect("a thread");
        Self { deck, inbox }
    }

    fn until<T>(&self, mut wanted: impl FnMut(Report) -> Option<T>) -> T {
        loop {
            let report = self
                .inbox
                .recv_timeout(Duration::from_secs(60))
                .expect("a report");
            if matches!(report, Report::Shot(_)) {
                self.deck.ready();
            }
            if let Some(found) = wanted(report) {
                return found;
            }
        }
    }

    fn seek(&self, target: i64) {
        self.deck.send(Command::Seek(target));
        self.until(|report| matches!(report, Report::SeekEnded(true)).then_some(()));
    }

    fn arrival(&self) -> Arrival {
        self.until(|report| match report {
            Report::Arrived(arrival) => Some(*arrival),
            _ => None,
        })
    }

    /// The digest of the present state, from the snapshot that the deck leaves.
    fn digest(&self, directory: &Path) -> (Digest, i64) {
        let command = Command::Keep {
            path: directory.to_owned(),
            rows: Vec::new(),
        };
        self.deck.send(command);
        self.until(|report| match report {
            Report::Kept(_) => Some(()),
            Report::NotKept(why) => panic!("{why}"),
            _ => None,
        });
        let path = RunDirectory::snapshot_path(directory, "latest");
        let snapshot = Snapshot::read(&path).expect("a snapshot");
        (snapshot.digest(), snapshot.position)
    }
}

/// The digest of the plain player after so many steps.
fn plain(steps: u64) -> Digest {
    let mut player = program::player(program::scene("dam-break", &SET), Options::default());
    player.advance(steps).unwrap_or_else(|e| panic!("{e}"));
    player.digest()
}

#[test]
fn a_run_that_is_watched_has_the_digest_of_one_that_is_not() {
    let place = tempfile::tempdir().expect("a directory");
    // As fast as it goes, all pictures drawn, and stopped anywhere.
    let watched = Watched::open("dam-break", &SET, 1e3);
    watched.until(|report| match report {
        Report::Shot(shot) => (shot.status.position > 300).then_some(()),
        _ => None,
    });
    watched.deck.send(Command::Play(false));
    let (digest, position) = watched.digest(&place.path().join("a"));
    assert!(position > 300);
    assert_eq!(digest, plain(position as u64));
}

#[test]
fn the_numbers_beside_a_picture_are_those_of_the_picture() {
    // The series has two rows, the first and the last.
    let set = ["particle_spacing=0.1", "output.rows=2"];
    let watched = Watched::open("dam-break", &set, 1e3);
    let mut row = None;
    let mut pictures = 0;
    while pictures < 20 {
        watched.until(|report| match report {
            Report::Moment(moment) => {
                row = Some(moment.row);
                Some(())
            }
            Report::Shot(shot) => {
                let row = row.as_ref().expect("measured");
                assert_eq!(row.position, shot.status.position);
                let squares = shot.points.speed.iter().map(|&v| f64::from(v).powi(2));
                // A square of 0.1 m of water, a metre deep, weighs 10 kg.
                let kinetic = 0.5 * 10.0 * squares.sum::<f64>();
                assert!((row.energy("kinetic") - kinetic).abs() <= 1e-5 * kinetic);
                pictures += 1;
                Some(())
            }
            _ => None,
        });
    }
}

#[test]
fn to_and_fro_leads_to_the_same_bits() {
    let place = tempfile::tempdir().expect("a directory");
    let watched = Watched::open("dam-break", &SET, 1e-9);
    for target in [500, 123, 700, 0, 250, 251] {
        watched.seek(target);
    }
    watched.deck.send(Command::Turn);
    watched.deck.send(Command::StepBy(-10));
    watched.until(|report| matches!(report, Report::SeekEnded(true)).then_some(()));
    watched.deck.send(Command::Turn);
    let (digest, position) = watched.digest(&place.path().join("a"));
    assert_eq!(position, 241);
    assert_eq!(digest, plain(241));
}

#[test]
fn time_never_turns_by_itself_and_stops_at_the_start() {
    let watched = Watched::open(
        "dam-break",
        &["particle_spacing=0.1", "turnaround=0.01"],
        1e3,
    );
    // Far beyond the turnaround of the scene.
    watched.until(|report| match report {
        Report::Shot(shot) => {
            assert_eq!(shot.status.arrow, Arrow::Forward);
            (shot.status.position > 200).then_some(())
        }
        _ => None,
    });
    watched.deck.send(Command::Turn);
    let arrival = watched.arrival();
    assert!(arrival.comparison.is_exact());
    assert!(arrival.farthest > 200);
    // A tenth of a second, in which it would have gone hundreds of steps.
    std::thread::sleep(Duration::from_millis(100));
    watched.deck.send(Command::Pace(1e3));
    let status: Status = watched.until(|report| match report {
        Report::Status(status) => (status.pace > 0.0 && status.at_start).then_some(status),
        _ => None,
    });
    assert_eq!((status.position, status.arrow), (0, Arrow::Backward));
}

#[test]
fn the_pace_is_that_of_simulated_time_and_not_of_the_machine() {
    // 200 steps a second, far fewer than any machine can take of 200 particles.
    let scene = program::scene("dam-break", &SET);
    let pace = 200.0 * scene.time_step();
    let watched = Watched::open("dam-break", &SET, pace);
    let after = |position: i64| {
        watched.until(|report| match report {
            Report::Shot(shot) => {
                let there = shot.status.position >= position;
                there.then(|| (std::time::Instant::now(), shot.status.position))
            }
            _ => None,
        })
    };
    let (first, from) = after(20);
    let (last, to) = after(from + 200);
    let rate = (to - from) as f64 / (last - first).as_secs_f64();
    // A machine that is busy elsewhere is late, and forgets what it was late by; never early.
    assert!((100.0..=215.0).contains(&rate), "{rate}");
}

#[test]
fn a_flipped_bit_is_astray_at_once_and_the_start_is_missed() {
    let watched = Watched::open("dam-break", &SET, 1e-9);
    watched.seek(1000);
    watched.deck.send(Command::Turn);
    watched.seek(900);
    watched.deck.send(Command::Flip(7));
    watched.deck.send(Command::Seek(0));
    let mut astray = Vec::new();
    let arrival = loop {
        let report = watched
            .inbox
            .recv_timeout(Duration::from_secs(60))
            .expect("a report");
        match report {
            Report::Shot(shot) => {
                watched.deck.ready();
                astray.extend(shot.status.astray);
            }
            Report::Arrived(arrival) => break arrival,
            _ => {}
        }
    };
    assert!(!arrival.comparison.is_exact());
    assert!(arrival.comparison.error > 0.0);
    assert_eq!(arrival.meddling.len(), 1);
    assert!(astray.last().is_some_and(|&n| n > 1), "{astray:?}");
}

#[test]
fn without_meddling_nobody_is_ever_astray() {
    let watched = Watched::open("dam-break", &SET, 1e-9);
    watched.seek(600);
    watched.deck.send(Command::Turn);
    watched.deck.send(Command::Seek(0));
    let arrival = watched.until(|report| match report {
        Report::Shot(shot) => {
            assert_eq!(shot.status.astray.unwrap_or(0), 0);
            None
        }
        Report::Arrived(arrival) => Some(*arrival),
        _ => None,
    });
    assert!(arrival.comparison.is_exact());
    assert_eq!((arrival.farthest, arrival.comparison.astray), (600, 0));
}

#[test]
fn a_long_seek_can_be_cancelled_and_stays_where_it_is() {
    let watched = Watched::open("dam-break", &SET, 1e-9);
    watched.deck.send(Command::Seek(1_000_000));
    watched.until(|report| match report {
        Report::Shot(shot) => (shot.status.position > 100).then_some(()),
        _ => None,
    });
    watched.deck.send(Command::Cancel);
    watched.until(|report| matches!(report, Report::SeekEnded(false)).then_some(()));
    let status = watched.until(|report| match report {
        Report::Status(status) => Some(status),
        _ => None,
    });
    assert_eq!((status.seek, status.playing), (None, false));
    assert!(status.position < 1_000_000);
    // And back from there.
    watched.seek(0);
}

#[test]
fn what_cannot_go_back_says_why() {
    let refused = |watched: &Watched, command: Command| {
        watched.deck.send(command);
        watched.until(|report| match report {
            Report::Refused(why) => Some(why.to_string()),
            _ => None,
        })
    };
    let standard = Watched::open(
        "dam-break",
        &["particle_spacing=0.1", "model=standard", "wall_model=dummy"],
        1e-9,
    );
    standard.seek(50);
    let why = PlayerError::Irreversible.to_string();
    assert_eq!(refused(&standard, Command::Seek(0)), why);
    assert_eq!(refused(&standard, Command::StepBy(-1)), why);
    assert_eq!(refused(&standard, Command::Turn), why);

    let float = Watched::open("dam-break", &SET, 1e-9);
    float.seek(50);
    float.deck.send(Command::Switch(ArithmeticKind::Float));
    let why = PlayerError::FloatingPoint.to_string();
    assert_eq!(refused(&float, Command::Seek(0)), why);
    assert_eq!(refused(&float, Command::StepBy(-1)), why);
}

#[test]
fn what_was_kept_is_opened_where_it_was_left() {
    let place = tempfile::tempdir().expect("a directory");
    let path = place.path().join("kept");
    let watched = Watched::open("dam-break", &SET, 1e-9);
    watched.seek(300);
    watched.deck.send(Command::Turn);
    let (digest, _) = watched.digest(&path);
    drop(watched);

    let name = path.to_str().expect("UTF-8");
    let again = Watched::open(name, &[], 1e-9);
    let opened = again.until(|report| match report {
        Report::Opened(opened) => Some(opened),
        _ => None,
    });
    assert_eq!(
        (opened.status.position, opened.status.arrow),
        (300, Arrow::Backward)
    );
    let other = place.path().join("other");
    assert_eq!(again.digest(&other).0, digest);
    again.deck.send(Command::Seek(0));
    assert!(again.arrival().comparison.is_exact());
}

#[test]
fn where_the_numbers_end_the_last_good_state_is_shown() {
    // A time step three times what the scheme can bear.
    let watched = Watched::open("dam-break", &["particle_spacing=0.1", "cfl=0.9"], 1e3);
    watched.until(|report| matches!(report, Report::Fault(_)).then_some(()));
    let status = watched.until(|report| match report {
        Report::Status(status) => Some(status),
        _ => None,
    });
    assert!(!status.playing);
    // It is a state of the run: it leads back home.
    watched.deck.send(Command::Seek(0));
    assert!(watched.arrival().comparison.is_exact());
}

#[test]
fn what_was_done_by_hand_is_still_known_when_it_is_opened_again() {
    let place = tempfile::tempdir().expect("a directory");
    let path = place.path().join("kept");
    let watched = Watched::open("dam-break", &SET, 1e-9);
    watched.seek(100);
    watched.deck.send(Command::Flip(7));
    watched.deck.send(Command::Switch(ArithmeticKind::Float));
    watched.digest(&path);
    let status = watched.until(|report| match report {
        Report::Status(status) => Some(status),
        _ => None,
    });
    drop(watched);
    assert_eq!(status.meddling.len(), 2);

    let again = Watched::open(path.to_str().expect("UTF-8"), &[], 1e-9);
    let opened = again.until(|report| match report {
        Report::Opened(opened) => Some(opened),
        _ => None,
    });
    assert_eq!(opened.status.meddling, status.meddling);
}

#[test]
fn rows_on_the_way_out_are_the_same_whichever_way_the_arrow_points() {
    let watched = Watched::open("dam-break", &SET, 1e-9);
    let row_at = |position: i64| {
        watched.until(|report| match report {
            Report::Moment(m) if m.regular && m.row.position == position => Some(m.row),
            _ => None,
        })
    };
    let every = watched.until(|report| match report {
        Report::Opened(opened) => Some(opened.row_every),
        _ => None,
    });
    watched.deck.send(Command::Seek(3 * every));
    let out = row_at(3 * every);
    assert!(out.momentum_y_quanta < 0, "the water falls");
    watched.until(|report| matches!(report, Report::SeekEnded(true)).then_some(()));
    watched.seek(0);
    watched.deck.send(Command::Turn);
    watched.deck.send(Command::Seek(3 * every));
    let again = row_at(3 * every);
    assert_eq!((again.leg, again.position), (1, 3 * every));
    assert_eq!(again.momentum_quanta(), out.momentum_quanta());
    assert_eq!(again.angular_momentum_z, out.angular_momentum_z);
    assert_eq!(again.energies, out.energies);
}
