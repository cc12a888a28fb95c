#include "core/nearest_name.h"

#include <algorithm>
#include <utility>

namespace windfall {

std::size_t edit_distance(const std::string& a, const std::string& b) {
    // Optimal string alignment: rows i-2, i-1 and i of the table of distances between prefixes.
    std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::swap(before, last);
        std::swap(last, row);
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                row[j] = std::min(row[j], before[j - 2] + 1);
        }
    }
    return row[b.size()];
}

namespace {

std::string last_part(const std::string& name) { return name.substr(name.rfind('.') + 1); }

std::size_t tolerance(const std::string& name) { return std::max<std::size_t>(1, (name.size() + 1) / 3); }

}  // namespace

std::vector<std::string> nearest_names(const std::string& name, const std::vector<std::string>& candidates,
                                       std::size_t count) {
    std::vector<std::pair<std::size_t, std::string>> found;
    for (const std::string& candidate : candidates) {
        const std::size_t whole = edit_distance(name, candidate);
        if (whole <= tolerance(name)) {
            found.emplace_back(whole, candidate);
            continue;
        }
        // A right or nearly right last part ranks behind every whole name that is near.
        const std::string part = last_part(name);
        const std::size_t partial = edit_distance(part, last_part(candidate));
        if (partial <= tolerance(part) / 2) found.emplace_back(100 + partial, candidate);
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<std::string> names;
    for (const auto& [distance, candidate] : found)
        if (names.size() < count) names.push_back(candidate);
    return names;
}

}  // namespace windfall
