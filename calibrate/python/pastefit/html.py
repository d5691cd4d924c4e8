"""Cards and results as HTML, for notebooks."""

from html import escape
from typing import TYPE_CHECKING, Any, Iterable, Sequence

import numpy as np

if TYPE_CHECKING:
    from .card import Card

_WIDTH, _ROW = 360, 26  # of the drawing [px]
_REACH = 2  # tolerances that it shows on either side


def _cell(value: Any) -> str:
    if isinstance(value, (float, np.floating)):
        return "" if np.isnan(value) else f"{value:.4g}"
    return escape(str(value))


def rows(names: Sequence[str], lines: Iterable[Sequence[Any]]) -> str:
    """A table with these columns."""
    head = "".join(f"<th>{escape(name)}</th>" for name in names)
    body = "".join("<tr>" + "".join(f"<td>{_cell(value)}</td>" for value in line) + "</tr>" for line in lines)
    return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"


def drawing(readings: np.ndarray) -> str:
    """Each reading's difference from the laboratory in its tolerance, as SVG: the band of the tolerance, the simulated
    mean and twice its standard error."""
    judged = [one for one in readings if one["tolerance"] > 0]
    def x(tolerances: float) -> float:
        return _WIDTH * (0.5 + 0.5 * float(np.clip(tolerances, -_REACH, _REACH)) / _REACH)
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{_WIDTH + 200}" height="{_ROW * len(judged) + 18}" '
             'font-family="sans-serif" font-size="12">']
    for k, one in enumerate(judged):
        y = _ROW * k + _ROW / 2
        off, error = one["difference"] / one["tolerance"], 2 * np.nan_to_num(one["standard_error"]) / one["tolerance"]
        colour = "#1b6ca8" if abs(off) <= 1 else "#c0392b"
        parts.append(
            f'<rect x="{x(-1):.1f}" y="{y - 9:.1f}" width="{x(1) - x(-1):.1f}" height="18" fill="#e6eef5"/>'
            f'<line x1="{x(0):.1f}" x2="{x(0):.1f}" y1="{y - 9:.1f}" y2="{y + 9:.1f}" stroke="#888"/>'
            f'<line x1="{x(off - error):.1f}" x2="{x(off + error):.1f}" y1="{y:.1f}" y2="{y:.1f}" stroke="{colour}" '
            f'stroke-width="2"/><circle cx="{x(off):.1f}" cy="{y:.1f}" r="4" fill="{colour}"/>'
            f'<text x="{_WIDTH + 8}" y="{y + 4:.1f}">{escape(one["name"])}</text>')
    parts.append(f'<text x="{x(-1):.1f}" y="{_ROW * len(judged) + 13}" text-anchor="middle">-1</text>'
                 f'<text x="{x(1):.1f}" y="{_ROW * len(judged) + 13}" text-anchor="middle">1 tolerance</text></svg>')
    return "".join(parts)


def readings(title: str, sentence: str, shown: np.ndarray) -> str:
    """A title, a sentence, readings as a table and as a drawing."""
    columns = ("name", "measured", "tolerance", "simulated", "difference")
    return (f"<h4>{escape(title)}</h4><p>{escape(sentence)}</p>"
            + rows(columns, ([one[column] for column in columns] for one in shown)) + drawing(shown))


def card(shown: "Card") -> str:
    """Title, verdict and readings of a card."""
    return readings(shown.title, shown.verdict, shown.readings)
