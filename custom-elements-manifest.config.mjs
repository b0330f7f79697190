// What editors and other tools read of the elements: made of the doc comments of www/element.ts.
export default {
  globs: ["www/element.ts"],
  outdir: "dist",
  plugins: [
    {
      name: "public",
      // What is the element's own business is no business of an editor; and the file is another one in the package.
      /** @param {any} phase */
      packageLinkPhase({ customElementsManifest }) {
        const names = new Set([
          "TouchPath",
          "TouchForm",
          "TouchPicture",
          "TouchProgram",
        ]);
        for (const module of customElementsManifest.modules) {
          module.path = "dist/element/element.js";
          const shared = module.declarations.find(
            (/** @type {any} */ one) => one.name === "TouchPart",
          );
          module.declarations = module.declarations.filter(
            (/** @type {any} */ one) => names.has(one.name),
          );
          module.exports = module.exports.filter((/** @type {any} */ one) =>
            names.has(one.declaration?.name),
          );
          for (const one of module.declarations) {
            // The events by their names; the analyzer also finds the places that send them, one of them to panels elsewhere.
            one.events = (one.events ?? []).filter(
              (/** @type {any} */ event) =>
                !["name", "HERE"].includes(event.name),
            );
            const hidden = (/** @type {any} */ member) =>
              ["private", "protected"].includes(member.privacy) ||
              /Callback$/.test(member.name) ||
              /@internal/.test(member.description ?? "");
            one.members = (one.members ?? shared.members).filter(
              (/** @type {any} */ member) =>
                !hidden(member) &&
                ![
                  "formAssociated",
                  "observedAttributes",
                  "store",
                  "app",
                  "tell",
                ].includes(member.name),
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
