//! How often something was passed over, and where first.

/// Something that is said once, with how often and where first.
#[derive(Clone, Copy, Default)]
pub(super) struct Count {
    pub times: usize,
    pub first: usize,
}

/// Counts it once more.
pub(super) fn count(count: &mut Count, line: usize) {
    if count.times == 0 {
        count.first = line;
    }
    count.times += 1;
}
