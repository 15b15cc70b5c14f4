"""Verification: the ordinary program on ordinary scenes, its results against exact solutions.

    scene.toml + settings of a resolution  --run-->  Run  --Case.errors-->  errors  --ladder-->  orders  --> verdict

A case is a folder with a scene and a `case.py` that defines CASES, a list of instances of Case.
"""
from .base import Bound, Case, GridCase, load_cases
from .ladder import Measurement, Row, measure, rows
from .norms import binned, fall, l1, l2, linf, order, relative
from .run import Run, RunFailed, State, execute
from .verdict import verify
