//! The TypeScript types of a job, printed from the one list of fields.

use std::fmt::Write;

use touchpath::cycle::{CYCLES, CycleDef};
use touchpath::form::{Field, Kind, SubForm};
use touchpath::formula::{RELATIONS, RelationDef};
use touchpath::job::{SECTIONS, STOCK};

const HEAD: &str = r#"// Generated from the crate's one list of fields: `UPDATE=1 cargo test --lib generated` writes it.

/** Lengths are in the job's units, feeds in units a minute, angles in degrees, counter-clockwise positive. */

/** X, Y, Z of the work coordinate system. */
export type Vec3 = [number, number, number];

/** A feed; `null` is rapid. */
export type FeedRate = number | null;

/** A number, or text: `10H7`, `10m`, `10+0.01-0.015`, `?`, `?10`, `10@10.02`. */
export type Nominal = number | string;

/** A size: a number, or text with its tolerance, `25 H7`, `25 +0.021 0`, `25 ±0.05`. In a set-up it may follow a result, `=BORE.diameter-2`. */
export type Size = number | string;

/** A picked touch: a point on the surface, and its outward normal, a unit vector. */
export interface PickedTouch {
  point: Vec3;
  vector: Vec3;
}

/** A code of the user, passed on unchanged. */
export interface CustomCode {
  code: number;
  type: "Int" | "Flt" | "Bol";
  value: number | boolean;
}

/** A step of a frame. */
export type FrameStep = { rot: "X" | "Y" | "Z"; angle: number } | { mirror: "X" | "Y" | "Z" };
"#;

/// Keys that every job may have besides its sections.
const TOLERANCES: &str = r#"  /** The tolerance of each result, by its code: `diameter`, in a set-up `BORE.diameter`. */
  tolerances?: Record<string, ResultTolerance> | null;
"#;

/// The tolerance of a result.
const RESULT_TOLERANCE: &str = r#"
/** The tolerance of a result, and the action when a value exceeds it. */
export interface ResultTolerance {
  /**
   * Relative to the nominal value (`H7`, `±0.02`, `+0.021/0`), or with it (`25H7`, `24.98..25.02`). In the job's units, for an angle in degrees.
   * Omit it if the size contains the tolerance.
   */
  tolerance?: string;
  /** The program continues, shows the result and continues, or stops with an alarm. Default: `go`. */
  action?: "go" | "mark" | "stop";
  /** The tool that is corrected from this size, by the macros of Fanuc-type controls in the form `cycle`. */
  wear?: Wear | null;
}

/** Correction of a tool by a macro, from a size that it measures. */
export interface Wear {
  /** The number of the tool offset. */
  tool: number;
  /** Feedback percentage: share of the error to correct, 1 to 100. Default: 100. */
  percent?: number;
  /** Dead band: error that is ignored, in the job's units, at most 1 mm. Default: 0. */
  deadBand?: number;
  /** Number of parts whose mean error is corrected. Default: each part corrects the tool. */
  parts?: number | null;
  /** With `parts`: the first of two tool offsets that no tool uses, in which the macro stores its values. */
  store?: number | null;
}
"#;

/// A job of several cycles.
const SET_UP: &str = r#"
/** A value of a cycle in a set-up: a number, or a result of an earlier cycle plus a number, such as `=TOP.z-5` or `=SIDE.rotation+90`. */
export type Followable = number | `=${string}`;

type Following<C> = {
  [K in keyof C]: K extends "origin"
    ? [Followable, Followable, Followable]
    : K extends "rotation"
      ? Followable
      : C[K];
};

/** A cycle of a set-up. Its name, a letter and then letters and digits, prefixes its results; the default names the measured feature. */
export type NamedCycle = Following<Cycle> & { name?: string };

/** Relations between the features of a set-up. A relation may use an earlier one. */
export interface Relation {
  /** Prefix of its results, like the name of a cycle. */
  name: string;
  /**
RELATION_SAYS   */
  type: RELATION_TYPES;
  /** Names of cycles and relations that measure a position in the plane, or results such as `BORE.diameter`. */
  of: string[];
}

/**
 * Several cycles in one program: one header, safe link moves between them, one write at the end. Omitted values have the catalog's defaults. Sizes of the
 * virtual part are prefixed with their cycle: `BORE.diameter`.
 */
export interface SetUp extends Omit<Job, "format" | "cycle"> {
  format: 2;
  cycles: NamedCycle[];
  /** Clearance plane between the cycles: height of the ball centre along the tool axis. `null`: the highest start or end of a cycle. */
  clear?: number | null;
  /**
   * Result written into each axis of the work offset, such as `BORE.center.x`: x is the abscissa, y the ordinate, z the tool axis. Default: the first cycle that
   * measures the axis. `null`: not written. A rotation is only written if it is specified.
   */
  datum?: { x?: string | null; y?: string | null; z?: string | null; rotation?: string | null };
  /** Relations: results computed from results of the cycles, prefixed with the relation's name. */
  relations?: Relation[] | null;
}
"#;

/// Operands of a relation: `two positions`, `three results or more`.
fn relation_of(def: &RelationDef) -> String {
    let count = ["no", "one", "two", "three", "four"][def.least];
    let what = if def.places { "places" } else { "results" };
    format!(
        "{count} {what}{}",
        if def.most.is_none() { " or more" } else { "" }
    )
}

fn relation_results(def: &RelationDef) -> String {
    let codes: Vec<String> = def.results.iter().map(|code| format!("`{code}`")).collect();
    let of_angles = if def.places {
        String::new()
    } else {
        format!(", of angles `{}.angle`", def.results[0])
    };
    codes.join(", ") + &of_angles
}

/// A relation in the manual's table.
pub fn relation_row(def: &RelationDef) -> String {
    format!(
        "| `{}` | {} | {}: {} |",
        def.key,
        relation_of(def),
        relation_results(def),
        def.says
    )
}

/// `internal-rectangle` as the name of a type.
fn type_name(key: &str) -> String {
    let capital = |word: &str| word[..1].to_uppercase() + &word[1..];
    key.split('-').map(capital).collect()
}

fn type_of(field: &Field) -> String {
    let own = match field.kind {
        Kind::Feed if field.null.is_some() => return "FeedRate".to_owned(),
        Kind::Length | Kind::Angle if field.size => "Size".to_owned(),
        Kind::Length | Kind::Feed | Kind::Acceleration | Kind::Time | Kind::Angle | Kind::Count => {
            "number".to_owned()
        }
        Kind::Flag => "boolean".to_owned(),
        Kind::Text(_) => "string".to_owned(),
        Kind::Lines(places) => {
            let own = places
                .iter()
                .map(|place| format!("{}?: string[]", place.value));
            format!("{{ {} }}", own.collect::<Vec<_>>().join("; "))
        }
        Kind::Choice(choices) => choices
            .iter()
            .map(|c| format!("\"{}\"", c.value))
            .collect::<Vec<_>>()
            .join(" | "),
        Kind::Code(codes) => codes
            .iter()
            .map(|c| c.value.to_string())
            .collect::<Vec<_>>()
            .join(" | "),
        Kind::Point => "Vec3".to_owned(),
        Kind::Nominal => "Nominal".to_owned(),
        Kind::NominalPoint => "[Nominal, Nominal, Nominal]".to_owned(),
    };
    if field.null.is_some() {
        format!("{own} | null")
    } else {
        own
    }
}

fn members(text: &mut String, fields: &[Field], indent: &str) {
    for field in fields {
        let null = field
            .null
            .map(|means| format!(" `null`: {means}."))
            .unwrap_or_default();
        let code = if field.code.is_empty() {
            String::new()
        } else {
            format!(" Code {}.", field.code)
        };
        let help = field.help.trim();
        assert!(!help.contains("*/"), "{}", field.key);
        writeln!(
            text,
            "{indent}/** {help}{null}{code} */\n{indent}{}?: {};",
            field.key,
            type_of(field)
        )
        .unwrap();
    }
}

/// Whether several cycles have this form inside their form: then it has a name.
fn shared(section: &SubForm) -> bool {
    CYCLES
        .iter()
        .filter(|def| def.sections.iter().any(|s| s.key == section.key))
        .count()
        > 1
}

fn cycle(text: &mut String, def: &CycleDef) {
    writeln!(text, "\n/** {}: {}. */", def.title, def.source).unwrap();
    writeln!(
        text,
        "export interface {} {{\n  type: \"{}\";",
        type_name(def.key),
        def.key
    )
    .unwrap();
    members(text, def.fields, "  ");
    for section in def.sections {
        let null = if section.optional { " | null" } else { "" };
        if shared(section) {
            writeln!(
                text,
                "  {}?: {}{null};",
                section.key,
                type_name(section.key)
            )
            .unwrap();
        } else {
            writeln!(text, "  {}?: {{", section.key).unwrap();
            members(text, section.fields, "    ");
            writeln!(text, "  }}{null};").unwrap();
        }
    }
    if def.place.is_some() {
        text.push_str("  /** Touches picked in the Job Assignment. They replace the points computed from the dimensions. */\n  touches?: PickedTouch[] | null;\n");
    }
    if def.number.is_some() {
        text.push_str("  custom?: CustomCode[] | null;\n");
    }
    text.push_str("}\n");
}

/// The whole file.
pub fn job_types() -> String {
    let mut text = HEAD.to_owned();
    let mut named: Vec<&str> = Vec::new();
    for section in CYCLES
        .iter()
        .flat_map(|def| def.sections)
        .filter(|s| shared(s))
    {
        if !named.contains(&section.key) {
            named.push(section.key);
            writeln!(
                text,
                "\n/** Fields that several cycles have as `{}`. */\nexport interface {} {{",
                section.key,
                type_name(section.key)
            )
            .unwrap();
            members(&mut text, section.fields, "  ");
            text.push_str("}\n");
        }
    }
    for def in CYCLES {
        cycle(&mut text, def);
    }
    text.push_str("\nexport type Cycle =");
    for def in CYCLES {
        write!(text, "\n  | {}", type_name(def.key)).unwrap();
    }
    text.push_str(
        ";\n\n/** A probing job. Omitted values have the catalog's defaults. */\nexport interface Job {\n  format: 1;\n",
    );
    for section in SECTIONS {
        if section.key.is_empty() {
            members(&mut text, section.fields, "  ");
            continue;
        }
        if section.key == STOCK.key {
            text.push_str("  /** The block that the features are cut into, parallel to the axes; `null`: unknown and not checked. */\n");
        }
        writeln!(text, "  {}?: {{", section.key).unwrap();
        members(&mut text, section.fields, "    ");
        match section.key {
            "tool" => text.push_str("    /** Steps of the active frame, in order. */\n    frame?: FrameStep[];\n"),
            "part" => text.push_str(
                "    /** Deviation of each size of the part, by the field's key. */\n    sizes?: Record<string, number>;\n",
            ),
            _ => {}
        }
        text.push_str(if section.optional {
            "  } | null;\n"
        } else {
            "  };\n"
        });
    }
    text.push_str(TOLERANCES);
    text.push_str("  cycle: Cycle;\n}\n");
    text.push_str(RESULT_TOLERANCE);
    let types: Vec<String> = RELATIONS
        .iter()
        .map(|def| format!("\"{}\"", def.key))
        .collect();
    let says: String = RELATIONS
        .iter()
        .map(|def| {
            format!(
                "   * `{}`, of {}: {}.\n",
                def.key,
                relation_of(def),
                relation_results(def)
            )
        })
        .collect();
    text.push_str(
        &SET_UP
            .replace("RELATION_SAYS", &says)
            .replace("RELATION_TYPES", &types.join(" | ")),
    );
    let posts: Vec<String> = touchpath::control::POSTS
        .iter()
        .map(|post| format!("  | \"{}\"", post.key))
        .collect();
    writeln!(
        text,
        "\n/** The id of a control. */\nexport type PostId =\n{};",
        posts.join("\n")
    )
    .unwrap();
    text
}
