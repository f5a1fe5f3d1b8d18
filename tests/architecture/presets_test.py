#!/usr/bin/python3
"""CMakePresets.json keeps what looks for errors of memory, and what calls it still does: valgrind's preset, and -fanalyzer."""
import json
import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]


def problems(presets, script):
    """One line for each thing that is lost."""
    configured = {preset["name"]: preset for preset in presets["configurePresets"]}
    built = {preset["configurePreset"] for preset in presets["buildPresets"]}
    found = []
    if "memcheck" not in configured or "memcheck" not in built:
        found.append("CMakePresets.json has no preset memcheck to configure and build")
    elif "-g" not in configured["memcheck"]["cacheVariables"].get("CMAKE_CXX_FLAGS_RELWITHDEBINFO", "").split():
        found.append("preset memcheck has no debug symbols: valgrind could not say where")
    if not re.search(r"^build memcheck\b", script, re.M) or not re.search(r"^valgrind=\(valgrind .*--error-exitcode=", script, re.M):
        found.append("tests/memcheck does not build preset memcheck and run it through valgrind")
    for name, flag in (("audit", "-Wshadow"), ("analyzer", "-fanalyzer")):
        flags = configured.get(name, {}).get("cacheVariables", {})
        if flag not in flags.get("CMAKE_CXX_FLAGS", "").split():
            found.append(f"preset {name} has no {flag}")
        if flags.get("FREESTAND_WERROR") != "ON":
            found.append(f"preset {name} lets warnings pass")
    return found


class Presets(unittest.TestCase):
    def setUp(self):
        self.presets = json.loads((ROOT / "CMakePresets.json").read_text(encoding="utf-8"))
        self.script = (ROOT / "tests/memcheck").read_text(encoding="utf-8")

    def preset(self, name):
        return next(preset for preset in self.presets["configurePresets"] if preset["name"] == name)

    def problems(self):
        return problems(self.presets, self.script)

    def test_nothing_is_lost(self):
        self.assertEqual(self.problems(), [])

    def test_a_preset_that_is_taken_out_is_missed(self):
        self.presets["configurePresets"].remove(self.preset("memcheck"))
        self.assertEqual(len(self.problems()), 1)

    def test_a_script_that_uses_another_preset_is_missed(self):
        self.script = self.script.replace("build memcheck", "build dev")
        self.assertEqual(len(self.problems()), 1)

    def test_an_analyzer_without_analysis_is_missed(self):
        flags = self.preset("analyzer")["cacheVariables"]
        flags["CMAKE_CXX_FLAGS"] = flags["CMAKE_CXX_FLAGS"].replace("-fanalyzer ", "")
        self.assertEqual(self.problems(), ["preset analyzer has no -fanalyzer"])

    def test_every_effect_goes_through_the_memory_checker(self):
        studies = "".join(study.read_text(encoding="utf-8") for study in (ROOT / "tests/memcheck_studies").glob("*.yaml"))
        for effect in sorted((ROOT / "src/effects").glob("*.cpp")):
            if effect.stem != "effects":
                with self.subTest(effect.stem):
                    self.assertIn(f"{{name: {effect.stem}", studies)
        for word in ("model: bouc_wen", "chain:", "elevation_rad:", "vertical_records:", "cross_records:", "pulse:", "neighbour:", "legs:", "start:",
                     "rest/", "contact_forces: true", "acceleration_height_m:", "slip_by_side: true", "other_gap_m:"):
            with self.subTest(word):
                self.assertIn(word, studies)


if __name__ == "__main__":
    unittest.main()
