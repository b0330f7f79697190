//! Codes of findings with their meanings. Codes are stable: portals act on them.

/// Codes that describe a control or a form of its programs. They do not depend on the job.
pub const STANDING: &[&str] = &[
    "approach-not-watched",
    "no-results-in-program",
    "not-verified",
    "own-path",
    "positioning-not-watched",
    "units-not-stated",
];

/// Code and meaning, in the order of the codes.
pub const CODES: &[(&str, &str)] = &[
    (
        "align-needs-confirm",
        "1411: aligning the rotary axis (Q1126) needs the rotation confirmed (Q1121).",
    ),
    (
        "angle-rounded",
        "An angle has more decimals than the control's parameter; the program has it rounded.",
    ),
    (
        "approach-beyond-wall",
        "A clearance is so large that the start of a touch is behind the opposite wall.",
    ),
    (
        "approach-not-watched",
        "The approach to the first position is not watched, because the program does not know where the stylus starts.",
    ),
    (
        "arc-unsolved",
        "A spline, or an arc of a program whose centre or start is not known or whose end is not on its circle: it is drawn straight.",
    ),
    (
        "ask-unsupported",
        "A program in this form, or without results on the screen or tolerances, cannot wait for the operator before it writes.",
    ),
    (
        "ask-unused",
        "The program writes nothing, so it does not wait for the operator.",
    ),
    (
        "ball-too-wide",
        "The ball does not fit between the walls, or into the hole.",
    ),
    (
        "ball-unknown",
        "A dump has ball centres but not the ball's diameter: the default is used.",
    ),
    (
        "beyond-travel",
        "The path, or the search past a touch, leaves the travel of the machine that the portal's config states.",
    ),
    (
        "block-to-type",
        "grbl: the block that states the work offset, to be typed before anything moves.",
    ),
    (
        "block-too-long",
        "A block would be longer than the control reads: long names of cycles and sums of followed results cause this.",
    ),
    (
        "branch-ends",
        "A branch with an unknown condition ends the program: the run continues as if it were not taken.",
    ),
    (
        "circle-in-circle",
        "1411: one circle is wholly inside the other. Often a diameter in other units.",
    ),
    (
        "clear-too-low",
        "A set-up: the height between the cycles is lower than where one of them begins or ends.",
    ),
    (
        "clearance-height-too-low",
        "1411: the clearance height is not above the measuring height.",
    ),
    (
        "clearance-too-small",
        "A clearance leaves less than 0.01 mm between ball and wall: the touch would begin in contact.",
    ),
    ("code-twice", "A custom code is given more than once."),
    (
        "collision",
        "A positioning move or a retract hits the feature, nominal or displaced, or the stock.",
    ),
    (
        "contact-at-start",
        "A touch triggers so close to its start that the program treats the probe as still deflected, and stops.",
    ),
    (
        "converted",
        "Measured positions were converted from machine coordinates; the message gives the source of the offset.",
    ),
    (
        "crossing-too-low",
        "The ball crosses the part below its top side, through the material.",
    ),
    (
        "cycle-chooses-points",
        "The native cycle chooses its touches, so picked ones cannot be used.",
    ),
    (
        "cycle-differs",
        "The moves of the native cycle differ from the documented ones shown.",
    ),
    (
        "cycle-name",
        "A set-up: the name of a cycle is in use, or cannot be printed by a program.",
    ),
    (
        "cycle-no-lift",
        "The native cycle that only measures does not retract between its touches.",
    ),
    (
        "cycle-no-zone",
        "The native cycle needs a protection zone, and these clearances leave no room for it.",
    ),
    (
        "cycle-not-parallel",
        "The native cycle is called without a rotation, and this feature is rotated.",
    ),
    (
        "cycle-not-square",
        "The native cycle supports walls that are square to each other.",
    ),
    (
        "cycle-one-path",
        "The native cycle has one measuring path for all walls.",
    ),
    (
        "cycle-path-short",
        "The measuring path of the native cycle would be too short.",
    ),
    (
        "cycle-plane",
        "None of our sources shows how the native cycle handles a plane other than G17.",
    ),
    (
        "cycle-stops",
        "On the nominal part the native cycle would stop with an alarm.",
    ),
    (
        "datum-apart",
        "A set-up: with a rotation, X and Y must come from the same cycle.",
    ),
    (
        "datum-unknown",
        "A set-up: the chosen result cannot be written into this axis.",
    ),
    (
        "dist-needed",
        "How far the touches search is a value of the control's probe table: this much is needed there.",
    ),
    (
        "dist-too-short",
        "1411: DIST is shorter than the distance to the contact, so no touch reaches it.",
    ),
    (
        "division-by-zero",
        "A program divides by zero: a control stops there with an alarm.",
    ),
    (
        "dry-run-unsupported",
        "A dry run is a program of moves: the native cycle touches automatically.",
    ),
    (
        "edge-contact",
        "A touch contacts an edge or a rim instead of a face.",
    ),
    (
        "edition-not-stated",
        "A call has letters that one edition of Renishaw's macros refuses, and the job does not state the edition.",
    ),
    (
        "extrusion-direction",
        "1493 along this axis would run off a round object.",
    ),
    (
        "feeds-of-set-up",
        "A set-up: cycle 1411 uses the feeds of the job.",
    ),
    (
        "field-unused",
        "A value is given that programs for this control, or of this form, do not use.",
    ),
    (
        "form-unsupported",
        "The control does not support this cycle in this form; the message gives the reason.",
    ),
    (
        "given-incomplete",
        "1411: a given position (@) needs all three axes.",
    ),
    (
        "given-position",
        "1411: an object's position is given, so it is not probed.",
    ),
    (
        "header-unknown",
        "The header of a program has values that this cycle does not use.",
    ),
    (
        "header-unsound",
        "The job in a program's header has errors.",
    ),
    (
        "implausible",
        "On this part a result is off by more than its limit: a program that writes stops with an alarm first.",
    ),
    (
        "keep-out",
        "The ball, or the known part of the stylus above it, enters a keep-out zone of the portal's config.",
    ),
    (
        "length-not-along-tool-axis",
        "The tool length that the control uses does not act along the tool axis: the touches would be wrong by the stylus' length.",
    ),
    (
        "length-to-centre",
        "The tool axis of a work offset is written: the length of the probe must end at the ball centre.",
    ),
    (
        "lift-unused",
        "A lift is given, but the job is not a dry run.",
    ),
    (
        "limit-stops",
        "A result that deviates by more than its limit stops the native cycle with a message.",
    ),
    (
        "limits-not-asked",
        "The native cycle writes its results without checking the limits.",
    ),
    (
        "line-characters",
        "A line for the program has a character that is not printable ASCII.",
    ),
    (
        "lines-differ",
        "The blocks of a program are those of its job, and lines between them were changed.",
    ),
    (
        "lines-optional",
        "Lines of a program may be left out by the control (/): they are read.",
    ),
    (
        "lines-skipped",
        "Lines of a program that jump, call, compute, run a cycle or are not understood, or its axes other than X, Y and Z, were not followed: its other moves are shown.",
    ),
    (
        "locked",
        "The portal's config fixes this field at another value.",
    ),
    (
        "low-crossing",
        "The ball crosses below the top side of a pocket: an island would be hit.",
    ),
    (
        "low-rapid",
        "A rapid that nothing watches goes down or across below the clearance plane.",
    ),
    (
        "low-start",
        "The source knows no top side, and the path begins and ends only a little above the touches.",
    ),
    (
        "machine-places",
        "A program moves to positions in machine coordinates: their work coordinates are unknown.",
    ),
    (
        "macro-not-seen",
        "A macro that the program calls follows from the numbers of others: no source shows it on this control.",
    ),
    (
        "macro-stops",
        "A macro of the control's own ends a run with an alarm.",
    ),
    (
        "measured-twice",
        "The program makes its moves twice: it writes only when it measures again, after the operator has seen the results.",
    ),
    ("missing", "Something that a job needs is not there."),
    ("missing-code", "A dump lacks a code: the default is used."),
    (
        "missing-parameter",
        "A program lacks a parameter: the form's default is used.",
    ),
    (
        "mixed-forms",
        "A text of measured values has several kinds of them: which ones count is not clear.",
    ),
    (
        "modes-set",
        "Modes that an inserted program leaves active in the program around it.",
    ),
    ("more-findings", "More was found than is listed."),
    (
        "moves-before-cycle",
        "A Klartext program moves before its cycle: the stylus then does not start at the position in the job.",
    ),
    (
        "name-changed",
        "The job's name has characters that a program must not have; they are replaced there.",
    ),
    (
        "needs-calibration",
        "The native cycle requires another calibration of the probe.",
    ),
    (
        "nested-too-deeply",
        "JSON has more levels than any job: it is not read.",
    ),
    (
        "newer-format",
        "The job is of a newer format than this version reads.",
    ),
    (
        "no-arc",
        "1411: the touches of a circle lie on one spot, or too near to each other.",
    ),
    (
        "no-block",
        "grbl: no block for the work offset is given, since a result, the work offset or the position is not known.",
    ),
    (
        "no-circle",
        "Fewer than three touches stand apart: they give no circle.",
    ),
    (
        "no-contact",
        "A touch finds nothing before the end of its search on this part.",
    ),
    (
        "no-direction",
        "1411: both circles are at the same position, so the line through them has no direction.",
    ),
    (
        "no-extrusion",
        "1493 with a length of 0 repeats every touch on one spot.",
    ),
    (
        "no-job-in-program",
        "A program of moves contains no job: only its moves were read.",
    ),
    ("no-moves", "A text gives no move that can be read."),
    (
        "no-place",
        "No place for an inserted program is given or found.",
    ),
    (
        "no-results-in-program",
        "The control has no arithmetic: the program reports touches and computes nothing.",
    ),
    (
        "no-retract",
        "1411: the probe is not retracted between touches or objects, against the manual's advice.",
    ),
    (
        "no-touches",
        "A dump has no touch points: position and rotation of the feature are the defaults.",
    ),
    (
        "no-units",
        "A program does not state its units, or states them only below its first moves.",
    ),
    ("not-a-flag", "A value of a dump should be true or false."),
    (
        "not-a-number",
        "A value that should be a number is not one.",
    ),
    (
        "not-a-tolerance",
        "The tolerance of a result cannot be read, or its class does not exist for this size.",
    ),
    (
        "not-a-value",
        "A nominal value is neither a number nor one of the texts that are known.",
    ),
    (
        "not-allowed",
        "The portal's config does not allow this choice or this value.",
    ),
    (
        "not-at-feed",
        "A touch begins so close to its contact that the axes are still accelerating there: the probe was calibrated at the full feed.",
    ),
    (
        "not-called",
        "A subroutine that nothing in its text calls is shown, with arguments that are not known.",
    ),
    ("not-finite", "A number is infinite or NaN."),
    (
        "not-in-dump",
        "Values that a dump does not give are defaults.",
    ),
    (
        "not-in-program",
        "Values that a program does not give are defaults.",
    ),
    (
        "not-inserted",
        "A program cannot be inserted there: because of the control, the language, the units, the labels, or the state of the other program.",
    ),
    ("not-json", "The text is not JSON."),
    (
        "not-known",
        "A program of moves needs a value that only the control has.",
    ),
    (
        "not-on-one-circle",
        "Picked touches do not lie on one circle.",
    ),
    ("not-on-one-wall", "Picked touches do not lie on one wall."),
    (
        "not-proven",
        "A program of moves, read back, does not match its path and is refused. A fault in Touchpath: please report it.",
    ),
    (
        "not-rectangular",
        "The variant with four touches has picked touches that are not at right angles.",
    ),
    (
        "not-understood",
        "A line of a program is outside the part of the language read here.",
    ),
    (
        "not-verified",
        "The program was not run on a control of this kind.",
    ),
    ("not-whole", "A number should be whole."),
    (
        "nothing-switched",
        "The cycle only has rows in the parameter table: its program switches and moves nothing.",
    ),
    ("nothing-to-import", "No job can be made of the text."),
    (
        "nothing-to-write",
        "The cycle measures nothing that can be written into a work offset.",
    ),
    (
        "number-protected",
        "A program number from 8000 to 9999 is usually protected on the control, or that of a macro.",
    ),
    (
        "number-unused",
        "A program number is given for a control whose programs have no number.",
    ),
    (
        "offset-in-parts",
        "Native cycles write the axes of a work offset one after the other.",
    ),
    (
        "offset-measured-again",
        "The native cycle writes an axis that is measured again afterwards, in the shifted system.",
    ),
    (
        "offset-one-direction",
        "A work offset gets more axes than the touches have directions: a shift across them is not seen.",
    ),
    (
        "offset-optional",
        "The work offset is an option of the control: one without it raises an alarm.",
    ),
    (
        "order-of-cycles",
        "The part height is measured after features whose depth depends on it.",
    ),
    (
        "orient-unsupported",
        "The program of this control cannot turn the spindle to an angle.",
    ),
    (
        "other-control",
        "The job specifies another control than the host page or the option `--post`.",
    ),
    (
        "other-form",
        "The control does not support the job in this form of program, but in the other.",
    ),
    (
        "other-units",
        "The job specifies other units than the host page.",
    ),
    ("other-version", "Another version wrote the program."),
    ("out-of-range", "A number is outside the allowed range."),
    (
        "out-of-tolerance",
        "On this part a result is out of a tolerance on which the program acts.",
    ),
    (
        "overtravel-too-short",
        "The native cycle cannot search so little past the contact.",
    ),
    (
        "own-codes",
        "A dump has more custom codes than a job can have, or one of them twice.",
    ),
    (
        "own-moves",
        "The moves of macros of the control's own are those of one edition.",
    ),
    (
        "own-path",
        "The moves shown are those of the native cycles.",
    ),
    (
        "pairs-not-square",
        "The two pairs of picked walls are not square to each other.",
    ),
    (
        "part-not-in-program",
        "A program does not contain the part's position: the nominal part is assumed.",
    ),
    (
        "passed-over",
        "Blocks of a program that are not about the cycle were ignored.",
    ),
    (
        "passes-close",
        "A positioning move passes the drawn part closely: on a part that is a little displaced, it makes contact.",
    ),
    (
        "path-not-above",
        "The path would end below its highest point: one touch is too high compared with the others.",
    ),
    (
        "picks-differ",
        "A size in the form differs from the one between the picked touches, which counts.",
    ),
    (
        "picks-out-of-range",
        "Picked touches give a size outside the allowed range.",
    ),
    (
        "place-of-result",
        "A set-up: a position, rotation or size of a cycle has a result that it cannot follow.",
    ),
    (
        "place-too-far",
        "A set-up: on this part a result is so far off that the program stops before the cycle that follows it.",
    ),
    (
        "places-computed",
        "A program moves to positions that the control computes, or along a tool whose length was changed: they are unknown until the program gives a number.",
    ),
    (
        "places-transformed",
        "A program moves its coordinate system by an amount that is not known, mirrors, scales or tilts it, or compensates the radius of the tool: positions are as they are written.",
    ),
    (
        "plane-from-dump",
        "The plane was found from the points of a dump.",
    ),
    (
        "plane-unknown",
        "The points of a dump fit several planes, or no plane.",
    ),
    (
        "plane-unsupported",
        "The control supports no program for this plane.",
    ),
    (
        "points-differ",
        "The used points of a dump (-100 and following) differ from the original ones (-200): the used ones count.",
    ),
    ("portal", "A finding of the portal itself."),
    (
        "positioning-not-watched",
        "A contact in a positioning move goes unnoticed.",
    ),
    (
        "predefined",
        "A value comes from the control (PREDEF): the form's number only serves the picture.",
    ),
    (
        "probe-move-too-short",
        "Older interpreters of LinuxCNC refuse probe moves this short.",
    ),
    (
        "probe-word",
        "A probing block has a word that means something else on each control: name the control.",
    ),
    (
        "probing-too-fast",
        "A probing move is not below the feed limit in a manual of the control's maker.",
    ),
    (
        "program-differs",
        "A program is not the one that the job in its header makes.",
    ),
    (
        "program-stops",
        "A program stops itself with a message or an alarm.",
    ),
    (
        "protection-unsupported",
        "The control supports only programs with watched positioning.",
    ),
    (
        "rapid-at-feed",
        "A rapid runs at a feed, because it is watched or goes down.",
    ),
    (
        "reaction-unsupported",
        "A program of moves checks no tolerances, and so does not react to them (Q309).",
    ),
    (
        "relation-not-computed",
        "A set-up: the program does not compute the relations. They are computed from its results, entered as measured values.",
    ),
    (
        "relation-of",
        "A relation has an operand of a type that it does not accept.",
    ),
    (
        "repeat-unsupported",
        "Each point is to be touched several times, which neither a native cycle nor extrusion probing supports.",
    ),
    (
        "result-missing",
        "A text with results lacks some of the job's.",
    ),
    ("result-twice", "A text gives two values of one result."),
    (
        "result-untrue",
        "On this part the control stores values that differ from the true ones.",
    ),
    (
        "rotary-unsupported",
        "A program of moves does not turn a rotary table.",
    ),
    (
        "rotation-not-written",
        "A rotation is measured, but the work offset cannot store it.",
    ),
    (
        "rotation-unsupported",
        "The control cannot write this rotation into a work offset.",
    ),
    (
        "row-activated",
        "A row of the preset table is written and activated with its other values.",
    ),
    (
        "row-active",
        "Native cycles write a row of the preset table before others measure: the row must not be active at the start.",
    ),
    (
        "rule-broken",
        "A program breaks a mandatory safety rule: it is refused. This is a fault in Touchpath: please report it.",
    ),
    (
        "search-too-short",
        "A touch searches so little past its nominal contact that the control could not tell its contact from its end.",
    ),
    (
        "semi-automatic",
        "1411: the operator moves the probe to this object; no path can be shown.",
    ),
    (
        "semi-automatic-unsupported",
        "A semi-automatic object needs the native cycle.",
    ),
    (
        "set-up-too-long",
        "The probe table's SET_UP and the ball's radius are more than a clearance of the job.",
    ),
    (
        "set-up-unsupported",
        "A set-up: a cycle or the control does not support set-ups; the message gives the reason.",
    ),
    (
        "several-cycles",
        "The text has several cycles: the first is used.",
    ),
    (
        "shank-collision",
        "The shank or the probe body above the ball hits the feature, nominal or displaced, or the stock.",
    ),
    (
        "shop-line",
        "A line of the shop (`machine.frame`) cannot be at its place, or a placeholder in it has no value.",
    ),
    (
        "shop-lines-unknown",
        "Lines of the shop that Touchpath does not understand: they are in the program, and are not checked.",
    ),
    (
        "shop-lines-unused",
        "Lines of the shop at a place that this program does not have: they are left out.",
    ),
    (
        "short-arc",
        "1411: over so short an arc the centre is uncertain.",
    ),
    (
        "signs-contradict",
        "A program has blocks of two controls: the user chooses the control.",
    ),
    (
        "small-hole",
        "1411: the hole is smaller than the set-up clearance; the control shows a message and starts from its centre.",
    ),
    (
        "start-in-feature",
        "The path would begin and end inside the feature; the message gives the smallest feed distance.",
    ),
    (
        "start-unknown",
        "Incremental moves of a program start from an unknown position: 0 is assumed.",
    ),
    (
        "starts-disagree",
        "Picked touches and their clearances give several positions for the start of the cycle.",
    ),
    (
        "stops-too-late",
        "At this feed the axes need more distance to stop after a contact than the stylus survives.",
    ),
    (
        "stylus-from-dump",
        "The ball's diameter was found from the used and the original points of a dump.",
    ),
    (
        "stylus-not-known",
        "The stylus above its ball, or the height of the part, is not known: whether shank and body clear the part is not checked.",
    ),
    ("text-too-long", "The text is longer than the limit."),
    (
        "tolerance-beyond-limit",
        "A tolerance extends beyond the plausibility limit.",
    ),
    (
        "tolerance-elsewhere",
        "A tolerance contains a nominal value that differs from that of the result.",
    ),
    (
        "tolerance-unknown",
        "A tolerance is of a result that this job does not have.",
    ),
    (
        "tolerance-unsupported",
        "This result has no tolerance, or the program cannot act on it.",
    ),
    (
        "too-far",
        "A measured point is farther from its touch than the touch can reach.",
    ),
    ("too-long", "A text is longer than its field allows."),
    (
        "too-many-digits",
        "A position is so far away that its numbers need more digits than a control accepts.",
    ),
    (
        "too-many-registers",
        "The program would need more variables than the control has.",
    ),
    (
        "too-many-touches",
        "More touches than the parameter table has room for.",
    ),
    (
        "tool-axis-reversed",
        "The tool's first length acts against the tool axis.",
    ),
    (
        "tool-by-name",
        "The tool is called by its name: its number is not known.",
    ),
    (
        "tool-corrected",
        "What the macro makes of a tool offset on the virtual part.",
    ),
    (
        "tool-length-unchecked",
        "The program does not check along which axis the length of the tool acts.",
    ),
    (
        "tool-unused",
        "The program neither calls the tool of the probe nor checks that it is in the spindle.",
    ),
    ("touch-above-top", "A picked touch is above the top side."),
    (
        "touch-aside",
        "A touch is not straight in front of the middle that its cycle touches from.",
    ),
    (
        "touch-askew",
        "A touch would run askew of its inverted target vector.",
    ),
    (
        "touch-beyond-corner",
        "In a touch of a corner the ball would contact the other wall first.",
    ),
    (
        "touch-close",
        "A touch begins close to its nominal contact: on a part that is a little displaced, the move before it makes contact.",
    ),
    (
        "touch-fast",
        "A touch of a program is so fast that the axes run on for more than a millimetre after the contact.",
    ),
    (
        "touch-missed",
        "A touch makes no contact: of a log, results that need it are unknown; of a program, the control stops there with an alarm.",
    ),
    (
        "touch-missing",
        "A touch would not be in the path, or not once.",
    ),
    (
        "touch-near-edge",
        "The ball is touched above its middle, at the edge of the top side.",
    ),
    (
        "touch-too-short",
        "A touch would begin too near to its contact.",
    ),
    ("touches-coincide", "Two touches lie on one spot."),
    (
        "touches-kept",
        "The touches of a dump do not follow from its dimensions: they stay as picked touches.",
    ),
    (
        "touches-not-level",
        "Picked touches of one feature lie at different heights.",
    ),
    (
        "touches-unsound",
        "The touches of the dump do not define its feature; the job's other findings say why.",
    ),
    (
        "turn-beyond-limit",
        "A set-up: on a part that is rotated by the angle limit, a cycle deviates by more than its position limit.",
    ),
    (
        "uncertain-result",
        "A result scatters by many times as much as a single touch.",
    ),
    (
        "unclear-line",
        "A line of measured values could be one of them, and cannot be read as the others are.",
    ),
    (
        "units-differ",
        "The blocks of a program are in other units than the job in its header, which was converted.",
    ),
    (
        "units-found",
        "A log does not state whether it is in mm or in inch: it is read in the unit that is in reach of the touches.",
    ),
    (
        "units-not-stated",
        "Programs of this control cannot state their units: the machine must be set to them.",
    ),
    (
        "units-unclear",
        "Whether a log is in mm or in inch is not clear.",
    ),
    (
        "units-unknown",
        "The text does not state its units: mm is assumed.",
    ),
    (
        "unknown-code",
        "A dump has a code that its cycle does not know.",
    ),
    ("unknown-key", "An object has a key that is not known."),
    (
        "unknown-parameter",
        "A program has a parameter that its cycle does not know.",
    ),
    (
        "unknown-result",
        "A text gives a result that the job does not have.",
    ),
    (
        "unknown-type",
        "A dump has a type number that is not known.",
    ),
    ("unknown-value", "The value is not one of those allowed."),
    (
        "unreadable",
        "A value cannot be read at all, as a revoked proxy in JavaScript.",
    ),
    (
        "unsafe-program",
        "A program moves unwatched, or lacks a check.",
    ),
    (
        "unusable",
        "The form cannot show a job: the message gives the part.",
    ),
    ("unusual", "A number is allowed, but unusual."),
    (
        "variables-shared",
        "An inserted program changes variables that the program around it uses.",
    ),
    (
        "vector-not-in-plane",
        "A target vector must lie in the working plane.",
    ),
    ("vector-not-unit", "A target vector must have the length 1."),
    (
        "vector-not-upwards",
        "A target vector must point along the tool axis.",
    ),
    (
        "vector-wrong-way",
        "A target vector must point out of the material, towards the ball.",
    ),
    (
        "vectors-not-opposite",
        "Touches that should be opposite have target vectors that are not.",
    ),
    (
        "walls-parallel",
        "Walls of a corner are parallel, or nearly so.",
    ),
    (
        "wear-off-middle",
        "A tool is corrected towards the nominal value, and that is not the middle of the tolerance.",
    ),
    (
        "wear-unlimited",
        "A tool is corrected by a size that has no limit.",
    ),
    (
        "wear-unsupported",
        "No tool can be corrected by this result, or on this control.",
    ),
    (
        "words-twice",
        "A block of a program has two motions, or two positions along an axis: the last is read.",
    ),
    (
        "work-offset-needed",
        "A log has machine coordinates and does not state the work offset: the message gives what to add.",
    ),
    (
        "work-offset-unclear",
        "A log states two work offsets: which one the touches were made in is unclear.",
    ),
    (
        "work-offset-unsupported",
        "The control cannot write a work offset from a program, or not this one.",
    ),
    (
        "wrong-code",
        "A custom code must be a whole number above 0.",
    ),
    (
        "wrong-count",
        "There are too few or too many of something: touches, points, numbers in a line.",
    ),
    ("wrong-type", "A value is not of its field's type."),
    (
        "wrong-wall",
        "On this part a touch contacts another wall than its own.",
    ),
    (
        "zone-beyond-clearance",
        "Even a part within tolerance is in the way where the ball descends.",
    ),
    (
        "zone-beyond-dist",
        "A part within tolerance can be beyond the search: a good part can be missed.",
    ),
];

pub fn is_listed(code: &str) -> bool {
    CODES
        .binary_search_by_key(&code, |(listed, _)| listed)
        .is_ok()
}
