//! Planes, frames and vectors. Everything here is in millimetres and radians, right-handed.

pub use glam::DVec2 as Vec2;
pub use glam::DVec3 as Vec3;

/// The working plane of a program.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Plane {
    /// Abscissa X, ordinate Y, tool axis Z.
    #[default]
    G17,
    /// Abscissa Z, ordinate X, tool axis Y.
    G18,
    /// Abscissa Y, ordinate Z, tool axis X.
    G19,
}

impl Plane {
    /// Indices into \[X, Y, Z\] of abscissa, ordinate and tool axis.
    pub const fn axes(self) -> [usize; 3] {
        match self {
            Plane::G17 => [0, 1, 2],
            Plane::G18 => [2, 0, 1],
            Plane::G19 => [1, 2, 0],
        }
    }

    /// The plane with this G word; G17 for any other word.
    pub fn named(word: &str) -> Plane {
        match word {
            "G18" => Plane::G18,
            "G19" => Plane::G19,
            _ => Plane::G17,
        }
    }

    /// G word of the plane.
    pub const fn word(self) -> &'static str {
        match self {
            Plane::G17 => "G17",
            Plane::G18 => "G18",
            Plane::G19 => "G19",
        }
    }

    /// Unit vectors of abscissa, ordinate and tool axis in \[X, Y, Z\].
    pub fn basis(self) -> [Vec3; 3] {
        self.axes().map(|axis| Vec3::AXES[axis])
    }
}

/// Names of the linear axes, in the order of a point's components.
pub const AXIS_NAMES: [&str; 3] = ["X", "Y", "Z"];

/// Frame of a feature: (u, v, w) = (abscissa, ordinate, tool axis), rotated about the tool axis and moved to `origin`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// Origin of the frame in the work coordinate system, mm.
    pub origin: Vec3,
    /// First direction in the plane, a unit vector.
    pub u: Vec3,
    /// Second direction in the plane, 90° counter-clockwise from `u` seen against the tool axis.
    pub v: Vec3,
    /// The tool axis, pointing away from the part.
    pub w: Vec3,
}

impl Frame {
    /// The frame of `plane` at `origin`, rotated by `rotation` (radians, counter-clockwise seen against the tool axis).
    pub fn new(plane: Plane, origin: Vec3, rotation: f64) -> Self {
        let [a, o, w] = plane.basis();
        let (sin, cos) = rotation.sin_cos();
        Frame {
            origin,
            u: a * cos + o * sin,
            v: o * cos - a * sin,
            w,
        }
    }

    /// The point (u, v, w) of this frame in the work coordinate system.
    pub fn point(&self, u: f64, v: f64, w: f64) -> Vec3 {
        self.origin + self.direction(u, v) + self.w * w
    }

    /// A direction in the plane of this frame.
    pub fn direction(&self, u: f64, v: f64) -> Vec3 {
        self.u * u + self.v * v
    }
}

/// A rigid motion: a rotation about the tool axis through the work origin, then a shift.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rigid {
    frame: Frame,
    plane: Plane,
}

impl Rigid {
    /// A rotation by `rotation` (radians) about the tool axis of `plane` through the work origin, then a shift by `offset`.
    pub fn new(plane: Plane, offset: Vec3, rotation: f64) -> Self {
        Rigid {
            frame: Frame::new(plane, offset, rotation),
            plane,
        }
    }

    /// Position of a point of the nominal part after the motion.
    pub fn point(&self, p: Vec3) -> Vec3 {
        self.frame.origin + self.direction(p)
    }

    /// Direction of the nominal part after the motion.
    pub fn direction(&self, d: Vec3) -> Vec3 {
        let [a, o, w] = self.plane.axes();
        self.frame.u * d[a] + self.frame.v * d[o] + self.frame.w * d[w]
    }

    /// Point of the nominal part that moves to `p`.
    pub fn nominal(&self, p: Vec3) -> Vec3 {
        let off = p - self.frame.origin;
        let mut nominal = Vec3::ZERO;
        for (axis, direction) in
            self.plane
                .axes()
                .into_iter()
                .zip([self.frame.u, self.frame.v, self.frame.w])
        {
            nominal[axis] = off.dot(direction);
        }
        nominal
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_plane_is_right_handed() {
        for plane in [Plane::G17, Plane::G18, Plane::G19] {
            let [a, o, w] = plane.basis();
            assert_eq!(a.cross(o), w, "{plane:?}");
        }
    }

    #[test]
    fn a_quarter_turn_goes_from_abscissa_to_ordinate() {
        // G18 seen against Y: Z to the right, X up.
        let frame = Frame::new(Plane::G18, Vec3::ZERO, 90f64.to_radians());
        assert!((frame.u - Vec3::X).length() < 1e-15);
        assert!((frame.v - -Vec3::Z).length() < 1e-15);
        let rigid = Rigid::new(Plane::G18, Vec3::new(1.0, 2.0, 3.0), 90f64.to_radians());
        assert!((rigid.point(Vec3::Z) - Vec3::new(2.0, 2.0, 3.0)).length() < 1e-15);
    }
}
