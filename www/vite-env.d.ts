declare module "*.css?inline" {
  const text: string;
  export default text;
}

declare module "*?worker&url" {
  const address: string;
  export default address;
}

declare module "*.wasm?url" {
  const address: string;
  export default address;
}

declare module "virtual:first-answers" {
  const answers: import("./first-answers.js").Answers;
  export default answers;
}

/** Version of the package. */
declare const VERSION: string;
