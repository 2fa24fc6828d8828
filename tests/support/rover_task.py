"""A small task of the game free for policies: two robots on two wheels with all kinds of sensors, and a dock."""

from pathlib import Path

TASK = """
name = "rovers"
game = "free"
duration = 1.0
profile = "differential"
[task]
score = "rover_tally:docked"
unit = "m"
zones = [{ name = "dock", place = [4.0, 1.0], radius = 0.5 }]
[teams.cyan]
brain = "rover_tally:Still"
[types.rover.sensors.scan]
kind = "range"
beams = { value = 4, unit = "1", origin = "test" }
span = { value = 6.283185307179586, unit = "rad", origin = "test" }
max_distance = { value = 5.0, unit = "m", origin = "test" }
[types.rover.sensors.north]
kind = "compass"
[types.rover.sensors.bumper]
kind = "contact"
sectors = { value = 2, unit = "1", origin = "test" }
[scene]
description = "A test."
robots = [
    { name = "one", side = "cyan", type = "rover", x = 0.0, y = 0.0, heading = 1.5707963267948966 },
    { name = "two", side = "cyan", type = "rover", x = 0.0, y = 2.0 },
]
vary = [{ body = "two", x = 0.5 }]
"""
PROGRAM = """
from touchline import Command, Moment, Score, Sight

class Still:
    def __init__(self, briefing): pass
    def act(self, sight: Sight) -> Command:
        return Command(answers_tick=sight.tick)

def docked(now: Moment) -> Score:
    return Score(now.robots["one"].y, over=now.robots["one"].y > 0.5)
"""


def write_rover_task(folder: Path) -> str:
    """The path of its match file, which is written into this folder."""
    (folder / "rover_tally.py").write_text(PROGRAM)
    (folder / "rovers.toml").write_text(TASK)
    return str(folder / "rovers.toml")
