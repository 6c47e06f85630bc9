// The editor's behaviour while typing: closes brackets, indents lines, offers words. The rules for blocks come from the
// language configurations that VS Code also reads.

import { autocompletion, closeBrackets, closeBracketsKeymap } from "@codemirror/autocomplete";
import { serverCompletionSource } from "@codemirror/lsp-client";
import { EditorState } from "@codemirror/state";
import { keymap } from "@codemirror/view";
import bas from "../../docs/editors/vscode/orbbasic.language-configuration.json";
import macro from "../../docs/editors/vscode/orbmacro.language-configuration.json";
import orb from "../../docs/editors/vscode/orbstructured.language-configuration.json";
import stimulus from "../../docs/editors/vscode/orbstimulus.language-configuration.json";
import test from "../../docs/editors/vscode/orbtest.language-configuration.json";

const configurations = { __proto__: null, bas, macro, orb, stimulus, test };
const step = "  ";

const pattern_of = ({ pattern, flags }) => new RegExp(pattern, flags);
/** Patterns of lines that begin a block (`more`), and that end or divide one (`less`); null if a language has no blocks. */
function blocks_of({ indentationRules: rules }) {
  return rules ? { more: pattern_of(rules.increaseIndentPattern), less: pattern_of(rules.decreaseIndentPattern) } : null;
}

const blanks_before = text => /^\s*/.exec(text)[0];
/** The indentation of the line `here`. `above`: the lines above it, nearest first. */
function indentation(here, above, { more, less }) {
  if (less.test(here)) {
    let inner = 0; // blocks that end between this line and its block's start
    for (const line of above) {
      const opens = more.test(line), closes = less.test(line);
      if (closes && !opens) ++inner;
      else if (opens && !closes && --inner < 0)
        // The parts of a `select` are indented within it.
        return blanks_before(line) + (more.test(here) && /^\s*select\b/i.test(line) ? step : "");
    }
    return "";
  }
  for (const line of above) if (line.trim()) return blanks_before(line) + (more.test(line) ? step : "");
  return "";
}

/** The lines above a line, nearest first. */
function* lines_above(doc, number) {
  while (--number > 0) yield doc.line(number).text;
}
/**
 * Moves a line back when it ends or divides a block, and in again when it becomes another word: `next`, `nextval`.
 */
const follow_block = blocks => EditorState.transactionFilter.of(typed => {
  if (!typed.isUserEvent("input.type") && !typed.isUserEvent("input.complete")) return typed;
  const doc = typed.newDoc, { head } = typed.newSelection.main, line = doc.lineAt(head), own = blanks_before(line.text);
  if (head < line.to || !line.text.trim()) return typed;
  const wanted = indentation(line.text, lines_above(doc, line.number), blocks);
  const inner = indentation("", lines_above(doc, line.number), blocks);
  const before = indentation(line.text.slice(0, -1), lines_above(doc, line.number), blocks);
  // Keep manual indentation.
  if (own === wanted || own !== inner && own !== before) return typed;
  return [typed, { changes: { from: line.from, to: line.from + own.length, insert: wanted }, sequential: true }];
});
/** Inserts a new line with the indentation of its block. */
const new_line = blocks => ({ state, dispatch }) => {
  const { main, ranges } = state.selection;
  if (ranges.length > 1 || !main.empty) return false;
  const line = state.doc.lineAt(main.head), before = line.text.slice(0, main.head - line.from), after = line.text.slice(main.head - line.from);
  const next = indentation(after, function* () { yield before; yield* lines_above(state.doc, line.number); }(), blocks);
  const from = before.trim() ? main.head : line.from; // an empty line keeps no blanks
  const changes = { from, to: main.head + blanks_before(after).length, insert: `\n${next}` };
  dispatch(state.update({ changes, selection: { anchor: from + 1 + next.length }, scrollIntoView: true, userEvent: "input" }));
  return true;
};

/** Offers words that begin like the one being typed: none after a blank, and none for a complete word. */
async function server_offers(context) {
  const typed = context.matchBefore(/[A-Za-z_]\w*/);
  if (!typed && !context.explicit) return null;
  const found = await serverCompletionSource(context);
  const words = new Set(found?.options.map(({ label }) => label.toLowerCase()));
  const is_complete = word => words.has(word.toLowerCase());
  if (!found || typed && !context.explicit && is_complete(typed.text)) return null;
  return { ...found, validFor: word => /^\w*$/.test(word) && !is_complete(word) };
}

/** The extension for files with that ending; `offers` finds the words to choose from. */
export function typing(ending, { configuration = configurations[ending] ?? {}, offers = server_offers } = {}) {
  const { autoClosingPairs = [], comments } = configuration, blocks = blocks_of(configuration);
  const data = [{ closeBrackets: { brackets: autoClosingPairs.map(({ open }) => open) }, ...comments ? { commentTokens: { line: comments.lineComment } } : {} }];
  return [
    EditorState.languageData.of(() => data),
    closeBrackets(), keymap.of(closeBracketsKeymap),
    // Enter inserts a new line unless somebody selected a word with an arrow key.
    autocompletion({ override: [offers], selectOnOpen: false, filterStrict: true }),
    ...blocks ? [follow_block(blocks), keymap.of([{ key: "Enter", run: new_line(blocks), shift: new_line(blocks) }])] : [],
  ];
}
