"""The data of a page: pitch, tracks, history, events, momentum, tables."""

import dataclasses
import re
import sys
from array import array
from base64 import b64encode
from typing import Any

from recordings.container.manifest import Manifest
from recordings.soccer.stats.figures import MatchFigures
from recordings.soccer.stats.kicks import SHOTS, KickOutcome, KickRecord
from recordings.soccer.stats.page.game_history import GameHistory
from recordings.soccer.stats.page.shot_lines import end_of_shot
from recordings.soccer.stats.table import ROBOT_HEADINGS, remarks, robot_rows, side_rows
from recordings.soccer.stats.tracks import Tracks
from schemas.config.number_files import versioned_name
from schemas.messages.setup import Setup
from schemas.messages.soccer.game import GameEvent
from schemas.side import Side
from schemas.soccer.game import EventKind

_HIDDEN_KINDS = frozenset({EventKind.STOP, EventKind.START, EventKind.AGENT, EventKind.PARAMETERS})
"""Kinds of events that add nothing for a spectator."""
_SHOT_TEXTS = {
    KickOutcome.SAVED: "saved by {by}",
    KickOutcome.BLOCKED: "blocked by {by}",
    KickOutcome.MISSED: "misses",
}


def content_of(
    manifest: Manifest, setup: Setup, figures: MatchFigures, tracks: Tracks, history: GameHistory
) -> dict[str, Any]:
    """All data that the scripts of the page read; times in s of simulated time, lengths in m, tracks in cm."""
    teams = {side.value: figures.sides[side].team for side in Side}
    return {
        "title": f"{teams['cyan']} – {teams['magenta']}",
        "match": figures.match,
        "started": manifest.started,
        "about": _about(manifest, setup),
        "teams": teams,
        "pitch": dataclasses.asdict(setup.pitch),
        "start": tracks.start,
        "rate": tracks.rate,
        "samples": tracks.samples,
        "robots": [_robot(name, setup, tracks) for name in tracks.robots],
        "ball": {"radius": setup.ball.radius}
        | {axis: _packed(getattr(tracks, f"ball_{axis}")) for axis in ("x", "y", "z")},
        "holder": _packed(tracks.holder),
        "intervals": [dataclasses.asdict(interval) for interval in history.intervals],
        "clock": history.clock,
        "events": _events(figures),
        "shots": _shots(figures, history, tracks, setup.pitch.length / 2),
        "momentum": {"width": figures.momentum_width, "values": [round(value, 3) for value in figures.momentum]},
        "sides": [list(row) for row in side_rows(figures)],
        "table": {"headings": list(ROBOT_HEADINGS), "rows": [list(row) for row in robot_rows(figures)]},
        "in_play": {"seconds": _rounded(figures.in_play_s), "share": _rounded(figures.in_play)},
        "remarks": remarks(figures),
    }


def _about(manifest: Manifest, setup: Setup) -> list[str]:
    """Profile, rules, pace and seed of the match, for display."""
    seed = f"seed {manifest.config.seed}" if manifest.config is not None else None
    profile = versioned_name(setup.profile, setup.profile_version)
    rules = versioned_name(setup.rules, setup.rules_version)
    facts = (f"profile {profile}", f"rules {rules}", f"pace {setup.pace}", seed)
    return [fact for fact in facts if fact is not None]


def _robot(name: str, setup: Setup, tracks: Tracks) -> dict[str, Any]:
    track = tracks.robots[name]
    return {
        "name": name,
        "side": tracks.sides.get(name),
        "number": _number(name),
        "radius": setup.for_robot(name).robot.radius,
        "x": _packed(track.x),
        "y": _packed(track.y),
        "heading": _packed(track.heading),
    }


def _number(name: str) -> str:
    """The label on a robot: the number at the end of its name, or its first letters."""
    found = re.search(r"\d+$", name)
    return found[0] if found else name[:2]


def _packed(values: "array[int]") -> str:
    """Integers in little-endian order, in base64."""
    if sys.byteorder == "big":
        values = array(values.typecode, values)
        values.byteswap()
    return b64encode(values.tobytes()).decode()


def _events(figures: MatchFigures) -> list[dict[str, Any]]:
    """Events, and shots without an event of their own, by time."""
    events = [_event(event) for event in figures.events if event.kind not in _HIDDEN_KINDS]
    shots = [_shot(kick) for kick in figures.kicks if kick.outcome in _SHOT_TEXTS]
    return sorted([*events, *shots], key=lambda one: one["time"])


def _event(event: GameEvent) -> dict[str, Any]:
    return {
        "time": event.time,
        "clock": round(event.clock, 2),
        "kind": event.kind.value,
        "side": event.side.value if event.side is not None else None,
        "text": event.text,
    }


def _shot(kick: KickRecord) -> dict[str, Any]:
    outcome = _SHOT_TEXTS[kick.outcome].format(by=kick.by)
    return {
        "time": kick.time,
        "clock": round(kick.clock, 2),
        "kind": "save" if kick.outcome is KickOutcome.SAVED else "shot",
        "side": kick.side.value,
        "text": f"shot of {kick.robot} at {kick.speed:.1f} m/s {outcome}",
    }


def _shots(figures: MatchFigures, history: GameHistory, tracks: Tracks, half_length: float) -> list[dict[str, Any]]:
    """Positions and ends of shots, mirrored so that cyan always attacks +x."""
    shots = []
    for kick in figures.kicks:
        if kick.outcome in SHOTS:
            sign = history.cyan_attacks(kick.time)
            place = {"x": round(sign * kick.x, 2), "y": round(sign * kick.y, 2)}
            end_x, end_y = end_of_shot(kick, tracks, half_length)
            end = {"x": round(sign * end_x, 2), "y": round(sign * end_y, 2)}
            shots.append({**place, "end": end, "side": kick.side.value, "outcome": kick.outcome.value})
    return shots


def _rounded(number: float | None) -> float | None:
    return None if number is None else round(number, 4)
