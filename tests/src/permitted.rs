//! Every error that a test permits, with its reason. Whatever is promised exactly is compared
//! exactly and has no line here.

/// ∫ W dV - 1 by Simpson's rule on 2000 intervals: a polynomial of degree 7 leaves 1e-13, the sum
/// of 2000 doubles as much again.
pub const KERNEL_INTEGRAL: f64 = 1e-12;

/// (W'/r) h²/α against a central difference of W over 2e-5 h: truncation (1e-5)² times the third
/// derivative (up to 120), and rounding 1e-16/1e-5 divided by r/h >= 0.05.
pub const KERNEL_DERIVATIVE: f64 = 1e-7;

/// Sum of the coefficients of a table, in units of the time step: the rounding of at most six.
pub const COEFFICIENT_SUM: f64 = 4.0 * f64::EPSILON;

/// Deviation of a measured order of accuracy from its name: the next term of the error, relative
/// to the leading one, at steps of 1/40 to 1/320 of the time scale of the orbit.
pub const ORDER: f64 = 0.15;

/// Angular momentum over N speed x length quanta per step: half a quantum in the position and, for
/// each neighbour, half a quantum in each velocity component, times a lever arm. Relative to
/// Σ m |x||v| it is below this for a few hundred steps.
pub const ANGULAR_MOMENTUM: f64 = 1e-10;

/// A force against a central difference of the energy over 2^-19 m, relative to the largest
/// component: truncation (2e-6 m / 0.2 m)² ~ 1e-10, rounding of densities (2^-40 kg/m³) 1e-9, the
/// velocity quantum over dt 1e-9; ten times the sum.
pub const FORCE: f64 = 1e-7;

/// dε/dx against p/x² by a central difference over 2e-5, relative to 1: truncation 1e-10 times a
/// third derivative (up to 1e2), rounding 1e-16/1e-5.
pub const STATE_EQUATION: f64 = 1e-7;

/// Entropy of quantiles of the Maxwellian in 100 bins minus the equilibrium formula: Δv²/T terms
/// of the midpoint rule, and bins of the tail with one or no particle.
pub const ENTROPY: f64 = 0.02;

/// kT/m recovered from the histogram of such quantiles, relative: Δv²/12T of the bins, 1/N.
pub const TEMPERATURE: f64 = 0.01;

/// The same with one particle in a hundred far too fast: the histogram lies 1 % lower, and the fit
/// makes up for some of it.
pub const TEMPERATURE_WITH_OUTLIERS: f64 = 0.05;

/// Σ f_k Δv - 1: the rounding of a hundred terms.
pub const HISTOGRAM_SUM: f64 = 100.0 * f64::EPSILON;

/// The equilibrium formulas against Simpson's rule on 4000 intervals up to 12 thermal speeds.
pub const ENTROPY_INTEGRAL: f64 = 1e-6;

/// Fixed against floating point after one step from rest, in quanta: half a quantum for each of up
/// to 60 terms of velocity and density, and what the density's error does to the pressure.
pub const ONE_STEP_QUANTA: f64 = 64.0;

/// How far the ratio of two differences between the schemes, at steps of which one is half the
/// other, lies from 2: the terms of second order.
pub const FIRST_ORDER_RATIO: f64 = 0.2;

/// Angular momentum of the rotating drop over 3000 steps, relative: half a quantum in each of some
/// 30 pair terms, positions and velocities, per particle and step, adds up to 1e-12.
pub const ANGULAR_MOMENTUM_OF_A_RUN: f64 = 1e-8;

/// Least factor by which the energy error of the dam break falls with a fourth of the time step: 16
/// for a scheme of second order, less what two chaotic flows differ in.
pub const ENERGY_FALL_WITH_VERLET: f64 = 9.0;

/// The same for half the time step with dummy walls: 4, less the same.
pub const ENERGY_FALL_WITH_DUMMIES: f64 = 3.0;

/// Relative density summed in another order: a hundred terms.
pub const DENSITY_SUM: f64 = 100.0 * f64::EPSILON;

/// Least order at which the last Newton steps of the initial state correction converge, as the
/// ratio of the logarithms of two errors: 2, less what the factor before the square takes.
pub const NEWTON_ORDER: f64 = 1.3;

/// Relative density of a corrected state in the simulation: 1e-10 of the correction, and what
/// positions rounded to 2^-46 and terms rounded to 2^-40 add.
pub const CORRECTED_DENSITY: f64 = 1e-9;

/// A filtered velocity against the average in doubles, m/s: the quanta (2^-44) of up to a hundred
/// rounded terms over a γ of at least 0.2, and the push of one step of 1e-15 s.
pub const SHEPARD_AVERAGE: f64 = 1e-10;

/// Work of the forces of a solid against the fall of its energy over 1e-4 spacings there and back,
/// without the cubic term, relative: truncation (1e-4)⁴ times a fifth derivative, and rounding 1e-16
/// of the energy over the 1e-4 of it that is released, in sums of a few hundred terms.
pub const FORCE_OF_A_SOLID: f64 = 1e-8;

/// The ratio of the errors of a lift by M and by M/2, which is 8 at third order: the next term,
/// at |M| of 0.1.
pub const ORDER_OF_A_LIFT: f64 = 0.4;

/// |G - 1| of a body that has turned 1000 rad by steps of 0.01 rad: bounded by about a third of the
/// square of the angle.
pub const STRAIN_OF_A_ROTATION: f64 = 5e-5;

/// The determinant after 30,000 lifts in words of 48 bits: half a quantum each, as a random walk.
pub const DETERMINANT: f64 = 1e-11;

/// e^x from its series against the library's, relative: sixteen times the rounding of one series.
pub const EXPONENTIAL: f64 = 5e-15;

/// Energy error of the beryllium plate at a tenth of its thickness over one period, of its kinetic
/// energy at the start: the paper has 5e-6 at a fortieth.
pub const ENERGY_OF_THE_PLATE: f64 = 5e-6;

/// How far the paper's integrator ends from home after a tenth of a period there and back, m: some
/// thousand roundings of 2^-48 in distortions, a billionth of a spacing.
pub const RETURN_OF_THE_MIDPOINT: f64 = 1e-10;

/// Energy errors of the two integrators of solids, relative to each other: both are of second
/// order, and differ in terms that the plate hardly feels.
pub const INTEGRATORS_OF_A_SOLID: f64 = 0.05;

/// What all kinds of energy of a superfluid gain in ten steps of 5e-10 s, of what one of them
/// does: rounding of velocities to 2^-41 m/s where a step changes them by 1e-6 m/s, and the next
/// order of the scheme. A term that is missing in a law costs 1e-3.
pub const ENERGY_OF_SHORT_STEPS: f64 = 1e-5;

/// The order of accuracy, from two halvings of the time step: the next terms of the error.
pub const ORDER_OF_A_SUPERFLUID: f64 = 0.25;

/// Temperatures against differences of energies over 1e-3 J/(kg K), K: rounding 1e-16 of 10 J/kg
/// over the difference, and a third derivative.
pub const TEMPERATURE_OF_HELIUM: f64 = 1e-9;

/// Newton's cube root against the library's, relative: the roundings of a division and of a sum.
pub const CUBE_ROOT: f64 = 4e-16;

/// Speeds of second sound over that of the theory, beside those of another program that reads its
/// amplitude in another way.
pub const SECOND_SOUND: f64 = 0.005;

/// Energy error of a period of second sound at N = 25 with 20 steps for a smoothing length over
/// first sound, of the energy of the wave: another program found 3.7e-9.
pub const ENERGY_OF_SECOND_SOUND: f64 = 1e-8;

/// Energy error of helium with friction over the heat that was made: that of the reversible part
/// between two frictions, at a fiftieth of the usual step.
pub const ENERGY_OF_FRICTION: f64 = 1e-5;

/// Decay of waves of forty spacings over that of the continuum: on a square lattice with a support of
/// six spacings another program found 0.97 and 0.993.
pub const DECAY: f64 = 0.04;
