//! Arithmetic in Klartext: the functions FN 0 to FN 13, each with two operands, and jumps to labels.
//!
//! Source: the list of functions of the TNC 640's manual. FN 13 gives an angle from 0 to 360 degrees. Ours, and marked [I] in the docs: the labels, and that
//! a program stops by `STOP` below the label of a failed check.

use crate::control::Request;
use crate::control::iso::writer::Writer;
use crate::control::native_run::compute;
use crate::control::shop::place;
use crate::formula::{Formula, Function, Node, NodeId, Op, ResultCheck};
use crate::num::{decimal, tidy};
use crate::path::{CallSequence, ShiftTerm};

/// First and last Q parameter for values that are used at once.
const AT_ONCE: (usize, usize) = (1980, 1999);

/// Label of the end of a program that has exits.
const END: &str = "END";

/// Jump to a label in any case: two equal numbers.
const ALWAYS: &str = "FN 9: IF +0 EQU +0 GOTO LBL";

/// A signed number with at most nine decimals: a Q parameter has 16 digits.
fn signed(x: f64) -> String {
    let text = decimal(tidy(x), 9);
    if text.starts_with('-') {
        text
    } else {
        format!("+{text}")
    }
}

/// The functions of a program, with the exits for failed checks.
pub(super) struct Functions<'a> {
    request: &'a Request<'a>,
    own: &'a CallSequence,
    /// Next parameter for a value that is used at once.
    next: usize,
    /// Notes of the exits, in the order of their labels.
    exits: Vec<String>,
    turns: usize,
}

impl<'a> Functions<'a> {
    pub fn of(request: &'a Request<'a>, own: &'a CallSequence) -> Self {
        Functions {
            request,
            own,
            next: AT_ONCE.0,
            exits: Vec::new(),
            turns: 0,
        }
    }

    /// Q parameter of a value that the program measures or computes.
    fn q(&self, assignment: usize) -> String {
        let stored = self.own.stored_value(assignment);
        stored.map_or_else(String::new, super::plan_calls::CYCLES.name)
    }

    /// Computes what the results so far give, and stops before cycle `m` if it follows a result that is beyond its limit.
    pub fn compute(&mut self, w: &mut Writer<'_>, m: usize) {
        let formula = &self.request.path.formula;
        let (values, checks) = compute::before(self.request, self.own, m);
        for (index, register) in values {
            let node = formula.assignments[index].node;
            self.next = AT_ONCE.0;
            self.assign(w, formula, register, node);
            if let Some(turn) = formula.full_turn(node) {
                self.turns += 1;
                let label = format!("\"TURN{}\"", self.turns);
                w.line(&format!(
                    "FN 12: IF +Q{register} LT +{} GOTO LBL {label}",
                    turn / 2
                ));
                w.line(&format!("FN 2: Q{register} = +Q{register} - +{turn}"));
                w.line(&format!("LBL {label}"));
            }
        }
        for check in checks {
            self.check(w, &check);
        }
    }

    fn check(&mut self, w: &mut Writer<'_>, check: &ResultCheck) {
        let formula = &self.request.path.formula;
        let unit = if check.angle { 1.0 } else { self.request.scale };
        let q = self.q(check.variable.index());
        let code = formula.code(&formula.results[check.result]);
        self.exits
            .push(format!("{code}{}, see {q}", check.complaint(unit)));
        let label = self.exits.len();
        for (function, sign, limit) in [("11", "GT", check.limit), ("12", "LT", -check.limit)] {
            let limit = signed((check.expected + limit) / unit);
            w.line(&format!(
                "FN {function}: IF +{q} {sign} {limit} GOTO LBL \"STOP{label}\""
            ));
        }
    }

    /// Computes the words of a call that follow results, each into a separate parameter, and returns these parameters. `words` are the nominal values, in units of
    /// the program.
    pub fn shift(&mut self, w: &mut Writer<'_>, block: usize, words: &[f64]) -> Vec<Option<usize>> {
        self.next = AT_ONCE.0;
        let word = |(i, value): (usize, &f64)| {
            let terms = self.own.shifts(block, i);
            (!terms.is_empty()).then(|| self.shifted(w, *value, terms))
        };
        words.iter().enumerate().map(word).collect()
    }

    fn shifted(&mut self, w: &mut Writer<'_>, value: f64, terms: &[ShiftTerm]) -> usize {
        let sum = self.takes();
        let mut from = signed(value);
        for term in terms {
            let mut by = format!("+{}", self.q(term.by.index()));
            if term.factor != 1.0 {
                let product = self.takes();
                w.line(&format!(
                    "FN 3: Q{product} = {by} * {}",
                    signed(term.factor)
                ));
                by = format!("+Q{product}");
            }
            w.line(&format!("FN 1: Q{sum} = {from} + {by}"));
            from = format!("+Q{sum}");
        }
        sum
    }

    /// Exits below the end of the program, and its end.
    pub fn end(&mut self, w: &mut Writer<'_>) {
        if self.exits.is_empty() {
            return;
        }
        w.line(&format!("{ALWAYS} \"{END}\""));
        for (i, note) in std::mem::take(&mut self.exits).iter().enumerate() {
            w.line(&format!("LBL \"STOP{}\"", i + 1));
            w.shop(&place::ON_ALARM);
            w.comment(note);
            w.line("STOP");
            w.line(&format!("{ALWAYS} \"{END}\""));
        }
        w.line(&format!("LBL \"{END}\""));
    }

    fn takes(&mut self) -> usize {
        debug_assert!(self.next <= AT_ONCE.1, "too many values at once");
        self.next += 1;
        self.next - 1
    }

    /// Writes the value of a node into a parameter, which first holds that of its left operand.
    fn assign(&mut self, w: &mut Writer<'_>, formula: &Formula, into: usize, node: NodeId) {
        let first = self.next;
        let left = |own: &mut Self, w: &mut Writer<'_>, node| match own.plain(formula, node) {
            Some(text) => text,
            None => {
                own.assign(w, formula, into, node);
                format!("+Q{into}")
            }
        };
        let text = match formula.node(node) {
            Node::Binary(op, a, b) => {
                let (a, b) = (left(self, w, a), self.right(w, formula, b));
                let (number, sign) = match op {
                    Op::Add => (1, "+"),
                    Op::Subtract => (2, "-"),
                    Op::Multiply => (3, "*"),
                    Op::Divide => (4, "DIV"),
                };
                format!("FN {number}: Q{into} = {a} {sign} {b}")
            }
            Node::Call(function, a) => {
                let a = left(self, w, a);
                match function {
                    Function::Sqrt => format!("FN 5: Q{into} = SQRT {a}"),
                    Function::Sin => format!("FN 6: Q{into} = SIN {a}"),
                    Function::Cos => format!("FN 7: Q{into} = COS {a}"),
                    // The root of the square.
                    Function::Abs => format!("FN 8: Q{into} = {a} LEN +0"),
                }
            }
            Node::Atan2(y, x) => {
                let (y, x) = (left(self, w, y), self.right(w, formula, x));
                format!("FN 13: Q{into} = {y} ANG {x}")
            }
            _ => format!("FN 0: Q{into} = {}", left(self, w, node)),
        };
        w.line(&text);
        self.next = first;
    }

    /// A right operand. An expression is computed into a separate parameter first.
    fn right(&mut self, w: &mut Writer<'_>, formula: &Formula, node: NodeId) -> String {
        if let Some(text) = self.plain(formula, node) {
            return text;
        }
        let into = self.takes();
        self.assign(w, formula, into, node);
        format!("+Q{into}")
    }

    /// An operand that is a number or a parameter.
    fn plain(&self, formula: &Formula, node: NodeId) -> Option<String> {
        match formula.node(node) {
            Node::Number(x) => Some(signed(x)),
            Node::Length(mm) => Some(signed(mm / self.request.scale)),
            Node::Variable(variable) => Some(format!("+{}", self.q(variable.index()))),
            Node::Binary(..) | Node::Call(..) | Node::Atan2(..) => None,
            Node::Trigger { .. } | Node::Circle(..) => {
                unreachable!("the cycles keep no contacts")
            }
        }
    }
}
