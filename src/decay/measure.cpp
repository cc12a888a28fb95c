#include "decay/measure.h"

#include <fmt/format.h>

#include "core/error.h"

namespace windfall::decay {
namespace {

// A front that is shorter than this is a seed, or none.
constexpr double kShortest_m = 0.005;

double number(const take::Frame& frame, const char* key) {
    const auto found = frame.scalars.find(key);
    if (found == frame.scalars.end())
        throw InputError(fmt::format("frame {} has no \"{}\": make the take again", frame.index, key));
    return found->second;
}

/// Mean speed of a front between two frames: area taken over time and mean length.
nlohmann::json speed_mm_day(const take::Frame& before, const take::Frame& now, const char* area,
                            const char* length) {
    const double front = 0.5 * (number(before, length) + number(now, length));
    if (front < kShortest_m || !(now.time > before.time)) return nullptr;
    return (number(now, area) - number(before, area)) / front / (now.time - before.time) * 24 * 1000;
}

}  // namespace

nlohmann::json measure(const take::TakeReader& take) {
    nlohmann::json frames = nlohmann::json::array();
    take::Frame before;
    double fresh_water = 0;
    if (const auto& p = take.info().parameters; p.contains("fruit.water_kg"))
        fresh_water = p.at("fruit.water_kg").get<double>();
    for (int i = 0; i < take.frame_count(); ++i) {
        const take::Frame frame = take.frame_without_map_values(i);
        if (i == 0)
            fresh_water *= number(frame, "mass_kg") / take.info().parameters.value("fruit.mass_kg", 1.0);
        const double skin = number(frame, "skin_m2"), lost = number(frame, "water_lost_kg");
        nlohmann::json row{{"frame", frame.index},
                           {"time", frame.time},
                           {"day", frame.time / 24},
                           {"temperature_c", number(frame, "temperature_c")},
                           {"humidity", number(frame, "humidity")},
                           {"mass_g", 1000 * number(frame, "mass_kg")},
                           {"water_lost_g", 1000 * lost},
                           {"water_lost_percent", fresh_water > 0 ? 100 * lost / fresh_water : 0},
                           {"rot_cm2", 1e4 * number(frame, "rot_m2")},
                           {"rot_percent", 100 * number(frame, "rot_m2") / skin},
                           {"mold_cm2", 1e4 * number(frame, "mold_m2")},
                           {"mold_percent", 100 * number(frame, "mold_m2") / skin},
                           {"colonies", number(frame, "colonies")},
                           {"volume_ratio", number(frame, "volume_m3") / number(frame, "fresh_volume_m3")},
                           {"area_cm2", 1e4 * number(frame, "area_m2")},
                           {"height_mm", 1000 * number(frame, "height_m")},
                           {"ledger_error", number(frame, "ledger_error")},
                           {"conservation_error", number(frame, "conservation_error")}};
        row["rot_speed_mm_day"] = i > 0 ? speed_mm_day(before, frame, "rot_m2", "rot_front_m") : nullptr;
        row["mold_speed_mm_day"] = i > 0 ? speed_mm_day(before, frame, "mold_m2", "mold_front_m") : nullptr;
        frames.push_back(std::move(row));
        before = frame;
    }
    nlohmann::json result{{"frames", std::move(frames)}};
    result["run"] = take.summary();
    return result;
}

}  // namespace windfall::decay
