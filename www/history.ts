// The steps that can be taken back, and made again.

/** So many steps can be taken back. */
const MOST_STEPS = 200;

export class History<Moment> {
  private past: Moment[] = [];
  private future: Moment[] = [];
  /** What the last change was of: further changes of the same belong to the same step. */
  private changing: string | null = null;

  /** Before a change: its path decides whether it is a step of its own. */
  mark(changing: string | null, now: () => Moment): void {
    if (changing !== null && changing === this.changing) return;
    this.past.push(now());
    if (this.past.length > MOST_STEPS) this.past.shift();
    this.future = [];
    this.changing = changing;
  }

  /** Whether what is changed next is a step of its own. */
  get settled(): boolean {
    return this.changing === null;
  }

  /** What is changed next is a step of its own. */
  settle(): void {
    this.changing = null;
  }

  /** Forgets all steps. */
  clear(): void {
    this.past = [];
    this.future = [];
    this.settle();
  }

  get canUndo(): boolean {
    return this.past.length > 0;
  }

  get canRedo(): boolean {
    return this.future.length > 0;
  }

  /** The moment before the last step; none if there is no step. */
  undo(now: () => Moment): Moment | undefined {
    return this.turn(this.past, this.future, now);
  }

  /** The moment after the step that was taken back last. */
  redo(now: () => Moment): Moment | undefined {
    return this.turn(this.future, this.past, now);
  }

  private turn(
    from: Moment[],
    to: Moment[],
    now: () => Moment,
  ): Moment | undefined {
    const moment = from.pop();
    if (moment === undefined) return undefined;
    to.push(now());
    this.settle();
    return moment;
  }
}
