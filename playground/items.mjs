// Reads what examples.mjs wrote.
import { readFileSync } from "node:fs";
import { join } from "node:path";

/** The groups of examples.json in the playground's folder, each item with all that it opens with. */
export function whole_groups(folder) {
  const read = name => JSON.parse(readFileSync(join(folder, name), "utf8"));
  return read("examples.json").groups.map(({ title, items }) => ({ title, items: items.map(item => ({ ...item, ...read(`examples/${item.id}.json`) })) }));
}
