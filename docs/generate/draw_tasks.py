"""Draws an episode of each task as a moving picture: `python docs/generate/draw_tasks.py [TASK...]`.

The baseline brain plays the task's first seed; every `FRAME_S` of simulated time is a frame, shown for a third of that
time. The pictures of all tasks that ship are in docs/images/tasks.
"""

import sys
from pathlib import Path

from PIL import Image

from schemas.messages.setup import Setup
from schemas.messages.world import World
from schemas.wire.part_faults import validated
from touchline.drawing.picture import drawn, pixels
from touchline.matches.task.task import load_task, shipped_tasks
from touchline.play.play_match import InProcessMatch

FOLDER = Path(__file__).parents[1] / "images" / "tasks"
SEED = 1
FRAME_S = 0.4
"""Simulated time between two frames, in s."""
MOST = 60
"""Frames of a picture; longer episodes are cut."""
FASTER = 3.0
TRAIL_S = 2.0
"""Simulated time that trails reach back, in s."""
WIDTH = 3.6
"""Inches."""
_COLOURS = 64
_END_MS = 1500
"""Milliseconds for which the last frame is shown."""


def worlds_of(name: str) -> tuple[Setup, list[World]]:
    """The setup of an episode, and its worlds, tick by tick."""
    task = load_task(name)
    match = InProcessMatch(task.episode(SEED), brain_folder=task.folder)
    setup = match.simulation.setup()
    worlds: list[World] = []
    try:
        while not match.simulation.over and len(worlds) < MOST * FRAME_S / setup.time.tick:
            tick = match.step()
            worlds.append(validated(World, {key: one for key, one in tick.world.items() if key != "sensors"}))
    finally:
        match.close()
    return setup, worlds


def frame(setup: Setup, worlds: list[World]) -> Image.Image:
    """The picture of the last of these worlds."""
    figure, _, _ = drawn(setup, worlds, WIDTH)
    return Image.fromarray(pixels(figure)).quantize(_COLOURS, dither=Image.Dither.NONE)


def main() -> int:
    """Draw the named tasks, or all."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    for name in sys.argv[1:] or shipped_tasks():
        setup, worlds = worlds_of(name)
        each, back = round(FRAME_S / setup.time.tick), round(TRAIL_S / setup.time.tick)
        ends = [*range(1, len(worlds), each), len(worlds)]
        frames = [frame(setup, worlds[max(0, end - back) : end]) for end in ends]
        durations = [*[round(1000 * FRAME_S / FASTER)] * (len(frames) - 1), _END_MS]
        file = FOLDER / f"{name}.gif"
        frames[0].save(file, save_all=True, append_images=frames[1:], duration=durations, loop=0, optimize=True)
        sys.stdout.write(f"{file}  {len(frames)} frames, {file.stat().st_size // 1024} kB\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
