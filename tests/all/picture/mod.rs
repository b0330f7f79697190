//! The picture: its dimensions, visible walls, and the duration of its moves.

mod edges;
mod names;

use touchpath::geom::Vec2;
use touchpath::job;
use touchpath::path::{Path, Surface};
use touchpath::view::camera::Camera;
use touchpath::view::dimension::{angles, dimensions};
use touchpath::view::material::outlines;
use touchpath::view::scene::top_faces::{Face, together};
use touchpath::view::scene::{Line, Projection, Scene, Stroke};
use touchpath::view::walls::WallShape;

use crate::common::{jobs, number_at, planned, with};
use touchpath::form::Value;

fn built(job: &Value, view: Projection) -> (Scene, Path) {
    let planned = job::planned(job).expect("the job is sound");
    (planned.picture(view, 1.0, None).scene, planned.path)
}

/// A cycle at its defaults.
fn of(cycle: &str) -> Value {
    crate::common::job(&format!(
        "{{\"format\":1,\"cycle\":{{\"type\":\"{cycle}\"}}}}"
    ))
}

/// Every job of the tests in mm, with its cycle's name; jobs in inch are converted.
fn metric() -> impl Iterator<Item = (String, Value)> {
    jobs()
        .into_iter()
        .filter(|(_, job)| !matches!(job.get("units"), Some(Value::Text(units)) if units == "inch"))
}

/// For a hole in G17: each field, and the views among top, front and side that show it.
#[test]
fn a_turn_is_seen_from_the_top_and_a_height_from_aside() {
    let planned = job::planned(&of("hole")).expect("the job is sound");
    for (field, seen) in [
        ("cycle.rotation", [true, false, false]),
        ("cycle.startAngle", [true, false, false]),
        ("cycle.diameter", [true, true, false]),
        ("cycle.topClearance", [false, true, true]),
        ("cycle.feedDistance", [false, true, true]),
        ("cycle.origin[0]", [true, true, false]),
        ("cycle.origin[1]", [true, false, true]),
        ("cycle.origin[2]", [false, true, true]),
        ("cycle.origin", [false; 3]),
        ("cycle.origin[3]", [false; 3]),
        ("cycle.subCode", [false; 3]),
        ("cycle.clearanceHeight", [false; 3]),
        ("feeds.work", [false; 3]),
        ("", [false; 3]),
    ] {
        assert_eq!(
            [Projection::Top, Projection::Front, Projection::Side]
                .map(|view| planned.shows(field, view)),
            seen,
            "{field}"
        );
    }
}

#[test]
fn a_dimension_is_as_long_as_its_field_says_and_its_line_stands_square_to_it() {
    let mut seen = 0;
    for (name, job) in metric() {
        let planned = job::planned(&job).expect("the job is sound");
        for d in planned
            .picture(Projection::Front, 1.0, None)
            .scene
            .dimensions
        {
            let has = |key: &str| planned.job.def.fields.iter().any(|field| field.key == key);
            assert!(
                d.field.strip_prefix("cycle.").is_some_and(has),
                "{name}: there is no field {}",
                d.field
            );
        }
        let path = planned.path;
        for d in dimensions(&path) {
            let said = number_at(&job, d.field, f64::NAN);
            let long = d.from.distance(d.to);
            assert!(
                (long - said).abs() < 1e-9 || said.is_nan(),
                "{name}: {} is {long} mm long, the field says {said}",
                d.field
            );
            assert!(
                (d.aside.length() - 1.0).abs() < 1e-9 && d.aside.dot(d.to - d.from).abs() < 1e-9,
                "{name}: {}",
                d.field
            );
            seen += usize::from(!said.is_nan());
        }
    }
    assert!(seen > 40, "{seen}");
}

/// As wide as its field, and between the walls that are touched.
#[test]
fn an_angle_is_as_wide_as_its_field_says() {
    let mut seen = 0;
    for (name, job) in jobs() {
        let path = job::planned(&job).expect("the job is sound").path;
        for angle in angles(&path) {
            let said = number_at(&job, angle.field, 90.0);
            let wide = angle.sides[0].angle_between(angle.sides[1]).to_degrees();
            assert!(
                (wide - said).abs() < 1e-6,
                "{name}: {} is {wide}°, the field says {said}",
                angle.field
            );
            if angle.field == "cycle.angle" {
                for (wall, side) in angle.sides.iter().enumerate() {
                    let touch = path
                        .touches
                        .iter()
                        .find(|touch| touch.group == wall)
                        .expect("each wall is touched");
                    let across = (touch.point - angle.at).dot(touch.vector);
                    assert!(
                        side.dot(touch.vector).abs() < 1e-9 && across.abs() < 1e-9,
                        "{name}: wall {wall}"
                    );
                    assert!(
                        (touch.point - angle.at).dot(*side) > 0.0,
                        "{name}: its touches lie along side {wall}"
                    );
                }
            }
            seen += 1;
        }
    }
    assert!(seen > 8, "{seen}");
    let still = with(
        &of("hole"),
        "cycle.feedDistance",
        crate::common::number(0.0),
    );
    assert!(
        dimensions(&built(&still, Projection::Front).1)
            .iter()
            .all(|d| d.field != "cycle.feedDistance"),
        "0 has no line"
    );
    let drawn = |job: &Value, view| {
        built(job, view)
            .0
            .angles
            .iter()
            .map(|a| (a.field, a.turns))
            .collect::<Vec<_>>()
    };
    let corner = of("double-wall-internal-corner");
    let [(field, [first, turn])] = drawn(&corner, Projection::Top)[..] else {
        panic!("one angle")
    };
    assert_eq!(field, "cycle.angle");
    // Wall 1 points up in the picture, wall 2 to the right: clockwise.
    assert!(
        (first.to_degrees() - 90.0).abs() < 1e-9 && (turn.to_degrees() + 90.0).abs() < 1e-9,
        "{first} {turn}"
    );
    assert!(
        drawn(&corner, Projection::Front).is_empty()
            && drawn(&corner, Projection::Isometric).is_empty()
    );
    let slope = with(
        &of("surface"),
        "cycle.elevation",
        crate::common::number(30.0),
    );
    assert!(drawn(&slope, Projection::Top).is_empty());
    assert!((drawn(&slope, Projection::Front)[0].1[1].to_degrees() - 30.0).abs() < 1e-9);
    let svg = job::svg(&corner, Projection::Top).expect("the job has a plan");
    assert!(svg.contains(&said("Corner angle", "90°")), "{svg}");
}

/// The ends of a width are at its touches: the picture measures like the probe.
#[test]
fn the_ends_of_a_width_lie_in_the_walls_that_are_touched() {
    let mut seen = 0;
    for (name, job) in metric() {
        let path = job::planned(&job).expect("the job is sound").path;
        for d in dimensions(&path)
            .iter()
            .filter(|d| ["cycle.width", "cycle.width1", "cycle.diameter"].contains(&d.field))
        {
            let along = (d.to - d.from).normalize();
            let spans: Vec<f64> = path
                .touches
                .iter()
                .map(|t| (t.point - d.from).dot(along))
                .collect();
            let (low, high) = spans
                .iter()
                .fold((f64::MAX, f64::MIN), |(l, h), x| (l.min(*x), h.max(*x)));
            // Touches of a circle may differ from its first direction; then they are inside.
            let exact = d.field != "cycle.diameter";
            assert!(
                low > -1e-6 && high < d.from.distance(d.to) + 1e-6,
                "{name}: {} {low} {high}",
                d.field
            );
            if exact {
                assert!(
                    low.abs() < 1e-6 && (high - d.from.distance(d.to)).abs() < 1e-6,
                    "{name}: {} {low} {high}",
                    d.field
                );
            }
            seen += 1;
        }
    }
    assert!(seen > 10, "{seen}");
}

#[test]
fn a_view_shows_only_dimensions_in_their_true_length() {
    let job = of("internal-rectangle-protected");
    let fields = |view| {
        built(&job, view)
            .0
            .dimensions
            .iter()
            .map(|d| d.field)
            .collect::<Vec<_>>()
    };
    assert_eq!(
        fields(Projection::Top),
        [
            "cycle.width1",
            "cycle.width2",
            "cycle.sideClearance1",
            "cycle.sideClearance2"
        ]
    );
    let upright = |width, clearance| {
        [
            width,
            "cycle.depth",
            clearance,
            "cycle.topClearance",
            "cycle.feedDistance",
        ]
    };
    assert_eq!(
        fields(Projection::Front),
        upright("cycle.width1", "cycle.sideClearance1")
    );
    assert_eq!(
        fields(Projection::Side),
        upright("cycle.width2", "cycle.sideClearance2")
    );
    // As in an isometric drawing: along the part, with the true value.
    assert_eq!(
        fields(Projection::Isometric),
        ["cycle.width1", "cycle.width2", "cycle.depth"]
    );
    let isometric = built(&job, Projection::Isometric).0;
    assert_eq!(
        isometric
            .dimensions
            .iter()
            .map(|d| d.length)
            .collect::<Vec<_>>(),
        [80.0, 50.0, 10.0]
    );
    let turned = with(&job, "cycle.rotation", crate::common::number(30.0));
    let front: Vec<_> = built(&turned, Projection::Front)
        .0
        .dimensions
        .iter()
        .map(|d| d.field)
        .collect();
    assert_eq!(
        front,
        ["cycle.depth", "cycle.topClearance", "cycle.feedDistance"],
        "a turned width is foreshortened from the front"
    );
}

/// The far half of a hole's wall faces the viewer, and the near one is transparent and hides nothing. A boss is fully visible: the near half, and its top.
#[test]
fn a_hole_is_not_a_boss() {
    let seen = |cycle: &str| {
        let (scene, _) = built(&of(cycle), Projection::Isometric);
        let walls: Vec<_> = walls(&scene)
            .into_iter()
            .map(|w| (w.faces, w.corners[0][1]))
            .collect();
        let middle = |faces: bool| {
            let of: Vec<f64> = walls.iter().filter(|w| w.0 == faces).map(|w| w.1).collect();
            (of.len(), of.iter().sum::<f64>() / of.len() as f64)
        };
        let first_veil = walls.iter().position(|w| !w.0).unwrap_or(walls.len());
        assert!(
            walls[first_veil..].iter().all(|w| !w.0),
            "veils hide nothing that is solid"
        );
        (middle(true), middle(false), scene.tops)
    };
    let (far, near, tops) = seen("hole");
    // Higher in the picture is farther.
    assert!(far.0 > 20 && near.0 > 20 && far.1 > near.1 && tops.is_empty());
    let (near, far, tops) = seen("boss");
    assert!(near.0 > 20 && far.0 == 0);
    // The top is 40 wide: foreshortened to sin(atan(1/√2)) = 1/√3 of a circle's area.
    let circle = std::f64::consts::PI * 20.0 * 20.0 / 3f64.sqrt();
    assert!(
        (area(&tops[0].corners) - circle).abs() < 0.005 * circle,
        "{}",
        area(&tops[0].corners)
    );
}

/// Touches on the far side of a boss were drawn on top of it. A stud hides those behind it; those in front of it, and all in a hole, are visible.
#[test]
fn what_is_behind_the_part_is_drawn_before_it() {
    let behind = |cycle: &str| {
        let (scene, _) = built(&of(cycle), Projection::Isometric);
        let behind: Vec<usize> = (0..scene.touches.len())
            .filter(|k| scene.touches[*k].behind.is_some())
            .map(|k| k + 1)
            .collect();
        for (k, touch) in scene.touches.iter().enumerate() {
            let of = |line: &&Line| Some(line.index) == touch.index;
            assert!(
                scene
                    .lines
                    .iter()
                    .filter(of)
                    .all(|line| line.occluder == touch.behind),
                "{cycle}: touch {}",
                k + 1
            );
        }
        // Each once, before the faces that hide it.
        let faces = scene.faces(false);
        let begins = faces
            .iter()
            .filter(|face| matches!(face, Face::Behind(_)))
            .count();
        assert_eq!(begins, scene.tops.len(), "{cycle}");
        let first = faces
            .iter()
            .position(|face| matches!(face, Face::Behind(_)));
        let hides = |face: &Face<'_>| {
            matches!(
                face,
                Face::Wall(WallShape { top: Some(_), .. }) | Face::Top(_)
            )
        };
        assert!(
            faces[..first.unwrap_or(0)].iter().all(|face| !hides(face)),
            "{cycle}"
        );
        behind
    };
    for (cycle, expected) in [
        ("boss", &[2, 3][..]),
        ("external-rectangle", &[2, 3]),
        ("web", &[2]),
        ("web-three-points", &[1]),
        ("double-wall-external-corner", &[1, 2]),
        ("triple-wall-external-corner", &[1]),
        ("hole", &[]),
        ("internal-rectangle", &[]),
        ("double-wall-internal-corner", &[]),
        ("surface", &[]),
    ] {
        assert_eq!(behind(cycle), expected, "{cycle}");
    }
    // From other views nothing is hidden: walls are seen edge-on, and the material is cut.
    assert!(
        built(&of("boss"), Projection::Front)
            .0
            .touches
            .iter()
            .all(|touch| touch.behind.is_none())
    );
}

/// The strips of a round wall are drawn in one path, without seams between them.
#[test]
fn a_round_wall_is_drawn_in_few_strokes() {
    for (cycle, most) in [("boss", 3), ("hole", 2), ("probing-two-circles", 4)] {
        let (scene, _) = built(&of(cycle), Projection::Isometric);
        let faces = scene.faces(false);
        assert!(
            faces.len() > 60 && faces.chunk_by(together).count() <= most,
            "{cycle}: {}",
            faces.chunk_by(together).count()
        );
    }
}

/// An outside corner was hatched only along its walls: the white area between them looked like air.
#[test]
fn a_corner_from_outside_is_solid_between_its_walls_and_one_from_inside_stands_on_its_floor() {
    let filled = |cycle: &str, view, at: [f64; 2]| {
        let (scene, _) = built(&of(cycle), view);
        let camera = Camera {
            scale: 10.0,
            middle: Vec2::ZERO,
            size: Vec2::new(800.0, 600.0),
        };
        let [filled, _] = outlines(&scene.material, &camera, 36.0);
        turns(&filled, camera.pixel(at.into())) != 0
    };
    for cycle in ["double-wall-external-corner", "triple-wall-external-corner"] {
        assert!(filled(cycle, Projection::Top, [15.0, 15.0]), "{cycle}");
        assert!(
            !filled(cycle, Projection::Top, [-1.0, 15.0])
                && !filled(cycle, Projection::Top, [15.0, -1.0]),
            "{cycle}"
        );
    }
    assert!(filled(
        "triple-wall-external-corner",
        Projection::Front,
        [15.0, -8.0]
    ));
    assert!(!filled(
        "double-wall-internal-corner",
        Projection::Top,
        [15.0, 15.0]
    ));
    assert!(
        filled("surface", Projection::Top, [5.0, 5.0]),
        "what is looked at is material, too"
    );
    // The walls of a corner of three continued below its floor, which looked like a shelf.
    let (scene, path) = built(&of("triple-wall-internal-corner"), Projection::Front);
    let floor = path.frame.origin.z;
    assert!(
        scene
            .walls
            .iter()
            .flat_map(|wall| wall.corners)
            .all(|corner| corner.y > floor - 1e-6),
        "{:?}",
        scene.walls
    );
}

/// The nominal walls in the order in which they are drawn.
fn walls(scene: &Scene) -> Vec<&WallShape> {
    let wall = |face| {
        if let Face::Wall(wall) = face {
            Some(wall)
        } else {
            None
        }
    };
    scene.faces(false).into_iter().filter_map(wall).collect()
}

/// Area of a polygon.
fn area(corners: &[Vec2]) -> f64 {
    let edge = |k: usize| (corners[k], corners[(k + 1) % corners.len()]);
    (0..corners.len())
        .map(edge)
        .map(|(a, b)| a[0] * b[1] - a[1] * b[0])
        .sum::<f64>()
        .abs()
        / 2.0
}

#[test]
fn what_stands_between_two_walls_has_a_top_and_what_lies_around_has_none() {
    for (cycle, tops) in [
        ("external-rectangle", 1),
        ("web", 1),
        ("web-three-points", 1),
        ("internal-rectangle", 0),
        ("groove", 0),
        ("double-wall-external-corner", 1),
        ("triple-wall-external-corner", 1),
        ("double-wall-internal-corner", 0),
        ("surface", 0),
    ] {
        for view in [Projection::Isometric, Projection::Top] {
            let (scene, _) = built(&of(cycle), view);
            assert_eq!(
                scene.tops.len(),
                if view == Projection::Isometric {
                    tops
                } else {
                    0
                },
                "{cycle}"
            );
        }
    }
    let turned = with(
        &of("external-rectangle"),
        "cycle.rotation",
        crate::common::number(33.0),
    );
    let (scene, _) = built(&turned, Projection::Isometric);
    // 80 × 50, whatever its rotation.
    let rectangle = 80.0 * 50.0 / 3f64.sqrt();
    assert!(
        (area(&scene.tops[0].corners) - rectangle).abs() < 1e-6 * rectangle,
        "{}",
        area(&scene.tops[0].corners)
    );
    // So it is if its walls are picked beside their middles: they meet at its corners, and the top side is no octagon.
    let picks = r#"{ "type": "external-rectangle", "touches": [{ "point": [40, 10, -10], "vector": [1, 0, 0] }, { "point": [-40, -10, -10], "vector": [-1, 0, 0] },
        { "point": [15, 25, -10], "vector": [0, 1, 0] }, { "point": [0, -25, -10], "vector": [0, -1, 0] }] }"#;
    let (scene, path) = built(
        &crate::common::job(&format!(r#"{{ "format": 1, "cycle": {picks} }}"#)),
        Projection::Isometric,
    );
    assert!(
        (area(&scene.tops[0].corners) - rectangle).abs() < 1e-6 * rectangle,
        "{}",
        area(&scene.tops[0].corners)
    );
    let Surface::Flat(wall) = &path.surfaces[0] else {
        panic!("a flat wall")
    };
    assert_eq!((wall.extent, wall.point.y), ((-35.0, 15.0), 10.0));
    let studs = with(
        &of("probing-two-circles"),
        "cycle.geometryType",
        crate::common::number(1.0),
    );
    assert_eq!(built(&studs, Projection::Isometric).0.tops.len(), 2);
}

/// The first stud is in front of the second one, and higher: items drawn later are on top.
#[test]
fn the_top_of_what_stands_behind_is_drawn_before_what_stands_in_front() {
    for (points, nearer) in [
        ("[15, -15, 0]|[-15, 15, -40]", 0),
        ("[-15, 15, -40]|[15, -15, 0]", 1),
    ] {
        let (one, two) = points.split_once('|').unwrap();
        let job = crate::common::job(&format!(
            r#"{{ "format": 1, "cycle": {{ "type": "probing-two-circles", "geometryType": 1, "point1": {one}, "point2": {two}, "diameter1": 20, "diameter2": 20,
            "clearanceHeight": 100, "start": [0, 0, 120] }} }}"#
        ));
        let (scene, _) = built(&job, Projection::Isometric);
        let order: Vec<usize> = scene
            .faces(false)
            .into_iter()
            .filter_map(|face| match face {
                Face::Wall(wall) => Some(wall.top.expect("of a stud")),
                Face::Top(top) => Some(10 + top.of),
                Face::Behind(_) => None,
            })
            .collect();
        let at = |what: usize| order.iter().position(|x| *x == what).unwrap();
        assert!(
            at(10 + (1 - nearer)) < at(nearer),
            "the farther top before the nearer walls: {order:?}"
        );
        assert!(order.iter().rposition(|x| *x == nearer).unwrap() < at(10 + nearer));
    }
}

#[test]
fn the_times_of_the_moves_are_the_times_of_the_plan() {
    for (name, job) in jobs() {
        let plan = planned(&job);
        let minutes = job::minutes(&job::planned(&job).expect("the job is sound"));
        assert_eq!(minutes.len(), plan.moves.len(), "{name}");
        let sum: f64 = minutes.iter().sum();
        assert!(
            (sum - plan.time).abs() < 1e-9 * (1.0 + sum),
            "{name}: {sum} against {}",
            plan.time
        );
    }
}

#[test]
fn a_ball_on_its_way_is_on_its_line() {
    let job = of("internal-rectangle-protected");
    let (scene, path) = built(&job, Projection::Top);
    for index in 1..path.moves.len() {
        let (from, to) = (scene.ends[index - 1], scene.ends[index]);
        for part in [0.0, 0.25, 1.0] {
            let ball = scene.ball(index, part).expect("the move is there");
            let wanted = from + (to - from) * part;
            assert!(
                ball.distance(wanted) < 1e-9,
                "move {index} at {part}: {ball:?}, {wanted:?}"
            );
        }
    }
}

/// Text of a dimension in an SVG: "Width 2 50" was read as 250, so its value is separate and bold.
fn said(label: &str, value: &str) -> String {
    format!(
        "<tspan font-weight=\"400\" fill=\"#46535f\">{label} </tspan><tspan dx=\"3\">{value}</tspan></text>"
    )
}

/// The numbers of an attribute of the circles of a colour, in order.
fn attributes(svg: &str, colour: &str, name: &str) -> Vec<f64> {
    let of = |element: &str| {
        element
            .split(&format!(" {name}=\""))
            .nth(1)?
            .split('"')
            .next()?
            .parse()
            .ok()
    };
    svg.lines()
        .filter(|line| line.starts_with("<circle") && line.contains(colour))
        .filter_map(of)
        .collect()
}

/// The SVG is to scale: its contacts have the distances of the form, by the scale of the ball.
#[test]
fn an_svg_is_to_scale_and_says_its_dimensions() {
    let job = of("internal-rectangle-protected");
    let svg = job::svg(&job, Projection::Top).expect("the job has a plan");
    for (label, value) in [("Width 1", "80"), ("Width 2", "50")] {
        assert!(svg.contains(&said(label, value)), "{label}: {svg}");
    }
    let contacts = |name| attributes(&svg, "#cf2a20", name);
    let (x, y, radii) = (
        contacts("cx"),
        contacts("cy"),
        attributes(&svg, "#2563eb", "r"),
    );
    let scale = radii[0] / 3.0;
    assert_eq!(x.len(), 4, "{svg}");
    assert!(
        (x[0] - x[1] - 80.0 * scale).abs() < 0.06 * 80.0 / 3.0,
        "{x:?} at {scale}"
    );
    assert!(
        (y[3] - y[2] - 50.0 * scale).abs() < 0.06 * 80.0 / 3.0,
        "{y:?} at {scale}"
    );
    assert!(!svg.contains("b45309"), "a nominal part is drawn once");
    let shifted = with(&job, "part.rotation", crate::common::number(2.0));
    assert!(
        job::svg(&shifted, Projection::Top)
            .expect("the job has a plan")
            .contains("b45309"),
        "and the virtual part"
    );
}

/// Four bores about (10, 5), 80 by 60 mm apart: their centre, the line through two of them, and their pitch circle, whose diameter is the diagonal, 100 mm.
#[test]
fn relations_are_drawn_where_their_places_are() {
    let at = [[-30.0, -25.0], [50.0, -25.0], [50.0, 35.0], [-30.0, 35.0]];
    let bores: Vec<String> = (1..)
        .zip(at)
        .map(|(n, [x, y])| {
            format!(
                r#"{{ "name": "B{n}", "type": "hole", "diameter": 12, "origin": [{x}, {y}, -5] }}"#
            )
        })
        .collect();
    let with_relation = |relation: &str| {
        crate::common::job(&format!(
            r#"{{ "format": 2, "cycles": [{}], "relations": [{relation}] }}"#,
            bores.join(",")
        ))
    };
    let seen = |relation: &str, view| built(&with_relation(relation), view).0.related;
    let spots = at.map(|[x, y]| Vec2::new(x, y));
    let middle = Vec2::new(10.0, 5.0);
    let all = r#""of": ["B1", "B2", "B3", "B4"]"#;
    let line = r#"{ "name": "LINE", "type": "line", "of": ["B1", "B3"] }"#;
    let near = |found: &[[Vec2; 2]], wanted: &[[Vec2; 2]]| {
        assert_eq!(found.len(), wanted.len());
        for (found, wanted) in found.iter().flatten().zip(wanted.iter().flatten()) {
            assert!(found.distance(*wanted) < 1e-9, "{found} {wanted}");
        }
    };
    near(&seen(line, Projection::Top), &[[spots[0], spots[2]]]);
    // The distance is the diagonal of 80 by 60 mm.
    let distances = |relation: &str| built(&with_relation(relation), Projection::Top).0.distances;
    let diagonal = distances(line);
    assert_eq!((diagonal.len(), diagonal[0].name.as_str()), (1, "LINE"));
    assert!((diagonal[0].length - 100.0).abs() < 1e-9);
    near(&[diagonal[0].ends], &[[spots[0], spots[2]]]);
    assert!(distances(&format!(r#"{{ "name": "MID", "type": "center", {all} }}"#)).is_empty());
    // From the front their height is visible.
    near(
        &seen(line, Projection::Front),
        &[[Vec2::new(-30.0, -5.0), Vec2::new(50.0, -5.0)]],
    );
    near(
        &seen(
            &format!(r#"{{ "name": "MID", "type": "center", {all} }}"#),
            Projection::Top,
        ),
        &spots.map(|spot| [middle, spot]),
    );
    let circle = seen(
        &format!(r#"{{ "name": "PCD", "type": "pitch-circle", {all} }}"#),
        Projection::Top,
    );
    assert!(circle.len() > 36);
    for [from, to] in &circle {
        assert!((from.distance(middle) - 50.0).abs() < 1e-9, "{from}");
        assert!(to.distance(*from) < 5.0);
    }
    let step = r#"{ "name": "STEP", "type": "difference", "of": ["B1.diameter", "B2.diameter"] }"#;
    assert!(seen(step, Projection::Top).is_empty());
    // In the SVG it is a thin line of long and short dashes.
    let dashes = "stroke-dasharray=\"10 4 2 4\"";
    let svg = |relation| job::svg(&with_relation(relation), Projection::Top).expect("a plan");
    assert!(svg(line).contains(dashes));
    assert!(!svg(step).contains(dashes));
}

#[test]
fn an_svg_holds_no_markup_of_the_job_and_is_refused_with_the_jobs_findings() {
    let hostile = with(
        &of("hole"),
        "name",
        Value::Text("A<script>alert(1)</script>&".to_owned()),
    );
    let svg = job::svg(&hostile, Projection::Front).expect("a name may hold anything");
    assert!(
        !svg.contains("<script") && svg.contains("A&lt;script&gt;"),
        "{svg}"
    );
    for (name, job) in jobs() {
        let svg =
            job::svg(&job, Projection::Front).unwrap_or_else(|error| panic!("{name}: {error}"));
        let opened = svg.matches("<svg").count()
            + svg.matches("<text").count()
            + svg.matches("<g ").count()
            + svg.matches("<tspan").count()
            + svg.matches("<title").count()
            + svg.matches("<pattern").count();
        assert_eq!(opened, svg.matches("</").count(), "{name}");
        assert!(
            !svg.contains("NaN") && !svg.contains("inf"),
            "{name}: {svg}"
        );
    }
    let wrong = with(&of("hole"), "cycle.diameter", crate::common::number(-1.0));
    let error = job::svg(&wrong, Projection::Top).expect_err("no picture of a job with errors");
    assert_eq!(error.findings[0].path, "cycle.diameter");
}

#[test]
fn corners_and_circles_have_their_dimensions_too() {
    let fields = |cycle: &str, view| {
        built(&of(cycle), view)
            .0
            .dimensions
            .iter()
            .map(|d| d.field)
            .collect::<Vec<_>>()
    };
    let inside = [
        "cycle.clearance1",
        "cycle.step1",
        "cycle.clearance2",
        "cycle.step2",
    ];
    assert_eq!(
        fields("double-wall-internal-corner", Projection::Top),
        inside
    );
    let outside = [
        "cycle.clearance1",
        "cycle.step1",
        "cycle.distance1",
        "cycle.clearance2",
        "cycle.step2",
        "cycle.distance2",
    ];
    assert_eq!(
        fields("double-wall-external-corner", Projection::Top),
        outside
    );
    assert_eq!(
        fields("triple-wall-internal-corner", Projection::Top),
        ["cycle.clearance1", "cycle.clearance2"]
    );
    let lifted = ["cycle.clearance1", "cycle.clearance3", "cycle.feedDistance"];
    assert_eq!(
        fields("triple-wall-internal-corner", Projection::Front),
        lifted
    );
    let [wall1, wall2] = [
        ["cycle.clearance1", "cycle.distance1"],
        ["cycle.clearance2", "cycle.distance2"],
    ];
    let top = [wall1, wall2, ["cycle.topDistance1", "cycle.topDistance2"]].concat();
    assert_eq!(fields("triple-wall-external-corner", Projection::Top), top);
    let front = [
        "cycle.clearance1",
        "cycle.distance2",
        "cycle.depth",
        "cycle.topDistance1",
        "cycle.topClearance",
        "cycle.feedDistance",
    ];
    assert_eq!(
        fields("triple-wall-external-corner", Projection::Front),
        front
    );
    assert_eq!(
        fields("surface", Projection::Front),
        ["cycle.clearance", "cycle.feedDistance"]
    );
    assert_eq!(
        fields("probing-two-circles", Projection::Top),
        ["cycle.diameter1", "cycle.diameter2"]
    );
}

/// Only deviations are magnified: walls and triggers are that many times as far from their nominal positions.
#[test]
fn a_magnified_part_deviates_so_many_times_as_much() {
    let mut seen = 0;
    for (name, job) in jobs() {
        let planned = job::planned(&job).expect("the job is sound");
        for view in [Projection::Top, Projection::Isometric] {
            let [plain, large] = [1.0, 10.0].map(|times| planned.picture(view, times, None).scene);
            assert_eq!(plain.lines, large.lines, "{name}");
            let nominal = |scene: &Scene| {
                scene
                    .walls
                    .iter()
                    .filter(|w| !w.actual)
                    .map(|w| w.corners)
                    .collect::<Vec<_>>()
            };
            assert_eq!(nominal(&plain), nominal(&large), "{name}");
            for (one, ten) in plain.touches.iter().zip(&large.touches) {
                let (Some(real), Some(far)) = (one.trigger, ten.trigger) else {
                    continue;
                };
                let (real, far) = (real - one.ball, far - ten.ball);
                assert!(
                    far.distance(10.0 * real) < 1e-9,
                    "{name}: {real:?}, {far:?}"
                );
                seen += usize::from(real.length() > 1e-6);
            }
        }
    }
    assert!(seen > 40, "{seen}");
    // A pocket that is 0.3 to the right: its walls ten times as far.
    let offset = Value::List([0.3, 0.0, 0.0].map(crate::common::number).to_vec());
    let job = with(&of("internal-rectangle-protected"), "part.offset", offset);
    let planned = job::planned(&job).expect("the job is sound");
    let left = |times| {
        let scene = planned.picture(Projection::Top, times, None).scene;
        scene
            .walls
            .iter()
            .filter(|w| w.actual)
            .flat_map(|w| w.corners)
            .map(|c| c[0])
            .fold(f64::MAX, f64::min)
    };
    let apart = left(10.0) - left(1.0);
    assert!((apart - 2.7).abs() < 1e-9, "{apart}");
}

/// Winding number of closed outlines around a position, counter-clockwise in pixels.
fn turns(outlines: &[Vec<Vec2>], Vec2 { x, y }: Vec2) -> i32 {
    let mut sum = 0;
    for outline in outlines {
        for (k, a) in outline.iter().enumerate() {
            let b = outline[(k + 1) % outline.len()];
            let side = (b[0] - a[0]) * (y - a[1]) - (x - a[0]) * (b[1] - a[1]);
            if a[1] <= y && b[1] > y && side > 0.0 {
                sum += 1;
            } else if a[1] > y && b[1] <= y && side < 0.0 {
                sum -= 1;
            }
        }
    }
    sum
}

/// The scale bar covers nothing: no ball, contact, corner of a wall, end of a move or name is in its box. If every corner is occupied it is omitted.
#[test]
fn the_scale_bar_lies_on_nothing() {
    let (mut placed, mut left_out) = (0, 0);
    for cycle in touchpath::cycle::CYCLES
        .iter()
        .filter(|cycle| !cycle.steps.is_empty())
    {
        for size in [
            Vec2::new(740.0, 640.0),
            Vec2::new(390.0, 300.0),
            Vec2::new(290.0, 160.0),
        ] {
            let (scene, _) = built(&of(cycle.key), Projection::Top);
            let camera = Camera::fit(
                size,
                scene.bounds(),
                Camera {
                    scale: 1.0,
                    middle: Vec2::ZERO,
                    size,
                }
                .dimension_margin(),
            );
            let layout = camera.layout(&scene, None);
            let half = Vec2::new(40.0, 17.0);
            let Some(middle) = layout.bar(&camera, half) else {
                left_out += 1;
                continue;
            };
            placed += 1;
            let walls = scene.walls.iter().flat_map(|wall| wall.corners);
            let spots = scene
                .touches
                .iter()
                .flat_map(|touch| [touch.ball, touch.contact])
                .chain(walls)
                .chain(scene.ends.clone());
            let names = layout
                .dimensions
                .iter()
                .map(|placed| placed.name.middle)
                .chain(layout.numbers.iter().map(|n| n.plate.middle));
            for at in spots.map(|spot| camera.pixel(spot)).chain(names) {
                let off = (at - middle).abs();
                assert!(
                    off.x > half.x || off.y > half.y,
                    "{} at {size}: {at} in the bar at {middle}",
                    cycle.key
                );
            }
        }
    }
    assert!(
        placed > 20 && left_out > 0,
        "{placed} placed, {left_out} left out"
    );
}
