// The printed sheet: the task, the program, the path, and a line for the name.

import { $ } from "./dom.js";
import { program_of } from "./workspace.js";

export function fill_sheet(workspace) {
  const name = program_of(workspace, workspace.active);
  const lines = (workspace.files[name] ?? "").trimEnd().split("\n"), wide = String(lines.length).length;
  $("sheet-title").textContent = workspace.title || name;
  $("sheet-program").textContent = lines.map((line, i) => `${String(i + 1).padStart(wide)}  ${line}`).join("\n");
}
