//! Big integers for exact conversion of decimals.

/// A big integer, its lowest 32 bits first.
pub struct Whole(Vec<u32>);

impl Whole {
    pub const ZERO: Whole = Whole(Vec::new());

    /// A number times a power of two.
    pub fn of(number: u64, power: usize) -> Self {
        let mut whole = Whole(vec![number as u32, (number >> 32) as u32]);
        (0..power / 16).for_each(|_| whole.times_and(1 << 16, 0));
        whole.times_and(1 << (power % 16), 0);
        whole.tidied()
    }

    /// Removes leading zeros.
    fn tidied(mut self) -> Self {
        while self.0.last() == Some(&0) {
            self.0.pop();
        }
        self
    }

    /// The integer without its lowest bits, rounded to the nearest, ties to even.
    pub fn without(mut self, bits: usize) -> Self {
        let at = bits as i64;
        let up = self.bit(at - 1) && (self.bit(at) || self.bits_above(at - 1).1);
        self.0.drain(..(bits / 32).min(self.0.len()));
        self.divide(1 << (bits % 32));
        if up {
            self.times_and(1, 1);
        }
        self.tidied()
    }

    /// Decimal digits; empty for zero.
    pub fn digits(mut self) -> String {
        let mut digits = Vec::new();
        while !self.0.is_empty() {
            digits.push(b'0' + self.divide(10) as u8);
        }
        digits.into_iter().rev().map(char::from).collect()
    }

    /// Multiplies by a factor and adds a carry.
    pub fn times_and(&mut self, factor: u32, mut carry: u32) {
        for part in &mut self.0 {
            let product = u64::from(*part) * u64::from(factor) + u64::from(carry);
            (*part, carry) = (product as u32, (product >> 32) as u32);
        }
        if carry > 0 {
            self.0.push(carry);
        }
    }

    /// Divides and returns the remainder.
    pub fn divide(&mut self, divisor: u32) -> u32 {
        let mut rest = 0u64;
        for part in self.0.iter_mut().rev() {
            let whole = rest << 32 | u64::from(*part);
            (*part, rest) = (
                (whole / u64::from(divisor)) as u32,
                whole % u64::from(divisor),
            );
        }
        while self.0.last() == Some(&0) {
            self.0.pop();
        }
        rest as u32
    }

    /// Shifts up by whole parts of 32 bits.
    pub fn shift(&mut self, parts: usize) {
        self.0.splice(0..0, std::iter::repeat_n(0, parts));
    }

    /// Number of bits.
    pub fn bits(&self) -> i64 {
        self.0.last().map_or(0, |last| {
            self.0.len() as i64 * 32 - i64::from(last.leading_zeros())
        })
    }

    pub fn bit(&self, at: i64) -> bool {
        usize::try_from(at).is_ok_and(|at| {
            self.0
                .get(at / 32)
                .is_some_and(|part| part >> (at % 32) & 1 == 1)
        })
    }

    /// Bits from `low` up, and whether any bit below is set.
    pub fn bits_above(&self, low: i64) -> (u64, bool) {
        let top = (low..self.bits())
            .rev()
            .fold(0, |sum, at| sum << 1 | u64::from(self.bit(at)));
        (top, (0..low.min(self.bits())).any(|at| self.bit(at)))
    }
}
