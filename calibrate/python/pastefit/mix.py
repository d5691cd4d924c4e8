"""The card of a mix between the calibrated ones of a batch."""

import csv
import json
import math
import os
import pathlib
from typing import Any, Dict, List, Mapping, NamedTuple, Tuple, Union

import numpy as np

from . import _core
from .card import Card
from .faults import InputError

_FEWEST_CARDS = 3
_NORMAL = 1.96  # standard deviations of a 95 % interval


class _Anchor(NamedTuple):
    """A confirmed material of the batch, and where its mix stands."""

    at: float
    study: str
    card: Dict[str, Any]


def predicted_on_line(x: np.ndarray, y: np.ndarray, at: float) -> Tuple[float, float]:
    """A line through the points by least squares: its value at `at`, and half the width of Student's 95 % interval for one
    more point there,
        t(0.975; n - 2) s sqrt(1 + 1/n + (at - mean x)^2/sum (x - mean x)^2),   s^2 = sum of squares/(n - 2).
    """
    aside, count = x - x.mean(), len(x)
    slope = aside @ y / (aside @ aside)
    residuals = y - y.mean() - slope * aside
    deviation, away = math.sqrt(residuals @ residuals / (count - 2)), at - x.mean()
    student = _NORMAL * _core.widening(count - 1)
    return (float(y.mean() + slope * away),
            float(student * deviation * math.sqrt(1 + 1 / count + away**2 / (aside @ aside))))


def _model(card: Mapping[str, Any]) -> Any:
    """What all cards must share: the laws, the parameters that are fixed, and the bounds of the others."""
    material = card["material"]
    words = {key: value for key, value in material["contact"].items() if isinstance(value, str)}
    shape = material["contact"].get("bridge", {}).get("shape")
    fixed = {name: value for name, value in material["parameters"].items() if name not in material["free"]}
    return words, shape, fixed, material["free"]


def _anchors(folder: pathlib.Path, variable: str, value: float) -> List[_Anchor]:
    with (folder / "batch.csv").open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    known = [name for name in (rows[0] if rows else {}) if name.startswith(("mix.", "material."))]
    if variable not in known:
        raise InputError([(variable, "no laboratory file has this variable", f"one of: {', '.join(known)}")])
    anchors = sorted((_Anchor(float(row[variable]), row["study"], Card.load(folder / row["study"] / "card.json").content)
                      for row in rows if row["verdict"] == "confirmed" and row[variable]), key=lambda one: one.at)
    if len(anchors) < _FEWEST_CARDS:
        raise InputError([(str(folder), f"{len(anchors)} confirmed cards have {variable}",
                           f"at least {_FEWEST_CARDS}; calibrate more mixes with pastefit batch")])
    first, last = anchors[0].at, anchors[-1].at
    if not first <= value <= last or first == last:
        raise InputError([(variable, f"is {value:g}",
                           f"a value between those of the confirmed cards, {first:g} to {last:g}")])
    others = [one.study for one in anchors if _model(one.card) != _model(anchors[0].card)]
    if others:
        raise InputError([(study, f"has other contact laws, parameters or bounds than {anchors[0].study}",
                           "calibrate all mixes with the same") for study in others])
    return anchors


def _predicted_parameters(anchors: List[_Anchor], value: float) -> Dict[str, Tuple[float, float, float]]:
    """Of each fitted parameter value and interval, within the bounds of the study."""
    x, out = np.array([one.at for one in anchors]), {}
    for name, bounds in anchors[0].card["material"]["free"].items():
        along, back = (np.log, math.exp) if bounds["scale"] == "log" else (np.asarray, float)
        y = along([one.card["material"]["parameters"][name] for one in anchors])
        mean, half = predicted_on_line(x, y, value)
        out[name] = tuple(float(np.clip(back(end), bounds["lower"], bounds["upper"]))
                          for end in (mean, mean - half, mean + half))
    return out


def interpolate(folder: Union[str, "os.PathLike[str]"], variable: str, value: float) -> Card:
    """The card of a mix between those of a batch, predicted from their confirmed cards and not confirmed itself.

    `folder`: of the batch, with its batch.csv. `variable`: of the laboratory files, as that table names it, e.g.
    "mix.water_kg_m3"; at `value` each fitted parameter (its logarithm, where it was searched on a logarithmic scale) and
    the bulk density are predicted by a straight line. Apparatus and grains are those of the nearest mix. Nothing is
    simulated: the card has no readings. Its intervals are for one more material at this value; what the readings of a
    single mix leave open is not in them.

    Errors: `InputError` for a variable that no laboratory file has, fewer than three confirmed cards with it, a value that
    does not lie between theirs, and cards with other contact laws, parameters or bounds.
    """
    anchors = _anchors(pathlib.Path(folder), variable, value)
    nearest = min(anchors, key=lambda one: abs(one.at - value)).card
    predicted = _predicted_parameters(anchors, value)
    density, _ = predicted_on_line(np.array([one.at for one in anchors]),
                                   np.array([one.card["material"]["bulk_density_kg_m3"] for one in anchors]), value)
    card = json.loads(_core.card_with_parameters(json.dumps(nearest), {name: mean for name, (mean, _, _) in predicted.items()}))
    material = card["material"]
    ratio = density / material["bulk_density_kg_m3"]
    for kind in ("bulk_density_kg_m3", "grain_density_kg_m3"):
        material[kind] = material[kind] and material[kind] * ratio
    for one in card["tests"]:
        if "bulk_density_kg_m3" in one["test"]:
            one["test"]["bulk_density_kg_m3"] *= ratio
        one["lab"]["notes"] = "Apparatus of this laboratory file; its readings are of another mix. " + one["lab"]["notes"]
        one.pop("measured_yield_stress_pa", None)
    card.pop("rescaled", None)
    card["title"] = "a mix in between"
    card["intervals"] = {"method": f"prediction by a line over the mix from {len(anchors)} cards", "level": 0.95,
                         "parameters": {name: {"lower": low, "upper": high} for name, (_, low, high) in predicted.items()}}
    card["confirmation"] = {"packings": [], "fresh": False, "error": 0, "meets_laboratory": False}
    card["search"] = {"strategy": "interpolation", "status": "unconfirmed",
                      "reason": "The material was interpolated, and no reading of this mix was met.", "seed": 0, "packings": [],
                      "budget": 0, "simulations": 0, "failures": {}}
    card["provenance"]["program"] = _core.program_identity()
    card["interpolated"] = {"variable": variable, "value": value, "model": "linear",
                            "studies": [one.study for one in anchors]}
    return Card(card)
