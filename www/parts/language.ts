import type { LitElement, ReactiveController } from "lit";
import { keepLanguage, keptLanguage } from "../persistence.js";
import type { Store } from "../store.js";
import { type Lang, languageOf, wordsOf } from "../words.js";

/** Surroundings of the frame. */
interface Around {
  host: HTMLElement;
  /** Whether a choice is stored in this browser. */
  local: boolean;
}

/** Chooses the language: that of the host page, the user's choice, or the browser's, if it has words. */
export class Language implements ReactiveController {
  /** Language that the user chose. */
  private chosen = keptLanguage();
  /** Without a language of its own, the element follows that of the host page. */
  private readonly observer = new MutationObserver(() => this.follow());

  /** `failed`: called if the words of a language cannot be loaded. */
  constructor(
    private readonly frame: LitElement,
    private readonly store: Store,
    private readonly around: Around,
    private readonly failed: () => void,
  ) {
    frame.addController(this);
  }

  hostConnected(): void {
    // The new surroundings may have another language.
    if (this.frame.hasUpdated) this.follow();
    for (
      let root: Node | null = this.around.host.getRootNode();
      root;
      root = root instanceof ShadowRoot ? root.host.getRootNode() : null
    )
      this.observer.observe(root, { subtree: true, attributeFilter: ["lang"] });
  }

  hostDisconnected(): void {
    this.observer.disconnect();
  }

  /** The language to show. */
  private get wanted(): Lang {
    const { host, local } = this.around;
    const own = languageOf([host.lang].filter(Boolean));
    if (own) return own;
    if (local)
      return languageOf([this.chosen ?? "", ...navigator.languages]) ?? "en";
    let around: Element | null = host;
    while (around && !(around as HTMLElement).lang) {
      const root: Node = around.getRootNode();
      around =
        around.parentElement ?? (root instanceof ShadowRoot ? root.host : null);
    }
    return languageOf([(around as HTMLElement | null)?.lang ?? ""]) ?? "en";
  }

  /** Switches to the language to show after loading its words. If they cannot be loaded, the previous language stays. */
  async follow(): Promise<void> {
    const { frame, store, wanted } = this;
    frame.lang = store.lang;
    if (wanted === store.lang) return;
    try {
      const words = await wordsOf(wanted);
      // Another language was requested meanwhile.
      if (wanted !== this.wanted) return this.follow();
      store.translate(wanted, words);
      frame.lang = wanted;
      // Stores the words for use without a network.
      this.around.host.dispatchEvent(
        new CustomEvent("language", { detail: wanted }),
      );
      frame.requestUpdate();
    } catch {
      if (wanted !== this.wanted) return this.follow();
      this.chosen = store.lang;
      this.failed();
    }
  }

  /** Applies the user's choice of language. */
  async choose(lang: string): Promise<void> {
    const { host, local } = this.around;
    this.chosen = lang;
    if (host.lang || !local) host.lang = lang;
    await this.follow();
    if (local && this.store.lang === lang) keepLanguage(lang);
  }
}
