import { addToCurves } from "./curves.js";
import { addToGround } from "./ground.js";
import { letGo, post, readyWheel } from "./wheel.js";

const state = document.getElementById("state");

function listen() {
  const source = new EventSource("events");
  source.onmessage = (event) => {
    const said = JSON.parse(event.data);
    document.getElementById("robot").textContent = `the ${said.robot}`;
    state.classList.remove("lost");
    state.textContent = said.words;
    const values = Object.fromEntries(said.values.map(([name, , number]) => [name, number]));
    addToGround(values.x, values.y, values.yaw);
    addToCurves(said.t, said.values);
  };
  source.onerror = () => {
    state.classList.add("lost");
    state.textContent = "`orb drive` has ended; the robot was told to stop";
  };
}

readyWheel();
document.getElementById("stop").addEventListener("click", letGo);
document.getElementById("ahead").addEventListener("click", () => post("ahead"));
document.getElementById("fastest").addEventListener("input", (event) => {
  document.getElementById("fastest-is").textContent = event.target.value;
});
document.getElementById("color").addEventListener("input", (event) => {
  const hex = event.target.value;
  post("color", [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16)).join(" "));
});
document.getElementById("lamp").addEventListener("change", () => post("lamp"));
listen();
