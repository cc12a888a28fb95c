#include "recipe/run_recipe.h"

#include <optional>

#include "core/version.h"
#include "recipe/process.h"
#include "recipe/schema.h"
#include "take/take_reader.h"

namespace windfall::recipe {
namespace {

/// Hands everything on to a take and tells of the frames.
class TellingSink final : public take::FrameSink {
  public:
    TellingSink(take::TakeWriter& writer, const std::function<void(const take::Frame&)>& on_frame)
        : m_writer(writer), m_on_frame(on_frame) {}

    void add_mesh(const take::TakeMesh& mesh) override { m_writer.add_mesh(mesh); }
    void add_frame(const take::Frame& frame) override {
        m_writer.add_frame(frame);
        if (m_on_frame) m_on_frame(frame);
    }
    void save_checkpoint(std::span<const std::byte> bytes) override { m_writer.save_checkpoint(bytes); }
    void set_summary(const nlohmann::json& summary) override { m_writer.set_summary(summary); }

  private:
    take::TakeWriter& m_writer;
    const std::function<void(const take::Frame&)>& m_on_frame;
};

/// Notes the failure in the take, if that is still possible: on a full disk it may not be, and the first
/// error is the one to tell.
void note_end(take::TakeWriter& writer, take::TakeStatus status, const std::string& reason) {
    try {
        writer.set_status(status, reason);
    } catch (const std::exception&) {
        writer.log("the take's status could not be written");
    }
}

}  // namespace

take::TakeInfo take_info(const Recipe& recipe) {
    const Process& process = process_named(recipe.process);
    take::TakeInfo info;
    info.process = recipe.process;
    info.name = recipe.name;
    info.title = recipe.title;
    info.program_version = program_version();
    info.seed = seed_of(recipe);
    info.unit_length_m = process.unit_length_m(recipe);
    info.parameters = values_json(process.parameters, recipe);
    info.look = values_json(process.look, recipe);
    info.recipe_text = to_toml(recipe);
    return info;
}

bool is_complete(const Recipe& recipe, const std::filesystem::path& folder) {
    const take::TakeReader take(folder);
    return take.status() == take::TakeStatus::Complete && take.info().process == recipe.process &&
           take.info().parameters == take_info(recipe).parameters;
}

void run(const Recipe& recipe, take::TakeWriter& writer, const RunContext& context,
         const std::function<void(const take::Frame&)>& on_frame) {
    TellingSink sink(writer, on_frame);
    try {
        const std::optional<std::vector<std::byte>> checkpoint = writer.checkpoint();
        process_named(recipe.process)
            .run(recipe, sink, context,
                 checkpoint ? std::span<const std::byte>(*checkpoint) : std::span<const std::byte>());
    } catch (const Cancelled& error) {
        note_end(writer, take::TakeStatus::Cancelled, error.what());
        throw;
    } catch (const std::exception& error) {
        note_end(writer, take::TakeStatus::Failed, error.what());
        throw;
    }
    writer.set_status(take::TakeStatus::Complete);
}

}  // namespace windfall::recipe
