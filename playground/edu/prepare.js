// Prepares a program's text for the sandbox: keeps its lines, and adds a call to each loop and function that counts turns,
// so that an endless one is ended with an error that names its line. Loops that await something pause there.

/** The children of a node. */
export function children(node) {
  const all = [];
  for (const key in node) {
    const value = node[key];
    if (Array.isArray(value)) { for (const one of value) if (one && typeof one.type === "string") all.push(one); }
    else if (value && typeof value.type === "string") all.push(value);
  }
  return all;
}
/** A node and all below it, in no particular order. */
export function* nodes(tree) {
  const left = [tree];
  while (left.length) {
    const node = left.pop();
    yield node;
    left.push(...children(node));
  }
}

const is_function = node => /Function/.test(node.type);
const loops = new Set(["WhileStatement", "DoWhileStatement", "ForStatement", "ForInStatement", "ForOfStatement"]);
export const is_loop = node => loops.has(node.type);

/** True if `wanted` holds for a node below this one, in the same function. */
export function below(node, wanted) {
  const left = children(node);
  while (left.length) {
    const one = left.pop();
    if (wanted(one)) return true;
    if (!is_function(one)) left.push(...children(one));
  }
  return false;
}
export const awaits = node => node.type === "AwaitExpression" || node.type === "ForOfStatement" && node.await;

export function prepare(source, tree) {
  const inserts = []; // [place, 0 begins, 1 ends or 2 names something, text]
  let number = 0;
  const left = [[tree, false]];
  while (left.length) {
    const [node, in_async] = left.pop();
    const line = node.loc?.start.line ?? 0;
    let inside = in_async;
    if (is_function(node)) {
      inside = node.async;
      if (node.body.type === "BlockStatement") enter(node.body, `__turn(${line});`);
    } else if (is_loop(node)) {
      const call = in_async && (awaits(node) || below(node, awaits)) ? `await __pause(${line}, ${number++});` : `__turn(${line});`;
      if (node.body.type === "BlockStatement") enter(node.body, call);
      else inserts.push([node.body.start, 0, `{ ${call} `], [node.body.end, 1, " }"]);
    }
    if (node.type === "ThrowStatement") inserts.push([node.argument.start, 0, `__at(${line}, `], [node.argument.end, 1, ")"]);
    if (node.type === "ImportExpression") inserts.push([node.start, 2, "__"]);
    for (const one of children(node)) left.push([one, inside]);
  }
  /** Inserts a call at the start of a block, after directives such as "use strict". */
  function enter(block, call) {
    const directives = block.body.filter(one => one.directive !== undefined);
    inserts.push([directives.length ? directives.at(-1).end : block.start + 1, 0, directives.length ? `;${call}` : ` ${call}`]);
  }
  // Where one statement ends and another begins, the end comes first.
  let text = "", from = 0;
  const order = [1, 0, 2]; // what ends, what begins, a name
  const sorted = inserts.map(([place, kind, piece], i) => [place, order.indexOf(kind), i, piece]).sort((a, b) => a[0] - b[0] || a[1] - b[1] || a[2] - b[2]);
  for (const [place, , , piece] of sorted) {
    text += source.slice(from, place) + piece;
    from = place;
  }
  return text + source.slice(from);
}
