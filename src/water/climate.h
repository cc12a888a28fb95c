#pragma once
// The air around a fruit through day and night.
#include <string>
#include <vector>

namespace windfall::water {

/// Air at one moment.
struct Air {
    double temperature_c = 20;
    double relative_humidity = 0.5;  ///< 0..1
};

/// A row of a day-night table: the air at an hour of the day (0 <= hour < 24).
struct ClimateRow {
    double hour = 0;
    double temperature_c = 20;
    double relative_humidity = 0.5;  ///< 0..1
};

/// Air temperatures that are taken: fruit freezes below, and no open air is hotter.
inline constexpr double kColdestAir_c = -20, kHottestAir_c = 60;

/// A climate: a table of one or more rows that repeats every 24 h, linear between rows.
class Climate {
  public:
    /// Throws InputError, naming the row, for an empty table, hours that do not rise strictly from 0 to below
    /// 24, a humidity outside 0..1, or a temperature outside kColdestAir_c .. kHottestAir_c.
    explicit Climate(std::vector<ClimateRow> rows);

    /// The air `time_h` hours after a midnight.
    Air at(double time_h) const;
    const std::vector<ClimateRow>& rows() const { return m_rows; }

  private:
    std::vector<ClimateRow> m_rows;
};

/// The same air at all times. Throws InputError as Climate does.
Climate constant_climate(double temperature_c, double relative_humidity);

/// temperate (a room: 22 C and 50 %, the paper's), tropical, cold-desert, hot-desert, fridge. The
/// temperatures and humidities are typical ones, chosen here, not measured at a place. Throws InputError,
/// with the nearest name, for any other.
Climate named_climate(const std::string& name);
const std::vector<std::string>& climate_names();

}  // namespace windfall::water
