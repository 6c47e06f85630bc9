// The engines of the page: one that does not answer is named, and can be tried again.

import { $, show_trouble } from "./dom.js";

/** `language` checks while somebody types, `machine` runs; `on_machine_gone(words)` is called where the second has ended, with the reason.
 *  Gives `checks()`: whether the first runs, as far as is known. */
export function watch_engines({ language, machine, on_machine_gone }) {
  const broken = new Set();
  for (const client of [language, machine]) {
    let lives = 3; // one that has run, and ends, is begun again
    let has_run = false;
    client.on("broken", ({ message }) => {
      if (client === machine) on_machine_gone(message);
      if (has_run && lives-- > 0) return client.restart();
      broken.add(client);
      show_trouble("engine", `orb's engine is not running: ${message}. Nothing can be checked or run until it is.`);
      if (client === language) $("count").textContent = "not checked";
    });
    client.on("late", () => show_trouble("engine", "orb's engine is still loading. On a slow network this takes a while."));
    client.on("ready", () => {
      has_run = true;
      broken.delete(client);
      if (!broken.size) show_trouble("engine", "");
    });
  }
  $("engine-again").addEventListener("click", () => {
    show_trouble("engine", "");
    for (const client of [language, machine]) client.restart();
  });
  return { checks: () => !broken.has(language) };
}
