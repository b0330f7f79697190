//! Tools that a program of moves corrects by the mean error of several parts: the blocks, series of parts on simulated controls, refusals and broken programs.

use std::collections::HashMap;

use crate::common::fanuc::Control;
use crate::common::sinumerik::Machine;
use crate::common::{Draws, job, mpf, number, planned, point, refused, with};
use touchpath::form::Value;
use touchpath::job::{Plan, check_program, convert_units};

const WEAR: &str = r#"{ "tool": 5, "percent": 50, "deadBand": 0.005, "parts": 3, "store": 520 }"#;

/// A cycle on a control, with the wear of one result.
fn corrects(control: &str, cycle: &str, code: &str, wear: &str) -> Value {
    let position = if code.ends_with('z') { "0.5" } else { "null" };
    job(&format!(
        r#"{{ "format": 1, "cycle": {cycle}, "control": {control}, "limits": {{ "position": {position}, "size": 0.5 }},
            "tolerances": {{ "{code}": {{ "tolerance": "±0.05", "wear": {wear} }} }} }}"#
    ))
}

const BORE: &str = r#"{ "type": "hole", "diameter": 25 }"#;
const HAAS: &str = r#"{ "post": "haas", "toolOffsets": "diameter" }"#;

fn bore() -> Value {
    corrects(HAAS, BORE, "diameter", WEAR)
}

/// The blocks, by hand: 0.5 of the mean error of a bore's diameter, in a register of diameters.
#[test]
fn a_haas_changes_the_diameter_wear_by_half_of_the_mean() {
    let plan = planned(&bore());
    let text = &plan.program.text;
    let wanted = "\
IF [ABS[#103-25.] GT 0.5] GOTO 9061
IF [ABS[#104] GT 0.1] GOTO 9062
(TOOL 5, DIAMETER WEAR: 50 % OF THE MEAN ERROR OF 3 PARTS. #520 IS THEIR)
(NUMBER, #521 THE SUM: SET BOTH TO 0 FOR A NEW SERIES)
#123=#520+1
#124=#521+#103-25.
IF [ABS[#521] GT #520*0.5+0.0001] GOTO 9063
IF [#520 GT 2] GOTO 9063
#125=0
IF [#123 LE 2] GOTO 2
#125=#124/3
#123=0
#124=0
IF [ABS[#125] GT 0.005] GOTO 3
#125=0
N3
#125=#125*0.5
N2
IF [#119 NE 4] GOTO 9006
#119=0
#520=#123
#521=#124
#2605=#2605+#125
#125=0
";
    assert!(text.contains(wanted), "{text}");
    assert!(text.contains("#3000=33(RESET #520 AND #521)"), "{text}");
    assert_eq!(plan.program.does, "corrects tool offset 5");
    assert!(
        text.replace(")\n(", " ").contains(
            "CORRECTS TOOL OFFSET 5: BY THE MEAN ERROR OF SEVERAL PARTS, AT THE VERY END. NO WORK OFFSET IS WRITTEN"
        ),
        "{text}"
    );
}

/// Registers by the tables of the reference sheets, and the change for a mean error of 1: inside larger, outside smaller, twice that by diameter, and a surface
/// that is too high needs a shorter tool.
#[test]
fn each_control_has_its_register_and_each_side_its_sign() {
    let boss = r#"{ "type": "boss", "diameter": 25 }"#;
    let surface = r#"{ "type": "surface" }"#;
    let all = [
        (HAAS, BORE, "diameter", "#2605=#2605+", "*0.5"),
        (HAAS, boss, "diameter", "#2605=#2605+", "*[-0.5]"),
        (HAAS, surface, "point.z", "#2205=#2205+", "*[-0.5]"),
        (
            r#"{ "post": "haas", "toolOffsets": "radius" }"#,
            boss,
            "diameter",
            "#2605=#2605+",
            "*[-0.25]",
        ),
        (
            r#"{ "post": "fanuc", "toolOffsets": "radius" }"#,
            BORE,
            "diameter",
            "#12005=#12005+",
            "*0.25",
        ),
        (
            r#"{ "post": "fanuc", "toolOffsets": "diameter" }"#,
            surface,
            "point.z",
            "#10005=#10005+",
            "*[-0.5]",
        ),
        (
            r#"{ "post": "fanuc", "toolOffsets": "memory-a-radius" }"#,
            boss,
            "diameter",
            "#2005=#2005+",
            "*[-0.25]",
        ),
        (
            r#"{ "post": "fanuc", "toolOffsets": "memory-a-diameter" }"#,
            BORE,
            "diameter",
            "#2005=#2005+",
            "*0.5",
        ),
        (
            r#"{ "post": "sinumerik" }"#,
            boss,
            "diameter",
            "$TC_DP15[5,1]=$TC_DP15[5,1]+R",
            "*(-0.25)",
        ),
        (
            r#"{ "post": "sinumerik" }"#,
            surface,
            "point.z",
            "$TC_DP12[5,1]=$TC_DP12[5,1]+R",
            "*(-0.5)",
        ),
    ];
    for (control, cycle, code, register, factor) in all {
        let store = if control.contains("sinumerik") {
            "90"
        } else {
            "520"
        };
        let wear = WEAR.replace("520", store);
        let text = planned(&corrects(control, cycle, code, &wear)).program.text;
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(
            lines
                .iter()
                .filter(|line| line.starts_with(register))
                .count(),
            1,
            "{control} {cycle}: {text}"
        );
        assert!(
            lines.iter().any(|line| line.ends_with(factor)),
            "{control} {cycle} {factor}: {text}"
        );
    }
}

/// A series of parts on a control that keeps its variables, or the control of a SINUMERIK.
struct Series {
    post: String,
    variables: HashMap<i64, f64>,
    r: HashMap<usize, f64>,
    tools: HashMap<(String, usize, usize), f64>,
}

impl Series {
    fn new(post: &str, store: i64, tool: usize) -> Self {
        let wear = |name: &str| ((name.to_owned(), tool, 1), 0.125);
        let mut variables = HashMap::from([(store, 0.0), (store + 1, 0.0)]);
        for table in [2000, 2200, 2600, 10_000, 12_000] {
            variables.insert(table + tool as i64, 0.125);
        }
        Series {
            post: post.to_owned(),
            variables,
            r: HashMap::from([(store as usize, 0.0), (store as usize + 1, 0.0)]),
            tools: HashMap::from([wear("$TC_DP12"), wear("$TC_DP15")]),
        }
    }

    /// Runs the program on the virtual part of a plan. Returns the alarm.
    fn run(&mut self, plan: &Plan, inch: bool) -> Option<String> {
        let text = &plan.program.text;
        if self.post == "sinumerik" {
            let mut machine = Machine::new(plan.triggers.clone());
            machine.metric = !inch;
            machine.start = [417.0, -233.0, 301.0];
            (machine.r, machine.tools) = (self.r.clone(), self.tools.clone());
            machine.run(&mpf::read(text).unwrap()).unwrap();
            (self.r, self.tools) = (machine.r, machine.tools);
            return machine.alarm.map(|_| machine.message);
        }
        let mut control = Control::new(self.post == "haas", inch);
        control.contacts = plan.triggers.iter().flatten().copied().collect();
        control.variables.clone_from(&self.variables);
        control
            .run(text)
            .unwrap_or_else(|error| panic!("{error}\n{text}"));
        self.variables = control.variables;
        control.alarm
    }

    fn kept(&self, store: i64) -> [f64; 2] {
        [0, 1].map(|k| match self.post.as_str() {
            "sinumerik" => self.r[&(store as usize + k)],
            _ => self.variables[&(store + k as i64)],
        })
    }

    /// What the registers of the tool hold, less what they held.
    fn changed(&self, tool: usize) -> Vec<(String, f64)> {
        let names = ["$TC_DP12", "$TC_DP15"].map(|name| (name.to_owned(), tool, 1));
        let tables = [2000, 2200, 2600, 10_000, 12_000];
        let own = match self.post.as_str() {
            "sinumerik" => names
                .iter()
                .map(|name| (name.0.clone(), self.tools[name]))
                .collect::<Vec<_>>(),
            _ => tables
                .iter()
                .map(|table| (table.to_string(), self.variables[&(table + tool as i64)]))
                .collect(),
        };
        own.into_iter()
            .map(|(name, value)| (name, value - 0.125))
            .filter(|(_, change)| change.abs() > 1e-12)
            .collect()
    }
}

/// Random jobs, each with a series of parts: number, sum and register follow the rule of the sheet, counted by hand here from the sizes of the parts.
#[test]
fn a_series_of_parts_changes_the_tool_as_counted_by_hand() {
    let mut random = Draws(71);
    let (mut changes, mut banded, mut stopped) = (0, 0, 0);
    // Cycle, result, its path in the virtual part, and the change of a radius or a length for an error of 1.
    let features = [
        (
            r#"{ "type": "hole", "diameter": 25 }"#,
            "diameter",
            "part.sizes.diameter",
            0.5_f64,
        ),
        (
            r#"{ "type": "hole-protected", "diameter": 30 }"#,
            "diameter",
            "part.sizes.diameter",
            0.5_f64,
        ),
        (
            r#"{ "type": "boss", "diameter": 25 }"#,
            "diameter",
            "part.sizes.diameter",
            -0.5,
        ),
        (
            r#"{ "type": "internal-rectangle" }"#,
            "width2",
            "part.sizes.width2",
            0.5,
        ),
        (
            r#"{ "type": "external-rectangle" }"#,
            "width1",
            "part.sizes.width1",
            -0.5,
        ),
        (r#"{ "type": "groove" }"#, "width", "part.sizes.width", 0.5),
        (r#"{ "type": "web" }"#, "width", "part.sizes.width", -0.5),
        (r#"{ "type": "surface" }"#, "point.z", "part.offset", -1.0),
    ];
    let controls = [
        ("haas", "radius", 520, [2200, 2600]),
        ("haas", "diameter", 700, [2200, 2600]),
        ("fanuc", "radius", 550, [10_000, 12_000]),
        ("fanuc", "diameter", 550, [10_000, 12_000]),
        ("fanuc", "memory-a-diameter", 998, [2000, 2000]),
        ("sinumerik", "unknown", 88, [0, 0]),
    ];
    for round in 0..60 {
        let (cycle, code, place, sense) = features[random.below(features.len())];
        let (post, offsets, store, tables) = controls[round % controls.len()];
        // The probe has the length of offset 7.
        let (tool, parts) = (8 + random.below(193), 2 + random.below(4));
        let percent = 10 * (1 + random.below(10));
        let band = [0.0, 0.01][random.below(2)];
        let control =
            format!(r#"{{ "post": "{post}", "toolOffsets": "{offsets}", "report": "none" }}"#);
        let wear = format!(
            r#"{{ "tool": {tool}, "percent": {percent}, "deadBand": {band}, "parts": {parts}, "store": {store} }}"#
        );
        let metric = corrects(&control, cycle, code, &wear);
        let inch = round % 3 == 0;
        // In G18 the tool axis is Y: z in the code of a result is the tool axis.
        let planes = if post == "sinumerik" { 2 } else { 1 };
        let plane = ["G17", "G18"][random.below(planes)];
        let metric = with(&metric, "plane", Value::Text(plane.to_owned()));
        let own = match inch {
            true => convert_units(&metric, "inch").unwrap(),
            false => metric,
        };
        let scale = if inch { 25.4 } else { 1.0 };
        let by_diameter = offsets.ends_with("diameter") && sense.abs() < 1.0;
        let factor = percent as f64 / 100.0 * sense * if by_diameter { 2.0 } else { 1.0 };
        let mut series = Series::new(post, store, tool);
        let (mut errors, mut wanted) = (Vec::new(), 0.0_f64);
        for _ in 0..2 * parts + 1 {
            let error = random.of(-0.04, 0.03) + if random.below(12) == 0 { 0.6 } else { 0.0 };
            let off = error / scale;
            let value = match place {
                "part.offset" => point(match plane {
                    "G17" => [0.0, 0.0, off],
                    _ => [0.0, off, 0.0],
                }),
                _ => number(off),
            };
            let plan = planned(&with(&own, place, value));
            let before = series.kept(store);
            let alarm = series.run(&plan, inch);
            if error.abs() > 0.5 {
                assert!(alarm.is_some(), "{post} {cycle}: {error}");
                assert_eq!(
                    series.kept(store),
                    before,
                    "an implausible part counts for nothing"
                );
                stopped += 1;
                continue;
            }
            assert_eq!(alarm, None, "{post} {cycle} {error}");
            errors.push(off);
            if errors.len() == parts {
                let mean = errors.iter().sum::<f64>() / parts as f64;
                errors.clear();
                if mean.abs() > band / scale {
                    wanted += mean * factor;
                    changes += 1;
                } else {
                    banded += 1;
                }
            }
            let [count, sum] = series.kept(store);
            assert_eq!(count, errors.len() as f64, "{post} {cycle}");
            assert!(
                (sum - errors.iter().sum::<f64>()).abs() < 1e-5,
                "{post} {cycle}: {sum}"
            );
            let changed = series.changed(tool);
            match changed.as_slice() {
                [] => assert!(wanted.abs() < 1e-6, "{post} {cycle}: {wanted}"),
                [(name, change)] => {
                    let height = usize::from(sense > -0.75);
                    let known = match post {
                        "sinumerik" => ["$TC_DP12", "$TC_DP15"][height].to_owned(),
                        _ => tables[height].to_string(),
                    };
                    assert_eq!(name, &known, "{post} {offsets} {cycle}");
                    assert!(
                        (change - wanted).abs() < 1e-5,
                        "{post} {offsets} {cycle}: {change} {wanted}"
                    );
                }
                more => panic!("{post} {cycle}: {more:?}"),
            }
        }
    }
    assert!(
        changes > 60 && banded > 5 && stopped > 10,
        "{changes} {banded} {stopped}"
    );
}

/// Values that the program does not store are those of another macro, or of a series with other settings: nothing is written.
#[test]
fn foreign_values_in_the_kept_variables_stop_the_program() {
    for (post, control, store) in [
        ("haas", HAAS, 520),
        (
            "fanuc",
            r#"{ "post": "fanuc", "toolOffsets": "radius" }"#,
            520,
        ),
        ("sinumerik", r#"{ "post": "sinumerik" }"#, 90),
    ] {
        let wear = WEAR.replace("520", &store.to_string());
        let plan = planned(&corrects(control, BORE, "diameter", &wear));
        for kept in [
            [3.0, 0.0],
            [47.25, 3.5],
            [0.0, 0.6],
            [2.0, -1.2],
            [-1.0, 0.0],
        ] {
            let mut series = Series::new(post, store, 5);
            for (k, value) in kept.into_iter().enumerate() {
                series.variables.insert(store + k as i64, value);
                series.r.insert(store as usize + k, value);
            }
            let alarm = series.run(&plan, false).expect("an alarm");
            assert!(
                alarm == "33 RESET #520 AND #521"
                    || alarm == "Set R90, R91 to 0: other values are in them. Nothing is written",
                "{alarm}"
            );
            assert_eq!(series.kept(store), kept, "{post}");
            assert_eq!(series.changed(5), [], "{post}");
        }
    }
}

/// With a work offset both are written, after one question.
#[test]
fn a_work_offset_and_a_tool_are_written_after_one_question() {
    let asks = r#"{ "post": "haas", "toolOffsets": "radius", "workOffset": 1, "ask": "always" }"#;
    let plan = planned(&corrects(asks, BORE, "diameter", WEAR));
    assert_eq!(plan.program.does, "writes G54 X Y, corrects tool offset 5");
    let text = &plan.program.text.replace(")\n(", " ");
    let at = |what: &str| text.find(what).unwrap_or_else(|| panic!("{what}: {text}"));
    let order = [
        "CYCLE START WRITES THE WORK OFFSET AND CORRECTS THE TOOL. RESET LEAVES BOTH UNCHANGED)\n",
        "\nM0\n",
        "GOTO 9006\n",
        "\n#5221=#5221+",
        "\n#520=#",
        "\n#2605=#2605+",
    ];
    assert!(
        order.windows(2).all(|two| at(two[0]) < at(two[1])),
        "{text}"
    );
    assert_eq!(text.matches("\nM0\n").count(), 1, "{text}");
    // Alone it asks as well.
    let alone = r#"{ "post": "fanuc", "toolOffsets": "radius", "ask": "outside" }"#;
    let plan = planned(&corrects(alone, BORE, "diameter", WEAR));
    assert!(
        plan.program
            .text
            .replace(")\n(", " ")
            .contains("CYCLE START CORRECTS THE TOOL. RESET LEAVES IT UNCHANGED)"),
        "{}",
        plan.program.text
    );
}

#[test]
fn what_a_program_cannot_correct_is_refused_with_its_field() {
    let wear = |change: &[(&str, &str)]| {
        let mut wear = WEAR.to_owned();
        for (old, new) in change {
            assert!(wear.contains(old));
            wear = wear.replace(old, new);
        }
        wear
    };
    let of = |control: &str, wear: &str| refused(&corrects(control, BORE, "diameter", wear));
    let at = "tolerances.diameter.wear";
    assert_eq!(
        of(r#"{ "post": "haas" }"#, WEAR),
        ["missing control.toolOffsets"]
    );
    assert_eq!(
        of(
            r#"{ "post": "haas", "toolOffsets": "memory-a-radius" }"#,
            WEAR
        ),
        ["missing control.toolOffsets"]
    );
    let each = wear(&[(r#", "parts": 3, "store": 520"#, "")]);
    assert_eq!(of(HAAS, &each), [format!("missing {at}.parts")]);
    assert_eq!(
        of(HAAS, &wear(&[("520", "20")])),
        [format!("missing {at}.store")]
    );
    assert_eq!(
        of(r#"{ "post": "sinumerik" }"#, &wear(&[("520", "99")])),
        [format!("missing {at}.store")]
    );
    assert_eq!(
        of(r#"{ "post": "sinumerik" }"#, &wear(&[("520", "20")])),
        [format!("wear-unsupported {at}.store")]
    );
    assert_eq!(
        of(HAAS, &wear(&[("\"tool\": 5", "\"tool\": 201")])),
        [format!("missing {at}.tool")]
    );
    for post in ["linuxcnc", "grbl", "fluidnc"] {
        let control = format!(r#"{{ "post": "{post}" }}"#);
        assert_eq!(
            of(&control, WEAR),
            [format!("wear-unsupported {at}")],
            "{post}"
        );
    }
    let unlimited = with(&bore(), "limits.size", Value::Null);
    assert_eq!(refused(&unlimited), ["missing limits.size"]);
    // A position is no size; a height that the work offset gets is not corrected as well.
    let x = corrects(HAAS, BORE, "center.x", WEAR);
    assert_eq!(refused(&x), ["wear-unsupported tolerances.center.x.wear"]);
    let writes = r#"{ "post": "haas", "toolOffsets": "radius", "workOffset": 1 }"#;
    let surface = r#"{ "type": "surface" }"#;
    let z = corrects(writes, surface, "point.z", WEAR);
    assert_eq!(refused(&z), ["wear-unsupported tolerances.point.z.wear"]);
    // A dry run measures nothing.
    let dry = planned(&with(&bore(), "control.run", Value::Text("dry".to_owned())));
    assert!(!dry.program.text.contains("#2605"), "{}", dry.program.text);
}

/// Two means in a set-up need two pairs of variables; each corrects its own tool.
#[test]
fn a_set_up_corrects_several_tools() {
    let text = r#"{ "format": 2, "control": { "post": "haas", "toolOffsets": "radius" },
        "cycles": [ { "name": "BORE", "type": "hole", "diameter": 25 }, { "name": "PIN", "type": "boss", "diameter": 20, "origin": [0, 100, 0] } ],
        "tolerances": { "BORE.diameter": { "tolerance": "±0.1", "wear": { "tool": 4, "parts": 2, "store": 500 } },
            "PIN.diameter": { "tolerance": "±0.1", "wear": { "tool": 9, "parts": 5, "store": 502 } } } }"#;
    let plan = planned(&job(text));
    assert_eq!(plan.program.does, "corrects tool offsets 4, 9");
    for line in ["#2604=#2604+", "#2609=#2609+", "#500=", "#503="] {
        assert!(plan.program.text.contains(&format!("\n{line}")), "{line}");
    }
    let same = job(&text.replace("502", "501"));
    assert_eq!(
        refused(&same),
        [
            "wear-unsupported tolerances.BORE.diameter.wear.store",
            "wear-unsupported tolerances.PIN.diameter.wear.store"
        ]
    );
}

/// Two widths with one tool would change its register twice: the one that counts is named. In memory A a height shares the register of a size.
#[test]
fn two_results_do_not_correct_one_register() {
    let job_of = |post: &str, offsets: &str, tools: [i32; 2]| {
        let wear = |tool: i32, store: i32| {
            format!(
                r#"{{ "tolerance": "±0.05", "wear": {{ "tool": {tool}, "parts": 3, "store": {store} }} }}"#
            )
        };
        let [first, second] = tools;
        job(&format!(
            r#"{{ "format": 2, "control": {{ "post": "{post}", "toolOffsets": "{offsets}" }}, "limits": {{ "position": 0.5 }},
                "cycles": [ {{ "name": "TOP", "type": "surface" }}, {{ "name": "POCKET", "type": "internal-rectangle", "origin": [0, 100, 0] }} ],
                "tolerances": {{ "POCKET.width1": {}, "POCKET.width2": {}, "TOP.point.z": {} }} }}"#,
            wear(first, 500),
            wear(second, 502),
            wear(8, 504),
        ))
    };
    let at = |result: &str| format!("wear-unsupported tolerances.{result}.wear.tool");
    let widths = [at("POCKET.width1"), at("POCKET.width2")];
    for offsets in ["radius", "diameter"] {
        assert_eq!(refused(&job_of("haas", offsets, [5, 5])), widths);
        assert_eq!(refused(&job_of("fanuc", offsets, [5, 5])), widths);
        // Length and radius of one tool have a register each.
        let text = planned(&job_of("haas", offsets, [5, 8])).program.text;
        assert!(
            text.contains("#2608=#2608+") && text.contains("#2208=#2208+"),
            "{text}"
        );
    }
    assert_eq!(
        refused(&job_of("fanuc", "memory-a-radius", [5, 8])),
        [at("POCKET.width2"), at("TOP.point.z")]
    );
}

/// Each changed block is a program that is not proven, or that breaks a rule.
#[test]
fn a_changed_block_does_not_pass() {
    let broken = |job: &Value, old: &str, new: &str| {
        let text = planned(job).program.text;
        assert!(text.contains(old), "{old}: {text}");
        match check_program(job, &text.replacen(old, new, 1)).unwrap() {
            Err(_) => Vec::new(),
            Ok(rows) => rows
                .iter()
                .filter(|row| row.holds == Some(false))
                .map(|row| row.rule)
                .collect(),
        }
    };
    let job = bore();
    let unproven: Vec<&str> = Vec::new();
    for (old, new) in [
        ("#125=#125*0.5\n", "#125=#125*0.6\n"),
        ("#125=#125*0.5\n", "#125=#125*[-0.5]\n"),
        ("#2605=#2605+#125", "#2605=#2605-#125"),
        ("#2605=#2605+#125", "#2606=#2606+#125"),
        ("#2605=#2605+#125", "#2205=#2205+#125"),
        ("#2605=#2605+#125\n", "#2605=#2605+#125\n#2205=#2205+#125\n"),
        ("#2605=#2605+#125\n", "\n"),
        ("#125=#124/3\n", "#125=#124/4\n"),
        ("#123=0\n", "\n"),
        ("#520=#123\n", "\n"),
        ("#521=#124\n", "#521=#123\n"),
        ("GT 0.005]", "GT 0.006]"),
        ("[#123 LE 2]", "[#123 LE 1]"),
        ("#124=#521+#103-25.", "#124=#521+#103-25.01"),
        ("IF [ABS[#521] GT #520*0.5+0.0001] GOTO 9063\n", "\n"),
        ("IF [#520 GT 2] GOTO 9063\n", "\n"),
    ] {
        assert_eq!(broken(&job, old, new), unproven, "{old} {new}");
    }
    assert_eq!(
        broken(&job, "#2605=#2605+#125\n#125=0\n", "#2605=#2605+#125\n"),
        ["restart-writes-nothing"],
        "started again at the write, the tool is corrected once more"
    );
    let early = broken(&job, "IF [#119 NE 4] GOTO 9006\n", "\n");
    assert_eq!(early, ["restart-writes-nothing"]);
}

/// By hand: -0.02 in a bore, half of it, as a radius: -0.005.
#[test]
fn what_the_tool_gets_is_said() {
    let said = |offsets: &str, off: f64| {
        let control = format!(r#"{{ "post": "haas", "toolOffsets": "{offsets}" }}"#);
        let job = corrects(&control, BORE, "diameter", WEAR);
        let plan = planned(&with(&job, "part.sizes.diameter", number(off)));
        let mut found = plan
            .findings
            .into_iter()
            .filter(|finding| finding.code == "tool-corrected");
        found.next().unwrap().message
    };
    assert_eq!(
        said("radius", -0.02),
        "Diameter is off by -0.02 mm: after 3 parts like this one the program changes the radius wear of tool 5 by -0.005 mm"
    );
    assert_eq!(
        said("diameter", 0.03),
        "Diameter is off by 0.03 mm: after 3 parts like this one the program changes the diameter wear of tool 5 by 0.015 mm"
    );
    assert_eq!(
        said("radius", 0.004),
        "Diameter is off by 0.004 mm: 3 parts like this one leave the radius wear of tool 5 as it is"
    );
    assert_eq!(
        said("radius", 0.6),
        "Diameter is off by 0.6 mm: the program stops with an alarm, and the error does not count for tool 5"
    );
}

#[test]
fn the_header_keeps_the_setting_of_the_control() {
    let text = planned(&bore()).program.text;
    let back = crate::common::import(&text).unwrap().job;
    assert_eq!(planned(&back).program.text, text);
}
