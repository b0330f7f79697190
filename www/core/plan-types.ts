// Generated from the crate's structs: `UPDATE=1 cargo test --lib generated` writes it.

import type { Cycle, PostId, Relation, Vec3 } from "./job-types.js";
import type { Said } from "./said.js";

/** Every code of a finding; docs/findings.md says what each means. */
export type FindingCode =
  | "align-needs-confirm"
  | "angle-rounded"
  | "approach-beyond-wall"
  | "approach-not-watched"
  | "arc-unsolved"
  | "ball-too-wide"
  | "ball-unknown"
  | "beyond-travel"
  | "block-to-type"
  | "block-too-long"
  | "branch-ends"
  | "circle-in-circle"
  | "clear-too-low"
  | "clearance-height-too-low"
  | "clearance-too-small"
  | "code-twice"
  | "collision"
  | "contact-at-start"
  | "converted"
  | "crossing-too-low"
  | "cycle-chooses-points"
  | "cycle-differs"
  | "cycle-name"
  | "cycle-no-lift"
  | "cycle-no-zone"
  | "cycle-not-parallel"
  | "cycle-not-square"
  | "cycle-one-path"
  | "cycle-path-short"
  | "cycle-plane"
  | "cycle-stops"
  | "datum-apart"
  | "datum-unknown"
  | "dist-needed"
  | "dist-too-short"
  | "division-by-zero"
  | "dry-run-unsupported"
  | "edge-contact"
  | "extrusion-direction"
  | "feeds-of-set-up"
  | "field-unused"
  | "form-unsupported"
  | "given-incomplete"
  | "given-position"
  | "header-unknown"
  | "header-unsound"
  | "implausible"
  | "keep-out"
  | "length-not-along-tool-axis"
  | "length-to-centre"
  | "lift-unused"
  | "limit-stops"
  | "limits-not-asked"
  | "lines-differ"
  | "lines-optional"
  | "lines-skipped"
  | "locked"
  | "low-crossing"
  | "low-rapid"
  | "low-start"
  | "machine-places"
  | "macro-not-seen"
  | "macro-stops"
  | "missing"
  | "missing-code"
  | "missing-parameter"
  | "mixed-forms"
  | "more-findings"
  | "moves-before-cycle"
  | "name-changed"
  | "needs-calibration"
  | "nested-too-deeply"
  | "newer-format"
  | "no-arc"
  | "no-block"
  | "no-circle"
  | "no-contact"
  | "no-direction"
  | "no-extrusion"
  | "no-job-in-program"
  | "no-moves"
  | "no-results-in-program"
  | "no-retract"
  | "no-touches"
  | "no-units"
  | "not-a-flag"
  | "not-a-number"
  | "not-a-tolerance"
  | "not-a-value"
  | "not-allowed"
  | "not-at-feed"
  | "not-called"
  | "not-finite"
  | "not-in-dump"
  | "not-in-program"
  | "not-json"
  | "not-known"
  | "not-on-one-circle"
  | "not-on-one-wall"
  | "not-proven"
  | "not-rectangular"
  | "not-understood"
  | "not-verified"
  | "not-whole"
  | "nothing-switched"
  | "nothing-to-import"
  | "nothing-to-write"
  | "number-protected"
  | "number-unused"
  | "offset-in-parts"
  | "offset-measured-again"
  | "offset-one-direction"
  | "offset-optional"
  | "order-of-cycles"
  | "orient-unsupported"
  | "other-control"
  | "other-form"
  | "other-units"
  | "other-version"
  | "out-of-range"
  | "out-of-tolerance"
  | "overtravel-too-short"
  | "own-codes"
  | "own-moves"
  | "own-path"
  | "pairs-not-square"
  | "part-not-in-program"
  | "passed-over"
  | "passes-close"
  | "path-not-above"
  | "picks-differ"
  | "picks-out-of-range"
  | "place-of-result"
  | "place-too-far"
  | "places-computed"
  | "places-transformed"
  | "plane-from-dump"
  | "plane-unknown"
  | "plane-unsupported"
  | "points-differ"
  | "portal"
  | "positioning-not-watched"
  | "predefined"
  | "probe-move-too-short"
  | "probe-word"
  | "probing-too-fast"
  | "program-differs"
  | "program-stops"
  | "protection-unsupported"
  | "rapid-at-feed"
  | "reaction-unsupported"
  | "relation-not-computed"
  | "relation-of"
  | "repeat-unsupported"
  | "result-missing"
  | "result-twice"
  | "result-untrue"
  | "rotary-unsupported"
  | "rotation-not-written"
  | "rotation-unsupported"
  | "row-activated"
  | "rule-broken"
  | "search-too-short"
  | "semi-automatic"
  | "semi-automatic-unsupported"
  | "set-up-too-long"
  | "set-up-unsupported"
  | "several-cycles"
  | "shank-collision"
  | "short-arc"
  | "small-hole"
  | "start-in-feature"
  | "start-unknown"
  | "starts-disagree"
  | "stops-too-late"
  | "stylus-from-dump"
  | "stylus-not-known"
  | "text-too-long"
  | "tolerance-beyond-limit"
  | "tolerance-elsewhere"
  | "tolerance-unknown"
  | "tolerance-unsupported"
  | "too-far"
  | "too-long"
  | "too-many-digits"
  | "too-many-registers"
  | "too-many-touches"
  | "tool-axis-reversed"
  | "tool-by-name"
  | "tool-corrected"
  | "tool-length-unchecked"
  | "touch-above-top"
  | "touch-aside"
  | "touch-askew"
  | "touch-beyond-corner"
  | "touch-close"
  | "touch-fast"
  | "touch-missed"
  | "touch-missing"
  | "touch-near-edge"
  | "touch-too-short"
  | "touches-coincide"
  | "touches-kept"
  | "touches-not-level"
  | "touches-unsound"
  | "turn-beyond-limit"
  | "uncertain-result"
  | "unclear-line"
  | "units-differ"
  | "units-found"
  | "units-not-stated"
  | "units-unclear"
  | "units-unknown"
  | "unknown-code"
  | "unknown-key"
  | "unknown-parameter"
  | "unknown-result"
  | "unknown-type"
  | "unknown-value"
  | "unreadable"
  | "unsafe-program"
  | "unusable"
  | "unusual"
  | "vector-not-in-plane"
  | "vector-not-unit"
  | "vector-not-upwards"
  | "vector-wrong-way"
  | "vectors-not-opposite"
  | "walls-parallel"
  | "wear-off-middle"
  | "wear-unlimited"
  | "wear-unsupported"
  | "words-twice"
  | "work-offset-needed"
  | "work-offset-unclear"
  | "work-offset-unsupported"
  | "wrong-code"
  | "wrong-count"
  | "wrong-type"
  | "wrong-wall"
  | "zone-beyond-clearance"
  | "zone-beyond-dist";

/** Every safety rule. */
export type RuleName =
  | "modes-stated"
  | "spindle-off"
  | "probe-asked"
  | "probe-free-again"
  | "low-start-goes-up"
  | "positioning-watched"
  | "contact-lifts"
  | "missed-touch-stops"
  | "missed-touch-lifts"
  | "feeds-stated"
  | "no-low-rapid"
  | "offset-after-touches"
  | "one-write"
  | "plausible-before-write"
  | "tolerance-obeyed"
  | "place-within-limit"
  | "restart-writes-nothing"
  | "ends-above";

/** Every code of a result. */
export type ResultCode =
  | "center.x"
  | "center.y"
  | "diameter"
  | "residual"
  | "width"
  | "width1"
  | "width2"
  | "rotation"
  | "height"
  | "corner.x"
  | "corner.y"
  | "corner.z"
  | "angle"
  | "residual1"
  | "residual2"
  | "point.x"
  | "point.y"
  | "point.z"
  | "deviation"
  | "offset.x"
  | "offset.y"
  | "offset.z"
  | "offset.rotation"
  | "distance"
  | "difference"
  | "difference.angle"
  | "mean"
  | "mean.angle"
  | "spread"
  | "Q183"
  | "Q950"
  | "Q951"
  | "Q952"
  | "Q953"
  | "Q954"
  | "Q955"
  | "Q964"
  | "Q965"
  | "Q966"
  | "Q967"
  | "Q970"
  | "Q971"
  | "Q973"
  | "Q974"
  | "Q980"
  | "Q981"
  | "Q982"
  | "Q983"
  | "Q984"
  | "Q985"
  | "Q994"
  | "Q995"
  | "Q996"
  | "Q997"
  | "form1"
  | "form2"
  | "preset.table"
  | "preset.x"
  | "preset.y"
  | "preset.z"
  | "preset.rotation"
  | "table.turn";

/** What a tolerance or a limit makes of a value. */
export type Judged =
  | "good"
  | "rework"
  | "scrap"
  | "undefined"
  | "implausible"
  | "good within ±"
  | "out"
  | "out within ±";

/** The verdict of a value, or of the whole workpiece (`Q183`), with what the control does then. */
export type Verdict = Judged | `${Judged}: ${string}`;

/** How much a finding weighs. */
export type Level = "error" | "warning" | "info";

/** A problem, or something worth knowing. */
export interface Finding {
  /** Whether it keeps the job from being planned. */
  level: Level;
  /** A stable, kebab-case name for programs to switch on, one of those in docs/findings.md. */
  code: FindingCode;
  /** The place in the job: `cycle.sideClearance1`, `feeds.work`; empty for the job as a whole. */
  path: string;
  /** Plain words for a person, with numbers in the job's units. */
  message: string;
  /** The message as a template and its values: with a list of words it can be said in another language. */
  said: Said;
}

/** Where the ball is to touch the nominal part. */
export interface TouchPoint {
  /** The point that is touched, on the surface. */
  point: Vec3;
  /** Target vector: outward normal of the surface, of length one. */
  vector: Vec3;
  /** Which wall or circle it is on, from 0. */
  group: number;
  /** Index of its cycle in a set-up; 0 for a job of one cycle. */
  cycle: number;
}

/** An arc about the tool axis. */
export interface Arc {
  /** Its centre, at the height of the move. */
  center: Vec3;
  /** Degrees, counter-clockwise positive seen against the tool axis; less than a whole turn. */
  sweep: number;
}

/** One move of the ball centre. */
export interface Move {
  /** Where it ends; a touch at its nominal contact. */
  to: Vec3;
  /** `approach`, `longLink`, `work`, `retract`, `return` or `rapid`. */
  feed: "approach" | "longLink" | "work" | "retract" | "return" | "rapid";
  /** `position`, `touch` or `back`. */
  kind: "position" | "touch" | "back";
  /** Step of the cycle's documented list, from 1; 0 on the way between two cycles. Where native cycles make it: which line makes it, from that of the first move on. */
  step: number;
  /** Index of the touch that it makes or comes back from; null for positioning. */
  touch: number | null;
  /** The arc it runs along; null is a straight line. */
  arc: Arc | null;
  /** Index of its cycle in a set-up, or of the one that it leads to; 0 for a job of one cycle. */
  cycle: number;
}

/** The value of a parameter. */
export type ParameterValue = number | boolean | string;

/** One row of the parameter table. */
export interface ParameterRow {
  /** `CmdPrm.Flt[-53]`, or `Q1116` for a HEIDENHAIN cycle. */
  code: string;
  /** The type column of the source. */
  type: string;
  /** The value, lengths in the job's units. */
  value: ParameterValue;
  /** What it means, in English; `meanings(job)` has it for other languages. */
  meaning: string;
  /** Path of the job's field it comes from. */
  field: string | null;
  /** Index of the touch it comes from; null if it concerns the whole cycle. */
  touch: number | null;
  /** Index of its cycle in a set-up; 0 for a job of one cycle. */
  cycle: number;
}

/** A value that the cycle measures: what the control computes, and what it should be. */
export interface ResultRow {
  /** A stable name, one of `RESULT_CODES`: `center.x`. */
  code: ResultCode;
  /** What the value is, in English. */
  meaning: string;
  /** `mm`, `inch` or `deg`; empty for a number without a unit. */
  unit: "mm" | "inch" | "deg" | "";
  /** Its value on the nominal part; null where that is not known. */
  nominal: number | null;
  /** What the control computes; null where the triggers cannot give it. */
  value: number | null;
  /** Value less nominal, or less the middle of the tolerance zone. */
  deviation: number | null;
  /** One sigma of the value: scatter of the touches, and eccentricity of the ball. */
  uncertainty: number | null;
  /** How much of it comes from the ball's eccentricity: one sigma of that alone. Null where the job says none, or turns the spindle to the angle of calibration. */
  uncertaintyRunout: number | null;
  /** Lower and upper limit, where a tolerance is given. */
  limits: [number, number] | null;
  /** Good, rework or scrap, where a tolerance is given; implausible, where it is off by more than its limit. */
  verdict: Verdict | null;
  /** The true value on the virtual part, where there is one. */
  truth: number | null;
  /** Why the value is not the truth, where it is not. */
  note: string | null;
  /** Where the control has it after its own cycles: `#135`. Null of a program of moves, whose header says it. */
  stored: string | null;
  /** Index of its cycle in a set-up, or behind all cycles that of its relation; 0 for a job of one cycle. */
  cycle: number;
  /** Its words as templates and their values. */
  said: ResultWords;
}

/** The words of a result, to be put into other languages. */
export interface ResultWords {
  /** What the value is. */
  meaning: Said;
  /** Good, rework or scrap, where a tolerance is given. */
  verdict: Said | null;
  /** Why the value is not the truth, where it is not. */
  note: Said | null;
}

/** What was proven of a program of moves: read back, it is the path. */
export interface ProofRow {
  /** How many moves of the path it makes, each where and how it should. */
  moves: number;
  /** How many of them are touches. */
  touches: number;
  /** Whether the program computes the results itself, and the right ones. */
  arithmetic: boolean;
}

/** Whether the program keeps a safety rule. */
export interface SafetyRow {
  /** The name of the rule. */
  rule: RuleName;
  /** Null where this control cannot hold it, or its own cycle answers for it. */
  holds: boolean | null;
  /** What the rule asks, what is wrong, or why the control cannot. */
  message: string;
  /** The same as a template and its values. */
  said: Said;
  /** The 0-based lines that break it. */
  lines: number[];
  /** The 0-based lines that it was asked of, whether they keep or break it; those of the native cycle where that answers for it. */
  about: number[];
}

/** The program as text. */
export interface ProgramText {
  /** Which control it is for. */
  post: string;
  /** The usual file extension, without the dot. */
  extension: string;
  /** Its lines, each ended by a line feed. */
  text: string;
  /** For each move the 0-based line that makes it; −1 where the native cycle makes it. */
  moveLines: number[];
  /** What it writes, in its own blocks or by the cycle that it calls. Of the work offset: axes in the order `X`, `Y`, `Z`, then `rotation`. Of the active preset: `preset X` …, then `basic rotation` or `table offset`. Empty where it measures only. */
  writes: ("X" | "Y" | "Z" | "rotation" | "preset X" | "preset Y" | "preset Z" | "basic rotation" | "table offset")[];
  /** What it does with offsets and presets, in one sentence: `writes G54 X Y`, `measures only`. */
  does: string;
  /** The same as a template and its values. */
  said: Said;
  /** What was proven of it; null in the form `cycle`. */
  proof: ProofRow | null;
  /** Whether the moves of the plan are those that native cycles make, which the program calls. */
  own: boolean;
}

/** What can be written into an axis of a work offset, or into its rotation. */
export interface DatumRow {
  /** `x`, `y`, `z` or `rotation`: abscissa, ordinate, tool axis. */
  axis: "x" | "y" | "z" | "rotation";
  /** The result that is written, `BORE.center.x`, or would be if a work offset were chosen; null where none is. */
  from: string | null;
  /** Every result that can be. */
  choices: string[];
}

/** Everything that follows from a job. Lengths in the job's units, angles in degrees. */
export interface Plan {
  /** The nominal touches, on the surface. */
  touches: TouchPoint[];
  /** The moves, of the ball centre. */
  moves: Move[];
  /** The names of the cycles of a set-up, in their order; empty for a job of one cycle. */
  cycles: string[];
  /** The names of the relations of a set-up, in their order. */
  relations: string[];
  /** Of a set-up, what can be written into each axis of a work offset and into its rotation, and what is; empty for a job of one cycle. */
  datum: DatumRow[];
  /** Length of the whole path: from where the job says the ball is, else from where the first move ends. */
  length: number;
  /** Minutes for the same. Rapids run at 5000 mm/min, or at the feed that the control's program states for them. */
  time: number;
  /** The program, for the control of the job. */
  program: ProgramText;
  /** The cycle's parameters as its source numbers them. */
  table: ParameterRow[];
  /** Results the control will store, for the virtual part. */
  results: ResultRow[];
  /** Ball centre at the trigger of each touch on the virtual part; null where it is not met in time. */
  triggers: (Vec3 | null)[];
  /** Warnings and notes; with an error there is no plan. */
  findings: Finding[];
  /** For each safety rule, whether the program keeps it. */
  safety: SafetyRow[];
}

/** What follows from measured values. Lengths in the job's units, angles in degrees. */
export interface Measurement {
  /** As a plan has them, from what was measured: `truth` is null. */
  results: ResultRow[];
  /** The ball centre at each touch, in the work coordinate system; null where it made no contact. Empty where the text gives results and no touches. */
  points: (Vec3 | null)[];
  /** On grbl, which cannot write a work offset from a program: the block that the operator types before the next move. Null if nothing has to be typed; a finding gives the reason. */
  block: string | null;
  /** How the values were read, and what is missing: warnings and notes. */
  findings: Finding[];
}

/** What a motion does. */
export type TraceKind = "rapid" | "feed" | "watched" | "touch" | "unchecked";

/** One move of a program. */
export interface TraceMove {
  /** Where it ends; null along an axis that no block has named yet. */
  to: [number | null, number | null, number | null];
  /** `rapid`, `feed`, `watched`, `touch` or `unchecked`. */
  kind: TraceKind;
  /** Null is a rapid, or a feed that no block has stated. */
  feed: number | null;
  /** The 0-based line that makes it. */
  line: number;
}

/** The moves of a program that says no job. */
export interface TraceRow {
  /** The control whose language it was read in. */
  control: string;
  /** `mm`, `inch`, or null where it does not say. */
  units: "mm" | "inch" | null;
  /** Its moves, in its units. */
  moves: TraceMove[];
}

/** A value as a job has it. */
export type DefaultEntry = number | boolean | string | Vec3 | null;

/** One allowed value of a choice or a code. */
export interface ChoiceEntry {
  /** The word, or the number, in the job. */
  value: string | number;
  /** The same for people, in English. */
  label: string;
}

/** What a field must be for another one to count. */
export interface WhenEntry {
  /** Key of that other field, in the same form. */
  key: string;
  /** The code that it must have. */
  value: number;
}

/** One field. Lengths are in mm, feeds in mm/min, angles in degrees, whatever the job's units. */
export interface FieldEntry {
  /** Key in its section. */
  key: string;
  /** Short name for people, in English. */
  label: string;
  /** What the field is for, in English. */
  help: string;
  /** `number`, `count`, `flag`, `choice`, `code`, `text`, `point`, `nominal` or `nominalPoint`. */
  kind: "number" | "count" | "flag" | "choice" | "code" | "text" | "point" | "nominal" | "nominalPoint";
  /** `length`, `feed`, `acceleration`, `time`, `angle` or `none`. */
  unit: "length" | "feed" | "acceleration" | "time" | "angle" | "none";
  /** Smallest and largest allowed number; null for a flag, text or a fixed set of values. */
  range: [number, number] | null;
  /** Whether the smallest number itself is excluded. */
  above: boolean;
  /** Smallest and largest usual number: the check warns outside of them. Null where every allowed number is usual. */
  usual: [number, number] | null;
  /** The value in a job that leaves the field out. */
  default: DefaultEntry;
  /** What a new job in inch begins with, in inch: a number that people type, near to `default`. A job in inch that leaves the field out has `default`. */
  defaultInch: DefaultEntry;
  /** What `null` means; null where it is not allowed. */
  null: string | null;
  /** The allowed values of a choice or a code; else empty. */
  choices: ChoiceEntry[];
  /** Its code in the source's parameter table: `CmdPrm.Flt[-50]`. Null where it has none. */
  code: string | null;
  /** The heading under which a form shows it. */
  group: string;
  /** Whether `part.sizes` may change it. */
  size: boolean;
  /** What another field of its form must be for this one to count; null where it always counts. */
  when: WhenEntry | null;
}

/** A form inside a cycle's form. */
export interface CycleSectionEntry {
  /** Key of the object in `cycle`. */
  key: string;
  /** Whether it may be `null`, which is then its default. */
  optional: boolean;
  /** The fields of that object, in order. */
  fields: FieldEntry[];
}

/** A cycle, its form, and where it is documented. */
export interface CycleEntry {
  /** The value of `cycle.type` in a job. */
  type: Cycle["type"];
  /** The name that its source gives it. */
  title: string;
  /** What it measures, in a sentence, in English. */
  says: string;
  /** What else people look for it by, in English: words for a search. */
  also: string;
  /** Who documents it, and as what: `ENCY/SprutCAM type 5`. */
  source: string;
  /** Its type number in the source's parameter table, where it has one. */
  number: number | null;
  /** Whether its touches may be picked one by one (`cycle.touches`). */
  touches: boolean;
  /** The most touches it can have. */
  maxTouches: number;
  /** Whether it has feeds and a search length of its own. */
  ownFeeds: boolean;
  /** Page of the manual: a path in this repository. */
  doc: string;
  /** The fields of its form, in order. */
  fields: FieldEntry[];
  /** Forms inside its form. */
  sections: CycleSectionEntry[];
  /** Its documented steps, in our words; index 0 is step 1. */
  steps: string[];
}

/** One section of a job. */
export interface SectionEntry {
  /** Its key in the job, empty for the job itself. */
  path: string;
  /** Whether it may be `null`, which is then its default. */
  optional: boolean;
  /** The fields of the section, in order. */
  fields: FieldEntry[];
}

/** A kind of relation. */
export interface RelationEntry {
  /** The value of `relations[].type` in a job. */
  type: Relation["type"];
  /** Its name for people, in English. */
  label: string;
  /** What its results are, in English. */
  says: string;
  /** Whether its operands are positions, named by their cycles and relations; else single results. */
  places: boolean;
  /** The fewest operands. */
  least: number;
  /** The most operands; null if it takes any number. */
  most: number | null;
  /** The codes of its results; of angles `.angle` is added to the first. */
  results: ResultCode[];
}

/** Whether a control takes a cycle in a form. */
export interface SupportEntry {
  /** The value of `cycle.type`. */
  type: Cycle["type"];
  /** `moves`: plain moves and touches. `cycle`: the native cycle. */
  form: "moves" | "cycle";
  /** Whether the control takes the cycle in this form. */
  supported: boolean;
  /** Why not; null where it does. */
  reason: string | null;
  /** Whether this native cycle corrects the active preset, so that no work offset is chosen. */
  ownPreset: boolean;
}

/** A control that programs are written for. */
export interface PostEntry {
  /** The value of `control.post` in a job. */
  id: PostId;
  /** The control's name, for people. */
  title: string;
  /** The usual file extension, without the dot. */
  extension: string;
  /** Highest number of a work offset that a program can write; 0 where it can write none. */
  workOffsets: number;
  /** Whether the job's `tool` section matters: plane and tool decide which length acts along the tool axis. */
  firstLength: boolean;
  /** Whether its program watches positioning moves with the probe. */
  watches: boolean;
  /** Whether its program computes the results itself. */
  computes: boolean;
  /** Whether its own cycles can correct a tool offset from a measured size. */
  correctsTools: boolean;
  /** The fields of the job's section `control` that change nothing on it. */
  unused: string[];
  /** What its work offsets are called, from number 1. */
  workOffsetWords: string[];
  /** For each cycle, and each form of the program, whether the control takes it. */
  cycles: SupportEntry[];
}

/** A safety rule, as every program is checked for it. */
export interface RuleEntry {
  /** Its name, by which the plan's `safety` refers to it. */
  name: string;
  /** What it demands of a program, in a sentence. */
  says: string;
  /** What could happen without it. */
  why: string;
}

/** What some codes of a parameter table are about. */
export interface CodeGroup {
  /** What these codes are about, as a heading. */
  title: string;
  /** The lowest code, included. */
  lowest: number;
  /** The highest code, included. */
  highest: number;
}

/** Cycles, controls and the sections around them. */
export interface Catalog {
  /** The version of the job format that this crate reads. */
  format: 1;
  /** Every cycle, with its fields and steps. */
  cycles: CycleEntry[];
  /** The sections of a job around the cycle. */
  sections: SectionEntry[];
  /** Every kind of relation between results of a set-up. */
  relations: RelationEntry[];
  /** Every control, with what its programs can do. */
  posts: PostEntry[];
  /** What programs are checked for. */
  rules: RuleEntry[];
  /** Codes of findings that hold for a control and form whatever the job: a page may say them once, at the control's name. */
  standing: string[];
  /** What the codes of a CmdPrm table are about; the first that fits counts. */
  codeGroups: CodeGroup[];
  /** The rate that rapids are taken to have in `plan().time`, mm/min, where the program states none for them. */
  rapidRate: number;
  /** The most touches that a parameter table of CmdPrm codes holds. The entry of a cycle has its own number. */
  maxTouches: number;
  /** The longest text that a job is made of, in characters as JavaScript counts them (UTF-16 units). */
  longestText: number;
  /** The longest program whose moves are read, likewise. */
  longestProgram: number;
}
