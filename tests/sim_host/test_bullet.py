"""PyBullet is imported without its greeting; other output of the import is kept."""

import subprocess
import sys
from pathlib import Path


def run(code: str, *path: Path) -> "subprocess.CompletedProcess[str]":
    prepare = f"import sys; sys.path[:0] = {[str(one) for one in path]}; "
    return subprocess.run([sys.executable, "-c", prepare + code], capture_output=True, text=True, check=False)


def test_a_process_that_simulates_prints_nothing_of_its_own() -> None:
    done = run("import sim_host.physics.engine")
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")


def test_other_lines_of_the_import_are_printed(tmp_path: Path) -> None:
    (tmp_path / "pybullet.py").write_text(
        "import os\nos.write(2, b'pybullet build time: today\\na library is missing\\n')\nraise ImportError('no GL')\n"
    )
    done = run("import sim_host.physics.bullet", tmp_path)
    assert done.returncode == 1
    assert done.stderr.startswith("a library is missing\nTraceback ")
    assert done.stderr.endswith("ImportError: no GL\n")
