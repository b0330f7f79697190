//! The ISO of a HEIDENHAIN: `%NAME G71 *` begins it, each block ends in `*`, and many codes mean something else than in other ISO.

use crate::geom::Plane;
use crate::import::toolpath::block::{Block, Foreign, Motion};
use crate::import::toolpath::count::count;
use crate::import::toolpath::reader::Reader;

impl Reader {
    /// `%NAME G71 *`: the units of what follows.
    #[cold]
    #[inline(never)]
    pub(super) fn heidenhain_head(&mut self, line: &[u8]) {
        let says =
            |code: &[u8]| line.split(|b| b.is_ascii_whitespace() || *b == b'*').any(|word| word.eq_ignore_ascii_case(code));
        self.begun = true;
        if says(b"G70") || says(b"G71") {
            self.heidenhain = true;
            self.units(says(b"G71"));
        }
    }

    /// What a G code does there, by ten times its number.
    #[cold]
    #[inline(never)]
    pub(super) fn heidenhain_code(&mut self, tenths: i32, block: &mut Block) -> Foreign {
        match tenths {
            0 => self.go(Motion::Rapid, block),
            10 | 70 => self.go(Motion::Straight, block),
            20 => self.go(Motion::Clockwise, block),
            30 => self.go(Motion::Counter, block),
            // Circles without a direction, or tangent to what is before them.
            50 | 60 => self.go(Motion::Curve, block),
            40 => (block.dwells, block.feedless) = (true, true),
            170 => self.turn(Plane::G17),
            180 => self.turn(Plane::G18),
            190 => self.turn(Plane::G19),
            400 => {}
            410 | 420 | 430 | 440 => count(&mut self.transformed, self.line),
            700 | 710 => self.units(tenths == 710),
            900 => self.modes.absolute = true,
            910 => self.modes.absolute = false,
            // Corners, the pole, the blank, the next tool, labels, tools.
            240 | 250 | 260 | 270 | 290 | 300 | 310 | 500 | 510 | 980 | 990 => block.elsewhere = true,
            // Mirror, datums, scale, rotation, tilted plane.
            280 | 530 | 540 | 720 | 730 | 800 => {
                block.elsewhere = true;
                count(&mut self.transformed, self.line);
            }
            _ => return Foreign::Unknown,
        }
        Foreign::No
    }
}
