#!/usr/bin/python3
"""Plants every kind of violation in a small tree and asks whether architecture.py finds it, and nothing else."""
import pathlib
import tempfile
import unittest

import architecture

CMAKE = """
freestand_module(base      LINKS Random123)
freestand_module(dynamics  LINKS base sundials)
freestand_module(edp       LINKS base dynamics REGISTRY)
freestand_module(effects   LINKS base dynamics REGISTRY)
freestand_module(parallel  LINKS base fmt mpi)
freestand_module(io        LINKS base fmt hdf5 mpi)  # comment: freestand_module(nobody LINKS base)
freestand_module(study     LINKS base edp io parallel fmt yaml)
freestand_program(freestand src/app LINKS study cli11)
"""
CLEAN = {
    "CMakeLists.txt": CMAKE,
    "cmake/generated.cmake": "configure_file(a ${folder}/build_info.hpp)",
    "include/freestand/public.hpp": "#include <vector>\n",
    "src/base/units.hpp": "#include <cmath>\n#include <freestand/public.hpp>\n",
    "src/dynamics/step.cpp": '#include "base/units.hpp"\n#include <cvode/cvode.h>\n#include <freestand/public.hpp>\n',
    "src/edp/edp.hpp": '#include "dynamics/step.hpp"\n',
    "src/dynamics/step.hpp": "#include <array>\n",
    "src/edp/edp.cpp": '#include "edp/edp.hpp"\n',
    "src/edp/edp_names.cpp": '#include "edp/edp.hpp"\n',
    "src/edp/slip.cpp": '#include "edp/edp.hpp"\nconst Register slip{{.name = "slip"}};\n',
    "src/parallel/ranks.cpp": "#include <mpi.h>\n#include <unistd.h>\n#include <sys/stat.h>\n",
    "src/io/file.cpp": '#include <hdf5.h>\n#include "build_info.hpp"\n',
    "src/study/read.cpp": '#include <yaml-cpp/yaml.h>\n#include "edp/edp.hpp"\n// #include "app/main.hpp" is no include\n',
    "src/app/main.cpp": '#include <CLI/CLI.hpp>\n#include "base/units.hpp"\n',
    "tests/base/units_test.cpp": '#include "dynamics/step.hpp"\n',
    "tests/hidden_effect/generator.cpp": '#include "support/floor.hpp"\n#include "base/units.hpp"\n',
    "tests/support/floor.hpp": "#include <vector>\n",
}


class Planted(unittest.TestCase):
    def problems(self, **files):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for name, text in {**CLEAN, **files.get("planted", {})}.items():
                path = root / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text, encoding="utf-8")
            return architecture.problems(root)

    def expect(self, planted, *needles):
        """Exactly one problem, which holds all needles."""
        found = self.problems(planted=planted)
        self.assertEqual(len(found), 1, found)
        for needle in needles:
            self.assertIn(needle, found[0])

    def test_rooms_see_those_before_them(self):
        module = {"CMakeLists.txt": CMAKE + "freestand_module(measurement LINKS base ROOMS data fit)\n", "src/measurement/search.hpp": "#include <span>\n",
                  "src/measurement/data/dataset.hpp": '#include "measurement/search.hpp"\n',
                  "src/measurement/fit/judge.hpp": '#include "measurement/data/dataset.hpp"\n'}
        self.assertEqual(self.problems(planted=module), [])
        self.expect({**module, "src/measurement/data/early.hpp": '#include "measurement/fit/judge.hpp"\n'}, "early.hpp", "fit comes after it")
        self.expect({**module, "src/measurement/levels.hpp": '#include "measurement/data/dataset.hpp"\n'}, "levels.hpp", "data comes after it")
        self.expect({**module, "src/measurement/attic/old.hpp": '#include "measurement/search.hpp"\n'}, "old.hpp", "attic", "none of its ROOMS")

    def test_the_judge_shares_nothing_with_the_kernel(self):
        self.expect({"tests/support/floor.hpp": '#include "dynamics/step.hpp"\n'}, "tests/support/floor.hpp", "dynamics/step.hpp", "shares nothing")
        self.expect({"tests/hidden_effect/generator.cpp": '#include "effects/x.hpp"\n'}, "tests/hidden_effect/generator.cpp", "effects/x.hpp")

    def test_clean_tree_has_no_problem(self):
        self.assertEqual(self.problems(), [])

    def test_module_that_looks_up(self):
        self.expect({"src/dynamics/bad.cpp": '#include <cmath>\n\n#include "edp/edp.hpp"\n'}, "src/dynamics/bad.cpp:3", "see edp")

    def test_include_behind_blanks(self):
        self.expect({"src/dynamics/bad.cpp": '  #  include   "edp/edp.hpp"\n'}, "bad.cpp:1", "see edp")

    def test_visible_through_another_module(self):
        self.assertEqual(self.problems(planted={"src/study/a.cpp": '#include "dynamics/step.hpp"\n'}), [])

    def test_physics_that_sees_effects(self):
        self.expect({"CMakeLists.txt": CMAKE.replace("edp       LINKS base", "edp       LINKS base effects"),
                     "src/effects/tilt.hpp": "\n", "src/edp/slip.cpp": '#include "effects/tilt.hpp"\nconst Register slip{{}};\n'},
                    "src/edp/slip.cpp:1", "no physics module")

    def test_mpi_outside_parallel_even_where_it_is_linked(self):
        self.expect({"src/io/bad.cpp": "#include <mpi.h>\n"}, "src/io/bad.cpp:1", "only src/parallel")

    def test_hdf5_outside_io(self):
        self.expect({"src/study/bad.cpp": "#include <hdf5.h>\n"}, "only src/io")

    def test_hdf5_with_quotes(self):
        self.expect({"src/study/bad.cpp": '#include "hdf5.h"\n'}, "only src/io")

    def test_yaml_outside_study(self):
        self.expect({"src/app/bad.cpp": "#include <yaml-cpp/yaml.h>\n"}, "only src/study")

    def test_package_that_is_not_linked(self):
        self.expect({"src/dynamics/bad.cpp": "#include <fmt/format.h>\n"}, "does not link fmt")

    def test_unknown_package(self):
        self.expect({"src/base/bad.cpp": "#include <boost/any.hpp>\n"}, "belongs to no package")

    def test_path_with_dots_and_path_that_leads_nowhere(self):
        self.expect({"src/edp/bad.hpp": '#include "../base/units.hpp"\n'}, "path from src/")
        self.expect({"src/edp/bad.hpp": '#include "units.hpp"\n'}, "no path from src/")

    def test_public_header_that_is_not_there(self):
        self.expect({"src/base/bad.cpp": "#include <freestand/gone.hpp>\n"}, "gone.hpp")

    def test_public_header_that_sees_a_module_or_a_package(self):
        self.expect({"include/freestand/bad.hpp": '#include "base/units.hpp"\n'}, "include/freestand/bad.hpp:1", "public header")
        self.expect({"include/freestand/bad.hpp": "#include <fmt/format.h>\n"}, "public header")

    def test_folder_that_is_no_module(self):
        self.expect({"src/stray/a.cpp": "\n"}, "src/stray", "no module")

    def test_cycle_of_modules(self):
        found = self.problems(planted={"CMakeLists.txt": CMAKE.replace("(base      LINKS", "(base      LINKS dynamics")})
        self.assertTrue(found and all("cycle" in line for line in found), found)

    def test_long_file(self):
        self.assertEqual(self.problems(planted={"src/base/long.cpp": "\n" * architecture.LINES}), [])
        self.expect({"src/base/long.cpp": "\n" * (architecture.LINES + 1)}, "src/base/long.cpp", "401 lines")

    def test_words_of_unfinished_work(self):
        for word in ("TO" + "DO", "FIX" + "ME", "XX" + "X", "place" + "holder", "not " + "implemented"):
            self.expect({"jobs/script": f"# a line\n# {word}: later\n"}, "jobs/script:2", word)

    def test_result_file_that_a_test_left_in_the_root(self):
        self.expect({"few_of_2_ranks.h5": "bytes"}, "few_of_2_ranks.h5", "in the root")

    def test_file_that_registers_nothing(self):
        self.expect({"src/edp/forgotten.cpp": '#include "edp/edp.hpp"\n'}, "src/edp/forgotten.cpp", "registers nothing")


if __name__ == "__main__":
    unittest.main()
