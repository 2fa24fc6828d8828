"""Robots of an isolated team, in real matches: what they try against others fails, and the match goes on."""

import os
from pathlib import Path

import pytest

from support.isolated_match import IsolatedMatch, needs_bubblewrap
from support.process_story import is_running

pytestmark = pytest.mark.processes

INTRUDER = """
    def begin(self):
        run = Path.home().parent
        match = run.parents[1]
        for path in (match / "magenta_team.py", run / "magenta1.json", run / "host.json", run / "host.log",
                     run / "magenta1.log", run / "magenta1", run / "credentials", Path("/etc/shadow"),
                     match / "of_owner", match / "stolen", run / "stolen", Path("/etc/stolen")):
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
        print(*[line for line in Path("/proc/self/status").read_text().splitlines() if line.startswith("Cap")])
        print("root", os.getuid() == 0, flush=True)
"""
"""It tries to read what is the host's, the other team's and root's, to write outside its folder, and to signal."""
NO_CAPABILITIES = " ".join(f"Cap{kind}:\t{0:016x}" for kind in ("Inh", "Prm", "Eff", "Bnd", "Amb"))
REFUSED = [
    "refused magenta_team.py",
    "refused magenta1.json",
    "refused host.json",
    "refused host.log",
    "refused magenta1.log",
    "refused magenta1",
    "refused credentials",
    "refused shadow",
    f"{'refused' if os.geteuid() == 0 else 'read'} of_owner",
    "refused stolen",
    "refused stolen",
    "refused stolen",
    "wrote own mine",
    "signalled []",
    NO_CAPABILITIES,
    "root False",
]
LEAVES_A_DAEMON = """
    def begin(self):
        import atexit
        atexit.register(Path("finished").touch)
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


@needs_bubblewrap()
def test_in_bubblewrap_a_robot_neither_reads_nor_writes_nor_signals_what_is_another_s(open_folder: Path) -> None:
    """Also in a match that root launches: the robot is nobody, without capabilities."""
    match = IsolatedMatch(open_folder, INTRUDER)
    (open_folder / "of_owner").touch(0o600)
    played = match.play("--isolate", "bubblewrap")
    assert played.is_whole(), played.printed
    assert played.log("cyan1").splitlines() == REFUSED
    assert (played.run / "cyan1" / "own").read_text() == "mine"


@needs_bubblewrap()
def test_in_bubblewrap_a_robot_may_finish_its_work_and_its_processes_end_with_it(open_folder: Path) -> None:
    """It receives SIGTERM as elsewhere, although it is no child of its supervisor."""
    played = IsolatedMatch(open_folder, LEAVES_A_DAEMON).play("--isolate", "bubblewrap")
    assert played.is_whole(), played.printed
    assert (played.run / "cyan1" / "daemon").exists() and (played.run / "cyan1" / "finished").exists()
    assert not [pid for pid in _running_processes() if _works_in(pid, played.run)]


@needs_bubblewrap()
@pytest.mark.skipif(os.geteuid() != 0, reason="other users' robots read what their user may read")
def test_root_s_match_is_refused_where_nobody_cannot_read_the_team(open_folder: Path) -> None:
    match = IsolatedMatch(open_folder, "    pass")
    (open_folder / "cyan_team.py").chmod(0o600)
    open_folder.chmod(0o700)
    played = match.play("--isolate", "bubblewrap")
    assert played.status == 2
    assert "Permission denied" in played.printed and "run as nobody, who has to read" in played.printed


def _running_processes() -> list[int]:
    return [pid for path in Path("/proc").glob("[0-9]*") if is_running(pid := int(path.name))]


def _works_in(pid: int, run: Path) -> bool:
    try:
        return Path(f"/proc/{pid}/cwd").readlink().is_relative_to(run)
    except OSError:
        return False
