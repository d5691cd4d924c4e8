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
    made = []

    def __init__(self, path, mode):
        self.path, self.mode, self.materials, self.interactions, self.saved = path, mode, {}, {}, False
        Deck.made.append(self)

    def createMaterial(self, name, poisson, shear_modulus, density, work_function, is_bulk):
        assert name not in self.materials
        self.materials[name] = (poisson, shear_modulus, density, is_bulk)

    def createInteraction(self, one, other, restitution, static_friction, rolling_friction):
        assert one in self.materials and other in self.materials
        self.interactions[one, other] = (restitution, static_friction, rolling_friction)

    def save(self):
        self.saved = True


def about(number, other):
    return abs(number - other) <= 1e-6 * abs(other)


def main(program, card_file):
    card = json.loads(Path(card_file).read_text())
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([program, "export", "--unconfirmed", card_file, "--to", "edem-notes", "--out", f"{folder}/edem"], check=True,
                       stdout=subprocess.DEVNULL)
        source = Path(folder, "edem/edem_material.py").read_text()
        sys.modules["numpy"] = types.SimpleNamespace()  # used for surface energies only, which this card has not
        sys.modules["edempy"] = types.SimpleNamespace(Deck=Deck)
        sys.argv = ["edem_material.py", "chute.dem"]
        exec(compile(source, "edem_material.py", "exec"), {"__name__": "__main__"})
    (deck,) = Deck.made
    fitted = card["material"]["parameters"]
    assert deck.path == "chute.dem" and deck.mode == "w" and deck.saved
    assert set(deck.materials) == {"grains", "mould", "table"}, deck.materials
    poisson, shear_modulus, density, is_bulk = deck.materials["grains"]
    assert about(density, card["material"]["grain_density_kg_m3"]) and is_bulk
    assert about(shear_modulus, fitted["youngs_modulus_pa"] / 2 / (1 + poisson))
    restitution, friction, rolling = deck.interactions["grains", "grains"]
    assert about(restitution, fitted["restitution"]) and about(friction, fitted["friction"]) and about(rolling, fitted["rolling_friction"])
    for wall in ("mould", "table"):
        assert not deck.materials[wall][3]
        assert about(deck.interactions["grains", wall][1], fitted[f"{wall}_friction"]), wall
    print(f"{len(deck.materials)} materials, {len(deck.interactions)} interactions")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
