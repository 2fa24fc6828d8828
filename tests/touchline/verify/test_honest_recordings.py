"""Honest recordings of all kinds are identical, with their referee, from tick 0 and from each of their starts."""

from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import pytest

from recordings.container.key_selection import KeySelection
from recordings.container.parts import parts_of
from recordings.editing.filtering import filter_recording
from recordings.editing.recovery import recover
from recordings.inspection.contradictions import contradictions, record_faults
from recordings.reading.recording import Recording, open_recording
from recordings.reading.tick_index import tick_index_of
from schemas.config.match_config import load_match
from schemas.config.settings import RecordOptions
from schemas.messages.parameters import ParameterOperation, ParametersRequest
from schemas.messages.scene import SceneOperation, SceneRequest
from schemas.messages.soccer.game import RefereeAction
from schemas.side import Side
from schemas.soccer.game import REFBOX, ActionName, OffField, Point
from sim_host.match.simulation import Simulation
from touchline.verify.resimulate import verify
from touchline.verify.segment_check import resimulate_segment

TWO_A_SIDE = {"teams.cyan.size": 2, "teams.magenta.size": 2}


def people_decide(simulation: Simulation) -> list[RefereeAction]:
    """A match in which people give all restarts; some of their requests are refused."""
    spot = Point(x=2.0, y=1.0)
    requests = {
        10: [RefereeAction(action=ActionName.GOAL, side=Side.CYAN)],
        30: [RefereeAction(action=ActionName.START)],
        60: [RefereeAction(action=ActionName.START), RefereeAction(action=ActionName.START, source="other")],
        160: [RefereeAction(action=ActionName.STOP)],
        180: [RefereeAction(action=ActionName.FREE_KICK, side=Side.MAGENTA, place=spot)],
        240: [RefereeAction(action=ActionName.START)],
        300: [RefereeAction(action=ActionName.GOAL, side=Side.MAGENTA, robot="magenta2")],
        320: [RefereeAction(action=ActionName.UNDO)],
        340: [RefereeAction(action=ActionName.START)],
        360: [RefereeAction(action=ActionName.RED_CARD, robot="cyan2")],
    }
    return requests.get(simulation.world.tick, [])


def of_box(action: ActionName, side: Side | None = None) -> list[RefereeAction]:
    return [RefereeAction(action=action, side=side, source=REFBOX)]


def a_box_officiates(simulation: Simulation) -> list[RefereeAction]:
    """The box gives a kick-off, and a card and a repair for no robot; one of the questions is answered."""
    requests = {
        20: of_box(ActionName.KICK_OFF, Side.MAGENTA),
        60: of_box(ActionName.START),
        70: of_box(ActionName.YELLOW_CARD, Side.CYAN),
        90: [RefereeAction(action=ActionName.NAME_ROBOT, robot="cyan2", source="cyan's coach")],
        100: of_box(ActionName.REPAIR, Side.MAGENTA),
    }
    return requests.get(simulation.world.tick, [])


def box_leaves(simulation: Simulation) -> bool:
    """It goes at 14 s, when the time of the half has been up for long; the rules of time are back after 10 s."""
    return simulation.world.tick < 700


def operators_change_scenes(simulation: Simulation) -> None:
    """Robots leave and join, a scene begins, parameters change, and the match starts again."""
    scenes = {
        120: [SceneRequest(operation=SceneOperation.REMOVE, remove=["magenta2"])],
        200: [SceneRequest(operation=SceneOperation.LOAD, load="penalty")],
        280: [
            SceneRequest(operation=SceneOperation.RESET, to_match=True),
            SceneRequest(operation=SceneOperation.REMOVE, remove=["cyan2"]),
        ],
    }
    for request in scenes.get(simulation.world.tick, []):
        reply = simulation.handle_scene(request)
        assert reply.accepted, reply.reason
    if simulation.world.tick == 150:
        values = {"drive.max_speed": 2.0, "noise.preset": "perfect"}
        assert simulation.handle_parameters(ParametersRequest(operation=ParameterOperation.SET, values=values)).accepted


def one_is_silent(simulation: Simulation) -> set[str]:
    """An agent is gone for four seconds."""
    return {"magenta2"} if 100 <= simulation.world.tick < 300 else set()


KINDS: dict[str, tuple[dict[str, Any], dict[str, Any]]] = {
    "the league's rules": ({"rules": "msl", "duration": 12.0}, {"until": 10.0}),
    "people who officiate": ({"rules": "msl", "referee.mode": "manual"}, {"until": 7.6, "actions": people_decide}),
    "people who may overrule": ({"rules": "msl", "referee.mode": "mixed"}, {"until": 10.0}),
    "scenes, episodes and parameters": ({}, {"until": 6.6, "between": operators_change_scenes}),
    "an agent without an answer": ({"rules": "msl"}, {"until": 7.0, "silent": one_is_silent}),
    "a league's referee box": (
        {"rules": "msl", "referee.mode": "manual", "duration": 10.0},
        {"until": 26.0, "actions": a_box_officiates, "refbox": box_leaves},
    ),
    "a scene with a game": ({"scene": "penalty"}, {"until": 6.0}),
}


@pytest.fixture(scope="module")
def recorded(tmp_path_factory: pytest.TempPathFactory, match_recorder: Callable[..., None]) -> Callable[[str], Path]:
    """Gives the recording of a kind, which is made once."""

    @cache
    def record(kind: str) -> Path:
        match, options = KINDS[kind]
        path = tmp_path_factory.mktemp("honest") / "match.mcap"
        sizes = {} if "scene" in match else TWO_A_SIDE
        match_recorder(path, load_match(None, {"seed": 4, **sizes, **match}), **options)
        return path

    return record


@pytest.fixture(scope="module", params=KINDS)
def honest(request: pytest.FixtureRequest, recorded: Callable[[str], Path]) -> Path:
    return recorded(request.param)


@pytest.fixture(scope="module")
def officiated(recorded: Callable[[str], Path]) -> Path:
    """A match in which people decide."""
    return recorded("people who officiate")


def test_it_is_identical_with_its_referee(honest: Path) -> None:
    verdict = verify(honest)
    assert verdict.difference is None and not verdict.contradictions
    assert verdict.referee and verdict.identical
    assert verdict.not_checked == ["drawings for viewers", "wall times"]


def test_it_is_identical_from_each_of_its_starts(honest: Path) -> None:
    segments = list(tick_index_of(open_recording(honest)).segments(0, 0))
    for segment in segments:
        result = resimulate_segment(honest, segment, referee=True)
        assert (result.difference, result.ticks) == (None, len(segment.ticks))


def test_a_part_of_it_is_identical_where_it_can_be_simulated(officiated: Path, tmp_path: Path) -> None:
    filter_recording(open_recording(officiated), tmp_path / "part.mcap", start=1.0)
    part = open_recording(tmp_path / "part.mcap")
    assert not record_faults(part)
    if list(tick_index_of(part).segments(0, 0)):
        verdict = verify(part.path)
        assert verdict.difference is None


def recorded_kinds(path: Path) -> set[str]:
    return {event.kind.value for _, event in open_recording(path).decoded("game/event")}


def test_the_recordings_have_what_they_are_made_for(officiated: Path) -> None:
    recording = open_recording(officiated)
    assert {"action", "goal", "card", "restart", "start"} <= recorded_kinds(officiated)
    assert sum(len(applied.actions) for _, applied in recording.decoded("host/applied")) == 11
    states = [state for _, state in recording.decoded("game/state")]
    assert states[-1].robots["cyan2"].off_field is OffField.RED_CARD


def test_without_the_match_file_the_setup_has_the_referees_settings(officiated: Path, rewritten) -> None:
    def without(name: str, fields: dict[str, str]) -> dict[str, str]:
        return {key: value for key, value in fields.items() if (name, key) != ("manifest", "config")}

    verdict = verify(rewritten(officiated, lambda messages: messages, metadata=without))
    assert verdict.identical and verdict.referee


def test_a_recording_of_some_keys_is_identical_and_the_others_are_named(officiated: Path, tmp_path: Path) -> None:
    recording: Recording = open_recording(officiated)
    filter_recording(recording, tmp_path / "some.mcap", KeySelection(("world", "host/applied")))
    verdict = verify(tmp_path / "some.mcap")
    assert verdict.identical
    assert "game/state (not recorded)" in verdict.not_checked and "game/event (not recorded)" in verdict.not_checked
    assert contradictions(open_recording(tmp_path / "some.mcap")) == []


def test_the_recording_under_a_referee_box_has_its_questions_and_its_end(recorded: Callable[[str], Path]) -> None:
    recording = open_recording(recorded("a league's referee box"))
    texts = "\n".join(event.text for _, event in recording.decoded("game/event"))
    assert "repair for magenta2: magenta has not named a robot within 10 s" in texts
    assert "the league's referee box has been gone for 10 s" in texts and "half 1 ends after" in texts
    states = [state for _, state in recording.decoded("game/state")]
    assert any(question.default == "cyan2" for state in states for question in state.questions)
    assert [applied.refbox for _, applied in recording.decoded("host/applied")].count(True) == 700


@pytest.fixture(scope="module")
def parts(tmp_path_factory: pytest.TempPathFactory, match_recorder: Callable[..., None]) -> list[Path]:
    """A match of 6 s in parts of 2 s."""
    path = tmp_path_factory.mktemp("parts") / "match.mcap"
    config = load_match(None, {"seed": 4, "rules": "msl", "duration": 12.0, **TWO_A_SIDE})
    match_recorder(path, config, until=6.0, options=RecordOptions(part_duration=2.0))
    return parts_of(path)


def test_a_recording_of_several_parts_and_each_later_one_fit_themselves(parts: list[Path]) -> None:
    assert len(parts) >= 3
    for path in parts:
        part = open_recording(path)
        assert contradictions(part) == record_faults(part) == []
        if list(tick_index_of(part).segments(0, 0)):
            assert verify(path).difference is None


def test_a_recording_of_several_parts_and_its_copy_are_identical(parts: list[Path], tmp_path: Path) -> None:
    filter_recording(open_recording(parts[0]), tmp_path / "whole.mcap")
    for path in (parts[0], tmp_path / "whole.mcap"):
        verdict = verify(path)
        assert verdict.identical and verdict.referee and verdict.ticks == 301


def test_a_recovered_recording_is_identical_up_to_its_end(officiated: Path, tmp_path: Path) -> None:
    content = officiated.read_bytes()
    path = tmp_path / "cut.mcap"
    path.write_bytes(content[: len(content) * 3 // 4])
    recover(path)
    recording = open_recording(path)
    assert contradictions(recording) == record_faults(recording) == []
    verdict = verify(path)
    assert verdict.difference is None and verdict.identical and verdict.referee
