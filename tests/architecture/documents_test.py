#!/usr/bin/python3
"""The documents tell the truth: links lead somewhere, named paths exist, the study in the README is accepted, its verbs exist.

FREESTAND names the program; without it the last two are skipped.
"""
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
DOCUMENTS = ("README.md", "CONTRIBUTING.md", "CHANGELOG.md")
PROGRAM = os.environ.get("FREESTAND", "")


def text(name):
    return (ROOT / name).read_text(encoding="utf-8")


class Documents(unittest.TestCase):
    def test_links_lead_somewhere(self):
        for name in DOCUMENTS:
            links = [link for link in re.findall(r"\]\(([^)#\s]+)\)", text(name)) if "://" not in link]
            for link in links:
                with self.subTest(f"{name}: {link}"):
                    self.assertTrue((ROOT / link).exists())
        self.assertGreater(len(re.findall(r"\]\(", text("README.md"))), 10)

    def test_named_paths_exist(self):
        pattern = re.compile(r"`((?:src|include|tests|configs|jobs|postprocess)/[\w./]+)`")
        for name in DOCUMENTS:
            for path in pattern.findall(text(name)):
                if "NAME" not in path:
                    with self.subTest(f"{name}: {path}"):
                        self.assertTrue((ROOT / path).exists())

    def test_commands_of_code_blocks_exist(self):
        scripts = set()
        for name in DOCUMENTS:
            for block in re.findall(r"```\n(.*?)```", text(name), re.S):
                scripts |= set(re.findall(r"(?:^|\s)((?:jobs|tests)/[\w.]+)", block))
        self.assertIn("jobs/quickstart", scripts)
        for script in scripts:
            with self.subTest(script):
                self.assertTrue(os.access(ROOT / script, os.X_OK))

    def test_every_source_folder_is_in_the_table(self):
        for folder in sorted((ROOT / "src").iterdir()):
            if any(folder.glob("*.cpp")):
                with self.subTest(folder.name):
                    self.assertIn(f"`src/{folder.name}`", text("README.md"))

    def test_presets_are_those_of_cmake(self):
        presets = set(re.findall(r'"name": "(\w+)", "inherits"', text("CMakePresets.json")))
        self.assertEqual(set(re.findall(r"^\| `(\w+)` \|", text("CONTRIBUTING.md"), re.M)), presets)

    def test_version_is_the_newest_of_the_changes(self):
        version = re.search(r"VERSION (\d+\.\d+\.\d+)", text("CMakeLists.txt")[text("CMakeLists.txt").index("project("):]).group(1)
        self.assertEqual(re.search(r"^## (\S+)", text("CHANGELOG.md"), re.M).group(1), version)


@unittest.skipUnless(PROGRAM, "no program (FREESTAND is not set)")
class WithProgram(unittest.TestCase):
    def test_study_of_the_readme_is_accepted(self):
        (parts, laboratory, study) = re.findall(r"```yaml\n(.*?)```", text("README.md"), re.S)  # effects and chain, files of a laboratory, a whole study
        self.check(study)
        self.check(study + parts)
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "lab.yaml"
            path.write_text(laboratory, encoding="utf-8")
            result = subprocess.run([PROGRAM, "import", path, "-o", pathlib.Path(folder) / "bench"], capture_output=True, text=True, timeout=60)
        self.assertIn("table_01.txt cannot be read", result.stderr)  # all that is wrong with it here

    def check(self, study):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "study.yaml"
            path.write_text(study, encoding="utf-8")
            result = subprocess.run([PROGRAM, "run", path, "--check"], capture_output=True, text=True, timeout=60)
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_verbs_of_the_readme_are_those_of_the_program(self):
        told = subprocess.run([PROGRAM, "--help"], capture_output=True, text=True, timeout=60).stdout
        verbs = set(re.findall(r"^  (\w+)  ", told[told.index("Subcommands"):], re.M))
        table = text("README.md")[text("README.md").index("| verb |"):].split("\n\n")[0]
        named = set(re.findall(r"`(\w+) (?:\[?[A-Z]|-o )", table))
        self.assertEqual(named, verbs)


if __name__ == "__main__":
    unittest.main()
