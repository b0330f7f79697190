//! Reads points, one for each touch: a list, or a text with one point a line.

use crate::form::{Checker, Value};
use crate::geom::Vec3;
use crate::part::measured::{Numbered, line, unclear};
use crate::text::text;

/// Reads a list of `[X, Y, Z]` or `{x, y, z}`, mm. Reports every problem at `measured[i]`; `None` for an entry that could not be read.
pub fn list(checker: &mut Checker, items: &[Value]) -> Vec<Option<Vec3>> {
    items
        .iter()
        .enumerate()
        .map(|(i, item)| point(checker, item, &format!("measured[{i}]")))
        .collect()
}

/// Reads lines `X1.2 Y3.4 Z5.6`. A line without a position is ignored; a line that could be a point but has another form is an error.
pub fn letters(checker: &mut Checker, lines: &[Numbered<'_>]) -> Vec<Option<Vec3>> {
    let mut points = Vec::new();
    for &(number, text) in lines {
        let bare = line::without_comments(text);
        if let Some(place) = line::letters(&bare).filter(|_| !line::is_sent(&bare)) {
            points.push(Some(Vec3::from_array(place) * checker.scale));
        } else if bare.contains(|c: char| c.is_ascii_digit()) && !is_sentence(&bare) {
            unclear(checker, number, text);
        }
    }
    points
}

/// Whether a line begins with a word, like a name or a message: it is neither a position nor a number.
fn is_sentence(line: &str) -> bool {
    let word = line
        .trim_start()
        .chars()
        .take_while(|c| c.is_alphabetic())
        .count();
    word > 1
}

fn point(checker: &mut Checker, value: &Value, path: &str) -> Option<Vec3> {
    let parts: Vec<Option<&Value>> = match value {
        Value::List(items) if items.len() == 3 || items.len() == 9 => {
            items[..3].iter().map(Some).collect()
        }
        Value::Map(_) => ["x", "y", "z"]
            .iter()
            .map(|k| value.get(k).or_else(|| value.get(&k.to_ascii_uppercase())))
            .collect(),
        _ => {
            checker.error(
                "wrong-type",
                path,
                text!("A measured point is [X, Y, Z]: three numbers"),
            );
            return None;
        }
    };
    let mut numbers = [0.0; 3];
    for (number, part) in numbers.iter_mut().zip(parts) {
        match part {
            Some(Value::Number(x)) if x.is_finite() && x.abs() <= 1e6 => *number = *x,
            _ => {
                checker.error(
                    "not-a-number",
                    path,
                    text!("A measured point is [X, Y, Z]: three finite numbers"),
                );
                return None;
            }
        }
    }
    Some(Vec3::from_array(numbers) * checker.scale)
}

/// Reads text with one point a line: CSV (comma, semicolon, tab or space; a heading without digits is ignored) or LinuxCNC's PROBEOPEN log (nine numbers a
/// line, of which the first three count). A comma is a decimal comma if semicolons or tabs separate the numbers, or if spaces separate three or nine numbers
/// with at most one comma each.
pub fn lines(checker: &mut Checker, text: &str) -> Vec<Option<Vec3>> {
    let mut points = Vec::new();
    let mut first = true;
    for (index, line) in text.lines().enumerate() {
        let line = line.trim();
        let heading = first && !line.is_empty() && !line.contains(|c: char| c.is_ascii_digit());
        if line.is_empty() || heading || line.starts_with('#') {
            first &= !heading;
            continue;
        }
        first = false;
        let parts = numbers(line);
        let path = format!("measured[{}]", points.len());
        let parsed = match parts.as_deref() {
            Some(p @ ([_, _, _] | [_, _, _, _, _, _, _, _, _])) => {
                Some(Vec3::new(p[0], p[1], p[2]) * checker.scale)
            }
            Some(p) => {
                let message = text!(
                    "Line {line} has {count} numbers; a point has 3, a line of LinuxCNC's log 9",
                    index + 1,
                    p.len()
                );
                checker.error("wrong-count", path, message);
                None
            }
            None => {
                checker.error(
                    "not-a-number",
                    path,
                    text!("Line {line} is not made of finite numbers", index + 1),
                );
                None
            }
        };
        points.push(parsed);
    }
    points
}

fn numbers(line: &str) -> Option<Vec<f64>> {
    let decimal_comma = line.contains([';', '\t']) || parted_by_spaces(line);
    let separator = |c: char| c == ';' || c.is_whitespace() || (c == ',' && !decimal_comma);
    line.split(separator)
        .filter(|part| !part.is_empty())
        .map(|part| {
            crate::num::read(&part.replace(',', ".")).filter(|x| x.is_finite() && x.abs() <= 1e6)
        })
        .collect()
}

/// Whether spaces alone separate the numbers of a point, or of a line of the log: `37,5 -0,5 -10`.
fn parted_by_spaces(line: &str) -> bool {
    let inner = |part: &str| {
        part.matches(',').count() <= 1 && !part.starts_with(',') && !part.ends_with(',')
    };
    matches!(line.split_whitespace().count(), 3 | 9) && line.split_whitespace().all(inner)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(text: &str) -> (Vec<Option<Vec3>>, Vec<String>) {
        let mut checker = Checker::default();
        let points = lines(&mut checker, text.trim_start_matches('\u{feff}'));
        (
            points,
            checker
                .findings()
                .into_iter()
                .map(|f| format!("{} {}", f.code, f.path))
                .collect(),
        )
    }

    #[test]
    fn csv_in_the_forms_people_have() {
        let point = Some(Vec3::new(37.0, -0.5, -10.0));
        for form in [
            "37,-0.5,-10",
            "37; -0,5; -10",
            "37\t-0,5\t-10",
            " 37 -0.5  -10 ",
            "37,0 -0,5 -10",
            "37 -0,5 -10",
            "37, -0.5, -10",
            "\u{feff}37 -0.5 -10",
            "X,Y,Z\n37,-0.5,-10\n\n",
            "# log\n37.0 -.5 -1e1",
        ] {
            assert_eq!(text(form), (vec![point], vec![]), "{form:?}");
        }
        assert_eq!(
            text("37.000000 -0.500000 -10.000000 0.0 0 0 0 0 0"),
            (vec![point], vec![])
        );
    }

    /// Ambiguous numbers are not guessed: three with a comma each are three, nine in three groups are nine.
    #[test]
    fn commas_between_spaces_part_numbers_only_where_each_group_has_more() {
        assert_eq!(
            text("1,2,3 4,5,6 7,8,9"),
            (vec![Some(Vec3::new(1.0, 2.0, 3.0))], vec![])
        );
        assert_eq!(
            text("1,5 2,5 3,5 4 5 6 7 8 9,5"),
            (vec![Some(Vec3::new(1.5, 2.5, 3.5))], vec![])
        );
        assert_eq!(text("1,5 2,5").1, ["wrong-count measured[0]"]);
    }

    #[test]
    fn what_is_no_point_is_said_line_by_line() {
        let (points, findings) = text("1,2\n1,2,x\n1,2,inf\n4,5,6\n");
        assert_eq!(points, [None, None, None, Some(Vec3::new(4.0, 5.0, 6.0))]);
        assert_eq!(
            findings,
            [
                "wrong-count measured[0]",
                "not-a-number measured[1]",
                "not-a-number measured[2]"
            ]
        );
    }
}
