// Blocks as text, in the layout of `orb fmt`.

import { part_of, sign_of, without_sign } from "./kinds.js";

const indent = level => "  ".repeat(Math.max(level, 0));
const field = (block, name) => block.getFieldValue(name) ?? "";
/** Keeps an edited comment a single-line comment. */
const as_comment = text => {
  const line = text.replaceAll(/[\n\r]/g, " ").trim();
  return !line || sign_of(line).trim() ? line : `' ${line}`;
};

const head_of = block => block.kind.print(block, part_of(block), block.memory);
const text_of_part = (block, part, i) => block.kind.part(block, part_of(block), part, i);
const end_of = block => block.kind.end(block, part_of(block), block.memory);
const first_in = (block, input) => block.getInputTargetBlock(input);

/** True if the block fits as S in `if … then S else S`. */
const fits_branch = block => block && !block.getNextBlock() && !block.kind.opens && !block.memory.after_blank && !block.memory.note &&
  !["comment", "text", "label", "const", "local", "array", "use", "include"].includes(block.type);
function is_one_line(block) {
  const { type, memory: { one_line, parts = [] } } = block;
  return type === "if" && one_line && parts.every(({ kind }) => kind === "else") &&
    fits_branch(first_in(block, "DO")) && (!parts.length || fits_branch(first_in(block, "DO0")));
}
const one_line = block => `${head_of(block)} ${head_of(first_in(block, "DO"))}${block.memory.parts?.length ? ` else ${head_of(first_in(block, "DO0"))}` : ""}`;
const line_of = block => is_one_line(block) ? one_line(block) : head_of(block);

/** The original layout of a line, if it differs from the canonical one and the content is the same. */
function layout_of(canonical, { text, lines, indent: more = 0 }) {
  if (!lines && text === canonical) return undefined;
  return { for: canonical, lines: lines ?? [text], more };
}

/** Stores in a block how its rows were laid out. */
export function remember(block, head, parts, end) {
  if (head.kind === "text" || head.kind === "comment") return;
  const { memory } = block;
  const keep = (holder, canonical, row) => {
    const layout = layout_of(canonical, row);
    if (layout) holder.layout = layout;
  };
  keep(memory, line_of(block), head);
  parts.forEach((row, i) => keep(memory.parts[i], text_of_part(block, memory.parts[i], i), row));
  if (end) keep(memory.end ??= {}, end_of(block), end);
}

/** Returns a workspace's program as text, and the block for each line. `fresh`: ignores stored layouts. */
export function write(workspace, { fresh = false } = {}) {
  const lines = [], ids = [];
  let known = 0; // lines with a stored layout
  const put = (block, text) => { lines.push(text); ids.push(block.id); };
  const blank = ({ after_blank }) => { if (after_blank && lines.length) { lines.push(""); ids.push(""); } };
  /** A line of code with its comment. */
  function line(block, level, canonical, { layout, after_blank } = {}, note) {
    blank({ after_blank });
    const comment = as_comment(note);
    const as_it_was = layout && !fresh && layout.for === canonical ? layout : null;
    if (as_it_was) ++known;
    const all = as_it_was?.lines ?? [canonical];
    all.forEach((one, i) => put(block, indent(level + (i > 0 ? as_it_was.more : 0)) + one + (comment && i === all.length - 1 ? ` ${comment}` : "")));
  }
  function statements(first, level) {
    for (let block = first; block; block = block.getNextBlock()) statement(block, level);
  }
  function statement(block, level) {
    const { kind, memory, type } = block;
    if (type === "comment") {
      blank(memory);
      put(block, indent(level + (memory.indent ?? 0)) + as_comment(kind.print(block, null, memory)));
    } else if (type === "text") {
      blank(memory);
      for (const { whole, text } of kind.lines(block, memory)) put(block, whole ?? indent(level) + text);
    } else if (!kind.opens || is_one_line(block)) line(block, level, line_of(block), memory, field(block, "NOTE"));
    else container(block, level);
  }
  function container(block, level, memory = block.memory) {
    const { kind } = block;
    line(block, level, head_of(block), memory, field(block, "NOTE"));
    const inner = level + kind.opens;
    statements(first_in(block, "DO"), inner);
    (memory.parts ?? []).forEach((part, i) => {
      line(block, inner - 1, text_of_part(block, part, i), part, field(block, `NOTE${i}`));
      statements(first_in(block, `DO${i}`), inner);
    });
    line(block, level, end_of(block), memory.end, field(block, "NOTEE"));
  }
  function routine(block) {
    const { after_blank, ...memory } = block.memory;
    blank({ after_blank });
    for (let i = 0; i < (memory.docs ?? 0); ++i) {
      const text = as_comment(field(block, `DOC${i}`));
      if (text) put(block, text);
    }
    container(block, 0, memory);
  }

  const tops = workspace.getTopBlocks(true);
  const routines = tops.filter(({ kind }) => kind.routine).map((block, i) => ({ block, rank: block.memory.rank ?? 1e6 + i })).sort((a, b) => a.rank - b.rank);
  for (let block = tops.find(({ type }) => type === "program")?.getNextBlock(); block; block = block.getNextBlock()) {
    while (routines.length && routines[0].rank < (block.memory.routines ?? 0)) routine(routines.shift().block);
    statement(block, 0);
  }
  for (const { block } of routines) routine(block);
  return { text: lines.map(one => `${one}\n`).join(""), ids, known };
}
