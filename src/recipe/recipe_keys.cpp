#include "recipe/recipe_keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/nearest_name.h"

namespace windfall::recipe {
namespace {

std::vector<std::string> keys_of(const Process& process) {
    std::vector<std::string> keys;
    for (const auto& info : recipe_keys()) keys.push_back(info.key);
    for (const auto& info : parameter_infos(process)) keys.push_back(info.key);
    return keys;
}

/// The first process that has this key, or a table of this name.
const Process* owner_of(const std::string& key) {
    for (const Process& process : processes())
        for (const ParameterInfo& info : parameter_infos(process))
            if (info.key == key || info.group() == key) return &process;
    return nullptr;
}

}  // namespace

const std::vector<ParameterInfo>& recipe_keys() {
    static const std::vector<ParameterInfo> kKeys = [] {
        const auto text = [](const std::string& key, const std::string& doc, const std::string& value = "") {
            ParameterInfo info;
            info.key = key;
            info.doc = doc;
            info.default_value = value;
            info.needs_run = false;
            return info;
        };
        std::vector<ParameterInfo> keys = {
            text("process", "what happens to the specimen", processes().front().name),
            text("name", "what takes are called after; the file's name when absent"),
            text("title", "for people; the name when absent"),
            text("description", "a sentence or two"),
            text("source", "where the numbers come from: a text or a list of texts"),
            text("preset", "the preset that this recipe builds on: only what differs needs to be written"),
        };
        for (const Process& process : processes()) keys.front().choices.push_back(process.name);
        keys.front().needs_run = true;
        return keys;
    }();
    return kKeys;
}

const ParameterInfo* find_recipe_key(const std::string& key) {
    for (const auto& info : recipe_keys())
        if (info.key == key) return &info;
    return nullptr;
}

const std::vector<std::string>& table_names() {
    static const std::vector<std::string> kTables = [] {
        std::vector<std::string> tables;
        for (const Process& process : processes())
            for (const ParameterInfo& info : parameter_infos(process))
                if (const std::string group = info.group();
                    !group.empty() && std::find(tables.begin(), tables.end(), group) == tables.end())
                    tables.push_back(group);
        return tables;
    }();
    return kTables;
}

std::string unknown_key_text(const std::string& key, const Process& process) {
    const Process* owner = owner_of(key);
    if (owner != nullptr && owner->name != process.name)
        return fmt::format(
            "{} is a parameter of the process \"{}\", and this is a recipe of \"{}\": take it out, or write "
            "process = \"{}\" above the tables",
            key, owner->name, process.name, owner->name);
    if (owner != nullptr)
        return fmt::format("{} is a table of parameters: write [{}] and the keys below it", key, key);
    const auto nearest = nearest_names(key, keys_of(process));
    if (nearest.empty()) return fmt::format("{} is not a parameter; `windfall schema` lists them all", key);
    return fmt::format("{} is not a parameter; did you mean {}?", key, nearest.front());
}

bool is_utf8(const std::string& text) {
    // nlohmann-json has a decoder, which it shows only by throwing.
    try {
        (void)nlohmann::json(text).dump();
        return true;
    } catch (const nlohmann::json::type_error&) {
        return false;
    }
}

}  // namespace windfall::recipe
