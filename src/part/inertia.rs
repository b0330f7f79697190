//! Inertia of a machine: distances from a contact to standstill, and from standstill to a feed.
//!
//! Each is v²/2a at a constant acceleration a. Real decelerations take longer: axes follow late, and controls limit the jerk.

/// Stopping behaviour of a machine after a contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Machine {
    /// Deceleration of an axis, mm/s².
    pub acceleration: f64,
    /// Delay from the contact to the start of the deceleration, seconds.
    pub latency: f64,
    /// Stylus deflection limit, mm.
    pub deflection: f64,
}

impl Machine {
    /// Distance from the contact to standstill at a feed (mm/min), mm: v·t + v²/2a.
    pub fn stopping_way(&self, feed: f64) -> f64 {
        feed / 60.0 * self.latency + self.run_up(feed)
    }

    /// Distance from standstill until a feed (mm/min) is reached, mm: v²/2a.
    pub fn run_up(&self, feed: f64) -> f64 {
        let v = feed / 60.0;
        v * v / (2.0 * self.acceleration)
    }

    /// Fastest feed, mm/min, at which the axes stop within the stylus deflection limit: v²/2a + v·t = d, solved for v.
    pub fn fastest_stop(&self) -> f64 {
        let (t, d) = (self.latency, self.deflection);
        60.0 * 2.0 * d / (t + (t * t + 2.0 * d / self.acceleration).sqrt())
    }

    /// Fastest feed, mm/min, that is reached within a distance (mm).
    pub fn fastest_reached(&self, way: f64) -> f64 {
        60.0 * (2.0 * self.acceleration * way).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn machine(acceleration: f64, latency: f64, deflection: f64) -> Machine {
        Machine {
            acceleration,
            latency,
            deflection,
        }
    }

    /// By hand: 5000 mm/min are 83.33 mm/s; 83.33² / (2·500) = 6.944, at 200 mm/s² 17.36. 10,000 mm/min: four times as far.
    #[test]
    fn ways_by_hand() {
        let near = |a: f64, b: f64| assert!((a - b).abs() < 0.005, "{a} is not {b}");
        let at_once = machine(500.0, 0.0, 3.0);
        near(at_once.stopping_way(5000.0), 6.944);
        near(at_once.stopping_way(10_000.0), 27.778);
        near(machine(200.0, 0.0, 3.0).stopping_way(5000.0), 17.361);
        // 5 ms at 83.33 mm/s: 0.417 mm more.
        near(machine(500.0, 0.005, 3.0).stopping_way(5000.0), 7.361);
        near(at_once.run_up(150.0), 0.00625);
        // √(2·500·3) = 54.77 mm/s.
        near(at_once.fastest_stop(), 3286.335);
        // √(2·500·0.1) = 10 mm/s.
        near(at_once.fastest_reached(0.1), 600.0);
    }

    /// The stopping distance at the fastest feed is the deflection limit, and the run-up to the fastest reached feed is the given distance.
    #[test]
    fn the_fastest_feeds_undo_the_ways() {
        for acceleration in [1.0, 50.0, 500.0, 20_000.0, 1e6] {
            for latency in [0.0, 0.0005, 0.005, 1.0] {
                for deflection in [0.01, 3.0, 12.0, 100.0] {
                    let own = machine(acceleration, latency, deflection);
                    let way = own.stopping_way(own.fastest_stop());
                    assert!((way / deflection - 1.0).abs() < 1e-9, "{own:?}: {way}");
                    let run_up = own.run_up(own.fastest_reached(deflection));
                    assert!(
                        (run_up / deflection - 1.0).abs() < 1e-9,
                        "{own:?}: {run_up}"
                    );
                }
            }
        }
    }
}
