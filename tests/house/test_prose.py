"""Checks prose.py on small synthetic trees."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

PROSE = pathlib.Path(__file__).with_name("prose.py")
GLOSSARY = """
tilt*         exponential tilting
own baseline  baseline record
abreast       in lockstep
"""
SOUND = {
    "README.md": "# Title\n\nA sentence of `code` words.\n",
    "src/integrate.hpp": "// Integrates one step.\n#include <march.h>\n"
                         "int integrate();  // of a step\n",
    "tests/test_integrate.cpp": 'TEST_CASE("Steps converge", "[march]") { step("march"); }\n',
    "analysis/report.py": '"""Writes the report."""\n\nTITLE = "march"  # a title\n',
    "mc/a.cpp": 'const char* key = "abreast", *text = "see life.abreast_rows and a march";\n',
    "studies/a.toml": 'title = "# abreast"  # a march\n',
    "docs/index.md": "# Pages\n\n- A list item.\n- What is a mesh?\n\n    of code\n\n"
                     "$$\nof = 1\n$$\n",
}


class Prose(unittest.TestCase):
    def run_on(self, changes):
        """Output lines of prose.py for the sound tree with other files, and its exit code."""
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for name, text in (SOUND | changes).items():
                path = root / "tree" / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text, encoding="utf-8")
            (root / "glossary.txt").write_text(GLOSSARY, encoding="utf-8")
            run = subprocess.run([sys.executable, "-Bs", PROSE, root / "tree",
                                  root / "glossary.txt"], capture_output=True, text=True,
                                 check=False)
        self.assertEqual(run.stderr, "")
        return run.stdout.splitlines()[:-4], run.returncode

    def refused(self, changes, *offences):
        """Checks that these offences and no others are reported."""
        lines, code = self.run_on(changes)
        self.assertEqual(lines, list(offences))
        self.assertEqual(code, 1)

    def test_a_sound_tree_passes(self):
        self.assertEqual(self.run_on({}), ([], 0))

    def test_comments_that_open_with_a_fragment(self):
        self.refused({"src/a.hpp": "int a;\n// Of a step.\n// That is all.\nint b;\n"},
                     "src/a.hpp:2: opens with a fragment: Of a step.")
        self.refused({"analysis/a.py": 'def a():\n    """What a does."""\n'},
                     "analysis/a.py:2: opens with a fragment: What a does.")
        self.refused({"tests/a.sh": "#!/bin/sh\n# Whose script\n"},
                     "tests/a.sh:2: opens with a fragment: Whose script")

    def test_paragraphs_that_open_with_a_fragment(self):
        self.refused({"docs/a.md": "# A\n\nText\nof a page.\n\n- those\n\n| as | b |\n"},
                     "docs/a.md:6: opens with a fragment: those",
                     "docs/a.md:8: opens with a fragment: as")

    def test_few_fragments_pass(self):
        many = "".join(f"// Comment {i}.\nint a{i};\n" for i in range(400))
        self.assertEqual(self.run_on({"src/a.hpp": many + "// Of two.\nint b;\n"})[1], 0)

    def test_messages_and_comments_of_studies_with_a_listed_word(self):
        self.refused({"mc/a.cpp": '\nauto a = f("{} rows abreast");\n'},
                     'mc/a.cpp:2: "{} rows abreast" has \'abreast\', use: in lockstep')
        self.refused({"studies/a.toml": 'a = "x # y"\nb = 1  # Abreast.\n'},
                     "studies/a.toml:2: Abreast. has 'abreast', use: in lockstep")
        self.assertEqual(self.run_on({"tests/a.cpp": 'auto a = "rows abreast";\n'})[1], 0)

    def test_long_pages(self):
        self.refused({"README.md": "\n" * 121}, "README.md:120: 121 lines, at most 120")
        self.refused({"docs/a.md": "\n" * 401}, "docs/a.md:400: 401 lines, at most 400")

    def test_long_sentences(self):
        words = " ".join(["word"] * 35)
        self.assertEqual(self.run_on({"docs/a.md": f"A {words[5:]}, e.g. `a b c`\n"})[1], 1)
        self.assertEqual(self.run_on({"docs/a.md": f"{words}. And [a link](b/c d.md).\n"})[1], 0)
        self.refused({"docs/a.md": f"Short.\n\nOne {words}.\n"},
                     f"docs/a.md:3: sentence of 36 words: {('One ' + words)[:80]}")


if __name__ == "__main__":
    unittest.main()
