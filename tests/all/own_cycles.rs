//! Programs that call native cycles: Renishaw's macros, judged by a simulated Fanuc that implements each call from its description and shares no code with the
//! crate. It reads the program's text and the faces of the part, and computes the ball centre at each second touch.

use std::collections::BTreeMap;

use crate::common::{number, owed, point as list, values, with};
use crate::tests::controls::calling_macros;
use touchpath::control::{ProgramForm, find};
use touchpath::form::Value;
use touchpath::job::{Plan, plan};

/// A face of the part, which stops the ball centre (radius 3).
#[derive(Clone, Copy)]
pub(super) enum Face {
    /// Against the normal in the plane: normal · position = distance.
    Wall([f64; 2], f64),
    /// A circle of this radius about a position, from its inside or from outside.
    Circle([f64; 2], f64),
    /// From above, the stylus tip.
    Top(f64),
}

impl Face {
    /// The same at another position.
    pub(super) fn moved(self, [x, y, z]: [f64; 3]) -> Face {
        match self {
            Face::Wall(n, d) => Face::Wall(n, d + n[0] * x + n[1] * y),
            Face::Circle([u, v], radius) => Face::Circle([u + x, v + y], radius),
            Face::Top(height) => Face::Top(height + z),
        }
    }
}

/// Positions of the feature: at the origin its coordinates could be exchanged without an effect.
pub(super) const PLACES: [[f64; 3]; 2] = [[0.0; 3], [7.0, -12.5, -3.0]];

pub(super) const BALL: f64 = 3.0;

/// Distance along a move of the ball centre (x, y, tip) at which a face stops it.
pub(super) fn stopped(face: Face, a: [f64; 3], b: [f64; 3]) -> Option<f64> {
    let way = [b[0] - a[0], b[1] - a[1]];
    let part = match face {
        Face::Top(z) => (z - a[2]) / (b[2] - a[2]),
        Face::Wall(n, d) => {
            let speed = n[0] * way[0] + n[1] * way[1];
            if speed >= 0.0 {
                return None;
            }
            (d + BALL - n[0] * a[0] - n[1] * a[1]) / speed
        }
        Face::Circle(c, radius) => {
            let out = [a[0] - c[0], a[1] - c[1]];
            let inside = out[0].hypot(out[1]) < radius;
            let limit = if inside { radius - BALL } else { radius + BALL };
            let [aa, ab, bb] = [
                out[0] * out[0] + out[1] * out[1] - limit * limit,
                out[0] * way[0] + out[1] * way[1],
                way[0] * way[0] + way[1] * way[1],
            ];
            let root = (ab * ab - aa * bb).sqrt();
            (if inside { -ab + root } else { -ab - root }) / bb
        }
    };
    (0.0..=1.0).contains(&part).then_some(part)
}

/// The simulated control: the ball centre (x, y, tip) at each contact that counts.
pub(super) struct Judge<'p> {
    faces: &'p [Face],
    at: [f64; 3],
    pub contacts: Vec<[f64; 3]>,
}

impl<'p> Judge<'p> {
    pub fn of(faces: &'p [Face]) -> Self {
        Judge {
            faces,
            at: [f64::NAN; 3],
            contacts: Vec::new(),
        }
    }

    /// Runs a call. Returns what the macro measures, by hand from its contacts: X, Y, Z as 0 to 2, the size as 3.
    pub fn measure(&mut self, number: u32, letters: &BTreeMap<char, f64>) -> Vec<(i64, f64)> {
        let before = self.contacts.len();
        self.call(number, letters);
        let outside = letters.get(&'R').is_some_and(|r| *r > 0.0);
        let size = |far: f64| far.abs() + if outside { -2.0 } else { 2.0 } * BALL;
        match (number, &self.contacts[before..]) {
            (9811, [one]) => {
                let axis = ['X', 'Y', 'Z']
                    .iter()
                    .position(|axis| letters.contains_key(axis));
                let axis = axis.unwrap();
                // A touch in the plane ends a radius before the surface.
                let towards = (letters[&['X', 'Y', 'Z'][axis]] - one[axis]).signum();
                let mut place = *one;
                place[axis] += if axis == 2 { 0.0 } else { towards * BALL };
                (0..3).map(|i| (i as i64, place[i])).collect()
            }
            (9812, [one, two]) => {
                let axis = usize::from(letters.contains_key(&'Y'));
                vec![
                    (axis as i64, (one[axis] + two[axis]) / 2.0),
                    (3, size(two[axis] - one[axis])),
                ]
            }
            (9814, [front, back, left, right]) => vec![
                (0, (left[0] + right[0]) / 2.0),
                (1, (front[1] + back[1]) / 2.0),
                (3, size(right[0] - left[0])),
            ],
            _ => Vec::new(),
        }
    }

    /// From the current position towards another one, and `q` past it.
    fn touch(&mut self, place: [f64; 3], q: f64) -> [f64; 3] {
        let way: Vec<f64> = (0..3).map(|i| place[i] - self.at[i]).collect();
        let length = way.iter().map(|x| x * x).sum::<f64>().sqrt();
        let end = [0, 1, 2].map(|i| place[i] + way[i] / length * q);
        let parts = self
            .faces
            .iter()
            .filter_map(|face| stopped(*face, self.at, end));
        let part = parts.fold(f64::INFINITY, f64::min);
        assert!(part <= 1.0, "nothing is met from {:?} to {end:?}", self.at);
        let contact = [0, 1, 2].map(|i| self.at[i] + part * (end[i] - self.at[i]));
        self.contacts.push(contact);
        contact
    }

    /// A touch from a separate position; the stylus returns to its start.
    fn touch_from(&mut self, from: [f64; 3], place: [f64; 3], q: f64) -> [f64; 3] {
        let start = std::mem::replace(&mut self.at, from);
        let contact = self.touch(place, q);
        self.at = start;
        contact
    }

    /// Both sides of the current position along a direction: from the middle, or from outside.
    fn sides(
        &mut self,
        along: [f64; 2],
        size: f64,
        letters: &BTreeMap<char, f64>,
        plus_first: bool,
    ) -> [[f64; 3]; 2] {
        let (middle, q) = (self.at, letters[&'Q']);
        let place = |far: f64, z: f64| [middle[0] + along[0] * far, middle[1] + along[1] * far, z];
        let turned = along[0].abs() < 0.999 && along[1].abs() < 0.999;
        let order = if plus_first { [1.0, -1.0] } else { [-1.0, 1.0] };
        order.map(|side| match letters.get(&'Z') {
            None => self.touch_from(middle, place(side * size / 2.0, middle[2]), q),
            Some(z) => {
                let r = letters[&'R'];
                let from = size / 2.0 + BALL * r.signum() + r;
                // Along an axis Q counts from the surface, beside a rotated wall from the contact of the ball centre.
                let to = if turned {
                    size / 2.0 + BALL * r.signum()
                } else {
                    size / 2.0
                };
                self.touch_from(place(side * from, *z), place(side * to, *z), q)
            }
        })
    }

    fn call(&mut self, number: u32, l: &BTreeMap<char, f64>) {
        let direction = |a: f64| [a.to_radians().cos(), a.to_radians().sin()];
        let [x0, y0, z0] = self.at;
        match number {
            9832..=9834 => {}
            9810 => {
                for (i, letter) in ['X', 'Y', 'Z'].iter().enumerate() {
                    self.at[i] = l.get(letter).copied().unwrap_or(self.at[i]);
                }
            }
            9811 => {
                let place = [
                    l.get(&'X').copied().unwrap_or(x0),
                    l.get(&'Y').copied().unwrap_or(y0),
                    l.get(&'Z').copied().unwrap_or(z0),
                ];
                self.touch(place, l[&'Q']);
            }
            9812 => match l.get(&'X') {
                Some(x) => drop(self.sides([1.0, 0.0], *x, l, false)),
                None => drop(self.sides([0.0, 1.0], l[&'Y'], l, false)),
            },
            9814 => {
                let [one, two] = self.sides([0.0, 1.0], l[&'D'], l, false);
                self.at[1] = (one[1] + two[1]) / 2.0;
                self.sides([1.0, 0.0], l[&'D'], l, false);
                self.at[1] = y0;
            }
            9821 => {
                let [c, s] = direction(l[&'A']);
                self.touch([x0 + c * l[&'D'], y0 + s * l[&'D'], z0], l[&'Q']);
            }
            9822 => {
                let a = l[&'A'];
                // Below 90 at A + 90 first, else at A − 90; beside a web in the reverse order.
                let web = l.get(&'R').is_some_and(|r| *r >= 0.0);
                self.sides(direction(a + 90.0), l[&'D'], l, (a < 90.0) != web);
            }
            9823 => {
                for letter in ['A', 'B', 'C'] {
                    let ([c, s], half) = (direction(l[&letter]), l[&'D'] / 2.0);
                    let at = |far: f64, z: f64| [x0 + c * far, y0 + s * far, z];
                    match l.get(&'Z') {
                        None => self.touch_from([x0, y0, z0], at(half, z0), l[&'Q']),
                        Some(z) => {
                            let r = l[&'R'];
                            self.touch_from(
                                at(half + BALL * r.signum() + r, *z),
                                at(half + BALL * r.signum(), *z),
                                l[&'Q'],
                            )
                        }
                    };
                }
            }
            9815 | 9816 => {
                let (x, y, q) = (l[&'X'], l[&'Y'], l[&'Q']);
                let outside = number == 9816;
                let (fx, fy) = if outside {
                    (2.0 * x - x0, 2.0 * y - y0)
                } else {
                    (x0, y0)
                };
                let away = |from: f64, corner: f64| (from - corner).signum();
                let steps =
                    |letter: char| l.get(&letter).map_or(vec![0.0], |step| vec![0.0, *step]);
                for step in steps('J') {
                    let y = fy + step * away(fy, y);
                    self.touch_from([x0, y, z0], [x, y, z0], q);
                }
                for step in steps('I') {
                    let x = fx + step * away(fx, x);
                    self.touch_from([x, y0, z0], [x, y, z0], q);
                }
            }
            other => panic!("P{other} is not known to the judge"),
        }
    }
}

/// Call in a line, with its letters.
fn called(line: &str) -> Option<(u32, BTreeMap<char, f64>)> {
    let (number, letters) = owed::macro_call(line)?;
    Some((number, letters.into_iter().collect()))
}

/// Runs the calls of a program: the contacts as ball centres in work coordinates.
fn judged(text: &str, faces: &[Face]) -> Vec<[f64; 3]> {
    let mut judge = Judge::of(faces);
    for (number, letters) in text.lines().filter_map(called) {
        judge.call(number, &letters);
    }
    judge
        .contacts
        .iter()
        .map(|[x, y, tip]| [*x, *y, tip + BALL])
        .collect()
}

/// Contacts of the plan's own run, in order.
fn of_plan(plan: &Plan) -> Vec<[f64; 3]> {
    // Each is made twice, fast and slow.
    let mut made: Vec<usize> = plan
        .moves
        .iter()
        .filter(|step| step.kind == "touch")
        .filter_map(|step| step.touch)
        .collect();
    assert!(made.chunks(2).all(|pair| pair[0] == pair[1]), "{made:?}");
    made.dedup();
    made.into_iter()
        .map(|k| plan.triggers[k].unwrap())
        .collect()
}

pub(super) fn own(cycle: &str, post: &str, changes: &[(&str, Value)]) -> Value {
    let job = touchpath::job::default_job(cycle).unwrap();
    let job = with(&job, "control.post", Value::Text(post.to_owned()));
    let job = with(&job, "control.form", Value::Text("cycle".to_owned()));
    changes
        .iter()
        .fold(job, |job, (path, value)| with(&job, path, value.clone()))
}

/// The faces by hand, of the default dimensions, shifted by the part's offset.
#[test]
fn the_judge_touches_where_the_plan_does() {
    let (dx, dy, dz) = (0.4, -0.3, 0.2);
    let hole = [Face::Circle([dx, dy], 20.0)];
    // Walls at a distance from the middle, along a direction: facing each other, or outwards.
    let walls = |degrees: f64, half: f64, inside: bool| {
        let (s, c) = degrees.to_radians().sin_cos();
        let sign = if inside { -1.0 } else { 1.0 };
        [[c, s], [-c, -s]].map(|n| {
            Face::Wall(
                [n[0] * sign, n[1] * sign],
                sign * (n[0] * dx + n[1] * dy + half),
            )
        })
    };
    let pocket = |turn: f64, inside: bool| {
        [walls(turn, 40.0, inside), walls(turn + 90.0, 25.0, inside)].concat()
    };
    let corner = |inside: bool| {
        // Outside, the part is to the right of the corner and above it.
        let n = if inside { 1.0 } else { -1.0 };
        vec![Face::Wall([n, 0.0], n * dx), Face::Wall([0.0, n], n * dy)]
    };
    let turn = |x: f64| vec![("cycle.rotation", number(x))];
    let angular = vec![
        ("cycle.variant", number(1.0)),
        ("cycle.startAngle", number(20.0)),
        ("cycle.angularStep", number(115.0)),
        ("cycle.stepCount", number(3.0)),
    ];
    let mut web_top = walls(0.0, 15.0, false).to_vec();
    web_top.push(Face::Top(dz));
    let mut triple = corner(false);
    triple.push(Face::Top(dz));
    type Case = (&'static str, Vec<(&'static str, Value)>, Vec<Face>);
    let cases: Vec<Case> = vec![
        ("surface", vec![], vec![Face::Top(dz)]),
        (
            "surface",
            vec![
                ("cycle.elevation", number(0.0)),
                ("cycle.rotation", number(180.0)),
            ],
            vec![Face::Wall([-1.0, 0.0], -dx)],
        ),
        (
            "surface",
            vec![
                ("cycle.elevation", number(0.0)),
                ("cycle.rotation", number(30.0)),
            ],
            vec![Face::Wall(
                [0.75f64.sqrt(), 0.5],
                0.75f64.sqrt() * dx + 0.5 * dy,
            )],
        ),
        ("hole", vec![], hole.to_vec()),
        ("hole", angular.clone(), hole.to_vec()),
        ("hole-protected", vec![], hole.to_vec()),
        ("hole-protected", angular.clone(), hole.to_vec()),
        ("boss", vec![], hole.to_vec()),
        ("boss", angular, hole.to_vec()),
        ("internal-rectangle", vec![], pocket(0.0, true)),
        ("internal-rectangle", turn(30.0), pocket(30.0, true)),
        (
            "internal-rectangle-protected",
            turn(90.0),
            pocket(90.0, true),
        ),
        (
            "internal-rectangle-protected",
            turn(-20.0),
            pocket(-20.0, true),
        ),
        ("external-rectangle", vec![], pocket(0.0, false)),
        ("external-rectangle", turn(120.0), pocket(120.0, false)),
        ("web", vec![], walls(0.0, 15.0, false).to_vec()),
        ("web", turn(45.0), walls(45.0, 15.0, false).to_vec()),
        ("web-three-points", vec![], web_top),
        ("groove", turn(90.0), walls(90.0, 15.0, true).to_vec()),
        (
            "groove-protected",
            turn(10.0),
            walls(10.0, 15.0, true).to_vec(),
        ),
        ("double-wall-internal-corner", vec![], corner(true)),
        (
            "double-wall-internal-corner",
            vec![("cycle.count1", number(1.0)), ("cycle.count2", number(1.0))],
            corner(true),
        ),
        ("double-wall-external-corner", vec![], corner(false)),
        ("triple-wall-external-corner", vec![], triple),
        // Two holes of 20, at X−30 and X30.
        (
            "probing-two-circles",
            vec![],
            [-30.0, 30.0]
                .map(|x| Face::Circle([x + dx, dy], 10.0))
                .to_vec(),
        ),
    ];
    let mut touches = 0;
    let placed = cases
        .iter()
        .flat_map(|case| PLACES.map(|place| (place, case)));
    for (place, (cycle, changes, faces)) in placed {
        // The two circles have their own positions.
        if *cycle == "probing-two-circles" && place != PLACES[0] {
            continue;
        }
        let mut changes = changes.clone();
        let faces: Vec<Face> = faces.iter().map(|face| face.moved(place)).collect();
        if place != PLACES[0] {
            changes.push(("cycle.origin", list(place)));
        }
        changes.push(("part.offset", list([dx, dy, dz])));
        let calls_of = |post: &str| {
            let text = plan(&own(cycle, post, &changes))
                .unwrap_or_else(|e| panic!("{post} {cycle}: {:?}", e.findings))
                .program
                .text;
            text.lines()
                .filter_map(called)
                .filter(|(number, _)| !matches!(number, 9832 | 9833))
                .collect::<Vec<_>>()
        };
        for post in calling_macros() {
            assert_eq!(calls_of(post), calls_of("fanuc"), "{post}");
        }
        let plan = plan(&own(cycle, "fanuc", &changes))
            .unwrap_or_else(|error| panic!("{cycle} {changes:?}: {:?}", error.findings));
        let (wanted, found) = (judged(&plan.program.text, &faces), of_plan(&plan));
        assert_eq!(
            wanted.len(),
            found.len(),
            "{cycle} {changes:?}\n{}",
            plan.program.text
        );
        for (a, b) in wanted.iter().zip(&found) {
            // Numbers of a program have three decimals.
            let off = (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>().sqrt();
            assert!(
                off < 2e-3,
                "{cycle} {changes:?}: {a:?} and {b:?}\n{}",
                plan.program.text
            );
            touches += 1;
        }
        // The results of the control are the true values of a part that is only shifted.
        for row in plan
            .results
            .iter()
            .filter(|row| row.truth.is_some() && row.value.is_some())
        {
            let off = (row.value.unwrap() - row.truth.unwrap()).abs();
            let second_order = row.code == "diameter" || row.code.starts_with("center");
            assert!(
                off < if second_order { 2e-2 } else { 1e-6 },
                "{cycle} {}: {off}",
                row.code
            );
        }
    }
    assert!(touches >= 130, "{touches}");
}

/// Features that the macros do not support are refused, with field and reason.
#[test]
fn what_no_macro_does_is_refused() {
    let refused = |cycle: &str, changes: &[(&str, Value)]| -> Vec<String> {
        let error = plan(&own(cycle, "haas", changes)).expect_err("refused");
        let errors = error
            .findings
            .iter()
            .filter(|finding| finding.level == touchpath::form::Level::Error);
        errors
            .map(|finding| format!("{} {}", finding.code, finding.path))
            .collect()
    };
    let text = |word: &str| Value::Text(word.to_owned());
    assert_eq!(
        refused("hole", &[("overtravel", number(3.0))]),
        ["overtravel-too-short overtravel"]
    );
    assert_eq!(
        refused("hole", &[("plane", text("G18"))]),
        ["plane-unsupported plane"]
    );
    assert_eq!(
        refused("web", &[("cycle.sideClearance", number(3.1))]),
        ["touch-too-short cycle.sideClearance"]
    );
    assert_eq!(
        refused("surface", &[("cycle.elevation", number(40.0))]),
        ["cycle-not-parallel cycle.elevation"]
    );
    assert_eq!(
        refused(
            "double-wall-internal-corner",
            &[("cycle.rotation", number(5.0))]
        ),
        ["cycle-not-parallel cycle.rotation"]
    );
    assert_eq!(
        refused(
            "double-wall-internal-corner",
            &[("cycle.angle", number(80.0))]
        ),
        ["cycle-not-parallel cycle.rotation"]
    );
    assert_eq!(
        refused(
            "double-wall-internal-corner",
            &[("cycle.count1", number(3.0))]
        ),
        ["cycle-chooses-points cycle.count1"]
    );
    // The macro touches only along X and Y.
    assert_eq!(
        refused("hole", &[("cycle.rotation", number(45.0))]),
        ["cycle-not-parallel cycle.rotation"]
    );
    let two = [
        ("cycle.variant", number(1.0)),
        ("cycle.angularStep", number(180.0)),
        ("cycle.stepCount", number(4.0)),
    ];
    assert_eq!(
        refused("boss", &two),
        ["cycle-chooses-points cycle.stepCount"]
    );
    let five = [
        ("cycle.variant", number(1.0)),
        ("cycle.angularStep", number(72.0)),
        ("cycle.stepCount", number(5.0)),
    ];
    assert_eq!(
        refused("hole", &five),
        ["cycle-chooses-points cycle.stepCount"]
    );
    // Both macros of a rotated rectangle write both axes.
    let turned = [
        ("cycle.rotation", number(30.0)),
        ("control.workOffset", number(1.0)),
    ];
    assert_eq!(
        refused("internal-rectangle", &turned),
        ["offset-measured-again control.workOffset"]
    );
}

/// The letters by hand: a web along Y of 30 with a clearance of 6 and an overtravel of 5 for a ball of 6, into G54.1 P2, with limits; in inch; results of the
/// first of two calls are saved.
#[test]
fn the_letters_of_a_call_are_the_jobs() {
    let calls = |cycle: &str, post: &str, changes: &[(&str, Value)]| -> Vec<String> {
        let text = plan(&own(cycle, post, changes)).unwrap().program.text;
        text.lines()
            .filter(|line| line.starts_with("G65") || line.starts_with('#'))
            .map(str::to_owned)
            .collect()
    };
    let web = [
        ("cycle.rotation", number(90.0)),
        ("cycle.sideClearance", number(6.0)),
        ("control.workOffset", number(8.0)),
        ("limits.position", number(0.2)),
        ("control.report", Value::Text("log".to_owned())),
    ];
    let fanuc = calls("web", "fanuc", &web);
    assert_eq!(fanuc[4], "G65 P9812 Y30. Q2. Z-13. R3. H0.5 M0.4 S102. W1.");
    assert_eq!(
        calls("web", "haas", &web)[4],
        "G65 P9812 Y30. Q2. Z-13. R3. H0.5 M0.4 S154.02 W1."
    );
    let pocket = calls("internal-rectangle", "haas", &[]);
    assert_eq!(
        pocket[4..8],
        [
            "G65 P9812 X80. Q2. H0.5",
            "#101=#185",
            "#102=#188",
            "G65 P9812 Y50. Q2. H0.5"
        ]
    );
    let inch =
        plan(&touchpath::job::convert_units(&own("hole", "fanuc", &[]), "inch").unwrap()).unwrap();
    assert!(
        inch.program.text.contains("\nG20\n")
            && inch
                .program
                .text
                .contains("G65 P9814 D1.5748 Q0.07874 H0.01969\n"),
        "{}",
        inch.program.text
    );
    // The angle of a wall, not of the touch; a corner without a second touch has no angle to judge.
    assert_eq!(
        calls("web", "fanuc", &[("cycle.rotation", number(30.0))])[4],
        "G65 P9822 A120. D30. Q5. Z-13. R5. H0.5"
    );
    let single = calls(
        "double-wall-internal-corner",
        "fanuc",
        &[("cycle.count1", number(1.0)), ("cycle.count2", number(1.0))],
    );
    assert_eq!(single[4], "G65 P9815 X0. Y0. Q2.");
}

/// The same call on each control, by hand: the first of a rectangle's two, the variables that save its results, and the start and end of the program.
#[test]
fn each_control_has_its_own_words() {
    let text = |post: &str, offset: f64| {
        plan(&own(
            "internal-rectangle",
            post,
            &[("control.workOffset", number(offset))],
        ))
        .unwrap()
        .program
        .text
    };
    let has = |post: &str, offset: f64, lines: &[&str]| {
        let text = text(post, offset);
        let mut left = text.lines();
        for line in lines {
            assert!(
                left.any(|there| there == *line),
                "{post}: {line} in\n{text}"
            );
        }
    };
    has(
        "mazak",
        7.0,
        &[
            "%",
            "O1000(POCKET-80X50)",
            "G21",
            "M5",
            "G54.1 P1",
            "G65 P9832",
            "G65 P9812 X80. Q2. H0.5 S101.",
            "#101=#135",
            "#102=#138",
            "G65 P9833",
            "M30",
            "%",
        ],
    );
    has(
        "brother",
        7.0,
        &[
            "G17 G40 G80 G90 G94",
            "G54.1 P1",
            "G65 P8832",
            "G65 P8812 X80. Q2. H0.5 S101.",
            "#101=#135",
            "G65 P8833",
            "M30",
        ],
    );
    has(
        "hurco",
        6.0,
        &[
            "%",
            "O1000(POCKET-80X50)",
            "G21",
            "G59",
            "G65 P9812 X80. Q2. H0.5 S6.",
            "#101=#185",
            "#102=#188",
            "M30",
            "%",
        ],
    );
    has(
        "okuma",
        7.0,
        &[
            "O1000(POCKET-80X50)",
            "G21",
            "G15 H7",
            "CALL O9832",
            "CALL O9812 PX=80. PQ=2. PH=0.5 PS=7.",
            "VC101=VS75",
            "VC102=VS78",
            "CALL O9833",
            "M2",
        ],
    );
    // A Brother has the units of its settings, no tape sign and no number; a Hurco switches the probe automatically.
    let brother = text("brother", 1.0);
    assert!(
        !brother.contains("G21") && !brother.contains('%') && !brother.contains("O1000"),
        "{brother}"
    );
    assert!(!text("hurco", 1.0).contains("983"));
    let findings = |post: &str, cycle: &str, changes: &[(&str, Value)]| -> Vec<String> {
        let found = touchpath::job::check(&own(cycle, post, changes));
        found
            .iter()
            .map(|finding| finding.code.to_owned())
            .collect()
    };
    let turned = [("cycle.rotation", number(30.0))];
    for (post, seen) in [
        ("fanuc", true),
        ("mazak", true),
        ("hurco", true),
        ("brother", false),
        ("okuma", false),
    ] {
        assert_eq!(
            findings(post, "groove", &turned).contains(&"macro-not-seen".to_owned()),
            !seen,
            "{post}"
        );
        assert!(
            !findings(post, "groove", &[]).contains(&"macro-not-seen".to_owned()),
            "{post}"
        );
        assert_eq!(
            findings(post, "hole", &[]).contains(&"units-not-stated".to_owned()),
            post == "brother"
        );
    }
    assert!(findings("hurco", "probe-on-off", &[]).contains(&"form-unsupported".to_owned()));
    assert!(
        findings("mazak", "hole", &[("control.number", number(9814.0))])
            .contains(&"number-protected".to_owned())
    );
    assert!(
        findings("okuma", "hole", &[("control.orient", number(90.0))])
            .contains(&"orient-unsupported".to_owned())
    );
    assert!(
        !plan(&own("hole", "okuma", &[("control.orient", number(90.0))]))
            .unwrap()
            .program
            .text
            .contains("\nM19")
    );
}

/// 1411: from feature to feature; results of the first circle are saved before the second clears them, and S comes after the last measurement.
#[test]
fn two_circles_are_measured_from_feature_to_feature() {
    let given = [
        ("control.workOffset", number(3.0)),
        ("cycle.transferPosition", number(2.0)),
        ("limits.angle", Value::Null),
    ];
    let planned = plan(&own("probing-two-circles", "fanuc", &given)).unwrap();
    let calls: Vec<&str> = planned
        .program
        .text
        .lines()
        .filter(|line| line.starts_with("G65 P98") && !line.contains("P9810"))
        .collect();
    assert_eq!(
        calls,
        [
            "G65 P9832",
            "G65 P9814 D20. Q5. H0.5",
            "G65 P9834",
            "G65 P9814 D20. Q5. H0.5 S3.",
            "G65 P9834 X60. Y0.",
            "G65 P9833"
        ]
    );
    // Without a write the angle is checked.
    let measures = plan(&own("probing-two-circles", "fanuc", &[])).unwrap();
    assert!(
        measures.program.text.contains("\nG65 P9834 X60. Y0. B1.\n"),
        "{}",
        measures.program.text
    );
    let job = own("probing-two-circles", "fanuc", &given);
    let stored: Vec<(&str, &str)> = planned
        .results
        .iter()
        .filter_map(|row| Some((row.code.as_str(), row.stored.as_deref()?)))
        .collect();
    assert_eq!(
        stored,
        [
            ("Q950", "#101"),
            ("Q951", "#102"),
            ("Q953", "#104"),
            ("Q954", "#105"),
            ("Q964", "#144"),
            ("Q966", "#103"),
            ("Q967", "#106")
        ]
    );
    let refused = |transfer: f64| {
        plan(&with(&job, "cycle.transferPosition", number(transfer)))
            .unwrap_err()
            .findings
    };
    for transfer in [1.0, 3.0] {
        assert!(
            refused(transfer)
                .iter()
                .any(|finding| finding.code == "offset-measured-again")
        );
    }
    // DIST and the distance to a contact determine the search past it; the job's overtravel has no effect here.
    for overtravel in [5.0, 60.0] {
        let late = [
            ("stylus.diameter", number(4.0)),
            ("cycle.setUpClearance", number(7.0)),
            ("overtravel", number(overtravel)),
        ];
        let findings = plan(&own("probing-two-circles", "fanuc", &late))
            .unwrap_err()
            .findings;
        assert!(
            findings
                .iter()
                .any(|f| f.code == "overtravel-too-short" && f.path == "cycle.probe.dist"),
            "{findings:?}"
        );
    }
    // Probe on and off.
    for (on, line) in [(true, "\nG65 P9832\nM30\n"), (false, "\nG65 P9833\nM30\n")] {
        let program = plan(&own(
            "probe-on-off",
            "haas",
            &[("cycle.on", Value::Flag(on))],
        ))
        .unwrap()
        .program;
        assert!(program.text.contains(line), "{}", program.text);
    }
}

/// Results are in the variables of the macros, or saved.
#[test]
fn results_have_the_controls_own_names() {
    let names = |cycle: &str, post: &str| -> Vec<(String, Option<String>)> {
        plan(&own(cycle, post, &[]))
            .unwrap()
            .results
            .into_iter()
            .map(|row| (row.code, row.stored))
            .collect()
    };
    let row = |code: &str, name: &str| (code.to_owned(), Some(name.to_owned()));
    assert_eq!(
        names("hole", "fanuc"),
        [
            row("center.x", "#135"),
            row("center.y", "#136"),
            row("diameter", "#138")
        ]
    );
    assert_eq!(
        names("web-three-points", "haas"),
        [
            row("center.x", "#101"),
            row("width", "#102"),
            row("height", "#187")
        ]
    );
    let job = touchpath::job::default_job("hole").unwrap();
    assert!(
        plan(&job)
            .unwrap()
            .results
            .iter()
            .all(|row| row.stored.is_none()),
        "a program of moves says it in its header"
    );
}

/// Run as a foreign text, the program makes the plan's moves on the plan's part.
#[test]
fn the_program_runs_as_its_plan() {
    use touchpath::import::toolpath::{Feature, RunInputs, run_program};
    let mut seen = 0;
    let two = "probing-two-circles";
    for cycle in [
        "surface",
        "hole",
        "boss",
        "internal-rectangle-protected",
        "web",
        "double-wall-external-corner",
        two,
    ] {
        let job = own(cycle, "fanuc", &[("part.offset", list([0.3, 0.2, 0.1]))]);
        let plan = plan(&job).unwrap();
        let start = plan.moves[0].to;
        let known = RunInputs {
            feature: Feature::of(&job),
            start: Some([start[0], start[1], start[2] + 20.0]),
            ..RunInputs::default()
        };
        let run = run_program(&plan.program.text, &known);
        let contacts: Vec<[f64; 3]> = run
            .contacts
            .iter()
            .map(|c| [c[1], c[2], c[3] + BALL])
            .collect();
        let wanted: Vec<[f64; 3]> = of_plan(&plan)
            .into_iter()
            .flat_map(|place| [place, place])
            .collect();
        assert_eq!(
            contacts.len(),
            wanted.len(),
            "{cycle}: {:?}\n{}",
            run.findings,
            plan.program.text
        );
        for (a, b) in contacts.iter().zip(&wanted) {
            assert!(
                (0..3).all(|i| (a[i] - b[i]).abs() < 2e-3),
                "{cycle}: {a:?} and {b:?}"
            );
            seen += 1;
        }
        assert!(
            run.rules.iter().all(|rule| rule.holds != Some(false)),
            "{cycle}: {:?}",
            run.rules
        );
    }
    assert!(seen >= 50, "{seen}");
}

/// A part that is so far off that a macro would stop: values that are not measured are unknown, and nothing is claimed after the alarm.
#[test]
fn an_alarm_ends_the_macro() {
    let far = plan(&own(
        "hole",
        "fanuc",
        &[("part.offset", list([0.0, 9.0, 0.0]))],
    ))
    .unwrap();
    assert!(
        far.triggers.iter().any(Option::is_none)
            && far.results.iter().all(|row| row.value.is_none()),
        "{:?}",
        far.results
    );
    let missed: Vec<Vec<String>> = far
        .findings
        .iter()
        .filter(|f| f.code == "no-contact")
        .map(values)
        .collect();
    assert!(
        missed.len() == 1 && missed[0][0] == "2",
        "the second touch: {missed:?}"
    );
    // Beside a boss the move down collides.
    let met = plan(&own(
        "boss",
        "fanuc",
        &[("part.offset", list([0.0, -8.0, 0.0]))],
    ))
    .unwrap();
    assert!(
        met.findings
            .iter()
            .any(|finding| finding.code == "collision"),
        "{:?}",
        met.findings
    );
    assert!(met.results.iter().all(|row| row.value.is_none()));
}

/// Every program of calls is read back as its job; a changed value is reported.
#[test]
fn a_program_of_calls_comes_back_as_its_job() {
    let mut read = 0;
    for cycle in touchpath::cycle::CYCLES {
        for post in calling_macros() {
            // All except the NC action and the angle of a wall, and a Hurco's switch.
            if (find(post).unwrap().supports)(cycle.probes, ProgramForm::Cycle).is_err() {
                continue;
            }
            let planned = plan(&own(cycle.key, post, &[])).unwrap();
            let back = crate::common::import(&planned.program.text)
                .unwrap_or_else(|error| panic!("{}: {error:?}", cycle.key));
            let again = plan(&back.job).unwrap().program.text;
            assert_eq!(again, planned.program.text, "{}", cycle.key);
            assert!(
                back.findings
                    .iter()
                    .all(|finding| finding.code != "program-differs"),
                "{:?}",
                back.findings
            );
            let changed = planned
                .program
                .text
                .replacen(" Q2.", " Q3.", 1)
                .replacen(" PQ=2.", " PQ=3.", 1);
            if changed != planned.program.text {
                let found = crate::common::import(&changed).unwrap().findings;
                assert!(
                    found
                        .iter()
                        .any(|finding| finding.code == "program-differs"),
                    "{found:?}"
                );
            }
            read += 1;
        }
    }
    assert!(read >= 6 * 17 - 1, "{read}");
}
