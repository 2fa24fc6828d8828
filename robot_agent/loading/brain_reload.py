"""Builds a robot's brain anew from code that has changed, between two episodes of a match."""

import hashlib
import importlib.util
import linecache
import sys
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from types import ModuleType

from robot_agent.loading.user_code import is_users, shown_path
from robot_agent.sdk.contract import Brain
from runtime.process.clock import WallClock
from runtime.process.process_log import log_note
from schemas.errors import TouchlineError
from schemas.messages.setup import Setup
from schemas.messages.sight import Sight

_FILE_TIME_NS = 10_000_000
"""The wall times of files may be this much too early."""


class BrainReload:
    """Remembers the source of a brain's module and of the user's modules that it has imported."""

    def __init__(self, robot: str, build: Callable[[Setup], Brain]) -> None:
        """`build` imports the brain's module, unless it is imported, and makes the brain; it has not been called."""
        self._robot = robot
        self._build = build
        self._not_reloaded = frozenset(sys.modules)
        self._digests: dict[str, str] = {}
        """File → digest of its content when it was last read."""
        self._episode: int | None = None

    def build(self, setup: Setup) -> Brain:
        """The brain of a match, from changed code where there is any that works.

        Raises:
            TouchlineError: the brain cannot be built.
        """
        return self._rebuilt(setup, "this match") or self._imported(setup)

    def before(self, sight: Sight, setup: Setup) -> Brain | None:
        """The brain from changed code, if this sight is the first of another episode and there is such code.

        If the changed code is broken, the log has the reason, and the brain stays.
        """
        if sight.game.episode == self._episode:
            return None
        self._episode = sight.game.episode
        return self._rebuilt(setup, f"episode {self._episode}")

    def _rebuilt(self, setup: Setup, occasion: str) -> Brain | None:
        """The brain from changed code; None if no code has changed, or if the new code is broken."""
        found = self._read()
        changed = [file for file, digest in found.items() if self._digests.get(file, digest) != digest]
        self._digests |= found
        if not changed:
            return None
        files = ", ".join(map(shown_path, changed))
        old = self._modules()
        self._forget(old)
        try:
            brain = self._imported(setup)
        except TouchlineError as error:
            self._forget(self._modules())
            sys.modules.update(old)
            log_note(f"{occasion} is played with old brains, the changed {files} is broken", f"{self._robot}: {error}")
            return None
        log_note(f"{occasion} is played with the changed {files}", f"{self._robot} has a new brain")
        return brain

    def _imported(self, setup: Setup) -> Brain:
        """The brain from the modules that are imported, or are imported now."""
        began_ns = WallClock.unix_ns()
        brain = self._build(setup)
        self._digests |= self._read(began_ns)
        return brain

    def _modules(self) -> dict[str, ModuleType]:
        """The user's modules that were imported since the brain was first built."""
        added = {name: module for name, module in sys.modules.items() if name not in self._not_reloaded}
        return {name: module for name, module in added.items() if is_users(getattr(module, "__file__", None) or "<")}

    def _read(self, began_ns: int | None = None) -> dict[str, str]:
        """File of each module → digest of its content.

        A file that was written after `began_ns`, ns since 1970, may have been imported before: its digest is empty.
        """
        digests = {}
        for module in self._modules().values():
            assert module.__file__ is not None
            file, content = Path(module.__file__), b""
            with suppress(OSError):  # it was removed
                content = file.read_bytes()
                if began_ns is not None and file.stat().st_mtime_ns > began_ns - _FILE_TIME_NS:
                    digests[module.__file__] = ""
                    continue
            digests[module.__file__] = hashlib.blake2b(content, digest_size=16).hexdigest()
        return digests

    def _forget(self, modules: dict[str, ModuleType]) -> None:
        """Have modules imported from their source again.

        Compiled files are removed: they fit a source of the same length that was written in the same second.
        """
        for name, module in modules.items():
            del sys.modules[name]
            if module.__file__ is not None:
                with suppress(OSError, NotImplementedError):
                    Path(importlib.util.cache_from_source(module.__file__)).unlink()
        linecache.checkcache()
