// Bill of materials (CycloneDX 1.6): the crates in the module and the libraries in the bundles. Its source is the list of licences, which the tools that bundle
// them write.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { Enums, Models, Serialize, Spec } from "@cyclonedx/cyclonedx-library";

/** The components in a list of licences, each name and version once. */
function components(/** @type {string} */ licences) {
  const named = (/** @type {string} */ text, /** @type {string} */ kind) =>
    [...text.matchAll(/^## (\S+) - (\S+) \((.+)\)$/gm)].map(
      ([, name = "", version = "", licence = ""]) => ({
        name,
        version,
        licence,
        purl: `pkg:${kind}/${name.replace(/^@/, "%40")}@${version}`,
      }),
    );
  const isCrates = (/** @type {string} */ list) =>
    list.startsWith("# Licences of the crates");
  const all = licences
    .split(/^(?=# )/m)
    .flatMap((list) => named(list, isCrates(list) ? "cargo" : "npm"));
  return [...new Map(all.map((one) => [one.purl, one])).values()]
    .filter(({ name }) => name !== "touchpath")
    .sort((a, b) => (a.purl < b.purl ? -1 : 1));
}

/**
 * The bill of materials of a package, from its manifest and the licences in its folder. It has no time and no serial number, so the same contents give the same
 * text.
 * @param {string} folder
 * @param {string} manifest
 */
export function sbom(folder, manifest) {
  const { name, version, license } = JSON.parse(readFileSync(manifest, "utf8"));
  const component = (
    /** @type {string} */ name,
    /** @type {string} */ version,
    /** @type {string} */ licence,
    /** @type {string} */ purl,
  ) => {
    const one = new Models.Component(Enums.ComponentType.Library, name, {
      version,
      purl,
      bomRef: purl,
    });
    one.licenses.add(new Models.LicenseExpression(licence));
    return one;
  };
  const own = component(name, version, license, `pkg:npm/${name}@${version}`);
  const bom = new Models.Bom({
    metadata: new Models.Metadata({ component: own }),
  });
  for (const { name, version, licence, purl } of components(
    readFileSync(join(folder, "licences.txt"), "utf8"),
  )) {
    const part = component(name, version, licence, purl);
    bom.components.add(part);
    own.dependencies.add(part.bomRef);
  }
  const factory = new Serialize.JSON.Normalize.Factory(Spec.Spec1dot6);
  const text = new Serialize.JsonSerializer(factory).serialize(bom, {
    sortLists: true,
    space: 2,
  });
  return `${text}\n`;
}
