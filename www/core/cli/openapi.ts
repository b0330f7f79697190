// OpenAPI description of the service, made from the package's own schemas.
import { jobSchema, version } from "../node.js";
import type { Route } from "./routes.js";

const JOB = {
  format: 1,
  name: "BORE",
  cycle: { type: "hole", diameter: 32 },
  control: { post: "haas" },
};

const EDITION = {
  name: "edition",
  in: "path",
  required: true,
  schema: { type: "string" },
};

const named = (name: string) => ({ $ref: `#/components/schemas/${name}` });
const text = { type: "string" };
const object = (
  properties: Record<string, object>,
  required = Object.keys(properties),
) => ({
  type: "object",
  required,
  properties,
});
const content = (type: string, schema: object, example?: unknown) => ({
  [type]: { schema, ...(example === undefined ? {} : { example }) },
});
const answer = (description: string, type: string, schema: object) => ({
  description,
  content: content(type, schema),
});

/** Possible errors of a request. */
const FAULTS: readonly [string, string][] = [
  ["400", "The body is no JSON, or the query says what there is not"],
  ["401", "The service's authorisation refuses the request"],
  [
    "412",
    "The answer has the ETag of If-None-Match: the client has it already",
  ],
  ["413", "The body is too long"],
  ["415", "The body is of another content type"],
  ["422", "The job has errors: findings says which"],
  ["500", "A fault of the service, which its log says by x-request-id"],
  ["503", "Too many requests at once"],
  ["504", "The answer took too long"],
];

/** Successful answer of a route. */
function good({ path, gives, id }: Route) {
  if (path === "/check")
    return answer("Good", gives.type, {
      type: "array",
      items: named("Finding"),
    });
  if (path === "/table")
    return {
      description: "Good",
      content: {
        ...content("application/json", {}),
        ...content("text/csv", text),
        ...content("text/plain", text),
      },
    };
  if (gives.schema) return answer("Good", gives.type, named(gives.schema));
  return answer(
    "Good",
    gives.type,
    gives.type === "application/json" ? { title: id } : text,
  );
}

function takes(route: Route) {
  if (route.takes === "text") return content("text/plain", text);
  // Errors of a job are findings, so any job may be sent.
  if (route.takes === "job")
    return content(
      "application/json",
      route.path === "/check" ? {} : named("Job"),
      JOB,
    );
  return content(
    "application/json",
    object({ job: named("Job"), measured: text }),
    {
      job: JOB,
      measured: "center.x=0.01",
    },
  );
}

/** OpenAPI description. `answers`: schema of the answers. */
export function openapi(
  routes: readonly Route[],
  answers: Record<string, unknown>,
): object {
  const failed = object(
    { error: text, findings: { type: "array", items: named("Finding") } },
    ["error"],
  );
  const others = Object.fromEntries(
    FAULTS.map(([status, about]) => [
      status,
      answer(about, "application/json", failed),
    ]),
  );
  const paths: Record<string, object> = {};
  for (const route of routes) {
    const [word, forms] = route.query ?? [];
    const parameters = word
      ? [{ name: word, in: "query", schema: { enum: forms } }]
      : [];
    const responses = { 200: good(route), ...others };
    const body = { required: true, content: takes(route) };
    const post = {
      operationId: route.id,
      summary: route.about,
      parameters,
      requestBody: body,
      responses,
    };
    const job = {
      name: "job",
      in: "query",
      required: true,
      content: content("application/json", named("Job"), JOB),
    };
    const get = {
      operationId: `${route.id}Of`,
      summary: `${route.about}, of a job in the address`,
      parameters: [job, ...parameters],
      responses: {
        ...responses,
        304: {
          description: "The answer is the one whose ETag If-None-Match says",
        },
      },
    };
    paths[route.path] = { post, ...(route.takes === "job" ? { get } : {}) };
    if (route.takes === "job")
      paths[`/v/{edition}${route.path}`] = {
        get: {
          ...get,
          operationId: `${route.id}For`,
          summary: `${get.summary}, under an address whose answer never changes: /health names the edition`,
          parameters: [EDITION, ...get.parameters],
        },
      };
  }
  const lines = "application/x-ndjson";
  const ndjson = answer(
    "A line a job: its line, its program or null, its findings",
    lines,
    text,
  );
  paths["/programs"] = {
    post: {
      operationId: "programs",
      summary: "The programs of many jobs, a job a line, as they come",
      requestBody: { required: true, content: content(lines, text) },
      responses: { 200: ndjson, 415: others["415"], 503: others["503"] },
    },
  };
  const flag = object({ good: { type: "boolean" } });
  const documents: [string, string, string, object][] = [
    ["/catalog", "catalog", "Cycles, fields and controls", named("Catalog")],
    ["/schema", "schema", "The JSON Schema of a job", { type: "object" }],
    [
      "/answers.schema",
      "answersSchema",
      "The JSON Schema of what comes out",
      { type: "object" },
    ],
    [
      "/health",
      "health",
      "Whether the service lives",
      object({ good: { type: "boolean" }, version: text, path: text }),
    ],
    [
      "/ready",
      "ready",
      "Whether it takes requests; 503 where it does not",
      flag,
    ],
  ];
  for (const [path, operationId, summary, schema] of documents) {
    const late =
      path === "/ready"
        ? { 503: answer("It does not", "application/json", schema) }
        : {};
    const responses = {
      200: answer("Good", "application/json", schema),
      ...late,
    };
    paths[path] = { get: { operationId, summary, responses } };
  }
  const metrics = { 200: answer("Good", "text/plain", text) };
  paths["/metrics"] = {
    get: {
      operationId: "metrics",
      summary: "Counters, as Prometheus reads them",
      responses: metrics,
    },
  };
  // The definitions move to components, beside the job.
  const here = JSON.stringify(answers.$defs)
    .replaceAll("#/$defs/", "#/components/schemas/")
    .replaceAll("urn:touchpath:job:1", "#/components/schemas/Job");
  return {
    openapi: "3.1.0",
    info: { title: "Touchpath", version: version() },
    paths,
    components: { schemas: { Job: jobSchema(), ...JSON.parse(here) } },
  };
}
