//! Texts of the manual that several cycles share: steps and interpretations.

/// Documented steps of a protected cycle, with its start and the repetition of steps 2 to 6.
pub const fn protected(start: &'static str, again: &'static str) -> [&'static str; 8] {
    [
        start,
        "At the height of the start, across to the side clearance from the touch point",
        "Down by top clearance and depth",
        "Touch, and back to where the touch began",
        "Up by top clearance and depth",
        "Back to the start",
        again,
        "Up by the feed distance",
    ]
}

/// Documented steps of a cycle that touches from the centre.
pub const FROM_CENTRE: &[&str] = &[
    "With the top clearance checked: to the feed distance above it, down to it over the centre, then down to the centre at the depth",
    "With the top clearance not checked: to the feed distance above the centre at the depth, then down to it",
    "Touch, and back to the centre, once for each touch point",
    "With the top clearance checked: up by top clearance and depth",
    "Up to the feed distance",
];

pub const HEIGHTS: &str =
    "Clearances are measured from the wall to the ball centre, heights are of the ball centre.";
pub const NORMAL: &str =
    "The target vector is the outward normal of the wall: from the material into free space.";
pub const NORMAL_OF_SURFACE: &str =
    "The target vector is the outward normal of the surface: from the material into free space.";
pub const FEEDS: &str = "Sideways returns use the long link feed and the last lift the return feed: the source names no feed there.";
pub const LAST_LIFT: &str = "The last lift uses the return feed: the source names no feed there.";
pub const ALONG: &str = "From touch to touch of a wall the long link feed is used, and for the last lift the return feed: the source names no feed there.";
pub const WAY_BACK: &str = "Where the source names no feed, ways back use the long link feed.";
pub const COMPENSATION: &str = "With *Compensate dimensions* on, the points from code -100 are ball-centre positions; the source only says \"toolpath \
                                shift with tool compensation\". The points from code -200 never move.";
pub const UNCHECKED: &str = "The top clearance that is not checked is left out of the parameter table: how the source stores it is not documented.";
pub const RECTANGLE: &str = "Touch point 1 is the wall in the first direction, 2 its opposite, 3 the wall a quarter turn counter-clockwise from 1, \
                             4 its opposite.";
pub const THREE_MORE: &str =
    "\"Repeated 3 times\" in the source's steps is read as three times more: four touches in all.";
pub const AS_MANY: &str = "The source repeats the steps as many times as there are touch points: the first touch counts among them.";
pub const VARIANT: &str = "In the rectangular variant the codes -60 to -62 are left out of the parameter table: the source has them for the \
                           angular one.";
pub const COUNTED: &str = "The source repeats the step of the further touches as many times as the measure count says: the first touch counts \
                           among them.";
pub const FEET: &str = "The start is one point at the clearances from the walls, and the first touch of each wall is its foot on that wall.";
pub const START_OUTSIDE: &str = "The source has the start at the clearances \"along orthogonal direction of their vectors\" of the first touches: it is taken \
                                 to lie outside, at clearance 1 from wall 1 and clearance 2 from wall 2.";
pub const PAIR: &str = "Touch point 1 is the wall in the first direction, 2 its opposite.";
pub const RECTANGULAR: &str = "Rectangular: touch point 2 lies opposite 1, 3 a quarter turn counter-clockwise from 1, 4 opposite 3.";
pub const ANGULAR: &str = "Angular: touch point k lies at start angle + (k - 1) angular steps, counter-clockwise from the first direction.";
pub const CIRCLE: &str = "The circle is one of least squares through the ball centres, larger or smaller by the ball radius. Programs of plain \
                          arithmetic take its normal equations.";
pub const COSINE_INSIDE: &str = "The control adds the ball radius along the probing direction, so a turned feature reads too wide: by \
                                 (W - d)(1/cos t - 1) for a width W, a ball diameter d and a turn t.";
pub const COSINE_OUTSIDE: &str = "The control takes the ball radius off along the probing direction, so a turned feature reads too wide: by \
                                  (W + d)(1/cos t - 1) for a width W, a ball diameter d and a turn t.";
pub const SINGLE: &str = "One pair of walls gives its middle only across the walls. The other coordinate of the middle is the nominal one, and is \
                          not given where the walls are parallel to an axis.";
pub const WALLS: &str = "Seen along the tool axis with rotation 0, wall 1 runs from the corner along the ordinate, and wall 2 the corner angle \
                         clockwise from it.";
pub const LINES: &str = "A wall with two touches or more is the line of total least squares through the ball centres, offset by the ball radius \
                         along its own normal; a wall with one touch keeps its nominal direction, and what needs its angle is not given.";
pub const TURN: &str = "`rotation` is how far wall 1 is turned from its nominal direction, counter-clockwise positive.";
pub const PLANES: &str = "Each surface keeps its nominal direction: one touch gives no angle. The corner is where the three planes meet.";

/// Our interpretation of protected holes and bosses.
pub const ROUND_PROTECTED: &[&str] = &[
    HEIGHTS,
    NORMAL,
    FEEDS,
    COMPENSATION,
    AS_MANY,
    RECTANGULAR,
    ANGULAR,
    VARIANT,
    CIRCLE,
];
