// Markdown as lessons and the language server write it: paragraphs, lists, code, **strong**, *emphasis* and links.
// A library for all of Markdown would weigh ten times as much.

const escapes = { "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" };
const plain = text => text.replace(/[&<>"]/g, sign => escapes[sign]);

/** What stands in a paragraph. Code is set aside first, so that nothing in it means anything. */
function words(text) {
  const codes = [];
  return plain(text).replace(/`([^`]+)`/g, (_, code) => `\0${codes.push(`<code>${code}</code>`) - 1}\0`)
    .replace(/\*\*([^]+?)\*\*/g, "<strong>$1</strong>").replace(/\*([^*]+)\*/g, "<em>$1</em>")
    .replace(/\[([^\]]+)\]\(([^\s)]+)\)/g, '<a href="$2">$1</a>').replace(/\0(\d+)\0/g, (_, n) => codes[n]);
}

/** Each kind of block: the lines that belong to it (the first of them begins it), and what becomes of them. */
const code = lines => `<pre><code>${plain(lines.join("\n"))}\n</code></pre>\n`;
const list = name => lines => {
  const items = lines.join("\n").split(/^(?:[-*]|\d+\.) +/m).slice(1);
  return `<${name}>\n${items.map(item => `<li>${words(item.trim().replace(/\n\s+/g, "\n"))}</li>\n`).join("")}</${name}>\n`;
};
const blocks = [
  { first: /^```/, on: line => !/^```/.test(line), last: true, make: lines => code(lines.slice(1)) },
  { first: /^ {4}/, on: line => /^( {4}|\s*$)/.test(line), make: lines => code(lines.join("\n").trimEnd().split("\n").map(line => line.slice(4))) },
  { first: /^#+ /, on: () => false, make: ([line]) => {
    const [, { length }, title] = /^(#+) +(.*)/.exec(line);
    return `<h${length}>${words(title)}</h${length}>\n`;
  } },
  { first: /^[-*] /, on: line => /^([-*] |\s+\S)/.test(line), make: list("ul") },
  { first: /^\d+\. /, on: line => /^(\d+\. |\s+\S)/.test(line), make: list("ol") },
  { first: /\S/, on: line => /^(?!```|#|[-*] )\s*\S/.test(line), make: lines => `<p>${words(lines.map(line => line.trim()).join("\n"))}</p>\n` },
];

export function markdown(text) {
  const lines = text.replaceAll("\0", "").split("\n");
  let html = "";
  for (let at = 0; at < lines.length;) {
    const block = blocks.find(({ first }) => first.test(lines[at]));
    if (!block) { ++at; continue; }
    let end = at + 1;
    while (end < lines.length && block.on(lines[end])) ++end;
    html += block.make(lines.slice(at, end));
    at = end + (block.last ? 1 : 0);
  }
  return html;
}

/** What @codemirror/lsp-client takes for its library (site/build.mjs). */
export class Marked {
  parse(text) { return markdown(text); }
}
