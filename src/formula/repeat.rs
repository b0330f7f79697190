//! Repeated touches: mean and largest distance of the touches of each point.

use std::cell::RefCell;

use crate::formula::draft::{Draft, Expr, Value};
use crate::formula::lower::TriggerSource;
use crate::formula::{Name, Role, UsedTriggers};
use crate::geom::Vec3;
use crate::num::tidy;
use crate::text::words;

/// Repeated touches of a formula under construction.
pub(super) struct Repeats<'f> {
    times: usize,
    /// Probing direction of each sample.
    along: Vec<Vec3>,
    /// Coordinates of each sample that the formula reads.
    used: UsedTriggers,
    written: RefCell<Written<'f>>,
}

/// Parts that are already written.
#[derive(Default)]
struct Written<'f> {
    /// Mean of each coordinate of a sample that is read.
    means: Vec<((usize, usize), Value<'f>)>,
    /// Largest distance between touches of one point, and the number of points in it.
    spread: Option<(Value<'f>, usize)>,
}

const MEANS: [&str; 3] = ["_x", "_y", "_z"];

impl<'f> TriggerSource<'f> for Repeats<'f> {
    fn trigger(&self, f: &'f Draft, sample: usize, axis: usize) -> Expr<'f> {
        self.mean(f, sample, axis).into()
    }
}

impl<'f> Repeats<'f> {
    pub(super) fn of(times: usize, along: &[Vec3], used: UsedTriggers) -> Self {
        Repeats {
            times,
            along: along.to_vec(),
            used,
            written: RefCell::default(),
        }
    }

    /// Mean of a coordinate of a sample. It is written before its first use: a control does not keep the touches longer.
    fn mean(&self, f: &'f Draft, sample: usize, axis: usize) -> Value<'f> {
        let known = |written: &Written<'f>| {
            written
                .means
                .iter()
                .find(|(key, _)| *key == (sample, axis))
                .map(|(_, value)| *value)
        };
        if let Some(value) = known(&self.written.borrow()) {
            return value;
        }
        let mut written = self.written.borrow_mut();
        for axis in (0..3).filter(|axis| self.used.has(sample, *axis)) {
            let sum = f.sum((0..self.times).map(|n| f.trigger(self.times * sample + n, axis)));
            let name = Name::new("mean", sample + 1).and(MEANS[axis]);
            written.means.push((
                (sample, axis),
                f.set(name, sum / f.number(self.times as f64)),
            ));
        }
        let own = f.set(Name::new("apart", sample + 1), self.apart(f, sample));
        written.spread = Some(match written.spread {
            None => (own, 1),
            Some((most, count)) => {
                // max(a, b) = (a + b + |a − b|) / 2.
                let larger = (most + own + (most - own).abs()) / f.number(2.0);
                (f.set(Name::new("spread", count + 1), larger), count + 1)
            }
        });
        known(&written).expect("a formula reads what is used of it")
    }

    /// Largest distance between the touches of a sample along their probing direction.
    fn apart(&self, f: &'f Draft, sample: usize) -> Expr<'f> {
        let along = self.along[sample].to_array().map(tidy);
        let place = |n: usize| -> Expr<'f> {
            let touch = self.times * sample + n;
            let trigger = |axis: usize| f.trigger(touch, axis);
            // Along an axis the coordinate alone gives it, in either direction.
            if let Some(axis) = (0..3).find(|axis| along[*axis].abs() == 1.0) {
                return trigger(axis);
            }
            let plane = f.project(trigger(0), trigger(1), (along[0], along[1]));
            let rest = trigger(2) * f.number(along[2].abs());
            f.set(
                Name::new("along", touch + 1),
                if along[2] < 0.0 {
                    plane - rest
                } else {
                    plane + rest
                },
            )
            .into()
        };
        let places: Vec<Expr<'f>> = (0..self.times).map(place).collect();
        let between = |a: usize, b: usize| (places[a] - places[b]).abs();
        match self.times {
            2 => between(0, 1),
            // The largest distance of three points is half of the sum of all three distances.
            _ => (between(0, 1) + between(1, 2) + between(0, 2)) / f.number(2.0),
        }
    }

    /// States the largest distance between touches of one point as the last result.
    pub(super) fn state(&self, f: &'f Draft, limit: Option<f64>) {
        let spread = self.written.borrow().spread;
        let meaning = words!("Largest distance between touches of the same point");
        f.result(
            "spread",
            Role::Spread,
            meaning,
            0.0,
            spread.map(|(most, _)| most),
        );
        f.limited(limit);
    }
}
