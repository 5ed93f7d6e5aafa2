//! A row of the series: what is recorded of a state.

use crate::player::Player;
use crate::totals::heading;
use loschmidt_core::{Diagnostics, Fault};
use std::borrow::Cow;

/// One line of `series.csv`.
///
/// Everything is computed from the synchronised state by sums that no order can change: rows of the
/// way back equal those of the way out to the last bit, but for the signs of the momenta.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Row {
    /// Steps taken over both legs.
    pub step: u64,
    /// Steps from home along physical time.
    pub position: i64,
    /// 1 out, 2 back.
    pub leg: u8,
    /// Simulated time along both legs.
    pub elapsed_s: f64,
    /// Physical time.
    pub time_s: f64,
    /// Energies by kind, J (per m of depth in 2D), in the model's order; the first is the kinetic
    /// one.
    pub energies: Vec<(Cow<'static, str>, f64)>,
    /// Their sum, J.
    pub total: f64,
    /// Σ v in speed quanta, an exact integer.
    pub momentum_x_quanta: i128,
    /// Σ v in speed quanta, an exact integer.
    pub momentum_y_quanta: i128,
    /// Σ v in speed quanta, an exact integer.
    pub momentum_z_quanta: i128,
    /// Angular momentum about the origin, kg m²/s.
    pub angular_momentum_x: f64,
    /// Angular momentum about the origin, kg m²/s.
    pub angular_momentum_y: f64,
    /// Angular momentum about the origin, kg m²/s; the only component in 2D.
    pub angular_momentum_z: f64,
    /// Reduced Boltzmann entropy (17).
    pub entropy: f64,
    /// Its equilibrium value for the kinetic energy (21); empty at rest.
    pub equilibrium_entropy_of_energy: Option<f64>,
    /// Its equilibrium value for the fitted temperature (20); empty at rest.
    pub equilibrium_entropy_of_fit: Option<f64>,
    /// kT/m of the fit.
    pub fitted_temperature_m2_per_s2: Option<f64>,
    /// Particles faster than the last bin of the histogram.
    pub faster_than_last_bin: u32,
    /// Largest x of a particle: the leading edge.
    pub front_m: f64,
    /// What else the model says of the whole, with the units in the names, in the model's order.
    pub totals: Vec<(Cow<'static, str>, f64)>,
    /// Linear momentum, kg m/s (per m of depth in 2D); none in a series of an earlier version.
    pub momentum: Option<[f64; 3]>,
}

impl Row {
    /// Measures the player's state.
    ///
    /// # Errors
    /// As a step.
    pub fn measure(player: &mut Player, leg: u8) -> Result<Self, Fault> {
        let diagnostics = player.measure()?;
        Ok(Self::of(player, leg, &diagnostics))
    }

    /// The row of the player's state, of which `d` was just measured.
    #[must_use]
    pub fn of(player: &Player, leg: u8, d: &Diagnostics) -> Self {
        let energies = d.energies.iter();
        let fit = d.histogram.fitted_temperature();
        Self {
            step: player.steps_taken(),
            position: player.position(),
            leg,
            elapsed_s: player.steps_taken() as f64 * player.scene().time_step(),
            time_s: player.time(),
            energies: energies.map(|(name, value)| (name.into(), value)).collect(),
            total: d.energies.total(),
            momentum_x_quanta: d.momentum_quanta[0],
            momentum_y_quanta: d.momentum_quanta[1],
            momentum_z_quanta: d.momentum_quanta[2],
            angular_momentum_x: d.angular_momentum[0],
            angular_momentum_y: d.angular_momentum[1],
            angular_momentum_z: d.angular_momentum[2],
            entropy: d.histogram.entropy(),
            equilibrium_entropy_of_energy: d.histogram.equilibrium_of_energy(),
            equilibrium_entropy_of_fit: fit.and_then(|t| {
                loschmidt_core::observe::equilibrium_entropy(d.histogram.dimension, t)
            }),
            fitted_temperature_m2_per_s2: fit,
            faster_than_last_bin: d.histogram.beyond,
            front_m: d.front,
            totals: d
                .totals
                .iter()
                .map(|(measure, value)| (heading(&measure).into(), value))
                .collect(),
            momentum: None,
        }
        .with_momentum(player)
    }

    /// The row with the momentum in kg m/s, from that in quanta.
    #[must_use]
    pub(crate) fn with_momentum(self, player: &Player) -> Self {
        let quanta = self.momentum_quanta();
        let unit = player.momentum_unit();
        Self {
            // No zero with a sign.
            momentum: Some(quanta.map(|p| p as f64 * unit + 0.0)),
            ..self
        }
    }

    /// The row of the same state with every velocity turned: momenta change their sign.
    #[must_use]
    pub(crate) fn turned(mut self) -> Self {
        for sum in [
            &mut self.momentum_x_quanta,
            &mut self.momentum_y_quanta,
            &mut self.momentum_z_quanta,
        ] {
            *sum = -*sum;
        }
        for moment in [
            &mut self.angular_momentum_x,
            &mut self.angular_momentum_y,
            &mut self.angular_momentum_z,
        ] {
            *moment = -*moment;
        }
        // No zero with a sign.
        self.momentum = self.momentum.map(|p| p.map(|p| 0.0 - p));
        self
    }

    /// Whether the model has an energy of this kind.
    #[must_use]
    pub fn has_energy(&self, kind: &str) -> bool {
        self.energies.iter().any(|(name, _)| name == kind)
    }

    /// The energy of this kind, J; 0 where the model has no such kind.
    #[must_use]
    pub fn energy(&self, kind: &str) -> f64 {
        let mut energies = self.energies.iter();
        energies
            .find(|(name, _)| name == kind)
            .map_or(0.0, |(_, value)| *value)
    }

    /// The total of this name.
    #[must_use]
    pub fn total_of(&self, name: &str) -> Option<f64> {
        let mut totals = self.totals.iter();
        totals.find(|(known, _)| known == name).map(|total| total.1)
    }

    /// Σ v in speed quanta.
    #[must_use]
    pub fn momentum_quanta(&self) -> [i128; 3] {
        [
            self.momentum_x_quanta,
            self.momentum_y_quanta,
            self.momentum_z_quanta,
        ]
    }
}
