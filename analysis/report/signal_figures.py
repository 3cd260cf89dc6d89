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


def _gearboxes(report, key):
    """Example gearboxes that have the signal."""
    return [g for g in report.data["examples"]["gearboxes"] if g.get(key)]


def _noise(report):
    return "with " + noise(report.data["examples"]["noise_level"])


def _parts(report):
    """Key, colour and label of a signal with and without noise."""
    return ("noisy", NOISY, _noise(report)), ("clean", colour(0), "without noise")


def _drawn(key):
    return note(f"The drawn points are in the JSON, {key}.")


def _time_charts(report, page, key, scale, axis, what, how):
    """Figure with one chart per gearbox, all with the same scale."""
    gearboxes = _gearboxes(report, key)
    unit = axis.rsplit(", ", 1)[-1]
    largest = 1.05 * scale * max(abs(v) for g in gearboxes for part in ("clean", "noisy")
                                 for v in g[key][part]["value"]) or 1
    charts, rows = [], []
    for g in gearboxes:
        figure, axes = panel(2.7)
        mesh, clean = g[key]["clean"]["mesh"], [scale * v for v in g[key]["clean"]["value"]]
        turn = round(mesh[-1] + 0.5) if mesh else 1
        for span in g["engagements"]:
            if span["from"] < turn:
                axes.axvspan(span["from"], min(span["to"], turn), color=colour(1), alpha=0.16,
                             linewidth=0)
        for (part, paint, label), width in zip(_parts(report), (0.6, 0.9)):
            axes.plot(g[key][part]["mesh"], [scale * v for v in g[key][part]["value"]],
                      color=paint, linewidth=width, label=label)
        axes.set(xlim=(0, turn), ylim=(-largest, largest),
                 xlabel="Mesh periods of one turn of the monitored gear", ylabel=axis)
        legend_above(axes, _name(report, g))
        at = max(range(len(clean)), key=lambda i: abs(clean[i]))
        engaged = "; ".join(f"{s['pair']} {number(s['from'])} to {number(s['to'])}"
                            for s in g["engagements"]) or "none"
        rows.append([_name(report, g), number(min(clean)), number(max(clean)), number(mesh[at]),
                     engaged, quantity(1e3 * g["mesh_period_s"], "ms")])
        charts.append(to_svg(figure, f"{what} over one turn, {_name(report, g)}",
                             f"largest {number(clean[at])} {unit} at mesh {number(mesh[at])}; "
                             f"faulty tooth engaged: {engaged}", page.names))
    return page.figure(what, charts, how, table(
        f"{what} over one turn, without noise ({unit})",
        ["gearbox", "smallest", "largest", "largest deviation at mesh",
         "faulty tooth engaged at meshes", "mesh period"], rows) + _drawn("examples.gearboxes." + key))


def sensor(report, page):
    return _time_charts(
        report, page, "sensor", 1.0, "Acceleration, m/s²", "Sensor signal",
        "Sensor signal after its low-pass filter over one turn of the monitored gear. Shaded: the "
        "faulty tooth is in mesh. Long signals are drawn by the smallest and largest value of each "
        "interval, so no peak is lost.")


def contact_loss(report):
    """Table of the contact loss ratio of every mesh; empty where teeth cannot separate."""
    table_ = report.table("contact_loss")
    return "<h3>Contact of the teeth</h3>" + paragraph(report.text("contact.how")) + table_ if table_ else ""


def transmission_error(report, page):
    return _time_charts(
        report, page, "te", 1e6, "Transmission error, µrad", "Transmission error",
        "Averaged transmission error over one turn of the monitored gear, mean removed, as in Park "
        "et al. (2016), Fig. 11. Shaded: the faulty tooth is in mesh; a large fault makes it differ "
        "from its neighbours.")


def spectrum(report, page):
    gearboxes = _gearboxes(report, "spectrum")
    largest = max(max(g["spectrum"]["whole"][part]["amplitude"], default=0) for g in gearboxes
                  for part in ("clean", "noisy")) or 1
    charts = [_spectrum_chart(report, page, g, band, largest) for band in ("whole", "zoom")
              for g in gearboxes]
    tables = ""
    for g in gearboxes:
        lines = g["spectrum"]["zoom"]["clean"]
        tables += table(
            f"Largest lines without noise around the largest of all, {_name(report, g)}",
            ["frequency, Hz", "mesh frequencies", "amplitude, m/s²"],
            [[number(lines["frequency_Hz"][i], 5),
              number(lines["frequency_Hz"][i] * g["mesh_period_s"], 5),
              number(lines["amplitude"][i])] for i in sorted(_largest(lines, 12))])
    how = ("One-sided amplitudes over the whole windowing span, in which every tooth of the "
           "monitored gear meets every tooth of its mate; of dense lines the largest of each "
           "interval is drawn. The second row is enlarged around each gearbox's largest line: "
           "sidebands between the lines of the healthy gearbox indicate a fault. The scale is "
           "logarithmic.")
    return page.figure("Spectrum of the sensor signal", charts, how,
                       tables + _drawn("examples.gearboxes.spectrum"))


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
    for g in _gearboxes(report, "spectrogram"):
        found = levels_over_time(g["spectrogram"])
        if found is None:
            continue
        levels, times, mesh_Hz, lines = found
        figure, axes = panel(3.2)
        image = axes.imshow(levels.T, origin="lower", aspect="auto", cmap="viridis",
                            interpolation="nearest", extent=(times[0], times[-1], lines[0], lines[-1]))
        figure.colorbar(image, ax=axes, label="dB of the largest line")
        for order in range(1, int(lines[-1] / max(mesh_Hz)) + 1):
            axes.plot(times, order * mesh_Hz, color="white", linewidth=0.5, linestyle=(0, (1, 3)))
        axes.set(ylim=(lines[0], lines[-1]), xlabel="Time, s", ylabel="Frequency, Hz",
                 title=_name(report, g))
        axes.grid(False)
        slowest, fastest = number(min(mesh_Hz), 4), number(max(mesh_Hz), 4)
        rows.append([_name(report, g), slowest, fastest, number(times[-1] - times[0])])
        charts.append(to_svg(figure, f"Spectrogram of the sensor signal, {_name(report, g)}",
                             f"Mesh frequency {slowest} to {fastest} Hz", page.names))
    how = ("Level of the sensor signal without noise in windows of eight mesh periods, one per "
           "mesh period. Dotted: harmonics of the mesh frequency at that time. Lines that follow "
           "them come from the gears, level lines from resonances or the rest of the machine.")
    return page.figure("Spectrogram of the sensor signal", charts, how, table(
        "Mesh frequency in the spectrogram", ["gearbox", "lowest, Hz", "highest, Hz", "time, s"],
        rows)) if charts else ""


def _largest(lines, count):
    return sorted(range(len(lines["amplitude"])), key=lambda i: -lines["amplitude"][i])[:count]


def _line_text(lines, i, at, unit=""):
    return f"{number(lines['amplitude'][i])} m/s² at {number(at, 5)}{unit}"


def _spectrum_chart(report, page, g, band, largest):
    figure, axes = panel(2.7)
    for part, paint, label in _parts(report):
        lines = g["spectrum"][band][part]
        axes.plot(lines["frequency_Hz"], [max(v, 1e-7 * largest) for v in lines["amplitude"]],
                  color=paint, linewidth=0.8, label=label)
    frequencies = lines["frequency_Hz"]
    axes.set(yscale="log", ylim=(1e-5 * largest, 2 * largest),
             xlim=(0 if band == "whole" else min(frequencies, default=0),
                   max(frequencies, default=1)), xlabel="Frequency, Hz", ylabel="Amplitude, m/s²")
    closer = "" if band == "whole" else ", closer"
    legend_above(axes, _name(report, g) + closer)
    about = ", ".join(_line_text(lines, i, frequencies[i], " Hz") for i in _largest(lines, 3))
    return to_svg(figure, f"Spectrum of the sensor signal{closer}, {_name(report, g)}",
                  f"Largest lines without noise: {about}", page.names)


def _over_median(values):
    middle = median(values) or 1.0
    return [v / middle for v in values]


def _worst_tooth(values):
    """Number of the tooth with the largest RMS, and its ratio to the median."""
    ratio = _over_median(values)
    return str(ratio.index(max(ratio)) + 1), number(max(ratio), 4)


def _draw_teeth(axes, ratio, **options):
    """Draws the RMS of each tooth over that of the median tooth."""
    axes.plot(range(1, len(ratio) + 1), ratio, markersize=3.4, linewidth=1, **options)
    axes.set(xlabel="Tooth of the monitored gear", ylabel="RMS over median")


def tooth_rms(report, page):
    gearboxes = _gearboxes(report, "tooth_rms")
    charts, columns, head = [], [], ["tooth"]
    ends = [end for g in gearboxes for part in ("clean", "noisy") if median(g["tooth_rms"][part]) > 0
            for end in _over_median(g["tooth_rms"][part])]
    lowest, highest = min([0.99, *ends]), max([1.02, *ends])
    for g in gearboxes:
        figure, axes = panel(2.7)
        for (part, paint, label), line in zip(_parts(report), ("none", "-")):
            _draw_teeth(axes, _over_median(g["tooth_rms"][part]), color=paint, linestyle=line,
                        marker="o", label=label)
            head.append(f"{_name(report, g)}, {label}, m/s²")
            columns.append([number(v, 4) for v in g["tooth_rms"][part]])
        axes.set(ylim=(lowest - 0.06 * (highest - lowest), highest + 0.1 * (highest - lowest)))
        legend_above(axes, _name(report, g))
        tooth, ratio = _worst_tooth(g["tooth_rms"]["noisy"])
        charts.append(to_svg(
            figure, f"RMS of each tooth's signal, {_name(report, g)}",
            f"{_noise(report).capitalize()} tooth {tooth} has the largest, {ratio} times the median",
            page.names))
    rows = [[str(tooth), *row] for tooth, row in enumerate(zip(*columns), 1)]
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
    gearboxes = _gearboxes(report, "additional_sensors")
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
            top, = _largest(lines, 1)
            about.append(f"{name} {_line_text(lines, top, orders[top])}")
            rows.append([_name(report, g), name, number(lines["amplitude"][top]),
                         number(orders[top], 5), *_worst_tooth(one["tooth_rms"]["noisy"])])
        axes.set(yscale="log", ylim=(1e-4 * largest, 2 * largest), xlim=(0, orders[-1]),
                 xlabel="Mesh orders", ylabel="Amplitude, m/s²")
        legend_above(axes, _name(report, g))
        charts.append(to_svg(figure, f"Order spectrum of every sensor, {_name(report, g)}",
                             "Largest lines without noise, in mesh orders: " + "; ".join(about),
                             page.names))
    for g in gearboxes:
        figure, axes = panel(2.7)
        for i, (name, one) in enumerate(_by_sensor(g)):
            _draw_teeth(axes, _over_median(one["tooth_rms"]["noisy"]), color=colour(i),
                        marker=marker(i), label=name)
        legend_above(axes, _name(report, g))
        charts.append(to_svg(figure, f"RMS of each tooth at every sensor, {_name(report, g)}",
                             f"{_noise(report).capitalize()}, over the median tooth", page.names))
    how = ("The same gearboxes at every sensor: order spectrum without noise, and RMS of each "
           f"tooth {_noise(report)}. Between the mesh orders lie the sidebands of carrier and "
           "planets.")
    return page.figure("Sensors", charts, how, table(
        "Largest line and worst tooth at every sensor",
        ["gearbox", "sensor", "largest line, m/s²", "at mesh order", "worst tooth",
         "RMS over median"], rows)) if gearboxes else ""


def gearbox_table(report):
    """Inputs and features of the example gearboxes."""
    gearboxes = report.data["examples"]["gearboxes"]
    level = report.data["examples"]["noise_level"]
    first = gearboxes[0]
    named = [(input_name(one["name"], one["unit"]), one["unit"]) for one in first["inputs"]]
    named += [(f"{one['name']} at {noise(level)}", report.unit(one["name"]))
              for one in first["features"]]
    values = zip(*(g["inputs"] + g["features"] for g in gearboxes))
    return table("Inputs and features of the two gearboxes",
                 ["input or feature", *(_name(report, g) for g in gearboxes)],
                 [[name, *(quantity(one["value"], unit, 4) for one in row)]
                  for (name, unit), row in zip(named, values)])


def _giga(values):
    return [v / 1e9 for v in values]


def stiffness(report, page):
    """Stiffness of healthy pairs over a mesh period, and of the faulty pair while its faulty tooth
    is engaged."""
    given = report.data["stiffness"]
    kinds, rows, faults = {}, [], []
    for pair in given["pairs"]:
        values = _giga(pair["stiffness"])
        kinds.setdefault(pair["name"].rstrip("0123456789"), (pair["name"], values))
        rows.append([pair["name"], number(min(values)), number(sum(values) / len(values)),
                     number(max(values))])
    figure, axes = panel(3.0)
    for i, (name, values) in enumerate(kinds.values()):
        axes.plot(given["mesh"], values, color=colour(i), linestyle=dash(i), label=name)
    axes.set(ylim=(0, None), xlim=(0, 1), xlabel="Mesh period", ylabel="Stiffness, GN/m",
             title="healthy pairs")
    axes.legend(loc="lower right")
    charts = [to_svg(figure, "Stiffness of healthy gear pairs over a mesh period",
                     "; ".join(f"{r[0]}: {r[1]} to {r[3]} GN/m" for r in rows), page.names)]
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
    return page.figure("Mesh stiffness", charts, how, data + _drawn("stiffness"))


def _passage(report, page, passage):
    figure, axes = panel(3.0)
    healthy = _giga(passage["healthy"])
    axes.plot(passage["mesh"], healthy, color=INK, linewidth=1.4, label="healthy")
    rows = []
    for i, curve in enumerate(passage["faulty"]):
        size, values = report.sizes.text(curve["size"]), _giga(curve["stiffness"])
        axes.plot(passage["mesh"], values, color=shade(i / max(1, len(passage["faulty"]) - 1)),
                  linewidth=1.1, label=size)
        loss = max(1 - f / h if h > 0 else 0 for f, h in zip(values, healthy))
        rows.append([passage["pair"], size, number(min(values)), f"{number(100 * loss)} %"])
    axes.set(ylim=(0, None), xlim=(passage["mesh"][0], passage["mesh"][-1]),
             xlabel="Mesh periods since the faulty tooth engaged", ylabel="Stiffness, GN/m",
             title=f"{passage['pair']} with the faulty tooth")
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
