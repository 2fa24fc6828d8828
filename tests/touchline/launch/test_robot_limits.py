"""Brains that use more of the machine than their limits allow, in real matches: each is named, the match goes on."""

import re
from pathlib import Path

import pytest

from support.isolated_match import IsolatedMatch, is_running

pytestmark = pytest.mark.processes


def test_a_brain_that_opens_100000_files_fails_with_the_limit_and_the_remedy(tmp_path: Path) -> None:
    brain = "    def begin(self):\n        self.files = [open('/dev/null') for _ in range(100_000)]"
    played = IsolatedMatch(tmp_path, brain, limits="open_files = 200", size=2).play()
    assert played.is_whole(), played.printed
    assert re.match(
        r"  cyan[12]: limit reached: it opened more than 200 files at once; raise \[limits\] open_files",
        played.line("limit reached"),
    )


def test_a_brain_that_allocates_10_gb_fails_with_the_limit_and_the_remedy(tmp_path: Path) -> None:
    brain = "    def begin(self):\n        self.all = bytearray(10_000_000_000)"
    played = IsolatedMatch(tmp_path, brain, limits="memory = 1.5").play()
    assert played.is_whole(), played.printed
    assert played.line("limit reached").startswith(
        "  cyan1: limit reached: it used more than 1.5 GB of memory; raise [limits] memory"
    )


def test_a_thread_that_spins_is_ended_when_its_cpu_time_is_used_up(tmp_path: Path) -> None:
    brain = (
        "    def begin(self):\n        def spin():\n            while True:\n                pass\n"
        "        threading.Thread(target=spin, daemon=True).start()\n        time.sleep(600)"
    )
    played = IsolatedMatch(tmp_path, brain, limits="cpu_time = 2.0").play()
    assert played.is_whole(), played.printed
    assert "cyan1 was ended: it used more than 2 s of CPU time; raise [limits] cpu_time" in played.printed


def test_a_brain_that_writes_10_gb_fails_at_the_size_of_a_file(tmp_path: Path) -> None:
    brain = (
        "    def begin(self):\n        with open('much', 'wb') as file:\n            for _ in range(10_000):\n"
        "                file.write(bytes(1_000_000))"
    )
    played = IsolatedMatch(tmp_path, brain, limits="file_size = 3.0").play()
    assert played.is_whole(), played.printed
    assert played.line("limit reached").startswith(
        "  cyan1: limit reached: it wrote more than 3 MB into one file; raise [limits] file_size"
    )
    assert (played.run / "cyan1" / "much").stat().st_size == 3_000_000


def test_a_brain_that_stays_after_sigterm_is_ended_with_the_match(tmp_path: Path) -> None:
    brain = (
        "    def begin(self):\n        signal.signal(signal.SIGTERM, signal.SIG_IGN)\n"
        "        Path('pid').write_text(str(os.getpid()))"
    )
    played = IsolatedMatch(tmp_path, brain).play()
    assert played.is_whole()
    assert not is_running(int((played.run / "cyan1" / "pid").read_text()))


def test_a_robot_sees_its_own_environment_and_no_secret_of_the_launcher(tmp_path: Path) -> None:
    brain = (
        "    def begin(self):\n        began = Path('/proc/self/environ').read_text()\n"
        "        print(sorted(os.environ), began, os.environ['HOME'], os.getcwd(), flush=True)"
    )
    secrets = {"AWS_SECRET_ACCESS_KEY": "hush-1", "TOUCHLINE_TOKEN": "hush-2", "MODEL": "small"}
    played = IsolatedMatch(tmp_path, brain, cyan='pass_environment = ["MODEL"]').play(**secrets)
    assert played.is_whole(), played.printed
    log = played.log("cyan1")
    assert "hush" not in log
    assert "'MODEL'" in log and "'PATH'" in log and "'TOUCHLINE_ROBOT'" in log
    assert log.count(str(played.run / "cyan1")) == 2
    assert "magenta1" not in log


def test_a_robot_inherits_no_descriptors_but_its_streams_and_the_supervisor_s_pipe(tmp_path: Path) -> None:
    brain = (
        "    def __init__(self, briefing):\n        super().__init__(briefing)\n"
        "        for handle in os.listdir('/proc/self/fd'):\n"
        "            try:\n                print('open', os.readlink('/proc/self/fd/' + handle), flush=True)\n"
        "            except FileNotFoundError:\n                pass"
    )
    played = IsolatedMatch(tmp_path, brain).play()
    assert played.is_whole(), played.printed
    opened = re.findall(r"^open (.*)$", played.log("cyan1"), re.MULTILINE)
    files = [name for name in opened if not name.startswith(("anon_inode:", "socket:", "pipe:"))]
    assert set(files) == {"/dev/null", str(played.run / "cyan1.log")}
    assert len([name for name in opened if name.startswith("pipe:")]) == 1
    assert len([name for name in opened if name.startswith("socket:")]) == 1  # its own link to the host
