// Touchpath as a service: POST /plan, /check and /import; GET /openapi.json and /health. PORT, HOST, LONGEST_BODY, MOST_AT_ONCE, MOST_CONNECTIONS and
// PATIENCE set it up; CONFIG is a file with the rules that jobs are filled in and judged by.
import { readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import Fastify from "fastify";
import { check, checkConfig, importJob, JobError, jobSchema, plan, version } from "touchpath";

const setting = (name, otherwise) => Number(process.env[name] ?? otherwise);
/** Bytes of a body, requests at once, connections, and milliseconds for a request to come. */
const LONGEST_BODY = setting("LONGEST_BODY", 2_000_000);
const MOST_AT_ONCE = setting("MOST_AT_ONCE", 64);
const MOST_CONNECTIONS = setting("MOST_CONNECTIONS", 1024);
const PATIENCE = setting("PATIENCE", 10_000);

const answers = JSON.parse(readFileSync(fileURLToPath(import.meta.resolve("touchpath/answers.schema.json")), "utf8"));

/** The rules of the portal; none where no file is named. A wrong one ends the service before it begins. */
const config = process.env.CONFIG ? JSON.parse(readFileSync(process.env.CONFIG, "utf8")) : undefined;
const faults = config === undefined ? [] : checkConfig(config);
if (faults.length > 0) {
  for (const { path, message } of faults) console.error(`${path}: ${message}`);
  process.exit(1);
}

const app = Fastify({
  bodyLimit: LONGEST_BODY,
  requestTimeout: PATIENCE,
  connectionTimeout: 2 * PATIENCE,
  forceCloseConnections: "idle",
  // Node looks for requests that do not come only so often, by itself every 30 s.
  http: { headersTimeout: PATIENCE, connectionsCheckingInterval: Math.max(PATIENCE / 10, 100) },
});
app.server.maxConnections = MOST_CONNECTIONS;

// More at once than this would only wait for each other: further requests are refused with 503 and may be repeated. A request counts when all of it is
// there: one that never comes holds nobody up.
let underWay = 0;
app.addHook("preValidation", async (request, reply) => {
  // Of a connection that is gone already there will be no end to hear of.
  if (request.url === "/health" || request.raw.socket.destroyed) return;
  if (underWay >= MOST_AT_ONCE)
    return reply.code(503).header("retry-after", "1").send({ error: "too many requests at once" });
  underWay++;
  // An answer that waits behind another one on its connection never closes where the connection does.
  const { socket } = request.raw;
  socket.setMaxListeners(0);
  let over = false;
  const end = () => {
    if (over) return;
    over = true;
    underWay--;
    socket.off("close", end);
  };
  reply.raw.once("close", end);
  socket.once("close", end);
});

// Every error is JSON of one form; internal faults are logged, not sent.
app.setErrorHandler((error, _request, reply) => {
  if (error instanceof JobError) return reply.code(422).send({ error: error.message, findings: error.findings });
  const status = error.statusCode ?? 500;
  if (status >= 500) console.error(error);
  return reply.code(status).send({ error: status >= 500 ? "this should not have happened" : error.message });
});
app.setNotFoundHandler((request, reply) =>
  reply.code(404).send({ error: `there is no ${request.method} ${request.url.slice(0, 100)}` }),
);

app.post("/plan", async (request) => plan(request.body, config));
app.post("/check", async (request) => check(request.body, config));
app.addContentTypeParser("text/plain", { parseAs: "string" }, (_request, body, done) => done(null, body));
app.post("/import", async (request, reply) => {
  if (typeof request.body !== "string")
    return reply.code(415).send({ error: "the text to import comes as text/plain" });
  return importJob(request.body);
});
app.get("/health", async () => ({ good: true, version: version() }));
app.get("/openapi.json", async () => openapi());

/** What stands above, for clients: what goes in and what comes out is the package's own schemas. */
function openapi() {
  const named = (name) => ({ $ref: `#/components/schemas/${name}` });
  const json = (schema, example) => ({ "application/json": { schema, ...(example ? { example } : {}) } });
  const findings = { type: "array", items: named("Finding") };
  const failed = { type: "object", required: ["error"], properties: { error: { type: "string" }, findings } };
  const answer = (description, schema) => ({ description, content: json(schema) });
  const others = Object.fromEntries(
    [
      ["400", "The body is no JSON"],
      ["413", "The body is too long"],
      ["415", "The body is of another content type"],
      ["422", "The job has errors: findings says which"],
      ["503", "Too many requests at once"],
    ].map(([status, description]) => [status, answer(description, failed)]),
  );
  const post = (operationId, summary, content, schema) => ({
    post: {
      operationId,
      summary,
      requestBody: { required: true, content },
      responses: { 200: answer("Good", schema), ...others },
    },
  });
  const example = { format: 1, name: "BORE", cycle: { type: "hole", diameter: 32 }, control: { post: "haas" } };
  const health = { type: "object", properties: { good: { type: "boolean" }, version: { type: "string" } } };
  // The definitions stand here under components, and the job beside them.
  const here = JSON.stringify(answers.$defs)
    .replaceAll("#/$defs/", "#/components/schemas/")
    .replaceAll("urn:touchpath:job:1", "#/components/schemas/Job");
  return {
    openapi: "3.1.0",
    info: { title: "Touchpath", version: version() },
    paths: {
      "/plan": post("plan", "The whole plan of a job", json(named("Job"), example), named("Plan")),
      "/check": post(
        "check",
        "Everything that is wrong, unusual or worth knowing about a job",
        json({}, example),
        findings,
      ),
      "/import": post(
        "importJob",
        "A job from a dump or a program, or the moves of a program",
        { "text/plain": { schema: { type: "string" } } },
        named("Imported"),
      ),
      "/health": {
        get: { operationId: "health", summary: "Whether it works", responses: { 200: answer("Good", health) } },
      },
    },
    components: { schemas: { Job: jobSchema(), ...JSON.parse(here) } },
  };
}

const address = await app.listen({ port: setting("PORT", 3000), host: process.env.HOST ?? "127.0.0.1" });
console.log(`Touchpath ${version()} at ${address}`);

// What is under way is answered, nothing new is taken, and then it ends.
for (const signal of ["SIGTERM", "SIGINT"])
  process.once(signal, async () => {
    await app.close();
    console.log("closed");
  });
