#include "recipe/recipe_keys.h"

#include <nlohmann/json.hpp>

namespace windfall::recipe {

const std::vector<std::string>& process_names() {
    static const std::vector<std::string> kNames = {"drying"};
    return kNames;
}

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
            text("process", "what happens to the specimen", process_names().front()),
            text("name", "what takes are called after; the file's name when absent"),
            text("title", "for people; the name when absent"),
            text("description", "a sentence or two"),
            text("source", "where the numbers come from: a text or a list of texts"),
            text("preset", "the preset that this recipe builds on: only what differs needs to be written"),
        };
        keys.front().choices = process_names();
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
