#!/usr/bin/env python3
"""Reads the output of `simulate --vtk` with VTK's own reader (Debian: python3-vtk9); skipped without it.

usage: read_vtk.py PROGRAM SOURCE_DIR
"""

import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

try:
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
except ImportError:
    print("skipped: there is no python3-vtk9 (.ci/install .ci/packages-page.txt)")
    sys.exit(77)

PROGRAM, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2])


def poly_data(file):
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(str(file))
    faults = []
    reader.AddObserver("ErrorEvent", lambda *_: faults.append(file))
    reader.Update()
    assert not faults, faults
    return reader.GetOutput()


def columns(data):
    return {data.GetArrayName(i): vtk_to_numpy(data.GetArray(i)) for i in range(data.GetNumberOfArrays())}


class Series(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="pastefit-vtk-")
        cls.addClassCleanup(cls.folder.cleanup)
        cls.out = pathlib.Path(cls.folder.name)
        lab = SOURCE / "data/studies/concrete-mix-20.json"
        result = subprocess.run([PROGRAM, "simulate", lab, "--set", "grains.radius_mm=14", "--vtk", "0.1", "--out", cls.out],
                                capture_output=True, text=True)
        assert result.returncode == 0, result.stderr

    def series(self, name):
        """(time, file) of every frame of a series."""
        text = (self.out / f"{name}.pvd").read_text()
        return [(float(time), self.out / file) for time, file in re.findall(r'timestep="([^"]*)" file="([^"]*)"', text)]

    def test_all_series_have_the_same_times(self):
        times = [time for time, _ in self.series("grains")]
        self.assertEqual(times, sorted(times))
        for layer in ("links", "walls"):
            self.assertEqual([time for time, _ in self.series(f"grains-{layer}")], times)
        self.assertTrue(self.series("filling-walls"))

    def test_grains_have_their_columns_and_the_links_agree_with_them(self):
        pairs = list(zip(self.series("grains"), self.series("grains-links")))
        for (_, grains_file), (_, links_file) in pairs[1:]:  # before the first step no contact is known
            grains, links = poly_data(grains_file), poly_data(links_file)
            of_grains, of_links = columns(grains.GetPointData()), columns(links.GetCellData())
            self.assertEqual(set(of_grains), {"radius", "velocity", "spin", "coordination"})
            self.assertEqual(set(of_links), {"touching", "overlap", "force"})
            self.assertEqual(grains.GetNumberOfVerts(), grains.GetNumberOfPoints())
            self.assertEqual(links.GetNumberOfLines(), len(of_links["touching"]))
            self.assertEqual(of_grains["coordination"].sum(), 2 * of_links["touching"].sum())
            self.assertTrue((of_links["overlap"][of_links["touching"] == 1] > 0).all())
            # A bridge that does not touch pulls; the length of its line says how far apart the grains are.
            apart = of_links["touching"] == 0
            self.assertTrue((of_links["force"][apart] <= 0).all())
            ends = vtk_to_numpy(links.GetPoints().GetData()).reshape(-1, 2, 3)
            length = ((ends[:, 0] - ends[:, 1]) ** 2).sum(axis=1) ** 0.5
            radius = of_grains["radius"][0]
            self.assertLess(abs(length - (2 * radius - of_links["overlap"])).max(), 1e-9)
        self.assertGreater(of_grains["coordination"].mean(), 3)

    def test_mould_and_table_are_surfaces_until_the_mould_is_gone(self):
        first, last = poly_data(self.series("grains-walls")[0][1]), poly_data(self.series("grains-walls")[-1][1])
        self.assertEqual(sorted(set(columns(first.GetCellData())["wall"])), [0, 1, 2])
        self.assertEqual(sorted(set(columns(last.GetCellData())["wall"])), [0, 1])
        mould = vtk_to_numpy(first.GetPoints().GetData())[8:]  # behind table and ground
        self.assertAlmostEqual(mould[:, 2].max() - mould[:, 2].min(), 0.3)
        self.assertAlmostEqual((mould[:, 0] ** 2 + mould[:, 1] ** 2).max() ** 0.5, 0.1)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:], verbosity=2)
