"""What is left where the machine dies: what was synced always, of the rest sometimes all, sometimes nothing, sometimes other bytes."""

import collections
import os
import pathlib
import subprocess
import tempfile
import unittest

LIBRARY = os.environ["FAIL_ONE_CALL"]
SEEDS = range(12)
OLD, NEW = b"a" * 100, b"b" * 100

WRITES = f"""
import os, sys
folder, path = sys.argv[1], sys.argv[1] + "/file"
file, names = os.open(path, os.O_CREAT | os.O_RDWR), os.open(folder, os.O_RDONLY)
os.pwrite(file, {OLD}, 0)
os.fsync(file)
os.fsync(names)
os.pwrite(file, {NEW}, 100)
os.mkdir(folder + "/sixth")
"""
MAKES = f"""
import os, sys
path = sys.argv[1] + "/file"
file = os.open(path, os.O_CREAT | os.O_RDWR)
os.pwrite(file, {OLD}, 0)
os.fsync(file)
os.mkdir(sys.argv[1] + "/fourth")
"""
RENAMES = f"""
import os, sys
path, aside, names = sys.argv[1] + "/file", sys.argv[1] + "/aside", os.open(sys.argv[1], os.O_RDONLY)
for place, words in ((path, {OLD}), (aside, {NEW})):
    file = os.open(place, os.O_CREAT | os.O_RDWR)
    os.pwrite(file, words, 0)
    os.fsync(file)
os.fsync(names)
os.rename(aside, path)
os.mkdir(sys.argv[1] + "/ninth")
"""


class Unsynced(unittest.TestCase):
    def left(self, script, call):
        """How often which content of the file was left; None: no file."""
        found = collections.Counter()
        for seed in SEEDS:
            with tempfile.TemporaryDirectory(prefix="freestand-unsynced-") as top:
                folder = pathlib.Path(top, "folder")
                folder.mkdir()
                settings = {"FAULT_FOLDER": str(folder), "FAULT_CALL": str(call), "FAULT_KIND": "lost", "FAULT_SEED": str(seed),
                            "FAULT_TOLD": str(pathlib.Path(top, "told")), "LD_PRELOAD": LIBRARY}
                done = subprocess.run(["/usr/bin/python3", "-S", "-E", "-c", script, folder], env={**os.environ, **settings}, check=False)
                self.assertEqual(done.returncode, -9)
                self.assertEqual([path.name for path in folder.iterdir() if path.is_dir()], [])
                path = folder / "file"
                found[path.read_bytes() if path.exists() else None] += 1
        return found

    def test_writes(self):
        found = self.left(WRITES, 6)
        spoilt = sum(count for content, count in found.items() if content not in (OLD, OLD + NEW))
        self.assertTrue(all(content.startswith(OLD) for content in found), found)
        self.assertGreater(min(found[OLD + NEW], found[OLD], spoilt), 0, found)

    def test_names(self):
        self.assertEqual(set(self.left(MAKES, 4)), {None, OLD})

    def test_renames(self):
        self.assertEqual(set(self.left(RENAMES, 9)), {OLD, NEW})


if __name__ == "__main__":
    unittest.main()
