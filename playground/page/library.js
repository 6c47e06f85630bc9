// Examples and lessons: the cards of all, and the content of one, loaded when it is opened.

import { $, element, button, say } from "./dom.js";
import { said, show_text } from "./task.js";

let groups = null;
export async function load_library() {
  groups ??= (await (await fetch("examples.json")).json()).groups;
  return groups;
}
export const not_loaded = "The lessons and examples could not be loaded. Check your network connection and reload the page.";
const whole = new Map(); // by id
/** Loads an item with everything it opens with. */
export async function load_item(item) {
  if (!whole.has(item.id)) whole.set(item.id, { ...item, ...await (await fetch(`examples/${item.id}.json`)).json() });
  return whole.get(item.id);
}
const lessons = () => (groups ?? []).flatMap(group => group.items).filter(item => item.job && item.language === "orb");

export async function first_lesson() {
  await load_library();
  return lessons()[0];
}

/** The lesson after `id`; undefined after the last one. */
export function lesson_after(id) {
  const all = lessons(), at = all.findIndex(lesson => lesson.id === id);
  return at < 0 ? undefined : all[at + 1];
}

export function as_workspace({ id, files, main, run, readme, task }) {
  const { [main]: program, ...others } = files; // the program's tab comes first
  return { files: { [main]: program, ...others }, active: main, main, run: run ?? {}, lesson: readme ? id : "", task };
}

/** The item that an address means: by id, by program, or by another of its files. */
export async function item_named(id) {
  const all = (await load_library()).flatMap(group => group.items);
  return all.find(one => one.id === id) ?? all.find(one => one.main === id) ?? all.find(one => one.names.includes(id));
}

/** Shows a dialog that calls `on_pick(item)`. */
export async function show_library(on_pick) {
  const list = $("library-list"), dialog = $("library");
  dialog.showModal();
  try {
    await load_library();
  } catch {
    list.replaceChildren(element("p", { class: "empty" }, "The examples could not be loaded."));
    return;
  }
  const done = kept_done();
  const show = () => {
    const wanted = $("search").value.trim().toLowerCase();
    const fits = item => `${item.id} ${item.title} ${item.summary ?? ""}`.toLowerCase().includes(wanted);
    list.replaceChildren(...groups.flatMap(({ title, items }) => {
      const found = items.filter(fits);
      const cards = found.filter(item => !found.some(other => is_better(other, item)));
      if (!cards.length) return [];
      return [element("h3", {}, title), element("ul", { class: "cards" }, ...cards.map(item => {
        const others = found.filter(other => is_better(item, other));
        const open = one => () => { dialog.close(); on_pick(one); };
        return element("li", {}, card(item, open(item), done),
          ...others.map(other => button(`in ${languages[other.language]}`, open(other), { "data-id": other.id, class: "link" })));
      }))];
    }));
    if (!list.children.length) list.append(element("p", { class: "empty" }, "Nothing contains these words."));
  };
  $("search").value = "";
  $("search").oninput = show;
  show();
  $("search").focus();
}
const languages = { orb: "orb", bas: "orbBasic", macro: "a macro" };
const order = Object.keys(languages);
/** The same program in a preferred language. */
const is_better = (one, other) => stem(one.id) === stem(other.id) && !one.job && order.indexOf(one.language) < order.indexOf(other.language);
const stem = id => id.replace(/\.\w+$/, "");
function card(item, on_click, done) {
  const is_done = item.job && done.has(item.id);
  const made = button("", on_click, { "data-id": item.id });
  made.append(picture(item), element("b", {}, item.title), element("span", {}, item.summary || first_words(item.job) || ""));
  if (is_done) made.append(element("i", { class: "done" }, "done"));
  return made;
}
const svg = (name, attributes, ...children) => {
  const made = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.append(...children);
  return made;
};
/** The ball's path in it; if it stays, the ball in its last colour. */
function picture({ path = [], color = "" }) {
  const lines = path.map(([stroke, d]) => svg("path", { d, ...stroke ? { stroke } : { class: "unlit" } }));
  const ball = lines.length ? [] : [svg("circle", { class: "mark-ball", cx: 60, cy: 36, r: 20 }), svg("circle", { cx: 60, cy: 36, r: 20, fill: color || "none", "fill-opacity": .75 })];
  return svg("svg", { viewBox: "0 0 120 72", class: "drawn", "aria-hidden": "true" }, ...lines, ...ball);
}
/** The job: the text after a bold word. */
const first_words = text => /^\*\*[^*]+:\*\*\s+([^]+?)$/m.exec(said(text ?? ""))?.[1].replace(/[*`]/g, "");

// ---- lessons ----
const done_key = "orb-lessons-done";
function kept_done() {
  try { return new Set(JSON.parse(localStorage.getItem(done_key)) ?? []); } catch { return new Set(); }
}
export function mark_done(id) {
  try { localStorage.setItem(done_key, JSON.stringify([...kept_done().add(id)])); } catch { /* no storage */ }
}
/** All lessons, and the one called `id` with its task; nothing for other ids. */
async function lesson_called(id) {
  await load_library();
  const all = lessons(), at = all.findIndex(lesson => lesson.id === id);
  return { all, at, lesson: all[at] && await load_item(all[at]) };
}
let asked = "";
/** Shows the task of a lesson; hides it if `id` is not a lesson. */
export async function show_task(id, { on_pick, on_solution }, stays = false) {
  asked = id;
  if (!id) { $("task").hidden = true; return; }
  const found = await lesson_called(id).catch(() => null);
  if (asked !== id) return; // something else was opened meanwhile
  if (!found) say(not_loaded, "bad");
  const { all, at, lesson } = found ?? {};
  $("task").hidden = !lesson;
  if (!lesson) return;
  const [, title, rest] = /^#\s*([^\n]*)\n([^]*)$/.exec(said(lesson.readme)) ?? [, lesson.title, lesson.readme];
  $("task-title").textContent = `Lesson ${title}`;
  const done = kept_done();
  $("dots").replaceChildren(...all.map((one, i) => button("", () => on_pick(one), {
    "aria-label": `Lesson ${i + 1}, ${one.title}${done.has(one.id) ? ", done" : ""}`, title: one.title,
    class: done.has(one.id) ? "done" : undefined, "aria-current": i === at ? "step" : undefined })));
  if (stays) return;
  show_text(rest);
  for (const [id, other] of [["lesson-before", all[at - 1]], ["lesson-next", all[at + 1]]]) {
    $(id).disabled = !other;
    $(id).onclick = () => on_pick(other);
  }
  $("solution").hidden = !lesson.solution;
  $("solution").onclick = () => on_solution(lesson);
}
