// Playback: the slider, the speed, the play button.

import { $, clamp, clock_text, element, seconds } from "./dom.js";
import { playback, seek, watch } from "./playback.js";

let last_frame = 0;
const live_delay = 400e3; // microseconds

export const slider = $("time");
const rates = [.1, .25, .5, 1, 2, 5, 10, 30, 60, 300];
for (const rate of rates) $("rate").append(element("option", { value: rate }, `${rate}×`));
export function set_rate() {
  $("rate").value = rates.find(rate => playback.end / 1e6 / rate <= 120 && rate >= 1) ?? 300;
}

export function set_playing(wanted) {
  playback.playing = wanted;
  if (playback.playing && playback.now >= playback.end) playback.now = 0;
  $("play").setAttribute("aria-label", playback.playing ? "Pause" : "Play");
  $("play-icon").setAttribute("d", playback.playing ? "M6 4h4v16H6zM14 4h4v16h-4z" : "M7 4l14 8-14 8z");
  last_frame = performance.now();
  if (playback.playing) requestAnimationFrame(frame);
}
function frame(stamp) {
  if (!playback.playing) return;
  const passed = Math.max(stamp - last_frame, 0);
  last_frame = stamp;
  // A live run is shown a little late, so that the ball rolls evenly from one piece to the next.
  if (playback.live) seek(clamp(playback.now + passed * 1000, playback.end - live_delay, playback.end));
  else seek(playback.now + passed * 1000 * Number($("rate").value));
  if (playback.now >= playback.end && !playback.live) set_playing(false);
  else requestAnimationFrame(frame);
}
$("play").addEventListener("click", () => set_playing(!playback.playing));
slider.addEventListener("input", () => seek(Number(slider.value)));
watch(() => {
  $("clock").textContent = clock_text(playback.now);
  slider.value = playback.now;
  slider.setAttribute("aria-valuetext", `${seconds(playback.now)} of ${seconds(playback.end)} seconds`);
});
