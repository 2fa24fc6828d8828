"""Changes that are pending between two ticks: decided by the referee in the last one, or by an operator since."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

from schemas.config.roster import Placement
from schemas.game import EventKind
from schemas.messages.parameters import Setting


@dataclass(slots=True)
class PendingChanges:
    """Applied in this order before the next tick: the world rebuilt, bodies placed, a checkpoint made."""

    placements: list[Placement] = field(default_factory=list)
    checkpoint: bool = False
    rebuild_world: bool = False
    """Numbers, robots or obstacles of the world have changed."""
    new_episode: bool = False
    """Another episode begins: what robots answer to the tick before means nothing."""
    parameters: dict[str, Setting] = field(default_factory=dict)
    """Those that were changed, and their new values."""
    roster_changed: bool = False
    """Other robots take part."""
    obstacles_changed: bool = False
    """Other obstacles stand there."""
    events: list[tuple[EventKind, str, str]] = field(default_factory=list)
    """Kind, rule and sentence of each event that tells of it."""

    def add_placements(self, placements: Sequence[Placement], names: Sequence[str]) -> None:
        """Set bodies down after those that are pending, of which only these names are there still."""
        self.placements = [one for one in self.placements if one.body in names] + list(placements)
        self.checkpoint = True

    def applied_fields(self) -> dict[str, Any]:
        """The fields of a `schemas.messages.host.Applied` that tell of it, without those that stand for nothing."""
        fields: dict[str, Any] = {"placements": self.placements, "checkpoint": self.checkpoint}
        if self.rebuild_world:
            fields["remade"] = True
        if self.parameters:
            fields["parameters"] = self.parameters
        return fields
