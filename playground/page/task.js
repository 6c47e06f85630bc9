// The task of a user's lesson: how a workspace stores it, and how it is shown.

import { $, harmless, t } from "./dom.js";
import { markdown } from "./markdown.js";
import { tests_of } from "./workspace.js";

/** Splits a task into title and text: `# Title`, then Markdown. */
export function parts_of(task) {
  const [, title, text] = /^#\s+([^\n]*)\n*([^]*)$/.exec(task) ?? [, "", task];
  return { title: title.trim(), text: text.trim() };
}
/** The document id of an opened lesson, the same each time it is opened. */
export function id_of(fragment) {
  let a = 0x811c9dc5, b = 0x1000193;
  for (const char of fragment) {
    a = Math.imul(a ^ char.charCodeAt(0), 0x01000193);
    b = Math.imul(b + char.charCodeAt(0), 0x85ebca6b) ^ b >>> 13;
  }
  return `task:${(a >>> 0).toString(36)}${(b >>> 0).toString(36)}`;
}
/** True if it was made here, not opened from somebody else's address. */
export const is_mine = ({ document }) => document.startsWith("own:");

/**
 * Shows a task. The job stays visible above the rest, which scrolls. It is the first paragraph after `**Your
 * job:**`, or its translation, plus the list below it if the paragraph leads to one.
 */
export function show_text(text) {
  const rest = $("task-text"), is_job = ({ firstChild }) => firstChild?.nodeName === "STRONG" && /:\s*$/.test(firstChild.textContent);
  rest.innerHTML = harmless(markdown(text));
  rest.scrollTop = 0;
  const job = [...rest.children].find(is_job);
  const leads_on = job && /:\s*$/.test(job.textContent) && job.nextElementSibling;
  $("task-job").hidden = !job;
  $("task-job").replaceChildren(...[job, leads_on].filter(Boolean));
}

/** Each paragraph of a text in the language of the page. */
export const said = text => text.trim().split("\n\n").map(block => t(block)).join("\n\n");

/** Shows the task of a lesson that a user wrote. */
export function show_own_task({ task }) {
  const { title, text } = parts_of(task);
  $("task").hidden = false;
  $("task-title").textContent = title || "Task";
  show_text(said(text));
  $("dots").replaceChildren();
}
/** Shows the buttons for tasks and for making lessons; none for work that was handed in. */
export function show_class_buttons(workspace) {
  const own = !!workspace.task && !workspace.lesson;
  for (const id of ["lesson-before", "lesson-next", "solution"]) $(id).classList.toggle("gone", own);
  $("task-edit").hidden = !own || !is_mine(workspace) || !!workspace.name;
  $("share-lesson").hidden = $("lesson-write").hidden = !!workspace.name;
  $("hand-in").hidden = !(workspace.lesson || own) || !!workspace.name || !tests_of(workspace).length;
}

/** The addresses in a text. */
export const addresses_in = text => text.match(/#p=[\w-]+/g) ?? [];
