// Translates the page; loaded for languages other than English. The page's code writes English. This observes the page,
// replaces each text before it is painted, and remembers the English for the next language.

import { make_catalogue } from "./catalogue.js";
import { say_anew, speak_with } from "./dom.js";
import { made_of } from "./said.js";

const attributes = ["title", "aria-label", "placeholder", "alt"];
/** Not translated: what users or programs wrote; and blocks, which are made in the page's language. */
const kept = ".cm-content, .cm-gutters, pre, code, kbd, textarea, script, style, #tabs, #announce, #events .print .words, #variables th, [class*=blockly], [translate=no]";
const has_words = /\p{L}{2}/u;

let find = () => undefined;
/** Keeps surrounding blanks. */
const said = text => text.replace(/\S[^]*\S/, words => find(words) ?? words);

const written = new WeakMap(); // for each node, by attribute name ("" for its text): the shown text and its English original
/** The translation of what is shown; undefined if it is translated already. */
function translated(node, name, text) {
  const all = written.get(node) ?? {}, english = all[name]?.shown === text ? all[name].english : text, shown = said(english);
  written.set(node, { ...all, [name]: { english, shown } });
  return shown === text ? undefined : shown;
}
function text_node(node) {
  if (!has_words.test(node.data) || node.parentElement?.closest(kept)) return;
  const words = translated(node, "", node.data);
  if (words !== undefined) node.data = words;
}
function attribute(node, name) {
  const text = node.getAttribute(name);
  if (!has_words.test(text) || node.closest(kept)) return;
  const words = translated(node, name, text);
  if (words !== undefined) node.setAttribute(name, words);
}
function all_of(root) {
  if (root.nodeType === Node.TEXT_NODE) return text_node(root);
  if (root.nodeType !== Node.ELEMENT_NODE) return;
  const walker = document.createTreeWalker(root, NodeFilter.SHOW_TEXT | NodeFilter.SHOW_ELEMENT);
  for (let node = root; node; node = walker.nextNode())
    if (node.nodeType === Node.TEXT_NODE) text_node(node);
    else for (const name of attributes) if (node.hasAttribute(name)) attribute(node, name);
}
const observer = new MutationObserver(records => {
  for (const { type, target, attributeName, addedNodes } of records)
    if (type === "characterData") text_node(target);
    else if (type === "attributes") attribute(target, attributeName);
    else for (const node of addedNodes) all_of(node);
});

/** Switches the page to a language. `texts`: English texts and translations; empty for English. */
export function translate(code, texts) {
  find = make_catalogue(texts, made_of);
  speak_with(text => find(text) ?? text);
  document.documentElement.lang = code;
  say_anew();
  all_of(document.body);
  observer.observe(document.body, { subtree: true, childList: true, characterData: true, attributes: true, attributeFilter: attributes });
}
