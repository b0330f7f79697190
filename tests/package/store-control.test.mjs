// Another control: settings of the job that it does not have, their announcement, and the program.
import assert from "node:assert/strict";
import { test } from "node:test";
import { listen, program, read, Store, said, setUp, type } from "./state.mjs";

setUp();

test("a cycle that its control does not take goes back to the control before it, and says so", () => {
  const store = new Store();
  const told = listen(store);
  store.chooseControl("sinumerik");
  store.choose("probing-two-circles");
  assert.match(
    told.at(-1) ?? "",
    /^This is a cycle of HEIDENHAIN TNC7 \(Klartext\); the program for SINUMERIK/,
  );
  store.chooseControl("heidenhain");
  store.choose("double-wall-external-corner");
  assert.equal(store.get("control.post"), "sinumerik");
  assert.match(
    told.at(-1) ?? "",
    /^HEIDENHAIN TNC7 \(Klartext\) does not support this cycle: the program is now for SINUMERIK/,
  );
});

test("the number of a work offset was taken to another control, where it is another offset", () => {
  const store = new Store();
  const told = listen(store);
  const held = () => [
    store.get("control.post"),
    store.get("control.workOffset"),
  ];
  assert.equal(store.writes(7), "writes G59.1");
  store.put("control.workOffset", 7);
  store.chooseControl("sinumerik");
  assert.equal(store.get("control.workOffset"), null);
  assert.deepEqual(told, [
    "This control has no G59.1: the program now writes no work offset",
  ]);
  store.undo();
  assert.deepEqual(held(), ["linuxcnc", 7]);
  // G55 is G55 everywhere, and grbl has none.
  store.put("control.workOffset", 2);
  for (const post of ["sinumerik", "fanuc", "haas"]) {
    store.chooseControl(post);
    assert.equal(store.get("control.workOffset"), 2, post);
  }
  store.chooseControl("grbl", "moves");
  assert.deepEqual(held(), ["grbl", null]);
});

test("a Fanuc program has the number of the job's name, and a number is ignored where programs have none, and said to be", () => {
  const store = new Store();
  store.choose("hole");
  store.chooseControl("fanuc");
  assert.match(program(store), /^%\nO1000/);
  store.put("name", "BORE2201");
  assert.match(program(store), /^%\nO2201\(BORE2201\)\n/);
  store.put("control.number", 7);
  store.chooseControl("linuxcnc");
  assert.equal(
    store.get("control.number"),
    7,
    "it is there to be seen and removed",
  );
  assert.match(
    said(store, "control.number").join(),
    /have no number: it is ignored/,
  );
});

test("a SINUMERIK program tests each touch, and the length of the probe decides along which axis it may touch", () => {
  const store = new Store();
  store.chooseControl("sinumerik");
  store.put("control.workOffset", 5);
  assert.equal(store.writes(5), store.does);
  assert.match(store.does, /^writes G505/);
  assert.match(
    program(store),
    /MEAS=1 G1 X42 Y0 Z-10 F150\nSTOPRE\nIF \$AC_MEA\[1\]==0 GOTOF TP_MISSED/,
  );
  assert.match(program(store), /\$P_UIFR\[5,X,TR\]=/);
  type(store, "tool.type", "500");
  assert.match(store.withheld, /L1 acts along \+Y/);
  type(store, "tool.type", "710");
  store.put("tool.frame", [{ rot: "Z", angle: 60 }]);
  assert.equal(
    store.withheld,
    null,
    "a turn about the tool axis leaves L1 where it is",
  );
  const { text } = store.plan.program;
  store.reset();
  store.open(read(text));
  assert.equal(
    store.plan.program.text,
    text,
    "what was written comes back byte for byte",
  );
});
