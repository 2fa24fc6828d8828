"""A small match of soccer with a task: a ball before a robot, an opponent and a post, drawn from the seed."""

from pathlib import Path
from typing import Any

from schemas.config.match_config import MatchConfig, load_match

SCORE = """
from touchline import Moment, Score

def nearer(now: Moment) -> Score:
    ball = now.ball
    over = any(event.kind == "ball_out" for event in now.events)
    return Score(ball.x, over=over, reward=2.0 if now.kicked else None, events=[f"{now.holder}"] * (now.tick == 2))

def phases(now: Moment) -> float:
    return float(now.game.phase == "play") + 10 * (now.sides["cyan1"] == "cyan")
"""
SCENE = {
    "description": "A ball before a robot.",
    "ball": {"x": 1.0, "y": 0.0, "vx": 2.0},
    "robots": [
        {"name": "cyan1", "side": "cyan", "x": 0.0, "y": 0.0},
        {"name": "magenta1", "side": "magenta", "x": 6.0, "y": 4.0},
    ],
    "obstacles": [{"name": "post", "shape": "cylinder", "place": [4.0, -4.0], "radius": 0.3, "height": 1.0}],
    "vary": [{"body": "ball", "y": 3.0}, {"body": "magenta1", "x": 1.0, "heading": 1.0}, {"body": "post", "x": 0.5}],
}


def task_match(folder: Path, **overrides: Any) -> MatchConfig:
    """A match whose score is `tally.py` in this folder."""
    (folder / "tally.py").write_text(SCORE)
    (folder / "task.toml").write_text("")
    settings = {"duration": 8.0, "task.score": "tally:nearer", "scene": SCENE} | overrides
    return load_match(folder / "task.toml", settings)
