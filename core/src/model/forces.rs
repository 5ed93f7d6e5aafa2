//! What the schemes share: forces, kicks and drifts.

use super::parameters::{DensityCorrection, Parameters, SetupError, Wall};
use super::passes::{
    AntiClumpEnergyPass, AntiClumpPass, ContinuityPass, DensityPass, FilterPass, PressurePass,
    WallEnergyPass, WallGeometry, WallPass,
};
use crate::chain::nothing;
use crate::executor::{Executor, Ids, Targets};
use crate::fault::{Fault, FaultKind};
use crate::kernel::WendlandC2;
use crate::neighbours::Grid;
use crate::number::{Arithmetic, Quantity, Real};
use crate::pairs::Sources;
use crate::state::System;

/// Forces of weakly compressible SPH in D dimensions, ready to be evaluated.
#[derive(Clone, Debug)]
pub struct Forces<A: Arithmetic, const D: usize> {
    parameters: Parameters<D>,
    kernel: WendlandC2<A::Real>,
    reach_squared: A::Real,
    grid: Grid<D>,
    wall_grid: Grid<D>,
    /// 1/ρ0 in 1/quanta of density.
    inverse_reference: A::Real,
    /// ρ0 and m W(0), rounded to density quanta.
    reference_density: A::Density,
    own_density: A::Density,
    /// Centre of the attracting mass.
    centre: [A::Length; D],
}

impl<A: Arithmetic, const D: usize> Forces<A, D> {
    /// Forces from parameters in SI units.
    ///
    /// # Errors
    /// [`SetupError`] for a number out of range.
    pub fn new(parameters: Parameters<D>) -> Result<Self, SetupError> {
        parameters.check()?;
        let p = &parameters;
        let length_quantum = p.scale.length_quantum();
        let density_quantum = p.scale.density_quantum();
        let quanta = |name, metres: f64| {
            Real::round(metres / length_quantum).ok_or(SetupError::Parameter {
                name,
                value: metres,
            })
        };
        let reach = quanta("support_radius", p.support_radius)?;
        let wall_reach = match p.wall {
            Wall::Conservative { radius, .. } => quanta("wall.radius", radius)?,
            Wall::Dummy | Wall::None => reach,
        };
        let extent = p.extent.map(|e| (e / length_quantum) as i64);
        let kernel = WendlandC2::new(D, p.support_radius, length_quantum);
        let own =
            kernel.value(A::Real::from_f64(0.0)) * A::Real::from_f64(p.mass / density_quantum);
        let mut centre = [A::Length::ZERO; D];
        if let Some(central) = &p.gravity.central {
            for (c, &metres) in centre.iter_mut().zip(&central.centre) {
                *c = c
                    .add_rounded(metres / length_quantum)
                    .ok_or(SetupError::Parameter {
                        name: "gravity.central.centre",
                        value: metres,
                    })?;
            }
        }
        let reach_real = A::Real::from_f64(p.support_radius / length_quantum);
        Ok(Self {
            kernel,
            reach_squared: reach_real * reach_real,
            grid: Grid::new(reach, extent, p.max_buckets),
            wall_grid: Grid::new(wall_reach, extent, p.max_buckets),
            inverse_reference: A::Real::from_f64(density_quantum / p.reference_density),
            reference_density: A::Density::ZERO
                .add_rounded(p.reference_density / density_quantum)
                .ok_or(SetupError::Parameter {
                    name: "reference_density",
                    value: p.reference_density,
                })?,
            own_density: A::Density::ZERO
                .add_rounded(own)
                .ok_or(SetupError::Support {
                    support_radius: p.support_radius,
                })?,
            centre,
            parameters,
        })
    }

    /// The parameters.
    #[must_use]
    pub fn parameters(&self) -> &Parameters<D> {
        &self.parameters
    }
    /// Geometry of the fluid's cells.
    #[must_use]
    pub fn grid(&self) -> &Grid<D> {
        &self.grid
    }
    /// Geometry of the walls' cells.
    #[must_use]
    pub fn wall_grid(&self) -> &Grid<D> {
        &self.wall_grid
    }
    /// ρ/ρ0.
    #[inline]
    pub fn relative_density(&self, density: A::Density) -> A::Real {
        density.quanta::<A::Real>() * self.inverse_reference
    }
    /// The density sum (5).
    #[must_use]
    pub fn density_pass(&self) -> DensityPass<A::Real> {
        let scale = self.parameters.scale;
        DensityPass {
            kernel: self.kernel,
            reach_squared: self.reach_squared,
            mass: A::Real::from_f64(self.parameters.mass / scale.density_quantum()),
        }
    }
    /// The pressure impulse (1b).
    #[must_use]
    pub fn pressure_pass(&self) -> PressurePass<A::Real> {
        PressurePass {
            kernel: self.kernel,
            reach_squared: self.reach_squared,
        }
    }
    /// The continuity sum (1a) over `duration` seconds.
    #[must_use]
    pub fn continuity_pass(&self, duration: f64) -> ContinuityPass<A::Real> {
        let s = self.parameters.scale;
        let units = s.speed_quantum() * s.length_quantum() / s.density_quantum();
        ContinuityPass {
            kernel: self.kernel,
            reach_squared: self.reach_squared,
            factor: A::Real::from_f64((duration * self.parameters.mass) * units),
        }
    }
    /// The filter's sum of velocity differences.
    #[must_use]
    pub fn filter_pass(&self) -> FilterPass<A::Real> {
        let p = &self.parameters;
        FilterPass {
            kernel: self.kernel,
            reach_squared: self.reach_squared,
            volume: A::Real::from_f64(p.mass / p.reference_density),
        }
    }
    /// W̃ and the square of its reach in length quanta, with p0/ρ0² in J m³/kg² (2D: J m²/kg²), where
    /// there is such a repulsion.
    fn anti_clump(&self) -> Option<(f64, WendlandC2<A::Real>, A::Real)> {
        let p = &self.parameters;
        let clump = p.anti_clump.filter(|clump| clump.pressure > 0.0)?;
        let quantum = p.scale.length_quantum();
        let reach = A::Real::from_f64(clump.support_radius / quantum);
        let strength = clump.pressure / (p.reference_density * p.reference_density);
        let kernel = WendlandC2::new(D, clump.support_radius, quantum);
        Some((strength, kernel, reach * reach))
    }
    /// The repulsion of near particles over `duration` seconds, if there is one.
    #[must_use]
    pub fn anti_clump_pass(&self, duration: f64) -> Option<AntiClumpPass<A::Real>> {
        let (strength, kernel, reach_squared) = self.anti_clump()?;
        let p = &self.parameters;
        let units = p.scale.length_quantum() / p.scale.speed_quantum();
        Some(AntiClumpPass {
            kernel,
            reach_squared,
            factor: A::Real::from_f64(-((duration * p.mass) * (2.0 * strength) * units)),
        })
    }
    /// The energy of near particles, if they repel each other, with its unit in J/kg for each of two
    /// particles.
    #[must_use]
    pub fn anti_clump_energy_pass(&self) -> Option<(f64, AntiClumpEnergyPass<A::Real>)> {
        let (strength, kernel, reach_squared) = self.anti_clump()?;
        let most = kernel.value(A::Real::from_f64(0.0)).to_f64();
        let pass = AntiClumpEnergyPass {
            kernel,
            reach_squared,
            factor: A::Real::from_f64(1.0 / most),
        };
        Some((strength * self.parameters.mass * most, pass))
    }
    fn wall_geometry(&self) -> Option<(f64, WallGeometry<A::Real>)> {
        let Wall::Conservative {
            energy,
            radius,
            softening,
        } = self.parameters.wall
        else {
            return None;
        };
        let quantum = self.parameters.scale.length_quantum();
        let (r, e) = (radius / quantum, softening / quantum);
        let geometry = WallGeometry {
            radius_squared: A::Real::from_f64(r * r),
            softening_squared: A::Real::from_f64(e * e),
        };
        Some((energy, geometry))
    }
    /// The impulse of a conservative wall over `duration` seconds, if there is one.
    #[must_use]
    pub fn wall_pass(&self, duration: f64) -> Option<WallPass<A::Real>> {
        let (energy, geometry) = self.wall_geometry()?;
        let s = self.parameters.scale;
        let units = s.length_quantum() * s.speed_quantum();
        Some(WallPass {
            geometry,
            factor: A::Real::from_f64((duration * energy) / units),
        })
    }
    /// The energy of a conservative wall, if there is one, with its unit E in J/kg.
    #[must_use]
    pub fn wall_energy_pass(&self) -> Option<(f64, WallEnergyPass<A::Real>)> {
        let (energy, geometry) = self.wall_geometry()?;
        Some((energy, WallEnergyPass { geometry }))
    }

    /// Refuses memory that would leave particles out silently.
    pub(super) fn check_capacity(&self, system: &System<'_, A, D>) -> Result<(), Fault> {
        system
            .check_capacity(self.grid.buckets(), self.wall_grid.buckets())
            .map_err(|error| Fault::new(FaultKind::Capacity(error.what), 0))
    }

    /// Sorts the fluid into its cells, and the walls the first time.
    pub(super) fn sort<E: Executor>(&self, system: &mut System<'_, A, D>, exec: &E) {
        // Dummies look for the fluid in its cells, and so does the energy of near particles.
        let for_others = self.has_dummies(system) || self.parameters.anti_clump.is_some();
        let System {
            state,
            walls,
            scratch,
            progress,
        } = system;
        exec.locate::<A, D>(&self.grid, state, &mut scratch.cells, for_others);
        // The storage order may be another one now.
        progress.impulse_for = None;
        if !progress.walls_sorted {
            exec.locate_walls::<A, D>(&self.wall_grid, walls.position, &mut scratch.wall_cells);
            progress.walls_sorted = true;
        }
    }

    /// The fluid as sources; the caller has sorted it.
    pub(crate) fn fluid<'s, T, const READ: usize>(
        &'s self,
        system: &'s System<'_, A, D>,
        read: &'s [[T; READ]],
    ) -> Sources<'s, A, T, D, READ> {
        Sources {
            grid: &self.grid,
            cells: system.scratch.cells.view(),
            position: system.state.position,
            read,
        }
    }

    /// The walls as sources.
    pub(crate) fn walls<'s, T, const READ: usize>(
        &'s self,
        system: &'s System<'_, A, D>,
        read: &'s [[T; READ]],
    ) -> Sources<'s, A, T, D, READ> {
        Sources {
            grid: &self.wall_grid,
            cells: system.scratch.wall_cells.view(),
            position: system.walls.position,
            read,
        }
    }

    /// Σ m W over fluid and dummies, into `out` (which is overwritten), for every fluid particle.
    pub(super) fn sum_density<E: Executor>(
        &self,
        system: &System<'_, A, D>,
        exec: &E,
        out: &mut [A::Density],
    ) -> Result<(), Fault> {
        out.fill(self.own_density);
        let pass = self.density_pass();
        let mut to = Targets {
            position: &*system.state.position,
            read: nothing(),
            id: Ids::Listed(system.state.id),
            same_set: true,
        };
        exec.sum(
            &pass,
            &to,
            &self.fluid(system, nothing()),
            out.as_chunks_mut().0,
        )?;
        if self.has_dummies(system) {
            to.same_set = false;
            exec.sum(
                &pass,
                &to,
                &self.walls(system, nothing()),
                out.as_chunks_mut().0,
            )?;
        }
        Ok(())
    }

    /// Adds to `out` Σ m W over the fluid, for every wall particle.
    pub(super) fn add_fluid_to_walls<E: Executor>(
        &self,
        system: &System<'_, A, D>,
        exec: &E,
        out: &mut [A::Density],
    ) -> Result<(), Fault> {
        let to = Targets {
            position: &*system.walls.position,
            read: nothing(),
            id: Ids::From(system.state.len() as u64),
            same_set: false,
        };
        exec.sum(
            &self.density_pass(),
            &to,
            &self.fluid(system, nothing()),
            out.as_chunks_mut().0,
        )
    }

    /// Σ m W over the walls themselves, into `out`, for every wall particle.
    pub(super) fn sum_walls<E: Executor>(
        &self,
        system: &System<'_, A, D>,
        exec: &E,
        out: &mut [A::Density],
    ) -> Result<(), Fault> {
        out.fill(self.own_density);
        let to = Targets {
            position: &*system.walls.position,
            read: nothing(),
            id: Ids::From(system.state.len() as u64),
            same_set: true,
        };
        exec.sum(
            &self.density_pass(),
            &to,
            &self.walls(system, nothing()),
            out.as_chunks_mut().0,
        )
    }

    pub(crate) fn has_dummies(&self, system: &System<'_, A, D>) -> bool {
        matches!(self.parameters.wall, Wall::Dummy) && !system.walls.position.is_empty()
    }

    /// The reference density, or C_a = ρ0 - `sum` for a constant correction.
    pub(super) fn density_constant(&self, sum: A::Density) -> A::Density {
        match self.parameters.density_correction {
            DensityCorrection::Constant => self.reference_density.plus(sum.negated()),
            DensityCorrection::None => A::Density::ZERO,
        }
    }
    /// m W(0), in density quanta.
    pub(super) fn own_density(&self) -> A::Density {
        self.own_density
    }
    /// Centre of the attracting mass, in length quanta.
    pub(crate) fn centre(&self) -> &[A::Length; D] {
        &self.centre
    }
    pub(super) fn reference_density(&self) -> A::Density {
        self.reference_density
    }
}
