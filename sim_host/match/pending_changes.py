"""Changes that are pending between two ticks: decided by the referee in the last tick, or by an operator since."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

from schemas.config.roster import Placement
from schemas.messages.applied import OperatorChange
from schemas.messages.parameters import Setting


@dataclass(slots=True)
class PendingChanges:
    """Changes to apply before the next tick, in this order: rebuild the world, place bodies, make a checkpoint."""

    placements: list[Placement] = field(default_factory=list)
    checkpoint: bool = False
    rebuild_world: bool = False
    """Parameters, robots or obstacles of the world have changed."""
    new_episode: bool = False
    """Another episode begins: commands that answer the tick before are ignored."""
    parameters: dict[str, Setting] = field(default_factory=dict)
    """Changed parameter → its new value."""
    roster_changed: bool = False
    """Robots were added, removed or changed."""
    obstacles_changed: bool = False
    """Obstacles were added or removed."""
    by_operator: list[OperatorChange] = field(default_factory=list)
    """The changes by an operator among them, each of which is reported by an event."""

    def add_placements(self, placements: Sequence[Placement], names: Sequence[str]) -> None:
        """Add placements after the pending ones, of which placements of bodies not in `names` are dropped."""
        self.placements = [one for one in self.placements if one.body in names] + list(placements)
        self.checkpoint = True

    def applied_fields(self) -> dict[str, Any]:
        """The fields of a `schemas.messages.applied.Applied` on these changes, without those at their default."""
        fields: dict[str, Any] = {"placements": self.placements, "checkpoint": self.checkpoint}
        if self.rebuild_world:
            fields["remade"] = True
        if self.parameters:
            fields["parameters"] = self.parameters
        return fields
