"""One file has one writer: a second one is refused before it has written a byte, in any process."""

import subprocess
import sys
from pathlib import Path

import pytest

from recordings.container.numbering import files_at
from recordings.container.partial_file import PartialFile
from recordings.editing.filtering import filter_recording
from recordings.editing.recovery import recover
from recordings.reading.recording import open_recording
from recordings.recorder.file_limits import FileLimits
from schemas.errors import TouchlineError

REFUSED = r"match\.mcap: is being written by another recorder; name another file"

HOLDER = """
import sys
from pathlib import Path
from recordings.container.partial_file import PartialFile
part = PartialFile(Path(sys.argv[1]))
part.file.write(b"written by the first")
part.file.flush()
print("holds it", flush=True)
sys.stdin.read()
"""


def test_a_second_recorder_of_one_path_is_refused_and_the_first_loses_nothing(make_rig):
    first = make_rig()
    first.begin()
    first.play(range(50))
    with pytest.raises(TouchlineError, match=REFUSED):
        make_rig()
    first.play(range(50, 100))
    assert first.leave().result.lost == 0
    assert [world.tick for _, world in first.read().decoded("world")] == list(range(100))
    assert [file.name for file in first.path.parent.iterdir()] == ["match.mcap"]


def test_recorders_of_many_files_do_not_share_a_path_either(make_rig):
    limits = FileLimits(duration=1.0)
    first = make_rig(limits=limits)
    first.begin()
    with pytest.raises(TouchlineError, match=r"match\.0001\.mcap: is being written by another recorder"):
        make_rig(limits=limits)
    first.play(range(10))
    first.leave()
    assert list(first.path.parent.glob("*.part*")) == []
    assert len(files_at(first.path)) == 1


def test_a_copy_does_not_take_the_file_of_a_recorder(recorded, tmp_path):
    held = PartialFile(tmp_path / "copy.mcap")
    with pytest.raises(TouchlineError, match=r"copy\.mcap: is being written by another recorder"):
        filter_recording(recorded, tmp_path / "copy.mcap")
    assert held.path.exists()
    held.discard()


def test_what_is_still_being_written_is_not_repaired(make_rig):
    rig = make_rig()
    rig.begin()
    rig.play(range(50))
    rig.sink.sync()
    part = rig.path.with_name("match.mcap.part")
    with pytest.raises(TouchlineError, match=r"match\.mcap\.part: is being written by a recorder; end that one"):
        recover(part)
    rig.play(range(50, 100))
    rig.leave()
    assert open_recording(rig.path, whole=True).result.keys["world"].messages == 100
    assert not recover(rig.path).repaired


def test_another_process_is_refused_until_the_first_has_died_and_what_that_left_is_kept(tmp_path):
    path = tmp_path / "match.mcap"
    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE}
    with subprocess.Popen([sys.executable, "-c", HOLDER, str(path)], **pipes) as first:
        assert first.stdout.readline() == b"holds it\n"
        with pytest.raises(TouchlineError, match=REFUSED):
            PartialFile(path)
        assert sorted(file.name for file in tmp_path.iterdir()) == ["match.mcap.part"]
        first.kill()
        first.wait()
    second = PartialFile(path)
    assert second.path.read_bytes() == b""
    assert (tmp_path / "match.mcap.part.old").read_bytes() == b"written by the first"
    second.discard()


def test_an_empty_leftover_does_not_push_aside_what_was_kept(tmp_path):
    kept = tmp_path / "match.mcap.part.old"
    kept.write_bytes(b"seconds of a match")
    (tmp_path / "match.mcap.part").write_bytes(b"")
    PartialFile(tmp_path / "match.mcap").discard()
    assert kept.read_bytes() == b"seconds of a match"


def test_a_file_that_has_got_its_name_is_free_for_the_next(tmp_path):
    path = tmp_path / "match.mcap"
    for content in (b"first", b"second"):
        part = PartialFile(path)
        part.file.write(content)
        part.file.flush()
        part.finish()
        assert path.read_bytes() == content
    assert [file.name for file in tmp_path.iterdir()] == ["match.mcap"]


def test_a_folder_is_refused_before_a_match_is_recorded_into_nothing(tmp_path: Path):
    with pytest.raises(TouchlineError, match="is a folder; give a path that can be written"):
        PartialFile(tmp_path)
    assert list(tmp_path.iterdir()) == []
