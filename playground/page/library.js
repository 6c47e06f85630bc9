// The examples and lessons that the build put beside the page.

import { $, element, button, harmless } from "./dom.js";
import { markdown } from "./markdown.js";

let groups = null;
export async function load_library() {
  groups ??= (await (await fetch("examples.json")).json()).groups;
  return groups;
}
const lessons = () => (groups ?? []).flatMap(group => group.items).filter(item => item.readme);

export function as_workspace({ id, files, main, run, readme }) {
  const { [main]: program, ...others } = files; // the program's tab comes first
  return { files: { [main]: program, ...others }, active: main, main, run: run ?? {}, lesson: readme ? id : "" };
}

/** A dialog in which `on_pick(item)` is asked for one. */
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
    const ordered = [...groups].sort((a, b) => Number(b.items.some(item => item.readme)) - Number(a.items.some(item => item.readme)));
    list.replaceChildren(...ordered.flatMap(({ title, items }) => {
      const found = items.filter(fits);
      if (!found.length) return [];
      return [element("h3", {}, title), element("ul", { class: "cards" }, ...found.map((item, i) =>
        element("li", {}, button("", () => { dialog.close(); on_pick(item); }, { "data-id": item.id }))))].map((part, k) => {
        if (k) [...part.children].forEach((child, i) => fill(child.firstChild, found[i], done));
        return part;
      });
    }));
    if (!list.children.length) list.append(element("p", { class: "empty" }, "Nothing has these words."));
  };
  $("search").value = "";
  $("search").oninput = show;
  show();
  $("search").focus();
}
function fill(card, item, done) {
  card.append(element("b", {}, item.title), element("span", {}, item.summary || first_words(item.readme) || ""));
  const kind = item.readme ? done.has(item.id) ? "done" : "lesson" : item.main.split(".").pop();
  card.append(element("i", { class: kind }, kind));
}
const first_words = text => /\*\*Your job:\*\*\s*([^]+?)(?:\n\n|$)/.exec(text ?? "")?.[1].replace(/[*`]/g, "");

// ---- lessons ----
const done_key = "orb-lessons-done";
function kept_done() {
  try { return new Set(JSON.parse(localStorage.getItem(done_key)) ?? []); } catch { return new Set(); }
}
export function mark_done(id) {
  try { localStorage.setItem(done_key, JSON.stringify([...kept_done().add(id)])); } catch { /* no storage */ }
}
/** What a lesson says to type into a terminal is a button here. */
function suggest_button(block) {
  const lines = block.textContent.trim().split("\n");
  if (!lines.every(line => line.startsWith("orb "))) return;
  const buttons = [["orb run", "Run"], ["orb test", "Am I done?"]].filter(([word]) => lines.some(line => line.startsWith(word)));
  block.replaceWith(element("p", { class: "hint" }, `→ ${buttons.map(([, words]) => words).join(", then ")}`));
}
/** Shows the task of a lesson, or hides it where `id` is none. */
export async function show_task(id, { on_pick, on_solution }) {
  if (!id) { $("task").hidden = true; return; }
  await load_library().catch(() => {});
  const all = lessons(), at = all.findIndex(lesson => lesson.id === id), lesson = all[at];
  $("task").hidden = !lesson;
  if (!lesson) return;
  const [, title, rest] = /^#\s*([^\n]*)\n([^]*)$/.exec(lesson.readme) ?? [, lesson.title, lesson.readme];
  $("task-title").textContent = `Lesson ${title}`;
  $("task-text").innerHTML = harmless(markdown(rest.replaceAll("../../", "")));
  for (const block of $("task-text").querySelectorAll("pre")) suggest_button(block);
  $("task-text").scrollTop = 0;
  for (const [id, other] of [["lesson-before", all[at - 1]], ["lesson-next", all[at + 1]]]) {
    $(id).disabled = !other;
    $(id).onclick = () => on_pick(other);
  }
  $("solution").hidden = !lesson.solution;
  $("solution").onclick = () => on_solution(lesson);
}
