"""Checks a report's page as HTML: python3 test_page.py CASES PROGRAM SOURCES"""

import functools
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree

from report_case import CASES, PROGRAM, SOURCES, case

import build_page
import charts
import words
from lives import campaign_data
from page_html import PageHtml


@functools.lru_cache(maxsize=None)
def case_page(name):
    return build_page.page_html(case(name))


def page_text(name):
    """All words of a case's page."""
    return PageHtml(case_page(name)).text()


def headline_text(name):
    """The headline of a case."""
    return PageHtml(re.search(r'<p class="answer">(.*?)</p>', case_page(name), re.S).group(1)).text()


class EveryCase(unittest.TestCase):
    def test_pages_are_whole(self):
        files = sorted(CASES.glob("*.json"))
        self.assertGreater(len(files), 20)
        for file in files:
            with self.subTest(file.stem):
                self.check(case_page(file.stem))

    def check(self, text):
        parsed = PageHtml(text)
        self.assertEqual(parsed.problems, [])
        self.assertEqual(len(parsed.ids), len(set(parsed.ids)), "an id stands twice")
        for link in parsed.links:
            self.assertTrue(link == "data:," or link[0] == "#" and link[1:] in parsed.ids, link)
        for reference in re.findall(r"url\(([^)]*)\)", text):
            self.assertIn(reference.lstrip("#"), parsed.ids)
        for outside in ("http://", "https://", "@import", "<script", "javascript:"):
            self.assertNotIn(outside, text)
        self.assertEqual(parsed.count("h1"), 1)
        self.assertNotRegex(parsed.text(), r"\b(nan|inf|None|NaN|Infinity)\b")
        for chart in parsed.charts:
            self.assertEqual(chart["attributes"]["role"], "img")
            for name in chart["attributes"]["aria-labelledby"].split():
                self.assertTrue(chart["names"][name].strip())
        figures = parsed.count("figure")
        self.assertEqual(figures, parsed.count("figcaption"))
        self.assertGreaterEqual(parsed.count("details"), figures)
        self.assertLess(len(text), 3e6)


class Headlines(unittest.TestCase):
    def test_smallest_fault(self):
        data = case("usual")
        n = data["noise"]["reference"]
        found = data["smallest_fault"][n]
        titles = {feature["name"]: feature["title"] for feature in data["features"]}
        self.assertEqual(
            headline_text("usual"),
            f"A fault of {words.number(1e3 * found['size'])} mm is found with 90 % probability at "
            f"95 % confidence by the {titles[found['feature']]} ({found['feature']}) at noise × 1.")

    def test_nothing_is_made_up(self):
        for name, page_text in (("no_rows", "cannot be assessed"), ("no_features", "computes no feature"),
                           ("all_failed", "cannot be assessed"),
                           ("no_fault", "No gearbox of this study has a fault"),
                           ("no_graded", "No gearbox of this study"), ("only_faulty", "no alarm threshold"),
                           ("few", "Too few healthy gearboxes for a false-alarm rate of 0.05: 5 give"),
                           ("none_detected", "No tested fault is found")):
            with self.subTest(name):
                self.assertIn(page_text, headline_text(name))
                self.assertNotRegex(headline_text(name), r"\d mm is found")

    def test_all_detected_is_a_tested_size(self):
        self.assertIn("A fault of 0.5 mm is found", headline_text("all_detected"))
        self.assertIn("there is no detection curve for it (te_fm0: every faulty gearbox was",
                      page_text("all_detected"))

    def test_without_curves_the_rates_give_the_result(self):
        self.assertIn("mm is found with 90 % probability", headline_text("too_large"))
        self.assertIn("they need all values at once", page_text("too_large"))

    def test_pure_numbers_have_no_unit(self):
        self.assertIn("A fault of 0.001 is found", headline_text("pure_number"))

    def test_an_interrupted_run_is_marked(self):
        self.assertIn("Incomplete study: 1000 of 2000 gearboxes (interrupted by SIGTERM)",
                      page_text("interrupted"))


class Statements(unittest.TestCase):
    def test_missing_values_are_counted(self):
        self.assertIn("te_fm0 at noise × 1: 1000", page_text("nan_feature"))
        self.assertIn("1000 of 1000 gearboxes failed: 500 diverged, 500 did not converge",
                      page_text("all_failed"))
        self.assertIn("0 (diverged), 1 (not converged)", page_text("all_failed"))

    def test_a_constant_feature_is_named(self):
        self.assertIn("the feature is constant or nearly so",
                      page_text("constant_feature"))

    def test_signals_that_cannot_be_recomputed_are_refused(self):
        words_ = page_text("study_of_another_version")
        self.assertIn("No example signals: this version cannot build the study in the file", words_)
        self.assertIn("gearbox.colour", words_)

    def test_every_detection_rate_is_on_the_page(self):
        words_ = page_text("usual")
        for feature in case("usual")["detection"]["features"]:
            for level in feature["levels"]:
                for cell in level["sizes"]:
                    self.assertIn(words.rate_with_bounds(cell["pd"], cell["lower"], cell["upper"]),
                                  words_)

    def test_the_numerical_error_is_next_to_the_statistical_one(self):
        self.assertIn("requested no check of its numerical error", page_text("usual"))

    def test_every_finding_is_on_the_page_in_its_own_words(self):
        for name in ("usual", "by_condition", "many"):
            shown = page_text(name)
            for section in case(name)["findings"]:
                for block in section["blocks"]:
                    # Rates and curves have drawings; statements by level are those of the answer.
                    texts = [block["text"]] if "text" in block else sum(block["rows"], [])
                    if re.match(r"(headline|ranking|misses|effects\w*|\w*false_alarms|unknown|responses\w*|bins)[.]",
                                block["key"]):
                        continue
                    for text in texts:
                        self.assertIn(" ".join(words.typeset(text).split()), shown, block["key"])

    def test_text_is_never_markup(self):
        data = case("usual")
        data["title"] = 'A <b>"crack"</b> & <script>alert(1)</script>'
        data["provenance"]["host"] = "</table><img src=x>"
        text = build_page.page_html(data)
        self.assertNotIn("<script", text)
        self.assertNotIn("<img", text)
        self.assertIn(data["title"], PageHtml(text).text())

    def test_equal_results_give_equal_pages(self):
        self.assertEqual(build_page.page_html(case("usual")), case_page("usual"))


class Numbers(unittest.TestCase):
    def test_rates_close_to_0_and_1_keep_their_digits(self):
        for value, text in ((0.0, "0.00"), (1e-17, "< 0.0001"), (0.00004, "< 0.0001"),
                            (0.00006, "0.0001"), (0.0029, "0.0029"), (0.25, "0.25"),
                            (0.9986, "0.9986"), (0.99994, "0.9999"), (0.99996, "> 0.9999"), (1, "1.00")):
            self.assertEqual(words.rate(value), text)
        self.assertEqual(words.rate_with_bounds(0.0, 1e-17, 0.0029), "0.00 [< 0.0001, 0.0029]")

    def test_digits(self):
        for value, text in ((0, "0"), (1.0330, "1.03"), (0.5, "0.5"), (1234.5, "1234"),
                            (0.00012, "0.00012"), (2.1e-6, "2.1 × 10⁻⁶"), (-3.14159, "−3.14"),
                            (0.9996, "1"), (99.96, "100"), (999999, "999999"), (2.068e11, "2.07 × 10¹¹"), (None, "–"),
                            (math.nan, "–"), (math.inf, "–")):
            self.assertEqual(words.number(value), text)
        self.assertEqual(words.input_name("ring_bearing_stiffness_N_m", "N/m"), "ring bearing stiffness")
        self.assertEqual(words.joined(["a", "b", "c"]), "a, b and c")


class Colours(unittest.TestCase):
    """Contrast as defined by WCAG 2.1: text 4.5 : 1, lines 3 : 1."""

    @staticmethod
    def luminance(colour):
        def linear(part):
            part = int(part, 16) / 255
            return part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4
        red, green, blue = (linear(colour[i:i + 2]) for i in (1, 3, 5))
        return 0.2126 * red + 0.7152 * green + 0.0722 * blue

    def contrast(self, a, b):
        low, high = sorted((self.luminance(a), self.luminance(b)))
        return (high + 0.05) / (low + 0.05)

    def test_contrast(self):
        css = (SOURCES / "analysis" / "report" / "page.css").read_text()
        schemes = [dict(re.findall(r"--(\w+): (#\w{6})", block))
                   for block in re.findall(r":root \{(.*?)\}", css, re.S)]
        self.assertEqual(len(schemes), 2)
        for i, scheme in enumerate(schemes):
            for text in ("ink", "muted", "link", "warn"):
                for ground in ("paper", "soft"):
                    self.assertGreaterEqual(self.contrast(scheme[text], scheme[ground]), 4.5,
                                            (i, text, ground))
            lines = [pair[i] for pair in charts.SERIES] + [scheme["muted"], scheme["accent"]]
            for line in lines:
                self.assertGreaterEqual(self.contrast(line, scheme["paper"]), 3.0, (i, line))
        for name in ("INK", "MUTED", "RULE", "PAPER", "NOISY"):
            self.assertEqual(getattr(charts, name), schemes[0][name.lower()])


class Program(unittest.TestCase):
    """Pages written by gearpod report --html."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.results = os.path.join(cls.folder.name, "r.h5")
        cls.gearpod("run", SOURCES / "studies" / "published" / "park-fig-13.toml", "--quiet", "--out",
                    cls.results)

    @classmethod
    def gearpod(cls, *arguments, **environment):
        return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, check=False,
                              env={**os.environ, **environment})

    def html(self):
        return os.path.join(self.folder.name, "r.html")

    def page(self, *arguments):
        """Text of the page that a command writes, and its standard output."""
        done = self.gearpod(*arguments, "--html", self.html())
        self.assertEqual(done.returncode, 0, done.stderr)
        text = pathlib.Path(self.html()).read_text()
        os.remove(self.html())
        self.assertNotIn("nan", re.findall(r"<td>(.*?)</td>", text))
        return text, done.stdout

    def test_page_and_json_agree(self):
        written, stored = self.page("report", self.results, "--json", "-")
        self.assertEqual(written, build_page.page_html(json.loads(stored)))
        words_ = PageHtml(written).text()
        self.assertIn("The gearbox is quasi-static", words_)
        self.assertIn("have the same bits", words_)

    def test_missing_tools_are_named_and_no_files_are_left(self):
        with tempfile.TemporaryDirectory() as fake:
            for module in ("matplotlib", "numpy"):
                pathlib.Path(fake, module + ".py").write_text("raise ImportError")
            for environment, named in (
                    ({"PYTHONPATH": fake}, "python3-numpy python3-matplotlib"),
                    ({"GEARPOD_PYTHON": "/nonexistent/python"}, "/nonexistent/python"),
                    ({"GEARPOD_REPORT_DIR": "/nonexistent"}, "GEARPOD_REPORT_DIR")):
                failed = self.gearpod("report", self.results, "--html", self.html(), **environment)
                self.assertEqual(failed.returncode, 2)
                self.assertIn(named, failed.stderr)
                self.assertFalse(os.path.exists(self.html()))

    def test_tables_and_figures_go_into_folders(self):
        tables, figures = (pathlib.Path(self.folder.name, name) for name in ("tables", "figures"))
        made = self.gearpod("report", self.results, "--csv", tables, "--figures", figures)
        self.assertEqual(made.returncode, 0, made.stderr)
        self.assertGreater(len(list(tables.glob("*.csv"))), 2)
        drawings = sorted(figures.glob("*.svg"))
        self.assertGreater(len(drawings), 1)
        for drawing in drawings:
            xml.etree.ElementTree.parse(drawing)
            self.assertEqual(drawing.with_suffix(".png").read_bytes()[:8], b"\x89PNG\r\n\x1a\n")
            self.assertEqual(drawing.with_suffix(".pdf").read_bytes()[:4], b"%PDF")
        self.assertIn("stiffness-of-healthy-gear-pairs-over-a-mesh-period.svg", [d.name for d in drawings])
        before = pathlib.Path(self.results).read_bytes()
        for made_, option in ((next(tables.glob("*.csv")), "--csv"), (drawings[0], "--figures")):
            made_.unlink()
            made_.symlink_to(self.results)
            self.gearpod("report", self.results, option, made_.parent)
            self.assertEqual(pathlib.Path(self.results).read_bytes(), before, option)
            made_.unlink()
            os.link(self.results, made_)
            self.gearpod("report", self.results, option, made_.parent)
            self.assertEqual(pathlib.Path(self.results).read_bytes(), before, option)
        failed = self.gearpod("report", self.results, "--figures", self.results)
        self.assertEqual(failed.returncode, 2)
        self.assertIn(self.results, failed.stderr)

    def test_inspections_have_a_page(self):
        tables = SOURCES / "tests" / "analysis" / "reference"
        for table, options, expected in (
                ("inspections_hits.csv", ("--link", "logit", "--size-scale", "linear"),
                 ("90 % of flaws of 2.593", "hits and misses", "likelihood ratio, chi-squared 3.841")),
                ("inspections_responses.csv", ("--response", "A", "--threshold", "6", "--left", "3"),
                 ("Responses", "threshold", "Wald, 1.645 standard errors"))):
            html, _ = self.page("pod", str(tables / table), *options, "--convention", "handbook")
            shown_text = PageHtml(html).text().replace("\u00a0", " ")
            for words_ in expected:
                self.assertIn(words_, shown_text)

    def test_comparisons_have_a_page(self):
        def run(name, *options):
            results = os.path.join(self.folder.name, name)
            self.gearpod("run", SOURCES / "studies" / "planet-crack-ideal.toml", "--quiet", "--out",
                         results, "--instances", "350", "--set",
                         "ensemble.threshold_instances=200", *options)
            return results

        a = run("a.h5")
        files = a, run("b.h5", "--set", "sensor.noise_m_s2=3"), run("c.h5", "--seed", "8")
        html, stored = self.page("compare", *files, "--json", "-")
        self.assertEqual(html, build_page.page_html(json.loads(stored)))
        shown_text = PageHtml(html).text()
        for words_ in ("B against A", "On 350 test gearboxes that are the same in both",
                       "Different gearboxes (seed 2 and 8)", "Difference of a90 at noise",
                       "minus A"):
            self.assertIn(words_, shown_text)
        shown = self.gearpod("compare", a, a).stdout
        self.assertIn("The same in every gearbox: te_rms", shown)
        self.assertLessEqual(max(map(len, shown.splitlines())), 120)

    def test_lives_have_a_page(self):
        results = os.path.join(os.path.dirname(self.html()), "lives.h5")
        life = {"life.interval_h": 5, "life.first_depth_mm": 1, "life.last_depth_mm": 4,
                "life.depth_steps": 2, "life.paris_factor": 5e-7, "life.paris_exponent": 2.25,
                "life.records": 60, "life.healthy_lives": 8, "monitoring.baseline_records": 8,
                "monitoring.false_alarms_per_1000_h": 5, "sensor.noise_levels": [1],
                "features.use": '["window_ratio","change_window_ratio"]',
                "ensemble.instances": 8, "ensemble.threshold_instances": 8}
        options = [text for key, value in life.items() for text in ("--set", f"{key}={value}")]
        html, stored = self.page("lives", SOURCES / "studies" / "planet-crack-ideal.toml", "--quiet",
                                 *options, "--out", results, "--json", "-")
        data = json.loads(stored)
        self.assertEqual(html, build_page.page_html(data))
        parsed = PageHtml(html)
        self.assertEqual(parsed.problems, [])
        self.assertEqual((parsed.count("figure"), parsed.count("script")), (3, 0))
        ended = sum(life["end_h"] is not None for life in data["lives"])
        self.assertGreater(ended, 0)
        findings = {block["key"]: block.get("text") for section in data["findings"]
                    for block in section["blocks"]}
        for words_ in ("hold for a crack in planet 1, ring side; identical teeth", "the lives of other gearboxes"):
            self.assertIn(words_, findings["holds"])
        for words_ in (findings["holds"], words.typeset(findings["headline"]),
                       "Depth at detection against", "each of the 31 teeth with all 81 mating teeth"):
            self.assertIn(words_, parsed.text())
        self.assertEqual(self.page("report", results, "--json", "-"), (html, stored))

    def test_a_tooth_that_breaks_is_drawn_as_deep_as_it_was(self):
        lives = campaign_data.CampaignData({"findings": [], "lives": [], "first_depth_m": 1e-3, "last_depth_m": 4e-3,
                                            "baseline_records": 1, "interval_h": 5})
        life = {"hours": [0, 5], "depth_m": [0, 2e-3]}
        self.assertEqual([lives.depth_at_end({**life, "end_h": h}) for h in (7, 10)], [4, 2])

    def test_an_unwritable_page_is_reported_first(self):
        failed = self.gearpod("report", self.results, "--html", "/nonexistent/folder/r.html")
        self.assertEqual(failed.returncode, 2)
        self.assertIn("/nonexistent/folder/r.html", failed.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
