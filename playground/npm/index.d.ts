/**
 * Files by their names; the ending says what is in one: `.orb` (structured orbBasic), `.bas` (orbBasic with line
 * numbers), `.macro`, `.test`, `.stimulus`, `.svg` (a course). A text alone is a program in structured orbBasic.
 */
export type Files = string | Record<string, string | Uint8Array>;

/** What goes wrong as a result of the input; `code` is the exit code that `orb` would have. */
export class OrbError extends Error {
  code: number;
  /** Where sources have mistakes: what check() says of them. */
  findings?: Findings;
}

/** Schema `orb.check/1`: docs/findings.md of orb. Lines and columns count from 1, columns in bytes. */
export interface Findings {
  schema: "orb.check/1";
  diagnostics: Finding[];
  summary: { files: number; errors: number; warnings: number; bytes: Record<string, number> };
}
export interface Place {
  line: number;
  column: number;
  endLine: number;
  endColumn: number;
}
export interface Finding extends Place {
  file: string;
  rule: string;
  severity: "error" | "warning" | "info";
  message: string;
  /** The line number of a program that has such. */
  basicLine?: number;
  /** What the robot would report. */
  robotError?: number;
  help?: string;
  fix?: { title: string; safety: "safe" | "unsafe"; edits: (Place & { text: string })[] };
  notes?: (Place & { message: string })[];
}

export interface Named {
  /** Which of the files are meant; else the first. */
  names?: string[];
}

export interface RunOptions extends Named {
  /** Robot time after which the run is stopped, such as "90s"; "0" for never. */
  for?: string;
  seed?: number;
  /** Numbers for `input`. */
  input?: number[];
  /** Names of scripts, or lines such as "at 2s shake" and "wall y=80". */
  stimuli?: string[];
  /** The name of an SVG file: walls and zones. */
  course?: string;
  /** Where a program with line numbers starts. */
  line?: number;
  /** Whether a client is connected. */
  connected?: boolean;
  trace?: "json" | "csv";
  trace_lines?: boolean;
  /** Data for the player of orb's reports. */
  report?: boolean;
  /** Whether the run goes on until the ball has rolled out. */
  until?: "quiet" | "rest";
}

export interface Fault {
  file: string;
  line: number;
  column: number;
  robot_line: number;
  code: number;
  message: string;
  seen: string;
  variables: string;
  finding: string;
  help: string;
  /** All of it as `orb run` prints it. */
  text: string;
}

export interface Ran {
  ending: {
    reason: "end" | "error" | "abort" | "time-limit" | "sleep" | "input";
    ms: number;
    lines: number;
    words: string;
    story: string;
    waits_for: string;
    aborted: string;
    faults: Fault[];
  };
  /** What the program waits for in vain, and the option that brings it about. */
  hint: string;
  prints: string;
  trace?: string;
  report?: Record<string, unknown>;
}

export interface TestOptions extends Named {
  programs?: string[];
  only?: string;
  /** Such as "1..20". */
  seeds?: string;
}

export interface Macro {
  name: string;
  id: number;
  /** The commands: a `.sphero` file. */
  sphero: Uint8Array;
  /** With id and flags: a `.bin` file. */
  bin: Uint8Array;
}

/** The mistakes in programs, macros, courses and tests. */
export function check(files: Files, options?: Named): Promise<Findings>;
/** Runs a program or macro on a virtual ball, in virtual time. Rejects where it has errors. */
export function run(files: Files, options?: RunOptions): Promise<Ran>;
/** Runs the test files that `names` names; `results` is of schema `orb.test/1`. */
export function test(files: Files, options?: TestOptions): Promise<{ text: string; results: Record<string, unknown> }>;
/** The canonical layout. */
export function format(files: Files, options?: Named): Promise<string>;
/** The exact bytes that go to a robot. */
export function build(files: Files, options?: Named): Promise<Uint8Array>;
/** The macros of a file as bytes. */
export function assemble(files: Files, options?: Named): Promise<Macro[]>;
/** The version of orb. */
export function version(): Promise<string>;
