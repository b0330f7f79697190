import { Part } from "./part.js";

/** How much there is behind a door. */
class AmountPart extends Part {
  protected override follows = ["change"];
  declare of: string;

  static override properties = { of: { attribute: false } };

  override render(): string {
    const { store } = this;
    const { program, table, safety } = store.plan;
    if (store.stale) return "";
    switch (this.of) {
      case "program":
        return this.t(
          "{count} lines",
          program.text.trimEnd().split("\n").length,
        );
      case "table":
        return this.t("{count} rows", table.length);
      case "measured":
        return store.measured.trim() === "" ? this.t("none yet") : "";
      case "checks": {
        const held = safety.filter(({ holds }) => holds === true).length;
        return this.t("{count} hold", held);
      }
      default:
        return "";
    }
  }
}

customElements.define("tp-amount", AmountPart);
