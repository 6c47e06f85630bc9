import { addToCurves } from "./curves.js";
import { addToGround } from "./ground.js";
import { numbersOf, readyMatrix, showMatrix } from "./matrix.js";
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
    showMatrix(said.matrix);
  };
  source.onerror = () => {
    state.classList.add("lost");
    state.textContent = "`orb drive` has ended; the robot was told to stop";
  };
}

readyWheel();
readyMatrix();
document.getElementById("stop").addEventListener("click", letGo);
document.getElementById("ahead").addEventListener("click", () => post("ahead"));
document.getElementById("fastest").addEventListener("input", (event) => {
  document.getElementById("fastest-is").textContent = event.target.value;
});
document.getElementById("color").addEventListener("input", (event) => {
  const hex = event.target.value;
  post("color", numbersOf(hex));
});
document.getElementById("lamp").addEventListener("change", () => post("lamp"));
listen();
