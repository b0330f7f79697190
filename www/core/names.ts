// File names that every system can store.

/** Names that Windows keeps for its devices. */
const DEVICES = /^(con|prn|aux|nul|com\d|lpt\d)$/i;
const LONGEST = 60;

/** A job's name as the stem of a file name: ASCII letters, digits, `-` and `_`. One that has none is PROBE. */
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

/** The first comment of a dry run. */
const DRY = /^[%\s]*(?:O\d+[^\n]*\n)?\s*[(;]\s*DRY RUN/i;

/** The stem of a program's file: the program's own name where it says one (HEIDENHAIN wants them the same), or else the job's; that of a dry run ends in `-DRY`. */
export function programStem(name: unknown, text: string): string {
  if (DRY.test(text)) return `${stem(name)}-DRY`;
  const own = /^0 BEGIN PGM ([A-Za-z0-9_-]+) /.exec(text)?.[1];
  return own && !DEVICES.test(own) ? own : stem(name);
}
