"""JSON between Python and C++, and tables of it as NumPy arrays."""

import json
import math
import numbers
from typing import Any, Dict, Iterable, Iterator, Mapping, Optional, Sequence, Tuple

import numpy as np

from .faults import InputError


def _plain(value: Any) -> Any:
    """What json does not know: numbers and arrays of NumPy, paths."""
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, np.ndarray):
        return value.tolist()
    return str(value)


def _is_finite(number: Any) -> bool:
    try:
        return math.isfinite(number)
    except OverflowError:  # a whole number beyond any floating one
        return False


def _faults_in(value: Any, place: str) -> Iterator[Tuple[str, str, str]]:
    """What of a document no JSON can hold, with its place."""
    if isinstance(value, (np.generic, np.ndarray)):
        value = _plain(value)
    if isinstance(value, Mapping):
        for key, one in value.items():
            if not isinstance(key, str) or printable(key) != key:
                yield place or "a key", f"has the key {key!r:.60}", "keys that are text, without lone surrogates"
                continue
            yield from _faults_in(one, f"{place}.{key}" if place else key)
    elif isinstance(value, (list, tuple)):
        for number, one in enumerate(value):
            yield from _faults_in(one, f"{place}[{number}]")
    elif isinstance(value, (int, float)) and not _is_finite(value):
        shown = str(value) if isinstance(value, float) else "a whole number that is too large"
        yield place, f"is {shown}", "a finite number; leave out what is missing"
    elif isinstance(value, str) and printable(value) != value:
        yield place, "is not text that UTF-8 can hold", "text without lone surrogates"


def printable(text: str) -> str:
    """The text with a question mark for what UTF-8 cannot hold."""
    return text.encode("utf-8", "replace").decode("utf-8")


def text_of(document: Any) -> str:
    """The document as JSON. Errors: `InputError` for each number, text and key that JSON cannot hold, with its place."""
    faults = list(_faults_in(document, ""))
    if faults:
        raise InputError(faults)
    return json.dumps(document, default=_plain, allow_nan=False)


def number_of(value: Any) -> Optional[float]:
    """A number of Python or NumPy, also as an array without dimensions; None if it is none, NaN is one."""
    if isinstance(value, np.ndarray) and value.ndim == 0:
        value = value.item()
    if isinstance(value, (bool, np.bool_)) or not isinstance(value, numbers.Real):
        return None
    try:
        return float(value)
    except OverflowError:
        return math.inf


def table(rows: Sequence[Mapping[str, Any]], columns: Iterable[Tuple[str, Any]]) -> np.ndarray:
    """Rows as a structured array with these (name, dtype) columns; NaN where a row has no number.

    `table["friction"]` is a column; `pandas.DataFrame(table)` takes it as it is.
    """
    kinds = list(columns)
    out = np.empty(len(rows), dtype=kinds)
    for name, kind in kinds:
        missing = {float: math.nan, bool: False, int: 0}.get(kind, "")
        values = [row.get(name) for row in rows]
        out[name] = [missing if value is None else kind(value) if kind in (float, bool, int) else value
                     for value in values]
    return out


def merged(document: Dict[str, Any], changes: Mapping[str, Any]) -> Dict[str, Any]:
    """A copy of the document with these changes; objects are merged key by key, None takes a key away."""
    out = dict(document)
    for key, value in changes.items():
        if value is None:
            out.pop(key, None)
        elif isinstance(value, Mapping) and isinstance(out.get(key), dict):
            out[key] = merged(out[key], value)
        else:
            out[key] = value
    return out
