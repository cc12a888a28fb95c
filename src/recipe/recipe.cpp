#include "recipe/recipe.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <set>

#include "core/error.h"
#include "recipe/assignments.h"
#include "recipe/presets.h"
#include "recipe/process.h"
#include "recipe/recipe_keys.h"

namespace windfall::recipe {
namespace {

/// Why `assignment` cannot be given to the parameter; empty when it can.
std::string problem_with(const ParameterInfo& info, const Assignment& assignment) {
    if (assignment.value) return info.problem_with(*assignment.value);
    const std::string type = info.type_name();
    return fmt::format("must be {} {}, not {}", type == "integer" ? "an" : "a", type,
                       assignment.texts ? "a list of texts" : "a date, a time or a list of other things");
}

std::string stem_of(const std::filesystem::path& path) { return path.stem().string(); }

/// Builds one recipe from its base preset, its file and the settings, and collects what is wrong on the way.
class Loader {
  public:
    Recipe load(const std::string& preset_or_path, const std::vector<std::string>& settings) {
        const bool is_path =
            preset_or_path.find('/') != std::string::npos || preset_or_path.ends_with(".toml");
        const std::filesystem::path file =
            is_path ? std::filesystem::path(preset_or_path) : preset_file(preset_or_path);
        Recipe recipe = load_file(file, 0);
        for (const std::string& setting : settings) {
            try {
                const Assignment assignment = parse_setting(setting);
                if (assignment.key == "preset" || assignment.key == "process")
                    m_mistakes.push_back(
                        {assignment.place, assignment.key + " can only stand in a recipe file"});
                else
                    apply(assignment, recipe);
            } catch (const InputError& error) {
                m_mistakes.push_back({"", error.what()});
            }
        }
        if (const std::string problem = problem_with_name(recipe.name); !problem.empty())
            m_mistakes.push_back({m_places.contains("name") ? m_places["name"] : file.string(), problem});
        if (m_mistakes.empty()) check_as_a_whole(recipe, file);
        if (!m_mistakes.empty()) throw InputError(text_of_mistakes());
        if (recipe.title.empty()) recipe.title = recipe.name;
        return recipe;
    }

  private:
    Recipe load_file(const std::filesystem::path& file, int depth) {
        // Presets that name each other would go on for ever.
        if (depth > 4)
            throw InputError(fmt::format("{}: presets build on each other in a ring", file.string()));
        const std::vector<Assignment> assignments = read_file(file, table_names(), m_mistakes);
        Recipe recipe;
        bool inherited = false;
        for (const Assignment& assignment : assignments)
            if (assignment.key == "preset") inherited = inherit(assignment, recipe, depth);
        for (const Assignment& assignment : assignments)
            if (assignment.key == "process") choose_process(assignment, recipe, inherited);
        recipe.name = stem_of(file);
        recipe.title.clear();
        recipe.description.clear();
        for (const Assignment& assignment : assignments)
            if (assignment.key != "preset" && assignment.key != "process") {
                apply(assignment, recipe);
                look_beside(file, assignment.key, recipe);
            }
        return recipe;
    }

    /// Files that a recipe names are relative to its own folder.
    static void look_beside(const std::filesystem::path& file, const std::string& key, Recipe& recipe) {
        const auto* parameter = process_named(recipe.process).find(key);
        if (parameter == nullptr || parameter->info.unit != "file") return;
        const std::filesystem::path named = std::get<std::string>(parameter->get(recipe));
        if (!named.empty() && named.is_relative())
            parameter->set(
                recipe, (std::filesystem::absolute(file).parent_path() / named).lexically_normal().string());
    }

    /// Whether `recipe` is now the preset's.
    bool inherit(const Assignment& assignment, Recipe& recipe, int depth) {
        if (!assignment.value || !std::holds_alternative<std::string>(*assignment.value)) {
            m_mistakes.push_back(
                {assignment.place, "preset must be the name of a preset, as in preset = \"jujube\""});
            return false;
        }
        std::filesystem::path file;
        try {
            file = preset_file(std::get<std::string>(*assignment.value));
        } catch (const InputError& error) {
            m_mistakes.push_back({assignment.place, error.what()});
            return false;
        }
        recipe = load_file(file, depth + 1);
        m_places.clear();
        return true;
    }

    /// Which keys hold depends on the process, so that it comes before all others.
    void choose_process(const Assignment& assignment, Recipe& recipe, bool inherited) {
        const std::string problem = problem_with(*find_recipe_key("process"), assignment);
        if (!problem.empty())
            m_mistakes.push_back({assignment.place, "process " + problem});
        else if (const auto& name = std::get<std::string>(*assignment.value);
                 inherited && name != recipe.process)
            m_mistakes.push_back(
                {assignment.place,
                 fmt::format("process must be \"{}\", that of the preset it builds on, or be left out",
                             recipe.process)});
        else
            recipe.process = name;
    }

    void apply(const Assignment& assignment, Recipe& recipe) {
        m_places[assignment.key] = assignment.place;
        std::string problem;
        if (const auto* key = find_recipe_key(assignment.key)) {
            problem = apply_recipe_key(*key, assignment, recipe);
        } else if (const auto* parameter = process_named(recipe.process).find(assignment.key)) {
            problem = problem_with(parameter->info, assignment);
            if (problem.empty()) {
                try {
                    parameter->set(recipe, *assignment.value);
                } catch (const InputError& error) {
                    m_mistakes.push_back({assignment.place, error.what()});
                }
            }
        } else {
            complain_of_key(assignment, recipe);
        }
        if (!problem.empty())
            m_mistakes.push_back({assignment.place, fmt::format("{} {}", assignment.key, problem)});
    }

    /// Of a table that belongs to another process one complaint is enough.
    void complain_of_key(const Assignment& assignment, const Recipe& recipe) {
        const auto dot = assignment.key.rfind('.');
        const std::string table = dot == std::string::npos ? "" : assignment.key.substr(0, dot);
        const Process& process = process_named(recipe.process);
        const auto infos = parameter_infos(process);
        const bool foreign =
            !table.empty() && std::none_of(infos.begin(), infos.end(),
                                           [&](const ParameterInfo& info) { return info.group() == table; });
        if (foreign && !m_foreign_tables.insert(table).second) return;
        m_mistakes.push_back({assignment.place, unknown_key_text(assignment.key, process)});
    }

    static std::string apply_recipe_key(const ParameterInfo& key, const Assignment& assignment,
                                        Recipe& recipe) {
        if (key.key == "source") {
            const bool one = assignment.value && std::holds_alternative<std::string>(*assignment.value);
            if (!one && !assignment.texts) return "must be a text or a list of texts";
            recipe.sources = one ? std::vector{std::get<std::string>(*assignment.value)} : *assignment.texts;
            return "";
        }
        if (std::string problem = problem_with(key, assignment); !problem.empty()) return problem;
        const auto& text = std::get<std::string>(*assignment.value);
        if (key.key == "name") recipe.name = text;
        if (key.key == "title") recipe.title = text;
        if (key.key == "description") recipe.description = text;
        return "";
    }

    /// The name becomes part of file names and of JSON.
    static std::string problem_with_name(const std::string& name) {
        const bool bad = name.empty() || name == "." || name == ".." || name.size() > 200 || !is_utf8(name) ||
                         std::any_of(name.begin(), name.end(), [](char c) {
                             return c == '/' || std::iscntrl(static_cast<unsigned char>(c)) != 0;
                         });
        return bad ? "the name of a recipe becomes part of file names: give one of at most 200 letters and "
                     "digits, "
                     "without a '/', as in name = \"my-fruit\""
                   : "";
    }

    /// What no single range can say. The keys that the complaint names tell where to look.
    void check_as_a_whole(const Recipe& recipe, const std::filesystem::path& file) {
        try {
            process_named(recipe.process).check(recipe);
        } catch (const InputError& error) {
            const std::string text = error.what();
            std::string place = file.string();
            auto first = std::string::npos;
            for (const auto& [key, where] : m_places)
                if (const auto at = text.find(key); at < first) {
                    first = at;
                    place = where;
                }
            m_mistakes.push_back({place, text});
        }
    }

    std::string text_of_mistakes() const {
        std::vector<std::string> lines;
        for (const Mistake& mistake : m_mistakes)
            lines.push_back(mistake.place.empty() ? mistake.text
                                                  : fmt::format("{}: {}", mistake.place, mistake.text));
        return fmt::format("{}", fmt::join(lines, "\n"));
    }

    std::vector<Mistake> m_mistakes;
    std::map<std::string, std::string> m_places;  ///< where each key got its value, of the outermost recipe
    std::set<std::string> m_foreign_tables;       ///< tables of other processes, complained of already
};

}  // namespace

Recipe load(const std::string& preset_or_path, const std::vector<std::string>& settings) {
    return Loader().load(preset_or_path, settings);
}

}  // namespace windfall::recipe
