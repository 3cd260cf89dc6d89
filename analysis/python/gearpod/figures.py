"""Figures of results. Each function draws on the given matplotlib axes, or on new ones, and returns
them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Dict, Optional

import numpy as np

if TYPE_CHECKING:
    from .results import Results


def _axes(axes: Optional[Any]) -> Any:
    if axes is not None:
        return axes
    try:
        import matplotlib.pyplot as plt
    except ImportError as error:
        raise ImportError("figures need matplotlib (Debian: python3-matplotlib)") from error
    return plt.subplots(layout="constrained")[1]


def _size_scale(results: "Results") -> "tuple[float, str]":
    metres = results.units.get(results.size_name) == "m"
    name = results.size_name.removesuffix("_m").replace("_", " ")
    return (1e3, f"{name}, mm") if metres else (1.0, name)


def detection(results: "Results", feature: str, noise: Optional[float] = None,
              axes: Optional[Any] = None) -> Any:
    """Detection rates with Wilson intervals over fault size, at all noise levels or at one."""
    axes = _axes(axes)
    scale, label = _size_scale(results)
    table = results.detection_columns()
    levels = results.noise_levels
    for level in levels if noise is None else levels[[results.level(noise)]]:
        shown = ((table["feature"] == feature) & (table["noise_level"] == level)
                 & (table["size_high"] > 0) & (table["tested"] > 0))
        x = scale * 0.5 * (table["size_low"][shown] + table["size_high"][shown])
        rate = table["pd"][shown]
        axes.errorbar(x, rate, yerr=[rate - table["lower"][shown], table["upper"][shown] - rate],
                      marker="o", capsize=2, label=f"noise x {level:g}")
    axes.axhline(0.9, color="0.5", linewidth=0.8, linestyle="--")
    axes.set(xlabel=label, ylabel="detection rate", ylim=(-0.02, 1.03), title=feature)
    axes.legend()
    return axes


def _level(results: "Results", feature: str, noise: Optional[float]) -> Dict[str, Any]:
    reliability = results.report()["reliability"]
    if reliability is None:
        raise ValueError(f"{results.path}: too many gearboxes for curves")
    for entry in reliability["features"]:
        if entry["name"] == feature:
            index = results.level(results.reference if noise is None else noise)
            level: Dict[str, Any] = entry["levels"][index]
            return level
    raise KeyError(f"no feature {feature}; available: {', '.join(results.features)}")


def pod(results: "Results", feature: str, noise: Optional[float] = None,
        axes: Optional[Any] = None) -> Any:
    """Fitted probability of detection with its bounds. Raises ValueError with the reason if there
    is no curve."""
    curve = _level(results, feature, noise)["hit_miss"]
    if curve["refusal"]:
        raise ValueError(f"{feature}: {curve['refusal']}")
    axes = _axes(axes)
    scale, label = _size_scale(results)
    band = {name: np.array([np.nan if v is None else v for v in values], float)
            for name, values in curve["band"].items()}
    line, = axes.plot(scale * band["size"], band["pod"], label=feature)
    axes.fill_between(scale * band["size"], band["lower"], band["upper"], alpha=0.2, linewidth=0,
                      color=line.get_color())
    axes.axhline(0.9, color="0.5", linewidth=0.8, linestyle="--")
    axes.set(xlabel=label, ylabel="probability of detection", ylim=(-0.02, 1.03))
    axes.legend()
    return axes


def roc(results: "Results", feature: str, noise: Optional[float] = None,
        axes: Optional[Any] = None) -> Any:
    """ROC curve: share of faulty gearboxes found against share of healthy ones with an alarm."""
    level = _level(results, feature, noise)
    axes = _axes(axes)
    area = level["auc"]["auc"]
    axes.plot(level["roc"]["false_alarm_rate"], level["roc"]["detection_rate"],
              label=feature if area is None else f"{feature}, area {area:.3f}")
    axes.set(xlabel="false-alarm rate", ylabel="detection rate", xlim=(0, 1), ylim=(0, 1.01))
    axes.legend(loc="lower right")
    return axes


def scatter(results: "Results", feature: str, noise: Optional[float] = None,
            axes: Optional[Any] = None) -> Any:
    """A feature over fault size with the alarm threshold, one point per gearbox."""
    axes = _axes(axes)
    noise = results.reference if noise is None else noise
    scale, label = _size_scale(results)
    rows = results.rows("graded")
    axes.plot(scale * results.size[rows], results.feature(feature, noise)[rows], ".", alpha=0.4)
    table = results.detection_columns()
    shown = (table["feature"] == feature) & np.isclose(table["noise_level"], noise)
    threshold = table["threshold"][shown]
    if threshold.size and np.isfinite(threshold[0]):
        axes.axhline(threshold[0], color="0.3", linewidth=0.9, linestyle="--", label="threshold")
        axes.legend()
    unit = results.units[feature]
    axes.set(xlabel=label, ylabel=feature if unit in ("", "1") else f"{feature}, {unit}")
    return axes


def signal(results: "Results", row: int, name: str = "sensor", axes: Optional[Any] = None) -> Any:
    """One signal of one gearbox over time, or over the sample number if there is no time."""
    signals = results.signals(row)
    if name not in signals:
        raise KeyError(f"no signal {name}; available: {', '.join(signals)}")
    axes = _axes(axes)
    time = next((n for n in ("time_s", "time") if n in signals), None)
    x = signals[time] if time else np.arange(len(signals[name]))
    axes.plot(x, signals[name], linewidth=0.7)
    axes.set(xlabel="time, s" if time else "sample", ylabel=name, title=f"row {row}")
    return axes
