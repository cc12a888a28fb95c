#pragma once
// How a fruit looks: what an artist may change without drying it again.
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/parameter.h"

namespace windfall::picture {

/// How the fruit is put on the ground. Its own axis is +y.
enum class Pose { Standing, Lying };

/// The material of a fruit. Colours are sRGB as typed (0..1); lengths are in units of the radius of the
/// sphere about the fresh fruit, so that one look fits fruits of all sizes.
struct Look {
    std::vector<double> fresh_colour{0.60, 0.19, 0.10};
    std::vector<double> dry_colour{0.46, 0.17, 0.095};
    double roughness = 0.36;
    double gloss = 0.7;
    double softness = 0.035;
    std::vector<double> softness_colour{1.0, 0.42, 0.26};
    double mottle = 0.16;
    double mottle_scale = 0.22;
    double grain = 0.25;
    double grain_scale = 0.05;
    double pores = 0;
    double pore_size = 0.03;
    double bloom = 0.06;
    std::vector<double> bloom_colour{0.80, 0.76, 0.78};
    double valley = 0.55;
    std::vector<double> valley_colour{0.22, 0.05, 0.03};
    double valley_depth = 0.05;
    Pose pose = Pose::Standing;
};

/// The parameters of a look: keys "look.*", none of which needs a new run.
const ParameterTable<Look>& look_parameters();

/// Sets one parameter. Throws InputError for an unknown key (naming the nearest one) or a value that is out
/// of range.
void set_look(Look& look, const std::string& key, const ParameterValue& value);

/// The look that a take holds (TakeInfo::look: an object, key to value). Keys that this version does not know
/// are left out, since another version may have written them; a bad value throws InputError.
Look look_from_json(const nlohmann::json& json);

/// Every parameter, key to value: what `look_from_json` reads.
nlohmann::json look_to_json(const Look& look);

}  // namespace windfall::picture
