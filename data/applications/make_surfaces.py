#!/usr/bin/env python3
"""Writes the STL files of the applications in this folder, in mm. Every surface is made of quadrilaterals."""

import math
import pathlib

HERE = pathlib.Path(__file__).resolve().parent


def facets(quads):
    """Two triangles for each quadrilateral, given by its corners in order."""
    for a, b, c, d in quads:
        yield a, b, c
        yield a, c, d


def write(name, quads):
    lines = [f"solid {name}"]
    for corners in facets(quads):
        lines += ["facet normal 0 0 0", " outer loop"]
        lines += ["  vertex {:.6g} {:.6g} {:.6g}".format(*at) for at in corners]
        lines += [" endloop", "endfacet"]
    (HERE / f"{name}.stl").write_text("\n".join(lines + [f"endsolid {name}", ""]))


def panel(origin, along, across, parts=1):
    """A parallelogram, divided along its first side."""
    def at(share, side):
        return tuple(o + share * a + side * b for o, a, b in zip(origin, along, across))
    return [(at(n / parts, 0), at((n + 1) / parts, 0), at((n + 1) / parts, 1), at(n / parts, 1)) for n in range(parts)]


def chute():
    """A floor of 40 degrees from (-100, 1000) down to (900, 161) in x and z, 400 wide, with walls on three sides."""
    fall = (1000, 0, -1000 * math.tan(math.radians(40)))
    top, up = (-100, -200, 1000), (0, 0, 250)
    return (panel(top, fall, (0, 400, 0), 6) + panel(top, fall, up, 6) + panel((-100, 200, 1000), fall, up, 6)
            + panel(top, (0, 400, 0), up))


def ring(low_radius, low, high_radius, high, sectors=24):
    """Lateral surface of a frustum around the z axis."""
    def at(sector, radius, height):
        angle = 2 * math.pi * sector / sectors
        return radius * math.cos(angle), radius * math.sin(angle), height
    return [(at(n, low_radius, low), at(n + 1, low_radius, low), at(n + 1, high_radius, high), at(n, high_radius, high))
            for n in range(sectors)]


def square(half, height, at=(0, 0)):
    return panel((at[0] - half, at[1] - half, height), (2 * half, 0, 0), (0, 2 * half, 0))


def blade():
    """Two arms of a paddle, 45 degrees oblique, and their shaft."""
    arms = []
    for side in (1, -1):
        arms += panel((side * 20, side * -30, 15), (side * 150, 0, 0), (0, side * 60, 60), 2)
    return arms + ring(20, 15, 20, 300, 8)


if __name__ == "__main__":
    write("chute", chute())
    write("hopper", ring(100, 0, 200, 260) + ring(200, 260, 200, 700))
    write("hopper_gate", square(120, -2))
    write("mixer_vessel", ring(200, 0, 200, 350) + square(210, 0))
    write("mixer_blade", blade())
