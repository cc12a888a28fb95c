#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/run_context.h"
#include "take/take_reader.h"

namespace windfall::export_ {

enum class ExportFormat { Obj, Ply, Glb, Maps };

/// "obj", "ply", "glb", "maps", in the order of ExportFormat; the first three are the extensions of the
/// files, too.
const std::vector<std::string>& export_format_names();

/// InputError with the known names for any other text.
ExportFormat export_format(const std::string& name);

struct ExportOptions {
    ExportFormat format = ExportFormat::Obj;
    /// A file (its extension is the format's) or a folder, which is made. Of several files `name.obj` gives
    /// the stem: name_0000.obj, name_0001.obj; in a folder the take's name is the stem.
    std::filesystem::path output = {};
    std::optional<int> frame = {};  ///< empty: all frames (GLB: one file with an animation)
    double scale = 1;               ///< lengths are written in metres times this; finite and > 0
    bool overwrite = false;         ///< without it a file that exists is an InputError
    double frames_per_second = 24;  ///< GLB with all frames: each frame of the take is one frame of the film
    /// Adds to a frame what its take does not keep and others want (decay: shading maps, mold); may be empty.
    std::function<void(take::Frame&)> dress = {};
};

/// Writes frames of a take to files, Y up (the axis of the fruit or branch is y), each file whole or not at
/// all and with all meshes in it. An OBJ of several materials has one file STEM.mtl beside it, for all
/// frames. Hair is in OBJ as lines, in a still GLB as line primitives, beside PLY in a file STEM_hair.ply;
/// animated GLB has none, since its strands come and go. Maps: see maps.h. All names are checked before the
/// first file is written. Returns the files in the order in which they were written.
std::vector<std::filesystem::path> export_take(const take::TakeReader& take, const ExportOptions& options,
                                               const RunContext& context);

}  // namespace windfall::export_
