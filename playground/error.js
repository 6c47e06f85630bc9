/** Why a call failed: `code` is the exit code that `orb` would have, "stopped" where its worker was ended, or "broken". */
export class OrbError extends Error {
  constructor({ code, message, findings }) {
    super(message);
    this.name = "OrbError";
    this.code = code;
    if (findings) this.findings = findings;
  }
}
