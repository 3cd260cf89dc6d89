"""Mutated study files."""
import pathlib
import random

STUDIES = [path.read_text(encoding="utf-8")
           for path in sorted((pathlib.Path(__file__).resolve().parents[2] / "studies").rglob("*.toml"))]
# Extreme numbers, other types, and tables of distributions; separated by bars.
VALUES = (
    "0|-0.0|1|-1|2|3|7|8|0.5|1.5|100|1e3|1e6|1e9|1e12|1e-3|1e-6|1e-12|1e-300|5e-324|1e300|1e18|1e19|-1e18|1e-30|1e-31|1e5|1e7|1e-9|"
    "0.999999999|1000000000|1.7976931348623157e308|-1e300|nan|inf|-inf|2147483647|2147483648|-2147483648|9223372036854775807|"
    "-9223372036854775808|9223372036854775808|0x7fffffff|1_000|true|false|\"\"|\"none\"|\"sun\"|\"ring\"|\"planet\"|\"carrier\"|"
    "\"constant\"|\"crack\"|\"march\"|\"\\u0000\"|\"é\"|[]|[0]|[1, 0]|[0, 1, 2]|[nan]|[[1], [2]]|[\"te_rms\"]|[1, \"a\"]|{}|"
    "1979-05-27|07:32:00|'''x'''|{ half_width = 0.1, feature = \"te_rms\", size = 0 }").split("|") + [
    f"{{ distribution = {law} }}" for law in (
        "\"uniform\"|\"uniform\", low = 0, high = 1|\"uniform\", low = 1, high = 1|\"uniform\", low = 1e-300, high = 1e300|"
        "\"normal\", mean = 1, sd = 1e-9|\"lognormal\", median = 1, cv = 100|\"lognormal\", median = 1e8, cv = 0.2|"
        "\"truncated-normal\", mean = 0, sd = 1, low = 30, high = 31|\"triangular\", low = 1, mode = 1, high = 2|"
        "\"weibull\", scale = 1, shape = 0.2|\"beta\", low = 0, high = 1, alpha = 0.05, beta = 10000|"
        "\"discrete\", values = [0, 1], weights = [1e-30, 1e18]|\"levels\", values = [0, 1, 2]|\"levels\", values = [1, 1]|"
        "\"grid\", low = 0, high = 4, count = 5|\"grid\", low = 0, high = 4, count = 1000000000").split("|")]
KEYS = ("planets sun_teeth kind member side depth_mm torque_N_m fixed input noise_levels seed instances low_pass_Hz use sun "
        "size_edges_mm lanes tooth_profile motion horizon").split()


def long_list(dice):
    """Ascending numbers, from a few to more than allowed."""
    return str(list(range(1 << dice.randrange(13))))


def nested(dice):
    """A header or key of many parts, or a value with many brackets."""
    begin, part, end = dice.choice([("[a", ".a", "]"), ("a", ".a", " = 1"), ("a", ".a", " = 1"), ("x = ", "[", "")])
    return begin + part * (1 << dice.randrange(17)) + end


def mutate_line(lines, dice):
    """Drops, doubles or moves a line, misspells it, replaces its value or inserts another line."""
    if not lines:
        return
    at, kind = dice.randrange(len(lines)), dice.randrange(11)
    if kind == 0:
        del lines[at]
    elif kind == 1:
        lines.insert(at, lines[at])
    elif kind == 2:
        other = dice.randrange(len(lines))
        lines[at], lines[other] = lines[other], lines[at]
    elif kind == 4:
        place = dice.randrange(len(lines[at]) or 1)
        lines[at] = lines[at][:place] + dice.choice("abcdefghijklmnopqrstuvwxyz") + lines[at][place + 1:]
    elif kind == 5:
        lines.insert(at, f"{dice.choice(KEYS)} = {dice.choice(VALUES)}")
    elif kind == 7:
        lines.insert(at, nested(dice))
    elif "=" in lines[at]:
        value = (dice.choice(lines).rpartition("=")[2] if kind == 3 else long_list(dice) if kind == 6 else dice.choice(VALUES))
        lines[at] = lines[at].partition("=")[0] + "= " + value


def mutate_bytes(data, dice):
    at, kind = dice.randrange(len(data) or 1), dice.randrange(6)
    if kind == 0:
        del data[at:]
    elif kind == 1:
        data[at:at] = dice.choice(b"[{(\"'=").to_bytes(1, "big") * dice.randint(1, 3000)
    elif kind == 2:
        data.insert(at, dice.randrange(256))
    elif kind == 3:
        del data[at:at + dice.randrange(20)]
    elif data:
        data[at] ^= 1 << dice.randrange(8)


def mutated(number):
    """One to four mutations of a shipped study, deterministic for a given number."""
    dice = random.Random(number)
    lines, in_bytes = dice.choice(STUDIES).splitlines(), dice.randrange(5) == 0
    for _ in range((0 if in_bytes else 1) + dice.randrange(3)):
        mutate_line(lines, dice)
    data = bytearray("".join(line + "\n" for line in lines).encode())
    if in_bytes:
        mutate_bytes(data, dice)
    return bytes(data)
