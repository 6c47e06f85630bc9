// The editor: CodeMirror with the language server of `orb lsp` in a worker.

import { defaultKeymap, history, historyKeymap, isolateHistory, redo, undo } from "@codemirror/commands";
import { bracketMatching } from "@codemirror/language";
import { EditorView, Decoration, ViewPlugin, drawSelection, highlightActiveLine, highlightActiveLineGutter, highlightSpecialChars, keymap, lineNumbers } from "@codemirror/view";
import { Compartment, EditorState, StateEffect, StateField, Prec } from "@codemirror/state";
import { setDiagnostics, lintGutter, nextDiagnostic } from "@codemirror/lint";
import { LSPClient, LSPPlugin, hoverTooltips, signatureHelp, formatDocument, formatKeymap,
  renameKeymap, jumpToDefinitionKeymap } from "@codemirror/lsp-client";
import { harmless, t } from "./page/dom.js";
import "./page/editor_parts.js";
import { typing } from "./page/typing.js";
import { ending_of, limit_words, limits } from "./page/workspace.js";

const uri_of = name => "file:///" + encodeURIComponent(name);
/** Longer texts are checked when typing pauses, to keep it fluent. */
const quick = 48 * 1024;

// ---- colours from the server's semantic tokens ----
const set_colors = StateEffect.define();
const colors = StateField.define({
  create: () => Decoration.none,
  update(value, transaction) {
    for (const effect of transaction.effects) if (effect.is(set_colors)) return effect.value;
    return transaction.docChanged ? value.map(transaction.changes) : value;
  },
  provide: field => EditorView.decorations.from(field),
});
function decorations(doc, data, legend) {
  const marks = [];
  let line = 0, character = 0;
  for (let i = 0; i + 4 < data.length; i += 5) {
    if (data[i]) character = 0;
    line += data[i];
    character += data[i + 1];
    if (line >= doc.lines) break;
    const from = doc.line(line + 1).from + character, to = Math.min(from + data[i + 2], doc.length);
    const robots = data[i + 4] & 8 ? " tok-robots" : "";
    if (from < to) marks.push(Decoration.mark({ class: `tok-${legend[data[i + 3]]}${robots}` }).range(from, to));
  }
  return Decoration.set(marks, true);
}

// ---- the line that runs ----
const set_running = StateEffect.define();
const running_line = Decoration.line({ class: "running" });
const running = StateField.define({
  create: () => Decoration.none,
  update(value, transaction) {
    for (const effect of transaction.effects)
      if (effect.is(set_running)) {
        const { doc } = transaction.state;
        return effect.value >= 1 && effect.value <= doc.lines ? Decoration.set([running_line.range(doc.line(effect.value).from)]) : Decoration.none;
      }
    return transaction.docChanged ? Decoration.none : value;
  },
  provide: field => EditorView.decorations.from(field),
});

// ---- what to change next ----
const set_pointed = StateEffect.define();
const pointed = StateField.define({
  create: () => Decoration.none,
  update(value, transaction) {
    for (const effect of transaction.effects)
      if (effect.is(set_pointed)) return effect.value ? Decoration.set([Decoration.mark({ class: "cm-pointed" }).range(effect.value.from, effect.value.to)]) : Decoration.none;
    return transaction.docChanged ? Decoration.none : value;
  },
  provide: field => EditorView.decorations.from(field),
});

/** The editor's extensions, without those that need a parser in the page, such as folding. */
const basics = [
  lineNumbers(), highlightActiveLineGutter(), highlightSpecialChars(), history(), drawSelection(), bracketMatching(),
  highlightActiveLine(), keymap.of([...defaultKeymap, ...historyKeymap]),
];

const severities = [, "error", "warning", "info", "hint"];
const reconnects = 3; // a server that keeps crashing is not restarted

/** `language`: the client of a worker; `files()`: all texts; `on_change(name, text)`, `on_findings(name, list)`,
 *  `say(words, look)`. `foreign(name)`: for a file in a language that the server does not know, a function that loads its
 *  extension, given what the editor offers any language; null for other files. */
export function make_editor({ parent, nonce, language, files, on_change, on_findings, say, foreign }) {
  let view = null, shown = "", client = null, lost = 0;
  const states = new Map(); // of files shown before: text, selection and history

  // -- the server --
  function connect() {
    const listeners = new Set();
    const send = async message => {
      try {
        for (const answer of (await language.call("lsp", { message })).messages)
          for (const listener of listeners) listener(typeof answer === "string" ? answer : JSON.stringify(answer));
      } catch (error) {
        if (error.code === "broken") return; // the page reports it
        if (error.code !== "stopped" && ++lost <= reconnects) language.restart();
        else if (lost > reconnects) say("The checker has stopped. Save your program and reload the page.", "bad");
      }
    };
    client = new LSPClient({
      rootUri: "file:///",
      sanitizeHTML: harmless,
      timeout: 10_000,
      notificationHandlers: { "textDocument/publishDiagnostics": (_, params) => { show_findings(params); return true; } },
      extensions: [hoverTooltips(), signatureHelp()],
    });
    language.call("files", { files: files() }).catch(() => {});
    client.connect({ send, subscribe: listener => listeners.add(listener), unsubscribe: listener => listeners.delete(listener) });
  }
  language.on("restart", () => {
    connect();
    const name = shown;
    for (const [one, state] of states) states.set(one, fresh(one, state.doc.toString()));
    shown = ""; // the view refers to the crashed server
    if (name) show(name);
  });

  async function refresh_colors() {
    const plugin = LSPPlugin.get(view), doc = view.state.doc, asked = client;
    if (!plugin) return;
    const answer = await asked.request("textDocument/semanticTokens/full", { textDocument: { uri: plugin.uri } }).catch(() => null);
    const legend = asked.serverCapabilities?.semanticTokensProvider?.legend.tokenTypes;
    if (answer && legend && view.state.doc === doc) view.dispatch({ effects: set_colors.of(decorations(doc, answer.data, legend)) });
  }
  /** Requests findings and colours after each change. */
  const follow = ViewPlugin.fromClass(class {
    constructor() { this.plan(0); }
    plan(wait) {
      clearTimeout(this.timer);
      this.timer = setTimeout(() => {
        LSPPlugin.get(view)?.client.sync();
        refresh_colors();
      }, wait);
    }
    update(update) { if (update.docChanged) this.plan(update.state.doc.length > quick ? 300 : 0); }
    destroy() { clearTimeout(this.timer); }
  });

  // -- findings and their fixes --
  let findings = [], say_findings = () => {};
  /** Shows findings; `again()` shows them in another language. */
  function tell(found, again) {
    findings = found;
    say_findings = again;
    view.dispatch(setDiagnostics(view.state, findings));
    on_findings(shown, findings);
  }
  const place = (doc, { line, character }) => {
    if (line >= doc.lines) return doc.length;
    const there = doc.line(line + 1);
    return Math.min(there.from + character, there.to);
  };
  async function show_findings({ uri, version, diagnostics }) {
    const plugin = view && LSPPlugin.get(view);
    if (!plugin || plugin.uri !== uri) return;
    const file = plugin.client.workspace.getFile(uri), doc = plugin.syncedDoc;
    if (version !== undefined && version !== null && version !== file?.version) return;
    const put = actions => {
      if (LSPPlugin.get(view) !== plugin || plugin.syncedDoc !== doc) return;
      const map = position => plugin.unsyncedChanges.mapPos(place(doc, position));
      tell(diagnostics.map(one => ({
        from: map(one.range.start), to: map(one.range.end), line: one.range.start.line + 1, severity: severities[one.severity ?? 1],
        message: one.message.split("\n").map(line => t(line)).join("\n"), source: String(one.code ?? ""), actions: actions.filter(action => belongs(action, one)).map(action => fix(action, uri)),
      })), () => put(actions));
    };
    put([]);
    if (!diagnostics.length) return;
    const range = { start: { line: 0, character: 0 }, end: { line: doc.lines, character: 0 } };
    const actions = await plugin.client.request("textDocument/codeAction", { textDocument: { uri }, range, context: { diagnostics: [] } }).catch(() => null);
    if (actions?.length) put(actions);
  }
  const belongs = (action, finding) => action.diagnostics?.some(one => one.code === finding.code && one.message === finding.message &&
    one.range.start.line === finding.range.start.line && one.range.start.character === finding.range.start.character);
  const fix = ({ title, edit }, uri) => ({
    name: t(title).replace(/^./u, first => first.toUpperCase()),
    apply(editor) {
      const { doc } = editor.state;
      const changes = (edit?.changes?.[uri] ?? []).map(({ range, newText }) => ({ from: place(doc, range.start), to: place(doc, range.end), insert: newText }));
      editor.dispatch({ changes, userEvent: "input.fix" });
    },
  });
  function fix_here(editor) {
    const { from, to } = editor.state.doc.lineAt(editor.state.selection.main.head);
    const found = findings.find(one => one.from <= to && one.to >= from && one.actions.length);
    if (!found) return false;
    found.actions[0].apply(editor);
    return true;
  }

  // -- texts --
  const short_enough = EditorState.changeFilter.of(transaction => {
    if (!transaction.docChanged || transaction.newDoc.length <= limits.text) return true;
    setTimeout(() => say(`${limit_words.text}; that was left out.`, "bad"));
    return false;
  });
  const fresh = (name, text) => EditorState.create({
    doc: text,
    extensions: [
      Prec.high(keymap.of([...formatKeymap, ...renameKeymap, ...jumpToDefinitionKeymap, { key: "Mod-.", run: fix_here }, { key: "F8", run: nextDiagnostic }])),
      foreign(name) ? own_language.of([]) : [typing(ending_of(name)), colors, follow, client.plugin(uri_of(name), "")],
      basics, lintGutter(), running, pointed, short_enough,
      EditorView.lineWrapping, EditorView.cspNonce.of(nonce),
      EditorView.contentAttributes.of({ "aria-label": `Text of ${name}`, autocapitalize: "off", autocorrect: "off", spellcheck: "false" }),
      EditorView.updateListener.of(update => {
        if (!update.docChanged) return;
        states.set(name, update.state);
        on_change(name, update.state.doc.toString());
      }),
    ],
  });
  const own_language = new Compartment();
  async function bring_language(name) {
    const extension = await foreign(name)?.({ typing, tell, view });
    if (extension && shown === name) view.dispatch({ effects: own_language.reconfigure(extension) });
  }
  function show(name, text) {
    if (view && shown) states.set(shown, view.state);
    if (!states.has(name)) states.set(name, fresh(name, text));
    shown = name;
    findings = [];
    say_findings = () => {};
    on_findings(name, null); // unknown so far
    language.call("files", { files: files() }).catch(() => {}); // files that it includes or tests
    if (view) view.setState(states.get(name));
    else view = new EditorView({ state: states.get(name), parent });
    bring_language(name);
  }
  connect();

  return {
    show,
    /** Forgets the open files before others are opened. */
    reset() { states.clear(); shown = ""; },
    forget(name) { states.delete(name); if (shown === name) shown = ""; },
    /** Replaces the text in one undoable step. */
    replace(text) { view.dispatch({ changes: { from: 0, to: view.state.doc.length, insert: text } }); },
    /** Replaces only what differs; one undo step for each call, unless somebody is `typing`. */
    put(text, typing) {
      const { doc } = view.state, old = doc.toString();
      if (text === old) return;
      let from = 0, to = old.length, end = text.length;
      while (from < to && from < end && old[from] === text[from]) ++from;
      while (to > from && end > from && old[to - 1] === text[end - 1]) --to, --end;
      view.dispatch({ changes: { from, to, insert: text.slice(from, end) }, userEvent: typing ? "input.type" : "input.blocks", annotations: typing ? [] : isolateHistory.of("full") });
    },
    undo: () => undo(view),
    redo: () => redo(view),
    /** Call this after the editor was hidden; `line` is the one to show. */
    shown_again(line) {
      view.requestMeasure();
      if (line) this.go_to(line);
    },
    /** Call this when the page's language has changed. */
    say_anew: () => say_findings(),
    focus: () => view.focus(),
    format: () => formatDocument(view),
    run_line(line) {
      if (!view) return;
      const marked = view.state.field(running).iter();
      const shown_line = marked.value ? view.state.doc.lineAt(marked.from).number : 0;
      if (line === shown_line) return;
      const effects = [set_running.of(line)];
      // Do not move the text while somebody types.
      if (line >= 1 && line <= view.state.doc.lines && !view.hasFocus) effects.push(EditorView.scrollIntoView(view.state.doc.line(line).from, { y: "nearest", yMargin: 40 }));
      view.dispatch({ effects });
    },
    /** Marks the first group of `pattern` until the text changes; without a pattern, nothing. */
    point_at(pattern) {
      const found = pattern?.exec(view.state.doc.toString()), from = found && found.index + found[0].lastIndexOf(found[1]);
      view.dispatch({ effects: set_pointed.of(found ? { from, to: from + found[1].length } : null) });
    },
    go_to(line, column = 1) {
      const there = view.state.doc.line(Math.min(Math.max(line, 1), view.state.doc.lines));
      view.dispatch({ selection: { anchor: Math.min(there.from + column - 1, there.to) }, scrollIntoView: true });
      view.focus();
    },
    select({ from, to }) {
      view.dispatch({ selection: { anchor: from, head: to }, scrollIntoView: true });
      view.focus();
    },
    apply: action => { action.apply(view); view.focus(); },
    view: () => view,
  };
}
