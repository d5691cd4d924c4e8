"""Functions called on an executor whose processes may die."""

import concurrent.futures as futures
import os
import threading
import time
from typing import Any, Callable

MOST_DEATHS = 3
# A process that is forked while another one is being forked keeps its pipes open, and its death goes unseen.
_FORKING = threading.Lock()


class WorkerDied(RuntimeError):
    """The process that ran a call died, as often as it was asked again."""


def _always() -> bool:
    return True


def end_with_parent(parent: int) -> None:
    """Ends this process soon after its parent with this number, also if that was killed: an initializer of pools."""

    def watch() -> None:
        while os.getppid() == parent:
            time.sleep(1)
        os._exit(1)

    threading.Thread(target=watch, daemon=True).start()


def processors() -> int:
    """That this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


class Workers:
    """An executor that is asked again when a worker dies.

    executor: whatever has `submit` and gives futures (concurrent.futures, mpi4py.futures, Dask's client). A process pool
    breaks as a whole when a process dies, and every call in it with it; then the pool is made anew, and each of these
    calls is repeated in a process of its own, so that only the one that kills its process is found guilty. A scheduler
    of Dask repeats a call whose worker died by itself, as often as its `allowed-failures` say.
    """

    def __init__(self, executor: Any) -> None:
        self._executor, self._given = executor, executor
        self._lock = threading.Lock()

    @property
    def count(self) -> int:
        """Calls that are worth having under way."""
        if callable(getattr(self._given, "ncores", None)):  # a client of Dask
            return max(1, sum(self._given.ncores().values()))
        return getattr(self._given, "_max_workers", None) or processors()

    def call(self, function: Callable[..., Any], *arguments: Any, goes_on: Callable[[], bool] = _always) -> Any:
        """What the function returns, or raises; None once `goes_on()` is false.

        Errors: WorkerDied after three deaths.
        """
        executor = self._executor
        try:
            return _wait(_submit(executor, function, *arguments), goes_on)
        except futures.BrokenExecutor:
            self._renew(executor)
        except Exception as error:
            if type(error).__name__ != "KilledWorker":  # of Dask, which need not be there
                raise
            raise WorkerDied(f"Each worker of Dask that simulated it died: {error}") from error
        for _ in range(MOST_DEATHS - 1):
            alone = _alike(self._given, 1)
            try:
                return _wait(_submit(alone, function, *arguments), goes_on)
            except futures.BrokenExecutor:
                pass
            finally:
                alone.shutdown(wait=False)
        raise WorkerDied(f"The process that simulated it died {MOST_DEATHS} times; see whether its memory is enough.")

    def close(self) -> None:
        """Ends the pools that were made in place of a broken one; the caller's own stays his."""
        if self._executor is not self._given:
            self._executor.shutdown(wait=False)

    def _renew(self, broken: Any) -> None:
        with self._lock:
            if self._executor is broken:  # else another call has done so already
                self._executor = _alike(self._given, self.count)


def _alike(executor: Any, workers: int) -> futures.ProcessPoolExecutor:
    """A process pool as that one, which was broken."""
    if not isinstance(executor, futures.ProcessPoolExecutor):
        raise WorkerDied(f"A worker of {type(executor).__name__} died, and it cannot be made anew.")
    return futures.ProcessPoolExecutor(workers, mp_context=getattr(executor, "_mp_context", None),
                                       initializer=getattr(executor, "_initializer", None),
                                       initargs=getattr(executor, "_initargs", ()))


def _submit(executor: Any, function: Callable[..., Any], *arguments: Any) -> Any:
    with _FORKING:
        return executor.submit(function, *arguments)


def _wait(future: Any, goes_on: Callable[[], bool]) -> Any:
    ended = threading.Event()
    future.add_done_callback(lambda _: ended.set())
    while not ended.wait(0.1):
        if not goes_on():
            future.cancel()
            return None
    return future.result()
