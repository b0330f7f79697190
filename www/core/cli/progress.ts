// Progress bar on a terminal; nothing in a pipe or a file.

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

  /** Adds bytes that will be read. */
  expect(bytes: number): void {
    this.expected += bytes;
  }

  /** The stream, with its bytes counted. */
  async *through(
    stream: AsyncIterable<Buffer | string>,
  ): AsyncGenerator<Buffer | string> {
    for await (const chunk of stream) {
      this.read += chunk.length;
      yield chunk;
    }
  }

  /** Counts a finished job. */
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

  /** Removes the bar until the next job. */
  clear(): void {
    if (this.shows && this.drawn > 0) this.terminal.write("\r\u001b[K");
  }

  end(): void {
    this.clear();
  }
}
