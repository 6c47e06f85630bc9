// The playground's page: connects its parts.

import { shape } from "../report/page/dom.js";
import { on_draw, redraw } from "../report/page/map.js";
import { area } from "../report/page/map_chart.js";
import { playback, watch } from "../report/page/playback.js";
import { orb_player } from "../report/page/player.js";
import { Client } from "./client.js";
import { make_editor } from "./editor.js";
import { Ball } from "./page/ball.js";
import { addresses_in, id_of, parts_of, show_class_buttons, show_own_task } from "./page/task.js";
import { set_up_bubble } from "./page/bubble.js";
import { set_up_blocks } from "./page/blocks/toggle.js";
import { $, announce, close_dialogs, element, button, say, download, with_code, on_demand, show_trouble } from "./page/dom.js";
import { watch_engines } from "./page/engines.js";
import { speak } from "./page/language.js";
import { learn } from "./page/said.js";
import { as_workspace, first_lesson, item_named, lesson_after, load_item, mark_done, not_loaded, show_library, show_task } from "./page/library.js";
import { address_of, set_up_share } from "./page/share.js";
import { fill_sheet } from "./page/sheet.js";
import { first_steps, welcome } from "./page/steps.js";
import { Store, new_id } from "./page/store.js";
import { set_up_world } from "./page/world.js";
import { AddressError, checked, empty, first_error, from_fragment, keep, kept, kind_of, limit_words, limits, name_trouble, program_of, same_files, tests_of, ending_of, kinds } from "./page/workspace.js";

// One worker answers while somebody types; the other runs programs and is ended to stop them.
const worker_url = new URL("./worker.js", import.meta.url);
const early = globalThis.orb_workers;
const language = new Client(worker_url, early?.language), machine = new Client(worker_url, early?.machine);
for (const client of [language, machine]) client.on("said", learn);

let workspace = empty();
window.addEventListener("beforeprint", () => fill_sheet(workspace));
const nonce = "orb-editor"; // from the policy in page.html: the editor creates its style sheet

const player = orb_player({
  keys: $("player"), ball_px: 19,
  on_moment(places) {
    const line = places.find(({ name }) => name === workspace.active)?.line ?? 0;
    editor?.run_line(line);
    blocks?.run_line(line);
  },
});
const remark = set_up_bubble({ greeting: "Hi! Press Run." });
let editor = null, blocks = null;
const is_foreign = name => ending_of(name) === "js";
editor = make_editor({
  parent: $("editor"), nonce, language, say,
  files: () => workspace.files,
  foreign: name => is_foreign(name) ? kit => with_edu(edu => edu.language(kit)) : null,
  on_change(name, text) {
    workspace.files[name] = text;
    if (name === workspace.active) blocks.changed(text);
    steps.changed();
    verdicts?.changed(workspace.files);
    keep_soon();
  },
  on_findings(name, list) {
    show_findings(list);
    blocks?.findings(list);
  },
});
blocks = set_up_blocks({ nonce, language, editor, editor_pane: $("editor"), before: $("new-file"),
  active: () => ({ name: workspace.active, text: workspace.files[workspace.active] ?? "" }),
  add_file(name, text) {
    while (Object.hasOwn(workspace.files, name)) name = name.replace(/(\d*)\.orb$/, (_, n) => `${Number(n || 1) + 1}.orb`);
    workspace.files[name] = text;
    show_file(name);
  } });

const engines = watch_engines({ language, machine, on_machine_gone: words => ball.give_up(words) });

// ---- saving ----
const store = new Store(words => show_trouble("storage", words));
$("storage-seen").addEventListener("click", () => show_trouble("storage", ""));
const opened = new Map(); // documents of this page as left, even if the browser saves nothing
const version_every = 60_000; // milliseconds of writing
let keeping = 0, last_version = 0;
function stop_keeping() {
  clearTimeout(keeping);
  keeping = 0;
}
function keep_now() {
  stop_keeping();
  keep(workspace);
  const mark = Date.now() - last_version > version_every;
  if (mark) last_version = Date.now();
  store.keep(workspace, mark);
}
/** Makes the current state a version to return to. */
function mark_version() {
  if (keeping) keep_now();
  last_version = Date.now();
  return store.keep(workspace, true);
}
function keep_soon() {
  stop_keeping();
  keeping = setTimeout(keep_now, 400);
}
window.addEventListener("pagehide", () => { if (keeping) keep_now(); }); // a tab without changes must not overwrite another one's

// ---- findings below the text ----
function show_findings(list) {
  if (!list) {
    $("findings").replaceChildren();
    $("count").textContent = engines.checks() ? "checking…" : "not checked";
    $("count").className = "";
    clearTimeout(telling);
    return;
  }
  const ordered = [...list].sort((a, b) => a.from - b.from);
  $("findings").replaceChildren(...ordered.slice(0, 100).map(one => {
    const [first, ...more] = one.message.split("\n");
    const item = element("li", { class: one.severity, "data-rule": one.source });
    item.append(button(`line ${one.line}`, () => blocks.go_to(one.line) || editor.select(one), { class: "link" }),
      element("span", {}, element("span", { class: "severity" }, `${one.severity}: `), with_code(first), ...more.length ? [element("span", { class: "hint" }, " ", with_code(more.join(" ")))] : []));
    for (const action of one.actions) item.append(button(action.name.replaceAll("`", ""), () => editor.apply(action), { class: "fix" }));
    return item;
  }));
  const count = severity => list.filter(one => one.severity === severity).length;
  const words = [["error", count("error")], ["warning", count("warning")]].filter(([, n]) => n).map(([word, n]) => `${n} ${word}${n > 1 ? "s" : ""}`);
  $("count").textContent = words.join(", ") || "no mistakes found";
  $("count").className = count("error") ? "bad" : "";
  tell_count();
}
let telling = 0, told_count = "";
/** Announces findings to screen readers when typing pauses, and only changes. */
function tell_count() {
  clearTimeout(telling);
  telling = setTimeout(() => {
    const words = $("count").textContent;
    if (words !== told_count) announce(words);
    told_count = words;
  }, 1500);
}
/** Shows the error that prevents a run; it may be in a file that is not shown. */
function show_mistakes(document) {
  const first = first_error(document);
  if (first && Object.hasOwn(workspace.files, first.name)) go_to(first.name, first.line);
}
function go_to(name, line) {
  if (Object.hasOwn(workspace.files, name)) show_file(name);
  show_view("work");
  blocks.go_to(line) || editor.go_to(line);
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
  verdicts?.changed(workspace.files);
}
function show_test_button() {
  $("test").textContent = workspace.lesson || workspace.task ? "Am I done?" : "Test";
  $("test").hidden = !tests_of(workspace).length;
  $("test").setAttribute("aria-disabled", String(!!ball.busy)); // a disabled button would lose the focus
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
  $("format").disabled = course || is_foreign(name);
  $("course-picture").hidden = !course;
  URL.revokeObjectURL(pictured);
  // As an image it runs no script and loads nothing.
  if (course) $("course-picture").src = pictured = URL.createObjectURL(new Blob([workspace.files[name]], { type: "image/svg+xml" }));
  $("course-picture").alt = course ? `the course ${name}` : "";
  editor.show(name, workspace.files[name]);
  const runs_foreign = is_foreign(program_of(workspace, name));
  if (edu || runs_foreign) with_edu(edu => edu.show(runs_foreign));
  blocks.open();
  keep_soon();
}
function open_workspace(next) {
  ++picked;
  close_dialogs();
  editor.reset();
  workspace = next;
  workspace.title ||= workspace.main || program_of(workspace, workspace.active) || workspace.active;
  $("verdicts").hidden = true;
  world.show();
  $("bench").dataset.open = "";
  show_file(workspace.active);
  steps.show(workspace);
  show_task_of();
  show_came();
  ball.rest();
}
function show_task_of(stays = false) {
  if (!steps.draw_again()) show_task(workspace.lesson, { on_pick: pick, on_solution: show_solution }, stays);
  if (workspace.task && !workspace.lesson) show_own_task(workspace);
  show_class_buttons(workspace);
}
/** Offers a way back to what was open before, even after a reload. */
function show_came(words = "", more = []) {
  const whose = workspace.name ? `Handed in by “${workspace.name}”.` : ""; // stays after the rest is dismissed
  const back = workspace.before ? [button("Back to what you had", go_back)] : [], buttons = [...more, ...back];
  $("came").hidden = !whose && !buttons.length;
  $("came").replaceChildren(element("span", {}, words || whose || `This is “${workspace.title}”.`), ...buttons, ...buttons.length ? [button("OK", () => {
    workspace.before = "";
    keep_soon();
    show_came();
  })] : []);
}
/** Opens something else; the browser's Back returns to the previous document. */
function exchange(next, words, more = []) {
  const other = next.document !== workspace.document;
  change_to(next, words, more);
  // An opened address already has a history entry.
  history[other && history.state ? "pushState" : "replaceState"]({ document: next.document }, "");
}
window.addEventListener("popstate", async ({ state }) => {
  if (!state || state.document === workspace.document) return;
  const next = await document_of(state.document);
  if (history.state?.document !== state.document) return; // the user moved on meanwhile
  if (!next) say("This browser no longer has it.", "bad");
  else change_to({ ...next, before: "" }, `“${next.title}”, as you left it.`);
});
/** Opens another document and saves the previous one. */
function change_to(next, words, more = []) {
  if (workspace.document && Object.keys(workspace.files).length) {
    opened.set(workspace.document, structuredClone(workspace));
    mark_version();
    keep(workspace, "before");
    next.before = workspace.document === next.document ? workspace.before : workspace.document;
  }
  open_workspace(next);
  show_came(words, more);
}
const document_of = async id => id === workspace.document ? structuredClone(workspace) : opened.get(id) ?? await store.find(id);
async function go_back() {
  const before = await document_of(workspace.before) ?? kept("before");
  if (before) exchange({ ...before, before: "" }, `“${before.title}”, as you left it.`);
  else say("This browser no longer has it.", "bad");
}
let picked = 0;
/** Opens a lesson or an example, possibly a promised one, unless something else is opened while it loads. */
async function pick(item) {
  const mine = ++picked, whole = await Promise.resolve(item).then(load_item).catch(() => null);
  if (picked !== mine) return;
  if (whole) open_item(whole);
  else say(not_loaded, "bad");
}
const open_item = item => resume({ ...checked(as_workspace(item)), document: item.id, title: item.title },
  `${item.job ? "The lesson" : "The example"} “${item.title}”`);
/** Opens a lesson or an example, as the user left it if they have worked on it. */
async function resume(fresh, what) {
  const mine = await document_of(fresh.document);
  if (!mine || same_files(mine.files, fresh.files)) exchange(fresh, `${what} is open.`);
  else exchange({ ...mine, before: "" }, `${what}, as you left it.`, [button("Start over", () => {
    mark_version();
    exchange(fresh, `${what} from the beginning. What you had is among the earlier versions under Mine.`);
  })]);
  show_view("work");
}
function show_solution({ solution, main }) {
  mark_version();
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
    const trouble = name_trouble(name) || (name !== start && Object.hasOwn(workspace.files, name) ? "There is already a file with that name." : "")
      || (name !== start && title === "New file" && Object.keys(workspace.files).length >= limits.files ? `${limit_words.files}.` : "");
    $("name-trouble").textContent = trouble;
    if (trouble) { event.preventDefault(); $("name").focus(); } else then(name);
  };
}
$("new-file").addEventListener("click", () => ask_name("New file", "new.orb", name => {
  workspace.files[name] = kinds[ending_of(name)].start;
  world.show();
  show_file(name);
  editor.focus();
  say(new_words(name));
}));
/** What a new file is for. */
function new_words(name) {
  const kind = kind_of(name);
  return kind.program ? `${name} is a separate ${kind.words}: Run runs the program that is shown.`
    : ending_of(name) === "test" ? `${name} says what the program must do; it tests ${program_of(workspace, name) || "no program"}.`
    : `${name} is a ${kind.words}: choose it under More.`;
}
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
  for (const file of list) {
    if (file.name.endsWith(".link")) {
      const addresses = addresses_in(file.size <= 4 * limits.text ? await file.text() : "");
      if (addresses.length === 1) location.hash = addresses[0];
      else troubles.push(addresses.length ? `${file.name} contains ${addresses.length} addresses: open them one at a time.` : `${file.name} contains no address.`);
      continue;
    }
    const text = file.size <= 4 * limits.text ? await file.text() : null;
    const trouble = name_trouble(file.name) || (text === null || text.length > limits.text ? `${limit_words.text}.` : "")
      || (Object.keys(files).length >= limits.files ? `${limit_words.files}.` : "");
    if (trouble) troubles.push(`${file.name}: ${trouble}`);
    else files[file.name] = text;
  }
  const names = Object.keys(files);
  if (names.length) {
    const stays = names.every(name => !kind_of(name).program); // a test, for example, is added to its program
    const all = stays ? { ...workspace.files, ...files } : files;
    if (Object.keys(all).length > limits.files) troubles.push(`${limit_words.files}.`);
    else {
      mark_version();
      const next = checked({ ...stays ? workspace : {}, files: all, active: names[0] });
      if (stays) open_workspace(next);
      else exchange({ ...next, document: new_id() }, `Opened ${names.join(", ")}.`);
    }
  }
  if (troubles.length) say(troubles.slice(0, 3).join(" "), "bad");
}
$("files-to-open").addEventListener("change", async () => { await take_files($("files-to-open").files); $("files-to-open").value = ""; });
document.addEventListener("dragover", event => { if (event.dataTransfer?.types.includes("Files")) event.preventDefault(); });
document.addEventListener("drop", event => {
  if (!event.dataTransfer?.files.length) return;
  event.preventDefault();
  take_files(event.dataTransfer.files);
});

// ---- sharing ----
const share = set_up_share({ workspace: () => workspace });
/** Reads an address; returns a function that opens what it names. */
async function take_address(hash) {
  const named = /^#(?:lesson|example)=(.*)$/.exec(hash);
  if (named) {
    const id = decodeURIComponent(named[1]);
    const item = await item_named(id).then(found => found && load_item(found)).catch(() => { throw new AddressError(not_loaded); });
    if (!item) throw new AddressError(`The address is damaged: there is no lesson or example “${id}”.`);
    return () => open_item(item);
  }
  if (!hash.startsWith("#p=")) throw new AddressError(`The address ends in “${hash.slice(0, 30)}”, which this page does not understand.`);
  const { workspace: next, all, left_out } = await from_fragment(hash);
  if (!next) throw new AddressError("The address is damaged: it contains no program that can be read.");
  if (left_out) say(`${left_out} of the ${all} files in the address are left out: at most ${limits.files} can be open, and each needs a known ending and at most ${limits.text.toLocaleString("en")} characters.`, "bad");
  if (next.name) return () => exchange({ ...next, document: new_id(), title: `${next.name}: ${title_of(next)}` }, "");
  if (!next.task) return () => exchange({ ...next, document: new_id() }, "A shared program is open.");
  return () => resume({ ...next, document: id_of(hash), title: title_of(next) }, `The lesson “${title_of(next)}”`);
}
const title_of = ({ task, main, active }) => parts_of(task).title || main || active;
async function open_address() {
  const { hash } = location;
  if (hash.length < 2) return false;
  try {
    const open = await take_address(hash);
    history.replaceState(null, "", location.pathname + location.search);
    await open();
    return true;
  } catch (error) {
    say(error instanceof AddressError ? error.message : "The address is damaged: it contains no program that can be read.", "bad");
    return false;
  }
}
window.addEventListener("hashchange", open_address);

// ---- the ball, tests, flashing ----
const steps = first_steps({ on_next: () => pick(first_lesson()), point_at: pattern => editor.point_at(pattern) });
let edu = null;
const with_edu = on_demand(async () => edu = await (await import("./page/edu/edu.js")).set_up_edu({ machine, ball, workspace: () => workspace, keep: keep_soon, sounds: () => is_loud ? with_sounds : null }));
const ball = new Ball({ machine, player, workspace: () => workspace, remark, on_mistakes: show_mistakes, on_place: go_to, on_busy: show_test_button,
  foreign: name => is_foreign(name) ? with_edu : null,
  on_begin() {
    mark_version();
    show_view("play");
    show_program();
    steps.ran();
    if (is_loud) with_sounds(sounds => sounds.switch_on(true)); // browsers allow it only in a click
  } });
const judge = asked => Object.keys(asked.files).some(is_foreign) ? with_edu(edu => edu.test(asked)) : machine.call("test", { ...asked, format: "json" });
let verdicts = null;
const with_verdicts = on_demand(async () => verdicts = new (await import("./page/verdicts.js")).Verdicts({ machine, judge, ball, map: { area, on_draw, redraw, shape }, workspace: () => workspace, on_place: go_to, on_hand_in: () => hand_in(),
  on_passed() {
    if (is_loud) with_sounds(sounds => sounds.cheer());
    if (!workspace.lesson || workspace.name) return workspace.task ? undefined : null;
    mark_done(workspace.lesson);
    show_task_of(true);
    const next = lesson_after(workspace.lesson);
    return next && (() => pick(next));
  } }));
const with_class = on_demand(async () => (await import("./page/class.js")).set_up_class({
  judge, workspace: () => workspace, share, address_of, keep: keep_soon,
  mistakes: (tested, files) => with_verdicts(verdicts => verdicts.mistakes(tested, files)),
  write_file(name, text) {
    workspace.files[name] = text;
    editor.forget(name);
    keep_soon();
  },
  on_change() {
    if (workspace.task && !workspace.name) workspace.title = title_of(workspace);
    if (!workspace.document) {
      workspace.document = new_id();
      history.replaceState({ document: workspace.document }, "");
    }
    show_file(workspace.active);
    show_task_of();
  },
}));
const hand_in = () => with_class(parts => parts.hand_in());
$("hand-in").addEventListener("click", hand_in);
for (const id of ["lesson-write", "task-edit", "share-lesson"]) $(id).addEventListener("click", () => with_class(parts => parts.write()));
const with_mine = on_demand(async () => (await import("./page/mine.js")).set_up_mine({ store, workspace: () => workspace, on_open: (next, words) => { exchange(next, words); show_view("work"); },
  begin: () => ({ ...checked({ files: { "program.orb": welcome }, active: "program.orb" }), document: new_id() }) }));
const world = set_up_world({ workspace: () => workspace, keep: keep_soon });
const with_robots = on_demand(async () => (await import("./page/flash.js")).set_up_flash({ machine, workspace: () => workspace, ball, on_mistakes: show_mistakes }));
$("flash").addEventListener("click", () => with_robots(robots => robots.open()));

/** A run marks lines in the program's text, so show that file. */
function show_program() {
  const program = program_of(workspace, workspace.active);
  if (program && program !== workspace.active && !kind_of(workspace.active).program) show_file(program);
}
function test() {
  const beside = `${program_of(workspace, workspace.active).replace(/\.\w+$/, "")}.test`;
  const all = tests_of(workspace);
  if (ball.busy) return;
  mark_version();
  show_view("play");
  const names = ending_of(workspace.active) === "test" ? [workspace.active] : all.includes(beside) ? [beside] : all;
  with_verdicts(verdicts => verdicts.run(names));
}
const start = () => ball.busy ? ball.stop() : ball.start(), instant = () => ball.instant(), stop = () => ball.stop();
for (const [id, deed] of Object.entries({ run: start, instant, test })) $(id).addEventListener("click", deed);
$("pick").addEventListener("click", () => show_library(pick));
$("mine").addEventListener("click", () => { mark_version().then(() => with_mine(mine => mine.show())); });
$("task-fold").addEventListener("click", () => {
  const hidden = $("task").classList.toggle("folded");
  $("task-fold").setAttribute("aria-expanded", String(!hidden));
  $("task-fold").textContent = hidden ? "Show" : "Hide";
});

// ---- menus: choosing an entry, or clicking outside, closes them ----
$("print").addEventListener("click", () => window.print());
for (const menu of document.querySelectorAll("details.more")) {
  document.addEventListener("click", ({ target }) => {
    if (!menu.contains(target) || target.closest(".more-list") && !target.closest("#theme, #sound, .language")) menu.open = false;
  });
  menu.addEventListener("keydown", event => {
    if (event.key !== "Escape" || !menu.open) return;
    menu.open = false;
    menu.firstElementChild.focus();
  });
}

// ---- sounds, off unless switched on ----
const sound_key = "orb-sound";
let is_loud = false;
try { is_loud = localStorage.getItem(sound_key) === "on"; } catch { /* no storage */ }
const with_sounds = on_demand(async () => (await import("./page/sound.js")).make_sounds({ playback, watch }));
function show_sound() {
  $("sound").textContent = is_loud ? "Sounds: on" : "Sounds: off";
  $("sound").setAttribute("aria-pressed", String(is_loud));
}
$("sound").addEventListener("click", () => {
  is_loud = !is_loud;
  try { localStorage.setItem(sound_key, is_loud ? "on" : "off"); } catch { /* for this visit only */ }
  show_sound();
  const wanted = is_loud;
  with_sounds(sounds => sounds.switch_on(wanted));
});
show_sound();

// ---- a narrow page shows one view at a time ----
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
async function begin() {
  await speak({ on_change() {
    editor.say_anew();
    blocks.say_anew();
    world.show();
    show_task_of();
  } });
  const found = kept();
  if (found) workspace = { ...found, document: found.document || new_id() };
  if (!await open_address()) {
    open_workspace(found ? workspace : { ...checked({ files: { "welcome.orb": welcome }, active: "welcome.orb" }), document: "welcome", title: "First steps" });
    stop_keeping(); // nothing was changed in this tab, but perhaps in another
    history.replaceState({ document: workspace.document }, "");
  }
}
const begun = begin();
// For measurements.
machine.on("ready", () => begun.then(() => { document.documentElement.dataset.ready ??= Math.round(performance.now()); }));

// ---- without a network ----
const rests_after = 8000; // milliseconds after the service worker is ready
async function keep_page() {
  await navigator.serviceWorker.register("sw.js");
  const { active } = await navigator.serviceWorker.ready;
  await new Promise(done => setTimeout(done, rests_after));
  active.postMessage({ loaded: performance.getEntriesByType("resource").map(({ name }) => name), all: !navigator.connection?.saveData });
}
if ("serviceWorker" in navigator && location.protocol.startsWith("http")) keep_page().catch(() => {});
