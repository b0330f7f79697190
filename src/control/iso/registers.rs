//! Which numbered variable holds what, on controls that have no named ones.

use crate::formula::{Expr, Formula};

/// Which variable holds what, counted from 1: results first, in their order; then the triggers; then what is needed on the way, each
/// as long as it is needed.
#[derive(Debug)]
pub struct Registers {
    /// Of each assignment.
    pub variables: Vec<usize>,
    triggers: Vec<((usize, usize), usize)>,
    /// A value that is more than one result, and the further registers it goes to.
    pub copies: Vec<(usize, usize)>,
    results: usize,
    /// The highest one.
    pub last: usize,
}

impl Registers {
    /// Gives every value of a plain formula its place.
    pub fn allocate(formula: &Formula) -> Self {
        const NEVER: usize = usize::MAX;
        let count = formula.assignments.len();
        let mut variables = vec![0; count];
        let mut copies = Vec::new();
        let mut last = 0;
        for variable in formula.results.iter().filter_map(|r| r.variable) {
            last += 1;
            if variables[variable] == 0 { variables[variable] = last } else { copies.push((last, variable)) }
        }
        let results = last;
        // Where each value is read last; what the datum reads, or what is a result, is kept to the end.
        let mut read_last = vec![0; count];
        let mut triggers: Vec<((usize, usize), usize)> = Vec::new();
        let mut triggers_read: Vec<usize> = Vec::new();
        for (i, assignment) in formula.assignments.iter().enumerate() {
            assignment.expr.each(&mut |node| match node {
                Expr::Variable(index) => read_last[*index] = i,
                Expr::Trigger { touch, axis } => match triggers.iter().position(|(key, _)| *key == (*touch, *axis)) {
                    Some(at) => triggers_read[at] = i,
                    None => {
                        triggers.push(((*touch, *axis), 0));
                        triggers_read.push(i);
                    }
                },
                _ => {}
            });
        }
        let datum = formula.datum.iter().flat_map(|d| d.place.iter().flatten().map(|p| &p.0).chain(&d.rotation));
        for expr in datum {
            expr.each(&mut |node| {
                if let Expr::Variable(index) = node {
                    read_last[*index] = NEVER;
                }
            });
        }
        let mut order: Vec<usize> = (0..triggers.len()).collect();
        order.sort_unstable_by_key(|&at| triggers[at].0);
        for at in order {
            last += 1;
            triggers[at].1 = last;
        }
        let mut free: Vec<usize> = Vec::new();
        for i in 0..count {
            let own = variables[i] > 0;
            if !own {
                variables[i] = free.pop().unwrap_or_else(|| {
                    last += 1;
                    last
                });
            }
            for (at, ((..), register)) in triggers.iter().enumerate() {
                if triggers_read[at] == i {
                    free.push(*register);
                }
            }
            for j in 0..=i {
                let spent = read_last[j] == i || (j == i && read_last[j] == 0);
                if spent && variables[j] > results {
                    free.push(variables[j]);
                }
            }
            free.sort_unstable_by(|a, b| b.cmp(a));
        }
        Registers { variables, triggers, copies, results, last }
    }

    /// Where coordinate `axis` of a sample's trigger is.
    pub fn trigger(&self, sample: usize, axis: usize) -> usize {
        self.triggers.iter().find(|(key, _)| *key == (sample, axis)).map_or(0, |(_, register)| *register)
    }

    /// What stands where, for the header, in lines of at most `width`; `more` registers are needed for the write of the frame. `name` is what
    /// the control calls one.
    pub fn lines(&self, formula: &Formula, more: usize, width: usize, name: fn(usize) -> String) -> Vec<String> {
        const HEAD: &str = "Results: ";
        let mut lines: Vec<String> = Vec::new();
        let codes = formula.results.iter().filter(|r| r.variable.is_some()).map(|r| r.code);
        for (i, code) in codes.enumerate() {
            let entry = format!("{} = {code}", name(i + 1));
            match lines.last_mut().filter(|line| line.len() + 2 + entry.len() <= width) {
                Some(line) => {
                    line.push_str(", ");
                    line.push_str(&entry);
                }
                None => lines.push(format!("{HEAD}{entry}")),
            }
        }
        let last = self.last + more;
        if last > self.results {
            lines.push(format!("Used on the way: {} to {}", name(self.results + 1), name(last)));
        }
        lines
    }
}
