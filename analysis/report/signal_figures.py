"""Figures of the signals of the two example gearboxes, and of the mesh stiffness."""

from statistics import median

import numpy
from blocks import note, paragraph, table
from charts import INK, NOISY, colour, dash, legend_above, marker, panel, shade, to_svg
from words import input_name, noise, number, quantity

WINDOW = 8  # mesh periods of a window of a spectrogram
MOST_BINS, LOWEST = 120, -60  # frequencies in a spectrogram; dB


def _name(report, gearbox):
    kind = "healthy" if gearbox["size"] == 0 else report.sizes.text(gearbox["size"])
    return f"{kind} (row {gearbox['row']})"


def _fault_spans(axes, gearbox, turn):
    for span in gearbox["engagements"]:
        if span["from"] < turn:
            axes.axvspan(span["from"], min(span["to"], turn), color=colour(1), alpha=0.16,
                         linewidth=0)


def _turn(gearbox, key):
    mesh = gearbox[key]["clean"]["mesh"]
    return round(mesh[-1] + 0.5) if mesh else 1


def _time_charts(report, page, key, scale, axis, what):
    """One chart per gearbox, all with the same scale."""
    gearboxes = [g for g in report.data["examples"]["gearboxes"] if g[key]]
    level = report.data["examples"]["noise_level"]
    largest = max(abs(v) for g in gearboxes for part in ("clean", "noisy")
                  for v in g[key][part]["value"]) * scale
    charts, rows = [], []
    for g in gearboxes:
        figure, axes = panel(2.7)
        turn = _turn(g, key)
        _fault_spans(axes, g, turn)
        axes.plot(g[key]["noisy"]["mesh"], [scale * v for v in g[key]["noisy"]["value"]],
                  color=NOISY, linewidth=0.6, label=f"with {noise(level)}")
        axes.plot(g[key]["clean"]["mesh"], [scale * v for v in g[key]["clean"]["value"]],
                  color=colour(0), linewidth=0.9, label="without noise")
        axes.set(xlim=(0, turn), ylim=(-1.05 * largest or -1, 1.05 * largest or 1),
                 xlabel="Mesh periods of one turn of the monitored gear", ylabel=axis)
        legend_above(axes, _name(report, g))
        clean = [scale * v for v in g[key]["clean"]["value"]]
        at = max(range(len(clean)), key=lambda i: abs(clean[i]))
        peak = (f"largest {number(clean[at])} {axis.rsplit(', ', 1)[-1]} at mesh "
                f"{number(g[key]['clean']['mesh'][at])}")
        engaged = "; ".join(f"{s['pair']} {number(s['from'])} to {number(s['to'])}"
                            for s in g["engagements"]) or "none"
        rows.append([_name(report, g), number(min(clean)), number(max(clean)),
                     number(g[key]["clean"]["mesh"][at]), engaged,
                     quantity(1e3 * g["mesh_period_s"], "ms")])
        charts.append(to_svg(figure, f"{what}, {_name(report, g)}",
                             f"{peak}; faulty tooth engaged: {engaged}", page.names))
    data = table(f"{what}, without noise ({axis.rsplit(', ', 1)[-1]})",
                 ["gearbox", "smallest", "largest", "largest deviation at mesh",
                  "faulty tooth engaged at meshes", "mesh period"], rows)
    return charts, data + note("The drawn points are in the JSON, examples.gearboxes." + key + ".")


def sensor(report, page):
    charts, data = _time_charts(report, page, "sensor", 1.0, "Acceleration, m/s²",
                                "Sensor signal over one turn")
    how = ("Sensor signal after its low-pass filter over one turn of the monitored gear. Shaded: "
           "the faulty tooth is in mesh. Long signals are drawn by the smallest and largest "
           "value of each interval, so no peak is lost.")
    return page.figure("Sensor signal", charts, how, data)


def contact_loss(report):
    """Table of the contact loss ratio of every mesh; empty where teeth cannot separate."""
    table_ = report.table("contact_loss")
    return "<h3>Contact of the teeth</h3>" + paragraph(report.text("contact.how")) + table_ if table_ else ""


def transmission_error(report, page):
    charts, data = _time_charts(report, page, "te", 1e6, "Transmission error, µrad",
                                "Transmission error over one turn")
    how = ("Averaged transmission error over one turn of the monitored gear, mean removed, as in "
           "Park et al. (2016), Fig. 11. Shaded: the faulty tooth is in mesh; a large fault "
           "makes it differ from its neighbours.")
    return page.figure("Transmission error", charts, how, data)


def spectrum(report, page):
    gearboxes = [g for g in report.data["examples"]["gearboxes"] if g["spectrum"]]
    largest = max(max(g["spectrum"]["whole"][part]["amplitude"], default=0) for g in gearboxes
                  for part in ("clean", "noisy")) or 1
    charts, tables = [], []
    for band in ("whole", "zoom"):
        for g in gearboxes:
            charts.append(_spectrum_chart(report, page, g, band, largest))
    for g in gearboxes:
        lines = g["spectrum"]["zoom"]["clean"]
        rows = [[number(lines["frequency_Hz"][i], 5),
                 number(lines["frequency_Hz"][i] * g["mesh_period_s"], 5),
                 number(lines["amplitude"][i])] for i in sorted(_largest(lines, 12))]
        tables.append(table(f"Largest lines without noise around the largest of all, "
                            f"{_name(report, g)}",
                            ["frequency, Hz", "mesh frequencies", "amplitude, m/s²"], rows))
    how = ("One-sided amplitudes over the whole windowing span, in which every tooth of the "
           "monitored gear meets every tooth of its mate; of dense lines the largest of each "
           "interval is drawn. The second row is enlarged around each gearbox's largest line: "
           "sidebands between the lines of the healthy gearbox indicate a fault. The scale is "
           "logarithmic.")
    return page.figure("Spectrum of the sensor signal", charts, how, "".join(tables)
                       + note("The drawn points are in the JSON, examples.gearboxes.spectrum."))


def evenly_spaced(times, signal):
    """The signal at as many even times, from cubics through four samples each."""
    place = numpy.interp(numpy.linspace(times[0], times[-1], len(times)), times, range(len(times)))
    first = numpy.clip(place.astype(int), 1, len(times) - 3)
    x = place - first
    a, b, c, d = (signal[first + k] for k in range(-1, 3))
    return ((x * (x - 1) * (2 - x) * a + x * (x + 1) * (x - 1) * d) / 6
            + ((x + 1) * (x - 1) * (x - 2) * b + x * (x + 1) * (2 - x) * c) / 2)


def levels_over_time(given):
    """Levels in dB (window, frequency) of a signal at uneven times, in windows of eight mesh periods
    (Hann), one per mesh period; the middle of each window, its mesh frequency, and the
    frequencies. None for a signal shorter than a window."""
    times, mesh = numpy.array(given["time_s"]), given["samples_per_mesh"]
    length = WINDOW * mesh
    if len(times) < length:
        return None
    even = evenly_spaced(times, numpy.array(given["sensor"]))
    step = (times[-1] - times[0]) / (len(times) - 1)
    turn = (numpy.arange(length) + 0.5) / length
    windows = numpy.lib.stride_tricks.sliding_window_view(even, length)[::mesh]
    amplitude = numpy.abs(numpy.fft.rfft(windows * (0.5 - 0.5 * numpy.cos(2 * numpy.pi * turn))))
    line = 1 / (step * length)
    shown = min(length // 2, int(given["highest_Hz"] / line))
    width = max(1, -(-shown // MOST_BINS))
    bins = shown // width
    peaks = amplitude[:, 1:1 + bins * width].reshape(len(windows), bins, width).max(axis=2)
    levels = 20 * numpy.log10(numpy.maximum(peaks / (peaks.max() or 1), 10 ** (LOWEST / 20)))
    middle = times[0] + step * (mesh * numpy.arange(len(windows)) + 0.5 * length)
    # Mesh period around the middle: the time of as many samples.
    half = mesh // 2
    first = numpy.clip(numpy.searchsorted(times, middle), half, len(times) - 1 - half) - half
    return (levels, middle, 2 * half / mesh / (times[first + 2 * half] - times[first]),
            line * (1 + width * numpy.arange(bins) + 0.5 * (width - 1)))


def spectrogram(report, page):
    """Levels over time and frequency where the speed varies; empty where it does not."""
    charts, rows = [], []
    for g in report.data["examples"]["gearboxes"]:
        found = levels_over_time(g["spectrogram"]) if "spectrogram" in g else None
        if found is None:
            continue
        levels, times, mesh_Hz, lines = found
        figure, axes = panel(3.2)
        image = axes.imshow(levels.T, origin="lower", aspect="auto", cmap="viridis",
                            interpolation="nearest", extent=(times[0], times[-1], lines[0], lines[-1]))
        figure.colorbar(image, ax=axes, label="dB of the largest line")
        for order in range(1, int(lines[-1] / max(mesh_Hz)) + 1):
            axes.plot(times, order * mesh_Hz, color="white", linewidth=0.5, linestyle=(0, (1, 3)))
        axes.set(ylim=(lines[0], lines[-1]), xlabel="Time, s", ylabel="Frequency, Hz")
        axes.grid(False)
        axes.set_title(_name(report, g), fontsize=10, loc="left")
        slowest, fastest = min(mesh_Hz), max(mesh_Hz)
        rows.append([_name(report, g), number(slowest, 4), number(fastest, 4),
                     number(times[-1] - times[0])])
        charts.append(to_svg(figure, f"Spectrogram of the sensor signal, {_name(report, g)}",
                             f"Mesh frequency {number(slowest, 4)} to {number(fastest, 4)} Hz",
                             page.names))
    how = ("Level of the sensor signal without noise in windows of eight mesh periods, one per "
           "mesh period. Dotted: harmonics of the mesh frequency at that time. Lines that follow "
           "them come from the gears, level lines from resonances or the rest of the machine.")
    return page.figure("Spectrogram of the sensor signal", charts, how, table(
        "Mesh frequency in the spectrogram", ["gearbox", "lowest, Hz", "highest, Hz", "time, s"],
        rows)) if charts else ""


def _largest(lines, count):
    return sorted(range(len(lines["amplitude"])), key=lambda i: -lines["amplitude"][i])[:count]


def _spectrum_chart(report, page, g, band, largest):
    level = report.data["examples"]["noise_level"]
    figure, axes = panel(2.7)
    for part, paint, label in (("noisy", NOISY, f"with {noise(level)}"),
                               ("clean", colour(0), "without noise")):
        lines = g["spectrum"][band][part]
        axes.plot(lines["frequency_Hz"], [max(v, 1e-7 * largest) for v in lines["amplitude"]],
                  color=paint, linewidth=0.8, label=label)
    lines = g["spectrum"][band]["clean"]
    lowest = 0 if band == "whole" else min(lines["frequency_Hz"], default=0)
    axes.set(yscale="log", ylim=(1e-5 * largest, 2 * largest),
             xlim=(lowest, max(lines["frequency_Hz"], default=1)), xlabel="Frequency, Hz",
             ylabel="Amplitude, m/s²")
    closer = "" if band == "whole" else ", closer"
    legend_above(axes, _name(report, g) + closer)
    about = ", ".join(f"{number(lines['amplitude'][i])} m/s² at "
                      f"{number(lines['frequency_Hz'][i], 5)} Hz" for i in _largest(lines, 3))
    return to_svg(figure, f"Spectrum of the sensor signal{closer}, {_name(report, g)}",
                  f"Largest lines without noise: {about}", page.names)


def _over_median(values):
    middle = median(values) or 1.0
    return [v / middle for v in values]


def tooth_rms(report, page):
    gearboxes = [g for g in report.data["examples"]["gearboxes"] if g["tooth_rms"]]
    level = report.data["examples"]["noise_level"]
    charts, columns, head = [], [], ["tooth"]
    ends = [end for g in gearboxes for part in ("clean", "noisy") if median(g["tooth_rms"][part]) > 0
            for end in _over_median(g["tooth_rms"][part])]
    lowest, highest = min([0.99, *ends]), max([1.02, *ends])
    for g in gearboxes:
        figure, axes = panel(2.7)
        for part, paint, line, label in (("noisy", NOISY, "none", f"with {noise(level)}"),
                                         ("clean", colour(0), "-", "without noise")):
            values = g["tooth_rms"][part]
            axes.plot(range(1, len(values) + 1), _over_median(values), color=paint, linestyle=line,
                      marker="o", markersize=3.4, linewidth=1, label=label)
            head.append(f"{_name(report, g)}, {label}, m/s²")
            columns.append(values)
        axes.set(ylim=(lowest - 0.06 * (highest - lowest), highest + 0.1 * (highest - lowest)),
                 xlabel="Tooth of the monitored gear", ylabel="RMS over median")
        legend_above(axes, _name(report, g))
        ratio = _over_median(g["tooth_rms"]["noisy"])
        charts.append(to_svg(
            figure, f"RMS of each tooth's signal, {_name(report, g)}",
            f"With {noise(level)} tooth {ratio.index(max(ratio)) + 1} has the largest, "
            f"{number(max(ratio), 4)} times the median", page.names))
    count = max((len(c) for c in columns), default=0)
    rows = [[str(i + 1)] + [number(c[i], 4) for c in columns] for i in range(count)]
    how = ("Windowing collects the sensor signal of each tooth, as in Liang (2016), Fig. 5.8. A "
           "faulty tooth stands out; window_ratio is the largest value over the median. Teeth "
           "are counted from the first window.")
    return page.figure("RMS of each tooth's signal", charts, how,
                       table("RMS of each tooth's signal", head, rows))


def _by_sensor(gearbox):
    """Names of the sensors, and spectrum and RMS per tooth of each."""
    return [("first", gearbox), *((one["name"], one) for one in gearbox["additional_sensors"])]


def sensors(report, page):
    """Order spectrum and RMS per tooth of every sensor; empty if there is only one."""
    gearboxes = [g for g in report.data["examples"]["gearboxes"] if g.get("additional_sensors")]
    level = report.data["examples"]["noise_level"]
    charts, rows = [], []
    for g in gearboxes:
        figure, axes = panel(2.7)
        largest = max(max(one["spectrum"]["whole"]["clean"]["amplitude"], default=0)
                      for _, one in _by_sensor(g)) or 1
        about = []
        for i, (name, one) in enumerate(_by_sensor(g)):
            lines = one["spectrum"]["whole"]["clean"]
            orders = [f * g["mesh_period_s"] for f in lines["frequency_Hz"]]
            axes.plot(orders, [max(v, 1e-7 * largest) for v in lines["amplitude"]],
                      color=colour(i), linewidth=0.8, label=name)
            top = max(range(len(orders)), key=lambda k: lines["amplitude"][k])
            about.append(f"{name} {number(lines['amplitude'][top])} m/s² at {number(orders[top], 5)}")
            ratio = _over_median(one["tooth_rms"]["noisy"])
            rows.append([_name(report, g), name, number(lines["amplitude"][top]),
                         number(orders[top], 5), str(ratio.index(max(ratio)) + 1),
                         number(max(ratio), 4)])
        axes.set(yscale="log", ylim=(1e-4 * largest, 2 * largest), xlim=(0, orders[-1]),
                 xlabel="Mesh orders", ylabel="Amplitude, m/s²")
        legend_above(axes, _name(report, g))
        charts.append(to_svg(figure, f"Order spectrum of every sensor, {_name(report, g)}",
                             "Largest lines without noise, in mesh orders: " + "; ".join(about),
                             page.names))
    for g in gearboxes:
        figure, axes = panel(2.7)
        for i, (name, one) in enumerate(_by_sensor(g)):
            ratio = _over_median(one["tooth_rms"]["noisy"])
            axes.plot(range(1, len(ratio) + 1), ratio, color=colour(i), marker=marker(i),
                      markersize=3.4, linewidth=1, label=name)
        axes.set(xlabel="Tooth of the monitored gear", ylabel="RMS over median")
        legend_above(axes, _name(report, g))
        charts.append(to_svg(figure, f"RMS of each tooth at every sensor, {_name(report, g)}",
                             f"With {noise(level)}, over the median tooth", page.names))
    how = (f"The same gearboxes at every sensor: order spectrum without noise, and RMS of each "
           f"tooth with {noise(level)}. Between the mesh orders lie the sidebands of carrier and "
           "planets.")
    return page.figure("Sensors", charts, how, table(
        "Largest line and worst tooth at every sensor",
        ["gearbox", "sensor", "largest line, m/s²", "at mesh order", "worst tooth",
         "RMS over median"], rows)) if gearboxes else ""


def gearbox_table(report):
    """Inputs and features of the example gearboxes."""
    gearboxes = report.data["examples"]["gearboxes"]
    level = report.data["examples"]["noise_level"]
    rows = []
    for i, given in enumerate(gearboxes[0]["inputs"]):
        rows.append([input_name(given["name"], given["unit"])]
                    + [quantity(g["inputs"][i]["value"], given["unit"], 4) for g in gearboxes])
    for i, feature in enumerate(gearboxes[0]["features"]):
        unit = report.unit(feature["name"])
        rows.append([f"{feature['name']} at {noise(level)}"]
                    + [quantity(g["features"][i]["value"], unit, 4) for g in gearboxes])
    return table("Inputs and features of the two gearboxes",
                 ["input or feature", *(_name(report, g) for g in gearboxes)], rows)


def stiffness(report, page):
    """Stiffness of healthy pairs over a mesh period, and of the faulty pair while its faulty tooth
    is engaged."""
    given = report.data["stiffness"]
    out, charts, rows = "", [], []
    figure, axes = panel(3.0)
    for i, pair in enumerate(_one_of_each_kind(given["pairs"])):
        axes.plot(given["mesh"], [v / 1e9 for v in pair["stiffness"]], color=colour(i),
                  linestyle=dash(i), label=pair["name"])
    for pair in given["pairs"]:
        values = pair["stiffness"]
        rows.append([pair["name"], number(min(values) / 1e9), number(sum(values) / len(values) / 1e9),
                     number(max(values) / 1e9)])
    axes.set(ylim=(0, None), xlim=(0, 1), xlabel="Mesh period", ylabel="Stiffness, GN/m")
    axes.set_title("healthy pairs", fontsize=10, loc="left")
    axes.legend(loc="lower right")
    charts.append(to_svg(figure, "Stiffness of healthy gear pairs over a mesh period",
                         "; ".join(f"{r[0]}: {r[1]} to {r[3]} GN/m" for r in rows), page.names))
    faults = []
    for passage in given["passages"]:
        chart, passage_rows = _passage(report, page, passage)
        charts.append(chart)
        faults += passage_rows
    how = ("A gear pair is stiff while two tooth pairs share the load and soft while one carries "
           "it. sp1 is the sun with planet 1, rp1 the ring with planet 1, m1 the pair of fixed "
           "shafts; pairs of one kind differ only in phase. " + (
               "While the faulty tooth is in mesh, its pair is softer, and more so for larger "
               "faults."
               if given["passages"] else "The study names no fault, so there is no faulty pair."))
    data = table("Healthy pairs, GN/m", ["pair", "smallest", "mean of the points", "largest"], rows)
    if faults:
        data += table("While the faulty tooth is in mesh, GN/m",
                      ["pair", "size", "smallest", "largest loss"], faults)
    return out + page.figure("Mesh stiffness", charts, how, data
                             + note("The drawn points are in the JSON, stiffness."))


def _one_of_each_kind(pairs):
    kinds = {}
    for pair in pairs:
        kinds.setdefault(pair["name"].rstrip("0123456789"), pair)
    return list(kinds.values())


def _passage(report, page, passage):
    figure, axes = panel(3.0)
    axes.plot(passage["mesh"], [v / 1e9 for v in passage["healthy"]], color=INK, linewidth=1.4,
              label="healthy")
    rows = []
    count = len(passage["faulty"])
    for i, curve in enumerate(passage["faulty"]):
        axes.plot(passage["mesh"], [v / 1e9 for v in curve["stiffness"]],
                  color=shade(i / max(1, count - 1)), linewidth=1.1,
                  label=report.sizes.text(curve["size"]))
        loss = max(1 - f / h if h > 0 else 0
                   for f, h in zip(curve["stiffness"], passage["healthy"]))
        rows.append([passage["pair"], report.sizes.text(curve["size"]),
                     number(min(curve["stiffness"]) / 1e9), f"{number(100 * loss)} %"])
    axes.set(ylim=(0, None), xlim=(passage["mesh"][0], passage["mesh"][-1]),
             xlabel="Mesh periods since the faulty tooth engaged", ylabel="Stiffness, GN/m")
    axes.set_title(f"{passage['pair']} with the faulty tooth", fontsize=10, loc="left")
    axes.legend(loc="lower right", ncol=2, fontsize=8, columnspacing=1, handlelength=1.5)
    about = "; ".join(f"{r[1]}: smallest {r[2]} GN/m, loses up to {r[3]}" for r in rows)
    return to_svg(figure, f"Stiffness of {passage['pair']} while the faulty tooth is in mesh",
                  about, page.names), rows


def same_bits(report):
    """Text that tells whether the gearboxes computed again have the features of the results
    file."""
    gearboxes = report.data["examples"]["gearboxes"]
    other = [str(g["row"]) for g in gearboxes if not g["same_bits"]]
    if other:
        return ("Computed again, the features of row " + " and ".join(other) +
                " differ from those in the results file: another version of the program made it, "
                "so the signals below are not exactly those of the results.")
    return ("The gearboxes were computed again from the study in the results file; their features "
            "have the same bits as those in it.")
