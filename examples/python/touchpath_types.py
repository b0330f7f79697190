"""What Touchpath answers, as types: of Plan, Finding, Measurement and the rest of touchpath/answers.schema.json.

Made from that schema by scripts/python-types.mjs. A later version adds keys: pass over what is not known.
"""

from __future__ import annotations

from typing import Any, Literal, NotRequired, TypeAlias, TypedDict

# A job, as touchpath/schema.json has it.
Job: TypeAlias = dict[str, Any]


# An arc about the tool axis.
class Arc(TypedDict):
    # Centre, at the height of the move.
    center: Vec3
    # Sweep in degrees, counter-clockwise positive seen against the tool axis; less than a whole turn.
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
    # Safety rules that programs are checked for.
    rules: list[RuleEntry]
    # Codes of findings that hold for a control and form whatever the job. A page may show them once, at the control's name.
    standing: list[str]
    # Groups of codes in a CmdPrm table; the first matching group counts.
    codeGroups: list[CodeGroup]
    # Assumed rate of rapids in `plan().time`, mm/min, if the program states no rate.
    rapidRate: float
    # Largest number of touches that a parameter table of CmdPrm codes holds. Each cycle has its own number in its entry.
    maxTouches: Integer
    # Length of the longest text that can become a job, in UTF-16 units (characters as JavaScript counts them).
    longestText: Integer
    # Length of the longest program whose moves are read, in the same units.
    longestProgram: Integer


# A line of `touchpath check --json`.
class CheckLine(TypedDict):
    source: str
    findings: list[Finding]


# One allowed value of a choice or a code.
class ChoiceEntry(TypedDict):
    # Word or number in the job.
    value: str | float
    # Label in English.
    label: str


# A group of codes in a parameter table.
class CodeGroup(TypedDict):
    # Heading of the group.
    title: str
    # The lowest code, included.
    lowest: Integer
    # The highest code, included.
    highest: Integer


# A cycle with its form and its source.
class CycleEntry(TypedDict):
    # The value of `cycle.type` in a job.
    type: Literal["internal-rectangle-protected", "double-wall-internal-corner", "probing-two-circles", "surface", "wall-angle", "hole", "hole-protected", "boss", "internal-rectangle", "external-rectangle", "web", "web-three-points", "groove", "groove-protected", "double-wall-external-corner", "triple-wall-internal-corner", "triple-wall-external-corner", "probe-on-off", "nc-action"]
    # Name given by its source.
    title: str
    # What it measures: one sentence in English.
    says: str
    # Further English search words.
    also: str
    # Source and number: `ENCY/SprutCAM type 5`.
    source: str
    # Type number in the source's parameter table, if it has one.
    number: Integer | None
    # Whether its touches may be picked one by one (`cycle.touches`).
    touches: bool
    # Largest number of touches.
    maxTouches: Integer
    # Whether it has its own feeds and search length.
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
    # Whether it may be `null`; this is then its default.
    optional: bool
    # The fields of that object, in order.
    fields: list[FieldEntry]


# Sources of an axis of a work offset, or of its rotation.
DatumRow = TypedDict(
    "DatumRow",
    {
        "axis": "Literal[\"x\", \"y\", \"z\", \"rotation\"]",
        "from": "str | None",
        "choices": "list[str]",
    },
)


# One field. Lengths are in mm, feeds in mm/min, angles in degrees, whatever the units of the job.
class FieldEntry(TypedDict):
    # Key in its section.
    key: str
    # Label in English.
    label: str
    # Help text in English.
    help: str
    # `number`, `count`, `flag`, `choice`, `code`, `text`, `point`, `nominal` or `nominalPoint`.
    kind: Literal["number", "count", "flag", "choice", "code", "text", "point", "nominal", "nominalPoint", "lines"]
    # `length`, `feed`, `acceleration`, `time`, `angle` or `none`.
    unit: Literal["length", "feed", "acceleration", "time", "angle", "none"]
    # Smallest and largest allowed number; null for a flag, text or a fixed set of values.
    range: list[float] | None
    # Whether the smallest number itself is excluded.
    above: bool
    # Smallest and largest usual number: the check warns outside of them. Null if every allowed number is usual.
    usual: list[float] | None
    # Value in a job that leaves the field out.
    default: DefaultEntry
    # Start value for a new job in inch, in inch: a round number near `default`. A job in inch that leaves the field out has `default`.
    defaultInch: DefaultEntry
    # Meaning of `null`; null if it is not allowed.
    null: str | None
    # The allowed values of a choice or a code; else empty.
    choices: list[ChoiceEntry]
    # Code in the source's parameter table: `CmdPrm.Flt[-50]`. Null if it has no code.
    code: str | None
    # Heading above the field in a form.
    group: str
    # Whether `part.sizes` may change it.
    size: bool
    # Condition on another field of the form under which this one counts; null if it always counts.
    when: WhenEntry | None


# A line of `touchpath plan -o FOLDER --json`: the file of a job.
class FileLine(TypedDict):
    source: str
    file: str | None
    hash: str | None
    control: str | None
    findings: list[Finding]


# An error, warning or note.
class Finding(TypedDict):
    # Weight; an error prevents the plan.
    level: Level
    # A stable, kebab-case name for programs to switch on, one of those in docs/findings.md.
    code: FindingCode
    # Position in the job: `cycle.sideClearance1`, `feeds.work`; empty for the whole job.
    path: str
    # Message in plain words, with numbers in the units of the job.
    message: str
    # The message as a template and its values: with a list of words it can be translated.
    said: Message


class Lentoax(TypedDict):
    # 0: `axind` is the full answer; 1: `matrix` must be read; -1: unknown coordinate system; -2: no active tool.
    status: Integer
    # For abscissa, ordinate and applicate: the number of the length that acts there, negative if it points the other way.
    axind: Vec3
    # Rows abscissa, ordinate, applicate; columns L1, L2, L3.
    matrix: list[Vec3]


# Results from measured values. Lengths in the job's units, angles in degrees.
class Measurement(TypedDict):
    # Results as in a plan, from measured values: `truth` is null.
    results: list[ResultRow]
    # Ball centre at each touch, in the work coordinate system; null without a contact. Empty if the text gives results instead of touches.
    points: list[Vec3 | None]
    # On grbl, which cannot write a work offset from a program: the block that the operator types before the next move. Null if nothing has to be typed; a finding gives the reason.
    block: str | None
    # Warnings and notes about the reading of the values, and about missing ones.
    findings: list[Finding]


# One move of the ball centre.
class Move(TypedDict):
    # End of the move; of a touch its nominal contact.
    to: Vec3
    # `approach`, `longLink`, `work`, `retract`, `return` or `rapid`.
    feed: Literal["approach", "longLink", "work", "retract", "return", "rapid"]
    # `position`, `touch` or `back`.
    kind: Literal["position", "touch", "back"]
    # Step in the cycle's documented list, from 1; 0 for a link move between two cycles. With native cycles: the line that makes it, counted from that of the first move.
    step: Integer
    # Index of its touch, for touches and retracts; null for positioning.
    touch: Integer | None
    # The arc of the move; null is a straight line.
    arc: Arc | None
    # Index of its cycle in a set-up, or of the cycle that a link move leads to; 0 for a job with one cycle.
    cycle: Integer


# One row of the parameter table.
class ParameterRow(TypedDict):
    # `CmdPrm.Flt[-53]`, or `Q1116` for a HEIDENHAIN cycle.
    code: str
    # Entry in the type column of the source.
    type: str
    # Value; lengths in the job's units.
    value: ParameterValue
    # Meaning in English; `meanings(job)` has it for other languages.
    meaning: str
    # Path of the job field that gives the value.
    field: str | None
    # Index of the touch that gives the value; null if it concerns the whole cycle.
    touch: Integer | None
    # Index of its cycle in a set-up; 0 for a job with one cycle.
    cycle: Integer


# The plan of a job. Lengths in the job's units, angles in degrees.
class Plan(TypedDict):
    # Nominal touches, on the surface.
    touches: list[TouchPoint]
    # Moves of the ball centre.
    moves: list[Move]
    # Names of the cycles of a set-up, in order; empty for a job with one cycle.
    cycles: list[str]
    # Names of the relations of a set-up, in order.
    relations: list[str]
    # For a set-up, the possible sources of each axis of a work offset and its rotation, and the used ones; empty for a job with one cycle.
    datum: list[DatumRow]
    # Length of the whole path: from the start in the job, else from the end of the first move.
    length: float
    # Time of the path, minutes. Rapids run at 5000 mm/min, or at the feed that the control's program states for them.
    time: float
    # The program for the control of the job.
    program: ProgramText
    # Parameters of the cycle with the numbers of its source.
    table: list[ParameterRow]
    # Results that the control will store on the virtual part.
    results: list[ResultRow]
    # Ball centre at the trigger of each touch on the virtual part; null without a contact within the search.
    triggers: list[Vec3 | None]
    # Warnings and notes; with an error there is no plan.
    findings: list[Finding]
    # Whether the program keeps each safety rule.
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
    # Name of the control.
    title: str
    # The usual file extension, without the dot.
    extension: str
    # Highest number of a work offset that a program can write; 0 if it can write no offset.
    workOffsets: Integer
    # Whether the job's `tool` section matters: plane and tool decide which length acts along the tool axis.
    firstLength: bool
    # Whether its program watches positioning moves with the probe.
    watches: bool
    # Whether its program computes the results.
    computes: bool
    # Whether its program computes between the native cycles of a set-up: relations, and cycles that follow results.
    computesBetween: bool
    # Whether its native cycles can correct a tool offset from a measured size.
    correctsTools: bool
    # Whether those correct it by a share of the error, beyond a dead band, or by the mean of several parts.
    correctsByShare: bool
    # Whether its programs of moves can correct a tool from the mean error of several parts.
    correctsByMoves: bool
    # Fields of the job's sections `control` and `machine` that change nothing on it.
    unused: list[str]
    # Usual lines of a shop for `machine.frame`, by place.
    usualLines: list[UsualLines]
    # Names of its work offsets, from number 1.
    workOffsetWords: list[str]
    # Whether the control supports each cycle, in each form of the program.
    cycles: list[SupportEntry]


# The program as text.
class ProgramText(TypedDict):
    # Id of the control.
    post: str
    # The usual file extension, without the dot.
    extension: str
    # Lines, each ended by a line feed.
    text: str
    # The 0-based line of each move; −1 if the native cycle makes it.
    moveLines: list[Integer]
    # Values that the program writes, in its own blocks or by the called cycle. For the work offset: axes in the order `X`, `Y`, `Z`, then `rotation`. For the active preset: `preset X` …, then `basic rotation` or `table offset`. Empty if it only measures.
    writes: list[Literal["X", "Y", "Z", "rotation", "preset X", "preset Y", "preset Z", "basic rotation", "table offset"]]
    # Summary of its writes to offsets and presets, in one sentence: `writes G54 X Y`, `measures only`.
    does: str
    # `does` as a template and its values.
    said: Message
    # Proof of the program; null in the form `cycle`.
    proof: ProofRow | None
    # Whether the moves of the plan are those of native cycles that the program calls.
    own: bool


# Outcome of one job among many.
class Programmed(TypedDict):
    # Its program; `null` without one.
    program: ProgramText | None
    # All findings; errors among them if there is no program.
    findings: list[Finding]


# Proof of a program of moves: read back, it is the path.
class ProofRow(TypedDict):
    # Number of moves of the path that the program makes, each with the right position, kind and feed.
    moves: Integer
    # Number of touches among them.
    touches: Integer
    # Whether the program computes the results, and they are right.
    arithmetic: bool


# A kind of relation.
class RelationEntry(TypedDict):
    # The value of `relations[].type` in a job.
    type: Literal["line", "center", "pitch-circle", "difference", "mean"]
    # Label in English.
    label: str
    # Its results: one sentence in English.
    says: str
    # Whether its operands are positions, named by their cycles and relations; else single results.
    places: bool
    # Smallest number of operands.
    least: Integer
    # Largest number of operands; null is any number.
    most: Integer | None
    # Codes of its results; `.angle` is added to the first if the operands are angles.
    results: list[ResultCode]


class Report(TypedDict):
    name: str
    by: str
    machine: str
    when: str
    note: str
    # Control of the program.
    control: str
    # Hash of the program's blocks from its header; empty without one.
    program: str
    parts: Integer
    # The worst verdict: `good`, `good within ±`, `out within ±`, `not measured`, `out` and others; `null` without any tolerance.
    verdict: str | None
    rows: list[ReportRow]


# A result in a report.
class ReportRow(TypedDict):
    # Its code; in a set-up with the name of its cycle or relation: `BORE.diameter`.
    code: str
    meaning: str
    # `mm`, `inch` or `deg`.
    unit: str
    nominal: float | None
    limits: list[float] | None
    # A value per part; `null` if not measured.
    values: list[float | None]
    # Deviation of the last part: value minus nominal.
    deviation: float | None
    # Expanded uncertainty (k = 2): 95 of 100 measurements lie within.
    expanded: float | None
    # A verdict per part; `null` without a tolerance.
    verdicts: list[str | None]
    # `null` for a single part.
    series: Series | None


# A measured value: computed by the control, with its nominal value.
class ResultRow(TypedDict):
    # A stable name, one of `RESULT_CODES`: `center.x`.
    code: ResultCode
    # Description of the value in English.
    meaning: str
    # `mm`, `inch` or `deg`; empty for a number without a unit.
    unit: Literal["mm", "inch", "deg", ""]
    # Value on the nominal part; null if it is unknown.
    nominal: float | None
    # Value that the control computes; null if the triggers cannot give it.
    value: float | None
    # Value minus nominal, or minus the middle of the tolerance.
    deviation: float | None
    # Standard uncertainty of the value (one sigma): scatter of the touches, and eccentricity of the ball.
    uncertainty: float | None
    # Part of the uncertainty that comes from the eccentricity of the ball (one sigma). Null if the job gives no eccentricity, or orients the spindle to the angle of calibration.
    uncertaintyRunout: float | None
    # Lower and upper limit, if there is a tolerance.
    limits: list[float] | None
    # Good, rework or scrap, if there is a tolerance; implausible beyond the limit.
    verdict: Verdict | None
    # True value on the virtual part, if there is one.
    truth: float | None
    # Reason why the value differs from the true value, if it does.
    note: str | None
    # Storage in the control after its native cycles: `#135`. Null for a program of moves, whose header lists it.
    stored: str | None
    # Index of its cycle in a set-up, or, after all cycles, of its relation; 0 for a job with one cycle.
    cycle: Integer
    # Its texts as templates and their values.
    said: ResultWords


# Texts of a result, for translation.
class ResultWords(TypedDict):
    # Description of the value.
    meaning: Message
    # Good, rework or scrap, if there is a tolerance.
    verdict: Message | None
    # Reason why the value differs from the true value, if it does.
    note: Message | None


# A safety rule that every program is checked for.
class RuleEntry(TypedDict):
    # Name of the rule, as in the plan's `safety`.
    name: str
    # Requirement for a program: one sentence.
    says: str
    # Possible consequence of breaking it.
    why: str


# Verdict of a safety rule.
class SafetyRow(TypedDict):
    # The name of the rule.
    rule: RuleName
    # Null if this control cannot guarantee it, or its native cycle is responsible for it.
    holds: bool | None
    # The requirement, the fault, or the reason why the control cannot guarantee it.
    message: str
    # `message` as a template and its values.
    said: Message
    # The 0-based lines that break it.
    lines: list[Integer]
    # The 0-based lines that the rule concerns, whether they keep or break it; those of the native cycle if that is responsible for it.
    about: list[Integer]


# One section of a job.
class SectionEntry(TypedDict):
    # Key in the job; empty for the job itself.
    path: str
    # Whether it may be `null`; this is then its default.
    optional: bool
    # The fields of the section, in order.
    fields: list[FieldEntry]


# Statistics of one result over several parts. Lengths in the job's units, angles in degrees.
class Series(TypedDict):
    # Number of parts with a value.
    count: Integer
    mean: float
    min: float
    max: float
    # Standard deviation over the parts, with the divisor count − 1; `null` for a single part.
    spread: float | None
    # Slope of the least-squares line through the values, per part; `null` for fewer than three.
    trend: float | None
    # (upper − lower limit) / (6 × spread); `null` without both limits or without spread.
    cp: float | None
    # Distance of the mean from the nearer limit / (3 × spread); `null` in the same cases.
    cpk: float | None


# Whether a control supports a cycle in a form.
class SupportEntry(TypedDict):
    # The value of `cycle.type`.
    type: Literal["internal-rectangle-protected", "double-wall-internal-corner", "probing-two-circles", "surface", "wall-angle", "hole", "hole-protected", "boss", "internal-rectangle", "external-rectangle", "web", "web-three-points", "groove", "groove-protected", "double-wall-external-corner", "triple-wall-internal-corner", "triple-wall-external-corner", "probe-on-off", "nc-action"]
    # `moves`: plain moves and touches. `cycle`: the native cycle.
    form: Literal["moves", "cycle"]
    # Whether the control supports the cycle in this form.
    supported: bool
    # Reason why not; null if it does.
    reason: str | None
    # Whether this native cycle corrects the active preset, so that no work offset is chosen.
    ownPreset: bool


# A touch of the nominal part.
class TouchPoint(TypedDict):
    # Touched point, on the surface.
    point: Vec3
    # Target vector: unit outward normal of the surface.
    vector: Vec3
    # Index of the touched surface, from 0.
    group: Integer
    # Index of its cycle in a set-up; 0 for a job of one cycle.
    cycle: Integer


# One move of a program.
class TraceMove(TypedDict):
    # End; null along an axis that no block has named yet.
    to: list[float | None]
    # `rapid`, `feed`, `watched`, `touch` or `unchecked`.
    kind: TraceKind
    # Feed; null for a rapid, or if no block has stated one.
    feed: float | None
    # The 0-based line of the move.
    line: Integer


# The moves of a program without a job.
class TraceRow(TypedDict):
    # Control whose language it was read in.
    control: str
    # `mm`, `inch`, or null if the program does not say.
    units: Literal["mm", "inch", None]
    # Its moves, in its units.
    moves: list[TraceMove]


# Usual lines of a shop at one place of the program.
class UsualLines(TypedDict):
    # `head`, `probeOn`, …
    place: str
    # The lines, with placeholders such as `{tool}`.
    lines: list[str]


# Condition on a field under which another one counts.
class WhenEntry(TypedDict):
    # Key of the other field, in the same form.
    key: str
    # The code that it must have.
    value: Integer


# A job of one cycle (format 1), or a set-up of several (format 2).
AnyJob: TypeAlias = Job


# X, Y, Z of the work coordinate system.
Vec3: TypeAlias = list[float]


# A value in a job.
DefaultEntry: TypeAlias = float | bool | str | Vec3 | None


# Every code of a finding; docs/findings.md says what each means.
FindingCode: TypeAlias = Literal["align-needs-confirm", "angle-rounded", "approach-beyond-wall", "approach-not-watched", "arc-unsolved", "ask-unsupported", "ask-unused", "ball-too-wide", "ball-unknown", "beyond-travel", "block-to-type", "block-too-long", "branch-ends", "circle-in-circle", "clear-too-low", "clearance-height-too-low", "clearance-too-small", "code-twice", "collision", "contact-at-start", "converted", "crossing-too-low", "cycle-chooses-points", "cycle-differs", "cycle-name", "cycle-no-lift", "cycle-no-zone", "cycle-not-parallel", "cycle-not-square", "cycle-one-path", "cycle-path-short", "cycle-plane", "cycle-stops", "datum-apart", "datum-unknown", "dist-needed", "dist-too-short", "division-by-zero", "dry-run-unsupported", "edge-contact", "edition-not-stated", "extrusion-direction", "feeds-of-set-up", "field-unused", "form-unsupported", "given-incomplete", "given-position", "header-unknown", "header-unsound", "implausible", "keep-out", "length-not-along-tool-axis", "length-to-centre", "lift-unused", "limit-stops", "limits-not-asked", "line-characters", "lines-differ", "lines-optional", "lines-skipped", "locked", "low-crossing", "low-rapid", "low-start", "machine-places", "macro-not-seen", "macro-stops", "measured-twice", "missing", "missing-code", "missing-parameter", "mixed-forms", "modes-set", "more-findings", "moves-before-cycle", "name-changed", "needs-calibration", "nested-too-deeply", "newer-format", "no-arc", "no-block", "no-circle", "no-contact", "no-direction", "no-extrusion", "no-job-in-program", "no-moves", "no-place", "no-results-in-program", "no-retract", "no-touches", "no-units", "not-a-flag", "not-a-number", "not-a-tolerance", "not-a-value", "not-allowed", "not-at-feed", "not-called", "not-finite", "not-in-dump", "not-in-program", "not-inserted", "not-json", "not-known", "not-on-one-circle", "not-on-one-wall", "not-proven", "not-rectangular", "not-understood", "not-verified", "not-whole", "nothing-switched", "nothing-to-import", "nothing-to-write", "number-protected", "number-unused", "offset-in-parts", "offset-measured-again", "offset-one-direction", "offset-optional", "order-of-cycles", "orient-unsupported", "other-control", "other-form", "other-units", "other-version", "out-of-range", "out-of-tolerance", "overtravel-too-short", "own-codes", "own-moves", "own-path", "pairs-not-square", "part-not-in-program", "passed-over", "passes-close", "path-not-above", "picks-differ", "picks-out-of-range", "place-of-result", "place-too-far", "places-computed", "places-transformed", "plane-from-dump", "plane-unknown", "plane-unsupported", "points-differ", "portal", "positioning-not-watched", "predefined", "probe-move-too-short", "probe-word", "probing-too-fast", "program-differs", "program-stops", "protection-unsupported", "rapid-at-feed", "reaction-unsupported", "relation-not-computed", "relation-of", "repeat-unsupported", "result-missing", "result-twice", "result-untrue", "rotary-unsupported", "rotation-not-written", "rotation-unsupported", "row-activated", "row-active", "rule-broken", "search-too-short", "semi-automatic", "semi-automatic-unsupported", "set-up-too-long", "set-up-unsupported", "several-cycles", "shank-collision", "shop-line", "shop-lines-unknown", "shop-lines-unused", "short-arc", "signs-contradict", "small-hole", "start-in-feature", "start-unknown", "starts-disagree", "stops-too-late", "stylus-from-dump", "stylus-not-known", "text-too-long", "tolerance-beyond-limit", "tolerance-elsewhere", "tolerance-unknown", "tolerance-unsupported", "too-far", "too-long", "too-many-digits", "too-many-registers", "too-many-touches", "tool-axis-reversed", "tool-by-name", "tool-corrected", "tool-length-unchecked", "tool-unused", "touch-above-top", "touch-aside", "touch-askew", "touch-beyond-corner", "touch-close", "touch-fast", "touch-missed", "touch-missing", "touch-near-edge", "touch-too-short", "touches-coincide", "touches-kept", "touches-not-level", "touches-unsound", "turn-beyond-limit", "uncertain-result", "unclear-line", "units-differ", "units-found", "units-not-stated", "units-unclear", "units-unknown", "unknown-code", "unknown-key", "unknown-parameter", "unknown-result", "unknown-type", "unknown-value", "unreadable", "unsafe-program", "unusable", "unusual", "variables-shared", "vector-not-in-plane", "vector-not-unit", "vector-not-upwards", "vector-wrong-way", "vectors-not-opposite", "walls-parallel", "wear-off-middle", "wear-unlimited", "wear-unsupported", "words-twice", "work-offset-needed", "work-offset-unclear", "work-offset-unsupported", "wrong-code", "wrong-count", "wrong-type", "wrong-wall", "zone-beyond-clearance", "zone-beyond-dist"]


# Content of a text: a job, or the moves of a program without a job. `findings` lists ignored lines and unknown values.
Imported: TypeAlias = dict[str, Any]


# A whole number.
Integer: TypeAlias = int


# Verdict of a tolerance or limit on a value.
Judged: TypeAlias = Literal["good", "rework", "scrap", "undefined", "implausible", "good within ±", "out", "out within ±"]


# Weight of a finding.
Level: TypeAlias = Literal["error", "warning", "info"]


# A message: its English template, then the values of the names in braces in the order of their first appearance. A value is a string that no language changes (a number with its unit, a code, text of the user) or another message.
Message: TypeAlias = list[str | Any]


# The value of a parameter.
ParameterValue: TypeAlias = Integer | bool | float | str


# The id of a control.
PostId: TypeAlias = Literal["linuxcnc", "grbl", "grblhal", "fluidnc", "sinumerik", "heidenhain", "fanuc", "haas", "mazak", "brother", "hurco", "okuma"]


# Every code of a result.
ResultCode: TypeAlias = Literal["center.x", "center.y", "diameter", "residual", "width", "width1", "width2", "rotation", "height", "corner.x", "corner.y", "corner.z", "angle", "residual1", "residual2", "point.x", "point.y", "point.z", "deviation", "offset.x", "offset.y", "offset.z", "offset.rotation", "distance", "difference", "difference.angle", "mean", "mean.angle", "spread", "Q183", "Q950", "Q951", "Q952", "Q953", "Q954", "Q955", "Q964", "Q965", "Q966", "Q967", "Q970", "Q971", "Q973", "Q974", "Q980", "Q981", "Q982", "Q983", "Q984", "Q985", "Q994", "Q995", "Q996", "Q997", "form1", "form2", "preset.table", "preset.x", "preset.y", "preset.z", "preset.rotation", "table.turn"]


# Every safety rule.
RuleName: TypeAlias = Literal["modes-stated", "spindle-off", "probe-asked", "probe-free-again", "low-start-goes-up", "positioning-watched", "contact-lifts", "missed-touch-stops", "missed-touch-lifts", "feeds-stated", "no-low-rapid", "offset-after-touches", "one-write", "plausible-before-write", "asked-before-write", "tolerance-obeyed", "place-within-limit", "restart-writes-nothing", "ends-above"]


# Kind of a motion.
TraceKind: TypeAlias = Literal["rapid", "feed", "watched", "touch", "unchecked"]


# The verdict of a value, or of the whole workpiece (`Q183`), with the reaction of the control.
Verdict: TypeAlias = Judged | str
