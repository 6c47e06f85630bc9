// The user's files: what they may be, and how they are saved and shared.

/**
 * `text`: characters in a file; `shared`: bytes of a program in an address, `link`: those bytes packed, `task`:
 * characters in a lesson's task.
 */
export const limits = { text: 256 * 1024, files: 24, shared: 1024 * 1024, link: 200 * 1024, task: 10_000 };
const thousands = number => number.toLocaleString("en");
export const limit_words = {
  text: `A file can have at most ${thousands(limits.text)} characters`,
  files: `A program can have at most ${limits.files} files`,
};

/** The meaning of each file extension; `start` is the text of a new file. */
export const kinds = {
  __proto__: null, // no inherited keys
  orb: { words: "structured program", program: true, start: "' What does it do?\n\n" },
  bas: { words: "orbBasic program", program: true, start: "10 print \"hello\"\n" },
  macro: { words: "macro", program: true, start: "rgb 0, 255, 0\ndelay 1s\n" },
  js: { words: "JavaScript program", program: true, start: "async function startProgram() {\n  \n}\n" },
  test: { words: "test", start: "test \"does what it should\"\n  expect end within 10s\n" },
  stimulus: { words: "stimulus script", start: "at 2s shake\n" },
  svg: { words: "course", start: `<svg xmlns="http://www.w3.org/2000/svg" width="200cm" height="200cm" viewBox="0 0 200 200">
  <style>.wall { fill: none; stroke: #14212b; stroke-width: 2 } .start { fill: none; stroke: #15803d }</style>
  <path class="wall" d="M10 10H190V190H10Z"/>
  <circle class="start" cx="100" cy="160" r="4"/>
</svg>
` },
};
export const kind_of = name => kinds[ending_of(name)] ?? null;
export const ending_of = name => name.split(".").pop();
const stem_of = name => name.slice(0, name.lastIndexOf("."));

/** Why a name is not allowed for a file; "" if it is. */
export function name_trouble(name) {
  if (!/^[A-Za-z0-9][A-Za-z0-9 _.-]*$/.test(name)) return "A name can contain only letters, digits, - and _.";
  if (name.length > 60) return "That name is too long.";
  if (!kind_of(name) || !stem_of(name)) return `A name must end in ${Object.keys(kinds).map(kind => "." + kind).join(", ")}.`;
  return "";
}

/** Files and run options as plain data, ready to save and share. */
export const empty = () => ({ files: {}, active: "", main: "", run: { stimuli: [], course: "", input: "", seed: 1, for: "60s" }, lesson: "", task: "", draft: "", name: "", document: "", title: "", before: "" });

/** Validates a workspace from untrusted data: drops what does not fit. */
export function checked(data) {
  const made = empty();
  const names = typeof data?.files === "object" && data.files ? Object.keys(data.files) : [];
  for (const name of names.slice(0, limits.files)) {
    const text = data.files[name];
    if (!name_trouble(name) && typeof text === "string" && text.length <= limits.text) made.files[name] = text;
  }
  const known = name => typeof name === "string" && Object.hasOwn(made.files, name) ? name : "";
  const first = Object.keys(made.files)[0];
  if (!first) return null;
  made.active = known(data.active) || first;
  made.main = known(data.main);
  const run = data.run ?? {};
  if (Array.isArray(run.stimuli)) made.run.stimuli = run.stimuli.filter(line => typeof line === "string" && line.length < 200).slice(0, 50);
  made.run.course = known(run.course);
  made.run.input = Array.isArray(run.input) ? run.input.filter(Number.isFinite).join(", ") : typeof run.input === "string" ? run.input.slice(0, 500) : "";
  if (Number.isInteger(run.seed)) made.run.seed = run.seed;
  if (/^\d{1,4}(ms|s|min)$/.test(run.for)) made.run.for = run.for;
  if (/^[a-z0-9+]{1,9}$/.test(run.robot)) made.run.robot = run.robot; // of JavaScript programs
  for (const key of ["lesson", "name", "document", "title", "before"])
    if (typeof data[key] === "string") made[key] = data[key].slice(0, 80);
  for (const key of ["task", "draft"]) if (typeof data[key] === "string") made[key] = data[key].slice(0, limits.task);
  return made;
}

export const same_files = (one, other) =>
  Object.keys(one).length === Object.keys(other).length && Object.entries(one).every(([name, text]) => other[name] === text);

/** The first error in a document of `check`: `{name, line, message}`; undefined if there is none. */
export function first_error({ diagnostics }) {
  const first = diagnostics.find(one => one.severity === "error");
  return first && { name: first.file.replace(/^\/+/, ""), line: first.line, message: first.message };
}

/** The program that a file belongs to: itself, or for a test the one next to it. */
export function program_of({ files, main }, name) {
  if (kind_of(name)?.program) return name;
  const beside = ["orb", "bas", "macro", "js"].map(ending => `${stem_of(name)}.${ending}`);
  return beside.find(one => Object.hasOwn(files, one)) ?? (main || (Object.keys(files).find(one => kind_of(one).program) ?? ""));
}
export const tests_of = ({ files }) => Object.keys(files).filter(name => ending_of(name) === "test");

// ---- saved in this browser ----
const store = { now: "orb-playground", before: "orb-playground-before" };
// Each tab has its own; a new tab starts with the latest.
const places = ["sessionStorage", "localStorage"];
export function keep(workspace, where = "now") {
  for (const place of places)
    try { window[place].setItem(store[where], JSON.stringify(workspace)); } catch { /* full or not allowed; store.js reports it */ }
}
export function kept(where = "now") {
  for (const place of places)
    try {
      const found = checked(JSON.parse(window[place].getItem(store[where])));
      if (found) return found;
    } catch { /* nothing there, or not ours */ }
  return null;
}

// ---- shared in an address ----
const to_base64url = bytes => {
  let text = "";
  for (let i = 0; i < bytes.length; i += 0x8000) text += String.fromCharCode(...bytes.subarray(i, i + 0x8000));
  return btoa(text).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
};
const from_base64url = text => Uint8Array.from(atob(text.replaceAll("-", "+").replaceAll("_", "/")), char => char.charCodeAt(0));

/** Reads all of `stream`; fails beyond `most` bytes. */
async function read_all(stream, most) {
  const pieces = [];
  let size = 0;
  for (const reader = stream.getReader(); ;) {
    const { done, value } = await reader.read();
    if (done) break;
    size += value.length;
    if (size > most) throw new RangeError("too long");
    pieces.push(value);
  }
  return new Uint8Array(await new Blob(pieces).arrayBuffer());
}
const through = (bytes, transform) => new Blob([bytes]).stream().pipeThrough(transform);

/** A message for people: why an address cannot be made or opened. */
export class AddressError extends Error {}
const packs = () => {
  if (typeof CompressionStream === "undefined")
    throw new AddressError("This browser is too old to put a program into a link (it dates from before 2023). Save the files, or use another browser.");
};

/** The fragment of an address that contains a workspace. */
export async function to_fragment(workspace) {
  const { files, main, run, lesson, task, name } = workspace;
  // A lesson, and work handed in, opens with the program, whatever was shown last.
  const active = (lesson || task || name) && program_of(workspace, workspace.active) || workspace.active;
  const bytes = new TextEncoder().encode(JSON.stringify({ files, active, main, run, lesson: lesson || undefined, task: task || undefined, name: name || undefined }));
  packs();
  if (bytes.length > limits.shared) throw new AddressError("That is too much for an address; save the files instead.");
  return "p=" + to_base64url(await read_all(through(bytes, new CompressionStream("deflate-raw")), limits.link).catch(() => {
    throw new AddressError("That is too much for an address; save the files instead.");
  }));
}
/**
 * The workspace in an address, null if there is none, with the number of files and of those that did not fit.
 * Throws if it is broken or too long.
 */
export async function from_fragment(fragment) {
  const found = /^#p=([\w-]+)$/.exec(fragment);
  if (!found) throw new AddressError("The address is damaged: part of it is missing, or something was added. Ask for it again.");
  packs();
  const bytes = await read_all(through(from_base64url(found[1]), new DecompressionStream("deflate-raw")), limits.shared);
  const { files, active, main, run, lesson, task, name } = JSON.parse(new TextDecoder("utf-8", { fatal: true }).decode(bytes));
  const workspace = checked({ files, active, main, run, lesson, task, name }), all = Object.keys(files ?? {}).length;
  return { workspace, all, left_out: all - Object.keys(workspace?.files ?? {}).length };
}
