// Writes the examples and lessons of the repository: examples.json has what the cards show, with the path of each program;
// examples/ID.json has all files that one opens with, in one folder.
// usage: node playground/examples.mjs ROOT FOLDER ENGINE, the last a folder with the engine as a package
import { existsSync, mkdirSync, readdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { flat, for_page, job_in } from "./task.mjs";

const [root, out, engine_folder] = process.argv.slice(2);
const { load_engine } = await import(pathToFileURL(resolve(engine_folder, "engine.js")));
const engine = await load_engine();
const folder = join(root, "examples");
const shelves = readdirSync(folder, { withFileTypes: true }).filter(entry => entry.isDirectory() && !["demo", "lessons", "library", "python"].includes(entry.name));
/** The path of each file on the shelves; names are unique. */
const places = Object.fromEntries(shelves.flatMap(({ name: shelf }) => readdirSync(join(folder, shelf)).map(name => [name, join(folder, shelf, name)])));
const read = path => readFileSync(path, "utf8");
const stem = name => name.replace(/\.\w+$/, "");
const ending = name => name.slice(name.lastIndexOf(".") + 1);
const is_comment = line => /^\s*['#;]/.test(line);

/** The example files that a text names outside of its comments. */
const named_in = text => text.split("\n").filter(line => !is_comment(line))
  .flatMap(line => line.match(/[\w-]+\.(?:macro|orb|bas|svg|stimulus)\b/g) ?? [])
  .filter(name => name in places);

/** Adds a file and everything it names, recursively. */
function gather(files, name, text) {
  files[name] = flat(text);
  for (const other of named_in(text))
    if (!(other in files)) gather(files, other, read(places[other]));
}

/** The options of the first command in a text that runs something: the first lines of a program, or a task. */
function run_of(text, main) {
  const words = (text.match(/orb run (.*)/)?.[1].match(/"[^"]*"|'[^']*'|\S+/g) ?? [])
    .map(word => word.replace(/^(["'])(.*)\1$/, "$2").replace(/^(examples|\.\.\/\.\.)\/(\w+\/)?/, ""));
  const value = option => words.includes(option) ? words[words.indexOf(option) + 1] : undefined;
  const options = {
    stimuli: value("--stimulus") && [value("--stimulus")],
    course: value("--course"),
    input: value("--input")?.split(",").map(Number),
    seed: value("--seed") && Number(value("--seed")),
    for: value("--for"),
  };
  const first_option = words.findIndex(word => word.startsWith("--"));
  const names = words.slice(0, first_option < 0 ? undefined : first_option);
  if (names.length > 1) options.names = [main, ...names.slice(1)];
  return JSON.parse(JSON.stringify(options));
}

function example(name) {
  const text = read(places[name]);
  const [, title, summary] = text.split("\n")[0].match(/^\s*['#;]\s*(?:([^:.]{1,40}):\s*)?(.*)$/);
  const run = run_of(text, name);
  const files = {};
  gather(files, name, text);
  for (const other of [...run.stimuli ?? [], ...run.course ? [run.course] : [], ...run.names ?? []])
    if (!(other in files)) gather(files, other, read(places[other]));
  const test = `${stem(name)}.test`;
  const tested = test in places ? read(places[test]) : null;
  const program = tested?.match(/^program (.*)$/m)?.[1];
  // A test of a macro named like the program would otherwise match.
  const is_tested = tested !== null && (program ? program === name : ending(name) !== "macro");
  if (is_tested) gather(files, test, tested);
  return {
    id: name, title: title ?? stem(name)[0].toUpperCase() + stem(name).slice(1), summary: summary.replace(/[,.]$/, ""),
    language: ending(name), files, main: name, ...is_tested && { test }, run, ...drawing({ files, run }, name),
  };
}

/** The path as a drawing of 120 by 72: [colour, d] of each stretch; and the last colour of the LED. */
function drawing({ files, run }, main, text = files[main]) {
  const { report } = engine.call("run", { files: { ...files, [main]: text }, ...run, names: run.names ?? [main], for: run.for ?? "60s", report: true });
  const { pose, led } = report, sums = list => { let sum = 0; return list.map(step => sum += step); };
  const t = sums(pose.t), x = sums(pose.x), y = sums(pose.y), changes = sums(led.t);
  const hex = rgb => rgb ? `#${rgb.toString(16).padStart(6, "0")}` : "";
  const color = hex([...led.rgb].reverse().find(Boolean) ?? 0);
  const [left, right, low, high] = [Math.min(...x), Math.max(...x), Math.min(...y), Math.max(...y)];
  const scale = Math.min(108 / (right - left), 60 / (high - low));
  if (!t.length || right - left + high - low < 20_000) return { color };
  const at = i => `${Math.round(60 + (x[i] - (left + right) / 2) * scale)} ${Math.round(36 - (y[i] - (low + high) / 2) * scale)}`;
  const path = [];
  for (let i = 0; i < t.length; ++i) {
    const lit = hex(led.rgb[changes.findLastIndex(change => change <= t[i])] ?? 0), open = path.at(-1), here = at(i);
    if (!open || open[0] !== lit && path.length < 5) path.push([lit, `M${open?.last ?? here}L${here}`]);
    else if (open.last !== here) open[1] += ` ${here}`;
    path.at(-1).last = here;
  }
  const moves = ([, d]) => new Set(d.slice(1).split("L")).size > 1; // a change of colour at a stop draws nothing
  return { path: path.map(([stroke, d]) => [stroke, straightened(d)]).filter(moves) };
}
/** Drops points within two units of the line between the remaining ones (Ramer, Douglas and Peucker). */
function straightened(d) {
  const numbers = d.slice(1).split(/[L ]/).map(Number), points = [];
  for (let i = 0; i < numbers.length; i += 2) points.push([numbers[i], numbers[i + 1]]);
  const off = ([x, y], [ax, ay], [bx, by]) => {
    const length = Math.hypot(bx - ax, by - ay);
    return length ? Math.abs((bx - ax) * (y - ay) - (by - ay) * (x - ax)) / length : Math.hypot(x - ax, y - ay);
  };
  const thin = list => {
    const [first, last] = [list[0], list.at(-1)];
    const far = list.map(point => off(point, first, last)), most = Math.max(...far), at = far.indexOf(most);
    return most <= 2 ? [first, last] : [...thin(list.slice(0, at + 1)).slice(0, -1), ...thin(list.slice(at))];
  };
  return `M${thin(points).map(point => point.join(" ")).join("L")}`;
}

function lesson(name) {
  const place = join(folder, "lessons", name);
  const readme = read(join(place, "README.md"));
  const files = {};
  gather(files, "robot.orb", read(join(place, "robot.orb")));
  gather(files, "robot.test", read(join(place, "robot.test")));
  const run = run_of(readme, "robot.orb"), solution = read(join(place, "solution.orb"));
  return {
    id: `lessons/${name}`, title: readme.match(/^# \d+\. (.*)$/m)[1], language: "orb", readme: for_page(readme),
    solution, files, main: "robot.orb", test: "robot.test", run, ...drawing({ files, run }, "robot.orb", solution),
  };
}

/** The same job as a Sphero Edu program. */
function twin({ id, path, color }) {
  const place = join(folder, id, "edu"), readme = read(join(place, "README.md"));
  return {
    id: `${id}/edu`, title: readme.match(/^# \d+\. (.*)$/m)[1], language: "js", readme: for_page(readme), main: "robot.js",
    files: { "robot.js": read(join(place, "robot.js")), "robot.test": flat(read(join(folder, id, "robot.test"))) }, run: {}, path, color, task: for_page(readme).replace(/^# \d+\. /, "# "),
  };
}

const order = ["orb", "bas", "macro"];
const examples = Object.keys(places).filter(name => order.includes(ending(name)) && name !== "orchestra.macro")
  .sort((a, b) => stem(a).localeCompare(stem(b)) || order.indexOf(ending(a)) - order.indexOf(ending(b))).map(example);
const lessons = readdirSync(join(folder, "lessons")).filter(name => /^\d/.test(name)).sort().map(lesson);
const twins = lessons.filter(({ id }) => existsSync(join(folder, id, "edu"))).map(twin);

/** Writes what an item opens with; returns what the page knows before. `names`: other files, which an address may name. */
function parted({ id, title, summary, language, path, color, readme, ...others }) {
  // A twin has its own task, like a teacher's lesson.
  const file = join(out, "examples", `${id}.json`), whole = others.task ? others : { ...others, readme };
  mkdirSync(dirname(file), { recursive: true });
  writeFileSync(file, JSON.stringify(whole));
  const { main, files } = whole;
  return { id, title, summary, job: job_in(readme), language, main, names: Object.keys(files).filter(name => name !== main), path, color };
}
writeFileSync(join(out, "examples.json"), JSON.stringify({ groups: [{ title: "Lessons", items: lessons.map(parted) }, { title: "Lessons in JavaScript", items: twins.map(parted) }, { title: "Examples", items: examples.map(parted) }] }));
