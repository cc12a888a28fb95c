#pragma once
#include <string>
#include <utility>

#include "core/parameter.h"

namespace windfall::recipe {

/// "look.gloss=0.2", as on the command line, for a picture of a take that is there. Throws InputError for a
/// text that is no setting, and for a key that is not of the look: all others need a new run. Ranges are
/// checked where it is used.
std::pair<std::string, ParameterValue> parse_look_setting(const std::string& setting);

}  // namespace windfall::recipe
