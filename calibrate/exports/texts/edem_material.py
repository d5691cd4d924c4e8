"""Creates the material of a card in an EDEM deck: materials, interactions and, for JKR, the surface energy of two grains.

usage: edem_material.py DECK.dem

Copy all files of the deck first, and run the script on the copy, with a Python that has EDEMpy, while EDEM does not have the
deck open. The deck must not have materials of these names, and has the contact model "Hertz-Mindlin (no slip)". What is
left is in edem.txt: @rest@, and the interactions of the grains with your own walls.
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
SURFACE_ENERGY = @energy@  # of two grains [J/m2]; None: another contact model


def write(path):
    deck = Deck(path, mode="w")
    for name, poisson, shear_modulus, density, bulk in MATERIALS:
        deck.createMaterial(name, poisson, shear_modulus, density, 0, bulk)  # 0: work function
    for interaction in INTERACTIONS:
        deck.createInteraction(*interaction)
    if SURFACE_ENERGY is not None:
        deck.deletePhysicsModelSurfSurf("Hertz-Mindlin (no slip)")
        columns = [("name1", "S256"), ("name2", "S256"), ("value", "<f8")]
        energies = np.array([("grains", "grains", SURFACE_ENERGY)], dtype=columns)
        deck.createPhysicsModelSurfSurf("Hertz-Mindlin with JKR", {"data": energies})
    deck.save()


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    write(sys.argv[1])
