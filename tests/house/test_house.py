"""Checks house.py on small synthetic trees."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

HOUSE = pathlib.Path(__file__).with_name("house.py")
FLOORS = """
src/low
src/high on src/low
src/beside on src/low
mc on src/high src/beside
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
    "README.md": "`src/high/brick.hpp`, `high/test_*.cpp`\n",
}


class House(unittest.TestCase):
    def run_on(self, changes, floors=FLOORS):
        """Output of house.py for the valid tree with other files, and its exit code."""
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for name, text in ((root / "tree" / name, text)
                               for name, text in (SOUND | changes).items()):
                name.parent.mkdir(parents=True, exist_ok=True)
                name.write_text(text, encoding="utf-8")
            (root / "floors.txt").write_text(floors, encoding="utf-8")
            run = subprocess.run([sys.executable, "-Bs", HOUSE, root / "tree", root / "floors.txt"],
                                 capture_output=True, text=True, check=False)
        self.assertEqual(run.stderr, "")
        return run.stdout, run.returncode

    def refused(self, changes, *lines, floors=FLOORS):
        """Checks that these lines and no others are printed."""
        text, code = self.run_on(changes, floors)
        self.assertEqual(text.splitlines(), list(lines))
        self.assertEqual(code, 1)

    def test_a_sound_tree_passes(self):
        self.assertEqual(self.run_on({}), ("the sources are in order\n", 0))

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

    def test_long_files_and_full_folders(self):
        self.refused({"src/low/long.cpp": "\n" * 401}, "src/low/long.cpp: 401 lines, at most 400")
        self.refused({f"src/low/pebble_{i}.hpp": "" for i in range(39)},
                     "src/low: 41 files, at most 40")

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

    def test_names_of_missing_folders(self):
        self.refused({"src/README.md": "`low/`, `src/low/`, `build/`\n| `gone/` | \n"},
                     "src/README.md:2 names gone/, which does not exist")


if __name__ == "__main__":
    unittest.main()
