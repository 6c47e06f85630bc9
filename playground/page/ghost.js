// Shows on the map what the ball should have done: its place and colour. Also draws its mouth.

const far = 1e5; // centimetres: beyond what any map shows
const lamp_of = name => name && name !== "off" && CSS.supports("color", name) ? name : "";

/**
 * `map`: the player's drawing functions. The result shows ghosts with the next run: places, lines, zones, colours
 * from teacher.js.
 */
export function make_ghosts({ area, on_draw, redraw, shape }) {
  let wishes = [];

  function draw_face(parent, r, color) {
    shape("circle", { r, class: "ghost-body", ...color ? { fill: color } : {} }, parent);
    for (const side of [-1, 1]) shape("circle", { cx: side * r * .36, cy: -r * .25, r: r * .16, class: "ghost-eye" }, parent);
  }
  function draw_wishes(chart, ball, r) {
    const ghosts = shape("g", { class: "ghosts", "aria-hidden": "true" });
    const color = lamp_of(wishes.find(one => one.color)?.color), places = wishes.filter(({ by }) => by);
    for (const { x, y, by } of places) {
      const there = shape("g", { transform: `translate(${chart.point([x, y])})` }, ghosts);
      shape("circle", { r: Math.max(by * chart.scale, r), class: "ghost-room" }, there);
      draw_face(there, r * .8, color);
    }
    for (const { axis, at } of wishes.filter(one => one.axis)) {
      const ends = axis === "x" ? [[at, -far], [at, far]] : [[-far, at], [far, at]];
      shape("path", { d: `M${chart.point(ends[0])}L${chart.point(ends[1])}`, class: "ghost-room" }, ghosts);
    }
    for (const { zone } of wishes.filter(one => one.zone)) chart.map.querySelector(`[data-zone="${CSS.escape(zone)}"]`)?.classList.add("wanted");
    ball.before(ghosts);
    // A colour has no place: the ghost goes next to the ball.
    if (wishes.some(one => one.color) && !places.length) draw_face(shape("g", { class: "ghosts", "aria-hidden": "true", transform: `translate(${r * 2.4})` }, ball), r * .8, color);
  }

  on_draw((chart, { ball, nose }) => {
    const r = Number(ball.querySelector(".ball-body").getAttribute("r")), wide = r * .3, low = r * .42, bend = r * .24;
    for (const [name, way] of [["frown", -1], ["smile", 1]])
      shape("path", { class: `mouth ${name}`, d: `M${-wide} ${low}Q0 ${low + way * bend} ${wide} ${low}` }, nose);
    if (wishes.length) draw_wishes(chart, ball, r);
  });
  redraw(); // adds the ball's mouth

  return ghosts => {
    wishes = ghosts;
    area.also = ghosts.filter(({ by }) => by).flatMap(({ x, y, by }) => [[x - by, y - by], [x + by, y + by]]);
  };
}
