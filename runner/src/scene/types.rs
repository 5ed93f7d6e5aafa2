//! A scene, validated: every number finite, in range and in SI units. Its keys are declared here,
//! but for those that a model, a force or a region brings.

use super::declare::{KeyTable, Keys, keys};
use super::forces::Gravity;
use super::model::Model;
use super::page::Page;
use super::region::Region;
use super::schema::IfAbsent::{Number, Optional, Required, Word};
use super::schema::Range::{Above, Any, Between};
use super::schema::{ANY_MODEL, TableRules};
use super::solid::{self, Solid};
use super::step::StepRule;
use super::superfluid::Superfluid;
use super::viscous::Viscous;
use super::wcsph::{Fluid, WallPotential, Water};
use super::words::{Dimension, Integrator, Overlap};
use crate::figures::Scale;
use loschmidt_core::schemes::solid::Material;
use std::collections::HashMap;

keys! {
    /// A validated scene. Points have three coordinates; in two dimensions every z is 0.
    Scene of ANY_MODEL, table File "the top level" {
        name: String = Optional, Any, "short name; runs are filed under it";
        description: String = Optional, Any, "what happens in this scene";
        source: String = Optional, Any, "where the numbers come from";
        dimension: Dimension = Number(2.0), Any, "number of space dimensions";
        particle_spacing: f64 = Required, Above(0.0),
            "side of the square or cube of fluid that one particle stands for", "m";
        support: f64 = Number(3.0), Between(1.5, 6.0),
            "support radius h, where the kernel vanishes", "particle spacings";
        /// How the time step is chosen.
        ..step: StepRule;
        turnaround: Option<f64> = Optional, Above(0.0),
            "time at which all velocities are reversed; absent: a one-way run", "s";
        end: Option<f64> = Optional, Above(0.0),
            "time at which the run stops, both legs added; absent: twice the turnaround", "s";
        domain: Option<f64> = Optional, Above(0.0),
            "largest coordinate, along any axis, that particles may come to; absent: what the first \
             positions, velocities and forces let expect", "m";
        overlap: Overlap = Word(Overlap::Refuse.word()), Any,
            "regions that overlap, or come nearer than 0.8 particle spacings";
        model: Model = Word(Model::Symplectic.word()), Any,
            "water: density by summation (reversible), advanced in time, \
             or summed with a filter of noise (dissipative); elastic bodies: \
             reversible, or with the midpoint integrator of the paper; a viscous fluid \
             (dissipative); superfluid helium: reversible, with friction (dissipative), or with the \
             integrator of the paper";
        integrator: Integrator = Word(Integrator::StormerVerlet.word()), Any,
            "composition of drifts and kicks in a step";
        /// The settings of the weakly compressible models.
        ..water: Water;
        fluid: Option<Fluid> = Required, Any, "what the material is";
        solid: Option<Solid> = Required, Any, "what the bodies are made of";
        viscous: Option<Viscous> = Required, Any, "what the viscous fluid is";
        superfluid: Option<Superfluid> = Required, Any, "which helium it is";
        gravity: Gravity = Optional, Any, "which outside forces act";
        wall: Option<WallPotential> = Optional, Any, "how a conservative wall repels";
        output: Output = Optional, Any, "how much a run writes; changes no bit of it";
        /// What is filled with particles, in the order of their ids.
        ..regions: Vec<Region>;
    }
}

/// The top level of a scene file.
pub(super) const TOP: &TableRules = Scene::RULES;

keys! {
    /// How much a run writes; it changes no bit of the run.
    #[derive(Copy, Eq)]
    Output of ANY_MODEL, table Header "`[output]`" {
        rows: u64 = Number(1000.0), Between(2.0, 1e6),
            "rows of the series over both legs, at least";
        frames: u64 = Number(20.0), Between(0.0, 1e6),
            "particle frames over both legs, at least; 0: none";
        snapshots: u64 = Number(20.0), Between(1.0, 1e6),
            "snapshots of the latest state, each replacing the one before";
    }
}

impl Scene {
    /// The scene as an annotated TOML file; [`load`](super::load) reads it back as an equal scene.
    ///
    /// Every key stands on its own line with unit and meaning. A key that is not set is commented
    /// out, with the value that takes effect where there is one.
    #[must_use]
    pub fn to_toml(&self) -> String {
        let follows = vec![
            (
                "cfl",
                self.time_step() * self.step_speed() / self.support_radius(),
            ),
            ("time_step", self.time_step()),
            ("end", self.end_time()),
        ];
        let mut page = Page::new(TOP, self.dimension, self.model.family(), follows);
        Self::print(Some(self), &mut page);
        page.finish()
    }

    /// The number of the body that each region belongs to, in the order in which bodies appear, and
    /// how many bodies there are.
    #[must_use]
    pub fn bodies(&self) -> (Vec<usize>, usize) {
        let mut known: HashMap<&str, usize> = HashMap::new();
        let mut count = 0;
        let mut new = || {
            count += 1;
            count - 1
        };
        let regions = self.regions.iter();
        let numbers = regions.map(|region| match region.body.as_deref() {
            Some(name) => *known.entry(name).or_insert_with(&mut new),
            None => new(),
        });
        (numbers.collect(), count)
    }

    /// The support radius of the kernel, m.
    #[must_use]
    pub fn support_radius(&self) -> f64 {
        self.support * self.particle_spacing
    }

    /// The density of the material at rest, kg/m³ (kg/m² in the plane).
    #[must_use]
    pub fn reference_density(&self) -> f64 {
        let of_model = [
            self.fluid.map(|fluid| fluid.reference_density),
            self.solid.map(|solid| solid.reference_density),
            self.viscous.map(|viscous| viscous.reference_density),
            self.superfluid.map(|it| it.helium().reference_density),
        ];
        // A scene without any has a mistake, and nothing of it is used.
        of_model.into_iter().flatten().next().unwrap_or(f64::NAN)
    }

    /// The speed of sound in the material, m/s: in a solid, of longitudinal waves; in a superfluid,
    /// of first sound.
    #[must_use]
    pub fn sound_speed(&self) -> f64 {
        if let Some(superfluid) = self.superfluid {
            return superfluid.helium().sound_speed;
        }
        let fastest = self.fastest(Material::longitudinal_speed);
        // A scene without any has a mistake, and nothing of it is used.
        fastest.unwrap_or(self.fluid.map_or(f64::NAN, |fluid| fluid.sound_speed))
    }

    /// The speed that limits the time step, m/s: that of sound, of a superfluid the faster one of
    /// both, and with what [`Solid::step_speed`] adds where particles carry a distortion.
    #[must_use]
    pub fn step_speed(&self) -> f64 {
        if let Some(superfluid) = self.superfluid {
            let helium = superfluid.helium();
            return helium.sound_speed.max(helium.second_sound());
        }
        let fastest = self.fastest(solid::step_speed);
        fastest.unwrap_or(self.sound_speed())
    }

    /// The largest of these speeds of all materials.
    fn fastest(&self, speed: impl Fn(&Material) -> f64) -> Option<f64> {
        self.materials().iter().map(speed).reduce(f64::max)
    }

    /// Whether particles carry a distortion: in elastic bodies and in viscous fluids.
    #[must_use]
    pub fn has_distortion(&self) -> bool {
        self.solid.is_some() || self.viscous.is_some()
    }

    /// What each elastic body is made of, or the one viscous fluid; nothing in scenes of water.
    #[must_use]
    pub fn materials(&self) -> Vec<Material> {
        let viscous = self.viscous.map(|viscous| viscous.material());
        let solids = self.solids().into_iter().map(|solid| solid.material());
        viscous.into_iter().chain(solids).collect()
    }

    /// What each elastic body is made of.
    #[must_use]
    pub fn solids(&self) -> Vec<Solid> {
        let Some(solid) = self.solid else {
            return Vec::new();
        };
        let (bodies, _) = self.bodies();
        let mut count = 0;
        let mut is_first = |body: usize| {
            let is_new = body == count;
            count += usize::from(is_new);
            is_new
        };
        let regions = self.regions.iter().zip(bodies);
        let firsts = regions.filter(|(_, body)| is_first(*body));
        firsts
            .map(|(region, _)| region.material.of(solid))
            .collect()
    }

    /// The mass of every particle, fluid and wall, kg (kg/m in the plane).
    #[must_use]
    pub fn particle_mass(&self) -> f64 {
        let area = self.particle_spacing * self.particle_spacing;
        let volume = match self.dimension {
            Dimension::Two => area,
            Dimension::Three => area * self.particle_spacing,
        };
        self.reference_density() * volume
    }

    /// The time step, s.
    #[must_use]
    pub fn time_step(&self) -> f64 {
        match self.step {
            StepRule::Cfl(cfl) => cfl * self.support_radius() / self.step_speed(),
            StepRule::Seconds(seconds) => seconds,
        }
    }

    /// The time at which the run stops, s, both legs added.
    #[must_use]
    pub fn end_time(&self) -> f64 {
        match (self.end, self.turnaround) {
            (Some(end), _) => end,
            (None, Some(turnaround)) => 2.0 * turnaround,
            (None, None) => 0.0,
        }
    }

    /// The unit in which people read the times of the scene.
    #[must_use]
    pub fn time_unit(&self) -> Scale {
        Scale::of(self.steps_out() as f64 * self.time_step(), "s")
    }

    /// Steps until the turnaround, or of the whole run when there is none; at least 1.
    #[must_use]
    pub fn steps_out(&self) -> u64 {
        let time = self.turnaround.unwrap_or_else(|| self.end_time());
        whole_steps(time, self.time_step()).max(1)
    }

    /// Steps of the return leg: at least 1 and at most [`steps_out`](Self::steps_out)
    /// with a turnaround, else 0.
    #[must_use]
    pub fn steps_back(&self) -> u64 {
        match (self.turnaround, self.end) {
            (None, _) => 0,
            (Some(_), None) => self.steps_out(),
            (Some(turnaround), Some(end)) => {
                whole_steps(end - turnaround, self.time_step()).clamp(1, self.steps_out())
            }
        }
    }
}

/// The number of steps nearest to a time; the conversion saturates.
pub(super) fn whole_steps(time: f64, time_step: f64) -> u64 {
    (time / time_step).round() as u64
}
