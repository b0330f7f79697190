//! Corrections of tools by a program of moves: after several parts the mean error of a size or a height changes the wear of a tool.
//!
//! Two variables of the control keep the number and the sum of the errors. A result beyond its limit stops the program before it stores anything. Ours, and marked [I] in the docs: the sequence, the mean of at least two parts, the check of the two variables.
//!
//! Sources: registers of Haas and SINUMERIK from posts and the macros' texts [S]; those of Fanuc from one site [S]. Signs as the macros have them [S].

use crate::control::iso::script::{Part, ToolRegister};
use crate::control::{ProgramForm, Request};
use crate::formula::{CheckKind, Limits, ResultCheck, ResultDef, Wear};
use crate::num::decimal;
use crate::text::words;

/// What the tool offsets of a control hold, as its settings have it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ToolOffsets {
    Unknown,
    Radius,
    Diameter,
    /// One value per offset, without separate wear: memory A of a Fanuc.
    RadiusInMemoryA,
    DiameterInMemoryA,
}

impl ToolOffsets {
    pub const ALL: [ToolOffsets; 5] = [
        ToolOffsets::Unknown,
        ToolOffsets::Radius,
        ToolOffsets::Diameter,
        ToolOffsets::RadiusInMemoryA,
        ToolOffsets::DiameterInMemoryA,
    ];

    /// `control.toolOffsets` in the job.
    pub const fn word(self) -> &'static str {
        match self {
            ToolOffsets::Unknown => "unknown",
            ToolOffsets::Radius => "radius",
            ToolOffsets::Diameter => "diameter",
            ToolOffsets::RadiusInMemoryA => "memory-a-radius",
            ToolOffsets::DiameterInMemoryA => "memory-a-diameter",
        }
    }

    /// The setting with this word; `Unknown` for any other word.
    pub fn named(word: &str) -> ToolOffsets {
        let known = ToolOffsets::ALL.into_iter().find(|own| own.word() == word);
        known.unwrap_or(ToolOffsets::Unknown)
    }

    fn by_diameter(self) -> bool {
        matches!(self, ToolOffsets::Diameter | ToolOffsets::DiameterInMemoryA)
    }
}

/// Registers of the tools of a control.
#[derive(Clone, Copy, Debug)]
pub struct ToolTable {
    /// Tables of the wear of lengths and of radii, and the highest number of a tool; `None` if the settings do not tell them.
    pub tables: fn(ToolOffsets) -> Option<[i32; 3]>,
    /// Name of a register.
    pub register: fn(ToolRegister) -> String,
    /// Name of a variable that keeps its value.
    pub kept: fn(i32) -> String,
    /// First and last number of these variables.
    pub keeps: (i32, i32),
}

/// One correction of a tool.
#[derive(Clone, Debug)]
pub struct ToolCorrection {
    /// Check of the result against its nominal value, with the largest error that counts.
    pub check: ResultCheck,
    pub wear: Wear,
    pub register: ToolRegister,
    /// Name of the register.
    pub name: String,
    /// Variables that keep number and sum of the errors.
    pub kept: [String; 2],
    /// Number of the first of these variables.
    pub store: i32,
    /// Number of parts in the mean.
    pub parts: i32,
    /// Change of the register for a mean error of 1.
    pub factor: f64,
    /// Contents of the register: `radius wear`.
    pub about: &'static str,
}

impl ToolCorrection {
    pub fn part(&self) -> Part {
        Part::Tool(self.register)
    }

    /// Comment above its blocks.
    pub fn note(&self) -> String {
        let [count, sum] = &self.kept;
        format!(
            "Tool {}, {}: {} % of the mean error of {} parts. {count} is their number, {sum} the sum: set both to 0 for a new series",
            self.wear.tool,
            self.about,
            decimal(100.0 * self.wear.share, 0),
            self.parts,
        )
    }
}

impl Request<'_> {
    /// Whether the program itself corrects a tool.
    pub fn corrects_tools(&self) -> bool {
        self.form == ProgramForm::Moves && self.dry.is_none() && self.path.formula.corrects_tools()
    }

    /// Whether the program itself writes a work offset or a tool.
    pub fn writes_tables(&self) -> bool {
        self.writes_offset() || self.corrects_tools()
    }

    /// What the operator decides if the program asks.
    pub fn asks_what(&self) -> &'static str {
        match (self.writes_offset(), self.corrects_tools()) {
            (_, false) => "Cycle start writes the work offset. Reset leaves it unchanged",
            (false, true) => "Cycle start corrects the tool. Reset leaves it unchanged",
            (true, true) => {
                "Cycle start writes the work offset and corrects the tool. Reset leaves both unchanged"
            }
        }
    }

    /// Tools that the program itself corrects.
    pub fn corrections(&self) -> Vec<ToolCorrection> {
        match self.post.tools.filter(|_| self.corrects_tools()) {
            Some(table) => self.corrections_of(table),
            None => Vec::new(),
        }
    }

    #[inline(never)]
    fn corrections_of(&self, table: &ToolTable) -> Vec<ToolCorrection> {
        let settings = (table, self.tool_offsets, &self.limits);
        let results = self.path.formula.results.iter().enumerate();
        results
            .filter_map(|own| correction(settings, own))
            .collect()
    }
}

/// Registers and settings of a control, and the limits of a job.
pub type CorrectionSettings<'a> = (&'a ToolTable, ToolOffsets, &'a Limits);

/// Correction of a tool by a result, if it has one.
#[inline(never)]
pub fn correction(
    (table, offsets, limits): CorrectionSettings<'_>,
    (result, def): (usize, &ResultDef),
) -> Option<ToolCorrection> {
    let wear = def.tolerance?.wear?;
    let (parts, store) = wear.mean?;
    let height = wear.length;
    let limit = if height { limits.position } else { limits.size };
    let [lengths, radii, _] = (table.tables)(offsets)?;
    let by_diameter = offsets.by_diameter() && !height;
    let register = ToolRegister {
        table: if height { lengths } else { radii },
        tool: wear.tool,
    };
    Some(ToolCorrection {
        check: ResultCheck {
            asked: CheckKind::Plausibility,
            result,
            variable: def.variable?,
            expected: def.nominal,
            limit: limit?,
            angle: false,
        },
        wear,
        register,
        name: (table.register)(register),
        kept: [store, store + 1].map(table.kept),
        store,
        parts,
        factor: wear.share * wear.sense * if by_diameter { 2.0 } else { 1.0 },
        about: match (height, by_diameter) {
            (true, _) => words!("length wear"),
            (false, true) => words!("diameter wear"),
            (false, false) => words!("radius wear"),
        },
    })
}

/// Notation of the blocks of a correction.
pub(super) struct Blocks<'a> {
    /// Brackets of an operand, and the signs for at most and greater than.
    pub brackets: (char, char),
    pub compares: [&'a str; 2],
    /// A jump under a condition.
    pub jump: &'a dyn Fn(&str, &str) -> String,
    /// A new label.
    pub label: &'a mut dyn FnMut() -> String,
    /// Block with a label.
    pub target: &'a dyn Fn(&str) -> String,
    /// A constant.
    pub number: &'a dyn Fn(f64) -> String,
}

impl Blocks<'_> {
    /// Blocks that give three variables the new number and sum of the errors, and the change of the register. `off` is the error of the result. If the program
    /// cannot have stored the kept values, it continues at `other`.
    #[inline(never)]
    pub fn lines(
        &mut self,
        correction: &ToolCorrection,
        (off, scale): (&str, f64),
        [count, sum, change]: [&str; 3],
        other: &str,
    ) -> Vec<String> {
        let [kept, kept_sum] = &correction.kept;
        let [at_most, greater] = self.compares;
        let (open, close) = self.brackets;
        let abs = |value: &str| format!("ABS{open}{value}{close}");
        let [parts, fewer] = [0, 1].map(|less| (correction.parts - less).to_string());
        let limit = (self.number)(correction.check.limit / scale);
        let band = correction.wear.dead_band / scale;
        let sum_of_limits = format!("{kept}*{limit}+{}", (self.number)(ROUNDED));
        let keep = (self.label)();
        let mut lines = vec![
            format!("{count}={kept}+1"),
            format!("{sum}={kept_sum}+{off}"),
            (self.jump)(&format!("{}{greater}{sum_of_limits}", abs(kept_sum)), other),
            (self.jump)(&format!("{kept}{greater}{fewer}"), other),
            format!("{change}=0"),
            (self.jump)(&format!("{count}{at_most}{fewer}"), &keep),
            format!("{change}={sum}/{parts}"),
            format!("{count}=0"),
            format!("{sum}=0"),
        ];
        if band > 0.0 {
            let beyond = (self.label)();
            lines.push((self.jump)(
                &format!("{}{greater}{}", abs(change), (self.number)(band)),
                &beyond,
            ));
            lines.push(format!("{change}=0"));
            lines.push((self.target)(&beyond));
        }
        let factor = (self.number)(correction.factor);
        lines.push(match factor.starts_with('-') {
            true => format!("{change}={change}*{open}{factor}{close}"),
            false => format!("{change}={change}*{factor}"),
        });
        lines.push((self.target)(&keep));
        lines
    }
}

/// Allowance for the rounding of a sum, in units of the program.
const ROUNDED: f64 = 0.0001;
