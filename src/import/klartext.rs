//! Reads programs back: Klartext with cycles 1411 and 1493, and their ISO form.

use crate::control::heidenhain::read::{
    Given, assignments, blocks, is_iso_word, moves, says, shown, transforms, wanted_iso,
};
use crate::cycle::CycleDef;
use crate::form::{Checker, Field, Finding, Kind, Value};
use crate::import::{Imported, program, set};
use crate::job::JobError;
use crate::job::{Units, convert_units, default_job_in, job_name, section_defaults_in};
use crate::text::text;

/// Cycle of a program without a header.
const TYPE: &str = "probing-two-circles";
/// Inner form that 1493 fills.
const EXTRUSION: &str = "extrusion";

/// A parameter of a block.
#[derive(Debug)]
struct Parameter {
    number: u32,
    /// Key in the form: `point1[0]`.
    key: String,
    /// Key of the flag for a value from GLOBAL DEF; `None` if a number is required.
    predefined: Option<&'static str>,
}

/// Parameters of a form in the order of its fields. A point is three consecutive parameters.
fn parameters(fields: &[Field]) -> Vec<Parameter> {
    let number = |field: &Field| field.code.strip_prefix('Q')?.parse::<u32>().ok();
    let predefined = |field: &Field| {
        let flag = |f: &&Field| f.key.strip_suffix("Predef") == Some(field.key);
        fields.iter().find(flag).map(|flag| flag.key)
    };
    let mut all = Vec::new();
    for field in fields {
        let Some(first) = number(field) else { continue };
        let predefined = predefined(field);
        if field.kind == Kind::NominalPoint {
            all.extend((0..3).map(|axis| Parameter {
                number: first + axis,
                key: format!("{}[{axis}]", field.key),
                predefined,
            }));
        } else {
            all.push(Parameter {
                number: first,
                key: field.key.to_owned(),
                predefined,
            });
        }
    }
    all
}

fn cycle() -> &'static CycleDef {
    crate::cycle::find(TYPE).expect("the cycle is registered")
}

/// The fields of 1493.
fn extrusion_fields() -> &'static [Field] {
    cycle()
        .sections
        .iter()
        .find(|section| section.key == EXTRUSION)
        .expect("the cycle has the form")
        .fields
}

/// Whether a text is a Klartext program.
pub fn recognises(text: &str) -> bool {
    text.contains("BEGIN PGM") || text.contains("TCH PROBE")
}

/// Makes a job from a program with a header. Changed blocks override the header.
pub fn import_with_header(text: &str) -> Result<Imported, JobError> {
    let Ok((mut job, said)) = program::read(text) else {
        return import(text);
    };
    if !said
        .iter()
        .any(|f| matches!(f.code.as_str(), "program-differs" | "header-unsound"))
    {
        return Ok(Imported::Job {
            job,
            findings: said,
        });
    }
    let mut checker = Checker::default();
    let of_header = Value::Text(TYPE.to_owned());
    if job.get("cycle").and_then(|cycle| cycle.get("type")) != Some(&of_header) {
        // A program of other cycles gives the header's job; differences are reported.
        return Ok(Imported::Job {
            job,
            findings: said,
        });
    }
    let (read, notes) = read(text)?;
    // Blocks without units are in those of the header.
    let no_units = notes.iter().any(|f| f.code == "units-unknown");
    let units = if no_units {
        Units::of(&job)
    } else {
        Units::of(&read)
    };
    if units != Units::of(&job) {
        job = convert_units(&job, units.word())?;
        let message = text!(
            "The blocks are in {units} and the header's job is not: values that only the header has are converted, and the numbers of the cycle are read in {units}",
            units.word()
        );
        checker.warning("units-differ", "units", message);
    }
    let mut keys: Vec<String> = parameters(cycle().fields)
        .iter()
        .flat_map(|one| {
            [
                Some(one.key.split('[').next().unwrap_or(&one.key)),
                one.predefined,
            ]
        })
        .flatten()
        .chain([EXTRUSION])
        .map(|key| format!("cycle.{key}"))
        .chain(["control.tool", "name", "plane"].map(str::to_owned))
        .collect();
    keys.dedup();
    for key in keys {
        let value = key
            .split('.')
            .try_fold(&read, |value, key| value.get(key))
            .cloned();
        if let Some(value) = value {
            set(&mut job, &key, value);
        }
    }
    let message = text!(
        "The blocks differ from the program of the header's job: their values are used, the rest comes from the header"
    );
    checker.warning("program-differs", "", message);
    let findings = checker
        .findings()
        .into_iter()
        .chain(
            notes
                .into_iter()
                .filter(|f| !matches!(f.code.as_str(), "not-in-program" | "units-unknown")),
        )
        .collect();
    Ok(Imported::Job { job, findings })
}

/// Makes a job from a program, with any comments, decimal points or commas, Q or QS, with or without block numbers; other blocks are ignored with a note.
/// Values that a program does not give (stylus, touch probe table, start position) have the defaults.
pub fn import(text: &str) -> Result<Imported, JobError> {
    read(text).map(|(job, findings)| Imported::Job { job, findings })
}

/// The job of a program's blocks, with findings.
fn read(text: &str) -> Result<(Value, Vec<Finding>), JobError> {
    let blocks = blocks(text);
    let units = if is_inch(&blocks) {
        Units::Inch
    } else {
        Units::Mm
    };
    let mut job = default_job_in(TYPE, units).expect("the cycle is registered");
    set(&mut job, "units", Value::Text(units.word().to_owned()));
    let mut reader = Reader {
        job,
        units,
        checker: Checker::default(),
        extrusion: Value::Null,
        found: 0,
        ignored: 0,
        has_plane: false,
        transformed: Vec::new(),
        moves: None,
        spins: None,
    };
    blocks.iter().for_each(|block| reader.block(block));
    let (mut job, findings) = reader.finish(&blocks)?;
    if !has_name(&blocks) {
        let name = job_name(&job);
        set(&mut job, "name", Value::Text(name));
    }
    Ok((job, findings))
}

/// Whether the text gives the name of its program.
fn has_name(blocks: &[String]) -> bool {
    let begins = |block: &String| {
        block.to_ascii_uppercase().starts_with("BEGIN PGM") && block.split_whitespace().count() > 3
    };
    blocks.iter().any(begins)
}

/// Whether the text is in inch.
fn is_inch(blocks: &[String]) -> bool {
    let begins = |block: &String| {
        let upper = block.to_ascii_uppercase();
        upper.starts_with("BEGIN PGM") && upper.split_whitespace().last() == Some("INCH")
    };
    blocks.iter().any(begins) || says(blocks, "G70")
}

/// State of reading.
struct Reader {
    job: Value,
    units: Units,
    checker: Checker,
    extrusion: Value,
    /// Number of cycles 1411.
    found: usize,
    ignored: usize,
    /// Whether a block states the plane.
    has_plane: bool,
    /// Shifts, rotations, mirrors and scales before the cycle.
    transformed: Vec<&'static str>,
    /// First block before the cycle that moves, and first that switches the spindle on.
    moves: Option<String>,
    spins: Option<String>,
}

impl Reader {
    fn block(&mut self, block: &str) {
        let upper = block.to_ascii_uppercase();
        let words: Vec<&str> = upper.split_whitespace().collect();
        if self.found == 0 && moves(&words) {
            self.moves.get_or_insert_with(|| shown(block));
        }
        if self.found == 0
            && words
                .iter()
                .any(|word| matches!(*word, "M3" | "M03" | "M4" | "M04" | "M13" | "M14"))
        {
            self.spins.get_or_insert_with(|| shown(block));
        }
        match words.as_slice() {
            ["BEGIN", "PGM", rest @ ..] => {
                let original: Vec<&str> = block.split_whitespace().collect();
                if rest.len() > 1 {
                    self.set("name", original[2]);
                }
            }
            ["END", "PGM", ..] | [] => {}
            // A tool called after the cycle is not the probe.
            ["TOOL", "CALL", ..] if self.found > 0 => self.ignored += 1,
            ["TOOL", "CALL", rest @ ..] => self.tool_call(rest),
            ["TCH", "PROBE", "1411", ..] | ["G1411", ..] => self.two_circles(block),
            ["TCH", "PROBE", "1493", ..] | ["G1493", ..] => self.extrusion(block),
            // ISO words before the cycle: units are read beforehand, plane and tool here.
            iso if self.found == 0
                && iso.iter().all(|w| is_iso_word(w))
                && iso.iter().any(|w| wanted_iso(w)) =>
            {
                self.iso(iso)
            }
            other => {
                if let Some((what, is)) = transforms(other).filter(|_| self.found == 0) {
                    self.transformed.retain(|known| *known != what);
                    self.transformed.extend(is.then_some(what));
                }
                self.ignored += 1;
            }
        }
    }

    fn set(&mut self, path: &str, text: &str) {
        set(&mut self.job, path, Value::Text(text.to_owned()));
    }

    fn tool_call(&mut self, words: &[&str]) {
        let first = words.first().copied().unwrap_or_default();
        let speed = |word: &str| {
            word.strip_prefix('S')
                .is_some_and(|speed| crate::num::read(speed).is_some())
        };
        match first.parse::<i32>() {
            // The empty tool is not a probe.
            Ok(0) => {}
            Ok(number) => set(
                &mut self.job,
                "control.tool",
                Value::Number(f64::from(number)),
            ),
            // Only a tool axis or a spindle speed: the tool stays.
            Err(_) if matches!(first, "" | "X" | "Y" | "Z") || speed(first) => {}
            Err(_) => {
                let message = text!(
                    "The tool is called by name: its number is unknown, so the job calls no tool"
                );
                self.checker
                    .warning("tool-by-name", "control.tool", message);
            }
        }
        let plane = words.iter().find_map(|word| match *word {
            "X" => Some("G19"),
            "Y" => Some("G18"),
            "Z" => Some("G17"),
            _ => None,
        });
        if let Some(plane) = plane {
            self.set("plane", plane);
            self.has_plane = true;
        }
    }

    fn two_circles(&mut self, block: &str) {
        self.found += 1;
        if self.found > 1 {
            let message = text!("The program has cycle 1411 more than once: the first one is used");
            self.checker.warning("several-cycles", "", message);
            return;
        }
        let mut form = self
            .job
            .get("cycle")
            .cloned()
            .expect("a default job has a cycle");
        fill(&mut form, block, cycle().fields, "1411", &mut self.checker);
        set(&mut self.job, "cycle", form);
    }

    /// Extrusion probing applies to the cycle after it.
    fn extrusion(&mut self, block: &str) {
        if self.found > 0 {
            return;
        }
        self.extrusion = section_defaults_in(extrusion_fields(), self.units);
        fill(
            &mut self.extrusion,
            block,
            extrusion_fields(),
            "1493",
            &mut self.checker,
        );
    }

    fn iso(&mut self, words: &[&str]) {
        for word in words {
            match (*word, word.strip_prefix('T').map(str::parse::<i32>)) {
                ("G17" | "G18" | "G19", _) => {
                    self.set("plane", word);
                    self.has_plane = true;
                }
                (_, Some(Ok(0))) => {}
                (_, Some(Ok(tool))) => set(
                    &mut self.job,
                    "control.tool",
                    Value::Number(f64::from(tool)),
                ),
                _ => {}
            }
        }
    }

    fn finish(self, blocks: &[String]) -> Result<(Value, Vec<Finding>), JobError> {
        let Reader {
            mut job,
            units: _,
            mut checker,
            extrusion,
            found,
            ignored,
            has_plane,
            transformed,
            moves,
            spins,
        } = self;
        let states = |block: &str| {
            block.starts_with("BEGIN PGM") && (block.ends_with(" MM") || block.ends_with(" INCH"))
        };
        let stated = blocks
            .iter()
            .any(|block| states(&block.to_ascii_uppercase()));
        if found > 0 && !stated && !says(blocks, "G70") && !says(blocks, "G71") {
            let message = text!(
                "The text does not state its units (BEGIN PGM … MM or INCH, G70 or G71): mm is assumed"
            );
            checker.warning("units-unknown", "units", message);
        }
        if found == 0 {
            let message = text!(
                "This text gives no job: it is neither a job (JSON), nor a dump with CmdPrm.Int[-1], nor a program with cycle 1411, nor one written by Touchpath"
            );
            checker.error("nothing-to-import", "", message);
            return Err(JobError {
                findings: checker.findings(),
            });
        }
        set(&mut job, "cycle.extrusion", extrusion);
        raise_start(&mut job);
        if ignored > 0 {
            let message = if ignored == 1 {
                text!("1 other block was ignored")
            } else {
                text!("{count} other blocks were ignored", ignored)
            };
            checker.info("passed-over", "", message);
        }
        if let Some(block) = moves {
            let message = text!(
                "Blocks before the cycle move the axes (first: {block}), so the stylus does not start at the position in the job",
                block
            );
            checker.warning("moves-before-cycle", "cycle.start", message);
        }
        if let Some(block) = spins {
            checker.warning(
                "unsafe-program",
                "",
                text!(
                    "The spindle is switched on before the cycle: {block}",
                    block
                ),
            );
        }
        if !has_plane {
            checker.info(
                "not-in-program",
                "plane",
                text!("This program does not state the tool axis: the plane G17 is assumed"),
            );
        }
        if !transformed.is_empty() {
            let message = text!(
                "Blocks before the cycle shift, rotate, mirror, scale or tilt the work coordinate system: the job does not include that"
            );
            checker.warning("places-transformed", "", message);
        }
        let unknown = text!(
            "A program does not give the stylus, the touch probe table (SET_UP, DIST, F, FMAX) or the start: the defaults are used, with the start no lower than the clearance height"
        );
        checker.info("not-in-program", "stylus", unknown);
        if checker.failed() {
            return Err(JobError {
                findings: checker.findings(),
            });
        }
        Ok((job, checker.findings()))
    }
}

/// Start position, which a program does not contain: the default, but not below the positions of the program.
fn raise_start(job: &mut Value) {
    let axis = match job.get("plane") {
        Some(Value::Text(plane)) if plane == "G18" => 1,
        Some(Value::Text(plane)) if plane == "G19" => 0,
        _ => 2,
    };
    let Some(cycle) = job.get("cycle") else {
        return;
    };
    let number = |value: Option<&Value>| {
        if let Some(Value::Number(x)) = value {
            Some(*x)
        } else {
            None
        }
    };
    let height = |value: Option<&Value>| match value {
        Some(Value::List(point)) => number(point.get(2)),
        _ => None,
    };
    let Some(Value::List(start)) = cycle.get("start") else {
        return;
    };
    let Some(height_of_start) = number(start.get(axis)) else {
        return;
    };
    let needed = match cycle.get("clearanceHeightPredef") {
        // Distance of the default above the touches.
        Some(Value::Flag(true)) => ["point1", "point2"]
            .iter()
            .filter_map(|p| height(cycle.get(p)))
            .map(|w| w + height_of_start)
            .fold(height_of_start, f64::max),
        _ => number(cycle.get("clearanceHeight")).unwrap_or(height_of_start),
    };
    if needed > height_of_start {
        let mut start = start.clone();
        start[axis] = Value::Number(needed);
        set(job, "cycle.start", Value::List(start));
    }
}

/// Whether a parameter is a position or a diameter. These have no default, and the control refuses a block without them.
fn is_geometry(key: &str) -> bool {
    ["point1", "point2", "diameter1", "diameter2"]
        .iter()
        .any(|name| key.starts_with(name))
}

/// Puts the parameters of a block into the form of its cycle. Missing ones keep the form's default; a position or a diameter is required.
fn fill(form: &mut Value, block: &str, fields: &[Field], cycle: &str, checker: &mut Checker) {
    let known = parameters(fields);
    let given = assignments(block);
    for (number, _) in &given {
        if !known.iter().any(|one| one.number == *number) {
            let message = text!(
                "Cycle {cycle} has no parameter Q{number}: it is ignored",
                cycle.to_string(),
                number.to_string()
            );
            checker.warning("unknown-parameter", "", message);
        }
    }
    for Parameter {
        number,
        key,
        predefined,
    } in known
    {
        let path = format!(
            "cycle.{}{key}",
            if cycle == "1493" { "extrusion." } else { "" }
        );
        let default = || shown_value(form, &key);
        match (
            given
                .iter()
                .rev()
                .find(|(n, _)| *n == number)
                .map(|(_, value)| value),
            predefined,
        ) {
            (Some(Given::Value(value)), _) => set(form, &key, value.clone()),
            (Some(Given::Predef), Some(flag)) => {
                set(form, flag, Value::Flag(true));
                let message = text!(
                    "Q{number} is PREDEF: its value is in the control's GLOBAL DEF. The form's number only serves the picture",
                    number.to_string()
                );
                checker.warning("predefined", path, message);
            }
            (Some(_), _) if is_geometry(&key) => {
                let message = text!(
                    "Q{number} of cycle {cycle} is not a number",
                    number.to_string(),
                    cycle.to_owned()
                );
                checker.error("not-a-number", path, message);
            }
            (None, _) if is_geometry(&key) => {
                let message = text!(
                    "Q{number} is not given: a position or diameter has no default, and the control refuses the block",
                    number.to_string()
                );
                checker.error("missing-parameter", path, message);
            }
            (Some(_), _) => {
                let message = text!(
                    "Q{number} of cycle {cycle} is not a number: the form's default, {value}, is used",
                    number.to_string(),
                    cycle.to_owned(),
                    default()
                );
                checker.warning("not-a-number", path, message);
            }
            (None, _) => {
                let message = text!(
                    "Q{number} is not given: the form's default, {value}, is used",
                    number.to_string(),
                    default()
                );
                checker.warning("missing-parameter", path, message);
            }
        }
    }
}

/// Number of a form at a key such as `point1[0]`.
fn shown_value(form: &Value, key: &str) -> String {
    let (name, axis) = key.split_once('[').unwrap_or((key, ""));
    let value = match (form.get(name), axis.trim_end_matches(']').parse::<usize>()) {
        (Some(Value::List(items)), Ok(axis)) => items.get(axis),
        (value, _) => value,
    };
    if let Some(Value::Number(x)) = value {
        crate::num::in_full(*x)
    } else {
        String::new()
    }
}
