"""What calls take: each function returns the value, or raises an error with a sentence for one that does not fit."""
from __future__ import annotations

import operator
import typing

MOST_SEED = 2**64 - 1


def refuse(name: str, takes: str, value: object, kind: type[Exception] = TypeError) -> Exception:
    """The error that says what is taken instead of a value."""
    return kind(f"`{name}` is {takes}, not {value!r:.80}")


def text(name: str, value: object) -> str:
    if not isinstance(value, str):
        raise refuse(name, "a text", value)
    try:
        value.encode()
    except UnicodeEncodeError as error:
        raise ValueError(f"`{name}` holds what is no text: {value[error.start]!r}") from None
    return value


def whole(name: str, value: object, least: int, most: int) -> int:
    try:
        number = operator.index(value)
    except TypeError:
        raise refuse(name, f"a whole number from {least} to {most}", value) from None
    if not least <= number <= most:
        raise refuse(name, f"a whole number from {least} to {most}", value, ValueError)
    return number


def number(name: str, value: object) -> float:
    if not hasattr(value, "__float__"):
        raise refuse(name, "a number", value)
    return float(value)


def place(name: str, value: object) -> tuple[float, float]:
    try:
        x, y = value
        return number(name, x), number(name, y)
    except (TypeError, ValueError):
        raise refuse(name, "two numbers", value) from None


def yes_or_no(name: str, value: object) -> bool:
    if not isinstance(value, bool):
        raise refuse(name, "True or False", value)
    return value


def texts(name: str, value: object) -> list[str]:
    if isinstance(value, (str, bytes)) or not isinstance(value, typing.Iterable):
        raise refuse(name, "a list of texts", value)
    found = list(value)
    if not all(isinstance(one, str) for one in found):
        raise refuse(name, "a list of texts", found)
    return [text(name, one) for one in found]


def wholes(name: str, value: object) -> list[int]:
    try:
        return [operator.index(one) for one in value]
    except TypeError:
        raise refuse(name, "a list of whole numbers", value) from None
