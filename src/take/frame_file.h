#pragma once
// Frames and meshes as array files.
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "take/array_file.h"
#include "take/frame.h"

namespace windfall::take {

/// std::logic_error when the length of an attribute does not fit the number of vertices, or lists of curves
/// do not fit each other. Of maps only the description is in the file; their values are files of their own
/// (map_file.h).
ArrayFile to_array_file(const Frame& frame);
ArrayFile to_array_file(const TakeMesh& mesh);

/// The inverse. InputError with `file_name` when arrays are missing, do not fit each other or faces name
/// vertices that are not there. Maps come without their values.
Frame frame_from(const ArrayFile& file, const std::string& file_name);
TakeMesh mesh_from(const ArrayFile& file, const std::string& file_name);

}  // namespace windfall::take
