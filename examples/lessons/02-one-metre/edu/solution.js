// One metre straight ahead.
async function startProgram() {
  setMainLed({ r: 0, g: 0, b: 255 });
  await roll(0, 100, 1.3);
  await delay(1);
}
