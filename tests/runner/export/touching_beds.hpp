// Small beds whose contacts are known.
#pragma once

#include "runner/export/exported_bed.hpp"

namespace grainsweep {

/// A box without walls and of that height: one grain of no size at its top.
inline ExportedBed empty_box(double length, double width, double height) {
  ExportedBed exported;
  exported.bed.box = {length, width, Boundary::periodic, Boundary::periodic};
  exported.bed.grains = {{0, 0, height, 0.0, 0, 0}};
  return exported;
}

/// Two spheres on the floor that touch each other, the first over a corner of a periodic box.
inline ExportedBed stacked_spheres() {
  ExportedBed exported;
  exported.bed.box = {4, 4, Boundary::periodic, Boundary::periodic};
  exported.bed.grains = {{0.1, 0.1, 0.5, 0.5, 2, 1}, {0.7, 0.9, 0.5, 0.5, 1, 1}};
  exported.bed.forces = {{0, 1, 1.0}};
  return exported;
}

/// A cube on the floor and one on it.
inline ExportedBed stacked_cubes() {
  ExportedBed exported;
  exported.bed.box = {4, 4, Boundary::periodic, Boundary::periodic};
  exported.bed.grains = {{2, 2, 0.5, 0.5, 2, 1}, {2.25, 2, 1.5, 0.5, 1, 1}};
  Turned turned;
  Mesh& mesh = turned.meshes.emplace_back();
  for (int k = 0; k < 8; ++k) {
    mesh.vertices.push_back({k & 1 ? 0.5 : -0.5, k & 2 ? 0.5 : -0.5, k & 4 ? 0.5 : -0.5});
  }
  mesh.faces = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  turned.orientations = {{0, 0, 0, 1}, {0, 0, 0, 1}};
  exported.bed.turned = turned;
  return exported;
}

}  // namespace grainsweep
