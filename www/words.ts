// The languages of the page: their words are loaded when they are wanted, and the sources contain the English texts.
import type { Catalog, FieldEntry, Words } from "./core/types.js";

/** The languages that have words, each by its own name. */
export const LANGUAGES = {
  en: "English",
  "zh-Hans": "简体中文",
  "zh-Hant": "繁體中文",
  de: "Deutsch",
  ru: "Русский",
} as const;
export type Lang = keyof typeof LANGUAGES;

const LOAD: Record<Exclude<Lang, "en">, () => Promise<{ default: Words }>> = {
  "zh-Hans": () => import("./words/zh-Hans.json"),
  "zh-Hant": () => import("./words/zh-Hant.json"),
  de: () => import("./words/de.json"),
  ru: () => import("./words/ru.json"),
};

/** Marks English words in data, so that the lists of words must have them. */
export const w = (english: string): string => english;

/** Chinese that is written in traditional characters, by its script or by where it is spoken. */
const TRADITIONAL = /^zh-(?:.*-)?(hant|tw|hk|mo)\b/;

/** The first language of some BCP 47 tags that has words: `de-AT` is German, `zh-CN` and `zh` the simplified Chinese. Null where none has. */
export function languageOf(tags: readonly string[]): Lang | null {
  for (const tag of tags.map((tag) => tag.toLowerCase())) {
    const primary = tag.split("-")[0];
    if (primary === "zh") return TRADITIONAL.test(tag) ? "zh-Hant" : "zh-Hans";
    const lang = (Object.keys(LANGUAGES) as Lang[]).find(
      (lang) => lang.split("-")[0] === primary,
    );
    if (lang) return lang;
  }
  return null;
}

/** The words of a language. */
export async function wordsOf(lang: Lang): Promise<Words> {
  return lang === "en" ? {} : (await LOAD[lang]()).default;
}

/** The catalog in a language: what is read. Groups keep their English names, which are keys. */
export function worded(catalog: Catalog, words: Words): Catalog {
  const t = (text: string) =>
    Object.hasOwn(words, text) ? (words[text] as string) : text;
  const field = (f: FieldEntry): FieldEntry => ({
    ...f,
    label: t(f.label),
    help: t(f.help),
    null: f.null && t(f.null),
    choices: f.choices.map((c) => ({ ...c, label: t(c.label) })),
  });
  const section = <S extends { fields: FieldEntry[] }>(s: S): S => ({
    ...s,
    fields: s.fields.map(field),
  });
  return {
    ...catalog,
    sections: catalog.sections.map(section),
    cycles: catalog.cycles.map((c) => ({
      ...section(c),
      title: t(c.title),
      says: t(c.says),
      also: t(c.also),
      source: c.source.replace(/(type|cycle)(?= \d+$)/, t),
      steps: c.steps.map(t),
      sections: c.sections.map(section),
    })),
    posts: catalog.posts.map((p) => ({
      ...p,
      cycles: p.cycles.map((c) => ({ ...c, reason: c.reason && t(c.reason) })),
    })),
    rules: catalog.rules.map((r) => ({ ...r, says: t(r.says), why: t(r.why) })),
    codeGroups: catalog.codeGroups.map((g) => ({ ...g, title: t(g.title) })),
  };
}

/** What the names of sources say, beside the name of who documents a cycle. */
export const SOURCE_WORDS = [w("type"), w("cycle")];
