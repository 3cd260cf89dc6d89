"""Page of gearpod modes: natural frequencies and the Campbell diagram."""

import blocks
from charts import INK, colour, dash, legend_below, marks, panel, to_svg
from words import number


def _diagram(data, page):
    campbell = data["campbell"]
    speeds, member = campbell["speeds"], campbell["member"]
    rpm = [abs(at["rpm"]) for at in speeds]
    lowest = min((at for at in data["frequencies_Hz"] if at > 0), default=1.0)
    highest = max(1.1 * campbell["harmonics"] * speeds[-1]["mesh_Hz"], 1.5 * lowest)
    figure, axes = panel(4.2)
    modes = zip(*(at["frequencies_Hz"] for at in speeds))
    for i, line in enumerate(line for line in modes if 0 < min(line) <= highest):
        axes.plot(rpm, line, color=colour(0), linewidth=1,
                  label="natural frequency" if i == 0 else None)
    for harmonic in range(1, campbell["harmonics"] + 1):
        axes.plot(rpm, [harmonic * at["mesh_Hz"] for at in speeds], color=colour(1),
                  linestyle=dash(1), linewidth=0.9,
                  label="mesh harmonics" if harmonic == 1 else None)
        axes.annotate(str(harmonic), (rpm[-1], harmonic * speeds[-1]["mesh_Hz"]), fontsize=8,
                      xytext=(2, 0), textcoords="offset points", va="center")
    critical = campbell["critical_speeds"]
    marks(axes, [(abs(one["rpm"]), one["frequency_Hz"]) for one in critical], "o", markersize=4, color=INK,
          label="critical speed")
    axes.axvline(abs(campbell["nominal_rpm"]), color=INK, linestyle=":", linewidth=0.9,
                 label="nominal speed")
    axes.set(xlim=(0, rpm[-1]), ylim=(0, highest), xlabel=f"Speed of the {member}, rpm",
             ylabel="Frequency, Hz")
    legend_below(axes, 2)
    rows = [[number(one["rpm"], 5), number(one["rpm"] / campbell["nominal_rpm"], 4),
             str(one["harmonic"]), number(one["frequency_Hz"], 5), str(one["modes"])]
            for one in critical]
    how = ("Undamped natural frequencies at the mean mesh stiffness, as seen in the frame that turns "
           "with the carrier, and the mesh harmonics. With inertial terms (effects.inertial_terms) "
           "modes of translation split with speed. A mode at a critical speed is excited by that "
           "harmonic if its shape takes part in the mesh.")
    chart = to_svg(figure, "Campbell diagram",
                   f"{len(critical)} critical speeds up to {number(rpm[-1], 4)} rpm", page.names)
    return page.figure("Campbell diagram", [chart], how, blocks.table(
        "Critical speeds", ["rpm", "of nominal", "mesh harmonic", "Hz", "modes"], rows))


def parts(data, page):
    """Title, sentence, HTML of the answer, HTML of the sections."""
    frequencies = [at for at in data["frequencies_Hz"] if at > 0]
    sentence = (f"{len(frequencies)} natural frequencies from {number(min(frequencies), 4)} to "
                f"{number(max(frequencies), 4)} Hz")
    if data["campbell"]:
        nominal = abs(data["campbell"]["nominal_rpm"])
        nearest = min(data["campbell"]["critical_speeds"], key=lambda one: abs(abs(one["rpm"]) - nominal), default=None)
        sentence += (f"; the critical speed nearest to the nominal {number(nominal, 4)} rpm is "
                     f"{number(abs(nearest['rpm']), 4)} rpm (mesh harmonic {nearest['harmonic']})."
                     if nearest else "; no mesh harmonic meets one in the speed range.")
    else:
        sentence += ". Without tooth numbers there is no mesh frequency."
    body = _diagram(data, page) if data["campbell"] else ""
    at_rest = blocks.paragraph(f"At rest: {', '.join(number(at, 5) for at in data['frequencies_Hz'])} Hz.")
    return (data["title"], sentence, blocks.paragraph(sentence),
            page.section("modes", "Natural frequencies and speed", body + at_rest))
