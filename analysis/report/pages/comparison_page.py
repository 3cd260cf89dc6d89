"""Page of gearpod compare: effect of a change on detection."""

import blocks
from charts import DASHED, colour, marker, names_of_rows, open_end, panel, to_svg
from report import Findings
from words import Sizes, with_unit


def letter(file):
    return chr(ord("A") + file) if file < 26 else f"#{file + 1}"


class Compared(Findings):
    def __init__(self, data):
        super().__init__(data)
        self.sizes = Sizes(data["size"])
        self.files = data["files"]

    def shown(self, file):
        """Features of a file at the noise level shown."""
        return [f for f in self.files[file]["features"]
                if f["noise_level"] == self.data["noise_level"]]

    def title(self):
        return "Comparison: " + " against ".join(map(letter, reversed(range(len(self.files)))))


def _forest(compared, page, key, axis, scale):
    """Forest plot: a mark with its interval per feature and file."""
    entries = [(k, f["name"], f[key]) for k in range(1, len(compared.files))
               for f in compared.shown(k)]
    texts = [row[4] for row in compared.rows(key)[1]]
    drawn = [(*entry, text) for entry, text in zip(entries, texts)
             if entry[2]["difference"] is not None]
    title, data = compared.heading(key), compared.table(key)
    if not drawn:
        return data
    figure, axes = panel(1.0 + 0.3 * len(drawn))
    axes.axvline(0.0, **DASHED)
    for y, (k, _, entry, _) in enumerate(drawn):
        at, ends = scale * entry["difference"], (entry["lower"], entry["upper"])
        axes.plot([at if end is None else scale * end for end in ends], [y, y], color=colour(k), linewidth=1.6)
        for end, direction in zip(ends, (-1, 1)):
            if end is None:
                open_end(axes, (at, y), (direction, 0), colour(k))
        axes.plot([at], [y], marker=marker(k), color=colour(k), markersize=5.5, markeredgewidth=0)
    names_of_rows(axes, [name if len(compared.files) == 2 else f"{name}, {letter(k)}"
                         for k, name, _, _ in drawn])
    axes.set(xlabel=axis)
    axes.margins(x=0.15)
    axes.grid(axis="y", visible=False)
    svg = to_svg(figure, title, "; ".join(f"{name}, {letter(k)}: {text}"
                                          for k, name, _, text in drawn), page.names)
    return page.figure(title, [svg], "Each file's value minus A's, with its interval; right of the "
                                     "dashed line it is larger than A's. An arrow: the interval is "
                                     "open on this side.", data)


def _rates(compared, page, k):
    charts = []
    for feature in compared.shown(k):
        sizes = [s for s in feature["sizes"] if s["size_high"] > 0 and s["difference"] is not None]
        if not sizes or feature["same"]:
            continue
        figure, axes = panel()
        axes.axhline(0.0, **DASHED)
        x = [compared.sizes.shown(0.5 * (s["size_low"] + s["size_high"])) for s in sizes]
        lower, middle, upper = ([s[end] for s in sizes] for end in ("lower", "difference", "upper"))
        axes.vlines(x, lower, upper, color=colour(k), linewidth=1.4)
        axes.plot(x, middle, linestyle="none", marker="o", markersize=4.5, markeredgewidth=0, color=colour(k))
        reach = 1.05 * max(0.05, *map(abs, lower + upper))
        axes.set(ylim=(-reach, reach), xlabel=compared.sizes.axis(), title=feature["name"],
                 ylabel=f"Detection rate, {letter(k)} minus A")
        charts.append(to_svg(figure, f"{feature['name']}: detection rate, {letter(k)} minus A",
                             "; ".join(f"{compared.sizes.group(s['size_low'], s['size_high'])}: "
                                       f"{s['difference']:+.3f}" for s in sizes), page.names))
    if not charts:
        return ""
    return page.figure(f"Detection rates, {letter(k)} minus A", charts,
                       "Difference of the share found, by fault size, with its interval. Above the "
                       "dashed line more are found than in A.", compared.tables(f"rates.{k}."))


def parts(data, page):
    """Title, headline sentence, HTML of the answer, HTML of the sections."""
    compared = Compared(data)
    verdict = (blocks.answer(compared.text("headline")) + compared.notes("shortage.") + compared.table("files")
               + "".join(map(blocks.small, compared.texts("first_records"))))
    body = page.section(
        "sizes", "Sizes and areas",
        _forest(compared, page, "a90", with_unit("Difference of a90", compared.sizes.unit, ", "),
                compared.sizes.factor)
        + _forest(compared, page, "auc", "Difference of the area", 1.0))
    for k in range(1, len(compared.files)):
        body += page.section(f"file-{k}", f"{letter(k)} against A",
                             blocks.bullets(compared.texts(f"about.{k}."))
                             + _rates(compared, page, k) + compared.notes(f"refusal.{k}.")
                             + compared.table(f"levels.{k}"))
    body += compared.notes("terms")
    return compared.title(), compared.text("headline"), verdict, body
