"""What `touchline health --doctor` finds on the way to a host, over real sockets on loopback."""

import socket
import ssl
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner

from runtime.access.accounts import Account
from runtime.access.certificates import make_certificate
from runtime.access.credentials import account_file, new_credentials, write_credentials
from runtime.access.protection import Protection
from runtime.bus.contract import PresenceKind
from runtime.bus.endpoint import reserve_port
from runtime.bus.settings import ClientSettings
from runtime.bus.zenoh.bus import ZenohBus, open_host
from runtime.process.clock import WallClock
from schemas.config.match_config import MatchConfig
from schemas.config.profile import load_profile
from schemas.config.soccer.rule_book import load_rule_book
from schemas.messages.health import Health, RobotHealth
from schemas.messages.setup import Setup
from schemas.side import Side
from schemas.topics import HEALTH, SETUP
from touchline.commands.cli.command_line import app
from touchline.commands.diagnosis.doctor.examination import examine
from touchline.commands.diagnosis.doctor.finding import Finding, Status
from touchline.commands.diagnosis.doctor.link import round_trip_finding
from touchline.commands.diagnosis.doctor.machine import MachineFacts

CONFIG = MatchConfig(name="examined", pace="realtime")
PLAIN = Setup.of(CONFIG, load_profile("msl"), load_rule_book("friendly"))
FACTS = replace(MachineFacts.of_this_machine(), free_bytes=10**10, matches=())
ROBOTS = {side: [f"{side.value}{number}" for number in (1, 2)] for side in Side}


@pytest.fixture(autouse=True)
def short_examination(monkeypatch: pytest.MonkeyPatch) -> None:
    """The host of these tests reports its health fifty times a second."""
    monkeypatch.setattr("touchline.commands.diagnosis.doctor.link.REQUEST_S", 0.3)


class ShiftedClock(WallClock):
    """A clock that is set wrong."""

    def __init__(self, ahead_s: float) -> None:
        super().__init__()
        self._ahead_ns = round(ahead_s * 1e9)

    def unix_ns(self) -> int:  # type: ignore[override]
        return WallClock.unix_ns() + self._ahead_ns


@pytest.fixture
def impatient(monkeypatch: pytest.MonkeyPatch) -> None:
    """No host will admit this client."""
    monkeypatch.setattr("touchline.commands.diagnosis.doctor.examination.REQUEST_S", 1.0)


@contextmanager
def host(
    setup: bytes | None = None, protection: Protection | None = None, *, reports_once: bool = False
) -> Iterator[ZenohBus]:
    """A host that replies with a setup and reports its health; one robot has joined."""
    health = Health(tick=1, time=0.02, pace="realtime", real_time_factor=1.0, robots={"cyan1": RobotHealth(alive=True)})
    stop = threading.Event()
    with open_host("examined", WallClock(), "tcp/127.0.0.1:0", protection) as bus:
        server, reports = bus.serve(SETUP), bus.publisher(HEALTH)
        bus.declare_alive(PresenceKind.HOST, "host")

        def serve() -> None:
            reports.put(health)
            while not stop.is_set():
                if not reports_once:
                    reports.put(health)
                query = server.receive(0.02)
                if query is not None:
                    query.reply_payload(setup or PLAIN.encode())

        thread = threading.Thread(target=serve)
        thread.start()
        try:
            yield bus
        finally:
            stop.set()
            thread.join()


def findings(connect: str, clock: WallClock | None = None, **more: Any) -> dict[str, Finding]:
    """Name → finding of the way to a host."""
    settings = ClientSettings(connect=connect, **more)
    return {one.name: one for one in examine(settings, clock or WallClock(), FACTS)}


def last(connect: str, **more: Any) -> Finding:
    return list(findings(connect, **more).values())[-1]


@contextmanager
def guarded(tmp_path: Path, *, tls: bool) -> Iterator[tuple[ZenohBus, Path]]:
    """A host with credentials, and their folder."""
    credentials = new_credentials(certificate=make_certificate() if tls else None)
    write_credentials(tmp_path, credentials)
    with host(protection=Protection.of(credentials, "examined", ROBOTS)) as bus:
        yield bus, tmp_path


def test_of_a_host_that_can_be_joined_everything_is_known() -> None:
    with host() as bus:
        found = findings(bus.endpoint)
    assert all(one.status is not Status.FAILED for one in found.values())
    assert list(found)[-8:] == ["name", "port", "mtu", "credentials", "protocol", "round trip", "clock", "robots"]
    assert found["protocol"].text.startswith('2.0 there, 2.0 here; match "examined", profile msl')
    assert found["robots"].text.startswith("free: cyan2, cyan3")
    assert found["robots"].text.endswith("taken: cyan1")
    assert found["clock"].text.startswith("the host's clock is ")  # behind, where a busy machine delivers late


def test_a_port_on_which_nothing_listens_fails_with_what_to_start() -> None:
    finding = last(f"tcp/127.0.0.1:{reserve_port('127.0.0.1')}")
    assert (finding.name, finding.status) == ("port", Status.FAILED)
    assert "nothing listens on port" in finding.text
    assert "touchline host" in finding.remedy


def test_a_name_without_an_address_fails(monkeypatch: pytest.MonkeyPatch) -> None:
    def unknown(*_: object) -> None:
        raise socket.gaierror(-2, "Name or service not known")

    monkeypatch.setattr(socket, "getaddrinfo", unknown)
    finding = last("tcp/simhots:7447")
    assert (finding.name, finding.status) == ("name", Status.FAILED)
    assert finding.text == "simhots has no address (Name or service not known)"


def test_a_machine_that_does_not_answer_points_to_the_firewall(monkeypatch: pytest.MonkeyPatch) -> None:
    def silent(*_: object, **__: object) -> None:
        raise TimeoutError

    monkeypatch.setattr(socket, "create_connection", silent)
    finding = last("tcp/127.0.0.1:7447")
    assert finding.status is Status.FAILED
    assert "firewall" in finding.remedy


@pytest.mark.usefixtures("impatient")
def test_a_server_that_is_no_host_is_not_taken_for_one() -> None:
    with socket.create_server(("127.0.0.1", 0)) as server:
        finding = last(f"tcp/127.0.0.1:{server.getsockname()[1]}")
    assert (finding.name, finding.status) == ("host", Status.FAILED)
    assert "is no host that is ready" in finding.text


def test_a_host_of_another_version_fails_with_both_versions() -> None:
    with host(PLAIN.encode().replace(b'"version":"2.0"', b'"version":"3.1"')) as bus:
        finding = last(bus.endpoint)
    assert (finding.name, finding.status) == ("protocol", Status.FAILED)
    assert "version 3.1 is not supported, this side has 2.0" in finding.text
    assert "same version" in finding.remedy


@pytest.mark.parametrize(("ahead_s", "word"), [(3600.0, "behind"), (-3600.0, "ahead")])
def test_a_clock_that_is_an_hour_off_is_a_warning_with_its_figure(ahead_s: float, word: str) -> None:
    with host() as bus:
        finding = findings(bus.endpoint, ShiftedClock(ahead_s))["clock"]
    assert finding.status is Status.WARNING
    assert f"s {word}, ±" in finding.text
    assert 3599 < float(finding.text.split()[4]) < 3601
    assert "set-ntp" in finding.remedy


def test_the_age_of_a_host_s_last_report_is_no_offset_of_its_clock() -> None:
    with host(reports_once=True) as bus:
        found = findings(bus.endpoint)
    assert found["clock"].text == "the host has published nothing, so its clock is unknown"
    assert found["robots"].status is Status.OK


def test_credentials_of_the_host_s_own_set_are_accepted(tmp_path: Path) -> None:
    with guarded(tmp_path, tls=False) as (bus, folder):
        found = findings(bus.endpoint, credentials=account_file(folder, Account.CYAN))
    assert found["credentials"] == Finding("credentials", Status.OK, 'accepted as "cyan"')
    assert found["robots"].status is Status.OK


@pytest.mark.usefixtures("impatient")
def test_a_refused_password_and_missing_credentials_fail(tmp_path: Path) -> None:
    write_credentials(tmp_path / "others", new_credentials())
    with guarded(tmp_path / "own", tls=False) as (bus, _):
        wrong = last(bus.endpoint, credentials=account_file(tmp_path / "others", Account.CYAN))
        without = last(bus.endpoint)
    assert (wrong.name, wrong.status) == ("host", Status.FAILED)
    assert 'does not admit the user "cyan"' in wrong.text
    assert without.status is Status.FAILED
    assert "--credentials" in without.remedy


def test_a_file_of_credentials_that_cannot_be_read_fails(tmp_path: Path) -> None:
    finding = last("tcp/127.0.0.1:7447", credentials=tmp_path / "none.json")
    assert (finding.name, finding.status) == ("credentials", Status.FAILED)


def test_a_certificate_has_its_names_and_expiry(tmp_path: Path) -> None:
    with guarded(tmp_path, tls=True) as (bus, folder):
        found = findings(bus.endpoint, credentials=account_file(folder, Account.VIEWER))
    assert found["certificate"].status is Status.OK
    assert found["certificate"].text.startswith("valid, for localhost, 127.0.0.1")
    assert "expires" in found["certificate"].text
    assert found["credentials"].text == 'accepted as "viewer"'


def test_a_certificate_that_expires_within_a_week_is_a_warning(tmp_path: Path) -> None:
    with guarded(tmp_path, tls=True) as (bus, folder):
        file = account_file(folder, Account.VIEWER)
        expiry = findings(bus.endpoint, credentials=file)["certificate"].text.rpartition("expires ")[2]
        week_before = ssl.cert_time_to_seconds(expiry) - 6 * 86_400 - WallClock.unix_ns() * 1e-9
        finding = findings(bus.endpoint, ShiftedClock(week_before), credentials=file)["certificate"]
    assert finding.status is Status.WARNING


def test_a_certificate_of_another_authority_fails(tmp_path: Path) -> None:
    write_credentials(tmp_path / "others", new_credentials(certificate=make_certificate()))
    with guarded(tmp_path / "own", tls=True) as (bus, _):
        finding = last(bus.endpoint, credentials=account_file(tmp_path / "others", Account.CYAN))
    assert (finding.name, finding.status) == ("certificate", Status.FAILED)


def test_round_trips_that_are_longer_than_a_tick_are_a_warning_in_real_time_alone() -> None:
    times = [0.015] * 49 + [0.05]
    finding = round_trip_finding(times, PLAIN)
    assert finding.status is Status.WARNING
    assert "p50 15.00 ms, p99 50.00 ms" in finding.text
    assert "up to 3 ticks old" in finding.text
    assert round_trip_finding(times, PLAIN.replace(pace="lockstep")).status is Status.OK
    assert round_trip_finding([], PLAIN).status is Status.FAILED


def test_the_exit_status_tells_whether_a_line_failed() -> None:
    def doctor(*words: str) -> tuple[int, str]:
        result = CliRunner().invoke(app, ["health", "--doctor", *words], prog_name="touchline")
        return result.exit_code, result.stdout

    status, text = doctor("--connect", f"tcp/127.0.0.1:{reserve_port('127.0.0.1')}")
    assert status == 1
    assert "failed   port         nothing listens" in text
    with host() as bus:
        status, text = doctor("--connect", bus.endpoint, "--json")
    assert status == 0
    assert text.startswith('{"ok": true, "findings": [{"name": "python", "status": "ok"')
