"""What is due between two ticks: decided by the referee in the last one, or by an operator since."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

from schemas.game import EventKind
from schemas.parameters import Setting
from schemas.roster import Placement


@dataclass(slots=True)
class Due:
    """Done in this order before the next tick: the world remade, bodies placed, the world rebuilt."""

    placements: list[Placement] = field(default_factory=list)
    is_checkpoint: bool = False
    remake: bool = False
    """Numbers, robots or obstacles of the world have changed."""
    begins_anew: bool = False
    """Another episode begins: what robots answer to the tick before means nothing."""
    parameters: dict[str, Setting] = field(default_factory=dict)
    """Those that were changed, and their new values."""
    recast: bool = False
    """Other robots take part."""
    rebuilt: bool = False
    """Other obstacles stand there."""
    said: list[tuple[EventKind, str, str]] = field(default_factory=list)
    """Kind, rule and sentence of each event that tells of it."""

    def place(self, placements: Sequence[Placement], names: Sequence[str]) -> None:
        """Set bodies down after those that are due to be, of which only these names are there still."""
        self.placements = [one for one in self.placements if one.body in names] + list(placements)
        self.is_checkpoint = True

    def noted(self) -> dict[str, Any]:
        """The fields of a `schemas.host.Applied` that tell of it, without those that stand for nothing."""
        fields: dict[str, Any] = {"placements": self.placements, "checkpoint": self.is_checkpoint}
        if self.remake:
            fields["remade"] = True
        if self.parameters:
            fields["parameters"] = self.parameters
        return fields
