// File names that every system can store.

/** Names that Windows reserves for devices. */
const DEVICES = /^(con|prn|aux|nul|com\d|lpt\d)$/i;
const LONGEST = 60;

/** The stem of a file name from a job's name: ASCII letters, digits, `-` and `_`. PROBE if nothing is left. */
export function stem(name: unknown): string {
  const plain = String(name ?? "")
    .replaceAll("ß", "ss")
    .replaceAll(/[Øø]/g, (c) => (c === "Ø" ? "O" : "o"))
    .normalize("NFKD")
    .replaceAll(/\p{M}/gu, "")
    .replaceAll(/[^A-Za-z0-9_-]+/g, "_")
    .replace(/^[-_]+/, "")
    .slice(0, LONGEST)
    .replace(/[-_]+$/, "");
  if (plain === "") return "PROBE";
  return DEVICES.test(plain) ? `${plain}_` : plain;
}

/** First comment of a dry run. */
const DRY = /^[%\s]*(?:O\d+[^\n]*\n)?\s*[(;]\s*DRY RUN/i;

/** Stem of a program's file name: the program's own name if it states one (HEIDENHAIN requires that they match), else the job's. A dry run ends in `-DRY`. */
export function programStem(name: unknown, text: string): string {
  if (DRY.test(text)) return `${stem(name)}-DRY`;
  const own = /^0 BEGIN PGM ([A-Za-z0-9_-]+) /.exec(text)?.[1];
  return own && !DEVICES.test(own) ? own : stem(name);
}
