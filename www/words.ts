// Languages of the page. Their words are loaded on demand; the sources contain the English texts.
import type { Catalog, FieldEntry, Words } from "./core/types.js";

/** Languages with words, each by its own name. */
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

/** Marks an English text in data, so that the word lists must contain it. */
export const w = (english: string): string => english;

/** Traditional Chinese, by script or region. */
const TRADITIONAL = /^zh-(?:.*-)?(hant|tw|hk|mo)\b/;

/** First available language of a list of BCP 47 tags: `de-AT` is German, `zh-CN` and `zh` are simplified Chinese. Null if no language is available. */
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

/** Loads the words of a language. */
export async function wordsOf(lang: Lang): Promise<Words> {
  return lang === "en" ? {} : (await LOAD[lang]()).default;
}

/** The catalog in a language. Groups keep their English names, which are keys. */
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

/** Words in the names of sources beside the documenting company. */
export const SOURCE_WORDS = [w("type"), w("cycle")];
