//! Variable values with an undo log: rewinding costs one step per write since then.

/// Values of variables, by their slots.
#[derive(Clone, Debug, Default)]
pub struct VariableStore {
    now: Vec<f64>,
    /// Slot and previous value of each write.
    replaced: Vec<(u32, f64)>,
}

/// A position in the log of writes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd)]
pub struct WriteMark(usize);

/// Undone writes, to be redone.
#[derive(Debug)]
pub struct Redo(Vec<(u32, f64)>);

impl VariableStore {
    pub fn of(values: Vec<f64>) -> Self {
        VariableStore {
            now: values,
            replaced: Vec::new(),
        }
    }

    pub fn get(&self, slot: usize) -> f64 {
        self.now[slot]
    }

    pub fn set(&mut self, slot: usize, value: f64) {
        let before = std::mem::replace(&mut self.now[slot], value);
        self.replaced.push((slot as u32, before));
    }

    pub fn mark(&self) -> WriteMark {
        WriteMark(self.replaced.len())
    }

    /// Undoes all writes since a mark.
    pub fn back(&mut self, to: WriteMark) {
        for (slot, before) in self.replaced.drain(to.0..).rev() {
            self.now[slot as usize] = before;
        }
    }

    /// Undoes all writes since a mark, and returns them for [`Self::redo`].
    pub fn undo(&mut self, to: WriteMark) -> Redo {
        let now = &mut self.now;
        let undone = self.replaced.drain(to.0..).rev();
        Redo(
            undone
                .map(|(slot, before)| (slot, std::mem::replace(&mut now[slot as usize], before)))
                .collect(),
        )
    }

    /// Redoes undone writes: marks among them are valid again.
    pub fn redo(&mut self, Redo(undone): Redo) {
        undone
            .into_iter()
            .rev()
            .for_each(|(slot, value)| self.set(slot as usize, value));
    }

    /// Values at a mark.
    pub fn at(&mut self, mark: WriteMark) -> Vec<f64> {
        let redo = self.undo(mark);
        let values = self.now.clone();
        self.redo(redo);
        values
    }

    /// Current values.
    pub fn values(&self) -> &[f64] {
        &self.now
    }
}

#[cfg(test)]
mod tests {
    use super::VariableStore;

    #[test]
    fn writes_are_taken_back_and_made_again() {
        let mut slots = VariableStore::of(vec![1.0, 2.0]);
        let begin = slots.mark();
        slots.set(0, 5.0);
        let middle = slots.mark();
        slots.set(0, 6.0);
        slots.set(1, 7.0);
        assert_eq!(slots.at(middle), [5.0, 2.0]);
        assert_eq!(slots.values(), [6.0, 7.0]);
        let redo = slots.undo(begin);
        assert_eq!(slots.values(), [1.0, 2.0]);
        slots.set(1, 9.0);
        slots.back(begin);
        slots.redo(redo);
        assert_eq!(slots.values(), [6.0, 7.0]);
        slots.back(middle);
        assert_eq!(slots.values(), [5.0, 2.0]);
    }
}
