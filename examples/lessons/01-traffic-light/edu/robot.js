// Traffic light: red, yellow, green.
async function startProgram() {
  setMainLed({ r: 255, g: 0, b: 0 });
  await delay(2);
}
