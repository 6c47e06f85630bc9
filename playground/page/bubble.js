// The ball's speech bubble: the program's last output, or a remark.

import { playback, watch } from "../../report/page/playback.js";
import { $, element } from "./dom.js";

const stays = 2_500_000; // microseconds of the robot
const longest = 60; // characters

/** The text printed most recently before `now`; empty if that was long ago. */
function said(events, now) {
  for (let i = events.length - 1; i >= 0 && events[i].t > now - stays; --i)
    if (events[i].kind === "print" && events[i].t <= now) return events[i].text.trim();
  return "";
}

/** `greeting`: said before the first run. Returns a function that sets or clears a remark. */
export function set_up_bubble({ greeting }) {
  const words = element("span"), bubble = element("p", { class: "bubble", "aria-hidden": "true", hidden: true }, words);
  $("map").parentElement.append(bubble);
  let shown = "", remark = "";
  function show() {
    const own = remark || ($("played").classList.contains("idle") ? greeting : ""), text = own || said(playback.main.run.events, playback.now);
    if (text !== shown) {
      words.translate = !!own; // a program's output is not translated
      shown = text;
      bubble.hidden = !text;
      words.textContent = !own && text.length > longest ? `${text.slice(0, longest)}…` : text;
    }
    if (!text) return;
    const [x, y] = $("ball").getAttribute("transform").match(/-?[\d.]+/g).map(Number);
    const { width } = $("map").viewBox.baseVal;
    bubble.style.transform = `translate(${x}px, ${y}px)`;
    words.style.setProperty("--at", `${Math.min(Math.max(90 - x, 0), 70) - Math.min(Math.max(x - width + 90, 0), 70)}px`); // keep it within the map
  }
  watch(show);
  return text => {
    remark = text;
    if (playback.main) show();
  };
}
