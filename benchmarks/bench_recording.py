"""Recordings: the cost of recording, and the speed of verification, replay, recovery and seeking.

The recordings are of real matches: five a side in lockstep and in real time, with the teams that ship. The size of ten
minutes is extrapolated from a shorter match. The file of 100 MB repeats the chunks of that match, without an index, as
in a file that was cut off.
"""

import contextlib
import json
import os
import statistics
import subprocess
import sys
import tempfile
import time
from itertools import pairwise
from pathlib import Path

from running_match import HERE, launch, running_match

from recordings.editing.recovery import recover
from recordings.reading.recording import open_recording
from recordings.recorder.settings import RecorderSettings
from runtime.bus.contract import Subscription
from runtime.bus.zenoh.bus import open_client
from runtime.process.clock import WallClock
from schemas.topics import HEALTH, WORLD
from touchline.verify.resimulate import verify

MATCH_S = 20
INTERVALS = 9
INTERVAL_S = 4.0
"""Wall time in which a match is recorded, then not, in turn. The intervals are short and many, because the load of
other programs changes by more than the cost of recording."""
SETTLE_S = 0.5
"""Wall time after which a recorder's start or end has no more effect."""
WARM_TICKS = 200
REALTIME_S = 10.0
PATIENCE_S = 120.0
"""Longest wall time in which a dozen processes start on a busy machine."""
MB = 1_000_000
CHUNK, DATA_END, METADATA, ATTACHMENT = 0x06, 0x0F, 0x0C, 0x09
"""Opcodes of MCAP records."""


def cpu_seconds(process: int) -> float:
    """User and system time of a process so far."""
    fields = Path(f"/proc/{process}/stat").read_text().rsplit(") ", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def recorder_share(folder: Path) -> float:
    """CPU time of a recorder of five a side in real time, as a share of one core."""
    with running_match("robot_agent.teams.simple:Simple", {"duration": 3600.0, "pace": "realtime"}) as (
        config,
        endpoint,
        *_,
    ):
        out = folder / "realtime.mcap"
        recorder = launch("recordings", RecorderSettings(connect=endpoint, match=config.name, out=out))
        try:
            with open_client(config.name, WallClock(), endpoint, PATIENCE_S) as bus:
                healths = bus.subscribe(HEALTH)
                while (received := healths.receive(PATIENCE_S)) is not None and received.message().tick < 100:
                    pass
                busy, began = cpu_seconds(recorder.pid), time.perf_counter()
                time.sleep(REALTIME_S)
                return (cpu_seconds(recorder.pid) - busy) / (time.perf_counter() - began)
        finally:
            recorder.terminate()
            recorder.wait()


def play(path: Path) -> None:
    """Record a lockstep match."""
    command = [sys.executable, "-m", "touchline", "match", "--duration", str(MATCH_S), "--seed", "7"]
    command += ["--listen", "tcp/127.0.0.1:0", "--record", str(path)]
    subprocess.run(command, cwd=path.parent, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=True)


def speed(healths: Subscription) -> float:
    """Ticks per s of wall time of a host, measured over one interval."""
    marks = []
    while not marks or marks[-1][0] - marks[0][0] < INTERVAL_S:
        while healths.receive() is not None:
            pass
        received = healths.receive(PATIENCE_S)
        assert received is not None
        marks.append((time.perf_counter(), received.message().tick))
    (began, first), (ended, last) = marks[0], marks[-1]
    return float((last - first) / (ended - began))


def compare(folder: Path) -> list[float]:
    """Speed of a lockstep match with recording relative to without: recorders join one match and leave it again.

    Each interval with one is compared with the two intervals without around it.
    """
    with (
        running_match("robot_agent.teams.simple:Simple", {"duration": 3600.0}) as (config, endpoint, *_),
        open_client(config.name, WallClock(), endpoint, PATIENCE_S) as bus,
    ):
        healths, watch = bus.subscribe(HEALTH), bus.watch_alive()
        while (received := healths.receive(PATIENCE_S)) is not None and received.message().tick < WARM_TICKS:
            pass
        without, with_recorder = [speed(healths)], []
        for _ in range(INTERVALS):
            settings = RecorderSettings(connect=endpoint, match=bus.match, out=folder / "m.mcap")
            recorder = launch("recordings", settings)
            try:
                came = watch.receive(PATIENCE_S)
                while came is not None and (came.kind, came.alive) != ("recorder", True):
                    came = watch.receive(PATIENCE_S)
                time.sleep(SETTLE_S)
                with_recorder.append(speed(healths))
            finally:
                recorder.terminate()
                recorder.wait()
            time.sleep(SETTLE_S)
            without.append(speed(healths))
    around = [(before + after) / 2 for before, after in pairwise(without)]
    return sorted(ours / others for ours, others in zip(with_recorder, around, strict=True))


def replay(path: Path) -> float:
    """Simulated s per s of wall time of a replay as fast as possible, onto a bus without subscribers."""
    command = [
        sys.executable,
        "-m",
        "touchline",
        "replay",
        str(path),
        "--fast",
        "--json",
        "--listen",
        "tcp/127.0.0.1:0",
    ]
    ended = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, check=True)
    played = json.loads(ended.stdout)
    return float((played["end"] - played["start"]) / played["wall_s"])


def cut_off(source: Path, path: Path, size: int) -> int:
    """Write a file of about `size` bytes as a killed recorder leaves it: head, repeated chunks. Returns its size."""
    content = source.read_bytes()
    at, head, chunks = 8, [content[:8]], []
    while content[at] != DATA_END:
        end = at + 9 + int.from_bytes(content[at + 1 : at + 9], "little")
        (head if not chunks and content[at] != CHUNK else chunks).append(content[at:end])
        at = end
    body = b"".join(record for record in chunks if record[0] not in (METADATA, ATTACHMENT))
    path.write_bytes(b"".join(head) + body * (1 + size // len(body)))
    return path.stat().st_size


def seek_ms(path: Path) -> float:
    """The longest time to open a recording and read the first world from 0, 50 or 99 % of it on, in ms."""
    end = open_recording(path).channels[0].end
    longest = 0.0
    for share in (0.0, 0.5, 0.99):
        began = time.perf_counter()
        next(open_recording(path).messages(WORLD.key, start=share * end))
        longest = max(longest, time.perf_counter() - began)
    return longest * 1e3


def main() -> None:
    """Print each figure beside its limit."""
    with tempfile.TemporaryDirectory() as name, contextlib.chdir(HERE):
        folder = Path(name)
        print(f"recorder: {recorder_share(folder):.1%} of a core in real time, five a side (below 6 %)")
        path = folder / "match.mcap"
        play(path)
        ratios = compare(folder)
        print(
            f"lockstep with recording: {statistics.median(ratios):.2f} x the speed without (at least 0.95), median of "
            f"{INTERVALS} intervals from {ratios[0]:.2f} to {ratios[-1]:.2f}"
        )
        busy = time.process_time()
        verdict = verify(path)
        busy = time.process_time() - busy
        assert verdict.identical
        print(
            f"verify: {verdict.seconds / busy:.0f} x real time on one core (at least 25), "
            f"{verdict.ticks} ticks identical; by CPU time"
        )
        print(f"replay as fast as possible: {replay(path):.0f} x real time (at least 40)")
        size = cut_off(path, folder / "large.mcap", 100 * MB)
        began = time.perf_counter()
        recovered = recover(folder / "large.mcap")
        took = time.perf_counter() - began
        print(f"recover: {size / MB:.0f} MB, {recovered.messages} messages in {took:.2f} s (below 20 s)")
        print(f"seek: {seek_ms(path):.0f} ms at most in the match, file opened anew (below 50 ms)")
        ten_minutes = path.stat().st_size / verdict.seconds * 600 / MB
        print(f"size: {ten_minutes:.0f} MB for ten minutes (below 80), from {verdict.seconds:.0f} s of a match")


if __name__ == "__main__":
    main()
