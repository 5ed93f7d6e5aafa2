//! The states that are measured: dam breaks in the plane and in space, the same on every machine.
//!
//! Near a lattice the distances of neighbours repeat, and the processor predicts which of them are
//! within reach; that flatters the plain traversal. In the *disordered* states every particle is
//! moved by up to 0.3 spacings along each axis. All move on at a speed at which the fastest
//! particle of the paper's dam break crosses a spacing in as many steps (40), so that the
//! neighbours have to be found as often as there.

use loschmidt_runner::fast::Backend;
use loschmidt_runner::scene::{InitialState, Scene, Source, load};
use loschmidt_runner::{ExecutorKind, Options, Player};
use std::num::NonZeroUsize;

/// A scene of the catalogue at some spacing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Size {
    pub scene: &'static str,
    /// Particle spacing, m.
    pub spacing: &'static str,
    /// What to call it.
    pub name: &'static str,
}

impl std::fmt::Display for Size {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name)
    }
}

const fn size(scene: &'static str, spacing: &'static str, name: &'static str) -> Size {
    Size {
        scene,
        spacing,
        name,
    }
}

/// From a thousand to more than a million particles.
pub const SIZES: [Size; 8] = [
    size("dam-break", "0.045", "2D 1k"),
    size("dam-break", "0.02", "2D 5k"),
    size("dam-break", "0.01", "2D 20k"),
    size("dam-break", "0.005", "2D 80k"),
    size("dam-break", "0.0025", "2D 320k"),
    size("dam-break", "0.00125", "2D 1.28M"),
    size("dam-break-3d", "0.025", "3D 16k"),
    size("dam-break-3d", "0.0136", "3D 100k"),
];

/// The scene with its particles.
pub fn state(size: Size, disordered: bool) -> (Scene, InitialState) {
    let source = Source::Catalogue(size.scene.to_owned());
    // A quarter of the usual time step: what is moved together by force flies apart faster.
    let set = [
        format!("particle_spacing={}", size.spacing),
        "cfl=0.05".to_owned(),
    ];
    let scene = load(&source, &set).expect("a scene of the catalogue");
    let mut initial = scene.initial_state().expect("particles");
    // SplitMix64 (Steele, Lea & Flood, OOPSLA 2014).
    let mut state = 0u64;
    let mut signed = || {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    };
    let speed = scene.particle_spacing / (40.0 * scene.time_step());
    for (x, v) in initial.fluid.iter_mut().zip(&mut initial.fluid_velocity) {
        if disordered {
            for x in x.iter_mut().take(scene.dimension.axes()) {
                *x += 0.3 * scene.particle_spacing * signed();
            }
        }
        v[0] = speed;
    }
    (scene, initial)
}

/// Ready to run.
pub fn player(state: &(Scene, InitialState), options: Options) -> Player {
    let (scene, initial) = state.clone();
    Player::new(scene, initial, options).expect("a simulation")
}

pub fn options(executor: ExecutorKind, threads: usize, backend: Backend) -> Options {
    Options {
        executor,
        backend,
        threads: NonZeroUsize::new(threads).expect("a thread"),
        ..Options::default()
    }
}
