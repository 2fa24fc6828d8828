"""Draws a moment of a recording: `python docs/generate/draw_match.py RECORDING PICTURE [SECOND]`, as PNG or SVG.

Robots with the trails of the last seconds, obstacles, zones, the ball, and what sensors read. SECOND is simulated time;
without it, the end is drawn. `docs/images/sensors.png` was drawn from a recording of `examples/coverage/coverage.toml`.
"""

import sys
from pathlib import Path

from matplotlib.figure import Figure

from draw_readings import draw_readings
from recordings.reading.recording import open_recording
from schemas.errors import TouchlineError
from schemas.messages.world import World
from schemas.topics import WORLD
from touchline.drawing.picture import drawn

TRAIL_S = 3.0
"""Simulated time that trails reach back."""
WIDTH = 10.0
"""Inches."""


def draw(recording_path: Path, second: float | None = None) -> Figure:
    """The picture of a simulated time in s, by default the last one.

    Raises:
        TouchlineError: not a recording, or no world was recorded at that time.
    """
    recording = open_recording(recording_path)
    setup = recording.setup
    begin, end = recording.extent_of_worlds()
    until = end if second is None else second
    found = recording.decoded(WORLD.key, start=until - TRAIL_S, end=until + setup.time.tick / 2)
    worlds = [message for _, message in found if isinstance(message, World)]
    if not worlds or not begin <= until <= end:
        raise TouchlineError(f"{recording_path}: no world at {until:g} s; give a time from {begin:g} to {end:g} s")
    figure, axes, scale = drawn(setup, worlds, WIDTH, dpi=110)
    draw_readings(axes, setup, worlds, scale)
    return figure


if __name__ == "__main__":
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    try:
        draw(Path(sys.argv[1]), *map(float, sys.argv[3:])).savefig(sys.argv[2])
    except (TouchlineError, OSError, ValueError) as error:
        sys.exit(str(error))
