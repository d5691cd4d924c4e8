"""What is done with a card: written for another program, and checked."""

import json
import os
import pathlib
from typing import Any, Dict, List, NamedTuple, Optional, Sequence, Union

import numpy as np

from . import _core, interrupt
from .card import Card
from .documents import number_of, table
from .faults import InputError, seed_faults, threads_faults

CardOrPath = Union[Card, str, "os.PathLike[str]"]


def _card_of(card: CardOrPath) -> Card:
    return card if isinstance(card, Card) else Card.load(card)


class Export(NamedTuple):
    """A card in the words of another program. files: content by name, NOTES.txt among them. notes: what that program
    cannot represent. instructions: how to run it."""

    files: Dict[str, str]
    notes: List[str]
    instructions: str


def export_targets() -> Dict[str, str]:
    """The programs that a card can be written for, and what is written, by name."""
    return dict(_core.export_targets())


def export(card: CardOrPath, *, to: str, out: Union[str, "os.PathLike[str]", None] = None, test: str = "",
           packing: Optional[int] = None, force: bool = False, unconfirmed: bool = False) -> Export:
    """Writes a card for another program (`export_targets`).

    out: folder for the files; without it they are only returned. test: which one of a card that has several. packing: seed
    of the random packing that fills the mould; without it the test's own. force: replace files that are there.
    unconfirmed: export a card that is not confirmed; every file then begins with why it is not.
    Errors: `InputError`.
    """
    if faults := seed_faults("packing", packing):
        raise InputError(faults)
    file = "card.json" if isinstance(card, Card) else os.fspath(card)
    text = _card_of(card)._text
    written = Export(**json.loads(interrupt.run(lambda: _core.export(text, to, file, test, packing, unconfirmed))))
    if out is None:
        return written
    folder = pathlib.Path(out)
    there = [name for name in written.files if (folder / name).exists()]
    if there and not force:
        raise InputError([(f"out {folder}", f"holds an earlier result ({there[0]})",
                           "choose another folder, or replace it with force=True")])
    for name, content in written.files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(content, encoding="utf-8")
    return written


class Check(NamedTuple):
    """Whether a card still holds. verdict: "agrees", "disagrees" or "not checked". bits: "same", "other" or "not
    comparable". readings: a table: name, expected, got, band."""

    verdict: str
    bits: str
    reason: str
    readings: np.ndarray


def check(card: CardOrPath, *, against: Union[str, "os.PathLike[str]", None] = None, quick: bool = False,
          bits: bool = False, false_alarm: float = 1e-3, threads: int = 0) -> Check:
    """Simulates again what a card promises, or judges it by another laboratory file (`against`).

    quick: two packings of each test only. bits: other bits are a disagreement, whichever program made the card.
    false_alarm: probability to call a card wrong although nothing changed. threads: simulations at the same time, 0 for one
    of each core. Errors: `InputError`.
    """
    faults = threads_faults(threads)
    if not 1e-9 <= (number_of(false_alarm) or 0) <= 0.5:
        faults.append(("false_alarm", f"is {false_alarm!r:.60}", "a probability from 1e-9 to 0.5"))
    if faults:
        raise InputError(faults)
    stop, text = _core.Stop(), _card_of(card)._text
    lab = os.fspath(against) if against is not None else ""
    answer = json.loads(interrupt.run(lambda: _core.check(text, quick, false_alarm, bits, threads, lab, stop), stop))
    rows = [{"name": name, **one} for name, one in answer["readings"].items()]
    return Check(answer["verdict"], answer["bits"], answer["reason"], table(rows, [
        ("name", object), ("expected", float), ("got", float), ("band", float), ("agrees", bool)]))


class Verification(NamedTuple):
    """The contact laws against closed forms. failed: checks that do not hold; known_deviations: that their case explains.
    rows: every check at every point, a table: case, point, reading, expected, got, error, tolerance, verdict."""

    checks: int
    failed: int
    known_deviations: int
    rows: np.ndarray


def verify(cases: Sequence[str] = ()) -> Verification:
    """Compares the engine with closed forms: these physics cases (names of shipped ones, or files), or all that are
    shipped. Errors: `InputError`."""
    answer: Dict[str, Any] = json.loads(interrupt.run(lambda: _core.verify([os.fspath(case) for case in cases])))
    rows = [{"expected": row.get("at_most"), **row, "case": case["case"]} for case in answer["cases"]
            for row in case["rows"]]
    columns = [("case", object), ("point", object), ("reading", object), ("expected", float), ("got", float),
               ("error", float), ("tolerance", float), ("verdict", object)]
    return Verification(answer["checks"], answer["failed"], answer["known_deviations"], table(rows, columns))
