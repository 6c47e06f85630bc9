// Watches the page's engines: reports one that does not answer, and offers a retry.

import { $, show_trouble } from "./dom.js";

/**
 * `language` checks while somebody types, `machine` runs; calls `on_machine_gone(words)` with the reason when the
 * second has ended. Returns `checks()`: true if the first runs, as far as is known.
 */
export function watch_engines({ language, machine, on_machine_gone }) {
  const broken = new Set();
  for (const client of [language, machine]) {
    let lives = 3; // restarts left for one that has run and ended
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
