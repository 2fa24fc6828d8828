"""What a team's base station tells of the world, read leniently: counted, and kept as it came."""

from typing import Any

from schemas.league.findings import Findings
from schemas.league.lenient_json import REQUIRED, fields_of, items_of, vector


class TeamWorldState:
    """One team's world states."""

    def __init__(self) -> None:
        self.states = 0
        """World states that could be read."""
        self.others = 0
        """Objects that were none."""
        self.findings = Findings()
        """How they differ from the league's schema."""
        self.newest: dict[str, Any] | None = None
        """As it came."""
        self.newest_at = 0.0
        """When it came, wall time in s."""

    def update(self, said: dict[str, Any], now: float) -> None:
        """The next object, at wall time `now` in s."""
        fields = fields_of(said, self.findings)
        if "robots" not in fields and fields.get("type") != "worldstate":
            self.others += 1
            return
        self.states += 1
        self.newest, self.newest_at = said, now
        self.findings.place = f"world state {self.states}"
        for key in REQUIRED:
            if key not in fields:
                self.findings.note(f"worldstate without {key}")
        for one in items_of(fields.get("robots")):
            robot = fields_of(one, self.findings)
            x, y, _ = vector(robot.get("pose"), 3, "pose", self.findings)
            if x is None or y is None:
                self.findings.note("robot without a position", lost=True)

    def summary(self) -> str:
        """In words."""
        odd = [*self.findings.lost, *self.findings.coped]
        kinds = "; ".join(f"{finding.what} ({finding.count})" for finding in odd[:3])
        more = f" and {len(odd) - 3} kinds more" if len(odd) > 3 else ""
        unlike = f", unlike the schema: {kinds}{more}" if odd else ""
        others = f", {self.others} objects that are none" if self.others else ""
        return f"{self.states} world states{others}{unlike}"
