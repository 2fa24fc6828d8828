"""Eleven against eleven by 22 processes: played, recorded, verified, replayed, measured and exported."""

import csv
import json

import pytest
from typer.testing import CliRunner

from recordings.reading.recording import open_recording
from schemas.messages.command import Command
from schemas.side import Side
from support.brisk import BRISK
from touchline.commands.cli.command_line import app

pytestmark = [pytest.mark.processes, pytest.mark.long, pytest.mark.timeout(400)]

NAMES = [f"{side.value}{number}" for side in Side for number in range(1, 12)]
MATCH = f"""
seed = 3
rules = "{BRISK}"
duration = 3

[teams.cyan]
size = 11

[teams.magenta]
size = 11

[patience]
answer = 60
"""
"""A machine that is busy with other things must not make a robot miss a tick."""


@pytest.fixture(scope="module")
def played(start, folder):
    (folder / "eleven.toml").write_text(MATCH)
    words = ("--record", "eleven.mcap", "--listen", "tcp/127.0.0.1:0", "--json")
    program = start("touchline", "match", "eleven.toml", *words, folder=folder, name="eleven")
    assert program.status() == 0, program.err
    return json.loads(program.out)


@pytest.fixture(scope="module")
def recording(played, folder):
    return folder / "eleven.mcap"


def run(*arguments):
    result = CliRunner().invoke(app, [str(argument) for argument in arguments])
    assert result.exit_code == 0, result.output
    return result.output


def test_twenty_two_robots_play_through_the_whole_stack(recording):
    """Every robot answers every tick, nothing is lost, and the recording is simulated again to the bit."""
    facts = open_recording(recording)
    assert facts.result.lost == facts.result.lost_batches == 0
    for name in NAMES:
        answered = [Command.decode(m.payload).answers_tick for m in facts.messages(f"robot/{name}/command")]
        assert answered == list(range(answered[0], answered[-1] + 1)), name
        assert answered[0] <= 1 and answered[-1] >= facts.result.tick - 2, name
    assert "identical" in run("verify", recording, "--jobs", "1")


def test_statistics_have_a_row_for_each_in_the_order_of_the_numbers(recording, folder):
    figures = json.loads(run("stats", recording, "--json", "--html", folder / "eleven.html"))
    assert [robot["name"] for robot in figures["robots"]] == NAMES
    page = (folder / "eleven.html").read_text()
    assert all(f'"{name}"' in page for name in NAMES)


def test_information_and_exports_have_all_robots(recording, folder):
    listed = [line.split()[0] for line in run("info", recording).splitlines() if line.startswith("robot/")]
    assert listed == [f"robot/{name}/command" for name in NAMES]
    run("export", recording, "--format", "csv", "--out", folder / "csv")
    with (folder / "csv" / "robots.csv").open() as table:
        assert list(dict.fromkeys(row["robot"] for row in csv.DictReader(table))) == NAMES


def test_the_leagues_log_takes_eleven_robots_a_side_there_and_back(recording, folder):
    run("export", recording, "--format", "msl-log", "--out", folder / "log.zip")
    run("import", folder / "log.zip", "--out", folder / "back.mcap")
    setup = open_recording(folder / "back.mcap").manifest.setup
    assert [name for team in setup.teams.values() for name in team.robots] == NAMES
