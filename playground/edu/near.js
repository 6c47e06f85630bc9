/** Counts letters changed, left out, put in, or swapped; `most` + 1 if the lengths alone differ by more. */
function distance(a, b, most) {
  if (Math.abs(a.length - b.length) > most) return most + 1;
  let before = [], row = Array.from({ length: b.length + 1 }, (_, i) => i);
  for (let i = 1; i <= a.length; ++i) {
    const next = [i];
    for (let j = 1; j <= b.length; ++j) {
      next[j] = Math.min(row[j] + 1, next[j - 1] + 1, row[j - 1] + (a[i - 1] === b[j - 1] ? 0 : 1));
      if (i > 1 && j > 1 && a[i - 1] === b[j - 2] && a[i - 2] === b[j - 1]) next[j] = Math.min(next[j], before[j - 2] + 1);
    }
    before = row;
    row = next;
  }
  return row[b.length];
}

/** The name that is probably meant; undefined if none is near enough or two are equally near. */
export function near(name, names) {
  if (name.length > 60) return undefined;
  const plain = name.toLowerCase();
  const same = names.find(one => one.toLowerCase() === plain && one !== name);
  if (same) return same;
  const most = Math.floor(name.length / 4) + (name.length > 2 ? 1 : 0);
  let best, least = most + 1, tie = false;
  for (const one of new Set(names)) {
    if (one === name) continue;
    const far = distance(plain, one.toLowerCase(), most);
    if (far < least) [best, least, tie] = [one, far, false];
    else if (far === least && far <= most) tie = true;
  }
  return least <= most && !tie ? best : undefined;
}
