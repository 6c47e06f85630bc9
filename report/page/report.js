// The page of one run: it holds what it plays back.

import { orb_player } from "./player.js";

const data = id => JSON.parse(document.getElementById(id).textContent);
const player = orb_player();
player.load(data("run"), data("before"));
player.seek_asked();
