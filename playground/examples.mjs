// Writes examples.json: the examples and lessons of the repository, each with all files that it needs in one
// folder. usage: node playground/examples.mjs ROOT FILE
import { readdirSync, readFileSync, existsSync, writeFileSync } from "node:fs";
import { join } from "node:path";

const [root, out] = process.argv.slice(2);
const folder = join(root, "examples");
const read = path => readFileSync(path, "utf8");
const stem = name => name.replace(/\.\w+$/, "");
const ending = name => name.slice(name.lastIndexOf(".") + 1);
const is_comment = line => /^\s*['#;]/.test(line);

/** The example files that a text names outside of its comments. */
const named_in = text => text.split("\n").filter(line => !is_comment(line))
  .flatMap(line => line.match(/[\w-]+\.(?:macro|orb|bas|svg|stimulus)\b/g) ?? [])
  .filter(name => existsSync(join(folder, name)));

/** In one folder nothing is further up. */
const flat = text => text.replaceAll("../../", "");

/** A file and what it names, and what that names. */
function gather(files, name, text) {
  files[name] = flat(text);
  for (const other of named_in(text))
    if (!(other in files)) gather(files, other, read(join(folder, other)));
}

/** The options of the command that stands in the first lines of a program. */
function run_of(text, main) {
  const words = (text.match(/orb run (.*)/)?.[1] ?? "").trim().split(/\s+/).map(word => word.replace(/^examples\//, ""));
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
  const text = read(join(folder, name));
  const [, title, summary] = text.split("\n")[0].match(/^\s*['#;]\s*(?:([^:.]{1,40}):\s*)?(.*)$/);
  const run = run_of(text, name);
  const files = {};
  gather(files, name, text);
  for (const other of [...run.stimuli ?? [], ...run.course ? [run.course] : [], ...run.names ?? []])
    if (!(other in files)) gather(files, other, read(join(folder, other)));
  const test = `${stem(name)}.test`;
  const tested = existsSync(join(folder, test)) ? read(join(folder, test)) : null;
  const program = tested?.match(/^program (.*)$/m)?.[1];
  // A test of a macro with the name of a program would take the program.
  const is_tested = tested !== null && (program ? program === name : ending(name) !== "macro");
  if (is_tested) gather(files, test, tested);
  return {
    id: name, title: title ?? stem(name)[0].toUpperCase() + stem(name).slice(1), summary: summary.replace(/[,.]$/, ""),
    language: ending(name), files, main: name, ...is_tested && { test }, run,
  };
}

function lesson(name) {
  const place = join(folder, "lessons", name);
  const readme = read(join(place, "README.md"));
  const files = {};
  gather(files, "robot.orb", read(join(place, "robot.orb")));
  gather(files, "robot.test", read(join(place, "robot.test")));
  const course = Object.keys(files).find(file => ending(file) === "svg");
  return {
    id: `lessons/${name}`, title: readme.match(/^# \d+\. (.*)$/m)[1], language: "orb", readme,
    solution: read(join(place, "solution.orb")), files, main: "robot.orb", test: "robot.test", run: course ? { course } : {},
  };
}

const order = ["orb", "bas", "macro"];
const examples = readdirSync(folder).filter(name => order.includes(ending(name)) && name !== "orchestra.macro")
  .sort((a, b) => stem(a).localeCompare(stem(b)) || order.indexOf(ending(a)) - order.indexOf(ending(b))).map(example);
const lessons = readdirSync(join(folder, "lessons")).filter(name => /^\d/.test(name)).sort().map(lesson);
writeFileSync(out, JSON.stringify({ groups: [{ title: "Lessons", items: lessons }, { title: "Examples", items: examples }] }));
