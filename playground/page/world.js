// The world of a run: a course, stimuli, numbers for `input`, a seed.

import { $, element, t } from "./dom.js";
import { ending_of } from "./workspace.js";

export function set_up_world({ workspace, keep }) {
  const of_kind = kind => Object.keys(workspace().files).filter(name => ending_of(name) === kind);
  function show() {
    const { run } = workspace();
    $("course").replaceChildren(element("option", { value: "" }, "none"), ...of_kind("svg").map(name => element("option", { value: name, translate: "no" }, name)));
    $("course").value = run.course = of_kind("svg").includes(run.course) ? run.course : "";
    // An example may have stimulus lines besides files: `wall y=80`.
    run.stimuli = run.stimuli.filter(one => ending_of(one) !== "stimulus" || /\s/.test(one) || of_kind("stimulus").includes(one));
    const choices = [...new Set([...of_kind("stimulus"), ...run.stimuli])];
    $("scripts").hidden = !choices.length;
    $("scripts").replaceChildren($("scripts").firstElementChild, ...choices.map(name => {
      const box = element("input", { type: "checkbox", onchange: change, value: name });
      box.checked = run.stimuli.includes(name);
      return element("label", { translate: "no" }, box, ` ${name}`);
    }));
    $("input").value = run.input;
    $("seed").value = run.seed;
    show_button();
  }
  function show_button() {
    const { run } = workspace();
    const around = [run.course, ...run.stimuli, run.input && t("numbers")].filter(Boolean);
    $("world-button").replaceChildren("More", ...around.length ? [element("span", { translate: "no" }, `: ${around[0]}${around.length > 1 ? ", …" : ""}`)] : []);
  }
  function change() {
    const { run } = workspace();
    run.course = $("course").value;
    run.stimuli = [...$("scripts").querySelectorAll("input:checked")].map(box => box.value);
    run.input = $("input").value.slice(0, 500);
    run.seed = Math.max(0, Math.trunc(Number($("seed").value) || 0));
    show_button();
    keep();
  }
  for (const id of ["course", "input", "seed"]) $(id).addEventListener("change", change);
  $("input").addEventListener("input", change);
  $("world-button").addEventListener("click", () => {
    $("world").hidden = !$("world").hidden;
    $("world-button").setAttribute("aria-expanded", String(!$("world").hidden));
  });
  return { show };
}
