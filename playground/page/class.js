// For teachers and classes: writing lessons, handing in results. Both are addresses; nothing is stored on a server.

import { $, button, close_dialogs, copy, download, element, with_code } from "./dom.js";
import { is_mine, parts_of } from "./task.js";
import { first_error, kinds, program_of, tests_of } from "./workspace.js";

/**
 * `on_change()`: the task has changed; `write_file(name, text)`, `keep()`; `share(workspace)` shows an address,
 * `address_of(workspace)` makes one; `judge`, `mistakes` are those of Verdicts.
 */
export function set_up_class({ judge, workspace, on_change, write_file, keep, share, address_of, mistakes }) {
  // -- a teacher --
  const dialog = $("lesson-dialog");
  let now = null; // the dialog's workspace, even if another one is opened
  let tested = ""; // the file run by “Am I done?”
  function show_parts() {
    const program = program_of(now, now.active), tests = tests_of(now);
    tested = tests.find(name => program_of(now, name) === program) ?? tests[0] ?? "";
    const row = (words, ...what) => [element("dt", {}, words), element("dd", {}, ...what)];
    $("lesson-parts").replaceChildren(
      ...row("Pupils start with", program ? element("code", {}, program) : "no program yet"),
      ...row("“Am I done?” runs", ...tests.length ? [element("code", {}, tests.join(", ")), " ", element("span", { class: "hint", id: "lesson-verdict", role: "status" })]
        : ["nothing yet ", ...program ? [button("Create a test", () => make_test(program), { id: "lesson-make-test" })] : []]),
      ...row("Around the ball", element("span", {}, [now.run.course, ...now.run.stimuli].filter(Boolean).join(", ") || "nothing"), element("span", { class: "hint" }, " (chosen under More)")));
    $("lesson-share").disabled = !program;
    $("lesson-test-label").hidden = !tested;
    if (!tested) return;
    if ($("lesson-test").value !== now.files[tested]) $("lesson-test").value = now.files[tested];
    show_verdict(tests);
  }
  let judging = false;
  /** Judges the program and shows the result. One request at a time: later input is judged afterwards. */
  async function show_verdict(names) {
    if (judging) return plan_judgement();
    judging = true;
    const files = structuredClone(now.files), said = await verdict_of(files, names);
    judging = false;
    $("lesson-verdict")?.replaceChildren(...said);
  }
  async function verdict_of(files, names) {
    try {
      const tested = await judge({ files, names }), { summary } = tested.results;
      const findings = await mistakes(tested, files);
      if (findings) throw { findings };
      return [summary.passed === summary.tests ? "The program already passes: what is left for pupils to do?" : `The program passes ${summary.passed} of ${summary.tests}.`];
    } catch ({ message, findings }) {
      const first = findings && first_error(findings);
      return first ? [element("code", {}, first.name), " ", `line ${first.line}`, ": ", with_code(first.message)] : [message];
    }
  }
  function make_test(program) {
    write_file(program.replace(/\.\w+$/, ".test"), kinds.test.start);
    show_parts();
    $("lesson-test").focus();
  }
  let typed = 0;
  function plan_judgement() {
    clearTimeout(typed);
    typed = setTimeout(() => show_verdict(tests_of(now)), 500);
  }
  $("lesson-test").addEventListener("input", () => {
    write_file(tested, $("lesson-test").value);
    plan_judgement();
  });

  const fill = task => {
    const { title, text } = parts_of(task);
    $("lesson-title").value = title;
    $("lesson-text").value = text;
  };
  const written = () => `# ${$("lesson-title").value.trim() || "Lesson"}\n\n${$("lesson-text").value.trim()}\n`;
  const begun = ({ task, title }) => task || `# ${title}\n\n`;
  function write() {
    close_dialogs();
    now = workspace();
    fill(now.draft || begun(now));
    $("lesson-draft").hidden = !now.draft;
    dialog.returnValue = "";
    dialog.showModal();
    $("lesson-title").focus();
    show_parts();
  }
  /** Saves on Escape or closing: an incomplete lesson becomes a draft. */
  function keep_draft() {
    now.draft = written().trim() === begun(now).trim() ? "" : written();
    keep();
  }
  for (const id of ["lesson-title", "lesson-text"]) $(id).addEventListener("input", keep_draft);
  $("lesson-discard").addEventListener("click", () => {
    now.draft = "";
    fill(begun(now));
    $("lesson-draft").hidden = true;
    $("lesson-title").focus();
    keep();
  });
  dialog.addEventListener("close", () => {
    clearTimeout(typed);
    if (now !== workspace()) return; // another one was opened, and this one has been saved
    const made = dialog.returnValue;
    if (!made) {
      keep_draft();
      return on_change();
    }
    now.task = written();
    now.draft = now.lesson = "";
    if (!is_mine(now)) now.document = "";
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
      if (name !== $("pupil").value.trim()) return; // a newer request is under way
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
