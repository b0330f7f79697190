//! Contents of a grbl log: its items in order, and the touches that count.

use crate::form::Checker;
use crate::geom::Vec3;
use crate::part::measured::line::{self, Item};
use crate::part::measured::{Numbered, is_numbers, unclear};
use crate::text::text;

/// Largest number of line kinds that may repeat the same touches.
const MOST_ECHOES: usize = 4;

/// Contents of a log, in order.
#[derive(Debug, Default)]
pub struct Log {
    /// Items with their line numbers.
    pub items: Vec<(usize, Item)>,
    /// Touches that count, by their indices among the items.
    pub touches: Vec<usize>,
    /// Work offset that a user wrote as the first line; a sent one has an answer.
    pub stated: Option<u8>,
    /// Lines with touches that only repeat earlier ones.
    pub repeated: Vec<usize>,
}

impl Log {
    /// All items of the lines. A line that could be a measurement but is not a report is an error.
    pub fn of(checker: &mut Checker, lines: &[Numbered<'_>]) -> Log {
        let answered = lines
            .get(1)
            .is_some_and(|(_, line)| line::items(line) == [Item::Answered]);
        let stated = lines
            .first()
            .and_then(|(_, line)| line::offset_alone(line))
            .filter(|_| !answered);
        let mut log = Log {
            stated,
            ..Log::default()
        };
        let mut in_answer = false;
        for &(number, line) in lines {
            let items = line::items(line);
            if items.is_empty() && is_numbers(&line::without_comments(line)) {
                unclear(checker, number, line);
            }
            for item in items {
                match item {
                    Item::Length(_) => in_answer = true,
                    Item::Touch { .. } if in_answer => {
                        in_answer = false;
                        log.repeated.push(number);
                        continue;
                    }
                    Item::Touch { .. } => log.touches.push(log.items.len()),
                    Item::Unreadable => {
                        let message = text!(
                            "The PRB report in line {line} cannot be read: it must be [PRB:x,y,z:1], or :0 at its end for a touch that missed",
                            number
                        );
                        checker.error("unclear-line", "measured", message);
                    }
                    Item::Answered => in_answer = false,
                    _ => {}
                }
                log.items.push((number, item));
            }
        }
        log
    }

    /// Touches that count: line, position (`None` for a missed touch), and the text before it.
    pub fn touched(&self) -> impl Iterator<Item = (usize, Option<Vec3>, &str)> {
        self.touches.iter().filter_map(|at| match &self.items[*at] {
            (
                number,
                Item::Touch {
                    place,
                    contact,
                    prefix,
                },
            ) => Some((*number, contact.then_some(*place), prefix.as_str())),
            _ => None,
        })
    }

    /// Removes repetitions: the same touches in lines of another kind. If only some are repeated, that is an error.
    pub fn drop_echoes(&mut self, checker: &mut Checker) {
        let touched: Vec<(usize, Option<Vec3>, &str)> = self.touched().collect();
        let Some(first) = touched.first().map(|(.., prefix)| *prefix) else {
            return;
        };
        let of = |kind: &str| {
            touched
                .iter()
                .filter(|(.., prefix)| *prefix == kind)
                .map(|(_, place, _)| *place)
                .collect::<Vec<_>>()
        };
        let own = of(first);
        let mut kinds: Vec<&str> = Vec::new();
        for (.., prefix) in &touched {
            if kinds.len() <= MOST_ECHOES && !kinds.contains(prefix) {
                kinds.push(prefix);
            }
        }
        let echoed =
            (2..=MOST_ECHOES).contains(&kinds.len()) && kinds.iter().all(|kind| of(kind) == own);
        if !echoed {
            let twice = touched
                .windows(2)
                .find(|pair| pair[0].2 != pair[1].2 && pair[0].1 == pair[1].1);
            if let Some([(one, ..), (other, ..)]) = twice {
                let message = text!(
                    "Lines {one} and {other} report the same position in two ways: whether these are two touches is unclear. Keep one report per touch",
                    *one,
                    *other
                );
                checker.error("unclear-line", "measured", message);
            }
            return;
        }
        let keep: Vec<bool> = touched
            .iter()
            .map(|(.., prefix)| *prefix == first)
            .collect();
        let mut keep = keep.into_iter();
        self.touches.retain(|_| keep.next().unwrap_or(true));
    }
}
