//! Allocation of numbered variables on controls without named ones.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use crate::formula::{CheckKind, Formula, Node, ResultCheck};
use crate::path::Path;

/// Allocation of variables, counted from 1: first the results in order, then the triggers, then intermediate values, each as long as it is needed.
#[derive(Debug)]
pub struct Registers {
    /// Variable of each assignment.
    pub variables: Vec<usize>,
    triggers: Vec<((usize, usize), usize)>,
    /// Values with several results, and the further registers that they are copied to.
    pub copies: Vec<(usize, usize)>,
    results: usize,
    /// Highest number in use.
    pub last: usize,
}

/// Time at which a program computes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ComputeTiming {
    /// After the last move.
    AtTheEnd,
    /// As soon as the necessary touches are made, so that their triggers are not kept longer.
    AtOnce,
}

/// Number of touches that must be made before each assignment can be computed, never fewer than for the previous one.
pub fn needed_touches(path: &Path) -> Vec<usize> {
    let formula = &path.formula;
    // For each sample, the number of touches made up to its last one.
    let mut made = vec![0; samples(path)];
    for (n, (k, ..)) in path.searches().enumerate() {
        made[path.touches[k].sample] = n + 1;
    }
    let mut needed = 0;
    let each = formula.assignments.iter().map(|assignment| {
        // An earlier assignment needs no more than `needed`.
        formula.each(assignment.node, &mut |node| {
            if let Node::Trigger { sample, .. } = node {
                needed = needed.max(made[usize::from(sample)]);
            }
        });
        needed
    });
    each.collect()
}

/// Number of samples in its formula.
fn samples(path: &Path) -> usize {
    path.touches
        .iter()
        .map(|touch| touch.sample + 1)
        .max()
        .unwrap_or(0)
}

/// Used until the end of the program.
const TO_THE_END: usize = usize::MAX;

/// Last use of each value of a formula.
struct LastUses {
    /// For each assignment, the last assignment that reads it, or its own index if nothing reads it.
    variables: Vec<usize>,
    /// For each coordinate of each sample, the last assignment that reads it. `None` if nothing reads it.
    triggers: Vec<[Option<usize>; 3]>,
}

impl LastUses {
    fn of(path: &Path) -> Self {
        let formula = &path.formula;
        let triggers = vec![[None; 3]; samples(path)];
        let mut reads = LastUses {
            variables: (0..formula.assignments.len()).collect(),
            triggers,
        };
        for (i, assignment) in formula.assignments.iter().enumerate() {
            formula.each(assignment.node, &mut |node| match node {
                Node::Variable(variable) => reads.variables[variable.index()] = i,
                Node::Trigger { sample, axis } => {
                    reads.triggers[usize::from(sample)][usize::from(axis)] = Some(i)
                }
                _ => {}
            });
        }
        // Values that moves or the datum read are kept to the end.
        let moves = path
            .cycles
            .iter()
            .flat_map(|member| member.placing.shift_variables());
        moves.for_each(|variable| reads.variables[variable.index()] = TO_THE_END);
        if let Some(datum) = &formula.datum {
            let measured = datum
                .place
                .iter()
                .flatten()
                .filter_map(|place| place.measured);
            measured
                .chain(datum.rotation)
                .for_each(|variable| reads.variables[variable.index()] = TO_THE_END);
        }
        if let Some((turn, _)) = formula.turn {
            reads.variables[turn.index()] = TO_THE_END;
        }
        reads
    }
}

/// Registers that become free after each assignment, as chains: 0 ends a chain.
struct FreeLists {
    /// First register of the chain of each assignment.
    first: Vec<usize>,
    /// Next register of the chain. A register is in one chain at a time.
    next: Vec<usize>,
}

impl FreeLists {
    /// Marks a register as free after this assignment; an assignment that does not exist keeps it.
    fn after(&mut self, assignment: usize, register: usize) {
        if self.next.len() <= register {
            self.next.resize(register + 1, 0);
        }
        if let Some(first) = self.first.get_mut(assignment) {
            self.next[register] = std::mem::replace(first, register);
        }
    }
}

impl Registers {
    /// Allocates a register for every value of the plain formula of a path.
    pub fn allocate(path: &Path, when: ComputeTiming) -> Self {
        let formula = &path.formula;
        let mut registers = Registers::of_results(formula);
        let reads = LastUses::of(path);
        // After its last use a register becomes free, the lowest first; results are kept.
        let mut spent = FreeLists {
            first: vec![0; formula.assignments.len()],
            next: Vec::new(),
        };
        let mut free: BinaryHeap<Reverse<usize>> = BinaryHeap::new();
        let (needed, samples) = (needed_touches(path), path.samples());
        let mut next = 0;
        for (n, (k, ..)) in path.searches().enumerate() {
            let sample = &samples[k];
            for axis in (0..3).filter(|_| sample.first) {
                let Some(last) = reads.triggers[sample.index][axis] else {
                    continue;
                };
                let register = registers.take(&mut free);
                registers.triggers.push(((sample.index, axis), register));
                spent.after(last, register);
            }
            while when == ComputeTiming::AtOnce
                && needed.get(next).is_some_and(|needed| *needed <= n + 1)
            {
                registers.assign(next, &reads, &mut spent, &mut free);
                next += 1;
            }
        }
        (next..formula.assignments.len())
            .for_each(|i| registers.assign(i, &reads, &mut spent, &mut free));
        registers
    }

    /// The lowest free register, or a new one.
    fn take(&mut self, free: &mut BinaryHeap<Reverse<usize>>) -> usize {
        match free.pop() {
            Some(Reverse(lowest)) => lowest,
            None => {
                self.last += 1;
                self.last
            }
        }
    }

    /// Allocates the register of an assignment, and frees those that it is the last to use.
    fn assign(
        &mut self,
        i: usize,
        reads: &LastUses,
        spent: &mut FreeLists,
        free: &mut BinaryHeap<Reverse<usize>>,
    ) {
        if self.variables[i] == 0 {
            self.variables[i] = self.take(free);
        }
        if self.variables[i] > self.results {
            spent.after(reads.variables[i], self.variables[i]);
        }
        let mut register = spent.first[i];
        while register > 0 {
            free.push(Reverse(register));
            register = spent.next[register];
        }
    }

    /// Results get the first registers in order; a value with several results is copied.
    fn of_results(formula: &Formula) -> Self {
        let mut variables = vec![0; formula.assignments.len()];
        let mut copies = Vec::new();
        let mut last = 0;
        for variable in formula.results.iter().filter_map(|r| r.variable) {
            last += 1;
            let index = variable.index();
            if variables[index] == 0 {
                variables[index] = last
            } else {
                copies.push((last, index))
            }
        }
        Registers {
            variables,
            triggers: Vec::new(),
            copies,
            results: last,
            last,
        }
    }

    /// Register of coordinate `axis` of a sample's trigger.
    pub fn trigger(&self, sample: usize, axis: usize) -> usize {
        self.triggers
            .iter()
            .find(|(key, _)| *key == (sample, axis))
            .map_or(0, |(_, register)| *register)
    }

    /// Register of a checked result: results have the first ones, in order, after their copies are made. Before a cycle that follows it there are none.
    pub fn checked(&self, formula: &Formula, check: &ResultCheck) -> usize {
        if check.asked == CheckKind::FollowLimit {
            return self.variables[check.variable.index()];
        }
        let results = &formula.results[..=check.result];
        results
            .iter()
            .filter(|result| result.variable.is_some())
            .count()
    }

    /// List of the registers for the header, in lines of at most `width`. The write of the frame needs `more` registers. `name` is the notation of a register.
    pub fn lines(
        &self,
        formula: &Formula,
        more: usize,
        width: usize,
        name: fn(usize) -> String,
    ) -> Vec<String> {
        const HEAD: &str = "Results: ";
        let mut lines: Vec<String> = Vec::new();
        let codes = formula
            .results
            .iter()
            .filter(|r| r.variable.is_some())
            .map(|r| formula.code(r));
        for (i, code) in codes.enumerate() {
            let entry = format!("{} = {code}", name(i + 1));
            match lines
                .last_mut()
                .filter(|line| line.len() + 2 + entry.len() <= width)
            {
                Some(line) => {
                    line.push_str(", ");
                    line.push_str(&entry);
                }
                None => lines.push(format!("{HEAD}{entry}")),
            }
        }
        let last = self.last + more;
        if last > self.results {
            lines.push(format!(
                "Used on the way: {} to {}",
                name(self.results + 1),
                name(last)
            ));
        }
        lines
    }
}
