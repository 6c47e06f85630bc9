// Runs a program here to drive a real robot; the map shows where it is. However a run ends, the robot is stopped.

import { $, element, with_code } from "./dom.js";
import { do_wish, within } from "../link.js";
import { request } from "./ball.js";

const frame_ms = 33; // between two frames
const patience = 2000; // milliseconds for a step of the engine; a robot without commands stops after as long
const patience_again = 3000; // for a robot that was lost: by then it has stopped by itself
const late = new Error("the engine does not answer");

/** The driver of a program that the engine runs. */
const driver_of = (machine, asked) => ({
  start: robot => machine.call("drive_start", { ...asked, robot, for: "0" }),
  step: message => machine.call("drive_step", message),
  end() {},
});

/** Reconnects to the robot of a lost link; null if that takes too long. */
async function again(link) {
  const opening = link.again?.();
  try {
    return await within(opening, patience_again) ?? null;
  } catch {
    opening?.then(made => made.close(), () => {});
    return null;
  }
}

/** Drives the robot on `link`, which the caller closes, until the program has ended or is stopped. */
export async function drive(ball, link) {
  const asked = request(ball.workspace());
  if (!ball.ready(asked)) return;
  ball.set_busy("robot");
  ball.expect(asked);
  ball.say("getting the robot ready");
  ball.on_begin();
  const leash = ball.leash = new AbortController(), { signal } = leash;
  ball.told = "";
  const begin = performance.now();
  const now = () => performance.now() - begin;
  let driver, second = null, why = "", stop = null; // the packets that would stop it now
  const brake = () => stop && do_wish(second ?? link, { write: stop }, now);
  /** Stops the robot if the page is hidden: the browser may pause it, and nobody watches the robot. */
  const on_hidden = ({ type }) => {
    if (type !== "pagehide" && !document.hidden) return;
    why = "the page was hidden";
    leash.abort();
    brake();
  };
  const hides = ["visibilitychange", "pagehide"];
  for (const event of hides) window.addEventListener(event, on_hidden, true);
  try {
    const foreign = ball.foreign(asked.names[0]);
    driver = foreign ? await foreign(edu => edu.driver(asked)) : driver_of(ball.machine, asked);
    if (!driver) throw new Error("a part of the page is not here; the robot was not moved");
    let step = await driver.start(link.name ?? "");
    while (step.wish) {
      if (signal.aborted) throw new Error("stopped; the robot was not moved");
      step = await driver.step({ at: now(), ...await do_wish(link, step.wish, now) });
    }
    ball.show(step.report, true);
    ball.say(ball.running = step.instead_of ? `driving the “${step.robot}”, not the “${step.instead_of}” that is chosen; Stop brakes it` : `driving the “${step.robot}”; Stop brakes it`);
    ball.player.play();
    let done = {}, shown = 0, is_lost = false;
    while (!step.over) {
      const frame = now() - shown >= frame_ms;
      if (frame) shown = now();
      step = await within(driver.step({ at: now(), ...done, stop: signal.aborted, frame }), patience, late);
      if (step.frame) ball.take_frame(step.frame);
      stop = step.stop ?? stop;
      done = step.write.length ? await do_wish(second ?? link, { write: step.write }, now) : {};
      if (!done.error && !step.over) done = await do_wish(second ?? link, { read_until: now() + step.wait_ms }, now);
      if (!done.error) continue;
      // After the first error the engine has begun to stop the robot.
      if (is_lost && !second && (second = await again(link))) done = { relinked: true };
      is_lost = true;
    }
    ball.finish();
    ball.conclude(step.over, false);
    tell(step.stopped, why, step.trouble);
  } catch (error) {
    await brake();
    if (error === late) ball.machine.restart();
    ball.fail({ message: error.message, findings: error.findings });
    if (stop) tell(false);
  } finally {
    for (const event of hides) window.removeEventListener(event, on_hidden, true);
    driver?.end();
    await second?.close();
  }
}
function tell(stopped, ...reasons) {
  const words = [...reasons, stopped ? "the robot has been stopped" : "the robot has not acknowledged the stop: check that it has stopped"].filter(Boolean);
  $("outcome").append(element("p", { class: stopped ? "hint" : "bad" }, ...words.flatMap((one, i) => i ? ["; ", with_code(one)] : [with_code(one)])));
}
