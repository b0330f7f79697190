import type { LitElement, ReactiveController } from "lit";
import { keepLanguage, keptLanguage } from "../persistence.js";
import type { Store } from "../store.js";
import { type Lang, languageOf, wordsOf } from "../words.js";

/** Where the frame is. */
interface Around {
  host: HTMLElement;
  /** Whether a choice is kept in this browser. */
  local: boolean;
}

/** In which language everything is shown: that of the host page, the one that was chosen here, or the browser's; each where it has words. */
export class Language implements ReactiveController {
  /** The language that was chosen here. */
  private chosen = keptLanguage();
  /** Where the element has no language of its own, that of the host page may change. */
  private readonly observer = new MutationObserver(() => this.follow());

  /** `failed`: the words of a language could not be had. */
  constructor(
    private readonly frame: LitElement,
    private readonly store: Store,
    private readonly around: Around,
    private readonly failed: () => void,
  ) {
    frame.addController(this);
  }

  hostConnected(): void {
    // What is around it now may have another language.
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

  /** The language that is wanted. */
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

  /** Shows everything in the language that is wanted; its words are loaded first. Where they cannot be had, the language before stays. */
  async follow(): Promise<void> {
    const { frame, store, wanted } = this;
    frame.lang = store.lang;
    if (wanted === store.lang) return;
    try {
      const words = await wordsOf(wanted);
      // Another one was asked for meanwhile.
      if (wanted !== this.wanted) return this.follow();
      store.translate(wanted, words);
      frame.lang = wanted;
      // The page keeps the words for when there is no network.
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

  /** Takes the language that the user chose in the menu. */
  async choose(lang: string): Promise<void> {
    const { host, local } = this.around;
    this.chosen = lang;
    if (host.lang || !local) host.lang = lang;
    await this.follow();
    if (local && this.store.lang === lang) keepLanguage(lang);
  }
}
