"""gearpod in Python: results as numpy and pandas, runs of the program, figures on matplotlib axes.

    import gearpod
    results = gearpod.open("planet-crack.h5")
    results.frame(noise=1.0)              # one row per gearbox: inputs and features (pandas)
    results.signals(17)                   # signals of row 17, stored or computed again
    louder = gearpod.run("studies/planet-crack.toml", set={"sensor.noise_levels": [2]})
    gearpod.figures.detection(results, "window_ratio")    # matplotlib axes

numpy and h5py are needed; pandas for frames, matplotlib for figures, the program for runs.
"""

from . import figures
from .program import Failed, find_program, run
from .results import Results, open

__all__ = ["Failed", "Results", "figures", "find_program", "open", "run"]
