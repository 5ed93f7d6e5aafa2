//! What a scene's text, its overrides and its print mean.

use loschmidt_runner::scene::{
    CentralGravity, DensityCorrection, Dimension, Integrator, LatticeKind, Model, Scene,
    SceneError, Shape, Source, StepRule, Velocity, load,
};
use proptest::prelude::*;

fn try_read(text: &str, overrides: &[&str]) -> Result<Scene, SceneError> {
    let source = Source::Text {
        name: "drop.toml".to_owned(),
        text: text.to_owned(),
    };
    let overrides: Vec<String> = overrides.iter().map(|text| (*text).to_owned()).collect();
    load(&source, &overrides)
}

fn read(text: &str, overrides: &[&str]) -> Scene {
    try_read(text, overrides).unwrap_or_else(|error| panic!("{error}"))
}

const DROP: &str = r#"
particle_spacing = 0.1
turnaround = 1
[fluid]
sound_speed = 10
[[region]]
kind = "fluid"
shape.circle = { centre = [0, 0], radius = 0.5 }
"#;

#[test]
fn absent_keys_have_their_defaults_and_whole_numbers_are_numbers() {
    let scene = read(DROP, &[]);
    assert_eq!(scene.name, "drop", "the name of the file");
    assert_eq!(scene.dimension, Dimension::Two);
    assert_eq!(scene.step, StepRule::Cfl(0.2));
    assert_eq!(scene.support, 3.0);
    assert_eq!(scene.turnaround, Some(1.0));
    assert_eq!(scene.end_time(), 2.0);
    assert_eq!(scene.fluid.unwrap().reference_density, 1000.0);
    assert_eq!(scene.model, Model::Symplectic);
    assert_eq!(scene.integrator, Integrator::StormerVerlet);
    assert_eq!(scene.regions[0].lattice, Some(LatticeKind::Square));
}

#[test]
fn overrides_reach_every_key() {
    let scene = read(
        DROP,
        &[
            "fluid.sound_speed=60",
            "gravity.uniform=[0,-1.6]",
            "region.0.shape.circle.radius = 0.25",
            "region[0].shape.circle.centre[1]=3",
            "model=standard",
            "density_correction = \"none\"",
            "gravity.central={ centre = [0, 0], strength = 2 }",
            "name=other",
            "turnaround=",
            "end=4",
            "end=5",
        ],
    );
    assert_eq!(scene.fluid.unwrap().sound_speed, 60.0);
    assert_eq!(scene.gravity.uniform, [0.0, -1.6, 0.0]);
    assert_eq!(scene.model, Model::Standard);
    assert_eq!(scene.water.density_correction, DensityCorrection::None);
    assert_eq!(scene.name, "other");
    let centre = [0.0, 3.0, 0.0];
    assert_eq!(
        scene.regions[0].shape,
        Shape::Ball {
            centre,
            radius: 0.25
        }
    );
    let central = CentralGravity {
        centre: [0.0; 3],
        strength: 2.0,
        softening: 0.0,
    };
    assert_eq!(scene.gravity.central, Some(central));
    assert_eq!((scene.turnaround, scene.end), (None, Some(5.0)));
    assert_eq!(scene.steps_back(), 0);
}

#[test]
fn an_overriding_time_step_replaces_the_courant_number_of_the_file_and_back() {
    let with_cfl = format!("cfl = 0.1{DROP}");
    let step = read(&with_cfl, &["time_step=1e-3"]).step;
    assert_eq!(step, StepRule::Seconds(1e-3));
    let with_step = format!("time_step = 1e-3{DROP}");
    assert_eq!(read(&with_step, &["cfl=0.1"]).step, StepRule::Cfl(0.1));
    assert!(try_read(DROP, &["cfl=0.1", "time_step=1e-3"]).is_err());
}

#[test]
fn an_end_on_the_way_back_shortens_the_return_leg_alone() {
    let scene = read(DROP, &["time_step=0.01", "end=1.25"]);
    assert_eq!((scene.steps_out(), scene.steps_back()), (100, 25));
    let scene = read(DROP, &["time_step=0.01", "end=2"]);
    assert_eq!((scene.steps_out(), scene.steps_back()), (100, 100));
    assert!(try_read(DROP, &["end=1"]).is_err());
    assert!(try_read(DROP, &["end=2.0001"]).is_err());
}

#[test]
fn a_removed_key_has_its_default_again() {
    let scene = read(&format!("support = 2{DROP}"), &["support="]);
    assert_eq!(scene.support, 3.0);
    // Removing what is not there changes nothing.
    assert_eq!(read(DROP, &["support=", "wall.energy="]), read(DROP, &[]));
}

#[test]
fn the_print_names_every_key_with_unit_and_meaning() {
    let printed = read(DROP, &[]).to_toml();
    for line in [
        "particle_spacing = 0.1 ",
        "# time_step = 0.006",
        "# end = 2.0 ",
        "turnaround = 1.0 ",
        "# [wall]",
        "# energy = …",
        "# [gravity.central]",
        "# velocity.uniform = …",
        "shape.circle.radius = 0.5 ",
    ] {
        let found = printed.lines().any(|printed| printed.starts_with(line));
        assert!(found, "{line}\n{printed}");
    }
    assert!(printed.contains("# m; side of the square"), "{printed}");
    assert!(
        printed.contains("# \"symplectic\", \"standard\", \"filtered\", \"solid\", "),
        "{printed}"
    );
    for line in printed.lines().filter(|line| line.contains(" = ")) {
        assert!(line.contains("  # "), "no comment: {line}");
    }
    let first_table = printed.find('[').expect("a table");
    assert!(printed[..first_table].contains("wall_model = "));
}

/// Numbers with few and with many digits.
fn number() -> impl Strategy<Value = f64> {
    prop_oneof![
        (-400..400_i32).prop_map(|n| f64::from(n) / 100.0),
        -1e3..1e3_f64,
        (-1.0..1.0_f64).prop_map(|x| x * 1e-7),
    ]
}

fn positive() -> impl Strategy<Value = f64> {
    number().prop_map(|x| x.abs() + 1e-9)
}

fn point(axes: usize) -> impl Strategy<Value = [f64; 3]> {
    [number(), number(), number()].prop_map(move |p| if axes == 2 { [p[0], p[1], 0.0] } else { p })
}

fn extent(axes: usize) -> impl Strategy<Value = [f64; 3]> {
    [positive(), positive(), positive()]
        .prop_map(move |p| if axes == 2 { [p[0], p[1], 0.0] } else { p })
}

fn shape(axes: usize) -> impl Strategy<Value = Shape> {
    let polygon = prop::collection::vec([number(), number()], 3..6)
        .prop_map(|points| Shape::Polygon { points });
    let block = (point(axes), extent(axes))
        .prop_map(move |(min, size)| {
            let mut max = min;
            for k in 0..axes {
                max[k] = min[k] + 1.0 + size[k];
            }
            Shape::Block { min, max }
        })
        .boxed();
    let ball =
        (point(axes), positive()).prop_map(|(centre, radius)| Shape::Ball { centre, radius });
    let ellipsoid =
        (point(axes), extent(axes)).prop_map(|(centre, axes)| Shape::Ellipsoid { centre, axes });
    let shell = (point(axes), positive(), positive()).prop_map(|(centre, inner, more)| {
        let outer = inner + 0.1 + more;
        Shape::Shell {
            centre,
            inner,
            outer,
        }
    });
    let flat = if axes == 2 {
        polygon.boxed()
    } else {
        block.clone()
    };
    let leaf = prop_oneof![block, ball, ellipsoid, shell, flat];
    leaf.prop_recursive(3, 12, 3, |inner| {
        let several = || prop::collection::vec(inner.clone(), 1..4);
        prop_oneof![
            several().prop_map(Shape::Union),
            several().prop_map(Shape::Difference),
            several().prop_map(Shape::Intersection),
            (inner.clone(), 0.5..4.0_f64).prop_map(|(around, depth)| Shape::Layer {
                around: Box::new(around),
                depth
            }),
        ]
    })
}

fn velocity(axes: usize) -> impl Strategy<Value = Option<Velocity>> {
    let row = move || point(axes);
    let omega = point(3).prop_map(move |w| if axes == 2 { [0.0, 0.0, w[2]] } else { w });
    prop_oneof![
        Just(None),
        point(axes).prop_map(|u| Some(Velocity::Uniform(u))),
        (omega, point(axes)).prop_map(|(omega, centre)| Some(Velocity::Rotation { omega, centre })),
        (number(), positive(), point(axes)).prop_map(move |(peak, radius, centre)| match axes {
            2 => Some(Velocity::Gresho {
                peak,
                radius,
                centre,
            }),
            _ => None,
        }),
        (positive(), point(axes)).prop_map(move |(strength, centre)| match axes {
            2 => Some(Velocity::Kepler { strength, centre }),
            _ => None,
        }),
        ([row(), row(), row()], point(axes)).prop_map(move |(mut matrix, offset)| {
            if axes == 2 {
                matrix[2] = [0.0; 3];
            }
            Some(Velocity::Linear { matrix, offset })
        }),
    ]
}

/// No field, one, or two that are added.
fn velocities(axes: usize) -> impl Strategy<Value = Vec<Velocity>> {
    (velocity(axes), prop::option::of(point(axes))).prop_map(|(field, uniform)| match field {
        Some(Velocity::Uniform(_)) | None => field.into_iter().collect(),
        Some(other) => uniform
            .map(Velocity::Uniform)
            .into_iter()
            .chain([other])
            .collect(),
    })
}

fn any_scene() -> impl Strategy<Value = Scene> {
    let dimension = prop_oneof![Just(Dimension::Two), Just(Dimension::Three)];
    dimension.prop_flat_map(|dimension| {
        let axes = dimension.axes();
        let words = ".{0,12}";
        let step = prop_oneof![
            (0.01..2.0_f64).prop_map(StepRule::Cfl),
            (1e-6..1e-2_f64).prop_map(StepRule::Seconds)
        ];
        let fluid = (shape(axes), velocities(axes));
        (
            (words, words, step, point(axes)),
            prop::collection::vec(fluid, 1..4),
            prop::option::of((point(axes), number(), positive())),
            (1.5..6.0_f64, prop::bool::ANY),
        )
            .prop_map(move |(head, fluids, central, (support, one_way))| {
                let mut scene = read(DROP, &[]);
                (
                    scene.description,
                    scene.source,
                    scene.step,
                    scene.gravity.uniform,
                ) = head;
                scene.dimension = dimension;
                scene.support = support;
                scene.gravity.central =
                    central.map(|(centre, strength, softening)| CentralGravity {
                        centre,
                        strength,
                        softening,
                    });
                if one_way {
                    (scene.turnaround, scene.end) = (None, Some(3.5));
                }
                let region = scene.regions[0].clone();
                scene.regions = fluids
                    .into_iter()
                    .map(|(shape, velocity)| {
                        let mut region = region.clone();
                        region.lattice = Some(LatticeKind::natural(dimension));
                        (region.shape, region.velocity) = (shape, velocity);
                        region
                    })
                    .collect();
                scene
            })
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(128))]

    #[test]
    fn a_printed_scene_reads_back_as_the_same_scene(scene in any_scene()) {
        let printed = scene.to_toml();
        match try_read(&printed, &[]) {
            Ok(again) => prop_assert_eq!(again, scene),
            Err(error) => prop_assert!(false, "{}\n{}", error, printed),
        }
    }

    #[test]
    fn the_order_of_the_keys_means_nothing(order in Just(KEYS.to_vec()).prop_shuffle()) {
        let text: String = order.concat();
        let region = "[[region]]\nkind = \"fluid\"\nshape.circle = { centre = [0, 0], radius = 0.5 }\n";
        let shuffled = read(&format!("{text}{region}"), &[]);
        let sorted = read(&format!("{}{region}", KEYS.concat()), &[]);
        prop_assert_eq!(shuffled, sorted);
    }

    #[test]
    fn no_text_brings_the_reader_down(text in ".{0,60}", set in ".{0,20}") {
        // Only that it returns: every answer is a scene or an error.
        let _ = try_read(&text, &[]);
        let _ = try_read(DROP, &[set.as_str()]);
        let _ = try_read(DROP, &[format!("region.0.shape={text}").as_str()]);
    }
}

const KEYS: &[&str] = &[
    "particle_spacing = 0.1\n",
    "turnaround = 1.0\n",
    "support = 2.5\n",
    "cfl = 0.3\n",
    "integrator = \"suzuki\"\n",
    "fluid.sound_speed = 10\n",
    "fluid.reference_density = 900.0\n",
    "gravity.uniform = [0.0, -1.0]\n",
    "description = \"a drop\"\n",
];
