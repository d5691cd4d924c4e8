"""pastefit from Python: calibrates DEM contact models for pasty material from laboratory tests.

    import pastefit as pf
    result = pf.calibrate("my-paste/study.json", out="my-paste/out")
    print(result.summary)

The manual has a tutorial (calibrate/manual/python.md). Lengths, forces and so on are in SI unless a name says another
unit.
"""

from . import _core
from .calibration import CalibrationResult, calibrate, simulate_task
from .card import Card
from .checks import Check, Export, Verification, check, export, export_targets, verify
from .faults import Fault, InputError
from .mix import interpolate
from .problem import Problem
from .search import Search
from .simulation import Frame, Simulation, simulate
from .study import Study
from .workers import WorkerDied

__version__ = _core.version()
__all__ = ["CalibrationResult", "Card", "Check", "Export", "Fault", "Frame", "InputError", "Problem", "Search", "Simulation", "Study",
           "Verification", "WorkerDied", "calibrate", "check", "export", "export_targets", "interpolate", "simulate",
           "simulate_task", "verify"]
