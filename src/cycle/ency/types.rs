//! The cycles of the family, one row each. [`forms`] has their fields.

use crate::cycle::ency::{self, Dimensions, forms, words};
use crate::cycle::{CycleDef, REPEAT};
use crate::path::{FeatureKind, MAX_TOUCHES};

/// Builds the row of a cycle: its number in the source, its name in the parameter table, and the function that reads its dimensions.
macro_rules! row {
    ($number:literal, $name:literal, $dimensions:expr) => {
        CycleDef {
            source: concat!("ENCY/SprutCAM type ", $number),
            number: Some($number),
            place: Some(|section, picks, plane| ency::place(section, $dimensions, picks, plane)),
            read: |def, section| ency::read(def, section, $name, $dimensions),
            ..ency::BASE
        }
    };
}

/// NC action: ENCY / SprutCAM type 1. Rows of the table, no motion.
pub static NC_ACTION: CycleDef = CycleDef {
    key: "nc-action",
    title: "NC action",
    summary: "Rows of the parameter table that a postprocessor acts on; nothing moves.",
    search_words: "postprocessor offset report",
    name: "NC-ACTION",
    probes: FeatureKind::Action,
    most_touches: 0,
    fields: forms::NcAction::FIELDS,
    sections: &[ency::PROPERTIES],
    interpretations: &[
        "Nothing moves. What the action does is the postprocessor's, by SubCode and properties.",
    ],
    place: None,
    ..row!(1, "NC action", |section| Dimensions::unmoving(
        &forms::NcAction::read(section)
    ))
};

/// Probe on/off: ENCY / SprutCAM type 0. Rows of the table, no motion.
pub static PROBE_ON_OFF: CycleDef = CycleDef {
    key: "probe-on-off",
    title: "Probe on/off",
    summary: "Switches the probe on or off in a postprocessor; nothing moves.",
    search_words: "switch activate",
    name: "PROBE-ON-OFF",
    probes: FeatureKind::Switch,
    most_touches: 0,
    fields: forms::ProbeOnOff::FIELDS,
    sections: &[],
    interpretations: &[
        "Nothing moves, so that a program of plain moves states its modes and ends. How a machine's probe is switched on is up \
                 to its builder, and is not guessed.",
    ],
    place: None,
    ..row!(0, "probe on/off", |section| Dimensions::unmoving(
        &forms::ProbeOnOff::read(section)
    ))
};

/// One touch along the target vector, on a wall, a top side or anything between.
pub static SURFACE: CycleDef = CycleDef {
    key: "surface",
    title: "Surface",
    summary: "One touch of a face, a wall or the top, in X, Y or Z: where it is.",
    search_words: "face plane top edge Z single point height parallels vise jaw",
    name: "SURFACE",
    probes: FeatureKind::Surface,
    most_touches: 1,
    fields: forms::Surface::FIELDS,
    steps: &[
        "To the feed distance above the start, then down to the start: the clearance in front of the touch point along its target vector",
        "Touch",
        "Back to the start",
        "Up by the feed distance",
    ],
    interpretations: &[
        "The clearance is measured from the surface to the ball centre; the feed distance is along the tool axis.",
        words::NORMAL_OF_SURFACE,
        words::COMPENSATION,
        "The measured point is the nominal one, moved along the target vector: across it nothing is measured.",
        "Rotation and elevation are ours: the source has the target vector only.",
    ],
    ..row!(2, "surface probing", |section| forms::Surface::read(
        section
    )
    .dimensions())
};

/// All touches from the centre. The ball enters from above or moves there directly.
pub static HOLE: CycleDef = CycleDef {
    key: "hole",
    title: "Hole",
    summary: "A bore or a ring: centre and diameter, touched from the centre.",
    search_words: "bore ring inside diameter circle",
    name: "BORE",
    probes: FeatureKind::Hole,
    most_touches: MAX_TOUCHES,
    fields: forms::Hole::FIELDS,
    steps: words::FROM_CENTRE,
    interpretations: &[
        words::HEIGHTS,
        words::NORMAL,
        words::WAY_BACK,
        words::AS_MANY,
        words::RECTANGULAR,
        words::ANGULAR,
        words::VARIANT,
        words::CIRCLE,
        words::UNCHECKED,
    ],
    ..row!(3, "hole probing", |section| forms::Hole::read(section)
        .dimensions())
};

/// The stylus enters from above for each touch, so that it does not hit an island in the middle.
pub static HOLE_PROTECTED: CycleDef = CycleDef {
    key: "hole-protected",
    title: "Hole, protected",
    summary: "A bore with an island in the middle: the probe moves up and over it between the touches.",
    search_words: "bore ring island inside diameter circle over",
    name: "BORE",
    probes: FeatureKind::HoleProtected,
    most_touches: MAX_TOUCHES,
    fields: forms::RoundProtected::FIELDS,
    steps: &words::protected(
        "To the feed distance above the start, then down to the start: the centre, top clearance above the top side",
        "Steps 2 to 6 once more for each touch point that is left",
    ),
    interpretations: words::ROUND_PROTECTED,
    ..row!(4, "hole probing protected", |section| {
        forms::RoundProtected::read(section).dimensions(true)
    })
};

/// A stud, touched from outside.
pub static BOSS: CycleDef = CycleDef {
    key: "boss",
    title: "Boss",
    summary: "A stud, pin or shaft from outside: centre and diameter.",
    search_words: "stud pin shaft spigot outside diameter round",
    name: "BOSS",
    probes: FeatureKind::Boss,
    most_touches: MAX_TOUCHES,
    fields: forms::RoundProtected::FIELDS,
    steps: &words::protected(
        "To the feed distance above the start, then down to the start: over the centre, top clearance above the top side",
        "Steps 2 to 6 once more for each touch point that is left",
    ),
    interpretations: words::ROUND_PROTECTED,
    ..row!(5, "boss probing", |section| forms::RoundProtected::read(
        section
    )
    .dimensions(false))
};

/// Four touches from the centre, one on each wall.
pub static INTERNAL_RECTANGLE: CycleDef = CycleDef {
    key: "internal-rectangle",
    title: "Internal rectangle",
    summary: "A pocket: centre, length and width, touched from the centre.",
    search_words: "pocket window inside",
    name: "POCKET",
    probes: FeatureKind::Pocket,
    most_touches: 4,
    fields: forms::InternalRectangle::FIELDS,
    steps: words::FROM_CENTRE,
    interpretations: &[
        words::HEIGHTS,
        words::NORMAL,
        words::WAY_BACK,
        words::THREE_MORE,
        words::RECTANGLE,
        words::COSINE_INSIDE,
        words::UNCHECKED,
    ],
    ..row!(6, "internal rectangle probing", |section| {
        forms::InternalRectangle::read(section).dimensions()
    })
};

/// Four touches from inside, one on each wall. The stylus enters from above for each of them, so that it does not hit an island in the middle.
pub static INTERNAL_RECTANGLE_PROTECTED: CycleDef = CycleDef {
    key: "internal-rectangle-protected",
    title: "Internal rectangle, protected",
    summary: "A pocket with an island in the middle: the probe moves up and over it between the touches.",
    search_words: "pocket window island inside over",
    name: "POCKET",
    probes: FeatureKind::PocketProtected,
    most_touches: 4,
    fields: forms::RectangleProtected::FIELDS,
    steps: &words::protected(
        "To the feed distance above the start, then down to the start: the centre, top clearance above the top side",
        "Steps 2 to 6 three times more, once for each touch point that is left",
    ),
    interpretations: &[
        words::HEIGHTS,
        words::NORMAL,
        words::FEEDS,
        words::COMPENSATION,
        words::THREE_MORE,
        words::RECTANGLE,
        words::COSINE_INSIDE,
    ],
    ..row!(7, "internal rectangle probing protected", |section| {
        forms::RectangleProtected::read(section).dimensions(true)
    })
};

/// A block, touched from outside, one touch on each wall.
pub static EXTERNAL_RECTANGLE: CycleDef = CycleDef {
    key: "external-rectangle",
    title: "External rectangle",
    summary: "A block or an island from outside: centre, length and width.",
    search_words: "island block stock part outside vise",
    name: "BLOCK",
    probes: FeatureKind::Block,
    most_touches: 4,
    fields: forms::RectangleProtected::FIELDS,
    steps: &words::protected(
        "To the feed distance above the start, then down to the start: over the centre, top clearance above the top side",
        "Steps 2 to 6 three times more, once for each touch point that is left",
    ),
    interpretations: &[
        words::HEIGHTS,
        words::NORMAL,
        words::FEEDS,
        words::COMPENSATION,
        words::RECTANGLE,
        words::COSINE_OUTSIDE,
    ],
    ..row!(8, "external rectangle probing", |section| {
        forms::RectangleProtected::read(section).dimensions(false)
    })
};

/// A rib, touched on both sides.
pub static WEB: CycleDef = CycleDef {
    key: "web",
    title: "Web",
    summary: "A rib from both sides: its middle and its width.",
    search_words: "rib ridge bar wall outside width",
    name: "WEB",
    probes: FeatureKind::Web,
    most_touches: 2,
    fields: forms::PairProtected::FIELDS,
    steps: &words::protected(
        "To the feed distance above the start, then down to the start: over the middle, top clearance above the top side",
        "Steps 2 to 6 for the second touch point",
    ),
    interpretations: &[
        words::HEIGHTS,
        words::NORMAL,
        words::FEEDS,
        words::COMPENSATION,
        words::PAIR,
        words::COSINE_OUTSIDE,
        words::SINGLE,
    ],
    ..row!(9, "web probing", |section| forms::PairProtected::read(
        section
    )
    .dimensions(false))
};

/// A rib, touched on both sides and on top.
pub static WEB_THREE_POINTS: CycleDef = CycleDef {
    key: "web-three-points",
    title: "Web, three points",
    summary: "A rib from both sides and on top: its middle, its width and its height.",
    search_words: "rib ridge bar wall outside width top Z",
    name: "WEB",
    probes: FeatureKind::WebTop,
    most_touches: 3,
    fields: forms::WebThreePoints::FIELDS,
    steps: &[
        "To the feed distance above the start, then down to the start: the middle clearance above the middle touch point",
        "At the height of the start, across to the side clearance from the left touch point",
        "Down to the level of the touch",
        "Touch, and back to where the touch began",
        "Up to the height of the start",
        "Back to the start",
        "Steps 2 to 6 for the right touch point",
        "Touch the middle point, and back",
        "Up by the feed distance",
    ],
    interpretations: &[
        words::HEIGHTS,
        words::NORMAL,
        words::FEEDS,
        words::COMPENSATION,
        "The source's steps name a top clearance that this cycle has no code for: the ball crosses at the height of the start, the middle \
         clearance above the top side.",
        "The left touch point is the one against the first direction, the right one in it.",
        words::COSINE_OUTSIDE,
        words::SINGLE,
    ],
    ..row!(10, "web probing (three points)", |section| {
        forms::WebThreePoints::read(section).dimensions()
    })
};

/// Both walls of a groove, from its middle.
pub static GROOVE: CycleDef = CycleDef {
    key: "groove",
    title: "Groove",
    summary: "A slot, or the gap between two jaws: its middle and its width, touched from the middle.",
    search_words: "slot keyway channel gap inside width vise jaws",
    name: "GROOVE",
    probes: FeatureKind::Groove,
    most_touches: 2,
    fields: forms::Groove::FIELDS,
    steps: &[
        "With the top clearance checked: to the feed distance above it, down to it over the middle, then down to the middle at the depth",
        "With the top clearance not checked: to the feed distance above the middle at the depth, then down to it",
        "Touch, and back to the middle, once for each touch point",
        "With the top clearance checked: up by top clearance and depth",
        "Up to the feed distance",
    ],
    interpretations: &[
        words::HEIGHTS,
        words::NORMAL,
        words::WAY_BACK,
        words::PAIR,
        words::COSINE_INSIDE,
        words::SINGLE,
        words::UNCHECKED,
    ],
    ..row!(11, "groove probing", |section| forms::Groove::read(section)
        .dimensions())
};

/// Both walls of a groove; the stylus enters from above for each touch.
pub static GROOVE_PROTECTED: CycleDef = CycleDef {
    key: "groove-protected",
    title: "Groove, protected",
    summary: "A slot with an island in it: the probe moves up and over it between the touches.",
    search_words: "slot keyway channel gap island inside width over",
    name: "GROOVE",
    probes: FeatureKind::GrooveProtected,
    most_touches: 2,
    fields: forms::PairProtected::FIELDS,
    steps: &words::protected(
        "To the feed distance above the start, then down to the start: the middle, top clearance above the top side",
        "Steps 2 to 6 for the second touch point",
    ),
    interpretations: &[
        words::HEIGHTS,
        words::NORMAL,
        words::FEEDS,
        words::COMPENSATION,
        words::PAIR,
        words::COSINE_INSIDE,
        words::SINGLE,
    ],
    ..row!(12, "groove probing protected", |section| {
        forms::PairProtected::read(section).dimensions(true)
    })
};

/// Both walls of an inside corner, each touched once or more, from one start inside. From the first to the last move the ball stays at the level of the
/// touches.
pub static DOUBLE_WALL_INTERNAL_CORNER: CycleDef = CycleDef {
    key: "double-wall-internal-corner",
    title: "Double wall internal corner",
    summary: "The inside corner of two walls: where they meet, and the angle of each wall that is touched twice.",
    search_words: "inside corner edge wall angle rotation skew fixture stop vise",
    name: "CORNER",
    probes: FeatureKind::CornerInside,
    most_touches: MAX_TOUCHES,
    fields: forms::DoubleWallInternalCorner::FIELDS,
    steps: &[
        "To the feed distance above the start, then down to the start: clearance 1 from wall 1 and clearance 2 from wall 2",
        "Touch the first point of wall 1, and back",
        "If wall 1 has more points: to clearance 1 from the next one, touch, and back",
        "Step 3 until every point of wall 1 is touched",
        "Back to the start",
        "Touch the first point of wall 2, and back",
        "If wall 2 has more points: to clearance 2 from the next one, touch, and back",
        "Step 7 until every point of wall 2 is touched",
        "Back to the start",
        "Up by the feed distance",
    ],
    interpretations: &[
        words::HEIGHTS,
        words::NORMAL,
        words::ALONG,
        words::COUNTED,
        words::FEET,
        words::WALLS,
        words::LINES,
        words::TURN,
    ],
    ..row!(13, "double wall internal corner probing", |section| {
        forms::DoubleWallInternalCorner::read(section).dimensions()
    })
};

/// Both walls of an outside corner, each touched once or more, from one start outside.
pub static DOUBLE_WALL_EXTERNAL_CORNER: CycleDef = CycleDef {
    key: "double-wall-external-corner",
    title: "Double wall external corner",
    summary: "The outside corner of a part: where its two walls meet, and the angle of each wall that is touched twice.",
    search_words: "outside corner edge wall angle rotation skew stock part vise",
    name: "CORNER",
    probes: FeatureKind::CornerOutside,
    most_touches: MAX_TOUCHES,
    fields: forms::DoubleWallExternalCorner::FIELDS,
    steps: &[
        "To the feed distance above the start, then down to the start: clearance 1 from wall 1 and clearance 2 from wall 2, outside",
        "To clearance 1 from the first point of wall 1, touch, and back",
        "If wall 1 has more points: to clearance 1 from the next one, touch, and back",
        "Step 3 until every point of wall 1 is touched",
        "Back to the start",
        "To clearance 2 from the first point of wall 2, touch, and back",
        "If wall 2 has more points: to clearance 2 from the next one, touch, and back",
        "Step 7 until every point of wall 2 is touched",
        "Back to the start",
        "Up by the feed distance",
    ],
    interpretations: &[
        words::HEIGHTS,
        words::NORMAL,
        words::ALONG,
        words::COMPENSATION,
        words::COUNTED,
        words::START_OUTSIDE,
        words::WALLS,
        "The distances from the corner to the first touches are ours: the source has the touch points only.",
        words::LINES,
        words::TURN,
    ],
    ..row!(14, "double wall external corner probing", |section| {
        forms::DoubleWallExternalCorner::read(section).dimensions()
    })
};

/// Two walls and the floor of a pocket, each touched once from one start inside.
pub static TRIPLE_WALL_INTERNAL_CORNER: CycleDef = CycleDef {
    key: "triple-wall-internal-corner",
    title: "Triple wall internal corner",
    summary: "The inside corner of two walls and a floor: X, Y and Z of the corner.",
    search_words: "inside corner edge wall floor Z fixture stop vise",
    name: "CORNER",
    probes: FeatureKind::TripleInside,
    most_touches: 3,
    fields: forms::TripleWallInternalCorner::FIELDS,
    steps: &[
        "To the feed distance above the start, then down to the start: each clearance away from its surface",
        "Touch the first wall, and back",
        "Touch the second wall, and back",
        "Touch the third wall, and back",
        "Up by the feed distance",
    ],
    interpretations: &[
        words::HEIGHTS,
        words::NORMAL,
        words::LAST_LIFT,
        words::FEET,
        words::WALLS,
        "By its dimensions the third wall is the floor, square to the tool axis; picked touches may have any direction.",
        words::PLANES,
    ],
    ..row!(15, "triple wall internal corner probing", |section| {
        forms::TripleWallInternalCorner::read(section).dimensions()
    })
};

/// Two walls and the top side of a block, each touched once.
pub static TRIPLE_WALL_EXTERNAL_CORNER: CycleDef = CycleDef {
    key: "triple-wall-external-corner",
    title: "Triple wall external corner",
    summary: "The outside corner of a part and its top: X, Y and Z of the corner.",
    search_words: "outside corner edge wall top Z stock part vise",
    name: "CORNER",
    probes: FeatureKind::TripleOutside,
    most_touches: 3,
    fields: forms::TripleWallExternalCorner::FIELDS,
    steps: &[
        "To the feed distance above the start, then down to the start: outside, clearance 1 from wall 1 and clearance 2 from wall 2, top clearance above the top side",
        "To clearance 1 from the point of wall 1, touch, and back",
        "Back to the start",
        "To clearance 2 from the point of wall 2, touch, and back",
        "Back to the start",
        "To the top clearance over the point of the top side, touch, and back",
        "Back to the start",
        "Up by the feed distance",
    ],
    interpretations: &[
        words::HEIGHTS,
        words::NORMAL,
        words::LAST_LIFT,
        words::START_OUTSIDE,
        words::WALLS,
        "The distances to the touches are ours: the source has the touch points only.",
        words::PLANES,
    ],
    ..row!(16, "triple wall external corner probing", |section| {
        forms::TripleWallExternalCorner::read(section).dimensions()
    })
};

/// Two touches of one wall. ENCY's family has them only as a part of its corners.
pub static WALL_ANGLE: CycleDef = CycleDef {
    key: "wall-angle",
    title: "Angle of a wall",
    summary: "A straight wall or jaw, touched twice: its rotation.",
    search_words: "rotation skew edge fence vise jaw parallel align basic rotation",
    name: "WALL",
    probes: FeatureKind::Wall,
    most_touches: 2,
    fields: forms::WallAngle::FIELDS,
    sections: &[REPEAT],
    steps: &[
        "To the feed distance above the start, then down to the start: the clearance in front of the middle of the wall",
        "Along the wall, to the clearance in front of the touch point",
        "Touch, and back to the clearance; then step 2 for the other touch point",
        "Back to the start",
        "Up by the feed distance",
    ],
    interpretations: &[
        "The cycle is ours: two touches at one height, half the distance to either side of the middle of the wall.",
        "Across the wall nothing but its direction is measured: where it is, a Surface says.",
        words::NORMAL_OF_SURFACE,
    ],
    source: "Touchpath",
    read: |def, section| {
        ency::read(def, section, "", |section| {
            forms::WallAngle::read(section).dimensions()
        })
    },
    ..ency::BASE
};
