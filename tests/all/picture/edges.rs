//! Colours, scale and edges: cut-off items, and material behind every contact.

use super::*;

/// A colour that the page does not set has its default, also in dark mode.
#[test]
fn the_page_names_the_colours_of_a_picture() {
    let names = touchpath::view::style::COLOURS.map(|(name, ..)| name);
    let read = |file: &str| {
        std::fs::read_to_string(format!("{}/{file}", env!("CARGO_MANIFEST_DIR")))
            .expect("it is there")
    };
    let listed = names.map(|name| format!("\"{name}\"")).join(", ");
    assert!(
        read("www/parts/drawing.ts")
            .split_whitespace()
            .collect::<Vec<_>>()
            .join(" ")
            .contains(&format!("const COLOURS = [ {listed}, ];")),
        "{listed}"
    );
    let told = names.map(|name| format!("`{name}`")).join(", ");
    assert!(
        read("src/wasm/view/mod.rs").contains(&format!("/// Colours: {told}.\n")),
        "{told}"
    );
    let style = read("www/styles/tokens.css");
    for name in names {
        // Light and dark.
        assert!(
            style.matches(&format!("--c-{name}: ")).count() >= 2,
            "{name}"
        );
    }
}

/// Every drawn item is inside the picture, also for a rotated part and a touch with a long search.
#[test]
fn nothing_of_an_svg_is_cut_off() {
    for (cycle, rotation, overtravel) in [
        ("hole", 45.0, 5.0),
        ("boss", 30.0, 5.0),
        ("hole", 0.0, 50.0),
        ("web-three-points", 45.0, 5.0),
    ] {
        let job = with(
            &with(
                &of(cycle),
                "cycle.rotation",
                crate::common::number(rotation),
            ),
            "overtravel",
            crate::common::number(overtravel),
        );
        let svg = job::svg(&job, Projection::Top).expect("the job has a plan");
        let of = |name: &str| {
            svg.split(&format!("{name}=\""))
                .nth(1)
                .and_then(|rest| rest.split('"').next())
                .expect("it is there")
                .to_owned()
        };
        let view: Vec<f64> = of("viewBox")
            .split(' ')
            .map(|n| n.parse().expect("a number"))
            .collect();
        let pairs = svg
            .split(['M', 'L', 'Z', ' ', '"'])
            .filter_map(|word| word.split_once(','));
        let mut seen = 0;
        for (x, y) in
            pairs.filter_map(|(x, y)| Some((x.parse::<f64>().ok()?, y.parse::<f64>().ok()?)))
        {
            assert!(
                x >= view[0] && x <= view[0] + view[2],
                "{cycle} {rotation}: {x} of {view:?}"
            );
            assert!(
                y >= view[1] && y <= view[1] + view[3],
                "{cycle} {rotation}: {y} of {view:?}"
            );
            seen += 1;
        }
        assert!(seen > 50, "{cycle}: {seen}");
    }
}

/// The bar is a round number in the job's units, and at most 110 pixels long.
#[test]
fn the_scale_has_the_units_of_the_job() {
    let mut seen = 0;
    for (name, job) in jobs() {
        let Some(planned) = job::planned(&job) else {
            continue;
        };
        let scene = planned.picture(Projection::Top, 1.0, None).scene;
        let inch = job.get("units") == Some(&Value::Text("inch".to_owned()));
        assert_eq!(scene.unit, Some(if inch { 25.4 } else { 1.0 }), "{name}");
        seen += usize::from(inch);
    }
    assert!(seen > 0);
    for (scale, unit, length) in [
        (1.0, 1.0, 100.0),
        (1.0, 25.4, 2.0),
        (0.5, 1.0, 200.0),
        (110.0, 25.4, 0.02),
        (2.0, 1.0, 50.0),
    ] {
        let camera = Camera {
            scale,
            middle: Vec2::ZERO,
            size: Vec2::new(300.0, 150.0),
        };
        assert!(
            (camera.bar(unit) - length).abs() < 1e-12,
            "{scale} {unit}: {}",
            camera.bar(unit)
        );
    }
}

/// On the set-up sheet the second step was below the picture because the name of the first one was near; on a phone of 360 pixels the first width.
#[test]
fn the_line_of_a_dimension_was_outside_a_small_picture() {
    let steps = crate::common::job(
        r#"{ "format": 1, "cycle": { "type": "double-wall-internal-corner", "count1": 8, "count2": 8 } }"#,
    );
    let jobs = touchpath::cycle::CYCLES
        .iter()
        .map(|cycle| of(cycle.key))
        .chain([steps]);
    let mut seen = 0;
    for (k, job) in jobs.enumerate() {
        let (scene, _) = built(&job, Projection::Top);
        for size in [
            [360.0, 168.0],
            [360.0, 206.0],
            [390.0, 240.0],
            [440.0, 268.0],
            [700.0, 700.0],
        ] {
            let drawn = Camera::whole(size.into(), &scene)
                .layout(&scene, None)
                .dimensions;
            let named = |field: &str| drawn.iter().any(|placed| placed.drawn.field == field);
            assert!(
                k < touchpath::cycle::CYCLES.len() || named("cycle.step1") && named("cycle.step2"),
                "{size:?}"
            );
            for placed in drawn {
                let inside = |at: &Vec2| (0..2).all(|i| (0.0..=size[i]).contains(&at[i]));
                assert!(
                    placed.line.iter().all(inside),
                    "{k}: {} in {size:?}: {:?}",
                    placed.drawn.field,
                    placed.line
                );
                seen += 1;
            }
        }
    }
    assert!(seen > 100, "{seen}");
}

/// In a section there is material behind every contact and air on the side of the ball; overlapping outlines do not cancel out.
#[test]
fn material_is_drawn_behind_every_contact_and_air_before_it() {
    let mut seen = [0; 3];
    for (name, job) in metric() {
        for (k, view) in [Projection::Top, Projection::Front, Projection::Side]
            .into_iter()
            .enumerate()
        {
            let planned = job::planned(&job).expect("the job is sound");
            let scene = planned.picture(view, 1.0, None).scene;
            for scale in [0.7, 4.0, 30.0] {
                let camera = Camera {
                    scale,
                    middle: Vec2::ZERO,
                    size: Vec2::new(800.0, 600.0),
                };
                let [filled, air] = outlines(&scene.material, &camera, 36.0);
                for touch in &scene.touches {
                    // A wall seen from the front is no edge.
                    if (touch.inward.length() - 1.0).abs() > 1e-9 {
                        continue;
                    }
                    // A round wall is an edge only at its extreme sides.
                    if view != Projection::Top
                        && planned
                            .path
                            .surfaces
                            .iter()
                            .any(|s| matches!(s, Surface::Round(_)))
                    {
                        continue;
                    }
                    // A wall may be drawn down to the touch itself, where a ball is a point: seen from slightly above.
                    let up = if view == Projection::Top { 0.0 } else { 1e-3 };
                    let at = |by: f64| {
                        camera.pixel(touch.contact + touch.inward * by / scale + Vec2::Y * up)
                    };
                    let solid = |spot| turns(&filled, spot) != 0 && turns(&air, spot) == 0;
                    assert!(
                        solid(at(-2.0)),
                        "{name}, {view:?}: no material behind {:?}",
                        touch.contact
                    );
                    assert!(
                        !solid(at(2.0)),
                        "{name}, {view:?}: material before {:?}",
                        touch.contact
                    );
                    seen[k] += 1;
                }
            }
        }
    }
    assert!(seen.iter().all(|seen| *seen > 60), "{seen:?}");
}
