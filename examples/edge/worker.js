// Programs at the edge: POST a job, get its program. Bundled for workerd, which takes the module as an import of its own.
import { JobError, plan, version } from "touchpath";

const json = (status, value) => Response.json(value, { status });
const hex = (bytes) =>
  Array.from(new Uint8Array(bytes), (byte) =>
    byte.toString(16).padStart(2, "0"),
  ).join("");

export default {
  async fetch(request) {
    if (request.method !== "POST") return json(405, { error: "POST a job" });
    const text = await request.text();
    if (text.length > 2_000_000)
      return json(413, {
        error: "A job has at most 2 million characters here",
      });
    // The same job gives the same program, wherever and whenever it is planned.
    const tag = `"${hex(await crypto.subtle.digest("SHA-256", new TextEncoder().encode(`${version()} ${text}`)))}"`;
    if (request.headers.get("if-none-match") === tag)
      return new Response(null, { status: 412, headers: { etag: tag } });
    try {
      const { program } = plan(JSON.parse(text));
      return new Response(program.text, {
        headers: { "content-type": "text/plain; charset=utf-8", etag: tag },
      });
    } catch (thrown) {
      if (thrown instanceof JobError)
        return json(422, { findings: thrown.findings });
      if (thrown instanceof SyntaxError)
        return json(400, { error: "This is not JSON" });
      throw thrown;
    }
  },
};
