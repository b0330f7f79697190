// Undo and redo.

/** Maximum number of undo steps. */
const MOST_STEPS = 200;

export class History<Moment> {
  private past: Moment[] = [];
  private future: Moment[] = [];
  /** Subject of the last change. Further changes of the same subject join its step. */
  private changing: string | null = null;

  /** Call before a change. A path other than the last one begins a new step. */
  mark(changing: string | null, now: () => Moment): void {
    if (changing !== null && changing === this.changing) return;
    this.past.push(now());
    if (this.past.length > MOST_STEPS) this.past.shift();
    this.future = [];
    this.changing = changing;
  }

  /** Ends the current step. */
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

  /** State before the last step; `undefined` without one. */
  undo(now: () => Moment): Moment | undefined {
    return this.turn(this.past, this.future, now);
  }

  /** State after the step that was undone last. */
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
