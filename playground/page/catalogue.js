// How texts are said in another language: by the same files and the same rules as base/catalogue.h.

/** Names and figures, which every language has alike: `heading`, `90 ms`, `red, green, blue`. */
const names_and_figures = /^(?:(?:[-\d.]+|\S*,) )*\S+$/;
/** What may fill a hole behind that character. Between backticks code stays as it is, and what was printed between "";
 *  between “” stands what the catalogue
 *  knows, or what somebody wrote; elsewhere what it knows, or names and figures. */
const quoted = { "`": "([^`]+)", '"': '([^"]+)', "“": "([^“”]+)" };
const literal = text => text.replace(/[\\^$.*+?()[\]{}|]/g, "\\$&");

function template(english, translation) {
  const pieces = english.split(/\{(\w+)\}/); // what is fixed, a name, what is fixed …
  const holes = pieces.flatMap((name, i) => i % 2 ? [{ name, before: pieces[i - 1].at(-1) }] : []);
  const pattern = pieces.map((piece, i) => i % 2 ? quoted[pieces[i - 1].at(-1)] ?? "(.+?)" : literal(piece)).join("");
  return { pattern: new RegExp(`^${pattern}$`, "s"), holes, translation, fixed: english.replace(/\{\w+\}/g, "").length };
}

/** `texts`: English keys and their translations. The answer says a text in that language, and is undefined where it cannot. */
export function make_catalogue(texts) {
  const rows = Object.entries(texts), whole = new Map(rows.filter(([english]) => !english.includes("{")));
  const templates = rows.filter(([english]) => english.includes("{")).map(row => template(...row)).sort((a, b) => b.fixed - a.fixed);
  function fillers({ holes }, found) {
    const filled = {};
    for (const [i, { name, before }] of holes.entries()) {
      const text = found[i + 1], said = before === "`" || before === '"' ? text : find(text) ?? (before === "“" || names_and_figures.test(text) ? text : undefined);
      if (said === undefined) return null;
      filled[name] = said;
    }
    return filled;
  }
  function find(english) {
    if (whole.has(english)) return whole.get(english);
    for (const one of templates) {
      const found = one.pattern.exec(english), filled = found && fillers(one, found);
      if (filled) return one.translation.replace(/\{(\w+)\}/g, (_, name) => filled[name]);
    }
    return undefined;
  }
  return find;
}
