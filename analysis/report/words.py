"""Numbers, units and names as shown on the page."""

import html
import math
import re


def escape(text):
    return html.escape(str(text))


def printable(text):
    """Text without control characters."""
    return "".join(c if c.isprintable() else " " if c in "\n\t\r" else "?" for c in text)


def _trimmed(text):
    """Text of a number without zeros at its end, with a minus sign."""
    return re.sub(r"\.?0+$", "", text).replace("-", "−") if "." in text else text.replace("-", "−")


def number(value, digits=3):
    """Number with significant digits and a complete integer part; with an exponent only where that
    is shorter."""
    if value is None or not math.isfinite(value):
        return "–"
    if value == 0:
        return "0"
    size = math.floor(math.log10(abs(value)))
    if -4 <= size < 6:
        decimals = max(0, digits - 1 - size)
        return _trimmed(f"{value:.{decimals}f}")
    mantissa, exponent = f"{value:.{digits - 1}e}".split("e")
    return f"{_trimmed(mantissa)} × 10{superscript(int(exponent))}"


def typeset(text):
    """Plain text of a finding with typographic signs: x 1, -3, 2e-06 m/s^2, +-0.1, 90 %."""
    text = re.sub(r"(\d)e([+-]\d+)", lambda m: f"{m[1]} × 10{superscript(int(m[2]))}", text)
    text = re.sub(r"\bx (?=\d)", "×\u00a0", text)
    text = re.sub(r"(?<![\w.-])-(?=\d)", "−", text.replace("+-", "±"))
    text = re.sub(r"(?<=\d) (?=(?:%|mm|m/s\^2|N/m|Hz)(?![\w]))", "\u00a0", text)
    text = text.replace("m/s^2", "m/s²").replace("kg m^2", "kg m²")
    return "–" if text == "-" else text


def superscript(integer):
    return str(integer).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))


def rate(value):
    """Probability with two decimals, more next to 0 and 1."""
    if value is None or not math.isfinite(value):
        return "–"
    if 0 < value < 5e-5:
        return "< 0.0001"
    if 0.99995 < value < 1:
        return "> 0.9999"
    if 0 < value < 0.005 or 0.995 < value < 1:
        return f"{value:.4f}".rstrip("0")
    text = f"{value:.2f}"
    return "0.00" if text == "-0.00" else text.replace("-", "−")


def rate_with_bounds(value, lower, upper):
    if value is None:
        return "–"
    if lower is None or upper is None:
        return rate(value)
    return f"{rate(value)} [{rate(lower)}, {rate(upper)}]"


def percent(value):
    return f"{number(100 * value, 6 if 0.9995 <= value < 1 else 3)}\u00a0%"


def count(value):
    """Integer with thin spaces between thousands."""
    return f"{value:,}".replace(",", "\u202f")


def joined(texts):
    """Enumeration: "a", "a and b", "a, b and c"."""
    texts = list(texts)
    if len(texts) < 2:
        return "".join(texts)
    return ", ".join(texts[:-1]) + " and " + texts[-1]


def noise(level):
    return f"noise ×\u00a0{number(level)}"


def input_name(name, unit):
    """Name of an input without its unit: planet_bearing_stiffness_N_m gives planet bearing
    stiffness."""
    if name == "noise_m_s2":
        return "sensor noise"
    suffix = re.sub("[/ ]", "_", unit.replace("/sqrt(Hz)", "_per_sqrt_Hz")).replace("^", "")
    return (name if unit in ("", "1") else name.removesuffix("_" + suffix)).replace("_", " ")


def unit_text(unit):
    return {"order": "", "m/s^2": "m/s²", "kg m^2": "kg m²", "1": ""}.get(unit, unit)


def with_unit(text, unit, mark="\u00a0"):
    return f"{text}{mark}{unit}" if unit else text


def quantity(value, unit, digits=3):
    return with_unit(number(value, digits), unit_text(unit))


class Sizes:
    """Formatting of fault sizes: metres are shown in mm, other units unchanged."""

    def __init__(self, size):
        self.name = input_name(size["name"], size["unit"])
        self.unit = "mm" if size["unit"] == "m" else unit_text(size["unit"])
        self.factor = 1e3 if size["unit"] == "m" else 1.0

    def shown(self, value):
        return value * self.factor

    def reached(self, points, end):
        """a90 of points, or a bound of it, as shown; NaN where it is outside the tested sizes."""
        return [self.shown(p["a90"][end]["size"]) if p["a90"][end]["where"] == "reached" else math.nan
                for p in points]

    def text(self, value, digits=3):
        return with_unit(number(self.shown(value), digits), self.unit)

    def estimate(self, found, pod, text):
        """Size in words, or the smallest or largest tested size that it is beyond; text(size) words a size."""
        where = found["where"]
        return (text(found["size"]) if where == "reached" else
                f"< {text(pod['smallest'])}" if where == "below_tested" else f"> {text(pod['largest'])}")

    def group(self, low, high):
        if low == high:
            return self.text(high)
        return f"{number(self.shown(low))} to {self.text(high)}"

    def axis(self):
        return with_unit(self.name[0].upper() + self.name[1:], self.unit, ", ")
