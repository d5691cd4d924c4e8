"""What is wrong with an input: every fault at once."""

import numbers
import re
from typing import Any, Iterable, List, NamedTuple, Tuple

_SWITCHES = re.compile(r"--(resume|force|unconfirmed)\b")
_OPTIONS = re.compile(r"--([a-z]+(?:-[a-z]+)*)")


def _in_python(text: str) -> str:
    """The options of the program, which its messages name, as the arguments of this package."""
    text = _SWITCHES.sub(r"\1=True", text)
    return _OPTIONS.sub(lambda option: option.group(1).replace("-", "_"), text)


class Fault(NamedTuple):
    """One thing that is wrong: where it stands, what is wrong, and what would be right."""

    where: str
    what: str
    remedy: str

    def __str__(self) -> str:
        return f"{self.where}: {self.what}" + (f"; {self.remedy}" if self.remedy else "")


class InputError(ValueError):
    """An input that cannot be used. `faults` holds every error, each a `Fault` (where, what, remedy)."""

    faults: List[Fault]

    def __init__(self, faults: Iterable[Tuple[str, str, str]]) -> None:
        self.faults = [Fault(*map(_in_python, fault)) for fault in faults]
        super().__init__(self.faults)  # so that it can be pickled

    def __str__(self) -> str:
        return "\n".join(map(str, self.faults))


def whole_number_faults(where: str, value: Any, most: int, remedy: str) -> List[Tuple[str, str, str]]:
    """What is wrong with an option that is a whole number from 0 to `most`."""
    whole = isinstance(value, numbers.Integral) and not isinstance(value, bool)
    return [] if whole and 0 <= value <= most else [(where, f"is {value!r:.60}", remedy)]


def threads_faults(threads: Any) -> List[Tuple[str, str, str]]:
    return whole_number_faults("threads", threads, 1_000_000, "a whole number, 0 for one of each core")


def seed_faults(where: str, seed: Any) -> List[Tuple[str, str, str]]:
    if seed is None:
        return []
    return whole_number_faults(where, seed, 2**64 - 1, "a whole number from 0 to 2**64 - 1")
