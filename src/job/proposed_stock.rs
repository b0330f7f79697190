//! A stock that fits the features of a job.

use crate::form::Value;
use crate::geom::Vec3;
use crate::job::Job;
use crate::job::planned::Planned;
use crate::num::tidy;
use crate::part::{self, Stock};
use crate::path::{ONE_LEVEL, Path, Surface};

/// A block that fits the features of a job, in its units: flush with the walls that are touched from outside, with a margin around the others, and with its
/// top at the highest top side. None where nothing is touched, and where the path would hit that block.
pub fn proposed_stock(Planned { job, path, .. }: &Planned) -> Option<Value> {
    let stock = fitted(path, job)?;
    let clear = part::hit(path, &stock, &job.shape, job.setup.radius).is_none();
    let given = |mm: Vec3| {
        let axis = |x: f64| Value::Number(tidy(x / job.scale));
        Value::List(mm.to_array().map(axis).to_vec())
    };
    clear.then(|| {
        Value::Map(vec![
            ("origin".to_owned(), given(stock.low)),
            ("size".to_owned(), given(stock.high - stock.low)),
        ])
    })
}

/// How far a block reaches along a direction.
struct Reach {
    direction: Vec3,
    /// The farthest point of a feature.
    far: f64,
    /// The farthest wall that faces this way and is touched from outside.
    wall: f64,
}

impl Reach {
    fn take(&mut self, point: Vec3) {
        self.far = self.far.max(point.dot(self.direction));
    }

    /// The end of the block: at the wall where nothing lies beyond it.
    fn end(&self, margin: f64, step: f64) -> f64 {
        if self.wall >= self.far - ONE_LEVEL {
            self.wall
        } else {
            ((self.far + margin) / step).ceil() * step
        }
    }
}

fn fitted(path: &Path, job: &Job) -> Option<Stock> {
    /// The least thickness of a block, and the material around and below its features, mm.
    const LEAST: f64 = 20.0;
    const MARGIN: f64 = 10.0;
    // Ends are whole millimetres or tenths of an inch.
    let step = if job.scale == 1.0 {
        1.0
    } else {
        job.scale / 10.0
    };
    let [a, o, up] = job.setup.plane.basis();
    let mut reaches = [a, -a, o, -o].map(|direction| Reach {
        direction,
        far: f64::NEG_INFINITY,
        wall: f64::NEG_INFINITY,
    });
    let (mut top, mut least_top) = (f64::NEG_INFINITY, f64::INFINITY);
    let mut opens = f64::NEG_INFINITY;
    let members = path.members.iter().map(|member| &member.path);
    let alone = path.members.is_empty().then_some(path);
    for path in members.chain(alone) {
        let inside = !part::openings(path, job.setup.radius).is_empty();
        let heights = || path.touches.iter().map(|touch| touch.point.dot(up));
        for touch in &path.touches {
            reaches.iter_mut().for_each(|reach| {
                reach.take(touch.point);
                if !inside && touch.vector.dot(reach.direction) > 0.999 {
                    reach.wall = reach.wall.max(touch.point.dot(reach.direction));
                }
            });
            if touch.vector.dot(up) > 0.999 {
                top = top.max(touch.point.dot(up));
            }
        }
        for surface in &path.surfaces {
            match surface {
                Surface::Round(round) => {
                    for reach in &mut reaches {
                        reach.take(round.center + reach.direction * round.radius);
                    }
                    // A stud is on top of the block.
                    if !round.hole {
                        let lowest = heights().fold(f64::INFINITY, f64::min);
                        least_top = least_top.min(lowest - 2.0 * job.setup.radius.max(1.0));
                    }
                }
                Surface::Flat(wall) if inside => {
                    for reach in &mut reaches {
                        reach.take(wall.point + wall.along * wall.extent.0);
                        reach.take(wall.point + wall.along * wall.extent.1);
                    }
                }
                Surface::Flat(_) | Surface::Unknown => {}
            }
        }
        let own = path.top.unwrap_or(f64::NEG_INFINITY);
        top = top.max(own);
        if inside {
            opens = opens.max(own);
        }
    }
    let touched = path.touches.iter().map(|touch| touch.point.dot(up));
    let highest = touched.clone().reduce(f64::max)?;
    // Walls whose top is not known end a margin above their touches.
    let top = if top.is_finite() {
        top
    } else {
        highest + MARGIN
    };
    let top = top.min(least_top);
    // A block below the studs would not reach up to the bores beside them.
    if opens > top + ONE_LEVEL {
        return None;
    }
    let moves = path
        .moves
        .iter()
        .map(|step| step.to.dot(up) - job.setup.radius);
    let lowest = moves
        .fold(f64::INFINITY, f64::min)
        .min(top - LEAST + MARGIN);
    let bottom = ((lowest - MARGIN) / step).floor() * step;
    let [right, left, back, front] = reaches.map(|reach| reach.end(MARGIN, step));
    let low = up * bottom - a * left - o * front;
    let size = a * (right + left) + o * (back + front) + up * (top - bottom);
    (size.min_element() > 0.0).then(|| Stock::new(low, size))
}
