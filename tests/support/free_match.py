"""A small match of the game free: a robot before a box that can be pushed, one in a dock, a score; its recording."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

from schemas.config.match_config import MatchConfig, load_match
from schemas.messages.command import Command, Drive
from schemas.messages.sight import Sight
from touchline.play.match_recording import MatchRecording
from touchline.play.play_match import InProcessMatch

SCORE = """
from touchline import Moment, Score

def count(now: Moment) -> Score:
    seen = (now.memory or []) + [round(now.random.random(), 6)]
    inside = [name for name, robot in now.robots.items() if now.zones["dock"].contains(robot.x, robot.y)]
    return Score(len(inside) + sum(seen) / 1000, over=now.tick >= 60, memory=seen, events=inside[:1] * (now.tick == 3))

def plain(now):
    return now.time
"""
BOX = {"name": "box", "shape": "box", "place": [1.0, 0.0], "size": [0.6, 0.4, 0.6], "mass": 5.0, "friction": 0.3}


def scene(**box: Any) -> dict[str, Any]:
    """The scene; `box` are other numbers of the box, None for a key that it lacks."""
    robots = [{"name": "one", "side": "cyan", "x": 0.0, "y": 0.0}, {"name": "two", "side": "cyan", "x": 5.0, "y": 5.0}]
    obstacle = {key: value for key, value in (BOX | box).items() if value is not None}
    return {"description": "A test.", "robots": robots, "obstacles": [obstacle]}


def free_match(folder: Path, program: str = SCORE, **overrides: Any) -> MatchConfig:
    """The match, whose score is `tally.py` in this folder; an override of None takes a key away."""
    (folder / "tally.py").write_text(program)
    (folder / "task.toml").write_text("")
    settings = {
        "game": "free",
        "duration": 10.0,
        "task": {"score": "tally:count", "zones": [{"name": "dock", "place": [5.0, 5.0], "radius": 1.0}]},
        "noise.preset": "perfect",
        "scene": scene(),
    }
    merged = {key: value for key, value in (settings | overrides).items() if value is not None}
    return load_match(folder / "task.toml", merged)


class Pusher:
    """Drives ahead."""

    def __init__(self, *_briefing: Any) -> None:
        """Every robot does."""

    def act(self, sight: Sight) -> Command:
        return Command(answers_tick=sight.tick, drive=Drive(vx=1.5, omega=0.1))


def record_free_match(
    folder: Path, config: MatchConfig, between: Callable[[InProcessMatch], None] = lambda _: None
) -> Path:
    """A recording in which all robots are pushers; `between` is called before each tick."""
    match = InProcessMatch(config, {"one": Pusher(), "two": Pusher()})
    recording = MatchRecording(folder / "free.mcap", config, match.simulation)
    while not match.simulation.over:
        between(match)
        recording.add(match.step(), match.commands)
    recording.close()
    match.close()
    return folder / "free.mcap"
