// The first program of somebody who was never here: three steps, each ticked when it is done.

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

export function first_steps({ on_next }) {
  let at = -1; // the step that is next; none
  const words = [["Press ", element("b", {}, "Run"), ": the ball drives a square."],
    ["Change the ", element("code", {}, "4"), " after ", element("code", {}, "corners"), " to a ", element("code", {}, "3"), "."],
    ["Run it again. What path does it drive now?"]];
  function draw() {
    $("task").hidden = false;
    $("task").classList.add("first");
    $("task-title").textContent = at < 3 ? "Your first program" : "You can program a robot!";
    const list = element("ol", { class: "steps" }, ...words.map((line, i) => element("li", { class: i < at ? "done" : i === at ? "now" : "", "aria-current": i === at ? "step" : undefined }, ...line)));
    $("task-text").replaceChildren(list, ...at < 3 ? [] : [element("p", {}, button("On to the first lesson", on_next, { class: "strong", id: "first-lesson" }))]);
  }
  function done(step) {
    if (at !== step) return;
    ++at;
    draw();
  }
  return {
    /** Begins where the welcome program is open. */
    show({ document }) {
      at = document === "welcome" ? 0 : -1;
      $("task").classList.toggle("first", at >= 0);
    },
    /** Whether the steps are what the task is now; they are drawn where they are. */
    draw_again() {
      if (at >= 0) draw();
      return at >= 0;
    },
    ran() { done(at === 2 ? 2 : 0); },
    changed() { done(1); },
  };
}
