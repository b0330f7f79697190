import { defineConfig } from "vite";

export default defineConfig({
  root: "www",
  base: "./",
  build: {
    outDir: "../dist/page",
    emptyOutDir: true,
    target: "es2022",
    assetsInlineLimit: 0,
    license: { fileName: "licences.txt" },
  },
});
