"""Page of gearpod compare: effect of a change on detection."""

import blocks
from charts import INK, MUTED, colour, marker, panel, to_svg
from words import Sizes, count, escape, noise, number, p_value, percent, rate


def letter(file):
    return chr(ord("A") + file) if file < 26 else f"#{file + 1}"


class Compared:
    def __init__(self, data):
        self.data = data
        self.sizes = Sizes(data["size"])
        self.level = data["noise_level"]
        self.files = data["files"]

    def shown(self, file):
        """Features of a file at the noise level shown."""
        return [f for f in self.files[file]["features"] if f["noise_level"] == self.level]

    def names(self):
        return list(dict.fromkeys(f["name"] for k in range(1, len(self.files))
                                  for f in self.shown(k)))

    def smallest(self, file):
        for at in self.files[file]["smallest_faults"]:
            if at["noise_level"] == self.level:
                return at["fault"]
        return None

    def nothing_found(self, file):
        """Text for a file without a smallest fault."""
        unknown = any(at["noise_level"] == self.level and at["without_threshold"]
                      for at in self.files[file]["smallest_faults"])
        return "no threshold" if unknown else "no tested size"

    def shortages(self):
        """Shortages of the files' healthy samples, each with the letter of its file."""
        return [f"{letter(k)}: {f['shortage']}" for k, f in enumerate(self.files)
                if f["shortage"]]

    def sentence(self):
        parts = []
        for k in range(len(self.files)):
            found = self.smallest(k)
            parts.append(f"{letter(k)}: " + (f"{self.sizes.text(found['size'])} by "
                                             f"{found['feature']}" if found else self.nothing_found(k)))
        return (f"Smallest fault found with 90\u00a0% probability at "
                f"{percent(self.data['confidence'])} confidence, {noise(self.level)}: "
                + "; ".join(parts) + ".")


def _fixed(value):
    return f"{round(value, 3) + 0.0:.3f}"  # no -0.000


def _signed(value, text):
    return "–" if value is None else ("+" if value >= 0 else "") + text(value)


def _difference(entry, text):
    if entry["difference"] is None:
        return "–"
    bounds = (text(v) if v is not None else "open" for v in (entry["lower"], entry["upper"]))
    return f"{_signed(entry['difference'], text)} [{', '.join(bounds)}]"


def _forest(compared, page, key, title, axis, scale):
    """Forest plot: a mark with its interval per feature and file."""
    rows = [(name, k, next((f for f in compared.shown(k) if f["name"] == name), None))
            for name in compared.names() for k in range(1, len(compared.files))]
    rows = [(name, k, f[key]) for name, k, f in rows if f]
    drawn = [r for r in rows if r[2]["difference"] is not None]
    data = blocks.table(title, ["feature", "file", "A", "file's", "difference", "p"],
                        [[name, letter(k), *(number(v * scale) if v is not None else "–"
                                             for v in entry["values"]),
                          _difference(entry, lambda v: number(v * scale)),
                          p_value(entry["p_value"])] for name, k, entry in rows])
    if not drawn:
        return blocks.note(f"{title}: " + "; ".join(
            f"{name} ({letter(k)}): {entry['refusal']}" for name, k, entry in rows)) + data
    figure, axes = panel(1.0 + 0.3 * len(drawn))
    axes.axvline(0.0, color=MUTED, linewidth=0.9, linestyle=(0, (4, 3)))
    for y, (name, k, entry) in enumerate(drawn):
        at = scale * entry["difference"]
        ends = [scale * v if v is not None else at for v in (entry["lower"], entry["upper"])]
        axes.plot(ends, [y, y], color=colour(k), linewidth=1.6)
        axes.plot([at], [y], marker=marker(k), color=colour(k), markersize=5.5, markeredgewidth=0)
    axes.set_yticks(range(len(drawn)), [name if len(compared.files) == 2 else
                                        f"{name}, {letter(k)}" for name, k, _ in drawn])
    axes.set_ylim(len(drawn) - 0.5, -0.5)
    axes.grid(axis="y", visible=False)
    axes.set_xlabel(axis)
    svg = to_svg(figure, title, "; ".join(
        f"{name}, {letter(k)}: {_difference(e, lambda v: number(v * scale))}"
        for name, k, e in drawn), page.names)
    return page.figure(title, [svg], "Each file's value minus A's, with its interval at "
                                     f"{percent(compared.data['confidence'])}; right of the "
                                     "dashed line it is larger than A's. An open end is drawn at "
                                     "the mark.", data)


def _rates(compared, page, k):
    charts, tables = [], []
    for feature in compared.shown(k):
        sizes = [s for s in feature["sizes"] if s["size_high"] > 0 and s["difference"] is not None]
        if not sizes or feature["same"]:
            continue
        figure, axes = panel()
        axes.axhline(0.0, color=MUTED, linewidth=0.9, linestyle=(0, (4, 3)))
        x = [compared.sizes.shown(0.5 * (s["size_low"] + s["size_high"])) for s in sizes]
        y = [s["difference"] for s in sizes]
        axes.vlines(x, [s["lower"] for s in sizes], [s["upper"] for s in sizes], color=colour(k),
                    linewidth=1.4)
        axes.plot(x, y, linestyle="none", marker="o", markersize=4.5, markeredgewidth=0,
                  color=colour(k))
        reach = max(0.05, *(abs(v) for s in sizes for v in (s["lower"], s["upper"])))
        axes.set_ylim(-1.05 * reach, 1.05 * reach)
        axes.set_xlabel(compared.sizes.axis())
        axes.set_ylabel(f"Detection rate, {letter(k)} minus A")
        axes.set_title(feature["name"], fontsize=10, color=INK, loc="left")
        charts.append(to_svg(figure, f"{feature['name']}: detection rate, {letter(k)} minus A",
                             "; ".join(f"{compared.sizes.group(s['size_low'], s['size_high'])}: "
                                       f"{s['difference']:+.3f}" for s in sizes), page.names))
        rows = [[compared.sizes.group(s["size_low"], s["size_high"]), *map(count, s["tested"]),
                 *map(rate, s["pd"]), _difference(s, _fixed), *(map(count, s["only"]) if s["only"] else "––"),
                 p_value(s["p_value"])] for s in feature["sizes"]]
        tables.append(blocks.table(feature["name"],
                                   ["size", "tested A", f"tested {letter(k)}", "Pd A",
                                    f"Pd {letter(k)}", "difference", "only A found",
                                    f"only {letter(k)} found", "p"], rows))
    if not charts:
        return ""
    return page.figure(f"Detection rates, {letter(k)} minus A, at {noise(compared.level)}", charts,
                       "Difference of the share found, by fault size, with its interval. Above the "
                       "dashed line more are found than in A.", "".join(tables))


def _about(compared, k):
    file = compared.files[k]
    if file["unpaired"]:
        texts = [f"Different gearboxes ({file['unpaired']}), compared as independent samples."]
    else:
        texts = [f"On {count(file['pairs'])} graded gearboxes that are the same in both: the "
                 "differences are taken gearbox by gearbox."]
    same = [f["name"] for f in compared.shown(k) if f["same"]]
    if same:
        texts.append(f"The same in every gearbox: {', '.join(same)}.")
    texts += [f"Input {line}." for line in file["differing_inputs"]]
    texts += [f"Not compared: {line}." for line in file["left_out"]]
    return blocks.bullets(texts)


def _other_levels(compared, k):
    rows = [[f["name"], f"× {number(f['noise_level'])}",
             _difference(f["a90"], lambda v: number(compared.sizes.shown(v))),
             _difference(f["auc"], _fixed), p_value(f["auc"]["p_value"])]
            for f in compared.files[k]["features"]]
    unit = f", {compared.sizes.unit}" if compared.sizes.unit else ""
    return blocks.table(f"All noise levels: {letter(k)} minus A",
                        ["feature", "noise", f"a90{unit}", "AUC", "p"], rows)


def parts(data, page):
    """Title, headline sentence, HTML of the answer, HTML of the sections."""
    compared = Compared(data)
    verdict = "".join(f'<p class="answer">{escape(text)}</p>'
                     for text in [*compared.shortages(), compared.sentence()])
    verdict += blocks.table("Files", ["", "file", "study", "gearboxes"],
                           [[letter(k), f["path"], f["title"], count(f["gearboxes"])]
                            for k, f in enumerate(compared.files)])
    if data.get("first_records"):
        verdict += ('<p class="small">The differences use thresholds set by the first record of '
                   "each healthy gearbox; the smallest faults use all records.</p>")
    unit = f", {compared.sizes.unit}" if compared.sizes.unit else ""
    body = page.section("sizes", "Sizes and areas", _forest(
        compared, page, "a90", f"Difference of a90 at {noise(compared.level)}",
        f"Difference of a90{unit}", compared.sizes.factor) + _forest(
        compared, page, "auc", f"Difference of the area under the ROC at {noise(compared.level)}",
        "Difference of the area", 1.0))
    for k in range(1, len(compared.files)):
        body += page.section(f"file-{k}", f"{letter(k)} against A",
                             _about(compared, k) + _rates(compared, page, k)
                             + _other_levels(compared, k))
    title = " against ".join(letter(k) for k in range(len(compared.files) - 1, -1, -1))
    return f"Comparison: {title}", compared.sentence(), verdict, body
