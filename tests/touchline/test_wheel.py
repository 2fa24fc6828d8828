"""What is in the wheel: files that are read when it is installed, and the page of a package index."""

import re
import subprocess
import sys
import zipfile
from email import message_from_string
from email.message import Message
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
DATA = {".toml", ".html", ".css", ".js", ".svg", ".md", ".ini", ".msg", ".srv"}
"""Suffixes of files that packages read."""

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> zipfile.ZipFile:
    folder = tmp_path_factory.mktemp("wheel")
    command = [sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", str(folder)]
    subprocess.run(command, cwd=ROOT, check=True, capture_output=True)
    (path,) = folder.iterdir()
    return zipfile.ZipFile(path)


@pytest.fixture
def metadata(wheel: zipfile.ZipFile) -> Message:
    (name,) = (name for name in wheel.namelist() if name.endswith("/METADATA"))
    return message_from_string(wheel.read(name).decode())


def test_it_has_the_files_that_its_packages_read(wheel: zipfile.ZipFile) -> None:
    listed = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, check=True, capture_output=True, text=True)
    packages = {name.partition("/")[0] for name in wheel.namelist() if name.endswith("/__init__.py")}
    files = {file for file in listed.stdout.split("\0") if file.partition("/")[0] in packages}
    assert len(packages) == 7 and {file for file in files if Path(file).suffix in DATA} <= set(wheel.namelist())


def test_it_has_the_match_files_and_the_studies_that_the_pages_name(wheel: zipfile.ZipFile) -> None:
    shared = {name.partition("/share/touchline/")[2] for name in wheel.namelist() if "/share/touchline/" in name}
    assert {f"matches/{path.name}" for path in (ROOT / "matches").iterdir()} <= shared
    assert {f"studies/{path.name}" for path in (ROOT / "studies").glob("*.toml")} <= shared
    assert {"examples/first_brain.py", "examples/first_brain.toml"} <= shared


def test_it_names_its_authors_and_what_it_is_for(metadata: Message) -> None:
    assert metadata["Author"] and metadata["License-Expression"] == "Apache-2.0"
    assert "Operating System :: POSIX :: Linux" in metadata.get_all("Classifier", [])


def test_the_page_of_an_index_has_no_link_into_the_repository(metadata: Message) -> None:
    page = metadata.get_payload()
    assert isinstance(page, str) and "first week (`docs/first_week.md`)" in page
    assert re.findall(r"\]\((?!https?:)[^)]*\)", page) == []


def test_a_python_without_wheels_of_pybullet_installs_all_without_it(metadata: Message) -> None:
    needs = [one for one in metadata.get_all("Requires-Dist", []) if one.startswith("pybullet")]
    assert needs and all("python_version < '3.12'" in one for one in needs)
