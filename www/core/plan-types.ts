// Generated from the crate's structs: `UPDATE=1 cargo test --lib generated` writes it.

import type { Cycle, PostId, Relation, Vec3 } from "./job-types.js";
import type { Message } from "./said.js";

/** A whole number. @asType integer */
export type Integer = number;

/** Every code of a finding; docs/findings.md says what each means. */
export type FindingCode =
  | "align-needs-confirm"
  | "angle-rounded"
  | "approach-beyond-wall"
  | "approach-not-watched"
  | "arc-unsolved"
  | "ask-unsupported"
  | "ask-unused"
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
  | "edition-not-stated"
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
  | "line-characters"
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
  | "measured-twice"
  | "missing"
  | "missing-code"
  | "missing-parameter"
  | "mixed-forms"
  | "modes-set"
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
  | "no-place"
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
  | "not-inserted"
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
  | "row-active"
  | "rule-broken"
  | "search-too-short"
  | "semi-automatic"
  | "semi-automatic-unsupported"
  | "set-up-too-long"
  | "set-up-unsupported"
  | "several-cycles"
  | "shank-collision"
  | "shop-line"
  | "shop-lines-unknown"
  | "shop-lines-unused"
  | "short-arc"
  | "signs-contradict"
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
  | "tool-unused"
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
  | "variables-shared"
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
  | "asked-before-write"
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

/** Verdict of a tolerance or limit on a value. */
export type Judged =
  | "good"
  | "rework"
  | "scrap"
  | "undefined"
  | "implausible"
  | "good within ±"
  | "out"
  | "out within ±";

/** The verdict of a value, or of the whole workpiece (`Q183`), with the reaction of the control. */
export type Verdict = Judged | `${Judged}: ${string}`;

/** Weight of a finding. */
export type Level = "error" | "warning" | "info";

/** An error, warning or note. */
export interface Finding {
  /** Weight; an error prevents the plan. */
  level: Level;
  /** A stable, kebab-case name for programs to switch on, one of those in docs/findings.md. */
  code: FindingCode;
  /** Position in the job: `cycle.sideClearance1`, `feeds.work`; empty for the whole job. */
  path: string;
  /** Message in plain words, with numbers in the units of the job. */
  message: string;
  /** The message as a template and its values: with a list of words it can be translated. */
  said: Message;
}

/** A touch of the nominal part. */
export interface TouchPoint {
  /** Touched point, on the surface. */
  point: Vec3;
  /** Target vector: unit outward normal of the surface. */
  vector: Vec3;
  /** Index of the touched surface, from 0. */
  group: Integer;
  /** Index of its cycle in a set-up; 0 for a job of one cycle. */
  cycle: Integer;
}

/** An arc about the tool axis. */
export interface Arc {
  /** Centre, at the height of the move. */
  center: Vec3;
  /** Sweep in degrees, counter-clockwise positive seen against the tool axis; less than a whole turn. */
  sweep: number;
}

/** One move of the ball centre. */
export interface Move {
  /** End of the move; of a touch its nominal contact. */
  to: Vec3;
  /** `approach`, `longLink`, `work`, `retract`, `return` or `rapid`. */
  feed: "approach" | "longLink" | "work" | "retract" | "return" | "rapid";
  /** `position`, `touch` or `back`. */
  kind: "position" | "touch" | "back";
  /** Step in the cycle's documented list, from 1; 0 for a link move between two cycles. With native cycles: the line that makes it, counted from that of the first move. */
  step: Integer;
  /** Index of its touch, for touches and retracts; null for positioning. */
  touch: Integer | null;
  /** The arc of the move; null is a straight line. */
  arc: Arc | null;
  /** Index of its cycle in a set-up, or of the cycle that a link move leads to; 0 for a job with one cycle. */
  cycle: Integer;
}

/** The value of a parameter. */
export type ParameterValue = Integer | boolean | number | string;

/** One row of the parameter table. */
export interface ParameterRow {
  /** `CmdPrm.Flt[-53]`, or `Q1116` for a HEIDENHAIN cycle. */
  code: string;
  /** Entry in the type column of the source. */
  type: string;
  /** Value; lengths in the job's units. */
  value: ParameterValue;
  /** Meaning in English; `meanings(job)` has it for other languages. */
  meaning: string;
  /** Path of the job field that gives the value. */
  field: string | null;
  /** Index of the touch that gives the value; null if it concerns the whole cycle. */
  touch: Integer | null;
  /** Index of its cycle in a set-up; 0 for a job with one cycle. */
  cycle: Integer;
}

/** A measured value: computed by the control, with its nominal value. */
export interface ResultRow {
  /** A stable name, one of `RESULT_CODES`: `center.x`. */
  code: ResultCode;
  /** Description of the value in English. */
  meaning: string;
  /** `mm`, `inch` or `deg`; empty for a number without a unit. */
  unit: "mm" | "inch" | "deg" | "";
  /** Value on the nominal part; null if it is unknown. */
  nominal: number | null;
  /** Value that the control computes; null if the triggers cannot give it. */
  value: number | null;
  /** Value minus nominal, or minus the middle of the tolerance. */
  deviation: number | null;
  /** Standard uncertainty of the value (one sigma): scatter of the touches, and eccentricity of the ball. */
  uncertainty: number | null;
  /** Part of the uncertainty that comes from the eccentricity of the ball (one sigma). Null if the job gives no eccentricity, or orients the spindle to the angle of calibration. */
  uncertaintyRunout: number | null;
  /** Lower and upper limit, if there is a tolerance. */
  limits: [number, number] | null;
  /** Good, rework or scrap, if there is a tolerance; implausible beyond the limit. */
  verdict: Verdict | null;
  /** True value on the virtual part, if there is one. */
  truth: number | null;
  /** Reason why the value differs from the true value, if it does. */
  note: string | null;
  /** Storage in the control after its native cycles: `#135`. Null for a program of moves, whose header lists it. */
  stored: string | null;
  /** Index of its cycle in a set-up, or, after all cycles, of its relation; 0 for a job with one cycle. */
  cycle: Integer;
  /** Its texts as templates and their values. */
  said: ResultWords;
}

/** Texts of a result, for translation. */
export interface ResultWords {
  /** Description of the value. */
  meaning: Message;
  /** Good, rework or scrap, if there is a tolerance. */
  verdict: Message | null;
  /** Reason why the value differs from the true value, if it does. */
  note: Message | null;
}

/** Proof of a program of moves: read back, it is the path. */
export interface ProofRow {
  /** Number of moves of the path that the program makes, each with the right position, kind and feed. */
  moves: Integer;
  /** Number of touches among them. */
  touches: Integer;
  /** Whether the program computes the results, and they are right. */
  arithmetic: boolean;
}

/** Verdict of a safety rule. */
export interface SafetyRow {
  /** The name of the rule. */
  rule: RuleName;
  /** Null if this control cannot guarantee it, or its native cycle is responsible for it. */
  holds: boolean | null;
  /** The requirement, the fault, or the reason why the control cannot guarantee it. */
  message: string;
  /** `message` as a template and its values. */
  said: Message;
  /** The 0-based lines that break it. */
  lines: Integer[];
  /** The 0-based lines that the rule concerns, whether they keep or break it; those of the native cycle if that is responsible for it. */
  about: Integer[];
}

/** The program as text. */
export interface ProgramText {
  /** Id of the control. */
  post: string;
  /** The usual file extension, without the dot. */
  extension: string;
  /** Lines, each ended by a line feed. */
  text: string;
  /** The 0-based line of each move; −1 if the native cycle makes it. */
  moveLines: Integer[];
  /** Values that the program writes, in its own blocks or by the called cycle. For the work offset: axes in the order `X`, `Y`, `Z`, then `rotation`. For the active preset: `preset X` …, then `basic rotation` or `table offset`. Empty if it only measures. */
  writes: ("X" | "Y" | "Z" | "rotation" | "preset X" | "preset Y" | "preset Z" | "basic rotation" | "table offset")[];
  /** Summary of its writes to offsets and presets, in one sentence: `writes G54 X Y`, `measures only`. */
  does: string;
  /** `does` as a template and its values. */
  said: Message;
  /** Proof of the program; null in the form `cycle`. */
  proof: ProofRow | null;
  /** Whether the moves of the plan are those of native cycles that the program calls. */
  own: boolean;
}

/** Sources of an axis of a work offset, or of its rotation. */
export interface DatumRow {
  /** `x`, `y`, `z` or `rotation`: abscissa, ordinate, tool axis. */
  axis: "x" | "y" | "z" | "rotation";
  /** Result for the work offset, for example `BORE.center.x`, also if no offset is chosen yet. Null if no result can be written. */
  from: string | null;
  /** Every possible result. */
  choices: string[];
}

/** The plan of a job. Lengths in the job's units, angles in degrees. */
export interface Plan {
  /** Nominal touches, on the surface. */
  touches: TouchPoint[];
  /** Moves of the ball centre. */
  moves: Move[];
  /** Names of the cycles of a set-up, in order; empty for a job with one cycle. */
  cycles: string[];
  /** Names of the relations of a set-up, in order. */
  relations: string[];
  /** For a set-up, the possible sources of each axis of a work offset and its rotation, and the used ones; empty for a job with one cycle. */
  datum: DatumRow[];
  /** Length of the whole path: from the start in the job, else from the end of the first move. */
  length: number;
  /** Time of the path, minutes. Rapids run at 5000 mm/min, or at the feed that the control's program states for them. */
  time: number;
  /** The program for the control of the job. */
  program: ProgramText;
  /** Parameters of the cycle with the numbers of its source. */
  table: ParameterRow[];
  /** Results that the control will store on the virtual part. */
  results: ResultRow[];
  /** Ball centre at the trigger of each touch on the virtual part; null without a contact within the search. */
  triggers: (Vec3 | null)[];
  /** Warnings and notes; with an error there is no plan. */
  findings: Finding[];
  /** Whether the program keeps each safety rule. */
  safety: SafetyRow[];
}

/** Results from measured values. Lengths in the job's units, angles in degrees. */
export interface Measurement {
  /** Results as in a plan, from measured values: `truth` is null. */
  results: ResultRow[];
  /** Ball centre at each touch, in the work coordinate system; null without a contact. Empty if the text gives results instead of touches. */
  points: (Vec3 | null)[];
  /** On grbl, which cannot write a work offset from a program: the block that the operator types before the next move. Null if nothing has to be typed; a finding gives the reason. */
  block: string | null;
  /** Warnings and notes about the reading of the values, and about missing ones. */
  findings: Finding[];
}

/** Kind of a motion. */
export type TraceKind = "rapid" | "feed" | "watched" | "touch" | "unchecked";

/** One move of a program. */
export interface TraceMove {
  /** End; null along an axis that no block has named yet. */
  to: [number | null, number | null, number | null];
  /** `rapid`, `feed`, `watched`, `touch` or `unchecked`. */
  kind: TraceKind;
  /** Feed; null for a rapid, or if no block has stated one. */
  feed: number | null;
  /** The 0-based line of the move. */
  line: Integer;
}

/** The moves of a program without a job. */
export interface TraceRow {
  /** Control whose language it was read in. */
  control: string;
  /** `mm`, `inch`, or null if the program does not say. */
  units: "mm" | "inch" | null;
  /** Its moves, in its units. */
  moves: TraceMove[];
}

/** A value in a job. */
export type DefaultEntry = number | boolean | string | Vec3 | null;

/** One allowed value of a choice or a code. */
export interface ChoiceEntry {
  /** Word or number in the job. */
  value: string | number;
  /** Label in English. */
  label: string;
}

/** Condition on a field under which another one counts. */
export interface WhenEntry {
  /** Key of the other field, in the same form. */
  key: string;
  /** The code that it must have. */
  value: Integer;
}

/** One field. Lengths are in mm, feeds in mm/min, angles in degrees, whatever the units of the job. */
export interface FieldEntry {
  /** Key in its section. */
  key: string;
  /** Label in English. */
  label: string;
  /** Help text in English. */
  help: string;
  /** `number`, `count`, `flag`, `choice`, `code`, `text`, `point`, `nominal` or `nominalPoint`. */
  kind: "number" | "count" | "flag" | "choice" | "code" | "text" | "point" | "nominal" | "nominalPoint" | "lines";
  /** `length`, `feed`, `acceleration`, `time`, `angle` or `none`. */
  unit: "length" | "feed" | "acceleration" | "time" | "angle" | "none";
  /** Smallest and largest allowed number; null for a flag, text or a fixed set of values. */
  range: [number, number] | null;
  /** Whether the smallest number itself is excluded. */
  above: boolean;
  /** Smallest and largest usual number: the check warns outside of them. Null if every allowed number is usual. */
  usual: [number, number] | null;
  /** Value in a job that leaves the field out. */
  default: DefaultEntry;
  /** Start value for a new job in inch, in inch: a round number near `default`. A job in inch that leaves the field out has `default`. */
  defaultInch: DefaultEntry;
  /** Meaning of `null`; null if it is not allowed. */
  null: string | null;
  /** The allowed values of a choice or a code; else empty. */
  choices: ChoiceEntry[];
  /** Code in the source's parameter table: `CmdPrm.Flt[-50]`. Null if it has no code. */
  code: string | null;
  /** Heading above the field in a form. */
  group: string;
  /** Whether `part.sizes` may change it. */
  size: boolean;
  /** Condition on another field of the form under which this one counts; null if it always counts. */
  when: WhenEntry | null;
}

/** A form inside a cycle's form. */
export interface CycleSectionEntry {
  /** Key of the object in `cycle`. */
  key: string;
  /** Whether it may be `null`; this is then its default. */
  optional: boolean;
  /** The fields of that object, in order. */
  fields: FieldEntry[];
}

/** A cycle with its form and its source. */
export interface CycleEntry {
  /** The value of `cycle.type` in a job. */
  type: Cycle["type"];
  /** Name given by its source. */
  title: string;
  /** What it measures: one sentence in English. */
  says: string;
  /** Further English search words. */
  also: string;
  /** Source and number: `ENCY/SprutCAM type 5`. */
  source: string;
  /** Type number in the source's parameter table, if it has one. */
  number: Integer | null;
  /** Whether its touches may be picked one by one (`cycle.touches`). */
  touches: boolean;
  /** Largest number of touches. */
  maxTouches: Integer;
  /** Whether it has its own feeds and search length. */
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
  /** Key in the job; empty for the job itself. */
  path: string;
  /** Whether it may be `null`; this is then its default. */
  optional: boolean;
  /** The fields of the section, in order. */
  fields: FieldEntry[];
}

/** A kind of relation. */
export interface RelationEntry {
  /** The value of `relations[].type` in a job. */
  type: Relation["type"];
  /** Label in English. */
  label: string;
  /** Its results: one sentence in English. */
  says: string;
  /** Whether its operands are positions, named by their cycles and relations; else single results. */
  places: boolean;
  /** Smallest number of operands. */
  least: Integer;
  /** Largest number of operands; null is any number. */
  most: Integer | null;
  /** Codes of its results; `.angle` is added to the first if the operands are angles. */
  results: ResultCode[];
}

/** Whether a control supports a cycle in a form. */
export interface SupportEntry {
  /** The value of `cycle.type`. */
  type: Cycle["type"];
  /** `moves`: plain moves and touches. `cycle`: the native cycle. */
  form: "moves" | "cycle";
  /** Whether the control supports the cycle in this form. */
  supported: boolean;
  /** Reason why not; null if it does. */
  reason: string | null;
  /** Whether this native cycle corrects the active preset, so that no work offset is chosen. */
  ownPreset: boolean;
}

/** Usual lines of a shop at one place of the program. */
export interface UsualLines {
  /** `head`, `probeOn`, … */
  place: string;
  /** The lines, with placeholders such as `{tool}`. */
  lines: string[];
}

/** A control that programs are written for. */
export interface PostEntry {
  /** The value of `control.post` in a job. */
  id: PostId;
  /** Name of the control. */
  title: string;
  /** The usual file extension, without the dot. */
  extension: string;
  /** Highest number of a work offset that a program can write; 0 if it can write no offset. */
  workOffsets: Integer;
  /** Whether the job's `tool` section matters: plane and tool decide which length acts along the tool axis. */
  firstLength: boolean;
  /** Whether its program watches positioning moves with the probe. */
  watches: boolean;
  /** Whether its program computes the results. */
  computes: boolean;
  /** Whether its program computes between the native cycles of a set-up: relations, and cycles that follow results. */
  computesBetween: boolean;
  /** Whether its native cycles can correct a tool offset from a measured size. */
  correctsTools: boolean;
  /** Whether those correct it by a share of the error, beyond a dead band, or by the mean of several parts. */
  correctsByShare: boolean;
  /** Whether its programs of moves can correct a tool from the mean error of several parts. */
  correctsByMoves: boolean;
  /** Fields of the job's sections `control` and `machine` that change nothing on it. */
  unused: string[];
  /** Usual lines of a shop for `machine.frame`, by place. */
  usualLines: UsualLines[];
  /** Names of its work offsets, from number 1. */
  workOffsetWords: string[];
  /** Whether the control supports each cycle, in each form of the program. */
  cycles: SupportEntry[];
}

/** A safety rule that every program is checked for. */
export interface RuleEntry {
  /** Name of the rule, as in the plan's `safety`. */
  name: string;
  /** Requirement for a program: one sentence. */
  says: string;
  /** Possible consequence of breaking it. */
  why: string;
}

/** A group of codes in a parameter table. */
export interface CodeGroup {
  /** Heading of the group. */
  title: string;
  /** The lowest code, included. */
  lowest: Integer;
  /** The highest code, included. */
  highest: Integer;
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
  /** Safety rules that programs are checked for. */
  rules: RuleEntry[];
  /** Codes of findings that hold for a control and form whatever the job. A page may show them once, at the control's name. */
  standing: string[];
  /** Groups of codes in a CmdPrm table; the first matching group counts. */
  codeGroups: CodeGroup[];
  /** Assumed rate of rapids in `plan().time`, mm/min, if the program states no rate. */
  rapidRate: number;
  /** Largest number of touches that a parameter table of CmdPrm codes holds. Each cycle has its own number in its entry. */
  maxTouches: Integer;
  /** Length of the longest text that can become a job, in UTF-16 units (characters as JavaScript counts them). */
  longestText: Integer;
  /** Length of the longest program whose moves are read, in the same units. */
  longestProgram: Integer;
}
