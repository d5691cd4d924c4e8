"""Many studies on this machine: pastefit batch. usage: test_batch.py PROGRAM SOURCE_DIR [unittest options]"""

import contextlib
import csv
import json
import os
import re
import signal
import subprocess
import sys
import time
import unittest
from html.parser import HTMLParser

from batches import process_of, study, write_studies
from desk import LAB, PROGRAM, Desk, run, size_of


class Batch(Desk):
    def batch(self, *arguments):
        return run("batch", *arguments, "--out", self.out, "--quiet")

    def table(self):
        with (self.out / "batch.csv").open(newline="") as file:
            return list(csv.DictReader(file))

    def cards(self, studies):
        return [(self.out / one.stem / "card.json").read_bytes() for one in studies]

    def test_each_study_gets_the_card_of_a_plain_calibration_and_a_row_in_the_table(self):
        studies = write_studies(self.folder, 2)
        result = self.batch(*studies)
        self.assertIn(result.returncode, (0, 1), result.stderr)
        for one, card in zip(studies, self.cards(studies)):
            self.calibrates(one, "--quiet", out=self.folder / "plain" / one.stem)
            self.assertEqual((self.folder / "plain" / one.stem / "card.json").read_bytes(), card)
        rows = self.table()
        self.assertEqual([row["study"] for row in rows], ["mix-00", "mix-01"])
        self.assertEqual(result.returncode == 0, all(row["verdict"] == "confirmed" for row in rows))
        for number, (row, card) in enumerate(zip(rows, map(json.loads, self.cards(studies)))):
            reading = card["tests"][0]["readings"]["step1.height_mm"]
            self.assertEqual(float(row["measured_step1.height_mm"]), reading["measured"])
            self.assertEqual(float(row["simulated_step1.height_mm"]), reading["simulated"])
            self.assertAlmostEqual(float(row["deviation_step1.height_mm"]), reading["difference"])
            self.assertEqual(float(row["strength_pa"]), card["material"]["parameters"]["strength_pa"])
            interval = card.get("intervals", {}).get("parameters", {}).get("strength_pa", {})
            self.assertEqual(row["lower_strength_pa"], str(interval.get("lower", "")))
            lower, upper = json.loads(studies[number].read_text())["parameters"]["strength_pa"]["free"]
            at_bounds = [interval.get("lower") == lower, interval.get("upper") == upper]
            self.assertEqual(row["at_bounds_strength_pa"], {(True, True): "both", (True, False): "lower",
                                                            (False, True): "upper"}.get(tuple(at_bounds), ""))
            self.assertEqual(float(row["mix.water_kg_m3"]), 250 - 4 * number)
            self.assertEqual(float(row["material.bulk_density_kg_m3"]), 2300)
            self.assertEqual(int(row["simulations"]), card["search"]["simulations"])
            self.assertGreater(float(row["core_s"]), 0)
            self.assertTrue(0 <= float(row["sheared_share"]) <= 1)

    def test_a_study_that_cannot_be_met_stops_no_other_and_stands_on_top_of_the_page(self):
        studies = write_studies(self.folder, 3)
        changed = study(1)
        changed["parameters"]["strength_pa"] = {"free": [300, 310]}  # flows away
        changed["search"]["tolerance_mm"] = 2
        studies[1].write_text(json.dumps(changed))
        result = self.batch(*studies)
        self.assertEqual(result.returncode, 1, result.stderr)
        rows = self.table()
        self.assertNotEqual(rows[1]["verdict"], "confirmed")
        self.assertTrue(rows[1]["reasons"])
        self.assertTrue(all(row["strength_pa"] for row in rows))
        page = (self.out / "batch.html").read_text()
        HTMLParser().feed(page)
        links = re.findall(r'href="([^"]+)"', page)
        self.assertEqual(links[0], "mix-01/report.html")
        self.assertEqual(sorted(links), [f"mix-0{k}/report.html" for k in range(3)])
        for link in links:
            self.assertTrue((self.out / link).exists())

    def test_a_calibration_whose_process_dies_three_times_is_a_named_failure_and_goes_on_next_time(self):
        studies = write_studies(self.folder, 2)
        for attempt in range(5):  # where the machine stalls, the calibration may be over before it was killed three times
            self.out = self.folder / f"out-{attempt}"
            command = [PROGRAM, "batch", *map(str, studies), "--out", str(self.out), "--workers", "1"]
            process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
            killed = set()
            while len(killed) < 3 and process.poll() is None:
                if (found := process_of("calibrate", str(self.out / "mix-00"))) and found[0] not in killed:
                    with contextlib.suppress(ProcessLookupError):
                        os.kill(found[0], signal.SIGKILL)
                        killed.add(found[0])
                time.sleep(0.01)
            process.communicate(timeout=60)
            if len(killed) == 3:
                break
        rows = self.table()
        self.assertEqual(rows[0]["verdict"], "failed", rows[0])
        self.assertIn("killed by signal 9, 3 times", rows[0]["reasons"])
        self.assertTrue(rows[1]["strength_pa"])
        self.batch(*studies)
        self.assertTrue(self.table()[0]["strength_pa"])

    def test_an_interrupt_ends_the_batch_and_the_same_command_goes_on(self):
        studies = write_studies(self.folder, 3, budget_simulations=40)
        for attempt in range(5):  # where the machine stalls, the second study may be over before the interrupt
            self.out = self.folder / f"out-{attempt}"
            command = [PROGRAM, "batch", *map(str, studies), "--out", str(self.out), "--workers", "1"]
            process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                       start_new_session=True)
            store = self.out / "mix-01" / "evaluations.sqlite-wal"
            while size_of(store) <= 30000 and process.poll() is None:
                time.sleep(0.02)
            with contextlib.suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGINT)  # as Ctrl-C does: to the driver and to what it runs
            start = time.monotonic()
            output, errors = process.communicate(timeout=30)
            taken_s = time.monotonic() - start
            if taken_s < 5 and self.table()[1]["verdict"] == "stopped":
                break
        self.assertLess(taken_s, 5)
        self.assertEqual(process.returncode, 1, errors)
        self.assertIn("the same command continues", errors)
        self.assertEqual([row["verdict"] for row in self.table()][1:], ["stopped", "pending"], self.table())
        first = (self.out / "mix-00" / "card.json").stat().st_mtime_ns
        again = run("batch", *studies, "--out", self.out)
        self.assertIn("mix-00: finished before", again.stderr)
        self.assertEqual((self.out / "mix-00" / "card.json").stat().st_mtime_ns, first)
        resumed = self.cards(studies)
        self.out = self.folder / "undisturbed"
        self.batch(*studies)
        self.assertEqual(self.cards(studies), resumed)

    def test_faults_of_all_studies_are_said_at_once_and_nothing_is_written(self):
        one, other = write_studies(self.folder, 2)
        other.write_text(json.dumps(study(1, screening=-1)))
        (self.folder / "elsewhere").mkdir()
        same = self.folder / "elsewhere" / one.name
        same.write_text(json.dumps(study(0)).replace("lab-00", "../lab-00"))
        result = self.batch(one, other, same, LAB, self.folder / "none.json")
        self.fails(result, 2, "search.screening", f'{same}: has the name "mix-00"', "pastefit-lab-1", "none.json", "4 errors")
        self.assertFalse(self.out.exists())
        self.fails(run("batch", one, "--out", one), 2, "is not a folder")

    def test_a_table_of_what_is_there_simulates_nothing(self):
        studies = write_studies(self.folder, 2)
        result = self.batch(*studies, "--table")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual([row["verdict"] for row in self.table()], ["pending", "pending"])
        self.assertEqual(sorted(os.listdir(self.out)), ["batch.csv", "batch.html"])

    def test_a_file_study_has_the_name_of_its_folder(self):
        folders = [self.folder / name for name in ("wet", "dry")]
        for folder in folders:
            folder.mkdir()
            write_studies(folder, 1)[0].rename(folder / "study.json")
        self.batch(*(folder / "study.json" for folder in folders), "--table")
        self.assertEqual([row["study"] for row in self.table()], ["wet", "dry"])

    def test_what_a_title_says_is_text_in_table_and_page(self):
        (file,) = write_studies(self.folder, 1)
        document = study(0)
        document["title"] = 'a "quoted", <b>bold</b> mix'
        file.write_text(json.dumps(document))
        self.batch(file, "--table")
        self.assertEqual(self.table()[0]["title"], document["title"])
        self.assertNotIn("<b>", (self.out / "batch.html").read_text())

    def test_the_scripts_for_slurm_are_scripts_of_bash_that_name_every_study(self):
        studies = write_studies(self.folder, 2)
        result = run("batch", *studies, "--out", self.out, "--slurm", "--workers", "8")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertTrue(result.stdout.startswith("sbatch --dependency=afterany:$(sbatch --parsable "), result.stdout)
        script = (self.out / "batch.sbatch").read_text()
        for words in ("--array=0-1", "--cpus-per-task=8", "--requeue", "--signal=B:USR1@120", "--open-mode=append",
                      *map(str, studies)):
            self.assertIn(words, script)
        for name in ("batch.sbatch", "batch-table.sbatch"):
            subprocess.run(["bash", "-n", self.out / name], check=True)
        self.assertEqual(sorted(os.listdir(self.out)), ["batch-table.sbatch", "batch.sbatch"])

    def test_a_percent_sign_in_a_path_is_no_wildcard_of_slurm_and_a_line_break_no_command(self):
        studies = write_studies(self.folder, 1)
        out = self.folder / "45%aggregate"
        self.assertEqual(run("batch", *studies, "--out", out, "--slurm").returncode, 0)
        for name in ("batch.sbatch", "batch-table.sbatch"):
            line, = (line for line in (out / name).read_text().splitlines() if line.startswith("#SBATCH --output="))
            self.assertIn("45%%aggregate/slurm-", line)
        for evil in ("mix\ntouch planted\n#", "mix\\one"):
            self.fails(run("batch", *studies, "--out", self.folder / evil, "--slurm"), 2, "--out", "line break")
        inside = self.folder / "a\nb"
        inside.mkdir()
        self.fails(run("batch", *studies, "--out", "out", "--slurm", cwd=inside), 2, "working folder")

    def test_more_studies_than_an_array_of_slurm_has_elements_are_several_arrays(self):
        study, = write_studies(self.folder, 1)
        files = [study]
        for number in range(1000):
            files.append(study.with_name(f"more-{number}.json"))
            files[-1].write_text(study.read_text())
        result = run("batch", *files, "--out", self.out, "--slurm")
        self.assertEqual(result.returncode, 0, result.stderr)
        arrays = {name: re.search(r"--array=0-(\d+)", (self.out / name).read_text())[1]
                  for name in ("batch.sbatch", "batch-2.sbatch")}
        self.assertEqual(arrays, {"batch.sbatch": "999", "batch-2.sbatch": "0"})
        self.assertEqual(result.stdout.count(":$(sbatch --parsable "), 2)

    def test_no_cell_of_the_table_is_a_formula(self):
        study, = write_studies(self.folder, 1)
        content = json.loads(study.read_text())
        for title in ("=HYPERLINK(0)", "+1", "-1", "@SUM(1)"):
            study.write_text(json.dumps({**content, "title": title}))
            run("batch", study, "--out", self.out, "--table")
            row, = self.table()
            self.assertEqual(row["title"], "'" + title)

    def test_a_study_with_a_name_that_is_no_folder_s_is_refused(self):
        file, = write_studies(self.folder, 1)
        dots = file.rename(self.folder / "...json")
        self.fails(self.batch(dots), 2, "...json")
        self.assertFalse(self.out.exists())

    def test_a_file_in_place_of_a_study_s_folder_fails_this_study_alone(self):
        studies = write_studies(self.folder, 2)
        self.out.mkdir()
        (self.out / "mix-00").write_text("precious")
        result = self.batch(*studies)
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertEqual((self.out / "mix-00").read_text(), "precious")
        self.assertIn("mix-00", result.stderr)
        self.assertTrue(self.table()[1]["strength_pa"])

    def test_a_study_whose_page_cannot_be_written_is_named(self):
        studies = write_studies(self.folder, 1)
        (self.out / "mix-00" / "report.html").mkdir(parents=True)
        self.fails(self.batch(*studies), 1, "mix-00", "report.html")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:], verbosity=2)
