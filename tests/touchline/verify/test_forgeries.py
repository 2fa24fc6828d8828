"""Whatever somebody changes in a recording, `touchline verify` or `touchline info` names it."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner

from recordings.reading.recording import open_recording
from schemas.config.match_config import load_match
from schemas.errors import TouchlineError
from schemas.messages.soccer.game import RefereeAction
from schemas.side import Side
from schemas.soccer.game import ActionName
from sim_host.match.simulation import Simulation
from support.forgeries import (
    add_goal,
    add_state,
    answers,
    at_tick,
    change_belief,
    change_command,
    change_input_and_command,
    delete_card,
    delete_goal,
    delete_states,
    delete_worlds,
    double_world,
    drop_action,
    each,
    hide_absence,
    is_world,
    nine_nil,
    remove_chunk,
    shift,
    swap_contents,
    swap_worlds,
    switch_goal,
)
from touchline.commands.cli.command_line import app

ACTIONS = {
    60: RefereeAction(action=ActionName.START),
    200: RefereeAction(action=ActionName.GOAL, side=Side.CYAN, robot="cyan1"),
    230: RefereeAction(action=ActionName.YELLOW_CARD, side=Side.MAGENTA, robot="magenta2"),
    330: RefereeAction(action=ActionName.REPAIR, side=Side.MAGENTA, robot="magenta1"),
}


def requested(simulation: Simulation) -> list[RefereeAction]:
    """A goal, a card and a robot in repair, by decision of people."""
    action = ACTIONS.get(simulation.world.tick)
    return [action] if action is not None else []


@pytest.fixture(scope="module")
def honest(tmp_path_factory: pytest.TempPathFactory, match_recorder: Callable[..., None]) -> Path:
    """A match of 360 ticks by the league's rules with a goal, a card, and a robot in repair."""
    path = tmp_path_factory.mktemp("honest") / "match.mcap"
    teams = {"teams.cyan.size": 2, "teams.magenta.size": 2}
    config = load_match(None, {"seed": 5, "duration": 20.0, "rules": "msl", **teams})
    match_recorder(path, config, until=7.2, actions=requested)
    return path


def lines(command: str, path: Path, *options: str) -> tuple[int, str]:
    result = CliRunner().invoke(app, [command, str(path), *options], prog_name="touchline", env={"COLUMNS": "300"})
    if isinstance(result.exception, TouchlineError):
        return 2, str(result.exception)
    return result.exit_code, result.output


def test_the_honest_recording_is_identical_and_fits_itself(honest: Path) -> None:
    code, text = lines("verify", honest, "--jobs", "1")
    assert code == 0
    assert text.startswith("identical, 361 ticks\n")
    assert text.splitlines()[-1] == "not checked: drawings for viewers; wall times"
    assert "contradict" not in lines("info", honest)[1]
    goals = [event for _, event in open_recording(honest).decoded("game/event") if event.kind == "goal"]
    assert len(goals) == 1


FORGERIES = {
    "worlds taken out": (delete_worlds, "the recording contradicts itself: 52 ticks have no world, and 0 were lost"),
    "the score in every state": (nine_nil, "tick 0 (0.00 s) is the first that differs: the referee decides otherwise"),
    "the side of a goal": (switch_goal, "game/event goal: side is magenta recorded, cyan simulated again"),
    "a goal taken out": (delete_goal, "game/event goal is missing: goal for cyan, decided by coach"),
    "a goal put in": (add_goal, "game/event goal is recorded and not simulated: goal for cyan"),
    "a card taken out": (delete_card, "game/event card is missing: "),
    "states taken out": (delete_states, "game/state is missing: "),
    "a state put in": (add_state, "game/state is recorded and not simulated: "),
    "a robot off the field that seems to play": (hide_absence, "magenta1: off_field is None recorded"),
    "a clock that stands": (each("world", lambda fields: fields.update(clock=1.0)), "world: clock is 1.0 recorded"),
    "a doubled world": (double_world, "world is doubled, out of order or shifted: there are two messages of tick 150"),
    "two worlds in the wrong order": (swap_worlds, "world is doubled, out of order or shifted: tick 150 comes after"),
    "two worlds with each other's content": (swap_contents, "world is doubled, out of order or shifted: its log time"),
    "shifted worlds": (shift("world"), "world is doubled, out of order or shifted: its log time is 0.1 s"),
    "shifted events": (shift("game/event"), "game/event is doubled, out of order or shifted: its log time is"),
    "shifted inputs": (shift("host/applied"), "host/applied is doubled, out of order or shifted: its log time is"),
    "shifted commands": (shift("robot/cyan1/command"), "follows robot/cyan1/command at"),
    "everything shifted": (shift(), "doubled, out of order or shifted: its log time is 0.1 s"),
    "a command": (change_command, "tick 151 (3.02 s) is the first that differs: the applied input of cyan2"),
    "an input with its command": (change_input_and_command, "tick 151 (3.02 s) is the first that differs"),
    "the actions of people": (drop_action, "tick 61 (1.22 s) is the first that differs: the hash chain differs"),
    "an answer to no tick": (
        each("robot/cyan2/command", lambda fields: fields.update(answers_tick=[150]), answers(150)),
        "tick 151 (3.02 s) is the first that differs: the applied input of cyan2",
    ),
    "a time that no match reaches": (
        each("host/applied", lambda fields: fields.update(time=1e300), at_tick(0)),
        "host/applied: 1 messages are invalid, doubled or out of order",
    ),
    "a chunk taken out": (remove_chunk, "ticks 150 to 159 are missing in the recording and were not verified"),
    "a belief": (change_belief, "the belief of cyan2 is in none of its recorded commands"),
}


@pytest.mark.parametrize("forgery", FORGERIES)
def test_verify_names_what_was_changed(honest: Path, rewritten, forgery: str) -> None:
    change, expected = FORGERIES[forgery]
    code, text = lines("verify", rewritten(honest, change), "--jobs", "1")
    assert code == 1
    assert expected in text
    assert not text.startswith("identical,")


def set_field(record: str, name: str, value: Any):
    """Set a field of a metadata record."""
    return lambda of, fields: {**fields, name: json.dumps(value)} if of == record else fields


def other_seed(record: str, fields: dict[str, str]) -> dict[str, str]:
    return (
        {**fields, "config": json.dumps(json.loads(fields["config"]) | {"seed": 6})} if record == "manifest" else fields
    )


def other_pitch(record: str, fields: dict[str, str]) -> dict[str, str]:
    if record != "manifest":
        return fields
    setup = json.loads(fields["setup"])
    setup["pitch"]["goal_width"] = 3.0
    return {**fields, "setup": json.dumps(setup)}


def lose_a_world(copied):
    return [one for one in copied if not is_world(one, 150)]


METADATA_FORGERIES = {
    "the score in the result": (
        {"metadata": set_field("result", "score", {"cyan": 2, "magenta": 0}), "recount": False},
        "the score is 2 : 0 in the result, 1 : 0 in the last game/state",
    ),
    "the last tick in the result": (
        {"metadata": set_field("result", "tick", 900), "recount": False},
        "the last tick is 900 in the result, 360 in the last host/applied",
    ),
    "the number of messages in the result": (
        {"metadata": set_field("result", "messages", 7), "recount": False},
        "the result has 7 messages, and ",
    ),
    "a world that the result counts": (
        {"change": lose_a_world, "recount": False},
        "world: 360 messages in the file, 361 in the result",
    ),
    "the seed in the manifest": (
        {"metadata": other_seed},
        "the manifest and the attached match.json differ: seed is 6",
    ),
    "the attached match file": (
        {"attachment": lambda name, content: b'"x"' if name == "match.json" else content},
        "the manifest and the attached match.json differ: ",
    ),
    "the pitch in the setup": ({"metadata": other_pitch}, "the setup does not follow from the match file: pitch"),
}


@pytest.mark.parametrize("forgery", METADATA_FORGERIES)
def test_info_and_verify_name_what_does_not_fit_the_messages(honest: Path, rewritten, forgery: str) -> None:
    options, expected = METADATA_FORGERIES[forgery]
    options = dict(options)
    path = rewritten(honest, options.pop("change", lambda messages: messages), **options)
    assert expected in lines("info", path)[1]
    code, text = lines("verify", path, "--jobs", "1")
    assert code == 1
    assert f"the recording contradicts itself: {expected}" in text


def test_a_result_whose_seal_is_broken_is_damaged(honest: Path, tmp_path: Path) -> None:
    content = honest.read_bytes()
    path = tmp_path / "broken.mcap"
    path.write_bytes(content.replace(b'{"cyan":1,"magenta":0}', b'{"cyan":7,"magenta":0}'))
    assert path.read_bytes() != content
    for command in ("verify", "info"):
        code, text = lines(command, path)
        assert (code, "its result is damaged" in text) == (2, True)


def test_without_the_referee_the_last_line_names_what_was_not_checked(honest: Path, rewritten) -> None:
    forged = rewritten(honest, switch_goal)
    code, text = lines("verify", forged, "--jobs", "1", "--no-referee")
    assert code == 0
    assert text.splitlines()[-1].startswith(
        "not checked: game/state, game/event, and clock, episode and off_field of world (--no-referee); "
    )


def test_an_invalid_message_with_the_roster_ends_no_export(honest: Path, rewritten, tmp_path: Path) -> None:
    forged = rewritten(honest, each("host/applied", lambda fields: fields.update(silent=5), at_tick(0)))
    code, text = lines("export", forged, "--format", "csv", "--out", str(tmp_path / "csv"))
    assert code == 0 and text.splitlines()[0].endswith("robots.csv")
