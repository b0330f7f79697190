// What editors and other tools read of the element: made of the doc comments of www/element.ts.
export default {
  globs: ["www/element.ts"],
  outdir: "dist",
  plugins: [
    {
      name: "public",
      // What is the element's own business is no business of an editor; and the file is another one in the package.
      /** @param {any} phase */
      packageLinkPhase({ customElementsManifest }) {
        for (const module of customElementsManifest.modules) {
          module.path = "dist/element/element.js";
          module.declarations = module.declarations.filter((/** @type {any} */ one) => one.customElement);
          module.exports = module.exports.filter(
            (/** @type {any} */ one) => one.name === "TouchPath" || one.kind !== "js",
          );
          for (const one of module.declarations) {
            // The events by their names; the analyzer also finds the one place that sends them.
            one.events = one.events.filter((/** @type {any} */ event) => event.name !== "name");
            const hidden = (/** @type {any} */ member) =>
              member.privacy === "private" ||
              /Callback$/.test(member.name) ||
              /@internal/.test(member.description ?? "");
            one.members = one.members.filter(
              (/** @type {any} */ member) =>
                !hidden(member) &&
                !["formAssociated", "observedAttributes", "store", "app", "tell"].includes(member.name),
            );
          }
        }
        for (const module of customElementsManifest.modules)
          for (const one of [...module.exports, ...module.declarations])
            if (one.declaration?.module) one.declaration.module = module.path;
      },
    },
  ],
};
