"""Charts as inline SVG drawn by matplotlib. Text stays text, colours follow the page's light or
dark scheme, and each chart has a name and a description for screen readers."""

import collections
import html
import io
import re
import warnings

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.colors import to_hex  # noqa: E402
from matplotlib.transforms import ScaledTranslation  # noqa: E402

# Distinguishable with any colour vision, and with a contrast of at least 3 : 1 to the page in
# either scheme; lines differ in their dashes as well. (light, dark)
SERIES = [("#0072b2", "#5cb8f0"), ("#c24e00", "#ff9b54"), ("#00795b", "#3fd0a4"),
          ("#a23f7d", "#f09ccb"), ("#806000", "#e3c14d"), ("#4b4fb8", "#a9adff"),
          ("#5b6066", "#b9bec5"), ("#9b2226", "#ff8f8f")]
DASHES = ["-", (0, (6, 1.5)), (0, (3, 1, 1.2, 1)), (0, (6, 1.5, 1.2, 1.5)), (0, (3, 1)),
          # No plain dots: reserved for rejected fits.
          (0, (8, 2, 2, 2, 2, 2)), (0, (12, 1.5, 3, 1.5)), (0, (10, 2))]
MARKERS = ["o", "s", "^", "D", "v", "P", "X", "*"]
INK, MUTED, RULE, PAPER, NOISY = "#1b1f23", "#59616a", "#c9ced4", "#ffffff", "#8f979f"
_SCHEME = {INK: "--ink", MUTED: "--muted", RULE: "--rule", PAPER: "--paper", NOISY: "--noisy"}
_SCHEME.update({light: f"--series-{i}" for i, (light, _) in enumerate(SERIES)})

# Glyphs missing in the font are drawn as boxes.
warnings.filterwarnings("ignore", message="Glyph")

LABELS = 30  # points from an axis to the text below its tick labels and axis label

# Colours from low to high noise. (light scheme, dark scheme)
LOW_NOISE = ((0.42, 0.68, 0.88), (0.65, 0.85, 1.0))
HIGH_NOISE = ((0.33, 0.07, 0.20), (0.90, 0.36, 0.47))
SHADES = 13

matplotlib.rcParams.update({
    "svg.fonttype": "none", "svg.hashsalt": "gearpod", "font.size": 10, "font.family": "DejaVu Sans",
    "axes.edgecolor": MUTED, "axes.labelcolor": INK, "text.color": INK, "xtick.color": MUTED,
    "ytick.color": MUTED, "xtick.labelcolor": INK, "ytick.labelcolor": INK, "axes.linewidth": 0.8,
    "axes.titlesize": 10, "axes.titlelocation": "left", "axes.spines.top": False,
    "axes.spines.right": False, "grid.color": RULE, "grid.linewidth": 0.6, "axes.grid": True,
    "axes.axisbelow": True, "legend.frameon": False,
    "legend.fontsize": 9, "figure.facecolor": "none", "axes.facecolor": "none",
    "savefig.facecolor": "none", "lines.linewidth": 1.7, "path.simplify": True,
    "path.simplify_threshold": 0.3, "axes.unicode_minus": True})


def colour(index):
    return SERIES[index % len(SERIES)][0]


def dash(index):
    """Dash pattern of a series; shifts by one each time the colours repeat."""
    return DASHES[(index + index // len(SERIES)) % len(DASHES)]


def marker(index):
    return MARKERS[(index + index // len(SERIES)) % len(MARKERS)]


def shade(share):
    """Colour between low noise (0) and high noise (1)."""
    return _SHADES[round(share * (SHADES - 1))][0]


def panel(height=3.2):
    """One chart, of a width that keeps its text readable on a phone."""
    return plt.subplots(figsize=(4.4, height), layout="tight")


# Line at a value that the numbers of a chart are compared with.
DASHED = {"color": MUTED, "linewidth": 0.9, "linestyle": (0, (4, 3))}
DOTTED = {"color": MUTED, "linewidth": 1.0, "linestyle": (0, (1, 2))}


def plot(axes, points, **options):
    """Draws points (x, y) with a line."""
    axes.plot([x for x, _ in points], [y for _, y in points], **options)


def marks(axes, points, kind, **options):
    """Draws points (x, y) as marks without a line."""
    plot(axes, points, linestyle="none", marker=kind, **options)


def names_of_rows(axes, names, **options):
    """Rows with names instead of numbers, the first one at the top."""
    axes.set_yticks(range(len(names)), names, **options)
    axes.set_ylim(len(names) - 0.5, -0.5)


def mark_size(axes, x, text, y):
    """Draws a vertical line from below to a probability of 0.9, and its size in words at the height y."""
    axes.plot([x, x], [-0.02, 0.9], color=INK, linewidth=1)
    axes.annotate(text, (x, y), xytext=(4, 0), textcoords="offset points", fontsize=9, color=INK,
                  bbox={"facecolor": PAPER, "edgecolor": "none", "pad": 1.2, "alpha": 0.85})


def open_end(axes, at, direction, paint):
    """Draws an arrow from a mark in the direction (right, up) in which its interval is open."""
    axes.annotate("", xy=at, xytext=(34 * direction[0], 34 * direction[1]),
                  textcoords="offset points", annotation_clip=False,
                  arrowprops={"arrowstyle": "<-", "color": paint, "linewidth": 1.6, "shrinkA": 0,
                              "shrinkB": 0})


def legend_below(axes, columns, **options):
    """Legend below the numbers and the name of the axis, extending to the left from the axes' right
    edge, because row labels leave more room there."""
    below = ScaledTranslation(0, -LABELS / 72, axes.figure.dpi_scale_trans)
    axes.legend(loc="upper right", bbox_to_anchor=(1.02, 0), ncol=columns,
                bbox_transform=axes.transAxes + below, **options)


def legend_above(axes, title, pad=16):
    """Legend above the axes, and the title above it."""
    axes.set_title(title, pad=pad)
    axes.legend(loc="lower right", bbox_to_anchor=(1.02, 0.98), ncol=2, borderpad=0,
                columnspacing=1, handlelength=1.6)


def between(low, high, share):
    """Colour from low (share 0) to high (1), as parts of red, green and blue."""
    return tuple(a + share * (b - a) for a, b in zip(low, high))


_SHADES = [tuple(to_hex(between(LOW_NOISE[i], HIGH_NOISE[i], step / (SHADES - 1))) for i in (0, 1))
           for step in range(SHADES)]
_SCHEME.update({light: f"--shade-{i}" for i, (light, _) in enumerate(_SHADES)})


class SvgNames:
    """Gives every chart of a page unique ids, in order. With a folder, also writes the charts
    there."""

    def __init__(self, folder=None):
        self.count = 0
        self.folder = folder
        self.used = collections.Counter()  # names of files

    def keep(self, figure, title):
        """Writes the chart on a white background to files such as pod-change_window_ratio-by-noise.svg,
        .png and .pdf."""
        if self.folder is None:
            return
        words = title.lower().replace("×", "x").replace("probability of detection", "pod")
        words = re.sub(r"[^a-z0-9_.]+", "-", re.sub(r"^pod (of|by) ", "pod ", words)).strip("-")
        self.used[words] += 1
        if self.used[words] > 1:
            words += f"-{self.used[words]}"
        for kind in ("svg", "png", "pdf"):
            # Replaces the file instead of overwriting it: an existing link might lead to another
            # file.
            path = self.folder / f"{words}.{kind}"
            new = path.with_suffix(f".{kind}.new")
            new.unlink(missing_ok=True)
            with open(new, "xb") as file:
                undated = {"svg": "Date", "png": "Software", "pdf": "CreationDate"}[kind]
                figure.savefig(file, format=kind, dpi=200, facecolor=PAPER, metadata={undated: None})
            new.replace(path)


def to_svg(figure, title, description, names):
    """Inline SVG of a matplotlib figure. Closes the figure."""
    names.count += 1
    name = f"chart{names.count}"
    names.keep(figure, title)
    buffer = io.StringIO()
    figure.savefig(buffer, format="svg", metadata={"Date": None, "Creator": None})
    plt.close(figure)
    head, body = re.search("<svg(.*?)>(.*)</svg>", buffer.getvalue(), re.S).groups()
    body = re.sub(r'<metadata>.*?</metadata>|<!--.*?-->|<style type="text/css">.*?</style>', "", body,
                  flags=re.S)
    body = re.sub(r' id="(?:figure|axes|patch|text|line2d|matplotlib|xtick|ytick|legend|Quad|Path|Poly'
                  r'|Line|Fill)[^"]*"', "", body)
    body = re.sub(r' id="([^"]+)"', rf' id="{name}-\1"', body)
    body = re.sub(r'xlink:href="#([^"]+)"', rf'href="#{name}-\1"', body)
    body = re.sub(r"url\(#([^)]+)\)", rf"url(#{name}-\1)", body)
    # Coordinates of paths with one decimal.
    body = re.sub(r' d="[^"]*"', lambda path: re.sub(
        r"-?\d+\.\d+", lambda n: f"{float(n[0]):.1f}".replace(".0", ""), path[0]), body)
    body = re.sub(r"font: ([\d.]+)px [^;\"]*", r"font-size: \1px", body)
    body = re.sub(r"font: (\w+) ([\d.]+)px [^;\"]*", r"font-weight: \1; font-size: \2px", body)
    for hexadecimal, variable in _SCHEME.items():
        body = body.replace(f": {hexadecimal}", f": var({variable}, {hexadecimal})")
    body = re.sub(r"\s*\n\s*", "\n", body)
    view = re.search(r'viewBox="([^"]+)"', head)[1]
    return (f'<svg viewBox="{view}" role="img" aria-labelledby="{name}-title {name}-about">'
            f'<title id="{name}-title">{html.escape(title)}</title>'
            f'<desc id="{name}-about">{html.escape(description)}</desc>{body}</svg>')


def scheme_css():
    """CSS of the colours of both schemes."""
    light, dark = ("".join(f"--{name}-{i}:{pair[scheme]};"
                           for name, pairs in (("series", SERIES), ("shade", _SHADES))
                           for i, pair in enumerate(pairs)) for scheme in (0, 1))
    return (f":root{{{light}}}\n"
            f"@media screen and (prefers-color-scheme: dark){{:root{{{dark}}}}}\n")
