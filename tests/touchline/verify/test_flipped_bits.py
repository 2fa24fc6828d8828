"""A recording in which any one bit has changed: once repaired, every program reads it as far as it goes."""

import random
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

from recordings.container import mcap_writer
from recordings.editing.recovery import recover
from recordings.exchange import csv_files
from recordings.inspection.recording_facts import facts_of
from recordings.reading.cursor import Cursor
from recordings.reading.recording import Recording, open_recording
from recordings.soccer.stats.match_statistics import figures_of_recording
from schemas.config.match_config import load_match
from schemas.errors import TouchlineError
from touchline.verify.resimulate import verify

FLIPS = 20
UNTIL_S = 2.0

Entry = tuple[str, int, int, bytes]


@pytest.fixture(scope="module")
def short_match(tmp_path_factory: pytest.TempPathFactory, match_recorder: Callable[..., None]) -> Path:
    """Two seconds of two robots, in a dozen chunks."""
    path = tmp_path_factory.mktemp("flipped") / "match.mcap"
    teams = {"teams.cyan.size": 1, "teams.magenta.size": 1}
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(mcap_writer, "CHUNK_BYTES", 24_000)
        match_recorder(path, load_match(None, {"seed": 3, "duration": 10.0, **teams}), until=UNTIL_S)
    return path


def replayed(path: Path) -> list[Entry]:
    """All messages, as a replay publishes them."""
    cursor = Cursor(path)
    entries = []
    while (message := cursor.peek()) is not None:
        entries.append((message.key, message.sequence, message.log_ns, message.payload))
        cursor.skip()
    cursor.seek(round(UNTIL_S / 2 * 1e9))
    cursor.latched(round(UNTIL_S * 1e9), lambda _: True)
    return entries


def read(recording: Recording) -> list[Entry]:
    return [(one.key, one.sequence, one.log_ns, one.payload) for one in recording.messages()]


def is_subsequence(part: list[Entry], whole: list[Entry]) -> bool:
    rest = iter(whole)
    return all(entry in rest for entry in part)


@pytest.mark.parametrize("finished", [True, False])
def test_a_file_with_a_flipped_bit_is_replayed_exported_and_verified_once_it_is_repaired(
    short_match: Path, tmp_path: Path, finished: bool
) -> None:
    data = short_match.read_bytes()
    if not finished:
        data = data[: data.rindex(b"result") - 20]
    path, tables = tmp_path / "flipped.mcap", tmp_path / "tables"
    path.write_bytes(data)
    whole = read(open_recording(path))
    places, verified = random.Random(14), 0
    for _ in range(FLIPS // 2):
        changed = bytearray(data)
        changed[places.randrange(8, len(data))] ^= 1 << places.randrange(8)
        path.write_bytes(changed)
        recover(path)
        recording = open_recording(path, whole=True)
        kept = read(recording)
        assert replayed(path) == kept
        assert is_subsequence(kept, whole)
        assert facts_of(recording).messages == len(kept)
        if not any(entry[0] == "world" for entry in kept):
            continue  # the chunk that introduced the keys is damaged, and no summary repeats it
        figures_of_recording(recording)
        csv_files.export(recording, tables)
        shutil.rmtree(tables)
        try:
            verdict = verify(path)
        except TouchlineError as error:
            assert "no tick can be simulated again" in str(error)  # its first chunk is damaged
            continue
        assert verdict.difference is None
        verified += 1
    assert verified > FLIPS // 4
