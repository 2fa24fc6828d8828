"""The parts of a recording: their names, and that each has one writer."""

import subprocess
import sys
from pathlib import Path

import pytest

from recordings.container.parts import create_part, locked, part_path, parts_of
from recordings.editing.recovery import recover
from recordings.reading.recording import open_recording
from recordings.recorder.earlier_parts import read_earlier_parts
from schemas.errors import TouchlineError

HOLDER = """
import sys
from pathlib import Path
from recordings.container.parts import create_part
file = create_part(Path(sys.argv[1]))
print("holds it", flush=True)
sys.stdin.read()
"""


def test_a_recording_is_its_file_and_the_numbered_parts_after_it(tmp_path: Path) -> None:
    path = tmp_path / "final.mcap"
    assert parts_of(path) == []
    for name in ("final.mcap", "final.2.mcap", "final.3.mcap", "final.5.mcap", "semifinal.4.mcap"):
        (tmp_path / name).touch()
    assert [part.name for part in parts_of(path)] == ["final.mcap", "final.2.mcap", "final.3.mcap"]
    assert parts_of(part_path(path, 3)) == [tmp_path / "final.3.mcap"]


def test_a_file_that_is_there_is_not_touched(tmp_path: Path) -> None:
    path = tmp_path / "final.mcap"
    path.write_bytes(b"another one's")
    with pytest.raises(TouchlineError, match=r"final\.mcap: already exists; name another file, or move that one away"):
        create_part(path)
    assert path.read_bytes() == b"another one's"


@pytest.mark.parametrize(
    ("name", "reason"),
    [("", "is a folder"), ("none/final.mcap", "make it with: mkdir -p"), ("file/final.mcap", "Not a directory")],
)
def test_a_path_that_cannot_be_written_is_refused_with_the_reason(tmp_path: Path, name: str, reason: str) -> None:
    (tmp_path / "file").touch()
    with pytest.raises(TouchlineError, match=reason):
        create_part(tmp_path / name)


def test_a_second_recorder_of_one_path_is_refused_and_the_first_loses_nothing(make_rig) -> None:
    first = make_rig()
    first.begin()
    first.play(range(50))
    with pytest.raises(TouchlineError, match=r"match\.mcap: is being written by a recorder"):
        read_earlier_parts(first.path, host=0)
    with pytest.raises(TouchlineError, match=r"match\.mcap: already exists"):
        make_rig()
    first.play(range(50, 100))
    assert first.leave().result.lost == 0
    assert [world.tick for _, world in first.read().decoded("world")] == list(range(100))
    assert [file.name for file in first.path.parent.iterdir()] == ["match.mcap"]


def test_what_is_still_being_written_is_not_repaired(make_rig) -> None:
    rig = make_rig()
    rig.begin()
    rig.play(range(50))
    rig.sink.sync()
    with pytest.raises(TouchlineError, match=r"match\.mcap: is being written by a recorder; end that one"):
        recover(rig.path)
    rig.play(range(50, 100))
    rig.leave()
    assert open_recording(rig.path, whole=True).result.keys["world"].messages == 100
    assert not recover(rig.path).repaired


def test_a_part_is_locked_until_its_process_has_died(tmp_path: Path) -> None:
    path = tmp_path / "match.mcap"
    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE}
    with subprocess.Popen([sys.executable, "-c", HOLDER, str(path)], **pipes) as first:
        assert first.stdout.readline() == b"holds it\n"
        with pytest.raises(TouchlineError, match="is being written"), locked(path):
            pass
        first.kill()
        first.wait()
    with locked(path):
        pass
