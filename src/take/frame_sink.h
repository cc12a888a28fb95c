#pragma once
// Where a process puts what it makes. A process does no input or output itself.
#include <cstddef>
#include <nlohmann/json.hpp>
#include <span>

#include "take/frame.h"

namespace windfall::take {

class FrameSink {
  public:
    virtual ~FrameSink() = default;

    /// The mesh that the following frames move; before the first frame of a fresh run.
    virtual void add_mesh(const TakeMesh& mesh) = 0;

    /// A frame; one with the index of an earlier frame replaces it (a resumed run may repeat the last ones).
    virtual void add_frame(const Frame& frame) = 0;

    /// Everything that a process needs to go on from here, to the same bits. Replaces the checkpoint before.
    virtual void save_checkpoint(std::span<const std::byte> bytes) = 0;

    /// Facts of the run as a whole (onset, counts, and "history": per-step columns). Replaces the one before.
    virtual void set_summary(const nlohmann::json& summary) = 0;
};

}  // namespace windfall::take
