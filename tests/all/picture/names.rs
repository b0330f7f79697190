//! Positions of names and numbers: on no ball, on no other name, along their lines.

use super::*;

/// "Depth 10" was on the ball that it measures, "Width 30" on the one that touches the top, "Elevation 90°" on its own arc.
#[test]
fn no_name_covers_a_ball_another_name_or_its_own_arrow_heads() {
    let mut seen = [0; 3];
    for cycle in touchpath::cycle::CYCLES {
        for view in [Projection::Top, Projection::Front, Projection::Side] {
            let (scene, _) = built(&of(cycle.key), view);
            for (size, large) in [([758.0, 710.0], true), ([390.0, 206.0], false)] {
                let camera = Camera::whole(size.into(), &scene);
                let demanded = scene
                    .dimensions
                    .iter()
                    .filter(|d| d.on_demand)
                    .map(|d| Some(d.field));
                for focus in demanded.chain([None]) {
                    let said = || format!("{} {view:?} {size:?} {focus:?}", cycle.key);
                    let layout = camera.layout(&scene, focus);
                    let names: Vec<_> = layout
                        .arcs
                        .iter()
                        .filter_map(|arc| arc.name)
                        .chain(layout.dimensions.iter().map(|d| d.name))
                        .collect();
                    for (k, name) in names.iter().enumerate() {
                        assert!(
                            names[..k].iter().all(|other| !name.meets(other)),
                            "{}: two names",
                            said()
                        );
                        let radius = scene.radius * camera.scale;
                        let covered = scene
                            .touches
                            .iter()
                            .any(|touch| name.covers(camera.pixel(touch.ball), radius));
                        // On a phone there is not always room, and a dimension that appears with the focus is near its feature.
                        assert!(
                            !covered || !large || focus.is_some(),
                            "{}: name {k} of {} on a ball",
                            said(),
                            names.len()
                        );
                        seen[0] += 1;
                    }
                    for placed in &layout.dimensions {
                        let [start, end] = placed.line;
                        let long = (end[0] - start[0]).hypot(end[1] - start[1]);
                        let on = placed.name.crosses(placed.line.map(Vec2::from), 0.0);
                        assert!(
                            !on || 2.0 * placed.name.half[0] + 16.0 < long,
                            "{}: {}",
                            said(),
                            placed.drawn.field
                        );
                        seen[usize::from(on) + 1] += 1;
                    }
                    for arc in &layout.arcs {
                        assert!(
                            arc.name.is_none_or(|name| !name.covers(arc.at, arc.radius)),
                            "{}: on its arc",
                            said()
                        );
                    }
                }
            }
        }
    }
    assert!(seen.iter().all(|seen| *seen > 100), "{seen:?}");
}

/// Every cycle in every view, fitted into a large picture and into one on a phone.
fn seen_everywhere(mut look: impl FnMut(&str, &Scene, &Camera)) {
    for cycle in touchpath::cycle::CYCLES {
        for view in [
            Projection::Top,
            Projection::Front,
            Projection::Side,
            Projection::Isometric,
        ] {
            let (scene, _) = built(&of(cycle.key), view);
            for size in [[758.0, 710.0], [390.0, 206.0]] {
                look(
                    &format!("{} {view:?} {size:?}", cycle.key),
                    &scene,
                    &Camera::whole(size.into(), &scene),
                );
            }
        }
    }
}

/// A number that collided with another one was pushed to the right again and again: in front of two circles 5 to 8 were in a row in the air.
#[test]
fn each_number_stands_beside_its_contact_and_none_on_another() {
    let (mut seen, mut shared) = (0, 0);
    seen_everywhere(|said, scene, camera| {
        let numbers = camera.numbers(scene);
        let mut touches: Vec<usize> = numbers
            .iter()
            .flat_map(|number| number.touches.clone())
            .collect();
        touches.sort_unstable();
        assert!(
            touches.into_iter().eq(0..scene.touches.len()),
            "{said}: each touch once"
        );
        for (k, number) in numbers.iter().enumerate() {
            let [dx, dy] = [0, 1].map(|i| number.plate.middle[i] - number.contact[i]);
            let radius = number.radius();
            let ball = if scene.touches[number.touches[0]].behind.is_some() {
                scene.radius * camera.scale
            } else {
                0.0
            };
            assert!(
                dx.hypot(dy) < 4.0 * radius + 9.0 + ball,
                "{said}: {} is {dx} {dy} off",
                number.label
            );
            assert!(
                number.has_leader || dx.hypot(dy) < number.plate.half[0] + radius + 9.0 + ball,
                "{said}: a line leads to {}",
                number.label
            );
            assert!(
                !number.plate.covers(number.contact, 3.0),
                "{said}: {} is on its contact",
                number.label
            );
            let met = numbers[..k]
                .iter()
                .find(|other| other.plate.meets(&number.plate));
            assert!(
                met.is_none(),
                "{said}: {} is on {}",
                number.label,
                met.map_or("", |other| &other.label)
            );
            let together: Vec<_> = number.touches.iter().map(|k| (k + 1).to_string()).collect();
            assert_eq!(number.label, together.join("·"));
            shared += usize::from(number.touches.len() > 1);
            seen += 1;
        }
    });
    assert!(seen > 200 && shared > 20, "{seen} {shared}");
}

/// On a phone three of four touches had no arrow head, and heads in both directions overlapped.
#[test]
fn every_touch_has_its_arrow_head_and_none_lies_on_another() {
    let mut seen = [0; 2];
    seen_everywhere(|said, scene, camera| {
        let long = |line: &Line| {
            let [from, to] = [line.from, line.to].map(|spot| camera.pixel(spot));
            from.distance(to)
        };
        for line in &scene.lines {
            let head = camera.head(line);
            assert!(head.is_none() || !line.back, "{said}: on the way back");
            if line.stroke == Stroke::Touch && long(line) > 1.0 {
                let (tip, ..) = head.unwrap_or_else(|| panic!("{said}: touch without a head"));
                assert!(
                    (0..2).all(|i| (tip[i] - camera.pixel(line.to)[i]).abs() < 1e-9),
                    "{said}: at its contact"
                );
                seen[0] += 1;
            }
            let Some((tip, _, size)) = head.filter(|_| line.stroke != Stroke::Touch) else {
                continue;
            };
            for other in scene
                .lines
                .iter()
                .filter(|other| other.from == line.to && other.to == line.from)
            {
                if let Some((back, _, other)) = camera.head(other) {
                    assert!(
                        (tip[0] - back[0]).hypot(tip[1] - back[1]) > size + other,
                        "{said}: there and back"
                    );
                    seen[1] += 1;
                }
            }
        }
    });
    assert!(seen.iter().all(|seen| *seen > 100), "{seen:?}");
}

/// The rapid of 1411 crossed the origin's name, and discs covered it.
#[test]
fn the_name_of_the_origin_stands_where_no_other_name_or_number_is() {
    let mut seen = 0;
    seen_everywhere(|said, scene, camera| {
        let layout = camera.layout(scene, None);
        let name = layout.origin(camera.pixel(scene.origin), Vec2::new(25.0, 8.0));
        // On a phone items may be crowded.
        if camera.size[0] > 400.0 {
            assert!(layout.crowd.cost(&name) < 200.0, "{said}");
            seen += 1;
            if said.starts_with("probing-two-circles Top") {
                assert_eq!(layout.crowd.cost(&name), 0.0, "{said}");
            }
        }
    });
    assert!(seen > 40, "{seen}");
}

/// At 30° the names were horizontal, off their lines.
#[test]
fn a_name_is_read_along_its_line_from_below_or_from_the_right() {
    for turn in 0..36 {
        let turned = with(
            &of("internal-rectangle-protected"),
            "cycle.rotation",
            crate::common::number(10.0 * f64::from(turn)),
        );
        let (scene, _) = built(&turned, Projection::Top);
        let layout = Camera::whole([758.0, 710.0].into(), &scene)
            .layout(&scene, None)
            .dimensions;
        assert_eq!(layout.len(), 2);
        for placed in layout {
            let ([[ax, ay], [bx, by]], [x, y]) = (
                placed.line.map(|end| end.to_array()),
                placed.name.middle.to_array(),
            );
            let [ux, uy] = placed.name.along.to_array();
            let (dx, dy) = (bx - ax, by - ay);
            assert!(
                (dx * uy - dy * ux).abs() < 1e-6 * dx.hypot(dy),
                "{turn}: along the line"
            );
            assert!(
                ((x - ax) * dy - (y - ay) * dx).abs() < 1e-6 * dx.hypot(dy),
                "{turn}: on it"
            );
            // Pixels grow downwards: upright text is read upwards.
            assert!(ux > 1e-6 || (ux > -1e-6 && uy < 0.0), "{turn}: {ux} {uy}");
        }
    }
}

/// From the side, a hole is hatched beside itself, not above its mouth or below its floor, and not within another one.
#[test]
fn the_material_around_holes_seen_from_the_side_ends_where_they_do() {
    let mut seen = 0;
    let close = of("probing-two-circles");
    let close = with(&close, "cycle.point1", crate::common::job("[0, 0, -10]"));
    let close = with(&close, "cycle.point2", crate::common::job("[24, 0, -10]"));
    for (name, job) in metric().chain([("close".to_owned(), close)]) {
        for view in [Projection::Front, Projection::Side] {
            let planned = job::planned(&job).expect("the job is sound");
            let scene = planned.picture(view, 1.0, None).scene;
            let holes: Vec<_> = planned
                .path
                .surfaces
                .iter()
                .filter_map(|s| {
                    if let Surface::Round(r) = s {
                        Some(*r)
                    } else {
                        None
                    }
                })
                .collect();
            if planned.job.setup.plane != touchpath::geom::Plane::G17
                || holes.is_empty()
                || holes.iter().any(|r| !r.hole)
            {
                continue;
            }
            let scale = 4.0;
            let camera = Camera {
                scale,
                middle: Vec2::ZERO,
                size: Vec2::new(800.0, 600.0),
            };
            let [filled, air] = outlines(&scene.material, &camera, 36.0);
            let solid = |spot: [f64; 2]| {
                let at = camera.pixel(spot.into());
                turns(&filled, at) != 0 && turns(&air, at) == 0
            };
            for hole in &holes {
                let Vec2 { x: across, y: top } = view.place(planned.job.setup.plane, hole.center);
                let floor = top - hole.drawn_depth;
                let edge = hole.radius + 1.0 / scale;
                let within = |x: f64| {
                    holes.iter().any(|r| {
                        (view.place(planned.job.setup.plane, r.center).x - x).abs() < r.radius
                    })
                };
                for x in [across - edge, across + edge]
                    .into_iter()
                    .filter(|x| !within(*x))
                {
                    assert!(
                        solid([x, (top + floor) / 2.0]),
                        "{name}, {view:?}: material beside the hole at {across}"
                    );
                    assert!(
                        !solid([x, top + 0.5]),
                        "{name}, {view:?}: above the mouth of the hole at {across}"
                    );
                    assert!(
                        !solid([x, floor - 0.5]),
                        "{name}, {view:?}: below the floor of the hole at {across}"
                    );
                    seen += 1;
                }
                if name == "close" && view == Projection::Front {
                    for part in [-0.95, 0.0, 0.95] {
                        let x = across + part * hole.radius;
                        assert!(
                            !solid([x, (top + floor) / 2.0]),
                            "material at {x} within the hole at {across}"
                        );
                    }
                }
            }
        }
    }
    assert!(seen > 20, "{seen}");
}

/// In a picture 440 pixels wide "Width 2 50" read "Width 2 5": it extended beyond the edge.
#[test]
fn no_name_of_a_dimension_is_cut_off_by_the_edge_of_the_picture() {
    let (mut seen, mut cut) = (0, Vec::new());
    for cycle in touchpath::cycle::CYCLES {
        for view in [
            Projection::Top,
            Projection::Front,
            Projection::Side,
            Projection::Isometric,
        ] {
            let (scene, _) = built(&of(cycle.key), view);
            for wide in (360..=760).step_by(80) {
                for high in (260..=700).step_by(88) {
                    let size = [f64::from(wide), f64::from(high)];
                    for placed in Camera::whole(size.into(), &scene)
                        .layout(&scene, None)
                        .dimensions
                    {
                        let inside = |at: &Vec2| (0..2).all(|i| at[i] >= 0.0 && at[i] <= size[i]);
                        seen += 1;
                        if !placed.name.bounds().iter().all(inside) {
                            cut.push(format!(
                                "{} {view:?} {size:?} {}",
                                cycle.key, placed.drawn.field
                            ));
                        }
                    }
                }
            }
        }
    }
    assert!(
        seen > 2_500 && cut.is_empty(),
        "{} of {seen}: {cut:?}",
        cut.len()
    );
}

/// On a phone the view cube covers the upper right corner of the picture, and a tall plate leaves room at its left.
#[test]
fn a_scene_leaves_the_corner_of_the_view_cube_free_if_it_has_room() {
    let size = Vec2::new(390.0, 206.0);
    let mut shifted = 0;
    for cycle in touchpath::cycle::CYCLES {
        for view in [Projection::Top, Projection::Front, Projection::Side] {
            let (scene, _) = built(&of(cycle.key), view);
            let [low, high] = scene.bounds();
            if !low.is_finite() {
                continue;
            }
            let camera = Camera::whole(size, &scene);
            let (corner, left) = (camera.pixel(high), camera.pixel(low).x);
            let covered = corner.y < 112.0 && corner.x > size.x - 112.0 + 1e-9;
            let names = camera.layout(&scene, None).dimensions;
            let first = names.iter().fold(left, |first, placed| {
                placed
                    .line
                    .iter()
                    .fold(first, |first, end| first.min(end[0]))
            });
            // With room beside the axes it would have been moved.
            assert!(
                !covered || first < 71.0,
                "{} {view:?}: {corner}, {first}",
                cycle.key
            );
            shifted += usize::from((camera.middle.x - (low.x + high.x) / 2.0) * camera.scale > 5.0);
        }
    }
    assert!(shifted > 5, "{shifted}");
}

/// The longest names make the widest plates: a place for one is compared with everything that it can cover (asserted beside the comparison).
#[test]
fn numbers_with_long_names_are_compared_with_everything_that_they_can_cover() {
    for (across, down) in [(14.0, 12.0), (22.0, 22.0), (40.0, 14.0)] {
        let cycles: Vec<String> = (0..40)
            .map(|i| {
                let (x, y) = (across * f64::from(i % 8), down * f64::from(i / 8));
                format!(
                    "{{\"type\":\"hole\",\"name\":\"LONGESTNAM{i:02}\",\"diameter\":10,\"origin\":[{x},{y},0]}}"
                )
            })
            .collect();
        let text = format!("{{\"format\":2,\"cycles\":[{}]}}", cycles.join(","));
        let job = crate::common::job(&text);
        let svg = job::svg(&job, Projection::Top).unwrap();
        assert_eq!(svg.matches(">LONGESTNAM").count(), 40);
        // From the front several touches have one number, and a longer text.
        for view in [Projection::Front, Projection::Side, Projection::Isometric] {
            assert!(job::svg(&job, view).is_ok(), "{view:?}");
        }
    }
}
