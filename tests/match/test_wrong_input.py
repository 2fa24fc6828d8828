"""What cannot be played is refused by the real command line: status 2, one line, and nothing left behind."""

import os
import socket

import pytest

pytestmark = [pytest.mark.processes, pytest.mark.timeout(300)]

WRONG = """
[[obstacles]]
name = "pole"
shape = "cylinder"
place = [-10.5, 0.1]
radius = 0.1
height = 1.0
"""
BROKEN = "raise ModuleNotFoundError(\"No module named 'pybullet'\", name='pybullet')\n"


def refused(program, words):
    assert program.status() == 2, program.err
    assert program.out == ""
    (line,) = program.err.splitlines()
    assert line.startswith("touchline: ")
    assert words in line


def test_a_wrong_match_file_is_refused_in_one_line(start, tmp_path):
    (tmp_path / "match.toml").write_text(WRONG)
    program = start("touchline", "match", "match.toml", "--listen", "tcp/127.0.0.1:0", folder=tmp_path)
    refused(program, "cyan1 at (-10.5, 0) would be 0.24 m inside pole; choose another place")
    assert not (tmp_path / "runs").exists()


def test_a_port_of_a_bridge_in_use_is_refused_before_anything_is_launched(start, tmp_path):
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as other:
        other.bind(("127.0.0.1", 0))
        port = str(other.getsockname()[1])
        program = start("touchline", "match", "--listen", "tcp/127.0.0.1:0", "--udp", port, folder=tmp_path)
        refused(program, f"--udp {port} cannot be listened on at 127.0.0.1")
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
