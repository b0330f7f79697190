//! HEIDENHAIN's ISO: `%NAME G71 *` begins a program, each block ends in `*`, and many codes have another meaning than in other ISO dialects.

use crate::import::toolpath::reader::Reader;

impl Reader {
    /// `%NAME G71 *`: units of the program.
    #[cold]
    #[inline(never)]
    pub(super) fn heidenhain_head(&mut self, line: &[u8]) {
        let says = |code: &[u8]| {
            line.split(|b| b.is_ascii_whitespace() || *b == b'*')
                .any(|word| word.eq_ignore_ascii_case(code))
        };
        self.has_code = true;
        if says(b"G70") || says(b"G71") {
            self.heidenhain = true;
            self.units(says(b"G71"));
        }
    }
}
