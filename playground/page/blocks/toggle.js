// Blocks or text: the switch next to the files, and the pane that replaces the editor while blocks are shown.

import { element, button, not_here } from "../dom.js";

const store = "orb-playground-blocks";
const remembered = () => { try { return localStorage.getItem(store) === "blocks"; } catch { return false; } };
const remember = blocks => { try { localStorage.setItem(store, blocks ? "blocks" : "text"); } catch { /* not allowed: for this visit only */ } };

/** `editor`: that of the page; `active()`: the open file's name and text; `add_file(name, text)`. */
export function set_up_blocks({ nonce, language, editor, active, add_file, editor_pane, before }) {
  let wanted = remembered(), view = null, loading = null;
  let shown = ""; // name of the file shown as blocks
  let own_text = null; // last text written by the blocks
  let asked = 0, last_findings = [];

  const choice = (words, blocks) => button(words, () => choose(blocks), { id: blocks ? "as-blocks" : "as-text", "aria-pressed": "false" });
  const switches = element("div", { class: "row forms", role: "group", "aria-label": "Show the program as" }, choice("Blocks", true), choice("Text", false));
  before.before(switches);
  const canvas = element("div", { id: "blocks-canvas", class: "blocks-canvas" });
  const zooms = element("div", { class: "blocks-zoom", role: "group", "aria-label": "Block size" }, button("−", () => view?.zoom(-1), { "aria-label": "Smaller" }), button("+", () => view?.zoom(1), { "aria-label": "Larger" }));
  const words = element("div", { class: "blocks-words", hidden: true });
  const pane = element("div", { id: "blocks", class: "blocks", role: "tabpanel", "aria-label": "Program as blocks", hidden: true }, canvas, zooms, words);
  editor_pane.after(pane);

  const is_structured = name => name.endsWith(".orb");
  const has_blocks = name => is_structured(name) || name.endsWith(".bas");
  function show_switch() {
    const { name } = active();
    switches.hidden = !has_blocks(name);
    const blocks = wanted && has_blocks(name);
    for (const one of switches.children) one.setAttribute("aria-pressed", String((one.id === "as-blocks") === blocks));
    pane.hidden = !blocks;
    editor_pane.hidden = blocks;
    return blocks;
  }
  /** Shows why there are no blocks. */
  function explain(...parts) {
    shown = "";
    words.replaceChildren(...parts);
    words.hidden = false;
    canvas.hidden = zooms.hidden = true;
  }
  const style = element("link", { rel: "stylesheet", href: new URL("./blocks.css", import.meta.url).href });
  let generation = 0; // of views: each language needs its own
  let loose = []; // unconnected blocks of the last view
  async function load() {
    const own = ++generation;
    document.head.append(style);
    const [{ make_blocks, most_rows }, vocabulary] = await Promise.all([import("./view.js").catch(not_here), language.call("words")]);
    words.hidden = true;
    canvas.hidden = zooms.hidden = false;
    const made = await make_blocks({ parent: canvas, nonce, words: vocabulary, loose, narrow: matchMedia("(max-width: 860px)").matches,
      on_text(text, typed) {
        own_text = text;
        editor.put(text, typed);
      } });
    if (own !== generation) return made.dispose();
    view = made;
    view.most_rows = most_rows;
  }
  new ResizeObserver(() => { if (!pane.hidden) view?.resize(); }).observe(canvas);
  async function show({ fresh }) {
    if (!show_switch()) {
      shown = "";
      return;
    }
    const { name, text } = active(), question = ++asked;
    if (!is_structured(name)) {
      explain(element("p", {}, "Blocks show structured programs. This one uses line numbers and jumps, and there are no blocks for those."),
        element("p", {}, button("Turn it into a structured program", lift, { class: "strong", id: "lift" }), " in a separate file; this one stays as it is."));
      return;
    }
    try {
      if (!view) {
        explain(element("p", {}, "Loading the blocks…"));
        await (loading ??= load());
        if (!view) return; // the page's language changed meanwhile
      }
      const { rows } = await language.call("tree", { files: { [name]: text } });
      if (question !== asked) return; // the text changed meanwhile
      if (rows.length > view.most_rows) return explain(element("p", {}, `This program has ${rows.length} lines, which is too many for blocks. It is under Text.`));
      words.hidden = true;
      canvas.hidden = zooms.hidden = false;
      view.resize();
      view.show(text, rows, { fresh: fresh || shown !== name });
      shown = name;
      own_text = text;
      view.findings(last_findings);
    } catch (error) {
      if (question !== asked) return;
      loading = view ? loading : null;
      explain(element("p", {}, `The blocks cannot be shown: ${error.message}. The program is under Text.`));
    }
  }
  async function lift() {
    const { name, text } = active();
    try {
      const { text: lifted } = await language.call("lift", { files: { [name]: text } });
      add_file(name.replace(/\.bas$/, ".orb"), lifted);
    } catch (error) {
      explain(element("p", {}, error.findings ? "It has errors, which are listed below. Fix them under Text first." : `It cannot be turned into one: ${error.message}.`));
    }
  }
  function choose(blocks) {
    if (blocks === wanted && blocks === !pane.hidden) return;
    const line = !blocks && shown ? view.chosen_line() : 0;
    wanted = blocks;
    remember(blocks);
    show({ fresh: true });
    if (!blocks) editor.shown_again(line);
  }
  // The undo keys act on the text's history.
  pane.addEventListener("keydown", event => {
    if (!(event.ctrlKey || event.metaKey) || event.altKey || event.target.closest("input, textarea")) return;
    const key = event.key.toLowerCase();
    const deed = key === "z" && !event.shiftKey ? editor.undo : key === "y" || key === "z" ? editor.redo : null;
    if (!deed) return;
    event.preventDefault();
    event.stopPropagation();
    deed();
  }, { capture: true });
  show_switch();

  return {
    /** Another file was opened. */
    open() { own_text = null; show({ fresh: true }); },
    /** The page's language changed: existing blocks keep their words, so make them again. */
    say_anew() {
      loose = view?.dispose() ?? loose;
      ++generation;
      view = loading = null;
      show({ fresh: true });
    },
    changed(text) { if (!pane.hidden && text !== own_text) show({ fresh: false }); },
    findings(list) {
      last_findings = list ?? [];
      if (list && shown && !pane.hidden) view.findings(list);
    },
    run_line(line) { if (shown && !pane.hidden) view.run_line(line); },
    /** Returns true if it has moved there itself. */
    go_to(line) {
      if (!shown || pane.hidden) return false;
      view.go_to(line);
      return true;
    },
    view: () => view,
  };
}
