//! Everything a form needs: a reader of the one list of fields.

use serde::Serialize;

use crate::control::safety::RULES;
use crate::control::{Form, POSTS};
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
    /// What programs are checked for.
    pub rules: Vec<RuleEntry>,
    /// Codes of findings that hold for a control and form whatever the job: a page may say them once, at the control's name.
    pub standing: &'static [&'static str],
    /// What the codes of a CmdPrm table are about; the first that fits counts.
    pub code_groups: Vec<CodeGroup>,
    /// The rate that rapids are taken to have in `plan().time`, mm/min, where the program states none for them.
    pub rapid_rate: f64,
    /// The most touches that a parameter table of CmdPrm codes holds. The entry of a cycle has its own number.
    pub max_touches: usize,
    /// The longest text that a job is made of, in characters as JavaScript counts them (UTF-16 units).
    pub longest_text: usize,
    /// The longest program whose moves are read, likewise.
    pub longest_program: usize,
}

/// A cycle, its form, and where it is documented.
#[derive(Clone, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct CycleEntry {
    /// The value of `cycle.type` in a job.
    #[serde(rename = "type")]
    pub key: &'static str,
    /// The name that its source gives it.
    pub title: &'static str,
    /// What it measures, in a sentence, in English.
    pub says: &'static str,
    /// What else people look for it by, in English: words for a search.
    pub also: &'static str,
    /// Who documents it, and as what: `ENCY/SprutCAM type 5`.
    pub source: &'static str,
    /// Its type number in the source's parameter table, where it has one.
    pub number: Option<i32>,
    /// Whether its touches may be picked one by one (`cycle.touches`).
    pub touches: bool,
    /// The most touches it can have.
    pub max_touches: usize,
    /// Whether it has feeds and a search length of its own.
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
    /// Whether it may be `null`, which is then its default.
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
    /// Its name for people, in English.
    pub label: &'static str,
    /// What its results are, in English.
    pub says: &'static str,
    /// Whether its operands are positions, named by their cycles and relations; else single results.
    pub places: bool,
    /// The fewest operands.
    pub least: usize,
    /// The most operands; null if it takes any number.
    pub most: Option<usize>,
    /// The codes of its results; of angles `.angle` is added to the first.
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
    /// Its key in the job, empty for the job itself.
    pub path: &'static str,
    /// Whether it may be `null`, which is then its default.
    pub optional: bool,
    /// The fields of the section, in order.
    pub fields: Vec<FieldEntry>,
}

/// One field. Lengths are in mm, feeds in mm/min, angles in degrees, whatever the job's units.
#[derive(Clone, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct FieldEntry {
    /// Key in its section.
    pub key: &'static str,
    /// Short name for people, in English.
    pub label: &'static str,
    /// What the field is for, in English.
    pub help: &'static str,
    /// `number`, `count`, `flag`, `choice`, `code`, `text`, `point`, `nominal` or `nominalPoint`.
    pub kind: &'static str,
    /// `length`, `feed`, `acceleration`, `time`, `angle` or `none`.
    pub unit: &'static str,
    /// Smallest and largest allowed number; null for a flag, text or a fixed set of values.
    pub range: Option<[f64; 2]>,
    /// Whether the smallest number itself is excluded.
    pub above: bool,
    /// Smallest and largest usual number: the check warns outside of them. Null where every allowed number is usual.
    pub usual: Option<[f64; 2]>,
    /// The value in a job that leaves the field out.
    pub default: DefaultEntry,
    /// What a new job in inch begins with, in inch: a number that people type, near to `default`. A job in inch that leaves the field out has `default`.
    pub default_inch: DefaultEntry,
    /// What `null` means; null where it is not allowed.
    pub null: Option<&'static str>,
    /// The allowed values of a choice or a code; else empty.
    pub choices: Vec<ChoiceEntry>,
    /// Its code in the source's parameter table: `CmdPrm.Flt[-50]`. Null where it has none.
    pub code: Option<&'static str>,
    /// The heading under which a form shows it.
    pub group: &'static str,
    /// Whether `part.sizes` may change it.
    pub size: bool,
    /// What another field of its form must be for this one to count; null where it always counts.
    pub when: Option<WhenEntry>,
}

/// What a field must be for another one to count.
#[derive(Clone, Debug, Serialize)]
pub struct WhenEntry {
    /// Key of that other field, in the same form.
    pub key: &'static str,
    /// The code that it must have.
    pub value: i32,
}

/// One allowed value of a choice or a code.
#[derive(Clone, Debug, Serialize)]
pub struct ChoiceEntry {
    /// The word, or the number, in the job.
    pub value: DefaultEntry,
    /// The same for people, in English.
    pub label: &'static str,
}

/// A value as a job has it.
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
    /// The control's name, for people.
    pub title: &'static str,
    /// The usual file extension, without the dot.
    pub extension: &'static str,
    /// Highest number of a work offset that a program can write; 0 where it can write none.
    pub work_offsets: i32,
    /// Whether the job's `tool` section matters: plane and tool decide which length acts along the tool axis.
    pub first_length: bool,
    /// Whether its program watches positioning moves with the probe.
    pub watches: bool,
    /// Whether its program computes the results itself.
    pub computes: bool,
    /// Whether its own cycles can correct a tool offset from a measured size.
    pub corrects_tools: bool,
    /// The fields of the job's section `control` that change nothing on it.
    pub unused: &'static [&'static str],
    /// What its work offsets are called, from number 1.
    pub work_offset_words: Vec<String>,
    /// For each cycle, and each form of the program, whether the control takes it.
    pub cycles: Vec<SupportEntry>,
}

/// What some codes of a parameter table are about.
#[derive(Clone, Debug, Serialize)]
pub struct CodeGroup {
    /// What these codes are about, as a heading.
    pub title: &'static str,
    /// The lowest code, included.
    pub lowest: i32,
    /// The highest code, included.
    pub highest: i32,
}

/// A safety rule, as every program is checked for it.
#[derive(Clone, Debug, Serialize)]
pub struct RuleEntry {
    /// Its name, by which the plan's `safety` refers to it.
    pub name: &'static str,
    /// What it demands of a program, in a sentence.
    pub says: &'static str,
    /// What could happen without it.
    pub why: &'static str,
}

/// Whether a control takes a cycle in a form.
#[derive(Clone, Debug, Serialize)]
pub struct SupportEntry {
    /// The value of `cycle.type`.
    #[serde(rename = "type")]
    pub key: &'static str,
    /// `moves`: plain moves and touches. `cycle`: the native cycle.
    pub form: &'static str,
    /// Whether the control takes the cycle in this form.
    pub supported: bool,
    /// Why not; null where it does.
    pub reason: Option<&'static str>,
    /// Whether this native cycle corrects the active preset, so that no work offset is chosen.
    #[serde(rename = "ownPreset")]
    pub own_preset: bool,
}

/// Every cycle, field, control and rule, as the checks themselves have them.
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
                watches: post.watches,
                computes: post.computes,
                corrects_tools: post.own.is_some_and(|own| own.corrects_tools),
                unused: post.unused,
                work_offset_words: (1..=post.work_offsets).map(post.work_offset_word).collect(),
                cycles: CYCLES
                    .iter()
                    .flat_map(|def| {
                        Form::ALL.map(|form| {
                            let reason = (post.serves)(def.probes, form).err();
                            SupportEntry {
                                key: def.key,
                                form: form.word(),
                                supported: reason.is_none(),
                                reason,
                                own_preset: form == Form::Cycle && (post.own_preset)(def.probes),
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
                says: rule.says,
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
        says: def.says,
        also: def.also,
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
            };
            let choices = match field.kind {
                Kind::Choice(choices) => choices.iter().map(choice_entry).collect(),
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
