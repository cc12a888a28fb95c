#include "water/climate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.h"
#include "core/nearest_name.h"

namespace windfall::water {

namespace {

constexpr double kDay_h = 24;

void check_row(const ClimateRow& row, std::size_t number) {
    if (!(row.hour >= 0 && row.hour < kDay_h))
        throw InputError(
            fmt::format("climate row {}: hour {} is not in the day: give 0 <= hour < 24", number, row.hour));
    if (!(row.relative_humidity >= 0 && row.relative_humidity <= 1))
        throw InputError(
            fmt::format("climate row {}: a relative humidity of {:.4g} % cannot be: give 0 to 100 %", number,
                        100 * row.relative_humidity));
    if (!(row.temperature_c >= kColdestAir_c && row.temperature_c <= kHottestAir_c))
        throw InputError(fmt::format("climate row {}: air of {:.4g} C is out of range: give {} to {} C",
                                     number, row.temperature_c, kColdestAir_c, kHottestAir_c));
}

const std::vector<std::pair<std::string, std::vector<ClimateRow>>>& climate_table() {
    static const std::vector<std::pair<std::string, std::vector<ClimateRow>>> table = {
        {"temperate", {{0, 22, 0.50}}},
        {"tropical", {{5, 25, 0.92}, {14, 31, 0.72}, {20, 27, 0.86}}},
        {"cold-desert", {{5, -2, 0.60}, {14, 14, 0.25}, {20, 5, 0.40}}},
        {"hot-desert", {{5, 22, 0.35}, {15, 41, 0.10}, {21, 31, 0.20}}},
        {"fridge", {{0, 4, 0.85}}},
    };
    return table;
}

}  // namespace

Climate::Climate(std::vector<ClimateRow> rows) : m_rows(std::move(rows)) {
    if (m_rows.empty())
        throw InputError("the climate has no rows: give at least one of hour, temperature, humidity");
    for (std::size_t k = 0; k < m_rows.size(); ++k) {
        check_row(m_rows[k], k + 1);
        if (k > 0 && m_rows[k].hour <= m_rows[k - 1].hour)
            throw InputError(
                fmt::format("climate row {}: hour {} does not follow hour {}: put the rows in order", k + 1,
                            m_rows[k].hour, m_rows[k - 1].hour));
    }
}

Air Climate::at(double time_h) const {
    const double hour = time_h - kDay_h * std::floor(time_h / kDay_h);
    const auto later = std::upper_bound(m_rows.begin(), m_rows.end(), hour,
                                        [](double h, const ClimateRow& row) { return h < row.hour; });
    const ClimateRow& after = later == m_rows.end() ? m_rows.front() : *later;
    const ClimateRow& before = later == m_rows.begin() ? m_rows.back() : *(later - 1);
    const auto within_day = [](double h) { return h < 0 ? h + kDay_h : h; };
    const double gap = within_day(after.hour - before.hour);
    // With a single row both are that row, and the gap is 0.
    const double t = gap > 0 ? within_day(hour - before.hour) / gap : 0;
    return {before.temperature_c + t * (after.temperature_c - before.temperature_c),
            before.relative_humidity + t * (after.relative_humidity - before.relative_humidity)};
}

Climate constant_climate(double temperature_c, double relative_humidity) {
    return Climate({{0, temperature_c, relative_humidity}});
}

Climate named_climate(const std::string& name) {
    for (const auto& [known, rows] : climate_table())
        if (known == name) return Climate(rows);
    std::string all;
    for (const std::string& known : climate_names()) all += (all.empty() ? "" : ", ") + known;
    const auto nearest = nearest_names(name, climate_names());
    const std::string hint = nearest.empty() ? "" : " (did you mean '" + nearest.front() + "'?)";
    throw InputError("there is no climate '" + name + "'" + hint + ": the climates are " + all);
}

const std::vector<std::string>& climate_names() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> result;
        for (const auto& entry : climate_table()) result.push_back(entry.first);
        return result;
    }();
    return names;
}

}  // namespace windfall::water
