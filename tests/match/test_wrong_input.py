"""What cannot be played is refused by the real command line: status 2, one line, and nothing left behind."""

import os
import socket

import pytest

pytestmark = [pytest.mark.processes, pytest.mark.timeout(300)]

WRONG = {
    "more robots than the rules allow": (
        "rules = 'msl'\n[teams.magenta]\nsize = 6",
        "magenta has 6 robots; the rules msl allow 5 of a side; 6 are allowed by eleven, friendly",
    ),
    "a robot named as a process": (
        "[teams.cyan]\nrobots = ['recorder', 'cyan2']",
        'a robot is named "recorder", as a process of the match is; rename it',
    ),
    "an obstacle on a robot": (
        "[[obstacles]]\nname = 'pole'\nshape = 'cylinder'\nplace = [-10.5, 0.1]\nradius = 0.1\nheight = 1.0",
        "cyan1 at (-10.5, 0) would be 0.24 m inside pole; choose another place",
    ),
}
BROKEN = "raise ModuleNotFoundError(\"No module named 'pybullet'\", name='pybullet')\n"


def refused(program, words):
    assert program.status() == 2, program.err
    assert program.out == ""
    (line,) = program.err.splitlines()
    assert line.startswith("touchline: ")
    assert words in line


@pytest.mark.parametrize("case", WRONG)
def test_a_wrong_match_file_is_refused_in_one_line(start, tmp_path, case):
    text, words = WRONG[case]
    (tmp_path / "match.toml").write_text(text)
    refused(start("touchline", "match", "match.toml", "--listen", "tcp/127.0.0.1:0", folder=tmp_path), words)
    assert not (tmp_path / "runs").exists()


def test_a_port_in_use_is_refused_in_one_line(start, tmp_path):
    with socket.socket() as other:
        other.bind(("127.0.0.1", 0))
        other.listen()
        endpoint = f"tcp/127.0.0.1:{other.getsockname()[1]}"
        refused(start("touchline", "match", "--listen", endpoint, folder=tmp_path), f"{endpoint} is in use")
    assert not (tmp_path / "runs").exists()


@pytest.mark.parametrize(
    ("option", "kind"), [("--udp", socket.SOCK_DGRAM), ("--refbox-server", socket.SOCK_STREAM)], ids=["udp", "box"]
)
def test_a_port_of_a_bridge_in_use_is_refused_before_anything_is_launched(start, tmp_path, option, kind):
    with socket.socket(socket.AF_INET, kind) as other:
        other.bind(("127.0.0.1", 0))
        if kind is socket.SOCK_STREAM:
            other.listen()
        port = str(other.getsockname()[1])
        program = start("touchline", "match", "--listen", "tcp/127.0.0.1:0", option, port, folder=tmp_path)
        refused(program, f"{option} {port} cannot be listened on at 127.0.0.1")
    assert not (tmp_path / "runs").exists()


def test_a_pybullet_that_is_there_and_cannot_be_imported_is_named_by_the_host(start, tmp_path):
    (tmp_path / "broken").mkdir()
    (tmp_path / "broken" / "pybullet.py").write_text(BROKEN)
    others = os.environ.get("PYTHONPATH")
    path = os.pathsep.join([str(tmp_path / "broken"), *([others] if others else [])])
    program = start("touchline", "match", "--json", "--listen", "tcp/127.0.0.1:0", folder=tmp_path, PYTHONPATH=path)
    assert program.status() == 2
    assert program.out == ""
    assert "pip install 'touchline[sim]'" in program.err.splitlines()[-1]
    assert "Traceback" not in program.err
