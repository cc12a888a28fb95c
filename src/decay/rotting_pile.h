#pragma once
// One fruit or several that rot: bodies and skins, frame by frame.
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/run_context.h"
#include "decay/body_pile.h"
#include "decay/pile.h"
#include "decay/rotting_skin.h"
#include "decay/specimen.h"
#include "take/frame_sink.h"

namespace windfall::decay {

class RottingPile {
  public:
    /// Lets the fruit settle and puts the starting points on them. Throws InputError for what cannot be (a
    /// wound off the fruit, a bowl too small), Cancelled.
    RottingPile(const DecayParameters& parameters, const Specimen& specimen, const RunContext& context);

    /// The meshes of the take: "skin" and "flesh", or "skin_0" ..., and the bowl.
    void add_meshes(take::FrameSink& sink) const;

    /// The state as it is, with maps and numbers.
    take::Frame frame() const;
    int frame_index() const { return m_frame; }
    double time_h() const { return m_frame * m_parameters.output.hours_per_frame; }

    /// On to the next frame.
    void advance();

    std::vector<std::byte> save() const;
    /// Goes on from a state that `save` gave, of the same parameters. Throws InputError for any other.
    void restore(std::span<const std::byte> state);

  private:
    void settle(const Specimen& specimen, const RunContext& context);
    void start(const Specimen& specimen);
    std::vector<SkinStarts> starting_places(const Specimen& specimen) const;
    void infect_neighbours();
    std::string name_of(const char* mesh, std::size_t fruit) const;

    DecayParameters m_parameters;
    water::Climate m_climate;
    geometry::CubeAtlas m_atlas;
    std::vector<double> m_relative_size;  // of each fruit
    std::vector<FruitPose> m_poses;
    std::unique_ptr<BodyPile> m_bodies;
    std::vector<RottingSkin> m_skins;
    std::vector<SkinForm> m_forms;
    std::vector<double> m_fresh_volume;
    int m_frame = 0;
};

}  // namespace windfall::decay
