#include "core/parameter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace windfall {

namespace {

std::string number_text(double value) {
    std::string text = fmt::format("{}", value);
    if (text.find_first_of(".en") == std::string::npos) text += ".0";
    return text;
}

bool holds_number(const ParameterValue& value) {
    return std::holds_alternative<double>(value) || std::holds_alternative<std::int64_t>(value);
}

}  // namespace

std::string to_text(const ParameterValue& value) {
    if (const auto* number = std::get_if<double>(&value)) return number_text(*number);
    if (const auto* integer = std::get_if<std::int64_t>(&value)) return fmt::format("{}", *integer);
    if (const auto* boolean = std::get_if<bool>(&value)) return *boolean ? "true" : "false";
    if (const auto* text = std::get_if<std::string>(&value)) return "\"" + *text + "\"";
    std::string list = "[";
    for (const double entry : std::get<std::vector<double>>(value))
        list += (list.size() > 1 ? ", " : "") + number_text(entry);
    return list + "]";
}

std::string ParameterInfo::group() const {
    const auto dot = key.rfind('.');
    return dot == std::string::npos ? "" : key.substr(0, dot);
}

std::string ParameterInfo::type_name() const {
    if (!choices.empty()) return "choice";
    static const char* const kNames[] = {"number", "integer", "boolean", "text", "list of numbers"};
    return kNames[default_value.index()];
}

std::string ParameterInfo::range_text() const {
    if (!choices.empty()) return fmt::format("{}", fmt::join(choices, ", "));
    std::string text;
    if (std::isfinite(minimum)) text = fmt::format("{} {}", minimum_excluded ? ">" : ">=", minimum);
    if (std::isfinite(maximum))
        text += fmt::format("{}{} {}", text.empty() ? "" : " and ", maximum_excluded ? "<" : "<=", maximum);
    return text;
}

std::string ParameterInfo::problem_with(const ParameterValue& value) const {
    const bool number_expected = holds_number(default_value);
    const bool types_agree =
        value.index() == default_value.index() ||
        (std::holds_alternative<double>(default_value) && std::holds_alternative<std::int64_t>(value));
    if (!types_agree) {
        const std::string type = type_name();
        return fmt::format("must be {} {}, not {}", type == "integer" ? "an" : "a", type, to_text(value));
    }
    if (!choices.empty()) {
        const auto& text = std::get<std::string>(value);
        if (std::find(choices.begin(), choices.end(), text) == choices.end())
            return fmt::format("must be one of {}, not {}", range_text(), to_text(value));
        return "";
    }
    const auto out_of_range = [&](double x) {
        return !std::isfinite(x) || x < minimum || x > maximum || (minimum_excluded && x <= minimum) ||
               (maximum_excluded && x >= maximum);
    };
    const auto complaint = [&](double x) {
        const std::string range = range_text();
        return fmt::format("must be {}, not {}", range.empty() ? "a finite number" : range, x);
    };
    if (number_expected) {
        const auto* integer = std::get_if<std::int64_t>(&value);
        const double x = integer != nullptr ? static_cast<double>(*integer) : std::get<double>(value);
        return out_of_range(x) ? complaint(x) : "";
    }
    if (const auto* list = std::get_if<std::vector<double>>(&value)) {
        for (const double x : *list)
            if (out_of_range(x)) return "every entry " + complaint(x);
    }
    return "";
}

}  // namespace windfall
