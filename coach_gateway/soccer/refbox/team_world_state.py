"""The world states of a team's base station: read leniently, counted, and kept as they came."""

import json
from typing import Any

from schemas.messages.soccer.league.findings import Findings
from schemas.messages.soccer.league.lenient_json import REQUIRED, fields_of, items_of, vector

MOST_BYTES = 30_000
"""Bytes of a world state that is passed on: the audience feed has both teams' in one datagram."""


class TeamWorldState:
    """One team's world states."""

    def __init__(self) -> None:
        self.states = 0
        """World states that could be read."""
        self.others = 0
        """Objects that were not world states."""
        self.findings = Findings()
        """How they differ from the league's schema."""
        self.newest: dict[str, Any] | None = None
        """The newest world state as it came, of those that can be passed on."""
        self.newest_at = 0.0
        """Wall time in s at which it came."""

    def update(self, content: dict[str, Any], now: float) -> str:
        """Take in an object that came at wall time `now` in s.

        Returns why others do not receive it; empty where they do, and for what is no world state.
        """
        fields = fields_of(content, self.findings)
        if "robots" not in fields and fields.get("type") != "worldstate":
            self.others += 1
            return ""
        self.states += 1
        fault = _fault(content)
        if fault:
            self.findings.note(fault, lost=True)
        else:
            self.newest, self.newest_at = content, now
        self.findings.place = f"world state {self.states}"
        for key in REQUIRED:
            if key not in fields:
                self.findings.note(f"worldstate without {key}")
        for one in items_of(fields.get("robots")):
            robot = fields_of(one, self.findings)
            x, y, _ = vector(robot.get("pose"), 3, "pose", self.findings)
            if x is None or y is None:
                self.findings.note("robot without a position", lost=True)
        return fault

    def summary(self) -> str:
        """Counts and findings as text."""
        odd = [*self.findings.lost, *self.findings.coped]
        kinds = "; ".join(f"{finding.what} ({finding.count})" for finding in odd[:3])
        more = f" and {len(odd) - 3} kinds more" if len(odd) > 3 else ""
        unlike = f", unlike the schema: {kinds}{more}" if odd else ""
        others = f", {self.others} other objects" if self.others else ""
        return f"{self.states} world states{others}{unlike}"


def _fault(content: dict[str, Any]) -> str:
    """Why a world state cannot be passed on: it has to be valid JSON, and both teams' have to fit into one datagram."""
    try:
        size = len(json.dumps(content, allow_nan=False))
    except ValueError:
        return "a number that is not finite"
    return f"more than {MOST_BYTES} bytes" if size > MOST_BYTES else ""
