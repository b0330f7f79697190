// Panels of a job elsewhere on the page: <touch-form>, <touch-picture>, <touch-program>.
import type { PanelName } from "../core/types.js";
import type { App } from "../parts/app.js";
import { isKnown } from "./attributes.js";
import { Attempt, Base, failure, HERE, takeUp } from "./loading.js";
import type { TouchPath } from "./touch-path.js";

/**
 * Panels of the job of a `<touch-path>` elsewhere on the page. All of them show the same: what is typed, pointed at or chosen in one is seen in the others. It fills its box.
 */
export class TouchPart extends Base {
  static readonly observedAttributes = ["for", "panels"];
  /** What it shows where `panels` says nothing else. */
  protected readonly own: PanelName = "form";
  /** What is shown, and of whose job: kept while this is out of the document. */
  private held: { session: TouchPath; app: App } | null = null;
  /** Whose job is shown, or is about to be. */
  private owner: TouchPath | null = null;
  private asked: unknown = null;
  private root: Node | null = null;
  private attempt = new Attempt();

  constructor() {
    super();
    this.attachShadow({ mode: "open" }).append(document.createElement("slot"));
  }

  /** Settles when the panels are shown: this element is in a document, and the one whose job it shows is found and loaded. After `for` or `session` has changed it is another promise. */
  get ready(): Promise<void> {
    return this.attempt.ready;
  }

  /** The element whose job it shows: that whose id is in `for`, unless another one is set. */
  get session(): TouchPath | null {
    const session = this.asked ?? this.found();
    // One whose class is not known yet shows nothing so far.
    return session instanceof HTMLElement && "attachPanel" in session
      ? (session as TouchPath)
      : null;
  }

  set session(session: TouchPath | null | undefined) {
    this.asked = session ?? null;
    this.attach();
  }

  /** Which panels are shown, as words with spaces between. */
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
    // Its element may be put into the page, or be known, after this one.
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

  /** An element has come into the page. */
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
      // It is tried again when the element comes back.
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
 * @attr {string} for - The id of that element, in the same document or shadow root. From anywhere else the property `session` is set to it.
 * @attr {string} panels - Panels to show instead of its own one, as words of `panels` of `<touch-path>`; several are shown side by side or as tabs.
 */
export class TouchForm extends TouchPart {}

/**
 * The picture of the job of a `<touch-path>` elsewhere on the page.
 *
 * @tag touch-picture
 * @attr {string} for - The id of that element, in the same document or shadow root. From anywhere else the property `session` is set to it.
 * @attr {string} panels - Panels to show instead of its own one, as words of `panels` of `<touch-path>`; several are shown side by side or as tabs.
 */
export class TouchPicture extends TouchPart {
  protected override readonly own = "stage";
}

/**
 * The program of the job of a `<touch-path>` elsewhere on the page.
 *
 * @tag touch-program
 * @attr {string} for - The id of that element, in the same document or shadow root. From anywhere else the property `session` is set to it.
 * @attr {string} panels - Panels to show instead of its own one, as words of `panels` of `<touch-path>`; several are shown side by side or as tabs.
 */
export class TouchProgram extends TouchPart {
  protected override readonly own = "program";
}
