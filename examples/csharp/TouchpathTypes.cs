// What Touchpath answers, as types: of Plan, Finding, Measurement and the rest of touchpath/answers.schema.json.
// Made from that schema by scripts/csharp-types.mjs. A later version adds keys: pass over what is not known.
// Keys are read whatever their case: so does Newtonsoft.Json by itself, and System.Text.Json with JsonSerializerDefaults.Web.
namespace Touchpath
{
    /// <summary>An arc about the tool axis.</summary>
    public class Arc
    {
        /// <summary>Centre, at the height of the move.</summary>
        public double[] Center { get; set; }
        /// <summary>Sweep in degrees, counter-clockwise positive seen against the tool axis; less than a whole turn.</summary>
        public double Sweep { get; set; }
    }

    /// <summary>Cycles, controls and the sections around them.</summary>
    public class Catalog
    {
        /// <summary>The version of the job format that this crate reads.</summary>
        public double Format { get; set; }
        /// <summary>Every cycle, with its fields and steps.</summary>
        public CycleEntry[] Cycles { get; set; }
        /// <summary>The sections of a job around the cycle.</summary>
        public SectionEntry[] Sections { get; set; }
        /// <summary>Every kind of relation between results of a set-up.</summary>
        public RelationEntry[] Relations { get; set; }
        /// <summary>Every control, with what its programs can do.</summary>
        public PostEntry[] Posts { get; set; }
        /// <summary>Safety rules that programs are checked for.</summary>
        public RuleEntry[] Rules { get; set; }
        /// <summary>Codes of findings that hold for a control and form whatever the job. A page may show them once, at the control's name.</summary>
        public string[] Standing { get; set; }
        /// <summary>Groups of codes in a CmdPrm table; the first matching group counts.</summary>
        public CodeGroup[] CodeGroups { get; set; }
        /// <summary>Assumed rate of rapids in `plan().time`, mm/min, if the program states no rate.</summary>
        public double RapidRate { get; set; }
        /// <summary>Largest number of touches that a parameter table of CmdPrm codes holds. Each cycle has its own number in its entry.</summary>
        public int MaxTouches { get; set; }
        /// <summary>Length of the longest text that can become a job, in UTF-16 units (characters as JavaScript counts them).</summary>
        public int LongestText { get; set; }
        /// <summary>Length of the longest program whose moves are read, in the same units.</summary>
        public int LongestProgram { get; set; }
    }

    /// <summary>A line of `touchpath check --json`.</summary>
    public class CheckLine
    {
        public string Source { get; set; }
        public Finding[] Findings { get; set; }
    }

    /// <summary>One allowed value of a choice or a code.</summary>
    public class ChoiceEntry
    {
        /// <summary>Word or number in the job.</summary>
        public object Value { get; set; }
        /// <summary>Label in English.</summary>
        public string Label { get; set; }
    }

    /// <summary>A group of codes in a parameter table.</summary>
    public class CodeGroup
    {
        /// <summary>Heading of the group.</summary>
        public string Title { get; set; }
        /// <summary>The lowest code, included.</summary>
        public int Lowest { get; set; }
        /// <summary>The highest code, included.</summary>
        public int Highest { get; set; }
    }

    /// <summary>A cycle with its form and its source.</summary>
    public class CycleEntry
    {
        /// <summary>The value of `cycle.type` in a job.</summary>
        public string Type { get; set; }
        /// <summary>Name given by its source.</summary>
        public string Title { get; set; }
        /// <summary>What it measures: one sentence in English.</summary>
        public string Says { get; set; }
        /// <summary>Further English search words.</summary>
        public string Also { get; set; }
        /// <summary>Source and number: `ENCY/SprutCAM type 5`.</summary>
        public string Source { get; set; }
        /// <summary>Type number in the source's parameter table, if it has one.</summary>
        public int? Number { get; set; }
        /// <summary>Whether its touches may be picked one by one (`cycle.touches`).</summary>
        public bool Touches { get; set; }
        /// <summary>Largest number of touches.</summary>
        public int MaxTouches { get; set; }
        /// <summary>Whether it has its own feeds and search length.</summary>
        public bool OwnFeeds { get; set; }
        /// <summary>Page of the manual: a path in this repository.</summary>
        public string Doc { get; set; }
        /// <summary>The fields of its form, in order.</summary>
        public FieldEntry[] Fields { get; set; }
        /// <summary>Forms inside its form.</summary>
        public CycleSectionEntry[] Sections { get; set; }
        /// <summary>Its documented steps, in our words; index 0 is step 1.</summary>
        public string[] Steps { get; set; }
    }

    /// <summary>A form inside a cycle's form.</summary>
    public class CycleSectionEntry
    {
        /// <summary>Key of the object in `cycle`.</summary>
        public string Key { get; set; }
        /// <summary>Whether it may be `null`; this is then its default.</summary>
        public bool Optional { get; set; }
        /// <summary>The fields of that object, in order.</summary>
        public FieldEntry[] Fields { get; set; }
    }

    /// <summary>Sources of an axis of a work offset, or of its rotation.</summary>
    public class DatumRow
    {
        /// <summary>`x`, `y`, `z` or `rotation`: abscissa, ordinate, tool axis.</summary>
        public string Axis { get; set; }
        /// <summary>Result for the work offset, for example `BORE.center.x`, also if no offset is chosen yet. Null if no result can be written.</summary>
        public string From { get; set; }
        /// <summary>Every possible result.</summary>
        public string[] Choices { get; set; }
    }

    /// <summary>One field. Lengths are in mm, feeds in mm/min, angles in degrees, whatever the units of the job.</summary>
    public class FieldEntry
    {
        /// <summary>Key in its section.</summary>
        public string Key { get; set; }
        /// <summary>Label in English.</summary>
        public string Label { get; set; }
        /// <summary>Help text in English.</summary>
        public string Help { get; set; }
        /// <summary>`number`, `count`, `flag`, `choice`, `code`, `text`, `point`, `nominal` or `nominalPoint`.</summary>
        public string Kind { get; set; }
        /// <summary>`length`, `feed`, `acceleration`, `time`, `angle` or `none`.</summary>
        public string Unit { get; set; }
        /// <summary>Smallest and largest allowed number; null for a flag, text or a fixed set of values.</summary>
        public double[] Range { get; set; }
        /// <summary>Whether the smallest number itself is excluded.</summary>
        public bool Above { get; set; }
        /// <summary>Smallest and largest usual number: the check warns outside of them. Null if every allowed number is usual.</summary>
        public double[] Usual { get; set; }
        /// <summary>Value in a job that leaves the field out.</summary>
        public object Default { get; set; }
        /// <summary>Start value for a new job in inch, in inch: a round number near `default`. A job in inch that leaves the field out has `default`.</summary>
        public object DefaultInch { get; set; }
        /// <summary>Meaning of `null`; null if it is not allowed.</summary>
        public string Null { get; set; }
        /// <summary>The allowed values of a choice or a code; else empty.</summary>
        public ChoiceEntry[] Choices { get; set; }
        /// <summary>Code in the source's parameter table: `CmdPrm.Flt[-50]`. Null if it has no code.</summary>
        public string Code { get; set; }
        /// <summary>Heading above the field in a form.</summary>
        public string Group { get; set; }
        /// <summary>Whether `part.sizes` may change it.</summary>
        public bool Size { get; set; }
        /// <summary>Condition on another field of the form under which this one counts; null if it always counts.</summary>
        public WhenEntry When { get; set; }
    }

    /// <summary>A line of `touchpath plan -o FOLDER --json`: the file of a job.</summary>
    public class FileLine
    {
        public string Source { get; set; }
        public string File { get; set; }
        public string Hash { get; set; }
        public string Control { get; set; }
        public Finding[] Findings { get; set; }
    }

    /// <summary>An error, warning or note.</summary>
    public class Finding
    {
        /// <summary>Weight; an error prevents the plan.</summary>
        public string Level { get; set; }
        /// <summary>A stable, kebab-case name for programs to switch on, one of those in docs/findings.md.</summary>
        public string Code { get; set; }
        /// <summary>Position in the job: `cycle.sideClearance1`, `feeds.work`; empty for the whole job.</summary>
        public string Path { get; set; }
        /// <summary>Message in plain words, with numbers in the units of the job.</summary>
        public string Message { get; set; }
        /// <summary>The message as a template and its values: with a list of words it can be translated.</summary>
        public object[] Said { get; set; }
    }

    public class Lentoax
    {
        /// <summary>0: `axind` is the full answer; 1: `matrix` must be read; -1: unknown coordinate system; -2: no active tool.</summary>
        public int Status { get; set; }
        /// <summary>For abscissa, ordinate and applicate: the number of the length that acts there, negative if it points the other way.</summary>
        public double[] Axind { get; set; }
        /// <summary>Rows abscissa, ordinate, applicate; columns L1, L2, L3.</summary>
        public double[][] Matrix { get; set; }
    }

    /// <summary>Results from measured values. Lengths in the job's units, angles in degrees.</summary>
    public class Measurement
    {
        /// <summary>Results as in a plan, from measured values: `truth` is null.</summary>
        public ResultRow[] Results { get; set; }
        /// <summary>Ball centre at each touch, in the work coordinate system; null without a contact. Empty if the text gives results instead of touches.</summary>
        public double[][] Points { get; set; }
        /// <summary>On grbl, which cannot write a work offset from a program: the block that the operator types before the next move. Null if nothing has to be typed; a finding gives the reason.</summary>
        public string Block { get; set; }
        /// <summary>Warnings and notes about the reading of the values, and about missing ones.</summary>
        public Finding[] Findings { get; set; }
    }

    /// <summary>One move of the ball centre.</summary>
    public class Move
    {
        /// <summary>End of the move; of a touch its nominal contact.</summary>
        public double[] To { get; set; }
        /// <summary>`approach`, `longLink`, `work`, `retract`, `return` or `rapid`.</summary>
        public string Feed { get; set; }
        /// <summary>`position`, `touch` or `back`.</summary>
        public string Kind { get; set; }
        /// <summary>Step in the cycle's documented list, from 1; 0 for a link move between two cycles. With native cycles: the line that makes it, counted from that of the first move.</summary>
        public int Step { get; set; }
        /// <summary>Index of its touch, for touches and retracts; null for positioning.</summary>
        public int? Touch { get; set; }
        /// <summary>The arc of the move; null is a straight line.</summary>
        public Arc Arc { get; set; }
        /// <summary>Index of its cycle in a set-up, or of the cycle that a link move leads to; 0 for a job with one cycle.</summary>
        public int Cycle { get; set; }
    }

    /// <summary>One row of the parameter table.</summary>
    public class ParameterRow
    {
        /// <summary>`CmdPrm.Flt[-53]`, or `Q1116` for a HEIDENHAIN cycle.</summary>
        public string Code { get; set; }
        /// <summary>Entry in the type column of the source.</summary>
        public string Type { get; set; }
        /// <summary>Value; lengths in the job's units.</summary>
        public object Value { get; set; }
        /// <summary>Meaning in English; `meanings(job)` has it for other languages.</summary>
        public string Meaning { get; set; }
        /// <summary>Path of the job field that gives the value.</summary>
        public string Field { get; set; }
        /// <summary>Index of the touch that gives the value; null if it concerns the whole cycle.</summary>
        public int? Touch { get; set; }
        /// <summary>Index of its cycle in a set-up; 0 for a job with one cycle.</summary>
        public int Cycle { get; set; }
    }

    /// <summary>The plan of a job. Lengths in the job's units, angles in degrees.</summary>
    public class Plan
    {
        /// <summary>Nominal touches, on the surface.</summary>
        public TouchPoint[] Touches { get; set; }
        /// <summary>Moves of the ball centre.</summary>
        public Move[] Moves { get; set; }
        /// <summary>Names of the cycles of a set-up, in order; empty for a job with one cycle.</summary>
        public string[] Cycles { get; set; }
        /// <summary>Names of the relations of a set-up, in order.</summary>
        public string[] Relations { get; set; }
        /// <summary>For a set-up, the possible sources of each axis of a work offset and its rotation, and the used ones; empty for a job with one cycle.</summary>
        public DatumRow[] Datum { get; set; }
        /// <summary>Length of the whole path: from the start in the job, else from the end of the first move.</summary>
        public double Length { get; set; }
        /// <summary>Time of the path, minutes. Rapids run at 5000 mm/min, or at the feed that the control's program states for them.</summary>
        public double Time { get; set; }
        /// <summary>The program for the control of the job.</summary>
        public ProgramText Program { get; set; }
        /// <summary>Parameters of the cycle with the numbers of its source.</summary>
        public ParameterRow[] Table { get; set; }
        /// <summary>Results that the control will store on the virtual part.</summary>
        public ResultRow[] Results { get; set; }
        /// <summary>Ball centre at the trigger of each touch on the virtual part; null without a contact within the search.</summary>
        public double[][] Triggers { get; set; }
        /// <summary>Warnings and notes; with an error there is no plan.</summary>
        public Finding[] Findings { get; set; }
        /// <summary>Whether the program keeps each safety rule.</summary>
        public SafetyRow[] Safety { get; set; }
    }

    /// <summary>A line of `touchpath plan --ndjson`: what became of a job.</summary>
    public class PlanLine
    {
        public string Source { get; set; }
        public string Program { get; set; }
        public Finding[] Findings { get; set; }
    }

    /// <summary>A control that programs are written for.</summary>
    public class PostEntry
    {
        /// <summary>The value of `control.post` in a job.</summary>
        public string Id { get; set; }
        /// <summary>Name of the control.</summary>
        public string Title { get; set; }
        /// <summary>The usual file extension, without the dot.</summary>
        public string Extension { get; set; }
        /// <summary>Highest number of a work offset that a program can write; 0 if it can write no offset.</summary>
        public int WorkOffsets { get; set; }
        /// <summary>Whether the job's `tool` section matters: plane and tool decide which length acts along the tool axis.</summary>
        public bool FirstLength { get; set; }
        /// <summary>Whether its program watches positioning moves with the probe.</summary>
        public bool Watches { get; set; }
        /// <summary>Whether its program computes the results.</summary>
        public bool Computes { get; set; }
        /// <summary>Whether its program computes between the native cycles of a set-up: relations, and cycles that follow results.</summary>
        public bool ComputesBetween { get; set; }
        /// <summary>Whether its native cycles can correct a tool offset from a measured size.</summary>
        public bool CorrectsTools { get; set; }
        /// <summary>Whether those correct it by a share of the error, beyond a dead band, or by the mean of several parts.</summary>
        public bool CorrectsByShare { get; set; }
        /// <summary>Whether its programs of moves can correct a tool from the mean error of several parts.</summary>
        public bool CorrectsByMoves { get; set; }
        /// <summary>Fields of the job's sections `control` and `machine` that change nothing on it.</summary>
        public string[] Unused { get; set; }
        /// <summary>Usual lines of a shop for `machine.frame`, by place.</summary>
        public UsualLines[] UsualLines { get; set; }
        /// <summary>Names of its work offsets, from number 1.</summary>
        public string[] WorkOffsetWords { get; set; }
        /// <summary>Whether the control supports each cycle, in each form of the program.</summary>
        public SupportEntry[] Cycles { get; set; }
    }

    /// <summary>The program as text.</summary>
    public class ProgramText
    {
        /// <summary>Id of the control.</summary>
        public string Post { get; set; }
        /// <summary>The usual file extension, without the dot.</summary>
        public string Extension { get; set; }
        /// <summary>Lines, each ended by a line feed.</summary>
        public string Text { get; set; }
        /// <summary>The 0-based line of each move; −1 if the native cycle makes it.</summary>
        public int[] MoveLines { get; set; }
        /// <summary>Values that the program writes, in its own blocks or by the called cycle. For the work offset: axes in the order `X`, `Y`, `Z`, then `rotation`. For the active preset: `preset X` …, then `basic rotation` or `table offset`. Empty if it only measures.</summary>
        public string[] Writes { get; set; }
        /// <summary>Summary of its writes to offsets and presets, in one sentence: `writes G54 X Y`, `measures only`.</summary>
        public string Does { get; set; }
        /// <summary>`does` as a template and its values.</summary>
        public object[] Said { get; set; }
        /// <summary>Proof of the program; null in the form `cycle`.</summary>
        public ProofRow Proof { get; set; }
        /// <summary>Whether the moves of the plan are those of native cycles that the program calls.</summary>
        public bool Own { get; set; }
    }

    /// <summary>Outcome of one job among many.</summary>
    public class Programmed
    {
        /// <summary>Its program; `null` without one.</summary>
        public ProgramText Program { get; set; }
        /// <summary>All findings; errors among them if there is no program.</summary>
        public Finding[] Findings { get; set; }
    }

    /// <summary>Proof of a program of moves: read back, it is the path.</summary>
    public class ProofRow
    {
        /// <summary>Number of moves of the path that the program makes, each with the right position, kind and feed.</summary>
        public int Moves { get; set; }
        /// <summary>Number of touches among them.</summary>
        public int Touches { get; set; }
        /// <summary>Whether the program computes the results, and they are right.</summary>
        public bool Arithmetic { get; set; }
    }

    /// <summary>A kind of relation.</summary>
    public class RelationEntry
    {
        /// <summary>The value of `relations[].type` in a job.</summary>
        public string Type { get; set; }
        /// <summary>Label in English.</summary>
        public string Label { get; set; }
        /// <summary>Its results: one sentence in English.</summary>
        public string Says { get; set; }
        /// <summary>Whether its operands are positions, named by their cycles and relations; else single results.</summary>
        public bool Places { get; set; }
        /// <summary>Smallest number of operands.</summary>
        public int Least { get; set; }
        /// <summary>Largest number of operands; null is any number.</summary>
        public int? Most { get; set; }
        /// <summary>Codes of its results; `.angle` is added to the first if the operands are angles.</summary>
        public string[] Results { get; set; }
    }

    public class Report
    {
        public string Name { get; set; }
        public string By { get; set; }
        public string Machine { get; set; }
        public string When { get; set; }
        public string Note { get; set; }
        /// <summary>Control of the program.</summary>
        public string Control { get; set; }
        /// <summary>Hash of the program's blocks from its header; empty without one.</summary>
        public string Program { get; set; }
        public int Parts { get; set; }
        /// <summary>The worst verdict: `good`, `good within ±`, `out within ±`, `not measured`, `out` and others; `null` without any tolerance.</summary>
        public string Verdict { get; set; }
        public ReportRow[] Rows { get; set; }
    }

    /// <summary>A result in a report.</summary>
    public class ReportRow
    {
        /// <summary>Its code; in a set-up with the name of its cycle or relation: `BORE.diameter`.</summary>
        public string Code { get; set; }
        public string Meaning { get; set; }
        /// <summary>`mm`, `inch` or `deg`.</summary>
        public string Unit { get; set; }
        public double? Nominal { get; set; }
        public double[] Limits { get; set; }
        /// <summary>A value per part; `null` if not measured.</summary>
        public double?[] Values { get; set; }
        /// <summary>Deviation of the last part: value minus nominal.</summary>
        public double? Deviation { get; set; }
        /// <summary>Expanded uncertainty (k = 2): 95 of 100 measurements lie within.</summary>
        public double? Expanded { get; set; }
        /// <summary>A verdict per part; `null` without a tolerance.</summary>
        public string[] Verdicts { get; set; }
        /// <summary>`null` for a single part.</summary>
        public Series Series { get; set; }
    }

    /// <summary>A measured value: computed by the control, with its nominal value.</summary>
    public class ResultRow
    {
        /// <summary>A stable name, one of `RESULT_CODES`: `center.x`.</summary>
        public string Code { get; set; }
        /// <summary>Description of the value in English.</summary>
        public string Meaning { get; set; }
        /// <summary>`mm`, `inch` or `deg`; empty for a number without a unit.</summary>
        public string Unit { get; set; }
        /// <summary>Value on the nominal part; null if it is unknown.</summary>
        public double? Nominal { get; set; }
        /// <summary>Value that the control computes; null if the triggers cannot give it.</summary>
        public double? Value { get; set; }
        /// <summary>Value minus nominal, or minus the middle of the tolerance.</summary>
        public double? Deviation { get; set; }
        /// <summary>Standard uncertainty of the value (one sigma): scatter of the touches, and eccentricity of the ball.</summary>
        public double? Uncertainty { get; set; }
        /// <summary>Part of the uncertainty that comes from the eccentricity of the ball (one sigma). Null if the job gives no eccentricity, or orients the spindle to the angle of calibration.</summary>
        public double? UncertaintyRunout { get; set; }
        /// <summary>Lower and upper limit, if there is a tolerance.</summary>
        public double[] Limits { get; set; }
        /// <summary>Good, rework or scrap, if there is a tolerance; implausible beyond the limit.</summary>
        public string Verdict { get; set; }
        /// <summary>True value on the virtual part, if there is one.</summary>
        public double? Truth { get; set; }
        /// <summary>Reason why the value differs from the true value, if it does.</summary>
        public string Note { get; set; }
        /// <summary>Storage in the control after its native cycles: `#135`. Null for a program of moves, whose header lists it.</summary>
        public string Stored { get; set; }
        /// <summary>Index of its cycle in a set-up, or, after all cycles, of its relation; 0 for a job with one cycle.</summary>
        public int Cycle { get; set; }
        /// <summary>Its texts as templates and their values.</summary>
        public ResultWords Said { get; set; }
    }

    /// <summary>Texts of a result, for translation.</summary>
    public class ResultWords
    {
        /// <summary>Description of the value.</summary>
        public object[] Meaning { get; set; }
        /// <summary>Good, rework or scrap, if there is a tolerance.</summary>
        public object[] Verdict { get; set; }
        /// <summary>Reason why the value differs from the true value, if it does.</summary>
        public object[] Note { get; set; }
    }

    /// <summary>A safety rule that every program is checked for.</summary>
    public class RuleEntry
    {
        /// <summary>Name of the rule, as in the plan's `safety`.</summary>
        public string Name { get; set; }
        /// <summary>Requirement for a program: one sentence.</summary>
        public string Says { get; set; }
        /// <summary>Possible consequence of breaking it.</summary>
        public string Why { get; set; }
    }

    /// <summary>Verdict of a safety rule.</summary>
    public class SafetyRow
    {
        /// <summary>The name of the rule.</summary>
        public string Rule { get; set; }
        /// <summary>Null if this control cannot guarantee it, or its native cycle is responsible for it.</summary>
        public bool? Holds { get; set; }
        /// <summary>The requirement, the fault, or the reason why the control cannot guarantee it.</summary>
        public string Message { get; set; }
        /// <summary>`message` as a template and its values.</summary>
        public object[] Said { get; set; }
        /// <summary>The 0-based lines that break it.</summary>
        public int[] Lines { get; set; }
        /// <summary>The 0-based lines that the rule concerns, whether they keep or break it; those of the native cycle if that is responsible for it.</summary>
        public int[] About { get; set; }
    }

    /// <summary>One section of a job.</summary>
    public class SectionEntry
    {
        /// <summary>Key in the job; empty for the job itself.</summary>
        public string Path { get; set; }
        /// <summary>Whether it may be `null`; this is then its default.</summary>
        public bool Optional { get; set; }
        /// <summary>The fields of the section, in order.</summary>
        public FieldEntry[] Fields { get; set; }
    }

    /// <summary>Statistics of one result over several parts. Lengths in the job's units, angles in degrees.</summary>
    public class Series
    {
        /// <summary>Number of parts with a value.</summary>
        public int Count { get; set; }
        public double Mean { get; set; }
        public double Min { get; set; }
        public double Max { get; set; }
        /// <summary>Standard deviation over the parts, with the divisor count − 1; `null` for a single part.</summary>
        public double? Spread { get; set; }
        /// <summary>Slope of the least-squares line through the values, per part; `null` for fewer than three.</summary>
        public double? Trend { get; set; }
        /// <summary>(upper − lower limit) / (6 × spread); `null` without both limits or without spread.</summary>
        public double? Cp { get; set; }
        /// <summary>Distance of the mean from the nearer limit / (3 × spread); `null` in the same cases.</summary>
        public double? Cpk { get; set; }
    }

    /// <summary>Whether a control supports a cycle in a form.</summary>
    public class SupportEntry
    {
        /// <summary>The value of `cycle.type`.</summary>
        public string Type { get; set; }
        /// <summary>`moves`: plain moves and touches. `cycle`: the native cycle.</summary>
        public string Form { get; set; }
        /// <summary>Whether the control supports the cycle in this form.</summary>
        public bool Supported { get; set; }
        /// <summary>Reason why not; null if it does.</summary>
        public string Reason { get; set; }
        /// <summary>Whether this native cycle corrects the active preset, so that no work offset is chosen.</summary>
        public bool OwnPreset { get; set; }
    }

    /// <summary>A touch of the nominal part.</summary>
    public class TouchPoint
    {
        /// <summary>Touched point, on the surface.</summary>
        public double[] Point { get; set; }
        /// <summary>Target vector: unit outward normal of the surface.</summary>
        public double[] Vector { get; set; }
        /// <summary>Index of the touched surface, from 0.</summary>
        public int Group { get; set; }
        /// <summary>Index of its cycle in a set-up; 0 for a job of one cycle.</summary>
        public int Cycle { get; set; }
    }

    /// <summary>One move of a program.</summary>
    public class TraceMove
    {
        /// <summary>End; null along an axis that no block has named yet.</summary>
        public double?[] To { get; set; }
        /// <summary>`rapid`, `feed`, `watched`, `touch` or `unchecked`.</summary>
        public string Kind { get; set; }
        /// <summary>Feed; null for a rapid, or if no block has stated one.</summary>
        public double? Feed { get; set; }
        /// <summary>The 0-based line of the move.</summary>
        public int Line { get; set; }
    }

    /// <summary>The moves of a program without a job.</summary>
    public class TraceRow
    {
        /// <summary>Control whose language it was read in.</summary>
        public string Control { get; set; }
        /// <summary>`mm`, `inch`, or null if the program does not say.</summary>
        public string Units { get; set; }
        /// <summary>Its moves, in its units.</summary>
        public TraceMove[] Moves { get; set; }
    }

    /// <summary>Usual lines of a shop at one place of the program.</summary>
    public class UsualLines
    {
        /// <summary>`head`, `probeOn`, …</summary>
        public string Place { get; set; }
        /// <summary>The lines, with placeholders such as `{tool}`.</summary>
        public string[] Lines { get; set; }
    }

    /// <summary>Condition on a field under which another one counts.</summary>
    public class WhenEntry
    {
        /// <summary>Key of the other field, in the same form.</summary>
        public string Key { get; set; }
        /// <summary>The code that it must have.</summary>
        public int Value { get; set; }
    }
}
