// A program as blocks: Blockly, loaded on demand. The blocks are a view of the text: changes on either side are applied
// to the other at once.

import * as Blockly from "blockly/core";
import { define_blocks } from "./kinds.js";
import { names_in } from "./fields.js";
import { load_rows } from "./rows.js";
import { write } from "./write.js";
import { theme_of } from "./look.js";
import { drawers, toolbox_of } from "./toolbox.js";
import { not_here } from "../dom.js";

export { most_rows } from "./rows.js";

const messages = { de: () => import("blockly/msg/de"), es: () => import("blockly/msg/es"), fr: () => import("blockly/msg/fr") };
// The page's undo history belongs to the text.
for (const name of ["undo", "redo"]) Blockly.ShortcutRegistry.registry.unregister(name);

/** Adds the nonce of the page's policy to style sheets that `deed` creates. */
function with_nonce(nonce, deed) {
  const create = document.createElement;
  document.createElement = function (name, ...more) {
    const made = create.call(this, name, ...more);
    if (name === "style") made.nonce = nonce;
    return made;
  };
  try {
    return deed();
  } finally {
    document.createElement = create;
  }
}

const gap = 40;

/**
 * Makes blocks in the language of the page. `loose`: saved unconnected blocks; `on_text(text, typed)`: the blocks'
 * text has changed; `typed`: somebody is still typing.
 */
export async function make_blocks({ parent, nonce, words, narrow, loose, on_text }) {
  Blockly.setLocale(await (messages[document.documentElement.lang] ?? (() => import("blockly/msg/en")))().catch(not_here));
  define_blocks(Blockly, words);
  let places = new Map(); // the blocks for each line of the text
  let loading = false, written = null, planned = false;
  const moved = new Set(); // subs that somebody has moved
  const routines = () => workspace.getTopBlocks(true).filter(({ kind }) => kind.routine).map(block => ({ type: block.type, name: block.getFieldValue("NAME"),
    parameters: block.makes().filter(([kind]) => kind === "parameter") }));
  const list = drawers(words, { made: of => names_in(workspace, of), routines: () => routines(), labels: !narrow });
  const workspace = with_nonce(nonce, () => Blockly.inject(parent, {
    renderer: "zelos", theme: theme_of(Blockly, document.documentElement), toolbox: toolbox_of(list), horizontalLayout: narrow,
    media: new URL("./blocks/", import.meta.url).href, sounds: false, trashcan: false, comments: false, collapse: false, disable: false,
    move: { scrollbars: true, drag: true, wheel: true }, zoom: { controls: false, wheel: false, pinch: true, startScale: narrow ? .62 : .7, minScale: .3, maxScale: 2 },
  }));
  workspace.MAX_UNDO = 0;
  for (const [name, , contents] of list)
    if (typeof contents === "function") workspace.registerToolboxCategoryCallback(name, contents);

  const loose_blocks = () => workspace.getTopBlocks(false).filter(block => !is_part(block)).map(block => Blockly.serialization.blocks.save(block, { addCoordinates: true }));
  const is_part = block => block.type === "program" || block.kind.routine;
  /** Marks unconnected blocks, which are not part of the program. */
  function mark_loose() {
    for (const top of workspace.getTopBlocks(false)) {
      const loose = !is_part(top);
      for (const block of top.getDescendants(false)) if (block.hasDisabledReason("loose") !== (loose && block === top)) block.setDisabledReason(loose && block === top, "loose");
    }
  }
  function without_events(deed) {
    Blockly.Events.disable();
    try { return deed(); } finally { Blockly.Events.enable(); }
  }
  function say_text(typed) {
    planned = false;
    if (workspace.isDragging()) return;
    without_events(() => {
      for (const block of workspace.getAllBlocks(false)) block.fill_empty();
      mark_loose();
    });
    const { text, ids } = write(workspace);
    places = new Map(ids.map((id, i) => [i + 1, id]));
    if (text === written) return;
    written = text;
    on_text(text, typed);
  }
  workspace.addChangeListener(event => {
    if (loading || (event.isUiEvent && event.type !== Blockly.Events.BLOCK_DRAG) || event.type === Blockly.Events.FINISHED_LOADING) return;
    if (event.type === Blockly.Events.BLOCK_DRAG) {
      if (event.isStart) return;
      const block = workspace.getBlockById(event.blockId);
      if (block?.kind.routine) moved.add(key_of(block));
    }
    if (planned) return;
    planned = true;
    queueMicrotask(() => say_text(event.type === Blockly.Events.BLOCK_FIELD_INTERMEDIATE_CHANGE));
  });

  /** Places the main program first, the subs next to it, or below if space is short. */
  function lay_out(kept) {
    const scale = workspace.scale, wide = workspace.getMetrics().viewWidth / scale > 900;
    const program = workspace.getBlockById("program");
    program.moveTo(new Blockly.utils.Coordinate(20, 20));
    const { width, height } = program.getHeightWidth();
    let x = wide ? 20 + width + gap : 20, y = wide ? 20 : 20 + height + gap, widest = 0;
    for (const block of workspace.getTopBlocks(false)) {
      if (block === program) continue;
      const place = kept.get(key_of(block));
      if (place) {
        block.moveTo(place);
        continue;
      }
      const size = block.getHeightWidth();
      block.moveTo(new Blockly.utils.Coordinate(x, y));
      y += size.height + gap;
      widest = Math.max(widest, size.width);
      if (wide && y > 1200) {
        x += widest + gap;
        y = 20;
      }
    }
  }
  const key_of = block => block.kind.routine ? block.getFieldValue("NAME").toLowerCase() : block.id;

  /** The line of the selected block; 0 for none. */
  function chosen_line() {
    let block = Blockly.getSelected();
    while (block && ![...places.values()].includes(block.id)) block = block.getParent?.();
    return block ? [...places].find(([, id]) => id === block.id)[0] : 0;
  }

  let marked = null; // the block that runs
  const look = () => workspace.setTheme(theme_of(Blockly, document.documentElement));
  const observer = new MutationObserver(look);
  observer.observe(document.documentElement, { attributes: true, attributeFilter: ["data-theme"] });
  const dark = matchMedia("(prefers-color-scheme: dark)");
  dark.addEventListener("change", look);

  const shown = new Map(); // findings shown by blocks
  return {
    /** Shows the rows of a text. Unconnected blocks stay, and moved subs keep their places. */
    show(text, rows, { fresh }) {
      const view = fresh ? null : { x: workspace.scrollX, y: workspace.scrollY };
      const focused = parent.contains(document.activeElement), line = chosen_line();
      const tops = fresh ? [] : workspace.getTopBlocks(false);
      const hanging = [...loose.splice(0), ...fresh ? [] : loose_blocks()];
      const kept = new Map(tops.filter(block => moved.has(key_of(block)) || !is_part(block)).map(block => [key_of(block), block.getRelativeToSurfaceXY()]));
      Blockly.hideChaff();
      loading = true;
      marked = null;
      shown.clear();
      try {
        without_events(() => {
          workspace.clear();
          places = load_rows(Blockly, workspace, rows);
          for (const state of hanging) Blockly.serialization.blocks.append(state, workspace);
          mark_loose();
        });
        Blockly.renderManagement.triggerQueuedRenders(workspace);
        without_events(() => lay_out(kept));
        written = write(workspace).text;
        if (written !== text) written = null; // the first change reformats the text
        if (view) workspace.scroll(view.x, view.y);
        else workspace.scroll(narrow ? 4 : 10, 10);
      } finally {
        loading = false;
        // The focused block is gone, but the next key, such as Ctrl+Y, is still meant for the blocks.
        if (focused) Blockly.getFocusManager().focusNode(workspace.getBlockById(places.get(line) ?? "") ?? workspace);
      }
    },
    findings(list) {
      const now = new Map();
      for (const { line, message, severity } of list) {
        const id = places.get(line);
        if (!id || severity === "hint") continue;
        now.set(id, [...now.get(id) ?? [], message.split("\n")[0].replaceAll("`", "")]);
      }
      without_events(() => {
        for (const id of new Set([...shown.keys(), ...now.keys()])) {
          const words = now.get(id)?.join("\n") ?? null;
          if (words === (shown.get(id) ?? null)) continue;
          workspace.getBlockById(id)?.setWarningText(words);
          if (words) shown.set(id, words);
          else shown.delete(id);
        }
      });
    },
    run_line(line) {
      const block = workspace.getBlockById(places.get(line) ?? "");
      if (block === marked) return;
      marked?.getSvgRoot()?.classList.remove("orb-runs");
      block?.getSvgRoot().classList.add("orb-runs");
      marked = block;
    },
    go_to(line) {
      const id = places.get(line);
      const block = id && workspace.getBlockById(id);
      if (!block) return;
      workspace.centerOnBlock(id);
      Blockly.getFocusManager().focusNode(block);
    },
    chosen_line,
    /** Returns the unconnected blocks for the next view. */
    dispose() {
      const left = loose_blocks();
      observer.disconnect();
      dark.removeEventListener("change", look);
      workspace.dispose();
      return left;
    },
    zoom: step => workspace.zoomCenter(step),
    resize: () => Blockly.svgResize(workspace),
    workspace: () => workspace,
    Blockly: () => Blockly,
  };
}
