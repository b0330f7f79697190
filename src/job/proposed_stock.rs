//! A stock that fits the features of a job.

use crate::form::Value;
use crate::geom::Vec3;
use crate::job::Job;
use crate::job::planned::PlannedJob;
use crate::job::stock::nominal_hit;
use crate::num::tidy;
use crate::part::{self, Stock};
use crate::path::{ONE_LEVEL, Path, Surface};

/// A block that fits the features of a job, in its units: flush with walls that are touched from outside, with a margin around the others, and with its top at
/// the highest top side. `None` if nothing is touched, or if the path would hit that block.
pub fn proposed_stock(PlannedJob { job, path, .. }: &PlannedJob) -> Option<Value> {
    let stock = fitted(path, job)?;
    let clear = nominal_hit(job, path, &stock).is_none();
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

/// Smallest thickness of a block, and margin around and below its features, mm.
const LEAST: f64 = 20.0;
const MARGIN: f64 = 10.0;

/// Extent of a block along a direction.
struct Reach {
    direction: Vec3,
    /// Farthest point of a feature.
    far: f64,
    /// Farthest wall that faces this way and is touched from outside.
    wall: f64,
}

impl Reach {
    fn take(&mut self, point: Vec3) {
        self.far = self.far.max(point.dot(self.direction));
    }

    /// End of the block: at the wall, if nothing is beyond it.
    fn end(&self, step: f64) -> f64 {
        if self.wall >= self.far - ONE_LEVEL {
            self.wall
        } else {
            ((self.far + MARGIN) / step).ceil() * step
        }
    }
}

/// Requirements for a block.
struct Hull {
    /// To the right, left, back and front.
    reaches: [Reach; 4],
    /// Highest top side.
    top: f64,
    /// Lowest top that leaves all studs above the block.
    below_studs: f64,
    /// Highest top side of a feature that is cut into the block.
    opens: f64,
}

impl Hull {
    /// Adds the features of one cycle.
    fn take(&mut self, path: &Path, radius: f64) {
        let up = path.frame.w;
        let inside = !part::openings(path, &path.surfaces, radius).is_empty();
        for touch in &path.touches {
            self.reach(touch.point);
            for reach in &mut self.reaches {
                if !inside && touch.vector.dot(reach.direction) > 0.999 {
                    reach.wall = reach.wall.max(touch.point.dot(reach.direction));
                }
            }
            if !inside && touch.vector.dot(up) > 0.999 {
                self.top = self.top.max(touch.point.dot(up));
            }
        }
        for surface in &path.surfaces {
            match surface {
                Surface::Round(round) => {
                    for reach in &mut self.reaches {
                        reach.take(round.center + reach.direction * round.radius);
                    }
                    if !round.hole {
                        let touches = path.touches.iter().map(|touch| touch.point.dot(up));
                        let lowest = touches.fold(f64::INFINITY, f64::min);
                        self.below_studs = self.below_studs.min(lowest - 2.0 * radius.max(1.0));
                    }
                }
                Surface::Flat(wall) if inside => {
                    self.reach(wall.point + wall.along * wall.extent.0);
                    self.reach(wall.point + wall.along * wall.extent.1);
                }
                Surface::Flat(_) | Surface::Unknown => {}
            }
        }
        let own = path.top.unwrap_or(f64::NEG_INFINITY);
        self.top = self.top.max(own);
        if inside {
            self.opens = self.opens.max(own);
        }
    }

    fn reach(&mut self, point: Vec3) {
        self.reaches.iter_mut().for_each(|reach| reach.take(point));
    }
}

fn fitted(path: &Path, job: &Job) -> Option<Stock> {
    let radius = job.setup.radius;
    let [a, o, up] = job.setup.plane.basis();
    let mut hull = Hull {
        reaches: [a, -a, o, -o].map(|direction| Reach {
            direction,
            far: f64::NEG_INFINITY,
            wall: f64::NEG_INFINITY,
        }),
        top: f64::NEG_INFINITY,
        below_studs: f64::INFINITY,
        opens: f64::NEG_INFINITY,
    };
    let members = path.cycles.iter().map(|member| &member.path);
    let alone = path.cycles.is_empty().then_some(path);
    members
        .chain(alone)
        .for_each(|path| hull.take(path, radius));
    let touches = path.touches.iter().map(|touch| touch.point.dot(up));
    let highest = touches.reduce(f64::max)?;
    // Walls with an unknown top end a margin above their touches.
    let top = if hull.top.is_finite() {
        hull.top
    } else {
        highest + MARGIN
    };
    let top = top.min(hull.below_studs);
    // A block below the studs would not reach up to the bores beside them.
    if hull.opens > top + ONE_LEVEL {
        return None;
    }
    // Ends are whole millimetres or tenths of an inch.
    let step = if job.scale == 1.0 {
        1.0
    } else {
        job.scale / 10.0
    };
    let moves = path.moves.iter().map(|step| step.to.dot(up) - radius);
    let lowest = moves
        .fold(f64::INFINITY, f64::min)
        .min(top - LEAST + MARGIN);
    let bottom = ((lowest - MARGIN) / step).floor() * step;
    let [right, left, back, front] = hull.reaches.map(|reach| reach.end(step));
    let low = up * bottom - a * left - o * front;
    let size = a * (right + left) + o * (back + front) + up * (top - bottom);
    (size.min_element() > 0.0).then(|| Stock::new(low, size))
}
