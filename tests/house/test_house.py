"""Checks house.py on small synthetic trees."""

import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

from study_reach import Reach

HOUSE = pathlib.Path(__file__).with_name("house.py")
FLOORS = """
src/low
src/high on src/low
src/beside on src/low
mc on src/high src/beside
"""
CEILINGS = """
lines of src, mc and analysis                   30  # only lowered
lines of tests                                  10
lines of text data in tests                      1
functions and members that reach a study         3
functions that answer yes or no about a study    0
"""
# A valid tree: every folder includes all folders of its line.
SOUND = {
    "src/low/stone.hpp": "// Under brick.hpp.\n#pragma once\n#include <vector>\n",
    "src/low/stone.cpp": '#include "low/stone.hpp"\n',
    "src/high/brick.hpp": '#include "low/stone.hpp"\n',
    "src/beside/wall.hpp": '#include "low/stone.hpp"\n',
    "mc/roof.cpp": '#include "beside/wall.hpp"\n#include "high/brick.hpp"\n',
    "tests/high/test_brick.cpp": '#include "../../src/high/brick.hpp"\n#include "tile.hpp"\n',
    "tests/high/tile.hpp": "",
    "analysis/report/page.py": "import json\nimport numpy\nfrom parts import chart\n",
    "analysis/report/parts/chart.py": "import words\n",
    "analysis/report/words.py": "import gearpod.results\n",
    "analysis/python/gearpod/results.py": "from . import columns\nfrom .columns import Array\n",
    "analysis/python/gearpod/columns.py": "",
    "README.md": "`src/high/brick.hpp`, `high/test_*.cpp`\n",
}


class House(unittest.TestCase):
    def run_on(self, changes, floors=FLOORS, ceilings=CEILINGS):
        """Output of house.py for the valid tree with other files, and its exit code."""
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for name, text in ((root / "tree" / name, text)
                               for name, text in (SOUND | changes).items()):
                name.parent.mkdir(parents=True, exist_ok=True)
                name.write_text(text, encoding="utf-8")
            (root / "floors.txt").write_text(floors, encoding="utf-8")
            (root / "ceilings.txt").write_text(ceilings, encoding="utf-8")
            run = subprocess.run([sys.executable, "-Bs", HOUSE, root / "tree", root / "floors.txt",
                                  root / "ceilings.txt"], capture_output=True, text=True,
                                 check=False)
        self.assertEqual(run.stderr, "")
        return run.stdout, run.returncode

    def refused(self, changes, *lines, floors=FLOORS, ceilings=CEILINGS):
        """Checks that these problems and no others are printed."""
        text, code = self.run_on(changes, floors, ceilings)
        problems = [line for line in text.splitlines() if not re.search(r", \d+ left$", line)]
        self.assertEqual(problems, list(lines))
        self.assertEqual(code, 1)

    def test_a_sound_tree_passes(self):
        self.assertEqual(self.run_on({}), (
            "the sources are in order\n"
            "lines of src, mc and analysis: 15, at most 30, 15 left\n"
            "lines of tests: 2, at most 10, 8 left\n"
            "lines of text data in tests: 0, at most 1, 1 left\n"
            "functions and members that reach a study: 0, at most 3, 3 left\n"
            "functions that answer yes or no about a study: 0, at most 0, 0 left\n", 0))

    def test_an_arrow_up(self):
        self.refused({"src/low/mud.cpp": '\n#include "high/clay.hpp"\n', "src/high/clay.hpp": ""},
                     "src/low/mud.cpp:2 includes high/clay.hpp: src/low may not include src/high",
                     "circle of folders: src/high -> src/low -> src/high",
                     "    src/high/brick.hpp:1 includes low/stone.hpp",
                     "    src/low/mud.cpp:2 includes high/clay.hpp")

    def test_an_arrow_across(self):
        self.refused({"src/high/beam.cpp": '#include "beside/wall.hpp"\n'},
                     "src/high/beam.cpp:1 includes beside/wall.hpp: src/high may not include "
                     "src/beside")

    def test_a_script_that_cannot_be_run(self):
        self.refused({"tests/high/draw.py": "#!/usr/bin/env python3\n"},
                     "tests/high/draw.py names its interpreter but is not executable: chmod +x, or "
                     "drop the line")

    def test_includes_over_several_floors(self):
        self.assertEqual(self.run_on({"mc/roof.hpp": '#include "low/stone.hpp"\n'})[1], 0)

    def test_a_circle_of_modules(self):
        self.refused({"src/low/a.hpp": '#include "low/b.hpp"\n',
                      "src/low/b.cpp": '#include "low/c.hpp"\n', "src/low/b.hpp": "",
                      "src/low/c.cpp": '#include "low/a.hpp"\n', "src/low/c.hpp": ""},
                     "circle of modules: src/low/a -> src/low/b -> src/low/c -> src/low/a",
                     "    src/low/a.hpp:1 includes low/b.hpp",
                     "    src/low/b.cpp:1 includes low/c.hpp",
                     "    src/low/c.cpp:1 includes low/a.hpp")

    def test_a_header_that_does_not_exist(self):
        self.refused({"src/low/sand.cpp": '#include "low/dust.hpp"\n'},
                     "src/low/sand.cpp:1 includes low/dust.hpp, which does not exist")
        self.refused({"tests/low/test_sand.cpp": '#include "../dust.hpp"\n'},
                     "tests/low/test_sand.cpp:1 includes ../dust.hpp, which does not exist")

    def test_a_header_that_the_build_makes(self):
        self.assertEqual(self.run_on({"src/low/sand.cpp": '#include "made.hpp"\n',
                                    "src/CMakeLists.txt": "set(made generated/made.hpp)\n"})[1], 0)

    def test_files_and_messages_below(self):
        self.refused({"src/low/sand.cpp": "#include <mpi.h>\n#include <hdf5.h>\n"},
                     *(f"src/low/sand.cpp:{line} includes {header}: src may not include files, "
                       "messages or its users" for line, header in ((1, "mpi.h"),
                                                                        (2, "hdf5.h"))))

    def test_a_folder_without_a_floor(self):
        self.refused({"src/shed/rake.hpp": ""}, "floors: src/shed has no line")

    def test_invalid_floors(self):
        self.refused({}, "floors: src/cellar holds no sources", floors=FLOORS + "src/cellar\n")
        self.refused({}, "floors: mc is after src/attic, which has no line above",
                     floors=FLOORS.replace("mc on", "mc on src/attic"))
        self.refused({}, "floors: mc includes nothing of src/low, which is on its line",
                     floors=FLOORS.replace("mc on", "mc on src/low"))

    def test_a_circle_of_imports(self):
        circle = ("circle of Python modules: analysis/python/gearpod/columns -> "
                  "analysis/python/gearpod/results -> analysis/python/gearpod/columns",
                  "    analysis/python/gearpod/columns.py:2 imports {}",
                  "    analysis/python/gearpod/results.py:1 imports .columns")
        columns = "analysis/python/gearpod/columns.py"
        self.refused({columns: "def frame():\n    from . import results\n"},
                     *(line.format(".results") for line in circle))
        self.refused({columns: "if TYPE_CHECKING:\n    from .results import open\n"},
                     *(line.format(".results") for line in circle))
        self.refused({columns: "\nimport gearpod.results\n"},
                     *(line.format("gearpod.results") for line in circle))

    def test_modules_that_do_not_exist(self):
        self.refused({"docs/tools/page.py": "import chart\nimport h5py, lost.part\n"},
                     "docs/tools/page.py:1 imports chart, which does not exist",
                     "docs/tools/page.py:2 imports lost.part, which does not exist")
        self.refused({"analysis/python/gearpod/columns.py": "from .lost import part\n"},
                     "analysis/python/gearpod/columns.py:1 imports .lost, which does not exist")

    def test_ceilings(self):
        self.refused({"analysis/report/words.py": "\n" * 16, "tests/high/tile.py": "\n" * 8},
                     ceilings=CEILINGS.replace("30 ", "29 ").replace("  10", "   9"),
                     *("ceilings: lines of src, mc and analysis: 30 are 1 too many",
                       "ceilings: lines of tests: 10 are 1 too many"))
        self.refused({"tests/high/tile.csv": "1\n", "tests/high/data/tile.json": "{\n}\n",
                      "tests/high/CMakeLists.txt": "\n" * 9},
                     "ceilings: lines of text data in tests: 3 are 2 too many")
        self.refused({}, "ceilings: lines of tests has no line", "ceilings: lines is not measured",
                     ceilings=CEILINGS.replace("lines of tests", "lines         "))

    def counted(self, text, others=None):
        """Functions and members in mc/use.cpp that reach a study, and those that return bool."""
        texts = {"mc/study/study.hpp": "struct Study { int teeth; };\nstruct Key { int (*get)(Study&); };\n",
                 "mc/plan/scene.hpp": "class Scene {\n  public:\n    const Study& study() const;\n"
                                      "    bool has_load() const;\n};\n", "mc/use.cpp": text}
        reach = Reach(texts | (others or {}))
        return [sorted(line.partition(" ")[2] for line in lines) for lines in (reach.found, reach.questions)]

    def test_functions_that_reach_a_study(self):
        self.assertEqual(self.counted("int a(const Study& study);\nint a(const Study& s) { return s.teeth; }\n"
                                      "int b(int n) { return n; }  // of a Study\n"), [["a"], []])
        self.assertEqual(self.counted("template <class T>\nint a(T t) { return t.study().teeth; }\n"
                                      "void b(std::span<const Scene* const> all = {});\n"), [["a", "b"], []])
        self.assertEqual(self.counted("Study made(int n) { return {n}; }\nint a() { auto s = made(1); return s.teeth; }\n"
                                      "int b() { return 0; }\nint get(const Key& key);\n"), [["a", "made"], []])

    def test_members_that_hold_a_study(self):
        text = ("struct Task {\n    explicit Task(const Scene& s) : scene{s}, n(1) {}\n    int count() const { return n; }\n"
                "    bool loaded() const { return scene.has_load(); }\n    const Scene& scene;\n    int n = 0;\n};\n"
                "class Worker {\n    int rows() const { return task_->count(); }\n    std::unique_ptr<Task> task_;\n};\n"
                "enum class Kind { a };\nbool is_one(const Worker& worker, Kind kind = Kind::a) { return true; }\n")
        self.assertEqual(self.counted(text), [
            ["Task::Task", "Task::loaded", "Worker::rows", "holds Task::scene", "holds Worker::task_",
             "is_one"], ["Task::loaded", "is_one"]])
        self.assertEqual(self.counted("int a(const Task& task);\n"), [[], []])
        self.assertEqual(self.counted("int a(const Draw& draw);\n", {
            "mc/plan/draw.hpp": "class Draw {\n    Study study_;\n};\n"}), [["a"], []])

    def test_constants_of_one_name_in_a_folder(self):
        stone = "namespace {\nconstexpr double kWeight = 2;\n}\n"
        self.refused({"src/low/chalk.cpp": stone, "src/low/slate.cpp": stone,
                      "src/low/sand_kernel.cpp": stone, "src/beside/mortar.cpp": stone},
                     "src/low/slate.cpp:2 defines kWeight, which src/low/chalk.cpp:2 defines too")

    def test_names_of_missing_files(self):
        self.refused({"src/low/sand.cpp": 'const char* kept = "gone.cpp";  // As gone.hpp says.\n',
                      "src/README.md": "`low/stone.cpp`, `low/gone_*.cpp`\n"},
                     "src/README.md:1 names low/gone_*.cpp, which does not exist",
                     "src/low/sand.cpp:1 names gone.hpp, which does not exist")

    def test_paths_of_pages(self):
        page = "| 1 `mc/roof.cpp` | a |\n| 2 `src/low/stone.cpp` | b |\n"
        self.assertIn("README.md: mc/roof.cpp does not include the next file of its path, src/low/stone.cpp",
                      self.run_on({"README.md": page})[0])
        self.assertEqual(self.run_on({"README.md": page, "mc/roof.hpp": '#include "low/stone.hpp"\n'})[0].count("path"), 0)

    def test_names_of_missing_folders(self):
        self.refused({"src/README.md": "`low/`, `src/low/`, `build/`\n| `gone/` | \n"},
                     "src/README.md:2 names gone/, which does not exist")


if __name__ == "__main__":
    unittest.main()
