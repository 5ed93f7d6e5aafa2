//! Snapshots: what is written is what is read, and what was damaged is not read at all.

use loschmidt_core::Scale;
use loschmidt_core::digest::hash;
use loschmidt_runner::output::Snapshot;
use loschmidt_runner::output::snapshot::Damage;
use loschmidt_runner::{ArithmeticKind, Arrow, SavedState};
use loschmidt_tests::program::{float, player, scene, serial};
use proptest::prelude::*;

/// Two particles and a wall in the plane.
fn tiny() -> Snapshot {
    let field = |name: &str, words: &[i64]| (name.to_owned(), words.to_vec());
    Snapshot {
        scene: *b"sixteen bytes ab",
        position: 3,
        arrow: Arrow::Backward,
        state: SavedState {
            dimension: 2,
            arithmetic: ArithmeticKind::Fixed,
            scale: Scale {
                length_exponent: -1,
                speed_exponent: 2,
                density_exponent: 0,
            },
            step: 17,
            id: vec![0, 1],
            fields: vec![
                field("position", &[1, -2, i64::MAX, i64::MIN]),
                field("velocity", &[5, 0, -7, 8]),
                field("density_constant", &[9, -10]),
            ],
            wall_position: vec![11, -12],
            wall_density: vec![13],
        },
    }
}

#[test]
fn the_bytes_of_a_snapshot_are_as_documented() {
    let bytes = tiny().to_bytes();
    let word = |n: i64| n.to_le_bytes();
    let mut expected = Vec::new();
    expected.extend_from_slice(b"LSCHSNAP");
    expected.extend(word(1));
    expected.extend_from_slice(b"sixteen bytes ab");
    for n in [2, 0, -1, 2, 0, 17, 3, 1, 2, 1, 3] {
        expected.extend(word(n));
    }
    let fields: [(&[u8], i64, &[i64]); 3] = [
        (b"position", 2, &[1, -2, i64::MAX, i64::MIN]),
        (b"velocity", 2, &[5, 0, -7, 8]),
        (b"density_constant", 1, &[9, -10]),
    ];
    for (name, components, words) in fields {
        expected.extend(word(name.len() as i64));
        expected.extend_from_slice(name);
        expected.extend(word(components));
        words.iter().for_each(|n| expected.extend(word(*n)));
    }
    for n in [0, 1, 11, -12, 13] {
        expected.extend(word(n));
    }
    let checksum = hash(&expected);
    expected.extend_from_slice(&checksum);
    assert_eq!(bytes, expected);
    assert_eq!(hex(&checksum), "da1f612087de70bf0180f5dea21dfc8a");
    assert_eq!(
        tiny().digest().to_string(),
        "e8ddc83e8dd44a9b97542bba7fd74bf7"
    );
}

fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

#[test]
fn one_flipped_bit_anywhere_is_noticed() {
    let whole = tiny().to_bytes();
    assert_eq!(Snapshot::from_bytes(&whole), Ok(tiny()));
    for bit in 0..8 * whole.len() {
        let mut bytes = whole.clone();
        bytes[bit / 8] ^= 1 << (bit % 8);
        assert!(Snapshot::from_bytes(&bytes).is_err(), "bit {bit}");
    }
}

#[test]
fn a_snapshot_cut_off_or_continued_anywhere_is_refused() {
    let whole = tiny().to_bytes();
    for length in 0..whole.len() {
        assert!(Snapshot::from_bytes(&whole[..length]).is_err(), "{length}");
    }
    for more in [&[0][..], &[0; 8], &whole] {
        let bytes = [&whole, more].concat();
        assert_eq!(Snapshot::from_bytes(&bytes), Err(Damage::Checksum));
    }
}

#[test]
fn the_reason_of_a_refusal_is_told() {
    let refused = |change: &dyn Fn(&mut Vec<u8>)| {
        let mut bytes = tiny().to_bytes();
        change(&mut bytes);
        Snapshot::from_bytes(&bytes)
            .expect_err("refused")
            .to_string()
    };
    assert_eq!(refused(&|b| b[0] = b'l'), "it does not begin with LSCHSNAP");
    assert_eq!(refused(&|b| b.clear()), "it does not begin with LSCHSNAP");
    assert_eq!(
        refused(&|b| b[8] = 2),
        "its format version is 2; this program reads version 1"
    );
    assert_eq!(
        refused(&|b| b[100] ^= 1),
        "its checksum does not match: it was cut off or changed"
    );
    let forged = |place: usize, value: u8| {
        refused(&|b| {
            b[place] = value;
            seal(b);
        })
    };
    assert_eq!(forged(32, 4), "its dimension is impossible");
    assert_eq!(forged(40, 2), "its arithmetic is impossible");
    assert_eq!(forged(55, 1), "its scale is impossible");
    assert_eq!(forged(88, 2), "its arrow is impossible");
    // 255 billion billion particles: nothing is allocated for them.
    assert_eq!(forged(102, 255), "its field is impossible");
}

/// Puts the right checksum under bytes that were changed.
fn seal(bytes: &mut [u8]) {
    if let Some((body, checksum)) = bytes.split_last_chunk_mut::<16>() {
        *checksum = hash(body);
    }
}

fn snapshots() -> impl Strategy<Value = Snapshot> {
    let sizes = (2usize..4, 0usize..7, 0usize..5);
    let words = |n| prop::collection::vec(any::<i64>(), n);
    let exponents = [-999i32..1000, -999i32..1000, -999i32..1000];
    let when = (any::<u64>(), any::<i64>(), any::<bool>(), any::<bool>());
    let fields = sizes.prop_flat_map(move |(d, n, w)| {
        let fields = (words(d * n), words(d * n), words(n));
        (Just((d, n)), fields, words(d * w), words(w))
    });
    (any::<[u8; 16]>(), exponents, when, fields).prop_map(
        |(scene, [k, j, d], (step, position, backward, fixed), fields)| {
            let ((dimension, n), (x, v, rho), wall_position, wall_density) = fields;
            let name = |name: &str, words| (name.to_owned(), words);
            Snapshot {
                scene,
                position,
                arrow: if backward {
                    Arrow::Backward
                } else {
                    Arrow::Forward
                },
                state: SavedState {
                    dimension,
                    arithmetic: if fixed {
                        ArithmeticKind::Fixed
                    } else {
                        ArithmeticKind::Float
                    },
                    scale: Scale {
                        length_exponent: k,
                        speed_exponent: j,
                        density_exponent: d,
                    },
                    step,
                    id: (0..n as u64).collect(),
                    fields: vec![
                        name("position", x),
                        name("velocity", v),
                        name("density", rho),
                    ],
                    wall_position,
                    wall_density,
                },
            }
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]
    #[test]
    fn what_is_written_is_read(snapshot in snapshots()) {
        let bytes = snapshot.to_bytes();
        let read = Snapshot::from_bytes(&bytes).expect("it was just written");
        prop_assert_eq!(&read, &snapshot);
        prop_assert_eq!(read.to_bytes(), bytes);
        prop_assert_eq!(read.digest(), snapshot.digest());
    }

    /// Changed by somebody who knows the checksum: it may be another snapshot, never a panic and
    /// never more than the file says.
    #[test]
    fn forged_bytes_do_no_harm(
        snapshot in snapshots(),
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..4),
    ) {
        let mut bytes = snapshot.to_bytes();
        for (place, value) in changes {
            let place = place.index(bytes.len());
            bytes[place] = value;
        }
        seal(&mut bytes);
        if let Ok(read) = Snapshot::from_bytes(&bytes) {
            let _ = read.digest();
            if !read.state.id.is_empty() {
                prop_assert_eq!(read.to_bytes(), bytes);
            }
        }
    }
}

#[test]
fn the_digest_of_a_snapshot_is_that_of_the_simulation_whatever_the_arrow() {
    let scenes: [(&str, &[&str]); 3] = [
        ("dam-break", &["particle_spacing=0.2"]),
        ("dam-break", &["particle_spacing=0.2", "wall_model=dummy"]),
        ("dam-break-3d", &["particle_spacing=0.2", "model=standard"]),
    ];
    for (name, set) in scenes {
        for options in [serial(), float(serial())] {
            let mut player = player(scene(name, set), options);
            let mut seen = Vec::new();
            for steps in [0, 20, 20] {
                player.advance(steps).expect("in range");
                for _ in 0..2 {
                    let snapshot = Snapshot {
                        scene: [0; 16],
                        position: player.position(),
                        arrow: player.arrow(),
                        state: player.save(),
                    };
                    let read = Snapshot::from_bytes(&snapshot.to_bytes()).expect("whole");
                    assert_eq!(read, snapshot);
                    assert_eq!(read.digest(), player.digest(), "{name} {set:?} {options:?}");
                    seen.push(read.digest().to_string());
                    player.turn();
                }
            }
            // The arrow is not part of a digest, the state is.
            seen.dedup();
            assert_eq!(seen.len(), 3);
        }
    }
}
