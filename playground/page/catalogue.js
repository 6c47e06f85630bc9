// How texts are said in another language, by the same files as base/catalogue.h. What the engine says is looked up by what it is
// made of; a text that the page puts together is found by its key, and the holes by what stands in them.

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

const fill = (translation, filled) => translation.replace(/\{(\w+)\}/g, (_, name) => filled[name]);

/** `texts`: English keys and their translations, those of findings and those of the page; `made_of`: what sentences of the engine are
 *  made of. The answer says a text in that language, and is undefined where it cannot. */
export function make_catalogue({ findings = {}, page = {} }, made_of = new Map()) {
  const whole = new Map(Object.entries({ ...findings, ...page }));
  const templates = Object.entries(page).filter(([english]) => english.includes("{")).map(row => template(...row)).sort((a, b) => b.fixed - a.fixed);
  function fillers({ holes }, found) {
    const filled = {};
    for (const [i, { name, before }] of holes.entries()) {
      const text = found[i + 1], said = before === "`" || before === '"' ? text : find(text) ?? (before === "“" || names_and_figures.test(text) ? text : undefined);
      if (said === undefined) return null;
      filled[name] = said;
    }
    return filled;
  }
  const put_together = ([english, ...fillers], text, say) => {
    const names = [...new Set(Array.from(english.matchAll(/\{(\w+)\}/g), ([, name]) => name))];
    return fill(text, Object.fromEntries(names.map((name, i) => [name, say(fillers[i])])));
  };
  const is_known = parts => typeof parts === "string" || whole.has(parts[0]) && parts.slice(1).every(is_known);
  const say = parts => typeof parts === "string" ? parts : put_together(parts, whole.get(parts[0]), say);
  function find(english) {
    if (whole.has(english)) return whole.get(english);
    const parts = made_of.get(english);
    if (parts) return is_known(parts) ? say(parts) : undefined;
    for (const one of templates) {
      const found = one.pattern.exec(english), filled = found && fillers(one, found);
      if (filled) return fill(one.translation, filled);
    }
    return undefined;
  }
  return find;
}
