// What editors and other tools read of the elements: made of the doc comments of www/element/.
export default {
  globs: ["www/element.ts", "www/element/*.ts"],
  outdir: "dist/touchpath-element",
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
        // In the package they are one file, which begins with the whole element.
        const { modules } = customElementsManifest;
        const all = (/** @type {"declarations" | "exports"} */ key) =>
          modules
            .flatMap((/** @type {any} */ one) => one[key] ?? [])
            .sort(
              (/** @type {any} */ a, /** @type {any} */ b) =>
                Number(b.name === "TouchPath") - Number(a.name === "TouchPath"),
            );
        customElementsManifest.modules = [
          {
            ...modules[0],
            declarations: all("declarations"),
            // The entry names again what the others declare.
            exports: all("exports").filter(
              (
                /** @type {any} */ one,
                /** @type {number} */ k,
                /** @type {any[]} */ every,
              ) => every.findIndex(({ name }) => name === one.name) === k,
            ),
          },
        ];
        for (const module of customElementsManifest.modules) {
          module.path = "element/element.js";
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
        const inPackage = (/** @type {any} */ one) => {
          if (typeof one.module === "string") one.module = "element/element.js";
          for (const inside of Object.values(one))
            if (typeof inside === "object" && inside !== null)
              inPackage(inside);
        };
        inPackage(customElementsManifest.modules);
      },
    },
  ],
};
