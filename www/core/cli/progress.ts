// How far it is, on a terminal; in a pipe and in a file nothing of it is seen.

const WIDTH = 30;
/** Milliseconds between two drawings. */
const PAUSE = 100;

export class Progress {
  private expected = 0;
  private read = 0;
  private done = 0;
  private drawn = 0;
  private readonly start = performance.now();
  private readonly shows: boolean;

  constructor(
    private readonly terminal: NodeJS.WriteStream,
    many: boolean,
  ) {
    this.shows = many && terminal.isTTY === true;
  }

  /** So many bytes more will be read. */
  expect(bytes: number): void {
    this.expected += bytes;
  }

  /** The same stream, with its bytes counted. */
  async *through(
    stream: AsyncIterable<Buffer | string>,
  ): AsyncGenerator<Buffer | string> {
    for await (const chunk of stream) {
      this.read += chunk.length;
      yield chunk;
    }
  }

  /** One job more is done. */
  count(): void {
    this.done++;
    const now = performance.now();
    if (!this.shows || now - this.drawn < PAUSE) return;
    this.drawn = now;
    const rate = Math.round(this.done / ((now - this.start) / 1000));
    const share =
      this.expected > 0 ? Math.min(this.read / this.expected, 1) : null;
    const bar =
      share === null
        ? ""
        : `[${"#".repeat(Math.round(share * WIDTH)).padEnd(WIDTH)}] `;
    this.terminal.write(`\r${bar}${this.done} jobs, ${rate} a second\u001b[K`);
  }

  /** Takes the bar away; it is drawn again with the next job. */
  clear(): void {
    if (this.shows && this.drawn > 0) this.terminal.write("\r\u001b[K");
  }

  end(): void {
    this.clear();
  }
}
