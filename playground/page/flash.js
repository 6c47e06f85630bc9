// Sends a program to a real ball if the browser can; otherwise offers the file for `orb upload`.

import { can_serial, can_bluetooth, choose_serial, choose_bluetooth, serial_link, bluetooth_link, deliver } from "../link.js";
import { $, download } from "./dom.js";
import { request } from "./ball.js";
import { drive as drive_robot } from "./drive.js";
import { robot_list } from "./robots.js";
import { ending_of } from "./workspace.js";

/** Waits for `promise`; fails at once when `signal` aborts, and passes a late result to `undo`. */
function unless(signal, promise, undo) {
  const stop = new Promise((_, failed) => signal.addEventListener("abort", () => {
    failed(new Error("interrupted; nothing was sent"));
    promise.then(undo).catch(() => {});
  }, { once: true }));
  return Promise.race([promise, stop]);
}

export function set_up_flash({ machine, workspace, ball, on_mistakes }) {
  let running = null;
  let held = null; // the link to a robot that has the program: { link, asked, over }
  const ways = {
    serial: { choose: choose_serial, open: port => serial_link(machine, port) },
    bluetooth: { choose: () => choose_bluetooth(machine), open: device => bluetooth_link(machine, device) },
  };
  const robots = robot_list((way, device) => write(way, device));
  let way_of_last = null;

  const is_foreign = name => ending_of(name ?? "") === "js";
  /** Enables what can be done with the program here. */
  function offer() {
    const [name] = request(workspace()).names, is_kept = name && !is_foreign(name);
    $("flash-serial").disabled = !can_serial() || !is_kept;
    $("flash-bluetooth").disabled = !can_bluetooth() || !is_kept;
    $("flash-file").disabled = $("flash-options").disabled = !is_kept;
    $("drive-serial").disabled = !can_serial() || !name;
    $("drive-bluetooth").disabled = !can_bluetooth() || !name;
  }
  async function open() {
    const { names } = request(workspace()), serial = can_serial(), bluetooth = can_bluetooth();
    offer();
    $("flash-what").textContent = is_foreign(names[0]) ? "No robot can keep a JavaScript program; it runs here and drives the robot." : names[0] ? `Writes ${names.join(" and ")} to a robot that is awake and nearby.` : "There is no program to send yet.";
    $("flash-lacks").textContent = !serial && !bluetooth ? "This browser cannot reach robots. Chrome and Edge can; or save the file and write it with `orb upload`."
      : !serial ? "This browser does not support serial ports: classic balls need Chrome or Edge on a computer, or the saved file and `orb upload`."
      : !bluetooth ? "This browser does not support Bluetooth LE." : "";
    if (!held) {
      $("flash-status").textContent = "";
      $("flash-progress").hidden = true;
    }
    if (!$("flash-dialog").open) $("flash-dialog").showModal();
    if (!bluetooth || !names[0]) return;
    // The browser supports Bluetooth, but the device may have none, or its radio may be off.
    const there = await navigator.bluetooth.getAvailability?.().catch(() => true) ?? true;
    if (there || running) return;
    $("flash-bluetooth").disabled = $("drive-bluetooth").disabled = true;
    $("flash-lacks").textContent = "This device has no Bluetooth, or Bluetooth is switched off; switch it on and open this again.";
  }
  function say(words, bad = false) {
    $("flash-status").textContent = words;
    $("flash-status").className = bad ? "bad" : "";
  }
  function set_running(controller) {
    running = controller;
    for (const id of ["drive-serial", "drive-bluetooth", "flash-serial", "flash-bluetooth", "flash-file", "flash-close", "flash-options", "flash-next"]) $(id).disabled = !!controller;
    $("robots").inert = !!controller;
    $("flash-cancel").hidden = !controller;
    if (!controller) return offer();
    $("flash-progress").hidden = false;
    $("flash-progress").value = 0;
  }
  /** Writes to a robot that the user chooses, or again to `device`. */
  async function write(way, device) {
    const { files, names } = request(workspace());
    const controller = new AbortController();
    let link = null, row = null, stays = false;
    const tell = (state, words, in_list = words) => {
      say(words, state === "failed");
      row?.show(state, in_list);
    };
    await let_go();
    set_running(controller);
    say(device ? "" : "Choose the ball in the browser's window.");
    try {
      device ??= await unless(controller.signal, way.choose(), () => {});
      row = robots.row_of(way, device);
      way_of_last = way;
      row.show("busy", "");
      link = await unless(controller.signal, way.open(device), late => late.close());
      const area = document.querySelector("input[name=area]:checked").value;
      const outcome = await deliver(machine, link, { files, names, area, run: $("flash-run").checked, line: null, force: false, clear_macros: false }, {
        signal: controller.signal,
        on_status({ words, stage, bytes, bytes_total }) {
          const part = bytes_total ? bytes / bytes_total : 0;
          $("flash-progress").value = part;
          tell("busy", words || stage || "", `${Math.round(100 * part)} %`);
        },
      });
      stays = outcome.kind === "done" || outcome.kind === "stopped";
      if (stays) $("flash-progress").value = 1;
      tell(outcome.kind === "done" ? "done" : "failed", outcome.message || outcome.kind);
      if (stays) hold(link, { files, names, area }, outcome.prints);
    } catch (error) {
      if (error.findings) {
        on_mistakes(error.findings);
        tell("failed", "The program has errors; it was not written to the robot.");
      } else if (error.name === "NotFoundError" && !row) {
        say("No ball was chosen.");
      } else {
        tell("failed", error.message);
      }
    } finally {
      if (!stays) await link?.close().catch(() => {});
      set_running(null);
      $("flash-next").hidden = !way_of_last;
      if (way_of_last && document.activeElement === document.body) $("flash-next").focus();
    }
  }
  /** Runs the program here to drive the robot: the dialog gives way to the map. */
  async function drive(open_link) {
    const controller = new AbortController();
    let link = null;
    await let_go();
    set_running(controller);
    $("flash-progress").hidden = true;
    say("Put the robot on the floor, and choose it in the browser's window.");
    try {
      link = await unless(controller.signal, open_link(), late => late.close());
      say("");
      set_running(null);
      $("flash-dialog").close();
      await drive_robot(ball, link);
    } catch (error) {
      say(error.name === "NotFoundError" ? "No robot was chosen." : error.message, error.name !== "NotFoundError");
    } finally {
      await link?.close().catch(() => {});
      set_running(null);
    }
  }
  // -- a robot that has the program: start and stop it here, show its output --
  async function hold(link, asked, prints) {
    const mine = held = { link, asked, seq: 0, over: false };
    $("robot").hidden = false;
    $("robot-prints").textContent = prints;
    try {
      while (!mine.over) {
        const bytes = await link.read(250);
        if (!bytes.length) continue;
        const { prints, error } = await machine.call("hear_robot", { bytes });
        $("robot-prints").append(prints + error);
        if (error && !mine.stopped) {
          await tell("stop"); // the wheels go on
          say(`The program stopped: ${error.trim()}.`, true);
        }
        $("robot-prints").scrollTop = $("robot-prints").scrollHeight;
      }
    } catch (error) {
      if (mine.over) return;
      say(error.message ?? "The robot is gone.", true);
      await let_go();
    }
  }
  async function let_go() {
    const mine = held;
    held = null;
    $("robot").hidden = true;
    if (!mine) return;
    mine.over = true;
    await mine.link.close().catch(() => {});
  }
  async function tell(what) {
    if (!held) return;
    try {
      const { bytes } = await machine.call("tell_robot", { ...held.asked, what, seq: held.seq });
      held.seq = (held.seq + 8) % 248;
      held.stopped = what === "stop";
      await held.link.write(bytes);
      say(what === "run" ? "It is running." : "It is stopping.");
    } catch (error) {
      say(error.message ?? "The robot does not answer.", true);
    }
  }
  async function as_file() {
    const { files, names } = request(workspace());
    try {
      const { bytes, name } = await machine.call(ending_of(names[0]) === "macro" ? "assemble" : "build", { files, names: names.slice(0, 1) });
      download(name, bytes, "application/octet-stream");
      say(`${name}: write it with \`orb upload ${name}\`.`);
    } catch (error) {
      if (error.findings) on_mistakes(error.findings);
      say(error.findings ? "The program has errors." : error.message, true);
    }
  }
  $("robot-run").addEventListener("click", () => tell("run"));
  $("robot-stop").addEventListener("click", () => tell("stop"));
  window.addEventListener("pagehide", () => let_go());
  for (const way of ["serial", "bluetooth"]) $(`flash-${way}`).addEventListener("click", () => write(ways[way]));
  $("flash-next").addEventListener("click", () => write(way_of_last));
  $("drive-serial").addEventListener("click", () => drive(() => serial_link(machine)));
  $("drive-bluetooth").addEventListener("click", () => drive(() => bluetooth_link(machine, undefined, "all")));
  $("flash-file").addEventListener("click", as_file);
  $("flash-cancel").addEventListener("click", () => running?.abort());
  $("flash-dialog").addEventListener("cancel", event => { if (running) event.preventDefault(); });
  return { open };
}
