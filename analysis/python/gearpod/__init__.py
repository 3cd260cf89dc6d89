"""gearpod in Python: computations in process, results as numpy and pandas, runs, figures.

    import gearpod
    study = gearpod.Study("studies/planet-crack.toml")    # or a dict, or TOML text
    study.stiffness()["sp1"]              # mesh stiffness over a mesh period
    study.simulate(rows=[0, 1]).signals["sensor"]         # numpy, gearboxes x samples
    study.features(measured, sampling_Hz=20000)           # of a recording
    gearpod.pod({"size": sizes, "hit": hits}).a90         # of an inspection table
    gearpod.sweep("study.toml", {"sensor.noise_m_s2": [1, 2]})   # as new, check, compare, accuracy

    results = gearpod.run("studies/planet-crack.toml", set={"sensor.noise_levels": [2]})
    results = gearpod.open("planet-crack.h5")
    results.frame(noise=1.0)              # one row per gearbox: inputs and features (pandas)
    results.pod(values)                   # your own feature, evaluated like the program's
    gearpod.figures.detection(results, "window_ratio")    # matplotlib axes

numpy and h5py are needed; pandas for frames, xarray for datasets, matplotlib for figures, the
program for runs.
"""

from . import figures
from .columns import Columns
from .commands import accuracy, check, compare, new, sweep
from .library import (Features, Pod, Simulation, Study, describe, features, modes, pod, simulate,
                      stiffness)
from .program import Failed, find_program
from .results import Lives, Results, open, run

__all__ = ["Columns", "Failed", "Features", "Lives", "Pod", "Results", "Simulation", "Study",
           "accuracy", "check", "compare", "describe", "features", "figures", "find_program",
           "modes", "new", "open", "pod", "run", "simulate", "stiffness", "sweep"]
