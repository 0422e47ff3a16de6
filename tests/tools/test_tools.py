"""The scripts of tools/: what they find, and what they say where they cannot go on."""
import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
TOOLS = ROOT / "tools"


def run(*command, **more):
    return subprocess.run([str(c) for c in command], capture_output=True, text=True, **more)


class Layers(unittest.TestCase):
    def answer(self, files):
        """What check_layers says of a source tree with these files."""
        with tempfile.TemporaryDirectory() as folder:
            for name, text in files.items():
                path = Path(folder, "src", name)
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text)
            return run(TOOLS / "check_layers", folder)

    def assert_breach(self, files, message):
        answer = self.answer(files)
        self.assertEqual(answer.returncode, 1)
        self.assertIn(message, answer.stderr)

    def test_rooms_may_include_those_below(self):
        answer = self.answer({"app/main.cpp": '#include "base/a.hpp"\n#include "sph/b.hpp"\n',
                              "mesh/c.cpp": '#include <vtkCellArray.h>\n#include "mesh/c.hpp"\n',
                              "input/d.cpp": "#include <yaml-cpp/yaml.h>\n"})
        self.assertEqual((answer.returncode, answer.stderr), (0, ""))

    def test_a_room_above_is_a_breach(self):
        self.assert_breach({"base/a.cpp": '\n#include "plan/plan.hpp"\n'},
                           "src/base/a.cpp:2: base/ may not include plan/plan.hpp")

    def test_a_room_beside_is_a_breach(self):
        self.assert_breach({"sph/a.hpp": '#  include "fe/b.hpp"\n'},
                           "src/sph/a.hpp:1: sph/ may not include fe/b.hpp")

    def test_libraries_belong_to_rooms(self):
        self.assert_breach({"fe/a.cpp": "#include <vtkCellArray.h>\n"}, "src/fe/a.cpp:1")
        self.assert_breach({"mesh/a.cpp": "#include <yaml-cpp/yaml.h>\n"}, "src/mesh/a.cpp:1")

    def test_a_folder_that_is_no_room_is_a_breach(self):
        self.assert_breach({"misc/a.cpp": ""}, "misc is not a room")

    def test_kernels_see_no_shared_inline_code_at_any_depth(self):
        self.assert_breach({"sph/a.isa.cpp": "#include <vector>\n"}, "src/sph/a.isa.cpp:1")
        self.assert_breach({"sph/a.isa.cpp": '#include "sph/b.hpp"\n',
                            "sph/b.hpp": '#include "base/c.hpp"\n',
                            "base/c.hpp": "#include <cmath>\n#include <Eigen/Core>\n"},
                           "src/base/c.hpp:2: Eigen/Core: is not for src/sph/a.isa.cpp")

    def test_an_empty_tree_is_not_a_pass(self):
        self.assertNotEqual(self.answer({}).returncode, 0)


class Setup(unittest.TestCase):
    """tools/setup on a machine that these fake commands make up."""

    def answer(self, **commands):
        with tempfile.TemporaryDirectory() as folder:
            for tool in ("bash", "env", "cat"):
                os.symlink(shutil.which(tool), Path(folder, tool))
            for name, script in commands.items():
                path = Path(folder, name.replace("_", "-"))
                path.write_text("#!/bin/bash\n" + script + "\n")
                path.chmod(0o755)
            return run(shutil.which("bash"), TOOLS / "setup", env={"PATH": folder})

    # Says of all packages but the last one that they are installed.
    ALL_BUT_LAST = 'shift 3; while (($# > 1)); do echo "$1 installed"; shift; done; exit 1'
    ALL = 'shift 3; for p; do echo "$p installed"; done'

    def test_does_nothing_where_all_is_there(self):
        answer = self.answer(dpkg_query=self.ALL, apt_get="exit 9")
        self.assertEqual((answer.returncode, answer.stdout, answer.stderr), (0, "", ""))

    def test_root_installs_what_is_missing_and_says_so(self):
        answer = self.answer(dpkg_query=self.ALL_BUT_LAST, id="echo 0",
                             apt_get='echo "apt-get $*"')
        self.assertEqual(answer.returncode, 0, answer.stderr)
        self.assertIn("which are now installed: python3\n", answer.stdout)
        self.assertRegex(answer.stdout, r"apt-get .* install .* python3\n$")

    def test_a_user_goes_through_sudo(self):
        answer = self.answer(dpkg_query=self.ALL_BUT_LAST, id="echo 1000", apt_get="exit 9",
                             sudo='echo "sudo $*"')
        self.assertEqual(answer.returncode, 0, answer.stderr)
        self.assertRegex(answer.stdout, r"sudo .*apt-get .* install .* python3\n$")

    def assert_one_sentence(self, answer, words):
        self.assertEqual(answer.returncode, 1)
        lines = answer.stderr.strip().splitlines()
        self.assertTrue(lines[-1].startswith("tools/setup: "))
        self.assertIn(words, lines[-1])

    def test_says_why_it_cannot(self):
        self.assert_one_sentence(self.answer(), "not a Debian system")
        self.assert_one_sentence(
            self.answer(dpkg_query=self.ALL_BUT_LAST, id="echo 1000", apt_get="exit 0"),
            "cannot install python3: you are not root and there is no sudo")
        self.assert_one_sentence(
            self.answer(dpkg_query=self.ALL_BUT_LAST, id="echo 0", apt_get="exit 100"),
            "apt-get could not install python3")


class Run(unittest.TestCase):
    def test_a_missing_case_is_said_at_once(self):
        answer = run(TOOLS / "run", "no/such.yaml")
        self.assertEqual(answer.returncode, 2)
        self.assertEqual(answer.stderr, "tools/run: there is no case file no/such.yaml.\n")


if __name__ == "__main__":
    unittest.main()
