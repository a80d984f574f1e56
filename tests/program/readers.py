"""Read the results of small runs as other programs do, and compare their names and units with apps/run/names.md.

usage: readers.py ROOT JOB...    ROOT the repository, JOB a folder of the working folder with the results of that job
"""

import csv
import json
import math
import re
import sys
from collections import defaultdict
from pathlib import Path
from xml.etree import ElementTree

import h5py
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import (vtkXMLImageDataReader, vtkXMLPolyDataReader,
                                 vtkXMLUnstructuredGridReader)

problems = []
root, jobs = Path(sys.argv[1]), sys.argv[2:]


def problem(text):
    problems.append(text)


# ---- the page

class Row:
    """One name of the page."""

    def __init__(self, section, name, star, unit, text):
        self.section, self.name, self.is_optional = section, name, star
        self.unit, _, remark = unit.partition(", ")
        self.has_bracket = remark != "no bracket"
        self.pattern = re.compile(".+".join(re.escape(part) for part in name.split("...")))
        counts = {"six components": 6, "nine components": 9, "three components": 3}
        self.components = next((n for words, n in counts.items() if words in text), 1)

    def fits_name(self, name):
        return self.pattern.fullmatch(name) is not None

    def fits(self, name, unit):
        return self.fits_name(name) and (unit == self.unit if self.has_bracket else unit is None)


def read_page(path):
    """Rows by (job, file), and all rows."""
    rows, section, of, is_table = defaultdict(list), "", [], False
    for line in path.read_text().splitlines():
        heading = re.fullmatch(r"## (\S+) of (.+)", line)
        if line.startswith("#"):
            section = line.lstrip("# ")
            of = [(job, heading[1]) for job in heading[2].split(", ")] if heading else []
        cells = [cell.strip() for cell in re.split(r"(?<!\\)\|", line)[1:-1]]
        if len(cells) < 2:
            is_table = False
        elif cells[:2] == ["name", "unit"]:
            is_table = True
        elif is_table and of and not cells[0].startswith("---"):
            for name, star in re.findall(r"`([^`]+)`(\*?)", cells[0]):
                for key in of:
                    rows[key].append(Row(section, name, star == "*", cells[1], cells[2]))
    return rows


page = read_page(root / "apps/run/names.md")
found = defaultdict(set)  # names and units by (job, file)


def name_and_unit(text):
    parts = re.fullmatch(r"(.*) \[([^\]]*)\]", text)
    return (parts[1], parts[2]) if parts else (text, None)


def row_of(job, kind, text, where):
    """The row of the page for this name; it counts as found."""
    name, unit = name_and_unit(text)
    found[job, kind].add((name, unit))
    rows = page[job, kind]
    for row in rows:
        if row.fits(name, unit):
            return row
    is_named = any(row.fits_name(name) for row in rows)
    problem(f'{where}: "{text}" is not on the page' + (" with this unit" if is_named else ""))
    return None


# ---- summary.json

def no_json(word):
    raise ValueError(f"{word} is no JSON")


def unique(pairs):
    names = [name for name, _ in pairs]
    if len(names) != len(set(names)):
        raise ValueError(f"a name stands twice among {names}")
    return dict(pairs)


def read_members(job, value, where):
    if isinstance(value, list):
        for member in value:
            read_members(job, member, where)
    elif isinstance(value, dict):
        for name, member in value.items():
            row_of(job, "summary.json", name, where)
            read_members(job, member, where)
    elif value is None or isinstance(value, float) and not math.isfinite(value):
        problem(f"{where}: a number is not finite")


def read_summary(job, path):
    try:
        text = path.read_text(encoding="utf-8")
        read_members(job, json.loads(text, parse_constant=no_json, object_pairs_hook=unique), path)
    except ValueError as error:
        problem(f"{path}: {error}")


# ---- tables

def read_table(job, path):
    with open(path, newline="", encoding="utf-8") as file:
        names = next(csv.reader(file))
    if len(names) != len(set(names)):
        problem(f"{path}: a column stands twice")
    for name in names:
        row_of(job, path.name, name, path)
    values = np.loadtxt(path, delimiter=",", skiprows=1, ndmin=2)
    if values.shape[0] == 0 or values.shape[1] != len(names):
        problem(f"{path}: {values.shape} values under {len(names)} names")
    if not np.isfinite(values).all():
        problem(f"{path}: not all values are finite")
    if "time [s]" in names and (np.diff(values[:, names.index("time [s]")]) < 0).any():
        problem(f"{path}: time runs backwards")
    return dict(zip(names, values.T))


# ---- fields

readers = {".vtp": vtkXMLPolyDataReader, ".vtu": vtkXMLUnstructuredGridReader,
           ".vti": vtkXMLImageDataReader}


def read_vtk(path):
    """The data of a file, or None where the reader complains."""
    reader, errors = readers[path.suffix](), []
    reader.AddObserver("ErrorEvent", lambda *_: errors.append("cannot be read"))
    reader.SetFileName(str(path))
    reader.Update()
    if reader.GetErrorCode() != 0 or errors:
        problem(f"{path}: VTK cannot read it")
        return None
    return reader.GetOutput()


def lengths_of_lines(data):
    x = vtk_to_numpy(data.GetPoints().GetData())
    ends = vtk_to_numpy(data.GetLines().GetData()).reshape(-1, 3)  # 2, first, second
    return np.linalg.norm(x[ends[:, 2]] - x[ends[:, 1]], axis=1)


def read_field(job, kind, path):
    """Arrays of a file by name. Their sizes, components and numbers are checked."""
    data = read_vtk(path)
    if data is None:
        return None, {}
    if not data.GetFieldData().GetAbstractArray("made by"):
        problem(f"{path}: does not say by what it was made")
    if data.GetNumberOfPoints() > 0 and not np.isfinite(data.GetBounds()).all():
        problem(f"{path}: a point is nowhere")
    arrays, gaps = {}, {}
    for of, n in ((data.GetPointData(), data.GetNumberOfPoints()),
                  (data.GetCellData(), data.GetNumberOfCells())):
        for k in range(of.GetNumberOfArrays()):
            array = of.GetArray(k)
            if array.GetNumberOfTuples() != n:
                problem(f"{path}: {array.GetName()} has {array.GetNumberOfTuples()} values, not {n}")
            row = row_of(job, kind + ".pvd", array.GetName(), path)
            if row and array.GetNumberOfComponents() != row.components:
                problem(f"{path}: {array.GetName()} has {array.GetNumberOfComponents()} components, "
                        f"not {row.components}")
            values = vtk_to_numpy(array).reshape(n, array.GetNumberOfComponents())
            arrays[array.GetName()] = values
            gaps[array.GetName()] = ~np.isfinite(values).all(axis=1)
    if kind == "fields":  # no rock: no value of any array
        if any((gap != next(iter(gaps.values()))).any() for gap in gaps.values()):
            problem(f"{path}: some arrays have values where others have none")
        if all(gap.all() for gap in gaps.values()):
            problem(f"{path}: has no value at all")
    else:
        for name, gap in gaps.items():
            if gap.any():
                problem(f"{path}: {name} is not finite at {gap.sum()} places")
    return data, arrays


def read_series(job, path):
    """Files of a series in their order, each with its time."""
    entries = ElementTree.parse(path).getroot().findall("Collection/DataSet")
    times = [float(entry.get("timestep")) for entry in entries]
    if not entries or times != sorted(times):
        problem(f"{path}: {len(entries)} files at {times}")
    files = []
    for entry in entries:
        file = path.parent / entry.get("file")
        if file.is_file():
            files.append(file)
        else:
            problem(f"{path} names {entry.get('file')}, which is not there")
    return files


def read_fields(job, folder):
    """All series; the arrays of the particles of the last frame."""
    last, named = {}, set()
    for pvd in sorted(folder.glob("*.pvd")):
        kind = pvd.stem
        for file in read_series(job, pvd):
            named.add(file.resolve())
            data, arrays = read_field(job, kind, file)
            if data is None:
                continue
            if kind == "particles":
                last = arrays
                if len(np.unique(arrays["id"])) != data.GetNumberOfPoints():
                    problem(f"{file}: two particles have one number")
            if kind == "contacts" and data.GetNumberOfLines() > 0:
                # From centre to centre, or to a wall: a line across a periodic cell is longer.
                most = 3.0 * read_field(job, "particles", file.with_name(
                    file.name.replace("contacts", "particles")))[1]["radius"].max()
                if lengths_of_lines(data).max() > most:
                    problem(f"{file}: a force chain leads through the cell")
    for file in sorted(folder.glob("fields/*")):
        if file.resolve() not in named:
            problem(f"{file}: stands in no series")
    return last


# ---- HDF5

def read_specimen(job, path):
    """The number of its particles."""
    with h5py.File(path, "r") as file:
        for name in [*file.keys(), *file.attrs.keys()]:
            row_of(job, path.name, name, path)
        n, n_bonds = file["R"].size, file["bonds"].shape[0]
        shapes = {"x": (n, 3), "bonds": (n_bonds, 2), "bond_shifts": (n_bonds, 3)}
        for name, shape in shapes.items():
            if file[name].shape != shape:
                problem(f"{path}: {name} is {file[name].shape}, not {shape}")
        for name in ("R", "m", "S"):
            if file[name].size != n or not (file[name][...] > 0).all():
                problem(f"{path}: {name} is not positive for each of {n} particles")
        if not np.isfinite(file["x"][...]).all() or (n_bonds and file["bonds"][...].max() >= n):
            problem(f"{path}: positions or bonds that cannot be")
        return n


def read_checkpoint(path):
    def check(name, item):
        if isinstance(item, h5py.Dataset) and item.dtype.kind == "f":
            if not np.isfinite(item[...]).all():
                problem(f"{path}: {name} is not finite")

    with h5py.File(path, "r") as file:
        if not list(file.keys()):
            problem(f"{path}: is empty")
        file.visititems(check)


# ---- all of it

def read_run(job):
    folder = Path(job)
    read_summary(job, folder / "summary.json")
    tables = {path.name: read_table(job, path) for path in sorted(folder.glob("*.csv"))}
    for path in sorted(folder.glob("checkpoint_*.h5")):
        read_checkpoint(path)
    last = read_fields(job, folder)
    if (folder / "sample.h5").is_file():
        n = read_specimen(job, folder / "sample.h5")
        if last and len(last["id"]) != n:
            problem(f"{folder}: {len(last['id'])} particles in the fields, {n} in sample.h5")
    if job == "element" and last:
        # Neighbourhoods overlap: a particle with few neighbours counts in few of them.
        p, wanted = -last["stress [Pa]"][:, :3].mean(), tables["history.csv"]["p [Pa]"][-1]
        if not abs(p - wanted) < 0.1 * wanted:
            problem(f"{folder}: the mean stress of the particles is p = {p}, the history has {wanted}")


def sources():
    return "\n".join(path.read_text() for folder in ("apps", "dem", "coupling", "fem")
                     for path in sorted((root / folder).rglob("*")) if path.suffix in (".cc", ".h"))


def stands_in(text, name):
    """Whether the sources write this name, whole or of two parts."""
    name = name.split("...")[0].rstrip()
    if name in text:
        return True
    words = name.split(" ")
    return any(" ".join(words[:k]) in text and " ".join(words[k:]) in text
               for k in range(1, len(words)))


def check_page():
    text = sources() if (root / "apps/mergel.cc").is_file() else None  # None: a page alone
    for (job, kind), rows in page.items():
        if job not in jobs:
            problem(f"{kind} of {job}: there is no run of this job")
            continue
        for row in rows:
            if any(row.fits(name, unit) for name, unit in found[job, kind]):
                continue
            if not row.is_optional:
                problem(f"{row.section}: no run of {job} has `{row.name}`")
            elif text is not None and not stands_in(text, row.name):
                problem(f"{row.section}: `{row.name}` stands nowhere in the sources")


for job_ in jobs:
    read_run(job_)
check_page()
for line_ in dict.fromkeys(problems):
    print(line_)
print(f"readers: {sum(len(names) for names in found.values())} names in {len(found)} kinds of files, "
      f"{len(problems)} problems")
sys.exit(1 if problems else 0)
