// What a teacher and a class need: a lesson is written, a result handed in. Both are addresses, and nothing is stored
// anywhere.

import { $, button, copy, download, element, with_code } from "./dom.js";
import { is_mine, parts_of } from "./task.js";
import { kinds, program_of, tests_of } from "./workspace.js";

/** `on_change()` where the files or the task are others, `write_file(name, text)`, `keep()`; `share(workspace)` shows an
 *  address, `address_of(workspace)` makes one. */
export function set_up_class({ machine, workspace, on_change, write_file, keep, share, address_of }) {
  // -- a teacher --
  const dialog = $("lesson-dialog");
  let tested = ""; // the file that “Am I done?” runs
  async function show_parts() {
    const now = workspace(), program = program_of(now, now.active), tests = tests_of(now);
    tested = tests.find(name => program_of(now, name) === program) ?? tests[0] ?? "";
    const row = (words, ...what) => [element("dt", {}, words), element("dd", {}, ...what)];
    const verdict = element("span", { class: "hint", id: "lesson-verdict", role: "status" });
    $("lesson-parts").replaceChildren(
      ...row("Pupils start with", program ? element("code", {}, program) : "no program yet"),
      ...row("“Am I done?” runs", ...tests.length ? [element("code", {}, tests.join(", ")), " ", verdict]
        : ["nothing yet ", ...program ? [button("Create a test", () => make_test(program), { id: "lesson-make-test" })] : []]),
      ...row("Around the ball", element("span", {}, [now.run.course, ...now.run.stimuli].filter(Boolean).join(", ") || "nothing"), element("span", { class: "hint" }, " (chosen under More)")));
    $("lesson-share").disabled = !program;
    $("lesson-test-label").hidden = !tested;
    if (!tested) return;
    if ($("lesson-test").value !== now.files[tested]) $("lesson-test").value = now.files[tested];
    verdict.replaceChildren(...await judge(now, tests));
  }
  async function judge({ files }, names) {
    try {
      const { summary } = (await machine.call("test", { files, names })).results;
      return [summary.passed === summary.tests ? "The program already passes: what is left for pupils to do?" : `The program passes ${summary.passed} of ${summary.tests}.`];
    } catch ({ message, findings }) {
      const first = findings?.diagnostics.find(one => one.severity === "error");
      return first ? [`line ${first.line}`, ": ", with_code(first.message)] : [message];
    }
  }
  function make_test(program) {
    write_file(program.replace(/\.\w+$/, ".test"), kinds.test.start);
    show_parts();
    $("lesson-test").focus();
  }
  let typed = 0;
  $("lesson-test").addEventListener("input", () => {
    write_file(tested, $("lesson-test").value);
    clearTimeout(typed);
    typed = setTimeout(show_parts, 500);
  });

  const fill = task => {
    const { title, text } = parts_of(task);
    $("lesson-title").value = title;
    $("lesson-text").value = text;
  };
  const begun = ({ task, title }) => task || `# ${title}\n\n`;
  function write() {
    for (const open of document.querySelectorAll("dialog[open]")) open.close();
    const now = workspace();
    fill(now.draft || begun(now));
    $("lesson-draft").hidden = !now.draft;
    dialog.returnValue = "";
    dialog.showModal();
    $("lesson-title").focus();
    show_parts();
  }
  $("lesson-discard").addEventListener("click", () => {
    workspace().draft = "";
    fill(begun(workspace()));
    $("lesson-draft").hidden = true;
    keep();
  });
  // Escape, too, loses nothing: what is no lesson yet is a draft.
  dialog.addEventListener("close", () => {
    const now = workspace(), text = `# ${$("lesson-title").value.trim() || "Lesson"}\n\n${$("lesson-text").value.trim()}\n`, made = dialog.returnValue;
    now.draft = made || text.trim() === begun(now).trim() ? "" : text;
    if (made) {
      now.task = text;
      now.lesson = "";
      if (!is_mine(now)) now.document = "";
    }
    on_change();
    if (made === "share") share();
  });

  // -- a pupil --
  const name_key = "orb-pupil";
  const kept_name = () => { try { return localStorage.getItem(name_key) ?? ""; } catch { return ""; } };
  let address = "";
  async function show_address() {
    const name = $("pupil").value.trim();
    $("hand-in-save").disabled = $("hand-in-copy").disabled = !name;
    address = "";
    try {
      const made = await address_of({ ...workspace(), name });
      if (name !== $("pupil").value.trim()) return; // another one is being made
      $("hand-in-link").value = address = made;
    } catch (error) {
      $("hand-in-link").value = "";
      $("hand-in-save").disabled = $("hand-in-copy").disabled = true;
      $("hand-in-said").textContent = error.message;
    }
  }
  function hand_in() {
    $("pupil").value = workspace().name || kept_name();
    $("hand-in-said").textContent = "";
    $("hand-in-dialog").showModal();
    ($("pupil").value ? $("hand-in-copy") : $("pupil")).focus();
    show_address();
  }
  $("pupil").addEventListener("input", () => {
    try { localStorage.setItem(name_key, $("pupil").value.trim()); } catch { /* no storage */ }
    show_address();
  });
  $("hand-in-copy").addEventListener("click", async () => {
    await copy($("hand-in-link"), address);
    $("hand-in-said").textContent = "Copied: paste it where your teacher wants it.";
  });
  $("hand-in-save").addEventListener("click", () => {
    const name = `${$("pupil").value.trim().replace(/[^\p{L}\p{N}]+/gu, "-").replace(/^-|-$/g, "") || "result"}.link`;
    download(name, `${address}\n`);
    $("hand-in-said").textContent = `${name} is in your downloads: give it to your teacher.`;
  });
  return { write, hand_in };
}
