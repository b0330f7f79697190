//! Everything that a form needs, read from the one list of fields.

use serde::Serialize;

use crate::control::native_run::CorrectsTools;
use crate::control::safety::RULES;
use crate::control::{POSTS, ProgramForm};
use crate::cycle::{CODE_GROUPS, CYCLES, CycleDef};
use crate::form::{Choice, Code, Default, Field, Kind, STANDING};
use crate::formula::{RELATIONS, RelationDef};
use crate::job::{self, FORMAT, LONGEST_PROGRAM, LONGEST_TEXT, SECTIONS};
use crate::path::{MAX_TOUCHES, RAPID_RATE};

/// Cycles, controls and the sections around them.
#[derive(Clone, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Catalog {
    /// The version of the job format that this crate reads.
    pub format: u8,
    /// Every cycle, with its fields and steps.
    pub cycles: Vec<CycleEntry>,
    /// The sections of a job around the cycle.
    pub sections: Vec<SectionEntry>,
    /// Every kind of relation between results of a set-up.
    pub relations: Vec<RelationEntry>,
    /// Every control, with what its programs can do.
    pub posts: Vec<PostEntry>,
    /// Safety rules that programs are checked for.
    pub rules: Vec<RuleEntry>,
    /// Codes of findings that hold for a control and form whatever the job. A page may show them once, at the control's name.
    pub standing: &'static [&'static str],
    /// Groups of codes in a CmdPrm table; the first matching group counts.
    pub code_groups: Vec<CodeGroup>,
    /// Assumed rate of rapids in `plan().time`, mm/min, if the program states no rate.
    pub rapid_rate: f64,
    /// Largest number of touches that a parameter table of CmdPrm codes holds. Each cycle has its own number in its entry.
    pub max_touches: usize,
    /// Length of the longest text that can become a job, in UTF-16 units (characters as JavaScript counts them).
    pub longest_text: usize,
    /// Length of the longest program whose moves are read, in the same units.
    pub longest_program: usize,
}

/// A cycle with its form and its source.
#[derive(Clone, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct CycleEntry {
    /// The value of `cycle.type` in a job.
    #[serde(rename = "type")]
    pub key: &'static str,
    /// Name given by its source.
    pub title: &'static str,
    /// What it measures: one sentence in English.
    pub says: &'static str,
    /// Further English search words.
    pub also: &'static str,
    /// Source and number: `ENCY/SprutCAM type 5`.
    pub source: &'static str,
    /// Type number in the source's parameter table, if it has one.
    pub number: Option<i32>,
    /// Whether its touches may be picked one by one (`cycle.touches`).
    pub touches: bool,
    /// Largest number of touches.
    pub max_touches: usize,
    /// Whether it has its own feeds and search length.
    pub own_feeds: bool,
    /// Page of the manual: a path in this repository.
    pub doc: String,
    /// The fields of its form, in order.
    pub fields: Vec<FieldEntry>,
    /// Forms inside its form.
    pub sections: Vec<CycleSectionEntry>,
    /// Its documented steps, in our words; index 0 is step 1.
    pub steps: &'static [&'static str],
}

/// A form inside a cycle's form.
#[derive(Clone, Debug, Serialize)]
pub struct CycleSectionEntry {
    /// Key of the object in `cycle`.
    pub key: &'static str,
    /// Whether it may be `null`; this is then its default.
    pub optional: bool,
    /// The fields of that object, in order.
    pub fields: Vec<FieldEntry>,
}

/// A kind of relation.
#[derive(Clone, Debug, Serialize)]
pub struct RelationEntry {
    /// The value of `relations[].type` in a job.
    #[serde(rename = "type")]
    pub key: &'static str,
    /// Label in English.
    pub label: &'static str,
    /// Its results: one sentence in English.
    pub says: &'static str,
    /// Whether its operands are positions, named by their cycles and relations; else single results.
    pub places: bool,
    /// Smallest number of operands.
    pub least: usize,
    /// Largest number of operands; null is any number.
    pub most: Option<usize>,
    /// Codes of its results; `.angle` is added to the first if the operands are angles.
    pub results: &'static [&'static str],
}

impl RelationEntry {
    fn of(def: &RelationDef) -> Self {
        let RelationDef {
            key,
            label,
            says,
            places,
            least,
            most,
            results,
            ..
        } = *def;
        RelationEntry {
            key,
            label,
            says,
            places,
            least,
            most,
            results,
        }
    }
}

/// One section of a job.
#[derive(Clone, Debug, Serialize)]
pub struct SectionEntry {
    /// Key in the job; empty for the job itself.
    pub path: &'static str,
    /// Whether it may be `null`; this is then its default.
    pub optional: bool,
    /// The fields of the section, in order.
    pub fields: Vec<FieldEntry>,
}

/// One field. Lengths are in mm, feeds in mm/min, angles in degrees, whatever the units of the job.
#[derive(Clone, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct FieldEntry {
    /// Key in its section.
    pub key: &'static str,
    /// Label in English.
    pub label: &'static str,
    /// Help text in English.
    pub help: &'static str,
    /// `number`, `count`, `flag`, `choice`, `code`, `text`, `point`, `nominal` or `nominalPoint`.
    pub kind: &'static str,
    /// `length`, `feed`, `acceleration`, `time`, `angle` or `none`.
    pub unit: &'static str,
    /// Smallest and largest allowed number; null for a flag, text or a fixed set of values.
    pub range: Option<[f64; 2]>,
    /// Whether the smallest number itself is excluded.
    pub above: bool,
    /// Smallest and largest usual number: the check warns outside of them. Null if every allowed number is usual.
    pub usual: Option<[f64; 2]>,
    /// Value in a job that leaves the field out.
    pub default: DefaultEntry,
    /// Start value for a new job in inch, in inch: a round number near `default`. A job in inch that leaves the field out has `default`.
    pub default_inch: DefaultEntry,
    /// Meaning of `null`; null if it is not allowed.
    pub null: Option<&'static str>,
    /// The allowed values of a choice or a code; else empty.
    pub choices: Vec<ChoiceEntry>,
    /// Code in the source's parameter table: `CmdPrm.Flt[-50]`. Null if it has no code.
    pub code: Option<&'static str>,
    /// Heading above the field in a form.
    pub group: &'static str,
    /// Whether `part.sizes` may change it.
    pub size: bool,
    /// Condition on another field of the form under which this one counts; null if it always counts.
    pub when: Option<WhenEntry>,
}

/// Condition on a field under which another one counts.
#[derive(Clone, Debug, Serialize)]
pub struct WhenEntry {
    /// Key of the other field, in the same form.
    pub key: &'static str,
    /// The code that it must have.
    pub value: i32,
}

/// One allowed value of a choice or a code.
#[derive(Clone, Debug, Serialize)]
pub struct ChoiceEntry {
    /// Word or number in the job.
    pub value: DefaultEntry,
    /// Label in English.
    pub label: &'static str,
}

/// A value in a job.
#[derive(Clone, Debug, Serialize)]
#[serde(untagged)]
pub enum DefaultEntry {
    /// A length in mm, a feed in mm/min, an angle in degrees, a count or a code.
    Number(f64),
    /// A switch: on or off.
    Flag(bool),
    /// Text, or the word of a choice.
    Text(&'static str),
    /// X, Y and Z in mm.
    Point([f64; 3]),
    /// `null`, with the meaning that its field gives it.
    Null,
}

/// A control that programs are written for.
#[derive(Clone, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct PostEntry {
    /// The value of `control.post` in a job.
    pub id: &'static str,
    /// Name of the control.
    pub title: &'static str,
    /// The usual file extension, without the dot.
    pub extension: &'static str,
    /// Highest number of a work offset that a program can write; 0 if it can write no offset.
    pub work_offsets: i32,
    /// Whether the job's `tool` section matters: plane and tool decide which length acts along the tool axis.
    pub first_length: bool,
    /// Whether its program watches positioning moves with the probe.
    pub watches: bool,
    /// Whether its program computes the results.
    pub computes: bool,
    /// Whether its program computes between the native cycles of a set-up: relations, and cycles that follow results.
    pub computes_between: bool,
    /// Whether its native cycles can correct a tool offset from a measured size.
    pub corrects_tools: bool,
    /// Whether those correct it by a share of the error, beyond a dead band, or by the mean of several parts.
    pub corrects_by_share: bool,
    /// Whether its programs of moves can correct a tool from the mean error of several parts.
    pub corrects_by_moves: bool,
    /// Fields of the job's sections `control` and `machine` that change nothing on it.
    pub unused: &'static [&'static str],
    /// Usual lines of a shop for `machine.frame`, by place.
    pub usual_lines: Vec<UsualLines>,
    /// Names of its work offsets, from number 1.
    pub work_offset_words: Vec<String>,
    /// Whether the control supports each cycle, in each form of the program.
    pub cycles: Vec<SupportEntry>,
}

/// Usual lines of a shop at one place of the program.
#[derive(Clone, Debug, Serialize)]
pub struct UsualLines {
    /// `head`, `probeOn`, …
    pub place: &'static str,
    /// The lines, with placeholders such as `{tool}`.
    pub lines: &'static [&'static str],
}

/// A group of codes in a parameter table.
#[derive(Clone, Debug, Serialize)]
pub struct CodeGroup {
    /// Heading of the group.
    pub title: &'static str,
    /// The lowest code, included.
    pub lowest: i32,
    /// The highest code, included.
    pub highest: i32,
}

/// A safety rule that every program is checked for.
#[derive(Clone, Debug, Serialize)]
pub struct RuleEntry {
    /// Name of the rule, as in the plan's `safety`.
    pub name: &'static str,
    /// Requirement for a program: one sentence.
    pub says: &'static str,
    /// Possible consequence of breaking it.
    pub why: &'static str,
}

/// Whether a control supports a cycle in a form.
#[derive(Clone, Debug, Serialize)]
pub struct SupportEntry {
    /// The value of `cycle.type`.
    #[serde(rename = "type")]
    pub key: &'static str,
    /// `moves`: plain moves and touches. `cycle`: the native cycle.
    pub form: &'static str,
    /// Whether the control supports the cycle in this form.
    pub supported: bool,
    /// Reason why not; null if it does.
    pub reason: Option<&'static str>,
    /// Whether this native cycle corrects the active preset, so that no work offset is chosen.
    #[serde(rename = "ownPreset")]
    pub own_preset: bool,
}

/// Every cycle, field, control and rule, as the checks use them.
pub fn catalog() -> Catalog {
    Catalog {
        format: FORMAT as u8,
        cycles: CYCLES.iter().map(|def| cycle_entry(def)).collect(),
        sections: SECTIONS
            .iter()
            .map(|form| SectionEntry {
                path: form.key,
                optional: form.optional,
                fields: entries(form.fields),
            })
            .collect(),
        relations: RELATIONS.iter().map(RelationEntry::of).collect(),
        posts: POSTS
            .iter()
            .map(|post| PostEntry {
                id: post.key,
                title: post.title,
                extension: post.extension,
                work_offsets: post.work_offsets,
                first_length: post.first_length,
                watches: post.watches_positioning,
                computes: post.computes,
                computes_between: post.own.is_some_and(|own| own.several.computes),
                corrects_tools: post
                    .own
                    .is_some_and(|own| own.corrects_tools != CorrectsTools::Never),
                corrects_by_share: post
                    .own
                    .is_some_and(|own| own.corrects_tools == CorrectsTools::AsAsked),
                corrects_by_moves: post.tools.is_some(),
                unused: post.unused,
                usual_lines: post
                    .usual_lines
                    .iter()
                    .map(|&(place, lines)| UsualLines { place, lines })
                    .collect(),
                work_offset_words: (1..=post.work_offsets).map(post.work_offset_word).collect(),
                cycles: CYCLES
                    .iter()
                    .flat_map(|def| {
                        ProgramForm::ALL.map(|form| {
                            let reason = (post.supports)(def.probes, form).err();
                            SupportEntry {
                                key: def.key,
                                form: form.word(),
                                supported: reason.is_none(),
                                reason,
                                own_preset: form == ProgramForm::Cycle
                                    && (post.cycle_sets_preset)(def.probes),
                            }
                        })
                    })
                    .collect(),
            })
            .collect(),
        rules: RULES
            .iter()
            .map(|rule| RuleEntry {
                name: rule.name,
                says: rule.requirement,
                why: rule.why,
            })
            .collect(),
        standing: STANDING,
        code_groups: CODE_GROUPS
            .iter()
            .map(|&(title, lowest, highest)| CodeGroup {
                title,
                lowest,
                highest,
            })
            .collect(),
        rapid_rate: RAPID_RATE,
        max_touches: MAX_TOUCHES,
        longest_text: LONGEST_TEXT,
        longest_program: LONGEST_PROGRAM,
    }
}

fn cycle_entry(def: &CycleDef) -> CycleEntry {
    CycleEntry {
        key: def.key,
        title: def.title,
        says: def.summary,
        also: def.search_words,
        source: def.source,
        number: def.number,
        touches: def.place.is_some(),
        max_touches: def.most_touches,
        own_feeds: def.own_feeds,
        doc: def.doc(),
        fields: entries(def.fields),
        sections: def
            .sections
            .iter()
            .map(|s| CycleSectionEntry {
                key: s.key,
                optional: s.optional,
                fields: entries(s.fields),
            })
            .collect(),
        steps: def.steps,
    }
}

fn choice_entry(choice: &Choice) -> ChoiceEntry {
    ChoiceEntry {
        value: DefaultEntry::Text(choice.value),
        label: choice.label,
    }
}

fn code_entry(code: &Code) -> ChoiceEntry {
    ChoiceEntry {
        value: DefaultEntry::Number(f64::from(code.value)),
        label: code.label,
    }
}

fn default_entry(default: Default) -> DefaultEntry {
    match default {
        Default::Number(x) => DefaultEntry::Number(x),
        Default::Flag(b) => DefaultEntry::Flag(b),
        Default::Text(text) => DefaultEntry::Text(text),
        Default::Point(p) => DefaultEntry::Point(p),
        Default::Null => DefaultEntry::Null,
    }
}

fn entries(fields: &[Field]) -> Vec<FieldEntry> {
    fields
        .iter()
        .map(|field| {
            let (kind, unit) = match field.kind {
                Kind::Length => ("number", "length"),
                Kind::Feed => ("number", "feed"),
                Kind::Acceleration => ("number", "acceleration"),
                Kind::Time => ("number", "time"),
                Kind::Angle => ("number", "angle"),
                Kind::Count => ("count", "none"),
                Kind::Flag => ("flag", "none"),
                Kind::Choice(_) => ("choice", "none"),
                Kind::Text(_) => ("text", "none"),
                Kind::Point => ("point", "length"),
                Kind::Code(_) => ("code", "none"),
                Kind::Nominal => ("nominal", "length"),
                Kind::NominalPoint => ("nominalPoint", "length"),
                Kind::Lines(_) => ("lines", "none"),
            };
            let choices = match field.kind {
                Kind::Choice(choices) | Kind::Lines(choices) => {
                    choices.iter().map(choice_entry).collect()
                }
                Kind::Code(codes) => codes.iter().map(code_entry).collect(),
                _ => Vec::new(),
            };
            FieldEntry {
                key: field.key,
                label: field.label,
                help: field.help,
                kind,
                unit,
                range: matches!(
                    kind,
                    "number" | "count" | "point" | "nominal" | "nominalPoint"
                )
                .then_some([field.hard.min, field.hard.max]),
                above: field.hard.above,
                usual: field.usual.map(|(min, max)| [min, max]),
                default: default_entry(field.default),
                default_inch: default_entry(job::typed_in_inch(field)),
                null: field.null,
                choices,
                code: (!field.code.is_empty()).then_some(field.code),
                group: field.group,
                size: field.size,
                when: field.when.map(|(key, value)| WhenEntry { key, value }),
            }
        })
        .collect()
}
