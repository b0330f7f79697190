import { StorePart } from "./part.js";

/** Amount of content in a panel, beside the door that opens it. The parameter rows are not counted, because the table is only made when it is shown. */
class AmountPart extends StorePart {
  protected override storeEvents = ["change"];
  declare of: string;

  static override properties = { of: { attribute: false } };

  override render(): string {
    const { store } = this;
    if (store.stale) return "";
    switch (this.of) {
      case "program":
        return this.t(
          "{count} lines",
          store.plan.program.text.trimEnd().split("\n").length,
        );
      case "measured":
        return store.measured.trim() === "" ? this.t("none yet") : "";
      case "checks": {
        const held = store.plan.safety.filter(
          ({ holds }) => holds === true,
        ).length;
        return this.t("{count} hold", held);
      }
      default:
        return "";
    }
  }
}

customElements.define("tp-amount", AmountPart);
