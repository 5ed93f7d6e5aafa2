//! Passes of the sizes that viscous, elastic and thermal models need: many numbers in one sum, both
//! parities in one term, a dozen words read of each particle from several fields. Every executor
//! leaves the words of the plain traversal, and its faults.

use loschmidt_core::fields::{
    Field, IMPULSE_FIELD, POSITION_FIELD, Quantum, Rank, Role, Side, TimeParity, VELOCITY,
    VELOCITY_FIELD, state_fields, words_each,
};
use loschmidt_core::kernel::WendlandC2;
use loschmidt_core::neighbours::{Cells, Grid};
use loschmidt_core::number::{Lanes, Length, Quantity, Whole, Word};
use loschmidt_core::pairs::{PairPass, Parity, Sources, Targets, read_count, term_count};
use loschmidt_core::set::{Column, Set};
use loschmidt_core::values::Symmetric;
use loschmidt_core::{Executor, Fault, FaultKind, Fixed, Serial};
use loschmidt_runner::Rayon;
use loschmidt_runner::fast::Fast;
use loschmidt_tests::generator::Generator;
use loschmidt_tests::program::backends;
use loschmidt_tests::small::lattice;
use std::num::NonZeroUsize;

const DENSITY: usize = 3;
const TEMPERATURE: usize = 4;
const PRESSURE: usize = 5;
const DISTORTION: usize = 6;

const fn even(name: &'static str, shape: Rank, quantum: Quantum) -> Field {
    Field::state(name, shape, quantum, TimeParity::Even).on_walls(Role::State)
}

const fn computed(name: &'static str) -> Field {
    Field::scratch(name, Rank::Scalar, Quantum::Real).on_walls(Role::Scratch)
}

static FIELDS: [Field; 7] = [
    POSITION_FIELD,
    VELOCITY_FIELD.on_walls(Role::State),
    IMPULSE_FIELD,
    even("density", Rank::Scalar, Quantum::Density),
    computed("temperature"),
    computed("pressure"),
    even("distortion", Rank::Matrix, Quantum::Speed),
];

/// h in quanta.
const REACH: i64 = 1 << 40;
/// Three to a reach.
const SPACING: f64 = REACH as f64 / 3.0;
/// Everything that is read is below this; a term is then of the order of 2^30 quanta.
const LARGEST: f64 = 1024.0;

fn kernel(dimension: usize) -> WendlandC2 {
    WendlandC2::new(dimension, 1.0, 1.0 / REACH as f64)
}

loschmidt_core::values! {
    /// What the moments need of a particle: D + 2 numbers of three fields.
    struct Flowing {
        /// u.
        velocity: [T; D],
        /// ρ.
        density: T,
        /// T.
        temperature: T,
    }
    /// Symmetric all of them: 9 numbers in the plane, 17 in space.
    struct Moments {
        /// Σ W x ⊗ x.
        moments: Symmetric<T, D>,
        /// Σ W u_ij ⊗ x.
        gradient: [[T; D]; D],
        /// Σ W (ρ_i + ρ_j).
        density: T,
        /// Σ W (T_i - T_j)².
        penalty: T,
    }
    /// What the exchange needs of a particle: 7 numbers in the plane, 12 in space, of four fields.
    struct Strained {
        /// A.
        distortion: [[T; D]; D],
        /// p.
        pressure: T,
        /// T.
        temperature: T,
        /// ρ.
        density: T,
    }
    /// An impulse, and beside it what both partners gain.
    struct Exchange {
        /// Σ W' ((A_i + A_j) x + (p_i + p_j) x).
        impulse: [T; D],
        /// Σ W (T_i - T_j)² (ρ_i + ρ_j).
        entropy: T,
    }
}

/// Lengths in units of the reach, and a strength in quanta.
#[derive(Clone, Copy)]
struct Wide {
    kernel: WendlandC2,
    strength: f64,
}

struct MomentsPass(Wide);

impl<const D: usize> PairPass<D> for MomentsPass {
    type Read<T: Copy> = Flowing<T, D>;
    type Term<T: Copy> = Moments<T, D>;
    const PARITY: Moments<Parity, D> = Moments {
        moments: Symmetric {
            rows: [[Parity::Symmetric; D]; D],
        },
        gradient: [[Parity::Symmetric; D]; D],
        density: Parity::Symmetric,
        penalty: Parity::Symmetric,
    };
    #[inline(always)]
    fn reach_squared(&self) -> f64 {
        REACH as f64 * REACH as f64
    }
    fn bound(&self, largest: &Flowing<f64, D>) -> f64 {
        let u = largest.velocity.iter().fold(0.0f64, |m, u| m.max(*u));
        let t = 2.0 * largest.temperature;
        let most = [1.0, 2.0 * u, 2.0 * largest.density, t * t];
        let most = most.into_iter().fold(0.0, f64::max);
        1.001 * most * (self.0.kernel.value(0.0) * self.0.strength)
    }
    #[inline(always)]
    fn argument<L: Lanes>(&self, r2: L) -> L {
        self.0.kernel.q(r2.root())
    }
    #[inline(always)]
    fn term<L: Lanes>(
        &self,
        x_ij: &[L; D],
        q: L,
        i: &Flowing<L, D>,
        j: &Flowing<L, D>,
    ) -> Moments<L, D> {
        let w = self.0.kernel.value_at(q) * q.splat(self.0.strength);
        let unit = q.splat(1.0 / REACH as f64);
        let (mut moments, mut gradient) = ([[w; D]; D], [[w; D]; D]);
        for a in 0..D {
            for b in 0..D {
                moments[a][b] = w * ((x_ij[a] * unit) * (x_ij[b] * unit));
                gradient[a][b] = w * ((i.velocity[a] - j.velocity[a]) * (x_ij[b] * unit));
            }
        }
        let difference = i.temperature - j.temperature;
        Moments {
            moments: Symmetric { rows: moments },
            gradient,
            density: w * (i.density + j.density),
            penalty: w * (difference * difference),
        }
    }
}

struct ExchangePass(Wide);

impl<const D: usize> PairPass<D> for ExchangePass {
    type Read<T: Copy> = Strained<T, D>;
    type Term<T: Copy> = Exchange<T, D>;
    const PARITY: Exchange<Parity, D> = Exchange {
        impulse: [Parity::Antisymmetric; D],
        entropy: Parity::Symmetric,
    };
    #[inline(always)]
    fn reach_squared(&self) -> f64 {
        REACH as f64 * REACH as f64
    }
    fn bound(&self, largest: &Strained<f64, D>) -> f64 {
        let distortion = largest.distortion.as_flattened().iter().sum::<f64>();
        let slope = self.0.kernel.derivative_over_r(0.0).abs();
        let t = 2.0 * largest.temperature;
        let impulse = slope * 2.0 * (distortion + largest.pressure);
        let entropy = self.0.kernel.value(0.0) * t * t * (2.0 * largest.density);
        1.001 * self.0.strength * impulse.max(entropy)
    }
    #[inline(always)]
    fn argument<L: Lanes>(&self, r2: L) -> L {
        self.0.kernel.q(r2.root())
    }
    #[inline(always)]
    fn term<L: Lanes>(
        &self,
        x_ij: &[L; D],
        q: L,
        i: &Strained<L, D>,
        j: &Strained<L, D>,
    ) -> Exchange<L, D> {
        let slope = self.0.kernel.derivative_over_r_at(q) * q.splat(self.0.strength);
        let unit = q.splat(1.0 / REACH as f64);
        let mut impulse = *x_ij;
        for a in 0..D {
            let mut sum = (i.pressure + j.pressure) * (x_ij[a] * unit);
            for (b, x) in x_ij.iter().enumerate() {
                sum = sum + (i.distortion[a][b] + j.distortion[a][b]) * (*x * unit);
            }
            impulse[a] = slope * sum;
        }
        let difference = i.temperature - j.temperature;
        let w = self.0.kernel.value_at(q) * q.splat(self.0.strength);
        Exchange {
            impulse,
            entropy: (w * (difference * difference)) * (i.density + j.density),
        }
    }
}

/// Particles and walls: memory for their fields, and where both are sorted.
#[derive(Clone)]
struct Cloud<const D: usize> {
    id: [Vec<u64>; 2],
    memory: [Vec<Whole>; 2],
    grid: Grid<D>,
}

const SIDES: [Side; 2] = [Side::Particles, Side::Walls];

impl<const D: usize> Cloud<D> {
    /// A lattice of `size` with a plate of walls under it, all of it disordered: some particles lie
    /// on one point.
    fn new(size: [i64; D], seed: u64) -> Self {
        let mut generator = Generator::new(seed);
        let mut points = [Vec::new(), Vec::new()];
        for index in lattice(size) {
            points[0].push(index);
        }
        let mut plate = size;
        plate[D - 1] = 2;
        for mut index in lattice(plate) {
            index[D - 1] -= 2;
            points[1].push(index);
        }
        let counts = points.each_ref().map(Vec::len);
        let mut cloud = Self {
            id: [
                (0..counts[0] as u64).collect(),
                (0..counts[1]).map(|w| (counts[0] + w) as u64).collect(),
            ],
            memory: [0, 1].map(|s| vec![Whole::ZERO; counts[s] * words_each(&FIELDS, SIDES[s], D)]),
            grid: Grid::new(REACH, size.map(|n| (n as f64 * SPACING) as i64), 1 << 16),
        };
        for (mut set, points) in cloud.sets().into_iter().zip(&points) {
            for (place, index) in points.iter().enumerate() {
                let shift: [f64; D] = generator.vector(0.4);
                let mut x: [f64; D] = std::array::from_fn(|d| index[d] as f64 + shift[d]);
                if place % 97 == 5 {
                    // On the one before.
                    let before = set.position()[place - 1];
                    x = before.map(|x| x.quanta() / SPACING);
                }
                set.position_mut()[place] = x.map(|x| Length::from_word((x * SPACING) as i64));
                for (f, field) in state_fields(&FIELDS, set.side()).skip(1) {
                    for c in 0..field.words(set.side(), D) {
                        set.set_word(f, c, place, (LARGEST * generator.signed()) as i64);
                    }
                }
            }
            compute(&mut set);
        }
        cloud
    }

    fn sets(&mut self) -> [Set<'_, Fixed, D>; 2] {
        let [particles, walls] = &mut self.id;
        let [of_particles, of_walls] = &mut self.memory;
        let (n, w) = (particles.len(), walls.len());
        [
            Set::over(particles, of_particles, n, &FIELDS, Side::Particles).expect("memory"),
            Set::over(walls, of_walls, w, &FIELDS, Side::Walls).expect("memory"),
        ]
    }
}

/// Fills the scratch, which is of no use once the particles were sorted: doubles that follow from
/// the id.
fn compute<const D: usize>(set: &mut Set<'_, Fixed, D>) {
    for place in 0..set.len() {
        let mut generator = Generator::new(set.id[place]);
        for field in [TEMPERATURE, PRESSURE] {
            set.words_mut(field)[place] = Whole::of_real(LARGEST * generator.signed());
        }
    }
}

/// The sums of every receiver, by id.
type Found = Result<Vec<(u64, Vec<i64>)>, Fault>;

/// Both sets, found in their cells.
struct Located<'a, 's, const D: usize> {
    sets: &'a [Set<'s, Fixed, D>; 2],
    cells: [&'a Cells<'a>; 2],
    grid: &'a Grid<D>,
}

impl<const D: usize> Located<'_, '_, D> {
    fn sum<E: Executor, P: PairPass<D>>(
        &self,
        exec: &E,
        pass: &P,
        fields: &[usize],
        [to, from]: [usize; 2],
    ) -> Found {
        let columns = |s: usize| -> Vec<Column<'_, Whole>> {
            let view = self.sets[s].view();
            fields.iter().map(|&f| view.column(f, SIDES[s])).collect()
        };
        let (of_receivers, of_sources) = (columns(to), columns(from));
        let receivers = self.sets[to].view();
        let to_whom: Targets<'_, Fixed, D> = Targets {
            position: receivers.position(),
            read: &of_receivers,
            id: receivers.id,
            same_set: to == from,
        };
        let from_whom: Sources<'_, Fixed, D> = Sources {
            grid: self.grid,
            cells: self.cells[from].view(),
            position: self.sets[from].view().position(),
            read: &of_sources,
        };
        // Sums are added to what is there.
        let each = term_count::<P, D>();
        let first = |k: usize| Whole::from_word(1000 + (k % each) as i64);
        let mut out: Vec<Whole> = (0..receivers.id.len() * each).map(first).collect();
        exec.sum(pass, &to_whom, &from_whom, &mut out)?;
        let words = out
            .chunks(each)
            .map(|sum| sum.iter().map(|w| w.to_word()).collect());
        let mut all: Vec<_> = receivers.id.iter().copied().zip(words).collect();
        all.sort();
        Ok(all)
    }
}

/// All sums, at first and after two moves that change who is near whom.
fn all_sums<E: Executor, const D: usize>(cloud: &Cloud<D>, exec: &E, strength: f64) -> Vec<Found> {
    let mut cloud = cloud.clone();
    let grid = cloud.grid;
    let [n, w] = cloud.id.each_ref().map(Vec::len);
    let (mut start, mut order) = (vec![0; grid.buckets() + 1], vec![0; n]);
    let (mut wall_start, mut wall_order) = (start.clone(), vec![0; w]);
    let mut cells = Cells {
        start: &mut start,
        order: &mut order,
    };
    let mut wall_cells = Cells {
        start: &mut wall_start,
        order: &mut wall_order,
    };
    let wide = Wide {
        kernel: kernel(D),
        strength,
    };
    let moments = MomentsPass(wide);
    let exchange = ExchangePass(wide);
    let mut sets = cloud.sets();
    exec.locate_walls(&grid, &sets[1], &mut wall_cells);
    let mut found = Vec::new();
    for turn in 0..3 {
        // Nobody else looks for the particles at first.
        exec.locate(&grid, &mut sets[0], &mut cells, turn > 0);
        compute(&mut sets[0]);
        let located = Located {
            sets: &sets,
            cells: [&cells, &wall_cells],
            grid: &grid,
        };
        for [to, from] in [[0, 0], [0, 1], [1, 0]] {
            if from == 0 && to == 1 && turn == 0 {
                continue;
            }
            let read = &[VELOCITY, DENSITY, TEMPERATURE];
            found.push(located.sum(exec, &moments, read, [to, from]));
            let read = &[DISTORTION, PRESSURE, TEMPERATURE, DENSITY];
            found.push(located.sum(exec, &exchange, read, [to, from]));
        }
        let particles = &mut sets[0];
        for place in 0..n {
            // By id, since the places are the executor's.
            let mut generator = Generator::new(particles.id[place] + 7 * turn);
            for x in &mut particles.position_mut()[place] {
                *x = x.plus(Length::from_word(
                    (0.1 * SPACING * generator.signed()) as i64,
                ));
            }
        }
    }
    found
}

fn threads(n: usize) -> NonZeroUsize {
    NonZeroUsize::new(n).expect("a thread")
}

/// The first particle whose words are others, in few words.
fn difference(found: &Found, expected: &Found) -> String {
    let (Ok(found), Ok(expected)) = (found, expected) else {
        return format!(
            "{:?} instead of {:?}",
            found.as_ref().err(),
            expected.as_ref().err()
        );
    };
    let mut pairs = found.iter().zip(expected);
    let first = pairs.find(|(found, expected)| found != expected);
    first.map_or(
        "other particles".to_owned(),
        |((id, found), (_, expected))| {
            format!("of particle {id} {found:?} instead of {expected:?}")
        },
    )
}

/// Compares all executors with the plain traversal; returns what that found.
fn all_agree<const D: usize>(size: [i64; D], strength: f64) -> Vec<Found> {
    let cloud = Cloud::new(size, 3);
    let reference = all_sums(&cloud, &Serial, strength);
    let check = |found: Vec<Found>, who: &str| {
        for (n, (found, expected)) in found.iter().zip(&reference).enumerate() {
            assert!(
                found == expected,
                "sum {n} of {who}: {}",
                difference(found, expected)
            );
        }
        assert_eq!(found.len(), reference.len());
    };
    let rayon = Rayon::new(threads(2)).expect("threads");
    check(all_sums(&cloud, &rayon, strength), "rayon");
    for backend in backends() {
        for n in [1, 2, 5] {
            let fast = || Fast::new(threads(n), backend).expect("threads");
            let who = format!("fast on {n} threads, {}", backend.name());
            let exec = fast();
            let found = exec.install(|| all_sums(&cloud, &exec, strength));
            check(found, &who);
            if n == 2 {
                check(
                    all_sums(&cloud, &fast(), strength),
                    &format!("{who}, from outside"),
                );
            }
        }
    }
    reference
}

#[test]
fn wide_sums_have_as_many_numbers_as_they_name() {
    assert_eq!(
        [
            term_count::<MomentsPass, 2>(),
            term_count::<MomentsPass, 3>()
        ],
        [9, 17]
    );
    assert_eq!(
        [
            read_count::<MomentsPass, 2>(),
            read_count::<MomentsPass, 3>()
        ],
        [4, 5]
    );
    assert_eq!(
        [
            term_count::<ExchangePass, 2>(),
            term_count::<ExchangePass, 3>()
        ],
        [3, 4]
    );
    assert_eq!(
        [
            read_count::<ExchangePass, 2>(),
            read_count::<ExchangePass, 3>()
        ],
        [7, 12]
    );
}

/// More particles than a part of the fast executor's layout holds, for each of five threads.
const PLANE: [i64; 2] = [104, 104];
const SPACE: [i64; 3] = [22, 22, 22];

/// Neither too small to be seen nor near the limit.
fn are_whole_sums(found: &[Found]) {
    for sums in found {
        let sums = sums.as_ref().expect("in range");
        let largest = sums
            .iter()
            .flat_map(|(_, words)| words)
            .map(|w| w.abs())
            .max();
        assert!(largest > Some(1 << 20), "{largest:?}");
    }
}

#[test]
fn every_executor_finds_the_words_of_wide_sums_in_the_plane() {
    are_whole_sums(&all_agree(PLANE, 64.0));
}

#[test]
fn every_executor_finds_the_words_of_wide_sums_in_space() {
    are_whole_sums(&all_agree(SPACE, 64.0));
}

#[test]
fn impulses_of_wide_sums_cancel_and_what_both_gain_does_not() {
    let found = all_agree([12, 12], 64.0);
    // The exchange of the particles with each other.
    let sums = found[1].as_ref().expect("in range");
    for k in 0..3 {
        let first = 1000 + k as i64;
        let total: i64 = sums.iter().map(|(_, words)| words[k] - first).sum();
        assert_eq!(total == 0, k < 2, "number {k}: {total}");
    }
}

#[test]
fn where_bounds_do_not_hold_wide_sums_are_the_same_and_their_faults_too() {
    // Beyond the bound, and most terms within the range: 2^51 is 2^30 times 2^21.
    for (size, out_of_range) in [(2f64.powi(14), false), (2f64.powi(24), true)] {
        for found in [all_agree([30, 30], size), all_agree([9, 9, 9], size)] {
            let faults = found.iter().filter_map(|sums| sums.as_ref().err());
            let faults: Vec<&Fault> = faults.collect();
            assert_eq!(!faults.is_empty(), out_of_range, "{faults:?}");
            assert!(
                faults
                    .iter()
                    .all(|fault| fault.kind == FaultKind::TermRange)
            );
        }
    }
}
