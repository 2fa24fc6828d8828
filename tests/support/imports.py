"""Imports of a test that leave no trace."""

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path


@contextmanager
def forgotten_imports(folder: Path) -> Iterator[None]:
    """At the end of the block, modules of the folder, and what was added to `sys.path`, are forgotten."""
    before = [*sys.path]
    try:
        yield
    finally:
        sys.path[:] = before
        for name, module in [*sys.modules.items()]:
            if Path(getattr(module, "__file__", None) or "/").is_relative_to(folder):
                del sys.modules[name]
