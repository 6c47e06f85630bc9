// The colours of blocks, dark enough for white text.

export const colours = { start: "#46506b", drive: "#4b45c9", turn: "#7a3fb5", light: "#a84c08", wait: "#856000", sensors: "#0b6a72", decide: "#1d6b3a",
  repeat: "#a3325f", numbers: "#47661c", names: "#a13a20", subs: "#872f8c", print: "#2d5c99", note: "#66604a", grey: "#656b75" };

const mixed = (colour, other, share) => "#" + [1, 3, 5].map(at => Math.round(parseInt(colour.slice(at, at + 2), 16) * (1 - share) + parseInt(other.slice(at, at + 2), 16) * share).toString(16).padStart(2, "0")).join("");

/** A theme in the page's own light or dark colours. */
export function theme_of(Blockly, root) {
  const own = getComputedStyle(root), colour = name => own.getPropertyValue(name).trim();
  const dark = colour("--card").toLowerCase() < "#8";
  const styles = Object.entries(colours);
  return new Blockly.Theme(`orb-${dark ? "dark" : "light"}`,
    Object.fromEntries(styles.map(([name, one]) => [`${name}_blocks`, { colourPrimary: one, colourSecondary: mixed(one, "#ffffff", .25), colourTertiary: mixed(one, dark ? "#ffffff" : "#000000", .3), ...name === "start" ? { hat: "cap" } : {} }])),
    Object.fromEntries(styles.map(([name, one]) => [`${name}_category`, { colour: one }])),
    { workspaceBackgroundColour: colour("--card"), toolboxBackgroundColour: colour("--desk"), toolboxForegroundColour: colour("--ink"),
      flyoutBackgroundColour: colour("--desk"), flyoutForegroundColour: colour("--ink"), flyoutOpacity: .97, scrollbarColour: colour("--soft"), scrollbarOpacity: .4,
      insertionMarkerColour: colour("--ink"), insertionMarkerOpacity: .3 });
}
