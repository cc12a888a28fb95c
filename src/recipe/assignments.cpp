#include "recipe/assignments.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <tuple>

#include "core/error.h"
#include "core/nearest_name.h"

namespace windfall::recipe {
namespace {

// Far beyond any recipe, and small enough that a wrong file name does no harm.
constexpr std::size_t kLargestFile = std::size_t{1} << 20;

std::string read_text(const std::filesystem::path& path) {
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored))
        throw InputError(fmt::format("{} is a folder; name the recipe file in it", path.string()));
    errno = 0;
    std::ifstream stream(path, std::ios::binary);
    if (!stream)
        throw InputError(fmt::format("cannot read the recipe {}: {}", path.string(), std::strerror(errno)));
    std::string text(kLargestFile + 1, '\0');
    stream.read(text.data(), static_cast<std::streamsize>(text.size()));
    if (stream.bad())
        throw InputError(fmt::format("cannot read the recipe {}: {}", path.string(), std::strerror(errno)));
    text.resize(static_cast<std::size_t>(stream.gcount()));
    if (text.size() > kLargestFile)
        throw InputError(
            fmt::format("{} is bigger than 1 MiB, which no recipe is; is it the right file?", path.string()));
    return text;
}

std::string place_in(const std::string& file, const toml::source_position& at) {
    return fmt::format("{}:{}:{}", file, at.line, at.column);
}

toml::table parse(const std::string& text, const std::string& file) {
    try {
        return toml::parse(text, file);
    } catch (const toml::parse_error& error) {
        throw InputError(fmt::format("{}: {}", place_in(file, error.source().begin), error.description()));
    }
}

/// The value of a TOML node where a parameter can hold it.
std::optional<ParameterValue> value_of(const toml::node& node) {
    if (const auto* number = node.as_floating_point()) return number->get();
    if (const auto* integer = node.as_integer()) return integer->get();
    if (const auto* boolean = node.as_boolean()) return boolean->get();
    if (const auto* text = node.as_string()) return text->get();
    const auto* array = node.as_array();
    if (array == nullptr) return std::nullopt;
    std::vector<double> list;
    for (const auto& entry : *array) {
        if (!entry.is_number()) return std::nullopt;
        list.push_back(*entry.value<double>());
    }
    return list;
}

std::optional<std::vector<std::string>> texts_of(const toml::node& node) {
    const auto* array = node.as_array();
    if (array == nullptr || array->empty()) return std::nullopt;
    std::vector<std::string> texts;
    for (const auto& entry : *array) {
        if (!entry.is_string()) return std::nullopt;
        texts.push_back(entry.as_string()->get());
    }
    return texts;
}

struct Reader {
    const std::string& file;
    const std::vector<std::string>& tables;
    std::vector<Mistake>& mistakes;
    std::vector<std::pair<toml::source_position, Assignment>> found;

    void read(const toml::table& table, const std::string& prefix) {
        for (auto&& [key, node] : table) {
            const toml::source_position at = key.source().begin;
            const std::string name = prefix + std::string(key.str());
            if (const auto* inner = node.as_table()) {
                if (std::find(tables.begin(), tables.end(), name) != tables.end())
                    read(*inner, name + ".");
                else
                    complain_of_table(name, at);
            } else {
                found.push_back({at, {name, place_in(file, at), value_of(node), texts_of(node)}});
            }
        }
    }

    void complain_of_table(const std::string& name, const toml::source_position& at) {
        const auto nearest = nearest_names(name, tables);
        mistakes.push_back(
            {place_in(file, at),
             fmt::format("[{}] is not a table of parameters; {}", name,
                         nearest.empty() ? fmt::format("there are [{}]", fmt::join(tables, "], ["))
                                         : fmt::format("did you mean [{}]?", nearest.front()))});
    }
};

std::string trimmed(const std::string& text) {
    const auto first = text.find_first_not_of(" \t");
    if (first == std::string::npos) return "";
    return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// A choice or a file: meridional, pepper.obj, ../fruit/fig.obj.
bool is_bare_text(const std::string& text) {
    const auto is_letter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; };
    const bool begins = !text.empty() && (is_letter(text[0]) || text[0] == '/' || text.starts_with("./") ||
                                          text.starts_with("../"));
    return begins && std::all_of(text.begin(), text.end(), [&](char c) {
               return is_letter(c) || (c >= '0' && c <= '9') || c == '_' || c == '-' || c == '.' || c == '/';
           });
}

}  // namespace

std::vector<Assignment> read_file(const std::filesystem::path& path, const std::vector<std::string>& tables,
                                  std::vector<Mistake>& mistakes) {
    const std::string file = path.string();
    const toml::table table = parse(read_text(path), file);
    Reader reader{file, tables, mistakes, {}};
    reader.read(table, "");
    // toml++ sorts by key; people read from the top.
    std::stable_sort(reader.found.begin(), reader.found.end(), [](const auto& a, const auto& b) {
        return std::tie(a.first.line, a.first.column) < std::tie(b.first.line, b.first.column);
    });
    std::vector<Assignment> assignments;
    for (auto& [position, assignment] : reader.found) assignments.push_back(std::move(assignment));
    return assignments;
}

Assignment parse_setting(const std::string& setting) {
    const std::string place = "--set " + setting;
    const auto equals = setting.find('=');
    if (equals == std::string::npos)
        throw InputError(fmt::format("{}: must be key=value, as in --set material.gamma=20", place));
    const std::string key = trimmed(setting.substr(0, equals));
    const std::string text = trimmed(setting.substr(equals + 1));
    if (key.empty()) throw InputError(fmt::format("{}: there is no key before the =", place));
    if (text.empty()) throw InputError(fmt::format("{}: there is no value behind the =", place));
    try {
        const toml::table table = toml::parse("value = " + text);
        // A line break in the text could have smuggled in more keys.
        if (table.size() == 1) {
            const toml::node& node = *table.get("value");
            return {key, place, value_of(node), texts_of(node)};
        }
    } catch (const toml::parse_error&) {
        if (is_bare_text(text)) return {key, place, ParameterValue(text), std::nullopt};
    }
    throw InputError(
        fmt::format("{}: {} is no value: write a number, true, false, a list as [1, 2], or a text in quotes",
                    place, text));
}

}  // namespace windfall::recipe
