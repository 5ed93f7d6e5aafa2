//! Densities and impulses of water in one sweep.
//!
//! Both sums run over the same pairs, and their terms need the same function of the distance
//! ([`PairPass::argument`]), a square root. Going up the strips, the density sum of strip s, which
//! also adds to strip s + 1, is taken along with the impulse sum of strip s - 2: by then the
//! densities of strips s - 2 and s - 1 are finished, and the arguments of their terms are still in
//! the cache. The two are interleaved pair by pair, so that the divider works on the roots of one
//! while the multipliers work on the other.
//!
//! Each part of the strips does that by itself. Its first strip lacks what the part before adds to
//! it, and its last strip meets the first one of the part after; so the impulse sums of these two
//! are taken afterwards, when the densities are whole.
//!
//! It must leave what the reference leaves, [`Symplectic`]'s prepared kick: the conformance suite
//! holds it to that.
//!
//! [`Symplectic`]: loschmidt_core::Symplectic

use super::backend::Work;
use super::lanes::{Quad, ROW, Reals};
use super::layout::{Crew, Layout, Strip};
use super::memory::{Arguments, LIMIT, Memory};
use super::sums::{Sums, add_received, contributors};
use super::sweep::{Leg, Sweep};
use loschmidt_core::fields::{IMPULSE, POSITION};
use loschmidt_core::number::{Grain, Quantity, larger};
use loschmidt_core::pairs::{PairPass, grain_under};
use loschmidt_core::schemes::wcsph::{
    CONSTANT, DENSITY, DensityPass, Pressed, PressureFactor, PressurePass, Pull, Water,
};
use loschmidt_core::set::Set;
use loschmidt_core::{Arithmetic, Fault, FaultKind};
use std::ops::Range;

/// What finishing densities has shown.
#[derive(Clone, Copy, Debug, Default)]
struct Found {
    fault: Option<Fault>,
    /// Largest magnitude of a pressure.
    largest: f64,
}

impl Found {
    #[inline(always)]
    fn fault(&mut self, fault: Fault) {
        self.fault = Some(self.fault.map_or(fault, |other| other.first(fault)));
    }
    fn and(mut self, other: Self) -> Self {
        if let Some(fault) = other.fault {
            self.fault(fault);
        }
        self.largest = larger(self.largest, other.largest);
        self
    }
}

/// Strips whose impulse sums a part takes as it goes.
fn inner(strips: &Range<usize>, count: usize) -> Range<usize> {
    strips.start + usize::from(strips.start > 0)..strips.end - usize::from(strips.end < count)
}

/// The passes of one kick, and what they read of the particles besides the strips' copies.
struct KickSums<'a, A: Arithmetic, const D: usize> {
    density: DensityPass,
    pressure: PressurePass,
    /// What the terms of either are rounded to.
    grains: [Grain; 2],
    factor: PressureFactor,
    pull: Pull<A, D>,
    own: A::Word,
    id: &'a [u64],
    constant: &'a [A::Word],
    position: &'a [[A::Word; D]],
}

impl Memory {
    /// Densities and impulses of a kick of `duration` seconds, without those of walls; false where
    /// a term could be out of range, and nothing that was written counts.
    ///
    /// # Errors
    /// A particle whose density is not positive or whose pull is out of range.
    pub(super) fn densities_and_impulses<A: Arithmetic, const D: usize>(
        &mut self,
        crew: Crew,
        water: &Water<A, D>,
        duration: f64,
        particles: &mut Set<'_, A, D>,
    ) -> Result<bool, Fault> {
        let (view, [density, impulse]) = particles.lend([DENSITY, IMPULSE]);
        let (density_pass, pressure_pass) = (water.density_pass(), water.pressure_pass());
        let of_densities = PairPass::<D>::bound(&density_pass, &[]);
        let of_impulses = |pressure| pressure_pass.bound(&Pressed::<f64, D> { pressure });
        // How large pressures are is known when all densities are. Those before them were about as
        // large: the grain is most likely the same.
        let expected = of_impulses(self.pressure * duration.abs());
        let mut kick = KickSums {
            density: density_pass,
            pressure: pressure_pass,
            grains: [of_densities, expected].map(grain_under::<A>),
            factor: water.pressure_factor(duration),
            pull: water.pull(duration),
            own: water.own_density(),
            id: view.id,
            constant: view.words(CONSTANT),
            position: view.vectors(POSITION),
        };
        if of_densities >= LIMIT {
            return Ok(false);
        }
        let found = self.go(crew, &kick, density);
        if let Some(fault) = found.fault {
            return Err(fault);
        }
        self.pressure = found.largest / duration.abs();
        let of_impulses = of_impulses(found.largest);
        if of_impulses >= LIMIT {
            return Ok(false);
        }
        let grain = grain_under::<A>(of_impulses);
        if grain == kick.grains[1] {
            self.go_on(crew, &kick);
        } else {
            kick.grains[1] = grain;
            self.impulses_again(crew, &kick);
        }
        self.gather(&kick, impulse.as_chunks_mut().0).map(|()| true)
    }

    /// All densities, and the impulse sums that a part can take as it goes.
    fn go<A: Arithmetic, const D: usize>(
        &mut self,
        crew: Crew,
        kick: &KickSums<'_, A, D>,
        density: &mut [A::Word],
    ) -> Found {
        let layout = &self.layout;
        let parts = layout.parts.len();
        self.sums.resize_with(parts, Default::default);
        self.arguments.resize_with(parts, Default::default);
        self.words.resize(layout.all_rows(), Reals::default());
        let found = {
            let density = layout.split_places(&mut *density, 1);
            let words = layout.split_rows(&mut self.words, 1);
            let memory = self.sums.iter_mut().zip(&mut self.arguments);
            let items = density.into_iter().zip(words).zip(memory).collect();
            layout.for_parts(items, |strips, ((density, words), (sums, arguments))| {
                crew.backend.run(Going {
                    kick,
                    layout,
                    strips,
                    density,
                    words,
                    sums,
                    arguments,
                })
            })
        };
        let mut found = found.into_iter().fold(Found::default(), Found::and);
        for part in layout.parts.iter().filter(|p| !p.is_empty() && p.start > 0) {
            let strip = layout.strips[part.start];
            let sums: Vec<_> = self.sums.iter().map(|[first, _]| first).collect();
            let from_parts = contributors(1, &sums, &strip);
            let density = &mut density[strip.places()];
            let words = &mut self.words[strip.rows()];
            finish(kick, &from_parts, strip, density, words, &mut found);
        }
        found
    }

    /// The impulse sums that a part could not take as it went.
    fn go_on<A: Arithmetic, const D: usize>(&mut self, crew: Crew, kick: &KickSums<'_, A, D>) {
        let (layout, words) = (&self.layout, &self.words);
        if layout.parts.len() > 1 {
            layout.for_parts(self.sums.iter_mut().collect(), |strips, [_, sums]| {
                crew.backend.run(Rest::<D> {
                    pass: &kick.pressure,
                    layout,
                    strips,
                    words,
                    sums,
                    grains: &[kick.grains[1]; D],
                });
            });
        }
    }

    /// All impulse sums, of pressures that are known: the grain was another than expected.
    fn impulses_again<A: Arithmetic, const D: usize>(
        &mut self,
        crew: Crew,
        kick: &KickSums<'_, A, D>,
    ) {
        let (layout, words) = (&self.layout, &self.words);
        layout.for_parts(self.sums.iter_mut().collect(), |strips, [_, sums]| {
            sums.clear(layout.rows_reached::<D>(&strips), D);
            crew.backend.run(Sweep::<PressurePass, D> {
                pass: &kick.pressure,
                layout,
                strips,
                words,
                sums,
                grains: &[kick.grains[1]; D],
            });
        });
    }

    /// The pull of gravity and what was received, for every particle.
    fn gather<A: Arithmetic, const D: usize>(
        &self,
        kick: &KickSums<'_, A, D>,
        impulse: &mut [[A::Word; D]],
    ) -> Result<(), Fault> {
        let layout = &self.layout;
        let sums: Vec<_> = self.sums.iter().map(|[_, second]| second).collect();
        let impulse = layout.split_places(impulse, 1);
        let found = layout.for_parts(impulse, |strips, impulse| {
            let mut found = Found::default();
            let from = layout.places_of(&strips).start;
            for strip in &layout.strips[strips] {
                let from_parts = contributors(D, &sums, strip);
                for k in 0..strip.len {
                    let place = strip.place + k;
                    let Some(mut sum) = kick.pull.at(&kick.position[place]) else {
                        found.fault(Fault::new(FaultKind::TermRange, kick.id[place]));
                        continue;
                    };
                    add_received::<A>(&mut sum, &[kick.grains[1]; D], &from_parts, strip.slot + k);
                    impulse[place - from] = sum;
                }
            }
            found
        });
        let found = found.into_iter().fold(Found::default(), Found::and);
        found.fault.map_or(Ok(()), Err)
    }
}

/// Finishes the densities of a strip and makes pressures of them. `density` and `words` are the
/// strip's.
#[inline(always)]
fn finish<A: Arithmetic, const D: usize>(
    kick: &KickSums<'_, A, D>,
    contributors: &[&Sums],
    strip: Strip,
    density: &mut [A::Word],
    words: &mut [Reals],
    found: &mut Found,
) {
    // The last row may hold fewer particles than slots: the rest must not keep old numbers, which a
    // sweep would load along with the others.
    if let Some(last) = words.last_mut() {
        *last = Reals::default();
    }
    for (k, density) in density.iter_mut().enumerate() {
        let (place, slot) = (strip.place + k, strip.slot + k);
        let mut sum = [kick.own];
        add_received::<A>(&mut sum, &kick.grains[..1], contributors, slot);
        *density = sum[0].plus(kick.constant[place]);
        match kick.factor.of(*density, kick.id[place]) {
            Ok(pressure) => {
                words[k / ROW].0[k % ROW] = pressure;
                found.largest = larger(found.largest, pressure);
            }
            Err(fault) => found.fault(fault),
        }
    }
}

/// One part goes up its strips.
struct Going<'a, A: Arithmetic, const D: usize> {
    kick: &'a KickSums<'a, A, D>,
    layout: &'a Layout,
    strips: Range<usize>,
    /// Of the particles of the part.
    density: &'a mut [A::Word],
    /// Of the rows of the part.
    words: &'a mut [Reals],
    sums: &'a mut [Sums; 2],
    arguments: &'a mut Arguments,
}

impl<A: Arithmetic, const D: usize> Work for Going<'_, A, D> {
    type Output = Found;
    #[inline(always)]
    fn run<Q: Quad>(self, simd: Q) -> Found {
        if A::EXACT {
            self.go::<Q, false>(simd)
        } else {
            self.go::<Q, true>(simd)
        }
    }
}

impl<A: Arithmetic, const D: usize> Going<'_, A, D> {
    #[inline(always)]
    fn go<Q: Quad, const FINE: bool>(self, simd: Q) -> Found {
        let layout = self.layout;
        let mut found = Found::default();
        let reached = layout.rows_reached::<D>(&self.strips);
        let [firsts, seconds] = self.sums;
        firsts.prepare(reached.clone(), 1);
        seconds.prepare(reached.clone(), D);
        firsts.clear_some(layout.strips[self.strips.start].rows(), 1);
        let inner = inner(&self.strips, layout.strips.len() - 1);
        let [fine, fine_impulses] = self.kick.grains;
        let (row_from, place_from) = (reached.start, layout.places_of(&self.strips).start);
        for s in self.strips.start..self.strips.end + 2 {
            // Cleared shortly before they are added to, while they are in the cache anyway.
            if let Some(strip) = layout.strips.get(s) {
                seconds.clear_some(strip.rows(), D);
            }
            if let Some(strip) = layout.strips.get(s + 1) {
                firsts.clear_some(strip.rows(), 1);
            }
            let now = self.strips.contains(&s).then_some(s);
            let past = s.checked_sub(2).filter(|past| inner.contains(past));
            let mut fresh = std::mem::take(&mut self.arguments[s % 3]);
            let known = std::mem::take(&mut self.arguments[(s + 1) % 3]);
            let words = (&*self.words, row_from);
            let mut first = Leg::<DensityPass, D, FINE>::new(
                &self.kick.density,
                layout,
                now,
                (&[], 0),
                (firsts, &[fine]),
            );
            let mut second = Leg::<PressurePass, D, FINE>::new(
                &self.kick.pressure,
                layout,
                past,
                words,
                (seconds, &[fine_impulses; D]),
            );
            if fresh.len() < first.arguments() {
                fresh.resize(first.arguments(), Reals::default());
            }
            let known_ones = &known[..second.arguments()];
            first.along_with(simd, &mut fresh, &mut second, known_ones);
            self.arguments[s % 3] = fresh;
            self.arguments[(s + 1) % 3] = known;
            // The first sum of a part's first strip waits for the part before.
            if let Some(strip) = now.filter(|&s| s > self.strips.start || s == 0) {
                let strip = layout.strips[strip];
                let places = strip.place - place_from..strip.place - place_from + strip.len;
                let rows = strip.rows().start - row_from..strip.rows().end - row_from;
                let (density, words) = (&mut self.density[places], &mut self.words[rows]);
                finish(self.kick, &[&*firsts], strip, density, words, &mut found);
            }
        }
        found
    }
}

/// The impulse sums that a part could not take as it went.
struct Rest<'a, const D: usize> {
    pass: &'a PressurePass,
    layout: &'a Layout,
    strips: Range<usize>,
    words: &'a [Reals],
    sums: &'a mut Sums,
    grains: &'a [Grain],
}

impl<const D: usize> Work for Rest<'_, D> {
    type Output = ();
    #[inline(always)]
    fn run<Q: Quad>(self, simd: Q) {
        let layout = self.layout;
        let inner = inner(&self.strips, layout.strips.len() - 1);
        for s in self.strips.filter(|s| !inner.contains(s)) {
            let words = (self.words, 0);
            let sums = (&mut *self.sums, self.grains);
            // Few strips: not compiled for whole quanta too.
            Leg::<PressurePass, D, true>::new(self.pass, layout, Some(s), words, sums).alone(simd);
        }
    }
}
