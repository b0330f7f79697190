//! How often something was passed over, and where.

/// Something that is said once, with how often and where.
#[derive(Clone, Default)]
pub(super) struct Count {
    pub times: usize,
    /// Its lines; a line that repeats immediately is listed once.
    pub lines: Vec<u32>,
}

impl Count {
    /// Its lines in their order, each once.
    pub fn sorted(mut self) -> Vec<u32> {
        self.lines.sort_unstable();
        self.lines.dedup();
        self.lines
    }
}

/// Counts it once more.
pub(super) fn count(count: &mut Count, line: usize) {
    count.times += 1;
    let line = line as u32;
    if count.lines.last() != Some(&line) {
        count.lines.push(line);
    }
}
