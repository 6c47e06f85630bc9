// What the ball says: what the program has printed last stands over the ball.

import { playback, watch } from "../../report/page/playback.js";
import { $, element } from "./dom.js";

const stays = 2_500_000; // microseconds of the robot
const longest = 60; // letters

/** What was printed last before `now`, not long ago; empty for nothing. */
function said(events, now) {
  for (let i = events.length - 1; i >= 0 && events[i].t > now - stays; --i)
    if (events[i].kind === "print" && events[i].t <= now) return events[i].text.trim();
  return "";
}

/** `greeting`: what it says before the first run. */
export function set_up_bubble({ greeting }) {
  const words = element("span"), bubble = element("p", { class: "bubble", "aria-hidden": "true", hidden: true }, words);
  $("map").parentElement.append(bubble);
  let shown = "";
  watch(() => {
    const idle = $("played").classList.contains("idle"), text = idle ? greeting : said(playback.main.run.events, playback.now);
    if (text !== shown) {
      words.translate = idle; // what a program prints is its own
      shown = text;
      bubble.hidden = !text;
      words.textContent = text.length > longest ? `${text.slice(0, longest)}…` : text;
    }
    if (!text) return;
    const [x, y] = $("ball").getAttribute("transform").match(/-?[\d.]+/g).map(Number);
    const { width } = $("map").viewBox.baseVal;
    bubble.style.transform = `translate(${x}px, ${y}px)`;
    words.style.setProperty("--at", `${Math.min(Math.max(90 - x, 0), 70) - Math.min(Math.max(x - width + 90, 0), 70)}px`); // stays within the map
  });
}
