// The page in another language, loaded by those who read one. The code of the page says everything in English; whatever
// comes to stand on the page is said anew here, before anybody sees it.

import { make_catalogue } from "./catalogue.js";
import { speak_with } from "./dom.js";

const attributes = ["title", "aria-label", "placeholder", "alt"];
/** What somebody wrote or a program said; and blocks, which are made in the language. */
const kept = ".cm-content, .cm-gutters, pre, code, kbd, textarea, script, style, #tabs, #announce, #events .print .words, #variables th, [class*=blockly], [translate=no]";
const has_words = /\p{L}{2}/u;

export async function translate(code, address) {
  const answer = await fetch(address);
  if (!answer.ok) throw new Error(`${address}: ${answer.status}`);
  const find = make_catalogue(await answer.json());
  speak_with(text => find(text) ?? text);
  /** Blanks around it stay. */
  const said = text => text.replace(/\S[^]*\S/, words => find(words) ?? words);

  const written = new WeakMap(); // what stands there since it was translated here
  function text_node(node) {
    if (!has_words.test(node.data) || written.get(node) === node.data || node.parentElement?.closest(kept)) return;
    const words = said(node.data);
    written.set(node, words);
    if (words !== node.data) node.data = words;
  }
  function attribute(node, name) {
    const text = node.getAttribute(name), own = written.get(node) ?? {};
    if (!has_words.test(text) || own[name] === text || node.closest(kept)) return;
    written.set(node, { ...own, [name]: said(text) });
    if (said(text) !== text) node.setAttribute(name, said(text));
  }
  function all_of(root) {
    if (root.nodeType === Node.TEXT_NODE) return text_node(root);
    if (root.nodeType !== Node.ELEMENT_NODE) return;
    const walker = document.createTreeWalker(root, NodeFilter.SHOW_TEXT | NodeFilter.SHOW_ELEMENT);
    for (let node = root; node; node = walker.nextNode())
      if (node.nodeType === Node.TEXT_NODE) text_node(node);
      else for (const name of attributes) if (node.hasAttribute(name)) attribute(node, name);
  }
  new MutationObserver(records => {
    for (const { type, target, attributeName, addedNodes } of records)
      if (type === "characterData") text_node(target);
      else if (type === "attributes") attribute(target, attributeName);
      else for (const node of addedNodes) all_of(node);
  }).observe(document.body, { subtree: true, childList: true, characterData: true, attributes: true, attributeFilter: attributes });
  all_of(document.body);
  document.documentElement.lang = code;
}
