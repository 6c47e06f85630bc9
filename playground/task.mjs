// Prepares a task of examples/lessons for the page.

/** Drops `../../` and a folder after it: all files are in one folder. */
export const flat = text => text.replaceAll(/\.\.\/\.\.\/(?:\w+\/)?/g, "");

/** Replaces a block with the `page:` comment after it, and drops terminal commands: the page has buttons. */
export function for_page(readme) {
  const blocks = flat(readme).trim().split(/\n\n+/), said = block => /^<!-- page: ([^]*) -->$/.exec(block ?? "")?.[1];
  return blocks.flatMap((block, i) => {
    if (said(block) || said(blocks[i + 1])) return said(block) ?? [];
    return block.split("\n").every(line => line.startsWith("    orb ")) ? [] : block;
  }).map(unwrapped).join("\n\n") + "\n";
}

/** The paragraph with the job, and the list after it if it leads to one. */
export function job_in(task) {
  const blocks = task?.trim().split("\n\n") ?? [], at = blocks.findIndex(block => /^\*\*[^*]+:\*\*/.test(block));
  return at < 0 ? undefined : blocks.slice(at, at + (blocks[at].endsWith(":**") ? 2 : 1)).join("\n\n");
}

/** Joins the lines of each paragraph and list item: the keys of translations/ have no line breaks. */
const unwrapped = block => block.startsWith("    ") ? block : block.replaceAll(/\n *(?!\d+\. |- )/g, " ");
