//! A model of one's own: a Lennard-Jones gas, released from half of its box and called back.
//!
//! u(r) = 4ε((σ/r)¹² - (σ/r)⁶) - the same at r_c, for r < r_c = 2.5 σ, and 0 beyond; within 0.6 σ,
//! where no particle comes, a parabola. Walls are atoms that stand still. The experiment is that of
//! J. Orban and A. Bellemans (Phys. Lett. A 24 (1967) 620), in integers as by D. Levesque and L.
//! Verlet (J. Stat. Phys. 72 (1993) 519): all velocities are reversed, and the gas goes back into
//! its half.
//!
//! ```text
//! cargo run --release -p loschmidt-examples --example lennard_jones -- /tmp/gas
//! ```

use loschmidt_core::prelude::*;
use loschmidt_runner::own::{Build, OwnModel, register};
use loschmidt_runner::scene::{Source, load};
use loschmidt_runner::{Options, Run, setup, simulate};
use loschmidt_viewer::movie::{Movie, MovieStyle, Stored};
use std::{error::Error, path::Path, sync::atomic::AtomicBool};

/// Two streams in half a box of 40 x 40 σ, 512 atoms of mass 1; lengths in σ, energies in ε.
pub const SCENE: &str = r#"
model = "lennard-jones"
particle_spacing = 1.25
support = 2.0                  # r_c = 2.5
cfl = 0.02                     # dt = 0.005
wall_model = "dummy"           # walls are atoms like the others
turnaround = 10.0
fluid = { reference_density = 0.64, sound_speed = 10.0 }
output = { rows = 200, frames = 20 }
[[region]]
kind = "fluid"
velocity.uniform = [1.2, 0.9]
shape.rectangle = { min = [0.0, 0.0], max = [20.0, 20.0] }
[[region]]
kind = "fluid"
velocity.uniform = [1.0, -1.1]
shape.rectangle = { min = [0.0, 20.0], max = [20.0, 40.0] }
[[region]]
kind = "wall"
shape.layer = { around.rectangle = { min = [0.0, 0.0], max = [40.0, 40.0] }, depth = 2.5 }
"#;

/// The law of a pair. The force per mass is 24 (ε/m) (2 s¹² - s⁶)/r² x_ij, with s = σ/r.
struct Law {
    sigma_squared: f64,
    reach_squared: f64,
    /// 24 (ε/m) times the time of the kick, in length times speed quanta.
    factor: f64,
}

impl Law {
    /// r² without what is within 0.6 σ, s⁶ of it, and (2 s¹² - s⁶)/r².
    #[inline(always)]
    fn at<L: Lanes>(&self, r2: L) -> [L; 3] {
        let least = r2.splat(0.36 * self.sigma_squared);
        let r2 = least + (r2 - least).positive_part();
        let s2 = r2.splat(self.sigma_squared) / r2;
        let s6 = s2 * s2 * s2;
        [r2, s6, (s6 * (s6 + s6) - s6) / r2]
    }
}

/// The impulse of a pair.
struct Force(Law);

impl PairPass<2> for Force {
    type Read<T: Copy> = [T; 0];
    type Term<T: Copy> = [T; 2];
    const PARITY: [Parity; 2] = [Parity::Antisymmetric; 2];
    fn reach_squared(&self) -> f64 {
        self.0.reach_squared
    }
    fn bound(&self, _: &[f64; 0]) -> f64 {
        // The force is largest at 0.6 σ.
        let [r2, _, slope] = self.0.at(0.0);
        1.001 * self.0.factor * slope * r2.sqrt()
    }
    #[inline(always)]
    fn term<L: Lanes>(&self, x: &[L; 2], r2: L, _: &[L; 0], _: &[L; 0]) -> [L; 2] {
        let [_, _, slope] = self.0.at(r2);
        let within = slope.where_below(r2, r2.splat(self.0.reach_squared));
        let factor = r2.splat(self.0.factor) * within;
        [factor * x[0], factor * x[1]]
    }
}

/// The energy of a pair, in units of ε.
struct Potential(Law);

impl PairPass<2> for Potential {
    type Read<T: Copy> = [T; 0];
    type Term<T: Copy> = T;
    const PARITY: Parity = Parity::Symmetric;
    fn reach_squared(&self) -> f64 {
        self.0.reach_squared
    }
    fn term<L: Lanes>(&self, _: &[L; 2], r2: L, _: &[L; 0], _: &[L; 0]) -> L {
        let [soft, s6, slope] = self.0.at(r2);
        let [_, last, _] = self.0.at(r2.splat(self.0.reach_squared));
        let u = s6 * s6 - s6 - (last * last - last);
        r2.splat(4.0) * u + r2.splat(12.0) * slope * (soft - r2)
    }
}

/// The gas: r_c is the scene's support radius, and ε/m the square of a tenth of its sound speed.
struct LennardJones {
    settings: Settings<2>,
    reach: f64,
    epsilon_over_mass: f64,
}

impl LennardJones {
    fn new(p: Parameters<2>) -> Result<Self, SetupError> {
        Ok(Self {
            settings: p.settings([("support", p.support_radius); 2], 0.005 * p.sound_speed)?,
            reach: p.support_radius / p.scale.length_quantum(),
            epsilon_over_mass: 0.01 * p.sound_speed * p.sound_speed,
        })
    }
    fn law(&self, duration: f64) -> Law {
        let scale = self.settings.scale;
        let units = scale.length_quantum() * scale.speed_quantum();
        Law {
            sigma_squared: (self.reach / 2.5) * (self.reach / 2.5),
            reach_squared: self.reach * self.reach,
            factor: 24.0 * self.epsilon_over_mass * duration / units,
        }
    }
}

impl<A: Arithmetic> Model<A, 2> for LennardJones {
    const ENERGIES: &'static [&'static str] = &["kinetic", "pair", "wall"];

    fn settings(&self) -> &Settings<2> {
        &self.settings
    }
    fn prepare<E: Executor>(
        &self,
        stage: Stage,
        s: &mut System<'_, A, 2>,
        exec: &E,
    ) -> Result<(), Fault> {
        let Stage::Kick(c) = stage else { return Ok(()) };
        let force = Force(self.law(c * self.settings.time_step));
        s.locate(exec, true);
        exec.points(&NoImpulse, &mut s.particles)?;
        for from in [Side::Particles, Side::Walls] {
            s.sum(exec, &force, Sum::to_particles(from, &[], IMPULSE))?;
        }
        Ok(())
    }
    fn energies(&self, s: &System<'_, A, 2>) -> Result<[f64; MAX_ENERGIES], Fault> {
        let potential = Potential(self.law(1.0));
        let mut energies = [0.0; MAX_ENERGIES];
        for (energy, side, share) in [(1, Side::Particles, 0.5), (2, Side::Walls, 1.0)] {
            let sum = sum_over_pairs(s, &potential, side, 1, ExactSum::default())?;
            energies[energy] = share * self.settings.mass * self.epsilon_over_mass * sum.value();
        }
        Ok(energies)
    }
}

/// Makes the gas known to this program.
pub fn make_known() {
    let build: Build = |scene, initial, options| {
        let gas = LennardJones::new(setup::parameters(scene, initial))?;
        simulate::<Fixed, _, 2>(gas, initial, options)
    };
    register(OwnModel::new::<Fixed, LennardJones, 2>(
        "lennard-jones",
        build,
    ));
}

fn main() -> Result<(), Box<dyn Error>> {
    make_known();
    let (name, text) = ("lennard-jones.toml".to_owned(), SCENE.to_owned());
    let scene = load(&Source::Text { name, text }, &[])?;
    let out = std::env::args().nth(1);
    let out = out.unwrap_or_else(|| "runs/lennard-jones".to_owned());
    let (out, stop) = (Path::new(&out), AtomicBool::new(false));
    let mut run = Run::start(scene, Options::default(), Some((out, true)))?;
    let exact = run.execute(|_| {}, &stop)?.reversed_exactly;
    for row in run.rows().iter().step_by(20) {
        let (t, entropy, total) = (row.time_s, row.entropy, row.total);
        println!("t {t:5.2}  entropy {entropy:.4}  energy {total:.4}");
    }
    println!("returned to its first bit: {}", exact == Some(true));
    let run = Stored::open(out)?;
    let style = MovieStyle {
        pictures: 20,
        ..MovieStyle::default()
    };
    let mut movie = Movie::create(&out.join("movie"), true, style, "gas", &run.identity())?;
    movie.render(&run, |_| {}, &stop)?;
    println!("{} pictures in {}", movie.pictures().len(), out.display());
    Ok(())
}
