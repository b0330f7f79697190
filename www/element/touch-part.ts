// Panels of a job elsewhere on the page: <touch-form>, <touch-picture>, <touch-program>.
import type { PanelName } from "../core/types.js";
import type { App } from "../parts/app.js";
import { isKnown } from "./attributes.js";
import { Attempt, Base, failure, HERE, takeUp } from "./loading.js";
import type { TouchPath } from "./touch-path.js";

/**
 * Panels of the job of a `<touch-path>` elsewhere on the page. All panels share one state: an edit, highlight or selection in one shows in the others. The
 * element fills its box.
 */
export class TouchPart extends Base {
  static readonly observedAttributes = ["for", "panels"];
  /** Panels shown without the attribute `panels`. */
  protected readonly own: PanelName = "form";
  /** The element whose job is shown and its app; kept while this element is out of the document. */
  private held: { session: TouchPath; app: App } | null = null;
  /** The element whose job is or will be shown. */
  private owner: TouchPath | null = null;
  private asked: unknown = null;
  private root: Node | null = null;
  private attempt = new Attempt();

  constructor() {
    super();
    this.attachShadow({ mode: "open" }).append(document.createElement("slot"));
  }

  /**
   * Settles when the panels are shown: this element is in a document, and the element of its job is found and loaded. A change of `for` or `session` creates a
   * new promise.
   */
  get ready(): Promise<void> {
    return this.attempt.ready;
  }

  /** The element whose job is shown: the one with the id in `for`, unless `session` was set. */
  get session(): TouchPath | null {
    const session = this.asked ?? this.found();
    // An element whose class is not defined yet shows nothing.
    return session instanceof HTMLElement && "attachPanel" in session
      ? (session as TouchPath)
      : null;
  }

  set session(session: TouchPath | null | undefined) {
    this.asked = session ?? null;
    this.attach();
  }

  /** The panels shown, as words separated by blanks. */
  get panels(): string {
    const panels = this.getAttribute("panels");
    return panels && isKnown("panels", panels) ? panels : this.own;
  }

  set panels(value: string | null | undefined) {
    if (value === null || value === undefined) this.removeAttribute("panels");
    else this.setAttribute("panels", value);
  }

  connectedCallback(): void {
    takeUp(this, ["session", "panels"]);
    // The other element may enter the page or be defined after this one.
    this.root = this.getRootNode();
    this.root.addEventListener(HERE, this.meet);
    this.attach();
  }

  disconnectedCallback(): void {
    this.root?.removeEventListener(HERE, this.meet);
    this.detach();
  }

  attributeChangedCallback(
    name: string,
    before: string | null,
    value: string | null,
  ): void {
    if (value === before) return;
    if (name === "for") this.attach();
    else {
      const refused =
        value === null ? [] : (this.owner?.refusals({ panels: value }) ?? []);
      if (refused.length > 0)
        this.owner?.tell("finding", { findings: refused, refused: true });
      this.owner?.applyOptions();
    }
  }

  private found(): Element | null {
    const id = this.getAttribute("for");
    const root = this.getRootNode();
    return id && (root instanceof Document || root instanceof ShadowRoot)
      ? root.getElementById(id)
      : null;
  }

  /** An element has entered the page. */
  private readonly meet = (): void => {
    if (this.session) this.attach();
  };

  private async attach(): Promise<void> {
    const session = this.isConnected ? this.session : null;
    if (session === this.owner) return;
    this.detach();
    this.owner = session;
    if (!session) return;
    const { attempt } = this;
    const root = this.shadowRoot as ShadowRoot;
    try {
      const { app, styles } = await session.attachPanel(
        this,
        this.held?.session === session ? this.held.app : undefined,
      );
      if (this.owner !== session) return session.detachPanel(this);
      this.held = { session, app };
      root.adoptedStyleSheets = styles;
      root.replaceChildren(app);
      await app.updateComplete;
      attempt.done();
    } catch (why) {
      if (this.owner !== session) return;
      // Tries again when the element returns.
      session.detachPanel(this);
      this.owner = null;
      root.replaceChildren(failure(why));
      attempt.fail(why);
    }
  }

  private detach(): void {
    if (this.attempt.over || this.owner) this.attempt = new Attempt();
    this.owner?.detachPanel(this);
    this.owner = null;
    this.shadowRoot?.replaceChildren(document.createElement("slot"));
  }
}

/**
 * The form of the job of a `<touch-path>` elsewhere on the page.
 *
 * @tag touch-form
 * @attr {string} for - Id of that element in the same document or shadow root. For an element elsewhere, set the property `session`.
 * @attr {string} panels - Panels to show instead of the form, as words of `panels` of `<touch-path>`; several appear side by side or as tabs.
 */
export class TouchForm extends TouchPart {}

/**
 * The picture of the job of a `<touch-path>` elsewhere on the page.
 *
 * @tag touch-picture
 * @attr {string} for - Id of that element in the same document or shadow root. For an element elsewhere, set the property `session`.
 * @attr {string} panels - Panels to show instead of the picture, as words of `panels` of `<touch-path>`; several appear side by side or as tabs.
 */
export class TouchPicture extends TouchPart {
  protected override readonly own = "stage";
}

/**
 * The program of the job of a `<touch-path>` elsewhere on the page.
 *
 * @tag touch-program
 * @attr {string} for - Id of that element in the same document or shadow root. For an element elsewhere, set the property `session`.
 * @attr {string} panels - Panels to show instead of the program, as words of `panels` of `<touch-path>`; several appear side by side or as tabs.
 */
export class TouchProgram extends TouchPart {
  protected override readonly own = "program";
}
