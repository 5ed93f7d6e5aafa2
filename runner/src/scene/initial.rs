//! From a scene to its particles: lattice nodes inside the regions, with first velocities.
//!
//! Every fluid region has its own lattice, which starts half a pitch inside the lower corner of the
//! region's bounds (a spiral: in their middle). Walls continue the lattice of the first fluid
//! region, and the regions of an elastic body that of the body's first region. Particles are
//! ordered region after region in file order, walls last, and in a region x fastest, then y, then z; that order
//! gives the particles their ids. Where the scene asks for it, the fluid is then moved by the
//! initial state correction (see [`isc`](crate::isc)), and has its first velocities where it was
//! moved to.

use super::error::SceneError;
use super::filling::visit;
use super::geometry::Vector3;
use super::lattice::Lattice;
use super::region::Region;
use super::shape::Shape;
use super::superfluid::WallPressure;
use super::types::Scene;
use super::viscous::WallVelocity;
use super::wcsph::{DensityCorrection, WallModel};
use super::words::{Dimension, LatticeKind, RegionKind};
use crate::isc;
use loschmidt_core::schemes::solid::Motion;

/// The particles at time zero; z is 0 in two dimensions.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct InitialState {
    /// Positions of the fluid particles in the order of their ids, m.
    pub fluid: Vec<Vector3>,
    /// Velocities of the fluid particles, m/s; as many as there are positions.
    pub fluid_velocity: Vec<Vector3>,
    /// Positions of the wall particles, m.
    pub wall: Vec<Vector3>,
    /// The walls of each region, in the order of their first particles.
    pub walls: Vec<InitialWall>,
    /// The parts of elastic bodies or of a viscous fluid and its walls, one for each region, in the
    /// order of their first ids.
    pub parts: Vec<InitialPart>,
    /// What else the model is given of the particles: of a viscous fluid the ways from wall
    /// particles to the surface of the flow, of a superfluid its counterflow and entropy.
    pub given: Vec<GivenField>,
    /// What else the model is given of the walls: of a vessel of helium, what their density sums would
    /// be in full surroundings.
    pub wall_given: Vec<GivenField>,
    /// What is added to fields that the model makes of the first positions: of water at rest, what its
    /// density has above the reference density.
    pub added: Vec<GivenField>,
    /// The same of walls.
    pub wall_added: Vec<GivenField>,
}

/// First values of a field, in its SI unit or as a pure number.
#[derive(Clone, Debug, PartialEq)]
pub struct GivenField {
    /// Its name in the model's declaration.
    pub name: &'static str,
    /// A value for every particle, in the order of ids, or for every wall; of a scalar the first
    /// component.
    pub values: Vec<Vector3>,
}

/// Wall particles one after another that belong to one region.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InitialWall {
    /// Place of the first one in [`InitialState::wall`].
    pub first: u64,
    /// Number of the region in the scene.
    pub region: usize,
}

/// Particles with consecutive ids that belong to one body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InitialPart {
    /// Id of the first one.
    pub first: u64,
    /// Number of the body, in the order of appearance.
    pub body: usize,
    /// Whether they never move but by their motion.
    pub held: bool,
    /// How what is held moves.
    pub motion: Motion,
}

/// The most particles of a scene: their numbers fit into 32 bits with one to spare.
const MOST_PARTICLES: u64 = 1 << 31;

/// The most nodes an estimate visits in one region.
const MOST_SAMPLES: f64 = (1_u64 << 20) as f64;

/// The most nodes of a region's bounds, each of which is visited: a shape that fills but
/// a little of its bounds is not searched for hours.
const MOST_NODES: f64 = (1_u64 << 33) as f64;

/// Largest coordinate over spacing at which the nodes of a lattice are told apart to the
/// tolerance of the faces.
const FARTHEST: f64 = 1e6;

impl Scene {
    /// The number of fluid and of wall particles, without making them.
    ///
    /// Exact for regions whose bounds hold at most 2^20 nodes. A larger region is counted
    /// on a lattice k times coarser, and the count is multiplied by k^D, or by k^(D-1) for
    /// a layer; it then deviates by a few nodes in each row of the coarse lattice.
    #[must_use]
    pub fn estimated_particles(&self) -> (u64, u64) {
        let mut counts = (0_u64, 0_u64);
        let Some(first) = self.first_lattice() else {
            return counts;
        };
        for (number, region) in self.filled_regions() {
            let lattice = self.lattice_of(number).unwrap_or(first);
            let count = if self.is_movable(region.kind) {
                &mut counts.0
            } else {
                &mut counts.1
            };
            *count = count.saturating_add(estimate(lattice, &region.shape));
        }
        counts
    }

    /// Places the particles.
    ///
    /// # Errors
    ///
    /// [`SceneError::NoFluid`], [`SceneError::EmptyRegion`], [`SceneError::TooManyParticles`],
    /// [`SceneError::TooFar`], [`SceneError::TooSparse`], and [`SceneError::Overlap`] when two
    /// regions fill one place; [`SceneError::OutsideDomain`]; [`SceneError::NotCorrected`] when
    /// the initial state correction does not converge.
    pub fn initial_state(&self) -> Result<InitialState, SceneError> {
        let no_fluid = || SceneError::NoFluid {
            scene: self.name.clone(),
            particle_spacing: self.particle_spacing,
            kind: if self.solid.is_some() {
                "solid"
            } else {
                "fluid"
            },
        };
        let first = self.first_lattice().ok_or_else(no_fluid)?;
        if self.nodes_of_bounds(first) > MOST_PARTICLES as f64 {
            let (fluid, wall) = self.estimated_particles();
            self.refuse_above(fluid.saturating_add(wall), MOST_PARTICLES)?;
        }

        let mut state = InitialState::default();
        let mut placed = Vec::new();
        let (bodies, _) = self.bodies();
        for (number, region) in self.filled_regions() {
            let lattice = self.lattice_of(number).unwrap_or(first);
            self.check_reach(number, lattice, &region.shape)?;
            let points = if self.is_movable(region.kind) {
                &mut state.fluid
            } else {
                &mut state.wall
            };
            let before = points.len();
            if self.has_distortion() {
                state.parts.push(InitialPart {
                    first: before as u64,
                    // A viscous fluid is one body with its walls.
                    body: if self.solid.is_some() {
                        bodies[number]
                    } else {
                        0
                    },
                    held: region.held || region.kind == RegionKind::Wall,
                    motion: region.motion(),
                });
            }
            if !self.is_movable(region.kind) {
                state.walls.push(InitialWall {
                    first: before as u64,
                    region: number,
                });
            }
            visit(&lattice, &region.shape, |point| points.push(point));
            if points.len() == before {
                return Err(self.empty_region(number));
            }
            placed.push((number, region.kind, before));
        }
        self.refuse_outside_domain(&state)?;
        self.refuse_overlap(&state, &placed)?;
        if let Some(viscous) = self.viscous
            && viscous.wall_velocity == WallVelocity::Mirrored
        {
            let values = self.wall_offsets(&state);
            state.given.push(GivenField {
                name: "wall offset",
                values,
            });
        }
        if self.water.density_correction == DensityCorrection::Isc {
            self.correct(&mut state)?;
        }
        self.set_hydrostatic(&mut state, &placed);
        self.set_velocities(&mut state, &placed);
        if let Some(superfluid) = self.superfluid {
            let entropy = superfluid.helium().entropy;
            self.set_counterflows(&mut state, &placed, entropy);
            // Walls that pull are wet from the start.
            if superfluid.walls == WallPressure::Push && !state.wall.is_empty() {
                let values = self.full_surroundings(&state, first);
                state.wall_given.push(GivenField {
                    name: "density_constant",
                    values,
                });
            }
        }
        Ok(state)
    }

    /// Gives the fluid its first velocities, where it is.
    fn set_velocities(&self, state: &mut InitialState, placed: &[(usize, RegionKind, usize)]) {
        state.fluid_velocity = vec![[0.0; 3]; state.fluid.len()];
        let movable = placed.iter().filter(|(_, kind, _)| self.is_movable(*kind));
        let ends = movable.clone().skip(1).map(|(_, _, start)| *start);
        let ends = ends.chain([state.fluid.len()]);
        for (&(number, kind, start), end) in movable.zip(ends) {
            // What walls pretend is set by the model.
            if kind != RegionKind::Wall {
                let velocities = state.fluid_velocity[start..end].iter_mut();
                for (v, x) in velocities.zip(&state.fluid[start..end]) {
                    *v = self.regions[number].velocity_at(*x);
                }
            }
        }
    }

    /// The settings of the initial state correction of this scene. Spirals are not so symmetric
    /// that they would have to be disturbed first, and are moved in short steps, which leave them
    /// in order: on the Gresho vortex disorder is noise.
    #[must_use]
    pub fn correction(&self) -> isc::CorrectionSettings {
        let settings = isc::CorrectionSettings::new(
            self.particle_spacing,
            self.support_radius(),
            self.particle_mass(),
            self.reference_density(),
        );
        let fluid = |region: &&Region| region.kind.is_of_the_model();
        let spiral = |region: &Region| region.lattice == Some(LatticeKind::Vogel);
        if self.regions.iter().filter(fluid).all(spiral) {
            isc::CorrectionSettings {
                jitter: 0.0,
                longest: 0.025,
                most_steps: 200,
                ..settings
            }
        } else {
            settings
        }
    }

    /// Moves the particles until their summed densities are the reference density: the fluid, and
    /// dummy walls with it, which belong to the density and whose outer face is a free surface too.
    fn correct(&self, state: &mut InitialState) -> Result<isc::Convergence, SceneError> {
        match self.dimension {
            Dimension::Two => self.correct_in::<2>(state),
            Dimension::Three => self.correct_in::<3>(state),
        }
    }

    fn correct_in<const D: usize>(
        &self,
        state: &mut InitialState,
    ) -> Result<isc::Convergence, SceneError> {
        let first = |x: &Vector3| -> [f64; D] { std::array::from_fn(|d| x[d]) };
        let mut moved: Vec<[f64; D]> = state.fluid.iter().map(first).collect();
        // Other walls take no part in the density.
        if self.water.wall_model == WallModel::Dummy {
            moved.extend(state.wall.iter().map(first));
        }
        let report = isc::correct(&mut moved, &self.correction(), |_, _| {});
        let report = report.map_err(|reason| SceneError::NotCorrected {
            scene: self.name.clone(),
            reason,
        })?;
        let all = state.fluid.iter_mut().chain(&mut state.wall);
        for (x, moved) in all.zip(&moved) {
            x[..D].copy_from_slice(moved);
        }
        Ok(report)
    }

    /// Whether the particles of such a region are among those that may move: the walls of a viscous
    /// fluid are, since they carry what its particles carry.
    pub(super) fn is_movable(&self, kind: RegionKind) -> bool {
        kind.is_of_the_model() || self.viscous.is_some()
    }

    /// The regions that hold particles, with their numbers in file order, walls last.
    fn filled_regions(&self) -> impl Iterator<Item = (usize, &Region)> {
        let models = self.has_distortion() || self.superfluid.is_some();
        let walls = models || self.water.wall_model != WallModel::None;
        let regions = self.regions.iter().enumerate();
        // Walls have no ids of their own, or the last ones.
        let flow = regions
            .clone()
            .filter(|(_, region)| region.kind.is_of_the_model());
        flow.chain(regions.filter(move |(_, region)| walls && !region.kind.is_of_the_model()))
    }

    /// The number of nodes in the bounds of all regions: no scene has more particles.
    fn nodes_of_bounds(&self, lattice: Lattice) -> f64 {
        self.filled_regions()
            .filter_map(|(_, region)| region.shape.bounds(lattice.spacing))
            .map(|bounds| lattice.nodes_within(bounds))
            .sum()
    }

    fn own_lattice(&self, region: &Region) -> Option<Lattice> {
        let kind = region
            .lattice
            .filter(|kind| kind.fits(self.dimension))
            .unwrap_or(LatticeKind::natural(self.dimension));
        Some(Lattice {
            kind,
            origin: match kind {
                LatticeKind::Vogel => region.shape.middle()?,
                _ => region.shape.corner()?,
            },
            spacing: self.particle_spacing,
        })
    }

    /// The lattice of a region: of fluid its own, of a solid that of the first region of its body;
    /// none for a wall, and for what has no corner.
    pub(super) fn lattice_of(&self, number: usize) -> Option<Lattice> {
        match self.regions[number].kind {
            RegionKind::Fluid => self.own_lattice(&self.regions[number]),
            RegionKind::Solid => {
                let (bodies, _) = self.bodies();
                let first = bodies.iter().position(|body| *body == bodies[number])?;
                self.own_lattice(&self.regions[first])
            }
            RegionKind::Wall => None,
        }
    }

    /// The lattice of the first fluid region, which walls continue.
    fn first_lattice(&self) -> Option<Lattice> {
        self.regions
            .iter()
            .find(|region| region.kind.is_of_the_model())
            .and_then(|region| self.own_lattice(region))
    }

    /// The error of a region without a particle.
    fn empty_region(&self, number: usize) -> SceneError {
        let region = &self.regions[number];
        let depth = region.shape.thinnest_layer();
        SceneError::EmptyRegion {
            scene: self.name.clone(),
            region: (number, region.in_words(self.dimension)),
            particle_spacing: self.particle_spacing,
            help: match depth {
                Some(depth) if depth < 0.5 => format!(
                    "a layer's depth is counted in particle spacings, of which its first row lies \
                     at a half: {depth:?} are {:?} m",
                    depth * self.particle_spacing
                ),
                _ => "make it thicker than a spacing, or `particle_spacing` smaller".to_owned(),
            },
        }
    }

    fn refuse_outside_domain(&self, state: &InitialState) -> Result<(), SceneError> {
        let all = state.fluid.iter().chain(&state.wall);
        let reach = all.flatten().fold(0.0, |far: f64, x| far.max(x.abs()));
        match self.domain {
            Some(domain) if reach > domain => Err(SceneError::OutsideDomain {
                scene: self.name.clone(),
                reach,
                domain,
            }),
            _ => Ok(()),
        }
    }

    fn refuse_above(&self, particles: u64, limit: u64) -> Result<(), SceneError> {
        if particles <= limit {
            return Ok(());
        }
        Err(SceneError::TooManyParticles {
            scene: self.name.clone(),
            particles,
            limit,
            particle_spacing: self.particle_spacing,
        })
    }

    fn check_reach(
        &self,
        region: usize,
        lattice: Lattice,
        shape: &Shape,
    ) -> Result<(), SceneError> {
        let Some(bounds) = shape.bounds(lattice.spacing) else {
            return Ok(());
        };
        let reach = (0..self.dimension.axes())
            .flat_map(|k| [bounds.0[k], bounds.1[k], lattice.origin[k]])
            .fold(0.0, |largest: f64, x| largest.max(x.abs()));
        if reach > FARTHEST * lattice.spacing {
            return Err(SceneError::TooFar {
                scene: self.name.clone(),
                region,
                reach,
                particle_spacing: self.particle_spacing,
            });
        }
        let nodes = lattice.nodes_within(bounds);
        if nodes > MOST_NODES {
            return Err(SceneError::TooSparse {
                scene: self.name.clone(),
                region,
                nodes: nodes as u64,
            });
        }
        Ok(())
    }
}

/// Counts the nodes of a shape on a lattice coarse enough to be counted quickly.
fn estimate(lattice: Lattice, shape: &Shape) -> u64 {
    let Some(bounds) = shape.bounds(lattice.spacing) else {
        return 0;
    };
    let axes = lattice.dimension().axes();
    let nodes = lattice.nodes_within(bounds);
    let mut coarser = 1_u64;
    let mut coarse = lattice;
    // Doubling avoids a cube root, and a scene of absurd size ends the loop as well.
    while coarser < 1 << 40 && coarse.nodes_within(bounds) > MOST_SAMPLES {
        coarser *= 2;
        coarse.spacing = lattice.spacing * coarser as f64;
    }
    if coarse.nodes_within(bounds) > MOST_SAMPLES {
        return nodes as u64;
    }
    let mut count = 0_u64;
    visit(&coarse, shape, |_| count += 1);
    let power = if shape.is_thin() { axes - 1 } else { axes };
    (0..power).fold(count, |count, _| count.saturating_mul(coarser))
}
