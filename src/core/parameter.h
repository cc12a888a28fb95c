#pragma once
// Parameters are data: one table per process, from which come the checks of a recipe, --help, schema --json,
// the reference page and every form. A table entry binds a key to a member of the process's parameter struct,
// whose initialiser is the one place where the default stands.
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <variant>
#include <vector>

namespace windfall {

/// A value of a recipe. The alternative is the parameter's type.
using ParameterValue = std::variant<double, std::int64_t, bool, std::string, std::vector<double>>;

/// What is told about a parameter; see `Parameter` for the way to the member it stands for.
struct ParameterInfo {
    std::string key;   ///< "material.gamma": the TOML table and the key in it
    std::string unit;  ///< "m", "deg", "1" for a pure number, "r_1" for lengths in units of the fruit's r_1
    std::string doc;   ///< one line: meaning, and what changes when it grows
    ParameterValue default_value;
    double minimum =
        -std::numeric_limits<double>::infinity();              ///< numbers and list entries: smallest allowed
    double maximum = std::numeric_limits<double>::infinity();  ///< largest allowed
    bool minimum_excluded = false;                             ///< value must be > minimum, not >=
    bool maximum_excluded = false;
    std::vector<std::string> choices;  ///< allowed texts; empty for free text
    bool needs_run = true;             ///< changing it needs the simulation again (false: looks, pictures)

    /// Name of the group: the part of the key before its last dot.
    std::string group() const;
    /// "number", "integer", "boolean", "text", "choice" or "list of numbers".
    std::string type_name() const;
    /// The range or choices for people: "> 0 and <= 100", "noise, modes, none"; empty when anything goes.
    std::string range_text() const;
    /// Empty when `value` has this parameter's type and lies in its range, else what is wrong with it, as the
    /// end of a sentence: "must be > 0, not -1". NaN and infinities are never in range. An integer is taken
    /// for a number.
    std::string problem_with(const ParameterValue& value) const;
};

/// Text of a value as it would stand in a TOML file.
std::string to_text(const ParameterValue& value);

/// Limits for `ParameterTable::add`. Closed ends: {.minimum = 0}; open ends: {.above = 0}.
struct ParameterRange {
    double minimum = -std::numeric_limits<double>::infinity();
    double maximum = std::numeric_limits<double>::infinity();
    double above = -std::numeric_limits<double>::infinity();
    double below = std::numeric_limits<double>::infinity();
};

template <class Parameters>
struct Parameter {
    ParameterInfo info;
    std::function<ParameterValue(const Parameters&)> get;
    std::function<void(Parameters&, const ParameterValue&)> set;  ///< value must have passed `problem_with`
};

/// The table of one process. Built once at start-up, then only read.
template <class Parameters>
class ParameterTable {
  public:
    /// Adds a number, integer, boolean, text or list. `member` takes a Parameters& (const or not) and returns
    /// a reference to the member: [](auto& p) -> auto& { return p.material.gamma; }
    template <class Member>
    Parameter<Parameters>& add(const std::string& key, const std::string& unit, Member member,
                               const std::string& doc, const ParameterRange& range = {});

    /// Adds a choice by name; the member is an enum whose values 0, 1, ... are named by `choices` in order.
    template <class Member>
    Parameter<Parameters>& add_choice(const std::string& key, Member member,
                                      const std::vector<std::string>& choices, const std::string& doc);

    const std::vector<Parameter<Parameters>>& entries() const { return m_entries; }
    const Parameter<Parameters>* find(const std::string& key) const {
        for (const auto& entry : m_entries)
            if (entry.info.key == key) return &entry;
        return nullptr;
    }
    std::vector<ParameterInfo> infos() const {
        std::vector<ParameterInfo> result;
        for (const auto& entry : m_entries) result.push_back(entry.info);
        return result;
    }

  private:
    std::vector<Parameter<Parameters>> m_entries;
};

// ---- implementation of the templates ----

template <class Parameters>
template <class Member>
Parameter<Parameters>& ParameterTable<Parameters>::add(const std::string& key, const std::string& unit,
                                                       Member member, const std::string& doc,
                                                       const ParameterRange& range) {
    using Value = std::remove_cvref_t<decltype(member(std::declval<Parameters&>()))>;
    using Stored =
        std::conditional_t<std::is_integral_v<Value> && !std::is_same_v<Value, bool>, std::int64_t, Value>;
    Parameter<Parameters> entry;
    entry.get = [member](const Parameters& p) { return ParameterValue(static_cast<Stored>(member(p))); };
    entry.set = [member](Parameters& p, const ParameterValue& value) {
        if constexpr (std::is_same_v<Stored, double>) {
            const auto* integer = std::get_if<std::int64_t>(&value);
            member(p) = integer != nullptr ? static_cast<double>(*integer) : std::get<double>(value);
        } else {
            member(p) = static_cast<Value>(std::get<Stored>(value));
        }
    };
    entry.info.key = key;
    entry.info.unit = unit;
    entry.info.doc = doc;
    entry.info.default_value = entry.get(Parameters{});
    entry.info.minimum_excluded = range.above > range.minimum;
    entry.info.maximum_excluded = range.below < range.maximum;
    entry.info.minimum = entry.info.minimum_excluded ? range.above : range.minimum;
    entry.info.maximum = entry.info.maximum_excluded ? range.below : range.maximum;
    m_entries.push_back(std::move(entry));
    return m_entries.back();
}

template <class Parameters>
template <class Member>
Parameter<Parameters>& ParameterTable<Parameters>::add_choice(const std::string& key, Member member,
                                                              const std::vector<std::string>& choices,
                                                              const std::string& doc) {
    using Value = std::remove_cvref_t<decltype(member(std::declval<Parameters&>()))>;
    Parameter<Parameters> entry;
    entry.get = [member, choices](const Parameters& p) {
        return ParameterValue(choices.at(static_cast<std::size_t>(member(p))));
    };
    entry.set = [member, choices](Parameters& p, const ParameterValue& value) {
        const auto& text = std::get<std::string>(value);
        for (std::size_t i = 0; i < choices.size(); ++i)
            if (choices[i] == text) member(p) = static_cast<Value>(i);
    };
    entry.info.key = key;
    entry.info.doc = doc;
    entry.info.choices = choices;
    entry.info.default_value = entry.get(Parameters{});
    m_entries.push_back(std::move(entry));
    return m_entries.back();
}

}  // namespace windfall
