// Square: four sides, and home again.
async function startProgram() {
  setMainLed({ r: 255, g: 255, b: 0 });
  for (let side = 0; side < 4; side++) {
    await roll(0, 100, 1.2);
    await delay(0.5);
  }
}
