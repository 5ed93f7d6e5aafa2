//! Lattices: how many particles a shape holds, where they lie, and that none is there twice.

use loschmidt_runner::scene::{InitialState, Scene, SceneError, Source, load};
use proptest::prelude::*;

fn read(text: &str) -> Scene {
    let source = Source::Text {
        name: "shape.toml".to_owned(),
        text: text.to_owned(),
    };
    load(&source, &[]).unwrap_or_else(|error| panic!("{error}"))
}

fn with_regions(spacing: f64, dimension: u32, regions: &str) -> Scene {
    read(&format!(
        "particle_spacing = {spacing:?}\nturnaround = 1.0\ndimension = {dimension}\nwall_model = \"dummy\"\nfluid.sound_speed = 10.0\n{regions}"
    ))
}

fn fluid(spacing: f64, shape: &str) -> InitialState {
    with_regions(
        spacing,
        2,
        &format!("[[region]]\nkind = \"fluid\"\nshape = {shape}\n"),
    )
    .initial_state()
    .unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn shapes_that_share_a_face_share_no_particle_and_leave_no_gap() {
    let spacing = 0.02;
    let whole = fluid(spacing, "{ rectangle = { min = [0, 0], max = [1, 1] } }");
    let halves = [
        (
            "{ rectangle = { min = [0, 0], max = [0.37, 1] } }",
            "{ rectangle = { min = [0.37, 0], max = [1, 1] } }",
        ),
        (
            "{ polygon = { points = [[0, 0], [1, 0], [0.31, 1], [0, 1]] } }",
            "{ polygon = { points = [[1, 0], [1, 1], [0.31, 1]] } }",
        ),
        (
            "{ circle = { centre = [0.5, 0.5], radius = 0.3 } }",
            "{ difference = [{ rectangle = { min = [0, 0], max = [1, 1] } }, { circle = { centre = [0.5, 0.5], radius = 0.3 } }] }",
        ),
        (
            "{ circle = { centre = [0.5, 0.5], radius = 0.3 } }",
            "{ union = [{ annulus = { centre = [0.5, 0.5], inner = 0.3, outer = 0.4 } }, { difference = [{ rectangle = { min = [0, 0], max = [1, 1] } }, { circle = { centre = [0.5, 0.5], radius = 0.4 } }] }] }",
        ),
    ];
    let frame = "{ rectangle = { min = [0, 0], max = [1, 1] } }";
    for (a, b) in halves {
        // What is left of the whole without a shape lies on the lattice of the whole.
        let without = |shape: &str| {
            let rest = format!("{{ difference = [{frame}, {shape}] }}");
            fluid(spacing, &rest).fluid.len()
        };
        let sum = 2 * whole.fluid.len() - without(a) - without(b);
        assert_eq!(sum, whole.fluid.len(), "{a} and {b} overlap or leave a gap");

        let gap = format!("shape.difference = [{frame}, {a}, {b}]");
        let scene = with_regions(
            spacing,
            2,
            &format!("[[region]]\nkind = \"fluid\"\n{gap}\n"),
        );
        let outcome = scene.initial_state();
        assert!(
            matches!(outcome, Err(SceneError::EmptyRegion { .. })),
            "{a} and {b} leave a gap"
        );
    }
}

#[test]
fn a_drop_on_the_lattice_is_symmetric_about_its_centre() {
    let state = fluid(0.02, "{ circle = { centre = [0, 0], radius = 0.5 } }");
    let count = |test: fn(&[f64; 3]) -> bool| state.fluid.iter().filter(|p| test(p)).count();
    assert_eq!(count(|p| p[0] < 0.0), count(|p| p[0] > 0.0));
    assert_eq!(count(|p| p[1] < 0.0), count(|p| p[1] > 0.0));
    assert_eq!(count(|p| p[0] < p[1]), count(|p| p[0] > p[1]));
}

#[test]
fn a_hexagonal_lattice_has_six_nearest_neighbours_and_the_area_of_the_square_one() {
    let state = with_regions(
        0.02,
        2,
        "[[region]]\nkind = \"fluid\"\nlattice = \"hexagonal\"\nshape.rectangle = { min = [0, 0], max = [2, 2] }\n",
    )
    .initial_state()
    .expect("a state");
    let count = state.fluid.len() as f64;
    assert!((count / 10_000.0 - 1.0).abs() < 0.02, "{count}");
    let middle = state.fluid[state.fluid.len() / 2 + 20];
    let nearest = 0.02 * (2.0 / 3.0_f64.sqrt()).sqrt();
    let distances = state.fluid.iter().map(|p| {
        let (x, y) = (p[0] - middle[0], p[1] - middle[1]);
        (x * x + y * y).sqrt()
    });
    let neighbours = distances.filter(|d| (d / nearest - 1.0).abs() < 1e-9);
    assert_eq!(neighbours.count(), 6);
}

#[test]
fn walls_continue_the_lattice_of_the_first_fluid_region() {
    for lattice in ["square", "hexagonal"] {
        let state = with_regions(
            0.1,
            2,
            &format!(
                "[[region]]\nkind = \"wall\"\nshape.layer = {{ around = {{ rectangle = {{ min = [0.5, 0.2], max = [3.0, 2.0] }} }}, depth = 1.5 }}\n[[region]]\nkind = \"fluid\"\nlattice = \"{lattice}\"\nshape.rectangle = {{ min = [0.52, 0.2], max = [1.5, 1.0] }}\n"
            ),
        )
        .initial_state()
        .expect("a state");
        // Every wall particle lies a whole number of pitches from particle 0 of the fluid.
        let origin = state.fluid[0];
        let row = state.fluid.iter().find(|p| p[1] > origin[1]).expect("rows")[1] - origin[1];
        let pitch = state.fluid[1][0] - origin[0];
        for p in &state.wall {
            let rows = (p[1] - origin[1]) / row;
            let shift = if lattice == "hexagonal" && rows.round() as i64 % 2 != 0 {
                0.5
            } else {
                0.0
            };
            let columns = (p[0] - origin[0]) / pitch - shift;
            assert!((rows - rows.round()).abs() < 1e-9, "{lattice}: {p:?}");
            assert!((columns - columns.round()).abs() < 1e-9, "{lattice}: {p:?}");
        }
        assert!(!state.wall.is_empty());
    }
}

#[test]
fn overlapping_regions_are_refused_even_when_their_lattices_differ_by_rounding() {
    let scene = with_regions(
        0.02,
        2,
        "[[region]]\nkind = \"fluid\"\nshape.rectangle = { min = [0, 0], max = [1, 1] }\n[[region]]\nkind = \"fluid\"\nshape.rectangle = { min = [0.7, 0.1], max = [1.7, 0.9] }\n",
    );
    match scene.initial_state() {
        Err(SceneError::Overlap {
            regions,
            point,
            apart,
            ..
        }) => {
            assert_eq!((regions[0].0, regions[1].0), (0, 1));
            assert!(apart.is_some_and(|apart| apart < 1e-6));
            assert_eq!(point.len(), 2);
            assert!((point[0] - 0.71).abs() < 1e-9 && (point[1] - 0.11).abs() < 1e-9);
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn regions_that_overlap_are_refused_wherever_their_nodes_lie_unless_that_is_meant() {
    let two = |a: &str, b: &str| {
        format!(
            "[[region]]\nkind = \"fluid\"\nshape = {a}\n[[region]]\nkind = \"fluid\"\nshape = {b}\n"
        )
    };
    let square = "{ rectangle = { min = [0, 0], max = [1, 1] } }";
    let half_off = two(
        square,
        "{ rectangle = { min = [0.55, 0.55], max = [1.5, 1.5] } }",
    );
    let near = |result| match result {
        Err(SceneError::Overlap { apart, .. }) => apart,
        other => panic!("{other:?}"),
    };
    // Nodes in the middle of four others.
    let apart = near(with_regions(0.1, 2, &half_off).initial_state()).expect("near");
    assert!((apart - 0.5_f64.sqrt()).abs() < 1e-6, "{apart}");
    // Fluid half a spacing within a wall, whose rows lie at half spacings too.
    let box_of = "{ layer = { around.rectangle = { min = [0, 0], max = [3, 1] }, depth = 2.5 } }";
    let wall = format!(
        "[[region]]\nkind = \"fluid\"\nshape = {square}\n\
         [[region]]\nkind = \"fluid\"\nshape.rectangle = {{ min = [1.05, -0.05], max = [2, 1] }}\n\
         [[region]]\nkind = \"wall\"\nshape = {box_of}\n"
    );
    let apart = near(with_regions(0.1, 2, &wall).initial_state()).expect("near");
    assert!(
        (apart - 0.5).abs() < 1e-6 || (apart - 0.5_f64.sqrt()).abs() < 1e-6,
        "{apart}"
    );
    // In space the middle of eight nodes is farther from each than a wall may be, and inside.
    let cube = "{ box = { min = [0, 0, 0], max = [1, 1, 1] } }";
    let small = two(
        cube,
        "{ box = { min = [0.45, 0.45, 0.45], max = [0.55, 0.55, 0.55] } }",
    );
    assert_eq!(near(with_regions(0.1, 3, &small).initial_state()), None);
    // Touching is not overlapping, and the key allows what is meant.
    let beside = two(square, "{ rectangle = { min = [1, 0], max = [2, 1] } }");
    let count = |result: Result<InitialState, _>| result.expect("a state").fluid.len();
    assert_eq!(count(with_regions(0.1, 2, &beside).initial_state()), 200);
    let allowed = format!("overlap = \"allow\"\n{half_off}");
    assert_eq!(
        count(with_regions(0.1, 2, &allowed).initial_state()),
        100 + 81
    );
}

#[test]
fn what_a_region_fills_is_compared_with_its_shape() {
    let filled = |shape: &str| {
        let text = format!("[[region]]\nkind = \"fluid\"\nshape = {shape}\n");
        with_regions(0.1, 2, &text).filled()
    };
    let square = filled("{ rectangle = { min = [0, 0], max = [0.95, 0.95] } }");
    assert!((square[0].particles - 0.81).abs() < 1e-9);
    assert!((square[0].shape / 0.9025 - 1.0).abs() < 1e-6);
    assert!((square[0].excess() + 0.102_493).abs() < 1e-5);
    let circle = filled("{ circle = { centre = [0, 0], radius = 1 } }");
    assert!((circle[0].shape / std::f64::consts::PI - 1.0).abs() < 1e-3);
    let flat = filled("{ rectangle = { min = [0, 0], max = [3, 0.1] } }");
    assert!((flat[0].excess()).abs() < 1e-3);
    let layer =
        filled("{ layer = { around.rectangle = { min = [0, 0], max = [1, 1] }, depth = 2 } }");
    assert!(layer.is_empty());
}

#[test]
fn a_scene_too_large_for_its_numbers_is_refused_at_once() {
    let huge = with_regions(
        1e-6,
        2,
        "[[region]]\nkind = \"fluid\"\nshape.rectangle = { min = [0, 0], max = [0.9, 0.9] }\n",
    );
    let (fluid, _) = huge.estimated_particles();
    assert!((fluid as f64 / 0.81e12 - 1.0).abs() < 0.01, "{fluid}");
    assert!(matches!(
        huge.initial_state(),
        Err(SceneError::TooManyParticles { .. })
    ));
}

#[test]
fn a_wall_at_the_end_of_the_numbers_is_estimated_and_refused() {
    for x in ["1e30", "-1e300"] {
        let scene = with_regions(
            0.1,
            2,
            &format!(
                "[[region]]\nkind = \"fluid\"\nshape.circle = {{ centre = [0, 0], radius = 1 }}\n[[region]]\nkind = \"wall\"\nshape.layer = {{ around = {{ circle = {{ centre = [{x}, 0], radius = 1 }} }}, depth = 2.5 }}\n"
            ),
        );
        assert_eq!(scene.estimated_particles().0, 316);
        let outcome = scene.initial_state();
        assert!(matches!(outcome, Err(SceneError::TooFar { region: 1, .. })));
    }
}

#[test]
fn a_shape_scattered_over_too_many_nodes_is_refused_at_once() {
    let drop = |x: &str| format!("{{ circle = {{ centre = [{x}, {x}], radius = 1 }} }}");
    let union = format!("[{}, {}]", drop("-50000"), drop("50000"));
    let scene = with_regions(
        0.1,
        2,
        &format!("[[region]]\nkind = \"fluid\"\nshape.union = {union}\n"),
    );
    let outcome = scene.initial_state();
    assert!(matches!(
        outcome,
        Err(SceneError::TooSparse { region: 0, .. })
    ));
}

#[test]
fn a_box_in_space_is_walled_on_every_side() {
    let state = with_regions(
        0.1,
        3,
        "[[region]]\nkind = \"fluid\"\nshape.box = { min = [0, 0, 0], max = [0.5, 0.4, 0.3] }\n[[region]]\nkind = \"wall\"\nshape.layer = { around = { box = { min = [0, 0, 0], max = [0.5, 0.4, 0.3] } }, depth = 0.5 }\n",
    )
    .initial_state()
    .expect("a state");
    assert_eq!(state.fluid.len(), 5 * 4 * 3);
    assert_eq!(state.wall.len(), 2 * (5 * 4 + 4 * 3 + 5 * 3));
}

/// The smallest distance between two of the points, and the largest from a point to its nearest.
fn distances(points: &[[f64; 3]]) -> (f64, f64) {
    let nearest = points.iter().enumerate().map(|(i, a)| {
        let others = points.iter().enumerate().filter(|(j, _)| *j != i);
        let square = others.map(|(_, b)| (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>());
        square.fold(f64::INFINITY, f64::min).sqrt()
    });
    nearest.fold((f64::INFINITY, 0.0), |(low, high), d| {
        (low.min(d), high.max(d))
    })
}

fn fluid_on(lattice: &str, dimension: u32, spacing: f64, shape: &str) -> InitialState {
    let region =
        format!("[[region]]\nkind = \"fluid\"\nlattice = \"{lattice}\"\nshape = {shape}\n");
    let scene = with_regions(spacing, dimension, &region);
    scene
        .initial_state()
        .unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn a_spiral_fills_a_disc_evenly_from_its_middle() {
    let state = fluid_on(
        "vogel",
        2,
        0.05,
        "{ circle = { centre = [3, -1], radius = 1 } }",
    );
    let area = std::f64::consts::PI / 0.0025;
    assert!((state.fluid.len() as f64 - area).abs() <= 1.0);
    // Node n lies at the radius whose disc holds n + 1/2 particles; x^2 + y^2 = r^2 whatever the
    // angle.
    for (n, x) in state.fluid.iter().enumerate() {
        let r2 = (x[0] - 3.0).powi(2) + (x[1] + 1.0).powi(2);
        let expected = 0.0025 * (n as f64 + 0.5) / std::f64::consts::PI;
        assert!((r2 - expected).abs() < 1e-12, "{n}");
    }
    let (nearest, farthest) = distances(&state.fluid);
    assert!(nearest > 0.75 * 0.05, "{nearest}");
    assert!(farthest < 1.1 * 0.05, "{farthest}");
}

#[test]
fn a_body_centred_lattice_has_eight_neighbours_in_an_edge_of_the_cube_root_of_two() {
    let edge = 0.1 * 2f64.cbrt();
    let side = 5.0 * edge;
    let shape = format!("{{ box = {{ min = [0, 0, 0], max = [{side:?}, {side:?}, {side:?}] }} }}");
    let state = fluid_on("body-centred", 3, 0.1, &shape);
    assert_eq!(state.fluid.len(), 2 * 5 * 5 * 5);
    let (nearest, farthest) = distances(&state.fluid);
    let expected = 0.75f64.sqrt() * edge;
    assert!((nearest - expected).abs() < 1e-12);
    assert!((farthest - expected).abs() < 1e-12);
    let middle = state
        .fluid
        .iter()
        .find(|x| x.iter().all(|x| (x - 2.25 * edge).abs() < 1e-9));
    let middle = middle.expect("a node in the middle");
    let near = |x: &&[f64; 3]| {
        (0..3).map(|k| (x[k] - middle[k]).powi(2)).sum::<f64>() < 1.1 * expected * expected
    };
    assert_eq!(state.fluid.iter().filter(near).count(), 1 + 8);
}

#[test]
fn a_layer_wraps_a_spiral_and_a_body_centred_lattice() {
    let ring = with_regions(
        0.05,
        2,
        "[[region]]\nkind = \"fluid\"\nlattice = \"vogel\"\nshape.rectangle = { min = [-1, -1], max = [1, 1] }\n[[region]]\nkind = \"wall\"\nshape.layer = { around.rectangle = { min = [-1, -1], max = [1, 1] }, depth = 2.5 }\n",
    )
    .initial_state()
    .expect("a state");
    // The spiral goes on through the wall: together they fill the larger square but for its rim.
    let outside = |x: &[f64; 3]| x[0].abs().max(x[1].abs());
    assert!(
        ring.wall
            .iter()
            .all(|x| (0.999..1.16).contains(&outside(x)))
    );
    let filled = ring.wall.iter().filter(|x| outside(x) < 1.1).count() as f64;
    let area = (2.2 * 2.2 - 4.0) / 0.0025;
    assert!((filled / area - 1.0).abs() < 0.05, "{filled} {area}");
    let (nearest, _) = distances(&[ring.fluid, ring.wall].concat());
    assert!(nearest > 0.75 * 0.05);

    let edge = 0.1 * 2f64.cbrt();
    let side = 4.0 * edge;
    let shape = format!("{{ min = [0, 0, 0], max = [{side:?}, {side:?}, {side:?}] }}");
    let boxed = with_regions(
        0.1,
        3,
        &format!("[[region]]\nkind = \"fluid\"\nlattice = \"body-centred\"\nshape.box = {shape}\n[[region]]\nkind = \"wall\"\nshape.layer = {{ around.box = {shape}, depth = 1.5 }}\n"),
    )
    .initial_state()
    .expect("a state");
    let faces = boxed.wall.iter().filter(|x| {
        let out = x.iter().filter(|x| **x < 0.0 || **x > side);
        out.count() == 1
    });
    // Reached within 2 spacings of an inner node: a node at depth d is reached across a face where
    // d plus a quarter of an edge is no farther.
    assert!(faces.count() >= 6 * 2 * 4 * 4);
}

#[test]
fn gresho_and_kepler_have_their_speeds_and_turn_counter_clockwise() {
    let at = |velocity: &str| {
        let region = format!(
            "[[region]]\nkind = \"fluid\"\nlattice = \"vogel\"\nshape.circle = {{ centre = [1, 2], radius = 0.6 }}\nvelocity = {velocity}\n"
        );
        with_regions(0.02, 2, &region)
            .initial_state()
            .expect("a state")
    };
    let check = |state: InitialState, speed: &dyn Fn(f64) -> f64| {
        for (x, v) in state.fluid.iter().zip(&state.fluid_velocity) {
            let d = [x[0] - 1.0, x[1] - 2.0];
            let r = d[0].hypot(d[1]);
            assert!((v[0].hypot(v[1]) - speed(r)).abs() < 1e-12, "{r}");
            assert!((v[0] * d[0] + v[1] * d[1]).abs() < 1e-12);
            assert!(d[0] * v[1] - d[1] * v[0] >= 0.0);
        }
    };
    check(at("{ gresho = 1.0, centre = [1, 2] }"), &|r| match r {
        r if r < 0.2 => 5.0 * r,
        r if r < 0.4 => 2.0 - 5.0 * r,
        _ => 0.0,
    });
    check(at("{ kepler = 2.0, centre = [1, 2] }"), &|r| {
        (2.0 / r).sqrt()
    });
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn a_rectangle_of_whole_spacings_holds_exactly_their_product(
        columns in 1..60_usize,
        rows in 1..60_usize,
        left in -30..30_i32,
        spacing in prop_oneof![Just(0.02), Just(0.005), Just(0.04), Just(0.1), 1e-3..1.0_f64],
    ) {
        let left = f64::from(left) * 0.1;
        let right = left + columns as f64 * spacing;
        let top = rows as f64 * spacing;
        let shape = format!("{{ rectangle = {{ min = [{left:?}, 0.0], max = [{right:?}, {top:?}] }} }}");
        prop_assert_eq!(fluid(spacing, &shape).fluid.len(), columns * rows);
    }

    #[test]
    fn the_number_of_particles_is_the_area_up_to_the_rim(
        a in 0.2..1.0_f64,
        b in 0.2..1.0_f64,
        x in -1.0..1.0_f64,
        spacing in 0.01..0.03_f64,
    ) {
        let shape = format!("{{ ellipse = {{ centre = [{x:?}, 0.3], axes = [{a:?}, {b:?}] }} }}");
        let count = fluid(spacing, &shape).fluid.len() as f64;
        let area = std::f64::consts::PI * a * b / (spacing * spacing);
        let rim = 8.0 * a.max(b) / spacing;
        prop_assert!((count - area).abs() < rim, "{} {}", count, area);
    }

    #[test]
    fn the_estimate_is_the_count_of_a_small_scene(
        radius in 0.2..1.0_f64,
        depth in 0.5..3.0_f64,
        spacing in 0.03..0.1_f64,
    ) {
        let scene = with_regions(spacing, 2, &format!(
            "[[region]]\nkind = \"fluid\"\nshape.circle = {{ centre = [0, 0], radius = {radius:?} }}\n[[region]]\nkind = \"wall\"\nshape.layer = {{ around = {{ circle = {{ centre = [0, 0], radius = {radius:?} }} }}, depth = {depth:?} }}\n"
        ));
        let state = scene.initial_state().expect("a state");
        let counts = (state.fluid.len() as u64, state.wall.len() as u64);
        prop_assert_eq!(scene.estimated_particles(), counts);
    }
}

/// Asked one by one, twenty thousand discs took minutes.
#[test]
fn a_union_of_very_many_shapes_is_filled() {
    let disc = |n: usize| {
        let (x, y) = (0.5 * (n % 200) as f64, 0.5 * (n / 200) as f64);
        format!("{{ circle = {{ centre = [{x:?}, {y:?}], radius = 0.2 }} }}")
    };
    let union = |count: usize| {
        let discs: Vec<String> = (0..count).map(disc).collect();
        fluid(0.1, &format!("{{ union = [{}] }}", discs.join(", ")))
    };
    assert_eq!(union(20_000).fluid.len(), 20_000 * union(1).fluid.len());
}

#[test]
fn fields_of_a_first_velocity_are_added() {
    let with = |velocity: &str| {
        let shape = "shape.circle = { centre = [0.5, 0], radius = 0.5 }";
        let region = format!("[[region]]\nkind = \"fluid\"\n{shape}\nvelocity = {velocity}\n");
        let state = with_regions(0.1, 2, &region).initial_state();
        state.unwrap_or_else(|error| panic!("{error}"))
    };
    let turn = with("{ rotation = 2.0, centre = [0.5, 0] }");
    let strain = with("{ linear = [[1, 0], [0, -1]], offset = [0.25, 0] }");
    let all = with(
        "{ linear = [[1, 0], [0, -1]], offset = [0.25, 0], uniform = [0, 3], rotation = 2.0, \
         centre = [0.5, 0] }",
    );
    let parts = turn.fluid_velocity.iter().zip(&strain.fluid_velocity);
    for (all, (turn, strain)) in all.fluid_velocity.iter().zip(parts) {
        for (k, uniform) in [0.0, 3.0].into_iter().enumerate() {
            assert_eq!(all[k], uniform + turn[k] + strain[k]);
        }
    }
}
