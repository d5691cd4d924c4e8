"""Long calls into C++, which a person may interrupt."""

import threading
from typing import Callable, Optional, TypeVar

from . import _core

Answer = TypeVar("Answer")


def run(task: Callable[[], Answer], stop: Optional[_core.Stop] = None, poll: Callable[[], None] = lambda: None,
        interval_s: float = 0.1) -> Answer:
    """Runs `task` in a thread of its own and returns its answer, or raises its error. `poll` is called here every
    `interval_s` meanwhile.

    Ctrl-C, or an error in `poll`, sets `stop`, waits for the task to end cleanly, and then is raised.
    """
    ended, answers, errors = threading.Event(), [], []

    def work() -> None:
        try:
            answers.append(task())
        except BaseException as error:  # raised again where somebody waits
            errors.append(error)
        finally:
            ended.set()

    threading.Thread(target=work, daemon=True).start()
    try:
        while not ended.wait(interval_s):
            poll()
    except BaseException:
        if stop is not None:
            stop.set()
        while not ended.wait(interval_s):
            pass
        raise
    if errors:
        raise errors[0]
    return answers[0]
