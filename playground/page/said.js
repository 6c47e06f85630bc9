// What the engine's sentences are made of (playground/engine/said.h): it says them in English.

const most = 2000; // a run may say a new one at each step
/** By the whole sentence: `[TEXT, FILLER…]`, where a filler is such a list, or words as they are. */
export const made_of = new Map();
export function learn(said) {
  for (const [sentence, parts] of Object.entries(said)) {
    made_of.delete(sentence);
    made_of.set(sentence, parts);
  }
  const limit = Math.max(most, Object.keys(said).length);
  for (const oldest of made_of.keys()) {
    if (made_of.size <= limit) break;
    made_of.delete(oldest);
  }
}
