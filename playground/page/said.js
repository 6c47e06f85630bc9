// The parts of the engine's sentences (playground/engine/sentence_log.h), which are in English.

const most = 2000; // a run may produce a new one at each step
/** By whole sentence: `[TEXT, FILLER…]`, where a filler is such a list or plain words. */
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
