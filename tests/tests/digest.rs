//! The digest: what it depends on, what not, and its bytes.

use loschmidt_core::digest::hash;
use loschmidt_core::fields::{POSITION, VELOCITY};
use loschmidt_core::integrator::{PEFRL, STORMER_VERLET, SUZUKI};
use loschmidt_core::number::Arithmetic;
use loschmidt_core::schemes::wcsph::{CONSTANT, Wall};
use loschmidt_core::{Digest, Fixed, Float, Model, Scale, Serial, Standard, Symplectic};
use loschmidt_tests::small::{
    Recipe, Small, conservative, dam_2d, dam_3d, displace, shuffle, water,
};

/// SipHash-2-4 with a 128-bit result, written anew from Aumasson & Bernstein (2012).
fn siphash_128(key: [u64; 2], bytes: &[u8]) -> [u8; 16] {
    fn rounds(v: &mut [u64; 4], n: usize) {
        for _ in 0..n {
            v[0] = v[0].wrapping_add(v[1]);
            v[2] = v[2].wrapping_add(v[3]);
            v[1] = v[1].rotate_left(13) ^ v[0];
            v[3] = v[3].rotate_left(16) ^ v[2];
            v[0] = v[0].rotate_left(32);
            v[2] = v[2].wrapping_add(v[1]);
            v[0] = v[0].wrapping_add(v[3]);
            v[1] = v[1].rotate_left(17) ^ v[2];
            v[3] = v[3].rotate_left(21) ^ v[0];
            v[2] = v[2].rotate_left(32);
        }
    }
    let mut v = [
        key[0] ^ 0x736f_6d65_7073_6575,
        key[1] ^ 0x646f_7261_6e64_6f6d ^ 0xee,
        key[0] ^ 0x6c79_6765_6e65_7261,
        key[1] ^ 0x7465_6462_7974_6573,
    ];
    let mut padded = bytes.to_vec();
    padded.resize(bytes.len() / 8 * 8 + 7, 0);
    padded.push(bytes.len() as u8);
    for word in padded.chunks_exact(8) {
        let word = u64::from_le_bytes(word.try_into().unwrap());
        v[3] ^= word;
        rounds(&mut v, 2);
        v[0] ^= word;
    }
    let fold = |v: &[u64; 4]| (v[0] ^ v[1] ^ v[2] ^ v[3]).to_le_bytes();
    let mut out = [0; 16];
    v[2] ^= 0xee;
    rounds(&mut v, 4);
    out[..8].copy_from_slice(&fold(&v));
    v[1] ^= 0xdd;
    rounds(&mut v, 4);
    out[8..].copy_from_slice(&fold(&v));
    out
}

#[test]
fn the_hash_is_siphash_2_4_with_128_bits_and_a_zero_key() {
    // Vectors of the reference implementation: key 00 01 … 0f, input of 0 and of 1 byte.
    let key = [0x0706_0504_0302_0100, 0x0f0e_0d0c_0b0a_0908];
    let text = |bytes| Digest(bytes).to_string();
    assert_eq!(
        text(siphash_128(key, &[])),
        "a3817f04ba25a8e66df67214c7550293"
    );
    assert_eq!(
        text(siphash_128(key, &[0])),
        "da87c1d86b99af44347659119b22fc45"
    );
    let bytes: Vec<u8> = (0..200).map(|k| (37 * k) as u8).collect();
    for n in 0..bytes.len() {
        assert_eq!(hash(&bytes[..n]), siphash_128([0; 2], &bytes[..n]), "{n}");
    }
}

/// The digest from the bytes that its documentation lists.
fn by_the_book<A: Arithmetic, M: Model<A, D>, const D: usize>(
    system: &mut Small<M, D, A>,
    scale: Scale,
    state_is_float: bool,
    density_name: &str,
    word: impl Fn(&loschmidt_core::System<'_, A, D>, usize, usize) -> i64,
) -> Digest {
    let (_, system) = system.parts();
    let (n, w) = (system.particles.len(), system.walls.len());
    let mut sum = 0u128;
    let mut add = |words: &[i64]| {
        let bytes: Vec<u8> = words.iter().flat_map(|w| w.to_le_bytes()).collect();
        sum = sum.wrapping_add(u128::from_le_bytes(siphash_128([0; 2], &bytes)));
    };
    for place in 0..n {
        let mut words = vec![0, system.particles.id[place] as i64];
        words.extend((0..2 * D + 1).map(|k| word(&system, place, k)));
        add(&words);
    }
    for place in 0..w {
        let mut words = vec![1, (n + place) as i64];
        words.extend((0..D + 1).map(|k| word(&system, n + place, k)));
        add(&words);
    }
    let mut bytes = b"loschmidt digest 1.0".to_vec();
    for word in [
        D as i64,
        i64::from(state_is_float),
        scale.length_exponent.into(),
        scale.speed_exponent.into(),
        scale.density_exponent.into(),
        n as i64,
        w as i64,
    ] {
        bytes.extend(word.to_le_bytes());
    }
    for name in ["position", "velocity", density_name] {
        bytes.extend((name.len() as u64).to_le_bytes());
        bytes.extend(name.as_bytes());
    }
    bytes.extend(sum.to_le_bytes());
    Digest(siphash_128([0; 2], &bytes))
}

/// Component k of a particle's record: of the fluid, or of a wall behind it.
fn fixed_word<const D: usize>(
    s: &loschmidt_core::System<'_, Fixed, D>,
    place: usize,
    k: usize,
) -> i64 {
    let n = s.particles.len();
    match place.checked_sub(n) {
        None if k < D => s.particles.position()[place][k].to_bits(),
        None if k < 2 * D => s.particles.velocity()[place][k - D].to_bits(),
        None => s.particles.words(CONSTANT)[place].to_bits(),
        Some(w) if k < D => s.walls.position()[w][k].to_bits(),
        Some(w) => s.walls.words(CONSTANT)[w].to_bits(),
    }
}

fn float_word<const D: usize>(
    s: &loschmidt_core::System<'_, Float, D>,
    place: usize,
    k: usize,
) -> i64 {
    let n = s.particles.len();
    let x = match place.checked_sub(n) {
        None if k < D => s.particles.position()[place][k],
        None if k < 2 * D => s.particles.velocity()[place][k - D],
        None => s.particles.words(CONSTANT)[place],
        Some(w) if k < D => s.walls.position()[w][k],
        Some(w) => s.walls.words(CONSTANT)[w],
    };
    if x == 0.0 { 0 } else { x.to_bits() as i64 }
}

fn with_exponents<const D: usize>(mut recipe: Recipe<D>) -> Recipe<D> {
    recipe.parameters.scale = Scale {
        length_exponent: -2,
        speed_exponent: 3,
        density_exponent: 1,
    };
    recipe.stirred(8, 1.0)
}

#[test]
fn it_has_the_bytes_that_its_documentation_lists() {
    let plane = with_exponents(dam_2d(Wall::Dummy, &STORMER_VERLET));
    let mut system = plane.build::<Fixed, Symplectic<Fixed, 2>>();
    system.advance(3, &Serial).unwrap();
    let book = by_the_book(
        &mut system,
        plane.parameters.scale,
        false,
        "density_constant",
        fixed_word,
    );
    assert_eq!(system.digest(), book);

    let space = with_exponents(dam_3d(conservative(), &STORMER_VERLET));
    let mut system = space.build::<Fixed, Standard<Fixed, 3>>();
    system.advance(3, &Serial).unwrap();
    let book = by_the_book(
        &mut system,
        space.parameters.scale,
        false,
        "density",
        fixed_word,
    );
    assert_eq!(system.digest(), book);

    let mut system = space.build::<Float, Symplectic<Float, 3>>();
    system.advance(3, &Serial).unwrap();
    system.parts().1.particles.velocity_mut()[0][0] = -0.0;
    let book = by_the_book(
        &mut system,
        space.parameters.scale,
        true,
        "density_constant",
        float_word,
    );
    assert_eq!(system.digest(), book);
}

#[test]
fn it_does_not_depend_on_the_order_of_storage() {
    let mut system = dam_3d(Wall::Dummy, &STORMER_VERLET)
        .stirred(5, 1.0)
        .symplectic();
    let first = system.digest();
    for seed in 0..20 {
        shuffle(&mut system.parts().1, seed);
        assert_eq!(system.digest(), first);
    }
}

#[test]
fn it_changes_with_every_single_bit_of_every_field() {
    let mut recipe = Recipe::block(water::<3>(), [3, 1, 1]).stirred(5, 1.0);
    recipe.parameters.wall = Wall::Dummy;
    recipe.walls.push([0.5, 0.25, 0.0]);
    recipe.walls.push([0.25, 0.25, 0.0]);
    let mut system = recipe.symplectic();
    let first = system.digest();
    let mut seen = std::collections::HashSet::from([first]);
    let mut flips = 0;
    let mut see = |digest| {
        flips += 1;
        assert!(seen.insert(digest), "flip {flips}");
    };
    let flip = |x: &mut i64, bit: u32| *x ^= 1 << bit;
    for bit in 0..64 {
        for place in 0..3 {
            system.parts().1.particles.id[place] ^= 1 << bit;
            see(system.digest());
            system.parts().1.particles.id[place] ^= 1 << bit;
            let vectors = [POSITION, VELOCITY].into_iter();
            let vectors = vectors.flat_map(|f| (0..3).map(move |c| (f, c)));
            for (field, c) in vectors.chain([(CONSTANT, 0)]) {
                let mut word = system.parts().1.particles.word(field, c, place);
                flip(&mut word, bit);
                system.parts().1.particles.set_word(field, c, place, word);
                see(system.digest());
                flip(&mut word, bit);
                system.parts().1.particles.set_word(field, c, place, word);
            }
        }
        for place in 0..2 {
            for (field, c) in [(POSITION, 0), (POSITION, 1), (POSITION, 2), (CONSTANT, 0)] {
                let mut word = system.parts().1.walls.word(field, c, place);
                flip(&mut word, bit);
                system.parts().1.walls.set_word(field, c, place, word);
                see(system.digest());
                flip(&mut word, bit);
                system.parts().1.walls.set_word(field, c, place, word);
            }
        }
    }
    assert_eq!(flips, 64 * (3 * 8 + 2 * 4));
    assert_eq!(system.digest(), first);
}

#[test]
fn exchanged_particles_and_exchanged_ids_are_seen() {
    let mut system = Recipe::block(water::<2>(), [2, 2]).symplectic();
    let first = system.digest();
    system.parts().1.particles.position_mut().swap(0, 1);
    assert_ne!(system.digest(), first);
    system.parts().1.particles.id.swap(0, 1);
    // C_a are equal by symmetry and both are at rest: the same state in another order.
    assert_eq!(system.digest(), first);
}

#[test]
fn units_scheme_arithmetic_dimension_and_counts_are_seen() {
    let mut seen = std::collections::HashSet::new();
    let recipe = Recipe::block(water::<2>(), [1, 1]);
    for d in 0..3 {
        for e in [-1, 1] {
            let mut other = recipe.clone();
            let s = &mut other.parameters.scale;
            let exponents = [
                &mut s.length_exponent,
                &mut s.speed_exponent,
                &mut s.density_exponent,
            ];
            for (k, exponent) in exponents.into_iter().enumerate() {
                *exponent += if k == d { e } else { 0 };
            }
            assert!(seen.insert(other.place::<Fixed, Symplectic<Fixed, 2>>().digest()));
        }
    }
    assert!(seen.insert(recipe.place::<Fixed, Symplectic<Fixed, 2>>().digest()));
    assert!(seen.insert(recipe.place::<Fixed, Standard<Fixed, 2>>().digest()));
    assert!(seen.insert(recipe.place::<Float, Symplectic<Float, 2>>().digest()));
    assert!(
        seen.insert(
            Recipe::empty(water::<2>())
                .place::<Fixed, Symplectic<Fixed, 2>>()
                .digest()
        )
    );
    assert!(
        seen.insert(
            Recipe::empty(water::<3>())
                .place::<Fixed, Symplectic<Fixed, 3>>()
                .digest()
        )
    );
}

#[test]
fn as_text_it_is_its_bytes_in_order() {
    let bytes: [u8; 16] = std::array::from_fn(|k| (16 * k + 15 - k) as u8);
    assert_eq!(
        Digest(bytes).to_string(),
        "0f1e2d3c4b5a69788796a5b4c3d2e1f0"
    );
    assert_eq!(format!("{:?}", Digest(bytes)), Digest(bytes).to_string());
}

/// Golden values: a line in the changelog whenever one of them changes, and why.
fn golden<const D: usize>(recipe: &Recipe<D>, initial: &str, after_25: &str) {
    let mut system = recipe.symplectic();
    let [first, far, last] = loschmidt_tests::small::there_and_back(&mut system, 25);
    assert_eq!(
        [first.to_string(), far.to_string()],
        [initial.to_string(), after_25.to_string()]
    );
    assert_eq!(first, last);
}

#[test]
fn golden_digests_of_a_dam_in_the_plane() {
    golden(
        &dam_2d(conservative(), &STORMER_VERLET),
        "9b85b96d1e3afa854c3ddf879a2c2454",
        "92cf92dfa1d3dd54bbcc7f289852df21",
    );
}

#[test]
fn golden_digests_of_a_dam_with_dummies_in_the_plane() {
    golden(
        &dam_2d(Wall::Dummy, &SUZUKI),
        "8a3b6d25617ac95a7831e1fa0cb3aa73",
        "701d61d3bec27e9246c690bf9651f892",
    );
}

#[test]
fn golden_digests_of_a_dam_in_space() {
    golden(
        &dam_3d(conservative(), &PEFRL),
        "aef6123b760faa88f530cd1bb367350d",
        "ebf9e1e3f86f92d0f61314d5951d8fbd",
    );
}

#[test]
fn golden_digests_of_a_dam_with_dummies_in_space() {
    golden(
        &dam_3d(Wall::Dummy, &STORMER_VERLET),
        "1d5b663640db7529a4676e192b717beb",
        "96d9024254e40beb88e46f71c92957f0",
    );
}

#[test]
fn golden_digests_of_the_standard_scheme() {
    let mut system = dam_2d(Wall::Dummy, &STORMER_VERLET).build::<Fixed, Standard<Fixed, 2>>();
    assert_eq!(
        system.digest().to_string(),
        "9baddc3b0cd99fd9677c08aeb0364087"
    );
    system.advance(25, &Serial).unwrap();
    assert_eq!(
        system.digest().to_string(),
        "8a55b7c3659b496f8aea9d97cd925c44"
    );
}

#[test]
fn one_quantum_is_another_digest_and_soon_another_run() {
    let mut system = dam_2d(conservative(), &STORMER_VERLET).symplectic();
    let mut other = dam_2d(conservative(), &STORMER_VERLET).symplectic();
    displace(&mut other, 5, 0, 1);
    for _ in 0..20 {
        assert_ne!(system.digest(), other.digest());
        system.advance(1, &Serial).unwrap();
        other.advance(1, &Serial).unwrap();
    }
}
