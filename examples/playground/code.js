// The code that a portal writes for what is set in the playground.

/** The frameworks, by what their tabs say. */
export const FRAMEWORKS = [
  "HTML",
  "React",
  "Vue",
  "Svelte",
  "Angular",
  "Frame",
];

const PARTS = ["touch-form", "touch-picture", "touch-program"];
const escaped = (text) =>
  text
    .replaceAll("&", "&amp;")
    .replaceAll('"', "&quot;")
    .replaceAll("<", "&lt;");
/** A value in a script: a `<` would end the element that the script is in. */
const value = (one, space = 2) =>
  JSON.stringify(one, null, space).replaceAll("<", "\\u003c");
const indented = (text, by) => text.replaceAll("\n", `\n${" ".repeat(by)}`);

/**
 * @param {string} framework one of FRAMEWORKS
 * @param {{ attributes: Record<string, string | true>, config: object | null, apart: boolean }} set
 */
export function code(framework, { attributes, config, apart }) {
  const all = Object.entries(
    apart ? { ...attributes, panels: "none" } : attributes,
  );
  const words = all
    .map(([name, given]) =>
      given === true ? ` ${name}` : ` ${name}="${escaped(given)}"`,
    )
    .join("");
  const others = (indent) =>
    apart
      ? PARTS.map((tag) => `\n${indent}<${tag} for="job"></${tag}>`).join("")
      : "";
  const tag = (more = "") =>
    `<touch-path${apart ? ' id="job" hidden' : ""}${words}${more}>`;
  const size = apart ? "" : ' style="height: 700px"';
  switch (framework) {
    case "HTML":
      return `<script type="module" src="touchpath/element/element.js"></script>
${tag(size)}${config ? `\n  <script type="application/json">${indented(value(config), 2)}</script>\n` : ""}</touch-path>${others("")}
<script type="module">
  const element = document.querySelector("touch-path");
  element.addEventListener("job-change", ({ detail }) => console.log(detail.job));
  element.addEventListener("program-save", (event) => {
    event.preventDefault(); // the portal keeps the program
    console.log(event.detail.name, event.detail.text);
  });
</script>
`;
    case "React": {
      const props = all
        .map(([name, given]) =>
          given === true ? ` ${name}` : ` ${name}=${JSON.stringify(given)}`,
        )
        .join("");
      const own = `<TouchPath${apart ? ' id="job" hidden' : " style={{ height: 700 }}"}${props}${config ? " config={config}" : ""} onjob-change={(event) => setJob(event.detail.job)} />`;
      const inner = apart
        ? `<>\n      ${own}${others("      ")}\n    </>`
        : own;
      return `"use client";
import { useState } from "react";
import { TouchPath } from "touchpath-element/react";
${config ? `\nconst config = ${value(config)};\n` : ""}
export function Probing() {
  const [job, setJob] = useState();
  return (
    ${inner}
  );
}
`;
    }
    case "Vue":
      return `<script setup>
// In vite.config.js: vue({ template: { compilerOptions: { isCustomElement: (tag) => tag.startsWith("touch-") } } })
import "touchpath-element";
${config ? `\nconst config = ${value(config)};\n` : ""}const keep = (event) => console.log(event.detail.job);
</script>

<template>
  ${tag(`${config ? ' :config.prop="config"' : ""} @job-change="keep"${size}`)}</touch-path>${others("  ")}
</template>
`;
    case "Svelte":
      return `<script>
  import "touchpath-element";
${config ? `\n  const config = ${indented(value(config), 2)};\n` : ""}  const keep = (event) => console.log(event.detail.job);
</script>

${tag(`${config ? " {config}" : ""} onjob-change={keep}${size}`)}</touch-path>${others("")}
`;
    case "Angular":
      return `import { Component, CUSTOM_ELEMENTS_SCHEMA } from "@angular/core";
import "touchpath-element";
import type { TouchPathEvents } from "touchpath-element";

@Component({
  selector: "app-probing",
  schemas: [CUSTOM_ELEMENTS_SCHEMA],
  template: \`${tag(`${config ? ' [config]="config"' : ""} (job-change)="keep($event)"${size}`)}</touch-path>${others("    ")}\`,
})
export class Probing {
${config ? `  config = ${indented(value(config), 2)};\n` : ""}  keep(event: TouchPathEvents["job-change"]) {
    console.log(event.detail.job);
  }
}
`;
    default: {
      // What a frame shows is one element: it has no panels apart.
      const given = { ...attributes, ...(config ? { config } : {}) };
      return `<iframe src="https://touchpath.example/embed.html" title="Probing" width="100%" height="700"></iframe>
<script type="module">
  import { connect } from "./touchpath/frame.js";
  const frame = await connect(document.querySelector("iframe"), { origin: "https://touchpath.example", saves: true });
  await frame.set(${indented(value(given), 2)});
  frame.addEventListener("job-change", ({ detail }) => console.log(detail.job));
</script>
`;
    }
  }
}
