"""A real match in figures: sums agree with each other and with what was recorded."""

import math
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest
from pytest import approx

from recordings.reading.recording import RecordedMessage, Recording, open_recording
from recordings.soccer.stats.figures import MatchFigures
from recordings.soccer.stats.kicks import KickOutcome
from recordings.soccer.stats.match_statistics import figures_of_recording
from schemas.messages.world import World
from schemas.side import Side
from schemas.soccer.game import EventKind, Phase


@pytest.fixture(scope="module")
def recording(played: Path) -> Recording:
    return open_recording(played)


@pytest.fixture(scope="module")
def figures(recording: Recording) -> MatchFigures:
    return figures_of_recording(recording)


def test_the_score_is_the_referees_and_that_of_the_goal_events(recording: Recording, figures: MatchFigures) -> None:
    *_, (_, last) = recording.decoded("game/state")
    events = [event for _, event in recording.decoded("game/event") if event.kind is EventKind.GOAL]
    for side in Side:
        assert figures.sides[side].goals == getattr(last.score, side.value)
        assert figures.sides[side].goals == sum(event.side is side for event in events)
        assert figures.sides[side].goals == sum(goal.side is side for goal in figures.goals)


def test_a_robots_distance_is_the_integral_of_its_recorded_speed(recording: Recording, figures: MatchFigures) -> None:
    worlds = [world for _, world in recording.decoded("world")]
    for robot in figures.robots:
        speeds = [math.hypot(world.robots[robot.name].vx, world.robots[robot.name].vy) for world in worlds]
        path = sum((now + then) / 2 * 0.02 for now, then in pairwise(speeds))
        assert robot.distance == approx(path, rel=0.02, abs=0.05)
        assert robot.top_speed == max(speeds)
    for side in Side:
        own = [robot for robot in figures.robots if robot.side == side]
        assert len(own) == 5
        assert figures.sides[side].distance == approx(sum(robot.distance for robot in own))
        assert [robot.keeper for robot in own] == [True, False, False, False, False]


def test_the_time_in_play_is_the_referees_effective_time(recording: Recording, figures: MatchFigures) -> None:
    *_, (_, last) = recording.decoded("game/state")
    assert figures.in_play_s is not None and figures.in_play_s > 5.0
    assert last.time == figures.duration == 24.0
    assert figures.in_play_s == approx(last.effective, abs=1e-6)
    assert figures.in_play_s == approx(figures.in_play * figures.duration)


def test_possession_and_the_time_of_a_free_ball_add_up_to_the_time_in_play(figures: MatchFigures) -> None:
    sides = [figures.sides[side] for side in Side]
    assert sum(side.possession_s for side in sides) + figures.free_s == approx(figures.in_play_s)
    assert sum(side.possession for side in sides) == approx(1.0)
    for side in Side:
        held = sum(robot.with_ball_s for robot in figures.robots if robot.side == side)
        assert 0 < held == approx(figures.sides[side].with_ball_s)
        assert held <= figures.sides[side].possession_s


def test_every_kick_of_the_recording_is_counted_once(recording: Recording, figures: MatchFigures) -> None:
    kicked = [(world.time, world.kicked) for _, world in recording.decoded("world") if world.kicked is not None]
    assert kicked
    assert sorted((kick.time, kick.robot) for kick in figures.kicks) == kicked
    assert all(kick.mode is not None and kick.speed > 0.5 for kick in figures.kicks)
    for side in Side:
        counts = figures.sides[side].kicks
        neither = (KickOutcome.KEPT, KickOutcome.OWN_GOAL, KickOutcome.UNDECIDED)
        others = sum(kick.side is side and kick.outcome in neither for kick in figures.kicks)
        assert counts.kicks == counts.passes + counts.shots + others
        assert counts.passes_completed <= counts.passes
        assert counts.shots_on_goal + counts.shots_blocked <= counts.shots
        own = [robot.kicks for robot in figures.robots if robot.side == side]
        assert counts.passes == sum(robot.passes for robot in own)
        assert counts.shots == sum(robot.shots for robot in own)


def test_restarts_are_those_that_the_referee_signalled(recording: Recording, figures: MatchFigures) -> None:
    signalled = [event for _, event in recording.decoded("game/event") if event.kind is EventKind.RESTART]
    assert signalled
    counted = sum(sum(figures.sides[side].restarts.values()) for side in Side) + figures.drop_balls
    assert counted == len(signalled)
    assert figures.sides[Side.CYAN].restarts[Phase.KICK_OFF] >= 1


def test_the_figures_rest_on_every_message_that_was_recorded(recording: Recording, figures: MatchFigures) -> None:
    counts = {channel.key: channel.messages for channel in recording.channels}
    coverage = figures.coverage
    assert (coverage.worlds, coverage.events) == (counts["world"], counts["game/event"])
    assert (coverage.states, coverage.unreadable) == (counts["game/state"], 0)
    assert coverage.touched >= coverage.held > 0


def test_the_lines_of_python_in_the_documents_read_the_kicks(
    played: Path, figures: MatchFigures, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    text = (Path(__file__).parents[4] / "docs" / "recordings.md").read_text("utf-8")
    code = text.split("## Figures and the page")[1].split("```python\n")[1].split("```")[0]
    monkeypatch.chdir(played.parent)
    exec(compile(code, "docs/recordings.md", "exec"), {})
    assert len(capsys.readouterr().out.splitlines()) == len(figures.kicks)


def test_worlds_that_cannot_be_are_counted_and_in_no_figure(
    played: Path, figures: MatchFigures, monkeypatch: pytest.MonkeyPatch
) -> None:
    recording = open_recording(played)
    decoded = recording.decoded

    def spoiled(*keys: str) -> Iterator[tuple[RecordedMessage, Any]]:
        for recorded, message in decoded(*keys):
            if isinstance(message, World) and message.tick in (300, 301):
                message = message.replace(time=1e12)
            yield recorded, message

    monkeypatch.setattr(recording, "decoded", spoiled)
    for _ in range(2):  # what was counted at the first reading is not counted again
        again = figures_of_recording(recording)
        assert (again.coverage.unreadable, again.coverage.worlds) == (2, figures.coverage.worlds - 2)
        assert again.duration == figures.duration
        assert again.sides[Side.CYAN].distance == approx(figures.sides[Side.CYAN].distance, rel=0.01)
