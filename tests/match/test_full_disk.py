"""Matches whose recorder finds its disk full: the result is there, and the recording as far as the disk goes."""

import json
import resource

import pytest

from recordings.container.parts import parts_of
from recordings.editing.recovery import recover
from recordings.reading.recording import open_recording

pytestmark = [pytest.mark.processes, pytest.mark.timeout(300)]

FULL = 200_000
"""Most bytes of a file: what a full disk does, by size."""
MATCH = """
name = "full"
duration = 18

[teams.cyan]
robots = ["cyan1"]

[teams.magenta]
robots = ["magenta1"]
"""
"""1300 ticks or so: on a busy machine 250 wait for the recorder, and 512 in it, before it finds the disk full."""


def play(start, folder, endpoint):
    (folder / "match.toml").write_text(MATCH)
    words = ("match.toml", "--seed", "7", "--record", "m.mcap", "--json", "--listen", endpoint)
    return start("touchline", "match", *words, folder=folder)


def worlds(recording):
    return [world.tick for _, world in recording.decoded("world")]


def test_a_match_whose_disk_is_full_has_its_result_and_names_what_is_left(start, tmp_path, endpoint):
    program = play(start, tmp_path, endpoint)
    resource.prlimit(program.popen.pid, resource.RLIMIT_FSIZE, (FULL, FULL))  # before its processes, which inherit it
    assert program.status() == 1
    result = json.loads(program.out)
    assert result["ticks"] > 300
    assert set(result["score"]) == {"cyan", "magenta"}
    assert program.err.splitlines()[-1] == f"touchline: {result['recording_fault']}"
    assert "File too large" in result["recording_fault"]
    assert result["recording"] == "m.mcap"

    for part in parts_of(tmp_path / "m.mcap"):
        recover(part)
    ticks = worlds(open_recording(tmp_path / "m.mcap", whole=True))
    assert ticks == list(range(len(ticks)))
    assert ticks


def test_a_recording_goes_on_when_there_is_room_again(start, tmp_path, endpoint):
    program = play(start, tmp_path, endpoint)
    resource.prlimit(program.process("recorder"), resource.RLIMIT_FSIZE, (FULL, FULL))  # not its successor
    assert program.status() == 0, program.err
    assert "recorder ended with status 2; started again (1 of 3)" in program.err
    recording = open_recording(tmp_path / "m.mcap", whole=True)
    result = json.loads(program.out)
    assert worlds(recording) == list(range(result["ticks"] + 1))
    assert recording.result.lost == 0
