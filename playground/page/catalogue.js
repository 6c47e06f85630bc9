// Translates texts, using the same files as base/catalogue.h. Sentences of the engine are looked up by their parts; a
// text composed by the page is matched against keys with holes.

/** Names and figures, which are the same in every language: `heading`, `90 ms`, `red, green, blue`. */
const names_and_figures = /^(?:(?:[-\d.]+|\S*,) )*\S+$/;
/**
 * What may fill a hole after that character. Between backticks: code, unchanged; between "": printed text; between
 * “”: a catalogue text or user text; elsewhere: a catalogue text, or names and figures.
 */
const quoted = { "`": "([^`]+)", '"': '([^"]+)', "“": "([^“”]+)" };
const literal = text => text.replace(/[\\^$.*+?()[\]{}|]/g, "\\$&");

function template(english, translation) {
  const pieces = english.split(/\{(\w+)\}/); // fixed text, name, fixed text …
  const holes = pieces.flatMap((name, i) => i % 2 ? [{ name, before: pieces[i - 1].at(-1) }] : []);
  const pattern = pieces.map((piece, i) => i % 2 ? quoted[pieces[i - 1].at(-1)] ?? "(.+?)" : literal(piece)).join("");
  return { pattern: new RegExp(`^${pattern}$`, "s"), holes, translation, fixed: english.replace(/\{\w+\}/g, "").length };
}

const fill = (translation, filled) => translation.replace(/\{(\w+)\}/g, (_, name) => filled[name]);

/**
 * `texts`: English keys and translations, of findings and of the page; `made_of`: the parts of the engine's
 * sentences. The result translates a text, and returns undefined if it cannot.
 */
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
