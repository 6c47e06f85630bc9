// The robots that the program was sent to, one after the other, as in a class.

import { $, button, element } from "./dom.js";

const signs = { __proto__: null, busy: "…", done: "✓", failed: "✗" };

/** The list below the buttons. `on_again(way, device)` sends to one again. */
export function robot_list(on_again) {
  const rows = [];
  /** The row of a robot. A port has no name and gets a number. */
  function row_of(way, device) {
    let row = rows.find(one => one.device === device || (device.id && one.device.id === device.id));
    if (row) {
      row.device = device; // it may have been selected again
      return row;
    }
    const sign = element("span", { class: "sign", "aria-hidden": "true" }), words = element("span", { class: "words" });
    const again = button("Again", () => on_again(way, row.device));
    const item = element("li", {}, sign, element("b", { translate: device.name ? "no" : undefined }, device.name || `Ball ${rows.length + 1}`), words, again);
    rows.push(row = { device, show(state, said) {
      item.dataset.state = state;
      item.className = state === "done" ? "passed" : "";
      sign.textContent = signs[state];
      words.textContent = said;
      again.hidden = state === "busy";
    } });
    $("robots").prepend(item); // keeps the latest one visible
    $("robots").hidden = false;
    return row;
  }
  return { row_of };
}
