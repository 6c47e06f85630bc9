/** Why a call failed: `code` is the exit code of `orb`, "stopped" if the worker was ended, or "broken". */
export class OrbError extends Error {
  constructor({ code, message, findings }) {
    super(message);
    this.name = "OrbError";
    this.code = code;
    if (findings) this.findings = findings;
  }
}
