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

/** Schema `orb.check/1`: docs/reference/findings.md of orb. Lines and columns count from 1, columns in bytes. */
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
  /** True if a client is connected. */
  connected?: boolean;
  trace?: "json" | "csv";
  trace_lines?: boolean;
  /** Data for the player of orb's reports. */
  report?: boolean;
  /** If true, the run goes on until the ball has come to rest. */
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
/** Runs the test files that `names` names; `results` is of schema `orb.test/1`. In node programs of Sphero Edu are tested, too, on a BOLT. */
export function test(files: Files, options?: TestOptions): Promise<{ text: string; results: Record<string, unknown> }>;
/** The canonical layout. */
export function format(files: Files, options?: Named): Promise<string>;
/** The exact bytes that go to a robot. */
export function build(files: Files, options?: Named): Promise<Uint8Array>;
/** The macros of a file as bytes. */
export function assemble(files: Files, options?: Named): Promise<Macro[]>;
/** The version of orb. */
export function version(): Promise<string>;

export type Kind = "sphero" | "sprk+" | "bb8" | "ollie" | "mini" | "bolt" | "bolt+" | "rvr" | "bb9e" | "r2d2" | "r2q5";
export type Rgb = [red: number, green: number, blue: number];

export interface RobotOptions {
  /** Of noise, address and random numbers: the same seed gives the same bytes. */
  seed?: number;
  /** Where it starts, in cm, and which way it faces there, in degrees clockwise. */
  x?: number;
  y?: number;
  heading?: number;
  /** A bad link, such as "drop=1%,delay=50..300ms". */
  fault?: string;
  /** Of classic robots. */
  firmware?: string;
  /** False remembers nothing but the present, for thousands of robots. */
  journey?: boolean;
}

/** How a robot is at one moment: seconds, cm, degrees clockwise, cm/s. */
export interface RobotState {
  t: number;
  x: number;
  y: number;
  heading: number;
  speed: number;
  rgb: Rgb;
  back_led: number;
  /** 64 pixels, row by row from the bottom left; null while one colour fills it, or there is none. */
  matrix: Rgb[] | null;
  volts: number;
  /** Of its battery, percent. */
  charge: number;
  way: number;
  asleep: boolean;
  connected: boolean;
  running: boolean;
  driving: boolean;
  collisions: number;
  bumps: number;
}

/** A virtual robot: a client's bytes go in, its own come out, and time passes in advance() alone. What is wrong with an
 *  argument is an OrbError. */
export class Robot {
  private constructor();
  readonly kind: Kind;
  /** Its number in the engine. */
  readonly number: number;
  readonly title: string;
  /** As it advertises itself, such as SB-0001. */
  readonly name: string;
  /** Such as 68:86:E7:00:00:01. */
  readonly address: string;
  /** How it speaks over Bluetooth LE; bytes are pieces of at most `piece_bytes`. */
  readonly gatt: {
    protocol: "v1" | "v2";
    /** In the order of their handles; `properties` such as "read" and "write-without-response". */
    characteristics: [service: string, uuid: string, summary: string, properties: string[], value: Uint8Array][];
    greeting: [uuid: string, bytes: Uint8Array][];
    /** It answers nothing before the greeting. */
    is_deaf: boolean;
    /** So many seconds after it was connected it ends a link without a greeting; null: never. */
    patience: number | null;
    commands_uuid: string;
    answers_uuid: string;
    /** Empty for none. */
    advertised_service: string;
    piece_bytes: number;
  };
  connect(): void;
  disconnect(): void;
  readonly connected: boolean;
  write(bytes: ArrayLike<number>): void;
  advance(seconds: number): void;
  read(): Uint8Array;
  readonly now: number;
  readonly next_event: number | null;
  state(): RobotState;
  stimulus(line: string): void;
  reset(): void;
  fork(): Robot;
  journey(title?: string): { svg: string; report: Record<string, unknown> };
  close(): void;
}

/** Robots on one floor, which run into each other. */
export class World {
  private constructor();
  add(kind?: Kind, options?: RobotOptions & { name?: string }): Robot;
  readonly robots: Robot[];
  advance(seconds: number): void;
  reset(): void;
  close(): void;
}

/** A virtual robot alone on its floor; `course` is the text of an SVG with walls. */
export function robot(kind?: Kind, options?: RobotOptions & { course?: string }): Promise<Robot>;
export function world(options?: { course?: string }): Promise<World>;
