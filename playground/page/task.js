// The task of a lesson that somebody wrote: how it is kept in a workspace, and shown.

import { $, harmless } from "./dom.js";
import { markdown } from "./markdown.js";
import { tests_of } from "./workspace.js";

/** The title and the text of a task: `# Title`, then Markdown. */
export function parts_of(task) {
  const [, title, text] = /^#\s+([^\n]*)\n*([^]*)$/.exec(task) ?? [, "", task];
  return { title: title.trim(), text: text.trim() };
}
/** A document of its own for each lesson that is opened, the same whenever it is opened again. */
export function id_of(fragment) {
  let a = 0x811c9dc5, b = 0x1000193;
  for (const char of fragment) {
    a = Math.imul(a ^ char.charCodeAt(0), 0x01000193);
    b = Math.imul(b + char.charCodeAt(0), 0x85ebca6b) ^ b >>> 13;
  }
  return `task:${(a >>> 0).toString(36)}${(b >>> 0).toString(36)}`;
}
/** Whether it was made here, and not opened from an address of somebody else. */
export const is_mine = ({ document }) => document.startsWith("own:");

/** Shows the task of a lesson that is none of the page's own. */
export function show_own_task({ task }) {
  const { title, text } = parts_of(task);
  $("task").hidden = false;
  $("task-title").textContent = title || "Task";
  $("task-text").innerHTML = harmless(markdown(text));
  $("task-text").scrollTop = 0;
  $("dots").replaceChildren();
}
/** The buttons beside a task, and those that make a lesson: what somebody has handed in is there to be looked at. */
export function show_class_buttons(workspace) {
  const own = !!workspace.task && !workspace.lesson;
  for (const id of ["lesson-before", "lesson-next", "solution"]) $(id).classList.toggle("gone", own);
  $("task-edit").hidden = !own || !is_mine(workspace) || !!workspace.name;
  $("share-lesson").hidden = $("lesson-write").hidden = !!workspace.name;
  $("hand-in").hidden = !(workspace.lesson || own) || !!workspace.name || !tests_of(workspace).length;
}

/** The addresses in a file of them. */
export const addresses_in = text => text.match(/#p=[\w-]+/g) ?? [];
