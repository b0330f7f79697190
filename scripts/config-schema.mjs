// JSON Schema of a config: its structure, with the lists of the catalog and the sections of a job. Only `checkConfig` knows the values that a field accepts.

/** @typedef {Record<string, unknown>} Schema */

/** @type {(properties: Record<string, Schema>, required?: string[]) => Schema} */
const object = (properties, required = []) => ({
  type: "object",
  properties,
  required,
  additionalProperties: false,
});
/** @type {(items: Schema, description: string) => Schema} */
const list = (items, description) => ({
  type: "array",
  items,
  maxItems: 200,
  description,
});
/** @type {(items: Schema, description: string) => Schema} */
const some = (items, description) => ({
  ...list(items, description),
  minItems: 1,
});
/** @type {(most: number, description: string) => Schema} */
const text = (most, description) => ({
  type: "string",
  maxLength: most,
  description,
});
const name = {
  type: "string",
  minLength: 1,
  maxLength: 60,
  pattern: "[^\\s\\u0085]",
};
const point = {
  type: "array",
  items: { type: "number", minimum: -100000, maximum: 100000 },
  minItems: 3,
  maxItems: 3,
};

/**
 * @param {{ cycles: { type: string }[]; posts: { id: string }[] }} catalog
 * @param {any} job The schema of a job.
 * @returns {Schema}
 */
export function configSchema({ cycles, posts }, job) {
  const cycle = { enum: cycles.map(({ type }) => type) };
  const control = { enum: posts.map(({ id }) => id) };
  const {
    overtravel,
    stylus,
    feeds,
    limits,
    machine,
    control: section,
    tool,
  } = job.properties;
  const box = { min: point, max: point };
  return {
    $schema: "https://json-schema.org/draft/2020-12/schema",
    $id: "urn:touchpath:config:1",
    title: "The rules of a portal",
    ...object(
      {
        format: { const: 1 },
        title: text(60, "The name of the portal in findings."),
        units: {
          enum: ["mm", "inch"],
          description: "Units of the lengths and feeds in the config.",
        },
        allow: {
          description: "What may be chosen. What is left out is not limited.",
          ...object({
            cycles: some(cycle, "Types of cycles."),
            controls: some(
              control,
              "Controls, by the id of a post in the catalog.",
            ),
            forms: some({ enum: ["moves", "cycle"] }, "Forms of a program."),
            units: some({ enum: ["mm", "inch"] }, "Units of jobs."),
            workOffsets: some(
              {
                anyOf: [
                  { type: "integer", minimum: 1, maximum: 105 },
                  { type: "null" },
                ],
              },
              "Work offsets that a program may write, 1 for the first (G54); null is measuring only.",
            ),
            setUps: {
              type: "boolean",
              description: "Whether a job may have several cycles.",
            },
          }),
        },
        hide: {
          description:
            "What the element does not offer. A job that has it is not refused.",
          ...object({
            cycles: list(cycle, "Types of cycles."),
            controls: list(control, "Controls."),
            panels: list(
              {
                enum: [
                  "form",
                  "stage",
                  "program",
                  "table",
                  "results",
                  "checks",
                ],
              },
              "Panels of the element.",
            ),
          }),
        },
        fields: {
          description:
            "Rules of single fields, by path: feeds.work, control.tool, cycle.depth.",
          type: "object",
          maxProperties: 200,
          additionalProperties: object({
            value: {
              description: "The value of a job that leaves the field out.",
            },
            locked: {
              type: "boolean",
              description:
                "The field must have the value; without one, only the user cannot change it.",
            },
            hidden: {
              type: "boolean",
              description: "The element does not show it.",
            },
            min: {
              type: "number",
              minimum: -1e9,
              maximum: 1e9,
              description: "The least that is allowed.",
            },
            max: {
              type: "number",
              minimum: -1e9,
              maximum: 1e9,
              description: "The most that is allowed.",
            },
            reason: text(200, "The reason, in the portal's words."),
          }),
        },
        machines: list(
          object(
            {
              name,
              overtravel,
              stylus,
              feeds,
              limits,
              machine,
              control: section,
              tool,
            },
            ["name"],
          ),
          "Machines that the element offers by name.",
        ),
        styli: list(
          object({ name, ...stylus.properties }, ["name"]),
          "Styli that the element offers by name.",
        ),
        space: {
          description:
            "Boxes along the axes of the machine, of the ball's centre.",
          ...object({
            zero: {
              ...point,
              description:
                "Where the origin of the work coordinate system lies in the machine.",
            },
            travel: {
              description: "Where the ball centre can go.",
              ...object(box, ["min", "max"]),
            },
            keepOut: list(
              object({ name, ...box }, ["name", "min", "max"]),
              "Zones that the probe must not enter.",
            ),
          }),
        },
        findings: list(
          object(
            {
              level: { enum: ["error", "warning", "info"] },
              path: text(200, "The place in the job."),
              message: {
                type: "string",
                minLength: 1,
                maxLength: 1000,
                pattern: "[^\\s\\u0085]",
              },
            },
            ["message"],
          ),
          "The portal's own findings. With an error there is no program.",
        ),
      },
      ["format"],
    ),
  };
}
