//! The forms of a job around the cycle.

use crate::control::corrections::ToolOffsets;
use crate::control::edition::Edition;
use crate::control::shop::place::{self, FRAME};
use crate::control::{
    self, Ask, HeaderDetail, POSTS, PostDef, ProgramForm, ResultOutput, WRITE_OFFSET,
};
use crate::cycle::{self, CYCLES, Cycle, CycleDef, REPEAT, Repeat};
use crate::form::{Checker, Choice, Field, PlacedLines, Section, SubForm, Value, form};
use crate::formula::{Limits, Wear};
use crate::geom::{AXIS_NAMES, Plane, Rigid, Vec3};
use crate::job::lentoax::{LENGTH_TYPE, read_frame};
use crate::job::sized::{self, Sized};
use crate::job::wear;
use crate::part::{Machine, PartPlacement, Stock, StylusShape, UncertaintySources};
use crate::path::{Feeds, ProbeSettings};
use crate::text::text;
use crate::tool_length::{self, Query, lentoax, sentence};

/// Key of a job with the tolerances of its results.
pub const TOLERANCES: &str = "tolerances";

/// Default size limit, mm.
pub const USUAL_SIZE: f64 = 0.5;

/// Format that this crate writes and reads.
pub const FORMAT: f64 = 1.0;

/// Unit of a job's lengths.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Units {
    /// `mm`, the default.
    Mm,
    /// `inch`, 25.4 mm.
    Inch,
}

impl Units {
    /// Word in the job's field `units`.
    pub const fn word(self) -> &'static str {
        match self {
            Units::Mm => "mm",
            Units::Inch => "inch",
        }
    }

    /// The units with this word, `mm` or `inch`; `None` for any other word.
    pub fn named(word: &str) -> Option<Units> {
        [Units::Mm, Units::Inch]
            .into_iter()
            .find(|units| units.word() == word)
    }

    /// Units of a loose job; mm if it gives none.
    pub fn of(job: &Value) -> Units {
        match job.get("units") {
            Some(Value::Text(word)) => Units::named(word).unwrap_or(Units::Mm),
            _ => Units::Mm,
        }
    }

    /// Millimetres in one unit: 1 or 25.4.
    pub const fn scale(self) -> f64 {
        match self {
            Units::Mm => 1.0,
            Units::Inch => 25.4,
        }
    }
}

/// Whether positioning is watched, if the control can.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Protection {
    Checked,
    None,
}

impl Protection {
    const fn word(self) -> &'static str {
        match self {
            Protection::Checked => "checked",
            Protection::None => "none",
        }
    }
}

pub const UNITS: &[Choice] = &[
    Choice {
        value: Units::Mm.word(),
        label: Units::Mm.word(),
    },
    Choice {
        value: Units::Inch.word(),
        label: Units::Inch.word(),
    },
];
const PLANES: &[Choice] = &[
    Choice {
        value: "G17",
        label: "G17 (XY, tool axis Z)",
    },
    Choice {
        value: "G18",
        label: "G18 (ZX, tool axis Y)",
    },
    Choice {
        value: "G19",
        label: "G19 (YZ, tool axis X)",
    },
];
pub const POST_CHOICES: &[Choice] = &post_choices();

const fn post_choices() -> [Choice; POSTS.len()] {
    let mut choices = [Choice {
        value: "",
        label: "",
    }; POSTS.len()];
    let mut i = 0;
    while i < POSTS.len() {
        choices[i] = Choice {
            value: POSTS[i].key,
            label: POSTS[i].title,
        };
        i += 1;
    }
    choices
}

const FORMS: &[Choice] = &[
    Choice {
        value: ProgramForm::Moves.word(),
        label: "Plain moves",
    },
    Choice {
        value: ProgramForm::Cycle.word(),
        label: "The native cycle",
    },
];

const HEADERS: &[Choice] = &[
    Choice {
        value: HeaderDetail::Full.word(),
        label: "The whole job",
    },
    Choice {
        value: HeaderDetail::Short.word(),
        label: "Short",
    },
];

const PROTECTIONS: &[Choice] = &[
    Choice {
        value: Protection::Checked.word(),
        label: "Watched and checked",
    },
    Choice {
        value: Protection::None.word(),
        label: "Not watched",
    },
];

const RUNS: &[Choice] = &[
    Choice {
        value: NORMAL_RUN,
        label: "Normal",
    },
    Choice {
        value: DRY_RUN,
        label: "Dry run: measures and writes nothing",
    },
];

/// Key of the choice whether a program asks before it writes.
pub const ASK: &str = "ask";

/// The measuring run, and the dry run that tries the moves.
pub const NORMAL_RUN: &str = "normal";
const DRY_RUN: &str = "dry";

const ASKS: &[Choice] = &[
    Choice {
        value: Ask::Never.word(),
        label: "Never",
    },
    Choice {
        value: Ask::Always.word(),
        label: "Always",
    },
    Choice {
        value: Ask::Outside.word(),
        label: "If a result is out of tolerance",
    },
];

const TOOL_OFFSETS: &[Choice] = &[
    Choice {
        value: ToolOffsets::Unknown.word(),
        label: "Not stated",
    },
    Choice {
        value: ToolOffsets::Radius.word(),
        label: "Radius, with wear",
    },
    Choice {
        value: ToolOffsets::Diameter.word(),
        label: "Diameter, with wear",
    },
    Choice {
        value: ToolOffsets::RadiusInMemoryA.word(),
        label: "Radius, memory A",
    },
    Choice {
        value: ToolOffsets::DiameterInMemoryA.word(),
        label: "Diameter, memory A",
    },
];

/// Key of the edition of the macros.
pub const EDITION: &str = "edition";

const EDITIONS: &[Choice] = &[
    Choice {
        value: Edition::Unknown.word(),
        label: "Not stated",
    },
    Choice {
        value: Edition::Haas.word(),
        label: "3.11 for Haas NGC",
    },
    Choice {
        value: Edition::Mazak.word(),
        label: "A-4013-0113 for Mazak",
    },
];

const REPORTS: &[Choice] = &[
    Choice {
        value: ResultOutput::Screen.word(),
        label: "On the screen",
    },
    Choice {
        value: ResultOutput::Log.word(),
        label: "In a log",
    },
    Choice {
        value: ResultOutput::None.word(),
        label: "In variables only",
    },
];

form! {
    /// The job itself.
    pub struct General {
        /// Name of the program.
        name: String = Field::text("name", "Program name", "PROBE", 200).group("Program and machine"),
        /// Unit of every length in the job, the program and the table.
        units: String = Field::choice("units", "Units", UNITS).group("Program and machine"),
        /// The working plane; the tool axis is square to it.
        plane: String = Field::choice("plane", "Plane", PLANES).group("Program and machine"),
        /// Overtravel: distance the probe searches past the nominal contact before the touch counts as a miss.
        overtravel: f64 = Field::length("overtravel", "Overtravel", 5.0).range(0.01, 1000.0).usual(0.5, 50.0).group("Probe"),
    }
}

form! {
    /// The stylus.
    pub struct Stylus {
        /// Effective diameter of the ball; 0 is a point.
        diameter: f64 = Field::length("diameter", "Ball diameter", 6.0).in_inch(0.236).range(0.0, 100.0).usual(0.3, 20.0).group("Probe"),
        /// One sigma of a single touch along its probing direction.
        repeatability: f64 = Field::length("repeatability", "Repeatability", 0.001).in_inch(0.00005).range(0.0, 1.0).usual(0.0, 0.02).group("Probe"),
        /// From the ball centre up to the probe body. Empty: unknown; the probe body is then not checked.
        length: Option<f64> = Field::length("length", "Stylus length", 50.0).range(0.1, 1000.0).usual(5.0, 200.0).null_by_default().null_means("not known").group("Probe"),
        /// Diameter of the stylus above the ball. Empty: unknown.
        shank: Option<f64> = Field::length("shank", "Shank diameter", 4.0).range(0.05, 100.0).usual(0.2, 20.0).null_by_default().null_means("not known").group("Probe"),
        /// Diameter of the probe body above the stylus. Empty: unknown.
        body: Option<f64> = Field::length("body", "Body diameter", 40.0).range(1.0, 500.0).usual(10.0, 100.0).null_by_default().null_means("not known").group("Probe"),
        /// Eccentricity: half the total indicator reading at the ball over one spindle revolution. Adds to the uncertainty unless the spindle is oriented. Empty: unknown.
        runout: Option<f64> = Field::length("runout", "Ball eccentricity", 0.01).range(0.0, 10.0).usual(0.0, 0.1).null_by_default().null_means("not known").group("Probe"),
    }
}

form! {
    /// Largest deviation of a result from nominal: beyond it the program raises an alarm and writes nothing.
    pub struct LimitsForm {
        /// Largest distance of a measured position from its nominal one, along each axis. Empty: the part may lie anywhere within the search.
        position: Option<f64> = Field::length("position", "Position limit", 2.0).range(0.001, 1000.0).null_by_default().null_means("no limit").group("Feeds and limits"),
        /// Largest deviation of a measured width, diameter or length.
        size: Option<f64> = Field::length("size", "Size limit", USUAL_SIZE).range(0.001, 1000.0).usual(0.01, 5.0).null_means("no limit").group("Feeds and limits"),
        /// Largest deviation of a measured angle or direction.
        angle: Option<f64> = Field::angle("angle", "Angle limit", 1.0).range(0.001, 180.0).usual(0.01, 15.0).null_means("no limit").group("Feeds and limits"),
        /// Largest root mean square distance of the touches from the fitted circle or wall, if there are more touches than the fit needs.
        residual: Option<f64> = Field::length("residual", "Residual limit", 0.1).range(0.001, 1000.0).usual(0.005, 1.0).null_means("no limit").group("Feeds and limits"),
    }
}

form! {
    /// Stopping behaviour of the machine. The defaults are moderate assumptions [I]: the values are unknown before they are measured.
    pub struct MachineForm {
        /// How fast an axis slows down after the probe triggers. Hobby machines have 200 to 1000 mm/s², machining centres more.
        acceleration: f64 = Field::acceleration("acceleration", "Acceleration", 500.0).usual(50.0, 20_000.0).group("Program and machine"),
        /// Delay from contact to the start of deceleration: probe, receiver and control.
        latency: f64 = Field::time("latency", "Latency", 5.0).range(0.0, 1000.0).usual(0.5, 50.0).group("Program and machine"),
        /// Permissible stylus deflection after contact, from the probe's data sheet: 3 to 12 mm sideways.
        deflection: f64 = Field::length("deflection", "Stylus deflection", 3.0).range(0.01, 100.0).usual(1.0, 15.0).group("Program and machine"),
        /// Edition of Renishaw's macros on the machine, from the top of its programs. Editions differ in the letters that exclude each other, and in calibration.
        edition: String = Field::choice(EDITION, "Edition of the macros", EDITIONS).group("Program and machine"),
        /// Lines of your shop at fixed places of the program: tool change, probe on, safe position. {tool}, {offset}, {axis}, {feed}, {clearance} and {name} become
        /// values of the job. A line must not write an offset, jump, or move below the clearance.
        frame: PlacedLines = Field::lines(FRAME, "Shop's lines", place::CHOICES).group("Shop's lines"),
    }
}

form! {
    /// The feeds.
    pub struct FeedForm {
        /// From the feed distance to the start of the cycle.
        approach: Option<f64> = Field::feed("approach", "Approach feed", 2000.0).usual(50.0, 10_000.0).null_means("rapid").group("Feeds and limits"),
        /// Every positioning move inside the cycle.
        long_link: Option<f64> = Field::feed("longLink", "Long link feed", 1000.0).usual(50.0, 10_000.0).null_means("rapid").group("Feeds and limits"),
        /// The touches. Never rapid.
        work: f64 = Field::feed("work", "Work feed", 150.0).usual(5.0, 1000.0).group("Feeds and limits"),
        /// Back from a surface touch; only cycles with such a step use it.
        retract: Option<f64> = Field::feed("retract", "Retract feed", 1000.0).usual(50.0, 10_000.0).null_means("rapid").group("Feeds and limits"),
        /// The last lift.
        return_: Option<f64> = Field::feed("return", "Return feed", 2000.0).usual(50.0, 10_000.0).null_means("rapid").group("Feeds and limits"),
    }
}

form! {
    /// The control.
    pub struct Control {
        /// Which control the program is for.
        post: String = Field::choice("post", "Control", POST_CHOICES).group("Program and machine"),
        /// Plain moves: every move is written out, on the job's path. Native cycle: a few calls, on the cycle's own path, which is shown.
        form: String = Field::choice("form", "Program form", FORMS).group("Program and machine"),
        /// The work offset that the program writes at its end: 1 is G54. Empty: measure only.
        work_offset: Option<i32> = Field::count("workOffset", "Work offset to write", 1, 1, 105).null_by_default().null_means("measure only").group("Program and machine"),
        /// Whether positioning moves are watched by the probe, where the control can: a contact then stops the program.
        protection: String = Field::choice("protection", "Positioning", PROTECTIONS).group("Program and machine"),
        /// A dry run makes the same moves without a part: a touch ends at its nominal contact, a contact anywhere stops it, and nothing is written.
        run: String = Field::choice("run", "Run", RUNS).group("Program and machine"),
        /// Height along the tool axis by which a dry run is raised: above the part it can run with the part in the machine.
        lift: f64 = Field::length("lift", "Height of a dry run", 0.0).range(0.0, 1000.0).usual(0.0, 300.0).group("Program and machine"),
        /// Detail of the header comments. A header with the whole job lets Touchpath reopen the program.
        header: String = Field::choice("header", "Comments at the top", HEADERS).group("Program and machine"),
        /// Tool number of the probe. HEIDENHAIN programs call it; LinuxCNC, SINUMERIK, Fanuc and Haas programs check that it is in the spindle. Empty: neither.
        tool: Option<i32> = Field::count("tool", "Probe's tool number", 1, 1, 32_767).null_by_default().null_means("in the spindle, not checked").group("Program and machine"),
        /// Angle that the spindle is turned to before the first move: the one at which the probe was calibrated. Empty: the program does not turn it.
        orient: Option<f64> = Field::angle("orient", "Spindle orientation", 0.0).range(0.0, 360.0).null_by_default().null_means("not oriented").group("Program and machine"),
        /// Probe input of the control: the one that the probe in the spindle is connected to.
        probe_input: i32 = Field::count("probeInput", "Probe input", 1, 1, 2).group("Program and machine"),
        /// Where the program shows its results before it ends.
        report: String = Field::choice("report", "Results in the program", REPORTS).group("Program and machine"),
        /// Whether the program shows its results and waits for cycle start before it writes a work offset. A reset then writes nothing.
        ask: String = Field::choice(ASK, "Ask before the write", ASKS).group("Program and machine"),
        /// What the tool offsets hold, if a program of moves corrects them. Haas: setting 40. Fanuc: parameter 5004, and its memory for offsets: C with wear, or A.
        tool_offsets: String = Field::choice("toolOffsets", "Tool offsets", TOOL_OFFSETS).group("Program and machine"),
        /// SET_UP of the touch probe table: native cycles add it to their set-up clearance.
        set_up: f64 = Field::length("setUp", "SET_UP of the probe table", 0.0).range(0.0, 100.0).usual(0.0, 20.0).group("Program and machine"),
        /// Number of the program, on controls whose programs have one. Empty: the four digits at the end of the program name (O2201, BORE2201; not a size such
        /// as D1200), else 1000.
        number: Option<i32> = Field::count("number", "Program number", 1000, 1, 9999).null_by_default().null_means("from the name").group("Program and machine"),
    }
}

form! {
    /// Settings that decide which of the probe's lengths acts where, on a control that decides it by plane, tool type, frame and setting data.
    pub struct ToolForm {
        /// The tool type's number: 710 is a 3D probe; 400 to 599 are turning and grinding tools.
        type_: i32 = Field::count("type", "Tool type", 710, 0, 9999).group("Tool length (SINUMERIK)"),
        /// SD42900 $SC_MIRROR_TOOL_LENGTH: a mirrored axis changes the sign of the length.
        sd42900: bool = Field::flag("sd42900", "SD42900 MIRROR_TOOL_LENGTH", false).group("Tool length (SINUMERIK)"),
        /// SD42940 $SC_TOOL_LENGTH_CONST: the assignment of this plane holds in every plane; 0 takes the active plane.
        sd42940: i32 = Field::count("sd42940", "SD42940 TOOL_LENGTH_CONST", 0, -32_768, 32_767).group("Tool length (SINUMERIK)"),
        /// SD42950 $SC_TOOL_LENGTH_TYPE: whether lengths act as for milling or as for turning.
        sd42950: i32 = Field::code_of("sd42950", "SD42950 TOOL_LENGTH_TYPE", 0, LENGTH_TYPE).group("Tool length (SINUMERIK)"),
    }
}

form! {
    /// Position of the actual part.
    pub struct PartForm {
        /// How far the part is shifted.
        offset: Vec3 = Field::point("offset", "Shift of the part").group("Virtual part"),
        /// How far the part is turned about the tool axis through the work origin, before the shift.
        rotation: f64 = Field::angle("rotation", "Turn of the part", 0.0).range(-180.0, 180.0).group("Virtual part"),
    }
}

form! {
    /// The stock: a block, parallel to the axes, into which the features are cut. Null: unknown, and not checked.
    pub struct StockForm {
        /// Corner of the block with the smallest X, Y and Z.
        origin: Vec3 = Field::point("origin", "Lowest corner").at([-50.0, -50.0, -20.0]).group("Stock"),
        /// Length of the block along X, Y and Z.
        size: Vec3 = Field::point("size", "Size").at([100.0, 100.0, 20.0]).range(0.01, 100_000.0).group("Stock"),
    }
}

/// Sections of a job that are plain forms. The key of the job itself is empty.
pub const SECTIONS: &[SubForm] = &[
    SubForm::required("", General::FIELDS),
    SubForm::required("stylus", Stylus::FIELDS),
    SubForm::required("feeds", FeedForm::FIELDS),
    SubForm::required("limits", LimitsForm::FIELDS),
    SubForm::required("machine", MachineForm::FIELDS),
    SubForm::required("control", Control::FIELDS),
    SubForm::required("tool", ToolForm::FIELDS),
    STOCK,
    SubForm::required("part", PartForm::FIELDS),
];

/// The stock.
pub const STOCK: SubForm = SubForm::optional("stock", StockForm::FIELDS);

/// The section with this key.
pub fn section(key: &str) -> Option<&'static SubForm> {
    SECTIONS.iter().find(|section| section.key == key)
}

/// A checked job. Lengths in mm.
#[derive(Debug)]
pub struct Job {
    /// Program name as given.
    pub name: String,
    /// Millimetres in a unit of the job.
    pub scale: f64,
    /// `mm` or `inch`.
    pub unit: &'static str,
    /// Plane, ball radius, overtravel.
    pub setup: ProbeSettings,
    /// Standard deviation of a touch, mm.
    pub repeatability: f64,
    /// Known dimensions of the stylus above its ball.
    pub shape: StylusShape,
    /// Eccentricity of the ball from the spindle axis, mm; `None` is unknown.
    pub runout: Option<f64>,
    /// Limits of the deviations of results from nominal.
    pub limits: Limits,
    /// Stopping behaviour of the machine.
    pub machine: Machine,
    /// Lines of the shop in the program.
    pub shop: PlacedLines,
    /// Feeds, mm/min.
    pub feeds: Feeds,
    /// Definition of the cycle.
    pub def: &'static CycleDef,
    pub cycle: Box<dyn Cycle>,
    /// Sizes that contain a tolerance.
    pub sized: Vec<Sized>,
    /// Repeated touches of each point; `None` touches once.
    pub repeat: Option<Repeat>,
    pub post: &'static PostDef,
    pub form: ProgramForm,
    /// Tool number of the probe; `None` is not called.
    pub tool: Option<i32>,
    /// Whether positioning is to be watched, if the control can.
    pub protected: bool,
    /// Height of a dry run above the path, mm.
    pub dry: Option<f64>,
    pub header: HeaderDetail,
    /// Work offset to write, 1 = G54; `None` only measures.
    pub work_offset: Option<i32>,
    /// Angle to which the spindle is oriented, degrees; `None` does not orient it.
    pub orient: Option<f64>,
    /// The probe input of the control, from 1.
    pub probe_input: usize,
    pub report: ResultOutput,
    pub ask: Ask,
    pub tool_offsets: ToolOffsets,
    /// Edition of the macros that native cycles call.
    pub edition: Edition,
    /// Number of the program on controls whose programs have one; `None` takes that of the name.
    pub number: Option<i32>,
    /// Clearance that the probe table adds to the set-up clearance of native cycles, mm.
    pub set_up: f64,
    /// Corrected tools, by the codes of the results.
    pub wear: Vec<(String, Wear)>,
    pub placement: PartPlacement,
    /// Block that the features are cut into; `None` is unknown.
    pub stock: Option<Stock>,
    /// The cycle in the sizes of the actual part; `None` if they are nominal.
    pub actual: Option<Box<dyn Cycle>>,
}

impl PartForm {
    /// `resized`: whether a size differs from nominal; `stated`: whether the job states a difference.
    fn placement(&self, plane: Plane, resized: bool, stated: bool) -> PartPlacement {
        let still = self.offset == Vec3::ZERO && self.rotation == 0.0;
        PartPlacement {
            rigid: Rigid::new(plane, self.offset, self.rotation.to_radians()),
            turn: self.rotation,
            nominal: still && !resized,
            stated: !still || stated,
        }
    }
}

impl Stylus {
    fn shape(&self) -> StylusShape {
        StylusShape {
            length: self.length,
            shank: self.shank,
            body: self.body,
        }
    }
}

impl LimitsForm {
    /// The limits of a job. Without a stated size limit it follows the tolerances of the sizes.
    fn limits(&self, value: &Value, sized: &[Sized]) -> Limits {
        let stated = value.get("limits").and_then(|given| given.get("size"));
        let followed = match stated {
            Some(_) => None,
            None => sized::size_limit(sized, USUAL_SIZE),
        };
        Limits {
            position: self.position,
            size: followed.or(self.size),
            angle: self.angle,
            residual: self.residual,
        }
    }
}

impl MachineForm {
    /// The latency is converted to seconds.
    fn machine(&self) -> Machine {
        Machine {
            acceleration: self.acceleration,
            latency: self.latency / 1000.0,
            deflection: self.deflection,
        }
    }
}

impl FeedForm {
    fn feeds(&self) -> Feeds {
        Feeds {
            approach: self.approach,
            long_link: self.long_link,
            work: self.work,
            retract: self.retract,
            return_: self.return_,
            search: None,
            rapid: None,
        }
    }
}

impl Job {
    /// Sources of uncertainty. A spindle oriented to the angle of calibration includes the eccentricity in the calibration.
    pub fn scatter(&self) -> UncertaintySources {
        UncertaintySources {
            repeatability: self.repeatability,
            runout: self.runout.filter(|_| self.orient.is_none()),
        }
    }

    /// Number of touches of each point.
    pub fn times(&self) -> usize {
        self.repeat
            .as_ref()
            .map_or(1, |repeat| repeat.times as usize)
    }

    /// Reads and checks a job. Reports everything; returns the job only without errors.
    pub fn read(checker: &mut Checker, value: &Value) -> Option<Job> {
        checker.object(Some(value), "")?;
        read_format(checker, value);
        let units = Units::of(value);
        (checker.scale, checker.unit) = (units.scale(), units.word());
        let forms = Forms::read(checker, value);
        let setup = forms.setup();
        let cycle = read_cycle(checker, value);
        if let Some((_, cycle, _)) = &cycle {
            cycle.rules(&setup, checker);
        }
        let post = control::find(&forms.control.post).expect("a checked choice is a post");
        let def = cycle.as_ref().map(|(def, ..)| *def);
        check_control(checker, post, &forms.control, def);
        check_length(checker, post, &forms.length);
        check_name(checker, post, &forms.general.name);
        if let Some((def, _, Some(repeat))) = &cycle {
            check_repeat(checker, value, (def, repeat), (post, &forms.control));
        }
        let sized = match (def, value.get("cycle")) {
            (Some(def), Some(given)) => sized::of(def, given, units.scale()),
            _ => Vec::new(),
        };
        let sizes = read_sizes(checker, value, cycle.as_ref(), (&setup, &sized));
        let cycle = cycle?;
        if checker.failed() {
            return None;
        }
        Some(forms.job(value, (post, setup), cycle, (sized, sizes)))
    }
}

/// The sections of a job around its cycle, checked.
struct Forms {
    general: General,
    stock: Option<StockForm>,
    stylus: Stylus,
    feeds: FeedForm,
    limits: LimitsForm,
    machine: MachineForm,
    control: Control,
    length: Query,
    part: PartForm,
}

impl Forms {
    fn read(checker: &mut Checker, value: &Value) -> Self {
        let mut root = Section::new(checker, Some(value), "");
        root.only(
            General::FIELDS,
            &[
                "format", "stylus", "feeds", "limits", "machine", "cycle", "control", "tool",
                "part", STOCK.key, TOLERANCES,
            ],
        );
        let general = General::read(&mut root);
        let stock = root.sub(&STOCK, StockForm::read);
        Forms {
            stock,
            stylus: read_section(checker, value, "stylus", Stylus::FIELDS, &[], Stylus::read),
            feeds: read_section(
                checker,
                value,
                "feeds",
                FeedForm::FIELDS,
                &[],
                FeedForm::read,
            ),
            limits: read_section(
                checker,
                value,
                "limits",
                LimitsForm::FIELDS,
                &[],
                LimitsForm::read,
            ),
            machine: read_section(
                checker,
                value,
                "machine",
                MachineForm::FIELDS,
                &[],
                MachineForm::read,
            ),
            control: read_section(
                checker,
                value,
                "control",
                Control::FIELDS,
                &[],
                Control::read,
            ),
            length: read_tool(checker, value, &general.plane),
            part: read_section(
                checker,
                value,
                "part",
                PartForm::FIELDS,
                &["sizes"],
                PartForm::read,
            ),
            general,
        }
    }

    /// Plane, ball radius and overtravel.
    fn setup(&self) -> ProbeSettings {
        ProbeSettings {
            plane: Plane::named(&self.general.plane),
            radius: self.stylus.diameter / 2.0,
            overtravel: self.general.overtravel,
        }
    }

    /// The job with this cycle, the sizes that contain a tolerance, and the cycle in the sizes of the actual part.
    fn job(
        self,
        value: &Value,
        (post, setup): (&'static PostDef, ProbeSettings),
        (def, cycle, repeat): Read,
        (sized, actual): (Vec<Sized>, Option<Box<dyn Cycle>>),
    ) -> Job {
        let units = Units::of(value);
        let Forms { control, part, .. } = self;
        Job {
            name: self.general.name,
            scale: units.scale(),
            unit: units.word(),
            repeatability: self.stylus.repeatability,
            shape: self.stylus.shape(),
            runout: self.stylus.runout,
            limits: self.limits.limits(value, &sized),
            machine: self.machine.machine(),
            edition: Edition::named(&self.machine.edition),
            shop: self.machine.frame,
            feeds: self.feeds.feeds(),
            def,
            cycle,
            sized,
            repeat,
            post,
            form: ProgramForm::named(&control.form),
            tool: control.tool,
            header: HeaderDetail::named(&control.header),
            protected: control.protection == Protection::Checked.word(),
            dry: (control.run == DRY_RUN).then_some(control.lift),
            work_offset: control.work_offset,
            orient: control.orient,
            probe_input: control.probe_input as usize,
            report: ResultOutput::named(&control.report),
            ask: Ask::named(&control.ask),
            tool_offsets: ToolOffsets::named(&control.tool_offsets),
            number: control.number,
            set_up: control.set_up,
            wear: wear::of(value.get(TOLERANCES), units.scale()),
            placement: part.placement(setup.plane, actual.is_some(), states_sizes(value)),
            setup,
            stock: self
                .stock
                .map(|StockForm { origin, size }| Stock::new(origin, size)),
            actual,
        }
    }
}

/// Native cycles and extrusion probing do not repeat touches.
fn check_repeat(
    checker: &mut Checker,
    value: &Value,
    (def, repeat): (&CycleDef, &Repeat),
    (post, control): (&PostDef, &Control),
) {
    if repeat.times <= 1 {
        return;
    }
    if ProgramForm::named(&control.form) == ProgramForm::Cycle {
        let message = match (post.supports)(def.probes, ProgramForm::Moves) {
            Ok(()) => text!(
                "Native cycles touch each point as often as the control is set to. Use the form \"moves\", or touch each point once"
            ),
            Err(_) => text!(
                "Native cycles touch each point as often as the control is set to: touch each point once"
            ),
        };
        checker.error("repeat-unsupported", "cycle.repeat", message);
    }
    let extruded = value.get("cycle").and_then(|cycle| cycle.get("extrusion"));
    if matches!(extruded, Some(Value::Map(_))) {
        let message = text!(
            "Extrusion probing touches each point at several heights already: use that or repeated touches, not both"
        );
        checker.error("repeat-unsupported", "cycle.repeat", message);
    }
}

/// Whether a job states a size of its virtual part that differs from nominal.
fn states_sizes(value: &Value) -> bool {
    match value.get("part").and_then(|part| part.get("sizes")) {
        Some(Value::Map(sizes)) => sizes.iter().any(|(_, x)| *x != Value::Number(0.0)),
        _ => false,
    }
}

fn read_section<T>(
    checker: &mut Checker,
    value: &Value,
    path: &str,
    fields: &[Field],
    others: &[&str],
    read: fn(&mut Section<'_, '_>) -> T,
) -> T {
    let mut section = Section::new(checker, value.get(path), path);
    section.only(fields, others);
    read(&mut section)
}

fn read_format(checker: &mut Checker, value: &Value) {
    match value.get("format") {
        Some(Value::Number(n)) if *n == FORMAT => {}
        Some(Value::Number(n)) if *n > FORMAT => {
            checker.error(
                "newer-format",
                "format",
                text!("This job has a newer format than 2: it needs a newer Touchpath"),
            );
        }
        None => checker.error(
            "missing",
            "format",
            text!("The job must specify its format: 1, or 2 with a list of cycles"),
        ),
        Some(_) => checker.error("unknown-value", "format", text!("The format must be 1")),
    }
}

/// Definition of a cycle, its dimensions, and its repetitions.
type Read = (&'static CycleDef, Box<dyn Cycle>, Option<Repeat>);

fn read_cycle(checker: &mut Checker, value: &Value) -> Option<Read> {
    let known = || {
        CYCLES
            .iter()
            .map(|c| format!("\"{}\"", c.key))
            .collect::<Vec<_>>()
            .join(", ")
    };
    let Some(given) = value.get("cycle") else {
        checker.error("missing", "cycle", text!("The job must have a cycle"));
        return None;
    };
    checker.object(Some(given), "cycle")?;
    let Some(key) = given.get("type") else {
        let message = text!("The cycle must specify its type: one of {known}", known());
        checker.error("missing", "cycle.type", message);
        return None;
    };
    let def = cycle::find(checker.text(key, "cycle.type")?);
    let Some(def) = def else {
        checker.error(
            "unknown-value",
            "cycle.type",
            text!("The cycle's type must be one of {known}", known()),
        );
        return None;
    };
    let mut section = Section::new(checker, Some(given), "cycle");
    let own = def.number.map(|_| "custom");
    let touches = def
        .place
        .is_some()
        .then_some("touches")
        .into_iter()
        .chain(own);
    let others: Vec<&str> = std::iter::once("type")
        .chain(def.sections.iter().map(|s| s.key))
        .chain(touches)
        .collect();
    section.only(def.fields, &others);
    let cycle = (def.read)(def, &mut section);
    let repeat = if def.sections.iter().any(|form| form.key == REPEAT.key) {
        section.sub(&REPEAT, Repeat::read)
    } else {
        None
    };
    Some((def, cycle, repeat))
}

fn check_control(checker: &mut Checker, post: &PostDef, control: &Control, def: Option<&CycleDef>) {
    if let Some(def) = def
        && checker.is_clean(&["control.post", "control.form"])
        && let Err(why) = (post.supports)(def.probes, ProgramForm::named(&control.form))
    {
        let other = ProgramForm::named(&control.form).other();
        let (title, form) = (post.title.to_owned(), control.form.clone());
        let message = match (post.supports)(def.probes, other) {
            Ok(()) if other == ProgramForm::Moves => {
                let other = other.word().to_owned();
                text!(
                    "{title} does not support this cycle as \"{form}\": {why}. Use the form \"{other}\"",
                    title,
                    form,
                    why,
                    other
                )
            }
            _ => text!(
                "{title} does not support this cycle as \"{form}\": {why}",
                title,
                form,
                why
            ),
        };
        checker.error("form-unsupported", "control.form", message);
    }
    check_run(checker, post, control, def);
    check_ask(checker, post, control);
    if control.number.is_some() && post.unused.contains(&"number") {
        let message = text!(
            "Programs for {title} have no number: it is ignored",
            post.title.to_owned()
        );
        checker.info("number-unused", "control.number", message);
    }
    check_work_offset(checker, post, control);
}

/// A dry run is a program of moves.
fn check_run(checker: &mut Checker, post: &PostDef, control: &Control, def: Option<&CycleDef>) {
    if control.run == DRY_RUN && ProgramForm::named(&control.form) == ProgramForm::Cycle {
        let message = match def.map_or(Ok(()), |def| {
            (post.supports)(def.probes, ProgramForm::Moves)
        }) {
            Ok(()) => {
                text!(
                    "The native cycle touches automatically: a dry run is a program of moves. Use the form \"moves\""
                )
            }
            Err(_) => text!(
                "The native cycle touches automatically, and {title} supports no moves: there is no dry run",
                post.title.to_owned()
            ),
        };
        checker.error("dry-run-unsupported", "control.run", message);
    }
    if control.run != DRY_RUN && control.lift != 0.0 {
        checker.info(
            "lift-unused",
            "control.lift",
            text!("Only a dry run is raised: this height has no effect"),
        );
    }
}

/// The control has the work offset to write.
fn check_work_offset(checker: &mut Checker, post: &PostDef, control: &Control) {
    if let Some(n) = control.work_offset {
        if let Some(why) = post.why_not(WRITE_OFFSET) {
            checker.error(
                "work-offset-unsupported",
                "control.workOffset",
                post.control_text(why),
            );
        } else if n > post.work_offsets {
            let last = (post.work_offset_word)(post.work_offsets);
            let message = text!(
                "{title} has work offsets 1 (G54) to {work_offsets} ({last})",
                post.title.to_owned(),
                post.work_offsets,
                last
            );
            checker.error("work-offset-unsupported", "control.workOffset", message);
        }
    }
}

/// A program that asks shows its results. Whether one of native cycles writes at all is known when it is planned.
fn check_ask(checker: &mut Checker, post: &PostDef, control: &Control) {
    let ask = Ask::named(&control.ask);
    if ask == Ask::Never || control.work_offset.is_none() {
        return;
    }
    let path = format!("control.{ASK}");
    let native = ProgramForm::named(&control.form) == ProgramForm::Cycle;
    if native && !post.own.is_some_and(|own| own.measures_first) {
        checker.error(
            "ask-unsupported",
            path,
            text!("The native cycle measures and writes in one block: it cannot ask first"),
        );
    } else if !native && ResultOutput::named(&control.report) != ResultOutput::Screen {
        checker.error(
            "ask-unsupported",
            path,
            text!("A program that asks shows its results on the screen: set control.report to \"screen\""),
        );
    }
}

/// The job's `tool` section as a LENTOAX query.
fn read_tool(checker: &mut Checker, value: &Value, plane: &str) -> Query {
    let mut section = Section::new(checker, value.get("tool"), "tool");
    section.only(ToolForm::FIELDS, &["frame"]);
    let form = ToolForm::read(&mut section);
    Query {
        plane: Plane::named(plane),
        tool_type: form.type_,
        frame: read_frame(&mut section),
        coord: "WCS".to_owned(),
        tool_active: true,
        sd42900: form.sd42900,
        sd42940: form.sd42940,
        sd42950: form.sd42950,
    }
}

/// The first length of the probe must act along the tool axis, away from the part, or the control positions the ball elsewhere.
fn check_length(checker: &mut Checker, post: &PostDef, query: &Query) {
    if !post.first_length || !checker.is_clean(&["tool", "plane"]) {
        return;
    }
    let answer = lentoax(query);
    let axis = query.plane.axes()[2];
    if tool_length::frame(&query.frame).0.col(axis)[axis] < -1e-9 {
        let message = text!(
            "The frame mirrors the tool axis {axis} or turns it over: up in the program would be down on the machine",
            AXIS_NAMES[axis]
        );
        checker.error("tool-axis-reversed", "tool.frame", message);
        return;
    }
    if (answer.matrix[2][0] - 1.0).abs() > 1e-9 {
        let message = text!(
            "The probe's length L1 must act along the tool axis of {plane}, +{axes}, or the control computes a wrong ball position. With this tool type, frame and setting data {answer}",
            query.plane.word(),
            AXIS_NAMES[query.plane.axes()[2]],
            sentence(query.plane, &answer)
        );
        checker.error("length-not-along-tool-axis", "tool", message);
    }
}

fn check_name(checker: &mut Checker, post: &PostDef, name: &str) {
    let written = (post.name)(name);
    if written != name {
        let message = if name.starts_with(&written) {
            text!(
                "In the program the name is written \"{written}\": it is too long for a line",
                written
            )
        } else {
            text!(
                "In the program the name is written \"{written}\": some characters could break a comment or a line",
                written
            )
        };
        checker.info("name-changed", "name", message);
    }
}

/// Range of a size difference of the virtual part, as a field.
pub fn size_reach(field: &Field) -> Field {
    match field.kind {
        crate::form::Kind::Angle => Field::angle(field.key, field.label, 0.0).range(-10.0, 10.0),
        _ => Field::length(field.key, field.label, 0.0).range(-100.0, 100.0),
    }
}

/// The cycle in the sizes of the actual part; `None` if all sizes are nominal. A size with a tolerance is at the middle of its tolerance unless `part.sizes`
/// states it.
fn read_sizes(
    checker: &mut Checker,
    value: &Value,
    cycle: Option<&Read>,
    (setup, sized): (&ProbeSettings, &[Sized]),
) -> Option<Box<dyn Cycle>> {
    let (def, cycle, _) = cycle?;
    let given = value.get("part").and_then(|part| part.get("sizes"));
    checker.object(given, "part.sizes")?;
    let fields: Vec<Field> = def.fields.iter().filter(|f| f.size).copied().collect();
    Section::new(checker, given, "part.sizes").only(&fields, &[]);
    let mut actual: Option<Box<dyn Cycle>> = None;
    for field in &fields {
        let path = format!("part.sizes.{}", field.key);
        let delta = match given.and_then(|given| given.get(field.key)) {
            Some(delta) => {
                Section::new(checker, None, "part.sizes").number(delta, &size_reach(field), &path)
            }
            None => sized
                .iter()
                .find(|one| one.field.key == field.key)
                .map(Sized::middle),
        };
        // The sizes of a cycle with errors cannot be changed.
        let Some(delta) = delta.filter(|delta| *delta != 0.0 && checker.is_clean(&["cycle"]))
        else {
            continue;
        };
        match actual
            .as_deref()
            .unwrap_or(&**cycle)
            .resized(setup, field.key, delta)
        {
            Some(resized) => actual = Some(resized),
            None => checker.error(
                "out-of-range",
                path,
                text!("Nothing would be left of {label}", field.label),
            ),
        }
    }
    actual
}
