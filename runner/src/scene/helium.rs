//! Helium in regions and vessels: what is read of them, and what the model is given at the start.

use super::builder::{Builder, Here};
use super::exclusive::{companions, only_one};
use super::filling::visit;
use super::geometry::{Vector3, around_both, grown};
use super::initial::{GivenField, InitialState};
use super::lattice::Lattice;
use super::shape::Shape;
use super::superfluid::{Counterflow, FirstEntropy};
use super::types::Scene;
use super::values::numbers;
use super::words::RegionKind;
use loschmidt_core::kernel::WendlandC2;
use rayon::prelude::*;

/// Reports keys of a wall in a region that is none, and keys of a liquid in one that is.
pub(super) fn refuse_beside_walls<'a>(builder: &mut Builder<'a>, here: Here<'a>, kind: RegionKind) {
    let wall = kind == RegionKind::Wall;
    let of_walls = ["smooth", "conduction"].map(|name| (name, !wall));
    let of_liquids = ["counterflow", "entropy"].map(|name| (name, wall));
    for (name, refused) in of_walls.into_iter().chain(of_liquids) {
        if let Some(entry) = here.table.get(name).filter(|_| refused) {
            let region = kind.word();
            let message = format!("a {region} region has no `{name}`");
            builder.conflict(message, entry.key, "remove it".to_owned());
        }
    }
}

pub(super) fn counterflow<'a>(builder: &mut Builder<'a>, here: Here<'a>) -> Option<Counterflow> {
    let fields = ["uniform", "random"];
    let entry = only_one(builder, here, "the counterflow", |name| {
        fields.contains(&name)
    })?;
    let random = entry.name == "random";
    let all: [(&str, &[&str]); 2] = [("length", &["random"]), ("seed", &["random"])];
    let needed: &[&str] = if random { &["length"] } else { &[] };
    companions(builder, here, &[(&entry.name, needed)], &all);
    Some(if random {
        Counterflow::Random {
            speed: builder.number(here, "random"),
            length: builder.number(here, "length"),
            seed: builder.number(here, "seed") as u64,
        }
    } else {
        Counterflow::Uniform(numbers(&entry.node))
    })
}

pub(super) fn entropy<'a>(builder: &mut Builder<'a>, here: Here<'a>) -> Option<FirstEntropy> {
    let fields = ["uniform", "wave"];
    let entry = only_one(builder, here, "the entropy", |name| fields.contains(&name))?;
    let wave = entry.name == "wave";
    let needed: &[&str] = if wave { &["length"] } else { &[] };
    companions(
        builder,
        here,
        &[(&entry.name, needed)],
        &[("length", &["wave"])],
    );
    Some(if wave {
        FirstEntropy::Wave {
            amplitude: builder.number(here, "wave"),
            length: builder.number(here, "length"),
        }
    } else {
        FirstEntropy::Uniform(builder.number(here, "uniform"))
    })
}

/// A node nearer to a wall particle than this, in spacings, is the place of that particle.
const ITSELF: f64 = 0.45;

impl Scene {
    /// Gives a superfluid its first counterflow and entropy, where it is; `entropy` is s0.
    pub(super) fn set_counterflows(
        &self,
        state: &mut InitialState,
        placed: &[(usize, RegionKind, usize)],
        entropy: f64,
    ) {
        let axes = self.dimension.axes();
        let mut counterflow = vec![[0.0; 3]; state.fluid.len()];
        let mut excess = counterflow.clone();
        for &(number, kind, start) in placed {
            if !self.is_movable(kind) {
                continue;
            }
            let (region, places) = (&self.regions[number], &state.fluid[start..]);
            // What belongs to later regions is overwritten by them.
            let all = region.counterflow.map(|field| field.at_all(places, axes));
            counterflow[start..].copy_from_slice(&all.unwrap_or(vec![[0.0; 3]; places.len()]));
            for (s, x) in excess[start..].iter_mut().zip(places) {
                let field = region.entropy;
                s[0] = field.map_or(0.0, |field| field.excess_at(*x, axes, entropy));
            }
        }
        for (name, values) in [("counterflow", counterflow), ("entropy", excess)] {
            state.given.push(GivenField { name, values });
        }
    }

    /// For every wall particle, Σ V0 W over all other nodes of the lattice that lie among the
    /// particles of the scene, filled or not; what lies outside of a box around them all is outside of
    /// the vessel.
    pub(super) fn full_surroundings(&self, state: &InitialState, lattice: Lattice) -> Vec<Vector3> {
        let axes = self.dimension.axes();
        let reach = self.support_radius();
        let kernel = WendlandC2::new(axes, reach, 1.0);
        let volume = self.particle_mass() / self.reference_density();
        let all = state.fluid.iter().chain(&state.wall).map(|x| (*x, *x));
        let half = 0.5 * lattice.spacing;
        let Some(inside) = all.reduce(around_both) else {
            return Vec::new();
        };
        let inside = grown(inside, [half; 3]);
        let sum_at = |middle: &Vector3| {
            let ball = Shape::Ball {
                centre: *middle,
                radius: reach,
            };
            let mut sum = 0.0;
            visit(&lattice, &ball, |x| {
                let squares = (0..axes).map(|k| (x[k] - middle[k]) * (x[k] - middle[k]));
                let r = squares.sum::<f64>().sqrt();
                let counts = (0..axes).all(|k| inside.0[k] <= x[k] && x[k] <= inside.1[k]);
                if counts && r > ITSELF * lattice.spacing && r < reach {
                    sum += volume * kernel.value(r);
                }
            });
            [sum, 0.0, 0.0]
        };
        state.wall.par_iter().map(sum_at).collect()
    }
}
