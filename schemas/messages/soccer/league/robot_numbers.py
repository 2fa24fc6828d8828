"""Numbers of robots, by which the league identifies them."""

from collections.abc import Mapping

from schemas.side import Side


def numbers_of(sides: Mapping[str, Side]) -> dict[str, int]:
    """Robot → its number: that at the end of its name, or where these are not unique, its place in the team, from 1."""
    numbers: dict[str, int] = {}
    for side in Side:
        names = [name for name, own in sides.items() if own is side]
        in_names = [_number_of(name) for name in names]
        clear = None not in in_names and len(set(in_names)) == len(in_names)
        for place, (name, given) in enumerate(zip(names, in_names, strict=True), 1):
            numbers[name] = (given or 0) if clear else place
    return numbers


def _number_of(name: str) -> int | None:
    digits = name[len(name.rstrip("0123456789")) :]
    return int(digits) if digits else None
