//! Properties of a program that are proven besides its rules.

use super::*;
/// Each number of a program is changed slightly, one at a time: the proof finds it. Only blocks after the header.
#[test]
fn a_program_with_another_digit_is_not_proven() {
    let mut tried = 0;
    for (post, cycle) in [
        ("linuxcnc", "hole-protected"),
        ("grbl", "boss"),
        ("sinumerik", "double-wall-internal-corner"),
        ("fanuc", "web"),
    ] {
        let known = touchpath::control::find(post).unwrap();
        let job = job_for(cycle, post, ProgramForm::Moves, known.work_offsets > 0);
        let job = with(
            &with(&job, "cycle.rotation", number(17.0)),
            "cycle.origin",
            crate::common::point([3.25, -7.5, 1.125]),
        );
        let plan = plan(&job).unwrap();
        let lines: Vec<&str> = plan.program.text.lines().collect();
        let wanted = |line: &str| {
            let moves = ["G0 ", "G1 ", "G31 ", "G38.", "MEAS=1 "]
                .iter()
                .any(|head| line.starts_with(head));
            let computes = line.starts_with("#<")
                || (line.starts_with('R') && line.contains(" ; "))
                || line.starts_with("#10");
            moves
                || computes
                || line.starts_with("G10")
                || line.starts_with("$P_UIFR")
                || line.starts_with("#52")
        };
        let first = plan.program.move_lines[0] as usize;
        let end = lines
            .iter()
            .rposition(|line| matches!(*line, "M2" | "M30"))
            .unwrap()
            .min(
                lines
                    .iter()
                    .position(|line| *line == "M30")
                    .unwrap_or(usize::MAX),
            );
        for (at, line) in lines
            .iter()
            .enumerate()
            .take(end)
            .skip(first)
            .filter(|(_, line)| wanted(line))
        {
            for changed in other_digits(line, if post == "fanuc" { 3 } else { 5 }) {
                let mut text: Vec<&str> = lines.clone();
                text[at] = &changed;
                let proven =
                    touchpath::job::proves(&job, &text.join("\n"), &plan.program.move_lines);
                // A wrong count stops a good program, which a rule finds.
                let broken = || {
                    broken(&judged(&job, &text.join("\n")).unwrap())
                        .contains(&"plausible-before-write")
                };
                assert!(
                    !proven || (line.ends_with("+1") && broken()),
                    "{post}: line {} {line} became {changed}",
                    at + 1
                );
                tried += 1;
            }
        }
    }
    assert!(tried > 800, "{tried}");
}

/// The same line with one digit of a value replaced; names of variables, codes and axes stay.
fn other_digits(line: &str, decimals_seen: usize) -> Vec<String> {
    let code = line.split(" ; ").next().unwrap();
    let mut lines = Vec::new();
    let mut inside_name = false;
    for (at, c) in code.char_indices() {
        match c {
            '<' | '$' => inside_name = true,
            '>' | ']' => inside_name = false,
            _ => {}
        }
        let before = code[..at]
            .trim_end_matches(|c: char| c.is_ascii_digit() || c == '.')
            .chars()
            .next_back()
            .unwrap_or(' ');
        let of_value = matches!(
            before,
            'X' | 'Y' | 'Z' | 'F' | '+' | '-' | '*' | '/' | '[' | '('
        );
        // Beyond that a change is smaller than the rounding of constants: those of a Fanuc have eight digits.
        let decimals = code[..at].rsplit('.').next().map_or(0, str::len);
        let fine = code[..at].contains('.')
            && decimals > decimals_seen
            && code[..at]
                .rsplit('.')
                .next()
                .unwrap()
                .bytes()
                .all(|b| b.is_ascii_digit());
        if c.is_ascii_digit() && of_value && !inside_name && !fine {
            let other = if c == '9' { '8' } else { (c as u8 + 1) as char };
            lines.push(format!("{}{other}{}", &line[..at], &line[at + 1..]));
        }
    }
    lines
}

#[test]
fn a_plan_says_its_proof_and_its_rules_in_json() {
    let plan: Plan = plan(&job_for("hole", "grbl", ProgramForm::Moves, false)).unwrap();
    let json = serde_json::to_value(&plan).unwrap();
    assert_eq!(
        json["program"]["proof"],
        serde_json::json!({ "moves": 13, "touches": 4, "arithmetic": false })
    );
    assert_eq!(
        json["safety"].as_array().unwrap().len(),
        RULES.len() - 3,
        "neither tolerances nor places that follow nor a question before the write"
    );
    let lifts = json["safety"]
        .as_array()
        .unwrap()
        .iter()
        .find(|row| row["rule"] == "missed-touch-lifts")
        .unwrap();
    assert!(lifts["holds"].is_null() && lifts["message"].as_str().unwrap().contains("alarm 5"));
}
