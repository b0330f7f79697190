// The command for the package: the core stays the package's own, everything else is put in.
import { defineConfig } from "vite";

export default defineConfig({
  root: "www/core",
  publicDir: false,
  ssr: { noExternal: true },
  plugins: [
    {
      name: "core",
      enforce: "pre",
      resolveId: (id) =>
        /^\.\.\/(node|report)\.js$/.test(id) ? { id, external: true } : null,
    },
  ],
  build: {
    ssr: true,
    outDir: "../../dist/cli",
    emptyOutDir: true,
    target: "node20",
    minify: true,
    license: { fileName: "licences.txt" },
    rolldownOptions: {
      input: ["www/core/cli/touchpath.ts", "www/core/cli/worker.ts"],
      output: { chunkFileNames: "[name].js" },
    },
  },
});
