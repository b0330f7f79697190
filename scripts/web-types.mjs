// The element for JetBrains' editors, made of its manifest.
import { readFileSync } from "node:fs";
import { at } from "./lib.mjs";

/**
 * What a list of the manifest says of each: name, text, type, default.
 * @param {any[]} list
 */
const described = (list = []) =>
  list.map(({ name, description, type, default: standard }) => ({
    name,
    ...(description ? { description } : {}),
    ...(type?.text ? { value: { type: type.text } } : {}),
    ...(standard === undefined ? {} : { default: standard }),
  }));

/** The file that `web-types` of package.json names. */
export function webTypes() {
  const json = (/** @type {string[]} */ ...path) =>
    JSON.parse(readFileSync(at(...path), "utf8"));
  const { name, version } = json("package.json");
  const declared = json("dist", "custom-elements.json").modules.flatMap(
    (/** @type {any} */ module) => module.declarations,
  );
  const elements = declared.map((/** @type {any} */ one) => {
    const fields = one.members.filter(
      (/** @type {any} */ member) => member.kind === "field",
    );
    return {
      name: one.tagName,
      description: one.description,
      attributes: described(one.attributes),
      js: { properties: described(fields), events: described(one.events) },
      css: {
        properties: described(one.cssProperties),
        parts: described(one.cssParts),
      },
    };
  });
  return {
    name,
    version,
    "description-markup": "markdown",
    "js-types-syntax": "typescript",
    contributions: { html: { elements } },
  };
}
