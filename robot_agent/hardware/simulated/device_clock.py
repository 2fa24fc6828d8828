"""The clock of a device on that of its driver, from the stamps of what goes both ways. Pure."""

_DRIFT = 1e-4
"""s by which two clocks may part in a second."""


class DeviceClock:
    """By how much the driver's clock is ahead of the device's.

    A device takes a demand as soon as it comes, which is after the look that led to it: the most by which any was ahead
    is too little by the quickest decision. A measurement waits for the driver's next look, up to a period. It tells
    more than nothing, and counts before the first demand.
    """

    def __init__(self) -> None:
        self._ahead: float | None = None
        self._looked = 0.0
        self._is_by_demands = False

    def look(self, now: float, measured: float, ahead: float | None) -> None:
        """What was measured at `measured` on the device's clock is read `now`, both in s.

        `ahead` is by how much the driver's clock at the look before a demand was ahead of the device's when that
        arrived; None before the first.
        """
        parted, self._looked = _DRIFT * (now - self._looked), now
        before = self._ahead
        if ahead is not None:
            self._ahead = ahead if before is None or not self._is_by_demands else max(before - parted, ahead)
            self._is_by_demands = True
        elif not self._is_by_demands:
            self._ahead = now - measured if before is None else min(before + parted, now - measured)

    def on_driver(self, measured: float) -> float | None:
        """A time of the device on the driver's clock; None before the first look."""
        return None if self._ahead is None else measured + self._ahead
