#!/usr/bin/env python3
"""The script for EDEMpy writes the card's material into a deck: run with a recording in EDEMpy's place.

usage: edem.py PROGRAM CARD
"""
import json
import subprocess
import sys
import tempfile
import types
from pathlib import Path


class Deck:
    """Records calls, in the signatures of public examples of EDEMpy."""

    def __init__(self, path, mode):
        self.path, self.mode, self.materials, self.interactions, self.saved = path, mode, {}, {}, False
        self.models = {"Hertz-Mindlin (no slip)": {}}

    def createMaterial(self, name, poisson, shear_modulus, density, work_function, is_bulk):
        assert name not in self.materials
        self.materials[name] = (poisson, shear_modulus, density, is_bulk)

    def createInteraction(self, one, other, restitution, static_friction, rolling_friction):
        assert one in self.materials and other in self.materials
        self.interactions[one, other] = (restitution, static_friction, rolling_friction)

    def deletePhysicsModelSurfSurf(self, name):
        del self.models[name]

    def createPhysicsModelSurfSurf(self, name, settings):
        self.models[name] = settings

    def save(self):
        self.saved = True


def deck_of(source):
    """The deck that the script writes."""
    made = []

    def opened(path, mode):
        made.append(Deck(path, mode))
        return made[-1]

    sys.modules["numpy"] = types.SimpleNamespace(array=lambda rows, dtype: rows)
    sys.modules["edempy"] = types.SimpleNamespace(Deck=opened)
    sys.argv = ["edem_material.py", "chute.dem"]
    exec(compile(source, "edem_material.py", "exec"), {"__name__": "__main__"})
    (deck,) = made
    assert deck.path == "chute.dem" and deck.mode == "w" and deck.saved
    return deck


def about(number, other):
    return abs(number - other) <= 1e-6 * abs(other)


def main(program, card_file):
    card = json.loads(Path(card_file).read_text())
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([program, "export", "--unconfirmed", card_file, "--to", "edem-notes", "--out", f"{folder}/edem"], check=True,
                       stdout=subprocess.DEVNULL)
        source = Path(folder, "edem/edem_material.py").read_text()
    deck = deck_of(source)
    fitted, contact = card["material"]["parameters"], card["material"]["contact"]
    assert set(deck.materials) == {"grains", "mould", "table"}, deck.materials
    poisson, shear_modulus, density, is_bulk = deck.materials["grains"]
    assert about(density, card["material"]["grain_density_kg_m3"]) and is_bulk
    assert about(shear_modulus, fitted["youngs_modulus_pa"] / 2 / (1 + poisson))
    restitution, friction, rolling = deck.interactions["grains", "grains"]
    assert about(restitution, fitted["restitution"]) and about(friction, fitted["friction"]) and about(rolling, fitted["rolling_friction"])
    for wall in ("mould", "table"):
        _, wall_modulus, _, is_bulk = deck.materials[wall]
        assert not is_bulk and wall_modulus > shear_modulus
        restitution, friction, rolling = deck.interactions["grains", wall]
        assert about(restitution, fitted["restitution"]) and about(friction, fitted[f"{wall}_friction"]), wall
        assert about(rolling, fitted[f"{wall}_rolling_friction"]), wall
    assert set(deck.models) == {"Hertz-Mindlin (no slip)"}  # the bridge of this card needs a plug-in
    assert contact["bridge"]["shape"] == "polynomial"

    sticks = deck_of(source.replace("SURFACE_ENERGY = None", "SURFACE_ENERGY = 0.5"))
    assert sticks.models == {"Hertz-Mindlin with JKR": {"data": [("grains", "grains", 0.5)]}}, sticks.models
    print(f"{len(deck.materials)} materials, {len(deck.interactions)} interactions")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
