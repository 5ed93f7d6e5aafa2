//! The keys of regions, velocities and shapes. Their values are read by hand (see
//! [`regions`](super::regions)), since several of them exclude each other. A shape holds shapes, so
//! the rules of these tables refer to each other.

use super::schema::Range::{Above, AboveUpTo, AtLeast, Between};
use super::schema::ValueType::{
    Choice, Flag, Matrix, Number, Rotation, Table, Tables, Text, Vector, Whole,
};
use super::schema::{Form, SceneKey, TableRules, ValueType, key};
use super::solid::{self, ElasticEnergy};
use super::superfluid;
use super::words::Dimension::{Three, Two};
use super::words::{LatticeKind, RegionKind};

/// The key of the top level that holds the regions.
pub(super) const REGIONS: SceneKey = key("region", Tables(&REGION))
    .required()
    .means("what is filled with particles, in the order of their ids");

pub(super) static REGION: TableRules = TableRules {
    title: "`[[region]]`",
    form: Form::Other,
    keys: &[
        key("kind", Choice(RegionKind::WORDS))
            .required()
            .means("particles that move or particles that stay"),
        key("body", Text)
            .of(solid::FAMILY)
            .means("name of the body; regions of one name are one body; absent: a body of its own"),
        key("material", Table(&MATERIAL))
            .of(solid::FAMILY)
            .means("in what the body differs from the table `[solid]`"),
        key("held", Flag)
            .of(solid::FAMILY)
            .means("whether the particles are held in their places, a clamp"),
        key("lattice", Choice(LatticeKind::WORDS)).means(
            "arrangement of fluid particles; a wall continues that of the first fluid region",
        ),
        key("shape", Table(&SHAPE))
            .required()
            .means("what is filled"),
        key("velocity", Table(&VELOCITY)).means(
            "first velocity of the fluid, or how a wall of a viscous one or of helium moves; \
             several fields are added; absent: at rest",
        ),
        key("counterflow", Table(&COUNTERFLOW))
            .of(superfluid::FAMILY)
            .means("first counterflow, v - v_s; absent: none"),
        key("entropy", Table(&ENTROPY))
            .of(superfluid::FAMILY)
            .means("first entropy; absent: that of the reference temperature"),
        key("smooth", Flag)
            .of(superfluid::FAMILY)
            .means("whether the normal component slides along the wall without friction"),
        key("conduction", Number)
            .unit("W/(m K²)")
            .of(superfluid::FAMILY)
            .within(AtLeast(0.0))
            .means("beta between the liquid and a wall that stays at T0; absent: no heat passes"),
    ],
};

pub(super) static MATERIAL: TableRules = TableRules {
    title: "a `material`",
    form: Form::Other,
    keys: &[
        key("bulk_speed", Number)
            .unit("m/s")
            .of(solid::FAMILY)
            .within(Above(0.0))
            .means("c_0 of this body"),
        key("shear_speed", Number)
            .unit("m/s")
            .of(solid::FAMILY)
            .within(Above(0.0))
            .means("c_s of this body"),
        key("penalty", Number)
            .of(solid::FAMILY)
            .within(AtLeast(0.0))
            .means("c_p/c_0 of this body"),
        key("energy", Choice(ElasticEnergy::WORDS))
            .of(solid::FAMILY)
            .means("energy of shear of this body"),
    ],
};

pub(super) static COUNTERFLOW: TableRules = TableRules {
    title: "a `counterflow`",
    form: Form::Other,
    keys: &[
        key("uniform", Vector)
            .unit("m/s")
            .of(superfluid::FAMILY)
            .means("the same everywhere"),
        key("random", Number)
            .unit("m/s")
            .of(superfluid::FAMILY)
            .within(AtLeast(0.0))
            .means("about the root mean square of ten random plane waves"),
        key("length", Number)
            .unit("m")
            .of(superfluid::FAMILY)
            .within(Above(0.0))
            .means("L of their wave vectors, (-3 … 3) pi/L along each axis"),
        key("seed", Whole)
            .of(superfluid::FAMILY)
            .within(Between(0.0, 1e9))
            .or(1.0)
            .means("which waves of all that are random"),
    ],
};

pub(super) static ENTROPY: TableRules = TableRules {
    title: "an `entropy`",
    form: Form::Other,
    keys: &[
        key("uniform", Number)
            .unit("J/(kg K)")
            .of(superfluid::FAMILY)
            .within(Above(0.0))
            .means("the same everywhere"),
        key("wave", Number)
            .of(superfluid::FAMILY)
            .within(Between(-0.5, 0.5))
            .means("amplitude A of s = s0 (1 + A sin(pi x/L) sin(pi y/L)), in space with z too"),
        key("length", Number)
            .unit("m")
            .of(superfluid::FAMILY)
            .within(Above(0.0))
            .means("L of the wave"),
    ],
};

pub(super) static VELOCITY: TableRules = TableRules {
    title: "a `velocity`",
    form: Form::Other,
    keys: &[
        key("uniform", Vector)
            .unit("m/s")
            .means("the same velocity everywhere"),
        key("rotation", Rotation)
            .unit("rad/s")
            .means("angular velocity of a rigid rotation, counter-clockwise"),
        key("centre", Vector)
            .unit("m")
            .means("the middle of a rotation or vortex; absent: the origin"),
        key("gresho", Number).unit("m/s").only(Two).means(
            "peak speed of Gresho's vortex: u = peak r/radius, falling to zero at twice the radius",
        ),
        key("radius", Number)
            .unit("m")
            .within(Above(0.0))
            .or(0.2)
            .only(Two)
            .means("radius at which Gresho's vortex is fastest"),
        key("kepler", Number)
            .unit("m³/s²")
            .within(AtLeast(0.0))
            .only(Two)
            .means("circular orbits around the centre: u = sqrt(strength/r)"),
        key("bending", Number)
            .unit("m/s")
            .of(solid::FAMILY)
            .only(Two)
            .means("peak of u_y = peak (a1 (sinh s + sin s) - a2 (cosh s + cos s))"),
        key("wave_number", Number)
            .unit("1/m")
            .of(solid::FAMILY)
            .only(Two)
            .means("alpha of s = alpha (x - start)"),
        key("a1", Number)
            .of(solid::FAMILY)
            .only(Two)
            .means("a1, the weight of sinh s + sin s"),
        key("a2", Number)
            .of(solid::FAMILY)
            .only(Two)
            .means("a2, the weight of cosh s + cos s"),
        key("start", Number)
            .unit("m")
            .of(solid::FAMILY)
            .or(0.0)
            .only(Two)
            .means("where s is zero"),
        key("twist", Number)
            .unit("rad/s")
            .of(solid::FAMILY)
            .only(Three)
            .means("largest angular velocity of u = twist sin(pi z/(2 height)) (y, -x, 0)"),
        key("height", Number)
            .unit("m")
            .of(solid::FAMILY)
            .within(Above(0.0))
            .only(Three)
            .means("height at which the column turns fastest"),
        key("linear", Matrix)
            .unit("1/s")
            .means("matrix A of u = A x + b, row by row"),
        key("offset", Vector)
            .unit("m/s")
            .means("vector b of u = A x + b; absent: zero"),
    ],
};

pub(super) static SHAPE: TableRules = TableRules {
    title: "a shape",
    form: Form::Other,
    keys: &[
        key("rectangle", Table(&BLOCK))
            .only(Two)
            .means("rectangle along the axes"),
        key("box", Table(&BLOCK))
            .only(Three)
            .means("box along the axes"),
        key("circle", Table(&BALL)).only(Two).means("disc"),
        key("sphere", Table(&BALL)).only(Three).means("ball"),
        key("ellipse", Table(&ELLIPSOID))
            .only(Two)
            .means("ellipse along the axes"),
        key("ellipsoid", Table(&ELLIPSOID))
            .only(Three)
            .means("ellipsoid along the axes"),
        key("annulus", Table(&SHELL))
            .only(Two)
            .means("disc with a round hole"),
        key("shell", Table(&SHELL))
            .only(Three)
            .means("ball with a round hole"),
        key("polygon", Table(&POLYGON))
            .only(Two)
            .means("polygon by its corners, even-odd rule"),
        key("union", Tables(&SHAPE)).means("in any of these shapes"),
        key("difference", Tables(&SHAPE)).means("in the first shape and in none of the others"),
        key("intersection", Tables(&SHAPE)).means("in every one of these shapes"),
        key("layer", Table(&LAYER)).means("the lattice continued outside a shape"),
    ],
};

pub(super) static BLOCK: TableRules = TableRules {
    title: "a `rectangle` or `box`",
    form: Form::UnderKey,
    keys: &[
        key("min", Vector)
            .unit("m")
            .required()
            .means("lower corner, included"),
        key("max", Vector)
            .unit("m")
            .required()
            .means("upper corner, excluded"),
    ],
};

pub(super) static BALL: TableRules = TableRules {
    title: "a `circle` or `sphere`",
    form: Form::UnderKey,
    keys: &[
        key("centre", Vector)
            .unit("m")
            .required()
            .means("the point in the middle"),
        key("radius", Number)
            .unit("m")
            .within(Above(0.0))
            .required()
            .means("distance of the edge from the centre"),
    ],
};

pub(super) static ELLIPSOID: TableRules = TableRules {
    title: "an `ellipse` or `ellipsoid`",
    form: Form::UnderKey,
    keys: &[
        key("centre", Vector)
            .unit("m")
            .required()
            .means("the point in the middle"),
        key("axes", Vector)
            .unit("m")
            .within(Above(0.0))
            .required()
            .means("semi-axes"),
    ],
};

pub(super) static SHELL: TableRules = TableRules {
    title: "an `annulus` or `shell`",
    form: Form::UnderKey,
    keys: &[
        key("centre", Vector)
            .unit("m")
            .required()
            .means("the point in the middle"),
        key("inner", Number)
            .unit("m")
            .within(AtLeast(0.0))
            .required()
            .means("radius of the hole"),
        key("outer", Number)
            .unit("m")
            .within(Above(0.0))
            .required()
            .means("outer radius"),
    ],
};

pub(super) static POLYGON: TableRules = TableRules {
    title: "a `polygon`",
    form: Form::UnderKey,
    keys: &[key("points", ValueType::Corners)
        .unit("m")
        .required()
        .means("corners [x, y] in order")],
};

pub(super) static LAYER: TableRules = TableRules {
    title: "a `layer`",
    form: Form::UnderKey,
    keys: &[
        key("around", Table(&SHAPE))
            .required()
            .means("the shape that is wrapped"),
        key("depth", Number)
            .unit("particle spacings")
            .within(AboveUpTo(0.0, 10.0))
            .required()
            .means("how far out the layer reaches; 2.5 gives three rows"),
    ],
};
