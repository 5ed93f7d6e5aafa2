//! Frames to write, and what a reader must find in their files.

use loschmidt_core::model::{Measure, Model};
use loschmidt_core::{Fixed, Symplectic};
use loschmidt_runner::frame::{Frame, FrameColumn};

/// Density and pressure.
pub const COLUMNS: &[Measure] = <Symplectic<Fixed, 2> as Model<Fixed, 2>>::COLUMNS;

/// Columns of these densities and pressures.
pub fn of_water(values: [Vec<f64>; 2]) -> Vec<FrameColumn> {
    let columns = COLUMNS.iter().zip(values);
    columns
        .map(|(&measure, values)| FrameColumn { measure, values })
        .collect()
}

/// Floats that are hard to write: signed zero, the extremes, neighbours of round numbers.
pub const AWKWARD: [f64; 12] = [
    -0.0,
    0.1,
    1.0 / 3.0,
    f64::MAX,
    -f64::MIN_POSITIVE,
    5e-324,
    1.0 + f64::EPSILON,
    9_007_199_254_740_993.0,
    1e23,
    -1e-7,
    2.225_073_858_507_201e-308,
    std::f64::consts::PI,
];

/// A frame of `fluid` and `wall` particles with numbers of every magnitude.
pub fn frame(dimension: usize, fluid: usize, wall: usize, index: u64) -> Frame {
    let mut state = index;
    let mut number = move || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        match state >> 60 {
            awkward @ 0..12 => AWKWARD[awkward as usize],
            exponent => ((state << 4) as i64 as f64) * 10f64.powi(exponent as i32 - 35),
        }
    };
    let mut vector = |_| match dimension {
        2 => [number(), number(), 0.0],
        _ => [number(), number(), number()],
    };
    let position = (0..fluid).map(&mut vector).collect();
    let velocity = (0..fluid).map(&mut vector).collect();
    let wall_position = (0..wall).map(&mut vector).collect();
    Frame {
        dimension,
        step: 1000 - 100 * index,
        time: 1.0 - 0.1 * index as f64,
        elapsed: 1.0 + 0.1 * index as f64,
        way_back: index > 0,
        particle_mass: 0.4,
        id: (0..fluid as u64).map(|i| 3 * i + 5).collect(),
        position,
        velocity,
        columns: of_water([(); 2].map(|()| (0..fluid).map(|_| number()).collect())),
        wall_position,
    }
}

/// 2D and 3D; with and without walls; without fluid; empty; larger than a piece of output.
pub fn frames() -> Vec<Frame> {
    [
        (2, 7, 4),
        (2, 5, 0),
        (3, 6, 5),
        (3, 1, 0),
        (3, 0, 2),
        (2, 0, 0),
        (3, 9_000, 500),
    ]
    .into_iter()
    .enumerate()
    .map(|(index, (dimension, fluid, wall))| frame(dimension, fluid, wall, index as u64))
    .collect()
}

pub fn bits<'a>(values: impl IntoIterator<Item = &'a f64>) -> Vec<u64> {
    values.into_iter().map(|value| value.to_bits()).collect()
}

/// Per particle, walls included: id, whether it is a wall, position, velocity, and the columns.
pub fn particles(frame: &Frame) -> Vec<(u64, bool, Vec<u64>)> {
    let fluid = (0..frame.id.len()).map(|i| {
        let columns = frame.columns.iter().map(|column| &column.values[i]);
        let values = frame.position[i].iter().chain(&frame.velocity[i]);
        (frame.id[i], false, bits(values.chain(columns)))
    });
    let after = frame.id.last().map_or(0, |last| last + 1);
    let wall = frame.wall_position.iter().enumerate().map(|(i, x)| {
        let mut rest = vec![0.0; 3];
        rest.resize(3 + frame.columns.len(), f64::NAN);
        (after + i as u64, true, bits(x.iter().chain(&rest)))
    });
    fluid.chain(wall).collect()
}
