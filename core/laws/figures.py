#!/usr/bin/env python3
"""Draws the figures of the README beside it from simulations: two grains that a testing machine brings together and parts.

usage: figures.py PROGRAM
"""

import json
import pathlib
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
RADIUS, PEAK, GAP = 8e-3, 0.2, 2.4e-3  # [m], [N], [m]: a grain of 8 mm, strength 3125 Pa, rupture at 0.3 R
SPEED = 0.01  # [m/s]
COLOURS = ["#0068ad", "#c14d00", "#007d5c", "#b0006a", "#6d5600", "#1c2126"]


def polynomial(curvature, left):
    """a, b and d_c of the bridge with this curvature and this share of the peak left when it ruptures."""
    return {"shape": "polynomial", "a_n_m2": curvature * (1 - left) * PEAK / GAP**2,
            "b_n_m": (1 - left) * (1 + curvature) * PEAK / GAP, "c_n": PEAK, "d_c_m": -GAP}


def pulls(program, bridge, gaps, parts):
    """The force that pulls on a grain at these gaps [N], repulsion negative, None where there is none to be read: while
    two grains approach, or while they part after they have met."""
    far, near = 1.3 * GAP, min(min(gaps), 0) - 2e-5
    meet = (far - near) / SPEED
    scene = {
        "format": "pastefit-impact-1",
        "contact": {"youngs_modulus_pa": 2e6, "poissons_ratio": 0.3, "restitution": 1,
                    "bridge": {"formation": "film", "offset_m": GAP / 2, **bridge}},
        "density_kg_m3": 2500, "reference_radius_m": RADIUS,
        "grains": [{"radius_m": RADIUS, "centre_m": [-RADIUS - far, 0, 0], "velocity_m_s": [SPEED, 0, 0], "held": True,
                    "turns_at_s": meet if parts else None},
                   {"radius_m": RADIUS, "centre_m": [RADIUS, 0, 0], "held": True}],
        "pull_gaps_m": gaps, "duration_s": (2 if parts else 1) * meet, "time_step": {"fixed_s": 2e-5},
    }
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder, "scene.json")
        file.write_text(json.dumps(scene))
        done = subprocess.run([program, "simulate", file, "--json"], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(done.stderr)
    readings = json.loads(done.stdout)["observables"]
    return [readings.get(f"pull{k}_n") for k in range(len(gaps))]


class Figure:
    """Curves over the gap, in the units of the peak and of the rupture gap."""

    WIDTH, HEIGHT, LEFT, TOP, RIGHT, BOTTOM = 840, 330, 60, 16, 270, 46

    def __init__(self, x, y, ticks_x, ticks_y, x_label, y_label):
        self.x_range, self.y_range, self.parts, self.legend = x, y, [], []
        for tick in ticks_x:
            self.parts.append(self.line((tick, y[0]), (tick, y[1]), "#d9dcdf", 1))
            self.parts.append(self.text(tick, y[0], f"{tick:g}", dy=18, anchor="middle"))
        for tick in ticks_y:
            self.parts.append(self.line((x[0], tick), (x[1], tick), "#d9dcdf", 1))
            self.parts.append(self.text(x[0], tick, f"{tick:g}", dx=-8, dy=5, anchor="end"))
        self.parts.append(self.text(sum(x) / 2, y[0], x_label, dy=38, anchor="middle"))
        middle = self.place(x[0], sum(y) / 2)
        self.parts.append(f'<text transform="translate(16 {middle[1]:.0f}) rotate(-90)" text-anchor="middle">{y_label}</text>')

    def place(self, x, y):
        across = (self.WIDTH - self.LEFT - self.RIGHT) / (self.x_range[1] - self.x_range[0])
        up = (self.HEIGHT - self.TOP - self.BOTTOM) / (self.y_range[1] - self.y_range[0])
        return self.LEFT + across * (x - self.x_range[0]), self.HEIGHT - self.BOTTOM - up * (y - self.y_range[0])

    def line(self, one, other, colour, width):
        (x1, y1), (x2, y2) = self.place(*one), self.place(*other)
        return f'<line x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}" stroke="{colour}" stroke-width="{width}"/>'

    def text(self, x, y, words, dx=0, dy=0, anchor="start", colour="#1c2126"):
        left, top = self.place(x, y)
        return f'<text x="{left + dx:.1f}" y="{top + dy:.1f}" text-anchor="{anchor}" fill="{colour}">{words}</text>'

    def curve(self, name, points, dash=""):
        colour = COLOURS[len(self.legend)]
        places = " ".join(f"{x:.1f},{y:.1f}" for x, y in (self.place(*point) for point in points))
        self.parts.append(f'<polyline points="{places}" fill="none" stroke="{colour}" stroke-width="2.4" stroke-dasharray="{dash}"/>')
        self.legend.append((name, colour, dash))

    def write(self, name):
        left, top = self.WIDTH - self.RIGHT + 16, self.TOP + 20
        for k, (words, colour, dash) in enumerate(self.legend):
            y = top + 19 * k
            self.parts.append(f'<line x1="{left:.0f}" x2="{left + 30:.0f}" y1="{y - 5:.0f}" y2="{y - 5:.0f}" stroke="{colour}" '
                              f'stroke-width="2.4" stroke-dasharray="{dash}"/><text x="{left + 38:.0f}" y="{y:.0f}">{words}</text>')
        body = "\n".join(self.parts)
        (HERE / name).write_text(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {self.WIDTH} {self.HEIGHT}" '
                                 f'font-family="DejaVu Sans, sans-serif" font-size="13" fill="#1c2126">\n'
                                 f'<rect width="100%" height="100%" fill="#ffffff"/>\n{body}\n</svg>\n')


def told(gaps, forces):
    """In the units of the figure; where nothing pulls the force is 0."""
    return [(gap / GAP, (force or 0) / PEAK) for gap, force in zip(gaps, forces)]


def attractions(program):
    figure = Figure((0, 1.1), (0, 1.05), [0, 0.2, 0.4, 0.6, 0.8, 1], [0, 0.25, 0.5, 0.75, 1],
                    "gap over the gap at which the bridge ruptures", "attraction over that at touch")
    gaps = [GAP * k / 40 for k in range(1, 40)] + [0.999 * GAP, 1.005 * GAP, 1.1 * GAP]
    root = 2 * GAP / (1 + (1 + 0.4 * GAP / RADIUS) ** 0.5)  # of the volume: GAP = root + 0.1 root^2/RADIUS
    capillary = {"shape": "capillary", "c_n": 0, "d_c_m": 0, "liquid_volume_m3": root**3, "contact_angle_rad": 0,
                 "surface_tension_n_m": PEAK / (2 * 3.141592653589793 * RADIUS)}
    for name, bridge, dash in [("polynomial, curvature -1", polynomial(-1, 0), ""), ("linear: curvature 0", polynomial(0, 0), "10 4"),
                               ("polynomial, curvature 1", polynomial(1, 0), "2 3"),
                               ("linear, 0.4 left at rupture", polynomial(0, 0.4), "6 3"),
                               ("exponential", {"shape": "exponential", "c_n": PEAK, "d_c_m": -GAP}, "12 3 2 3"),
                               ("capillary (Willett)", capillary, "4 2")]:
        figure.curve(name, told(gaps, pulls(program, bridge, gaps, True)), dash)
    figure.write("attractions.svg")


def memory(program):
    figure = Figure((-0.1, 1.2), (-0.35, 1.1), [0, 0.2, 0.4, 0.6, 0.8, 1], [0, 0.25, 0.5, 0.75, 1],
                    "gap over the gap at which the bridge ruptures; negative: overlap", "pull over that at touch")
    bridge = {**polynomial(0, 0.2), "offset_m": 0.4 * GAP / 2}
    gaps = [-0.08 * GAP + 1.28 * GAP * k / 320 for k in range(321)]
    figure.curve("approaching, formation ratio 0.4", told(gaps, pulls(program, bridge, gaps, False)), "6 4")
    figure.curve("parting", told(gaps, pulls(program, bridge, gaps, True)))
    figure.write("memory.svg")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    attractions(sys.argv[1])
    memory(sys.argv[1])
