// What a teacher and a class need: a lesson is written, a result handed in. Both are addresses, and nothing is stored
// anywhere.

import { $, button, copy, download, element } from "./dom.js";
import { is_mine, parts_of } from "./task.js";
import { ending_of, kinds, program_of, tests_of } from "./workspace.js";

/** `on_change()` where files or the task are others; `share(workspace)` shows an address, `address_of(workspace)` makes one. */
export function set_up_class({ machine, workspace, on_change, share, address_of }) {
  // -- a teacher --
  async function show_parts() {
    const now = workspace(), program = program_of(now, now.active), tests = tests_of(now);
    const row = (words, ...what) => [element("dt", {}, words), element("dd", {}, ...what)];
    const verdict = element("span", { class: "hint" });
    $("lesson-parts").replaceChildren(
      ...row("Pupils start with", program ? element("code", {}, program) : "no program yet"),
      ...row("“Am I done?” runs", ...tests.length ? [element("code", {}, tests.join(", ")), " ", verdict]
        : ["nothing yet ", ...program ? [button("Create a test", () => make_test(program), { id: "lesson-make-test" })] : []]),
      ...row("Around the ball", element("span", {}, [now.run.course, ...now.run.stimuli].filter(Boolean).join(", ") || "nothing"), element("span", { class: "hint" }, " (chosen under More)")));
    $("lesson-share").disabled = !program;
    if (!tests.length) return;
    const { results } = await machine.call("test", { files: now.files, names: tests }).catch(() => ({}));
    const summary = results?.summary;
    verdict.textContent = !summary ? "It has errors." : summary.passed === summary.tests ? "The program already passes: what is left for pupils to do?"
      : `The program passes ${summary.passed} of ${summary.tests}.`;
  }
  function make_test(program) {
    const name = program.replace(/\.\w+$/, ".test");
    workspace().files[name] = kinds[ending_of(name)].start;
    on_change(name);
    show_parts();
  }
  function write() {
    for (const open of document.querySelectorAll("dialog[open]")) open.close();
    const now = workspace(), { title, text } = parts_of(now.task || `# ${now.title}\n\n`);
    $("lesson-title").value = title;
    $("lesson-text").value = text;
    $("lesson-dialog").showModal();
    $("lesson-title").focus();
    show_parts();
  }
  const taken = () => {
    const now = workspace();
    now.task = `# ${$("lesson-title").value.trim() || "Lesson"}\n\n${$("lesson-text").value.trim()}\n`;
    now.lesson = "";
    if (!is_mine(now)) now.document = "";
    on_change();
  };
  $("lesson-form").addEventListener("submit", event => {
    if (event.submitter?.value === "") return;
    taken();
    if (event.submitter?.id === "lesson-share") share();
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
