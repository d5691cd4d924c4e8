"""Draws the figures of the manual: measuring.svg, plate.svg, stages.svg, and, from simulations, scatter.svg and lift.svg.

usage: figures.py PROGRAM SOURCE_DIR [FOLDER_FOR_PNG [FIGURE...]]   (needs Matplotlib; some two minutes)
"""

import json
import pathlib
import subprocess
import sys

import matplotlib

matplotlib.use("svg")
from matplotlib import pyplot  # noqa: E402
from matplotlib.patches import Polygon, Rectangle  # noqa: E402

PROGRAM, SOURCE = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
HERE = SOURCE / "calibrate/manual"
CARD = SOURCE / "data/cards/concrete-mix-79.json"
INK, PALE, MASS, MEASURED, SIMULATED = "#1c2126", "#9aa1a8", "#d5dbe1", "#d9730d", "#2b6cb0"

pyplot.rcParams.update({"svg.fonttype": "none", "svg.hashsalt": "pastefit", "font.size": 11, "font.family": "DejaVu Sans",
                        "axes.edgecolor": PALE, "axes.labelcolor": INK, "text.color": INK, "xtick.color": INK,
                        "ytick.color": INK, "axes.spines.top": False, "axes.spines.right": False})


def save(figure, name):
    figure.savefig(HERE / name, metadata={"Date": None, "Creator": None}, bbox_inches="tight")
    if len(sys.argv) > 3:
        figure.savefig(pathlib.Path(sys.argv[3]) / name.replace(".svg", ".png"), dpi=90, bbox_inches="tight")
    pyplot.close(figure)


def sketch(width, height, span):
    figure, axes = pyplot.subplots(figsize=(width, height))
    axes.set_aspect("equal")
    axes.set_xlim(*span)
    axes.axis("off")
    return figure, axes


def dimension(axes, start, end, text, offset=(0, 0), **how):
    """A line with two arrows and its name."""
    axes.annotate("", start, end, arrowprops={"arrowstyle": "<->", "color": MEASURED, "shrinkA": 0, "shrinkB": 0})
    middle = [(a + b) / 2 + c for a, b, c in zip(start, end, offset)]
    axes.text(*middle, text, color=MEASURED, **{"ha": "center", "va": "center", **how})


def dashed(axes, xs, ys):
    axes.plot(xs, ys, color=PALE, linestyle=(0, (4, 3)), linewidth=1)


def heap(axes, centre, half, height, top, shift=0):
    """Outline of a heap as seen from the side."""
    outline = [(centre - half, 0), (centre - 0.78 * half, 0.35 * height), (centre - top + shift, 0.97 * height),
               (centre + shift, height), (centre + top + shift, 0.97 * height), (centre + 0.8 * half, 0.33 * height),
               (centre + half, 0)]
    axes.add_patch(Polygon(outline, closed=True, facecolor=MASS, edgecolor=INK))


def measuring():
    figure, axes = sketch(10.5, 4.4, (-190, 900))
    axes.set_ylim(-120, 400)
    axes.plot([-180, 890], [0, 0], color=INK, linewidth=2)
    # The filled mould.
    axes.add_patch(Polygon([(-100, 0), (-50, 300), (50, 300), (100, 0)], closed=True, facecolor=MASS, edgecolor=INK, linewidth=3))
    dimension(axes, (-100, -30), (100, -30), "base 200", (0, -24))
    dimension(axes, (-50, 322), (50, 322), "top 100", (0, 22))
    dimension(axes, (-135, 0), (-135, 300), "300", (-14, 0), ha="right")
    axes.annotate("", (150, 280), (150, 120), arrowprops={"arrowstyle": "-|>", "color": INK})
    axes.text(162, 200, "lift: 300 mm\nin 3 to 5 s", va="center")
    axes.text(0, 150, "mass over\nvolume =\nbulk density", ha="center", va="center")
    # The heap.
    centre, half, height, shift = 560, 165, 140, 25
    heap(axes, centre, half, height, 70, shift)
    dashed(axes, [centre, centre], [0, 345])
    axes.text(centre - 8, 350, "axis of\nthe mould", ha="right", va="center", color=INK)
    dashed(axes, [centre + shift, centre + shift], [height, 260])
    dimension(axes, (centre, 238), (centre + shift, 238), "shift", (44, 0), ha="left")
    axes.plot([centre - 60, centre + 190], [height + 2, height + 2], color=INK, linewidth=3)
    axes.text(centre - 66, height + 10, "straight edge, level", ha="right", va="bottom")
    axes.add_patch(Rectangle((centre + 176, 0), 14, 300, facecolor="#ffffff", edgecolor=INK))
    for z in range(10, 300, 10):
        axes.plot([centre + 176, centre + (184 if z % 50 else 190)], [z, z], color=INK, linewidth=0.7)
    axes.text(centre + 196, 306, "ruler", va="bottom", ha="center")
    dimension(axes, (centre + 214, 0), (centre + 214, height), "height h", (8, 0), ha="left")
    dashed(axes, [centre + 190, centre + 330], [300, 300])
    dimension(axes, (centre + 214, height), (centre + 214, 300), "slump", (8, 0), ha="left")
    dimension(axes, (centre - half, -30), (centre + half, -30), "spread: mean of two diameters at right angles", (0, -24))
    save(figure, "measuring.svg")


def plate():
    figure, axes = sketch(10.5, 3.6, (-420, 700))
    axes.set_ylim(-110, 270)
    axes.plot([-400, 400], [0, 0], color=INK, linewidth=2)
    axes.add_patch(Rectangle((-350, -8), 700, 8, facecolor=PALE, edgecolor=INK))
    axes.plot([-350], [-4], marker="o", color=INK, markersize=8)
    axes.text(-350, -34, "hinge", ha="center", va="center")
    axes.plot([-350, 346], [0, 88], color=PALE, linestyle=(0, (4, 3)))
    axes.annotate("", (346, 2), (346, 88), arrowprops={"arrowstyle": "-|>", "color": INK})
    axes.text(356, 46, "falls freely from\nits stop (40 mm)\nonto its seat", va="center")
    outline = [(-160, 0), (-125, 60), (-82, 104), (-60, 116), (60, 92), (88, 82), (130, 45), (168, 0)]
    axes.add_patch(Polygon(outline, closed=True, facecolor=MASS, edgecolor=INK))
    dashed(axes, [0, 0], [0, 215])
    axes.text(0, 222, "axis", ha="center", va="bottom")
    dashed(axes, [-200, -50], [114, 114])
    dashed(axes, [50, 230], [94, 94])
    dashed(axes, [-200, 230], [114, 114])
    dimension(axes, (205, 94), (205, 114), "sag: free side lower than hinge side,\n50 mm either side of the axis", (14, 8), ha="left", va="bottom")
    dimension(axes, (-190, 0), (-190, 104), "height h", (-10, 0), ha="right")
    dashed(axes, [-200, 0], [104, 104])
    dimension(axes, (-82, 150), (88, 150), "plateau width b (where the top has at least 0.8 of\nthe height at the axis)", (-20, 34), ha="right")
    dashed(axes, [-82, -82], [104, 155])
    dashed(axes, [88, 88], [82, 155])
    dimension(axes, (-160, -50), (168, -50), "spread after the drop", (0, -22))
    save(figure, "plate.svg")


def stages():
    figure, axes = sketch(10.5, 2.6, (-60, 900))
    axes.set_ylim(-110, 120)
    axes.plot([-50, 890], [0, 0], color=INK, linewidth=2)
    axes.add_patch(Polygon([(-50, 0), (-35, 60), (35, 60), (50, 0)], closed=True, facecolor=MASS, edgecolor=INK, linewidth=3))
    axes.text(0, 85, "fill", ha="center", family="monospace")
    axes.text(0, -22, "filled, struck off", ha="center", va="center")
    for centre, half, height, name, what in ((200, 72, 42, "step1", "mould lifted"), (440, 85, 33, "step2", "first drop"),
                                             (750, 118, 18, "after_drops", "last drop (15 or 25)")):
        heap(axes, centre, half, height, 0.4 * half)
        axes.text(centre, 85, name, ha="center", family="monospace")
        axes.text(centre, -22, what, ha="center", va="center")
        dimension(axes, (centre - half, -50), (centre + half, -50), f"{name}.spread_mm", (0, -22))
    for left, right in ((65, 115), (285, 340), (540, 615)):
        axes.annotate("", (right, 30), (left, 30), arrowprops={"arrowstyle": "-|>", "color": INK})
    save(figure, "stages.svg")


def simulated(*settings, seed):
    command = [PROGRAM, "simulate", CARD, "--quiet", "--json", "--seed", str(seed)]
    for setting in settings:
        command += ["--set", setting]
    return json.loads(subprocess.run(command, capture_output=True, text=True).stdout)["observables"]


def scatter():
    heaps = [simulated(seed=seed) for seed in range(101, 141)]
    figure, axes = pyplot.subplots(figsize=(6.2, 4.4))
    axes.add_patch(Rectangle((310 - 25, 137.5 - 7.5), 50, 15, facecolor="#fbe7d3", edgecolor=MEASURED))
    axes.plot([310], [137.5], marker="+", color=MEASURED, markersize=14, markeredgewidth=2, linestyle="")
    axes.text(336, 137.5, "measured,\n± tolerance", color=MEASURED, va="center")
    accepted = [heap for heap in heaps if heap["step1.lateral_shift_mm"] <= 40]
    sheared = [heap for heap in heaps if heap["step1.lateral_shift_mm"] > 40]
    for some, marker, label in ((accepted, "o", f"{len(accepted)} heaps"), (sheared, "x", f"{len(sheared)} sheared off")):
        axes.plot([heap["step1.spread_mm"] for heap in some], [heap["step1.height_mm"] for heap in some], marker,
                  color=SIMULATED, label=label, alpha=0.8)
    axes.set_xlabel("spread, mm")
    axes.set_ylabel("height, mm")
    axes.set_xlim(280, 360)
    axes.legend(frameon=False, loc="lower left")
    save(figure, "scatter.svg")


def lift():
    figure, axes = pyplot.subplots(figsize=(6.2, 4))
    speeds = (25, 50, 100, 200, 400)
    for speed in speeds:
        heaps = [simulated(f"tests[0].test.lift_velocity_m_s={speed / 1000}", seed=seed) for seed in range(1, 7)]
        kept = [heap["step1.height_mm"] for heap in heaps if heap["step1.lateral_shift_mm"] <= 40]
        axes.plot([speed] * len(kept), kept, "o", color=SIMULATED, alpha=0.5)
        axes.plot([speed], [sum(kept) / len(kept)], "_", color=INK, markersize=22)
        print(speed, len(kept), sum(kept) / len(kept))
    axes.axvspan(60, 100, color="#fbe7d3", zorder=0)
    axes.text(77, axes.get_ylim()[0], "300 mm in 3 to 5 s", color=MEASURED, rotation=90, ha="center", va="bottom")
    axes.set_xscale("log")
    axes.set_xticks(speeds, [str(speed) for speed in speeds])
    axes.minorticks_off()
    axes.set_xlabel("speed of the lift, mm/s")
    axes.set_ylabel("height of the heap, mm")
    save(figure, "lift.svg")


if __name__ == "__main__":
    for draw in (measuring, plate, stages, scatter, lift):
        if len(sys.argv) < 5 or draw.__name__ in sys.argv[4:]:
            draw()
