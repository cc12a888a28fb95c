#pragma once
// From the meshes and frames of a take to what formats write.
#include <vector>

#include "export/glb.h"
#include "export/mesh_to_export.h"
#include "take/take_reader.h"

namespace windfall::export_ {

/// All meshes that have faces, at one frame. `metres`: of one unit of the take's lengths. InputError when the
/// frame lacks a mesh or has vertices that are no numbers.
std::vector<MeshToExport> meshes_at(const take::TakeReader& take, const take::Frame& frame, double metres);

/// The same meshes as they lie at a later frame, in the same order.
std::vector<MorphShape> shapes_at(const std::vector<MeshToExport>& meshes, const take::Frame& frame,
                                  double metres);

/// Leaves the attributes that hold in every frame.
void keep_constant_attributes(const take::TakeReader& take, std::vector<MeshToExport>& meshes);

}  // namespace windfall::export_
