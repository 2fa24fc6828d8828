"""What `touchline health --doctor` finds on a machine, from given facts."""

import resource
from dataclasses import replace
from pathlib import Path

import pytest

from runtime.bus.announcement import Announcement
from touchline.commands.diagnosis.doctor.clock_offset import clock_offset
from touchline.commands.diagnosis.doctor.finding import Finding, Status
from touchline.commands.diagnosis.doctor.machine import MachineFacts, examine_machine

GOOD = MachineFacts(
    python="3.11.2",
    packages=frozenset({"pybullet", "starlette", "uvicorn", "websockets", "foxglove", "rosbags", "xxhash", "trustme"}),
    cores=4,
    folder=Path("/matches/runs"),
    free_bytes=50_000_000_000,
    open_files=20_000,
    matches=(),
)


def found(name: str, **changes: object) -> Finding:
    (finding,) = (one for one in examine_machine(replace(GOOD, **changes)) if one.name == name)  # type: ignore[arg-type]
    return finding


def test_on_a_machine_that_has_everything_nothing_is_to_be_done() -> None:
    assert {(one.status, one.remedy) for one in examine_machine(GOOD)} == {(Status.OK, "")}


@pytest.mark.parametrize(
    ("name", "changes", "status", "words"),
    [
        ("pybullet", {"packages": GOOD.packages - {"pybullet"}}, Status.NOTE, "touchline[sim]"),
        ("coach", {"packages": GOOD.packages - {"uvicorn"}}, Status.NOTE, "touchline[coach]"),
        ("tls", {"packages": GOOD.packages - {"trustme"}}, Status.NOTE, "touchline[tls]"),
        ("cores", {"cores": 1}, Status.WARNING, "lockstep"),
        ("disk", {"free_bytes": 400_000_000}, Status.WARNING, "free some space"),
        ("disk", {"free_bytes": 1_000_000}, Status.FAILED, "record elsewhere"),
        ("limits", {"open_files": 256}, Status.WARNING, "ulimit -n"),
    ],
)
def test_what_a_machine_lacks_has_a_remedy(name: str, changes: dict[str, object], status: Status, words: str) -> None:
    finding = found(name, **changes)
    assert finding.status is status
    assert words in finding.remedy


def test_a_machine_without_the_engine_has_not_failed() -> None:
    """Robots, coaches and recorders need none."""
    findings = examine_machine(replace(GOOD, packages=frozenset()))
    assert all(one.status is not Status.FAILED for one in findings)


def test_the_running_matches_are_listed() -> None:
    match = Announcement(endpoint="tcp/127.0.0.1:7447", match="cup", pid=7, folder="/matches")
    assert found("match", matches=(match,)).text == '"cup" on tcp/127.0.0.1:7447, process 7, started in /matches'


def test_the_facts_of_this_machine_can_be_examined() -> None:
    names = [one.name for one in examine_machine(MachineFacts.of_this_machine())]
    assert names[:2] == ["python", "pybullet"]


def test_the_offset_of_a_clock_is_known_within_half_a_round_trip() -> None:
    transit_ns = [9_000_000, 2_000_000, 30_000_000]
    for ahead_s in (-3600.0, 0.0, 0.25):
        stamps = [
            (round(ahead_s * 1e9) + at, at + took) for at, took in zip((0, 10**9, 2 * 10**9), transit_ns, strict=True)
        ]
        offset = clock_offset(stamps, 0.004)
        assert offset is not None
        assert abs(offset.seconds - ahead_s) <= offset.uncertainty < 0.003


def test_without_a_message_of_the_host_its_clock_is_unknown() -> None:
    assert clock_offset([], 0.001) is None


def test_no_limit_of_open_files_is_no_number() -> None:
    assert found("limits", open_files=resource.RLIM_INFINITY).text == "any number of open files in a process"
