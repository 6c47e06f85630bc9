// The page's language: the chosen one, or else the first of the browser's that is available.

import { $, element, say } from "./dom.js";

const languages = { en: "English", de: "Deutsch", es: "Español", fr: "Français" };
const key = "orb-language";
const remembered = () => { try { return localStorage.getItem(key); } catch { return null; } };
const wanted = () => [remembered(), ...navigator.languages.map(tag => tag.split("-")[0])].find(code => Object.hasOwn(languages, code ?? "")) ?? "en";

/** The translations of a language; none for English. */
async function texts_of(code) {
  if (code === "en") return {};
  const answer = await fetch(`languages/${code}.json`);
  if (!answer.ok) throw new Error(`${answer.url}: ${answer.status}`);
  return answer.json();
}

let asked = 0;
/**
 * Translates the page, unless another language is requested meanwhile; keeps the current one if the texts cannot be
 * loaded.
 */
async function show_in(code) {
  const question = ++asked;
  try {
    const [{ translate }, texts] = await Promise.all([import("./translate.js"), texts_of(code)]);
    if (question === asked) translate(code, texts);
  } catch {
    if (question !== asked) return;
    say(`${languages[code]} could not be loaded. Check your network connection, then choose it again under Menu.`, "bad");
    $("language").value = document.documentElement.lang;
  }
}

/** Settles when the page is translated. `on_change()`: somebody has chosen another language. */
export async function speak({ on_change }) {
  const code = wanted();
  $("language").append(...Object.entries(languages).map(([one, name]) => element("option", { value: one, lang: one, selected: one === code }, name)));
  $("language").addEventListener("change", async () => {
    const chosen = $("language").value;
    try { localStorage.setItem(key, chosen); } catch { /* for this visit only */ }
    await show_in(chosen);
    on_change();
  });
  if (code !== "en") await show_in(code);
}
