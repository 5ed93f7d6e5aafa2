//! The keys of the weakly compressible models of water: what the material is, what happens at free
//! surfaces and walls, and the filter.

use super::declare::keys;
use super::schema::Family;
use super::schema::IfAbsent::{Number, Required, Word};
use super::schema::Range::{Above, AboveUpTo, Any, AtLeast, Between};
use super::words::words;

/// The models that have these keys.
pub(super) const FAMILY: Family = "weakly compressible";
const WATER: Option<Family> = Some(FAMILY);

keys! {
    /// How the models work, beside the material.
    #[derive(Copy)]
    Water of WATER {
        filter_every: u64 = Number(30.0), Between(1.0, 1e9),
            "interval at which the model \"filtered\" averages velocities", "steps",
            printed after "model";
        density_correction: DensityCorrection = Word(DensityCorrection::Constant.word()), Any,
            "what makes the first density the reference density: a constant per particle, \
             an initial state correction (the particles are moved), or nothing; or the constant makes \
             it that of water at rest under gravity";
        wall_model: WallModel = Word(WallModel::Conservative.word()), Any,
            "repulsive potential, fixed fluid particles, or walls left out";
    }
}

keys! {
    /// The material of the fluid. In the plane a density is per area, kg/m².
    #[derive(Copy)]
    Fluid of WATER, table Header "`[fluid]`" {
        reference_density: f64 = Number(1000.0), Above(0.0),
            "density at which the pressure is zero", "kg/m³";
        sound_speed: f64 = Required, Above(0.0),
            "numerical speed of sound, about ten times the fastest flow", "m/s";
        equation_of_state: EquationOfState = Word(EquationOfState::Tait.word()), Any,
            "pressure as a function of density";
        anti_clump_pressure: f64 = Number(0.0), AtLeast(0.0),
            "strength p0 of a repulsion between particles that are very near; 0: none", "Pa";
        anti_clump_radius: f64 = Number(0.5), AboveUpTo(0.0, 1.5),
            "distance at which that repulsion begins", "particle spacings";
    }
}

keys! {
    /// The potential of a conservative wall, per mass of fluid.
    #[derive(Copy)]
    WallPotential of WATER, table Header "`[wall]`" {
        energy: f64 = Required, Above(0.0),
            "depth of the wall potential; 10 g H for a column of height H", "J/kg";
        radius: f64 = Number(0.95), AboveUpTo(0.0, 6.0),
            "distance at which the wall begins to repel", "particle spacings";
        softening: f64 = Number(1e-6), AtLeast(0.0),
            "length added in squares to the distance", "m";
    }
}

words! {
    /// How the summed density is corrected at free surfaces.
    DensityCorrection {
        /// A constant C_a per particle makes the first density the reference density.
        Constant = "constant",
        /// The particles are moved until the bare sum is the reference density (see
        /// [`isc`](crate::isc)).
        Isc = "isc",
        /// C_a makes the first pressure carry the weight above: water at rest stays at rest.
        Hydrostatic = "hydrostatic",
        /// The bare sum over the neighbours.
        None = "none",
    }
}

words! {
    /// How walls act on the fluid.
    WallModel {
        /// A repulsive pair potential of each wall particle, part of the energy.
        Conservative = "conservative",
        /// Wall particles take part in density and pressure as fixed fluid.
        Dummy = "dummy",
        /// Walls are left out: no wall particle is made.
        None = "none",
    }
}

words! {
    /// Pressure as a function of density.
    EquationOfState {
        /// p = c² rho0 / 7 ((rho / rho0)^7 - 1).
        Tait = "tait",
        /// p = c² (rho - rho0).
        Linear = "linear",
    }
}
