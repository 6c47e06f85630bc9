// A task of examples/lessons as the page gives it.

/** In one folder nothing is further up. */
export const flat = text => text.replaceAll(/\.\.\/\.\.\/(?:\w+\/)?/g, "");

/** A block is replaced by the comment `page:` that follows it, and what is to be typed into a terminal is a button there. */
export function for_page(readme) {
  const blocks = flat(readme).trim().split(/\n\n+/), said = block => /^<!-- page: ([^]*) -->$/.exec(block ?? "")?.[1];
  return blocks.flatMap((block, i) => {
    if (said(block) || said(blocks[i + 1])) return said(block) ?? [];
    return block.split("\n").every(line => line.startsWith("    orb ")) ? [] : block;
  }).map(unwrapped).join("\n\n") + "\n";
}

/** A paragraph is one line, and so is each entry of a list: the keys of translations/ have no ends of lines of their own. */
const unwrapped = block => block.startsWith("    ") ? block : block.replaceAll(/\n *(?!\d+\. |- )/g, " ");
