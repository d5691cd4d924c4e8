"""How a calibration shows that it goes on."""

import sys
from typing import Any, Callable, Dict, Union

Progress = Dict[str, Any]
Show = Union[None, bool, Callable[[Progress], None]]


class Bar:
    """A bar of tqdm where that is there, else a line on standard error now and then."""

    def __init__(self) -> None:
        try:
            from tqdm.auto import tqdm
            self._bar: Any = tqdm(unit="simulation", leave=True)
        except ImportError:
            self._bar = None
        self._shown = -1

    def __call__(self, progress: Progress) -> None:
        done, miss = progress["simulations"], progress["best_miss"]
        words = progress["phase"] + ("" if miss is None else f", best error {miss:.2f} of its tolerance")
        if self._bar is not None:
            self._bar.total = progress["budget"] or None
            self._bar.n = done
            self._bar.set_description_str(words)
        elif done >= self._shown + 10:
            print(f"{done} of at most {progress['budget']} simulations, {words}", file=sys.stderr)
            self._shown = done

    def close(self) -> None:
        if self._bar is not None:
            self._bar.close()


def _nobody(_: Progress) -> None:
    pass


def shown_by(progress: Show) -> Callable[[Progress], None]:
    """The function that is told: the caller's own, a bar for True, nobody for None and False."""
    if progress is True:
        return Bar()
    return progress if callable(progress) else _nobody


def close(show: Callable[[Progress], None]) -> None:
    if isinstance(show, Bar):
        show.close()
