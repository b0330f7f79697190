//! Reports ignored parts of a program, each kind once with its count.

use crate::form::Checker;
use crate::import::toolpath::Toolpath;
use crate::import::toolpath::count::Count;
use crate::import::toolpath::foreign::by_name;
use crate::import::toolpath::reader::Reader;
use crate::text::{Text, text};

impl Reader {
    /// The path, with ignored parts as its findings.
    pub fn finish(mut self) -> Toolpath {
        let mut checker = Checker::default();
        let mut lines = Vec::new();
        // Reasons that stop the control come first.
        for (count, code) in [
            (&mut self.missed, "touch-missed"),
            (&mut self.divisions, "division-by-zero"),
        ] {
            let count = std::mem::take(count);
            let Some(first) = count.lines.first() else {
                continue;
            };
            let line = numbered(&self.files, *first);
            let message = if code == "touch-missed" {
                text!(
                    "The touch in line {line} has no contact: the control stops there with an alarm",
                    line
                )
            } else {
                text!(
                    "Line {line} divides by zero: the control stops there with an alarm",
                    line
                )
            };
            checker.warning(code, "", message);
            lines.push(count.sorted());
        }
        for (count, code, what) in self.counted() {
            let Some(first) = count.lines.first().map(|line| numbered(&self.files, *line)) else {
                continue;
            };
            let message = if count.times == 1 {
                text!("{what}: once, in line {line}", what, first)
            } else {
                text!(
                    "{what}: {times} times, the first in line {line}",
                    what,
                    count.times,
                    first
                )
            };
            checker.warning(code, "", message);
            lines.push(count.sorted());
        }
        say_units(self.late_units, &self.path, &mut checker);
        self.path.findings = checker.findings();
        lines.resize_with(self.path.findings.len(), Vec::new);
        if let (Some(line), Some(last)) = (self.late_units, lines.last_mut()) {
            last.push(line as u32);
        }
        self.path.finding_lines = lines;
        self.path.plane = self.plane.unwrap_or_default();
        self.path
    }

    /// Ignored parts, in the order of the report.
    fn counted(&mut self) -> Vec<(Count, &'static str, Text)> {
        let take = std::mem::take::<Count>;
        let [rapids, moves] = std::mem::take(&mut self.collisions);
        let mut all = vec![
            (rapids, "collision", text!("Rapids run into the part")),
            (
                moves,
                "collision",
                text!("Moves that do not probe run into the part"),
            ),
        ];
        all.extend(
            std::mem::take(&mut self.skipped)
                .into_counts()
                .map(|(count, why)| (count, "lines-skipped", why)),
        );
        all.extend(std::mem::take(&mut self.foreign).into_iter().map(|named| {
            let message = by_name(&named);
            (named.count, "lines-skipped", message)
        }));
        all.extend([
            (take(&mut self.after_end), "lines-skipped", text!("Lines below the end of the program, M2, M30, M99 or %, are not followed")),
            (take(&mut self.computed), "places-computed", text!(
                "Positions that the control computes, or along a tool whose length was changed, are unknown until the program gives a number"
            )),
            (take(&mut self.machine), "machine-places", text!("Positions in machine coordinates are unknown in work coordinates")),
            (take(&mut self.transformed), "places-transformed", text!(
                "The coordinate system is unknown from here on, or the tool radius is compensated: positions are shown as written, and those of different systems may not match"
            )),
            (take(&mut self.from_unknown), "start-unknown", text!("Incremental moves start from an unknown position: 0 is assumed")),
            (take(&mut self.arcs_unsolved), "arc-unsolved", text!("Splines are shown straight, and so are arcs with an unknown centre or start or with an end off the circle")),
            (take(&mut self.others), "lines-skipped", text!("Axes other than X, Y and Z are not followed")),
            (take(&mut self.optional), "lines-optional", text!("Optional blocks (/) are read here; the control omits them while block skip is on")),
            (take(&mut self.branches), "branch-ends", text!("Branches with an unknown condition end the program: the run continues as if they were not taken")),
            (take(&mut self.aborted), "program-stops", text!("The program stops itself with a message")),
            (take(&mut self.own_moves), "own-moves", text!("The moves of these macros are those of one edition: feeds, and the way back between their two touches, are settings of an installation")),
            (take(&mut self.own_cycles), "own-moves", text!("The moves of these cycles are documented. SET_UP of the touch probe table is assumed to be 0, and the overtravel of a touch 10 mm")),
            (take(&mut self.measuring_cycles), "own-moves", text!("The moves of these measuring cycles follow a manual and generators; the paths between the touches are our interpretation")),
            (take(&mut self.stopped), "macro-stops", text!("A native macro stops the program with an alarm: it has no contact where it needs one, or a contact elsewhere")),
            (take(&mut self.probe_words), "probe-word", text!("P in a probing block writes the work offset on a FluidNC; other controls refuse it or read it as something else: choose the control")),
            (take(&mut self.twice), "words-twice", text!("A block has two motions, or one axis twice: the last one is used")),
        ]);
        all
    }
}

/// Number of a line, with its file if that is not the program.
fn numbered(files: &[(u32, String)], line: u32) -> String {
    let file = files.partition_point(|(first, _)| *first <= line);
    match file.checked_sub(1).map(|file| &files[file]) {
        Some((first, name)) => format!("{} ({name})", line - first + 1),
        None => (line + 1).to_string(),
    }
}

fn say_units(late: Option<usize>, path: &Toolpath, checker: &mut Checker) {
    if let Some(line) = late {
        let message = text!(
            "Moves above line {line} are read in its units, because the text states none before",
            line + 1
        );
        checker.warning("no-units", "", message);
    }
    if path.metric.is_none() && !path.is_empty() {
        checker.info(
            "no-units",
            "",
            text!("The program does not state its units"),
        );
    }
}
