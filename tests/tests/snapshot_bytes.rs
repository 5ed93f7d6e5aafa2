//! Snapshots: what is written is what is read, and what was damaged is not read at all.

use loschmidt_core::Scale;
use loschmidt_core::digest::hash;
use loschmidt_runner::output::Snapshot;
use loschmidt_runner::output::snapshot::Damage;
use loschmidt_runner::saved::SavedField;
use loschmidt_runner::{ArithmeticKind, Arrow, SavedState};
use loschmidt_tests::program::{float, player, scene, serial};
use proptest::prelude::*;

fn field(name: &str, odd: bool, words: Vec<i64>) -> SavedField {
    SavedField {
        name: name.to_owned(),
        odd,
        words,
    }
}

/// Two particles and a wall in the plane.
fn tiny() -> Snapshot {
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
                field("position", false, vec![1, -2, i64::MAX, i64::MIN]),
                field("velocity", true, vec![5, 0, -7, 8]),
                field("density_constant", false, vec![9, -10]),
            ],
            walls: 1,
            wall_fields: vec![
                field("position", false, vec![11, -12]),
                field("density_constant", false, vec![13]),
            ],
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
        refused(&|b| b[8] = 3),
        "its format version is 3; this program reads versions 1 to 2"
    );
    assert_eq!(
        refused(&|b| b[8] = 0),
        "its format version is 0; this program reads versions 1 to 2"
    );
    // Of another version, but with the checksum of this one.
    assert_eq!(
        refused(&|b| b[8] = 2),
        "its checksum does not match: it was cut off or changed"
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
    let fields = sizes.prop_flat_map(move |(d, n, w)| {
        let fluid = [
            saved("position", false, d * n).boxed(),
            saved("velocity", true, d * n).boxed(),
            saved("density", false, n).boxed(),
        ];
        let walls = [
            saved("position", false, d * w).boxed(),
            saved("density", false, w).boxed(),
        ];
        (Just((d, n, w)), fluid, walls)
    });
    snapshots_of(fields.prop_map(|(sizes, fluid, walls)| (sizes, fluid.into(), walls.into())))
}

/// Snapshots of models to come: any fields after the first two, walls with a position alone or with
/// more. Never what version 1 can hold.
fn snapshots_of_other_fields() -> impl Strategy<Value = Snapshot> {
    let sizes = (2usize..4, 0usize..7, 0usize..5);
    let fields = sizes.prop_flat_map(move |(d, n, w)| {
        let shapes = prop_oneof![Just(1), Just(d), Just(d * (d + 1) / 2), Just(d * d)];
        let kind = ("[a-z][a-z_ ]{0,20}", any::<bool>(), shapes);
        let others = |particles: usize, kinds: Vec<(String, bool, usize)>| -> Vec<_> {
            let kinds = kinds.into_iter();
            kinds
                .map(|(name, odd, each)| saved(&name, odd, each * particles).boxed())
                .collect()
        };
        // Water's walls have two fields: these have one, or more than two.
        let more = prop_oneof![Just(Vec::new()), prop::collection::vec(kind.clone(), 2..5)];
        let more = more.prop_flat_map(move |kinds| others(w, kinds));
        let fluid = prop::collection::vec(kind, 0..6);
        let fluid = fluid.prop_flat_map(move |kinds| others(n, kinds));
        let first = (
            saved("position", false, d * n),
            saved("velocity", true, d * n),
            saved("position", false, d * w),
        );
        (Just((d, n, w)), first, fluid, more)
    });
    snapshots_of(fields.prop_map(|(sizes, (x, v, wall), fluid, more)| {
        let fluid = [x, v].into_iter().chain(fluid).collect();
        let walls = std::iter::once(wall).chain(more).collect();
        (sizes, fluid, walls)
    }))
}

/// A field of this name with so many words.
fn saved(name: &str, odd: bool, words: usize) -> impl Strategy<Value = SavedField> + use<> {
    let name = name.to_owned();
    prop::collection::vec(any::<i64>(), words).prop_map(move |words| field(&name, odd, words))
}

/// Dimension, numbers of particles and walls, and their fields.
type Contents = ((usize, usize, usize), Vec<SavedField>, Vec<SavedField>);

fn snapshots_of(fields: impl Strategy<Value = Contents>) -> impl Strategy<Value = Snapshot> {
    let exponents = [-999i32..1000, -999i32..1000, -999i32..1000];
    let when = (any::<u64>(), any::<i64>(), any::<bool>(), any::<bool>());
    (any::<[u8; 16]>(), exponents, when, fields).prop_map(
        |(scene, [k, j, d], (step, position, backward, fixed), fields)| {
            let ((dimension, n, walls), fields, wall_fields) = fields;
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
                    fields,
                    walls,
                    wall_fields,
                },
            }
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]
    #[test]
    fn what_is_written_is_read(
        snapshot in prop_oneof![snapshots(), snapshots_of_other_fields()],
    ) {
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
        snapshot in prop_oneof![snapshots(), snapshots_of_other_fields()],
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
            let written = read.to_bytes();
            // How many numbers nobody has is not kept, nor water as version 2.
            let water = written[8] == 1;
            let counted = !read.state.id.is_empty() && (water || read.state.walls > 0);
            if counted && written[8] == bytes[8] {
                prop_assert_eq!(&written, &bytes);
            }
            prop_assert_eq!(Snapshot::from_bytes(&written), Ok(read));
        }
    }

    #[test]
    fn only_water_is_written_as_version_1(
        water in snapshots(),
        other in snapshots_of_other_fields(),
    ) {
        prop_assert_eq!(water.to_bytes()[8], 1);
        prop_assert_eq!(other.to_bytes()[8], 2);
    }

    #[test]
    fn the_digest_of_other_fields_turns_the_odd_ones(snapshot in snapshots_of_other_fields()) {
        let mut turned = snapshot.clone();
        turned.arrow = turned.arrow.turned();
        let fixed = turned.state.arithmetic == ArithmeticKind::Fixed;
        let state = &mut turned.state;
        let fields = state.fields.iter_mut().chain(&mut state.wall_fields);
        for word in fields.filter(|field| field.odd).flat_map(|field| &mut field.words) {
            *word = match fixed {
                true => word.wrapping_neg(),
                // A negative zero in a snapshot counts as a zero on the way back alone.
                false if f64::from_bits(*word as u64) == 0.0 => 0,
                false if f64::from_bits(*word as u64).is_nan() => return Ok(()),
                false => (-f64::from_bits(*word as u64)).to_bits() as i64,
            };
        }
        let zeros = snapshot.state.fields.iter().chain(&snapshot.state.wall_fields);
        let mut zeros = zeros.flat_map(|field| &field.words);
        prop_assume!(fixed || zeros.all(|word| *word != i64::MIN));
        prop_assert_eq!(turned.digest(), snapshot.digest());
    }
}

/// Two particles with an odd matrix, and a wall that has nothing but its place.
fn tiny_of_other_fields() -> Snapshot {
    let mut snapshot = tiny();
    let state = &mut snapshot.state;
    state.fields[2] = field("deformation", true, (1..=8).collect());
    state.wall_fields.truncate(1);
    snapshot
}

#[test]
fn the_bytes_of_a_snapshot_of_other_fields_are_as_documented() {
    let bytes = tiny_of_other_fields().to_bytes();
    let word = |n: i64| n.to_le_bytes();
    let mut expected = Vec::new();
    expected.extend_from_slice(b"LSCHSNAP");
    expected.extend(word(2));
    expected.extend_from_slice(b"sixteen bytes ab");
    for n in [2, 0, -1, 2, 0, 17, 3, 1, 2, 1, 3] {
        expected.extend(word(n));
    }
    let add = |to: &mut Vec<u8>, odd: i64, name: &[u8], components: i64, words: &[i64]| {
        to.extend(word(odd));
        to.extend(word(name.len() as i64));
        to.extend_from_slice(name);
        to.extend(word(components));
        words.iter().for_each(|n| to.extend(word(*n)));
    };
    let position = [1, -2, i64::MAX, i64::MIN];
    add(&mut expected, 0, b"position", 2, &position);
    add(&mut expected, 1, b"velocity", 2, &[5, 0, -7, 8]);
    let matrices = [1, 2, 3, 4, 5, 6, 7, 8];
    add(&mut expected, 1, b"deformation", 4, &matrices);
    // Two ids, one field of walls.
    for n in [0, 1, 1] {
        expected.extend(word(n));
    }
    add(&mut expected, 0, b"position", 2, &[11, -12]);
    let checksum = hash(&expected);
    expected.extend_from_slice(&checksum);
    assert_eq!(bytes, expected);
}

#[test]
fn damage_of_a_snapshot_of_other_fields_is_noticed_and_told() {
    let whole = tiny_of_other_fields().to_bytes();
    assert_eq!(Snapshot::from_bytes(&whole), Ok(tiny_of_other_fields()));
    for bit in 0..8 * whole.len() {
        let mut bytes = whole.clone();
        bytes[bit / 8] ^= 1 << (bit % 8);
        assert!(Snapshot::from_bytes(&bytes).is_err(), "bit {bit}");
    }
    for length in 0..whole.len() {
        assert!(Snapshot::from_bytes(&whole[..length]).is_err(), "{length}");
        if length == whole.len() - 16 {
            continue;
        }
        // Cut off by somebody who knows the checksum.
        let mut bytes = whole[..length].to_vec();
        bytes.extend_from_slice(&hash(&whole[..length]));
        assert!(Snapshot::from_bytes(&bytes).is_err(), "{length}");
    }
    let forged = |place: usize, value: u8| {
        let mut bytes = whole.clone();
        bytes[place] = value;
        seal(&mut bytes);
        let refused = Snapshot::from_bytes(&bytes).expect_err("refused");
        refused.to_string()
    };
    // After the head of 120 bytes: parity, length of the name, name, components, words.
    assert_eq!(forged(120, 2), "its parity of a field is impossible");
    assert_eq!(forged(127, 255), "its parity of a field is impossible");
    assert_eq!(forged(135, 255), "its name of a field is impossible");
    assert_eq!(forged(136, 255), "its name of a field is impossible");
    // One component instead of two: a word of the second particle is taken for a parity.
    assert_eq!(forged(144, 1), "its parity of a field is impossible");
    assert_eq!(forged(150, 255), "its field is impossible");
    // Of the last field, two words for a particle that should be in the plane.
    let wall = whole.len() - 16 - 24;
    assert_eq!(forged(wall, 1), "its list of fields is impossible");
}

/// A file may not make a reader write beyond its arrays: numbers of a particle that no model has.
#[test]
fn more_numbers_than_a_digest_takes_are_refused_or_digested() {
    let mut snapshot = tiny_of_other_fields();
    for words in [58, 59, 200] {
        snapshot.state.fields[2].words = vec![1; 2 * words];
        if let Ok(read) = Snapshot::from_bytes(&snapshot.to_bytes()) {
            let _ = read.digest();
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
