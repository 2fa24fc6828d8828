"""The league's log → recording: world states of both teams become the world, signals become the game."""

import math
import re
from collections.abc import Iterator
from dataclasses import dataclass
from datetime import UTC, datetime
from heapq import merge
from pathlib import Path
from typing import Any

import numpy as np

from recordings.container.attachments import make_attachments
from recordings.container.environment import libm_fingerprint, versions
from recordings.container.manifest import Manifest, Result
from recordings.editing.compose import TimedMessage, compose
from recordings.soccer.league import IMPORTER, LOG_PERIOD
from recordings.soccer.league.event_log import SignalLine, TeamNames, read_events
from recordings.soccer.league.game_reconstruction import GameReconstruction
from recordings.soccer.league.log_files import LogFiles, log_files
from recordings.soccer.league.pitch_size import RecognisedPitch, recognise_pitch
from recordings.soccer.league.robot_reports import belief_messages
from recordings.soccer.league.team_log import TeamLog, read_team
from recordings.soccer.league.tracks import Track, ball_track, fuse_balls, kicks, robot_tracks
from schemas.config.match_config import MatchConfig
from schemas.config.profile import load_profile
from schemas.config.sections import TimeSteps
from schemas.config.soccer.rule_book import load_rule_book
from schemas.errors import TouchlineError
from schemas.messages.setup import Setup, TeamSetup
from schemas.messages.soccer.game import GameState
from schemas.messages.soccer.league.findings import Finding, Findings
from schemas.messages.world import BallTruth, RobotTruth, World
from schemas.side import Side
from schemas.topics import EVENT, STATE, WORLD
from schemas.wire.message import VERSION

_STEPS = TimeSteps(physics_step=LOG_PERIOD / 2, steps_per_tick=2)


@dataclass(frozen=True, slots=True)
class ImportSummary:
    """The result of an import."""

    out: Path
    result: Result
    teams: dict[Side, TeamLog]
    signals: int
    """Signals that were read."""
    kicks: int
    """Kicks that were inferred."""
    coped: list[Finding]
    """Deviations from the schema without loss of data."""
    lost: list[Finding]
    """Data that could not be read."""
    left_out: list[Finding]
    """Data that was read and has no place in a recording."""
    pitch: RecognisedPitch
    """The profile with the pitch, and how it was chosen."""

    def to_json(self) -> dict[str, Any]:
        """The result for programs."""
        return {
            "out": self.out,
            "duration": self.result.time,
            "score": self.result.score,
            "teams": {
                side: {"name": log.team, "records": log.records, "read": log.read, "robots": sorted(log.robots)}
                for side, log in self.teams.items()
            },
            "signals": self.signals,
            "kicks_inferred": self.kicks,
            "coped_with": [_plain(finding) for finding in self.coped],
            "not_read": [_plain(finding) for finding in self.lost],
            "left_out": [_plain(finding) for finding in self.left_out],
            "profile": self.pitch.profile,
            "pitch": self.pitch.note,
        }


def _plain(finding: Finding) -> dict[str, Any]:
    return {"what": finding.what, "count": finding.count, "first": finding.first}


def import_log(paths: list[Path], out: Path, profile: str | None = None, team_a: str | None = None) -> ImportSummary:
    """Read a log from its zip, its folder or its files, and write it as a recording.

    Its ticks are `LOG_PERIOD` apart. `profile` defines the pitch, which is not in a log, and is recognised if None;
    `team_a` is the name of team A in the referee's signals, if these use addresses.

    Raises:
        TouchlineError: not a log, no world state in it that can be read, or `out` cannot be written.
    """
    files, findings, left_out = log_files(paths), Findings(), Findings()
    for name in files.broken:
        findings.place = name
        findings.note("bytes that are not UTF-8", lost=True)
    teams = {
        side: read_team(files.teams.get(letter, ""), letter, findings, left_out) for side, letter in _LETTERS.items()
    }
    times_ms = [epoch_ms for log in teams.values() for epoch_ms in log.times_ms]
    if not times_ms:
        raise TouchlineError(f"{files.name}: has no world state that could be read; {_main_reason(findings)}")
    if out.exists():
        raise TouchlineError(f"--out {out}: already exists; remove it, or give another name")
    names = TeamNames(teams[Side.CYAN].team, teams[Side.MAGENTA].team, team_a)
    signals = read_events(files.events or "", names, findings)
    findings.place = files.name
    if not signals:
        findings.note("no signals of the referee: the ball counts as in play throughout")
    start_ms, end_ms = min(times_ms), max(times_ms)
    game = GameReconstruction()
    game.reconstruct(_within(signals, start_ms, end_ms, findings), start_ms, (end_ms - start_ms) / 1e3)
    pitch = recognise_pitch(teams.values(), profile)
    if pitch.note:
        findings.note(pitch.note)
    setup = _setup(files, teams, pitch.profile)
    world = _World(setup, teams, game, start_ms, end_ms, findings)
    manifest = Manifest(
        contract=VERSION,
        match=setup.match,
        recorder=IMPORTER,
        started=datetime.fromtimestamp(start_ms / 1e3, UTC).isoformat(timespec="milliseconds"),
        sights=False,
        versions=versions(),
        libm=libm_fingerprint(),
        setup=setup,
    )
    reports = [belief_messages(side, log, start_ms) for side, log in teams.items()]
    messages = merge(*reports, world.messages(), _game_messages(game), key=lambda one: one.sim_ns)
    result = compose(out, manifest, make_attachments(None), messages)
    return ImportSummary(
        out, result, teams, len(signals), len(world.kicked), findings.coped, findings.lost, left_out.coped, pitch
    )


def _within(signals: list[SignalLine], start_ms: float, end_ms: float, findings: Findings) -> list[SignalLine]:
    """The signals of a log's match; those before its first record are moved to the beginning."""
    kept = []
    for line in signals:
        if line.epoch_ms < start_ms:
            findings.note("signal before the first record: moved to the beginning")
        elif line.epoch_ms > end_ms + _LATEST_MS:
            findings.note("signal more than an hour after the last record", lost=True)
            continue
        elif line.epoch_ms > end_ms + 1e3 * LOG_PERIOD:
            findings.note("signal after the last record: it has no world beside it")
        kept.append(line)
    return kept


_LATEST_MS = 3_600_000
"""ms after the last record from which a signal has a wrong clock. Chosen here."""
_LETTERS = {Side.CYAN: "A", Side.MAGENTA: "B"}


def _main_reason(findings: Findings) -> str:
    worst = max(findings.lost, key=lambda finding: finding.count, default=None)
    return f"{worst.count} times {worst.what}" if worst is not None else "give a zip, or *.A.msl and *.B.msl"


def _setup(files: LogFiles, teams: dict[Side, TeamLog], profile: str) -> Setup:
    """The setup of a match with the teams of the log, and pitch and bodies of the profile."""
    name = re.sub(r"\W+", "_", files.name.lower(), flags=re.ASCII).strip("_")[:30] or "log"
    config = MatchConfig(
        name=name if name[0].isalpha() else f"m{name}"[:32], pace="realtime", profile=profile, rules="msl"
    )
    setup = Setup.of(config, load_profile(profile), load_rule_book("msl"))
    messages = {
        side: TeamSetup(
            name=log.team or side.value,
            robots=[_name(side, number) for number in sorted(log.robots)],
            goalkeeper=min(log.robots, default=0) == 1,
        )
        for side, log in teams.items()
    }
    return setup.replace(teams=messages, time=_STEPS)


def _name(side: Side, number: int) -> str:
    return f"{side.value}{number}"


def _game_messages(game: GameReconstruction) -> Iterator[TimedMessage]:
    for one in game.messages:
        topic = STATE if isinstance(one, GameState) else EVENT
        yield TimedMessage(round(one.time * 1e9), topic, topic.key, one)


class _World:
    """The world at each tick of the log."""

    def __init__(
        self,
        setup: Setup,
        teams: dict[Side, TeamLog],
        game: GameReconstruction,
        start_ms: float,
        end_ms: float,
        findings: Findings,
    ) -> None:
        count = int((end_ms - start_ms) / 1e3 / LOG_PERIOD + 1e-6) + 1
        times = np.arange(count, dtype=np.float64) * LOG_PERIOD
        grid_ms = start_ms + times * 1e3
        attacks = game.attacks(times)
        attack = {Side.CYAN: attacks, Side.MAGENTA: -attacks}
        radius = setup.ball.radius
        self._clock = game.clock(times)
        self._height = setup.robot.height / 2
        self._robots: dict[str, Track] = {
            _name(side, number): track
            for side, log in teams.items()
            for number, track in robot_tracks(log, _LETTERS[side], grid_ms, attack[side], findings).items()
        }
        balls = [
            ball_track(log, _LETTERS[side], grid_ms, attack[side], radius, findings) for side, log in teams.items()
        ]
        self._ball = fuse_balls(balls[0], balls[1], radius)
        self.kicked = kicks(self._robots, self._ball, LOG_PERIOD)
        """Tick → robot that kicked."""

    def messages(self) -> Iterator[TimedMessage]:
        """Yield a world for each tick at which a robot or the ball is known."""
        clock, ball = self._clock.tolist(), self._ball.values.T.tolist()
        known = {name: track.known.tolist() for name, track in self._robots.items()}
        values = {name: track.values.T.tolist() for name, track in self._robots.items()}
        for tick in range(len(clock)):
            robots = {name: self._robot(values[name][tick]) for name in known if known[name][tick]}
            if not robots and not self._ball.known[tick]:
                continue
            x, y, z, vx, vy, vz, _ = ball[tick]
            holders = [name for name, robot in robots.items() if robot.holding]
            kicker = self.kicked.get(tick)
            world = World(
                tick=tick,
                time=tick * LOG_PERIOD,
                robots=robots,
                ball=BallTruth(x=x, y=y, z=z, vx=vx, vy=vy, vz=vz),
                possession=min(
                    holders, key=lambda name: math.hypot(robots[name].x - x, robots[name].y - y), default=None
                ),
                touches=holders if kicker is None or kicker in holders else [*holders, kicker],
                kicked=kicker,
                clock=clock[tick],
            )
            yield TimedMessage(round(world.time * 1e9), WORLD, WORLD.key, world)

    def _robot(self, values: list[float]) -> RobotTruth:
        x, y, heading, vx, vy, omega, with_ball = values
        return RobotTruth(x=x, y=y, z=self._height, heading=heading, vx=vx, vy=vy, omega=omega, holding=with_ball > 0.5)
