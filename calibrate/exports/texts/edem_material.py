"""Writes the material of a card into a copy of an EDEM deck: materials, interactions, and surface
energies of JKR if the card has them.

usage, with the Python of EDEM (EDEMpy), while EDEM does not have the deck open: edem_material.py DECK.dem

Materials of these names must not exist in the deck. What is left is in edem.txt: @rest@.
Written after public examples of EDEMpy; not run in EDEM, because there was no licence for it.
"""
import sys

import numpy as np
from edempy import Deck

# name, Poisson's ratio, shear modulus [Pa], density [kg/m3], whether it is a bulk material
MATERIALS = [
@materials@]
# two names, restitution, static friction, rolling friction
INTERACTIONS = [
@interactions@]
# two names, surface energy [J/m2]
SURFACE_ENERGIES = [
@energies@]


def write(path):
    deck = Deck(path, mode="w")
    for name, poisson, shear_modulus, density, bulk in MATERIALS:
        deck.createMaterial(name, poisson, shear_modulus, density, 0, bulk)  # 0: work function
    for interaction in INTERACTIONS:
        deck.createInteraction(*interaction)
    if SURFACE_ENERGIES:
        deck.deletePhysicsModelSurfSurf("Hertz-Mindlin (no slip)")
        columns = [("name1", "S256"), ("name2", "S256"), ("value", "<f8")]
        deck.createPhysicsModelSurfSurf("Hertz-Mindlin with JKR", {"data": np.array(SURFACE_ENERGIES, dtype=columns)})
    deck.save()


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    write(sys.argv[1])
