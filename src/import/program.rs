//! Reads back a program that was written here for any control: its header gives the job, and its blocks are compared with those of that job. A program without
//! a job gives its moves.

use serde::Serialize;

use crate::control::header::{self, HeaderLines};
use crate::control::iso::lex::{
    self, Token, comment_at, lines_of, strip_prefix_nocase, tokens, trimmed, without_count,
    without_number,
};
use crate::control::iso::lines;
use crate::control::iso::machine::{self, ProbeOutcome, Run};
use crate::control::iso::script::ReadError;
use crate::control::prove::Fault;
use crate::control::shop::coded;
use crate::control::shop::place;
use crate::control::trace::{Kind, Trace};
use crate::control::{self, POSTS, PostDef};
use crate::cycle::{self, CycleDef};
use crate::form::{self, Checker, Finding, Value, printable};
use crate::import::dialect_markers::{self, DialectMarker};
use crate::import::{Imported, has_place, read_program, set, toolpath};
use crate::job::{
    DATUM, FORMAT, JobError, MOST_CYCLES, Plan, RELATIONS, RESULT_CODES, SECTIONS, SafetyRow,
    TOLERANCES, WEAR,
};
use crate::text::{Text, text};

/// Largest number of listed lines that are not understood, or not safe.
const MOST_LISTED: usize = 20;

/// The moves of a program without a job.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TraceRow {
    /// Control whose language it was read in.
    pub control: &'static str,
    /// `mm`, `inch`, or null if the program does not say.
    pub units: Option<&'static str>,
    /// Its moves, in its units.
    pub moves: Vec<TraceMove>,
}

/// One move of a program.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TraceMove {
    /// End; null along an axis that no block has named yet.
    pub to: [Option<f64>; 3],
    /// `rapid`, `feed`, `watched`, `touch` or `unchecked`.
    pub kind: Kind,
    /// Feed; null for a rapid, or if no block has stated one.
    pub feed: Option<f64>,
    /// The 0-based line of the move.
    pub line: usize,
}

/// Whether the header of a text contains a job.
pub fn says_job(text: &str) -> bool {
    header::read(text).values.iter().any(|(path, _)| {
        path.eq_ignore_ascii_case("cycle.type") || path.eq_ignore_ascii_case("cycles[0].type")
    })
}

/// Refuses a text with characters that no control treats as blanks.
pub fn check_signs(text: &str) -> Result<(), JobError> {
    if !lex::hides(text) {
        return Ok(());
    }
    let mut checker = Checker::default();
    for (line, _) in lines_of(text)
        .enumerate()
        .filter(|(_, full)| lex::hides(full))
        .take(MOST_LISTED)
    {
        checker.error("not-understood", "", with_line(Some(line), lines::hidden()));
    }
    Err(JobError {
        findings: checker.findings(),
    })
}

/// Makes a job from a program with a header.
pub fn import(text: &str) -> Result<Imported, JobError> {
    read(text).map(|(job, findings)| Imported::Job { job, findings })
}

/// The job of a program's header, with findings about the program.
pub fn read(text: &str) -> Result<(Value, Vec<Finding>), JobError> {
    let mut checker = Checker::default();
    let said = header::read(text);
    let Some(mut job) = job_of(&said, &mut checker) else {
        checker.error(
            "nothing-to-import",
            "",
            text!("The header's job has an unknown cycle"),
        );
        return Err(JobError {
            findings: checker.findings(),
        });
    };
    if let Some(name) = said.name {
        set(&mut job, "name", Value::Text(name.to_owned()));
    }
    take_number(text, &mut job);
    if let Some(version) = said
        .version
        .filter(|version| !version.eq_ignore_ascii_case(env!("CARGO_PKG_VERSION")))
    {
        let message = text!(
            "Version {version} wrote this program, and {own} reads it: blocks may differ only because of that",
            printable(version),
            env!("CARGO_PKG_VERSION").to_owned()
        );
        checker.info("other-version", "", message);
    }
    let plan = crate::job::plan(&job);
    match crate::job::check_program(&job, text) {
        Some(Err(faults))
            if faults.iter().any(|fault| !fault.understood) && written_for_another(&job, text) =>
        {
            let message = text!(
                "The header's job is for another control than the program: the blocks cannot be compared with that job's, and may have been changed"
            );
            checker.warning("program-differs", "control.post", message);
            return Ok((job, checker.findings()));
        }
        examined => {
            if !report_examined(examined, plan.as_ref().ok(), &mut checker) {
                return Err(JobError {
                    findings: checker.findings(),
                });
            }
        }
    }
    match plan {
        Ok(plan) => compare(text, &said, &plan, &mut checker),
        Err(_) => checker.warning(
            "header-unsound",
            "",
            text!("The header's job has errors: see its findings"),
        ),
    }
    checker.info(
        "part-not-in-program",
        "part",
        text!("A program does not contain the part's position: the nominal part is assumed"),
    );
    Ok((job, checker.findings()))
}

/// Result of an examination; `None` for a control whose programs are not read.
type Examined = Option<Result<Vec<SafetyRow>, Vec<Fault>>>;

/// Reports the result of an examination; false if the program cannot be read.
fn report_examined(examined: Examined, plan: Option<&Plan>, checker: &mut Checker) -> bool {
    match examined {
        Some(Err(faults)) if faults.iter().all(|fault| fault.understood) => {
            for fault in faults.iter().take(MOST_LISTED) {
                checker.warning(
                    "unsafe-program",
                    "",
                    with_line(fault.line, fault.message.clone()),
                );
            }
        }
        Some(Err(faults)) => {
            for fault in faults
                .iter()
                .filter(|fault| !fault.understood)
                .take(MOST_LISTED)
            {
                checker.error(
                    "not-understood",
                    "",
                    with_line(fault.line, fault.message.clone()),
                );
            }
            return false;
        }
        Some(Ok(rules)) => {
            // A rule that the job itself breaks is not a change.
            let asked = |rule: &str| {
                plan.is_some_and(|p| {
                    p.safety
                        .iter()
                        .any(|own| own.rule == rule && own.holds == Some(false))
                })
            };
            for rule in rules
                .iter()
                .filter(|rule| rule.holds == Some(false) && !asked(rule.rule))
                .take(MOST_LISTED)
            {
                let message = text!(
                    "{message} (rule {rule})",
                    rule.message.clone(),
                    rule.rule.to_owned()
                );
                checker.warning(
                    "unsafe-program",
                    "",
                    with_line(rule.lines.first().copied(), message),
                );
            }
        }
        None => {}
    }
    true
}

/// Takes the number of the program, if it differs from the job's: a user may have changed it at the control.
fn take_number(text: &str, job: &mut Value) {
    const MOST: i32 = 9999;
    let own = |line: &str| i32::try_from(lex::program_number(line.trim().as_bytes())?).ok();
    let Some(number) = lines_of(text).find_map(own) else {
        return;
    };
    let given = crate::job::planned(job).and_then(|planned| {
        control::program_number(planned.job.post, planned.job.number, &planned.job.name)
    });
    if given.is_some_and(|given| given != number) && (1..=MOST).contains(&number) {
        set(job, "control.number", Value::Number(f64::from(number)));
    }
}

fn with_line(line: Option<usize>, message: Text) -> Text {
    match line {
        Some(line) => text!("Line {line}: {message}", line + 1, message),
        None => message,
    }
}

/// Whether another control than the job's understands the program.
fn written_for_another(job: &Value, text: &str) -> bool {
    let own = job.get("control").and_then(|control| control.get("post"));
    POSTS
        .iter()
        .filter(|post| own != Some(&Value::Text(post.key.to_owned())))
        .any(|post| post.read.is_some_and(|read| read(text).is_ok()))
}

/// The job in a header: `job path=value path=value`.
fn job_of(said: &HeaderLines<'_>, checker: &mut Checker) -> Option<Value> {
    let find = |path: &str| {
        said.values
            .iter()
            .find(|(p, _)| p.eq_ignore_ascii_case(path))
            .map(|(_, v)| *v)
    };
    let type_at = |path: &str| cycle::find(&find(path)?.to_ascii_lowercase());
    // For a set-up its cycles by their indices.
    let defs: Vec<&CycleDef> = (0..MOST_CYCLES)
        .map_while(|i| type_at(&format!("cycles[{i}].type")))
        .collect();
    let def = match defs.first() {
        Some(def) => *def,
        None => type_at("cycle.type")?,
    };
    let format = find("format").and_then(crate::num::read).unwrap_or(FORMAT);
    let mut read = HeaderJob {
        job: Value::Map(vec![("format".to_owned(), Value::Number(format))]),
        def,
        defs,
        tolerances: Vec::new(),
        shop_lines: Vec::new(),
        unknown: 0,
    };
    for (path, text) in &said.values {
        if !path.eq_ignore_ascii_case("format") {
            read.take(path, text);
        }
    }
    Some(read.finish(checker))
}

/// A job while its header is read.
struct HeaderJob {
    job: Value,
    /// The cycle, of a set-up the first one, and all cycles of a set-up.
    def: &'static CycleDef,
    defs: Vec<&'static CycleDef>,
    /// Result, key and value of each tolerance.
    tolerances: Vec<(String, String, Value)>,
    /// Path and encoded text of each line of the shop.
    shop_lines: Vec<(String, String)>,
    /// Number of values that the job does not use.
    unknown: usize,
}

impl HeaderJob {
    /// Takes a value of the header.
    fn take(&mut self, path: &str, text: &str) {
        if let Some((place, continues)) = shop_place(path) {
            match self.shop_lines.last_mut().filter(|_| continues) {
                Some((_, line)) => line.push_str(text),
                None => self.shop_lines.push((place, text.to_owned())),
            }
        } else if let Some((index, rest)) = in_cycle(path) {
            self.take_in_cycle(index, rest, text);
        } else if self.defs.is_empty() || !self.take_of_set_up(path, text) {
            self.take_plain(path, text);
        }
    }

    /// Takes a tolerance, or a value of a section or of the only cycle.
    fn take_plain(&mut self, path: &str, text: &str) {
        if let Some((code, key)) = of_tolerance(path) {
            let text = small_letters(text);
            let given = if key.starts_with(WEAR.key) {
                value(&text.to_ascii_lowercase())
            } else {
                Value::Text(text)
            };
            return self.tolerances.push((code, key, given));
        }
        let path = proper(self.def, path);
        let given = value(&word(self.def, &path, text));
        self.put(self.def, &path, &path, given);
    }

    /// Takes a value of a cycle of a set-up.
    fn take_in_cycle(&mut self, index: usize, rest: &str, text: &str) {
        let Some(def) = self.defs.get(index).copied() else {
            self.unknown += 1;
            return;
        };
        if rest.eq_ignore_ascii_case("name") {
            let name = Value::Text(small_letters(text));
            return set(&mut self.job, &format!("cycles[{index}].name"), name);
        }
        let single = proper(def, &format!("cycle.{rest}"));
        let own = single.strip_prefix("cycle.").unwrap_or(&single);
        let given = value(&word(def, &single, text));
        self.put(def, &single, &format!("cycles[{index}].{own}"), given);
    }

    /// Takes another value of a set-up. Returns whether it is one.
    fn take_of_set_up(&mut self, path: &str, text: &str) -> bool {
        let text = small_letters(text);
        if let Some(key) = of_set_up(path) {
            let is_null = text.eq_ignore_ascii_case("null");
            let given = value(if is_null { "null" } else { &text });
            set(&mut self.job, &key, given);
            return true;
        }
        let is_relation = lex::strip_prefix_nocase(path, RELATIONS).is_some();
        if is_relation {
            set_relation(&mut self.job, &path.to_ascii_lowercase(), &text);
        }
        is_relation
    }

    /// Puts a value at a path, if the cycle has the `single` one.
    fn put(&mut self, def: &CycleDef, single: &str, path: &str, given: Value) {
        if has_place(def, single) {
            set(&mut self.job, path, given);
        } else {
            self.unknown += 1;
        }
    }

    /// The job, with its tolerances and lines of the shop.
    fn finish(mut self, checker: &mut Checker) -> Value {
        for (place, code) in self.shop_lines {
            match coded::decoded(&code) {
                // A place without lines.
                _ if !place.ends_with(']') => {
                    set(&mut self.job, &place, value(&code.to_ascii_lowercase()));
                }
                Some(line) => set(&mut self.job, &place, Value::Text(line)),
                None => self.unknown += 1,
            }
        }
        if let Value::Map(entries) = &mut self.job
            && !self.tolerances.is_empty()
        {
            entries.push((TOLERANCES.to_owned(), grouped(self.tolerances)));
        }
        if self.unknown > 0 {
            let message = text!(
                "The header has {unknown} values that this cycle does not use: ignored",
                self.unknown
            );
            checker.warning("header-unknown", "", message);
        }
        self.job
    }
}

/// A path in its proper spelling: controls without small letters have everything in capitals.
fn proper(def: &CycleDef, path: &str) -> String {
    if has_place(def, path) {
        path.to_owned()
    } else {
        spelled(def, path)
    }
}

/// The path of a line of the shop, in its proper spelling, and whether the word continues the line: `machine.frame.head[0]+`.
fn shop_place(path: &str) -> Option<(String, bool)> {
    let place = lex::strip_prefix_nocase(path, place::PATH)?;
    let whole = place.strip_suffix('+').unwrap_or(place);
    let key = whole.split('[').next()?;
    let known = place::CHOICES
        .iter()
        .find(|known| known.value.eq_ignore_ascii_case(key))?;
    let index = &whole[key.len()..];
    Some((
        format!("{}{}{index}", place::PATH, known.value),
        whole.len() < place.len(),
    ))
}

/// Index of the cycle in a path of a set-up, and the path inside the cycle.
fn in_cycle(path: &str) -> Option<(usize, &str)> {
    let inner = path
        .get(..7)
        .filter(|word| word.eq_ignore_ascii_case("cycles["))
        .and(path.get(7..))?;
    let (index, rest) = inner.split_once("].")?;
    Some((index.parse().ok()?, rest))
}

/// Result and key of a path in the tolerances: `tolerances.center.x.action`, `tolerances.width.wear.tool`.
fn of_tolerance(path: &str) -> Option<(String, String)> {
    path.get(..TOLERANCES.len())
        .filter(|head| head.eq_ignore_ascii_case(TOLERANCES))?;
    let (code, key) = path[TOLERANCES.len()..]
        .strip_prefix('.')?
        .rsplit_once('.')?;
    let (code, key) = match code
        .rsplit_once('.')
        .filter(|(_, wear)| wear.eq_ignore_ascii_case(WEAR.key))
    {
        Some((code, _)) => {
            let field = WEAR
                .fields
                .iter()
                .find(|field| field.key.eq_ignore_ascii_case(key))?;
            (code, format!("{}.{}", WEAR.key, field.key))
        }
        None => (
            code,
            ["tolerance", "action"]
                .into_iter()
                .find(|known| known.eq_ignore_ascii_case(key))?
                .to_owned(),
        ),
    };
    let own = RESULT_CODES.iter().filter(|own| {
        let at = code.len().checked_sub(own.len());
        let apart = |at: usize| code.is_char_boundary(at) && (at == 0 || code[..at].ends_with('.'));
        at.is_some_and(|at| apart(at) && code[at..].eq_ignore_ascii_case(own))
    });
    // `difference.angle` also ends like `angle`.
    let own = own.max_by_key(|own| own.len());
    Some((
        own.map_or_else(
            || code.to_owned(),
            |own| format!("{}{own}", &code[..code.len() - own.len()]),
        ),
        key,
    ))
}

/// Sets a value of a relation: name and type are texts, and so are all items of its list, which is whole or item by item.
fn set_relation(job: &mut Value, path: &str, given: &str) {
    let text = |text: &str| Value::Text(text.to_owned());
    let value = match given
        .strip_prefix('[')
        .and_then(|inner| inner.strip_suffix(']'))
    {
        Some("") => Value::List(Vec::new()),
        Some(inner) => Value::List(inner.split(',').map(text).collect()),
        // A type has small letters only.
        None if path.ends_with(".type") => Value::Text(given.to_ascii_lowercase()),
        None => text(given),
    };
    set(job, path, value);
}

/// Tolerances grouped by their results.
fn grouped(given: Vec<(String, String, Value)>) -> Value {
    let mut all: Vec<(String, Value)> = Vec::new();
    for (code, key, value) in given {
        let at = all
            .iter()
            .position(|(known, _)| *known == code)
            .unwrap_or_else(|| {
                all.push((code, Value::Map(Vec::new())));
                all.len() - 1
            });
        set(&mut all[at].1, &key, value);
    }
    Value::Map(all)
}

/// Other entries of a set-up, in their proper spelling.
fn of_set_up(path: &str) -> Option<String> {
    let datum = DATUM.iter().map(|key| format!("datum.{key}"));
    std::iter::once("clear".to_owned())
        .chain(["datum".to_owned()])
        .chain(datum)
        .find(|known| known.eq_ignore_ascii_case(path))
}

/// A path in the spelling of the fields.
fn spelled(def: &CycleDef, path: &str) -> String {
    let keys = || {
        let sections = SECTIONS
            .iter()
            .flat_map(|form| std::iter::once(form.key).chain(form.fields.iter().map(|f| f.key)));
        let own = def.fields.iter().map(|f| f.key);
        let inner = def
            .sections
            .iter()
            .flat_map(|s| std::iter::once(s.key).chain(s.fields.iter().map(|f| f.key)));
        const OTHERS: [&str; 11] = [
            "cycle", "type", "touches", "point", "vector", "custom", "code", "value", "frame",
            "rot", "mirror",
        ];
        sections.chain(own).chain(inner).chain(OTHERS)
    };
    let spelled = |word: &str| {
        keys()
            .find(|key| key.eq_ignore_ascii_case(word))
            .unwrap_or(word)
            .to_owned()
    };
    let words = path.split('.').map(|word| match word.split_once('[') {
        Some((word, index)) => format!("{}[{index}", spelled(word)),
        None => spelled(word),
    });
    words.collect::<Vec<_>>().join(".")
}

/// A value in the spelling of the field: word of a choice, type of a cycle, true, false, null; a capital after a plus is a small letter.
fn word(def: &CycleDef, path: &str, text: &str) -> String {
    if text.bytes().any(|b| b.is_ascii_lowercase()) {
        return text.to_owned();
    }
    let choices = SECTIONS.iter().find_map(|form| {
        let key = if form.key.is_empty() {
            Some(path)
        } else {
            path.strip_prefix(form.key)?.strip_prefix('.')
        };
        form.fields
            .iter()
            .find(|f| Some(f.key) == key)
            .map(|field| field.kind)
    });
    if let Some(form::Kind::Choice(choices)) = choices
        && let Some(choice) = choices
            .iter()
            .find(|choice| choice.value.eq_ignore_ascii_case(text))
    {
        return choice.value.to_owned();
    }
    if path == "cycle.type" {
        return def.key.to_owned();
    }
    if matches!(text, "TRUE" | "FALSE" | "NULL") {
        return text.to_ascii_lowercase();
    }
    small_letters(text)
}

/// A text in which a plus and a capital stand for a small letter.
fn small_letters(text: &str) -> String {
    let mut small = String::new();
    let mut signs = text.chars().peekable();
    while let Some(c) = signs.next() {
        match signs.peek() {
            Some(next) if c == '+' && next.is_ascii_uppercase() => {
                small.push(next.to_ascii_lowercase());
                signs.next();
            }
            _ => small.push(c),
        }
    }
    small
}

/// A value of the header. A number is finite; any other text stays text, and the check reports it.
fn value(text: &str) -> Value {
    nested(text, 2)
}

/// `depth` is the number of lists that may still begin inside.
fn nested(text: &str, depth: usize) -> Value {
    match text {
        "true" => Value::Flag(true),
        "false" => Value::Flag(false),
        "null" => Value::Null,
        "{}" => Value::Map(Vec::new()),
        "[]" => Value::List(Vec::new()),
        _ => match text
            .strip_prefix('[')
            .and_then(|inner| inner.strip_suffix(']'))
            .filter(|_| depth > 0)
        {
            Some(inner) => Value::List(
                inner
                    .split(',')
                    .take(3)
                    .map(|item| nested(item, depth - 1))
                    .collect(),
            ),
            None => match crate::num::read(text) {
                Some(x) if x.is_finite() => Value::Number(x),
                _ => Value::Text(text.to_owned()),
            },
        },
    }
}

/// Reports the first block that differs from those of the header's job: program or header was changed.
fn compare(text: &str, said: &HeaderLines<'_>, plan: &Plan, checker: &mut Checker) {
    let post = control::find(plan.program.post);
    let (given, wanted) = (blocks(post, text), blocks(post, &plan.program.text));
    let differs = given
        .iter()
        .zip(&wanted)
        .find(|((_, a), (_, b))| a != b)
        .map(|((line, _), _)| *line);
    let line = differs.or_else(|| given.get(wanted.len()).map(|(line, _)| *line));
    let by_hash = match said.unchanged {
        Some(true) => {
            text!(
                " The header's hash matches the blocks: the header was changed, or another version wrote them."
            )
        }
        Some(false) => text!(" The header's hash does not match the blocks: they were changed."),
        None => Text::words(""),
    };
    let message = match line {
        Some(line) => text!(
            "Line {line} differs from the program of the header's job.{by_hash} The header's job is used: it does not include changes of the program",
            line + 1,
            by_hash
        ),
        None if given.len() < wanted.len() => {
            text!(
                "The end of the program is missing.{by_hash} The job is the header's",
                by_hash
            )
        }
        None => {
            if said.unchanged == Some(false) {
                let message = text!(
                    "The blocks match the job, but lines between them were changed: comments, or their order"
                );
                checker.info("lines-differ", "", message);
            }
            return;
        }
    };
    checker.warning("program-differs", "", message);
}

/// Blocks of a program with their 0-based lines, without comments that have no effect, block numbers and blanks.
fn blocks(post: Option<&PostDef>, text: &str) -> Vec<(usize, Vec<Token>)> {
    let round = post.is_some_and(|post| post.dialect.comment.0 == "(");
    let mut begun = false;
    lines_of(text)
        .enumerate()
        .map(|(line, full)| {
            (
                line,
                tokens(without_count(without_number(trimmed(code(full, round))))),
            )
        })
        .filter(|(_, tokens)| !tokens.is_empty() && tokens[0] != Token::Sign(b'%'))
        // The number comes before the blocks.
        .filter(|(_, tokens)| std::mem::replace(&mut begun, true) || !is_program_number(tokens))
        .collect()
}

/// `O1000`: a user chooses a free number for a program.
fn is_program_number(tokens: &[Token]) -> bool {
    matches!(tokens, [Token::Sign(b'O'), Token::Number(_)])
}

/// A line without its comment. Some comments in brackets have an effect.
fn code(line: &str, round: bool) -> &str {
    let Some(at) = comment_at(line.as_bytes(), round) else {
        return line;
    };
    let inner = trimmed(&line[at + 1..]);
    let does = ["PRINT,", "ABORT,", "MSG,", "DEBUG,"]
        .iter()
        .any(|word| strip_prefix_nocase(inner, word).is_some());
    // The text of an alarm belongs to its block.
    let alarm = trimmed(line).starts_with("#3000");
    if round && line[at..].starts_with('(') && (does || alarm) {
        line
    } else {
        &line[..at]
    }
}

/// Whether a text probes.
fn probes(text: &str) -> bool {
    ["G38.", "G31", "MEAS=1", "$AC_MEA", "CYCLE977"]
        .iter()
        .any(|word| text.contains(word))
}

/// Reads the moves of a program without a job, for the first control that understands all of it. `None` if the text is not a program: it neither ends nor
/// probes.
pub fn trace(text: &str) -> Option<Result<Imported, JobError>> {
    let mut checker = Checker::default();
    let mut least: Option<(&PostDef, Vec<ReadError>)> = None;
    let mut found: Option<(&PostDef, Trace)> = None;
    let sign = dialect_markers::of(text);
    if sign == Some(DialectMarker::RepRap) {
        checker.error(
            "not-understood",
            "",
            text!("This is a program for RepRapFirmware, which is not supported"),
        );
        return Some(Err(JobError {
            findings: checker.findings(),
        }));
    }
    for post in POSTS.iter().filter(|post| may_be_for(post, sign, text)) {
        match followed(post, text) {
            Some(Ok(trace)) if !trace.ends && !probes(text) => {}
            Some(Ok(trace))
                if found
                    .as_ref()
                    .is_none_or(|(_, before)| understands_more(&trace, before)) =>
            {
                found = Some((post, trace));
            }
            Some(Err(troubles))
                if least
                    .as_ref()
                    .is_none_or(|(_, known)| troubles.len() < known.len()) =>
            {
                least = Some((post, troubles));
            }
            _ => {}
        }
    }
    if let Some((post, trace)) = found {
        checker.info(
            "no-job-in-program",
            "",
            text!("The program contains no job: its moves are read, but they make no job"),
        );
        let mut findings = checker.findings();
        // Both readers take positions as written.
        findings.extend(
            read_program(text, None)
                .findings
                .into_iter()
                .filter(|finding| {
                    finding.code == "places-transformed" || finding.code == "machine-places"
                }),
        );
        return Some(Ok(Imported::Moves {
            trace: row(post, &trace),
            findings,
        }));
    }
    let (post, troubles) = least.filter(|_| probes(text))?;
    let first = troubles.first()?;
    let message = text!(
        "Line {line}, read as a program for {title}: {message}",
        first.line + 1,
        post.title.to_owned(),
        first.message.clone()
    );
    let others = troubles.len() - 1;
    let message = match others {
        0 => message,
        1 => text!("{message}. One other line cannot be read either", message),
        _ => text!(
            "{message}. {others} other lines cannot be read either",
            message,
            others
        ),
    };
    checker.error("not-understood", "", message);
    Some(Err(JobError {
        findings: checker.findings(),
    }))
}

/// Whether a reading knows more about a program than the previous one.
fn understands_more(trace: &Trace, before: &Trace) -> bool {
    let unchecked = |trace: &Trace| {
        trace
            .steps
            .iter()
            .filter(|step| step.kind == Kind::Unchecked)
            .count()
    };
    before.steps.is_empty() || unchecked(trace) < unchecked(before)
}

/// Whether a text may be for this control, by its syntax.
fn may_be_for(post: &PostDef, sign: Option<DialectMarker>, text: &str) -> bool {
    match sign {
        Some(DialectMarker::LinuxCnc) => post.key == "linuxcnc",
        Some(DialectMarker::Rs274) => {
            matches!(post.key, "linuxcnc" | "grbl" | "grblhal" | "fluidnc")
        }
        Some(DialectMarker::LikeFanuc) => matches!(post.key, "fanuc" | "haas"),
        Some(DialectMarker::Klartext | DialectMarker::RepRap) => false,
        None => post.key == "sinumerik" || toolpath::guessed(text) != "sinumerik",
    }
}

/// A text traced as a program for a control, on an unknown part.
fn followed(post: &PostDef, text: &str) -> Option<Result<Trace, Vec<ReadError>>> {
    // Any start but a position that a program may name first.
    const ANYWHERE: [f64; 3] = [417.3125, -233.6875, 301.0625];
    let script = (post.read?)(text);
    Some(script.and_then(|script| {
        let (start, known) = (script.start.unwrap_or(ANYWHERE), script.start.is_some());
        let run = Run {
            start,
            deflected: false,
            until: None,
            may_stop: false,
            known,
            highest: f64::INFINITY,
            strict: false,
        };
        machine::run(&script, run, &mut |_| ProbeOutcome::Unknown).map_err(|trouble| vec![trouble])
    }))
}

fn row(post: &PostDef, trace: &Trace) -> TraceRow {
    let moves = trace.steps.iter().map(|step| TraceMove {
        to: [0, 1, 2].map(|axis| step.known[axis].then_some(step.to[axis])),
        kind: step.kind,
        feed: step.feed,
        line: step.line,
    });
    let units = trace
        .modes
        .metric
        .map(|metric| if metric { "mm" } else { "inch" });
    TraceRow {
        control: post.key,
        units,
        moves: moves.collect(),
    }
}
