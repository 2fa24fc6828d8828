"""Draws the paths of one brain on two bodies: `python docs/generate/draw_two_bodies.py sim.mcap run.mcap ROBOT [FILE]`.

Both recordings have the robot's sights. The picture is FILE, or `docs/images/two_bodies.png`; the distance is printed.
"""

import sys
from pathlib import Path

from matplotlib.figure import Figure

from touchline.hardware.robot_track import path_distance, read_track

IMAGE = Path(__file__).parents[1] / "images" / "two_bodies.png"


def draw(simulated: Path, hardware: Path, robot: str) -> tuple[Figure, str]:
    """The picture, and the sentence with the distance between the paths."""
    tracks = [read_track(path, robot) for path in (simulated, hardware)]
    mean, most = path_distance(*tracks)
    figure = Figure(figsize=(5.0, 3.6), dpi=110)
    axes = figure.add_axes((0.14, 0.14, 0.84, 0.84))
    for track, name, style in zip(tracks, ("in a match", "on simulated hardware"), ("-", "--"), strict=True):
        axes.plot([one.self.x for one in track.sights], [one.self.y for one in track.sights], style, label=name, lw=1.0)
    axes.set_aspect("equal")
    axes.set_xlabel("x in m")
    axes.set_ylabel("y in m")
    axes.legend(loc="lower center", bbox_to_anchor=(0.5, 0.12), fontsize=8)
    return figure, f"{mean:.3f} m apart on average, {most:.3f} m at most"


if __name__ == "__main__":
    picture, distance = draw(Path(sys.argv[1]), Path(sys.argv[2]), sys.argv[3])
    picture.savefig(sys.argv[4] if len(sys.argv) > 4 else IMAGE)
    print(distance)
