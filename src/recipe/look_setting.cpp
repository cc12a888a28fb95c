#include "recipe/look_setting.h"

#include <fmt/format.h>

#include "core/error.h"
#include "recipe/assignments.h"

namespace windfall::recipe {

std::pair<std::string, ParameterValue> parse_look_setting(const std::string& setting) {
    const Assignment assignment = parse_setting(setting);
    if (!assignment.key.starts_with("look."))
        throw InputError(fmt::format("{}: only look.* can be set for a picture; all else needs a new run",
                                     assignment.place));
    if (!assignment.value)
        throw InputError(fmt::format("{}: no parameter of the look holds such a value", assignment.place));
    return {assignment.key, *assignment.value};
}

}  // namespace windfall::recipe
