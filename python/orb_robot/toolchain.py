"""Programs, macros and tests: checked, run, built. Files are a text (a structured program) or a dictionary of names and
contents; the ending of a name says what it is: .orb, .bas, .macro, .test, .stimulus, .svg. The answers keep what
`orb` says in JSON in `json`."""
from __future__ import annotations

import dataclasses
import functools
import json
import typing

from . import _orb
from . import values as _values

Files = typing.Union[str, typing.Mapping[str, typing.Union[str, bytes]]]


class OrbError(Exception):
    """Why there is no answer; `code` is the exit code that `orb` would have, `findings` says where sources have
    mistakes."""

    def __init__(self, code: int, message: str, findings: Findings | None = None):
        super().__init__(f"{message}\n{findings}" if findings else message)
        self.code = code
        self.findings = findings


@dataclasses.dataclass(frozen=True)
class Finding:
    """One thing that is wrong, or may be. Lines and columns count from 1, columns in bytes."""

    file: str
    line: int
    column: int
    rule: str
    severity: str  #: error, warning or info
    message: str
    help: str  #: what to do instead; may be empty
    json: dict = dataclasses.field(repr=False)

    def __str__(self) -> str:
        return f"{self.file}:{self.line}:{self.column}: {self.severity}: {self.message}"


class Findings(typing.List[Finding]):
    """What was found, in the order of the files."""

    def __init__(self, document: dict):
        super().__init__(Finding(one["file"], one["line"], one["column"], one["rule"], one["severity"], one["message"],
                                 one.get("help", ""), one) for one in document["diagnostics"])
        self.json = document

    @property
    def errors(self) -> list[Finding]:
        return [one for one in self if one.severity == "error"]

    @property
    def warnings(self) -> list[Finding]:
        return [one for one in self if one.severity == "warning"]

    def __str__(self) -> str:
        return "\n".join(map(str, self)) or "no findings"


@dataclasses.dataclass(frozen=True)
class Run:
    """How a program ended on a virtual ball, and what it did."""

    prints: str
    reason: str  #: end, error, abort, time-limit, sleep or input
    seconds: float
    lines: int
    story: str  #: where it stopped and what it showed, in a sentence
    faults: list[dict]
    hint: str  #: what it waits for in vain
    json: dict = dataclasses.field(repr=False)


@dataclasses.dataclass(frozen=True)
class Macro:
    name: str
    id: int
    commands: bytes  #: a .sphero file
    image: bytes  #: with id and flags: a .bin file


@functools.lru_cache(maxsize=None)
def _engine() -> _orb.Engine:
    return _orb.Engine()


def _plain(value: bytes | bytearray | memoryview) -> dict:
    """Bytes as JSON, which has none."""
    return {"hex": bytes(value).hex(" ")}


def _bytes(value: dict) -> object:
    return bytes.fromhex(value["hex"]) if set(value) == {"hex"} and isinstance(value["hex"], str) else value


def _given(files: Files, name: str) -> dict[str, str | bytes]:
    """The files by name; a text alone is the file `name`."""
    if isinstance(files, str):
        files = {name: files}
    if not isinstance(files, typing.Mapping):
        raise _values.refuse("files", "a text or a dictionary of names and contents", files)
    for each, content in files.items():
        if not isinstance(each, str):
            raise TypeError(f"a file's name is a text, not {each!r}")
        if isinstance(content, str):
            _values.text(each, content)
        elif not isinstance(content, (bytes, bytearray, memoryview)):
            raise _values.refuse(each, "a text or bytes", content)
    return dict(files)


_TAKES = {
    "connected": _values.yes_or_no, "course": _values.text, "input": _values.wholes, "names": _values.texts,
    "only": _values.text, "report": _values.yes_or_no, "seeds": _values.text, "stimuli": _values.texts, "trace": _values.text,
    "line": lambda name, value: _values.whole(name, value, 1, 0xFFFF),
    "seed": lambda name, value: _values.whole(name, value, 0, _values.MOST_SEED),
    "for": _values.text,
}


def _call(method: str, files: Files, name: str = "program.orb", **options: object) -> dict:
    params = {"files": _given(files, name),
              **{key: _TAKES[key](key, value) for key, value in options.items() if value is not None}}
    answer = json.loads(_engine().call(json.dumps({"method": method, "params": params}, default=_plain)),
                        object_hook=_bytes)
    error = answer.get("error")
    if error:
        findings = error.get("findings")
        raise OrbError(error["code"], error["message"], Findings(findings) if findings else None)
    return answer["result"]


def check(files: Files, *, names: typing.Sequence[str] | None = None) -> Findings:
    """The mistakes in programs, macros, courses and tests; `names` says which files are meant, else the first."""
    return Findings(_call("check", files, names=names))


def run(files: Files, *, names: typing.Sequence[str] | None = None, seconds: float | None = None, seed: int = 1,
        input: typing.Sequence[int] = (), stimuli: typing.Sequence[str] = (), course: str | None = None,
        line: int | None = None, connected: bool = True, trace: str | None = None, report: bool = False) -> Run:
    """Runs a program or macro on a virtual ball, in virtual time, a minute of it unless `seconds` says otherwise.
    `stimuli` are names of scripts, or lines such as "at 2s shake"; `course` is the name of one of the files.
    OrbError says what is wrong with the sources."""
    limit = {} if seconds is None else {"for": f"{_values.number('seconds', seconds)}s"}
    answer = _call("run", files, names=names, seed=seed, input=input, stimuli=stimuli, course=course, line=line,
                   connected=connected, trace=trace, report=report, **limit)
    end = answer["ending"]
    return Run(answer["prints"], end["reason"], end["ms"] / 1000, end["lines"], end["story"], end["faults"],
               answer["hint"], answer)


def test(files: Files, *, names: typing.Sequence[str] | None = None, only: str | None = None,
         seeds: str | None = None) -> dict:
    """Runs test files: the document of `orb test --format json`, schema orb.test/1."""
    return _call("test", files, names=names, only=only, seeds=seeds)["results"]


def format(files: Files, *, names: typing.Sequence[str] | None = None) -> str:
    """The canonical layout of a text."""
    return _call("format", files, names=names)["text"]


def lift(files: Files, *, names: typing.Sequence[str] | None = None) -> str:
    """A numbered program as a structured one."""
    return _call("lift", files, "program.bas", names=names)["text"]


def build(files: Files, *, names: typing.Sequence[str] | None = None) -> bytes:
    """The exact bytes of a program that go to a robot."""
    return _call("build", files, names=names)["bytes"]


def assemble(files: Files, *, names: typing.Sequence[str] | None = None) -> list[Macro]:
    """The macros of a text as bytes."""
    return [Macro(one["name"], one["id"], one["sphero"], one["bin"])
            for one in _call("assemble", files, "program.macro", names=names)["macros"]]


def decode(data: bytes, *, direction: str = "to-robot") -> list[str]:
    """What packets mean, a sentence each; v1 or v2 by their first bytes. `direction` is "to-robot" or "from-robot"."""
    return _orb.decode(data, direction)


def encode(command: str, *values: object, kind: str = "bolt", seq: int = 0) -> bytes:
    """The packet of a command such as `drive-with-heading` or `roll`, by the packets that `kind` speaks.
    ValueError says which commands or values there are."""
    return _orb.encode(_values.text("kind", kind), _values.text("command", command), [str(value) for value in values],
                       _values.whole("seq", seq, 0, 0xFF))
