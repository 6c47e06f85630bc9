// The first program of a new visitor: three steps, each ticked when done.

import { $, element, button } from "./dom.js";

export const welcome = `' The ball drives a shape. How many corners should it have?
const corners = 4

for side = 1 to corners
  direction = (side - 1) * 360 / corners
  LEDC side % 3 + 1
  goroll direction, 0, 1 ' turn
  delay 300ms
  goroll direction, 100, 1 ' drive
  delay 1s
  goroll direction, 0, 0 ' brake
  delay 400ms
next side

print corners, "corners"
`;

/** The number to change in the second step. */
const to_change = /^const corners = (\d+)/m;

/** `point_at(pattern)` marks what to change. */
export function first_steps({ on_next, point_at }) {
  let at = -1; // index of the next step; -1 for none
  const words = [["Press ", element("b", {}, "Run"), ": the ball drives a square."],
    ["Change the ", element("code", {}, "4"), " after ", element("code", {}, "corners"), " to a ", element("code", {}, "3"), "."],
    ["Run it again. What path does it drive now?"]];
  function draw() {
    $("task").hidden = false;
    $("task").classList.add("first");
    $("task-job").hidden = true;
    $("task-title").textContent = at < 3 ? "Your first program" : "You can program a robot!";
    const list = element("ol", { class: "steps" }, ...words.map((line, i) => element("li", { class: i < at ? "done" : i === at ? "now" : "", "aria-current": i === at ? "step" : undefined }, ...line)));
    point_at(at === 1 ? to_change : null);
    $("views").firstElementChild.classList.toggle("pulse", at === 1); // in case the program is out of sight
    $("task-text").replaceChildren(list, ...at < 3 ? [] : [element("p", {}, button("On to the first lesson", on_next, { class: "strong", id: "first-lesson" }))]);
  }
  function done(step) {
    if (at !== step) return;
    ++at;
    draw();
  }
  return {
    /** Starts when the welcome program is open. */
    show({ document }) {
      at = document === "welcome" ? 0 : -1;
      $("views").firstElementChild.classList.remove("pulse");
      $("task").classList.toggle("first", at >= 0);
    },
    /** Redraws the steps in place; returns true if they are the current task. */
    draw_again() {
      if (at >= 0) draw();
      return at >= 0;
    },
    ran() { done(at === 2 ? 2 : 0); },
    changed() { done(1); },
  };
}
