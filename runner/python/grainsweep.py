"""Reads output folders of grainsweep: tables as pandas, beds as numpy.

    import grainsweep
    s = grainsweep.open("out/quick")
    s.groups                    # a table of the folder as a pandas.DataFrame, read when first asked for
    s.units("groups")["width"]  # "d"
    s.meanings("groups")["solid_fraction"]
    bed = s.bed(s.packings.job[0])
    bed.positions, bed.radii    # numpy arrays, a row for each grain; lengths in d

Beds are read from the folder itself; contacts are found by the program, which must be on the PATH or
named by the environment variable GRAINSWEEP.
"""

import csv
import functools
import io
import json
import os
import pathlib
import shlex
import struct
import subprocess
import tempfile
import zlib

import numpy
import pandas


def open(folder):
    """The output folder of a run. Raises FileNotFoundError, saying what to do, if it has no tables."""
    if not pathlib.Path(folder, "columns.csv").is_file():
        raise FileNotFoundError(_why_no_tables(pathlib.Path(folder)))
    return Sweep(folder)


def _why_no_tables(folder):
    if not folder.is_dir():
        return f"{folder}: there is no such folder"
    if (folder / "shards").is_dir():  # of a run that is at work, or was killed
        report = f"grainsweep report {shlex.quote(str(folder))}"
        return f"{folder} has packings but no tables yet: write them with `{report}`"
    inside = sorted(f"{tables.parent}" for tables in folder.glob("*/columns.csv"))
    return (f"{folder} is no output folder of grainsweep: it has no columns.csv"
            + (f"; such folders in it: {', '.join(inside)}" if inside else ""))


# Columns that are texts even where all their cells look like numbers: 23e2135835385298 is an id.
_texts = ["job", "label", "family", "state_hash", "start"]


def _table(text):
    """Only an empty cell holds nothing: "NA" and "None" are labels, and names of files are no numbers."""
    columns = next(csv.reader(io.StringIO(text)))
    texts = _texts + [column for column in columns if column.endswith(".file")]
    return pandas.read_csv(io.StringIO(text), float_precision="round_trip", dtype=dict.fromkeys(texts, str),
                           keep_default_na=False, na_values=[""])


def _outcomes(journal):
    """Job -> what counts of it in one journal: the later line, but no exception in the place of a
    result. Lines that are torn or damaged by their length and checksum count for nothing."""
    own = {}
    for line in journal.read_bytes().split(b"\n"):
        before, _, rest = line.partition(b',"outcome":')
        text = rest[:-1]
        is_whole = before == b'{"length":%d,"crc32":"%08x"' % (len(text), zlib.crc32(text))
        if not is_whole or not rest.endswith(b"}"):
            continue
        outcome = json.loads(text)
        if not outcome["exception"] or own.get(outcome["job"], outcome)["exception"]:
            own[outcome["job"]] = outcome
    return own


class Sweep:
    """An output folder; its tables are its attributes."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self._columns = _table((self.folder / "columns.csv").read_text(encoding="utf-8")).fillna("")

    @property
    def tables(self):
        """Names of the tables: packings, groups, fits ..."""
        names = self._columns["file"].str.removesuffix(".csv").unique()
        return [name for name in names if (self.folder / f"{name}.csv").exists()]

    def __dir__(self):
        return [*super().__dir__(), *self.tables]

    def __getattr__(self, name):
        if name.startswith("_"):  # also of a sweep that is being copied, which has no members yet
            raise AttributeError(name)
        if name not in self.tables:
            raise AttributeError(f"{self.folder} has no table {name}, but {', '.join(self.tables)}")
        path = self.folder / f"{name}.csv"
        text = path.read_text(encoding="utf-8")
        if not text.endswith("\n"):
            report = f"grainsweep report {shlex.quote(str(self.folder))}"
            raise ValueError(f"{path} is cut off: write it anew with `{report}`")
        table = _table(text)
        table.attrs = {"units": self.units(name), "meanings": self.meanings(name)}
        setattr(self, name, table)
        return table

    def _explained(self, table, by):
        rows = self._columns[self._columns["file"] == f"{table}.csv"]
        return dict(zip(rows["column"], rows[by]))

    def units(self, table):
        """Column -> unit, "" of a number or a word: d, m g."""
        return self._explained(table, "unit")

    def meanings(self, table):
        """Column -> what it says."""
        return self._explained(table, "meaning")

    @functools.cached_property
    def provenance(self):
        """provenance.json: the sweep file and how its packings were made."""
        return json.loads((self.folder / "provenance.json").read_text(encoding="utf-8"))

    @functools.cached_property
    def _places(self):
        """Job -> file, first byte and number of bytes of its bed. Of several journals the packing
        that was finished later counts, but none that ended in an exception before a result."""
        counting = {}
        for journal in sorted(self.folder.glob("shards/*.jsonl")):
            for job, outcome in _outcomes(journal).items():
                rank = not outcome["exception"], outcome["finished_at"]
                if job not in counting or rank >= counting[job][0]:
                    place = outcome["stored_at"], outcome["stored_bytes"]
                    counting[job] = rank, (journal.with_suffix(".beds"), *place)
        return {job: place for job, (_, place) in counting.items() if place[2] > 0}

    def bed(self, job):
        """The bed of a packing, by its id: column job of packings. Raises KeyError if it has none."""
        if job not in self._places:
            raise KeyError(self._why_no_bed(job))
        file, at, size = self._places[job]
        with file.open("rb") as beds:
            beds.seek(at)
            bed = Bed(self.folder, job, beds.read(size))
        if len(bed.positions) == 0:
            raise KeyError(f"{job}: stored without grains, by run --no-grains")
        return bed


    def _why_no_bed(self, job):
        if job in set(self.packings["job"]):
            return (f"{job}: no bed is stored in {self.folder}, or its line in a journal is damaged; see its "
                    "status and reason in packings, and what `grainsweep status` says of the folder")
        return f"{job}: no packing of {self.folder} has this id; ids are in column job of packings"


class _Bytes:
    """What runner/store/archive.hpp writes, value after value."""

    def __init__(self, stored):
        self._bytes, self._at = stored, 0

    def one(self, kind):
        (value,) = struct.unpack_from("<" + kind, self._bytes, self._at)
        self._at += struct.calcsize("<" + kind)
        return value

    def column(self, kind):
        """Structs of one size, with their number before them."""
        values = numpy.frombuffer(self._bytes, numpy.dtype(kind), self.one("Q"), self._at)
        self._at += values.nbytes
        return values


_mark = b"GRAINS14\n"
_grain = [("position", "<f8", 3), ("radius", "<f8"), ("force", "<f8"), ("coordination", "<i4")]


class Bed:
    """A bed at rest, in d and m g; row k of each array is grain k of the contacts.

    positions, radii; forces, the sum of the contact forces on each grain; coordination, its touching
    neighbours; box, a dict with length, width, periodic (along x, y) and tube. Of polyhedra also
    orientations, quaternions x, y, z, w from the shape to the box, and vertices and faces of a grain
    of size 1: a vertex lies at position + 2 radius times the turned vertex. Of a mixture meshes has
    vertices and faces of each component, none of spheres, and components which of them each grain is.
    None of others.
    """

    def __init__(self, folder, job, stored):
        if not stored.startswith(_mark) or zlib.crc32(stored[:-4]) != _Bytes(stored[-4:]).one("I"):
            raise ValueError(f"{folder}: the bed of {job} is damaged, or of another version")
        self._folder, self.job = folder, job
        data = _Bytes(stored[len(_mark) : -4])
        own = data.column("S1").tobytes().decode()
        if own != job:
            raise ValueError(f"{folder}: in the place of the bed of {job} stands that of {own}")
        data.one("Q")  # the hash of the state
        length, width, x, y, tube = (data.one(kind) for kind in "ddii?")
        self.box = {"length": length, "width": width, "periodic": (x == 0, y == 0), "tube": tube}
        for kind in ["V48"] * 4 + ["<f8"] * 2:  # curves, which the tables have
            data.one("d"), data.column(kind)
        data.column("V32")  # sizes, likewise
        for _ in range(data.one("Q")):  # components, likewise
            [data.one(kind) for kind in "qqddddd"], data.column("<f8"), [data.one("d") for _ in range(3)]
            data.column("V24")  # contacts by kind
            for _ in range(4):  # profiles
                data.one("d")
                for _ in range(data.one("Q")):
                    data.one("d"), data.one("q"), data.column("<i8"), [data.one(kind) for kind in "qddd"]
        grains = data.column(_grain)
        self.positions, self.radii = grains["position"], grains["radius"]
        self.forces, self.coordination = grains["force"], grains["coordination"]
        self.vertices = self.faces = self.orientations = self.meshes = self.components = None
        if data.one("?"):
            meshes = [(data.column(("<f8", 3)), [data.column("<i4") for _ in range(data.one("Q"))])
                      for _ in range(data.one("Q"))]
            components, self.orientations = data.column("u1"), data.column(("<f8", 4))
            if len(components) == 0:
                ((self.vertices, self.faces),) = meshes
            else:
                self.meshes, self.components = meshes, components

    @functools.cached_property
    def contacts(self):
        """Every contact, a row each: a and b, rows of the grains, b -1 of a wall, which wall names;
        kind, gap, force, the unit normal (nx, ny, nz) from a to b and a point (x, y, z) of the contact.
        Those with a gap below the widest gap tolerance of the packing, and all that bear a force.
        """
        program = os.environ.get("GRAINSWEEP", "grainsweep")
        with tempfile.TemporaryDirectory() as to:
            subprocess.run(
                [program, "export", self._folder, "--job", self.job, "--format", "contacts", "--quiet",
                 "--to", to],
                check=True, stdout=subprocess.DEVNULL)
            (file,) = pathlib.Path(to).glob("*.contacts.csv")
            contacts = _table(file.read_text(encoding="utf-8"))
        contacts["b"] = contacts["b"].fillna(0).astype(int) - 1  # ids begin with 1
        contacts["a"] -= 1
        return contacts.fillna({"wall": "", "size_class_b": ""})
