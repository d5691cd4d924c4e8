"""A laboratory's table as a workbook (.xlsx, ECMA-376), as Excel and other programs write it, and the sheet to print.

usage: test_workbooks.py PROGRAM SOURCE_DIR [unittest options]
"""

import html
import json
import random
import re
import sys
import unittest
import zipfile

from desk import Desk, run

MAIN = "http://schemas.openxmlformats.org/spreadsheetml/2006/main"
RELATIONS = "http://schemas.openxmlformats.org/officeDocument/2006/relationships"
PACKAGE = "http://schemas.openxmlformats.org/package/2006/relationships"


class Workbooks(Desk):
    def workbook(self, sheet, strings=None, prefix="", target="worksheets/sheet2.xml"):
        """A workbook whose first sheet is hidden and whose second one has the rows `sheet` in XML."""
        x = prefix + ":" if prefix else ""
        space = f'xmlns{":" + prefix if prefix else ""}="{MAIN}" xmlns:r="{RELATIONS}"'
        parts = {
            "xl/workbook.xml": f'<{x}workbook {space}><{x}sheets><{x}sheet name="old" sheetId="1" state="hidden" r:id="rId1"/>'
                               f'<{x}sheet name="tests" sheetId="2" r:id="rId2"/></{x}sheets></{x}workbook>',
            "xl/_rels/workbook.xml.rels": f'<Relationships xmlns="{PACKAGE}"><Relationship Id="rId1" Target="worksheets/sheet1.xml"/>'
                                          f'<Relationship Id="rId2" Target="{target}"/></Relationships>',
            "xl/worksheets/sheet1.xml": f"<{x}worksheet {space}><{x}sheetData/></{x}worksheet>",
            "xl/worksheets/sheet2.xml": f"<{x}worksheet {space}><{x}sheetData>{sheet}</{x}sheetData></{x}worksheet>",
        }
        if strings is not None:
            items = "".join(f"<si>{item}</si>" for item in strings)
            parts["xl/sharedStrings.xml"] = f'<sst xmlns="{MAIN}">{items}</sst>'
        file = self.folder / "book.xlsx"
        with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive:
            for name, text in parts.items():
                archive.writestr(name, '<?xml version="1.0" encoding="UTF-8" standalone="yes"?>\n' + text)
        return file

    def as_excel_writes(self):
        strings = ["<t>Proben vom Mai; \"Halle 3\"</t>", "<t>Probe</t>", "<t>Rohdichte</t>", "<t>Setzma\u00df [mm]</t>", "<t>kg/m\u00b3</t>",
                   '<r><t xml:space="preserve">A </t></r><r><rPr><b/></rPr><t>1</t></r><rPh sb="0" eb="1"><t>no</t></rPh>',
                   "<t>2,31</t>"]
        return self.workbook(
            '<row r="1"><c r="A1" t="s"><v>0</v></c></row>'
            '<row r="3"><c r="A3" t="s"><v>1</v></c><c r="C3" t="s"><v>2</v></c><c r="D3" t="s"><v>3</v></c></row>'
            '<row r="4"><c r="C4" t="s"><v>4</v></c></row>'
            '<row r="6"><c r="A6" t="s"><v>5</v></c><c r="C6"><v>2349.9999999999995</v></c><c r="D6"><f>170+10.1</f><v>180.10000000000002</v></c></row>'
            '<row r="7"><c r="A7" t="str"><v>A 2</v></c><c r="C7"><v>2310</v></c><c r="D7" t="e"><v>#DIV/0!</v></c></row>', strings)

    def test_the_first_visible_sheet_is_read_as_its_table(self):
        result = run("new", self.folder / "x", "--from", self.as_excel_writes(), "--mould", "abrams")
        self.assertEqual(result.returncode, 0, result.stderr)
        lab = json.loads(re.sub(r"//[^\n]*", "", (self.folder / "x/lab.json").read_text()))
        self.assertEqual(lab["material"]["bulk_density_kg_m3"], 2350)
        self.assertIn("180.1", json.dumps(lab["measurements"]))
        self.assertIn("book.xlsx, line 6", (self.folder / "x/lab.json").read_text())
        self.assertIn("7", result.stderr)  # the row without a reading

    def test_prefixed_names_texts_in_their_cells_and_absolute_paths_are_read_alike(self):
        def text(words):
            return f'<x:c t="inlineStr"><x:is><x:t>{words}</x:t></x:is></x:c>'
        rows = ("".join(map(text, ("sample", "density", "slump (cm)", "spread"))),
                text("b/1") + "<x:c><x:v>2300</x:v></x:c>" + text("18,5; 17") + "<x:c><x:v>330</x:v></x:c>")
        book = self.workbook("".join(f"<x:row>{row}</x:row>" for row in rows), prefix="x", target="/xl/worksheets/sheet2.xml")
        result = run("new", self.folder / "x", "--from", book, "--mould", "abrams")
        self.assertEqual(result.returncode, 0, result.stderr)
        written = (self.folder / "x/lab.json").read_text()
        self.assertRegex(written, r"185\.0,\s*170\.0")

    def test_what_is_no_workbook_is_refused_with_what_to_save(self):
        book = self.folder / "bad.xlsx"
        for content in (b"PK\x03\x04\x14\0\x06\0", self.as_excel_writes().read_bytes()[:700], b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1" + bytes(600)):
            with self.subTest(content[:8]):
                book.write_bytes(content)
                self.fails(run("new", self.folder / "x", "--from", book), 2, "workbook", "save it as .xlsx without a password", "CSV")
                self.assertFalse((self.folder / "x").exists())
        self.workbook('<row r="4294967295"><c r="ZZZ9" t="s"><v>99999999999</v></c></row>', []).rename(book)
        self.fails(run("new", self.folder / "x", "--from", book), 2, "no line that names a reading", "first sheet")

    def test_damaged_workbooks_end_no_run_but_with_a_message(self):
        whole, chance = self.as_excel_writes().read_bytes(), random.Random(4)
        book = self.folder / "damaged.xlsx"
        for _ in range(60):
            content = bytearray(whole)
            for _ in range(chance.randint(1, 6)):
                content[chance.randrange(len(content))] = chance.randrange(256)
            book.write_bytes(content)
            result = run("new", self.folder / "x", "--from", book, "--mould", "abrams", "--force")
            self.assertIn(result.returncode, (0, 2), result.stderr)

    def test_the_columns_of_the_printed_sheet_are_those_that_the_program_reads(self):
        for name in ("sheet", "sheet-de"):
            with self.subTest(name):
                page = run("template", name).stdout
                heads = [html.unescape(head) for head in re.findall(r"<th>([^<]+)", page)]
                rows = {"a1": (["a1", "hinged-plate", "2300", "65", "70", "68", "250", "255", "252", "110", "290", "5", ""],
                               ("step1.slump_mm", "step1.spread_mm", "step2.height_mm", "step2.spread_mm", "step2.plateau_sag_mm")),
                        "pat": (["pat", "200/200/50", "2300", "1", "1", "1", "204", "204", "204", "", "", "", "31"],
                                ("step1.spread_mm", "tilt.slide_angle_deg"))}
                for sample, (values, keys) in rows.items():
                    table = self.folder / f"{name}-{sample}.csv"
                    table.write_text(";".join(heads) + "\n" + ";".join(values) + "\n", encoding="utf-8")
                    result = run("new", self.folder / f"{name}-{sample}", "--from", table)
                    self.assertEqual(result.returncode, 0, result.stderr)
                    self.assertNotIn("not used", result.stdout + result.stderr)
                    written = (self.folder / f"{name}-{sample}" / "lab.json").read_text()
                    for key in keys:
                        self.assertIn(key, written)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
