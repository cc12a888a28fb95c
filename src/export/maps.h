#pragma once
// The maps of a take as pictures for other programs.
#include <filesystem>
#include <vector>

#include "export/export_take.h"

namespace windfall::export_ {

/// Writes maps/MESH/NAME/0012.png into the folder `options.output`, 16 bits a channel, for one frame or all
/// of them, and maps/maps.json, which says what 0 and 65535 stand for in each. Shading maps are among them
/// when `options.dress` makes them. InputError when the take has no maps, or a file is there already. Returns
/// the files in the order in which they were written, maps.json last.
std::vector<std::filesystem::path> export_maps(const take::TakeReader& take, const ExportOptions& options,
                                               const RunContext& context);

}  // namespace windfall::export_
