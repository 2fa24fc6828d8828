"""The same match by ten processes, and in this one."""

import json

import pytest
from mcap.reader import make_reader

from recordings.reading.recording import open_recording
from schemas.config.match_config import load_match
from schemas.messages.applied import Applied
from support.brisk import BRISK
from touchline.play.play_match import play_match

pytestmark = [pytest.mark.processes, pytest.mark.timeout(300)]

MATCH = f"""
seed = 7
rules = "{BRISK}"
duration = 8

[patience]
answer = 60
"""
"""A machine that is busy with other things must not make a robot miss a tick."""


@pytest.fixture(scope="module")
def match_file(folder):
    path = folder / "match.toml"
    path.write_text(MATCH)
    return path


@pytest.fixture(scope="module")
def first(start, folder, match_file):
    words = ("--seed", "7", "--pace", "lockstep", "--record", "first.mcap", "--json", "--listen", "tcp/127.0.0.1:0")
    program = start("touchline", "match", match_file.name, *words, folder=folder)
    assert program.status() == 0, program.err
    return program


@pytest.fixture(scope="module")
def result(first):
    return json.loads(first.out)


@pytest.fixture(scope="module")
def alone(match_file):
    """The same match without processes: tick → chain."""
    chains = []
    play_match(load_match(match_file), watch=lambda tick: chains.append(tick.applied["chain"]))
    return chains


def test_the_result_is_one_json_object(first, result):
    assert len(first.out.splitlines()) == 1
    assert {"score", "duration_s", "ticks", "events", "real_time_factor", "recording", "losses"} <= set(result)
    assert result["losses"] == {}
    assert result["recording"] == "first.mcap"
    assert result["real_time_factor"] > 0
    assert result["duration_s"] == pytest.approx(result["ticks"] * 0.02)
    assert result["events"][-1]["kind"] == "full_time"
    goals = [event["side"] for event in result["events"] if event["kind"] == "goal"]
    assert result["score"] == {side: goals.count(side) for side in ("cyan", "magenta")}


def test_the_recording_opens_with_the_stock_reader_and_holds_every_tick_once(folder, result):
    with (folder / "first.mcap").open("rb") as file:
        messages = make_reader(file).iter_messages(topics=["world"], log_time_order=False)
        ticks = [json.loads(message.data)["tick"] for _, _, message in messages]
    assert ticks == list(range(result["ticks"] + 1))


def test_no_robot_missed_a_tick(folder, first):
    last = list(open_recording(folder / "first.mcap").decoded("host/health"))[-1][1]
    assert len(last.robots) == 10
    assert {robot.missed for robot in last.robots.values()} == {0}
    assert last.late_ticks == 0


def test_one_process_plays_the_same_match_as_ten(folder, first, alone):
    applied = open_recording(folder / "first.mcap", whole=True).messages("host/applied")
    assert alone == [Applied.decode(message.payload).chain for message in applied][1:]
