"""The process of the tests plays hosts and clients by turns, and takes a host's threads for both."""

import gc
import os
import shutil
import signal
import tempfile
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING
from zlib import crc32

import pytest
from hypothesis import HealthCheck, settings

from runtime.bus.endpoint import with_free_port
from runtime.bus.zenoh.bus import open_host
from runtime.process.clock import WallClock
from schemas.config.match_config import MatchConfig
from schemas.messages.applied import Applied, chained_part_of
from sim_host.match.live_parameters import LiveParameters
from sim_host.match.resimulation import Conditions, Resimulation
from sim_host.soccer.game import ARENA

if TYPE_CHECKING:
    from playwright.sync_api import Browser

settings.register_profile("steady", derandomize=True, deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.load_profile("steady")
"""Generated examples are the same in each run, and a busy machine is no fault of theirs; with
`pytest --hypothesis-profile=default` they are others each time."""

SLOW = (
    "tests/coach_gateway/web/test_harm.py",
    "tests/docs/test_figures.py",
    "tests/docs/test_matches.py",
    "tests/docs/test_plain_robot.py",
    "tests/docs/test_stdio_examples.py",
    "tests/docs/test_testing.py",
    "tests/match/",
    "tests/recordings/container/test_json_schema.py",
    "tests/recordings/editing/test_recovery.py",
    "tests/recordings/exchange/",
    "tests/recordings/reading/test_cursor.py",
    "tests/recordings/recorder/test_earlier_parts.py",
    "tests/recordings/recorder/test_part_sink.py",
    "tests/recordings/replay/",
    "tests/recordings/soccer/stats/test_page.py",
    "tests/recordings/viz/test_viz_channels.py",
    "tests/robot_agent/teams/",
    "tests/sim_host/actuation/test_omni_drive.py",
    "tests/sim_host/match/",
    "tests/sim_host/soccer/referee/test_invariants.py",
    "tests/sim_host/soccer/referee/test_mirror.py",
    "tests/sim_host/sensing/test_noise.py",
    "tests/sim_host/server/test_host.py",
    "tests/sim_host/server/test_recorders.py",
    "tests/test_private_members.py",
    "tests/touchline/commands/diagnosis/doctor/",
    "tests/touchline/commands/test_new.py",
    "tests/touchline/matches/",
    "tests/touchline/team/",
    "tests/touchline/test_fair_matches.py",
    "tests/touchline/testing/",
    "tests/touchline/verify/",
)
"""Places of tests that play many matches, or watch physics for long: together they take twice as long as all others."""


def pytest_configure() -> None:
    """Zenoh chooses its threads when the first session of a process is opened.

    Shells start background jobs with SIGINT ignored, and programs that they start inherit that. A signal with a handler
    has its default in them. Hosts of tests are not announced to the user.
    """
    os.environ["XDG_RUNTIME_DIR"] = tempfile.mkdtemp(prefix="touchline-tests-")
    if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
        signal.signal(signal.SIGINT, lambda *_: None)
    open_host("first", WallClock(), with_free_port("tcp/127.0.0.1:0")).close()
    gc.disable()


def pytest_collection_finish() -> None:
    """What was collected stays: looking through it again and again takes a tenth of the tests' CPU time."""
    gc.freeze()
    gc.enable()


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark what follows from a test's place and fixtures, so that no test can forget it.

    Tests in several processes come in an order that mixes the files: those that wait run beside those that compute.
    """
    for item in items:
        place = item.path.relative_to(item.config.rootpath).as_posix()
        if place.startswith("tests/hostile/"):
            item.add_marker("hostile")
        if place.startswith(SLOW):
            item.add_marker("slow")
        if "browser" in getattr(item, "fixturenames", ()):
            item.add_marker("browser")
    if items and hasattr(items[0].config, "workerinput"):
        heavy = {
            item.path for item in items for mark in ("processes", "browser", "slow") if item.get_closest_marker(mark)
        }
        # the last fifth of the others comes after all heavy ones, so that all processes end at about the same time
        items.sort(
            key=lambda item: crc32(bytes(item.path.relative_to(item.config.rootpath))) * (4 + (item.path not in heavy))
        )


def pytest_unconfigure() -> None:
    """Remove the announcements of the tests' hosts."""
    shutil.rmtree(os.environ["XDG_RUNTIME_DIR"], ignore_errors=True)


@pytest.fixture(scope="session")
def anyio_backend() -> str:
    """Each test that is a coroutine runs in an event loop of its own."""
    return "asyncio"


@pytest.fixture
def open_folder() -> Iterator[Path]:
    """A folder that every user may enter, as those of pytest are not."""
    with tempfile.TemporaryDirectory(prefix="touchline-test-") as name:
        Path(name).chmod(0o755)
        yield Path(name)


@pytest.fixture(scope="session")
def simulated_again() -> Callable[[MatchConfig, Sequence[bytes]], list[str]]:
    """Gives the hash chain of every tick of a match, from what a recording keeps of it alone."""

    def simulate(config: MatchConfig, recorded: Sequence[bytes]) -> list[str]:
        again = Resimulation(ARENA, Conditions(LiveParameters.of(config)))
        chains = [again.step(Applied.decode(payload), chained_part_of(payload)).chain for payload in recorded]
        again.close()
        return chains

    return simulate


@pytest.fixture(scope="module")
def browser() -> "Iterator[Browser]":
    """A headless Chromium of the system's; tests of pages are skipped where there is none, unless they have to run.

    The headless shell has no windows of its own to draw: it takes two fifths less of CPU time.
    """
    from playwright.sync_api import sync_playwright

    names = ("chromium-headless-shell", "chromium", "chromium-browser", "google-chrome")
    chromium = next(filter(None, map(shutil.which, names)), None)
    if chromium is None:
        assert os.environ.get("TOUCHLINE_BROWSER") != "needed", "no Chromium where the tests of pages have to run"
        pytest.skip("no Chromium; apt-get install chromium-headless-shell")
    with sync_playwright() as playwright:
        root = ["--no-sandbox"] if os.geteuid() == 0 else []
        browser = playwright.chromium.launch(executable_path=chromium, args=[*root, "--disable-gpu"])
        yield browser
        browser.close()
