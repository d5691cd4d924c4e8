"""A material card: the contact law in numbers, how well it reproduces the measurement, and where it comes from."""

import json
import os
from typing import Any, Dict, Mapping, Sequence, Union

import numpy as np

from . import _core, html
from .documents import table, text_of

_COLUMNS = [("name", object), ("measured", float), ("tolerance", float), ("simulated", float), ("standard_error", float),
            ("difference", float), ("weight", float)]


def reading_table(rows: Sequence[Mapping[str, Any]]) -> np.ndarray:
    """Measured against simulated."""
    return table(rows, _COLUMNS)


class Card:
    """A calibrated material (data/schema/card.md). `content`: what the file says, as a dict.

    Errors: `InputError` with every fault of the content.
    """

    def __init__(self, content: Mapping[str, Any]) -> None:
        self._text = _core.card_from_json(text_of(content))

    @classmethod
    def load(cls, path: Union[str, "os.PathLike[str]"]) -> "Card":
        """Reads a card file."""
        card = cls.__new__(cls)
        card._text = _core.read_card(os.fspath(path))
        return card

    @property
    def content(self) -> Dict[str, Any]:
        """What the card's file says."""
        return json.loads(self._text)

    @property
    def title(self) -> str:
        return self.content["title"]

    @property
    def parameters(self) -> Dict[str, float]:
        """The scale-free parameters of its contact laws, by name."""
        return self.content["material"]["parameters"]

    @property
    def readings(self) -> np.ndarray:
        """Measured against simulated, a table of what the laboratory measured: name, measured, tolerance, simulated (mean
        of the packings), standard_error, difference, weight; each in the unit that the name says."""
        rows = []
        for test in self.content["tests"]:
            before = test["name"] + "/" if test.get("name") else ""
            rows += [{"name": before + name, **one} for name, one in test["readings"].items()
                     if one.get("measured") is not None]
        return reading_table(rows)

    @property
    def meets_laboratory(self) -> bool:
        """Whether it was confirmed on packings that the search had not seen."""
        return self.content["confirmation"]["meets_laboratory"]

    @property
    def verdict(self) -> str:
        """One sentence: whether the material reproduces the measurement."""
        return _core.card_verdict(self._text).strip()

    @property
    def summary(self) -> str:
        """The card as a person reads it."""
        return _core.card_summary(self._text)

    def save(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Writes the card as `pastefit` reads it."""
        with open(path, "w", encoding="utf-8") as file:
            json.dump(self.content, file, indent=2)
            file.write("\n")

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Card) and self.content == other.content

    def __repr__(self) -> str:
        return f"<Card {self.title!r}: {self.verdict}>"

    def _repr_html_(self) -> str:
        return html.card(self)
