"""The package itself: complete stubs, docstrings, the tutorial's code.

usage: test_package.py PROGRAM SOURCE_DIR [unittest options]
"""

import ast
import os
import pathlib
import re
import shutil

from studies import SOURCE, Desk, main
import pastefit as pf
from pastefit import _core

PAGE = SOURCE / "calibrate/manual/python.md"
BLOCK = re.compile(r"^```python\n(.*?)^```$", re.M | re.S)
FOLDER = pathlib.Path(pf.__file__).resolve().parent


def public(names):
    return {name for name in names if not name.startswith("_")}


class Package(Desk):
    def test_the_stubs_say_what_the_extension_has(self):
        tree = ast.parse((FOLDER / "_core.pyi").read_text())
        stubs = {node.name: node for node in tree.body if isinstance(node, (ast.ClassDef, ast.FunctionDef))}
        self.assertEqual(set(stubs), public(dir(_core)))
        for name, node in stubs.items():
            if isinstance(node, ast.ClassDef):
                members = {inner.name if isinstance(inner, ast.FunctionDef) else inner.target.id for inner in node.body}
                self.assertEqual(public(members), public(dir(getattr(_core, name))), name)

    def test_a_checker_of_types_finds_them(self):
        self.assertTrue((FOLDER / "py.typed").exists())
        for file in FOLDER.glob("*.py"):
            for node in ast.walk(ast.parse(file.read_text())):
                if isinstance(node, ast.FunctionDef) and not node.name.startswith("_"):
                    self.assertIsNotNone(node.returns, f"{file.name}: {node.name}")

    def test_everything_public_has_a_docstring(self):
        for name in pf.__all__:
            thing = getattr(pf, name)
            self.assertTrue(thing.__doc__, name)
            if isinstance(thing, type) and thing.__module__.startswith("pastefit"):
                for member, value in vars(thing).items():
                    if not member.startswith("_") and callable(value):
                        self.assertTrue(value.__doc__, f"{name}.{member}")

    def test_the_tutorial_runs(self):
        blocks = BLOCK.findall(PAGE.read_text())
        self.assertGreater(len(blocks), 5)
        for folder in ("lab", "studies", "cards"):
            shutil.copytree(SOURCE / "data" / folder, self.folder / folder)
        before = os.getcwd()
        os.chdir(self.folder)
        self.addCleanup(os.chdir, before)
        seen = {"__name__": "tutorial"}
        for block in blocks:
            with self.subTest(block):
                exec(compile(block, "python.md", "exec"), seen)


if __name__ == "__main__":
    main()
