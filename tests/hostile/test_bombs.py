"""Files of some kB that claim to be GB cost little memory, and are refused in one line."""

import os
import struct
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from zipfile import ZIP_BZIP2, ZIP_DEFLATED, ZipFile

import pytest
from lz4 import frame as lz4
from mcap.data_stream import RecordBuilder
from mcap.records import Channel, Chunk, ChunkIndex, DataEnd, Footer, Header, Statistics
from mcap.writer import MCAP0_MAGIC

from recordings.container.chunks import unpacked
from recordings.soccer.league.log_files import log_files
from schemas.errors import TouchlineError

_MOST_KB = 200 * 1024
"""Memory of a command, with all that it imports."""
_ZEROS = 2**31
LOG = "20240701_120000.A.msl"
_MEASURED = """
import atexit, runpy
peak = lambda: print(next(line for line in open("/proc/self/status") if line.startswith("VmHWM:")), flush=True)
atexit.register(peak)
runpy.run_module("touchline", run_name="__main__", alter_sys=True)
"""
"""The kernel's own count of a process: `ru_maxrss` begins with the memory of whoever has started it."""


def zstd_of_zeros(size: int) -> bytes:
    """A frame that says how much it has, of blocks that repeat one byte 128 KiB long: 4 bytes each."""
    last, repeat, length = 1, 1 << 1, (1 << 17) << 3
    blocks = size >> 17
    block = struct.pack("<I", repeat | length)[:3] + b"\0"
    return (
        struct.pack("<IBBQ", 0xFD2FB528, 0xC0, 0x58, size)
        + block * (blocks - 1)
        + struct.pack("<I", last | repeat | length)[:3]
        + b"\0"
    )


def chunk_of(compression: str, data: bytes, claimed: int) -> Chunk:
    return Chunk(
        compression=compression,
        data=data,
        message_end_time=0,
        message_start_time=0,
        uncompressed_crc=0,
        uncompressed_size=claimed,
    )


def bomb(path: Path, claimed: int, *, finished: bool) -> Path:
    """A recording whose only chunk has 2 GiB of zeros, and claims to have so many bytes."""
    builder = RecordBuilder()

    def written(*records: object) -> bytes:
        for record in records:
            record.write(builder)  # type: ignore[attr-defined]
        return bytes(builder.end())

    packed = zstd_of_zeros(_ZEROS)
    head = MCAP0_MAGIC + written(Header(profile="", library=""))
    chunk = written(chunk_of("zstd", packed, claimed))
    if not finished:
        path.write_bytes(head + chunk)
        return path
    body = head + chunk + written(DataEnd(0))
    index = ChunkIndex(
        chunk_length=len(chunk),
        chunk_start_offset=len(head),
        compression="zstd",
        compressed_size=len(packed),
        message_end_time=0,
        message_index_length=0,
        message_index_offsets={},
        message_start_time=0,
        uncompressed_size=claimed,
    )
    counts = Statistics(
        attachment_count=0,
        channel_count=1,
        channel_message_counts={1: 1},
        chunk_count=1,
        message_count=1,
        message_end_time=0,
        message_start_time=0,
        metadata_count=0,
        schema_count=0,
    )
    channel = Channel(id=1, topic="world", message_encoding="json", metadata={"topic": "world"}, schema_id=0)
    summary = written(channel, counts, index)
    path.write_bytes(body + summary + written(Footer(len(body), 0, 0)) + MCAP0_MAGIC)
    return path


def memory_and_output(*words: str | Path) -> tuple[int, int, str]:
    """The most kB of memory of a command, its status, and what it says."""
    ended = subprocess.run(
        [sys.executable, "-c", _MEASURED, *map(str, words)],
        env={**os.environ, "OPENBLAS_NUM_THREADS": "1"},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        check=False,
    )
    said, _, peak = ended.stdout.rpartition("VmHWM:")
    return int(peak.split()[0]), ended.returncode, said


@pytest.mark.slow
@pytest.mark.parametrize(("finished", "claimed"), [(True, _ZEROS), (False, 1000)], ids=["what it has", "cut, little"])
@pytest.mark.parametrize("command", ["info", "verify", "stats", "recover", "replay"])
def test_a_chunk_of_zeros_costs_little_and_ends_in_one_line(
    tmp_path: Path, command: str, finished: bool, claimed: int
) -> None:
    path = bomb(tmp_path / "bomb.mcap", claimed, finished=finished)
    assert path.stat().st_size < 70_000
    kilobytes, status, said = memory_and_output(command, path)
    assert kilobytes < _MOST_KB
    assert (status, len(said.splitlines())) == (2, 1), said


@pytest.mark.parametrize("claimed", [1000, 2**26, 2**62])
@pytest.mark.parametrize("compression", ["zstd", "lz4"])
def test_a_chunk_that_packs_too_well_for_its_size_is_refused_whatever_it_claims(compression: str, claimed: int) -> None:
    data = {"zstd": zstd_of_zeros(2**26), "lz4": lz4.compress(bytes(2**26))}[compression]
    with pytest.raises(ValueError, match=rf"a chunk of {len(data)} bytes unpacks to more than 3\d MiB"):
        unpacked(chunk_of(compression, data, claimed))


@pytest.mark.slow
def test_a_zip_of_zeros_costs_little_and_ends_in_one_line(tmp_path: Path) -> None:
    path = tmp_path / "bomb.zip"
    with ZipFile(path, "w", ZIP_DEFLATED, compresslevel=1) as archive, archive.open(LOG, "w") as file:
        for _ in range(600):
            file.write(bytes(2**20))
    kilobytes, status, said = memory_and_output("import", path, "--out", tmp_path / "out.mcap")
    assert kilobytes < _MOST_KB
    assert status == 2 and len(said.splitlines()) == 1
    assert "too many for a log" in said


@contextmanager
def zipped(tmp_path: Path, kind: int, *sizes: int) -> Iterator[Path]:
    path = tmp_path / "log.zip"
    with ZipFile(path, "w", kind) as archive:
        for letter, size in zip("AB", sizes, strict=False):
            archive.writestr(f"20240701_120000.{letter}.msl", bytes(size))
    yield path


def test_all_files_of_a_zip_count_together(tmp_path: Path) -> None:
    with zipped(tmp_path, ZIP_DEFLATED, 2**24, 2**24) as path:
        assert len(log_files([path]).teams) == 2
    with zipped(tmp_path, ZIP_DEFLATED, 2**24, 2**24 + 1) as path, pytest.raises(TouchlineError, match="too many"):
        log_files([path])


def test_a_zip_that_is_packed_in_a_way_without_a_limit_is_refused(tmp_path: Path) -> None:
    with zipped(tmp_path, ZIP_BZIP2, 1000) as path, pytest.raises(TouchlineError, match="another way than deflate"):
        log_files([path])


def test_what_is_no_file_is_not_read_as_a_log(tmp_path: Path) -> None:
    with pytest.raises(TouchlineError, match="/dev/zero: not a file; give the path of a log"):
        log_files([Path("/dev/zero")])
    os.mkfifo(tmp_path / "20240701_120000.A.msl")
    with pytest.raises(TouchlineError, match=r"A\.msl: not a file"):
        log_files([tmp_path])
