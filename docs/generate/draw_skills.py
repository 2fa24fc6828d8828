"""Draws the pictures of skills in docs/team.md: `python docs/generate/draw_skills.py [NAME …]`; without a name, all.

Each is a run of `skill_runs.py`, written to `docs/images/skill_NAME.png`: the bodies at its end, and their paths.
"""

import sys
from pathlib import Path

from matplotlib.figure import Figure

sys.path.insert(0, str(Path(__file__).parent))

import skill_runs
from touchline.drawing.bodies import draw_bodies
from touchline.drawing.pitch import draw_pitch

IMAGES = Path(__file__).parents[1] / "images"
WIDTH = 3.4
"""Inches."""


def draw(name: str) -> Figure:
    """The picture of one run."""
    run = skill_runs.RUNS[name]
    setup, worlds = skill_runs.play(run)
    left, right, low, high = run.shown
    scale = WIDTH / (right - left)
    figure = Figure(figsize=(WIDTH, scale * (high - low)), dpi=110)
    axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    draw_pitch(axes, setup.pitch)
    draw_bodies(axes, setup, worlds, scale)
    axes.set_xlim(left, right)
    axes.set_ylim(low, high)
    return figure


if __name__ == "__main__":
    for name in sys.argv[1:] or skill_runs.RUNS:
        draw(name).savefig(IMAGES / f"skill_{name}.png")
