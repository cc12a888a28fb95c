#pragma once
// What rot and mold look like: colours and hair by species, skins by fruit. None of it needs a run again.
#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace windfall::decay {

/// Linear red, green, blue, 0 .. 1.
using LinearColour = Eigen::Vector3f;

/// The hair of a mold. Lengths in metres.
struct HairLook {
    float young_length_m = 0;       ///< at the active rim
    float length_m = 0;             ///< of a mature strand, on the average
    float radius_m = 0;             ///< of a strand
    float lean = 0.4F;              ///< how far strands stray from the skin's normal; 1: as far along as up
    float whisker_share = 0;        ///< of the strands: those that stand out as long single whiskers
    float whisker_length_m = 0;     ///< the longest; the shortest is a third of it
    float sporangium_radius_m = 0;  ///< of the dark heads on the whiskers; 0: none
};

/// How one organism looks on the skin.
struct MoldLook {
    std::string key;               ///< "digitatum": the map of its density is "fungus_digitatum"
    LinearColour young{1, 1, 1};   ///< mycelium of the active rim
    LinearColour mature{1, 1, 1};  ///< spores
    LinearColour old{1, 1, 1};     ///< where nothing is active any more
    float thickness = 1;  ///< how much of the skin the densest mat hides, 0 .. 1; 0: no mold to be seen
    float relief_m = 0;   ///< height of the mat
    HairLook hair;
};

/// The mold whose key is part of `species` ("P. digitatum", "penicillium-digitatum", "Rhizopus stolonifer");
/// a plain grey mold for any other text.
MoldLook mold_look(const std::string& species);

/// The skin of a fruit, fresh and rotten. Colours are sRGB as typed, 0 .. 1, since artists type them.
struct RotLook {
    Eigen::Vector3d fresh_colour{0.93, 0.47, 0.05};
    Eigen::Vector3d blush_colour{0.93, 0.47, 0.05};  ///< of the sunny side
    double blush = 0;                                ///< share of the skin that it takes, 0 .. 1
    double streaks = 0;                              ///< 0: patches; 1: streaks from stem to calyx
    double mottle = 0.1;                             ///< lighter and darker patches
    double mottle_scale_m = 0.008;
    double roughness = 0.36;
    Eigen::Vector3d soaked_colour{0.66, 0.36, 0.09};  ///< skin under which the flesh gives way: the margin
    Eigen::Vector3d rot_colour{0.52, 0.31, 0.13};
    Eigen::Vector3d old_rot_colour{0.24, 0.145, 0.075};
    double full_rot = 0.3;              ///< value of the map soft_rot where rot is as dense as it gets
    std::string species = "digitatum";  ///< of the mold in the map "fungus"
};

/// From what a take keeps of it (TakeInfo::look), an object with the keys "rot_look.fresh_colour" ...; keys
/// that are missing keep the values of `look`, other keys are left out, since a take's look
/// holds those of pictures too. InputError for a value of the wrong type or out of range.
RotLook rot_look_from_json(const nlohmann::json& json, RotLook look = {});

/// A colour as typed to light.
LinearColour linear_from_typed(const Eigen::Vector3d& srgb);

}  // namespace windfall::decay
