"""Devices, FIFOs, sockets and symbolic links as input or output: none is replaced, and none blocks the program.

usage: test_special_files.py PROGRAM SOURCE_DIR [unittest options]
"""

import contextlib
import json
import os
import resource
import sqlite3
import stat
import subprocess
import sys
import threading
import unittest
import xml.etree.ElementTree as xml

from desk import CARD, PROGRAM, STUDY, Desk, coarse_card, run

HASTY = {"timeout": 20}  # seconds; what waits for a FIFO waits for ever


def quickly(*arguments, **options):
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, **HASTY, **options)


class SpecialFiles(Desk):
    def special_files(self):
        """One of each kind that is here to be had, by name."""
        fifo, link, dangling = (self.folder / name for name in ("fifo", "link", "dangling"))
        os.mkfifo(fifo)
        target = self.folder / "target"
        target.write_text("somebody's")
        link.symlink_to(target)
        dangling.symlink_to(self.folder / "nowhere")
        found = {"fifo": fifo, "link": link, "dangling": dangling}
        device = self.folder / "null"
        with contextlib.suppress(OSError):  # not everybody may make one
            os.mknod(device, stat.S_IFCHR | 0o666, os.makedev(1, 3))
            device.write_bytes(b"")  # nor use it, where the file system has none
            found["device"] = device
        return found

    def assert_as_before(self, kinds):
        for name, file in kinds.items():
            mode = os.lstat(file).st_mode
            is_right = {"fifo": stat.S_ISFIFO, "device": stat.S_ISCHR}.get(name, stat.S_ISLNK)
            self.assertTrue(is_right(mode), f"{name} was replaced")
        self.assertEqual((self.folder / "target").read_text(), "somebody's")
        self.assertFalse((self.folder / "nowhere").exists())

    def test_force_replaces_no_special_file_in_a_folder_of_results(self):
        kinds = self.special_files()
        for name, file in kinds.items():
            with self.subTest(name):
                out = self.folder / f"out-{name}"
                out.mkdir()
                os.rename(file, out / "card.json")
                result = quickly("calibrate", STUDY, "--out", out, "--force")
                self.fails(result, 2, "card.json", "is a")
                self.assertEqual(os.listdir(out), ["card.json"])
                os.rename(out / "card.json", file)
        self.assert_as_before(kinds)

    def test_a_link_given_as_a_file_to_write_is_refused_before_anything_runs(self):
        kinds = self.special_files()
        for name in ("link", "dangling"):
            for command in (["rescale", CARD, "--radius", 12, "--packings", 0, "--out"], ["check", CARD, "--junit"],
                            ["simulate", CARD, "--checkpoint"]):
                with self.subTest(name, command=command[0]):
                    force = [] if command[0] == "simulate" else ["--force"]
                    self.fails(quickly(*command, kinds[name], *force), 2, "symbolic link")
        self.assert_as_before(kinds)

    def test_planted_links_are_not_followed_and_files_of_others_not_overwritten(self):
        card, victim = coarse_card(), self.folder / "victim"
        victim.write_text("somebody's")
        out = self.folder / "new.json"
        for name in ("new.json.pastefit-probe", ".pastefit-probe"):
            (self.folder / name).symlink_to(victim)
        # The number of the next process can be foretold: a shell that becomes the program keeps its own.
        script = ('for name in new.json.$$.part; do ln -s victim "$name"; done; echo mine >new.json.$$-1.part; '
                  'exec "$0" "$@"')
        result = subprocess.run(["sh", "-c", script, PROGRAM, "rescale", card, "--radius", "11", "--packings", "0", "--out", out],
                                cwd=self.folder, capture_output=True, text=True, **HASTY)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(victim.read_text(), "somebody's")
        self.assertIn("pastefit-card", out.read_text())
        mine, = self.folder.glob("new.json.*-1.part")
        self.assertEqual(mine.read_text(), "mine\n")

    def test_a_device_takes_what_is_written_and_stays_one(self):
        kinds = self.special_files()
        if "device" not in kinds:
            self.skipTest("no device can be made here")
        result = quickly("rescale", CARD, "--radius", 12, "--packings", 0, "--out", kinds["device"], "--force")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assert_as_before(kinds)

    def test_a_fifo_takes_what_is_written_and_stays_one(self):
        kinds, read = self.special_files(), []
        reader = threading.Thread(target=lambda: read.append(kinds["fifo"].read_text()), daemon=True)
        reader.start()
        result = quickly("rescale", CARD, "--radius", 12, "--packings", 0, "--out", kinds["fifo"])
        reader.join(HASTY["timeout"])
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(json.loads(read[0])["format"], "pastefit-card-6")
        self.assert_as_before(kinds)

    def test_standard_output_named_as_a_file_gets_the_card_alone(self):
        for name in ("-", "/dev/stdout"):
            with self.subTest(name):
                result = quickly("rescale", CARD, "--radius", 12, "--packings", 0, "--out", name)
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertEqual(json.loads(result.stdout)["material"]["grains"]["radius_m"], 0.012)

    def test_standard_output_named_as_a_file_gets_the_junit_report_alone(self):
        result = run("check", coarse_card(), "--junit", "-", "--quick")
        self.assertEqual(xml.fromstring(result.stdout).tag, "testsuite")

    def test_no_input_is_waited_for_or_read_without_end(self):
        kinds = self.special_files()
        endless = self.folder / "zero"
        inputs = [kinds["fifo"]]
        with contextlib.suppress(OSError):
            os.mknod(endless, stat.S_IFCHR | 0o666, os.makedev(1, 5))
            inputs.append(endless)
        for file in inputs:
            for command in (["simulate", file], ["show", file], ["calibrate", file, "--out", self.out], ["check", file],
                            ["check", CARD, "--against", file], ["simulate", CARD, "--checkpoint", file],
                            ["infer", file, "--from", self.folder], ["export", "--unconfirmed", file, "--to", "csv", "--out", self.out]):
                with self.subTest(file.name, command=command[:2]):
                    result = quickly(*command)
                    self.assertEqual(result.returncode, 2, result.stderr)
                    self.assertRegex(result.stdout + result.stderr, "is (a FIFO|a device|not a regular file)")

    def test_an_empty_checkpoint_is_called_what_it_is(self):
        empty = self.folder / "empty"
        empty.write_bytes(b"")
        self.fails(quickly("simulate", CARD, "--checkpoint", empty), 2, "is not a checkpoint of pastefit")
        self.assertEqual(empty.read_bytes(), b"")

    def test_a_file_size_limit_is_told_and_kills_nothing(self):
        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096))

        result = quickly("rescale", CARD, "--radius", 12, "--packings", 0, "--out", self.folder / "card.json",
                         preexec_fn=limit)
        self.fails(result, 1, "File too large")
        self.assertFalse((self.folder / "card.json").exists())


class Stores(Desk):
    @classmethod
    def setUpClass(cls):
        cls.maker = Desk()
        cls.maker.setUp()
        cls.addClassCleanup(cls.maker.doCleanups)
        cls.study_file = cls.maker.study()
        cls.maker.calibrates(cls.study_file)

    def copy(self):
        for name in ("card.json", "evaluations.sqlite"):
            (self.folder / name).write_bytes((self.maker.out / name).read_bytes())
        return self.folder / "evaluations.sqlite"

    def test_a_dangling_link_in_place_of_the_store_makes_no_file_elsewhere(self):
        self.out.mkdir()
        (self.out / "evaluations.sqlite").symlink_to(self.folder / "elsewhere.sqlite")
        for option in ([], ["--force"], ["--resume"]):
            self.assertEqual(quickly("calibrate", self.study_file, "--out", self.out, *option).returncode, 2)
        self.assertEqual(quickly("infer", self.study_file, "--from", self.out).returncode, 2)
        self.assertFalse((self.folder / "elsewhere.sqlite").exists())

    def test_a_view_in_place_of_a_table_is_not_run(self):
        store = self.copy()
        with contextlib.closing(sqlite3.connect(store)) as database:
            database.execute("ALTER TABLE evaluations RENAME TO real_ones")
            database.execute("CREATE VIEW evaluations AS WITH RECURSIVE n(i) AS "
                             "(SELECT 1 UNION ALL SELECT i + 1 FROM n) SELECT * FROM real_ones, n")
            database.commit()
        self.fails(quickly("infer", self.study_file, "--from", self.folder), 2, "other tables or views")

    def test_a_reading_that_nothing_has_is_set_aside_whatever_its_checksum(self):
        store = self.copy()

        def checksum(row):
            """As the program does it: 64-bit FNV-1a over the lengths and texts of the columns."""
            value = 0xcbf29ce484222325
            for byte in "".join(f"{len(text.encode())}:{text}" for text in row).encode():
                value = ((value ^ byte) * 0x100000001b3) % 2 ** 64
            return f"{value:016x}"

        with contextlib.closing(sqlite3.connect(store)) as database:
            for sequence, *row in database.execute("SELECT * FROM evaluations").fetchall():
                texts = [str(sequence), *map(str, row)]
                self.assertEqual(checksum(texts[:-1]), texts[-1], "the test knows the checksum")
                readings = json.loads(texts[6])
                if not readings:
                    continue
                readings["step1.height_mm"] = 1e200
                texts[6] = json.dumps(readings, separators=(",", ":"))
                database.execute("UPDATE evaluations SET observables = ?, checksum = ? WHERE sequence = ?",
                                 (texts[6], checksum(texts[:-1]), sequence))
            database.commit()
        result = quickly("infer", self.study_file, "--from", self.folder)
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertIn("set aside", result.stderr)
        self.assertNotIn("stoi", result.stderr)

    def test_a_calibration_in_a_read_only_folder_can_be_read(self):
        self.copy()
        os.chmod(self.folder / "evaluations.sqlite", 0o444)
        os.chmod(self.folder, 0o555)
        self.addCleanup(os.chmod, self.folder, 0o755)
        if os.geteuid() == 0:
            command = ["setpriv", "--reuid=65534", "--regid=65534", "--clear-groups", PROGRAM]
            os.chmod(self.maker.folder, 0o755)
        else:
            command = [PROGRAM]
        try:
            result = subprocess.run([*command, "infer", str(self.study_file), "--from", str(self.folder)],
                                    capture_output=True, text=True, **HASTY)
        except OSError as error:
            self.skipTest(f"nobody else can be had here: {error}")
        if result.stderr.startswith("setpriv: "):
            self.skipTest(f"nobody else can be had here: {result.stderr}")
        if "Permission denied" in result.stderr and "sqlite" not in result.stderr:
            self.skipTest("somebody else may not run the program here")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(sorted(os.listdir(self.folder)), ["card.json", "evaluations.sqlite"])

    def test_no_material_is_an_answer_in_json_too(self):
        result = run("calibrate", self.study_file, "--out", self.out, "--json", "--wall-budget", "0.001")
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertFalse((self.out / "card.json").exists())
        answer = json.loads(result.stdout)
        self.assertEqual(answer["status"], "stopped")
        self.assertIn("stopped", answer["reason"])


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]], verbosity=2)
