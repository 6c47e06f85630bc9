// The page of one run, or of a room of balls; it contains the data.

import { orb_player } from "./player.js";

const data = id => JSON.parse(document.getElementById(id).textContent);
const player = orb_player();
const run = data("run");
if (run.balls) player.load_room(run);
else player.load(run, data("before"));
player.seek_asked();
