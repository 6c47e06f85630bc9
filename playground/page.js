// The playground's page: what its parts have to do with each other.

import { orb_player } from "../report/page/player.js";
import { Client } from "./client.js";
import { make_editor } from "./editor.js";
import { Ball } from "./page/ball.js";
import { Verdicts } from "./page/verdicts.js";
import { $, element, button, say, download, with_code } from "./page/dom.js";
import { set_up_flash } from "./page/flash.js";
import { as_workspace, load_library, mark_done, show_library, show_task } from "./page/library.js";
import { set_up_world } from "./page/world.js";
import { checked, empty, from_fragment, keep, kept, kind_of, limits, name_trouble, program_of, tests_of, to_fragment, ending_of, kinds } from "./page/workspace.js";

// One worker answers while somebody types; the other runs programs and is ended with them.
const worker_url = new URL("./worker.js", import.meta.url);
const language = new Client(worker_url), machine = new Client(worker_url);

let workspace = empty();
const nonce = "orb-editor"; // of the policy in page.html: the editor makes its style sheet itself

const player = orb_player({
  keys: $("player"),
  on_moment: places => editor?.run_line(places.find(({ name }) => name === workspace.active)?.line ?? 0),
});
let editor = null;
editor = make_editor({
  parent: $("editor"), nonce, language, say,
  files: () => workspace.files,
  on_change(name, text) {
    workspace.files[name] = text;
    keep_soon();
  },
  on_findings: (name, list) => show_findings(list),
});

let keeping = 0;
function stop_keeping() {
  clearTimeout(keeping);
  keeping = 0;
}
function keep_now() {
  stop_keeping();
  keep(workspace);
}
function keep_soon() {
  stop_keeping();
  keeping = setTimeout(keep_now, 400);
}
window.addEventListener("pagehide", () => { if (keeping) keep_now(); }); // a tab in which nothing changed leaves the others' alone

// ---- findings below the text ----
function show_findings(list) {
  const ordered = [...list].sort((a, b) => a.from - b.from);
  $("findings").replaceChildren(...ordered.slice(0, 100).map(one => {
    const [first, ...more] = one.message.split("\n");
    const item = element("li", { class: one.severity, "data-rule": one.source });
    item.append(button(`line ${one.line}`, () => editor.select(one), { class: "link" }),
      element("span", {}, element("span", { class: "severity" }, `${one.severity}: `), ...with_code(first), ...more.length ? [element("span", { class: "hint" }, " ", ...with_code(more.join(" ")))] : []));
    for (const action of one.actions) item.append(button(action.name.replaceAll("`", ""), () => editor.apply(action), { class: "fix" }));
    return item;
  }));
  const count = severity => list.filter(one => one.severity === severity).length;
  const words = [["error", count("error")], ["warning", count("warning")]].filter(([, n]) => n).map(([word, n]) => `${n} ${word}${n > 1 ? "s" : ""}`);
  $("count").textContent = words.join(", ") || "no mistakes found";
  $("count").className = count("error") ? "bad" : "";
}
/** What a run was refused for may stand in a file that is not shown. */
function show_mistakes(document) {
  const first = (document.findings ?? []).find(one => one.severity === "error") ?? document.findings?.[0];
  const name = first?.file?.replace(/^\/+/, "");
  if (!name || !Object.hasOwn(workspace.files, name)) return;
  show_view("work");
  go_to(name, first.line ?? first.range?.start?.line ?? 1);
}
function go_to(name, line) {
  if (Object.hasOwn(workspace.files, name)) show_file(name);
  show_view("work");
  editor.go_to(line);
}

// ---- files ----
function show_tabs() {
  const tabs = Object.keys(workspace.files).map(name => {
    const tab = element("button", { type: "button", role: "tab", id: `tab-${name}`, "aria-selected": String(name === workspace.active), "aria-controls": "editor",
      tabindex: name === workspace.active ? 0 : -1, title: kind_of(name).words, "data-kind": ending_of(name) }, name);
    tab.addEventListener("click", () => show_file(name));
    return tab;
  });
  $("tabs").replaceChildren(...tabs);
  $("editor").setAttribute("aria-labelledby", `tab-${workspace.active}`);
  $("drop-file").disabled = tabs.length < 2;
  $("what").textContent = `${kind_of(workspace.active).words}: ${workspace.active}`;
  show_test_button();
}
function show_test_button() {
  $("test").textContent = workspace.lesson ? "Am I done?" : "Test";
  $("test").disabled = !!ball.busy || !tests_of(workspace).length;
}
$("tabs").addEventListener("keydown", event => {
  const names = Object.keys(workspace.files), at = names.indexOf(workspace.active);
  const to = { ArrowLeft: at - 1, ArrowRight: at + 1, Home: 0, End: names.length - 1 }[event.key];
  if (names[to] === undefined) return;
  event.preventDefault();
  show_file(names[to]);
  $(`tab-${names[to]}`).focus();
});
let pictured = "";
function show_file(name) {
  workspace.active = name;
  show_tabs();
  const course = ending_of(name) === "svg";
  $("format").disabled = course;
  $("course-picture").hidden = !course;
  URL.revokeObjectURL(pictured);
  // As a picture it runs no script and fetches nothing.
  if (course) $("course-picture").src = pictured = URL.createObjectURL(new Blob([workspace.files[name]], { type: "image/svg+xml" }));
  $("course-picture").alt = course ? `the course ${name}` : "";
  editor.show(name, workspace.files[name]);
  keep_soon();
}
function open_workspace(next) {
  editor.reset();
  workspace = next;
  $("verdicts").hidden = true;
  world.show();
  show_file(workspace.active);
  show_task(workspace.lesson, { on_pick: pick, on_solution: show_solution });
}
/** Something else comes: what was there stays at hand. */
function exchange(next, words) {
  if (Object.keys(workspace.files).length) {
    keep(workspace, "before");
    $("came").firstElementChild.textContent = words;
    $("came").replaceChildren($("came").firstElementChild, button("Back to what you had", () => {
      const before = kept("before");
      if (before) exchange(before, "This is what you had.");
    }), button("Fine", () => { $("came").hidden = true; }));
    $("came").hidden = false;
  }
  open_workspace(next);
}
const pick = item => {
  ball.stop();
  exchange(checked(as_workspace(item)), `${item.readme ? "The lesson" : "The example"} “${item.title}” is open.`);
  show_view("work");
};
function show_solution({ solution, main }) {
  show_file(main);
  editor.replace(solution);
  say("One way to do it; yours may be better. Undo brings your text back.");
}

async function ask_name(title, start, then) {
  $("name-title").textContent = title;
  $("name").value = start;
  $("name-trouble").textContent = "";
  $("name-dialog").showModal();
  $("name").setSelectionRange(0, Math.max(start.lastIndexOf("."), 0));
  $("name-form").onsubmit = event => {
    if (event.submitter?.value !== "ok") return;
    const name = $("name").value.trim();
    const trouble = name_trouble(name) || (name !== start && Object.hasOwn(workspace.files, name) ? "There is such a file already." : "")
      || (Object.keys(workspace.files).length >= limits.files ? `More than ${limits.files} files are too many.` : "");
    $("name-trouble").textContent = trouble;
    if (trouble) { event.preventDefault(); $("name").focus(); } else then(name);
  };
}
$("new-file").addEventListener("click", () => ask_name("New file", "new.orb", name => {
  workspace.files[name] = kinds[ending_of(name)].start;
  world.show();
  show_file(name);
  editor.focus();
}));
$("rename-file").addEventListener("click", () => ask_name("Rename", workspace.active, name => {
  const before = workspace.active;
  if (name === before) return;
  workspace.files = Object.fromEntries(Object.entries(workspace.files).map(([one, text]) => [one === before ? name : one, text]));
  if (workspace.main === before) workspace.main = name;
  editor.forget(before);
  world.show();
  show_file(name);
}));
$("drop-file").addEventListener("click", () => {
  const name = workspace.active, text = workspace.files[name];
  delete workspace.files[name];
  editor.forget(name);
  world.show();
  show_file(Object.keys(workspace.files)[0]);
  say(`${name} was removed. `);
  $("status").append(button("Bring it back", () => { workspace.files[name] = text; show_file(name); }, { class: "link" }));
});
$("format").addEventListener("click", () => { editor.format(); editor.focus(); });

const save = () => download(workspace.active, workspace.files[workspace.active]);
$("save").addEventListener("click", save);
$("open").addEventListener("click", () => $("files-to-open").click());
async function take_files(list) {
  const files = {}, troubles = [];
  for (const file of [...list].slice(0, limits.files)) {
    const trouble = name_trouble(file.name) || (file.size > limits.text ? `It is longer than ${limits.text / 1024} KB.` : "");
    if (trouble) troubles.push(`${file.name}: ${trouble}`);
    else files[file.name] = await file.text();
  }
  const names = Object.keys(files);
  if (names.length) {
    const stays = names.every(name => !kind_of(name).program); // a test, say, comes to its program
    const next = checked({ files: stays ? { ...workspace.files, ...files } : files, active: names[0], run: stays ? workspace.run : undefined });
    if (stays) open_workspace(next);
    else exchange(next, `${names.join(", ")}: opened.`);
  }
  if (troubles.length) say(troubles.join(" "), "bad");
}
$("files-to-open").addEventListener("change", async () => { await take_files($("files-to-open").files); $("files-to-open").value = ""; });
document.addEventListener("dragover", event => { if (event.dataTransfer?.types.includes("Files")) event.preventDefault(); });
document.addEventListener("drop", event => {
  if (!event.dataTransfer?.files.length) return;
  event.preventDefault();
  take_files(event.dataTransfer.files);
});

// ---- sharing ----
$("share").addEventListener("click", async () => {
  try {
    const link = `${location.origin === "null" ? "file://" : location.origin}${location.pathname}#${await to_fragment(workspace)}`;
    $("share-link").value = link;
    $("share-dialog").showModal();
    $("share-link").select();
  } catch {
    say("That is too much for an address; save the files instead.", "bad");
  }
});
$("share-copy").addEventListener("click", async () => {
  $("share-link").select();
  try { await navigator.clipboard.writeText($("share-link").value); } catch { document.execCommand("copy"); }
  $("share-copy").textContent = "Copied";
  setTimeout(() => { $("share-copy").textContent = "Copy"; }, 1500);
});
/** Takes what the address holds, and then takes it off the address: what is written from now on is not in it. */
async function take_address() {
  const { hash } = location;
  if (hash.startsWith("#lesson=") || hash.startsWith("#example=")) {
    const id = decodeURIComponent(hash.slice(hash.indexOf("=") + 1));
    const all = (await load_library()).flatMap(group => group.items);
    const item = all.find(one => one.id === id) ?? all.find(one => one.main === id) ?? all.find(one => Object.hasOwn(one.files, id));
    if (!item) throw new Error("no such example");
    return { next: checked(as_workspace(item)), words: `“${item.title}” is open.` };
  }
  const next = await from_fragment(hash);
  return next && { next, words: "A shared program is open." };
}
async function open_address() {
  try {
    const taken = await take_address();
    if (!taken) return false;
    history.replaceState(null, "", location.pathname + location.search);
    exchange(taken.next, taken.words);
    return true;
  } catch {
    say("The address is damaged: there is no program in it that can be read.", "bad");
    return false;
  }
}
window.addEventListener("hashchange", open_address);

// ---- the ball, tests, flashing ----
const ball = new Ball({ machine, player, workspace: () => workspace, on_mistakes: show_mistakes, on_begin: () => { show_view("play"); show_program(); }, on_busy: show_test_button });
const verdicts = new Verdicts({ machine, ball, workspace: () => workspace, on_place: go_to,
  on_passed: () => { if (workspace.lesson) mark_done(workspace.lesson); } });
const world = set_up_world({ workspace: () => workspace, keep: keep_soon });
set_up_flash({ machine, workspace: () => workspace, on_mistakes: show_mistakes });

/** A run shows its lines in the text of the program, so that one is shown. */
function show_program() {
  const program = program_of(workspace, workspace.active);
  if (program && program !== workspace.active && !kind_of(workspace.active).program) show_file(program);
}
function test() {
  const beside = `${program_of(workspace, workspace.active).replace(/\.\w+$/, "")}.test`;
  const all = tests_of(workspace);
  show_view("play");
  verdicts.run(ending_of(workspace.active) === "test" ? [workspace.active] : all.includes(beside) ? [beside] : all);
}
const start = () => ball.start(), instant = () => ball.instant(), stop = () => ball.stop();
for (const [id, deed] of Object.entries({ run: start, instant, test, stop })) $(id).addEventListener("click", deed);
$("pick").addEventListener("click", () => show_library(pick));
$("task-fold").addEventListener("click", () => {
  const hidden = $("task").classList.toggle("folded");
  $("task-fold").setAttribute("aria-expanded", String(!hidden));
  $("task-fold").textContent = hidden ? "Show" : "Hide";
});

// ---- a narrow page shows one of both ----
function show_view(view) {
  $("bench").dataset.view = view;
  for (const one of $("views").children) one.setAttribute("aria-pressed", String(one.dataset.view === view));
}
for (const one of $("views").children) one.addEventListener("click", () => show_view(one.dataset.view));

document.addEventListener("keydown", event => {
  if (!(event.ctrlKey || event.metaKey) || document.querySelector("dialog[open]")) return;
  const key = event.key.toLowerCase();
  const deed = key === "enter" ? (event.shiftKey ? instant : start) : key === "s" && !event.shiftKey ? save
    : event.altKey && event.code === "KeyT" ? test : event.altKey && event.code === "KeyX" ? stop : null;
  if (!deed) return;
  event.preventDefault();
  deed();
}, { capture: true });

// ---- begin ----
const welcome = `' Welcome! Press Run, then change something and run it again.
const side = 90

for turn = 0 to 3
  RGB 60 * turn, 120, 255 - 60 * turn
  goroll turn * 90, 80, 1
  delay 1s
next turn
goroll 0, 0, 0
print "back at " xpos "," ypos
`;
async function begin() {
  workspace = kept() ?? empty();
  if (!await open_address()) {
    open_workspace(Object.keys(workspace.files).length ? workspace : checked({ files: { "welcome.orb": welcome }, active: "welcome.orb" }));
    stop_keeping(); // nothing was written in it yet, but perhaps in another tab
  }
  await machine.ready;
  document.documentElement.dataset.ready = Math.round(performance.now()); // for whoever measures
}
begin();
if ("serviceWorker" in navigator && location.protocol.startsWith("http")) navigator.serviceWorker.register("sw.js").catch(() => {});
