#include "parameter_text.h"

#include <fmt/format.h>

#include <algorithm>

namespace windfall::cli {
namespace {

constexpr std::size_t kWidth = 100;
constexpr std::size_t kIndent = 6;

/// Words of `text` in lines of at most kWidth, each behind kIndent blanks.
std::string wrapped(const std::string& text) {
    std::string result;
    std::string line;
    std::size_t at = 0;
    while (at < text.size()) {
        const std::size_t end = std::min(text.find(' ', at), text.size());
        const std::string word = text.substr(at, end - at);
        if (!line.empty() && kIndent + line.size() + 1 + word.size() > kWidth) {
            result += std::string(kIndent, ' ') + line + "\n";
            line.clear();
        }
        line += (line.empty() ? "" : " ") + word;
        at = end + 1;
    }
    return result + std::string(kIndent, ' ') + line + "\n";
}

std::string entry_text(const ParameterInfo& info) {
    const std::string range = info.range_text();
    std::string head = fmt::format("  {} = {}", info.key, to_text(info.default_value));
    std::string facts = info.choices.empty() ? info.type_name() : "one of";
    if (!range.empty()) facts += (info.choices.empty() ? ", " : " ") + range;
    if (!info.unit.empty() && info.unit != "1") facts += ", in " + info.unit;
    return head + "\n" + wrapped("(" + facts + ")") + wrapped(info.doc);
}

}  // namespace

std::string parameter_reference(const recipe::Process& process) {
    std::string text = fmt::format(
        "Parameters of a recipe of {} (`windfall {}`: {}), with their defaults.\n"
        "In a recipe file the part before the dot is a [table]; on the command line: --set key=value.\n",
        process.name, process.command, process.doc);
    std::string group = "-";
    for (const auto& info : recipe::parameter_infos(process)) {
        if (info.group() != group) {
            group = info.group();
            text += group.empty() ? "\n" : fmt::format("\n[{}]\n", group);
        }
        text += entry_text(info);
    }
    return text;
}

}  // namespace windfall::cli
