// The element's description for JetBrains editors, from its manifest.
import { readFileSync } from "node:fs";
import { at } from "./lib.mjs";

/**
 * Name, text, type and default of the entries in a list of the manifest.
 * @param {any[]} list
 */
const described = (list = []) =>
  list.map(({ name, description, type, default: standard }) => ({
    name,
    ...(description ? { description } : {}),
    ...(type?.text ? { value: { type: type.text } } : {}),
    ...(standard === undefined ? {} : { default: standard }),
  }));

/** The file in `web-types` of package.json. */
export function webTypes() {
  const json = (/** @type {string[]} */ ...path) =>
    JSON.parse(readFileSync(at(...path), "utf8"));
  const { name, version } = json("dist", "touchpath-element", "package.json");
  const declared = json(
    "dist",
    "touchpath-element",
    "custom-elements.json",
  ).modules.flatMap((/** @type {any} */ module) => module.declarations);
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
