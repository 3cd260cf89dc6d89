"""Checks a report's page in headless Chromium: python3 test_browser.py CASES PROGRAM SOURCES

Exits with 77, which ctest shows as skipped, if the browser or its driver is missing.
"""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

from report_case import PROGRAM, SOURCES, case

try:
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.keys import Keys
except ImportError as error:
    print(f"skipped: {error} (Debian: python3-selenium)")
    sys.exit(77)
for missing in (name for name in ("chromium", "chromedriver") if shutil.which(name) is None):
    print(f"skipped: no {missing} (Debian: chromium chromium-driver)")
    sys.exit(77)

import build_page  # noqa: E402
import made_sweeps  # noqa: E402
from in_page import CONTRASTS, OVERLAPS  # noqa: E402

PHONE, TABLET, DESKTOP = (390, 844), (768, 1024), (1280, 800)
PAPER = (680, 960)  # width of A4 between the browser's margins, in CSS pixels
# Pages from the program: a small study of every kind of gearbox.
STUDIES = {
    "planet": ["planet-crack-ideal.toml", "--instances", "350", "--set",
               "ensemble.threshold_instances=200"],
    "quasi_static": ["published/park-fig-13.toml"],
    "fixed_shaft": ["published/tian-fig-4-9.toml"]}
# Synthetic cases whose pages differ most in their contents.
SHOWN = ["usual", "many", "all_failed", "no_features", "none_detected", "nan_now_and_then",
         "continuous_size", "by_condition", "interrupted"]


def make_page(arguments):
    done = subprocess.run(arguments, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise RuntimeError(f"{arguments}: {done.stderr}")


class InBrowser(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.pages = {}
        for name, study in STUDIES.items():
            results = os.path.join(cls.folder.name, name + ".h5")
            cls.pages[name] = os.path.join(cls.folder.name, name + ".html")
            make_page([PROGRAM, "run", SOURCES / "studies" / study[0], *study[1:], "--quiet",
                       "--out", results])
            make_page([PROGRAM, "report", results, "--html", cls.pages[name]])
        planet = os.path.join(cls.folder.name, "planet.h5")
        cls.pages["comparison"] = os.path.join(cls.folder.name, "comparison.html")
        make_page([PROGRAM, "run", SOURCES / "studies" / STUDIES["planet"][0],
                   *STUDIES["planet"][1:], "--quiet", "--set", "sensor.noise_m_s2=2", "--out",
                   planet + ".louder.h5"])
        make_page([PROGRAM, "compare", planet, planet + ".louder.h5", "--html",
                   cls.pages["comparison"]])
        tables = SOURCES / "tests" / "analysis" / "reference"
        cls.pages["inspection"] = os.path.join(cls.folder.name, "inspection.html")
        make_page([PROGRAM, "pod", tables / "inspections_hits.csv", "--html",
                   cls.pages["inspection"]])
        made = {name: case(name) for name in SHOWN}
        made.update(made_sweeps.all_of())
        for name, data in made.items():
            cls.pages[name] = os.path.join(cls.folder.name, name + ".html")
            pathlib.Path(cls.pages[name]).write_text(build_page.page_html(data))
        options = webdriver.ChromeOptions()
        for argument in ("--headless=new", "--no-sandbox", "--disable-gpu",
                         "--disable-dev-shm-usage", "--window-size=1280,800",
                         f"--user-data-dir={cls.folder.name}/browser"):
            options.add_argument(argument)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
        cls.browser = webdriver.Chrome(service=Service(shutil.which("chromedriver")),
                                       options=options)
        cls.addClassCleanup(cls.browser.quit)

    def open(self, name, screen, dark=False):
        self.show_on(screen, dark)
        self.browser.get("file://" + self.pages[name])

    def show_on(self, screen, dark=False):
        """Shows the open page on another screen, or as it is printed."""
        self.browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
            "width": screen[0], "height": screen[1], "deviceScaleFactor": 1,
            "mobile": screen == PHONE})
        self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {
            "media": "print" if screen == PAPER else "screen", "features": [
                {"name": "prefers-color-scheme", "value": "dark" if dark else "light"}]})

    def script(self, text, *arguments):
        return self.browser.execute_script(text, *arguments)

    def test_every_page_on_every_screen_and_on_paper(self):
        # A page is loaded anew after the screen of a phone only.
        checks = (self.nothing_is_logged_and_nothing_is_loaded,
                  self.the_headline_is_on_the_first_screen,
                  self.every_chart_is_drawn_and_its_text_stays_on_it,
                  self.the_page_is_as_wide_as_the_screen)
        for name in self.pages:
            for screen in (PHONE, TABLET, DESKTOP, PAPER):
                if screen in (PHONE, TABLET):
                    self.open(name, screen)
                else:
                    self.show_on(screen)
                for check in checks:
                    with self.subTest(page=name, width=screen[0], check=check.__name__):
                        check(name)

    def nothing_is_logged_and_nothing_is_loaded(self, _):
        self.assertEqual(self.browser.get_log("browser"), [])
        self.assertEqual(self.script(
            "return performance.getEntriesByType('resource').map(e => e.name)"
            ".filter(n => !n.startsWith('data:'))"), [])

    def the_headline_is_on_the_first_screen(self, _):
        # With its figure and the conditions for which it holds, where the page has them.
        bottom = self.script("return Math.max(...[...document.querySelectorAll("
                             "'.answer, .lead svg, .lead figcaption, .holds > p:first-child')]"
                             ".map(e => e.getBoundingClientRect().bottom))")
        self.assertLess(bottom, self.script("return innerHeight"))

    def test_a_warning_is_not_larger_than_the_headline(self):
        self.open("usual", DESKTOP)
        headline, note = self.script("""
            const note = document.createElement('p');
            note.className = 'note';
            document.querySelector('.holds').append(note);
            return [document.querySelector('.answer'), note].map(
                e => parseFloat(getComputedStyle(e).fontSize));""")
        self.assertGreater(headline, 1.2 * note)

    def every_chart_is_drawn_and_its_text_stays_on_it(self, name):
        charts = self.script(OVERLAPS + """
            return [...document.querySelectorAll('figure svg')].map(svg => {
                const box = svg.getBoundingClientRect();
                const out = [...svg.querySelectorAll('text')].filter(text => {
                    const t = text.getBoundingClientRect();
                    return t.width > 0 && (t.left < box.left - 4 || t.right > box.right + 4
                        || t.top < box.top - 4 || t.bottom > box.bottom + 4);
                }).map(text => text.textContent);
                return {width: box.width, height: box.height, out: out, over: over(svg),
                        marks: svg.querySelectorAll('path, use').length};});""")
        for chart in charts:
            self.assertGreater(chart["width"], 250)
            self.assertGreater(chart["height"], 80)
            self.assertEqual(chart["over"], [])
            self.assertGreater(chart["marks"], 3)
            self.assertEqual(chart["out"], [])
        figures = self.script("return [...document.querySelectorAll('figure')]"
                              ".map(f => f.querySelectorAll('svg').length)")
        self.assertTrue(all(figures))
        if name in ("planet", "usual"):
            self.assertGreaterEqual(len(figures), {"planet": 11, "usual": 6}[name])

    def the_page_is_as_wide_as_the_screen(self, _):
        needed, width, outside = self.script("""
            const closed = [...document.querySelectorAll('details')].filter(d => !d.open);
            closed.forEach(d => d.open = true);
            const width = document.documentElement.clientWidth;
            const outside = [...document.querySelectorAll('main > section > *, figure, svg, .answer')]
                .filter(e => e.getBoundingClientRect().right > width + 0.5
                             || e.getBoundingClientRect().left < -0.5)
                .map(e => e.outerHTML.slice(0, 80));
            const needed = document.documentElement.scrollWidth;
            closed.forEach(d => d.open = false);
            return [needed, width, outside];""")
        self.assertLessEqual(needed, width)
        self.assertEqual(outside, [])

    def test_result_figure_and_conditions_are_on_the_first_screen(self):
        for screen in (PHONE, DESKTOP):
            self.open("planet", screen)
            for part, edge in ((".answer", "bottom"), (".lead figure svg", "bottom"), (".holds", "top")):
                self.assertLess(self.script(
                    "return document.querySelector(arguments[0]).getBoundingClientRect()[arguments[1]]",
                    part, edge), screen[1], part)

    def test_every_chart_has_a_name_and_a_description(self):
        self.open("planet", DESKTOP)
        charts = self.script("return document.querySelectorAll('svg').length")
        self.browser.execute_cdp_cmd("Accessibility.enable", {})
        nodes = self.browser.execute_cdp_cmd("Accessibility.getFullAXTree", {})["nodes"]
        images = [n for n in nodes if not n.get("ignored")
                  and n.get("role", {}).get("value") in ("image", "img")]
        self.assertEqual(len(images), charts)
        names = [n["name"]["value"] for n in images]
        self.assertTrue(all(len(name) > 20 for name in names))
        self.assertEqual(len(set(names)), len(names))
        regions = [n for n in nodes if n.get("role", {}).get("value") in ("main", "navigation")]
        self.assertEqual(len(regions), 2)

    def test_text_contrasts_with_its_background(self):
        for name in self.pages:
            self.open(name, DESKTOP)
            self.script("document.querySelectorAll('details').forEach(d => d.open = true)")
            for dark in (False, True):
                with self.subTest(page=name, dark=dark):
                    self.show_on(DESKTOP, dark)
                    seen, weak = self.script(CONTRASTS)
                    self.assertGreater(seen, 5)
                    self.assertEqual(weak, [])

    def test_keyboard_focus_follows_the_page_order(self):
        for name in self.pages:
            with self.subTest(page=name):
                self.goes_through(name)
        self.open("planet", DESKTOP)
        self.script("document.querySelector('figure summary').focus()")
        ActionChains(self.browser).send_keys(Keys.ENTER).perform()
        self.assertTrue(self.script("return document.querySelector('figure details').open"))

    def goes_through(self, name):
        self.open(name, DESKTOP)
        expected = self.script("""
            const all = 'a[href], summary, [tabindex="0"]';
            window.reached = [];
            document.addEventListener('focusin', e => window.reached.push(
                [e.target.dataset.order, getComputedStyle(e.target).outlineStyle]));
            return [...document.querySelectorAll(all)].filter(e => e.offsetParent !== null
                && e.checkVisibility() || e.className === 'skip').map((e, i) => {
                    e.dataset.order = i; return e.tagName; });""")
        ActionChains(self.browser).send_keys(Keys.TAB * len(expected)).perform()
        reached = self.script("return window.reached")
        self.assertNotIn("none", [outline for _, outline in reached])
        self.assertEqual([order for order, _ in reached], [str(i) for i in range(len(expected))])
        self.assertEqual(expected[0], "A")  # skips the header with one key

    def test_a_dark_screen_has_light_text(self):
        self.open("planet", DESKTOP, dark=True)
        colours = self.script("""
            const of = (e, p) => getComputedStyle(e)[p].match(/[0-9]+/g).map(Number);
            return [of(document.body, 'backgroundColor'), of(document.body, 'color'),
                    of(document.querySelector('figure svg text'), 'fill')];""")
        self.assertLess(max(colours[0]), 60)
        self.assertGreater(min(colours[1]), 200)
        self.assertGreater(min(colours[2]), 200)

    def test_it_prints(self):
        self.open("planet", DESKTOP)
        self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print"})
        self.assertEqual(self.script(
            "return getComputedStyle(document.querySelector('nav')).display"), "none")
        printed = self.browser.execute_cdp_cmd("Page.printToPDF", {})
        self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": ""})
        self.assertGreater(len(printed["data"]), 50000)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
