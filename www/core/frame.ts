// A portal's side of a frame with embed.html: a few functions instead of messages.
import {
  type Answer,
  type FrameState,
  type FrameView,
  type Hello,
  PROTOCOL,
  type Request,
} from "./protocol.js";
import type { Finding, Job, Plan } from "./types.js";

export type * from "./protocol.js";
export { PROTOCOL } from "./protocol.js";

/** Thrown where the frame refuses a request; `findings` says why, where there is more to say. */
export class FrameError extends Error {
  constructor(
    message: string,
    readonly findings: Finding[] = [],
  ) {
    super(message);
    this.name = "FrameError";
  }
}

/** How long is waited for an answer of the frame, milliseconds. */
const PATIENCE = 15_000;

/** How a portal connects. */
export interface ConnectOptions {
  /** The origin that the frame is served from: `https://touchpath.example`, never `*`. A frame of another origin gets no message. */
  origin: string;
  /** Whether the portal saves programs itself; else the frame hands them out as files. */
  saves?: boolean;
  /** How long to wait for an answer of the frame, milliseconds. */
  patience?: number;
}

/** The events of a frame, by name. */
export interface FrameEvents {
  "job-change": CustomEvent<{ job: Job }>;
  "plan-change": CustomEvent<{ plan: Plan }>;
  "selection-change": CustomEvent<{
    move: number | null;
    line: number | null;
    touch: number | null;
    field: string | null;
  }>;
  "measured-change": CustomEvent<{ measured: string }>;
  "program-save": CustomEvent<{
    name: string;
    text: string;
    post: string;
    extension: string;
  }>;
  finding: CustomEvent<{ findings: Finding[]; refused: boolean }>;
  /** The frame was loaded anew and has back what it had; `refused` says what of it could not be set again. */
  load: CustomEvent<{ refused: string | null }>;
}

interface Waiting {
  done(answer?: FrameView | string | null): void;
  fail(why: FrameError): void;
}

/**
 * A frame that has answered. Its events are those of `<touch-path>`: `job-change`, `plan-change`, `selection-change`, `measured-change`, `program-save`, `finding`;
 * and `load` where the frame was loaded anew.
 */
export class Frame extends EventTarget {
  private readonly waiting = new Map<number, Waiting>();
  private last = 0;
  private ended = false;
  private port: MessagePort;
  // A frame that is loaded anew gets everything that was set, with the present job and measured points.
  private state: FrameState = {};
  private of: string;
  // What is waited for while the frame is loaded anew; the last load counts.
  private there: Promise<void> = Promise.resolve();

  constructor(
    port: MessagePort,
    version: string,
    // How long to wait for an answer, milliseconds.
    private readonly patience = PATIENCE,
    // What else ends with the connection.
    private readonly over: () => void = () => undefined,
  ) {
    super();
    this.port = port;
    this.of = version;
    this.listen();
  }

  /** The version of Touchpath in the frame. */
  get version(): string {
    return this.of;
  }

  private listen(): void {
    this.port.onmessage = ({ data }: MessageEvent<Answer>) =>
      this.receive(data);
  }

  /**
   * The frame was loaded anew: `hello` gives the port and the version of what is there now. What is asked meanwhile waits for it. @internal
   */
  async loaded(
    hello: Promise<{ port: MessagePort; version: string }>,
  ): Promise<void> {
    this.port.onmessage = null;
    this.port.close();
    this.fail("The frame was loaded anew");
    let free = () => {};
    const there = new Promise<void>((done) => {
      free = done;
    });
    this.there = there;
    let refused: string | null = null;
    try {
      const { port, version } = await hello;
      if (this.ended || this.there !== there) {
        port.postMessage({ type: "end" } satisfies Request);
        port.close();
        return;
      }
      [this.port, this.of] = [port, version];
      this.listen();
      const { state } = this;
      if (Object.keys(state).length > 0)
        await this.send((id) => ({ type: "set", id, state }));
    } catch (why) {
      if (this.there !== there) return;
      // Or it shows another page now: what is asked from here on gets no answer, and says so.
      refused = (why as Error).message;
    } finally {
      free();
    }
    this.dispatchEvent(new CustomEvent("load", { detail: { refused } }));
  }

  override addEventListener<K extends keyof FrameEvents>(
    type: K,
    listener: ((event: FrameEvents[K]) => void) | null,
    options?: boolean | AddEventListenerOptions,
  ): void;
  override addEventListener(
    type: string,
    listener: EventListenerOrEventListenerObject | null,
    options?: boolean | AddEventListenerOptions,
  ): void;
  override addEventListener(
    type: string,
    // biome-ignore lint/suspicious/noExplicitAny: the overloads say which event it is.
    listener: any,
    options?: boolean | AddEventListenerOptions,
  ): void {
    super.addEventListener(type, listener, options);
  }

  /** Sets the job, the control, what is shown: all of it, or, where any of it cannot be used, nothing. Then it fails with the reasons. */
  async set(state: FrameState): Promise<void> {
    await this.ask((id) => ({ type: "set", id, state }));
    const appearance = { ...this.state.appearance, ...state.appearance };
    this.state = {
      ...this.state,
      ...state,
      ...(Object.keys(appearance).length > 0 ? { appearance } : {}),
    };
  }

  /** Saves the program as the Save button does. Fails if the job has errors. */
  async save(): Promise<void> {
    await this.ask((id) => ({ type: "do", id, deed: { do: "save" } }));
  }

  /** Undoes the user's last step. Fails if there is nothing to undo. */
  async undo(): Promise<void> {
    await this.ask((id) => ({ type: "do", id, deed: { do: "undo" } }));
  }

  /** Redoes the step that was undone last. Fails if there is nothing to redo. */
  async redo(): Promise<void> {
    await this.ask((id) => ({ type: "do", id, deed: { do: "redo" } }));
  }

  /** Highlights a move of the plan, counted from 0; `null` shows the user's selection again. */
  async highlight(move: number | null): Promise<void> {
    await this.ask((id) => ({
      type: "do",
      id,
      deed: { do: "highlight", move },
    }));
  }

  /** The present job, its plan, its findings and the measured points. */
  async get(): Promise<FrameView> {
    return (await this.ask((id) => ({ type: "get", id }))) as FrameView;
  }

  /** The picture in its present view, as SVG text; `null` without a plan. */
  async picture(): Promise<string | null> {
    return (await this.ask((id) => ({ type: "picture", id }))) as string | null;
  }

  /** Ends the connection. Requests without an answer fail. */
  close(): void {
    if (this.ended) return;
    this.port.postMessage({ type: "end" } satisfies Request);
    this.end("The frame was closed");
  }

  private end(why: string): void {
    this.ended = true;
    this.over();
    this.port.close();
    this.fail(why);
  }

  // What was asked gets no answer.
  private fail(why: string): void {
    for (const { fail } of this.waiting.values()) fail(new FrameError(why));
    this.waiting.clear();
  }

  private async ask(
    request: (id: number) => Request,
  ): Promise<FrameView | string | null | undefined> {
    // Another load may come while one is waited for.
    let there: Promise<void>;
    do {
      there = this.there;
      await there;
    } while (there !== this.there);
    return this.send(request);
  }

  private send(
    request: (id: number) => Request,
  ): Promise<FrameView | string | null | undefined> {
    return new Promise((done, fail) => {
      if (this.ended) {
        fail(new FrameError("This connection with the frame is closed"));
        return;
      }
      const id = ++this.last;
      // A frame that was taken out or has loaded another page says nothing any more.
      const ending = setTimeout(() => {
        this.waiting.delete(id);
        fail(new FrameError("The frame does not answer"));
      }, this.patience);
      this.waiting.set(id, {
        done: (given) => {
          clearTimeout(ending);
          done(given);
        },
        fail: (why) => {
          clearTimeout(ending);
          fail(why);
        },
      });
      this.port.postMessage(request(id));
    });
  }

  private receive(answer: Answer): void {
    if (answer.type === "ended")
      this.end("Another connection has replaced this one");
    if (answer.type === "job-change") {
      // The job contains a cycle that was set before.
      const { cycle: _, ...state } = this.state;
      this.state = { ...state, job: answer.detail.job };
    }
    if (answer.type === "measured-change")
      this.state = { ...this.state, measured: answer.detail.measured };
    if ("detail" in answer)
      this.dispatchEvent(
        new CustomEvent(answer.type, { detail: answer.detail }),
      );
    if (!("id" in answer) || answer.id === null) return;
    const waiting = this.waiting.get(answer.id);
    this.waiting.delete(answer.id);
    if (answer.type === "error")
      waiting?.fail(new FrameError(answer.message, answer.findings));
    else
      waiting?.done(
        answer.type === "state"
          ? answer.state
          : answer.type === "picture"
            ? answer.picture
            : undefined,
      );
  }
}

/** The origin of an address; empty where it has none. */
function originOf(address: unknown): string {
  try {
    const { origin } = new URL(String(address));
    return origin === "null" ? "" : origin;
  } catch {
    return "";
  }
}

/** Says hello to a frame until it answers; gives the port that it answers through, and its version. */
function hello(
  iframe: HTMLIFrameElement,
  own: string,
  { saves = false, patience = PATIENCE }: ConnectOptions,
  signal?: AbortSignal,
): Promise<{ port: MessagePort; version: string }> {
  return new Promise((done, fail) => {
    let port: MessagePort | null = null;
    const end = () => {
      clearInterval(asking);
      clearTimeout(ending);
      removeEventListener("message", refused);
    };
    const refused = ({ source, data, origin: from }: MessageEvent) => {
      if (
        source !== iframe.contentWindow ||
        from !== own ||
        data?.type !== "refused"
      )
        return;
      end();
      port?.close();
      fail(new FrameError(`The frame refuses: ${data.reason}`));
    };
    // A frame that is not loaded yet gets no message: the hello is repeated until it answers.
    const ask = () => {
      const channel = new MessageChannel();
      port?.close();
      port = channel.port1;
      channel.port1.onmessage = ({ data }: MessageEvent<Answer>) => {
        if (data.type !== "welcome" && data.type !== "error") return;
        end();
        if (data.type === "error") {
          channel.port1.close();
          fail(new FrameError(data.message, data.findings));
          return;
        }
        done({ port: channel.port1, version: data.version });
      };
      const hello: Hello = { touchpath: PROTOCOL, type: "hello", saves };
      iframe.contentWindow?.postMessage(hello, own, [channel.port2]);
    };
    signal?.addEventListener("abort", () => {
      end();
      port?.close();
      fail(new FrameError("The frame was loaded anew"));
    });
    addEventListener("message", refused);
    const asking = setInterval(ask, 500);
    const ending = setTimeout(() => {
      end();
      // A frame that finishes loading later must not keep this connection.
      port?.postMessage({ type: "end" } satisfies Request);
      port?.close();
      fail(
        new FrameError(
          "The frame does not answer: is it embed.html, and is this page's origin on its list?",
        ),
      );
    }, patience);
    ask();
  });
}

/**
 * Connects to a frame that shows `embed.html`, loaded or about to be. Fails where the frame refuses this page, cannot be loaded, or does not answer. Where the frame
 * is loaded anew later, the connection holds: it is given what was set, with the job as it stood, and `load` says so.
 */
export async function connect(
  iframe: HTMLIFrameElement,
  options: ConnectOptions,
): Promise<Frame> {
  // What `querySelector` did not find.
  if (!iframe || !("contentWindow" in iframe))
    throw new FrameError("connect takes the iframe that shows embed.html");
  const { origin, patience } = options;
  // `*` and `/` mean something else to the browser: any origin, and this page's own.
  const own = originOf(origin);
  if (!own)
    throw new FrameError(
      `${origin} is no origin: it must be that of the frame, such as https://touchpath.example`,
    );
  let frame: Frame | null = null;
  // Of several loads, as over a page that logs in, the last one is spoken to.
  let last = new AbortController();
  const again = () => {
    last.abort();
    last = new AbortController();
    void frame?.loaded(hello(iframe, own, options, last.signal));
  };
  const { port, version } = await hello(iframe, own, options);
  frame = new Frame(port, version, patience, () =>
    iframe.removeEventListener("load", again),
  );
  iframe.addEventListener("load", again);
  return frame;
}
