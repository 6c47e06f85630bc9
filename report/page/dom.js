// Shared by the parts of the page: elements, numbers, and the words for them.

export const $ = id => document.getElementById(id);
const svg_ns = "http://www.w3.org/2000/svg";

/** Index of the last entry of ascending `list` that is not after `t`; -1 before the first. */
export function last_at(list, t) {
  let low = 0, high = list.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (list[middle] <= t) low = middle + 1; else high = middle;
  }
  return low - 1;
}

export const clamp = (value, low, high) => Math.min(Math.max(value, low), high);
/** Microseconds as seconds, cut off to whole milliseconds as in `orb run`. */
export const seconds = t => (Math.floor(t / 1000) / 1000).toFixed(3);
export function clock_text(t) {
  const minutes = Math.floor(t / 60e6);
  const rest = seconds(t % 60e6);
  return minutes ? `${minutes}:${rest.padStart(6, "0")}` : rest;
}
export const trim = (value, digits) => String(Number(value.toFixed(digits)));

export function element(name, attributes = {}, text) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  if (text !== undefined) made.textContent = text;
  return made;
}
export function shape(name, attributes, parent) {
  const made = document.createElementNS(svg_ns, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  if (parent) parent.append(made);
  return made;
}
export const css_color = rgb => "#" + rgb.toString(16).padStart(6, "0");
export const rgb_words = rgb => `${rgb >> 16}, ${rgb >> 8 & 255}, ${rgb & 255}`;
/** How bright a colour is, from 0 to 1: a pale or a deep one needs a different outline. */
export const brightness = rgb => (.3 * (rgb >> 16) + .59 * (rgb >> 8 & 255) + .11 * (rgb & 255)) / 255;
export const position_words = state => `${state.x.toFixed(1)}, ${state.y.toFixed(1)} cm`;
export const speed_words = state => `${state.speed.toFixed(1)} cm/s`;
export const length_words = cm => cm >= 100 ? `${trim(cm / 100, 2)} m` : `${trim(cm, 2)} cm`;

/** Scrolls only the pane, never the page. */
export function keep_in_view(pane, child) {
  const outer = pane.getBoundingClientRect(), inner = child.getBoundingClientRect();
  if (inner.top < outer.top || inner.bottom > outer.bottom)
    pane.scrollTop += inner.top - outer.top - pane.clientHeight / 2;
}
