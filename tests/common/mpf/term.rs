//! Expressions: brackets, signs, functions, operators by binding strength.

use super::*;

/// Reads an expression.
pub fn term(text: &str) -> Result<Term, String> {
    let mut parser = Parser {
        rest: text.trim(),
        depth: 0,
        operators: 0,
    };
    let term = parser.level(0)?;
    if parser.rest.is_empty() {
        Ok(term)
    } else {
        Err(format!(
            "{} is left over",
            parser.rest.chars().take(40).collect::<String>()
        ))
    }
}

/// Operators by binding strength, the weakest first.
const LEVELS: [&[&str]; 5] = [
    &["<<"],
    &["OR"],
    &["==", "<>", ">=", "<=", ">"],
    &["+", "-"],
    &["*", "/"],
];

struct Parser<'a> {
    rest: &'a str,
    depth: usize,
    operators: usize,
}

impl Parser<'_> {
    fn level(&mut self, level: usize) -> Result<Term, String> {
        let Some(operators) = LEVELS.get(level) else {
            return self.operand();
        };
        let mut left = self.level(level + 1)?;
        while let Some(operator) = operators.iter().find(|op| self.rest.starts_with(**op)) {
            self.take(operator.len());
            self.operators += 1;
            if self.operators > LONGEST {
                return Err("this expression is too long".into());
            }
            let right = self.level(level + 1)?;
            left = Term::Binary(operator, Box::new(left), Box::new(right));
        }
        Ok(left)
    }

    fn operand(&mut self) -> Result<Term, String> {
        self.depth += 1;
        if self.depth > DEEPEST {
            return Err("brackets are nested too deeply".into());
        }
        let term = self.inner();
        self.depth -= 1;
        term
    }

    fn inner(&mut self) -> Result<Term, String> {
        let first = self.rest.chars().next().ok_or("an operand is missing")?;
        match first {
            '-' => {
                self.take(1);
                Ok(Term::Minus(Box::new(self.operand()?)))
            }
            '(' => {
                self.take(1);
                let inner = self.level(0)?;
                self.expect(')')?;
                Ok(inner)
            }
            '"' => {
                let end = self.rest[1..].find('"').ok_or("a text is not closed")? + 1;
                let text = self.rest[1..end].to_owned();
                self.take(end + 1);
                Ok(Term::Text(text))
            }
            '0'..='9' | '.' => {
                let end = self
                    .rest
                    .find(|c: char| !(c.is_ascii_digit() || c == '.'))
                    .unwrap_or(self.rest.len());
                let number = self.rest[..end]
                    .parse::<f64>()
                    .ok()
                    .filter(|x| x.is_finite())
                    .ok_or("not a number")?;
                self.take(end);
                Ok(Term::Number(number))
            }
            '$' => {
                let name = self.name(1)?;
                if !self.rest.starts_with('[') {
                    return Ok(Term::System(name, Vec::new()));
                }
                self.take(1);
                Ok(Term::System(name, self.list(']')?))
            }
            _ => {
                let name = self.name(0)?;
                if self.rest.starts_with('(') {
                    self.take(1);
                    return Ok(Term::Call(name, self.list(')')?));
                }
                if self.rest.starts_with('[') {
                    self.take(1);
                    return Ok(Term::System(name, self.list(']')?));
                }
                match name.strip_prefix('R').map(str::parse::<usize>) {
                    Some(Ok(number)) => Ok(Term::Register(number)),
                    _ => Ok(Term::Name(name)),
                }
            }
        }
    }

    /// A name after `sign` characters that belong to it. `$MN_…` has no brackets.
    fn name(&mut self, sign: usize) -> Result<String, String> {
        let body = &self.rest[sign..];
        let end = body
            .find(|c: char| !(c.is_ascii_alphanumeric() || c == '_'))
            .unwrap_or(body.len());
        if !is_name(&body[..end]) {
            return Err(format!(
                "{} is not understood",
                self.rest.chars().take(40).collect::<String>()
            ));
        }
        let name = self.rest[..sign + end].to_owned();
        self.take(sign + end);
        Ok(name)
    }

    fn list(&mut self, close: char) -> Result<Vec<Term>, String> {
        let mut items = vec![self.level(0)?];
        while self.rest.starts_with(',') {
            self.take(1);
            items.push(self.level(0)?);
        }
        self.expect(close)?;
        Ok(items)
    }

    fn expect(&mut self, c: char) -> Result<(), String> {
        if !self.rest.starts_with(c) {
            return Err(format!("{c} is missing"));
        }
        self.take(1);
        Ok(())
    }

    fn take(&mut self, bytes: usize) {
        self.rest = self.rest[bytes..].trim_start();
    }
}
