// All texts about Edu programs; names in braces are holes. translations/ has them in other languages, keyed by the English,
// in the page's section.
export const texts = {
  TooLong: "the program is too long; {n} characters are the most",
  TooDeep: "this is nested too deeply",
  NoJavaScript: "this is not JavaScript",
  AwaitOutside: "`await` works only in an `async function`",
  OpenString: "the text between quotes does not end on this line",
  OpenComment: "the comment that begins with `/*` does not end",
  ReturnOutside: "`return` works only in a function",
  DeclaredTwice: "`{name}` is declared a second time",
  NeverClosed: "nothing closes the brace of line {n}",
  Conflict: "git has left both versions here; keep one of them, and none of these marks",
  WriteBelow: "write `{line}` below",
  TooManySigns: "this `{sign}` closes nothing",
  SignMissing: "`{sign}` is missing here",
  WordMissing: "`{word}` is missing here",
  WrongQuotes: "JavaScript knows only straight quotes",
  WriteLine: "write `{line}`",
  DeleteLine: "leave this line out",
  NoFunction: "there is no function `{name}`",
  NoName: "there is no `{name}`",
  NoMember: "`{name}` has no `{member}`",
  ItHas: "it has {names}",
  TakesColor: "`{operand}` of `{name}` is one value: a colour in braces",
  TooFew: "`{name}` also needs {names}",
  TooMany: "`{name}` takes {n} values at most",
  TakesNone: "`{name}` takes no values",
  Like: "write it like `{example}`",
  WrongKind: "`{name}` cannot use this as `{operand}`",
  OutOfRange: "`{operand}` is {least} to {most}, not {value}",
  TooLongText: "`{operand}` has {n} characters at most; the rest is left out",
  NoPart: "`{operand}` has no `{part}`; it has {names}",
  PartMissing: "`{operand}` lacks {names}",
  NoAwait: "without `await` the program does not wait for `{name}`",
  NotAsync: "the program does not wait for `{name}`: `{function}` is not an `async function`",
  WriteAsync: "write `async` before `function`, and `await` before the call",
  NotCalled: "`{name}` is not called without parentheses",
  NoTime: "no time passes in this loop, so it never ends",
  AddDelay: "write `await delay(0.025);` in it",
  TwoStarts: "there are two functions `startProgram`; only this last one runs",
  NoStart: "a program begins with a function `startProgram`, and there is none",
  NeverDrives: "this program never drives",
  EndsAtOnce: "the program ends here, and with it the drive",
  WaitBelow: "write `await delay(2);` below",
  Lacks: "{robot} has no `{name}`",
  Have: "these have it: {robots}",
  // At run time.
  EndlessLoop: "no time passes in this loop, so the program was ended",
  TooMuchAtOnce: "the program does more than {n} things at one moment, so it was ended",
  Exception: "the program stopped: {text}",
  Robot: "the robot does not go on: {text}",
  Silent: "the program did not let any time pass for {n} s, so it was ended",
  Forged: "the program sent what no program can send, so it was ended",
  Memory: "the program needs more memory than it may have",
  NotANumber: "`{operand}` of `{name}` is not a number: {value}",
};

/** Fills the holes of a text. */
export const fill = (text, holes = {}) => text.replace(/\{(\w+)\}/g, (whole, name) => name in holes ? String(holes[name]) : whole);

/** The text for the error of a run. */
export function words_of(error, say = fill) {
  const text = { "endless-loop": texts.EndlessLoop, "too-much-at-once": texts.TooMuchAtOnce, exception: texts.Exception, robot: texts.Robot, silent: texts.Silent, memory: texts.Memory, "not-a-number": texts.NotANumber, forged: texts.Forged }[error.rule] ?? texts.Exception;
  return say(text, { n: 4096, text: error.rule, ...error.holes });
}

/** The same, after its place in the program `name`. */
export const fault_at = (name, error, say) => `${name}${error.line ? `:${error.line}` : ""}: ${words_of(error, say)}`;
