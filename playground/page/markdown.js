// The Markdown of lessons and of the language server: paragraphs, lists, code, **strong**, *emphasis* and links. A full
// Markdown library would be ten times as large.

const escapes = { "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" };
const plain = text => text.replace(/[&<>"]/g, sign => escapes[sign]);

/** Inline markup. Code is set aside first, so that nothing in it is interpreted. */
function words(text) {
  const codes = [];
  return plain(text).replace(/`([^`]+)`/g, (_, code) => `\0${codes.push(`<code>${code}</code>`) - 1}\0`)
    .replace(/\*\*([^]+?)\*\*/g, "<strong>$1</strong>").replace(/\*([^*]+)\*/g, "<em>$1</em>")
    .replace(/\[([^\]]+)\]\(([^\s)]+)\)/g, '<a href="$2">$1</a>').replace(/\0(\d+)\0/g, (_, n) => codes[n]);
}

/** Each kind of block: a pattern for its lines (the first begins it), and how to render them. */
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

/** Splits a text into blocks. */
function pieces_of(text) {
  const lines = text.replaceAll("\0", "").split("\n"), pieces = [];
  for (let at = 0; at < lines.length;) {
    const block = blocks.find(({ first }) => first.test(lines[at]));
    if (!block) { ++at; continue; }
    let end = at + 1;
    while (end < lines.length && block.on(lines[end])) ++end;
    pieces.push(block.make(lines.slice(at, end)));
    at = end + (block.last ? 1 : 0);
  }
  return pieces;
}
export const markdown = text => pieces_of(text).join("");

/** Shows a word's meaning and an example; the rest opens on demand. */
function brief(pieces) {
  const is_code = piece => piece?.startsWith("<pre>"), names_code = (piece, i) => /:<\/p>\n$/.test(piece) && is_code(pieces[i + 1]);
  const told = pieces.find(piece => piece.startsWith("<p>")), example = pieces.find(is_code), seen = pieces.filter(piece => piece === told || piece === example);
  const rest = pieces.filter((piece, i) => !seen.includes(piece) && !names_code(piece, i)).join("");
  return seen.join("") + (rest && `<details><summary>more</summary>${rest}</details>\n`);
}
/** Replaces the library of @codemirror/lsp-client (site/build.mjs), which renders hovers. */
export class Marked {
  parse(text) { return brief(pieces_of(text)); }
}
