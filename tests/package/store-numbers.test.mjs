// Text in a number field: a number, a sum, a unit, or none of them.
import assert from "node:assert/strict";
import { test } from "node:test";
import { readNumber, setUp } from "./state.mjs";

setUp();

test("numbers as they are typed: what is worked out is right, what can be read in two ways stays text", () => {
  /** @type {[string, number | string][]} */
  const cases = [
    ["1,5", 1.5],
    [" +2.", 2],
    ["-.5", -0.5],
    ["1e3", 1000],
    ["1,2,3", "1,2,3"],
    ["x", "x"],
    ["", ""],
    ["80/2+0.5", 40.5],
    ["2+3*4", 14],
    ["(2+3)*-4", -20],
    ["10/4/5", 0.5],
    ["10-4-3", 3],
    ["1 1/2", 1.5],
    ["-1 1/2", -1.5],
    ["1-1/2", "1-1/2"],
    ["1,000", "1,000"],
    ["12,345", 12.345],
    ["--5", "--5"],
    ["1.2.3", "1.2.3"],
    ["5 5", "5 5"],
    ["2(3)", "2(3)"],
    ["()", "()"],
    ["1/0", "1/0"],
    ["1e999", "1e999"],
    ["Infinity", "Infinity"],
    ["0x10", "0x10"],
    ["(".repeat(150), "(".repeat(150)],
    ["-(".repeat(2000), "-(".repeat(2000)],
  ];
  for (const [text, value] of cases)
    assert.equal(readNumber(text), value, text.slice(0, 20));
});

test("a unit after a number is that unit, in a field that has one", () => {
  /** @type {[string, string, string, number | string][]} */
  const cases = [
    ["80 mm", "length", "mm", 80],
    ["80mm", "length", "inch", 3.149606],
    ["0.00025 mm", "length", "inch", 0.000009843],
    ["1 in", "length", "mm", 25.4],
    ['1 1/2"', "length", "mm", 38.1],
    ["2 inch", "length", "inch", 2],
    ["10 ipm", "feed", "mm", 254],
    ["150 mm/min", "feed", "mm", 150],
    // 500 / 25.4.
    ["500 mm/s²", "acceleration", "inch", 19.685039],
    ["500 mm/s^2", "acceleration", "inch", 19.685039],
    ["20 in/s²", "acceleration", "mm", 508],
    ["30°", "angle", "inch", 30],
    ["30 mm", "angle", "mm", "30 mm"],
    ["3 mm", "none", "mm", "3 mm"],
    ["10 in mm", "length", "mm", "10 in mm"],
    ["mm", "length", "mm", "mm"],
  ];
  for (const [text, unit, units, value] of cases)
    assert.equal(readNumber(text, unit, units), value, text);
  // A thousand to some is one to others: it is asked, in either language.
  for (const [text, comma] of /** @type {const} */ ([
    ["1,000", false],
    ["12.000", true],
    ["-1.000.000", true],
  ]))
    assert.equal(readNumber(text, "length", "mm", comma), text);
  for (const [text, comma, value] of /** @type {const} */ ([
    ["1.000", false, 1],
    ["12,000", true, 12],
    ["0.000", true, 0],
    ["12.5", true, 12.5],
  ]))
    assert.equal(readNumber(text, "length", "mm", comma), value, text);
});

test("a tolerance in a size was taken for a sum", () => {
  for (const typed of [
    "25+0.021",
    "25-0.02",
    "25 +0,021/0",
    "25+0.021-0",
    "25+0.1-0.1",
    "25\u{2212}0.02",
    "25+.05",
    "25e7",
    "25 H7",
    "25\u{b1}0.02",
    // Two deviations with a blank or a slash are no sum, for any size.
    "25 +0.6/-0.6",
    "25 +0.6 -0.6",
    "100 +1 0",
    "100 0 -2",
  ])
    assert.equal(readNumber(typed, "length", "mm", false, true), typed, typed);
  // Sums of anything else stay sums, and so do small ones of what is no size.
  /** @type {[string, number][]} */
  const sums = [
    ["80/2+0.5", 40.5],
    ["25+0.5", 25.5],
    ["12.5+12.5", 25],
    ["0.3+0.1", 0.4],
    ["2*12.5+0.02", 25.02],
    ["25+0.021+1+1", 27.021],
    ["25.0 -1", 24],
    ["25+1-0.5", 25.5],
    ["25 + 1 - 0.5", 25.5],
  ];
  for (const [typed, value] of sums)
    assert.equal(readNumber(typed, "length", "mm", false, true), value, typed);
  assert.equal(readNumber("25+0.021", "length", "mm"), 25.021);
  assert.equal(readNumber("90+0.5", "angle", "mm", false, true), 90.5);
  for (const angle of ["90+0.4", "90 +0.5/-0.5", "90 +1 -1", "90 +0.5 0"])
    assert.equal(readNumber(angle, "angle", "inch", false, true), angle, angle);
  // 0.05 is large in inch, and the typed unit counts.
  assert.equal(readNumber("1+0.05", "length", "inch", false, true), 1.05);
  assert.equal(readNumber("1+0.001", "length", "inch", false, true), "1+0.001");
  assert.equal(
    readNumber("25+0.05 mm", "length", "inch", false, true),
    "25+0.05 mm",
  );
});
