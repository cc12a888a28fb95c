#include <fmt/format.h>

#include "recipe/process.h"
#include "recipe/recipe.h"

namespace windfall::recipe {
namespace {

/// A TOML basic string.
std::string quoted(const std::string& text) {
    std::string result = "\"";
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\')
            result += {'\\', c};
        else if (byte < 0x20 || byte == 0x7f)
            result += fmt::format("\\u{:04X}", byte);
        else
            result += c;
    }
    return result + "\"";
}

std::string value_text(const ParameterValue& value) {
    const auto* text = std::get_if<std::string>(&value);
    return text != nullptr ? quoted(*text) : to_text(value);
}

/// The parameters of a table, each group under its heading; the table lists the keys of a group one after
/// another.
std::string groups_text(const std::vector<Parameter<Recipe>>& table, const Recipe& recipe) {
    std::string result;
    std::string group;
    for (const auto& entry : table) {
        if (entry.info.group() != group) {
            group = entry.info.group();
            result += fmt::format("\n[{}]\n", group);
        }
        const std::string name = entry.info.key.substr(group.empty() ? 0 : group.size() + 1);
        result += fmt::format("{} = {}\n", name, value_text(entry.get(recipe)));
    }
    return result;
}

}  // namespace

std::string to_toml(const Recipe& recipe) {
    std::string text;
    const auto line = [&](const std::string& key, const std::string& value) {
        if (!value.empty()) text += fmt::format("{} = {}\n", key, quoted(value));
    };
    line("process", recipe.process);
    line("name", recipe.name);
    line("title", recipe.title);
    line("description", recipe.description);
    if (!recipe.sources.empty()) {
        text += "source = [\n";
        for (const std::string& source : recipe.sources) text += fmt::format("    {},\n", quoted(source));
        text += "]\n";
    }
    const Process& process = process_named(recipe.process);
    // Keys without a group must stand before the first heading: each process' table begins with its seed.
    return text + groups_text(process.parameters, recipe) + groups_text(process.look, recipe);
}

}  // namespace windfall::recipe
