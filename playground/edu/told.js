// Formats findings of Edu programs for the terminal.

/** The lines of a source, without CRs. */
export const lines_of = source => source.split("\n").map(line => line.replace(/\r$/, ""));

/** Formats a finding of `check`, with its line. `name` and `lines` are the source's. */
export function text_of(name, lines, one) {
  const line = (lines[one.line - 1] ?? "").replaceAll("\t", " "), number = String(one.line);
  const wide = one.end_line > one.line ? line.trimEnd().length + 1 - one.column : one.end_column - one.column;
  const margin = " ".repeat(number.length), caret = `^${"~".repeat(Math.max(0, Math.min(wide, line.length + 1 - one.column) - 1))}`;
  return [`${name}:${one.line}:${one.column}: ${one.severity}[${one.rule}]: ${one.message}`,
    ...line.length <= 200 ? [`  ${number} | ${line}`, `  ${margin} | ${" ".repeat(one.column - 1)}${caret}`] : [],
    ...one.help ? [`  help: ${one.help}`] : []].join("\n");
}
