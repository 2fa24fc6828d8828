"""Draws the plots of docs/physics.md from runs of the host's world: `python docs/generate/draw_physics.py [NAME …]`.

Each function below draws `docs/images/physics_NAME.png`; without a name all are drawn, in about a minute.
"""

import math
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

sys.path.insert(0, str(Path(__file__).parent))

import physics_runs as runs
from schemas.config.profile import load_profile
from schemas.messages.command import KickMode

IMAGES = Path(__file__).parents[1] / "images"
_BLUE, _ORANGE, _GREEN, _GREY = "#1f6fb2", "#d9730d", "#2f8f4e", "#6b7570"
_COLOURS = (_BLUE, _ORANGE, _GREEN)


def figure(panels: int = 1, height: float = 2.9) -> tuple[Figure, list[Axes]]:
    """A figure as wide as a page of text, with panels beside each other."""
    drawn = Figure(figsize=(7.2, height), dpi=120, layout="constrained")
    axes = [drawn.add_subplot(1, panels, number + 1) for number in range(panels)]
    for panel in axes:
        panel.grid(color="#e3e6e3", linewidth=0.6)
        panel.set_axisbelow(True)
        panel.spines[["top", "right"]].set_visible(False)
    return drawn, axes


def step_response() -> Figure:
    """Speed over time of the two drives."""
    drawn, (panel, error) = figure(2)
    for (name, profile), colour in zip(runs.DRIVES.items(), _COLOURS, strict=True):
        run = runs.step_response(profile)
        speed = run.robot("cyan1", "vx")[:, 0]
        panel.plot(run.times, speed, color=colour, label=name, linewidth=1.4)
        ideal = np.minimum(load_profile(profile).drive.acceleration * run.times, 3.0)
        rising = run.times < 1.8
        error.plot(run.times[rising], 100 * (speed - ideal)[rising], color=colour, linewidth=1.2, label=name)
    panel.axhline(3.0, color=_GREY, linewidth=0.8, linestyle=":")
    panel.set(xlabel="time, s", ylabel="speed, m/s", title="told 3 m/s, after 2 s told to stand")
    error.set(xlabel="time, s", ylabel="speed less min(a·t, v), cm/s", title="behind the ideal ramp")
    error.set_xlim(0, 3.2)
    error.legend(frameon=False, fontsize=8, loc="center right")
    return drawn


def top_speed(directions: int = 24) -> Figure:
    """Top speed per direction in the body frame, of three and four wheels."""
    drawn = Figure(figsize=(4.4, 4.0), dpi=120, layout="constrained")
    panel = drawn.add_subplot(projection="polar")
    for (name, profile), colour in zip(list(runs.DRIVES.items())[1:], _COLOURS[1:], strict=True):
        angles, speeds = runs.top_speeds(profile, directions)
        panel.plot(angles, speeds, "o", color=colour, markersize=3.5, label=f"{name}, measured")
        wheels, fine = load_profile(profile).wheels, np.linspace(0, 2 * math.pi, 721)
        axles = wheels.angle + 2 * math.pi / wheels.count * np.arange(wheels.count)
        share = np.abs(np.sin(fine[:, None] - axles)).max(axis=1)
        panel.plot(fine, wheels.max_speed / share, color=colour, linewidth=0.9, label="limit of the fastest wheel")
    panel.set_title("top speed by direction, m/s; 0° is the kick axis", fontsize=9)
    drawn.legend(frameon=False, fontsize=7, loc="outside lower center", ncols=2)
    return drawn


def ball_roll() -> Figure:
    """Speed of a ball that slides first, and of one that rolls from the start."""
    drawn, (panel, start) = figure(2)
    ball = load_profile("msl").ball
    share = 1 / (1 + ball.inertia / (ball.mass * ball.radius**2))
    for spin, name, colour in ((1.0, "kicked with the spin of rolling", _BLUE), (0.0, "kicked at its middle", _ORANGE)):
        run = runs.ball_roll(spin)
        for axes in (panel, start):
            axes.plot(run.times[1:], run.ball("vx")[1:, 0], color=colour, label=name, linewidth=1.4)
    start.axhline(4 * share, color=_GREY, linestyle=":", linewidth=0.9)
    start.text(0.02, 4 * share - 0.16, f"{share:.3f} · 4 m/s", color=_GREY, fontsize=8)
    start.set(xlim=(0, 0.8), ylim=(2, 4.1), xlabel="time, s", title="the slide")
    panel.set(xlabel="time, s", ylabel="speed, m/s", title="rolling resistance to the end")
    panel.legend(frameon=False, fontsize=8)
    return drawn


def bounce() -> Figure:
    """Height of a dropped ball."""
    drawn, (panel,) = figure(height=2.5)
    run, ball = runs.bounce(), load_profile("msl").ball
    panel.plot(run.times, run.ball("z")[:, 0] - ball.radius, color=_BLUE, linewidth=1.3)
    for number in range(4):
        height = ball.restitution ** (2 * number)
        panel.axhline(height, color=_GREY, linewidth=0.8, linestyle=":")
        label = "e²ⁿ · 1 m" if number == 0 else f"{height:.3f} m"
        panel.text(2.5, height + 0.015, label, color=_GREY, fontsize=8, ha="right")
    panel.set(xlabel="time, s", ylabel="air below the ball, m", title="let go with 1 m of air below it")
    return drawn


def lob_arcs() -> Figure:
    """Lobs over the goal plane, solved with drag, and the same kick without air."""
    drawn, (panel,) = figure(height=3.1)
    profile = load_profile("msl")
    field, r = profile.field, profile.ball.radius
    for distance, colour in ((4.0, _GREEN), (7.0, _ORANGE), (10.0, _BLUE)):
        for speed in (5.0, 8.0, 12.0):
            run = runs.kick(KickMode.LOB, speed, distance, profile)
            x, z = run.ball("x", "z").T
            seen = x < field.goal_line + r
            panel.plot(x[seen] - field.goal_line, z[seen], color=colour, linewidth=1.1)
    loft = runs.kick(KickMode.LOFT, 10.0, 10.0, profile)
    empty = runs.kick(KickMode.LOFT, 10.0, 10.0, runs.without_air(profile))
    for run, style, name in ((loft, "-", "fixed loft, 10 m/s"), (empty, ":", "the same without air")):
        x, z = run.ball("x", "z").T
        seen = x < field.goal_line + r
        panel.plot(x[seen] - field.goal_line, z[seen], color=_GREY, linestyle=style, linewidth=1.0, label=name)
    post = field.post
    panel.add_patch(Rectangle((0, field.goal_height), post, post, color="black", zorder=5))
    panel.plot([0, 0], [r, field.goal_height - r], color="black", linewidth=2.5, label="where the centre may pass")
    panel.set(
        xlim=(-10.3, 0.7), ylim=(0, 4.2), xlabel="distance to the goal plane, m", ylabel="height of the centre, m"
    )
    panel.set_title("lobs from 4, 7 and 10 m, told 5, 8 and 12 m/s")
    panel.legend(frameon=False, fontsize=8, loc="upper left")
    return drawn


def duel() -> Figure:
    """Positions over time of two robots that push each other."""
    drawn, (panel,) = figure(height=2.7)
    rivals = {
        "equal": ({}, _BLUE),
        "a tenth more grip": ({"wheels": {"traction": 1.1}}, _ORANGE),
        "a tenth heavier": ({"body": {"mass": 1.1}}, _GREEN),
    }
    for name, (change, colour) in rivals.items():
        run = runs.duel(change)
        middle = (run.robot("cyan1", "x") + run.robot("magenta1", "x"))[:, 0] / 2
        panel.plot(run.times, middle, color=colour, label=name, linewidth=1.4)
    panel.set(xlabel="time, s", ylabel="where they touch, m", title="two robots on wheels, head-on; the right one is …")
    panel.legend(frameon=False, fontsize=8, loc="lower left")
    return drawn


def dribble_turn() -> Figure:
    """Distance and bearing of the ball in a tightening turn, for the three dribble methods."""
    drawn, (distance, bearing) = figure(2)
    profile = load_profile("msl")
    for method, colour, style in zip(runs.METHODS, _COLOURS, ("-", "--", "-"), strict=True):
        run = runs.dribble(method)
        robot, ball = run.robot("cyan1", "x", "y", "heading"), run.ball("x", "y")
        away = ball - robot[:, :2]
        turn = np.degrees(np.arctan2(away[:, 1], away[:, 0]) - robot[:, 2])
        rates = np.abs(run.robot("cyan1", "omega")[:, 0])
        begun = run.times > 1.02
        distance.plot(
            rates[begun], np.hypot(*away.T)[begun], color=colour, label=method, linestyle=style, linewidth=1.5
        )
        bearing.plot(rates[begun], np.mod(turn + 180, 360)[begun] - 180, color=colour, linestyle=style, linewidth=1.5)
    half = math.degrees(profile.dribble.cone) / 2
    distance.axhline(profile.dribble.distance, color=_GREY, linestyle=":", linewidth=0.9)
    for edge in (-half, half):
        bearing.axhline(edge, color=_GREY, linestyle=":", linewidth=0.9)
    distance.set(
        ylim=(0.3, 0.5), xlabel="turn rate, rad/s", ylabel="centre to centre, m", title="distance; hold limit dotted"
    )
    bearing.set(
        ylim=(-20, 20), xlabel="turn rate, rad/s", ylabel="degrees from the kick axis", title="bearing; cone dotted"
    )
    distance.legend(frameon=False, fontsize=8, title="at 2 m/s", title_fontsize=8)
    return drawn


def noise(pictures: int = 600) -> Figure:
    """Standard deviation of a perceived ball's position over its distance."""
    drawn, (panel,) = figure(height=2.7)
    s = load_profile("msl").sensing
    distances = np.arange(0.5, s.ball_range, 0.5)
    measured = np.array([runs.errors(float(d), pictures).std(axis=0) for d in distances])
    fine = np.linspace(0, s.ball_range, 100)
    kinds = (("along the line of sight", s.range_noise, _BLUE), ("across it", s.bearing_noise, _ORANGE))
    for column, (name, growth, colour) in enumerate(kinds):
        panel.plot(distances, 100 * measured[:, column], "o", color=colour, markersize=3.5, label=f"{name}, measured")
        panel.plot(fine, 100 * np.hypot(s.ball_position, growth * fine), color=colour, linewidth=1.0, label="formula")
    panel.set(xlabel="distance of the ball, m", ylabel="standard deviation, cm", ylim=(0, None))
    panel.set_title(f"noise on a seen ball, {pictures} pictures a point")
    panel.legend(frameon=False, fontsize=8)
    return drawn


PLOTS: dict[str, Callable[[], Figure]] = {
    plot.__name__: plot for plot in (step_response, top_speed, ball_roll, bounce, lob_arcs, duel, dribble_turn, noise)
}

if __name__ == "__main__":
    for name in sys.argv[1:] or PLOTS:
        if name not in PLOTS:
            sys.exit(f"no plot is named {name}; there are {', '.join(PLOTS)}")
        PLOTS[name]().savefig(IMAGES / f"physics_{name}.png")
