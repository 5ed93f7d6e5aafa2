//! Making a layout: the box, the order of the state, and who can meet whom.

use super::backend::Work;
use super::lanes::{Quad, ROW, Reals};
use super::layout::{Crew, Layout, Strip};
use super::meets::{Meeting, Meets};
use loschmidt_core::Arithmetic;
use loschmidt_core::fault::MAX_NEIGHBOURS;
use loschmidt_core::fields::Role;
use loschmidt_core::number::Quantity;
use loschmidt_core::set::Set;
use rayon::prelude::*;
use std::ops::Range;

/// Skin over the reach. Thicker, there are more candidates; thinner, the layout is made more often.
const SKIN: f64 = 0.1;
/// x-cells per reach.
const CELLS: f64 = 8.0;
/// Where the particles that fill up a strip are: beyond every range of the state (2^51 quanta).
const FAR: f64 = (1u64 << 60) as f64;
/// Fewest particles worth a task of their own.
const GRAIN: usize = 2048;

impl Layout {
    /// Chooses the box that the strips cover and the sizes of strips and cells.
    pub(super) fn cover<A: Arithmetic, const D: usize>(
        &mut self,
        reach: f64,
        position: &[[A::Length; D]],
    ) {
        let n = position.len().max(1) as f64;
        self.reach = reach;
        self.skin = SKIN * reach;
        // A little more than the sum, so that no rounding below can put neighbours two strips
        // apart.
        let height = (reach + self.skin) * 1.000_001;
        let mut extent = [0.0f64; 3];
        let axes = extent.iter_mut().zip(&mut self.origin).take(D);
        for (d, (extent, origin)) in axes.enumerate() {
            let (low, high) = interval(position.iter().map(|x| x[d].quanta()), height);
            *origin = low;
            *extent = (high - low).max(0.0);
        }
        // At most as many strips as particles, at most four cells for each.
        let strips = |d: usize| (extent[d] / height) as usize + 1;
        self.count = [strips(1), if D == 3 { strips(2) } else { 1 }];
        while (self.count[0] * self.count[1]) as f64 > n && self.count != [1, 1] {
            let widest = usize::from(self.count[1] > self.count[0]);
            self.count[widest] = self.count[widest].div_ceil(2);
        }
        let strips = (self.count[0] * self.count[1]) as f64;
        let columns = (extent[0] / (reach / CELLS) + 1.0).min(4.0 * n / strips + 1.0);
        self.columns = (columns as usize).max(1);
        let cell = (extent[0] / self.columns as f64).max(reach / CELLS);
        self.inverse_height = 1.0 / height;
        self.inverse_cell = 1.0 / cell;
        // One more for the place of the particle within its cell.
        self.far = ((reach + self.skin) * self.inverse_cell * 1.000_001) as usize + 1;
    }

    /// Sorts the particles into cells, strip after strip.
    pub(super) fn sort<A: Arithmetic, const D: usize>(&mut self, particles: &mut Set<'_, A, D>) {
        let mut keys = std::mem::take(&mut self.keys);
        keys.resize(particles.len(), 0);
        keys.par_iter_mut()
            .with_min_len(GRAIN)
            .zip(particles.position())
            .for_each(|(key, x)| {
                let x = x.map(Quantity::quanta);
                *key = (self.strip_of(&x) * self.columns + self.column_of(x[0])) as u32;
            });
        let strips = self.count[0] * self.count[1];
        self.cell_start.clear();
        self.cell_start.resize(strips * self.columns + 1, 0);
        for &key in &keys {
            self.cell_start[key as usize] += 1;
        }
        // Each count becomes the end of its cell; filling from the back leaves the start there.
        let (mut end, mut most) = (0, 0);
        for start in &mut self.cell_start {
            most = most.max(*start);
            end += *start;
            *start = end;
        }
        self.order.resize(particles.len(), 0);
        let mut sorted = true;
        for (place, &key) in keys.iter().enumerate().rev() {
            let new = &mut self.cell_start[key as usize];
            *new -= 1;
            self.order[*new as usize] = place as u32;
            sorted &= *new as usize == place;
        }
        self.keys = keys;
        if !sorted {
            reorder(particles, &self.order);
        }
        self.number_slots(strips);
        self.most_candidates = if self.can_be_listed::<D>() {
            self.count_candidates::<D>(most as usize)
        } else {
            usize::MAX
        };
    }

    /// True where a [`Meeting`] can name whoever meets.
    fn can_be_listed<const D: usize>(&self) -> bool {
        (0..self.strips.len() - 1).all(|s| {
            let rows = self.rows_reached::<D>(&(s..s + 1));
            Meeting::can_name::<D>(self.strips[s].len, rows.len())
        })
    }

    fn number_slots(&mut self, strips: usize) {
        self.strips.clear();
        let mut slot = 0;
        for strip in 0..strips {
            let places = self.window(strip, 0, self.columns - 1);
            self.strips.push(Strip {
                slot,
                place: places.start,
                len: places.len(),
            });
            slot = (slot + places.len()).next_multiple_of(ROW);
        }
        self.strips.push(Strip {
            slot,
            place: self.order.len(),
            len: 0,
        });
    }

    /// Writes all coordinates.
    pub(super) fn fill<A: Arithmetic, const D: usize>(&mut self, position: &[[A::Length; D]]) {
        let mut x = std::mem::take(&mut self.x);
        x.resize(self.all_rows() * D, Reals::default());
        self.for_parts(self.split_rows(&mut x, D), |strips, x| {
            let first_row = self.rows_of(&strips).start;
            x.fill(Reals([FAR; ROW]));
            for strip in &self.strips[strips] {
                let rows = &mut x[(strip.rows().start - first_row) * D..];
                let places = position[strip.places()].chunks(ROW);
                for (row, places) in rows.chunks_exact_mut(D).zip(places) {
                    for (l, place) in places.iter().enumerate() {
                        for d in 0..D {
                            row[d].0[l] = place[d].quanta();
                        }
                    }
                }
            }
        });
        self.x = x;
    }

    /// Lists who can meet whom.
    pub(super) fn list_meetings<const D: usize>(&mut self, crew: Crew) {
        if self.most_candidates > MAX_NEIGHBOURS as usize {
            // Nobody will sweep.
            return;
        }
        let mut meets = std::mem::take(&mut self.meets);
        meets.resize_with(self.strips.len() - 1, Meets::default);
        let mut rest = &mut meets[..];
        let split = |part: &Range<usize>| {
            let (first, others) = std::mem::take(&mut rest).split_at_mut(part.len());
            rest = others;
            first
        };
        let parts = self.parts.iter().map(split).collect();
        let layout = &*self;
        layout.for_parts(parts, |strips, meets| {
            let mut list = Vec::new();
            for (strip, meets) in strips.zip(meets) {
                let length = crew.backend.run(Listing::<D> {
                    layout,
                    strip,
                    list: &mut list,
                });
                meets.renew::<D>(&list[..length]);
            }
        });
        self.meets = meets;
    }

    /// An upper bound of the candidates of any particle, `most` being in the fullest cell.
    fn count_candidates<const D: usize>(&self, most: usize) -> usize {
        const ALL: [(isize, isize); 9] = [
            (0, 0),
            (1, 0),
            (-1, 0),
            (0, 1),
            (1, 1),
            (-1, 1),
            (0, -1),
            (1, -1),
            (-1, -1),
        ];
        let offsets = if D == 2 { &ALL[..3] } else { &ALL };
        let rough = offsets.len() * (2 * self.far + 1) * most;
        if rough <= MAX_NEIGHBOURS as usize {
            return rough;
        }
        let mut most = 0;
        for strip in 0..self.strips.len() - 1 {
            for column in (0..self.columns).filter(|&c| !self.cell(strip, c).is_empty()) {
                let beside = self.beside(strip, offsets);
                most = most.max(beside.map(|s| self.around(s, column).len()).sum());
            }
        }
        most
    }
}

/// One strip, whose meetings are to be listed.
struct Listing<'a, const D: usize> {
    layout: &'a Layout,
    strip: usize,
    list: &'a mut Vec<Meeting>,
}

impl<const D: usize> Work for Listing<'_, D> {
    /// How many meetings of the list count; what comes after them is left over.
    type Output = usize;
    #[inline(always)]
    fn run<Q: Quad>(self, simd: Q) -> usize {
        let layout = self.layout;
        let strip = layout.strips[self.strip];
        let within = (layout.reach + layout.skin) * (layout.reach + layout.skin);
        let within = simd.splat(within);
        let first_row = strip.rows().start;
        let mut length = 0;
        for column in 0..layout.columns {
            let cell = layout.cell(self.strip, column);
            if cell.is_empty() {
                continue;
            }
            let rows_of = |s: usize| {
                let (places, strip) = (layout.around(s, column), &layout.strips[s]);
                let slot = |place| place - strip.place + strip.slot;
                if places.is_empty() {
                    0..0
                } else {
                    slot(places.start) / ROW..slot(places.end).div_ceil(ROW)
                }
            };
            let own_end = rows_of(self.strip).end;
            let mut windows = [const { 0..0 }; 5];
            let mut candidates = own_end.saturating_sub(rows_of(self.strip).start);
            for (window, s) in windows[1..].iter_mut().zip(layout.forward::<D>(self.strip)) {
                *window = rows_of(s);
                candidates += window.len();
            }
            for place in cell {
                let slot = place - strip.place + strip.slot;
                windows[0] = slot / ROW + 1..own_end;
                if self.list.len() < length + candidates {
                    self.list.resize(length + candidates, Meeting::default());
                }
                let k = place - strip.place;
                let x_i = &layout.x[slot / ROW * D..][..D];
                for window in &windows {
                    for row in window.clone() {
                        let x_j = &layout.x[row * D..][..D];
                        let mut r2 = simd.splat(0.0);
                        for d in 0..D {
                            let x = simd.splat(x_i[d].0[slot % ROW]);
                            let x_ij = simd.sub(x, simd.load(x_j[d]));
                            r2 = simd.add(r2, simd.mul(x_ij, x_ij));
                        }
                        // Written in any case, and kept where it counts: no branch to predict.
                        self.list[length] = Meeting::new::<D>(k, row - first_row);
                        length += usize::from(simd.any_below(r2, within));
                    }
                }
            }
        }
        length
    }
}

/// Puts into every place what was in the place that `order` names: ids, and every field of the
/// state. Scratch is of no use afterwards, so it stays where it is.
fn reorder<A: Arithmetic, const D: usize>(particles: &mut Set<'_, A, D>, order: &[u32]) {
    fn each<T: Copy + Send + Sync, const C: usize>(items: &mut [T], order: &[u32]) {
        let items = items.as_chunks_mut::<C>().0;
        let sorted: Vec<[T; C]> = order.iter().map(|&place| items[place as usize]).collect();
        items.copy_from_slice(&sorted);
    }
    fn any<T: Copy + Send + Sync>(items: &mut [T], components: usize, order: &[u32]) {
        match components {
            1 => each::<_, 1>(items, order),
            2 => each::<_, 2>(items, order),
            3 => each::<_, 3>(items, order),
            _ => {
                let whole = |&place: &u32| place as usize * components..;
                let one = |place| items[whole(place)][..components].iter().copied();
                let sorted: Vec<T> = order.iter().flat_map(one).collect();
                items.copy_from_slice(&sorted);
            }
        }
    }
    let (fields, side) = (particles.fields(), particles.side());
    let (ids, words) = particles.parts();
    rayon::scope(|scope| {
        for (field, (components, words)) in fields.iter().zip(words) {
            if field.role(side) == Role::State {
                scope.spawn(move |_| any(words, components, order));
            }
        }
        each::<_, 1>(ids, order);
    });
}

/// Where most of the values are: from the least to the greatest, but no farther than six standard
/// deviations and `margin` from the mean. A few particles that have flown far must not blow up the
/// box.
fn interval(values: impl Iterator<Item = f64>, margin: f64) -> (f64, f64) {
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    let (mut n, mut sum, mut squares) = (0.0f64, 0.0, 0.0);
    for x in values {
        low = low.min(x);
        high = high.max(x);
        n += 1.0;
        sum += x;
        squares += x * x;
    }
    let mean = sum / n.max(1.0);
    let spread = 6.0 * (squares / n.max(1.0) - mean * mean).max(0.0).sqrt() + margin;
    (low.max(mean - spread), high.min(mean + spread))
}
