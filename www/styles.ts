// Styles inside the element, one file for each area of the page. Later files override earlier ones.
import features from "./styles/features.css?inline";
import form from "./styles/form.css?inline";
import frame from "./styles/frame.css?inline";
import media from "./styles/media.css?inline";
import narrow from "./styles/narrow.css?inline";
import picture from "./styles/picture.css?inline";
import program from "./styles/program.css?inline";
import results from "./styles/results.css?inline";
import tokens from "./styles/tokens.css?inline";
import tools from "./styles/tools.css?inline";
import wide from "./styles/wide.css?inline";

const css = [
  tokens,
  frame,
  features,
  form,
  picture,
  program,
  results,
  tools,
  wide,
  narrow,
  media,
].join("\n");

/** The styles of everything inside the element. */
export const styles = new CSSStyleSheet();
styles.replaceSync(css);

/** Differences for panels elsewhere on the page: they may be as low as the host page wants. */
export const partStyles = new CSSStyleSheet();
partStyles.replaceSync(":host { min-height: 8rem; }");
