//! Counts ignored lines.

/// A fact that is reported once, with count and lines.
#[derive(Clone, Default)]
pub(super) struct Count {
    pub times: usize,
    /// Its lines; a line that repeats immediately is listed once.
    pub lines: Vec<u32>,
}

impl Count {
    /// Its lines in order, each once.
    pub fn sorted(mut self) -> Vec<u32> {
        self.lines.sort_unstable();
        self.lines.dedup();
        self.lines
    }
}

/// Counts one more occurrence.
pub(super) fn count(count: &mut Count, line: usize) {
    count.times += 1;
    let line = line as u32;
    if count.lines.last() != Some(&line) {
        count.lines.push(line);
    }
}
