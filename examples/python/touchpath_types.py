"""What Touchpath answers, as types: of Plan, Finding, Measurement and the rest of touchpath/answers.schema.json.

Made from that schema by scripts/python-types.mjs. A later version adds keys: pass over what is not known.
"""

from __future__ import annotations

from typing import Any, Literal, NotRequired, TypeAlias, TypedDict

# A job, as touchpath/schema.json has it.
Job: TypeAlias = dict[str, Any]


# An arc about the tool axis.
class Arc(TypedDict):
    # Its centre, at the height of the move.
    center: Vec3
    # Degrees, counter-clockwise positive seen against the tool axis; less than a whole turn.
    sweep: float


# Cycles, controls and the sections around them.
class Catalog(TypedDict):
    # The version of the job format that this crate reads.
    format: Literal[1]
    # Every cycle, with its fields and steps.
    cycles: list[CycleEntry]
    # The sections of a job around the cycle.
    sections: list[SectionEntry]
    # Every kind of relation between results of a set-up.
    relations: list[RelationEntry]
    # Every control, with what its programs can do.
    posts: list[PostEntry]
    # What programs are checked for.
    rules: list[RuleEntry]
    # Codes of findings that hold for a control and form whatever the job: a page may say them once, at the control's name.
    standing: list[str]
    # What the codes of a CmdPrm table are about; the first that fits counts.
    codeGroups: list[CodeGroup]
    # The rate that rapids are taken to have in `plan().time`, mm/min, where the program states none for them.
    rapidRate: float
    # The most touches that a parameter table of CmdPrm codes holds. The entry of a cycle has its own number.
    maxTouches: float
    # The longest text that a job is made of, in characters as JavaScript counts them (UTF-16 units).
    longestText: float
    # The longest program whose moves are read, likewise.
    longestProgram: float


# A line of `touchpath check --json`.
class CheckLine(TypedDict):
    source: str
    findings: list[Finding]


# One allowed value of a choice or a code.
class ChoiceEntry(TypedDict):
    # The word, or the number, in the job.
    value: str | float
    # The same for people, in English.
    label: str


# What some codes of a parameter table are about.
class CodeGroup(TypedDict):
    # What these codes are about, as a heading.
    title: str
    # The lowest code, included.
    lowest: float
    # The highest code, included.
    highest: float


# A cycle, its form, and where it is documented.
class CycleEntry(TypedDict):
    # The value of `cycle.type` in a job.
    type: Literal["internal-rectangle-protected", "double-wall-internal-corner", "probing-two-circles", "surface", "wall-angle", "hole", "hole-protected", "boss", "internal-rectangle", "external-rectangle", "web", "web-three-points", "groove", "groove-protected", "double-wall-external-corner", "triple-wall-internal-corner", "triple-wall-external-corner", "probe-on-off", "nc-action"]
    # The name that its source gives it.
    title: str
    # What it measures, in a sentence, in English.
    says: str
    # What else people look for it by, in English: words for a search.
    also: str
    # Who documents it, and as what: `ENCY/SprutCAM type 5`.
    source: str
    # Its type number in the source's parameter table, where it has one.
    number: float | None
    # Whether its touches may be picked one by one (`cycle.touches`).
    touches: bool
    # The most touches it can have.
    maxTouches: float
    # Whether it has feeds and a search length of its own.
    ownFeeds: bool
    # Page of the manual: a path in this repository.
    doc: str
    # The fields of its form, in order.
    fields: list[FieldEntry]
    # Forms inside its form.
    sections: list[CycleSectionEntry]
    # Its documented steps, in our words; index 0 is step 1.
    steps: list[str]


# A form inside a cycle's form.
class CycleSectionEntry(TypedDict):
    # Key of the object in `cycle`.
    key: str
    # Whether it may be `null`, which is then its default.
    optional: bool
    # The fields of that object, in order.
    fields: list[FieldEntry]


# What can be written into an axis of a work offset, or into its rotation.
DatumRow = TypedDict(
    "DatumRow",
    {
        "axis": "Literal[\"x\", \"y\", \"z\", \"rotation\"]",
        "from": "str | None",
        "choices": "list[str]",
    },
)


# One field. Lengths are in mm, feeds in mm/min, angles in degrees, whatever the job's units.
class FieldEntry(TypedDict):
    # Key in its section.
    key: str
    # Short name for people, in English.
    label: str
    # What the field is for, in English.
    help: str
    # `number`, `count`, `flag`, `choice`, `code`, `text`, `point`, `nominal` or `nominalPoint`.
    kind: Literal["number", "count", "flag", "choice", "code", "text", "point", "nominal", "nominalPoint"]
    # `length`, `feed`, `acceleration`, `time`, `angle` or `none`.
    unit: Literal["length", "feed", "acceleration", "time", "angle", "none"]
    # Smallest and largest allowed number; null for a flag, text or a fixed set of values.
    range: list[float] | None
    # Whether the smallest number itself is excluded.
    above: bool
    # Smallest and largest usual number: the check warns outside of them. Null where every allowed number is usual.
    usual: list[float] | None
    # The value in a job that leaves the field out.
    default: DefaultEntry
    # What a new job in inch begins with, in inch: a number that people type, near to `default`. A job in inch that leaves the field out has `default`.
    defaultInch: DefaultEntry
    # What `null` means; null where it is not allowed.
    null: str | None
    # The allowed values of a choice or a code; else empty.
    choices: list[ChoiceEntry]
    # Its code in the source's parameter table: `CmdPrm.Flt[-50]`. Null where it has none.
    code: str | None
    # The heading under which a form shows it.
    group: str
    # Whether `part.sizes` may change it.
    size: bool
    # What another field of its form must be for this one to count; null where it always counts.
    when: WhenEntry | None


# A line of `touchpath plan -o FOLDER --json`: the file of a job.
class FileLine(TypedDict):
    source: str
    file: str | None
    hash: str | None
    control: str | None
    findings: list[Finding]


# A problem, or something worth knowing.
class Finding(TypedDict):
    # Whether it keeps the job from being planned.
    level: Level
    # A stable, kebab-case name for programs to switch on, one of those in docs/findings.md.
    code: FindingCode
    # The place in the job: `cycle.sideClearance1`, `feeds.work`; empty for the job as a whole.
    path: str
    # Plain words for a person, with numbers in the job's units.
    message: str
    # The message as a template and its values: with a list of words it can be said in another language.
    said: Said


class Lentoax(TypedDict):
    # 0: `axind` says it all; 1: `matrix` must be read; -1: coordinate system not known; -2: no tool active.
    status: float
    # For abscissa, ordinate, applicate: the number of the length that acts there, negative if it points the other way.
    axind: Vec3
    # Rows abscissa, ordinate, applicate; columns L1, L2, L3.
    matrix: list[Vec3]


# What follows from measured values. Lengths in the job's units, angles in degrees.
class Measurement(TypedDict):
    # As a plan has them, from what was measured: `truth` is null.
    results: list[ResultRow]
    # The ball centre at each touch, in the work coordinate system; null where it made no contact. Empty where the text gives results and no touches.
    points: list[Vec3 | None]
    # On grbl, which cannot write a work offset from a program: the block that the operator types before the next move. Null if nothing has to be typed; a finding gives the reason.
    block: str | None
    # How the values were read, and what is missing: warnings and notes.
    findings: list[Finding]


# One move of the ball centre.
class Move(TypedDict):
    # Where it ends; a touch at its nominal contact.
    to: Vec3
    # `approach`, `longLink`, `work`, `retract`, `return` or `rapid`.
    feed: Literal["approach", "longLink", "work", "retract", "return", "rapid"]
    # `position`, `touch` or `back`.
    kind: Literal["position", "touch", "back"]
    # Step of the cycle's documented list, from 1; 0 on the way between two cycles. Where native cycles make it: which line makes it, from that of the first move on.
    step: float
    # Index of the touch that it makes or comes back from; null for positioning.
    touch: float | None
    # The arc it runs along; null is a straight line.
    arc: Arc | None
    # Index of its cycle in a set-up, or of the one that it leads to; 0 for a job of one cycle.
    cycle: float


# One row of the parameter table.
class ParameterRow(TypedDict):
    # `CmdPrm.Flt[-53]`, or `Q1116` for a HEIDENHAIN cycle.
    code: str
    # The type column of the source.
    type: str
    # The value, lengths in the job's units.
    value: ParameterValue
    # What it means, in English; `meanings(job)` has it for other languages.
    meaning: str
    # Path of the job's field it comes from.
    field: str | None
    # Index of the touch it comes from; null if it concerns the whole cycle.
    touch: float | None
    # Index of its cycle in a set-up; 0 for a job of one cycle.
    cycle: float


# Everything that follows from a job. Lengths in the job's units, angles in degrees.
class Plan(TypedDict):
    # The nominal touches, on the surface.
    touches: list[TouchPoint]
    # The moves, of the ball centre.
    moves: list[Move]
    # The names of the cycles of a set-up, in their order; empty for a job of one cycle.
    cycles: list[str]
    # The names of the relations of a set-up, in their order.
    relations: list[str]
    # Of a set-up, what can be written into each axis of a work offset and into its rotation, and what is; empty for a job of one cycle.
    datum: list[DatumRow]
    # Length of the whole path: from where the job says the ball is, else from where the first move ends.
    length: float
    # Minutes for the same. Rapids run at 5000 mm/min, or at the feed that the control's program states for them.
    time: float
    # The program, for the control of the job.
    program: ProgramText
    # The cycle's parameters as its source numbers them.
    table: list[ParameterRow]
    # Results the control will store, for the virtual part.
    results: list[ResultRow]
    # Ball centre at the trigger of each touch on the virtual part; null where it is not met in time.
    triggers: list[Vec3 | None]
    # Warnings and notes; with an error there is no plan.
    findings: list[Finding]
    # For each safety rule, whether the program keeps it.
    safety: list[SafetyRow]


# A line of `touchpath plan --ndjson`: what became of a job.
class PlanLine(TypedDict):
    source: str
    program: str | None
    findings: list[Finding]


# A control that programs are written for.
class PostEntry(TypedDict):
    # The value of `control.post` in a job.
    id: PostId
    # The control's name, for people.
    title: str
    # The usual file extension, without the dot.
    extension: str
    # Highest number of a work offset that a program can write; 0 where it can write none.
    workOffsets: float
    # Whether the job's `tool` section matters: plane and tool decide which length acts along the tool axis.
    firstLength: bool
    # Whether its program watches positioning moves with the probe.
    watches: bool
    # Whether its program computes the results itself.
    computes: bool
    # Whether its own cycles can correct a tool offset from a measured size.
    correctsTools: bool
    # The fields of the job's section `control` that change nothing on it.
    unused: list[str]
    # What its work offsets are called, from number 1.
    workOffsetWords: list[str]
    # For each cycle, and each form of the program, whether the control takes it.
    cycles: list[SupportEntry]


# The program as text.
class ProgramText(TypedDict):
    # Which control it is for.
    post: str
    # The usual file extension, without the dot.
    extension: str
    # Its lines, each ended by a line feed.
    text: str
    # For each move the 0-based line that makes it; −1 where the native cycle makes it.
    moveLines: list[float]
    # What it writes, in its own blocks or by the cycle that it calls. Of the work offset: axes in the order `X`, `Y`, `Z`, then `rotation`. Of the active preset: `preset X` …, then `basic rotation` or `table offset`. Empty where it measures only.
    writes: list[Literal["X", "Y", "Z", "rotation", "preset X", "preset Y", "preset Z", "basic rotation", "table offset"]]
    # What it does with offsets and presets, in one sentence: `writes G54 X Y`, `measures only`.
    does: str
    # The same as a template and its values.
    said: Said
    # What was proven of it; null in the form `cycle`.
    proof: ProofRow | None
    # Whether the moves of the plan are those that native cycles make, which the program calls.
    own: bool


# The outcome of one job among many.
class Programmed(TypedDict):
    # Its program; `null` where it has none.
    program: ProgramText | None
    # All findings; where there is no program, errors among them.
    findings: list[Finding]


# What was proven of a program of moves: read back, it is the path.
class ProofRow(TypedDict):
    # How many moves of the path it makes, each where and how it should.
    moves: float
    # How many of them are touches.
    touches: float
    # Whether the program computes the results itself, and the right ones.
    arithmetic: bool


# A kind of relation.
class RelationEntry(TypedDict):
    # The value of `relations[].type` in a job.
    type: Literal["line", "center", "pitch-circle", "difference", "mean"]
    # Its name for people, in English.
    label: str
    # What its results are, in English.
    says: str
    # Whether its operands are positions, named by their cycles and relations; else single results.
    places: bool
    # The fewest operands.
    least: float
    # The most operands; null if it takes any number.
    most: float | None
    # The codes of its results; of angles `.angle` is added to the first.
    results: list[ResultCode]


class Report(TypedDict):
    name: str
    by: str
    machine: str
    when: str
    note: str
    # The control that the program is for.
    control: str
    # The hash over the blocks of the program, as its header says it; empty where it says none.
    program: str
    parts: float
    # `good`, `good within ±`, `out within ±`, `not measured`, `out` and the like: the worst of all; `null` where nothing has a tolerance.
    verdict: str | None
    rows: list[ReportRow]


# A result in a report.
class ReportRow(TypedDict):
    # Its code, in a set-up behind the name of its cycle or relation: `BORE.diameter`.
    code: str
    meaning: str
    # `mm`, `inch` or `deg`.
    unit: str
    nominal: float | None
    limits: list[float] | None
    # One a part; `null` where it was not measured.
    values: list[float | None]
    # Of the last part: value less nominal.
    deviation: float | None
    # Twice the standard uncertainty: 95 of 100 measurements lie within.
    expanded: float | None
    # One a part; `null` where no tolerance is given.
    verdicts: list[str | None]
    # `null` of a single part.
    series: Series | None


# A value that the cycle measures: what the control computes, and what it should be.
class ResultRow(TypedDict):
    # A stable name, one of `RESULT_CODES`: `center.x`.
    code: ResultCode
    # What the value is, in English.
    meaning: str
    # `mm`, `inch` or `deg`; empty for a number without a unit.
    unit: Literal["mm", "inch", "deg", ""]
    # Its value on the nominal part; null where that is not known.
    nominal: float | None
    # What the control computes; null where the triggers cannot give it.
    value: float | None
    # Value less nominal, or less the middle of the tolerance zone.
    deviation: float | None
    # One sigma of the value: scatter of the touches, and eccentricity of the ball.
    uncertainty: float | None
    # How much of it comes from the ball's eccentricity: one sigma of that alone. Null where the job says none, or turns the spindle to the angle of calibration.
    uncertaintyRunout: float | None
    # Lower and upper limit, where a tolerance is given.
    limits: list[float] | None
    # Good, rework or scrap, where a tolerance is given; implausible, where it is off by more than its limit.
    verdict: Verdict | None
    # The true value on the virtual part, where there is one.
    truth: float | None
    # Why the value is not the truth, where it is not.
    note: str | None
    # Where the control has it after its own cycles: `#135`. Null of a program of moves, whose header says it.
    stored: str | None
    # Index of its cycle in a set-up, or behind all cycles that of its relation; 0 for a job of one cycle.
    cycle: float
    # Its words as templates and their values.
    said: ResultWords


# The words of a result, to be put into other languages.
class ResultWords(TypedDict):
    # What the value is.
    meaning: Said
    # Good, rework or scrap, where a tolerance is given.
    verdict: Said | None
    # Why the value is not the truth, where it is not.
    note: Said | None


# A safety rule, as every program is checked for it.
class RuleEntry(TypedDict):
    # Its name, by which the plan's `safety` refers to it.
    name: str
    # What it demands of a program, in a sentence.
    says: str
    # What could happen without it.
    why: str


# Whether the program keeps a safety rule.
class SafetyRow(TypedDict):
    # The name of the rule.
    rule: RuleName
    # Null where this control cannot hold it, or its own cycle answers for it.
    holds: bool | None
    # What the rule asks, what is wrong, or why the control cannot.
    message: str
    # The same as a template and its values.
    said: Said
    # The 0-based lines that break it.
    lines: list[float]
    # The 0-based lines that it was asked of, whether they keep or break it; those of the native cycle where that answers for it.
    about: list[float]


# One section of a job.
class SectionEntry(TypedDict):
    # Its key in the job, empty for the job itself.
    path: str
    # Whether it may be `null`, which is then its default.
    optional: bool
    # The fields of the section, in order.
    fields: list[FieldEntry]


# What several parts say of one result. Lengths in the job's units, angles in degrees.
class Series(TypedDict):
    # How many parts have a value.
    count: float
    mean: float
    min: float
    max: float
    # Standard deviation of the parts, divided by count − 1; `null` of a single one.
    spread: float | None
    # Slope of the straight line of least squares through the values, a part; `null` of fewer than three.
    trend: float | None
    # (upper − lower limit) / 6 spreads; `null` without both limits or without spread.
    cp: float | None
    # Distance of the mean from the nearer limit / 3 spreads; likewise.
    cpk: float | None


# Whether a control takes a cycle in a form.
class SupportEntry(TypedDict):
    # The value of `cycle.type`.
    type: Literal["internal-rectangle-protected", "double-wall-internal-corner", "probing-two-circles", "surface", "wall-angle", "hole", "hole-protected", "boss", "internal-rectangle", "external-rectangle", "web", "web-three-points", "groove", "groove-protected", "double-wall-external-corner", "triple-wall-internal-corner", "triple-wall-external-corner", "probe-on-off", "nc-action"]
    # `moves`: plain moves and touches. `cycle`: the native cycle.
    form: Literal["moves", "cycle"]
    # Whether the control takes the cycle in this form.
    supported: bool
    # Why not; null where it does.
    reason: str | None
    # Whether this native cycle corrects the active preset, so that no work offset is chosen.
    ownPreset: bool


# Where the ball is to touch the nominal part.
class TouchPoint(TypedDict):
    # The point that is touched, on the surface.
    point: Vec3
    # Target vector: outward normal of the surface, of length one.
    vector: Vec3
    # Which wall or circle it is on, from 0.
    group: float
    # Index of its cycle in a set-up; 0 for a job of one cycle.
    cycle: float


# One move of a program.
class TraceMove(TypedDict):
    # Where it ends; null along an axis that no block has named yet.
    to: list[float | None]
    # `rapid`, `feed`, `watched`, `touch` or `unchecked`.
    kind: TraceKind
    # Null is a rapid, or a feed that no block has stated.
    feed: float | None
    # The 0-based line that makes it.
    line: float


# The moves of a program that says no job.
class TraceRow(TypedDict):
    # The control whose language it was read in.
    control: str
    # `mm`, `inch`, or null where it does not say.
    units: Literal["mm", "inch", null]
    # Its moves, in its units.
    moves: list[TraceMove]


# What a field must be for another one to count.
class WhenEntry(TypedDict):
    # Key of that other field, in the same form.
    key: str
    # The code that it must have.
    value: float


# X, Y, Z of the work coordinate system.
Vec3: TypeAlias = list[float]


# A value as a job has it.
DefaultEntry: TypeAlias = float | bool | str | Vec3 | None


# Every code of a finding; docs/findings.md says what each means.
FindingCode: TypeAlias = Literal["align-needs-confirm", "angle-rounded", "approach-beyond-wall", "approach-not-watched", "arc-unsolved", "ball-too-wide", "ball-unknown", "beyond-travel", "block-to-type", "block-too-long", "branch-ends", "circle-in-circle", "clear-too-low", "clearance-height-too-low", "clearance-too-small", "code-twice", "collision", "contact-at-start", "converted", "crossing-too-low", "cycle-chooses-points", "cycle-differs", "cycle-name", "cycle-no-lift", "cycle-no-zone", "cycle-not-parallel", "cycle-not-square", "cycle-one-path", "cycle-path-short", "cycle-plane", "cycle-stops", "datum-apart", "datum-unknown", "dist-needed", "dist-too-short", "division-by-zero", "dry-run-unsupported", "edge-contact", "extrusion-direction", "feeds-of-set-up", "field-unused", "form-unsupported", "given-incomplete", "given-position", "header-unknown", "header-unsound", "implausible", "keep-out", "length-not-along-tool-axis", "length-to-centre", "lift-unused", "limit-stops", "limits-not-asked", "lines-differ", "lines-optional", "lines-skipped", "locked", "low-crossing", "low-rapid", "low-start", "machine-places", "macro-not-seen", "macro-stops", "missing", "missing-code", "missing-parameter", "mixed-forms", "more-findings", "moves-before-cycle", "name-changed", "needs-calibration", "nested-too-deeply", "newer-format", "no-arc", "no-block", "no-circle", "no-contact", "no-direction", "no-extrusion", "no-job-in-program", "no-moves", "no-results-in-program", "no-retract", "no-touches", "no-units", "not-a-flag", "not-a-number", "not-a-tolerance", "not-a-value", "not-allowed", "not-at-feed", "not-called", "not-finite", "not-in-dump", "not-in-program", "not-json", "not-known", "not-on-one-circle", "not-on-one-wall", "not-proven", "not-rectangular", "not-understood", "not-verified", "not-whole", "nothing-switched", "nothing-to-import", "nothing-to-write", "number-protected", "number-unused", "offset-in-parts", "offset-measured-again", "offset-one-direction", "offset-optional", "order-of-cycles", "orient-unsupported", "other-control", "other-form", "other-units", "other-version", "out-of-range", "out-of-tolerance", "overtravel-too-short", "own-codes", "own-moves", "own-path", "pairs-not-square", "part-not-in-program", "passed-over", "passes-close", "path-not-above", "picks-differ", "picks-out-of-range", "place-of-result", "place-too-far", "places-computed", "places-transformed", "plane-from-dump", "plane-unknown", "plane-unsupported", "points-differ", "portal", "positioning-not-watched", "predefined", "probe-move-too-short", "probe-word", "probing-too-fast", "program-differs", "program-stops", "protection-unsupported", "rapid-at-feed", "reaction-unsupported", "relation-not-computed", "relation-of", "repeat-unsupported", "result-missing", "result-twice", "result-untrue", "rotary-unsupported", "rotation-not-written", "rotation-unsupported", "row-activated", "rule-broken", "search-too-short", "semi-automatic", "semi-automatic-unsupported", "set-up-too-long", "set-up-unsupported", "several-cycles", "shank-collision", "short-arc", "small-hole", "start-in-feature", "start-unknown", "starts-disagree", "stops-too-late", "stylus-from-dump", "stylus-not-known", "text-too-long", "tolerance-beyond-limit", "tolerance-elsewhere", "tolerance-unknown", "tolerance-unsupported", "too-far", "too-long", "too-many-digits", "too-many-registers", "too-many-touches", "tool-axis-reversed", "tool-by-name", "tool-corrected", "tool-length-unchecked", "touch-above-top", "touch-aside", "touch-askew", "touch-beyond-corner", "touch-close", "touch-fast", "touch-missed", "touch-missing", "touch-near-edge", "touch-too-short", "touches-coincide", "touches-kept", "touches-not-level", "touches-unsound", "turn-beyond-limit", "uncertain-result", "unclear-line", "units-differ", "units-found", "units-not-stated", "units-unclear", "units-unknown", "unknown-code", "unknown-key", "unknown-parameter", "unknown-result", "unknown-type", "unknown-value", "unreadable", "unsafe-program", "unusable", "unusual", "vector-not-in-plane", "vector-not-unit", "vector-not-upwards", "vector-wrong-way", "vectors-not-opposite", "walls-parallel", "wear-off-middle", "wear-unlimited", "wear-unsupported", "words-twice", "work-offset-needed", "work-offset-unclear", "work-offset-unsupported", "wrong-code", "wrong-count", "wrong-type", "wrong-wall", "zone-beyond-clearance", "zone-beyond-dist"]


# What was made of a text: a job, or the moves of a program that holds no job. `findings` says what was ignored, and what could not be known.
Imported: TypeAlias = dict[str, Any]


# What a tolerance or a limit makes of a value.
Judged: TypeAlias = Literal["good", "rework", "scrap", "undefined", "implausible", "good within ±", "out", "out within ±"]


# How much a finding weighs.
Level: TypeAlias = Literal["error", "warning", "info"]


# The value of a parameter.
ParameterValue: TypeAlias = float | bool | str


# The id of a control.
PostId: TypeAlias = Literal["linuxcnc", "grbl", "grblhal", "fluidnc", "sinumerik", "heidenhain", "fanuc", "haas", "mazak", "brother", "hurco", "okuma"]


# Every code of a result.
ResultCode: TypeAlias = Literal["center.x", "center.y", "diameter", "residual", "width", "width1", "width2", "rotation", "height", "corner.x", "corner.y", "corner.z", "angle", "residual1", "residual2", "point.x", "point.y", "point.z", "deviation", "offset.x", "offset.y", "offset.z", "offset.rotation", "distance", "difference", "difference.angle", "mean", "mean.angle", "spread", "Q183", "Q950", "Q951", "Q952", "Q953", "Q954", "Q955", "Q964", "Q965", "Q966", "Q967", "Q970", "Q971", "Q973", "Q974", "Q980", "Q981", "Q982", "Q983", "Q984", "Q985", "Q994", "Q995", "Q996", "Q997", "form1", "form2", "preset.table", "preset.x", "preset.y", "preset.z", "preset.rotation", "table.turn"]


# Every safety rule.
RuleName: TypeAlias = Literal["modes-stated", "spindle-off", "probe-asked", "probe-free-again", "low-start-goes-up", "positioning-watched", "contact-lifts", "missed-touch-stops", "missed-touch-lifts", "feeds-stated", "no-low-rapid", "offset-after-touches", "one-write", "plausible-before-write", "tolerance-obeyed", "place-within-limit", "restart-writes-nothing", "ends-above"]


# A sentence as its English template, then the values of the names in its braces, in the order in which these first appear: a string that is the same in every language (a number with its unit, a code, what a user typed), or again something said.
Said: TypeAlias = list[str | Any]


# What a motion does.
TraceKind: TypeAlias = Literal["rapid", "feed", "watched", "touch", "unchecked"]


# The verdict of a value, or of the whole workpiece (`Q183`), with what the control does then.
Verdict: TypeAlias = Judged | str
