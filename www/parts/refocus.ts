import type { LitElement, ReactiveController } from "lit";

/** Events that may remove the focused element: a click, and Escape. */
const EVENTS = ["click", "keydown", "pointerdown"] as const;
/** Delays in milliseconds after which a lost focus is restored: some elements are only removed when the page is drawn or a part is loaded. */
const RESTORE_DELAYS = [40, 360];

/** If the focused button or field is removed, moves the focus to one near it, not to the start of the page. */
export class Refocus implements ReactiveController {
  private timer = 0;

  constructor(private readonly frame: LitElement) {
    frame.addController(this);
  }

  hostConnected(): void {
    // Runs before the handler of a click, which may remove the element.
    for (const name of EVENTS)
      this.frame.addEventListener(name, this.watch, true);
  }

  hostDisconnected(): void {
    for (const name of EVENTS)
      this.frame.removeEventListener(name, this.watch, true);
  }

  private readonly watch = (event: Event): void => {
    // The user's next click or key cancels a pending restore.
    clearTimeout(this.timer);
    const acts =
      event.type === "click" ||
      (event instanceof KeyboardEvent && event.key === "Escape");
    const at = this.root.activeElement;
    if (at && acts)
      this.scheduleRestore(at, at.closest(".group, dialog"), RESTORE_DELAYS);
  };

  private scheduleRestore(
    at: Element,
    group: Element | null,
    [ms, ...later]: number[],
  ): void {
    if (ms === undefined) return;
    this.timer = window.setTimeout(() => {
      this.restore(at, group);
      this.scheduleRestore(at, group, later);
    }, ms);
  }

  /** If `at` is gone and nothing else has the focus, moves it into the group of `at`, or to the frame's first button. */
  private restore(at: Element, group: Element | null): void {
    const there = (place: Element) =>
      place.isConnected &&
      place.checkVisibility() &&
      !place.matches(":disabled");
    const now = this.root.activeElement;
    const outside = ![document.body, this.root.host].includes(
      document.activeElement as HTMLElement,
    );
    if (there(at) || (now && there(now)) || outside || !this.frame.isConnected)
      return;
    const places = [
      ...(group?.querySelectorAll<HTMLElement>("input, select, button") ?? []),
      ...this.frame.querySelectorAll<HTMLElement>(".back button"),
      ...this.frame.querySelectorAll<HTMLElement>("tp-bar [popovertarget]"),
    ];
    places.find(there)?.focus({ preventScroll: true });
  }

  private get root(): ShadowRoot {
    return this.frame.getRootNode() as ShadowRoot;
  }
}
