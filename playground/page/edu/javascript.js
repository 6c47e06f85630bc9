// JavaScript in the editor: colours, completions and hovers. What Sphero Edu programs call comes from the table of that API.

import { javascriptLanguage } from "@codemirror/lang-javascript";
import { syntaxHighlighting, syntaxTree } from "@codemirror/language";
import { Decoration, EditorView, ViewPlugin, hoverTooltip } from "@codemirror/view";
import { classHighlighter } from "@lezer/highlight";
import { t, with_code, element } from "../dom.js";

const quick = 48 * 1024; // characters; longer texts are checked when typing pauses
const names = new Set(["VariableName", "VariableDefinition", "PropertyName"]);
const configuration = {
  comments: { lineComment: "//" }, autoClosingPairs: ["{", "[", "(", "'", '"', "`"].map(open => ({ open })),
  indentationRules: { increaseIndentPattern: { pattern: "[{([][^\\])}]*$" }, decreaseIndentPattern: { pattern: "^\\s*[\\])}]" } },
};
const words = "async await break case catch class const continue default do else false finally for function if in let new null of return switch throw true try typeof undefined var while".split(" ");

/** The operands of a call as text: `heading, speed, duration`. */
const operands_of = ({ operands = [] }) => operands.map(one => one.presence === "optional" ? `${one.name}?` : one.presence === "rest" ? `…${one.name}` : one.name).join(", ");
const range_of = ({ least, most, type, unit }) => (type === "number" || type === "whole") && (least || most) && most < 999_999 ? `${least} – ${most}${unit ? ` ${unit}` : ""}` : unit;

/** The documentation of a row of the table. */
function told(row) {
  const ranges = (row.operands ?? []).map(one => [one.name, range_of(one)]).filter(([, range]) => range);
  return element("div", { class: "cm-lsp-documentation" },
    element("p", {}, element("code", {}, row.operands ? `${row.kind === "awaited" ? "await " : ""}${row.name}(${operands_of(row)})` : row.name)),
    element("p", {}, with_code(row.summary)),
    ...ranges.length ? [element("p", { class: "hint" }, ranges.map(([name, range]) => `${name}: ${range}`).join(", "))] : [],
    ...row.example ? [element("pre", {}, row.example)] : []);
}

/** Completions. `api`: rows by name. */
function offers_of(api, table) {
  const calls = table.functions.map(row => ({ label: row.name, type: "function", detail: `(${operands_of(row)})`, info: () => told(row), boost: 1 }));
  const objects = table.objects.map(({ name }) => ({ label: name, type: "enum" }));
  const general = words.map(label => ({ label, type: "keyword" }));
  const members = Object.fromEntries([...table.objects.map(({ name, members }) => [name, members]), ["EventType", table.events.map(({ name }) => name)]]);
  return context => {
    const member = context.matchBefore(/\b[A-Z]\w*\.\w*$/);
    if (member) {
      const [name] = member.text.split(".");
      const known = Object.hasOwn(members, name) ? members[name] : [];
      return known.length ? { from: member.from + name.length + 1, options: known.map(label => ({ label, type: "enumMember", ...api.has(label) ? { info: () => told(api.get(label)) } : {} })), validFor: /^\w*$/ } : null;
    }
    const typed = context.matchBefore(/[A-Za-z_$][\w$]*/);
    if (!typed && !context.explicit) return null;
    const { type } = syntaxTree(context.state).resolveInner(context.pos, -1);
    if (!context.explicit && /String|Comment|Template|RegExp|PropertyName|Definition/.test(type.name)) return null;
    const options = [...calls, ...objects, ...general];
    if (typed && !context.explicit && options.some(({ label }) => label === typed.text)) return null;
    return { from: typed?.from ?? context.pos, options, validFor: /^[\w$]*$/ };
  };
}

/** Colours the names of the API. */
const robots_words = api => ViewPlugin.fromClass(class {
  constructor(view) { this.decorations = this.find(view); }
  update(update) {
    if (update.docChanged || update.viewportChanged || syntaxTree(update.startState) !== syntaxTree(update.state)) this.decorations = this.find(update.view);
  }
  find({ visibleRanges, state }) {
    const marks = [];
    for (const { from, to } of visibleRanges)
      syntaxTree(state).iterate({ from, to, enter(node) {
        if (names.has(node.name) && api.has(state.sliceDoc(node.from, node.to))) marks.push(robots_mark.range(node.from, node.to));
      } });
    return Decoration.set(marks, true);
  }
}, { decorations: plugin => plugin.decorations });
const robots_mark = Decoration.mark({ class: "tok-function tok-robots" });

/** The extension for JavaScript, made from the editor's kit. `findings(doc)` checks a text. */
export function javascript({ typing, tell, view }, { table, findings }) {
  const api = new Map([...table.objects, ...table.events, ...table.functions].map(row => [row.name, row]));
  const look = () => tell(findings(view.state.doc), look);
  const follow = ViewPlugin.fromClass(class {
    constructor() { this.plan(0); }
    plan(wait) {
      clearTimeout(this.timer);
      this.timer = setTimeout(look, wait);
    }
    update(update) { if (update.docChanged) this.plan(update.state.doc.length > quick ? 300 : 0); }
    destroy() { clearTimeout(this.timer); }
  });
  const meaning = hoverTooltip((view, pos) => {
    const node = syntaxTree(view.state).resolveInner(pos), row = names.has(node.name) && api.get(view.state.sliceDoc(node.from, node.to));
    return row?.summary ? { pos: node.from, end: node.to, create: () => ({ dom: told(row) }) } : null;
  });
  return [
    typing("js", { configuration, offers: offers_of(api, table) }),
    javascriptLanguage.extension, syntaxHighlighting(classHighlighter), robots_words(api), meaning, follow,
  ];
}
