// A portal's access to a frame with embed.html: functions instead of messages.
import type { TouchPathEvents } from "./events.js";
import {
  type Answer,
  type FrameState,
  type FrameView,
  type Hello,
  PROTOCOL,
  type Request,
} from "./protocol.js";
import type { Finding } from "./types.js";

export type {
  ChangeReason,
  EventDetails,
  Selection,
  TouchPathEvents,
} from "./events.js";
export type * from "./protocol.js";
export { PROTOCOL } from "./protocol.js";

/** Thrown when the frame refuses a request; `findings` has the reasons, if there are any. */
export class FrameError extends Error {
  constructor(
    message: string,
    readonly findings: Finding[] = [],
  ) {
    super(message);
    this.name = "FrameError";
  }
}

/** Default timeout for an answer of the frame, milliseconds. */
const PATIENCE = 15_000;

/** Options of a connection. */
export interface ConnectOptions {
  /** Origin that serves the frame: `https://touchpath.example`, never `*`. A frame of another origin gets no message. */
  origin: string;
  /** Whether the portal saves programs itself; otherwise the frame offers them as files. */
  saves?: boolean;
  /** Timeout for an answer of the frame, milliseconds. */
  patience?: number;
}

/** The events of a frame, by name: those of the element, and `load`. */
export interface FrameEvents extends TouchPathEvents {
  /** The frame was reloaded and its state restored; `refused` gives the reason if part of the state could not be set again. */
  load: CustomEvent<{ refused: string | null }>;
}

interface Waiting {
  done(answer?: FrameView | string | null): void;
  fail(why: FrameError): void;
}

/** A connected frame. Its events are those of `<touch-path>`, `change` among them, and `load` after the frame was reloaded. */
export class Frame extends EventTarget {
  private readonly waiting = new Map<number, Waiting>();
  private last = 0;
  private ended = false;
  private port: MessagePort;
  // State to restore in a reloaded frame, with its current job and measured points.
  private state: FrameState = {};
  private of: string;
  // Pending requests wait for this while the frame reloads; the last load counts.
  private there: Promise<void> = Promise.resolve();

  constructor(
    port: MessagePort,
    version: string,
    // Timeout of an answer, milliseconds.
    private readonly patience = PATIENCE,
    // Called when the connection ends.
    private readonly over: () => void = () => undefined,
  ) {
    super();
    this.port = port;
    this.of = version;
    this.listen();
  }

  /** Version of Touchpath in the frame. */
  get version(): string {
    return this.of;
  }

  private listen(): void {
    this.port.onmessage = ({ data }: MessageEvent<Answer>) =>
      this.receive(data);
  }

  /** Called after the frame was reloaded. `hello` gives its new port and version; requests wait for it meanwhile. @internal */
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
      // Or the frame shows another page now: requests from here on fail with this reason.
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

  /** Sets the job, control and display options: all of them, or nothing if any of them cannot be used. Rejects with the reasons then. */
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

  /** The current job, its plan, findings and measured points. */
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

  // Rejects pending requests.
  private fail(why: string): void {
    for (const { fail } of this.waiting.values()) fail(new FrameError(why));
    this.waiting.clear();
  }

  private async ask(
    request: (id: number) => Request,
  ): Promise<FrameView | string | null | undefined> {
    // Another load may follow while this one is pending.
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
      // A frame that was removed or shows another page sends nothing any more.
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
      // The job contains an earlier cycle.
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

/** Origin of an address; empty without one. */
function originOf(address: unknown): string {
  try {
    const { origin } = new URL(String(address));
    return origin === "null" ? "" : origin;
  } catch {
    return "";
  }
}

/** Sends hello to a frame until it answers; returns the port for the connection and its version. */
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
    // A frame that is not loaded yet receives no message: hello is repeated until it answers.
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
 * Connects to a frame that shows or will show `embed.html`. Rejects if the frame refuses this page, cannot be loaded or does not answer. If the frame reloads
 * later, the connection stays: the frame gets its state back, with the job as it was, and fires `load`.
 */
export async function connect(
  iframe: HTMLIFrameElement,
  options: ConnectOptions,
): Promise<Frame> {
  // `querySelector` found no element.
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
  // If several pages load, such as a login page first, the last one is used.
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
