// Sphero Edu programs, which are JavaScript. Loaded when one is opened.

import table from "edu.json";
import { check } from "../../edu/check.js";
import { fill } from "../../edu/texts.js";
import { $, element, t } from "../dom.js";
import { javascript } from "./javascript.js";
import { make_runs } from "./run.js";
import { make_tests } from "./tests.js";

const usual = "bolt";
const kinds = ["bolt", "bolt+", "mini", "rvr", "sprk+", "ollie", "r2d2", "bb9e"];

/** Plays the sounds and speech of a live run; `sounds()` returns what loads page/sound.js, or null if sounds are off. */
const heard = sounds => (what, [words]) => sounds()?.(({ call }) => {
  if (what === "sound" || what === "animation") call(words);
  if (what !== "speak" || !window.speechSynthesis) return;
  const said = new SpeechSynthesisUtterance(words);
  said.lang = document.documentElement.lang;
  speechSynthesis.speak(said);
});

/** `keep()` saves the workspace; `sounds()` as in `heard`. */
export async function set_up_edu({ machine, ball, workspace, keep, sounds }) {
  const kind = () => kinds.includes(workspace().run.robot) ? workspace().run.robot : usual;
  const title_of = name => table.robots.find(one => one.name === name)?.title ?? name;

  // -- which robot it is for --
  const choice = element("select", { id: "robot-kind", "aria-label": "Robot" }, ...kinds.map(name => element("option", { value: name, translate: "no" }, title_of(name))));
  $("world-button").before(choice);
  let look = () => {};
  choice.addEventListener("change", () => {
    workspace().run.robot = choice.value;
    keep();
    look();
  });

  // -- its text --
  const place = (doc, line, column) => {
    const there = doc.line(Math.min(Math.max(line, 1), doc.lines));
    return Math.min(there.from + Math.max(column, 1) - 1, there.to);
  };
  const say = (text, holes) => fill(t(text), holes);
  /** Replaces a line, or deletes it if `text` is blank. */
  const mend = ({ line, text }) => view => {
    const { doc } = view.state, { from, to } = doc.line(line), changes = text.trim() ? { from, to, insert: text } : { from, to: Math.min(to + 1, doc.length) };
    view.dispatch({ changes, userEvent: "input.fix" });
  };
  /** The findings of a text, as the editor shows them. */
  function findings(doc) {
    return check(doc.toString(), { table, kind: kind(), say }).map(({ line, column, end_line, end_column, severity, message, help, rule, fix }) => ({
      from: place(doc, line, column), to: place(doc, end_line, end_column), line, severity, source: rule,
      message: help ? `${message}\n${help}` : message, actions: fix ? [{ name: fix.title.replace(/^./u, first => first.toUpperCase()), apply: mend(fix) }] : [],
    }));
  }
  const runs = make_runs({ machine, ball, table, kind, title_of, say, on_heard: heard(sounds) });
  return {
    language(kit) {
      const { tell, view } = kit;
      look = () => tell(findings(view.state.doc), look);
      return javascript(kit, { table, findings });
    },
    /** Shows what only JavaScript programs need if one is open. */
    show(is_open) {
      choice.hidden = !is_open;
      $("number-form").hidden = is_open; // no `input` in JavaScript
      choice.value = kind();
    },
    ...runs,
    test: make_tests({ machine, ball, table, kind, say }),
  };
}
