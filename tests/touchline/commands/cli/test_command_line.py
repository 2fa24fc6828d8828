import json
import re
import socket
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from typer.main import get_command
from typer.testing import CliRunner, Result

from recordings.exchange.formats import EXPORTERS
from schemas.topics import TOPICS
from touchline.commands.cli.command_line import app
from touchline.commands.cli.table import PANELS

COMMANDS = [command for commands in PANELS.values() for command in commands]
MEANINGS = {
    "--to": ["End, inclusive: seconds, tick", "End, simulated s, exclusive."],
    "--from": ["Start: seconds, tick", "Start, simulated s."],
    "--match": ["For this match alone", "Name of the match"],
    "--record": ["Keep a recording of each match in this folder", "The recording to write"],
}
"""Option → how its help begins, in whichever command."""
NOBODY = "--connect=tcp/127.0.0.1:9"


def touchline(*words: str, **environment: str) -> Result:
    return CliRunner().invoke(app, list(words), prog_name="touchline", env=environment)


@pytest.mark.parametrize("command", COMMANDS)
def test_every_command_has_help_with_an_example(command: str) -> None:
    result = touchline(command, "--help")
    assert result.exit_code == 0
    assert f"Example: touchline {command}" in result.stdout


def commands_below(command: Any) -> Iterator[Any]:
    """A command and all below it."""
    yield command
    for below in getattr(command, "commands", {}).values():
        yield from commands_below(below)


@pytest.mark.parametrize("option", MEANINGS)
def test_an_option_has_one_meaning_in_all_commands(option: str) -> None:
    helps = {row.help for one in commands_below(get_command(app)) for row in one.params if option in row.opts}
    assert [text for text in sorted(helps) if not text.startswith(tuple(MEANINGS[option]))] == []


def test_the_help_has_each_command_once_in_its_group() -> None:
    groups: dict[str, list[str]] = {}
    for line in touchline("--help").stdout.splitlines():
        if line.startswith("╭─ "):
            groups[line.strip("╭╮─ ")] = commands = []
        elif line.startswith("│ ") and not line.startswith("│  "):
            commands.append(line.split()[1])
    assert {name: tuple(found) for name, found in groups.items() if name != "Options"} == PANELS


def test_the_version_is_printed_with_those_of_what_it_depends_on() -> None:
    result = touchline("--version")
    assert result.exit_code == 0
    assert re.fullmatch(r"touchline \d+\.\d+\.\d+, protocol 2\.0, Python 3\.\d+\.\d+, PyBullet [\d.]+\n", result.stdout)


WRONG: dict[str, tuple[list[str], str]] = {
    "a command that is not known": (["mtach"], "'match'"),
    "an option that is not known": (["match", "--sed", "3"], "--seed"),
    "a number that is none": (["match", "--seed", "three"], "valid integer"),
    "a negative seed": (["match", "--seed", "-3"], "seed is -3; a whole number"),
    "a pace that is none": (["match", "--pace", "fast"], "pace is 'fast'; write \"lockstep\""),
    "a recording that is none": (["match", "--no-record", "--record", "a.mcap"], "--no-record exclude each other"),
    "the worst of no failures": (["task", "run", "coverage", "--show"], "--failures; give that, too"),
    "a duration below zero": (["match", "--duration", "-1"], "duration is -1"),
    "an unknown rule book": (["match", "--rules", "freindly"], '.toml; did you mean "friendly"?'),
    "an unknown profile": (["match", "--profile", "mls"], '.toml; did you mean "msl"?'),
    "a match file that is not there": (["match", "cup.toml"], "cup.toml: No such file"),
    "a match name that is no key": (["host", "--match", "The Cup"], "name is 'The Cup'"),
    "an open host without a word on it": (["host", "--listen", "tcp/0.0.0.0:0"], "add --insecure"),
    "an open host without passwords": (["host", "--listen", "tcp/[::]:0"], "touchline credentials new"),
    "TLS without a certificate": (["host", "--listen", "tls/127.0.0.1:0"], "touchline credentials new --tls"),
    "TLS for a match that admits everybody": (["match", "--tls", "--insecure"], "not for --insecure"),
    "credentials of a host that are not there": (["host", "--credentials", "host.json"], "host.json: No such file"),
    "credentials that are not there": (["referee", "start", "--credentials", "cyan.json"], "cyan.json: No such file"),
    "a name without a certificate": (["credentials", "new", "--host-name", "sim"], "add --tls"),
    "a name that is none": (["credentials", "new", "--tls", "--host-name", "a b"], "not a host name or address"),
    "an endpoint of credentials that is none": (["credentials", "new", "--connect", "here"], "--connect is 'here'"),
    "an endpoint that is none": (["host", "--listen", "localhost"], "--listen is 'localhost'; write it as tcp/"),
    "a foreign address to listen on": (["host", "--listen", "tcp/192.0.2.1:7447", "--insecure"], "cannot be listened"),
    "an agent without a robot": (["agent", "--brain", "a:B"], "--robot"),
    "a coach's endpoint that is none": (["referee", "start", "--connect", "here"], "--connect is 'here'"),
    "a coach's match that is no key": (["referee", "start", "--match", "a/*"], "--match is 'a/*'"),
    "a coach without a host": (["referee", "start", NOBODY], "no host answers there"),
    "a coach's order beyond reason": (["coach", "order", "cyan", "--max-speed", "90"], "--max-speed is 90"),
    "a side that is none": (["referee", "kickoff", "red"], "'cyan', 'magenta'"),
    "a mode that is none": (["coach", "order", "cyan", "--mode", "run"], "'hold'"),
    "a parameter without a value": (["parameters", "set", "ball.mass"], "write NAME=VALUE"),
    "a parameter whose name is none": (["parameters", "get", "Ball"], "'Ball' is no parameter"),
    "parameters without a host": (["parameters", "list", NOBODY], "no host answers there"),
    "a scene that is not there": (["scene", "list", "penlty"], '.toml; did you mean "penalty"?'),
    "a match in no scene": (["match", "--scene", "penlty"], '.toml; did you mean "penalty"?'),
    "a scene without a host": (["scene", "reset", NOBODY], "no host answers there"),
    "a velocity beyond reason": (["scene", "place", "ball", "0", "0", "--vx", "nan"], "scene place: place.0.vx is"),
    "an obstacle without a shape": (["scene", "add-obstacle", "wall", "0", "0"], "give --radius and --height"),
    "a key that is none": (["diff", "a.mcap", "b.mcap", "--include", "a//b"], '"a//b" is not a key expression'),
    "a file to recover that is not there": (["recover", "no.mcap"], "no.mcap: No such file"),
    "a part of no size": (["record", "--out", "a.mcap", "--part-size", "0"], "--part-size"),
    "a recording that is not there": (["info", "no.mcap"], "no.mcap"),
    "figures of a recording that is not there": (["stats", "no.mcap", "--html", "a.html"], "no.mcap"),
    "a schema that is not there": (["topics", "sihgt"], 'did you mean "sight"?'),
    "a topic without message": (["topics", "alive"], 'schema of "alive"'),
}


@pytest.mark.parametrize("case", WRONG)
def test_wrong_input_gives_one_line_with_the_remedy_and_status_2(
    case: str, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("touchline.commands.cli.bus_client.REQUEST_S", 0.0)
    words, remedy = WRONG[case]
    result = touchline(*words)
    assert result.exit_code == 2
    assert result.stdout == ""
    assert remedy in result.stderr
    assert len(result.stderr.splitlines()) == 1
    assert list(tmp_path.iterdir()) == []


def test_credentials_are_made_once_and_replaced_only_on_request(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.chdir(tmp_path)
    made = touchline("credentials", "new", "--tls", "--host-name", "sim.example", "--match", "cup")
    assert made.exit_code == 0 and "touchline host --credentials credentials/host.json" in made.stdout
    file = tmp_path / "credentials" / "cyan.json"
    first = file.read_text()
    again = touchline("credentials", "new")
    assert (again.exit_code, file.read_text()) == (2, first) and "add --force" in again.stderr
    assert touchline("credentials", "new", "--force").exit_code == 0
    assert file.read_text() != first


def test_a_host_whose_port_is_in_use_names_it() -> None:
    with socket.socket() as other:
        other.bind(("127.0.0.1", 0))
        other.listen()
        endpoint = f"tcp/127.0.0.1:{other.getsockname()[1]}"
        result = touchline("host", "--listen", endpoint)
    assert result.exit_code == 2
    assert f"--listen {endpoint} is in use by another process; choose another port" in result.stderr


@pytest.mark.parametrize("command", ["match", "host"])
def test_without_pybullet_the_pip_line_that_brings_it_is_named(command: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("importlib.util.find_spec", lambda name, package=None: None)
    result = touchline(command)
    assert result.exit_code == 2
    assert "pip install 'touchline[sim]'" in result.stderr


def test_the_command_line_loads_nothing_heavy() -> None:
    heavy = {"zenoh", "pybullet", "mcap", "numpy", "matplotlib", "touchline.commands.match"}
    code = f"import sys, touchline.commands.cli.command_line; print(*{heavy} & set(sys.modules))"
    found = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert found.stdout.split() == []


def test_standard_output_on_a_full_disk_is_one_line() -> None:
    with Path("/dev/full").open("w") as full:
        run = subprocess.run([sys.executable, "-m", "touchline", "topics"], stdout=full, stderr=subprocess.PIPE)
    assert (run.returncode, run.stderr) == (
        1,
        b"touchline: standard output: No space left on device; make room there\n",
    )


def test_the_topic_table_is_printed_whole() -> None:
    lines = touchline("topics").stdout.splitlines()
    for name, topic in TOPICS.items():
        assert any(line.split()[:2] == [name, topic.key] for line in lines)


def test_the_topic_table_as_json_has_the_readers_of_each_topic() -> None:
    rows = {row["name"]: row for row in json.loads(touchline("topics", "--json").stdout)}
    assert set(rows) == set(TOPICS)
    assert rows["command"]["key"] == "robot/{robot}/command"
    assert rows["command"]["from"] == ["robot"]
    assert rows["command"]["to"] == ["host", "recorder"]


@pytest.mark.parametrize("name", ["command", "Command"])
def test_a_schema_is_found_by_topic_and_by_class(name: str) -> None:
    schema = json.loads(touchline("topics", name).stdout)
    assert schema["title"] == "Command"
    assert "answers_tick" in schema["required"]


def test_every_topic_with_a_message_has_a_schema() -> None:
    for name, topic in TOPICS.items():
        if topic.message is not None:
            assert json.loads(touchline("topics", name).stdout)["title"] == topic.message.__name__


def test_an_environment_variable_stands_in_for_an_option() -> None:
    result = touchline("referee", "start", TOUCHLINE_CONNECT="nowhere")
    assert result.exit_code == 2
    assert "--connect is 'nowhere'; write it as tcp/127.0.0.1:7447" in result.stderr


def test_the_help_of_export_lists_every_format() -> None:
    help_text = touchline("export", "--help").stdout
    assert [name for name in EXPORTERS if name not in help_text] == []
