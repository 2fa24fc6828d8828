"""What a page shows, as plain data: pitch, tracks, course, events, momentum, tables."""

import dataclasses
import re
import sys
from array import array
from base64 import b64encode
from typing import Any

from recordings.manifest import Manifest
from recordings.stats.figures import Figures
from recordings.stats.kicks import SHOTS, KickStory, Outcome
from recordings.stats.page.course import Course
from recordings.stats.table import ROBOT_HEADINGS, remarks, robot_rows, side_rows
from recordings.stats.track import Tracks
from schemas.game import EventKind, GameEvent
from schemas.host import Setup
from schemas.side import Side

_SILENT = frozenset({EventKind.STOP, EventKind.START, EventKind.AGENT, EventKind.PARAMETERS})
"""Kinds of events that tell a spectator nothing that another beside it does not tell."""
_SHOT_WORDS = {
    Outcome.SAVED: "saved by {by}",
    Outcome.BLOCKED: "blocked by {by}",
    Outcome.MISSED: "misses",
}


def content_of(manifest: Manifest, setup: Setup, figures: Figures, tracks: Tracks, course: Course) -> dict[str, Any]:
    """Everything that the scripts of the page read; times in s of simulated time, lengths in m unless said."""
    teams = {side.value: figures.sides[side].team for side in Side}
    return {
        "title": f"{teams['cyan']} – {teams['magenta']}",
        "match": figures.match,
        "started": manifest.started,
        "about": _about(manifest, setup),
        "teams": teams,
        "pitch": dataclasses.asdict(setup.pitch)
        | {"goal_area_width": setup.pitch.goal_area_width, "penalty_area_width": setup.pitch.penalty_area_width},
        "start": tracks.start,
        "rate": tracks.rate,
        "samples": tracks.samples,
        "robots": [_robot(name, setup, tracks) for name in tracks.robots],
        "ball": {"radius": setup.ball.radius}
        | {axis: _packed(getattr(tracks, f"ball_{axis}")) for axis in ("x", "y", "z")},
        "holder": _packed(tracks.holder),
        "legs": [dataclasses.asdict(leg) for leg in course.legs],
        "clock": course.clock,
        "events": _events(figures),
        "shots": _shots(figures, course),
        "momentum": {"width": figures.momentum_width, "values": [round(value, 3) for value in figures.momentum]},
        "sides": [list(row) for row in side_rows(figures)],
        "table": {"headings": list(ROBOT_HEADINGS), "rows": [list(row) for row in robot_rows(figures)]},
        "in_play": {"seconds": _rounded(figures.in_play_s), "share": _rounded(figures.in_play)},
        "remarks": remarks(figures),
    }


def _about(manifest: Manifest, setup: Setup) -> list[str]:
    """What was played and how, in few words."""
    seed = f"seed {manifest.config.seed}" if manifest.config is not None else None
    words = (f"profile {setup.profile}", f"rules {setup.rules}", f"pace {setup.pace}", seed)
    return [word for word in words if word is not None]


def _robot(name: str, setup: Setup, tracks: Tracks) -> dict[str, Any]:
    track = tracks.robots[name]
    return {
        "name": name,
        "side": tracks.sides.get(name),
        "number": _number(name),
        "radius": setup.seen_by(name).robot.radius,
        "x": _packed(track.x),
        "y": _packed(track.y),
        "heading": _packed(track.heading),
    }


def _number(name: str) -> str:
    """What stands on a robot: the number at the end of its name, or its first letters."""
    found = re.search(r"\d+$", name)
    return found[0] if found else name[:2]


def _packed(values: "array[int]") -> str:
    """Integers as they lie in memory, the lowest byte first, in base64."""
    if sys.byteorder == "big":
        values = array(values.typecode, values)
        values.byteswap()
    return b64encode(values.tobytes()).decode()


def _events(figures: Figures) -> list[dict[str, Any]]:
    """Events, and the shots that no event tells of, in order of time."""
    told = [_event(event) for event in figures.events if event.kind not in _SILENT]
    shots = [_shot(story) for story in figures.kicks if story.outcome in _SHOT_WORDS]
    return sorted([*told, *shots], key=lambda one: one["time"])


def _event(event: GameEvent) -> dict[str, Any]:
    return {
        "time": event.time,
        "clock": round(event.clock, 2),
        "kind": event.kind.value,
        "side": event.side.value if event.side is not None else None,
        "text": event.text,
    }


def _shot(story: KickStory) -> dict[str, Any]:
    became = _SHOT_WORDS[story.outcome].format(by=story.by)
    return {
        "time": story.time,
        "clock": round(story.clock, 2),
        "kind": "save" if story.outcome is Outcome.SAVED else "shot",
        "side": story.side.value,
        "text": f"shot of {story.robot} at {story.speed:.1f} m/s {became}",
    }


def _shots(figures: Figures, course: Course) -> list[dict[str, Any]]:
    """Places of shots with cyan attacking +x throughout."""
    shots = []
    for story in figures.kicks:
        if story.outcome in SHOTS:
            sign = course.cyan_attacks(story.time)
            place = {"x": round(sign * story.x, 2), "y": round(sign * story.y, 2)}
            shots.append({**place, "side": story.side.value, "outcome": story.outcome.value})
    return shots


def _rounded(number: float | None) -> float | None:
    return None if number is None else round(number, 4)
