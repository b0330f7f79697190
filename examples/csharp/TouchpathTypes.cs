// What Touchpath answers, as types: of Plan, Finding, Measurement and the rest of touchpath/answers.schema.json.
// Made from that schema by scripts/csharp-types.mjs. A later version adds keys: pass over what is not known.
// Keys are read whatever their case: so does Newtonsoft.Json by itself, and System.Text.Json with JsonSerializerDefaults.Web.
namespace Touchpath
{
    /// <summary>An arc about the tool axis.</summary>
    public class Arc
    {
        /// <summary>Its centre, at the height of the move.</summary>
        public double[] Center { get; set; }
        /// <summary>Degrees, counter-clockwise positive seen against the tool axis; less than a whole turn.</summary>
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
        /// <summary>What programs are checked for.</summary>
        public RuleEntry[] Rules { get; set; }
        /// <summary>Codes of findings that hold for a control and form whatever the job: a page may say them once, at the control's name.</summary>
        public string[] Standing { get; set; }
        /// <summary>What the codes of a CmdPrm table are about; the first that fits counts.</summary>
        public CodeGroup[] CodeGroups { get; set; }
        /// <summary>The rate that rapids are taken to have in `plan().time`, mm/min, where the program states none for them.</summary>
        public double RapidRate { get; set; }
        /// <summary>The most touches that a parameter table of CmdPrm codes holds. The entry of a cycle has its own number.</summary>
        public double MaxTouches { get; set; }
        /// <summary>The longest text that a job is made of, in characters as JavaScript counts them (UTF-16 units).</summary>
        public double LongestText { get; set; }
        /// <summary>The longest program whose moves are read, likewise.</summary>
        public double LongestProgram { get; set; }
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
        /// <summary>The word, or the number, in the job.</summary>
        public object Value { get; set; }
        /// <summary>The same for people, in English.</summary>
        public string Label { get; set; }
    }

    /// <summary>What some codes of a parameter table are about.</summary>
    public class CodeGroup
    {
        /// <summary>What these codes are about, as a heading.</summary>
        public string Title { get; set; }
        /// <summary>The lowest code, included.</summary>
        public double Lowest { get; set; }
        /// <summary>The highest code, included.</summary>
        public double Highest { get; set; }
    }

    /// <summary>A cycle, its form, and where it is documented.</summary>
    public class CycleEntry
    {
        /// <summary>The value of `cycle.type` in a job.</summary>
        public string Type { get; set; }
        /// <summary>The name that its source gives it.</summary>
        public string Title { get; set; }
        /// <summary>What it measures, in a sentence, in English.</summary>
        public string Says { get; set; }
        /// <summary>What else people look for it by, in English: words for a search.</summary>
        public string Also { get; set; }
        /// <summary>Who documents it, and as what: `ENCY/SprutCAM type 5`.</summary>
        public string Source { get; set; }
        /// <summary>Its type number in the source's parameter table, where it has one.</summary>
        public double? Number { get; set; }
        /// <summary>Whether its touches may be picked one by one (`cycle.touches`).</summary>
        public bool Touches { get; set; }
        /// <summary>The most touches it can have.</summary>
        public double MaxTouches { get; set; }
        /// <summary>Whether it has feeds and a search length of its own.</summary>
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
        /// <summary>Whether it may be `null`, which is then its default.</summary>
        public bool Optional { get; set; }
        /// <summary>The fields of that object, in order.</summary>
        public FieldEntry[] Fields { get; set; }
    }

    /// <summary>What can be written into an axis of a work offset, or into its rotation.</summary>
    public class DatumRow
    {
        /// <summary>`x`, `y`, `z` or `rotation`: abscissa, ordinate, tool axis.</summary>
        public string Axis { get; set; }
        /// <summary>The result that is written, `BORE.center.x`, or would be if a work offset were chosen; null where none is.</summary>
        public string From { get; set; }
        /// <summary>Every result that can be.</summary>
        public string[] Choices { get; set; }
    }

    /// <summary>One field. Lengths are in mm, feeds in mm/min, angles in degrees, whatever the job's units.</summary>
    public class FieldEntry
    {
        /// <summary>Key in its section.</summary>
        public string Key { get; set; }
        /// <summary>Short name for people, in English.</summary>
        public string Label { get; set; }
        /// <summary>What the field is for, in English.</summary>
        public string Help { get; set; }
        /// <summary>`number`, `count`, `flag`, `choice`, `code`, `text`, `point`, `nominal` or `nominalPoint`.</summary>
        public string Kind { get; set; }
        /// <summary>`length`, `feed`, `acceleration`, `time`, `angle` or `none`.</summary>
        public string Unit { get; set; }
        /// <summary>Smallest and largest allowed number; null for a flag, text or a fixed set of values.</summary>
        public double[] Range { get; set; }
        /// <summary>Whether the smallest number itself is excluded.</summary>
        public bool Above { get; set; }
        /// <summary>Smallest and largest usual number: the check warns outside of them. Null where every allowed number is usual.</summary>
        public double[] Usual { get; set; }
        /// <summary>The value in a job that leaves the field out.</summary>
        public object Default { get; set; }
        /// <summary>What a new job in inch begins with, in inch: a number that people type, near to `default`. A job in inch that leaves the field out has `default`.</summary>
        public object DefaultInch { get; set; }
        /// <summary>What `null` means; null where it is not allowed.</summary>
        public string Null { get; set; }
        /// <summary>The allowed values of a choice or a code; else empty.</summary>
        public ChoiceEntry[] Choices { get; set; }
        /// <summary>Its code in the source's parameter table: `CmdPrm.Flt[-50]`. Null where it has none.</summary>
        public string Code { get; set; }
        /// <summary>The heading under which a form shows it.</summary>
        public string Group { get; set; }
        /// <summary>Whether `part.sizes` may change it.</summary>
        public bool Size { get; set; }
        /// <summary>What another field of its form must be for this one to count; null where it always counts.</summary>
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

    /// <summary>A problem, or something worth knowing.</summary>
    public class Finding
    {
        /// <summary>Whether it keeps the job from being planned.</summary>
        public string Level { get; set; }
        /// <summary>A stable, kebab-case name for programs to switch on, one of those in docs/findings.md.</summary>
        public string Code { get; set; }
        /// <summary>The place in the job: `cycle.sideClearance1`, `feeds.work`; empty for the job as a whole.</summary>
        public string Path { get; set; }
        /// <summary>Plain words for a person, with numbers in the job's units.</summary>
        public string Message { get; set; }
        /// <summary>The message as a template and its values: with a list of words it can be said in another language.</summary>
        public object[] Said { get; set; }
    }

    public class Lentoax
    {
        /// <summary>0: `axind` says it all; 1: `matrix` must be read; -1: coordinate system not known; -2: no tool active.</summary>
        public double Status { get; set; }
        /// <summary>For abscissa, ordinate, applicate: the number of the length that acts there, negative if it points the other way.</summary>
        public double[] Axind { get; set; }
        /// <summary>Rows abscissa, ordinate, applicate; columns L1, L2, L3.</summary>
        public double[][] Matrix { get; set; }
    }

    /// <summary>What follows from measured values. Lengths in the job's units, angles in degrees.</summary>
    public class Measurement
    {
        /// <summary>As a plan has them, from what was measured: `truth` is null.</summary>
        public ResultRow[] Results { get; set; }
        /// <summary>The ball centre at each touch, in the work coordinate system; null where it made no contact. Empty where the text gives results and no touches.</summary>
        public double[][] Points { get; set; }
        /// <summary>On grbl, which cannot write a work offset from a program: the block that the operator types before the next move. Null if nothing has to be typed; a finding gives the reason.</summary>
        public string Block { get; set; }
        /// <summary>How the values were read, and what is missing: warnings and notes.</summary>
        public Finding[] Findings { get; set; }
    }

    /// <summary>One move of the ball centre.</summary>
    public class Move
    {
        /// <summary>Where it ends; a touch at its nominal contact.</summary>
        public double[] To { get; set; }
        /// <summary>`approach`, `longLink`, `work`, `retract`, `return` or `rapid`.</summary>
        public string Feed { get; set; }
        /// <summary>`position`, `touch` or `back`.</summary>
        public string Kind { get; set; }
        /// <summary>Step of the cycle's documented list, from 1; 0 on the way between two cycles. Where native cycles make it: which line makes it, from that of the first move on.</summary>
        public double Step { get; set; }
        /// <summary>Index of the touch that it makes or comes back from; null for positioning.</summary>
        public double? Touch { get; set; }
        /// <summary>The arc it runs along; null is a straight line.</summary>
        public Arc Arc { get; set; }
        /// <summary>Index of its cycle in a set-up, or of the one that it leads to; 0 for a job of one cycle.</summary>
        public double Cycle { get; set; }
    }

    /// <summary>One row of the parameter table.</summary>
    public class ParameterRow
    {
        /// <summary>`CmdPrm.Flt[-53]`, or `Q1116` for a HEIDENHAIN cycle.</summary>
        public string Code { get; set; }
        /// <summary>The type column of the source.</summary>
        public string Type { get; set; }
        /// <summary>The value, lengths in the job's units.</summary>
        public object Value { get; set; }
        /// <summary>What it means, in English; `meanings(job)` has it for other languages.</summary>
        public string Meaning { get; set; }
        /// <summary>Path of the job's field it comes from.</summary>
        public string Field { get; set; }
        /// <summary>Index of the touch it comes from; null if it concerns the whole cycle.</summary>
        public double? Touch { get; set; }
        /// <summary>Index of its cycle in a set-up; 0 for a job of one cycle.</summary>
        public double Cycle { get; set; }
    }

    /// <summary>Everything that follows from a job. Lengths in the job's units, angles in degrees.</summary>
    public class Plan
    {
        /// <summary>The nominal touches, on the surface.</summary>
        public TouchPoint[] Touches { get; set; }
        /// <summary>The moves, of the ball centre.</summary>
        public Move[] Moves { get; set; }
        /// <summary>The names of the cycles of a set-up, in their order; empty for a job of one cycle.</summary>
        public string[] Cycles { get; set; }
        /// <summary>The names of the relations of a set-up, in their order.</summary>
        public string[] Relations { get; set; }
        /// <summary>Of a set-up, what can be written into each axis of a work offset and into its rotation, and what is; empty for a job of one cycle.</summary>
        public DatumRow[] Datum { get; set; }
        /// <summary>Length of the whole path: from where the job says the ball is, else from where the first move ends.</summary>
        public double Length { get; set; }
        /// <summary>Minutes for the same. Rapids run at 5000 mm/min, or at the feed that the control's program states for them.</summary>
        public double Time { get; set; }
        /// <summary>The program, for the control of the job.</summary>
        public ProgramText Program { get; set; }
        /// <summary>The cycle's parameters as its source numbers them.</summary>
        public ParameterRow[] Table { get; set; }
        /// <summary>Results the control will store, for the virtual part.</summary>
        public ResultRow[] Results { get; set; }
        /// <summary>Ball centre at the trigger of each touch on the virtual part; null where it is not met in time.</summary>
        public double[][] Triggers { get; set; }
        /// <summary>Warnings and notes; with an error there is no plan.</summary>
        public Finding[] Findings { get; set; }
        /// <summary>For each safety rule, whether the program keeps it.</summary>
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
        /// <summary>The control's name, for people.</summary>
        public string Title { get; set; }
        /// <summary>The usual file extension, without the dot.</summary>
        public string Extension { get; set; }
        /// <summary>Highest number of a work offset that a program can write; 0 where it can write none.</summary>
        public double WorkOffsets { get; set; }
        /// <summary>Whether the job's `tool` section matters: plane and tool decide which length acts along the tool axis.</summary>
        public bool FirstLength { get; set; }
        /// <summary>Whether its program watches positioning moves with the probe.</summary>
        public bool Watches { get; set; }
        /// <summary>Whether its program computes the results itself.</summary>
        public bool Computes { get; set; }
        /// <summary>Whether its own cycles can correct a tool offset from a measured size.</summary>
        public bool CorrectsTools { get; set; }
        /// <summary>The fields of the job's section `control` that change nothing on it.</summary>
        public string[] Unused { get; set; }
        /// <summary>What its work offsets are called, from number 1.</summary>
        public string[] WorkOffsetWords { get; set; }
        /// <summary>For each cycle, and each form of the program, whether the control takes it.</summary>
        public SupportEntry[] Cycles { get; set; }
    }

    /// <summary>The program as text.</summary>
    public class ProgramText
    {
        /// <summary>Which control it is for.</summary>
        public string Post { get; set; }
        /// <summary>The usual file extension, without the dot.</summary>
        public string Extension { get; set; }
        /// <summary>Its lines, each ended by a line feed.</summary>
        public string Text { get; set; }
        /// <summary>For each move the 0-based line that makes it; −1 where the native cycle makes it.</summary>
        public double[] MoveLines { get; set; }
        /// <summary>What it writes, in its own blocks or by the cycle that it calls. Of the work offset: axes in the order `X`, `Y`, `Z`, then `rotation`. Of the active preset: `preset X` …, then `basic rotation` or `table offset`. Empty where it measures only.</summary>
        public string[] Writes { get; set; }
        /// <summary>What it does with offsets and presets, in one sentence: `writes G54 X Y`, `measures only`.</summary>
        public string Does { get; set; }
        /// <summary>The same as a template and its values.</summary>
        public object[] Said { get; set; }
        /// <summary>What was proven of it; null in the form `cycle`.</summary>
        public ProofRow Proof { get; set; }
        /// <summary>Whether the moves of the plan are those that native cycles make, which the program calls.</summary>
        public bool Own { get; set; }
    }

    /// <summary>The outcome of one job among many.</summary>
    public class Programmed
    {
        /// <summary>Its program; `null` where it has none.</summary>
        public ProgramText Program { get; set; }
        /// <summary>All findings; where there is no program, errors among them.</summary>
        public Finding[] Findings { get; set; }
    }

    /// <summary>What was proven of a program of moves: read back, it is the path.</summary>
    public class ProofRow
    {
        /// <summary>How many moves of the path it makes, each where and how it should.</summary>
        public double Moves { get; set; }
        /// <summary>How many of them are touches.</summary>
        public double Touches { get; set; }
        /// <summary>Whether the program computes the results itself, and the right ones.</summary>
        public bool Arithmetic { get; set; }
    }

    /// <summary>A kind of relation.</summary>
    public class RelationEntry
    {
        /// <summary>The value of `relations[].type` in a job.</summary>
        public string Type { get; set; }
        /// <summary>Its name for people, in English.</summary>
        public string Label { get; set; }
        /// <summary>What its results are, in English.</summary>
        public string Says { get; set; }
        /// <summary>Whether its operands are positions, named by their cycles and relations; else single results.</summary>
        public bool Places { get; set; }
        /// <summary>The fewest operands.</summary>
        public double Least { get; set; }
        /// <summary>The most operands; null if it takes any number.</summary>
        public double? Most { get; set; }
        /// <summary>The codes of its results; of angles `.angle` is added to the first.</summary>
        public string[] Results { get; set; }
    }

    public class Report
    {
        public string Name { get; set; }
        public string By { get; set; }
        public string Machine { get; set; }
        public string When { get; set; }
        public string Note { get; set; }
        /// <summary>The control that the program is for.</summary>
        public string Control { get; set; }
        /// <summary>The hash over the blocks of the program, as its header says it; empty where it says none.</summary>
        public string Program { get; set; }
        public double Parts { get; set; }
        /// <summary>`good`, `good within ±`, `out within ±`, `not measured`, `out` and the like: the worst of all; `null` where nothing has a tolerance.</summary>
        public string Verdict { get; set; }
        public ReportRow[] Rows { get; set; }
    }

    /// <summary>A result in a report.</summary>
    public class ReportRow
    {
        /// <summary>Its code, in a set-up behind the name of its cycle or relation: `BORE.diameter`.</summary>
        public string Code { get; set; }
        public string Meaning { get; set; }
        /// <summary>`mm`, `inch` or `deg`.</summary>
        public string Unit { get; set; }
        public double? Nominal { get; set; }
        public double[] Limits { get; set; }
        /// <summary>One a part; `null` where it was not measured.</summary>
        public double?[] Values { get; set; }
        /// <summary>Of the last part: value less nominal.</summary>
        public double? Deviation { get; set; }
        /// <summary>Twice the standard uncertainty: 95 of 100 measurements lie within.</summary>
        public double? Expanded { get; set; }
        /// <summary>One a part; `null` where no tolerance is given.</summary>
        public string[] Verdicts { get; set; }
        /// <summary>`null` of a single part.</summary>
        public Series Series { get; set; }
    }

    /// <summary>A value that the cycle measures: what the control computes, and what it should be.</summary>
    public class ResultRow
    {
        /// <summary>A stable name, one of `RESULT_CODES`: `center.x`.</summary>
        public string Code { get; set; }
        /// <summary>What the value is, in English.</summary>
        public string Meaning { get; set; }
        /// <summary>`mm`, `inch` or `deg`; empty for a number without a unit.</summary>
        public string Unit { get; set; }
        /// <summary>Its value on the nominal part; null where that is not known.</summary>
        public double? Nominal { get; set; }
        /// <summary>What the control computes; null where the triggers cannot give it.</summary>
        public double? Value { get; set; }
        /// <summary>Value less nominal, or less the middle of the tolerance zone.</summary>
        public double? Deviation { get; set; }
        /// <summary>One sigma of the value: scatter of the touches, and eccentricity of the ball.</summary>
        public double? Uncertainty { get; set; }
        /// <summary>How much of it comes from the ball's eccentricity: one sigma of that alone. Null where the job says none, or turns the spindle to the angle of calibration.</summary>
        public double? UncertaintyRunout { get; set; }
        /// <summary>Lower and upper limit, where a tolerance is given.</summary>
        public double[] Limits { get; set; }
        /// <summary>Good, rework or scrap, where a tolerance is given; implausible, where it is off by more than its limit.</summary>
        public string Verdict { get; set; }
        /// <summary>The true value on the virtual part, where there is one.</summary>
        public double? Truth { get; set; }
        /// <summary>Why the value is not the truth, where it is not.</summary>
        public string Note { get; set; }
        /// <summary>Where the control has it after its own cycles: `#135`. Null of a program of moves, whose header says it.</summary>
        public string Stored { get; set; }
        /// <summary>Index of its cycle in a set-up, or behind all cycles that of its relation; 0 for a job of one cycle.</summary>
        public double Cycle { get; set; }
        /// <summary>Its words as templates and their values.</summary>
        public ResultWords Said { get; set; }
    }

    /// <summary>The words of a result, to be put into other languages.</summary>
    public class ResultWords
    {
        /// <summary>What the value is.</summary>
        public object[] Meaning { get; set; }
        /// <summary>Good, rework or scrap, where a tolerance is given.</summary>
        public object[] Verdict { get; set; }
        /// <summary>Why the value is not the truth, where it is not.</summary>
        public object[] Note { get; set; }
    }

    /// <summary>A safety rule, as every program is checked for it.</summary>
    public class RuleEntry
    {
        /// <summary>Its name, by which the plan's `safety` refers to it.</summary>
        public string Name { get; set; }
        /// <summary>What it demands of a program, in a sentence.</summary>
        public string Says { get; set; }
        /// <summary>What could happen without it.</summary>
        public string Why { get; set; }
    }

    /// <summary>Whether the program keeps a safety rule.</summary>
    public class SafetyRow
    {
        /// <summary>The name of the rule.</summary>
        public string Rule { get; set; }
        /// <summary>Null where this control cannot hold it, or its own cycle answers for it.</summary>
        public bool? Holds { get; set; }
        /// <summary>What the rule asks, what is wrong, or why the control cannot.</summary>
        public string Message { get; set; }
        /// <summary>The same as a template and its values.</summary>
        public object[] Said { get; set; }
        /// <summary>The 0-based lines that break it.</summary>
        public double[] Lines { get; set; }
        /// <summary>The 0-based lines that it was asked of, whether they keep or break it; those of the native cycle where that answers for it.</summary>
        public double[] About { get; set; }
    }

    /// <summary>One section of a job.</summary>
    public class SectionEntry
    {
        /// <summary>Its key in the job, empty for the job itself.</summary>
        public string Path { get; set; }
        /// <summary>Whether it may be `null`, which is then its default.</summary>
        public bool Optional { get; set; }
        /// <summary>The fields of the section, in order.</summary>
        public FieldEntry[] Fields { get; set; }
    }

    /// <summary>What several parts say of one result. Lengths in the job's units, angles in degrees.</summary>
    public class Series
    {
        /// <summary>How many parts have a value.</summary>
        public double Count { get; set; }
        public double Mean { get; set; }
        public double Min { get; set; }
        public double Max { get; set; }
        /// <summary>Standard deviation of the parts, divided by count − 1; `null` of a single one.</summary>
        public double? Spread { get; set; }
        /// <summary>Slope of the straight line of least squares through the values, a part; `null` of fewer than three.</summary>
        public double? Trend { get; set; }
        /// <summary>(upper − lower limit) / 6 spreads; `null` without both limits or without spread.</summary>
        public double? Cp { get; set; }
        /// <summary>Distance of the mean from the nearer limit / 3 spreads; likewise.</summary>
        public double? Cpk { get; set; }
    }

    /// <summary>Whether a control takes a cycle in a form.</summary>
    public class SupportEntry
    {
        /// <summary>The value of `cycle.type`.</summary>
        public string Type { get; set; }
        /// <summary>`moves`: plain moves and touches. `cycle`: the native cycle.</summary>
        public string Form { get; set; }
        /// <summary>Whether the control takes the cycle in this form.</summary>
        public bool Supported { get; set; }
        /// <summary>Why not; null where it does.</summary>
        public string Reason { get; set; }
        /// <summary>Whether this native cycle corrects the active preset, so that no work offset is chosen.</summary>
        public bool OwnPreset { get; set; }
    }

    /// <summary>Where the ball is to touch the nominal part.</summary>
    public class TouchPoint
    {
        /// <summary>The point that is touched, on the surface.</summary>
        public double[] Point { get; set; }
        /// <summary>Target vector: outward normal of the surface, of length one.</summary>
        public double[] Vector { get; set; }
        /// <summary>Which wall or circle it is on, from 0.</summary>
        public double Group { get; set; }
        /// <summary>Index of its cycle in a set-up; 0 for a job of one cycle.</summary>
        public double Cycle { get; set; }
    }

    /// <summary>One move of a program.</summary>
    public class TraceMove
    {
        /// <summary>Where it ends; null along an axis that no block has named yet.</summary>
        public double?[] To { get; set; }
        /// <summary>`rapid`, `feed`, `watched`, `touch` or `unchecked`.</summary>
        public string Kind { get; set; }
        /// <summary>Null is a rapid, or a feed that no block has stated.</summary>
        public double? Feed { get; set; }
        /// <summary>The 0-based line that makes it.</summary>
        public double Line { get; set; }
    }

    /// <summary>The moves of a program that says no job.</summary>
    public class TraceRow
    {
        /// <summary>The control whose language it was read in.</summary>
        public string Control { get; set; }
        /// <summary>`mm`, `inch`, or null where it does not say.</summary>
        public string Units { get; set; }
        /// <summary>Its moves, in its units.</summary>
        public TraceMove[] Moves { get; set; }
    }

    /// <summary>What a field must be for another one to count.</summary>
    public class WhenEntry
    {
        /// <summary>Key of that other field, in the same form.</summary>
        public string Key { get; set; }
        /// <summary>The code that it must have.</summary>
        public double Value { get; set; }
    }
}
