"""Robots of an isolated team, in real matches: what they try against others fails, and the match goes on."""

import os
import pwd
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

import pytest

from support.isolated_match import IsolatedMatch, is_running, needs_bubblewrap
from touchline.launch.team_user import TeamUser

pytestmark = pytest.mark.processes

INTRUDER = """
    def begin(self):
        run = Path.home().parent
        for path in (run.parents[1] / "magenta_team.py", run / "magenta1.json", run / "host.json", run / "host.log",
                     run / "magenta1.log", run / "magenta1", run / "credentials", run / "stolen", Path("/etc/stolen")):
            try:
                done = "wrote" if path.name == "stolen" else "read"
                if path.name == "stolen":
                    path.write_text("mine")
                elif path.is_dir():
                    list(path.iterdir())
                else:
                    path.read_text()
            except OSError as error:
                done = "refused"
            print(done, path.name, flush=True)
        Path("own").write_text("mine")
        print("wrote own", Path("own").read_text(), flush=True)
        killed = []
        for name in os.listdir("/proc"):
            if name.isdigit() and int(name) not in (1, os.getpid(), os.getppid()):
                try:
                    os.kill(int(name), 0)
                    killed.append(name)
                except PermissionError:
                    pass
        print("signalled", killed, flush=True)
"""
"""It tries to read what is the host's and the other team's, to write outside its folder, and to signal the others."""
REFUSED = [
    "refused magenta_team.py",
    "refused magenta1.json",
    "refused host.json",
    "refused host.log",
    "refused magenta1.log",
    "refused magenta1",
    "refused credentials",
    "refused stolen",
    "refused stolen",
    "wrote own mine",
    "signalled []",
]
LEAVES_A_DAEMON = """
    def begin(self):
        if not os.fork():
            os.setsid()
            if not os.fork():
                signal.signal(signal.SIGTERM, signal.SIG_IGN)
                Path("daemon").touch()
                time.sleep(600)
            os._exit(0)
        while not Path("daemon").exists():
            time.sleep(0.01)
"""


@pytest.fixture
def open_folder() -> Iterator[Path]:
    """A folder that every user may enter, as those of pytest are not."""
    with tempfile.TemporaryDirectory(prefix="touchline-test-") as name:
        Path(name).chmod(0o755)
        yield Path(name)


@pytest.fixture
def clean_etc() -> Iterator[None]:
    """Remove what a robot without isolation writes where root may write."""
    yield
    Path("/etc/stolen").unlink(missing_ok=True)


def test_without_isolation_a_robot_reads_what_its_user_may_read(tmp_path: Path, clean_etc: None) -> None:
    """What the two ways of isolation prevent."""
    played = IsolatedMatch(tmp_path, INTRUDER).play()
    assert played.is_whole(), played.printed
    assert {"read magenta_team.py", "read magenta1.json", "read host.json"} <= set(played.log("cyan1").splitlines())


@needs_bubblewrap()
def test_in_bubblewrap_a_robot_neither_reads_nor_writes_nor_signals_what_is_another_s(tmp_path: Path) -> None:
    played = IsolatedMatch(tmp_path, INTRUDER).play("--isolate", "bubblewrap")
    assert played.is_whole(), played.printed
    assert played.log("cyan1").splitlines() == REFUSED
    assert (played.run / "cyan1" / "own").read_text() == "mine"


@needs_bubblewrap()
def test_in_bubblewrap_a_robot_s_own_processes_are_all_that_it_sees_and_end_with_it(tmp_path: Path) -> None:
    played = IsolatedMatch(tmp_path, LEAVES_A_DAEMON).play("--isolate", "bubblewrap")
    assert played.is_whole(), played.printed
    assert (played.run / "cyan1" / "daemon").exists()
    assert not [pid for pid in _running_processes() if _works_in(pid, played.run)]


@needs_bubblewrap()
def test_in_bubblewrap_a_robot_may_finish_its_work_when_the_match_is_over(tmp_path: Path) -> None:
    """It receives SIGTERM as elsewhere, although it is no child of its supervisor."""
    brain = "    def begin(self):\n        import atexit\n        atexit.register(Path('finished').touch)"
    played = IsolatedMatch(tmp_path, brain).play("--isolate", "bubblewrap")
    assert played.is_whole(), played.printed
    assert (played.run / "cyan1" / "finished").exists()


@needs_bubblewrap()
@pytest.mark.parametrize(
    ("end", "how"),
    [("os.kill(os.getpid(), signal.SIGSEGV)", "was ended by SIGSEGV"), ("os._exit(255)", "ended with status 255")],
)
def test_in_bubblewrap_the_end_of_a_robot_is_reported_as_elsewhere(tmp_path: Path, end: str, how: str) -> None:
    played = IsolatedMatch(tmp_path, f"    def begin(self):\n        {end}").play("--isolate", "bubblewrap")
    assert played.is_whole(), played.printed
    assert played.line("started again") == f"cyan1 {how}; started again (1 of 3)"


@needs_bubblewrap()
def test_in_bubblewrap_limits_are_named_as_without(tmp_path: Path) -> None:
    brain = "    def begin(self):\n        self.all = bytearray(10_000_000_000)"
    played = IsolatedMatch(tmp_path, brain, limits="memory = 1.5").play("--isolate", "bubblewrap")
    assert played.is_whole(), played.printed
    assert "limit reached: it used more than 1.5 GB of memory; raise [limits] memory" in played.line("limit reached")


@pytest.mark.skipif(os.geteuid() != 0, reason="only root starts programs as other users")
def test_as_another_user_a_robot_neither_reads_nor_writes_nor_signals_what_is_another_s(open_folder: Path) -> None:
    names = ("daemon", "nobody")
    for path in (Path(sys.executable), Path(__file__)):
        if not TeamUser("daemon", pwd.getpwnam("daemon").pw_uid, pwd.getpwnam("daemon").pw_gid).can_read(path):
            pytest.skip(f"other users cannot read {path}")
    users = f'isolate = "user"\nisolate_users = {{ cyan = "{names[0]}", magenta = "{names[1]}" }}'
    match = IsolatedMatch(open_folder, INTRUDER, top=users)
    rival = open_folder / "magenta_team.py"
    os.chown(rival, pwd.getpwnam("nobody").pw_uid, 0)
    rival.chmod(0o600)
    played = match.play()
    assert played.is_whole(), played.printed
    assert played.log("cyan1").splitlines() == REFUSED
    folder = (played.run / "cyan1").stat()
    assert (folder.st_uid, folder.st_mode & 0o777) == (pwd.getpwnam("daemon").pw_uid, 0o700)


def _running_processes() -> list[int]:
    return [pid for path in Path("/proc").glob("[0-9]*") if is_running(pid := int(path.name))]


def _works_in(pid: int, run: Path) -> bool:
    try:
        return Path(f"/proc/{pid}/cwd").readlink().is_relative_to(run)
    except OSError:
        return False
