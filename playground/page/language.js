// Which language the page is in: the one that somebody chose, else the first of the browser's that there is.

import { $, element, say } from "./dom.js";

const languages = { en: "English", de: "Deutsch", es: "Español", fr: "Français" };
const key = "orb-language";
const remembered = () => { try { return localStorage.getItem(key); } catch { return null; } };
const wanted = () => [remembered(), ...navigator.languages.map(tag => tag.split("-")[0])].find(code => Object.hasOwn(languages, code ?? "")) ?? "en";

/** Settles when the page is in that language. */
export async function speak() {
  const code = wanted();
  $("language").append(...Object.entries(languages).map(([one, name]) => element("option", { value: one, lang: one, selected: one === code }, name)));
  $("language").addEventListener("change", () => {
    try { localStorage.setItem(key, $("language").value); } catch { /* then it is asked for each time */ }
    location.reload();
  });
  if (code === "en") return;
  try {
    await (await import("./translate.js")).translate(code, `languages/${code}.json`);
  } catch {
    say(`${languages[code]} could not be loaded, so the page is in English. Check your network connection and reload the page.`, "bad");
  }
}
