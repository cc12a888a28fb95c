#pragma once
// What a recipe of decay names by files: an artist's mesh, a painted mask.
#include "decay/specimen.h"

namespace windfall::recipe {

/// The specimen of the parameters, with the files read. Throws InputError with the file's name for what
/// cannot be read, for a mesh that is not closed and for a mask that is not square.
decay::Specimen read_specimen(const decay::DecayParameters& parameters);

}  // namespace windfall::recipe
