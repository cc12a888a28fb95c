#pragma once
// A sawn log whose upper end has dried and cracked.
#include "fracture/branch_mesh.h"
#include "fracture/crack_set.h"
#include "fracture/parameters.h"

namespace windfall::fracture {

struct CrackedLog {
    BranchMesh mesh;
    CrackCount cracks;
};

/// The unplaced log: a cylinder of radius 1, its cut face with the cracks at z = 0, the other one at
/// -branch.length. Parts: EndGrain (wood on both cuts), InnerBark (phloem on both), Bark, Crack (the cracks'
/// walls). Texture coordinates: cuts ((x + 1) / 2, (y + 1) / 2); bark and walls a unit for 2 pi radii, around
/// and along. Outline, furrows and bend come with placing; normals must be computed after.
CrackedLog make_cracked_log(const FractureParameters& parameters);

}  // namespace windfall::fracture
