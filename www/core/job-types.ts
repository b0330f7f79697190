// Generated from the crate's one list of fields: `UPDATE=1 cargo test --lib generated` writes it.

/** Lengths are in the job's units, feeds in units a minute, angles in degrees, counter-clockwise positive. */

/** X, Y, Z of the work coordinate system. */
export type Vec3 = [number, number, number];

/** A feed; `null` is rapid. */
export type FeedRate = number | null;

/** A number, or text: `10H7`, `10m`, `10+0.01-0.015`, `?`, `?10`, `10@10.02`. */
export type Nominal = number | string;

/** A size: a number, or text with its tolerance, `25 H7`, `25 +0.021 0`, `25 ±0.05`. In a set-up it may follow a result, `=BORE.diameter-2`. */
export type Size = number | string;

/** A picked touch: a point on the surface, and its outward normal, a unit vector. */
export interface PickedTouch {
  point: Vec3;
  vector: Vec3;
}

/** A code of the user, passed on unchanged. */
export interface CustomCode {
  code: number;
  type: "Int" | "Flt" | "Bol";
  value: number | boolean;
}

/** A step of a frame. */
export type FrameStep = { rot: "X" | "Y" | "Z"; angle: number } | { mirror: "X" | "Y" | "Z" };

/** Fields that several cycles have as `properties`. */
export interface Properties {
  /** 0 global, 1 one work offset, 2 parametrical (G10), 3 local (G52). `null`: not set. Code CmdPrm.Int[-10]. */
  wcsMode?: number | null;
  /** Number of the coordinate system, in modes 1 and 2. `null`: not set. Code CmdPrm.Int[-11]. */
  wcsNumber?: number | null;
  /** Whose offset is set. `null`: not set. Code CmdPrm.Int[-12]. */
  offsetTool?: number | null;
  /** Its first corrector. `null`: not set. Code CmdPrm.Int[-13]. */
  offsetCorrector1?: number | null;
  /** Its second corrector. `null`: not set. Code CmdPrm.Int[-14]. */
  offsetCorrector2?: number | null;
  /** Which tool is checked. `null`: not set. Code CmdPrm.Int[-15]. */
  brokenTool?: number | null;
  /** Its first corrector. `null`: not set. Code CmdPrm.Int[-16]. */
  brokenCorrector1?: number | null;
  /** Its second corrector. `null`: not set. Code CmdPrm.Int[-17]. */
  brokenCorrector2?: number | null;
  /** Number of the tool probe. `null`: not set. Code CmdPrm.Int[-18]. */
  toolProbe?: number | null;
  /** Its first corrector. `null`: not set. Code CmdPrm.Int[-19]. */
  toolProbeCorrector1?: number | null;
  /** Its second corrector. `null`: not set. Code CmdPrm.Int[-20]. */
  toolProbeCorrector2?: number | null;
  /** Number of the part probe. `null`: not set. Code CmdPrm.Int[-21]. */
  partProbe?: number | null;
  /** Its first corrector. `null`: not set. Code CmdPrm.Int[-22]. */
  partProbeCorrector1?: number | null;
  /** Its second corrector. `null`: not set. Code CmdPrm.Int[-23]. */
  partProbeCorrector2?: number | null;
  /** The component it is reported under. `null`: not set. Code CmdPrm.Int[-24]. */
  reportComponent?: number | null;
  /** The feature it is reported under. `null`: not set. Code CmdPrm.Int[-25]. */
  reportFeature?: number | null;
}

/** Fields that several cycles have as `repeat`. */
export interface Repeat {
  /** Number of touches of each point. The result uses their mean. */
  times?: number;
  /** Largest distance between touches of the same point. Beyond it the program writes nothing and stops; a program that only measures says so. Empty: no limit. `null`: no limit. */
  spread?: number | null;
}

/** Internal rectangle, protected: ENCY/SprutCAM type 7. */
export interface InternalRectangleProtected {
  type: "internal-rectangle-protected";
  /** Centre of the feature, on its top side. */
  origin?: Vec3;
  /** How the feature is turned about the tool axis; counter-clockwise positive. */
  rotation?: number;
  /** From touch point 1 to touch point 2, along the first direction of the rectangle. Code CmdPrm.Flt[-53]. */
  width1?: Size;
  /** From touch point 3 to touch point 4, along the second direction. Code CmdPrm.Flt[-54]. */
  width2?: Size;
  /** From the top side down to the ball centre at the touches. Code CmdPrm.Flt[-51]. */
  depth?: number;
  /** How far above the top side the ball centre crosses from touch to touch. Code CmdPrm.Flt[-55]. */
  topClearance?: number;
  /** From the wall to the ball centre where touches 1 and 2 begin. Code CmdPrm.Flt[-56]. */
  sideClearance1?: number;
  /** From the wall to the ball centre where touches 3 and 4 begin. Code CmdPrm.Flt[-57]. */
  sideClearance2?: number;
  /** How far above the start the cycle begins, and how far it is lifted at its end. Code CmdPrm.Flt[-50]. */
  feedDistance?: number;
  /** On: the points of the parameter table are ball-centre positions. Off: points on the surface. The moves are the same. Code CmdPrm.Flt[-66]. */
  compensateDimensions?: boolean;
  /** A free number for the postprocessor. -500 is that of Probe On/Off. Code CmdPrm.Int[-2]. */
  subCode?: number;
  properties?: Properties | null;
  repeat?: Repeat | null;
  /** Touches picked in the Job Assignment. They replace the points computed from the dimensions. */
  touches?: PickedTouch[] | null;
  custom?: CustomCode[] | null;
}

/** Double wall internal corner: ENCY/SprutCAM type 13. */
export interface DoubleWallInternalCorner {
  type: "double-wall-internal-corner";
  /** The corner, at the level of the touches. */
  origin?: Vec3;
  /** How the corner is turned about the tool axis; at 0 wall 1 runs along the ordinate. Counter-clockwise positive. */
  rotation?: number;
  /** Between the walls, inside the corner. */
  angle?: Size;
  /** From wall 1 to the ball centre where its touches begin. Code CmdPrm.Flt[-56]. */
  clearance1?: number;
  /** From wall 2 to the ball centre where its touches begin. Code CmdPrm.Flt[-57]. */
  clearance2?: number;
  /** How many touches wall 1 has. Code CmdPrm.Int[-63]. */
  count1?: number;
  /** How many touches wall 2 has. Code CmdPrm.Int[-64]. */
  count2?: number;
  /** Between the touches of wall 1, along it, away from the corner. Code CmdPrm.Flt[-65]. */
  step1?: number;
  /** Between the touches of wall 2, along it, away from the corner. Code CmdPrm.Flt[-67]. */
  step2?: number;
  /** How far above the start the cycle begins, and how far it is lifted at its end. Code CmdPrm.Flt[-50]. */
  feedDistance?: number;
  /** A free number for the postprocessor. -500 is that of Probe On/Off. Code CmdPrm.Int[-2]. */
  subCode?: number;
  properties?: Properties | null;
  repeat?: Repeat | null;
  /** Touches picked in the Job Assignment. They replace the points computed from the dimensions. */
  touches?: PickedTouch[] | null;
  custom?: CustomCode[] | null;
}

/** Probing two circles: HEIDENHAIN cycle 1411. */
export interface ProbingTwoCircles {
  type: "probing-two-circles";
  /** 1st noml. position of ref. axis? … of minor axis? … in tool axis? A number, or text with a tolerance, ? or @. Code Q1100. */
  point1?: [Nominal, Nominal, Nominal];
  /** Diameter of 1st position? A number, or text with a tolerance. Code Q1116. */
  diameter1?: Nominal;
  /** 2nd noml. position of ref. axis? … of minor axis? … in tool axis? As for the first point. Code Q1103. */
  point2?: [Nominal, Nominal, Nominal];
  /** Diameter of 2nd position? A number, or text with a tolerance. Code Q1117. */
  diameter2?: Nominal;
  /** Geometry type (0-3)? What is at each position. Code Q1115. */
  geometryType?: 0 | 1 | 2 | 3;
  /** Number of probe points? On each circle. Code Q423. */
  probePoints?: number;
  /** Starting angle? From the main axis to the first touch. Code Q325. */
  startingAngle?: number;
  /** Arc angular length? Over which the touches are spread; negative is clockwise. Code Q1119. */
  angularLength?: number;
  /** Set-up clearance? Added to SET_UP and the ball radius. Code Q320. */
  setUpClearance?: number;
  /** Clearance height? A height free of obstacles. Code Q260. */
  clearanceHeight?: number;
  /** Q320=PREDEF: the control reads the set-up clearance from GLOBAL DEF. The number above then only affects the moves shown. */
  setUpClearancePredef?: boolean;
  /** Q260=PREDEF: the control reads the clearance height from GLOBAL DEF. The number above then only affects the moves shown. */
  clearanceHeightPredef?: boolean;
  /** Traverse to clearance height? When the ball moves there. Code Q1125. */
  clearanceHeightMode?: -1 | 0 | 1 | 2;
  /** Reaction to tolerance error? Code Q309. */
  errorReaction?: 0 | 1 | 2;
  /** Align rotary axis? Only together with confirm rotation. Code Q1126. */
  alignRotaryAxis?: 0 | 1 | 2;
  /** Transfer position? Which point corrects the active preset. Code Q1120. */
  transferPosition?: 0 | 1 | 2 | 3;
  /** Confirm rotation? Use of the measured misalignment. Code Q1121. */
  confirmRotation?: 0 | 1 | 2;
  /** Stylus position before the cycle. */
  start?: Vec3;
  probe?: {
    /** SET_UP of the touch probe table: added to the set-up clearance. */
    setUp?: number;
    /** DIST of the touch probe table: the maximum travel of a touch. */
    dist?: number;
    /** F of the touch probe table: the probing feed. */
    feed?: number;
    /** FMAX of the touch probe table: the rapid for positioning. `null`: native. */
    rapid?: FeedRate;
  };
  extrusion?: {
    /** Extrusion direction? Along which the touches are repeated. Code Q1140. */
    direction?: 1 | 2 | 3;
    /** Number of extrusion points? Touches for each touch of 1411. Code Q1145. */
    points?: number;
    /** Length of extrusion? From the first to the last of them. Code Q1146. */
    length?: number;
    /** Extrusion probing: modal? Code Q1149. */
    modal?: 0 | 1;
  } | null;
  repeat?: Repeat | null;
}

/** Surface: ENCY/SprutCAM type 2. */
export interface Surface {
  type: "surface";
  /** The touch point, on the surface. */
  origin?: Vec3;
  /** Where the target vector points in the plane; counter-clockwise positive. */
  rotation?: number;
  /** How steeply the target vector points up from the plane: 90 is a top side, 0 a wall. */
  elevation?: number;
  /** From the surface to the ball centre where the touch begins. Code CmdPrm.Flt[-56]. */
  clearance?: number;
  /** How far above the start the cycle begins, and how far it is lifted at its end. Code CmdPrm.Flt[-50]. */
  feedDistance?: number;
  /** On: the points of the parameter table are ball-centre positions. Off: points on the surface. The moves are the same. Code CmdPrm.Flt[-66]. */
  compensateDimensions?: boolean;
  /** A free number for the postprocessor. -500 is that of Probe On/Off. Code CmdPrm.Int[-2]. */
  subCode?: number;
  properties?: Properties | null;
  repeat?: Repeat | null;
  /** Touches picked in the Job Assignment. They replace the points computed from the dimensions. */
  touches?: PickedTouch[] | null;
  custom?: CustomCode[] | null;
}

/** Angle of a wall: Touchpath. */
export interface WallAngle {
  type: "wall-angle";
  /** The middle between the touches, on the wall, at their height. */
  origin?: Vec3;
  /** Where the target vector points in the plane, out of the wall; counter-clockwise positive. */
  rotation?: number;
  /** From the first touch to the second, along the wall. The longer, the smaller ± is. */
  distance?: number;
  /** From the wall to the ball centre where a touch begins. */
  clearance?: number;
  /** How far above its start the cycle begins, and how far it is lifted at its end. */
  feedDistance?: number;
  repeat?: Repeat | null;
}

/** Hole: ENCY/SprutCAM type 3. */
export interface Hole {
  type: "hole";
  /** Centre of the feature, on its top side. */
  origin?: Vec3;
  /** How the feature is turned about the tool axis; counter-clockwise positive. */
  rotation?: number;
  /** Diameter of the feature. Code CmdPrm.Flt[-52]. */
  diameter?: Size;
  /** From the top side down to the ball centre at the touches. Code CmdPrm.Flt[-51]. */
  depth?: number;
  /** Rectangular: four touches, each pair opposite. Angular: from the start angle on, step by step. Code CmdPrm.Int[-59]. */
  variant?: 0 | 1;
  /** Angular variant: where the first touch is, counter-clockwise from the first direction. Code CmdPrm.Flt[-60]. */
  startAngle?: number;
  /** Angular variant: from one touch to the next, counter-clockwise positive. Code CmdPrm.Flt[-61]. */
  angularStep?: number;
  /** Angular variant: how many touches. Code CmdPrm.Int[-62]. */
  stepCount?: number;
  /** Height of the ball centre above the top side before it descends. Unchecked: it moves straight to the depth. `null`: not checked. Code CmdPrm.Flt[-55]. */
  topClearance?: number | null;
  /** How far above the start the cycle begins, and how far it is lifted at its end. Code CmdPrm.Flt[-50]. */
  feedDistance?: number;
  /** A free number for the postprocessor. -500 is that of Probe On/Off. Code CmdPrm.Int[-2]. */
  subCode?: number;
  properties?: Properties | null;
  repeat?: Repeat | null;
  /** Touches picked in the Job Assignment. They replace the points computed from the dimensions. */
  touches?: PickedTouch[] | null;
  custom?: CustomCode[] | null;
}

/** Hole, protected: ENCY/SprutCAM type 4. */
export interface HoleProtected {
  type: "hole-protected";
  /** Centre of the feature, on its top side. */
  origin?: Vec3;
  /** How the feature is turned about the tool axis; counter-clockwise positive. */
  rotation?: number;
  /** Diameter of the feature. Code CmdPrm.Flt[-52]. */
  diameter?: Size;
  /** From the top side down to the ball centre at the touches. Code CmdPrm.Flt[-51]. */
  depth?: number;
  /** Rectangular: four touches, each pair opposite. Angular: from the start angle on, step by step. Code CmdPrm.Int[-59]. */
  variant?: 0 | 1;
  /** Angular variant: where the first touch is, counter-clockwise from the first direction. Code CmdPrm.Flt[-60]. */
  startAngle?: number;
  /** Angular variant: from one touch to the next, counter-clockwise positive. Code CmdPrm.Flt[-61]. */
  angularStep?: number;
  /** Angular variant: how many touches. Code CmdPrm.Int[-62]. */
  stepCount?: number;
  /** How far above the top side the ball centre crosses from touch to touch. Code CmdPrm.Flt[-55]. */
  topClearance?: number;
  /** From the wall to the ball centre where touches begin. Code CmdPrm.Flt[-56]. */
  sideClearance?: number;
  /** How far above the start the cycle begins, and how far it is lifted at its end. Code CmdPrm.Flt[-50]. */
  feedDistance?: number;
  /** On: the points of the parameter table are ball-centre positions. Off: points on the surface. The moves are the same. Code CmdPrm.Flt[-66]. */
  compensateDimensions?: boolean;
  /** A free number for the postprocessor. -500 is that of Probe On/Off. Code CmdPrm.Int[-2]. */
  subCode?: number;
  properties?: Properties | null;
  repeat?: Repeat | null;
  /** Touches picked in the Job Assignment. They replace the points computed from the dimensions. */
  touches?: PickedTouch[] | null;
  custom?: CustomCode[] | null;
}

/** Boss: ENCY/SprutCAM type 5. */
export interface Boss {
  type: "boss";
  /** Centre of the feature, on its top side. */
  origin?: Vec3;
  /** How the feature is turned about the tool axis; counter-clockwise positive. */
  rotation?: number;
  /** Diameter of the feature. Code CmdPrm.Flt[-52]. */
  diameter?: Size;
  /** From the top side down to the ball centre at the touches. Code CmdPrm.Flt[-51]. */
  depth?: number;
  /** Rectangular: four touches, each pair opposite. Angular: from the start angle on, step by step. Code CmdPrm.Int[-59]. */
  variant?: 0 | 1;
  /** Angular variant: where the first touch is, counter-clockwise from the first direction. Code CmdPrm.Flt[-60]. */
  startAngle?: number;
  /** Angular variant: from one touch to the next, counter-clockwise positive. Code CmdPrm.Flt[-61]. */
  angularStep?: number;
  /** Angular variant: how many touches. Code CmdPrm.Int[-62]. */
  stepCount?: number;
  /** How far above the top side the ball centre crosses from touch to touch. Code CmdPrm.Flt[-55]. */
  topClearance?: number;
  /** From the wall to the ball centre where touches begin. Code CmdPrm.Flt[-56]. */
  sideClearance?: number;
  /** How far above the start the cycle begins, and how far it is lifted at its end. Code CmdPrm.Flt[-50]. */
  feedDistance?: number;
  /** On: the points of the parameter table are ball-centre positions. Off: points on the surface. The moves are the same. Code CmdPrm.Flt[-66]. */
  compensateDimensions?: boolean;
  /** A free number for the postprocessor. -500 is that of Probe On/Off. Code CmdPrm.Int[-2]. */
  subCode?: number;
  properties?: Properties | null;
  repeat?: Repeat | null;
  /** Touches picked in the Job Assignment. They replace the points computed from the dimensions. */
  touches?: PickedTouch[] | null;
  custom?: CustomCode[] | null;
}

/** Internal rectangle: ENCY/SprutCAM type 6. */
export interface InternalRectangle {
  type: "internal-rectangle";
  /** Centre of the feature, on its top side. */
  origin?: Vec3;
  /** How the feature is turned about the tool axis; counter-clockwise positive. */
  rotation?: number;
  /** From touch point 1 to touch point 2, along the first direction of the rectangle. Code CmdPrm.Flt[-53]. */
  width1?: Size;
  /** From touch point 3 to touch point 4, along the second direction. Code CmdPrm.Flt[-54]. */
  width2?: Size;
  /** From the top side down to the ball centre at the touches. Code CmdPrm.Flt[-51]. */
  depth?: number;
  /** Height of the ball centre above the top side before it descends. Unchecked: it moves straight to the depth. `null`: not checked. Code CmdPrm.Flt[-55]. */
  topClearance?: number | null;
  /** How far above the start the cycle begins, and how far it is lifted at its end. Code CmdPrm.Flt[-50]. */
  feedDistance?: number;
  /** A free number for the postprocessor. -500 is that of Probe On/Off. Code CmdPrm.Int[-2]. */
  subCode?: number;
  properties?: Properties | null;
  repeat?: Repeat | null;
  /** Touches picked in the Job Assignment. They replace the points computed from the dimensions. */
  touches?: PickedTouch[] | null;
  custom?: CustomCode[] | null;
}

/** External rectangle: ENCY/SprutCAM type 8. */
export interface ExternalRectangle {
  type: "external-rectangle";
  /** Centre of the feature, on its top side. */
  origin?: Vec3;
  /** How the feature is turned about the tool axis; counter-clockwise positive. */
  rotation?: number;
  /** From touch point 1 to touch point 2, along the first direction of the rectangle. Code CmdPrm.Flt[-53]. */
  width1?: Size;
  /** From touch point 3 to touch point 4, along the second direction. Code CmdPrm.Flt[-54]. */
  width2?: Size;
  /** From the top side down to the ball centre at the touches. Code CmdPrm.Flt[-51]. */
  depth?: number;
  /** How far above the top side the ball centre crosses from touch to touch. Code CmdPrm.Flt[-55]. */
  topClearance?: number;
  /** From the wall to the ball centre where touches 1 and 2 begin. Code CmdPrm.Flt[-56]. */
  sideClearance1?: number;
  /** From the wall to the ball centre where touches 3 and 4 begin. Code CmdPrm.Flt[-57]. */
  sideClearance2?: number;
  /** How far above the start the cycle begins, and how far it is lifted at its end. Code CmdPrm.Flt[-50]. */
  feedDistance?: number;
  /** On: the points of the parameter table are ball-centre positions. Off: points on the surface. The moves are the same. Code CmdPrm.Flt[-66]. */
  compensateDimensions?: boolean;
  /** A free number for the postprocessor. -500 is that of Probe On/Off. Code CmdPrm.Int[-2]. */
  subCode?: number;
  properties?: Properties | null;
  repeat?: Repeat | null;
  /** Touches picked in the Job Assignment. They replace the points computed from the dimensions. */
  touches?: PickedTouch[] | null;
  custom?: CustomCode[] | null;
}

/** Web: ENCY/SprutCAM type 9. */
export interface Web {
  type: "web";
  /** Centre of the feature, on its top side. */
  origin?: Vec3;
  /** How the feature is turned about the tool axis; counter-clockwise positive. */
  rotation?: number;
  /** From touch point 1 to touch point 2. Code CmdPrm.Flt[-53]. */
  width?: Size;
  /** From the top side down to the ball centre at the touches. Code CmdPrm.Flt[-51]. */
  depth?: number;
  /** How far above the top side the ball centre crosses from touch to touch. Code CmdPrm.Flt[-55]. */
  topClearance?: number;
  /** From the wall to the ball centre where touches begin. Code CmdPrm.Flt[-56]. */
  sideClearance?: number;
  /** How far above the start the cycle begins, and how far it is lifted at its end. Code CmdPrm.Flt[-50]. */
  feedDistance?: number;
  /** On: the points of the parameter table are ball-centre positions. Off: points on the surface. The moves are the same. Code CmdPrm.Flt[-66]. */
  compensateDimensions?: boolean;
  /** A free number for the postprocessor. -500 is that of Probe On/Off. Code CmdPrm.Int[-2]. */
  subCode?: number;
  properties?: Properties | null;
  repeat?: Repeat | null;
  /** Touches picked in the Job Assignment. They replace the points computed from the dimensions. */
  touches?: PickedTouch[] | null;
  custom?: CustomCode[] | null;
}

/** Web, three points: ENCY/SprutCAM type 10. */
export interface WebThreePoints {
  type: "web-three-points";
  /** Centre of the feature, on its top side. */
  origin?: Vec3;
  /** How the feature is turned about the tool axis; counter-clockwise positive. */
  rotation?: number;
  /** From the left touch point to the right one. Code CmdPrm.Flt[-53]. */
  width?: Size;
  /** From the top side down to the ball centre at the left and the right touch. Code CmdPrm.Flt[-51]. */
  depth?: number;
  /** From the wall to the ball centre where the left and the right touch begin. Code CmdPrm.Flt[-56]. */
  sideClearance?: number;
  /** From the top side to the ball centre where the middle touch begins, and where the ball crosses. Code CmdPrm.Flt[-57]. */
  middleClearance?: number;
  /** How far above the start the cycle begins, and how far it is lifted at its end. Code CmdPrm.Flt[-50]. */
  feedDistance?: number;
  /** On: the points of the parameter table are ball-centre positions. Off: points on the surface. The moves are the same. Code CmdPrm.Flt[-66]. */
  compensateDimensions?: boolean;
  /** A free number for the postprocessor. -500 is that of Probe On/Off. Code CmdPrm.Int[-2]. */
  subCode?: number;
  properties?: Properties | null;
  repeat?: Repeat | null;
  /** Touches picked in the Job Assignment. They replace the points computed from the dimensions. */
  touches?: PickedTouch[] | null;
  custom?: CustomCode[] | null;
}

/** Groove: ENCY/SprutCAM type 11. */
export interface Groove {
  type: "groove";
  /** Centre of the feature, on its top side. */
  origin?: Vec3;
  /** How the feature is turned about the tool axis; counter-clockwise positive. */
  rotation?: number;
  /** From touch point 1 to touch point 2. Code CmdPrm.Flt[-53]. */
  width?: Size;
  /** From the top side down to the ball centre at the touches. Code CmdPrm.Flt[-51]. */
  depth?: number;
  /** Height of the ball centre above the top side before it descends. Unchecked: it moves straight to the depth. `null`: not checked. Code CmdPrm.Flt[-55]. */
  topClearance?: number | null;
  /** How far above the start the cycle begins, and how far it is lifted at its end. Code CmdPrm.Flt[-50]. */
  feedDistance?: number;
  /** A free number for the postprocessor. -500 is that of Probe On/Off. Code CmdPrm.Int[-2]. */
  subCode?: number;
  properties?: Properties | null;
  repeat?: Repeat | null;
  /** Touches picked in the Job Assignment. They replace the points computed from the dimensions. */
  touches?: PickedTouch[] | null;
  custom?: CustomCode[] | null;
}

/** Groove, protected: ENCY/SprutCAM type 12. */
export interface GrooveProtected {
  type: "groove-protected";
  /** Centre of the feature, on its top side. */
  origin?: Vec3;
  /** How the feature is turned about the tool axis; counter-clockwise positive. */
  rotation?: number;
  /** From touch point 1 to touch point 2. Code CmdPrm.Flt[-53]. */
  width?: Size;
  /** From the top side down to the ball centre at the touches. Code CmdPrm.Flt[-51]. */
  depth?: number;
  /** How far above the top side the ball centre crosses from touch to touch. Code CmdPrm.Flt[-55]. */
  topClearance?: number;
  /** From the wall to the ball centre where touches begin. Code CmdPrm.Flt[-56]. */
  sideClearance?: number;
  /** How far above the start the cycle begins, and how far it is lifted at its end. Code CmdPrm.Flt[-50]. */
  feedDistance?: number;
  /** On: the points of the parameter table are ball-centre positions. Off: points on the surface. The moves are the same. Code CmdPrm.Flt[-66]. */
  compensateDimensions?: boolean;
  /** A free number for the postprocessor. -500 is that of Probe On/Off. Code CmdPrm.Int[-2]. */
  subCode?: number;
  properties?: Properties | null;
  repeat?: Repeat | null;
  /** Touches picked in the Job Assignment. They replace the points computed from the dimensions. */
  touches?: PickedTouch[] | null;
  custom?: CustomCode[] | null;
}

/** Double wall external corner: ENCY/SprutCAM type 14. */
export interface DoubleWallExternalCorner {
  type: "double-wall-external-corner";
  /** The corner, at the level of the touches. */
  origin?: Vec3;
  /** How the corner is turned about the tool axis; at 0 wall 1 runs along the ordinate. Counter-clockwise positive. */
  rotation?: number;
  /** Between the walls, in the material. */
  angle?: Size;
  /** From wall 1 to the ball centre where its touches begin. Code CmdPrm.Flt[-56]. */
  clearance1?: number;
  /** From wall 2 to the ball centre where its touches begin. Code CmdPrm.Flt[-57]. */
  clearance2?: number;
  /** From the corner along wall 1 to its first touch. */
  distance1?: number;
  /** From the corner along wall 2 to its first touch. */
  distance2?: number;
  /** How many touches wall 1 has. Code CmdPrm.Int[-63]. */
  count1?: number;
  /** How many touches wall 2 has. Code CmdPrm.Int[-64]. */
  count2?: number;
  /** Between the touches of wall 1, along it, away from the corner. Code CmdPrm.Flt[-65]. */
  step1?: number;
  /** Between the touches of wall 2, along it, away from the corner. Code CmdPrm.Flt[-67]. */
  step2?: number;
  /** How far above the start the cycle begins, and how far it is lifted at its end. Code CmdPrm.Flt[-50]. */
  feedDistance?: number;
  /** On: the points of the parameter table are ball-centre positions. Off: points on the surface. The moves are the same. Code CmdPrm.Flt[-66]. */
  compensateDimensions?: boolean;
  /** A free number for the postprocessor. -500 is that of Probe On/Off. Code CmdPrm.Int[-2]. */
  subCode?: number;
  properties?: Properties | null;
  repeat?: Repeat | null;
  /** Touches picked in the Job Assignment. They replace the points computed from the dimensions. */
  touches?: PickedTouch[] | null;
  custom?: CustomCode[] | null;
}

/** Triple wall internal corner: ENCY/SprutCAM type 15. */
export interface TripleWallInternalCorner {
  type: "triple-wall-internal-corner";
  /** The corner, where the walls meet the floor. */
  origin?: Vec3;
  /** How the corner is turned about the tool axis; at 0 wall 1 runs along the ordinate. Counter-clockwise positive. */
  rotation?: number;
  /** Between the walls, inside the corner. */
  angle?: Size;
  /** From wall 1 to the ball centre where its touch begins. Code CmdPrm.Flt[-56]. */
  clearance1?: number;
  /** From wall 2 to the ball centre where its touch begins. Code CmdPrm.Flt[-57]. */
  clearance2?: number;
  /** From the floor to the ball centre where its touch begins. Code CmdPrm.Flt[-58]. */
  clearance3?: number;
  /** How far above the start the cycle begins, and how far it is lifted at its end. Code CmdPrm.Flt[-50]. */
  feedDistance?: number;
  /** A free number for the postprocessor. -500 is that of Probe On/Off. Code CmdPrm.Int[-2]. */
  subCode?: number;
  properties?: Properties | null;
  repeat?: Repeat | null;
  /** Touches picked in the Job Assignment. They replace the points computed from the dimensions. */
  touches?: PickedTouch[] | null;
  custom?: CustomCode[] | null;
}

/** Triple wall external corner: ENCY/SprutCAM type 16. */
export interface TripleWallExternalCorner {
  type: "triple-wall-external-corner";
  /** The corner, on the top side. */
  origin?: Vec3;
  /** How the corner is turned about the tool axis; at 0 wall 1 runs along the ordinate. Counter-clockwise positive. */
  rotation?: number;
  /** Between the walls, in the material. */
  angle?: Size;
  /** From the top side down to the ball centre at the touches of the walls. Code CmdPrm.Flt[-51]. */
  depth?: number;
  /** From wall 1 to the ball centre where its touch begins. Code CmdPrm.Flt[-56]. */
  clearance1?: number;
  /** From wall 2 to the ball centre where its touch begins. Code CmdPrm.Flt[-57]. */
  clearance2?: number;
  /** From the top side to the ball centre where its touch begins, and where the ball crosses. Code CmdPrm.Flt[-58]. */
  topClearance?: number;
  /** From the corner along wall 1 to its touch. */
  distance1?: number;
  /** From the corner along wall 2 to its touch. */
  distance2?: number;
  /** From wall 1 inwards to the touch on the top side. */
  topDistance1?: number;
  /** From wall 2 inwards to the touch on the top side. */
  topDistance2?: number;
  /** How far above the start the cycle begins, and how far it is lifted at its end. Code CmdPrm.Flt[-50]. */
  feedDistance?: number;
  /** A free number for the postprocessor. -500 is that of Probe On/Off. Code CmdPrm.Int[-2]. */
  subCode?: number;
  properties?: Properties | null;
  repeat?: Repeat | null;
  /** Touches picked in the Job Assignment. They replace the points computed from the dimensions. */
  touches?: PickedTouch[] | null;
  custom?: CustomCode[] | null;
}

/** Probe on/off: ENCY/SprutCAM type 0. */
export interface ProbeOnOff {
  type: "probe-on-off";
  /** Whether the probe is switched on or off. Code CmdPrm.Bol[-3]. */
  on?: boolean;
  custom?: CustomCode[] | null;
}

/** NC action: ENCY/SprutCAM type 1. */
export interface NcAction {
  type: "nc-action";
  /** A free number for the postprocessor. -500 is that of Probe On/Off. Code CmdPrm.Int[-2]. */
  subCode?: number;
  properties?: Properties | null;
  custom?: CustomCode[] | null;
}

export type Cycle =
  | InternalRectangleProtected
  | DoubleWallInternalCorner
  | ProbingTwoCircles
  | Surface
  | WallAngle
  | Hole
  | HoleProtected
  | Boss
  | InternalRectangle
  | ExternalRectangle
  | Web
  | WebThreePoints
  | Groove
  | GrooveProtected
  | DoubleWallExternalCorner
  | TripleWallInternalCorner
  | TripleWallExternalCorner
  | ProbeOnOff
  | NcAction;

/** A probing job. Omitted values have the catalog's defaults. */
export interface Job {
  format: 1;
  /** Name of the program. */
  name?: string;
  /** Unit of every length in the job, the program and the table. */
  units?: "mm" | "inch";
  /** The working plane; the tool axis is square to it. */
  plane?: "G17" | "G18" | "G19";
  /** Overtravel: distance the probe searches past the nominal contact before the touch counts as a miss. */
  overtravel?: number;
  stylus?: {
    /** Effective diameter of the ball; 0 is a point. */
    diameter?: number;
    /** One sigma of a single touch along its probing direction. */
    repeatability?: number;
    /** From the ball centre up to the probe body. Empty: unknown; the probe body is then not checked. `null`: not known. */
    length?: number | null;
    /** Diameter of the stylus above the ball. Empty: unknown. `null`: not known. */
    shank?: number | null;
    /** Diameter of the probe body above the stylus. Empty: unknown. `null`: not known. */
    body?: number | null;
    /** Eccentricity: half the total indicator reading at the ball over one spindle revolution. Adds to the uncertainty unless the spindle is oriented. Empty: unknown. `null`: not known. */
    runout?: number | null;
  };
  feeds?: {
    /** From the feed distance to the start of the cycle. `null`: rapid. */
    approach?: FeedRate;
    /** Every positioning move inside the cycle. `null`: rapid. */
    longLink?: FeedRate;
    /** The touches. Never rapid. */
    work?: number;
    /** Back from a surface touch; only cycles with such a step use it. `null`: rapid. */
    retract?: FeedRate;
    /** The last lift. `null`: rapid. */
    return?: FeedRate;
  };
  limits?: {
    /** Largest distance of a measured position from its nominal one, along each axis. Empty: the part may lie anywhere within the search. `null`: no limit. */
    position?: number | null;
    /** Largest deviation of a measured width, diameter or length. `null`: no limit. */
    size?: number | null;
    /** Largest deviation of a measured angle or direction. `null`: no limit. */
    angle?: number | null;
    /** Largest root mean square distance of the touches from the fitted circle or wall, if there are more touches than the fit needs. `null`: no limit. */
    residual?: number | null;
  };
  machine?: {
    /** How fast an axis slows down after the probe triggers. Hobby machines have 200 to 1000 mm/s², machining centres more. */
    acceleration?: number;
    /** Delay from contact to the start of deceleration: probe, receiver and control. */
    latency?: number;
    /** Permissible stylus deflection after contact, from the probe's data sheet: 3 to 12 mm sideways. */
    deflection?: number;
    /** Edition of Renishaw's macros on the machine, from the top of its programs. Editions differ in the letters that exclude each other, and in calibration. */
    edition?: "unknown" | "haas-ngc" | "mazak-a-4013-0113";
    /** Lines of your shop at fixed places of the program: tool change, probe on, safe position. {tool}, {offset}, {axis}, {feed}, {clearance} and {name} become values of the job. A line must not write an offset, jump, or move below the clearance. `null`: none. */
    frame?: { head?: string[]; probeOn?: string[]; beforeFirstMove?: string[]; beforeWrite?: string[]; probeOff?: string[]; foot?: string[]; onAlarm?: string[] } | null;
  };
  control?: {
    /** Which control the program is for. */
    post?: "linuxcnc" | "grbl" | "grblhal" | "fluidnc" | "sinumerik" | "heidenhain" | "fanuc" | "haas" | "mazak" | "brother" | "hurco" | "okuma";
    /** Plain moves: every move is written out, on the job's path. Native cycle: a few calls, on the cycle's own path, which is shown. */
    form?: "moves" | "cycle";
    /** The work offset that the program writes at its end: 1 is G54. Empty: measure only. `null`: measure only. */
    workOffset?: number | null;
    /** Whether positioning moves are watched by the probe, where the control can: a contact then stops the program. */
    protection?: "checked" | "none";
    /** A dry run makes the same moves without a part: a touch ends at its nominal contact, a contact anywhere stops it, and nothing is written. */
    run?: "normal" | "dry";
    /** Height along the tool axis by which a dry run is raised: above the part it can run with the part in the machine. */
    lift?: number;
    /** Detail of the header comments. A header with the whole job lets Touchpath reopen the program. */
    header?: "full" | "short";
    /** Tool number of the probe. HEIDENHAIN programs call it; LinuxCNC, SINUMERIK, Fanuc and Haas programs check that it is in the spindle. Empty: neither. `null`: in the spindle, not checked. */
    tool?: number | null;
    /** Angle that the spindle is turned to before the first move: the one at which the probe was calibrated. Empty: the program does not turn it. `null`: not oriented. */
    orient?: number | null;
    /** Probe input of the control: the one that the probe in the spindle is connected to. */
    probeInput?: number;
    /** Where the program shows its results before it ends. */
    report?: "screen" | "log" | "none";
    /** Whether the program shows its results and waits for cycle start before it writes a work offset. A reset then writes nothing. */
    ask?: "never" | "always" | "outside";
    /** What the tool offsets hold, if a program of moves corrects them. Haas: setting 40. Fanuc: parameter 5004, and its memory for offsets: C with wear, or A. */
    toolOffsets?: "unknown" | "radius" | "diameter" | "memory-a-radius" | "memory-a-diameter";
    /** SET_UP of the touch probe table: native cycles add it to their set-up clearance. */
    setUp?: number;
    /** Number of the program, on controls whose programs have one. Empty: the four digits at the end of the program name (O2201, BORE2201; not a size such as D1200), else 1000. `null`: from the name. */
    number?: number | null;
  };
  tool?: {
    /** The tool type's number: 710 is a 3D probe; 400 to 599 are turning and grinding tools. */
    type?: number;
    /** SD42900 $SC_MIRROR_TOOL_LENGTH: a mirrored axis changes the sign of the length. */
    sd42900?: boolean;
    /** SD42940 $SC_TOOL_LENGTH_CONST: the assignment of this plane holds in every plane; 0 takes the active plane. */
    sd42940?: number;
    /** SD42950 $SC_TOOL_LENGTH_TYPE: whether lengths act as for milling or as for turning. */
    sd42950?: 0 | 1 | 2;
    /** Steps of the active frame, in order. */
    frame?: FrameStep[];
  };
  /** The block that the features are cut into, parallel to the axes; `null`: unknown and not checked. */
  stock?: {
    /** Corner of the block with the smallest X, Y and Z. */
    origin?: Vec3;
    /** Length of the block along X, Y and Z. */
    size?: Vec3;
  } | null;
  part?: {
    /** How far the part is shifted. */
    offset?: Vec3;
    /** How far the part is turned about the tool axis through the work origin, before the shift. */
    rotation?: number;
    /** Deviation of each size of the part, by the field's key. */
    sizes?: Record<string, number>;
  };
  /** The tolerance of each result, by its code: `diameter`, in a set-up `BORE.diameter`. */
  tolerances?: Record<string, ResultTolerance> | null;
  cycle: Cycle;
}

/** The tolerance of a result, and the action when a value exceeds it. */
export interface ResultTolerance {
  /**
   * Relative to the nominal value (`H7`, `±0.02`, `+0.021/0`), or with it (`25H7`, `24.98..25.02`). In the job's units, for an angle in degrees.
   * Omit it if the size contains the tolerance.
   */
  tolerance?: string;
  /** The program continues, shows the result and continues, or stops with an alarm. Default: `go`. */
  action?: "go" | "mark" | "stop";
  /** The tool that is corrected from this size, by the macros of Fanuc-type controls in the form `cycle`. */
  wear?: Wear | null;
}

/** Correction of a tool by a macro, from a size that it measures. */
export interface Wear {
  /** The number of the tool offset. */
  tool: number;
  /** Feedback percentage: share of the error to correct, 1 to 100. Default: 100. */
  percent?: number;
  /** Dead band: error that is ignored, in the job's units, at most 1 mm. Default: 0. */
  deadBand?: number;
  /** Number of parts whose mean error is corrected. Default: each part corrects the tool. */
  parts?: number | null;
  /** With `parts`: the first of two tool offsets that no tool uses, in which the macro stores its values. */
  store?: number | null;
}

/** A value of a cycle in a set-up: a number, or a result of an earlier cycle plus a number, such as `=TOP.z-5` or `=SIDE.rotation+90`. */
export type Followable = number | `=${string}`;

type Following<C> = {
  [K in keyof C]: K extends "origin"
    ? [Followable, Followable, Followable]
    : K extends "rotation"
      ? Followable
      : C[K];
};

/** A cycle of a set-up. Its name, a letter and then letters and digits, prefixes its results; the default names the measured feature. */
export type NamedCycle = Following<Cycle> & { name?: string };

/** Relations between the features of a set-up. A relation may use an earlier one. */
export interface Relation {
  /** Prefix of its results, like the name of a cycle. */
  name: string;
  /**
   * `line`, of two places: `distance`, `rotation`.
   * `center`, of two places or more: `center.x`, `center.y`.
   * `pitch-circle`, of three places or more: `center.x`, `center.y`, `diameter`, `residual`.
   * `difference`, of two results: `difference`, of angles `difference.angle`.
   * `mean`, of two results or more: `mean`, of angles `mean.angle`.
   */
  type: "line" | "center" | "pitch-circle" | "difference" | "mean";
  /** Names of cycles and relations that measure a position in the plane, or results such as `BORE.diameter`. */
  of: string[];
}

/**
 * Several cycles in one program: one header, safe link moves between them, one write at the end. Omitted values have the catalog's defaults. Sizes of the
 * virtual part are prefixed with their cycle: `BORE.diameter`.
 */
export interface SetUp extends Omit<Job, "format" | "cycle"> {
  format: 2;
  cycles: NamedCycle[];
  /** Clearance plane between the cycles: height of the ball centre along the tool axis. `null`: the highest start or end of a cycle. */
  clear?: number | null;
  /**
   * Result written into each axis of the work offset, such as `BORE.center.x`: x is the abscissa, y the ordinate, z the tool axis. Default: the first cycle that
   * measures the axis. `null`: not written. A rotation is only written if it is specified.
   */
  datum?: { x?: string | null; y?: string | null; z?: string | null; rotation?: string | null };
  /** Relations: results computed from results of the cycles, prefixed with the relation's name. */
  relations?: Relation[] | null;
}

/** The id of a control. */
export type PostId =
  | "linuxcnc"
  | "grbl"
  | "grblhal"
  | "fluidnc"
  | "sinumerik"
  | "heidenhain"
  | "fanuc"
  | "haas"
  | "mazak"
  | "brother"
  | "hurco"
  | "okuma";
