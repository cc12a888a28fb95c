#pragma once
// Where several fruit come to rest that are dropped onto a table or into a bowl: rigid convex bodies in
// Bullet (Coumans, Bullet Physics 3.24), with a fixed step, one thread and a fixed order.
#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "core/run_context.h"
#include "decay/body.h"

namespace windfall::decay {

/// One fruit to drop.
struct PileFruit {
    SurfaceFunction surface;
    double mass_kg = 0.14;
};

struct PileSettings {
    double bowl_radius_m = 0;  ///< of the sphere that the bowl is a part of; 0: no bowl, a table
    double bowl_height_m = 0;  ///< of the rim over the table
    double friction = 0.5;
    std::uint64_t seed = 1;  ///< of the poses in which the fruit are dropped
};

/// x -> rotation x + translation (m).
struct FruitPose {
    Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
    Eigen::Vector3d translation_m = Eigen::Vector3d::Zero();
};

inline constexpr int kPileGround = -1;

struct PileContact {
    int fruit = 0;
    int other = kPileGround;  ///< another fruit (> fruit), or kPileGround
    Eigen::Vector3d point_m;
    Eigen::Vector3d normal;  ///< unit, from `other` towards `fruit`
};

struct SettledPile {
    std::vector<FruitPose> poses;  ///< one per fruit
    std::vector<PileContact> contacts;
    double seconds = 0;  ///< simulated until rest
};

/// Throws InputError without fruit or with a bowl too small for the largest of them, RunError if they do not
/// come to rest in 60 simulated seconds.
SettledPile settle_pile(const std::vector<PileFruit>& fruit, const PileSettings& settings,
                        const RunContext& run);

/// The surface turned and moved.
SurfaceFunction posed(const SurfaceFunction& surface, const FruitPose& pose);
InteriorFunction posed(const InteriorFunction& interior, const FruitPose& pose);

/// The ground of a pile: its bowl or the table.
Ground ground_of(const PileSettings& settings);

}  // namespace windfall::decay
