"""The command line over many workers: `python3 -m pastefit calibrate STUDY --out DIR`."""

import argparse
import concurrent.futures as futures
import contextlib
import math
import os
import sys
from typing import Any, ContextManager, List, Optional

from . import InputError, calibrate
from .workers import end_with_parent, processors

_DESCRIPTION = """Calibrates a study as the program `pastefit calibrate` does, with the same card, and the simulations
spread over processes of this machine (the default), the ranks of MPI, or the workers of a Dask cluster:

    python3 -m pastefit calibrate STUDY --out DIR
    mpiexec -n 65 python3 -m mpi4py.futures -m pastefit calibrate STUDY --out DIR
    python3 -m pastefit calibrate STUDY --out DIR --dask ADDRESS
"""


def _seconds(text: str) -> float:
    value = float(text)
    if not 0 <= value < math.inf:
        raise argparse.ArgumentTypeError(f"{text} is not a number of seconds")
    return value


def _count(text: str) -> int:
    value = int(text)
    if not 1 <= value <= 100_000:
        raise argparse.ArgumentTypeError(f"{text} is not from 1 to 100000")
    return value


def _arguments(words: Optional[List[str]]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python3 -m pastefit", description=_DESCRIPTION,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    verb = parser.add_subparsers(dest="verb", required=True).add_parser(
        "calibrate", description=_DESCRIPTION, formatter_class=argparse.RawDescriptionHelpFormatter)
    verb.add_argument("study", metavar="STUDY", help="study file")
    verb.add_argument("--out", metavar="DIR", required=True, help="folder for card, summary, page and all simulations")
    earlier = verb.add_mutually_exclusive_group()
    earlier.add_argument("--resume", action="store_true", help="continue with the simulations stored in DIR")
    earlier.add_argument("--force", action="store_true", help="replace the earlier result in DIR")
    verb.add_argument("--quiet", action="store_true", help="no progress")
    verb.add_argument("--time", metavar="SECONDS", type=_seconds, default=0, help="end after this time with the best material so far")
    where = verb.add_mutually_exclusive_group()
    where.add_argument("--processes", metavar="N", type=_count, help="processes of this machine; default: one per core")
    where.add_argument("--dask", metavar="ADDRESS", help="address of a Dask scheduler, tcp://host:8786, or its file")
    return parser.parse_args(words)


def _dask_client(address: str) -> ContextManager[Any]:
    where = f"--dask {address}"
    try:
        from dask.distributed import Client
    except ImportError as error:
        raise InputError([(where, f"cannot be used: {error}", "install dask and distributed, or leave it out")]) from error
    if address.endswith(".json") and not os.path.isfile(address):  # the client would wait for it without an end
        raise InputError([(where, "is not there", "tcp://host:8786, or the scheduler's file")])
    try:
        return Client(scheduler_file=address) if address.endswith(".json") else Client(address)
    except (OSError, ValueError, TypeError) as error:
        raise InputError([(where, f"cannot be reached: {error}", "tcp://host:8786, or the scheduler's file")]) from error


def _executor(arguments: argparse.Namespace) -> ContextManager[Any]:
    """Where the simulations run. Under `python3 -m mpi4py.futures` the other ranks wait for work."""
    if arguments.dask:
        return _dask_client(arguments.dask)
    if "mpi4py.futures" in sys.modules and arguments.processes is None:
        from mpi4py.futures import MPIPoolExecutor
        return MPIPoolExecutor()
    return futures.ProcessPoolExecutor(arguments.processes or processors(), initializer=end_with_parent,
                                       initargs=(os.getpid(),))


def main(words: Optional[List[str]] = None) -> int:
    """Exit status: 0 the material is confirmed, 1 it is not, 2 the input cannot be used."""
    arguments = _arguments(words)
    try:
        with contextlib.ExitStack() as stack:
            executor = stack.enter_context(_executor(arguments))
            result = calibrate(arguments.study, out=arguments.out, executor=executor, progress=not arguments.quiet,
                               resume=arguments.resume, force=arguments.force, wall_budget_s=arguments.time)
    except InputError as error:
        print(error, file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print("interrupted: the best material so far is written, and --resume continues", file=sys.stderr)
        return 1
    print(result.summary, end="")
    return 0 if result.confirmed else 1


if __name__ == "__main__":
    sys.exit(main())
