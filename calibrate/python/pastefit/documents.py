"""JSON between Python and C++, and tables of it as NumPy arrays."""

import json
import math
from typing import Any, Dict, Iterable, Mapping, Sequence, Tuple

import numpy as np


def _plain(value: Any) -> Any:
    """What json does not know: numbers and arrays of NumPy, paths."""
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, np.ndarray):
        return value.tolist()
    return str(value)


def text_of(document: Any) -> str:
    """The document as JSON. Errors: ValueError for a number that is not finite."""
    return json.dumps(document, default=_plain, allow_nan=False)


def without_nan(value: float) -> Any:
    """The number, None if it is none."""
    number = float(value)
    return number if math.isfinite(number) else None


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
