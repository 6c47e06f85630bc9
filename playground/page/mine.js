// The programs saved in this browser, each with its versions.

import { $, element, button } from "./dom.js";
import { checked } from "./workspace.js";

/** A date in the page's language, to the second, so that versions have distinct labels. */
function when(date) {
  const { lang } = document.documentElement, own = navigator.languages.filter(tag => tag.startsWith(lang));
  return new Intl.DateTimeFormat(own.length ? own : lang, { dateStyle: "medium", timeStyle: "medium" }).format(date);
}

/** `on_open(workspace, words)`; `begin()` makes a new one. */
export function set_up_mine({ store, workspace, on_open, begin }) {
  const open = (row, id, title, words) => {
    const found = checked(row.workspace);
    $("mine-dialog").close();
    if (found) on_open({ ...found, document: id, title, before: "" }, words);
  };
  /** The versions of a document, loaded on demand. */
  function earlier(id, title) {
    const list = element("ol");
    const fold = element("details", {}, element("summary", {}, "Earlier versions"), list);
    fold.addEventListener("toggle", async () => {
      if (!fold.open || list.children.length) return;
      const rows = await store.versions(id);
      const labels = rows.map(row => when(row.changed)), label = i => {
        const older = labels.slice(i + 1).filter(one => one === labels[i]).length; // within one second
        return older ? `${labels[i]} (${older + 1})` : labels[i];
      };
      list.append(...rows.length ? rows.map((row, i) => {
        const { files, active } = row.workspace, text = files[row.workspace.main || active] ?? "";
        return element("li", {}, button(label(i), () => open(row, id, title, `“${title}”, as it was on ${labels[i]}.`), { class: "link" }),
          element("span", { class: "hint" }, ` ${text.split("\n").length} lines`));
      }) : [element("li", { class: "hint" }, "none")]);
    });
    return fold;
  }
  $("mine-new").addEventListener("click", () => {
    $("mine-dialog").close();
    on_open(begin(), "A new program.");
  });
  return {
    async show() {
      const rows = await store.list();
      $("mine-list").replaceChildren(element("ul", { class: "mine" }, ...rows.map(row => element("li", { "data-document": row.id },
        button(row.title || "program", () => open(row, row.id, row.title, `“${row.title}”, as you left it.`), { class: row.id === workspace().document ? "strong" : undefined }),
        element("span", { class: "hint" }, when(row.changed)), earlier(row.id, row.title)))));
      if (!rows.length) $("mine-list").replaceChildren(element("p", { class: "empty" }, "Nothing has been saved here yet."));
      if (!$("mine-dialog").open) $("mine-dialog").showModal();
    },
  };
}
