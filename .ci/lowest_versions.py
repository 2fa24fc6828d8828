"""Prints the lowest supported version of each direct dependency, as constraints for pip."""

import re
import sys
import tomllib
from pathlib import Path

PROJECT = tomllib.loads((Path(__file__).parent.parent / "pyproject.toml").read_text("utf-8"))["project"]
EXTRAS = (one for extra in PROJECT["optional-dependencies"].values() for one in extra)

for requirement in [*PROJECT["dependencies"], *EXTRAS]:
    if lowest := re.match(r"([\w-]+)(?:>=|==)([\d.]+)", requirement):
        sys.stdout.write(f"{lowest[1]}=={lowest[2]}\n")
