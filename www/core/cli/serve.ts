// HTTP service: one route per task, worked on by threads.
import { createHash } from "node:crypto";
import { once } from "node:events";
import { readFileSync } from "node:fs";
import type { IncomingMessage, Server } from "node:http";
import { dirname, join } from "node:path";
import { Readable } from "node:stream";
import { fileURLToPath } from "node:url";
import { createAdaptorServer, type HttpBindings } from "@hono/node-server";
import { type Context, Hono } from "hono";
import { cors } from "hono/cors";
import { HTTPException } from "hono/http-exception";
import { requestId } from "hono/request-id";
import { type Config, catalog, jobSchema, version } from "../node.js";
import { Refused } from "./folder.js";
import type { Limits } from "./limits.js";
import { linesOf } from "./lines.js";
import { Metrics } from "./metrics.js";
import { openapi } from "./openapi.js";
import { performOn, Thread, type Workers } from "./pool.js";
import { JSON_TYPE, ROUTES, type Route } from "./routes.js";
import type { Item, Outcome, Task } from "./tasks.js";

interface Settings {
  port: number;
  host: string;
  threads: number;
  limits: Limits;
  config?: Config | undefined;
  /** Origins whose pages may read the answers; `*` is any. */
  origins?: string[];
  /** Decides about each request, except those of `UNGUARDED`. */
  authorize?: Authorize | undefined;
}

/** Whether a request is answered; otherwise it gets the status 401. */
export type Authorize = (request: {
  method: string;
  path: string;
  headers: Record<string, string>;
}) => boolean | Promise<boolean>;

/** Paths that a probe or a monitor asks for without a name. */
const UNGUARDED = ["/health", "/ready", "/metrics"];
/** Lifetime of an answer under an address that contains version and config. */
const NO_CACHE = "no-cache";
const FOR_EVER = "max-age=31536000, immutable";

/** Content types of the table formats. */
const FORMATS: Record<string, string> = {
  json: JSON_TYPE,
  csv: "text/csv",
  text: "text/plain",
};

type Env = { Bindings: HttpBindings };

/** A refusal: status and reason. */
const refused = (
  status: 400 | 401 | 404 | 412 | 413 | 415 | 503 | 504,
  message: string,
) => new HTTPException(status, { message });

/** A request that waits for a thread. */
interface Waiting {
  task: Task;
  bunch: Item[];
  done(outcomes: Outcome[]): void;
  fail(why: unknown): void;
}

/** Threads of a service. Each has one task at a time; a thread that ends or does not answer is replaced. */
class Crew implements Workers {
  private readonly threads: Thread[];
  private readonly busy: boolean[];
  /** Single requests take precedence over batches. */
  private readonly single: Waiting[] = [];
  private readonly many: Waiting[] = [];
  private ended = false;

  constructor(
    readonly width: number,
    private readonly wait: number,
  ) {
    this.threads = Array.from({ length: width }, () => new Thread());
    this.busy = this.threads.map(() => false);
  }

  /** Performs a task with one item. */
  async perform(task: Task, item: Item): Promise<Outcome> {
    const [outcome] = await this.queued(this.single, task, [item]);
    return outcome as Outcome;
  }

  ask(task: Task, bunch: Item[]): Promise<Outcome[]> {
    return this.queued(this.many, task, bunch);
  }

  /** Loads the module in every thread. */
  async warm(): Promise<void> {
    const item: Item = {
      source: "",
      place: "",
      text: '{"format":1,"cycle":{"type":"hole"}}',
    };
    await Promise.all(
      this.threads.map(() => this.perform({ command: "check" }, item)),
    );
  }

  async end(): Promise<void> {
    this.ended = true;
    await Promise.all(this.threads.map((thread) => thread.end()));
  }

  private queued(
    queue: Waiting[],
    task: Task,
    bunch: Item[],
  ): Promise<Outcome[]> {
    return new Promise((done, fail) => {
      queue.push({ task, bunch, done, fail });
      this.next();
    });
  }

  private next(): void {
    for (const [i, busy] of this.busy.entries()) {
      if (busy) continue;
      const work = this.single.shift() ?? this.many.shift();
      if (!work) return;
      void this.work(i, work);
    }
  }

  private async work(
    i: number,
    { task, bunch, done, fail }: Waiting,
  ): Promise<void> {
    const thread = this.threads[i] as Thread;
    this.busy[i] = true;
    let late: NodeJS.Timeout | undefined;
    const over = new Promise<never>((_, fail) => {
      late = setTimeout(
        () => fail(refused(504, "the answer took too long")),
        this.wait,
      );
    });
    try {
      done(await Promise.race([thread.ask(task, bunch), over]));
    } catch (why) {
      void thread.end();
      if (!this.ended) this.threads[i] = new Thread();
      fail(why);
    } finally {
      clearTimeout(late);
      this.busy[i] = false;
      this.next();
    }
  }
}

/** Body of a request, up to a number of bytes and within a number of milliseconds. */
async function bodyOf(
  incoming: IncomingMessage,
  most: number,
  wait: number,
): Promise<string> {
  const chunks: Buffer[] = [];
  let size = 0;
  const late = setTimeout(() => incoming.destroy(), wait);
  try {
    for await (const chunk of incoming) {
      size += (chunk as Buffer).length;
      if (size > most)
        throw refused(413, `the body is longer than ${most} bytes`);
      chunks.push(chunk as Buffer);
    }
  } catch (thrown) {
    if (thrown instanceof HTTPException) throw thrown;
    // The client has disconnected.
    throw refused(400, "the body did not come to its end");
  } finally {
    clearTimeout(late);
  }
  return Buffer.concat(chunks).toString("utf8");
}

/** Whether If-None-Match contains a tag. A proxy that compresses makes it a weak tag. */
const isKnown = (header: string | undefined, tag: string) =>
  (header ?? "")
    .split(",")
    .some((one) => one.trim().replace(/^W\//, "") === tag);

function json(text: string): unknown {
  try {
    return JSON.parse(text);
  } catch (thrown) {
    throw refused(400, `this is not JSON: ${(thrown as Error).message}`);
  }
}

/** Task and text of a request. */
function asked(route: Route, text: string): { task: Task; text: string } {
  if (route.takes === "text") return { task: route.task, text };
  const given = json(text);
  if (route.takes === "job") return { task: route.task, text };
  const { job, measured } = (given ?? {}) as {
    job?: unknown;
    measured?: unknown;
  };
  if (job === undefined || typeof measured !== "string")
    throw refused(
      400,
      'this route takes { "job": …, "measured": "what the machine printed" }',
    );
  return {
    task: { ...route.task, points: measured },
    text: JSON.stringify(job),
  };
}

/** The app with its shutdown. */
export class Service {
  private readonly crew: Crew;
  private readonly metrics = new Metrics();
  private readonly app = new Hono<Env>();
  private underWay = 0;
  private closing = false;
  private ready = false;
  private readonly salt: string;
  /** Version of the answers: of the package, and of the config if there is one. */
  private readonly edition: string;
  private server!: Server;

  constructor(private readonly settings: Settings) {
    this.crew = new Crew(settings.threads, settings.limits.wait);
    this.salt = JSON.stringify([version(), settings.config ?? null]);
    const hash = createHash("sha256").update(this.salt).digest("hex");
    this.edition = settings.config
      ? `${version()}-${hash.slice(0, 12)}`
      : version();
    this.routes();
  }

  /** Starts to listen; returns the address. */
  async listen(): Promise<string> {
    const { host, port, limits } = this.settings;
    this.server = createAdaptorServer({
      fetch: this.app.fetch,
      serverOptions: {
        // A body has its own timeout where it is read: jobs by the line may arrive for as long as there are any.
        requestTimeout: 0,
        headersTimeout: limits.wait,
        // Interval in which Node looks for requests that do not arrive; its default is 30 s.
        connectionsCheckingInterval: Math.max(limits.wait / 10, 100),
      },
    }) as Server;
    this.server.maxConnections = limits.connections;
    // Timeout of an idle connection.
    this.server.timeout = 6 * limits.wait;
    this.server.listen(port, host);
    try {
      await once(this.server, "listening");
    } catch (thrown) {
      await this.crew.end();
      throw new Refused(
        `${host}:${port} cannot be listened at: ${(thrown as Error).message}`,
      );
    }
    this.crew.warm().then(
      () => {
        this.ready = true;
      },
      (why) => {
        if (!this.closing) console.error(`the threads did not begin: ${why}`);
      },
    );
    const address = this.server.address() as { address: string; port: number };
    const name = address.address.includes(":")
      ? `[${address.address}]`
      : address.address;
    return `http://${name}:${address.port}`;
  }

  /** Finishes pending requests, accepts no new ones, and ends. */
  async close(): Promise<void> {
    this.closing = true;
    const closed = once(this.server, "close");
    this.server.close();
    this.server.closeIdleConnections();
    const late = setTimeout(
      () => this.server.closeAllConnections(),
      this.settings.limits.wait,
    );
    await closed;
    clearTimeout(late);
    await this.crew.end();
  }

  private routes(): void {
    const { app, settings } = this;
    app.use(requestId());
    app.use(async (c, next) => {
      const begin = performance.now();
      if (this.closing) c.header("connection", "close");
      await next();
      this.metrics.count(
        c.req.routePath,
        c.res.status,
        (performance.now() - begin) / 1000,
      );
    });
    const { origins = [], authorize } = settings;
    if (origins.length > 0)
      app.use(
        cors({
          origin: origins.includes("*") ? "*" : origins,
          exposeHeaders: ["etag", "x-request-id"],
        }),
      );
    if (authorize)
      app.use(async (c, next) => {
        const { method, path } = c.req;
        const headers = c.req.header();
        if (
          !UNGUARDED.includes(path) &&
          (await authorize({ method, path, headers })) !== true
        )
          throw refused(401, "this request is not authorised");
        await next();
      });
    app.onError((error, c) => {
      const status = error instanceof HTTPException ? error.status : 500;
      if (status === 500)
        console.error(`${c.get("requestId")}: ${error.stack ?? error}`);
      if (status === 503) c.header("retry-after", "1");
      c.header("cache-control", "no-store");
      // Does not wait for the rest of a body that is too long.
      if (status === 413) c.header("connection", "close");
      return c.json(
        {
          error:
            status === 500 ? "this should not have happened" : error.message,
        },
        status,
      );
    });
    app.notFound((c) =>
      c.json(
        { error: `there is no ${c.req.method} ${c.req.path.slice(0, 100)}` },
        404,
      ),
    );
    for (const route of ROUTES) {
      app.post(route.path, async (c) => {
        const type = c.req
          .header("content-type")
          ?.split(";")[0]
          ?.trim()
          .toLowerCase();
        const wanted = route.takes === "text" ? "text/plain" : JSON_TYPE;
        if (type !== wanted)
          throw refused(415, `the body of this route is ${wanted}`);
        if ((c.req.header("content-encoding") ?? "identity") !== "identity")
          throw refused(
            415,
            "the body comes as it is, without content-encoding",
          );
        const text = await bodyOf(
          c.env.incoming,
          settings.limits.body,
          settings.limits.wait,
        );
        return this.answer(c, route, text);
      });
      // A job in the address allows caches in between to keep the answer.
      if (route.takes === "job") {
        const read = (c: Context<Env>, lifetime: string) => {
          const job = c.req.query("job");
          if (job === undefined)
            throw refused(400, "the query has no job: ?job=, as JSON");
          return this.answer(c, route, job, lifetime);
        };
        // A cached answer is revalidated, which costs no plan.
        app.get(route.path, (c) => read(c, NO_CACHE));
        // An address with the version always has the same answer.
        app.get(`/v/:edition${route.path}`, (c) => {
          if (c.req.param("edition") !== this.edition)
            throw refused(404, `this service answers at /v/${this.edition}`);
          return read(c, FOR_EVER);
        });
      }
      this.others(
        route.path,
        route.takes === "job" ? "GET, HEAD, POST" : "POST",
      );
    }
    app.post("/programs", (c) => this.programs(c));
    this.others("/programs", "POST");
    const documents: Record<string, () => object> = {
      "/catalog": catalog,
      "/schema": jobSchema,
      "/answers.schema": answers,
      "/openapi.json": () => openapi(ROUTES, answers()),
    };
    for (const [path, make] of Object.entries(documents)) {
      app.get(path, (c) => {
        const tag = this.tag(path, "");
        if (isKnown(c.req.header("if-none-match"), tag))
          return c.body(null, 304, { etag: tag });
        return c.json(make(), 200, { etag: tag });
      });
      this.others(path, "GET, HEAD");
    }
    app.get("/health", (c) =>
      c.json({ good: true, version: version(), path: `/v/${this.edition}` }),
    );
    app.get("/ready", (c) => {
      const good = this.ready && !this.closing;
      return c.json({ good }, good ? 200 : 503);
    });
    app.get("/metrics", (c) =>
      c.text(this.metrics.text(this.underWay, this.settings.threads), 200, {
        "content-type": "text/plain; version=0.0.4; charset=utf-8",
      }),
    );
  }

  /** Refuses other methods of a path. */
  private others(path: string, allowed: string): void {
    this.app.all(path, (c) =>
      c.json({ error: `${path} takes ${allowed}` }, 405, { allow: allowed }),
    );
  }

  /** Key of an answer: version, config, route with its query, and the body. */
  private tag(asked: string, text: string): string {
    const hash = createHash("sha256").update(
      JSON.stringify([this.salt, asked, text]),
    );
    return `"${hash.digest("base64url")}"`;
  }

  /** Counts a request from its full arrival until its answer is sent. Requests beyond the limit would only wait for each other. */
  private enter({ incoming, outgoing }: HttpBindings): void {
    const { socket } = incoming;
    // A connection that has closed already sends no event.
    if (socket.destroyed) return;
    if (this.underWay >= this.settings.limits.requests)
      throw refused(503, "too many requests at once");
    this.underWay++;
    // An answer queued after another on its connection never closes if the connection does.
    socket.setMaxListeners(0);
    let over = false;
    const end = () => {
      if (over) return;
      over = true;
      this.underWay--;
      socket.off("close", end);
    };
    outgoing.once("close", end);
    socket.once("close", end);
  }

  /** How long and by whom an answer is kept: where requests are authorised, no shared cache may hand it to others. */
  private kept(lifetime: string): string {
    const shared = this.settings.authorize ? "private" : "public";
    return lifetime === FOR_EVER ? `${shared}, ${lifetime}` : NO_CACHE;
  }

  private async answer(
    c: Context<Env>,
    route: Route,
    body: string,
    lifetime = "",
  ): Promise<Response> {
    const [word = "", forms = []] = route.query ?? [];
    const form = word === "" ? undefined : c.req.query(word);
    if (form !== undefined && !forms.includes(form))
      throw refused(400, `${word} is one of ${forms.join(", ")}`);
    const { task, text } = asked(route, body);
    const tag = this.tag(`${route.path} ${form ?? ""}`, body);
    const reads = lifetime !== "";
    if (isKnown(c.req.header("if-none-match"), tag))
      return reads
        ? c.body(null, 304, { etag: tag, "cache-control": this.kept(lifetime) })
        : c.json({ error: "the answer is the one that you have" }, 412, {
            etag: tag,
          });
    this.enter(c.env);
    const { config } = this.settings;
    const own: Task = {
      ...task,
      outputOnly: true,
      ...(config ? { config } : {}),
      ...(form === undefined ? {} : { [word]: form }),
    };
    const outcome = await this.crew.perform(own, {
      source: route.path,
      place: "",
      text,
    });
    const isGood = outcome.output !== null || route.task.command === "check";
    // A failed answer gets no tag, so it is planned again.
    if (isGood) c.header("etag", tag);
    if (reads) c.header("cache-control", this.kept(isGood ? lifetime : ""));
    if (route.task.command === "check") return c.json(outcome.findings);
    if (!outcome.output) {
      const [first] = outcome.findings.filter(({ level }) => level === "error");
      return c.json(
        {
          error: first?.message ?? "there is no answer",
          findings: outcome.findings,
        },
        422,
      );
    }
    const type =
      (route.path === "/table" && FORMATS[form ?? "json"]) || route.gives.type;
    return c.body(outcome.output.text, 200, {
      "content-type": `${type}; charset=utf-8`,
    });
  }

  /** Reads a job per line and writes an outcome per line, as a stream. */
  private programs(c: Context<Env>): Response {
    if (!c.req.header("content-type")?.startsWith("application/x-ndjson"))
      throw refused(415, "the body of this route is application/x-ndjson");
    this.enter(c.env);
    const { config, limits } = this.settings;
    const task: Task = { command: "plan", ...(config ? { config } : {}) };
    const crew = this.crew;
    async function* items(): AsyncGenerator<Item> {
      for await (const { number, text, tooLong } of linesOf(
        c.env.incoming,
        limits.body,
      )) {
        if (text.trim() === "" && !tooLong) continue;
        const long = tooLong
          ? { refused: `a line is longer than ${limits.body} characters` }
          : {};
        yield { source: String(number), row: number, place: "", text, ...long };
      }
    }
    async function* lines(): AsyncGenerator<string> {
      for await (const { row, output, findings } of performOn(
        crew,
        task,
        items(),
      ))
        yield `${JSON.stringify({ line: row, program: output?.text ?? null, findings })}\n`;
    }
    const stream = Readable.toWeb(
      Readable.from(lines(), { objectMode: false }),
    ) as ReadableStream;
    return c.body(stream, 200, {
      "content-type": "application/x-ndjson; charset=utf-8",
    });
  }
}

/** Schema of the answers, as in the package. */
function answers(): Record<string, unknown> {
  const file = join(
    dirname(fileURLToPath(import.meta.url)),
    "..",
    "answers.schema.json",
  );
  return JSON.parse(readFileSync(file, "utf8"));
}

/** Serves until a signal ends the process. */
export async function serve(settings: Settings): Promise<void> {
  const told = new Promise<void>((done) => {
    for (const signal of ["SIGTERM", "SIGINT"] as const)
      process.once(signal, () => done());
  });
  const service = new Service(settings);
  const address = await service.listen();
  process.stdout.write(`Touchpath ${version()} at ${address}\n`);
  await told;
  await service.close();
  process.stdout.write("closed\n");
}
