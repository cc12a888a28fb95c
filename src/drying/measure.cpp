#include "drying/measure.h"

#include <fmt/format.h>

#include "core/error.h"
#include "drying/frame_maker.h"
#include "drying/ridges.h"

namespace windfall::drying {

namespace {

nlohmann::json measure_frame(const take::TakeMesh& mesh, const take::Frame& frame, double thickness) {
    nlohmann::json result = {{"frame", frame.index}, {"time", frame.time}};
    for (const auto& [name, value] : frame.scalars) result[name] = value;
    for (const take::FrameMesh& surface : frame.meshes) {
        const take::Attribute* depth = surface.find("depth");
        if (surface.name != kSkinMesh || depth == nullptr) continue;
        const RidgeMeasures ridges = measure_ridges(mesh.rest.positions, mesh.rest.faces,
                                                    {depth->values.begin(), depth->values.end()});
        result["depth_rms_over_te"] = ridges.depth_rms / thickness;
        result["wavelength_over_te"] = ridges.wavelength / thickness;
        result["valleys"] = ridges.valleys;
        result["ridge_meridian_alignment"] = ridges.meridian_alignment;
        for (const double band : ridges.depth_rms_by_latitude)
            result["depth_rms_by_latitude"].push_back(band / thickness);
    }
    return result;
}

}  // namespace

nlohmann::json measure(const take::TakeReader& take) {
    const double thickness = take.info().parameters.at("fruit.skin_thickness").get<double>();
    if (take.meshes().empty())
        throw InputError(fmt::format("the take {} has no frames yet", take.folder().string()));
    nlohmann::json result;
    result["name"] = take.info().name;
    result["frames"] = nlohmann::json::array();
    for (int i = 0; i < take.frame_count(); ++i)
        result["frames"].push_back(measure_frame(take.meshes().front(), take.frame(i), thickness));
    const nlohmann::json summary = take.summary();
    for (const char* key : {"onset_shrinkage", "unknowns", "elapsed_s", "peak_memory_bytes", "newton_steps",
                            "linear_iterations", "steps", "failures", "instruction_set", "seconds"})
        result[key] = summary.contains(key) ? summary.at(key) : nlohmann::json();
    return result;
}

}  // namespace windfall::drying
