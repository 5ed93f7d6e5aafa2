//! The keys of the superfluid models: which helium it is, and how it is solved; and the first
//! counterflow and entropy of a region.

use super::declare::keys;
use super::geometry::Vector3;
use super::schema::Family;
use super::schema::IfAbsent::{Number, Optional, Required, Word};
use super::schema::Range::{Above, AboveUpTo, Any, AtLeast, Between};
use super::words::words;
use crate::random::SplitMix64;
use loschmidt_core::schemes::superfluid as core;
use std::f64::consts::PI;

/// The models that have these keys.
pub(super) const FAMILY: Family = "superfluid";
/// The same, for declarations.
pub(super) const SUPERFLUID: Option<Family> = Some(FAMILY);

keys! {
    /// Helium II near a temperature. In the plane a density is that of a depth of 1 m.
    #[derive(Copy)]
    Superfluid of SUPERFLUID, table Header "`[superfluid]`" {
        helium: HeliumAt = Word(HeliumAt::K190.word()), Any,
            "values at this temperature (Donnelly & Barenghi 1998), of which the next seven keys \
             replace single ones";
        temperature: Option<f64> = Optional, AboveUpTo(0.0, 1e3), "T0, the reference temperature", "K";
        reference_density: Option<f64> = Optional, AboveUpTo(0.0, 1e6),
            "rho0, density at the reference temperature", "kg/m³";
        entropy: Option<f64> = Optional, AboveUpTo(0.0, 1e6),
            "s0, specific entropy at the reference temperature", "J/(kg K)";
        normal_fraction: Option<f64> = Optional, AboveUpTo(0.0, 1.0),
            "chi_n0, the fraction of the normal component at s0";
        fraction_slope: Option<f64> = Optional, Any,
            "chi', by which the fraction grows with the entropy", "kg K/J";
        sound_speed: Option<f64> = Optional, AboveUpTo(0.0, 1e6),
            "u_1, the speed of first sound; 40 m/s instead of helium's 230 allows longer steps",
            "m/s";
        heat_capacity: Option<f64> = Optional, Between(1e-3, 1e9),
            "C, specific heat capacity", "J/(kg K)";
        operators: Operators = Word(Operators::Renormalised.word()), Any,
            "gradient of the temperature and divergence of the entropy flux: exact for linear \
             fields, or the simple sums of the paper, with which second sound is too slow";
        viscosity: f64 = Number(0.0), AtLeast(0.0),
            "mu, the viscosity of the normal component (superfluid-dissipative)", "Pa s";
        diffusion: f64 = Number(0.0), AtLeast(0.0),
            "beta of the entropy's diffusion, beta/rho times the Laplacian of T \
             (superfluid-dissipative)", "W/(m K²)";
        mutual_friction: f64 = Number(0.0), AtLeast(0.0),
            "A of Gorter and Mellink, whose force between the components is A rho_s rho_n \
             |v_n - v_s|² (v_n - v_s) per volume; that of helium is about 600 at 1.65 K \
             (superfluid-dissipative)", "m s/kg";
        separation: Option<f64> = Optional, Above(0.0),
            "how far the two copies of the counterflow may come apart before the run ends", "m/s";
        walls: WallPressure = Word(WallPressure::Push.word()), Any,
            "what walls do where the liquid beside them is stretched: nothing, as where a surface \
             comes and goes, or pull, as in a closed vessel";
        surface: Option<f64> = Optional, Any,
            "height, against gravity, below which the liquid begins with the pressure of what is \
             above it; absent: no pressure at first", "m";
        heater: Option<Heater> = Optional, Any, "a source of heat (superfluid-dissipative)";
        superleak: Option<Superleak> = Optional, Any,
            "a porous plate that holds the normal component (superfluid-dissipative)";
    }
}

keys! {
    /// A source of heat at a point, spread by the kernel.
    #[derive(Copy)]
    Heater of SUPERFLUID, table Other "`[superfluid.heater]`" {
        place: Vector3 = Required, Any, "the point", "m";
        power: f64 = Required, AtLeast(0.0), "what it gives, in the plane to each metre of depth",
            "W";
        radius: f64 = Required, Above(0.0), "how far around the point it is felt", "m";
    }
}

keys! {
    /// A plate along the axes that lets the superfluid component alone pass.
    #[derive(Copy)]
    Superleak of SUPERFLUID, table Other "`[superfluid.superleak]`" {
        centre: Vector3 = Required, Any, "middle of the plate", "m";
        half: Vector3 = Required, AtLeast(0.0), "half of its lengths along each axis", "m";
        radius: f64 = Required, Above(0.0), "how far from the plate it is felt", "m";
        time: f64 = Number(1e-6), Above(0.0), "the time in which it holds the normal component",
            "s";
    }
}

words! {
    /// What walls do where the liquid beside them is stretched.
    WallPressure {
        /// Nothing.
        Push = "push",
        /// They pull.
        PushAndPull = "push and pull",
    }
}

words! {
    /// Tabulated helium.
    HeliumAt {
        /// 1.65 K.
        K165 = "1.65 K",
        /// 1.9 K.
        K190 = "1.9 K",
    }
}

words! {
    /// Which gradient and divergence are taken.
    Operators {
        /// Exact for linear fields.
        Renormalised = "renormalised",
        /// Simple sums.
        Paper = "paper",
    }
}

impl Superfluid {
    /// The constitutive laws.
    #[must_use]
    pub fn helium(&self) -> core::Helium {
        let set = match self.helium {
            HeliumAt::K165 => core::Helium::AT_1_65_K,
            HeliumAt::K190 => core::Helium::AT_1_90_K,
        };
        core::Helium {
            temperature: self.temperature.unwrap_or(set.temperature),
            reference_density: self.reference_density.unwrap_or(set.reference_density),
            entropy: self.entropy.unwrap_or(set.entropy),
            normal_fraction: self.normal_fraction.unwrap_or(set.normal_fraction),
            fraction_slope: self.fraction_slope.unwrap_or(set.fraction_slope),
            sound_speed: self.sound_speed.unwrap_or(set.sound_speed),
            heat_capacity: self.heat_capacity.unwrap_or(set.heat_capacity),
        }
    }

    /// The operators as the core has them.
    #[must_use]
    pub fn operators(&self) -> core::Operators {
        match self.operators {
            Operators::Renormalised => core::Operators::Renormalised,
            Operators::Paper => core::Operators::Paper,
        }
    }
}

/// The first counterflow v - v_s of a region.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Counterflow {
    /// The same everywhere, m/s.
    Uniform(Vector3),
    /// A sum of ten plane waves with random directions, phases and wave vectors: of each component
    /// of the latter a whole number from -3 to 3 times π/length.
    Random {
        /// Root mean square, about, m/s.
        speed: f64,
        /// m.
        length: f64,
        /// Which of them.
        seed: u64,
    },
}

/// The first entropy of a region.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FirstEntropy {
    /// The same everywhere, J/(kg K).
    Uniform(f64),
    /// A standing wave: s = s0 (1 + amplitude sin(πx/length) sin(πy/length)), and sin(πz/length) in
    /// space. (Kincl, Schmoranzer & Pavelka, Phys. Fluids 35 (2023) 047124, eq. (26).)
    Wave {
        /// Of s0.
        amplitude: f64,
        /// m.
        length: f64,
    },
}

impl FirstEntropy {
    /// (s - s0)/s0 at `x`, where `entropy` is s0.
    #[must_use]
    pub fn excess_at(&self, x: Vector3, axes: usize, entropy: f64) -> f64 {
        match self {
            Self::Uniform(s) => (s - entropy) / entropy,
            Self::Wave { amplitude, length } => x[..axes]
                .iter()
                .fold(*amplitude, |wave, x| wave * libm::sin(PI * x / length)),
        }
    }
}

impl FirstEntropy {
    /// The least and the greatest s - s0, J/(kg K), where `entropy` is s0.
    pub(super) fn extremes(&self, entropy: f64) -> [f64; 2] {
        match self {
            Self::Uniform(s) => [s - entropy; 2],
            Self::Wave { amplitude, .. } => {
                let swing = amplitude.abs() * entropy;
                [-swing, swing]
            }
        }
    }
}

/// Plane waves of a random counterflow.
const WAVES: usize = 10;

/// A plane wave: its amplitude, wave vector and phase.
struct PlaneWave {
    amplitude: Vector3,
    vector: Vector3,
    phase: f64,
}

impl Counterflow {
    /// The counterflow at these places, m/s.
    #[must_use]
    pub fn at_all(&self, places: &[Vector3], axes: usize) -> Vec<Vector3> {
        let (speed, length, seed) = match *self {
            Self::Uniform(u) => return vec![u; places.len()],
            Self::Random {
                speed,
                length,
                seed,
            } => (speed, length, seed),
        };
        let mut random = SplitMix64::new(seed);
        let waves: Vec<PlaneWave> = (0..WAVES)
            .map(|_| plane_wave(&mut random, speed, length, axes))
            .collect();
        let sum = |x: &Vector3| {
            waves.iter().fold([0.0; 3], |u: Vector3, wave| {
                let k = wave.vector;
                let angle = k[0] * x[0] + k[1] * x[1] + k[2] * x[2] + wave.phase;
                let c = libm::cos(angle);
                std::array::from_fn(|d| u[d] + c * wave.amplitude[d])
            })
        };
        places.iter().map(sum).collect()
    }
}

fn plane_wave(random: &mut SplitMix64, speed: f64, length: f64, axes: usize) -> PlaneWave {
    let mut vector = [0.0; 3];
    for k in &mut vector[..axes] {
        *k = (3.5 * random.signed()).round() * PI / length;
    }
    let phase = PI * random.signed();
    // A point within the ball has a direction, and a length that is not 0.
    let direction: Vector3 = if axes == 2 {
        let [x, y] = random.in_ball::<2>();
        [x, y, 0.0]
    } else {
        random.in_ball::<3>()
    };
    let size = direction.iter().fold(0.0, |sum, x| sum + x * x).sqrt();
    // The mean square of a cosine is 1/2, and each wave is strong by 1/2 to 3/2.
    let strength = speed * (2.0 / WAVES as f64).sqrt() * (1.0 + 0.5 * random.signed());
    PlaneWave {
        amplitude: direction.map(|x| strength * x / size),
        vector,
        phase,
    }
}
