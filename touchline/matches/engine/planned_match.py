"""A match of a plan: all that determines it, and its identity."""

import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from functools import cached_property
from pathlib import Path
from typing import Any

from robot_agent.process.timing import HANG_S
from schemas.config.match_config import LOCKSTEP, MatchConfig
from schemas.config.task import GameName
from schemas.side import Side


class Way(StrEnum):
    """How a match is played. In lockstep both ways give the same states, so this is no part of the identity."""

    IN_PROCESS = "in_process"
    """In one process, without a network: for brains that are trusted."""
    PROCESSES = "processes"
    """Host, robots and recorder in processes of their own, over Zenoh: for rivals, and for programs in any language."""


@dataclass(frozen=True)
class PlannedMatch:
    """One match of a plan."""

    config: MatchConfig
    """The whole match: teams, seed, sides, rule book, profile."""
    code: Mapping[Side, str] = field(default_factory=dict)
    """Side → digest of the files of its team, see `code_digest`; without one, the files are not checked."""
    way: Way = Way.IN_PROCESS
    brain_folder: Path | None = None
    """Where brains are looked for first."""
    recording: Path | None = None
    """The file that gets its recording; None for none."""
    logs: Path | None = None
    """The folder that gets the logs of its processes, or the traceback of a brain that raised; None for none."""
    hang_s: float = HANG_S
    """Wall time in s for a decision of a brain, after which its team hangs, in one process. To build it there is at
    least `patience.attendance`."""
    is_drill: bool = False
    """It ends with the verdict of the scene that it starts from; only in one process."""
    label: str = ""
    """Its name for people."""

    @cached_property
    def identity(self) -> str:
        """A digest of configuration and code: equal for matches with equal results."""
        content = {
            "config": _as_published(json.loads(self.config.model_dump_json(exclude={**_NO_PART}))),
            "pace": self.config.pace if self.config.pace != LOCKSTEP else None,
            "code": {side.value: digest for side, digest in self.code.items()},
            **({"drill": True} if self.is_drill else {}),
        }
        text = json.dumps(content, sort_keys=True, ensure_ascii=False)
        return hashlib.blake2b(text.encode(), digest_size=16).hexdigest()


_NO_PART: Mapping[str, Any] = {
    "record": True,
    "patience": True,
    "pace": True,
    "teams": {side.value: {"process"} for side in Side},
}
"""Fields of a config on which the result of a match does not depend."""
_LATER = {"game": GameName.SOCCER, "task": None, "mass": None, "friction": None}
"""Fields that the configs of published matches do not have → the value at which an identity leaves them out."""


def _as_published(content: Any) -> Any:
    """The JSON values of a config without what published ones do not have."""
    if isinstance(content, list):
        return [_as_published(one) for one in content]
    if not isinstance(content, dict):
        return content
    return {key: _as_published(value) for key, value in content.items() if key not in _LATER or value != _LATER[key]}
