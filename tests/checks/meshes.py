"""gmsh fills the void between the grains of STL files and their container, the last solid of each, with
tetrahedra: it refuses surfaces that cross or touch, and what it fills is the container less the grains.
usage: meshes.py LONGEST FILE...; LONGEST: side of a triangle that is not divided, d. Writes void.* beside.
"""
import re
import subprocess
import sys
import numpy

def volume(triangles):
    return numpy.einsum("ij,ij->", triangles[:, 0], numpy.cross(triangles[:, 1], triangles[:, 2])) / 6

def solids(file):
    """Triangles of each solid; the last one is the container."""
    data = open(file, "rb").read()
    if data.startswith(b"solid"):  # text, as bites.sh writes it
        texts = re.findall(r"^solid (.*?)^endsolid", data.decode(), re.M | re.S)
        numbers = [re.findall(r"^vertex (\S+) (\S+) (\S+)", text, re.M) for text in texts]
        return [numpy.array(of_solid, float).reshape(-1, 3, 3) for of_solid in numbers]
    triangles = numpy.frombuffer(data, [("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("id", "<u2")], offset=84)
    assert len(triangles) == int.from_bytes(data[80:84], "little"), f"{file}: wrong number of triangles"
    starts = numpy.flatnonzero(numpy.diff(triangles["id"], prepend=-1))
    assert triangles["id"][starts[-1]] == 0, f"{file}: the last surface is no container"
    return numpy.split(triangles["corners"].astype(float), starts[1:])

def stl(name, triangles):
    corners = ["outer loop\n" + "".join("vertex %.17g %.17g %.17g\n" % tuple(v) for v in t) + "endloop" for t in triangles]
    return f"solid {name}\n" + "".join(f"facet normal 0 0 0\n{c}\nendfacet\n" for c in corners) + f"endsolid {name}\n"

def tetrahedra(mesh):
    """Volumes of the tetrahedra of a mesh file of format 2.2."""
    lines = open(mesh).read().split("\n")
    first = lines.index("$Nodes") + 2
    nodes = {int(w[0]): w[1:4] for w in map(str.split, lines[first:first + int(lines[first - 1])])}
    first = lines.index("$Elements") + 2
    words = map(str.split, lines[first:first + int(lines[first - 1])])
    corners = numpy.array([[nodes[int(k)] for k in w[-4:]] for w in words if w[1] == "4"], float)
    a, b, c, d = corners.transpose(1, 0, 2)
    return numpy.einsum("ij,ij->i", b - a, numpy.cross(c - a, d - a)) / 6

def halved(triangle, longest):
    """Parts of a triangle with no side longer; two triangles halve the side that they share alike."""
    sides = [numpy.linalg.norm(triangle[k] - triangle[(k + 1) % 3]) > longest for k in range(3)]
    a, b, c = triangle
    if not any(sides):
        return [triangle]
    if all(sides):
        ab, bc, ca = (a + b) / 2, (b + c) / 2, (c + a) / 2
        parts = [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
    else:  # cut at a long side with the opposite corner; the parts are looked at again
        k = sides.index(True)
        a, b, c = triangle[k], triangle[(k + 1) % 3], triangle[(k + 2) % 3]
        parts = [(a, (a + b) / 2, c), ((a + b) / 2, b, c)]
    return [part for corners in parts for part in halved(numpy.array(corners), longest)]

def expect_closed(file, surfaces):
    """Each side of a triangle is that of another one, the other way round."""
    for number, triangles in enumerate(surfaces, 1):
        corners = [[tuple(corner) for corner in triangle] for triangle in triangles]
        sides = [(triangle[k], triangle[(k + 1) % 3]) for triangle in corners for k in range(3)]
        assert {(b, a) for a, b in sides} == set(sides), f"{file}: surface {number} has a hole"
        assert len(set(sides)) == len(sides), f"{file}: surface {number} has a side twice"

def check(file, longest):
    *grains, container = solids(file)
    expect_closed(file, [*grains, container])
    if "/periodic" in file:  # grains and images reach out of the box along x: a longer one holds them
        container[:, :, 0] = numpy.where(container[:, :, 0] > 0, container[:, :, 0].max() + 2, -2)
    # gmsh 4.8 aborts where it has to add a point on the edge of a large triangle: they are divided, as for a flow.
    with open("void.stl", "w") as text:
        for k, triangles in enumerate([*grains, container]):
            is_large = numpy.linalg.norm(triangles - numpy.roll(triangles, 1, axis=1), axis=2).max(axis=1) > longest
            parts = [part for triangle in triangles[is_large] for part in halved(triangle, longest)]
            text.write(stl(f"solid_{k}", [*triangles[~is_large], *parts]))
    # Nothing but what the boundary takes: no points are added for better tetrahedra.
    open("void.geo", "w").write(f"""
        Merge "void.stl"; Geometry.Tolerance = 1e-10; Mesh.Algorithm3D = 1; Mesh.MaxIterDelaunay3D = 1;
        Mesh.MeshSizeExtendFromBoundary = 0; Mesh.MeshSizeMin = 10; Mesh.MeshSizeMax = 10; Mesh.Optimize = 0;
        Surface Loop(1) = {{1:{len(grains) + 1}}}; Volume(1) = {{1}};
        """)
    said = subprocess.run(["gmsh", "-3", "void.geo", "-format", "msh22", "-o", "void.msh"],
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    problems = [line for line in said.stdout.splitlines() if "Error" in line or "PLC" in line]
    assert said.returncode == 0 and not problems, f"{file}: gmsh ends with {said.returncode}: {problems}"
    assert "tetrahedra created" in said.stdout, (file, said.stdout[-2000:])
    volumes = tetrahedra("void.msh")
    void = volume(container) - sum(map(volume, grains))
    # The same polyhedra added up in two ways: what is between is rounding, as in tetrahedra of four points of a face.
    assert volumes.min() > -1e-15 and abs(volumes.sum() / void - 1) < 1e-9, (file, volumes.min(), volumes.sum(), void)
    print(f"{file}: {len(grains)} surfaces, {len(volumes)} tetrahedra, void {volumes.sum():.6f} d^3")

for file in sys.argv[2:]:
    check(file, float(sys.argv[1]))
