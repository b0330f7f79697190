// A portal's side of a frame with embed.html: a few functions instead of messages.
import { type Answer, type FrameState, type FrameView, type Hello, PROTOCOL, type Request } from "./protocol.js";
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
  "program-save": CustomEvent<{ name: string; text: string; post: string; extension: string }>;
  finding: CustomEvent<{ findings: Finding[]; refused: boolean }>;
}

interface Waiting {
  done(answer?: FrameView | string | null): void;
  fail(why: FrameError): void;
}

/** A frame that has answered. Its events are those of `<touch-path>`: `job-change`, `plan-change`, `selection-change`, `measured-change`, `program-save`, `finding`. */
export class Frame extends EventTarget {
  private readonly waiting = new Map<number, Waiting>();
  private last = 0;
  private ended = false;

  constructor(
    private readonly port: MessagePort,
    /** The version of Touchpath in the frame. */
    readonly version: string,
    /** How long to wait for an answer, milliseconds. */
    private readonly patience = PATIENCE,
  ) {
    super();
    port.onmessage = ({ data }: MessageEvent<Answer>) => this.receive(data);
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
    await this.ask((id) => ({ type: "do", id, deed: { do: "highlight", move } }));
  }

  /** The job as it stands, its plan, its findings, what was measured. */
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
    this.port.close();
    for (const { fail } of this.waiting.values()) fail(new FrameError(why));
    this.waiting.clear();
  }

  private ask(request: (id: number) => Request): Promise<FrameView | string | null | undefined> {
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
    if (answer.type === "ended") this.end("Another connection has replaced this one");
    if ("detail" in answer) this.dispatchEvent(new CustomEvent(answer.type, { detail: answer.detail }));
    if (!("id" in answer) || answer.id === null) return;
    const waiting = this.waiting.get(answer.id);
    this.waiting.delete(answer.id);
    if (answer.type === "error") waiting?.fail(new FrameError(answer.message, answer.findings));
    else waiting?.done(answer.type === "state" ? answer.state : answer.type === "picture" ? answer.picture : undefined);
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

/** Connects to a frame that shows `embed.html`, loaded or about to be. Fails where the frame refuses this page, cannot be loaded, or does not answer. */
export function connect(
  iframe: HTMLIFrameElement,
  { origin, saves = false, patience = PATIENCE }: ConnectOptions,
): Promise<Frame> {
  return new Promise((done, fail) => {
    // What `querySelector` did not find.
    if (!iframe || !("contentWindow" in iframe)) throw new FrameError("connect takes the iframe that shows embed.html");
    // `*` and `/` mean something else to the browser: any origin, and this page's own.
    const own = originOf(origin);
    if (!own)
      throw new FrameError(`${origin} is no origin: it must be that of the frame, such as https://touchpath.example`);
    let port: MessagePort | null = null;
    const end = () => {
      clearInterval(asking);
      clearTimeout(ending);
      removeEventListener("message", refused);
    };
    const refused = ({ source, data, origin: from }: MessageEvent) => {
      if (source !== iframe.contentWindow || from !== own || data?.type !== "refused") return;
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
        done(new Frame(channel.port1, data.version, patience));
      };
      const hello: Hello = { touchpath: PROTOCOL, type: "hello", saves };
      iframe.contentWindow?.postMessage(hello, own, [channel.port2]);
    };
    addEventListener("message", refused);
    const asking = setInterval(ask, 500);
    const ending = setTimeout(() => {
      end();
      // A frame that finishes loading later must not keep this connection.
      port?.postMessage({ type: "end" } satisfies Request);
      port?.close();
      fail(new FrameError("The frame does not answer: is it embed.html, and is this page's origin on its list?"));
    }, patience);
    ask();
  });
}
